//! Joint spectral radii, regularity and cones as text for a terminal.

use super::words::count;
use crate::arith::{Integer, Interval, Rational, abs};
use crate::linalg::Entry;
use crate::radius::{BlockProof, Ended, Growth, JointRadius, Leading, Lower, Proof};
use crate::shape::word_text;
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
pub fn joint_radius<E: Entry>(radius: &JointRadius<E>) -> String {
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
    let _ = writeln!(out, "word        {} ({})", word_text(&lower.word), count(lower.length, "letter"));
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

fn blocks<E: Entry>(out: &mut String, radius: &JointRadius<E>) {
    for (k, block) in radius.blocks.iter().enumerate() {
        let proof = block.proof.as_ref().map_or_else(|| "no proof".to_owned(), proof_words);
        let bound = block.bound.as_ref().map_or_else(|| "-".to_owned(), |b| decimal(b, true, PLACES));
        let bound = if block.attains { "the radius".to_owned() } else { bound };
        let _ = writeln!(out, "block {k}     dimensions {:?}: {proof}, at most {bound}", block.block.system.dims);
    }
}

/// What a proof is.
#[must_use]
pub fn proof_words<E>(proof: &Proof<E>) -> String {
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
fn stopped<E>(radius: &JointRadius<E>) -> &'static str {
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
pub fn radius_json<E: Entry>(name: &str, radius: &JointRadius<E>) -> Value {
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
    let own = |b: &BlockProof<E>| {
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
