//! Diagrams that are no shapes: eigenvalues in the complex plane, automata.

use super::frame::Frame;
use super::svg::{Anchor, Element, document};
use super::tikz;
use std::f64::consts::PI;

/// A diagram in the two formats of reports.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawing {
    /// A complete SVG document; the same input gives the same bytes.
    pub svg: String,
    /// The same as a TikZ picture.
    pub tikz: String,
}

/// An eigenvalue to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Dot {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// What is written beside it; empty for nothing.
    pub label: String,
    /// Whether its modulus is the largest.
    pub top: bool,
}

/// Elements on a sheet of given size, in pixels with y pointing down.
pub(super) struct Sheet {
    pub elements: Vec<Element>,
    pub width: f64,
    pub height: f64,
}

impl Sheet {
    pub fn new(width: f64, height: f64) -> Self {
        Self { elements: Vec::new(), width, height }
    }

    pub fn path(&mut self, class: &'static str, points: Vec<[f64; 2]>) {
        self.elements.push(Element::Path { class, points });
    }

    pub fn line(&mut self, class: &'static str, from: [f64; 2], to: [f64; 2]) {
        self.path(class, vec![from, to]);
    }

    pub fn disc(&mut self, class: &'static str, at: [f64; 2], radius: f64) {
        self.elements.push(Element::Disc { class, at, radius });
    }

    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, text: impl Into<String>) {
        self.elements.push(Element::Label { at, anchor, text: text.into() });
    }

    pub fn circle(&mut self, class: &'static str, at: [f64; 2], radius: f64) {
        let point = |k: u32| {
            let angle = f64::from(k) * PI / 36.0;
            [at[0] + radius * angle.cos(), at[1] + radius * angle.sin()]
        };
        self.path(class, (0..=72).map(point).collect());
    }

    /// Cuts the sheet down to what is on it, with a margin.
    pub fn crop(&mut self, margin: f64) {
        let boxes: Vec<Frame> = self.elements.iter().flat_map(Frame::of).collect();
        let Some(all) = boxes.into_iter().reduce(Frame::joined) else { return };
        let shift = [margin - all.lo[0], margin - all.lo[1]];
        self.elements.iter_mut().for_each(|e| e.shift(shift));
        self.width = all.hi[0] - all.lo[0] + 2.0 * margin;
        self.height = all.hi[1] - all.lo[1] + 2.0 * margin;
    }

    pub fn finish(self, title: &str) -> Drawing {
        let svg = document(&self.elements, self.width, self.height, title);
        Drawing { svg, tikz: tikz::picture(&self.elements) }
    }
}

/// The eigenvalues in the complex plane with the circles of their moduli and the unit circle.
#[must_use]
pub fn spectrum(dots: &[Dot], title: &str) -> Drawing {
    const SIZE: f64 = 300.0;
    let top = dots.iter().map(|d| d.re.hypot(d.im)).fold(0.0, f64::max);
    // The unit circle shows how far the operator contracts, unless everything would end up in its centre.
    let unit = top >= 0.2;
    let scale = 118.0 / if unit { top.max(1.0) } else { top.max(1e-9) * 1.1 };
    let middle = [SIZE / 2.0, SIZE / 2.0];
    let place = |re: f64, im: f64| [middle[0] + re * scale, middle[1] - im * scale];
    let mut sheet = Sheet::new(SIZE, SIZE);
    sheet.line("sc-a", [10.0, middle[1]], [SIZE - 10.0, middle[1]]);
    sheet.line("sc-a", [middle[0], 10.0], [middle[0], SIZE - 10.0]);
    sheet.text([SIZE - 10.0, middle[1] - 5.0], Anchor::End, "Re");
    sheet.text([middle[0] + 5.0, 20.0], Anchor::Start, "Im");
    let mut drawn: Vec<f64> = Vec::new();
    if unit {
        sheet.circle("sc-a", middle, scale);
        sheet.text([middle[0] + scale + 4.0, middle[1] + 14.0], Anchor::Start, "1");
        drawn.push(1.0);
    }
    for dot in dots {
        let modulus = dot.re.hypot(dot.im);
        if modulus > 1e-9 && drawn.iter().all(|r| (r - modulus).abs() > 1e-9) {
            sheet.circle("sc-p", middle, modulus * scale);
            drawn.push(modulus);
        }
    }
    for dot in dots {
        sheet.disc(if dot.top { "sc-tangent" } else { "sc-cusp" }, place(dot.re, dot.im), 4.5);
    }
    // Large eigenvalues come first; a label that would meet another one is left out, since the table has all values.
    let mut taken: Vec<Frame> =
        sheet.elements.iter().filter(|e| matches!(e, Element::Label { .. })).filter_map(Frame::of).collect();
    for dot in dots.iter().filter(|d| !d.label.is_empty()) {
        let at = place(dot.re, dot.im);
        let shifts = if dot.im < 0.0 { [18.0, -9.0] } else { [-9.0, 18.0] };
        let spots = shifts.map(|shift| [at[0], at[1] + shift]);
        let free = |spot: &[f64; 2]| taken.iter().all(|t| !t.meets(&Frame::label(*spot, Anchor::Middle, &dot.label)));
        if let Some(spot) = spots.into_iter().find(free) {
            taken.push(Frame::label(spot, Anchor::Middle, &dot.label));
            sheet.text(spot, Anchor::Middle, dot.label.clone());
        }
    }
    sheet.finish(title)
}

/// An arrow of an automaton: from, to, and the letters on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arrow {
    /// The state where it begins.
    pub from: usize,
    /// The state where it ends.
    pub to: usize,
    /// The letters.
    pub label: String,
}

/// An automaton as a graph: states on a circle, the start marked by a second circle.
#[must_use]
pub fn automaton(names: &[String], start: usize, arrows: &[Arrow], title: &str) -> Drawing {
    let longest = names.iter().map(|n| n.chars().count()).max().unwrap_or(1) as f64;
    let node = (4.2 * longest + 9.0).max(17.0);
    let count = names.len() as f64;
    let ring = if names.len() == 1 { 0.0 } else { (node * 2.4 * count / PI).max(85.0) };
    let half = [ring + node + 70.0, ring + node + 52.0];
    let mut sheet = Sheet::new(2.0 * half[0], 2.0 * half[1]);
    // Two states stand side by side; more begin at the top.
    let turn = if names.len() == 2 { PI } else { PI / 2.0 };
    let spot = |k: usize| {
        let angle = turn - 2.0 * PI * k as f64 / count;
        [half[0] + ring * angle.cos(), half[1] - ring * angle.sin()]
    };
    for arrow in arrows {
        let (from, to) = (spot(arrow.from), spot(arrow.to));
        if arrow.from == arrow.to {
            self_loop(&mut sheet, from, half, node, &arrow.label);
        } else {
            bow(&mut sheet, from, to, node, &arrow.label);
        }
    }
    for (k, name) in names.iter().enumerate() {
        let at = spot(k);
        sheet.circle("sc-a", at, node);
        if k == start {
            sheet.circle("sc-a", at, node - 3.5);
        }
        sheet.text([at[0], at[1] + 4.0], Anchor::Middle, name.clone());
    }
    sheet.crop(10.0);
    sheet.finish(title)
}

fn head(sheet: &mut Sheet, tip: [f64; 2], direction: [f64; 2]) {
    let norm = direction[0].hypot(direction[1]).max(1e-9);
    let d = [direction[0] / norm, direction[1] / norm];
    let back = |across: f64| [tip[0] - 8.0 * d[0] - across * d[1], tip[1] - 8.0 * d[1] + across * d[0]];
    sheet.path("sc-a", vec![back(3.5), tip, back(-3.5)]);
}

/// A loop on the outer side of a state.
fn self_loop(sheet: &mut Sheet, at: [f64; 2], middle: [f64; 2], node: f64, label: &str) {
    let out = [at[0] - middle[0], at[1] - middle[1]];
    let norm = out[0].hypot(out[1]);
    let d = if norm < 1e-6 { [0.0, -1.0] } else { [out[0] / norm, out[1] / norm] };
    let base = d[1].atan2(d[0]);
    let radius = 14.0;
    let centre = [at[0] + d[0] * (node + 9.0), at[1] + d[1] * (node + 9.0)];
    // From about 40 degrees beside the inward direction all the way round.
    let point = |s: f64| {
        let angle = base + PI + 0.7 + s * (2.0 * PI - 1.4);
        [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
    };
    let points: Vec<[f64; 2]> = (0..=24).map(|k| point(f64::from(k) / 24.0)).collect();
    let (before, tip) = (points[22], points[24]);
    sheet.path("sc-a", points);
    head(sheet, tip, [tip[0] - before[0], tip[1] - before[1]]);
    let far = [centre[0] + d[0] * (radius + 7.0), centre[1] + d[1] * (radius + 7.0) + 4.0];
    let anchor = if d[0] > 0.4 {
        Anchor::Start
    } else if d[0] < -0.4 {
        Anchor::End
    } else {
        Anchor::Middle
    };
    let raised = if anchor == Anchor::Middle && d[1] > 0.0 { 6.0 } else { 0.0 };
    sheet.text([far[0], far[1] + raised], anchor, label);
}

/// A bent arrow between two states, so that the one back does not cover it.
fn bow(sheet: &mut Sheet, from: [f64; 2], to: [f64; 2], node: f64, label: &str) {
    let d = [to[0] - from[0], to[1] - from[1]];
    let norm = d[0].hypot(d[1]).max(1e-9);
    let side = [-d[1] / norm, d[0] / norm];
    let bend = (norm * 0.14).min(30.0);
    let control = [(from[0] + to[0]) / 2.0 + side[0] * bend * 2.0, (from[1] + to[1]) / 2.0 + side[1] * bend * 2.0];
    let along = |s: f64| {
        let (a, b, c) = ((1.0 - s) * (1.0 - s), 2.0 * s * (1.0 - s), s * s);
        [a * from[0] + b * control[0] + c * to[0], a * from[1] + b * control[1] + c * to[1]]
    };
    let outside = |p: &[f64; 2]| {
        let far = |q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) > node + 1.0;
        far(from) && far(to)
    };
    let points: Vec<[f64; 2]> = (0..=60).map(|k| along(f64::from(k) / 60.0)).filter(outside).collect();
    if let [.., before, tip] = points[..] {
        head(sheet, tip, [tip[0] - before[0], tip[1] - before[1]]);
    }
    let thin: Vec<[f64; 2]> = points.iter().step_by(4).chain(points.last()).copied().collect();
    sheet.path("sc-a", thin);
    // Nearer to where the arrow begins, where fewer arrows cross.
    let top = along(0.4);
    sheet.text([top[0] + side[0] * 11.0, top[1] + side[1] * 11.0 + 4.0], Anchor::Middle, label);
}
