//! What is known about masks on lattices, as text for a terminal and as data.

use super::radius::{decimal, interval, joint_radius};
use crate::arith::{Interval, Rational};
use crate::scheme::point;
use crate::statement::Statement;
use crate::theorem::lattice::{Answer, Cells, LatticeRegularity, MAX_RULES, Stability};
use crate::theorem::regularity::Attained;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// The table of `secant regularity` for a mask on a lattice.
#[must_use]
pub fn lattice(r: &LatticeRegularity) -> String {
    let mut out = String::new();
    let (mask, m) = (&r.mask, r.mask.dilation());
    let rows: Vec<String> = m.rows().iter().map(|row| format!("{row:?}").replace(' ', "")).collect();
    let corners =
        mask.terms().corners().map_or_else(String::new, |(a, b)| format!(" from {} to {}", point(&a), point(&b)));
    let _ = writeln!(out, "mask        {} coefficients at points{corners}", mask.terms().len());
    let _ = writeln!(out, "dilation    M = [{}], {} cosets; ρ = {}", rows.join(","), m.index(), rho(r));
    let most = if r.sum_rules == MAX_RULES { "at least " } else { "" };
    let _ = writeln!(out, "sum rules   of order {most}{}", r.sum_rules);
    let _ = writeln!(
        out,
        "window      {} points; the common points of neighbouring windows determine polynomials of degree {} (rank {})",
        r.window.points.len(),
        r.window.degree,
        r.window.rank
    );
    let _ = writeln!(
        out,
        "matrices    {} of dimension {}, on nets modulo these polynomials; J is their radius",
        r.letters.len(),
        r.window.points.len() - r.window.rank
    );
    out.push_str(&joint_radius(&r.radius));
    let _ = writeln!(out, "shifts      {}", shifts(r));
    let _ = writeln!(
        out,
        "condition   J < ρ^-k gives C^k; for stable shifts also only if ({})",
        Statement::LatticeMask.name()
    );
    out.push_str("k   bound ρ^-k      C^k\n");
    for (k, answer) in r.orders.iter().enumerate() {
        let _ = writeln!(out, "{k:<3} {:<15} {}", threshold(r, k), word(*answer, k));
    }
    limits(&mut out, r);
    out
}

/// `ρ`, the factor of the dilation.
fn rho(r: &LatticeRegularity) -> String {
    let m = r.mask.dilation();
    match (m.factor(), m.dimensions()) {
        (Some(k), _) => k.to_string(),
        (None, 2) => format!("√{}", m.index()),
        (None, s) => format!("{}^(1/{s})", m.index()),
    }
}

/// `ρ^(−k)`.
fn threshold(r: &LatticeRegularity, k: usize) -> String {
    let m = r.mask.dilation();
    let fraction = |exponent: usize| {
        Rational::from(1) / (0..exponent).fold(Rational::from(1), |p, _| p * Rational::from(m.index() as u64))
    };
    match (k % m.dimensions(), m.factor()) {
        (0, _) => fraction(k / m.dimensions()).to_string(),
        (_, Some(factor)) => {
            let p = (0..k).fold(Rational::from(1), |p, _| p * Rational::from(factor));
            (Rational::from(1) / p).to_string()
        }
        (_, None) => format!("{}^(-{k}/{})", m.index(), m.dimensions()),
    }
}

fn word(answer: Answer, k: usize) -> &'static str {
    match answer {
        Answer::Smooth if k == 0 => "yes: the scheme converges",
        Answer::Smooth => "yes",
        Answer::Rough if k == 0 => "no: the scheme does not converge uniformly",
        Answer::Rough => "no: J is not below the bound, and the shifts are stable",
        Answer::Rules => "no: that would need sum rules of a higher order, as the shifts are stable",
        Answer::Unstable => "not decided: stable shifts would exclude it, but they are not proved to be stable",
        Answer::Open => "not decided",
    }
}

fn shifts(r: &LatticeRegularity) -> String {
    match &r.stability {
        Stability::Interpolatory(at) => {
            format!("stable: the mask is 1 at {} and 0 at the rest of its coset (interpolatory)", point(at))
        }
        Stability::Unimodular => {
            "stable: a box spline, all of whose bases of directions have the determinant 1 or -1".to_owned()
        }
        Stability::Samples(s) => {
            let cells: usize = s.charts.iter().map(Cells::count).sum();
            format!(
                "stable: on each of {cells} cells of the torus the symbol of the values at one of {} points is not 0",
                s.words.len()
            )
        }
        Stability::Dependent(d) => format!("dependent: a box spline with a basis of directions of determinant {d}"),
        Stability::Unknown if r.converges() == Some(true) => "not proved to be stable".to_owned(),
        Stability::Unknown => "not looked at, as the scheme is not proved to converge".to_owned(),
    }
}

fn limits(out: &mut String, r: &LatticeRegularity) {
    match r.converges() {
        Some(false) => {
            out.push_str("limits      not uniform: there are control points whose differences do not tend to 0\n");
            return;
        }
        None => {
            out.push_str("limits      convergence is not decided: the bounds of the radius lie on both sides of 1\n");
            return;
        }
        Some(true) => {}
    }
    if let Some(k) = r.smoothness() {
        let exact = if r.is_exact() { format!(", and not C^{}", k + 1) } else { String::new() };
        let _ = writeln!(out, "smoothness  C^{k}{exact}: proved");
    }
    if let Some(e) = &r.exponent {
        let note = match r.attained {
            Attained::Yes => "attained",
            Attained::Zygmund => "in the Zygmund sense; the Hölder class of that order may miss it",
            Attained::No => "not attained: products grow faster",
            Attained::Unknown => "attained or not: not decided",
        };
        let _ = match r.exponent_is_exact() {
            true => writeln!(out, "exponent    {} ({note})", interval(e)),
            false => writeln!(
                out,
                "exponent >= {} (a lower bound, as the shifts are not proved to be stable)",
                decimal(&e.lo, false, 12)
            ),
        };
    }
}

/// The same as data.
#[must_use]
pub fn lattice_data(r: &LatticeRegularity) -> Value {
    let orders = r.orders.iter().enumerate().map(|(k, answer)| {
        let (smooth, why) = match answer {
            Answer::Smooth => (Some(true), "radius"),
            Answer::Rough => (Some(false), "radius"),
            Answer::Rules => (Some(false), "sum rules"),
            Answer::Unstable => (None, "stability"),
            Answer::Open => (None, "bounds"),
        };
        json!({"order": k, "bound": threshold(r, k), "smooth": smooth, "by": why})
    });
    let stable = match &r.stability {
        Stability::Interpolatory(_) => Some("interpolatory"),
        Stability::Unimodular => Some("unimodular"),
        Stability::Samples(_) => Some("samples"),
        Stability::Dependent(_) => Some("dependent"),
        Stability::Unknown => None,
    };
    let attained = match r.attained {
        Attained::Yes => Some("yes"),
        Attained::Zygmund => Some("zygmund"),
        Attained::No => Some("no"),
        Attained::Unknown => None,
    };
    let bounds = |x: &Interval| json!([decimal(&x.lo, false, 15), decimal(&x.hi, true, 15)]);
    let converges = r.converges();
    let some = |x: Value| if converges == Some(true) { x } else { Value::Null };
    let coefficients = r.mask.terms().iter().map(|(a, c)| json!({"at": a, "value": c.to_string()}));
    json!({
        "kind": "lattice mask", "dilation": r.mask.dilation().rows(), "mask": coefficients.collect::<Value>(),
        "sum_rules": r.sum_rules, "window": r.window.points, "overlap_rank": r.window.rank,
        "dimension": r.window.points.len() - r.window.rank,
        "radius": {
            "word": r.radius.lower.as_ref().map(|l| &l.word), "exact": r.radius.exact,
            "bounds": r.radius.enclosure(96).as_ref().map(bounds),
        },
        "stable": stable, "orders": orders.collect::<Value>(), "converges": converges,
        "smoothness": some(json!(r.smoothness())), "smoothness_exact": some(json!(r.is_exact())),
        "exponent": some(json!(r.exponent.as_ref().map(bounds))), "exponent_is_exact": some(json!(r.exponent_is_exact())),
        "attained": some(json!(attained)),
    })
}
