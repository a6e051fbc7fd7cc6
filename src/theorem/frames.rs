//! Theorems 11, 11′ and 11″: joints of shapes that start somewhere, by the frames through which every state is seen.

use super::branch::Context;
use super::cone::{CommonCone, cone_in_sight};
use super::point;
use super::verdict::{PointReport, Role, Verdict};
use super::viewpoint::Viewpoint;
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use crate::shape::{CellKind, Shape, Spaces};

/// Most frames that are followed.
const MAX_FRAMES: usize = 64;
/// Longest words of a code below which all cones are seen, and most of them.
pub(super) const MAX_CODE_LENGTH: usize = 6;
pub(super) const MAX_CODE: usize = 128;

/// A state with the map through which it is seen there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SeenState {
    /// The state.
    pub state: usize,
    /// Rows on `V` in reduced echelon form, none of them 0, whose kernel is what is not seen.
    pub rows: Matrix,
}

/// What a frame is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameKind {
    /// Its state lies on no cycle.
    Transient,
    /// A component on whose quotients all operators are injective, and which is seen through its own quotient.
    Good,
    /// A component for which that fails.
    Folded,
}

/// A frame: a state, the map through which it is seen, and the joints that decide about all joints below it.
#[derive(Debug, Clone)]
pub struct FrameReport {
    /// The state and the map.
    pub seen: SeenState,
    /// A path from the start that leads there.
    pub path: Vec<usize>,
    /// What it is.
    pub kind: FrameKind,
    /// The states whose joints are examined, each in its quotient: of a transient frame its own state, of a good one those of the
    /// component, of another one all states that can be reached.
    pub family: Vec<SeenState>,
    /// The first-level joints of these states in these quotients.
    pub joints: Vec<PointReport>,
    /// Of a folded frame: whether the tangent lines of the joints are seen to span the quotients.
    pub spans: bool,
    /// Of a folded frame: cones that hold all secants and are seen below a code.
    pub cones: Option<FrameCones>,
}

/// The certificate of Theorem 11″.
#[derive(Debug, Clone)]
pub struct FrameCones {
    /// Cones of the states that can be reached; the hypotheses of Theorem 6 but for positive products.
    pub cone: CommonCone,
    /// A complete prefix code from the state of the frame, with a functional on its rows that is positive on the cone.
    pub code: Vec<(Vec<usize>, Vec<Rational>)>,
    /// The joints above the code, seen through the frame.
    pub above: Vec<PointReport>,
}

/// All frames, in the order in which they are found.
#[derive(Debug, Clone)]
pub struct Frames {
    /// The frames.
    pub frames: Vec<FrameReport>,
    /// Whether some cell, though more than a point, is a single point where it is looked at.
    pub constant: bool,
}

impl FrameReport {
    /// Whether every joint below this frame has a tangent line.
    #[must_use]
    pub fn every_joint(&self) -> bool {
        proved(&self.joints)
            && match (self.kind, &self.cones) {
                (FrameKind::Folded, Some(cones)) => proved(&cones.above),
                (FrameKind::Folded, None) => false,
                _ => true,
            }
    }

    /// Whether in every cell below this frame that is more than a point there are joints with a tangent line.
    #[must_use]
    pub fn dense(&self) -> bool {
        self.every_joint() || self.kind == FrameKind::Folded && proved(&self.joints) && self.spans
    }

    /// A joint without a tangent line that has none either where the curve is looked at.
    #[must_use]
    pub fn refuted(&self) -> Option<&PointReport> {
        let above = self.cones.iter().flat_map(|c| &c.above);
        let own = self.joints.iter().filter(|_| self.kind != FrameKind::Folded);
        own.chain(above).find(|p| p.verdict == Verdict::Refuted)
    }
}

fn proved(points: &[PointReport]) -> bool {
    points.iter().all(|p| p.verdict == Verdict::Proved)
}

/// The states from which `from` can be reached and that can be reached from it by at least one piece each: its component; empty
/// for a state on no cycle.
#[must_use]
pub fn component<E: Entry>(shape: &Shape<E>, from: usize) -> Vec<usize> {
    let ahead = below(shape, from);
    let closed: Vec<usize> = ahead.iter().copied().filter(|&e| below(shape, e).contains(&from)).collect();
    shape.reachable().into_iter().filter(|e| closed.contains(e)).collect()
}

/// What can be reached in at least one step.
fn below<E: Entry>(shape: &Shape<E>, from: usize) -> Vec<usize> {
    let targets = |e: usize| shape.states[e].pieces.iter().map(|p| p.target);
    let mut found: Vec<usize> = Vec::new();
    let mut open: Vec<usize> = targets(from).collect();
    while let Some(e) = open.pop() {
        if !found.contains(&e) {
            found.push(e);
            open.extend(targets(e));
        }
    }
    found
}

/// Through which rows the states are seen, by paths inside `states`: the smallest family with `rows` at its state and
/// `S_e T_i ⊂ S_δ`.
#[must_use]
pub fn family(shape: &Shape, spaces: &Spaces, seen: &SeenState, states: &[usize]) -> Vec<SeenState> {
    let mut found: Vec<SeenState> =
        states.iter().map(|&state| SeenState { state, rows: Matrix::zero(0, spaces.of(state).basis.cols()) }).collect();
    if let Some(own) = found.iter_mut().find(|s| s.state == seen.state) {
        own.rows = seen.rows.clone();
    }
    loop {
        let mut grown = false;
        for k in 0..found.len() {
            let (e, rows) = (found[k].state, found[k].rows.clone());
            for piece in &shape.states[e].pieces {
                let Some(target) = found.iter_mut().find(|s| s.state == piece.target) else { continue };
                let joined = target.rows.stack(&(&rows * &spaces.linear(&piece.op, e, piece.target))).echelon().rows;
                if joined.rows() > target.rows.rows() {
                    target.rows = joined;
                    grown = true;
                }
            }
        }
        if !grown {
            return found;
        }
    }
}

/// The neighbours among the pieces of a state that are more than a point in its quotient.
#[must_use]
pub fn neighbours(shape: &Shape, spaces: &Spaces, seen: &SeenState) -> Vec<(usize, usize)> {
    let pieces = &shape.states[seen.state].pieces;
    let kept: Vec<usize> = (0..pieces.len()).filter(|&i| onward(shape, spaces, seen, i).rows.rows() > 0).collect();
    kept.windows(2).map(|w| (w[0], w[1])).collect()
}

/// The frame behind a piece.
fn onward(shape: &Shape, spaces: &Spaces, seen: &SeenState, letter: usize) -> SeenState {
    let piece = &shape.states[seen.state].pieces[letter];
    let rows = (&seen.rows * &spaces.linear(&piece.op, seen.state, piece.target)).echelon().rows;
    SeenState { state: piece.target, rows }
}

/// Follows all frames from the start; `None` for shapes that are no curves, or with too many frames, or where a joint cannot
/// be examined.
///
/// # Cost
/// The ring conditions of the first-level joints of every frame; some linear programs where a frame is folded.
#[must_use]
pub fn frames(cx: &Context) -> Option<Frames> {
    let (shape, spaces) = (cx.shape, cx.spaces);
    if shape.reachable().iter().any(|&e| shape.states[e].kind != CellKind::Edge) {
        return None;
    }
    let start = shape.start;
    let first = SeenState { state: start, rows: (cx.from.map() * &spaces.of(start).basis).echelon().rows };
    if first.rows.rows() == 0 {
        return None;
    }
    let mut open = vec![(first, Vec::new())];
    let mut found = Frames { frames: Vec::new(), constant: false };
    let mut next = 0;
    while next < open.len() {
        let (seen, path) = open[next].clone();
        next += 1;
        let (report, exits) = follow(cx, seen, path)?;
        found.frames.push(report);
        for (seen, path) in exits {
            if seen.rows.rows() == 0 {
                found.constant |= spaces.of(seen.state).basis.cols() > 0;
            } else if open.iter().all(|(known, _)| *known != seen) {
                open.push((seen, path));
            }
        }
        if open.len() > MAX_FRAMES {
            return None;
        }
    }
    // No joint at all proves nothing.
    found.frames.iter().any(|f| !f.joints.is_empty()).then_some(found)
}

/// A frame with its joints, and the frames behind it with paths to them.
fn follow(cx: &Context, seen: SeenState, path: Vec<usize>) -> Option<(FrameReport, Vec<(SeenState, Vec<usize>)>)> {
    let (shape, spaces) = (cx.shape, cx.spaces);
    let own = component(shape, seen.state);
    let mut report = FrameReport {
        path,
        kind: FrameKind::Transient,
        family: vec![seen.clone()],
        joints: Vec::new(),
        spans: false,
        cones: None,
        seen,
    };
    if !own.is_empty() {
        report.family = family(shape, spaces, &report.seen, &own);
        report.kind =
            if is_good(shape, spaces, &report.seen, &report.family) { FrameKind::Good } else { FrameKind::Folded };
    }
    if report.kind == FrameKind::Folded {
        let ahead = below(shape, report.seen.state);
        let all: Vec<usize> = shape.reachable().into_iter().filter(|e| ahead.contains(e)).collect();
        report.family = family(shape, spaces, &report.seen, &all);
    }
    for seen in &report.family {
        report.joints.extend(joints(cx, seen, &[], seen.state)?);
    }
    let mut exits = Vec::new();
    if report.kind == FrameKind::Folded {
        report.spans = spans(cx, &report.family, &report.joints);
        if proved(&report.joints) {
            report.cones = cones(cx, &report.seen)?;
        }
    } else {
        for seen in &report.family {
            let inner = inner_path(shape, report.seen.state, seen.state)?;
            for (letter, piece) in shape.states[seen.state].pieces.iter().enumerate() {
                if !own.contains(&piece.target) {
                    let path = [report.path.as_slice(), &inner, &[letter]].concat();
                    exits.push((onward(shape, spaces, seen, letter), path));
                }
            }
        }
    }
    Some((report, exits))
}

/// Whether a component is seen through its own quotient, on which all its operators are injective.
fn is_good(shape: &Shape, spaces: &Spaces, seen: &SeenState, family: &[SeenState]) -> bool {
    let of = |state: usize| family.iter().find(|s| s.state == state);
    of(seen.state).is_some_and(|own| own.rows.rows() == seen.rows.rows())
        && family.iter().all(|s| {
            shape.states[s.state].pieces.iter().enumerate().all(|(letter, piece)| {
                of(piece.target).is_none_or(|to| onward(shape, spaces, s, letter).rows.rows() == to.rows.rows())
            })
        })
}

/// The shortest path between two states, letters ascending.
#[must_use]
pub fn inner_path(shape: &Shape, from: usize, to: usize) -> Option<Vec<usize>> {
    let mut paths = vec![(Vec::new(), from)];
    let mut next = 0;
    while next < paths.len() {
        let (path, state): (Vec<usize>, usize) = paths[next].clone();
        if state == to {
            return Some(path);
        }
        for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
            if paths.iter().all(|(_, e)| *e != piece.target) {
                paths.push(([path.as_slice(), &[letter]].concat(), piece.target));
            }
        }
        next += 1;
    }
    None
}

/// The joints of the pieces of the state that `path` leads to from the state of `seen`.
fn joints(cx: &Context, seen: &SeenState, path: &[usize], state: usize) -> Option<Vec<PointReport>> {
    let (shape, spaces) = (cx.shape, cx.spaces);
    let own = Context { from: Viewpoint::rows(spaces, seen.state, &seen.rows), ..*cx };
    let (product, end) = shape.product(seen.state, path);
    let here = SeenState { state, rows: (&seen.rows * &spaces.linear(&product, seen.state, end)).echelon().rows };
    neighbours(shape, spaces, &here)
        .into_iter()
        .map(|(left, right)| point::examine_point(&own, &point::joint_spec(&own, path, left, right)?))
        .collect()
}

/// Whether the smallest invariant family that contains the (rational) tangent lines is all of the quotients.
fn spans(cx: &Context, family: &[SeenState], joints: &[PointReport]) -> bool {
    let of = |state: usize| family.iter().find(|s| s.state == state);
    let mut spans: Vec<Matrix> = Vec::new();
    for seen in family {
        let at_home = |p: &&PointReport| matches!(p.role, Role::Joint { state, .. } if state == seen.state);
        let lines: Vec<Vec<Rational>> =
            joints.iter().filter(at_home).flat_map(|p| p.tangent.as_ref()?.rational()).collect();
        spans.push(Matrix::from_rows(seen.rows.rows(), lines).echelon().rows);
    }
    loop {
        let mut grown = false;
        for (k, seen) in family.iter().enumerate() {
            for piece in &cx.shape.states[seen.state].pieces {
                let Some(j) = family.iter().position(|s| s.state == piece.target) else { return false };
                let Some(to) = of(piece.target) else { return false };
                let onto = &seen.rows * &cx.spaces.linear(&piece.op, seen.state, piece.target);
                // `onto` factors through the quotient: A rows(target) = rows(e) T.
                let Some(on_quotient) = to.rows.transpose().solve(&onto.transpose()) else { return false };
                let joined = spans[k].stack(&(&spans[j] * &on_quotient)).echelon().rows;
                if joined.rows() > spans[k].rows() {
                    spans[k] = joined;
                    grown = true;
                }
            }
        }
        if !grown {
            return family.iter().zip(&spans).all(|(s, span)| span.rows() == s.rows.rows());
        }
    }
}

/// Cones for Theorem 11″; `Some(None)` where there are none, `None` where a joint above the code cannot be examined.
fn cones(cx: &Context, seen: &SeenState) -> Option<Option<FrameCones>> {
    let view = &seen.rows * &cx.spaces.of(seen.state).coordinates;
    let Some((cone, code)) =
        cone_in_sight(cx.shape, cx.spaces, seen.state, &view, (MAX_CODE_LENGTH, MAX_CODE, cx.budget.cone_steps))
    else {
        return Some(None);
    };
    let mut above = Vec::new();
    let mut done: Vec<&[usize]> = Vec::new();
    for (word, _) in &code {
        for length in 0..word.len() {
            let path = &word[..length];
            if !done.contains(&path) {
                done.push(path);
                let (_, state) = cx.shape.product(seen.state, path);
                above.extend(joints(cx, seen, path, state)?);
            }
        }
    }
    Some(Some(FrameCones { cone, code, above }))
}
