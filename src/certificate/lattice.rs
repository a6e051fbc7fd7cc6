//! Certificates of the regularity of masks on lattices.

use super::joint::{radius_proof, stated};
use super::regularity::radius_with_a_rational_word;
use super::{Certificate, Unsupported, unsupported};
use crate::arith::Rational;
use crate::radius::{JointRadius, System};
use crate::theorem::lattice::{Answer, Cells, LatticeRegularity, Stability};
use serde_json::{Value, json};

/// The certificate of the orders that were decided: the window, the bounds of the radius, and why shifts are stable.
///
/// # Errors
/// [`Unsupported`] where the radius has no certificate, or nothing is decided.
pub fn lattice_certificate(name: &str, found: &LatticeRegularity) -> Result<Certificate, Unsupported> {
    Ok(Certificate::new("lattice", name, "proved", lattice_proof(found)?))
}

/// What proves these orders.
pub(super) fn lattice_proof(found: &LatticeRegularity) -> Result<Value, Unsupported> {
    let Ok(system) = System::plain(&found.letters) else {
        return unsupported("a window without a quotient", "window");
    };
    let radius = radius_with_a_rational_word(&system, &found.radius);
    // A word whose eigenvalue cannot be written down is left out: it refutes only.
    let lower = radius.lower.as_ref().and_then(|lower| stated(&system, lower).ok());
    let radius = match lower {
        Some(_) => radius_proof(&system, &radius)?,
        None => radius_proof(&system, &JointRadius { lower: None, ..radius })?,
    };
    let m = found.mask.dilation();
    // Of an irrational radius only a number below it is written down, which does not refute what the radius itself does.
    let shown = |order: usize| {
        let power = |x: &Rational, k: usize| (0..k).fold(Rational::from(1), |p, _| p * x);
        let bound = power(&Rational::from(m.index() as u64), order);
        lower.as_ref().is_some_and(|x| power(x, m.dimensions()) * bound >= 1)
    };
    let words = found.orders.iter().enumerate().map_while(|(k, answer)| match answer {
        Answer::Smooth => Some("smooth"),
        Answer::Rough if shown(k) => Some("rough"),
        Answer::Rules => Some("rules"),
        Answer::Rough | Answer::Unstable | Answer::Open => None,
    });
    let orders: Vec<&str> = words.collect();
    if orders.is_empty() {
        return unsupported("convergence that is not decided", "orders");
    }
    let window: Value = found.window.points.iter().map(|p| point(p)).collect();
    Ok(json!({
        "rules": found.sum_rules, "window": window, "radius": radius,
        "shifts": shifts(&found.stability), "orders": orders,
    }))
}

fn point(a: &[i64]) -> Value {
    a.iter().map(ToString::to_string).collect()
}

fn shifts(stability: &Stability) -> Value {
    match stability {
        Stability::Interpolatory(at) => json!({"stable": "interpolatory", "at": point(at)}),
        Stability::Unimodular => json!({"stable": "unimodular"}),
        Stability::Samples(s) => {
            let charts: Value = s.charts.iter().map(cells).collect();
            json!({"stable": "samples", "words": s.words, "charts": charts})
        }
        Stability::Dependent(_) | Stability::Unknown => Value::Null,
    }
}

fn cells(cells: &Cells) -> Value {
    match cells {
        Cells::Leaf(k) => json!(k),
        Cells::Parts(parts) => parts.iter().map(self::cells).collect(),
    }
}
