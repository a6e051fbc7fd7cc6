//! Exact matrices over the rational numbers.

use crate::Rejected;
use crate::number::{Q, size, spend};
use num_traits::{One, Zero};

/// A matrix, stored by rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub cols: usize,
    data: Vec<Q>,
}

impl Matrix {
    /// The matrix with entries `f(row, column)`.
    pub fn from_fn(rows: usize, cols: usize, f: impl Fn(usize, usize) -> Q) -> Self {
        Self { rows, cols, data: (0..rows * cols).map(|k| f(k / cols, k % cols)).collect() }
    }

    /// The matrix with the given rows, each of length `cols`.
    pub fn from_rows(cols: usize, rows: &[Vec<Q>]) -> Self {
        Self::from_fn(rows.len(), cols, |i, j| rows[i][j].clone())
    }

    /// The identity.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { Q::one() } else { Q::zero() })
    }

    /// The entry in row `i` and column `j`.
    pub fn at(&self, i: usize, j: usize) -> &Q {
        &self.data[i * self.cols + j]
    }

    /// Row `i`.
    pub fn row(&self, i: usize) -> &[Q] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Column `j`.
    pub fn column(&self, j: usize) -> Vec<Q> {
        (0..self.rows).map(|i| self.at(i, j).clone()).collect()
    }

    /// All entries.
    pub fn entries(&self) -> &[Q] {
        &self.data
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.cols, self.rows, |i, j| self.at(j, i).clone())
    }

    /// Whether all entries are 0.
    pub fn is_zero(&self) -> bool {
        self.data.iter().all(Zero::is_zero)
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Result<Self, Rejected> {
        spend(self.rows * self.cols * other.cols, size(&self.data).max(size(&other.data)))?;
        Ok(Self::from_fn(self.rows, other.cols, |i, j| {
            let terms = (0..self.cols).filter(|&k| !self.at(i, k).is_zero() && !other.at(k, j).is_zero());
            terms.fold(Q::zero(), |s, k| s + self.at(i, k) * other.at(k, j))
        }))
    }

    /// The matrix times a column.
    pub fn apply(&self, v: &[Q]) -> Result<Vec<Q>, Rejected> {
        (0..self.rows).map(|i| dot(self.row(i), v)).collect()
    }

    /// `self − factor · identity` and the like: the entrywise combination `self + factor · other`.
    pub fn plus(&self, factor: &Q, other: &Self) -> Self {
        Self::from_fn(self.rows, self.cols, |i, j| self.at(i, j) + factor * other.at(i, j))
    }

    /// The rows of `self` followed by those of `below`.
    pub fn stack(&self, below: &Self) -> Self {
        let data = self.data.iter().chain(&below.data).cloned().collect();
        Self { rows: self.rows + below.rows, cols: self.cols, data }
    }

    /// The nonzero rows of the reduced row echelon form, and the columns of their leading ones.
    pub fn echelon(&self) -> Result<(Self, Vec<usize>), Rejected> {
        let mut rows: Vec<Vec<Q>> = (0..self.rows).map(|i| self.row(i).to_vec()).collect();
        let mut pivots = Vec::new();
        for j in 0..self.cols {
            let top = pivots.len();
            let Some(found) = (top..rows.len()).find(|&i| !rows[i][j].is_zero()) else { continue };
            rows.swap(top, found);
            let lead = rows[top][j].clone();
            spend(rows.len() * self.cols, rows.iter().map(|r| size(r)).max().unwrap_or(0))?;
            rows[top].iter_mut().for_each(|x| *x = &*x / &lead);
            let pivot = rows[top].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                let factor = row[j].clone();
                if i != top && !factor.is_zero() {
                    row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= &factor * p);
                }
            }
            pivots.push(j);
        }
        rows.truncate(pivots.len());
        Ok((Self::from_rows(self.cols, &rows), pivots))
    }

    /// The rank.
    pub fn rank(&self) -> Result<usize, Rejected> {
        Ok(self.echelon()?.1.len())
    }

    /// The power with a natural exponent.
    pub fn power(&self, exponent: usize) -> Result<Self, Rejected> {
        (0..exponent).try_fold(Self::identity(self.rows), |p, _| p.times(self))
    }

    /// The vector with coordinate sum 1 that spans the kernel of `self − 1`, if the kernel is a line and there is one.
    pub fn fixed_point(&self) -> Result<Option<Vec<Q>>, Rejected> {
        let n = self.rows;
        let (rows, pivots) = self.plus(&-Q::one(), &Self::identity(n)).echelon()?;
        if pivots.len() + 1 != n {
            return Ok(None);
        }
        let Some(free) = (0..n).find(|j| !pivots.contains(j)) else { return Ok(None) };
        let mut v = vec![Q::zero(); n];
        v[free] = Q::one();
        for (i, &pivot) in pivots.iter().enumerate() {
            v[pivot] = -rows.at(i, free).clone();
        }
        let sum: Q = v.iter().sum();
        Ok(if sum.is_zero() { None } else { Some(v.into_iter().map(|x| x / &sum).collect()) })
    }

    /// The coefficients of the characteristic polynomial `det(x − self)`, lowest first (Faddeev and LeVerrier).
    pub fn characteristic(&self) -> Result<Vec<Q>, Rejected> {
        let n = self.rows;
        let mut coefficients = vec![Q::zero(); n + 1];
        coefficients[n] = Q::one();
        let mut m = Self::identity(n);
        for k in 1..=n {
            let product = self.times(&m)?;
            let trace: Q = (0..n).map(|i| product.at(i, i).clone()).sum();
            coefficients[n - k] = -trace / crate::number::whole(k as i64);
            m = product.plus(&coefficients[n - k], &Self::identity(n));
        }
        Ok(coefficients)
    }
}

/// The scalar product of a row and a column.
pub fn dot(row: &[Q], v: &[Q]) -> Result<Q, Rejected> {
    spend(row.len(), size(row).max(size(v)))?;
    Ok(row.iter().zip(v).filter(|(a, b)| !a.is_zero() && !b.is_zero()).fold(Q::zero(), |s, (a, b)| s + a * b))
}

/// `a − b`.
pub fn difference(a: &[Q], b: &[Q]) -> Vec<Q> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::whole;

    fn matrix(rows: &[&[i64]]) -> Matrix {
        Matrix::from_fn(rows.len(), rows[0].len(), |i, j| whole(rows[i][j]))
    }

    #[test]
    fn characteristic_polynomials() {
        let m = matrix(&[&[1, 2, 3], &[4, 5, 6], &[7, 8, 10]]);
        assert_eq!(m.characteristic().unwrap(), [3, -12, -16, 1].map(whole));
        assert_eq!(m.rank().unwrap(), 3);
        assert_eq!(matrix(&[&[1, 2], &[2, 4]]).echelon().unwrap().0, matrix(&[&[1, 2]]));
    }

    #[test]
    fn fixed_points() {
        let half = Q::new(1.into(), 2.into());
        let m = Matrix::from_fn(2, 2, |i, j| {
            if (i, j) == (0, 1) {
                Q::zero()
            } else if (i, j) == (1, 1) {
                Q::one()
            } else {
                half.clone()
            }
        });
        assert_eq!(m.fixed_point().unwrap().unwrap(), [0, 1].map(whole));
        assert!(Matrix::identity(2).fixed_point().unwrap().is_none());
    }
}
