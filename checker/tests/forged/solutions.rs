//! Unknown entries.

use super::{all, stored};
use serde_json::{Value, json};

#[test]
fn solutions_of_unknown_entries() {
    let zeros = |n: usize| json!(vec!["0"; n]);
    all(
        "solve-junction-4",
        &[
            ("solve", &[("/values/0", json!("1"))]),
            ("solve", &[("/values", zeros(32))]),
            ("format", &[("/values", zeros(31))]),
            ("format", &[("/values", Value::Null)]),
            ("solve", &[("/solutions", json!("family"))]),
            ("solve", &[("/solutions", json!("family")), ("/directions", json!([zeros(32)]))]),
            ("solve", &[("/solutions", json!("none")), ("/values", Value::Null), ("^/verdict", json!("refuted"))]),
            ("solve", &[("/solutions", json!("none")), ("/values", Value::Null), ("/conflict", json!([0, 1]))]),
            ("format", &[("/solutions", json!("many"))]),
        ],
    );
    let text = stored("solve-junction-5").1;
    let original: Value = serde_json::from_str(&text).unwrap();
    let directions = &original["proof"]["directions"];
    all(
        "solve-junction-5",
        &[
            // A family with a parameter too few, too many, twice the same, and said to be one solution.
            ("solve", &[("/directions", json!([directions[0], directions[1], directions[2]]))]),
            ("solve", &[("/directions/3", directions[0].clone())]),
            ("solve", &[("/directions/0/0", json!("7"))]),
            ("solve", &[("/directions", json!([])), ("/solutions", json!("one"))]),
        ],
    );
    all(
        "solve-junction-contradiction",
        &[
            ("solve", &[("/conflict", json!([]))]),
            ("solve", &[("/conflict", json!([1]))]),
            ("solve", &[("/conflict", json!([0, 1]))]),
            ("solve", &[("/conflict", json!([0, 0]))]),
            ("format", &[("/conflict", json!([99]))]),
            ("solve", &[("/conflict", json!([])), ("/solutions", json!("one")), ("/values", zeros(16))]),
            ("verdict", &[("^/verdict", json!("proved"))]),
        ],
    );
    // Another case: an entry that is given now, one that is no longer, and identities that are not read.
    let (case, text) = stored("solve-junction-4");
    for (from, to) in [
        ("matrix = \"?\"", "matrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"),
        ("\"3/4\"", "\"?\""),
        ("points = [1, 2, 3]", "points = [1, 3, 2]"),
    ] {
        let changed = case.replacen(from, to, 1);
        assert_ne!(changed, case);
        assert!(secant_check::check(&changed, &text).is_err(), "{to}");
    }
    let face = case.replacen("name = \"I\"", "name = \"I\"\nlayout = \"2x2\"", 1);
    assert_eq!(secant_check::check(&face, &text).unwrap_err().rule, "case");
}

/// An operator of a side of a face is open, whatever keys the face lacks: its identities are not read.
#[test]
fn unknown_entries_of_sides() {
    let pieces = "[[state.piece]]\nto = \"e\"\nmatrix = [[1, \"?\"], [0, \"1/2\"]]\n";
    let head = "name = \"sides\"\nconvention = \"columns\"\nstart = \"e\"\n[[state]]\nname = \"e\"\n";
    let text = r#"{"format":"secant certificate","version":1,"kind":"solve","case":"sides","verdict":"proved",
        "proof":{"solutions":"one","values":["1/2"],"directions":[],"conflict":[]}}"#;
    secant_check::check(&format!("{head}{pieces}"), text).unwrap();
    let piece = "[[state.piece]]\nto = \"f\"\nmatrix = [[1, \"1/2\"], [0, \"1/2\"]]\n";
    for state in [
        "kind = \"face\"\nbottom = { edge = \"e\", matrix = \"?\" }",
        "kind = \"set\"\nleft = { edge = \"e\", matrix = \"?\" }",
        "top = { edge = \"e\", matrix = \"?\" }",
    ] {
        let case = format!("{head}{pieces}[[state]]\nname = \"f\"\n{state}\n{piece}");
        assert!(secant_check::check(&case, text).unwrap_err().unreadable, "{state}");
    }
}
