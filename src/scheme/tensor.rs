//! Tensor products of curves, as patches with edges and vertices.

use super::SchemeError;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, Face, Frame, Layout, Piece, Shape, Side, State};
use std::collections::BTreeMap;

/// Largest number of coordinates of a tensor product.
pub const MAX_COORDINATES: usize = 1024;

/// The Kronecker product: coordinate `(i, j)` has index `i * m + j`.
#[must_use]
pub fn kronecker(a: &Matrix, b: &Matrix) -> Matrix {
    let (h, w) = (b.rows(), b.cols());
    Matrix::from_fn(a.rows() * h, a.cols() * w, |i, j| {
        let x = &a[(i / h, j / w)];
        if *x == 0 { Rational::from(0) } else { x * &b[(i % h, j % w)] }
    })
}

/// The patch `p(u, v) = a(u) ⊗ b(v)` of two curves whose edge states all have vertices on both sides: states are the pairs
/// of states, the operators Kronecker products. Two cubic B-splines give the bicubic patch of thesis §3.6.1 with 16 points
/// on the face, 12 on the edges and 9 at the corners.
///
/// # Errors
/// [`SchemeError::Mesh`] where an edge has no vertex or a state is neither edge nor vertex, [`SchemeError::Large`].
pub fn tensor(a: &Shape, b: &Shape) -> Result<Complex, SchemeError> {
    let error = |message: &str| SchemeError::Mesh { rule: "tensor product".to_owned(), message: message.to_owned() };
    for state in a.states.iter().chain(&b.states) {
        let fits = match state.kind {
            CellKind::Edge => state.left.is_some() && state.right.is_some(),
            CellKind::Vertex => state.pieces.len() == 1,
            CellKind::Set | CellKind::Face => false,
        };
        if !fits {
            return Err(error("every state must be a vertex with one piece or an edge with a vertex on both sides"));
        }
    }
    let product = Product { width: b.states.len() };
    let mut states = Vec::new();
    let mut faces = BTreeMap::new();
    for (i, x) in a.states.iter().enumerate() {
        for (j, y) in b.states.iter().enumerate() {
            let size = x.dim * y.dim;
            if size > MAX_COORDINATES {
                return Err(SchemeError::Large { what: "a patch with coordinates", size, limit: MAX_COORDINATES });
            }
            if let (CellKind::Edge, CellKind::Edge) = (x.kind, y.kind)
                && let Some(face) = product.face((i, x), (j, y))
            {
                faces.insert(product.index(i, j), face);
            }
            states.push(product.state((i, x), (j, y)));
        }
    }
    let shape = Shape { states, start: product.index(a.start, b.start), control: None, frame: Frame::Barycentric };
    shape.check()?;
    Ok(Complex { shape, faces, reversals: BTreeMap::new() })
}

struct Product {
    width: usize,
}

impl Product {
    fn index(&self, i: usize, j: usize) -> usize {
        i * self.width + j
    }

    fn state(&self, (i, x): (usize, &State), (j, y): (usize, &State)) -> State {
        let mut pieces = Vec::new();
        for q in &y.pieces {
            for p in &x.pieces {
                let op = kronecker(&p.op, &q.op);
                // The parameters of a face are divided as its sides are.
                let share = match (x.kind, y.kind) {
                    (CellKind::Edge, CellKind::Vertex) => p.share.clone(),
                    (CellKind::Vertex, CellKind::Edge) => q.share.clone(),
                    _ => None,
                };
                let target = self.index(p.target, q.target);
                pieces.push(Piece { target, op, reversed: p.reversed || q.reversed, share });
            }
        }
        let kind = match (x.kind, y.kind) {
            (CellKind::Vertex, CellKind::Vertex) => CellKind::Vertex,
            (CellKind::Edge, CellKind::Edge) => CellKind::Face,
            _ => CellKind::Edge,
        };
        if kind == CellKind::Face {
            // The orientation of a piece of a face is told by its placement.
            pieces.iter_mut().for_each(|p| p.reversed = false);
        }
        let boundary = |of: fn(&State) -> Option<&Boundary>| match (x.kind, y.kind) {
            (CellKind::Edge, CellKind::Vertex) => of(x)
                .map(|b| Boundary { vertex: self.index(b.vertex, j), op: kronecker(&b.op, &Matrix::identity(y.dim)) }),
            (CellKind::Vertex, CellKind::Edge) => of(y)
                .map(|b| Boundary { vertex: self.index(i, b.vertex), op: kronecker(&Matrix::identity(x.dim), &b.op) }),
            _ => None,
        };
        let (left, right) = (boundary(|s| s.left.as_ref()), boundary(|s| s.right.as_ref()));
        let name = format!("{}⊗{}", x.name, y.name);
        State { name, kind, dim: x.dim * y.dim, pieces, left, right }
    }

    fn face(&self, (i, x): (usize, &State), (j, y): (usize, &State)) -> Option<Face> {
        let along =
            |b: &Boundary| Side { edge: self.index(i, b.vertex), op: kronecker(&Matrix::identity(x.dim), &b.op) };
        let up = |b: &Boundary| Side { edge: self.index(b.vertex, j), op: kronecker(&b.op, &Matrix::identity(y.dim)) };
        let sides =
            vec![along(y.left.as_ref()?), up(x.right.as_ref()?), along(y.right.as_ref()?), up(x.left.as_ref()?)];
        let mut placement = Vec::new();
        for q in &y.pieces {
            for p in &x.pieces {
                // Reversing u exchanges the corners 0, 1 and 2, 3; reversing v the corners 0, 3 and 1, 2.
                let corner = |k: usize| {
                    let k = if p.reversed { k ^ 1 } else { k };
                    if q.reversed { 3 - k } else { k }
                };
                placement.push((0..4).map(corner).collect());
            }
        }
        let layout = Layout::Quad { columns: x.pieces.len(), rows: y.pieces.len() };
        Some(Face { layout, sides, placement })
    }
}
