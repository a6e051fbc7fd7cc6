//! The ring of a branch of a curve on one side of its point.

use super::ring::Position;
use super::verdict::BranchReport;
use crate::arith::{Rational, abs};
use crate::linalg::Matrix;
use crate::shape::Shape;

/// A cell of the ring: its word from the state of the branch, where that ends, and its operator. Its parameter `u` is at
/// `offset + slope u`, measured from the point.
pub(super) struct SideCell {
    pub word: Vec<usize>,
    pub state: usize,
    pub op: Matrix,
    pub slope: Rational,
    pub offset: Rational,
}

/// The cells on one side, of two turns where the cycle exchanges the sides; `None` where they do not fill it from one turn to the
/// next.
pub(super) fn ring_on(shape: &Shape, branch: &BranchReport, place: Position) -> Option<Vec<SideCell>> {
    let (turn, shift) = shape.parameter_map(branch.state, &branch.address.cycle)?;
    let point = shift / (Rational::from(1) - &turn);
    let mut cells = Vec::new();
    let mut covered = Rational::from(0);
    for piece in &branch.ring {
        let (slope, offset) = shape.parameter_map(branch.state, &piece.word)?;
        let own = SideCell {
            word: piece.word.clone(),
            state: piece.end,
            op: piece.op.clone(),
            slope,
            offset: offset - &point,
        };
        let cell = match (piece.position == place, branch.cycle_sign > 0) {
            (true, _) => own,
            (false, true) => continue,
            // One more turn brings it to this side.
            (false, false) => SideCell {
                word: [branch.address.cycle.as_slice(), &own.word].concat(),
                op: &branch.cycle_operator * &own.op,
                slope: &turn * own.slope,
                offset: &turn * own.offset,
                ..own
            },
        };
        if piece.collapses {
            return None;
        }
        covered += abs(&cell.slope);
        cells.push(cell);
    }
    let whole = if place == Position::Before { point } else { Rational::from(1) - point };
    let left = if branch.cycle_sign > 0 { abs(&turn) } else { &turn * &turn };
    (!cells.is_empty() && covered == whole * (Rational::from(1) - left)).then_some(cells)
}
