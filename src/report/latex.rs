//! Documents as LaTeX that a stock TeX compiles (article, amsmath, amsthm, longtable, TikZ).

use super::document::{Block, Check, Document, Inline, Line, Table, Tone, hypothesis, line};
use super::tex::math_tex;
pub use crate::escape::latex as escaped;

const PREAMBLE: &str = "\\documentclass[11pt,a4paper]{article}
\\usepackage[T1]{fontenc}
\\usepackage[utf8]{inputenc}
\\usepackage{lmodern}
\\usepackage{amsmath,amssymb,amsthm}
\\usepackage{array,longtable}
\\usepackage{graphicx}
\\usepackage{xcolor}
\\usepackage{tikz}
\\usepackage[margin=25mm]{geometry}
\\setcounter{MaxMatrixCols}{64}
\\newtheorem*{quoted}{Statement}
\\definecolor{good}{HTML}{12693A}
\\definecolor{bad}{HTML}{B3261E}
\\definecolor{open}{HTML}{7D4A00}
\\definecolor{neutral}{HTML}{5C6470}
\\definecolor{curve}{HTML}{1F5FBF}
\\definecolor{tangent}{HTML}{1A8A4A}
\\definecolor{cusp}{HTML}{B06A00}
\\definecolor{corner}{HTML}{C4332B}
\\definecolor{notangent}{HTML}{7A4FB5}
\\sloppy
\\setlength{\\parindent}{0pt}
\\setlength{\\parskip}{6pt}
\\renewcommand{\\arraystretch}{1.25}
";

/// About so many characters fit a line of a table.
const PAGE: usize = 84;

/// Writes a document as a complete LaTeX file.
#[must_use]
pub fn render(document: &Document) -> String {
    let title = escaped(&document.title);
    let mut out = format!("{PREAMBLE}\\title{{{title}}}\n\\author{{}}\n\\date{{}}\n\\begin{{document}}\n\\maketitle\n");
    for block in &document.blocks {
        out.push('\n');
        write_block(&mut out, block);
    }
    out.push_str("\n\\end{document}\n");
    out
}

fn write_block(out: &mut String, block: &Block) {
    match block {
        Block::Heading(level, text) => {
            let command = match level {
                0..=2 => "section",
                3 => "subsection",
                _ => "subsubsection",
            };
            let text = inline(text);
            out.push_str(&format!("\\{command}*{{{text}}}\n"));
            if command == "section" {
                out.push_str(&format!("\\addcontentsline{{toc}}{{section}}{{{text}}}\n"));
            }
        }
        Block::Paragraph(text) => out.push_str(&format!("{}\n", inline(text))),
        Block::Formula(math) => {
            // Wide matrices are shrunk to the line.
            out.push_str(&format!(
                "\\[\\resizebox{{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}}{{!}}{{$\\displaystyle {}$}}\\]\n",
                math_tex(math)
            ));
        }
        Block::List(items) => {
            let items: String = items.iter().map(|i| format!("\\item {{}}{}\n", inline(i))).collect();
            out.push_str(&format!("\\begin{{itemize}}\n{items}\\end{{itemize}}\n"));
        }
        Block::Facts(facts) => {
            let facts: String = facts.iter().map(|(t, d)| format!("\\item[{}] {}\n", escaped(t), inline(d))).collect();
            out.push_str(&format!("\\begin{{description}}\n{facts}\\end{{description}}\n"));
        }
        Block::Checks(checks) => {
            out.push_str("\\begin{itemize}\n");
            for Check { tone, text } in checks {
                out.push_str(&format!("\\item[{}] {}\n", tick(*tone), inline(text)));
            }
            out.push_str("\\end{itemize}\n");
        }
        Block::Table(table) => write_table(out, table),
        Block::Contents(_) => out.push_str("\\setcounter{tocdepth}{1}\n\\tableofcontents\n"),
        Block::Statement(statement) => {
            let text = statement.text();
            out.push_str(&format!("\\begin{{quoted}}[{}]\nHypotheses:\n\\begin{{itemize}}\n", escaped(&text.name)));
            for h in &text.hypotheses {
                out.push_str(&format!("\\item {}\n", inline(&hypothesis(h))));
            }
            out.push_str("\\end{itemize}\n");
            let body: Vec<String> = text.body.iter().map(|paragraph| inline(&line(paragraph, []))).collect();
            out.push_str(&format!("{}\n\\end{{quoted}}\n", body.join("\n\n")));
        }
        Block::Figure { tikz, caption, .. } => {
            out.push_str(&format!(
                "\\begin{{center}}\n{tikz}\n\\small\\itshape {}\n\\end{{center}}\n",
                inline(caption)
            ));
        }
        Block::Details { summary, blocks } => {
            out.push_str(&format!("{}\n\\nopagebreak\n", inline(summary)));
            for block in blocks {
                out.push('\n');
                write_block(out, block);
            }
        }
    }
}

fn tick(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "{\\color{good}$\\checkmark$}",
        Tone::Bad => "{\\color{bad}$\\times$}",
        Tone::Open => "{\\color{open}?}",
        Tone::Neutral => "{\\color{neutral}$\\cdot$}",
    }
}

/// Tables of at most so many rows are kept on one page.
const SHORT: usize = 24;

/// The widths of the columns of a table: natural ones where a row fits the page and the table is short, otherwise fixed
/// ones by what they hold, so that a table over several pages needs no second run.
fn columns(table: &Table) -> String {
    let length = |cell: &Line| super::text::plain(cell).chars().count();
    let longest: Vec<usize> = (0..table.header.len())
        .map(|j| table.rows.iter().chain([&table.header]).filter_map(|row| row.get(j)).map(length).max().unwrap_or(1))
        .collect();
    let fits = longest.iter().sum::<usize>() + 3 * longest.len() <= PAGE;
    if fits && table.rows.len() <= SHORT {
        return "l".repeat(longest.len());
    }
    // A short column gets what it needs, the long ones share the rest.
    let wanted: Vec<usize> = longest.iter().map(|n| (*n).clamp(8, PAGE / 2)).collect();
    let total = wanted.iter().sum::<usize>().max(PAGE);
    let column = |n: &usize| {
        let permille = (n * 999 / total).max(60);
        format!(">{{\\raggedright\\arraybackslash}}p{{\\dimexpr0.{permille:03}\\linewidth-2\\tabcolsep\\relax}}")
    };
    wanted.iter().map(column).collect()
}

fn write_table(out: &mut String, table: &Table) {
    let spec = columns(table);
    let row = |cells: &[Line]| cells.iter().map(|c| inline(c)).collect::<Vec<_>>().join(" & ");
    let short = table.rows.len() <= SHORT;
    out.push_str(if short { "\\begin{center}\\small\n" } else { "{\\small\n" });
    let environment = if short { "tabular" } else { "longtable" };
    out.push_str(&format!("\\begin{{{environment}}}{{@{{}}{spec}@{{}}}}\n"));
    let head = if short { "" } else { "\\endhead\n" };
    out.push_str(&format!("{} \\\\\n\\hline\n{head}", row(&table.header)));
    for cells in &table.rows {
        out.push_str(&format!("{{}}{} \\\\\n", row(cells)));
    }
    out.push_str(&format!("\\end{{{environment}}}\n"));
    out.push_str(if short { "\\end{center}\n" } else { "}\n" });
}

fn inline(text: &[Inline]) -> String {
    text.iter()
        .map(|run| match run {
            Inline::Text(t) => escaped(t),
            Inline::Strong(t) => format!("\\textbf{{{}}}", escaped(t)),
            Inline::Code(t) => format!("\\texttt{{{}}}", breakable(t)),
            // Long vectors may be broken after commas.
            Inline::Math(m) => format!("${}$", math_tex(m).replace(',', ",\\allowbreak ")),
            Inline::Mark(tone, t) => {
                let colour = match tone {
                    Tone::Good => "good",
                    Tone::Bad => "bad",
                    Tone::Open => "open",
                    Tone::Neutral => "neutral",
                };
                format!("\\textcolor{{{colour}}}{{\\textbf{{{}}}}}", escaped(t))
            }
        })
        .collect()
}

/// Long codes, such as digests, may be broken.
fn breakable(code: &str) -> String {
    let chars: Vec<char> = code.chars().collect();
    if chars.len() <= 40 {
        return escaped(code);
    }
    let part = |chunk: &[char]| escaped(&chunk.iter().collect::<String>());
    chars.chunks(16).map(part).collect::<Vec<_>>().join("\\hspace{0pt}")
}

#[cfg(test)]
mod tests {
    use super::super::document::words;
    use super::*;

    #[test]
    fn special_characters_are_harmless() {
        let document =
            Document { title: "100% \\input{x} $".into(), blocks: vec![Block::Paragraph(words("a_b ∈ ρ ≈ 日"))] };
        let text = render(&document);
        assert!(text.contains("100\\% \\textbackslash{}input\\{x\\} \\$"), "{text}");
        assert!(text.contains("a\\_b $\\in$ $\\rho$ $\\approx$ ?"), "{text}");
    }
}
