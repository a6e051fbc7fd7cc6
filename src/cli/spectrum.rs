//! `secant spectrum`: eigenvalues, multiplicities, Jordan blocks, chains and modulus classes of a matrix or of a case.

use super::output::deliver;
use super::progress::Waiting;
use super::{PROVED, SpectrumArgs, UNDETERMINED};
use crate::algebraic::field::FieldMatrix;
use crate::approx::{ApproxSpectrum, approximate_spectrum};
use crate::case::matrix_file::{self, Format};
use crate::case::{Case, FieldCase};
use crate::certificate::{self, Doubt, Operator};
use crate::diagnostic::{Problem, SourceText};
use crate::jordan::{BUDGET, FieldSpectrum, Spectrum, estimated_field_work, estimated_work};
use crate::linalg::Matrix;
use crate::report::{field_spectrum, spectrum as report};
use std::path::Path;

/// What a file gives: named matrices, of a case each with its state and piece, and the text and name for a certificate.
struct Input {
    matrices: Vec<(String, Entries, Option<(usize, usize)>)>,
    /// The text that the checker reads, and the name that it finds there; none where it reads no such file.
    about: Option<(String, String)>,
    /// The case that is written beside a certificate.
    beside: Option<String>,
}

/// A matrix over the rationals or over a larger field.
enum Entries {
    Rational(Matrix),
    Field(FieldMatrix),
}

impl From<FieldMatrix> for Entries {
    fn from(matrix: FieldMatrix) -> Self {
        match matrix.rational() {
            Some(rational) => Self::Rational(rational),
            None => Self::Field(matrix),
        }
    }
}

/// Prints the spectra of a matrix file, or of all operators of a case that map a state into itself.
pub fn run(args: &SpectrumArgs) -> u8 {
    let code = if args.approx { UNDETERMINED } else { PROVED };
    deliver(all(args).map(|text| (text, code)))
}

/// The spectra of all files; of several matrices a list in JSON.
fn all(args: &SpectrumArgs) -> Result<String, Problem> {
    if args.certificate.is_some() && args.files.len() > 1 {
        return Err(Problem::new("secant::usage", "--certificate is for a single file")
            .with_help("write the certificates one by one"));
    }
    let mut parts = Vec::new();
    for path in &args.files {
        let input = matrices(path)?;
        let found = rendered(args, &input)?;
        if args.files.len() > 1 && !args.json {
            parts.push(format!("== {}\n", path.display()));
        }
        parts.extend(found.iter().zip(&input.matrices).map(|(f, (name, ..))| f.render(args, path, name)));
    }
    Ok(match (args.json, parts.as_slice()) {
        (true, [one]) => one.clone(),
        (true, _) => format!("[{}]\n", parts.iter().map(|p| p.trim_end()).collect::<Vec<_>>().join(",\n")),
        _ => parts.join("\n"),
    })
}

fn rendered(args: &SpectrumArgs, input: &Input) -> Result<Vec<Found>, Problem> {
    let waiting = Waiting::with("computing the spectrum …", false);
    let found: Result<Vec<Found>, Problem> = input.matrices.iter().map(|(n, m, _)| find(args, n, m)).collect();
    waiting.finish();
    let found = found?;
    if let Some(path) = args.certificate.as_deref() {
        write_certificate(path, input, &found)?;
    }
    Ok(found)
}

/// The operators of a case over a number field.
fn field_operators(path: &Path) -> Result<Input, Problem> {
    let case = FieldCase::read(path)?;
    let mut matrices = Vec::new();
    for (index, (name, pieces)) in case.states.into_iter().enumerate() {
        for (letter, (_, op)) in pieces.into_iter().enumerate().filter(|(_, (target, _))| *target == index) {
            matrices.push((format!("operator {letter} of state {name}"), op.into(), Some((index, letter))));
        }
    }
    Ok(Input { matrices, about: None, beside: None })
}

/// Whether a text is the literal of a matrix.
fn is_literal(text: &str) -> bool {
    let start = text.trim_start();
    let list = start.starts_with(['[', '{']) && !start.starts_with("[[[");
    list && text.contains(['[', '{', ';']) && (start.starts_with("[[") || start.starts_with("{{") || text.contains(';'))
        || text.contains("atrix(")
        || text.contains("\\begin{")
}

fn matrices(path: &Path) -> Result<Input, Problem> {
    let word = path.to_string_lossy();
    let there = path.exists() || word == "-";
    let source = match (there, is_literal(&word)) {
        (true, _) if path.extension().is_none_or(|e| e != "toml") => Some(SourceText::read(path)?),
        (false, true) => Some(SourceText::new("the matrix", &*word)),
        _ => None,
    };
    // What comes from a pipe may be a case.
    let case_text = source.as_ref().filter(|s| word == "-" && s.text.contains("name") && s.text.contains('='));
    if source.is_none() || case_text.is_some() {
        let read = || case_text.map_or_else(|| Case::ask(&word), |s| Case::parse(&s.name, &s.text));
        let case = match read() {
            Err(p) if matches!(p.id(), "secant::case::irrational-entry" | "secant::case::expression") => {
                return field_operators(path);
            }
            other => other?,
        };
        let mut matrices = Vec::new();
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                let name = format!("operator {letter} of state {}", state.name);
                matrices.push((name, Entries::Rational(piece.op.clone()), Some((index, letter))));
            }
        }
        let (text, beside) = (case.checked_text().to_string(), case.beside());
        return Ok(Input { matrices, about: Some((text, case.name)), beside });
    }
    let Some(SourceText { name, text }) = source else {
        return Err(Problem::new("secant::input", format!("{word} is no matrix")).with_help("name a file or a case"));
    };
    let file = matrix_file::parse_field(&name, &text)?;
    if file.decimals > 0 {
        eprintln!("note: {} decimals were read as the exact fractions that they write", file.decimals);
    }
    let checked = matches!(file.format, Format::Plain | Format::NestedBrackets | Format::NestedBraces);
    let about = checked.then(|| (text.to_string(), "matrix".to_owned()));
    Ok(Input { matrices: vec![(name, file.matrix.into(), None)], about, beside: None })
}

fn over_budget(name: &str, size: usize) -> Problem {
    let message = format!("the exact spectrum of {name}, of size {size}, is over the budget");
    Problem::new("secant::limit", message).with_help("use --approx for a labelled approximation")
}

enum Found {
    Exact(Box<Spectrum>),
    Field(Box<FieldSpectrum>),
    Approximate(ApproxSpectrum),
}

fn find(args: &SpectrumArgs, name: &str, entries: &Entries) -> Result<Found, Problem> {
    match entries {
        Entries::Rational(matrix) => find_rational(args, name, matrix),
        Entries::Field(matrix) => find_field(args, name, matrix),
    }
}

fn find_rational(args: &SpectrumArgs, name: &str, matrix: &Matrix) -> Result<Found, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        return approximate(&matrix);
    }
    if estimated_work(&matrix) > BUDGET {
        return Err(over_budget(name, matrix.rows()));
    }
    Ok(Found::Exact(Box::new(Spectrum::of(&matrix))))
}

fn find_field(args: &SpectrumArgs, name: &str, matrix: &FieldMatrix) -> Result<Found, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        let field = matrix.field();
        let nearest = |i, j| field.enclosure(&matrix[(i, j)], 80).mid();
        return approximate(&Matrix::from_fn(matrix.rows(), matrix.cols(), nearest));
    }
    if estimated_field_work(&matrix) > BUDGET {
        return Err(over_budget(name, matrix.rows()));
    }
    Ok(Found::Field(Box::new(FieldSpectrum::of(&matrix))))
}

fn approximate(matrix: &Matrix) -> Result<Found, Problem> {
    approximate_spectrum(matrix).map(Found::Approximate).map_err(|error| {
        Problem::new("secant::approx", error.to_string()).with_help("leave out --approx for the exact spectrum")
    })
}

impl Found {
    fn render(&self, args: &SpectrumArgs, path: &Path, name: &str) -> String {
        let data = |mut value: serde_json::Value| {
            value["path"] = path.display().to_string().into();
            value["name"] = name.into();
            format!("{value:#}\n")
        };
        match self {
            Self::Approximate(spectrum) => report::approximate_text(spectrum),
            Self::Exact(spectrum) if args.json => data(report::json(spectrum)),
            Self::Exact(spectrum) if args.latex => report::latex(spectrum),
            Self::Exact(spectrum) => format!("{name}\n{}", report::text(spectrum)),
            Self::Field(spectrum) if args.json => data(field_spectrum::json(spectrum)),
            Self::Field(spectrum) if args.latex => field_spectrum::latex(spectrum),
            Self::Field(spectrum) => format!("{name}\n{}", field_spectrum::text(spectrum)),
        }
    }
}

/// Writes the certificate after the checker has accepted it.
fn write_certificate(path: &Path, input: &Input, found: &[Found]) -> Result<(), Problem> {
    let none = |message: &str, help: &str| Problem::new("secant::certificate::none", message).with_help(help);
    let mut operators = Vec::new();
    for (spectrum, (.., place)) in found.iter().zip(&input.matrices) {
        match spectrum {
            Found::Exact(spectrum) => operators.push(Operator { place: *place, spectrum }),
            Found::Field(_) => {
                let message = "the format has no certificates of spectra over number fields";
                return Err(none(message, "leave out --certificate; nothing was written"));
            }
            Found::Approximate(_) => {
                return Err(none("an approximation has no certificate", "leave out --approx; nothing was written"));
            }
        }
    }
    let Some((text, name)) = &input.about else {
        let message = "certificates are about plain matrices, rows in nested brackets, and rational cases only";
        return Err(none(message, "write the matrix as plain text: n, then n rows of n numbers"));
    };
    let written = certificate::spectra(name, &operators).map_err(Doubt::from);
    let accepted = written.and_then(|c| certificate::checked(text, c));
    let accepted =
        accepted.map_err(|doubt| none(&doubt.to_string(), "see docs/certificate.md; nothing was written"))?;
    super::output::write_certificate(path, accepted.text(), input.beside.clone())
}
