//! Documents as Markdown (CommonMark with tables, `$…$` for formulas).

use super::document::{Block, Check, Document, Inline, Line, Table, Tone, hypothesis, line};
use super::math::Math;
use super::tex::math_tex;

/// Writes a document as Markdown with LaTeX formulas.
#[must_use]
pub fn render(document: &Document) -> String {
    let mut out = format!("# {}\n", escaped(&document.title));
    for block in &document.blocks {
        out.push('\n');
        write_block(&mut out, block);
    }
    out
}

fn write_block(out: &mut String, block: &Block) {
    match block {
        Block::Heading(level, text) => {
            out.push_str(&"#".repeat(usize::from(*level).clamp(2, 6)));
            out.push_str(&format!(" {}\n", inline(text)));
        }
        Block::Paragraph(text) => out.push_str(&format!("{}\n", inline(text))),
        Block::Formula(math) => out.push_str(&format!("$$\n{}\n$$\n", math_tex(math))),
        Block::List(items) => {
            for item in items {
                out.push_str(&format!("- {}\n", inline(item)));
            }
        }
        Block::Facts(facts) => {
            for (term, text) in facts {
                out.push_str(&format!("- **{}:** {}\n", escaped(term), inline(text)));
            }
        }
        Block::Checks(checks) => {
            for Check { tone, text } in checks {
                let mark = match tone {
                    Tone::Good => "[x] ",
                    Tone::Bad => "[ ] **fails:** ",
                    Tone::Open => "[ ] **not decided:** ",
                    Tone::Neutral => "",
                };
                out.push_str(&format!("- {mark}{}\n", inline(text)));
            }
        }
        Block::Table(table) => write_table(out, table),
        Block::Contents(heads) => {
            for head in heads {
                let text = inline(head);
                out.push_str(&format!("- [{text}](#{})\n", anchor(&text)));
            }
        }
        Block::Statement(statement) => {
            let text = statement.text();
            out.push_str(&format!("> **{}.** Hypotheses:\n>\n", escaped(&text.name)));
            for h in &text.hypotheses {
                out.push_str(&format!("> - {}\n", inline(&hypothesis(h))));
            }
            for paragraph in &text.body {
                out.push_str(&format!(">\n> {}\n", inline(&line(paragraph, []))));
            }
        }
        Block::Figure { svg, alt, caption, .. } => {
            // A data URI keeps the file self-contained, and Markdown viewers show it.
            let data = percent_encoded(svg);
            out.push_str(&format!("![{}](data:image/svg+xml,{data})\n\n*{}*\n", escaped(alt), inline(caption)));
        }
        Block::Details { summary, blocks } => {
            out.push_str(&format!("{}\n", inline(summary)));
            for block in blocks {
                out.push('\n');
                write_block(out, block);
            }
        }
    }
}

/// The anchor that Markdown viewers give a heading.
fn anchor(text: &str) -> String {
    let letters = text.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    letters.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
}

fn write_table(out: &mut String, table: &Table) {
    let row = |cells: &[Line]| {
        let cells: Vec<String> = cells.iter().map(|c| inline(c).replace("\\|", "|").replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    if !table.caption.is_empty() {
        out.push_str(&format!("{}\n\n", inline(&table.caption)));
    }
    out.push_str(&row(&table.header));
    out.push_str(&format!("|{}\n", " --- |".repeat(table.header.len())));
    for cells in &table.rows {
        out.push_str(&row(cells));
    }
}

fn inline(text: &[Inline]) -> String {
    text.iter().map(run).collect()
}

fn run(run: &Inline) -> String {
    match run {
        Inline::Text(t) => escaped(t),
        Inline::Strong(t) | Inline::Mark(_, t) => format!("**{}**", escaped(t)),
        Inline::Code(t) => code(t),
        Inline::Math(m) => math(m),
    }
}

fn math(m: &Math) -> String {
    format!("${}$", math_tex(m))
}

fn code(t: &str) -> String {
    let t: String = t.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if t.contains('`') { format!("`` {t} ``") } else { format!("`{t}`") }
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' | '$' | '~' => {
                out.push('\\');
                out.push(c);
            }
            '&' => out.push_str("&amp;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn percent_encoded(text: &str) -> String {
    let mut out = String::new();
    for b in text.bytes() {
        match b {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'/' | b':' | b'=' | b',' | b';' => {
                out.push(char::from(b));
            }
            _ => out.push_str(&format!("%{b:02X}")),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::document::{line, words};
    use super::*;

    #[test]
    fn markup_in_names_is_harmless() {
        let document = Document {
            title: "a *b* <script>".into(),
            blocks: vec![
                Block::text("so $0∉π_1(X)$ at `0(1)`", []),
                Block::Table(Table {
                    caption: Line::new(),
                    header: vec![words("a|b")],
                    rows: vec![vec![line("$|x|$", [])]],
                }),
            ],
        };
        let text = render(&document);
        assert!(text.starts_with("# a \\*b\\* \\<script\\>\n\nso $0 \\notin \\pi_{1}(X)$ at `0(1)`\n"), "{text}");
        assert!(text.contains("| $\\vert x \\vert$ |"), "{text}");
    }
}
