//! The case files, for the tests that go through all of them.

use std::path::{Path, PathBuf};

/// All case files below `dir`, in order.
pub fn case_files(dir: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            case_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml") && !about_vertices(&path) {
            found.push(path);
        }
    }
}

/// Cases about the vertices of a mesh have a test of their own (tests/extraordinary.rs).
fn about_vertices(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| secant::case::VertexCase::is_one(&text))
}
