//! What was found, and having it proved again.

use super::deciding_claims;
use crate::algebraic::Real;
use crate::answer::Verdict;
use crate::case::{Case, VertexCase};
use crate::certificate::{self, Certificate, Doubt, Unsupported};
use crate::diagnostic::SourceText;
use crate::theorem::{Assertion, Certified, Claim, Reason, Required};
use crate::vertex::{AtValence, Every, overall};
use std::sync::Arc;

/// What was found for a question.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Findings {
    /// The tangents of a shape.
    Tangents {
        /// The case.
        case: Arc<Case>,
        /// The claims and their evidence.
        found: Box<Certified>,
    },
    /// The tangents of a curve or a set with entries in a real number field.
    OverField {
        /// The case.
        case: Arc<Case<Real>>,
        /// The claims and their evidence.
        found: Box<Certified<Real>>,
    },
    /// Smoothness at the vertices of a mesh.
    Vertices {
        /// The case.
        case: Arc<VertexCase>,
        /// What holds at single valences, in ascending order.
        found: Vec<AtValence>,
        /// The common proof for all valences from some valence on, where all were asked for.
        every: Option<Every>,
    },
}

impl Findings {
    /// The verdict on the claims that decide where nobody says otherwise ([`Required::default`]).
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.verdict_on(&Required::default())
    }

    /// The verdict on the claims that are required.
    #[must_use]
    pub fn verdict_on(&self, required: &Required) -> Verdict {
        match self {
            Self::Tangents { case, found } => required.verdict(&deciding_claims(case, &found.claims, required)),
            Self::OverField { case, found } => required.verdict(&deciding_claims(case, &found.claims, required)),
            Self::Vertices { found, every, .. } => {
                let overall = overall(found, every.as_ref());
                required.at_vertices(overall, overall)
            }
        }
    }

    /// The name of the case.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.name,
            Self::OverField { case, .. } => &case.name,
            Self::Vertices { case, .. } => &case.name,
        }
    }

    /// One line for people.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.title,
            Self::OverField { case, .. } => &case.title,
            Self::Vertices { case, .. } => &case.title,
        }
    }

    /// The file of the case.
    #[must_use]
    pub fn text(&self) -> &SourceText {
        match self {
            Self::Tangents { case, .. } => &case.text,
            Self::OverField { case, .. } => &case.text,
            Self::Vertices { case, .. } => &case.text,
        }
    }

    /// Everything that is claimed, in the order of the reports. At the vertices of a mesh, smoothness is claimed; whether
    /// there is a tangent plane where it fails is said beside it.
    #[must_use]
    pub fn claims(&self) -> Vec<Claim> {
        match self {
            Self::Tangents { found, .. } => found.claims.clone(),
            Self::OverField { found, .. } => found.claims.clone(),
            Self::Vertices { found, every, .. } => {
                let common = every.iter().map(|e| {
                    let verdict = if e.proved() { Verdict::Proved } else { Verdict::Undetermined };
                    Claim::as_found(Assertion::C1AtVertices { from: e.from }, verdict, None, Reason::Conditions)
                });
                let single = found.iter().map(|f| {
                    let what = match f.border {
                        Some(smooth) => Assertion::C1AtBorder { faces: f.valence, smooth },
                        None => Assertion::C1AtVertex { valence: f.valence },
                    };
                    Claim::as_found(what, f.smooth, None, Reason::Valence(f.valence))
                });
                common.chain(single).collect()
            }
        }
    }
}

/// Writes the certificate of what was found and has it proved again by the independent checker, which reads the case itself.
///
/// # Errors
/// [`Doubt::Unsupported`] where the format has no rule for some evidence, or nothing is decided; the other doubts where the
/// checker does not accept the certificate, which is a mistake in secant.
///
/// # Cost
/// That of [`secant_check::check`].
pub fn confirm(findings: &mut Findings) -> Result<Certificate, Doubt> {
    match findings {
        Findings::Tangents { case, found } => certificate::confirm(case, found),
        Findings::OverField { case, found } => certificate::confirm_flat(case, found),
        Findings::Vertices { case, found, every } => {
            Ok(certificate::confirm_vertices(case, found)?.without(all_at_once(every.as_ref())))
        }
    }
}

/// The certificate of what was found, which nobody has checked yet.
///
/// # Errors
/// [`Unsupported`] as for [`confirm`].
pub fn unconfirmed(findings: &Findings) -> Result<Certificate, Unsupported> {
    match findings {
        Findings::Tangents { case, found } => certificate::certificate(case, found),
        Findings::OverField { case, found } => certificate::flat_certificate(case, found),
        Findings::Vertices { case, found, every } => {
            Ok(certificate::vertex_certificate(case, found)?.without(all_at_once(every.as_ref())))
        }
    }
}

/// The proof for all valences at once, which has no rule.
fn all_at_once(every: Option<&Every>) -> Option<Unsupported> {
    let proved = every.filter(|e| e.proved())?;
    Some(Unsupported { what: "all valences at once".to_owned(), place: format!("valences from {}", proved.from) })
}
