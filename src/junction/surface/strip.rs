//! The joined surface: three columns and two rows of faces, with all edges and vertices.

use super::family::SurfaceJunction;
use super::grid::Grid;
use super::{FaceSide, SurfaceError};
use crate::arith::Rational;
use crate::junction::array::{curve, vertex};
use crate::linalg::Matrix;
use crate::scheme::tensor;
use crate::shape::{Boundary, CellKind, Complex, Face, Frame, Layout, Piece, Shape, Side, State};
use std::collections::BTreeMap;

/// Cells of the joined surface along the border.
pub(super) const ROWS: usize = 2;

/// The states, in this order; those of both schemes are a face, its edges across and along the border, and a vertex.
const WHOLE: usize = 0;
const FACE: usize = 1;
const ACROSS: usize = 2;
const WIDE: usize = 3;
const OUTER: [usize; 2] = [4, 5];
const CORNERS: [usize; 2] = [6, 7];
const SCHEMES: [usize; 2] = [8, 12];
const NAMES: [[&str; 4]; 2] = [["D", "Dh", "Dv", "d"], ["C", "Ch", "Cv", "c"]];

/// What a strip is made of.
struct Strip<'a> {
    family: &'a SurfaceJunction,
    /// The points of the joined surface, and of the faces of both schemes.
    whole: Grid,
    schemes: [Grid; 2],
}

/// An edge across the border: its points, its pieces by kind and first column, its vertices.
struct Edge {
    name: &'static str,
    points: Grid,
    columns: Vec<(usize, usize)>,
    ends: [usize; 2],
}

impl SurfaceJunction {
    /// The joined surface: a start state of three columns `D`, `I`, `C` and two rows of faces on shared points, and all that they lead
    /// to. With `precise` stencils the edges across the border are divided as their positions are.
    ///
    /// # Errors
    /// [`SurfaceError`] where stencils do not fit.
    pub fn complex(&self, stencils: &[Vec<Rational>], precise: bool) -> Result<Complex, SurfaceError> {
        let [n, m] = [self.left.across.points(), self.right.across.points()];
        let of = |columns: [usize; 2], cells| Grid::new(self.heights, columns, cells);
        let strip = Strip { family: self, whole: of([n, m], ROWS), schemes: [of([n, 0], 1), of([0, m], 1)] };
        strip.complex(stencils, precise)
    }
}

impl Strip<'_> {
    fn complex(&self, stencils: &[Vec<Rational>], precise: bool) -> Result<Complex, SurfaceError> {
        let family = self.family;
        let (net, edge_net) = (family.array(stencils, false)?, family.array(stencils, true)?);
        let [left, right] = [0, 1].map(|kind| scheme(family.side(kind), SCHEMES[kind], NAMES[kind]));
        let (left, right) = (left?, right?);
        let mut faces: BTreeMap<usize, Face> = left.1.into_iter().chain(right.1).collect();
        faces.insert(WHOLE, self.face(&self.whole, WIDE, OUTER, 3));
        let own = [SCHEMES[0] + 2, SCHEMES[1] + 2];
        faces.insert(FACE, self.face(&family.face, ACROSS, own, self.columns().len()));
        let shares = |own: bool, parts: Vec<Rational>| parts.into_iter().map(|s| own.then_some(s)).collect();
        let mut states = vec![self.whole_state(), self.face_state(&net)];
        let divided = precise && family.length() != 1;
        let (inner, outer) = family.shares();
        let edge_op = |part: &Grid, first: usize| window(&edge_net, &family.net.over(0).window(first, part, 0));
        let inside = Edge { name: "J", points: family.face.over(0), columns: self.columns(), ends: own.map(|e| e + 1) };
        states.push(self.edge(inside, shares(divided, inner), edge_op));
        let flat = self.whole.over(0);
        let whole_op = |part: &Grid, first: usize| flat.inclusion(first, part, 0);
        let around = Edge { name: "S", points: flat.clone(), columns: self.three().to_vec(), ends: CORNERS };
        states.push(self.edge(around, shares(divided, outer), whole_op));
        for kind in 0..2 {
            states.push(self.outer(kind));
        }
        for kind in 0..2 {
            states.push(self.corner(kind));
        }
        states.extend(left.0);
        states.extend(right.0);
        let shape = Shape { states, start: WHOLE, control: None, frame: Frame::Barycentric };
        Ok(Complex { shape, faces, reversals: BTreeMap::new() })
    }

    /// The columns of the pieces of the intermediate face: kind 0, 1, or 2 for itself, with the column of refined points at which each
    /// begins.
    fn columns(&self) -> Vec<(usize, usize)> {
        let pattern = self.family.across.pattern;
        let kind = |i: usize| if i < pattern.left { 0 } else { 1 + usize::from(i == pattern.left) };
        self.family.across.windows().into_iter().enumerate().map(|(i, (first, _))| (kind(i), first)).collect()
    }

    /// The columns of the joined surface, in the same way.
    fn three(&self) -> [(usize, usize); 3] {
        let family = self.family;
        let (n, p) = (family.left.across.points(), family.left.across.shared);
        [(0, 0), (2, n - p), (1, n)]
    }

    /// The points and the states of a part: face, and edge across the border.
    fn part(&self, kind: usize) -> (Grid, [usize; 2]) {
        match kind {
            2 => (self.family.face.clone(), [FACE, ACROSS]),
            k => (self.schemes[k].clone(), [SCHEMES[k], SCHEMES[k] + 1]),
        }
    }

    fn whole_state(&self) -> State {
        let mut pieces = Vec::new();
        for row in 0..ROWS {
            for (kind, first) in self.three() {
                let (part, [face, _]) = self.part(kind);
                let op = self.whole.inclusion(first, &part, row);
                pieces.push(Piece { target: face, op, reversed: false, share: None });
            }
        }
        state("W", CellKind::Face, self.whole.len(), pieces)
    }

    fn face_state(&self, net: &Matrix) -> State {
        let family = self.family;
        let mut pieces = Vec::new();
        for row in 0..family.arity() {
            for (kind, first) in self.columns() {
                let (part, [face, _]) = self.part(kind);
                let op = window(net, &family.net.window(first, &part, row));
                pieces.push(Piece { target: face, op, reversed: false, share: None });
            }
        }
        state("I", CellKind::Face, family.face.len(), pieces)
    }

    /// An edge across the border.
    fn edge(&self, edge: Edge, shares: Vec<Option<Rational>>, op: impl Fn(&Grid, usize) -> Matrix) -> State {
        let Edge { name, points, columns, ends } = edge;
        let mut pieces = Vec::new();
        for ((kind, first), share) in columns.into_iter().zip(shares) {
            let (part, [_, target]) = self.part(kind);
            pieces.push(Piece { target, op: op(&part.over(0), first), reversed: false, share });
        }
        let mut edge = state(name, CellKind::Edge, points.len(), pieces);
        let [left, right] = [0, 1].map(|kind| self.family.ends(kind).over(0));
        let last = points.width() - right.width();
        edge.left = Some(Boundary { vertex: ends[0], op: points.inclusion(0, &left, 0) });
        edge.right = Some(Boundary { vertex: ends[1], op: points.inclusion(last, &right, 0) });
        edge
    }

    /// The left or right side of the joined surface: the cells of that scheme's edge along the border.
    fn outer(&self, kind: usize) -> State {
        let ends = self.family.ends(kind);
        let (grid, cell) = (ends.over(ROWS), ends.over(1));
        let piece = |row: usize| Piece {
            target: SCHEMES[kind] + 2,
            op: grid.inclusion(0, &cell, row),
            reversed: false,
            share: None,
        };
        let mut edge = state(["L", "R"][kind], CellKind::Edge, grid.len(), (0..ROWS).map(piece).collect());
        let corner = |row: usize| Boundary { vertex: CORNERS[kind], op: grid.inclusion(0, &ends.over(0), row) };
        (edge.left, edge.right) = (Some(corner(0)), Some(corner(ROWS)));
        edge
    }

    /// A corner of the joined surface, which is not refined: the vertex of a scheme.
    fn corner(&self, kind: usize) -> State {
        let size = self.family.ends(kind).over(0).len();
        let piece = Piece { target: SCHEMES[kind] + 3, op: Matrix::identity(size), reversed: false, share: None };
        state(["wd", "wc"][kind], CellKind::Vertex, size, vec![piece])
    }

    /// The boundary of a face on a grid: the edge at its bottom and top, those at its left and right.
    fn face(&self, grid: &Grid, across: usize, along: [usize; 2], columns: usize) -> Face {
        let rows = if across == WIDE { ROWS } else { self.family.arity() };
        let cells = if across == WIDE { ROWS } else { 1 };
        let end = |kind: usize| self.family.ends(kind).over(cells);
        let flat = |row: usize| Side { edge: across, op: grid.inclusion(0, &grid.over(0), row) };
        let last = grid.width() - end(1).width();
        let right = Side { edge: along[1], op: grid.inclusion(last, &end(1), 0) };
        let left = Side { edge: along[0], op: grid.inclusion(0, &end(0), 0) };
        Face {
            layout: Layout::Quad { columns, rows },
            sides: vec![flat(0), right, flat(cells), left],
            placement: Vec::new(),
        }
    }
}

impl SurfaceJunction {
    /// The points of the left or right edge of the intermediate face.
    fn ends(&self, kind: usize) -> Grid {
        let width = self.side(kind).across.shared;
        Grid::new(self.heights, if kind == 0 { [width, 0] } else { [0, width] }, 1)
    }

    /// The length of the intermediate face across the border, where the faces of both schemes have length 1.
    pub(super) fn length(&self) -> Rational {
        let pattern = self.across.pattern;
        Rational::from(pattern.left + pattern.right) / Rational::from(self.arity() - 1)
    }

    /// What the pieces of the edge of the intermediate face and of the whole edge take of their length.
    fn shares(&self) -> (Vec<Rational>, Vec<Rational>) {
        let (length, pattern) = (self.length(), self.across.pattern);
        let small = Rational::from(1) / Rational::from(self.arity());
        let piece = |i: usize| if i == pattern.left { small.clone() } else { &small / &length };
        let inner = (0..=pattern.left + pattern.right).map(piece).collect();
        let whole = Rational::from(2) + &length;
        let outer = [Rational::from(1), length, Rational::from(1)].map(|x| x / &whole);
        (inner, outer.to_vec())
    }
}

fn state(name: &str, kind: CellKind, dim: usize, pieces: Vec<Piece>) -> State {
    State { name: name.to_owned(), kind, dim, pieces, left: None, right: None }
}

/// The transposed rows of an array.
fn window(array: &Matrix, rows: &[usize]) -> Matrix {
    Matrix::from_fn(array.cols(), rows.len(), |i, j| array[(rows[j], i)].clone())
}

/// The face, the edges and the vertex of a scheme, as states from a number on.
fn scheme(
    side: &FaceSide,
    first: usize,
    names: [&str; 4],
) -> Result<(Vec<State>, BTreeMap<usize, Face>), SurfaceError> {
    let of = |side: &crate::junction::Side| Shape {
        states: vec![curve("a", side, 0, 1), vertex("u", side, 1)],
        start: 0,
        control: None,
        frame: Frame::Barycentric,
    };
    let product = tensor(&of(&side.across), &of(&side.along))
        .map_err(|e| SurfaceError::Stencil(format!("{}: {e}", side.name)))?;
    let mut states = product.shape.states;
    for (state, name) in states.iter_mut().zip(names) {
        name.clone_into(&mut state.name);
        state.pieces.iter_mut().for_each(|p| p.target += first);
        [&mut state.left, &mut state.right].into_iter().flatten().for_each(|b| b.vertex += first);
    }
    let moved = |(e, mut face): (usize, Face)| {
        face.sides.iter_mut().for_each(|s| s.edge += first);
        face.placement = Vec::new();
        (e + first, face)
    };
    Ok((states, product.faces.into_iter().map(moved).collect()))
}
