//! Small dense float matrices. They propose words, points and coefficients; exact arithmetic decides.
#![allow(clippy::float_arithmetic, reason = "proposes, exact arithmetic decides")]

use super::System;
use crate::arith::to_f64;
use crate::linalg::Matrix;

/// A float copy of a matrix.
#[derive(Debug, Clone)]
pub(super) struct Floats {
    pub rows: usize,
    pub cols: usize,
    pub data: Vec<f64>,
}

impl Floats {
    pub fn of(m: &Matrix) -> Self {
        let data = (0..m.rows()).flat_map(|i| m.row(i).iter().map(to_f64)).collect();
        Self { rows: m.rows(), cols: m.cols(), data }
    }

    pub fn all(system: &System) -> Vec<Self> {
        system.arrows.iter().map(|a| Self::of(&a.matrix)).collect()
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

    pub fn apply(&self, v: &[f64]) -> Vec<f64> {
        self.data.chunks(self.cols.max(1)).map(|row| dot(row, v)).collect()
    }

    pub fn norm(&self) -> f64 {
        self.data.iter().map(|x| x * x).sum::<f64>().sqrt()
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
            power = power.times(&power);
        }
        log_norm.exp()
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
