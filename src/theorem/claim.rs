//! What is claimed, and what the answers rest on, as data. The words are in [`crate::report::claims`].

use super::gap::BranchGap;
use super::verdict::{About, BranchReport, Certified, Outcome};
use crate::answer::{Answer, Verdict};
use crate::arith::{Interval, Rational};
use crate::jordan::Scalar;
use crate::shape::Address;
use crate::statement::Statement;

/// One claim with its answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What is claimed.
    pub what: Assertion,
    /// The answer, with the statement that decides it; `None` where every point has a statement of its own.
    pub answer: Answer<Option<Statement>, (Option<Statement>, Reason), Reason>,
}

impl Claim {
    /// A claim that holds by a statement, or by the statements of its points.
    #[must_use]
    pub fn proved(what: Assertion, by: Option<Statement>) -> Self {
        Self { what, answer: Answer::Proved(by) }
    }

    /// A claim that fails.
    #[must_use]
    pub fn refuted(what: Assertion, by: Option<Statement>, why: Reason) -> Self {
        Self { what, answer: Answer::Refuted((by, why)) }
    }

    /// A claim that is not decided.
    #[must_use]
    pub fn open(what: Assertion, gap: Reason) -> Self {
        Self { what, answer: Answer::Open(gap) }
    }

    /// A claim whose answer is that of something examined, with its statement; the reason is needed unless it is proved.
    #[must_use]
    pub fn as_found(what: Assertion, verdict: Verdict, by: Option<Statement>, reason: Reason) -> Self {
        match verdict {
            Verdict::Proved => Self::proved(what, by),
            Verdict::Refuted => Self::refuted(what, by, reason),
            Verdict::Undetermined => Self::open(what, reason),
        }
    }

    /// The verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.answer.verdict()
    }

    /// The statement that decides it; none where it is open, or where every point has its own.
    #[must_use]
    pub fn statement(&self) -> Option<Statement> {
        match &self.answer {
            Answer::Proved(by) | Answer::Refuted((by, _)) => *by,
            Answer::Open(_) => None,
        }
    }

    /// Why it is not proved.
    #[must_use]
    pub fn reason(&self) -> Option<&Reason> {
        match &self.answer {
            Answer::Proved(_) => None,
            Answer::Refuted((_, reason)) | Answer::Open(reason) => Some(reason),
        }
    }
}

/// The parameter of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Measure {
    /// Pieces take equal parts.
    #[default]
    Uniform,
    /// Pieces take the shares that are given.
    Shares,
}

impl Measure {
    /// The parameter of a shape.
    #[must_use]
    pub fn of<E: crate::linalg::Entry>(shape: &crate::shape::Shape<E>) -> Self {
        if shape.has_shares() { Self::Shares } else { Self::Uniform }
    }
}

/// What a claim says. Every list of points that an index points into is named with it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Assertion {
    /// The shape has tangents: all that can be asked of a shape that is not shown to contract.
    Tangents,
    /// The curve has a tangent line at both end points.
    TangentAtEnds,
    /// The curve has a tangent line at a dense set of points.
    TangentDense,
    /// The curve has a tangent line at every joint of every level (Theorem 5).
    DenseJoints,
    /// The curve has a tangent line at each of the joints that were examined.
    ExaminedJoints,
    /// The projected curve has a tangent line at every joint whose tangent line is not killed (Theorem 5′).
    ProjectedJoints,
    /// The same at every joint between pieces that are more than a point where they are looked at (Theorem 11).
    SeenJoints,
    /// The curve has a tangent line at every joint whose tangent line is not killed where it is looked at (Theorem 11′).
    UnkilledJoints,
    /// There is a tangent line at the address.
    TangentAt {
        /// The address, normalised.
        address: Address,
        /// What has it.
        about: About,
        /// The index of its point in [`super::Certified::points`]; `None` where the point could not be examined.
        point: Option<usize>,
    },
    /// Some point of the shape has a tangent line.
    SomePoint,
    /// The curve has a tangent at every point, and the tangent turns continuously.
    G1,
    /// The curve is `C^k` in its parameter.
    Smooth {
        /// The order `k`.
        order: usize,
        /// The parameter.
        over: Measure,
    },
    /// The curve is a polynomial in its parameter.
    Polynomial(Measure),
    /// The supremum of the Hölder exponents `k + α` of the curve in its parameter lies in an interval; `None` where no bound is
    /// known.
    Exponent(Option<Interval>, Measure),
    /// The surface has a tangent plane at every vertex of its first subdivision.
    PlaneAtVertices,
    /// The surface has a tangent plane at a dense set of points (Theorem 5″).
    DensePlanes {
        /// What the control points leave of it.
        seen: Seen,
    },
    /// The surface is G¹: immersed, with a tangent plane at every point, which turns continuously.
    PlaneEverywhere,
    /// There is a tangent plane at the address.
    PlaneAt {
        /// The address, normalised.
        address: Address,
        /// What has it.
        about: AboutPlane,
        /// The index of its point in the `points` of [`super::surface::Surface`]; `None` where it could not be examined.
        point: Option<usize>,
    },
    /// For almost all control points the surface is `C¹` at a vertex of the valence.
    C1AtVertex {
        /// The valence.
        valence: usize,
    },
    /// For almost all control points the surface is `C¹` up to its border at a vertex there.
    C1AtBorder {
        /// The number of its faces.
        faces: usize,
        /// Whether the border is a smooth curve there; otherwise the vertex is a corner.
        smooth: bool,
    },
    /// For almost all control points the surface has a tangent plane at a vertex of the valence.
    PlaneAtVertex {
        /// The valence.
        valence: usize,
    },
    /// The same as [`Assertion::C1AtVertex`] for every valence from `from` on.
    C1AtVertices {
        /// The first valence.
        from: usize,
    },
}

impl Assertion {
    /// Its name in JSON (docs/json.md).
    #[must_use]
    pub fn id(&self) -> &'static str {
        match self {
            Self::Tangents => "tangents",
            Self::TangentAtEnds => "tangent-at-ends",
            Self::TangentDense => "tangent-dense",
            Self::DenseJoints => "dense-joints",
            Self::ExaminedJoints => "examined-joints",
            Self::ProjectedJoints => "projected-joints",
            Self::SeenJoints => "seen-joints",
            Self::UnkilledJoints => "unkilled-joints",
            Self::TangentAt { .. } => "tangent-at",
            Self::SomePoint => "some-point",
            Self::G1 => "g1",
            Self::Smooth { .. } => "smooth",
            Self::Polynomial(_) => "polynomial",
            Self::Exponent(..) => "exponent",
            Self::PlaneAtVertices => "plane-at-vertices",
            Self::DensePlanes { .. } => "dense-planes",
            Self::PlaneEverywhere => "plane-everywhere",
            Self::PlaneAt { .. } => "plane-at",
            Self::C1AtVertex { .. } => "c1-at-vertex",
            Self::C1AtBorder { .. } => "c1-at-border",
            Self::PlaneAtVertex { .. } => "plane-at-vertex",
            Self::C1AtVertices { .. } => "c1-at-vertices",
        }
    }

    /// Whether it is about all joints of a curve, or those examined: the question `joints` of a certificate.
    #[must_use]
    pub fn is_of_joints(&self) -> bool {
        *self == Self::ExaminedJoints || self.is_of_dense_joints()
    }

    /// Whether it is about a dense set of joints, by Theorem 5 or 5′, or by frames.
    #[must_use]
    pub fn is_of_dense_joints(&self) -> bool {
        matches!(self, Self::DenseJoints | Self::ProjectedJoints | Self::SeenJoints | Self::UnkilledJoints)
    }

    /// The address that it is about, and the index of its point in the list that belongs to it.
    #[must_use]
    pub fn asked(&self) -> Option<(&Address, Option<usize>)> {
        match self {
            Self::TangentAt { address, point, .. } | Self::PlaneAt { address, point, .. } => Some((address, *point)),
            _ => None,
        }
    }
}

/// What has a tangent plane at an address.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AboutPlane {
    /// The germ of the parametrised surface.
    Surface,
    /// The germ of the branch: more cells meet there than are looked at.
    Crowded,
    /// The germ of the branch: other addresses of the same point are not looked at.
    Branch,
}

/// What the control points leave of the planes of Theorem 5″.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Seen {
    /// All of them: they are injective on the relevant space.
    Injective,
    /// Those that are not folded.
    Projected,
    /// Those that are not folded, and there is one in every cell.
    Everywhere,
}

/// Why a claim is refuted or open; an index is one of [`super::Certified::points`] unless something else is said.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// Contraction is not decided.
    Contraction {
        /// Length of the longest words.
        length: usize,
        /// How many of them are left.
        open: usize,
    },
    /// The system contracts, but nothing encloses its attractor.
    NotEnclosed {
        /// A bound of the joint spectral radius of its linear parts.
        radius: Rational,
        /// Length of the longest words.
        length: usize,
        /// How many of them are left.
        open: usize,
    },
    /// The attractor is a single point.
    SinglePoint,
    /// Something that belongs to the claim could not be examined.
    Unexamined,
    /// What was found at an end point.
    End(usize),
    /// What was found at the point that the claim is about.
    Point(usize),
    /// There is no joint between pieces that are more than a point.
    NoJoint,
    /// What was found at a first-level joint.
    FirstJoint(usize),
    /// What was found at a joint of some level.
    Joint(usize),
    /// An operator is not injective on the relevant space, so that only the joints listed were examined.
    NotInjective {
        /// The state.
        state: usize,
        /// The letter of the operator.
        letter: usize,
    },
    /// The projection is not injective, and before it a first-level joint is not proved.
    BeforeProjection {
        /// Its index in the `upstairs` of [`super::DenseSet`].
        joint: usize,
    },
    /// The projection is not injective, and the tangent lines at the joints were not seen to span the relevant space.
    NoSpan,
    /// All maps are similarities of a plane.
    Similarities,
    /// What breaks at a point.
    Broken(usize),
    /// No common cone was found, nor a derivative (Theorem 12); with irrational entries nothing else is looked for.
    NoCone,
    /// What was found about every point of the curve ([`super::Certified::everywhere`]).
    EveryPoint,
    /// The same, where it is refuted at a point that is neither an end nor a joint, so that no other claim speaks of it.
    InsidePoint,
    /// What was found about an order of smoothness in the uniform parameter.
    Order(usize),
    /// Nothing is known in the uniform parameter ([`super::Certified::parameter`]).
    NoOrder,
    /// What was found at the point of the surface that the claim is about, by its index in the surface's points.
    SurfacePoint(usize),
    /// What was found at a vertex, by its index in the surface's points.
    SurfaceVertex(usize),
    /// What was found about every point of the surface ([`super::surface::Surface::every`]).
    EverySurfacePoint,
    /// Too many cells meet at a vertex.
    TooManyCells,
    /// An operator of a surface is not injective on the visible relevant space.
    SurfaceNotInjective {
        /// The state.
        state: usize,
        /// The letter of the operator.
        letter: usize,
    },
    /// What was found at a valence.
    Valence(usize),
    /// A condition of the proof for all valences at once is not shown.
    Conditions,
    /// What was found at the vertices inside a state, by the index in the `vertices` of [`super::surface::SurfaceDense`].
    VertexInside(usize),
}

/// A limit of the [`Budget`](crate::budget::Budget) that ended a search: with more, the question may be decided.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// `words` (or `work`): the products formed did not all shrink.
    Words,
    /// `cells`: the search in the ring of a branch ended (it may also be the places of its enclosures, which are fixed).
    Cells {
        /// The address of the branch.
        branch: Address,
        /// The cell that was left, from the state of its cycle.
        cell: Vec<usize>,
    },
}

impl Limit {
    /// The field of the budget, and its option of `secant certify`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Words => "words",
            Self::Cells { .. } => "cells",
        }
    }
}

impl<E: Scalar> Certified<E> {
    /// The limits that ended searches whose answer an undetermined claim waits for, each once.
    #[must_use]
    pub fn limits(&self) -> Vec<Limit> {
        let mut all: Vec<Limit> = Vec::new();
        for reason in self.claims.iter().filter(|c| c.verdict() == Verdict::Undetermined).filter_map(Claim::reason) {
            for limit in self.limits_of(reason) {
                if !all.contains(&limit) {
                    all.push(limit);
                }
            }
        }
        all
    }

    fn limits_of(&self, reason: &Reason) -> Vec<Limit> {
        let cells = |branch: &BranchReport<E>| match &branch.outcome {
            // Where a condition was refuted, no search ended.
            Outcome::Open { place: Some(cell), reason, .. } if *reason != BranchGap::RingFails => {
                Some(Limit::Cells { branch: branch.address.clone(), cell: cell.clone() })
            }
            _ => None,
        };
        match reason {
            Reason::Contraction { .. } | Reason::NotEnclosed { .. } => vec![Limit::Words],
            Reason::End(k) | Reason::Point(k) | Reason::FirstJoint(k) | Reason::Joint(k) => {
                self.points.get(*k).into_iter().flat_map(|p| &p.branches).filter_map(cells).collect()
            }
            Reason::BeforeProjection { joint } => {
                let point = self.dense.as_ref().and_then(|d| d.upstairs.get(*joint));
                point.into_iter().flat_map(|p| &p.branches).filter_map(cells).collect()
            }
            _ => Vec::new(),
        }
    }
}
