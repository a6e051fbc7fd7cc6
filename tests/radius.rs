//! Joint spectral radii, regularity and cones against known values.

use secant::arith::{Rational, parse_rational, to_f64};
use secant::budget::Budget;
use secant::certificate::radius_certificate;
use secant::linalg::Matrix;
use secant::radius::{Growth, JointRadius, Options, Polytope, Proof, System, file, joint_radius};
use secant::scheme::Family;
use secant::shape::{CellKind, Shape, Spaces};
use secant::theorem::cone::{CommonCone, Cone, ConeAnswer, ConeMap, common_cone};
use secant::theorem::regularity::{Attained, digits, regularity};
use secant::theorem::wavelet::wavelet;
use secant::theorem::{Verdict, certify};

fn rational(text: &str) -> Rational {
    parse_rational(text).expect(text)
}

fn radius(matrices: &str) -> JointRadius {
    let file = file::parse(&format!("matrices = {matrices}")).expect(matrices);
    joint_radius(&file.system, &Options::default()).expect(matrices)
}

/// Name, matrices, the radius, and the letters of a word that attains it.
const SETS: &[(&str, &str, f64)] = &[
    ("golden", "[[[1,1],[0,1]],[[1,0],[1,1]]]", 1.618033988749895),
    ("HMST-77_100", "[[[1,1],[0,1]],[[\"77/100\",0],[\"77/100\",\"77/100\"]]]", 1.4246703138602095),
    ("HMST-3_5", "[[[1,1],[0,1]],[[\"3/5\",0],[\"3/5\",\"3/5\"]]]", 1.3082766773857093),
    ("HMST-3_10", "[[[1,1],[0,1]],[[\"3/10\",0],[\"3/10\",\"3/10\"]]]", 1.1306363425511248),
    ("nilp", "[[[0,1],[0,0]],[[0,0],[1,0]]]", 1.0),
    ("AAT", "[[[1,2],[0,1]],[[1,0],[2,1]]]", 2.414213562373095),
    ("rot", "[[[\"3/5\",\"-4/5\"],[\"4/5\",\"3/5\"]],[[\"5/13\",\"-12/13\"],[\"12/13\",\"5/13\"]]]", 1.0),
    ("Euler3", "[[[1,0],[1,1]],[[1,1],[0,1]]]", 1.618033988749895),
    (
        "Euler7",
        "[[[1,0,0,0,0,0],[1,1,1,0,0,0],[1,1,1,1,1,0],[1,1,1,1,1,1],[0,0,1,1,1,1],[0,0,0,0,1,1]],[[1,1,0,0,0,0],[1,1,1,1,0,0],[1,1,1,1,1,1],[0,1,1,1,1,1],[0,0,0,1,1,1],[0,0,0,0,0,1]]]",
        3.5115471416945327,
    ),
    (
        "Euler11",
        "[[[1,0,0,0,0,0,0,0,0,0],[1,1,1,0,0,0,0,0,0,0],[1,1,1,1,1,0,0,0,0,0],[1,1,1,1,1,1,1,0,0,0],[1,1,1,1,1,1,1,1,1,0],[1,1,1,1,1,1,1,1,1,1],[0,0,1,1,1,1,1,1,1,1],[0,0,0,0,1,1,1,1,1,1],[0,0,0,0,0,0,1,1,1,1],[0,0,0,0,0,0,0,0,1,1]],[[1,1,0,0,0,0,0,0,0,0],[1,1,1,1,0,0,0,0,0,0],[1,1,1,1,1,1,0,0,0,0],[1,1,1,1,1,1,1,1,0,0],[1,1,1,1,1,1,1,1,1,1],[0,1,1,1,1,1,1,1,1,1],[0,0,0,1,1,1,1,1,1,1],[0,0,0,0,0,1,1,1,1,1],[0,0,0,0,0,0,0,1,1,1],[0,0,0,0,0,0,0,0,0,1]]]",
        5.505892424682024,
    ),
    (
        "pascal",
        "[[[0,1,0,0,0],[1,0,2,0,0],[0,0,0,0,0],[0,1,0,0,1],[0,0,0,2,1]],[[1,0,2,0,0],[0,0,0,2,1],[1,1,0,0,0],[0,0,0,0,0],[0,1,0,0,0]]]",
        2.0,
    ),
    ("cap-pp", "[[[0,1],[1,1]],[[1,1],[1,0]]]", 1.618033988749895),
    ("cap-0p", "[[[0,1],[1,0]],[[1,0],[1,0]],[[0,1],[0,1]],[[1,0],[0,1]]]", 1.0),
    ("cap-pp_pm", "[[[0,0],[1,1]],[[1,0],[1,0]],[[0,1],[0,1]],[[1,1],[0,0]]]", std::f64::consts::SQRT_2),
    (
        "cap-0pm",
        "[[[1,1,0,0],[0,0,0,1],[1,1,0,0],[0,0,0,1]],[[1,0,0,0],[0,0,1,1],[1,1,0,0],[0,0,0,1]],[[1,1,0,0],[0,0,0,1],[1,0,0,0],[0,0,1,1]],[[1,0,0,0],[0,0,1,1],[1,0,0,0],[0,0,1,1]]]",
        1.618033988749895,
    ),
    (
        "cap-p0m",
        "[[[1,0,0,0],[0,0,1,1],[1,1,0,0],[0,0,0,1]],[[1,0,0,0],[0,0,1,0],[1,1,0,0],[0,0,1,1]],[[1,1,0,0],[0,0,1,1],[0,1,0,0],[0,0,0,1]],[[1,1,0,0],[0,0,1,0],[0,1,0,0],[0,0,1,1]]]",
        1.618033988749895,
    ),
    (
        "cap-pmp",
        "[[[1,1,0,0],[0,0,0,1],[1,1,0,0],[0,0,1,1]],[[1,1,0,0],[0,0,1,1],[1,0,0,0],[0,0,1,1]]]",
        1.8392867552141612,
    ),
];

#[test]
fn radii_of_known_sets_are_exact() {
    for (name, matrices, value) in SETS {
        let r = radius(matrices);
        assert!(r.exact, "{name}");
        let lower = r.lower.as_ref().expect(name).enclosure(64);
        assert!((to_f64(&lower.lo) - value).abs() < 1e-12 * value, "{name}: {lower:?}");
        assert_eq!(r.growth, Growth::Bounded, "{name}");
    }
}

#[test]
fn polytopes_prove_their_bounds_again() {
    for (name, matrices, value) in SETS {
        for block in radius(matrices).blocks {
            if let Some(Proof::Polytope(p)) = &block.proof {
                assert_eq!(p.bound(&block.block.system), block.bound, "{name}");
                spoiled(p, &block.block.system, *value);
            }
        }
    }
}

/// A polytope with a shortened list, or a halved coefficient, must not prove a smaller radius.
fn spoiled(polytope: &Polytope, system: &System, value: f64) {
    let mut short = polytope.clone();
    short.inclusions.pop();
    assert_eq!(short.bound(system), None);
    let mut halved = polytope.clone();
    for inclusion in &mut halved.inclusions {
        inclusion.terms.iter_mut().for_each(|t| t.1 /= Rational::from(2));
    }
    assert!(halved.bound(system).is_none_or(|b| to_f64(&b) >= value * (1.0 - 1e-9)));
}

#[test]
fn a_set_without_a_finite_word_stays_an_interval() {
    let alpha = "0.749326546330367557943961948091344672091327370236064317358024";
    let r = radius(&format!("[[[1,1],[0,1]],[[\"{alpha}\",0],[\"{alpha}\",\"{alpha}\"]]]"));
    assert!(!r.exact);
    let (lo, hi) = (to_f64(&r.lower.unwrap().enclosure(64).lo), to_f64(&r.upper.unwrap()));
    assert!(lo < hi && hi < lo * (1.0 + 1e-6));
}

#[test]
fn marginal_and_reducible_sets() {
    assert_eq!(radius("[[[1,1],[0,1]]]").growth, Growth::Unbounded(2));
    let nilpotent = radius("[[[0,1],[0,0]]]");
    assert!(nilpotent.exact && nilpotent.lower.is_none());
    let turned = radius("[[[0,-1],[1,1]],[[\"1/2\",0],[\"1/3\",\"1/5\"]]]");
    assert!(turned.exact && turned.upper == Some(Rational::from(1)));
    let alone = radius("[[[\"3/5\",\"-4/5\"],[\"4/5\",\"3/5\"]],[[\"1/2\",0],[0,\"1/4\"]]]");
    assert!(alone.exact && alone.upper == Some(Rational::from(1)));
}

/// A long Jordan block makes products unbounded only where its word attains the radius.
#[test]
fn a_jordan_block_below_the_radius_says_nothing() {
    // Irreducible, and A^273 B grows faster than the word A with the Jordan block.
    let pair = radius("[[[1,1],[0,1]],[[0,0],[\"1/100\",0]]]");
    assert_eq!(pair.growth, Growth::Bounded);
    assert!(pair.upper.is_none_or(|u| u > rational("1.00367")));
    // Two blocks that may both attain the radius leave growth open.
    assert_eq!(radius("[[[1,0],[0,1]],[[1,0],[0,\"1/2\"]]]").growth, Growth::Unknown);
    assert_eq!(radius("[[[2,1],[0,2]],[[1,0],[0,1]]]").growth, Growth::Unbounded(2));
    let mask: Vec<Rational> = "100/199 200/199 99/199 -1/199".split(' ').map(rational).collect();
    assert_eq!(regularity(&mask, 2, &Options::default()).unwrap().attained, Attained::Yes);
    // An integer exponent with bounded products: in the Zygmund sense.
    let mask: Vec<Rational> = "-1/16 0 9/16 1 9/16 0 -1/16".split(' ').map(rational).collect();
    let known = regularity(&mask, 2, &Options::default()).unwrap();
    assert!(known.attained != Attained::Yes, "{:?}", known.attained);
}

#[test]
fn an_automaton_forbids_words() {
    // Of the golden pair, A must be followed by A: the product AB is not a path.
    let text = "matrices = [[[1,1],[0,1]],[[1,0],[1,1]]]\nstates = [2]\narrows = [[0,0,0]]";
    let file = file::parse(text).unwrap();
    let r = joint_radius(&file.system, &Options::default()).unwrap();
    assert!(r.exact && r.upper == Some(Rational::from(1)));
    // No two B in a row.
    let text = "matrices = [[[1,1],[0,1]],[[1,0],[2,1]]]\nstates = [2,2]\narrows = [[0,0,0],[0,1,0],[1,0,1]]";
    let file = file::parse(text).unwrap();
    let r = joint_radius(&file.system, &Options::default()).unwrap();
    assert!(r.exact);
    assert!((to_f64(&r.lower.unwrap().enclosure(64).lo) - (2.0 + 3.0_f64.sqrt()).sqrt()).abs() < 1e-12);
}

/// Name, arity, mask, Hölder exponent, k of C^k.
const MASKS: &[(&str, usize, &str, f64, usize)] = &[
    ("bspline2", 2, "1/4 3/4 3/4 1/4", 2.0, 1),
    ("bspline3", 2, "1/8 1/2 3/4 1/2 1/8", 3.0, 2),
    ("bspline4", 2, "1/16 5/16 5/8 5/8 5/16 1/16", 4.0, 3),
    ("bspline6", 2, "1/64 7/64 21/64 35/64 35/64 21/64 7/64 1/64", 6.0, 5),
    ("DD2", 2, "1/2 1 1/2", 1.0, 0),
    ("DD4", 2, "-1/16 0 9/16 1 9/16 0 -1/16", 2.0, 1),
    ("DD6", 2, "3/256 0 -25/256 0 75/128 1 75/128 0 -25/256 0 3/256", 2.8300749985576865, 2),
    ("HS3", 2, "-3/32 5/32 15/16 15/16 5/32 -3/32", 1.1926450779423958, 1),
    ("HS4", 2, "-1/16 0 9/16 1 9/16 0 -1/16", 2.0, 1),
    ("HS5", 2, "-5/128 -7/128 35/128 105/128 105/128 35/128 -7/128 -5/128", 2.8300749985576874, 2),
    ("ter4-1_15", 3, "-2/45 -1/15 0 16/45 34/45 1 34/45 16/45 0 -1/15 -2/45", 2.0, 1),
    ("ter4-1_8", 3, "-5/144 -11/144 0 47/144 113/144 1 113/144 47/144 0 -11/144 -5/144", 1.892789260714372, 1),
    ("ter3-5_18", 3, "-1/18 0 5/18 7/9 1 7/9 5/18 0 -1/18", 1.3690702464285425, 1),
    ("ter3-4_15", 3, "-1/15 0 4/15 4/5 1 4/5 4/15 0 -1/15", 1.4649735207179269, 1),
    ("ter3-1_3", 3, "0 0 1/3 2/3 1 2/3 1/3 0 0", 1.0, 0),
    ("ternB1", 3, "1/3 2/3 1 2/3 1/3", 1.0, 0),
    ("ternB3", 3, "1/27 4/27 10/27 16/27 19/27 16/27 10/27 4/27 1/27", 3.0, 2),
    ("4pt-w3_20", 2, "-3/20 0 13/20 1 13/20 0 -3/20", 1.2228556969831417, 1),
    ("4pt-w19_100", 2, "-19/100 0 69/100 1 69/100 0 -19/100", 1.0126619004678612, 1),
    ("4pt-w193_1000", 2, "-193/1000 0 693/1000 1 693/1000 0 -193/1000", 0.9987538508428128, 0),
    ("4pt-w-1_10", 2, "1/10 0 2/5 1 2/5 0 1/10", 0.6145957186778039, 0),
    ("4pt-w2_5", 2, "-2/5 0 9/10 1 9/10 0 -2/5", 0.32192809488736207, 0),
];

#[test]
fn exponents_of_known_masks() {
    for (name, arity, mask, exponent, smoothness) in MASKS {
        let mask: Vec<Rational> = mask.split(' ').map(rational).collect();
        let r = regularity(&mask, *arity, &Options::default()).expect(name);
        let e = r.exponent.as_ref().expect(name);
        assert!((to_f64(&e.lo) - exponent).abs() < 1e-11 && (to_f64(&e.hi) - exponent).abs() < 1e-11, "{name}: {e:?}");
        assert!(r.radius.exact && r.smoothness_is_exact(), "{name}");
        assert_eq!(r.smoothness(), Some(*smoothness), "{name}");
    }
}

fn family(a: &str, b: &str) -> Shape {
    let (one, zero, a, b) = (Rational::from(1), Rational::from(0), rational(a), rational(b));
    let t0 = vec![
        vec![&one - &a, b.clone(), zero.clone()],
        vec![a.clone(), &one - &b, &one - &a],
        vec![zero.clone(), zero.clone(), a.clone()],
    ];
    let t1 = vec![
        vec![b.clone(), zero.clone(), zero.clone()],
        vec![&one - &b, &one - &a, b.clone()],
        vec![zero, a, &one - &b],
    ];
    Shape::single(CellKind::Edge, vec![Matrix::from_rows(3, t0), Matrix::from_rows(3, t1)])
}

fn cone(shape: &Shape) -> Option<ConeAnswer> {
    common_cone(shape, &Spaces::new(shape).expect("base points"), Budget::default().cone_steps)
}

#[test]
fn cones_of_the_two_parameter_family() {
    for (a, b) in
        [("1/4", "1/4"), ("3/10", "3/10"), ("1/10", "2/5"), ("1/10", "1/10"), ("33/100", "33/100"), ("2/5", "2/5")]
    {
        let shape = family(a, b);
        let Some(ConeAnswer::Proved(found)) = cone(&shape) else { panic!("{a} {b}") };
        assert!(found.holds(&shape, &Spaces::new(&shape).unwrap()));
        let mut spoiled = found.clone();
        spoiled.cones[0].functional.iter_mut().for_each(|x| *x = -&*x);
        assert!(!spoiled.holds(&shape, &Spaces::new(&shape).unwrap()));
    }
    for (a, b) in [("3/5", "3/5"), ("-3/5", "41/50"), ("-1/4", "1/2")] {
        assert!(matches!(cone(&family(a, b)), Some(ConeAnswer::Refuted(_))), "{a} {b}");
    }
}

/// `a, b > 0`: smooth iff `2a + b <= 1` and `a + 2b <= 1`, or `a + b = 1`; everywhere, and corners otherwise.
#[test]
fn the_two_parameter_family_is_smooth_exactly_in_its_region() {
    let grid = 20;
    for (p, q) in (1..grid).flat_map(|p| (1..grid).map(move |q| (p, q))).filter(|(p, q)| p + q <= grid) {
        let smooth = (2 * p + q <= grid && p + 2 * q <= grid) || p + q == grid;
        let shape = family(&format!("{p}/{grid}"), &format!("{q}/{grid}"));
        let found = certify(&shape, &[]).unwrap();
        let every = found.everywhere.expect("a curve");
        let expected = if smooth { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(every.verdict, expected, "a = {p}/{grid}, b = {q}/{grid}: {:?}", every.reason);
        assert!(every.cone.is_some(), "a = {p}/{grid}, b = {q}/{grid}: half-tangents at every point");
        let strict = 2 * p + q != grid && p + 2 * q != grid || p + q == grid;
        assert_eq!(every.cone.is_some_and(|c| c.slow.is_empty()), strict, "a = {p}/{grid}, b = {q}/{grid}");
    }
}

/// The Koch curve has three of the four parts: rays `±e_1, ±e_2`, positive coefficients, and its chord; no functional is
/// positive on them.
#[test]
fn three_of_four_parts_do_not_prove_the_koch_curve_smooth() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/classical/koch-2.toml");
    let shape = secant::case::Case::read(&path).unwrap().shape;
    let spaces = Spaces::new(&shape).unwrap();
    assert!(!matches!(cone(&shape), Some(ConeAnswer::Proved(_))));
    let basis = spaces.of(0).basis.clone();
    let n = basis.cols();
    let local = Matrix::from_fn(n, 2 * n, |i, j| {
        Rational::from(if j % n != i {
            0
        } else if j < n {
            1
        } else {
            -1
        })
    });
    let rays = &basis * &local;
    let positive = |x: &[Rational]| -> Vec<Rational> {
        // x = Σ (s + max(±x_k, 0)) (±e_k) with the same share s for a ray and its opposite.
        let part = |k: usize| if k < n { x[k].clone() } else { -&x[k - n] };
        (0..2 * n).map(|k| Rational::from(1) + part(k).max(Rational::from(0))).collect()
    };
    let start = shape.end_point(0, secant::shape::End::Start).unwrap();
    let finish = shape.end_point(0, secant::shape::End::Finish).unwrap();
    let chord = spaces.of(0).coordinates.apply(&secant::shape::difference(&finish, &start));
    let maps = shape.states[0].pieces.iter().enumerate().map(|(letter, piece)| {
        let sign = if piece.reversed { -1 } else { 1 };
        let images = &spaces.linear(&piece.op, 0, 0).scale(&Rational::from(sign)) * &local;
        let columns: Vec<Vec<Rational>> = (0..2 * n).map(|j| positive(&images.column(j))).collect();
        ConeMap { state: 0, letter, sign, matrix: Matrix::from_columns(2 * n, &columns) }
    });
    let maps: Vec<ConeMap> = maps.collect();
    for f in [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, -2, 3], [-1, 0, 0]] {
        let functional = f.iter().take(rays.rows()).map(|x| Rational::from(*x)).collect();
        let own = Cone { state: 0, rays: rays.clone(), functional, chord: positive(&chord) };
        let forged =
            CommonCone { cones: vec![own], maps: maps.clone(), view: None, window: 1, slow: Vec::new(), rate: None };
        assert!(!forged.holds(&shape, &spaces), "{f:?}");
    }
}

#[test]
fn the_four_point_scheme_has_a_common_cone() {
    let mask: Vec<Rational> = "-1/16 0 9/16 1 9/16 0 -1/16".split(' ').map(rational).collect();
    let shape = Shape::single(CellKind::Edge, digits(&mask, 2));
    assert!(matches!(cone(&shape), Some(ConeAnswer::Proved(_))));
}

#[test]
fn exponents_of_scaling_functions() {
    for (moments, exponent) in [(2, 0.550_015_686_523_504_2), (3, 1.087_833_926_271_246), (5, 1.968_963_530_239_063)] {
        let w = wavelet(Family::Daubechies, moments, &Options::default()).unwrap();
        let (lo, hi) = (to_f64(&w.exponent.lo), to_f64(&w.exponent.hi));
        assert!(lo <= exponent + 1e-12 && hi >= exponent - 1e-12 && hi - lo < 1e-9, "{moments}: [{lo}, {hi}]");
    }
}

/// Sets whose best word has a complex eigenvalue whose argument is no multiple of a root of unity.
const TURNING: &[(&str, &str)] = &[
    ("companion", "[[[0,0,1],[1,0,-1],[0,1,1]],[[\"1/3\",0,\"1/5\"],[0,\"1/4\",0],[\"1/7\",0,\"1/3\"]]]"),
    ("turn and shrink", "[[[\"3/5\",\"-4/5\"],[\"4/5\",\"3/5\"]],[[\"1/2\",\"1/3\"],[0,\"1/4\"]]]"),
    ("sheared turns", "[[[\"1/5\",\"-8/5\"],[\"4/5\",1]],[[\"1/3\",0],[\"1/2\",\"1/5\"]]]"),
];

#[test]
fn complex_leading_eigenvalues_are_bounded() {
    for (name, matrices) in TURNING {
        let r = radius(matrices);
        let lower = to_f64(&r.lower.as_ref().expect(name).enclosure(64).lo);
        let upper = to_f64(r.upper.as_ref().expect(name));
        assert!(lower <= upper && upper < lower * (1.0 + 1e-9), "{name}: [{lower}, {upper}]");
        assert!(r.exact, "{name}");
        for block in &r.blocks {
            if let Some(Proof::Balanced(p)) = &block.proof {
                assert_eq!(p.bound(&block.block.system), block.bound, "{name}");
                let mut short = p.clone();
                short.inclusions.pop();
                assert_eq!(short.bound(&block.block.system), None, "{name}");
            }
        }
    }
}

/// Changes one text of a certificate.
fn change(certificate: &str, path: &[&str], value: serde_json::Value) -> String {
    let mut json: serde_json::Value = serde_json::from_str(certificate).unwrap();
    let place = path.iter().fold(&mut json, |node, key| match key.parse::<usize>() {
        Ok(k) => &mut node[k],
        Err(_) => &mut node[*key],
    });
    *place = value;
    json.to_string()
}

#[test]
fn certificates_of_radii_are_accepted_and_forgeries_are_not() {
    let reducible =
        ("reducible", "[[[1,1,2],[0,\"1/2\",1],[0,0,1]],[[\"1/2\",0,1],[\"1/3\",\"1/5\",0],[0,0,\"1/4\"]]]");
    let sets = SETS.iter().map(|s| (s.0, s.1)).chain(TURNING.iter().copied()).chain([reducible]);
    for (name, matrices) in sets {
        let text = format!("name = \"{name}\"\nmatrices = {matrices}\n");
        let file = file::parse(&text).unwrap();
        let found = joint_radius(&file.system, &Options::default()).unwrap();
        let certificate = radius_certificate(&file, &found).expect(name).text();
        let accepted = secant_check::check(&text, &certificate).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(accepted.case, name);
        let low = change(&certificate, &["proof", "upper"], "1/100".into());
        assert!(secant_check::check(&text, &low).is_err(), "{name}: a lower bound from above");
        let high = change(&certificate, &["proof", "lower", "bound"], "99".into());
        assert!(secant_check::check(&text, &high).is_err(), "{name}: a higher bound from below");
        let bound = change(&certificate, &["proof", "blocks", "0", "bound"], "1/100".into());
        assert!(secant_check::check(&text, &bound).is_err(), "{name}: a smaller bound of a block");
        let basis = change(&certificate, &["proof", "bases", "0", "0"], serde_json::json!(["0"]));
        assert!(secant_check::check(&text, &basis).is_err(), "{name}: no basis");
        let other = text.replacen('1', "2", 1);
        assert!(secant_check::check(&other, &certificate).is_err(), "{name}: other matrices");
    }
}

#[test]
fn curves_say_what_holds_at_every_point() {
    let every = |case: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case);
        let case = secant::case::Case::read(&path).unwrap();
        certify(&case.shape, &case.examine).unwrap().everywhere.expect("a curve")
    };
    for case in ["two-parameter/boundary.toml", "reversed/generic-regular.toml", "automata/three-states.toml"] {
        assert_eq!(every(case).verdict, Verdict::Proved, "{case}");
    }
    for case in ["two-parameter/corner-2-5.toml", "reversed/generic-corner.toml"] {
        let found = every(case);
        assert!(found.verdict == Verdict::Refuted && found.cone.is_some(), "{case}");
    }
    for case in ["classical/koch-2.toml", "classical/takagi.toml", "classical/levy.toml"] {
        let found = every(case);
        assert!(found.verdict == Verdict::Refuted && found.cone.is_none(), "{case}");
    }
}

#[test]
fn forged_cones_are_rejected() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/two-parameter/boundary.toml");
    let case = secant::case::Case::read(&path).unwrap();
    let found = certify(&case.shape, &case.examine).unwrap();
    let text = secant::certificate::certificate(&case, &found).unwrap().text();
    let source = &case.text.text;
    let accepted = secant_check::check(source, &text).unwrap();
    assert!(
        accepted.claims.iter().any(|c| c.to_string().starts_with("proved: the curve is G¹")),
        "{:?}",
        accepted.claims
    );
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let answers = json["proof"]["answers"].as_array().unwrap();
    let at = answers.iter().position(|a| a["question"] == "every point").unwrap().to_string();
    let own = &answers[at.parse::<usize>().unwrap()];
    assert!(own["window"] == 2 && own["slow"].as_array().is_some_and(|s| !s.is_empty()), "the border needs Theorem 6′");
    let zeros = serde_json::json!(["0", "0", "0"]);
    let forgeries: [(&[&str], serde_json::Value); 9] = [
        (&["cones", "0", "functional"], zeros.clone()),
        (&["cones", "0", "chord"], serde_json::json!(["0", "0"])),
        (&["cones", "0", "rays", "0"], zeros),
        (&["maps", "0", "0", "0", "0"], "7".into()),
        (&["window"], 1.into()),
        (&["slow"], serde_json::json!([])),
        (&["joints"], serde_json::json!([])),
        (&["view"], serde_json::Value::Null),
        (&["verdict"], "refuted".into()),
    ];
    for (place, value) in forgeries {
        let whole = [&["proof", "answers", at.as_str()], place].concat();
        let forged = change(&text, &whole, value);
        assert!(secant_check::check(source, &forged).is_err(), "{place:?}");
    }
}

fn euler(digits: i64) -> System {
    let dim = usize::try_from(digits - 1).unwrap();
    let matrix = |e: i64| {
        let entry = |i: usize, j: usize| (0..digits).contains(&(2 * i as i64 - j as i64 + e));
        Matrix::from_fn(dim, dim, |i, j| Rational::from(u8::from(entry(i, j))))
    };
    System::plain(&[matrix(0), matrix(1)]).unwrap()
}

/// Radii that are the norm of the letters: the columns of both matrices have the sum `d/2` for an even number `d` of digits.
#[test]
fn norms_of_letters_are_exact_bounds() {
    for digits in [4, 6, 8] {
        let found = joint_radius(&euler(digits), &Options::default()).unwrap();
        assert!(found.exact && found.upper == Some(Rational::from(digits / 2)), "{digits}");
        assert!(matches!(&found.blocks[0].proof, Some(Proof::Tree(t)) if t.codes[0].iter().all(|w| w.len() == 1)));
    }
    // Rows instead of columns: the transposed matrices.
    let rows = System::plain(&euler(6).arrows.iter().map(|a| a.matrix.transpose()).collect::<Vec<_>>()).unwrap();
    let found = joint_radius(&rows, &Options::default()).unwrap();
    assert!(found.exact && found.upper == Some(Rational::from(3)));
    assert!(matches!(found.blocks[0].proof, Some(Proof::Transposed(_))));
}

/// Words whose proofs need only that the cycle comes back: before, boundary points were solved for in a field of degree 16.
#[test]
fn long_words_of_small_pairs_are_exact() {
    for (matrices, word, value) in [
        ("[[[6,-4],[1,3]],[[-3,1],[-2,-6]]]", "00001111", 5.894_032_130_742),
        ("[[[1,1],[0,1]],[[\"1/5\",0],[\"1/5\",\"1/5\"]]]", "", 0.0),
    ] {
        let found = radius(matrices);
        assert!(found.exact, "{matrices}");
        let lower = found.lower.unwrap();
        let own: String = lower.word.iter().map(ToString::to_string).collect();
        assert!(word.is_empty() || own == word, "{own}");
        assert!(value == 0.0 || (to_f64(&lower.enclosure(64).lo) - value).abs() < 1e-11);
    }
}

/// `u^k v` with a long power: the leading word of 41 letters, and A^273 B.
#[test]
fn powers_with_an_insertion_are_found() {
    let found = radius("[[[-1,1,-1],[-1,-1,1],[0,1,1]],[[-1,1,-1],[-1,-1,0],[0,1,1]]]");
    let lower = found.lower.unwrap();
    assert_eq!(lower.length, 41);
    assert!((to_f64(&lower.enclosure(64).lo) - 1.684_185_282_491).abs() < 1e-11);
    let found = radius("[[[1,1],[0,1]],[[0,0],[\"1/100\",0]]]");
    assert_eq!(found.growth, Growth::Bounded);
    let lower = found.lower.unwrap();
    assert!(to_f64(&lower.enclosure(64).lo) > 1.00367 && lower.length == 274);
}

/// Brute force from below and a plain tree in floats from above never contradict the bounds, for sets of many kinds.
#[test]
fn bounds_hold_against_floats() {
    let mut random = oorandom::Rand32::new(7);
    let options = Options { work: Some(60_000_000), ..Options::default() };
    for round in 0..60 {
        let (dim, count) = (1 + round % 4, 1 + (round / 4) % 3);
        let mut entry = || match round % 5 {
            0 => Rational::from(random.rand_range(0..3)),
            1 => Rational::from(i64::from(random.rand_range(0..3)) - 1),
            2 => Rational::from(i64::from(random.rand_range(0..41)) - 20) / Rational::from(7),
            3 => Rational::from(u8::from(random.rand_range(0..3) == 0)),
            _ => Rational::from(i64::from(random.rand_range(0..2001)) - 1000) / Rational::from(100_000),
        };
        let matrices: Vec<Matrix> = (0..count).map(|_| Matrix::from_fn(dim, dim, |_, _| entry())).collect();
        let found = joint_radius(&System::plain(&matrices).unwrap(), &options).unwrap();
        let (lo, hi) = brute(&matrices);
        let own = found.enclosure(64).expect("an upper bound");
        let (least, most) = (to_f64(&own.lo), to_f64(&own.hi));
        assert!(least <= most && least <= hi * (1.0 + 1e-9) + 1e-12, "round {round}: {least} above {hi}");
        assert!(most >= lo * (1.0 - 1e-9) - 1e-12, "round {round}: {most} below {lo}");
        assert!(!found.exact || most <= hi * (1.0 + 1e-9) + 1e-12);
    }
}

/// Bounds of the joint spectral radius in floats: all words of up to eight letters.
fn brute(matrices: &[Matrix]) -> (f64, f64) {
    let dense = |m: &Matrix| nalgebra::DMatrix::from_fn(m.rows(), m.cols(), |i, j| to_f64(&m[(i, j)]));
    let letters: Vec<_> = matrices.iter().map(dense).collect();
    let (mut lower, mut upper) = (0.0_f64, f64::INFINITY);
    let mut layer = letters.clone();
    for length in 1..=8 {
        let power = 1.0 / f64::from(length);
        // The spectral radius is at least |trace|/n; eigenvalues in floats are far from 0 where the exact ones are 0.
        let size = |m: &nalgebra::DMatrix<f64>| match m.trace().abs() {
            t if t > 1e-9 * m.norm() => t / m.nrows() as f64,
            _ => 0.0,
        };
        lower = lower.max(layer.iter().map(|m| size(m).powf(power)).fold(0.0, f64::max));
        upper = upper.min(layer.iter().map(|m| m.norm().powf(power)).fold(0.0, f64::max));
        if layer.len() * letters.len() > 3000 {
            break;
        }
        layer = layer.iter().flat_map(|p| letters.iter().map(move |m| p * m)).collect();
    }
    (lower, upper)
}

/// Large nonnegative sets and cycles longer than the words that are searched get an interval too.
#[test]
fn every_set_gets_an_answer() {
    let mut random = oorandom::Rand32::new(5);
    let large: Vec<Matrix> =
        (0..2).map(|_| Matrix::from_fn(40, 40, |_, _| Rational::from(random.rand_range(0..9)))).collect();
    let found = joint_radius(&System::plain(&large).unwrap(), &Options::default()).unwrap();
    let own = found.enclosure(64).unwrap();
    assert!(own.lo > 0 && own.width() < &own.lo * rational("1/1000000"));
    // A ring of 23 states: no cycle of up to 16 letters.
    let arrows: Vec<String> = (0..23).map(|k| format!("[{k}, {}, 0]", (k + 1) % 23)).collect();
    let dims = vec!["1"; 23].join(", ");
    let text = format!("matrices = [[[2]]]\nstates = [{dims}]\narrows = [{}]", arrows.join(", "));
    let found = joint_radius(&file::parse(&text).unwrap().system, &Options::default()).unwrap();
    assert_eq!(found.upper, Some(Rational::from(2)));
    // Hardly any budget.
    let options = Options { work: Some(1000), ..Options::default() };
    let found = joint_radius(&euler(9), &options).unwrap();
    assert!(found.upper.is_some() && !found.exact);
}

#[test]
fn forged_transposed_norms_are_rejected() {
    // All rows have the sum 3, the columns have not.
    let matrices = "[[[1,1,1],[0,1,2],[2,0,1]],[[1,2,0],[1,1,1],[0,1,2]]]";
    let text = format!("name = \"rows\"\nmatrices = {matrices}\n");
    let file = file::parse(&text).unwrap();
    let found = joint_radius(&file.system, &Options::default()).unwrap();
    let certificate = radius_certificate(&file, &found).unwrap().text();
    let json: serde_json::Value = serde_json::from_str(&certificate).unwrap();
    let norm = &json["proof"]["blocks"][0]["norm"];
    assert_eq!(norm["norm"], "transposed");
    assert!(secant_check::check(&text, &certificate).is_ok());
    let inner = norm["of"].clone();
    let twice = serde_json::json!({"norm": "transposed", "of": norm});
    for (place, value) in [
        (vec!["norm"], inner.clone()),
        (vec!["norm"], twice),
        (vec!["norm", "of"], serde_json::json!({"norm": "zero"})),
        (vec!["norm", "of", "codes"], serde_json::json!([])),
        (vec!["norm", "of", "codes", "0", "words"], serde_json::json!([[0]])),
        (vec!["norm", "of", "codes", "0", "words"], serde_json::json!([[]])),
        (vec!["norm", "of", "codes", "0", "weights"], serde_json::json!(["1", "1", "1/9"])),
        (vec!["bound"], "5/2".into()),
    ] {
        let whole = [&["proof", "blocks", "0"], place.as_slice()].concat();
        assert!(secant_check::check(&text, &change(&certificate, &whole, value)).is_err(), "{place:?}");
    }
}
