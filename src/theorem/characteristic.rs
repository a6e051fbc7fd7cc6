//! The characteristic map of a curve at a point: the leading coefficient as a function of the parameter (theory, “The
//! characteristic map of a curve”).

use super::cone::Cone;
use super::ring::Position;
use super::verdict::{BranchReport, Outcome};
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::shape::{End, Shape, difference};
use crate::statement::Statement;

/// Most cells whose chords and cones are looked at on one side.
const MAX_CELLS: usize = 600;

/// Whether the characteristic map of one side is injective.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Characteristic {
    /// On so many cells, which cover the ring, the functional has one sign on the cones.
    Injective {
        /// The number of cells.
        cells: usize,
    },
    /// The functional vanishes on the chord of one cell, or has opposite signs on those of two, words from the state of the branch.
    Not {
        /// The words.
        words: Vec<Vec<usize>>,
    },
    /// Neither was found.
    Open,
}

/// A cell of the ring: the functional on vectors of its state, and whether its parameter runs with that of the branch's state.
struct Cell {
    word: Vec<usize>,
    state: usize,
    row: Vec<Elem>,
    forwards: bool,
}

/// The characteristic map on one side of a branch that has its line by Theorem 2; `None` for others, and where the ring does
/// not fill the side.
///
/// # Cost
/// Some hundred products of a row with the rays of a cone.
#[must_use]
pub fn characteristic(shape: &Shape, cones: &[Cone], branch: &BranchReport, place: Position) -> Option<Characteristic> {
    let Outcome::Line { statement: Statement::Theorem2, functional, holder, proof: Some(_), .. } = &branch.outcome
    else {
        return None;
    };
    let root = &holder.eigenvalue;
    if root.sign() != branch.cycle_sign {
        return None;
    }
    let mut cells = ring(shape, branch, functional, place)?;
    let (mut positive, mut negative): (Option<Vec<usize>>, Option<Vec<usize>>) = (None, None);
    let (mut seen, mut leaves) = (0, 0);
    while let Some(cell) = cells.pop() {
        seen += 1;
        if seen > MAX_CELLS {
            return Some(Characteristic::Open);
        }
        let chord = chord(shape, &cell)?;
        let known = if cell.forwards { chord } else { chord.iter().map(|x| -x).collect() };
        match value(&cell.row, &known, &root.clone()) {
            0 => return Some(Characteristic::Not { words: vec![cell.word] }),
            1 => positive = positive.or_else(|| Some(cell.word.clone())),
            _ => negative = negative.or_else(|| Some(cell.word.clone())),
        }
        if let (Some(up), Some(down)) = (&positive, &negative) {
            return Some(Characteristic::Not { words: vec![up.clone(), down.clone()] });
        }
        if one_sign(cones, &cell, root) {
            leaves += 1;
        } else {
            cells.extend(parts(shape, &cell));
        }
    }
    Some(Characteristic::Injective { cells: leaves })
}

/// The sign of the functional on a vector.
fn value(row: &[Elem], vector: &[Rational], root: &Root) -> i32 {
    let sum = row.iter().zip(vector).fold(Elem::zero(), |sum, (a, x)| sum.add(&a.scale(x)));
    sum.sign(root)
}

fn chord(shape: &Shape, cell: &Cell) -> Option<Vec<Rational>> {
    let end = |end| shape.end_point(cell.state, end);
    Some(difference(&end(End::Finish)?, &end(End::Start)?))
}

/// Whether the functional has one strict sign on the cone of the state.
fn one_sign(cones: &[Cone], cell: &Cell, root: &Root) -> bool {
    let Some(cone) = cones.iter().find(|c| c.state == cell.state) else { return false };
    let mut signs = (0..cone.rays.cols()).map(|j| value(&cell.row, &cone.rays.column(j), root));
    signs.next().is_some_and(|first| first != 0 && signs.all(|s| s == first))
}

/// The cells of the first level of a cell.
fn parts(shape: &Shape, cell: &Cell) -> Vec<Cell> {
    let part = |(letter, piece): (usize, &crate::shape::Piece)| Cell {
        word: [cell.word.as_slice(), &[letter]].concat(),
        state: piece.target,
        row: through(&piece.op, &cell.row),
        forwards: cell.forwards != piece.reversed,
    };
    shape.states[cell.state].pieces.iter().enumerate().map(part).collect()
}

/// A row before an operator.
fn through(op: &crate::linalg::Matrix, row: &[Elem]) -> Vec<Elem> {
    let entry = |j: usize| row.iter().enumerate().fold(Elem::zero(), |sum, (i, r)| sum.add(&r.scale(&op[(i, j)])));
    (0..op.cols()).map(entry).collect()
}

/// The cells of the ring on one side; `None` where they do not fill it.
fn ring(shape: &Shape, branch: &BranchReport, functional: &[Elem], place: Position) -> Option<Vec<Cell>> {
    let (turn, shift) = shape.parameter_map(branch.state, &branch.address.cycle)?;
    let point = shift / (Rational::from(1) - &turn);
    let row = through(&branch.chart, functional);
    let own = if place == Position::Before { point } else { Rational::from(1) - point };
    let left = if branch.cycle_sign > 0 { crate::arith::abs(&turn) } else { &turn * &turn };
    let mut covered = Rational::from(0);
    let mut cells = Vec::new();
    for piece in &branch.ring {
        let (mut slope, _) = shape.parameter_map(branch.state, &piece.word)?;
        let (mut word, mut own_row) = (piece.word.clone(), through(&piece.op, &row));
        if piece.position != place {
            if branch.cycle_sign > 0 {
                continue;
            }
            // One more turn brings it to this side.
            slope *= &turn;
            word = [branch.address.cycle.as_slice(), &word].concat();
            own_row = through(&(&branch.cycle_operator * &piece.op), &row);
        }
        if piece.collapses {
            return None;
        }
        covered += crate::arith::abs(&slope);
        cells.push(Cell { word, state: piece.end, row: own_row, forwards: slope > 0 });
    }
    (!cells.is_empty() && covered == own * (Rational::from(1) - left)).then_some(cells)
}
