//! Junctions of two curves: one array of stencils, its canonical members, and what is proved of the joined shapes.

use proptest::prelude::*;
use secant::algebraic::Root;
use secant::arith::{Rational, parse_rational, ratio};
use secant::case::Question;
use secant::certificate::confirm;
use secant::junction::{Junction, JunctionError, Member, Pattern, PointOrder, Side, Wish, search};
use secant::linalg::Matrix;
use secant::prelude::{Findings, prove};
use secant::scheme;
use secant::shape::{CellKind, Shape};
use secant::theorem::{Certified, Kind, PointReport, Role, Verdict};
use std::collections::BTreeMap;

fn named(name: &str, parameters: &[(&str, &str)]) -> Side {
    let values: BTreeMap<String, Rational> =
        parameters.iter().map(|(k, v)| ((*k).to_owned(), parse_rational(v).unwrap())).collect();
    Side::of(name, &scheme::build(name, &values).unwrap()).unwrap()
}

fn spline(degree: &str) -> Side {
    named("bspline", &[("degree", degree)])
}

fn ternary(degree: &str) -> Side {
    named("bspline", &[("degree", degree), ("arity", "3")])
}

fn row(text: &str) -> Vec<Rational> {
    text.split(',').map(|x| parse_rational(x.trim()).unwrap()).collect()
}

/// A curve from the rows of its pieces.
fn curve(pieces: &[&[&str]]) -> Side {
    let op = |rows: &&[&str]| {
        let rows: Vec<Vec<Rational>> = rows.iter().map(|r| row(r)).collect();
        Matrix::from_rows(rows[0].len(), rows).transpose()
    };
    Side::of("own", &Shape::single(CellKind::Edge, pieces.iter().map(op).collect())).unwrap()
}

fn member(a: &Side, b: &Side, pattern: &str, rows: &[&str]) -> Member {
    let rows = rows.iter().map(|r| row(r)).collect();
    let wish = Wish { pattern: Some(Pattern::parse(pattern).unwrap()), rows, ..Wish::default() };
    search(a, b, &wish).unwrap().member.expect("it contracts")
}

fn canonical(a: &Side, b: &Side, pattern: &str) -> Member {
    let wish = Wish { pattern: Some(Pattern::parse(pattern).unwrap()), ..Wish::default() };
    search(a, b, &wish).unwrap().member.expect("it passes")
}

/// Certifies the joined shape; a decided verdict is proved again by the checker.
fn certified(member: &Member) -> Certified {
    let complex = member.junction.complex(&member.array);
    complex.check().unwrap();
    let question = Question::of_complex("joined", &complex).unwrap();
    let Findings::Tangents { case, found } = prove(&question, &secant::budget::Budget::default()).unwrap() else {
        unreachable!("a curve")
    };
    if found.verdict != Verdict::Undetermined {
        confirm(&case, &found).unwrap();
    }
    *found
}

fn every(found: &Certified) -> Verdict {
    found.everywhere.as_ref().map_or(Verdict::Undetermined, |e| e.verdict)
}

fn joint<'a>(found: &'a Certified, path: &[usize], left: usize) -> &'a PointReport {
    let here = |p: &&PointReport| matches!(&p.role, Role::Joint { path: q, left: l, .. } if q == path && *l == left);
    found.points.iter().find(here).unwrap()
}

/// The moduli of the operator of `I -> I`, rounded.
fn moduli(member: &Member) -> Vec<f64> {
    let size = |r: &Root| {
        let (re, im) = r.to_f64();
        re.hypot(im)
    };
    member.check.eigenvalues.iter().flatten().map(|r| (size(r) * 1000.0).round() / 1000.0).collect()
}

#[test]
fn the_family_has_the_right_size() {
    let (two, three, four) = (spline("2"), spline("3"), named("four-point", &[]));
    assert_eq!((two.points(), two.shared, four.points(), four.shared), (3, 2, 6, 5));
    assert_eq!((two.order, four.order), (PointOrder::Given, PointOrder::Given));
    let free = |a: &Side, b: &Side, pattern: &str, points: usize| {
        Junction::new(a.clone(), b.clone(), Pattern::parse(pattern).unwrap(), points).unwrap().free()
    };
    assert_eq!(free(&two, &four, "a,I,b", 7) * 6, 12);
    assert_eq!(free(&two, &three, "I,b", 5) * 4, 4);
    assert_eq!(free(&two, &three, "I,b", 4), 0);
    let family = Junction::new(two.clone(), four.clone(), Pattern::parse("a,I,b").unwrap(), 7).unwrap();
    let sizes: usize = family.windows().iter().map(|(_, len)| len * family.points).sum();
    assert_eq!(sizes, 112);
    let short = Junction::new(two, three, Pattern::parse("I,b").unwrap(), 2);
    assert_eq!(short.unwrap_err(), JunctionError::Points { points: 2, least: 3 });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever the free rows are, all identities hold; a forced row that is changed breaks one.
    #[test]
    fn every_array_satisfies_the_identities(
        pick in 0_usize..4, left in 0_usize..3, right in 0_usize..3,
        entries in proptest::collection::vec(-3_i64..4, 400), broken in 0_usize..100
    ) {
        prop_assume!(left + right > 0);
        let sides = [spline("2"), spline("3"), named("four-point", &[]), named("takagi", &[])];
        let (a, b) = (sides[pick].clone(), sides[(pick + 1) % 4].clone());
        let points = a.shared + b.shared;
        let family = Junction::new(a, b, Pattern { left, right }, points).unwrap();
        let mut numbers = entries.iter().map(|x| ratio(*x, 4)).cycle();
        let free: Vec<Vec<Rational>> = (0..family.free()).map(|_| {
            let mut r: Vec<Rational> = numbers.by_ref().take(points).collect();
            let sum = r.iter().fold(ratio(0, 1), |s, x| s + x);
            r[0] += ratio(1, 1) - sum;
            r
        }).collect();
        let array = family.array(&free).unwrap();
        let complex = family.complex(&array);
        prop_assert!(complex.shape.check().is_ok());
        prop_assert!(complex.check().is_ok());
        let forced: Vec<usize> = {
            let rows = family.forced().unwrap();
            (0..rows.len()).filter(|r| rows[*r].is_some()).collect()
        };
        let at = forced[broken % forced.len()];
        let changed = Matrix::from_fn(array.rows(), array.cols(), |i, j| {
            let extra = match j { 0 => 1, 1 => -1, _ => 0 };
            if i == at { &array[(i, j)] + ratio(extra, 1) } else { array[(i, j)].clone() }
        });
        prop_assert!(family.complex(&changed).check().is_err());
    }
}

#[test]
fn quadratic_to_cubic() {
    let (a, b) = (spline("2"), spline("3"));
    let one_sided = member(&a, &b, "a,I", &["0,1/4,3/16,1/2,1/16"]);
    assert_eq!(moduli(&one_sided), [1.0, 0.5, 0.25]);
    let placed = one_sided.placed.as_ref().unwrap();
    assert_eq!((placed.positions(), placed.degree()), (row("-1/2,1/2,0,1,2").as_slice(), 2));
    assert_eq!(every(&certified(&one_sided)), Verdict::Proved);
    let sparse = member(&a, &b, "a,I,b", &["0,7/10,1/5,1/10,0", "0,3/10,11/20,3/20,0"]);
    assert_eq!(moduli(&sparse), [1.0, 0.5, 0.25, 0.125]);
    assert_eq!(every(&certified(&sparse)), Verdict::Proved);
    let best = canonical(&a, &b, "a,I,b");
    let rows = [
        "105635/1900696,842255/1900696,849363/1900696,102480/1900696,963/1900696",
        "87/17368,4383/17368,10754/17368,1966/17368,178/17368",
    ];
    assert_eq!(best.free, rows.map(row));
    assert_eq!(moduli(&best), [1.0, 0.5, 0.25, 0.129, 0.058]);
    assert_eq!(best.placed.as_ref().unwrap().positions(), row("-1/2,1/2,1,2,3"));
    assert_eq!(every(&certified(&best)), Verdict::Proved);
    // It is the member that is found without a pattern.
    assert_eq!(search(&a, &b, &Wish::default()).unwrap().member.unwrap().free, best.free);
}

#[test]
fn chaikin_to_the_four_point_scheme() {
    let (a, b) = (spline("2"), named("four-point", &[]));
    let rows = ["0,1/2,1/2,0,0,0,0", "-1/16,7/16,1/2,1/8,0,0,0", "0,-1/4,13/16,1/2,-1/16,0,0"];
    let sparse = member(&a, &b, "a,I,b,b", &rows);
    assert_eq!(moduli(&sparse), [1.0, 0.5, 0.25, 0.088, 0.088, 0.063, 0.0]);
    assert!(!sparse.check.injective || sparse.check.eigenvalues.iter().flatten().any(Root::is_zero));
    assert_eq!(sparse.placed.as_ref().unwrap().degree(), 2);
    assert_eq!(every(&certified(&sparse)), Verdict::Proved);
    assert_eq!(every(&certified(&canonical(&a, &b, "a,I,b,b"))), Verdict::Proved);
}

#[test]
fn cubic_to_de_rham() {
    let b = named("corner-cutting", &[("a", "1/5"), ("b", "3/10")]);
    let rows = ["1/10,1/10,3/5,1/5,0", "0,0,2/3,1/3,0", "0,0,1/6,5/6,0"];
    let found = member(&spline("3"), &b, "a,a,I,b", &rows);
    assert_eq!(moduli(&found), [1.0, 0.5, 0.279, 0.2, 0.179]);
    assert_eq!(every(&certified(&found)), Verdict::Proved);
}

#[test]
fn binary_to_ternary() {
    let rows = ["0,17/20,3/20,0", "0,9/20,11/20,0", "0,3/20,3/4,1/10"];
    let found = member(&spline("2"), &ternary("2"), "a,I,b,b", &rows);
    assert_eq!(moduli(&found), [1.0, 0.4, 0.25, 0.1]);
    assert_eq!(every(&certified(&found)), Verdict::Proved);
}

#[test]
fn cubic_to_takagi() {
    let takagi = curve(&[&["1,0,0", "3/8,3/4,-1/8", "1/4,1/2,1/4"], &["1/4,1/2,1/4", "-1/8,3/4,3/8", "0,0,1"]]);
    assert_eq!((takagi.shared, takagi.order), (1, PointOrder::Given));
    let rows = ["1/8,0,3/4,1/8", "0,0,3/4,1/4", "0,0,1/4,3/4", "0,1/4,-1/4,1"];
    let found = member(&spline("3"), &takagi, "a,a,I,b", &rows);
    assert_eq!(moduli(&found), [1.0, 0.5, 0.25, 0.25]);
    let proved = certified(&found);
    assert_eq!(joint(&proved, &[], 0).kind, Kind::Regular);
    assert_eq!(joint(&proved, &[], 1).kind, Kind::Corner);
    assert_eq!(joint(&proved, &[1], 0).kind, Kind::Regular);
    assert_eq!(joint(&proved, &[1], 1).kind, Kind::Regular);
    assert_eq!(joint(&proved, &[2], 0).kind, Kind::Cusp);
    assert_eq!(every(&proved), Verdict::Refuted);
}

#[test]
fn quadratic_to_a_koch_like_curve() {
    let koch = curve(&[
        &["1,0,0", "2/3,1/3,0", "2/3,0,1/3"],
        &["2/3,0,1/3", "5/16,2/3,1/48", "0,1,0"],
        &["0,1,0", "1/48,2/3,5/16", "1/3,0,2/3"],
        &["1/3,0,2/3", "0,1/3,2/3", "0,0,1"],
    ]);
    let found = member(&spline("2"), &koch, "a,I,b", &["0,3/4,1/4", "0,1/4,3/4", "1/8,-1/8,1"]);
    assert_eq!(moduli(&found), [1.0, 0.5, 0.25]);
    let complex = found.junction.complex(&found.array);
    let question = Question::of_complex("koch", &complex).unwrap().with_address("1(1)").unwrap();
    let Findings::Tangents { found, .. } = prove(&question, &secant::budget::Budget::default()).unwrap() else {
        unreachable!("a curve")
    };
    let centre = found.points.iter().find(|p| p.role == Role::Interior).unwrap();
    assert_eq!((centre.kind, centre.verdict), (Kind::Regular, Verdict::Proved));
    assert_eq!(centre.position, row("0,0,1/2,1/2,0,0"));
    assert_eq!(centre.tangent.as_ref().unwrap().rational().unwrap(), row("0,0,-1,1,0,0").as_slice());
    let right = found.points.iter().find(|p| p.role == Role::RightEnd).unwrap();
    assert_eq!(right.verdict, Verdict::Refuted);
}

#[test]
fn measured_spectra_of_canonical_members() {
    let four = named("four-point", &[]);
    let first = |a: &Side, b: &Side, pattern: &str| moduli(&canonical(a, b, pattern))[1..5].to_vec();
    assert_eq!(first(&spline("2"), &four, "a,I,b,b"), [0.5, 0.25, 0.233, 0.214]);
    assert_eq!(first(&spline("3"), &four, "a,a,I,b,b"), [0.5, 0.25, 0.248, 0.21]);
    assert_eq!(first(&spline("3"), &spline("5"), "a,a,I,b,b")[..3], [0.5, 0.25, 0.211]);
    assert_eq!(first(&four, &four, "a,a,I,b,b,b"), [0.5, 0.25, 0.247, 0.223]);
    assert_eq!(first(&ternary("2"), &ternary("3"), "a,a,I,b,b"), [0.333, 0.111, 0.032, 0.009]);
    // These are also the patterns that are found.
    let pattern =
        |a: &Side, b: &Side| search(a, b, &Wish::default()).unwrap().member.unwrap().junction.pattern.to_string();
    assert_eq!(pattern(&spline("2"), &four), "a,I,b,b");
    assert_eq!(pattern(&four, &four), "a,a,I,b,b,b");
    assert_eq!(pattern(&ternary("2"), &ternary("3")), "a,a,I,b,b");
}

#[test]
fn a_free_eigenvalue_that_is_too_large_makes_a_corner() {
    let (a, b) = (spline("2"), spline("3"));
    for (rows, double) in [(["0,1/2,1/12,1/3,1/12"], true), (["0,3/4,-1/48,1/6,5/48"], false)] {
        let found = member(&a, &b, "a,I", &rows);
        assert!(!found.check.passes);
        let proved = certified(&found);
        assert_eq!(joint(&proved, &[], 1).kind, Kind::Corner, "{rows:?}");
        assert_eq!(moduli(&found)[1], if double { 0.5 } else { 0.75 });
        assert_eq!(every(&proved), Verdict::Refuted);
    }
}

#[test]
fn sliders_keep_what_is_reproduced() {
    let (a, b) = (spline("2"), spline("3"));
    let set = |text: &str, value: Rational| {
        let settings = vec![(text.to_owned(), value)];
        search(&a, &b, &Wish { pattern: Some(Pattern::parse("a,I,b").unwrap()), settings, ..Wish::default() })
    };
    let moved = set("tau1", ratio(1, 10)).unwrap().member.unwrap();
    let still = canonical(&a, &b, "a,I,b");
    assert!(moved.free[0] != still.free[0] && moved.free[1] == still.free[1]);
    let placed = moved.placed.as_ref().unwrap();
    assert!((0..moved.array.rows()).all(|r| placed.agrees(r, moved.array.row(r))));
    assert!(set("tau7", ratio(1, 10)).is_err());
    // Far out the free eigenvalues grow, and no member is claimed to pass.
    let far = set("tau", ratio(50, 1)).unwrap();
    assert!(far.member.is_none() && !far.tried.is_empty());
}

#[test]
fn a_curve_is_joined_to_itself() {
    let a = spline("3");
    let found = search(&a, &a, &Wish::default()).unwrap().member.unwrap();
    assert_eq!(every(&certified(&found)), Verdict::Proved);
}

#[test]
fn any_two_schemes_have_a_junction() {
    let sides = [
        spline("2"),
        spline("3"),
        spline("5"),
        named("four-point", &[]),
        named("dubuc-deslauriers", &[("points", "6")]),
        ternary("2"),
        named("takagi", &[]),
        named("de-rham", &[]),
    ];
    for a in &sides {
        for b in &sides {
            let found = search(a, b, &Wish::default()).unwrap();
            let member = found.member.unwrap_or_else(|| panic!("{} and {}: {:?}", a.name, b.name, found.tried.len()));
            assert!(member.check.passes && member.check.contracts, "{} and {}", a.name, b.name);
            member.junction.complex(&member.array).check().unwrap();
        }
    }
}

/// The intermediate curve on the points of its pieces is the same curve, and the operators of both agree through the stencils.
#[test]
fn the_intermediate_curve_refined_inside() {
    let (two, three) = (spline("2"), spline("3"));
    let before = member(&two, &three, "a,I,b", &["0, 7/10, 1/5, 1/10, 0", "0, 3/10, 11/20, 3/20, 0"]);
    let after = before.refined_inside().unwrap();
    assert_eq!((after.junction.points, after.junction.pattern), (7, Pattern::parse("a,a,I,b,b").unwrap()));
    let embedding = before.array.transpose();
    let (own, larger) = (before.junction.own(&before.array), after.junction.own(&after.array));
    assert_eq!(&embedding * &larger, &own * &embedding);
    assert_eq!(moduli(&after)[..4], moduli(&before)[..4]);
    // The pieces of both kinds, two for each of the old ones.
    let (old, new) = (before.junction.operators(&before.array), after.junction.operators(&after.array));
    for j in 0..2 {
        assert_eq!(&embedding * &new[j], &old[0] * &two.operators[j]);
        assert_eq!(&embedding * &new[3 + j], &old[2] * &three.operators[j]);
    }
    let found = certified(&after);
    assert_eq!((found.verdict, every(&found)), (Verdict::Proved, Verdict::Proved));
    assert_eq!(after.refined_inside().unwrap().junction.points, after.array.rows());
}

/// Shares of the parameter stay those of the schemes; positions then only increase.
#[test]
fn a_scheme_with_shares() {
    let corner = scheme::build("de-rham", &[("a".to_owned(), ratio(1, 3))].into()).unwrap();
    let mut shape = corner;
    let shares = [ratio(1, 3), ratio(2, 3)];
    shape.states[0].pieces.iter_mut().zip(&shares).for_each(|(p, s)| p.share = Some(s.clone()));
    let side = Side::of("own", &shape).unwrap();
    assert_eq!((side.powers().len(), side.iterated(2).unwrap().shares.unwrap()[3].clone()), (1, ratio(4, 9)));
    let found = search(&side, &spline("2"), &Wish::default()).unwrap().member.expect("it passes");
    let complex = found.junction.complex(&found.array);
    complex.check().unwrap();
    complex.shape.check().unwrap();
    assert_eq!((0..2).map(|i| complex.shape.states[2].share(i)).collect::<Vec<_>>(), shares);
    assert!(certified(&found).verdict != Verdict::Refuted);
}
