//! `secant certify` of several cases: in parallel, printed in the order given.

use super::certify::{Evidence, check_json, exit_code, json_text, one};
use super::output::{complain, print, stdout_colour};
use super::progress::Progress;
use super::{BAD_INPUT, CertifyArgs, PROVED, REFUTED, UNDETERMINED};
use crate::case::Case;
use crate::diagnostic::Problem;
use crate::report::document::{Block, Document, Inline, Line, Table, Tone, words};
use crate::report::{json, text, words as phrases};
use crate::theorem::{Certified, Verdict};
use rayon::prelude::*;

type Outcome = Result<(Case, Certified, Option<Evidence>), Problem>;

/// Certifies all cases; the exit code is the gravest.
pub fn run(args: &CertifyArgs) -> u8 {
    let progress = Progress::new(args.cases.len(), args.quiet);
    let outcomes: Vec<Outcome> = args
        .cases
        .par_iter()
        .map(|path| {
            let outcome = one(path, args);
            progress.step();
            outcome
        })
        .collect();
    progress.finish();
    let names: Vec<String> = args.cases.iter().map(|p| p.display().to_string()).collect();
    if args.jsonl {
        for (name, outcome) in names.iter().zip(&outcomes) {
            let value = match outcome {
                Ok((case, found, evidence)) => check_json(json::report(case, found), evidence.as_ref()),
                Err(problem) => json::refusal(name, problem),
            };
            print(&json_text(&value, false));
        }
    } else if !args.quiet {
        print(&text::render(&table(&names, &outcomes), stdout_colour()));
    }
    for problem in outcomes.iter().filter_map(|o| o.as_ref().err()) {
        complain(problem);
    }
    gravest(outcomes.iter().map(|o| o.as_ref().map_or(BAD_INPUT, |(_, found, _)| exit_code(found.verdict))))
}

fn gravest(codes: impl Iterator<Item = u8>) -> u8 {
    let codes: Vec<u8> = codes.collect();
    [BAD_INPUT, REFUTED, UNDETERMINED].into_iter().find(|c| codes.contains(c)).unwrap_or(PROVED)
}

fn table(names: &[String], outcomes: &[Outcome]) -> Document {
    let row = |(name, outcome): (&String, &Outcome)| -> Vec<Line> {
        match outcome {
            Ok((case, found, evidence)) => {
                let kinds: Vec<String> = kinds(found);
                let mark = vec![phrases::mark(found.verdict)];
                vec![words(case.name.clone()), mark, words(checked(evidence.as_ref())), words(kinds.join(", "))]
            }
            Err(problem) => {
                let mark = vec![Inline::Mark(Tone::Bad, "refused".to_owned())];
                vec![words(stem(name)), mark, words("–"), words(problem.message().to_owned())]
            }
        }
    };
    let table = Table {
        caption: Line::new(),
        header: vec![words("Case"), words("Verdict"), words("Checked"), words("Points")],
        rows: names.iter().zip(outcomes).map(row).collect(),
    };
    let count = |code: u8| {
        outcomes.iter().filter(|o| o.as_ref().map_or(BAD_INPUT, |(_, f, _)| exit_code(f.verdict)) == code).count()
    };
    let unchecked = outcomes.iter().flatten();
    let unchecked =
        unchecked.filter(|(_, f, e)| f.verdict != Verdict::Undetermined && !matches!(e, Some(Ok(_)))).count();
    let unchecked = match unchecked {
        0 => String::new(),
        n => format!(" {} decided but not proved again by the checker.", phrases::count(n, "case")),
    };
    let total = format!(
        "{}: {} proved, {} refuted, {} undetermined, {} refused.{unchecked}",
        phrases::count(outcomes.len(), "case"),
        count(PROVED),
        count(REFUTED),
        count(UNDETERMINED),
        count(BAD_INPUT)
    );
    Document { title: "secant certify".to_owned(), blocks: vec![Block::Table(table), Block::Paragraph(words(total))] }
}

/// What the checker said of the certificate of a case.
fn checked(evidence: Option<&Evidence>) -> &'static str {
    match evidence {
        Some(Ok(_)) => "yes",
        Some(Err(_)) => "no rule",
        None => "–",
    }
}

/// The name of the file without directory and ending.
fn stem(path: &str) -> String {
    std::path::Path::new(path).file_stem().map_or_else(|| path.to_owned(), |s| s.to_string_lossy().into_owned())
}

/// The kinds of the examined points, each with its number.
pub fn kinds(found: &Certified) -> Vec<String> {
    let mut counted: Vec<(&str, usize)> = Vec::new();
    for point in &found.points {
        let word = if point.kind == crate::theorem::Kind::None { "no tangent" } else { point.kind.word() };
        let word = match point.verdict {
            Verdict::Undetermined => "undetermined",
            _ => word,
        };
        match counted.iter_mut().find(|(w, _)| *w == word) {
            Some((_, n)) => *n += 1,
            None => counted.push((word, 1)),
        }
    }
    counted.into_iter().map(|(w, n)| if n == 1 { w.to_owned() } else { format!("{n} {w}") }).collect()
}
