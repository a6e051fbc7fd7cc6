//! The LaTeX reports compile with the TeX that is installed: `SECANT_TEX=1 cargo test --test latex` for two cases of each
//! directory, `SECANT_TEX=all` for all of them. `SECANT_TEX_DIR=DIR` keeps the files in DIR.
//!
//! Debian: `apt-get install texlive-latex-recommended texlive-pictures lmodern`.

use crate::corpus;

use rayon::prelude::*;
use secant::case::Valences;
use secant::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Lines may stick out of the page by so many points.
const STICKS_OUT: f64 = 40.0;
/// Reports in one run of TeX: starting it takes longer than most reports.
const BATCH: usize = 12;
/// Cases of each directory without `SECANT_TEX=all`.
const SAMPLE: usize = 2;

#[test]
fn reports_compile() {
    let Some(mode) = std::env::var_os("SECANT_TEX") else {
        eprintln!("not run: set SECANT_TEX=1");
        return;
    };
    let files = chosen(mode == "all");
    let scratch = tempfile::tempdir().unwrap();
    let kept = std::env::var_os("SECANT_TEX_DIR").map(PathBuf::from);
    let dir = kept.as_deref().unwrap_or(scratch.path());
    let mut reports: Vec<(String, String)> = files.par_iter().filter_map(|f| Some((name(f), report(f)?))).collect();
    assert!(reports.len() > 20, "{} reports", reports.len());
    // One as it is written, with its own title.
    let (first, text) = &reports[0];
    std::fs::write(dir.join("single.tex"), text).unwrap();
    let log = compiled(dir, "single").unwrap_or_else(|error| panic!("{first}: {error}"));
    assert!(log.contains("Output written on single.pdf"), "{log}");
    // Long ones are spread over the batches.
    reports.sort_by_key(|(_, text)| std::cmp::Reverse(text.len()));
    let count = reports.len().div_ceil(BATCH);
    let batches: Vec<Vec<&(String, String)>> =
        (0..count).map(|k| reports.iter().skip(k).step_by(count).collect()).collect();
    let wrong: Vec<String> = batches.par_iter().enumerate().flat_map(|(k, batch)| mistakes(batch, dir, k)).collect();
    assert!(wrong.is_empty(), "{} mistakes in {} reports:\n{}", wrong.len(), reports.len(), wrong.join("\n"));
    eprintln!("{} reports compiled", reports.len());
}

/// The case files that are tried: all, or the first of each directory.
fn chosen(all: bool) -> Vec<PathBuf> {
    let mut files = Vec::new();
    corpus::all_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"), &mut files);
    if all {
        return files;
    }
    let mut seen: BTreeMap<(PathBuf, bool), usize> = BTreeMap::new();
    files.retain(|file| {
        let kind = (file.parent().unwrap().to_owned(), corpus::about_vertices(file));
        let count = seen.entry(kind).or_default();
        *count += 1;
        *count <= SAMPLE
    });
    files
}

fn name(file: &Path) -> String {
    let case = file.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")).unwrap_or(file);
    case.display().to_string()
}

/// The report of a case; none for cases that are refused.
fn report(file: &Path) -> Option<String> {
    let mut question = Question::read(file).ok()?;
    if let Question::Vertices { valences, .. } = &mut question {
        let Some(Valences::List(list)) = valences else { return None };
        list.truncate(4);
    }
    Some(latex::render(&findings::proof(&prove(&question, &Budget::default()).ok()?)))
}

/// Preamble and body of a report.
fn parts(text: &str) -> (&str, &str) {
    let (preamble, rest) = text.split_once("\\title{").expect("a title");
    let (_, body) = rest.split_once("\\maketitle").expect("a body");
    (preamble, body.strip_suffix("\\end{document}\n").expect("an end"))
}

/// What is wrong with the reports of a batch, which are set one after the other in one document.
fn mistakes(batch: &[&(String, String)], dir: &Path, k: usize) -> Vec<String> {
    let mut text = format!("{}\\begin{{document}}\n", parts(&batch[0].1).0);
    for (at, (_, report)) in batch.iter().enumerate() {
        text.push_str(&format!("\\typeout{{REPORT {at}}}\n{}\n\\clearpage\n", parts(report).1));
    }
    text.push_str("\\end{document}\n");
    std::fs::write(dir.join(format!("{k}.tex")), text).unwrap();
    let log = match compiled(dir, &k.to_string()) {
        Ok(log) => log,
        Err(error) => {
            // The last report that was begun has the mistake.
            let at = error.rsplit("REPORT ").next().and_then(|t| t.split_whitespace().next()?.parse::<usize>().ok());
            let start = error.find("\n!").unwrap_or(0);
            let shown: String = error[start..].chars().take(400).collect();
            return vec![format!("{}: {shown}", at.map_or("?", |at| &batch[at].0))];
        }
    };
    let mut wrong = Vec::new();
    for section in log.split("\nREPORT ").skip(1) {
        let at: usize = section.split_whitespace().next().and_then(|n| n.parse().ok()).expect("a number");
        let widths =
            section.split("Overfull \\hbox (").skip(1).filter_map(|w| w.split("pt").next()?.parse::<f64>().ok());
        let widest = widths.fold(0.0, f64::max);
        if widest > STICKS_OUT {
            wrong.push(format!("{}: a line sticks out by {widest} pt", batch[at].0));
        }
    }
    assert_eq!(log.matches("\nREPORT ").count(), batch.len(), "all reports were set");
    wrong
}

/// The log of a run of TeX, or what it says about a mistake.
fn compiled(dir: &Path, stem: &str) -> Result<String, String> {
    let run = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", &format!("{stem}.tex")])
        .current_dir(dir)
        .output()
        .expect("pdflatex is installed");
    let log = String::from_utf8_lossy(&run.stdout).into_owned();
    if run.status.success() { Ok(log) } else { Err(log) }
}
