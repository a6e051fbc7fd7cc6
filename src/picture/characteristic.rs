//! Characteristic maps: the ring of all sectors and two smaller copies of it.
#![allow(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "pictures")]

use crate::vertex::net::Net;
use std::collections::HashSet;
use std::fmt::Write as _;

/// Side of a panel in pixels.
const SIDE: f64 = 240.0;
/// Room for the words under a panel.
const FOOT: f64 = 26.0;
/// Points on a line of a patch.
const STEPS: usize = 8;
/// Lines are the same where their points agree to this part of the ring.
const GRAIN: f64 = 2000.0;

/// What is drawn of one valence.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    /// The patches of sector 0.
    pub patches: &'a [Net<(f64, f64)>],
    /// The valence.
    pub valence: usize,
    /// The frequency of the block.
    pub frequency: usize,
    /// The eigenvalue, by which the copies shrink.
    pub eigenvalue: f64,
}

type Polyline = Vec<(f64, f64)>;

/// The point of a net at two variables (de Casteljau).
fn point(net: &Net<(f64, f64)>, u: f64, v: f64) -> (f64, f64) {
    let mix = |a: (f64, f64), b: (f64, f64), t: f64| (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t);
    let line = |points: &[(f64, f64)], t: f64| {
        let mut level = points.to_vec();
        while level.len() > 1 {
            level = level.windows(2).map(|w| mix(w[0], w[1], t)).collect();
        }
        level[0]
    };
    if !net.triangle {
        let column: Vec<(f64, f64)> = net.rows.iter().map(|row| line(row, u)).collect();
        return line(&column, v);
    }
    let mut rows = net.rows.clone();
    let w = 1.0 - u - v;
    while rows.len() > 1 {
        rows = (0..rows.len() - 1)
            .map(|r| {
                (0..rows[r].len() - 1)
                    .map(|s| {
                        let (a, b, c) = (rows[r][s], rows[r][s + 1], rows[r + 1][s]);
                        (w * a.0 + u * b.0 + v * c.0, w * a.1 + u * b.1 + v * c.1)
                    })
                    .collect()
            })
            .collect();
    }
    rows[0][0]
}

/// The borders of the patches, and for curved squares two lines across; turned into all sectors and shrunk twice. What two
/// patches share is drawn once.
fn lines(panel: &Panel<'_>) -> Vec<(usize, Polyline)> {
    let mut own: Vec<Polyline> = Vec::new();
    let share = |k: usize| k as f64 / STEPS as f64;
    for net in panel.patches {
        let flat = net.rows.len() == 2 && net.rows[0].len() == 2;
        let stride = if flat { STEPS } else { 1 };
        let mut line = |f: &dyn Fn(f64) -> (f64, f64)| {
            own.push((0..=STEPS).step_by(stride).map(|k| f(share(k))).map(|(u, v)| point(net, u, v)).collect());
        };
        if net.triangle {
            line(&|t| (t, 0.0));
            line(&|t| (0.0, t));
            line(&|t| (1.0 - t, t));
        } else {
            for at in [0.0, 0.5, 1.0].into_iter().step_by(if flat { 2 } else { 1 }) {
                line(&|t| (t, at));
                line(&|t| (at, t));
            }
        }
    }
    let mut all = Vec::new();
    let mut seen = HashSet::new();
    let reach = own.iter().flatten().fold(1e-9, |m: f64, p| m.max(p.0.abs()).max(p.1.abs()));
    let cell = |p: &(f64, f64)| ((p.0 / reach * GRAIN).round() as i64, (p.1 / reach * GRAIN).round() as i64);
    let mut size = 1.0;
    for copy in 0..3 {
        for sector in 0..panel.valence {
            let angle = std::f64::consts::TAU * (panel.frequency * sector) as f64 / panel.valence as f64;
            let (s, c) = angle.sin_cos();
            let turn = |p: &(f64, f64)| (size * (p.0 * c - p.1 * s), size * (p.0 * s + p.1 * c));
            for line in &own {
                let line: Polyline = line.iter().map(turn).collect();
                let mut key: Vec<(i64, i64)> = line.iter().map(cell).collect();
                key.sort_unstable();
                if seen.insert(key) {
                    all.push((copy, line));
                }
            }
        }
        size *= panel.eigenvalue;
    }
    all
}

fn extent(lines: &[(usize, Polyline)]) -> f64 {
    lines.iter().flat_map(|(_, l)| l).fold(1e-9, |m: f64, p| m.max(p.0.abs()).max(p.1.abs()))
}

/// A sheet with one panel for each valence.
#[must_use]
pub fn sheet(panels: &[Panel<'_>], title: &str) -> String {
    let columns = panels.len().clamp(1, 6);
    let rows = panels.len().div_ceil(columns).max(1);
    let (width, height) = (columns as f64 * SIDE, rows as f64 * (SIDE + FOOT));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         style=\"max-width:{}px\">\n<title>{}</title>\n<style>{}</style>\n",
        1.5 * width,
        crate::escape::html(title),
        super::style()
    );
    for (index, panel) in panels.iter().enumerate() {
        let all = lines(panel);
        let scale = (SIDE / 2.0 - 8.0) / extent(&all);
        let (cx, cy) =
            ((index % columns) as f64 * SIDE + SIDE / 2.0, (index / columns) as f64 * (SIDE + FOOT) + SIDE / 2.0);
        for copy in 0..3 {
            let mut path = String::new();
            for (_, line) in all.iter().filter(|(c, _)| *c == copy) {
                for (k, p) in line.iter().enumerate() {
                    let letter = if k == 0 { 'M' } else { 'L' };
                    let _ = write!(path, "{letter}{:.1} {:.1}", cx + p.0 * scale, cy - p.1 * scale);
                }
            }
            let _ = writeln!(svg, "<path class=\"sc-m sc-m{copy}\" d=\"{path}\"/>");
        }
        let foot = cy + SIDE / 2.0 + 14.0;
        let _ = writeln!(
            svg,
            "<text class=\"sc-t\" text-anchor=\"middle\" x=\"{cx}\" y=\"{foot}\">valence {}</text>",
            panel.valence
        );
    }
    svg.push_str("</svg>\n");
    svg
}

/// A small picture without words: the borders of the patches, and one smaller copy.
#[must_use]
pub fn thumbnail(panel: &Panel<'_>, label: &str) -> String {
    let all = lines(panel);
    let scale = 48.0 / extent(&all);
    let mut path = String::new();
    for (_, line) in all.iter().filter(|(copy, _)| *copy < 2) {
        for (k, p) in line.iter().step_by((line.len() / 4).max(1)).enumerate() {
            let letter = if k == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{:.1} {:.1}", 50.0 + p.0 * scale, 50.0 - p.1 * scale);
        }
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\" role=\"img\" aria-label=\"{}\"><path class=\"sc-v\" \
         d=\"{path}\"/></svg>",
        crate::escape::html(label)
    )
}

/// One panel as a TikZ picture.
#[must_use]
pub fn tikz(panel: &Panel<'_>) -> String {
    let all = lines(panel);
    let scale = 3.0 / extent(&all);
    let mut text = String::from("\\begin{tikzpicture}\n");
    for (_, line) in all.iter().filter(|(copy, _)| *copy < 2) {
        let points: Vec<String> = line.iter().map(|p| format!("({:.3},{:.3})", p.0 * scale, p.1 * scale)).collect();
        let _ = writeln!(text, "\\draw[very thin] {};", points.join(" -- "));
    }
    text.push_str("\\end{tikzpicture}\n");
    text
}
