//! The polynomial patches of the ring of one sector: what a net of control points gives between the radii 1 and 2.
//!
//! Far from the vertex every scheme here is a spline: bicubic for Catmull and Clark, biquadratic for Doo and Sabin, Loop's
//! quartic box spline, and the quadratic box spline of Zwart and Powell for the midedge scheme. The ring of a sector are the
//! faces with corners at distance 1 and 2.

use super::block::Vertex;
use super::field::Field;
use super::net::Net;
use super::turning::{Rotation, Turning};
use crate::arith::{Rational, ratio};
use crate::scheme::{MeshRule, Sector, Spline};

/// The values of one orbit each, for sector 0, and at the centre.
#[derive(Debug, Clone)]
pub struct Values<E> {
    /// At the centre; 0 in the blocks other than 0.
    pub centre: Turning<E>,
    /// By orbit.
    pub orbits: Vec<Turning<E>>,
}

/// Rings of points on which the patches depend.
pub const RINGS: usize = 3;

/// The faces of the ring of a sector of quadrangles, by their lower left corner.
pub(crate) const CELLS: [(i64, i64); 3] = [(1, 0), (1, 1), (0, 1)];

/// The faces of the ring of a sector of quadrangles from some distance to twice that, row by row; [`CELLS`] at distance 1.
fn cells(radius: i64) -> Vec<(i64, i64)> {
    if radius == 1 {
        return CELLS.to_vec();
    }
    let outer = 2 * radius;
    (0..outer).flat_map(|i| (0..outer).map(move |j| (i, j))).filter(|(i, j)| *i.max(j) >= radius).collect()
}

/// The triangles of the ring of a sector from some distance to twice that; [`TRIANGLES`] at distance 1.
fn triangles(radius: i64) -> Vec<((i64, i64), i64)> {
    if radius == 1 { TRIANGLES.to_vec() } else { super::limit::cells_between(true, radius, 2 * radius) }
}

/// The triangles of the ring of a sector: a corner, and the lattice vectors to the next two.
pub(crate) const TRIANGLES: [((i64, i64), i64); 3] = [((1, 0), 1), ((1, 1), -1), ((0, 1), 1)];

/// A net of control points, continued over the spokes of sector 0.
pub(super) struct Control<'a, F: Field> {
    pub vertex: &'a Vertex,
    pub field: &'a F,
    pub values: &'a Values<F::E>,
}

/// The place of a point `(i, j)` of the lattice of sector 0, continued over its two spokes, in the sector to which it belongs,
/// and how many sectors ahead that is; inside, `None` is the centre.
pub(crate) fn own_place(dual: bool, triangles: bool, i: i64, j: i64) -> Option<Option<((usize, usize), i64)>> {
    let (place, shift) = match (dual, i, j) {
        (true, 0.., 0..) => ((i, j), 0),
        (true, 0.., _) => ((-1 - j, i), -1),
        (true, _, _) => ((j, -1 - i), 1),
        (false, 0, 0) => return Some(None),
        (false, 1.., 0..) => ((i, j), 0),
        (false, 0, 1..) => ((j, 0), 1),
        (false, 0.., _) if triangles => ((-j, i + j), -1),
        (false, 0.., _) => ((-j, i), -1),
        (false, _, _) if triangles => ((j + i, -i), 1),
        (false, _, _) => ((j, -i), 1),
    };
    // The second axis is the first one of the next sector.
    let (place, shift) = if !dual && place.0 == 0 { ((place.1, 0), shift + 1) } else { (place, shift) };
    Some(Some(((usize::try_from(place.0).ok()?, usize::try_from(place.1).ok()?), shift)))
}

impl<F: Field> Control<'_, F> {
    /// The value at a place of the lattice of sector 0, continued over its two spokes.
    pub fn at(&self, i: i64, j: i64) -> Option<Turning<F::E>> {
        let triangles = self.vertex.stencils.sector == Sector::Triangles;
        let Some((place, shift)) = own_place(self.vertex.rule.dual(), triangles, i, j)? else {
            return Some(self.values.centre.clone());
        };
        let value = &self.values.orbits[self.vertex.orbit(place)?];
        Some(Rotation(self.field).turn(value, shift))
    }

    fn combine(&self, terms: &[((i64, i64), i64)], divisor: i64) -> Option<Turning<F::E>> {
        let rotation = Rotation(self.field);
        let mut sum = rotation.zero();
        for ((i, j), weight) in terms {
            sum = rotation.add(&sum, &rotation.scale(&self.at(*i, *j)?, &ratio(*weight, 1)));
        }
        Some(rotation.scale(&sum, &ratio(1, divisor)))
    }

    /// A patch of a tensor product B-spline: `to_bezier[r]` are the weights of the `r`-th Bézier point, `first` the offset of
    /// their first B-spline coefficient.
    fn tensor(&self, cell: (i64, i64), to_bezier: &[&[i64]], divisor: i64) -> Option<Net<Turning<F::E>>> {
        let row = |across: &[i64]| -> Option<Vec<Turning<F::E>>> {
            let entry = |along: &&[i64]| {
                let mut terms = Vec::new();
                for (b, v) in across.iter().enumerate() {
                    for (a, u) in along.iter().enumerate().filter(|(_, u)| **u * *v != 0) {
                        terms.push(((cell.0 + a as i64 - 1, cell.1 + b as i64 - 1), u * v));
                    }
                }
                self.combine(&terms, divisor * divisor)
            };
            to_bezier.iter().map(entry).collect()
        };
        let rows = to_bezier.iter().map(|across| row(across)).collect::<Option<_>>()?;
        Some(Net { triangle: false, rows })
    }

    /// A triangle of Loop's box spline with corners `a`, `a + sign u`, `a + sign v`.
    fn quartic(&self, a: (i64, i64), sign: i64) -> Option<Net<Turning<F::E>>> {
        let entry = |weights: &[i64; 12]| {
            let place = |(i, j): &(i64, i64)| (a.0 + sign * i, a.1 + sign * j);
            let terms: Vec<_> =
                QUARTIC_POINTS.iter().map(place).zip(weights.iter().copied()).filter(|(_, w)| *w != 0).collect();
            self.combine(&terms, 24)
        };
        let mut masks = QUARTIC.iter();
        let mut rows = Vec::new();
        for r in 0..5 {
            rows.push(masks.by_ref().take(5 - r).map(entry).collect::<Option<_>>()?);
        }
        Some(Net { triangle: true, rows })
    }

    /// The four triangles of a square: two corners and the middle.
    fn quadratic(&self, cell: (i64, i64)) -> Option<Vec<Net<Turning<F::E>>>> {
        let at = |d: (i64, i64)| (cell.0 + d.0, cell.1 + d.1);
        let own = at((0, 0));
        let sides = [at((0, -1)), at((1, 0)), at((0, 1)), at((-1, 0))];
        let diagonals = [at((-1, -1)), at((1, -1)), at((1, 1)), at((-1, 1))];
        let mut nets = Vec::new();
        for m in 0..4 {
            let next = (m + 1) % 4;
            // Corner m lies between the sides m − 1 and m.
            let corner = |m: usize| vec![(own, 1), (sides[m], 1), (sides[(m + 3) % 4], 1), (diagonals[m], 1)];
            let spoke = |m: usize| vec![(own, 2), (sides[m], 1), (sides[(m + 3) % 4], 1)];
            let mut middle = vec![(own, 4)];
            middle.extend(sides.iter().map(|s| (*s, 1)));
            let first = vec![
                self.combine(&corner(m), 4)?,
                self.combine(&[(own, 1), (sides[m], 1)], 2)?,
                self.combine(&corner(next), 4)?,
            ];
            let second = vec![self.combine(&spoke(m), 4)?, self.combine(&spoke(next), 4)?];
            nets.push(Net { triangle: true, rows: vec![first, second, vec![self.combine(&middle, 8)?]] });
        }
        Some(nets)
    }
}

/// The patches of the ring of sector 0; `None` where the scheme is no spline.
#[must_use]
pub fn patches<F: Field>(vertex: &Vertex, field: &F, values: &Values<F::E>) -> Option<Vec<Net<Turning<F::E>>>> {
    let control = Control { vertex, field, values };
    let radius = vertex.rule.regular_from();
    match vertex.rule.info().spline? {
        Spline::Bicubic => {
            let masks: [&[i64]; 4] = [&[1, 4, 1, 0], &[0, 4, 2, 0], &[0, 2, 4, 0], &[0, 1, 4, 1]];
            cells(radius).iter().map(|c| control.tensor(*c, &masks, 6)).collect()
        }
        Spline::Biquadratic => {
            let masks: [&[i64]; 3] = [&[1, 1, 0], &[0, 2, 0], &[0, 1, 1]];
            CELLS.iter().map(|c| control.tensor(*c, &masks, 2)).collect()
        }
        Spline::Quartic => triangles(radius).iter().map(|(a, sign)| control.quartic(*a, *sign)).collect(),
        Spline::Quadratic => {
            let nets: Option<Vec<Vec<_>>> = CELLS.iter().map(|c| control.quadratic(*c)).collect();
            Some(nets?.into_iter().flatten().collect())
        }
    }
}

/// The outer boundary of the ring of sector 0: Bézier points of curves, from the first spoke to the next.
#[must_use]
pub fn boundary<E: Clone>(rule: &MeshRule, patches: &[Net<E>]) -> Option<Vec<Net<E>>> {
    let last = |net: &Net<E>| net.rows.iter().map(|row| row[row.len() - 1].clone()).collect::<Vec<E>>();
    let top = |net: &Net<E>| net.rows[net.rows.len() - 1].clone();
    let first = |net: &Net<E>| net.rows[0].clone();
    let radius = rule.regular_from();
    if radius > 1 {
        return wide_boundary(rule.info().spline?, radius, patches);
    }
    let curves = match (rule.info().spline?, patches) {
        (Spline::Bicubic | Spline::Biquadratic, [a, b, c]) => vec![last(a), last(b), top(b), top(c)],
        // The last points of the rows of a triangle lie on the edge from the second corner to the third.
        (Spline::Quartic, [a, _, c]) => vec![last(a), last(c)],
        (Spline::Quadratic, all) if all.len() == 12 => {
            vec![first(&all[1]), first(&all[5]), first(&all[6]), first(&all[10])]
        }
        _ => return None,
    };
    Some(curves.into_iter().map(|row| Net { triangle: false, rows: vec![row] }).collect())
}

/// The outer boundary of a ring from a distance other than 1.
fn wide_boundary<E: Clone>(spline: Spline, radius: i64, patches: &[Net<E>]) -> Option<Vec<Net<E>>> {
    let last = |net: &Net<E>| net.rows.iter().map(|row| row[row.len() - 1].clone()).collect::<Vec<E>>();
    let top = |net: &Net<E>| net.rows[net.rows.len() - 1].clone();
    let outer = 2 * radius - 1;
    let curves: Vec<Vec<E>> = match spline {
        Spline::Bicubic => {
            let at = |p: (i64, i64)| cells(radius).iter().position(|c| *c == p).and_then(|index| patches.get(index));
            let right = (0..=outer).map(|j| at((outer, j)).map(last));
            let above = (0..=outer).rev().map(|i| at((i, outer)).map(top));
            right.chain(above).collect::<Option<_>>()?
        }
        Spline::Quartic => {
            let all = triangles(radius).into_iter().zip(patches);
            all.filter(|(((i, j), sign), _)| *sign == 1 && i + j == outer).map(|(_, net)| last(net)).collect()
        }
        Spline::Biquadratic | Spline::Quadratic => return None,
    };
    Some(curves.into_iter().map(|row| Net { triangle: false, rows: vec![row] }).collect())
}

/// The Bernstein coefficients of the Jacobian determinant of a patch in the coordinates `x + y ω`, but for a positive factor.
pub fn jacobian<F: Field>(field: &F, patch: &Net<Turning<F::E>>) -> Net<F::E> {
    let (x, y) = (patch.map(|p| p.x.clone()), patch.map(|p| p.y.clone()));
    let ((xu, xv), (yu, yv)) = (x.derivatives(field), y.derivatives(field));
    Net::difference_of_products(field, (&xu, &yv), (&xv, &yu))
}

/// Where a patch and a spot in it lie in the lattice of the sector.
#[must_use]
pub fn lattice_point(rule: &MeshRule, patch: usize, spot: &(Rational, Rational)) -> Option<(Rational, Rational)> {
    let integer = |x: i64| Rational::from(x);
    match rule.info().spline? {
        Spline::Bicubic | Spline::Biquadratic => {
            let (i, j) = *cells(rule.regular_from()).get(patch)?;
            Some((integer(i) + &spot.0, integer(j) + &spot.1))
        }
        Spline::Quartic => {
            let ((i, j), sign) = *triangles(rule.regular_from()).get(patch)?;
            Some((integer(i) + integer(sign) * &spot.0, integer(j) + integer(sign) * &spot.1))
        }
        Spline::Quadratic => {
            let (i, j) = *CELLS.get(patch / 4)?;
            let corner = |m: usize| [(0, 0), (1, 0), (1, 1), (0, 1)][m % 4];
            let (a, b) = (corner(patch % 4), corner(patch % 4 + 1));
            let rest = ratio(1, 1) - &spot.0 - &spot.1;
            let mix = |p: i64, q: i64| integer(p) * &rest + integer(q) * &spot.0 + ratio(1, 2) * &spot.1;
            Some((integer(i) + mix(a.0, b.0), integer(j) + mix(a.1, b.1)))
        }
    }
}

/// The control points of a triangle of Loop's box spline, in the lattice of its first corner.
pub(crate) const QUARTIC_POINTS: [(i64, i64); 12] =
    [(-1, 0), (-1, 1), (-1, 2), (0, -1), (0, 0), (0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, -1), (2, 0)];

/// 24 times the Bernstein coefficients of Loop's box spline on the triangle (0,0), (1,0), (0,1), by the weight of the third
/// corner, then of the second; the refinement equation is tested below.
pub(crate) const QUARTIC: [[i64; 12]; 15] = [
    [2, 2, 0, 2, 12, 2, 0, 2, 2, 0, 0, 0],
    [0, 1, 0, 1, 12, 3, 0, 3, 4, 0, 0, 0],
    [0, 0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0],
    [0, 0, 0, 0, 4, 3, 0, 3, 12, 1, 1, 0],
    [0, 0, 0, 0, 2, 2, 0, 2, 12, 2, 2, 2],
    [1, 3, 0, 0, 12, 4, 0, 1, 3, 0, 0, 0],
    [0, 1, 0, 0, 10, 6, 0, 1, 6, 0, 0, 0],
    [0, 0, 0, 0, 6, 6, 0, 1, 10, 1, 0, 0],
    [0, 0, 0, 0, 3, 4, 0, 1, 12, 3, 0, 1],
    [0, 4, 0, 0, 8, 8, 0, 0, 4, 0, 0, 0],
    [0, 1, 0, 0, 6, 10, 0, 0, 6, 1, 0, 0],
    [0, 0, 0, 0, 4, 8, 0, 0, 8, 4, 0, 0],
    [0, 3, 1, 0, 4, 12, 0, 0, 3, 1, 0, 0],
    [0, 1, 0, 0, 3, 12, 1, 0, 4, 3, 0, 0],
    [0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0, 0],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::{Field as _, Ordered as _};
    use crate::scheme::mesh_rule;
    use crate::vertex::field::Enclosures;

    /// The refinement equation: on the smaller ring of a fixed net the patches of the refined net must be the polynomials
    /// that the old patches are there. Checked where it needs no patch inside: the ring of a regular vertex, whose spline
    /// reproduces linear functions, and the limit on common edges.
    #[test]
    fn regular_vertices_give_the_identity() {
        let rules = [
            ("catmull-clark", 4, 0),
            ("quad-triangle", 4, 0),
            ("doo-sabin-catmull-clark", 4, 1),
            ("midedge", 4, 1),
            ("loop-warren", 6, 0),
        ];
        for (name, n, dual) in rules {
            let rule = mesh_rule(name, &[].into()).unwrap();
            let vertex = Vertex::new(&rule, n, RINGS).unwrap();
            let field = Enclosures::of_angle(1, n, 96);
            let rotation = Rotation(&field);
            // A point (i, j) of the lattice is i + j ω; the cells of a dual scheme have their middles at half numbers.
            let point = |i: i64, j: i64| Turning {
                x: field.rational(&ratio(2 * i + dual, 2)),
                y: field.rational(&ratio(2 * j + dual, 2)),
            };
            let orbits = vertex.stencils.places.iter().map(|(i, j)| point(*i as i64, *j as i64)).collect();
            let values = Values { centre: rotation.zero(), orbits };
            let patches = patches(&vertex, &field, &values).unwrap();
            for (index, patch) in patches.iter().enumerate() {
                let places = crate::vertex::net::corners(patch.triangle);
                for (value, spot) in patch.corners().into_iter().zip(places) {
                    let (u, v) = lattice_point(&rule, index, &spot).unwrap();
                    let error = rotation.sub(value, &Turning { x: field.rational(&u), y: field.rational(&v) });
                    for e in [error.x, error.y] {
                        assert!(e.lo <= 1000 && e.hi >= -1000, "{rule:?}, patch {index}");
                    }
                }
                let jacobian = jacobian(&field, patch);
                assert!(jacobian.rows.iter().flatten().all(|c| field.sign(c) == Some(1)), "{rule:?}");
            }
        }
    }
}
