//! Shapes that start somewhere: states of different dimensions, seen through control points and through transient states.

use crate::automata;
use crate::corpus;

use automata::{automaton, plans};
use corpus::case_files;
use proptest::prelude::*;
use secant::case::Case;
use secant::certificate::confirm;
use secant::linalg::Matrix;
use secant::shape::{CellKind, Piece, Shape, State};
use secant::statement::Statement;
use secant::theorem::{Assertion, Certified, Claim, FrameKind, Kind, PointReport, Role, Verdict, certify};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// Positions belong to the start state, images to the control points, and everything else to no control point.
    #[test]
    fn random_automata_with_control_points_are_examined(plan in plans()) {
        let shape = automaton(&plan);
        let Ok(found) = certify(&shape, &[]) else { return Ok(()) };
        for p in &found.points {
            prop_assert_eq!(p.position.len(), plan.dims[0]);
            let image = shape.control.as_ref().map(|c| c.apply(&p.position));
            prop_assert_eq!(&p.image, &image);
        }
        let own = |p: &PointReport| p.image.is_none();
        prop_assert!(found.dense.iter().flat_map(|d| &d.upstairs).all(own));
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(name: &str) -> Case {
    Case::read(&root().join("cases").join(name)).unwrap()
}

fn examined(name: &str) -> (Case, Certified) {
    let case = read(name);
    let found = certify(&case.shape, &case.examine).unwrap();
    (case, found)
}

/// The verdict on all joints together, with the statement of the claim about a dense set of them.
fn on_joints(found: &Certified) -> (Verdict, Option<Statement>) {
    let claims: Vec<Verdict> = found.claims.iter().filter(|c| c.what.is_of_joints()).map(Claim::verdict).collect();
    let all = Verdict::all(claims.len(), claims.iter().copied());
    (all, found.dense_claim().and_then(Claim::statement))
}

#[test]
fn every_joint_of_two_spans_and_of_a_joined_curve_in_the_plane() {
    for name in ["control/two-spans.toml", "junction/m1-4-in-the-plane.toml"] {
        let (case, found) = examined(name);
        assert_eq!(on_joints(&found), (Verdict::Proved, Some(Statement::FramesCones)), "{name}");
        let joints = found.points.iter().filter(|p| matches!(p.role, Role::Joint { .. }));
        assert!(joints.clone().count() > 0 && joints.clone().all(|p| p.kind == Kind::Regular), "{name}");
        confirm(&case, &found).unwrap();
    }
    let (_, found) = examined("junction/m1-4-in-the-plane.toml");
    let frames = found.dense.unwrap().frames.unwrap().frames;
    let kinds: Vec<(usize, FrameKind)> = frames.iter().map(|f| (f.seen.state, f.kind)).collect();
    let expected = [(0, FrameKind::Transient), (1, FrameKind::Good), (2, FrameKind::Folded), (3, FrameKind::Folded)];
    assert_eq!(kinds, expected);
}

#[test]
fn a_cusp_of_the_projection_is_no_regular_joint() {
    let (case, found) = examined("counterexamples/cusp-at-a-quarter.toml");
    let kind = |path: &[usize]| {
        let here = |p: &&PointReport| matches!(&p.role, Role::Joint { path: q, .. } if q == path);
        found.points.iter().find(here).map(|p| p.kind)
    };
    assert_eq!((kind(&[]), kind(&[0])), (Some(Kind::Regular), Some(Kind::Cusp)));
    let (_, statement) = on_joints(&found);
    assert!(!matches!(statement, Some(Statement::Frames | Statement::FramesCones | Statement::Theorem5)));
    confirm(&case, &found).unwrap();
}

#[test]
fn what_one_entrance_hides_another_shows() {
    let (case, found) = examined("counterexamples/two-entrances.toml");
    assert_eq!(on_joints(&found).0, Verdict::Proved);
    let frames = found.dense.as_ref().unwrap().frames.as_ref().unwrap();
    assert!(frames.constant && frames.frames.iter().filter(|f| f.seen.state == 1).count() == 1);
    assert_eq!(found.dense_claim().unwrap().what, Assertion::SeenJoints);
    confirm(&case, &found).unwrap();
}

/// A state in front that is read once, with the identity.
fn wrapped(shape: &Shape) -> Shape {
    let mut out = shape.clone();
    let dim = shape.states[shape.start].dim;
    let pieces = vec![Piece { target: shape.start, op: Matrix::identity(dim), reversed: false, share: None }];
    let name = "in front".to_owned();
    out.states.push(State { name, kind: CellKind::Edge, dim, pieces, left: None, right: None });
    out.start = shape.states.len();
    out
}

#[test]
fn a_state_in_front_changes_no_verdict() {
    let mut files: Vec<PathBuf> = Vec::new();
    for folder in ["control", "counterexamples", "singular", "reversed", "automata"] {
        case_files(&root().join("cases").join(folder), &mut files);
    }
    let mut count = 0;
    for file in files {
        let Ok(case) = Case::read(&file) else { continue };
        let shape = &case.shape;
        let small = shape.states.iter().all(|s| s.dim <= 4);
        if shape.states[shape.start].kind != CellKind::Edge || !small {
            continue;
        }
        let Ok(plain) = certify(shape, &[]) else { continue };
        let inside = certify(&wrapped(shape), &[]).unwrap();
        let verdicts = |found: &Certified| {
            let ends = found.claims.first().map(Claim::verdict);
            let kinds: Vec<(Verdict, Kind)> = found
                .points
                .iter()
                .filter(|p| matches!(p.role, Role::LeftEnd | Role::RightEnd))
                .map(|p| (p.verdict, p.kind))
                .collect();
            (ends, kinds, on_joints(found).0)
        };
        assert_eq!(verdicts(&plain), verdicts(&inside), "{}", file.display());
        count += 1;
    }
    assert!(count > 10, "only {count} cases");
}

/// The joints of a certificate, changed.
fn forged(certificate: &Value, change: impl FnOnce(&mut Value)) -> String {
    let mut value = certificate.clone();
    let answer = value["proof"]["answers"].as_array_mut().unwrap().iter_mut().find(|a| a["question"] == "joints");
    change(answer.unwrap());
    value.to_string()
}

#[test]
fn forged_frames_are_rejected() {
    let (case, found) = examined("control/two-spans.toml");
    let (text, certificate) = (case.checked_text(), confirm(&case, &found).unwrap().json().clone());
    let rejected = |what: &str, source: &str, forged: String| {
        let answer = secant_check::check(source, &forged);
        assert!(answer.is_err_and(|r| r.rule != "format"), "{what}");
    };
    assert!(secant_check::check(&text, &forged(&certificate, |_| ())).is_ok());
    let frame = |a: &mut Value, k: usize| a["upstairs"][k].take();
    rejected("a frame less", &text, forged(&certificate, |a| drop(a["upstairs"].as_array_mut().unwrap().pop())));
    rejected("no frames", &text, forged(&certificate, |a| a["upstairs"] = json!([])));
    rejected("a joint less", &text, forged(&certificate, |a| a["upstairs"][0]["joints"] = json!([])));
    rejected("no cones", &text, forged(&certificate, |a| a["upstairs"][1]["cones"] = Value::Null));
    rejected("no code", &text, forged(&certificate, |a| a["upstairs"][1]["cones"]["code"] = json!([])));
    rejected("another theorem", &text, forged(&certificate, |a| a["theorem"] = json!("5")));
    let half = |a: &mut Value| a["upstairs"][1]["cones"]["code"][0]["word"] = json!([0]);
    rejected("a gap in the code", &text, forged(&certificate, half));
    let swapped = |a: &mut Value| {
        let (first, second) = (frame(a, 0), frame(a, 1));
        a["upstairs"] = json!([second, first]);
    };
    rejected("frames exchanged", &text, forged(&certificate, swapped));
    // The same curve folded back: the abscissae no longer increase.
    let folded = text.replace("[2, 2]", "[-2, 2]").replace("[2,2]", "[-2,2]");
    assert_ne!(folded, text);
    rejected("other control points", &folded, certificate.to_string());
    // A dense set is claimed by the same frames without cones, because the lines span.
    let dense = |a: &mut Value| {
        a["theorem"] = json!("11'");
        a["upstairs"][1]["cones"] = Value::Null;
    };
    assert!(secant_check::check(&text, &forged(&certificate, dense)).is_ok());
    let fewer = |a: &mut Value| {
        dense(a);
        a["upstairs"][1]["joints"].as_array_mut().unwrap().pop();
    };
    rejected("a dense set by fewer joints", &text, forged(&certificate, fewer));
}
