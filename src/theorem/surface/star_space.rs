//! What is seen of the stars of a patch: quotients of the differences of their points, and the operators between them.

use super::stars::{Child, Stars};
use crate::arith::Rational;
use crate::linalg::{Matrix, closures};
use crate::shape::difference;
use crate::theorem::Context;

/// The visible quotients `W` of all stars, that of the start, number 0, included.
pub(super) struct StarSpaces {
    /// By star: coordinates in `W` of differences of its points, on the coordinates of all its cells one after the other.
    pub charts: Vec<Matrix>,
    /// By star: the basis of `W`, as rows, in coordinates in which points of different weights have different unit vectors.
    pub bases: Vec<Matrix>,
    /// By star and child: the map from the quotient of the child.
    pub maps: Vec<Vec<Matrix>>,
    /// By star: where the coordinates of each cell begin.
    offsets: Vec<Vec<usize>>,
}

impl StarSpaces {
    /// `None` where an operator induces no map, which happens for no patch.
    pub fn new(cx: &Context, stars: &Stars) -> Option<Self> {
        let dim = |e: usize| cx.shape.states[e].dim;
        let mut offsets = Vec::new();
        for star in &stars.list {
            let mut own = vec![0];
            for (e, _) in &star.cells {
                own.push(own[own.len() - 1] + dim(*e));
            }
            offsets.push(own);
        }
        let size = |s: usize| offsets[s][offsets[s].len() - 1];
        let operator = |s: usize, child: &Child| {
            let mut op = Matrix::zero(size(s), size(child.star));
            for (k, &[cell, letter]) in child.cells.iter().enumerate() {
                let piece = &cx.shape.states[stars.list[s].cells[cell].0].pieces[letter].op;
                for (i, j) in (0..piece.rows()).flat_map(|i| (0..piece.cols()).map(move |j| (i, j))) {
                    op[(offsets[s][cell] + i, offsets[child.star][k] + j)] = piece[(i, j)].clone();
                }
            }
            op
        };
        let arrows: Vec<_> = stars.arrows().map(|(s, child)| (s, child.star, operator(s, child))).collect();
        let mut rows: Vec<Matrix> = (0..stars.list.len()).map(|s| Matrix::zero(0, size(s))).collect();
        rows[0] = seen_from_start(cx, stars);
        let rows = closures(rows, &arrows);
        let spans: Vec<_> = (0..rows.len()).map(|s| span(cx, stars, s, &rows[s], &offsets[s]).echelon()).collect();
        let chosen = |s: usize, m: &Matrix| {
            let pivots = &spans[s].pivots;
            Matrix::from_fn(pivots.len(), m.cols(), |i, j| m[(pivots[i], j)].clone())
        };
        let mut maps: Vec<Vec<Matrix>> = vec![Vec::new(); rows.len()];
        for (s, child, op) in &arrows {
            let (seen, pivots) = (&rows[*s] * op, rows[*child].pivots());
            let onto = Matrix::from_fn(seen.rows(), pivots.len(), |i, j| seen[(i, pivots[j])].clone());
            let image = &onto * &spans[*child].rows.transpose();
            let map = chosen(*s, &image);
            if &onto * &rows[*child] != seen || &spans[*s].rows.transpose() * &map != image {
                return None;
            }
            maps[*s].push(map);
        }
        let charts = (0..rows.len()).map(|s| chosen(s, &rows[s])).collect();
        let bases = spans.into_iter().map(|s| s.rows).collect();
        Some(Self { charts, bases, maps, offsets })
    }

    pub fn dim(&self, star: usize) -> usize {
        self.charts[star].rows()
    }

    /// The coordinates on the points of one cell.
    pub fn cell(&self, star: usize, cell: usize) -> Matrix {
        let (from, to) = (self.offsets[star][cell], self.offsets[star][cell + 1]);
        Matrix::from_fn(self.dim(star), to - from, |i, j| self.charts[star][(i, from + j)].clone())
    }
}

/// How the points of the start are seen, on the coordinates of its cells: a face alone, or the pieces of a set.
fn seen_from_start(cx: &Context, stars: &Stars) -> Matrix {
    let start = &cx.shape.states[cx.shape.start];
    let view = cx.from.map();
    if matches!(&stars.list[0].cells[..], [(e, _)] if *e == cx.shape.start) {
        return view.clone();
    }
    let pieces = start.pieces.iter().map(|p| view * &p.op);
    pieces.fold(Matrix::zero(view.rows(), 0), |all, piece| all.beside(&piece))
}

/// Vectors, as rows, that span the differences of the points of a star as they are seen.
fn span(cx: &Context, stars: &Stars, s: usize, rows: &Matrix, offsets: &[usize]) -> Matrix {
    let mut span = Matrix::zero(0, rows.rows());
    let mut first: Option<Vec<Rational>> = None;
    for ((e, _), window) in stars.list[s].cells.iter().zip(offsets.windows(2)) {
        let block = Matrix::from_fn(rows.rows(), window[1] - window[0], |i, j| rows[(i, window[0] + j)].clone());
        let space = cx.spaces.of(*e);
        let point = block.apply(&space.base);
        let shift = difference(&point, first.get_or_insert_with(|| point.clone()));
        span = span.stack(&(&block * &space.basis).transpose()).stack(&Matrix::from_rows(shift.len(), vec![shift]));
    }
    span
}
