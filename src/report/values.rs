//! Exact algebraic values as formulas and decimals.

use super::document::{Line, line};
use super::math::{Math, shortened};
use crate::algebraic::{Elem, Root};
use crate::arith::{Integer, Interval, Rational, abs};
use crate::poly::Poly;
use crate::theorem::Direction;
use malachite_base::num::arithmetic::traits::{FloorSqrt, Pow};
use malachite_base::num::conversion::traits::RoundingFrom;
use malachite_base::rounding_modes::RoundingMode;

/// Digits after the point of decimals.
pub const DIGITS: u64 = 6;
/// Binary digits of the enclosures from which decimals are taken.
const BITS: u64 = 80;

/// A rational rounded to the nearest decimal with `digits` digits after the point, without trailing zeros.
#[must_use]
pub fn decimal(x: &Rational, digits: u64) -> String {
    let scaled = abs(x) * Rational::from(10).pow(digits);
    let rounded = Integer::rounding_from(&scaled, RoundingMode::Nearest).0.to_string();
    let width = usize::try_from(digits).unwrap_or(0);
    let padded = format!("{rounded:0>size$}", size = width + 1);
    let (whole, fraction) = padded.split_at(padded.len() - width);
    let fraction = fraction.trim_end_matches('0');
    let minus = if *x < 0 && rounded != "0" { "-" } else { "" };
    if fraction.is_empty() { format!("{minus}{whole}") } else { format!("{minus}{whole}.{fraction}") }
}

/// A decimal as a formula.
#[must_use]
pub fn decimal_math(x: &Rational, digits: u64) -> Math {
    let text = decimal(x, digits);
    match text.strip_prefix('-') {
        Some(size) => Math::Row(vec![Math::Symbol('−'), Math::Digits(shortened(size))]),
        None => Math::Digits(shortened(&text)),
    }
}

/// Decimals of the real and imaginary part of a root.
#[must_use]
pub fn root_decimals(root: &Root) -> (String, String) {
    let (re, im) = root.enclosure(BITS);
    (decimal(&re.mid(), DIGITS), decimal(&im.mid(), DIGITS))
}

/// A polynomial as a formula.
#[must_use]
pub fn polynomial(p: &Poly, variable: char) -> Math {
    Math::polynomial(p.coeffs(), variable)
}

/// An eigenvalue as people write it: rational, by square roots for degree 2, otherwise a decimal.
#[must_use]
pub fn root_math(root: &Root) -> Math {
    if let Some(x) = root.rational() {
        return Math::number(&x);
    }
    if root.degree() == 2
        && let Some(exact) = quadratic(root)
    {
        return exact;
    }
    let (re, im) = root.enclosure(BITS);
    let mut row = vec![Math::Symbol('≈')];
    push_decimal(&mut row, &re.mid(), false);
    if !root.is_real() {
        push_decimal(&mut row, &im.mid(), true);
        row.push(Math::Letter('i'));
    }
    Math::Row(row)
}

/// `λ = 3/4`, or `λ ≈ 0.549988` where there is no short exact form.
#[must_use]
pub fn lambda_math(root: &Root) -> Math {
    let value = root_math(root);
    let rounded = matches!(&value, Math::Row(row) if row.first() == Some(&Math::Symbol('≈')));
    match value {
        // In one row, so that there is room around the sign.
        Math::Row(row) if rounded => Math::Row([vec![Math::Letter('λ')], row].concat()),
        value => Math::Row(vec![Math::of("λ="), value]),
    }
}

/// Both ends of an enclosure as decimals of six digits rounded outwards, or exactly where that would lose a sign.
#[must_use]
pub fn outward(x: &Interval) -> (Math, Math) {
    use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
    let million = Rational::from(10).pow(DIGITS);
    let lo = Rational::from((&x.lo * &million).floor()) / &million;
    let hi = Rational::from((&x.hi * &million).ceiling()) / &million;
    let same = |a: &Rational, b: &Rational| crate::arith::sign(a) == crate::arith::sign(b);
    if same(&lo, &x.lo) && same(&hi, &x.hi) {
        (decimal_math(&lo, DIGITS), decimal_math(&hi, DIGITS))
    } else {
        (Math::number(&x.lo), Math::number(&x.hi))
    }
}

/// A value that is known to lie in an enclosure: exactly where both ends are one short number, otherwise between decimals
/// rounded outwards.
#[must_use]
pub fn enclosed(x: &Interval) -> Line {
    if x.lo == x.hi && x.lo.to_string().len() <= MAX_EXACT {
        return line("the value $@$", [Math::number(&x.lo)]);
    }
    let (lo, hi) = outward(x);
    line("between $@$ and $@$", [lo, hi])
}

/// Longer numbers are enclosed, not written out.
const MAX_EXACT: usize = 40;

fn push_decimal(row: &mut Vec<Math>, x: &Rational, always_sign: bool) {
    let text = decimal(x, DIGITS);
    match text.strip_prefix('-') {
        Some(size) => row.extend([Math::Symbol('−'), Math::Digits(size.to_owned())]),
        None if always_sign => row.extend([Math::Symbol('+'), Math::Digits(text)]),
        None => row.push(Math::Digits(text)),
    }
}

/// `−b/2 ± r √s` with squarefree `s`, for a root of `x² + bx + c`.
fn quadratic(root: &Root) -> Option<Math> {
    let p = root.minpoly();
    let half = -p.coeff(1) / Rational::from(2);
    let discriminant = &half * &half - p.coeff(0);
    let (factor, square_free) = square_part(&abs(&discriminant))?;
    let above = if root.is_real() {
        let (x, _) = root.enclosure(BITS);
        // The roots are irrational, so that an enclosure narrow enough decides; wider ones leave the decimal.
        (&x - &Interval::point(half.clone())).sign()? > 0
    } else {
        root.enclosure(BITS).1.sign()? > 0
    };
    let mut row = Vec::new();
    if half != 0 {
        row.push(Math::Number(half.clone()));
    }
    if !above || half != 0 {
        row.push(Math::Symbol(if above { '+' } else { '−' }));
    }
    if factor != 1 || (square_free == 1 && root.is_real()) {
        row.push(Math::Number(factor));
    }
    if square_free != 1 {
        row.push(Math::Root(Box::new(Math::Number(Rational::from(square_free)))));
    }
    if !root.is_real() {
        row.push(Math::Letter('i'));
    }
    Some(Math::Row(row))
}

/// `x = factor² · rest` with a whole number `rest` that no small square divides; `None` for long numbers.
fn square_part(x: &Rational) -> Option<(Rational, Integer)> {
    let q = Integer::from(x.denominator_ref());
    let mut rest = Integer::from(x.numerator_ref()) * &q;
    if rest.to_string().len() > 24 {
        return None;
    }
    let mut factor = Rational::from_integers(Integer::from(1), q);
    for k in (2u32..200).map(Integer::from) {
        let square = &k * &k;
        while Rational::from_integers(rest.clone(), square.clone()).denominator_ref() == &1u32 {
            rest = Integer::from(Rational::from_integers(rest, square.clone()).into_numerator());
            factor *= Rational::from(k.clone());
        }
    }
    let s = (&rest).floor_sqrt();
    if &s * &s == rest {
        return Some((factor * Rational::from(s), Integer::from(1)));
    }
    Some((factor, rest))
}

/// An element of `Q(λ)` as a polynomial in `λ`.
#[must_use]
pub fn elem_math(elem: &Elem) -> Math {
    match elem.is_rational() {
        Some(x) => Math::number(&x),
        None => polynomial(&elem.0, 'λ'),
    }
}

/// The coordinates of a direction, as polynomials in `λ` where they are irrational.
#[must_use]
pub fn direction_math(direction: &Direction) -> Math {
    Math::tuple(direction.coords.iter().map(elem_math).collect())
}

/// The coordinates of a direction as decimals.
#[must_use]
pub fn direction_decimals(direction: &Direction) -> Vec<String> {
    direction.coords.iter().map(|c| decimal(&c.enclosure(&direction.root, BITS).0.mid(), DIGITS)).collect()
}

/// Decimals as a tuple.
#[must_use]
pub fn decimals_math(decimals: &[String]) -> Math {
    let part = |text: &String| match text.strip_prefix('-') {
        Some(size) => Math::Row(vec![Math::Symbol('−'), Math::Digits(size.to_owned())]),
        None => Math::Digits(text.clone()),
    };
    Math::tuple(decimals.iter().map(part).collect())
}

/// Whether all coordinates are rational.
#[must_use]
pub fn is_rational(direction: &Direction) -> bool {
    direction.rational().is_some()
}

/// Three significant digits of a positive number, for display.
#[must_use]
#[allow(clippy::float_arithmetic, reason = "display only")]
pub fn exponent(modulus: &Interval, scale: &Rational) -> String {
    let ratio = crate::arith::to_f64(&modulus.mid()).ln() / crate::arith::to_f64(scale).ln();
    let text = format!("{ratio:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebraic::roots;
    use crate::arith::ratio;
    use crate::report::text::math_line;

    fn shown(coefficients: &[i64]) -> Vec<String> {
        let p = Poly::new(coefficients.iter().map(|&c| ratio(c, 1)).collect());
        roots(&p.monic()).iter().map(|r| math_line(&root_math(r))).collect()
    }

    #[test]
    fn roots_are_written_exactly_where_that_is_short() {
        let mut golden = shown(&[-1, -1, 1]);
        golden.sort();
        assert_eq!(golden, ["1/2 + 1/2 √5", "1/2 − 1/2 √5"]);
        let mut complex = shown(&[1, -2, 2]);
        complex.sort();
        assert_eq!(complex, ["1/2 + 1/2 i", "1/2 − 1/2 i"]);
        assert_eq!(shown(&[-3, 4]), ["3/4"]);
        assert!(shown(&[-2, 0, 0, 1]).iter().any(|r| r == "≈ 1.259921"), "{:?}", shown(&[-2, 0, 0, 1]));
        let mut imaginary = shown(&[3, 0, 1]);
        imaginary.sort();
        assert_eq!(imaginary, ["−√3 i", "√3 i"]);
    }

    #[test]
    fn enclosures_are_rounded_outwards() {
        let shown = |lo: Rational, hi: Rational| {
            let (lo, hi) = outward(&Interval { lo, hi });
            (math_line(&lo), math_line(&hi))
        };
        let (third, seventh) = (ratio(1, 3), ratio(1, 7));
        assert_eq!(shown(-third.clone(), third.clone()), ("−0.333334".to_owned(), "0.333334".to_owned()));
        assert_eq!(shown(seventh.clone(), third), ("0.142857".to_owned(), "0.333334".to_owned()));
        assert_eq!(shown(ratio(1, 100_000_000), ratio(1, 8)).0, "1/100000000", "the sign is kept");
        let exact = enclosed(&Interval::point(ratio(41, 11)));
        assert_eq!(exact, line("the value $@$", [Math::number(&ratio(41, 11))]));
    }

    #[test]
    fn decimals_are_rounded_to_nearest() {
        assert_eq!(decimal(&ratio(-2, 3), 6), "-0.666667");
        assert_eq!(decimal(&ratio(5, 1), 6), "5");
        assert_eq!(decimal(&ratio(-1, 100_000_000), 6), "0");
        assert_eq!(decimal(&ratio(1, 8), 2), "0.12");
        assert_eq!(decimal(&ratio(999_999_999, 1_000_000_000), 6), "1");
    }
}
