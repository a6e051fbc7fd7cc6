//! The data of a polytope as whole numbers over powers of two: exact, without a common divisor at every step.

use super::System;
use super::polytope::{Inclusion, Polytope};
use crate::arith::{Integer, Rational};
use crate::linalg::Entry;
use malachite_base::num::arithmetic::traits::Lcm;
use malachite_base::num::basic::traits::One;
use malachite_base::num::logic::traits::SignificantBits;
use malachite_nz::natural::Natural;

/// A polytope whose points lie on one dyadic grid, and the matrices over one denominator each.
pub(super) struct Whole {
    points: Vec<Vec<i128>>,
    point_bits: u64,
    arrows: Vec<(Vec<Vec<i128>>, i128)>,
}

/// Most binary places of points and coefficients.
const PLACES: u64 = 62;

impl Whole {
    /// `None` where numbers are too long.
    pub fn of<E: Entry>(polytope: &Polytope<E>, system: &System<E>) -> Option<Self> {
        let place = |x: &E| places(&x.rational()?);
        let point_bits =
            polytope.points.iter().flat_map(|p| &p.coordinates).map(place).try_fold(0, |m, b| Some(b?.max(m)))?;
        let whole = |x: &E| shifted(&x.rational()?, point_bits);
        let points =
            polytope.points.iter().map(|p| p.coordinates.iter().map(whole).collect()).collect::<Option<_>>()?;
        let arrow = |a: &super::Arrow<E>| {
            let row = |i: usize| a.matrix.row(i).iter().map(E::rational).collect::<Option<Vec<_>>>();
            let entries = (0..a.matrix.rows()).map(row).collect::<Option<Vec<_>>>()?;
            let denominator = entries.iter().flatten().fold(Natural::ONE, |d, x| d.lcm(x.denominator_ref()));
            let factor = Rational::from(denominator.clone());
            let whole = |row: &Vec<Rational>| row.iter().map(|x| narrow(&(x * &factor))).collect::<Option<Vec<_>>>();
            let rows = entries.iter().map(whole).collect::<Option<Vec<_>>>()?;
            Some((rows, i128::try_from(&Integer::from(denominator)).ok()?))
        };
        Some(Self { points, point_bits, arrows: system.arrows.iter().map(arrow).collect::<Option<_>>()? })
    }

    /// `T p − Σ c q` as whole numbers, and what they are to be multiplied with; `None` where they are too long.
    pub fn rest<E: Entry>(&self, inclusion: &Inclusion<E>) -> Option<(Vec<i128>, Rational)> {
        let place = |t: &(usize, E)| places(&t.1.rational()?);
        let bits = inclusion.terms.iter().map(place).try_fold(0, |m, b| Some(b?.max(m)))?;
        let (rows, denominator) = self.arrows.get(inclusion.arrow)?;
        let point = self.points.get(inclusion.point)?;
        let scale = 1i128.checked_shl(u32::try_from(bits).ok()?)?;
        let mut rest = Vec::with_capacity(rows.len());
        for row in rows {
            let mut sum = 0i128;
            for (a, x) in row.iter().zip(point).filter(|(a, _)| **a != 0) {
                sum = sum.checked_add(a.checked_mul(*x)?)?;
            }
            rest.push(sum.checked_mul(scale)?);
        }
        for (k, c) in &inclusion.terms {
            let factor = shifted(&c.rational()?, bits)?.checked_mul(*denominator)?;
            for (r, q) in rest.iter_mut().zip(self.points.get(*k)?) {
                *r = r.checked_sub(factor.checked_mul(*q)?)?;
            }
        }
        let unit = Rational::from(1) / Rational::from(Integer::from(*denominator) << (bits + self.point_bits));
        Some((rest, unit))
    }
}

/// The number of binary places of a dyadic number of few places.
fn places(x: &Rational) -> Option<u64> {
    let d = x.denominator_ref();
    let bits = d.significant_bits() - 1;
    (bits <= PLACES && d.trailing_zeros() == Some(bits)).then_some(bits)
}

/// `2^bits x`, a whole number.
fn shifted(x: &Rational, bits: u64) -> Option<i128> {
    narrow(&(x * Rational::from(Integer::ONE << bits)))
}

/// A whole number of at most 100 bits.
fn narrow(x: &Rational) -> Option<i128> {
    i128::try_from(&Integer::try_from(x.clone()).ok()?).ok().filter(|v| v.unsigned_abs() < 1 << 100)
}
