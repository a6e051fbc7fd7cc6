//! Bounds of the joint spectral radius of the matrices of a file.

use crate::case::matrix_file;
use crate::certificate::radius_certificate;
use crate::diagnostic::{Problem, SourceText};
use crate::radius::{JointRadius, Options, file, joint_radius};
use crate::report::radius::radius_json;
use serde_json::Value;

/// The bounds, and what they are about.
#[derive(Debug, Clone)]
pub struct Radius {
    /// The name that the text gives, or that of the file.
    pub name: String,
    /// What was found.
    pub found: JointRadius,
    file: file::File,
    text: String,
}

fn wrong(message: String, help: &str) -> Problem {
    Problem::new("secant::jsr", message).with_help(help)
}

/// Bounds the joint spectral radius of the matrices of a text (docs/radius.md); `name` is shown in diagnostics.
///
/// # Errors
/// A [`Problem`] where the text is no set of matrices, or they do not fit together.
///
/// # Examples
/// ```
/// use secant::{ask, radius::Options};
/// let found = ask::radius("pair", "matrices = [[[1, 1], [0, 1]], [[1, 0], [1, 1]]]", &Options::default())?;
/// assert_eq!(found.json()["exact"], true);
/// assert!(found.certificate()?.starts_with('{'));
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn radius(name: &str, text: &str, options: &Options) -> Result<Radius, Problem> {
    let file = read(text).map_err(|e| {
        let source = SourceText::new(name, text);
        let of_case = ["convention", "pieces", "scheme", "map", "state", "control", "title"];
        let help = match &e.problem {
            file::FileProblem::Unknown(key) if of_case.contains(&key.as_str()) => {
                "this is a case: `secant regularity` bounds the radii that say how smooth it is; docs/radius.md has the format of \
                 files for `secant jsr`"
            }
            _ => "see docs/radius.md for the format",
        };
        wrong(e.problem.to_string(), help).with_source(&source).with_mark(e.span)
    })?;
    let found = joint_radius(&file.system, options).map_err(|e| wrong(format!("{name}: {e}"), "see docs/radius.md"))?;
    let name = if file.name.is_empty() { name } else { &file.name }.to_owned();
    Ok(Radius { name, found, file, text: text.to_owned() })
}

/// A file, also with matrices as NumPy prints them, one by one or in a list.
fn read(text: &str) -> Result<file::File, file::FileError> {
    file::parse(text).or_else(|error| {
        let blocks = blocks(text);
        let matrices: Option<Vec<String>> = blocks.iter().map(|block| rows(block)).collect();
        match matrices.filter(|list| !list.is_empty() && !text.contains("matrices")) {
            Some(list) => file::parse(&format!("matrices = [{}]", list.join(",\n"))),
            None => Err(error),
        }
    })
}

/// The stretches `[[…]]` that hold rows of numbers.
fn blocks(text: &str) -> Vec<&str> {
    let brackets: Vec<(usize, bool)> = text.match_indices(['[', ']']).map(|(at, c)| (at, c == "[")).collect();
    let mut found = Vec::new();
    let mut k = 0;
    while k < brackets.len() {
        let begins = matches!(brackets[k..], [(_, true), (_, true), (_, false), ..]);
        let mut depth = 0_usize;
        let end = brackets[k..].iter().position(|(_, opens)| {
            depth = if *opens { depth + 1 } else { depth.saturating_sub(1) };
            depth == 0
        });
        match end.filter(|_| begins) {
            Some(end) => {
                found.push(&text[brackets[k].0..=brackets[k + end].0]);
                k += end + 1;
            }
            None => k += 1,
        }
    }
    found
}

/// A matrix in the notation of the file.
fn rows(block: &str) -> Option<String> {
    let matrix = matrix_file::parse(block).ok()?.matrix;
    let row = |i: usize| matrix.row(i).iter().map(|x| format!("\"{x}\"")).collect::<Vec<_>>().join(", ");
    Some(format!("[{}]", (0..matrix.rows()).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", ")))
}

impl Radius {
    /// The answer as data.
    #[must_use]
    pub fn json(&self) -> Value {
        radius_json(&self.name, &self.found)
    }

    /// The certificate of the bounds, accepted by the checker.
    ///
    /// # Errors
    /// A [`Problem`] where there is none, and where the text is not TOML.
    pub fn certificate(&self) -> Result<String, Problem> {
        let certificate = radius_certificate(&self.file, &self.found)
            .map_err(|e| wrong(e.to_string(), "see docs/certificate.md; no certificate was written"))?;
        let written = certificate.text();
        secant_check::check_while(&self.text, &written, crate::stop::check).map_err(|e| {
            let help = match self.text.trim_start().starts_with(['{', '[']) || !self.text.contains('=') {
                true => "certificates are about TOML files: write the matrices as one",
                false => "this is a mistake in secant: please report it",
            };
            wrong(format!("the certificate is not accepted: {e}"), help)
        })?;
        Ok(written)
    }
}
