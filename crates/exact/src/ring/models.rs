use super::{Field, Ordered, Ring};
use crate::arith::{Integer, Rational};
use malachite_base::num::arithmetic::traits::{Abs, Ceiling, DivRound, Floor, ShrRound};
use malachite_base::rounding_modes::RoundingMode;

/// The functions within `rest` of `mid + slope t` for all `t` from -1 to 1; all three in units of `2^-bits`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Model {
    /// The value in the middle.
    pub mid: Integer,
    /// The slope.
    pub slope: Integer,
    /// The distance, not negative.
    pub rest: Integer,
}

/// Functions of a parameter on a short interval, enclosed by their first two terms and a bound of the rest (Taylor models of
/// order one). The rest of a product is of second order in the length of the interval.
///
/// Source: K. Makino, M. Berz, *Taylor models and other validated functional inclusion methods*, Int. J. Pure Appl. Math. 4
/// (2003).
///
/// ```
/// use secant_exact::arith::ratio;
/// use secant_exact::ring::{Models, Ordered, Ring};
///
/// // x (1 − x) is above 6/25 for x from 41/100 to 59/100; at 1/2 it is 1/4.
/// let k = Models::new(64);
/// let x = k.parameter(&ratio(1, 2), &ratio(9, 100));
/// let value = k.mul(&x, &k.sub(&k.one(), &x));
/// let below = |p, q| k.sign(&k.sub(&value, &secant_exact::ring::Field::rational(&k, &ratio(p, q))));
/// assert_eq!((below(6, 25), below(1, 4)), (Some(1), None));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Models {
    /// Binary places.
    pub bits: u64,
}

impl Models {
    /// Models with so many binary places.
    #[must_use]
    pub fn new(bits: u64) -> Self {
        Self { bits }
    }

    /// The parameter itself on the interval of this middle and half its length.
    #[must_use]
    pub fn parameter(&self, mid: &Rational, half: &Rational) -> Model {
        self.linear(mid, half, &Rational::from(0))
    }

    /// The functions within `rest` of `mid + slope t`.
    #[must_use]
    pub fn linear(&self, mid: &Rational, slope: &Rational, rest: &Rational) -> Model {
        let unit = Rational::from(self.unit());
        let near = |q: &Rational| {
            let scaled = q * &unit;
            let floor = (&scaled).floor();
            let exact = floor == scaled;
            (floor, Integer::from(u8::from(!exact)))
        };
        let ((mid, a), (slope, b)) = (near(mid), near(slope));
        Model { mid, slope, rest: (rest * unit).ceiling() + a + b }
    }

    /// A bound of the modulus, in units of `2^-bits`.
    #[must_use]
    pub fn bound(&self, a: &Model) -> Integer {
        (&a.mid).abs() + (&a.slope).abs() + &a.rest
    }

    /// The constant functions between `-size` and `size`, in units of `2^-bits`.
    #[must_use]
    pub fn within(&self, size: Integer) -> Model {
        Model { mid: Integer::from(0), slope: Integer::from(0), rest: size }
    }

    /// The number 1 in units of `2^-bits`.
    #[must_use]
    pub fn unit(&self) -> Integer {
        Integer::from(1) << self.bits
    }

    /// The value in the middle as a float, for proposals.
    #[must_use]
    pub fn to_f64(&self, a: &Model) -> f64 {
        crate::arith::to_f64(&Rational::from_integers(a.mid.clone(), self.unit()))
    }

    fn down(&self, x: Integer) -> Integer {
        x.shr_round(self.bits, RoundingMode::Floor).0
    }

    fn up(&self, x: Integer) -> Integer {
        x.shr_round(self.bits, RoundingMode::Ceiling).0
    }
}

impl Ring for Models {
    type E = Model;

    fn integer(&self, n: &Integer) -> Model {
        Model { mid: n << self.bits, slope: Integer::from(0), rest: Integer::from(0) }
    }

    fn add(&self, a: &Model, b: &Model) -> Model {
        Model { mid: &a.mid + &b.mid, slope: &a.slope + &b.slope, rest: &a.rest + &b.rest }
    }

    fn sub(&self, a: &Model, b: &Model) -> Model {
        Model { mid: &a.mid - &b.mid, slope: &a.slope - &b.slope, rest: &a.rest + &b.rest }
    }

    fn mul(&self, a: &Model, b: &Model) -> Model {
        let mid = self.down(&a.mid * &b.mid);
        let slope = self.down(&a.mid * &b.slope + &a.slope * &b.mid);
        let (am, a_s, bm, bs) = ((&a.mid).abs(), (&a.slope).abs(), (&b.mid).abs(), (&b.slope).abs());
        let mut rest = &a_s * &bs;
        if b.rest != 0 {
            rest += &b.rest * (am + a_s + &a.rest);
        }
        if a.rest != 0 {
            rest += &a.rest * (bm + bs);
        }
        Model { mid, slope, rest: self.up(rest) + Integer::from(2) }
    }

    fn is_zero(&self, a: &Model) -> Option<bool> {
        self.sign(a).map(|s| s == 0)
    }
}

impl Field for Models {
    fn rational(&self, q: &Rational) -> Model {
        self.linear(q, &Rational::from(0), &Rational::from(0))
    }

    fn inv(&self, a: &Model) -> Option<Model> {
        self.sign(a).filter(|s| *s != 0)?;
        let square = Integer::from(1) << (2 * self.bits);
        let mid = square.div_round(&a.mid, RoundingMode::Nearest).0;
        let slope = -self.down(self.down(&mid * &mid) * &a.slope);
        let near = Model { mid, slope, rest: Integer::from(0) };
        // a · near = 1 + δ, so that 1/a = near/(1 + δ).
        let error = self.bound(&self.sub(&self.mul(a, &near), &self.one()));
        let left = self.unit() - &error;
        if left <= 0 {
            return None;
        }
        let rest = (self.bound(&near) * error).div_round(left, RoundingMode::Ceiling).0;
        Some(Model { rest, ..near })
    }
}

impl Ordered for Models {
    fn sign(&self, a: &Model) -> Option<i32> {
        let spread = (&a.slope).abs() + &a.rest;
        if (&a.mid).abs() > spread {
            Some(if a.mid > 0 { 1 } else { -1 })
        } else if a.mid == 0 && spread == 0 {
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

    /// Whether the model holds a value at `t`.
    fn holds(k: &Models, m: &Model, t: &Rational, value: &Rational) -> bool {
        let unit = Rational::from(k.unit());
        let line = (Rational::from(&m.mid) + Rational::from(&m.slope) * t) / &unit;
        let distance = crate::arith::abs(&(line - value));
        distance <= Rational::from(&m.rest) / unit
    }

    #[test]
    fn models_enclose_rational_functions() {
        let k = Models::new(40);
        for (mid, half) in [(ratio(1, 3), ratio(1, 7)), (ratio(-5, 7), ratio(1, 1000)), (ratio(2, 1), ratio(1, 2))] {
            let x = k.parameter(&mid, &half);
            // (x² − 3x + 1/7)/(x + 9/4), and its cube.
            let top = k.add(&k.sub(&k.mul(&x, &x), &k.scale(&x, &ratio(3, 1))), &k.rational(&ratio(1, 7)));
            let f = k.mul(&top, &k.inv(&k.add(&x, &k.rational(&ratio(9, 4)))).unwrap());
            let cube = k.mul(&k.mul(&f, &f), &f);
            for i in -10..=10 {
                let t = ratio(i, 10);
                let p = &mid + &half * &t;
                let value = (&p * &p - ratio(3, 1) * &p + ratio(1, 7)) / (&p + ratio(9, 4));
                assert!(holds(&k, &f, &t, &value), "{mid} {i}");
                assert!(holds(&k, &cube, &t, &(&value * &value * &value)), "{mid} {i}");
            }
        }
        assert_eq!(k.inv(&k.parameter(&ratio(1, 10), &ratio(1, 5))), None);
        let small = k.parameter(&ratio(1, 10), &ratio(1, 5));
        assert_eq!((k.sign(&small), k.sign(&k.zero())), (None, Some(0)));
    }
}
