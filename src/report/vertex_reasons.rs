//! The words of what was found at vertices of meshes and why.

use crate::scheme::SchemeError;
use crate::vertex::{BorderGround, Requirement, VertexReason};

/// What a verdict at one valence rests on, or what is missing.
#[must_use]
pub fn reason(reason: &VertexReason) -> String {
    match reason {
        VertexReason::Unexamined => String::new(),
        VertexReason::Block(SchemeError::Mesh { message, .. }) => message.clone(),
        VertexReason::Block(SchemeError::Asymmetric { .. }) => {
            "the weights have no mirror symmetry, and the eigenvalues are not real".to_owned()
        }
        VertexReason::Block(error) => error.to_string(),
        VertexReason::NoSecond => "there is no second eigenvalue".to_owned(),
        VertexReason::Close(all) => {
            let list: Vec<String> = all.iter().map(|(re, block)| format!("{re:.6} (block {block})")).collect();
            format!("the largest eigenvalues have nearly equal moduli and were not separated: {}", list.join(", "))
        }
        VertexReason::RegularRule => {
            "whether the scheme converges away from the vertex is not known: no bounds of its \
             regular rule were found (Lemma 4)"
                .to_owned()
        }
        VertexReason::NoLimit => {
            "besides 1, counted once, an eigenvalue has modulus 1 or more: for almost all control \
             points the rings do not shrink to a point (Rings that do not shrink)"
                .to_owned()
        }
        VertexReason::LimitOpen => {
            "besides 1, counted once, an eigenvalue is not proved to be smaller than 1 in modulus".to_owned()
        }
        VertexReason::Border(ground) => border(*ground).to_owned(),
        VertexReason::BorderOpen => "the signs of the characteristic map were not decided everywhere".to_owned(),
        VertexReason::Span { .. }
        | VertexReason::Sectors
        | VertexReason::TwoFaces
        | VertexReason::Uncovered { .. }
        | VertexReason::Line { .. }
        | VertexReason::Path { .. }
        | VertexReason::LineZero { .. }
        | VertexReason::LineOpen { .. } => leading(reason),
        VertexReason::RingOpen { .. }
        | VertexReason::Winding { .. }
        | VertexReason::Derivatives { .. }
        | VertexReason::Regular { .. }
        | VertexReason::Fold
        | VertexReason::JacobianOpen
        | VertexReason::HalfPlane => map(reason),
    }
}

/// What a verdict on the border rests on.
#[must_use]
pub fn border(ground: BorderGround) -> &'static str {
    match ground {
        BorderGround::Affine => "the characteristic map is affine (Border vertices)",
        BorderGround::Map => "the characteristic map is regular and maps the fan to a half-plane (Border vertices)",
        BorderGround::Jordan => {
            "1/2 has a Jordan block, and the signs on the ring are strict (Border vertices with a Jordan block)"
        }
        BorderGround::OneFace => {
            "the tangent plane is the osculating plane of the border (Border vertices with one face)"
        }
        BorderGround::Modes => {
            "the tangent planes inside tend to another one than those on the border (Border vertices with too many faces)"
        }
        BorderGround::Sides => "there are three independent limit directions (Border vertices with too many faces)",
    }
}

/// Without a characteristic map.
fn leading(reason: &VertexReason) -> String {
    let vectors = |length: &usize| match length {
        0 | 1 => "eigenvectors".to_owned(),
        _ => format!("{length}×{length} Jordan blocks"),
    };
    let one = |length: &usize| match length {
        0 | 1 => "one simple eigenvalue".to_owned(),
        _ => format!("one {length}×{length} Jordan block"),
    };
    match reason {
        VertexReason::Span { length, dimension } => format!(
            "the leading {} span a space of dimension {dimension}, and limit directions span all of it (corollary, \
             Theorem 8)",
            vectors(length)
        ),
        VertexReason::Sectors => "the two leading eigenvectors are the same in every second sector, so that the \
             characteristic map is not injective (Theorem 8)"
            .to_owned(),
        VertexReason::TwoFaces => {
            "at valence 2 both leading eigenvectors change their sign from sector to sector, so that \
             their map may wind once; Theorem 7 is for 3 faces and more"
                .to_owned()
        }
        VertexReason::Uncovered { length } => format!("two leading {} of this kind are not covered", vectors(length)),
        VertexReason::Line { length, block } => format!(
            "{} in block {block} leads and its function on the ring has no zero: all limit directions lie on one line \
             (Theorem {})",
            one(length),
            if *length > 1 { 3 } else { 2 }
        ),
        VertexReason::Path { length } => format!(
            "{} in block 0 leads and its function has no zero on a closed path around the vertex, whose copies stay on \
             one side of it (Theorem 8)",
            one(length)
        ),
        VertexReason::LineZero { length, block } => {
            format!("{} in block {block} leads, and its function has a zero on the ring", one(length))
        }
        VertexReason::LineOpen { length, block } => format!(
            "{} in block {block} leads; whether its function has a zero on the ring is not known for this scheme",
            one(length)
        ),
        _ => String::new(),
    }
}

/// With one.
fn map(reason: &VertexReason) -> String {
    let ends = |length: &usize| match length {
        0 | 1 => String::new(),
        _ => format!(", the ends of {length}×{length} Jordan blocks"),
    };
    match reason {
        VertexReason::RingOpen { block } => {
            format!("the leading Jordan blocks live in block {block}; whether their ring avoids 0 is not known")
        }
        VertexReason::Winding { length, block, times: Some(times) } => format!(
            "the leading eigenvectors live in block {block}{}: the ring winds {times} times around the vertex (Theorem 8)",
            ends(length)
        ),
        VertexReason::Winding { length, block, times: None } => format!(
            "the leading eigenvectors live in block {block}{}: the ring cannot wind once around the vertex (Theorem 8)",
            ends(length)
        ),
        VertexReason::Derivatives { length } => format!(
            "the leading eigenvectors live in block 1{}; the ring of this scheme is not polynomial, and no bounds of its \
             derivatives were found (Lemma 4)",
            ends(length)
        ),
        VertexReason::Regular { length } => {
            format!("the characteristic map is regular and winds once around 0{} (Theorem 7)", ends(length))
        }
        VertexReason::Fold => {
            "the Jacobian determinant of the characteristic map changes its sign (Theorem 8)".to_owned()
        }
        VertexReason::JacobianOpen => "the sign of the Jacobian determinant was not decided everywhere".to_owned(),
        VertexReason::HalfPlane => "no half-plane through 0 holds the ring of one sector".to_owned(),
        _ => String::new(),
    }
}

/// A condition of the proof for all valences at once.
#[must_use]
pub fn requirement(requirement: Requirement) -> &'static str {
    match requirement {
        Requirement::Eigenvalue => "λ is an eigenvalue of block 1",
        Requirement::Row(claim) => claim,
        Requirement::Constants => "all eigenvalues that do not depend on the frequency are smaller than λ",
        Requirement::Known => "the characteristic map is known as a rational function of the parameter",
        Requirement::Denominators => "no denominator of the Bézier points vanishes",
        Requirement::Jacobian => "the Bernstein coefficients of the Jacobian determinant are positive",
        Requirement::HalfPlane => "the ring of a sector lies in an open half-plane through 0",
    }
}
