//! Where the points of a patch lie in its parameters, and all addresses of a point (theory §9, Surfaces).
//!
//! A quadrangle is `[0, 1]²`, a triangle is `u, v ≥ 0, u + v ≤ 1`; its pieces divide it evenly, or a quadrangle as its sides are
//! divided by the shares of their pieces. In a valid complex the map from the parameters to the attractor is well defined and
//! continuous, and the addresses of a parameter are the paths through the cells that contain it.

use crate::arith::{Rational, abs};
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Complex, Face, Layout};
use crate::theorem::NoChart;
use crate::theorem::frames::component;
use std::collections::BTreeMap;

/// Parameters of a point.
pub type Param = [Rational; 2];

/// Cells that may be visited in search of all addresses of a point.
const MAX_STEPS: usize = 20_000;

/// Where a point lies in the patch of the start state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Spot {
    /// A corner, by its number.
    Corner(usize),
    /// Inside a side, by its number.
    Side(usize),
    /// Inside the patch.
    Inside,
    /// The point of a branch of a shape whose other addresses are not looked at.
    Branch,
}

/// The corners of a patch in its own parameters.
#[must_use]
pub fn corners(layout: Layout) -> Vec<Param> {
    let at = |u: u8, v: u8| [Rational::from(u), Rational::from(v)];
    match layout {
        Layout::Quad { .. } => vec![at(0, 0), at(1, 0), at(1, 1), at(0, 1)],
        Layout::Triangle => vec![at(0, 0), at(1, 0), at(0, 1)],
    }
}

/// Where the sides of a patch are cut, along `u` and along `v`: numbers from 0 to 1.
type Cuts = [Vec<Rational>; 2];

/// Where a patch is cut: in equal parts, or in the shares of its sides, which have to be the same on opposite ones; `None` where they
/// are not, or a triangle has shares.
fn cuts(complex: &Complex, face: &Face) -> Option<Cuts> {
    let half = Rational::from(1) / Rational::from(2);
    let ends = |middle: Vec<Rational>| [vec![Rational::from(0)], middle, vec![Rational::from(1)]].concat();
    let Layout::Quad { columns, rows } = face.layout else {
        return (!has_shares(complex, face)).then(|| [ends(vec![half.clone()]), ends(vec![half])]);
    };
    let along = |side: usize, parts: usize| {
        let edge = &complex.shape.states[face.sides.get(side)?.edge];
        (edge.pieces.len() == parts).then(|| ends((1..parts).map(|i| edge.before(i)).collect()))
    };
    let (bottom, top) = (along(0, columns)?, along(2, columns)?);
    let (right, left) = (along(1, rows)?, along(3, rows)?);
    (bottom == top && left == right).then_some([bottom, left])
}

/// Whether a piece of a side has a share of its own.
fn has_shares(complex: &Complex, face: &Face) -> bool {
    let edges = face.sides.iter().map(|side| &complex.shape.states[side.edge]);
    edges.flat_map(|edge| &edge.pieces).any(|p| p.share.is_some())
}

/// The corners of a subcell in the parameters of its patch, in the order of the division.
fn cell_corners(layout: Layout, [across, up]: &Cuts, letter: usize) -> Vec<Param> {
    let node = |i: usize, j: usize| [across[i].clone(), up[j].clone()];
    match layout {
        Layout::Quad { columns, .. } => {
            let (i, j) = (letter % columns, letter / columns);
            vec![node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
        }
        Layout::Triangle => {
            let halves = [
                [(0, 0), (1, 0), (0, 1)],
                [(1, 0), (2, 0), (1, 1)],
                [(0, 1), (1, 1), (0, 2)],
                [(1, 1), (0, 1), (1, 0)],
            ];
            halves[letter].iter().map(|&(i, j)| node(i, j)).collect()
        }
    }
}

/// An affine map of the parameters: `p + x a + y b`.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Affine {
    p: Param,
    a: Param,
    b: Param,
}

impl Affine {
    fn identity() -> Self {
        let at = |u: u8, v: u8| [Rational::from(u), Rational::from(v)];
        Self { p: at(0, 0), a: at(1, 0), b: at(0, 1) }
    }

    fn apply(&self, x: &Param) -> Param {
        [0, 1].map(|k| &self.p[k] + &x[0] * &self.a[k] + &x[1] * &self.b[k])
    }

    /// The map whose linear part and shift are those of `self ∘ inner`.
    fn after(&self, inner: &Self) -> Self {
        let linear = |x: &Param| [0, 1].map(|k| &x[0] * &self.a[k] + &x[1] * &self.b[k]);
        Self { p: self.apply(&inner.p), a: linear(&inner.a), b: linear(&inner.b) }
    }

    /// The `x` with `apply(x) = y`.
    fn solve(&self, y: &Param) -> Option<Param> {
        let det = &self.a[0] * &self.b[1] - &self.a[1] * &self.b[0];
        if det == 0 {
            return None;
        }
        let d = [&y[0] - &self.p[0], &y[1] - &self.p[1]];
        Some([(&d[0] * &self.b[1] - &d[1] * &self.b[0]) / &det, (&self.a[0] * &d[1] - &self.a[1] * &d[0]) / det])
    }

    fn fixed_point(&self) -> Option<Param> {
        let one = Rational::from(1);
        let shifted = Self {
            p: self.p.clone(),
            a: [&self.a[0] - &one, self.a[1].clone()],
            b: [self.b[0].clone(), &self.b[1] - &one],
        };
        shifted.solve(&[Rational::from(0), Rational::from(0)])
    }
}

/// The parameters of the faces of a complex.
pub struct Chart<'a> {
    complex: &'a Complex,
    /// By face that is reached.
    cuts: BTreeMap<usize, Cuts>,
}

impl<'a> Chart<'a> {
    /// The chart, where the sides of all faces that are reached are given, they are divided in both directions, their pieces are
    /// faces, and every piece is placed by a symmetry of its subcell, without a turn where sides are divided by shares; a reason where
    /// not. The identities are taken as checked.
    ///
    /// # Errors
    /// What is not so.
    pub fn new(complex: &'a Complex) -> Result<Self, NoChart> {
        let shape = &complex.shape;
        let faces: Vec<usize> =
            shape.reachable().into_iter().filter(|e| shape.states[*e].kind == CellKind::Face).collect();
        let mut chart = Self { complex, cuts: BTreeMap::new() };
        for &e in &faces {
            let face = complex.faces.get(&e).ok_or(NoChart::Sides { state: e })?;
            chart.cuts.insert(e, cuts(complex, face).ok_or(NoChart::Shares { state: e })?);
        }
        let own = faces.iter().any(|e| has_shares(complex, &complex.faces[e]));
        for e in faces {
            let state = &shape.states[e];
            let face = &complex.faces[&e];
            if matches!(face.layout, Layout::Quad { columns, rows } if columns.min(rows) < 2) {
                return Err(NoChart::Shrinking { state: e });
            }
            let turned = face.placement.iter().any(|p| !p.is_sorted());
            if own && turned {
                return Err(NoChart::Shares { state: e });
            }
            for letter in 0..state.pieces.len() {
                let target = state.pieces[letter].target;
                let fits = complex.faces.get(&target).is_some_and(|inside| {
                    inside.layout.corners() == face.layout.corners() && chart.is_symmetry(e, letter)
                });
                if !fits {
                    return Err(NoChart::Symmetry { state: e, letter });
                }
            }
        }
        Ok(chart)
    }

    /// How a face is divided.
    pub fn layout(&self, state: usize) -> Layout {
        self.complex.faces[&state].layout
    }

    /// The corners of the cell of a piece, in the order of its own state, in the parameters of the patch it divides.
    pub fn piece_corners(&self, state: usize, letter: usize) -> Vec<Param> {
        let face = &self.complex.faces[&state];
        let cell = cell_corners(face.layout, &self.cuts[&state], letter);
        match face.placement.get(letter) {
            Some(placement) => placement.iter().map(|&k| cell[k].clone()).collect(),
            None => cell,
        }
    }

    fn map(&self, state: usize, letter: usize) -> Affine {
        let c = self.piece_corners(state, letter);
        let last = c.len() - 1;
        let edge = |k: usize| [&c[k][0] - &c[0][0], &c[k][1] - &c[0][1]];
        Affine { p: c[0].clone(), a: edge(1), b: edge(last) }
    }

    /// The corners of a face in its own parameters.
    pub fn corners(&self, state: usize) -> Vec<Param> {
        corners(self.layout(state))
    }

    /// The map of the parameters that places a piece, on columns `1, u, v`.
    pub fn placement(&self, state: usize, letter: usize) -> Matrix {
        let Affine { p, a, b } = self.map(state, letter);
        let column = |first: u8, x: Param| [vec![Rational::from(first)], x.into()].concat();
        Matrix::from_columns(3, &[column(1, p), column(0, a), column(0, b)])
    }

    /// `1/N`, where every piece of these states from which its state can be reached again is placed by `x ↦ U x / N + p`, `U` a turn
    /// or a reflection of its patch.
    pub fn share(&self, states: &[usize]) -> Option<Rational> {
        let shape = &self.complex.shape;
        let mut share = None;
        for &e in states {
            let own = component(shape, e);
            let pieces = shape.states[e].pieces.iter().enumerate();
            for (letter, _) in pieces.filter(|(_, p)| own.contains(&p.target)) {
                let size = self.size(e, letter)?;
                if share.get_or_insert_with(|| size.clone()) != &size {
                    return None;
                }
            }
        }
        share
    }

    /// The factor by which a piece shrinks the parameters, where that is all it does but for a symmetry.
    fn size(&self, state: usize, letter: usize) -> Option<Rational> {
        let Affine { a, b, .. } = self.map(state, letter);
        let entries: Vec<Rational> = a.iter().chain(&b).map(abs).collect();
        let size = entries.iter().max()?.clone();
        let det = abs(&(&a[0] * &b[1] - &a[1] * &b[0]));
        (entries.iter().all(|x| *x == 0 || *x == size) && det == &size * &size && size > 0).then_some(size)
    }

    /// Whether all corners of a piece lie where the affine map through three of them has them.
    fn is_symmetry(&self, state: usize, letter: usize) -> bool {
        let map = self.map(state, letter);
        let own = corners(self.layout(state));
        own.iter().zip(self.piece_corners(state, letter)).all(|(x, y)| map.apply(x) == y)
    }

    /// The parameters of an address of a state.
    pub fn locate(&self, start: usize, address: &Address) -> Option<Param> {
        let shape = &self.complex.shape;
        let along = |from: usize, word: &[usize]| {
            let states = shape.path(from, word);
            word.iter().zip(&states).fold(Affine::identity(), |m, (&i, &e)| m.after(&self.map(e, i)))
        };
        let state = *shape.path(start, &address.prefix).last()?;
        Some(along(start, &address.prefix).apply(&along(state, &address.cycle).fixed_point()?))
    }

    /// All addresses of a parameter, or `None` where there are too many cells on the way.
    ///
    /// There are finitely many: a point on the boundary of a cell lies between two of its pieces at most once.
    pub fn addresses(&self, start: usize, param: &Param) -> Option<Vec<Address>> {
        let shape = &self.complex.shape;
        let mut found: Vec<Address> = Vec::new();
        let mut open = vec![(vec![(start, param.clone())], Vec::<usize>::new())];
        let mut steps = 0;
        while let Some((nodes, word)) = open.pop() {
            steps += 1;
            if steps > MAX_STEPS {
                return None;
            }
            let (state, here) = nodes.last()?.clone();
            if let Some(k) = nodes[..nodes.len() - 1].iter().position(|n| *n == (state, here.clone())) {
                let address = Address { prefix: word[..k].to_vec(), cycle: word[k..].to_vec() };
                let address = address.normalise(shape, start).ok()?;
                if !found.contains(&address) {
                    found.push(address);
                }
                continue;
            }
            for (letter, piece) in shape.states[state].pieces.iter().enumerate().rev() {
                let local = self.map(state, letter).solve(&here)?;
                if contains(self.layout(piece.target), &local) {
                    let mut nodes = nodes.clone();
                    nodes.push((piece.target, local));
                    open.push((nodes, [word.as_slice(), &[letter]].concat()));
                }
            }
        }
        Some(found)
    }

    /// Where a parameter lies in a patch.
    pub fn spot(&self, state: usize, param: &Param) -> Spot {
        let layout = self.layout(state);
        let own = corners(layout);
        if let Some(k) = own.iter().position(|c| c == param) {
            return Spot::Corner(k);
        }
        let on = |&(a, b): &(usize, usize)| cross(&own[a], &own[b], param) == 0;
        layout.sides().iter().position(on).map_or(Spot::Inside, Spot::Side)
    }

    /// The nodes of the division of a patch to a level, each once.
    pub fn nodes(&self, state: usize, level: usize) -> Vec<Param> {
        let mut cells = vec![(state, Affine::identity())];
        for _ in 0..level {
            cells = cells
                .iter()
                .flat_map(|(e, m)| {
                    let pieces = self.complex.shape.states[*e].pieces.iter().enumerate();
                    pieces.map(|(i, p)| (p.target, m.after(&self.map(*e, i)))).collect::<Vec<_>>()
                })
                .collect();
        }
        let mut nodes: Vec<Param> = Vec::new();
        for (e, m) in &cells {
            for corner in corners(self.layout(*e)) {
                let node = m.apply(&corner);
                if !nodes.contains(&node) {
                    nodes.push(node);
                }
            }
        }
        nodes
    }

    /// The nodes inside a patch, of the first level that has any.
    pub fn inner_nodes(&self, state: usize) -> Vec<Param> {
        for level in 1..=3 {
            let inside = |p: &Param| self.spot(state, p) == Spot::Inside;
            let nodes: Vec<Param> = self.nodes(state, level).into_iter().filter(inside).collect();
            if !nodes.is_empty() {
                return nodes;
            }
        }
        Vec::new()
    }
}

fn contains(layout: Layout, p: &Param) -> bool {
    let one = Rational::from(1);
    match layout {
        Layout::Quad { .. } => p.iter().all(|x| *x >= 0 && *x <= one),
        Layout::Triangle => p.iter().all(|x| *x >= 0) && &p[0] + &p[1] <= one,
    }
}

/// Twice the area of the triangle `a, b, p`.
fn cross(a: &Param, b: &Param, p: &Param) -> Rational {
    (&b[0] - &a[0]) * (&p[1] - &a[1]) - (&b[1] - &a[1]) * (&p[0] - &a[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::{bspline, mesh_rule, patch, tensor};

    #[test]
    fn a_vertex_of_a_quadrangle_has_a_branch_in_each_patch() {
        let complex = patch(&mesh_rule("catmull-clark", &[].into()).unwrap(), 4).unwrap();
        let chart = Chart::new(&complex).unwrap();
        let start = complex.shape.start;
        let half = Rational::from(1) / Rational::from(2);
        let centre = chart.addresses(start, &[half.clone(), half.clone()]).unwrap();
        let text: Vec<String> = centre.iter().map(ToString::to_string).collect();
        assert_eq!(text, ["0(3)", "1(2)", "2(1)", "3(0)"]);
        let side = chart.addresses(start, &[half, Rational::from(0)]).unwrap();
        assert_eq!(side.len(), 2);
        assert_eq!(chart.nodes(start, 1).len(), 9);
        assert_eq!(chart.inner_nodes(start).len(), 1);
        let third = Address::parse("(03)").unwrap();
        let param = chart.locate(start, &third).unwrap();
        assert_eq!(param[0], Rational::from(1) / Rational::from(3));
        assert_eq!(chart.addresses(start, &param).unwrap(), vec![third]);
    }

    #[test]
    fn a_vertex_of_triangles_has_six_branches() {
        let complex = patch(&mesh_rule("loop", &[].into()).unwrap(), 6).unwrap();
        let chart = Chart::new(&complex).unwrap();
        let start = complex.shape.start;
        let inner = chart.inner_nodes(start);
        assert_eq!(inner.len(), 3);
        for node in &inner {
            assert_eq!(chart.addresses(start, node).unwrap().len(), 6);
        }
    }

    #[test]
    fn all_addresses_of_a_parameter_are_the_same_point() {
        let curve = bspline(2, 2).unwrap().curve_with_vertices().unwrap();
        let complex = tensor(&curve, &curve).unwrap();
        let chart = Chart::new(&complex).unwrap();
        let start = complex.shape.start;
        for text in ["0(3)", "12(10)", "03(21)", "(0)", "3(12)"] {
            let address = Address::parse(text).unwrap().normalise(&complex.shape, start).unwrap();
            let all = chart.addresses(start, &chart.locate(start, &address).unwrap()).unwrap();
            assert!(all.contains(&address), "{text}: {all:?}");
            let point = complex.shape.point(start, &address);
            assert!(all.iter().all(|a| complex.shape.point(start, a) == point), "{text}");
        }
    }
}
