//! The LaTeX reports of all cases compile with the TeX that is installed: `SECANT_TEX=1 cargo test --test latex`.
//!
//! Debian: `apt-get install texlive-latex-recommended texlive-pictures lmodern`.

mod corpus;

use rayon::prelude::*;
use secant::prelude::*;
use std::path::Path;
use std::process::Command;

/// Lines may stick out of the page by so many points.
const STICKS_OUT: f64 = 40.0;

#[test]
fn reports_compile() {
    if std::env::var_os("SECANT_TEX").is_none() {
        eprintln!("not run: set SECANT_TEX=1");
        return;
    }
    let mut files = Vec::new();
    corpus::case_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"), &mut files);
    let dir = tempfile::tempdir().unwrap();
    let wrong: Vec<String> =
        files.par_iter().enumerate().filter_map(|(k, file)| mistake(file, dir.path(), k)).collect();
    assert!(wrong.is_empty(), "{} of {} cases:\n{}", wrong.len(), files.len(), wrong.join("\n"));
}

/// What is wrong with the report of a case; nothing for cases that are refused.
fn mistake(file: &Path, dir: &Path, k: usize) -> Option<String> {
    let case = Case::read(file).ok()?;
    let found = certify(&case.shape, &case.examine).ok()?;
    std::fs::write(dir.join(format!("{k}.tex")), latex::render(&proof::document(&case, &found))).unwrap();
    let run = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", &format!("{k}.tex")])
        .current_dir(dir)
        .output()
        .expect("pdflatex is installed");
    let log = String::from_utf8_lossy(&run.stdout).into_owned();
    let name = file.display();
    if !run.status.success() {
        let start = log.find("\n!").unwrap_or(0);
        return Some(format!("{name}: {}", log[start..].chars().take(400).collect::<String>()));
    }
    let widths = log.split("Overfull \\hbox (").skip(1).filter_map(|w| w.split("pt").next()?.parse::<f64>().ok());
    let widest = widths.fold(0.0, f64::max);
    (widest > STICKS_OUT).then(|| format!("{name}: a line sticks out by {widest} pt"))
}
