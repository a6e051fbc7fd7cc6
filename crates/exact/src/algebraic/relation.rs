//! Exact decisions about sums and products of two roots, through the polynomials that have them as roots.

use super::ball::{Ball, abs};
use super::isolate::refine;
use super::root::Root;
use crate::arith::modular::{PrimeField, large_primes};
use crate::arith::{Integer, Interval, Rational};
use crate::poly::ints::{self, CrtPoly, root_bound};
use crate::poly::{IntPoly, Poly};
use malachite_base::num::arithmetic::traits::{Ceiling, Floor, ShrRound};
use malachite_base::num::logic::traits::SignificantBits;
use malachite_base::rounding_modes::RoundingMode;
use std::cmp::Ordering;

/// The pairs of different roots that make a new polynomial.
#[derive(Clone, Copy)]
enum Pairs {
    Sums,
    Products,
}

/// The polynomial whose roots are the products of two different roots of `f`.
pub(super) fn pair_products(f: &[Integer]) -> IntPoly {
    pairs(f, Pairs::Products)
}

/// The polynomial of the sums or products of two different roots, of degree `n (n - 1) / 2`: through power sums modulo
/// primes, as many as a bound for the coefficients needs.
fn pairs(f: &[Integer], kind: Pairs) -> IntPoly {
    let n = f.len() - 1;
    let degree = n * (n - 1) / 2;
    // With the leading coefficient l the numbers l r are integral; so are their sums and products, and the moduli of
    // those are at most 2^size, so that every coefficient is at most (1 + 2^size)^degree.
    let lead = &f[n];
    let integral = u64::try_from(root_bound(f) + lead.significant_bits() as i64).unwrap_or(0);
    let size = match kind {
        Pairs::Sums => integral + 1,
        Pairs::Products => 2 * integral,
    };
    let bound = (size + 1) * degree as u64 + 2;
    let mut image = CrtPoly::default();
    for p in large_primes() {
        let field = PrimeField::new(p);
        image.absorb(&field, &pairs_modulo(f, kind, degree, &field));
        if image.modulus.significant_bits() > bound {
            break;
        }
    }
    let factor = match kind {
        Pairs::Sums => lead.clone(),
        Pairs::Products => lead * lead,
    };
    let mut power = Integer::from(1);
    for c in &mut image.coeffs {
        *c *= &power;
        power *= &factor;
    }
    ints::primitive(image.coeffs)
}

/// The monic polynomial of the numbers `l r`, modulo a prime: low degree first.
fn integral_residues(f: &[Integer], field: &PrimeField) -> Vec<u64> {
    let n = f.len() - 1;
    let mut out: Vec<u64> = f[..n].iter().map(|c| field.from_integer(c)).collect();
    let lead = field.from_integer(&f[n]);
    let mut power = field.one();
    for c in out.iter_mut().rev() {
        *c = field.mul(*c, power);
        power = field.mul(power, lead);
    }
    out.push(field.one());
    out
}

fn pairs_modulo(f: &[Integer], kind: Pairs, degree: usize, field: &PrimeField) -> Vec<u64> {
    let monic = integral_residues(f, field);
    let half = field.inverse(field.from_u64(2));
    let sums = match kind {
        Pairs::Products => {
            let p = power_sums(field, &monic, 2 * degree);
            (0..=degree).map(|k| field.mul(field.sub(field.mul(p[k], p[k]), p[2 * k]), half)).collect()
        }
        Pairs::Sums => {
            let p = power_sums(field, &monic, degree);
            sum_powers(field, &p, degree, half)
        }
    };
    from_power_sums(field, &sums, degree)
}

/// The power sums of the `r_i + r_j` for `i < j`: `k!` times the square of the series of the `p_m / m!`, and what belongs
/// to `i = j` taken away.
fn sum_powers(field: &PrimeField, p: &[u64], degree: usize, half: u64) -> Vec<u64> {
    let mut factorials = vec![field.one()];
    for k in 1..=degree {
        factorials.push(field.mul(factorials[k - 1], field.from_u64(k as u64)));
    }
    let mut inverse = field.inverse(factorials[degree]);
    let mut series = vec![0; degree + 1];
    for k in (0..=degree).rev() {
        series[k] = field.mul(p[k], inverse);
        inverse = field.mul(inverse, field.from_u64(k as u64));
    }
    let reversed: Vec<u64> = series.iter().rev().copied().collect();
    let mut power = field.one();
    (0..=degree)
        .map(|k| {
            let square = field.dot(&series[..=k], &reversed[degree - k..]);
            let all = field.mul(square, factorials[k]);
            let equal = field.mul(power, p[k]);
            power = field.add(power, power);
            field.mul(field.sub(all, equal), half)
        })
        .collect()
}

/// The power sums `p_0 .. p_count` of the roots of a monic polynomial (Newton).
fn power_sums(field: &PrimeField, f: &[u64], count: usize) -> Vec<u64> {
    let n = f.len() - 1;
    let mut sums = vec![field.from_u64(n as u64)];
    for k in 1..=count {
        // p_k = -(f_(n-1) p_(k-1) + f_(n-2) p_(k-2) + … ) - k f_(n-k)
        let terms = n.min(k - 1);
        let mut s = field.dot(&f[n - terms..n], &sums[k - terms..k]);
        if k <= n {
            s = field.add(s, field.mul(field.from_u64(k as u64), f[n - k]));
        }
        sums.push(field.neg(s));
    }
    sums
}

/// The monic polynomial of degree `n` with the given power sums of its roots, low degree first.
fn from_power_sums(field: &PrimeField, sums: &[u64], n: usize) -> Vec<u64> {
    // Low degree first means that the newest coefficient is put in front.
    let mut low_first = vec![0; n + 1];
    low_first[n] = field.one();
    for k in 1..=n {
        let s = field.dot(&low_first[n + 1 - k..], &sums[1..=k]);
        low_first[n - k] = field.neg(field.mul(s, field.inverse(field.from_u64(k as u64))));
    }
    low_first
}

/// The product of the different irreducible factors.
pub(super) fn squarefree_part(f: &[Integer]) -> IntPoly {
    if ints::squarefree_modulo_some_prime(f) {
        return ints::primitive(f.to_vec());
    }
    let common = ints::gcd(f, &ints::primitive(ints::derivative(f)));
    ints::primitive(ints::div_exact(f, &common).expect("a common divisor divides"))
}

/// Whether two real numbers are equal, given a square-free polynomial that vanishes at both, and enclosures of them
/// that shrink as their argument grows: they are as soon as the derivative has no zero in an interval around both.
pub(super) fn equal_roots(f: &[Integer], enclosures: impl Fn(u64) -> (Interval, Interval)) -> bool {
    let slope = ints::derivative(f);
    let mut bits = 128;
    loop {
        let (a, b) = enclosures(bits);
        if a.disjoint(&b) {
            return false;
        }
        if has_no_zero(&slope, &Interval::new(a.lo.min(b.lo), a.hi.max(b.hi)), bits) {
            return true;
        }
        bits *= 2;
    }
}

/// Whether a polynomial is seen to have no zero in an interval, by Horner's scheme in numbers with `bits` binary places.
fn has_no_zero(f: &[Integer], range: &Interval, bits: u64) -> bool {
    let scale = |x: &Rational| x << bits as i64;
    let (lo, hi): (Integer, Integer) = (scale(&range.lo).floor(), scale(&range.hi).ceiling());
    // The centre and the radius, in units of 2^-bits; products are rounded, with one unit for that in the radius.
    let centre: Integer = (&lo + &hi) >> 1u64;
    let radius: Integer = (hi - lo).shr_round(1u64, RoundingMode::Ceiling).0 + Integer::from(1);
    let reach = abs(&centre) + &radius;
    let (mut value, mut error) = (Integer::from(0), Integer::from(0));
    for c in f.iter().rev() {
        error = ((error * &reach + abs(&value) * &radius) >> bits) + Integer::from(2);
        value = ((value * &centre) >> bits) + (c << bits);
    }
    abs(&value) > error
}

/// The number `c` with `f(c + x) = f(c - x)`, if there is one.
fn axis(f: &[Integer]) -> Option<Rational> {
    let n = f.len() - 1;
    let c = Rational::from_integers_ref(&-&f[n - 1], &(&f[n] * Integer::from(n)));
    let moved = if c == 0 { f.to_vec() } else { Poly::from_ints(f).shifted(&c).primitive() };
    moved.iter().skip(1).step_by(2).all(|c| *c == 0).then_some(c)
}

/// Whether the root in an isolating disc has the real part `c`, for a polynomial with `f(c + x) = f(c - x)`: its mirror
/// image is a root, in the disc of three times the radius where the real part of the centre is `c` up to the radius, and
/// there is no other root.
fn is_on_axis(ball: &Ball, c: &Rational) -> bool {
    let re = ball.enclosure().0;
    re.lo <= *c && *c <= re.hi
}

/// Sorts isolating discs of the upper half plane by real part, then by imaginary part, exactly.
pub(super) fn sorted_by_parts(f: &[Integer], mut upper: Vec<Ball>) -> Vec<Ball> {
    let mut sums: Option<IntPoly> = None;
    let axis = if upper.len() > 1 { axis(f) } else { None };
    let at = |ball: &Ball, bits: u64| refine(f, ball, ball, -(bits as i64));
    let lower = |a: &Ball, b: &Ball| {
        let order = (0..).find_map(|k| at(a, 64 << k).cmp_im(&at(b, 64 << k)));
        order.expect("different roots with equal real parts have different imaginary parts")
    };
    let mut compare = |a: &Ball, b: &Ball| -> Ordering {
        if let Some(c) = &axis
            && is_on_axis(a, c)
            && is_on_axis(b, c)
        {
            return lower(a, b);
        }
        if let Some(order) = a.cmp_re(b) {
            return order;
        }
        if let Some(order) = at(a, 128).cmp_re(&at(b, 128)) {
            return order;
        }
        let polynomial = sums.get_or_insert_with(|| squarefree_part(&pairs(f, Pairs::Sums)));
        let double = |ball: &Ball, bits: u64| {
            let re = at(ball, bits).enclosure().0;
            &re * &Rational::from(2)
        };
        if equal_roots(polynomial, |bits| (double(a, bits), double(b, bits))) {
            return lower(a, b);
        }
        let order = (0..).find_map(|k| at(a, 64 << k).cmp_re(&at(b, 64 << k)));
        order.expect("different real parts")
    };
    // Few roots are compared more than once, and the order is total, so plain insertion is enough.
    let mut sorted: Vec<Ball> = Vec::with_capacity(upper.len());
    for ball in upper.drain(..) {
        let at = sorted.partition_point(|b| compare(b, &ball) == Ordering::Less);
        sorted.insert(at, ball);
    }
    sorted
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
