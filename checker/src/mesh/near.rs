//! Real numbers known up to an error, in words of the machine: what is too large for them is not known.

use crate::vertex::ball::Ball;

/// Binary places.
pub const PLACES: usize = 56;
/// Bits of what is kept: products of two such numbers have room for some sums.
const SIZE: usize = 62;

/// All numbers within `error` of `x`, in units of `2^-56`; of a number with the largest error nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Near {
    x: i128,
    error: i128,
}

impl Near {
    /// A number of which nothing is known.
    pub const UNKNOWN: Self = Self { x: 0, error: i128::MAX };
    /// The number 0.
    pub const ZERO: Self = Self { x: 0, error: 0 };
    /// The number 1.
    pub const ONE: Self = Self { x: 1 << PLACES, error: 0 };

    fn new(x: i128, error: i128) -> Self {
        if x.abs() < 1 << SIZE && error < 1 << SIZE { Self { x, error } } else { Self::UNKNOWN }
    }

    /// Both parts of a complex number.
    pub fn of(z: &Ball) -> [Self; 2] {
        match z.units(PLACES, SIZE) {
            Some((x, y, error)) => [Self::new(x, error), Self::new(y, error)],
            None => [Self::UNKNOWN; 2],
        }
    }

    /// Whether anything is known.
    pub fn known(self) -> bool {
        self.error < 1 << SIZE
    }

    /// The middle, in units.
    pub fn middle(self) -> i128 {
        self.x
    }

    /// The error, in units.
    pub fn error(self) -> i128 {
        self.error
    }

    /// An upper bound of the absolute value, in units.
    pub fn at_most(self) -> Option<i128> {
        self.known().then(|| self.x.abs() + self.error)
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        if self.known() && other.known() {
            Self::new(self.x + other.x, self.error + other.error)
        } else {
            Self::UNKNOWN
        }
    }

    /// The negative number.
    pub fn negative(self) -> Self {
        Self { x: -self.x, ..self }
    }

    /// The difference.
    pub fn minus(self, other: Self) -> Self {
        self.plus(other.negative())
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        if !(self.known() && other.known()) {
            return Self::UNKNOWN;
        }
        let error = self.x.abs() * other.error + self.error * (other.x.abs() + other.error);
        Self::new((self.x * other.x) >> PLACES, (error >> PLACES) + 2)
    }

    /// The quotient: `|a/b − x/y| ≤ (e + |x/y| e')/(|y| − e')`.
    pub fn over(self, other: Self) -> Self {
        if !(self.known() && other.known() && other.x.abs() > other.error) {
            return Self::UNKNOWN;
        }
        let quotient = (self.x << PLACES) / other.x;
        if quotient.abs() >= 1 << SIZE {
            return Self::UNKNOWN;
        }
        let low = other.x.abs() - other.error;
        Self::new(quotient, ((self.error << PLACES) + (quotient.abs() + 1) * other.error) / low + 3)
    }

    /// The same times `2^by`.
    pub fn enlarged(self, by: u32) -> Self {
        if !self.known() || by as usize >= SIZE {
            return Self::UNKNOWN;
        }
        Self::new(self.x << by, self.error << by)
    }

    /// `Σ weight · value`, divided by a positive number. Weights are below `2^40`.
    pub fn combined(terms: impl IntoIterator<Item = (i64, Self)>, over: i64) -> Self {
        let (mut x, mut error) = (0_i128, 0_i128);
        for (weight, value) in terms {
            if !value.known() || weight.unsigned_abs() >= 1 << 40 {
                return Self::UNKNOWN;
            }
            // A sum of fewer than 2^24 such terms; meshes have no more points.
            x += i128::from(weight) * value.x;
            error += i128::from(weight.abs()) * value.error;
        }
        let over = i128::from(over);
        Self::new(x.div_euclid(over), error / over + i128::from(over > 1) * 2)
    }

    /// The sign, 0 where it is not certain.
    pub fn sign(self) -> i32 {
        if !self.known() {
            return 0;
        }
        i32::from(self.x > self.error) - i32::from(-self.x > self.error)
    }
}

/// A point of space.
pub type Point = [Near; 3];

/// The difference of two points.
pub fn difference(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|k| a[k].minus(b[k]))
}

/// The scalar product.
pub fn dot(a: &Point, b: &Point) -> Near {
    a[0].times(b[0]).plus(a[1].times(b[1])).plus(a[2].times(b[2]))
}

/// The point in the same places of several points.
pub fn mixed(terms: &[(i64, &Point)], over: i64) -> Point {
    std::array::from_fn(|k| Near::combined(terms.iter().map(|(w, p)| (*w, p[k])), over))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Q, whole};
    use num_traits::Signed;

    fn value(x: i128) -> Q {
        Q::new(x.into(), num_bigint::BigInt::from(1) << PLACES)
    }

    fn near(p: i64, q: i64) -> Near {
        Near::of(&Ball::real(&(whole(p) / whole(q))))[0]
    }

    fn holds(x: Near, q: &Q) -> bool {
        x.known() && (value(x.middle()) - q).abs() <= value(x.error()) && x.error() < 1 << 12
    }

    #[test]
    fn operations_enclose() {
        for (p, q, r, s) in [(1, 3, -7, 9), (-22, 7, 5, 11), (1, 1000, 13, 17), (11, 1, 1, 64), (-1, 7, -1, 13)] {
            let (a, b) = (whole(p) / whole(q), whole(r) / whole(s));
            let (x, y) = (near(p, q), near(r, s));
            assert!(holds(x.plus(y), &(&a + &b)) && holds(x.minus(y), &(&a - &b)) && holds(x.times(y), &(&a * &b)));
            assert!(holds(x.enlarged(1), &(&a * whole(2))) && x.sign() == p.signum() as i32);
            if let Some(size) = x.over(y).at_most() {
                assert!(holds(x.over(y), &(&a / &b)) && value(size) >= (&a / &b).abs());
            }
            assert!(holds(Near::combined([(3, x), (-5, y)], 7), &((a * whole(3) - b * whole(5)) / whole(7))));
        }
    }

    #[test]
    fn what_is_too_large_is_not_known() {
        let large = near(60, 1);
        let all = [
            large.plus(large),
            large.times(large),
            large.over(near(1, 2)),
            near(1, 1).over(Near::ZERO),
            near(1, 1).enlarged(62),
            Near::combined([(2, large)], 1),
            Near::UNKNOWN.plus(Near::ONE),
            Near::UNKNOWN.times(Near::ZERO),
            Near::UNKNOWN.negative(),
        ];
        for x in all {
            assert!(!x.known() && x.sign() == 0 && x.at_most().is_none(), "{x:?}");
        }
    }
}
