//! Hölder exponents in a parameter with shares (theory §11, Theorem E): `JSR(s_i^(−α) T_i)` compared with 1 for exponents `α` with a
//! small denominator, with rational numbers on the safe side of the powers.

use super::derived::{Curve, Families};
use super::smoothness::{CurveOrder, Shares};
use crate::arith::{Interval, Rational, to_f64};
use crate::radius::{JointRadius, Lower, Options, Radial, System, joint_radius};

/// The denominator of the exponents that are tried.
pub const DENOMINATOR: u64 = 2_048;
/// How many exponents below a word's are tried.
const TRIES: usize = 6;

/// What shows on which side of an exponent the supremum lies.
#[derive(Debug, Clone)]
pub struct ExponentBound<E = Rational> {
    /// The exponent, a multiple of `1/DENOMINATOR`.
    pub at: Rational,
    /// By reachable state and letter: numbers not below `s_i^(−at)` for a lower bound, not above it for an upper bound.
    pub factors: Shares,
    /// The operators on the differences times the factors.
    pub system: System<E>,
    /// Their radius: below 1 for a lower bound, with a word at least 1 for an upper bound.
    pub radius: JointRadius<E>,
}

/// Both sides; where one is missing it is the order itself, or the next one.
#[derive(Debug, Clone)]
pub struct ExponentBounds<E = Rational> {
    /// The supremum is greater.
    pub below: Option<ExponentBound<E>>,
    /// It is not greater.
    pub above: Option<ExponentBound<E>>,
}

impl<E> Default for ExponentBounds<E> {
    fn default() -> Self {
        Self { below: None, above: None }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}

struct Search<'a, E: Radial> {
    curve: &'a Curve<'a, E>,
    families: &'a Families<E>,
    shares: &'a Shares,
    options: &'a Options,
}

impl<E: Radial> ExponentBounds<E> {
    /// Bounds of the supremum of the exponents `k + α`, `0 < α <= 1`, where order `k` holds and its differences are given.
    pub(super) fn of(curve: &Curve<'_, E>, order: &CurveOrder<E>, families: &Families<E>, options: &Options) -> Self {
        let mut found = Self::default();
        let (Some(shares), Some(system)) = (&order.shares, &order.system) else { return found };
        let search = Search { curve, families, shares, options };
        let k = order.order as u64;
        let (lo, mut hi) = (k * DENOMINATOR, (k + 1) * DENOMINATOR);
        let word = order.radius.as_ref().and_then(|r| r.lower.as_ref()).map(|lower| lower.path.clone());
        let mut target = word.and_then(|word| search.exponent_of(system, &word, k)).map(|n| n.clamp(lo, hi - 1));
        let mut back = 1;
        for _ in 0..TRIES {
            let Some(n) = target.filter(|n| *n > lo || hi > lo + 1) else { break };
            if n + 1 < hi
                && let Some(bound) = search.bound(n + 1, Side::Above)
            {
                (hi, found.above) = (n + 1, Some(bound));
            }
            if n <= lo {
                break;
            }
            let Some((scaled, radius, factors)) = search.radius(n, Side::Below) else { break };
            if radius.upper.as_ref().is_some_and(|upper| *upper < 1) {
                let at = exponent(n);
                found.below = Some(ExponentBound { at, factors, system: scaled, radius });
                break;
            }
            // A better word, or some room.
            let better = radius.lower.as_ref().and_then(|lower| search.exponent_of(system, &lower.path, k));
            target = Some(match better.filter(|m| *m < n) {
                Some(m) => m.max(lo),
                None => n.saturating_sub(back).max(lo),
            });
            back *= 8;
        }
        found
    }

    /// The part of an interval that they leave.
    pub(super) fn cut(&self, whole: Interval) -> Interval {
        let at = |bound: &Option<ExponentBound<E>>| bound.as_ref().map(|b| b.at.clone());
        let (lo, hi) = (at(&self.below), at(&self.above));
        let end = |found: Option<Rational>, whole: Rational| match found {
            Some(bound) => bound,
            None => whole,
        };
        Interval::new(end(lo, whole.lo), end(hi, whole.hi))
    }
}

fn exponent(n: u64) -> Rational {
    Rational::from(n) / Rational::from(DENOMINATOR)
}

impl<E: Radial> Search<'_, E> {
    /// `⌊α DENOMINATOR⌋` for the `α` with `ρ(T_w) = s_w^α`, of a word of the system scaled for derivatives of order `k`; a proposal.
    #[allow(clippy::float_arithmetic, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a proposal")]
    fn exponent_of(&self, system: &System<E>, path: &[usize], k: u64) -> Option<u64> {
        let size = to_f64(&Lower::of(system, path)?.enclosure(60).mid()).ln() * path.len() as f64;
        let shares: Vec<&Rational> = self.shares.iter().flatten().collect();
        let shrunk: f64 = path.iter().filter_map(|a| shares.get(*a)).map(|s| to_f64(s).ln()).sum();
        let alpha = k as f64 + size / shrunk;
        (alpha.is_finite() && alpha >= 0.0).then_some((alpha * DENOMINATOR as f64).floor() as u64)
    }

    fn radius(&self, n: u64, side: Side) -> Option<(System<E>, JointRadius<E>, Shares)> {
        let factors: Shares = self
            .shares
            .iter()
            .map(|own| own.iter().map(|s| inverse_power(s, n, side)).collect::<Option<_>>())
            .collect::<Option<_>>()?;
        let system = self.curve.scaled_system(self.families, |from, letter| Some(factors[from][letter].clone()))?;
        let radius = joint_radius(&system, self.options).ok()?;
        Some((system, radius, factors))
    }

    fn bound(&self, n: u64, side: Side) -> Option<ExponentBound<E>> {
        let (system, radius, factors) = self.radius(n, side)?;
        let holds = match side {
            Side::Below => radius.upper.as_ref().is_some_and(|upper| *upper < 1),
            Side::Above => radius.lower.as_ref().is_some_and(|lower| lower.is_at_least(&Rational::from(1))),
        };
        holds.then(|| ExponentBound { at: exponent(n), factors, system, radius })
    }
}

/// A number next to `s^(−n/DENOMINATOR)`, not below it for a lower bound of the exponent and not above it for an upper bound:
/// floats propose it, and powers decide.
#[allow(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "floats propose")]
fn inverse_power(s: &Rational, n: u64, side: Side) -> Option<Rational> {
    if *s == 1 {
        return Some(Rational::from(1));
    }
    let near = (-to_f64(s).ln() * n as f64 / DENOMINATOR as f64).exp();
    let room = 2f64.powi(-44);
    let moved = if side == Side::Below { near * (1.0 + room) } else { near * (1.0 - room) };
    let scaled = Rational::try_from((moved * 2f64.powi(48)).round()).ok()?;
    let factor = scaled >> 48u64;
    // r^q s^n against 1.
    let whole = power(&factor, DENOMINATOR) * power(s, n);
    let safe = if side == Side::Below { whole >= 1 } else { whole <= 1 };
    (safe && factor > 0).then_some(factor)
}

fn power(base: &Rational, mut n: u64) -> Rational {
    let (mut square, mut product) = (base.clone(), Rational::from(1));
    while n > 0 {
        if n % 2 == 1 {
            product *= &square;
        }
        square = &square * &square;
        n /= 2;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn powers_lie_on_the_safe_side_of_the_number() {
        for s in [ratio(1, 3), ratio(2, 7), ratio(999, 1000)] {
            for n in [1, 4_000, 9_001] {
                let (up, down) =
                    (inverse_power(&s, n, Side::Below).unwrap(), inverse_power(&s, n, Side::Above).unwrap());
                assert!(down < up && &up - &down < ratio(1, 1 << 20) * &up, "{s} {n}");
            }
        }
        assert_eq!(inverse_power(&ratio(1, 1), 5, Side::Above), Some(ratio(1, 1)));
    }
}
