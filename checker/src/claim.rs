//! What a certificate may prove or refute, as data; sentences are made from it where it is shown.

use crate::base::{Q, Verdict, list};
pub use crate::curve::{Address, End, Place};
use std::fmt::{Display, Formatter, Result};

/// What a claim about a tangent line at an address is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The curve near the parameter with this address, to both sides where it has two.
    Curve,
    /// All of the set near the point: what is refuted of a branch, or what is proved of one to which everything near the point
    /// belongs, because its address has no prefix, different points are seen as different ones, and no piece of the ring is
    /// left out that collapses.
    Set,
    /// The germ of the branch with this address: what else comes near the point is not looked at.
    Branch,
}

/// At which joints a claim says that there are tangents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joints {
    /// Every joint of every level, which where it is proved (Theorems 5 and 11) are a dense set.
    All,
    /// Every joint of every level between pieces that are more than a point where they are looked at (Theorem 11).
    Seen,
    /// The joints listed, and every joint whose line before the projection is not killed, a dense set (Theorem 5′).
    NotKilled,
    /// Every joint whose line is not killed, a dense set, whatever holds at the joints listed (Theorems 5′ and 11′).
    OnlyNotKilled,
}

/// A claim; its letters, states and pieces are numbered as in the case.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Claim {
    /// The curve has a tangent line at both end points.
    TangentAtEnds,
    /// The curve has a tangent line at its joints.
    TangentAtJoints(Joints),
    /// There is a tangent line at the point with an address.
    TangentAt {
        /// The address, in its normal form.
        address: Address,
        /// What has it.
        of: Subject,
    },
    /// The curve is G¹: it has a tangent at every point, which turns continuously.
    TangentTurns {
        /// Every so many letters shrink cones by `(√D − 1)/(√D + 1)`, for this `D`.
        rate: Option<(usize, Q)>,
    },
    /// At every point both half-tangents exist.
    HalfTangents {
        /// Whether it is about the curve before the projection by the control points.
        projected: bool,
    },
    /// Some point has a tangent line.
    TangentSomewhere,
    /// A point of the list of points of a certificate has a tangent line.
    Point {
        /// Where it is.
        place: Place,
        /// Its kind, such as `cusp`.
        kind: &'static str,
    },
    /// At every vertex of the first subdivision the cells around it have together a tangent plane.
    PlaneAtVertices,
    /// The cells around the point with an address have together a tangent plane there.
    PlaneAt(Address),
    /// The germ of the branch with an address has a tangent plane.
    PlaneOfBranch(Address),
    /// The cells that meet in a point with these addresses have together a tangent plane there.
    PlaneOfCells(Vec<Address>),
    /// There is a tangent plane at a dense set of points, one inside every cell.
    PlaneDense {
        /// Whether it is about the surface before the projection by the control points.
        projected: bool,
    },
    /// The surface is G¹: immersed, with a tangent plane at every point, up to its border, which turns continuously.
    PlaneTurns,
    /// For almost all control points the surface is C¹ at vertices of this valence.
    SmoothAtVertex(usize),
    /// For almost all control points the surface has a tangent plane at vertices of this valence.
    PlaneAtVertex(usize),
    /// For the points of a mesh the surface of a scheme is C¹ at its vertices, and in the middles of faces that become vertices.
    MeshSmooth {
        /// The scheme.
        scheme: String,
        /// At so many of them.
        listed: usize,
        /// How many there are.
        all: usize,
    },
    /// The limit points and normals there are those that the certificate lists, but for small errors.
    MeshLimits {
        /// How many are listed.
        listed: usize,
        /// Points up to this power of 1/2 times the largest coordinate.
        points: u32,
        /// Normals up to this power of 1/2.
        normals: u32,
    },
    /// The limit surface of a mesh is a regular C¹ surface.
    MeshRegular {
        /// The scheme.
        scheme: String,
    },
    /// The joint spectral radius is at least the first and at most the second number.
    Radius(Q, Q),
    /// A diagonal block of a system of matrices has a joint spectral radius of at most a number.
    Block {
        /// Its dimensions, by state.
        dims: Vec<usize>,
        /// The kind of norm that shows it.
        norm: &'static str,
        /// The bound.
        bound: Q,
    },
    /// The curve is C^k in its parameter: the uniform one, or the one with the shares of the case.
    Smooth {
        /// `k`.
        order: usize,
    },
    /// The curve is a polynomial in its parameter.
    Polynomial,
    /// The supremum of the exponents `k + a` of the curve, with Hölder exponents `a` of the derivative of order `k`, is the
    /// logarithm of `1/r` to the base of the number of pieces, for a number `r` from `low` to `high`.
    Exponent {
        /// `k`.
        order: usize,
        /// The number of pieces.
        pieces: usize,
        /// The least `r`.
        low: Q,
        /// The greatest `r`.
        high: Q,
    },
    /// In a parameter with shares the supremum of the exponents `k + a` lies between two numbers.
    ExponentBetween {
        /// The lower one.
        low: Q,
        /// The upper one.
        high: Q,
    },
    /// All limits of a mask on a lattice are C^k; of order 0: the scheme converges uniformly.
    LatticeSmooth {
        /// `k`.
        order: usize,
    },
    /// All limits of a scheme with a border are C^k.
    BorderSmooth {
        /// `k`.
        order: usize,
    },
    /// All limits of a scheme with a border are C^k up to the border on either side.
    BorderSided {
        /// `k`.
        order: usize,
    },
    /// All limits of a mask on a lattice have the Hölder exponents below the logarithm of `1/J` to the base
    /// `index^(1/dimensions)`, for a number `J` from `low` to `high`.
    LatticeExponent {
        /// The number of dimensions.
        dimensions: usize,
        /// The determinant of the dilation, in modulus.
        index: usize,
        /// The least `J`.
        low: Q,
        /// The greatest `J`.
        high: Q,
        /// Whether this is the supremum of the exponents that all limits have.
        exact: bool,
    },
    /// Bounds of the joint spectral radius on the differences of derivatives of this order.
    RadiusOfOrder(usize, Q, Q),
    /// Each root of a polynomial (lowest coefficient first) is an eigenvalue of an operator (state and piece; none of a plain
    /// matrix) with Jordan blocks of these sizes.
    Jordan {
        /// The operator.
        operator: Option<(usize, usize)>,
        /// The polynomial.
        factor: Vec<Q>,
        /// The sizes, the largest first.
        blocks: Vec<usize>,
    },
    /// So many different eigenvalues of an operator have one modulus, the largest modulus first.
    Moduli {
        /// The operator.
        operator: Option<(usize, usize)>,
        /// The numbers.
        sizes: Vec<usize>,
    },
    /// For every value of a parameter in a part of its range the scheme has limits of an order of smoothness.
    Region {
        /// 0: the scheme converges; otherwise it does and its limits are `C^k`.
        order: usize,
        /// The parameter.
        parameter: String,
        /// The lower end of an open interval, or the point.
        from: Real,
        /// The upper end; the same for a point.
        to: Real,
    },
    /// A curve has a property for every value of a parameter in an interval, or for one value.
    CurveRegion {
        /// The property.
        what: CurveRegion,
        /// The parameter.
        parameter: String,
        /// The lower end of an open interval, or the point.
        from: Real,
        /// The upper end; the same for a point.
        to: Real,
    },
    /// The unknown entries have values that satisfy all equations.
    Solvable {
        /// The number of unknowns.
        unknowns: usize,
        /// The number of matrix equations.
        equations: usize,
        /// The number of parameters of the solutions; 0 where there is one. `None` where there is no solution.
        free: Option<usize>,
        /// The equations, by number, that contradict each other.
        conflict: Vec<usize>,
    },
}

/// A real number: the only root of a polynomial (lowest coefficient first) in an interval.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Real {
    /// The polynomial.
    pub polynomial: Vec<Q>,
    /// The interval; both ends are the number where that is rational.
    pub interval: [Q; 2],
}

impl Display for Real {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [lo, hi] = &self.interval;
        if lo == hi {
            return write!(f, "{lo}");
        }
        // Towards 0, to twelve digits.
        let scale = crate::base::whole(1_000_000_000_000);
        let near = (lo * &scale).to_integer();
        write!(f, "the root of {} near {}", polynomial(&self.polynomial), Q::from(near) / scale)
    }
}

/// A claim with what was found about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decided {
    /// The claim.
    pub claim: Claim,
    /// Whether it is proved, refuted, or neither.
    pub verdict: Verdict,
}

impl Claim {
    /// The claim with a verdict.
    pub fn is(self, verdict: Verdict) -> Decided {
        Decided { claim: self, verdict }
    }
}

impl Display for Decided {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let (word, refuted) = (self.verdict.word(), self.verdict == Verdict::Refuted);
        match &self.claim {
            // The order of words is that of what is known.
            Claim::Solvable { conflict, .. } if refuted => {
                let listed = list(conflict);
                write!(f, "{word}: {}; the equations {listed} contradict each other", self.claim)
            }
            Claim::Region { order, parameter, from, to } => {
                let part = if from == to { format!("at {from}") } else { format!("strictly between {from} and {to}") };
                write!(f, "{word} for every {parameter} {part}: {}", region(*order))
            }
            Claim::CurveRegion { what, parameter, from, to } => {
                let part = if from == to { format!("at {from}") } else { format!("strictly between {from} and {to}") };
                write!(f, "{word} for every {parameter} {part}: {what}")
            }
            Claim::Point { place, kind } => write!(f, "{word}: {place}, {kind}"),
            claim => write!(f, "{word}: {claim}"),
        }
    }
}

/// What is claimed of a curve at one value of its parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveRegion {
    /// The system contracts.
    Contraction,
    /// It has a tangent line at both ends.
    Ends,
    /// It has a tangent line at every joint of every level.
    Joints,
    /// It is G¹.
    G1,
}

impl CurveRegion {
    /// In the order of a certificate.
    pub const ALL: [Self; 4] = [Self::Contraction, Self::Ends, Self::Joints, Self::G1];
}

impl Display for CurveRegion {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::Contraction => "the system contracts",
            Self::Ends => "the curve has a tangent line at both ends",
            Self::Joints => "the curve has a tangent line at every joint of every level, a dense set",
            Self::G1 => "the curve is G1: it has a tangent at every point, which turns continuously",
        })
    }
}

/// What is claimed of a scheme at one value of its parameter.
fn region(order: usize) -> String {
    match order {
        0 => "the scheme converges uniformly for all control points".to_owned(),
        k => format!("the scheme converges and all its limits are C^{k} in the uniform parameter"),
    }
}

/// What stands before a claim about an operator.
fn of(operator: Option<(usize, usize)>) -> String {
    match operator {
        None => "the matrix".to_owned(),
        Some((state, piece)) => format!("operator {piece} of state {state}"),
    }
}

/// A polynomial with its highest power first.
fn polynomial(p: &[Q]) -> String {
    let mut text = String::new();
    for (k, c) in p.iter().enumerate().rev().filter(|(_, c)| **c != crate::base::whole(0)) {
        let negative = *c < crate::base::whole(0);
        let size = if negative { -c } else { c.clone() };
        text += match (text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let power = match k {
            0 => String::new(),
            1 => "x".to_owned(),
            _ => format!("x^{k}"),
        };
        let one = size == crate::base::whole(1) && k > 0;
        text += &match (one, k, size.is_integer()) {
            (true, ..) => power,
            (_, 0, _) => size.to_string(),
            (_, _, true) => format!("{size}{power}"),
            _ => format!("({size}){power}"),
        };
    }
    text
}

impl Display for Claim {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let curve = |projected: &bool| if *projected { "the curve before the projection" } else { "the curve" };
        match self {
            Self::TangentAtEnds => f.write_str("the curve has a tangent line at both end points"),
            Self::TangentAtJoints(Joints::All) => {
                f.write_str("the curve has a tangent line at every joint of every level")
            }
            Self::TangentAtJoints(Joints::Seen) => f.write_str(
                "the curve has a tangent line at every joint of every level between pieces that are more than a point where they \
                 are looked at",
            ),
            Self::TangentAtJoints(Joints::NotKilled) => f.write_str(
                "the curve has a tangent line at the joints listed and at every joint whose line the projection does not kill, \
                 a dense set",
            ),
            Self::TangentAtJoints(Joints::OnlyNotKilled) => f.write_str(
                "the curve has a tangent line at every joint whose line the projection does not kill, a dense set",
            ),
            Self::TangentAt { address, of: Subject::Curve } => {
                write!(f, "the curve has a tangent line at the parameter {address}")
            }
            Self::TangentAt { address, of: Subject::Set } => {
                write!(f, "the set has a tangent line at the point {address}")
            }
            Self::TangentAt { address, of: Subject::Branch } => {
                write!(f, "the germ of the branch {address} has a tangent line")
            }
            Self::TangentTurns { rate } => {
                f.write_str("the curve is G¹: it has a tangent at every point, which turns continuously")?;
                match rate {
                    None => Ok(()),
                    Some((length, d)) => {
                        write!(f, " (cones shrink by (√D − 1)/(√D + 1) with every {length} letters, D = {d})")
                    }
                }
            }
            Self::HalfTangents { projected } => {
                write!(f, "both half-tangents of {} exist at every point", curve(projected))
            }
            Self::TangentSomewhere => f.write_str("some point of the shape has a tangent line"),
            Self::Point { place, kind } => write!(f, "a tangent line at {place} ({kind})"),
            Self::PlaneAtVertices => {
                f.write_str("at every vertex of the first subdivision the cells around it have together a tangent plane")
            }
            Self::PlaneAt(address) => {
                write!(f, "the cells around the point {address} have together a tangent plane there")
            }
            Self::PlaneOfBranch(address) => write!(f, "the germ of the branch {address} has a tangent plane"),
            Self::PlaneOfCells(addresses) => {
                let names: Vec<String> = addresses.iter().map(Address::to_string).collect();
                write!(f, "the cells at the point {} have together a tangent plane", names.join(" = "))
            }
            Self::PlaneDense { projected: false } => {
                f.write_str("the surface has a tangent plane at a dense set of points, one inside every cell")
            }
            Self::PlaneDense { projected: true } => f.write_str(
                "before the projection the surface has a tangent plane at a point inside every cell, and the projection has \
                 one where it does not fold that plane",
            ),
            Self::PlaneTurns => f.write_str(
                "the surface is G¹: immersed, with a tangent plane at every point, up to its border, which turns continuously",
            ),
            Self::SmoothAtVertex(n) => {
                write!(f, "for almost all control points the surface is C¹ at a vertex of valence {n}")
            }
            Self::PlaneAtVertex(n) => {
                write!(f, "for almost all control points it has a tangent plane at a vertex of valence {n}")
            }
            Self::MeshSmooth { scheme, listed, all } if listed == all => {
                write!(f, "the surface of this mesh by {scheme} is C¹ at every vertex, for these points")
            }
            Self::MeshSmooth { scheme, listed, all } => write!(
                f,
                "the surface of this mesh by {scheme} is C¹ at {listed} of its {all} vertices, those with a limit in the certificate, \
                 for these points"
            ),
            Self::MeshLimits { listed, points, normals } => write!(
                f,
                "{listed} limit points, up to 2^-{points} of the largest coordinate, and unit normals, up to 2^-{normals}, are those \
                 of the certificate"
            ),
            Self::MeshRegular { scheme } => write!(
                f,
                "the limit surface of this mesh by {scheme} is a regular C¹ surface, immersed by its parametrisation"
            ),
            Self::Radius(low, high) if low == high => write!(f, "the joint spectral radius is {low}"),
            Self::Radius(low, high) => write!(f, "the joint spectral radius is at least {low} and at most {high}"),
            Self::Block { dims, norm, bound } => {
                write!(f, "block of dimensions {}: at most {bound}, by a norm of the kind {norm}", list(dims))
            }
            Self::Smooth { order } => write!(f, "the curve is C^{order} in its parameter"),
            Self::Polynomial => f.write_str("the curve is a polynomial in its parameter"),
            Self::ExponentBetween { low, high } => write!(
                f,
                "the supremum of its exponents k + a, with Hölder exponents a of the derivative of order k, lies from {low} to {high}"
            ),
            Self::Exponent { order, pieces, low, high } => write!(
                f,
                "the supremum of its exponents k + a, with Hölder exponents a of the derivative of order k = {order}, is the \
                 logarithm of 1/r to the base {pieces}, at least {order} and at most {}, for a number r from {low} to {high}",
                order + 1
            ),
            Self::LatticeSmooth { order: 0 } => f.write_str("the scheme converges uniformly for all bounded nets"),
            Self::LatticeSmooth { order } => write!(f, "all limits of the scheme are C^{order}"),
            Self::BorderSmooth { order: 0 } => f.write_str("all limits of the scheme exist and are continuous"),
            Self::BorderSmooth { order } => write!(f, "all limits of the scheme are C^{order}, also across its border"),
            Self::BorderSided { order } => {
                write!(f, "all limits of the scheme are C^{order} up to its border, on either side")
            }
            Self::LatticeExponent { dimensions, index, low, high, exact } => {
                let what = if *exact {
                    "the supremum of the exponents that all limits have is"
                } else {
                    "the exponents that all limits have reach up to at least"
                };
                write!(f, "{what} {dimensions} times the logarithm of 1/J to the base {index}, for a number J from {low} to {high}")
            }
            Self::RadiusOfOrder(order, low, high) => write!(
                f,
                "the joint spectral radius on the differences of derivatives of order {order} is at least {low} and at most \
                 {high}"
            ),
            Self::Jordan { operator, factor, blocks } => {
                let (of, p) = (of(*operator), polynomial(factor));
                write!(f, "{of}: each root of {p} has Jordan blocks of the sizes {}", list(blocks))
            }
            Self::Moduli { operator, sizes } => {
                write!(f, "{}: different eigenvalues by modulus, the largest first: {}", of(*operator), list(sizes))
            }
            Self::Region { order, parameter, from, to } => {
                write!(f, "for every {parameter} from {from} to {to}, the ends left out: {}", region(*order))
            }
            Self::CurveRegion { what, parameter, from, to } => {
                write!(f, "for every {parameter} from {from} to {to}, the ends left out: {what}")
            }
            Self::Solvable { unknowns, equations, free, .. } => {
                let what = "values that satisfy";
                write!(f, "the {unknowns} unknowns have {what} {equations} matrix equations")?;
                match free {
                    None => Ok(()),
                    Some(0) => f.write_str("; they are determined"),
                    Some(k) => write!(f, "; they form a family of {k} parameters"),
                }
            }
        }
    }
}
