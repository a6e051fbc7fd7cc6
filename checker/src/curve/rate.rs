//! Products of nonnegative matrices in rounded numbers: bounds of their cross-ratios from both sides, without the long
//! fractions of the exact products.

use crate::base::{Checked, Matrix, Q, Whole, bits, charge, spend};
use num_bigint::BigInt;
use num_traits::{One, Signed};

/// Binary places behind the point.
const PLACES: u64 = 192;

/// A lower and an upper bound of a matrix without negative entries, as multiples of `2^-PLACES`.
#[derive(Clone)]
pub struct Bounds([Matrix; 2]);

impl Bounds {
    /// Of a matrix.
    pub fn of<T: Whole>(m: &Matrix<T>) -> Self {
        charge(2 * m.data.len(), m.bits() + PLACES);
        let rounded: Vec<[BigInt; 2]> = m.data.iter().map(|x| x.rounded(&m.den, PLACES)).collect();
        let side = |k: usize| {
            let data = rounded.iter().map(|x| x[k].clone()).collect();
            Matrix { rows: m.rows, cols: m.cols, data, den: BigInt::one() << PLACES }
        };
        Self([side(0), side(1)])
    }

    /// Of the product: bounds of factors that are not negative give bounds of the product.
    pub fn times(&self, other: &Self) -> Checked<Self> {
        let mut product = [self.0[0].times(&other.0[0])?, self.0[1].times(&other.0[1])?];
        // A shift to the right rounds down, also of negative numbers.
        product[0].data.iter_mut().for_each(|x| *x >>= PLACES);
        product[1].data.iter_mut().for_each(|x| *x = -(-&*x >> PLACES));
        product.iter_mut().for_each(|m| m.den >>= PLACES);
        Ok(Self(product))
    }

    /// Whether every matrix between the bounds is positive, with `b_ij b_kl <= D b_kj b_il` for all entries.
    pub fn within(&self, bound: &Q) -> Checked<bool> {
        let Self([lo, hi]) = self;
        spend(4 * hi.data.len() * hi.data.len(), hi.bits() + bits(bound))?;
        let pair = |i: usize, k: usize, j: usize, l: usize| {
            bound.denom() * &hi.integers(i)[j] * &hi.integers(k)[l]
                <= bound.numer() * &lo.integers(k)[j] * &lo.integers(i)[l]
        };
        let columns = || (0..lo.cols).flat_map(|j| (0..lo.cols).filter(move |l| *l != j).map(move |l| (j, l)));
        let mut rows = (0..lo.rows).flat_map(|k| (0..k).map(move |i| (i, k)));
        Ok(lo.data.iter().all(Signed::is_positive) && rows.all(|(i, k)| columns().all(|(j, l)| pair(i, k, j, l))))
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
        for (lo, hi) in square.0[0].data.iter().zip(&square.0[1].data) {
            assert!(lo <= hi && hi - lo < BigInt::from(100));
        }
    }
}
