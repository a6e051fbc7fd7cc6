//! The stencils of one sector around a vertex or face: all others follow by rotation.
//!
//! Points have a sector and a place `(i, j)` in the lattice of that sector, whose axes are the spoke of the sector and the
//! next one. A rule that looks the same from every sector is known when the new points of sector 0 are.

use super::mesh::{Centre, Mesh, Row, Sector};
use super::refine::Refined;
use super::{MeshRule, SchemeError};
use crate::algebraic::field::cosine_polynomial;
use crate::arith::Rational;
use crate::poly::Poly;
use std::collections::BTreeMap;

/// A place in the lattice of a sector.
pub type Place = (usize, usize);

/// A weight of an old point: its orbit, how many sectors it lies ahead, and the weight.
pub type Weight<W = Rational> = (usize, i64, W);

/// What weights of stencils offer: rational numbers, and polynomials in `2cos(2π/n)`.
pub(super) trait Number: Clone {
    fn zero() -> Self;
    fn is_zero(&self) -> bool;
    fn plus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
}

impl Number for Rational {
    fn zero() -> Self {
        Self::from(0)
    }

    fn is_zero(&self) -> bool {
        *self == 0
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }
}

impl Number for Poly {
    fn zero() -> Self {
        Self::zero()
    }

    fn is_zero(&self) -> bool {
        Self::is_zero(self)
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }
}

/// The new points of one sector in terms of old ones.
#[derive(Debug, Clone)]
pub struct SectorStencils<W = Rational> {
    /// The places of the points of a sector, one for each orbit of the rotation.
    pub places: Vec<Place>,
    /// The weights of each new point of sector 0, apart from that of the centre.
    pub rows: Vec<Vec<Weight<W>>>,
    /// The weight of the centre in each of them (dual schemes have no central point).
    pub from_centre: Vec<W>,
    /// The weight of the old centre in the new one, and the weight of a whole orbit; `None` for dual schemes.
    pub centre: Option<(W, Vec<W>)>,
    /// The faces of a sector.
    pub sector: Sector,
    /// Steps of the scheme that the stencils stand for.
    pub steps: usize,
}

/// The stencils of a rule around a vertex (for dual schemes: in a face) with a number of rings of faces.
///
/// # Errors
/// As for [`super::local_matrix`].
pub fn sector_stencils(rule: &MeshRule, valence: usize, rings: usize) -> Result<SectorStencils, SchemeError> {
    gathered(rule, valence, rings, |mesh, centre, turn| rule.refine(mesh, centre, turn))
}

/// The same of a rule by stencils of one's own, with weights that are polynomials in `2cos(2π/n)`; `None` for other rules.
///
/// # Errors
/// As for [`sector_stencils`].
pub fn cosine_stencils(
    rule: &MeshRule,
    valence: usize,
    rings: usize,
) -> Result<Option<SectorStencils<Poly>>, SchemeError> {
    let Some(own) = rule.own() else { return Ok(None) };
    let mut found = gathered(rule, valence, rings, |mesh, centre, turn| rule.refine_own(own, mesh, centre, turn))?;
    let modulus = cosine_polynomial(valence);
    let reduce = |w: &mut Poly| *w = w.div_rem(&modulus).1;
    found.rows.iter_mut().flatten().for_each(|(_, _, w)| reduce(w));
    found.from_centre.iter_mut().for_each(reduce);
    if let Some((own, sums)) = &mut found.centre {
        reduce(own);
        sums.iter_mut().for_each(reduce);
    }
    Ok(Some(found))
}

/// Sectors on either side of sector 0 on whose points its new points may depend, but for those around the centre.
const NEAR: usize = 3;
/// Rings of faces around the centre that are kept in all sectors.
const INNER: usize = 5;

fn gathered<W: Number>(
    rule: &MeshRule,
    valence: usize,
    rings: usize,
    refine: impl Fn(&Mesh, Centre, usize) -> Result<Refined<W>, SchemeError>,
) -> Result<SectorStencils<W>, SchemeError> {
    let sector = rule.sector();
    if valence > super::MAX_VALENCE {
        return Err(SchemeError::Large { what: "valence", size: valence, limit: super::MAX_VALENCE });
    }
    // Two triangles, or two corners of a face, have both their edges in common: no mesh tells these apart.
    let least = if sector == Sector::Quads && !rule.dual() { 2 } else { 3 };
    if valence < least {
        let expected = format!("this rule has a meaning from valence {least} on");
        return Err(SchemeError::value("valence", &valence, &expected));
    }
    // All stars of a part of a mesh that close are those of the mesh, so that a part is enough or is seen to be too small.
    if valence > 2 * NEAR + 1
        && let Ok(found) = on_disc(rule, valence, rings, true, &refine)
    {
        return Ok(found);
    }
    on_disc(rule, valence, rings, false, &refine)
}

/// The stencils from a disc, or from a part of one: all sectors near the centre, and a few of them farther out.
fn on_disc<W: Number>(
    rule: &MeshRule,
    valence: usize,
    rings: usize,
    part: bool,
    refine: &impl Fn(&Mesh, Centre, usize) -> Result<Refined<W>, SchemeError>,
) -> Result<SectorStencils<W>, SchemeError> {
    let sector = rule.sector();
    let too_small = || SchemeError::Mesh { rule: rule.name().to_owned(), message: "the mesh is too small".to_owned() };
    let far = |s: usize| part && s.min(valence - s) > NEAR;
    let size = |s: usize| if far(s) { INNER.min(rings + 3) } else { rings + 3 };
    let disc = Mesh::uneven_disc(&vec![sector; valence], size);
    let (mesh, centre) =
        if rule.dual() { disc.dual(0, 1).ok_or_else(too_small)? } else { (disc, Centre::Vertex(0, 1)) };
    let mut current = refine(&mesh, centre, 0)?;
    let mut earlier: Vec<Vec<Row<W>>> = Vec::new();
    for turn in 1..rule.steps() {
        let next = refine(&current.mesh, current.centre, turn)?;
        earlier.push(std::mem::replace(&mut current, next).rows);
    }
    // Of all steps together only the rows of the new points of one sector are formed.
    let whole = |v: usize| {
        let own = current.rows[v].clone();
        earlier.iter().rev().fold(own, |row, points| substitute(&row, points))
    };
    let places = places(sector, rule.dual(), rings);
    let mut old: BTreeMap<usize, (usize, i64)> = BTreeMap::new();
    for (turn, view) in views(&mesh, centre).ok_or_else(too_small)?.into_iter().enumerate() {
        // Turns beyond half a circle count backwards.
        let shift = if 2 * turn > valence { turn as i64 - valence as i64 } else { turn as i64 };
        for (orbit, place) in places.iter().enumerate() {
            match locate(&mesh, view, sector, *place) {
                Some(v) => drop(old.insert(v, (orbit, shift))),
                // Were it needed, no place would be known for it below.
                None if part => {}
                None => return Err(too_small()),
            }
        }
    }
    let middle = match centre {
        Centre::Vertex(v, _) => Some(v),
        _ => None,
    };
    let sort = |row: &Row<W>| sort(rule, row, &old, middle, rings);
    let mut rows = Vec::new();
    let mut from_centre = Vec::new();
    for place in &places {
        let v = locate(&current.mesh, current.centre, sector, *place).ok_or_else(too_small)?;
        let (weights, own) = sort(&whole(v))?;
        rows.push(weights);
        from_centre.push(own);
    }
    let centre = match current.centre {
        Centre::Vertex(v, _) => {
            let (weights, own) = sort(&whole(v))?;
            let mut sums = vec![W::zero(); places.len()];
            weights.iter().for_each(|(orbit, _, w)| sums[*orbit] = sums[*orbit].plus(w));
            Some((own, sums))
        }
        _ => None,
    };
    Ok(SectorStencils { places, rows, from_centre, centre, sector, steps: rule.steps() })
}

/// The sector and the place of each point of the disc of [`super::disc`] around a vertex, in its order; `None` is the vertex.
///
/// # Errors
/// [`SchemeError::Mesh`] for dual rules.
///
/// # Examples
/// ```
/// use secant::scheme::{disc_places, mesh_rule};
/// let places = disc_places(&mesh_rule("catmull-clark", &[].into())?, 5)?;
/// assert_eq!((places.len(), places[0]), (31, None));
/// assert!(places.contains(&Some((4, (1, 1)))));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn disc_places(rule: &MeshRule, valence: usize) -> Result<Vec<Option<(usize, Place)>>, SchemeError> {
    let failure = || SchemeError::Mesh { rule: rule.name().to_owned(), message: "no disc around a vertex".to_owned() };
    if rule.dual() || !(3..=super::MAX_VALENCE).contains(&valence) {
        return Err(failure());
    }
    let sector = rule.sector();
    let (mesh, centre) = (Mesh::disc(&vec![sector; valence], 7), Centre::Vertex(0, 1));
    let mut known = BTreeMap::new();
    for (turn, view) in views(&mesh, centre).ok_or_else(failure)?.into_iter().enumerate() {
        for place in places(sector, false, 2) {
            known.insert(locate(&mesh, view, sector, place).ok_or_else(failure)?, (turn, place));
        }
    }
    let points = mesh.walk(centre, 2).ok_or_else(failure)?.points;
    let place = |v: &usize| if *v == 0 { Ok(None) } else { known.get(v).copied().map(Some).ok_or_else(failure) };
    points.iter().map(place).collect()
}

/// The places of one sector up to a number of rings.
fn places(sector: Sector, dual: bool, rings: usize) -> Vec<Place> {
    let mut all = Vec::new();
    for i in 0..=rings {
        for j in 0..=rings {
            let inside = match (sector, dual) {
                (_, true) => i < rings && j < rings,
                (Sector::Quads, false) => i > 0,
                (Sector::Triangles, false) => i > 0 && i + j <= rings,
            };
            if inside {
                all.push((i, j));
            }
        }
    }
    all.sort_by_key(|(i, j)| (i.max(j).to_owned(), *i, *j));
    all
}

/// The centre as seen from each sector.
pub(super) fn views(mesh: &Mesh, centre: Centre) -> Option<Vec<Centre>> {
    match centre {
        Centre::Vertex(v, first) => {
            Some(mesh.star(v, Some(first))?.into_iter().map(|w| Centre::Vertex(v, w)).collect())
        }
        Centre::Face(f, first) => {
            let face = mesh.faces.get(f)?;
            let at = face.iter().position(|x| *x == first)?;
            Some((0..face.len()).map(|k| Centre::Face(f, face[(at + k) % face.len()])).collect())
        }
        Centre::Edge(..) | Centre::Across(..) => None,
    }
}

/// The point at a place of the sector that a centre is seen from.
pub(super) fn locate(mesh: &Mesh, centre: Centre, sector: Sector, (i, j): Place) -> Option<usize> {
    let (mut v, mut ahead) = centre.start(mesh)?;
    let (straight, left) = sector.turns();
    for k in 0..i {
        let next = ahead;
        if k + 1 < i || j > 0 {
            ahead = *mesh.star(next, Some(v))?.get(straight)?;
        }
        v = next;
    }
    for k in 0..j {
        let next = *mesh.star(v, Some(ahead))?.get(1)?;
        if k + 1 < j {
            ahead = *mesh.star(next, Some(v))?.get(left)?;
        }
        v = next;
    }
    Some(v)
}

/// A combination of points that are combinations themselves.
pub(super) fn substitute<W: Number>(row: &Row<W>, points: &[Row<W>]) -> Row<W> {
    let mut result = Row::new();
    for (v, weight) in row {
        for (old, c) in &points[*v] {
            let sum = result.entry(*old).or_insert_with(W::zero);
            *sum = sum.plus(&c.times(weight));
        }
    }
    result
}

/// The weights of a new point by orbit and sector, and that of the centre.
fn sort<W: Number>(
    rule: &MeshRule,
    row: &Row<W>,
    old: &BTreeMap<usize, (usize, i64)>,
    middle: Option<usize>,
    rings: usize,
) -> Result<(Vec<Weight<W>>, W), SchemeError> {
    let mut weights = Vec::new();
    let mut own = W::zero();
    for (v, weight) in row.iter().filter(|(_, w)| !w.is_zero()) {
        if Some(*v) == middle {
            own = own.plus(weight);
        } else if let Some((orbit, shift)) = old.get(v) {
            weights.push((*orbit, *shift, weight.clone()));
        } else {
            return Err(SchemeError::Rings { rule: rule.name(), rings });
        }
    }
    Ok((weights, own))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::mesh_rule;

    #[test]
    fn a_part_of_a_disc_gives_the_same_stencils() {
        let named = |name: &str| mesh_rule(name, &[].into()).unwrap();
        let rules = [
            (named("catmull-clark"), 4),
            (named("loop").with_near(Rational::from(2)), 4),
            (named("sqrt3").with_near(Rational::from(2)), 7),
            (named("butterfly").regular(), 5),
            (named("doo-sabin").with_corners(vec![Rational::from(1) / Rational::from(12); 12]), 4),
        ];
        for (rule, rings) in rules {
            let stencils = |part| {
                let refine = |mesh: &Mesh, centre, turn| rule.refine(mesh, centre, turn);
                let mut found = on_disc(&rule, 12, rings, part, &refine).unwrap();
                found.rows.iter_mut().for_each(|row| row.sort());
                (found.places, found.rows, found.from_centre, found.centre)
            };
            assert!(stencils(true) == stencils(false), "{}", rule.name());
        }
    }
}
