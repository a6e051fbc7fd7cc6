//! A dense set by finitely many checks: Theorems 5, 5′, and those on frames.

use super::branch::Context;
use super::claim::{Assertion, Claim, Reason};
use super::frames::{self, FrameKind, FrameReport, Frames};
use super::provable::Provable;
use super::verdict::{Certified, DenseSet, PointReport, Role};
use super::viewpoint::Viewpoint;
use super::{add_point, point};
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::linalg::{Matrix, closures};
use crate::shape::CellKind;
use crate::statement::Statement;

/// The hypotheses of Theorem 5 on injectivity, in the visible quotients.
pub fn dense_set<E: Provable>(cx: &Context<E>, joints: Vec<usize>) -> DenseSet<E> {
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

/// Adds the claims about the dense set; `count` is the number of first-level joints that there are.
pub fn claims<E: Provable>(cx: &Context<E>, mut dense: DenseSet<E>, count: usize, found: &mut Certified<E>) {
    let folded = dense.injective.iter().find(|(_, _, ok)| !ok).map(|&(state, letter, _)| (state, letter));
    let first = Verdict::all(count, dense.joints.iter().map(|&i| found.points[i].verdict));
    let with = |verdict| dense.joints.iter().copied().find(|&i| found.points[i].verdict == verdict);
    let reason = |verdict| with(verdict).map_or(Reason::Unexamined, Reason::FirstJoint);
    // A joint without a tangent refutes by itself; no theorem on all of them is used.
    let plain = |verdict, reason| {
        let by = (verdict == Verdict::Proved).then_some(Statement::Theorem5);
        Claim::as_found(Assertion::DenseJoints, verdict, by, reason)
    };
    if count == 0 {
        found.claims.push(Claim::open(Assertion::DenseJoints, Reason::NoJoint));
    } else if first == Verdict::Refuted || (folded.is_none() && dense.view_injective) {
        found.claims.push(plain(first, reason(first)));
    } else {
        let all = E::by_frames(cx, found);
        dense.frames = all.frames;
        match all.claim {
            Some(claim) => found.claims.push(claim),
            None => partly(cx, &mut dense, count, folded, found),
        }
    }
    found.dense = Some(dense);
}

/// The frames of a curve, and the claim about all joints that they decide.
#[derive(Default)]
pub struct DenseClaim {
    frames: Option<Frames>,
    claim: Option<Claim>,
}

/// Theorems 11 and 11″, where the frames are found.
pub fn by_frames(cx: &Context, found: &mut Certified) -> DenseClaim {
    let frames = frames::frames(cx);
    let claim = frames.as_ref().and_then(|frames| seen_joints(cx, frames, found));
    DenseClaim { frames, claim }
}

/// All joints, or one that has no tangent.
fn seen_joints(cx: &Context, frames: &Frames, found: &mut Certified) -> Option<Claim> {
    let refuted = frames.frames.iter().find_map(|f| Some((f, f.refuted()?)));
    if let Some((frame, joint)) = refuted {
        let Role::Joint { path, state, left, right } = &joint.role else { return None };
        let inner = frames::inner_path(cx.shape, frame.seen.state, *state)?;
        // A joint of the component itself is seen from its own state, one above a code from the state of the frame.
        let behind = if path.is_empty() { &inner } else { path };
        let spec = point::joint_spec(cx, &[frame.path.as_slice(), behind].concat(), *left, *right);
        let here = add_point(cx, spec, found)?;
        let none = found.points[here].verdict == Verdict::Refuted;
        return none.then(|| Claim::refuted(Assertion::DenseJoints, Some(Statement::Frames), Reason::Joint(here)));
    }
    if !frames.frames.iter().all(FrameReport::every_joint) {
        return None;
    }
    let folded = frames.frames.iter().any(|f| f.kind == FrameKind::Folded);
    let statement = if folded { Statement::FramesCones } else { Statement::Frames };
    let what = if frames.constant { Assertion::SeenJoints } else { Assertion::DenseJoints };
    Some(Claim::proved(what, Some(statement)))
}

/// What remains where not all joints are decided: those of the first levels, and a dense set.
fn partly<E: Provable>(
    cx: &Context<E>,
    dense: &mut DenseSet<E>,
    count: usize,
    folded: Option<(usize, usize)>,
    found: &mut Certified<E>,
) {
    let examined = examine_deeper(cx, dense, count, found);
    found.claims.push(examined);
    let by_frames = dense.frames.as_ref().is_some_and(|f| f.frames.iter().all(FrameReport::dense));
    let by_frames = by_frames.then(|| Claim::proved(Assertion::UnkilledJoints, Some(Statement::FramesDense)));
    let by_itself = match folded {
        None => projected(cx, dense),
        Some((state, letter)) => Claim::open(Assertion::DenseJoints, Reason::NotInjective { state, letter }),
    };
    found.claims.push(match by_frames {
        Some(claim) if by_itself.verdict() != Verdict::Proved => claim,
        _ => by_itself,
    });
}

/// Examines joints of deeper levels one by one, and claims a tangent at all joints examined.
fn examine_deeper<E: Provable>(cx: &Context<E>, dense: &DenseSet<E>, count: usize, found: &mut Certified<E>) -> Claim {
    let mut examined = dense.joints.clone();
    let deep = deep_joints(cx);
    let count = count + deep.len();
    for (path, left, right) in deep {
        examined.extend(add_point(cx, point::joint_spec(cx, &path, left, right), found));
    }
    let verdict = Verdict::all(count, examined.iter().map(|&i| found.points[i].verdict));
    let with = examined.iter().copied().find(|&i| found.points[i].verdict == verdict);
    let reason = with.map_or(Reason::Unexamined, Reason::Joint);
    let by = (verdict == Verdict::Proved).then_some(Statement::Joint);
    Claim::as_found(Assertion::ExaminedJoints, verdict, by, reason)
}

/// Theorem 5′, its operators being injective.
fn projected<E: Provable>(cx: &Context<E>, dense: &mut DenseSet<E>) -> Claim {
    let what = Assertion::ProjectedJoints;
    let Some(upstairs) = first_level_joints(cx) else { return Claim::open(what, Reason::Unexamined) };
    dense.upstairs = upstairs;
    if let Some(joint) = dense.upstairs.iter().position(|p| p.verdict != Verdict::Proved) {
        return Claim::open(what, Reason::BeforeProjection { joint });
    }
    if !tangents_span(cx, &dense.upstairs) {
        return Claim::open(what, Reason::NoSpan);
    }
    Claim::proved(what, Some(Statement::Theorem5Projected))
}

/// The first-level joints of all reachable edge states, each in the visible quotient of its own state; `None` where one of
/// them cannot be examined.
fn first_level_joints<E: Provable>(cx: &Context<E>) -> Option<Vec<PointReport<E>>> {
    let edges = cx.shape.reachable().into_iter().filter(|e| cx.shape.states[*e].kind == CellKind::Edge);
    let pairs = edges.flat_map(|e| point::joint_pairs(cx, e).into_iter().map(move |pair| (e, pair)));
    pairs.map(|(state, pair)| first_level_joint(cx, state, pair)).collect()
}

/// The joint of two pieces of a state in the visible quotient of that state.
pub fn first_level_joint<E: Provable>(
    cx: &Context<E>,
    state: usize,
    (left, right): (usize, usize),
) -> Option<PointReport<E>> {
    let own = Context { from: Viewpoint::quotient(cx.spaces, state), ..*cx };
    point::examine_point(&own, &point::joint_spec(&own, &[], left, right)?)
}

/// Whether the smallest invariant family that contains the (rational) tangent lines is all of `W`.
fn tangents_span<E: Provable>(cx: &Context<E>, upstairs: &[PointReport<E>]) -> bool {
    let reachable = cx.shape.reachable();
    let dimension = |e: usize| cx.spaces.of(e).visible.rows();
    let mut spans: Vec<Matrix<E>> = cx.shape.states.iter().map(|_| Matrix::zero(0, 0)).collect();
    for &e in &reachable {
        let at_home = |p: &&PointReport<E>| matches!(p.role, Role::Joint { state, .. } if state == e);
        let lifted = |v: Vec<Rational>| v.iter().map(E::of).collect::<Vec<E>>();
        let lines = upstairs.iter().filter(at_home).filter_map(|p| p.tangent.as_ref()?.rational().map(lifted));
        spans[e] = Matrix::from_rows(dimension(e), lines.collect()).echelon().rows;
    }
    let mut arrows = Vec::new();
    for &e in &reachable {
        for piece in &cx.shape.states[e].pieces {
            let onto = &cx.spaces.of(e).visible * &cx.spaces.linear(&piece.op, e, piece.target);
            // `onto` factors through the quotient: solve A visible(target) = visible(e) T.
            let Some(on_quotient) = cx.spaces.of(piece.target).visible.transpose().solve(&onto.transpose()) else {
                return false;
            };
            arrows.push((piece.target, e, on_quotient));
        }
    }
    let spans = closures(spans, &arrows);
    reachable.iter().all(|&e| spans[e].rows() == dimension(e))
}

/// Joints of the levels after the first, in breadth-first order.
fn deep_joints<E: Provable>(cx: &Context<E>) -> Vec<(Vec<usize>, usize, usize)> {
    let mut joints = Vec::new();
    let mut level: Vec<(Vec<usize>, usize)> = vec![(Vec::new(), cx.shape.start)];
    for _ in 1..cx.budget.levels {
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
        if joints.len() >= cx.budget.joints {
            break;
        }
    }
    joints.truncate(cx.budget.joints);
    joints
}
