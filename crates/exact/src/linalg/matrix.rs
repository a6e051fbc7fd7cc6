use super::elimination;
use super::entry::Entry;
use crate::arith::Rational;
use crate::ring::{Field, Ring};
use std::borrow::Borrow;
use std::ops::{Add, Index, IndexMut, Mul, Sub};

/// A dense exact matrix, stored by rows. Zero rows or columns are allowed.
///
/// The entries are rationals unless another type is named; what is done over another field takes its context, as in
/// [`Matrix::echelon_over`].
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Matrix<E = Rational> {
    rows: usize,
    cols: usize,
    data: Vec<E>,
}

/// The reduced row echelon form of a matrix.
#[derive(Debug, Clone)]
pub struct Echelon<E = Rational> {
    /// The nonzero rows, with leading ones.
    pub rows: Matrix<E>,
    /// The column of each row's leading one, ascending.
    pub pivots: Vec<usize>,
}

/// Entries of any kind.
impl<E: Clone> Matrix<E> {
    /// The matrix with entries `f(row, column)`.
    pub fn from_fn(rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> E) -> Self {
        let mut data = Vec::with_capacity(rows * cols);
        for i in 0..rows {
            for j in 0..cols {
                data.push(f(i, j));
            }
        }
        Self { rows, cols, data }
    }

    /// The matrix with the given rows, each of length `cols`.
    ///
    /// # Panics
    /// If a row has another length.
    #[must_use]
    pub fn from_rows(cols: usize, rows: Vec<Vec<E>>) -> Self {
        let count = rows.len();
        let mut data = Vec::with_capacity(count * cols);
        for row in rows {
            assert_eq!(row.len(), cols, "row length");
            data.extend(row);
        }
        Self { rows: count, cols, data }
    }

    /// The matrix with the given columns, each of length `rows`.
    ///
    /// # Panics
    /// If a column has another length.
    #[must_use]
    pub fn from_columns(rows: usize, columns: &[Vec<E>]) -> Self {
        assert!(columns.iter().all(|c| c.len() == rows), "column length");
        Self::from_fn(rows, columns.len(), |i, j| columns[j][i].clone())
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Row `i`.
    #[must_use]
    pub fn row(&self, i: usize) -> &[E] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Column `j`, copied.
    #[must_use]
    pub fn column(&self, j: usize) -> Vec<E> {
        (0..self.rows).map(|i| self[(i, j)].clone()).collect()
    }

    /// All entries, row by row.
    #[must_use]
    pub fn entries(&self) -> &[E] {
        &self.data
    }

    /// The matrix with the entries `f(entry)`.
    #[must_use]
    pub fn map<T: Clone>(&self, f: impl FnMut(&E) -> T) -> Matrix<T> {
        Matrix { rows: self.rows, cols: self.cols, data: self.data.iter().map(f).collect() }
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.cols, self.rows, |i, j| self[(j, i)].clone())
    }

    /// The rows of `self` followed by the rows of `below`.
    ///
    /// # Panics
    /// If the widths differ.
    #[must_use]
    pub fn stack(&self, below: &Self) -> Self {
        assert_eq!(self.cols, below.cols, "matrix width");
        let mut data = self.data.clone();
        data.extend_from_slice(&below.data);
        Self { rows: self.rows + below.rows, cols: self.cols, data }
    }

    /// The columns of `self` followed by the columns of `right`.
    ///
    /// # Panics
    /// If the heights differ.
    #[must_use]
    pub fn beside(&self, right: &Self) -> Self {
        assert_eq!(self.rows, right.rows, "matrix height");
        Self::from_fn(self.rows, self.cols + right.cols, |i, j| {
            if j < self.cols { self[(i, j)].clone() } else { right[(i, j - self.cols)].clone() }
        })
    }

    /// `self * other` over a ring.
    ///
    /// # Panics
    /// If the inner dimensions differ.
    #[must_use]
    pub fn mul_over<K: Ring<E = E>>(&self, k: &K, other: &Self) -> Self {
        assert_eq!(self.cols, other.rows, "inner dimension");
        let entry = |i: usize, j: usize| {
            (0..self.cols).fold(k.zero(), |sum, l| k.add(&sum, &k.mul(&self[(i, l)], &other[(l, j)])))
        };
        Self::from_fn(self.rows, other.cols, entry)
    }

    /// The reduced row echelon form over a field; `None` where the field cannot tell whether a pivot is 0.
    ///
    /// # Cost
    /// `O(rows * cols * rank)` operations in the field; entries may grow.
    #[must_use]
    pub fn echelon_over<K: Field<E = E>>(&self, k: &K) -> Option<Echelon<E>> {
        let rows = (0..self.rows).map(|i| self.row(i).to_vec()).collect();
        let (rows, pivots) = elimination::reduced(k, rows, self.cols)?;
        Some(Echelon { rows: Self::from_rows(self.cols, rows), pivots })
    }

    /// A basis of `{x : self x = 0}` over a field, as the columns of the result; `None` as for
    /// [`Matrix::echelon_over`].
    #[must_use]
    pub fn kernel_over<K: Field<E = E>>(&self, k: &K) -> Option<Self> {
        Some(self.echelon_over(k)?.kernel(k))
    }

    /// One solution `X` of `self X = right` over a field (free unknowns are 0): `Some(None)` where there is none, `None` as
    /// for [`Matrix::echelon_over`].
    ///
    /// # Panics
    /// If the heights differ.
    #[must_use]
    pub fn solve_over<K: Field<E = E>>(&self, k: &K, right: &Self) -> Option<Option<Self>> {
        let joined = self.beside(right);
        Some(joined.echelon_over(k)?.solution(self.cols, &k.zero()))
    }

    /// The characteristic polynomial `det(x - A)` over a ring, the constant coefficient first.
    ///
    /// # Panics
    /// If the matrix is not square.
    ///
    /// # Cost
    /// `O(n^4)` operations in the ring, no division.
    ///
    /// Source: S. Berkowitz, *On computing the determinant in small parallel time using a small number of processors*,
    /// Inf. Process. Lett. 18 (1984).
    #[must_use]
    pub fn char_poly_over<K: Ring<E = E>>(&self, k: &K) -> Vec<E> {
        assert_eq!(self.rows, self.cols, "square matrix");
        let sum = |a: &[E], b: &[E]| a.iter().zip(b).fold(k.zero(), |s, (x, y)| k.add(&s, &k.mul(x, y)));
        // High degree first, for the leading submatrices.
        let mut high = vec![k.one()];
        for r in 0..self.rows {
            // 1, -a_rr, -R C, -R M C, … with the leading submatrix M of size r, the row R and the column C beside it.
            let mut toeplitz = vec![k.one(), k.neg(&self[(r, r)])];
            let mut column: Vec<E> = (0..r).map(|i| self[(i, r)].clone()).collect();
            for _ in 0..r {
                toeplitz.push(k.neg(&sum(&self.row(r)[..r], &column)));
                column = (0..r).map(|i| sum(&self.row(i)[..r], &column)).collect();
            }
            let product = |m: usize| {
                let terms = high.iter().enumerate().take(m + 1).map(|(j, c)| k.mul(&toeplitz[m - j], c));
                terms.fold(k.zero(), |s, x| k.add(&s, &x))
            };
            high = (0..r + 2).map(product).collect();
        }
        high.reverse();
        high
    }
}

impl<E: Clone> Echelon<E> {
    /// Of `[A | B]` with `cols` columns of `A`: the solution of `A X = B` whose free unknowns are 0, if there is one.
    fn solution(&self, cols: usize, zero: &E) -> Option<Matrix<E>> {
        if self.pivots.iter().any(|&p| p >= cols) {
            return None;
        }
        let mut x = Matrix::from_fn(cols, self.rows.cols - cols, |_, _| zero.clone());
        for (r, &p) in self.pivots.iter().enumerate() {
            for j in 0..x.cols {
                x[(p, j)] = self.rows[(r, cols + j)].clone();
            }
        }
        Some(x)
    }

    /// A basis of the vectors that the rows annihilate, as columns.
    #[must_use]
    pub fn kernel<K: Ring<E = E>>(&self, k: &K) -> Matrix<E> {
        self.annihilated(&k.zero(), &k.one(), |x| k.neg(x))
    }

    fn annihilated(&self, zero: &E, one: &E, negated: impl Fn(&E) -> E) -> Matrix<E> {
        let cols = self.rows.cols;
        let free: Vec<usize> = (0..cols).filter(|c| !self.pivots.contains(c)).collect();
        let mut basis = Matrix::from_fn(cols, free.len(), |_, _| zero.clone());
        for (j, &f) in free.iter().enumerate() {
            basis[(f, j)] = one.clone();
            for (r, &p) in self.pivots.iter().enumerate() {
                basis[(p, j)] = negated(&self.rows[(r, f)]);
            }
        }
        basis
    }
}

/// Entries that are real numbers known exactly.
impl<E: Entry> Matrix<E> {
    /// The `rows x cols` matrix of zeros.
    #[must_use]
    pub fn zero(rows: usize, cols: usize) -> Self {
        Self { rows, cols, data: vec![E::zero(); rows * cols] }
    }

    /// The identity of size `n`.
    #[must_use]
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| E::integer(i64::from(i == j)))
    }

    /// Whether every entry is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.data.iter().all(E::is_zero)
    }

    /// `self * v` for a column `v`.
    ///
    /// # Panics
    /// If `v.len() != self.cols()`.
    #[must_use]
    pub fn apply(&self, v: &[E]) -> Vec<E> {
        assert_eq!(v.len(), self.cols, "vector length");
        E::apply(self, v)
    }

    /// `v * self` for a row `v`.
    ///
    /// # Panics
    /// If `v.len() != self.rows()`.
    #[must_use]
    pub fn apply_left(&self, v: &[E]) -> Vec<E> {
        assert_eq!(v.len(), self.rows, "vector length");
        E::apply_left(v, self)
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &E) -> Self {
        self.map(|x| x.times(factor))
    }

    /// The reduced row echelon form (Gauss–Jordan); over the rationals by integers without common factors of rows.
    ///
    /// # Cost
    /// `O(rows * cols * rank)` operations; entries may grow.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let a = Matrix::from_fn(2, 3, |i, j| ratio((i + 1) as i64 * (j as i64 + 1), 1));
    /// assert_eq!(a.echelon().pivots, [0]);
    /// ```
    #[must_use]
    pub fn echelon(&self) -> Echelon<E> {
        E::echelon(self)
    }

    /// The columns of the leading ones of the row echelon form: each that is no combination of those before it.
    #[must_use]
    pub fn pivots(&self) -> Vec<usize> {
        E::pivots(self)
    }

    /// The rank.
    #[must_use]
    pub fn rank(&self) -> usize {
        E::rank(self)
    }

    /// A basis of `{x : self x = 0}`, as the columns of the result.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let a = Matrix::from_rows(2, vec![vec![ratio(1, 1), ratio(-2, 1)]]);
    /// assert_eq!(a.kernel().column(0), [ratio(2, 1), ratio(1, 1)]);
    /// ```
    #[must_use]
    pub fn kernel(&self) -> Self {
        self.echelon().annihilated(&E::zero(), &E::integer(1), E::negated)
    }

    /// One solution `X` of `self X = right`, or `None` where there is none (free unknowns are set to 0).
    ///
    /// # Panics
    /// If the heights differ.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::{Rational, ratio}, linalg::Matrix};
    /// let a = Matrix::from_fn(2, 2, |i, j| ratio([[2, 0], [0, 4]][i][j], 1));
    /// let b = Matrix::from_columns(2, &[vec![ratio(1, 1), ratio(1, 1)]]);
    /// assert_eq!(a.solve(&b).expect("invertible").column(0), [ratio(1, 2), ratio(1, 4)]);
    /// assert_eq!(Matrix::<Rational>::zero(2, 2).solve(&b), None);
    /// ```
    #[must_use]
    pub fn solve(&self, right: &Self) -> Option<Self> {
        self.beside(right).echelon().solution(self.cols, &E::zero())
    }

    /// The inverse, or `None` for a singular or non-square matrix.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let a = Matrix::from_fn(2, 2, |i, j| ratio([[2, 1], [7, 4]][i][j], 1));
    /// assert_eq!(&a * &a.inverse().expect("determinant 1"), Matrix::identity(2));
    /// ```
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        if self.rows == self.cols { self.solve(&Self::identity(self.rows)) } else { None }
    }

    /// The row echelon form of the smallest space of rows that contains those of `self` and with a row `v` every `v m` for
    /// the given matrices.
    ///
    /// # Panics
    /// If a matrix has not as many rows and columns as `self` has columns.
    ///
    /// # Cost
    /// At most as many eliminations as the dimension of the result.
    ///
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let step = Matrix::from_fn(3, 3, |i, j| ratio(i64::from(j == i + 1), 1));
    /// let first = Matrix::from_fn(1, 3, |_, j| ratio(i64::from(j == 1), 1));
    /// assert_eq!(first.closure(&[&step]).rows(), 2);
    /// ```
    #[must_use]
    pub fn closure(&self, maps: &[&Self]) -> Self {
        let arrows: Vec<(usize, usize, &Self)> = maps.iter().map(|m| (0, 0, *m)).collect();
        closures(vec![self.clone()], &arrows).pop().expect("one space")
    }
}

/// The smallest family of spaces of rows that contains the given one and with a row `v` at `from` every `v m` at `to`, for
/// the arrows `(from, to, m)`; as row echelon forms.
///
/// # Panics
/// If the sizes do not fit, or an arrow has no end.
///
/// # Cost
/// At most as many eliminations for each arrow as the sum of the dimensions of the result.
#[must_use]
pub fn closures<E: Entry, M: Borrow<Matrix<E>>>(
    spaces: Vec<Matrix<E>>,
    arrows: &[(usize, usize, M)],
) -> Vec<Matrix<E>> {
    let mut spaces: Vec<Matrix<E>> = spaces.into_iter().map(|s| s.echelon().rows).collect();
    loop {
        let mut grown = false;
        for (from, to, map) in arrows {
            if spaces[*from].rows() == 0 || spaces[*to].rows() == spaces[*to].cols() {
                continue;
            }
            let joined = spaces[*to].stack(&(&spaces[*from] * map.borrow())).echelon().rows;
            if joined.rows() > spaces[*to].rows() {
                spaces[*to] = joined;
                grown = true;
            }
        }
        if !grown {
            return spaces;
        }
    }
}

impl<E> Index<(usize, usize)> for Matrix<E> {
    type Output = E;
    fn index(&self, (i, j): (usize, usize)) -> &E {
        &self.data[i * self.cols + j]
    }
}

impl<E> IndexMut<(usize, usize)> for Matrix<E> {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut E {
        &mut self.data[i * self.cols + j]
    }
}

impl<E: Entry> Mul for &Matrix<E> {
    type Output = Matrix<E>;
    fn mul(self, other: Self) -> Matrix<E> {
        assert_eq!(self.cols, other.rows, "inner dimension");
        E::product(self, other)
    }
}

impl<E: Entry> Add for &Matrix<E> {
    type Output = Matrix<E>;
    fn add(self, other: Self) -> Matrix<E> {
        assert_eq!((self.rows, self.cols), (other.rows, other.cols), "matrix size");
        Matrix::from_fn(self.rows, self.cols, |i, j| self[(i, j)].plus(&other[(i, j)]))
    }
}

impl<E: Entry> Sub for &Matrix<E> {
    type Output = Matrix<E>;
    fn sub(self, other: Self) -> Matrix<E> {
        assert_eq!((self.rows, self.cols), (other.rows, other.cols), "matrix size");
        Matrix::from_fn(self.rows, self.cols, |i, j| self[(i, j)].minus(&other[(i, j)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn m(rows: &[&[i64]]) -> Matrix {
        Matrix::from_fn(rows.len(), rows[0].len(), |i, j| ratio(rows[i][j], 1))
    }

    #[test]
    fn kernel_is_annihilated_and_complete() {
        let a = m(&[&[1, 2, 3, 4], &[2, 4, 6, 8], &[0, 1, 1, 0]]);
        let k = a.kernel();
        assert_eq!((k.rows(), k.cols(), a.rank()), (4, 2, 2));
        assert!((&a * &k).is_zero());
        assert_eq!(k.rank(), 2);
    }

    #[test]
    fn solve_tells_when_there_is_no_solution() {
        let a = m(&[&[1, 1], &[2, 2]]);
        assert!(a.solve(&m(&[&[1], &[3]])).is_none());
        let x = a.solve(&m(&[&[1], &[2]])).unwrap();
        assert_eq!(&a * &x, m(&[&[1], &[2]]));
        assert!(a.inverse().is_none());
        let b = m(&[&[2, 1], &[7, 4]]);
        assert_eq!(&b * &b.inverse().unwrap(), Matrix::identity(2));
    }
}
