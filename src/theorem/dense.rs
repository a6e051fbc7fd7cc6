//! Theorem 5 and Theorem 5′: a dense set by finitely many checks.

use super::branch::Context;
use super::verdict::{Certified, Claim, DenseSet, PointReport, Role, Statement, Verdict};
use super::{add_point, point};
use crate::linalg::Matrix;
use crate::shape::CellKind;

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
    DenseSet { injective, view_injective, joints, upstairs: Vec::new() }
}

/// Adds the claim about the dense set.
pub fn claim(cx: &Context, mut dense: DenseSet, found: &mut Certified) {
    let claim = decide(cx, &mut dense, found);
    found.claims.push(claim);
    found.dense = Some(dense);
}

const ALL: &str = "the curve has a tangent line at every joint of every level, a dense set";
const PROJECTED: &str = "the projected curve has a tangent line at the joints listed and at every joint whose tangent line upstairs the \
                         projection does not kill, a dense set";

fn decide(cx: &Context, dense: &mut DenseSet, found: &mut Certified) -> Claim {
    let claim = |statement, text: &str, verdict, reason: Option<&str>| Claim {
        text: text.to_owned(),
        verdict,
        statement: Some(statement),
        reason: reason.map(str::to_owned),
        asked: None,
    };
    let plain = |verdict, reason| claim(Statement::Theorem5, ALL, verdict, reason);
    let Some(verdict) = dense.joints.iter().map(|&i| found.points[i].verdict).reduce(Verdict::and) else {
        return plain(Verdict::Undetermined, Some("no joint between pieces that are more than a point"));
    };
    if verdict == Verdict::Refuted {
        return plain(Verdict::Refuted, Some("a first-level joint has no tangent"));
    }
    let injective = dense.injective.iter().all(|(_, _, ok)| *ok);
    if injective && dense.view_injective {
        let open = (verdict != Verdict::Proved).then_some("a first-level joint is not decided");
        return plain(verdict, open);
    }
    for (path, left, right) in deep_joints(cx) {
        let Some(index) = add_point(cx, point::joint_spec(cx, &path, left, right), found) else { continue };
        if found.points[index].verdict == Verdict::Refuted {
            return plain(Verdict::Refuted, Some("a joint of a deeper level has no tangent"));
        }
    }
    if !injective {
        let reason = "an operator is not injective on the relevant space: only the joints listed were examined";
        return plain(Verdict::Undetermined, Some(reason));
    }
    let projected = |verdict, reason| claim(Statement::Theorem5Projected, PROJECTED, verdict, reason);
    dense.upstairs = upstairs(cx);
    if dense.upstairs.iter().any(|p| p.verdict != Verdict::Proved) {
        let reason = "the projection is not injective, and before it a first-level joint is not proved";
        return projected(Verdict::Undetermined, Some(reason));
    }
    if !tangents_span(cx, &dense.upstairs) {
        let reason = "the projection is not injective, and the tangent lines at the joints were not seen to span the relevant space";
        return projected(Verdict::Undetermined, Some(reason));
    }
    projected(verdict, (verdict != Verdict::Proved).then_some("a first-level joint is not decided"))
}

/// The first-level joints of all reachable edge states, each in the visible quotient of its own state.
fn upstairs(cx: &Context) -> Vec<PointReport> {
    let mut reports = Vec::new();
    for state in cx.shape.reachable() {
        if cx.shape.states[state].kind != CellKind::Edge {
            continue;
        }
        let space = cx.spaces.of(state);
        let own = Context { root: state, view: &space.visible * &space.coordinates, ..*cx };
        for (left, right) in point::joint_pairs(&own, state) {
            let spec = point::joint_spec(&own, &[], left, right);
            reports.extend(spec.and_then(|spec| point::examine_point(&own, &spec)));
        }
    }
    for report in &mut reports {
        report.image = None;
    }
    reports
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
