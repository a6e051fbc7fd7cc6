//! Documents as text for a terminal.

use super::document::{Block, Check, Document, Inline, Line, Table, Tone, hypothesis, line};
use super::math::{Math, Spacing, parts, sign_and_size, spacing};
use unicode_width::UnicodeWidthStr;

/// Columns that a line of text may have where nobody says how many there are.
pub const WIDTH: usize = 80;

/// How a text is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// Whether headings and verdicts carry ANSI colours.
    pub colour: bool,
    /// Columns that a line may have.
    pub width: usize,
}

impl Default for Look {
    fn default() -> Self {
        Self { colour: false, width: WIDTH }
    }
}

/// Longest number that is written in full; longer ones are shortened (the JSON and the other reports have all digits).
const MAX_NUMBER: usize = 40;

/// Writes a document as text of 80 columns; with `colour`, headings and verdicts carry ANSI colours.
#[must_use]
pub fn render(document: &Document, colour: bool) -> String {
    render_as(document, Look { colour, ..Look::default() })
}

/// Writes a document as text.
#[must_use]
pub fn render_as(document: &Document, look: Look) -> String {
    let mut out = Writer { out: String::new(), look };
    out.raw(&out.painted("1", &document.title));
    out.blocks(&document.blocks, 0);
    out.out
}

struct Writer {
    out: String,
    look: Look,
}

/// A word of a line: its plain text and how it is shown.
struct Word {
    plain: String,
    shown: String,
    glued: bool,
}

impl Writer {
    fn painted(&self, style: &str, text: &str) -> String {
        if self.look.colour && !text.is_empty() { format!("\u{1b}[{style}m{text}\u{1b}[0m") } else { text.to_owned() }
    }

    fn raw(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }

    fn blocks(&mut self, blocks: &[Block], indent: usize) {
        for block in blocks {
            self.block(block, indent);
        }
    }

    fn block(&mut self, block: &Block, indent: usize) {
        let pad = " ".repeat(indent);
        match block {
            Block::Heading(_, text) => {
                self.raw("");
                let heading = plain(text);
                self.raw(&format!("{pad}{}", self.painted("1", &heading)));
            }
            Block::Paragraph(text) => self.paragraph(text, &format!("{pad}  "), &format!("{pad}  ")),
            Block::Formula(math) => {
                for row in boxed(math).lines {
                    self.raw(&format!("{pad}    {}", row.trim_end()));
                }
            }
            Block::List(items) => {
                for item in items {
                    self.paragraph(item, &format!("{pad}  - "), &format!("{pad}    "));
                }
            }
            Block::Facts(facts) => {
                let width = facts.iter().map(|(term, _)| term.width()).max().unwrap_or(0);
                for (term, text) in facts {
                    let gap = " ".repeat(width - term.width() + 2);
                    let first = format!("{pad}    {}{gap}", self.painted("2", term));
                    self.paragraph(text, &first, &format!("{pad}    {}", " ".repeat(width + 2)));
                }
            }
            Block::Checks(checks) => {
                for Check { tone, text } in checks {
                    let mark = self.painted(tone_style(*tone), tone_mark(*tone));
                    self.paragraph(text, &format!("{pad}  {mark} "), &format!("{pad}    "));
                }
            }
            Block::Table(table) => self.table(table, indent + 2),
            // A terminal has no pages.
            Block::Contents(_) => {}
            Block::Statement(statement) => {
                let text = statement.text();
                self.raw(&format!("{pad}  {}", self.painted("1", &text.name)));
                for h in &text.hypotheses {
                    self.paragraph(&hypothesis(h), &format!("{pad}    - "), &format!("{pad}      "));
                }
                for paragraph in &text.body {
                    self.paragraph(&line(paragraph, []), &format!("{pad}    "), &format!("{pad}    "));
                }
            }
            Block::Figure { caption, .. } => self.paragraph(caption, &format!("{pad}  "), &format!("{pad}  ")),
            Block::Details { summary, blocks } => {
                self.paragraph(summary, &format!("{pad}  "), &format!("{pad}  "));
                self.blocks(blocks, indent + 2);
            }
        }
    }

    fn words(&self, text: &[Inline]) -> Vec<Word> {
        let mut words: Vec<Word> = Vec::new();
        let mut glued = false;
        for run in text {
            let (content, style) = match run {
                Inline::Text(t) => (t.clone(), ""),
                Inline::Strong(t) => (t.clone(), "1"),
                Inline::Code(t) => (t.clone(), "36"),
                Inline::Math(m) => (math_line(m), ""),
                Inline::Mark(tone, t) => (t.clone(), tone_style(*tone)),
            };
            // Formulas and code keep together as far as they fit a line.
            let whole = !matches!(run, Inline::Text(_) | Inline::Strong(_)) && content.width() <= 40;
            let pieces: Vec<&str> =
                if whole { vec![content.as_str()] } else { content.split(char::is_whitespace).collect() };
            for (k, piece) in pieces.iter().enumerate() {
                if k > 0 {
                    glued = false;
                }
                if piece.is_empty() {
                    continue;
                }
                let shown = if style.is_empty() { (*piece).to_owned() } else { self.painted(style, piece) };
                words.push(Word { plain: (*piece).to_owned(), shown, glued });
                glued = true;
            }
        }
        words
    }

    fn paragraph(&mut self, text: &[Inline], first: &str, next: &str) {
        for row in self.wrapped(text, first, next, self.look.width) {
            self.raw(row.trim_end());
        }
    }

    /// Breaks a line of text; words longer than a row are cut, formulas of several words at their blanks.
    fn wrapped(&self, text: &[Inline], first: &str, next: &str, width: usize) -> Vec<String> {
        let room = width.saturating_sub(next.width()).max(8);
        let mut rows = vec![first.to_owned()];
        let mut used = 0;
        for word in self.words(text) {
            let mut size = word.plain.width();
            let gap = usize::from(!word.glued && used > 0);
            if used > 0 && used + gap + size > room {
                rows.push(next.to_owned());
                used = 0;
            } else if gap > 0 {
                last(&mut rows).push(' ');
                used += 1;
            }
            if size <= room {
                last(&mut rows).push_str(&word.shown);
                used += size;
                continue;
            }
            let mut chunk = String::new();
            for c in word.plain.chars() {
                if chunk.width() == room {
                    let rest = match chunk.rfind(' ').filter(|_| c != ' ') {
                        Some(at) => chunk.split_off(at).trim_start().to_owned(),
                        None => String::new(),
                    };
                    last(&mut rows).push_str(&chunk);
                    rows.push(next.to_owned());
                    chunk = rest;
                }
                if c != ' ' || !chunk.is_empty() {
                    chunk.push(c);
                }
            }
            size = chunk.width();
            last(&mut rows).push_str(&chunk);
            used = size;
        }
        rows
    }

    fn table(&mut self, table: &Table, indent: usize) {
        let pad = " ".repeat(indent);
        let columns = table.header.len();
        let most = |measure: fn(&str) -> usize| -> Vec<usize> {
            let column = |j: usize| {
                let cells = table.rows.iter().filter_map(move |row| row.get(j)).chain([&table.header[j]]);
                cells.map(|cell| measure(&plain(cell))).max().unwrap_or(0).max(1)
            };
            (0..columns).map(column).collect()
        };
        let natural = most(|text| text.width());
        let words = most(|text| text.split_whitespace().map(UnicodeWidthStr::width).max().unwrap_or(0));
        let widths = fitted(natural, &words, self.look.width.saturating_sub(indent + 2 * columns.saturating_sub(1)));
        self.table_row(&table.header, &widths, &pad, true);
        let rule: Vec<String> = widths.iter().map(|w| "─".repeat(*w)).collect();
        self.raw(&format!("{pad}{}", rule.join("  ")));
        for row in &table.rows {
            self.table_row(row, &widths, &pad, false);
        }
    }

    fn table_row(&mut self, cells: &[Line], widths: &[usize], pad: &str, strong: bool) {
        let bold = |cell: &Line| -> Line { if strong { vec![Inline::Strong(plain(cell))] } else { cell.clone() } };
        let wrapped: Vec<(Vec<String>, usize)> =
            cells.iter().zip(widths).map(|(cell, &w)| (self.cell_rows(&bold(cell), w), w)).collect();
        let height = wrapped.iter().map(|(rows, _)| rows.len()).max().unwrap_or(0);
        for i in 0..height {
            let mut row = pad.to_owned();
            for (j, (rows, width)) in wrapped.iter().enumerate() {
                let cell = rows.get(i).map_or("", String::as_str);
                row.push_str(cell);
                if j + 1 < wrapped.len() {
                    let missing = width.saturating_sub(unpainted(cell).width());
                    row.push_str(&" ".repeat(missing + 2));
                }
            }
            self.raw(row.trim_end());
        }
    }

    fn cell_rows(&self, cell: &[Inline], width: usize) -> Vec<String> {
        let whole = plain(cell);
        if whole.width() <= width {
            let shown: String = self.words(cell).iter().enumerate().fold(String::new(), |mut s, (k, w)| {
                if k > 0 && !w.glued {
                    s.push(' ');
                }
                s.push_str(&w.shown);
                s
            });
            return vec![shown];
        }
        self.wrapped(cell, "", "", width)
    }
}

fn last(rows: &mut [String]) -> &mut String {
    rows.last_mut().expect("there is always a row")
}

/// Shrinks the widest columns until the sum is at most `room`; as long as it can be helped no word is broken.
fn fitted(mut widths: Vec<usize>, words: &[usize], room: usize) -> Vec<usize> {
    while widths.iter().sum::<usize>() > room {
        let whole = (0..widths.len()).filter(|&j| widths[j] > words[j]).max_by_key(|&j| widths[j]);
        let Some(widest) = whole.or_else(|| (0..widths.len()).max_by_key(|&j| widths[j])) else { break };
        if widths[widest] <= 8 && whole.is_none() {
            break;
        }
        widths[widest] -= 1;
    }
    widths
}

fn unpainted(text: &str) -> String {
    let mut out = String::new();
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        if c == '\u{1b}' {
            for c in chars.by_ref() {
                if c == 'm' {
                    break;
                }
            }
        } else {
            out.push(c);
        }
    }
    out
}

fn tone_style(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "1;32",
        Tone::Bad => "1;31",
        Tone::Open => "1;33",
        Tone::Neutral => "2",
    }
}

fn tone_mark(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "✔",
        Tone::Bad => "✘",
        Tone::Open => "?",
        Tone::Neutral => "·",
    }
}

/// A line without colours.
#[must_use]
pub fn plain(text: &[Inline]) -> String {
    text.iter()
        .map(|run| match run {
            Inline::Text(t) | Inline::Strong(t) | Inline::Code(t) | Inline::Mark(_, t) => t.clone(),
            Inline::Math(m) => math_line(m),
        })
        .collect()
}

/// A number as text, shortened in the middle where it is long.
#[must_use]
pub fn number_text(digits: &str) -> String {
    if digits.len() <= MAX_NUMBER {
        return digits.to_owned();
    }
    let (head, tail) = (&digits[..12], &digits[digits.len() - 6..]);
    format!("{head}…{tail} ({} digits)", digits.len())
}

fn rational_text(x: &crate::arith::Rational) -> String {
    let (negative, size) = sign_and_size(x);
    let (numerator, denominator) = parts(&size);
    let minus = if negative { "−" } else { "" };
    match denominator {
        Some(q) => format!("{minus}{}/{}", number_text(&numerator), number_text(&q)),
        None => format!("{minus}{}", number_text(&numerator)),
    }
}

/// A formula in one line.
#[must_use]
pub fn math_line(math: &Math) -> String {
    match math {
        Math::Number(x) => rational_text(x),
        Math::Digits(text) | Math::Word(text) => text.clone(),
        Math::Letter(c) | Math::Symbol(c) => c.to_string(),
        Math::Row(parts) => row_text(parts),
        Math::Script { base, sub, sup } => script_text(base, sub.as_deref(), sup.as_deref()),
        Math::Root(inner) => format!("√{}", math_line(inner)),
        Math::Matrix(rows) => {
            let row = |cells: &Vec<Math>| cells.iter().map(math_line).collect::<Vec<_>>().join(", ");
            format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join("; "))
        }
    }
}

fn row_text(parts: &[Math]) -> String {
    let mut out = String::new();
    for (part, gap) in parts.iter().zip(gaps(parts)) {
        if gap && !out.ends_with(' ') {
            out.push(' ');
        }
        out.push_str(&math_line(part));
    }
    out
}

/// For every part of a row, whether a space stands before it.
fn gaps(parts: &[Math]) -> Vec<bool> {
    let kind = |m: &Math| match m {
        Math::Symbol(c) => spacing(*c),
        Math::Script { base, .. } => match base.as_ref() {
            Math::Symbol(c) => spacing(*c),
            _ => Spacing::Tight,
        },
        _ => Spacing::Tight,
    };
    let symbol = |m: &Math| matches!(m, Math::Symbol(_));
    let apart = |m: &Math| matches!(m, Math::Number(_) | Math::Digits(_) | Math::Word(_) | Math::Root(_));
    let mut gaps = vec![false; parts.len()];
    let mut sign = false;
    for k in 0..parts.len() {
        // A sign at the start, after a bracket, a comma or a relation is no operation.
        let operand = |j: usize| matches!(kind(&parts[j]), Spacing::Tight | Spacing::Close);
        let is_sign = kind(&parts[k]) == Spacing::Binary && !(k > 0 && operand(k - 1));
        if k > 0 {
            gaps[k] = match (kind(&parts[k - 1]), kind(&parts[k])) {
                (Spacing::Relation | Spacing::Comma, _) | (_, Spacing::Relation) => true,
                (Spacing::Open, _) | (_, Spacing::Close | Spacing::Comma) => false,
                (Spacing::Binary, _) => !sign,
                (_, Spacing::Binary) => true,
                _ => {
                    let (before, part) = (&parts[k - 1], &parts[k]);
                    !symbol(before) && !symbol(part) && (apart(before) || apart(part))
                }
            };
        }
        sign = is_sign;
    }
    gaps
}

fn script_text(base: &Math, sub: Option<&Math>, sup: Option<&Math>) -> String {
    let mut out = math_line(base);
    if let Some(sub) = sub {
        out.push_str(&raised(&math_line(sub), '_', subscript));
    }
    if let Some(sup) = sup {
        out.push_str(&raised(&math_line(sup), '^', superscript));
    }
    out
}

fn raised(text: &str, sign: char, map: fn(char) -> Option<char>) -> String {
    if let Some(mapped) = text.chars().map(map).collect::<Option<String>>() {
        return mapped;
    }
    let tight: String = text.chars().filter(|c| *c != ' ').collect();
    if tight.chars().count() == 1 { format!("{sign}{tight}") } else { format!("{sign}({tight})") }
}

fn superscript(c: char) -> Option<char> {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match c {
        '−' | '-' => Some('⁻'),
        '*' => Some('*'),
        '+' => Some('⁺'),
        _ => c.to_digit(10).map(|d| digits[d as usize]),
    }
}

fn subscript(c: char) -> Option<char> {
    let digits = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    c.to_digit(10).map(|d| digits[d as usize])
}

/// A formula over several lines.
struct TextBox {
    lines: Vec<String>,
    middle: usize,
}

fn boxed(math: &Math) -> TextBox {
    match math {
        Math::Matrix(rows) => matrix_box(rows),
        Math::Row(parts) if parts.iter().any(|p| matches!(p, Math::Matrix(_) | Math::Row(_))) => {
            let mut out = TextBox { lines: vec![String::new()], middle: 0 };
            for (part, gap) in parts.iter().zip(gaps(parts)) {
                out = beside(&out, &boxed(part), usize::from(gap));
            }
            out
        }
        _ => TextBox { lines: vec![math_line(math)], middle: 0 },
    }
}

fn matrix_box(rows: &[Vec<Math>]) -> TextBox {
    let cells: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(math_line).collect()).collect();
    let columns = cells.iter().map(Vec::len).max().unwrap_or(0);
    let width = |j: usize| cells.iter().filter_map(|row| row.get(j)).map(|c| c.width()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let count = cells.len();
    let lines = cells
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let (open, close) = match (count, i) {
                (1, _) => ('[', ']'),
                (_, 0) => ('⎡', '⎤'),
                (n, i) if i + 1 == n => ('⎣', '⎦'),
                _ => ('⎢', '⎥'),
            };
            let body: Vec<String> =
                row.iter().zip(&widths).map(|(c, w)| format!("{}{c}", " ".repeat(w - c.width()))).collect();
            format!("{open} {} {close}", body.join("  "))
        })
        .collect();
    TextBox { lines, middle: count / 2 }
}

fn beside(a: &TextBox, b: &TextBox, gap: usize) -> TextBox {
    let middle = a.middle.max(b.middle);
    let below = (a.lines.len() - a.middle).max(b.lines.len() - b.middle);
    let width = a.lines.iter().map(|l| l.width()).max().unwrap_or(0);
    let row = |k: usize| {
        let left = (k + a.middle).checked_sub(middle).and_then(|i| a.lines.get(i)).map_or("", String::as_str);
        let right = (k + b.middle).checked_sub(middle).and_then(|i| b.lines.get(i)).map_or("", String::as_str);
        format!("{left}{}{right}", " ".repeat(width + gap - left.width()))
    };
    TextBox { lines: (0..middle + below).map(row).collect(), middle }
}

#[cfg(test)]
mod tests {
    use super::super::document::{formula, line, words};
    use super::*;

    #[test]
    fn nothing_is_wider_than_the_terminal() {
        let long = "word ".repeat(60) + &"x".repeat(300);
        let table = Table {
            caption: Line::new(),
            header: vec![words("one"), words("two"), words("three")],
            rows: vec![vec![words(long.clone()), words("b"), words(long.clone())]],
        };
        let document = Document {
            title: "t".into(),
            blocks: vec![Block::Paragraph(words(long.clone())), Block::List(vec![words(long)]), Block::Table(table)],
        };
        let text = render(&document, false);
        assert!(text.lines().all(|l| l.width() <= WIDTH), "{text}");
        assert_eq!(text.matches('x').count(), 4 * 300);
        for width in [50, 120] {
            let text = render_as(&document, Look { width, ..Look::default() });
            let widest = text.lines().map(|l| l.width()).max();
            assert!(widest.is_some_and(|w| w <= width && w > width - 8), "{width}: {text}");
        }
        assert!(!text.contains('\u{1b}'));
        assert!(render(&document, true).contains('\u{1b}'));
    }

    #[test]
    fn a_long_vector_breaks_between_its_entries() {
        let entries: Vec<_> = [-1, 9, -118, 118, -9, 1].map(|n| crate::arith::ratio(n, 1)).to_vec();
        let cell = vec![Inline::Math(Math::vector(&entries))];
        let table = Table { caption: Line::new(), header: vec![words("v")], rows: vec![vec![cell]] };
        let document = Document { title: "t".into(), blocks: vec![Block::Table(table)] };
        let text = render_as(&document, Look { colour: false, width: 22 });
        let rows: Vec<&str> = text.lines().skip(3).map(str::trim).collect();
        assert_eq!(rows, ["(−1, 9, −118, 118,", "−9, 1)"]);
    }

    #[test]
    fn matrices_stand_beside_their_names() {
        let m = Math::Matrix(vec![vec![Math::count(1), Math::count(10)], vec![Math::count(0), Math::count(2)]]);
        let document =
            Document { title: "t".into(), blocks: vec![Block::Formula(Math::parse("T_0=@", &mut [m].into_iter()))] };
        assert_eq!(render(&document, false), "t\n         ⎡ 1  10 ⎤\n    T₀ = ⎣ 0   2 ⎦\n");
    }

    #[test]
    fn runs_that_touch_stay_together() {
        let text = Block::Paragraph(line("(at `0(1)`), so", []));
        let document = Document { title: "t".into(), blocks: vec![text, Block::Paragraph(formula(Math::of("x=1")))] };
        assert_eq!(render(&document, false), "t\n  (at 0(1)), so\n  x = 1\n");
    }
}
