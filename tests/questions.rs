//! One question, one answer: how a case is written, and who asks, does not change what is found.

use crate::corpus;

use secant::case::{Question, Subject, Valences};
use secant::prelude::{Budget, Findings, Verdict, confirm, findings, prove};
use secant::theorem::Required;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The JSON that `secant certify --json -` prints of a text, and its exit code.
fn program(text: &str) -> (serde_json::Value, Option<i32>) {
    use std::io::Write;
    let mut child = Command::new(env!("CARGO_BIN_EXE_secant"))
        .args(["certify", "--json", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let done = child.wait_with_output().unwrap();
    (serde_json::from_slice(&done.stdout).unwrap(), done.status.code())
}

#[test]
fn a_vertex_table_may_be_written_in_any_way_that_toml_has() {
    let spellings = [
        "[vertex]\nmesh = \"catmull-clark\"\nvalence = \"5,7\"\n",
        "[ vertex ]\nmesh = \"catmull-clark\"\nvalence = \"5,7\"\n",
        "[\"vertex\"]\n\"mesh\" = \"catmull-clark\"\nvalence = \"5,7\"\n",
        "vertex = { mesh = \"catmull-clark\", valence = \"5,7\" }\n",
        "vertex.mesh = \"catmull-clark\"\nvertex.valence = \"5,7\"\n",
    ];
    for spelling in spellings {
        let text = format!("name = \"cc\"\n{spelling}");
        let question = Question::parse("cc.toml", &text).unwrap_or_else(|p| panic!("{spelling}: {p:?}"));
        assert_eq!(question.subject(), Subject::Vertices, "{spelling}");
        let mut found = prove(&question, &Budget::default()).unwrap();
        assert_eq!(found.verdict(), Verdict::Proved, "{spelling}");
        // The checker reads the same text.
        confirm(&mut found).unwrap_or_else(|doubt| panic!("{spelling}: {doubt}"));
        let (json, code) = program(&text);
        assert_eq!((json["verdict"].as_str(), code), (Some("proved"), Some(0)), "{spelling}");
        assert_eq!(json["certificate"]["checked"], true, "{spelling}");
    }
}

#[test]
fn a_line_of_a_title_is_no_table() {
    let case = std::fs::read_to_string(root().join("cases/sets/sierpinski.toml")).unwrap();
    let plain = Question::parse("plain", &case).unwrap();
    let body: String = case.lines().filter(|l| !l.starts_with("title")).map(|l| format!("{l}\n")).collect();
    let odd = format!("title = \"\"\"a set\n[vertex]\nbeta = 9/10\"\"\"\n{body}");
    let question = Question::parse("odd", &odd).unwrap();
    assert_eq!(question.subject(), Subject::Set);
    assert_eq!(
        prove(&question, &Budget::default()).unwrap().verdict(),
        prove(&plain, &Budget::default()).unwrap().verdict()
    );
    assert_eq!(program(&odd).0["verdict"], prove(&plain, &Budget::default()).unwrap().verdict().word());
}

#[test]
fn addresses_and_valences_of_the_caller_come_after_those_of_the_file() {
    let path = root().join("cases/thesis/half-tangent.toml");
    let question = Question::read(&path).unwrap().with_address("(01)").unwrap();
    let Findings::Tangents { found, .. } = prove(&question, &Budget::default()).unwrap() else { panic!("a curve") };
    assert!(found.claims.last().unwrap().what.asked().is_some_and(|(a, _)| a.to_string() == "(01)"));
    assert!(Question::read(&path).unwrap().with_address("9(0)").is_err());

    let path = root().join("cases/surfaces/catmull-clark.toml");
    let asked = Question::at_valences(&path.to_string_lossy(), Valences::parse("6").unwrap()).unwrap();
    let found = prove(&asked, &Budget::default()).unwrap();
    assert_eq!(found.claims().len(), 1);
    assert!(asked.with_address("(0)").is_err());
}

#[test]
fn no_valences_are_no_success() {
    let question = Question::parse("cc.toml", "name = \"cc\"\nvertex.mesh = \"catmull-clark\"\n").unwrap();
    assert_eq!(
        prove(&question, &Budget::default()).err().map(|p| p.id().to_owned()).as_deref(),
        Some("secant::usage::valence")
    );
}

/// The example of README.md and of the library's page answers as the program does: on every case, with the same claims.
#[test]
fn the_library_agrees_with_the_program() {
    let mut files = Vec::new();
    corpus::all_files(&root().join("cases"), &mut files);
    // Cases that take long are left to tests/cases.rs, which asks the same function.
    let quick = |path: &&PathBuf| !path.parent().is_some_and(|p| p.ends_with("surfaces"));
    let files: Vec<&PathBuf> = files.iter().filter(quick).collect();
    let done = Command::new(env!("CARGO_BIN_EXE_secant"))
        .args(["certify", "--jsonl", "--no-check"])
        .args(&files)
        .stderr(Stdio::null())
        .output()
        .unwrap();
    let text = String::from_utf8(done.stdout).unwrap();
    assert_eq!(text.lines().count(), files.len());
    for (path, line) in files.iter().zip(text.lines()) {
        let printed: serde_json::Value = serde_json::from_str(line).unwrap();
        agrees(path, &printed);
    }
}

fn agrees(path: &Path, printed: &serde_json::Value) {
    match Question::read(path).and_then(|question| prove(&question, &Budget::default())) {
        Ok(found) => {
            let mine = findings::json(&found, &Required::default(), false);
            for field in ["case", "verdict", "claims"] {
                assert_eq!(mine[field], printed[field], "{}: {field}", path.display());
            }
            assert_eq!(printed["verdict"], found.verdict().word(), "{}", path.display());
        }
        Err(problem) => {
            assert!(!problem.is_internal());
            assert_eq!(printed["error"]["code"], problem.id(), "{}", path.display());
        }
    }
}

/// The tangent planes of a surface are one question, whoever asks it.
#[test]
fn a_surface_has_one_verdict() {
    let path = root().join("cases/surfaces/bicubic-space.toml");
    let found = prove(&Question::read(&path).unwrap(), &Budget::default()).unwrap();
    assert_eq!(found.verdict(), Verdict::Proved);
    let (json, code) = program(&std::fs::read_to_string(&path).unwrap());
    assert_eq!((json["verdict"].as_str(), code), (Some("proved"), Some(0)));
}

#[test]
fn a_scheme_a_mask_and_a_symbol_are_asked_like_files() {
    let certify = |args: &[&str]| {
        let done = Command::new(env!("CARGO_BIN_EXE_secant")).args(["certify", "--json"]).args(args).output().unwrap();
        (serde_json::from_slice::<serde_json::Value>(&done.stdout).unwrap(), done.status.code())
    };
    let verdicts =
        |json: &serde_json::Value| json["claims"].as_array().unwrap().iter().map(|c| c["verdict"].clone()).collect();
    let named: Vec<serde_json::Value> = verdicts(&certify(&["bspline", "degree=2"]).0);
    for text in ["1/4,3/4,3/4,1/4", "0.25, 0.75, 0.75, 0.25", "(1+z)^3/4"] {
        let (json, code) = certify(&[text]);
        assert_eq!((verdicts(&json), code), (named.clone(), Some(0)), "{text}");
        assert_eq!(json["title"], text);
    }
    let (json, code) = certify(&["four-point", "w=1/16"]);
    assert_eq!((json["case"].as_str(), code), (Some("four-point"), Some(0)));
    assert_eq!(certify(&["four-point", "v=1/16"]).1, Some(2));
    assert_eq!(certify(&["no-such-file"]).1, Some(2));
    assert_eq!(certify(&["1/4,3/4,3/4"]).1, Some(2));
}

/// A budget decides which questions stay open, never what an answer is; what is left open says which limit ended it.
#[test]
fn a_small_budget_leaves_questions_open_and_says_why() {
    let small = Budget { cells: 1, first_cells: 1, ..Budget::default() };
    let mut left = 0;
    for name in [
        "counterexamples/own-periodic-point",
        "classical/ternary-parabola",
        "two-parameter/long-cycle",
        "classical/levy",
    ] {
        let question = Question::read(&root().join(format!("cases/{name}.toml"))).unwrap();
        let (normal, quick) = (prove(&question, &Budget::default()).unwrap(), prove(&question, &small).unwrap());
        let Findings::Tangents { found, .. } = &quick else { panic!("a curve") };
        if quick.verdict() == Verdict::Undetermined && normal.verdict() != Verdict::Undetermined {
            assert!(found.limits().iter().any(|limit| limit.name() == "cells"), "{name}: {:?}", found.limits());
            left += 1;
        } else {
            assert_eq!(quick.verdict(), normal.verdict(), "{name}");
        }
    }
    assert!(left > 0, "one cell is enough for everything");
}
