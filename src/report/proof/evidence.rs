//! What was verified of the hypotheses of a statement, each under its name. The list of ticks is made by going through the
//! hypotheses of the statement, so that a report cannot leave one out.

use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::math::Math;
use crate::statement::Statement;

/// Findings about a statement, by the names of its hypotheses.
pub(super) struct Evidence {
    statement: Statement,
    given: Vec<(&'static str, Check)>,
}

/// What is wrong with a list of findings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Gap {
    /// Nothing was found about a hypothesis.
    Missing(String),
    /// The statement has no hypothesis of that name.
    Foreign(&'static str),
}

/// The words by which a test finds a report that leaves out a hypothesis.
const INCOMPLETE: &str = "This report is not complete";

impl Evidence {
    /// No findings yet.
    pub(super) fn of(statement: Statement) -> Self {
        Self { statement, given: Vec::new() }
    }

    /// One more finding about a hypothesis.
    pub(super) fn push(&mut self, name: &'static str, tone: Tone, text: Line) {
        self.given.push((name, Check { tone, text }));
    }

    /// The same for a hypothesis that holds, from markup.
    #[must_use]
    pub(super) fn holds(mut self, name: &'static str, template: &str, values: impl IntoIterator<Item = Math>) -> Self {
        self.push(name, Tone::Good, line(template, values));
        self
    }

    /// The ticks, hypothesis by hypothesis.
    ///
    /// # Errors
    /// The hypotheses without a finding, and the findings without a hypothesis.
    pub(super) fn checks(self) -> Result<Vec<Check>, Vec<Gap>> {
        let hypotheses = &self.statement.text().hypotheses;
        let foreign = self.given.iter().filter(|(name, _)| hypotheses.iter().all(|h| h.name != *name));
        let missing = hypotheses.iter().filter(|h| self.given.iter().all(|(name, _)| h.name != *name));
        let mut gaps: Vec<Gap> = missing.map(|h| Gap::Missing(h.name.clone())).collect();
        gaps.extend(foreign.map(|(name, _)| Gap::Foreign(name)));
        if !gaps.is_empty() {
            return Err(gaps);
        }
        let named = |name: &str, check: &Check| {
            let mut text = vec![Inline::Strong(name.to_owned())];
            text.extend(words(": "));
            text.extend(check.text.clone());
            Check { tone: check.tone, text }
        };
        let order = |name: &str| hypotheses.iter().position(|h| h.name == name);
        let mut checks: Vec<_> = self.given.iter().map(|(name, check)| (order(name), named(name, check))).collect();
        checks.sort_by_key(|(place, _)| *place);
        Ok(checks.into_iter().map(|(_, check)| check).collect())
    }

    /// The ticks as a list; a refusal in words where a hypothesis was forgotten.
    pub(super) fn block(self) -> Block {
        let name = self.statement.name();
        match self.checks() {
            Ok(checks) => Block::Checks(checks),
            Err(gaps) => {
                let item = |gap: &Gap| {
                    let text = match gap {
                        Gap::Missing(hypothesis) => format!("nothing is printed about the hypothesis {hypothesis}"),
                        Gap::Foreign(hypothesis) => format!("there is no hypothesis {hypothesis}"),
                    };
                    Check { tone: Tone::Bad, text: words(format!("{INCOMPLETE}: of {name} {text}.")) }
                };
                Block::Checks(gaps.iter().map(item).collect())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_forgotten_hypothesis_is_refused() {
        let all = Evidence::of(Statement::CorollaryLine).holds("nonzero", "b", []).holds("line", "a", []);
        let shown = all.checks().expect("both hypotheses have a finding");
        assert_eq!(shown[0].text[0], Inline::Strong("line".to_owned()), "in the order of the statement");
        let one = Evidence::of(Statement::CorollaryLine).holds("line", "a", []);
        assert_eq!(one.checks(), Err(vec![Gap::Missing("nonzero".to_owned())]));
        let wrong =
            Evidence::of(Statement::CorollaryLine).holds("line", "", []).holds("nonzero", "", []).holds("x", "", []);
        assert_eq!(wrong.checks(), Err(vec![Gap::Foreign("x")]));
    }
}
