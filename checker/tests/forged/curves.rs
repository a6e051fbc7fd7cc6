//! Curves: cones, points, answers, contraction, addresses.

use super::{all, rule, stored};
use serde_json::{Value, json};

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
fn a_change_of_sign_on_a_connected_piece() {
    const BRANCH: &str = "/points/0/branches/0";
    let at = |rest: &str| format!("{BRANCH}{rest}");
    let address = |prefix: &[usize], cycle: &[usize]| json!({"prefix": prefix, "cycle": cycle});
    let [positive, negative, links, rows] = ["/positive", "/negative", "/links", "/rows"].map(at);
    let [radius, cover, functional] = ["/radius", "/cover", "/functional"].map(at);
    all(
        "sign-block-3",
        &[
            ("sign-change", &[(positive.as_str(), address(&[1], &[1]))]),
            ("sign-change", &[(negative.as_str(), address(&[1], &[0]))]),
            ("ring", &[(negative.as_str(), address(&[], &[0]))]),
            // The pieces of the segment, not joined: pairs are left out, or no points in common.
            ("sign-change", &[(links.as_str(), Value::Null)]),
            ("links", &[(links.as_str(), json!([]))]),
            ("links", &[(links.as_str(), json!([[]]))]),
            ("links", &[(links.as_str(), json!([[[address(&[0], &[1]), address(&[1], &[1])]]]))]),
            ("links", &[(links.as_str(), json!([[[address(&[0], &[1]), address(&[0], &[1])]]]))]),
            ("links", &[(links.as_str(), json!([[[address(&[0], &[1]), address(&[1], &[0])]], []]))]),
            // No eigenvalue outside, no rows.
            ("disc", &[(radius.as_str(), json!("1"))]),
            ("disc", &[(rows.as_str(), json!([]))]),
            ("group", &[(rows.as_str(), json!([["1", "0", "0"], ["0", "1", "0"], ["1", "1", "0"]]))]),
            ("disc", &[(radius.as_str(), json!("0"))]),
            ("cover", &[(cover.as_str(), json!([]))]),
            ("cover", &[(cover.as_str(), json!([{"piece": [1], "cells": "-1"}]))]),
            ("leading", &[(functional.as_str(), json!([["1"], ["1"], []]))]),
        ],
    );
    // All eigenvalues, whose eigenspaces the control points do not tell apart, instead of the first two.
    let all_rows = json!([["1", "0", "0"], ["0", "0", "1"], ["0", "1", "0"]]);
    assert_eq!(rule("sign-projected", &[(rows.as_str(), all_rows), (radius.as_str(), json!("1/16"))]), "leading-sign");
    assert_eq!(rule("sign-projected", &[(rows.as_str(), json!([["0", "0", "1"], ["0", "1", "0"]]))]), "cover");
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
