//! Exact numbers: integers and rationals (malachite), and rational intervals.

mod elementary;
mod interval;
pub mod modular;
mod parse;

pub use elementary::{exp, ln};
pub use interval::Interval;
pub use malachite_nz::integer::Integer;
pub use malachite_nz::natural::Natural;
pub use malachite_q::Rational;
pub use parse::{MAX_DIGITS, ParseNumberError, parse_rational};

/// The rational `p/q`.
///
/// # Panics
/// If `q` is 0.
///
/// # Examples
/// ```
/// use secant_exact::arith::ratio;
/// assert_eq!(ratio(2, -4).to_string(), "-1/2");
/// ```
#[must_use]
pub fn ratio(p: i64, q: i64) -> Rational {
    Rational::from_signeds(p, q)
}

/// The sign of a rational as `-1`, `0` or `1`.
///
/// # Examples
/// ```
/// use secant_exact::arith::{ratio, sign};
/// assert_eq!([-2, 0, 5].map(|p| sign(&ratio(p, 3))), [-1, 0, 1]);
/// ```
#[must_use]
pub fn sign(x: &Rational) -> i32 {
    use malachite_base::num::arithmetic::traits::Sign;
    match x.sign() {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

/// The absolute value.
#[must_use]
pub fn abs(x: &Rational) -> Rational {
    use malachite_base::num::arithmetic::traits::Abs;
    x.abs()
}

/// The binomial coefficient `C(n, k)`; 0 where `k > n`.
///
/// ```
/// use secant_exact::arith::binomial;
/// assert_eq!((0..=4).map(|k| binomial(4, k).to_string()).collect::<Vec<_>>(), ["1", "4", "6", "4", "1"]);
/// assert_eq!(binomial(2, 3), 0);
/// ```
#[must_use]
pub fn binomial(n: usize, k: usize) -> Rational {
    use malachite_base::num::arithmetic::traits::BinomialCoefficient;
    Rational::from(Natural::binomial_coefficient(Natural::from(n), Natural::from(k)))
}

/// The nearest `f64`, for display and for proposing candidates, never for deciding.
#[must_use]
pub fn to_f64(x: &Rational) -> f64 {
    use malachite_base::num::conversion::traits::RoundingFrom;
    use malachite_base::rounding_modes::RoundingMode;
    f64::rounding_from(x, RoundingMode::Nearest).0
}
