//! Matrices whose entries are polynomials in a parameter: where in an interval their joint spectral radius is below 1.
//!
//! From above words bound the parameters that are proved (`word`, the statement *Words of a family*), from below hulls whose
//! vertices move with the parameter prove them (`hull`, *Hulls of a family*). `cover` goes through the interval.

mod cover;
mod hull;
mod proposal;
mod word;

pub use cover::{Below, Place, Search, below};
pub use hull::{Cover, Hull, Image, Piece, Seed, Vertex};
pub use word::Crossing;
pub(crate) use word::interpolated;

use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::ring::{Field, Model, Models};

/// Square matrices of one size with polynomial entries, by letter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pencil {
    matrices: Vec<Matrix<Poly>>,
}

impl Pencil {
    /// The matrices by letter; `None` where there are none, or where they are not square of one size.
    #[must_use]
    pub fn new(matrices: Vec<Matrix<Poly>>) -> Option<Self> {
        let n = matrices.first()?.rows();
        let fits = n > 0 && matrices.iter().all(|m| m.rows() == n && m.cols() == n);
        fits.then_some(Self { matrices })
    }

    /// The same divided by a positive number, so that the threshold 1 stands for it.
    #[must_use]
    pub fn divided(&self, by: &Rational) -> Self {
        let factor = Rational::from(1) / by;
        Self { matrices: self.matrices.iter().map(|m| m.map(|f| f.scale(&factor))).collect() }
    }

    /// The size.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.matrices[0].rows()
    }

    /// The number of matrices.
    #[must_use]
    pub fn letters(&self) -> usize {
        self.matrices.len()
    }

    /// The matrices.
    #[must_use]
    pub fn matrices(&self) -> &[Matrix<Poly>] {
        &self.matrices
    }

    /// The largest degree of an entry.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.matrices.iter().flat_map(|m| m.entries()).filter_map(Poly::degree).fold(0, usize::max)
    }

    /// The matrices of a member.
    #[must_use]
    pub fn at(&self, p: &Rational) -> Vec<Matrix> {
        self.matrices.iter().map(|m| m.map(|f| f.eval(p))).collect()
    }

    /// The matrices on an interval.
    fn on(&self, k: &Models, p: &Model) -> Vec<Matrix<Model>> {
        self.matrices.iter().map(|m| m.map(|f| k.eval(f, p))).collect()
    }
}
