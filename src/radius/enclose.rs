//! Polytopes around the attractors of a system that contracts: grown in floats, then made exact (theory §1, Lemma 1′).
#![allow(clippy::float_arithmetic, reason = "proposes polytopes and weights, which are checked exactly")]

use super::exact::grid_of;
use super::float::{Floats, dot};
use super::simplex::cone_combination;
use crate::arith::{Rational, abs, to_f64};
use crate::shape::{Polytopes, Shape, Weights, difference};

/// Most points of all polytopes together.
const MAX_POINTS: usize = 320;
/// By how much the hull of the attractor is enlarged at first.
const ROOMS: [f64; 4] = [0.25, 1.0, 4.0, 24.0];
/// Rounds in which the attractor is approached, and directions in which its extreme points are kept.
const ROUNDS: usize = 200;
const DIRECTIONS: usize = 24;
/// Binary places of the centres.
const CENTRE_BITS: u32 = 8;

/// Polytopes that all pieces shrink, where `value < 1` is about the joint spectral radius of the linear parts of the operators;
/// `None` where none with few points was found.
///
/// # Cost
/// At most a few thousand small linear programs.
pub(super) fn polytopes(shape: &Shape, value: f64) -> Option<Polytopes> {
    let search = Search::new(shape, (1.0 - value) / 4.0);
    ROOMS.into_iter().find_map(|room| search.attempt(room))
}

/// A piece in floats.
struct Map {
    from: usize,
    to: usize,
    letter: usize,
    op: Floats,
}

struct Search<'a> {
    shape: &'a Shape,
    reachable: Vec<usize>,
    maps: Vec<Map>,
    /// Rational points near the averages of the attractors.
    centres: Vec<Vec<Rational>>,
    floats: Vec<Vec<f64>>,
    /// Extreme points of the attractors.
    clouds: Vec<Vec<Vec<f64>>>,
    /// The share `m` of the centre in all images.
    share: f64,
}

/// Points along the axes on both sides of the centre of a state lie this far from it, a power of 2.
struct Scale {
    steps: Vec<f64>,
    exact: Vec<Rational>,
    /// Binary places of points and of weights.
    points: u32,
    weights: u32,
}

impl<'a> Search<'a> {
    fn new(shape: &'a Shape, share: f64) -> Self {
        let reachable = shape.reachable();
        let mut maps = Vec::new();
        for &from in &reachable {
            for (letter, p) in shape.states[from].pieces.iter().enumerate() {
                maps.push(Map { from, to: p.target, letter, op: Floats::of(&p.op) });
            }
        }
        let middle = |dim: usize| vec![1.0 / dim.max(1) as f64; dim];
        let mut floats: Vec<Vec<f64>> = shape.states.iter().map(|s| middle(s.dim)).collect();
        for _ in 0..2 * ROUNDS {
            floats = (0..floats.len()).map(|e| average(&maps, &floats, e)).collect();
        }
        let centres: Vec<Vec<Rational>> = floats.iter().map(|p| affine(p, CENTRE_BITS)).collect();
        let floats: Vec<Vec<f64>> = centres.iter().map(|c| c.iter().map(to_f64).collect()).collect();
        let mut clouds: Vec<Vec<Vec<f64>>> = floats.iter().map(|c| vec![c.clone()]).collect();
        for _ in 0..ROUNDS {
            let images = |e: usize| {
                let own = maps.iter().filter(|m| m.from == e);
                extreme(own.flat_map(|m| clouds[m.to].iter().map(|x| m.op.apply(x))).collect(), &floats[e])
            };
            clouds = (0..clouds.len()).map(images).collect();
        }
        Self { shape, reachable, maps, centres, floats, clouds, share }
    }

    fn attempt(&self, room: f64) -> Option<Polytopes> {
        let scale = self.scale(room)?;
        let mut points: Vec<Vec<Vec<f64>>> =
            (0..self.clouds.len()).map(|e| self.seeds(e, room, scale.steps[e])).collect();
        self.grow(&mut points)?;
        for &e in &self.reachable {
            prune(&mut points[e], 2 * (self.shape.states[e].dim - 1));
        }
        let exact = |e: usize| self.exact(e, &scale, &points[e]);
        let vertices: Vec<Vec<Vec<Rational>>> = (0..points.len()).map(exact).collect();
        let mut weights = vec![Vec::new(); points.len()];
        for map in &self.maps {
            let op = &self.shape.states[map.from].pieces[map.letter].op;
            let images = vertices[map.to].iter().map(|v| self.weights(map.from, &scale, &vertices, &op.apply(v)));
            weights[map.from].push(images.collect::<Option<Vec<_>>>()?);
        }
        Polytopes::checked(self.shape, vertices, weights)
    }

    /// What is lost by rounding is made up along the axes from half of the share of the centre.
    fn scale(&self, room: f64) -> Option<Scale> {
        let steps: Vec<f64> = (0..self.clouds.len()).map(|e| self.step(e, room)).collect();
        let share = to_bits(self.share);
        let smallest = self.reachable.iter().map(|e| to_bits(steps[*e])).fold(0, u32::max);
        let exact = steps.iter().map(|x| Rational::try_from(*x).ok()).collect::<Option<_>>()?;
        Some(Scale { steps, exact, points: share + smallest + 6, weights: share + 12 })
    }

    /// How far the points along the axes lie from the centre: a power of 2.
    fn step(&self, e: usize, room: f64) -> f64 {
        let spread = |x: &Vec<f64>| x.iter().zip(&self.floats[e]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let size = self.clouds[e].iter().map(spread).fold(0.0, f64::max).max(1.0 / 64.0);
        (size * room.min(1.0) / 4.0).log2().floor().exp2()
    }

    /// Points along the axes on both sides of the centre, and the enlarged hull of the attractor.
    fn seeds(&self, e: usize, room: f64, step: f64) -> Vec<Vec<f64>> {
        let centre = &self.floats[e];
        let mut seeds = Vec::new();
        for axis in 1..centre.len() {
            for sign in [step, -step] {
                let mut point = centre.clone();
                point[axis] += sign;
                point[0] -= sign;
                seeds.push(point);
            }
        }
        let enlarged = |x: &Vec<f64>| x.iter().zip(centre).map(|(a, c)| c + (a - c) * (1.0 + room)).collect();
        seeds.extend(self.clouds[e].iter().map(enlarged));
        if seeds.is_empty() { vec![centre.clone()] } else { seeds }
    }

    /// Adds images, without the share of the centre, until all lie inside; `None` where there are too many.
    fn grow(&self, points: &mut [Vec<Vec<f64>>]) -> Option<()> {
        let mut done = vec![0; points.len()];
        while let Some(&e) = self.reachable.iter().find(|e| done[**e] < points[**e].len()) {
            let point = points[e][done[e]].clone();
            done[e] += 1;
            for map in self.maps.iter().filter(|m| m.to == e) {
                let image = self.without_share(map.from, &map.op.apply(&point), self.share);
                let rays: Vec<&[f64]> = points[map.from].iter().map(Vec::as_slice).collect();
                if image.len() > 1 && cone_combination(&rays, &image).is_none() {
                    points[map.from].push(image);
                }
            }
            if points.iter().map(Vec::len).sum::<usize>() > MAX_POINTS {
                return None;
            }
        }
        Some(())
    }

    /// `y` with `x = m c + (1 − m) y`.
    fn without_share(&self, e: usize, x: &[f64], share: f64) -> Vec<f64> {
        x.iter().zip(&self.floats[e]).map(|(x, c)| (x - share * c) / (1.0 - share)).collect()
    }

    /// The points as rationals of sum 1; those along the axes exactly on both sides of the centre.
    fn exact(&self, e: usize, scale: &Scale, points: &[Vec<f64>]) -> Vec<Vec<Rational>> {
        let centre = &self.centres[e];
        let step = &scale.exact[e];
        let along = 2 * (centre.len().saturating_sub(1));
        let point = |(k, p): (usize, &Vec<f64>)| {
            if k >= along {
                return if along == 0 { centre.clone() } else { affine(p, scale.points) };
            }
            let mut point = centre.clone();
            let moved = if k % 2 == 0 { step.clone() } else { -step };
            point[1 + k / 2] += &moved;
            point[0] -= moved;
            point
        };
        points.iter().enumerate().map(point).collect()
    }

    /// Weights that combine `x` exactly, with a share of the centre in the form of the first two points.
    fn weights(&self, e: usize, scale: &Scale, vertices: &[Vec<Vec<Rational>>], x: &[Rational]) -> Option<Weights> {
        let own = &vertices[e];
        let (one, two) = (Rational::from(1), Rational::from(2));
        if own.len() == 1 {
            return Some(vec![(0, one)]);
        }
        // Half of the share makes up for what rounding did to the points.
        let share = self.share / 2.0;
        let y = self.without_share(e, &x.iter().map(to_f64).collect::<Vec<_>>(), share);
        let floats: Vec<Vec<f64>> = own.iter().map(|v| v.iter().map(to_f64).collect()).collect();
        let rays: Vec<&[f64]> = floats.iter().map(Vec::as_slice).collect();
        let mut weights = vec![Rational::from(0); own.len()];
        for (k, w) in cone_combination(&rays, &y)? {
            weights[k] = grid_of(w * (1.0 - share), scale.weights);
        }
        let sum = weights.iter().fold(Rational::from(0), |s, w| s + w);
        let mut centre = &one - sum;
        let middle: Vec<Rational> = self.centres[e].iter().map(|c| c * &centre).collect();
        let mut rest = difference(x, &middle);
        for (w, v) in weights.iter().zip(own) {
            rest.iter_mut().zip(v).for_each(|(r, a)| *r -= w * a);
        }
        // What rounding leaves is made up along the axes, at the cost of the centre.
        let step = &scale.exact[e];
        for (axis, r) in rest.iter().enumerate().skip(1) {
            let w = abs(r) / step;
            centre -= &w;
            weights[2 * (axis - 1) + usize::from(*r < 0)] += w;
        }
        let half = centre / two;
        weights[0] += &half;
        weights[1] += half;
        Some(weights.into_iter().enumerate().filter(|(_, w)| *w != 0).collect())
    }
}

/// Binary places at which a number is seen.
fn to_bits(x: f64) -> u32 {
    let mut bits = 0;
    while bits < 40 && x * f64::from(bits).exp2() <= 1.0 {
        bits += 1;
    }
    bits
}

/// The average of the images of the points under the pieces of a state.
fn average(maps: &[Map], points: &[Vec<f64>], e: usize) -> Vec<f64> {
    let own: Vec<&Map> = maps.iter().filter(|m| m.from == e).collect();
    if own.is_empty() {
        return points[e].clone();
    }
    let mut sum = vec![0.0; points[e].len()];
    for map in &own {
        sum.iter_mut().zip(map.op.apply(&points[map.to])).for_each(|(s, x)| *s += x / own.len() as f64);
    }
    sum
}

/// A rational point of sum 1 near a float one.
fn affine(p: &[f64], bits: u32) -> Vec<Rational> {
    let mut point: Vec<Rational> = p.iter().map(|x| grid_of(*x, bits)).collect();
    let sum = point.iter().fold(Rational::from(0), |s, x| s + x);
    if let Some(first) = point.first_mut() {
        *first += Rational::from(1) - sum;
    }
    point
}

/// The points that are extreme in some direction.
fn extreme(points: Vec<Vec<f64>>, centre: &[f64]) -> Vec<Vec<f64>> {
    let dim = centre.len();
    let mut kept: Vec<usize> = Vec::new();
    let mut seed = 1_u64;
    for k in 0..(2 * dim + DIRECTIONS * dim.saturating_sub(1)) {
        let direction: Vec<f64> = match k / 2 {
            axis if axis < dim => (0..dim).map(|i| f64::from(u8::from(i == axis))).collect(),
            _ => (0..dim).map(|_| random(&mut seed)).collect(),
        };
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let value = |x: &Vec<f64>| sign * dot(&direction, x);
        let best = (0..points.len()).max_by(|a, b| value(&points[*a]).total_cmp(&value(&points[*b])));
        kept.extend(best.filter(|b| !kept.contains(b)));
    }
    kept.into_iter().map(|k| points[k].clone()).collect()
}

/// A number of a fixed sequence between -1 and 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 40) as f64 / f64::from(1_u32 << 23) - 1.0
}

/// Drops points, after the first `fixed`, that the others combine.
fn prune(points: &mut Vec<Vec<f64>>, fixed: usize) {
    let mut k = points.len();
    while k > fixed.max(1) {
        k -= 1;
        let others = points.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, p)| p.as_slice());
        if cone_combination(&others.collect::<Vec<_>>(), &points[k]).is_some() {
            points.remove(k);
        }
    }
}
