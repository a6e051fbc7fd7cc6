//! The exact spectrum of a rational matrix: eigenvalues, multiplicities, Jordan block sizes, chains of generalised
//! eigenvectors on both sides, and the classes of eigenvalues of equal modulus.

mod chains;
mod classes;
mod echelon;
mod field;
mod generators;
mod operator;
mod scalar;
mod summand;
mod symmetry;

use crate::algebraic::{Elem, Root, roots};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use malachite_base::num::logic::traits::SignificantBits;

pub use crate::linalg::char_poly;
pub use field::{FieldFactor, FieldSpectrum, estimated_field_work};
pub use scalar::{Over, Part, Scalar, Spectral};

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
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, jordan::Spectrum, linalg::Matrix};
    /// // A block of size 2 for 1/2, and −1/2 beside it: one class of equal modulus.
    /// let a = Matrix::from_fn(3, 3, |i, j| ratio([[1, 2, 0], [0, 1, 0], [0, 0, -1]][i][j], 2));
    /// let spectrum = Spectrum::of(&a);
    /// assert_eq!(spectrum.classes.len(), 1);
    /// let blocks: Vec<_> = spectrum.factors.iter().map(|f| f.blocks.clone()).collect();
    /// assert!(blocks.contains(&vec![2]) && blocks.contains(&vec![1]));
    /// ```
    #[must_use]
    pub fn of(a: &Matrix) -> Self {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        Self::from_summands(a.rows(), &summand::split(a))
    }

    /// The same as [`Spectrum::of`], with a declared symmetry: a permutation of the indices with
    /// `A[p[i]][p[j]] = A[i][j]`, all of whose cycles have length 1 or one common length. The blocks of the Fourier
    /// transform are then treated one by one. `None` when the matrix does not have the symmetry.
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn with_symmetry(a: &Matrix, permutation: &[usize]) -> Option<Self> {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        let symmetry = symmetry::Symmetry::declared(a, permutation)?;
        Some(Self::from_summands(a.rows(), &symmetry.split(a)))
    }

    /// The same as [`Spectrum::of`], without any search for a symmetry; slower, for comparison.
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn without_symmetry(a: &Matrix) -> Self {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        Self::from_summands(a.rows(), &[summand::Summand::whole(a)])
    }

    fn from_summands(size: usize, summands: &[summand::Summand]) -> Self {
        let parts = summand::decompose(summands);
        let char_poly = summand::product(&parts);
        let found = crate::parallel::map(&parts, size >= PARALLEL, |part| roots(&part.poly));
        let factors: Vec<Factor> = parts.into_iter().zip(found).map(|(part, roots)| part.with_roots(roots)).collect();
        let classes = classes::modulus_classes(&factors);
        Self { size, char_poly, factors, classes }
    }

    /// The minimal polynomial, monic.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, jordan::Spectrum, linalg::Matrix};
    /// let a = Matrix::identity(3).scale(&ratio(2, 1));
    /// assert_eq!(Spectrum::of(&a).min_poly().display("x"), "x - 2");
    /// ```
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
    /// The degree of the factor.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.roots.len()
    }
}

/// Smaller matrices are not worth a second thread.
const PARALLEL: usize = 24;

/// The work of an exact spectrum that is taken on without asking, in rough units of a nanosecond.
pub const BUDGET: u64 = 120_000_000_000;

/// A rough estimate of the work of [`Spectrum::of`], in nanoseconds of one processor: what the modular characteristic
/// polynomial, its reconstruction and the chains of a matrix without any structure cost. Structure makes it cheaper.
///
/// A matrix over [`BUDGET`] is one for an approximation in floating point.
#[must_use]
pub fn estimated_work(a: &Matrix) -> u64 {
    let n = a.rows() as u64;
    let size = |x: &Rational| x.numerator_ref().significant_bits() + x.denominator_ref().significant_bits();
    let row_bits = |i: usize| a.row(i).iter().map(size).max().unwrap_or(0) + 8;
    let bits: u64 = (0..a.rows()).map(row_bits).sum();
    let limbs: u64 = (0..a.rows()).flat_map(|i| a.row(i)).map(|x| size(x) / 64 + 1).sum();
    let primes = bits / 61 + 1;
    let cube = n.saturating_pow(3);
    let modular = primes.saturating_mul(cube.saturating_mul(3).saturating_add(limbs.saturating_mul(4)));
    let reconstruction = primes.saturating_mul(primes).saturating_mul(n);
    modular.saturating_add(reconstruction).saturating_add(cube.saturating_mul(primes).saturating_mul(4))
}

/// Only the classes of eigenvalues of equal modulus, descending, as lists of roots: no chains are computed.
///
/// # Panics
/// If the matrix is not square.
///
/// # Examples
/// ```
/// use secant_exact::{arith::ratio, jordan::modulus_classes, linalg::Matrix};
/// let turn = Matrix::from_fn(2, 2, |i, j| ratio([[0, -1], [1, 0]][i][j], 1));
/// assert_eq!(modulus_classes(&turn)[0].len(), 2);
/// ```
#[must_use]
pub fn modulus_classes(a: &Matrix) -> Vec<Vec<Root>> {
    assert_eq!(a.rows(), a.cols(), "square matrix");
    let factors = root_lists(&summand::all_factors(&summand::split(a)));
    let resolve = |e: &Eigenvalue| factors[e.factor].1[e.root].clone();
    classes_of(&factors).iter().map(|c| c.members.iter().map(resolve).collect()).collect()
}

/// The eigenvalues of largest modulus, each with its multiplicity: no chains are computed. None where the matrix has no rows.
///
/// # Panics
/// If the matrix is not square.
///
/// ```
/// use secant_exact::{arith::ratio, jordan::leading_roots, linalg::Matrix};
///
/// let a = Matrix::from_fn(3, 3, |i, j| ratio(if i == j { [2, -2, 1][i] } else { i64::from(i < j) }, 1));
/// let found = leading_roots(&a);
/// assert_eq!(found.iter().map(|(_, multiplicity)| *multiplicity).collect::<Vec<_>>(), [1, 1]);
/// ```
#[must_use]
pub fn leading_roots(a: &Matrix) -> Vec<(Root, usize)> {
    assert_eq!(a.rows(), a.cols(), "square matrix");
    let factors = root_lists(&summand::all_factors(&summand::split(a)));
    let resolve = |e: &Eigenvalue| (factors[e.factor].1[e.root].clone(), factors[e.factor].0.1);
    classes_of(&factors).first().map_or_else(Vec::new, |c| c.members.iter().map(resolve).collect())
}

/// The factors that have an eigenvalue of largest modulus, with their chains, and these eigenvalues.
#[derive(Debug, Clone)]
pub struct Leading {
    /// The factors, in the order of those of [`Spectrum`].
    pub factors: Vec<Factor>,
    /// The eigenvalues, by position in `factors`.
    pub class: ModulusClass,
}

impl Leading {
    /// What [`Spectrum::of`] says of the eigenvalues of largest modulus; `None` where the matrix has no rows.
    ///
    /// # Panics
    /// If the matrix is not square.
    #[must_use]
    pub fn of(a: &Matrix) -> Option<Self> {
        assert_eq!(a.rows(), a.cols(), "square matrix");
        let summands = summand::split(a);
        let lists = summand::all_factors(&summands);
        let all = root_lists(&lists);
        let first = classes_of(&all).into_iter().next()?;
        let mut used: Vec<usize> = first.members.iter().map(|m| m.factor).collect();
        used.dedup();
        let wanted = |f: &Poly| used.iter().any(|k| all[*k].0.0 == *f);
        let parts = summand::decompose_some(&summands, &lists, &wanted);
        let roots = used.iter().map(|k| all[*k].1.clone());
        let factors = parts.into_iter().zip(roots).map(|(part, roots)| part.with_roots(roots)).collect();
        let place = |m: &Eigenvalue| Some(Eigenvalue { factor: used.iter().position(|k| *k == m.factor)?, ..*m });
        let members = first.members.iter().map(place).collect::<Option<_>>()?;
        Some(Self { factors, class: ModulusClass { members } })
    }
}

type Roots = ((Poly, usize), Vec<Root>);

/// The irreducible factors with their multiplicities and roots.
fn root_lists(lists: &[Vec<(Poly, usize)>]) -> Vec<Roots> {
    let with_roots = |(f, m): (Poly, usize)| {
        let found = roots(&f);
        ((f, m), found)
    };
    summand::polynomials(lists).into_iter().map(with_roots).collect()
}

fn classes_of(factors: &[Roots]) -> Vec<ModulusClass> {
    classes::group(&factors.iter().map(|(_, roots)| roots.as_slice()).collect::<Vec<_>>())
}
