//! Where on a slider the scheme converges and is smooth, as coloured parts below it.
#![allow(clippy::float_arithmetic, reason = "places on a slider decide nothing")]

use super::catalogue::slider;
use crate::algebraic::Root;
use crate::arith::{Rational, to_f64};
use crate::ask::regions;
use crate::case::Setting;
use crate::diagnostic::Problem;
use crate::radius::family::Search;
use crate::report::region::{end_text, verdict};
use serde_json::{Value, json};

/// The parts of a slider for each order of smoothness.
///
/// # Errors
/// A [`Problem`] where there is no such slider, or the scheme is no mask with this parameter alone.
pub fn region(name: &str, parameter: &str) -> Result<Value, Problem> {
    // Nothing but the name of a scheme gets further.
    let values = slider(name, parameter).ok_or_else(|| {
        Problem::new("secant::studio::region", "no scheme has this parameter").with_help("choose one of the list")
    })?;
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return Ok(json!({ "orders": [] })) };
    let range = [(parameter.to_owned(), Setting::Range(first.clone(), last.clone()))];
    let found = regions(name, &range, usize::MAX, &Search::default())?;
    let orders = found.orders.iter().map(|order| {
        let parts = order.parts.iter().map(|part| {
            let (from, to) = (end_text(&part.from), end_text(&part.to));
            json!({
                "from": place(&values, &part.from),
                "to": place(&values, &part.to),
                "verdict": verdict(&part.finding).word(),
                "text": if part.is_point() { from } else { format!("{from} to {to}") },
            })
        });
        json!({ "order": order.order, "parts": parts.collect::<Vec<_>>() })
    });
    Ok(json!({ "orders": orders.collect::<Vec<_>>() }))
}

/// Where a number is on a slider, from 0 to 1.
fn place(values: &[Rational], end: &Root) -> f64 {
    let x = end.to_f64().0;
    let values: Vec<f64> = values.iter().map(to_f64).collect();
    let steps = values.len().saturating_sub(1).max(1) as f64;
    let inside = values.windows(2).position(|w| x <= w[1]);
    match inside {
        Some(k) => (k as f64 + ((x - values[k]) / (values[k + 1] - values[k])).clamp(0.0, 1.0)) / steps,
        None => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_the_slider_and_only_schemes_are_known() {
        let found = region("ternary-three-point", "b").expect("a region");
        for order in found["orders"].as_array().expect("orders") {
            let parts = order["parts"].as_array().expect("parts");
            assert!(parts[0]["from"] == 0.0 && parts[parts.len() - 1]["to"] == 1.0, "{order}");
            assert!(parts.windows(2).all(|w| w[0]["to"] == w[1]["from"]), "{order}");
        }
        for (name, parameter) in [("cases/schemes/dd4.toml", "w"), ("four-point", "v"), ("/etc/passwd", ""), ("", "")] {
            assert_eq!(region(name, parameter).expect_err("no slider").id(), "secant::studio::region");
        }
    }
}
