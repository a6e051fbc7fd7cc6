//! Exact decisions about sums and products of two roots, through the polynomials that have them as roots.

use super::ball::Ball;
use super::isolate::refine;
use super::root::Root;
use crate::arith::{Integer, Interval, Rational};
use crate::poly::Poly;
use std::cmp::Ordering;

/// The power sums `p_0 .. p_count` of the roots of a monic polynomial (Newton).
fn power_sums(f: &Poly, count: usize) -> Vec<Rational> {
    let n = f.degree().unwrap_or(0);
    let mut sums = vec![Rational::from(n)];
    for k in 1..=count {
        // e_i has the sign (-1)^i in the coefficient of x^(n-i).
        let mut s = Rational::from(0);
        for i in 1..k.min(n + 1) {
            s -= f.coeffs()[n - i].clone() * &sums[k - i];
        }
        if k <= n {
            s -= Rational::from(k) * &f.coeffs()[n - k];
        }
        sums.push(s);
    }
    sums
}

/// The monic polynomial of degree `n` with the given power sums of its roots.
fn from_power_sums(sums: &[Rational], n: usize) -> Poly {
    let mut high_first = vec![Rational::from(1)];
    for k in 1..=n {
        let mut s = Rational::from(0);
        for i in 0..k {
            s -= &high_first[i] * &sums[k - i];
        }
        high_first.push(s / Rational::from(k));
    }
    high_first.reverse();
    Poly::new(high_first)
}

/// The polynomial whose roots are the products of two different roots of `f`.
pub(super) fn pair_products(f: &Poly) -> Poly {
    let n = f.degree().unwrap_or(0);
    let degree = n * n.saturating_sub(1) / 2;
    let p = power_sums(f, 2 * degree);
    let sums: Vec<Rational> = (0..=degree).map(|k| (&p[k] * &p[k] - &p[2 * k]) / Rational::from(2)).collect();
    from_power_sums(&sums, degree)
}

/// The polynomial whose roots are the sums of two different roots of `f`.
fn pair_sums(f: &Poly) -> Poly {
    let n = f.degree().unwrap_or(0);
    let degree = n * n.saturating_sub(1) / 2;
    let p = power_sums(f, degree);
    let mut binomials = vec![Rational::from(1)];
    let mut sums = Vec::with_capacity(degree + 1);
    for k in 0..=degree {
        let mut s: Rational = (0..=k).map(|m| &binomials[m] * &p[m] * &p[k - m]).sum();
        s -= (Rational::from(1) << k as i64) * &p[k];
        sums.push(s / Rational::from(2));
        let mut next = vec![Rational::from(1)];
        next.extend(binomials.windows(2).map(|w| &w[0] + &w[1]));
        next.push(Rational::from(1));
        binomials = next;
    }
    from_power_sums(&sums, degree)
}

/// The product of the different irreducible factors.
pub(super) fn squarefree_part(f: &Poly) -> Poly {
    f.div_rem(&f.gcd(&f.derivative())).0.monic()
}

/// Whether Descartes' rule shows exactly one root in the open interval (one sign variation).
pub(super) fn single_root_in(f: &Poly, range: &Interval) -> bool {
    let width = range.width();
    let mut scale = Rational::from(1);
    let mut coeffs = f.shifted(&range.lo).coeffs().to_vec();
    for c in &mut coeffs {
        *c *= &scale;
        scale *= &width;
    }
    coeffs.reverse();
    let moved = Poly::new(coeffs).shifted(&Rational::from(1));
    let signs: Vec<bool> = moved.coeffs().iter().filter(|c| **c != 0).map(|c| *c > 0).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count() == 1
}

/// The smallest interval around both, a little widened so that they are inside.
pub(super) fn open_hull(a: &Interval, b: &Interval) -> Interval {
    let (lo, hi) = ((&a.lo).min(&b.lo), (&a.hi).max(&b.hi));
    let margin = (hi - lo) / Rational::from(16) + (Rational::from(1) >> 4000i64);
    Interval::new(lo - &margin, hi + margin)
}

/// Whether two real numbers are equal, given a square-free polynomial that vanishes at both, and enclosures of them
/// that shrink as their argument grows.
pub(super) fn equal_roots(f: &Poly, enclosures: impl Fn(u64) -> (Interval, Interval)) -> bool {
    let mut bits = 64;
    loop {
        let (a, b) = enclosures(bits);
        if a.disjoint(&b) {
            return false;
        }
        if single_root_in(f, &open_hull(&a, &b)) {
            return true;
        }
        bits *= 2;
    }
}

/// Sorts isolating discs of the upper half plane by real part, then by imaginary part, exactly.
pub(super) fn sorted_by_parts(f: &Poly, coeffs: &[Integer], mut upper: Vec<Ball>) -> Vec<Ball> {
    let mut sums: Option<Poly> = None;
    let mut compare = |a: &Ball, b: &Ball| -> Ordering {
        if let Some(order) = a.cmp_re(b) {
            return order;
        }
        let at = |ball: &Ball, bits: u64| refine(coeffs, ball, ball, -(bits as i64));
        if let Some(order) = at(a, 128).cmp_re(&at(b, 128)) {
            return order;
        }
        let polynomial = sums.get_or_insert_with(|| real_part_polynomial(f));
        let double = |ball: &Ball, bits: u64| {
            let re = at(ball, bits).enclosure().0;
            &re * &Rational::from(2)
        };
        if equal_roots(polynomial, |bits| (double(a, bits), double(b, bits))) {
            return (64..).find_map(|bits| at(a, bits).cmp_im(&at(b, bits))).unwrap_or(Ordering::Equal);
        }
        (64..).find_map(|bits| at(a, bits).cmp_re(&at(b, bits))).unwrap_or(Ordering::Equal)
    };
    // Few roots are compared more than once, and the order is total, so plain insertion is enough.
    let mut sorted: Vec<Ball> = Vec::with_capacity(upper.len());
    for ball in upper.drain(..) {
        let at = sorted.partition_point(|b| compare(b, &ball) == Ordering::Less);
        sorted.insert(at, ball);
    }
    sorted
}

/// A square-free polynomial with twice every real part of a complex root among its roots.
fn real_part_polynomial(f: &Poly) -> Poly {
    let n = f.degree().unwrap_or(1);
    // Where f is symmetric about the mean c of its roots, every root with real part c pairs with its conjugate; the
    // others still need the general polynomial, which the factor x - 2c of it does not spoil.
    let general = pair_sums(f);
    if n > 2 { squarefree_part(&general) } else { general }
}

/// Whether `a / b` is a root of unity.
pub(super) fn ratio_is_root_of_unity(a: &Root, b: &Root) -> bool {
    if a.is_zero() || b.is_zero() || a.cmp_modulus(b) != Ordering::Equal {
        return false;
    }
    if a.same(b) {
        return true;
    }
    // The quotient has degree at most deg a * deg b, and a primitive m-th root of unity has degree phi(m) >= sqrt(m/2).
    let bound = 2 * (a.degree() * b.degree()).pow(2);
    let turns = turns_between(a, b);
    (1..=bound).filter(|m| near_whole(turns, *m)).any(|m| same_power(a, b, m))
}

/// The angle from `b` to `a` in full turns, with an error far below the tolerance of [`near_whole`].
#[allow(clippy::float_arithmetic)] // only excludes exponents, with a wide margin
fn turns_between(a: &Root, b: &Root) -> f64 {
    let angle = |r: &Root| {
        let (re, im) = r.to_f64();
        im.atan2(re)
    };
    (angle(a) - angle(b)) / std::f64::consts::TAU
}

#[allow(clippy::float_arithmetic, clippy::cast_precision_loss)] // as above
fn near_whole(turns: f64, m: usize) -> bool {
    let t = turns * m as f64;
    (t - t.round()).abs() < 1e-6 + 1e-13 * m as f64
}

/// Whether `a^m = b^m`, decided by the minimal polynomials of the powers and their enclosures.
fn same_power(a: &Root, b: &Root, m: usize) -> bool {
    use super::elem::{Elem, locate};
    let powered = |r: &Root| {
        let f = r.minpoly();
        let x = Elem::generator(f);
        let mut p = Elem::from_rational(&Rational::from(1));
        for _ in 0..m {
            p = p.mul(&x, f);
        }
        p
    };
    let near = |r: &Root, e: &Elem| e.enclosure(r, 64);
    let (pa, pb) = (powered(a), powered(b));
    let ((ar, ai), (br, bi)) = (near(a, &pa), near(b, &pb));
    if ar.disjoint(&br) || ai.disjoint(&bi) {
        return false;
    }
    if pa.minpoly(a.minpoly()) != pb.minpoly(b.minpoly()) {
        return false;
    }
    locate(&pa, a).same(&locate(&pb, b))
}
