//! The words of claims and of the reasons why they are refuted or open: the only place where they are written.

use super::reasons::{self, UNKNOWN};
use super::reported::Reported;
use super::vertex_reasons;
use crate::case::Case;
use crate::shape::word_text;
use crate::theorem::surface::{Surface, SurfacePoint};
use crate::theorem::{
    About, AboutPlane, Assertion, Certified, Claim, Limit, Measure, Parameter, PointReport, Reason, Role, Seen, Topic,
    Verdict,
};
use crate::vertex::AtValence;

/// What is claimed, as a sentence without a capital and a full stop.
#[must_use]
pub fn assertion(what: &Assertion) -> String {
    let text = match what {
        Assertion::Tangents => "the shape has tangents",
        Assertion::TangentAtEnds => "the curve has a tangent line at both end points",
        Assertion::TangentDense => "the curve has a tangent at a dense set of points",
        Assertion::DenseJoints => "the curve has a tangent line at every joint of every level, a dense set",
        Assertion::ExaminedJoints => "the curve has a tangent line at each of the joints examined below",
        Assertion::ProjectedJoints => {
            "the projected curve has a tangent line at every joint whose tangent line before the projection is not killed by it; \
             in every cell that is more than a point there are such joints"
        }
        Assertion::SeenJoints => {
            "the curve has a tangent line at every joint of every level between pieces that are more than a point where it is \
             looked at; these are dense in every cell that is more than a point"
        }
        Assertion::UnkilledJoints => {
            "the curve has a tangent line at every joint whose tangent line is not killed on the way to where it is looked at; \
             in every cell that is more than a point there are such joints"
        }
        Assertion::TangentAt { address, about, .. } => {
            return match about {
                About::Branch => format!(
                    "the germ of the branch {address} has a tangent line (other addresses of the same point are not looked at)"
                ),
                About::Shape => format!("the shape has a tangent line at the address {address}"),
                About::Curve => format!("the parametrised curve has a tangent line at the address {address}"),
            };
        }
        Assertion::SomePoint => "some point of the shape has a tangent line",
        Assertion::G1 => "the curve is G¹: it has a tangent at every point, which turns continuously",
        Assertion::Smooth { order, over } => return format!("the curve is C^{order} in {}", parameter(*over)),
        Assertion::Polynomial(over) => {
            return format!("the curve is a polynomial in {}, C^k for all k", parameter(*over));
        }
        Assertion::Exponent(bounds, over) => {
            let exponents = format!("the Hölder exponents of the curve in {} have", parameter(*over));
            return match bounds {
                Some(b) => format!("{exponents} the supremum {}", super::radius::interval(b)),
                None => format!("{exponents} a bound"),
            };
        }
        Assertion::PlaneAtVertices => {
            "the surface has a tangent plane at every vertex of its first subdivision (corners, sides, inside)"
        }
        Assertion::DensePlanes { seen } => match seen {
            Seen::Injective => {
                "the surface has a tangent plane at a dense set of points: at the image of a vertex inside every cell"
            }
            Seen::Projected => {
                "the surface has a tangent plane at the image of the vertex inside a cell wherever the control points do not fold \
                 the plane before the projection"
            }
            Seen::Everywhere => {
                "the surface has a tangent plane at the image of the vertex inside a cell wherever the control points do not fold \
                 the plane before the projection; every cell contains such a vertex, so that they are dense"
            }
        },
        Assertion::PlaneEverywhere => {
            "the surface is G¹: immersed, with a tangent plane at every point, up to its border, which turns continuously"
        }
        Assertion::PlaneAt { address, about, .. } => {
            return match about {
                AboutPlane::Surface => format!("the parametrised surface has a tangent plane at the address {address}"),
                AboutPlane::Crowded => {
                    format!("the germ of the branch {address} has a tangent plane (too many cells meet there)")
                }
                AboutPlane::Branch => format!(
                    "the germ of the branch {address} has a tangent plane (other addresses of the same point are not looked at)"
                ),
            };
        }
        Assertion::C1AtVertex { valence } => {
            return format!("for almost all control points the surface is C¹ at a vertex of valence {valence}");
        }
        Assertion::C1AtBorder { faces, smooth } => {
            return format!(
                "for almost all control points the surface is C¹ up to its border at {}",
                super::words::on_border(*smooth, &super::words::count(*faces, "face"))
            );
        }
        Assertion::PlaneAtVertex { valence } => {
            return format!(
                "for almost all control points the surface has a tangent plane at a vertex of valence {valence}"
            );
        }
        Assertion::C1AtVertices { from } => {
            return format!(
                "for almost all control points the surface is C¹ at the vertices of every valence from {from} on"
            );
        }
    };
    text.to_owned()
}

/// The parameter, in words.
#[must_use]
pub fn parameter(over: Measure) -> &'static str {
    match over {
        Measure::Uniform => "the uniform parameter",
        Measure::Shares => "the parameter with the given shares",
    }
}

/// What a claim is about, in the first column of a table: `ends`, `every point (G¹)`, `C²`.
#[must_use]
pub fn label(what: &Assertion) -> String {
    match (what, what.topic()) {
        (Assertion::PlaneAtVertices, _) => "vertices".to_owned(),
        (Assertion::SomePoint, _) => "some point".to_owned(),
        (Assertion::DenseJoints | Assertion::SeenJoints, _) => "joints (dense)".to_owned(),
        (Assertion::C1AtVertex { valence } | Assertion::PlaneAtVertex { valence }, _) => format!("valence {valence}"),
        (Assertion::C1AtBorder { faces, .. }, _) => super::words::count(*faces, "face"),
        (Assertion::C1AtVertices { from }, _) => format!("valences from {from}"),
        (_, None) => "tangents".to_owned(),
        (_, Some(Topic::Ends)) => "ends".to_owned(),
        (_, Some(Topic::Joints)) => "joints".to_owned(),
        (_, Some(Topic::Dense)) => "dense set".to_owned(),
        (_, Some(Topic::G1 | Topic::Inside)) => "every point (G¹)".to_owned(),
        (_, Some(Topic::Polynomial)) => "C^k for all k".to_owned(),
        (_, Some(Topic::C(order))) => format!("C^{order}"),
        (_, Some(Topic::Exponent)) => "Hölder exponent".to_owned(),
        (_, Some(Topic::Points)) => match what.asked() {
            Some((address, _)) => format!("point {address}"),
            None => "points".to_owned(),
        },
    }
}

/// A claim with its verdict, as a sentence that follows a mark: "it is false that …", "whether …".
#[must_use]
pub fn judged(claim: &Claim) -> String {
    let text = assertion(&claim.what);
    match claim.verdict() {
        Verdict::Proved => text,
        Verdict::Refuted => format!("it is false that {text}"),
        Verdict::Undetermined => format!("whether {text}"),
    }
}

/// Why a claim is refuted or open; `None` where it is proved.
#[must_use]
pub fn reason<E: Reported>(case: &Case<E>, found: &Certified<E>, claim: &Claim) -> Option<String> {
    claim.reason().map(|reason| sentence(case, found, claim.verdict(), reason))
}

/// A limit that ended a search, and what goes on beyond it.
#[must_use]
pub fn limit(limit: &Limit) -> String {
    let ended = match limit {
        Limit::Words => "the search for contracting words ended at its limit".to_owned(),
        Limit::Cells { branch, cell } => {
            format!("the search in the ring of the branch {branch} ended at the cell {}", word_text(cell))
        }
    };
    format!("{ended} (--{name}; --effort hard takes eight times as many {name})", name = limit.name())
}

/// The same of a claim about the vertices of a mesh.
#[must_use]
pub fn reason_at_vertices(found: &[AtValence], claim: &Claim) -> Option<String> {
    let said =
        |n: usize| found.iter().find(|f| f.valence == n).map_or_else(unknown, |f| vertex_reasons::reason(&f.reason));
    claim.reason().map(|reason| match reason {
        Reason::Valence(n) => said(*n),
        Reason::Conditions => "a condition of the proof for all valences is not shown to hold".to_owned(),
        _ => unknown(),
    })
}

fn sentence<E: Reported>(case: &Case<E>, found: &Certified<E>, verdict: Verdict, reason: &Reason) -> String {
    let refuted = verdict == Verdict::Refuted;
    let either = |no: &str, open: &str| if refuted { no.to_owned() } else { open.to_owned() };
    match reason {
        Reason::Contraction { length, open } => {
            format!("contraction is not decided: {open} words of length {length} are left")
        }
        Reason::NotEnclosed { radius, length, open } => format!(
            "the system contracts (the joint spectral radius of its linear parts is at most {}), but the 1-norm does not show it: \
             {open} words of length {length} are left, and without them the attractor is not enclosed",
            super::radius::decimal(radius, true, 6)
        ),
        Reason::SinglePoint => "the attractor is a single point".to_owned(),
        Reason::Unexamined => "a point that belongs to the claim could not be examined".to_owned(),
        Reason::End(index) => match found.points.get(*index) {
            Some(point) => {
                let side = if point.role == Role::LeftEnd { "left" } else { "right" };
                format!("{side} end: {}", of_point(point))
            }
            None => unknown(),
        },
        Reason::Point(index) => found.points.get(*index).map_or_else(unknown, of_point),
        Reason::NoJoint => "no joint between pieces that are more than a point".to_owned(),
        Reason::FirstJoint(_) => either("a first-level joint has no tangent", "a first-level joint is not decided"),
        Reason::Joint(_) => either("a joint of a deeper level has no tangent", "a joint is not decided"),
        Reason::NotInjective { .. } => {
            "an operator is not injective on the relevant space: only the joints listed were examined".to_owned()
        }
        Reason::BeforeProjection { .. } => {
            "the projection is not injective, and before it a first-level joint is not proved".to_owned()
        }
        Reason::NoSpan => {
            "the projection is not injective, and the tangent lines at the joints were not seen to span the \
                           relevant space"
                .to_owned()
        }
        Reason::Similarities => {
            "all maps are similarities of a plane: the tangent subspace is the plane at every point".to_owned()
        }
        Reason::Broken(index) => found.points.get(*index).map_or_else(unknown, reasons::broken),
        Reason::NoCone => {
            "no common cone was found, nor a derivative that shows it; with entries in a number field nothing else is looked for"
                .to_owned()
        }
        Reason::EveryPoint | Reason::InsidePoint => E::every_sentence(found).unwrap_or_else(unknown),
        Reason::Order(order) => match &found.parameter {
            Some(Parameter::Orders(orders)) => {
                orders.orders.get(*order).and_then(|o| super::regularity::outcome(&case.shape, o))
            }
            _ => None,
        }
        .unwrap_or_else(|| "no bounds of its joint spectral radius are known".to_owned()),
        Reason::NoOrder => match &found.parameter {
            Some(Parameter::None(error)) => error.to_string(),
            Some(Parameter::Large(size)) => {
                format!("the visible quotients have {size} coordinates together; `secant regularity` goes on beyond 24")
            }
            _ => unknown(),
        },
        Reason::EverySurfacePoint => found.surface.as_ref().and_then(reasons::every_surface).unwrap_or_else(unknown),
        Reason::TooManyCells => "there are too many cells around a vertex".to_owned(),
        Reason::SurfaceNotInjective { .. } => "an operator is not injective on the visible relevant space".to_owned(),
        Reason::SurfacePoint(_) | Reason::SurfaceVertex(_) | Reason::VertexInside(_) => {
            found.surface.as_ref().map_or_else(unknown, |surface| of_surface(case, surface, reason))
        }
        Reason::Valence(_) | Reason::Conditions => unknown(),
    }
}

fn of_surface<E>(case: &Case<E>, surface: &Surface, reason: &Reason) -> String {
    let said = |point: &SurfacePoint| reasons::plane(point).unwrap_or_else(unknown);
    match reason {
        Reason::SurfacePoint(index) => surface.points.get(*index).map_or_else(unknown, said),
        Reason::SurfaceVertex(index) => match surface.points.get(*index).map(|p| (p, p.branches.first())) {
            Some((point, Some(branch))) => format!("at {}: {}", branch.address, said(point)),
            _ => unknown(),
        },
        Reason::VertexInside(index) => match surface.dense.as_ref().and_then(|d| d.vertices.get(*index)) {
            Some((state, point)) => {
                let name = &case.shape.states[*state].name;
                format!("at the vertices inside state `{name}`: {}", said(point))
            }
            None => unknown(),
        },
        _ => unknown(),
    }
}

fn of_point<E: Reported>(point: &PointReport<E>) -> String {
    reasons::point(point).unwrap_or(UNKNOWN).to_owned()
}

fn unknown() -> String {
    UNKNOWN.to_owned()
}
