//! The smoothness of schemes across a border.

use super::Smooth;
use crate::case::BorderCase;
use crate::certificate::{border_certificate, checked};
use crate::diagnostic::{Problem, SourceText};
use crate::radius::Options;
use crate::report::border as report;
use crate::scheme::BorderScheme;
use crate::theorem::border::{BorderRegularity, border_regularity};
use std::path::Path;

fn wrong(message: String) -> Problem {
    Problem::new("secant::regularity", message)
        .with_help("the format of a [border] is in docs/case-format.md; no certificate was written")
}

/// A case file with a `[border]`; `None` where the input is none.
///
/// # Errors
/// A [`Problem`] where it is one and wrong.
pub(super) fn border_case(what: &str) -> Result<Option<BorderCase>, Problem> {
    let text = Some(what).filter(|w| w.ends_with(".toml") || Path::new(w).is_file());
    let source = text.and_then(|w| SourceText::read(Path::new(w)).ok()).filter(|s| BorderCase::is_meant(&s.text));
    source.map(|s| BorderCase::parse(&s.name, &s.text)).transpose()
}

/// What is known of a scheme with a border.
pub(super) fn border_answer(scheme: BorderScheme) -> Result<(Smooth, BorderRegularity), Problem> {
    let found = border_regularity(scheme, &Options::default()).map_err(|e| wrong(e.to_string()))?;
    let decided = found.smoothness().is_some() || found.is_exact();
    let smooth = Smooth { text: report::border(&found), data: report::border_data(&found), decided };
    Ok((smooth, found))
}

/// The same with its certificate, accepted by the checker, and the case file that it is about.
pub(super) fn border_certified(case: BorderCase) -> Result<(Smooth, String, Option<String>), Problem> {
    let source = case.scheme.case_text(&case.name);
    let (smooth, found) = border_answer(case.scheme)?;
    let certificate = border_certificate(&case.name, &found).map_err(|e| wrong(e.to_string()))?;
    let certificate = checked(&source, certificate).map_err(|e| wrong(e.to_string()))?;
    Ok((smooth, certificate.text(), Some(source)))
}
