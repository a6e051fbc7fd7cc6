//! Certificates of the smoothness of schemes across a border.

use super::joint::radius_proof;
use super::lattice::lattice_proof;
use super::regularity::radius_with_a_rational_word;
use super::{Certificate, Unsupported, unsupported};
use crate::radius::{JointRadius, System};
use crate::theorem::border::{BorderAnswer, BorderOrder, BorderRegularity};
use serde_json::{Value, json};

/// The certificate of the orders that were decided: the proofs about the masks of both sides, and for each order the window and the
/// bounds of the radius, or what refutes it.
///
/// # Errors
/// [`Unsupported`] where a radius has no certificate, or nothing is decided.
pub fn border_certificate(name: &str, found: &BorderRegularity) -> Result<Certificate, Unsupported> {
    let sides = found.sides.iter().map(lattice_proof).collect::<Result<Vec<Value>, _>>()?;
    let decided = found.orders.iter().take_while(|o| !matches!(o.answer, BorderAnswer::Open(_)));
    let orders = decided.map(order).collect::<Result<Vec<Value>, _>>()?;
    if orders.is_empty() {
        return unsupported("continuity that is not decided", "orders");
    }
    Ok(Certificate::new("border", name, "proved", json!({"sides": sides, "orders": orders})))
}

fn order(o: &BorderOrder) -> Result<Value, Unsupported> {
    let side = |k: usize| Ok(json!({"by": if k == 0 { "left" } else { "right" }}));
    let Some(model) = &o.model else {
        return match o.answer {
            BorderAnswer::Side(k) => side(k),
            _ => unsupported("an order without a window", "orders"),
        };
    };
    let window: Value = model.points.iter().map(|p| p.iter().map(ToString::to_string).collect::<Value>()).collect();
    let below = o.answer == BorderAnswer::Smooth || o.sided;
    let radius = match (&o.radius, System::plain(&o.letters), below) {
        (Some(radius), Ok(system), true) => {
            // Only its upper bound is used.
            let radius = JointRadius { lower: None, ..radius_with_a_rational_word(&system, radius) };
            radius_proof(&system, &radius)?
        }
        _ => Value::Null,
    };
    let by = if o.answer == BorderAnswer::Jump { "jump" } else { "radius" };
    Ok(json!({"by": by, "reach": model.reach, "window": window, "radius": radius}))
}
