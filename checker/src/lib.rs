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
mod vertex;

use std::fmt;

/// The version of the certificate format that is read.
pub const VERSION: usize = 1;
/// Largest case or certificate in bytes.
pub const MAX_BYTES: usize = 16 << 20;
/// Longest word of a certificate or address of a case.
pub const MAX_LETTERS: usize = 1_000;

/// What follows for a question; of several questions together the least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The answer is no.
    Refuted,
    /// The certificate does not say.
    Undetermined,
    /// The answer is yes.
    Proved,
}

impl Verdict {
    /// `proved`, `refuted` or `undetermined`.
    #[must_use]
    pub fn word(self) -> &'static str {
        ["refuted", "undetermined", "proved"][self as usize]
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

fn reject<T>(rule: &str, why: impl fmt::Display) -> Checked<T> {
    Err(Rejected { rule: rule.to_owned(), place: String::new(), why: why.to_string(), unreadable: false })
}

/// A rejection, which has no place yet, unless a premise holds.
fn need(holds: bool, rule: &str, why: impl fmt::Display) -> Checked<()> {
    if holds { Ok(()) } else { reject(rule, why) }
}

/// The same for something that must exist.
fn some<T>(found: Option<T>, rule: &str, why: impl fmt::Display) -> Checked<T> {
    found.map_or_else(|| reject(rule, why), Ok)
}

/// Marks a rejection as that of a text that cannot be read.
fn unreadable<T>(read: Checked<T>) -> Checked<T> {
    read.map_err(|r| Rejected { unreadable: true, ..r })
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
    unreadable(need(case.len().max(certificate.len()) <= MAX_BYTES, "limit", "a file is too large"))?;
    number::refill();
    let tree: json::Json = unreadable(serde_json::from_str(certificate).or_else(|error| reject("json", error)))?;
    let node = json::Node { value: &tree, place: "certificate".to_owned() };
    let [format, version, kind, name, verdict, proof] = node.fields("format version kind case verdict proof")?;
    let known = format.text()? == "secant certificate" && version.index(usize::MAX)? == VERSION;
    version.need(known, "format", format_args!("this checker reads version {VERSION} only"))?;
    let proof = json::Node { place: "proof".to_owned(), ..proof };
    let found = match kind.text()? {
        "certify" => claims::check(&case::read(case, false)?, &proof)?,
        "regularity" => regularity::check(&case::read(case, false)?, &proof)?,
        "solve" => solve::check(&case::read(case, true)?, &proof)?,
        "spectrum" => jordan::check(case, &proof)?,
        "jsr" => radius::check(case, &proof)?,
        "vertex" => vertex::check(case, &proof)?,
        _ => return kind.reject("format", "unknown kind of certificate"),
    };
    number::spend(0, 0)?;
    name.need(name.text()? == found.case, "case", format_args!("the case is `{}`", found.case))?;
    verdict.follows("verdict", found.verdict.word())?;
    Ok(found)
}
