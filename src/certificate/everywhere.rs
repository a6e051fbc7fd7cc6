//! The answer about every point of a curve: cones, joints, or the point that refutes.

use super::branch::point;
use super::components::{arcs, components};
use super::top::{elements, top};
use super::written::{Listed, Written, matrix, values};
use super::{Unsupported, number, numbers, unsupported};
use crate::arith::{Integer, Interval, Rational};
use crate::shape::Shape;
use crate::theorem::cone::CommonCone;
use crate::theorem::{Assertion, Certified, EveryJoint, Everywhere, PointReport, Reason, Role, SlowCycle, Verdict};
use serde_json::{Value, json};

/// The answer to "every point", where there is something to prove; `position` says where a point stands in the certificate.
///
/// # Errors
/// [`Unsupported`] where the format cannot express what was found. It is no question of the case, so that the certificate of the
/// others stands.
pub fn answer(shape: &Shape, found: &Certified, position: Listed<'_, Rational>) -> Result<Option<Value>, Unsupported> {
    let Some(every) = &found.everywhere else { return Ok(None) };
    let witness = match every.witness {
        Some(k) => vec![position(&found.points[k])?],
        None => Vec::new(),
    };
    if let Some(found) = every.hodograph.as_ref().filter(|_| witness.is_empty()) {
        return Ok(Some(arcs(shape, found, every.verdict)));
    }
    if let Some(found) = &every.components {
        return components(shape, found).map(Some);
    }
    if let Some(order) = every.derivative.as_deref().filter(|_| every.verdict == Verdict::Proved) {
        let radius = super::regularity::order(order)?["radius"].take();
        return Ok(Some(match &order.shares {
            None => json!({"question": "every point by its derivative", "verdict": "proved", "radius": radius}),
            Some(shares) => {
                let shares: Value = shares.iter().map(|s| numbers(s)).collect();
                json!({"question": "every point by its derivative in shares", "verdict": "proved", "shares": shares,
                       "radius": radius})
            }
        }));
    }
    match &every.cone {
        Some(cone) => with_cone(shape, found, every, cone, &witness, position).map(Some),
        None if !witness.is_empty() => Ok(Some(refuted(&witness))),
        None if every.verdict == Verdict::Undetermined => Ok(None),
        None => unsupported("this evidence", "every point"),
    }
}

/// A point refutes that the tangent turns everywhere.
fn refuted(witness: &[usize]) -> Value {
    json!({
        "question": "every point", "verdict": "refuted", "cones": [], "maps": [], "view": null, "window": 0,
        "slow": [], "rate": null, "joints": [], "witness": witness,
    })
}

/// The answer to "every point" of a curve over a number field: cones with positive maps and regular joints, or a point.
///
/// # Errors
/// [`Unsupported`] where a joint cannot be expressed.
pub fn over_field<E: Written>(shape: &Shape<E>, found: &Certified<E>, position: Listed<'_, E>) -> super::Further {
    let broken = found.claims.iter().find_map(|c| match (&c.what, c.reason()) {
        (Assertion::G1, Some(Reason::Broken(k))) => Some(*k),
        _ => None,
    });
    if let Some(k) = broken {
        return Ok(Some(refuted(&[position(&found.points[k])?])));
    }
    if let Some(order) = &found.graph {
        let radius = super::regularity::order(order)?["radius"].take();
        return Ok(Some(json!({"question": "every point by its derivative", "verdict": "proved", "radius": radius})));
    }
    let Some(cone) = &found.cones else { return Ok(None) };
    let mut cones = Vec::new();
    let mut maps = Vec::new();
    for e in shape.reachable() {
        let Some(c) = cone.cones.iter().find(|c| c.state == e) else {
            return unsupported("a state without a cone", shape.states[e].name.clone());
        };
        let rays = matrix(&c.rays.transpose());
        cones.push(json!({"rays": rays, "functional": values(&c.functional), "chord": values(&c.chord)}));
        maps.push(cone.maps.iter().filter(|m| m.state == e).map(|m| matrix(&m.matrix)).collect::<Value>());
    }
    let own = cone.cones.iter().find(|c| c.state == shape.start).filter(|_| shape.control.is_none());
    let seen = cone.view.as_deref().or(own.map(|c| c.functional.as_slice()));
    let mut joints = Vec::new();
    for report in &cone.joints {
        let Role::Joint { state, left, right, .. } = &report.role else {
            return unsupported("a point that is no joint", "every point");
        };
        let place = json!({"at": "joint", "path": [], "left": left, "right": right});
        joints.push(json!({"state": state, "point": point(shape, report, &place)?}));
    }
    Ok(Some(json!({
        "question": "every point",
        "verdict": Verdict::Proved.word(),
        "cones": cones,
        "maps": maps,
        "view": seen.map(values),
        "window": 1,
        "slow": [],
        "rate": null,
        "joints": joints,
        "witness": [],
    })))
}

/// The cone of a state.
pub fn cone(shape: &Shape, found: &CommonCone, e: usize) -> Result<Value, Unsupported> {
    let Some(c) = found.cones.iter().find(|c| c.state == e) else {
        return unsupported("a state without a cone", shape.states[e].name.clone());
    };
    let rays = matrix(&c.rays.transpose());
    Ok(json!({"rays": rays, "functional": numbers(&c.functional), "chord": numbers(&c.chord)}))
}

/// The matrices of the images of the rays under the pieces of a state.
pub fn images(found: &CommonCone, e: usize) -> Value {
    found.maps.iter().filter(|m| m.state == e).map(|m| matrix(&m.matrix)).collect()
}

fn with_cone(
    shape: &Shape,
    found: &Certified,
    every: &Everywhere,
    cone: &CommonCone,
    witness: &[usize],
    position: &dyn Fn(&PointReport) -> Result<usize, Unsupported>,
) -> Result<Value, Unsupported> {
    let states = shape.reachable();
    let cones = states.iter().map(|&e| self::cone(shape, cone, e)).collect::<Result<Value, _>>()?;
    let maps = states.iter().map(|&e| images(cone, e));
    // Without control points the shape is looked at as it is.
    let seen = cone.view.as_deref().or_else(|| {
        let start = cone.cones.iter().find(|c| c.state == shape.start).map(|c| c.functional.as_slice());
        start.filter(|_| shape.control.is_none())
    });
    let mut joints = Vec::new();
    if every.verdict == Verdict::Proved {
        for joint in &every.joints {
            let report = joint.report(found);
            let Role::Joint { state, left, right, .. } = &report.role else {
                return unsupported("a point that is no joint", "every point");
            };
            let place = json!({"at": "joint", "path": [], "left": left, "right": right});
            joints.push(match joint {
                EveryJoint::Listed(_) => json!({"state": state, "listed": position(report)?}),
                EveryJoint::Own(_) => json!({"state": state, "point": point(shape, report, &place)?}),
            });
        }
    }
    let slow = cone.slow.iter().map(slow_cycle).collect::<Result<Vec<_>, _>>()?;
    Ok(json!({
        "question": "every point",
        "verdict": every.verdict.word(),
        "cones": cones,
        "maps": maps.collect::<Value>(),
        "view": seen.map(numbers),
        "window": cone.window,
        "slow": slow,
        "rate": cone.rate.as_ref().map(|r| json!({"length": r.length, "cross_ratio": number(&above(&r.cross_ratio))})),
        "joints": joints,
        "witness": witness,
    }))
}

/// A number slightly above, with room for rounded products.
fn above(x: &Rational) -> Rational {
    let more = x + x / Rational::from(Integer::from(1) << 40_u64);
    Interval::point(more).outward(64).hi
}

pub fn slow_cycle(s: &SlowCycle) -> Result<Value, Unsupported> {
    let top = top::<Rational>(&s.linear, &s.spectrum, s.lead, &format!("cycle {:?}", s.word))?;
    Ok(json!({"state": s.state, "word": s.word, "top": top, "functional": elements(&s.functional)}))
}
