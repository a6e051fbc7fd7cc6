//! The characteristic map of a curve at a point: the leading coefficient as a function of the parameter (theory, “The
//! characteristic map of a curve”).

use super::branch::apply;
use super::cone::Cone;
use super::ring::Position;
use super::side::{SideCell, ring_on};
use super::verdict::{BranchReport, Outcome};
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::jordan::Spectral;
use crate::linalg::Matrix;
use crate::shape::{End, Shape, difference};
use crate::statement::Statement;
use std::collections::VecDeque;

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
    let Outcome::Line { statement: Statement::Theorem2, eigenvalue, functional, holder, proof: Some(_), .. } =
        &branch.outcome
    else {
        return None;
    };
    let root = &holder.eigenvalue;
    if root.sign() != branch.cycle_sign {
        return None;
    }
    let over = branch.spectrum.part(eigenvalue.0).over;
    let through = |op: &Matrix, row: &[Elem]| apply(&op.transpose(), row, over);
    let on_state = through(&branch.chart, functional);
    let cell = |own: SideCell| Cell {
        word: own.word,
        state: own.state,
        row: through(&own.op, &on_state),
        forwards: own.slope > 0,
    };
    // Cells of one level after the other, so that opposite changes far from one another are seen.
    let mut cells: VecDeque<Cell> = ring_on(shape, branch, place)?.into_iter().map(cell).collect();
    let (mut positive, mut negative): (Option<Vec<usize>>, Option<Vec<usize>>) = (None, None);
    let (mut seen, mut leaves) = (0, 0);
    while let Some(cell) = cells.pop_front() {
        seen += 1;
        if seen > MAX_CELLS {
            return Some(Characteristic::Open);
        }
        let chord = chord(shape, &cell)?;
        let known = if cell.forwards { chord } else { chord.iter().map(|x| -x).collect() };
        match value(&cell.row, &known, root) {
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
            cells.extend(shape.states[cell.state].pieces.iter().enumerate().map(|(letter, piece)| Cell {
                word: [cell.word.as_slice(), &[letter]].concat(),
                state: piece.target,
                row: through(&piece.op, &cell.row),
                forwards: cell.forwards != piece.reversed,
            }));
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
