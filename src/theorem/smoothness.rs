//! Orders of smoothness of a curve in its parameter (theory §11, Theorem E): radii on a descending chain of invariant
//! spaces, and the joint equations of every order, all in the visible quotients `W_e` of §9.

use super::claim::Measure;
use super::derived::Curve;
use super::exponent::ExponentBounds;
use super::regularity::minus_log;
use crate::arith::{Interval, Rational};
use crate::radius::{Growth, JointRadius, Options, Radial, System};
use crate::shape::{Shape, Spaces, difference};
use thiserror::Error;

/// Why a curve has no table of orders.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CurveRegularityError {
    /// Without shares the parameter needs the same number of pieces in all states that come back to themselves.
    #[error(
        "the uniform parameter needs a curve all of whose states that come back to themselves have the same number of pieces, \
         at least 2"
    )]
    Pieces,
    /// The curve that is seen is a point.
    #[error("the curve is a single point")]
    Point,
    /// An end point is not unique, or an operator does not act on the visible quotients: the system does not contract.
    #[error("an end point of the curve of state {0} is not unique")]
    Ends(String),
}

/// By reachable state and letter, the part of the parameter that a piece takes.
pub type Shares = Vec<Vec<Rational>>;

/// What the statement says of one order `k`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome<E = Rational> {
    /// `k = 0`: the curve itself.
    Curve,
    /// The radius is below the threshold and the joint equations hold: `C^k`.
    Holds,
    /// The radius is below the threshold and a joint equation fails: not `C^k`.
    Joint(Jump<E>),
    /// The leading word of the radius is a cycle whose spectral radius is not below the threshold: not `C^k`.
    Cycle,
    /// In this state, which belongs to a strongly connected part that no arrow leaves, the chord of order `k−1` lies in `F_e`,
    /// and the curve of order `k−1` is more than a point: not `C^k`.
    Chord(usize),
    /// The supremum of the exponents of the order before is below `k`: not `C^k`.
    Exponent,
    /// Not decided by this statement.
    Open,
}

/// A joint at which the derivative of some order has two values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Jump<E = Rational> {
    /// The state.
    pub state: usize,
    /// The piece after the joint.
    pub right: usize,
    /// Where the curve of the start state has this joint, and its values there.
    pub seen: Option<Seen<E>>,
}

/// The two values of a derivative of the curve of the start state, as it is seen: with control points in their space, otherwise
/// vectors of sum 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen<E = Rational> {
    /// The path from the start to the state of the joint, along which the two values stay different.
    pub path: Vec<usize>,
    /// The value from the left.
    pub left: Vec<E>,
    /// The value from the right.
    pub right: Vec<E>,
}

/// What is known of one order.
#[derive(Debug, Clone)]
pub struct CurveOrder<E = Rational> {
    /// `k`.
    pub order: usize,
    /// `N^−k`, or 1 where the parameter has shares of its own, by which the operators are divided.
    pub threshold: Rational,
    /// By reachable state and letter, the part of the parameter that a piece takes, where these are not all `1/N`.
    pub shares: Option<Shares>,
    /// Dimensions of the spaces `F_e ⊂ W_e` of the differences of derivatives of order `k`.
    pub dims: Vec<usize>,
    /// The operators on them, arrows by state and letter; `None` where all are 0 (a polynomial).
    pub system: Option<System<E>>,
    /// Their joint spectral radius.
    pub radius: Option<JointRadius<E>>,
    /// Its enclosure; 0 on the space 0.
    pub enclosure: Option<Interval>,
    /// The conclusion.
    pub outcome: Outcome<E>,
    /// By reachable state, the numbers `μ_e` by which the differences of order `k` of the control polygons tend to the derivative;
    /// `None` where the order does not hold, or they need not tend to multiples of it (“Difference polygons”).
    pub polygons: Option<Vec<E>>,
}

impl<E> CurveOrder<E> {
    /// Whether the curve is `C^k`; `None` where that is not decided.
    #[must_use]
    pub fn smooth(&self) -> Option<bool> {
        match self.outcome {
            Outcome::Curve | Outcome::Holds => Some(true),
            Outcome::Joint(_) | Outcome::Cycle | Outcome::Chord(_) | Outcome::Exponent => Some(false),
            Outcome::Open => None,
        }
    }
}

/// The orders of smoothness of the curve of the start state, as it is seen.
#[derive(Debug, Clone)]
pub struct CurveRegularity<E = Rational> {
    /// `N`, the number of pieces of the states that come back to themselves; 1 where the pieces have shares.
    pub pieces: usize,
    /// The orders `0, 1, …` up to the first that fails or is open, at most [`MAX_ORDER`].
    pub orders: Vec<CurveOrder<E>>,
    /// Enclosure of the supremum of the Hölder exponents `k + α`, `0 < α <= 1`, for the last order `k` that holds; `None` for a
    /// polynomial, or where no bound is known.
    pub exponent: Option<Interval>,
    /// What proves the enclosure where the pieces have shares.
    pub bounds: ExponentBounds<E>,
    /// Whether that exponent is attained; `None` where that is not decided.
    pub attained: Option<bool>,
    /// Whether the curve is a polynomial in its parameter.
    pub polynomial: bool,
}

impl<E> CurveRegularity<E> {
    /// The parameter that the orders are about.
    #[must_use]
    pub fn measure(&self) -> Measure {
        if self.orders.iter().any(|o| o.shares.is_some()) { Measure::Shares } else { Measure::Uniform }
    }

    /// The largest `k` for which the curve is proved `C^k`.
    #[must_use]
    pub fn smoothness(&self) -> usize {
        self.orders.iter().filter(|o| o.smooth() == Some(true)).count() - 1
    }

    /// Whether the curve is `C^k`; `None` where that is not decided.
    #[must_use]
    pub fn is_smooth(&self, order: usize) -> Option<bool> {
        if self.polynomial || order <= self.smoothness() {
            return Some(true);
        }
        self.orders.iter().any(|o| o.order <= order && o.smooth() == Some(false)).then_some(false)
    }
}

/// Highest order that is examined.
pub const MAX_ORDER: usize = 31;

/// Analyses a curve whose pieces meet and which contracts (both are checked elsewhere).
///
/// # Errors
/// [`CurveRegularityError`].
///
/// # Cost
/// One joint spectral radius for each order.
pub fn curve_regularity<E: Radial>(
    shape: &Shape<E>,
    spaces: &Spaces<E>,
    options: &Options,
) -> Result<CurveRegularity<E>, CurveRegularityError> {
    let curve = Curve::new(shape, spaces)?;
    let (mut families, mut chords) = curve.first()?;
    let mut found = CurveRegularity {
        pieces: curve.pieces,
        orders: vec![curve.order(0, &families, options)],
        exponent: None,
        bounds: ExponentBounds::default(),
        attained: None,
        polynomial: false,
    };
    for k in 1..=MAX_ORDER {
        let smaller = curve.differences(k, &chords);
        let mut order = curve.order(k, &smaller, options);
        found.polynomial = smaller.iter().all(|f| f.rows() == 0);
        let values = if order.is_below() { curve.ends(k, &smaller, &chords) } else { None };
        order.outcome = match &values {
            Some(values) => curve.joints(k, values).map_or(Outcome::Holds, Outcome::Joint),
            None => match curve.refuted(&order, &families, &smaller, &chords) {
                Outcome::Open if found.orders[k - 1].is_above(&order.threshold) => Outcome::Exponent,
                outcome => outcome,
            },
        };
        let holds = order.smooth() == Some(true);
        if holds {
            order.polygons = curve.polygons(k, &smaller, &chords);
        }
        found.polynomial &= holds;
        found.orders.push(order);
        if !holds || found.polynomial {
            break;
        }
        families = smaller;
        chords = values.iter().flatten().map(|[start, finish]| difference(finish, start)).collect();
    }
    if !found.polynomial {
        let last = &found.orders[found.smoothness()];
        found.exponent = last.exponent(curve.pieces);
        if last.shares.is_some() {
            found.bounds = ExponentBounds::of(&curve, last, &families, options);
            found.exponent = found.exponent.map(|whole| found.bounds.cut(whole));
            return Ok(found);
        }
        found.attained = last.radius.as_ref().and_then(|r| match r.growth {
            Growth::Bounded => Some(true),
            Growth::Unbounded(_) if r.exact => Some(false),
            _ => None,
        });
    }
    Ok(found)
}

impl<E> CurveOrder<E> {
    /// An upper bound of the radius of the operators of derivatives of this order on their differences: the differences of control
    /// polygons converge at every rate above it.
    #[must_use]
    pub fn rate(&self) -> Option<Rational> {
        Some(&self.enclosure.as_ref()?.hi / &self.threshold)
    }

    pub(super) fn is_below(&self) -> bool {
        self.enclosure.as_ref().is_some_and(|e| e.hi < self.threshold)
    }

    /// Whether the radius is proved to be greater than a number.
    fn is_above(&self, bound: &Rational) -> bool {
        self.enclosure.as_ref().is_some_and(|e| e.lo > *bound)
    }

    /// Whether the leading word of the radius is a cycle with `ρ(N^(k|w|) T_w) >= 1`.
    pub(super) fn has_slow_cycle(&self) -> bool {
        self.radius.as_ref().and_then(|r| r.lower.as_ref()).is_some_and(|lower| lower.is_at_least(&self.threshold))
    }

    /// Enclosure of `−log_N` of the radius, cut with `[k, k+1]`, where it lies if this order holds and its differences are not 0;
    /// with shares that interval itself.
    pub(super) fn exponent(&self, pieces: usize) -> Option<Interval> {
        let (least, most) = (Rational::from(self.order as u64), Rational::from(self.order as u64 + 1));
        if self.shares.is_some() {
            return Some(Interval::new(least, most));
        }
        let radius = self.enclosure.as_ref()?;
        let own = minus_log(radius, pieces)?;
        let (lo, hi) = (own.lo.max(least.clone()), own.hi.min(most.clone()));
        (lo <= hi).then(|| Interval::new(lo, hi))
    }
}
