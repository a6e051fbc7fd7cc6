//! What a check answers, and how a premise is stated.

use crate::claim::Decided;
use std::fmt;

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
    /// What was proved or refuted.
    pub claims: Vec<Decided>,
    /// What the claims rest on: points of curves and surfaces, blocks and orders of a radius.
    pub points: Vec<Decided>,
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

/// A rejection, which has no place yet.
pub fn reject<T>(rule: &str, why: impl fmt::Display) -> Checked<T> {
    Err(Rejected { rule: rule.to_owned(), place: String::new(), why: why.to_string(), unreadable: false })
}

/// The same, unless a premise holds.
pub fn need(holds: bool, rule: &str, why: impl fmt::Display) -> Checked<()> {
    if holds { Ok(()) } else { reject(rule, why) }
}

/// The same for something that must exist.
pub fn some<T>(found: Option<T>, rule: &str, why: impl fmt::Display) -> Checked<T> {
    match found {
        Some(found) => Ok(found),
        None => reject(rule, why),
    }
}

/// Marks a rejection as that of a text that cannot be read.
pub fn unreadable<T>(read: Checked<T>) -> Checked<T> {
    read.map_err(|r| Rejected { unreadable: true, ..r })
}

/// `1, 2, 3`.
pub fn list<T: fmt::Display>(items: &[T]) -> String {
    items.iter().map(T::to_string).collect::<Vec<_>>().join(", ")
}

/// The verdict on several questions together, the least; there is none on no questions.
pub fn together(verdicts: impl IntoIterator<Item = Verdict>) -> Verdict {
    match verdicts.into_iter().min() {
        Some(verdict) => verdict,
        None => Verdict::Undetermined,
    }
}
