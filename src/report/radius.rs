//! Joint spectral radii, regularity and cones as text for a terminal.

use crate::arith::{Integer, Interval, Rational, abs};
use crate::radius::{BlockProof, Ended, Growth, JointRadius, Leading, Lower, Proof};
use crate::shape::Shape;
use crate::shape::word_text;
use crate::theorem::regularity::{Attained, Regularity};
use crate::theorem::smoothness::{CurveOrder, CurveRegularity, Outcome};
use crate::theorem::wavelet::Wavelet;
use malachite_base::num::arithmetic::traits::{Ceiling, Floor, Pow};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Places after the point.
const PLACES: u64 = 12;

/// A decimal of a rational, rounded down or up.
#[must_use]
pub fn decimal(x: &Rational, up: bool, places: u64) -> String {
    let scaled = x * Rational::from(10).pow(places);
    let whole: Integer = if up { scaled.ceiling() } else { scaled.floor() };
    let negative = whole < 0;
    let digits = abs(&Rational::from(whole)).to_string();
    let width = usize::try_from(places).unwrap_or(0);
    let padded = format!("{digits:0>width$}", width = width + 1);
    let (head, tail) = padded.split_at(padded.len() - width);
    let point = if width == 0 { "" } else { "." };
    format!("{}{head}{point}{tail}", if negative { "-" } else { "" })
}

/// `[lo, hi]` with outward rounding, or the number itself where it is short.
#[must_use]
pub fn interval(x: &Interval) -> String {
    let short = x.lo.to_string();
    if x.lo == x.hi && short.len() <= 24 {
        return short;
    }
    format!("[{}, {}]", decimal(&x.lo, false, PLACES), decimal(&x.hi, true, PLACES))
}

/// The answer of `secant jsr`.
#[must_use]
pub fn joint_radius(radius: &JointRadius) -> String {
    let mut out = String::new();
    let Some(lower) = &radius.lower else {
        let _ = match (radius.exact, &radius.upper) {
            (true, _) => writeln!(out, "joint spectral radius 0: all long products vanish"),
            (false, Some(upper)) => {
                let upper = decimal(upper, true, PLACES);
                writeln!(
                    out,
                    "radius      at most {upper}  (no cyclic word with a product that is not nilpotent was found)"
                )
            }
            (false, None) => writeln!(out, "joint spectral radius: not decided"),
        };
        blocks(&mut out, radius);
        out.push_str(stopped(radius));
        return out;
    };
    let value = lower.enclosure(64);
    let power = if lower.length == 1 { String::new() } else { format!(" to the power 1/{}", lower.length) };
    let _ = writeln!(out, "word        {} ({} letters)", word_text(&lower.word), lower.length);
    let _ = writeln!(out, "eigenvalue  {}, its modulus{power}", eigenvalue(lower));
    match (&radius.upper, radius.exact) {
        (_, true) => _ = writeln!(out, "radius      = {}  (proved: the word attains it)", interval(&value)),
        (Some(upper), false) => {
            let both = Interval::new(value.lo.clone(), upper.clone());
            let _ = writeln!(out, "radius      in {}  (not decided whether the word attains it)", interval(&both));
        }
        (None, false) => {
            _ = writeln!(out, "radius      >= {}  (no upper bound found)", decimal(&value.lo, false, PLACES))
        }
    }
    let _ = writeln!(
        out,
        "growth      {}",
        match radius.growth {
            Growth::Bounded => "bounded: products of k letters stay below a constant times radius^k".to_owned(),
            Growth::Unbounded(size) => {
                format!(
                    "marginal: the word attains the radius, with a Jordan block of size {size} at the largest modulus"
                )
            }
            Growth::Unknown => "not decided".to_owned(),
        }
    );
    blocks(&mut out, radius);
    out.push_str(stopped(radius));
    out
}

/// The eigenvalue of a word: by its minimal polynomial, or by a disc.
fn eigenvalue(lower: &Lower) -> String {
    match &lower.eigenvalue {
        Leading::Exact(root) => format!("root of {}", root.minpoly().primitive_display("x")),
        Leading::Disc(disc) => {
            let place = |x: &Rational| format!("[{}, {}]", decimal(x, false, PLACES), decimal(x, true, PLACES));
            let (x, y) = &disc.centre;
            let error = decimal(&disc.error, true, 2 * PLACES);
            format!("within {error} of {} + {} i", place(x), place(y))
        }
    }
}

fn blocks(out: &mut String, radius: &JointRadius) {
    for (k, block) in radius.blocks.iter().enumerate() {
        let proof = block.proof.as_ref().map_or_else(|| "no proof".to_owned(), proof_words);
        let bound = block.bound.as_ref().map_or_else(|| "-".to_owned(), |b| decimal(b, true, PLACES));
        let bound = if block.attains { "the radius".to_owned() } else { bound };
        let _ = writeln!(out, "block {k}     dimensions {:?}: {proof}, at most {bound}", block.block.system.dims);
    }
}

/// What a proof is.
#[must_use]
pub fn proof_words(proof: &Proof) -> String {
    match proof {
        Proof::Polytope(p) => format!("polytope of {} points", p.points.len()),
        Proof::Quadratic(_) => "quadratic norm".to_owned(),
        Proof::Balanced(p) => format!("complex balanced polytope of {} points", p.points.len()),
        Proof::Tree(t) if t.codes.iter().flatten().all(|w| w.len() == 1) => "norms of the letters".to_owned(),
        Proof::Tree(t) => format!("norms of the {} words of a tree", t.codes.iter().map(Vec::len).sum::<usize>()),
        Proof::Transposed(inner) => format!("{}, of the transposed matrices", proof_words(inner)),
    }
}

/// Why the search ended without the exact radius, and what more effort would try.
fn stopped(radius: &JointRadius) -> &'static str {
    match radius.ended {
        Ended::Done => "",
        Ended::Exhausted => {
            "stopped     every method reached its limits; --time 60 tries larger polytopes and more words, --longest 32 longer words\n"
        }
        Ended::Work => "stopped     the work set aside is spent; --time 60 goes on\n",
        Ended::Clock => {
            "stopped     by the clock, so that another run may print other bounds; a larger --time goes on\n"
        }
    }
}

/// The same as data.
#[must_use]
pub fn radius_json(name: &str, radius: &JointRadius) -> Value {
    let bounds = radius.enclosure(64);
    let text = |x: &Rational, up: bool| decimal(x, up, 18);
    let word = radius.lower.as_ref().map(|l| {
        let polynomial = l.root().map(|r| r.minpoly().primitive_display("x"));
        json!({"letters": l.word, "length": l.length, "polynomial": polynomial})
    });
    let (growth, block) = match radius.growth {
        Growth::Bounded => ("bounded", None),
        Growth::Unbounded(size) => ("marginal", Some(size)),
        Growth::Unknown => ("undecided", None),
    };
    let own = |b: &BlockProof| {
        json!({
            "dimensions": b.block.system.dims,
            "proof": b.proof.as_ref().map(proof_words),
            "upper": b.bound.as_ref().map(|x| text(x, true)),
            "attains": b.attains,
        })
    };
    json!({
        "name": name,
        "exact": radius.exact,
        "lower": bounds.as_ref().map(|b| text(&b.lo, false)).or_else(|| radius.lower.as_ref().map(|l| text(&l.enclosure(64).lo, false))),
        "upper": bounds.as_ref().map(|b| text(&b.hi, true)),
        "rational": match (radius.exact, &radius.lower) {
            (true, Some(lower)) => lower.rational().map(|x| x.to_string()),
            (true, None) => Some("0".to_owned()),
            (false, _) => None,
        },
        "word": word,
        "growth": growth,
        "jordan_block": block,
        "blocks": radius.blocks.iter().map(own).collect::<Vec<_>>(),
        "ended": match radius.ended {
            Ended::Done => "done",
            Ended::Exhausted => "limits",
            Ended::Work => "work",
            Ended::Clock => "clock",
        },
    })
}

/// The table of `secant regularity`.
#[must_use]
pub fn regularity(r: &Regularity) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "arity {}, sum rules of order {}", r.arity, r.sum_rules);
    let factor: Vec<String> = r.factor.iter().map(ToString::to_string).collect();
    let _ = writeln!(out, "factor b    {}", factor.join(" "));
    out.push_str(&joint_radius(&r.radius));
    condition(&mut out, r.arity);
    let _ = writeln!(out, "k   JSR of differences of order k+1   bound {}^-k   C^k", r.arity);
    for o in &r.orders {
        let radius = o.radius.as_ref().map_or_else(|| "-".to_owned(), interval);
        let word = match o.smooth {
            Some(true) => "yes",
            Some(false) if r.independent => "no",
            Some(false) => "not by this condition",
            None => "not decided",
        };
        let _ = writeln!(out, "{:<3} {radius:<33} {:<12} {word}", o.order, o.threshold.to_string());
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
    out
}

/// The words of the condition that the table applies.
fn condition(out: &mut String, arity: usize) {
    let _ = writeln!(
        out,
        "condition   JSR < {arity}^-m on the differences of order m+1 gives C^m\n            \
         (for arity 2 that of Levin and Levin: JSR < 2^-m for C^m)"
    );
}

/// The table of `secant regularity` for a scaling function.
#[must_use]
pub fn wavelet(w: &Wavelet) -> String {
    let mut out = String::new();
    let n = w.moments;
    let _ = writeln!(out, "Daubechies' scaling function with {n} vanishing moments: a(z) = 2 ((1+z)/2)^{n} q(z)");
    if let Some(lower) = &w.radius.lower {
        let _ = writeln!(out, "word        {} ({} letters)", word_text(&lower.word), lower.length);
    }
    let _ = writeln!(out, "radius      {}  (of 2^{} q)", interval(&w.enclosure), 1 - i64::try_from(n).unwrap_or(0));
    condition(&mut out, 2);
    let _ = writeln!(out, "exponent    {}", interval(&w.exponent));
    let whole = |x: &Rational| x.ceiling() - Integer::from(1);
    let (least, most) = (whole(&w.exponent.lo), whole(&w.exponent.hi));
    if least == most {
        let _ = writeln!(out, "smoothness  C^{least}");
    } else {
        let _ = writeln!(out, "smoothness  at least C^{least}, at most C^{most}");
    }
    out
}

/// The table of `secant regularity` for a curve that is given by its operators.
#[must_use]
pub fn curve_regularity(shape: &Shape, r: &CurveRegularity) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "curve of {} pieces in every state, in the uniform parameter", r.pieces);
    let _ = writeln!(
        out,
        "condition   C^k if and only if C^(k-1), products of k-th derivatives tend to 0 on their differences\n            \
         (JSR < {}^-k), and the two values agree at every joint",
        r.pieces
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
        let letters = letters.map_or_else(|| "-".to_owned(), |l| cycle(shape, r.pieces, &l.path));
        let dims = format!("{:?}", o.dims);
        let threshold = o.threshold.to_string();
        let _ = writeln!(out, "{:<3} {dims:<9} {radius:<34} {threshold:<8} {joint:<7} {word:<6} {letters}", o.order);
        if let Some(note) = outcome(shape, o) {
            let _ = writeln!(notes, "order {:<5} {note}", o.order);
        }
    }
    out.push_str(&notes);
    smoothness(&mut out, r);
    out
}

/// The letters of a cycle of arrows, which are numbered by state and letter, and the state where it begins.
fn cycle(shape: &Shape, pieces: usize, path: &[usize]) -> String {
    let word = word_text(&path.iter().map(|a| a % pieces).collect::<Vec<_>>());
    match path.first().and_then(|a| shape.reachable().get(a / pieces).copied()) {
        Some(e) if shape.states.len() > 1 => format!("{word} at {}", shape.states[e].name),
        _ => word,
    }
}

/// Why an order is refuted or open.
fn outcome(shape: &Shape, o: &CurveOrder) -> Option<String> {
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
                    let point = |v: &[Rational]| v.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
                    format!("{at}{inside}: ({}) and ({})", point(&seen.left), point(&seen.right))
                }
            }
        }
        Outcome::Cycle => format!("products along the word of the radius do not tend to 0: not C^{k}"),
        Outcome::Chord(e) => {
            format!("the chord{} of order {} is among the differences of the derivative: not C^{k}", state(*e), k - 1)
        }
        Outcome::Open => "the bounds of the radius do not decide whether it is below the bound".to_owned(),
    })
}

fn smoothness(out: &mut String, r: &CurveRegularity) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn decimals_round_the_way_they_should() {
        assert_eq!(decimal(&ratio(1, 3), false, 3), "0.333");
        assert_eq!(decimal(&ratio(1, 3), true, 3), "0.334");
        assert_eq!(decimal(&ratio(-1, 3), true, 3), "-0.333");
        assert_eq!(decimal(&ratio(25, 2), false, 0), "12");
    }
}
