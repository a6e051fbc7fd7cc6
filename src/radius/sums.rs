//! Quadratic norms of large sets of matrices. Let `S(P) = Σ TᵗPT` and `σ` be its radius; the sum `P` of the `(S/cσ)^j(1)`, `c > 1`, has
//! `S(P) <= cσP`, so no matrix expands `P` by more than the root of `cσ`, whatever the coordinates are. Floats propose the form and
//! the bound; that no matrix expands the rounded form is decided exactly.
#![allow(clippy::float_arithmetic, reason = "proposes a form, which is then checked exactly")]
#![allow(clippy::cast_possible_truncation, reason = "rounds numbers below 2^41")]

use super::answer::Proof;
use super::budget::Budget;
use super::quadratic::Quadratic;
use super::strategy::{Found, Outcome, Strategy, Target};
use super::system::System;
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;

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

impl Strategy for Sums {
    fn attempt(&self, target: &Target, known: f64, budget: &Budget) -> Outcome {
        let system = &target.block.system;
        let [dim] = system.dims[..] else { return Outcome::Nothing };
        let work = (dim.pow(3) * (2 * (POWERS + TERMS) + 400) * system.arrows.len()) as u64;
        if dim < LEAST || !budget.spend(work) {
            return Outcome::Nothing;
        }
        let letters: Vec<Vec<f64>> =
            system.arrows.iter().map(|a| a.matrix.entries().iter().map(to_f64).collect()).collect();
        let form = rounded(&summed(&letters, dim), dim);
        let Some(found) = expansion(&letters, &form, dim).filter(|r| r.is_finite() && *r < known) else {
            return Outcome::Nothing;
        };
        let forms = vec![Matrix::from_fn(dim, dim, |i, j| Rational::from(form[i * dim + j] as i64))];
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
fn proof(system: &System, forms: &[Matrix], radius: f64) -> Option<(Rational, Proof)> {
    let digits = (radius * 4096.0).ceil();
    if !(1.0..1e15).contains(&digits) {
        return None;
    }
    let bound = Rational::from(digits as i64) / Rational::from(4096);
    let proof = Quadratic { forms: forms.to_vec(), square: &bound * &bound };
    proof.holds(system).then_some((bound, Proof::Quadratic(proof)))
}

fn product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let mut out = vec![0.0; n * n];
    for i in 0..n {
        for k in 0..n {
            let x = a[i * n + k];
            if x != 0.0 {
                for j in 0..n {
                    out[i * n + j] += x * b[k * n + j];
                }
            }
        }
    }
    out
}

fn transposed(a: &[f64], n: usize) -> Vec<f64> {
    (0..n * n).map(|k| a[(k % n) * n + k / n]).collect()
}

/// The form, with the largest entry 1; without a finite one no bound is found.
fn summed(letters: &[Vec<f64>], n: usize) -> Vec<f64> {
    let turned: Vec<Vec<f64>> = letters.iter().map(|t| transposed(t, n)).collect();
    let step = |form: &[f64], factor: f64| {
        let mut sum = vec![0.0; n * n];
        for (t, u) in letters.iter().zip(&turned) {
            sum.iter_mut().zip(product(u, &product(form, t, n), n)).for_each(|(x, y)| *x += factor * y);
        }
        sum
    };
    let trace = |form: &[f64]| (0..n).map(|i| form[i * n + i]).sum::<f64>();
    let unit: Vec<f64> = (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect();
    let (mut form, mut sigma) = (unit.clone(), 0.0);
    for _ in 0..POWERS {
        let before = trace(&form);
        form = step(&form, 1.0 / before);
        sigma = trace(&form);
    }
    let (mut term, mut sum) = (unit.clone(), unit);
    for _ in 0..TERMS {
        term = step(&term, 1.0 / (SLACK * sigma));
        sum.iter_mut().zip(&term).for_each(|(x, y)| *x += y);
    }
    let most = sum.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    sum.iter().map(|x| x / most).collect()
}

/// In whole numbers, and symmetric.
fn rounded(form: &[f64], n: usize) -> Vec<f64> {
    let upper = |k: usize| form[(k / n).min(k % n) * n + (k / n).max(k % n)];
    (0..n * n).map(|k| (upper(k) * SCALE).round()).collect()
}

/// The largest factor by which a letter expands a form, by Cholesky's decomposition and the power method.
fn expansion(letters: &[Vec<f64>], form: &[f64], n: usize) -> Option<f64> {
    let lower = cholesky(form, n)?;
    let back = |v: &mut [f64]| {
        // Solves Lᵗ x = v.
        for i in (0..n).rev() {
            let rest: f64 = (i + 1..n).map(|k| lower[k * n + i] * v[k]).sum();
            v[i] = (v[i] - rest) / lower[i * n + i];
        }
    };
    let forth = |v: &mut [f64]| {
        for i in 0..n {
            let rest: f64 = (0..i).map(|k| lower[i * n + k] * v[k]).sum();
            v[i] = (v[i] - rest) / lower[i * n + i];
        }
    };
    let apply = |m: &[f64], v: &[f64]| (0..n).map(|i| (0..n).map(|j| m[i * n + j] * v[j]).sum()).collect::<Vec<f64>>();
    let mut most = 0.0_f64;
    for t in letters {
        let image = product(&transposed(t, n), &product(form, t, n), n);
        let mut v: Vec<f64> = (0..n).map(|i| 1.0 + (i as f64 * 0.7).sin()).collect();
        let mut value = 0.0;
        for _ in 0..100 {
            let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.iter_mut().for_each(|x| *x /= size);
            back(&mut v);
            v = apply(&image, &v);
            forth(&mut v);
            value = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        }
        most = most.max(value);
    }
    Some(most.sqrt())
}

fn cholesky(form: &[f64], n: usize) -> Option<Vec<f64>> {
    let mut lower = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
            let rest = form[i * n + j] - known;
            lower[i * n + j] = match i == j {
                true if rest > 0.0 => rest.sqrt(),
                true => return None,
                false => rest / lower[j * n + j],
            };
        }
    }
    Some(lower)
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
