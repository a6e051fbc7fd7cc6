//! Mesh rules by stencils of one's own: weights of named neighbours of a vertex, an edge and a face where all is regular, and
//! at the centre as formulas in the valence `n` and the number `k` of the sector.

mod around;
mod formula;

pub use formula::Formula;

use super::rule::{MeshRule, RuleInfo, Spline, Split};
use super::{SchemeError, Sector};
use crate::algebraic::field::cosine_polynomial;
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use formula::Cosines;
use std::collections::{BTreeMap, BTreeSet};

/// Points that a stencil may reach in each direction.
const REACH: i64 = 8;

/// What a new point lies at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Element {
    /// A vertex.
    Vertex,
    /// An edge.
    Edge,
    /// A face.
    Face,
}

impl Element {
    /// Its key in a case.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Vertex => "vertex",
            Self::Edge => "edge",
            Self::Face => "face",
        }
    }
}

/// A place in the lattice of an element: of a vertex with its edges as axes, of an edge from its first end along it, of a face
/// from its first corner along its sides.
type Offset = (i64, i64);

/// The stencils of a regular mesh, by element.
type Stencils = BTreeMap<Element, BTreeMap<Offset, Rational>>;

/// A weight at the centre: of the centre or of an orbit of places, in all sectors or in one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Term {
    place: Option<(usize, usize)>,
    sector: Option<i64>,
    weight: Formula,
}

/// Stencils of the centre for some valences.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Centre {
    /// The valences; `None`: all but the regular one.
    pub valences: Option<BTreeSet<usize>>,
    /// By element: of the vertex itself, of the edge to the first neighbour, of the face in the first sector.
    pub stencils: BTreeMap<Element, Vec<Term>>,
}

/// A rule on meshes by stencils.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OwnRule {
    split: Split,
    regular: Stencils,
    centres: Vec<Centre>,
}

/// The weights of one new point at the centre by place and sector; `None` is the centre.
pub(super) type Row = Vec<(Option<(usize, usize)>, usize, Poly)>;

/// The ways of dividing faces for which stencils may be given, with the elements that get new points.
const SPLITS: [(&str, Split, &[Element]); 4] = [
    ("quads", Split::Quads, &[Element::Vertex, Element::Edge, Element::Face]),
    ("triangles", Split::Triangles, &[Element::Vertex, Element::Edge]),
    ("turned-quads", Split::TurnedQuads, &[Element::Vertex, Element::Face]),
    ("turned-triangles", Split::TurnedTriangles, &[Element::Vertex, Element::Face]),
];

impl OwnRule {
    /// The ways of dividing faces by name.
    #[must_use]
    pub fn splits() -> Vec<&'static str> {
        SPLITS.iter().map(|s| s.0).collect()
    }

    /// A rule without stencils for a way of dividing faces; `None` for an unknown name.
    #[must_use]
    pub fn new(split: &str) -> Option<Self> {
        let (_, split, _) = SPLITS.iter().find(|s| s.0 == split)?;
        Some(Self { split: *split, regular: Stencils::new(), centres: Vec::new() })
    }

    /// Loop's rule with weights of each neighbour in the vertex rule that depend on the valence.
    #[must_use]
    pub fn of_loop(weights: Vec<(Option<BTreeSet<usize>>, Formula)>) -> Self {
        let eighths = |p| ratio(p, 8);
        let near = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];
        let vertex = near.into_iter().map(|p| (p, ratio(1, 16))).chain([((0, 0), ratio(5, 8))]).collect();
        let ends = [(0, 0), (1, 0)].map(|p| (p, eighths(3)));
        let edge = ends.into_iter().chain([(0, 1), (1, -1)].map(|p| (p, eighths(1)))).collect();
        let centres = weights.into_iter().map(|(valences, weight)| {
            let rest = Formula::parse(&format!("1 - n*({})", weight.text())).unwrap_or_else(|_| weight.clone());
            let own = Term { place: None, sector: None, weight: rest };
            let near = Term { place: Some((1, 0)), sector: None, weight };
            Centre { valences, stencils: [(Element::Vertex, vec![own, near])].into() }
        });
        Self {
            split: Split::Triangles,
            regular: [(Element::Vertex, vertex), (Element::Edge, edge)].into(),
            centres: centres.collect(),
        }
    }

    /// The elements that get new points.
    #[must_use]
    pub fn elements(&self) -> &'static [Element] {
        SPLITS.iter().find(|s| s.1 == self.split).map_or(&[], |s| s.2)
    }

    fn triangles(&self) -> bool {
        self.split.sector() == Sector::Triangles
    }

    fn usual(&self) -> usize {
        if self.triangles() { 6 } else { 4 }
    }

    /// The places that a name or `"i,j"` stands for in a regular stencil: all images under the symmetries of the element.
    ///
    /// # Errors
    /// What is wrong with the name, in words.
    pub fn places(&self, element: Element, name: &str) -> Result<BTreeSet<(i64, i64)>, String> {
        let named: &[(&str, Offset)] = match (element, self.triangles()) {
            (Element::Vertex, false) => &[("vertex", (0, 0)), ("neighbours", (1, 0)), ("opposite", (1, 1))],
            (Element::Vertex, true) => &[("vertex", (0, 0)), ("neighbours", (1, 0))],
            (Element::Edge, false) => &[("ends", (0, 0)), ("sides", (0, 1)), ("beyond", (-1, 0))],
            (Element::Edge, true) => &[("ends", (0, 0)), ("sides", (0, 1)), ("wings", (1, 1)), ("beyond", (-1, 0))],
            (Element::Face, false) => &[("corners", (0, 0))],
            (Element::Face, true) => &[("corners", (0, 0)), ("across", (1, 1))],
        };
        let place = match named.iter().find(|(n, _)| *n == name) {
            Some((_, place)) => *place,
            None => pair::<i64>(name).filter(|(i, j)| i.abs().max(j.abs()) <= REACH).ok_or_else(|| {
                let names: Vec<&str> = named.iter().map(|n| n.0).collect();
                format!("`{name}` is no neighbour; there are {}, and places \"i,j\" up to {REACH}", names.join(", "))
            })?,
        };
        Ok(orbit(place, symmetries(element, self.triangles())))
    }

    /// Adds the weight of each of some places to a regular stencil.
    ///
    /// # Errors
    /// [`SchemeError::Mesh`] where one of them has a weight already.
    pub fn add(
        &mut self,
        element: Element,
        places: BTreeSet<(i64, i64)>,
        weight: &Rational,
    ) -> Result<(), SchemeError> {
        let stencil = self.regular.entry(element).or_default();
        for place in places {
            if stencil.insert(place, weight.clone()).is_some() {
                return Err(failure(format!(
                    "the {} stencil has two weights for one neighbour, or for its images",
                    element.key()
                )));
            }
        }
        Ok(())
    }

    /// A term of a stencil at the centre: `vertex`, `neighbours`, `opposite` or `"i,j"`, the places of all sectors; with `@m`
    /// behind it of the sector `m` from the own one only.
    ///
    /// # Errors
    /// What is wrong with the name, in words.
    pub fn term(&self, name: &str, weight: Formula) -> Result<Term, String> {
        let (name, sector) = match name.split_once('@') {
            Some((name, m)) => {
                let m: i64 = m.trim().parse().map_err(|_| format!("`{m}` is no number of a sector"))?;
                (name.trim(), Some(m))
            }
            None => (name, None),
        };
        let place = match name {
            "vertex" if sector.is_none() => None,
            "vertex" => return Err("the vertex lies in no sector".to_owned()),
            "neighbours" => Some((1, 0)),
            "opposite" => Some((1, 1)),
            _ => Some(pair::<usize>(name).filter(|(i, j)| (1..=REACH as usize).contains(i) && *j <= REACH as usize).ok_or_else(
                || format!("`{name}` is no neighbour; there are vertex, neighbours, opposite, and places \"i,j\" of a sector, i ≥ 1, j ≥ 0"),
            )?),
        };
        Ok(Term { place, sector, weight })
    }

    /// Adds stencils of the centre; the first that names a valence holds.
    pub fn add_centre(&mut self, centre: Centre) {
        self.centres.push(centre);
    }

    /// Whether all stencils are there and add up to 1, and which row of the table the rule is.
    pub(super) fn row(&self) -> Result<&'static RuleInfo, SchemeError> {
        for element in self.elements() {
            let stencil = self.regular.get(element);
            let stencil = stencil
                .ok_or_else(|| failure(format!("the stencil of the new point at a {} is missing", element.key())))?;
            let sum = stencil.values().fold(ratio(0, 1), |s, w| s + w);
            if sum != 1 {
                let key = element.key();
                return Err(failure(format!(
                    "the weights of the {key} stencil add up to {sum} with all images, not to 1"
                )));
            }
        }
        Ok(super::rules::own_row(self.split, self.spline()))
    }

    /// The spline that the regular stencils are.
    fn spline(&self) -> Option<Spline> {
        let is = |element: Element, weights: &[(&str, Rational)]| {
            let mut all = BTreeMap::new();
            for (name, weight) in weights {
                all.extend(self.places(element, name).unwrap_or_default().into_iter().map(|p| (p, weight.clone())));
            }
            let own = self
                .regular
                .get(&element)
                .map(|s| s.iter().filter(|(_, w)| **w != 0).map(|(p, w)| (*p, w.clone())).collect());
            own == Some(all)
        };
        let of = |p, q| ratio(p, q);
        match self.split {
            Split::Quads
                if is(
                    Element::Vertex,
                    &[("vertex", of(9, 16)), ("neighbours", of(3, 32)), ("opposite", of(1, 64))],
                ) && is(Element::Edge, &[("ends", of(3, 8)), ("sides", of(1, 16))])
                    && is(Element::Face, &[("corners", of(1, 4))]) =>
            {
                Some(Spline::Bicubic)
            }
            Split::Triangles
                if is(Element::Vertex, &[("vertex", of(5, 8)), ("neighbours", of(1, 16))])
                    && is(Element::Edge, &[("ends", of(3, 8)), ("sides", of(1, 8))]) =>
            {
                Some(Spline::Quartic)
            }
            _ => None,
        }
    }

    /// The stencils that hold at the centre at a valence.
    fn centre(&self, n: usize) -> Option<&Centre> {
        self.centres.iter().find(|c| match &c.valences {
            Some(list) => list.contains(&n),
            None => n != self.usual(),
        })
    }

    /// Whether the centre has stencils at a valence.
    pub(super) fn has_centre(&self, n: usize) -> bool {
        self.centre(n).is_some()
    }

    /// Whether points on edges or in faces have stencils of their own at the centre.
    pub(super) fn widened(&self) -> bool {
        self.centres.iter().any(|c| c.stencils.keys().any(|e| *e != Element::Vertex))
    }

    /// The same rule without stencils of the centre.
    pub(super) fn without_centre(&self) -> Self {
        Self { centres: Vec::new(), ..self.clone() }
    }

    /// The weights of a new point at the centre, checked; `None` where the regular stencil holds.
    pub(super) fn central(&self, element: Element, n: usize) -> Result<Option<Row>, SchemeError> {
        let Some(terms) = self.centre(n).and_then(|c| c.stencils.get(&element)) else { return Ok(None) };
        let field = Cosines::new(n);
        let mut sums: BTreeMap<(Option<(usize, usize)>, usize), Poly> = BTreeMap::new();
        for term in terms {
            let sectors: Vec<usize> = match (term.place, term.sector) {
                (None, _) => vec![0],
                (_, Some(m)) => vec![m.rem_euclid(n as i64) as usize],
                _ => (0..n).collect(),
            };
            for k in sectors {
                let weight = term.weight.over(&field, k as i64).map_err(failure)?;
                let sum = sums.entry((term.place, k)).or_default();
                *sum = &*sum + &weight;
            }
        }
        let modulus = cosine_polynomial(n);
        sums.values_mut().for_each(|w| *w = w.div_rem(&modulus).1);
        check(element, n, &sums)?;
        Ok(Some(sums.into_iter().filter(|(_, w)| !w.is_zero()).map(|((p, k), w)| (p, k, w)).collect()))
    }

    /// The stencils of the centre in one line.
    #[must_use]
    pub fn describe(&self) -> String {
        let term = |t: &Term| {
            let place = t.place.map_or("vertex".to_owned(), |(i, j)| format!("{i},{j}"));
            let sector = t.sector.map_or(String::new(), |m| format!("@{m}"));
            format!("{place}{sector}: {}", t.weight.text())
        };
        let stencil = |(e, terms): (&Element, &Vec<Term>)| {
            format!("{} ({})", e.key(), terms.iter().map(term).collect::<Vec<_>>().join("; "))
        };
        let centre = |c: &Centre| c.stencils.iter().map(stencil).collect::<Vec<_>>().join(", ");
        self.centres.iter().map(centre).collect::<Vec<_>>().join(" | ")
    }
}

pub(super) fn failure(message: String) -> SchemeError {
    SchemeError::Mesh { rule: "own".to_owned(), message }
}

/// The weights add up to 1, and are the same seen in a mirror (at the vertex itself from every sector as well).
fn check(
    element: Element,
    n: usize,
    sums: &BTreeMap<(Option<(usize, usize)>, usize), Poly>,
) -> Result<(), SchemeError> {
    let key = element.key();
    let total = sums.values().fold(Poly::zero(), |s, w| &s + w);
    let total = total.div_rem(&cosine_polynomial(n)).1;
    if total != Poly::constant(ratio(1, 1)) {
        let total = total.display("t");
        return Err(failure(format!(
            "at n = {n} the weights of the {key} at the centre add up to {total} (t = 2cos(2π/n)), not to 1"
        )));
    }
    let weight = |place: (usize, usize), k: i64| sums.get(&(Some(place), k.rem_euclid(n as i64) as usize));
    let zero = Poly::zero();
    for ((place, k), w) in sums {
        let (Some((i, j)), k) = (*place, *k as i64) else { continue };
        // The mirror takes the spoke s of an edge to −s, of a face to 1 − s; a place between spokes lies before its image.
        let first = i64::from(element == Element::Face);
        let image = if j == 0 { ((i, 0), first - k) } else { ((j, i), first - 1 - k) };
        let turned = (element == Element::Vertex).then_some(((i, j), k + 1));
        for (place, k) in [Some(image), turned].into_iter().flatten() {
            if weight(place, k).unwrap_or(&zero) != w {
                return Err(failure(format!(
                    "at n = {n} the weights of the {key} at the centre are not symmetric: those of {i},{j} and of its image differ"
                )));
            }
        }
    }
    Ok(())
}

/// Two numbers with a comma between them.
fn pair<T: std::str::FromStr>(text: &str) -> Option<(T, T)> {
    let (i, j) = text.split_once(',')?;
    Some((i.trim().parse().ok()?, j.trim().parse().ok()?))
}

type Symmetry = fn(Offset) -> Offset;

/// Generators of the symmetries of an element in its lattice.
fn symmetries(element: Element, triangles: bool) -> [Symmetry; 2] {
    match (element, triangles) {
        (Element::Vertex, false) => [|(i, j)| (-j, i), |(i, j)| (j, i)],
        (Element::Vertex, true) => [|(i, j)| (-j, i + j), |(i, j)| (j, i)],
        (Element::Edge, false) => [|(i, j)| (1 - i, j), |(i, j)| (i, -j)],
        (Element::Edge, true) => [|(i, j)| (1 - i, -j), |(i, j)| (i + j, -j)],
        (Element::Face, false) => [|(i, j)| (1 - j, i), |(i, j)| (j, i)],
        (Element::Face, true) => [|(i, j)| (1 - i - j, i), |(i, j)| (j, i)],
    }
}

fn orbit(place: Offset, generators: [Symmetry; 2]) -> BTreeSet<Offset> {
    let mut all = BTreeSet::from([place]);
    let mut queue = vec![place];
    while let Some(p) = queue.pop() {
        for image in generators.map(|g| g(p)) {
            if all.insert(image) {
                queue.push(image);
            }
        }
    }
    all
}

/// The own rule in a rule.
impl MeshRule {
    /// The stencils of one's own that make this rule.
    #[must_use]
    pub fn own(&self) -> Option<&OwnRule> {
        self.own_stencils().map(AsRef::as_ref)
    }
}
