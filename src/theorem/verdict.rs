//! What the program says: verdicts, points, rays, and the evidence for each.

use super::claim::Claim;
use super::cone_over::ConesOver;
use super::direction::Direction;
use super::frames::Frames;
use super::gap::{BranchGap, NoGerm, PointGap};
use super::ring::{RingPiece, RingProof, Witness};
pub use crate::answer::Verdict;
use crate::arith::Rational;
use crate::jordan::Scalar;
use crate::linalg::Matrix;
use crate::shape::{Address, Contraction, HullWeights};
use crate::statement::Statement;

/// Kinds of points (theory §2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// An end point of a curve with one ray.
    SmoothEnd,
    /// A point of a set with one ray.
    HalfTangent,
    /// One ray on each side, opposite.
    Regular,
    /// One ray on each side, equal.
    Cusp,
    /// Both rays on a side; the line exists.
    Oscillating,
    /// One ray on each side, on different lines.
    Corner,
    /// The tangent line exists; its rays are not settled.
    Line,
    /// There is no tangent line, and no more is known of the rays.
    NoTangent,
    /// Not decided.
    Undetermined,
}

impl Kind {
    /// The kind's name.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::SmoothEnd => "smooth end",
            Self::HalfTangent => "half-tangent",
            Self::Regular => "regular",
            Self::Cusp => "cusp",
            Self::Oscillating => "oscillating",
            Self::Corner => "corner",
            Self::Line => "tangent line",
            Self::NoTangent => "no tangent",
            Self::Undetermined => "undetermined",
        }
    }

    /// Whether the rays of both sides, or of the only one, are known.
    #[must_use]
    pub fn has_rays(self) -> bool {
        !matches!(self, Self::Line | Self::NoTangent | Self::Undetermined)
    }
}

/// What the verdict on a point is about (theory §2 and §9, Branch and shape).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum About {
    /// The germ of the parametrised curve.
    Curve,
    /// The shape as a set of points: nothing of it but the branch comes near the point, or the verdict is a refutation.
    Shape,
    /// The germ of the branch: other points of the shape may come as near.
    Branch,
}

impl About {
    /// `curve`, `shape` or `branch`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Curve => "curve",
            Self::Shape => "shape",
            Self::Branch => "branch",
        }
    }
}

/// Where a point sits in its curve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Role {
    /// The left end of the start state.
    LeftEnd,
    /// The right end of the start state.
    RightEnd,
    /// The joint between pieces `left` and `right` of the state reached by `path` from the start state.
    Joint {
        /// The path to the state.
        path: Vec<usize>,
        /// The state.
        state: usize,
        /// The piece that ends there.
        left: usize,
        /// The piece that begins there.
        right: usize,
    },
    /// A point inside a curve with a periodic address.
    Interior,
    /// A point of a shape that is no curve.
    SetPoint,
}

/// The dimension of the tangent subspace `D*`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dimension {
    /// A proved lower bound.
    pub at_least: usize,
    /// Whether the bound is the dimension.
    pub exact: bool,
}

/// Which parts of the curve a branch describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Points with smaller parameters.
    Left,
    /// Points with larger parameters.
    Right,
    /// Both.
    Both,
}

/// The rays of a branch, per side of the point in the start curve; each list has at most two entries.
#[derive(Debug, Clone)]
pub struct Rays {
    /// Limit rays of points before.
    pub left: Vec<Direction>,
    /// Limit rays of points after.
    pub right: Vec<Direction>,
}

/// How fast secants turn towards the tangent (theory §5, Rates), per turn of the cycle.
#[derive(Debug, Clone)]
pub enum Rate {
    /// `O(m^power (ρ_2/ρ_1)^m)`; the classes are those of the branch's spectrum, in order.
    Geometric {
        /// `ρ_2/ρ_1`, as the two eigenvalues whose moduli are compared.
        slower: crate::algebraic::Root,
        /// The dominant eigenvalue.
        dominant: crate::algebraic::Root,
        /// One less than the longest block of modulus `ρ_2`.
        power: usize,
    },
    /// `O(1/m)`: a Jordan block at the top.
    Harmonic,
    /// The cell lies on the line.
    Exact,
}

/// The local Hölder exponent `ln ρ / ln s` (theory §8).
#[derive(Debug, Clone)]
pub struct Holder {
    /// The dominant eigenvalue, whose modulus is `ρ`.
    pub eigenvalue: crate::algebraic::Root,
    /// The parameter contraction `s` of one turn of the cycle.
    pub scale: Rational,
    /// `ℓ`: with a longest block of size `ℓ+1 > 1` the quotient diverges like `m^ℓ`.
    pub power: usize,
}

/// What was found at a branch.
#[derive(Debug, Clone)]
pub enum Outcome<E = Rational> {
    /// The tangent subspace is a line.
    Line {
        /// The statement applied.
        statement: Statement,
        /// Indices of the eigenvalue: factor and root of the branch's spectrum.
        eigenvalue: (usize, usize),
        /// Length of the longest block of the top modulus.
        block: usize,
        /// The functional of the ring condition on the visible quotient (entries in Q(λ)).
        functional: Vec<crate::algebraic::Elem>,
        /// The proof of the ring condition; `None` for [`Statement::CorollaryLine`] where rays could not be settled.
        proof: Option<RingProof>,
        /// The direction `G v` in the space where the shape is looked at.
        direction: Direction,
        /// Its rays; empty lists on both sides where they are not settled.
        rays: Rays,
        /// Rate of convergence.
        rate: Rate,
        /// Local Hölder exponent.
        holder: Holder,
    },
    /// `D*` has more dimensions than a line.
    AtLeast {
        /// Lower bound of the dimension.
        dimension: usize,
        /// The statement applied.
        statement: Statement,
        /// Eigenvalues that span the part of `D*` found: factor and root of the branch's spectrum.
        eigenvalues: Vec<(usize, usize)>,
        /// The proof that the branch is isolated, where the statement needs it.
        isolation: Option<RingProof>,
        /// The point or sign change that refutes the ring condition, where the statement needs it.
        witness: Option<Witness<E>>,
    },
    /// There are no points of the shape near the point on this branch.
    NoGerm {
        /// Why.
        reason: NoGerm,
    },
    /// Not decided.
    Open {
        /// Why.
        reason: BranchGap,
        /// The smallest unresolved cell or the obstacle found, as a word from the branch's state.
        place: Option<Vec<usize>>,
        /// A proved lower bound of `dim D*`.
        at_least: usize,
        /// A direction that `D*` is known to contain (`U ⊂ D*`, the corollary).
        direction: Option<Direction>,
    },
}

/// One branch `u w^ω` and all that was computed for it.
#[derive(Debug, Clone)]
pub struct BranchReport<E: Scalar = Rational> {
    /// Which side of the point it describes.
    pub side: Side,
    /// Its address from the start state.
    pub address: Address,
    /// The state of the cycle.
    pub state: usize,
    /// `+1` or `-1`: the product of orientation signs along the prefix.
    pub prefix_sign: i32,
    /// `+1` or `-1`: the product of orientation signs along the cycle.
    pub cycle_sign: i32,
    /// `M = T_w`.
    pub cycle_operator: Matrix<E>,
    /// The fixed point `q` of `M`.
    pub fixed: Vec<E>,
    /// `G = P T_u`, from the state's space to the space where the shape is looked at.
    pub transport: Matrix<E>,
    /// Dimension of `V`, the relevant space of the state.
    pub relevant: usize,
    /// Coordinates on the visible quotient `Y = V/N_G`: `Y`-coordinates of `x` are `chart (x − q)`.
    pub chart: Matrix<E>,
    /// `L` on `Y`.
    pub linear: Matrix<E>,
    /// `G` on `Y`.
    pub view: Matrix<E>,
    /// The spectrum of `L` on `Y`.
    pub spectrum: E::Spectrum,
    /// The ring.
    pub ring: Vec<RingPiece<E>>,
    /// What follows.
    pub outcome: Outcome<E>,
}

impl<E: Scalar> BranchReport<E> {
    /// Whether all points of the shape near the branch's point belong to the branch, as far as it is isolated (theory §9, Branch
    /// and shape): it has no prefix, its cell is seen through a map that is injective on `Y`, and no piece of the ring was set
    /// aside.
    #[must_use]
    pub fn is_shape(&self) -> bool {
        let n = self.linear.rows();
        let nilpotent = (0..n).fold(Matrix::identity(n), |p, _| &p * &self.linear).is_zero();
        let nothing_aside = n <= 1 || nilpotent || self.ring.iter().all(|p| !p.collapses);
        self.address.prefix.is_empty() && self.view.rank() == n && nothing_aside
    }
}

impl<E: Scalar> PointReport<E> {
    /// What the verdict is about.
    #[must_use]
    pub fn about(&self) -> About {
        match self.role {
            Role::SetPoint if self.verdict == Verdict::Refuted => About::Shape,
            Role::SetPoint if self.branches.iter().all(BranchReport::<E>::is_shape) => About::Shape,
            Role::SetPoint => About::Branch,
            _ => About::Curve,
        }
    }
}

/// One examined point.
#[derive(Debug, Clone)]
pub struct PointReport<E: Scalar = Rational> {
    /// Where it sits.
    pub role: Role,
    /// The point in the barycentric space of the start state.
    pub position: Vec<E>,
    /// Its image under the control points.
    pub image: Option<Vec<E>>,
    /// Its branches; of a joint the left one first.
    pub branches: Vec<BranchReport<E>>,
    /// Whether there is a tangent line: the tangent subspace has dimension 1.
    pub verdict: Verdict,
    /// The kind.
    pub kind: Kind,
    /// Dimension of `D*`.
    pub dimension: Dimension,
    /// The tangent line, where it exists: in the direction of travel at the start of what follows, or at the end of what comes
    /// before, where that side has one ray.
    pub tangent: Option<Direction>,
    /// Rays on the left side (none at a left end or where they are not settled).
    pub left: Vec<Direction>,
    /// Rays on the right side.
    pub right: Vec<Direction>,
    /// Why the verdict is not `Proved`.
    pub reason: Option<PointGap>,
}

/// The hypotheses of Theorem 5 as found.
#[derive(Debug, Clone)]
pub struct DenseSet<E: Scalar = Rational> {
    /// For every piece of a reachable state: state, letter, and whether the operator is injective on the visible quotient of `V`.
    pub injective: Vec<(usize, usize, bool)>,
    /// Whether the control points (or the identity) are injective on the visible quotient of the start state.
    pub view_injective: bool,
    /// Indices, in [`Certified::points`], of the first-level joints of all reachable edge states.
    pub joints: Vec<usize>,
    /// For Theorem 5′: the same joints in the visible quotients `W_e` of their own states, before the control points.
    pub upstairs: Vec<PointReport<E>>,
    /// The frames of Theorems 11, 11′ and 11″, where Theorem 5 does not apply.
    pub frames: Option<Frames>,
}

/// What is known of the relevant space of one reachable state.
#[derive(Debug, Clone)]
pub struct StateReport<E = Rational> {
    /// Index of the state.
    pub state: usize,
    /// `dim V_e`.
    pub relevant: usize,
    /// Dimension of its visible quotient.
    pub visible: usize,
    /// The base point.
    pub base: Vec<E>,
    /// Radius of the 1-norm ball around the base point that holds the attractor.
    pub radius: Rational,
}

/// Everything `certify` found.
#[derive(Debug, Clone)]
pub struct Certified<E: Scalar = Rational> {
    /// The claims; the first is the main one.
    pub claims: Vec<Claim>,
    /// The verdict on the tangents examined, without what is claimed of every point and of the parameter; that of the
    /// certificate. [`Required`](super::Required) says which claims decide about a case.
    pub verdict: Verdict,
    /// Contraction.
    pub contraction: Contraction,
    /// The reachable states.
    pub states: Vec<StateReport<E>>,
    /// The examined points.
    pub points: Vec<PointReport<E>>,
    /// The evidence for the dense set; `None` for shapes that are no curves.
    pub dense: Option<DenseSet<E>>,
    /// Convex polygons by state (vertices in its barycentric space) that hold the attractors, where some ring proof uses them.
    pub polygons: Option<Vec<Vec<Vec<E>>>>,
    /// How the images of their vertices are combined, where that was found with them.
    pub polygon_weights: Option<HullWeights>,
    /// The scalar product for which all maps are similarities, where there is one.
    pub similarities: Option<super::similarity::Similarities<E>>,
    /// The cones that prove G¹ of a curve with entries in a number field.
    pub cones: Option<ConesOver<E>>,
    /// Order 1 of a curve with entries in a number field that is a graph over its parameter (Theorem 12), where no cones were found.
    pub graph: Option<Box<super::smoothness::CurveOrder<E>>>,
    /// What is known of every point of a curve (Theorem 6).
    pub everywhere: Option<super::everywhere::Everywhere>,
    /// What is known of a curve in its uniform parameter (Theorem E).
    pub parameter: Option<super::parameter::Parameter<E>>,
    /// What is found of a surface; the points are then listed there.
    pub surface: Option<super::surface::Surface>,
}

impl<E: Scalar> Certified<E> {
    /// The verdict on all claims about tangents together; undetermined where there are none.
    #[must_use]
    pub fn overall(&self) -> Verdict {
        let own: Vec<Verdict> = self.claims.iter().filter(|c| c.what.is_of_tangents()).map(Claim::verdict).collect();
        Verdict::all(own.len(), own)
    }

    /// The claim about the dense set of joints (Theorem 5 or 5′), where there is one.
    #[must_use]
    pub fn dense_claim(&self) -> Option<&Claim> {
        self.claims.iter().find(|c| c.what.is_of_dense_joints())
    }

    /// Nothing examined and nothing claimed yet.
    pub(super) fn nothing(contraction: &Contraction) -> Self {
        Self {
            claims: Vec::new(),
            verdict: Verdict::Undetermined,
            contraction: contraction.clone(),
            states: Vec::new(),
            points: Vec::new(),
            dense: None,
            polygons: None,
            polygon_weights: None,
            similarities: None,
            cones: None,
            graph: None,
            everywhere: None,
            parameter: None,
            surface: None,
        }
    }
}
