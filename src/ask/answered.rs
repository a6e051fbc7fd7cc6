//! A case with its findings and what the checker said.

use crate::answer::Verdict;
use crate::budget::Budget;
use crate::case::Question;
use crate::certificate::{Certificate, Doubt, Unsupported, confirm_orders};
use crate::diagnostic::Problem;
use crate::picture::characteristic::sheet;
use crate::prove::{Findings, confirm, prove_with, unconfirmed};
use crate::report::document::Block;
use crate::report::words::listed;
use crate::report::{claims, figures, findings, vertex as at_vertices};
use crate::theorem::{Assertion, Certified, Claim, Required};
use crate::vertex::Again;
use serde_json::Value;

/// The certificate that the checker accepted, or why the format has none.
pub type Evidence = Result<Certificate, Unsupported>;

/// What was found, and what the checker said.
pub struct Answered {
    /// What was found.
    pub findings: Findings,
    /// What the checker said; `None` where it was not asked, or nothing is decided.
    pub evidence: Option<Evidence>,
    /// What is decided and was not proved again, although there is a certificate: labels of claims.
    pub once: Vec<String>,
}

/// Whether the checker proved a verdict again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Checked {
    /// It did.
    Yes,
    /// Of the claims that decide, or of the others, some have no rule in the certificate format.
    Part,
    /// The certificate format has no rule for some evidence.
    NoRule,
    /// It was not asked.
    NotAsked,
}

/// What a report says where some claims are not proved again.
pub const ONCE: &str = "no rule of the certificate format covers";

/// What a report says where there is no evidence.
pub const NOT_ASKED: &str = "the checker was not asked";

/// Answers a question and has the answer proved again if `check` says so; `step` is called after each valence.
///
/// # Errors
/// The [`Problem`] of the model, or of a certificate that the checker does not accept.
pub fn answered(
    question: &Question,
    check: bool,
    budget: &Budget,
    step: &(dyn Fn() + Sync),
) -> Result<Answered, Problem> {
    let mut findings = prove_with(question, budget, step)?;
    let decided = match &findings {
        Findings::Tangents { found, .. } => found.claims.iter().any(|c| c.verdict() != Verdict::Undetermined),
        Findings::OverField { found, .. } => found.claims.iter().any(|c| c.verdict() != Verdict::Undetermined),
        Findings::Vertices { found, .. } => !found.is_empty(),
    };
    let evidence = if check && decided {
        Some(match confirm(&mut findings) {
            Ok(certificate) => Ok(certificate),
            Err(Doubt::Unsupported(unsupported)) => Err(unsupported),
            Err(doubt) => return Err(rejected(findings.name(), &doubt)),
        })
    } else {
        None
    };
    let once = match (&findings, &evidence) {
        (Findings::Tangents { case, found }, Some(Ok(certificate))) => {
            let orders = confirm_orders(case, found).map_err(|doubt| rejected(findings.name(), &doubt))?;
            let once = found.claims.iter().filter(|c| !is_proved_again(c, certificate, &orders));
            once.map(|c| claims::label(&c.what)).collect()
        }
        (Findings::OverField { case, found }, Some(Ok(certificate))) => {
            let orders = confirm_orders(case, found).map_err(|doubt| rejected(findings.name(), &doubt))?;
            let once = found.claims.iter().filter(|c| !is_proved_again(c, certificate, &orders));
            once.map(|c| claims::label(&c.what)).collect()
        }
        _ => Vec::new(),
    };
    Ok(Answered { findings, evidence, once })
}

/// Whether a claim is open, or proved again by the certificate that was accepted or by that of the orders of smoothness.
fn is_proved_again(claim: &Claim, certificate: &Certificate, orders: &[Assertion]) -> bool {
    if claim.verdict() == Verdict::Undetermined {
        return true;
    }
    match &claim.what {
        Assertion::G1 => certificate.decides_every_point(claim.verdict()),
        Assertion::PlaneEverywhere => certificate.decides_every_plane(claim.verdict()),
        what if what.is_of_dense_joints() => !certificate.leaves_out_joints(),
        what if what.is_of_parameter() => orders.contains(what),
        _ => true,
    }
}

/// A certificate that the checker does not accept.
fn rejected(case: &str, doubt: &Doubt) -> Problem {
    Problem::new("secant::certificate::rejected", format!("{case}: {doubt}"))
        .with_help("this is a mistake in secant: please report it with the case; --no-check leaves the check out")
}

impl Answered {
    /// Whether the checker proved every decided verdict again.
    pub fn checked(&self) -> Checked {
        match (&self.findings, &self.evidence) {
            (_, None) => Checked::NotAsked,
            (_, Some(Err(_))) => Checked::NoRule,
            (Findings::Tangents { .. } | Findings::OverField { .. }, Some(Ok(_))) => {
                if self.once.is_empty() {
                    Checked::Yes
                } else {
                    Checked::Part
                }
            }
            (Findings::Vertices { found, every, .. }, Some(Ok(_))) => {
                let mut decided = found.iter().filter(|f| f.smooth != Verdict::Undetermined);
                let all = every.is_none() && decided.all(|f| f.again == Again::Proved);
                if all { Checked::Yes } else { Checked::NoRule }
            }
        }
    }

    /// The certificate that was accepted, or one that was not shown to the checker.
    ///
    /// # Errors
    /// A [`Problem`] where the format has no rule for some evidence.
    pub fn certificate(&self) -> Result<Certificate, Problem> {
        let written = self.evidence.clone().unwrap_or_else(|| unconfirmed(&self.findings));
        written.map_err(|unsupported| {
            Problem::new("secant::certificate::none", unsupported.to_string())
                .with_help("see docs/certificate.md, “What is not covered”; no certificate was written")
        })
    }

    /// The picture, as SVG: the shape with its tangents, or with `cones` the cones of Theorem 6; of vertices their
    /// characteristic maps.
    ///
    /// # Errors
    /// A [`Problem`] where nothing can be drawn.
    pub fn picture(&self, cones: bool) -> Result<String, Problem> {
        let (case, found) = match &self.findings {
            Findings::Tangents { case, found } => (case, found),
            Findings::OverField { case, found } => {
                let drawn = if cones { None } else { figures::attractor(case, found) };
                return drawn.map(|p| p.svg).ok_or_else(|| undrawn(&case.name));
            }
            Findings::Vertices { case, found, .. } => {
                let panels: Vec<_> = found.iter().filter_map(at_vertices::panel).collect();
                return Ok(sheet(&panels, &case.title));
            }
        };
        if !cones {
            return figures::attractor(case, found).map(|p| p.svg).ok_or_else(|| undrawn(&case.name));
        }
        match figures::cones(case, found) {
            Some(Block::Figure { svg, .. }) => Ok(svg),
            _ => {
                let message = format!("there are no cones to be drawn for {}", case.name);
                Err(Problem::new("secant::picture", message).with_help(
                    "cones are found for curves that are G¹ or have corners only (Theorem 6); leave out --draw",
                ))
            }
        }
    }

    /// The picture of the shape with its tangents, as PNG, so many pixels wide.
    ///
    /// # Errors
    /// A [`Problem`] where nothing can be drawn, and of vertices.
    #[cfg(feature = "png")]
    pub fn bitmap(&self, pixels: u32) -> Result<Vec<u8>, Problem> {
        match &self.findings {
            Findings::Tangents { case, found } => {
                figures::attractor_png(case, found, pixels).ok_or_else(|| undrawn(&case.name))
            }
            Findings::OverField { case, found } => {
                figures::attractor_png(case, found, pixels).ok_or_else(|| undrawn(&case.name))
            }
            Findings::Vertices { .. } => {
                Err(Problem::new("secant::picture", "there is no PNG image of the vertices of a mesh")
                    .with_help("--svg draws their characteristic maps"))
            }
        }
    }

    /// The JSON report, with what the checker said; `verbose` adds critical orders and local derivatives.
    pub fn json(&self, required: &Required, verbose: bool) -> Value {
        let mut report = findings::json(&self.findings, required, verbose);
        let why = match &self.evidence {
            None => Some(NOT_ASKED.to_owned()),
            Some(Err(unsupported)) => Some(unsupported.to_string()),
            Some(Ok(_)) if self.checked() == Checked::Yes => None,
            Some(Ok(_)) if !self.once.is_empty() => Some(format!("{ONCE} {}", listed(&self.once))),
            Some(Ok(_)) => Some("some of the verdicts have no rule in the certificate format".to_owned()),
        };
        let left_out: Vec<String> = match &self.evidence {
            Some(Ok(certificate)) => certificate.left_out().iter().map(ToString::to_string).collect(),
            _ => Vec::new(),
        };
        report["certificate"] = serde_json::json!({"checked": why.is_none(), "why": why, "left_out": left_out});
        report
    }

    /// The kinds of the examined points, or the verdicts at the valences, each with its number.
    pub fn kinds(&self) -> Vec<String> {
        match &self.findings {
            Findings::Tangents { found, .. } => kinds(found),
            Findings::OverField { found, .. } => counted(found.points.iter().map(|p| p.kind.word())),
            Findings::Vertices { found, .. } => counted(found.iter().map(|f| match (f.smooth, f.border) {
                (Verdict::Proved, None) => "C¹ valence",
                (Verdict::Refuted, None) => "valence not C¹",
                (Verdict::Undetermined, None) => "open valence",
                (Verdict::Proved, Some(_)) => "C¹ fan",
                (Verdict::Refuted, Some(_)) => "fan not C¹",
                (Verdict::Undetermined, Some(_)) => "open fan",
            })),
        }
    }
}

/// Why a shape has no picture.
fn undrawn(name: &str) -> Problem {
    Problem::new("secant::picture", format!("{name} cannot be drawn"))
        .with_help("no point of the shape can be computed, because contraction is not decided")
}

fn kinds(found: &Certified) -> Vec<String> {
    let surface = found.surface.iter().flat_map(|s| &s.points).map(|p| match p.verdict {
        Verdict::Proved => "tangent plane",
        Verdict::Refuted => "no tangent plane",
        Verdict::Undetermined => "undetermined",
    });
    counted(surface.chain(found.points.iter().map(|p| p.kind.word())))
}

fn counted<'a>(items: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut counted: Vec<(&str, usize)> = Vec::new();
    for word in items {
        match counted.iter_mut().find(|(w, _)| *w == word) {
            Some((_, n)) => *n += 1,
            None => counted.push((word, 1)),
        }
    }
    counted.into_iter().map(|(w, n)| if n == 1 { w.to_owned() } else { format!("{n} {w}") }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_certificate_leaves_out_is_not_proved_again() {
        let whole = Certificate::new("certify", "case", "proved", serde_json::json!({"answers": []}));
        let part = whole.clone().without([Unsupported { what: "this theorem".to_owned(), place: "joints".to_owned() }]);
        let claim = Claim::proved(Assertion::SeenJoints, None);
        assert!(is_proved_again(&claim, &whole, &[]) && !is_proved_again(&claim, &part, &[]));
        let ends = Claim::proved(Assertion::TangentAtEnds, None);
        assert!(is_proved_again(&ends, &part, &[]));
    }
}
