//! The operators of a curve on points from left to right, of which the first and the last are those of its ends.

use crate::linalg::Matrix;
use crate::shape::{End, Shape, Spaces, difference};

/// How the coordinates of a curve were brought in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointOrder {
    /// As they were.
    Given,
    /// Backwards, as masks list their control points.
    Backwards,
    /// Replaced by points of the curve: its start, further ones, its end.
    OwnPoints,
}

/// A curve of a single state on points from left to right.
#[derive(Debug, Clone)]
pub struct Ordered {
    /// The operators on columns.
    pub operators: Vec<Matrix>,
    /// The number of points at each end on which the end point depends.
    pub shared: usize,
    /// Where the points come from.
    pub order: PointOrder,
}

/// Orders the points of the start state of a curve, which is its only one; `None` where the curve is a single point.
#[must_use]
pub fn ordered(shape: &Shape) -> Option<Ordered> {
    let pieces = &shape.states[shape.start].pieces;
    if pieces.iter().all(|p| !p.reversed) {
        let given: Vec<Matrix> = pieces.iter().map(|p| p.op.clone()).collect();
        let turned = given.iter().map(backwards).collect();
        for (operators, order) in [(given, PointOrder::Given), (turned, PointOrder::Backwards)] {
            let n = operators[0].rows();
            if let Some(shared) = (1..n).rev().find(|p| fits(&operators, *p)) {
                return Some(Ordered { operators, shared, order });
            }
        }
    }
    Some(Ordered { operators: on_own_points(shape)?, shared: 1, order: PointOrder::OwnPoints })
}

fn backwards(op: &Matrix) -> Matrix {
    let n = op.rows() - 1;
    Matrix::from_fn(op.rows(), op.cols(), |i, j| op[(n - i, n - j)].clone())
}

/// Whether the end points depend on the first and the last `p` points, by one rule, and neighbouring pieces share them.
fn fits(operators: &[Matrix], p: usize) -> bool {
    let (first, last) = (&operators[0], &operators[operators.len() - 1]);
    let n = first.rows();
    let away = n - p;
    let left = (p..n).all(|j| (0..p).all(|i| first[(j, i)] == 0));
    let right = (0..away).all(|j| (away..n).all(|i| last[(j, i)] == 0));
    let same = (0..p).all(|j| (0..p).all(|i| first[(j, i)] == last[(away + j, away + i)]));
    let meet = operators.windows(2).all(|w| (0..p).all(|i| w[0].column(away + i) == w[1].column(i)));
    left && right && same && meet
}

/// The operators in barycentric coordinates by points of the curve that span it, its ends among them.
fn on_own_points(shape: &Shape) -> Option<Vec<Matrix>> {
    let e = shape.start;
    let dim = Spaces::new(shape)?.of(e).basis.cols();
    let (start, finish) = (shape.end_point(e, End::Start)?, shape.end_point(e, End::Finish)?);
    let mut chosen = vec![start.clone(), finish.clone()];
    let mut span = Matrix::from_rows(start.len(), vec![difference(&finish, &start)]);
    if dim == 0 || span.is_zero() {
        return None;
    }
    // Joints of the first levels, in the order of the parameter within each.
    let mut level = vec![Matrix::identity(start.len())];
    while span.rows() < dim {
        let mut next = Vec::new();
        for word in &level {
            for piece in &shape.states[e].pieces {
                let op = word * &piece.op;
                let joint = op.apply(if piece.reversed { &start } else { &finish });
                let longer = span.stack(&Matrix::from_rows(start.len(), vec![difference(&joint, &start)]));
                if longer.rank() == longer.rows() {
                    span = longer;
                    chosen.insert(chosen.len() - 1, joint);
                }
                next.push(op);
            }
        }
        level = next;
    }
    let frame = Matrix::from_columns(start.len(), &chosen);
    shape.states[e].pieces.iter().map(|p| frame.solve(&(&p.op * &frame))).collect()
}
