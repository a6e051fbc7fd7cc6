//! Outputs of the program: none takes the place of what was read, none is lost in silence, and none takes the answer with it.

use assert_cmd::Command;
use std::path::Path;

fn run(dir: &Path, args: &[&str], code: i32) -> (String, String) {
    let mut command = Command::cargo_bin("secant").expect("the program is built");
    let out = command.current_dir(dir).args(args).output().expect("the program runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

const CASE: &str = "name = \"ok\"\n[scheme]\nname = \"bspline\"\ndegree = 2\n";
const SPANS: &str =
    "name = \"q\"\ncontrol = [[0, 0], [1, 2], [3, 2], [4, 0]]\n[scheme]\nname = \"bspline\"\ndegree = 2\n";
const MATRICES: &str = "matrices = [[[1, 1], [0, 1]], [[1, 0], [1, 1]]]\n";
const FAMILY: &str = "name = \"w\"\n[parameters]\nw = \"0..1/8\"\n[scheme]\nname = \"four-point\"\nw = \"w\"\n";
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn no_output_takes_the_place_of_what_was_read() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    let files = [
        ("ok.toml", CASE),
        ("s.svg", CASE),
        ("p.toml", MATRICES),
        ("w.toml", FAMILY),
        ("q.case.toml", SPANS),
        ("g.obj", MESH),
    ];
    for (name, text) in files {
        std::fs::write(dir.join(name), text).expect("written");
    }
    for args in [
        &["certify", "ok.toml", "-q", "--certificate", "ok.toml"][..],
        &["certify", "ok.toml", "-q", "--certificate", "./ok.toml"],
        &["certify", "s.svg", "-q", "-o", "s.svg"],
        &["certify", "w.toml", "w=1/16", "-q", "--certificate", "w.toml"],
        &["certify", "q.case.toml", "-q", "--certificate", "q.json"],
        &["certify", "g.obj", "--scheme", "loop", "-q", "--ply", "g.obj"],
        &["jsr", "p.toml", "--certificate", "p.toml"],
        &["regularity", "ok.toml", "--certificate", "ok.toml"],
        &["region", "w.toml", "--certificate", "w.toml"],
        &["spectrum", "ok.toml", "--certificate", "ok.toml"],
        &["expand", "ok.toml", "-o", "ok.toml"],
        &["render", "s.svg", "-o", "s.svg"],
        &["refine", "ok.toml", "-o", "ok.toml"],
        &["junction", "ok.toml", "four-point", "-o", "ok.toml"],
    ] {
        let (_, err) = run(dir, args, 2);
        assert!(
            err.contains("secant::output::input") && err.contains("is the case itself; nothing was written"),
            "{args:?}\n{err}"
        );
    }
    for (name, text) in files {
        assert_eq!(std::fs::read_to_string(dir.join(name)).expect("it is there"), text, "{name}");
    }
    let mut names: Vec<_> = std::fs::read_dir(dir).expect("a list").map(|e| e.expect("a file").file_name()).collect();
    names.sort();
    assert_eq!(names, ["g.obj", "ok.toml", "p.toml", "q.case.toml", "s.svg", "w.toml"]);
}

#[test]
fn neither_two_outputs_nor_a_case_of_somebody_else_are_written_over() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    std::fs::write(dir.join("mine.toml"), SPANS).expect("written");
    std::fs::write(dir.join("mine.case.toml"), CASE).expect("written");
    let (_, err) = run(dir, &["certify", "mine.toml", "-q", "-o", "a3.html", "--svg", "./a3.html"], 2);
    assert!(err.contains("secant::output::twice") && !dir.join("a3.html").exists(), "{err}");
    let (out, err) = run(dir, &["certify", "mine.toml", "--certificate", "mine.json", "--svg", "a.svg"], 2);
    assert!(err.contains("secant::output::beside") && out.contains("Verdict"), "{err}");
    assert!(dir.join("a.svg").exists() && !dir.join("mine.json").exists());
    assert_eq!(std::fs::read_to_string(dir.join("mine.case.toml")).expect("it is there"), CASE);
    // What was written there before is replaced.
    std::fs::remove_file(dir.join("mine.case.toml")).expect("removed");
    run(dir, &["certify", "mine.toml", "-q", "--certificate", "mine.json"], 0);
    run(dir, &["spectrum", "mine.toml", "--certificate", "mine.json"], 0);
    std::fs::write(dir.join("mine.toml"), SPANS.replace("[4, 0]", "[5, 0]")).expect("written");
    run(dir, &["certify", "mine.toml", "-q", "--certificate", "mine.json"], 0);
    let beside = std::fs::read_to_string(dir.join("mine.case.toml")).expect("it is there");
    let certificate = std::fs::read_to_string(dir.join("mine.json")).expect("it is there");
    assert!(beside.contains("[5, 0]") && secant_check::check(&beside, &certificate).is_ok());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_success_and_a_reader_that_leaves_is_one() {
    use std::fs::OpenOptions;
    use std::process::{Command, Stdio};
    let program = assert_cmd::cargo::cargo_bin("secant");
    for args in [&["certify", "chaikin", "--json"][..], &["schemes"], &["--help"], &["render", "koch", "--svg", "-"]] {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("the device");
        let out =
            Command::new(&program).args(args).stdout(full).stderr(Stdio::piped()).output().expect("the program runs");
        let err = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{args:?}");
        assert!(err.contains("secant::output") && err.contains("standard output cannot be written"), "{args:?} {err}");
    }
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let out = Command::new(&program).args(["schemes"]).stdout(writer).output().expect("the program runs");
    assert_eq!(out.status.code(), Some(0));
}

#[test]
fn a_file_that_cannot_be_made_takes_no_answer_with_it() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    std::fs::write(dir.join("np.txt"), "[[1 1]\n [0 1]]\n[[1 0]\n [1 1]]\n").expect("written");
    std::fs::write(dir.join("golden.txt"), "2\n(1+sqrt(5))/4 1/4\n0 1/2\n").expect("written");
    let vertex = "name = \"lv\"\n[parameters]\nb = \"1/20..1/16\"\n[vertex]\nmesh = \"loop-variant\"\nbeta = \"b\"\nvalence = 4\n";
    std::fs::write(dir.join("lv.toml"), vertex).expect("written");
    for (args, answer) in [
        (&["jsr", "np.txt", "--certificate", "c.json", "--svg", "c.svg"][..], "1.6180"),
        (&["regularity", "db2", "--certificate", "c.json"], "0.55"),
        (&["spectrum", "golden.txt", "--certificate", "c.json"], "moduli"),
        (&["region", "lv.toml", "--effort", "quick", "--certificate", "c.json", "--report", "c.md"], "Valence 4"),
        (&["certify", "four-point", "--coq", "no/such/c.v", "--svg", "c.svg"], "Verdict"),
    ] {
        let (out, err) = run(dir, args, 2);
        assert!(out.contains(answer) && err.starts_with("secant::"), "{args:?}\n{out}\n{err}");
        for file in ["c.svg", "c.md"].iter().filter(|f| args.contains(f)) {
            std::fs::remove_file(dir.join(file)).unwrap_or_else(|e| panic!("{args:?}: {file}: {e}"));
        }
        assert!(!dir.join("c.json").exists());
    }
}

#[test]
fn values_in_a_file_are_values() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    let scheme = "[scheme]\nname = \"four-point\"\nw = \"w\"\n";
    for (k, head) in
        ["[parameters] # mine\nw = \"1/16\"\n", "parameters = { w = \"1/16\" }\n", "parameters.w = \"1/16\"\n"]
            .iter()
            .enumerate()
    {
        let (value, range) = (format!("m{k}.toml"), format!("r{k}.toml"));
        std::fs::write(dir.join(&value), format!("name = \"m\"\n{head}{scheme}")).expect("written");
        std::fs::write(dir.join(&range), format!("name = \"m\"\n{}{scheme}", head.replace("1/16", "0..1/8")))
            .expect("written");
        let (out, _) = run(dir, &["certify", "-q", "--jsonl", &value, &range, "w=1/16", "--require", "c1"], 0);
        assert!(out.is_empty() || out.lines().count() == 2, "{out}");
        let (own, _) = run(dir, &["expand", &value], 0);
        let (set, _) = run(dir, &["expand", &range, "w=1/16"], 0);
        assert_eq!(own, set);
        let (out, _) = run(dir, &["regularity", &value], 0);
        assert!(out.contains("-1/16"), "{out}");
        let (_, err) = run(dir, &["certify", &range], 2);
        assert!(err.contains("the parameter `w` has a range and no value"), "{err}");
    }
    run(dir, &["render", "m0.toml", "-o", "m.svg"], 0);
    run(dir, &["certify", "-q", "m0.toml", "--certificate", "m.json"], 0);
    let [case, certificate] =
        ["m.case.toml", "m.json"].map(|f| std::fs::read_to_string(dir.join(f)).expect("it is there"));
    assert!(secant_check::check(&case, &certificate).is_ok());
    // A problem is shown at the line of the file.
    let wrong = "name = \"m\"\n\n[parameters]\nw = \"0..1/8\"\n\n[scheme]\nname = \"four-point\"\nw = \"w\"\nu = 1\n";
    std::fs::write(dir.join("wrong.toml"), wrong).expect("written");
    let (_, err) = run(dir, &["certify", "wrong.toml", "w=1/16"], 2);
    assert!(err.contains("wrong.toml:9:1"), "{err}");
}

#[test]
fn parameters_go_with_the_valence_and_into_symbols() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    let family = |beta: &str| {
        format!(
            "name = \"lv\"\n[parameters]\nb = \"1/8..1/2\"\n[vertex]\nmesh = \"loop-variant\"\nbeta = \"{beta}\"\nvalence = \"4,5\"\n"
        )
    };
    let head = "name = \"sy\"\n[parameters]\nw = \"0..1/8\"\n[scheme]\n";
    for (name, text) in [
        ("lv.toml", family("b/n")),
        ("is.toml", family("b/n").replace("b = \"1/8..1/2\"", "b = \"3/8\"")),
        ("plain.toml", family("(3/8)/n").replace("[parameters]\nb = \"1/8..1/2\"\n", "")),
        ("sy.toml", format!("{head}symbol = \"(1+z)*(1/2-w+2w*z+(1/2-w)*z^2)\"\n")),
        ("list.toml", format!("{head}mask = [\"1/2-w\", \"1/2+w\", \"1/2+w\", \"1/2-w\"]\n")),
        ("z.toml", format!("{}symbol = \"(1+z)^2/2\"\n", head.replace("w = ", "z = "))),
    ] {
        std::fs::write(dir.join(name), text).expect("written");
    }
    let answers = |args: &[&str]| {
        let (out, _) = run(dir, &[&["certify", "--json"][..], args].concat(), i32::from(args.contains(&"w=1/16")));
        let data: serde_json::Value = serde_json::from_str(&out).expect("JSON");
        (data["claims"].clone(), data["valences"].clone())
    };
    assert_eq!(answers(&["lv.toml", "b=3/8"]), answers(&["plain.toml"]));
    assert_eq!(answers(&["is.toml"]), answers(&["plain.toml"]));
    assert_eq!(answers(&["sy.toml", "w=1/16"]), answers(&["list.toml", "w=1/16"]));
    let (_, err) = run(dir, &["region", "lv.toml"], 2);
    assert!(err.contains("the parameter `b` and the valence in one weight"), "{err}");
    let (_, err) = run(dir, &["region", "sy.toml"], 2);
    assert!(err.contains("written as a list"), "{err}");
    let (_, err) = run(dir, &["certify", "z.toml", "z=1/16"], 2);
    assert!(err.contains("`z` has a meaning of its own"), "{err}");
}

#[test]
fn what_people_type_is_taken_or_told() {
    let dir = tempfile::tempdir().expect("a directory");
    let dir = dir.path();
    std::fs::write(dir.join("np.txt"), "[array([[1., 1.],\n       [0., 1.]]), array([[1., 0.],\n       [1., 1.]])]\n")
        .expect("written");
    let minus = "-1/16,0,9/16,1,9/16,0,-1/16";
    run(dir, &["certify", "-q", minus], 0);
    run(dir, &["certify", minus, "-q", "--require", "c1"], 0);
    run(dir, &["render", minus, "-o", "m.svg"], 0);
    assert!(run(dir, &["jsr", "np.txt"], 0).0.contains("1.6180"));
    run(dir, &["certify", "-q", "(1+sqrt(3))/4,(3+sqrt(3))/4,(3-sqrt(3))/4,(1-sqrt(3))/4"], 1);
    assert!(run(dir, &["schemes", "chaikin"], 0).0.contains("bspline"));
    for (args, said) in [
        (&["region", "four-pont", "w=0..1/4"][..], "did you mean `four-point`?"),
        (&["region", "chaikin"], "no parameter that is left free"),
        (&["region", "1/4,3/4,3/4,1/4"], "no parameter that is left free"),
        (&["certify", "four-point", "w=1/20", "w=1/10"], "`w` is given twice"),
        (&["regularity", "four-point", "w=1/20", "w=1/10"], "`w` is given twice"),
        (&["certify", "four-point", "--set", "w"], "NAME=VALUE"),
        (&["certify", "g.obj", "--scheme", "loop", "--set", "a=1"], "a mesh has no parameters"),
        (&["regularity", "."], "is a directory"),
        (&["certify", "0.1666666,0.8333333,0.8333333,0.1666666"], "decimals of fractions"),
    ] {
        let (_, err) = run(dir, args, 2);
        assert!(err.contains(said), "{args:?}\n{err}");
    }
}
