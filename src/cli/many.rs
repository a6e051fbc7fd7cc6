//! `secant certify` of several cases: in parallel, printed in the order given, and resumed where results were kept.

use super::certify::{Evidence, NOT_ASKED, check_json, examined, exit_code, json_text, read};
use super::output::{complain, print, stdout_colour};
use super::progress::Progress;
use super::resume::{Kept, Store};
use super::{BAD_INPUT, CertifyArgs, PROVED, REFUTED, UNDETERMINED};
use crate::case::VertexCase;
use crate::diagnostic::Problem;
use crate::report::document::{Block, Document, Inline, Line, Table, Tone, words};
use crate::report::{json, text, vertex as report, words as phrases};
use crate::theorem::{Certified, Verdict};
use crate::vertex::Again;
use rayon::prelude::*;
use serde_json::Value;
use std::path::Path;

/// What is printed of a case.
struct Done {
    name: String,
    verdict: Verdict,
    kinds: String,
    /// What the checker said of the certificate.
    checked: Checked,
    json: Value,
    /// Whether the result was kept from an earlier run.
    kept: bool,
}

/// Whether the checker proved a verdict again.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Checked {
    Yes,
    NoRule,
    NotAsked,
}

impl Checked {
    /// As [`check_json`] says it; `None` where a report does not say it.
    fn of(report: &Value) -> Option<Self> {
        let said = &report["certificate"];
        Some(match (said["checked"].as_bool()?, said["why"].as_str()) {
            (true, None) => Self::Yes,
            (false, Some(NOT_ASKED)) => Self::NotAsked,
            (false, Some(_)) => Self::NoRule,
            _ => return None,
        })
    }

    fn word(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::NoRule => "no rule",
            Self::NotAsked => "–",
        }
    }
}

type Outcome = Result<Done, Problem>;

/// Certifies all cases; the exit code is the gravest.
pub fn run(args: &CertifyArgs) -> u8 {
    let store = match args.resume.as_deref().map(|dir| Store::open(dir, args)).transpose() {
        Ok(store) => store,
        Err(problem) => {
            complain(&problem);
            return BAD_INPUT;
        }
    };
    let progress = Progress::new(args.cases.len(), args.quiet);
    let outcomes: Vec<Outcome> = args
        .cases
        .par_iter()
        .map(|path| {
            let outcome = case(path, args, store.as_ref());
            progress.step();
            outcome
        })
        .collect();
    progress.finish();
    let names: Vec<String> = args.cases.iter().map(|p| p.display().to_string()).collect();
    if args.jsonl {
        for (name, outcome) in names.iter().zip(&outcomes) {
            match outcome {
                Ok(done) => print(&json_text(&done.json, false)),
                Err(problem) => print(&json_text(&json::refusal(name, problem), false)),
            }
        }
    } else if !args.quiet {
        print(&text::render(&table(&names, &outcomes), stdout_colour()));
    }
    for problem in outcomes.iter().filter_map(|o| o.as_ref().err()) {
        complain(problem);
    }
    gravest(outcomes.iter().map(|o| o.as_ref().map_or(BAD_INPUT, |done| exit_code(done.verdict))))
}

/// One case: from the store where its result is up to date, otherwise certified and stored.
fn case(path: &Path, args: &CertifyArgs, store: Option<&Store>) -> Outcome {
    if super::vertex::is_about_vertices(path) {
        return about_vertices(path, args.no_check);
    }
    let (case, addresses) = read(path, args)?;
    if let Some(done) = store.and_then(|s| s.find(path, &case)).and_then(kept) {
        return Ok(done);
    }
    let (found, evidence) = examined(&case, &addresses, args)?;
    let json = check_json(json::report(&case, &found), evidence.as_ref());
    let done = Done {
        name: case.name.clone(),
        verdict: found.verdict,
        kinds: kinds(&found).join(", "),
        checked: Checked::of(&json).unwrap_or(Checked::NotAsked),
        json,
        kept: false,
    };
    if let Some(store) = store {
        let certificate = evidence.and_then(Evidence::ok).map(|c| c.text());
        let kept = Kept { report: done.json.clone(), kinds: done.kinds.clone() };
        store.keep(path, &case.text.text, &kept, certificate.as_deref())?;
    }
    Ok(done)
}

/// A case about the vertices of a mesh: the verdicts at the valences of its file.
fn about_vertices(path: &Path, no_check: bool) -> Outcome {
    let case = VertexCase::read(path)?;
    let asked = super::vertex::valences(&case, None)?;
    let (mut found, every) = super::vertex::at(&case, &asked, true)?;
    if !no_check {
        super::vertex::confirmed(&case, &mut found)?;
    }
    let decided = found.iter().filter(|f| f.smooth != Verdict::Undetermined).count();
    let checked = if no_check || decided == 0 {
        Checked::NotAsked
    } else if every.is_none() && found.iter().filter(|f| f.again == Again::Proved).count() == decided {
        Checked::Yes
    } else {
        Checked::NoRule
    };
    let smooth = found.iter().map(|f| match f.smooth {
        Verdict::Proved => "C¹ valence",
        Verdict::Refuted => "valence not C¹",
        Verdict::Undetermined => "open valence",
    });
    Ok(Done {
        name: case.name.clone(),
        verdict: report::overall(&found, every.as_ref()),
        kinds: counted(smooth).join(", "),
        checked,
        json: report::json(&case, &found, every.as_ref()),
        kept: false,
    })
}

/// A stored result, read back; `None` where it is not what this version writes.
fn kept(Kept { report: json, kinds }: Kept) -> Option<Done> {
    let verdict = verdict_of(json["verdict"].as_str()?)?;
    let (name, checked) = (json["case"].as_str()?.to_owned(), Checked::of(&json)?);
    Some(Done { name, verdict, kinds, checked, json, kept: true })
}

fn verdict_of(word: &str) -> Option<Verdict> {
    [Verdict::Proved, Verdict::Refuted, Verdict::Undetermined].into_iter().find(|v| v.word() == word)
}

fn gravest(codes: impl Iterator<Item = u8>) -> u8 {
    let codes: Vec<u8> = codes.collect();
    [BAD_INPUT, REFUTED, UNDETERMINED].into_iter().find(|c| codes.contains(c)).unwrap_or(PROVED)
}

fn table(names: &[String], outcomes: &[Outcome]) -> Document {
    let row = |(name, outcome): (&String, &Outcome)| -> Vec<Line> {
        match outcome {
            Ok(done) => {
                let mark = vec![phrases::mark(done.verdict)];
                vec![words(done.name.clone()), mark, words(done.checked.word()), words(done.kinds.clone())]
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
    let count =
        |code: u8| outcomes.iter().filter(|o| o.as_ref().map_or(BAD_INPUT, |d| exit_code(d.verdict)) == code).count();
    let mut total = format!(
        "{}: {} proved, {} refuted, {} undetermined, {} refused.",
        phrases::count(outcomes.len(), "case"),
        count(PROVED),
        count(REFUTED),
        count(UNDETERMINED),
        count(BAD_INPUT)
    );
    let unchecked = |d: &&Done| d.verdict != Verdict::Undetermined && d.checked != Checked::Yes;
    let unchecked = outcomes.iter().flatten().filter(unchecked).count();
    if unchecked > 0 {
        let cases = phrases::count(unchecked, "case");
        total.push_str(&format!(" {cases} decided but not proved again by the checker."));
    }
    let kept = outcomes.iter().flatten().filter(|d| d.kept).count();
    if kept > 0 {
        total.push_str(&format!(" {kept} kept from an earlier run."));
    }
    Document { title: "secant certify".to_owned(), blocks: vec![Block::Table(table), Block::Paragraph(words(total))] }
}

/// The name of the file without directory and ending.
fn stem(path: &str) -> String {
    Path::new(path).file_stem().map_or_else(|| path.to_owned(), |s| s.to_string_lossy().into_owned())
}

/// The kinds of the examined points, each with its number.
pub fn kinds(found: &Certified) -> Vec<String> {
    let surface = found.surface.iter().flat_map(|s| &s.points).map(|p| match p.verdict {
        Verdict::Proved => "tangent plane",
        Verdict::Refuted => "no tangent plane",
        Verdict::Undetermined => "undetermined",
    });
    counted(surface.chain(found.points.iter().map(|p| p.kind.word())))
}

fn counted<'a>(items: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut counted: Vec<(&str, usize)> = Vec::new();
    for word in items {
        match counted.iter_mut().find(|(w, _)| *w == word) {
            Some((_, n)) => *n += 1,
            None => counted.push((word, 1)),
        }
    }
    counted.into_iter().map(|(w, n)| if n == 1 { w.to_owned() } else { format!("{n} {w}") }).collect()
}
