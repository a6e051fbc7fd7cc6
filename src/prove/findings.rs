//! What was found, and having it proved again.

use crate::answer::Verdict;
use crate::case::Question;
use crate::certificate::{self, Certificate, Doubt, Unsupported};
use crate::theorem::{Assertion, Certified, Claim, Reason};
use crate::vertex::{AtValence, Every};

/// What was found for a question.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Findings {
    /// The tangents of a shape.
    Tangents(Box<Certified>),
    /// Smoothness at the vertices of a mesh.
    Vertices {
        /// What holds at single valences, in ascending order.
        found: Vec<AtValence>,
        /// The common proof for all valences from some valence on, where all were asked for.
        every: Option<Every>,
    },
}

impl Findings {
    /// The verdict on all claims together: refuted if one is refuted, proved if there are claims and all are proved.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let claims = self.claims();
        Verdict::all(claims.len(), claims.iter().map(Claim::verdict))
    }

    /// Everything that is claimed, in the order of the reports. At the vertices of a mesh, smoothness is claimed; whether
    /// there is a tangent plane where it fails is said beside it.
    #[must_use]
    pub fn claims(&self) -> Vec<Claim> {
        match self {
            Self::Tangents(found) => found.claims.clone(),
            Self::Vertices { found, every } => {
                let common = every.iter().map(|e| {
                    let verdict = if e.proved() { Verdict::Proved } else { Verdict::Undetermined };
                    Claim::as_found(Assertion::C1AtVertices { from: e.from }, verdict, None, Reason::Conditions)
                });
                let single = found.iter().map(|f| {
                    let what = Assertion::C1AtVertex { valence: f.valence };
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
pub fn confirm(question: &Question, findings: &mut Findings) -> Result<Certificate, Doubt> {
    match (question, findings) {
        (Question::Tangents { case, .. }, Findings::Tangents(found)) => certificate::confirm(case, found),
        (Question::Vertices { case, .. }, Findings::Vertices { found, .. }) => {
            let certificate = certificate::confirm_vertices(case, found)?;
            certificate.ok_or_else(|| none("these vertices", "valences"))
        }
        _ => Err(none("the findings of another question", "question")),
    }
}

fn none(what: &str, place: &str) -> Doubt {
    Unsupported { what: what.to_owned(), place: place.to_owned() }.into()
}
