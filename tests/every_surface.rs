//! Every point of a surface: proved, refuted with a witness, or open, and certificates that the checker proves again.

use secant::answer::Answer;
use secant::case::Case;
use secant::certificate::confirm;
use secant::theorem::surface::{EverySurfaceBreak, EverySurfaceProof, Surface, certify_complex};
use secant::theorem::{Assertion, Certified, EverySurfaceGap, Kind, Required, Statement, Verdict};
use serde_json::{Value, json};

fn parse(text: &str) -> Case {
    Case::parse("every.toml", &format!("name = \"every\"\nsource = \"test\"\n{text}\n")).unwrap()
}

fn product(first: &str, second: &str, more: &str) -> Case {
    parse(&format!("{more}\n[scheme]\ntensor = [{{ {first} }}, {{ {second} }}]"))
}

fn corners(a: &str, b: &str) -> String {
    format!("name = \"corner-cutting\", a = \"{a}\", b = \"{b}\"")
}

fn square(a: &str, b: &str) -> Case {
    product(&corners(a, b), &corners(a, b), "")
}

fn file(name: &str) -> Case {
    Case::read(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)).unwrap()
}

fn found(case: &Case) -> Certified {
    certify_complex(&case.complex(), &case.examine).unwrap()
}

fn surface(found: &Certified) -> &Surface {
    found.surface.as_ref().expect("a surface")
}

fn verdict(case: &Case) -> Verdict {
    let found = found(case);
    let claim = found.claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).expect("a claim on every point");
    assert_eq!(claim.verdict(), surface(&found).every.verdict());
    assert_eq!(Required::parse("g1").unwrap().verdict(&found.claims), claim.verdict());
    claim.verdict()
}

#[test]
fn products_of_smooth_curves_are_smooth_everywhere() {
    // The last one has a Jordan block at the joint of its curves (Theorem 6′): rates do not matter.
    for (a, b) in [("3/10", "1/4"), ("1/4", "1/4"), ("1/5", "3/10"), ("1/10", "1/5"), ("1/5", "2/5")] {
        let case = square(a, b);
        let found = found(&case);
        assert!(matches!(surface(&found).every, Answer::Proved(EverySurfaceProof::Product(_))), "({a}, {b})");
        let claim = found.claims.iter().find(|c| c.what == Assertion::PlaneEverywhere).unwrap();
        assert_eq!(claim.statement(), Some(Statement::TensorEveryPoint));
    }
    // Of two different curves, one of them in three pieces.
    let three = "name = \"bspline\", degree = 2, arity = 3";
    assert_eq!(verdict(&product(&corners("3/10", "1/4"), three, "")), Verdict::Proved);
}

#[test]
fn a_corner_or_a_cusp_of_a_curve_refutes_the_product() {
    // (2/5, 1/4) has strictly invariant cones and a corner between its pieces; (−1/4, 1/2) has a cusp there.
    for (a, b, kind) in [("2/5", "1/4", Kind::Corner), ("-1/4", "1/2", Kind::Cusp)] {
        let found = found(&product(&corners("1/4", "1/4"), &corners(a, b), ""));
        let Answer::Refuted(EverySurfaceBreak::Curve { curves, curve: 1, point }) = &surface(&found).every else {
            panic!("({a}, {b}) is refuted by its second curve")
        };
        assert_eq!(curves[1].points[*point].kind, kind);
    }
    // What decides by default are the tangents that were examined.
    assert_eq!(Required::default().verdict(&found(&square("3/10", "1/4")).claims), Verdict::Proved);
}

#[test]
fn what_is_not_decided_says_why() {
    // Takagi–Landsberg with factor 1/3 has kinks, and a Koch curve has no tangents at all.
    assert_eq!(verdict(&product("name = \"takagi\", alpha = \"1/3\"", &corners("1/4", "1/4"), "")), Verdict::Refuted);
    let fold = "control = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]]";
    let flat = found(&product(&corners("3/10", "1/4"), &corners("3/10", "1/4"), fold));
    let Answer::Open(gaps) = &surface(&flat).every else { panic!("open") };
    assert!(gaps.contains(&EverySurfaceGap::Folded), "{gaps:?}");
}

#[test]
fn discs_around_a_vertex_are_open() {
    for text in ["mesh = \"catmull-clark\"\nvalence = 5", "mesh = \"doo-sabin-frequency\"\nfrequency = 2\nvalence = 6"]
    {
        let case = parse(&format!("[scheme]\n{text}\ncell = \"disc\""));
        let found = found(&case);
        assert_ne!(surface(&found).every.verdict(), Verdict::Proved, "{text}");
    }
}

/// What the checker says of a certificate that was changed.
fn forged(case: &Case, change: &dyn Fn(&mut Value)) -> Result<secant_check::Accepted, secant_check::Rejected> {
    let mut value = confirm(case, &found(case)).unwrap().json().clone();
    change(&mut value["proof"]);
    secant_check::check(&case.checked_text(), &value.to_string())
}

fn says(accepted: &secant_check::Accepted) -> Option<secant_check::Verdict> {
    accepted.claims.iter().find(|d| d.claim == secant_check::Claim::PlaneTurns).map(|d| d.verdict)
}

#[test]
fn certificates_of_products_are_proved_again_and_forgeries_are_not() {
    let (smooth, broken) = (square("3/10", "1/4"), square("2/5", "1/4"));
    assert_eq!(says(&forged(&smooth, &|_| ()).unwrap()), Some(secant_check::Verdict::Proved));
    assert_eq!(says(&forged(&broken, &|_| ()).unwrap()), Some(secant_check::Verdict::Refuted));
    let refused = |case: &Case, change: &dyn Fn(&mut Value)| assert!(forged(case, change).is_err());
    refused(&smooth, &|p| p["every"]["verdict"] = json!("refuted"));
    refused(&smooth, &|p| p["every"]["curves"][1] = Value::Null);
    refused(&smooth, &|p| p["every"]["curves"] = json!([]));
    refused(&smooth, &|p| p["every"]["by"] = json!("point"));
    refused(&smooth, &|p| p["every"] = json!({"by": "point", "verdict": "refuted", "point": 0}));
    refused(&smooth, &|p| p["every"]["curves"][0]["joints"] = json!([]));
    refused(&smooth, &|p| p["every"]["curves"][0]["maps"][0][0][0][0] = json!("7"));
    refused(&smooth, &|p| p["product"] = Value::Null);
    refused(&broken, &|p| p["every"]["verdict"] = json!("proved"));
    refused(&broken, &|p| p["every"]["curves"][0]["witness"] = json!([0]));
    refused(&broken, &|p| p["every"]["curves"][0] = Value::Null);
    // Without the answer nothing is said of every point, and the rest stands.
    let without = forged(&smooth, &|p| drop(p.as_object_mut().unwrap().remove("every"))).unwrap();
    assert_eq!(says(&without), None);
    // The certificate of one product proves nothing of another one.
    let certificate = confirm(&smooth, &found(&smooth)).unwrap().json().to_string();
    assert!(secant_check::check(&broken.checked_text(), &certificate).is_err());
}

#[test]
fn a_point_without_a_tangent_plane_refutes_with_a_certificate() {
    let case = file("surfaces/collapsed-line.toml");
    let found = found(&case);
    assert!(matches!(surface(&found).every, Answer::Refuted(EverySurfaceBreak::Point(_))));
    assert_eq!(says(&forged(&case, &|_| ()).unwrap()), Some(secant_check::Verdict::Refuted));
    assert!(forged(&case, &|p| p["every"]["point"] = json!(99)).is_err());
    assert!(forged(&case, &|p| p["every"]["verdict"] = json!("proved")).is_err());
}
