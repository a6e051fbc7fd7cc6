//! Logarithms and exponentials of rational numbers, enclosed: integers over a power of two, rounded towards the side that is wanted.

use super::{Integer, Interval, Natural, Rational};
use malachite_base::num::arithmetic::traits::UnsignedAbs;
use malachite_base::num::basic::traits::Zero;
use malachite_base::num::conversion::traits::RoundingFrom;
use malachite_base::num::logic::traits::SignificantBits;
use malachite_base::rounding_modes::RoundingMode;

/// Binary places of logarithms.
const PLACES: u64 = 96;

/// An enclosure of the natural logarithm of a positive number, of width about `2^-60` for numbers of moderate size; `None` for
/// others.
///
/// # Examples
/// ```
/// use secant_exact::arith::{ln, ratio, to_f64};
/// let two = ln(&ratio(2, 1)).unwrap();
/// assert!(to_f64(&two.lo) <= std::f64::consts::LN_2 && to_f64(&two.width()) < 1e-18);
/// assert!(ln(&ratio(0, 1)).is_none());
/// ```
#[must_use]
pub fn ln(x: &Rational) -> Option<Interval> {
    if *x <= 0 {
        return None;
    }
    if *x == 1 {
        return Some(Interval::point(Rational::from(0)));
    }
    // x = 2^exponent p/q with p/q from 1 to 4: 2 artanh z with z = (p - q)/(p + q), at most 3/5.
    let (p, q) = (x.numerator_ref(), x.denominator_ref());
    let exponent = i64::try_from(p.significant_bits()).ok()? - i64::try_from(q.significant_bits()).ok()? - 1;
    let (p, q) = if exponent > 0 { (p.clone(), q << exponent) } else { (p << -exponent, q.clone()) };
    let z = (&p - &q) << PLACES;
    let part = artanh(&(z / (p + q)));
    let third = artanh(&((Natural::from(1u32) << PLACES) / Natural::from(3u32)));
    let enclosed = |[lo, hi]: [Natural; 2]| Interval::new(dyadic(lo.into(), PLACES - 1), dyadic(hi.into(), PLACES - 1));
    Some(&enclosed(part) + &(&enclosed(third) * &Rational::from(exponent)))
}

/// Bounds of `artanh z` for all numbers from `z` to `z + 1` units, at most about 3/5: the terms `z^(2k+1)/(2k+1)`, and a geometric
/// bound for the rest.
fn artanh(z: &Natural) -> [Natural; 2] {
    [0u32, 1].map(|up| {
        let up = Natural::from(up);
        let product = |a: &Natural, b: &Natural| ((a * b) >> PLACES) + &up;
        let mut power = z + &up;
        let square = product(&power, &power);
        let mut sum = Natural::ZERO;
        for odd in (1u32..).step_by(2) {
            sum += &power / Natural::from(odd) + &up;
            power = product(&power, &square);
            // All that follows is at most power (1 + square + square² + …), and square at most 2/5.
            if power <= 4u32 {
                return sum + power * up * Natural::from(2u32);
            }
        }
        sum
    })
}

/// An enclosure of the exponentials of the members of an interval.
///
/// # Examples
/// ```
/// use secant_exact::arith::{Interval, exp, ln, ratio};
/// let again = exp(&ln(&ratio(7, 3)).unwrap());
/// assert!(again.lo <= ratio(7, 3) && again.hi >= ratio(7, 3) && again.width() < ratio(1, 1 << 50));
/// ```
#[must_use]
pub fn exp(x: &Interval) -> Interval {
    Interval { lo: exp_bound(&x.lo, false), hi: exp_bound(&x.hi, true) }
}

/// A bound of `e^x = (e^(x/2^k))^(2^k)`, `|x/2^k| < 1/2`, from above or from below.
fn exp_bound(x: &Rational, up: bool) -> Rational {
    if *x == 0 {
        return Rational::from(1);
    }
    let size = x.numerator_ref().significant_bits() + 2;
    let doublings = size.saturating_sub(x.denominator_ref().significant_bits());
    let places = 128 + doublings;
    let mode = if up { RoundingMode::Ceiling } else { RoundingMode::Floor };
    let small = Integer::rounding_from(x << (places - doublings), mode).0;
    const TERMS: u32 = 32;
    let (mut term, mut sum) = (Integer::from(1) << places, Integer::ZERO);
    for k in 1..=TERMS {
        sum += &term;
        term = ((term * &small) >> places) / Integer::from(k);
    }
    // Every term is off by less than 3 units, and the rest at most twice the first term left out.
    let error = Integer::from(term.unsigned_abs() * Natural::from(2u32)) + Integer::from(3 * TERMS + 8);
    let mut value = if up { sum + error } else { sum - error };
    for _ in 0..doublings {
        value = ((&value * &value) >> places) + Integer::from(u8::from(up));
    }
    dyadic(value, places)
}

fn dyadic(numerator: Integer, places: u64) -> Rational {
    Rational::from(numerator) >> places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{ratio, to_f64};

    #[test]
    fn enclosures_hold_the_floats() {
        for (p, q) in [(1, 3), (2, 1), (7, 5), (999, 1000), (1, 1_000_000), (123_456, 7)] {
            let x = ratio(p, q);
            let (own, float) = (ln(&x).unwrap(), to_f64(&x).ln());
            assert!(
                to_f64(&own.lo) <= float + 1e-14 && float <= to_f64(&own.hi) + 1e-14 && own.width() < ratio(1, 1 << 50)
            );
            let back = exp(&own);
            assert!(back.lo <= x && x <= back.hi, "{x}");
            assert!(to_f64(&(back.width() / &x)) < 1e-9, "{x}");
        }
        assert_eq!(ln(&ratio(1, 1)).unwrap(), Interval::point(ratio(0, 1)));
        assert_eq!(exp(&Interval::point(ratio(0, 1))), Interval::point(ratio(1, 1)));
        for y in [ratio(-20, 1), ratio(-1, 3), ratio(0, 1), ratio(5, 2)] {
            let (own, float) = (exp(&Interval::point(y.clone())), to_f64(&y).exp());
            assert!(to_f64(&own.lo) <= float * (1.0 + 1e-12) && float <= to_f64(&own.hi) * (1.0 + 1e-12), "{y}");
        }
    }
}
