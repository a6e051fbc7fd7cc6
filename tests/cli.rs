//! The program as a user meets it: exit codes, diagnostics, JSON, files.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn secant(args: &[&str]) -> Command {
    let mut command = Command::cargo_bin("secant").expect("the program is built");
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args).env_remove("NO_COLOR").env("TERM", "xterm");
    command
}

fn output(args: &[&str], code: i32) -> (String, String) {
    let out = secant(args).output().expect("the program runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

const HALF: &str = "cases/thesis/half-tangent.toml";

#[test]
fn exit_codes_tell_the_verdict() {
    output(&["certify", HALF], 0);
    output(&["certify", "cases/classical/levy.toml"], 1);
    output(&["certify", "cases/refused/one-over-zero.toml"], 2);
    output(&["certify", "no/such/file.toml"], 2);
    output(&["certify"], 2);
    output(&["frobnicate"], 2);
    output(&["--version"], 0);
    output(&["--help"], 0);
}

/// Every claim can be asked for; where nothing is said, tangents decide, and a cusp inside.
#[test]
fn the_claims_that_decide_can_be_named() {
    let smooth = "cases/bspline/degree-3.toml";
    for (case, list, code) in [
        (HALF, "tangents", 0),
        (HALF, "ends,joints,dense", 0),
        (HALF, "ends,g1?", 1),
        (HALF, "g1", 1),
        (smooth, "ends,joints,dense,points,inside?", 0),
        (smooth, "g1,c2", 0),
        (smooth, "c3", 0),
        ("chaikin", "c1", 0),
        ("chaikin", "c2", 1),
        ("four-point", "c1", 0),
        ("four-point", "c2", 1),
        (smooth, "points", 3),
        ("cases/surfaces/bicubic-space.toml", "dense", 0),
        ("cases/surfaces/bicubic-space.toml", "g1", 0),
        ("cases/faces/catmull-clark-5.toml", "g1", 0),
        (smooth, "smooth", 2),
    ] {
        output(&["certify", "-q", "--no-check", case, "--require", list], code);
    }
    // A cusp between whole numbers of letters, which no joint shows.
    let cusp = "cases/control/interior-cusp.toml";
    let (out, _) = output(&["certify", cusp], 1);
    assert!(out.contains("refuted, by every point (G¹). Holds: ends") && !out.contains("every claim holds"), "{out}");
}

/// Whoever asks which claims hold is told so first, and once.
#[test]
fn one_table_comes_first() {
    let (out, _) = output(&["certify", "four-point"], 0);
    let before: Vec<&str> = out.lines().take_while(|l| *l != "Shape").collect();
    for piece in ["ends ", "dense set ", "every point (G¹) ", "C^1 ", "C^2 ", "Hölder exponent ", "smooth end"] {
        assert!(before.iter().any(|l| l.contains(piece)), "{piece} is missing in\n{out}");
    }
    // An exponent below 1 excludes C¹.
    let knopp = "name = \"knopp\"\n[scheme]\nname = \"takagi\"\nalpha = \"3/4\"\n";
    let out = secant(&["certify", "-", "--json", "--require", "c1"]).write_stdin(knopp).output().unwrap();
    assert_eq!(out.status.code(), Some(1));
}

#[test]
fn quiet_prints_nothing() {
    let (out, err) = output(&["certify", "-q", HALF], 0);
    assert_eq!((out.as_str(), err.as_str()), ("", ""));
}

#[test]
fn the_summary_says_what_was_found() {
    let (out, err) = output(&["certify", HALF], 0);
    for piece in ["(−1, 1, 0)", "3/4; then −1/4", "cusp", "Theorem 2", "Theorem 5", "smooth end", "(1, −1/4, 1/4)"]
    {
        assert!(out.contains(piece), "{piece} is missing in\n{out}");
    }
    assert_eq!(err, "");
    assert!(!out.contains('\u{1b}'), "no colours in a pipe");
    assert!(out.lines().all(|l| l.chars().count() <= 80), "80 columns\n{out}");
}

#[test]
fn the_readme_prints_what_the_program_does() {
    let readme = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let shown = readme.split("## What it says").nth(1).and_then(|t| t.split("```").nth(1)).expect("an excerpt");
    let (out, _) = output(&["certify", HALF], 0);
    for line in shown.lines().filter(|l| !l.trim().is_empty() && *l != "...") {
        assert!(out.lines().any(|l| l == line), "{line:?} is not in\n{out}");
    }
}

#[test]
fn standard_input_is_a_case() {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(HALF)).unwrap();
    let out = secant(&["certify", "-"]).write_stdin(text).output().unwrap();
    assert_eq!(out.status.code(), Some(0));
    let refused = secant(&["certify", "-"]).write_stdin("name = 1").output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8(refused.stderr).unwrap().contains("<stdin>:1:8"));
}

/// Every refused case: the code that it declares, and the diagnostic as it was when it was last approved.
/// `SECANT_BLESS=1 cargo test` writes the snapshots anew.
#[test]
fn diagnostics_are_as_approved() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(root.join("cases/refused")).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let mut all = String::new();
    for file in files.iter().filter(|f| f.extension().is_some_and(|e| e == "toml")) {
        let shown = format!("cases/refused/{}", file.file_name().unwrap().to_string_lossy());
        let (out, err) = output(&["certify", &shown], 2);
        assert_eq!(out, "", "{shown}");
        if let Some(code) = secant::case::expected_error(&std::fs::read_to_string(file).unwrap()) {
            assert!(err.starts_with(&format!("{code}\n")), "{shown} expects {code}\n{err}");
        }
        all.push_str(&format!("$ secant certify {shown}\n{err}\n"));
    }
    approved("diagnostics.txt", &all);
}

#[test]
fn the_summaries_are_as_approved() {
    let mut all = String::new();
    for (case, code) in [(HALF, 0), ("cases/classical/takagi.toml", 0), ("cases/two-parameter/corner-34-100.toml", 1)] {
        all.push_str(&format!("$ secant certify -v {case}\n{}\n", output(&["certify", "-v", case], code).0));
    }
    approved("summaries.txt", &all);
}

fn approved(name: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots").join(name);
    if std::env::var_os("SECANT_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    for (k, (a, b)) in text.lines().zip(expected.lines()).enumerate() {
        assert_eq!(a, b, "line {} of {name}; SECANT_BLESS=1 approves", k + 1);
    }
    assert_eq!(text, expected, "{name}; SECANT_BLESS=1 approves");
}

fn json(case: &str, code: i32) -> Value {
    serde_json::from_str(&output(&["certify", "--json", case], code).0).expect("JSON")
}

#[test]
fn json_has_the_documented_fields() {
    let value = json(HALF, 0);
    assert_eq!(value["version"], 1);
    assert_eq!(value["case"], "half-tangent");
    assert_eq!((&value["verdict"], &value["tangents"]), (&"proved".into(), &"proved".into()));
    assert_eq!(value["contraction"]["verdict"], "proved");
    assert!(value["claim"].is_string());
    let points = value["points"].as_array().unwrap();
    assert_eq!(points.len(), 3);
    for point in points {
        for key in [
            "address",
            "verdict",
            "dimension",
            "kind",
            "rays",
            "tangent",
            "eigenvalue",
            "jordan",
            "theorem",
            "rate",
            "holder",
        ] {
            assert!(!point[key].is_null(), "{key} in {point}");
        }
    }
    let left = &points[0];
    assert_eq!(left["address"], "(0)");
    assert_eq!(left["kind"], "smooth end");
    assert_eq!(left["dimension"]["at_least"], 1);
    assert_eq!(left["rays"]["right"][0]["exact"], serde_json::json!(["-1", "1", "0"]));
    assert_eq!(left["eigenvalue"]["minimal_polynomial"], "x - 3/4");
    assert_eq!(left["rate"]["factor"]["exact"], "1/3");
    assert_eq!(points[2]["kind"], "cusp");
    assert_eq!(points[2]["addresses"], serde_json::json!(["0(1)", "1(0)"]));
}

#[test]
fn json_has_a_witness_or_a_reason() {
    let levy = json("cases/classical/levy.toml", 1);
    for point in levy["points"].as_array().unwrap() {
        assert_eq!(point["verdict"], "refuted");
        assert!(!point["witness"].is_null() || !point["reason"].is_null());
    }
    let refused = json("cases/refused/one-over-zero.toml", 2);
    assert_eq!(refused["error"]["code"], "secant::case::zero-denominator");
    assert_eq!(refused["error"]["line"], 6);
}

#[test]
fn json_lines_come_in_the_order_given() {
    let cases = ["cases/classical/levy.toml", HALF, "cases/refused/empty.toml", "cases/bspline/degree-2.toml"];
    let args: Vec<&str> = ["certify", "--jsonl"].into_iter().chain(cases).collect();
    let (out, _) = output(&args, 2);
    let lines: Vec<Value> = out.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    let names: Vec<&str> = lines.iter().map(|v| v["case"].as_str().unwrap()).collect();
    assert_eq!(names, ["levy", "half-tangent", "cases/refused/empty.toml", "degree-2"]);
    let checked: Vec<&Value> = lines.iter().map(|v| &v["certificate"]["checked"]).collect();
    assert_eq!(checked, [&Value::from(true), &Value::from(true), &Value::Null, &Value::from(true)]);
    let (out, _) = output(&["certify", "--no-check", "--jsonl", HALF, "cases/classical/levy.toml"], 1);
    for line in out.lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        assert_eq!(line["certificate"]["why"], "the checker was not asked");
    }
}

#[test]
fn several_cases_give_a_table_and_the_gravest_code() {
    let (out, _) = output(&["certify", HALF, "cases/bspline/degree-2.toml"], 0);
    assert!(out.contains("2 cases: 2 proved"), "{out}");
    assert!(out.contains("Checked") && !out.contains("not proved again"), "{out}");
    let (out, _) = output(&["certify", "--no-check", HALF, "cases/bspline/degree-2.toml"], 0);
    let out = out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(out.contains("2 cases decided but not proved again by the checker"), "{out}");
    output(&["certify", HALF, "cases/classical/levy.toml"], 1);
    output(&["certify", "--json", HALF, "cases/classical/levy.toml"], 2);
}

#[test]
fn an_address_can_be_asked_for() {
    let (out, _) = output(&["certify", HALF, "--address", "0(01)"], 0);
    assert!(out.contains("0(01)"), "{out}");
    for bad in ["01", "(2)", "x", "()"] {
        let (_, err) = output(&["certify", HALF, "--address", bad], 2);
        assert!(err.starts_with("secant::usage::address"), "{err}");
    }
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let (md, html, svg) = (path("a.md"), path("a.html"), path("a.svg"));
    output(&["certify", "-q", HALF, "--report", &md, "--svg", &svg], 0);
    output(&["certify", "-q", HALF, "--report", &html], 0);
    let read = |p: &str| std::fs::read_to_string(p).unwrap();
    assert!(read(&md).contains("\\frac{3}{4}") && read(&md).contains("# The thesis's example"));
    assert!(read(&html).contains("<math") && read(&html).contains("<svg"));
    assert!(read(&svg).starts_with("<svg"));
    // The same input gives the same bytes.
    let again = path("b.html");
    output(&["certify", "-q", HALF, "--report", &again], 0);
    assert_eq!(read(&html), read(&again));
    // A refused case leaves nothing behind, and an existing file alone.
    output(&["certify", "cases/refused/gap.toml", "--report", &html, "--svg", &path("c.svg")], 2);
    assert_eq!(read(&html), read(&again));
    output(&["certify", HALF, "--report", &path("no/such/dir/a.md")], 2);
    output(&["certify", HALF, "--report", &path("a.docx")], 2);
    let mut names: Vec<String> =
        std::fs::read_dir(dir.path()).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert_eq!(names, ["a.html", "a.md", "a.svg", "b.html"]);
}

#[test]
fn reports_of_one_case_of_each_kind_are_as_approved() {
    let dir = tempfile::tempdir().unwrap();
    for (case, code) in [
        (HALF, 0),
        ("cases/classical/takagi.toml", 0),
        ("cases/classical/levy.toml", 1),
        ("cases/two-parameter/corner-34-100.toml", 1),
        ("cases/counterexamples/null-witness.toml", 1),
        ("cases/counterexamples/own-end-point.toml", 1),
        ("cases/control/bezier-cusp.toml", 0),
        ("cases/irrational/cusp-sqrt-2.toml", 0),
    ] {
        let file = dir.path().join("r.md").display().to_string();
        output(&["certify", "-q", case, "--report", &file], code);
        let name = Path::new(case).file_stem().unwrap().to_string_lossy().into_owned();
        // The picture is tested by itself; its bytes would only swell the snapshot.
        let text: String = std::fs::read_to_string(&file)
            .unwrap()
            .lines()
            .map(|l| if l.starts_with("![") { "![picture]\n".to_owned() } else { format!("{l}\n") })
            .collect();
        approved(&format!("{name}.md"), &text);
    }
}

#[test]
fn results_are_kept_and_found_again() {
    let dir = tempfile::tempdir().unwrap();
    let (store, other) = (dir.path().join("kept").display().to_string(), dir.path().join("other.toml"));
    std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bspline/degree-2.toml"), &other).unwrap();
    let other_name = other.display().to_string();
    let args = ["certify", "--resume", &store, HALF, &other_name];
    assert!(!output(&args, 0).0.contains("kept"));
    let (again, _) = output(&args, 0);
    assert!(again.contains("2 cases: 2 proved") && again.contains("2 kept"), "{again}");
    let lines = |args: &[&str]| output(args, 0).0;
    let fresh = lines(&["certify", "--jsonl", HALF, &other_name]);
    assert_eq!(lines(&["certify", "--jsonl", "--resume", &store, HALF, &other_name]), fresh);
    // A changed case and a certificate that is not the one written are certified again; so are other options.
    let text = std::fs::read_to_string(&other).unwrap();
    std::fs::write(&other, format!("{text}\n# changed\n")).unwrap();
    assert!(output(&args, 0).0.contains("1 kept"));
    let written = std::fs::read_dir(&store).unwrap().map(|e| e.unwrap().path());
    let certificates: Vec<PathBuf> = written.filter(|p| p.to_string_lossy().ends_with(".certificate.json")).collect();
    assert_eq!(certificates.len(), 2);
    std::fs::write(&certificates[0], "{}").unwrap();
    assert!(output(&args, 0).0.contains("1 kept"));
    assert!(!output(&["certify", "--resume", &store, HALF, "--address", "0(01)"], 0).0.contains("kept"));
    output(&["certify", "--resume", &store, "--json", HALF], 2);
}

#[test]
fn a_kept_result_is_taken_only_where_it_is_whole_and_still_proved() {
    let dir = tempfile::tempdir().unwrap();
    let store = dir.path().display().to_string();
    let surface = "cases/surfaces/one-direction.toml";
    let args = ["certify", "--resume", &store, HALF, surface, "--address", "(0)"];
    let (fresh, _) = output(&args, 1);
    // The kinds of a surface's points are kept, too.
    let (again, _) = output(&args, 1);
    assert!(again.contains("2 kept"), "{again}");
    let row = |text: &str| text.lines().find(|l| l.contains("one-direction")).map(str::to_owned);
    assert!(row(&fresh).is_some() && row(&fresh) == row(&again), "{fresh}\n{again}");
    let file = dir.path().join("cases--thesis--half-tangent.result.json");
    let certificate = dir.path().join("cases--thesis--half-tangent.certificate.json");
    let (kept, proof) = (std::fs::read_to_string(&file).unwrap(), std::fs::read_to_string(&certificate).unwrap());
    let one_kept = |what: &str| {
        let (out, _) = output(&args, 1);
        assert!(out.contains("1 kept"), "{what}\n{out}");
        // It was certified again and kept as before.
        assert_eq!(std::fs::read_to_string(&file).unwrap(), kept, "{what}");
    };
    // Another verdict, other kinds, another program, half a file.
    std::fs::write(&file, kept.replace("proved", "refuted")).unwrap();
    one_kept("another verdict");
    std::fs::write(&file, kept.replace("cusp", "regular")).unwrap();
    one_kept("another kind");
    let mut value: Value = serde_json::from_str(&kept).unwrap();
    value["seal"] = "0".repeat(64).into();
    std::fs::write(&file, value.to_string()).unwrap();
    one_kept("another program");
    std::fs::write(&file, &kept[..kept.len() / 2]).unwrap();
    one_kept("half a file");
    // A certificate that proves nothing, with its right digest in a file whose seal is not.
    let forged = proof.replacen("\"proof\"", "\"prose\"", 1);
    std::fs::write(&certificate, &forged).unwrap();
    let mut value: Value = serde_json::from_str(&kept).unwrap();
    value["certificate"] = secant::certificate::sha256(&forged).into();
    std::fs::write(&file, value.to_string()).unwrap();
    one_kept("another certificate");
    assert_eq!(std::fs::read_to_string(&certificate).unwrap(), proof);
}

#[test]
fn several_cases_may_be_about_vertices() {
    let (out, _) = output(&["certify", HALF, "cases/surfaces/catmull-clark-12-12.toml"], 0);
    assert!(out.contains("2 cases: 2 proved") && out.contains("C¹ valence"), "{out}");
}

#[test]
fn cones_are_drawn_where_there_are_some() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("cones.svg");
    let file = path.display().to_string();
    let case = "cases/bspline/degree-2.toml";
    output(&["certify", "-q", case, "--svg", &file, "--draw", "cones"], 0);
    let first = std::fs::read_to_string(&path).unwrap();
    assert!(first.matches("sc-y").count() > 8 && first.contains("cones</title>"), "{first}");
    output(&["certify", "-q", case, "--svg", &file, "--draw", "cones"], 0);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), first);
    let (_, err) = output(&["certify", "cases/classical/levy.toml", "--svg", &file, "--draw", "cones"], 2);
    assert!(err.contains("no cones"), "{err}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), first);
}

#[test]
fn colours_are_for_terminals_and_not_under_no_color() {
    // `script` of util-linux gives the program a terminal.
    let run = |no_color: bool| {
        let program = assert_cmd::cargo::cargo_bin("secant").display().to_string();
        let mut command = std::process::Command::new("script");
        command.args(["-qec", &format!("{program} certify {HALF}"), "/dev/null"]);
        command.current_dir(env!("CARGO_MANIFEST_DIR")).env("TERM", "xterm").env_remove("NO_COLOR");
        if no_color {
            command.env("NO_COLOR", "1");
        }
        command
            .stdin(std::process::Stdio::null())
            .output()
            .ok()
            .map(|o| String::from_utf8_lossy(&o.stdout).into_owned())
    };
    let Some(coloured) = run(false) else {
        eprintln!("not run: there is no `script`");
        return;
    };
    assert!(coloured.contains("\u{1b}["), "{coloured}");
    let plain = run(true).unwrap();
    assert!(plain.contains("proved") && !plain.contains("\u{1b}["), "{plain}");
}

#[test]
fn statements_are_explained() {
    let (out, _) = output(&["explain", "theorem-3"], 0);
    assert!(out.contains("Theorem 3") && out.contains("Proof."));
    assert!(output(&["explain"], 0).0.contains("theorem-5"));
    output(&["explain", "theorem-99"], 2);
}

#[test]
fn the_float_fallback_is_labelled_and_never_a_success() {
    let (out, _) = output(&["certify", "--approx", HALF], 3);
    assert!(out.contains("approximate") && out.contains("0.75"), "{out}");
    let (out, _) = output(&["certify", "--approx", "--json", HALF], 3);
    let value: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&value["approximate"], &value["verdict"]), (&Value::Bool(true), &Value::String("undetermined".into())));
    output(&["certify", "--approx", "cases/refused/empty.toml"], 2);
}

#[test]
fn the_starter_case_is_proved_and_never_overwrites() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| secant(args).current_dir(dir.path()).output().unwrap().status.code();
    assert_eq!(run(&["init", "mine"]), Some(0));
    assert_eq!(run(&["certify", "mine.toml"]), Some(0));
    assert_eq!(run(&["init", "mine"]), Some(2));
    assert_eq!(run(&["init", "../else where"]), Some(2));
}

#[test]
fn the_gallery_is_written_and_checked() {
    let dir = tempfile::tempdir().unwrap();
    let cases = dir.path().join("cases/some");
    std::fs::create_dir_all(&cases).unwrap();
    for case in [HALF, "cases/refused/gap.toml"] {
        let from = Path::new(env!("CARGO_MANIFEST_DIR")).join(case);
        std::fs::copy(&from, cases.join(from.file_name().unwrap())).unwrap();
    }
    let run = |args: &[&str]| secant(args).current_dir(dir.path()).output().unwrap().status.code();
    assert_eq!(run(&["gallery", "--check"]), Some(1));
    assert_eq!(run(&["gallery"]), Some(0));
    assert_eq!(run(&["gallery", "--check"]), Some(0));
    let page = std::fs::read_to_string(dir.path().join("docs/gallery/index.html")).unwrap();
    assert!(page.contains("some/half-tangent.html") && page.contains("secant::shape::adjacency"));
    assert!(dir.path().join("docs/gallery/some/half-tangent.html").exists());
    assert_eq!(run(&["gallery", "no/such/dir"]), Some(2));
    // The search knows verdicts and kinds of what there is, and no others.
    assert!(page.contains("<option>cusp</option>") && page.contains("<option>refused</option>"));
    assert!(page.contains("data-verdict=\"proved\" data-kinds=\"cusp;") && !page.contains("<option>corner</option>"));
    // A flat directory, with reports of all.
    assert_eq!(run(&["gallery", "cases/some", "--reports", "--out", "flat"]), Some(0));
    let flat = std::fs::read_to_string(dir.path().join("flat/index.html")).unwrap();
    assert!(
        flat.contains("href=\"some/half-tangent.html\"") && dir.path().join("flat/some/half-tangent.html").exists()
    );
}

#[test]
fn colours_can_be_had_and_left_out() {
    let coloured = |args: &[&str]| {
        let out = secant(args).output().unwrap();
        (out.stdout.contains(&0x1b), out.stderr.contains(&0x1b))
    };
    assert_eq!(coloured(&["certify", "koch", "--brief"]), (false, false));
    assert_eq!(coloured(&["certify", "koch", "--brief", "--color", "always"]), (true, false));
    assert_eq!(coloured(&["--color=always", "certify", "koch", "--brief"]), (true, false));
    assert_eq!(coloured(&["certify", "none.toml", "--color=always"]), (false, true));
    assert_eq!(coloured(&["certify", "none.toml", "--color=never"]), (false, false));
    assert_eq!(coloured(&["frobnicate", "--color", "always"]), (false, true));
    assert_eq!(coloured(&["frobnicate"]), (false, false));
    output(&["certify", "koch", "--color", "pink"], 2);
}

#[test]
fn latex_is_complete() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.tex").display().to_string();
    output(&["certify", "-q", HALF, "--report", &file], 0);
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("\\begin{tikzpicture}") && text.trim_end().ends_with("\\end{document}"));
    for name in ["document", "itemize", "tabular", "quoted", "pmatrix", "center", "tikzpicture"] {
        let count = |what: &str| text.matches(&format!("\\{what}{{{name}}}")).count();
        assert_eq!(count("begin"), count("end"), "{name}");
    }
}

#[test]
fn completions_and_the_manual_are_printed() {
    assert!(output(&["completions", "bash"], 0).0.contains("secant"));
    assert!(output(&["man"], 0).0.contains(".TH"));
    assert!(output(&["man", "certify"], 0).0.contains("secant certify"));
    assert!(output(&["man", "certifi"], 2).1.contains("certify, spectrum"));
    let directory = tempfile::tempdir().unwrap();
    let pages = directory.path().join("man1");
    output(&["man", "--out", pages.to_str().unwrap()], 0);
    // The page of the program refers to those of its commands, all of which are there.
    let program = std::fs::read_to_string(pages.join("secant.1")).unwrap();
    let named: Vec<&str> =
        program.split("secant\\-").skip(1).filter_map(|t| t.split_once("(1)")).map(|t| t.0).collect();
    assert!(named.len() > 12, "{named:?}");
    for name in named.iter() {
        assert!(pages.join(format!("secant-{name}.1")).exists(), "{name}");
    }
}

#[test]
fn pictures_go_to_the_standard_output_in_the_size_asked_for() {
    let (out, err) = output(&["certify", HALF, "--svg", "-", "--size", "900"], 0);
    assert!(out.starts_with("<svg") && out.trim_end().ends_with("</svg>") && out.contains(" width=\"900\""), "{out}");
    // The verdict is beside it, and the legend names the kinds that are there.
    assert!(err.contains("proved: cusp") && out.contains(">cusp</text>") && !out.contains(">corner</text>"), "{err}");
    let (out, err) = output(&["render", "koch", "--obj", "-", "--depth", "2"], 0);
    assert!(out.starts_with("# ") && out.contains("\nv ") && err.contains("exact points"), "{out}{err}");
    let (_, err) = output(&["certify", HALF, "--svg", "-", "--certificate", "-"], 2);
    assert!(err.contains("give `-` once"), "{err}");
    output(&["certify", HALF, "--svg", "-", "--size", "5"], 2);
    let directory = tempfile::tempdir().unwrap();
    for command in ["certify", "render"] {
        let png = directory.path().join(format!("{command}.png"));
        output(&[command, HALF, "--png", png.to_str().unwrap(), "--size", "333"], 0);
        let bytes = std::fs::read(&png).unwrap();
        assert_eq!(u32::from_be_bytes(bytes[16..20].try_into().unwrap()), 333, "{command}");
    }
}

#[test]
fn the_brief_form_has_the_answers_the_points_and_the_verdict() {
    for (case, code, pieces) in [
        (HALF, 0, ["ends", "every point (G¹)  refuted", "cusp", "Holds: ends"]),
        ("cases/surfaces/bicubic-space.toml", 0, ["vertices", "proved", "tangent plane", "as required. Holds:"]),
    ] {
        let (brief, whole) = (output(&["certify", "--brief", case], code).0, output(&["certify", case], code).0);
        for piece in pieces {
            assert!(brief.contains(piece), "{piece} is missing in\n{brief}");
        }
        assert!(brief.lines().count() < 33 && 2 * brief.lines().count() < whole.lines().count(), "{brief}");
    }
}

#[test]
fn orders_of_smoothness_have_certificates() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("orders.json");
    let path = file.to_str().unwrap();
    let case = "cases/classical/takagi-landsberg-1-3.toml";
    let (out, _) = output(&["regularity", case, "--certificate", path], 0);
    assert!(out.contains("two values before piece 1: (1, -1) and (1, 1)"), "{out}");
    let accepted = secant_check::check(
        &std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(case)).unwrap(),
        &std::fs::read_to_string(&file).unwrap(),
    );
    assert!(accepted.unwrap().claims.iter().any(|c| c.to_string() == "refuted: the curve is C^1 in its parameter"));
    std::fs::remove_file(&file).unwrap();
    let (_, err) = output(&["regularity", "four-point", "--certificate", path], 2);
    assert!(err.contains("case file") && !file.exists());
}

/// The certificate of a case with `[scheme]` is about the file that people have; of a mesh it is about the case beside it.
#[test]
fn certificates_of_schemes_are_about_files() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name);
    let read = |name: &str| std::fs::read_to_string(file(name)).unwrap();
    let chaikin = "name = \"chaikin\"\n\n[scheme]\nmask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\n";
    let mesh = "name = \"six\"\n\n[scheme]\nmesh = \"loop\"\nvalence = 6\n";
    for (name, text) in [("chaikin", chaikin), ("six", mesh)] {
        std::fs::write(file(&format!("{name}.toml")), text).unwrap();
        let (case, json) = (file(&format!("{name}.toml")), file(&format!("{name}.json")));
        let arguments = ["certify", case.to_str().unwrap(), "--certificate", json.to_str().unwrap()];
        let (_, err) = output(&arguments, 0);
        assert_eq!(err.contains("expanded case"), name == "six", "{err}");
    }
    secant_check::check(&read("chaikin.toml"), &read("chaikin.json")).unwrap();
    assert!(!file("chaikin.case.toml").exists());
    let refused = secant_check::check(&read("six.toml"), &read("six.json")).unwrap_err();
    assert!(refused.why.contains("beside the certificate"), "{refused}");
    secant_check::check(&read("six.case.toml"), &read("six.json")).unwrap();
}

#[test]
fn regularity_of_masks_as_they_are_written() {
    // Superscripts lost in a text.
    for (symbol, wanted) in [("(1+z)2(1+z)/4", "^2"), ("1/2+z+z2/2", "^2"), ("(1+z)**3/4", "^3"), ("(1+z)²/2", "^2")] {
        let (_, err) = output(&["regularity", symbol], 2);
        let err = err.replace(['\n', '│'], "").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(&format!("did you mean `{wanted}`")), "{symbol}: {err}");
    }
    assert!(output(&["regularity", "(1+z)^2/2"], 0).0.contains("mask        1/2 1 1/2\n"));
    // Masks without continuous limits say so, whether their translates are independent or not.
    for arguments in [&["four-point", "w=1/2"][..], &["four-point", "w=-1/2"], &["-1/8,1/4,3/4,1/4,-1/8"], &["rbio2.2"]]
    {
        let (out, _) = output(&[&["regularity"], arguments].concat(), 0);
        assert!(out.contains("does not converge") && !out.contains("exponent"), "{out}");
    }
    assert!(output(&["regularity", "haar"], 0).0.contains("discontinuous"));
    // Radicals, decimals, names.
    let (out, _) = output(&["regularity", "(1+sqrt(3))/4,(3+sqrt(3))/4,(3-sqrt(3))/4,(1-sqrt(3))/4"], 0);
    assert!(out.contains("exponent    [0.550015686523, 0.550015686524]\nsmoothness  C^0\n"), "{out}");
    let (out, _) =
        output(&["regularity", "0.4829629131445341,0.8365163037378079,0.2241438680420134,-0.1294095225512604"], 0);
    assert!(out.contains("exponent    [0.550015686523, 0.550015686524] (of the scheme"), "{out}");
    assert!(out.contains("at most 0.0000000000000000") && out.contains("sum rules of order 2"), "{out}");
    assert!(output(&["regularity", "rbio4.4"], 0).0.contains("1.0683553757"));
    assert!(output(&["regularity", "bior4.4"], 0).0.contains("1.7011374872"));
}

#[test]
fn regularity_of_several_cases() {
    let inputs = ["four-point", "w=1/16", "db2", "1,2", "cases/classical/takagi-landsberg-1-3.toml"];
    let (out, _) = output(&[&["regularity", "--jsonl"][..], &inputs].concat(), 2);
    let lines: Vec<serde_json::Value> = out.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    let field = |k: usize, key: &str| lines[k][key].clone();
    assert_eq!(lines.len(), 4);
    assert_eq!((field(0, "input"), field(0, "smoothness")), ("four-point".into(), 1.into()));
    let exponent = field(1, "exponent");
    assert!(
        exponent.as_array().unwrap().iter().all(|x| x.as_str().unwrap().starts_with("0.55001568652")),
        "{exponent}"
    );
    assert!(field(2, "error").as_str().unwrap().contains("add up to 2"));
    assert_eq!(lines[3]["orders"][1]["joint"]["left"], serde_json::json!(["1", "-1"]));
    let (out, _) = output(&["regularity", "--json", "db2", "haar"], 0);
    let list: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((list.as_array().unwrap().len(), &list[1]["converges"]), (2, &false.into()));
    assert!(output(&["regularity", "db2", "haar"], 0).0.contains("== haar\n"));
}

/// A set whose polytope takes many points.
const OPEN: &str = r#"matrices = [
  [[0, 0, 2, 2, -2, 2], [0, -2, 0, 0, 0, 1], [0, -1, 1, 1, -1, -2], [0, -2, 0, 1, -2, 2], [1, 0, 1, 2, -2, 1], [-2, -1, 2, -1, -2, -1]],
  [[1, 0, 2, 0, 2, 0], [1, -2, 2, 0, 0, -2], [1, -2, -1, 0, 2, 2], [0, -1, 0, 0, 2, -2], [0, 0, 0, -1, -2, -1], [0, 1, -1, -2, -2, 2]],
  [[2, 1, -2, -1, 2, 0], [0, 1, 1, -1, -2, -2], [1, 0, -1, -1, 2, -1], [1, -2, -1, 1, 0, -1], [-2, 1, 0, -1, 1, 2], [-1, 2, 1, 1, 0, 1]],
]"#;

/// The answer of `secant jsr --json` about [`OPEN`].
fn radius(options: &[&str]) -> Value {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("open.toml");
    std::fs::write(&file, OPEN).unwrap();
    let (out, _) = output(&[&["jsr", file.to_str().unwrap(), "--json"], options].concat(), 0);
    serde_json::from_str(&out).unwrap()
}

fn bounds(answer: &Value) -> (f64, f64) {
    let number = |key: &str| answer[key].as_str().expect("a decimal").parse().expect("a number");
    (number("lower"), number("upper"))
}

#[test]
fn radii_are_sought_within_the_options() {
    let exact = radius(&[]);
    assert_eq!((&exact["exact"], &exact["ended"]), (&true.into(), &"done".into()));
    let (lo, hi) = bounds(&exact);
    assert!(hi - lo < 1e-12);
    let contains = |answer: &Value| bounds(answer).0 <= hi && lo <= bounds(answer).1;

    // Bounds that are close enough end the search: wider than asked for by no more.
    let wide = radius(&["--width", "0.3"]);
    assert_eq!((&wide["exact"], &wide["ended"]), (&false.into(), &"done".into()));
    let (low, high) = bounds(&wide);
    assert!(contains(&wide) && high - low > 1e-3 && high <= 1.3 * low, "{wide}");

    // No time at all: the norms of the letters, and what stopped the search.
    let short = radius(&["--time", "0.000001", "--longest", "2"]);
    assert!(contains(&short) && bounds(&short).1 > high, "{short}");
    assert!(["work", "clock"].contains(&short["ended"].as_str().unwrap()), "{short}");
    assert!(short["word"]["length"].as_u64().unwrap() <= 2);
    assert!(contains(&radius(&["--longest", "1"])));
}

#[test]
fn options_of_radii_are_checked() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("open.toml");
    std::fs::write(&file, OPEN).unwrap();
    for [option, value] in [
        ["--time", "0"],
        ["--time", "inf"],
        ["--time", "soon"],
        ["--longest", "0"],
        ["--longest", "201"],
        ["--width", "1"],
    ] {
        let (out, err) = output(&["jsr", file.to_str().unwrap(), option, value], 2);
        assert!(out.is_empty() && err.contains(option), "{option} {value}\n{err}");
    }
}

#[test]
fn two_surfaces_are_joined() {
    let joined = |more: &[&str], code: i32| {
        output(&[&["junction", "doo-sabin", "catmull-clark", "--surface"], more].concat(), code)
    };
    let found: Value = serde_json::from_str(&joined(&["--json"], 0).0).expect("JSON");
    let member = &found["member"];
    assert_eq!((&member["pattern"], &member["passes"]), (&"D,I".into(), &true.into()));
    assert_eq!((member["points"][0].as_u64(), member["parameters"].as_u64()), (Some(18), Some(24)));
    assert!(joined(&["--pattern", "I,C"], 1).0.contains("no member passes"));
    assert!(joined(&["--pattern", "D,I", "--stencil", "1/2, 1/2"], 2).1.contains("2 stencils are free"));
    let other = ["junction", "doo-sabin", "bspline degree=2 arity=3", "--surface"];
    assert!(output(&other, 2).1.contains("2, 2, 3, 3 pieces"));
}
