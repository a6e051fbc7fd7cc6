//! Polynomials over `Q[t] / (m)`: lists of coefficients, low degree first, without trailing zeros.

use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::poly::Poly;

/// A polynomial over a field of [`Elem`]s.
pub(super) type Over = Vec<Elem>;

pub(super) fn trimmed(mut p: Over) -> Over {
    while p.last().is_some_and(Elem::is_zero) {
        p.pop();
    }
    p
}

/// The polynomial with rational coefficients.
pub(super) fn lifted(p: &Poly) -> Over {
    p.coeffs().iter().map(Elem::from_rational).collect()
}

pub(super) fn monic(p: &Over, m: &Poly) -> Over {
    let Some(inverse) = p.last().and_then(|lead| lead.inv(m)) else { return p.clone() };
    p.iter().map(|c| c.mul(&inverse, m)).collect()
}

/// The remainder on division by a monic polynomial.
pub(super) fn remainder(mut p: Over, divisor: &Over, m: &Poly) -> Over {
    let d = divisor.len() - 1;
    while p.len() > d {
        let lead = p.pop().unwrap_or_else(Elem::zero);
        let base = p.len() - d;
        if !lead.is_zero() {
            for (j, c) in divisor[..d].iter().enumerate() {
                p[base + j] = p[base + j].sub(&lead.mul(c, m));
            }
        }
    }
    trimmed(p)
}

/// The monic greatest common divisor (Euclid).
pub(super) fn gcd(a: Over, b: Over, m: &Poly) -> Over {
    let (mut a, mut b) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    while !b.is_empty() {
        b = monic(&b, m);
        let r = remainder(a, &b, m);
        (a, b) = (b, r);
    }
    monic(&a, m)
}

/// `p(shift + factor x)` for a rational polynomial.
pub(super) fn substituted(p: &Poly, shift: &Elem, factor: &Rational, m: &Poly) -> Over {
    let mut out: Over = Vec::new();
    for c in p.coeffs().iter().rev() {
        let mut next = vec![Elem::zero(); out.len() + 1];
        for (k, x) in out.iter().enumerate() {
            next[k] = next[k].add(&x.mul(shift, m));
            next[k + 1] = next[k + 1].add(&x.scale(factor));
        }
        next[0] = next[0].add(&Elem::from_rational(c));
        out = next;
    }
    trimmed(out)
}

/// `p(x)` for a rational polynomial at an element.
pub(super) fn evaluated(p: &Poly, x: &Elem, m: &Poly) -> Elem {
    p.coeffs().iter().rev().fold(Elem::zero(), |acc, c| acc.mul(x, m).add(&Elem::from_rational(c)))
}
