//! The exact spectrum of a rational matrix: eigenvalues, multiplicities, Jordan block sizes, chains of generalised
//! eigenvectors on both sides, and the classes of eigenvalues of equal modulus.

mod chains;
mod classes;
mod generators;

use crate::algebraic::{Elem, Root, roots};
use crate::linalg::{Matrix, char_poly_blocks};
use crate::poly::{IntPoly, Poly, factor, ints};
use std::collections::BTreeMap;

pub use crate::linalg::char_poly;

/// A chain of generalised eigenvectors of one Jordan block, for every root `θ` of a factor at once: entries are
/// elements of `Q[x] / (factor)`.
///
/// Right chains satisfy `(A - θ) v[0] = 0` and `(A - θ) v[j+1] = v[j]`, left chains the same for the transpose.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain {
    /// The vectors, the eigenvector first.
    pub vectors: Vec<Vec<Elem>>,
}

/// What belongs to one irreducible factor of the characteristic polynomial.
#[derive(Debug, Clone)]
pub struct Factor {
    /// The factor, monic irreducible.
    pub poly: Poly,
    /// Its exponent in the characteristic polynomial: the algebraic multiplicity of each of its roots.
    pub multiplicity: usize,
    /// The sizes of the Jordan blocks of each root, descending.
    pub blocks: Vec<usize>,
    /// The roots, in canonical order.
    pub roots: Vec<Root>,
    /// The right chains, one for each block.
    pub right: Vec<Chain>,
    /// The left chains, one for each block.
    pub left: Vec<Chain>,
}

/// An eigenvalue: a root of a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Eigenvalue {
    /// The position of the factor in [`Spectrum::factors`].
    pub factor: usize,
    /// The position of the root in [`Factor::roots`].
    pub root: usize,
}

/// The different eigenvalues of one absolute value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModulusClass {
    /// The eigenvalues, by factor and root.
    pub members: Vec<Eigenvalue>,
}

/// The exact spectrum of a square rational matrix.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// The size of the matrix.
    pub size: usize,
    /// The characteristic polynomial.
    pub char_poly: Poly,
    /// Its irreducible factors, by degree, then by coefficients.
    pub factors: Vec<Factor>,
    /// The eigenvalues by absolute value, descending; exact ties share a class.
    pub classes: Vec<ModulusClass>,
}

impl Spectrum {
    /// Computes the spectrum.
    ///
    /// The chains prove themselves: each satisfies its equations exactly, the eigenvectors are independent (shown
    /// modulo a prime), and the sizes add up to the exponents in the characteristic polynomial.
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn of(a: &Matrix) -> Self {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        let blocks = char_poly_blocks(a);
        let transpose = a.transpose();
        let factors: Vec<Factor> =
            factor_blocks(&blocks).into_iter().map(|(poly, m)| Factor::of(a, &transpose, poly, m)).collect();
        let product = blocks.iter().fold(vec![1.into()], |acc: IntPoly, f| ints::mul(&acc, f));
        let classes = classes::modulus_classes(&factors);
        Self { size: a.rows(), char_poly: Poly::from_ints(&product).monic(), factors, classes }
    }

    /// The minimal polynomial, monic.
    #[must_use]
    pub fn min_poly(&self) -> Poly {
        let one = Poly::new(vec![1.into()]);
        self.factors.iter().fold(one, |acc, f| &acc * &f.poly.pow(f.blocks.first().copied().unwrap_or(0)))
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
    pub fn factor(&self, eigenvalue: Eigenvalue) -> &Factor {
        &self.factors[eigenvalue.factor]
    }

    /// All different eigenvalues, by descending modulus, then by factor and root.
    pub fn eigenvalues(&self) -> impl Iterator<Item = Eigenvalue> {
        self.classes.iter().flat_map(|c| c.members.iter().copied())
    }

    /// The class that an eigenvalue belongs to.
    #[must_use]
    pub fn class_of(&self, eigenvalue: Eigenvalue) -> Option<usize> {
        self.classes.iter().position(|c| c.members.contains(&eigenvalue))
    }
}

impl Factor {
    fn of(a: &Matrix, transpose: &Matrix, poly: Poly, multiplicity: usize) -> Self {
        let (blocks, right) = chains::chains(a, &poly, multiplicity);
        let (left_blocks, left) = chains::chains(transpose, &poly, multiplicity);
        debug_assert_eq!(blocks, left_blocks);
        let roots = roots(&poly);
        Self { poly, multiplicity, blocks, roots, right, left }
    }

    /// The degree of the factor.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.roots.len()
    }
}

/// The irreducible factors of a product, with the exponents of equal ones added.
fn factor_blocks(blocks: &[IntPoly]) -> Vec<(Poly, usize)> {
    let mut distinct: BTreeMap<&IntPoly, usize> = BTreeMap::new();
    for block in blocks {
        *distinct.entry(block).or_default() += 1;
    }
    let mut found: BTreeMap<Poly, usize> = BTreeMap::new();
    for (block, count) in distinct {
        for (poly, exponent) in factor(&Poly::from_ints(block)) {
            *found.entry(poly).or_default() += exponent * count;
        }
    }
    found.into_iter().collect()
}
