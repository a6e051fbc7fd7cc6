//! Checks a secant certificate against its case, by the rules of `docs/certificate.md` and without any search.
//!
//! No code is shared with secant: this crate reads the case file itself, computes everything that is plain rational linear
//! algebra again, and takes from the certificate only what had to be found. All arithmetic is exact.

pub mod case;
mod claims;
mod everywhere;
mod germ;
mod jordan;
pub mod json;
pub mod matrix;
pub mod number;
mod points;
pub mod poly;
mod radius;
mod rate;
mod regularity;
mod ring;
mod rules;
pub mod shape;
mod solve;
mod spectrum;
mod surface;
mod vertex;

use std::fmt;

/// The version of the certificate format that is read.
pub const VERSION: usize = 1;
/// Largest case or certificate in bytes.
pub const MAX_BYTES: usize = 16 << 20;
/// Longest word of a certificate or address of a case.
pub const MAX_LETTERS: usize = 1_000;

/// What follows for a question.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The answer is yes.
    Proved,
    /// The answer is no.
    Refuted,
    /// The certificate does not say.
    Undetermined,
}

impl Verdict {
    /// `proved`, `refuted` or `undetermined`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Undetermined => "undetermined",
        }
    }

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Refuted, _) | (_, Self::Refuted) => Self::Refuted,
            (Self::Proved, Self::Proved) => Self::Proved,
            _ => Self::Undetermined,
        }
    }
}

/// A certificate that was checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Accepted {
    /// The name of the case.
    pub case: String,
    /// The verdict on all questions of the case together.
    pub verdict: Verdict,
    /// What was proved or refuted, one claim a line.
    pub claims: Vec<String>,
    /// The points with their verdicts and kinds, one a line.
    pub points: Vec<String>,
}

/// Why a certificate proves nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rejected {
    /// The rule whose premise fails.
    pub rule: String,
    /// Where in the certificate.
    pub place: String,
    /// What is wrong.
    pub why: String,
    /// Whether the case or the certificate could not be read at all.
    pub unreadable: bool,
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = if self.unreadable { "unreadable" } else { "rejected" };
        write!(f, "{word}: {}, {}, {}", self.rule, if self.place.is_empty() { "-" } else { &self.place }, self.why)
    }
}

impl std::error::Error for Rejected {}

/// What holds, or why it is not seen to.
pub type Checked<T> = Result<T, Rejected>;

fn reject<T>(rule: &str, place: &str, why: impl Into<String>) -> Checked<T> {
    Err(Rejected { rule: rule.to_owned(), place: place.to_owned(), why: why.into(), unreadable: false })
}

/// A rejection without a place unless a premise holds.
fn need(holds: bool, rule: &str, why: &str) -> Checked<()> {
    if holds { Ok(()) } else { reject(rule, "", why) }
}

/// Gives a rejection that has no place yet one.
fn at<T>(place: &str, result: Checked<T>) -> Checked<T> {
    result.map_err(|r| if r.place.is_empty() { Rejected { place: place.to_owned(), ..r } } else { r })
}

/// Checks a certificate (JSON) against the text of what it is about (a case, in TOML, where its kind is `certify`).
///
/// All kinds share the envelope that is read here; the rules of a kind are in a module of its own, which reads the first
/// text as that kind of input and says what `proof` proves about it.
///
/// # Errors
/// [`Rejected`] with the rule, the place and the reason; `unreadable` is set where one of the two texts could not be read.
///
/// # Cost
/// Bounded: the files by [`MAX_BYTES`], the nesting by 128, the numbers by 10000 digits, the arithmetic by a budget.
pub fn check(case: &str, certificate: &str) -> Checked<Accepted> {
    let unreadable =
        |rule: &str, why: String| Err(Rejected { rule: rule.to_owned(), place: String::new(), why, unreadable: true });
    if case.len() > MAX_BYTES || certificate.len() > MAX_BYTES {
        return unreadable("limit", "a file is too large".to_owned());
    }
    number::refill();
    let tree: json::Json = match serde_json::from_str(certificate) {
        Ok(tree) => tree,
        Err(error) => return unreadable("json", error.to_string()),
    };
    let node = json::Node { value: &tree, place: "certificate".to_owned() };
    let [format, version, kind, name, verdict, proof] =
        node.fields(["format", "version", "kind", "case", "verdict", "proof"])?;
    if format.text()? != "secant certificate" || version.index(usize::MAX)? != VERSION {
        return reject("format", &version.place, format!("this checker reads version {VERSION} only"));
    }
    let proof = json::Node { place: "proof".to_owned(), ..proof };
    let found = match kind.text()? {
        "certify" => claims::check(&case::read(case, false)?, &proof)?,
        "regularity" => regularity::check(&case::read(case, false)?, &proof)?,
        "solve" => solve::check(case::read(case, true)?, &proof)?,
        "spectrum" => jordan::check(case, &proof)?,
        "jsr" => radius::check(case, &proof)?,
        "surface" => surface::check(case, &proof)?,
        "vertex" => vertex::check(case, &proof)?,
        _ => return kind.malformed("unknown kind of certificate"),
    };
    number::spend(0, 0)?;
    if name.text()? != found.case {
        return reject("case", &name.place, format!("the case is `{}`", found.case));
    }
    if verdict.text()? != found.verdict.word() {
        return reject("verdict", &verdict.place, format!("what follows is \"{}\"", found.verdict.word()));
    }
    Ok(found)
}
