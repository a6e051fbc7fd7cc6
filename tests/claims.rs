//! What a verdict is about, and why: sentences that say no more than was proved.

use secant::case::Case;
use secant::report::claims::{assertion, judged, reason};
use secant::theorem::surface::certify_complex;
use secant::theorem::{About, Assertion, Certified, Kind, PointReport, Reason, Verdict};
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
    let reason = |address: &str| at(&found, address).reason.clone().unwrap();
    assert!(reason("1(0)").contains("isolated in this branch"), "{}", reason("1(0)"));
    assert!(reason("(0)").contains("isolated in the shape"), "{}", reason("(0)"));
    assert_eq!(at(&found, "1(0)").about(), About::Branch);
}

#[test]
fn a_cusp_inside_is_not_called_a_joint_with_different_tangents() {
    let found = certified("control/interior-cusp");
    let every = found.everywhere.as_ref().unwrap();
    assert_eq!(every.verdict, Verdict::Refuted);
    let reason = every.reason.as_ref().unwrap();
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
