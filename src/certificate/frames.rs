//! The evidence for Theorems 11, 11′ and 11″: one entry for each frame, in the order in which they are found.

use super::branch::point;
use super::{Unsupported, numbers, unsupported};
use crate::shape::Shape;
use crate::theorem::{FrameCones, FrameReport, Frames, PointReport, Role};
use serde_json::{Value, json};

/// All frames.
pub fn frames(shape: &Shape, frames: &Frames) -> Result<Value, Unsupported> {
    frames.frames.iter().map(|frame| entry(shape, frame)).collect()
}

fn entry(shape: &Shape, frame: &FrameReport) -> Result<Value, Unsupported> {
    let joints = frame.joints.iter().map(|p| joint(shape, p)).collect::<Result<Value, _>>()?;
    let cones = frame.cones.as_ref().map_or(Ok(Value::Null), |c| cones(shape, frame, c))?;
    Ok(json!({"state": frame.seen.state, "joints": joints, "cones": cones}))
}

/// A joint in the quotient of its own state.
fn joint(shape: &Shape, report: &PointReport) -> Result<Value, Unsupported> {
    let Role::Joint { state, .. } = &report.role else { return unsupported("a point that is no joint", "frames") };
    Ok(json!({"state": state, "point": seen(shape, report)?}))
}

fn seen(shape: &Shape, report: &PointReport) -> Result<Value, Unsupported> {
    let Role::Joint { path, left, right, .. } = &report.role else {
        return unsupported("a point that is no joint", "frames");
    };
    point(shape, report, &json!({"at": "joint", "path": path, "left": left, "right": right}))
}

fn cones(shape: &Shape, frame: &FrameReport, found: &FrameCones) -> Result<Value, Unsupported> {
    let (mut cones, mut maps) = (Vec::new(), Vec::new());
    for member in &frame.family {
        cones.push(super::everywhere::cone(shape, &found.cone, member.state)?);
        maps.push(super::everywhere::images(&found.cone, member.state));
    }
    let code = found.code.iter().map(|(word, h)| json!({"word": word, "functional": numbers(h)})).collect::<Value>();
    let above = found.above.iter().map(|p| Ok(json!({"point": seen(shape, p)?}))).collect::<Result<Value, _>>()?;
    Ok(json!({"cones": cones, "maps": maps, "code": code, "above": above}))
}
