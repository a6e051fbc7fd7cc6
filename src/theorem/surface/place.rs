//! Where the points of a patch lie in its parameters, and all addresses of a point (theory §9, Surfaces).
//!
//! A quadrangle is `[0, 1]²`, a triangle is `u, v ≥ 0, u + v ≤ 1`; its pieces divide it evenly. In a valid complex the map
//! from the parameters to the attractor is well defined and continuous, and the addresses of a parameter are the paths
//! through the cells that contain it.

use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Complex, Layout};
use crate::theorem::NoChart;

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

/// The corners of a subcell in the parameters of its patch, in the order of the division.
fn cell_corners(layout: Layout, letter: usize) -> Vec<Param> {
    let fraction = |a: usize, b: usize| Rational::from(a) / Rational::from(b);
    match layout {
        Layout::Quad { columns, rows } => {
            let (i, j) = (letter % columns, letter / columns);
            let node = |a: usize, b: usize| [fraction(i + a, columns), fraction(j + b, rows)];
            vec![node(0, 0), node(1, 0), node(1, 1), node(0, 1)]
        }
        Layout::Triangle => {
            let halves = [
                [(0, 0), (1, 0), (0, 1)],
                [(1, 0), (2, 0), (1, 1)],
                [(0, 1), (1, 1), (0, 2)],
                [(1, 1), (0, 1), (1, 0)],
            ];
            halves[letter].iter().map(|&(u, v)| [fraction(u, 2), fraction(v, 2)]).collect()
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
}

impl<'a> Chart<'a> {
    /// The chart, where the sides of all faces that are reached are given, they are divided in both directions, their pieces are
    /// faces, and every piece is placed by a symmetry of its subcell; a reason where not. The identities are taken as checked.
    ///
    /// # Errors
    /// What is not so.
    pub fn new(complex: &'a Complex) -> Result<Self, NoChart> {
        let shape = &complex.shape;
        let chart = Self { complex };
        for e in shape.reachable() {
            let state = &shape.states[e];
            if state.kind != CellKind::Face {
                continue;
            }
            let Some(face) = complex.faces.get(&e) else {
                return Err(NoChart::Sides { state: e });
            };
            if matches!(face.layout, Layout::Quad { columns, rows } if columns.min(rows) < 2) {
                return Err(NoChart::Shrinking { state: e });
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
        let cell = cell_corners(face.layout, letter);
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

    /// `1/N`, where these states are all divided into `N` parts along every side.
    pub fn share(&self, states: &[usize]) -> Option<Rational> {
        let parts = |&e: &usize| match self.layout(e) {
            Layout::Quad { columns, rows } => (columns == rows).then_some(columns),
            Layout::Triangle => Some(2),
        };
        let first = parts(states.first()?)?;
        states.iter().all(|e| parts(e) == Some(first)).then(|| Rational::from(1) / Rational::from(first))
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
