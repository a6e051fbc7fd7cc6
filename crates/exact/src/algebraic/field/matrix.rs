use super::NumberField;
use super::over::{self, Over};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use std::ops::{Index, IndexMut};

/// A dense matrix over a real number field, stored by rows.
#[derive(Debug, Clone)]
pub struct FieldMatrix {
    field: NumberField,
    rows: usize,
    cols: usize,
    data: Vec<Elem>,
}

impl FieldMatrix {
    /// The matrix with entries `f(row, column)`.
    pub fn from_fn(field: &NumberField, rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> Elem) -> Self {
        let mut data = Vec::with_capacity(rows * cols);
        for i in 0..rows {
            for j in 0..cols {
                data.push(f(i, j));
            }
        }
        Self { field: field.clone(), rows, cols, data }
    }

    /// The matrix with the given entries, row by row.
    ///
    /// # Panics
    /// If there are not `rows * cols` of them.
    #[must_use]
    pub fn new(field: &NumberField, rows: usize, cols: usize, data: Vec<Elem>) -> Self {
        assert_eq!(data.len(), rows * cols, "number of entries");
        Self { field: field.clone(), rows, cols, data }
    }

    /// A rational matrix.
    #[must_use]
    pub fn from_rational(field: &NumberField, a: &Matrix) -> Self {
        Self::from_fn(field, a.rows(), a.cols(), |i, j| Elem::from_rational(&a[(i, j)]))
    }

    /// The identity of size `n`.
    #[must_use]
    pub fn identity(field: &NumberField, n: usize) -> Self {
        Self::from_rational(field, &Matrix::identity(n))
    }

    /// The field of the entries.
    #[must_use]
    pub fn field(&self) -> &NumberField {
        &self.field
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
    pub fn row(&self, i: usize) -> &[Elem] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Column `j`, copied.
    #[must_use]
    pub fn column(&self, j: usize) -> Vec<Elem> {
        (0..self.rows).map(|i| self[(i, j)].clone()).collect()
    }

    /// All entries, row by row.
    #[must_use]
    pub fn entries(&self) -> &[Elem] {
        &self.data
    }

    /// Whether both have the same size and entries, in the same field.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        (self.rows, self.cols) == (other.rows, other.cols) && self.field.same(&other.field) && self.data == other.data
    }

    /// The matrix, when all entries are rational.
    #[must_use]
    pub fn rational(&self) -> Option<Matrix> {
        let values: Option<Vec<Rational>> = self.data.iter().map(Elem::is_rational).collect();
        let values = values?;
        Some(Matrix::from_fn(self.rows, self.cols, |i, j| values[i * self.cols + j].clone()))
    }

    /// The rational matrix of the coefficients of `α^k`.
    #[must_use]
    pub fn coefficient(&self, k: usize) -> Matrix {
        Matrix::from_fn(self.rows, self.cols, |i, j| self[(i, j)].0.coeff(k))
    }

    /// The same matrix over the smallest field that holds its entries.
    #[must_use]
    pub fn shrunk(&self) -> Self {
        let (field, data) = self.field.shrunk(&self.data);
        Self { field, data, ..*self }
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(&self.field, self.cols, self.rows, |i, j| self[(j, i)].clone())
    }

    /// `self * other`.
    ///
    /// # Panics
    /// If the sizes do not fit or the fields differ.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        assert_eq!(self.cols, other.rows, "inner dimension");
        assert!(self.field.same(&other.field), "one field");
        Self::from_fn(&self.field, self.rows, other.cols, |i, j| self.dot(i, |k| &other[(k, j)]))
    }

    fn dot<'a>(&self, i: usize, entry: impl Fn(usize) -> &'a Elem) -> Elem {
        // One reduction for the whole sum.
        let mut sum = Poly::zero();
        for (k, x) in self.row(i).iter().enumerate() {
            let y = entry(k);
            if !x.is_zero() && !y.is_zero() {
                sum = &sum + &(&x.0 * &y.0);
            }
        }
        Elem::reduced(&sum, self.field.poly())
    }

    /// `self + other`.
    ///
    /// # Panics
    /// If the sizes or the fields differ.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        assert_eq!((self.rows, self.cols), (other.rows, other.cols), "matrix size");
        assert!(self.field.same(&other.field), "one field");
        Self::from_fn(&self.field, self.rows, self.cols, |i, j| self[(i, j)].add(&other[(i, j)]))
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Elem) -> Self {
        Self::from_fn(&self.field, self.rows, self.cols, |i, j| self.field.mul(&self[(i, j)], factor))
    }

    /// `self * v` for a column `v`.
    ///
    /// # Panics
    /// If `v.len() != self.cols()`.
    #[must_use]
    pub fn apply(&self, v: &[Elem]) -> Vec<Elem> {
        assert_eq!(v.len(), self.cols, "vector length");
        (0..self.rows).map(|i| self.dot(i, |k| &v[k])).collect()
    }

    /// The reduced row echelon form: its nonzero rows, and the columns of their leading ones.
    ///
    /// # Cost
    /// `O(rows * cols * rank)` operations in the field; entries may grow.
    #[must_use]
    pub fn echelon(&self) -> (Self, Vec<usize>) {
        let f = self.field.poly();
        let mut rows: Vec<Vec<Elem>> = (0..self.rows).map(|i| self.row(i).to_vec()).collect();
        let mut pivots = Vec::new();
        for col in 0..self.cols {
            let top = pivots.len();
            let Some(found) = (top..rows.len()).find(|&r| !rows[r][col].is_zero()) else { continue };
            rows.swap(top, found);
            let inverse = rows[top][col].inv(f).expect("a pivot is not 0");
            rows[top].iter_mut().for_each(|x| *x = x.mul(&inverse, f));
            let pivot = rows[top].clone();
            for row in rows.iter_mut().enumerate().filter(|(r, _)| *r != top).map(|(_, row)| row) {
                let factor = row[col].clone();
                if !factor.is_zero() {
                    for (x, y) in row.iter_mut().zip(&pivot).filter(|(_, y)| !y.is_zero()) {
                        *x = x.sub(&factor.mul(y, f));
                    }
                }
            }
            pivots.push(col);
        }
        rows.truncate(pivots.len());
        let data = rows.into_iter().flatten().collect();
        (Self { field: self.field.clone(), rows: pivots.len(), cols: self.cols, data }, pivots)
    }

    /// The rank.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.echelon().1.len()
    }

    /// A basis of `{x : self x = 0}`, as the columns of the result.
    #[must_use]
    pub fn kernel(&self) -> Self {
        let (rows, pivots) = self.echelon();
        let free: Vec<usize> = (0..self.cols).filter(|c| !pivots.contains(c)).collect();
        let mut basis = Self::from_fn(&self.field, self.cols, free.len(), |_, _| Elem::zero());
        for (k, &f) in free.iter().enumerate() {
            basis[(f, k)] = Elem::from_rational(&1.into());
            for (r, &p) in pivots.iter().enumerate() {
                basis[(p, k)] = rows[(r, f)].neg();
            }
        }
        basis
    }

    /// The characteristic polynomial `det(x - A)` over the field, the constant coefficient first.
    ///
    /// # Panics
    /// If the matrix is not square.
    ///
    /// # Cost
    /// `O(n^4)` operations in the field, no division (Berkowitz).
    ///
    /// Source: S. Berkowitz, *On computing the determinant in small parallel time using a small number of processors*,
    /// Inf. Process. Lett. 18 (1984).
    #[must_use]
    pub fn char_poly(&self) -> Vec<Elem> {
        assert_eq!(self.rows, self.cols, "square matrix");
        let f = self.field.poly();
        // High degree first, for the leading submatrices.
        let mut high: Over = vec![Elem::from_rational(&1.into())];
        for r in 0..self.rows {
            let toeplitz = self.toeplitz_column(r);
            let product = |k: usize| {
                let terms = high.iter().enumerate().take(k + 1).map(|(j, c)| toeplitz[k - j].mul(c, f));
                terms.fold(Elem::zero(), |acc, x| acc.add(&x))
            };
            high = (0..r + 2).map(product).collect();
        }
        high.reverse();
        high
    }

    /// `1, -a_rr, -R C, -R M C, …` with the leading submatrix `M` of size `r`, the row `R` and the column `C` beside it.
    fn toeplitz_column(&self, r: usize) -> Vec<Elem> {
        let leading = Self::from_fn(&self.field, r, r, |i, j| self[(i, j)].clone());
        let row = Self::from_fn(&self.field, 1, r, |_, j| self[(r, j)].clone());
        let mut column: Vec<Elem> = (0..r).map(|i| self[(i, r)].clone()).collect();
        let mut out = vec![Elem::from_rational(&1.into()), self[(r, r)].neg()];
        for _ in 0..r {
            out.push(row.apply(&column)[0].neg());
            column = leading.apply(&column);
        }
        out
    }

    /// The matrix over the rationals of size `n d` that acts on `K^n` as this one: every entry becomes the matrix of its
    /// multiplication, in the basis `1, α, …` (restriction of scalars).
    #[must_use]
    pub fn restricted(&self) -> Matrix {
        let d = self.field.degree();
        let mut out = Matrix::zero(self.rows * d, self.cols * d);
        for i in 0..self.rows {
            for j in 0..self.cols {
                let x = &self[(i, j)];
                if x.is_zero() {
                    continue;
                }
                let block = self.field.multiplication(x);
                for k in 0..d {
                    for l in 0..d {
                        out[(i * d + k, j * d + l)] = block[(k, l)].clone();
                    }
                }
            }
        }
        out
    }

    /// The value of a polynomial over the field at this matrix (Horner).
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn evaluate(&self, p: &[Elem]) -> Self {
        let identity = Self::identity(&self.field, self.rows);
        let zero = identity.scale(&Elem::zero());
        over::trimmed(p.to_vec()).iter().rev().fold(zero, |acc, c| acc.mul(self).add(&identity.scale(c)))
    }

    /// Whether every entry is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.data.iter().all(Elem::is_zero)
    }
}

impl Index<(usize, usize)> for FieldMatrix {
    type Output = Elem;
    fn index(&self, (i, j): (usize, usize)) -> &Elem {
        &self.data[i * self.cols + j]
    }
}

impl IndexMut<(usize, usize)> for FieldMatrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut Elem {
        &mut self.data[i * self.cols + j]
    }
}
