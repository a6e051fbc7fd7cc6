//! What may be asked about, whichever command is asked; polygons of control points; what is said where nothing fits.

use assert_cmd::Command;
use secant::arith::{Rational, ratio};
use secant::case::Case;
use secant::certificate::confirm;
use secant::theorem::surface::certify_complex;
use secant::theorem::{Certified, Kind, PointReport, Verdict};
use serde_json::Value;

fn run(args: &[&str], input: &str, code: i32) -> (String, String) {
    let mut command = Command::cargo_bin("secant").expect("the program is built");
    let out = command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args).write_stdin(input).output().expect("it runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

const CHAIKIN: &str = "name = \"c\"\n[scheme]\nmask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\n";

/// What would be written instead of a file may come from a pipe.
#[test]
fn a_line_from_a_pipe_is_what_it_would_be_as_an_argument() {
    for line in ["1/4,3/4,3/4,1/4\n", "bspline degree=2\n", "(1+z)^3/4\n"] {
        for head in ["certify", "regularity", "expand"] {
            let (piped, _) = run(&[head, "-"], line, 0);
            let (given, _) = run(&[head, line.trim()], "", 0);
            assert_eq!(piped, given, "{head} {line}");
        }
    }
    let (out, _) = run(&["spectrum", "-"], "[[1, 0], [1/2, 1/2]]\n", 0);
    assert!(out.contains("1/2"), "{out}");
}

/// One curve in all ways to write it down, for all commands.
#[test]
fn every_command_takes_every_way_to_write_a_curve() {
    let ways = [
        vec!["bspline", "degree=2"],
        vec!["1/4,3/4,3/4,1/4"],
        vec!["1/4 3/4 3/4 1/4"],
        vec!["[0.25 0.75 0.75 0.25]"],
        vec!["(1+z)^3/4"],
        vec!["[[[3/4, 1/4, 0], [1/4, 3/4, 3/4], [0, 0, 1/4]], [[1/4, 0, 0], [3/4, 3/4, 1/4], [0, 1/4, 3/4]]]"],
        vec!["-"],
    ];
    let directory = tempfile::tempdir().unwrap();
    let svg = directory.path().join("c.svg").display().to_string();
    let mut spectra = Vec::new();
    for way in &ways {
        let with = |head: &[&'static str]| -> Vec<&str> { head.iter().chain(way).copied().collect() };
        assert!(run(&with(&["certify", "-q", "--require", "g1,c1"]), CHAIKIN, 0).0.is_empty(), "{way:?}");
        assert!(run(&with(&["expand"]), CHAIKIN, 0).0.contains("pieces"), "{way:?}");
        let head = ["render", "--depth", "3", "--svg", &svg];
        let draw: Vec<&str> = head.iter().chain(way).copied().collect();
        run(&draw, CHAIKIN, 0);
        assert!(run(&with(&["regularity"]), CHAIKIN, 0).0.contains("1"), "{way:?}");
        spectra.push(run(&with(&["spectrum"]), CHAIKIN, 0).0);
    }
    let plain = |text: &String| text.lines().filter(|l| l.contains("characteristic")).collect::<Vec<_>>().join("\n");
    assert!(spectra.iter().all(|s| plain(s) == plain(&spectra[0]) && s.contains("characteristic")), "{spectra:?}");
}

#[test]
fn several_inputs_and_data_of_all() {
    let data = |args: &[&str]| -> Value { serde_json::from_str(&run(args, "", 0).0).expect("JSON") };
    let spectra = data(&["spectrum", "--json", "bspline", "degree=2", "[[1, 0], [1/2, 1/2]]"]);
    assert_eq!(spectra.as_array().map(Vec::len), Some(3));
    assert_eq!(
        (&spectra[0]["path"], &spectra[2]["path"]),
        (&"bspline degree=2".into(), &"[[1, 0], [1/2, 1/2]]".into())
    );
    let schemes = data(&["schemes", "--json"]);
    let named = |kind: &str, name: &str| {
        let found = schemes.as_array().unwrap().iter().find(|s| s["kind"] == kind && s["name"] == name);
        found.unwrap_or_else(|| panic!("{name}"))["parameters"].clone()
    };
    assert_eq!((&named("curve", "four-point")[0]["name"], named("mesh", "loop")), (&"w".into(), serde_json::json!([])));
    let cases = data(&["expand", "--json", "bspline", "four-point", "w=1/20"]);
    assert_eq!(cases[1]["path"], "four-point w=1/20");
    let lines = run(&["certify", "--jsonl", "bspline", "cases/bspline/degree-2.toml"], "", 0).0;
    let paths: Vec<Value> = lines.lines().map(|l| serde_json::from_str::<Value>(l).unwrap()["path"].clone()).collect();
    assert_eq!(paths, ["bspline", "cases/bspline/degree-2.toml"]);
}

/// What a symbol, a name or a filter was understood to be is said by every command that proves something about it.
#[test]
fn the_mask_understood_is_echoed() {
    let control = "name = \"p\"\ncontrol = [[0,0],[1,2],[3,2],[4,0],[6,1]]\n[scheme]\nsymbol = \"(1+z)^3/4\"\n";
    for (way, input) in [("(1+z)^3/4", ""), ("bspline degree=2", ""), ("[0.25 0.75 0.75 0.25]", ""), ("-", control)] {
        assert!(run(&["certify", way], input, 0).0.contains("mask (1/4, 3/4, 3/4, 1/4)"), "{way}");
        let data: Value = serde_json::from_str(&run(&["certify", "--json", way], input, 0).0).unwrap();
        assert_eq!(data["mask"], serde_json::json!({"arity": 2, "coefficients": ["1/4", "3/4", "3/4", "1/4"]}));
        assert!(run(&["regularity", way], input, 0).0.contains("1/4 3/4 3/4 1/4"), "{way}");
    }
    assert!(run(&["certify", "bspline degree=1 arity=3"], "", 0).0.contains("mask of arity 3 ("));
    assert!(!run(&["certify", "koch"], "", 1).0.contains("mask"));
}

#[test]
fn parameters_are_addresses_too() {
    for (text, address) in [("1/3", "(01)"), ("0.5", "1(0)"), ("0", "(0)"), ("1", "(1)"), ("t=1/6", "0(01)")] {
        let (out, _) = run(&["certify", "bspline", "--json", "--at", text], "", 0);
        let value: Value = serde_json::from_str(&out).unwrap();
        let asked = value["claims"].as_array().unwrap().iter().filter(|c| c["about"] == "points");
        let found: Vec<&Value> = asked.map(|c| &c["address"]).collect();
        assert_eq!(found, [&Value::from(address)], "{text}");
    }
    // Asked twice, in two ways, it is one point.
    let (out, _) = run(&["certify", "bspline", "--json", "--at", "1/3", "--at", "(01)"], "", 0);
    let value: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(value["claims"].as_array().unwrap().iter().filter(|c| c["about"] == "points").count(), 1);
    run(&["certify", "bspline", "--at", "3/2"], "", 2);
    run(&["certify", "sierpinski", "--at", "1/3"], "", 2);
}

fn certified(text: &str) -> (Case, Certified) {
    let case = Case::parse("p.toml", text).unwrap_or_else(|p| panic!("{text}\n{}", p.message()));
    let found = certify_complex(&case.complex(), &case.examine).unwrap();
    (case, found)
}

fn vector(numbers: &[(i64, i64)]) -> Vec<Rational> {
    numbers.iter().map(|&(p, q)| ratio(p, q)).collect()
}

/// The same curve in five ways begins near the first control point in all of them.
#[test]
fn control_points_run_with_the_parameter() {
    for scheme in [
        "name = \"bspline\"\ndegree = 2",
        "name = \"de-rham\"\na = \"1/4\"",
        "name = \"corner-cutting\"\na = \"1/4\"\nb = \"1/4\"",
        "mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]",
        "symbol = \"(1+z)^3/4\"",
        "filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]\nnormalisation = \"root\"",
    ] {
        let (case, found) = certified(&format!("name = \"p\"\ncontrol = [[0,0],[1,2],[5,0]]\n[scheme]\n{scheme}\n"));
        assert_eq!(found.points[0].image, Some(vector(&[(1, 2), (1, 1)])), "{scheme}");
        let tangent = found.points[0].tangent.as_ref().and_then(|d| d.rational());
        assert_eq!(tangent, Some(vector(&[(1, 1), (2, 1)])), "{scheme}");
        confirm(&case, &found).unwrap_or_else(|doubt| panic!("{scheme}: {doubt}"));
    }
}

const POINTS: &str = "name = \"p\"\ncontrol = [[0,0],[1,2],[3,2],[4,0],[6,1]]\n[scheme]\nname = \"bspline\"\n";

fn polygon(degree: usize, more: &str) -> (Case, Certified) {
    certified(&format!("{POINTS}degree = {degree}\n{more}\n"))
}

fn end(found: &Certified, k: usize) -> (&PointReport, Vec<Rational>, Vec<Rational>) {
    let point = &found.points[k];
    assert_eq!((point.verdict, point.kind), (Verdict::Proved, Kind::SmoothEnd));
    let tangent = point.tangent.as_ref().and_then(|d| d.rational()).unwrap();
    (point, point.image.clone().unwrap(), tangent)
}

#[test]
fn an_open_polygon_is_a_curve_of_several_spans() {
    let (case, found) = polygon(2, "");
    assert_eq!(case.shape.states[case.shape.start].pieces.len(), 3);
    assert_eq!((end(&found, 0).1, end(&found, 0).2), (vector(&[(1, 2), (1, 1)]), vector(&[(1, 1), (2, 1)])));
    assert_eq!((end(&found, 1).1, end(&found, 1).2), (vector(&[(5, 1), (1, 2)]), vector(&[(2, 1), (1, 1)])));
    // The joints of the spans are the midpoints of the edges, with their directions.
    let joints: Vec<&PointReport> = found.points.iter().filter(|p| p.kind == Kind::Regular).collect();
    assert!(joints.iter().any(|p| p.image == Some(vector(&[(2, 1), (2, 1)]))), "{joints:?}");
    assert_eq!(found.everywhere.as_ref().unwrap().verdict, Verdict::Proved);
    confirm(&case, &found).unwrap_or_else(|doubt| panic!("{doubt}"));
}

#[test]
fn a_clamped_polygon_begins_and_ends_at_its_points() {
    for degree in [2, 3, 4] {
        let (case, found) = polygon(degree, "ends = \"clamped\"");
        assert_eq!((end(&found, 0).1, end(&found, 0).2), (vector(&[(0, 1), (0, 1)]), vector(&[(1, 1), (2, 1)])));
        assert_eq!((end(&found, 1).1, end(&found, 1).2), (vector(&[(6, 1), (1, 1)]), vector(&[(2, 1), (1, 1)])));
        confirm(&case, &found).unwrap_or_else(|doubt| panic!("{degree}: {doubt}"));
        // The same knots, written down; and one span more where an inner knot is there.
        let knots: Vec<String> =
            (0..5 + degree + 1).map(|k| k.saturating_sub(degree).min(5 - degree).to_string()).collect();
        let (other, _) = polygon(degree, &format!("knots = [{}]", knots.join(", ")));
        assert_eq!(other.expanded(), case.expanded());
    }
}

/// The first span comes once more at the end, so that the curve is smooth where it closes too; with equal spans it is C^(d−1).
#[test]
fn a_closed_polygon_closes_smoothly() {
    let (case, found) = polygon(2, "ends = \"closed\"");
    assert_eq!(case.shape.states[case.shape.start].pieces.len(), 6);
    assert_eq!(found.everywhere.as_ref().unwrap().verdict, Verdict::Proved, "{:?}", found.everywhere);
    let required = |list: &str| secant::theorem::Required::parse(list).unwrap().verdict(&found.claims);
    assert_eq!((required("c1"), required("c2")), (Verdict::Proved, Verdict::Refuted));
    confirm(&case, &found).unwrap_or_else(|doubt| panic!("{doubt}"));
}

#[test]
fn polygons_that_do_not_fit_are_refused() {
    let id = |text: &str| Case::parse("p.toml", text).map(|_| String::new()).unwrap_or_else(|p| p.id().to_owned());
    assert_eq!(id(&format!("{POINTS}degree = 6\n")), "secant::case::control");
    assert_eq!(id(&format!("{POINTS}degree = 2\nknots = [0, 1, 2]\n")), "secant::case::scheme-parameter");
    assert_eq!(id("name = \"p\"\n[scheme]\nname = \"bspline\"\nends = \"closed\"\n"), "secant::case::polygon");
    let four =
        "name = \"p\"\ncontrol = [[0],[1],[2],[4],[5],[7],[8]]\n[scheme]\nname = \"four-point\"\nends = \"clamped\"\n";
    assert_eq!(id(four), "secant::case::polygon");
    let bezier = "name = \"p\"\ncontrol = [[0],[1],[2],[4],[5],[7]]\n[scheme]\nname = \"bezier\"\n";
    assert_eq!(id(bezier), "secant::case::polygon");
}

#[test]
fn mistakes_are_told_with_a_remedy() {
    let told = |args: &[&str], input: &str| {
        let text = run(args, input, 2).1;
        text.split_whitespace().filter(|w| *w != "│").collect::<Vec<_>>().join(" ")
    };
    for (args, input, piece) in [
        (&["certify", "four-pont"][..], "", "did you mean `four-point`?"),
        (&["regularity", "four-pont"], "", "did you mean `four-point`?"),
        (&["certify", "db7"], "", "secant regularity"),
        (&["certify", "-"], "name = \"a\"\n[scheme]\nmaks = [1]\n", "did you mean `mask`"),
        (&["certify", "-"], "name = \"a\"\n[[scheme]]\nname = \"bspline\"\n", "secant junction"),
        (&["certify", "-"], "name = \"a\"\n[vertex]\nmesh = \"loop\"\nvalence = 5\nweights = [1]\n", "loop-variant"),
        (&["import", "cases/meshes/cube.obj"], "", "secant certify cases/meshes/cube.obj"),
        (&["jsr", "four-point"], "", "secant regularity"),
        (&["region", "four-point"], "", "w=-1/2..1/2"),
        (&["certify", "loop"], "", "[vertex] mesh"),
        (&["certify", "-"], "name = \"c\"\n[scheme]\nmask = [1/4, 3/4]\n", "\"1/4\""),
        (&["certify", "-"], "name = \"c\"\n[scheme]\nname = \"bspline\"\ncontrol = [[0]]\n", "above the line [scheme]"),
        (&["certify", "-"], "name = \"v\"\n[vertex]\nmesh = \"loop\"\nvalence = 5000\n", "between 2 and 1024"),
        (&["certify", "-"], "name = \"p\"\nmatrices = [[[1]]]\n", "secant jsr"),
        (&["certify", "-"], "v 0 0 0\nv 1 0 0\nf 1 2 2\n", "mesh in the Wavefront format"),
        (&["certify", "-"], "{\"maps\": []}", "secant import"),
        (&["certify", "four-point", "--svg", "x.png"], "", "--png x.png"),
        (&["render", "four-point", "--png", "x.svg"], "", "--svg x.svg"),
        (&["regularity", "1/4,w,1/4"], "", "a letter has no value"),
        (&["render", "four-point", "--depth", "40", "--svg", "/tmp/none.svg"], "", "words of 40 letters"),
        (
            &["certify", "four-point", "-q", "--svg", "/nonexistent/x.svg"],
            "",
            "No such file or directory (os error 2) help",
        ),
        (&["jsr", "cases/bspline/degree-2.toml"], "", "this is a case"),
        (&["gallery", "docs"], "", "DIR/FAMILY/CASE.toml"),
    ] {
        let text = told(args, input);
        assert!(text.contains(piece), "{args:?}: {piece} is missing in\n{text}");
    }
    let (_, err) = run(&["schemes", "nope"], "", 2);
    assert!(!err.contains("did you mean"), "{err}");
    // A picture that fails takes no verdict with it.
    let (out, _) = run(&["certify", "koch", "--draw", "cones", "--svg", "/tmp/no-cones.svg"], "", 2);
    assert!(out.contains("refuted"), "{out}");
}
