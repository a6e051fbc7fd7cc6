//! Extraordinary vertices.

use super::{rule, stored};
use serde_json::{Value, json};

/// A certificate for another case, whose name is put in.
fn moved(from: &str, to: &str, changes: &[(&str, Value)]) -> String {
    let (case, _) = stored(to);
    let mut forged: Value = serde_json::from_str(&stored(from).1).unwrap();
    forged["case"] = json!(to);
    for (pointer, value) in changes {
        *forged.pointer_mut(pointer).unwrap() = value.clone();
    }
    match secant_check::check(&case, &forged.to_string()) {
        Ok(accepted) => panic!("{from} for {to} is accepted: {accepted:?}"),
        Err(rejected) => rejected.rule,
    }
}

#[test]
fn extraordinary_vertices() {
    // e^(4πi/5), e^(-2πi/5) and 1 are other roots of unity.
    let second = json!([
        "-809016994374947424102293/1000000000000000000000000",
        "293892626146236564584353/500000000000000000000000"
    ]);
    let short = |x: &str, y: &str| json!([x, y]);
    let at = |k: usize, rest: &str| format!("/valences/{k}{rest}");
    let of = |rest: &str| at(1, rest);
    let (rule_of, turn, others, vector) = (of("/rule"), of("/turn"), of("/others"), of("/vector"));
    let (half, frequency, valence) = (of("/half_plane"), of("/frequency"), of("/valence"));
    let first = of("/vector/0");
    let loop_five: &[(&str, &[(&str, Value)])] = &[
        ("vertex", &[(&turn, second)]),
        ("vertex", &[(&turn, short("1", "0"))]),
        ("vertex", &[(&turn, short("-809017/1000000", "146946313/250000000"))]),
        ("vertex", &[(&turn, short("309017/1000000", "-237764129/250000000"))]),
        ("vertex", &[(&turn, short("0", "0"))]),
        ("vertex", &[(&others, json!("0"))]),
        ("vertex", &[(&others, json!("-2/5"))]),
        ("vertex", &[(&others, json!("1/2"))]),
        ("vertex", &[(&others, json!("1/5"))]),
        ("vertex", &[(&vector, json!([["1", "0"], ["1", "0"], ["1", "0"]]))]),
        ("vertex", &[(&vector, json!([["0", "0"], ["0", "0"], ["0", "0"]]))]),
        ("vertex", &[(&vector, json!([]))]),
        ("vertex", &[(&first, short("1", "1"))]),
        ("half-plane", &[(&half, short("0", "0"))]),
        ("half-plane", &[(&half, short("-1", "0"))]),
        ("theorem-7", &[(&half, Value::Null)]),
        ("vertex", &[(&frequency, json!(2))]),
        ("vertex", &[(&frequency, json!(0))]),
        ("vertex", &[(&frequency, json!(3))]),
        ("theorem-8-winding", &[(&rule_of, json!("theorem-8-winding"))]),
        ("theorem-8-fold", &[(&rule_of, json!("theorem-8-fold"))]),
        ("theorem-2", &[(&rule_of, json!("theorem-2")), (&half, Value::Null)]),
        ("theorem-8-path", &[(&rule_of, json!("theorem-8-path")), (&half, Value::Null)]),
        ("format", &[(&rule_of, json!("theorem-9"))]),
        ("vertex", &[(&valence, json!(6))]),
        ("vertex", &[(&valence, json!(4))]),
        ("vertex", &[(&valence, json!(2))]),
        ("format", &[(&valence, json!(1025))]),
        ("vertex", &[("/valences", json!([]))]),
    ];
    for (wanted, changes) in loop_five {
        assert_eq!(rule("vertex-loop", changes), *wanted, "{changes:?}");
    }
    // A valence left out, listed twice, or in another order.
    let (_, text) = stored("vertex-loop");
    let list = serde_json::from_str::<Value>(&text).unwrap()["proof"]["valences"].clone();
    assert_eq!(rule("vertex-loop", &[("/valences", json!([list[0]]))]), "verdict");
    assert_eq!(rule("vertex-loop", &[("/valences", json!([list[0], list[0], list[1]]))]), "vertex");
    assert_eq!(rule("vertex-loop", &[("/valences", json!([list[1], list[0]]))]), "vertex");
    // The other sides of the theorems.
    let own = |rest: &str| at(0, rest);
    let (rule_of, half, frequency) = (own("/rule"), own("/half_plane"), own("/frequency"));
    assert_eq!(rule("vertex-fold", &[(&rule_of, json!("theorem-7")), ("^/verdict", json!("proved"))]), "theorem-7");
    assert_eq!(rule("vertex-frequency", &[(&rule_of, json!("theorem-7"))]), "theorem-7");
    assert_eq!(rule("vertex-frequency", &[(&frequency, json!(1))]), "vertex");
    assert_eq!(rule("vertex-line", &[(&rule_of, json!("theorem-7"))]), "theorem-7");
    assert_eq!(rule("vertex-line", &[(&half, json!(["1", "0"]))]), "half-plane");
    assert_eq!(rule("vertex-path", &[(&rule_of, json!("theorem-2"))]), "theorem-2");
    assert_eq!(rule("vertex-midedge", &[(&rule_of, json!("theorem-8-fold"))]), "theorem-8-fold");
    // A valence that the case does not name refutes nothing.
    let (case, text) = stored("vertex-line");
    let other = case.replace("valence = 4", "valence = 7");
    assert_eq!(secant_check::check(&other, &text).unwrap_err().rule, "verdict");
    let text = text.replace("\"verdict\": \"refuted\"", "\"verdict\": \"undetermined\"");
    assert_eq!(secant_check::check(&other, &text).unwrap().claims.len(), 2);
    // Weights whose sum is not 1 leave the eigenvalue of the constant nets open.
    let (case, text) = stored("vertex-fold");
    let short = case.replace("\"14/15\"", "\"13/15\"");
    assert_eq!(secant_check::check(&short, &text).unwrap_err().rule, "vertex");
    // A name that ends its line.
    let named = case.replace("\"vertex-fold\"", "\"vertex-fold\\nproved: all\"");
    let text = text.replace("\"vertex-fold\"", "\"vertex-fold\\nproved: all\"");
    assert!(secant_check::check(&named, &text).unwrap_err().unreadable);
    // The same net is an eigenvector of Loop's scheme with another weight, in whose block 0 a larger eigenvalue leads.
    let only = |k: usize| [("/proof/valences", json!([list[k]])), ("/verdict", json!("proved"))];
    assert_eq!(moved("vertex-loop", "vertex-line", &only(0)), "vertex");
    for to in ["vertex-catmull-clark", "vertex-midedge", "vertex-frequency", "vertex-fold"] {
        assert_eq!(moved("vertex-loop", to, &only(1)), "vertex", "{to}");
    }
}

/// Rules without patches: other bounds, rings, vectors, half-planes and weights.
#[test]
fn vertices_by_stencils() {
    let (rule_of, turn, others, rings, vector, half, frequency, valence) = (
        "/valences/0/rule",
        "/valences/0/turn",
        "/valences/0/others",
        "/valences/0/rings",
        "/valences/0/vector",
        "/valences/0/half_plane",
        "/valences/0/frequency",
        "/valences/0/valence",
    );
    let limits = |by: &str, steps: usize| json!({"by": by, "steps": steps, "changes": 1});
    let short = |x: &str, y: &str| json!([x, y]);
    let sixth = short("1/2", "136876158426/158050973531");
    let butterfly: &[(&str, &[(&str, Value)])] = &[
        ("limits", &[("/limits", limits("factors", 1))]),
        ("limits", &[("/limits", limits("axes", 6))]),
        ("limits", &[("/limits", limits("words", 2))]),
        ("limit", &[("/limits", limits("words", 7))]),
        ("format", &[("/limits", limits("factors", 0))]),
        ("format", &[("/limits", limits("factors", 8))]),
        ("format", &[("/limits", limits("words", 0))]),
        ("format", &[("/limits", limits("nothing", 4))]),
        ("format", &[("/limits", json!({"by": "factors", "steps": 4, "changes": 3}))]),
        ("format", &[("/limits", json!({"by": "factors", "steps": 4, "changes": 0}))]),
        ("format", &[("/limits", json!({"by": "factors"}))]),
        ("format", &[("/limits", json!([]))]),
        ("vertex", &[("/valences", json!([]))]),
        ("vertex", &[(rings, json!(0))]),
        ("vertex", &[(rings, json!(2))]),
        ("vertex", &[(rings, json!(4))]),
        ("format", &[(rings, json!(9))]),
        ("vertex", &[(vector, json!([]))]),
        ("vertex", &[(vector, json!([["1", "0"], ["1", "0"], ["1", "0"], ["1", "0"], ["1", "0"], ["1", "0"]]))]),
        ("vertex", &[(vector, json!([["1", "0"], ["0", "0"], ["0", "0"], ["0", "0"], ["0", "0"], ["0", "0"]]))]),
        ("vertex", &[(&format!("{vector}/1"), short("1", "1"))]),
        ("vertex", &[(turn, short("1", "0"))]),
        ("vertex", &[(turn, short("0", "1"))]),
        ("vertex", &[(turn, short("309017/1000000", "-237764129/250000000"))]),
        ("vertex", &[(others, json!("0"))]),
        ("vertex", &[(others, json!("-1/3"))]),
        ("vertex", &[(others, json!("1/5"))]),
        ("vertex", &[(others, json!("1/2"))]),
        ("vertex", &[(others, json!("1"))]),
        ("vertex", &[(frequency, json!(0))]),
        ("vertex", &[(frequency, json!(2))]),
        ("vertex", &[(frequency, json!(3))]),
        ("vertex", &[(valence, json!(4))]),
        ("vertex", &[(valence, json!(6))]),
        ("vertex", &[(valence, json!(6)), (turn, sixth)]),
        ("vertex", &[(valence, json!(2))]),
        ("theorem-7", &[(half, Value::Null)]),
        ("half-plane", &[(half, short("0", "0"))]),
        ("half-plane", &[(half, short("-1", "0"))]),
        ("half-plane", &[(half, short("0", "-1"))]),
        ("half-plane", &[(half, short("1000000", "1"))]),
        ("theorem-8-fold", &[(rule_of, json!("theorem-8-fold"))]),
        ("theorem-8-winding", &[(rule_of, json!("theorem-8-winding"))]),
        ("theorem-2", &[(rule_of, json!("theorem-2")), (half, Value::Null)]),
        ("theorem-8-path", &[(rule_of, json!("theorem-8-path")), (half, Value::Null)]),
        ("format", &[(rule_of, json!("lemma-4"))]),
        ("verdict", &[("^/verdict", json!("refuted"))]),
    ];
    for (wanted, changes) in butterfly {
        assert_eq!(rule("vertex-butterfly", changes), *wanted, "{changes:?}");
    }
    assert_eq!(rule("vertex-sqrt3", &[("/limits", limits("factors", 3))]), "limits");
    let wound = [(rule_of, json!("theorem-7")), ("^/verdict", json!("proved"))];
    assert_eq!(rule("vertex-own-winding", &wound), "theorem-7");
    // The same evidence for other rules.
    for (from, to) in [
        ("vertex-butterfly", "vertex-sqrt3"),
        ("vertex-sqrt3", "vertex-butterfly"),
        ("vertex-butterfly", "vertex-own"),
        ("vertex-own", "vertex-butterfly"),
        ("vertex-own", "vertex-own-winding"),
        ("vertex-sqrt3", "vertex-own"),
        ("vertex-four-eight", "vertex-own"),
    ] {
        let refused = moved(from, to, &[]);
        assert!(["limits", "vertex", "verdict"].contains(&refused.as_str()), "{from} for {to}: {refused}");
    }
    // Other weights in the case: a tension, the regular stencils, those of the centre, names and formulas.
    let other = |name: &str, old: &str, new: &str| {
        let (case, text) = stored(name);
        let changed = case.replace(old, new);
        assert_ne!(changed, case, "{old}");
        secant_check::check(&changed, &text).unwrap_err().rule
    };
    for (wanted, old, new) in [
        ("vertex", "valence = 5", "valence = 5\nw = \"1/20\""),
        ("limits", "valence = 5", "valence = 5\nw = 0"),
        ("limits", "valence = 5", "valence = 5\nw = \"1/2\""),
        ("vertex", "butterfly-modified", "butterfly"),
    ] {
        assert_eq!(other("vertex-butterfly", old, new), wanted, "{new}");
    }
    for (wanted, old, new) in [
        ("case", "neighbours = \"1/16\"", "neighbours = \"1/15\""),
        ("case", "sides = \"1/8\"", "sides = \"1/9\""),
        ("case", "sides = ", "wheels = "),
        ("format", "n)/4)/n", "m)/4)/n"),
        ("format", "n)/4)/n", "n)/4/n"),
        ("format", "cos(2*pi*k/n)", "pi*k/n"),
        ("format", "cos(2*pi*k/n)", "cos(2*pi*k/7)"),
        ("format", ")/4)/n", ")/0)/n"),
        ("vertex", "3/4*cos", "3/5*cos"),
        ("case", "neighbours@0\" = \"1/8", "neighbours@1\" = \"1/8"),
        ("case", "3/(8*n)", "4/(8*n)"),
        ("case", "triangles", "turned-triangles"),
        ("limits", "ends = \"3/8\", sides = \"1/8\"", "ends = \"1/2\""),
    ] {
        assert_eq!(other("vertex-own", old, new), wanted, "{new}");
    }
}

/// Leading eigenvalues of several blocks, and with Jordan blocks.
#[test]
fn vertices_with_equal_eigenvalues() {
    let (rule_of, value, others, unit, half, turn, valence) = (
        "/valences/0/rule",
        "/valences/0/value",
        "/valences/0/others",
        "/valences/0/unit",
        "/valences/0/half_plane",
        "/valences/0/turn",
        "/valences/0/valence",
    );
    let changes = |items: &[(&'static str, Value)]| items.to_vec();
    for (name, wanted, items) in [
        // A triple eigenvalue.
        ("vertex-span", "vertex", changes(&[(value, json!("1/5"))])),
        ("vertex-span", "vertex", changes(&[(value, json!("0"))])),
        ("vertex-span", "vertex", changes(&[(value, json!("1"))])),
        ("vertex-span", "vertex", changes(&[(value, json!("-1/4"))])),
        ("vertex-span", "vertex", changes(&[(value, json!("1/8"))])),
        ("vertex-span", "vertex", changes(&[(value, json!("1/8")), (others, json!("1/9"))])),
        ("vertex-span", "vertex", changes(&[(others, json!("0"))])),
        ("vertex-span", "vertex", changes(&[(others, json!("-1/5"))])),
        ("vertex-span", "vertex", changes(&[(others, json!("1/100"))])),
        ("vertex-span", "vertex", changes(&[(others, json!("1/4"))])),
        ("vertex-span", "vertex", changes(&[(others, json!("1/2"))])),
        ("vertex-span", "theorem-8-span", changes(&[(unit, json!(0))])),
        ("vertex-span", "theorem-8-span", changes(&[(half, json!(["1", "0"]))])),
        ("vertex-span", "vertex", changes(&[(rule_of, json!("theorem-7")), ("^/verdict", json!("proved"))])),
        ("vertex-span", "vertex", changes(&[(rule_of, json!("theorem-2"))])),
        ("vertex-span", "vertex", changes(&[(valence, json!(4))])),
        ("vertex-span", "vertex", changes(&[(turn, json!(["1", "0"]))])),
        // A pair of Jordan blocks of length 2, beside simple ones.
        ("vertex-chains", "theorem-8-span", changes(&[(rule_of, json!("theorem-8-span")), (unit, Value::Null)])),
        ("vertex-chains", "theorem-7", changes(&[(half, Value::Null)])),
        ("vertex-chains", "half-plane", changes(&[(half, json!(["-1", "0"]))])),
        ("vertex-chains", "half-plane", changes(&[(half, json!(["0", "1"]))])),
        ("vertex-chains", "format", changes(&[(unit, json!(4))])),
        ("vertex-chains", "vertex", changes(&[(value, json!("1/3"))])),
        ("vertex-chains", "vertex", changes(&[(others, json!("1/4"))])),
        ("vertex-chains", "theorem-8-winding", changes(&[(rule_of, json!("theorem-8-winding"))])),
        ("vertex-chains", "theorem-8-fold", changes(&[(rule_of, json!("theorem-8-fold"))])),
        ("vertex-chains", "theorem-2", changes(&[(rule_of, json!("theorem-2"))])),
        ("vertex-chains", "vertex", changes(&[(valence, json!(4))])),
        // One block of length 3.
        ("vertex-chain", "theorem-7", changes(&[(rule_of, json!("theorem-7"))])),
        ("vertex-chain", "theorem-8-span", changes(&[(rule_of, json!("theorem-8-span"))])),
        ("vertex-chain", "half-plane", changes(&[(half, json!(["1", "0"]))])),
        ("vertex-chain", "vertex", changes(&[(value, json!("1/8"))])),
        ("vertex-chain", "verdict", changes(&[("^/verdict", json!("proved"))])),
    ] {
        assert_eq!(rule(name, &items), wanted, "{name} {items:?}");
    }
}
