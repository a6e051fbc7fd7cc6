//! What is said of the curvature at a vertex.

use super::document::{Table, words};
use crate::arith::to_f64;
use crate::vertex::{AtValence, Curvature, Second, Size};
use serde_json::{Value, json};

/// Its size and C² for almost all control points, in a few words.
pub(super) fn size(c: &Curvature) -> String {
    match (c.size, c.second, c.exponent) {
        (_, Second::Flat, _) => "tends to 0; C², flat".to_owned(),
        (_, Second::Regular, _) => "bounded; C² (regular)".to_owned(),
        (Size::Unbounded, _, Some(p)) if p.is_finite() => format!("unbounded, p* = {p:.3}"),
        (Size::Unbounded, ..) if c.power > 0 => {
            let factor = if c.power == 1 { "m".to_owned() } else { format!("m^{}", c.power) };
            format!("unbounded like {factor} on ring m, in L^p for all p")
        }
        (Size::Unbounded, ..) => "unbounded".to_owned(),
        (Size::Bounded, Second::No, _) => "bounded, not C²".to_owned(),
        (Size::Bounded, ..) => "bounded; C² not decided".to_owned(),
        (Size::Vanishing, ..) => "tends to 0".to_owned(),
    }
}

/// The shapes that are excluded near the vertex for almost all control points.
fn shapes(c: &Curvature) -> &'static str {
    if c.excludes_convex() {
        "not convex"
    } else if c.excludes_saddles() {
        "no ordinary saddles"
    } else {
        "–"
    }
}

/// Bounds of `ρ/λ²` that a decimal stands for: those that vanish have an upper one only.
fn quotient(c: &Curvature) -> String {
    if c.size == Size::Vanishing { "< 1".to_owned() } else { format!("{:.5}", to_f64(&c.ratio.mid())) }
}

pub(super) fn blocks(c: &Curvature, valence: usize) -> String {
    let name = |k: &usize| {
        if *k == 0 || 2 * k == valence { k.to_string() } else { format!("{k}, {}", valence - k) }
    };
    c.blocks.as_ref().map_or_else(|| "–".to_owned(), |list| list.iter().map(name).collect::<Vec<_>>().join(", "))
}

/// The table by valence, where anything is known.
pub(super) fn table(found: &[AtValence]) -> Option<Table> {
    let known: Vec<(usize, &Curvature)> =
        found.iter().filter_map(|f| Some((f.valence, f.curvature.as_ref()?))).collect();
    if known.is_empty() {
        return None;
    }
    let row = |(n, c): &(usize, &Curvature)| {
        vec![n.to_string(), quotient(c), size(c), blocks(c, *n), shapes(c).to_owned()].into_iter().map(words).collect()
    };
    let header = ["valence", "ρ/λ²", "curvature", "blocks of ρ", "shapes"].map(words).to_vec();
    let caption = words(
        "The curvature of almost all control points (Size of the curvature); flat it is for all with independent leading coefficients.",
    );
    Some(Table { caption, header, rows: known.iter().map(row).collect() })
}

/// Enclosure of ρ/λ², as two exact ends; where the curvature tends to 0 only an upper bound below 1 is known.
pub(super) fn ratio(c: &Curvature) -> Value {
    super::regularity::bounds(&c.ratio)
}

/// The same as data.
pub(super) fn data(c: &Curvature) -> Value {
    json!({
        "almost_all": size(c),
        "ratio": ratio(c),
        "power": c.power,
        "exponent": c.exponent.filter(|p| p.is_finite()),
        "c2": match c.second {
            Second::Flat | Second::Regular => Value::Bool(true),
            Second::No => Value::Bool(false),
            Second::Open => Value::Null,
        },
        "blocks": c.blocks,
        "excludes_convex": c.excludes_convex(),
        "excludes_saddles": c.excludes_saddles(),
    })
}
