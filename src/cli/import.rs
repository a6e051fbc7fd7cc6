//! `secant import`: files of other programs, written as cases.

use super::PROVED;
use super::output::{print_or_write, settle};
use crate::case::MAX_BYTES;
use crate::diagnostic::Problem;
use crate::scheme::{Heading, SchemeError, case_text, parse_fractint, parse_json};
use crate::shape::Shape;
use std::io::Read;
use std::path::Path;

const FRACTINT: &str = "Fractint: a map is a b c d e f p, meaning x' = a x + b y + e, y' = c x + d y + f; probabilities are \
                        left out, decimals are exact, and the shape is a set";
const JSON: &str = "JSON: matrices act as its `convention` says (columns sum to 1 with \"columns\", rows with \"rows\"), maps are \
                    x -> linear x + shift";

/// Reads a file and writes it as a case.
pub fn run(path: &Path, entry: Option<&str>, output: Option<&Path>) -> u8 {
    settle(read(path, entry).and_then(|text| print_or_write(&text, output)).map(|()| PROVED))
}

fn read(path: &Path, entry: Option<&str>) -> Result<String, Problem> {
    let shown = path.display();
    if crate::mesh::is_mesh(path) {
        return Err(Problem::new("secant::import", format!("{shown} is a mesh, and no set of maps")).with_help(
            format!("`secant certify {shown} --scheme loop` (or catmull-clark) is about its limit surface"),
        ));
    }
    let unreadable = |error: String| {
        Problem::new("secant::import::unreadable", format!("{shown} cannot be read: {error}"))
            .with_help("give a file in the format of Fractint (.ifs) or in JSON (.json)")
    };
    let file = std::fs::File::open(path).map_err(|e| unreadable(e.to_string()))?;
    let mut text = String::new();
    file.take(MAX_BYTES as u64 + 1).read_to_string(&mut text).map_err(|e| unreadable(e.to_string()))?;
    if text.len() > MAX_BYTES {
        return Err(unreadable(format!("it is larger than {MAX_BYTES} bytes")));
    }
    let refused = |error: &SchemeError| {
        Problem::new("secant::import", format!("{shown}: {error}")).with_help("docs/schemes.md describes what is read")
    };
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    if ending == "json" {
        let shape = parse_json(&text).map_err(|e| refused(&e))?;
        return Ok(written(&shape, entry.unwrap_or(&stem), JSON));
    }
    let entries = parse_fractint(&text).map_err(|e| refused(&e))?;
    let names: Vec<&str> = entries.iter().map(|e| e.name.as_str()).collect();
    let chosen = match entry {
        None => entries.first().filter(|_| entries.len() == 1),
        Some(name) => entries.iter().find(|e| e.name.eq_ignore_ascii_case(name)),
    };
    let chosen = chosen.ok_or_else(|| {
        let message = match entry {
            None => format!("{shown} has {} entries", entries.len()),
            Some(name) => format!("{shown} has no entry `{name}`"),
        };
        Problem::new("secant::import::entry", message)
            .with_help(format!("choose one with --entry: {}", names.join(", ")))
    })?;
    Ok(written(&chosen.shape, &chosen.name, FRACTINT))
}

fn written(shape: &Shape, name: &str, convention: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' };
    let name: String = name.trim_start_matches('.').chars().map(plain).take(100).collect();
    let name = if name.is_empty() { "imported".to_owned() } else { name };
    let heading = Heading { title: name.clone(), name, ..Heading::default() };
    format!("# Convention: {convention}.\n{}", case_text(shape, &heading))
}
