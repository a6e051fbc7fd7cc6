//! `secant certify` of a single case.

use super::files::Written;
use super::output::{complain, print, problem_code, say, settle, shown, to_stdout};
use super::progress::{Progress, Waiting};
use super::question::question;
use super::{BAD_INPUT, CertifyArgs, Drawn, PROVED, REFUTED, ReportLevel, UNDETERMINED, approximate, many, mesh};
use crate::answer::Verdict;
use crate::ask::{Answered, ONCE, answered};
use crate::case::{Case, Question, Valences};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::mesh::is_mesh;
use crate::picture::{PIXELS, resized};
use crate::prove::Findings;
use crate::report::proof::Level;
use crate::report::words::{self, listed};
use crate::report::{findings, html, json, latex, markdown};
use crate::scheme::Normalisation;
use std::path::{Path, PathBuf};

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
    if let [path] = args.cases.as_slice()
        && is_mesh(path)
    {
        return settle(guarded(|| mesh::run(path, args)));
    }
    if args.approx {
        return approximate::run(args);
    }
    let path = match args.cases.as_slice() {
        [path] if args.resume.is_none() && args.shard.is_none() => path,
        _ => return many::run(args),
    };
    let done = guarded(|| {
        let piped = to_stdout([&args.report, &args.svg, &args.png, &args.certificate, &args.coq])?;
        let answered = one(path, args)?;
        // A picture or a file that fails takes no verdict with it.
        let written = write_files(&answered, args);
        let shown = if args.quiet { String::new() } else { printed(&answered, args) };
        Ok((answered, shown, written, piped))
    });
    match done {
        Ok((answered, shown, written, piped)) => {
            if !args.quiet {
                note(&answered);
            }
            say(&shown, piped);
            written.code(exit_code(answered.findings.verdict_on(&args.require)))
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
    if matches!(answered.findings, Findings::Vertices { .. }) {
        return;
    }
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
    match &answered.findings {
        Findings::Tangents { case, .. } => {
            note_dangling(case);
            note_filter(case.taken, &case.name);
        }
        Findings::OverField { case, .. } => note_filter(case.taken, &case.name),
        Findings::Vertices { .. } => {}
    }
}

/// Says so where a filter was read in another normalisation than it names.
fn note_filter(taken: Option<Normalisation>, name: &str) {
    if let Some(taken) = taken {
        let word = taken.word();
        let message =
            format!("{name}: the sums of the filter are those of normalisation = \"{word}\", which was taken");
        complain(
            &Problem::new("secant::case::normalisation", message)
                .with_help(format!("write normalisation = \"{word}\", or correct the coefficients")),
        );
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
fn note_unconfirmed(why: &str) {
    let message = format!("not all verdicts were proved again: {why}");
    complain(
        &Problem::new("secant::certificate::none", message).with_help("see docs/certificate.md, “What is not covered”"),
    );
}

fn check_arguments(args: &CertifyArgs) -> Result<(), Problem> {
    let mesh = args.cases.iter().any(|path| is_mesh(path));
    if mesh && args.cases.len() > 1 {
        return Err(Problem::new("secant::usage", "a mesh is certified by itself")
            .with_help("give one mesh at a time, with its --scheme"));
    }
    let with_value = |path: &&PathBuf| {
        path.to_str()
            .and_then(|text| text.split_once(char::is_whitespace))
            .is_some_and(|(file, _)| is_mesh(Path::new(file)))
    };
    if let Some(path) = args.cases.iter().find(with_value) {
        return Err(Problem::new("secant::usage", format!("{}: a mesh has no parameters", path.display())).with_help(
            "leave out NAME=VALUE and --set; weights of a rule are parameters of a case with a [vertex] table",
        ));
    }
    if let Some(option) =
        [(args.scheme.is_some(), "--scheme"), (args.ply.is_some(), "--ply"), (args.boundary.is_some(), "--boundary")]
            .iter()
            .find(|o| o.0 && !mesh)
    {
        return Err(Problem::new("secant::usage", format!("{} is for a mesh", option.1))
            .with_help("a mesh is a file that ends in .obj, .off or .ply"));
    }
    let files = [&args.report, &args.svg, &args.png, &args.certificate, &args.coq];
    let of_one_case = args.json || files.iter().any(|f| f.is_some());
    if (args.cases.len() > 1 || args.shard.is_some()) && of_one_case {
        return Err(Problem::new(
            "secant::usage",
            "--json, --report, --svg, --png, --certificate and --coq are for a single case",
        )
        .with_help("use --jsonl for many cases, and write the reports one by one"));
    }
    if args.resume.is_some() && of_one_case {
        return Err(Problem::new(
            "secant::usage",
            "--json, --report, --svg, --png, --certificate and --coq do not go with --resume",
        )
        .with_help("--resume DIR keeps results and certificates in DIR; use --jsonl for data"));
    }
    for (option, path, other) in [("--svg", &args.svg, "png"), ("--png", &args.png, "svg")] {
        if let Some(path) = path.as_deref().filter(|p| extension(p) == other) {
            return Err(mistaken(option, path, other));
        }
    }
    if let Some((_, parts)) = args.shard.filter(|(_, parts)| *parts > args.cases.len()) {
        let message = format!("--shard: {parts} parts of {}", words::count(args.cases.len(), "case"));
        return Err(
            Problem::new("secant::usage::shard", message).with_help("a part has one case at least: take fewer parts")
        );
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

/// Writes what was asked for, each file for itself.
fn write_files(answered: &Answered, args: &CertifyArgs) -> Written {
    let level = match args.report_level {
        ReportLevel::Summary => Level::Summary,
        ReportLevel::Proof => Level::Proof,
        ReportLevel::Full => Level::Full,
    };
    let mut written = Written::default();
    written.file(args.report.as_deref(), |path| Ok(rendered(path, &answered.findings, level)));
    written.file(args.svg.as_deref(), |_| picture(answered, args));
    written.file(args.png.as_deref(), |_| answered.bitmap(args.size.unwrap_or(PIXELS)));
    written.file(args.coq.as_deref(), |_| replay(&answered.findings));
    written.certificate(args.certificate.as_deref(), || {
        let beside = match &answered.findings {
            Findings::Tangents { case, .. } => case.beside(),
            Findings::OverField { case, .. } => case.flat.clone(),
            Findings::Vertices { .. } => None,
        };
        Ok((answered.certificate()?.text(), beside))
    });
    written
}

/// The picture, as wide as was asked for.
fn picture(answered: &Answered, args: &CertifyArgs) -> Result<String, Problem> {
    let svg = answered.picture(args.draw == Drawn::Cones)?;
    Ok(args.size.map_or(svg.clone(), |width| resized(&svg, width)))
}

/// The file for Coq.
fn replay(findings: &Findings) -> Result<String, Problem> {
    let help = "see proofs/README.md, “What is not formalised”; no file for Coq was written";
    match findings {
        Findings::Tangents { case, found } => crate::replay::coq(case, found)
            .map_err(|missing| Problem::new("secant::coq::none", missing.to_string()).with_help(help)),
        Findings::OverField { case, .. } => {
            let message = format!("no formal theorem of proofs/ covers irrational entries ({})", case.name);
            Err(Problem::new("secant::coq::none", message).with_help(help))
        }
        Findings::Vertices { case, .. } => {
            let message = format!("no formal theorem of proofs/ covers the vertices of a mesh ({})", case.name);
            Err(Problem::new("secant::coq::none", message).with_help(help))
        }
    }
}

fn printed(answered: &Answered, args: &CertifyArgs) -> String {
    if args.json || args.jsonl {
        let mut data = answered.json(&args.require, args.verbose);
        data["path"] = args.cases.first().map(|p| p.display().to_string()).into();
        return json_text(&data, args.json);
    }
    shown(&match args.brief {
        true => findings::brief(&answered.findings, &args.require),
        false => findings::summary(&answered.findings, &args.require, args.verbose),
    })
}

/// A value as JSON text, indented or in one line.
#[must_use]
pub fn json_text(value: &serde_json::Value, indented: bool) -> String {
    if indented { format!("{value:#}\n") } else { format!("{value}\n") }
}
