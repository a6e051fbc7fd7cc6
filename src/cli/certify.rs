//! `secant certify` of a single case.

use super::output::{complain, print, problem_code, stdout_colour, write_file};
use super::progress::Waiting;
use super::{BAD_INPUT, CertifyArgs, Drawn, PROVED, REFUTED, UNDETERMINED, approximate, many};
use crate::arith::Rational;
use crate::case::{Case, MAX_LETTERS};
use crate::certificate::{Certificate, Doubt, Unsupported, certificate, confirm};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::report::document::Block;
use crate::report::math::Math;
use crate::report::{figures, html, json, latex, markdown, proof, summary, text};
use crate::shape::{Address, CurveError, Frame, word_text};
use crate::theorem::surface::certify_complex;
use crate::theorem::{Certified, ModelError, Verdict};
use std::path::Path;

/// The exit code of a verdict.
#[must_use]
pub fn exit_code(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Proved => PROVED,
        Verdict::Refuted => REFUTED,
        Verdict::Undetermined => UNDETERMINED,
    }
}

/// Certifies the cases and prints, draws and writes what was asked for.
pub fn run(args: &CertifyArgs) -> u8 {
    if let Err(problem) = check_arguments(args) {
        complain(&problem);
        return BAD_INPUT;
    }
    if args.approx {
        return approximate::run(args);
    }
    let path = match args.cases.as_slice() {
        [path] if args.resume.is_none() => path,
        _ => return many::run(args),
    };
    if args.valence.is_some() || super::vertex::is_about_vertices(path) {
        return super::vertex::run(path, args);
    }
    let waiting = Waiting::new(args.quiet);
    let certified = guarded(|| one(path, args));
    waiting.finish();
    let done = certified.and_then(|(case, found, evidence)| {
        write_files(&case, &found, evidence.as_ref(), args)?;
        if let (Some(Err(unsupported)), false) = (&evidence, args.quiet) {
            note_unconfirmed(unsupported);
        }
        Ok((case, found, evidence))
    });
    match done {
        Ok((case, found, evidence)) => {
            if !args.quiet {
                note_dangling(&case);
                print(&printed(&case, &found, evidence.as_ref(), args));
            }
            exit_code(found.verdict)
        }
        Err(problem) => {
            if args.json || args.jsonl {
                print(&json_text(&json::refusal(&path.display().to_string(), &problem), args.json));
            }
            complain(&problem);
            problem_code(&problem)
        }
    }
}

/// Says so where a state of the case plays no part.
fn note_dangling(case: &Case) {
    for state in case.dangling() {
        let message = format!("nothing leads to state `{}`, so it plays no part", case.shape.states[state].name);
        let help = "leave it out, or let a piece lead to it";
        complain(&case.problem_at_state(state, "secant::case::dangling", &message, help));
    }
}

/// Says so where a decided verdict has no certificate that could be checked.
fn note_unconfirmed(unsupported: &Unsupported) {
    let message = format!("the verdict was not proved again: {unsupported}");
    complain(
        &Problem::new("secant::certificate::none", message).with_help("see docs/certificate.md, “What is not covered”"),
    );
}

/// The certificate that the checker accepted, or why the format has none.
pub type Evidence = Result<Certificate, Unsupported>;

fn check_arguments(args: &CertifyArgs) -> Result<(), Problem> {
    let files = [&args.report, &args.svg, &args.png, &args.certificate];
    let of_one_case = args.json || files.iter().any(|f| f.is_some());
    if args.cases.len() > 1 && of_one_case {
        return Err(Problem::new(
            "secant::usage",
            "--json, --report, --svg, --png and --certificate are for a single case",
        )
        .with_help("use --jsonl for many cases, and write the reports one by one"));
    }
    if args.resume.is_some() && of_one_case {
        return Err(Problem::new(
            "secant::usage",
            "--json, --report, --svg, --png and --certificate do not go with --resume",
        )
        .with_help("--resume DIR keeps results and certificates in DIR; use --jsonl for data"));
    }
    let known = |path: &Path| matches!(extension(path).as_str(), "md" | "html" | "htm" | "tex");
    if let Some(path) = args.report.as_deref().filter(|p| !known(p)) {
        return Err(Problem::new("secant::usage::report", format!("no format is known for {}", path.display()))
            .with_help("the ending of --report says the format: .html, .md or .tex"));
    }
    Ok(())
}

pub(super) fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Reads and certifies one case, with the evidence where a decided verdict was to be checked.
///
/// # Errors
/// The [`Problem`] of the file, of an address, or of the model.
pub fn one(path: &Path, args: &CertifyArgs) -> Result<(Case, Certified, Option<Evidence>), Problem> {
    let (case, addresses) = read(path, args)?;
    let (found, evidence) = examined(&case, &addresses, args)?;
    Ok((case, found, evidence))
}

/// Certifies a case that was read, with the evidence where a decided verdict was to be checked.
///
/// # Errors
/// The [`Problem`] of the model, or of a certificate that the checker does not accept.
pub fn examined(
    case: &Case,
    addresses: &[Address],
    args: &CertifyArgs,
) -> Result<(Certified, Option<Evidence>), Problem> {
    let found = certify_complex(&case.complex(), addresses).map_err(|error| model_problem(case, &error))?;
    if args.no_check || found.verdict == Verdict::Undetermined {
        return Ok((found, None));
    }
    let evidence = match confirm(case, &found) {
        Ok(certificate) => Ok(certificate),
        Err(Doubt::Unsupported(unsupported)) => Err(unsupported),
        Err(doubt) => return Err(rejected(&case.name, &doubt)),
    };
    Ok((found, Some(evidence)))
}

/// A certificate that the checker does not accept.
pub fn rejected(case: &str, doubt: &Doubt) -> Problem {
    Problem::new("secant::certificate::rejected", format!("{case}: {doubt}"))
        .with_help("this is a mistake in secant: please report it with the case; --no-check leaves the check out")
}

/// Reads a case and the addresses asked for.
///
/// # Errors
/// The [`Problem`] of the file or of an address.
pub fn read(path: &Path, args: &CertifyArgs) -> Result<(Case, Vec<Address>), Problem> {
    let case = Case::read(path)?;
    let mut addresses = case.examine.clone();
    for text in &args.address {
        addresses.push(read_address(&case, text)?);
    }
    Ok((case, addresses))
}

fn read_address(case: &Case, text: &str) -> Result<Address, Problem> {
    let problem = |error: String| {
        Problem::new("secant::usage::address", error)
            .with_help("letters first, then the repeated letters in brackets: `0(1)` is 0111…")
    };
    let address = Address::parse(text).map_err(|e| problem(e.to_string()))?;
    if address.prefix.len() + address.cycle.len() > MAX_LETTERS {
        return Err(problem("the address is too long".to_owned()));
    }
    address.normalise(&case.shape, case.shape.start).map_err(|e| problem(e.to_string()))?;
    Ok(address)
}

/// Writes the report and the picture that were asked for; both are made before the first is written.
fn write_files(case: &Case, found: &Certified, evidence: Option<&Evidence>, args: &CertifyArgs) -> Result<(), Problem> {
    let report = args.report.as_deref().map(|path| {
        let document = proof::document(case, found);
        let written = match extension(path).as_str() {
            "md" => markdown::render(&document),
            "tex" => latex::render(&document),
            _ => html::render(&document),
        };
        (path, written)
    });
    let svg = match args.svg.as_deref() {
        None => None,
        Some(path) => Some((path, picture(case, found, args.draw)?)),
    };
    let png = match args.png.as_deref() {
        None => None,
        Some(path) => Some((path, figures::attractor_png(case, found).ok_or_else(|| undrawn(case))?)),
    };
    let proof = match args.certificate.as_deref() {
        None => None,
        Some(path) => {
            let written = evidence.cloned().unwrap_or_else(|| certificate(case, found)).map_err(|unsupported| {
                Problem::new("secant::certificate::none", unsupported.to_string())
                    .with_help("see docs/certificate.md, “What is not covered”; nothing was written")
            })?;
            Some((path, written.text()))
        }
    };
    for (path, content) in report.into_iter().chain(svg).chain(proof) {
        write_file(path, &content)?;
    }
    if let Some((path, image)) = png {
        write_file(path, &image)?;
    }
    Ok(())
}

fn picture(case: &Case, found: &Certified, what: Drawn) -> Result<String, Problem> {
    match (what, figures::cones(case, found)) {
        (Drawn::Shape, _) => figures::attractor(case, found).map(|p| p.svg).ok_or_else(|| undrawn(case)),
        (Drawn::Cones, Some(Block::Figure { svg, .. })) => Ok(svg),
        (Drawn::Cones, _) => {
            let message = format!("there are no cones to be drawn for {}", case.name);
            Err(Problem::new("secant::picture", message)
                .with_help("cones are found for curves that are G¹ or have corners only (Theorem 6); leave out --draw"))
        }
    }
}

fn undrawn(case: &Case) -> Problem {
    Problem::new("secant::picture", format!("{} cannot be drawn", case.name))
        .with_help("no point of the shape can be computed, because contraction is not decided")
}

fn printed(case: &Case, found: &Certified, evidence: Option<&Evidence>, args: &CertifyArgs) -> String {
    if args.json || args.jsonl {
        return json_text(&check_json(json::report(case, found), evidence), args.json);
    }
    text::render(&summary::summary(case, found, args.verbose), stdout_colour())
}

/// What [`check_json`] says where there is no evidence.
pub const NOT_ASKED: &str = "the checker was not asked";

/// A report with what the checker said of the certificate.
#[must_use]
pub fn check_json(mut report: serde_json::Value, evidence: Option<&Evidence>) -> serde_json::Value {
    let why = match evidence {
        Some(Ok(_)) => None,
        Some(Err(unsupported)) => Some(unsupported.to_string()),
        None => Some(NOT_ASKED.to_owned()),
    };
    report["certificate"] = serde_json::json!({"checked": why.is_none(), "why": why});
    report
}

/// A value as JSON text, indented or in one line.
#[must_use]
pub fn json_text(value: &serde_json::Value, indented: bool) -> String {
    if indented { format!("{value:#}\n") } else { format!("{value}\n") }
}
