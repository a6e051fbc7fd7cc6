//! What is done over the rationals in one way and over a real number field in another.

use super::closing::Closing;
use super::leading::{Eigenvector, foremost};
use super::quadratic;
use super::radius_field::{self, Over};
use crate::algebraic::{Elem, Real, Root};
use crate::arith::{Rational, abs};
use crate::jordan::{Scalar, Spectral, modulus_classes};
use crate::linalg::{Entry, Matrix};
use crate::poly::Poly;

/// Entries of matrices whose joint spectral radii can be bounded.
pub trait Radial: Scalar {
    /// What a product and a sum are counted as, in nanoseconds: over a field fewer than they take, so that as much is tried.
    const PRODUCT: u64;

    /// An eigenvalue of largest modulus, a positive one before others; `None` where it is 0.
    fn largest(product: &Matrix<Self>) -> Option<Root>;
    /// The coefficients of the characteristic polynomial, the constant one first.
    fn char_poly(m: &Matrix<Self>) -> Vec<Self>;
    /// A polynomial with the same roots, all of them simple; `None` of 0.
    fn squarefree(p: &[Self]) -> Option<Vec<Self>>;
    /// An eigenvector for an eigenvalue.
    fn eigenvector(product: &Matrix<Self>, value: &Root) -> Option<Eigenvector>;
    /// The coordinates of an eigenvector as entries over a field; `None` where they do not lie there.
    fn own(vector: &Eigenvector, field: &Self::Base) -> Option<Vec<Self>>;
    /// Whether a symmetric matrix is positive definite (or, not `strict`, positive semidefinite).
    fn definite(m: &Matrix<Self>, strict: bool) -> bool;
    /// The field of the entries and the radius, with the leading eigenvectors in it; `None` where it is too large.
    fn over_radius(closing: &Closing<Self>) -> Option<Over>;
}

/// The number, or one slightly above it where it is irrational.
pub(super) fn upper<E: Entry>(x: &E) -> Rational {
    x.enclosure(96).hi
}

impl Radial for Rational {
    const PRODUCT: u64 = 12;

    fn largest(product: &Matrix) -> Option<Root> {
        foremost(modulus_classes(product).first()?)
    }

    fn char_poly(m: &Matrix) -> Vec<Self> {
        crate::linalg::char_poly(m).coeffs().to_vec()
    }

    fn squarefree(p: &[Self]) -> Option<Vec<Self>> {
        let p = Poly::new(p.to_vec());
        Some(p.div_rem(&p.gcd(&p.derivative())).0.coeffs().to_vec())
    }

    fn eigenvector(product: &Matrix, value: &Root) -> Option<Eigenvector> {
        Eigenvector::of(product, value)
    }

    fn own(vector: &Eigenvector, (): &()) -> Option<Vec<Self>> {
        vector.place.rational()?;
        Some(vector.enclosure(64).into_iter().map(|x| x.lo).collect())
    }

    fn definite(m: &Matrix, strict: bool) -> bool {
        quadratic::definite(m, strict)
    }

    fn over_radius(closing: &Closing) -> Option<Over> {
        radius_field::rational(closing)
    }
}

impl Radial for Real {
    const PRODUCT: u64 = 300;

    fn largest(product: &Matrix<Self>) -> Option<Root> {
        if let Some(entries) = product.entries().iter().map(Self::rational).collect::<Option<Vec<_>>>() {
            let n = product.cols();
            return Rational::largest(&Matrix::from_fn(n, n, |i, j| entries[i * n + j].clone()));
        }
        let spectrum = Self::spectrum(product, &Self::base(product.entries()));
        let members = &spectrum.classes().first()?.members;
        foremost(&members.iter().map(|e| spectrum.value(*e).clone()).collect::<Vec<_>>())
    }

    fn char_poly(m: &Matrix<Self>) -> Vec<Self> {
        let field = Self::base(m.entries());
        m.map(Self::elem).char_poly_over(&*field).into_iter().map(|c| Self::new(&field, c)).collect()
    }

    fn squarefree(p: &[Self]) -> Option<Vec<Self>> {
        let derivative: Vec<Self> = p.iter().zip(0..).skip(1).map(|(c, k)| c.times(&Self::integer(k))).collect();
        let (mut a, mut b) = (p.to_vec(), derivative);
        while !b.is_empty() {
            let rest = divided(&a, &b)?.1;
            (a, b) = (b, rest);
        }
        Some(divided(p, &a)?.0)
    }

    fn eigenvector(product: &Matrix<Self>, value: &Root) -> Option<Eigenvector> {
        let field = Self::base(product.entries());
        if let Some(q) = value.rational() {
            let kernel = (product - &Matrix::identity(product.rows()).scale(&Self::of(&q))).kernel();
            let vector = (kernel.cols() > 0).then(|| kernel.column(0))?;
            let place = if field.is_rational() { value.clone() } else { field.generator().clone() };
            return Eigenvector::normed(vector.iter().map(Self::elem).collect(), field.poly(), place);
        }
        let spectrum = Self::spectrum(product, &field);
        (0..spectrum.factor_count()).find_map(|k| {
            let part = spectrum.part(k);
            let at = part.roots.iter().position(|r| r.same(value))?;
            let vector = part.right.first()?.vectors.first()?.clone();
            Eigenvector::normed(vector, part.over.modulus, part.places[at].clone())
        })
    }

    fn own(vector: &Eigenvector, field: &Self::Base) -> Option<Vec<Self>> {
        let here = vector.place.same(field.generator());
        let entry = |c: &Vec<Rational>| {
            let x = Elem(Poly::new(c.clone()));
            (here || x.is_rational().is_some()).then(|| Self::new(field, x))
        };
        vector.coordinates.iter().map(entry).collect()
    }

    fn definite(m: &Matrix<Self>, strict: bool) -> bool {
        let n = m.rows();
        let mut a: Vec<Vec<Self>> = (0..n).map(|i| m.row(i).to_vec()).collect();
        for k in 0..n {
            let sign = a[k][k].sign();
            if sign < 0 || (sign == 0 && (strict || a[k][k..].iter().any(|x| !x.is_zero()))) {
                return false;
            }
            if sign == 0 {
                continue;
            }
            let (top, below) = a.split_at_mut(k + 1);
            let row = &top[k];
            for (i, line) in below.iter_mut().enumerate() {
                let Some(factor) = row[k + 1 + i].over(&row[k]) else { return false };
                for (x, y) in line[k + 1..].iter_mut().zip(&row[k + 1..]) {
                    *x = x.minus(&factor.times(y));
                }
            }
        }
        true
    }

    fn over_radius(closing: &Closing<Self>) -> Option<Over> {
        radius_field::real(closing)
    }
}

/// Quotient and rest of polynomials whose leading coefficients are not 0; `None` of a division by 0.
fn divided(a: &[Real], b: &[Real]) -> Option<(Vec<Real>, Vec<Real>)> {
    let mut rest = a.to_vec();
    let mut quotient = Vec::new();
    while rest.len() >= b.len() {
        let factor = rest.last()?.over(b.last()?)?;
        let shift = rest.len() - b.len();
        rest.iter_mut().skip(shift).zip(b).for_each(|(x, y)| *x = x.minus(&factor.times(y)));
        rest.pop();
        quotient.push(factor);
    }
    while rest.last().is_some_and(Entry::is_zero) {
        rest.pop();
    }
    quotient.reverse();
    Some((quotient, rest))
}

impl Eigenvector {
    /// A vector over a field, divided by its largest coordinate at a root of the polynomial of the field.
    fn normed(vector: Vec<Elem>, modulus: &Poly, place: Root) -> Option<Self> {
        let size = |x: &Elem| {
            let (re, im) = x.enclosure(&place, 64);
            abs(&re.mid()).max(abs(&im.mid()))
        };
        let largest = vector.iter().max_by_key(|x| size(x))?.inv(modulus)?;
        let coefficients = |x: &Elem| x.mul(&largest, modulus).0.coeffs().to_vec();
        Some(Self { coordinates: vector.iter().map(coefficients).collect(), place })
    }
}
