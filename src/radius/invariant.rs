//! Invariant polytopes: at the radius itself, and at slightly larger numbers.
#![allow(clippy::float_arithmetic, reason = "chooses radii and seeds; every bound is recomputed exactly")]

use super::answer::Proof;
use super::budget::Budget;
use super::closing::Closing;
use super::exact::{LeadingVector, axis_point, checking, exact_points, grid, polished, rational};
use super::float::Floats;
use super::grow::{Grown, Origin, Task, Vertex, grow, missing_axes};
use super::leading::Lower;
use super::polytope::Polytope;
use super::radial::Radial;
use super::simplex::Body;
use super::strategy::{Found, Outcome, Strategy, Target};
use super::system::System;
use crate::arith::{Integer, Rational, to_f64};
use malachite_base::num::basic::traits::One;

/// A polytope at the radius itself, from the eigenvectors of the leading words.
pub(super) struct AtRadius {
    pub vertices: usize,
    pub share: u64,
}

impl<E: Radial> Strategy<E> for AtRadius {
    fn attempt(&self, target: &Target<E>, _known: f64, budget: &Budget) -> Outcome<E> {
        let Some(best) = &target.best.lower else { return Outcome::Nothing };
        let system = &target.block.system;
        let roots = eigenvectors(system, &target.own);
        if roots.is_empty() || target.own.iter().any(|l| real_power(system, l).is_none()) {
            return Outcome::Nothing;
        }
        let scaled = scaled(system, target.best.float);
        let mut axes: Vec<(usize, usize)> = Vec::new();
        let mut best_found: Option<Box<Found<E>>> = None;
        for (threshold, exponent) in [(1e-7, 8), (1e-7, 14), (1e-3, 8), (1e-3, 5)] {
            let mut seeds = root_seeds(system, &roots);
            seeds.extend(axis_seeds(system, &axes, exponent));
            let grown = grow(&Task {
                system,
                scaled: &scaled,
                body: body(system),
                seeds,
                max_vertices: self.vertices.min(target.options.vertices),
                tolerance: 1e-9,
                longest: longest(target),
                budget,
            });
            if let Some(path) = grown.better {
                return Outcome::Better(path);
            }
            if grown.cut {
                break;
            }
            let missing = missing_axes(system, &grown, threshold);
            if missing.is_empty() {
                if let Outcome::Found(found) = settle(target, &grown, &roots, best, budget) {
                    let sharp = found.attains || to_f64(&found.bound) <= target.best.float * (1.0 + SHARP);
                    if best_found.as_ref().is_none_or(|old| found.attains || found.bound < old.bound) {
                        best_found = Some(found);
                    }
                    if sharp {
                        break;
                    }
                }
                // A thin polytope, or one that did not close: once more with a wider one.
                if grown.excess > 1.0 || threshold > 1e-6 {
                    break;
                }
            }
            axes.extend(
                missing_axes(system, &grown, 1e-3).into_iter().filter(|a| threshold > 1e-6 || missing.contains(a)),
            );
            axes.sort_unstable();
            axes.dedup();
        }
        best_found.map_or(Outcome::Nothing, Outcome::Found)
    }

    fn share(&self) -> u64 {
        self.share
    }
}

/// The longest cyclic word that is looked at as a better one: products of large matrices are dear.
fn longest<E: Radial>(target: &Target<E>) -> usize {
    target.options.longest * if target.block.system.widest() <= 4 { 8 } else { 3 }
}

/// Relative excess of a bound over the radius up to which the data of a polytope are not computed again with more places.
const SHARP: f64 = 1e-9;

fn settle<E: Radial>(
    target: &Target<E>,
    grown: &Grown,
    roots: &[LeadingVector],
    best: &Lower,
    budget: &Budget,
) -> Outcome<E> {
    let system = &target.block.system;
    if !budget.spend(checking(system, grown)) {
        return Outcome::Nothing;
    }
    let value = best.rational();
    let exact = value.as_ref().and_then(|r| exact_points(system, grown, roots, r));
    let radius = value.clone().unwrap_or_else(|| best.enclosure(64).hi);
    let bounded = |polytope: Polytope<E>| polytope.bound(system).map(|bound| (bound, polytope));
    let mut found = rational(system, grown, &radius, exact.as_deref()).and_then(bounded);
    let closed = grown.excess <= 1.0;
    let attains = closed
        && found.as_ref().is_some_and(|(bound, polytope)| {
            let proved = value.as_ref().is_some_and(|r| bound <= r);
            proved || Closing { system, grown, polytope, roots, radius: best, budget }.holds()
        });
    let sharp = found.as_ref().is_some_and(|(b, _)| to_f64(b) <= target.best.float * (1.0 + SHARP));
    if closed && !sharp && grown.body == Body::Symmetric && budget.spend(20 * checking(system, grown)) {
        // In a thin polytope the rounding of floats costs much.
        let finer = polished(system, grown, roots, best).and_then(bounded);
        found = match (found, finer) {
            (Some(first), Some(finer)) if finer.0 >= first.0 => Some(first),
            (first, finer) => finer.or(first),
        };
    }
    match found {
        Some((bound, polytope)) => {
            Outcome::Found(Box::new(Found { bound, proof: Proof::Polytope(polytope), attains, roots: roots.to_vec() }))
        }
        None => Outcome::Nothing,
    }
}

/// A polytope at a slightly larger radius, `(1 + gap)` times that of the best word.
pub(super) struct Inflated {
    pub gap: f64,
    pub vertices: usize,
    pub share: u64,
}

impl<E: Radial> Strategy<E> for Inflated {
    fn attempt(&self, target: &Target<E>, known: f64, budget: &Budget) -> Outcome<E> {
        let radius = target.best.float * (1.0 + self.gap);
        if target.best.float == 0.0 || known <= radius * (1.0 + self.gap) {
            return Outcome::Nothing;
        }
        invariant(target, radius, self.vertices, budget)
    }

    fn share(&self) -> u64 {
        self.share
    }
}

/// A polytope at a radius between the growth of the block's best word and that of the best word of all.
pub(super) struct Between {
    /// Where between them.
    pub part: f64,
    pub vertices: usize,
    pub share: u64,
}

impl<E: Radial> Strategy<E> for Between {
    fn attempt(&self, target: &Target<E>, _known: f64, budget: &Budget) -> Outcome<E> {
        let value = target.value();
        let radius = value + self.part * (target.best.float - value);
        match invariant(target, radius, self.vertices, budget) {
            // Only a word above the best of all is a reason to start again.
            Outcome::Better(path) if growth(&target.block.system, &path) <= target.best.float * (1.0 + 1e-12) => {
                Outcome::Nothing
            }
            other => other,
        }
    }

    fn share(&self) -> u64 {
        self.share
    }
}

/// `ρ(T_w)^(1/|w|)` in floats.
pub(super) fn growth<E: Radial>(system: &System<E>, path: &[usize]) -> f64 {
    let mut product: Option<Floats> = None;
    let mut log = 0.0;
    for &a in path {
        let m = Floats::of(&system.arrows[a].matrix);
        let next = product.map_or_else(|| m.clone(), |p| p.times(&m));
        let norm = next.norm();
        if norm == 0.0 || !norm.is_finite() {
            return 0.0;
        }
        log += norm.ln();
        product = Some(next.scaled(1.0 / norm));
    }
    product.map_or(0.0, |p| ((log + p.radius().ln()) / path.len() as f64).exp())
}

/// A polytope for a radius that is above all products, as it seems.
fn invariant<E: Radial>(target: &Target<E>, radius: f64, vertices: usize, budget: &Budget) -> Outcome<E> {
    let system = &target.block.system;
    let mut seeds = float_seeds(system, target);
    if seeds.is_empty() {
        let all = system.dims.iter().enumerate().flat_map(|(s, d)| (0..*d).map(move |i| (s, i)));
        seeds = axis_seeds(system, &all.collect::<Vec<_>>(), 0);
    }
    let scaled = scaled(system, radius * (1.0 - 1e-10));
    for _ in 0..3 {
        let grown = grow(&Task {
            system,
            scaled: &scaled,
            body: body(system),
            seeds: seeds.clone(),
            max_vertices: vertices.min(target.options.vertices),
            tolerance: 0.0,
            longest: longest(target),
            budget,
        });
        if let Some(path) = grown.better {
            return Outcome::Better(path);
        }
        if grown.cut {
            return Outcome::Nothing;
        }
        let missing = missing_axes(system, &grown, 1e-3);
        if !missing.is_empty() {
            seeds.extend(axis_seeds(system, &missing, 8));
            continue;
        }
        if !budget.spend(checking(system, &grown)) {
            return Outcome::Nothing;
        }
        let Some(polytope) = rational(system, &grown, &grid_near(radius), None) else { return Outcome::Nothing };
        let Some(bound) = polytope.bound(system) else { return Outcome::Nothing };
        let found = Found { bound, proof: Proof::Polytope(polytope), attains: false, roots: Vec::new() };
        return Outcome::Found(Box::new(found));
    }
    Outcome::Nothing
}

/// A positive float as an exact number with about 50 leading bits.
fn grid_near(x: f64) -> Rational {
    let exponent = x.log2().ceil().clamp(-1000.0, 1000.0);
    let scale = 2f64.powf(exponent);
    let unit = Rational::from(Integer::ONE << exponent.abs() as u64);
    grid(x / scale) * if exponent >= 0.0 { unit } else { Rational::from(1) / unit }
}

/// Real eigenvectors of the leading words, scaled to about 1 and, for nonnegative matrices, made nonnegative.
fn eigenvectors<E: Radial>(system: &System<E>, own: &[Lower]) -> Vec<LeadingVector> {
    let mut out = Vec::new();
    let mut lines: Vec<(usize, Vec<f64>)> = Vec::new();
    for lower in own.iter().filter_map(|l| real_power(system, l)) {
        let Some(root) = lower.root().cloned() else { continue };
        let Some(mut vector) = E::eigenvector(&system.product(&lower.path), &root) else { continue };
        let values: Vec<f64> = vector.enclosure(64).iter().map(|x| to_f64(&x.mid())).collect();
        let largest = values.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        if largest == 0.0 || !largest.is_finite() {
            continue;
        }
        // Words that tie often have the same eigenvector; one vertex is enough.
        let state = system.arrows[lower.path[0]].from;
        let line: Vec<f64> = values.iter().map(|x| x / largest).collect();
        if lines.iter().any(|(s, l)| *s == state && l.iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-12)) {
            continue;
        }
        lines.push((state, line));
        vector.scale(&scale_near(1.0 / largest));
        out.push(LeadingVector { lower, root, vector });
    }
    out
}

/// The word, or a power of it whose leading eigenvalue is real.
pub(super) fn real_power<E: Radial>(system: &System<E>, lower: &Lower) -> Option<Lower> {
    let root = lower.root()?;
    if root.is_real() {
        return Some(lower.clone());
    }
    // The powers that may be real, by an enclosure; the exact eigenvalue decides.
    let (re, im) = root.enclosure(200);
    let mut power = (re.clone(), im.clone());
    let mut open = Vec::new();
    for k in 2..=12 {
        power = (&(&power.0 * &re) - &(&power.1 * &im), &(&power.0 * &im) + &(&power.1 * &re));
        if power.1.contains_zero() && k * lower.length <= 48 {
            open.push(k);
        }
    }
    open.into_iter()
        .filter_map(|k| Lower::of(system, &lower.path.repeat(k)))
        .find(|l| l.root().is_some_and(|r| r.is_real()))
}

/// A short rational close to a float of any size.
pub(super) fn scale_near(x: f64) -> Rational {
    let exponent = x.abs().log2().floor().clamp(-1000.0, 1000.0);
    let unit = Rational::from(Integer::ONE << exponent.abs() as u64);
    let power = if exponent >= 0.0 { unit } else { Rational::from(1) / unit };
    let rest = grid(((x / 2f64.powf(exponent)) * 16.0).round() / 16.0);
    if rest == 0 { power } else { rest * power }
}

pub(super) fn body<E: Radial>(system: &System<E>) -> Body {
    if system.is_nonnegative() { Body::Monotone } else { Body::Symmetric }
}

pub(super) fn scaled<E: Radial>(system: &System<E>, radius: f64) -> Vec<Floats> {
    Floats::all(system).into_iter().map(|f| f.scaled(1.0 / radius)).collect()
}

fn root_seeds<E: Radial>(system: &System<E>, roots: &[LeadingVector]) -> Vec<Vertex> {
    let seed = |(k, r): (usize, &LeadingVector)| Vertex {
        state: system.arrows[r.lower.path[0]].from,
        origin: Origin::Root(k),
        point: r.vector.enclosure(96).iter().map(|x| to_f64(&x.mid())).collect(),
    };
    roots.iter().enumerate().map(seed).collect()
}

/// About the eigenvectors of the words that grow fastest, on the grid.
fn float_seeds<E: Radial>(system: &System<E>, target: &Target<E>) -> Vec<Vertex> {
    let mut seeds: Vec<Vertex> = Vec::new();
    for candidate in target.near.iter().filter(|c| c.value >= target.value() * (1.0 - 1e-9)).take(4) {
        let Some(product) = Floats::product(system, &candidate.path) else { continue };
        let Some((re, im)) = product.eigenvalue() else { continue };
        if im != 0.0 {
            continue;
        }
        let Some(mut vector) = product.eigenvector(re) else { continue };
        if body(system) == Body::Monotone {
            if vector.iter().any(|x| *x < -1e-9) {
                continue;
            }
            vector.iter_mut().for_each(|x| *x = x.max(0.0));
        }
        let state = system.arrows[candidate.path[0]].from;
        let exact: Vec<Rational> = vector.iter().map(|x| grid(*x)).collect();
        let point: Vec<f64> = exact.iter().map(to_f64).collect();
        let near = |v: &Vertex| v.state == state && v.point.iter().zip(&point).all(|(a, b)| (a - b).abs() < 1e-12);
        if !seeds.iter().any(near) {
            seeds.push(Vertex { state, origin: Origin::Free(exact), point });
        }
    }
    seeds
}

fn axis_seeds<E: Radial>(system: &System<E>, axes: &[(usize, usize)], exponent: u32) -> Vec<Vertex> {
    let seed = |&(state, axis): &(usize, usize)| Vertex {
        state,
        origin: Origin::Axis { axis, exponent },
        point: axis_point(system.dims[state], axis, exponent).iter().map(to_f64).collect(),
    };
    axes.iter().map(seed).collect()
}
