//! A dense set by finitely many checks: Theorems 5, 5′, and those on frames.

use super::branch::Context;
use super::frames::{self, FrameKind, FrameReport, Frames};
use super::verdict::{Certified, Claim, DenseSet, PointReport, Role, Verdict};
use super::viewpoint::Viewpoint;
use super::{add_point, point};
use crate::linalg::Matrix;
use crate::shape::CellKind;
use crate::statement::Statement;

/// How many levels of joints are examined where Theorem 5 does not apply.
const DEEP_LEVELS: usize = 4;
/// How many joints at most.
const DEEP_JOINTS: usize = 40;

/// The hypotheses of Theorem 5 on injectivity, in the visible quotients.
pub fn dense_set(cx: &Context, joints: Vec<usize>) -> DenseSet {
    let mut injective = Vec::new();
    for e in cx.shape.reachable() {
        if cx.shape.states[e].kind != CellKind::Edge {
            continue;
        }
        for (letter, piece) in cx.shape.states[e].pieces.iter().enumerate() {
            let linear = cx.spaces.linear(&piece.op, e, piece.target);
            let onto = &cx.spaces.of(e).visible * &linear;
            injective.push((e, letter, onto.rank() == cx.spaces.of(piece.target).visible.rows()));
        }
    }
    let start = cx.spaces.of(cx.shape.start);
    let view_injective = (&cx.shape.view() * &start.basis).rank() == start.visible.rows();
    DenseSet { injective, view_injective, joints, upstairs: Vec::new(), frames: None }
}

/// Adds the claims about the dense set.
pub fn claims(cx: &Context, mut dense: DenseSet, found: &mut Certified) {
    let injective = dense.injective.iter().all(|(_, _, ok)| *ok);
    let first = dense.joints.iter().map(|&i| found.points[i].verdict).reduce(Verdict::and);
    let plain = |verdict, reason: Option<&str>| claim(Statement::Theorem5, ALL, verdict, reason);
    match first {
        None => {
            let reason = "no joint between pieces that are more than a point";
            found.claims.push(plain(Verdict::Undetermined, Some(reason)));
        }
        Some(Verdict::Refuted) => {
            found.claims.push(plain(Verdict::Refuted, Some("a first-level joint has no tangent")));
        }
        Some(verdict) if injective && dense.view_injective => {
            let open = (verdict != Verdict::Proved).then_some("a first-level joint is not decided");
            found.claims.push(plain(verdict, open));
        }
        Some(_) => {
            dense.frames = frames::frames(cx);
            let every = dense.frames.as_ref().and_then(|frames| by_frames(cx, frames, found));
            match every {
                Some(claim) => found.claims.push(claim),
                None => partly(cx, &mut dense, injective, found),
            }
        }
    }
    found.dense = Some(dense);
}

/// Theorems 11 and 11″: all joints, or one that has no tangent.
fn by_frames(cx: &Context, frames: &Frames, found: &mut Certified) -> Option<Claim> {
    let refuted = frames.frames.iter().find_map(|f| Some((f, f.refuted()?)));
    if let Some((frame, joint)) = refuted {
        let Role::Joint { path, state, left, right } = &joint.role else { return None };
        let inner = frames::inner_path(cx.shape, frame.seen.state, *state)?;
        // A joint of the component itself is seen from its own state, one above a code from the state of the frame.
        let behind = if path.is_empty() { &inner } else { path };
        let spec = point::joint_spec(cx, &[frame.path.as_slice(), behind].concat(), *left, *right);
        let here = add_point(cx, spec, found)?;
        let none = found.points[here].verdict == Verdict::Refuted;
        return none.then(|| claim(Statement::Frames, ALL, Verdict::Refuted, Some("a joint has no tangent")));
    }
    if !frames.frames.iter().all(FrameReport::every_joint) {
        return None;
    }
    let folded = frames.frames.iter().any(|f| f.kind == FrameKind::Folded);
    let statement = if folded { Statement::FramesCones } else { Statement::Frames };
    Some(claim(statement, if frames.constant { ALL_SEEN } else { ALL }, Verdict::Proved, None))
}

/// What remains where not all joints are decided: those of the first levels, and a dense set.
fn partly(cx: &Context, dense: &mut DenseSet, injective: bool, found: &mut Certified) {
    let examined = examine_deeper(cx, dense, found);
    found.claims.push(examined);
    let by_frames = dense.frames.as_ref().is_some_and(|f| f.frames.iter().all(FrameReport::dense));
    let last = if injective {
        let claim = projected(cx, dense);
        if claim.verdict == Verdict::Proved || !by_frames { claim } else { dense_claim() }
    } else if by_frames {
        dense_claim()
    } else {
        let reason = "an operator is not injective on the relevant space: only the joints listed were examined";
        claim(Statement::Theorem5, ALL, Verdict::Undetermined, Some(reason))
    };
    found.claims.push(last);
}

fn dense_claim() -> Claim {
    claim(Statement::FramesDense, KILLED, Verdict::Proved, None)
}

const ALL: &str = "the curve has a tangent line at every joint of every level, a dense set";
const ALL_SEEN: &str = "the curve has a tangent line at every joint of every level between pieces that are more than a point where \
                        it is looked at; these are dense in every cell that is more than a point";
const KILLED: &str = "the curve has a tangent line at every joint whose tangent line is not killed on the way to where it is looked \
                      at; in every cell that is more than a point there are such joints";
const EXAMINED: &str = "the curve has a tangent line at each of the joints examined below";
const PROJECTED: &str = "the projected curve has a tangent line at every joint whose tangent line before the projection is not \
                         killed by it; in every cell that is more than a point there are such joints";

fn claim(statement: Statement, text: &str, verdict: Verdict, reason: Option<&str>) -> Claim {
    Claim { text: text.to_owned(), verdict, statement: Some(statement), reason: reason.map(str::to_owned), asked: None }
}

/// Examines joints of deeper levels one by one, and claims a tangent at all joints examined.
fn examine_deeper(cx: &Context, dense: &DenseSet, found: &mut Certified) -> Claim {
    let mut examined = dense.joints.clone();
    for (path, left, right) in deep_joints(cx) {
        examined.extend(add_point(cx, point::joint_spec(cx, &path, left, right), found));
    }
    let verdict = examined.iter().map(|&i| found.points[i].verdict).reduce(Verdict::and);
    let verdict = verdict.unwrap_or(Verdict::Undetermined);
    let reason = match verdict {
        Verdict::Proved => None,
        Verdict::Refuted => Some("a joint of a deeper level has no tangent"),
        Verdict::Undetermined => Some("a joint is not decided"),
    };
    claim(Statement::Joint, EXAMINED, verdict, reason)
}

/// Theorem 5′, its operators being injective.
fn projected(cx: &Context, dense: &mut DenseSet) -> Claim {
    let claim = |verdict, reason| claim(Statement::Theorem5Projected, PROJECTED, verdict, reason);
    match first_level_joints(cx) {
        Some(joints) => dense.upstairs = joints,
        None => {
            return claim(Verdict::Undetermined, Some("a first-level joint cannot be examined before the projection"));
        }
    }
    if dense.upstairs.iter().any(|p| p.verdict != Verdict::Proved) {
        let reason = "the projection is not injective, and before it a first-level joint is not proved";
        return claim(Verdict::Undetermined, Some(reason));
    }
    if !tangents_span(cx, &dense.upstairs) {
        let reason = "the projection is not injective, and the tangent lines at the joints were not seen to span the relevant space";
        return claim(Verdict::Undetermined, Some(reason));
    }
    claim(Verdict::Proved, None)
}

/// The first-level joints of all reachable edge states, each in the visible quotient of its own state; `None` where one cannot be
/// examined.
fn first_level_joints(cx: &Context) -> Option<Vec<PointReport>> {
    let edges = cx.shape.reachable().into_iter().filter(|e| cx.shape.states[*e].kind == CellKind::Edge);
    let pairs = edges.flat_map(|e| point::joint_pairs(cx, e).into_iter().map(move |pair| (e, pair)));
    pairs.map(|(state, pair)| first_level_joint(cx, state, pair)).collect()
}

/// The joint of two pieces of a state in the visible quotient of that state.
pub fn first_level_joint(cx: &Context, state: usize, (left, right): (usize, usize)) -> Option<PointReport> {
    let own = Context { from: Viewpoint::quotient(cx.spaces, state), ..*cx };
    point::examine_point(&own, &point::joint_spec(&own, &[], left, right)?)
}

/// Whether the smallest invariant family that contains the (rational) tangent lines is all of `W`.
fn tangents_span(cx: &Context, upstairs: &[PointReport]) -> bool {
    let reachable = cx.shape.reachable();
    let dimension = |e: usize| cx.spaces.of(e).visible.rows();
    let mut spans: Vec<Matrix> = cx.shape.states.iter().map(|_| Matrix::zero(0, 0)).collect();
    for &e in &reachable {
        let at_home = |p: &&PointReport| matches!(p.role, Role::Joint { state, .. } if state == e);
        let lines = upstairs.iter().filter(at_home).filter_map(|p| p.tangent.as_ref()?.rational());
        spans[e] = Matrix::from_rows(dimension(e), lines.collect()).echelon().rows;
    }
    loop {
        let mut grown = false;
        for &e in &reachable {
            for piece in &cx.shape.states[e].pieces {
                let onto = &cx.spaces.of(e).visible * &cx.spaces.linear(&piece.op, e, piece.target);
                // `onto` factors through the quotient: solve A visible(target) = visible(e) T.
                let Some(on_quotient) = cx.spaces.of(piece.target).visible.transpose().solve(&onto.transpose()) else {
                    return false;
                };
                let joined = spans[e].stack(&(&spans[piece.target] * &on_quotient)).echelon().rows;
                if joined.rows() > spans[e].rows() {
                    spans[e] = joined;
                    grown = true;
                }
            }
        }
        if !grown {
            return reachable.iter().all(|&e| spans[e].rows() == dimension(e));
        }
    }
}

/// Joints of the levels after the first, in breadth-first order.
fn deep_joints(cx: &Context) -> Vec<(Vec<usize>, usize, usize)> {
    let mut joints = Vec::new();
    let mut level: Vec<(Vec<usize>, usize)> = vec![(Vec::new(), cx.shape.start)];
    for _ in 1..DEEP_LEVELS {
        let mut next = Vec::new();
        for (path, state) in level {
            for (letter, piece) in cx.shape.states[state].pieces.iter().enumerate() {
                let longer = [path.as_slice(), &[letter]].concat();
                if cx.shape.states[piece.target].kind == CellKind::Edge {
                    let pairs = point::joint_pairs(cx, piece.target);
                    joints.extend(pairs.into_iter().map(|(l, r)| (longer.clone(), l, r)));
                }
                next.push((longer, piece.target));
            }
        }
        level = next;
        if joints.len() >= DEEP_JOINTS {
            break;
        }
    }
    joints.truncate(DEEP_JOINTS);
    joints
}
