//! Findings of any kind as a proof, a summary, or data.

use super::document::{Block, Document, words};
use super::proof::Level;
use super::words::mark;
use super::{json, proof, summary, vertex};
use crate::answer::Verdict;
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
        Findings::OverField { case, found } => proof::document_at(case, found, level),
        Findings::Vertices { case, found, every } => proof::vertex_document(case, found, every.as_ref()),
    }
}

/// What `secant certify` prints; `verbose` adds branches, rates and exponents.
#[must_use]
pub fn summary(findings: &Findings, required: &Required, verbose: bool) -> Document {
    match findings {
        Findings::Tangents { case, found } => summary::summary(case, found, required, verbose),
        Findings::OverField { case, found } => summary::summary(case, found, required, verbose),
        Findings::Vertices { case, found, every } => {
            let mut document = vertex::document(case, found, every.as_ref(), verbose);
            document.blocks.extend(of_vertices(required, findings.verdict_on(required)));
            document
        }
    }
}

/// The verdict on what is required of vertices, where something is named.
#[must_use]
pub fn of_vertices(required: &Required, verdict: Verdict) -> Option<Block> {
    (!required.is_of_all_tangents()).then(|| {
        let mut said = words(format!("Required is {required}: "));
        said.push(mark(verdict));
        said.extend(words(". Of vertices only C¹ can be required; the size of the curvature stands in its table."));
        Block::Paragraph(said)
    })
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
        Findings::Vertices { case, found, every } => {
            let mut data = vertex::json(case, found, every.as_ref(), &findings.claims());
            data["verdict"] = findings.verdict_on(required).word().into();
            data["required"] = required.to_string().into();
            data
        }
    }
}
