//! The exact spectrum of a matrix over a real number field `K = Q(α)`.
//!
//! `A` acts on `K^n`, a space of dimension `n d` over the rationals, as the matrix `B`. Where `α` acts as a number `α(θ)`
//! on the kernel of `B + sα - θ`, for a root `θ` of an irreducible factor of the characteristic polynomial of
//! `B + sα`, that kernel belongs to one embedding of `K` only: then `Q(θ) = K(λ)` with `λ = θ - sα(θ)`, the blocks of
//! `θ` are those of `λ`, and the map `K -> Q(θ)` takes chains of `B + sα` to chains of `A`. All but finitely many
//! integers `s` do this for every eigenvalue at once.
//!
//! Why that is a proof: the chains of `B + sα` satisfy their equations exactly, and `α` commutes with it. Where `θ` has one
//! block, its eigenvectors are one line, which `α` maps to itself; where it has several, `α v = α(θ) v` is checked for
//! each. On the whole generalised eigenspace `α`, which is semisimple, is then the same number, because each of its
//! eigenspaces there has an eigenvector of `B + sα`. In the end the chains are held against `A` itself modulo primes,
//! which would show a mistake of the program.

mod modular;
mod part;

use super::{Chain, Eigenvalue, Factor, ModulusClass, Spectrum, classes, estimated_work};
use crate::algebraic::field::{FieldMatrix, NumberField};
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use part::Placed;

/// What belongs to one irreducible factor, over the field, of the characteristic polynomial.
#[derive(Debug, Clone)]
pub struct FieldFactor {
    /// The factor: monic, irreducible over the field, coefficients in the field, the constant one first.
    pub poly: Vec<Elem>,
    /// The minimal polynomial over the rationals of its roots.
    pub minpoly: Poly,
    /// Its exponent in the characteristic polynomial.
    pub multiplicity: usize,
    /// The sizes of the Jordan blocks of each root, descending.
    pub blocks: Vec<usize>,
    /// The minimal polynomial of a generator `θ` of the field `K(λ)` of one root; the chains have entries in it.
    pub generator: Poly,
    /// The generator `α` of the field of the matrix, as a polynomial in `θ`.
    pub alpha: Elem,
    /// The root `λ`, as a polynomial in `θ`.
    pub lambda: Elem,
    /// The roots, in the canonical order of the roots of [`FieldFactor::minpoly`].
    pub roots: Vec<Root>,
    /// The value of `θ` that belongs to each root and the given `α`.
    pub generators: Vec<Root>,
    /// The right chains, one for each block.
    pub right: Vec<Chain>,
    /// The left chains, one for each block.
    pub left: Vec<Chain>,
}

/// The exact spectrum of a square matrix over a real number field.
#[derive(Debug, Clone)]
pub struct FieldSpectrum {
    /// The smallest field of the entries.
    pub field: NumberField,
    /// The size of the matrix.
    pub size: usize,
    /// The irreducible factors of the characteristic polynomial over the field, ordered by the minimal polynomials of
    /// their roots, then by the first root.
    pub factors: Vec<FieldFactor>,
    /// The eigenvalues by absolute value, descending; exact ties share a class.
    pub classes: Vec<ModulusClass>,
}

impl FieldSpectrum {
    /// Computes the spectrum; for a rational matrix it is that of [`Spectrum::of`].
    ///
    /// # Panics
    /// If the matrix is not square.
    ///
    /// # Cost
    /// About that of [`Spectrum::of`] for a rational matrix of size `n d`, where `d` is the degree of the field; a
    /// rotational symmetry splits the matrix first, and parts that are rational are treated over the rationals.
    #[must_use]
    pub fn of(a: &FieldMatrix) -> Self {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        Self::over(&a.shrunk())
    }

    /// As [`FieldSpectrum::of`] over the field of the matrix, also where a smaller one holds its entries: the fields of the
    /// chains hold it.
    ///
    /// # Panics
    /// If the matrix is not square.
    ///
    /// # Cost
    /// As [`FieldSpectrum::of`] with the degree of that field.
    #[must_use]
    pub fn over(a: &FieldMatrix) -> Self {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        if let Some(rational) = a.rational().filter(|_| a.field().is_rational()) {
            return Self::from_rational(Spectrum::of(&rational));
        }
        let factors: Vec<FieldFactor> = part::all(a).into_iter().map(|p| p.finished(a.field())).collect();
        let count: usize = factors.iter().map(|f| f.roots.len() * f.multiplicity).sum();
        assert_eq!(count, a.rows(), "the multiplicities add up to the size");
        let transpose = a.transpose();
        for f in &factors {
            let holds = modular::holds(f, a, &f.right) && modular::holds(f, &transpose, &f.left);
            assert!(holds && f.blocks.iter().sum::<usize>() == f.multiplicity, "the chains satisfy their equations");
        }
        Self::assembled(a.field().clone(), a.rows(), factors)
    }

    fn assembled(field: NumberField, size: usize, factors: Vec<FieldFactor>) -> Self {
        let classes = classes::group(&factors.iter().map(|f| f.roots.as_slice()).collect::<Vec<_>>());
        Self { field, size, factors, classes }
    }

    fn from_rational(s: Spectrum) -> Self {
        let lift = |f: Factor| FieldFactor {
            poly: f.poly.coeffs().iter().map(Elem::from_rational).collect(),
            generator: f.poly.clone(),
            alpha: Elem::zero(),
            lambda: Elem::generator(&f.poly),
            generators: f.roots.clone(),
            minpoly: f.poly,
            multiplicity: f.multiplicity,
            blocks: f.blocks,
            roots: f.roots,
            right: f.right,
            left: f.left,
        };
        let factors = s.factors.into_iter().map(lift).collect();
        Self { field: NumberField::rationals(), size: s.size, factors, classes: s.classes }
    }

    /// The characteristic polynomial over the field, the constant coefficient first.
    #[must_use]
    pub fn char_poly(&self) -> Vec<Elem> {
        self.product(|f| f.multiplicity)
    }

    /// The minimal polynomial of the matrix over the field, the constant coefficient first.
    #[must_use]
    pub fn min_poly(&self) -> Vec<Elem> {
        self.product(|f| f.blocks.first().copied().unwrap_or(0))
    }

    fn product(&self, exponent: impl Fn(&FieldFactor) -> usize) -> Vec<Elem> {
        let mut product = vec![Elem::from_rational(&Rational::from(1))];
        for f in &self.factors {
            for _ in 0..exponent(f) {
                let mut next = vec![Elem::zero(); product.len() + f.poly.len() - 1];
                for (i, x) in product.iter().enumerate() {
                    for (j, y) in f.poly.iter().enumerate() {
                        next[i + j] = next[i + j].add(&self.field.mul(x, y));
                    }
                }
                product = next;
            }
        }
        product
    }

    /// The number that an eigenvalue stands for.
    ///
    /// # Panics
    /// If it is not one of this spectrum.
    #[must_use]
    pub fn root(&self, eigenvalue: Eigenvalue) -> &Root {
        &self.factors[eigenvalue.factor].roots[eigenvalue.root]
    }

    /// The factor of an eigenvalue.
    ///
    /// # Panics
    /// If it is not one of this spectrum.
    #[must_use]
    pub fn factor(&self, eigenvalue: Eigenvalue) -> &FieldFactor {
        &self.factors[eigenvalue.factor]
    }
}

impl FieldFactor {
    /// The degree over the field of the matrix.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.roots.len()
    }

    /// Whether the generator of the chains is the generator of the field of the matrix.
    #[must_use]
    pub fn in_field(&self) -> bool {
        self.degree() == 1
    }

    /// Whether the chains satisfy `(A - λ) v[0] = 0` and `(A - λ) v[j+1] = v[j]`, exactly.
    #[must_use]
    pub fn holds(&self, a: &FieldMatrix, chains: &[Chain]) -> bool {
        let m = &self.generator;
        let powers = part::powers(&self.alpha, a.field().degree(), m);
        let image = |x: &Elem| part::substituted(x, &powers);
        let entries: Vec<Elem> = a.entries().iter().map(image).collect();
        let n = a.cols();
        let row_holds = |i: usize, v: &[Elem], before: Option<&Vec<Elem>>| {
            let mut sum = Poly::zero();
            for (x, y) in entries[i * n..(i + 1) * n].iter().zip(v).filter(|(x, y)| !x.is_zero() && !y.is_zero()) {
                sum = &sum + &(&x.0 * &y.0);
            }
            sum = &sum - &(&self.lambda.0 * &v[i].0);
            let left = Elem::reduced(&sum, m);
            before.map_or_else(|| left.is_zero(), |b| left == b[i])
        };
        chains.iter().all(|chain| {
            chain.vectors.iter().enumerate().all(|(j, v)| {
                let before = j.checked_sub(1).map(|k| &chain.vectors[k]);
                (0..a.rows()).all(|i| row_holds(i, v, before))
            }) && chain.vectors.first().is_some_and(|v| v.iter().any(|x| !x.is_zero()))
        })
    }
}

/// A rough estimate of the work of [`FieldSpectrum::of`], as [`estimated_work`] gives for rational matrices.
#[must_use]
pub fn estimated_field_work(a: &FieldMatrix) -> u64 {
    let a = a.shrunk();
    match a.rational() {
        Some(rational) => estimated_work(&rational),
        None if a.rows() * a.field().degree() > 800 => u64::MAX,
        None => {
            let restricted: Matrix = a.restricted();
            estimated_work(&restricted).saturating_mul(4)
        }
    }
}

impl Placed {
    fn finished(self, field: &NumberField) -> FieldFactor {
        let poly = self.factor_over(field);
        let Self { extension, minpoly, multiplicity, blocks, roots, generators, right, left } = self;
        FieldFactor {
            poly,
            minpoly,
            multiplicity,
            blocks,
            generator: extension.poly,
            alpha: extension.alpha,
            lambda: extension.lambda,
            roots,
            generators,
            right,
            left,
        }
    }
}

#[cfg(test)]
mod tests;
