//! Bounds of the joint spectral radius of the matrices of a file.

use crate::algebraic::Real;
use crate::arith::Rational;
use crate::case::matrix_file;
use crate::certificate::{Written, radius_certificate};
use crate::diagnostic::{Problem, SourceText};
use crate::radius::{JointRadius, Options, file, joint_radius};
use crate::report::radius as report;
use serde_json::Value;

/// The bounds, and what they are about.
#[derive(Debug, Clone)]
pub struct Radius {
    /// The name that the text gives, or that of the file.
    pub name: String,
    found: Bounds,
    text: String,
}

/// Bounds over the rationals, or over a real number field.
#[derive(Debug, Clone)]
enum Bounds {
    Rational(Box<Bounded<Rational>>),
    Field(Box<Bounded<Real>>),
}

#[derive(Debug, Clone)]
struct Bounded<E> {
    file: file::File<E>,
    radius: JointRadius<E>,
}

/// Says the same of bounds over both.
macro_rules! over {
    ($found:expr, $b:ident => $say:expr) => {
        match $found {
            Bounds::Rational($b) => $say,
            Bounds::Field($b) => $say,
        }
    };
}

impl<E: Written> Bounded<E> {
    fn of(name: &str, file: file::File<E>, options: &Options) -> Result<Box<Self>, Problem> {
        let radius = joint_radius(&file.system, options).map_err(|e| wrong(format!("{name}: {e}"), HELP))?;
        Ok(Box::new(Self { file, radius }))
    }
}

const HELP: &str = "see docs/radius.md for the format";

fn wrong(message: String, help: &str) -> Problem {
    Problem::new("secant::jsr", message).with_help(help)
}

/// Bounds the joint spectral radius of the matrices of a text (docs/radius.md); `name` is shown in diagnostics.
///
/// # Errors
/// A [`Problem`] where the text is no set of matrices, or they do not fit together; also where all entries are rational and one is
/// written as an expression.
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
    let refused = |e: file::FileError| {
        let source = SourceText::new(name, text);
        let of_case = ["convention", "pieces", "scheme", "map", "state", "control", "title"];
        let value;
        let help = match &e.problem {
            file::FileProblem::Unknown(key) if of_case.contains(&key.as_str()) => {
                "this is a case: `secant regularity` bounds the radii that say how smooth it is; docs/radius.md has the format of \
                 files for `secant jsr`"
            }
            file::FileProblem::Expression { help: Some(help), .. } => help,
            file::FileProblem::Valued { value: found, .. } => {
                value = format!("write \"{found}\" here");
                &value
            }
            _ => HELP,
        };
        wrong(e.problem.to_string(), help).with_source(&source).with_mark(e.span)
    };
    let found = match read(text) {
        Ok(file) => Bounds::Rational(Bounded::of(name, file, options)?),
        // A number that is none may be an expression.
        Err(e) if matches!(e.problem, file::FileProblem::Number { .. }) => {
            Bounds::Field(Bounded::of(name, file::parse_field(text).map_err(refused)?, options)?)
        }
        Err(e) => return Err(refused(e)),
    };
    let own = over!(&found, b => b.file.name.clone());
    let name = if own.is_empty() { name.to_owned() } else { own };
    Ok(Radius { name, found, text: text.to_owned() })
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
        over!(&self.found, b => report::radius_json(&self.name, &b.radius))
    }

    /// The answer as text for a terminal.
    #[must_use]
    pub fn text(&self) -> String {
        over!(&self.found, b => report::joint_radius(&b.radius))
    }

    /// Whether an upper bound was found.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        over!(&self.found, b => b.radius.upper.is_some())
    }

    /// A drawing of the invariant polytope in the plane, where one was used.
    #[must_use]
    pub fn picture(&self) -> Option<String> {
        over!(&self.found, b => crate::picture::polytope(&b.radius))
    }

    /// The certificate of the bounds, accepted by the checker.
    ///
    /// # Errors
    /// A [`Problem`] where there is none, and where the text is not TOML.
    pub fn certificate(&self) -> Result<String, Problem> {
        let certificate = over!(&self.found, b => radius_certificate(&b.file, &b.radius))
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
