//! The theorem checker: from a shape to verdicts with evidence. Statements and proofs are in `docs/theory.md`.

mod branch;
pub mod cone;
mod cone_search;
mod dense;
mod direction;
mod everywhere;
mod frames;
mod point;
pub mod regularity;
mod ring;
mod similarity;
mod slow;
pub mod smoothness;
pub mod surface;
mod verdict;
mod viewpoint;
pub mod wavelet;

pub use crate::statement::Statement;
pub use branch::Context;
pub use direction::{Direction, primitive};
pub use everywhere::{EveryJoint, Everywhere};
pub use frames::{FrameCones, FrameKind, FrameReport, Frames, Seen};
pub use ring::{Discharged, Functional, Part, Position, RingAnswer, RingPiece, RingProof, Witness};
pub use similarity::Similarities;
pub use slow::SlowCycle;
pub use verdict::{
    About, BranchReport, Certified, Claim, DenseSet, Dimension, Holder, Kind, Outcome, PointReport, Rate, Rays, Role,
    Side, StateReport, Verdict,
};
pub use viewpoint::Viewpoint;

use crate::algebraic::Root;
use crate::arith::Rational;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::radius::{NormContraction, Options, contraction_by_norms, polytopes};
use crate::shape::{
    Address, AddressError, Balls, CellKind, ComplexError, Contraction, CurveError, End, Shape, ShapeError, Spaces,
    contraction,
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
    /// An identity of a surface fails, or its cells do not fit.
    #[error(transparent)]
    Complex(#[from] ComplexError),
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

impl ModelError {
    /// The diagnostic code, such as `secant::shape::adjacency`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Shape(ShapeError::NoPiece { .. }) => "secant::shape::empty",
            Self::Shape(ShapeError::Kind { .. }) => "secant::shape::kind",
            Self::Shape(ShapeError::Size { .. }) => "secant::case::size",
            Self::Shape(ShapeError::Sum { .. }) => "secant::case::sum",
            Self::Shape(ShapeError::Control { .. }) => "secant::case::control",
            Self::Shape(ShapeError::Boundary { .. }) => "secant::case::boundary",
            Self::Curve(CurveError::Apart { .. }) => "secant::shape::adjacency",
            Self::Curve(CurveError::Identity { .. }) | Self::Complex(_) => "secant::shape::identity",
            Self::Address(_) => "secant::case::address",
            Self::Expands { .. } | Self::FixedPoint => "secant::shape::contraction",
        }
    }
}

/// Certifies a shape: end points, first-level joints of all reachable states, further addresses, and the dense set.
///
/// # Errors
/// [`ModelError`] where the shape is not a model, does not contract, or an address does not exist.
///
/// # Cost
/// Dominated by contraction (at most [`crate::shape::MAX_WORDS`] products) and the ring conditions of the branches.
pub fn certify(shape: &Shape, addresses: &[Address]) -> Result<Certified, ModelError> {
    shape.check()?;
    let (contraction, norm) = decide_contraction(shape)?;
    if !contraction.is_proved() {
        return Ok(without_contraction(&contraction, norm));
    }
    shape.check_curves()?;
    let spaces = Spaces::new(shape).ok_or(ModelError::FixedPoint)?;
    let Some(balls) = Balls::of(shape, &spaces, &contraction) else {
        return Ok(without_contraction(&contraction, None));
    };
    let hulls = std::cell::OnceCell::new();
    let cx = Context { shape, spaces: &spaces, balls: &balls, hulls: &hulls, from: Viewpoint::start(shape) };
    let mut found = Certified::nothing(&contraction);
    found.states = shape.reachable().into_iter().map(|e| state_report(&cx, e)).collect();
    found.similarities = similarity::similarities(&cx);
    let mut asked = Vec::new();
    for address in addresses {
        asked.push(address.normalise(shape, shape.start)?);
    }
    if shape.states[shape.start].kind == CellKind::Edge {
        certify_curve(&cx, &asked, &mut found);
        found.everywhere = everywhere::everywhere(&cx, &mut found);
    } else {
        certify_set(&cx, &asked, &mut found);
    }
    found.polygons = cx.polygons();
    if found.similarities.is_some() {
        found.claims.push(Claim {
            text: "some point of the shape has a tangent line".to_owned(),
            verdict: Verdict::Refuted,
            statement: Some(Statement::Similarities),
            reason: Some(
                "all maps are similarities of a plane: the tangent subspace is the plane at every point".to_owned(),
            ),
            asked: None,
        });
    }
    found.verdict = found.claims.iter().map(|c| c.verdict).reduce(Verdict::and).unwrap_or(Verdict::Undetermined);
    Ok(found)
}

/// Decides whether a shape contracts.
///
/// # Errors
/// [`ModelError::Expands`] with a cycle that does not contract.
///
/// # Cost
/// At most [`crate::shape::MAX_WORDS`] products, then polytopes or a joint spectral radius.
pub fn contraction_of(shape: &Shape) -> Result<Contraction, ModelError> {
    shape.check()?;
    Ok(decide_contraction(shape)?.0)
}

/// Largest number of coordinates of a state for which norms other than those of words are tried.
const MAX_NORM_DIMENSION: usize = 12;

/// The same where words contract, but slowly.
const MAX_SLOW_DIMENSION: usize = 5;

/// Constants of words above this one make balls so large that polytopes are tried.
fn slow_words() -> Rational {
    Rational::from(31) / Rational::from(32)
}

/// Decides contraction of a checked shape by words, then by norms; with an upper bound below 1 of the joint spectral radius of
/// the linear parts where that is known, but nothing that encloses the attractor.
fn decide_contraction(shape: &Shape) -> Result<(Contraction, Option<Rational>), ModelError> {
    let expanding = |index: usize, word: &[usize]| {
        let state = shape.states[index].name.clone();
        Err(ModelError::Expands { state, index, word: word.to_vec() })
    };
    let found = contraction(shape, expands);
    let largest = shape.reachable().into_iter().map(|e| shape.states[e].dim).max().unwrap_or(0);
    match &found {
        Contraction::Refuted { state, word } => return expanding(*state, word),
        // Words that hardly contract give balls far too large.
        Contraction::Proved(proof) if largest <= MAX_SLOW_DIMENSION && proof.constant > slow_words() => {
            return Ok((polytopes(shape).map_or(found, Contraction::Polytopes), None));
        }
        Contraction::Undetermined { .. } if largest <= MAX_NORM_DIMENSION => {}
        _ => return Ok((found, None)),
    }
    match contraction_by_norms(shape, &Options::default()) {
        Some(NormContraction::Enclosed(polytopes)) => Ok((Contraction::Polytopes(polytopes), None)),
        Some(NormContraction::Refuted { state, word, .. }) => expanding(state, &word),
        Some(NormContraction::Proved(radius)) => Ok((found, radius.upper)),
        _ => Ok((found, None)),
    }
}

fn without_contraction(contraction: &Contraction, norm: Option<Rational>) -> Certified {
    let (length, open) = match contraction {
        Contraction::Undetermined { length, open } => (*length, *open),
        _ => (0, 0),
    };
    let reason = match norm {
        Some(bound) => format!(
            "the system contracts (the joint spectral radius of its linear parts is at most {:.6}), but the 1-norm does not show \
             it: {open} words of length {length} are left, and without them the attractor is not enclosed",
            crate::arith::to_f64(&bound)
        ),
        None => format!("contraction is not decided: {open} words of length {length} are left"),
    };
    let claim = Claim {
        text: "the shape has tangents".to_owned(),
        verdict: Verdict::Undetermined,
        statement: None,
        reason: Some(reason),
        asked: None,
    };
    Certified { claims: vec![claim], ..Certified::nothing(contraction) }
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
        found.claims.push(Claim { text, verdict: Verdict::Undetermined, statement: None, reason, asked: None });
        return;
    }
    let dense = dense::dense_set(cx, joints);
    found.claims.push(end_claim(found, &ends));
    dense::claims(cx, dense, found);
    for address in asked {
        if let Some(index) = add_point(cx, point::address_spec(cx, address), found) {
            found.claims.push(point_claim(found, index, address));
        }
    }
}

fn certify_set(cx: &Context, asked: &[Address], found: &mut Certified) {
    let start = cx.shape.start;
    let pieces = cx.shape.states[start].pieces.iter().enumerate();
    let mut addresses: Vec<Address> =
        pieces.filter(|(_, p)| p.target == start).map(|(i, _)| Address::periodic(vec![i])).collect();
    addresses.extend(asked.iter().cloned());
    let mut seen = std::collections::BTreeSet::new();
    addresses.retain(|a| seen.insert(a.clone()));
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
        asked: None,
    }
}

fn point_claim(found: &Certified, index: usize, address: &Address) -> Claim {
    let point = &found.points[index];
    Claim {
        text: match point.about() {
            About::Branch => format!(
                "the germ of the branch {address} has a tangent line (other addresses of the same point are not looked at)"
            ),
            About::Shape => format!("the shape has a tangent line at the address {address}"),
            About::Curve => format!("the parametrised curve has a tangent line at the address {address}"),
        },
        verdict: point.verdict,
        statement: None,
        reason: point.reason.clone(),
        asked: Some((address.clone(), index)),
    }
}
