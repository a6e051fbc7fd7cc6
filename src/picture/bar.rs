//! Bars over the range of a parameter, coloured by verdict.
#![allow(clippy::float_arithmetic, reason = "a drawing")]

use crate::answer::Verdict;
use std::fmt::Write;

/// A part of a range: an interval, or a point where both ends are the same.
#[derive(Debug, Clone, Copy)]
pub struct Span {
    /// The lower end.
    pub from: f64,
    /// The upper end.
    pub to: f64,
    /// What is known there.
    pub verdict: Verdict,
}

const WIDTH: f64 = 640.0;
const LEFT: f64 = 90.0;
const RIGHT: f64 = 20.0;
const ROW: f64 = 34.0;

/// A bar for each name, with a scale below, as SVG and as TikZ; `None` where there is nothing to draw.
#[must_use]
pub fn bars(parameter: &str, rows: &[(String, Vec<Span>)]) -> Option<(String, String)> {
    let spans = rows.first().map(|r| &r.1)?;
    let (lo, hi) = (spans.first()?.from, spans.last()?.to);
    if lo.partial_cmp(&hi) != Some(std::cmp::Ordering::Less) {
        return None;
    }
    let height = ROW * rows.len() as f64 + 44.0;
    let x = |p: f64| LEFT + (p - lo) / (hi - lo) * (WIDTH - LEFT - RIGHT);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\"><title>verdicts over \
         {}</title><style>text{{font:12px sans-serif;fill:#3c4048}}.proved{{fill:#1a8a4a;stroke:#1a8a4a}}\
         .refuted{{fill:#c4332b;stroke:#c4332b}}.undetermined{{fill:#7a4fb5;stroke:#7a4fb5}}\
         @media screen and (prefers-color-scheme:dark){{text{{fill:#d4d8de}}}}</style>",
        crate::escape::html(parameter)
    );
    let mut tikz = String::from("\\begin{tikzpicture}[x=1bp,y=-1bp]\n");
    for (k, (name, spans)) in rows.iter().enumerate() {
        let top = 10.0 + ROW * k as f64;
        let _ = write!(svg, "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>", LEFT - 10.0, top + 15.0);
        let _ = writeln!(tikz, "\\node[left] at ({:.1},{:.1}) {{{name}}};", LEFT - 4.0, top + 11.0);
        // Points last, so that nothing hides them.
        for point in [false, true] {
            for span in spans.iter().filter(|s| (s.from >= s.to) == point) {
                let (a, b) = (x(span.from), x(span.to));
                let class = span.verdict.word();
                // A rectangle without width is not drawn.
                let _ = if point {
                    write!(
                        svg,
                        "<line class=\"{class}\" x1=\"{a:.2}\" x2=\"{a:.2}\" y1=\"{:.1}\" y2=\"{:.1}\" stroke-width=\"2\"/>",
                        top - 4.0,
                        top + 26.0
                    )
                } else {
                    write!(
                        svg,
                        "<rect class=\"{class}\" x=\"{a:.2}\" y=\"{top:.1}\" width=\"{:.2}\" height=\"22\" stroke-width=\"0\"/>",
                        (b - a).max(0.01)
                    )
                };
                let colour = match span.verdict {
                    Verdict::Proved => "green!60!black",
                    Verdict::Refuted => "red!75!black",
                    Verdict::Undetermined => "violet",
                };
                let _ = if point {
                    writeln!(
                        tikz,
                        "\\draw[{colour},line width=1bp] ({a:.2},{:.1}) -- ({a:.2},{:.1});",
                        top - 4.0,
                        top + 26.0
                    )
                } else {
                    writeln!(tikz, "\\fill[{colour}] ({a:.2},{top:.1}) rectangle ({b:.2},{:.1});", top + 22.0)
                };
            }
        }
    }
    let base = 10.0 + ROW * rows.len() as f64 + 14.0;
    for p in [lo, f64::midpoint(lo, hi), hi] {
        let (at, digits) = (x(p), format!("{p:.5}"));
        let p = digits.trim_end_matches('0').trim_end_matches('.');
        let _ = write!(svg, "<text x=\"{at:.2}\" y=\"{base:.1}\" text-anchor=\"middle\">{p}</text>");
        let _ = writeln!(tikz, "\\node at ({at:.2},{base:.1}) {{${p}$}};");
    }
    svg.push_str("</svg>\n");
    tikz.push_str("\\end{tikzpicture}\n");
    Some((svg, tikz))
}
