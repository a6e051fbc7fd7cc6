//! Dense float matrices of a few hundred rows, in plain loops that are fast without optimisation across crates too.
#![allow(clippy::float_arithmetic, reason = "proposes, exact arithmetic decides")]

use std::ops::{Index, IndexMut};

/// A matrix, row after row.
#[derive(Debug, Clone)]
pub(super) struct Dense {
    pub rows: usize,
    pub cols: usize,
    pub data: Vec<f64>,
}

impl Index<(usize, usize)> for Dense {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.data[i * self.cols + j]
    }
}

impl IndexMut<(usize, usize)> for Dense {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.data[i * self.cols + j]
    }
}

impl Dense {
    pub fn new(rows: usize, cols: usize, data: Vec<f64>) -> Self {
        Self { rows, cols, data }
    }

    pub fn zero(rows: usize, cols: usize) -> Self {
        Self::new(rows, cols, vec![0.0; rows * cols])
    }

    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.data[i * self.cols..(i + 1) * self.cols]
    }

    pub fn transposed(&self) -> Self {
        let mut out = Self::zero(self.cols, self.rows);
        for i in 0..self.rows {
            for (j, x) in self.row(i).iter().enumerate() {
                out.data[j * self.rows + i] = *x;
            }
        }
        out
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut out = Self::zero(self.rows, other.cols);
        for i in 0..self.rows {
            for (k, &x) in self.row(i).iter().enumerate() {
                if x != 0.0 {
                    let line = &mut out.data[i * other.cols..(i + 1) * other.cols];
                    line.iter_mut().zip(other.row(k)).for_each(|(y, z)| *y += x * z);
                }
            }
        }
        out
    }

    pub fn add(&mut self, factor: f64, other: &Self) {
        self.data.iter_mut().zip(&other.data).for_each(|(x, y)| *x += factor * y);
    }

    pub fn scaled(&self, factor: f64) -> Self {
        Self::new(self.rows, self.cols, self.data.iter().map(|x| factor * x).collect())
    }

    /// Adds a multiple of the identity.
    pub fn shift(&mut self, by: f64) {
        for i in 0..self.rows {
            self.data[i * self.cols + i] += by;
        }
    }

    pub fn shifted(mut self, by: f64) -> Self {
        self.shift(by);
        self
    }

    pub fn trace(&self) -> f64 {
        (0..self.rows).map(|i| self[(i, i)]).sum()
    }

    /// The quadratic form at a vector.
    pub fn at(&self, v: &[f64]) -> f64 {
        v.iter().enumerate().map(|(i, x)| x * dot(self.row(i), v)).sum()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Cholesky's factor of a matrix of which only what lies on and below the diagonal is read; `None` where it is not positive definite.
pub(super) fn factored(mut m: Dense) -> Option<Dense> {
    let n = m.rows;
    for i in 0..n {
        let (above, rest) = m.data.split_at_mut(i * n);
        let line = &mut rest[..n];
        for j in 0..i {
            let other = &above[j * n..j * n + n];
            line[j] = (line[j] - dot(&line[..j], &other[..j])) / other[j];
        }
        let pivot = line[i] - dot(&line[..i], &line[..i]);
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        line[i] = pivot.sqrt();
        line[i + 1..].fill(0.0);
    }
    Some(m)
}

/// The solution of `m x = right` for a positive definite matrix.
pub(super) fn solved(m: Dense, right: &[f64]) -> Option<Vec<f64>> {
    let l = factored(m)?;
    let n = l.rows;
    let mut x = right.to_vec();
    for i in 0..n {
        x[i] = (x[i] - dot(&l.row(i)[..i], &x[..i])) / l[(i, i)];
    }
    for i in (0..n).rev() {
        let value = x[i] / l[(i, i)];
        x[i] = value;
        x[..i].iter_mut().zip(l.row(i)).for_each(|(y, a)| *y -= value * a);
    }
    Some(x)
}

/// The inverse of a positive definite matrix.
pub(super) fn inverse(m: Dense) -> Option<Dense> {
    let l = factored(m)?;
    let n = l.rows;
    // The rows of the inverse of the factor, transposed.
    let mut k = Dense::zero(n, n);
    for j in 0..n {
        for i in j..n {
            let unit = if i == j { 1.0 } else { 0.0 };
            let known = dot(&l.row(i)[j..i], &k.row(j)[j..i]);
            k[(j, i)] = (unit - known) / l[(i, i)];
        }
    }
    let entry = |i: usize, j: usize| dot(&k.row(i)[i.max(j)..], &k.row(j)[i.max(j)..]);
    let data = (0..n * n).map(|p| entry(p / n, p % n)).collect();
    Some(Dense::new(n, n, data))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_of_positive_matrices() {
        let m = Dense::new(3, 3, vec![4.0, 1.0, 0.5, 1.0, 3.0, -1.0, 0.5, -1.0, 2.0]);
        let product = m.times(&inverse(m.clone()).unwrap());
        let x = solved(m.clone(), &[1.0, 2.0, 3.0]).unwrap();
        let image = m.times(&Dense::new(3, 1, x));
        for i in 0..3 {
            assert!((image.data[i] - (i + 1) as f64).abs() < 1e-12);
            for j in 0..3 {
                assert!((product[(i, j)] - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
        assert!(factored(Dense::new(2, 2, vec![1.0, 2.0, 2.0, 1.0])).is_none());
    }
}
