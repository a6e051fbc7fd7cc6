//! The leading eigenvalue of a product, exactly, and its eigenvector.

use super::System;
use super::disc::Disc;
use super::radial::Radial;
use crate::algebraic::Root;
use crate::arith::{Integer, Interval, Natural, Rational, abs, sign};
use crate::jordan::Spectral;
use crate::linalg::Matrix;
use malachite_base::num::arithmetic::traits::{CeilingRoot, CheckedRoot, Floor, FloorRoot, Lcm, Pow, UnsignedAbs};
use malachite_base::num::basic::traits::One;
use malachite_base::num::logic::traits::SignificantBits;
use std::cmp::Ordering;

/// The growth `|μ|^(1/length)` of a cyclic word, `μ` an eigenvalue of its product: a lower bound of the joint spectral radius.
#[derive(Debug, Clone)]
pub struct Lower {
    /// The positions of the arrows of the word.
    pub path: Vec<usize>,
    /// The labels of the arrows.
    pub word: Vec<usize>,
    /// The length of the word.
    pub length: usize,
    /// The eigenvalue.
    pub eigenvalue: Leading,
}

/// What is known of the eigenvalue of a word.
#[derive(Debug, Clone)]
pub enum Leading {
    /// It is this number, of largest modulus among the eigenvalues of the product.
    Exact(Root),
    /// It lies in a disc: of large matrices, for which the exact number costs too much.
    Disc(Disc),
}

/// Most work, in nanoseconds, that the exact eigenvalues of one product may cost; beyond, a disc is found.
const EXACT_WORK: u64 = 40_000_000;

impl Lower {
    /// The growth of a cyclic path; `None` where the product is nilpotent, or where it is large and no eigenvalue other than 0 was
    /// enclosed.
    #[must_use]
    pub fn of<E: Radial>(system: &System<E>, path: &[usize]) -> Option<Self> {
        let product = system.product(path);
        let eigenvalue = if exact_work(&product) > EXACT_WORK {
            Leading::Disc(Disc::leading(&product)?)
        } else {
            Leading::Exact(E::largest(&product)?)
        };
        Some(Self { path: path.to_vec(), word: system.labels(path), length: path.len(), eigenvalue })
    }

    /// The eigenvalue as an exact number, where it was found.
    #[must_use]
    pub fn root(&self) -> Option<&Root> {
        match &self.eigenvalue {
            Leading::Exact(root) => Some(root),
            Leading::Disc(_) => None,
        }
    }

    /// The value as a rational, where it is one and known exactly.
    #[must_use]
    pub fn rational(&self) -> Option<Rational> {
        self.square()?.checked_root(2u64)
    }

    /// The square of the value, where it is rational and simply found (rational or quadratic eigenvalues).
    #[must_use]
    pub fn square(&self) -> Option<Rational> {
        let degree = u64::try_from(self.length).ok()?;
        let root = self.root()?;
        if let Some(r) = root.rational() {
            return (&r * &r).checked_root(degree);
        }
        let coeffs = root.minpoly().monic().coeffs().to_vec();
        // The roots of x² + bx + c have modulus √c when they are conjugate or opposite.
        if coeffs.len() != 3 || (root.is_real() && coeffs[1] != 0) {
            return None;
        }
        abs(&coeffs[0]).checked_root(degree)
    }

    /// An enclosure of the value of width about `2^-bits` (relative to 1); of a disc, as narrow as the disc.
    #[must_use]
    pub fn enclosure(&self, bits: u64) -> Interval {
        if let Some(x) = self.rational() {
            return Interval::point(x);
        }
        let modulus = match &self.eigenvalue {
            Leading::Exact(root) => modulus(root, bits + 8),
            Leading::Disc(disc) => disc.modulus(bits + 8),
        };
        root_of(&modulus, self.length, bits + 4)
    }

    /// Whether the value is proved to be at least this nonnegative number.
    #[must_use]
    pub fn is_at_least(&self, least: &Rational) -> bool {
        let power = (0..self.length).fold(Rational::from(1), |p, _| p * least);
        match &self.eigenvalue {
            Leading::Exact(root) => root.cmp_modulus_rational(&power) != Ordering::Less,
            Leading::Disc(disc) => disc.modulus(64).lo >= power,
        }
    }

    /// Compares the values of words of two systems; `None` where it would cost too much to decide whether they are equal.
    #[must_use]
    pub fn compare<E: Radial>(&self, system: &System<E>, other: &Self, others: &System<E>) -> Option<Ordering> {
        let (a, b) = (self.enclosure(48), other.enclosure(48));
        if a.disjoint(&b) {
            return Some(a.lo.cmp(&b.lo));
        }
        let (x, y) = (self.root()?, other.root()?);
        if self.length == other.length {
            return Some(x.cmp_modulus(y));
        }
        let (a, b) = (self.enclosure(200), other.enclosure(200));
        if a.disjoint(&b) {
            return Some(a.lo.cmp(&b.lo));
        }
        let common = gcd(self.length, other.length);
        let power = |s: &System<E>, l: &Self, times: usize| {
            let product = s.product(&l.path.repeat(times / common));
            if exact_work(&product) > EXACT_WORK { None } else { E::largest(&product) }
        };
        Some(power(system, self, other.length)?.cmp_modulus(&power(others, other, self.length)?))
    }
}

/// One of the eigenvalues of largest modulus, a positive one before others; `None` where it is 0.
pub(super) fn foremost(class: &[Root]) -> Option<Root> {
    let rank = |root: &&Root| (!root.is_real(), root.is_real() && root.sign() < 0);
    class.iter().min_by_key(rank).filter(|r| !r.is_zero()).cloned()
}

/// The longest Jordan block at the largest modulus of a product; `None` where it costs too much.
pub(super) fn longest_block<E: Radial>(product: &Matrix<E>) -> Option<usize> {
    if exact_work(product) > EXACT_WORK {
        return None;
    }
    let spectrum = E::spectrum(product, &E::base(product.entries()));
    let members = &spectrum.classes().first()?.members;
    members
        .iter()
        .map(|e| spectrum.part(e.factor).blocks.iter().max().copied())
        .collect::<Option<Vec<_>>>()?
        .into_iter()
        .max()
}

/// About the work of isolating the eigenvalues of a product, in nanoseconds: polynomials of degree `n` with `n b` bits.
fn exact_work<E: Radial>(product: &Matrix<E>) -> u64 {
    let base = E::base(product.entries());
    let n = (product.rows() * E::degree(&base)) as u64;
    let size = |x: &Rational| x.numerator_ref().significant_bits() + x.denominator_ref().significant_bits();
    let longest = |x: &E| x.elem().0.coeffs().iter().map(size).max();
    let bits = product.entries().iter().filter_map(longest).max().map_or(8, |b| b + 8);
    n.saturating_pow(4).saturating_mul(bits)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// An enclosure of `|root|`.
pub(super) fn modulus(root: &Root, bits: u64) -> Interval {
    let (re, im) = root.enclosure(bits);
    if root.is_real() {
        let (lo, hi) = (abs(&re.lo), abs(&re.hi));
        return if re.contains_zero() { Interval::new(Rational::from(0), lo.max(hi)) } else { Interval::new(lo, hi) };
    }
    root_of(&(&re.square() + &im.square()), 2, bits)
}

/// An enclosure of the positive `degree`-th root of a nonnegative interval, with end points of `bits` binary places.
pub(super) fn root_of(x: &Interval, degree: usize, bits: u64) -> Interval {
    if degree == 1 {
        return x.clone();
    }
    let degree = degree as u64;
    let scale = Integer::from(1) << bits;
    let power = Rational::from((&scale).pow(degree));
    let floor = |v: &Rational| if *v <= 0 { Natural::from(0u32) } else { (v * &power).floor().unsigned_abs() };
    let lo = Rational::from(floor(&x.lo).floor_root(degree)) / Rational::from(&scale);
    let hi = Rational::from((floor(&x.hi) + Natural::from(1u32)).ceiling_root(degree)) / Rational::from(&scale);
    Interval::new(lo, hi)
}

/// An enclosure of the square root of a nonnegative rational, with end points of `bits` binary places.
#[must_use]
pub fn square_root(x: &Rational, bits: u64) -> Interval {
    root_of(&Interval::point(x.clone()), 2, bits)
}

/// A rational not above the `degree`-th root of a nonnegative rational, and closer than about `2^-bits`.
#[must_use]
pub fn root_floor(x: &Rational, degree: usize, bits: u64) -> Rational {
    root_of(&Interval::point(x.clone()), degree, bits).lo
}

/// An eigenvector of the product for a leading eigenvalue, given exactly: coordinate `i` is the polynomial
/// `Σ_k coordinates[i][k] x^k` at a number whose field holds the eigenvalue and the entries.
#[derive(Debug, Clone)]
pub struct Eigenvector {
    /// The number; the eigenvalue itself where the entries are rational.
    pub place: Root,
    /// The coefficients.
    pub coordinates: Vec<Vec<Rational>>,
}

impl Eigenvector {
    /// `(p(x)/(x − μ))(A) u` for a rational `u` in the kernel of `p(A)`, `p` the minimal polynomial of `μ`.
    pub(super) fn of(product: &Matrix, root: &Root) -> Option<Self> {
        let coeffs = root.minpoly().monic().coeffs().to_vec();
        let degree = coeffs.len() - 1;
        let n = product.rows();
        // Of an irreducible characteristic polynomial every vector is in the kernel.
        let start = if degree == n {
            (0..n).map(|i| Rational::from(u8::from(i == 0))).collect()
        } else {
            let kernel = polynomial_at(&coeffs, product).kernel();
            if kernel.cols() == 0 {
                return None;
            }
            kernel.column(0)
        };
        // Whole numbers until the end.
        let entries = (0..n).flat_map(|i| product.row(i)).chain(&start);
        let unit = Rational::from(entries.fold(Natural::ONE, |d, x| d.lcm(x.denominator_ref())));
        let whole = product.scale(&unit);
        let mut powers: Vec<Vec<Rational>> = vec![start.iter().map(|x| x * &unit).collect()];
        for _ in 1..degree {
            powers.push(whole.apply(&powers[powers.len() - 1]));
        }
        let mut scale = unit.clone();
        for power in &mut powers {
            power.iter_mut().for_each(|x| *x /= &scale);
            scale *= &unit;
        }
        // p(x)/(x − μ) = Σ_k b_k x^k with b_k = Σ_{j>k} p_j μ^{j−k−1}.
        let mut coordinates = vec![vec![Rational::from(0); degree]; n];
        for (k, power) in powers.iter().enumerate() {
            for (j, c) in coeffs.iter().enumerate().skip(k + 1) {
                for (i, x) in power.iter().enumerate() {
                    coordinates[i][j - k - 1] += c * x;
                }
            }
        }
        Some(Self { place: root.clone(), coordinates })
    }

    /// Enclosures of the coordinates of a real vector.
    #[must_use]
    pub fn enclosure(&self, bits: u64) -> Vec<Interval> {
        let x = match self.place.rational() {
            Some(r) => Interval::point(r),
            None => self.place.enclosure(bits).0,
        };
        self.coordinates
            .iter()
            .map(|c| {
                c.iter()
                    .rev()
                    .fold(Interval::point(Rational::from(0)), |sum, a| &(&sum * &x) + &Interval::point(a.clone()))
            })
            .collect()
    }

    pub(super) fn scale(&mut self, factor: &Rational) {
        self.coordinates.iter_mut().flatten().for_each(|c| *c *= factor);
    }
}

pub(super) fn polynomial_at(coeffs: &[Rational], m: &Matrix) -> Matrix {
    let n = m.rows();
    let mut value = Matrix::zero(n, n);
    for c in coeffs.iter().rev() {
        value = &value * m;
        for i in 0..n {
            value[(i, i)] += c;
        }
    }
    value
}

/// `-1` or `1`: the sign of a real root that is not 0.
pub(super) fn real_sign(root: &Root) -> i32 {
    root.rational().map_or_else(|| root.sign(), |r| sign(&r))
}
