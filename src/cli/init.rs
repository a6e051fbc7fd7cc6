//! `secant init`: a starter case.

use super::PROVED;
use super::output::deliver;
use crate::case::Case;
use crate::diagnostic::Problem;
use std::io::Write;
use std::path::PathBuf;

/// The starter with `NAME` in place of the name.
const STARTER: &str = include_str!("starter.toml");

/// Writes `NAME.toml`, unless it exists.
pub fn run(name: &str) -> u8 {
    deliver(write(name).map(|path| {
        let shown = path.display();
        (format!("{shown} is written; try  secant certify {shown}\n"), PROVED)
    }))
}

fn write(name: &str) -> Result<PathBuf, Problem> {
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let text = STARTER.replace("NAME", name);
    // The reader knows what a name may look like.
    Case::parse("the starter case", &text).map_err(|_| {
        Problem::new("secant::usage::name", format!("{name:?} cannot be the name of a case"))
            .with_help("a name is made of letters, digits, `-`, `_` and `.`")
    })?;
    let path = PathBuf::from(format!("{name}.toml"));
    let problem = |error: std::io::Error| {
        Problem::new("secant::output", format!("{} cannot be written: {error}", path.display()))
            .with_help("choose a name that is not taken, in a directory that is writable")
    };
    let mut file = std::fs::File::create_new(&path).map_err(problem)?;
    file.write_all(text.as_bytes()).map_err(problem)?;
    Ok(path)
}
