//! Findings of any kind as a proof, a summary, or data.

use super::document::Document;
use super::{json, proof, summary, vertex};
use crate::prove::Findings;
use serde_json::Value;

/// The proof.
#[must_use]
pub fn proof(findings: &Findings) -> Document {
    match findings {
        Findings::Tangents { case, found } => proof::document(case, found),
        Findings::Vertices { case, found, every } => proof::vertex_document(case, found, every.as_ref()),
    }
}

/// What `secant certify` prints; `verbose` adds branches, rates and exponents.
#[must_use]
pub fn summary(findings: &Findings, verbose: bool) -> Document {
    match findings {
        Findings::Tangents { case, found } => summary::summary(case, found, verbose),
        Findings::Vertices { case, found, every } => vertex::document(case, found, every.as_ref(), verbose),
    }
}

/// The JSON report (docs/json.md).
#[must_use]
pub fn json(findings: &Findings) -> Value {
    match findings {
        Findings::Tangents { case, found } => json::report(case, found),
        Findings::Vertices { case, found, every } => vertex::json(case, found, every.as_ref(), &findings.claims()),
    }
}
