//! Matrices over the rationals: sums and eliminations over one denominator.

use super::echelon::ModEchelon;
use super::elimination;
use super::entry::Entry;
use super::matrix::{Echelon, Matrix};
use super::sums::Line;
use crate::arith::modular::{PrimeField, large_primes};
use crate::arith::{Integer, Interval, Natural, Rational};
use crate::poly::ints;

/// Rational entries.
impl Matrix {
    /// The least common denominator of all entries, and the entries times it.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let (d, scaled) = Matrix::from_fn(1, 2, |_, j| ratio(1, [4, 6][j])).cleared();
    /// assert_eq!((d, scaled.entries()), (12u32.into(), &[3.into(), 2.into()][..]));
    /// ```
    #[must_use]
    pub fn cleared(&self) -> (Natural, Matrix<Integer>) {
        let d = ints::common_denominator(self.entries());
        let scaled = self.map(|x| ints::cleared(x, &d));
        (d, scaled)
    }

    /// Independent columns, each but few of those that are no combination of independent ones before it: those that are found
    /// modulo a large prime, without exact elimination. They are as many as the rank, but for primes that divide a minor.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let a = Matrix::from_fn(2, 3, |i, j| ratio((i * i + 1) as i64, [3, 5, 7][j]));
    /// assert_eq!(a.independent_columns(), [0]);
    /// ```
    #[must_use]
    pub fn independent_columns(&self) -> Vec<usize> {
        let modulo = |p: u64| {
            let field = PrimeField::new(p);
            let row = |i: usize| self.row(i).iter().map(|x| field.from_rational(x)).collect::<Option<Vec<u64>>>();
            let rows = (0..self.rows()).map(row).collect::<Option<Vec<_>>>()?;
            Some(ModEchelon::new(&field, rows).pivots)
        };
        large_primes().take(PRIMES).find_map(modulo).unwrap_or_else(|| self.pivots())
    }

    /// The rows, each times its common denominator.
    fn cleared_rows(&self) -> Vec<Vec<Integer>> {
        let cleared = |row: &[Rational]| {
            let d = ints::common_denominator(row);
            row.iter().map(|x| ints::cleared(x, &d)).collect()
        };
        (0..self.rows()).map(|i| cleared(self.row(i))).collect()
    }
}

/// How many primes are tried that may divide a denominator.
const PRIMES: usize = 3;

impl Entry for Rational {
    type Product = super::Scaled;

    fn of(q: &Rational) -> Self {
        q.clone()
    }

    fn rational(&self) -> Option<Rational> {
        Some(self.clone())
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, other: &Self) -> Option<Self> {
        (*other != 0).then(|| self / other)
    }

    fn sign(&self) -> i32 {
        crate::arith::sign(self)
    }

    fn enclosure(&self, _: u64) -> Interval {
        Interval::point(self.clone())
    }

    fn dot(a: &[Self], b: &[Self]) -> Self {
        super::dot(a, b)
    }

    fn apply(a: &Matrix, v: &[Self]) -> Vec<Self> {
        let right = Line::of(v.iter());
        (0..a.rows()).map(|i| Line::of(a.row(i).iter()).dot(&right)).collect()
    }

    fn apply_left(v: &[Self], a: &Matrix) -> Vec<Self> {
        let used: Vec<usize> = (0..v.len()).filter(|i| v[*i] != 0).collect();
        match used[..] {
            [] => vec![Self::from(0); a.cols()],
            [i] if v[i] == 1 => a.row(i).to_vec(),
            [i] => a.row(i).iter().map(|x| x * &v[i]).collect(),
            _ => {
                let left = Line::of(used.iter().map(|i| &v[*i]));
                let column = |j: usize| Line::of(used.iter().map(move |i| &a[(*i, j)]));
                (0..a.cols()).map(|j| left.dot(&column(j))).collect()
            }
        }
    }

    fn product(a: &Matrix, b: &Matrix) -> Matrix {
        let left: Vec<Line> = (0..a.rows()).map(|i| Line::of(a.row(i).iter())).collect();
        let right: Vec<Line> = (0..b.cols()).map(|j| Line::of((0..b.rows()).map(move |i| &b[(i, j)]))).collect();
        Matrix::from_fn(a.rows(), b.cols(), |i, j| left[i].dot(&right[j]))
    }

    fn echelon(a: &Matrix) -> Echelon {
        let (rows, pivots) = elimination::upper(a.cleared_rows(), a.cols());
        let rows = elimination::divided(elimination::reduced_upper(rows, &pivots), &pivots);
        Echelon { rows: Matrix::from_rows(a.cols(), rows), pivots }
    }

    fn pivots(a: &Matrix) -> Vec<usize> {
        elimination::upper(a.cleared_rows(), a.cols()).1
    }

    fn rank(a: &Matrix) -> usize {
        // Columns that are independent modulo a prime are so: where they are as many as can be, that is the rank.
        let most = a.rows().min(a.cols());
        if most > 1 && a.independent_columns().len() == most { most } else { a.pivots().len() }
    }

    fn is_zero(&self) -> bool {
        *self == 0
    }
}
