//! Charts: a functional over the cells of a curve, and the turning of secants against its proved rate.

use super::diagram::{Drawing, Sheet};
use super::svg::{Anchor, fixed};

const WIDTH: f64 = 640.0;

/// A box of a chart: a cell with an enclosure of the functional.
#[derive(Debug, Clone, PartialEq)]
pub struct CellBox {
    /// The parameters of the cell, or its place in a list.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Lower bound.
    pub lo: f64,
    /// Upper bound.
    pub hi: f64,
    /// What is written at it; empty for nothing.
    pub label: String,
}

/// The enclosures of a functional on cells as boxes, with the functional itself as a curve, and the line 0.
///
/// `spot` is the parameter of the point where it vanishes by definition.
#[must_use]
pub fn functional(boxes: &[CellBox], profile: &[[f64; 2]], spot: Option<f64>, title: &str) -> Drawing {
    const HEIGHT: f64 = 240.0;
    let bottom = boxes.iter().map(|b| b.lo).chain(profile.iter().map(|p| p[1])).fold(0.0, f64::min);
    let top = boxes.iter().map(|b| b.hi).chain(profile.iter().map(|p| p[1])).fold(0.0, f64::max);
    let span = (top - bottom).max(1e-9);
    let x = |t: f64| 52.0 + t * (WIDTH - 70.0);
    let y = |v: f64| 18.0 + (top - v) / span * (HEIGHT - 46.0);
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    for b in boxes {
        let class = if b.lo > 0.0 { "sc-x" } else { "sc-y" };
        let (l, r, lo, hi) = (x(b.from), x(b.to), y(b.lo), y(b.hi));
        // A box of no height is seen as a line.
        sheet.path(class, vec![[l, lo], [r, lo], [r, hi], [l, hi], [l, lo]]);
    }
    if profile.len() > 1 {
        sheet.path("sc-c", profile.iter().map(|p| [x(p[0]), y(p[1])]).collect());
    }
    sheet.line("sc-a", [x(0.0), y(0.0)], [x(1.0), y(0.0)]);
    sheet.line("sc-a", [x(0.0), y(bottom)], [x(0.0), y(top)]);
    let far = |value: &f64| (y(*value) - y(0.0)).abs() > 12.0;
    for value in [bottom, top].into_iter().filter(far).chain([0.0]) {
        sheet.text([x(0.0) - 6.0, y(value) + 4.0], Anchor::End, fixed(value).replace('-', "−"));
    }
    if boxes.len() <= 24 {
        for b in boxes {
            let middle = [(x(b.from) + x(b.to)) / 2.0, HEIGHT - 8.0];
            if x(b.to) - x(b.from) > 7.0 * b.label.chars().count() as f64 {
                sheet.text(middle, Anchor::Middle, b.label.clone());
            }
        }
    }
    if let Some(t) = spot {
        sheet.disc("sc-corner", [x(t), y(0.0)], 4.0);
        sheet.text([x(t), y(0.0) - 8.0], Anchor::Middle, "q");
    }
    sheet.finish(title)
}

/// How secants turn along one branch: the largest angle to the tangent line, by turns of the cycle, and the bound of the
/// proved rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Turning {
    /// Measured angles in radians, from 0 turns on.
    pub measured: Vec<f64>,
    /// The proved rate times a constant fitted to the measurements; empty where none is proved.
    pub bound: Vec<f64>,
    /// What it is, such as `left`.
    pub name: String,
}

/// The angles of [`Turning`] on a logarithmic scale.
#[must_use]
pub fn turning(branches: &[Turning], title: &str) -> Drawing {
    const HEIGHT: f64 = 250.0;
    const FLOOR: f64 = 1e-9;
    let positive = || branches.iter().flat_map(|b| b.measured.iter().chain(&b.bound)).copied().filter(|a| *a > FLOOR);
    let low = positive().fold(f64::INFINITY, f64::min).min(0.1).log10().floor().max(-9.0);
    let high = positive().fold(0.0, f64::max).max(0.2).log10().ceil();
    let most = branches.iter().map(|b| b.measured.len()).max().unwrap_or(1).max(2) - 1;
    let (w, h) = (420.0, HEIGHT);
    let x = |m: usize| 58.0 + m as f64 / most as f64 * (w - 76.0);
    let y = |a: f64| 16.0 + (high - a.max(FLOOR).log10()) / (high - low).max(1.0) * (h - 58.0);
    let mut sheet = Sheet::new(w, h);
    let base = y(10f64.powf(low));
    sheet.line("sc-a", [x(0), base], [x(most), base]);
    sheet.line("sc-a", [x(0), y(10f64.powf(high))], [x(0), base]);
    let mut power = high;
    while power >= low {
        let value = 10f64.powf(power);
        sheet.line("sc-a", [x(0) - 4.0, y(value)], [x(0), y(value)]);
        sheet.text([x(0) - 8.0, y(value) + 4.0], Anchor::End, fixed_power(power));
        power -= ((high - low) / 5.0).ceil().max(1.0);
    }
    for m in (0..=most).step_by((most / 6).max(1)) {
        sheet.text([x(m), base + 16.0], Anchor::Middle, m.to_string());
    }
    sheet.text([(x(0) + x(most)) / 2.0, h - 6.0], Anchor::Middle, "turns of the cycle");
    for (k, branch) in branches.iter().enumerate() {
        let class = if k == 0 { "sc-tangent" } else { "sc-cusp" };
        let place = |(m, a): (usize, &f64)| [x(m), y(*a)];
        let shown = |(_, a): &(usize, &f64)| **a > FLOOR;
        let bound: Vec<[f64; 2]> = branch.bound.iter().enumerate().filter(shown).map(place).collect();
        if bound.len() > 1 {
            sheet.path(class, bound);
        }
        for at in branch.measured.iter().enumerate().filter(shown).map(place) {
            sheet.disc(class, at, 3.0);
        }
        if !branch.name.is_empty() {
            let row = 14.0 + 15.0 * k as f64;
            sheet.disc(class, [w - 92.0, row - 4.0], 3.0);
            sheet.text([w - 84.0, row], Anchor::Start, branch.name.clone());
        }
    }
    sheet.finish(title)
}

/// `1`, `0.1`, `0.01`, and from there on as a power of ten.
fn fixed_power(exponent: f64) -> String {
    if (-3.0..=0.0).contains(&exponent) { format!("{}", 10f64.powf(exponent)) } else { format!("1e{exponent:.0}") }
}
