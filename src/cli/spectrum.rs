//! `secant spectrum`: eigenvalues, multiplicities, Jordan blocks, chains and modulus classes of a matrix or of a case.

use super::output::{complain, print};
use super::progress::Waiting;
use super::{BAD_INPUT, PROVED, SpectrumArgs, UNDETERMINED};
use crate::algebraic::field::FieldMatrix;
use crate::approx::approximate_spectrum;
use crate::case::{Case, FieldCase, matrix_file};
use crate::diagnostic::Problem;
use crate::jordan::{BUDGET, FieldSpectrum, Spectrum, estimated_field_work, estimated_work};
use crate::linalg::Matrix;
use crate::report::{field_spectrum, spectrum as report};
use std::path::Path;

/// Prints the spectra of a matrix file, or of all operators of a case that map a state into itself.
pub fn run(args: &SpectrumArgs) -> u8 {
    match matrices(&args.file) {
        Ok(found) => {
            let parts: Result<Vec<String>, Problem> = found.iter().map(|(name, m)| rendered(args, name, m)).collect();
            match parts {
                Ok(parts) => {
                    print(&parts.join("\n"));
                    if args.approx { UNDETERMINED } else { PROVED }
                }
                Err(problem) => refuse(&problem),
            }
        }
        Err(problem) => refuse(&problem),
    }
}

fn refuse(problem: &Problem) -> u8 {
    complain(problem);
    BAD_INPUT
}

/// A matrix over the rationals or over a larger field.
enum Input {
    Rational(Matrix),
    Field(FieldMatrix),
}

impl From<FieldMatrix> for Input {
    fn from(matrix: FieldMatrix) -> Self {
        match matrix.rational() {
            Some(rational) => Self::Rational(rational),
            None => Self::Field(matrix),
        }
    }
}

/// The operators of a case over a number field.
fn field_operators(path: &Path) -> Result<Vec<(String, Input)>, Problem> {
    let case = FieldCase::read(path)?;
    let mut found = Vec::new();
    for (index, (name, pieces)) in case.states.into_iter().enumerate() {
        for (letter, (_, op)) in pieces.into_iter().enumerate().filter(|(_, (target, _))| *target == index) {
            found.push((format!("operator {letter} of state {name}"), Input::from(op)));
        }
    }
    Ok(found)
}

fn matrices(path: &Path) -> Result<Vec<(String, Input)>, Problem> {
    if path.extension().is_some_and(|e| e == "toml") {
        let case = match Case::read(path) {
            Err(p) if matches!(p.id(), "secant::case::irrational-entry" | "secant::case::expression") => {
                return field_operators(path);
            }
            other => other?,
        };
        let mut found = Vec::new();
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                found.push((format!("operator {letter} of state {}", state.name), Input::Rational(piece.op.clone())));
            }
        }
        return Ok(found);
    }
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| {
        Problem::new("secant::input", format!("{name} cannot be read: {error}"))
            .with_help("name a text file with a matrix, or a case file")
    })?;
    let file = matrix_file::parse_field(&name, &text)?;
    if file.decimals > 0 {
        eprintln!("note: {} decimals were read as the exact fractions that they write", file.decimals);
    }
    Ok(vec![(name, file.matrix.into())])
}

fn rendered(args: &SpectrumArgs, name: &str, input: &Input) -> Result<String, Problem> {
    let waiting = Waiting::with("computing the spectrum …", false);
    let text = match input {
        Input::Rational(matrix) => render(args, name, matrix),
        Input::Field(matrix) => render_field(args, name, matrix),
    };
    waiting.finish();
    text
}

fn over_budget(name: &str, size: usize) -> Problem {
    let message = format!("the exact spectrum of {name}, of size {size}, is over the budget");
    Problem::new("secant::limit", message).with_help("use --approx for a labelled approximation")
}

fn render_field(args: &SpectrumArgs, name: &str, matrix: &FieldMatrix) -> Result<String, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        let field = matrix.field();
        let nearest = |i, j| field.enclosure(&matrix[(i, j)], 80).mid();
        let rounded = Matrix::from_fn(matrix.rows(), matrix.cols(), nearest);
        return approximate(&rounded);
    }
    if estimated_field_work(&matrix) > BUDGET {
        return Err(over_budget(name, matrix.rows()));
    }
    let spectrum = FieldSpectrum::of(&matrix);
    Ok(if args.json {
        format!("{:#}\n", field_spectrum::json(&spectrum))
    } else if args.latex {
        field_spectrum::latex(&spectrum)
    } else {
        format!("{name}\n{}", field_spectrum::text(&spectrum))
    })
}

fn approximate(matrix: &Matrix) -> Result<String, Problem> {
    approximate_spectrum(matrix).map(|s| report::approximate_text(&s)).map_err(|error| {
        Problem::new("secant::approx", error.to_string()).with_help("leave out --approx for the exact spectrum")
    })
}

fn render(args: &SpectrumArgs, name: &str, matrix: &Matrix) -> Result<String, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        return approximate(&matrix);
    }
    if estimated_work(&matrix) > BUDGET {
        return Err(over_budget(name, matrix.rows()));
    }
    let spectrum = Spectrum::of(&matrix);
    Ok(if args.json {
        format!("{:#}\n", report::json(&spectrum))
    } else if args.latex {
        report::latex(&spectrum)
    } else {
        format!("{name}\n{}", report::text(&spectrum))
    })
}
