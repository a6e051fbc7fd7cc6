use super::matrix::Matrix;
use crate::arith::{Integer, Rational};
use crate::ring::Ring;
use malachite_base::num::arithmetic::traits::{DivExact, Pow};

impl Matrix {
    /// The determinant; 1 of the matrix without rows.
    ///
    /// # Panics
    /// If the matrix is not square.
    ///
    /// # Cost
    /// `O(n³)` operations with integers that are minors of the matrix.
    ///
    /// Source: E. Bareiss, *Sylvester's identity and multistep integer-preserving Gaussian elimination*, Math. Comp. 22 (1968).
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix};
    ///
    /// let m = Matrix::from_fn(2, 2, |i, j| ratio([[0, 1], [3, 5]][i][j], 2));
    /// assert_eq!(m.determinant(), ratio(-3, 4));
    /// ```
    #[must_use]
    pub fn determinant(&self) -> Rational {
        let n = self.rows();
        assert_eq!(n, self.cols(), "square matrix");
        let (scale, whole) = self.cleared();
        let mut rows: Vec<Vec<Integer>> = (0..n).map(|i| whole.row(i).to_vec()).collect();
        let (mut before, mut turned) = (Integer::from(1), false);
        for k in 0..n {
            let Some(found) = (k..n).find(|&r| rows[r][k] != 0) else { return Rational::from(0) };
            rows.swap(k, found);
            turned ^= found != k;
            let (top, below) = rows.split_at_mut(k + 1);
            let row = &top[k];
            for line in below {
                let factor = line[k].clone();
                for (x, y) in line.iter_mut().zip(row).skip(k + 1) {
                    *x = (&*x * &row[k] - &factor * y).div_exact(&before);
                }
            }
            before = row[k].clone();
        }
        let whole = if turned { -before } else { before };
        Rational::from(whole) / Rational::from(scale.pow(n as u64))
    }
}

impl<E: Clone> Matrix<E> {
    /// A column of the adjugate of `x − A` over a ring: `Σ x^k y_k` with `y_{n−1} = e` and `y_{k−1} = A y_k + c_k e`, where the `c_k`
    /// are the coefficients of the characteristic polynomial, which is given, the constant one first. Where `x` is an eigenvalue,
    /// `A` maps the column to `x` times itself.
    ///
    /// # Panics
    /// If the matrix is not square, has no such column, or the polynomial has another degree.
    ///
    /// # Cost
    /// `O(n³)` operations in the ring.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, linalg::Matrix, ring::Rationals};
    ///
    /// let m = Matrix::from_fn(2, 2, |i, j| ratio([[1, 2], [2, 1]][i][j], 1));
    /// let chi = m.char_poly_over(&Rationals);
    /// assert_eq!(m.adjugate_column_over(&Rationals, &chi, 0, &ratio(3, 1)), [ratio(2, 1), ratio(2, 1)]);
    /// ```
    #[must_use]
    pub fn adjugate_column_over<K: Ring<E = E>>(&self, k: &K, chi: &[E], column: usize, x: &E) -> Vec<E> {
        let n = self.rows();
        assert!(n == self.cols() && column < n && chi.len() == n + 1, "a square matrix, its column and polynomial");
        let dot = |row: &[E], v: &[E]| row.iter().zip(v).fold(k.zero(), |s, (a, b)| k.add(&s, &k.mul(a, b)));
        let mut y: Vec<E> = (0..n).map(|i| if i == column { k.one() } else { k.zero() }).collect();
        let mut sum = y.clone();
        for c in chi[1..n].iter().rev() {
            y = (0..n).map(|i| dot(self.row(i), &y)).collect();
            y[column] = k.add(&y[column], c);
            sum = sum.iter().zip(&y).map(|(s, z)| k.add(&k.mul(s, x), z)).collect();
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::char_poly;
    use crate::ring::Rationals;
    use proptest::prelude::*;

    fn square() -> impl Strategy<Value = Matrix> {
        (0usize..=5).prop_flat_map(|n| {
            let entry = (-3i64..=3, 1i64..=4).prop_map(|(p, q)| ratio(p, q));
            prop::collection::vec(entry, n * n).prop_map(move |e| Matrix::from_fn(n, n, |i, j| e[i * n + j].clone()))
        })
    }

    proptest! {
        #[test]
        fn determinants_and_adjugates(m in square(), x in -3i64..=3) {
            let (n, x) = (m.rows(), ratio(x, 1));
            let shifted = &Matrix::identity(n).scale(&x) - &m;
            prop_assert_eq!(shifted.determinant(), char_poly(&m).eval(&x));
            let chi = m.char_poly_over(&Rationals);
            for c in 0..n {
                let column = m.adjugate_column_over(&Rationals, &chi, c, &x);
                let product = shifted.apply(&column);
                let zero = ratio(0, 1);
                let unit = |i: usize| if i == c { shifted.determinant() } else { zero.clone() };
                prop_assert_eq!(product, (0..n).map(unit).collect::<Vec<_>>());
            }
        }
    }
}
