//! Closed paths that wind around 0 (theory §7, Refuting, (c)).

use super::place::Chart;
use super::verdict::Winding;
use crate::arith::{Interval, Rational};
use crate::shape::{CellKind, Complex};
use crate::theorem::ring::{Node, Position, Ring};
use crate::theorem::{Discharged, Functional};
use std::collections::VecDeque;

/// Cells of the ring whose boundary is followed.
const MAX_CELLS: usize = 160;
/// Pieces of one boundary.
const MAX_PATH: usize = 400;
/// Binary digits of irrational functionals.
const BITS: u64 = 128;

/// A stretch of the boundary of a cell: one side of a face, run forwards or backwards.
struct Stretch {
    node: Node,
    side: usize,
    forward: bool,
}

/// Looks for a cell of the ring whose boundary winds around 0 under the two functionals.
///
/// The cell is the continuous image of a quadrangle or triangle, so that the functionals have a common zero on it.
pub fn winding(chart: &Chart, complex: &Complex, ring: &Ring, pair: &[Functional; 2]) -> Option<Winding> {
    let bound = ring.chart_bound();
    let approximations = pair.each_ref().map(|f| f.approximate(BITS));
    let errors = approximations.each_ref().map(|(_, e)| e * &bound);
    let rows: Vec<Vec<Rational>> = approximations.iter().map(|(row, _)| ring.row_on_points(row)).collect();
    let search = Search { chart, complex, ring, errors };
    let mut queue: VecDeque<Node> = ring.roots(&rows);
    let mut budget = MAX_CELLS;
    while let Some(node) = queue.pop_front() {
        if search.strict(&node).is_some() || complex.shape.states[node.end].kind != CellKind::Face {
            continue;
        }
        if let Some(found) = search.around(&node) {
            return Some(found);
        }
        budget = budget.checked_sub(1)?;
        queue.extend(ring.children(&node));
    }
    None
}

struct Search<'a> {
    chart: &'a Chart<'a>,
    complex: &'a Complex,
    ring: &'a Ring<'a>,
    errors: [Rational; 2],
}

impl Search<'_> {
    /// A functional with a strict sign on the cell.
    fn strict(&self, node: &Node) -> Option<Discharged> {
        for (functional, (row, error)) in node.rows.iter().zip(&self.errors).enumerate() {
            let values = self.ring.balls.enclose(self.ring.spaces, node.end, row);
            let bound = &values + &Interval::symmetric(error.clone());
            if let Some(sign @ (1 | -1)) = bound.sign() {
                let (word, position) = (node.word.clone(), Position::Unordered);
                return Some(Discharged { word, end: node.end, functional, sign, position, bound });
            }
        }
        None
    }

    /// The winding number of the boundary of a cell, where it is not 0 and can be told.
    fn around(&self, node: &Node) -> Option<Winding> {
        let sides = self.complex.faces.get(&node.end)?.layout.sides();
        let mut open: VecDeque<Stretch> = VecDeque::new();
        // The sides in the order of the corners 0, 1, 2, (3).
        for (side, (from, to)) in sides.iter().enumerate() {
            let forward = *to == (*from + 1) % sides.len();
            open.push_back(Stretch { node: copy(node), side, forward });
        }
        let mut path: Vec<Discharged> = Vec::new();
        let mut steps = 0;
        while let Some(stretch) = open.pop_front() {
            steps += 1;
            if steps > MAX_PATH {
                return None;
            }
            match self.strict(&stretch.node) {
                Some(found) => path.push(found),
                None => self.divided(&stretch)?.into_iter().rev().for_each(|s| open.push_front(s)),
            }
        }
        let number = turns(&path)?;
        (number != 0).then(|| Winding { cell: node.word.clone(), number, path })
    }

    /// The stretches of the pieces along a side, in the order of the path.
    fn divided(&self, stretch: &Stretch) -> Option<Vec<Stretch>> {
        let state = stretch.node.end;
        let layout = self.complex.faces.get(&state)?.layout;
        let (from, to) = layout.sides()[stretch.side];
        let own = super::place::corners(layout);
        let (a, b) = if stretch.forward { (&own[from], &own[to]) } else { (&own[to], &own[from]) };
        // How far along the side a point on it lies.
        let along = |p: &[Rational; 2]| -> Option<Rational> {
            let d = [&b[0] - &a[0], &b[1] - &a[1]];
            let e = [&p[0] - &a[0], &p[1] - &a[1]];
            (&d[0] * &e[1] == &d[1] * &e[0]).then(|| (&d[0] * &e[0] + &d[1] * &e[1]) / (&d[0] * &d[0] + &d[1] * &d[1]))
        };
        let mut parts: Vec<(Rational, Stretch)> = Vec::new();
        for (child, (letter, piece)) in self
            .ring
            .children(&stretch.node)
            .into_iter()
            .zip(self.complex.shape.states[state].pieces.iter().enumerate())
        {
            let places: Vec<Option<Rational>> = self.chart.piece_corners(state, letter).iter().map(along).collect();
            let inner = self.complex.faces.get(&piece.target)?.layout.sides();
            for (side, (x, y)) in inner.iter().enumerate() {
                if let (Some(x), Some(y)) = (&places[*x], &places[*y]) {
                    let start = x.min(y).clone();
                    let part = Stretch { node: copy(&child), side, forward: x < y };
                    parts.push((start, part));
                }
            }
        }
        parts.sort_by(|x, y| x.0.cmp(&y.0));
        let starts_at_zero = parts.first().is_some_and(|p| p.0 == 0);
        starts_at_zero.then(|| parts.into_iter().map(|(_, s)| s).collect())
    }
}

fn copy(node: &Node) -> Node {
    Node { word: node.word.clone(), end: node.end, position: node.position, rows: node.rows.clone() }
}

/// The winding number of a closed chain of half planes: right, upper, left, lower (0, 1, 2, 3), neighbours overlapping.
fn turns(path: &[Discharged]) -> Option<i32> {
    let quarter = |d: &Discharged| match (d.functional, d.sign) {
        (0, 1) => 0,
        (1, 1) => 1,
        (0, _) => 2,
        _ => 3,
    };
    let mut total = 0;
    for (k, cell) in path.iter().enumerate() {
        let next = quarter(&path[(k + 1) % path.len()]);
        total += match (next - quarter(cell) + 4) % 4 {
            0 => 0,
            1 => 1,
            3 => -1,
            // Opposite half planes have no point in common.
            _ => return None,
        };
    }
    Some(total / 4)
}
