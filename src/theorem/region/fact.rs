//! What arguments about a curve decide, and what they rest on.

use super::signs::Signs;
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::poly::Poly;

/// What is claimed of a curve that contracts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CurveClaim {
    /// A tangent line at both ends.
    Ends,
    /// A tangent line at every joint of every level.
    Joints,
    /// A tangent at every point, which turns continuously.
    G1,
}

impl CurveClaim {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Ends, Self::Joints, Self::G1];
}

/// Why a claim holds or fails.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Why {
    /// Secants lie in an invariant cone on which the leading coefficient at the ends is not negative.
    InCone,
    /// Common cones (Theorem 6, or 6′ where some coefficients are 0) and regular joints.
    Cones {
        /// Whether some coefficients are 0.
        slow: bool,
    },
    /// The lines of the two sides of the joint behind this piece differ.
    Corner(usize),
    /// The leading eigenvalues of an end are a pair that is not real.
    Spiral(CurveEnd),
    /// The leading eigenvalue of an end is negative: there are two rays.
    Alternates(CurveEnd),
    /// The rays of both sides of the joint behind this piece agree.
    Cusp(usize),
    /// The tangents of a joint do not tend to the only line that a tangent at this cycle can have.
    Jumps(Vec<usize>),
    /// All pieces lie on the line of the chord and go forwards.
    Segment,
    /// The leading coefficients are positive on cells that cover the rings of the ends.
    Cells {
        /// Whether a block of length 2 leads.
        longer: bool,
    },
    /// The leading coefficient changes its sign on the ring of an end, which is isolated.
    SignChange(CurveEnd),
}

/// An end of the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveEnd {
    /// The start.
    Start,
    /// The end.
    Finish,
}

/// A claim that is decided at a value, and as long as none of some polynomials vanishes.
#[derive(Debug, Clone)]
pub struct Fact<P = Poly> {
    /// The claim.
    pub claim: CurveClaim,
    /// The verdict.
    pub verdict: Verdict,
    /// Why.
    pub why: Why,
    /// The polynomials.
    pub guards: Vec<P>,
    /// What a checker needs.
    pub evidence: Evidence<P>,
}

/// What is chosen in an argument; everything else follows from the family.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Evidence<P = Poly> {
    /// Words whose images of the chord are independent.
    pub span: Vec<Vec<usize>>,
    /// The leading eigenvalues at the start and at the end, where they are polynomials.
    pub values: [Option<P>; 2],
    /// The rays of the cone.
    pub rays: Vec<Vec<P>>,
    /// The length of words in which factors with positive products are looked for; 0 where none are.
    pub window: usize,
    /// Cycles with their leading eigenvalues: of addresses without such factors, or the one at which tangents jump.
    pub cycles: Vec<(Vec<usize>, P)>,
    /// The joint and the side of it (0: left) whose tangents jump.
    pub place: Option<(usize, usize)>,
    /// Whether it rests on a longer Jordan chain, on cells, or on less than the space of all differences, for which certificates of
    /// regions have no form.
    pub beyond: bool,
}

impl<P> Default for Evidence<P> {
    fn default() -> Self {
        let (span, rays, cycles) = (Vec::new(), Vec::new(), Vec::new());
        Self { span, values: [None, None], rays, window: 0, cycles, place: None, beyond: false }
    }
}

impl<P: Symbol> Fact<P> {
    /// A claim that is decided with the signs that were asked for.
    pub(super) fn of(at: &impl Signs<P>, claim: CurveClaim, verdict: Verdict, why: Why) -> Option<Self> {
        at.kept().map(|guards| Self { claim, verdict, why, guards, evidence: Evidence::default() })
    }
}
