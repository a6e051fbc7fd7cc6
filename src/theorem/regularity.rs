//! Regularity of the limits of univariate masks (theory §11), in the uniform parameter.
//!
//! With `a(z) = (1 + z + … + z^{N−1})^K b(z)`, `K` as large as possible, the differences of order `K` are refined by `b`.
//! If `ρ` is the joint spectral radius of the matrices of `b`, the Hölder exponent of the scheme is `−log_N ρ`; the limits are
//! `C^m` where `ρ < N^{−m}` (the condition of Levin and Levin, `JSR < 2^{−m}` for `C^m`, there for differences of order `m+1`).

use crate::arith::{Integer, Interval, Rational};
use crate::linalg::Matrix;
use crate::radius::{Growth, JointRadius, Options, System, joint_radius};
use crate::shape::{fixed_point, norm1};
use malachite_base::num::arithmetic::traits::{Ceiling, Floor};
use malachite_base::num::conversion::traits::IsInteger;
use thiserror::Error;

/// Why a mask has no regularity.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MaskError {
    /// An arity below 2.
    #[error("the arity is {0}, but must be at least 2")]
    Arity(usize),
    /// A mask without a nonzero coefficient.
    #[error("the mask is zero")]
    Zero,
    /// Coefficients that do not sum to 1 on a coset.
    #[error(
        "the coefficients with index {coset} modulo {arity} sum to {sum}, not to 1: the weights of a new point must sum to 1"
    )]
    SumRule {
        /// The arity.
        arity: usize,
        /// The coset.
        coset: usize,
        /// Its sum.
        sum: Rational,
    },
    /// More coefficients than are handled.
    #[error("the mask has {0} coefficients; at most {MAX_MASK} are handled")]
    Long(usize),
}

/// Longest mask handled.
pub const MAX_MASK: usize = 64;

/// What is known of one order of smoothness.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Order {
    /// `k`: the claim is "the limits are `C^k`".
    pub order: usize,
    /// The bound `N^{−k}`.
    pub threshold: Rational,
    /// Enclosure of the joint spectral radius of the matrices of differences of order `k+1`.
    pub radius: Option<Interval>,
    /// Whether the radius is below the threshold; `None` where the bounds do not tell.
    pub smooth: Option<bool>,
}

/// Whether the exponent is attained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Attained {
    /// The limits have the exponent itself.
    Yes,
    /// They are in the Zygmund class of that integer order; the Hölder class may miss it.
    Zygmund,
    /// Products grow faster than the power of the radius: the exponent is open.
    No,
    /// Not decided.
    Unknown,
}

/// The regularity of a mask.
#[derive(Debug, Clone)]
pub struct Regularity {
    /// The arity `N`.
    pub arity: usize,
    /// The mask without zeros at its ends.
    pub mask: Vec<Rational>,
    /// `K`: the order of the sum rules.
    pub sum_rules: usize,
    /// The coefficients of `b`.
    pub factor: Vec<Rational>,
    /// The matrices of `b`, by digit.
    pub matrices: Vec<Matrix>,
    /// Their joint spectral radius.
    pub radius: JointRadius,
    /// Enclosure of the exponent `−log_N ρ`, from below 2^-40 wide where the radius is exact.
    pub exponent: Option<Interval>,
    /// Whether it is attained.
    pub attained: Attained,
    /// Whether the integer translates of the limit function are independent on a unit interval; then the exponent of the scheme
    /// is that of its limits, otherwise limits may be smoother.
    pub independent: bool,
    /// The orders `0, 1, …` up to the first that fails or is open.
    pub orders: Vec<Order>,
}

impl Regularity {
    /// The largest `k` for which the limits are proved `C^k`; `None` where not even continuity is proved.
    #[must_use]
    pub fn smoothness(&self) -> Option<usize> {
        self.orders.iter().take_while(|o| o.smooth == Some(true)).map(|o| o.order).last()
    }

    /// Whether the scheme converges uniformly for all control points, which is so if and only if the radius of the first
    /// differences is below 1; `None` where the bounds do not tell.
    #[must_use]
    pub fn converges(&self) -> Option<bool> {
        self.orders.first().and_then(|o| o.smooth)
    }

    /// Whether all coefficients are 1: the limits are constant between the integers.
    #[must_use]
    pub fn is_haar(&self) -> bool {
        self.mask.len() == self.arity && self.mask.iter().all(|x| *x == 1)
    }

    /// Whether [`Regularity::smoothness`] is exact: the next order was refuted.
    #[must_use]
    pub fn smoothness_is_exact(&self) -> bool {
        self.independent && self.orders.last().is_some_and(|o| o.smooth == Some(false))
    }
}

/// Analyses a mask of the given arity.
///
/// # Errors
/// [`MaskError`].
///
/// # Cost
/// One joint spectral radius of matrices of about the length of `b`.
pub fn regularity(mask: &[Rational], arity: usize, options: &Options) -> Result<Regularity, MaskError> {
    let mask = trimmed(mask);
    check(&mask, arity)?;
    let (sum_rules, factor) = factored(&mask, arity);
    let matrices = digits(&factor, arity);
    let system = System::plain(&matrices).map_err(|_| MaskError::Zero)?;
    let radius = joint_radius(&system, options).map_err(|_| MaskError::Zero)?;
    let enclosure = enclosure(&radius);
    let exponent = enclosure.as_ref().and_then(|e| minus_log(e, arity));
    let orders = orders(arity, sum_rules, enclosure.as_ref());
    let attained = attained(&radius, exponent.as_ref(), factor.len());
    let independent = independent(&mask, arity);
    Ok(Regularity { arity, mask, sum_rules, factor, matrices, radius, exponent, attained, independent, orders })
}

fn trimmed(mask: &[Rational]) -> Vec<Rational> {
    let first = mask.iter().position(|x| *x != 0).map_or(mask.len(), |k| k);
    let last = mask.iter().rposition(|x| *x != 0).map_or(first, |k| k + 1);
    mask[first..last].to_vec()
}

fn check(mask: &[Rational], arity: usize) -> Result<(), MaskError> {
    if arity < 2 {
        return Err(MaskError::Arity(arity));
    }
    if mask.is_empty() {
        return Err(MaskError::Zero);
    }
    if mask.len() > MAX_MASK {
        return Err(MaskError::Long(mask.len()));
    }
    for coset in 0..arity {
        let sum = mask.iter().skip(coset).step_by(arity).fold(Rational::from(0), |s, x| s + x);
        if sum != 1 {
            return Err(MaskError::SumRule { arity, coset, sum });
        }
    }
    Ok(())
}

/// Divides by `1 + z + … + z^{N−1}` as often as possible.
#[must_use]
pub fn factored(mask: &[Rational], arity: usize) -> (usize, Vec<Rational>) {
    let mut rest = mask.to_vec();
    let mut count = 0;
    while let Some(quotient) = divided(&rest, arity) {
        rest = quotient;
        count += 1;
    }
    (count, rest)
}

fn divided(a: &[Rational], arity: usize) -> Option<Vec<Rational>> {
    if a.len() < arity {
        return None;
    }
    let mut rest = a.to_vec();
    let mut quotient = Vec::new();
    for k in 0..=a.len() - arity {
        let c = rest[k].clone();
        for entry in &mut rest[k..k + arity] {
            *entry -= &c;
        }
        quotient.push(c);
    }
    rest.iter().all(|x| *x == 0).then_some(quotient)
}

/// The matrices `T_e[i][j] = b_{N i − j + e}` of the smallest size that the refinement keeps (at least 1).
#[must_use]
pub fn digits(mask: &[Rational], arity: usize) -> Vec<Matrix> {
    let size = mask.len().saturating_sub(1).div_ceil(arity - 1).max(1);
    (0..arity)
        .map(|e| {
            Matrix::from_fn(size, size, |i, j| {
                (arity * i + e).checked_sub(j).and_then(|k| mask.get(k)).map_or_else(|| Rational::from(0), Clone::clone)
            })
        })
        .collect()
}

fn enclosure(radius: &JointRadius) -> Option<Interval> {
    let upper = radius.upper.clone()?;
    let Some(lower) = &radius.lower else { return Some(Interval::point(upper)) };
    if radius.exact {
        return Some(lower.enclosure(96));
    }
    Some(Interval::new(lower.enclosure(96).lo, upper))
}

/// An enclosure of `−log_N x` for `x` in a positive interval, by repeated squaring.
#[must_use]
pub fn minus_log(x: &Interval, arity: usize) -> Option<Interval> {
    if x.lo <= 0 {
        return None;
    }
    let one = Rational::from(1);
    let lower = digits_of_log(&(&one / &x.hi), arity)?;
    let upper = digits_of_log(&(&one / &x.lo), arity)?;
    Some(Interval::new(lower.lo, upper.hi))
}

/// An enclosure of `log_N x` of width `2^-44`, or 0 where `x` is a power of `N`.
fn digits_of_log(x: &Rational, arity: usize) -> Option<Interval> {
    let base = Rational::from(arity as u64);
    let one = Rational::from(1);
    let mut x = x.clone();
    let mut whole = Rational::from(0);
    for _ in 0..10_000 {
        if x >= base {
            x /= &base;
            whole += &one;
        } else if x < one {
            x *= &base;
            whole -= &one;
        } else {
            break;
        }
    }
    if x == one {
        return Some(Interval::point(whole));
    }
    // Fixed point with this many binary digits, rounded outwards at every step.
    const BITS: u64 = 200;
    const DIGITS: u64 = 44;
    let unit = Integer::from(1) << BITS;
    let up = |n: Integer| (n + &unit - Integer::from(1)) >> BITS;
    let scaled = &x * Rational::from(&unit);
    let (mut lo, mut hi) = ((&scaled).floor(), (&scaled).ceiling());
    let base = Integer::from(arity as u64);
    let limit = &base << BITS;
    let mut digits = Integer::from(0);
    let enclosure = |digits: Integer, known: u64| {
        let place = Rational::from(Integer::from(1) << known);
        let lower = &whole + Rational::from(digits) / &place;
        Interval::new(lower.clone(), lower + one / place)
    };
    for known in 0..DIGITS {
        lo = (&lo * &lo) >> BITS;
        hi = up(&hi * &hi);
        digits <<= 1u64;
        if lo >= limit {
            lo /= &base;
            hi = (hi + &base - Integer::from(1)) / &base;
            digits += Integer::from(1);
        } else if hi >= limit {
            return Some(enclosure(digits >> 1u64, known));
        }
    }
    Some(enclosure(digits, DIGITS))
}

fn orders(arity: usize, sum_rules: usize, radius: Option<&Interval>) -> Vec<Order> {
    let base = Rational::from(1) / Rational::from(arity as u64);
    let mut threshold = Rational::from(1);
    let mut rows = Vec::new();
    for order in 0..sum_rules {
        let next = &threshold * &base;
        // Differences of order k+1 < K carry besides b the powers N^{−k−1}, …, N^{1−K} of polynomials.
        let floor = if order + 1 < sum_rules { next.clone() } else { Rational::from(0) };
        let here = radius.map(|r| Interval::new(r.lo.clone().max(floor.clone()), r.hi.clone().max(floor)));
        let smooth = here.as_ref().and_then(|r| match (r.hi < threshold, r.lo >= threshold) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        });
        rows.push(Order { order, threshold: threshold.clone(), radius: here, smooth });
        if smooth != Some(true) {
            return rows;
        }
        threshold = next;
    }
    // Beyond the sum rules smoothness fails.
    rows.push(Order { order: sum_rules, threshold, radius: radius.cloned(), smooth: Some(false) });
    rows
}

/// What the growth of products says of the exponent: with bounded products it is attained, but in the Zygmund sense only where it is
/// an integer. Where an enclosure does not tell whether it is one, nothing is claimed.
fn attained(radius: &JointRadius, exponent: Option<&Interval>, length: usize) -> Attained {
    let integer =
        exponent.and_then(|e| match (e.lo == e.hi && e.lo.is_integer(), (&e.lo).ceiling() > (&e.hi).floor()) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        });
    match (radius.growth, integer) {
        _ if length == 1 => Attained::Yes,
        (Growth::Unbounded(_), _) => Attained::No,
        (Growth::Bounded, Some(true)) => Attained::Zygmund,
        (Growth::Bounded, Some(false)) => Attained::Yes,
        (Growth::Bounded, None) | (Growth::Unknown, _) => Attained::Unknown,
    }
}

/// Whether the values `(φ(x+i))_i`, `0 <= x <= 1`, span an affine space of full dimension.
fn independent(mask: &[Rational], arity: usize) -> bool {
    let operators = digits(mask, arity);
    let n = operators[0].rows();
    let Some(base) = fixed_point(&operators[0]) else { return false };
    let rows = operators.iter().map(|t| crate::shape::difference(&t.apply(&base), &base)).filter(|d| norm1(d) != 0);
    let maps: Vec<Matrix> = operators.iter().map(Matrix::transpose).collect();
    let span = Matrix::from_rows(n, rows.collect()).closure(&maps.iter().collect::<Vec<_>>());
    span.rows() + 1 == n
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{ratio, to_f64};

    fn mask(entries: &[i64], denominator: i64) -> Vec<Rational> {
        entries.iter().map(|x| ratio(*x, denominator)).collect()
    }

    #[test]
    fn chaikin_is_c1_and_its_derivative_lipschitz() {
        let r = regularity(&mask(&[1, 3, 3, 1], 4), 2, &Options::default()).unwrap();
        assert_eq!((r.sum_rules, r.smoothness(), r.attained), (3, Some(1), Attained::Yes));
        assert_eq!(r.exponent, Some(Interval::point(ratio(2, 1))));
        assert!(r.smoothness_is_exact());
    }

    /// An enclosure that may hold an integer claims nothing; with one matrix coefficient left the exponent is that of a number.
    #[test]
    fn what_growth_says_of_the_exponent() {
        let system = System::plain(&[Matrix::identity(1)]).unwrap();
        let mut radius = joint_radius(&system, &Options::default()).unwrap();
        let between = |a: i64, b: i64| Some(Interval::new(ratio(a, 4), ratio(b, 4)));
        let of = |radius: &JointRadius, exponent: Option<Interval>| attained(radius, exponent.as_ref(), 2);
        radius.growth = Growth::Bounded;
        assert_eq!(of(&radius, between(8, 8)), Attained::Zygmund);
        assert_eq!(of(&radius, between(5, 7)), Attained::Yes);
        for (a, b) in [(7, 9), (8, 9), (7, 8), (3, 9)] {
            assert_eq!(of(&radius, between(a, b)), Attained::Unknown, "{a}/4, {b}/4");
        }
        assert_eq!(of(&radius, None), Attained::Unknown);
        radius.growth = Growth::Unknown;
        assert_eq!(of(&radius, between(5, 7)), Attained::Unknown);
        radius.growth = Growth::Unbounded(2);
        assert_eq!(of(&radius, between(5, 7)), Attained::No);
        assert_eq!(attained(&radius, between(5, 7).as_ref(), 1), Attained::Yes);
    }

    #[test]
    fn six_points() {
        let r = regularity(&mask(&[3, 0, -25, 0, 150, 256, 150, 0, -25, 0, 3], 256), 2, &Options::default()).unwrap();
        assert!(r.radius.exact);
        assert_eq!(r.radius.upper, Some(ratio(9, 64)));
        assert!((to_f64(&r.exponent.unwrap().lo) - 2.830_074_998_557_6).abs() < 1e-12);
    }

    #[test]
    fn a_mask_without_sum_rules_is_refused() {
        assert!(matches!(regularity(&mask(&[1, 2], 2), 2, &Options::default()), Err(MaskError::SumRule { .. })));
    }
}
