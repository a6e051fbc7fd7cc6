//! Spectra of matrices over the rationals and over a real number field, seen in one way.

use super::{Chain, Eigenvalue, FieldSpectrum, ModulusClass, Spectrum};
use crate::algebraic::field::{FieldMatrix, NumberField};
use crate::algebraic::{Elem, Real, Root};
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use crate::poly::Poly;
use std::fmt;
use std::sync::Arc;

/// A field `Q(θ)`, and where the numbers of the matrix lie in it.
#[derive(Debug, Clone, Copy)]
pub struct Over<'a> {
    /// The minimal polynomial of `θ`.
    pub modulus: &'a Poly,
    /// The generator of the field of the matrix as a polynomial in `θ`; `None` over the rationals.
    pub alpha: Option<&'a Elem>,
}

/// What belongs to one factor of a characteristic polynomial, irreducible over the field of the matrix.
///
/// The chains are given once, with entries in `Q(θ)`. Their values at [`Part::places`] belong to the eigenvalues at the same
/// positions of [`Part::roots`]; over the rationals both are the same numbers.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a> {
    /// The field of the chains.
    pub over: Over<'a>,
    /// The minimal polynomial of the eigenvalues over the rationals.
    pub minpoly: &'a Poly,
    /// The exponent of the factor.
    pub multiplicity: usize,
    /// The sizes of the Jordan blocks of each root, descending.
    pub blocks: &'a [usize],
    /// The eigenvalues.
    pub roots: &'a [Root],
    /// An eigenvalue as a polynomial in `θ`; `None` where `θ` is the eigenvalue itself.
    pub lambda: Option<&'a Elem>,
    /// The values of `θ` that belong to them.
    pub places: &'a [Root],
    /// The right chains, one for each block.
    pub right: &'a [Chain],
    /// The left chains, one for each block.
    pub left: &'a [Chain],
}

/// A spectrum over some field.
pub trait Spectral: Clone + fmt::Debug + Send + Sync {
    /// The eigenvalues by absolute value, descending; exact ties share a class.
    fn classes(&self) -> &[ModulusClass];
    /// How many factors there are.
    fn factor_count(&self) -> usize;
    /// A factor by its index.
    fn part(&self, factor: usize) -> Part<'_>;
    /// The number that an eigenvalue stands for.
    fn value(&self, eigenvalue: Eigenvalue) -> &Root {
        &self.part(eigenvalue.factor).roots[eigenvalue.root]
    }
}

impl Spectral for Spectrum {
    fn classes(&self) -> &[ModulusClass] {
        &self.classes
    }

    fn factor_count(&self) -> usize {
        self.factors.len()
    }

    fn part(&self, factor: usize) -> Part<'_> {
        let f = &self.factors[factor];
        Part {
            over: Over { modulus: &f.poly, alpha: None },
            minpoly: &f.poly,
            multiplicity: f.multiplicity,
            blocks: &f.blocks,
            roots: &f.roots,
            lambda: None,
            places: &f.roots,
            right: &f.right,
            left: &f.left,
        }
    }
}

impl Spectral for FieldSpectrum {
    fn classes(&self) -> &[ModulusClass] {
        &self.classes
    }

    fn factor_count(&self) -> usize {
        self.factors.len()
    }

    fn part(&self, factor: usize) -> Part<'_> {
        let f = &self.factors[factor];
        Part {
            over: Over { modulus: &f.generator, alpha: Some(&f.alpha) },
            minpoly: &f.minpoly,
            multiplicity: f.multiplicity,
            blocks: &f.blocks,
            roots: &f.roots,
            lambda: Some(&f.lambda),
            places: &f.generators,
            right: &f.right,
            left: &f.left,
        }
    }
}

/// Entries of matrices whose spectra are known exactly.
pub trait Scalar: Entry {
    /// The field in which all entries of a system lie.
    type Base: Clone + fmt::Debug + Send + Sync;
    /// The spectrum of a matrix.
    type Spectrum: Spectral + 'static;

    /// The field of numbers that lie in one.
    fn base<'a>(numbers: impl IntoIterator<Item = &'a Self>) -> Self::Base;
    /// The generator of a field, where it is not that of the rationals.
    fn generator(base: &Self::Base) -> Option<&Root>;
    /// The degree of a field.
    fn degree(base: &Self::Base) -> usize {
        Self::generator(base).map_or(1, Root::degree)
    }
    /// The spectrum of a square matrix over a field that holds its entries; chains have entries in fields that hold it too.
    fn spectrum(a: &Matrix<Self>, base: &Self::Base) -> Self::Spectrum;
    /// The value of a factor of a characteristic polynomial at a matrix over the same field.
    fn factor_at(spectrum: &Self::Spectrum, factor: usize, a: &Matrix<Self>) -> Matrix<Self>;
    /// The number as a polynomial in the generator of its field.
    fn elem(&self) -> Elem;
    /// `self x` for an element of a larger field.
    #[must_use]
    fn scaled(&self, x: &Elem, over: Over<'_>) -> Elem;
}

impl Scalar for Rational {
    type Base = ();
    type Spectrum = Spectrum;

    fn base<'a>(_: impl IntoIterator<Item = &'a Self>) {}

    fn generator((): &()) -> Option<&Root> {
        None
    }

    fn spectrum(a: &Matrix, (): &()) -> Spectrum {
        Spectrum::of(a)
    }

    fn factor_at(spectrum: &Spectrum, factor: usize, a: &Matrix) -> Matrix {
        horner(spectrum.factors[factor].poly.coeffs().iter().cloned(), a)
    }

    fn elem(&self) -> Elem {
        Elem::from_rational(self)
    }

    fn scaled(&self, x: &Elem, _: Over<'_>) -> Elem {
        x.scale(self)
    }
}

impl Scalar for Real {
    type Base = Arc<NumberField>;
    type Spectrum = FieldSpectrum;

    fn base<'a>(numbers: impl IntoIterator<Item = &'a Self>) -> Arc<NumberField> {
        Self::field_of(numbers).unwrap_or_else(|| Arc::new(NumberField::rationals()))
    }

    fn generator(base: &Arc<NumberField>) -> Option<&Root> {
        (!base.is_rational()).then(|| base.generator())
    }

    fn spectrum(a: &Matrix<Self>, base: &Arc<NumberField>) -> FieldSpectrum {
        FieldSpectrum::over(&FieldMatrix::over(base, a.map(Self::elem)))
    }

    fn factor_at(spectrum: &FieldSpectrum, factor: usize, a: &Matrix<Self>) -> Matrix<Self> {
        let field = Arc::new(spectrum.field.clone());
        horner(spectrum.factors[factor].poly.iter().map(|c| Self::new(&field, c.clone())), a)
    }

    fn elem(&self) -> Elem {
        Self::elem(self)
    }

    fn scaled(&self, x: &Elem, over: Over<'_>) -> Elem {
        if let Some(q) = self.rational() {
            return x.scale(&q);
        }
        let alpha = over.alpha.expect("the field holds the number");
        let own = self.elem();
        let image = own
            .0
            .coeffs()
            .iter()
            .rev()
            .fold(Elem::zero(), |sum, c| sum.mul(alpha, over.modulus).add(&Elem::from_rational(c)));
        image.mul(x, over.modulus)
    }
}

/// A polynomial, the constant coefficient first, at a square matrix.
fn horner<E: Entry>(coefficients: impl DoubleEndedIterator<Item = E>, a: &Matrix<E>) -> Matrix<E> {
    let n = a.rows();
    let step = |sum: Matrix<E>, c: E| &(&sum * a) + &Matrix::identity(n).scale(&c);
    coefficients.rev().fold(Matrix::zero(n, n), step)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rational matrix over Q(√2): its eigenvalue √2 splits off, and the field of its chains holds √2.
    #[test]
    fn the_field_is_kept_where_the_matrix_is_rational() {
        let x = Real::read(&["0", "2", "1", "0", "sqrt(2)"]).unwrap();
        let a = Matrix::from_fn(2, 2, |i, j| x[2 * i + j].clone());
        let base = Real::base(&x);
        let s = Real::spectrum(&a, &base);
        assert_eq!((s.factor_count(), s.classes().len()), (2, 1));
        for f in 0..2 {
            let part = s.part(f);
            let v = &part.right[0].vectors[0];
            // A v = λ v, with λ = ±√2 as a multiple of the entry √2 of the case.
            let images: Vec<Elem> = (0..2)
                .map(|i| (0..2).fold(Elem::zero(), |sum, j| sum.add(&a[(i, j)].scaled(&v[j], part.over))))
                .collect();
            let sign = Rational::from(part.roots[0].sign());
            let wanted: Vec<Elem> = v.iter().map(|e| x[4].scaled(e, part.over).scale(&sign)).collect();
            assert_eq!(images, wanted);
        }
    }
}
