#![allow(clippy::float_arithmetic)] // everything here is approximate and says so

use crate::arith::to_f64;
use crate::linalg::Matrix;
use nalgebra::linalg::Schur;
use nalgebra::{Complex, DMatrix};
use thiserror::Error;

/// Approximate eigenvalues of a matrix that is too large for the exact method.
#[derive(Debug, Clone)]
pub struct ApproxSpectrum {
    /// The eigenvalues with their error estimates, by descending modulus.
    pub eigenvalues: Vec<ApproxEigenvalue>,
    /// `|A Q - Q T| / |A|` for the computed Schur form, in the Frobenius norm.
    pub residual: f64,
    /// Whether some eigenvalue is so ill-conditioned that half of the digits or more are in doubt.
    pub ill_conditioned: bool,
}

/// One approximate eigenvalue.
#[derive(Debug, Clone, Copy)]
pub struct ApproxEigenvalue {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// The distance to the nearest other eigenvalue: where it is small, the digits beyond it mean nothing.
    pub gap: f64,
}

/// Why there is no approximate spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ApproxError {
    /// An entry is outside the range of double precision.
    #[error("an entry of the matrix is outside the range of double precision")]
    Range,
    /// The iteration did not converge within its bound.
    #[error("the QR iteration did not converge within {0} steps")]
    NoConvergence(usize),
}

/// Steps of the QR iteration allowed for each row.
const STEPS: usize = 60;

/// Approximate eigenvalues by the QR iteration, with a bound on the number of its steps.
///
/// The eigenvalues of a defective matrix are found with an error of about the `k`-th root of the rounding error for a
/// block of size `k`; [`ApproxSpectrum::ill_conditioned`] says when eigenvalues are so close that this is suspected.
///
/// # Errors
/// [`ApproxError`] when the iteration does not converge, or an entry is out of range.
///
/// # Panics
/// If the matrix is not square.
pub fn approximate_spectrum(a: &Matrix) -> Result<ApproxSpectrum, ApproxError> {
    assert_eq!(a.rows(), a.cols(), "square matrix");
    let n = a.rows();
    let m = DMatrix::from_fn(n, n, |i, j| to_f64(&a[(i, j)]));
    if m.iter().any(|x| !x.is_finite()) {
        return Err(ApproxError::Range);
    }
    if n == 0 {
        return Ok(ApproxSpectrum { eigenvalues: Vec::new(), residual: 0.0, ill_conditioned: false });
    }
    let steps = STEPS * n;
    let (q, t) = Schur::try_new(m.clone(), f64::EPSILON, steps).ok_or(ApproxError::NoConvergence(steps))?.unpack();
    let norm = m.norm().max(f64::MIN_POSITIVE);
    let residual = (&m * &q - &q * &t).norm() / norm;
    let mut values = diagonal_eigenvalues(&t, norm);
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im)));
    let eigenvalues: Vec<ApproxEigenvalue> = values.iter().enumerate().map(|(i, z)| with_gap(i, *z, &values)).collect();
    let ill_conditioned = eigenvalues.iter().any(|e| e.gap < norm * f64::EPSILON.powf(0.25));
    Ok(ApproxSpectrum { eigenvalues, residual, ill_conditioned })
}

/// Whether the largest modulus may belong to something else than one simple positive eigenvalue; `false` where that eigenvalue
/// clearly stands out. A guess.
#[must_use]
pub fn may_have_several_leaders(a: &Matrix) -> bool {
    let Ok(found) = approximate_spectrum(a) else { return true };
    let modulus = |e: &ApproxEigenvalue| e.re.hypot(e.im);
    let size = a.entries().iter().map(|x| to_f64(x).abs()).fold(0.0, f64::max);
    let [first, rest @ ..] = found.eigenvalues.as_slice() else { return true };
    let clear = first.im == 0.0 && first.re > 1e-6 * size;
    !clear || rest.first().is_some_and(|second| modulus(second) > CLEARLY_LESS * first.re)
}

/// What stands out is not next to an eigenvalue of this part of its modulus: rounding tears blocks apart, but not that far.
const CLEARLY_LESS: f64 = 0.9;

fn with_gap(index: usize, z: Complex<f64>, all: &[Complex<f64>]) -> ApproxEigenvalue {
    let others = all.iter().enumerate().filter(|(j, _)| *j != index);
    let gap = others.map(|(_, w)| (z - w).norm()).fold(f64::INFINITY, f64::min);
    ApproxEigenvalue { re: z.re, im: z.im, gap }
}

/// The eigenvalues of the diagonal blocks of size one and two of a real Schur form.
///
/// Unlike the library's own function this makes one pass: an entry below the diagonal either starts a block of size
/// two or counts as 0.
fn diagonal_eigenvalues(t: &DMatrix<f64>, norm: f64) -> Vec<Complex<f64>> {
    let n = t.nrows();
    let mut out = Vec::with_capacity(n);
    let mut i = 0;
    while i < n {
        if i + 1 < n && t[(i + 1, i)].abs() > f64::EPSILON * norm {
            let (a, b, c, d) = (t[(i, i)], t[(i, i + 1)], t[(i + 1, i)], t[(i + 1, i + 1)]);
            let (middle, half) = ((a + d) / 2.0, (a - d) / 2.0);
            let discriminant = half * half + b * c;
            let root = discriminant.abs().sqrt();
            if discriminant >= 0.0 {
                out.extend([Complex::new(middle + root, 0.0), Complex::new(middle - root, 0.0)]);
            } else {
                out.extend([Complex::new(middle, root), Complex::new(middle, -root)]);
            }
            i += 2;
        } else {
            out.push(Complex::new(t[(i, i)], 0.0));
            i += 1;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn simple_eigenvalues_are_found() {
        let a = Matrix::from_fn(3, 3, |i, j| ratio([[2, 1, 0], [0, 3, 1], [0, 0, 5]][i][j], 1));
        let s = approximate_spectrum(&a).unwrap();
        let moduli: Vec<f64> = s.eigenvalues.iter().map(|e| e.re).collect();
        for (x, y) in moduli.iter().zip([5.0, 3.0, 2.0]) {
            assert!((x - y).abs() < 1e-9);
        }
        assert!(s.residual < 1e-12 && !s.ill_conditioned);
    }

    #[test]
    fn a_defective_matrix_is_reported() {
        let a = Matrix::from_fn(3, 3, |i, j| ratio(i64::from(j == i + 1 || i == j), 1));
        let b = Matrix::from_fn(3, 3, |i, j| ratio([[1, 2, 0], [1, 3, 1], [0, 1, 2]][i][j], 1));
        let c = &(&b * &a) * &b.inverse().unwrap();
        assert!(approximate_spectrum(&c).unwrap().ill_conditioned);
    }

    #[test]
    fn leaders_that_stand_out() {
        let several =
            |rows: [[i64; 3]; 3]| may_have_several_leaders(&Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 4)));
        assert!(!several([[4, 1, 5], [0, 2, 1], [0, 0, -3]]));
        for tied in
            [[[4, 1, 5], [0, 2, 1], [0, 0, -4]], [[4, 1, 0], [0, 4, 1], [0, 0, 4]], [[0, -4, 0], [4, 0, 0], [0, 0, 1]]]
        {
            assert!(several(tied));
        }
        assert!(several([[-4, 0, 0], [0, 1, 0], [0, 0, 1]]) && several([[0, 1, 0], [0, 0, 1], [0, 0, 0]]));
    }

    #[test]
    fn an_entry_out_of_range_is_refused() {
        let huge = crate::arith::parse_rational("1e400").unwrap();
        assert_eq!(approximate_spectrum(&Matrix::from_fn(1, 1, |_, _| huge.clone())).unwrap_err(), ApproxError::Range);
    }
}
