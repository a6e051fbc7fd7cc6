//! Proposals for all roots of a polynomial, by Aberth's iteration. Nothing here is trusted: the discs around the
//! proposals are certified afterwards.
#![allow(clippy::float_arithmetic, clippy::cast_precision_loss)] // floats only propose

use super::ball::{Ball, evaluate, shifted};
use crate::arith::Integer;
use malachite_base::num::logic::traits::SignificantBits;
use std::collections::BTreeMap;

type C = (f64, f64);

const SWEEPS: usize = 120;

/// `mantissa * 2^exponent` with a mantissa in `[1/2, 1)` or 0.
fn split(x: &Integer) -> (f64, i64) {
    let bits = x.significant_bits() as i64;
    let top = shifted(x, 53 - bits);
    let digits = i64::try_from(&top).unwrap_or(0);
    (digits as f64 / (1u64 << 53) as f64, bits)
}

fn ldexp(m: f64, e: i64) -> f64 {
    let half = e.clamp(-2000, 2000) / 2;
    let rest = e.clamp(-2000, 2000) - half;
    m * 2f64.powi(half as i32) * 2f64.powi(rest as i32)
}

fn mul(a: C, b: C) -> C {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn div(a: C, b: C) -> C {
    let scale = b.0.abs().max(b.1.abs());
    let (c, d) = (b.0 / scale, b.1 / scale);
    let norm = (c * c + d * d) * scale;
    ((a.0 * c + a.1 * d) / norm, (a.1 * c - a.0 * d) / norm)
}

fn size(a: C) -> f64 {
    a.0.hypot(a.1)
}

/// Aberth's iteration on `f(2^scale y)`, all in the variable `y`.
pub(super) struct Aberth {
    split: Vec<(f64, i64)>,
    scale: i64,
    rows: BTreeMap<i64, Vec<f64>>,
    /// The current approximations of the roots in `y`.
    pub points: Vec<C>,
    /// The starting points: binary logarithm of the modulus in `y`, and angle.
    start: Vec<C>,
}

impl Aberth {
    /// Starting points on the circles of the Newton polygon (Bini); `turn` rotates them.
    pub fn new(coeffs: &[Integer], turn: f64) -> Self {
        let n = coeffs.len() - 1;
        let parts: Vec<(f64, i64)> = coeffs.iter().map(split).collect();
        let scale = (parts[0].1 - parts[n].1).div_euclid(n as i64);
        let log = |k: usize| parts[k].0.abs().log2() + (parts[k].1 + scale * k as i64) as f64;
        let mut hull: Vec<usize> = Vec::new();
        for k in (0..=n).filter(|&k| parts[k].0 != 0.0) {
            while let [.., i, j] = hull[..] {
                let keeps = (log(j) - log(i)) * (k - i) as f64 > (log(k) - log(i)) * (j - i) as f64;
                if keeps {
                    break;
                }
                hull.pop();
            }
            hull.push(k);
        }
        let mut start = Vec::with_capacity(n);
        for edge in hull.windows(2) {
            let (i, j) = (edge[0], edge[1]);
            let radius = (log(i) - log(j)) / (j - i) as f64;
            for t in 0..j - i {
                let angle = std::f64::consts::TAU * (t as f64 / (j - i) as f64 + i as f64 / n as f64) + turn;
                start.push((radius, angle));
            }
        }
        let place = |(r, angle): &C| (r.exp2() * angle.cos(), r.exp2() * angle.sin());
        let points = start.iter().map(place).collect();
        Self { split: parts, scale, rows: BTreeMap::new(), points, start }
    }

    /// Whether all sizes are well inside the range of double precision.
    pub fn fits(&self) -> bool {
        self.start.iter().all(|(log, _)| log.abs() < 900.0)
    }

    /// The starting points, of any size.
    pub fn starting_balls(&self) -> Vec<Ball> {
        let ball = |(log, angle): &C| {
            let (whole, fraction) = (log.floor(), (log - log.floor()).exp2());
            let digit = |t: f64| Integer::from((t * fraction * (1u64 << 52) as f64) as i64);
            let exp = whole as i64 - 52 + self.scale;
            Ball { re: digit(angle.cos()), im: digit(angle.sin()), radius: Integer::from(0), exp }
        };
        self.start.iter().map(ball).collect()
    }

    /// The coefficients at points of size `2^e`, scaled into the range of `f64`.
    fn row(&mut self, e: i64) -> &[f64] {
        let (split, scale) = (&self.split, self.scale);
        self.rows.entry(e).or_insert_with(|| {
            let exponent = |k: usize| split[k].1 + (scale + e) * k as i64;
            let top = (0..split.len()).filter(|&k| split[k].0 != 0.0).map(exponent).max().unwrap_or(0);
            (0..split.len()).map(|k| ldexp(split[k].0, exponent(k) - top)).collect()
        })
    }

    /// The Newton correction at `y` in double precision, and whether it is only rounding noise.
    fn newton(&mut self, y: C) -> (C, bool) {
        let e = size(y).log2().ceil().clamp(-1000.0, 1000.0) as i64;
        let x = (ldexp(y.0, -e), ldexp(y.1, -e));
        let r = size(x);
        let (mut p, mut d, mut bound) = ((0.0, 0.0), (0.0, 0.0), 0.0);
        for c in self.row(e).iter().rev() {
            d = mul(d, x);
            d = (d.0 + p.0, d.1 + p.1);
            p = mul(p, x);
            p.0 += c;
            bound = bound * r + c.abs();
        }
        let step = div(p, d);
        let noise = size(p) <= 4.0 * f64::EPSILON * bound;
        ((ldexp(step.0, e), ldexp(step.1, e)), noise)
    }

    fn sweep_step(&self, i: usize, newton: C) -> C {
        let y = self.points[i];
        let mut sum = (0.0, 0.0);
        for (j, z) in self.points.iter().enumerate() {
            if j != i {
                let q = div((1.0, 0.0), (y.0 - z.0, y.1 - z.1));
                sum = (sum.0 + q.0, sum.1 + q.1);
            }
        }
        let m = mul(newton, sum);
        let step = div(newton, (1.0 - m.0, -m.1));
        if step.0.is_finite() && step.1.is_finite() { step } else { newton }
    }

    /// Runs in double precision; bounded by a fixed number of sweeps.
    pub fn run(&mut self) {
        let mut active: Vec<usize> = (0..self.points.len()).collect();
        for _ in 0..SWEEPS {
            let mut next = Vec::new();
            for &i in &active {
                let y = self.points[i];
                let (newton, noise) = self.newton(y);
                let step = self.sweep_step(i, newton);
                if step.0.is_finite() && step.1.is_finite() {
                    self.points[i] = (y.0 - step.0, y.1 - step.1);
                    if !noise && size(step) > 4.0 * f64::EPSILON * size(y) {
                        next.push(i);
                    }
                }
            }
            active = next;
            if active.is_empty() {
                break;
            }
        }
    }

    /// The approximations as dyadic points of `precision` bits.
    pub fn balls(&self, precision: i64) -> Vec<Ball> {
        let grid = |y: C| {
            let e = size(y).log2().ceil().clamp(-1020.0, 1020.0) as i64;
            let digit = |t: f64| Integer::from(ldexp(t, 60 - e) as i64);
            let ball = Ball { re: digit(y.0), im: digit(y.1), radius: Integer::from(0), exp: e - 60 + self.scale };
            if ball.re == 0 && ball.im == 0 { ball } else { ball.regrid(precision) }
        };
        self.points.iter().map(|y| grid(*y)).collect()
    }
}

/// Sweeps with values of `precision` bits: only the polynomial is evaluated precisely, the rest of a correction needs
/// no more than double precision.
pub(super) fn polish(coeffs: &[Integer], points: &mut [Ball], precision: i64) {
    let mut active: Vec<usize> = (0..points.len()).collect();
    for p in points.iter_mut() {
        *p = p.regrid(precision);
    }
    for _ in 0..60 {
        let mut next = Vec::new();
        for &i in &active {
            let values = evaluate(coeffs, &points[i]);
            // A value within its own error says nothing at this precision.
            let Some(step) = values.step().filter(|_| !values.is_noise()) else { continue };
            let factor = correction(points, i, &step, values.exp());
            let moved = scaled_step(&step, factor);
            let significant = moved.0.significant_bits().max(moved.1.significant_bits());
            let p = &mut points[i];
            p.re -= moved.0;
            p.im -= moved.1;
            if p.re == 0 && p.im == 0 {
                p.re = Integer::from(1);
            }
            *p = p.regrid(precision);
            if significant > 8 {
                next.push(i);
            }
        }
        active = next;
        if active.is_empty() {
            break;
        }
    }
}

/// `1 / (1 - step * sum of 1 / (z_i - z_j))`, or 1 where that is not finite.
fn correction(points: &[Ball], i: usize, step: &(Integer, Integer), exp: i64) -> C {
    let z = &points[i];
    let (sr, si) = (split(&step.0), split(&step.1));
    let mut m = (0.0, 0.0);
    for (j, w) in points.iter().enumerate().filter(|(j, _)| *j != i) {
        let low = z.exp.min(w.exp);
        let gap = |a: &Integer, b: &Integer| shifted(a, z.exp - low) - shifted(b, w.exp - low);
        let (dr, di) = (split(&gap(&z.re, &w.re)), split(&gap(&z.im, &w.im)));
        let top = if dr.0 == 0.0 {
            di.1
        } else if di.0 == 0.0 {
            dr.1
        } else {
            dr.1.max(di.1)
        };
        if (dr.0 == 0.0 && di.0 == 0.0) || j == i {
            continue;
        }
        let d = (ldexp(dr.0, dr.1 - top), ldexp(di.0, di.1 - top));
        let shift = exp - low - top;
        let s = (ldexp(sr.0, sr.1 + shift), ldexp(si.0, si.1 + shift));
        let q = div(s, d);
        m = (m.0 + q.0, m.1 + q.1);
    }
    let factor = div((1.0, 0.0), (1.0 - m.0, -m.1));
    if factor.0.is_finite() && factor.1.is_finite() { factor } else { (1.0, 0.0) }
}

/// `step * factor` with a factor of double precision.
fn scaled_step(step: &(Integer, Integer), factor: C) -> (Integer, Integer) {
    let factor = (factor.0.clamp(-1e6, 1e6), factor.1.clamp(-1e6, 1e6));
    let fixed = |t: f64| Integer::from((t * (1u64 << 40) as f64) as i64);
    let (c, d) = (fixed(factor.0), fixed(factor.1));
    ((&step.0 * &c - &step.1 * &d) >> 40u64, (&step.0 * &d + &step.1 * &c) >> 40u64)
}
