//! The case files, for the tests that go through all of them.

use std::path::{Path, PathBuf};

/// All case files below `dir`, in order, without those about vertices of a mesh, which have a test of their own
/// (tests/extraordinary.rs).
#[allow(dead_code, reason = "not every test goes through these")]
pub fn case_files(dir: &Path, found: &mut Vec<PathBuf>) {
    all_files(dir, found);
    found.retain(|path| !about_vertices(path));
}

/// All case files below `dir`, in order.
pub fn all_files(dir: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            all_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml") {
            found.push(path);
        }
    }
}

/// Whether a case is about the vertices of a mesh.
pub fn about_vertices(path: &Path) -> bool {
    use secant::case::{Question, Subject};
    Question::read_open(path).is_ok_and(|question| question.subject() == Subject::Vertices)
}
