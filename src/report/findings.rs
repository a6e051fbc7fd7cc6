//! Findings of any kind as a proof, a summary, or data.

use super::document::Document;
use super::proof::Level;
use super::{json, proof, summary, vertex};
use crate::prove::Findings;
use crate::theorem::Required;
use serde_json::Value;

/// The proof.
#[must_use]
pub fn proof(findings: &Findings) -> Document {
    proof_at(findings, Level::Proof)
}

/// The proof, or its first page; vertices have no levels.
#[must_use]
pub fn proof_at(findings: &Findings, level: Level) -> Document {
    match findings {
        Findings::Tangents { case, found } => proof::document_at(case, found, level),
        Findings::OverField { case, found } => {
            summary::summary(case, found, &Required::default(), level != Level::Summary)
        }
        Findings::Vertices { case, found, every } => proof::vertex_document(case, found, every.as_ref()),
    }
}

/// What `secant certify` prints; `verbose` adds branches, rates and exponents.
#[must_use]
pub fn summary(findings: &Findings, required: &Required, verbose: bool) -> Document {
    match findings {
        Findings::Tangents { case, found } => summary::summary(case, found, required, verbose),
        Findings::OverField { case, found } => summary::summary(case, found, required, verbose),
        Findings::Vertices { case, found, every } => vertex::document(case, found, every.as_ref(), verbose),
    }
}

/// The same in a few lines: the answers, the points and the verdict; vertices have a table anyway.
#[must_use]
pub fn brief(findings: &Findings, required: &Required) -> Document {
    match findings {
        Findings::Tangents { case, found } => summary::brief(case, found, required),
        Findings::OverField { case, found } => summary::brief(case, found, required),
        Findings::Vertices { case, found, every } => vertex::document(case, found, every.as_ref(), false),
    }
}

/// The JSON report (docs/json.md); `verbose` adds critical orders and local derivatives.
#[must_use]
pub fn json(findings: &Findings, required: &Required, verbose: bool) -> Value {
    match findings {
        Findings::Tangents { case, found } => json::report(case, found, required, verbose),
        Findings::OverField { case, found } => json::report(case, found, required, verbose),
        Findings::Vertices { case, found, every } => vertex::json(case, found, every.as_ref(), &findings.claims()),
    }
}
