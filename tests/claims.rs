//! What a verdict is about, and why: sentences that say no more than was proved.

use secant::case::Case;
use secant::certificate::confirm;
use secant::report::claims::{assertion, judged, reason};
use secant::report::reasons;
use secant::shape::cell_text;
use secant::theorem::surface::certify_complex;
use secant::theorem::{About, Assertion, Certified, Kind, Outcome, PointReport, Reason, Statement, Verdict, Witness};
use serde_json::{Value, json};
use std::path::Path;

fn certified(name: &str) -> Certified {
    let case = Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"))).unwrap();
    certify_complex(&case.complex(), &case.examine).unwrap()
}

fn at<'a>(found: &'a Certified, address: &str) -> &'a PointReport {
    let here = |p: &&PointReport| p.branches.iter().any(|b| b.address.to_string() == address);
    found.points.iter().find(here).unwrap_or_else(|| panic!("{address} was not examined"))
}

fn claim(found: &Certified, address: &str) -> Assertion {
    let here = |what: &Assertion| what.asked().is_some_and(|(a, _)| a.to_string() == address);
    let claim = found.claims.iter().find(|c| here(&c.what));
    claim.unwrap_or_else(|| panic!("nothing is claimed of {address}")).what.clone()
}

#[test]
fn a_set_seen_through_a_projection_has_verdicts_about_branches() {
    let found = certified("sets/set-projected");
    for address in ["(0)", "(1)"] {
        assert_eq!(at(&found, address).verdict, Verdict::Proved);
        assert_eq!(at(&found, address).about(), About::Branch);
        assert!(matches!(claim(&found, address), Assertion::TangentAt { about: About::Branch, .. }));
        assert!(assertion(&claim(&found, address)).starts_with("the germ of the branch"));
    }
    // Without the projection nothing else comes near.
    let whole = certified("sets/carpet-line");
    assert!(whole.points.iter().any(|p| p.verdict == Verdict::Proved && p.about() == About::Shape));
}

/// The set comes to (0, 0) along the y-axis too, through a piece that the germ of (0) does not see.
#[test]
fn a_piece_that_is_set_aside_belongs_to_the_shape() {
    let found = certified("sets/segments-aside");
    let point = at(&found, "(0)");
    assert_eq!((point.verdict, point.about()), (Verdict::Proved, About::Branch));
    assert!(point.branches[0].ring.iter().any(|p| p.collapses));
}

#[test]
fn a_branch_without_a_germ_is_not_called_an_isolated_point_of_the_shape() {
    let found = certified("sets/other-addresses");
    let reason = |address: &str| reasons::point(at(&found, address)).unwrap();
    assert!(reason("1(0)").contains("isolated in this branch"), "{}", reason("1(0)"));
    assert!(reason("(0)").contains("isolated in the shape"), "{}", reason("(0)"));
    assert_eq!(at(&found, "1(0)").about(), About::Branch);
}

#[test]
fn a_cusp_inside_is_not_called_a_joint_with_different_tangents() {
    let found = certified("control/interior-cusp");
    let every = found.everywhere.as_ref().unwrap();
    assert_eq!(every.verdict, Verdict::Refuted);
    let reason = reasons::everywhere(&found, every).unwrap();
    assert!(reason.contains("(01)") && reason.contains("cusp") && !reason.contains("joint"), "{reason}");
}

#[test]
fn kinds_tell_what_is_undetermined_from_what_is_refuted() {
    for name in ["sets/carpet-witness", "sets/other-addresses", "classical/koch-2", "control/interior-cusp"] {
        for point in &certified(name).points {
            let expected = match point.verdict {
                Verdict::Proved => ![Kind::Corner, Kind::NoTangent, Kind::Undetermined].contains(&point.kind),
                Verdict::Refuted => [Kind::Corner, Kind::NoTangent].contains(&point.kind),
                Verdict::Undetermined => point.kind == Kind::Undetermined,
            };
            assert!(expected, "{name}: {:?} {:?}", point.verdict, point.kind);
        }
    }
}

#[test]
fn a_refuted_claim_names_the_place_that_refutes_it() {
    let case = Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/classical/levy.toml")).unwrap();
    let found = certify_complex(&case.complex(), &case.examine).unwrap();
    for claim in &found.claims {
        let said = reason(&case, &found, claim);
        assert_eq!(said.is_none(), claim.verdict() == Verdict::Proved, "{:?}", claim.what);
        assert_eq!(judged(claim).starts_with("it is false that "), claim.verdict() == Verdict::Refuted);
    }
    let refuted = found.claims.iter().find(|c| c.what == Assertion::TangentAtEnds).unwrap();
    match refuted.reason() {
        Some(Reason::End(index)) => assert_eq!(found.points[*index].verdict, refuted.verdict()),
        other => panic!("{other:?}"),
    }
}
/// Theorem 4′ where all of its hypotheses hold, with a certificate, and where one of them fails.
#[test]
fn a_change_of_sign_refutes_on_connected_parts_only() {
    for (name, verdict, statement) in [
        ("sign-block-3", Verdict::Refuted, Some(Statement::Theorem4Sign)),
        ("sign-projected", Verdict::Refuted, Some(Statement::Theorem4Sign)),
        ("sign-apart", Verdict::Proved, None),
        ("sign-on-a-line", Verdict::Undetermined, None),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/counterexamples/{name}.toml"));
        let case = Case::read(&path).unwrap();
        let found = certify_complex(&case.complex(), &case.examine).unwrap();
        let point = at(&found, "(0)");
        assert_eq!(point.verdict, verdict, "{name}: {:?}", point.reason);
        if let (Some(wanted), Outcome::AtLeast { statement, dimension, .. }) = (statement, &point.branches[0].outcome) {
            assert_eq!((*statement, *dimension), (wanted, 2), "{name}");
        }
        confirm(&case, &found).unwrap_or_else(|doubt| panic!("{name}: {doubt}"));
    }
}

/// The functional only touches 0, at a point with a short address, and the cells at hand shrink to it.
#[test]
fn points_with_short_cycles_are_witnesses() {
    let found = certified("self-affine/witness-0-1");
    let point = at(&found, "(2)");
    let Outcome::AtLeast { witness: Some(Witness::Point { address, .. }), .. } = &point.branches[0].outcome else {
        panic!("{:?}", point.reason);
    };
    assert_eq!(address.to_string(), "0(1)");
}

#[test]
fn long_cells_are_written_with_powers() {
    let word = |text: &str, times: usize| -> Vec<usize> {
        [vec![0], text.bytes().map(|b| usize::from(b - b'0')).collect::<Vec<_>>().repeat(times)].concat()
    };
    assert_eq!(cell_text(&word("1", 2000)), "0 1^2000");
    assert_eq!(cell_text(&word("10", 40)), "0 (10)^40");
    assert_eq!(cell_text(&[0, 1, 1, 1, 1]), "01111");
}

/// Control points of a cubic arc, whether it is G¹ at every point, and at how many parameters it turns back.
#[test]
fn polynomial_curves_are_decided_at_every_point() {
    for (control, verdict, turns) in [
        ("[[0, 0], [0, 0], [2, 4], [4, 0]]", Verdict::Proved, 0),
        ("[[0, 0], [\"-2/3\", 0], [0, \"-1/3\"], [0, 1]]", Verdict::Refuted, 1),
        ("[[1, 1], [0, 0], [3, 3], [2, 2]]", Verdict::Refuted, 2),
        ("[[0, 0], [0, 0], [1, 1], [1, 1]]", Verdict::Proved, 0),
        ("[[0, 0], [1, 0], [1, 1], [0, 1]]", Verdict::Proved, 0),
    ] {
        let text = format!("name = \"arc\"\ncontrol = {control}\n[scheme]\nname = \"bezier\"\ndegree = 3\n");
        let path =
            std::env::temp_dir().join(format!("secant-arc-{}-{turns}-{}.toml", std::process::id(), control.len()));
        std::fs::write(&path, text).unwrap();
        let case = Case::read(&path);
        std::fs::remove_file(&path).unwrap();
        let case = case.unwrap();
        let found = certify_complex(&case.complex(), &case.examine).unwrap();
        let every = found.everywhere.as_ref().unwrap();
        assert_eq!(every.verdict, verdict, "{control}: {:?}", every.reason);
        if let Some(h) = &every.hodograph {
            assert_eq!(h.turns.len(), turns, "{control}");
        } else {
            assert_eq!(verdict, Verdict::Proved, "{control}");
        }
        let certificate = confirm(&case, &found).unwrap_or_else(|doubt| panic!("{control}: {doubt}"));
        assert!(certificate.left_out().is_empty() && certificate.decides_every_point(verdict), "{control}");
    }
}

/// A dense set beside a joint without a tangent has an answer of its own, and every part of it is needed.
#[test]
fn joints_that_are_not_killed_are_proved_again_beside_one_that_is() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/control/killed-deep-joint.toml");
    let case = Case::read(&path).unwrap();
    let found = certify_complex(&case.complex(), &case.examine).unwrap();
    let certificate = confirm(&case, &found).unwrap();
    assert!(certificate.left_out().is_empty(), "{:?}", certificate.left_out());
    let answers = certificate.json()["proof"]["answers"].as_array().unwrap();
    assert_eq!(answers[1]["verdict"], "refuted");
    let k = answers.iter().position(|a| a["question"] == "joints not killed").unwrap();
    let rule = |change: &dyn Fn(&mut Vec<Value>)| {
        let mut forged = certificate.json().clone();
        change(forged["proof"]["answers"].as_array_mut().unwrap());
        secant_check::check(&case.text.text, &forged.to_string()).unwrap_err().rule
    };
    assert_eq!(rule(&|a| a[k]["upstairs"] = json!([])), "joints");
    assert_eq!(rule(&|a| a[k]["theorem"] = json!("5")), "joints");
    assert_eq!(rule(&|a| a[k]["theorem"] = json!("none")), "joints");
    assert_eq!(rule(&|a| a[k]["theorem"] = json!("11'")), "format");
    assert_eq!(rule(&|a| a[k]["verdict"] = json!("refuted")), "answers");
    assert_eq!(rule(&|a| a[k]["upstairs"][0]["point"]["place"]["at"] = json!("left end")), "format");
    let twice = |a: &mut Vec<Value>| {
        let again = a[k]["upstairs"][0].clone();
        a[k]["upstairs"].as_array_mut().unwrap().push(again);
    };
    assert_eq!(rule(&twice), "joints");
    assert_eq!(rule(&|a| a.push(a[k].clone())), "format");
    // What is true of these joints is not true of all.
    assert_eq!(rule(&|a| a[1]["verdict"] = json!("proved")), "answers");
}

#[test]
fn the_same_curve_in_other_units_has_the_same_verdicts() {
    let kinds =
        |name: &str| -> Vec<(Verdict, Kind)> { certified(name).points.iter().map(|p| (p.verdict, p.kind)).collect() };
    let (small, large) = (kinds("self-affine/flat-scaled"), kinds("self-affine/flat-unscaled"));
    assert_eq!(small, large);
    assert!(small.iter().all(|(v, _)| *v != Verdict::Undetermined), "{small:?}");
}
