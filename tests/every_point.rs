//! Curves that are G¹ because they are graphs over their uniform parameter (Theorem 12).

use secant::arith::Rational;
use secant::case::Case;
use secant::certificate::confirm;
use secant::radius::Options;
use secant::shape::Spaces;
use secant::theorem::graph::graph_over_parameter;
use secant::theorem::{EveryJoint, Verdict, certify};
use serde_json::{Value, json};

fn scheme(name: &str, parameters: &str, control: &str) -> Case {
    let text = format!("name = \"graph\"\nsource = \"test\"\n{control}[scheme]\nname = \"{name}\"\n{parameters}\n");
    Case::parse("graph.toml", &text).unwrap()
}

fn is_graph(name: &str, parameters: &str, control: &str) -> bool {
    let shape = scheme(name, parameters, control).shape;
    graph_over_parameter(&shape, &Spaces::new(&shape).unwrap(), &Options::default()).is_some()
}

#[test]
fn interpolating_schemes_are_graphs_over_their_parameter() {
    for w in ["1/16", "1/10", "1/8", "3/20"] {
        assert!(is_graph("four-point", &format!("w = \"{w}\""), ""), "{w}");
    }
    assert!(is_graph("dubuc-deslauriers", "points = 6", ""));
    assert!(is_graph("bspline", "degree = 2", ""));
}

#[test]
fn what_is_no_graph_is_not_claimed() {
    // Beyond the border of C¹; slopes that differ at the joints; a fold of the projection, and a projection without one.
    assert!(!is_graph("four-point", "w = \"1/5\"", ""));
    assert!(!is_graph("takagi", "alpha = \"1/3\"", ""));
    assert!(!is_graph("bspline", "degree = 2", "control = [[0], [1], [0]]\n"));
    assert!(is_graph("bspline", "degree = 2", "control = [[0], [1], [2]]\n"));
}

#[test]
fn the_four_point_scheme_is_smooth_everywhere_with_a_certificate() {
    let case = scheme("four-point", "w = \"1/10\"", "");
    let found = certify(&case.shape, &[]).unwrap();
    let every = found.everywhere.as_ref().unwrap();
    assert!(every.verdict == Verdict::Proved && every.derivative.is_some());
    let (text, certificate) = (case.checked_text(), confirm(&case, &found).unwrap().json().clone());
    let forged = |change: &dyn Fn(&mut Value)| {
        let mut value = certificate.clone();
        let answers = value["proof"]["answers"].as_array_mut().unwrap();
        change(answers.iter_mut().find(|a| a["question"] == "every point by its derivative").unwrap());
        secant_check::check(&text, &value.to_string())
    };
    assert!(forged(&|_| ()).is_ok());
    assert!(forged(&|a| a["radius"] = Value::Null).is_err());
    assert!(forged(&|a| a["radius"]["upper"] = json!("1/100")).is_err());
    assert!(forged(&|a| a["verdict"] = json!("refuted")).is_err());
    // The certificate of one member of the family proves nothing of another.
    let other = scheme("four-point", "w = \"1/5\"", "");
    assert!(secant_check::check(&other.checked_text(), &certificate.to_string()).is_err());
}

fn file(name: &str) -> Case {
    Case::read(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name)).unwrap()
}

#[test]
fn a_joined_curve_is_a_graph_over_shares_of_its_parameter_with_a_certificate() {
    let case = file("junction/chaikin-four-point.toml");
    let found = certify(&case.shape, &[]).unwrap();
    let order = found.everywhere.as_ref().unwrap().derivative.as_ref().expect("Theorem 12");
    assert!(order.shares.as_ref().unwrap().iter().all(|s| s.iter().sum::<Rational>() == 1));
    let (text, certificate) = (case.checked_text(), confirm(&case, &found).unwrap().json().clone());
    let forged = |change: &dyn Fn(&mut Value)| {
        let mut value = certificate.clone();
        let answers = value["proof"]["answers"].as_array_mut().unwrap();
        change(answers.iter_mut().find(|a| a["question"] == "every point by its derivative in shares").unwrap());
        secant_check::check(&text, &value.to_string())
    };
    assert!(forged(&|_| ()).is_ok());
    assert!(forged(&|a| a["radius"] = Value::Null).is_err());
    assert!(forged(&|a| a["radius"]["upper"] = json!("1/100")).is_err());
    assert!(forged(&|a| a["radius"]["upper"] = json!("1")).is_err());
    assert!(forged(&|a| a["verdict"] = json!("refuted")).is_err());
    assert!(forged(&|a| a["shares"] = json!([])).is_err());
    assert!(forged(&|a| drop(a["shares"].as_array_mut().unwrap().pop())).is_err());
    // Other shares of sum 1, a sum that is not 1, and shares that are not positive.
    for shares in [["1/5", "2/5", "2/5"], ["1/5", "3/5", "1/2"], ["0", "1/2", "1/2"], ["-1/5", "3/5", "3/5"]] {
        assert!(forged(&|a| a["shares"][0] = json!(shares)).is_err(), "{shares:?}");
    }
}

/// Changes an answer of a certificate, and asks the checker.
fn forged(case: &Case, certificate: &Value, question: &str, change: &dyn Fn(&mut Value)) -> Option<String> {
    let mut value = certificate.clone();
    let answers = value["proof"]["answers"].as_array_mut().unwrap();
    change(answers.iter_mut().find(|a| a["question"] == question).unwrap());
    secant_check::check(&case.checked_text(), &value.to_string()).err().map(|r| r.rule)
}

#[test]
fn loops_turn_towards_their_fixed_points_with_a_certificate() {
    for name in ["m1-4", "m1-4-joined", "m1-4-in-the-plane"] {
        let case = file(&format!("junction/{name}.toml"));
        let found = certify(&case.shape, &[]).unwrap();
        let every = found.everywhere.as_ref().unwrap();
        assert_eq!(every.verdict, Verdict::Proved, "{name}");
        assert!(every.components.is_some(), "{name}");
        let certificate = confirm(&case, &found).unwrap();
        assert!(certificate.left_out().is_empty() && certificate.decides_every_point(Verdict::Proved), "{name}");
        let rule = |change: &dyn Fn(&mut Value)| {
            forged(&case, certificate.json(), "every point by components", change).unwrap_or("accepted".to_owned())
        };
        let parts = certificate.json()["proof"]["answers"].as_array().unwrap().last().unwrap()["parts"].clone();
        let of = |kind: &str| parts.as_array().unwrap().iter().position(|p| p["part"] == kind);
        let (turning, cones) = (of("loop").unwrap(), of("cones").unwrap());
        assert_eq!(rule(&|_| ()), "accepted");
        // Without the last part the start is not proved; without cones the loop has no rays; twice, or in another order.
        assert_eq!(rule(&|a| drop(a["parts"].as_array_mut().unwrap().pop())), "components");
        assert_eq!(rule(&|a| drop(a["parts"].as_array_mut().unwrap().remove(cones))), "components");
        assert_eq!(rule(&|a| a["parts"].as_array_mut().unwrap().push(parts[turning].clone())), "components");
        assert_eq!(rule(&|a| a["parts"].as_array_mut().unwrap().reverse()), "components");
        assert_eq!(rule(&|a| a["parts"] = json!([])), "components");
        // A joint less, a joint instead of the fixed point, a functional that is 0, and one of another sign on no ray at all.
        assert_eq!(rule(&|a| drop(a["parts"][turning]["joints"].as_array_mut().unwrap().pop())), "components");
        assert_eq!(rule(&|a| a["parts"][turning]["fixed"] = a["parts"][turning]["joints"][0].take()), "format");
        assert_eq!(rule(&|a| a["parts"][turning]["fixed"] = parts[turning]["joints"][0].clone()), "components");
        let zero = parts[turning]["functional"].as_array().unwrap().iter().map(|_| json!([])).collect::<Value>();
        assert_eq!(rule(&|a| a["parts"][turning]["functional"] = zero.clone()), "leading");
        assert_eq!(rule(&|a| a["parts"][cones]["joints"] = json!([])), "components");
        assert_eq!(rule(&|a| a["parts"][cones]["slow"] = json!([{}])), "slow");
        assert_eq!(rule(&|a| a["parts"][cones]["window"] = json!(0)), "slow");
        if case.shape.control.is_some() {
            assert_eq!(rule(&|a| a["seen"] = Value::Null), "components");
            assert_eq!(rule(&|a| a["seen"]["code"] = json!([])), "frames");
        }
    }
    let smooth = file("junction/m1-5-smooth.toml");
    let found = certify(&smooth.shape, &[]).unwrap();
    assert_eq!(found.everywhere.as_ref().unwrap().verdict, Verdict::Proved);
    confirm(&smooth, &found).unwrap();
}

/// A joint that was examined where the curve is looked at counts where nothing is lost on the way; otherwise it is looked at in its
/// own state.
#[test]
fn joints_are_examined_where_nothing_is_lost() {
    for (control, listed) in
        [("", true), ("control = [[0, 0], [1, 2], [2, 0]]\n", true), ("control = [[0], [1], [3]]\n", false)]
    {
        let case = scheme("bspline", "degree = 2", control);
        let found = certify(&case.shape, &[]).unwrap();
        let every = found.everywhere.as_ref().unwrap();
        assert_eq!(every.verdict, Verdict::Proved, "{control}");
        assert!(!every.joints.is_empty() && every.cone.is_some(), "{control}");
        assert!(every.joints.iter().all(|j| matches!(j, EveryJoint::Listed(_)) == listed), "{control}");
    }
}

/// A cubic arc in the plane as a curve of de Casteljau.
fn cubic(control: &str) -> Case {
    scheme("bezier", "degree = 3", &format!("control = {control}\n"))
}

#[test]
fn polynomial_arcs_have_a_certificate() {
    let question = "every point by polynomials";
    // A loop, along which no cone goes; an arc of a line that turns back where 6t² − 6t + 1 = 0.
    for (control, verdict) in
        [("[[0, 0], [2, 1], [-1, 1], [1, 0]]", Verdict::Proved), ("[[0], [1], [-1], [0]]", Verdict::Refuted)]
    {
        let case = cubic(control);
        let found = certify(&case.shape, &[]).unwrap();
        let every = found.everywhere.as_ref().unwrap();
        assert_eq!(every.verdict, verdict, "{control}");
        assert!(every.hodograph.is_some(), "{control}");
        let certificate = confirm(&case, &found).unwrap();
        assert!(certificate.left_out().is_empty() && certificate.decides_every_point(verdict), "{control}");
        let rule = |change: &dyn Fn(&mut Value)| {
            forged(&case, certificate.json(), question, change).unwrap_or("accepted".to_owned())
        };
        assert_eq!(rule(&|_| ()), "accepted");
        let other = if verdict == Verdict::Proved { "refuted" } else { "proved" };
        assert_eq!(rule(&|a| a["verdict"] = json!(other)), "answers");
        assert_eq!(rule(&|a| a["arcs"] = json!([null])), "arc");
        assert_eq!(rule(&|a| a["arcs"] = json!([])), "arc");
        assert_eq!(rule(&|a| a["arcs"][0][0][1] = json!("1")), "arc");
        // A constant curve has the sum 1, and is not that of the case.
        let point = (0..4).map(|k| json!([if k == 0 { "1" } else { "0" }, "0", "0", "0"])).collect::<Value>();
        assert_eq!(rule(&|a| a["arcs"][0] = point.clone()), "arc");
    }
}

/// A loop with the piece `diag(1/2, 1/4)` and an exit: the tangents of a straight exit are kept along the orbit.
fn one_exit(direction: &str) -> Case {
    let text = format!(
        "name = \"exit\"\nsource = \"test\"\nconvention = \"columns\"\nstart = \"I\"\n\
         [[state]]\nname = \"I\"\ndimension = 3\n\
         [[state.piece]]\nto = \"I\"\nmatrix = [[1, \"1/2\", \"3/4\"], [0, \"1/2\", 0], [0, 0, \"1/4\"]]\n\
         [[state.piece]]\nto = \"s\"\nmatrix = {direction}\n\
         [[state]]\nname = \"s\"\ndimension = 2\n\
         [[state.piece]]\nto = \"s\"\nmatrix = [[1, \"1/2\"], [0, \"1/2\"]]\n\
         [[state.piece]]\nto = \"s\"\nmatrix = [[\"1/2\", 0], [\"1/2\", 1]]\n"
    );
    Case::parse("exit.toml", &text).unwrap()
}

#[test]
fn a_tangent_that_is_not_pulled_along_is_not_claimed() {
    // From (1/2, 1/4) to (1, 1): the loop is regular where its pieces meet only if the exit has the direction of its image.
    let steep = one_exit("[[\"1/4\", -1], [\"1/2\", 1], [\"1/4\", 1]]");
    let found = certify(&steep.shape, &[]).unwrap();
    assert!(found.everywhere.is_none_or(|e| e.verdict != Verdict::Proved));
}

#[test]
fn what_is_known_of_the_parameter_decides_curves_with_many_coordinates_or_pieces() {
    let decided = |name: &str, parameters: &str| {
        let case = scheme(name, parameters, "");
        let found = certify(&case.shape, &[]).unwrap();
        let every = found.everywhere.as_ref().unwrap();
        assert!(every.verdict == Verdict::Proved && every.cone.is_none(), "{name} {parameters}");
        assert!(confirm(&case, &found).is_ok(), "{name} {parameters}");
        (every.hodograph.is_some(), every.derivative.is_some())
    };
    assert_eq!(decided("bspline", "degree = 18"), (true, false));
    assert_eq!(decided("bspline", "degree = 3\narity = 24"), (true, false));
    assert_eq!(decided("dubuc-deslauriers", "points = 8"), (false, true));
}
