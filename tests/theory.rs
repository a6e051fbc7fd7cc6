//! `docs/theory.md` holds every statement of `docs/statements` once, word for word. `SECANT_BLESS=1 cargo test --test
//! theory` writes the statements into the page.

use secant::statement::{Statement, Text};
use std::collections::BTreeSet;
use std::path::Path;

const BEFORE: &str = "<!-- statement: ";
const AFTER: &str = "<!-- end -->\n";

/// Pages that still have long lines of prose. A page that has none any more is to be taken from this list.
const LONG: [&str; 3] = ["CHANGELOG.md", "README.md", "docs/certificate.md"];

/// Lines of prose are at most this long.
const WIDTH: usize = 120;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A statement as it stands in the theory.
fn shown(statement: Statement) -> String {
    let text = statement.text();
    let mut out = format!("**{}.** *Hypotheses:*\n\n", text.name);
    for h in &text.hypotheses {
        out.push_str(&format!("{}\n", wrapped(&format!("*{}*: {}", h.name, h.text), "- ", "  ")));
    }
    for (k, paragraph) in text.body.iter().enumerate() {
        let head = if k == 0 { "*Then:* " } else { "" };
        out.push_str(&format!("\n{}\n", wrapped(&format!("{head}{paragraph}"), "", "")));
    }
    for (k, paragraph) in text.proof.iter().enumerate() {
        let head = if k == 0 { "*Proof.* " } else { "" };
        let end = if k + 1 == text.proof.len() { " ∎" } else { "" };
        out.push_str(&format!("\n{}\n", wrapped(&format!("{head}{paragraph}{end}"), "", "")));
    }
    if text.reference != "docs/theory.md." {
        out.push_str(&format!("\n{}\n", wrapped(&format!("*Reference.* {}", text.reference), "", "")));
    }
    out
}

fn wrapped(text: &str, first: &str, rest: &str) -> String {
    let mut lines = vec![first.to_owned()];
    let mut empty = true;
    for word in text.split(' ') {
        let Some(last) = lines.last_mut() else { continue };
        if !empty && last.chars().count() + 1 + word.chars().count() > WIDTH - 2 {
            lines.push(format!("{rest}{word}"));
        } else {
            if !empty {
                last.push(' ');
            }
            last.push_str(word);
        }
        empty = false;
    }
    lines.join("\n")
}

/// The page with every statement as its file has it, and the statements in the order in which they stand there.
fn assembled(page: &str) -> (String, Vec<Statement>) {
    let mut parts = page.split(BEFORE);
    let mut out = parts.next().unwrap_or_default().to_owned();
    let mut order = Vec::new();
    for part in parts {
        let (id, rest) = part.split_once(" -->\n").expect("a mark has an end");
        let (_, after) = rest.split_once(AFTER).expect("a statement has an end");
        let statement = *Statement::ALL.iter().find(|s| s.id() == id).unwrap_or_else(|| panic!("no statement {id}"));
        order.push(statement);
        out.push_str(&format!("{BEFORE}{id} -->\n\n{}\n{AFTER}{after}", shown(statement)));
    }
    (out, order)
}

#[test]
fn the_theory_holds_every_statement_once() {
    let path = root().join("docs/theory.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let (wanted, order) = assembled(&page);
    if std::env::var_os("SECANT_BLESS").is_some() {
        std::fs::write(&path, &wanted).unwrap();
    } else {
        assert!(
            page == wanted,
            "docs/theory.md is not made of docs/statements: SECANT_BLESS=1 cargo test --test theory"
        );
    }
    assert_eq!(order, Statement::ALL, "every statement once, in the order of `enum Statement`");
}

#[test]
fn every_file_is_a_statement() {
    let listed: BTreeSet<String> = Statement::ALL.iter().map(|s| format!("{}.md", s.id())).collect();
    let dir = std::fs::read_dir(root().join("docs/statements")).unwrap();
    let found: BTreeSet<String> = dir.map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(listed, found);
}

#[test]
fn explain_prints_the_statements_of_the_theory() {
    for statement in Statement::ALL {
        let output =
            assert_cmd::Command::cargo_bin("secant").unwrap().args(["explain", statement.id()]).output().unwrap();
        assert!(output.status.success());
        let printed = plain(&String::from_utf8(output.stdout).unwrap());
        let Text { name, hypotheses, .. } = statement.text();
        assert!(printed.contains(&plain(name)), "{printed}");
        for h in hypotheses {
            assert!(printed.contains(&format!("- {}: ", h.name)), "{}: {} in {printed}", statement.id(), h.name);
        }
    }
}

#[test]
fn explain_knows_the_words() {
    for word in secant::glossary::words() {
        let output = assert_cmd::Command::cargo_bin("secant").unwrap().args(["explain", &word.name]).output().unwrap();
        assert!(output.status.success(), "{}", word.name);
    }
    let data = |name: &str| {
        let output =
            assert_cmd::Command::cargo_bin("secant").unwrap().args(["explain", "--json", name]).output().unwrap();
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    assert_eq!(data("τ")["word"], "tau");
    let names =
        data("theorem-6")["hypotheses"].as_array().unwrap().iter().map(|h| h["name"].clone()).collect::<Vec<_>>();
    assert_eq!(names, ["meet", "cones", "chords", "positive", "view"]);
    let output = assert_cmd::Command::cargo_bin("secant").unwrap().args(["explain", "theorm-2"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("theorem-2"));
}

/// One line, one space between words.
fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Lines of prose over the width: not in tables, code, or where one word is that long.
fn long_lines(text: &str) -> Vec<usize> {
    let mut code = false;
    let mut long = Vec::new();
    for (k, line) in text.lines().enumerate() {
        code ^= line.trim_start().starts_with("```");
        let prose = !code && !line.starts_with('|') && !line.starts_with("    ") && line.trim().contains(' ');
        if prose && line.chars().count() > WIDTH {
            long.push(k + 1);
        }
    }
    long
}

#[test]
fn lines_of_prose_are_short() {
    let mut files = Vec::new();
    for dir in ["", "docs", "docs/statements", "cases", "tests/certs/fail", "tests/certs/run", "tests/oracle/curves"] {
        let entries = std::fs::read_dir(root().join(dir)).unwrap().map(|f| f.unwrap().path());
        files.extend(entries.filter(|f| f.extension().is_some_and(|e| e == "md")));
    }
    files.retain(|f| LONG.iter().all(|name| *f != root().join(name)));
    assert!(files.len() > 50);
    let mut wrong = Vec::new();
    for file in files {
        let long = long_lines(&std::fs::read_to_string(&file).unwrap());
        if !long.is_empty() {
            wrong.push(format!("{}: {long:?}", file.display()));
        }
    }
    assert!(wrong.is_empty(), "lines over {WIDTH} columns:\n{}", wrong.join("\n"));
}
