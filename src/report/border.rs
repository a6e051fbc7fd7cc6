//! What is known about schemes with a border, as text for a terminal and as data.

use super::radius::{decimal, interval};
use crate::arith::{Interval, Rational, abs};
use crate::scheme::{BorderSide, point};
use crate::statement::Statement;
use crate::theorem::border::{BorderAnswer, BorderGap, BorderOrder, BorderRegularity};
use crate::theorem::lattice::{LatticeRegularity, monomials};
use serde_json::{Value, json};
use std::fmt::Write as _;

const SIDES: [&str; 2] = ["left", "right"];

/// The table of `secant regularity` for a scheme with a border.
#[must_use]
pub fn border(r: &BorderRegularity) -> String {
    let mut out = String::new();
    for ((word, side), own) in SIDES.into_iter().zip(r.scheme.sides()).zip(&r.sides) {
        let _ = writeln!(out, "{word:<11} {}; by itself {}", described(side), alone(own));
    }
    let own: Vec<String> = r.scheme.stencils().map(|((c, s), t)| format!("{} of {}", t.len(), row(*c, *s))).collect();
    let _ = writeln!(out, "border      own weights: {}", own.join(", "));
    let _ = writeln!(
        out,
        "condition   J < 2^-k on nets modulo those of one polynomial of degree k gives C^k ({})",
        Statement::Border.name()
    );
    out.push_str("k   bound  points  polynomials  J                        C^k\n");
    for o in &r.orders {
        let (points, fits) = match &o.model {
            Some(m) => (m.points.len().to_string(), format!("{} of {}", m.equal.cols(), monomials(2, o.order).len())),
            None => ("–".to_owned(), "–".to_owned()),
        };
        let shown = if o.answer == BorderAnswer::Jump { None } else { o.radius.as_ref().and_then(|x| x.enclosure(96)) };
        let radius = shown.as_ref().map_or_else(|| "–".to_owned(), short);
        let _ = writeln!(out, "{:<3} {:<6} {points:<7} {fits:<12} {radius:<24} {}", o.order, bound(o), word(o));
    }
    for o in &r.orders {
        jumps(&mut out, o);
    }
    match r.smoothness() {
        Some(k) if r.is_exact() => {
            let _ = writeln!(out, "smoothness  C^{k}, and not C^{}: proved", k + 1);
        }
        Some(k) => {
            let _ = writeln!(out, "smoothness  C^{k}: proved");
        }
        None if r.is_exact() => out.push_str("smoothness  not all limits are continuous: proved\n"),
        None => out.push_str("smoothness  not decided\n"),
    }
    out
}

fn jumps(out: &mut String, o: &BorderOrder) {
    let Some(model) = o.model.as_ref().filter(|_| o.answer == BorderAnswer::Jump) else { return };
    for [left, right] in model.jumps() {
        let _ = writeln!(
            out,
            "jump        a net has the limit {} for x < 0 and {} for x > 0",
            polynomial(&left, o.order),
            polynomial(&right, o.order)
        );
    }
    let radius = o.radius.as_ref().and_then(|x| x.enclosure(96));
    if let (true, Some(j)) = (o.sided, radius) {
        let _ = writeln!(
            out,
            "sides       J = {} modulo such nets also: all limits are C^{} up to the border on either side,\n            \
             and at its points their two Taylor polynomials are equal up to multiples of these pairs",
            short(&j),
            o.order
        );
    }
}

/// Bounds with eight places.
fn short(x: &Interval) -> String {
    if x.lo == x.hi {
        return interval(x);
    }
    format!("[{}, {}]", decimal(&x.lo, false, 8), decimal(&x.hi, true, 8))
}

fn described(side: &BorderSide) -> String {
    let [x, y] = &side.place;
    let corners = side.mask.terms().corners();
    let corners = corners.map_or_else(String::new, |(a, b)| format!(" from {} to {}", point(&a), point(&b)));
    format!("{} coefficients{corners}, column 1 at ({x}, {y})", side.mask.terms().len())
}

fn alone(r: &LatticeRegularity) -> String {
    match r.smoothness() {
        Some(k) if r.is_exact() => format!("C^{k}, and not C^{}", k + 1),
        Some(k) => format!("C^{k}"),
        None => "not proved to converge".to_owned(),
    }
}

fn row(column: i64, phase: usize) -> String {
    if phase == 0 { format!("({column}, 2k)") } else { format!("({column}, 2k + 1)") }
}

/// `2^(−k)`.
fn bound(o: &BorderOrder) -> String {
    (Rational::from(1) / Rational::from(1_i64 << o.order)).to_string()
}

fn word(o: &BorderOrder) -> String {
    match o.answer {
        BorderAnswer::Smooth if o.order == 0 => "yes: the scheme converges".to_owned(),
        BorderAnswer::Smooth => "yes".to_owned(),
        BorderAnswer::Side(k) => format!("no: not even on the {}, by itself", SIDES[k]),
        BorderAnswer::Jump => "no: a derivative jumps at the border".to_owned(),
        BorderAnswer::Open(BorderGap::Side(k)) => format!("not decided on the {}, by itself", SIDES[k]),
        BorderAnswer::Open(BorderGap::Window) => "not decided: no window was found that overlaps enough".to_owned(),
        BorderAnswer::Open(BorderGap::Radius) => "not decided: J is not below the bound".to_owned(),
    }
}

/// A polynomial by its coefficients.
fn polynomial(coefficients: &[Rational], degree: usize) -> String {
    let mut out = String::new();
    for (c, a) in coefficients.iter().zip(monomials(2, degree)).rev().filter(|(c, _)| **c != 0) {
        let powers = [("x", a[0]), ("y", a[1])].into_iter().filter(|(_, e)| *e > 0);
        let parts: Vec<String> =
            powers.map(|(name, e)| if e == 1 { name.to_owned() } else { format!("{name}^{e}") }).collect();
        let size = abs(c);
        let factor = if size == 1 && !parts.is_empty() { None } else { Some(size.to_string()) };
        let term = factor.into_iter().chain(parts).collect::<Vec<_>>().join("*");
        let sign = match (out.is_empty(), *c < 0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let _ = write!(out, "{sign}{term}");
    }
    if out.is_empty() { "0".to_owned() } else { out }
}

/// The same as data.
#[must_use]
pub fn border_data(r: &BorderRegularity) -> Value {
    let order = |o: &BorderOrder| {
        let (smooth, by) = match o.answer {
            BorderAnswer::Smooth => (Some(true), "radius"),
            BorderAnswer::Side(k) => (Some(false), SIDES[k]),
            BorderAnswer::Jump => (Some(false), "jump"),
            BorderAnswer::Open(BorderGap::Side(k)) => (None, SIDES[k]),
            BorderAnswer::Open(BorderGap::Window) => (None, "window"),
            BorderAnswer::Open(BorderGap::Radius) => (None, "bounds"),
        };
        let pairs = o.model.as_ref().filter(|_| o.answer == BorderAnswer::Jump).map(|model| {
            let text = |p: &[Rational]| polynomial(p, o.order);
            model.jumps().iter().map(|[a, b]| json!({"left": text(a), "right": text(b)})).collect::<Value>()
        });
        let bounds = o.radius.as_ref().and_then(|x| x.enclosure(96));
        let bounds = bounds.map(|x| json!([decimal(&x.lo, false, 15), decimal(&x.hi, true, 15)]));
        json!({
            "order": o.order, "smooth": smooth, "by": by, "window": o.model.as_ref().map(|m| &m.points),
            "polynomials": o.model.as_ref().map(|m| m.equal.cols()), "radius": bounds, "jumps": pairs, "up_to_border": o.sided,
        })
    };
    let side = |own: &LatticeRegularity| json!({"smoothness": own.smoothness(), "smoothness_exact": own.is_exact()});
    json!({
        "kind": "border", "sides": r.sides.iter().map(side).collect::<Value>(),
        "orders": r.orders.iter().map(order).collect::<Value>(),
        "smoothness": r.smoothness(), "smoothness_exact": r.is_exact(),
    })
}
