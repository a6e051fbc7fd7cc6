//! `secant certify` of several cases: in parallel, printed in the order given, and resumed where results were kept.

use super::certify::{exit_code, json_text};
use super::output::{complain, print, problem_code, stdout_look};
use super::progress::Progress;
use super::question::question;
use super::resume::{Kept, Store};
use super::{BAD_INPUT, CertifyArgs, INTERNAL, PROVED, REFUTED, UNDETERMINED};
use crate::answer::Verdict;
use crate::ask::{Checked, Evidence, NOT_ASKED, ONCE, answered};
use crate::case::Subject;
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::report::document::{Block, Document, Inline, Line, Table, Tone, words};
use crate::report::text::{self, Look};
use crate::report::{json, words as phrases};
use rayon::prelude::*;
use serde_json::Value;
use std::path::{Path, PathBuf};

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

/// What the report of an earlier run says of the checker; `None` where it does not say it.
fn checked_in(report: &Value) -> Option<Checked> {
    let said = &report["certificate"];
    Some(match (said["checked"].as_bool()?, said["why"].as_str()) {
        (true, None) => Checked::Yes,
        (false, Some(NOT_ASKED)) => Checked::NotAsked,
        (false, Some(why)) if why.starts_with(ONCE) => Checked::Part,
        (false, Some(_)) => Checked::NoRule,
        _ => return None,
    })
}

fn checked_word(checked: Checked) -> &'static str {
    match checked {
        Checked::Yes => "yes",
        Checked::Part => "in part",
        Checked::NoRule => "no rule",
        Checked::NotAsked => "–",
    }
}

type Outcome = Result<Done, Problem>;

/// Certifies all cases, or those of the part that was asked for; the exit code is the gravest.
pub fn run(args: &CertifyArgs) -> u8 {
    let args = &part_of(args);
    let store = match args.resume.as_deref().map(|dir| Store::open(dir, args)).transpose() {
        Ok(store) => store,
        Err(problem) => {
            complain(&problem);
            return BAD_INPUT;
        }
    };
    let outcomes = outcomes(args, &|path| case(path, args, store.as_ref()));
    print(&shown(args, &outcomes, stdout_look()));
    for problem in outcomes.iter().filter_map(|o| o.as_ref().err()) {
        complain(problem);
    }
    gravest(outcomes.iter().map(code))
}

/// The arguments with the cases of the part that was asked for.
fn part_of(args: &CertifyArgs) -> CertifyArgs {
    let (part, parts) = args.shard.unwrap_or((1, 1));
    let cases = args.cases.iter().skip(part - 1).step_by(parts).cloned().collect();
    CertifyArgs { cases, shard: None, ..args.clone() }
}

/// What becomes of each case, in the order given; a case on which `examine` panics is a problem like the others.
fn outcomes(args: &CertifyArgs, examine: &(dyn Fn(&Path) -> Outcome + Sync)) -> Vec<Outcome> {
    let progress = Progress::new(args.cases.len(), args.quiet);
    let one = |path: &PathBuf| {
        let outcome = guarded(|| examine(path));
        progress.step();
        outcome
    };
    let outcomes = args.cases.par_iter().map(one).collect();
    progress.finish();
    outcomes
}

/// The lines of JSON or the table, whichever is asked for.
fn shown(args: &CertifyArgs, outcomes: &[Outcome], look: Look) -> String {
    let names: Vec<String> = args.cases.iter().map(|p| p.display().to_string()).collect();
    if args.jsonl {
        let line = |(name, outcome): (&String, &Outcome)| match outcome {
            Ok(done) => json_text(&done.json, false),
            Err(problem) => json_text(&json::refusal(name, problem), false),
        };
        names.iter().zip(outcomes).map(line).collect()
    } else if args.quiet {
        String::new()
    } else {
        text::render_as(&table(&names, outcomes), look)
    }
}

fn code(outcome: &Outcome) -> u8 {
    outcome.as_ref().map_or_else(problem_code, |done| exit_code(done.verdict))
}

/// One case: from the store where its result is up to date, otherwise answered and stored.
fn case(path: &Path, args: &CertifyArgs, store: Option<&Store>) -> Outcome {
    let question = question(path, args)?;
    let store = store.filter(|_| question.subject() != Subject::Vertices);
    let with_path = |mut done: Done| {
        done.json["path"] = path.display().to_string().into();
        done
    };
    if let Some(done) = store.and_then(|s| s.find(path, &question)).and_then(kept) {
        return Ok(with_path(done));
    }
    let answered = answered(&question, !args.no_check, &args.budget(), &|| {})?;
    let done = Done {
        name: answered.findings.name().to_owned(),
        verdict: answered.findings.verdict_on(&args.require),
        kinds: answered.kinds().join(", "),
        checked: answered.checked(),
        json: answered.json(&args.require, args.verbose),
        kept: false,
    };
    if let Some(store) = store {
        let certificate = answered.evidence.and_then(Evidence::ok).map(|c| c.text());
        let kept = Kept { report: done.json.clone(), kinds: done.kinds.clone() };
        store.keep(path, &question.text().text, &kept, certificate.as_deref())?;
    }
    Ok(with_path(done))
}

/// A stored result, read back; `None` where it is not what this version writes.
fn kept(Kept { report: json, kinds }: Kept) -> Option<Done> {
    let verdict = Verdict::of_word(json["verdict"].as_str()?)?;
    let (name, checked) = (json["case"].as_str()?.to_owned(), checked_in(&json)?);
    Some(Done { name, verdict, kinds, checked, json, kept: true })
}

/// The gravest of several exit codes.
pub fn gravest(codes: impl Iterator<Item = u8>) -> u8 {
    let codes: Vec<u8> = codes.collect();
    [INTERNAL, BAD_INPUT, REFUTED, UNDETERMINED].into_iter().find(|c| codes.contains(c)).unwrap_or(PROVED)
}

fn table(names: &[String], outcomes: &[Outcome]) -> Document {
    let row = |(name, outcome): (&String, &Outcome)| -> Vec<Line> {
        match outcome {
            Ok(done) => {
                let mark = vec![phrases::mark(done.verdict)];
                let (every, order) = (every_point(&done.json), order(&done.json));
                vec![
                    words(done.name.clone()),
                    mark,
                    words(checked_word(done.checked)),
                    every,
                    words(order),
                    words(done.kinds.clone()),
                ]
            }
            Err(problem) => {
                let word = if problem.is_internal() { "internal error" } else { "refused" };
                let mark = vec![Inline::Mark(Tone::Bad, word.to_owned())];
                vec![words(stem(name)), mark, words("–"), words("–"), words("–"), words(problem.message().to_owned())]
            }
        }
    };
    let table = Table {
        caption: Line::new(),
        header: ["Case", "Verdict", "Checked", "G¹", "C^k", "Points"].map(words).to_vec(),
        rows: names.iter().zip(outcomes).map(row).collect(),
    };
    let count = |wanted: u8| outcomes.iter().filter(|o| code(o) == wanted).count();
    let mut total = format!(
        "{}: {} proved, {} refuted, {} undetermined, {} refused.",
        phrases::count(outcomes.len(), "case"),
        count(PROVED),
        count(REFUTED),
        count(UNDETERMINED),
        count(BAD_INPUT)
    );
    if count(INTERNAL) > 0 {
        total.push_str(&format!(" {}: please report them.", phrases::count(count(INTERNAL), "internal error")));
    }
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

/// What a report says of every point.
fn every_point(report: &Value) -> Line {
    let claims = report["claims"].as_array();
    let found = claims.and_then(|all| all.iter().find(|c| c["about"] == "g1"));
    let verdict = found.and_then(|c| Verdict::of_word(c["verdict"].as_str()?));
    verdict.map_or_else(|| words("–"), |v| vec![phrases::mark(v)])
}

/// The largest order of smoothness that a report proves, with `≥` where the next one is open.
fn order(report: &Value) -> String {
    let parameter = &report["parameter"];
    match (parameter["polynomial"].as_bool(), parameter["smoothness"].as_u64()) {
        (Some(true), _) => "∞".to_owned(),
        (_, Some(k)) => {
            let last = parameter["orders"].as_array().and_then(|orders| orders.last());
            let exact = last.is_some_and(|o| o["smooth"] == false);
            format!("{}{k}", if exact { "" } else { "≥ " })
        }
        _ => "–".to_owned(),
    }
}

/// The name of the file without directory and ending.
fn stem(path: &str) -> String {
    Path::new(path).file_stem().map_or_else(|| path.to_owned(), |s| s.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Cli, Command};
    use clap::Parser;

    fn arguments(more: &[&str]) -> CertifyArgs {
        let words = ["secant", "certify", "-q", "cases/bspline/degree-2.toml", "broken", "cases/classical/levy.toml"];
        match Cli::try_parse_from(words.iter().chain(more)).map(|cli| cli.command) {
            Ok(Command::Certify(args)) => args,
            _ => unreachable!("the command line above is one of certify"),
        }
    }

    /// The program fails on the second case.
    fn failing(args: &CertifyArgs) -> Vec<Outcome> {
        outcomes(args, &|path| {
            assert!(path != Path::new("broken"), "a broken step");
            case(path, args, None)
        })
    }

    #[test]
    fn a_case_that_fails_takes_no_other_with_it() {
        let args = arguments(&["--jsonl"]);
        let found = failing(&args);
        assert_eq!(found.iter().map(code).collect::<Vec<_>>(), [PROVED, INTERNAL, REFUTED]);
        assert_eq!(gravest(found.iter().map(code)), INTERNAL);
        let text = shown(&args, &found, Look::default());
        let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(lines.len(), 3);
        assert_eq!((&lines[0]["verdict"], &lines[2]["verdict"]), (&"proved".into(), &"refuted".into()));
        assert_eq!((&lines[1]["verdict"], &lines[1]["error"]["code"]), (&Value::Null, &Problem::INTERNAL.into()));
        assert_eq!(lines[1]["case"], "broken");
    }

    #[test]
    fn parts_have_every_case_once() {
        let mut seen = Vec::new();
        for part in ["1/2", "2/2"] {
            let args = arguments(&["--shard", part]);
            assert_eq!(args.shard.map(|s| s.1), Some(2));
            seen.extend(part_of(&args).cases);
        }
        seen.sort();
        let mut all = arguments(&[]).cases;
        all.sort();
        assert_eq!(seen, all);
        for wrong in ["0/2", "3/2", "1", "a/b"] {
            assert!(Cli::try_parse_from(["secant", "certify", "x.toml", "--shard", wrong]).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_table_has_a_row_for_it() {
        let mut args = arguments(&[]);
        args.quiet = false;
        let text = shown(&args, &failing(&args), Look::default());
        let words: Vec<&str> = text.split_whitespace().filter(|w| *w != "–").collect();
        let text = words.join(" ");
        assert!(text.contains("internal error, no verdict: a broken step"), "{text}");
        assert!(text.contains("1 proved, 1 refuted, 0 undetermined, 0 refused. 1 internal error"), "{text}");
    }
}
