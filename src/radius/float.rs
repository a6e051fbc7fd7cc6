//! Small dense float matrices. They propose words, points and coefficients; exact arithmetic decides.
#![allow(clippy::float_arithmetic, reason = "proposes, exact arithmetic decides")]

use super::System;
use crate::algebraic::nearest;
use crate::linalg::{Entry, Matrix};
use nalgebra::{DMatrix, DVector, Schur};

/// A float copy of a matrix.
#[derive(Debug, Clone)]
pub(super) struct Floats {
    pub rows: usize,
    pub cols: usize,
    pub data: Vec<f64>,
}

impl Floats {
    pub fn of<E: Entry>(m: &Matrix<E>) -> Self {
        let data = (0..m.rows()).flat_map(|i| m.row(i).iter().map(nearest)).collect();
        Self { rows: m.rows(), cols: m.cols(), data }
    }

    pub fn all<E: Entry>(system: &System<E>) -> Vec<Self> {
        system.arrows.iter().map(|a| Self::of(&a.matrix)).collect()
    }

    /// The product along a path, divided by its norm at every step; `None` of the empty path.
    pub fn product<E: Entry>(system: &System<E>, path: &[usize]) -> Option<Self> {
        let mut product: Option<Self> = None;
        for &a in path {
            let m = Self::of(&system.arrows[a].matrix);
            let next = product.map_or_else(|| m.clone(), |p: Self| p.times(&m));
            let norm = next.norm();
            product = Some(if norm > 0.0 && norm.is_finite() { next.scaled(1.0 / norm) } else { next });
        }
        product
    }

    pub fn scaled(mut self, factor: f64) -> Self {
        self.data.iter_mut().for_each(|x| *x *= factor);
        self
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut data = vec![0.0; self.rows * other.cols];
        for i in 0..self.rows {
            for k in 0..self.cols {
                let x = self.data[i * self.cols + k];
                if x != 0.0 {
                    for j in 0..other.cols {
                        data[i * other.cols + j] += x * other.data[k * other.cols + j];
                    }
                }
            }
        }
        Self { rows: self.rows, cols: other.cols, data }
    }

    pub fn transposed(&self) -> Self {
        let data = (0..self.cols).flat_map(|j| (0..self.rows).map(move |i| self.data[i * self.cols + j])).collect();
        Self { rows: self.cols, cols: self.rows, data }
    }

    pub fn apply(&self, v: &[f64]) -> Vec<f64> {
        self.data.chunks(self.cols.max(1)).map(|row| dot(row, v)).collect()
    }

    pub fn norm(&self) -> f64 {
        self.data.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn dense(&self) -> DMatrix<f64> {
        DMatrix::from_row_slice(self.rows, self.cols, &self.data)
    }

    /// About an eigenvalue of largest modulus of a square matrix, a real one before others; `None` where the iteration does not end.
    pub fn eigenvalue(&self) -> Option<(f64, f64)> {
        let size = self.norm();
        if self.rows == 0 || size == 0.0 || !size.is_finite() {
            return None;
        }
        let (_, triangle) = Schur::try_new(self.dense(), f64::EPSILON, 200 * (self.rows + 10))?.unpack();
        let n = self.rows;
        let mut found: Vec<(f64, f64)> = Vec::new();
        let mut k = 0;
        while k < n {
            if k + 1 < n && triangle[(k + 1, k)] != 0.0 {
                let (a, b, c, d) =
                    (triangle[(k, k)], triangle[(k, k + 1)], triangle[(k + 1, k)], triangle[(k + 1, k + 1)]);
                let (half, det) = (0.5 * (a + d), a * d - b * c);
                let disc = half * half - det;
                if disc >= 0.0 {
                    found.extend([(half + disc.sqrt(), 0.0), (half - disc.sqrt(), 0.0)]);
                } else {
                    found.push((half, (-disc).sqrt()));
                }
                k += 2;
            } else {
                found.push((triangle[(k, k)], 0.0));
                k += 1;
            }
        }
        let top = found.iter().map(|z| z.0.hypot(z.1)).fold(0.0, f64::max);
        let near = |z: &&(f64, f64)| z.0.hypot(z.1) >= top * (1.0 - 1e-9);
        found.iter().filter(near).min_by(|a, b| a.1.total_cmp(&b.1).then(b.0.total_cmp(&a.0))).copied()
    }

    /// About a real eigenvector for an eigenvalue, by inverse iteration, of largest coordinate 1.
    pub fn eigenvector(&self, eigenvalue: f64) -> Option<Vec<f64>> {
        let n = self.rows;
        let shift = eigenvalue * (1.0 + 1e-13) + f64::MIN_POSITIVE;
        let lu = (self.dense() - DMatrix::identity(n, n) * shift).lu();
        let mut v = DVector::from_fn(n, |i, _| 1.0 + 0.01 * ((i * 7919) % 101) as f64 / 101.0);
        for _ in 0..4 {
            v = lu.solve(&v)?;
            let top = v.iter().copied().fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
            if top == 0.0 || !top.is_finite() {
                return None;
            }
            v /= top;
        }
        Some(v.iter().copied().collect())
    }

    /// Work of a product with a matrix of this size.
    pub fn cube(&self) -> u64 {
        (self.rows * self.cols * self.cols.max(self.rows)) as u64 + 20
    }

    /// Whether the spectral radius of a square matrix is above `1 + 1e-9`: a few squarings suffice where powers shrink.
    pub fn exceeds_one(&self) -> bool {
        let mut power = self.clone();
        for _ in 0..5 {
            if power.norm() < 1.0 {
                return false;
            }
            power = power.times(&power);
        }
        self.radius() > 1.0 + 1e-9
    }

    /// The spectral radius of a square matrix, by repeated squaring.
    pub fn radius(&self) -> f64 {
        let mut power = self.clone();
        let mut log_norm = 0.0;
        let mut scale = 1.0;
        for _ in 0..40 {
            let norm = power.norm();
            if norm == 0.0 || !norm.is_finite() {
                return 0.0;
            }
            log_norm += norm.ln() / scale;
            scale *= 2.0;
            power = power.scaled(1.0 / norm);
            let square = power.times(&power);
            // Where P² is a multiple of P, the rest is known.
            let c = dot(&square.data, &power.data);
            let rest: f64 = square.data.iter().zip(&power.data).map(|(s, p)| (s - c * p) * (s - c * p)).sum();
            if rest <= 1e-30 && c.abs() > 1e-3 {
                return (log_norm + c.abs().ln() * 2.0 / scale).exp();
            }
            power = square;
        }
        log_norm.exp()
    }
}

/// The scalar product, summed in four parts.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (left, right) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in left.zip(right) {
        for (s, (p, q)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *s += p * q;
        }
    }
    rest + (sums[0] + sums[1]) + (sums[2] + sums[3])
}
