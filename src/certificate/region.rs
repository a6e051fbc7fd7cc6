//! Certificates of the regions of a mask with a parameter.

use super::Certificate;
use crate::algebraic::Root;
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::radius::family::{Cover, Piece, Seed};
use crate::theorem::region::{Finding, MaskFamily, OrderRegion, Part};
use serde_json::{Value, json};

/// The certificate of the parts that have one; the others are in it as undetermined.
#[must_use]
pub fn region_certificate(name: &str, family: &MaskFamily, orders: &[OrderRegion]) -> Certificate {
    let independent = family.independent.as_ref().map_or_else(Vec::new, |i| i.choices.clone());
    let choice = |(column, words): &(usize, Vec<Vec<usize>>)| json!({"column": column, "words": words});
    let mut all = Vec::new();
    let list: Vec<Value> = orders.iter().map(|o| order(o, &mut all)).collect();
    let verdict = Verdict::all(all.len(), all);
    let choices: Vec<Value> = independent.iter().map(choice).collect();
    Certificate::new("region", name, verdict.word(), json!({"independent": choices, "orders": list}))
}

fn order(order: &OrderRegion, all: &mut Vec<Verdict>) -> Value {
    let covers = order.radius.as_ref().map_or_else(Vec::new, |r| r.covers.iter().map(hull).collect());
    let parts: Vec<Value> = order.fine.iter().map(|p| part(order, p, all)).collect();
    json!({"order": order.order, "hulls": covers, "parts": parts})
}

pub(super) fn text(q: &Rational) -> Value {
    json!(q.to_string())
}

pub(super) fn hull(cover: &Cover) -> Value {
    let seed = |s: &Seed| match s {
        Seed::Eigen { word, column, scale } => json!({"word": word, "column": column, "scale": text(scale)}),
        Seed::Axis { index, scale } => json!({"word": [], "column": index, "scale": text(scale)}),
    };
    let vertices: Vec<Value> = cover.hull.vertices.iter().map(|v| json!({"seed": v.seed, "word": v.word})).collect();
    let piece = |p: &Piece| {
        let values: Vec<Vec<Value>> = p.values.iter().map(|v| v.iter().map(text).collect()).collect();
        json!({"to": text(&p.to), "values": values, "bases": p.bases})
    };
    json!({
        "seeds": cover.hull.seeds.iter().map(seed).collect::<Vec<_>>(),
        "vertices": vertices,
        "from": text(cover.range().0),
        "pieces": cover.pieces.iter().map(piece).collect::<Vec<_>>(),
    })
}

/// Binary places of the interval that names an end.
const PLACES: u64 = 160;

pub(super) fn end(end: &Root) -> Value {
    end.rational().map_or_else(
        || {
            let (f, near) = (end.minpoly().monic(), end.enclosure(PLACES).0);
            let coefficients: Vec<Value> = f.coeffs().iter().map(text).collect();
            json!({"polynomial": coefficients, "interval": [text(&near.lo), text(&near.hi)]})
        },
        |q| json!({"polynomial": [text(&-&q), "1"], "interval": [text(&q), text(&q)]}),
    )
}

fn part(order: &OrderRegion, part: &Part, all: &mut Vec<Verdict>) -> Value {
    let (verdict, rule, at) = match (&part.finding, &order.radius) {
        (Finding::Proved(k), _) => (Verdict::Proved, "hull", json!([k])),
        (Finding::Word(k), Some(r)) => (Verdict::Refuted, "word", json!(r.crossings[*k].word)),
        (Finding::SumRules, _) => (Verdict::Refuted, "sum-rules", json!([])),
        _ => (Verdict::Undetermined, "none", json!([])),
    };
    all.push(verdict);
    json!({"from": end(&part.from), "to": end(&part.to), "verdict": verdict.word(), "rule": rule, "by": at})
}
