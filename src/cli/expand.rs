//! `secant expand`: a case with every operator written out.

use super::PROVED;
use super::output::{print, print_or_write, settle};
use crate::case::Case;
use crate::diagnostic::Problem;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Writes the expanded cases to the standard output, or one to a file.
pub fn run(cases: &[PathBuf], output: Option<&Path>, json: bool) -> u8 {
    settle(expanded(cases, output, json).map(|()| PROVED))
}

fn expanded(cases: &[PathBuf], output: Option<&Path>, json: bool) -> Result<(), Problem> {
    if output.is_some() && cases.len() > 1 {
        return Err(Problem::new("secant::usage", "--output is for a single case").with_help("expand them one by one"));
    }
    let read = |path: &PathBuf| Ok((path.display().to_string(), Case::ask(&path.to_string_lossy())?));
    let all = cases.iter().map(read).collect::<Result<Vec<(String, Case)>, Problem>>()?;
    if json {
        let one = |(path, case): &(String, Case)| json!({"path": path, "case": case.name, "text": case.expanded()});
        let list: Vec<Value> = all.iter().map(one).collect();
        print(&match list.as_slice() {
            [one] => format!("{one:#}\n"),
            _ => format!("{:#}\n", Value::Array(list)),
        });
        return Ok(());
    }
    let texts: Vec<String> = all.iter().map(|(_, case)| case.expanded()).collect();
    print_or_write(&texts.join("\n"), output)
}
