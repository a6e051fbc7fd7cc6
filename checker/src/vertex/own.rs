//! Rules by stencils of one's own: weights of named neighbours of a vertex, an edge and a face where all is regular, and at the
//! centre as formulas (docs/case-format.md).

use super::ball::Ball;
use super::case::read_valences;
use super::formula::{Waves, Weight, cyclotomic};
use super::mesh::{Place, locate};
use super::rule::{Lattice, Mask, Stencils, Terms, steps};
use crate::base::{Checked, Json, Node, Q, need, number, reject, some, whole};
use num_traits::{One, Zero};
use std::collections::{BTreeMap, BTreeSet};

/// Points that a stencil may reach in each direction.
const REACH: i64 = 8;

/// What new points lie at, by its key.
const ELEMENTS: [&str; 3] = ["vertex", "edge", "face"];

/// A weight at the centre: of the centre or of a place, in all sectors or in one.
#[derive(Debug, Clone)]
struct Term {
    place: Option<Place>,
    sector: Option<i64>,
    weight: Weight,
}

/// Stencils of the centre for some valences, or for all but the regular one.
#[derive(Debug, Clone)]
struct Centre {
    valences: Option<BTreeSet<usize>>,
    stencils: BTreeMap<usize, Vec<Term>>,
}

/// A rule by stencils: of vertices, of edges, and of quadrangles.
#[derive(Debug, Clone)]
pub struct Own {
    triangles: bool,
    regular: Vec<Mask>,
    centres: Vec<Centre>,
}

/// The keys and values of a table.
fn entries<'a>(node: &Node<'a>) -> Checked<Vec<(&'a str, Node<'a>)>> {
    let Json::Object(fields) = node.value else { return node.reject("format", "a table is needed here") };
    fields.iter().map(|(key, _)| Ok((key.as_str(), node.field(key)?))).collect()
}

/// `i,j`.
fn pair(text: &str) -> Option<Place> {
    let (i, j) = text.split_once(',')?;
    Some((i.trim().parse().ok()?, j.trim().parse().ok()?))
}

/// The images of a place under the symmetries of an element: of a vertex with its edges as axes, of an edge from its first end along
/// it, of a face from its first corner along its sides.
fn images(element: usize, triangles: bool, place: Place) -> BTreeSet<Place> {
    let generators: [fn(Place) -> Place; 2] = match (element, triangles) {
        (0, false) => [|(i, j)| (-j, i), |(i, j)| (j, i)],
        (0, true) => [|(i, j)| (-j, i + j), |(i, j)| (j, i)],
        (1, false) => [|(i, j)| (1 - i, j), |(i, j)| (i, -j)],
        (1, true) => [|(i, j)| (1 - i, -j), |(i, j)| (i + j, -j)],
        _ => [|(i, j)| (1 - j, i), |(i, j)| (j, i)],
    };
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

/// The place of a neighbour by name.
fn named(element: usize, triangles: bool, name: &str) -> Option<Place> {
    let known = match (element, triangles, name) {
        (0, _, "vertex") | (1, _, "ends") | (2, false, "corners") => Some((0, 0)),
        (0, _, "neighbours") => Some((1, 0)),
        (0, false, "opposite") | (1, true, "wings") => Some((1, 1)),
        (1, _, "sides") => Some((0, 1)),
        (1, _, "beyond") => Some((-1, 0)),
        _ => pair(name),
    };
    known.filter(|(i, j)| i.abs().max(j.abs()) <= REACH)
}

impl Own {
    /// Reads `mesh = "own"`; only rules whose steps do not turn the mesh.
    pub fn read(table: &Node<'_>) -> Checked<Self> {
        let triangles = match table.field("split")?.text()? {
            "quads" => false,
            "triangles" => true,
            _ => return table.reject("format", "a way of dividing faces for which there are no certificates"),
        };
        let elements = &ELEMENTS[..if triangles { 2 } else { 3 }];
        let stencils = table.field("stencil")?;
        stencils.known(&elements.join(" "))?;
        let mut regular = Vec::new();
        for (element, key) in elements.iter().enumerate() {
            let mut mask = Mask::new();
            for (name, weight) in entries(&stencils.field(key)?)? {
                let place = weight.some(named(element, triangles, name), "format", "no such neighbour")?;
                for image in images(element, triangles, place) {
                    let before = mask.insert(image, number(&weight)?);
                    weight.need(before.is_none(), "format", "two weights for one neighbour")?;
                }
            }
            let sum: Q = mask.values().sum();
            stencils.need(sum.is_one(), "case", "the weights of a stencil do not add up to 1")?;
            mask.retain(|_, w| !w.is_zero());
            regular.push(mask);
        }
        let centres = match table.get("centre") {
            None => Vec::new(),
            Some(node) if matches!(node.value, Json::List(_)) => {
                node.list()?.iter().map(|c| Centre::read(c, elements)).collect::<Checked<_>>()?
            }
            Some(node) => vec![Centre::read(&node, elements)?],
        };
        Ok(Self { triangles, regular, centres })
    }

    /// Loop's rule with weights of each neighbour of the centre, given by a formula or a table by valence.
    pub fn of_loop(node: &Node<'_>) -> Checked<Self> {
        let part = |p: i64, q: i64| whole(p) / whole(q);
        let mask = |element, all: &[(Place, Q)]| -> Mask {
            let each = all.iter().flat_map(|(p, w)| images(element, true, *p).into_iter().map(move |p| (p, w.clone())));
            each.collect()
        };
        let vertex = mask(0, &[((0, 0), part(5, 8)), ((1, 0), part(1, 16))]);
        let edge = mask(1, &[((0, 0), part(3, 8)), ((0, 1), part(1, 8))]);
        let centre = |valences, weight: Weight| {
            let own = Term { place: None, sector: None, weight: Weight::Rest(Box::new(weight.clone())) };
            let near = Term { place: Some((1, 0)), sector: None, weight };
            Centre { valences, stencils: BTreeMap::from([(0, vec![own, near])]) }
        };
        let (mut centres, mut rest) = (Vec::new(), None);
        if matches!(node.value, Json::Object(_)) {
            for (key, weight) in entries(node)? {
                let read = Weight::read(&weight)?;
                if key == "else" {
                    rest = Some(read);
                    continue;
                }
                let list = read_valences(&Node { value: &Json::Text(key.to_owned()), place: String::new() })?;
                centres.push(centre(Some(weight.some(list, "format", "no list of valences")?), read));
            }
        } else {
            rest = Some(Weight::read(node)?);
        }
        // The weight holds at the regular valence too.
        if let Some(weight) = rest {
            centres.extend([centre(Some(BTreeSet::from([6])), weight.clone()), centre(None, weight)]);
        }
        Ok(Self { triangles: true, regular: vec![vertex, edge], centres })
    }

    /// The rule where all is regular.
    pub fn lattice(&self) -> Lattice {
        let mut mask = Mask::new();
        let directions = if self.triangles { 3 } else { 2 };
        let mut lay = |element: usize, at: Place, u: Place, v: Place| {
            // The new point lies at `at` in the finer lattice.
            for ((i, j), weight) in &self.regular[element] {
                let q = (i * u.0 + j * v.0, i * u.1 + j * v.1);
                mask.insert((at.0 - 2 * q.0, at.1 - 2 * q.1), weight.clone());
            }
        };
        lay(0, (0, 0), (1, 0), (0, 1));
        for k in 0..directions {
            let all = steps(self.triangles);
            lay(1, all[k], all[k], all[k + 1]);
        }
        if !self.triangles {
            lay(2, (1, 1), (1, 0), (0, 1));
        }
        Lattice { triangles: self.triangles, factor: 2, mask }
    }

    /// The rule at a vertex, with the powers of `e^(2πi/n)`.
    pub fn stencils(&self, powers: &[Ball]) -> Checked<Stencils> {
        let n = powers.len();
        let usual = n == if self.triangles { 6 } else { 4 };
        let holds = |c: &&Centre| match &c.valences {
            Some(list) => list.contains(&n),
            None => !usual,
        };
        let own = self.centres.iter().find(holds);
        let mut all = BTreeMap::new();
        for (element, terms) in own.iter().flat_map(|c| &c.stencils) {
            all.insert(*element, central(*element, terms, powers)?);
        }
        let centre = match all.remove(&0) {
            Some(terms) => terms,
            None => {
                let alone = self.regular[0].keys().all(|p| *p == (0, 0));
                need(usual || alone, "case", "the vertex stencil reaches around the centre")?;
                let regular = self.regular[0].iter();
                regular.map(|(p, w)| (locate(self.triangles, false, *p), Ball::real(w))).collect()
            }
        };
        let mut special = BTreeMap::new();
        for (element, terms) in all {
            special.insert(if element == 1 { (1, 0) } else { (1, 1) }, terms);
        }
        Ok(Stencils { lattice: self.lattice(), special, centre, usual, strict: !usual })
    }
}

impl Centre {
    fn read(node: &Node<'_>, elements: &[&str]) -> Checked<Self> {
        node.known(&format!("valence {}", elements.join(" ")))?;
        let valences = match node.get("valence") {
            None => None,
            Some(list) => Some(list.some(read_valences(&list)?, "format", "`all` is no list of valences")?),
        };
        let mut stencils = BTreeMap::new();
        for (element, key) in elements.iter().enumerate() {
            let Some(stencil) = node.get(key) else { continue };
            let terms = entries(&stencil)?.into_iter().map(|(name, weight)| weight.at(Term::read(name, &weight)));
            stencils.insert(element, terms.collect::<Checked<_>>()?);
        }
        Ok(Self { valences, stencils })
    }
}

impl Term {
    fn read(name: &str, weight: &Node<'_>) -> Checked<Self> {
        let (name, sector) = match name.split_once('@') {
            Some((name, m)) => (name.trim(), Some(some(m.trim().parse().ok(), "format", "no number of a sector")?)),
            None => (name, None),
        };
        let place = match name {
            "vertex" if sector.is_none() => None,
            "neighbours" => Some((1, 0)),
            "opposite" => Some((1, 1)),
            _ => {
                let found = pair(name).filter(|(i, j)| (1..=REACH).contains(i) && (0..=REACH).contains(j));
                Some(some(found, "format", "no such neighbour of the centre")?)
            }
        };
        Ok(Self { place, sector, weight: Weight::read(weight)? })
    }
}

/// The stencil of a new point at the centre; its weights add up to 1, and are the same seen in a mirror, at the vertex itself also
/// from every sector.
fn central(element: usize, terms: &[Term], powers: &[Ball]) -> Checked<Terms> {
    let n = powers.len();
    let count = n as i64;
    let mut sums: BTreeMap<(Option<Place>, i64), Waves> = BTreeMap::new();
    let zero = Waves::rational(n, Q::zero());
    for term in terms {
        let sectors: Vec<i64> = match (term.place, term.sector) {
            (None, _) => vec![0],
            (_, Some(m)) => vec![m.rem_euclid(count)],
            _ => (0..count).collect(),
        };
        for k in sectors {
            let weight = term.weight.at(n, k)?;
            let sum = sums.entry((term.place, k)).or_insert_with(|| zero.clone());
            *sum = sum.plus(&weight);
        }
    }
    let cyclotomic = cyclotomic(n)?;
    let one = Waves::rational(n, Q::one());
    let rest = sums.values().fold(one, |rest, w| rest.minus(w));
    need(rest.vanishes(&cyclotomic)?, "case", "the weights at the centre do not add up to 1")?;
    for ((place, k), weight) in &sums {
        let Some((i, j)) = *place else { continue };
        // The mirror takes the spoke s of an edge to −s, of a face to 1 − s; a place between spokes lies before its image.
        let first = i64::from(element == 2);
        let image = if j == 0 { ((i, 0), first - k) } else { ((j, i), first - 1 - k) };
        let turned = (element == 0).then_some(((i, j), k + 1));
        for (place, k) in std::iter::once(image).chain(turned) {
            let other = match sums.get(&(Some(place), k.rem_euclid(count))) {
                Some(other) => other,
                None => &zero,
            };
            let same = weight.minus(other).vanishes(&cyclotomic)?;
            need(same, "case", "the weights at the centre are not symmetric")?;
        }
    }
    let term = |((place, k), weight): (&(Option<Place>, i64), &Waves)| (place.map(|p| (p, *k)), weight.ball(powers));
    match sums.is_empty() {
        true => reject("case", "a stencil without weights"),
        false => Ok(sums.iter().map(term).collect()),
    }
}
