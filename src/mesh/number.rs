//! The numbers in which limits at a vertex of valence `n` are written: `u + v α` with `u`, `v` in `Q(t)`, `t = 2 cos(2π/n)`,
//! and `α² = (2 + t) α + 8 + 4t`, `α > 0`. Catmull and Clark's subdominant eigenvalue is `(α + 4)/16`.

use crate::algebraic::Elem;
use crate::arith::{Integer, Rational};
use crate::poly::Poly;
use crate::ring::{Enclosures, Field as _, Fixed, Ordered as _, Ring as _};
use crate::vertex::cosine::minimal_polynomial;
use crate::vertex::field;
use malachite_base::num::arithmetic::traits::{CeilingSqrt, FloorSqrt};

/// `u + v α`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number {
    /// `u`, a polynomial in `t`.
    pub u: Poly,
    /// `v`, a polynomial in `t`.
    pub v: Poly,
}

/// The field at a valence, with enclosures of `t` and `α`.
#[derive(Debug, Clone)]
pub struct Numbers {
    /// The valence.
    pub valence: usize,
    /// The minimal polynomial of `t`.
    pub minimal: Poly,
    near: [(Enclosures, Fixed, Fixed); 2],
}

/// Binary places of the first and the second try.
const PLACES: [u64; 2] = [192, 1024];

impl Number {
    /// A rational number.
    #[must_use]
    pub fn rational(q: &Rational) -> Self {
        Self { u: Poly::constant(q.clone()), v: Poly::zero() }
    }

    /// `self + other`.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self { u: &self.u + &other.u, v: &self.v + &other.v }
    }

    /// `self − other`.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self { u: &self.u - &other.u, v: &self.v - &other.v }
    }

    /// The value, where no root is needed to write it.
    #[must_use]
    pub fn as_rational(&self) -> Option<Rational> {
        (self.v.is_zero() && self.u.coeffs().len() <= 1).then(|| self.u.coeff(0))
    }

    /// `u + (v) a`, with `t` and `a` for the two numbers.
    #[must_use]
    pub fn display(&self) -> String {
        if self.v.is_zero() {
            return self.u.display("t");
        }
        if self.u.is_zero() {
            format!("({}) a", self.v.display("t"))
        } else {
            format!("{} + ({}) a", self.u.display("t"), self.v.display("t"))
        }
    }
}

impl Numbers {
    /// The field at a valence of 1 or more.
    #[must_use]
    pub fn new(valence: usize) -> Self {
        let near = PLACES.map(|bits| {
            let k = Enclosures::new(bits);
            let t = field::Field::twice_cosine(&field::Enclosures::of_angle(1, valence, bits));
            // α = ((2 + t) + √((2 + t)(18 + t)))/2.
            let add = |x: &Fixed, q: i64| k.add(x, &k.integer(&Integer::from(q)));
            let square = k.mul(&add(&t, 2), &add(&t, 18));
            let alpha = k.scale(&k.add(&add(&t, 2), &root(&square, bits)), &Rational::from_signeds(1, 2));
            (k, t, alpha)
        });
        Self { valence, minimal: minimal_polynomial(valence), near }
    }

    fn reduced(&self, p: &Poly) -> Poly {
        if p.coeffs().len() < self.minimal.coeffs().len() { p.clone() } else { p.div_rem(&self.minimal).1 }
    }

    /// The product of polynomials in `t`.
    #[must_use]
    pub fn product(&self, a: &Poly, b: &Poly) -> Poly {
        if a.is_zero() || b.is_zero() { Poly::zero() } else { self.reduced(&(a * b)) }
    }

    /// `a b`.
    #[must_use]
    pub fn times(&self, a: &Number, b: &Number) -> Number {
        let uu = self.product(&a.u, &b.u);
        let vv = self.product(&a.v, &b.v);
        let mixed = &self.product(&a.u, &b.v) + &self.product(&a.v, &b.u);
        let (trace, rest) = (self.product(&vv, &linear(2, 1)), self.product(&vv, &linear(8, 4)));
        Number { u: &uu + &rest, v: &mixed + &trace }
    }

    /// `t p + q`, for the powers of `e^(2πi/n)`.
    #[must_use]
    pub fn step(&self, p: &Poly, q: &Poly) -> Poly {
        &self.product(p, &linear(0, 1)) + q
    }

    /// The inverse of a polynomial in `t`.
    #[must_use]
    pub fn inverse(&self, p: &Poly) -> Option<Poly> {
        Elem::reduced(p, &self.minimal).inv(&self.minimal).map(|e| e.0)
    }

    /// An enclosure with the places of the first try, or of the second.
    #[must_use]
    pub fn enclosure(&self, x: &Number, again: bool) -> (Enclosures, Fixed) {
        let (k, t, alpha) = &self.near[usize::from(again)];
        (*k, k.add(&k.eval(&x.u, t), &k.mul(&k.eval(&x.v, t), alpha)))
    }

    /// The sign, decided exactly: `None` only where a number that is not 0 is closer to 0 than the enclosures are wide.
    #[must_use]
    pub fn sign(&self, x: &Number) -> Option<i32> {
        let (u, v) = (self.reduced(&x.u), self.reduced(&x.v));
        if u.is_zero() && v.is_zero() {
            return Some(0);
        }
        if let Some(q) = (Number { u: u.clone(), v: v.clone() }).as_rational() {
            return Some(crate::arith::sign(&q));
        }
        for again in [false, true] {
            let (k, value) = self.enclosure(x, again);
            if let Some(sign) = k.sign(&value).filter(|s| *s != 0) {
                return Some(sign);
            }
        }
        // (u + vα)(u + vα') = u² + (2 + t)uv − (8 + 4t)v², and α' = (2 + t) − α.
        let uv = self.product(&u, &v);
        let norm = &(&self.product(&u, &u) + &self.product(&uv, &linear(2, 1)))
            - &self.product(&self.product(&v, &v), &linear(8, 4));
        let (k, t, alpha) = &self.near[1];
        let other = k.sub(&k.add(t, &k.integer(&Integer::from(2))), alpha);
        let conjugate = k.add(&k.eval(&u, t), &k.mul(&k.eval(&v, t), &other));
        (self.reduced(&norm).is_zero() && k.sign(&conjugate).is_some_and(|s| s != 0)).then_some(0)
    }
}

fn linear(constant: i64, t: i64) -> Poly {
    Poly::new(vec![Rational::from(constant), Rational::from(t)])
}

/// An enclosure of the square root of a number that is not negative.
fn root(x: &Fixed, bits: u64) -> Fixed {
    let zero = Integer::from(0);
    let lo = if x.lo < 0 { zero.clone() } else { x.lo.clone() };
    let hi = if x.hi < 0 { zero } else { x.hi.clone() };
    Fixed { lo: (lo << bits).floor_sqrt(), hi: (hi << bits).ceiling_sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn number(u: &[i64], v: &[i64]) -> Number {
        let poly = |c: &[i64]| Poly::new(c.iter().map(|x| Rational::from(*x)).collect());
        Number { u: poly(u), v: poly(v) }
    }

    #[test]
    fn signs_are_exact() {
        // n = 5: t = (√5 − 1)/2, t² + t − 1 = 0; α² − (2 + t)α − (8 + 4t) = 0.
        let k = Numbers::new(5);
        let alpha = number(&[], &[1]);
        let zero = k.times(&alpha, &alpha).minus(&k.times(&number(&[2, 1], &[]), &alpha)).minus(&number(&[8, 4], &[]));
        assert_eq!((k.sign(&zero), k.sign(&number(&[-1, 1, 1], &[]))), (Some(0), Some(0)));
        assert_eq!(k.sign(&number(&[0, -1], &[])), Some(-1));
        // n = 4: α = 4 is rational, which the coordinates do not show.
        assert_eq!(Numbers::new(4).sign(&number(&[-4], &[1])), Some(0));
        assert_eq!(Numbers::new(4).sign(&number(&[-5], &[1])), Some(-1));
        // n = 3: λ = (9 + √17)/32.
        let (near, value) = Numbers::new(3).enclosure(&alpha, false);
        assert!((near.to_f64(&value) - (0.410_097_050_8 * 16.0 - 4.0)).abs() < 1e-8);
        let inverse = k.inverse(&number(&[3, 2], &[]).u).unwrap();
        assert_eq!(k.product(&inverse, &number(&[3, 2], &[]).u), Poly::constant(ratio(1, 1)));
    }
}
