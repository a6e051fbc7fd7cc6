//! Spectra.

use super::{all, rule, stored};
use serde_json::{Value, json};

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
