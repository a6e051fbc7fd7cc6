//! Exact comparison of absolute values.

use super::isolate::GUARD;
use super::relation::{equal_roots, pair_products, squarefree_part};
use super::root::{Root, roots};
use crate::arith::{Integer, Interval, Natural, Rational, abs};
use crate::poly::{IntPoly, Poly, ints};
use malachite_base::num::arithmetic::traits::{Ceiling, CeilingSqrt, CheckedRoot, Floor, FloorSqrt, Pow};
use std::cmp::Ordering;

/// For every root of a set a simpler number whose absolute value is a power of its own.
pub(super) type Bases = Vec<(Root, u64)>;

/// The range of the squared absolute value, from an enclosure of the root.
fn squared(root: &Root, bits: u64) -> Interval {
    let (re, im) = root.enclosure(bits);
    &re.square() + &im.square()
}

/// `√x` rounded down to a number of binary places.
pub fn sqrt_down(x: &Rational, bits: u64) -> Rational {
    let scaled: Integer = (x << (2 * bits)).floor();
    let root = if scaled > 0 { scaled.unsigned_abs_ref().floor_sqrt() } else { Natural::from(0u32) };
    Rational::from(root) >> bits
}

fn sqrt_up(x: &Rational, bits: u64) -> Rational {
    let scaled: Integer = (x << (2 * bits)).ceiling();
    Rational::from(scaled.unsigned_abs_ref().ceiling_sqrt()) >> bits
}

pub(super) fn enclosure(root: &Root, bits: u64) -> Interval {
    if root.is_real() {
        let x = root.enclosure(bits).0;
        return match x.sign() {
            Some(s) if s < 0 => -&x,
            Some(_) => x,
            None => Interval::new(Rational::from(0), x.magnitude()),
        };
    }
    // The modulus is a 1-Lipschitz function of the point, so a few more bits are enough.
    let square = squared(root, bits + 3);
    let re_im = bits + 3;
    let fine = Interval::new(sqrt_down(&square.lo, re_im), sqrt_up(&square.hi, re_im));
    debug_assert!(fine.width() <= Rational::from(1) >> bits);
    fine
}

/// The base of a root and the exponent `k` with `|root|^k = |base|`.
fn base(root: &Root) -> (Root, u64) {
    let bases = root.set.bases.get_or_init(|| compute_bases(root));
    bases.get(root.index).cloned().unwrap_or_else(|| (root.clone(), 1))
}

/// Powers first: `f(x) = g(x^k)`. Then circles: a root with rational squared modulus.
fn compute_bases(any: &Root) -> Bases {
    let f = any.minpoly();
    let n = any.degree();
    if n == 1 {
        return vec![(any.clone(), 1)];
    }
    let all = || (0..n).map(|index| Root { set: std::sync::Arc::clone(&any.set), index });
    let (g, k) = ints::deflate(&any.set.ints);
    if k > 1 {
        let lower = roots(&Poly::from_ints(&g));
        return all()
            .map(|root| {
                let (base, exponent) = base(&power_owner(&root, k, &lower));
                (base, exponent * k as u64)
            })
            .collect();
    }
    match circle(f) {
        Some(r) => {
            let base = Root::from_rational(&r);
            all().map(|root| if on_circle(&root, &r) { (base.clone(), 2) } else { (root, 1) }).collect()
        }
        None => all().map(|root| (root, 1)).collect(),
    }
}

/// Which of the roots of `g` is the `k`-th power of a root of `g(x^k)`.
fn power_owner(root: &Root, k: usize, lower: &[Root]) -> Root {
    if lower.len() == 1 {
        return lower[0].clone();
    }
    let mut bits = 64;
    loop {
        let (mut re, mut im) = root.enclosure(bits);
        let z = (re.clone(), im.clone());
        for _ in 1..k {
            let next = (&(&re * &z.0) - &(&im * &z.1), &(&re * &z.1) + &(&im * &z.0));
            (re, im) = (next.0.outward(2 * bits), next.1.outward(2 * bits));
        }
        let fits = |other: &&Root| {
            let (a, b) = other.enclosure(bits);
            !a.disjoint(&re) && !b.disjoint(&im)
        };
        let mut candidates = lower.iter().filter(fits);
        if let (Some(only), None) = (candidates.next(), candidates.next()) {
            return only.clone();
        }
        bits *= 2;
    }
}

/// The rational `r` such that `root -> r / root` permutes the roots of `f`, if there is one with `r > 0`.
fn circle(f: &Poly) -> Option<Rational> {
    let n = f.degree()?;
    let constant = f.coeff(0);
    let square = &constant * &constant;
    let take = |x: &Natural| x.checked_root(n as u64);
    let r = Rational::from_naturals(take(square.numerator_ref())?, take(square.denominator_ref())?);
    let mut power = Rational::from(1);
    for k in 0..=n {
        if &f.coeffs()[k] * &power != &constant * &f.coeffs()[n - k] {
            return None;
        }
        power *= &r;
    }
    Some(r)
}

/// Whether `|root|^2 = r`, for an `r` from [`circle`]: that is, whether `r / root` is the conjugate.
fn on_circle(root: &Root, r: &Rational) -> bool {
    let mut bits = 64;
    loop {
        let square = squared(root, bits);
        if square.lo > *r || square.hi < *r {
            return false;
        }
        // |r / z - conj z| = |r - |z|^2| / |z|; inside the guard disc there is no root but the conjugate.
        let gap = Interval::new(&square.lo - r, &square.hi - r).magnitude();
        let modulus = enclosure(root, bits).lo;
        if modulus > 0 {
            let disc = root.set.isolating(root.index);
            let reach = gap / modulus + (Rational::from(1) >> bits) * Rational::from(2);
            let guard = super::ball::dyadic(&disc.radius, disc.exp) * Rational::from(GUARD - 1);
            if reach < guard {
                return true;
            }
        }
        bits *= 2;
    }
}

fn cmp_rational_powers(a: &Rational, k: u64, b: &Rational, l: u64) -> Ordering {
    // |x|^k = |a| and |y|^l = |b|: compare |a|^l with |b|^k.
    abs(a).pow(l).cmp(&abs(b).pow(k))
}

/// The order of two intervals, when they show it.
fn order(a: &Interval, b: &Interval) -> Option<Ordering> {
    if a.hi < b.lo {
        Some(Ordering::Less)
    } else if b.hi < a.lo {
        Some(Ordering::Greater)
    } else {
        None
    }
}

pub(super) fn compare(x: &Root, y: &Root) -> Ordering {
    if x.is_zero() || y.is_zero() {
        return y.is_zero().cmp(&x.is_zero());
    }
    if let (Some(a), Some(b)) = (x.rational(), y.rational()) {
        return abs(&a).cmp(&abs(&b));
    }
    if x.set.poly == y.set.poly && (x.index == y.index || x.conjugate().index == y.index) {
        return Ordering::Equal;
    }
    if std::sync::Arc::ptr_eq(&x.set, &y.set) {
        // Roots of g(x^k) over one root of g.
        let ((a, k), (b, l)) = (base(x), base(y));
        if k == l && k > 1 && (a.same(&b) || a.conjugate().same(&b)) {
            return Ordering::Equal;
        }
    }
    let numeric = |bits: u64| order(&enclosure(x, bits), &enclosure(y, bits));
    let start = 64 + bits_above(x).max(bits_above(y));
    if let Some(found) = [start, 2 * start].into_iter().find_map(numeric) {
        return found;
    }
    if equal_modulus(x, y) {
        return Ordering::Equal;
    }
    (2..).find_map(|k| numeric(start << k)).unwrap_or(Ordering::Equal)
}

/// The number of bits that small numbers, or small distances from a centre, need before their first digit.
fn bits_above(x: &Root) -> u64 {
    x.set.log_size(x.index).min(0).unsigned_abs()
}

/// Decides `|x| = |y|` by algebra.
fn equal_modulus(x: &Root, y: &Root) -> bool {
    let ((a, k), (b, l)) = (base(x), base(y));
    if let (Some(p), Some(q)) = (a.rational(), b.rational()) {
        return cmp_rational_powers(&p, k, &q, l) == Ordering::Equal;
    }
    if k == l {
        if a.same(&b) || a.conjugate().same(&b) || opposite(&a, &b) {
            return true;
        }
        let (f, g) = (norm_polynomial(&a), norm_polynomial(&b));
        return same_norm(&f, &g, |bits| (squared(&a, bits), squared(&b, bits)));
    }
    // |x|^(k l) both ways: the squared norms of the bases to the powers l and k.
    let raised = |r: &Root, e: u64, bits: u64| {
        let s = squared(r, bits);
        Interval::new(s.lo.pow(e), s.hi.pow(e))
    };
    let (f, g) = (power_polynomial(&norm_polynomial(&a), l), power_polynomial(&norm_polynomial(&b), k));
    same_norm(&f, &g, |bits| (raised(&a, l, bits), raised(&b, k, bits)))
}

/// Equality of a root of `f` and a root of `g`, both real.
fn same_norm(f: &[Integer], g: &[Integer], enclosures: impl Fn(u64) -> (Interval, Interval)) -> bool {
    // Both numbers are roots of both polynomials where they are equal.
    let common = if f == g { f.to_vec() } else { ints::gcd(f, g) };
    if common.len() == 1 {
        return false;
    }
    if f == g {
        return equal_roots(f, enclosures);
    }
    // Both polynomials are square-free, so that their least common multiple is.
    let all = ints::mul(&ints::div_exact(f, &common).expect("a common divisor divides"), g);
    equal_roots(&all, enclosures)
}

/// Whether `b = -a` or `b = -conj a`, through `g(x) = ± f(-x)`.
fn opposite(a: &Root, b: &Root) -> bool {
    let (f, g) = (a.minpoly(), b.minpoly());
    if f.degree() != g.degree() || mirrored(f) != *g {
        return false;
    }
    let minus = |r: &Root| {
        (1..).find_map(|k| {
            let (re, im) = r.enclosure(64 * k);
            let (re, im) = (-&re, -&im);
            let mut hits = roots_of(b).filter(|s| {
                let (c, d) = s.enclosure(64 * k);
                !c.disjoint(&re) && !d.disjoint(&im)
            });
            match (hits.next(), hits.next()) {
                (Some(only), None) => Some(only.index),
                _ => None,
            }
        })
    };
    minus(a) == Some(b.index) || minus(&a.conjugate()) == Some(b.index)
}

fn roots_of(root: &Root) -> impl Iterator<Item = Root> {
    (0..root.degree()).map(|index| Root { set: std::sync::Arc::clone(&root.set), index })
}

/// The monic polynomial of the negated roots.
fn mirrored(f: &Poly) -> Poly {
    Poly::new(f.coeffs().iter().enumerate().map(|(k, c)| if k % 2 == 1 { -c } else { c.clone() }).collect()).monic()
}

/// A square-free polynomial that vanishes at the squared absolute value of the root.
fn norm_polynomial(root: &Root) -> IntPoly {
    if let Some(q) = root.rational() {
        return Poly::linear(&(&q * &q)).primitive();
    }
    let f = root.minpoly();
    if root.is_real() {
        let product = f * &mirrored(f);
        let squares: Vec<Rational> = product.coeffs().iter().step_by(2).cloned().collect();
        return squarefree_part(&Poly::new(squares).primitive());
    }
    squarefree_part(&pair_products(&root.set.ints))
}

/// A square-free polynomial that vanishes at the `e`-th powers of the roots of `f`.
fn power_polynomial(f: &[Integer], e: u64) -> IntPoly {
    if e == 1 {
        return f.to_vec();
    }
    let (n, f) = (f.len() - 1, Poly::from_ints(f).monic());
    let companion = crate::linalg::Matrix::from_fn(n, n, |i, j| {
        if j + 1 == n { -f.coeff(i) } else { Rational::from(u8::from(i == j + 1)) }
    });
    let power = (1..e).fold(companion.clone(), |acc, _| &acc * &companion);
    squarefree_part(&crate::linalg::char_poly(&power).primitive())
}
