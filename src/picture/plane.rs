//! The plane of two parameters, coloured by verdict, with curves.
#![allow(clippy::float_arithmetic, reason = "a drawing")]

use crate::arith::{Rational, to_f64};
use crate::poly::Two;
use std::fmt::Write;

/// A box of the plane.
#[derive(Debug, Clone, Copy)]
pub struct Tile {
    /// The range of the first parameter.
    pub first: (f64, f64),
    /// The range of the second.
    pub second: (f64, f64),
    /// `proved`, `refuted`, `undetermined` or `outside`.
    pub class: &'static str,
}

const SIZE: f64 = 480.0;
const LEFT: f64 = 56.0;
const TOP: f64 = 12.0;
/// Cells of the grid on which curves are followed.
const CELLS: usize = 160;

/// Where the plane is in the picture.
struct Frame([(f64, f64); 2]);

impl Frame {
    fn at(&self, p: f64, q: f64) -> (f64, f64) {
        let share = |x: f64, (lo, hi): (f64, f64)| (x - lo) / (hi - lo);
        (LEFT + SIZE * share(p, self.0[0]), TOP + SIZE * (1.0 - share(q, self.0[1])))
    }
}

/// The plane as SVG and as TikZ.
#[must_use]
pub fn plane(names: [&str; 2], ranges: [(f64, f64); 2], tiles: &[Tile], curves: &[Two]) -> (String, String) {
    let frame = Frame(ranges);
    let (width, height) = (LEFT + SIZE + 16.0, TOP + SIZE + 40.0);
    let names = names.map(|n| crate::escape::html(n).to_string());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\"><title>verdicts over {} and \
         {}</title><style>text{{font:12px sans-serif;fill:#3c4048}}.proved{{fill:#1a8a4a}}.refuted{{fill:#c4332b}}\
         .undetermined{{fill:#7a4fb5}}.outside{{fill:#b8bcc4}}path{{fill:none;stroke:#101216;stroke-width:1}}\
         @media screen and (prefers-color-scheme:dark){{text{{fill:#d4d8de}}path{{stroke:#f2f3f5}}}}</style>",
        names[0], names[1]
    );
    let mut tikz = String::from("\\begin{tikzpicture}[x=0.6bp,y=-0.6bp]\n");
    for tile in tiles {
        let ((x, y), (u, v)) = (frame.at(tile.first.0, tile.second.1), frame.at(tile.first.1, tile.second.0));
        let class = tile.class;
        let _ = write!(
            svg,
            "<rect class=\"{class}\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\"/>",
            u - x,
            v - y
        );
        let colour = match class {
            "proved" => "green!60!black",
            "refuted" => "red!75!black",
            "outside" => "gray!50",
            _ => "violet",
        };
        let _ = writeln!(tikz, "\\fill[{colour}] ({x:.2},{y:.2}) rectangle ({u:.2},{v:.2});");
    }
    for curve in curves {
        let mut path = String::new();
        for ((a, b), (c, d)) in segments(curve, &frame) {
            let _ = write!(path, "M{a:.2} {b:.2}L{c:.2} {d:.2}");
            let _ = writeln!(tikz, "\\draw ({a:.2},{b:.2}) -- ({c:.2},{d:.2});");
        }
        let _ = write!(svg, "<path d=\"{path}\"/>");
    }
    let base = TOP + SIZE + 18.0;
    for (k, (lo, hi)) in ranges.into_iter().enumerate() {
        for value in [lo, f64::midpoint(lo, hi), hi] {
            let digits = format!("{value:.4}");
            let text = digits.trim_end_matches('0').trim_end_matches('.');
            let (x, y) = frame.at(if k == 0 { value } else { ranges[0].0 }, if k == 0 { ranges[1].0 } else { value });
            let (x, y, anchor) = if k == 0 { (x, base, "middle") } else { (x - 6.0, y + 4.0, "end") };
            let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
            let _ = writeln!(tikz, "\\node at ({x:.1},{y:.1}) {{${text}$}};");
        }
    }
    let _ = write!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}, {}</text>",
        LEFT + SIZE / 2.0,
        base + 16.0,
        names[0],
        names[1]
    );
    svg.push_str("</svg>\n");
    tikz.push_str("\\end{tikzpicture}\n");
    (svg, tikz)
}

type Point = (f64, f64);

/// Short lines along the zeros of a polynomial, between changes of sign on the edges of a grid.
fn segments(f: &Two, frame: &Frame) -> Vec<(Point, Point)> {
    let value = |p: f64, q: f64| {
        let row = |r: &crate::poly::Poly| r.coeffs().iter().rev().fold(0.0, |v, c: &Rational| v * p + to_f64(c));
        f.rows().iter().rev().fold(0.0, |v, r| v * q + row(r))
    };
    let [first, second] = frame.0;
    let at = |(lo, hi): (f64, f64), k: usize| lo + (hi - lo) * k as f64 / CELLS as f64;
    let grid: Vec<Vec<f64>> =
        (0..=CELLS).map(|j| (0..=CELLS).map(|i| value(at(first, i), at(second, j))).collect()).collect();
    let mut all = Vec::new();
    for j in 0..CELLS {
        for i in 0..CELLS {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let mut hits = Vec::new();
            for k in 0..4 {
                let (a, b) = (corners[k], corners[(k + 1) % 4]);
                let (u, v) = (grid[a.1][a.0], grid[b.1][b.0]);
                // A zero at a corner belongs to the positive side.
                if (u >= 0.0) != (v >= 0.0) {
                    let s = u / (u - v);
                    let mix = |x: f64, y: f64| x + (y - x) * s;
                    let p = mix(at(first, a.0), at(first, b.0));
                    let q = mix(at(second, a.1), at(second, b.1));
                    hits.push(frame.at(p, q));
                }
            }
            all.extend(hits.chunks_exact(2).map(|pair| (pair[0], pair[1])));
        }
    }
    all
}
