//! Certificates of the orders of smoothness of a curve.

use super::joint::radius_proof;
use super::{Certificate, Unsupported, contraction, unsupported};
use crate::case::Case;
use crate::shape::{Balls, Contraction, Spaces};
use crate::theorem::smoothness::{CurveOrder, CurveRegularity, JointEquation};
use serde_json::{Value, json};

/// The certificate of the orders that were decided: their radii, and whether their joint equations hold.
///
/// # Errors
/// [`Unsupported`] where contraction is not proved, or a radius has no certificate.
pub fn regularity_certificate(
    case: &Case,
    spaces: &Spaces,
    contracts: &Contraction,
    found: &CurveRegularity,
) -> Result<Certificate, Unsupported> {
    let shape = &case.shape;
    let Some(balls) = Balls::of(shape, spaces, contracts) else {
        return unsupported("a system whose contraction is not proved", "contraction");
    };
    let radii = shape.reachable().into_iter().map(|e| (e, balls.radius(e)));
    let states = contraction(shape, contracts, radii, None)?;
    let decided = found.orders.iter().take_while(|o| o.smooth.is_some());
    let orders = decided.map(order).collect::<Result<Vec<Value>, _>>()?;
    let proof = json!({"contraction": states, "orders": orders});
    Ok(Certificate::new("regularity", &case.name, "proved", proof))
}

fn order(order: &CurveOrder) -> Result<Value, Unsupported> {
    let radius = match (&order.system, &order.radius) {
        (None, _) => Value::Null,
        (Some(system), Some(radius)) => radius_proof(system, radius)?,
        (Some(_), None) => return unsupported("a radius without bounds", format!("order {}", order.order)),
    };
    let joints = match &order.joints {
        None => "none",
        Some(JointEquation::Holds) => "holds",
        Some(JointEquation::Fails { .. }) => "fails",
    };
    Ok(json!({"order": order.order, "dims": order.dims, "radius": radius, "joints": joints}))
}
