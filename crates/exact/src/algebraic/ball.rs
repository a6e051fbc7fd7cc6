//! Complex discs with dyadic centres, and certified evaluation of a polynomial at such a centre.

use crate::arith::{Integer, Interval, Natural, Rational};
use malachite_base::num::arithmetic::traits::{DivRound, Sign};
use malachite_base::num::logic::traits::SignificantBits;
use malachite_base::rounding_modes::RoundingMode;
use std::cmp::Ordering;

/// The disc of centre `(re + i im) 2^exp` and radius `radius 2^exp`.
#[derive(Debug, Clone)]
pub(super) struct Ball {
    pub re: Integer,
    pub im: Integer,
    pub radius: Integer,
    pub exp: i64,
}

/// `x 2^shift`, rounded down for a negative shift.
pub(super) fn shifted(x: &Integer, shift: i64) -> Integer {
    if shift >= 0 { x << shift.unsigned_abs() } else { x >> shift.unsigned_abs() }
}

/// `x 2^exp` as a rational.
pub(super) fn dyadic(x: &Integer, exp: i64) -> Rational {
    Rational::from(x) << exp
}

fn magnitude(x: &Integer) -> &Natural {
    x.unsigned_abs_ref()
}

/// The absolute value.
pub(super) fn abs(x: &Integer) -> Integer {
    Integer::from(magnitude(x))
}

impl Ball {
    /// The smallest `e` with `|re| + |im| <= 2^e` for the centre.
    pub fn log_size(&self) -> i64 {
        self.exp + (magnitude(&self.re) + magnitude(&self.im)).significant_bits() as i64
    }

    /// The same centre on the grid that keeps `precision` bits of its size, rounded if coarser; the radius is dropped.
    pub fn regrid(&self, precision: i64) -> Self {
        let exp = self.log_size() - precision;
        let shift = self.exp - exp;
        Self { re: shifted(&self.re, shift), im: shifted(&self.im, shift), radius: Integer::from(0), exp }
    }

    /// The complex conjugate.
    pub fn conjugate(&self) -> Self {
        Self { im: -&self.im, ..self.clone() }
    }

    /// The disc moved by an integer.
    pub fn moved(mut self, by: &Integer) -> Self {
        if *by != 0 {
            let exp = self.exp.min(0);
            let shift = self.exp - exp;
            self = Self {
                re: shifted(&self.re, shift) + shifted(by, -exp),
                im: shifted(&self.im, shift),
                radius: shifted(&self.radius, shift),
                exp,
            };
        }
        self
    }

    /// Whether the radius is at most `2^t`.
    pub fn is_within(&self, t: i64) -> bool {
        self.radius == 0 || self.exp + self.radius.significant_bits() as i64 <= t
    }

    /// The ranges of the real and imaginary part.
    pub fn enclosure(&self) -> (Interval, Interval) {
        let range =
            |c: &Integer| Interval::new(dyadic(&(c - &self.radius), self.exp), dyadic(&(c + &self.radius), self.exp));
        let im = if self.im == 0 { Interval::point(Rational::from(0)) } else { range(&self.im) };
        (range(&self.re), im)
    }

    /// Whether the distance of the centres, in the maximum norm, is at least `a * self.radius + b * other.radius`.
    pub fn apart(&self, other: &Self, a: u32, b: u32) -> bool {
        let exp = self.exp.min(other.exp);
        let (s, o) = (self.exp - exp, other.exp - exp);
        let gap = |x: &Integer, y: &Integer| abs(&(shifted(x, s) - shifted(y, o)));
        let radii = shifted(&self.radius, s) * Integer::from(a) + shifted(&other.radius, o) * Integer::from(b);
        gap(&self.re, &other.re) >= radii || gap(&self.im, &other.im) >= radii
    }

    /// Whether this disc lies in the disc of `outer` with its radius multiplied by `factor`.
    pub fn inside(&self, outer: &Self, factor: u32) -> bool {
        let exp = self.exp.min(outer.exp);
        let (s, o) = (self.exp - exp, outer.exp - exp);
        let gap = |x: &Integer, y: &Integer| abs(&(shifted(x, s) - shifted(y, o)));
        let distance = gap(&self.re, &outer.re) + gap(&self.im, &outer.im);
        distance + shifted(&self.radius, s) <= shifted(&outer.radius, o) * Integer::from(factor)
    }

    /// The order of the real parts, when the discs show it.
    pub fn cmp_re(&self, other: &Self) -> Option<Ordering> {
        cmp_ranges(&self.re, &other.re, self, other)
    }

    /// The order of the imaginary parts, when the discs show it.
    pub fn cmp_im(&self, other: &Self) -> Option<Ordering> {
        cmp_ranges(&self.im, &other.im, self, other)
    }
}

fn cmp_ranges(x: &Integer, y: &Integer, a: &Ball, b: &Ball) -> Option<Ordering> {
    let exp = a.exp.min(b.exp);
    let (s, o) = (a.exp - exp, b.exp - exp);
    let difference = shifted(x, s) - shifted(y, o);
    let radii = shifted(&a.radius, s) + shifted(&b.radius, o);
    if difference > radii {
        Some(Ordering::Greater)
    } else if difference < -radii {
        Some(Ordering::Less)
    } else {
        None
    }
}

/// Fixed-point values of a polynomial and its derivative at a point `x` of the unit disc, each component with
/// `precision` fraction bits, all multiplied by one power of two. The errors bound the moduli.
pub(super) struct Values {
    value: (Integer, Integer),
    slope: (Integer, Integer),
    value_error: Integer,
    slope_error: Integer,
    precision: u64,
    log_size: i64,
    degree: usize,
}

/// Evaluates `f` and `f'` at the centre of `z`, whose grid says the working precision.
///
/// The coefficients are scaled by the size `2^e` of the point, so that every number stays in the unit range and the
/// absolute error of the fixed-point Horner scheme is as good as the relative one of floating point.
pub(super) fn evaluate(f: &[Integer], z: &Ball) -> Values {
    let e = z.log_size();
    let precision = u64::try_from((e - z.exp).max(1)).unwrap_or(1);
    let (xr, xi) = (&z.re, &z.im);
    let top = f
        .iter()
        .enumerate()
        .filter(|(_, c)| **c != 0)
        .map(|(k, c)| c.significant_bits() as i64 + e * k as i64)
        .max()
        .unwrap_or(0);
    let zero = || (Integer::from(0), Integer::from(0));
    let (mut y, mut d) = (zero(), zero());
    let real = *xi == 0;
    for (k, c) in f.iter().enumerate().rev() {
        if real {
            d.0 = ((d.0 * xr) >> precision) + &y.0;
            y.0 = (y.0 * xr) >> precision;
        } else {
            d = rotate(&d, xr, xi, precision);
            d.0 += &y.0;
            d.1 += &y.1;
            y = rotate(&y, xr, xi, precision);
        }
        y.0 += shifted(c, precision as i64 + e * k as i64 - top);
    }
    let n = f.len() as u64;
    Values {
        value: y,
        slope: d,
        value_error: Integer::from(3 * (n + 1)),
        slope_error: Integer::from(3 * (n + 2) * (n + 2)),
        precision,
        log_size: e,
        degree: f.len() - 1,
    }
}

fn rotate(y: &(Integer, Integer), xr: &Integer, xi: &Integer, precision: u64) -> (Integer, Integer) {
    ((&y.0 * xr - &y.1 * xi) >> precision, (&y.0 * xi + &y.1 * xr) >> precision)
}

impl Values {
    /// A radius, in units of the point's grid, such that the disc around the point contains a root:
    /// `n |f / f'|`, rounded up; `None` when the derivative may vanish.
    pub fn root_radius(&self) -> Option<Integer> {
        let numerator = abs(&self.value.0) + abs(&self.value.1) + &self.value_error;
        let (a, b) = (abs(&self.slope.0), abs(&self.slope.1));
        let denominator = a.max(b) - &self.slope_error;
        if denominator.sign() != Ordering::Greater {
            return None;
        }
        let scaled = (numerator * Integer::from(self.degree)) << self.precision;
        Some(scaled.div_round(denominator, RoundingMode::Ceiling).0)
    }

    /// Whether the value is too small to be told from 0.
    pub fn is_noise(&self) -> bool {
        abs(&self.value.0) + abs(&self.value.1) <= self.value_error
    }

    /// Whether the value at a real point is positive; `None` when it is too small to be told from 0.
    pub fn real_sign(&self) -> Option<bool> {
        (abs(&self.value.0) > self.value_error).then(|| self.value.0 > 0)
    }

    /// The Newton step `f / f'` in units of the point's grid; `None` when the computed derivative is 0.
    pub fn step(&self) -> Option<(Integer, Integer)> {
        let (a, b) = &self.value;
        let (c, d) = &self.slope;
        let norm = c * c + d * d;
        if norm == 0 {
            return None;
        }
        let re = ((a * c + b * d) << self.precision).div_round(&norm, RoundingMode::Nearest).0;
        let im = ((b * c - a * d) << self.precision).div_round(norm, RoundingMode::Nearest).0;
        Some((re, im))
    }

    /// The exponent of the point's grid.
    pub fn exp(&self) -> i64 {
        self.log_size - self.precision as i64
    }
}

/// The disc around the centre of `z` that certainly contains a root of `f`.
pub(super) fn root_disc(f: &[Integer], z: &Ball) -> Option<Ball> {
    let radius = evaluate(f, z).root_radius()?;
    Some(Ball { radius, ..z.clone() })
}
