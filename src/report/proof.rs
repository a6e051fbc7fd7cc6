//! The proof-style report: every statement applied, with every number that it needs.

use super::document::Document;
use crate::case::Case;
use crate::theorem::Certified;

/// The whole proof as a document.
#[must_use]
pub fn document(case: &Case, found: &Certified) -> Document {
    super::summary::summary(case, found, true)
}
