//! Intervals of floats that contain the exact results: every operation rounds outwards by one float.
#![allow(clippy::float_arithmetic, reason = "the ends are moved outwards after every operation")]

use crate::arith::{Interval, Rational};
use malachite_base::num::conversion::traits::RoundingFrom;
use malachite_base::rounding_modes::RoundingMode;
use std::ops::{Add, Mul, Neg, Sub};

/// The numbers between two floats. Where an end is no number nothing is known, and no comparison holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Float {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl Float {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self { lo: f64::NAN, hi: f64::NAN };
    /// The number 0.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };

    /// One float.
    #[must_use]
    pub fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// The enclosure of a rational number.
    #[must_use]
    pub fn of(x: &Rational) -> Self {
        Self { lo: f64::rounding_from(x, RoundingMode::Floor).0, hi: f64::rounding_from(x, RoundingMode::Ceiling).0 }
    }

    /// The enclosure of an interval.
    #[must_use]
    pub fn around(x: &Interval) -> Self {
        Self { lo: Self::of(&x.lo).lo, hi: Self::of(&x.hi).hi }
    }

    /// The quotient `p/q` of two small integers.
    #[must_use]
    pub fn ratio(p: i64, q: i64) -> Self {
        Self::point(p as f64).divided(q)
    }

    fn outward(lo: f64, hi: f64) -> Self {
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }

    /// A float inside, for proposals and display.
    #[must_use]
    pub fn mid(self) -> f64 {
        f64::midpoint(self.lo, self.hi)
    }

    /// The largest absolute value.
    #[must_use]
    pub fn magnitude(self) -> f64 {
        if self.lo.is_nan() || self.hi.is_nan() { f64::NAN } else { self.lo.abs().max(self.hi.abs()) }
    }

    /// Whether all numbers inside are positive.
    #[must_use]
    pub fn positive(self) -> bool {
        self.lo > 0.0 && self.hi > 0.0
    }

    /// Whether 0 is certainly not inside.
    #[must_use]
    pub fn nonzero(self) -> bool {
        self.positive() || (-self).positive()
    }

    /// The absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.lo >= 0.0 {
            self
        } else if self.hi <= 0.0 {
            -self
        } else {
            Self { lo: if self.magnitude().is_nan() { f64::NAN } else { 0.0 }, hi: self.magnitude() }
        }
    }

    /// Divided by a positive integer that is a float.
    #[must_use]
    pub fn divided(self, by: i64) -> Self {
        let by = by as f64;
        if by > 0.0 { Self::outward(self.lo / by, self.hi / by) } else { Self::UNKNOWN }
    }

    /// Times an integer that is a float.
    #[must_use]
    pub fn times(self, by: i64) -> Self {
        let by = by as f64;
        let (a, b) = (self.lo * by, self.hi * by);
        if by >= 0.0 { Self::outward(a, b) } else { Self::outward(b, a) }
    }

    /// The quotient; nothing is known of it where 0 might be in the divisor.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        if !other.nonzero() {
            return Self::UNKNOWN;
        }
        let all = [self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi];
        Self::hull(all)
    }

    /// The square root of the numbers that are not negative.
    #[must_use]
    pub fn root(self) -> Self {
        if self.hi >= 0.0 { Self::outward(self.lo.max(0.0).sqrt(), self.hi.sqrt()) } else { Self::UNKNOWN }
    }

    fn hull(all: [f64; 4]) -> Self {
        // `min` and `max` pass over what is no number; a sum does not.
        if all.iter().sum::<f64>().is_nan() {
            return Self::UNKNOWN;
        }
        let lo = all[0].min(all[1]).min(all[2].min(all[3]));
        let hi = all[0].max(all[1]).max(all[2].max(all[3]));
        Self::outward(lo, hi)
    }
}

impl Add for Float {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Float {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Mul for Float {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::hull([self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi])
    }
}

impl Neg for Float {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use proptest::prelude::*;

    fn holds(x: Float, q: &Rational) -> bool {
        let end = |x: f64| Rational::try_from(x).unwrap();
        end(x.lo) <= *q && end(x.hi) >= *q
    }

    proptest! {
        #[test]
        fn operations_enclose(a in -999_i64..999, b in 1_i64..99, c in -999_i64..999, d in 1_i64..99) {
            let (p, q) = (ratio(a, b), ratio(c, d));
            let (x, y) = (Float::of(&p), Float::of(&q));
            prop_assert!(holds(x + y, &(&p + &q)) && holds(x - y, &(&p - &q)) && holds(x * y, &(&p * &q)));
            prop_assert!(holds(x.divided(b), &(&p / Rational::from(b))) && holds(x.times(c), &(&p * Rational::from(c))));
            if c != 0 {
                prop_assert!(holds(x.over(y), &(&p / &q)));
            }
            let root = (x * x).root();
            prop_assert!(holds(root, &crate::arith::abs(&p)));
        }
    }

    #[test]
    fn what_is_unknown_decides_nothing() {
        let infinite = Float::point(f64::MAX) + Float::point(f64::MAX);
        for x in [Float::UNKNOWN, infinite * Float::ZERO, infinite - infinite, Float::point(1.0).over(Float::ZERO)] {
            assert!(!x.positive() && !x.nonzero() && (x.magnitude().is_nan() || x.magnitude() > 1.0), "{x:?}");
        }
    }
}
