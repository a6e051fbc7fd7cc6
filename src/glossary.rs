//! The words of `docs/glossary.md`, for `secant explain` and for readers.

use std::sync::OnceLock;

/// A word and what it means, in the markup of [`crate::report::document::line`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub name: String,
    /// What it means.
    pub text: String,
}

/// All words, in the order of the page.
#[must_use]
pub fn words() -> &'static [Word] {
    static WORDS: OnceLock<Vec<Word>> = OnceLock::new();
    WORDS.get_or_init(|| read(include_str!("../docs/glossary.md")))
}

/// The word that a user means: capitals do not matter, nor an `s` at the end.
///
/// # Examples
/// ```
/// assert!(secant::glossary::word("Rings").is_some());
/// assert!(secant::glossary::word("nonsense").is_none());
/// ```
#[must_use]
pub fn word(text: &str) -> Option<&'static Word> {
    let wanted = plain(text);
    let is = |w: &&Word| {
        let name = plain(&w.name);
        // `U` and `X` are no words in small letters.
        w.name == text || (name.len() > 1 && (name == wanted || wanted.strip_suffix('s') == Some(name.as_str())))
    };
    words().iter().find(is)
}

fn plain(text: &str) -> String {
    text.trim().to_lowercase().replace(['-', '_'], " ").replace('¹', "1").replace('τ', "tau")
}

/// Every section of the page is a word.
fn read(page: &str) -> Vec<Word> {
    let section = |section: &str| {
        let (name, text) = section.split_once('\n')?;
        Some(Word { name: name.trim().to_owned(), text: text.split_whitespace().collect::<Vec<_>>().join(" ") })
    };
    page.split("\n## ").skip(1).filter_map(section).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_section_is_a_word() {
        let page = include_str!("../docs/glossary.md");
        assert_eq!(words().len(), page.matches("\n## ").count());
        assert!(words().len() >= 30);
        let names: BTreeSet<_> = words().iter().map(|w| &w.name).collect();
        assert_eq!(names.len(), words().len());
        assert!(words().iter().all(|w| w.text.ends_with('.')), "every text is a sentence");
        for (text, name) in [("ring", "ring"), ("d*", "D*"), ("U", "U"), ("g1", "G¹"), ("half tangent", "half-tangent")]
        {
            assert_eq!(word(text).map(|w| w.name.as_str()), Some(name));
        }
    }
}
