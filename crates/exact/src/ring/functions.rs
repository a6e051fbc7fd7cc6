use super::{Field, Ordered, Ring};
use crate::algebraic::{Root, cmp_real, real_roots};
use crate::arith::{Integer, Rational, sign};
use crate::poly::{Poly, factor};
use std::cmp::Ordering;

/// A quotient of polynomials in a parameter, in lowest terms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fraction {
    /// Numerator.
    pub num: Poly,
    /// Denominator, monic.
    pub den: Poly,
}

/// Rational functions of a parameter in an open interval, or anywhere.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Functions {
    interval: Option<(Rational, Rational)>,
}

impl Fraction {
    /// The quotient of two polynomials in lowest terms.
    ///
    /// # Panics
    /// If the denominator is 0.
    #[must_use]
    pub fn new(num: Poly, den: Poly) -> Self {
        let common = num.gcd(&den);
        let (mut num, mut den) = if common.degree().is_some_and(|d| d > 0) {
            (num.div_rem(&common).0, den.div_rem(&common).0)
        } else {
            (num, den)
        };
        if num.is_zero() {
            return Self { num, den: Poly::constant(Rational::from(1)) };
        }
        let factor = Rational::from(1) / den.leading().expect("a denominator is not 0");
        num = num.scale(&factor);
        den = den.scale(&factor);
        Self { num, den }
    }

    /// A polynomial.
    #[must_use]
    pub fn polynomial(num: Poly) -> Self {
        Self { num, den: Poly::constant(Rational::from(1)) }
    }
}

impl Functions {
    /// Functions of a parameter that may be any number: only constants have a sign.
    #[must_use]
    pub fn anywhere() -> Self {
        Self::default()
    }

    /// Functions of a parameter between two rationals, the ends not included: those without zeros and poles there have a
    /// sign.
    ///
    /// # Panics
    /// If `lo` is not below `hi`.
    #[must_use]
    pub fn between(lo: Rational, hi: Rational) -> Self {
        assert!(lo < hi, "an interval");
        Self { interval: Some((lo, hi)) }
    }

    /// The sign of a polynomial, if it is the same everywhere.
    fn constant_sign(&self, p: &Poly) -> Option<i32> {
        match (p.coeffs(), &self.interval) {
            ([], _) => Some(0),
            ([c], _) => Some(sign(c)),
            (_, None) => None,
            (_, Some((lo, hi))) => {
                let inside = |r: &Root| {
                    let at = |q: &Rational| cmp_real(r, &Root::from_rational(q));
                    at(lo) == Ordering::Greater && at(hi) == Ordering::Less
                };
                let zero = factor(p).iter().any(|(g, _)| real_roots(g).iter().any(inside));
                (!zero).then(|| sign(&p.eval(&((lo + hi) / Rational::from(2)))))
            }
        }
    }
}

impl Ring for Functions {
    type E = Fraction;

    fn integer(&self, n: &Integer) -> Fraction {
        self.rational(&Rational::from(n))
    }

    fn add(&self, a: &Fraction, b: &Fraction) -> Fraction {
        if a.den == b.den {
            return Fraction::new(&a.num + &b.num, a.den.clone());
        }
        Fraction::new(&(&a.num * &b.den) + &(&b.num * &a.den), &a.den * &b.den)
    }

    fn sub(&self, a: &Fraction, b: &Fraction) -> Fraction {
        self.add(a, &Fraction { num: -&b.num, den: b.den.clone() })
    }

    fn mul(&self, a: &Fraction, b: &Fraction) -> Fraction {
        Fraction::new(&a.num * &b.num, &a.den * &b.den)
    }

    /// Whether this is the function 0.
    fn is_zero(&self, a: &Fraction) -> Option<bool> {
        Some(a.num.is_zero())
    }
}

impl Field for Functions {
    fn rational(&self, q: &Rational) -> Fraction {
        Fraction::polynomial(Poly::constant(q.clone()))
    }

    fn inv(&self, a: &Fraction) -> Option<Fraction> {
        (!a.num.is_zero()).then(|| Fraction::new(a.den.clone(), a.num.clone()))
    }

    fn scale(&self, a: &Fraction, q: &Rational) -> Fraction {
        if *q == 0 {
            return self.zero();
        }
        Fraction { num: a.num.scale(q), den: a.den.clone() }
    }
}

impl Ordered for Functions {
    /// The sign at every parameter; `None` where it changes, or where there is a pole.
    fn sign(&self, a: &Fraction) -> Option<i32> {
        if a.num.is_zero() {
            return Some(0);
        }
        Some(self.constant_sign(&a.num)? * self.constant_sign(&a.den)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn fractions_reduce_and_have_signs_on_intervals() {
        let x = Poly::new(vec![ratio(0, 1), ratio(1, 1)]);
        let field = Functions::anywhere();
        let f = Fraction::new(&x * &x, x.scale(&ratio(2, 1)));
        assert_eq!(f, Fraction::polynomial(x.scale(&ratio(1, 2))));
        let one = field.mul(&f, &field.inv(&f).unwrap());
        assert_eq!((field.sign(&one), field.sign(&f)), (Some(1), None));
        let on = |p, q| Functions::between(ratio(p, 1), ratio(q, 1));
        // x² − 2 changes its sign between 1 and 2, not between 2 and 3; 1/x has a pole between −1 and 1.
        let g = Fraction::polynomial(&(&x * &x) - &Poly::constant(ratio(2, 1)));
        assert_eq!((on(1, 2).sign(&g), on(2, 3).sign(&g), on(-1, 1).sign(&g)), (None, Some(1), Some(-1)));
        assert_eq!((on(-1, 1).sign(&field.inv(&f).unwrap()), on(-1, 0).sign(&f)), (None, Some(-1)));
    }
}
