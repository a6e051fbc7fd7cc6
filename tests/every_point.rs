//! Curves that are G¹ because they are graphs over their uniform parameter (Theorem 12).

use secant::case::Case;
use secant::certificate::confirm;
use secant::radius::Options;
use secant::shape::Spaces;
use secant::theorem::smoothness::graph_over_parameter;
use secant::theorem::{Verdict, certify};
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
