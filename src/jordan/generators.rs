//! Rational vectors that generate the cyclic summands of a primary component.

use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;

/// A rational vector with `f(A)^size u = 0`; it generates a cyclic module `Q[x] / (f^size)`, that is one Jordan block
/// of that size for every root of `f`.
pub(super) struct Generator {
    pub vector: Vec<Rational>,
    pub size: usize,
}

/// The value of a polynomial at a matrix.
pub(super) fn evaluate(f: &Poly, a: &Matrix) -> Matrix {
    let n = a.rows();
    let mut value = Matrix::zero(n, n);
    for c in f.coeffs().iter().rev() {
        value = &value * a;
        for i in 0..n {
            value[(i, i)] += c;
        }
    }
    value
}

/// Generators of the whole component `ker f(A)^multiplicity`, sizes descending.
pub(super) fn generators(a: &Matrix, f: &Poly, multiplicity: usize) -> Vec<Generator> {
    let degree = f.degree().unwrap_or(1);
    let value = evaluate(f, a);
    let mut powers = vec![value.clone()];
    let mut kernels = vec![value.kernel()];
    while kernels[kernels.len() - 1].cols() < degree * multiplicity {
        let next = &powers[powers.len() - 1] * &value;
        kernels.push(next.kernel());
        powers.push(next);
    }
    let mut span = Span::default();
    let mut found = Vec::new();
    for size in (1..=kernels.len()).rev() {
        let below = if size == 1 { 0 } else { kernels[size - 2].cols() };
        let count = (kernels[size - 1].cols() - below) / degree;
        for column in 0..kernels[size - 1].cols() {
            if found.len() == count {
                break;
            }
            let vector = kernels[size - 1].column(column);
            let socle = if size == 1 { vector.clone() } else { powers[size - 2].apply(&vector) };
            if span.extend(a, socle, degree) {
                found.push(Generator { vector, size });
            }
        }
        debug_assert_eq!(found.len(), count);
    }
    found
}

/// A subspace that the matrix maps to itself, by a reduced basis.
#[derive(Default)]
struct Span {
    rows: Vec<(usize, Vec<Rational>)>,
}

impl Span {
    fn reduced(&self, mut v: Vec<Rational>) -> Vec<Rational> {
        for (pivot, row) in &self.rows {
            let factor = v[*pivot].clone();
            if factor != 0 {
                for (x, y) in v.iter_mut().zip(row) {
                    *x -= &factor * y;
                }
            }
        }
        v
    }

    /// Adds `v, A v, ..., A^(degree - 1) v`; false when `v` is in the span already (then all of them are).
    fn extend(&mut self, a: &Matrix, mut v: Vec<Rational>, degree: usize) -> bool {
        for step in 0..degree {
            let mut row = self.reduced(v.clone());
            let Some(pivot) = row.iter().position(|x| *x != 0) else {
                debug_assert_eq!(step, 0);
                return false;
            };
            let inverse = Rational::from(1) / &row[pivot];
            row.iter_mut().for_each(|x| *x *= &inverse);
            self.rows.push((pivot, row));
            if step + 1 < degree {
                v = a.apply(&v);
            }
        }
        true
    }
}
