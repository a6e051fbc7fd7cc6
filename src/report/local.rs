//! Critical orders and local fractional derivatives, in words and as data (Theorem L).

use super::document::{Line, line, words};
use super::math::Math;
use super::radius::interval;
use super::regularity::bounds;
use crate::arith::Rational;
use crate::theorem::Side;
use crate::theorem::local::{LocalLimit, LocalSide};
use serde_json::{Value, json};

/// The name of the fact.
pub(super) fn name(side: &LocalSide) -> String {
    format!("order {}", word(side))
}

fn word(side: &LocalSide) -> &'static str {
    match side.side {
        Side::Left => "(left)",
        Side::Right => "(right)",
        Side::Both => "(both sides)",
    }
}

/// The order, and what the quotient does.
pub(super) fn fact(side: &LocalSide) -> Line {
    let mut out = match side.integer {
        Some(h) => line("$h=@$", [Math::count(h)]),
        None => words(format!("h in {}", interval(&side.order))),
    };
    out.extend(match &side.limit {
        LocalLimit::Value(v) => line("; the local fractional derivative is $@$", [Math::vector(v)]),
        LocalLimit::Band { direction, least, most } => {
            let mut text = line(
                "; no local fractional derivative: $(γ(t)-p)/|t|^h$ approaches $B(t)v$, $v=@$, and ",
                [Math::vector(direction)],
            );
            text.extend(words(format!(
                "B has its infimum in {} and its supremum in {}",
                interval(least),
                interval(most)
            )));
            text
        }
        LocalLimit::None => words("; no local fractional derivative"),
        LocalLimit::Diverges(power) => line(
            "; no local fractional derivative: the quotient grows like $m^{@}$ after $m$ turns",
            [Math::count(*power)],
        ),
    });
    out.extend(words(" (Theorem L)"));
    out
}

/// As data (docs/json.md).
pub(super) fn value(side: &LocalSide) -> Value {
    let texts = |v: &[Rational]| v.iter().map(ToString::to_string).collect::<Vec<_>>();
    let limit = match &side.limit {
        LocalLimit::Value(v) => json!({ "exists": true, "value": texts(v) }),
        LocalLimit::Band { direction, least, most } => json!({
            "exists": false, "direction": texts(direction), "infimum": bounds(least), "supremum": bounds(most),
        }),
        LocalLimit::None => json!({ "exists": false }),
        LocalLimit::Diverges(power) => json!({ "exists": false, "power": power }),
    };
    let sides = match side.side {
        Side::Left => "left",
        Side::Right => "right",
        Side::Both => "both",
    };
    json!({ "side": sides, "order": bounds(&side.order), "integer": side.integer, "limit": limit })
}
