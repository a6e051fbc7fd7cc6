//! The command line: arguments, one file for each command, exit codes.

mod approximate;
mod cards;
mod certify;
mod expand;
mod explain;
mod files;
#[cfg(feature = "strategies")]
mod fuzz;
mod gallery;
mod import;
mod init;
mod irrational;
mod jsr;
mod junction;
mod junction_surface;
mod manual;
mod many;
mod mesh;
mod output;
mod progress;
mod question;
mod refine;
mod region;
mod regularity;
mod render;
mod resume;
mod schemes;
mod solve;
mod spectrum;
#[cfg(feature = "studio")]
mod studio;

use crate::budget::{Budget, Effort};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::theorem::Required;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
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

/// A mistake in the program itself: there is no result.
pub const INTERNAL: u8 = 4;

const CODES: &str = "Exit codes: 0 proved, 1 refuted, 3 undetermined, 2 bad input, or something that was asked for \
                     and could not be written (the answer is printed all the same), 4 internal error. Of several cases: 4 if \
                     the program failed on one, otherwise 2 if one cannot be read, otherwise 1 if one is refuted, \
                     otherwise 3 if one is undetermined; the results of the others are printed all the same.";

/// Proves, in exact arithmetic, where self-similar shapes have tangents.
#[derive(Debug, Parser)]
#[command(name = "secant", version, about, after_help = CODES, max_term_width = 80)]
struct Cli {
    /// Whether colours are used: where people read, always, or never.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto", help_heading = "Everywhere")]
    color: output::Colour,
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
    Jsr(JsrArgs),
    /// The regularity of the subdivision scheme of a mask, from a joint spectral radius.
    Regularity(RegularityArgs),
    /// For which values of a parameter a scheme converges and is smooth: open intervals and single points, with exact ends.
    #[command(after_help = CODES)]
    Region(region::RegionArgs),
    /// List the named schemes, or write one as a case.
    Schemes {
        /// Its name; without it the schemes are listed.
        name: Option<String>,
        /// Its parameters, as in `degree=3`.
        parameters: Vec<String>,
        /// List the schemes as JSON.
        #[arg(long, conflicts_with = "name")]
        json: bool,
    },
    /// Write a case with every operator written out: what `[scheme]` stands for, and what the checker reads.
    Expand {
        /// Case files, or what stands for one, as for `certify`.
        #[arg(required = true, value_name = "CASE")]
        cases: Vec<PathBuf>,
        /// Write to a file instead of the standard output.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
        /// Print JSON: of each case its path, its name and its text.
        #[arg(long, conflicts_with = "output")]
        json: bool,
    },
    /// Write a file of another program (Fractint .ifs, JSON) as a case, with the convention it was read in.
    Import {
        /// The file.
        file: PathBuf,
        /// The entry of a Fractint file that has several.
        #[arg(long)]
        entry: Option<String>,
        /// Write to a file instead of the standard output.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Draw a case from exact points: SVG, PNG, OBJ or PLY.
    Render(render::RenderArgs),
    /// Solve the identities of a case for its unknown entries ("?"), exactly. Exit code 1: there is no solution.
    Solve(SolveArgs),
    /// Join two curve schemes by an intermediate curve, and write the joined shape as a case. Exit code 1: no member passes.
    Junction(junction::JunctionArgs),
    /// Refine a curve: its cells on points of their own, glued where they meet, as a case with the control points carried over.
    Refine(refine::RefineArgs),
    /// Print a statement with its proof and reference.
    Explain {
        /// Its name, such as `theorem-2`; without it the names are listed.
        theorem: Option<String>,
        /// Print it as JSON (docs/json.md).
        #[arg(long)]
        json: bool,
    },
    /// Print the JSON Schema of case files, for completion and checks in editors.
    Schema,
    /// Write a commented starter case.
    Init {
        /// Its name; NAME.toml is written to the current directory.
        name: String,
    },
    /// Certify all cases of a directory and write a page of pictures and verdicts, with reports of a selection or of all.
    Gallery(gallery::GalleryArgs),
    /// Hold verdicts on random cases against the laws that they obey; print the simplest case that breaks one (exit code 1).
    #[cfg(feature = "strategies")]
    Fuzz(fuzz::FuzzArgs),
    /// Open a page in the browser on which schemes, control points and cases can be changed and are proved at once; it is served
    /// by this program to this machine only, and needs no network.
    #[cfg(feature = "studio")]
    Studio(studio::StudioArgs),
    /// Print the completions for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print a manual page (roff), or write all of them.
    Man {
        /// The command; without it the page of the program.
        command: Option<String>,
        /// Write the pages of the program and of all commands to this directory.
        #[arg(long, value_name = "DIR", conflicts_with = "command")]
        out: Option<PathBuf>,
    },
}

impl Command {
    /// The same with each parameter `name=value` of `certify` joined to the scheme before it, and its files at their options.
    fn with_parameters(self) -> Result<Self, Problem> {
        Ok(match self {
            Self::Certify(args) => Self::Certify(args.with_parameters()?),
            other => other,
        })
    }
}

#[derive(Debug, Clone, Args)]
struct CertifyArgs {
    /// Case files, or what stands for one: `-` for the standard input, the name of a scheme with its parameters
    /// (four-point w=1/16), a mask ("1/4,3/4,3/4,1/4"), a symbol ("(1+z)^3/4"), a wavelet with a rational filter (bior2.2), the
    /// matrices of the pieces ("[[[1, 1/2], [0, 1/2]], [[1/2, 0], [1/2, 1]]]").
    #[arg(required = true, value_name = "CASE")]
    cases: Vec<PathBuf>,
    /// A parameter of the last case, the same as NAME=VALUE behind it.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<PathBuf>,
    /// Print the result as JSON (docs/json.md).
    #[arg(long, conflicts_with = "jsonl")]
    json: bool,
    /// Print one line of JSON for each case.
    #[arg(long)]
    jsonl: bool,
    /// Examine a further point: letters, and the repeated ones in brackets, as in `0(1)`; or a parameter of a curve, as in `1/3`
    /// or `0.5`.
    #[arg(long, visible_alias = "at", value_name = "ADDRESS")]
    address: Vec<String>,
    /// For a case with a `[vertex]` table: the valences, from 2 to 1024, as in `5`, `3..32`, `3,5,8` or `all`.
    #[arg(long, value_name = "VALENCES", conflicts_with_all = ["address", "approx"])]
    valence: Option<String>,
    /// For a mesh (.obj, .off, .ply): the scheme of its limit surface, catmull-clark, loop or loop-warren.
    #[arg(long, value_name = "NAME")]
    scheme: Option<String>,
    /// For a mesh with a border: its rule, edge (a spline curve) or edge-and-corner (vertices with one face stay fixed). It goes
    /// before what the tags of the file say.
    #[arg(long, value_name = "RULE")]
    boundary: Option<String>,
    /// For a mesh: write it as PLY, its vertices coloured by verdict.
    #[arg(long, value_name = "FILE")]
    ply: Option<PathBuf>,
    /// Write a file, which its ending says: a proof (.html, .md, .tex), a picture (.svg, .png), a mesh (.ply), a file for Coq (.v);
    /// may be given several times.
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Write a proof to a file: .html, .md or .tex.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// How much of the proof the report has: its first page, all of it, or all of it with nothing folded.
    #[arg(long, value_enum, default_value_t, value_name = "LEVEL")]
    report_level: ReportLevel,
    /// Draw the attractor with the tangents found.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// The same as PNG, without the words in the picture.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// The width of the picture in pixels.
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=8192))]
    size: Option<u32>,
    /// What --svg draws: the shape with its tangents, or the cones of Theorem 6 along a curve.
    #[arg(long, value_name = "WHAT", value_enum, default_value_t = Drawn::Shape, requires = "svg")]
    draw: Drawn,
    /// Write a certificate that secant-check proves again (docs/certificate.md).
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Write a file for Coq that states what was found at the points of a curve about its own matrices, and proves it by
    /// the formal theorems of proofs/.
    #[arg(long, value_name = "FILE.v")]
    coq: Option<PathBuf>,
    /// Do not have the verdict proved again by the checker before it is printed.
    #[arg(long)]
    no_check: bool,
    /// Keep the results and certificates of many cases in a directory, and skip the cases whose result there is up to
    /// date: same text of the case, same addresses and checks, same program; the checker proves its certificate again.
    #[arg(long, value_name = "DIR", conflicts_with = "approx")]
    resume: Option<PathBuf>,
    /// Take only the I-th of N parts of the cases: tasks 1 … N of a job array do all of them, each once.
    #[arg(long, value_name = "I/N", value_parser = question::shard, conflicts_with = "approx")]
    shard: Option<(usize, usize)>,
    /// What decides the exit code: a list of ends, joints, dense, points (those asked for), g1, c1, c2, …, or `tangents` for the
    /// first four; with `?` behind it a claim decides only where it is refuted.
    #[arg(long, value_name = "CLAIMS", value_parser = Required::parse, default_value = "ends,joints,dense,points,inside?", hide_default_value = false)]
    require: Required,
    /// How hard to try: which questions stay undetermined depends on it, never what an answer is.
    #[arg(long, value_name = "EFFORT", value_parser = question::effort, default_value = "normal")]
    effort: Effort,
    /// Cells into which the ring of a branch may be divided (normal: 6000).
    #[arg(long, value_name = "COUNT")]
    cells: Option<usize>,
    /// Words whose products may be formed to show contraction (normal: 20000).
    #[arg(long, value_name = "COUNT")]
    words: Option<usize>,
    /// Only compute in floating point: a quick look, never a proof (exit code 3).
    #[arg(long, conflicts_with_all = ["output", "report", "svg", "png", "certificate", "coq"])]
    approx: bool,
    /// Print nothing but problems; the exit code tells the verdict.
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Print whole spectra, rates and exponents.
    #[arg(short, long)]
    verbose: bool,
    /// Print the answers, the points and the verdict only.
    #[arg(long, conflicts_with_all = ["verbose", "quiet", "json", "jsonl"])]
    brief: bool,
}

impl CertifyArgs {
    /// The same with each parameter `name=value` joined to the scheme before it, and the files of `--output` at their options.
    fn with_parameters(mut self) -> Result<Self, Problem> {
        for path in std::mem::take(&mut self.output) {
            output::by_ending(
                path,
                &mut [
                    (&["html", "htm", "md", "tex"], &mut self.report),
                    (&["svg"], &mut self.svg),
                    (&["png"], &mut self.png),
                    (&["ply"], &mut self.ply),
                    (&["v"], &mut self.coq),
                ],
            )?;
        }
        if let Some(set) = self.set.iter().filter_map(|s| s.to_str()).find(|s| !question::is_parameter(s)) {
            return Err(Problem::new(
                "secant::usage::parameter",
                format!("--set {set}: a parameter gets its value by ="),
            )
            .with_help("write --set NAME=VALUE, as in --set w=1/16"));
        }
        self.cases.append(&mut self.set);
        Ok(Self { cases: question::joined(self.cases), ..self })
    }

    /// The budget that the options name.
    fn budget(&self) -> Budget {
        let mut budget = Budget::of(self.effort);
        budget.cells = self.cells.unwrap_or(budget.cells);
        budget.words = self.words.unwrap_or(budget.words);
        budget
    }
}

#[derive(Debug, Args)]
struct SpectrumArgs {
    /// Cases (.toml, or what stands for one, as for `certify`), text files with a square matrix (rows of numbers, MatrixMarket, or
    /// the literal of a computer algebra system), such a literal itself, or `-`.
    #[arg(required = true, value_name = "CASE|MATRIX")]
    files: Vec<PathBuf>,
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
    /// Write a certificate of the solutions that secant-check proves again (docs/certificate.md).
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    /// Print nothing but problems.
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

#[derive(Debug, Args)]
struct RegularityArgs {
    /// A case file (with a `[scheme]` or any curve), the name of a scheme, a wavelet (haar, db1 to db20, sym2 to sym20, bior2.2,
    /// rbio2.2, …), a mask such as "1/4,3/4,3/4,1/4", also with radicals or decimals, or a symbol such as "(1+z)^3/4". In two
    /// variables: a symbol such as "(1+x)^2*(1+y)^2/4", a file with a `[mask]`, box-spline, butterfly, four-eight, loop, sqrt3 or
    /// tensor.
    #[arg(allow_hyphen_values = true, value_name = "CASE")]
    what: String,
    /// Parameters of the scheme before, as in `w=1/16`, and further cases (after `--` also masks that begin with a minus sign).
    #[arg(value_name = "NAME=VALUE|CASE")]
    more: Vec<String>,
    /// The arity of masks and symbols.
    #[arg(long, default_value_t = 2)]
    arity: usize,
    /// The dilation of a symbol in several variables, such as "(1+x)^2*(1+y)^2/8": `[[1,1],[1,-1]]`, quincunx, sqrt3, or a whole
    /// number for a multiple of the unit matrix (2 where none is given).
    #[arg(long, value_name = "MATRIX", allow_hyphen_values = true)]
    dilation: Option<String>,
    /// Write a certificate of the orders of smoothness of the curve of a case file, or of a mask in several variables
    /// (docs/certificate.md).
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Print data; of several cases a list.
    #[arg(long, conflicts_with = "jsonl")]
    json: bool,
    /// Print a line of data for each case.
    #[arg(long)]
    jsonl: bool,
}

#[derive(Debug, Args)]
struct JsrArgs {
    /// Files with `matrices = [...]`, JSON, plain text, or matrices as NumPy prints them (docs/radius.md); `-` reads the standard
    /// input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print JSON; of several files a list.
    #[arg(long)]
    json: bool,
    /// Print a line of JSON for each file.
    #[arg(long, conflicts_with = "json")]
    jsonl: bool,
    /// Search for about this long, and no longer. Without it a fixed amount of work is spent, a few seconds at most, so that the
    /// same file gives the same bytes.
    #[arg(long, value_name = "SECONDS")]
    time: Option<f64>,
    /// The longest word of the search (16).
    #[arg(long, value_name = "LETTERS")]
    longest: Option<usize>,
    /// Stop when the bounds are this close, relatively (1e-11).
    #[arg(long, value_name = "WIDTH")]
    width: Option<f64>,
    /// Draw the invariant polytope (systems with a state of two dimensions).
    #[arg(long, value_name = "OUT")]
    svg: Option<PathBuf>,
    /// Write a certificate of the bounds that secant-check proves again (docs/certificate.md).
    #[arg(long, value_name = "OUT")]
    certificate: Option<PathBuf>,
}

/// How much of a proof a report has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
enum ReportLevel {
    /// The first page: statement, results, picture, verdict, digests.
    Summary,
    /// The whole proof.
    #[default]
    Proof,
    /// The whole proof with nothing folded.
    Full,
}

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Drawn {
    /// The shape with its control polygon and the limit rays.
    Shape,
    /// The cones that hold the secants of the cells.
    Cones,
}

/// Runs the program on the arguments of the process.
#[must_use]
pub fn main() -> ExitCode {
    // Also for the messages about the command line itself.
    let choice = output::Colour::of_arguments(std::env::args_os());
    output::choose(choice);
    let arguments = question::with_masks(std::env::args_os(), &Cli::command());
    let parsed =
        Cli::command().color(choice.of_help()).try_get_matches_from(arguments).and_then(|m| Cli::from_arg_matches(&m));
    let cli = match parsed {
        Ok(cli) => cli,
        Err(error) => {
            return ExitCode::from(output::explained(&error));
        }
    };
    output::choose(cli.color);
    let done = guarded(|| {
        let command = cli.command.with_parameters()?;
        files::keep_apart(&command)?;
        Ok(run(command))
    });
    ExitCode::from(output::finished(output::settle(done)))
}

fn run(command: Command) -> u8 {
    match command {
        Command::Certify(args) => certify::run(&args),
        Command::Spectrum(args) => spectrum::run(&SpectrumArgs { files: question::joined(args.files), ..args }),
        Command::Jsr(args) => jsr::jsr(&args),
        Command::Regularity(args) => regularity::run(&args),
        Command::Region(args) => region::run(&args),
        Command::Schemes { json: true, .. } => schemes::data(),
        Command::Schemes { name, parameters, .. } => schemes::run(name.as_deref(), &parameters),
        Command::Expand { cases, output, json } => expand::run(&question::joined(cases), output.as_deref(), json),
        Command::Import { file, entry, output } => import::run(&file, entry.as_deref(), output.as_deref()),
        Command::Render(args) => render::run(args),
        Command::Solve(args) => solve::run(&args),
        Command::Junction(args) => junction::run(&args),
        Command::Refine(args) => refine::run(&args),
        Command::Explain { theorem, json } => explain::run(theorem.as_deref(), json),
        Command::Schema => {
            output::print(&format!("{:#}\n", crate::case::schema()));
            PROVED
        }
        Command::Init { name } => init::run(&name),
        Command::Gallery(args) => gallery::run(&args),
        #[cfg(feature = "strategies")]
        Command::Fuzz(args) => fuzz::run(&args),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::run(&args),
        Command::Completions { shell } => completions(shell),
        Command::Man { command, out } => manual::run(command.as_deref(), out.as_deref()),
    }
}

fn completions(shell: clap_complete::Shell) -> u8 {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "secant", &mut text);
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
