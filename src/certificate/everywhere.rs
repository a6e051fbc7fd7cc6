//! The answer about every point of a curve: cones, joints, or the point that refutes.

use super::branch::point;
use super::top::{elements, top};
use super::{Unsupported, number, numbers};
use crate::arith::{Integer, Interval, Rational};
use crate::linalg::Matrix;
use crate::shape::Shape;
use crate::theorem::cone::CommonCone;
use crate::theorem::{Certified, EveryJoint, Everywhere, PointReport, Role, SlowCycle, Verdict};
use serde_json::{Value, json};

/// The answer to "every point", where there is something to prove; `position` says where a point stands in the certificate.
pub fn answer(shape: &Shape, found: &Certified, position: impl Fn(&PointReport) -> Option<usize>) -> Option<Value> {
    let every = found.everywhere.as_ref()?;
    let witness: Vec<usize> = every.witness.and_then(|k| position(&found.points[k])).into_iter().collect();
    // The format has no rule for derivatives of polynomial curves, nor for components.
    let left_out = every.witness.is_some() || every.hodograph.is_some() || every.components.is_some();
    if left_out && witness.is_empty() {
        return None;
    }
    if let Some(order) = every.derivative.as_deref().filter(|_| every.verdict == Verdict::Proved) {
        // What has no certificate is left out: it is no claim of the case.
        let radius = super::regularity::order(order).ok()?["radius"].take();
        return Some(match &order.shares {
            None => json!({"question": "every point by its derivative", "verdict": "proved", "radius": radius}),
            Some(shares) => {
                let shares: Value = shares.iter().map(|s| numbers(s)).collect();
                json!({"question": "every point by its derivative in shares", "verdict": "proved", "shares": shares,
                       "radius": radius})
            }
        });
    }
    match &every.cone {
        // What the format cannot express is left out: it is no claim of the case.
        Some(cone) => with_cone(shape, found, every, cone, &witness, &position).ok(),
        None if !witness.is_empty() => Some(json!({
            "question": "every point", "verdict": "refuted", "cones": [], "maps": [], "view": null, "window": 0,
            "slow": [], "rate": null, "joints": [], "witness": witness,
        })),
        None => None,
    }
}

pub fn matrix(m: &Matrix) -> Value {
    (0..m.rows()).map(|i| numbers(m.row(i))).collect()
}

fn with_cone(
    shape: &Shape,
    found: &Certified,
    every: &Everywhere,
    cone: &CommonCone,
    witness: &[usize],
    position: &dyn Fn(&PointReport) -> Option<usize>,
) -> Result<Value, Unsupported> {
    let states = shape.reachable();
    let own = |e: usize| cone.cones.iter().find(|c| c.state == e);
    let cones = states.iter().filter_map(|&e| own(e)).map(|c| {
        json!({"rays": matrix(&c.rays.transpose()), "functional": numbers(&c.functional), "chord": numbers(&c.chord)})
    });
    let maps = states.iter().map(|&e| {
        let images = cone.maps.iter().filter(|m| m.state == e);
        images.map(|m| matrix(&m.matrix)).collect::<Value>()
    });
    // Without control points the shape is looked at as it is.
    let seen = cone.view.as_deref().or_else(|| {
        let start = own(shape.start).map(|c| c.functional.as_slice());
        start.filter(|_| shape.control.is_none())
    });
    let mut joints = Vec::new();
    if every.verdict == Verdict::Proved {
        for joint in &every.joints {
            let report = joint.report(found);
            let Role::Joint { state, left, right, .. } = &report.role else { continue };
            let place = json!({"at": "joint", "path": [], "left": left, "right": right});
            joints.push(match joint {
                EveryJoint::Listed(_) => json!({"state": state, "listed": position(report)}),
                EveryJoint::Own(_) => json!({"state": state, "point": point(shape, report, &place)?}),
            });
        }
    }
    let slow = cone.slow.iter().map(slow_cycle).collect::<Result<Vec<_>, _>>()?;
    Ok(json!({
        "question": "every point",
        "verdict": every.verdict.word(),
        "cones": cones.collect::<Value>(),
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

fn slow_cycle(s: &SlowCycle) -> Result<Value, Unsupported> {
    let top = top(&s.linear, &s.spectrum, s.lead, &format!("cycle {:?}", s.word))?;
    Ok(json!({"state": s.state, "word": s.word, "top": top, "functional": elements(&s.functional)}))
}
