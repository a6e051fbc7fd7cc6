//! The leading eigenvalue of a product, exactly, and its eigenvector.

use super::System;
use crate::algebraic::Root;
use crate::arith::{Integer, Interval, Natural, Rational, abs, sign};
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use malachite_base::num::arithmetic::traits::{CeilingRoot, CheckedRoot, Floor, FloorRoot, Pow};
use std::cmp::Ordering;

/// The growth `|root|^(1/length)` of a cyclic word: a lower bound of the joint spectral radius.
#[derive(Debug, Clone)]
pub struct Lower {
    /// The positions of the arrows of the word.
    pub path: Vec<usize>,
    /// The labels of the arrows.
    pub word: Vec<usize>,
    /// An eigenvalue of largest modulus of the product.
    pub root: Root,
    /// The length of the word.
    pub length: usize,
    /// The longest Jordan block of that modulus.
    pub block: usize,
}

impl Lower {
    /// The growth of a cyclic path; `None` where the product is nilpotent.
    #[must_use]
    pub fn of(system: &System, path: &[usize]) -> Option<Self> {
        let spectrum = Spectrum::of(&system.product(path));
        let members = &spectrum.classes.first()?.members;
        let block = members.iter().filter_map(|e| spectrum.factors[e.factor].blocks.iter().max()).max().copied();
        let rank = |root: &Root| (!root.is_real(), root.is_real() && root.sign() < 0);
        let root = members.iter().map(|e| spectrum.root(*e)).min_by_key(|r| rank(r))?.clone();
        if root.is_zero() {
            return None;
        }
        Some(Self { path: path.to_vec(), word: system.labels(path), root, length: path.len(), block: block.unwrap_or(1) })
    }

    /// The value as a rational, where it is one.
    #[must_use]
    pub fn rational(&self) -> Option<Rational> {
        let value = abs(&self.root.rational()?);
        value.checked_root(u64::try_from(self.length).ok()?)
    }

    /// An enclosure of the value of width about `2^-bits` (relative to 1).
    #[must_use]
    pub fn enclosure(&self, bits: u64) -> Interval {
        if let Some(x) = self.rational() {
            return Interval::point(x);
        }
        let modulus = modulus(&self.root, bits + 8);
        root_of(&modulus, self.length, bits + 4)
    }

    /// Compares the values of words of two systems exactly.
    #[must_use]
    pub fn compare(&self, system: &System, other: &Self, others: &System) -> Ordering {
        let (a, b) = (self.enclosure(48), other.enclosure(48));
        if a.disjoint(&b) {
            return a.lo.cmp(&b.lo);
        }
        if self.length == other.length {
            return self.root.cmp_modulus(&other.root);
        }
        let common = gcd(self.length, other.length);
        let power = |s: &System, l: &Self, times: usize| Self::of(s, &l.path.repeat(times / common));
        match (power(system, self, other.length), power(others, other, self.length)) {
            (Some(x), Some(y)) => x.root.cmp_modulus(&y.root),
            _ => Ordering::Equal,
        }
    }
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
    let floor = |v: &Rational| -> Natural { Natural::try_from((v * &power).floor()).unwrap_or_default() };
    let lo = Rational::from(floor(&x.lo).floor_root(degree)) / Rational::from(&scale);
    let hi = Rational::from((floor(&x.hi) + Natural::from(1u32)).ceiling_root(degree)) / Rational::from(&scale);
    Interval::new(lo, hi)
}

/// A real eigenvector of the product for a real leading eigenvalue, given exactly: coordinate `i` is the polynomial
/// `Σ_k coordinates[i][k] x^k` at the eigenvalue.
#[derive(Debug, Clone)]
pub struct Eigenvector {
    /// The coefficients.
    pub coordinates: Vec<Vec<Rational>>,
}

impl Eigenvector {
    /// `(p(x)/(x − μ))(A) u` for a rational `u` in the kernel of `p(A)`, `p` the minimal polynomial of `μ`.
    pub(super) fn of(product: &Matrix, root: &Root) -> Option<Self> {
        let coeffs = root.minpoly().monic().coeffs().to_vec();
        let degree = coeffs.len() - 1;
        let n = product.rows();
        let kernel = polynomial_at(&coeffs, product).kernel();
        if kernel.cols() == 0 {
            return None;
        }
        let mut powers = vec![kernel.column(0)];
        for _ in 1..degree {
            powers.push(product.apply(&powers[powers.len() - 1]));
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
        Some(Self { coordinates })
    }

    /// Enclosures of the coordinates at a real root.
    #[must_use]
    pub fn enclosure(&self, root: &Root, bits: u64) -> Vec<Interval> {
        let x = match root.rational() {
            Some(r) => Interval::point(r),
            None => root.enclosure(bits).0,
        };
        self.coordinates
            .iter()
            .map(|c| {
                c.iter().rev().fold(Interval::point(Rational::from(0)), |sum, a| &(&sum * &x) + &Interval::point(a.clone()))
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
