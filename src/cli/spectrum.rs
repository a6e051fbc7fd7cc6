//! `secant spectrum`: eigenvalues, multiplicities, Jordan blocks, chains and modulus classes of a matrix or of a case.

use super::output::{complain, print};
use super::{BAD_INPUT, PROVED, SpectrumArgs, UNDETERMINED};
use crate::approx::approximate_spectrum;
use crate::case::{Case, matrix_file};
use crate::diagnostic::Problem;
use crate::jordan::{BUDGET, Spectrum, estimated_work};
use crate::linalg::Matrix;
use crate::report::spectrum as report;
use std::path::Path;

/// Prints the spectra of a matrix file, or of all operators of a case that map a state into itself.
pub fn run(args: &SpectrumArgs) -> u8 {
    match matrices(&args.file) {
        Ok(found) => {
            let parts: Result<Vec<String>, Problem> = found.iter().map(|(name, m)| render(args, name, m)).collect();
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

fn matrices(path: &Path) -> Result<Vec<(String, Matrix)>, Problem> {
    if path.extension().is_some_and(|e| e == "toml") {
        let case = Case::read(path)?;
        let mut found = Vec::new();
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                found.push((format!("operator {letter} of state {}", state.name), piece.op.clone()));
            }
        }
        return Ok(found);
    }
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| {
        Problem::new("secant::input", format!("{name} cannot be read: {error}"))
            .with_help("name a text file with a matrix, or a case file")
    })?;
    let file = matrix_file::parse_named(&name, &text)?;
    if file.decimals > 0 {
        eprintln!("note: {} decimals were read as the exact fractions that they write", file.decimals);
    }
    Ok(vec![(name, file.matrix)])
}

fn render(args: &SpectrumArgs, name: &str, matrix: &Matrix) -> Result<String, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        return approximate_spectrum(&matrix).map(|s| report::approximate_text(&s)).map_err(|error| {
            Problem::new("secant::approx", error.to_string()).with_help("leave out --approx for the exact spectrum")
        });
    }
    if estimated_work(&matrix) > BUDGET {
        let message = format!("the exact spectrum of {name}, of size {}, is over the budget", matrix.rows());
        return Err(Problem::new("secant::limit", message).with_help("use --approx for a labelled approximation"));
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
