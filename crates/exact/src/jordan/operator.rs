//! A rational matrix as an integer operator with a common denominator, exact and modulo a prime.

use crate::arith::modular::PrimeField;
use crate::arith::{Integer, Natural};
use crate::linalg::{Matrix, lifting};
use crate::poly::{IntPoly, Poly, ints};
use malachite_base::num::arithmetic::traits::{AddMulAssign, DivExact, DivExactAssign, Gcd, Pow};

/// The integer matrix `N = D A`, by sparse rows.
pub(super) struct Operator {
    /// The common denominator `D`.
    pub denominator: Integer,
    rows: Vec<Vec<(usize, Integer)>>,
}

impl Operator {
    pub fn new(a: &Matrix) -> Self {
        let n = a.rows();
        let d = ints::common_denominator((0..n).flat_map(|i| a.row(i)));
        let entry = |(j, x)| (j, ints::cleared(x, &d));
        let rows = (0..n).map(|i| a.row(i).iter().enumerate().filter(|(_, x)| **x != 0).map(entry).collect()).collect();
        Self { denominator: Integer::from(d), rows }
    }

    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// The sparse rows of `F(N)^power` for a monic `F`, where all numbers on the way are words that can be lifted.
    pub fn power_in_words(&self, f: &[Integer], power: usize) -> Option<Vec<Vec<(usize, i64)>>> {
        let rows = lifting::words(&self.rows)?;
        let coefficients = f.iter().map(|c| i64::try_from(c).ok()).collect::<Option<Vec<i64>>>()?;
        let n = rows.len();
        let unit = |i: usize| (0..n).map(|j| i64::from(i == j)).collect();
        let mut value: Vec<Vec<i64>> = (0..n).map(unit).collect();
        for _ in 0..power {
            let start = value.clone();
            for c in coefficients.iter().rev().skip(1) {
                let entry = |i: usize, j: usize| {
                    let product = |(k, x): &(usize, i64)| i128::from(*x) * i128::from(value[*k][j]);
                    let sum = rows[i].iter().map(product).sum::<i128>() + i128::from(*c) * i128::from(start[i][j]);
                    i64::try_from(sum).ok()
                };
                value = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect::<Option<Vec<Vec<i64>>>>()?;
            }
        }
        let sparse = |row: Vec<i64>| row.into_iter().enumerate().filter(|(_, x)| *x != 0).collect::<Vec<_>>();
        let sparse: Vec<Vec<(usize, i64)>> = value.into_iter().map(sparse).collect();
        sparse.iter().all(|row| lifting::is_short(row)).then_some(sparse)
    }

    /// `N v`.
    pub fn apply(&self, v: &[Integer]) -> Vec<Integer> {
        self.rows
            .iter()
            .map(|row| {
                let mut sum = Integer::from(0);
                for (j, x) in row.iter().filter(|(j, _)| v[*j] != 0) {
                    sum.add_mul_assign(x, &v[*j]);
                }
                sum
            })
            .collect()
    }

    /// `F(N) v`, by Horner's scheme.
    pub fn apply_poly(&self, f: &[Integer], v: &[Integer]) -> Vec<Integer> {
        let mut sum = vec![Integer::from(0); v.len()];
        for (k, c) in f.iter().enumerate().rev() {
            if k + 1 < f.len() {
                sum = self.apply(&sum);
            }
            add_multiple(&mut sum, c, v);
        }
        sum
    }

    /// The monic integer polynomial whose roots are `D` times those of a monic factor of the characteristic polynomial.
    pub fn scaled(&self, f: &Poly) -> IntPoly {
        let d = f.degree().unwrap_or(0);
        let scale = |(k, c): (usize, _)| {
            let power = (&self.denominator).pow((d - k) as u64).unsigned_abs_ref().clone();
            let value: &crate::arith::Rational = c;
            let numerator = value.numerator_ref() * power;
            Integer::from_sign_and_abs(*value >= 0, numerator.div_exact(value.denominator_ref()))
        };
        f.coeffs().iter().enumerate().map(scale).collect()
    }

    pub fn modulo(&self, field: &PrimeField) -> ModOperator {
        let row = |row: &Vec<(usize, Integer)>| row.iter().map(|(j, x)| (*j, field.from_integer(x))).collect();
        ModOperator { field: *field, rows: self.rows.iter().map(row).collect() }
    }
}

/// `v += factor * u`.
pub(super) fn add_multiple(v: &mut [Integer], factor: &Integer, u: &[Integer]) {
    if *factor == 1 {
        v.iter_mut().zip(u).for_each(|(x, y)| *x += y);
    } else if *factor != 0 {
        for (x, y) in v.iter_mut().zip(u).filter(|(_, y)| **y != 0) {
            x.add_mul_assign(factor, y);
        }
    }
}

/// The greatest common divisor of all entries.
pub(super) fn content<'a>(entries: impl IntoIterator<Item = &'a Integer>) -> Natural {
    let mut g = Natural::from(0u32);
    for x in entries {
        if *x != 0 {
            g = g.gcd(x.unsigned_abs_ref());
            if g == 1 {
                break;
            }
        }
    }
    g
}

/// Divides by the greatest common divisor of the entries.
pub(super) fn make_primitive(v: &mut [Integer]) {
    let g = content(v.iter());
    if g > 1 {
        let g = Integer::from(g);
        v.iter_mut().for_each(|x| x.div_exact_assign(&g));
    }
}

/// The operator modulo a prime.
pub(super) struct ModOperator {
    pub field: PrimeField,
    rows: Vec<Vec<(usize, u64)>>,
}

impl ModOperator {
    pub fn apply(&self, v: &[u64]) -> Vec<u64> {
        let f = &self.field;
        self.rows.iter().map(|row| row.iter().fold(0, |sum, (j, x)| f.add(sum, f.mul(*x, v[*j])))).collect()
    }

    pub fn apply_poly(&self, poly: &[u64], v: &[u64]) -> Vec<u64> {
        let f = &self.field;
        let mut sum = vec![0; v.len()];
        for (k, c) in poly.iter().enumerate().rev() {
            if k + 1 < poly.len() {
                sum = self.apply(&sum);
            }
            sum.iter_mut().zip(v).for_each(|(s, x)| *s = f.add(*s, f.mul(*c, *x)));
        }
        sum
    }

    /// `F(N)` as a dense matrix. The polynomial is monic.
    pub fn poly(&self, poly: &[u64]) -> Vec<Vec<u64>> {
        let (f, n) = (&self.field, self.rows.len());
        let mut value: Vec<Vec<u64>> = vec![vec![0; n]; n];
        value.iter_mut().enumerate().for_each(|(i, row)| row[i] = f.one());
        for (k, c) in poly.iter().rev().skip(1).enumerate() {
            let mut next: Vec<Vec<u64>> = if k == 0 {
                // The matrix itself.
                let row = |row: &Vec<(usize, u64)>| {
                    let mut dense = vec![0; n];
                    row.iter().for_each(|(j, x)| dense[*j] = *x);
                    dense
                };
                self.rows.iter().map(row).collect()
            } else {
                self.rows.iter().map(|row| self.combine(row, &value)).collect()
            };
            next.iter_mut().enumerate().for_each(|(i, row)| row[i] = f.add(row[i], *c));
            value = next;
        }
        value
    }

    fn combine(&self, row: &[(usize, u64)], rows: &[Vec<u64>]) -> Vec<u64> {
        let f = &self.field;
        let mut sum = vec![0; rows.len()];
        let mut chunks = row.chunks_exact(4);
        for chunk in chunks.by_ref() {
            let [(i, a), (j, b), (k, c), (l, d)] = chunk else { continue };
            let (p, q, r, s) = (&rows[*i], &rows[*j], &rows[*k], &rows[*l]);
            let wide = |x: u64, y: u64| u128::from(x) * u128::from(y);
            for ((((x, p), q), r), s) in sum.iter_mut().zip(p).zip(q).zip(r).zip(s) {
                let total = wide(*a, *p) + wide(*b, *q) + wide(*c, *r) + wide(*d, *s);
                *x = f.add(*x, f.reduce_wide(total));
            }
        }
        for (j, x) in chunks.remainder() {
            for (s, y) in sum.iter_mut().zip(&rows[*j]) {
                *s = f.add(*s, f.mul(*x, *y));
            }
        }
        sum
    }
}
