use super::{Integer, Rational, abs};
use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
use std::ops::{Add, Mul, Neg, Sub};

/// A closed interval with rational end points, `lo <= hi`.
///
/// Operations return an interval that contains every result of the operation on members; they are exact
/// until [`Interval::outward`] rounds the end points outwards to a dyadic grid to keep them short.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interval {
    /// Lower end.
    pub lo: Rational,
    /// Upper end.
    pub hi: Rational,
}

impl Interval {
    /// The interval `[lo, hi]`; the ends are exchanged where they come in the wrong order.
    #[must_use]
    pub fn new(lo: Rational, hi: Rational) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self { lo: hi, hi: lo } }
    }

    /// The single point `x`.
    #[must_use]
    pub fn point(x: Rational) -> Self {
        Self { lo: x.clone(), hi: x }
    }

    /// `[-r, r]` for `r >= 0`.
    #[must_use]
    pub fn symmetric(r: Rational) -> Self {
        Self::new(-r.clone(), r)
    }

    /// `hi - lo`.
    #[must_use]
    pub fn width(&self) -> Rational {
        &self.hi - &self.lo
    }

    /// The middle.
    #[must_use]
    pub fn mid(&self) -> Rational {
        (&self.lo + &self.hi) / Rational::from(2)
    }

    /// `1` or `-1` when every member has that sign, `0` for the point 0, `None` otherwise.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::arith::{Interval, ratio};
    /// assert_eq!(Interval::new(ratio(1, 3), ratio(1, 2)).sign(), Some(1));
    /// assert_eq!(Interval::symmetric(ratio(1, 2)).sign(), None);
    /// ```
    #[must_use]
    pub fn sign(&self) -> Option<i32> {
        if self.lo > 0 {
            Some(1)
        } else if self.hi < 0 {
            Some(-1)
        } else if self.lo == 0 && self.hi == 0 {
            Some(0)
        } else {
            None
        }
    }

    /// Whether 0 is a member.
    #[must_use]
    pub fn contains_zero(&self) -> bool {
        self.lo <= 0 && self.hi >= 0
    }

    /// Whether the two intervals have no common member.
    #[must_use]
    pub fn disjoint(&self, other: &Self) -> bool {
        self.hi < other.lo || other.hi < self.lo
    }

    /// The largest absolute value of a member.
    #[must_use]
    pub fn magnitude(&self) -> Rational {
        abs(&self.lo).max(abs(&self.hi))
    }

    /// The interval of the squares.
    #[must_use]
    pub fn square(&self) -> Self {
        let (a, b) = (&self.lo * &self.lo, &self.hi * &self.hi);
        if self.contains_zero() { Self::new(Rational::from(0), a.max(b)) } else { Self::new(a, b) }
    }

    /// Both ends rounded outwards to multiples of `2^-bits`.
    #[must_use]
    pub fn outward(&self, bits: u64) -> Self {
        let scale = Rational::from(Integer::from(1) << bits);
        let lo = Rational::from((&self.lo * &scale).floor()) / &scale;
        let hi = Rational::from((&self.hi * &scale).ceiling()) / &scale;
        Self { lo, hi }
    }
}

impl Add for &Interval {
    type Output = Interval;
    fn add(self, other: Self) -> Interval {
        Interval { lo: &self.lo + &other.lo, hi: &self.hi + &other.hi }
    }
}

impl Sub for &Interval {
    type Output = Interval;
    fn sub(self, other: Self) -> Interval {
        Interval { lo: &self.lo - &other.hi, hi: &self.hi - &other.lo }
    }
}

impl Neg for &Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { lo: -&self.hi, hi: -&self.lo }
    }
}

impl Mul for &Interval {
    type Output = Interval;
    fn mul(self, other: Self) -> Interval {
        let products = [&self.lo * &other.lo, &self.lo * &other.hi, &self.hi * &other.lo, &self.hi * &other.hi];
        let mut lo = products[0].clone();
        let mut hi = products[0].clone();
        for p in &products[1..] {
            if *p < lo {
                lo.clone_from(p);
            }
            if *p > hi {
                hi.clone_from(p);
            }
        }
        Interval { lo, hi }
    }
}

impl Mul<&Rational> for &Interval {
    type Output = Interval;
    fn mul(self, factor: &Rational) -> Interval {
        Interval::new(&self.lo * factor, &self.hi * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn rounding_goes_outwards() {
        let x = Interval::new(ratio(-1, 3), ratio(1, 3)).outward(3);
        assert_eq!(x, Interval::new(ratio(-3, 8), ratio(3, 8)));
    }

    #[test]
    fn product_of_mixed_signs() {
        let x = &Interval::new(ratio(-1, 1), ratio(2, 1)) * &Interval::new(ratio(-3, 1), ratio(1, 1));
        assert_eq!(x, Interval::new(ratio(-6, 1), ratio(3, 1)));
        assert_eq!(x.sign(), None);
    }
}
