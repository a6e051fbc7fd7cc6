//! The theorem checker: from a shape to verdicts with evidence. Statements and proofs are in `docs/theory.md`.
#![deny(clippy::disallowed_methods)]

pub mod border;
mod branch;
pub mod characteristic;
pub mod claim;
mod components;
pub mod cone;
mod cone_over;
mod cone_search;
mod dense;
mod derived;
mod direction;
pub mod enclosed;
mod everywhere;
pub mod exponent;
pub mod filter;
mod frames;
pub mod gap;
pub mod graph;
mod hodograph;
pub mod lattice;
pub mod local;
pub mod parameter;
mod point;
mod provable;
pub mod region;
pub mod regularity;
mod require;
mod ring;
mod side;
mod sign;
mod similarity;
mod slow;
pub mod smoothness;
pub mod surface;
mod verdict;
mod viewpoint;
pub mod wavelet;

pub use crate::statement::Statement;
pub use branch::{Context, Quotient, krylov, restrict};
pub use claim::{AboutPlane, Assertion, Claim, Limit, Measure, Reason, Seen};
pub use components::{Component, Components};
pub use cone_over::ConesOver;
pub use direction::{Direction, primitive};
pub use everywhere::{EveryJoint, Everywhere};
pub use frames::{FrameCones, FrameKind, FrameReport, Frames, SeenState};
pub use gap::{BranchGap, Defect, EveryGap, EverySurfaceGap, NoChart, NoGerm, PlaneGap, PointGap, TopRow};
pub use hodograph::{Hodograph, Span, Turn};
pub use parameter::Parameter;
pub use provable::Provable;
pub use require::{Required, Topic, UnknownTopic};
pub use ring::{Discharged, Functional, Part, Position, RingAnswer, RingPiece, RingProof, Witness};
pub use sign::{Depth, depths};
pub use similarity::Similarities;
pub use slow::SlowCycle;
pub use verdict::{
    About, BranchReport, Certified, DenseSet, Dimension, Holder, Kind, Outcome, PointReport, Rate, Rays, Role, Side,
    StateReport, Verdict,
};
pub use viewpoint::Viewpoint;

use crate::algebraic::Root;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::jordan::{Scalar, Spectral};
use crate::linalg::Matrix;
use crate::radius::{NormContraction, contraction_by_norms, polytopes};
use crate::shape::{
    Address, AddressError, Balls, CellKind, ComplexError, Contraction, CurveError, End, OwnPoints, Polytopes, Shape,
    ShapeError, Spaces, contraction_within,
};
use thiserror::Error;

/// Why a shape cannot be certified at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
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
            Self::Shape(ShapeError::Shares { .. }) => "secant::case::shares",
            Self::Shape(ShapeError::Boundary { .. }) => "secant::case::boundary",
            Self::Curve(CurveError::Apart { .. }) => "secant::shape::adjacency",
            Self::Curve(CurveError::NoEnd { .. }) => "secant::shape::contraction",
            Self::Curve(CurveError::Identity { .. }) | Self::Complex(_) => "secant::shape::identity",
            Self::Address(_) => "secant::case::address",
            Self::Expands { .. } | Self::FixedPoint => "secant::shape::contraction",
        }
    }
}

/// Certifies the tangent lines of a shape: end points, first-level joints of all reachable states, further addresses, and the
/// dense set. [`prove`](crate::prove::prove) is the door for questions of any kind, surfaces among them.
///
/// # Errors
/// [`ModelError`] where the shape is not a model, does not contract, or an address does not exist.
///
/// # Cost
/// Dominated by contraction (at most [`crate::shape::MAX_WORDS`] products) and the ring conditions of the branches.
pub fn certify<E: Provable>(shape: &Shape<E>, addresses: &[Address]) -> Result<Certified<E>, ModelError> {
    certify_within(shape, addresses, &Budget::default())
}

/// As [`certify`] with a budget of its own.
///
/// # Errors
/// As [`certify`].
pub fn certify_within<E: Provable>(
    shape: &Shape<E>,
    addresses: &[Address],
    budget: &Budget,
) -> Result<Certified<E>, ModelError> {
    shape.check()?;
    let (contraction, norm) = E::contraction(shape, budget)?;
    if !contraction.is_proved() {
        return Ok(without_contraction(&contraction, norm));
    }
    shape.check_curves()?;
    let spaces = Spaces::new(shape).ok_or(ModelError::FixedPoint)?;
    let Some(balls) = E::balls(shape, &spaces, &contraction) else {
        return Ok(without_contraction(&contraction, None));
    };
    let hulls = std::cell::OnceCell::new();
    let (base, from) = (field(shape), Viewpoint::start(shape));
    let cx = Context { shape, base: &base, spaces: &spaces, balls: &balls, hulls: &hulls, from, budget };
    let mut found = Certified::nothing(&contraction);
    found.states = shape.reachable().into_iter().map(|e| state_report(&cx, e)).collect();
    found.similarities = similarity::similarities(&cx);
    let mut asked = Vec::new();
    for address in addresses {
        asked.push(address.normalise(shape, shape.start)?);
    }
    if shape.states[shape.start].kind == CellKind::Edge {
        certify_curve(&cx, &asked, &mut found);
    } else {
        certify_set(&cx, &asked, &mut found);
    }
    if found.similarities.is_some() {
        let by = Some(Statement::Similarities);
        found.claims.push(Claim::refuted(Assertion::SomePoint, by, Reason::Similarities));
    }
    E::everywhere(&cx, &mut found);
    found.polygons = cx.polygons();
    found.polygon_weights = cx.polygon_weights();
    found.verdict = found.overall();
    Ok(found)
}

/// Decides whether a shape contracts.
///
/// # Errors
/// [`ModelError::Expands`] with a cycle that does not contract.
///
/// # Cost
/// At most [`crate::shape::MAX_WORDS`] products, then polytopes or a joint spectral radius.
pub fn contraction_of<E: Provable>(shape: &Shape<E>) -> Result<Contraction, ModelError> {
    shape.check()?;
    Ok(E::contraction(shape, &Budget::default())?.0)
}

/// Largest number of coordinates of a state for which norms other than those of words are tried.
const MAX_NORM_DIMENSION: usize = 12;

/// The same where words contract, but slowly.
const MAX_SLOW_DIMENSION: usize = 5;

/// Constants of words above this one make balls so large that polytopes are tried.
fn slow_words() -> Rational {
    Rational::from(31) / Rational::from(32)
}

/// The field of the entries of a shape.
pub fn field<E: Scalar>(shape: &Shape<E>) -> E::Base {
    E::base(crate::shape::entries(shape))
}

fn expanding<E>(shape: &Shape<E>, index: usize, word: &[usize]) -> ModelError {
    ModelError::Expands { state: shape.states[index].name.clone(), index, word: word.to_vec() }
}

/// Decides contraction of a checked shape by words.
fn word_contraction<E: Scalar>(shape: &Shape<E>, budget: &Budget) -> Result<Contraction, ModelError> {
    let base = field(shape);
    let found = contraction_within(shape, budget.words, budget.work, |linear| expands(linear, &base));
    match &found {
        Contraction::Refuted { state, word } => Err(expanding(shape, *state, word)),
        _ => Ok(found),
    }
}

/// Decides contraction of a checked shape by words, then by norms; with an upper bound below 1 of the joint spectral radius of
/// the linear parts where that is known, but nothing that encloses the attractor.
fn rational_contraction(shape: &Shape, budget: &Budget) -> Result<(Contraction, Option<Rational>), ModelError> {
    let found = word_contraction(shape, budget)?;
    let largest = shape.reachable().into_iter().map(|e| shape.states[e].dim).fold(0, usize::max);
    match &found {
        // Words that hardly contract give balls far too large.
        Contraction::Proved(proof) if largest <= MAX_SLOW_DIMENSION && proof.constant > slow_words() => {
            return Ok((polytopes(shape).map_or(found, Contraction::Polytopes), None));
        }
        Contraction::Undetermined { .. } if largest <= MAX_NORM_DIMENSION => {}
        _ => return Ok((found, None)),
    }
    let norms = contraction_by_norms(shape, &budget.radius);
    // A proof in any coordinates is one, where own points span the whole space.
    let own = || {
        let found = own_polytopes(shape, &Spaces::new(shape)?)?;
        Polytopes::checked(shape, found.vertices, found.weights)
    };
    let settled = matches!(norms, Some(NormContraction::Enclosed(_) | NormContraction::Refuted { .. }));
    if let Some(found) = (!settled).then(own).flatten() {
        return Ok((Contraction::Polytopes(found), None));
    }
    match norms {
        Some(NormContraction::Enclosed(polytopes)) => Ok((Contraction::Polytopes(polytopes), None)),
        Some(NormContraction::Refuted { state, word, .. }) => Err(expanding(shape, state, &word)),
        Some(NormContraction::Proved(radius)) => Ok((found, radius.upper)),
        _ => Ok((found, None)),
    }
}

/// Polytopes found in coordinates by own points, which do not depend on units (theory §7, Own points), as polytopes of the shape.
fn own_polytopes(shape: &Shape, spaces: &Spaces) -> Option<Polytopes> {
    let own = OwnPoints::of(shape, spaces)?;
    let inner = own.shape(shape)?;
    let largest = inner.reachable().into_iter().map(|e| inner.states[e].dim).max()?;
    if largest > MAX_SLOW_DIMENSION {
        return None;
    }
    Some(polytopes(&inner)?.outwards(&own))
}

/// Polygons or polytopes that hold the attractors besides the balls.
fn own_enclosures(shape: &Shape, spaces: &Spaces, balls: &Balls) -> Option<Balls> {
    if shape.reachable().iter().all(|e| spaces.of(*e).basis.cols() <= 2) {
        return balls.with_hulls(shape, spaces);
    }
    Some(balls.with_polytopes(&own_polytopes(shape, spaces)?))
}

fn without_contraction<E: Scalar>(contraction: &Contraction, norm: Option<Rational>) -> Certified<E> {
    let (length, open) = match contraction {
        Contraction::Undetermined { length, open } => (*length, *open),
        _ => (0, 0),
    };
    let gap = match norm {
        Some(radius) => Reason::NotEnclosed { radius, length, open },
        None => Reason::Contraction { length, open },
    };
    Certified { claims: vec![Claim::open(Assertion::Tangents, gap)], ..Certified::nothing(contraction) }
}

fn state_report<E: Scalar>(cx: &Context<E>, state: usize) -> StateReport<E> {
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
fn expands<E: Scalar>(linear: &Matrix<E>, base: &E::Base) -> bool {
    if !crate::approx::may_expand(linear) {
        return false;
    }
    let spectrum = E::spectrum(linear, base);
    let Some(class) = spectrum.classes().first() else { return false };
    let root: &Root = spectrum.value(class.members[0]);
    root.cmp_modulus_rational(&Rational::from(1)) != std::cmp::Ordering::Less
}

fn add_point<E: Provable>(cx: &Context<E>, spec: Option<point::PointSpec>, found: &mut Certified<E>) -> Option<usize> {
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

fn certify_curve<E: Provable>(cx: &Context<E>, asked: &[Address], found: &mut Certified<E>) {
    let shape = cx.shape;
    let mut ends = Vec::new();
    for end in [End::Start, End::Finish] {
        ends.extend(add_point(cx, point::end_spec(cx, end), found));
    }
    let (mut joints, mut count) = (Vec::new(), 0);
    for (path, state) in shortest_paths(shape) {
        if shape.states[state].kind == CellKind::Edge {
            for (left, right) in point::joint_pairs(cx, state) {
                count += 1;
                joints.extend(add_point(cx, point::joint_spec(cx, &path, left, right), found));
            }
        }
    }
    if cx.spaces.of(shape.start).basis.cols() == 0 {
        found.claims.push(Claim::open(Assertion::TangentDense, Reason::SinglePoint));
        return;
    }
    found.claims.push(end_claim(found, &ends));
    dense::claims(cx, dense::dense_set(cx, joints), count, found);
    for address in asked {
        let index = add_point(cx, point::address_spec(cx, address), found);
        found.claims.push(point_claim(found, index, address));
    }
}

fn certify_set<E: Provable>(cx: &Context<E>, asked: &[Address], found: &mut Certified<E>) {
    let start = cx.shape.start;
    let pieces = cx.shape.states[start].pieces.iter().enumerate();
    let mut addresses: Vec<Address> =
        pieces.filter(|(_, p)| p.target == start).map(|(i, _)| Address::periodic(vec![i])).collect();
    addresses.extend(asked.iter().cloned());
    let mut seen = std::collections::BTreeSet::new();
    addresses.retain(|a| seen.insert(a.clone()));
    for address in &addresses {
        let index = add_point(cx, point::address_spec(cx, address), found);
        found.claims.push(point_claim(found, index, address));
    }
}

/// A shortest path from the start to every reachable state.
fn shortest_paths<E>(shape: &Shape<E>) -> Vec<(Vec<usize>, usize)> {
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

fn end_claim<E: Scalar>(found: &Certified<E>, ends: &[usize]) -> Claim {
    let verdict = Verdict::all(2, ends.iter().map(|&i| found.points[i].verdict));
    let reason =
        ends.iter().find(|&&i| found.points[i].verdict == verdict).map_or(Reason::Unexamined, |&i| Reason::End(i));
    Claim::as_found(Assertion::TangentAtEnds, verdict, None, reason)
}

fn point_claim<E: Scalar>(found: &Certified<E>, index: Option<usize>, address: &Address) -> Claim {
    let what = |about| Assertion::TangentAt { address: address.clone(), about, point: index };
    let Some(index) = index else { return Claim::open(what(About::Branch), Reason::Unexamined) };
    let point = &found.points[index];
    Claim::as_found(what(point.about()), point.verdict, None, Reason::Point(index))
}
