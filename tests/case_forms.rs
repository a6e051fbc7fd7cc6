//! Case files with schemes, faces and unknown entries: what they give, and how mistakes are told.

use secant::arith::ratio;
use secant::case::{Case, Origin};
use secant::diagnostic::Problem;
use secant::scheme::{self};
use secant::shape::{CellKind, End};
use std::path::Path;

fn scheme_case(table: &str) -> String {
    format!("name = \"t\"\n[scheme]\n{table}\n")
}

fn read(text: &str) -> Case {
    Case::parse("t.toml", text).unwrap_or_else(|p| panic!("{p:?}\n{text}"))
}

fn refused(text: &str) -> Problem {
    match Case::parse("t.toml", text) {
        Err(problem) => problem,
        Ok(_) => panic!("accepted:\n{text}"),
    }
}

#[test]
fn points_are_interpolated() {
    let table = "interpolate = [[0, 0], [1, 2], [2, 1], [4, 3]]\nvertical = [\"1/3\", \"-1/4\", 0.5]";
    let case = read(&scheme_case(table));
    let again = round_trip(&case);
    assert!(case.expanded().contains("[[map]]") && again.shape.frame == case.shape.frame);
    // The curve runs from the first point to the last, and its pieces from each point to the next.
    let shape = &case.shape;
    let control = shape.control.as_ref().unwrap();
    let [start, end] = [End::Start, End::Finish].map(|e| shape.end_point(0, e).unwrap());
    let seen = |p: &[secant::arith::Rational]| control.apply(p);
    assert_eq!((seen(&start), seen(&end)), (vec![ratio(0, 1), ratio(0, 1)], vec![ratio(4, 1), ratio(3, 1)]));
    let joints: Vec<_> = shape.states[0].pieces.iter().map(|p| seen(&p.op.apply(&end))).collect();
    assert_eq!(joints, [[1, 2], [2, 1], [4, 3]].map(|p| p.map(|x| ratio(x, 1)).to_vec()));
    for (wrong, place) in [
        ("interpolate = [[0, 0], [1, 2], [2, 1]]", "vertical"),
        ("interpolate = [[0, 0], [1, 2], [1, 1]]\nvertical = [0, 0]", "increasing"),
        ("interpolate = [[0, 0], [1, 2], [2, 1]]\nvertical = [0, 1]", "between"),
        ("interpolate = [[0, 0], [1, 2], [2, 1]]\nvertical = [0]", "one factor"),
        ("interpolate = [[0, 0], [1, 2, 3], [2, 1]]\nvertical = [0, 0]", "coordinates"),
        ("interpolate = []\nvertical = []", "at least 3"),
        ("interpolate = [[0, 0], [1, 2], [2, 1]]\nvertical = [0, 0]\nmask = [1]", "exclude"),
        ("interpolate = [[0, 0], [1, 2], [2, 1]]\nvertical = [0, 0]\narity = 2", "arity"),
    ] {
        let problem = refused(&scheme_case(wrong));
        let text = problem.render(false);
        assert!(text.contains(place), "{wrong}: {place} is missing in {text}");
        assert!(problem.position().is_some() && problem.remedy().is_some(), "{text}");
    }
}

/// The case written out is the same shape.
fn round_trip(case: &Case) -> Case {
    let again = read(&case.expanded());
    assert_eq!(again.examine, case.examine);
    assert_eq!(again.shape.states.len(), case.shape.states.len());
    for (a, b) in case.shape.states.iter().zip(&again.shape.states) {
        assert_eq!((&a.name, a.kind, a.dim), (&b.name, b.kind, b.dim));
        for (p, q) in a.pieces.iter().zip(&b.pieces) {
            assert_eq!((&p.op, p.target, p.reversed), (&q.op, q.target, q.reversed));
        }
        for (p, q) in [(&a.left, &b.left), (&a.right, &b.right)] {
            assert_eq!(p.as_ref().map(|x| (x.vertex, &x.op)), q.as_ref().map(|x| (x.vertex, &x.op)));
        }
    }
    assert_eq!(case.faces.len(), again.faces.len());
    for (a, b) in case.faces.values().zip(again.faces.values()) {
        assert_eq!((a.layout, &a.placement), (b.layout, &b.placement));
        for (s, t) in a.sides.iter().zip(&b.sides) {
            assert_eq!((s.edge, &s.op), (t.edge, &t.op));
        }
    }
    again
}

#[test]
fn every_form_of_a_scheme_gives_chaikins_curve() {
    let named = read(&scheme_case("name = \"bspline\"\ndegree = 2"));
    assert!(matches!(&named.scheme, Some(Origin::Mask(m)) if m.coefficients().len() == 4));
    for table in [
        "mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]",
        "mask = [0, 0.25, 0.75, 0.75, 0.25, 0]\narity = 2",
        "symbol = \"(1+z)^3/4\"",
        "filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]\nnormalisation = \"root\"",
        "filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]\nnormalisation = \"one\"",
        "filter = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\nnormalisation = \"arity\"",
    ] {
        let case = read(&scheme_case(table));
        for (p, q) in case.shape.states[0].pieces.iter().zip(&named.shape.states[0].pieces) {
            assert_eq!(p.op, q.op, "{table}");
        }
    }
    let with_vertices = read(&scheme_case("name = \"bspline\"\ndegree = 2\nvertices = true"));
    assert_eq!(with_vertices.shape.states.iter().map(|s| s.dim).collect::<Vec<_>>(), [3, 2]);
    with_vertices.complex().check().unwrap();
}

#[test]
fn every_named_scheme_is_a_case_and_its_own_expansion() {
    for info in scheme::list() {
        let values = match info.name {
            "corner-cutting" => "a = \"-1/4\"\nb = \"1/2\"",
            _ => "",
        };
        let case = read(&scheme_case(&format!("name = \"{}\"\n{values}", info.name)));
        round_trip(&case);
        if case.shape.states[0].kind == CellKind::Edge {
            let case = read(&scheme_case(&format!("name = \"{}\"\n{values}\nvertices = true", info.name)));
            assert!(case.complex().check().unwrap() > 0, "{}", info.name);
        }
    }
}

#[test]
fn patches_are_written_out_and_read_again() {
    for table in [
        "tensor = [{ name = \"bspline\", degree = 3 }, { name = \"bspline\", degree = 3 }]",
        "tensor = [{ symbol = \"(1+z)^3/4\" }, { name = \"dragon\" }]",
        "mesh = \"loop\"\nvalence = 6",
        "mesh = \"catmull-clark\"\nvalence = 3",
        "mesh = \"doo-sabin-catmull-clark\"\nvalence = 5",
        "mesh = \"loop-variant\"\nbeta = \"1/20\"\nvalence = 5\ncell = \"disc\"",
    ] {
        let case = read(&scheme_case(table));
        let again = round_trip(&case);
        assert!(again.scheme.is_none() && case.scheme.is_some());
        assert_eq!(case.complex().check().unwrap(), again.complex().check().unwrap());
    }
    let case = read(&scheme_case("mesh = \"catmull-clark\"\nvalence = 5"));
    let Some(Origin::Mesh { rule, valence: 5, disc: false }) = case.scheme else { panic!("{:?}", case.scheme) };
    assert_eq!(rule.info().name, "catmull-clark");
}

#[test]
fn mistakes_in_schemes_have_a_code_a_line_and_a_remedy() {
    for (table, code, line, remedy) in [
        ("", "missing-key", 2, "name"),
        ("name = \"bspine\"", "scheme", 3, "bspline"),
        ("name = \"bspline\"\ndegre = 3", "scheme-parameter", 4, "secant schemes"),
        ("name = \"bspline\"\ndegree = \"1/2\"", "scheme-parameter", 4, "secant schemes"),
        ("name = \"corner-cutting\"\na = 0.25", "scheme-parameter", 3, "b ="),
        ("name = \"bspline\"\nmask = [1]", "two-forms", 4, "one of"),
        ("mask = [\"1/4\", \"3/4\", \"1/4\"]", "sum-rule", 3, "even and the odd"),
        ("mask = [1, 3, 3, 1]", "sum-rule", 3, "normalisation"),
        ("mask = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\narity = 3", "sum-rule", 3, "arity"),
        ("mask = [1, 1]", "scheme", 3, "schemes.md"),
        ("mask = [\"1/4\", \"x\"]", "number", 3, "fraction"),
        ("mask = [1, 1, 1]\narity = 1", "scheme", 4, "schemes.md"),
        ("mask = [1, \"1/2\"]\ndegree = 3", "unknown-key", 4, "arity"),
        ("symbol = \"(1+z)^3/4 +\"", "symbol", 3, "symbol is written"),
        ("filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]", "missing-key", 2, "root"),
        ("filter = [1]\nnormalisation = \"two\"", "value", 4, "arity, one, root"),
        ("tensor = [{ name = \"bspline\" }]", "value", 3, "two curves"),
        ("tensor = [{ name = \"bspline\" }, { name = \"fern\" }]", "scheme-parameter", 3, "secant schemes"),
        ("mesh = \"catmul-clark\"\nvalence = 5", "scheme", 3, "catmull-clark"),
        ("mesh = \"catmull-clark\"", "missing-key", 2, "valence"),
        ("mesh = \"catmull-clark\"\nvalence = 2", "scheme-parameter", 4, "secant schemes"),
        ("mesh = \"four-eight\"\nvalence = 5", "scheme", 3, "schemes.md"),
    ] {
        let problem = refused(&scheme_case(table));
        assert_eq!(problem.id(), format!("secant::case::{code}"), "{table}: {problem:?}");
        assert_eq!(problem.position().map(|p| p.0), Some(line), "{table}: {problem:?}");
        assert!(problem.remedy().is_some_and(|r| r.contains(remedy)), "{table}: {problem:?} {:?}", problem.remedy());
    }
    let with_kind = refused("name = \"t\"\nconvention = \"rows\"\n[scheme]\nname = \"bspline\"\n");
    assert_eq!((with_kind.id(), with_kind.position()), ("secant::case::two-forms", Some((2, 1))));
}

/// A bilinear patch written by hand: a face on four points, one edge state, one vertex state.
const BILINEAR: &str = r#"name = "bilinear"
convention = "columns"
start = "F"

[[state]]
name = "F"
kind = "face"
dimension = 4
layout = "2x2"
bottom = { edge = "E", points = [0, 1] }
right = { edge = "E", points = [1, 2] }
top = { edge = "E", points = [3, 2] }
left = { edge = "E", points = [0, 3] }
[[state.piece]]
to = "F"
matrix = [[1, "1/2", "1/4", "1/2"], [0, "1/2", "1/4", 0], [0, 0, "1/4", 0], [0, 0, "1/4", "1/2"]]
[[state.piece]]
to = "F"
matrix = [["1/2", 0, 0, "1/4"], ["1/2", 1, "1/2", "1/4"], [0, 0, "1/2", "1/4"], [0, 0, 0, "1/4"]]
[[state.piece]]
to = "F"
matrix = [["1/2", "1/4", 0, 0], [0, "1/4", 0, 0], [0, "1/4", "1/2", 0], ["1/2", "1/4", "1/2", 1]]
[[state.piece]]
to = "F"
matrix = [["1/4", 0, 0, 0], ["1/4", "1/2", 0, 0], ["1/4", "1/2", 1, "1/2"], ["1/4", 0, 0, "1/2"]]

[[state]]
name = "E"
left = { vertex = "v", points = [0] }
right = { vertex = "v", points = [1] }
[[state.piece]]
to = "E"
matrix = [[1, "1/2"], [0, "1/2"]]
[[state.piece]]
to = "E"
matrix = [["1/2", 0], ["1/2", 1]]

[[state]]
name = "v"
kind = "vertex"
[[state.piece]]
to = "v"
matrix = [[1]]
"#;

#[test]
fn a_face_written_by_hand() {
    let case = read(BILINEAR);
    assert_eq!(case.faces[&0].sides[2].op.column(0), vec![ratio(0, 1), ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    // Twelve and four corners of the face, three of the edge.
    assert_eq!(case.complex().check().unwrap(), 19);
    round_trip(&case);
}

#[test]
fn mistakes_in_faces_have_a_code_and_a_remedy() {
    let change = |from: &str, to: &str| {
        assert!(BILINEAR.contains(from));
        refused(&BILINEAR.replacen(from, to, 1))
    };
    for (from, to, code) in [
        ("layout = \"2x2\"\n", "", "missing-key"),
        ("\"2x2\"", "\"2x3\"", "layout"),
        ("\"2x2\"", "\"two\"", "layout"),
        ("\"2x2\"", "\"triangle\"", "layout"),
        ("top = { edge = \"E\", points = [3, 2] }\n", "", "missing-key"),
        ("points = [3, 2]", "points = [3]", "size"),
        ("points = [3, 2]", "points = [3, 4]", "range"),
        ("points = [3, 2]", "points = [3, 2], matrix = [[1]]", "two-forms"),
        ("points = [3, 2]", "matrix = [[1], [0], [0], [0]]", "size"),
        ("top = { edge = \"E\"", "top = { edge = \"F\"", "boundary"),
        ("top = { edge = \"E\"", "top = { edge = \"G\"", "unknown-state"),
        ("top = {", "side01 = {", "layout"),
        ("[[state.piece]]\nto = \"F\"", "[[state.piece]]\ncorners = [0, 0, 1, 2]\nto = \"F\"", "corners"),
        ("[[state.piece]]\nto = \"F\"", "[[state.piece]]\nreversed = true\nto = \"F\"", "unknown-key"),
        ("[[state.piece]]\nto = \"F\"", "[[state.piece]]\nto = \"E\"", "target-kind"),
    ] {
        let problem = change(from, to);
        assert_eq!(problem.id(), format!("secant::case::{code}"), "{to}: {problem:?}");
        assert!(problem.position().is_some() && problem.remedy().is_some(), "{to}: {problem:?}");
    }
}

#[test]
fn a_failed_identity_is_shown_with_both_paths() {
    // The third piece of the face does not end where the first one of its top edge does.
    let right = "[0, \"1/4\", \"1/2\", 0], [\"1/2\", \"1/4\", \"1/2\", 1]]";
    assert!(BILINEAR.contains(right));
    let text = BILINEAR.replacen(right, "[0, \"1/4\", 0, 0], [\"1/2\", \"1/4\", 1, 1]]", 1);
    let problem = refused(&text);
    assert_eq!(problem.id(), "secant::shape::identity");
    let message = problem.message();
    assert!(message.contains("∂_top[F]") && message.contains("T_2[F]") && message.contains("incidence"), "{message}");
    assert!(problem.remedy().is_some_and(|r| r.contains("left product")), "{:?}", problem.remedy());
    // A patch turned by its corners has sides that run against each other.
    let turned = "[[state.piece]]\ncorners = [2, 3, 0, 1]\nto = \"F\"";
    let problem = refused(&BILINEAR.replacen("[[state.piece]]\nto = \"F\"", turned, 1));
    assert_eq!(problem.id(), "secant::shape::identity");
    assert!(problem.message().contains("reversal"), "{problem:?}");
}

#[test]
fn unknown_entries_are_read_where_they_are_allowed() {
    let text =
        "name = \"t\"\nconvention = \"rows\"\npieces = [[[1, 0], [\"?a\", \"?\"]], [[\"1/2\", \"1/2\"], [0, 1]]]\n";
    let problem = refused(text);
    assert_eq!((problem.id(), problem.position()), ("secant::case::unknown-entry", Some((3, 21))));
    let case = Case::parse_open("t.toml", text).unwrap();
    let found: Vec<_> = case.unknown.iter().map(|u| (u.row, u.column, u.name.as_deref())).collect();
    assert_eq!(found, [(0, 1, Some("a")), (1, 1, None)]);
    for (text, code) in [
        (text.replace("?a", "?a b"), "unknown-name"),
        (format!("{text}control = [[0, \"?\"], [1, 1]]\n"), "unknown-entry"),
        ("name = \"t\"\n[[map]]\nlinear = [[\"?\"]]\nshift = [0]\n".to_owned(), "unknown-entry"),
        (BILINEAR.replacen("[[1]]", "\"?\"", 1), "dimension"),
    ] {
        let problem = Case::parse_open("t.toml", &text).unwrap_err();
        assert_eq!(problem.id(), format!("secant::case::{code}"), "{problem:?}");
    }
    let whole =
        BILINEAR.replacen("kind = \"vertex\"", "kind = \"vertex\"\ndimension = 1", 1).replacen("[[1]]", "\"?\"", 1);
    assert_eq!(Case::parse_open("t.toml", &whole).unwrap().unknown.len(), 1);
}

#[test]
fn every_case_of_a_scheme_expands_to_a_case() {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/faces");
    for entry in std::fs::read_dir(dir).unwrap() {
        let case = Case::read(&entry.unwrap().path()).unwrap();
        round_trip(&case);
    }
}

#[test]
fn states_that_nothing_leads_to_are_found() {
    let dangling = "[[state]]\nname = \"lost\"\n[[state.piece]]\nto = \"E\"\nmatrix = [[1, 0], [0, 1]]\n";
    assert!(read(BILINEAR).dangling().is_empty());
    let case = read(&format!("{BILINEAR}\n{dangling}"));
    assert_eq!(case.dangling(), [3]);
}
