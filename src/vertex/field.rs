//! The fields over which one computation runs: enclosures, exact numbers, and functions of a parameter.

use crate::algebraic::{Elem, Root};
use crate::arith::{Integer, Interval, Rational, sign};
use crate::poly::Poly;
use malachite_base::num::arithmetic::traits::ShrRound;
use malachite_base::rounding_modes::RoundingMode;

/// A field, or enclosures of the elements of one, with `2 cos θ` as one of its elements.
pub trait Field {
    /// Elements.
    type E: Clone;
    /// A rational number.
    fn rational(&self, q: &Rational) -> Self::E;
    /// `a + b`.
    fn add(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// `a - b`.
    fn sub(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// `a * b`.
    fn mul(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// `q a` for a rational `q`.
    fn scale(&self, a: &Self::E, q: &Rational) -> Self::E;
    /// `1 / a`, where `a` is certainly not 0.
    fn inv(&self, a: &Self::E) -> Option<Self::E>;
    /// The sign, where it is certain.
    fn sign(&self, a: &Self::E) -> Option<i32>;
    /// `2 cos θ`.
    fn twice_cosine(&self) -> Self::E;
    /// The number 0.
    fn zero(&self) -> Self::E {
        self.rational(&Rational::from(0))
    }
    /// The number 1.
    fn one(&self) -> Self::E {
        self.rational(&Rational::from(1))
    }
    /// `-a`.
    fn neg(&self, a: &Self::E) -> Self::E {
        self.sub(&self.zero(), a)
    }
    /// A rational polynomial at `a` (Horner).
    fn eval(&self, p: &Poly, a: &Self::E) -> Self::E {
        p.coeffs().iter().rev().fold(self.zero(), |v, c| self.add(&self.mul(&v, a), &self.rational(c)))
    }
}

/// An enclosure `[lo, hi] / 2^bits`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fixed {
    /// Lower end.
    pub lo: Integer,
    /// Upper end.
    pub hi: Integer,
}

/// Enclosures of one width of mantissa, with one of `2 cos θ`.
#[derive(Debug, Clone)]
pub struct Enclosures {
    /// Binary places.
    pub bits: u64,
    twice_cosine: Fixed,
}

fn floor(x: Integer, bits: u64) -> Integer {
    x.shr_round(bits, RoundingMode::Floor).0
}

fn ceiling(x: Integer, bits: u64) -> Integer {
    x.shr_round(bits, RoundingMode::Ceiling).0
}

impl Enclosures {
    /// The enclosures for `θ = 2πk/n`.
    #[must_use]
    pub fn of_angle(k: usize, n: usize, bits: u64) -> Self {
        let mut field = Self { bits, twice_cosine: Fixed { lo: Integer::from(0), hi: Integer::from(0) } };
        field.twice_cosine = match crate::scheme::rational_cosine(k, n) {
            Some(c) => field.rational(&(c * Rational::from(2))),
            None => field.cosine(k, n),
        };
        field
    }

    /// Enclosures beside a given one of `2 cos θ`.
    #[must_use]
    pub fn with_twice_cosine(interval: &Interval, bits: u64) -> Self {
        let mut field = Self { bits, twice_cosine: Fixed { lo: Integer::from(0), hi: Integer::from(0) } };
        field.twice_cosine = field.interval(interval);
        field
    }

    /// The enclosure of an interval.
    #[must_use]
    pub fn interval(&self, x: &Interval) -> Fixed {
        Fixed { lo: self.rational(&x.lo).lo, hi: self.rational(&x.hi).hi }
    }

    /// An enclosure as an interval.
    #[must_use]
    pub fn to_interval(&self, x: &Fixed) -> Interval {
        let scale = Integer::from(1) << self.bits;
        let end = |v: &Integer| Rational::from_integers(v.clone(), scale.clone());
        Interval { lo: end(&x.lo), hi: end(&x.hi) }
    }

    /// The middle as a float, for proposals and display.
    #[must_use]
    pub fn to_f64(&self, x: &Fixed) -> f64 {
        crate::arith::to_f64(&self.to_interval(x).mid())
    }

    /// `2 cos(2πk/n)`: Taylor's series at an enclosure of the angle, `π` by Machin's formula.
    fn cosine(&self, k: usize, n: usize) -> Fixed {
        let work = Self { bits: self.bits + 32, twice_cosine: self.twice_cosine.clone() };
        let fifth = work.arctan_inverse(5);
        let other = work.arctan_inverse(239);
        let pi = work.sub(&work.scale(&fifth, &Rational::from(16)), &work.scale(&other, &Rational::from(4)));
        let k = k.min(n - k);
        let angle = work.scale(&pi, &Rational::from_unsigneds(2 * k as u64, n as u64));
        let square = work.mul(&angle, &angle);
        let (mut term, mut sum) = (work.one(), work.one());
        // The angle is at most π, so that beyond j = 2 the terms alternate and decrease.
        for j in 1_u64.. {
            let factor = Rational::from_signeds(-1, ((2 * j - 1) * 2 * j) as i64);
            term = work.scale(&work.mul(&term, &square), &factor);
            sum = work.add(&sum, &term);
            if j > 4 && term.lo >= -1 && term.hi <= 1 {
                break;
            }
        }
        let rest = Fixed { lo: sum.lo - Integer::from(4), hi: sum.hi + Integer::from(4) };
        Fixed { lo: floor(rest.lo << 1, 32), hi: ceiling(rest.hi << 1, 32) }
    }

    /// `arctan(1/q)`.
    fn arctan_inverse(&self, q: i64) -> Fixed {
        let square = Rational::from_signeds(1, q * q);
        let mut power = self.rational(&Rational::from_signeds(1, q));
        let mut sum = power.clone();
        for j in 1_i64.. {
            power = self.scale(&power, &square);
            let term = self.scale(&power, &Rational::from_signeds(if j % 2 == 0 { 1 } else { -1 }, 2 * j + 1));
            sum = self.add(&sum, &term);
            if power.hi <= 1 {
                break;
            }
        }
        Fixed { lo: sum.lo - Integer::from(2), hi: sum.hi + Integer::from(2) }
    }
}

impl Field for Enclosures {
    type E = Fixed;

    fn rational(&self, q: &Rational) -> Fixed {
        use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
        let scaled = q * Rational::from(Integer::from(1) << self.bits);
        Fixed { lo: (&scaled).floor(), hi: (&scaled).ceiling() }
    }

    fn add(&self, a: &Fixed, b: &Fixed) -> Fixed {
        Fixed { lo: &a.lo + &b.lo, hi: &a.hi + &b.hi }
    }

    fn sub(&self, a: &Fixed, b: &Fixed) -> Fixed {
        Fixed { lo: &a.lo - &b.hi, hi: &a.hi - &b.lo }
    }

    fn mul(&self, a: &Fixed, b: &Fixed) -> Fixed {
        let products = [&a.lo * &b.lo, &a.lo * &b.hi, &a.hi * &b.lo, &a.hi * &b.hi];
        let [p, q, r, s] = products;
        let (low, high) = if p <= q { (p, q) } else { (q, p) };
        let (below, above) = if r <= s { (r, s) } else { (s, r) };
        Fixed { lo: floor(low.min(below), self.bits), hi: ceiling(high.max(above), self.bits) }
    }

    fn scale(&self, a: &Fixed, q: &Rational) -> Fixed {
        use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
        let ends = [Rational::from(&a.lo) * q, Rational::from(&a.hi) * q];
        let [x, y] = if *q >= 0 { ends } else { [ends[1].clone(), ends[0].clone()] };
        Fixed { lo: (&x).floor(), hi: (&y).ceiling() }
    }

    fn inv(&self, a: &Fixed) -> Option<Fixed> {
        use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
        self.sign(a).filter(|s| *s != 0)?;
        let one = Rational::from(Integer::from(1) << (2 * self.bits));
        let (low, high) = (&one / Rational::from(&a.hi), one / Rational::from(&a.lo));
        Some(Fixed { lo: (&low).floor(), hi: (&high).ceiling() })
    }

    fn sign(&self, a: &Fixed) -> Option<i32> {
        if a.lo > 0 {
            Some(1)
        } else if a.hi < 0 {
            Some(-1)
        } else if a.lo == 0 && a.hi == 0 {
            Some(0)
        } else {
            None
        }
    }

    fn twice_cosine(&self) -> Fixed {
        self.twice_cosine.clone()
    }
}

/// A number field with a real root of its polynomial.
#[derive(Debug, Clone)]
pub struct NumberField {
    /// The real root that generates it.
    pub root: Root,
    /// `2 cos θ` in it.
    pub twice_cosine: Elem,
}

impl Field for NumberField {
    type E = Elem;

    fn rational(&self, q: &Rational) -> Elem {
        Elem::from_rational(q)
    }

    fn add(&self, a: &Elem, b: &Elem) -> Elem {
        a.add(b)
    }

    fn sub(&self, a: &Elem, b: &Elem) -> Elem {
        a.sub(b)
    }

    fn mul(&self, a: &Elem, b: &Elem) -> Elem {
        a.mul(b, self.root.minpoly())
    }

    fn scale(&self, a: &Elem, q: &Rational) -> Elem {
        a.scale(q)
    }

    fn inv(&self, a: &Elem) -> Option<Elem> {
        a.inv(self.root.minpoly())
    }

    fn sign(&self, a: &Elem) -> Option<i32> {
        Some(a.sign(&self.root))
    }

    fn twice_cosine(&self) -> Elem {
        self.twice_cosine.clone()
    }
}

/// A quotient of polynomials in a parameter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fraction {
    /// Numerator.
    pub num: Poly,
    /// Denominator, monic.
    pub den: Poly,
}

/// Rational functions of a parameter, for all valences at once.
#[derive(Debug, Clone)]
pub struct Functions {
    /// `2 cos θ` as a function of the parameter.
    pub twice_cosine: Fraction,
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
        if let Some(lead) = den.leading().cloned() {
            let factor = Rational::from(1) / lead;
            num = num.scale(&factor);
            den = den.scale(&factor);
        }
        Self { num, den }
    }

    /// A polynomial.
    #[must_use]
    pub fn polynomial(num: Poly) -> Self {
        Self { num, den: Poly::constant(Rational::from(1)) }
    }
}

impl Field for Functions {
    type E = Fraction;

    fn rational(&self, q: &Rational) -> Fraction {
        Fraction::polynomial(Poly::constant(q.clone()))
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

    fn scale(&self, a: &Fraction, q: &Rational) -> Fraction {
        if *q == 0 {
            return self.zero();
        }
        Fraction { num: a.num.scale(q), den: a.den.clone() }
    }

    fn inv(&self, a: &Fraction) -> Option<Fraction> {
        (!a.num.is_zero()).then(|| Fraction::new(a.den.clone(), a.num.clone()))
    }

    /// Only 0 has a sign; others change with the parameter.
    fn sign(&self, a: &Fraction) -> Option<i32> {
        match a.num.coeffs() {
            [] => Some(0),
            [c] if a.den.degree() == Some(0) => Some(sign(c)),
            _ => None,
        }
    }

    fn twice_cosine(&self) -> Fraction {
        self.twice_cosine.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn cosines_satisfy_their_equations() {
        // 2cos(2π/5) is the positive root of x² + x − 1, 2cos(2π/7) of x³ + x² − 2x − 1.
        for (k, n, f) in [(1, 5, vec![-1, 1, 1]), (1, 7, vec![-1, -2, 1, 1]), (3, 7, vec![-1, -2, 1, 1])] {
            let field = Enclosures::of_angle(k, n, 160);
            let f = Poly::new(f.into_iter().map(|c| ratio(c, 1)).collect());
            let value = field.eval(&f, &field.twice_cosine());
            assert!(value.lo <= 0 && value.hi >= 0, "{k}/{n}");
            assert!(&value.hi - &value.lo < 1_000_000, "narrow");
        }
        let c = Enclosures::of_angle(1, 256, 160);
        assert!((c.to_f64(&c.twice_cosine()) - 1.999_397_637_392_74).abs() < 1e-12);
        let wide = Enclosures::of_angle(49, 100, 160);
        assert!((wide.to_f64(&wide.twice_cosine()) + 1.996_053_456_856_543).abs() < 1e-12);
    }

    #[test]
    fn enclosures_enclose() {
        let field = Enclosures::of_angle(1, 4, 64);
        let third = field.rational(&ratio(1, 3));
        let product = field.mul(&third, &field.rational(&ratio(-3, 1)));
        assert!(product.lo <= -(Integer::from(1) << 64_u64) && product.hi >= -(Integer::from(1) << 64_u64));
        let back = field.inv(&third).unwrap();
        assert!(field.to_interval(&back).lo <= 3 && field.to_interval(&back).hi >= 3);
        assert_eq!(field.sign(&field.twice_cosine()), Some(0));
    }

    #[test]
    fn fractions_reduce() {
        let x = Poly::new(vec![ratio(0, 1), ratio(1, 1)]);
        let field = Functions { twice_cosine: Fraction::polynomial(x.clone()) };
        let f = Fraction::new(&x * &x, x.scale(&ratio(2, 1)));
        assert_eq!(f, Fraction::polynomial(x.scale(&ratio(1, 2))));
        let one = field.mul(&f, &field.inv(&f).unwrap());
        assert_eq!(field.sign(&one), Some(1));
    }
}
