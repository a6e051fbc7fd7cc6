use super::{Field, Ordered, Ring};
use crate::arith::{Integer, Interval, Rational};
use malachite_base::num::arithmetic::traits::{Ceiling, Floor, ShrRound};
use malachite_base::rounding_modes::RoundingMode;

/// An enclosure `[lo, hi] / 2^bits` of a real number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fixed {
    /// Lower end.
    pub lo: Integer,
    /// Upper end.
    pub hi: Integer,
}

/// Enclosures of real numbers with one number of binary places. Every operation rounds outwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Enclosures {
    /// Binary places.
    pub bits: u64,
}

fn floor(x: Integer, bits: u64) -> Integer {
    x.shr_round(bits, RoundingMode::Floor).0
}

fn ceiling(x: Integer, bits: u64) -> Integer {
    x.shr_round(bits, RoundingMode::Ceiling).0
}

impl Enclosures {
    /// Enclosures with so many binary places.
    #[must_use]
    pub fn new(bits: u64) -> Self {
        Self { bits }
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
    ///
    /// # Panics
    /// If `n` is 0 or `k` is over `n`.
    #[must_use]
    pub fn twice_cosine(&self, k: usize, n: usize) -> Fixed {
        let work = Self { bits: self.bits + 32 };
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

impl Ring for Enclosures {
    type E = Fixed;

    fn integer(&self, n: &Integer) -> Fixed {
        let n = n << self.bits;
        Fixed { lo: n.clone(), hi: n }
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

    fn is_zero(&self, a: &Fixed) -> Option<bool> {
        self.sign(a).map(|s| s == 0)
    }
}

impl Field for Enclosures {
    fn rational(&self, q: &Rational) -> Fixed {
        let scaled = q * Rational::from(Integer::from(1) << self.bits);
        Fixed { lo: (&scaled).floor(), hi: (&scaled).ceiling() }
    }

    fn inv(&self, a: &Fixed) -> Option<Fixed> {
        self.sign(a).filter(|s| *s != 0)?;
        let one = Rational::from(Integer::from(1) << (2 * self.bits));
        let (low, high) = (&one / Rational::from(&a.hi), one / Rational::from(&a.lo));
        Some(Fixed { lo: (&low).floor(), hi: (&high).ceiling() })
    }

    fn scale(&self, a: &Fixed, q: &Rational) -> Fixed {
        let ends = [Rational::from(&a.lo) * q, Rational::from(&a.hi) * q];
        let [x, y] = if *q >= 0 { ends } else { [ends[1].clone(), ends[0].clone()] };
        Fixed { lo: (&x).floor(), hi: (&y).ceiling() }
    }
}

impl Ordered for Enclosures {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::poly::Poly;

    #[test]
    fn cosines_satisfy_their_equations() {
        // 2cos(2π/5) is the positive root of x² + x − 1, 2cos(2π/7) of x³ + x² − 2x − 1.
        let field = Enclosures::new(160);
        for (k, n, f) in [(1, 5, vec![-1, 1, 1]), (1, 7, vec![-1, -2, 1, 1]), (3, 7, vec![-1, -2, 1, 1])] {
            let f = Poly::new(f.into_iter().map(|c| ratio(c, 1)).collect());
            let value = field.eval(&f, &field.twice_cosine(k, n));
            assert!(value.lo <= 0 && value.hi >= 0, "{k}/{n}");
            assert!(&value.hi - &value.lo < 1_000_000, "narrow");
        }
        assert!((field.to_f64(&field.twice_cosine(1, 256)) - 1.999_397_637_392_74).abs() < 1e-12);
        assert!((field.to_f64(&field.twice_cosine(49, 100)) + 1.996_053_456_856_543).abs() < 1e-12);
    }

    #[test]
    fn enclosures_enclose() {
        let field = Enclosures::new(64);
        let third = field.rational(&ratio(1, 3));
        let product = field.mul(&third, &field.rational(&ratio(-3, 1)));
        assert!(product.lo <= -(Integer::from(1) << 64_u64) && product.hi >= -(Integer::from(1) << 64_u64));
        let back = field.inv(&third).unwrap();
        assert!(field.to_interval(&back).lo <= 3 && field.to_interval(&back).hi >= 3);
        assert_eq!(field.inv(&field.sub(&product, &field.rational(&ratio(-1, 1)))), None);
    }
}
