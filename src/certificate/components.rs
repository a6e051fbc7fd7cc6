//! The answers about every point of a curve by polynomial arcs (Theorem 6″) and by components (Theorem 13).

use super::branch::{branch_name, point};
use super::everywhere::{cone, images, slow_cycle};
use super::top::elements;
use super::{Unsupported, address_json, numbers, unsupported};
use crate::arith::Rational;
use crate::poly::Poly;
use crate::shape::Shape;
use crate::theorem::cone::CommonCone;
use crate::theorem::{Component, Components, Hodograph, PointReport, Role, Verdict};
use serde_json::{Value, json};

/// The arcs of a curve, by reachable state.
pub fn arcs(shape: &Shape, found: &Hodograph, verdict: Verdict) -> Value {
    let states = shape.reachable();
    let of = |e: usize| found.polynomials[e].as_ref();
    let degree = states.iter().filter_map(|&e| of(e)).flatten().filter_map(Poly::degree).fold(0, usize::max);
    let row = |p: &Poly| {
        let coefficient = |k: usize| p.coeffs().get(k).cloned().unwrap_or_else(|| Rational::from(0));
        numbers(&(0..=degree).map(coefficient).collect::<Vec<_>>())
    };
    let arcs = states.iter().map(|&e| of(e).map(|arc| arc.iter().map(row).collect::<Value>()));
    json!({
        "question": "every point by polynomials",
        "verdict": verdict.word(),
        "degree": degree,
        "arcs": arcs.collect::<Value>(),
    })
}

/// The states, each behind those that it needs.
pub fn components(shape: &Shape, found: &Components) -> Result<Value, Unsupported> {
    let parts = found.parts.iter().map(|p| part(shape, p)).collect::<Result<Value, _>>()?;
    let seen = match &found.sight {
        None => Value::Null,
        Some((cones, code)) => {
            let (rays, maps) = of_states(shape, &shape.reachable(), cones)?;
            let word = |(word, row): &(Vec<usize>, Vec<Rational>)| json!({"word": word, "functional": numbers(row)});
            json!({"cones": rays, "maps": maps, "code": code.iter().map(word).collect::<Value>()})
        }
    };
    Ok(json!({"question": "every point by components", "verdict": "proved", "parts": parts, "seen": seen}))
}

/// The cones of some states, and the images of their rays.
fn of_states(shape: &Shape, states: &[usize], found: &CommonCone) -> Result<(Value, Value), Unsupported> {
    let cones = states.iter().map(|&e| cone(shape, found, e)).collect::<Result<Value, _>>()?;
    Ok((cones, states.iter().map(|&e| images(found, e)).collect()))
}

fn part(shape: &Shape, part: &Component) -> Result<Value, Unsupported> {
    let joints = |points: &[PointReport]| points.iter().map(|p| place(shape, p)).collect::<Result<Value, _>>();
    match part {
        Component::Cones { state, cone, joints: points } => {
            // States come in the order of the case.
            let mut states = shape.reachable();
            states.retain(|e| cone.cones.iter().any(|c| c.state == *e));
            let (cones, maps) = of_states(shape, &states, cone)?;
            let at = |p: &PointReport, e: usize| matches!(p.role, Role::Joint { state, .. } if state == e);
            let of = |e: &usize| points.iter().filter(|p| at(p, *e)).cloned().collect::<Vec<_>>();
            let ordered: Vec<PointReport> = states.iter().flat_map(of).collect();
            let slow = cone.slow.iter().map(slow_cycle).collect::<Result<Value, _>>()?;
            Ok(json!({
                "part": "cones", "state": state, "cones": cones, "maps": maps, "window": cone.window, "slow": slow,
                "joints": joints(&ordered)?,
            }))
        }
        Component::Loop { state, letter, pull, points } => {
            let Some((fixed, first)) = points.split_last() else {
                return unsupported("a loop without points", "every point");
            };
            let top = super::top::top::<Rational>(&pull.linear, &pull.spectrum, pull.lead, &format!("loop {letter}"))?;
            Ok(json!({
                "part": "loop", "state": state, "letter": letter, "top": top, "functional": elements(&pull.functional),
                "joints": joints(first)?, "fixed": place(shape, fixed)?,
            }))
        }
        Component::Transient { state, points } => {
            Ok(json!({"part": "transient", "state": state, "joints": joints(points)?}))
        }
    }
}

/// A point from its own state.
fn place(shape: &Shape, report: &PointReport) -> Result<Value, Unsupported> {
    let place = match &report.role {
        Role::LeftEnd => json!({"at": "left end"}),
        Role::RightEnd => json!({"at": "right end"}),
        Role::Joint { path, left, right, .. } => json!({"at": "joint", "path": path, "left": left, "right": right}),
        Role::Interior => json!({"at": "inside", "address": address_json(&report.branches[0].address)}),
        Role::SetPoint => return unsupported("a point of a set", branch_name(&report.branches[0])),
    };
    point(shape, report, &place)
}
