//! Joint spectral radii of matrices with entries in a real number field: against rational sets in other coordinates, against all
//! short words in floats, and forged certificates.

use secant::answer::Verdict;
use secant::ask;
use secant::case::Question;
use secant::prove::{Findings, confirm, prove};
use secant::radius::Options;
use secant::theorem::{Assertion, Claim};
use serde_json::{Value, json};

fn found(matrices: &str) -> (String, ask::Radius) {
    let text = format!("name = \"set\"\nmatrices = {matrices}\n");
    let radius = ask::radius("set", &text, &Options::default()).unwrap_or_else(|e| panic!("{matrices}: {e}"));
    (text, radius)
}

/// Rational sets, and the same in coordinates that are stretched by √2 or by 1 + √5: everything that is said is the same.
#[test]
fn other_coordinates_change_nothing() {
    let constrained = "\nstates = [2, 2]\narrows = [[0, 0, 0], [0, 1, 1], [1, 0, 0]]";
    for (plain, stretched, more) in [
        ("[[[1,1],[0,1]],[[1,0],[1,1]]]", "[[[1,\"sqrt(2)/2\"],[0,1]],[[1,0],[\"sqrt(2)\",1]]]", ""),
        ("[[[1,1],[0,1]],[[1,0],[1,1]]]", "[[[1,\"sqrt(2)/2\"],[0,1]],[[1,0],[\"sqrt(2)\",1]]]", constrained),
        (
            "[[[\"1/2\",\"1/3\"],[\"-1/4\",\"1/5\"]],[[\"1/5\",\"-1/2\"],[\"1/2\",\"1/5\"]]]",
            "[[[\"1/2\",\"1/3*(sqrt(5)-1)/4\"],[\"-1/4*(1+sqrt(5))\",\"1/5\"]],[[\"1/5\",\"-1/2*(sqrt(5)-1)/4\"],[\"1/2*(1+sqrt(5))\",\"1/5\"]]]",
            "",
        ),
        // The radius 1 is rational, and the polytope closes on its boundary.
        (
            "[[[\"1/2\",\"1/4\"],[0,1]],[[1,0],[1,\"1/2\"]]]",
            "[[[\"1/2\",\"sqrt(2)/8\"],[0,1]],[[1,0],[\"sqrt(2)\",\"1/2\"]]]",
            "",
        ),
        // A leading eigenvalue that turns.
        (
            "[[[\"1/2\",\"-3/4\"],[\"4/5\",\"1/3\"]],[[\"1/5\",\"1/7\"],[0,\"1/4\"]]]",
            "[[[\"1/2\",\"-3/8*sqrt(2)\"],[\"4/5*sqrt(2)\",\"1/3\"]],[[\"1/5\",\"1/14*sqrt(2)\"],[0,\"1/4\"]]]",
            "",
        ),
        // Long Jordan blocks: marginal growth.
        ("[[[1,1],[0,1]],[[\"1/2\",0],[0,\"1/3\"]]]", "[[[1,\"sqrt(2)/2\"],[0,1]],[[\"1/2\",0],[0,\"1/3\"]]]", ""),
    ] {
        let (_, one) = found(&format!("{plain}{more}"));
        let (text, two) = found(&format!("{stretched}{more}"));
        let (one, data) = (one.json(), two.json());
        for key in ["exact", "lower", "upper", "rational", "word", "growth", "jordan_block", "ended"] {
            assert_eq!(one[key], data[key], "{stretched}: {key}");
        }
        let certificate = two.certificate().unwrap_or_else(|e| panic!("{stretched}: {e}"));
        assert!(secant_check::check(&text, &certificate).is_ok(), "{stretched}");
    }
}

/// In a basis over Q(√2) these matrices have a common eigenvector, which no rational vector shows: products grow.
#[test]
fn subspaces_over_the_field_are_found() {
    let (_, radius) = found(
        "[[[0,1],[\"1/2\",0]],[[\"1/2\",\"sqrt(2)/2\"],[\"-sqrt(2)/4\",\"3/2\"]],[[0,\"1/2\"],[\"1/4\",0]],[[\"1/3\",\"1/7\"],[\"1/14\",\"1/3\"]]]",
    );
    let data = radius.json();
    assert_eq!(
        (&data["rational"], &data["growth"], &data["jordan_block"]),
        (&json!("1"), &json!("marginal"), &json!(2))
    );
}

/// The spectral radius of a product of 2x2 matrices.
fn spectral(m: [f64; 4]) -> f64 {
    let (half, det) = ((m[0] + m[3]) / 2.0, m[0] * m[3] - m[1] * m[2]);
    let disc = half * half - det;
    if disc >= 0.0 { half.abs() + disc.sqrt() } else { det.sqrt() }
}

fn times(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]]
}

#[test]
fn no_short_word_grows_faster() {
    let c = |k: f64| (2.0 * std::f64::consts::PI * k / 7.0).cos();
    let root = 2f64.sqrt();
    for (matrices, floats) in [
        (
            "[[[\"sqrt(2)\",1],[0,\"1/2\"]],[[\"1/2\",0],[\"sqrt(2)\",1]]]",
            [[root, 1.0, 0.0, 0.5], [0.5, 0.0, root, 1.0]],
        ),
        (
            "[[[\"cos(2*pi/7)\",\"1/3\"],[\"-1/5\",\"2*cos(2*pi/7)/3\"]],[[\"1/5\",\"-cos(4*pi/7)\"],[\"1/2\",\"1/7\"]]]",
            [[c(1.0), 1.0 / 3.0, -0.2, 2.0 * c(1.0) / 3.0], [0.2, -c(2.0), 0.5, 1.0 / 7.0]],
        ),
    ] {
        let (text, radius) = found(matrices);
        let data = radius.json();
        let number = |key: &str| data[key].as_str().unwrap().parse::<f64>().unwrap();
        let mut products = floats.to_vec();
        let mut most = 0.0_f64;
        for length in 1..=12 {
            most = products.iter().map(|m| spectral(*m).powf(1.0 / f64::from(length))).fold(most, f64::max);
            products = products.iter().flat_map(|m| floats.map(|a| times(*m, a))).collect();
        }
        assert!(data["exact"] == true && (most - number("lower")).abs() < 1e-9, "{matrices}: {most}");
        assert!(secant_check::check(&text, &radius.certificate().unwrap()).is_ok());
    }
}

/// The proof of another field, another root, another radius.
#[test]
fn forged_radii_are_rejected() {
    let (text, radius) = found("[[[\"sqrt(2)\",1],[0,\"1/2\"]],[[\"1/2\",0],[\"sqrt(2)\",1]]]");
    let certificate: Value = serde_json::from_str(&radius.certificate().unwrap()).unwrap();
    assert!(secant_check::check(&text, &certificate.to_string()).is_ok());
    let proof = |key: &str| certificate["proof"][key].clone();
    let point = &certificate["proof"]["blocks"][0]["norm"]["points"][0];
    assert!(point["coordinates"].is_array());
    for (place, value) in [
        ("/proof/field/interval", json!(["-3/2", "-7/5"])),
        ("/proof/field/polynomial", json!(["-3", "0", "1"])),
        ("/proof/field/polynomial", json!(["-2", "1"])),
        ("/proof/field/numbers", json!([["0", "-1"]])),
        ("/proof/field/numbers", json!([])),
        ("/proof/upper", json!("3/2")),
        ("/proof/blocks/0/bound", json!("3/2")),
        ("/proof/lower/bound", json!("8/5")),
        ("/proof/lower/error", json!("0")),
        ("/proof/lower/word", json!([0])),
        ("/proof/blocks/0/norm/points/0/coordinates", json!(["0", "0"])),
        ("/proof/blocks/0/norm/inclusions", json!([])),
        ("/proof/bases/0", json!([["1", "0"], ["2", "0"]])),
    ] {
        let mut forged = certificate.clone();
        *forged.pointer_mut(place).unwrap() = value;
        assert_ne!(forged, certificate, "{place}");
        assert!(secant_check::check(&text, &forged.to_string()).is_err(), "{place}");
    }
    // Without the field the entries are no numbers, and of another set it proves nothing.
    let mut bare = certificate.clone();
    bare["proof"].as_object_mut().unwrap().remove("field");
    assert!(secant_check::check(&text, &bare.to_string()).is_err());
    let other = text.replace("\"sqrt(2)\",1]]]", "\"2*sqrt(2)\",1]]]");
    assert!(other != text && secant_check::check(&other, &certificate.to_string()).is_err());
    assert_eq!(proof("lower")["word"].as_array().map(Vec::len), Some(5));
}

#[test]
fn numbers_that_are_none_are_told() {
    for (entry, message, help) in [
        ("sqrt(-4)", "not real", "only real numbers"),
        ("sqrt(4)", "rational", "write \"2\" here"),
        ("sqrt(", "", ""),
        ("x", "not a number", "docs/radius.md"),
    ] {
        let text = format!("matrices = [[[\"{entry}\", 1], [0, \"1/2\"]]]");
        let problem = ask::radius("set", &text, &Options::default()).unwrap_err();
        assert!(problem.to_string().contains(message) && problem.position() == Some((1, 15)), "{entry}: {problem}");
        assert!(problem.remedy().unwrap().contains(help), "{entry}: {problem}");
    }
}

fn certified(text: &str) -> (Vec<Claim>, Value, Findings) {
    let question = Question::parse("curve.toml", text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let mut findings = prove(&question, &secant::budget::Budget::default()).unwrap();
    let certificate = confirm(&mut findings).unwrap_or_else(|e| panic!("{text}: {e}"));
    (findings.claims(), certificate.json().clone(), findings)
}

fn smooth(claims: &[Claim], k: usize) -> Option<Verdict> {
    claims.iter().find(|c| matches!(c.what, Assertion::Smooth { order, .. } if order == k)).map(Claim::verdict)
}

/// Corner cutting with the golden ratio is C¹ in no parameter with equal shares; a spline over Q(√2) with an irrational tension
/// has the exponent that theory knows, and the coiflet of 6 taps the one of its radius.
#[test]
fn orders_of_smoothness_are_decided_over_fields() {
    // (1+z)^3/4 (1 − κ(1−z)²/z), κ = (√2−1)/2: the exponent is 2 − log_2 √2 = 3/2.
    let k = "(sqrt(2)-1)/2";
    let list: Vec<String> = [
        format!("-({k})/4"),
        format!("1/4-({k})/4"),
        format!("3/4+({k})/2"),
        format!("3/4+({k})/2"),
        format!("1/4-({k})/4"),
        format!("-({k})/4"),
    ]
    .iter()
    .map(|c| format!("\"{c}\""))
    .collect();
    let text = format!("name = \"tension\"\n[scheme]\nmask = [{}]\n", list.join(", "));
    let (claims, _, findings) = certified(&text);
    assert_eq!((smooth(&claims, 1), smooth(&claims, 2)), (Some(Verdict::Proved), Some(Verdict::Refuted)));
    let Findings::OverField { case, found } = &findings else { panic!("over a field") };
    let again = secant::certificate::confirm_orders(case, found).unwrap();
    assert!(again.iter().any(|a| matches!(a, Assertion::Smooth { order: 1, .. })), "{again:?}");
    let exponent = claims.iter().find_map(|c| match &c.what {
        Assertion::Exponent(Some(bounds), _) => Some(bounds.clone()),
        _ => None,
    });
    let half = secant::arith::ratio(3, 2);
    let exponent = exponent.unwrap();
    assert!(exponent.lo <= half && half <= exponent.hi && exponent.width() < secant::arith::ratio(1, 1_000_000));
}

/// Forged orders: another dimension, another outcome, another field.
#[test]
fn forged_orders_over_fields_are_rejected() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("golden.toml");
    std::fs::copy("cases/fields/de-rham-golden.toml", &path).unwrap();
    let (smooth, certificate, beside) = ask::certified_regularity(&path.display().to_string(), &[], 2, None).unwrap();
    let text = beside.unwrap_or_else(|| std::fs::read_to_string(&path).unwrap());
    assert!(smooth.decided, "{}", smooth.text);
    let certificate: Value = serde_json::from_str(&certificate).unwrap();
    assert!(secant_check::check(&text, &certificate.to_string()).is_ok());
    for (place, value) in [
        ("/proof/field/interval", json!(["-9/4", "-11/5"])),
        ("/proof/orders/0/dims", json!([1])),
        ("/proof/orders/1/dims", json!([1])),
        ("/proof/orders/1/outcome", json!("holds")),
        ("/proof/orders/1/radius/upper", json!("2/5")),
    ] {
        let mut forged = certificate.clone();
        *forged.pointer_mut(place).unwrap() = value;
        if forged != certificate {
            assert!(secant_check::check(&text, &forged.to_string()).is_err(), "{place}");
        }
    }
}

/// A filter in another normalisation than it names is read by its sums, which leave no choice; the checker reads what that stands
/// for.
#[test]
fn filters_are_read_by_their_sums() {
    let coiflet = "name = \"coiflet\"\n[scheme]\nfilter = [\"(1-sqrt(7))/16\", \"(5+sqrt(7))/16\", \"(14+2*sqrt(7))/16\", \
                   \"(14-2*sqrt(7))/16\", \"(1-sqrt(7))/16\", \"(-3+sqrt(7))/16\"]\nnormalisation = \"N\"\n";
    let (one, ..) = certified(&coiflet.replace('N', "arity"));
    let (other, ..) = certified(&coiflet.replace("\"N\"", "\"root\""));
    let words = |claims: &[Claim]| claims.iter().map(|c| format!("{c:?}")).collect::<Vec<_>>();
    assert_eq!(words(&one), words(&other));
    let rational =
        "name = \"chaikin\"\n[scheme]\nfilter = [\"1/4\", \"3/4\", \"3/4\", \"1/4\"]\nnormalisation = \"N\"\n";
    let (one, ..) = certified(&rational.replace('N', "arity"));
    let (other, ..) = certified(&rational.replace("\"N\"", "\"one\""));
    assert_eq!(words(&one), words(&other));
    // The sums of no normalisation.
    let wrong = rational.replace("\"3/4\", \"1/4\"", "\"3/4\", \"1/2\"").replace('N', "one");
    assert_eq!(Question::parse("wrong.toml", &wrong).unwrap_err().id(), "secant::case::sum-rule");
}

/// A tension of the four-point scheme: C¹ and no more, with the exponent of the rational members on both sides between theirs.
#[test]
fn tensions_over_fields_lie_between_rational_ones() {
    let exponent = |w: &str| {
        let question = Question::ask(&format!("four-point w={w}")).unwrap();
        let found = prove(&question, &secant::budget::Budget::default()).unwrap();
        let claims = found.claims();
        assert_eq!((smooth(&claims, 1), smooth(&claims, 2)), (Some(Verdict::Proved), Some(Verdict::Refuted)), "{w}");
        claims.iter().find_map(|c| if let Assertion::Exponent(b, _) = &c.what { b.clone() } else { None }).unwrap()
    };
    let (low, own, high) = (exponent("708/10000"), exponent("sqrt(2)/20"), exponent("707/10000"));
    assert!(low.hi < own.lo && own.hi < high.lo, "{low:?} {own:?} {high:?}");
}

/// A polygon of several spans is the curve of its mask on each.
#[test]
fn polygons_have_spans_over_fields() {
    let text = "name = \"db2-polygon\"\ncontrol = [[0, 0], [1, 2], [2, 0], [3, 1], [4, 0]]\n[scheme]\n\
                mask = [\"(1+sqrt(3))/4\", \"(3+sqrt(3))/4\", \"(3-sqrt(3))/4\", \"(1-sqrt(3))/4\"]\n";
    let (claims, _, findings) = certified(text);
    let Findings::OverField { case, .. } = &findings else { panic!("over a field") };
    assert!(case.shape.states.len() > 1);
    assert_eq!(smooth(&claims, 1), Some(Verdict::Refuted));
}

/// The wavelets with 4 and 6 taps are curves as their masks are.
#[test]
fn wavelets_are_curves_over_fields() {
    let question = Question::ask("db2").unwrap();
    let mut findings = prove(&question, &secant::budget::Budget::default()).unwrap();
    confirm(&mut findings).unwrap();
    let claims = findings.claims();
    assert!(claims.iter().any(|c| c.what.is_of_dense_joints() && c.verdict() == Verdict::Refuted));
    assert_eq!(smooth(&claims, 1), Some(Verdict::Refuted));
    let problem = Question::ask("db7").unwrap_err();
    assert!(problem.remedy().unwrap().contains("secant regularity"), "{problem}");
}
