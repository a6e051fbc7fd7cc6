//! Rational numbers, how they are read, and the budget that keeps the work finite.

use super::{Checked, need};
use num_bigint::BigInt;
use num_integer::Integer;
pub use num_rational::BigRational as Q;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cell::Cell;

/// Longest number in digits, exponents included.
pub const MAX_DIGITS: usize = 10_000;
/// How much arithmetic a check may do; a product of two numbers of `w` words counts `16 + w²`.
const BUDGET: u64 = 4_000_000_000;

/// It is asked whether to go on each time when `2^LOOK` more were spent.
const LOOK: u32 = 16;

thread_local! {
    static SPENT: Cell<u64> = const { Cell::new(0) };
    static LOOKING: Cell<fn()> = const { Cell::new(|| ()) };
}

/// Begins a check with a full budget.
pub fn refill() {
    SPENT.set(0);
}

/// Does a piece of work during which `look` is called now and then.
pub fn looking<T>(look: fn(), work: impl FnOnce() -> T) -> T {
    /// What was there before is put back, also where `look` unwinds.
    struct Restore(fn());
    impl Drop for Restore {
        fn drop(&mut self) {
            LOOKING.set(self.0);
        }
    }
    let _restore = Restore(LOOKING.replace(look));
    work()
}

/// Takes the cost of `count` operations on numbers of at most `bits` bits out of the budget; whether there was enough in it.
/// Who goes on with an empty budget may get wrong numbers, but nothing is accepted with one: a check ends with [`spend`].
pub fn charge(count: usize, bits: u64) -> bool {
    let words = bits / 64;
    let cost = (count as u64).saturating_mul(words.saturating_mul(words).saturating_add(16));
    let (before, after) = (SPENT.get(), SPENT.get().saturating_add(cost));
    SPENT.set(after);
    if before >> LOOK != after >> LOOK {
        LOOKING.get()();
    }
    after <= BUDGET
}

/// The same; an empty budget rejects the certificate.
pub fn spend(count: usize, bits: u64) -> Checked<()> {
    need(charge(count, bits), "limit", "the check needs more arithmetic than is allowed")
}

/// The greatest common divisor, not negative; much faster than that of the library where one of the numbers is short.
pub fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    let (short, long) = if a.bits() < b.bits() { (a, b) } else { (b, a) };
    match short.magnitude().to_u64() {
        Some(0) => long.abs(),
        Some(1) => BigInt::one(),
        // A rest that does not fit, which cannot be, leaves the fraction as it is.
        Some(word) => match (long.magnitude() % word).to_u64() {
            Some(rest) => word.gcd(&rest).into(),
            None => BigInt::one(),
        },
        // The cost of the division, and of the algorithm of the library, which takes off a bit or two in each step.
        None if charge((long.bits() / short.bits()) as usize + 64, short.bits()) => short.gcd(&(long % short)),
        None => BigInt::one(),
    }
}

/// The least common multiple of positive numbers.
pub fn lcm(a: &BigInt, b: &BigInt) -> BigInt {
    if a == b { a.clone() } else { a / gcd(a, b) * b }
}

/// `numerator / denominator` for a positive denominator.
pub fn ratio(numerator: BigInt, denominator: BigInt) -> Q {
    let common = gcd(&numerator, &denominator);
    Q::new_raw(numerator / &common, denominator / common)
}

/// The size of a number in bits.
pub fn bits(x: &Q) -> u64 {
    x.numer().bits() + x.denom().bits()
}

/// The size of the longest of some integers in bits; that of no integers is 0.
pub fn longest<'a>(numbers: impl IntoIterator<Item = &'a BigInt>) -> u64 {
    numbers.into_iter().fold(0, |most, x| most.max(x.bits()))
}

/// A sum of numbers.
pub fn total(numbers: impl IntoIterator<Item = Q>) -> Checked<Q> {
    numbers.into_iter().try_fold(Q::zero(), |sum, x| {
        spend(64, bits(&sum) + bits(&x))?;
        Ok(sum + x)
    })
}

/// A small whole number.
pub fn whole(k: i64) -> Q {
    Q::from_integer(BigInt::from(k))
}

/// The two parts of a text around a mark, or all of it and what stands for the second part.
fn halves<'a>(text: &'a str, mark: char, without: &'a str) -> (&'a str, &'a str) {
    match text.split_once(mark) {
        Some(parts) => parts,
        None => (text, without),
    }
}

/// A text without its sign, where it has one of these.
fn unsigned<'a>(text: &'a str, signs: &[char]) -> &'a str {
    match text.strip_prefix(signs) {
        Some(rest) => rest,
        None => text,
    }
}

/// Reads a rational number in canonical form: lowest terms, no superfluous sign, zero or denominator.
pub fn canonical(text: &str) -> Option<Q> {
    let (numerator, denominator) = halves(text, '/', "1");
    let digits = unsigned(numerator, &['-']);
    let plain = |s: &str| s.bytes().all(|b| b.is_ascii_digit()) && s.bytes().next().is_some_and(|b| b != b'0');
    let zero = text == "0";
    if text.len() > MAX_DIGITS || !(zero || plain(digits)) || !plain(denominator) || text.ends_with("/1") {
        return None;
    }
    let (p, q): (BigInt, BigInt) = (numerator.parse().ok()?, denominator.parse().ok()?);
    gcd(&p, &q).is_one().then(|| Q::new_raw(p, q))
}

/// Reads a number of a case file: `12`, `-3/4`, `0.25` (exactly 1/4), `1.5e-3`, `0.5/0.25`.
pub fn decimal_fraction(text: &str) -> Option<Q> {
    let text = text.trim();
    if text.len() > MAX_DIGITS {
        return None;
    }
    let (p, q) = halves(text, '/', "1");
    let q = decimal(q.trim()).filter(|q| !q.is_zero())?;
    Some(decimal(p.trim())? / q)
}

fn decimal(text: &str) -> Option<Q> {
    let body = unsigned(text, &['-', '+']);
    let (mantissa, exponent) = match body.split_once(['e', 'E']) {
        Some((m, e)) => (m, e.parse::<i32>().ok()?),
        None => (body, 0),
    };
    let (before, after) = halves(mantissa, '.', "");
    let digits = format!("{before}{after}");
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let scale = i64::from(exponent) - i64::try_from(after.len()).ok()?;
    let digit_bits = 4 * (digits.len() as u64 + scale.unsigned_abs());
    if scale.unsigned_abs() as usize > 2 * MAX_DIGITS || !charge(4, digit_bits) {
        return None;
    }
    let power = num_traits::pow(BigInt::from(10), scale.unsigned_abs() as usize);
    let digits: BigInt = digits.parse().ok()?;
    let digits = if text.starts_with('-') { -digits } else { digits };
    Some(if scale < 0 { ratio(digits, power) } else { Q::from_integer(digits * power) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn canonical_numbers_only() {
        for text in ["0", "1", "-3/4", "12/5"] {
            assert_eq!(canonical(text).unwrap().to_string(), text);
        }
        for text in [
            "", "-0", "+1", "2/4", "1/1", "1/0", "01", "1/-2", "1/02", "0/2", "-0/2", "0/1", "00", "-", "/", "٣",
            "1/٣", "1_0", "1e3", "NaN", "0.5", " 1", "--1", "1/2/3",
        ] {
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
