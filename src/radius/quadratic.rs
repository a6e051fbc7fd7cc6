//! Quadratic norms: `T^t P_from T <= r² P_to` proves that the radius is at most `r`.

use super::System;
use super::answer::Proof;
use super::budget::Budget;
use super::radial::Radial;
use super::strategy::{Found, Outcome, Strategy, Target};
use crate::arith::{Integer, Rational};
use crate::linalg::Matrix;
use malachite_base::num::arithmetic::traits::DivExact;

/// Positive definite forms, one for every state, that no arrow expands by more than `r`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quadratic<E = Rational> {
    /// The forms.
    pub forms: Vec<Matrix<E>>,
    /// The square of the bound.
    pub square: Rational,
}

impl<E: Radial> Quadratic<E> {
    /// Whether the forms are positive definite and no arrow expands them.
    #[must_use]
    pub fn holds(&self, system: &System<E>) -> bool {
        self.forms.len() == system.dims.len()
            && self
                .forms
                .iter()
                .zip(&system.dims)
                .all(|(f, d)| (f.rows(), f.cols()) == (*d, *d) && *f == f.transpose() && E::definite(f, true))
            && system.arrows.iter().all(|a| {
                let image = &(&a.matrix.transpose() * &self.forms[a.from]) * &a.matrix;
                E::definite(&(&self.forms[a.to].scale(&E::of(&self.square)) - &image), false)
            })
    }

    /// Forms that prove the bound with this square: the Euclidean ones, or ones that all arrows, or one of `letters`,
    /// preserve exactly.
    #[must_use]
    pub fn find(system: &System<E>, square: &Rational, letters: &[usize]) -> Option<Self> {
        let forms = system.dims.iter().map(|d| Matrix::identity(*d)).collect();
        let euclidean = Self { forms, square: square.clone() };
        if euclidean.holds(system) {
            return Some(euclidean);
        }
        let all: Vec<usize> = (0..system.arrows.len()).collect();
        std::iter::once(all.as_slice())
            .chain(letters.chunks(1))
            .filter_map(|arrows| preserved(system, square, arrows))
            .map(|forms| Self { forms, square: square.clone() })
            .find(|found| found.holds(system))
    }
}

/// Quadratic norms at the radius itself, where its square is rational.
pub(super) struct QuadraticNorm;

impl<E: Radial> Strategy<E> for QuadraticNorm {
    fn attempt(&self, target: &Target<E>, _known: f64, budget: &Budget) -> Outcome<E> {
        let system = &target.block.system;
        let Some(square) = target.best.lower.as_ref().and_then(super::Lower::square) else { return Outcome::Nothing };
        let size: u64 = system.dims.iter().map(|d| (d * (d + 1) / 2) as u64).sum();
        if size > MAX_UNKNOWNS || !budget.spend(500 * size.pow(3)) {
            return Outcome::Nothing;
        }
        let letters: Vec<usize> = target.own.iter().filter(|l| l.length == 1).map(|l| l.path[0]).collect();
        let Some(proof) = Quadratic::find(system, &square, &letters) else { return Outcome::Nothing };
        let bound = match target.best.lower.as_ref().and_then(super::Lower::rational) {
            Some(radius) => radius,
            None => super::square_root(&square, 64).hi,
        };
        Outcome::Found(Box::new(Found { bound, proof: Proof::Quadratic(proof), attains: true, roots: Vec::new() }))
    }
}

/// Most entries of forms that are solved for.
const MAX_UNKNOWNS: u64 = 60;

/// Symmetric forms with `T^t P T = square P` for some arrows, if they are unique up to a factor.
fn preserved<E: Radial>(system: &System<E>, square: &Rational, arrows: &[usize]) -> Option<Vec<Matrix<E>>> {
    let mut unknowns: Vec<(usize, usize, usize)> = Vec::new();
    for (s, &d) in system.dims.iter().enumerate() {
        unknowns.extend((0..d).flat_map(|i| (0..=i).map(move |j| (s, i, j))));
    }
    let square = E::of(square);
    let mut rows: Vec<Vec<E>> = Vec::new();
    for a in arrows.iter().map(|k| &system.arrows[*k]) {
        for p in 0..a.matrix.cols() {
            for q in 0..=p {
                let coefficient = |&(s, i, j): &(usize, usize, usize)| {
                    let mut c = E::zero();
                    if s == a.from {
                        c = a.matrix[(i, p)].times(&a.matrix[(j, q)]);
                        if i != j {
                            c = c.plus(&a.matrix[(j, p)].times(&a.matrix[(i, q)]));
                        }
                    }
                    if s == a.to && (i, j) == (p, q) {
                        c = c.minus(&square);
                    }
                    c
                };
                rows.push(unknowns.iter().map(coefficient).collect());
            }
        }
    }
    let kernel = Matrix::from_rows(unknowns.len(), rows).kernel();
    if kernel.cols() != 1 {
        return None;
    }
    let mut forms: Vec<Matrix<E>> = system.dims.iter().map(|d| Matrix::zero(*d, *d)).collect();
    for (k, &(s, i, j)) in unknowns.iter().enumerate() {
        forms[s][(i, j)] = kernel[(k, 0)].clone();
        forms[s][(j, i)] = kernel[(k, 0)].clone();
    }
    if forms.first().is_some_and(|f| f.rows() > 0 && f[(0, 0)].sign() < 0) {
        forms = forms.into_iter().map(|f| f.scale(&E::integer(-1))).collect();
    }
    Some(forms)
}

/// Whether a symmetric matrix is positive definite (or, not `strict`, positive semidefinite), by exact elimination without
/// fractions.
#[must_use]
pub fn definite(m: &Matrix, strict: bool) -> bool {
    let n = m.rows();
    let whole = m.cleared().1;
    let mut a: Vec<Vec<Integer>> = (0..n).map(|i| whole.row(i).to_vec()).collect();
    let mut before = Integer::from(1);
    for k in 0..n {
        let pivot = a[k][k].clone();
        if pivot < 0 || (strict && pivot == 0) {
            return false;
        }
        if pivot == 0 {
            if a[k][k..].iter().any(|x| *x != 0) {
                return false;
            }
            continue;
        }
        let (top, below) = a.split_at_mut(k + 1);
        let row = &top[k];
        // The rows keep what is on and above the diagonal.
        for (i, line) in below.iter_mut().enumerate().map(|(i, line)| (i + k + 1, line)) {
            for (x, y) in line[i..].iter_mut().zip(&row[i..]) {
                *x = (&*x * &pivot - &row[i] * y).div_exact(&before);
            }
        }
        before = pivot;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn rotations_keep_the_circle() {
        let rotation = |c: (i64, i64), s: (i64, i64)| {
            let (c, s) = (ratio(c.0, c.1), ratio(s.0, s.1));
            Matrix::from_rows(2, vec![vec![c.clone(), -&s], vec![s, c]])
        };
        let system = System::plain(&[rotation((3, 5), (4, 5)), rotation((5, 13), (12, 13))]).unwrap();
        assert!(Quadratic::find(&system, &ratio(1, 1), &[]).is_some());
        assert!(Quadratic::find(&system, &ratio(99, 100), &[]).is_none());
    }

    #[test]
    fn definite_forms() {
        let form = |rows: [[i64; 3]; 3]| Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 7));
        assert!(definite(&form([[2, -1, 0], [-1, 2, -1], [0, -1, 2]]), true));
        let flat = form([[1, 1, 2], [1, 1, 2], [2, 2, 5]]);
        assert!(definite(&flat, false) && !definite(&flat, true));
        assert!(!definite(&form([[0, 1, 0], [1, 0, 0], [0, 0, 1]]), false));
        assert!(!definite(&form([[1, 2, 0], [2, 3, 0], [0, 0, 1]]), false));
        assert!(definite(&form([[0, 0, 0], [0, 3, 1], [0, 1, 2]]), false));
    }
}
