use crate::arith::Rational;
use std::ops::{Add, Index, IndexMut, Mul, Sub};

/// A dense exact matrix, stored by rows. Zero rows or columns are allowed.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Matrix {
    rows: usize,
    cols: usize,
    data: Vec<Rational>,
}

/// The reduced row echelon form of a matrix.
#[derive(Debug, Clone)]
pub struct Echelon {
    /// The nonzero rows, with leading ones.
    pub rows: Matrix,
    /// The column of each row's leading one, ascending.
    pub pivots: Vec<usize>,
}

impl Matrix {
    /// The `rows x cols` matrix of zeros.
    #[must_use]
    pub fn zero(rows: usize, cols: usize) -> Self {
        Self { rows, cols, data: vec![Rational::from(0); rows * cols] }
    }

    /// The identity of size `n`.
    #[must_use]
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| Rational::from(u8::from(i == j)))
    }

    /// The matrix with entries `f(row, column)`.
    pub fn from_fn(rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> Rational) -> Self {
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
    pub fn from_rows(cols: usize, rows: Vec<Vec<Rational>>) -> Self {
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
    pub fn from_columns(rows: usize, columns: &[Vec<Rational>]) -> Self {
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
    pub fn row(&self, i: usize) -> &[Rational] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Column `j`, copied.
    #[must_use]
    pub fn column(&self, j: usize) -> Vec<Rational> {
        (0..self.rows).map(|i| self[(i, j)].clone()).collect()
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.cols, self.rows, |i, j| self[(j, i)].clone())
    }

    /// Whether every entry is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.data.iter().all(|x| *x == 0)
    }

    /// `self * v` for a column `v`.
    ///
    /// # Panics
    /// If `v.len() != self.cols()`.
    #[must_use]
    pub fn apply(&self, v: &[Rational]) -> Vec<Rational> {
        assert_eq!(v.len(), self.cols, "vector length");
        (0..self.rows).map(|i| dot(self.row(i), v)).collect()
    }

    /// `v * self` for a row `v`.
    ///
    /// # Panics
    /// If `v.len() != self.rows()`.
    #[must_use]
    pub fn apply_left(&self, v: &[Rational]) -> Vec<Rational> {
        assert_eq!(v.len(), self.rows, "vector length");
        let mut out = vec![Rational::from(0); self.cols];
        for (i, x) in v.iter().enumerate().filter(|(_, x)| **x != 0) {
            for (o, entry) in out.iter_mut().zip(self.row(i)) {
                if *entry != 0 {
                    *o += x * entry;
                }
            }
        }
        out
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        Self { rows: self.rows, cols: self.cols, data: self.data.iter().map(|x| x * factor).collect() }
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

    /// The reduced row echelon form (Gauss–Jordan).
    ///
    /// # Cost
    /// `O(rows * cols * rank)` rational operations; entries may grow.
    #[must_use]
    pub fn echelon(&self) -> Echelon {
        let mut m = self.clone();
        let mut pivots = Vec::new();
        for col in 0..m.cols {
            let top = pivots.len();
            let Some(found) = (top..m.rows).find(|&r| m[(r, col)] != 0) else { continue };
            m.swap_rows(top, found);
            let inverse = Rational::from(1) / &m[(top, col)];
            for j in col..m.cols {
                m[(top, j)] *= &inverse;
            }
            let pivot_row = m.row(top).to_vec();
            for r in (0..m.rows).filter(|&r| r != top) {
                let factor = m[(r, col)].clone();
                if factor != 0 {
                    for j in col..m.cols {
                        if pivot_row[j] != 0 {
                            let change = &factor * &pivot_row[j];
                            m[(r, j)] -= change;
                        }
                    }
                }
            }
            pivots.push(col);
        }
        m.data.truncate(pivots.len() * m.cols);
        m.rows = pivots.len();
        Echelon { rows: m, pivots }
    }

    /// The rank.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.echelon().pivots.len()
    }

    /// A basis of `{x : self x = 0}`, as the columns of the result.
    #[must_use]
    pub fn kernel(&self) -> Self {
        let Echelon { rows, pivots } = self.echelon();
        let free: Vec<usize> = (0..self.cols).filter(|c| !pivots.contains(c)).collect();
        let mut basis = Self::zero(self.cols, free.len());
        for (k, &f) in free.iter().enumerate() {
            basis[(f, k)] = Rational::from(1);
            for (r, &p) in pivots.iter().enumerate() {
                basis[(p, k)] = -&rows[(r, f)];
            }
        }
        basis
    }

    /// One solution `X` of `self X = right`, or `None` where there is none (free unknowns are set to 0).
    ///
    /// # Panics
    /// If the heights differ.
    #[must_use]
    pub fn solve(&self, right: &Self) -> Option<Self> {
        assert_eq!(self.rows, right.rows, "matrix height");
        let joined = Self::from_fn(self.rows, self.cols + right.cols, |i, j| {
            if j < self.cols { self[(i, j)].clone() } else { right[(i, j - self.cols)].clone() }
        });
        let Echelon { rows, pivots } = joined.echelon();
        if pivots.iter().any(|&p| p >= self.cols) {
            return None;
        }
        let mut x = Self::zero(self.cols, right.cols);
        for (r, &p) in pivots.iter().enumerate() {
            for j in 0..right.cols {
                x[(p, j)] = rows[(r, self.cols + j)].clone();
            }
        }
        Some(x)
    }

    /// The inverse, or `None` for a singular or non-square matrix.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        if self.rows != self.cols || self.rank() < self.rows {
            return None;
        }
        self.solve(&Self::identity(self.rows))
    }

    fn swap_rows(&mut self, a: usize, b: usize) {
        if a != b {
            for j in 0..self.cols {
                self.data.swap(a * self.cols + j, b * self.cols + j);
            }
        }
    }
}

/// The sum of the products of corresponding entries.
#[must_use]
pub fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    let mut sum = Rational::from(0);
    for (x, y) in a.iter().zip(b) {
        if *x != 0 && *y != 0 {
            sum += x * y;
        }
    }
    sum
}

impl Index<(usize, usize)> for Matrix {
    type Output = Rational;
    fn index(&self, (i, j): (usize, usize)) -> &Rational {
        &self.data[i * self.cols + j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut Rational {
        &mut self.data[i * self.cols + j]
    }
}

impl Mul for &Matrix {
    type Output = Matrix;
    fn mul(self, other: Self) -> Matrix {
        assert_eq!(self.cols, other.rows, "inner dimension");
        let rows = (0..self.rows).map(|i| other.apply_left(self.row(i))).collect();
        Matrix::from_rows(other.cols, rows)
    }
}

impl Add for &Matrix {
    type Output = Matrix;
    fn add(self, other: Self) -> Matrix {
        assert_eq!((self.rows, self.cols), (other.rows, other.cols), "matrix size");
        Matrix::from_fn(self.rows, self.cols, |i, j| &self[(i, j)] + &other[(i, j)])
    }
}

impl Sub for &Matrix {
    type Output = Matrix;
    fn sub(self, other: Self) -> Matrix {
        assert_eq!((self.rows, self.cols), (other.rows, other.cols), "matrix size");
        Matrix::from_fn(self.rows, self.cols, |i, j| &self[(i, j)] - &other[(i, j)])
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
