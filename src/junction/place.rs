//! Where the points of the intermediate curve lie on a line, and what its new points have to reproduce.

use super::side::substituted;
use super::{Junction, Side, gaps};
use crate::arith::Rational;
use crate::linalg::{Matrix, dot};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;

/// Positions of the points, and for every new point the values that it has to take.
#[derive(Debug, Clone)]
pub struct Placed {
    /// The rows `1, q_1, …` on the points; `q_1` are the positions.
    pub values: Matrix,
    /// By new point, the same values of it.
    pub targets: Vec<Vec<Rational>>,
    /// The factor by which distances shrink from the intermediate curve to the copy of itself in it.
    pub shrinks: Rational,
    /// Whether both schemes reproduce the values, so that the whole joined curve does.
    pub precise: bool,
}

impl Placed {
    /// The positions of the points.
    #[must_use]
    pub fn positions(&self) -> &[Rational] {
        self.values.row(1)
    }

    /// The highest power that is reproduced.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.values.rows() - 1
    }

    /// The same up to a smaller power.
    #[must_use]
    pub fn up_to(&self, degree: usize) -> Self {
        let rows = (0..=degree).map(|d| self.values.row(d).to_vec()).collect();
        let targets = self.targets.iter().map(|t| t[..=degree].to_vec()).collect();
        Self { values: Matrix::from_rows(self.values.cols(), rows), targets, ..self.clone() }
    }

    /// Whether a row of the array has the values that it should have.
    #[must_use]
    pub fn agrees(&self, row: usize, entries: &[Rational]) -> bool {
        (0..self.values.rows()).all(|d| dot(self.values.row(d), entries) == self.targets[row][d])
    }
}

/// How far the points of a vertex reach beyond it, to the right (or the left).
fn reach(positions: &[Rational], right: bool) -> Rational {
    let signed = positions.iter().map(|x| if right { x.clone() } else { -x });
    signed.fold(Rational::from(0), |m, x| m.max(x))
}

/// The length of the intermediate curve where the pieces of both schemes have length 1, and whether the points of its two ends do
/// not get into each other's way.
pub(super) fn room(junction: &Junction, powers: [&[Vec<Rational>]; 2]) -> (Rational, bool) {
    let pieces = junction.pattern.left + junction.pattern.right;
    let length = Rational::from(pieces) / Rational::from(junction.left.arity() - 1);
    let [a, b] = powers;
    let needed = reach(&a[1][..junction.left.shared], true) + reach(&b[1][..junction.right.shared], false);
    let fits = length > needed;
    (length, fits)
}

/// Positions and powers up to a degree that both schemes reproduce by the same arity; `None` where shared points or forced rows
/// contradict them.
pub(super) fn precise(junction: &Junction, powers: [&[Vec<Rational>]; 2], degree: usize) -> Option<Placed> {
    let [a, b] = powers;
    let (p, q, n) = (junction.left.shared, junction.right.shared, junction.points);
    let (length, _) = room(junction, powers);
    let one = Rational::from(1);
    let mut values: Vec<Vec<Rational>> = Vec::new();
    for d in 0..=degree {
        let far = substituted(b, d, &one, &length, d + 1);
        let mut row: Vec<Option<Rational>> = vec![None; n];
        row[..p].iter_mut().zip(&a[d]).for_each(|(x, v)| *x = Some(v.clone()));
        for (x, v) in row[n - q..].iter_mut().zip(&far) {
            if x.as_ref().is_some_and(|old| old != v) {
                return None;
            }
            *x = Some(v.clone());
        }
        // Further points lie evenly between those of the ends.
        let even = |i: usize| {
            let (from, to) = (&a[1][p - 1], &b[1][0] + &length);
            from + (to - from) * Rational::from(i + 1 - p) / Rational::from(n - q + 1 - p)
        };
        values.push((0..n).map(|i| row[i].clone().unwrap_or_else(|| super::side::power(&even(i), d))).collect());
    }
    let share = Rational::from(1) / Rational::from(junction.left.arity());
    let mut targets = vec![Vec::new(); junction.rows()];
    for (w, (start, len)) in junction.windows().into_iter().enumerate() {
        let k = junction.pattern.left;
        let (own, at) = match w.cmp(&k) {
            std::cmp::Ordering::Less => (a, Rational::from(w)),
            std::cmp::Ordering::Equal => (values.as_slice(), Rational::from(k)),
            std::cmp::Ordering::Greater => (b, Rational::from(w - 1) + &length),
        };
        let at = at * &share;
        let all: Vec<Vec<Rational>> = (0..=degree).map(|d| substituted(own, d, &share, &at, d + 1)).collect();
        for i in 0..len {
            targets[start + i] = all.iter().map(|v| v[i].clone()).collect();
        }
    }
    checked(junction, Placed { values: Matrix::from_rows(n, values), targets, shrinks: share, precise: true })
}

/// The same, where the forced rows have the values that they should have.
fn checked(junction: &Junction, placed: Placed) -> Option<Placed> {
    let forced = junction.forced().ok()?;
    let agrees = forced.iter().enumerate().all(|(r, row)| row.as_ref().is_none_or(|entries| placed.agrees(r, entries)));
    agrees.then_some(placed)
}

/// Positions without powers, for schemes that have none in common: they increase, so do those of all new points, the least gap
/// of these is as large as possible, and the intermediate curve holds a copy of itself that is smaller by `shrinks`.
pub(super) fn increasing(junction: &Junction, shrinks: &Rational) -> Option<Placed> {
    let n = junction.points;
    let (start, _) = junction.windows()[junction.pattern.left];
    let forced = junction.forced().ok()?;
    // Unknowns: the least gap, the shift (as a difference of two), the gaps of the positions, then one slack for each inequality.
    let own = 3 + n - 1;
    let zero = || Rational::from(0);
    let position =
        |i: usize| -> Vec<Rational> { (0..own).map(|u| Rational::from(u8::from(u >= 3 && u < 3 + i))).collect() };
    let weighted = |row: &[Rational]| {
        let mut sum = vec![zero(); own];
        for (i, x) in row.iter().enumerate().filter(|(_, x)| **x != 0) {
            sum.iter_mut().zip(position(i)).for_each(|(s, p)| *s += x * p);
        }
        sum
    };
    let copied = |i: usize| {
        let mut row: Vec<Rational> = position(i).iter().map(|x| x * shrinks).collect();
        (row[1], row[2]) = (Rational::from(1), Rational::from(-1));
        row
    };
    let mut known: Vec<(usize, Vec<Rational>)> = Vec::new();
    let mut system: Vec<(Vec<Rational>, Rational)> = Vec::new();
    for (r, row) in forced.iter().enumerate() {
        let inside = (start..start + n).contains(&r);
        match row {
            Some(entries) => {
                let here = weighted(entries);
                if inside {
                    system.push((minus(&here, &copied(r - start)), zero()));
                }
                known.push((r, here));
            }
            None if inside => known.push((r, copied(r - start))),
            None => {}
        }
    }
    let mut least = Vec::new();
    for pair in known.windows(2) {
        let mut row = minus(&pair[1].1, &pair[0].1);
        row[0] -= Rational::from(pair[1].0 - pair[0].0);
        least.push(row);
    }
    // The positions span n − 1.
    system.push((position(n - 1), Rational::from(n - 1)));
    for row in &mut system {
        row.0.resize(own + least.len(), zero());
    }
    for (k, mut row) in least.into_iter().enumerate() {
        row.resize(own, zero());
        row.extend((0..k).map(|_| zero()));
        row.push(Rational::from(-1));
        system.push((row, zero()));
    }
    let width = system.iter().map(|r| r.0.len()).max()?;
    system.iter_mut().for_each(|r| r.0.resize(width, zero()));
    let found = gaps::largest(&system)?;
    (found[0] > 0).then(|| laid_out(junction, &found[..own], &known, shrinks)).and_then(|p| checked(junction, p))
}

fn minus(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

/// The positions of a solution; new points between those that are known lie evenly.
fn laid_out(junction: &Junction, found: &[Rational], known: &[(usize, Vec<Rational>)], shrinks: &Rational) -> Placed {
    let n = junction.points;
    let mut positions = vec![Rational::from(0)];
    for gap in &found[3..] {
        positions.push(&positions[positions.len() - 1] + gap);
    }
    let fixed: Vec<(usize, Rational)> = known.iter().map(|(r, row)| (*r, dot(row, found))).collect();
    let mut targets = vec![Vec::new(); junction.rows()];
    for pair in fixed.windows(2) {
        let ((from, low), (to, high)) = (&pair[0], &pair[1]);
        for (r, target) in targets.iter_mut().enumerate().take(to + 1).skip(*from) {
            let share = Rational::from(r - from) / Rational::from(to - from);
            *target = vec![Rational::from(1), low + (high - low) * share];
        }
    }
    let values = Matrix::from_rows(n, vec![vec![Rational::from(1); n], positions]);
    Placed { values, targets, shrinks: shrinks.clone(), precise: false }
}

/// The simplest rational strictly between two, or one of them where they are equal.
pub(super) fn between(a: &Rational, b: &Rational) -> Rational {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    if low == high {
        return low.clone();
    }
    Rational::simplest_rational_in_open_interval(low, high)
}

/// The factors by which the intermediate curve may shrink: between those of its ends.
pub(super) fn factors(left: &Side, right: &Side) -> Vec<Rational> {
    let own = |side: &Side| side.shrinks().unwrap_or_else(|| Rational::from(1) / Rational::from(side.arity()));
    let (a, b) = (own(left), own(right));
    let (middle, largest) = (between(&a, &b), a.max(b));
    if middle == largest { vec![middle] } else { vec![middle, largest] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_between_two_close_ones() {
        let (mut low, mut high) = (Rational::from(1) / Rational::from(2), Rational::from(1));
        assert_eq!(between(&high, &low), Rational::from(2) / Rational::from(3));
        // Quotients of Fibonacci numbers, on either side of the golden section.
        for _ in 0..120 {
            (low, high) = (high.clone(), Rational::from(1) / (Rational::from(1) + high));
        }
        let found = between(&low, &high);
        assert!(found > low.clone().min(high.clone()) && found < low.max(high));
    }
}
