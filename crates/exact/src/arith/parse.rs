use super::{Natural, Rational};
use malachite_base::num::arithmetic::traits::Pow;
use std::str::FromStr;
use thiserror::Error;

/// Longest number, in digits of numerator, denominator and exponent together, that is read.
pub const MAX_DIGITS: usize = 10_000;

/// Why a number could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ParseNumberError {
    /// Not of the form `12`, `-3/4`, `0.25` or `1.5e-3`.
    #[error("`{0}` is not a number; write an integer, a fraction such as `3/4`, or a decimal such as `0.25`")]
    Malformed(String),
    /// A fraction with denominator 0.
    #[error("`{0}` divides by zero")]
    ZeroDenominator(String),
    /// More than [`MAX_DIGITS`] digits.
    #[error("a number of {0} digits is over the limit of {MAX_DIGITS}")]
    TooLong(usize),
    /// An exponent of ten beyond [`MAX_DIGITS`].
    #[error("`{0}` has an exponent beyond the limit of {MAX_DIGITS}")]
    Exponent(String),
}

/// Reads an exact rational: `12`, `-3/4`, `0.25` (exactly 1/4), `1.5e-3`.
///
/// # Errors
/// [`ParseNumberError`] for anything else, a zero denominator, or too many digits.
///
/// # Cost
/// Quasi-linear in the number of digits.
///
/// # Examples
/// ```
/// use secant_exact::arith::{parse_rational, ratio};
/// assert_eq!(parse_rational("-3/12"), Ok(ratio(-1, 4)));
/// assert_eq!(parse_rational("0.125"), Ok(ratio(1, 8)));
/// assert!(parse_rational("1/0").is_err());
/// ```
pub fn parse_rational(text: &str) -> Result<Rational, ParseNumberError> {
    let trimmed = text.trim();
    if trimmed.len() > MAX_DIGITS + 8 {
        return Err(ParseNumberError::TooLong(trimmed.len()));
    }
    let malformed = || match trimmed.rsplit_once(['e', 'E']) {
        Some((_, e)) if is_long_exponent(e) => ParseNumberError::Exponent(trimmed.to_owned()),
        _ => ParseNumberError::Malformed(trimmed.to_owned()),
    };
    if let Some((p, q)) = trimmed.split_once('/') {
        let p = decimal(p.trim()).ok_or_else(malformed)?;
        let q = decimal(q.trim()).ok_or_else(malformed)?;
        if q == 0 {
            return Err(ParseNumberError::ZeroDenominator(trimmed.to_owned()));
        }
        return Ok(p / q);
    }
    decimal(trimmed).ok_or_else(malformed)
}

/// Whether an exponent is a whole number that is too large to be read.
fn is_long_exponent(text: &str) -> bool {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let value: Option<usize> = digits.parse().ok();
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()) && value.is_none_or(|e| e > MAX_DIGITS)
}

fn decimal(text: &str) -> Option<Rational> {
    let (negative, body) = match text.as_bytes().first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    let (mantissa, exponent) = match body.split_once(['e', 'E']) {
        Some((m, e)) => (m, e.parse::<i32>().ok()?),
        None => (body, 0),
    };
    if exponent.unsigned_abs() as usize > MAX_DIGITS {
        return None;
    }
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let scale = i64::from(exponent) - i64::try_from(fraction.len()).ok()?;
    let magnitude = Rational::from(Natural::from_str(&digits).ok()?) * Rational::from(10).pow(scale);
    Some(if negative { -magnitude } else { magnitude })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn reads_every_form_exactly() {
        for (text, p, q) in [
            ("3/4", 3, 4),
            ("-1", -1, 1),
            ("0.25", 1, 4),
            ("-.5", -1, 2),
            ("1.5e-3", 3, 2000),
            ("2e2", 200, 1),
            ("+6/-4", -3, 2),
            ("0.5/0.25", 2, 1),
        ] {
            assert_eq!(parse_rational(text), Ok(ratio(p, q)), "{text}");
        }
    }

    #[test]
    fn refuses_what_is_no_number() {
        for text in ["", "a", "1/", "/2", "1//2", "NaN", "inf", "1e", "--1", "1 2", "0x10", "1/2/3"] {
            assert!(matches!(parse_rational(text), Err(ParseNumberError::Malformed(_))), "{text}");
        }
        assert!(matches!(parse_rational("1/0"), Err(ParseNumberError::ZeroDenominator(_))));
        for text in ["1e10001", "1e999999999999999999999", "-1/2e-20000"] {
            assert!(matches!(parse_rational(text), Err(ParseNumberError::Exponent(_))), "{text}");
        }
        assert!(matches!(parse_rational(&"9".repeat(20_000)), Err(ParseNumberError::TooLong(_))));
    }
}
