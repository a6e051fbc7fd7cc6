//! Sums of products of rationals over common denominators: one reduction for a sum instead of three for each term.

use crate::arith::{Integer, Natural, Rational};
use crate::poly::ints;
use malachite_base::num::arithmetic::traits::{AddMulAssign, Gcd};

/// Rationals over one denominator, as words where they are short.
pub(super) enum Line {
    Words(u64, Vec<i64>),
    Long(Natural, Vec<Integer>),
}

/// Numbers below this are words: eight products of two of them fit 128 bits.
const WORD: u64 = 1 << 62;

impl Line {
    pub fn of<'a>(values: impl Iterator<Item = &'a Rational> + Clone) -> Self {
        if let Some((d, numerators)) = words(values.clone()) {
            return Self::Words(d, numerators);
        }
        let d = ints::common_denominator(values.clone());
        let numerators = values.map(|x| ints::cleared(x, &d)).collect();
        Self::Long(d, numerators)
    }

    /// The sum of the products of corresponding entries.
    pub fn dot(&self, other: &Self) -> Rational {
        if let (Self::Words(d, a), Self::Words(e, b)) = (self, other)
            && let Some(sum) = word_sum(a, b)
        {
            return fraction(sum, u128::from(*d) * u128::from(*e));
        }
        let (d, a) = self.long();
        let (e, b) = other.long();
        let mut sum = Integer::from(0);
        for (x, y) in a.iter().zip(b.iter()).filter(|(x, y)| **x != 0 && **y != 0) {
            sum.add_mul_assign(x, y);
        }
        Rational::from_integers(sum, Integer::from(d * e))
    }

    fn long(&self) -> (Natural, std::borrow::Cow<'_, [Integer]>) {
        match self {
            Self::Words(d, a) => (Natural::from(*d), a.iter().map(|x| Integer::from(*x)).collect()),
            Self::Long(d, a) => (d.clone(), a.as_slice().into()),
        }
    }
}

fn word_sum(a: &[i64], b: &[i64]) -> Option<i128> {
    a.iter().zip(b).try_fold(0i128, |sum, (x, y)| sum.checked_add(i128::from(*x) * i128::from(*y)))
}

fn fraction(numerator: i128, denominator: u128) -> Rational {
    if numerator == 0 {
        return Rational::from(0);
    }
    let (sign, size) = (numerator > 0, Natural::from(numerator.unsigned_abs()));
    Rational::from_sign_and_naturals(sign, size, Natural::from(denominator))
}

/// The common denominator and the numerators, where all are words.
fn words<'a>(values: impl Iterator<Item = &'a Rational> + Clone) -> Option<(u64, Vec<i64>)> {
    let d = word_denominator(values.clone())?;
    Some((d, values.map(|x| word_numerator(x, d)).collect::<Option<_>>()?))
}

fn word_denominator<'a>(values: impl Iterator<Item = &'a Rational>) -> Option<u64> {
    let mut common = 1;
    for x in values {
        let q = u64::try_from(x.denominator_ref()).ok()?;
        if q != common && common % q != 0 {
            common = common.checked_mul(q / common.gcd(q)).filter(|d| *d < WORD)?;
        }
    }
    Some(common)
}

fn word_numerator(x: &Rational, common: u64) -> Option<i64> {
    let q = u64::try_from(x.denominator_ref()).ok()?;
    let size = u64::try_from(x.numerator_ref()).ok()?.checked_mul(common / q).filter(|n| *n < WORD)?;
    let size = i64::try_from(size).ok()?;
    Some(if *x < 0 { -size } else { size })
}

/// The sum of the products of corresponding entries.
#[must_use]
pub fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    let terms = || a.iter().zip(b).filter(|(x, y)| **x != 0 && **y != 0);
    if terms().nth(1).is_none() {
        return terms().next().map_or_else(|| Rational::from(0), |(x, y)| x * y);
    }
    short_dot(terms).unwrap_or_else(|| Line::of(terms().map(|t| t.0)).dot(&Line::of(terms().map(|t| t.1))))
}

/// The same for short numbers.
fn short_dot<'a, I: Iterator<Item = (&'a Rational, &'a Rational)>>(terms: impl Fn() -> I) -> Option<Rational> {
    let d = word_denominator(terms().map(|t| t.0))?;
    let e = word_denominator(terms().map(|t| t.1))?;
    let mut sum = 0i128;
    for (x, y) in terms() {
        let product = i128::from(word_numerator(x, d)?) * i128::from(word_numerator(y, e)?);
        sum = sum.checked_add(product)?;
    }
    Some(fraction(sum, u128::from(d) * u128::from(e)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::poly::modp::next_random;

    fn random(seed: &mut u64, bits: u64) -> Rational {
        let mut number =
            || (0..bits / 32 + 1).fold(Integer::from(0), |s, _| (s << 32u64) + Integer::from(next_random(seed) >> 32));
        let (p, q) = (number() >> (32 - bits % 32), number() >> (32 - bits % 32));
        Rational::from_integers(p - Integer::from(3), q + Integer::from(1))
    }

    #[test]
    fn sums_are_those_of_the_terms() {
        let mut seed = 5;
        for (length, bits) in [(0, 3), (1, 3), (2, 70), (3, 4), (7, 20), (9, 31), (12, 60), (5, 200)] {
            for round in 0..20 {
                let mut vector = || -> Vec<Rational> {
                    let entry = |k| if (k + round) % 5 == 0 { ratio(0, 1) } else { random(&mut seed, bits) };
                    (0..length).map(entry).collect()
                };
                let (a, b) = (vector(), vector());
                let plain = a.iter().zip(&b).fold(ratio(0, 1), |s, (x, y)| s + x * y);
                assert_eq!(dot(&a, &b), plain);
                assert_eq!(Line::of(a.iter()).dot(&Line::of(b.iter())), plain);
            }
        }
        // Words whose products leave 128 bits.
        let large = vec![Rational::from((1i64 << 61) + 1); 64];
        assert_eq!(dot(&large, &large), Rational::from(64) * &large[0] * &large[0]);
        assert_eq!(
            dot(&large, &large.iter().map(|x| -x).collect::<Vec<_>>()),
            Rational::from(-64) * &large[0] * &large[0]
        );
    }
}
