//! Closed paths that wind around 0 (theory §7, Refuting, (c)).

use super::place::Chart;
use super::verdict::Winding;
use crate::arith::{Interval, Rational};
use crate::shape::{CellKind, Complex};
use crate::theorem::ring::{Node, Position, Ring};
use crate::theorem::{Discharged, Functional};
use std::collections::VecDeque;

/// Rounds of the search: how many cells of the ring are tried, and how many pieces of each boundary at most.
const ROUNDS: [(usize, usize); 3] = [(40, 100), (12, 600), (4, 2400)];
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
    ROUNDS.iter().find_map(|(cells, longest)| search.round(ring.roots(&rows), *cells, *longest))
}

struct Search<'a> {
    chart: &'a Chart<'a>,
    complex: &'a Complex,
    ring: &'a Ring<'a>,
    errors: [Rational; 2],
}

impl Search<'_> {
    /// Tries so many cells, larger ones first.
    fn round(&self, mut queue: VecDeque<Node>, cells: usize, longest: usize) -> Option<Winding> {
        let mut left = cells;
        while let Some(node) = queue.pop_front() {
            crate::stop::check();
            if self.strict(&node).is_some() || self.complex.shape.states[node.end].kind != CellKind::Face {
                continue;
            }
            if let Some(found) = self.around(&node, longest) {
                return Some(found);
            }
            left = left.checked_sub(1)?;
            queue.extend(self.ring.children(&node));
        }
        None
    }

    /// A functional with a strict sign on the cell.
    fn strict(&self, node: &Node) -> Option<Discharged> {
        for (functional, (row, error)) in node.rows.iter().zip(&self.errors).enumerate() {
            let values = self.ring.balls.enclose(self.ring.spaces, node.end, row, 64);
            let bound = &values + &Interval::symmetric(error.clone());
            if let Some(sign @ (1 | -1)) = bound.sign() {
                let (word, position) = (node.word.clone(), Position::Unordered);
                return Some(Discharged { word, end: node.end, functional, sign, position, bound });
            }
        }
        None
    }

    /// The winding number of the boundary of a cell, where it is not 0 and can be told.
    fn around(&self, node: &Node, longest: usize) -> Option<Winding> {
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
            if steps > longest {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;
    use crate::scheme::{bspline, tensor};
    use crate::shape::{Balls, Spaces};
    use crate::theorem::rational_contraction;

    /// The bilinear patch is the unit square itself: `(s − a, t − b)` has a zero in it, once around or once against the clock,
    /// or none.
    #[test]
    fn boundaries_of_the_unit_square() {
        let line = bspline(1, 2).unwrap().curve_with_vertices().unwrap();
        let complex = tensor(&line, &line).unwrap();
        let shape = &complex.shape;
        let chart = Chart::new(&complex).unwrap();
        let spaces = Spaces::new(shape).unwrap();
        let balls =
            Balls::of(shape, &spaces, &rational_contraction(shape, &crate::budget::Budget::default()).unwrap().0)
                .unwrap();
        let nothing = Matrix::zero(0, 4);
        let ring = Ring {
            shape,
            base: &(),
            spaces: &spaces,
            balls: &balls,
            state: 0,
            fixed: &[],
            chart: &nothing,
            pieces: &[],
        };
        let search = Search { chart: &chart, complex: &complex, ring: &ring, errors: [ratio(0, 1), ratio(0, 1)] };
        // Values at the corners in the order of the control points, read off the corners of the patch.
        let corner = |k: usize| shape.point(0, &crate::shape::Address::periodic(vec![k])).unwrap();
        let place = |k: usize| corner(k).iter().position(|x| *x == 1).unwrap();
        let row = |f: &dyn Fn(i64, i64) -> Rational| {
            let mut row = vec![ratio(0, 1); 4];
            for (k, (s, t)) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().enumerate() {
                row[place(k)] = f(s, t);
            }
            row
        };
        let whole = |a: (i64, i64), b: (i64, i64), swapped: bool| {
            let s = row(&|s, _| ratio(s, 1) - ratio(a.0, a.1));
            let t = row(&|_, t| ratio(t, 1) - ratio(b.0, b.1));
            let rows = if swapped { vec![t, s] } else { vec![s, t] };
            Node { word: Vec::new(), end: 0, position: Position::Unordered, rows }
        };
        let number = |node: Node| search.round([node].into(), 1, 600).map(|w| (w.number, w.path.len()));
        let (once, stretches) = number(whole((2, 5), (4, 7), false)).unwrap();
        assert_eq!(once, 1);
        assert!(stretches >= 8);
        assert_eq!(number(whole((2, 5), (4, 7), true)).map(|w| w.0), Some(-1));
        assert_eq!(number(whole((7, 5), (4, 7), false)), None);
        // A zero on the boundary is none inside.
        assert_eq!(number(whole((0, 1), (4, 7), false)), None);
    }
}
