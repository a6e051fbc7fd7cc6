//! Coefficients as people write them: rationals, radicals, decimals of an irrational filter, and names of wavelets.

use super::enclosed::BITS;
use super::regularity::factored;
use crate::algebraic::Elem;
use crate::algebraic::field::{ExpressionError, FieldBuilder, Number, NumberField};
use crate::arith::{Integer, Interval, Rational, abs, binomial, parse_rational};
use crate::linalg::Matrix;
use crate::scheme::{MAX_ARITY, Normalisation};
use malachite_base::num::arithmetic::traits::{Floor, Pow};
use thiserror::Error;

/// A mask that was understood, with `Σ a = arity` and the sum rules of order 1.
#[derive(Debug, Clone)]
pub enum Filter {
    /// Rational coefficients.
    Rational(Vec<Rational>),
    /// Coefficients in a number field.
    Field(FieldFilter),
    /// Decimals: every filter near them.
    Near(Near),
}

/// `(1 + z + … + z^{N−1})^K b(z)` over a number field.
#[derive(Debug, Clone)]
pub struct FieldFilter {
    /// The field.
    pub field: NumberField,
    /// The mask.
    pub mask: Vec<Elem>,
    /// The order of the sum rules, decided exactly.
    pub sum_rules: usize,
    /// `b`.
    pub factor: Vec<Elem>,
    /// Whether `Σ_k a_k a_{k+Nj} = N` for `j = 0` and 0 otherwise.
    pub orthonormal: bool,
}

/// All masks with sum rules of an order whose coefficients are near given decimals.
#[derive(Debug, Clone)]
pub struct Near {
    /// One of them, rational.
    pub mask: Vec<Rational>,
    /// The order `K` of the sum rules.
    pub sum_rules: usize,
    /// Its largest distance from the decimals, which were scaled to `Σ a = arity`.
    pub distance: Rational,
    /// The distance from [`Near::mask`] within which all masks are meant.
    pub radius: Rational,
}

/// Coefficients that were understood, and what was done with them.
#[derive(Debug, Clone)]
pub struct Understood {
    /// The mask.
    pub filter: Filter,
    /// The arity.
    pub arity: usize,
    /// What was done with the coefficients, where they were not taken as they stand.
    pub remark: Option<Remark>,
}

/// What was done with coefficients that are no mask as they stand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Remark {
    /// They were read in this normalisation, which was not asked for.
    Scaled(Normalisation),
    /// Decimals were taken for simple fractions at this distance.
    Recognised(Rational),
}

/// Why coefficients are no mask.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FilterError {
    /// A coefficient that cannot be read.
    #[error("coefficient {place} cannot be read: {message}")]
    Read {
        /// Its index.
        place: usize,
        /// Why.
        message: String,
        /// How to mend it.
        help: Option<String>,
    },
    /// An arity that is not handled.
    #[error("a mask of arity {0} cannot be used; the arity is an integer from 2 to 64")]
    Arity(usize),
    /// No coefficient, or too many.
    #[error("the mask has {0} coefficients; 1 to {MAX_LENGTH} are handled")]
    Length(usize),
    /// The sums over the residue classes are not those of a mask, in no known normalisation.
    #[error(
        "the coefficients with index {coset} modulo {arity} add up to {sum}, not to 1, and this is no filter with the sum 1, \
         {arity} or √{arity} either: the weights of a new point must sum to 1"
    )]
    Sums {
        /// The arity.
        arity: usize,
        /// The residue class.
        coset: usize,
        /// Its sum.
        sum: String,
    },
}

/// Most coefficients.
pub const MAX_LENGTH: usize = 64;
/// Binary places of `√N` where decimals are scaled.
const ROOT_BITS: u64 = 200;
/// Largest denominator by which decimals are recognised.
const SIMPLE: u64 = 4096;

/// Reads coefficients. Without a normalisation those of a mask, or of a filter with the sum 1 or `√N`, are told apart by their sums.
///
/// # Errors
/// [`FilterError`].
pub fn understood(texts: &[String], arity: usize, scale: Option<Normalisation>) -> Result<Understood, FilterError> {
    if !(2..=MAX_ARITY).contains(&arity) {
        return Err(FilterError::Arity(arity));
    }
    if !(1..=MAX_LENGTH).contains(&texts.len()) {
        return Err(FilterError::Length(texts.len()));
    }
    let mut builder = FieldBuilder::new();
    let mut numbers = Vec::new();
    for (place, text) in texts.iter().enumerate() {
        let wrong = |e: ExpressionError| FilterError::Read { place, message: e.to_string(), help: e.help };
        let number = builder.parse(text).map_err(wrong)?;
        numbers.push(number);
    }
    let rationals: Option<Vec<Rational>> = numbers.iter().map(|x| builder.is_rational(x)).collect();
    if let Some(found) = exact(&mut builder, &numbers, arity, scale) {
        return Ok(found);
    }
    let decimal = |t: &String| t.contains(['.', 'e', 'E']) || parse_rational(t).is_ok_and(|x| x == 0);
    if let (Some(values), 2, true) = (&rationals, arity, texts.iter().all(decimal))
        && let Some(found) = near(texts, values)
    {
        return Ok(found);
    }
    let mut sums = (0..arity).map(|coset| (coset, coset_sum(&builder, &numbers, arity, coset)));
    let (coset, sum) = sums
        .find(|(_, s)| builder.is_rational(s) != Some(Rational::from(1)))
        .expect("coefficients with these sums are a mask");
    let sum = builder.is_rational(&sum).map_or_else(|| builder.field().display(&builder.elem(&sum)), |q| q.to_string());
    Err(FilterError::Sums { arity, coset, sum })
}

fn coset_sum(builder: &FieldBuilder, numbers: &[Number], arity: usize, coset: usize) -> Number {
    let zero = builder.rational(&Rational::from(0));
    numbers.iter().skip(coset).step_by(arity).fold(zero, |s, x| builder.add(&s, x))
}

/// The mask in the given normalisation, or in the one that fits; `None` where none does.
fn exact(
    builder: &mut FieldBuilder,
    numbers: &[Number],
    arity: usize,
    scale: Option<Normalisation>,
) -> Option<Understood> {
    use Normalisation::{Arity, One, Root};
    let whole = builder.rational(&Rational::from(arity as u64));
    let root = builder.nth_root(&whole, 2).ok();
    // Entries given as multiples of √N are scaled as those with the sum 1.
    let order = match scale {
        None | Some(Arity) => [Arity, One, Root],
        Some(One | Root) => [One, Root, Arity],
    };
    for tried in order {
        let factor = match tried {
            Arity => Some(builder.rational(&Rational::from(1))),
            One => Some(whole.clone()),
            Root => root.clone(),
        };
        let Some(factor) = factor else { continue };
        let scaled: Vec<Number> = numbers.iter().map(|x| builder.mul(x, &factor)).collect();
        let one = |c: usize| builder.is_rational(&coset_sum(builder, &scaled, arity, c)) == Some(Rational::from(1));
        if !(0..arity).all(one) {
            continue;
        }
        let (field, elements) = builder.finish(&scaled);
        let rational: Option<Vec<Rational>> = elements.iter().map(Elem::is_rational).collect();
        let filter = rational.map_or_else(|| Filter::Field(over_field(field, &elements, arity)), Filter::Rational);
        return Some(Understood { filter, arity, remark: (tried != order[0]).then_some(Remark::Scaled(tried)) });
    }
    None
}

fn over_field(field: NumberField, mask: &[Elem], arity: usize) -> FieldFilter {
    let begin = mask.iter().take_while(|x| x.is_zero()).count();
    let end = mask.iter().rev().take_while(|x| x.is_zero()).count();
    let trimmed = mask[begin..mask.len() - end].to_vec();
    let mut factor = trimmed.clone();
    let mut sum_rules = 0;
    while let Some(quotient) = divided(&factor, arity) {
        (factor, sum_rules) = (quotient, sum_rules + 1);
    }
    let products = |shift: usize| {
        let pairs = trimmed.iter().zip(trimmed.iter().skip(shift));
        pairs.fold(Elem::zero(), |s, (a, b)| s.add(&field.mul(a, b)))
    };
    let norm = products(0).is_rational() == Some(Rational::from(arity as u64));
    let orthonormal = norm && (arity..trimmed.len()).step_by(arity).all(|shift| products(shift).is_zero());
    FieldFilter { field, mask: trimmed, sum_rules, factor, orthonormal }
}

/// The quotient by `1 + z + … + z^{N−1}`, where nothing is left.
fn divided(a: &[Elem], arity: usize) -> Option<Vec<Elem>> {
    let count = (a.len() + 1).checked_sub(arity).filter(|n| *n > 0)?;
    let mut rest = a.to_vec();
    let mut quotient = Vec::new();
    for k in 0..count {
        let c = rest[k].clone();
        for entry in &mut rest[k..k + arity] {
            *entry = entry.sub(&c);
        }
        quotient.push(c);
    }
    rest.iter().all(Elem::is_zero).then_some(quotient)
}

impl FieldFilter {
    /// Enclosures of the coefficients of `b`.
    #[must_use]
    pub fn enclosures(&self) -> Vec<Interval> {
        self.factor.iter().map(|x| self.field.enclosure(x, BITS + 40)).collect()
    }
}

impl Near {
    /// Enclosures of the coefficients of `b` for all masks that are meant.
    #[must_use]
    pub fn enclosures(&self) -> Vec<Interval> {
        let (_, factor) = factored_times(&self.mask, self.sum_rules);
        let count = factor.len();
        // Division by (1+z)^K from the nearer end: coefficients of (1+z)^−K are binomials.
        let growth = |k: usize| {
            let depth = k.min(count - 1 - k);
            (0..=depth).fold(Rational::from(0), |s, j| s + binomial(self.sum_rules + j - 1, j))
        };
        let wide = |(k, b): (usize, &Rational)| {
            let error = &self.radius * growth(k);
            Interval::new(b - &error, b + &error)
        };
        factor.iter().enumerate().map(wide).collect()
    }
}

/// Divides by `1 + z` at most `count` times.
fn factored_times(mask: &[Rational], count: usize) -> (usize, Vec<Rational>) {
    let (most, rest) = factored(mask, 2);
    // Multiply what was divided too often back.
    let extra = most.saturating_sub(count);
    let back = (0..extra).fold(rest, |p, _| {
        let shifted = std::iter::once(Rational::from(0)).chain(p.iter().cloned());
        let padded = p.iter().cloned().chain(std::iter::once(Rational::from(0)));
        padded.zip(shifted).map(|(a, b)| a + b).collect()
    });
    (most.min(count), back)
}

/// Decimals of a filter with the sum 1, 2 or √2.
fn near(texts: &[String], values: &[Rational]) -> Option<Understood> {
    let root = crate::radius::square_root(&Rational::from(2), ROOT_BITS).mid();
    let sum = values.iter().fold(Rational::from(0), |s, x| s + x);
    let close =
        |factor: &Rational| abs(&(&sum * factor - Rational::from(2))) < Rational::from(1) / Rational::from(100_000);
    let factor = [Rational::from(1), Rational::from(2), root].into_iter().find(close)?;
    let unit = texts.iter().map(|t| unit(t)).collect::<Option<Vec<_>>>()?.into_iter().max()? * &factor;
    let scaled: Vec<Rational> = values.iter().map(|x| x * &factor).collect();
    if let Some(mask) = simple(&scaled, &unit) {
        let remark = Some(Remark::Recognised(distance(&mask, &scaled)));
        return Some(Understood { filter: Filter::Rational(mask), arity: 2, remark });
    }
    // Tables are often less exact than their digits; the distance is part of the answer.
    let tolerance = (&unit * Rational::from(16)).max(Rational::from(1) / Rational::from(10).pow(9u64));
    let mut found = None;
    for order in 1..=scaled.len() / 2 {
        match projected(&scaled, order) {
            Some(mask) if distance(&mask, &scaled) <= tolerance => found = Some((order, mask)),
            _ => break,
        }
    }
    let (sum_rules, mask) = found?;
    let distance = distance(&mask, &scaled);
    let radius = (&distance + &unit) * Rational::from(2);
    Some(Understood { filter: Filter::Near(Near { mask, sum_rules, distance, radius }), arity: 2, remark: None })
}

fn distance(a: &[Rational], b: &[Rational]) -> Rational {
    a.iter().zip(b).map(|(x, y)| abs(&(x - y))).max().unwrap_or_else(|| Rational::from(0))
}

/// One unit of the last decimal place of a text, or of the sixteenth digit where that is more.
fn unit(text: &str) -> Option<Rational> {
    let text = text.trim();
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((m, e)) => (m, e.parse::<i64>().ok()?),
        None => (text, 0),
    };
    let places = mantissa.split_once('.').map_or(0, |(_, f)| f.len() as i64);
    let ten = Rational::from(10);
    let last = places.checked_sub(exponent)?;
    let last = (0..=400).contains(&last.abs()).then_some(last)?;
    let power = ten.pow(last.unsigned_abs());
    let power = if last >= 0 { Rational::from(1) / power } else { power };
    Some(power.max(Rational::from(1) / Rational::from(10).pow(16u64)))
}

/// The mask of simple fractions next to decimals, if it has the sum rules.
fn simple(values: &[Rational], unit: &Rational) -> Option<Vec<Rational>> {
    let tolerance = unit * Rational::from(4);
    if tolerance > Rational::from(1) / Rational::from(1_000_000_000u64) {
        return None;
    }
    let mask: Vec<Rational> = values.iter().map(|x| fraction(x, &tolerance)).collect::<Option<_>>()?;
    let holds = |coset: usize| mask.iter().skip(coset).step_by(2).fold(Rational::from(0), |s, x| s + x) == 1;
    (holds(0) && holds(1)).then_some(mask)
}

/// The first convergent within the tolerance, if its denominator is small.
fn fraction(x: &Rational, tolerance: &Rational) -> Option<Rational> {
    let (mut p, mut q) = ([Integer::from(0), Integer::from(1)], [Integer::from(1), Integer::from(0)]);
    let mut rest = x.clone();
    for _ in 0..40 {
        let whole: Integer = (&rest).floor();
        p = [p[1].clone(), &whole * &p[1] + &p[0]];
        q = [q[1].clone(), &whole * &q[1] + &q[0]];
        if q[1] > SIMPLE {
            return None;
        }
        let value = Rational::from(&p[1]) / Rational::from(&q[1]);
        if abs(&(&value - x)) <= *tolerance {
            return Some(value);
        }
        let left = rest - Rational::from(whole);
        if left == 0 {
            return None;
        }
        rest = Rational::from(1) / left;
    }
    None
}

/// The nearest mask (least squares) with the sum 2 and the sum rules of an order: `Σ (−1)^k k^j a_k = 0` for `j` below it.
fn projected(values: &[Rational], order: usize) -> Option<Vec<Rational>> {
    let n = values.len();
    let centred = |k: usize| Rational::from(2 * k as i64 - n as i64 + 1);
    let row = |j: usize, k: usize| {
        if j == order {
            return Rational::from(1);
        }
        let power = (0..j).fold(Rational::from(1), |p, _| p * centred(k));
        if k.is_multiple_of(2) { power } else { -power }
    };
    let rows = Matrix::from_fn(order + 1, n, row);
    let miss: Vec<Rational> = rows
        .apply(values)
        .into_iter()
        .enumerate()
        .map(|(j, x)| if j == order { Rational::from(2) - x } else { -x })
        .collect();
    let gram = &rows * &rows.transpose();
    let y = gram.solve(&Matrix::from_columns(order + 1, &[miss]))?.column(0);
    let change = rows.transpose().apply(&y);
    Some(values.iter().zip(change).map(|(x, c)| x + c).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str, scale: Option<Normalisation>) -> Understood {
        let texts: Vec<String> = text.split(',').map(str::to_owned).collect();
        understood(&texts, 2, scale).unwrap()
    }

    #[test]
    fn decimals_of_the_hat_are_recognised() {
        let found = of("0.3535533905932738,0.7071067811865476,0.3535533905932738", Some(Normalisation::Root));
        let Filter::Rational(mask) = found.filter else { panic!() };
        assert_eq!(mask, [crate::arith::ratio(1, 2), crate::arith::ratio(1, 1), crate::arith::ratio(1, 2)]);
        assert!(matches!(found.remark, Some(Remark::Recognised(_))));
    }

    #[test]
    fn decimals_of_db2_have_two_sum_rules() {
        let text = "-0.12940952255126037,0.2241438680420134,0.8365163037378079,0.48296291314453416";
        let Filter::Near(near) = of(text, None).filter else { panic!() };
        assert_eq!(near.sum_rules, 2);
        assert!(near.distance < Rational::from(1) / Rational::from(10u64).pow(15u64));
        // The true coefficients of b, ((1 + √3)/2, (1 − √3)/2) /2 in some order, lie in the enclosures.
        let exact = of("(1-sqrt(3))/4,(3-sqrt(3))/4,(3+sqrt(3))/4,(1+sqrt(3))/4", None);
        let Filter::Field(field) = exact.filter else { panic!() };
        assert!(field.orthonormal && field.sum_rules == 2);
        for (wide, x) in near.enclosures().iter().zip(field.enclosures()) {
            assert!(wide.lo <= x.lo && x.hi <= wide.hi, "{wide:?} {x:?}");
        }
    }

    /// The filter of 9 taps as tables print it, exact to 12 places only.
    #[test]
    fn tables_less_exact_than_their_digits() {
        let half = ["0.03782845550726404", "-0.023849465019556843", "-0.11062440441843718", "0.37740285561283066"];
        let all =
            [half.join(","), "0.8526986790088938".to_owned(), half.iter().rev().copied().collect::<Vec<_>>().join(",")];
        let Filter::Near(near) = of(&all.join(","), None).filter else { panic!() };
        assert_eq!(near.sum_rules, 4);
        let texts = crate::scheme::wavelet_mask("rbio4.4").unwrap();
        let Filter::Field(field) = understood(&texts, 2, None).unwrap().filter else { panic!() };
        assert_eq!(field.sum_rules, 4);
        for (x, b) in near.mask.iter().zip(&field.mask) {
            let exact = field.field.enclosure(b, 80).mid();
            assert!(abs(&(x - exact)) < Rational::from(1) / Rational::from(10).pow(11u64));
        }
    }

    #[test]
    fn named_filters_are_masks() {
        for name in crate::scheme::wavelet_names() {
            let texts = crate::scheme::wavelet_mask(&name).unwrap();
            let found = understood(&texts, 2, None).unwrap();
            assert!(found.remark.is_none(), "{name}");
            if let (Filter::Rational(mask), Some(orders)) = (&found.filter, name.strip_prefix("rbio")) {
                let order: usize = orders.split_once('.').unwrap().1.parse().unwrap();
                assert!(factored(mask, 2).0 >= order, "{name}");
            }
        }
    }

    #[test]
    fn other_sums_are_refused() {
        let texts = ["1".to_owned(), "2".to_owned()];
        assert!(matches!(understood(&texts, 2, None), Err(FilterError::Sums { coset: 1, .. })));
        let texts = ["0.1".to_owned(), "0.2".to_owned()];
        assert!(matches!(understood(&texts, 2, None), Err(FilterError::Sums { .. })));
    }
}
