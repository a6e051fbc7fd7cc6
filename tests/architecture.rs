//! The table of ARCHITECTURE.md is what the imports say, and data flows one way: a module uses only modules above it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The modules of the crate `secant-exact`, which the library shows as its own.
fn exact() -> BTreeSet<String> {
    let text = std::fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let list = text.split("pub use secant_exact::{").nth(1).unwrap().split('}').next().unwrap();
    list.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn sources(dir: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// The code of a file without its comments and its tests.
fn code(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let text = text.split("\nmod tests {").next().unwrap();
    text.lines().filter(|l| !l.trim_start().starts_with("//")).map(|l| format!("{l}\n")).collect()
}

/// The names that follow `crate::` in a text, also in braces.
fn imported(text: &str) -> BTreeSet<String> {
    let word = |s: &str| s.chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect::<String>();
    let mut all = BTreeSet::new();
    for rest in text.split("crate::").skip(1) {
        match rest.strip_prefix('{') {
            Some(list) => all.extend(list.split('}').next().unwrap().split(',').map(|part| word(part.trim()))),
            None => {
                all.insert(word(rest));
            }
        }
    }
    all.remove("");
    all
}

/// What each module of the library uses of the others.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let mut files = Vec::new();
    sources(&root().join("src"), &mut files);
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in &files {
        let inside = file.strip_prefix(root().join("src")).unwrap();
        let module = inside.components().next().unwrap().as_os_str().to_string_lossy().replace(".rs", "");
        if module != "lib" && module != "main" {
            all.entry(module).or_default().extend(imported(&code(file)));
        }
    }
    let exact = exact();
    for (module, uses) in &mut all {
        uses.remove(module);
        let before = uses.len();
        uses.retain(|used| !exact.contains(used));
        if uses.len() < before {
            uses.insert("exact".to_owned());
        }
    }
    all
}

/// The rows of the table: modules in backticks, and what they depend on.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let text = std::fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows = text.lines().skip_while(|l| !l.starts_with("| module |")).skip(2).take_while(|l| l.starts_with('|'));
    let ticked = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<BTreeSet<String>>();
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").collect();
        assert_eq!(cells.len(), 3, "{row}");
        (ticked(cells[0]).into_iter().next().unwrap(), ticked(cells[2]))
    })
    .collect()
}

#[test]
fn the_table_is_what_the_imports_say() {
    let (imports, table) = (imports(), table());
    let modules: BTreeSet<&String> = imports.keys().collect();
    let rows: BTreeSet<&String> = table.iter().map(|(m, _)| m).filter(|m| *m != "exact").collect();
    assert_eq!(rows, modules);
    for (module, uses) in table.iter().filter(|(m, _)| m != "exact") {
        assert_eq!(uses, &imports[module], "row of `{module}`: left the table, right the imports");
    }
}

#[test]
fn data_flows_one_way() {
    let table = table();
    for (k, (module, uses)) in table.iter().enumerate() {
        for used in uses {
            let at = table.iter().position(|(m, _)| m == used);
            assert!(at.is_some_and(|at| at < k), "`{module}` uses `{used}`, which does not stand above it");
        }
    }
}

/// The rooms that prove; the reader of files of matrices stands beside the engine of radii.
const PROVING: [&str; 5] = ["theorem", "vertex", "radius", "answer.rs", "budget.rs"];
const READERS: [&str; 1] = ["radius/file.rs"];

/// What may stand before a sentence in a proving room: messages of errors and of mistakes of the program.
const MESSAGES: [&str; 7] =
    ["#[error(", "expect(", "reason =", "panic!(", "unreachable!(", "assert!(", "debug_assert!("];

/// The string literals of a text, each with what stands before it.
fn literals(text: &str) -> Vec<(&str, &str)> {
    let mut all = Vec::new();
    let (mut start, mut escaped) = (None, false);
    for (at, c) in text.char_indices() {
        match (start, c) {
            _ if escaped => escaped = false,
            (Some(_), '\\') => escaped = true,
            // A quotation mark between apostrophes is a character.
            (None, '"') if text[..at].ends_with('\'') && text[at + 1..].starts_with('\'') => {}
            (None, '"') => start = Some(at),
            (Some(from), '"') => {
                all.push((text[..from].trim_end(), &text[from + 1..at]));
                start = None;
            }
            _ => {}
        }
    }
    all
}

/// Whether three words follow each other, as in prose.
fn is_prose(text: &str) -> bool {
    let is_word = |w: &str| w.len() > 1 && w.chars().all(char::is_alphabetic);
    let words: Vec<bool> = text.split_whitespace().map(|w| is_word(w.trim_matches([',', '.', ':', ';']))).collect();
    words.windows(3).any(|w| w.iter().all(|word| *word))
}

#[test]
fn proving_rooms_hold_no_prose() {
    assert!(is_prose("the branch is not isolated") && !is_prose("tangent line") && !is_prose("a b c"));
    let mut seen = 0;
    for room in PROVING {
        let path = root().join("src").join(room);
        let mut files = Vec::new();
        if path.is_dir() {
            sources(&path, &mut files)
        } else {
            files.push(path)
        }
        for file in files.iter().filter(|f| READERS.iter().all(|r| !f.ends_with(r))) {
            let text = code(file);
            for (before, literal) in literals(&text) {
                seen += 1;
                let message = MESSAGES.iter().any(|m| before.ends_with(m));
                assert!(message || !is_prose(literal), "{}: prose in a room that proves: {literal:?}", file.display());
            }
        }
    }
    assert!(seen > 100, "{seen} literals were read");
}

/// The Rust files of a folder, by name.
fn programs(folder: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap().map(|e| e.unwrap().path());
    let rust = entries.filter(|p| p.extension().is_some_and(|e| e == "rs"));
    rust.map(|p| p.file_name().unwrap().to_string_lossy().into_owned()).collect()
}

/// A file of tests that no program has would never run.
#[test]
fn every_file_of_tests_is_in_a_program() {
    let read = |file: &str| std::fs::read_to_string(root().join(file)).unwrap();
    let quoted = |line: &str, prefix: &str| Some(line.strip_prefix(prefix)?.split('"').next()?.to_owned());
    let suite = read("tests/suite.rs");
    let mut found: BTreeSet<String> = read("Cargo.toml")
        .lines()
        .filter_map(|l| quoted(l, "path = \"tests/"))
        .filter(|f| f.ends_with(".rs"))
        .collect();
    for (path, module) in suite.lines().zip(suite.lines().skip(1)) {
        if let Some(file) = quoted(path, "#[path = \"") {
            assert!(module.starts_with("mod ") && module.ends_with(';'), "{module}");
            found.insert(file);
        }
    }
    found.retain(|f| !f.starts_with("../"));
    assert_eq!(found, programs("tests"));
    let targets = read("fuzz/Cargo.toml");
    let targets = targets.lines().filter_map(|l| quoted(l, "path = \"fuzz_targets/"));
    assert_eq!(targets.collect::<BTreeSet<_>>(), programs("fuzz/fuzz_targets"));
}
