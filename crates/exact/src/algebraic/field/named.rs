//! Square roots, cosines of rational angles, roots of polynomials, as [`Root`]s.

use crate::algebraic::{Root, cmp_real, roots};
use crate::arith::{Integer, Natural, Rational, sign};
use crate::poly::{Poly, factor};
use malachite_base::num::arithmetic::traits::{DivRem, Parity};
use std::cmp::Ordering;

/// Square factors of primes up to this bound are taken out of a square root.
const TRIAL: u64 = 10_000;

/// Writes a rational as `s^2 c` with an integer `c` that has no square factor of a small prime.
#[must_use]
pub fn square_part(q: &Rational) -> (Rational, Integer) {
    let denominator = q.denominator_ref();
    let mut core = q.numerator_ref() * denominator;
    let mut side = Natural::from(1u32);
    let mut p = 2u64;
    while p < TRIAL {
        let square = Natural::from(p * p);
        if square > core {
            break;
        }
        loop {
            let (quotient, rest) = (&core).div_rem(&square);
            if rest != 0 {
                break;
            }
            core = quotient;
            side *= Natural::from(p);
        }
        p += if p.even() { 1 } else { 2 };
    }
    use malachite_base::num::arithmetic::traits::CheckedSqrt;
    if let Some(root) = (&core).checked_sqrt() {
        side *= root;
        core = Natural::from(1u32);
    }
    let negative = sign(q) < 0;
    (Rational::from(side) / Rational::from(denominator), Integer::from_sign_and_abs(!negative, core))
}

/// The minimal polynomial of the numbers `2 cos(2πj/n)` with `j` prime to `n`: with `Φ_n(x) = x^m ψ(x + 1/x)`, `ψ`; for
/// `n <= 2`, `t - 2` and `t + 2`.
///
/// # Panics
/// If `n` is 0.
#[must_use]
pub fn cosine_polynomial(n: usize) -> Poly {
    assert!(n > 0, "an angle");
    if n <= 2 {
        return Poly::linear(&Rational::from(if n == 1 { 2 } else { -2 }));
    }
    // Φ(z) = z^(m) ψ(z + 1/z), with z^k + z^-k = V_k(x), V_0 = 2, V_1 = x, V_(k+1) = x V_k - V_(k-1).
    let cyclotomic = cyclotomic(n);
    let half = cyclotomic.degree().unwrap_or(2) / 2;
    let x = Poly::new(vec![0.into(), 1.into()]);
    let (mut a, mut b) = (Poly::constant(2.into()), x.clone());
    let mut sum = Poly::constant(cyclotomic.coeff(half));
    for k in 1..=half {
        sum = &sum + &b.scale(&cyclotomic.coeff(half + k));
        (a, b) = (b.clone(), &(&x * &b) - &a);
    }
    sum
}

fn cyclotomic(n: usize) -> Poly {
    let binomial = |d: usize| {
        let mut c = vec![Rational::from(0); d + 1];
        c[0] = Rational::from(-1);
        c[d] = Rational::from(1);
        Poly::new(c)
    };
    // Φ_n = product of (x^d - 1)^μ(n/d)
    let (mut top, mut bottom) = (Poly::constant(1.into()), Poly::constant(1.into()));
    for d in (1..=n).filter(|d| n.is_multiple_of(*d)) {
        match moebius(n / d) {
            1 => top = &top * &binomial(d),
            -1 => bottom = &bottom * &binomial(d),
            _ => {}
        }
    }
    top.div_rem(&bottom).0
}

fn moebius(mut n: usize) -> i32 {
    let mut value = 1;
    let mut p = 2;
    while n > 1 {
        if n.is_multiple_of(p) {
            n /= p;
            if n.is_multiple_of(p) {
                return 0;
            }
            value = -value;
        }
        p += 1;
    }
    value
}

fn coprime(mut a: usize, mut b: usize) -> bool {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}

/// Half the number of units modulo `n`: the degree of `cos(2π/n)` for `n >= 3`.
pub(super) fn cosine_degree(n: usize) -> usize {
    (1..n).filter(|j| coprime(*j, n)).count().div_ceil(2)
}

/// The number `2 cos(2πk/n)`.
///
/// # Panics
/// If `n` is 0.
///
/// # Cost
/// The isolation of `φ(n)/2` roots.
#[must_use]
pub fn cosine(k: usize, n: usize) -> Root {
    assert!(n > 0, "an angle");
    let g = (1..=n).rev().find(|g| n.is_multiple_of(*g) && k.is_multiple_of(*g)).unwrap_or(1);
    let (k, n) = ((k / g) % (n / g), n / g);
    match n {
        1 => return Root::from_rational(&2.into()),
        2 => return Root::from_rational(&Rational::from(-2)),
        _ => {}
    }
    let k = k.min(n - k);
    // The cosine falls from 0 to π, so the roots above k in this order are smaller.
    let index = (k + 1..=n / 2).filter(|j| coprime(*j, n)).count();
    roots(&cosine_polynomial(n)).swap_remove(index)
}

/// Why a polynomial and an interval do not name a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum NoRoot {
    Zero,
    Count(usize),
}

/// The different real roots of a polynomial, ascending.
pub(super) fn all_real_roots(f: &Poly) -> Vec<Root> {
    let mut all: Vec<Root> = factor(f).iter().flat_map(|(g, _)| roots(g)).filter(Root::is_real).collect();
    all.sort_by(cmp_real);
    all
}

pub(super) fn root_between(f: &Poly, lo: &Rational, hi: &Rational) -> Result<Root, NoRoot> {
    if f.is_zero() {
        return Err(NoRoot::Zero);
    }
    let (lo, hi) = (Root::from_rational(lo), Root::from_rational(hi));
    let inside = |r: &Root| cmp_real(r, &lo) != Ordering::Less && cmp_real(r, &hi) != Ordering::Greater;
    let mut found: Vec<Root> = all_real_roots(f).into_iter().filter(inside).collect();
    match found.len() {
        1 => Ok(found.remove(0)),
        count => Err(NoRoot::Count(count)),
    }
}

/// The only real root of a polynomial in the closed interval `[lo, hi]`; `None` where there is none or more than one.
///
/// # Cost
/// A factorisation and the isolation of all roots.
#[must_use]
pub fn real_root(f: &Poly, lo: &Rational, hi: &Rational) -> Option<Root> {
    root_between(f, lo, hi).ok()
}
