//! Masks in several variables.

use super::{all, rule, stored};
use serde_json::{Value, json};

#[test]
fn windows_and_sum_rules() {
    let (_, text) = stored("lattice-biquadratic");
    let certificate: Value = serde_json::from_str(&text).unwrap();
    let mut window = certificate["proof"]["window"].as_array().unwrap().clone();
    window.pop();
    let mut turned = window.clone();
    turned.swap(0, 1);
    all(
        "lattice-biquadratic",
        &[
            ("rules", &[("/rules", json!(0))]),
            ("rules", &[("/rules", json!(4))]),
            ("window", &[("/window", json!(window))]),
            ("window", &[("/window", json!(turned))]),
            ("window", &[("/window", json!([]))]),
            ("format", &[("/window/0/0", json!("1/2"))]),
            ("orders", &[("/orders", json!([]))]),
            ("orders", &[("/orders/1", json!("rough"))]),
            ("orders", &[("/orders/2", json!("smooth"))]),
            ("orders", &[("/orders", json!(["smooth", "smooth", "rough", "rough"]))]),
            ("orders", &[("/orders/0", json!("rules"))]),
        ],
    );
}

/// The mask of linear splines in two variables, on the window of four points: without the overlap the radius would be 1/4, and the
/// limits C¹.
#[test]
fn a_window_that_is_too_small() {
    let case = "name = \"bilinear\"\n[mask]\norigin = [0, 0]\n\
                grid = [[\"1/4\", \"1/2\", \"1/4\"], [\"1/2\", 1, \"1/2\"], [\"1/4\", \"1/2\", \"1/4\"]]\n";
    let radius = json!({
        "lower": null, "upper": "1/4", "bases": [[["1"]]],
        "blocks": [{"dims": [1], "bound": "1/4", "norm": {"norm": "symmetric",
            "points": [{"state": 0, "coordinates": ["1"]}],
            "inclusions": (0..4).map(|a| json!({"point": 0, "arrow": a, "terms": [[0, "1/4"]]})).collect::<Value>(),
            "axes": [{"state": 0, "units": [[[0, "1"]]]}]}}],
    });
    let forged = |window: Value, rules: usize, radius: &Value| {
        let proof =
            json!({"rules": rules, "window": window, "radius": radius, "shifts": null, "orders": ["smooth", "smooth"]});
        let whole = json!({
            "format": "secant certificate", "version": 1, "kind": "lattice", "case": "bilinear", "verdict": "proved",
            "proof": proof,
        });
        secant_check::check(case, &whole.to_string()).unwrap_err()
    };
    let small = forged(json!([["-1", "-1"], ["-1", "0"], ["0", "-1"], ["0", "0"]]), 2, &radius);
    assert_eq!(small.rule, "window", "{small}");
    assert!(small.why.contains("overlap"), "{small}");
}

#[test]
fn shifts_that_are_not_stable() {
    let (case, text) = stored("lattice-biquadratic");
    let words = json!([[]]);
    let leaf = json!([0, 0, 0, 0]);
    all(
        "lattice-biquadratic",
        &[
            ("shifts", &[("/shifts", json!({"stable": "samples", "words": words, "charts": leaf}))]),
            ("shifts", &[("/shifts/charts/3", json!(0))]),
            ("shifts", &[("/shifts/charts", json!([]))]),
            ("shifts", &[("/shifts", json!({"stable": "interpolatory", "at": ["1", "1"]}))]),
            ("shifts", &[("/shifts", json!({"stable": "unimodular"}))]),
            ("format", &[("/shifts", json!({"stable": "trusted"}))]),
            // Without stable shifts nothing is refuted.
            ("orders", &[("/shifts", Value::Null)]),
        ],
    );
    // The Zwart–Powell element in the place of the product: directions that are not unimodular, or of another mask.
    for directions in ["[[1, 0], [0, 1], [1, 1], [1, -1]]", "[[1, 0], [0, 1]]", "[[1, 0], [1, 0], [1, 0]]", "[]"] {
        let case = format!("{case}directions = {directions}\n");
        let mut forged: Value = serde_json::from_str(&text).unwrap();
        forged["proof"]["shifts"] = json!({"stable": "unimodular"});
        assert_eq!(secant_check::check(&case, &forged.to_string()).unwrap_err().rule, "shifts", "{directions}");
    }
}

#[test]
fn the_radius_is_that_of_the_mask() {
    assert_eq!(rule("lattice-quincunx", &[("/radius/upper", json!("1/2"))]), "block");
    let (case, text) = stored("lattice-quincunx");
    let other = case.replace("\"1/4\"", "\"1/8\"").replace("\"1\"", "\"1/2\"");
    assert!(secant_check::check(&other, &text).is_err());
    for dilation in ["[[2, 0], [0, 1]]", "[[1, 1], [0, 2]]", "[[2, 1], [1, 1]]"] {
        let other = case.replace("[[1, 1], [1, -1]]", dilation);
        assert!(other != case && secant_check::check(&other, &text).unwrap_err().unreadable, "{dilation}");
    }
}
