use super::projection::{Projection, floats};
use super::svg::Element;
use crate::arith::to_f64;
use crate::shape::{Address, CellKind, End, Shape};
use nalgebra::DMatrix;

/// Cells smaller than this part of the picture are not divided.
const FINE: f64 = 1.0 / 700.0;
/// Most points of a picture.
const MAX_POINTS: usize = 12_000;
/// Longest words.
const MAX_DEPTH: usize = 48;

/// Follows the cells of a shape down to the size of a pixel.
pub(super) struct Tracer<'a> {
    shape: &'a Shape,
    /// Operators by state and letter.
    ops: Vec<Vec<DMatrix<f64>>>,
    /// Points of each state, from exact ones: of a curve its start and its end, of other states one of each piece.
    samples: Vec<DMatrix<f64>>,
}

impl<'a> Tracer<'a> {
    /// Computes the exact points of the states from which everything is drawn.
    pub fn new(shape: &'a Shape) -> Option<Self> {
        let ops = shape.states.iter().map(|s| s.pieces.iter().map(|p| floats(&p.op)).collect()).collect();
        let mut samples = vec![DMatrix::zeros(0, 0); shape.states.len()];
        for e in shape.reachable() {
            let state = &shape.states[e];
            let points: Vec<Vec<f64>> = if state.kind == CellKind::Edge {
                let ends = [End::Start, End::Finish].map(|end| shape.end_point(e, end));
                ends.into_iter().map(|p| p.map(|x| x.iter().map(to_f64).collect())).collect::<Option<_>>()?
            } else {
                let address = Address::periodic(vec![0]).normalise(shape, e).ok()?;
                vec![shape.point(e, &address)?.iter().map(to_f64).collect()]
            };
            samples[e] = DMatrix::from_fn(state.dim, points.len(), |i, j| points[j][i]);
        }
        Some(Self { shape, ops, samples })
    }

    /// The points of the drawing: of a curve in its order.
    pub fn points(&self, projection: &Projection) -> Vec<[f64; 2]> {
        let start = self.shape.start;
        let most = self.shape.states.iter().map(|s| s.pieces.len()).max().unwrap_or(1).max(2);
        let depth = (1..=8).take_while(|d| most.pow(*d) <= 2_000).count().max(1);
        let coarse = self.walk(start, projection.matrix(), 0.0, depth, MAX_POINTS);
        let size = extent(&coarse).max(f64::MIN_POSITIVE);
        let mut tolerance = size * FINE;
        loop {
            let points = self.walk(start, projection.matrix(), tolerance, MAX_DEPTH, MAX_POINTS);
            if points.len() < MAX_POINTS || tolerance > size {
                return thinned(points, tolerance / 4.0);
            }
            tolerance *= 1.5;
        }
    }

    /// The points of the cell of a state under a map to the plane, about `most` of them.
    pub fn cell(&self, state: usize, map: &DMatrix<f64>, most: usize) -> Vec<[f64; 2]> {
        let size = extent(&self.walk(state, map, 0.0, 3, MAX_POINTS)).max(f64::MIN_POSITIVE);
        let mut tolerance = size * 4.0 * FINE;
        loop {
            let points = thinned(self.walk(state, map, tolerance, MAX_DEPTH, MAX_POINTS), tolerance);
            if points.len() <= most || tolerance > size {
                return points;
            }
            tolerance *= 1.4;
        }
    }

    /// Points of a cell as the element that suits its state: a curve, or a cloud.
    pub fn element(&self, state: usize, points: Vec<[f64; 2]>) -> Element {
        if self.shape.states[state].kind == CellKind::Edge {
            Element::Path { class: "sc-c", points }
        } else {
            Element::Cloud { class: "sc-s", points }
        }
    }

    /// Points of the image of a state's attractor under `op`, at least `least` of them, as columns.
    pub fn spread(&self, state: usize, op: &DMatrix<f64>, least: usize) -> Vec<DMatrix<f64>> {
        let mut cells = vec![(state, op.clone())];
        for _ in 0..MAX_DEPTH {
            if cells.len() >= least.max(1) {
                break;
            }
            let inner = |(e, op): &(usize, DMatrix<f64>)| -> Vec<(usize, DMatrix<f64>)> {
                let pieces = self.shape.states[*e].pieces.iter().zip(&self.ops[*e]);
                pieces.map(|(piece, next)| (piece.target, op * next)).collect()
            };
            cells = cells.iter().flat_map(inner).collect();
        }
        let points = |(e, op): &(usize, DMatrix<f64>)| -> Vec<DMatrix<f64>> {
            let images = op * &self.samples[*e];
            (0..images.ncols()).map(|j| images.columns(j, 1).into_owned()).collect()
        };
        cells.iter().flat_map(points).collect()
    }

    /// The graph of a functional over the parameter of an edge state.
    pub fn profile(&self, state: usize, row: &DMatrix<f64>) -> Vec<[f64; 2]> {
        let most = self.shape.states.iter().map(|s| s.pieces.len()).max().unwrap_or(1).max(2);
        let depth = (1..=12).take_while(|d| most.pow(*d) <= 400).count().max(1);
        let mut out = Vec::new();
        self.graph(state, row, (0.0, 1.0), depth, false, &mut out);
        out
    }

    fn graph(&self, e: usize, row: &DMatrix<f64>, t: (f64, f64), depth: usize, back: bool, out: &mut Vec<[f64; 2]>) {
        let pieces = &self.shape.states[e].pieces;
        if depth == 0 {
            let ends = row * &self.samples[e];
            let (a, b) = if back { (1, 0) } else { (0, 1) };
            out.extend([[t.0, ends[(0, a)]], [t.1, ends[(0, b)]]]);
            return;
        }
        let mut from = t.0;
        for k in 0..pieces.len() {
            let letter = if back { pieces.len() - 1 - k } else { k };
            let piece = &pieces[letter];
            let part = (from, from + (t.1 - t.0) * to_f64(&self.shape.states[e].share(letter)));
            from = part.1;
            self.graph(piece.target, &(row * &self.ops[e][letter]), part, depth - 1, back != piece.reversed, out);
        }
    }

    fn walk(&self, start: usize, map: &DMatrix<f64>, tolerance: f64, depth: usize, limit: usize) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        let is_curve = self.shape.states[start].kind == CellKind::Edge;
        self.descend(start, map, &Descent { tolerance, limit, is_curve }, depth, false, &mut out);
        out
    }

    fn descend(&self, e: usize, map: &DMatrix<f64>, d: &Descent, depth: usize, back: bool, out: &mut Vec<[f64; 2]>) {
        if out.len() >= d.limit {
            return;
        }
        let pieces = &self.shape.states[e].pieces;
        let inner: Vec<DMatrix<f64>> = self.ops[e].iter().map(|op| map * op).collect();
        let own = columns(&(map * &self.samples[e]));
        let mut seen = own.clone();
        for (piece, next) in pieces.iter().zip(&inner) {
            seen.extend(columns(&(next * &self.samples[piece.target])));
        }
        let small = extent(&seen) < d.tolerance;
        if depth == 0 || small {
            if d.is_curve && back {
                out.extend(own.into_iter().rev());
            } else {
                out.extend(own);
            }
            return;
        }
        let order: Vec<usize> = if back { (0..pieces.len()).rev().collect() } else { (0..pieces.len()).collect() };
        for k in order {
            self.descend(pieces[k].target, &inner[k], d, depth - 1, back != pieces[k].reversed, out);
        }
    }
}

struct Descent {
    tolerance: f64,
    limit: usize,
    is_curve: bool,
}

fn columns(m: &DMatrix<f64>) -> Vec<[f64; 2]> {
    (0..m.ncols()).map(|j| [m[(0, j)], m[(1, j)]]).collect()
}

fn extent(points: &[[f64; 2]]) -> f64 {
    let span = |k: usize| {
        let lo = points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let hi = points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        if hi > lo { hi - lo } else { 0.0 }
    };
    span(0).max(span(1))
}

/// Drops points that lie on the one kept before.
fn thinned(points: Vec<[f64; 2]>, tolerance: f64) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    let count = points.len();
    for (k, p) in points.into_iter().enumerate() {
        let far = out.last().is_none_or(|q| (p[0] - q[0]).abs().max((p[1] - q[1]).abs()) > tolerance);
        if far || k + 1 == count {
            out.push(p);
        }
    }
    out
}
