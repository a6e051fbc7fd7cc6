//! Real algebraic numbers on an interval of the line.

use super::{Root, cmp_real, real_roots};
use crate::arith::Rational;
use crate::poly::{Poly, factor};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;
use std::cmp::Ordering;

/// The different real roots of a polynomial in a closed interval, ascending.
#[must_use]
pub fn roots_within(f: &Poly, (lo, hi): &(Rational, Rational)) -> Vec<Root> {
    let (lo, hi) = (Root::from_rational(lo), Root::from_rational(hi));
    let inside = |r: &Root| cmp_real(r, &lo) != Ordering::Less && cmp_real(r, &hi) != Ordering::Greater;
    let factors = factor(f);
    let mut all: Vec<Root> = factors.iter().flat_map(|(g, _)| real_roots(g)).filter(inside).collect();
    all.sort_by(cmp_real);
    all
}

/// The simplest rational strictly between two real numbers, the first of which is smaller.
#[must_use]
pub fn between(a: &Root, b: &Root) -> Rational {
    let mut bits = 32;
    loop {
        let (low, high) = (a.enclosure(bits).0.hi, b.enclosure(bits).0.lo);
        if low < high {
            return Rational::simplest_rational_in_open_interval(&low, &high);
        }
        bits *= 2;
    }
}

/// Numbers of an interval, ascending and each once.
#[must_use]
pub fn sorted(mut marks: Vec<Root>, range: &(Rational, Rational)) -> Vec<Root> {
    let (lo, hi) = (Root::from_rational(&range.0), Root::from_rational(&range.1));
    marks.retain(|m| cmp_real(m, &lo) != Ordering::Less && cmp_real(m, &hi) != Ordering::Greater);
    marks.sort_by(cmp_real);
    marks.dedup_by(|a, b| cmp_real(a, b) == Ordering::Equal);
    marks
}
