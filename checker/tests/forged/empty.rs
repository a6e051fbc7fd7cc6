//! Every quantifier of the rules over something that can be empty: what is said of all items of an empty list proves nothing.

use super::{all, stored};
use secant_check::{Decided, Verdict, check};
use serde_json::{Value, json};
use std::path::Path;

/// The places of the lists that are fields, as JSON pointers.
fn lists(value: &Value, at: &str, found: &mut Vec<String>) {
    let items: Vec<(String, &Value)> = match value {
        Value::Array(items) => items.iter().enumerate().map(|(k, v)| (k.to_string(), v)).collect(),
        Value::Object(fields) => fields.iter().map(|(k, v)| (k.clone(), v)).collect(),
        _ => return,
    };
    for (key, item) in items {
        let place = format!("{at}/{key}");
        if value.is_object() && item.as_array().is_some_and(|list| !list.is_empty()) {
            found.push(place.clone());
        }
        lists(item, &place, found);
    }
}

/// Whether every claim of the second list that is decided is decided in the same way in the first.
fn no_more(before: &[Decided], after: &[Decided]) -> bool {
    after.iter().all(|d| d.verdict == Verdict::Undetermined || before.contains(d))
}

/// Every list that is a field of a stored certificate, taken out: the certificate is rejected, or proves no more than before.
#[test]
fn lists_taken_out_of_certificates() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs/pass");
    let mut names: Vec<_> = std::fs::read_dir(root).unwrap().map(|e| e.unwrap().path()).collect();
    names.retain(|p| p.extension().is_some_and(|e| e == "json"));
    names.sort();
    let part = |k: usize| names.iter().skip(k).step_by(2).map(|path| without_lists(path)).sum::<usize>();
    let tried = std::thread::scope(|s| [0, 1].map(|k| s.spawn(move || part(k))).map(|t| t.join().unwrap()));
    assert!(tried[0] + tried[1] > 1000, "{tried:?}");
}

/// The lists that were taken out of one certificate, and how many.
fn without_lists(path: &Path) -> usize {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let (case, text) = stored(&name);
    let whole: Value = serde_json::from_str(&text).unwrap();
    let before = check(&case, &text).unwrap();
    let mut places = Vec::new();
    lists(&whole["proof"], "/proof", &mut places);
    for place in &places {
        let mut forged = whole.clone();
        *forged.pointer_mut(place).unwrap() = json!([]);
        let mut found = check(&case, &forged.to_string());
        for verdict in ["proved", "refuted", "undetermined"] {
            // What follows may be another verdict.
            if found.as_ref().is_err_and(|r| r.rule == "verdict") {
                forged["verdict"] = json!(verdict);
                found = check(&case, &forged.to_string());
            }
        }
        if let Ok(after) = found {
            assert!(no_more(&before.claims, &after.claims), "{name} {place}: {:?}", after.claims);
        }
    }
    places.len()
}

/// A product of size 0 x 0 has no eigenvalue near any number: the joint spectral radius of this curve's derivatives is 1/4.
#[test]
fn a_path_in_an_empty_space() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/certs/fail/word--path-in-an-empty-space.json");
    let read = |end: &str| std::fs::read_to_string(root.with_extension(end)).unwrap();
    let refused = check(&read("toml"), &read("json")).unwrap_err();
    assert!(!refused.unreadable && refused.rule == "word", "{refused}");
}

#[test]
fn tops_without_eigenvalues() {
    let (top, bound) = ("/points/0/branches/0/top", "/points/0/branches/0/bound");
    let real =
        json!({"top": "real", "radius": "100", "polynomial": ["-101", "1"], "interval": ["101", "101"], "chains": []});
    let conformal = json!({"top": "conformal", "radius": "100", "basis": [], "gram": [], "square": "100000"});
    for name in ["surface-two-blocks", "surface-spiral", "surface-null-component"] {
        all(name, &[("disc", &[(top, real.clone())]), ("disc", &[(top, conformal.clone())])]);
    }
    let orbit = "/points/0/branches/0/orbits/0/own";
    let group = |key: &str| format!("{bound}/{key}");
    all(
        "surface-null-component",
        &[
            ("disc", &[(orbit, real.clone())]),
            ("disc", &[(orbit, conformal)]),
            ("cover", &[(&group("cover"), json!([]))]),
            // Of two eigenvalues that are asked for none is there.
            ("disc", &[(&group("radius"), json!("100"))]),
            ("disc", &[(&group("rows"), json!([]))]),
            ("disc", &[(&group("rows"), json!([])), (&group("radius"), json!("100"))]),
        ],
    );
    all(
        "surface-two-blocks",
        &[("cover", &[(&group("functionals"), json!([]))]), ("cover", &[(&group("cover"), json!([]))])],
    );
}

#[test]
fn lists_of_nothing() {
    let zero = json!({"dims": [0], "bound": "0", "norm": {"norm": "zero"}});
    let (_, text) = stored("jsr-tree");
    let certificate: Value = serde_json::from_str(&text).unwrap();
    let own = certificate["proof"]["blocks"][0].clone();
    all("jsr-tree", &[("block", &[("/blocks", json!([zero, own]))]), ("block", &[("/blocks", json!([zero]))])]);
    all("jsr-quadratic", &[("quadratic", &[("/blocks/0/norm/forms", json!([]))])]);
    all("vertex-catmull-clark", &[("vertex", &[("/valences", json!([])), ("^/verdict", json!("undetermined"))])]);
    all("uniformity", &[("contraction", &[("/contraction", json!([]))]), ("answers", &[("/answers", json!([]))])]);
    all("regularity-spline", &[("orders", &[("/orders", json!([]))])]);
    all("solve-junction-contradiction", &[("solve", &[("/conflict", json!([]))])]);
    all("spectrum-plain", &[("case", &[("/spectra", json!([]))]), ("chains", &[("/spectra/0/factors", json!([]))])]);
    all("surface-product", &[("product", &[("/product/first/operators", json!([]))])]);
}

/// Cases with a part that is empty are not read.
#[test]
fn cases_without_a_part() {
    let read = |name: &str, case: &str| {
        let (_, text) = stored(name);
        check(case, &text).err().is_some_and(|r| r.unreadable)
    };
    let curve = |pieces: &str, control: &str| {
        read(
            "half-tangent",
            &format!("name = \"half-tangent\"\nconvention = \"columns\"\n{control}\npieces = {pieces}"),
        )
    };
    assert!(!curve("[[[1, \"1/2\"], [0, \"1/2\"]]]", "control = [[0], [1]]"));
    assert!(curve("[]", ""));
    assert!(curve("[[]]", ""));
    assert!(curve("[[[]]]", ""));
    assert!(curve("[[[1, \"1/2\"], [0, \"1/2\"]]]", "control = []"));
    assert!(curve("[[[1, \"1/2\"], [0, \"1/2\"]]]", "control = [[], []]"));
    let states =
        |list: &str| read("half-tangent", &format!("name = \"half-tangent\"\nconvention = \"columns\"\n{list}"));
    assert!(states("state = []"));
    assert!(states("start = \"a\"\nstate = [{name = \"a\", dimension = 1, piece = []}]"));
    assert!(states("start = \"a\"\nstate = [{name = \"a\", dimension = 0, piece = [{to = \"a\", matrix = []}]}]"));
    let matrices = |rest: &str| read("jsr-automaton", &format!("name = \"automaton\"\n{rest}"));
    assert!(!matrices("matrices = [[[1]]]\nstates = [1]\narrows = [[0, 0, 0]]"));
    assert!(matrices("matrices = []"));
    assert!(matrices("matrices = [[[1]]]\nstates = [1]\narrows = []"));
    assert!(matrices("matrices = [[[1]]]\nstates = []\narrows = [[0, 0, 0]]"));
    assert!(matrices("matrices = [[[1]]]\nstates = [0]\narrows = [[0, 0, 0]]"));
    let vertex = |valence: &str| {
        read("vertex-loop", &format!("name = \"vertex-loop\"\n[vertex]\nmesh = \"loop\"\nvalence = {valence}"))
    };
    assert!(!vertex("\"4..5\""));
    for valence in ["\"\"", "\",\"", "\"5..4\"", "\"..\"", "1", "1025", "\"1\"", "\"5,\"", "[]"] {
        assert!(vertex(valence), "{valence}");
    }
}

/// A list of a million valences is a list of at most 254.
#[test]
fn a_long_list_of_valences() {
    let (case, text) = stored("vertex-loop");
    let line = case.lines().find(|line| line.starts_with("valence")).unwrap();
    let listed = |list: String| check(&case.replace(line, &format!("valence = \"{list}\"")), &text);
    let accepted = listed(vec!["5"; 1_000_000].join(",")).unwrap();
    assert_eq!(accepted.case, "vertex-loop");
    assert_eq!(listed(vec!["3..256"; 1_000_000].join(",")).unwrap_err().rule, "case");
}
