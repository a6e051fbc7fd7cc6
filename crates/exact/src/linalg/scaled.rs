//! Products of many rational matrices as integers over one denominator: no fraction is reduced on the way.

use super::{Matrix, Products};
use crate::arith::{Integer, Interval, Natural, Rational};
use malachite_base::num::arithmetic::traits::{AddMulAssign, UnsignedAbs};
use malachite_base::num::basic::traits::Zero;

/// A rational matrix as integers over one denominator, which need not be the least one.
///
/// A product of `n` matrices costs only multiplications and additions of integers; powers of two are taken out, so that
/// dyadic entries stay as short as they are when reduced.
///
/// ```
/// use secant_exact::{arith::ratio, linalg::{Matrix, Scaled}};
///
/// let half = Scaled::of(&Matrix::from_fn(2, 2, |i, j| ratio(if i == j { 1 } else { 0 }, 2)));
/// assert_eq!(half.times(&half).reduced(), Matrix::identity(2).scale(&ratio(1, 4)));
/// ```
#[derive(Debug, Clone)]
pub struct Scaled {
    denominator: Natural,
    entries: Matrix<Integer>,
}

impl Scaled {
    /// The same matrix over its least common denominator.
    ///
    /// # Cost
    /// One gcd for each entry.
    #[must_use]
    pub fn of(matrix: &Matrix) -> Self {
        let (denominator, entries) = matrix.cleared();
        Self { denominator, entries }
    }

    /// The vector as a matrix with one column.
    #[must_use]
    pub fn column(vector: &[Rational]) -> Self {
        Self::of(&Matrix::from_fn(vector.len(), 1, |i, _| vector[i].clone()))
    }

    /// Rows for columns.
    #[must_use]
    pub fn transpose(self) -> Self {
        Self { entries: self.entries.transpose(), ..self }
    }

    /// The identity.
    #[must_use]
    pub fn identity(n: usize) -> Self {
        Self::of(&Matrix::identity(n))
    }

    /// What all entries are divided by; positive.
    #[must_use]
    pub fn denominator(&self) -> &Natural {
        &self.denominator
    }

    /// The entries times [`Scaled::denominator`].
    #[must_use]
    pub fn entries(&self) -> &Matrix<Integer> {
        &self.entries
    }

    /// The matrix with reduced fractions.
    ///
    /// # Cost
    /// One gcd for each entry.
    #[must_use]
    pub fn reduced(&self) -> Matrix {
        self.entries.map(|x| Rational::from_integers_ref(x, &Integer::from(&self.denominator)))
    }

    /// `self * other`.
    ///
    /// # Cost
    /// `rows * inner * cols` multiplications of integers.
    ///
    /// # Panics
    /// If the inner dimensions differ.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (left, right) = (&self.entries, &other.entries);
        assert_eq!(left.cols(), right.rows(), "inner dimension");
        let entries = Matrix::from_fn(left.rows(), right.cols(), |i, j| {
            let mut sum = Integer::ZERO;
            for (k, x) in left.row(i).iter().enumerate() {
                let y = &right[(k, j)];
                if *x != 0 && *y != 0 {
                    sum.add_mul_assign(x, y);
                }
            }
            sum
        });
        Self { denominator: &self.denominator * &other.denominator, entries }.without_twos()
    }

    /// The sum of the absolute values of the entries of `self − other`.
    ///
    /// # Panics
    /// If the sizes differ.
    #[must_use]
    pub fn distance1(&self, other: &Self) -> Rational {
        let size = |m: &Matrix<Integer>| (m.rows(), m.cols());
        assert_eq!(size(&self.entries), size(&other.entries), "matrix size");
        let (d, e) = (Integer::from(&self.denominator), Integer::from(&other.denominator));
        let terms = self.entries.entries().iter().zip(other.entries.entries());
        let sum = terms.fold(Natural::ZERO, |sum, (x, y)| sum + (x * &e - y * &d).unsigned_abs());
        Rational::from_naturals(sum, &self.denominator * &other.denominator)
    }

    fn without_twos(self) -> Self {
        let shared = |twos: u64, x: &Integer| x.trailing_zeros().map_or(twos, |t| t.min(twos));
        let twos = self.denominator.trailing_zeros().map_or(0, |t| self.entries.entries().iter().fold(t, shared));
        if twos == 0 {
            return self;
        }
        Self { denominator: self.denominator >> twos, entries: self.entries.map(|x| x >> twos) }
    }
}

impl Products<Rational> for Scaled {
    fn of(matrix: &Matrix) -> Self {
        Self::of(matrix)
    }

    fn column(vector: &[Rational]) -> Self {
        Self::column(vector)
    }

    fn identity(n: usize) -> Self {
        Self::identity(n)
    }

    fn times(&self, other: &Self) -> Self {
        Self::times(self, other)
    }

    fn reduced(&self) -> Matrix {
        Self::reduced(self)
    }

    fn distance1(&self, other: &Self) -> Rational {
        Self::distance1(self, other)
    }

    fn half_distance(&self) -> Rational {
        // Over one denominator, differences and their sums are integers.
        let scaled = &self.entries;
        let mut largest = Natural::ZERO;
        for i in 0..scaled.cols() {
            for j in 0..i {
                let terms = (0..scaled.rows()).map(|k| (&scaled[(k, i)] - &scaled[(k, j)]).unsigned_abs());
                largest = largest.max(terms.fold(Natural::ZERO, |s, x| s + x));
            }
        }
        Rational::from_naturals(largest, &self.denominator << 1u64)
    }

    fn range(&self, row: &[Rational], _: u64) -> Option<Interval> {
        let values = Self::column(row).transpose().times(self);
        let value = |x: &Integer| Rational::from_integers_ref(x, &Integer::from(&values.denominator));
        let entries = || values.entries.entries().iter();
        Some(Interval { lo: value(entries().min()?), hi: value(entries().max()?) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::poly::modp::next_random;

    #[test]
    fn products_are_those_of_reduced_matrices() {
        let mut seed = 11;
        for size in 1..5 {
            let mut entry = |i: usize| ratio((next_random(&mut seed) % 41) as i64 - 20, [1, 2, 6, 8, 35][i % 5]);
            let mut random = || Matrix::from_fn(size, size, |i, j| entry(3 * i + j));
            let (a, b, c) = (random(), random(), random());
            let (x, y, z) = (Scaled::of(&a), Scaled::of(&b), Scaled::of(&c));
            assert_eq!(x.times(&y).times(&z).reduced(), &(&a * &b) * &c);
            let off = (&a - &b).entries().iter().fold(ratio(0, 1), |s, t| s + crate::arith::abs(t));
            assert_eq!(x.distance1(&y), off);
            assert_eq!(Scaled::identity(size).times(&x).reduced(), a);
        }
        let eighth = Scaled::of(&Matrix::from_fn(1, 1, |_, _| ratio(4, 8)));
        assert_eq!(eighth.times(&Scaled::column(&[ratio(2, 1)])).denominator(), &Natural::from(1u32));
    }
}
