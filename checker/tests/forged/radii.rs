//! Joint spectral radii and orders of smoothness.

use super::{all, rule, stored};
use secant_check::{Claim, Verdict};
use serde_json::{Value, json};

const BLOCK: &str = "/blocks/0/norm";

fn of_block(rest: &str) -> String {
    format!("{BLOCK}{rest}")
}

#[test]
fn codes_of_words_for_a_joint_spectral_radius() {
    let words = |w: Value| (format!("{BLOCK}/codes/0/words"), w);
    let code = |w: Value, bound: &str| {
        let (pointer, w) = words(w);
        rule("jsr-tree", &[(&pointer, w), ("/blocks/0/bound", json!(bound)), ("/upper", json!(bound))])
    };
    // The empty word has norm 1 = bound^0 whatever the matrices are.
    assert_eq!(code(json!([[]]), "0"), "tree");
    assert_eq!(code(json!([[], [0], [1]]), "7/10"), "tree");
    assert_eq!(code(json!([[0], [1]]), "7/10"), "tree");
    assert_eq!(code(json!([[0]]), "3/4"), "tree");
    assert_eq!(code(json!([[0], [1], [1]]), "3/4"), "tree");
    assert_eq!(code(json!([[0], [1], [1, 0]]), "3/4"), "tree");
    assert_eq!(code(json!([]), "3/4"), "tree");
    assert_eq!(code(json!([vec![0; 100_000]]), "3/4"), "tree");
    let weights = of_block("/codes/0/weights");
    let norm = "/blocks/0/norm";
    let forgeries: &[(&str, &[(&str, Value)])] = &[
        ("tree", &[(&weights, json!(["1", "0"]))]),
        ("tree", &[(&weights, json!(["-1", "1"]))]),
        ("tree", &[("/blocks/0/bound", json!("2/3")), ("/upper", json!("2/3"))]),
        ("block", &[("/upper", json!("2/3"))]),
        ("block", &[("/blocks/0/bound", json!("-7/10"))]),
        ("zero", &[(norm, json!({"norm": "zero"}))]),
        ("block", &[("/blocks", json!([]))]),
        ("block", &[("/blocks/0/dims", json!([1]))]),
        ("block", &[("/bases/0", json!([["1", "0"], ["2", "0"]]))]),
    ];
    all("jsr-tree", forgeries);
}

#[test]
fn norms_for_a_joint_spectral_radius() {
    let (inclusions, axes, points) = (of_block("/inclusions"), of_block("/axes"), of_block("/points"));
    let one = json!([{"state": 0, "coordinates": ["1", "1"]}]);
    all(
        "jsr-symmetric",
        &[
            ("inclusion", &[(&inclusions, json!([]))]),
            ("interior", &[(&axes, json!([]))]),
            ("interior", &[(&of_block("/axes/0/units"), json!([[], []]))]),
            ("format", &[(&points, one)]),
            ("monotone", &[(&of_block("/norm"), json!("monotone"))]),
            ("format", &[(&of_block("/norm"), json!("quadratic"))]),
            ("word", &[("/lower/error", json!("-1"))]),
            ("word", &[("/lower/error", json!("0"))]),
            ("word", &[("/lower/bound", json!("2"))]),
            ("word", &[("/lower/word", json!([]))]),
            ("word", &[("/lower/word", json!([1]))]),
        ],
    );
    // Images out of other points, and a bound below the modulus of a complex coefficient.
    let low = json!("1");
    all(
        "jsr-balanced",
        &[
            ("inclusion", &[("/upper", low.clone()), ("/blocks/0/bound", low)]),
            ("inclusion", &[(&of_block("/inclusions/0/terms"), json!([[1, "0", "1"]]))]),
            ("inclusion", &[(&of_block("/inclusions/1/point"), json!(0))]),
            ("interior", &[(&of_block("/axes/0/units/0"), json!([[0, "1", "0"]]))]),
        ],
    );
    let form = of_block("/forms/0/form");
    all(
        "jsr-quadratic",
        &[
            ("gram", &[(&form, json!([["1", "2"], ["2", "1"]]))]),
            ("gram", &[(&form, json!([["1", "1/2"], ["1/4", "1"]]))]),
            ("quadratic", &[(&form, json!([["1", "0"], ["0", "1"]]))]),
            ("quadratic", &[(&of_block("/square"), json!("1"))]),
            ("quadratic", &[(&of_block("/square"), json!("4"))]),
            ("quadratic", &[(&of_block("/forms"), json!([]))]),
        ],
    );
    all(
        "jsr-triangular",
        &[
            ("block", &[("/bases/0", json!([["0", "1"], ["1", "0"]]))]),
            ("inclusion", &[("/blocks/1/norm/inclusions", json!([]))]),
            ("monotone", &[("/blocks/0/norm/points/0/coordinates", json!(["0"]))]),
            ("monotone", &[("/blocks/0/norm/points/0/coordinates", json!(["-1"]))]),
            ("inclusion", &[("/blocks/0/norm/inclusions/0/terms", json!([[0, "1/4"]]))]),
        ],
    );
    all(
        "jsr-automaton",
        &[
            ("word", &[("/lower/word", json!([0, 2]))]),
            ("word", &[("/lower/word", json!([1]))]),
            ("format", &[("/lower/word", json!([3]))]),
            ("inclusion", &[(&of_block("/inclusions/0/arrow"), json!(1))]),
        ],
    );
}

#[test]
fn orders_of_smoothness() {
    let order = |k: usize| -> Value {
        let (_, text) = stored("regularity-spline");
        let whole: Value = serde_json::from_str(&text).unwrap();
        whole.pointer(&format!("/proof/orders/{k}")).unwrap().clone()
    };
    let radius = "/orders/1/radius";
    let (upper, bound) = (format!("{radius}/upper"), format!("{radius}/blocks/0/bound"));
    let terms = |arrow: usize| format!("{radius}/blocks/0/norm/inclusions/{arrow}/terms/0/1");
    let (first, second) = (terms(0), terms(1));
    // The curve is not C¹, although the radius is below 1/2.
    all(
        "regularity-takagi-third",
        &[
            ("orders", &[("/orders/1/outcome", json!("holds"))]),
            ("orders", &[("/orders/1/outcome", json!("curve"))]),
            ("orders", &[("/orders/1/outcome", json!("none"))]),
            ("orders", &[("/orders/1/outcome", json!("cycle"))]),
            ("orders", &[("/orders/1/outcome", json!("chord"))]),
            ("orders", &[("/orders/0/outcome", json!("holds"))]),
            ("orders", &[("/orders/0/outcome", json!("cycle"))]),
            ("orders", &[("/orders/1/order", json!(2))]),
            ("orders", &[("/orders/1/dims", json!([0])), (radius, Value::Null)]),
            ("orders", &[("/orders/1/dims", json!([2]))]),
            ("orders", &[(radius, Value::Null)]),
            ("orders", &[("/orders", json!([]))]),
            // A bound that is true, but not below 1/2.
            ("orders", &[(&upper, json!("1/2"))]),
            ("block", &[(&upper, json!("1/4"))]),
            ("inclusion", &[(&bound, json!("1/4")), (&first, json!("1/4")), (&second, json!("1/4"))]),
            ("block", &[("/orders/1/radius/bases", json!([[["0"]]]))]),
            ("word", &[("/orders/1/radius/lower/bound", json!("1/2"))]),
            ("contraction", &[("/contraction/0/radius", json!("1/8"))]),
        ],
    );
    let second = order(2);
    let orders = |list: Vec<Value>| ("/orders", json!(list));
    all(
        "regularity-spline",
        &[
            ("orders", &[orders(vec![order(0), second.clone()])]),
            ("orders", &[orders(vec![order(1), second.clone()])]),
            ("orders", &[orders(vec![order(0), order(1), second.clone(), second])]),
            ("orders", &[("/orders/2/outcome", json!("joint"))]),
        ],
    );
    // A chord among the differences says something only where no arrow leaves: the square of the parameter is smooth.
    all(
        "regularity-transient-square",
        &[
            ("orders", &[("/orders/1/outcome", json!("chord"))]),
            ("orders", &[("/orders/1/outcome", json!("joint"))]),
            ("orders", &[("/orders/1/outcome", json!("cycle"))]),
            ("orders", &[("/orders/2/outcome", json!("chord"))]),
        ],
    );
    // Cycles with the modulus 1/2 and more, and a bound that claims too much of one.
    let lower = "/orders/1/radius/lower/bound";
    all(
        "regularity-cycle",
        &[
            ("orders", &[("/orders/1/outcome", json!("holds"))]),
            ("orders", &[("/orders/1/outcome", json!("joint"))]),
            ("orders", &[(lower, json!("1/4"))]),
            ("word", &[(lower, json!("99/100"))]),
            ("orders", &[("/orders/1/radius/lower", Value::Null)]),
        ],
    );
    all("regularity-chord", &[("orders", &[("/orders/1/outcome", json!("holds"))])]);
    // A piece that runs backwards, and a curve with corners, under the same proof.
    let (case, text) = stored("regularity-takagi-third");
    let other = case.replace("[\"-1/2\", \"1/3\"]", "[\"-1/2\", \"-1/3\"]");
    assert!(secant_check::check(&other, &text).is_err() && other != case);
}

/// Orders of smoothness are those of the curve that is seen: these two are straight lines, although the curves in the spaces of
/// their states have different slopes at a joint.
#[test]
fn orders_of_a_curve_that_is_seen_as_a_line() {
    for name in ["regularity-seen-as-a-line", "regularity-killed-jump"] {
        let (case, text) = stored(name);
        let accepted = secant_check::check(&case, &text).unwrap();
        assert!(accepted.claims.contains(&Claim::Polynomial.is(Verdict::Proved)), "{accepted:?}");
        assert!(!accepted.claims.iter().any(|c| c.verdict == Verdict::Refuted), "{accepted:?}");
        // The proof for the curve of the other state, whose slopes differ.
        let (_, jump) = stored("regularity-takagi-third");
        let (jump, own): (Value, Value) = (serde_json::from_str(&jump).unwrap(), serde_json::from_str(&text).unwrap());
        let mut forged = own.clone();
        forged["proof"]["orders"] = jump["proof"]["orders"].clone();
        assert_eq!(secant_check::check(&case, &forged.to_string()).unwrap_err().rule, "orders", "{name}");
        for outcome in ["joint", "cycle", "chord"] {
            let mut forged = own.clone();
            forged["proof"]["orders"][1]["outcome"] = json!(outcome);
            assert_eq!(secant_check::check(&case, &forged.to_string()).unwrap_err().rule, "orders", "{outcome}");
        }
    }
}
