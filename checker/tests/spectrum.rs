//! Certificates of spectra: a matrix with a Jordan block, a pair of the same modulus, and a smaller eigenvalue.

use serde_json::{Value, json};

const MATRIX: &str = "5 # size\n1 1 0 0 0\n0 1 0 0 0\n0 0 0 -1 0\n0 0 1 0 0\n0 0 0 0 1/2\n";

fn certificate() -> Value {
    let disc = |x: &str, y: &str| json!({"centre": [x, y], "error": "0"});
    let unit = |k: usize| -> Value { (0..5).map(|i| if i == k { json!(["1"]) } else { json!([]) }).collect() };
    let factors = json!([
        {"polynomial": ["-1", "1"], "roots": [disc("1", "0")], "chains": [[unit(0), unit(1)]]},
        {"polynomial": ["-1/2", "1"], "roots": [disc("1/2", "0")], "chains": [[unit(4)]]},
        {"polynomial": ["1", "0", "1"], "roots": [disc("0", "1")], "chains": [[[[], [], ["1"], ["0", "-1"], []]]]},
    ]);
    let classes = json!([
        {"members": [0, 2], "square": "1", "below": "3/4"},
        {"members": [1], "square": null, "below": null},
    ]);
    let item = json!({"operator": null, "factors": factors, "modulus": 1_000_000_007, "classes": classes});
    json!({"format": "secant certificate", "version": 1, "kind": "spectrum", "case": "matrix", "verdict": "proved",
        "proof": {"spectra": [item]}})
}

/// The rule that rejects the certificate after a value of its item was replaced.
fn rejected(pointer: &str, new: Value) -> String {
    let mut forged = certificate();
    *forged.pointer_mut(&format!("/proof/spectra/0{pointer}")).unwrap() = new;
    secant_check::check(MATRIX, &forged.to_string()).expect_err(pointer).rule
}

#[test]
fn a_spectrum_is_accepted() {
    let accepted = secant_check::check(MATRIX, &certificate().to_string()).unwrap();
    assert_eq!(accepted.claims.len(), 4);
    assert!(accepted.claims[0].to_string().ends_with("has Jordan blocks of the sizes 2"), "{:?}", accepted.claims);
    assert!(accepted.claims[3].to_string().ends_with("3, 1"), "{:?}", accepted.claims);
}

#[test]
fn forged_spectra_are_rejected() {
    let other = MATRIX.replace("1/2", "1/3");
    assert_eq!(secant_check::check(&other, &certificate().to_string()).unwrap_err().rule, "chains");
    // A block torn apart, a chain twice, a chain left out, a chain exchanged.
    let unit = |k: usize| -> Value { (0..5).map(|i| if i == k { json!(["1"]) } else { json!([]) }).collect() };
    assert_eq!(rejected("/factors/0/chains", json!([[unit(0)], [unit(1)]])), "chains");
    assert_eq!(rejected("/factors/0/chains", json!([[unit(0)], [unit(0)]])), "chains");
    assert_eq!(rejected("/factors/0/chains", json!([[unit(0)]])), "chains");
    assert_eq!(rejected("/factors/0/chains", json!([[unit(1), unit(0)]])), "chains");
    // Vectors that are 0, moduli that prove nothing.
    assert_eq!(rejected("/factors/1/chains", json!([[[[], [], [], [], []]]])), "chains");
    assert_eq!(rejected("/modulus", json!(1)), "chains");
    assert_eq!(rejected("/modulus", json!(0)), "chains");
    // Roots in the wrong place, twice, too few, on the wrong side.
    assert_eq!(rejected("/factors/1/roots/0/centre", json!(["1/3", "0"])), "roots");
    assert_eq!(rejected("/factors/0/roots/0/error", json!("3/4")), "roots");
    assert_eq!(rejected("/factors/2/roots/0/centre", json!(["0", "-1"])), "roots");
    assert_eq!(rejected("/factors/2/roots", json!([])), "roots");
    assert_eq!(rejected("/factors/0/polynomial", json!(["-1", "2"])), "field");
    // Classes in the wrong order, torn apart, joined, with the wrong square or the wrong radius.
    assert_eq!(rejected("/classes/0/below", json!("1/4")), "moduli");
    assert_eq!(rejected("/classes/0/below", json!("-3/4")), "moduli");
    assert_eq!(rejected("/classes/0/square", Value::Null), "moduli");
    assert_eq!(rejected("/classes/0/square", json!("2")), "moduli");
    assert_eq!(rejected("/classes/0/members", json!([0])), "moduli");
    assert_eq!(rejected("/classes/0/members", json!([0, 0, 2])), "moduli");
    let joined = json!([{"members": [0, 1, 2], "square": "1", "below": null}]);
    assert_eq!(rejected("/classes", joined), "moduli");
    assert_eq!(rejected("/operator", json!({"state": 0, "piece": 0})), "case");
}
