//! All roots of a square-free polynomial in disjoint certified discs.

use super::ball::{Ball, evaluate, root_disc};
use super::propose::{Aberth, polish};
use crate::arith::Integer;
use malachite_base::num::logic::traits::SignificantBits;

/// An isolating disc is this many times smaller than the distance to every other disc, so that Newton's method
/// started at its centre converges quadratically.
pub(super) const GUARD: u32 = 8;

/// The real roots ascending, then the roots in the upper half plane in no particular order.
pub(super) struct Isolated {
    pub real: Vec<Ball>,
    pub upper: Vec<Ball>,
}

/// Isolates the roots of a square-free integer polynomial of positive degree with nonzero constant term.
///
/// Every disc of radius `n |f(z) / f'(z)|` around any point `z` contains a root; `n` disjoint such discs contain one
/// each. A disc around a real point then holds a real root, and one that misses the real axis holds none.
/// Proposals of growing precision are tried until the discs are disjoint.
pub(super) fn isolate(f: &[Integer]) -> Isolated {
    if f.len() == 2 {
        return linear(f);
    }
    let mut turn = 0.7;
    loop {
        let mut aberth = Aberth::new(f, turn);
        let mut points = if aberth.fits() {
            aberth.run();
            if let Some(found) = certify(f, &aberth.balls(53), 64, 26) {
                return found;
            }
            aberth.balls(64)
        } else {
            aberth.starting_balls()
        };
        let mut precision = 128;
        while precision <= 1 << 14 {
            polish(f, &mut points, precision);
            if let Some(found) = certify(f, &points, precision, precision / 2) {
                return found;
            }
            precision *= 2;
        }
        turn = next_turn(turn);
    }
}

#[allow(clippy::float_arithmetic)] // only where the next proposals start
fn next_turn(turn: f64) -> f64 {
    turn + 0.37
}

fn linear(f: &[Integer]) -> Isolated {
    let exp = -(f[1].significant_bits() as i64) - 64;
    let re = (-&f[0] << exp.unsigned_abs()) / &f[1];
    Isolated { real: vec![Ball { re, im: Integer::from(0), radius: Integer::from(1), exp }], upper: Vec::new() }
}

/// Splits into real points and upper half plane; a point counts as real when its imaginary part is `2^-tolerance` of
/// its size or less.
fn sort_points(points: &[Ball], precision: i64, tolerance: i64) -> Option<(Vec<Ball>, Vec<Ball>)> {
    let (mut real, mut upper) = (Vec::new(), Vec::new());
    for p in points {
        if p.re == 0 && p.im == 0 {
            return None;
        }
        let small = p.im.significant_bits() as i64 + p.exp <= p.log_size() - tolerance;
        if small && p.re != 0 {
            real.push(Ball { im: Integer::from(0), ..p.clone() }.regrid(precision));
        } else if p.im > 0 {
            upper.push(p.regrid(precision));
        }
    }
    (real.len() + 2 * upper.len() == points.len()).then_some((real, upper))
}

/// One Newton step at higher precision sharpens a proposal of double precision.
fn sharpened(f: &[Integer], p: &Ball) -> Ball {
    match evaluate(f, p).step() {
        Some((re, im)) => {
            let q = Ball { re: &p.re - re, im: &p.im - im, ..p.clone() };
            if q.re == 0 && q.im == 0 { p.clone() } else { q }
        }
        None => p.clone(),
    }
}

fn certify(f: &[Integer], points: &[Ball], precision: i64, tolerance: i64) -> Option<Isolated> {
    let (real, upper) = sort_points(points, precision, tolerance)?;
    let discs = |list: Vec<Ball>| list.iter().map(|p| root_disc(f, &sharpened(f, p))).collect::<Option<Vec<_>>>();
    let (mut real, upper) = (discs(real)?, discs(upper)?);
    if upper.iter().any(|b| b.im <= &b.radius * Integer::from(GUARD)) {
        return None;
    }
    let all: Vec<&Ball> = real.iter().chain(&upper).collect();
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            if !(a.apart(b, GUARD + 1, 1) && b.apart(a, GUARD + 1, 1)) {
                return None;
            }
        }
    }
    real.sort_by(|a, b| a.cmp_re(b).unwrap_or(std::cmp::Ordering::Equal));
    Some(Isolated { real, upper })
}

/// The same root in a disc of radius at most `2^t`, by Newton's method from a disc already known to hold it.
///
/// # Panics
/// Never for discs from [`isolate`]: there the method converges once the precision is high enough.
pub(super) fn refine(f: &[Integer], isolating: &Ball, current: &Ball, t: i64) -> Ball {
    let mut best = current.clone();
    let mut precision = (best.log_size() - best.exp).max(64);
    while !best.is_within(t) {
        let lost = best.radius.significant_bits() as i64;
        let enough = best.log_size() - t + lost + 8;
        precision = (2 * precision).min(enough.max(precision + 32));
        let next = root_disc(f, &sharpened(f, &best.regrid(precision)));
        if let Some(next) = next.filter(|b| b.inside(isolating, GUARD))
            && next.is_within(best.exp + lost - 1)
        {
            best = next;
        }
    }
    best
}
