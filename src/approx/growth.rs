use crate::algebraic::nearest;
use crate::linalg::{Entry, Matrix};
use nalgebra::DMatrix;

/// Whether the spectral radius of a square matrix might be 1 or more: `‖M^64‖^(1/64) >= 0.99` in floats.
///
/// A proposal only; the exact spectrum decides.
#[must_use]
#[allow(clippy::float_arithmetic, reason = "proposes, the exact spectrum decides")]
pub fn may_expand<E: Entry>(m: &Matrix<E>) -> bool {
    let mut power = DMatrix::from_fn(m.rows(), m.cols(), |i, j| nearest(&m[(i, j)]));
    let mut log_norm = 0.0;
    for _ in 0..6 {
        let norm = power.norm();
        if norm == 0.0 {
            return false;
        }
        if !norm.is_finite() {
            return true;
        }
        power /= norm;
        log_norm = 2.0 * (log_norm + norm.ln());
        power = &power * &power;
    }
    let norm = power.norm();
    norm > 0.0 && (log_norm + norm.ln()) / 64.0 >= 0.99_f64.ln()
}
