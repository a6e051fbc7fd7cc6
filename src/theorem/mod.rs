//! The theorem checker: from a shape to verdicts with evidence. Statements and proofs are in `docs/theory.md`.

mod branch;
mod direction;
mod point;
mod ring;
mod verdict;

pub use branch::Context;
pub use direction::{Direction, primitive};
pub use ring::{Discharged, Functional, Part, Position, RingAnswer, RingPiece, RingProof, Witness};
pub use verdict::{
    BranchReport, Certified, Claim, DenseSet, Dimension, Holder, Kind, Outcome, PointReport, Rate, Rays, Role, Side,
    StateReport, Statement, Verdict,
};

use crate::algebraic::Root;
use crate::arith::Rational;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::shape::{
    Address, AddressError, Balls, CellKind, Contraction, CurveError, End, Shape, ShapeError, Spaces, contraction,
};
use thiserror::Error;

/// Why a shape cannot be certified at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ModelError {
    /// Sizes or sums are wrong.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The pieces of a curve do not meet, or an identity fails.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// An address does not exist.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// The system does not contract.
    #[error(
        "the system does not contract: on state `{state}` the cycle {word:?} has a linear part of spectral radius at least 1 \
         (an attractor inside a smaller invariant space may still exist)"
    )]
    Expands {
        /// Name of the state.
        state: String,
        /// Its index.
        index: usize,
        /// The cycle.
        word: Vec<usize>,
    },
    /// A fixed point is not unique, so that the system cannot contract.
    #[error("an operator has no unique fixed point of coordinate sum 1")]
    FixedPoint,
}

/// How many levels of joints are examined where Theorem 5 does not apply.
const DEEP_LEVELS: usize = 4;
/// How many joints at most.
const DEEP_JOINTS: usize = 40;

/// Certifies a shape: end points, first-level joints of all reachable states, further addresses, and the dense set.
///
/// # Errors
/// [`ModelError`] where the shape is not a model, does not contract, or an address does not exist.
///
/// # Cost
/// Dominated by contraction (at most [`crate::shape::MAX_WORDS`] products) and the ring conditions of the branches.
pub fn certify(shape: &Shape, addresses: &[Address]) -> Result<Certified, ModelError> {
    shape.check()?;
    let contraction = contraction(shape, expands);
    let proof = match &contraction {
        Contraction::Proved(proof) => proof.clone(),
        Contraction::Refuted { state, word } => {
            let name = shape.states[*state].name.clone();
            return Err(ModelError::Expands { state: name, index: *state, word: word.clone() });
        }
        Contraction::Undetermined { length, open } => return Ok(without_contraction(&contraction, *length, *open)),
    };
    shape.check_curves()?;
    let spaces = Spaces::new(shape).ok_or(ModelError::FixedPoint)?;
    let balls = Balls::new(shape, &spaces, &proof);
    let cx = Context { shape, spaces: &spaces, balls: &balls };
    let mut found = Certified {
        claims: Vec::new(),
        verdict: Verdict::Undetermined,
        contraction,
        states: shape.reachable().into_iter().map(|e| state_report(&cx, e)).collect(),
        points: Vec::new(),
        dense: None,
    };
    let mut asked = Vec::new();
    for address in addresses {
        asked.push(address.normalise(shape, shape.start)?);
    }
    if shape.states[shape.start].kind == CellKind::Edge {
        certify_curve(&cx, &asked, &mut found);
    } else {
        certify_set(&cx, &asked, &mut found);
    }
    found.verdict = found.claims.iter().map(|c| c.verdict).reduce(Verdict::and).unwrap_or(Verdict::Undetermined);
    Ok(found)
}

fn without_contraction(contraction: &Contraction, length: usize, open: usize) -> Certified {
    let reason = format!("contraction is not decided: {open} words of length {length} are left");
    let claim = Claim {
        text: "the shape has tangents".to_owned(),
        verdict: Verdict::Undetermined,
        statement: None,
        reason: Some(reason),
    };
    Certified {
        claims: vec![claim],
        verdict: Verdict::Undetermined,
        contraction: contraction.clone(),
        states: Vec::new(),
        points: Vec::new(),
        dense: None,
    }
}

fn state_report(cx: &Context, state: usize) -> StateReport {
    let space = cx.spaces.of(state);
    StateReport {
        state,
        relevant: space.basis.cols(),
        visible: space.visible.rows(),
        base: space.base.clone(),
        radius: cx.balls.radius(state).clone(),
    }
}

/// Whether the linear part of a cycle has spectral radius at least 1: a float proposes, the exact spectrum decides.
fn expands(linear: &Matrix) -> bool {
    if !crate::approx::may_expand(linear) {
        return false;
    }
    let spectrum = Spectrum::of(linear);
    let Some(class) = spectrum.classes.first() else { return false };
    let root: &Root = spectrum.root(class.members[0]);
    root.cmp_modulus_rational(&Rational::from(1)) != std::cmp::Ordering::Less
}

fn add_point(cx: &Context, spec: Option<point::PointSpec>, found: &mut Certified) -> Option<usize> {
    let spec = spec?;
    if let Some(known) = found.points.iter().position(|p| same_place(&p.role, &spec)) {
        return Some(known);
    }
    found.points.push(point::examine_point(cx, &spec)?);
    Some(found.points.len() - 1)
}

fn same_place(role: &Role, spec: &point::PointSpec) -> bool {
    *role == spec.role && !matches!(role, Role::Interior | Role::SetPoint)
}

fn certify_curve(cx: &Context, asked: &[Address], found: &mut Certified) {
    let shape = cx.shape;
    let mut ends = Vec::new();
    for end in [End::Start, End::Finish] {
        ends.extend(add_point(cx, point::end_spec(cx, end), found));
    }
    let mut joints = Vec::new();
    for (path, state) in shortest_paths(shape) {
        if shape.states[state].kind == CellKind::Edge {
            for (left, right) in point::joint_pairs(cx, state) {
                joints.extend(add_point(cx, point::joint_spec(cx, &path, left, right), found));
            }
        }
    }
    if cx.spaces.of(shape.start).basis.cols() == 0 {
        let reason = Some("the attractor is a single point".to_owned());
        let text = "the curve has a tangent at a dense set of points".to_owned();
        found.claims.push(Claim { text, verdict: Verdict::Undetermined, statement: None, reason });
        return;
    }
    let dense = dense_set(cx, joints);
    found.claims.push(end_claim(found, &ends));
    let claim = dense_claim(cx, &dense, found);
    found.claims.push(claim);
    found.dense = Some(dense);
    for address in asked {
        if let Some(index) = add_point(cx, point::address_spec(cx, address), found) {
            found.claims.push(point_claim(found, index, address));
        }
    }
}

fn certify_set(cx: &Context, asked: &[Address], found: &mut Certified) {
    let start = cx.shape.start;
    let mut addresses: Vec<Address> = asked.to_vec();
    if addresses.is_empty() {
        for (i, piece) in cx.shape.states[start].pieces.iter().enumerate() {
            if piece.target == start {
                addresses.push(Address::periodic(vec![i]));
            }
        }
    }
    for address in &addresses {
        if let Some(index) = add_point(cx, point::address_spec(cx, address), found) {
            found.claims.push(point_claim(found, index, address));
        }
    }
}

/// A shortest path from the start to every reachable state.
fn shortest_paths(shape: &Shape) -> Vec<(Vec<usize>, usize)> {
    let mut paths = vec![(Vec::new(), shape.start)];
    let mut next = 0;
    while next < paths.len() {
        let (path, state) = paths[next].clone();
        for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
            if paths.iter().all(|(_, e)| *e != piece.target) {
                let mut longer = path.clone();
                longer.push(letter);
                paths.push((longer, piece.target));
            }
        }
        next += 1;
    }
    paths
}

/// The hypotheses of Theorem 5 on injectivity, in the visible quotients.
fn dense_set(cx: &Context, joints: Vec<usize>) -> DenseSet {
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
    DenseSet { injective, view_injective, joints }
}

fn end_claim(found: &Certified, ends: &[usize]) -> Claim {
    let verdict = ends.iter().map(|&i| found.points[i].verdict).reduce(Verdict::and);
    let failing = ends.iter().find(|&&i| found.points[i].verdict != Verdict::Proved);
    let reason = failing.map(|&i| {
        let side = if found.points[i].role == Role::LeftEnd { "left" } else { "right" };
        format!("{side} end: {}", found.points[i].reason.clone().unwrap_or_default())
    });
    Claim {
        text: "the curve has a tangent line at both end points".to_owned(),
        verdict: verdict.unwrap_or(Verdict::Undetermined),
        statement: None,
        reason,
    }
}

fn point_claim(found: &Certified, index: usize, address: &Address) -> Claim {
    let point = &found.points[index];
    Claim {
        text: format!("the shape has a tangent line at the address {address}"),
        verdict: point.verdict,
        statement: None,
        reason: point.reason.clone(),
    }
}

/// Theorem 5, or the joints one by one where its hypotheses fail.
fn dense_claim(cx: &Context, dense: &DenseSet, found: &mut Certified) -> Claim {
    let text = "the curve has a tangent line at every joint of every level, a dense set".to_owned();
    let claim = |verdict, reason: Option<String>| Claim {
        text: text.clone(),
        verdict,
        statement: Some(Statement::Theorem5),
        reason,
    };
    let joint_verdict = dense.joints.iter().map(|&i| found.points[i].verdict).reduce(Verdict::and);
    let Some(joint_verdict) = joint_verdict else {
        return claim(Verdict::Undetermined, Some("no joint between pieces that are more than a point".to_owned()));
    };
    if joint_verdict == Verdict::Refuted {
        return claim(Verdict::Refuted, Some("a first-level joint has no tangent".to_owned()));
    }
    let injective = dense.view_injective && dense.injective.iter().all(|(_, _, ok)| *ok);
    if injective {
        let reason = (joint_verdict != Verdict::Proved).then(|| "a first-level joint is not decided".to_owned());
        return claim(joint_verdict, reason);
    }
    for (path, left, right) in deep_joints(cx) {
        let Some(index) = add_point(cx, point::joint_spec(cx, &path, left, right), found) else { continue };
        if found.points[index].verdict == Verdict::Refuted {
            return claim(Verdict::Refuted, Some("a joint of a deeper level has no tangent".to_owned()));
        }
    }
    let reason = "an operator, or the projection by the control points, is not injective on the relevant space: only the joints \
                  listed were examined";
    claim(Verdict::Undetermined, Some(reason.to_owned()))
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
