//! `secant gallery`: all cases on one page, with a report for each.

use super::cards::{Entry, FAILED, OPEN, REFUSED, Report, entry, is_selected};
use super::output::{complain, print, settle, write_file};
use super::progress::Progress;
use super::{INTERNAL, PROVED, REFUTED};
use crate::diagnostic::Problem;
use crate::report::html::escaped;
use crate::report::words;
use crate::theorem::Verdict;
use clap::Args;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const STYLE: &str = include_str!("../report/style.css");
const MORE_STYLE: &str = include_str!("gallery.css");
const SCRIPT: &str = include_str!("gallery.js");

#[derive(Debug, Args)]
pub struct GalleryArgs {
    /// The directory with the cases: in directories of it, one for each family, or in itself.
    #[arg(default_value = "cases", value_name = "CASES")]
    cases: PathBuf,
    /// Write a report for every case, not only for a selection.
    #[arg(long, visible_alias = "all", conflicts_with = "check")]
    reports: bool,
    /// Where the page is written.
    #[arg(long, default_value = "docs/gallery", value_name = "DIR")]
    out: PathBuf,
    /// Write nothing; fail if the page is not what it would be.
    #[arg(long)]
    check: bool,
}

/// Writes the page and the reports, or checks the page.
pub fn run(args: &GalleryArgs) -> u8 {
    settle(make(args))
}

fn make(args: &GalleryArgs) -> Result<u8, Problem> {
    let files = case_files(&args.cases)?;
    if files.is_empty() {
        return Err(Problem::new("secant::gallery", format!("{} has no cases", args.cases.display())).with_help(
            "the cases of a gallery are in a directory, or in directories of it, one for each family: DIR/FAMILY/CASE.toml",
        ));
    }
    let progress = Progress::new(files.len(), false);
    let any = files.iter().any(|path| is_selected(path));
    let wanted = |path: &Path| match (args.reports || !any, args.check) {
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

/// The case files in a directory and in its subdirectories, by family and name.
fn case_files(root: &Path) -> Result<Vec<PathBuf>, Problem> {
    let problem = |error: std::io::Error| {
        Problem::new("secant::case::unreadable", format!("{} cannot be read: {error}", root.display()))
            .with_help("give the directory that holds the families of cases, such as cases")
    };
    let mut files = Vec::new();
    let is_case = |path: &Path| path.is_file() && path.extension().is_some_and(|e| e == "toml");
    for entry in std::fs::read_dir(root).map_err(problem)? {
        let entry = entry.map_err(problem)?.path();
        if is_case(&entry) {
            files.push(entry);
            continue;
        }
        if !entry.is_dir() {
            continue;
        }
        for file in std::fs::read_dir(&entry).map_err(problem)? {
            let file = file.map_err(problem)?.path();
            if is_case(&file) {
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
         coordinates; of schemes at extraordinary vertices, the characteristic map. Titles that are links lead to proofs; \
         <code>secant gallery --reports</code> writes those of all cases beside this page.</p>\n{}",
        words::count(entries.len(), "case"),
        number(Verdict::Proved.word()),
        number(Verdict::Refuted.word()),
        number(Verdict::Undetermined.word()),
        number(OPEN),
        number(REFUSED),
        filters(entries)
    );
    let mut family = None;
    for entry in entries {
        if family != Some(&entry.family) {
            if family.is_some() {
                out.push_str("</ul>\n</section>\n");
            }
            family = Some(&entry.family);
            let (title, about) = heading(&entry.family);
            out.push_str(&format!("<section>\n<h2>{}</h2>\n", escaped(&title)));
            if let Some(about) = about {
                out.push_str(&format!("<p>{}</p>\n", escaped(about)));
            }
            out.push_str("<ul class=\"cards\">\n");
        }
        let kinds: Vec<String> = entry.kinds.iter().map(|k| escaped(k)).collect();
        out.push_str(&format!(
            "<li data-verdict=\"{}\" data-kinds=\"{}\">{}</li>\n",
            escaped(entry.verdict),
            kinds.join(";"),
            entry.card
        ));
    }
    if family.is_some() {
        out.push_str("</ul>\n</section>\n");
    }
    out.push_str(&format!("</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"));
    out
}

/// The search and the filters, which the script of the page shows.
fn filters(entries: &[Entry]) -> String {
    let verdicts = ["proved", "refuted", "undetermined", OPEN, REFUSED, FAILED];
    let verdicts = verdicts.iter().filter(|v| entries.iter().any(|e| e.verdict == **v));
    let kinds: BTreeSet<&str> = entries.iter().flat_map(|e| &e.kinds).map(String::as_str).collect();
    let option = |word: &str| format!("<option>{}</option>", escaped(word));
    let verdicts: String = verdicts.map(|v| option(v)).collect();
    let kinds: String = kinds.into_iter().map(option).collect();
    format!(
        "<form class=\"filters\" role=\"search\" hidden>\n\
         <label>Search <input type=\"search\" name=\"text\" autocomplete=\"off\"/></label>\n\
         <label>Verdict <select name=\"verdict\"><option value=\"\">all</option>{verdicts}</select></label>\n\
         <label>With a point that is <select name=\"kind\"><option value=\"\">of any kind</option>{kinds}</select></label>\n\
         <output aria-live=\"polite\"></output>\n</form>\n"
    )
}

/// A family of the project's own cases for people: its title, and a sentence.
const FAMILIES: [(&str, &str, &str); 21] = [
    ("automata", "Automata", "Several states that lead to one another."),
    ("bspline", "B-splines", "Their masks as operators in barycentric space."),
    ("classical", "Classical curves", "Koch, Takagi, Lévy and others, as affine maps of the plane."),
    ("contraction", "Contraction", "No words of feasible length have a 1-norm below 1; a polytope shows contraction."),
    ("control", "Control points", "They kill directions, make double points, and change what is seen."),
    ("counterexamples", "Counter-examples", "A program that forgets a hypothesis fails here."),
    ("faces", "Faces", "Surface patches with their edges and vertices."),
    ("fif", "Fractal interpolation", "Graphs of functions through given points."),
    ("irrational", "Irrational eigenvalues", "Directions over number fields, compared exactly."),
    ("junction", "Junctions", "Intermediate curves between two schemes."),
    ("refused", "Refused", "Files that must be refused, with the reason."),
    ("reversed", "Reversed pieces", "Pieces that run backwards."),
    ("schemes", "Subdivision schemes", "Masks of the literature and their limits."),
    ("self-affine", "Self-affine curves", "Affine maps that are no similarities."),
    ("sets", "Sets", "Shapes without an order of their points."),
    ("singular", "Singular operators", "Operators with a kernel, and shapes that are a point."),
    ("solve", "Open entries", "What identities force (secant solve)."),
    ("spectra", "Spectra", "Ties of moduli and Jordan blocks."),
    ("surfaces", "Surfaces", "Patches, tensor products, and mesh rules at extraordinary vertices."),
    ("thesis", "The thesis", "Its own examples."),
    ("two-parameter", "Corner cutting", "The family with two parameters."),
];

fn heading(family: &str) -> (String, Option<&'static str>) {
    match FAMILIES.iter().find(|f| f.0 == family) {
        Some((_, title, about)) => ((*title).to_owned(), Some(about)),
        None => (family.to_owned(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_are_in_order_and_the_cases_have_their_headings() {
        assert!(FAMILIES.windows(2).all(|w| w[0].0 < w[1].0));
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
        for (family, ..) in FAMILIES {
            assert!(root.join(family).is_dir(), "{family}");
        }
    }
}
