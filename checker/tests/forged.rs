//! Certificates changed by hand to prove false statements, and texts that look like numbers: each is refused, by the rule that
//! should find it.

use serde_json::{Value, json};
use std::path::Path;

fn stored(name: &str) -> (String, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs/pass");
    let read = |end: &str| std::fs::read_to_string(root.join(format!("{name}.{end}"))).unwrap();
    (read("toml"), read("json"))
}

/// The rule that refuses a stored certificate after some of its values, named by pointers below `proof`, were replaced.
fn rule(name: &str, changes: &[(&str, Value)]) -> String {
    let (case, text) = stored(name);
    let mut forged: Value = serde_json::from_str(&text).unwrap();
    for (pointer, value) in changes {
        let pointer = pointer.strip_prefix('^').map_or_else(|| format!("/proof{pointer}"), str::to_owned);
        *forged.pointer_mut(&pointer).unwrap_or_else(|| panic!("{name}: {pointer}")) = value.clone();
    }
    match secant_check::check(&case, &forged.to_string()) {
        Ok(accepted) => panic!("{name} with {changes:?} is accepted: {accepted:?}"),
        Err(rejected) => rejected.rule,
    }
}

fn all(name: &str, forgeries: &[(&str, &[(&str, Value)])]) {
    let (case, text) = stored(name);
    secant_check::check(&case, &text).unwrap_or_else(|r| panic!("{name}: {r}"));
    let mut others = Vec::new();
    for (wanted, changes) in forgeries {
        let found = rule(name, changes);
        if found != *wanted {
            others.push(format!("{found} instead of {wanted}: {changes:.300?}"));
        }
    }
    assert!(others.is_empty(), "{name}:\n{}", others.join("\n"));
}

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
fn cones_without_a_part_of_their_four_parts() {
    let every = "/answers/2";
    let of = |rest: &str| format!("{every}{rest}");
    let (functional, chord, rays) = (of("/cones/0/functional"), of("/cones/0/chord"), of("/cones/0/rays"));
    let (maps, view, slow, window) = (of("/maps"), of("/view"), of("/slow"), of("/window"));
    let (joints, witness, verdict) = (of("/joints"), of("/witness"), of("/verdict"));
    let opposite = json!([["-1", "1", "0"], ["1", "-1", "0"]]);
    let negated = json!([["-1"], []]);
    let regular = json!([{"state": 0, "listed": 0}]);
    all(
        "every-boundary",
        &[
            ("cone", &[(&functional, json!(["0", "0", "0"]))]),
            ("cone", &[(&functional, json!(["1", "0", "-1"]))]),
            ("cone", &[(&rays, opposite)]),
            ("cone", &[(&rays, json!([["-1", "1", "0"], ["-2", "2", "0"]]))]),
            ("cone", &[(&rays, json!([["1", "0", "0"], ["0", "1", "0"]]))]),
            ("cone", &[(&chord, json!(["0", "0"]))]),
            ("cone", &[(&chord, json!(["4/3", "-1/3"]))]),
            ("every-point", &[(&of("/cones"), json!([])), (&maps, json!([]))]),
            ("cone", &[(&of("/maps/0/0"), json!([["2/5", "2/5"], ["0", "2/5"]]))]),
            ("cone", &[(&of("/maps/0/0"), json!([["0", "2/5"], ["0", "1/5"]]))]),
            ("format", &[(&maps, json!([[]]))]),
            ("cone", &[(&view, json!(["0", "0", "0"]))]),
            ("answers", &[(&view, Value::Null)]),
            ("slow", &[(&window, json!(0))]),
            ("slow", &[(&slow, json!([]))]),
            ("slow", &[(&of("/slow/0/word"), json!([1]))]),
            ("slow", &[(&of("/slow/1/functional"), negated), (&of("/slow/1/word"), json!([0]))]),
            ("leading", &[(&of("/slow/0/functional"), json!([[], []]))]),
            ("slow", &[(&of("/slow/0/functional"), json!([["3"], ["2"]]))]),
            ("top-real", &[(&of("/slow/1/top/chains/0/vectors"), json!([[[], ["1"]]]))]),
            ("answers", &[(&joints, json!([]))]),
            ("every-point", &[(&joints, regular)]),
            ("every-point", &[(&witness, json!([2])), (&verdict, json!("refuted"))]),
            ("rate", &[(&of("/rate"), json!({"length": 1, "cross_ratio": "100"}))]),
            ("rate", &[(&of("/rate"), json!({"length": 0, "cross_ratio": "100"}))]),
        ],
    );
    let corner = json!([{"state": 0, "listed": 2}]);
    all(
        "every-corner",
        &[
            ("every-point", &[(&joints, corner), (&witness, json!([])), (&verdict, json!("proved"))]),
            ("answers", &[(&witness, json!([])), (&verdict, json!("proved"))]),
            ("every-point", &[(&witness, json!([0]))]),
            ("rate", &[(&of("/rate/cross_ratio"), json!("1"))]),
            ("rate", &[(&of("/rate/cross_ratio"), json!("1/2"))]),
        ],
    );
    all(
        "every-three-states",
        &[
            ("every-point", &[(&of("/joints/1"), json!({"state": 0, "listed": 2}))]),
            ("every-point", &[(&of("/joints/1/state"), json!(2))]),
            ("contraction", &[("/contraction/2", json!({"state": 1, "radius": "9", "code": ["."], "hull": null}))]),
            ("joints", &[("/answers/1/points", json!([2]))]),
        ],
    );
}

#[test]
fn spectra_with_a_root_too_few() {
    let item = |rest: &str| format!("/spectra/0{rest}");
    let (classes, roots) = (item("/classes"), item("/factors/1/roots"));
    let one = |members: Value| json!([{"members": members, "square": null, "below": null}]);
    all(
        "spectrum-opposite-pair",
        &[
            ("moduli", &[(&item("/classes/1/members"), json!([1]))]),
            ("moduli", &[(&classes, one(json!([0, 1, 2])))]),
            ("moduli", &[(&item("/classes/0/below"), json!("1/4"))]),
            ("moduli", &[(&item("/classes/1/square"), json!("1/2"))]),
            ("moduli", &[(&item("/classes/1/members"), json!([1, 2, 2]))]),
            ("format", &[(&item("/classes/1/members"), json!([1, 2, 3]))]),
            ("roots", &[(&roots, json!([]))]),
            ("roots", &[(&roots, json!([{"centre": ["-1/2", "0"], "error": "0"}]))]),
            ("roots", &[(&roots, json!([{"centre": ["1/2", "0"], "error": "1"}]))]),
            ("roots", &[(&item("/factors/1/polynomial"), json!(["1/4", "-1", "1"]))]),
            ("chains", &[(&item("/factors/1/chains/0/0"), json!([[], [], []]))]),
            ("chains", &[(&item("/factors/1/chains"), json!([]))]),
            ("chains", &[(&item("/modulus"), json!(1))]),
            ("format", &[(&item("/modulus"), json!(2_147_483_648_u64))]),
            ("spectrum", &[(&item("/operator/piece"), json!(1))]),
            ("spectrum", &[("/spectra", json!([]))]),
        ],
    );
    let eigenvector = stored("spectrum-jordan-3").1.parse::<Value>().unwrap();
    let eigenvector = eigenvector.pointer("/proof/spectra/0/factors/1/chains/0/0").unwrap();
    let thrice = json!([[eigenvector], [eigenvector], [eigenvector]]);
    assert_eq!(rule("spectrum-jordan-3", &[(&item("/factors/1/chains"), thrice)]), "chains");
    assert_eq!(rule("spectrum-jordan-3", &[(&item("/factors/1/chains"), json!([[eigenvector]]))]), "chains");
    // A pair of modulus 1 together with 1, said to be of modulus 2 or not said to be equal at all.
    all(
        "spectrum-plain",
        &[
            ("moduli", &[(&item("/classes/0/square"), json!("2"))]),
            ("moduli", &[(&item("/classes/0/square"), Value::Null)]),
            ("moduli", &[(&item("/classes/0/square"), json!("-1"))]),
        ],
    );
}

#[test]
fn points_answers_and_contraction() {
    all(
        "trisection",
        &[
            ("line", &[("/points/0/common", json!(["1", "0", "-1"]))]),
            ("line", &[("/points/2/common", json!(["1", "-1", "0"]))]),
            ("format", &[("/points/0/common", json!(["1", "-1"]))]),
            ("point", &[("/points/2/kind", json!("cusp"))]),
            ("line", &[("/points/2/place/path", json!([0]))]),
            ("joints", &[("/answers/1/points", json!([]))]),
            ("joint", &[("/points/2/place/right", json!(2))]),
            ("contraction", &[("/contraction/0/code", json!(["."]))]),
            ("contraction", &[("/contraction", json!([]))]),
            ("contraction", &[("/contraction/0/code", json!(".")), ("/contraction/0/radius", json!("1000"))]),
            ("contraction", &[("/contraction/0/radius", json!("1"))]),
            ("cover", &[("/points/0/branches/0/cover/0/cells", json!([["-0", "-0"], []]))]),
            ("cover", &[("/points/0/branches/0/cover/0/cells", json!([["-0", "-0"], "-0", "-0"]))]),
            ("format", &[("/points/0/branches/0/rule", json!("theorem-7"))]),
            ("answers", &[("/answers/0/points", json!([0, 2]))]),
            ("answers", &[("/answers/0/points", json!([1, 0]))]),
            (
                "points",
                &[
                    ("/answers/0/points", json!([0])),
                    ("/answers/0/verdict", json!("undetermined")),
                    ("^/verdict", json!("undetermined")),
                ],
            ),
        ],
    );
}

#[test]
fn a_pair_with_a_block_and_a_line_over_two_fields() {
    let top = |rest: &str| format!("/points/0/branches/0/top{rest}");
    let (case, text) = stored("complex-block");
    let original: Value = serde_json::from_str(&text).unwrap();
    let vectors = original.pointer(&format!("/proof{}", top("/vectors"))).unwrap();
    assert!(secant_check::check(&case, &text).is_ok());
    let zero = json!([[[], [], [], []], [[], [], [], []]]);
    all(
        "complex-block",
        &[
            ("top-pair", &[(&top("/vectors"), json!([vectors[0]]))]),
            ("top-pair", &[(&top("/vectors"), json!([vectors[1], vectors[0]]))]),
            ("top-pair", &[(&top("/vectors"), json!([vectors[0], vectors[1], vectors[1]]))]),
            ("top-pair", &[(&top("/vectors"), json!([]))]),
            ("top-pair", &[(&top("/vectors"), zero)]),
            ("top-pair", &[(&top("/centre"), json!(["0", "-1/4"]))]),
            ("top-pair", &[(&top("/centre"), json!(["1/4", "1/4"]))]),
            ("top-pair", &[(&top("/centre"), json!(["1/4", "0"]))]),
            ("top-pair", &[(&top("/polynomial"), json!(["1/4", "0", "1"]))]),
            ("field", &[(&top("/polynomial"), json!(["1/16", "0", "2"]))]),
            ("top-pair", &[(&top("/error"), json!("1/4"))]),
        ],
    );
    let of = |rest: &str| format!("/points/2/common/1{rest}");
    let common = "/points/2/common";
    let text = stored("same-line-two-polynomials").1;
    let number: Value =
        serde_json::from_str::<Value>(&text).unwrap().pointer(&format!("/proof{}", of(""))).unwrap().clone();
    let swapped = json!([number["elements"][1], number["elements"][0]]);
    let minus = json!([
        number["interval"][1].as_str().map(|x| format!("-{x}")),
        number["interval"][0].as_str().map(|x| format!("-{x}"))
    ]);
    all(
        "same-line-two-polynomials",
        &[
            ("line", &[(&of("/elements"), swapped)]),
            ("line", &[(&of("/elements/0"), json!([]))]),
            ("format", &[(&of("/elements"), json!([number["elements"][0]]))]),
            // The conjugate of the number, and an interval that holds both.
            ("line", &[(&of("/interval"), minus)]),
            ("field", &[(&of("/interval"), json!(["-1", "1"]))]),
            ("field", &[(&of("/interval"), json!(["0", "1/2"]))]),
            ("field", &[(&of("/polynomial"), json!(["-1", "0", "2"]))]),
            ("line", &[(common, Value::Null)]),
            ("line", &[(common, json!(["1", "70710678/100000001"]))]),
            ("format", &[(common, json!([number]))]),
            ("format", &[(common, json!(["1", number]))]),
        ],
    );
}

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

/// An address through a piece that is a point lies between the two neighbours of that piece: it is no end of the curve.
#[test]
fn an_address_through_a_point_is_not_an_end() {
    let case = "name = \"mid\"\n\
        [[map]]\nlinear = [[\"1/2\", 0], [\"1/2\", \"1/2\"]]\nshift = [0, 0]\n\
        [[map]]\nlinear = [[0, 0], [0, 0]]\nshift = [\"1/2\", \"1/2\"]\n\
        [[map]]\nlinear = [[\"1/2\", 0], [\"-1/2\", \"1/2\"]]\nshift = [\"1/2\", \"1/2\"]\n\
        [[examine]]\naddress = \"1(0)\"\n";
    let end = json!({"place": {"at": "left end"}, "verdict": "proved", "kind": "half-tangent", "rule": "line",
        "common": ["0", "-1"], "branches": [{"rule": "theorem-3",
        "top": {"top": "real", "radius": "1/4", "polynomial": ["-1/2", "1"], "interval": ["1/2", "1/2"],
            "chains": [{"sign": "+", "vectors": [[["1"], []], [[], ["-2"]]]}]},
        "functional": [[], ["1"]],
        "cover": [{"piece": [1], "cells": "+0"}, {"piece": [2], "cells": [["+0", "+0", "+0"], "+0", "+0"]}]}]});
    let code = json!([[[".", ".", "."], ".", "."], ".", [".", ".", [".", ".", "."]]]);
    let certificate = |verdict: &str, of: Value| {
        json!({"format": "secant certificate", "version": 1, "kind": "certify", "case": "mid", "verdict": "undetermined",
            "proof": {"contraction": [{"state": 0, "radius": "5", "code": code, "hull": null}], "points": [end],
            "answers": [{"question": "ends", "verdict": "undetermined", "points": [0]},
                {"question": "joints", "verdict": "undetermined", "theorem": "none", "points": [], "upstairs": []},
                {"question": "address", "address": {"prefix": [1], "cycle": [0]}, "verdict": verdict, "points": of}]}})
        .to_string()
    };
    secant_check::check(case, &certificate("undetermined", json!([]))).unwrap();
    assert_eq!(secant_check::check(case, &certificate("proved", json!([0]))).unwrap_err().rule, "answers");
}

/// Texts that are nearly numbers, and numbers that are nearly texts.
#[test]
fn one_way_to_write_a_number() {
    let near = [
        "",
        " ",
        "-0",
        "+3",
        "03",
        "3.0",
        "3e0",
        "3/1",
        "6/2",
        "-6/-2",
        "3/-1",
        "0/3",
        "3/0",
        "\u{663}",
        "\u{ff13}",
        "³",
        "0x3",
        "3_0",
        "NaN",
        "inf",
        "-inf",
        "3 ",
        " 3",
        "3\n",
        "--3",
        "3/",
        "/3",
        "1e400",
        "1e-400",
        "0b11",
        "3\u{0}",
        "1/\u{663}",
    ];
    for text in near {
        let found = rule("trisection", &[("/contraction/0/radius", json!(text))]);
        assert_eq!(found, "format", "{text:?}");
    }
    assert_eq!(rule("trisection", &[("/contraction/0/radius", json!("9".repeat(10_001)))]), "format");
    let (case, text) = stored("trisection");
    let raw = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        secant_check::check(&case, &text.replacen(from, to, 1)).expect_err(to).rule
    };
    for number in
        ["1.0", "1e0", "-1", "-0", "01", "+1", "18446744073709551616", "1E400", "NaN", "Infinity", "0x1", "true"]
    {
        assert!(
            matches!(raw("\"version\": 1", &format!("\"version\": {number}")).as_str(), "json" | "format"),
            "{number}"
        );
    }
    assert_eq!(raw("\"version\": 1", "\"version\": 2"), "format");
    assert_eq!(raw("\"version\": 1", "\"version\": \"1\""), "format");
    // A key twice, also where it is written in another way; the same for a key deep inside.
    assert_eq!(raw("\"verdict\": \"proved\"", "\"verdict\": \"refuted\", \"verdict\": \"proved\""), "json");
    assert_eq!(raw("\"verdict\": \"proved\"", "\"verd\\u0069ct\": \"refuted\", \"verdict\": \"proved\""), "json");
    assert_eq!(raw("\"kind\":\"half-tangent\"", "\"kind\":\"half-tangent\",\"kind\":\"cusp\""), "json");
    assert_eq!(raw("\"kind\": \"certify\"", "\"kind\": \"certify \""), "format");
    assert_eq!(raw("secant certificate", "Secant certificate"), "format");
    assert_eq!(raw("\"case\": \"trisection\"", "\"case\": \"tris\u{435}ction\""), "case");
    assert_eq!(secant_check::check(&case, &format!("{text} {text}")).unwrap_err().rule, "json");
    assert_eq!(secant_check::check(&case, &format!("\u{feff}{text}")).unwrap_err().rule, "json");
}

/// The certificate of a case proves nothing about a case that differs in one number, orientation, or word.
#[test]
fn the_case_itself_is_read() {
    let (case, text) = stored("every-three-states");
    for (from, to) in [
        ("\"1/4\", \"3/4\", \"3/4\"", "\"1/4\", \"1/2\", \"3/4\""),
        ("\"7/10\"", "\"71/100\""),
        ("to = \"b\"", "to = \"c\""),
        ("to = \"b\"", "to = \"b\"\nreversed = true"),
        ("start = \"a\"", "start = \"b\""),
        ("convention = \"columns\"", "convention = \"rows\""),
        ("dimension = 3", "dimension = 4"),
        ("name = \"three-states\"", "name = \"three-states \""),
        ("name = \"three-states\"", "name = \"three-states\"\nname = \"three-states\""),
        ("start = \"a\"", "start = \"a\"\ncontrol = [[0, 0], [1, 0], [0, 0]]"),
        ("start = \"a\"", "start = \"a\"\nkind = \"surface\""),
        ("start = \"a\"", "start = \"a\"\nscheme = \"chaikin\""),
    ] {
        let changed = case.replacen(from, to, 1);
        assert_ne!(changed, case, "{from}");
        let found = secant_check::check(&changed, &text);
        assert!(found.is_err(), "{to}: {found:?}");
    }
}

/// Long numbers in every place where arithmetic is done with them end in a refusal, not in a long wait.
#[test]
fn long_numbers_do_not_run_away() {
    // A power of 2 over an odd number.
    let power = secant_check::number::whole(2).pow(13_000).to_string();
    let long = |k: usize| format!("{power}/{}7", "3".repeat(4_001 + k));
    let begin = std::time::Instant::now();
    for (name, pointer) in [
        ("trisection", "/contraction/0/radius"),
        ("levy", "/points/0/branches/0/top/radius"),
        ("levy", "/points/0/branches/0/top/centre/0"),
        ("levy", "/answers/3/products/0/0/0"),
        ("koch-2", "/points/0/branches/0/top/polynomial/0"),
        ("koch-2", "/points/0/branches/0/top/interval/0"),
        ("spectrum-plain", "/spectra/0/classes/0/square"),
        ("spectrum-plain", "/spectra/0/factors/0/roots/0/centre/0"),
        ("every-boundary", "/answers/2/maps/0/0/0/0"),
        ("every-corner", "/answers/2/rate/cross_ratio"),
    ] {
        let (case, text) = stored(name);
        let mut forged: Value = serde_json::from_str(&text).unwrap();
        *forged.pointer_mut(&format!("/proof{pointer}")).unwrap() = json!(long(1));
        let _ = secant_check::check(&case, &forged.to_string());
    }
    // A polynomial and a scalar product with many different long denominators.
    let many: Vec<Value> = (0..40).map(|k| json!(long(k))).chain([json!("1")]).collect();
    assert_eq!(rule("koch-2", &[("/points/0/branches/0/top/polynomial", json!(many))]), "limit");
    // Millions of values.
    let (case, text) = stored("trisection");
    let zeros = format!("[{}0]", "0,".repeat(4_000_000));
    let found = secant_check::check(&case, &text.replacen("[0,1]", &zeros, 1)).unwrap_err();
    assert_eq!(found.rule, "json", "{found}");
    let keys: String = (0..1_000_000).map(|k| format!("\"{k}\":0,")).collect();
    let found = secant_check::check(&case, &text.replacen("[0,1]", &format!("{{{keys}\"x\":0}}"), 1)).unwrap_err();
    assert_eq!(found.rule, "json", "{found}");
    assert!(begin.elapsed().as_secs() < 60, "{:?}", begin.elapsed());
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

/// The places of the first branch of a point of a surface.
fn first(point: usize, rest: &str) -> String {
    format!("/points/{point}/branches/0{rest}")
}

#[test]
fn bounds_of_the_tangent_subspace_of_a_surface() {
    let stored_at = |name: &str, pointer: &str| {
        let text: Value = serde_json::from_str(&stored(name).1).unwrap();
        text.pointer(&format!("/proof{pointer}")).unwrap().clone()
    };
    let (bound, top, cover) = (first(0, "/bound"), first(0, "/top"), first(0, "/bound/cover"));
    let (functionals, rows) = (first(0, "/bound/functionals"), first(0, "/bound/rows"));
    let tangent = "/points/0/tangent";
    let other = stored_at("surface-spiral", &first(1, ""));
    let functional = stored_at("surface-spiral", &format!("{functionals}/0"));
    all(
        "surface-spiral",
        &[
            // Without the ring condition the plane of the pair is only contained.
            ("tangent", &[(&bound, Value::Null)]),
            ("tangent", &[(&bound, Value::Null), (tangent, Value::Null)]),
            ("cover", &[(&functionals, json!([]))]),
            ("leading", &[(&functionals, json!([[["1"], [], []]]))]),
            ("leading", &[(&functionals, json!([[functional[0], functional[2], functional[1]]]))]),
            ("cover", &[(&functionals, json!([[[], [], []]]))]),
            ("cover", &[(&cover, json!([{"piece": [1], "cells": "+0"}, {"piece": [2], "cells": "+1"}]))]),
            ("cover", &[(&format!("{cover}/0/cells"), json!("-0"))]),
            ("cover", &[(&format!("{cover}/0/cells"), json!("+2"))]),
            ("tangent", &[(tangent, json!([["1", "0", "0"], ["0", "1", "0"]]))]),
            ("tangent", &[(tangent, json!([["1", "0", "-1/3"]]))]),
            ("tangent", &[(tangent, json!([["3", "0", "-1"], ["0", "3", "1"]]))]),
            ("tangent", &[(tangent, json!([["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]))]),
            ("format", &[(tangent, json!([["1", "0"], ["0", "1"]]))]),
            ("tangent", &[("/points/0/rule", json!("line")), ("/answers/0", json!("refuted"))]),
            ("space", &[("/points/0/rule", json!("space")), (tangent, Value::Null), ("/answers/0", json!("refuted"))]),
            ("space", &[("/points/1/tangent", json!([["1", "0", "0"], ["0", "1", "0"]]))]),
            ("tangent", &[("/points/1/rule", json!("plane")), ("/answers/1", json!("proved"))]),
            ("point", &[("/points/1/branches", json!([]))]),
            ("point", &[("/points/1/branches", json!([null])), ("/points/1/rule", json!("plane"))]),
            ("space", &[("/points/1/branches", json!([null]))]),
            ("point", &[("/points/1/addresses", json!([{"prefix": [], "cycle": [2]}]))]),
            ("point", &[("/points/1/addresses", json!([{"prefix": [], "cycle": [1, 1]}]))]),
            ("point", &[("/points/0/addresses", json!([])), ("/points/0/branches", json!([]))]),
            ("top-conformal", &[(&first(0, ""), other.clone())]),
            ("top-conformal", &[(&top, other["top"].clone())]),
            ("points", &[("/points", json!([null, null, null]))]),
            ("answers", &[("/points/0", Value::Null)]),
            ("answers", &[("/answers", json!(["refuted"]))]),
            ("answers", &[("/answers/0", json!("refuted"))]),
            ("answers", &[("/further", json!([{"prefix": [1, 0], "cycle": [0]}]))]),
            ("points", &[("/further", json!([{"prefix": [1], "cycle": [0]}]))]),
            ("dense", &[("/dense", json!([]))]),
            ("hull", &[("/contraction/0/hull", json!("simplex"))]),
            ("format", &[("^/kind", json!("certify"))]),
        ],
    );
    let chains = format!("{top}/chains");
    let by_group =
        json!({"by": "group", "radius": "1/4", "rows": [["0", "1", "0", "0"], ["0", "0", "0", "1"]], "cover": []});
    all(
        "surface-two-blocks",
        &[
            // One functional alone has a zero on the ring; eigenvectors of the blocks as functionals see the wrong end.
            ("cover", &[(&functionals, json!([[["1"], ["1"], [], ["1"]]]))]),
            ("leading", &[(&functionals, json!([[["1"], [], [], []], [[], [], ["1"], []]]))]),
            ("top-real", &[(&chains, json!([stored_at("surface-two-blocks", &format!("{chains}/0"))]))]),
            ("tangent", &[(tangent, json!([["1", "0", "0", "0"], ["0", "1", "0", "0"]]))]),
            ("group", &[(&bound, by_group)]),
        ],
    );
    all(
        "surface-opposite",
        &[
            ("cover", &[(&format!("{functionals}/1"), json!([[], [], []]))]),
            ("top-real", &[(&format!("{chains}/0/sign"), json!("+"))]),
            ("format", &[(&format!("{bound}/by"), json!("trust"))]),
        ],
    );
    // The coefficient of the shorter chain has a sign on every piece of the ring.
    let cells = |signs: [&str; 3]| json!([1, 2, 3].map(|k| json!({"piece": [k], "cells": signs[k - 1]})));
    let minus = json!([["1"], ["1"], ["1"]]);
    let shorter = json!({"by": "leading", "functionals": [minus], "cover": cells(["-0", "-0", "+0"])});
    let conformal = json!({"by": "leading", "functionals": [], "cover": [
        {"piece": [0], "cells": "+0"}, {"piece": [2], "cells": "+0"}, {"piece": [3], "cells": "-0"}]});
    all(
        "surface-two-lengths",
        &[
            ("leading", &[(&bound, shorter)]),
            ("leading", &[(&first(1, "/bound"), conformal)]),
            ("tangent", &[(tangent, json!([["0", "1", "0"]]))]),
            ("tangent", &[("/points/0/rule", json!("plane"))]),
        ],
    );
    let point = first(0, "/orbits/0");
    let all_positive = json!([1, 2, 3].map(|k| json!({"piece": [k], "cells": "+0"})));
    all(
        "surface-null-component",
        &[
            // The second direction is that of the orbits: without it, or with the functional of the first alone, nothing follows.
            ("bound", &[(&first(0, "/orbits"), json!([]))]),
            ("group", &[(&rows, json!([["0", "1", "0"]]))]),
            (
                "group",
                &[(&rows, json!([["1", "0", "0"], ["0", "1", "0"]])), (&first(0, "/bound/radius"), json!("1/16"))],
            ),
            ("group", &[(&rows, json!([["1", "1", "0"], ["0", "0", "1"]]))]),
            ("cover", &[(&rows, json!([["0", "1", "0"], ["0", "1", "0"], ["0", "0", "1"]]))]),
            ("group", &[(&first(0, "/bound/radius"), json!("7/16"))]),
            // A row that is no left eigenvector, but has a sign on the ring and the right number in its leading place.
            (
                "group",
                &[
                    (
                        &bound,
                        json!({"by": "group", "radius": "7/16", "rows": [["0", "1", "1/2"]], "cover": all_positive}),
                    ),
                    (&first(0, "/orbits"), json!([])),
                    (tangent, json!([["1", "0", "0"]])),
                    ("/points/0/rule", json!("line")),
                    ("/answers/0", json!("refuted")),
                ],
            ),
            ("disc", &[(&first(0, "/bound/radius"), json!("3/8"))]),
            ("ring", &[(&format!("{point}/address"), json!({"prefix": [], "cycle": [0]}))]),
            ("disc", &[(&format!("{point}/address"), json!({"prefix": [2], "cycle": [0]}))]),
            ("top-real", &[(&format!("{point}/own/chains"), json!([]))]),
            ("bound", &[(&first(0, "/orbits"), json!([])), (tangent, json!([["1", "0", "0"]]))]),
            ("cover", &[(&bound, json!({"by": "leading", "functionals": [[[], [], []]], "cover": []}))]),
            ("cover", &[(&bound, json!({"by": "leading", "functionals": [[[], ["1"], []]], "cover": all_positive}))]),
        ],
    );
}

#[test]
fn all_cells_around_a_point_of_a_patch() {
    let text: Value = serde_json::from_str(&stored("surface-square").1).unwrap();
    let at = |pointer: &str| text.pointer(&format!("/proof{pointer}")).unwrap().clone();
    let (side, inner) = (at("/points/1"), at("/points/2"));
    let without = |point: &Value, k: usize| {
        let mut shorter = point.clone();
        shorter["addresses"].as_array_mut().unwrap().remove(k);
        shorter["branches"].as_array_mut().unwrap().remove(k);
        shorter
    };
    let swapped = |list: &Value| {
        let mut list = list.as_array().unwrap().clone();
        list.swap(0, 1);
        json!(list)
    };
    let missing = json!([side["branches"][0], null]);
    let twice = json!([side["branches"][0], side["branches"][0]]);
    // A corner and a point on a side, without planes, whose vectors would have other coordinates.
    let mut corner = at("/points/0");
    corner["tangent"] = Value::Null;
    let mut on_a_side = without(&side, 1);
    on_a_side["tangent"] = Value::Null;
    let all_vertices = at("/points");
    let fewer = json!(all_vertices.as_array().unwrap()[1..]);
    all(
        "surface-square",
        &[
            ("point", &[("/points/1", without(&side, 1))]),
            ("point", &[("/points/2", without(&inner, 3))]),
            ("point", &[("/points/1/addresses", swapped(&side["addresses"]))]),
            ("top-real", &[("/points/1/branches", twice)]),
            ("point", &[("/points/1/branches", missing)]),
            ("tangent", &[("/points/1/tangent", Value::Null)]),
            ("tangent", &[("/points/2/tangent", json!([["1", "0", "0", "-1"], ["0", "1", "0", "-1"]]))]),
            ("point", &[("/points", swapped(&all_vertices))]),
            ("points", &[("/points", fewer)]),
            ("answers", &[("/points/3", Value::Null)]),
            ("answers", &[("/dense", Value::Null)]),
            ("dense", &[("/dense/0", corner)]),
            ("dense", &[("/dense/0", on_a_side)]),
            ("dense", &[("/dense", json!([]))]),
            ("dense", &[("/dense", json!([at("/dense/0"), at("/dense/0")]))]),
            ("tangent", &[("/dense/0", without(&at("/dense/0"), 0)), ("/dense/0/tangent", Value::Null)]),
            ("dense", &[("/dense/0", without(&at("/dense/0"), 0))]),
            ("format", &[("/dense/0", at("/points/2"))]),
            (
                "answers",
                &[("/further", json!([{"prefix": [], "cycle": [0, 3]}])), ("/answers", json!(vec!["proved"; 5]))],
            ),
            (
                "points",
                &[("/further", json!([{"prefix": [], "cycle": [0, 1]}])), ("/answers", json!(vec!["proved"; 5]))],
            ),
        ],
    );
    // The patch is a line: that no certificate of a plane proves.
    let (dense, line) = ("/dense", json!([["1", "2", "3"]]));
    all(
        "surface-collapsed-line",
        &[
            ("tangent", &[("/points/0/rule", json!("plane"))]),
            (
                "tangent",
                &[("/points/0/tangent", json!([["1", "0", "0"], ["0", "2", "3"]])), ("/points/0/rule", json!("plane"))],
            ),
            ("tangent", &[("/points/1/tangent", json!([["1", "2", "4"]]))]),
            ("tangent", &[("/points/1/tangent", json!([]))]),
            ("answers", &[("/answers/0", json!("proved")), ("^/verdict", json!("undetermined"))]),
            ("format", &[(&format!("{dense}/0/tangent"), line)]),
        ],
    );
}

#[test]
fn how_the_faces_of_a_surface_are_divided() {
    let (case, text) = stored("surface-square");
    let after = |from: &str, to: &str| {
        assert!(case.contains(from), "{from}");
        secant_check::check(&case.replace(from, to), &text).map_err(|r| r.rule)
    };
    let rule = |from: &str, to: &str| after(from, to).unwrap_err();
    // Without sides there are no parameters, and the questions are about single branches.
    assert_eq!(rule("bottom =", "# bottom ="), "points");
    assert_eq!(rule("layout = \"2x2\"", "layout = \"4x1\""), "points");
    assert_eq!(rule("layout = \"2x2\"", "layout = \"triangle\""), "case");
    assert_eq!(rule("layout = \"2x2\"", "layout = \"2x3\""), "case");
    assert_eq!(rule("kind = \"face\"", "kind = \"set\""), "case");
}

#[test]
fn the_middle_of_a_triangle_is_turned() {
    let text: Value = serde_json::from_str(&stored("surface-triangle").1).unwrap();
    let at = |pointer: &str| text.pointer(&format!("/proof{pointer}")).unwrap().clone();
    let mut two = at("/points/1");
    two["addresses"].as_array_mut().unwrap().pop();
    two["branches"].as_array_mut().unwrap().pop();
    all(
        "surface-triangle",
        &[
            ("point", &[("/points/1", two)]),
            ("point", &[("/points/6/addresses", json!([{"prefix": [3], "cycle": [3]}]))]),
            ("points", &[("/points", json!([]))]),
            ("answers", &[("/points/7", Value::Null)]),
            ("tangent", &[("/points/4/tangent", json!([["1", "0", "0"], ["0", "1", "-1"]]))]),
            ("tangent", &[("/points/4/tangent", Value::Null)]),
            ("dense", &[("/dense/0", at("/points/0")), ("/dense/0/tangent", Value::Null)]),
        ],
    );
    let (case, certificate) = stored("surface-triangle");
    let rule = |from: &str, to: &str| {
        assert!(case.contains(from), "{from}");
        secant_check::check(&case.replace(from, to), &certificate).unwrap_err().rule
    };
    let middle = "[[0, \"1/2\", \"1/2\"], [\"1/2\", 0, \"1/2\"], [\"1/2\", \"1/2\", 0]]";
    let turned = "[[\"1/2\", 0, \"1/2\"], [\"1/2\", \"1/2\", 0], [0, \"1/2\", \"1/2\"]]";
    // A middle that lies otherwise than the case says: the cells around a vertex do not meet.
    assert_eq!(rule(middle, turned), "point");
    let placed = |corners: &str| format!("{middle}\ncorners = {corners}");
    assert_eq!(rule(middle, &placed("[1, 2, 0]")), "point");
    assert_eq!(rule(middle, &placed("[0, 0, 2]")), "case");
    assert_eq!(rule(middle, &placed("[0, 1, 3]")), "case");
    assert_eq!(rule(middle, &placed("[0, 1]")), "case");
    assert_eq!(rule("side01 =", "bottom ="), "case");
}

#[test]
fn tensor_products_of_curves() {
    let text: Value = serde_json::from_str(&stored("surface-product").1).unwrap();
    let at = |pointer: &str| text.pointer(&format!("/proof{pointer}")).unwrap().clone();
    let (first, second, product) = (at("/product/first"), at("/product/second"), at("/product"));
    // The curve that stays where it is, and the other that then would have to be the patch.
    let point = json!([
        [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]],
        [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
    ]);
    let joint = at("/product/first/points/1");
    let turned = |k: usize| {
        let mut operators = at(&format!("/product/{}/operators", ["first", "second"][k]));
        operators.as_array_mut().unwrap().reverse();
        operators
    };
    all(
        "surface-product",
        &[
            ("product", &[("/product", json!({"first": second, "second": first}))]),
            ("product", &[("/product/first", second.clone())]),
            ("product", &[("/product/first/operators", turned(0))]),
            ("product", &[("/product/first/operators", turned(0)), ("/product/second/operators", turned(1))]),
            ("product", &[("/product/first/operators", point)]),
            ("product", &[("/product/first/operators", json!([at("/product/first/operators/0")]))]),
            ("product", &[("/product/first/operators", json!([]))]),
            ("contraction", &[("/contraction", Value::Null), ("/product", Value::Null)]),
            ("point", &[("/product", Value::Null)]),
            ("contraction", &[("/product/first/contraction", json!([]))]),
            ("contraction", &[("/product/second/contraction/0/radius", json!("0"))]),
            ("format", &[("/product/first/contraction", Value::Null)]),
            // Another point of a curve, an end for a joint, one curve for both.
            ("product", &[("/points/0/branches", json!([1, 0]))]),
            ("product", &[("/points/0/branches", json!([0, 2]))]),
            ("product", &[("/points/1/branches", json!([0, 0]))]),
            ("product", &[("/points/1/branches", json!([0, 1]))]),
            ("product", &[("/points/1/branches", json!([1]))]),
            ("format", &[("/points/1/branches", json!([1, 9]))]),
            ("product", &[("/points/1/tangent", json!([["1", "0", "0", "0", "0", "0", "0", "0", "0"]]))]),
            ("point", &[("/points/1/addresses", json!([{"prefix": [0], "cycle": [1]}]))]),
            ("top-real", &[("/product/first/points/1/branches/1", joint["branches"][0].clone())]),
            ("product", &[("/product/first/points", json!([joint, joint, joint]))]),
            ("product", &[("/dense/0/branches", json!([0, 0]))]),
            ("dense", &[("/dense/0", at("/points/0"))]),
            ("dense", &[("/dense/0", at("/points/1"))]),
            ("answers", &[("/points/0", Value::Null)]),
        ],
    );
    // Factors 2 and 1/2 leave the product as it is, but the curves are none.
    let scaled = |curve: &str, factor: i64, divisor: i64| -> Value {
        let times = |x: &Value| {
            let x = secant_check::number::canonical(x.as_str().unwrap()).unwrap();
            json!((x * secant_check::number::whole(factor) / secant_check::number::whole(divisor)).to_string())
        };
        let list = |v: &Value, f: &dyn Fn(&Value) -> Value| v.as_array().unwrap().iter().map(f).collect::<Value>();
        let operators = at(&format!("/product/{curve}/operators"));
        list(&operators, &|m| list(m, &|row| list(row, &times)))
    };
    let operators = [scaled("first", 2, 1), scaled("second", 1, 2)];
    let changes =
        [("/product/first/operators", operators[0].clone()), ("/product/second/operators", operators[1].clone())];
    assert_eq!(rule("surface-product", &changes), "product");
    // A patch without contraction, whose other rules would see attractors in balls of radius 0.
    let spiral: Value = serde_json::from_str(&stored("surface-spiral").1).unwrap();
    assert_eq!(rule("surface-spiral", &[("/contraction", Value::Null)]), "contraction");
    assert_eq!(rule("surface-spiral", &[("/contraction", Value::Null), ("/product", product.clone())]), "contraction");
    assert_eq!(rule("surface-spiral", &[("/product", product)]), "contraction");
    let branch = spiral.pointer("/proof/points/0").unwrap().clone();
    assert_eq!(rule("surface-product", &[("/contraction", Value::Null), ("/points/0", branch)]), "contraction");
}

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
        ("format", &[(&valence, json!(257))]),
        ("verdict", &[("/valences", json!([]))]),
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

/// Orders of smoothness are those of the curve that is seen: these two are straight lines, although the curves in the spaces of
/// their states have different slopes at a joint.
#[test]
fn orders_of_a_curve_that_is_seen_as_a_line() {
    for name in ["regularity-seen-as-a-line", "regularity-killed-jump"] {
        let (case, text) = stored(name);
        let accepted = secant_check::check(&case, &text).unwrap();
        let polynomial = "proved: the curve is a polynomial in the uniform parameter".to_owned();
        assert!(accepted.claims.contains(&polynomial), "{accepted:?}");
        assert!(!accepted.claims.iter().any(|c| c.starts_with("refuted")), "{accepted:?}");
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

/// Much work or memory for few bytes: each is refused at once.
#[test]
fn little_texts_that_ask_for_much() {
    let many = |item: &str, count: usize| vec![item; count].join(",");
    // A hull of 20000 points of one coordinate, whose images would be a matrix of 400 million weights.
    let case = "name = \"much\"\nconvention = \"columns\"\nkind = \"set\"\npieces = [[[1]]]\n";
    let hull = format!("{{\"points\":[{}],\"images\":[[]]}}", many("[\"1\"]", 20_000));
    let envelope = |kind: &str, name: &str, proof: String| {
        format!(
            "{{\"format\":\"secant certificate\",\"version\":1,\"kind\":\"{kind}\",\"case\":\"{name}\",\"verdict\":\"proved\",\"proof\":{proof}}}"
        )
    };
    let state = format!("{{\"state\":0,\"radius\":\"0\",\"code\":{hull},\"hull\":null}}");
    let proof = format!("{{\"contraction\":[{state}],\"points\":[],\"answers\":[]}}");
    assert_eq!(secant_check::check(case, &envelope("certify", "much", proof)).unwrap_err().rule, "limit");
    // A chain of far more vectors than there are dimensions.
    let zeros = many("[[]]", 100_000);
    let chain = format!("[[[\"1\"]],{zeros}]");
    let factor = format!(
        "{{\"polynomial\":[\"0\",\"1\"],\"roots\":[{{\"centre\":[\"0\",\"0\"],\"error\":\"0\"}}],\"chains\":[{chain}]}}"
    );
    let proof = format!("{{\"spectra\":[{{\"operator\":null,\"factors\":[{factor}],\"modulus\":7,\"classes\":[]}}]}}");
    assert!(secant_check::check("1\n0\n", &envelope("spectrum", "matrix", proof)).is_err());
    // Numbers of a plain matrix that are a few letters and many digits.
    let long = "3e20000 ".repeat(10_000);
    let proof = "{\"spectra\":[{\"operator\":null,\"factors\":[],\"modulus\":7,\"classes\":[]}]}".to_owned();
    assert!(secant_check::check(&format!("100\n{long}"), &envelope("spectrum", "matrix", proof)).is_err());
}
