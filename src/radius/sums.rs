//! Quadratic norms of large sets of matrices. Let `S(P) = Σ TᵗPT` and `σ` be its radius; the sum `P` of the `(S/cσ)^j(1)`, `c > 1`, has
//! `S(P) <= cσP`, so no matrix expands `P` by more than the root of `cσ`, whatever the coordinates are. Floats propose the form and
//! the bound; that no matrix expands the rounded form is decided exactly.
#![allow(clippy::float_arithmetic, reason = "proposes a form, which is then checked exactly")]
#![allow(clippy::cast_possible_truncation, reason = "rounds numbers below 2^41")]

use super::answer::Proof;
use super::budget::Budget;
use super::quadratic::Quadratic;
use super::radial::Radial;
use super::strategy::{Found, Outcome, Strategy, Target};
use super::system::System;
use crate::algebraic::nearest;
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use nalgebra::DMatrix;

/// From which dimension on it is tried: polytopes are better in small ones.
const LEAST: usize = 30;
/// Steps to the radius of the sum.
const POWERS: usize = 60;
/// Terms of the form.
const TERMS: usize = 160;
/// The factor `c`.
const SLACK: f64 = 1.05;
/// Size of the largest entry of a form.
const SCALE: f64 = 1_099_511_627_776.0;
/// Relative room of the bounds that are tried.
const ROOM: [f64; 3] = [1e-3, 1e-2, 5e-2];

pub(super) struct Sums;

impl<E: Radial> Strategy<E> for Sums {
    fn attempt(&self, target: &Target<E>, known: f64, budget: &Budget) -> Outcome<E> {
        let system = &target.block.system;
        let [dim] = system.dims[..] else { return Outcome::Nothing };
        let work = (dim.pow(3) * (2 * (POWERS + TERMS) + 400) * system.arrows.len()) as u64;
        if dim < LEAST || !budget.spend(work) {
            return Outcome::Nothing;
        }
        let letters: Vec<DMatrix<f64>> =
            system.arrows.iter().map(|a| DMatrix::from_fn(dim, dim, |i, j| nearest(&a.matrix[(i, j)]))).collect();
        let form = rounded(&summed(&letters, dim));
        let Some(found) = expansion(&letters, &form).filter(|r| r.is_finite() && *r < known) else {
            return Outcome::Nothing;
        };
        let forms = vec![Matrix::from_fn(dim, dim, |i, j| E::integer(form[(i, j)] as i64))];
        match ROOM.iter().find_map(|room| proof(system, &forms, found * (1.0 + room))) {
            Some((bound, proof)) if to_f64(&bound) < known => {
                Outcome::Found(Box::new(Found { bound, proof, attains: false, roots: Vec::new() }))
            }
            _ => Outcome::Nothing,
        }
    }

    fn share(&self) -> u64 {
        200
    }
}

/// A bound of few digits with its proof, where the forms prove it.
fn proof<E: Radial>(system: &System<E>, forms: &[Matrix<E>], radius: f64) -> Option<(Rational, Proof<E>)> {
    let digits = (radius * 4096.0).ceil();
    if !(1.0..1e15).contains(&digits) {
        return None;
    }
    let bound = Rational::from(digits as i64) / Rational::from(4096);
    let proof = Quadratic { forms: forms.to_vec(), square: &bound * &bound };
    proof.holds(system).then_some((bound, Proof::Quadratic(proof)))
}

/// The form, with the largest entry 1; without a finite one no bound is found.
fn summed(letters: &[DMatrix<f64>], n: usize) -> DMatrix<f64> {
    let step = |form: &DMatrix<f64>, factor: f64| {
        letters.iter().fold(DMatrix::zeros(n, n), |sum: DMatrix<f64>, t| sum + t.tr_mul(&(form * t)) * factor)
    };
    let (mut form, mut sigma) = (DMatrix::identity(n, n), 0.0);
    for _ in 0..POWERS {
        form = step(&form, 1.0 / form.trace());
        sigma = form.trace();
    }
    let mut term: DMatrix<f64> = DMatrix::identity(n, n);
    let mut sum = term.clone();
    for _ in 0..TERMS {
        term = step(&term, 1.0 / (SLACK * sigma));
        sum += &term;
    }
    let most = sum.amax();
    sum / most
}

/// In whole numbers, and symmetric.
fn rounded(form: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(form.nrows(), form.ncols(), |i, j| (form[(i.min(j), i.max(j))] * SCALE).round())
}

/// The largest factor by which a letter expands a form `L Lᵗ`: the roots of the eigenvalues of `L⁻¹ TᵗPT L⁻ᵗ`.
fn expansion(letters: &[DMatrix<f64>], form: &DMatrix<f64>) -> Option<f64> {
    let lower = form.clone().cholesky()?.unpack();
    let mut most = 0.0_f64;
    for t in letters {
        let half = lower.solve_lower_triangular(&t.tr_mul(&(form * t)))?;
        let image = lower.solve_lower_triangular(&half.transpose())?;
        if image.iter().any(|x| !x.is_finite()) {
            return None;
        }
        most = image.symmetric_eigenvalues().iter().fold(most, |m, x| m.max(*x));
    }
    Some(most.sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::{Options, joint_radius};
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn a_large_set_is_bounded_without_splitting_it() {
        let n = 32;
        let shift =
            |step: usize| Matrix::from_fn(n, n, |i, j| if (i + step) % n == j { ratio(1, 2) } else { ratio(0, 1) });
        let system = System::plain(&[shift(1), shift(3)]).unwrap();
        let forms = vec![Matrix::identity(n)];
        assert!(proof(&system, &forms, 0.5).is_some() && proof(&system, &forms, 0.49).is_none());
        let found = joint_radius(&system, &Options { split: 8, ..Options::default() }).unwrap();
        assert_eq!((found.blocks.len(), found.upper), (1, Some(ratio(1, 2))));
    }
}
