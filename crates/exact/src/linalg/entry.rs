//! What the entries of matrices must offer, so that one code runs over the rationals and over a real number field.

use super::matrix::{Echelon, Matrix};
use crate::arith::{Interval, Rational};
use std::fmt;
use std::hash::Hash;

/// A real number known exactly: comparisons are those of the numbers, and are always decided.
///
/// [`Rational`] and [`Real`](crate::algebraic::Real) are entries. What a matrix does with its entries is chosen here, so that
/// matrices over the rationals keep their own elimination and their own sums.
pub trait Entry: Clone + Ord + Hash + fmt::Debug + fmt::Display + Send + Sync + 'static {
    /// Matrices of which many products are made.
    type Product: Products<Self>;

    /// The image of a rational.
    fn of(q: &Rational) -> Self;
    /// The value, where it is rational.
    fn rational(&self) -> Option<Rational>;
    /// `self + other`.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;
    /// `self - other`.
    #[must_use]
    fn minus(&self, other: &Self) -> Self;
    /// `self * other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self;
    /// `self / other`, or `None` for `other = 0`.
    fn over(&self, other: &Self) -> Option<Self>;
    /// The sign as -1, 0 or 1, exactly.
    fn sign(&self) -> i32;
    /// An enclosure of width at most `2^-bits`; the point itself where the number is rational.
    fn enclosure(&self, bits: u64) -> Interval;
    /// The sum of the products of corresponding entries.
    fn dot(a: &[Self], b: &[Self]) -> Self;
    /// `a v` for a column `v` of the right length.
    fn apply(a: &Matrix<Self>, v: &[Self]) -> Vec<Self>;
    /// `v a` for a row `v` of the right length.
    fn apply_left(v: &[Self], a: &Matrix<Self>) -> Vec<Self>;
    /// `a b` where the sizes fit.
    fn product(a: &Matrix<Self>, b: &Matrix<Self>) -> Matrix<Self>;
    /// The reduced row echelon form.
    fn echelon(a: &Matrix<Self>) -> Echelon<Self>;
    /// The columns of its leading ones.
    fn pivots(a: &Matrix<Self>) -> Vec<usize>;
    /// The rank.
    fn rank(a: &Matrix<Self>) -> usize {
        Self::pivots(a).len()
    }

    /// The image of an integer.
    #[must_use]
    fn integer(n: i64) -> Self {
        Self::of(&Rational::from(n))
    }
    /// The number 0.
    #[must_use]
    fn zero() -> Self {
        Self::integer(0)
    }
    /// Whether this is 0, exactly.
    fn is_zero(&self) -> bool {
        self.sign() == 0
    }
    /// `-self`.
    #[must_use]
    fn negated(&self) -> Self {
        Self::zero().minus(self)
    }
    /// The absolute value.
    #[must_use]
    fn absolute(&self) -> Self {
        if self.sign() < 0 { self.negated() } else { self.clone() }
    }
    /// The sum of numbers.
    #[must_use]
    fn sum<'a>(terms: impl Iterator<Item = &'a Self>) -> Self {
        terms.fold(Self::zero(), |s, x| s.plus(x))
    }
}

/// Matrices of which products of many are made, in a form that suits the entries.
pub trait Products<E>: Clone + fmt::Debug + Send + Sync {
    /// A matrix.
    fn of(matrix: &Matrix<E>) -> Self;
    /// The vector as a matrix with one column.
    fn column(vector: &[E]) -> Self;
    /// The identity.
    fn identity(n: usize) -> Self;
    /// `self * other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self;
    /// The matrix as such.
    fn reduced(&self) -> Matrix<E>;
    /// The sum of the absolute values of the entries of `self − other`; a little more where entries are irrational.
    fn distance1(&self, other: &Self) -> Rational;
    /// The largest half 1-norm of the difference of two columns; a little more where entries are irrational.
    fn half_distance(&self) -> Rational;
    /// The smallest and the largest value of a row at the columns, rounded outwards by at most `2^-bits` where they are
    /// irrational; `None` where there are no columns.
    fn range(&self, row: &[E], bits: u64) -> Option<Interval>;
}
