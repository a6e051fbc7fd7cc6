//! `secant gallery`: all cases on one page, with a report for each.

use super::cards::{Entry, FAILED, OPEN, REFUSED, Report, entry, is_selected};
use super::output::{complain, print, settle, write_file};
use super::progress::Progress;
use super::{GalleryArgs, INTERNAL, PROVED, REFUTED};
use crate::diagnostic::Problem;
use crate::report::html::escaped;
use crate::report::words;
use crate::theorem::Verdict;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

const STYLE: &str = include_str!("../report/style.css");
const MORE_STYLE: &str = "main { max-width: 72rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: 1rem; list-style: none; padding: 0; }
.cards li { border: 1px solid var(--line); border-radius: 6px; padding: .7rem; }
.cards svg { display: block; width: 100%; height: 8rem; }
.cards h3 { margin: .4rem 0 .2rem; font-size: 1rem; overflow-wrap: anywhere; }
.cards p { margin: .2rem 0; font-size: .88rem; line-height: 1.4; }
.sc-c, .sc-s { fill: none; stroke: var(--link); stroke-width: 4; stroke-linejoin: round; stroke-linecap: round; }
.sc-v { fill: none; stroke: var(--link); stroke-width: .7; stroke-linejoin: round; }
";

/// Writes the page and the reports, or checks the page.
pub fn run(args: &GalleryArgs) -> u8 {
    settle(make(args))
}

fn make(args: &GalleryArgs) -> Result<u8, Problem> {
    let files = case_files(&args.cases)?;
    if files.is_empty() {
        let message = format!("{} has no directories with cases", args.cases.display());
        return Err(Problem::new("secant::gallery", message)
            .with_help("the cases of a gallery are in directories of it, one for each family: DIR/FAMILY/CASE.toml"));
    }
    let progress = Progress::new(files.len(), false);
    let any = files.iter().any(|path| is_selected(path));
    let wanted = |path: &Path| match (args.all || !any, args.check) {
        (true, check) => Report { linked: true, written: !check },
        (false, check) => Report { linked: is_selected(path), written: is_selected(path) && !check },
    };
    let entries: Vec<Entry> = files
        .par_iter()
        .map(|path| {
            let entry = entry(path, wanted(path));
            progress.step();
            entry
        })
        .collect();
    progress.finish();
    let page = page(&entries);
    let index = args.out.join("index.html");
    let failed: Vec<&Entry> = entries.iter().filter(|e| e.verdict == FAILED).collect();
    for entry in &failed {
        let message = format!("{}/{}: the program failed on this case", entry.family, entry.stem);
        complain(&Problem::new(Problem::INTERNAL, message).with_help("its card says why; please report it"));
    }
    if args.check {
        let current = std::fs::read_to_string(&index).is_ok_and(|old| old == page);
        if !current {
            complain(
                &Problem::new("secant::gallery", format!("{} is not current", index.display()))
                    .with_help("run `secant gallery` and commit the page"),
            );
        }
        return Ok(match (current, failed.is_empty()) {
            (_, false) => INTERNAL,
            (true, true) => PROVED,
            (false, true) => REFUTED,
        });
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
    Ok(if failed.is_empty() { PROVED } else { INTERNAL })
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

fn page(entries: &[Entry]) -> String {
    let number = |verdict: &str| entries.iter().filter(|e| e.verdict == verdict).count();
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>secant: gallery of cases</title>\n<style>\n{STYLE}{MORE_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>Gallery of cases</h1>\n<p>{}: {} proved, {} refuted, {} undetermined; {} with open entries, which are solved for; {} that \
         must be refused, with the reason. Pictures show the shapes in the plane of their control points, or projected from barycentric \
         coordinates; of schemes at extraordinary vertices, the characteristic map. Names that are links lead to proofs; \
         <code>secant gallery --all</code> writes those of all cases beside this page.</p>\n",
        words::count(entries.len(), "case"),
        number(Verdict::Proved.word()),
        number(Verdict::Refuted.word()),
        number(Verdict::Undetermined.word()),
        number(OPEN),
        number(REFUSED)
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
