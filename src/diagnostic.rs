//! What a user did wrong: a code, the place in the file, and how to mend it.

use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Longest source line that is printed below a message.
#[cfg(feature = "fancy")]
const MAX_LINE: usize = 240;

/// The text of an input file and the name under which it is shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceText {
    /// Path of the file as the user wrote it, or `<stdin>`.
    pub name: String,
    /// Its whole text.
    pub text: Arc<str>,
}

impl SourceText {
    /// A text under a name.
    #[must_use]
    pub fn new(name: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// Line and column, both from 1, of a byte offset. Offsets past the end count as the end.
    #[must_use]
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let before = &self.text.as_bytes()[..offset.min(self.text.len())];
        let line = before.iter().filter(|b| **b == b'\n').count() + 1;
        let column = before.iter().rev().take_while(|b| **b != b'\n').count() + 1;
        (line, column)
    }

    #[cfg(feature = "fancy")]
    fn longest_line(&self, span: &Range<usize>) -> usize {
        let end = span.end.min(self.text.len());
        let (first, last) = (self.position(span.start).0, self.position(end).0);
        self.text.lines().skip(first.saturating_sub(2)).take(last - first + 3).map(str::len).max().unwrap_or(0)
    }
}

/// A mistake in the input, with its code, place and remedy; a defect of the program itself has the code
/// [`Problem::INTERNAL`].
///
/// It implements [`miette::Diagnostic`]; with the feature `fancy`, `render` prints it as the program does.
#[derive(Clone)]
pub struct Problem(Box<Inner>);

#[derive(Clone)]
struct Inner {
    code: String,
    message: String,
    help: Option<String>,
    labels: Vec<(Range<usize>, Option<String>)>,
    source: Option<SourceText>,
    shown: Option<NamedSource<String>>,
}

impl Problem {
    /// The code of a defect of the program itself (see [`crate::guard`]).
    pub const INTERNAL: &str = "secant::internal";

    /// The code of work that was told to stop (see [`crate::stop`]).
    pub const STOPPED: &str = "secant::stopped";

    /// A problem with a code such as `secant::case::sum` and one sentence saying what is wrong.
    #[must_use]
    pub fn new(code: impl Into<String>, message: impl AsRef<str>) -> Self {
        Self(Box::new(Inner {
            code: code.into(),
            message: printable(message.as_ref()),
            help: None,
            labels: Vec::new(),
            source: None,
            shown: None,
        }))
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn with_help(mut self, help: impl AsRef<str>) -> Self {
        self.0.help = Some(printable(help.as_ref()));
        self
    }

    /// Adds the file in which the labels lie.
    #[must_use]
    pub fn with_source(mut self, source: &SourceText) -> Self {
        self.0.source = Some(source.clone());
        self
    }

    /// Marks a stretch of bytes of the file, with a note. The first label is where the problem is reported.
    #[must_use]
    pub fn with_label(mut self, span: Range<usize>, note: impl AsRef<str>) -> Self {
        self.0.labels.push((span, Some(printable(note.as_ref()))));
        self
    }

    /// Marks a further stretch of bytes without a note.
    #[must_use]
    pub fn with_mark(mut self, span: Range<usize>) -> Self {
        self.0.labels.push((span, None));
        self
    }

    /// The code, such as `secant::case::sum`.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.0.code
    }

    /// Whether this is a defect of the program, and not of the input.
    #[must_use]
    pub fn is_internal(&self) -> bool {
        self.0.code == Self::INTERNAL
    }

    /// What is wrong, in one sentence.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// How to mend it.
    #[must_use]
    pub fn remedy(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Line and column, from 1, of the first label.
    #[must_use]
    pub fn position(&self) -> Option<(usize, usize)> {
        let (span, _) = self.0.labels.first()?;
        Some(self.0.source.as_ref()?.position(span.start))
    }

    /// The name of the file in which the problem lies.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        self.0.source.as_ref().map(|s| s.name.as_str())
    }

    /// The problem as text of at most 80 columns, with the lines of the file that it concerns.
    ///
    /// Lines too long to be read are not shown; the place is then given as `file:line:column`.
    #[cfg(feature = "fancy")]
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        use miette::{GraphicalReportHandler, GraphicalTheme};
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        let handler = GraphicalReportHandler::new_themed(theme).with_width(80).with_links(false);
        let mut out = String::new();
        let shown = self.for_display();
        if handler.render_report(&mut out, &shown).is_err() {
            return format!("{}: {}\n", self.0.code, self.0.message);
        }
        out
    }

    #[cfg(feature = "fancy")]
    fn for_display(&self) -> Self {
        let mut shown = self.clone();
        let Some(source) = &self.0.source else { return shown };
        if self.0.labels.is_empty() || self.0.labels.iter().any(|(span, _)| source.longest_line(span) > MAX_LINE) {
            let place = match self.position() {
                Some((line, column)) => format!("{}:{line}:{column}", source.name),
                None => source.name.clone(),
            };
            shown.0.message = format!("{}: {}", printable(&place), self.0.message);
        } else {
            shown.0.shown = Some(NamedSource::new(printable(&source.name), masked(&source.text)));
        }
        shown
    }
}

/// Control characters must not reach a terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}

/// The same, without changing a byte offset.
#[cfg(feature = "fancy")]
fn masked(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() && !matches!(c, '\n' | '\t' | '\r') {
            out.extend(std::iter::repeat_n('?', c.len_utf8()));
        } else {
            out.push(c);
        }
    }
    out
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.0.code, self.0.message)?;
        match (self.file(), self.position()) {
            (Some(file), Some((line, column))) => write!(f, " ({file}:{line}:{column})"),
            _ => Ok(()),
        }
    }
}

impl std::error::Error for Problem {}

impl Diagnostic for Problem {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.0.code))
    }

    fn severity(&self) -> Option<Severity> {
        Some(Severity::Error)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.help.as_ref().map(|h| Box::new(h) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.shown.as_ref().map(|s| s as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.0.shown.as_ref()?;
        let labels = self.0.labels.iter().enumerate().map(|(k, (span, note))| {
            let range = (span.start, span.end.saturating_sub(span.start));
            if k == 0 {
                LabeledSpan::new_primary_with_span(note.clone(), range)
            } else {
                LabeledSpan::new_with_span(note.clone(), range)
            }
        });
        Some(Box::new(labels))
    }
}

#[cfg(all(test, feature = "fancy"))]
mod tests {
    use super::*;

    #[test]
    fn shows_place_and_remedy() {
        let source = SourceText::new("a.toml", "x = 1\ny = 2\n");
        let problem =
            Problem::new("secant::test", "no good").with_source(&source).with_label(10..11, "this").with_help("mend");
        assert_eq!(problem.position(), Some((2, 5)));
        let text = problem.render(false);
        assert!(text.contains("a.toml:2:5") && text.contains("this") && text.contains("mend"), "{text}");
        assert!(!text.contains('\u{1b}'));
    }

    #[test]
    fn escapes_do_not_reach_the_terminal() {
        let source = SourceText::new("a\u{1b}.toml", "x = \u{1b}[31m\u{9b}1\n");
        let problem = Problem::new("secant::test", "bad \u{1b}").with_source(&source).with_label(4..5, "here");
        assert!(!problem.render(false).contains(['\u{1b}', '\u{9b}']));
    }

    #[test]
    fn a_long_line_is_not_printed() {
        let source = SourceText::new("a.toml", "x".repeat(5_000));
        let text = Problem::new("secant::test", "bad").with_source(&source).with_label(7..8, "here").render(false);
        assert!(text.len() < 300 && text.contains("a.toml:1:8"), "{text}");
    }
}
