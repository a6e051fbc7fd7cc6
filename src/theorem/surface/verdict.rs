//! What is found at the points of a surface.

use super::place::{Param, Spot};
use super::span::Subspace;
use crate::arith::Rational;
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::shape::{Address, Contraction, Shape};
use crate::theorem::{
    BranchGap, Dimension, Discharged, NoChart, PlaneGap, PointReport, RingPiece, RingProof, Statement, TopRow, Verdict,
    Witness,
};

/// A proof that a pair of functionals has a common zero on a cell of the ring: the image of its boundary winds around 0.
#[derive(Debug, Clone)]
pub struct Winding {
    /// The cell, as a word from the branch's state.
    pub cell: Vec<usize>,
    /// The winding number, not 0.
    pub number: i32,
    /// Cells along the boundary, in cyclic order, each with a functional (0 or 1) that has a strict sign on it; neighbours
    /// meet.
    pub path: Vec<Discharged>,
}

/// Why the leading functionals have a zero on the ring.
#[derive(Debug, Clone)]
pub enum SurfaceWitness {
    /// Points of the ring, by address from the branch's state, at which all of them vanish exactly, with `x` in coordinates of `Y`.
    Points(Vec<(Address, Vec<Rational>)>),
    /// A change of sign of the only functional on one piece of the ring, which is connected.
    SignChange(Witness),
    /// A closed path that winds around 0.
    Winding(Winding),
}

/// What follows at one branch of a surface.
#[derive(Debug, Clone)]
pub struct SurfaceOutcome {
    /// The statement applied.
    pub statement: Option<Statement>,
    /// The row of the table of theory §5 that describes the top of the spectrum.
    pub row: TopRow,
    /// A subspace that `D*` is proved to contain, in the space where the surface is looked at.
    pub contains: Subspace,
    /// The dimension of `D*`; where it is exact, `D*` is the subspace above.
    pub dimension: Dimension,
    /// An upper bound of the dimension, where one is proved.
    pub at_most: Option<usize>,
    /// The proof of the ring condition of the leading functionals, where it holds.
    pub ring: Option<RingProof>,
    /// The proof that the branch is isolated, where the ring condition does not show it.
    pub isolation: Option<RingProof>,
    /// The depth `i` and the proof of `0 ∉ π_i(X)`, where the leading functionals do have a zero.
    pub depth: Option<(usize, RingProof)>,
    /// Why the leading functionals have a zero on the ring, where they do.
    pub witness: Option<SurfaceWitness>,
    /// What is not decided, and the smallest cell in which it failed.
    pub open: Option<(BranchGap, Option<Vec<usize>>)>,
}

/// One branch `u w^ω` of a point of a surface, and all that was computed for it.
#[derive(Debug, Clone)]
pub struct SurfaceBranch {
    /// Its address from the start state.
    pub address: Address,
    /// The state of the cycle.
    pub state: usize,
    /// `M = T_w`.
    pub cycle_operator: Matrix,
    /// The fixed point `q` of `M`.
    pub fixed: Vec<Rational>,
    /// `G = P T_u`, from the state's space to the space where the surface is looked at.
    pub transport: Matrix,
    /// Dimension of `V`, the relevant space of the state.
    pub relevant: usize,
    /// Coordinates on the visible quotient `Y = V/N_G`: `Y`-coordinates of `x` are `chart (x − q)`.
    pub chart: Matrix,
    /// `L` on `Y`.
    pub linear: Matrix,
    /// `G` on `Y`.
    pub view: Matrix,
    /// The spectrum of `L` on `Y`.
    pub spectrum: Spectrum,
    /// The ring.
    pub ring: Vec<RingPiece>,
    /// What follows.
    pub outcome: SurfaceOutcome,
}

/// What the theorem on tensor products says at a point.
#[derive(Debug, Clone)]
pub struct ProductEvidence {
    /// The first curve at its parameter.
    pub first: PointReport,
    /// The second curve.
    pub second: PointReport,
    /// The verdict that follows.
    pub verdict: Verdict,
    /// `D*_a ⊗ b(t) + a(s) ⊗ D*_b`, where both curves are differentiable.
    pub tangent: Option<Subspace>,
}

/// One of the curves that a surface is the product of, and why it contracts.
#[derive(Debug, Clone)]
pub struct ProductFactor {
    /// The curve.
    pub shape: Shape,
    /// Why it contracts.
    pub contraction: Contraction,
    /// Radii of balls that hold it.
    pub states: Vec<(usize, Rational)>,
    /// Convex polygons that hold it, where they were made.
    pub polygons: Option<Vec<Vec<Vec<Rational>>>>,
}

/// One examined point of a surface.
#[derive(Debug, Clone)]
pub struct SurfacePoint {
    /// Where it lies.
    pub spot: Spot,
    /// Its parameters in the patch of the start state.
    pub parameter: Option<Param>,
    /// The point in the barycentric space of the start state.
    pub position: Vec<Rational>,
    /// Its image under the control points.
    pub image: Option<Vec<Rational>>,
    /// Its branches: one in each incident cell.
    pub branches: Vec<SurfaceBranch>,
    /// Whether the surface is differentiable of dimension 2 there.
    pub verdict: Verdict,
    /// Dimension of `D*`.
    pub dimension: Dimension,
    /// `D*`, where it is known exactly.
    pub tangent: Option<Subspace>,
    /// The theorem on tensor products, for surfaces that are one.
    pub product: Option<ProductEvidence>,
    /// The statement that gives the verdict.
    pub statement: Option<Statement>,
    /// Why the verdict is not `Proved`.
    pub reason: Option<PlaneGap>,
}

/// The hypotheses of Theorem 5″ as found.
#[derive(Debug, Clone)]
pub struct SurfaceDense {
    /// For every piece of a reachable state: state, letter, and whether the operator is injective on the visible quotient.
    pub injective: Vec<(usize, usize, bool)>,
    /// Whether the control points (or the identity) are injective on the visible quotient of the start state.
    pub view_injective: bool,
    /// For every reachable face a vertex inside it, in the visible quotient `W_e` of its own state.
    pub vertices: Vec<(usize, SurfacePoint)>,
    /// Whether every cell is shown to contain a vertex whose plane the control points do not fold.
    pub everywhere: bool,
    /// The invariant family of bivectors that shows it where the control points are not injective.
    pub bivectors: Option<Bivectors>,
}

/// An invariant family of spaces of bivectors of the visible quotients, all of one dimension, that the control points do not
/// kill (Theorem 5″).
#[derive(Debug, Clone)]
pub struct Bivectors {
    /// The dimension of each.
    pub dimension: usize,
    /// A basis of the one of the start state, by rows: minors in lexicographic order of the pairs of coordinates.
    pub start: Matrix,
    /// The image of each row under the control points.
    pub seen: Matrix,
}

/// What is found of a surface.
#[derive(Debug, Clone)]
pub struct Surface {
    /// The examined points.
    pub points: Vec<SurfacePoint>,
    /// The evidence for the dense set.
    pub dense: Option<SurfaceDense>,
    /// The curves that it is the product of, where it is one.
    pub factors: Option<[ProductFactor; 2]>,
    /// Why the parameters of the surface are not used, where they are not.
    pub unparametrised: Option<NoChart>,
    /// Whether cells were enclosed by the simplex of the coordinates instead of balls: all operators are nonnegative.
    pub simplex: bool,
    /// Whether it is G¹, and why.
    pub every: super::every::EverySurface,
}
