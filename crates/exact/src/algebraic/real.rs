//! Real roots alone: isolated by Descartes' rule of signs, refined by signs.

use super::ball::{Ball, evaluate, shifted};
use crate::arith::Integer;
use crate::poly::ints::root_bound;
use malachite_base::num::logic::traits::SignificantBits;

/// An interval `(lo, hi) 2^exp` with one root and with values of different signs at its ends.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    lo: Integer,
    hi: Integer,
    exp: i64,
    /// Whether the polynomial is positive at the lower end.
    positive: bool,
    /// The binary logarithm of the parts that the next step of Newton's method tries to gain.
    gain: u64,
}

/// The real roots, ascending, of an irreducible integer polynomial of degree at least 2.
///
/// Source: G. E. Collins, A. G. Akritas, *Polynomial real root isolation using Descartes' rule of signs* (1976).
pub(super) fn isolate_real(f: &[Integer]) -> Vec<Cell> {
    let mirrored: Vec<Integer> = f.iter().enumerate().map(|(k, c)| if k % 2 == 1 { -c } else { c.clone() }).collect();
    let negative = positive_intervals(&mirrored).into_iter().rev().map(|(c, exp)| (-(c + Integer::from(1)), exp));
    negative.chain(positive_intervals(f)).map(|(lo, exp)| Cell::new(f, lo, exp)).collect()
}

/// Intervals `(c, c + 1) 2^exp` with one positive root each, ascending.
fn positive_intervals(f: &[Integer]) -> Vec<(Integer, i64)> {
    let bound = root_bound(f);
    let n = f.len() as i64 - 1;
    // f(2^bound x), in integers.
    let least = if bound < 0 { bound * n } else { 0 };
    let scaled = f.iter().enumerate().map(|(k, c)| c << (bound * k as i64 - least).unsigned_abs()).collect();
    let mut found = Vec::new();
    let mut stack: Vec<(Vec<Integer>, Integer, i64)> = vec![(scaled, Integer::from(0), 0)];
    while let Some((p, c, depth)) = stack.pop() {
        match variations(&p) {
            0 => {}
            1 => found.push((c, bound - depth)),
            _ => {
                // The left half, then the right one on top of it for the same stack.
                let left: Vec<Integer> =
                    p.iter().enumerate().map(|(k, x)| x << (n.unsigned_abs() - k as u64)).collect();
                let mut right = left.clone();
                shift_by_one(&mut right);
                let c: Integer = c << 1u64;
                stack.push((right, &c + Integer::from(1), depth + 1));
                stack.push((left, c, depth + 1));
            }
        }
    }
    found
}

/// Sign variations of `(x + 1)^n p(1 / (x + 1))`: a bound, of the right parity, for the roots in `(0, 1)`.
fn variations(p: &[Integer]) -> usize {
    let mut q: Vec<Integer> = p.iter().rev().cloned().collect();
    shift_by_one(&mut q);
    let signs: Vec<bool> = q.iter().filter(|c| **c != 0).map(|c| *c > 0).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

fn shift_by_one(p: &mut [Integer]) {
    for i in 0..p.len() {
        for j in (i..p.len() - 1).rev() {
            let (low, high) = p.split_at_mut(j + 1);
            low[j] += &high[0];
        }
    }
}

/// Whether the polynomial is positive at `x 2^exp`, which is no root.
fn positive_at(f: &[Integer], x: &Integer, exp: i64) -> bool {
    if *x == 0 {
        return f[0] > 0;
    }
    let mut extra = 32 + f.len() as u64;
    loop {
        let point = Ball { re: x << extra, im: Integer::from(0), radius: Integer::from(0), exp: exp - extra as i64 };
        if let Some(positive) = evaluate(f, &point).real_sign() {
            return positive;
        }
        extra *= 2;
    }
}

impl Cell {
    fn new(f: &[Integer], lo: Integer, exp: i64) -> Self {
        let (hi, positive) = (&lo + Integer::from(1), positive_at(f, &lo, exp));
        Self { lo, hi, exp, positive, gain: 2 }
    }

    /// The disc with the interval as its diameter.
    pub fn ball(&self) -> Ball {
        Ball { re: &self.lo + &self.hi, im: Integer::from(0), radius: &self.hi - &self.lo, exp: self.exp - 1 }
    }

    /// Shrinks the interval until its half is at most `2^t`: steps of Newton's method, each proved by two signs, with
    /// bisections where they fail.
    ///
    /// Source: J. Abbott, *Quadratic interval refinement for real roots* (2014).
    pub fn refine(&mut self, f: &[Integer], t: i64) {
        while !self.ball().is_within(t) {
            if self.newton(f).is_none() {
                self.gain = (self.gain / 2).max(1);
                self.bisect(f);
            }
        }
    }

    fn newton(&mut self, f: &[Integer]) -> Option<()> {
        let middle = self.ball();
        let width = middle.radius.significant_bits();
        let sharp = middle.log_size() - middle.exp + (self.gain + f.len() as u64) as i64 + 32;
        let point = middle.regrid(sharp.max(64));
        let values = evaluate(f, &point);
        let (step, _) = values.step()?;
        // The grid is 2^gain times finer than the interval.
        let exp = middle.exp + width as i64 - self.gain as i64 - 2;
        let at = |x: &Integer, e: i64| shifted(x, e - exp);
        let guess = at(&point.re, point.exp) - at(&step, values.exp());
        let (lo, hi) = (&guess - Integer::from(1), guess + Integer::from(2));
        if lo < at(&self.lo, self.exp) || hi > at(&self.hi, self.exp) {
            return None;
        }
        if positive_at(f, &lo, exp) != self.positive || positive_at(f, &hi, exp) == self.positive {
            return None;
        }
        (self.lo, self.hi, self.exp) = (lo, hi, exp);
        self.gain *= 2;
        Some(())
    }

    fn bisect(&mut self, f: &[Integer]) {
        self.lo <<= 1u64;
        self.hi <<= 1u64;
        self.exp -= 1;
        let middle = (&self.lo + &self.hi) >> 1u64;
        if positive_at(f, &middle, self.exp) == self.positive {
            self.lo = middle;
        } else {
            self.hi = middle;
        }
    }
}
