//! Tangent planes of surfaces.

use super::{all, rule, stored};
use serde_json::{Value, json};

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
    // A face has all of its sides or none.
    assert_eq!(rule("bottom =", "# bottom ="), "case");
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
