//! The cards of the gallery: a shape with its verdict, a scheme at extraordinary vertices, a case with open entries, a
//! case that is refused.

use crate::answer::Verdict;
use crate::ask::{answered, unsolvable};
use crate::budget::Budget;
use crate::case::{Case, Question, Valences};
use crate::diagnostic::Problem;
use crate::guard::guarded;
use crate::picture::characteristic::thumbnail;
use crate::prove::Findings;
use crate::report::html::escaped;
use crate::report::vertex::{panel, places};
use crate::report::{claims, figures, findings, html, words};
use crate::shape::Solution;
use crate::theorem::{Assertion, Certified};
use crate::vertex::{AtValence, Every};
use std::path::Path;

/// How cases with open entries are counted.
pub const OPEN: &str = "open entries";
/// How cases that are refused are counted.
pub const REFUSED: &str = "refused";
/// How cases on which the program fails are counted.
pub const FAILED: &str = "internal error";

/// Cases whose reports are written without `--all`: one of each kind.
const SELECTED: [&str; 13] = [
    "classical/levy",
    "classical/takagi",
    "control/bezier-cusp",
    "counterexamples/null-witness",
    "counterexamples/own-end-point",
    "fif/integral",
    "irrational/regular-sqrt-2",
    "junction/m1-5-jordan-3",
    "surfaces/bicubic-space",
    "surfaces/doo-sabin-frequency-2",
    "surfaces/spiral",
    "thesis/half-tangent",
    "two-parameter/corner-34-100",
];

/// Whether the report of a case is linked, and written now.
#[derive(Clone, Copy)]
pub struct Report {
    /// Whether the name of the case leads to it.
    pub linked: bool,
    /// Whether it is wanted now.
    pub written: bool,
}

/// The family and the name of a case file.
fn names(path: &Path) -> (String, String) {
    let part = |p: Option<&std::ffi::OsStr>| p.map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    (part(path.parent().and_then(Path::file_name)), part(path.file_stem()))
}

/// Whether the report of a case is written without `--all`.
pub fn is_selected(path: &Path) -> bool {
    let (family, stem) = names(path);
    SELECTED.contains(&format!("{family}/{stem}").as_str())
}

/// One entry of the page.
pub struct Entry {
    /// The directory of the case.
    pub family: String,
    /// The name of its file.
    pub stem: String,
    /// What stands on the page.
    pub card: String,
    /// The word by which it is counted.
    pub verdict: &'static str,
    /// The kinds of its points, for the filter.
    pub kinds: Vec<String>,
    /// The report, where it is wanted.
    pub report: Option<String>,
}

/// Certifies or solves a case and writes its card.
pub fn entry(path: &Path, wanted: Report) -> Entry {
    entry_by(path, wanted, &made)
}

/// The same with what makes the card of a named case; a panic there costs this card only.
fn entry_by(path: &Path, wanted: Report, make: &dyn Fn(&Path, &str, Report) -> Result<Made, Problem>) -> Entry {
    let (family, stem) = names(path);
    let made = guarded(|| make(path, &stem, wanted)).unwrap_or_else(|problem| {
        let word = if problem.is_internal() { FAILED } else { REFUSED };
        Made { card: refused(&stem, word, &problem), verdict: word, kinds: Vec::new(), report: None }
    });
    let Made { card, verdict, kinds, report } = made;
    Entry { family, stem, card, verdict, kinds, report }
}

/// What is made of a case.
struct Made {
    card: String,
    verdict: &'static str,
    kinds: Vec<String>,
    report: Option<String>,
}

fn made(path: &Path, stem: &str, wanted: Report) -> Result<Made, Problem> {
    let question = match Question::read_open(path)? {
        Question::Tangents { case, .. } if !case.unknown.is_empty() => return open(&case, stem),
        Question::Vertices { case, valences: None } => {
            Question::Vertices { case, valences: Some(Valences::List((3..=12).collect())) }
        }
        question => question,
    };
    let answered = answered(&question, true, &Budget::default(), &|| {})?;
    let report = wanted.written.then(|| html::render(&findings::proof(&answered.findings)));
    let (picture, what) = match &answered.findings {
        Findings::Tangents { case, found } => {
            let picture = figures::attractor(case, found).map(|p| p.thumbnail);
            (
                picture,
                format!(
                    "{}{}: {}",
                    marked(answered.findings.verdict()),
                    smoothness(found),
                    escaped(&answered.kinds().join(", "))
                ),
            )
        }
        Findings::OverField { case, found } => {
            let picture = figures::attractor(case, found).map(|p| p.thumbnail);
            let kinds = escaped(&answered.kinds().join(", "));
            (picture, format!("{}: {kinds}", marked(answered.findings.verdict())))
        }
        Findings::Vertices { found, every, .. } => vertices(found, every.as_ref()),
    };
    let link = wanted.linked.then(|| format!("{}/{stem}.html", names(path).0));
    let title = answered.findings.title();
    let kinds = match &answered.findings {
        Findings::Tangents { found, .. } => found.points.iter().map(|p| p.kind.word().to_owned()).collect(),
        Findings::OverField { found, .. } => found.points.iter().map(|p| p.kind.word().to_owned()).collect(),
        Findings::Vertices { .. } => Vec::new(),
    };
    Ok(Made {
        card: card(&picture.unwrap_or_default(), stem, title, link.as_deref(), &what),
        verdict: answered.findings.verdict().word(),
        kinds: distinct(kinds),
        report,
    })
}

/// Each word once, in order.
fn distinct(mut words: Vec<String>) -> Vec<String> {
    words.sort();
    words.dedup();
    words
}

/// What is known of every point, and of the parameter.
fn smoothness(found: &Certified) -> String {
    let claims = found.claims.iter().filter(|c| !c.what.is_of_tangents() && !matches!(c.what, Assertion::Exponent(..)));
    claims.map(|c| format!("; {} {}", escaped(&claims::label(&c.what)), c.verdict().word())).collect()
}

fn tone(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved => "good",
        Verdict::Refuted => "bad",
        Verdict::Undetermined => "open",
    }
}

fn marked(verdict: Verdict) -> String {
    format!("<strong class=\"{}\">{}</strong>", tone(verdict), verdict.word())
}

/// The verdicts by valence, and the characteristic map where one is refuted, or else of the first valence that is not regular.
fn vertices(found: &[AtValence], every: Option<&Every>) -> (Option<String>, String) {
    let mut parts: Vec<String> = every
        .into_iter()
        .filter(|e| e.proved())
        .map(|e| format!("proved at every valence from {} on", e.from))
        .collect();
    for kind in [Verdict::Proved, Verdict::Refuted, Verdict::Undetermined] {
        let list: Vec<&AtValence> = found.iter().filter(|f| f.smooth == kind).collect();
        if !list.is_empty() {
            parts.push(format!("{} at {}", marked(kind), places(&list)));
        }
    }
    let shown = found.iter().filter(|f| panel(f).is_some());
    let rank = |f: &&AtValence| (f.smooth != Verdict::Refuted, f.valence < 5, f.valence);
    let picture = shown.min_by_key(rank).and_then(|f| Some((panel(f)?, f.valence)));
    let picture = picture.map(|(panel, n)| thumbnail(&panel, &format!("The characteristic map at valence {n}")));
    (picture, format!("C¹: {}", parts.join("; ")))
}

/// A case with unknown entries: what its identities force.
fn open(case: &Case, stem: &str) -> Result<Made, Problem> {
    let unknowns = case.unknowns().map_err(|e| unsolvable(case, &e))?;
    let solution = unknowns.solve().map_err(|e| unsolvable(case, &e))?;
    let what = match solution {
        Solution::None(_) => "no solution".to_owned(),
        Solution::One(_) => "exactly one solution".to_owned(),
        Solution::Family(family) => {
            format!("a family with {}", words::count(family.parameters.len(), "free parameter"))
        }
    };
    let count = if unknowns.count() == 1 {
        "1 unknown entry".to_owned()
    } else {
        format!("{} unknown entries", unknowns.count())
    };
    let what = format!("<strong class=\"neutral\">{count}</strong>: {what} (<code>secant solve</code>)");
    Ok(Made { card: card("", stem, &case.title, None, &what), verdict: OPEN, kinds: Vec::new(), report: None })
}

/// A title, the name of the file where that says something else, and what was found.
fn card(picture: &str, stem: &str, title: &str, link: Option<&str>, what: &str) -> String {
    let heading = match link {
        Some(link) => format!("<a href=\"{}\">{}</a>", escaped(link), escaped(title)),
        None => escaped(title),
    };
    let name = if title == stem { String::new() } else { format!("<p class=\"name\">{}</p>\n", escaped(stem)) };
    format!("{picture}<h3>{heading}</h3>\n{name}<p>{what}</p>")
}

fn refused(stem: &str, word: &str, problem: &Problem) -> String {
    format!(
        "<h3>{}</h3>\n<p><strong class=\"neutral\">{word}</strong>: {}</p>\n<p><code>{}</code></p>",
        escaped(stem),
        escaped(problem.message()),
        escaped(problem.id())
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_that_fails_has_a_card_like_the_others() {
        let wanted = Report { linked: true, written: false };
        let failed = entry_by("cases/classical/levy.toml".as_ref(), wanted, &|_, _, _| panic!("a broken <step>"));
        assert_eq!((failed.family.as_str(), failed.stem.as_str(), failed.verdict), ("classical", "levy", FAILED));
        assert!(failed.card.contains("internal error</strong>") && failed.card.contains("a broken &lt;step&gt;"));
        assert!(failed.report.is_none());
    }
}
