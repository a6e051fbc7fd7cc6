//! Masks and named schemes against independent formulas and published data.

use secant::arith::{Rational, parse_rational, ratio};
use secant::linalg::Matrix;
use secant::scheme::{self, Interpolation, Laurent, Mask, Normalisation, SchemeError};
use secant::shape::{CellKind, End, Shape};
use std::collections::BTreeMap;

fn number(text: &serde_json::Value) -> Rational {
    parse_rational(text.as_str().unwrap()).unwrap()
}

fn numbers(list: &serde_json::Value) -> Vec<Rational> {
    list.as_array().unwrap().iter().map(number).collect()
}

fn matrix(rows: &serde_json::Value) -> Matrix {
    let rows: Vec<Vec<Rational>> = rows.as_array().unwrap().iter().map(numbers).collect();
    Matrix::from_rows(rows[0].len(), rows)
}

fn build(name: &str, parameters: &[(&str, Rational)]) -> Result<Shape, SchemeError> {
    let parameters: BTreeMap<String, Rational> = parameters.iter().map(|(k, v)| ((*k).to_owned(), v.clone())).collect();
    scheme::build(name, &parameters)
}

fn oracle() -> Vec<serde_json::Value> {
    serde_json::from_str(include_str!("oracle/masks.json")).unwrap()
}

#[test]
fn masks_agree_with_published_operators() {
    let (mut operators, mut factors) = (0, 0);
    for entry in oracle() {
        let id = entry["id"].as_str().unwrap();
        let arity = entry["arity"].as_u64().unwrap() as usize;
        let mask = Mask::new(arity, numbers(&entry["mask"])).unwrap();
        let shape = mask.curve().unwrap_or_else(|e| panic!("{id}: {e}"));
        assert!(mask.curve_with_vertices().is_ok(), "{id}");
        if let Some(expected) = entry["ifs_T"].as_array() {
            let pieces = &shape.states[0].pieces;
            assert_eq!(pieces.len(), expected.len(), "{id}");
            for (piece, t) in pieces.iter().zip(expected) {
                // Published in the order of the mask; control points run with the parameter.
                let (t, last) = (matrix(t), piece.op.rows() - 1);
                let turned = Matrix::from_fn(t.rows(), t.cols(), |i, j| t[(last - i, last - j)].clone());
                assert_eq!(piece.op, turned, "{id}");
            }
            operators += 1;
        }
        if let Some(power) = entry["factor_power_K"].as_u64() {
            let (count, rest) = mask.smoothing_factor();
            assert_eq!(count as u64, power, "{id}");
            let expected = Laurent::new(0, numbers(&entry["b_mask"]));
            assert_eq!(rest, expected.coefficients(), "{id}");
            factors += 1;
        }
    }
    assert_eq!((operators, factors), (10, 17));
}

#[test]
fn formulas_give_the_published_masks() {
    let wanted: BTreeMap<String, Vec<Rational>> = oracle()
        .iter()
        .map(|e| (e["id"].as_str().unwrap().to_owned(), Laurent::new(0, numbers(&e["mask"])).coefficients().to_vec()))
        .collect();
    let pairs = [
        ("bspline2", scheme::bspline(2, 2)),
        ("bspline6", scheme::bspline(6, 2)),
        ("ternB1", scheme::bspline(1, 3)),
        ("ternB3", scheme::bspline(3, 3)),
        ("DD2", scheme::dubuc_deslauriers(2)),
        ("DD4", scheme::dubuc_deslauriers(4)),
        ("DD6", scheme::dubuc_deslauriers(6)),
        ("HS3", scheme::hormann_sabin(3)),
        ("HS4", scheme::hormann_sabin(4)),
        ("HS5", scheme::hormann_sabin(5)),
        ("ter4-1_15", scheme::ternary_four_point(&ratio(1, 15))),
        ("ter4-1_8", scheme::ternary_four_point(&ratio(1, 8))),
        ("ter3-5_18", scheme::ternary_three_point(&ratio(5, 18))),
        ("ter3-4_15", scheme::ternary_three_point(&ratio(4, 15))),
        ("ter3-1_3", scheme::ternary_three_point(&ratio(1, 3))),
        ("4pt-w3_20", scheme::four_point(&ratio(3, 20))),
        ("4pt-w-1_10", scheme::four_point(&ratio(-1, 10))),
    ];
    for (id, mask) in pairs {
        assert_eq!(mask.unwrap().coefficients(), wanted[id], "{id}");
    }
}

/// The cardinal B-spline of a degree on `[0, degree + 1]`, by Cox and de Boor's recursion.
fn cardinal(degree: usize, x: &Rational) -> Rational {
    if degree == 0 {
        return Rational::from(u8::from(*x >= 0 && *x < 1));
    }
    let d = ratio(degree as i64, 1);
    let shifted = x - ratio(1, 1);
    (x / &d) * cardinal(degree - 1, x) + (ratio(degree as i64 + 1, 1) - x) / d * cardinal(degree - 1, &shifted)
}

/// All words of a length.
fn words(arity: usize, length: usize) -> Vec<Vec<usize>> {
    (0..length).fold(vec![Vec::new()], |all, _| {
        all.iter().flat_map(|w| (0..arity).map(move |e| [w.as_slice(), &[e]].concat())).collect()
    })
}

fn parameter(arity: usize, word: &[usize]) -> Rational {
    let m = ratio(arity as i64, 1);
    word.iter().rev().fold(ratio(0, 1), |x, e| (x + ratio(*e as i64, 1)) / &m)
}

#[test]
fn spline_operators_evaluate_the_spline() {
    for (degree, arity, depth) in
        [(1, 2, 5), (2, 2, 5), (3, 2, 4), (4, 2, 3), (5, 2, 3), (2, 3, 3), (3, 3, 2), (3, 5, 2)]
    {
        let shape = build("bspline", &[("degree", ratio(degree, 1)), ("arity", ratio(arity, 1))]).unwrap();
        let (degree, arity) = (degree as usize, arity as usize);
        assert_eq!(shape.states[0].dim, degree + 1);
        let start = shape.end_point(0, End::Start).unwrap();
        for word in words(arity, depth) {
            let point = shape.product(0, &word).0.apply(&start);
            let t = parameter(arity, &word);
            // The first control point is that of the spline that ends first.
            let at = |i: usize| cardinal(degree, &(&t + ratio((degree - i) as i64, 1)));
            let expected: Vec<Rational> = (0..=degree).map(at).collect();
            assert_eq!(point, expected, "degree {degree}, arity {arity}, t = {t}");
        }
    }
}

#[test]
fn de_casteljau_evaluates_bernstein_polynomials() {
    let binomial = |n: i64, k: i64| (0..k).fold(ratio(1, 1), |b, i| b * ratio(n - i, i + 1));
    let power = |x: &Rational, k: i64| (0..k).fold(ratio(1, 1), |p, _| p * x);
    for degree in 1..=6 {
        let shape = build("bezier", &[("degree", ratio(degree, 1))]).unwrap();
        let start = shape.end_point(0, End::Start).unwrap();
        for word in words(2, 4) {
            let t = parameter(2, &word);
            let point = shape.product(0, &word).0.apply(&start);
            let bernstein = |i| binomial(degree, i) * power(&t, i) * power(&(ratio(1, 1) - &t), degree - i);
            assert_eq!(point, (0..=degree).map(bernstein).collect::<Vec<_>>(), "degree {degree}, t = {t}");
        }
    }
    let thirds = build("bezier", &[("degree", ratio(2, 1)), ("split", ratio(1, 3))]).unwrap();
    let joint = thirds.states[0].pieces[0].op.column(2);
    assert_eq!(joint, vec![ratio(4, 9), ratio(4, 9), ratio(1, 9)]);
}

#[test]
fn interpolatory_masks_reproduce_polynomials() {
    // With data j^k at the integers the first refinement must give (1/2)^k at 1/2.
    for points in [2, 4, 6, 8, 12] {
        let mask = scheme::dubuc_deslauriers(points).unwrap();
        let half = points as i64 / 2;
        for k in 0..points {
            let power = |x: Rational| (0..k).fold(ratio(1, 1), |p, _| p * &x);
            let value = (0..points)
                .fold(ratio(0, 1), |s, i| s + &mask.coefficients()[2 * i] * power(ratio(i as i64 + 1 - half, 1)));
            assert_eq!(value, power(ratio(1, 2)), "{points} points, degree {k}");
        }
    }
}

#[test]
fn every_named_scheme_is_a_model() {
    let given: BTreeMap<&str, Vec<(&str, Rational)>> =
        [("corner-cutting", vec![("a", ratio(-1, 4)), ("b", ratio(1, 2))])].into();
    let names: Vec<&str> = scheme::list().iter().map(|s| s.name).collect();
    assert!(names.is_sorted());
    for info in scheme::list() {
        let shape = build(info.name, given.get(info.name).map_or(&[], Vec::as_slice));
        let shape = shape.unwrap_or_else(|e| panic!("{}: {e}", info.name));
        shape.check().unwrap();
        shape.check_curves().unwrap();
        assert!(!info.source.is_empty() && !info.summary.is_empty());
    }
    let thesis = build("corner-cutting", &given["corner-cutting"]).unwrap();
    assert_eq!(thesis.end_point(0, End::Start).unwrap(), [ratio(2, 1), ratio(-1, 1), ratio(0, 1)]);
    assert_eq!(thesis.end_point(0, End::Finish).unwrap(), [ratio(0, 1), ratio(2, 1), ratio(-1, 1)]);
}

#[test]
fn classical_curves_run_from_0_to_1() {
    for name in ["koch", "levy", "dragon", "terdragon", "arrowhead", "hilbert", "minkowski-sausage", "takagi"] {
        let shape = build(name, &[]).unwrap();
        let control = shape.control.clone().unwrap();
        let ends = [End::Start, End::Finish].map(|end| control.apply(&shape.end_point(0, end).unwrap()));
        assert_eq!(ends, [[ratio(0, 1), ratio(0, 1)], [ratio(1, 1), ratio(0, 1)]], "{name}");
        assert_eq!(shape.states[0].kind, CellKind::Edge);
    }
    // Two pieces give the same curve as four.
    let (two, four) = (build("koch", &[("pieces", ratio(2, 1))]).unwrap(), build("koch", &[]).unwrap());
    let start = four.end_point(0, End::Start).unwrap();
    for word in words(4, 3) {
        let pairs: Vec<usize> = word.iter().flat_map(|e| [e / 2, e % 2]).collect();
        assert_eq!(two.product(0, &pairs).0.apply(&start), four.product(0, &word).0.apply(&start), "{word:?}");
    }
}

#[test]
fn interpolation_passes_through_its_points() {
    let points: Vec<Vec<Rational>> = [[0, 0], [1, 2], [3, 1], [4, 4]].map(|p| p.map(|x| ratio(x, 1)).to_vec()).to_vec();
    let number = |p, q| Matrix::from_rows(1, vec![vec![ratio(p, q)]]);
    let factors = vec![number(1, 3), number(-1, 2), number(1, 5)];
    let data = Interpolation::affine(&points, factors.clone()).unwrap();
    assert_eq!(data.shares(), [ratio(1, 4), ratio(1, 2), ratio(1, 4)]);
    let shape = data.shape().unwrap();
    let control = shape.control.clone().unwrap();
    let start = shape.end_point(0, End::Start).unwrap();
    for (k, point) in points.iter().take(3).enumerate() {
        assert_eq!(control.apply(&shape.states[0].pieces[k].op.apply(&start)), *point);
    }
    assert!(Interpolation::affine(&points, factors[..2].to_vec()).is_err());
    assert!(Interpolation::affine(&points, vec![number(1, 1), number(0, 1), number(0, 1)]).is_err());
    let lines = vec![vec![vec![ratio(0, 1), ratio(1, 1)]]; 3];
    assert!(Interpolation::new(&points, factors, lines).is_err());
}

#[test]
fn symbols_and_filters_are_normalised_as_said() {
    let cubic = Mask::from_symbol(2, "z^-2 (1+z)^4 / 8").unwrap();
    assert_eq!(cubic, scheme::bspline(3, 2).unwrap());
    let q = [1, 3, 3, 1].map(|x| ratio(x, 8));
    let chaikin = scheme::bspline(2, 2).unwrap();
    assert_eq!(Mask::from_filter(2, &q, Normalisation::One).unwrap(), chaikin);
    assert_eq!(Mask::from_filter(2, &q, Normalisation::Root).unwrap(), chaikin);
    // √4 is rational: Σ h = 2.
    let h: Vec<Rational> = scheme::bspline(1, 4).unwrap().coefficients().iter().map(|a| a / ratio(2, 1)).collect();
    assert_eq!(Mask::from_filter(4, &h, Normalisation::Root).unwrap(), scheme::bspline(1, 4).unwrap());
    let Err(SchemeError::SumRule { sum, hint, .. }) = Mask::new(2, [1, 3, 3, 1].map(|x| ratio(x, 1)).to_vec()) else {
        panic!("sum rule")
    };
    assert_eq!((sum, hint.contains("divided by 4")), (ratio(4, 1), true));
}

#[test]
fn wrong_input_is_named() {
    assert!(matches!(Mask::new(2, vec![ratio(1, 1), ratio(1, 1)]), Err(SchemeError::Short { .. })));
    assert!(matches!(Mask::new(2, vec![]), Err(SchemeError::SumRule { .. })));
    assert!(matches!(Mask::new(1, vec![ratio(1, 1)]), Err(SchemeError::Arity(1))));
    assert!(matches!(
        Mask::new(2, vec![ratio(1, 2), ratio(1, 1), ratio(1, 4)]),
        Err(SchemeError::SumRule { residue: 0, .. })
    ));
    // φ is the sum of two boxes: the pieces do not meet, or the limit depends on the start.
    let boxes = Mask::new(2, [1, 0, 0, 1].map(|x| ratio(x, 1)).to_vec()).unwrap();
    assert!(boxes.curve().is_err());
    let Err(SchemeError::Unknown { near, .. }) = build("b-spline", &[]) else { panic!("unknown") };
    assert_eq!(near.as_deref(), Some("bspline"));
    assert!(matches!(build("bspline", &[("degre", ratio(1, 1))]), Err(SchemeError::Parameter { .. })));
    assert!(matches!(build("corner-cutting", &[("a", ratio(1, 4))]), Err(SchemeError::Missing { .. })));
    assert!(matches!(build("bspline", &[("degree", ratio(1, 2))]), Err(SchemeError::Value { .. })));
    assert!(matches!(build("bspline", &[("degree", ratio(0, 1))]), Err(SchemeError::Short { .. })));
    assert!(matches!(build("dubuc-deslauriers", &[("points", ratio(5, 1))]), Err(SchemeError::Value { .. })));
    assert!(matches!(build("bezier", &[("split", ratio(1, 1))]), Err(SchemeError::Value { .. })));
    assert!(matches!(build("koch", &[("pieces", ratio(3, 1))]), Err(SchemeError::Value { .. })));
}

#[test]
fn fractint_files_are_read_exactly() {
    let text = "\
; a collection
Fern { ; Barnsley
  0 0 0 .16 0 0 .01
  .85 .04 -.04 .85 0 1.6 .85
  .2 -.26 .23 .22 0 1.6 .07
  -.15 .28 .26 .24 0 .44 .07
}
block (3D) { .5 0 0 0 .5 0 0 0 .5 0 0 0
  .5 0 0, 0 .5 0, 0 0 .5, .5 .5 .5 }
";
    let entries = scheme::parse_fractint(text).unwrap();
    assert_eq!(entries.len(), 2);
    let named = build("fern", &[]).unwrap();
    for (a, b) in entries[0].shape.states[0].pieces.iter().zip(&named.states[0].pieces) {
        assert_eq!(a.op, b.op);
    }
    assert_eq!(entries[0].probabilities[0], Some(ratio(1, 100)));
    assert_eq!((entries[1].name.as_str(), entries[1].dimension, entries[1].shape.states[0].dim), ("block", 3, 4));
    for (bad, line) in [
        ("x { 1 2 3 }", 1),
        ("x {\n 1 0 0 1 0 q\n}", 2),
        ("x {\n}", 2),
        ("{ 1 0 0 1 0 0 }", 1),
        ("x {", 1),
        ("", 1),
        ("words", 1),
    ] {
        let Err(SchemeError::Import { line: found, .. }) = scheme::parse_fractint(bad) else { panic!("{bad}") };
        assert_eq!(found, line, "{bad}");
    }
}

#[test]
fn json_states_its_convention() {
    let columns = r#"{ "convention": "columns", "pieces": [[["3/4", "1/4", 0], ["1/4", "3/4", "0.75"], [0, 0, "1/4"]],
                       [["1/4", 0, 0], ["3/4", "3/4", "1/4"], [0, "1/4", "3/4"]]] }"#;
    let shape = scheme::parse_json(columns).unwrap();
    assert_eq!(shape.states[0].pieces[0].op, build("de-rham", &[("a", ratio(1, 4))]).unwrap().states[0].pieces[0].op);
    let rows = r#"{ "convention": "rows", "pieces": [[["3/4", "1/4", 0], ["1/4", "3/4", 0], [0, "3/4", "1/4"]],
                    [["1/4", "3/4", 0], [0, "3/4", "1/4"], [0, "1/4", "3/4"]]] }"#;
    assert_eq!(scheme::parse_json(rows).unwrap().states[0].pieces[0].op, shape.states[0].pieces[0].op);
    let maps = r#"{ "maps": [{ "linear": [["1/2", "-1/2"], ["1/2", "1/2"]], "shift": [0, 0] },
                             { "linear": [["1/2", "1/2"], ["-1/2", "1/2"]], "shift": ["1/2", "1/2"] }] }"#;
    assert_eq!(
        scheme::parse_json(maps).unwrap().states[0].pieces[1].op,
        build("levy", &[]).unwrap().states[0].pieces[1].op
    );
    assert!(matches!(scheme::parse_json(&columns.replace("columns", "rows")), Err(SchemeError::Shape(_))));
    for bad in [
        "",
        "{}",
        "[1]",
        r#"{ "pieces": [[[1]]] }"#,
        r#"{ "convention": "columns", "pieces": [[[0.5, 0.5]]] }"#,
        r#"{ "convention": "columns", "pieces": [[]] }"#,
        r#"{ "convention": "columns", "pieces": [[[1]]], "reversed": [3] }"#,
        r#"{ "convention": "columns", "pieces": [[[1]]], "other": 1 }"#,
        r#"{ "kind": "blob", "maps": [] }"#,
        r#"{ "maps": [{ "linear": [["1/2"]], "shift": [0, 0] }] }"#,
    ] {
        assert!(matches!(scheme::parse_json(bad), Err(SchemeError::Import { .. })), "{bad}");
    }
}

#[test]
fn the_documentation_lists_every_scheme() {
    let text = include_str!("../docs/schemes.md");
    let listed = |name: &str| text.lines().any(|l| l.starts_with(&format!("| `{name}` |")));
    let names = scheme::list().iter().map(|s| s.name).chain(scheme::mesh_rules().iter().map(|r| r.name));
    let missing: Vec<&str> = names.filter(|n| !listed(n)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn shapes_survive_as_case_files() {
    let heading = |name: &str| scheme::Heading {
        name: name.to_owned(),
        title: format!("the scheme \"{name}\""),
        ..scheme::Heading::default()
    };
    let given: BTreeMap<&str, Vec<(&str, Rational)>> =
        [("corner-cutting", vec![("a", ratio(-1, 4)), ("b", ratio(1, 2))])].into();
    let mut shapes: Vec<(&str, Shape)> = scheme::list()
        .iter()
        .map(|s| (s.name, build(s.name, given.get(s.name).map_or(&[], Vec::as_slice)).unwrap()))
        .collect();
    shapes.push(("vertices", scheme::bspline(3, 2).unwrap().curve_with_vertices().unwrap()));
    shapes.push(("disc", scheme::disc(&scheme::mesh_rule("catmull-clark", &[].into()).unwrap(), 3).unwrap()));
    for (name, shape) in shapes {
        let text = scheme::case_text(&shape, &heading(name));
        let case = secant::case::Case::parse(name, &text).unwrap_or_else(|e| panic!("{name}: {e}\n{text}"));
        assert_eq!(case.shape.states.len(), shape.states.len(), "{name}");
        assert_eq!(case.shape.control, shape.control, "{name}");
        for (a, b) in case.shape.states.iter().zip(&shape.states) {
            assert_eq!((a.name == b.name || shape.states.len() == 1, a.dim), (true, b.dim), "{name}");
            assert_eq!(a.left.as_ref().map(|x| &x.op), b.left.as_ref().map(|x| &x.op), "{name}");
            for (p, q) in a.pieces.iter().zip(&b.pieces) {
                assert_eq!((&p.op, p.target, p.reversed), (&q.op, q.target, q.reversed), "{name}");
            }
        }
    }
}
