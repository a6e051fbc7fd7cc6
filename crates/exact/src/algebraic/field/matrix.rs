use super::NumberField;
use super::over;
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use std::ops::{Index, IndexMut};

/// A dense matrix over a real number field: a [`Matrix`] of [`Elem`]s with its field.
#[derive(Debug, Clone)]
pub struct FieldMatrix {
    field: NumberField,
    matrix: Matrix<Elem>,
}

impl FieldMatrix {
    /// The matrix with entries `f(row, column)`.
    pub fn from_fn(field: &NumberField, rows: usize, cols: usize, f: impl FnMut(usize, usize) -> Elem) -> Self {
        Self::over(field, Matrix::from_fn(rows, cols, f))
    }

    /// The matrix with these entries.
    #[must_use]
    pub fn over(field: &NumberField, matrix: Matrix<Elem>) -> Self {
        Self { field: field.clone(), matrix }
    }

    /// The matrix with the given entries, row by row.
    ///
    /// # Panics
    /// If there are not `rows * cols` of them.
    #[must_use]
    pub fn new(field: &NumberField, rows: usize, cols: usize, data: Vec<Elem>) -> Self {
        assert_eq!(data.len(), rows * cols, "number of entries");
        let mut data = data.into_iter();
        Self::from_fn(field, rows, cols, |_, _| data.next().expect("counted"))
    }

    /// A rational matrix.
    #[must_use]
    pub fn from_rational(field: &NumberField, a: &Matrix) -> Self {
        Self::over(field, a.map(Elem::from_rational))
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

    /// The entries.
    #[must_use]
    pub fn matrix(&self) -> &Matrix<Elem> {
        &self.matrix
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.matrix.rows()
    }

    /// Number of columns.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.matrix.cols()
    }

    /// Row `i`.
    #[must_use]
    pub fn row(&self, i: usize) -> &[Elem] {
        self.matrix.row(i)
    }

    /// Column `j`, copied.
    #[must_use]
    pub fn column(&self, j: usize) -> Vec<Elem> {
        self.matrix.column(j)
    }

    /// All entries, row by row.
    #[must_use]
    pub fn entries(&self) -> &[Elem] {
        self.matrix.entries()
    }

    /// Whether both have the same size and entries, in the same field.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        self.field.same(&other.field) && self.matrix == other.matrix
    }

    /// The matrix, when all entries are rational.
    #[must_use]
    pub fn rational(&self) -> Option<Matrix> {
        let values: Option<Vec<Rational>> = self.entries().iter().map(Elem::is_rational).collect();
        let mut values = values?.into_iter();
        Some(self.matrix.map(|_| values.next().expect("one for each entry")))
    }

    /// The rational matrix of the coefficients of `α^k`.
    #[must_use]
    pub fn coefficient(&self, k: usize) -> Matrix {
        self.matrix.map(|x| x.0.coeff(k))
    }

    /// The same matrix over the smallest field that holds its entries.
    #[must_use]
    pub fn shrunk(&self) -> Self {
        let (field, data) = self.field.shrunk(self.entries());
        Self::new(&field, self.rows(), self.cols(), data)
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::over(&self.field, self.matrix.transpose())
    }

    /// `self * other`.
    ///
    /// # Panics
    /// If the sizes do not fit or the fields differ.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        assert_eq!(self.cols(), other.rows(), "inner dimension");
        assert!(self.field.same(&other.field), "one field");
        Self::from_fn(&self.field, self.rows(), other.cols(), |i, j| self.dot(i, |k| &other[(k, j)]))
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
        assert_eq!((self.rows(), self.cols()), (other.rows(), other.cols()), "matrix size");
        assert!(self.field.same(&other.field), "one field");
        Self::from_fn(&self.field, self.rows(), self.cols(), |i, j| self[(i, j)].add(&other[(i, j)]))
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Elem) -> Self {
        Self::over(&self.field, self.matrix.map(|x| self.field.mul(x, factor)))
    }

    /// `self * v` for a column `v`.
    ///
    /// # Panics
    /// If `v.len() != self.cols()`.
    #[must_use]
    pub fn apply(&self, v: &[Elem]) -> Vec<Elem> {
        assert_eq!(v.len(), self.cols(), "vector length");
        (0..self.rows()).map(|i| self.dot(i, |k| &v[k])).collect()
    }

    /// The reduced row echelon form: its nonzero rows, and the columns of their leading ones.
    #[must_use]
    pub fn echelon(&self) -> (Self, Vec<usize>) {
        let found = self.matrix.echelon_over(&self.field).expect("numbers of a field are told from 0");
        (Self::over(&self.field, found.rows), found.pivots)
    }

    /// The rank.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.echelon().1.len()
    }

    /// A basis of `{x : self x = 0}`, as the columns of the result.
    #[must_use]
    pub fn kernel(&self) -> Self {
        let kernel = self.matrix.kernel_over(&self.field).expect("numbers of a field are told from 0");
        Self::over(&self.field, kernel)
    }

    /// The characteristic polynomial `det(x - A)` over the field, the constant coefficient first (see
    /// [`Matrix::char_poly_over`]).
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn char_poly(&self) -> Vec<Elem> {
        self.matrix.char_poly_over(&self.field)
    }

    /// The matrix over the rationals of size `n d` that acts on `K^n` as this one: every entry becomes the matrix of its
    /// multiplication, in the basis `1, α, …` (restriction of scalars).
    #[must_use]
    pub fn restricted(&self) -> Matrix {
        let d = self.field.degree();
        let mut out = Matrix::zero(self.rows() * d, self.cols() * d);
        for i in 0..self.rows() {
            for j in 0..self.cols() {
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
        let identity = Self::identity(&self.field, self.rows());
        let zero = identity.scale(&Elem::zero());
        over::trimmed(p.to_vec()).iter().rev().fold(zero, |acc, c| acc.mul(self).add(&identity.scale(c)))
    }

    /// Whether every entry is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.entries().iter().all(Elem::is_zero)
    }
}

impl Index<(usize, usize)> for FieldMatrix {
    type Output = Elem;
    fn index(&self, (i, j): (usize, usize)) -> &Elem {
        &self.matrix[(i, j)]
    }
}

impl IndexMut<(usize, usize)> for FieldMatrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut Elem {
        &mut self.matrix[(i, j)]
    }
}
