//! A vector as a combination of independent ones: solved modulo primes, verified exactly.

use super::echelon::ModEchelon;
use super::reconstruct::Residues;
use crate::arith::modular::{PrimeField, large_primes};
use crate::arith::{Integer, Rational};
use crate::poly::ints;
use malachite_base::num::arithmetic::traits::AddMulAssign;

/// After so many primes the system is taken to have no solution.
const UNLUCKY: usize = 8;

/// The coefficients with `sum of c_j columns[j] = target`; `None` where the columns are dependent or there are none.
pub(crate) fn combination(columns: &[Vec<Rational>], target: &[Rational]) -> Option<Vec<Rational>> {
    let k = columns.len();
    let expected: Vec<usize> = (0..k).collect();
    let mut residues = Residues::default();
    let (mut bad, mut count, mut next_try) = (0, 0, 1);
    for p in large_primes() {
        let field = PrimeField::new(p);
        let row =
            |i: usize| columns.iter().map(|c| &c[i]).chain([&target[i]]).map(|x| field.from_rational(x)).collect();
        let rows: Option<Vec<Vec<u64>>> = (0..target.len()).map(row).collect();
        let echelon = rows.map(|rows| ModEchelon::new(&field, rows));
        let Some(echelon) = echelon.filter(|e| e.pivots == expected) else {
            bad += 1;
            if bad > UNLUCKY + count {
                return None;
            }
            continue;
        };
        residues.absorb(&field, &echelon.kernel_vector(&field, k));
        count += 1;
        if count >= next_try {
            let found = residues.vector().and_then(|v| {
                let (last, rest) = v.split_last()?;
                let last = Rational::from(last);
                Some(rest.iter().map(|x| -(Rational::from(x) / &last)).collect::<Vec<_>>())
            });
            if let Some(c) = found.filter(|c| satisfies(columns, c, target)) {
                return Some(c);
            }
            next_try = count + count / 4 + 1;
        }
    }
    None
}

fn satisfies(columns: &[Vec<Rational>], c: &[Rational], target: &[Rational]) -> bool {
    // With common denominators of the combination and of each row, everything is integral.
    let common = ints::common_denominator(c);
    let c: Vec<Integer> = c.iter().map(|x| ints::cleared(x, &common)).collect();
    (0..target.len()).all(|i| {
        let row = || columns.iter().map(|column| &column[i]);
        let d = ints::common_denominator(row().chain([&target[i]]));
        let mut sum = Integer::from(0);
        for (x, y) in row().zip(&c).filter(|(x, y)| **x != 0 && **y != 0) {
            sum.add_mul_assign(ints::cleared(x, &d), y);
        }
        sum == ints::cleared(&target[i], &d) * Integer::from(&common)
    })
}
