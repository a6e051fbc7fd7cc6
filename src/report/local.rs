//! Critical orders and local fractional derivatives, in words and as data (Theorem L).

use super::document::{Line, line, words};
use super::math::Math;
use super::radius::interval;
use super::regularity::bounds;
use super::words::{count, listed};
use crate::arith::Rational;
use crate::shape::word_text;
use crate::theorem::Side;
use crate::theorem::characteristic::Characteristic;
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

/// Whether the characteristic map is injective, with its name.
pub(super) fn characteristic(side: &LocalSide) -> Option<(String, Line)> {
    let word = |w: &Vec<usize>| format!("`{}`", word_text(w));
    let text = match side.characteristic.as_ref()? {
        Characteristic::Injective { cells } => {
            let cover = if *cells == 1 { "covers" } else { "cover" };
            format!(
                "the characteristic map is injective: it is strictly monotone on {} that {cover} the ring",
                count(*cells, "cell")
            )
        }
        Characteristic::Not { words } => match words.as_slice() {
            [one] => format!(
                "the characteristic map is not injective: it has the same value at both ends of the cell {}",
                word(one)
            ),
            words => format!(
                "the characteristic map is not injective: it changes in opposite directions on the cells {}",
                listed(&words.iter().map(word).collect::<Vec<_>>())
            ),
        },
        Characteristic::Open => {
            "neither cones nor chords of a few hundred cells show whether the characteristic map is injective"
                .to_owned()
        }
    };
    Some((format!("map {}", self::word(side)), line(&text, [])))
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
    let map = side.characteristic.as_ref().map(|found| match found {
        Characteristic::Injective { cells } => json!({ "injective": true, "cells": cells }),
        Characteristic::Not { words } => json!({ "injective": false, "words": words }),
        Characteristic::Open => json!({ "injective": null }),
    });
    json!({
        "side": sides, "order": bounds(&side.order), "integer": side.integer, "limit": limit, "characteristic_map": map,
    })
}
