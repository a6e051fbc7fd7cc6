//! `secant certify` of a single case.

use super::answered::{Answered, ONCE, answered, question};
use super::output::{complain, print, problem_code, stdout_colour, write_certificate, write_file};
use super::progress::{Progress, Waiting};
use super::{BAD_INPUT, CertifyArgs, Drawn, PROVED, REFUTED, ReportLevel, UNDETERMINED, approximate, many};
use crate::answer::Verdict;
use crate::case::{Case, Question, Valences};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::picture::characteristic::sheet;
use crate::prove::Findings;
use crate::report::document::Block;
use crate::report::proof::Level;
use crate::report::words::listed;
use crate::report::{figures, findings, html, json, latex, markdown, text, vertex as at_vertices};
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
    let done = guarded(|| {
        let answered = one(path, args)?;
        // A picture or a file that fails takes no verdict with it.
        let written = guarded(|| write_files(&answered, args));
        let shown = if args.quiet { String::new() } else { printed(&answered, args) };
        Ok((answered, shown, written))
    });
    match done {
        Ok((answered, shown, written)) => {
            if !args.quiet {
                note(&answered);
            }
            print(&shown);
            match written {
                Ok(()) => exit_code(answered.findings.verdict_on(&args.require)),
                Err(problem) => {
                    complain(&problem);
                    problem_code(&problem)
                }
            }
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

/// Reads and answers one case, with a sign of life.
fn one(path: &Path, args: &CertifyArgs) -> Result<Answered, Problem> {
    let question = question(path, args)?;
    let check = !args.no_check;
    if let Question::Vertices { valences: Some(Valences::List(list)), .. } = &question {
        let progress = Progress::of(list.len(), "valences", args.quiet);
        let found = answered(&question, check, &args.budget(), &|| progress.step());
        progress.finish();
        return found;
    }
    let waiting = Waiting::new(args.quiet);
    let found = answered(&question, check, &args.budget(), &|| {});
    waiting.finish();
    found
}

/// Says so where the verdict was not proved again, or a state plays no part.
fn note(answered: &Answered) {
    let Findings::Tangents { case, .. } = &answered.findings else { return };
    let mut why = match &answered.evidence {
        Some(Err(unsupported)) => vec![unsupported.to_string()],
        Some(Ok(certificate)) => certificate.left_out().iter().map(ToString::to_string).collect(),
        None => Vec::new(),
    };
    if !answered.once.is_empty() {
        why.insert(0, format!("{ONCE} {}", listed(&answered.once)));
    }
    if !why.is_empty() {
        note_unconfirmed(&why.join("; "));
    }
    note_dangling(case);
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
fn note_unconfirmed(why: &str) {
    let message = format!("not all verdicts were proved again: {why}");
    complain(
        &Problem::new("secant::certificate::none", message).with_help("see docs/certificate.md, “What is not covered”"),
    );
}

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
    for (option, path, other) in [("--svg", &args.svg, "png"), ("--png", &args.png, "svg")] {
        if let Some(path) = path.as_deref().filter(|p| extension(p) == other) {
            return Err(mistaken(option, path, other));
        }
    }
    args.report.as_deref().map_or(Ok(()), known_format)
}

/// Refuses a report whose ending names no format.
pub(super) fn known_format(path: &Path) -> Result<(), Problem> {
    if matches!(extension(path).as_str(), "md" | "html" | "htm" | "tex") {
        return Ok(());
    }
    Err(Problem::new("secant::usage::report", format!("no format is known for {}", path.display()))
        .with_help("the ending of --report says the format: .html, .md or .tex"))
}

/// A proof in the format that the ending of the path names.
pub(super) fn rendered(path: &Path, of: &Findings, level: Level) -> String {
    let document = findings::proof_at(of, level);
    match extension(path).as_str() {
        "md" => markdown::render(&document),
        "tex" => latex::render(&document),
        _ => html::render(&document),
    }
}

/// An option of one format with a file of another.
pub(super) fn mistaken(option: &str, path: &Path, other: &str) -> Problem {
    Problem::new("secant::usage::format", format!("{option} does not write {}", path.display()))
        .with_help(format!("write --{other} {}, or another ending", path.display()))
}

pub(super) fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Writes the report and the picture that were asked for; both are made before the first is written.
fn write_files(answered: &Answered, args: &CertifyArgs) -> Result<(), Problem> {
    let report = args.report.as_deref().map(|path| {
        let level = match args.report_level {
            ReportLevel::Summary => Level::Summary,
            ReportLevel::Proof => Level::Proof,
            ReportLevel::Full => Level::Full,
        };
        let written = rendered(path, &answered.findings, level);
        (path, written)
    });
    let svg = args.svg.as_deref().map(|path| Ok((path, picture(answered, args.draw)?))).transpose()?;
    let png = args.png.as_deref().map(|path| Ok((path, png(answered)?))).transpose()?;
    let proof = args.certificate.as_deref().map(|path| Ok((path, answered.certificate()?.text()))).transpose()?;
    for (path, content) in report.into_iter().chain(svg) {
        write_file(path, &content)?;
    }
    if let Some((path, content)) = proof {
        let case = match &answered.findings {
            Findings::Tangents { case, .. } => Some(case),
            Findings::Vertices { .. } => None,
        };
        write_certificate(path, content, case.and_then(|case| case.beside()))?;
    }
    if let Some((path, image)) = png {
        write_file(path, &image)?;
    }
    Ok(())
}

fn picture(answered: &Answered, what: Drawn) -> Result<String, Problem> {
    let (case, found) = match &answered.findings {
        Findings::Tangents { case, found } => (case, found),
        Findings::Vertices { case, found, .. } => {
            let panels: Vec<_> = found.iter().filter_map(at_vertices::panel).collect();
            return Ok(sheet(&panels, &case.title));
        }
    };
    match (what, figures::cones(case, found)) {
        (Drawn::Shape, _) => figures::attractor(case, found).map(|p| p.svg).ok_or_else(|| undrawn(&case.name)),
        (Drawn::Cones, Some(Block::Figure { svg, .. })) => Ok(svg),
        (Drawn::Cones, _) => {
            let message = format!("there are no cones to be drawn for {}", case.name);
            Err(Problem::new("secant::picture", message)
                .with_help("cones are found for curves that are G¹ or have corners only (Theorem 6); leave out --draw"))
        }
    }
}

fn png(answered: &Answered) -> Result<Vec<u8>, Problem> {
    match &answered.findings {
        Findings::Tangents { case, found } => figures::attractor_png(case, found).ok_or_else(|| undrawn(&case.name)),
        Findings::Vertices { .. } => {
            Err(Problem::new("secant::picture", "there is no PNG image of the vertices of a mesh")
                .with_help("--svg draws their characteristic maps"))
        }
    }
}

fn undrawn(name: &str) -> Problem {
    Problem::new("secant::picture", format!("{name} cannot be drawn"))
        .with_help("no point of the shape can be computed, because contraction is not decided")
}

fn printed(answered: &Answered, args: &CertifyArgs) -> String {
    if args.json || args.jsonl {
        let mut data = answered.json(&args.require);
        data["path"] = args.cases.first().map(|p| p.display().to_string()).into();
        return json_text(&data, args.json);
    }
    text::render(&findings::summary(&answered.findings, &args.require, args.verbose), stdout_colour())
}

/// A value as JSON text, indented or in one line.
#[must_use]
pub fn json_text(value: &serde_json::Value, indented: bool) -> String {
    if indented { format!("{value:#}\n") } else { format!("{value}\n") }
}
