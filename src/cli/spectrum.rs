//! `secant spectrum`: eigenvalues, multiplicities, Jordan blocks, chains and modulus classes of a matrix or of a case.

use super::output::{complain, print, write_file};
use super::{BAD_INPUT, PROVED, SpectrumArgs, UNDETERMINED};
use crate::approx::{ApproxSpectrum, approximate_spectrum};
use crate::case::{Case, matrix_file};
use crate::certificate::{self, Doubt, Operator};
use crate::diagnostic::Problem;
use crate::jordan::{BUDGET, Spectrum, estimated_work};
use crate::linalg::Matrix;
use crate::report::spectrum as report;
use std::path::Path;

/// What a file gives: named matrices, of a case each with its state and piece, and the text and name for a certificate.
struct Input {
    matrices: Vec<(String, Matrix, Option<(usize, usize)>)>,
    text: String,
    name: String,
    plain: bool,
}

/// Prints the spectra of a matrix file, or of all operators of a case that map a state into itself.
pub fn run(args: &SpectrumArgs) -> u8 {
    match matrices(&args.file) {
        Ok(found) => {
            let spectra: Result<Vec<Found>, Problem> =
                found.matrices.iter().map(|(n, m, _)| find(args, n, m)).collect();
            let parts = spectra.and_then(|spectra| {
                if let Some(path) = args.certificate.as_deref() {
                    write_certificate(path, &found, &spectra)?;
                }
                Ok(spectra.iter().zip(&found.matrices).map(|(s, (name, ..))| s.render(args, name)).collect::<Vec<_>>())
            });
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

fn matrices(path: &Path) -> Result<Input, Problem> {
    if path.extension().is_some_and(|e| e == "toml") {
        let case = Case::read(path)?;
        let mut matrices = Vec::new();
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                let name = format!("operator {letter} of state {}", state.name);
                matrices.push((name, piece.op.clone(), Some((index, letter))));
            }
        }
        return Ok(Input { matrices, text: case.checked_text().to_string(), name: case.name, plain: true });
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
    let plain = file.format == matrix_file::Format::Plain;
    Ok(Input { matrices: vec![(name, file.matrix, None)], text, name: "matrix".to_owned(), plain })
}

enum Found {
    Exact(Box<Spectrum>),
    Approximate(ApproxSpectrum),
}

fn find(args: &SpectrumArgs, name: &str, matrix: &Matrix) -> Result<Found, Problem> {
    let matrix = if args.transpose { matrix.transpose() } else { matrix.clone() };
    if args.approx {
        return approximate_spectrum(&matrix).map(Found::Approximate).map_err(|error| {
            Problem::new("secant::approx", error.to_string()).with_help("leave out --approx for the exact spectrum")
        });
    }
    if estimated_work(&matrix) > BUDGET {
        let message = format!("the exact spectrum of {name}, of size {}, is over the budget", matrix.rows());
        return Err(Problem::new("secant::limit", message).with_help("use --approx for a labelled approximation"));
    }
    Ok(Found::Exact(Box::new(Spectrum::of(&matrix))))
}

impl Found {
    fn render(&self, args: &SpectrumArgs, name: &str) -> String {
        match self {
            Self::Approximate(spectrum) => report::approximate_text(spectrum),
            Self::Exact(spectrum) if args.json => format!("{:#}\n", report::json(spectrum)),
            Self::Exact(spectrum) if args.latex => report::latex(spectrum),
            Self::Exact(spectrum) => format!("{name}\n{}", report::text(spectrum)),
        }
    }
}

/// Writes the certificate after the checker has accepted it.
fn write_certificate(path: &Path, input: &Input, spectra: &[Found]) -> Result<(), Problem> {
    let none = |message: String, help: &str| Problem::new("secant::certificate::none", message).with_help(help);
    if !input.plain {
        let help = "write the matrix as plain text: n, then n rows of n numbers";
        return Err(none("certificates are about plain matrices and cases only".to_owned(), help));
    }
    let mut operators = Vec::new();
    for (found, (.., place)) in spectra.iter().zip(&input.matrices) {
        if let Found::Exact(spectrum) = found {
            operators.push(Operator { place: *place, spectrum });
        }
    }
    let written = certificate::spectra(&input.name, &operators).map_err(Doubt::from);
    let accepted = written.and_then(|c| certificate::checked(&input.text, c));
    let accepted = accepted.map_err(|doubt| none(doubt.to_string(), "see docs/certificate.md; nothing was written"))?;
    write_file(path, &accepted.text())
}
