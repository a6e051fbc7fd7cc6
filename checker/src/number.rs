//! Rational numbers, how they are read, and the budget that keeps the work finite.

use crate::Rejected;
use num_bigint::BigInt;
pub use num_rational::BigRational as Q;
use num_traits::{One, Zero};
use std::cell::Cell;

/// Longest number in digits, exponents included.
pub const MAX_DIGITS: usize = 10_000;
/// How much arithmetic a check may do; a product of two numbers of `w` words counts `16 + w²`.
const BUDGET: u64 = 4_000_000_000;

thread_local! { static SPENT: Cell<u64> = const { Cell::new(0) }; }

/// Begins a check with a full budget.
pub fn refill() {
    SPENT.set(0);
}

/// Takes the cost of `count` operations on numbers of at most `bits` bits out of the budget.
pub fn spend(count: usize, bits: u64) -> Result<(), Rejected> {
    let words = bits / 64;
    let cost = (count as u64).saturating_mul(words.saturating_mul(words).saturating_add(16));
    let total = SPENT.get().saturating_add(cost);
    SPENT.set(total);
    if total > BUDGET { crate::reject("limit", "", "the check needs more arithmetic than is allowed") } else { Ok(()) }
}

/// The size of a number in bits.
pub fn bits(x: &Q) -> u64 {
    x.numer().bits() + x.denom().bits()
}

/// A small whole number.
pub fn whole(k: i64) -> Q {
    Q::from_integer(BigInt::from(k))
}

/// Reads a rational number in canonical form: lowest terms, no superfluous sign, zero or denominator.
pub fn canonical(text: &str) -> Option<Q> {
    if text.len() > MAX_DIGITS {
        return None;
    }
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let digits = numerator.strip_prefix('-').unwrap_or(numerator);
    let plain = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    if !plain(digits) || !plain(denominator) {
        return None;
    }
    let (p, q): (BigInt, BigInt) = (numerator.parse().ok()?, denominator.parse().ok()?);
    if q.is_zero() {
        return None;
    }
    let number = Q::new(p, q);
    (number.to_string() == text).then_some(number)
}

/// Reads a number of a case file: `12`, `-3/4`, `0.25` (exactly 1/4), `1.5e-3`, `0.5/0.25`.
pub fn decimal_fraction(text: &str) -> Option<Q> {
    let text = text.trim();
    if text.len() > MAX_DIGITS {
        return None;
    }
    match text.split_once('/') {
        Some((p, q)) => {
            let q = decimal(q.trim())?;
            if q.is_zero() { None } else { Some(decimal(p.trim())? / q) }
        }
        None => decimal(text),
    }
}

fn decimal(text: &str) -> Option<Q> {
    let body = text.strip_prefix(['-', '+']).unwrap_or(text);
    let (mantissa, exponent) = match body.split_once(['e', 'E']) {
        Some((m, e)) => (m, e.parse::<i32>().ok()?),
        None => (body, 0),
    };
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{before}{after}");
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let scale = i64::from(exponent) - i64::try_from(after.len()).ok()?;
    if scale.unsigned_abs() as usize > 2 * MAX_DIGITS {
        return None;
    }
    let power = num_traits::pow(BigInt::from(10), scale.unsigned_abs() as usize);
    let digits: BigInt = digits.parse().ok()?;
    let magnitude = if scale < 0 { Q::new(digits, power) } else { Q::new(digits * power, BigInt::one()) };
    Some(if text.starts_with('-') { -magnitude } else { magnitude })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn canonical_numbers_only() {
        for text in ["0", "1", "-3/4", "12/5"] {
            assert_eq!(canonical(text).unwrap().to_string(), text);
        }
        for text in ["", "-0", "+1", "2/4", "1/1", "1/0", "01", "1/-2", "1/02", "0.5", " 1", "--1", "1/2/3"] {
            assert!(canonical(text).is_none(), "{text}");
        }
    }

    #[test]
    fn decimals_are_exact() {
        for (text, p, q) in [("0.25", 1, 4), ("-.5", -1, 2), ("1.5e-3", 3, 2000), ("+6/-4", -3, 2), ("2e2", 200, 1)] {
            assert_eq!(decimal_fraction(text).unwrap(), Q::new(p.into(), q.into()), "{text}");
        }
        for text in ["", "a", "1/0", "1//2", "nan", "inf", "1e", "0x1", "1e99999999"] {
            assert!(decimal_fraction(text).is_none(), "{text}");
        }
    }
}
