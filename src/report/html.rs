//! Documents as self-contained HTML: MathML formulas, inline SVG, light and dark, fit for printing.

use super::document::{Block, Check, Document, Inline, Line, Table, Tone, hypothesis, line};
use super::math::Math;
use super::mathml::{inline_elements, math_element};
pub use crate::escape::html as escaped;
use crate::picture;

const STYLE: &str = include_str!("style.css");
/// Tables of a list that may be skipped stand open up to this length.
const OPEN_ROWS: usize = 12;

/// Matrices with more columns than this are set in small type.
const WIDE: usize = 10;

/// Writes a document as one HTML file that needs nothing else.
#[must_use]
pub fn render(document: &Document) -> String {
    let title = escaped(&document.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
    );
    for block in &document.blocks {
        write_block(&mut out, block);
    }
    out.push_str("</main>\n</body>\n</html>\n");
    one_style(&out)
}

/// Leaves the style sheet of the pictures in the first of them only: it holds for the whole page.
fn one_style(page: &str) -> String {
    let style = format!("<style>{}</style>\n", picture::style());
    match page.split_once(&style) {
        Some((before, after)) => format!("{before}{style}{}", after.replace(&style, "")),
        None => page.to_owned(),
    }
}

fn write_block(out: &mut String, block: &Block) {
    match block {
        Block::Heading(level, text) => {
            let level = (*level).clamp(2, 6);
            out.push_str(&format!("<h{level}>{}</h{level}>\n", inline(text)));
        }
        Block::Paragraph(text) => out.push_str(&format!("<p>{}</p>\n", inline(text))),
        Block::Formula(math) => {
            let dense = if columns(math) > WIDE { " dense" } else { "" };
            out.push_str(&format!("<div class=\"formula{dense}\">{}</div>\n", math_element(math, true)));
        }
        Block::List(items) => {
            let items: String = items.iter().map(|i| format!("<li>{}</li>\n", inline(i))).collect();
            out.push_str(&format!("<ul>\n{items}</ul>\n"));
        }
        Block::Facts(facts) => {
            let facts: String =
                facts.iter().map(|(t, d)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(t), inline(d))).collect();
            out.push_str(&format!("<dl>\n{facts}</dl>\n"));
        }
        Block::Checks(checks) => {
            out.push_str("<ul class=\"checks\">\n");
            for check in checks {
                write_check(out, check);
            }
            out.push_str("</ul>\n");
        }
        Block::Table(table) => write_table(out, table),
        Block::Statement(statement) => {
            let text = statement.text();
            out.push_str(&format!("<blockquote><p><strong>{}.</strong> Hypotheses:</p>\n<ul>\n", escaped(&text.name)));
            for h in &text.hypotheses {
                out.push_str(&format!("<li>{}</li>\n", inline(&hypothesis(h))));
            }
            out.push_str("</ul>\n");
            for paragraph in &text.body {
                out.push_str(&format!("<p>{}</p>\n", inline(&line(paragraph, []))));
            }
            out.push_str("</blockquote>\n");
        }
        Block::Figure { svg, alt, caption, .. } => {
            let svg = svg.replacen("<svg ", &format!("<svg aria-label=\"{}\" ", escaped(alt)), 1);
            out.push_str(&format!("<figure>\n{svg}<figcaption>{}</figcaption>\n</figure>\n", inline(caption)));
        }
        Block::Details { summary, blocks } => {
            // Short lists stand open; paper shows all of them.
            let short = blocks.iter().all(|b| matches!(b, Block::Table(t) if t.rows.len() <= OPEN_ROWS));
            let open = if short { " open=\"open\"" } else { "" };
            out.push_str(&format!("<details{open}>\n<summary>{}</summary>\n", inline(summary)));
            for block in blocks {
                write_block(out, block);
            }
            out.push_str("</details>\n");
        }
    }
}

/// The most columns of a matrix in a formula.
fn columns(math: &Math) -> usize {
    match math {
        Math::Matrix(rows) => rows.first().map_or(0, Vec::len),
        Math::Row(parts) => parts.iter().map(columns).max().unwrap_or(0),
        _ => 0,
    }
}

fn write_check(out: &mut String, Check { tone, text }: &Check) {
    let (mark, word) = match tone {
        Tone::Good => ("✔", "holds"),
        Tone::Bad => ("✘", "fails"),
        Tone::Open => ("?", "not decided"),
        Tone::Neutral => ("·", "for information"),
    };
    let class = tone_class(*tone);
    out.push_str(&format!(
        "<li><span class=\"mark {class}\" role=\"img\" aria-label=\"{word}\">{mark}</span> {}</li>\n",
        inline(text)
    ));
}

fn write_table(out: &mut String, table: &Table) {
    let cells = |tag: &str, row: &[Line]| -> String {
        row.iter().map(|c| format!("<{tag}>{}</{}>", inline(c), tag.split(' ').next().unwrap_or(tag))).collect()
    };
    out.push_str("<div class=\"wide\"><table>\n");
    if !table.caption.is_empty() {
        out.push_str(&format!("<caption>{}</caption>\n", inline(&table.caption)));
    }
    out.push_str(&format!("<thead><tr>{}</tr></thead>\n<tbody>\n", cells("th scope=\"col\"", &table.header)));
    for row in &table.rows {
        out.push_str(&format!("<tr>{}</tr>\n", cells("td", row)));
    }
    out.push_str("</tbody></table></div>\n");
}

/// Formulas of more characters get a scroll bar of their own instead of widening the page.
const LONG: usize = 80;

/// A line as HTML.
#[must_use]
pub fn inline(text: &[Inline]) -> String {
    let mut out = String::new();
    let mut taken = 0;
    for (k, run) in text.iter().enumerate() {
        let skip = std::mem::take(&mut taken);
        match run {
            Inline::Text(t) => out.push_str(&escaped(&t[skip..])),
            Inline::Strong(t) => out.push_str(&format!("<strong>{}</strong>", escaped(t))),
            Inline::Code(t) => out.push_str(&format!("<code>{}</code>", escaped(t))),
            Inline::Mark(tone, t) => {
                out.push_str(&format!("<strong class=\"{}\">{}</strong>", tone_class(*tone), escaped(t)));
            }
            Inline::Math(m) => {
                let mut pieces = inline_elements(m);
                let stop = following_stop(text.get(k + 1));
                taken = stop.len();
                if let Some(last) = pieces.last_mut().filter(|_| !stop.is_empty()) {
                    *last = format!("<span class=\"nb\">{last}{stop}</span>");
                }
                for piece in pieces.iter_mut().filter(|p| shown_length(p) > LONG) {
                    *piece = format!("<span class=\"long\">{piece}</span>");
                }
                out.push_str(&pieces.join(" "));
            }
        }
    }
    out
}

/// How many characters of markup are shown.
fn shown_length(markup: &str) -> usize {
    markup.split('<').map(|part| part.rsplit('>').next().unwrap_or_default().chars().count()).sum()
}

/// The stop or comma after a formula, which must not begin a line.
fn following_stop(next: Option<&Inline>) -> &str {
    match next {
        Some(Inline::Text(t)) if t.starts_with(['.', ',', ';', ':', ')']) => &t[..1],
        _ => "",
    }
}

fn tone_class(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "good",
        Tone::Bad => "bad",
        Tone::Open => "open",
        Tone::Neutral => "neutral",
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::{line, words};
    use super::*;

    #[test]
    fn a_stop_keeps_to_its_formula() {
        let text = inline(&line("so $x$, and $y$ then", []));
        assert!(text.contains("</math>,</span> and <math>") && text.ends_with("</math> then"), "{text}");
        // Long tuples may be broken after commas.
        let tuple = Math::tuple((1..9).map(Math::count).collect());
        let text = inline(&line("$q=@$.", [tuple]));
        assert!(text.matches("</math> ").count() == 7 && text.ends_with("</math>.</span>"), "{text}");
    }

    #[test]
    fn nothing_from_outside_becomes_markup() {
        let document = Document {
            title: "<script>alert(1)</script>".into(),
            blocks: vec![
                Block::Paragraph(words("<img src=x>")),
                Block::text("$x<y$ `<b>`", []),
                Block::Formula(Math::of("a<b")),
                Block::Checks(vec![Check { tone: Tone::Bad, text: line("**<i>**", []) }]),
            ],
        };
        let html = render(&document);
        for tag in ["<script>", "<img", "<b>", "<i>"] {
            assert!(!html.contains(tag), "{tag}");
        }
        assert!(html.contains("<mo>&lt;</mo>"));
        assert!(!html.contains("http"), "no network");
    }
}
