//! What `certify` says of a curve in its parameter: Theorem E within a small budget of its own, and the claims from it.

use super::branch::Context;
use super::claim::{Assertion, Claim, Measure, Reason};
use super::everywhere::Everywhere;
use super::smoothness::{CurveRegularity, CurveRegularityError, Outcome, curve_regularity};
use super::verdict::{Certified, Role, Verdict};
use crate::arith::Rational;
use crate::radius::Radial;
use crate::statement::Statement;

/// Largest number of coordinates of all visible quotients together for which this is tried.
const MAX_DIMENSIONS: usize = 24;

/// What is known of a curve in its parameter.
#[derive(Debug, Clone)]
pub enum Parameter<E = Rational> {
    /// The orders of smoothness, as far as the budget goes.
    Orders(Box<CurveRegularity<E>>),
    /// There is no such table.
    None(CurveRegularityError),
    /// There are so many coordinates that `secant regularity` should be asked.
    Large(usize),
}

/// Orders of smoothness of a curve; `None` for shapes that are no curves, or a single point.
pub(super) fn parameter<E: Radial>(cx: &Context<E>) -> Option<Parameter<E>> {
    let reachable = cx.shape.reachable();
    if cx.spaces.of(cx.shape.start).visible.rows() == 0 {
        return None;
    }
    let size: usize = reachable.iter().map(|&e| cx.spaces.of(e).visible.rows()).sum();
    if size > MAX_DIMENSIONS {
        return Some(Parameter::Large(size));
    }
    Some(match curve_regularity(cx.shape, cx.spaces, &cx.budget.orders) {
        Ok(found) => Parameter::Orders(Box::new(found)),
        Err(error) => Parameter::None(error),
    })
}

impl<E> Parameter<E> {
    /// Whether the curve is refuted to be `C¹`.
    pub(super) fn is_not_c1(&self) -> bool {
        matches!(self, Self::Orders(found) if found.is_smooth(1) == Some(false))
    }

    /// The claims: the largest order that holds, the next one, and the exponent.
    pub(super) fn claims(&self) -> Vec<Claim> {
        let by = Some(Statement::Smoothness);
        let Self::Orders(found) = self else {
            return vec![Claim::open(Assertion::Smooth { order: 1, over: Measure::Uniform }, Reason::NoOrder)];
        };
        let over = found.measure();
        if found.polynomial {
            return vec![Claim::proved(Assertion::Polynomial(over), by)];
        }
        let largest = found.smoothness();
        let mut claims = Vec::new();
        if largest > 0 {
            claims.push(Claim::proved(Assertion::Smooth { order: largest, over }, by));
        }
        let order = largest + 1;
        let (what, reason) = (Assertion::Smooth { order, over }, Reason::Order(order));
        claims.push(match found.is_smooth(order) {
            Some(false) => Claim::refuted(what, by, reason),
            _ => Claim::open(what, reason),
        });
        claims.push(match &found.exponent {
            Some(bounds) => Claim::proved(Assertion::Exponent(Some(bounds.clone()), over), by),
            None => Claim::open(Assertion::Exponent(None, over), Reason::Order(largest)),
        });
        claims
    }
}

/// Adds what is claimed of every point and of the parameter, and puts the claims in the order of their topics.
pub(super) fn add_claims(found: &mut Certified) {
    let mut claims = Vec::new();
    if let Some(every) = &found.everywhere {
        let reason = if breaks_inside(found, every) { Reason::InsidePoint } else { Reason::EveryPoint };
        claims.push(Claim::as_found(Assertion::G1, every.verdict, every.statement(), reason));
    }
    claims.extend(found.parameter.iter().flat_map(Parameter::claims));
    found.claims.extend(claims);
    found.claims.sort_by_key(|c| c.what.topic());
}

/// Whether G¹ is refuted at a point that is neither an end nor a joint.
fn breaks_inside(found: &Certified, every: &Everywhere) -> bool {
    let turns = every.hodograph.as_ref().is_some_and(|h| !h.turns.is_empty());
    every.verdict == Verdict::Refuted
        && match every.witness.and_then(|k| found.points.get(k)) {
            Some(point) => point.role == Role::Interior,
            // Where a polynomial turns back at a joint, that joint is the witness.
            None => turns,
        }
}

/// The order 1 that was proved with a larger budget takes the place of one that is open.
pub(super) fn adopt_derivative(found: &mut Certified) {
    let proved = found.everywhere.as_ref().filter(|e| e.verdict == Verdict::Proved);
    let Some(order) = proved.and_then(|e| e.derivative.as_deref()) else { return };
    if let Some(Parameter::Orders(orders)) = &mut found.parameter
        && let [_, first] = orders.orders.as_mut_slice()
        && first.outcome == Outcome::Open
        && first.shares == order.shares
    {
        *first = order.clone();
        orders.exponent = order.exponent(orders.pieces);
        orders.attained = None;
    }
}
