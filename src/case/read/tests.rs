use super::*;
use crate::arith::ratio;
use proptest::prelude::*;

fn refused(text: &str) -> Problem {
    match Case::parse("t.toml", text) {
        Err(problem) => problem,
        Ok(case) => panic!("accepted: {case:?}"),
    }
}

const HEAD: &str = "name = \"t\"\nconvention = \"columns\"\n";

fn with_head(rest: &str) -> String {
    format!("{HEAD}{rest}")
}

const TWO: &str = "pieces = [[[1, \"1/2\"], [0, 0.5]], [[\"1/2\", 0], [\"1/2\", 1]]]\n";

#[test]
fn reads_a_segment_exactly() {
    let case = Case::parse("t.toml", &with_head(&format!("{TWO}control = [[0, 0], [1, \"0.25\"]]\n"))).unwrap();
    assert_eq!(case.shape.states[0].pieces[0].op[(1, 1)], ratio(1, 2));
    assert_eq!(case.shape.control.as_ref().unwrap().column(1), vec![ratio(1, 1), ratio(1, 4)]);
    assert_eq!(case.title, "t");
    let problem = case.problem_at_joint(0, 0, "secant::case::adjacency", "do not meet", "mend");
    assert_eq!(problem.position(), Some((3, 11)));
}

#[test]
fn rows_are_transposed() {
    let rows = "name = \"t\"\nconvention = \"rows\"\npieces = [[[1, 0], [\"1/2\", \"1/2\"]]]\n";
    let case = Case::parse("t.toml", rows).unwrap();
    assert_eq!(case.shape.states[0].pieces[0].op[(0, 1)], ratio(1, 2));
}

#[test]
fn long_numbers_are_read() {
    let digits = "9".repeat(400);
    let text = format!("pieces = [[[\"{digits}/1{digits}\"], [\"{}/1{digits}\"]]]", "1".to_owned() + &"0".repeat(400));
    let text = with_head(&text);
    assert_eq!(refused(&text).id(), "secant::case::size");
    let square =
        with_head(&format!("pieces = [[[\"{digits}/1{digits}\", 0], [\"1{}/1{digits}\", 1]]]", "0".repeat(400)));
    assert!(Case::parse("t.toml", &square).is_ok());
}

#[test]
fn every_mistake_has_its_code() {
    let automaton = |rest: &str| {
        format!(
            "{HEAD}start = \"A\"\n[[state]]\nname = \"A\"\n{rest}\n[[state.piece]]\nto = \"A\"\nmatrix = [[1, 0], [0, 1]]\n"
        )
    };
    let cases: Vec<(String, &str)> = vec![
        (String::new(), "empty"),
        ("# only a comment\n".into(), "empty"),
        ("name = ".into(), "syntax"),
        ("a = 1\na = 2\n".into(), "syntax"),
        (format!("a = {}{}", "[".repeat(200), "]".repeat(200)), "syntax"),
        (with_head("peices = []"), "unknown-key"),
        (with_head(""), "missing-key"),
        ("name = \"t\"\npieces = [[[1]]]".into(), "missing-key"),
        ("convention = \"columns\"\npieces = [[[1]]]".into(), "missing-key"),
        ("name = \"a b\"\nconvention = \"columns\"\npieces = [[[1]]]".into(), "value"),
        ("name = \"t\"\nconvention = \"colums\"\npieces = [[[1]]]".into(), "value"),
        (with_head("pieces = 3"), "type"),
        (with_head("pieces = [3]"), "type"),
        (with_head("pieces = [[[true]]]"), "type"),
        (with_head("pieces = []"), "no-piece"),
        (with_head("pieces = [[]]"), "empty-matrix"),
        (with_head("pieces = [[[]]]"), "empty-matrix"),
        (with_head("pieces = [[[\"1/0\"]]]"), "zero-denominator"),
        (with_head("pieces = [[[\"one\"]]]"), "number"),
        (with_head("pieces = [[[nan]]]"), "number"),
        (with_head("pieces = [[[-inf]]]"), "number"),
        (with_head("pieces = [[[0x1]]]"), "number"),
        (with_head(&format!("pieces = [[[\"{}\"]]]", "1".repeat(20_000))), "number-too-long"),
        (with_head("pieces = [[[1, 0], [0]]]"), "ragged"),
        (with_head("pieces = [[[1, 0]]]"), "size"),
        (with_head("pieces = [[[1]], [[1, 0], [0, 1]]]"), "size"),
        (with_head("pieces = [[[\"1/2\", 0], [\"1/3\", 1]]]"), "sum"),
        (with_head(&format!("{TWO}reversed = [2]")), "range"),
        (with_head(&format!("kind = \"set\"\n{TWO}reversed = [1]")), "reversed-set"),
        (with_head(&format!("{TWO}control = [[0]]")), "control"),
        (with_head(&format!("{TWO}control = [[0], [0, 1]]")), "ragged"),
        (with_head(&format!("{TWO}[[examine]]\naddress = \"0\"")), "address"),
        (with_head(&format!("{TWO}[[examine]]\naddress = \"0(2)\"")), "address"),
        (with_head(&format!("{TWO}start = \"A\"")), "two-forms"),
        (with_head(&format!("{TWO}[[map]]\nlinear = [[1]]\nshift = [0]")), "two-forms"),
        (with_head(&format!("pieces = [{}]", "[[1]],".repeat(65))), "limit"),
        (with_head(&format!("pieces = [[[{}]]]", "1,".repeat(97))), "limit"),
        (with_head(&format!("pieces = [[{}]]", "[0],".repeat(97))), "limit"),
        ("name = \"t\"\nmap = 3".into(), "type"),
        ("name = \"t\"\n[map]\nlinear = [[1]]".into(), "type"),
        ("name = \"t\"\n[[map]]\nlinear = [[1]]\n".into(), "missing-key"),
        ("name = \"t\"\n[[map]]\nlinear = [[1]]\nshift = [0, 0]".into(), "size"),
        ("name = \"t\"\n[[map]]\nlinear = [[1, 2]]\nshift = [0]".into(), "size"),
        ("name = \"t\"\nconvention = \"rows\"\n[[map]]\nlinear = [[1]]\nshift = [0]".into(), "value"),
        (
            "name = \"t\"\n[[map]]\nlinear = [[1]]\nshift = [0]\n[[map]]\nlinear = [[1,0],[0,1]]\nshift = [0,0]".into(),
            "dimension",
        ),
        (automaton("dimension = 3"), "size"),
        (automaton("dimension = 0"), "range"),
        (automaton("dimension = -1"), "range"),
        (automaton("dimension = \"2\""), "type"),
        (automaton("kind = \"vertx\""), "value"),
        (automaton("left = { vertex = \"w\", matrix = [[1],[0]] }"), "unknown-state"),
        (automaton("left = { vertex = \"A\", matrix = [[1],[0]] }"), "boundary"),
        (automaton("kind = \"set\"\nleft = { vertex = \"A\", matrix = [[1],[0]] }"), "boundary"),
        (automaton("kind = \"vertex\"").replace("start = \"A\"", "start = \"B\""), "unknown-state"),
        (automaton("").replace("to = \"A\"", "to = \"B\""), "unknown-state"),
        (with_head("[[state]]\nname = \"A\"\n"), "missing-key"),
        (
            format!("{}[[state]]\nname = \"A\"\n[[state.piece]]\nto = \"A\"\nmatrix = [[1]]\n", automaton("")),
            "duplicate-state",
        ),
        (with_head(&format!("{TWO}[expect]\nverdict = \"yes\"")), "value"),
        (with_head(&format!("{TWO}[expect]\nverdikt = \"proved\"")), "unknown-key"),
    ];
    for (text, code) in cases {
        let problem = refused(&text);
        assert_eq!(problem.id(), format!("secant::case::{code}"), "{text}\n{}", problem.render(false));
        assert!(problem.remedy().is_some() || code == "shape", "{text}");
        assert!(problem.render(false).lines().count() < 40, "{text}");
    }
}

#[test]
fn the_other_convention_is_suggested() {
    let problem = refused("name = \"t\"\nconvention = \"columns\"\npieces = [[[1, 0], [\"1/2\", \"1/2\"]]]\n");
    let help = problem.remedy().unwrap();
    assert!(problem.message().contains("column 0") && problem.message().contains("3/2"), "{problem:?}");
    assert!(help.contains("\"columns\"") && help.contains("\"rows\""), "{help}");
}

#[test]
fn huge_exponents_meet_the_limit() {
    let row = format!("[{}]", vec!["\"1e9999\""; 64].join(","));
    let piece = format!("[{}]", vec![row; 64].join(","));
    let text = with_head(&format!("pieces = [{piece}]"));
    assert_eq!(refused(&text).id(), "secant::case::limit");
}

#[test]
fn too_large_and_not_text() {
    let large = " ".repeat(MAX_BYTES + 1);
    assert_eq!(refused(&large).id(), "secant::case::too-large");
    let bad = Case::from_reader("x", &b"name = \"\xff\""[..]).unwrap_err();
    assert_eq!(bad.id(), "secant::case::encoding");
    let missing = Case::read(Path::new("no/such/file.toml")).unwrap_err();
    assert_eq!(missing.id(), "secant::case::unreadable");
    assert_eq!(Case::read(Path::new(".")).unwrap_err().id(), "secant::case::unreadable");
}

#[test]
fn the_expected_error_is_found_in_a_bad_case() {
    let text = with_head("pieces = [[[2]]]\n[expect]\nerror = \"secant::case::sum\"\n");
    assert_eq!(super::super::expected_error(&text).as_deref(), Some("secant::case::sum"));
    assert_eq!(refused(&text).id(), "secant::case::sum");
}

proptest! {
    #[test]
    fn arbitrary_text_never_panics(text in ".{0,400}") {
        let _ = Case::parse("t", &text).map_err(|p| p.render(false));
    }

    #[test]
    fn scraps_of_cases_never_panic(parts in proptest::collection::vec(proptest::sample::select(vec![
        "name = \"t\"\n", "convention = \"columns\"\n", "convention = \"rows\"\n", TWO, "pieces = [", "[[", "]]", "]",
        "[[state]]\n", "[[state.piece]]\n", "to = \"A\"\n", "name = \"A\"\n", "start = \"A\"\n", "matrix = [[1]]\n",
        "left = {", "vertex = \"A\", ", "}\n", "[[map]]\n", "linear = [[1, 0], [0, 1]]\n", "shift = [0, 0]\n", "reversed = true\n",
        "reversed = [0]\n", "kind = \"set\"\n", "kind = \"vertex\"\n", "dimension = 2\n", "control = [[0], [1]]\n",
        "[[examine]]\n", "address = \"0(1)\"\n", "[expect]\n", "[[expect.point]]\n", "tangent = [1]\n", "1/0", "\"1/0\"", ",",
        "\u{1b}", "é", "1e999", "nan", "\n",
    ]), 0..14)) {
        let text = parts.concat();
        let _ = Case::parse("t", &text).map_err(|p| p.render(false));
    }
}
