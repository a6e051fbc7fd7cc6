//! The JSON Schema of the case format is the one that is committed, and says what the reader does.

mod corpus;

use secant::case::{Question, schema};
use serde_json::Value;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_committed_schema_is_current() {
    let path = root().join("docs/case.schema.json");
    let text = format!("{:#}\n", schema());
    if std::env::var_os("SECANT_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap_or_default(), text, "SECANT_BLESS=1 writes it anew");
}

fn keys(value: &Value) -> Vec<String> {
    let mut keys: Vec<String> = value["properties"].as_object().unwrap().keys().cloned().collect();
    keys.sort();
    keys
}

/// The keys that the reader knows, as it says where one is unknown.
fn known(text: &str) -> Vec<String> {
    let problem = Question::parse("x.toml", text).expect_err("an unknown key");
    assert_eq!(problem.id(), "secant::case::unknown-key", "{text}: {}", problem.message());
    let help = problem.remedy().unwrap_or_default().to_owned();
    let list = help.strip_prefix("known keys are ").unwrap_or_else(|| panic!("{help}"));
    let mut keys: Vec<String> = list.split(", ").map(str::to_owned).collect();
    keys.sort();
    keys
}

#[test]
fn the_reader_has_the_keys_of_the_schema() {
    let all = schema();
    let of = |key: &str| &all["properties"][key];
    let start = "name = \"x\"\n";
    let mut own = known(&format!("{start}qqqqzzzz = 1\n"));
    own.extend(["vertex", "parameters", "border"].map(str::to_owned));
    own.sort();
    assert_eq!(keys(&all), own);
    assert_eq!(keys(&of("map")["items"]), known(&format!("{start}[[map]]\nqqqqzzzz = 1\n")));
    let pieces = "convention = \"columns\"\npieces = [[[1]]]\n";
    assert_eq!(keys(&of("examine")["items"]), known(&format!("{start}{pieces}[[examine]]\nqqqqzzzz = 1\n")));
    assert_eq!(
        keys(&of("expect")["properties"]["point"]["items"]),
        known(&format!("{start}{pieces}[[expect.point]]\nqqqqzzzz = 1\n"))
    );
    // A face has other keys than a curve, and so has a quadrangle than a triangle.
    let state =
        |more: &str| known(&format!("{start}convention = \"columns\"\n[[state]]\nname = \"a\"\n{more}qqqqzzzz = 1\n"));
    let mut union = [state(""), state("kind = \"face\"\n")].concat();
    union.sort();
    union.dedup();
    assert_eq!(keys(&of("state")["items"]), union);
}

/// Every key of every case that is read is one of the schema.
#[test]
fn the_cases_have_no_other_keys() {
    let mut files = Vec::new();
    corpus::all_files(&root().join("cases"), &mut files);
    let all = schema();
    let mut seen = 0;
    for path in files.iter().filter(|p| Question::read_open(p).is_ok()) {
        let table: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
        for (key, value) in &table {
            let schema = &all["properties"][key];
            assert!(schema.is_object(), "{}: {key}", path.display());
            if let Some(inner) = value.as_table() {
                for key in inner.keys() {
                    assert!(schema["properties"][key].is_object(), "{}: {key}", path.display());
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 50, "only {seen} keys were looked at");
}
