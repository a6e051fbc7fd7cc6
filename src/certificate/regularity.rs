//! Certificates of the orders of smoothness of a curve.

use super::joint::{headed, radius_proof, stated};
use super::written::Written;
use super::{Certificate, Unsupported, contraction, number, numbers, unsupported};
use crate::algebraic::Root;
use crate::case::Case;
use crate::radius::{JointRadius, Lower, System};
use crate::shape::{Contraction, Spaces};
use crate::theorem::Measure;
use crate::theorem::exponent::ExponentBound;
use crate::theorem::smoothness::{CurveOrder, CurveRegularity, Outcome};
use serde_json::{Value, json};

/// The certificate of the orders that were decided: their radii and what follows.
///
/// # Errors
/// [`Unsupported`] where contraction is not proved, or a radius has no certificate.
pub fn regularity_certificate<E: Written>(
    case: &Case<E>,
    spaces: &Spaces<E>,
    contracts: &Contraction,
    found: &CurveRegularity<E>,
) -> Result<Certificate, Unsupported> {
    let shape = &case.shape;
    let Some(balls) = E::balls(shape, spaces, contracts) else {
        return unsupported("a system whose contraction is not proved", "contraction");
    };
    let radii = shape.reachable().into_iter().map(|e| (e, balls.radius(e)));
    let states = contraction(shape, contracts, radii, None)?;
    let decided = found.orders.iter().take_while(|o| o.smooth().is_some());
    let orders = decided.map(order).collect::<Result<Vec<Value>, _>>()?;
    let proof = match found.measure() {
        Measure::Uniform => json!({"contraction": states, "orders": orders}),
        Measure::Shares => {
            let [below, above] = [&found.bounds.below, &found.bounds.above].map(exponent);
            json!({"contraction": states, "orders": orders, "exponent": {"below": below?, "above": above?}})
        }
    };
    Ok(Certificate::new("regularity", &case.name, "proved", headed(E::field(case)?, proof)))
}

/// On which side of an exponent the supremum lies, and why.
fn exponent<E: Written>(bound: &Option<ExponentBound<E>>) -> Result<Value, Unsupported> {
    let Some(bound) = bound else { return Ok(Value::Null) };
    let factors: Vec<Value> = bound.factors.iter().map(|own| numbers(own)).collect();
    let radius = radius(Some(&bound.system), Some(&bound.radius), "exponent")?;
    Ok(json!({"at": number(&bound.at), "factors": factors, "radius": radius}))
}

/// The bounds of the radius of a system; `null` where all spaces are 0.
pub fn radius<E: Written>(
    system: Option<&System<E>>,
    found: Option<&JointRadius<E>>,
    place: &str,
) -> Result<Value, Unsupported> {
    match (system, found) {
        (None, _) => Ok(Value::Null),
        (Some(system), Some(found)) => radius_proof(system, &radius_with_a_rational_word(system, found)),
        (Some(_), None) => unsupported("a radius without bounds", place),
    }
}

pub fn order<E: Written>(order: &CurveOrder<E>) -> Result<Value, Unsupported> {
    let place = format!("order {}", order.order);
    if let (Outcome::Cycle, Some(system), Some(found)) = (&order.outcome, &order.system, &order.radius) {
        let lower = radius_with_a_rational_word(system, found).lower;
        let lower = lower.as_ref().map(|lower| stated(system, lower)).transpose()?;
        if lower.is_none_or(|lower| lower < order.threshold) {
            return unsupported("an eigenvalue on the threshold itself", place);
        }
    }
    let radius = radius(order.system.as_ref(), order.radius.as_ref(), &place)?;
    let outcome = match &order.outcome {
        Outcome::Curve => "curve",
        Outcome::Holds => "holds",
        Outcome::Joint(_) => "joint",
        Outcome::Cycle => "cycle",
        Outcome::Chord(_) => "chord",
        Outcome::Exponent => "exponent",
        Outcome::Open => return unsupported("an order that is not decided", place),
    };
    Ok(json!({"order": order.order, "dims": order.dims, "radius": radius, "outcome": outcome}))
}

/// Powers of the leading word that are tried.
const POWERS: [usize; 7] = [2, 3, 4, 5, 6, 8, 12];

/// The same bounds, with a power of the leading word whose leading eigenvalue is rational, where there is one: only of such
/// words a certificate says more than an inequality with room.
pub(super) fn radius_with_a_rational_word<E: Written>(system: &System<E>, radius: &JointRadius<E>) -> JointRadius<E> {
    let irrational = radius.lower.as_ref().filter(|l| l.rational().is_none());
    let power = irrational.and_then(|lower| {
        let powers = POWERS.iter().filter_map(|k| Lower::of(system, &lower.path.repeat(*k)));
        powers.into_iter().find(|l| l.root().and_then(Root::rational).is_some())
    });
    JointRadius { lower: power.or_else(|| radius.lower.clone()), ..radius.clone() }
}
