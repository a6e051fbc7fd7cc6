//! The command line: arguments, one file for each command, exit codes.

mod approximate;
mod certify;
mod expand;
mod explain;
mod gallery;
mod init;
mod many;
mod output;
mod progress;
mod radius;
mod schemes;
mod solve;
mod spectrum;

use clap::{Args, CommandFactory, Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Everything was proved.
pub const PROVED: u8 = 0;
/// Something was refuted.
pub const REFUTED: u8 = 1;
/// The input or the command line is wrong.
pub const BAD_INPUT: u8 = 2;
/// Something is neither proved nor refuted.
pub const UNDETERMINED: u8 = 3;

const CODES: &str = "Exit codes: 0 proved, 1 refuted, 3 undetermined, 2 bad input. Of several cases: 2 if one cannot be read, \
                     otherwise 1 if one is refuted, otherwise 3 if one is undetermined.";

/// Proves, in exact arithmetic, where self-similar shapes have tangents.
#[derive(Debug, Parser)]
#[command(name = "secant", version, about, after_help = CODES, max_term_width = 80)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Certify a case: prove or refute tangents at its end points, its joints, and a dense set.
    #[command(after_help = CODES)]
    Certify(CertifyArgs),
    /// Print the exact spectrum of a matrix, or of the operators of a case.
    Spectrum(SpectrumArgs),
    /// Bound the joint spectral radius of the matrices of a file (docs/radius.md).
    Jsr {
        /// A TOML file with `matrices = [...]`.
        file: PathBuf,
    },
    /// The regularity of the subdivision scheme of a mask, from a joint spectral radius.
    Regularity(RegularityArgs),
    /// List the named schemes, or write one as a case.
    Schemes {
        /// Its name; without it the schemes are listed.
        name: Option<String>,
        /// Its parameters, as in `degree=3`.
        parameters: Vec<String>,
    },
    /// Write a case with every operator written out: what `[scheme]` stands for, and what the checker reads.
    Expand {
        /// The case file; `-` reads the standard input.
        case: PathBuf,
        /// Write to a file instead of the standard output.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Solve the identities of a case for its unknown entries ("?"), exactly. Exit code 1: there is no solution.
    Solve(SolveArgs),
    /// Print a statement with its proof and reference.
    Explain {
        /// Its name, such as `theorem-2`; without it the names are listed.
        theorem: Option<String>,
    },
    /// Write a commented starter case.
    Init {
        /// Its name; NAME.toml is written to the current directory.
        name: String,
    },
    /// Certify all cases of a directory and write a page of pictures and verdicts, with a report for each.
    Gallery(GalleryArgs),
    /// Print the completions for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page (roff).
    Man,
}

#[derive(Debug, Args)]
struct CertifyArgs {
    /// Case files; `-` reads the standard input.
    #[arg(required = true, value_name = "CASE")]
    cases: Vec<PathBuf>,
    /// Print the result as JSON (docs/json.md).
    #[arg(long, conflicts_with = "jsonl")]
    json: bool,
    /// Print one line of JSON for each case.
    #[arg(long)]
    jsonl: bool,
    /// Examine a further point: letters, and the repeated ones in brackets, as in `0(1)`.
    #[arg(long, value_name = "ADDRESS")]
    address: Vec<String>,
    /// Write a proof to a file: .html, .md or .tex.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Draw the attractor with the tangents found.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write a certificate that secant-check proves again (docs/certificate.md).
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Do not have the verdict proved again by the checker before it is printed.
    #[arg(long)]
    no_check: bool,
    /// Only compute in floating point: a quick look, never a proof (exit code 3).
    #[arg(long, conflicts_with_all = ["report", "svg", "certificate"])]
    approx: bool,
    /// Print nothing but problems; the exit code tells the verdict.
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Print whole spectra, rates and exponents.
    #[arg(short, long)]
    verbose: bool,
}

#[derive(Debug, Args)]
struct SpectrumArgs {
    /// A case (.toml), or a text file with a square matrix (rows of rationals, MatrixMarket, or the literal of a computer
    /// algebra system).
    file: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    /// Print LaTeX.
    #[arg(long, conflicts_with = "json")]
    latex: bool,
    /// Take the transpose.
    #[arg(long)]
    transpose: bool,
    /// Write a certificate that secant-check proves again (docs/certificate.md), of a case or a plain matrix.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["approx", "transpose"])]
    certificate: Option<PathBuf>,
    /// Only compute in floating point: labelled approximate (exit code 3).
    #[arg(long, conflicts_with_all = ["json", "latex"])]
    approx: bool,
}

#[derive(Debug, Args)]
struct SolveArgs {
    /// A case with unknown entries; `-` reads the standard input.
    case: PathBuf,
    /// Write the solved case to a file.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Give a free parameter a value in the case that is written; the others are 0.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    /// Print nothing but problems.
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

#[derive(Debug, Args)]
struct RegularityArgs {
    /// The mask: coefficients such as "1/4,3/4,3/4,1/4", or the symbol such as "(1+z)^3/4".
    #[arg(allow_hyphen_values = true)]
    mask: String,
    /// The arity of the scheme.
    #[arg(long, default_value_t = 2)]
    arity: usize,
}

#[derive(Debug, Args)]
struct GalleryArgs {
    /// The directory with the families of cases.
    #[arg(default_value = "cases", value_name = "CASES")]
    cases: PathBuf,
    /// Where the page is written.
    #[arg(long, default_value = "docs/gallery", value_name = "DIR")]
    out: PathBuf,
    /// Write nothing; fail if the page is not what it would be.
    #[arg(long)]
    check: bool,
}

/// Runs the program on the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let code = if error.use_stderr() { BAD_INPUT } else { PROVED };
            let _ = error.print();
            return ExitCode::from(code);
        }
    };
    let code = match cli.command {
        Command::Certify(args) => certify::run(&args),
        Command::Spectrum(args) => spectrum::run(&args),
        Command::Jsr { file } => radius::jsr(&file),
        Command::Regularity(args) => radius::mask(&args),
        Command::Schemes { name, parameters } => schemes::run(name.as_deref(), &parameters),
        Command::Expand { case, output } => expand::run(&case, output.as_deref()),
        Command::Solve(args) => solve::run(&args),
        Command::Explain { theorem } => explain::run(theorem.as_deref()),
        Command::Init { name } => init::run(&name),
        Command::Gallery(args) => gallery::run(&args),
        Command::Completions { shell } => completions(shell),
        Command::Man => man(),
    };
    ExitCode::from(code)
}

fn completions(shell: clap_complete::Shell) -> u8 {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "secant", &mut text);
    output::print(&String::from_utf8_lossy(&text));
    PROVED
}

fn man() -> u8 {
    let mut text = Vec::new();
    // Writing to memory does not fail.
    let _ = clap_mangen::Man::new(Cli::command()).render(&mut text);
    output::print(&String::from_utf8_lossy(&text));
    PROVED
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
