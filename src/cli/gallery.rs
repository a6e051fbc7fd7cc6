//! `secant gallery`: all cases on one page, with a report for each.

use super::many::kinds;
use super::output::{complain, print, write_file};
use super::progress::Progress;
use super::{BAD_INPUT, GalleryArgs, PROVED, REFUTED};
use crate::case::Case;
use crate::diagnostic::Problem;
use crate::report::html::escaped;
use crate::report::{figures, html, proof, words};
use crate::theorem::surface::certify_complex;
use crate::theorem::{Certified, Verdict};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

const STYLE: &str = include_str!("../report/style.css");
const MORE_STYLE: &str = "main { max-width: 72rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: 1rem; list-style: none; padding: 0; }
.cards li { border: 1px solid var(--line); border-radius: 6px; padding: .7rem; }
.cards svg { display: block; width: 100%; height: 8rem; }
.cards h3 { margin: .4rem 0 .2rem; font-size: 1rem; overflow-wrap: anywhere; }
.cards p { margin: .2rem 0; font-size: .88rem; line-height: 1.4; }
.sc-c, .sc-s { fill: none; stroke: var(--link); stroke-width: 5; stroke-linejoin: round; stroke-linecap: round; }
";

/// One entry of the page.
struct Entry {
    family: String,
    stem: String,
    card: String,
    report: Option<String>,
}

/// Writes the page and the reports, or checks the page.
pub fn run(args: &GalleryArgs) -> u8 {
    match make(args) {
        Ok(code) => code,
        Err(problem) => {
            complain(&problem);
            BAD_INPUT
        }
    }
}

fn make(args: &GalleryArgs) -> Result<u8, Problem> {
    let files = case_files(&args.cases)?;
    let progress = Progress::new(files.len(), false);
    let entries: Vec<Entry> = files
        .par_iter()
        .map(|path| {
            let entry = entry(path, !args.check);
            progress.step();
            entry
        })
        .collect();
    progress.finish();
    let page = page(&entries);
    let index = args.out.join("index.html");
    if args.check {
        let current = std::fs::read_to_string(&index).is_ok_and(|old| old == page);
        if !current {
            complain(
                &Problem::new("secant::gallery", format!("{} is not current", index.display()))
                    .with_help("run `secant gallery` and commit the page"),
            );
        }
        return Ok(if current { PROVED } else { REFUTED });
    }
    let problem = |error: std::io::Error| {
        Problem::new("secant::output", format!("{} cannot be made: {error}", args.out.display()))
            .with_help("--out names a directory that can be written to")
    };
    for entry in &entries {
        if let Some(report) = &entry.report {
            let directory = args.out.join(&entry.family);
            std::fs::create_dir_all(&directory).map_err(problem)?;
            write_file(&directory.join(format!("{}.html", entry.stem)), report)?;
        }
    }
    std::fs::create_dir_all(&args.out).map_err(problem)?;
    write_file(&index, &page)?;
    print(&format!("{}: {}\n", index.display(), words::count(entries.len(), "case")));
    Ok(PROVED)
}

/// The case files in the subdirectories, by family and name.
fn case_files(root: &Path) -> Result<Vec<PathBuf>, Problem> {
    let problem = |error: std::io::Error| {
        Problem::new("secant::case::unreadable", format!("{} cannot be read: {error}", root.display()))
            .with_help("give the directory that holds the families of cases, such as cases")
    };
    let mut files = Vec::new();
    for family in std::fs::read_dir(root).map_err(problem)? {
        let family = family.map_err(problem)?.path();
        if !family.is_dir() {
            continue;
        }
        for file in std::fs::read_dir(&family).map_err(problem)? {
            let file = file.map_err(problem)?.path();
            if file.extension().is_some_and(|e| e == "toml") {
                files.push(file);
            }
        }
    }
    files.sort();
    Ok(files)
}

fn entry(path: &Path, with_report: bool) -> Entry {
    let part = |p: Option<&std::ffi::OsStr>| p.map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let family = part(path.parent().and_then(Path::file_name));
    let stem = part(path.file_stem());
    let done = Case::read(path).and_then(|case| {
        let found =
            certify_complex(&case.complex(), &case.examine).map_err(|e| super::certify::model_problem(&case, &e))?;
        Ok((case, found))
    });
    let (card, report) = match &done {
        Ok((case, found)) => {
            let report = with_report.then(|| html::render(&proof::document(case, found)));
            (card(&family, &stem, case, found), report)
        }
        Err(problem) => (refused_card(&stem, problem), None),
    };
    Entry { family, stem, card, report }
}

fn card(family: &str, stem: &str, case: &Case, found: &Certified) -> String {
    let picture = figures::attractor(case, found).map(|p| p.thumbnail).unwrap_or_default();
    let class = match found.verdict {
        Verdict::Proved => "good",
        Verdict::Refuted => "bad",
        Verdict::Undetermined => "open",
    };
    format!(
        "<li>{picture}<h3><a href=\"{}/{}.html\">{}</a></h3>\n<p>{}</p>\n<p><strong class=\"{class}\">{}</strong>: {}</p></li>\n",
        escaped(family),
        escaped(stem),
        escaped(stem),
        escaped(&case.title),
        found.verdict.word(),
        escaped(&kinds(found).join(", "))
    )
}

fn refused_card(stem: &str, problem: &Problem) -> String {
    format!(
        "<li><h3>{}</h3>\n<p><strong class=\"neutral\">refused</strong>: {}</p>\n<p><code>{}</code></p></li>\n",
        escaped(stem),
        escaped(problem.message()),
        escaped(problem.id())
    )
}

fn page(entries: &[Entry]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>secant: gallery of cases</title>\n<style>\n{STYLE}{MORE_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>Gallery of cases</h1>\n<p>Every case of the repository with its verdict; the names lead to the proofs, which \
         <code>secant gallery</code> writes beside this page.</p>\n"
    );
    let mut family = "";
    for entry in entries {
        if entry.family != family {
            if !family.is_empty() {
                out.push_str("</ul>\n");
            }
            family = &entry.family;
            out.push_str(&format!("<h2>{}</h2>\n<ul class=\"cards\">\n", escaped(family)));
        }
        out.push_str(&entry.card);
    }
    if !family.is_empty() {
        out.push_str("</ul>\n");
    }
    out.push_str("</main>\n</body>\n</html>\n");
    out
}
