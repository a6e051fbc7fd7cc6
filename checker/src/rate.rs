//! Products of nonnegative matrices in rounded numbers: bounds of their cross-ratios from both sides, without the long
//! fractions of the exact products.

use crate::Checked;
use crate::matrix::Matrix;
use crate::number::{Q, bits, charge, spend};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Signed;

/// Binary places behind the point.
const PLACES: u64 = 192;

/// A matrix whose entries lie between `lo` and `hi`, as multiples of `2^-PLACES`.
#[derive(Clone)]
pub struct Bounds {
    rows: usize,
    cols: usize,
    lo: Vec<BigInt>,
    hi: Vec<BigInt>,
}

impl Bounds {
    /// Of a matrix without negative entries.
    pub fn of(m: &Matrix) -> Self {
        charge(2 * m.data.len(), m.bits() + PLACES);
        let lo = m.data.iter().map(|x| (x << PLACES).div_floor(&m.den)).collect();
        let hi = m.data.iter().map(|x| (x << PLACES).div_ceil(&m.den)).collect();
        Self { rows: m.rows, cols: m.cols, lo, hi }
    }

    /// Of the product: bounds of factors that are not negative give bounds of the product.
    pub fn times(&self, other: &Self) -> Checked<Self> {
        let longest = self.hi.iter().chain(&other.hi).map(BigInt::bits).max().unwrap_or(0);
        spend(2 * self.rows * self.cols * other.cols, longest)?;
        let entry = |a: &[BigInt], b: &[BigInt], i: usize, j: usize| -> BigInt {
            (0..self.cols).map(|k| &a[i * self.cols + k] * &b[k * other.cols + j]).sum()
        };
        let places = || (0..self.rows).flat_map(|i| (0..other.cols).map(move |j| (i, j)));
        // A shift to the right rounds down, also of negative numbers.
        let lo = places().map(|(i, j)| entry(&self.lo, &other.lo, i, j) >> PLACES).collect();
        let hi = places().map(|(i, j)| -(-entry(&self.hi, &other.hi, i, j) >> PLACES)).collect();
        Ok(Self { rows: self.rows, cols: other.cols, lo, hi })
    }

    /// Whether every matrix between the bounds is positive, with `b_ij b_kl <= D b_kj b_il` for all entries.
    pub fn within(&self, bound: &Q) -> Checked<bool> {
        let longest = self.hi.iter().map(BigInt::bits).max().unwrap_or(0) + bits(bound);
        spend(4 * self.rows * self.rows * self.cols * self.cols, longest)?;
        if self.lo.iter().any(|x| !x.is_positive()) {
            return Ok(false);
        }
        let at = |i: usize, j: usize| i * self.cols + j;
        let pair = |i: usize, k: usize, j: usize, l: usize| {
            bound.denom() * &self.hi[at(i, j)] * &self.hi[at(k, l)]
                <= bound.numer() * &self.lo[at(k, j)] * &self.lo[at(i, l)]
        };
        Ok((0..self.rows).all(|i| {
            (i + 1..self.rows)
                .all(|k| (0..self.cols).all(|j| (0..self.cols).filter(|l| *l != j).all(|l| pair(i, k, j, l))))
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [[i64; 2]; 2], over: i64) -> Matrix {
        let q = |x: &i64| Q::new((*x).into(), over.into());
        Matrix::new(2, 2, &entries.iter().flatten().map(q).collect::<Vec<_>>())
    }

    #[test]
    fn rounded_bounds_do_not_accept_too_much() {
        // The cross-ratio of [[2, 1], [1, 2]] is 4, that of its square 25/16.
        let b = Bounds::of(&matrix([[2, 1], [1, 2]], 3));
        let square = b.times(&b).unwrap();
        let above = |p: i64, q: i64| Q::new((p * 1_000_000 + 1).into(), (q * 1_000_000).into());
        let below = |p: i64, q: i64| Q::new((p * 1_000_000 - 1).into(), (q * 1_000_000).into());
        assert!(b.within(&above(4, 1)).unwrap() && !b.within(&below(4, 1)).unwrap());
        assert!(square.within(&above(25, 16)).unwrap() && !square.within(&below(25, 16)).unwrap());
        assert!(!Bounds::of(&matrix([[2, 0], [1, 2]], 3)).within(&above(100, 1)).unwrap());
        for (lo, hi) in square.lo.iter().zip(&square.hi) {
            assert!(lo <= hi && hi - lo < BigInt::from(100));
        }
    }
}
