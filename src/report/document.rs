//! What all reports are made of. Terminal text, Markdown, HTML and LaTeX are written from the same [`Document`], so that
//! they cannot differ in what they say.

use super::math::Math;
use crate::statement::{Hypothesis, Statement};

/// A report: a title and blocks in reading order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// The title, without markup.
    pub title: String,
    /// The blocks.
    pub blocks: Vec<Block>,
}

/// A part of a document that stands for itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Block {
    /// A heading; level 2 is the highest below the title.
    Heading(u8, Line),
    /// A paragraph.
    Paragraph(Line),
    /// A formula in a line of its own.
    Formula(Math),
    /// Points of a list.
    List(Vec<Line>),
    /// Terms with what is to be said about them.
    Facts(Vec<(String, Line)>),
    /// Conditions with what was found about them.
    Checks(Vec<Check>),
    /// A table.
    Table(Table),
    /// A statement of the theory, quoted in full.
    Statement(Statement),
    /// A picture.
    Figure {
        /// A complete SVG document.
        svg: String,
        /// The same as a TikZ picture.
        tikz: String,
        /// What can be seen, for those who cannot see it.
        alt: String,
        /// The words below it.
        caption: Line,
    },
    /// The headings of the second level that follow, as a table of contents.
    Contents(Vec<Line>),
    /// Blocks that a reader may skip, such as long lists.
    Details {
        /// What they are.
        summary: Line,
        /// The blocks.
        blocks: Vec<Block>,
    },
}

/// A condition with its state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Check {
    /// What was found.
    pub tone: Tone,
    /// The condition and why.
    pub text: Line,
}

/// A table; every row has as many cells as the header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// What it shows.
    pub caption: Line,
    /// Column heads.
    pub header: Vec<Line>,
    /// The cells.
    pub rows: Vec<Vec<Line>>,
}

/// Rows from which on a narrow table is set beside itself.
const LONG_ROWS: usize = 12;
/// Cells of a line of such a table.
const LINE_CELLS: usize = 8;

impl Table {
    /// The same, its later rows beside the earlier ones where it is long and narrow: read line by line.
    #[must_use]
    pub fn beside(self) -> Self {
        let width = self.header.len();
        let parts = LINE_CELLS / width.max(1);
        if self.rows.len() <= LONG_ROWS || parts < 2 {
            return self;
        }
        let line = |rows: &[Vec<Line>]| {
            let mut cells = rows.concat();
            cells.resize(width * parts, Line::new());
            cells
        };
        let rows = self.rows.chunks(parts).map(line).collect();
        Self { caption: self.caption, header: vec![self.header; parts].concat(), rows }
    }
}

/// Text with formulas.
pub type Line = Vec<Inline>;

/// A run of a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Inline {
    /// Plain words.
    Text(String),
    /// Words that stand out.
    Strong(String),
    /// Typewriter text: addresses, names of files.
    Code(String),
    /// A formula.
    Math(Math),
    /// A verdict or a state, coloured by its tone.
    Mark(Tone, String),
}

/// The colour of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Holds, proved.
    Good,
    /// Fails, refuted.
    Bad,
    /// Not decided.
    Open,
    /// Neither: not needed, for information.
    Neutral,
}

/// Reads `$formula$`, `**strong**` and `` `code` `` in a text; `@` stands for the next of `values`, inside a formula as a
/// part of it and outside as a formula of its own.
#[must_use]
pub fn line(template: &str, values: impl IntoIterator<Item = Math>) -> Line {
    let mut values = values.into_iter();
    let mut out = Line::new();
    let mut rest = template;
    while let Some(at) = rest.find(['$', '*', '`', '@']) {
        let (before, tail) = rest.split_at(at);
        push_text(&mut out, before);
        if let Some(tail) = tail.strip_prefix('@') {
            out.extend(values.next().map(Inline::Math));
            rest = tail;
            continue;
        }
        let Some((open, close)) = [("$", "$"), ("**", "**"), ("`", "`")].into_iter().find(|(o, _)| tail.starts_with(o))
        else {
            push_text(&mut out, &tail[..1]);
            rest = &tail[1..];
            continue;
        };
        let body = &tail[open.len()..];
        let Some(end) = body.find(close) else {
            push_text(&mut out, tail);
            return out;
        };
        out.push(match open {
            "$" => Inline::Math(Math::parse(&body[..end], &mut values)),
            "**" => Inline::Strong(body[..end].to_owned()),
            _ => Inline::Code(body[..end].to_owned()),
        });
        rest = &body[end + close.len()..];
    }
    push_text(&mut out, rest);
    out
}

fn push_text(out: &mut Line, text: &str) {
    if text.is_empty() {
        return;
    }
    if let Some(Inline::Text(last)) = out.last_mut() {
        last.push_str(text);
    } else {
        out.push(Inline::Text(text.to_owned()));
    }
}

/// A line of plain words, taken literally.
#[must_use]
pub fn words(text: impl Into<String>) -> Line {
    vec![Inline::Text(text.into())]
}

/// A line that is one piece of typewriter text, taken literally.
#[must_use]
pub fn code(text: impl Into<String>) -> Line {
    vec![Inline::Code(text.into())]
}

/// A line that is one formula.
#[must_use]
pub fn formula(math: Math) -> Line {
    vec![Inline::Math(math)]
}

/// A hypothesis with its name before it.
#[must_use]
pub fn hypothesis(h: &Hypothesis) -> Line {
    let mut out = vec![Inline::Strong(h.name.clone())];
    out.extend(words(": "));
    out.extend(line(&h.text, []));
    out
}

impl Block {
    /// A paragraph from markup (see [`line()`]).
    #[must_use]
    pub fn text(template: &str, values: impl IntoIterator<Item = Math>) -> Self {
        Self::Paragraph(line(template, values))
    }

    /// A heading from markup.
    #[must_use]
    pub fn heading(level: u8, template: &str) -> Self {
        Self::Heading(level, line(template, []))
    }
}

impl Document {
    /// Puts a table of contents at a place: the headings of the second level from there on.
    pub fn insert_contents(&mut self, at: usize) {
        let heads = self.blocks.iter().skip(at).filter_map(|b| match b {
            Block::Heading(2, text) => Some(text.clone()),
            _ => None,
        });
        let contents = Block::Contents(heads.collect());
        self.blocks.insert(at.min(self.blocks.len()), contents);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_table_stands_beside_itself() {
        let table = |rows: usize, columns: usize| Table {
            caption: Line::new(),
            header: vec![words("h"); columns],
            rows: (0..rows).map(|r| (0..columns).map(|c| words(format!("{r}.{c}"))).collect()).collect(),
        };
        let wide = table(14, 2).beside();
        assert_eq!((wide.header.len(), wide.rows.len()), (8, 4));
        assert_eq!((&wide.rows[1][0], &wide.rows[1][7]), (&words("4.0"), &words("7.1")));
        assert_eq!((&wide.rows[3][3], &wide.rows[3][4]), (&words("13.1"), &Line::new()));
        for same in [table(12, 2), table(40, 5)] {
            assert_eq!(same.clone().beside(), same);
        }
    }

    #[test]
    fn markup_splits_into_runs() {
        let read = line("so **it** is $x=@$ at `0(1)`, @ * 2", [Math::count(3), Math::count(4)]);
        assert_eq!(read.len(), 9);
        assert_eq!(read[1], Inline::Strong("it".into()));
        assert_eq!(read[5], Inline::Code("0(1)".into()));
        assert_eq!(read[7], Inline::Math(Math::count(4)));
        assert_eq!(read[8], Inline::Text(" * 2".into()));
        assert_eq!(line("open $x", []), words("open $x"));
    }
}
