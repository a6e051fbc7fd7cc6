//! The operators of a mask on windows: finite sets of points whose new points depend on old points of the set only.

use crate::arith::Rational;
use crate::linalg::{Echelon, Matrix};
use crate::scheme::LatticeMask;
use std::collections::BTreeSet;

/// Highest order of sum rules that is looked for.
pub const MAX_RULES: usize = 12;
/// Most points of a window.
pub const MAX_WINDOW: usize = 256;

/// Exponents of the monomials of degree up to `degree` in `s` variables, the lowest degrees first.
#[must_use]
pub fn monomials(s: usize, degree: usize) -> Vec<Vec<i64>> {
    let top = degree as i64;
    let mut all: Vec<Vec<i64>> = vec![Vec::new()];
    for _ in 0..s {
        let longer = |a: Vec<i64>| {
            let used: i64 = a.iter().sum();
            (0..=top - used).map(move |k| [a.as_slice(), &[k]].concat())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all.sort_by_key(|a| (a.iter().sum::<i64>(), a.clone()));
    all
}

fn value(exponent: &[i64], at: &[i64]) -> Rational {
    let power = |x: i64, e: i64| (0..e).fold(Rational::from(1), |p, _| p * Rational::from(x));
    exponent.iter().zip(at).fold(Rational::from(1), |p, (e, x)| p * power(*x, *e))
}

/// The values of the monomials (rows) at points (columns).
fn values(s: usize, degree: usize, points: &[Vec<i64>]) -> Matrix {
    let rows = monomials(s, degree);
    Matrix::from_fn(rows.len(), points.len(), |i, j| value(&rows[i], &points[j]))
}

/// The order of the sum rules, at most [`MAX_RULES`]: up to which degree (excluded) all cosets have the same moments.
#[must_use]
pub fn sum_rules(mask: &LatticeMask) -> usize {
    let (m, s) = (mask.dilation(), mask.dilation().dimensions());
    let equal = |exponent: &Vec<i64>| {
        let mut moments = vec![Rational::from(0); m.index()];
        for (a, c) in mask.terms().iter() {
            moments[m.coset(a)] += c * value(exponent, a);
        }
        moments.windows(2).all(|w| w[0] == w[1])
    };
    let exact =
        |degree: usize| monomials(s, degree).iter().filter(|a| a.iter().sum::<i64>() == degree as i64).all(equal);
    (0..MAX_RULES).take_while(|degree| exact(*degree)).count()
}

/// A window, with the rank that shows that neighbouring ones overlap enough.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Window {
    /// Its points, ascending.
    pub points: Vec<Vec<i64>>,
    /// The degree `k` of the polynomials.
    pub degree: usize,
    /// The dimension of the space of polynomials of that degree; the values at the common points of two windows that are one step
    /// along an axis apart have this rank.
    pub rank: usize,
}

/// The points on which new points at `seed` and its followers depend, and the seed; `None` where there are too many.
fn closure(mask: &LatticeMask, seed: &[Vec<i64>]) -> Option<Vec<Vec<i64>>> {
    let m = mask.dilation();
    let mut found: BTreeSet<Vec<i64>> = seed.iter().cloned().collect();
    let mut open: Vec<Vec<i64>> = seed.to_vec();
    while let Some(i) = open.pop() {
        for digit in m.digits() {
            for (a, _) in mask.terms().iter() {
                let moved: Vec<i64> = i.iter().zip(digit).zip(a).map(|((x, d), y)| x + d - y).collect();
                if let Some(j) = m.divide(&moved)
                    && found.insert(j.clone())
                {
                    open.push(j);
                }
            }
        }
        if found.len() > MAX_WINDOW {
            return None;
        }
    }
    Some(found.into_iter().collect())
}

impl Window {
    /// The closure of the smallest simplex for which neighbouring windows overlap enough for polynomials of degree `k`; that of
    /// side `k + 1` does. `None` where it is too large.
    #[must_use]
    pub fn of(mask: &LatticeMask, degree: usize) -> Option<Self> {
        let s = mask.dilation().dimensions();
        (0..=degree + 1).find_map(|side| Self::around(mask, &monomials(s, side), degree))
    }

    /// The closure of a seed, where neighbouring windows overlap enough.
    fn around(mask: &LatticeMask, seed: &[Vec<i64>], degree: usize) -> Option<Self> {
        let s = mask.dilation().dimensions();
        let points = closure(mask, seed)?;
        let rank = monomials(s, degree).len();
        let overlaps = |axis: usize| {
            let before = |p: &&Vec<i64>| {
                let mut q = (*p).clone();
                q[axis] -= 1;
                points.binary_search(&q).is_ok()
            };
            let common: Vec<Vec<i64>> = points.iter().filter(before).cloned().collect();
            common.len() >= rank && values(s, degree, &common).rank() == rank
        };
        (0..s).all(overlaps).then_some(Self { points, degree, rank })
    }

    /// The operator `m(i + d − Mj)` of a digit.
    #[must_use]
    pub fn operator(&self, mask: &LatticeMask, digit: &[i64]) -> Matrix {
        let n = self.points.len();
        Matrix::from_fn(n, n, |i, j| {
            let moved: Vec<i64> = self.points[i].iter().zip(digit).map(|(x, d)| x + d).collect();
            mask.weight(&moved, &self.points[j]).map_or_else(|| Rational::from(0), Clone::clone)
        })
    }

    /// The operators on nets modulo polynomials, in the coordinates of this window; `None` where polynomials are not
    /// kept.
    #[must_use]
    pub fn quotient(&self, mask: &LatticeMask) -> Option<Vec<Matrix>> {
        let polynomials = values(mask.dilation().dimensions(), self.degree, &self.points).echelon();
        let operators: Vec<Matrix> = mask.dilation().digits().iter().map(|d| self.operator(mask, d)).collect();
        operators_keep(&polynomials, &operators).then(|| modulo(&polynomials, &operators))
    }
}

/// Operators on nets modulo a space of nets (rows in echelon form): the values at the points that are no pivots, after that multiple
/// of every row is taken off which makes the value at its pivot 0.
fn reduced(space: &Echelon, operator: &Matrix) -> Matrix {
    let (rows, pivots) = (&space.rows, &space.pivots);
    let row = |f: usize| {
        let mut row = operator.row(f).to_vec();
        for (i, p) in pivots.iter().enumerate().filter(|(i, _)| rows[(*i, f)] != 0) {
            row.iter_mut().zip(operator.row(*p)).for_each(|(x, y)| *x -= &rows[(i, f)] * y);
        }
        row
    };
    let free = (0..rows.cols()).filter(|j| !pivots.contains(j));
    Matrix::from_rows(rows.cols(), free.map(row).collect())
}

/// Whether operators keep a space of nets.
pub fn operators_keep(space: &Echelon, operators: &[Matrix]) -> bool {
    operators.iter().all(|a| (&reduced(space, a) * &space.rows.transpose()).is_zero())
}

/// Operators on nets modulo a space of nets that they keep, in the coordinates that are no pivots of it.
pub fn modulo(space: &Echelon, operators: &[Matrix]) -> Vec<Matrix> {
    let free: Vec<usize> = (0..space.rows.cols()).filter(|j| !space.pivots.contains(j)).collect();
    let on = |a: &Matrix| {
        let whole = reduced(space, a);
        Matrix::from_fn(free.len(), free.len(), |i, j| whole[(i, free[j])].clone())
    };
    operators.iter().map(on).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn mask(text: &str) -> LatticeMask {
        LatticeMask::parse(text, None).unwrap()
    }

    #[test]
    fn small_windows_do_not_overlap_enough() {
        // On the closure of 0 alone both would seem smoother than they are.
        let bilinear = mask("(1+x)^2*(1+y)^2/4");
        assert_eq!(sum_rules(&bilinear), 2);
        assert_eq!(closure(&bilinear, &[vec![0, 0]]).unwrap().len(), 4);
        assert!(Window::around(&bilinear, &[vec![0, 0]], 1).is_none());
        let small = Window { points: closure(&bilinear, &[vec![0, 0]]).unwrap(), degree: 1, rank: 3 };
        assert!(small.quotient(&bilinear).unwrap().iter().all(|m| m.entries() == [ratio(1, 4)]));
        let window = Window::of(&bilinear, 1).unwrap();
        assert!(window.points.len() > 4);
        let letters = window.quotient(&bilinear).unwrap();
        let slow =
            |m: &Matrix| m.rows() > 0 && (m + &Matrix::identity(m.rows()).scale(&ratio(-1, 2))).rank() < m.rows();
        assert!(letters.iter().any(slow), "an eigenvalue 1/2");
        let haar = mask("(1+x)*(1+y)");
        assert_eq!((sum_rules(&haar), closure(&haar, &[vec![0, 0]]).unwrap().len()), (1, 1));
        assert!(Window::of(&haar, 0).unwrap().points.len() > 1);
    }

    #[test]
    fn sum_rules_of_box_splines() {
        for (text, order) in
            [("(1+x)^2*(1+y)^2*(1+x*y)^2/16", 4), ("(1+x)*(1+y)*(1+x*y)*(1+x/y)/4", 2), ("(1+x)^3*(1+y)^3/16", 3)]
        {
            assert_eq!(sum_rules(&mask(text)), order, "{text}");
        }
        assert_eq!(monomials(2, 3).len(), 10);
        assert_eq!(monomials(3, 2).len(), 10);
    }
}
