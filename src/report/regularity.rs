//! The answers of `secant regularity` as text and as data.

use super::radius::{decimal, interval, joint_radius};
use super::words::{count, listed};
use crate::arith::{Integer, Interval, Rational};
use crate::linalg::Entry;
use crate::radius::JointRadius;
use crate::scheme::Normalisation;
use crate::shape::{Shape, word_text};
use crate::theorem::Measure;
use crate::theorem::enclosed::Enclosed;
use crate::theorem::filter::{Near, Remark};
use crate::theorem::regularity::{Attained, Regularity};
use crate::theorem::smoothness::{CurveOrder, CurveRegularity, Outcome, Shares};
use malachite_base::num::arithmetic::traits::Ceiling;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Numbers with blanks between them.
#[must_use]
pub fn list(numbers: &[Rational]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// What is said of the mask of a case with control points.
pub const ALL_POINTS: &str = "about the mask and all control points together; those of the case are not looked at (secant certify --require c1 does)";

/// What was done with the coefficients before they were a mask.
#[must_use]
pub fn remark(remark: &Remark, arity: usize) -> String {
    match remark {
        Remark::Scaled(Normalisation::Arity) => format!("read as a mask, with the sum {arity}"),
        Remark::Scaled(Normalisation::One) => format!("read as a filter with the sum 1, and multiplied by {arity}"),
        Remark::Scaled(Normalisation::Root) => {
            format!("read as a filter with the sum √{arity}, and multiplied by √{arity}")
        }
        Remark::Recognised(far) => {
            format!("decimals, taken for this mask, which is at most {} away from them", decimal(far, true, 20))
        }
    }
}

/// The table of `secant regularity` for a mask.
#[must_use]
pub fn regularity(r: &Regularity) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "mask        {}", list(&r.mask));
    let _ = writeln!(out, "arity {}, sum rules of order {}", r.arity, r.sum_rules);
    let _ = writeln!(out, "factor b    {}", list(&r.factor));
    out.push_str(&joint_radius(&r.radius));
    condition(&mut out, r.arity);
    let _ = writeln!(out, "k   JSR of differences of order k+1   bound {}^-k   C^k", r.arity);
    for o in &r.orders {
        let radius = o.radius.as_ref().map_or_else(|| "-".to_owned(), interval);
        let word = match o.smooth {
            Some(true) => "yes",
            Some(false) if o.order == 0 => "no: the scheme does not converge",
            Some(false) if r.independent => "no",
            Some(false) => "not by this condition",
            None => "not decided",
        };
        let _ = writeln!(out, "{:<3} {radius:<33} {:<12} {word}", o.order, o.threshold.to_string());
    }
    match r.converges() {
        Some(true) => mask_smoothness(&mut out, r),
        Some(false) if r.is_haar() => {
            out.push_str("limits      constant between the integers, with jumps there: discontinuous\n");
        }
        Some(false) => out.push_str(
            "limits      none: there are control points whose differences do not tend to 0, so that the scheme does not converge\n",
        ),
        None => out.push_str("limits      convergence is not decided: the bounds of the radius lie on both sides of 1\n"),
    }
    out
}

fn mask_smoothness(out: &mut String, r: &Regularity) {
    if let Some(k) = r.smoothness() {
        let exact = if r.smoothness_is_exact() { format!(", not C^{}", k + 1) } else { String::new() };
        let _ = writeln!(out, "smoothness  C^{k}{exact}");
    }
    if let Some(e) = &r.exponent {
        let note = match r.attained {
            Attained::Yes => "attained",
            Attained::Zygmund => "in the Zygmund sense; the Hölder class of that order may miss it",
            Attained::No => "not attained",
            Attained::Unknown => "attained or open: not decided",
        };
        let sense = if r.independent { "exponent" } else { "exponent >=" };
        let _ = writeln!(out, "{sense}    {} ({note})", interval(e));
    }
}

/// The words of the condition that the table applies.
fn condition(out: &mut String, arity: usize) {
    let _ = writeln!(
        out,
        "condition   JSR < {arity}^-m on the differences of order m+1 gives C^m\n            \
         (for arity 2 that of Levin and Levin: JSR < 2^-m for C^m)"
    );
}

/// Whose exponent is bounded where coefficients are known by enclosures.
#[derive(Debug, Clone, Copy)]
pub enum Meaning<'a> {
    /// Of one filter with stable translates: the exponent of its scaling function.
    Limit,
    /// Of one filter: that of the scheme; limits may be smoother.
    Scheme,
    /// Of every filter near decimals.
    Near(&'a Near),
}

/// The table of `secant regularity` for a filter whose coefficients are known by enclosures.
#[must_use]
pub fn enclosed(title: &str, e: &Enclosed, meaning: Meaning<'_>) -> String {
    let mut out = format!("{title}\n");
    let _ = writeln!(out, "arity {}, sum rules of order {}", e.arity, e.sum_rules);
    if let Meaning::Near(near) = meaning {
        let _ = writeln!(
            out,
            "decimals    a filter with these sum rules is at most {} away; the bounds hold for all that are within {}",
            decimal(&near.distance, true, 20),
            decimal(&(&near.radius - &near.distance), false, 20)
        );
    }
    let factor: Vec<String> = e.factor.iter().map(interval).collect();
    let _ = writeln!(out, "factor b    {}", factor.join(" "));
    if let Some(lower) = &e.radius.lower {
        let _ = writeln!(out, "word        {} ({})", word_text(&lower.word), count(lower.length, "letter"));
    }
    let _ = writeln!(out, "radius      {}  (of the matrices of b)", interval(&e.enclosure));
    condition(&mut out, e.arity);
    if e.exponent.hi <= 0 {
        out.push_str("limits      none: the scheme does not converge\n");
        return out;
    }
    if e.exponent.lo <= 0 {
        out.push_str("limits      convergence is not decided: the bounds of the radius lie on both sides of 1\n");
        return out;
    }
    let (least, most) = smooth_between(e);
    match meaning {
        Meaning::Limit => {
            let _ = writeln!(out, "exponent    {}", interval(&e.exponent));
            let words =
                if least == most { format!("C^{least}") } else { format!("at least C^{least}, at most C^{most}") };
            let _ = writeln!(out, "smoothness  {words}");
        }
        Meaning::Scheme | Meaning::Near(_) => {
            let _ = writeln!(out, "exponent    {} (of the scheme; limits may be smoother)", interval(&e.exponent));
            let _ = writeln!(out, "smoothness  at least C^{least}");
        }
    }
    out
}

/// The orders of smoothness that an exponent leaves open: the largest whole numbers below its bounds.
fn smooth_between(e: &Enclosed) -> (Integer, Integer) {
    let whole = |x: &Rational| x.ceiling() - Integer::from(1);
    (whole(&e.exponent.lo), whole(&e.exponent.hi))
}

/// A pair of bounds as decimals, rounded outwards.
pub(super) fn bounds(x: &Interval) -> Value {
    json!([decimal(&x.lo, false, 15), decimal(&x.hi, true, 15)])
}

fn texts<E: ToString>(numbers: &[E]) -> Value {
    numbers.iter().map(ToString::to_string).collect()
}

fn radius_data(r: &JointRadius) -> Value {
    json!({"word": r.lower.as_ref().map(|l| &l.word), "exact": r.exact})
}

/// The same as data.
#[must_use]
pub fn regularity_data(r: &Regularity) -> Value {
    let orders: Value = r
        .orders
        .iter()
        .map(|o| json!({"order": o.order, "bound": o.threshold.to_string(), "radius": o.radius.as_ref().map(bounds), "smooth": o.smooth}))
        .collect();
    let converges = r.converges();
    let attained = match r.attained {
        Attained::Yes => Some("yes"),
        Attained::Zygmund => Some("zygmund"),
        Attained::No => Some("no"),
        Attained::Unknown => None,
    };
    let some = |x: Value| if converges == Some(true) { x } else { Value::Null };
    json!({
        "kind": "mask", "arity": r.arity, "mask": texts(&r.mask), "sum_rules": r.sum_rules, "factor": texts(&r.factor),
        "radius": radius_data(&r.radius), "orders": orders, "converges": converges, "independent": r.independent,
        "smoothness": some(json!(r.smoothness())), "smoothness_exact": some(json!(r.smoothness_is_exact())),
        "exponent": some(json!(r.exponent.as_ref().map(bounds))), "attained": some(json!(attained)),
    })
}

/// The same as data.
#[must_use]
pub fn enclosed_data(e: &Enclosed, meaning: Meaning<'_>) -> Value {
    let converges = match (e.exponent.lo > 0, e.exponent.hi <= 0) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    };
    let least = converges.filter(|c| *c).map(|_| smooth_between(e).0.to_string());
    let of = match meaning {
        Meaning::Limit => "limit",
        Meaning::Scheme => "scheme",
        Meaning::Near(_) => "near",
    };
    let near = match meaning {
        Meaning::Near(near) => json!({
            "distance": decimal(&near.distance, true, 20), "within": decimal(&(&near.radius - &near.distance), false, 20),
        }),
        _ => Value::Null,
    };
    json!({
        "kind": "filter", "of": of, "arity": e.arity, "sum_rules": e.sum_rules, "decimals": near,
        "factor": e.factor.iter().map(bounds).collect::<Value>(), "radius": bounds(&e.enclosure),
        "word": e.radius.lower.as_ref().map(|l| &l.word), "converges": converges,
        "smoothness_at_least": least, "exponent": bounds(&e.exponent),
    })
}

/// The same as data.
#[must_use]
pub fn curve_data<E: Entry>(shape: &Shape<E>, r: &CurveRegularity<E>) -> Value {
    let order = |o: &CurveOrder<E>| {
        let outcome = match &o.outcome {
            Outcome::Curve => "curve",
            Outcome::Holds => "holds",
            Outcome::Joint(_) => "joint",
            Outcome::Cycle => "cycle",
            Outcome::Chord(_) => "chord",
            Outcome::Exponent => "exponent",
            Outcome::Open => "open",
        };
        let jump = match &o.outcome {
            Outcome::Joint(jump) => json!({
                "state": shape.states[jump.state].name, "piece": jump.right,
                "cell": jump.seen.as_ref().map(|s| &s.path),
                "left": jump.seen.as_ref().map(|s| texts(&s.left)), "right": jump.seen.as_ref().map(|s| texts(&s.right)),
            }),
            _ => Value::Null,
        };
        json!({
            "order": o.order, "dims": o.dims, "bound": o.threshold.to_string(), "radius": o.enclosure.as_ref().map(bounds),
            "outcome": outcome, "smooth": o.smooth(), "joint": jump,
            "polygons": o.polygons.as_ref().map(|m| json!({ "factors": texts(m), "rate": o.rate().map(|r| r.to_string()) })),
        })
    };
    json!({
        "kind": "curve", "pieces": r.pieces, "shares": r.orders.iter().find_map(|o| o.shares.as_ref()).map(shares), "orders": r.orders.iter().map(order).collect::<Value>(),
        "smoothness": r.smoothness(), "polynomial": r.polynomial,
        "exponent": r.exponent.as_ref().map(bounds), "attained": r.attained,
    })
}

/// What the differences of the control polygons tend to, and how fast.
#[must_use]
pub fn polygons<E: Entry>(shape: &Shape<E>, o: &CurveOrder<E>) -> Option<String> {
    let factors = o.polygons.as_ref()?;
    let named = |(e, m): (usize, &E)| format!("{m} times (in state {})", shape.states[e].name);
    let times = match factors.iter().all(|m| *m == factors[0]) {
        true if factors[0] == E::integer(1) => String::new(),
        true => format!("{} times ", factors[0]),
        false => format!("{} ", listed(&shape.reachable().into_iter().zip(factors).map(named).collect::<Vec<_>>())),
    };
    let k = o.order;
    let by = match k {
        1 => "divided by the length of the cell in the parameter".to_owned(),
        _ => format!("divided by the power {k} of the length of the cell in the parameter"),
    };
    let rate = o.rate()?;
    let how = if rate == 0 {
        "are equal to".to_owned()
    } else {
        let short = rate.to_string();
        let bound = if short.len() <= 24 { short } else { decimal(&rate, true, 6) };
        format!("converge with an error O(r^m), for every r above {bound}, to")
    };
    let which = if k == 1 { "first differences".to_owned() } else { format!("differences of order {k}") };
    Some(format!("the {which} of the control polygons of level m, {by}, {how} {times}the derivative of that order"))
}

/// By reachable state and letter.
fn shares(all: &Shares) -> Value {
    all.iter().map(|own| texts(own)).collect()
}

/// The table of `secant regularity` for a curve that is given by its operators.
#[must_use]
pub fn curve_regularity<E: Entry>(shape: &Shape<E>, r: &CurveRegularity<E>) -> String {
    let mut out = String::new();
    let bound = match r.measure() {
        Measure::Uniform => {
            let n = r.pieces;
            let _ =
                writeln!(out, "curve of {n} pieces in every state that comes back to itself, in the uniform parameter");
            format!("(JSR < {n}^-k)")
        }
        Measure::Shares => {
            let _ = writeln!(
                out,
                "curve in the parameter with the given shares s, which operators of k-th derivatives are divided by"
            );
            "(JSR of the s^-k T < 1)".to_owned()
        }
    };
    let _ = writeln!(
        out,
        "condition   C^k if and only if C^(k-1), products of k-th derivatives tend to 0 on their differences\n            \
         {bound}, and the two values agree at every joint"
    );
    out.push_str("k   dims      JSR on differences of derivatives  bound    joints  C^k    word\n");
    let mut notes = String::new();
    for o in &r.orders {
        let radius = o.enclosure.as_ref().map_or_else(|| "-".to_owned(), interval);
        let joint = match &o.outcome {
            Outcome::Holds => "agree",
            Outcome::Joint(_) => "differ",
            _ => "-",
        };
        let word = match o.smooth() {
            Some(true) => "yes",
            Some(false) => "no",
            None => "open",
        };
        let letters = o.radius.as_ref().and_then(|r| r.lower.as_ref());
        let letters = letters.map_or_else(|| "-".to_owned(), |l| cycle(shape, &l.path));
        let dims = format!("{:?}", o.dims);
        let threshold = o.threshold.to_string();
        let _ = writeln!(out, "{:<3} {dims:<9} {radius:<34} {threshold:<8} {joint:<7} {word:<6} {letters}", o.order);
        if let Some(note) = outcome(shape, o) {
            let _ = writeln!(notes, "order {:<5} {note}", o.order);
        }
        if let Some(note) = polygons(shape, o) {
            let _ = writeln!(notes, "order {:<5} {note}", o.order);
        }
    }
    out.push_str(&notes);
    smoothness(&mut out, r);
    out
}

/// The letters of a cycle of arrows, which are numbered by state and letter, and the state where it begins.
fn cycle<E: Entry>(shape: &Shape<E>, path: &[usize]) -> String {
    let states = shape.reachable().into_iter();
    let arrows: Vec<(usize, usize)> =
        states.flat_map(|e| (0..shape.states[e].pieces.len()).map(move |i| (e, i))).collect();
    let steps: Vec<(usize, usize)> = path.iter().filter_map(|a| arrows.get(*a).copied()).collect();
    let word = word_text(&steps.iter().map(|(_, letter)| *letter).collect::<Vec<_>>());
    match steps.first() {
        Some((e, _)) if shape.states.len() > 1 => format!("{word} at {}", shape.states[*e].name),
        _ => word,
    }
}

/// Why an order is refuted or open.
#[must_use]
pub fn outcome<E: Entry>(shape: &Shape<E>, o: &CurveOrder<E>) -> Option<String> {
    let k = o.order;
    let state = |e: usize| match shape.states.len() {
        1 => String::new(),
        _ => format!(" of state {}", shape.states[e].name),
    };
    Some(match &o.outcome {
        Outcome::Curve | Outcome::Holds => return None,
        Outcome::Joint(jump) => {
            let at = format!("the derivative has two values before piece {}{}", jump.right, state(jump.state));
            match &jump.seen {
                None => at,
                Some(seen) => {
                    let inside = match seen.path.is_empty() {
                        true => String::new(),
                        false => format!(" in the cell {}", word_text(&seen.path)),
                    };
                    let point = |v: &[E]| v.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
                    format!("{at}{inside}: ({}) and ({})", point(&seen.left), point(&seen.right))
                }
            }
        }
        Outcome::Cycle => format!("products along the word of the radius do not tend to 0: not C^{k}"),
        Outcome::Chord(e) => {
            format!("the chord{} of order {} is among the differences of the derivative: not C^{k}", state(*e), k - 1)
        }
        Outcome::Exponent => format!("the exponent of the order before is below {k}: not C^{k}"),
        Outcome::Open => "the bounds of the radius do not decide whether it is below the bound".to_owned(),
    })
}

fn smoothness<E>(out: &mut String, r: &CurveRegularity<E>) {
    let k = r.smoothness();
    if r.polynomial {
        out.push_str("smoothness  the curve is a polynomial in the parameter: C^k for all k\n");
        return;
    }
    let exact = match r.orders.get(k + 1).and_then(CurveOrder::smooth) {
        Some(false) => format!(", and not C^{}", k + 1),
        _ => String::new(),
    };
    let _ = writeln!(out, "smoothness  C^{k}{exact}: proved");
    if let Some(e) = &r.exponent {
        let note = match r.attained {
            Some(true) => "attained",
            Some(false) => "the supremum, not attained",
            None => "the supremum; attained or not: not decided",
        };
        let _ = writeln!(out, "exponent    {} ({note})", interval(e));
    }
}
