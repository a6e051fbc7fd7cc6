//! Certificates changed by hand to prove false statements, and texts that look like numbers: each is refused, by the rule that
//! should find it.
#![allow(clippy::disallowed_methods, reason = "what a test leaves out proves nothing")]

mod curves;
mod empty;
mod lattices;
mod meshes;
mod radii;
mod solutions;
mod spectra;
mod surfaces;
mod texts;
mod vertices;

use serde_json::Value;
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
