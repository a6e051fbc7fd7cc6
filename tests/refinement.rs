//! Curves on more control points, and chains of curves on shared ones.

use proptest::prelude::*;
use secant::arith::{Rational, ratio};
use secant::case::Case;
use secant::certificate::confirm;
use secant::junction::refine;
use secant::linalg::Matrix;
use secant::prelude::{Findings, Question, prove};
use secant::shape::{Complex, Shape};
use secant::theorem::{Kind, PointReport, Role, Verdict, certify};
use std::path::Path;

fn read(name: &str) -> Case {
    Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)).unwrap()
}

fn scheme(name: &str) -> Complex {
    let Question::Tangents { case, .. } = Question::ask(name).unwrap() else { unreachable!("a curve") };
    case.complex()
}

/// The operators of the cells of the first level, in the order of the parameter.
fn cells(shape: &Shape) -> Vec<Matrix> {
    let outer = shape.states[shape.start].pieces.iter();
    outer.flat_map(|a| shape.states[a.target].pieces.iter().map(move |b| &a.op * &b.op)).collect()
}

fn embedded(before: &Complex) -> Complex {
    let refined = refine(before).unwrap();
    let start = &refined.complex.shape.states[refined.complex.shape.start];
    let wanted = cells(&before.shape);
    assert_eq!(start.pieces.len(), wanted.len());
    for (piece, cell) in start.pieces.iter().zip(&wanted) {
        assert_eq!(&(&refined.embedding * &piece.op), cell, "E T' = T E");
        // Selections of points.
        let unit = |j: usize| piece.op.column(j).iter().filter(|x| **x == 1).count() == 1;
        assert!((0..piece.op.cols()).all(unit));
    }
    refined.complex.shape.check().unwrap();
    refined.complex.shape.check_curves().unwrap();
    refined.complex
}

#[test]
fn the_embedding_is_exact() {
    for name in ["bspline degree=2", "bspline degree=3", "four-point", "bspline degree=2 arity=3", "bezier degree=3"] {
        let once = embedded(&scheme(name));
        embedded(&once);
    }
    let joined = read("junction/quadratic-cubic.toml").complex();
    let once = embedded(&joined);
    // The points of the junction of B.5: 11 of them, of which those of the old curve make up 7 dimensions.
    assert_eq!((joined.shape.states[0].dim, once.shape.states[once.shape.start].dim), (7, 11));
    assert_eq!(refine(&joined).unwrap().embedding.rank(), 7);
    embedded(&once);
}

#[test]
fn the_parameter_is_kept() {
    let text = "name = \"parabola\"\nconvention = \"columns\"\nshares = [\"1/3\", \"2/3\"]\ncontrol = [[0, 0], [1, 2], [3, 0]]\n\
                pieces = [[[1, \"2/3\", \"4/9\"], [0, \"1/3\", \"4/9\"], [0, 0, \"1/9\"]],\n\
                [[\"4/9\", 0, 0], [\"4/9\", \"2/3\", 0], [\"1/9\", \"1/3\", 1]]]\n";
    let once = embedded(&Case::parse("parabola.toml", text).unwrap().complex());
    let start = &once.shape.states[once.shape.start];
    let shares: Vec<Rational> = (0..4).map(|i| start.share(i)).collect();
    assert_eq!(shares, [ratio(1, 9), ratio(2, 9), ratio(2, 9), ratio(4, 9)]);
}

#[test]
fn verdicts_are_kept() {
    for name in ["junction/quadratic-cubic.toml", "control/two-spans.toml"] {
        let case = read(name);
        let before = certify(&case.shape, &[]).unwrap();
        let complex = embedded(&case.complex());
        let after = certify(&complex.shape, &[]).unwrap();
        let ends = |found: &secant::theorem::Certified| {
            let end = |p: &&PointReport| matches!(p.role, Role::LeftEnd | Role::RightEnd);
            found.points.iter().filter(end).map(|p| (p.verdict, p.kind)).collect::<Vec<_>>()
        };
        assert_eq!(ends(&before), ends(&after), "{name}");
        let joint = |p: &&PointReport| matches!(p.role, Role::Joint { .. });
        assert!(after.points.iter().filter(joint).all(|p| p.kind == Kind::Regular), "{name}");
        let every = |found: &secant::theorem::Certified| found.everywhere.as_ref().map(|e| e.verdict);
        assert_eq!(every(&before), every(&after), "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Control points are carried over, and one that is moved leaves all cells alone that do not use it.
    #[test]
    fn a_point_moves_its_own_cells_only(numbers in proptest::collection::vec(-9_i64..10, 14), moved in 0_usize..11) {
        let mut complex = read("junction/quadratic-cubic.toml").complex();
        complex.shape.control = Some(Matrix::from_fn(2, 7, |i, j| ratio(numbers[2 * j + i], 1)));
        let refined = refine(&complex).unwrap();
        let control = refined.complex.shape.control.clone().unwrap();
        prop_assert_eq!(&control, &(&complex.shape.view() * &refined.embedding));
        let mut other = control.clone();
        other[(0, moved)] += Rational::from(1);
        for piece in &refined.complex.shape.states[refined.complex.shape.start].pieces {
            let uses = (0..piece.op.cols()).any(|j| piece.op[(moved, j)] != 0);
            prop_assert_eq!((&control * &piece.op) != (&other * &piece.op), uses);
        }
    }
}

const CHAIN: &str = "name = \"chain\"\nsource = \"test\"\nconvention = \"columns\"\nstart = \"W\"\n\
    control = [[0, 0], [1, 2], [3, 3], [4, 1], [6, 2]]\n\
    [[state]]\nname = \"W\"\nchain = [\"C\", \"C\"]\n\
    [[state]]\nname = \"C\"\nscheme = \"bspline\"\ndegree = 3\n";

#[test]
fn a_state_names_a_scheme_and_a_start_is_a_chain_of_them() {
    let case = Case::parse("chain.toml", CHAIN).unwrap();
    assert_eq!((case.shape.states[0].dim, case.shape.states[1].dim), (5, 4));
    // Two spans of a cubic spline on five points: every joint, and every point by the polynomial arcs.
    let found = certify(&case.shape, &[]).unwrap();
    assert_eq!(found.verdict, Verdict::Proved);
    assert_eq!(found.everywhere.as_ref().unwrap().verdict, Verdict::Proved);
    assert!(case.beside().is_some(), "the checker reads the operators");
    confirm(&case, &found).unwrap();
    // The same shape as the one that is written out.
    let written = Case::parse("written.toml", &case.expanded()).unwrap();
    assert_eq!(written.shape.states[0].pieces[1].op, case.shape.states[0].pieces[1].op);
}

#[test]
fn chains_that_do_not_fit_are_refused() {
    let refused = |from: &str, to: &str, code: &str| {
        let text = CHAIN.replace(from, to);
        assert_ne!(text, CHAIN);
        let problem = Case::parse("chain.toml", &text).unwrap_err();
        assert_eq!(problem.id(), code, "{}", problem.message());
        assert!(problem.position().is_some() && problem.remedy().is_some());
    };
    refused("[\"C\", \"C\"]", "[]", "secant::case::no-piece");
    refused("[\"C\", \"C\"]", "[\"C\", \"D\"]", "secant::case::unknown-state");
    refused("[\"C\", \"C\"]", "[\"C\", \"W\"]", "secant::case::target-kind");
    refused("scheme = \"bspline\"", "scheme = \"b-spline\"", "secant::case::scheme");
    refused("degree = 3", "degrees = 3", "secant::case::scheme-parameter");
    refused("degree = 3", "degree = 3\ndimension = 4", "secant::case::two-forms");
    refused("scheme = \"bspline\"\ndegree = 3", "scheme = \"sierpinski\"", "secant::case::scheme");
    refused("chain = [\"C\", \"C\"]", "kind = \"set\"\nchain = [\"C\", \"C\"]", "secant::case::two-forms");
    let two = "[[state]]\nname = \"Q\"\nscheme = \"bspline\"\ndegree = 2\n[[state]]\nname = \"C\"";
    let text = CHAIN.replace("[[state]]\nname = \"C\"", two).replace("[\"C\", \"C\"]", "[\"Q\", \"C\"]");
    assert_eq!(Case::parse("chain.toml", &text).unwrap_err().id(), "secant::case::size");
}

#[test]
fn a_chain_with_an_intermediate_curve_is_the_joined_curve() {
    let joined = read("junction/quadratic-cubic.toml");
    let chained = read("junction/quadratic-cubic-chain.toml");
    let verdict = |case: Case| {
        let question = Question::Tangents { case: std::sync::Arc::new(case), further: Vec::new() };
        let Findings::Tangents { found, .. } = prove(&question, &secant::budget::Budget::default()).unwrap() else {
            unreachable!("a curve")
        };
        (found.verdict, found.everywhere.unwrap().verdict)
    };
    let operators =
        |case: &Case| case.shape.states[case.shape.start].pieces.iter().map(|p| p.op.clone()).collect::<Vec<_>>();
    assert_eq!(operators(&joined), operators(&chained));
    assert_eq!(verdict(joined), (Verdict::Proved, Verdict::Proved));
    assert_eq!(verdict(chained), (Verdict::Proved, Verdict::Proved));
}
