//! `secant spectrum`: eigenvalues, multiplicities, Jordan blocks, chains and modulus classes of a matrix or of a case.

use super::files::Written;
use super::output::{print, remark, settle};
use super::progress::Waiting;
use super::{PROVED, SpectrumArgs, UNDETERMINED};
use crate::approx::{ApproxSpectrum, approximate_spectrum};
use crate::ask::{Entries, ExactSpectrum, Matrices, exact_spectrum};
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::report::{field_spectrum, spectrum as report};

/// Prints the spectra of a matrix file, or of all operators of a case that map a state into itself.
pub fn run(args: &SpectrumArgs) -> u8 {
    let code = if args.approx { UNDETERMINED } else { PROVED };
    let mut written = Written::default();
    settle(all(args, &mut written).map(|text| {
        print(&text);
        written.code(code)
    }))
}

/// The spectra of all files; of several matrices a list in JSON.
fn all(args: &SpectrumArgs, written: &mut Written) -> Result<String, Problem> {
    if args.certificate.is_some() && args.files.len() > 1 {
        return Err(Problem::new("secant::usage", "--certificate is for a single file")
            .with_help("write the certificates one by one"));
    }
    let mut parts = Vec::new();
    for path in &args.files {
        if args.files.len() > 1 && !args.json {
            parts.push(format!("== {}\n", path.display()));
        }
        parts.extend(rendered(args, &path.to_string_lossy(), written)?);
    }
    Ok(match (args.json, parts.as_slice()) {
        (true, [one]) => one.clone(),
        (true, _) => format!("[{}]\n", parts.iter().map(|p| p.trim_end()).collect::<Vec<_>>().join(",\n")),
        _ => parts.join("\n"),
    })
}

fn rendered(args: &SpectrumArgs, what: &str, written: &mut Written) -> Result<Vec<String>, Problem> {
    let input = Matrices::ask(what)?;
    if input.decimals > 0 {
        remark(&format!("note: {} decimals were read as the exact fractions that they write", input.decimals));
    }
    if args.approx {
        let parts = input.list.iter().map(|m| approximate(args, &m.entries).map(|s| report::approximate_text(&s)));
        return parts.collect();
    }
    let waiting = Waiting::with("computing the spectrum …", false);
    let one = |entries: &Entries, name: &str| match args.transpose {
        true => exact_spectrum(name, &transposed(entries)),
        false => exact_spectrum(name, entries),
    };
    let found: Result<Vec<ExactSpectrum>, Problem> = input.list.iter().map(|m| one(&m.entries, &m.name)).collect();
    waiting.finish();
    let found = found?;
    written.certificate(args.certificate.as_deref(), || Ok((input.certificate(&found)?, input.beside.clone())));
    Ok(found.iter().zip(&input.list).map(|(f, m)| render(args, f, what, &m.name)).collect())
}

fn transposed(entries: &Entries) -> Entries {
    match entries {
        Entries::Rational(matrix) => Entries::Rational(matrix.transpose()),
        Entries::Field(matrix) => Entries::Field(matrix.transpose()),
    }
}

fn approximate(args: &SpectrumArgs, entries: &Entries) -> Result<ApproxSpectrum, Problem> {
    let entries = if args.transpose { &transposed(entries) } else { entries };
    let spectrum = match entries {
        Entries::Rational(matrix) => approximate_spectrum(matrix),
        Entries::Field(matrix) => {
            let nearest = |i, j| matrix.field().enclosure(&matrix[(i, j)], 80).mid();
            approximate_spectrum(&Matrix::from_fn(matrix.rows(), matrix.cols(), nearest))
        }
    };
    spectrum.map_err(|error| {
        Problem::new("secant::approx", error.to_string()).with_help("leave out --approx for the exact spectrum")
    })
}

fn render(args: &SpectrumArgs, spectrum: &ExactSpectrum, what: &str, name: &str) -> String {
    match spectrum {
        found if args.json => {
            let mut data = found.json();
            (data["path"], data["name"]) = (what.into(), name.into());
            format!("{data:#}\n")
        }
        ExactSpectrum::Rational(spectrum) if args.latex => report::latex(spectrum),
        ExactSpectrum::Rational(spectrum) => format!("{name}\n{}", report::text(spectrum)),
        ExactSpectrum::Field(spectrum) if args.latex => field_spectrum::latex(spectrum),
        ExactSpectrum::Field(spectrum) => format!("{name}\n{}", field_spectrum::text(spectrum)),
    }
}
