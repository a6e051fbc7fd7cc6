//! Joint spectral radii, regularity and cones as text for a terminal.

use crate::arith::{Integer, Interval, Rational, abs};
use crate::radius::{Growth, JointRadius, Proof};
use crate::shape::word_text;
use malachite_base::num::arithmetic::traits::{Ceiling, Floor, Pow};
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
        return match radius.exact {
            true => "joint spectral radius 0: all long products vanish\n".to_owned(),
            false => "joint spectral radius: not decided\n".to_owned(),
        };
    };
    let value = lower.enclosure(64);
    let root = lower.root.minpoly().primitive_display("x");
    let power = if lower.length == 1 { String::new() } else { format!(" to the power 1/{}", lower.length) };
    let _ = writeln!(out, "word        {} ({} letters)", word_text(&lower.word), lower.length);
    let _ = writeln!(out, "eigenvalue  root of {root}, its modulus{power}");
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
    for (k, block) in radius.blocks.iter().enumerate() {
        let proof = match &block.proof {
            Some(Proof::Polytope(p)) => format!("polytope of {} points", p.points.len()),
            Some(Proof::Quadratic(_)) => "quadratic norm".to_owned(),
            Some(Proof::Balanced(p)) => format!("complex balanced polytope of {} points", p.points.len()),
            Some(Proof::Tree(t)) => {
                format!("norms of the {} words of a tree", t.codes.iter().map(Vec::len).sum::<usize>())
            }
            None => "no proof".to_owned(),
        };
        let bound = block.bound.as_ref().map_or_else(|| "-".to_owned(), |b| decimal(b, true, PLACES));
        let bound = if block.attains { "the radius".to_owned() } else { bound };
        let _ = writeln!(out, "block {k}     dimensions {:?}: {proof}, at most {bound}", block.block.system.dims);
    }
    out
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
