//! The command line: arguments, one file for each command, exit codes.

mod approximate;
mod certify;
mod explain;
mod many;
mod output;

use clap::{Args, Parser, Subcommand};
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
    /// Print a statement with its proof and reference.
    Explain {
        /// Its name, such as `theorem-2`; without it the names are listed.
        theorem: Option<String>,
    },
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
    /// Write a proof to a file: .md or .html.
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
        Command::Explain { theorem } => explain::run(theorem.as_deref()),
    };
    ExitCode::from(code)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
