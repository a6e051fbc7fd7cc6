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
.sc-c, .sc-s { fill: none; stroke: var(--link); stroke-width: 4; stroke-linejoin: round; stroke-linecap: round; }
";

/// Cases whose reports are written without `--all`: one of each kind.
const SELECTED: [&str; 10] = [
    "classical/levy",
    "classical/takagi",
    "control/bezier-cusp",
    "counterexamples/null-witness",
    "counterexamples/own-end-point",
    "fif/integral",
    "irrational/regular-sqrt-2",
    "junction/m1-5-jordan-3",
    "thesis/half-tangent",
    "two-parameter/corner-34-100",
];

/// One entry of the page.
struct Entry {
    family: String,
    stem: String,
    card: String,
    verdict: &'static str,
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
            // Cases about the vertices of a mesh have tables of their own, not one shape to draw.
            if file.extension().is_some_and(|e| e == "toml") && !super::vertex::is_about_vertices(&file) {
                files.push(file);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Whether the report of a case is linked, and written now.
#[derive(Clone, Copy)]
struct Report {
    linked: bool,
    written: bool,
}

/// The family and the name of a case file.
fn names(path: &Path) -> (String, String) {
    let part = |p: Option<&std::ffi::OsStr>| p.map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    (part(path.parent().and_then(Path::file_name)), part(path.file_stem()))
}

fn is_selected(path: &Path) -> bool {
    let (family, stem) = names(path);
    SELECTED.contains(&format!("{family}/{stem}").as_str())
}

fn entry(path: &Path, wanted: Report) -> Entry {
    let (family, stem) = names(path);
    let done = Case::read(path).and_then(|case| {
        let found =
            certify_complex(&case.complex(), &case.examine).map_err(|e| super::certify::model_problem(&case, &e))?;
        Ok((case, found))
    });
    let (card, verdict, report) = match &done {
        Ok((case, found)) => {
            let report = wanted.written.then(|| html::render(&proof::document(case, found)));
            (card(&family, &stem, case, found, wanted.linked), found.verdict.word(), report)
        }
        Err(problem) => (refused_card(&stem, problem), "refused", None),
    };
    Entry { family, stem, card, verdict, report }
}

fn card(family: &str, stem: &str, case: &Case, found: &Certified, linked: bool) -> String {
    let picture = figures::attractor(case, found).map(|p| p.thumbnail).unwrap_or_default();
    let class = match found.verdict {
        Verdict::Proved => "good",
        Verdict::Refuted => "bad",
        Verdict::Undetermined => "open",
    };
    let name = escaped(stem);
    let name = if linked { format!("<a href=\"{}/{name}.html\">{name}</a>", escaped(family)) } else { name };
    format!(
        "<li>{picture}<h3>{name}</h3>\n<p>{}</p>\n<p><strong class=\"{class}\">{}</strong>: {}</p></li>\n",
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
    let number = |verdict: &str| entries.iter().filter(|e| e.verdict == verdict).count();
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>secant: gallery of cases</title>\n<style>\n{STYLE}{MORE_STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>Gallery of cases</h1>\n<p>{}: {} proved, {} refuted, {} undetermined, {} refused. The pictures show the shapes in the plane of \
         their control points, or projected from barycentric coordinates. Names that are links lead to proofs; <code>secant gallery --all</code> writes \
         those of all cases beside this page.</p>\n",
        words::count(entries.len(), "case"),
        number("proved"),
        number("refuted"),
        number("undetermined"),
        number("refused")
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
