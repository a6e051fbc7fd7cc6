//! The joint spectral radius: candidates, polytopes, and what was proved.
#![allow(clippy::float_arithmetic, reason = "chooses candidates and scales; every bound is recomputed exactly")]

use super::balanced::{self, Balanced};
use super::blocks::{Block, Step, flag};
use super::exact::{LeadingVector, closes, exact_points, grid, polished, rational};
use super::float::Floats;
use super::grow::{Grown, Origin, Task, Vertex, grow, missing_axes};
use super::leading::{Eigenvector, Lower};
use super::polytope::Polytope;
use super::quadratic::Quadratic;
use super::search::{Candidate, candidates, canonical};
use super::simplex::Body;
use super::system::{System, SystemError};
use super::tree::{self, Tree};
use crate::arith::{Interval, Rational, to_f64};
use malachite_base::num::arithmetic::traits::CheckedRoot;
use std::cmp::Ordering;

/// How hard to try.
#[derive(Debug, Clone)]
pub struct Options {
    /// Longest word searched.
    pub longest: usize,
    /// Most vertices of a polytope.
    pub vertices: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { longest: 16, vertices: 4000 }
    }
}

/// What bounds a block from above.
#[derive(Debug, Clone)]
pub enum Proof {
    /// An invariant polytope.
    Polytope(Polytope),
    /// Quadratic norms.
    Quadratic(Quadratic),
    /// An invariant complex balanced polytope.
    Balanced(Balanced),
    /// Norms of the words of a tree.
    Tree(Tree),
}

/// A diagonal block and what was proved of it.
#[derive(Debug, Clone)]
pub struct BlockProof {
    /// The block.
    pub block: Block,
    /// Leading words of the block, their paths in the block, with eigenvectors where real.
    pub roots: Vec<LeadingVector>,
    /// The upper bound proved by `proof` in rational arithmetic; `None` where nothing was proved.
    pub bound: Option<Rational>,
    /// Whether the block's radius was shown to be equal to the lower bound of the whole.
    pub attains: bool,
    /// The proof.
    pub proof: Option<Proof>,
}

/// How the largest products of `k` letters grow, relative to `radius^k`, `radius` being the joint spectral radius itself,
/// whether it is known exactly or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Growth {
    /// They stay bounded: one block only can attain the radius, and it has an extremal norm (an invariant body at the radius
    /// itself, or no invariant subspace).
    Bounded,
    /// They are unbounded: a word that is *proved* to attain the radius has a Jordan block of this size at its largest modulus.
    Unbounded(usize),
    /// Not decided.
    Unknown,
}

/// The answer: `lower <= radius <= upper`.
#[derive(Debug, Clone)]
pub struct JointRadius {
    /// The best word; `None` where all long products vanish (radius 0).
    pub lower: Option<Lower>,
    /// A rational upper bound; `None` where nothing was proved.
    pub upper: Option<Rational>,
    /// Whether the radius was shown to be exactly the value of the word (or 0 without one).
    pub exact: bool,
    /// How products grow.
    pub growth: Growth,
    /// The diagonal blocks.
    pub blocks: Vec<BlockProof>,
    /// The flag of invariant families to which the blocks belong, in its order.
    pub flag: Vec<Step>,
}

/// Computes the joint spectral radius of a set or an automaton of rational matrices.
///
/// # Errors
/// [`SystemError`] where the matrices do not fit.
///
/// # Cost
/// Bounded by the options; small sets take milliseconds.
pub fn joint_radius(system: &System, options: &Options) -> Result<JointRadius, SystemError> {
    let system = system.clone().checked()?;
    let steps = flag(&system);
    let parts: Vec<Block> = steps.iter().filter_map(|s| s.block.clone()).collect();
    let mut found: Vec<Vec<Candidate>> = parts.iter().map(|b| candidates(&b.system, options.longest, 1e-7)).collect();
    for _ in 0..8 {
        match attempt(&system, &parts, &found, options) {
            Ok(result) => return Ok(JointRadius { flag: steps, ..result }),
            Err((block, path)) => {
                let word = canonical(&path);
                let value = Floats::of(&parts[block].system.product(&word)).radius().powf(1.0 / word.len() as f64);
                found[block].retain(|c| c.value > value * (1.0 - 1e-7));
                found[block].push(Candidate { path: word, value });
            }
        }
    }
    Ok(JointRadius { flag: steps, ..without_restart(&system, &parts, &found) })
}

type Restart = (usize, Vec<usize>);

/// An answer from the words found so far and norms only, which never asks for a new start.
fn without_restart(system: &System, parts: &[Block], found: &[Vec<Candidate>]) -> JointRadius {
    let Some(best) = best_word(parts, found) else { return vanishing(parts.is_empty()) };
    let by_norms = |block: &Block| {
        let mut proof =
            BlockProof { block: block.clone(), roots: Vec::new(), bound: None, attains: false, proof: None };
        by_tree(&mut proof, best.0.float);
        proof
    };
    conclude(system, &best, parts.iter().map(by_norms).collect())
}

/// The answer where no word has a positive value.
fn vanishing(exact: bool) -> JointRadius {
    JointRadius {
        lower: None,
        upper: exact.then(|| Rational::from(0)),
        exact,
        growth: Growth::Unknown,
        blocks: Vec::new(),
        flag: Vec::new(),
    }
}

fn attempt(
    system: &System,
    parts: &[Block],
    found: &[Vec<Candidate>],
    options: &Options,
) -> Result<JointRadius, Restart> {
    let Some(best) = best_word(parts, found) else { return Ok(vanishing(parts.is_empty())) };
    let mut proofs = Vec::new();
    for (k, block) in parts.iter().enumerate() {
        proofs.push(prove(block, &found[k], &best, options).map_err(|path| (k, path))?);
    }
    Ok(conclude(system, &best, proofs))
}

/// The best candidate of all blocks and the number of its block.
struct Best {
    block: usize,
    lower: Lower,
    float: f64,
    /// A rational not above the value, and close.
    floor: Rational,
}

fn best_word(parts: &[Block], found: &[Vec<Candidate>]) -> Option<(Best, Vec<Vec<Lower>>)> {
    let float = found.iter().flatten().map(|c| c.value).fold(0.0, f64::max);
    let mut lists: Vec<Vec<Lower>> = Vec::new();
    for (part, list) in parts.iter().zip(found) {
        let near = list.iter().filter(|c| c.value >= float * (1.0 - 1e-9)).take(12);
        lists.push(near.filter_map(|c| Lower::of(&part.system, &c.path)).collect());
    }
    let mut best: Option<(usize, Lower)> = None;
    for (block, list) in lists.iter().enumerate() {
        for lower in list {
            let better =
                best.as_ref().is_none_or(|(old, b)| compare(parts, (block, lower), (*old, b)) == Ordering::Greater);
            if better {
                best = Some((block, lower.clone()));
            }
        }
    }
    let (block, lower) = best?;
    for (k, list) in lists.iter_mut().enumerate() {
        list.retain(|l| compare(parts, (k, l), (block, &lower)) == Ordering::Equal);
    }
    let floor = lower.enclosure(64).lo;
    Some((Best { block, float: to_f64(&floor), lower, floor }, lists))
}

fn compare(parts: &[Block], (i, a): (usize, &Lower), (j, b): (usize, &Lower)) -> Ordering {
    a.compare(&parts[i].system, b, &parts[j].system)
}

fn conclude(system: &System, best: &(Best, Vec<Vec<Lower>>), proofs: Vec<BlockProof>) -> JointRadius {
    let (best, _) = best;
    let path = proofs[best.block].block.system.labels(&best.lower.path);
    let lower = Lower::of(system, &path).unwrap_or_else(|| best.lower.clone());
    let below = |p: &BlockProof| p.attains || p.bound.as_ref().is_some_and(|b| *b <= best.floor);
    let exact = proofs.iter().all(below);
    let upper = match (exact, lower.rational()) {
        (true, Some(r)) => Some(r),
        (true, None) => Some(lower.enclosure(64).hi),
        _ => proofs.iter().map(|p| p.bound.clone()).collect::<Option<Vec<_>>>().and_then(|b| b.into_iter().max()),
    };
    // A bound below the lower one belongs to blocks that do not matter.
    let upper = upper.map(|u| u.max(lower.enclosure(64).hi));
    let growth = growth(&lower, &best.floor, exact, &proofs);
    JointRadius { lower: Some(lower), upper, exact, growth, blocks: proofs, flag: Vec::new() }
}

/// Decides [`Growth`]: `floor` is at most the radius.
///
/// A word that attains the radius shows by its Jordan block that products are unbounded. They are bounded where all blocks but
/// one have a radius below `floor`, and that one has an extremal norm: a norm (or invariant body) that proves its bound at the
/// radius itself, or irreducibility (theory §11).
fn growth(lower: &Lower, floor: &Rational, exact: bool, proofs: &[BlockProof]) -> Growth {
    if exact && lower.block > 1 {
        return Growth::Unbounded(lower.block);
    }
    let mut top = proofs.iter().filter(|p| p.bound.as_ref().is_none_or(|b| b >= floor));
    match (top.next(), top.next()) {
        (Some(only), None) if exact || only.block.irreducible => Growth::Bounded,
        _ => Growth::Unknown,
    }
}

fn prove(
    block: &Block,
    found: &[Candidate],
    best: &(Best, Vec<Vec<Lower>>),
    options: &Options,
) -> Result<BlockProof, Vec<usize>> {
    let (best, lists) = best;
    let own: Vec<&Lower> = lists
        .iter()
        .flatten()
        .filter(|l| found.iter().any(|c| c.path == l.path) && l.word == block.system.labels(&l.path))
        .collect();
    if own.is_empty() {
        let value = found.iter().map(|c| c.value).fold(0.0, f64::max);
        return smaller(block, value, best, options);
    }
    let roots = eigenvectors(block, &own);
    let square = best.lower.square();
    let mut result = BlockProof { block: block.clone(), roots, bound: None, attains: false, proof: None };
    if own.iter().any(|l| !l.root.is_real()) && by_quadratic(&mut result, square.as_ref(), &own) {
        return Ok(result);
    }
    let turning = own.iter().any(|l| real_power(&block.system, l).is_none());
    if turning && by_balanced(&mut result, best, &own, options) {
        return Ok(result);
    }
    if !result.roots.is_empty() && !turning {
        at_radius(&mut result, best, options)?;
        if result.attains || by_quadratic(&mut result, square.as_ref(), &own) {
            return Ok(result);
        }
    }
    for gap in [4e-7, 1e-5, 1e-3, 0.03, 0.3, 3.0] {
        let before = result.bound.as_ref().map_or(f64::INFINITY, to_f64);
        if before <= best.float * (1.0 + 2.0 * gap) {
            break;
        }
        if inflated(&mut result, best.float * (1.0 + gap), options)? {
            break;
        }
    }
    by_tree(&mut result, best.float);
    Ok(result)
}

/// A bound by norms of words, where there is no other or no good one.
fn by_tree(result: &mut BlockProof, float: f64) {
    if result.bound.as_ref().is_some_and(|b| to_f64(b) <= float * 1.001) {
        return;
    }
    let tree = tree::find(&result.block.system, float * 1.0001, TREE_WORDS);
    let bound = tree.bound(&result.block.system);
    if bound.is_some() && result.bound.as_ref().is_none_or(|old| bound.as_ref() < Some(old)) {
        result.bound = bound;
        result.proof = Some(Proof::Tree(tree));
    }
}

/// Most words of a tree.
const TREE_WORDS: usize = 1500;
/// Most vertices of a balanced polytope.
const BALANCED_VERTICES: usize = 400;

/// Tries a complex balanced polytope at the radius itself; true if it proved that the word attains it.
fn by_balanced(result: &mut BlockProof, best: &Best, own: &[&Lower], options: &Options) -> bool {
    let system = result.block.system.clone();
    let mut roots = Vec::new();
    for lower in own {
        let Some(mut vector) = Eigenvector::of(&system.product(&lower.path), &lower.root) else { return false };
        let size = |z: &(Interval, Interval)| to_f64(&z.0.mid()).hypot(to_f64(&z.1.mid()));
        let largest = balanced::complex_enclosure(&vector, &lower.root, 64).iter().map(size).fold(0.0, f64::max);
        if largest == 0.0 || !largest.is_finite() {
            return false;
        }
        vector.scale(&scale_near(1.0 / largest));
        roots.push(LeadingVector { lower: (*lower).clone(), vector });
    }
    let scaled = scaled(&system, best.float);
    let most = options.vertices.min(BALANCED_VERTICES);
    let task = balanced::Task { system: &system, scaled: &scaled, roots: &roots, radius: &best.lower, most };
    let Some(found) = balanced::find(&task) else { return false };
    if result.bound.as_ref().is_none_or(|old| found.bound < *old) {
        result.bound = Some(found.bound);
        result.proof = Some(Proof::Balanced(found.polytope));
        result.attains = found.attains;
        result.roots = roots;
    }
    result.attains
}

/// Real eigenvectors of the leading words, scaled to about 1 and, for nonnegative matrices, made nonnegative.
fn eigenvectors(block: &Block, own: &[&Lower]) -> Vec<LeadingVector> {
    let mut out = Vec::new();
    let mut lines: Vec<(usize, Vec<f64>)> = Vec::new();
    for lower in own.iter().filter_map(|l| real_power(&block.system, l)) {
        let Some(mut vector) = Eigenvector::of(&block.system.product(&lower.path), &lower.root) else { continue };
        let values: Vec<f64> = vector.enclosure(&lower.root, 64).iter().map(|x| to_f64(&x.mid())).collect();
        let largest = values.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        if largest == 0.0 || !largest.is_finite() {
            continue;
        }
        // Words that tie often have the same eigenvector; one vertex is enough.
        let state = block.system.arrows[lower.path[0]].from;
        let line: Vec<f64> = values.iter().map(|x| x / largest).collect();
        if lines.iter().any(|(s, l)| *s == state && l.iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-12)) {
            continue;
        }
        lines.push((state, line));
        vector.scale(&scale_near(1.0 / largest));
        out.push(LeadingVector { lower, vector });
    }
    out
}

/// The word, or a power of it whose leading eigenvalue is real.
fn real_power(system: &System, lower: &Lower) -> Option<Lower> {
    if lower.root.is_real() {
        return Some(lower.clone());
    }
    if !lower.root.ratio_is_root_of_unity(&lower.root.conjugate()) {
        return None;
    }
    [2, 3, 4, 5, 6, 8, 10, 12]
        .into_iter()
        .filter(|k| k * lower.length <= 48)
        .filter_map(|k| Lower::of(system, &lower.path.repeat(k)))
        .find(|l| l.root.is_real())
}

/// A short rational close to a float of any size.
fn scale_near(x: f64) -> Rational {
    let exponent = x.abs().log2().floor() as i64;
    let power = if exponent >= 0 {
        Rational::from(1u64 << exponent.min(62))
    } else {
        Rational::from(1) / Rational::from(1u64 << (-exponent).min(62))
    };
    let rest = grid(((x / to_f64(&power)) * 16.0).round() / 16.0);
    if rest == 0 { power } else { rest * power }
}

fn by_quadratic(result: &mut BlockProof, square: Option<&Rational>, own: &[&Lower]) -> bool {
    let Some(square) = square else { return false };
    let letters: Vec<usize> = own.iter().filter(|l| l.length == 1).map(|l| l.path[0]).collect();
    let Some(proof) = Quadratic::find(&result.block.system, square, &letters) else { return false };
    let hi = super::leading::root_of(&Interval::point(square.clone()), 2, 64).hi;
    result.bound = Some(square.clone().checked_root(2u64).unwrap_or(hi));
    result.attains = true;
    result.proof = Some(Proof::Quadratic(proof));
    true
}

/// Relative excess of a bound over the radius up to which the data of a polytope are not computed again with more places.
const SHARP: f64 = 1e-9;

/// Tries to close the polytope at the radius itself.
fn at_radius(result: &mut BlockProof, best: &Best, options: &Options) -> Result<(), Vec<usize>> {
    let system = result.block.system.clone();
    let scaled = scaled(&system, best.float);
    let mut seeds = root_seeds(&system, &result.roots);
    let body = body(&system);
    for exponent in [0, 8, 14] {
        let limit = limit(&system, options).min(1500);
        let grown = grow(&Task {
            system: &system,
            scaled: &scaled,
            body,
            seeds: seeds.clone(),
            max_vertices: limit,
            tolerance: 1e-9,
        });
        if let Some(path) = grown.better {
            return Err(path);
        }
        let missing = missing_axes(&system, &grown);
        if missing.is_empty() {
            settle(result, &grown, best);
            return Ok(());
        }
        seeds = root_seeds(&system, &result.roots);
        seeds.extend(axis_seeds(&system, &missing, exponent + 8));
    }
    Ok(())
}

fn settle(result: &mut BlockProof, grown: &Grown, best: &Best) {
    let system = &result.block.system;
    let value = best.lower.rational();
    let exact = value.as_ref().and_then(|r| exact_points(system, grown, &result.roots, r));
    let radius = value.clone().unwrap_or_else(|| best.lower.enclosure(64).hi);
    let mut polytope = rational(system, grown, &radius, exact.as_deref());
    result.bound = polytope.bound(system);
    let closed = grown.excess <= 1.0;
    result.attains = closed
        && match &value {
            Some(r) => result.bound.as_ref() == Some(r),
            None => result.bound.is_some() && closes(system, grown, &polytope, &result.roots, &best.lower),
        };
    let sharp = result.bound.as_ref().is_some_and(|b| to_f64(b) <= best.float * (1.0 + SHARP));
    if closed && !sharp && grown.body == Body::Symmetric {
        // In a thin polytope the rounding of floats costs much.
        let finer = polished(system, grown, &result.roots, &best.lower);
        let bound = finer.bound(system);
        if bound.is_some() && (result.bound.is_none() || bound < result.bound) {
            (result.bound, polytope) = (bound, finer);
        }
    }
    result.proof = Some(Proof::Polytope(polytope));
}

/// Closes a polytope at a slightly larger radius; true if it closed.
fn inflated(result: &mut BlockProof, radius: f64, options: &Options) -> Result<bool, Vec<usize>> {
    let system = result.block.system.clone();
    let mut seeds = root_seeds(&system, &result.roots);
    if seeds.is_empty() {
        let all: Vec<(usize, usize)> =
            system.dims.iter().enumerate().flat_map(|(s, d)| (0..*d).map(move |i| (s, i))).collect();
        seeds = axis_seeds(&system, &all, 0);
    }
    let scaled = scaled(&system, radius * (1.0 - 1e-10));
    let limit = limit(&system, options);
    let body = body(&system);
    for _ in 0..2 {
        let grown = grow(&Task {
            system: &system,
            scaled: &scaled,
            body,
            seeds: seeds.clone(),
            max_vertices: limit,
            tolerance: 0.0,
        });
        if grown.better.is_some() {
            // A product above the radius: a better word.
            return grown.better.map_or(Ok(false), Err);
        }
        let missing = missing_axes(&system, &grown);
        if missing.is_empty() {
            let polytope = rational(&system, &grown, &grid(radius), None);
            let bound = polytope.bound(&system);
            if bound.is_some() && result.bound.as_ref().is_none_or(|old| bound.as_ref() < Some(old)) {
                result.bound = bound;
                result.proof = Some(Proof::Polytope(polytope));
            }
            return Ok(grown.excess <= 1.0);
        }
        seeds.extend(axis_seeds(&system, &missing, 8));
    }
    Ok(false)
}

/// Bounds a block whose best word is below the best of all.
fn smaller(block: &Block, value: f64, best: &Best, options: &Options) -> Result<BlockProof, Vec<usize>> {
    let mut result = BlockProof { block: block.clone(), roots: Vec::new(), bound: None, attains: false, proof: None };
    for share in [0.9, 0.99, 0.999_99] {
        inflated(&mut result, value + share * (best.float - value), options).or_else(|path| {
            // Only a word above the best of all is a reason to start again.
            let product = Floats::of(&block.system.product(&path)).radius().powf(1.0 / path.len() as f64);
            if product > best.float * (1.0 + 1e-12) { Err(path) } else { Ok(false) }
        })?;
        if result.bound.as_ref().is_some_and(|b| *b <= best.floor) {
            break;
        }
    }
    if result.bound.is_none() {
        by_tree(&mut result, best.float);
    }
    Ok(result)
}

fn body(system: &System) -> Body {
    if system.is_nonnegative() { Body::Monotone } else { Body::Symmetric }
}

fn limit(system: &System, options: &Options) -> usize {
    let dim = system.dims.iter().copied().max().unwrap_or(1).max(1);
    options.vertices.min(1500).min(12_000 / dim)
}

fn scaled(system: &System, radius: f64) -> Vec<Floats> {
    Floats::all(system).into_iter().map(|f| f.scaled(1.0 / radius)).collect()
}

fn root_seeds(system: &System, roots: &[LeadingVector]) -> Vec<Vertex> {
    roots
        .iter()
        .enumerate()
        .map(|(k, r)| Vertex {
            state: system.arrows[r.lower.path[0]].from,
            origin: Origin::Root(k),
            point: r.vector.enclosure(&r.lower.root, 96).iter().map(|x| to_f64(&x.mid())).collect(),
        })
        .collect()
}

fn axis_seeds(system: &System, axes: &[(usize, usize)], exponent: u32) -> Vec<Vertex> {
    let seed = |&(state, axis): &(usize, usize)| Vertex {
        state,
        origin: Origin::Axis { axis, exponent },
        point: super::exact::axis_point(system.dims[state], axis, exponent).iter().map(to_f64).collect(),
    };
    axes.iter().map(seed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;

    /// The fallback never starts again, and its bounds hold whatever words were found before.
    #[test]
    fn norms_only_give_true_bounds() {
        let matrix = |rows: [[i64; 2]; 2]| {
            Matrix::from_rows(2, rows.iter().map(|r| r.iter().map(|x| ratio(*x, 1)).collect()).collect())
        };
        // The golden pair, once with all its words and once with a word that is not the best; and a pair of radius 1.
        let golden = [matrix([[1, 1], [0, 1]]), matrix([[1, 0], [1, 1]])];
        let nilpotent = [matrix([[0, 1], [0, 0]]), matrix([[0, 0], [1, 0]])];
        for (matrices, path, radius) in [
            (&golden, vec![0, 1], 1.618_033_988_749),
            (&golden, vec![0], 1.618_033_988_749),
            (&nilpotent, vec![0, 1], 1.0),
        ] {
            let system = System::plain(matrices).unwrap();
            let parts: Vec<Block> = flag(&system).into_iter().filter_map(|s| s.block).collect();
            let value = Floats::of(&system.product(&path)).radius().powf(1.0 / path.len() as f64);
            let found = vec![vec![Candidate { path: path.clone(), value }]];
            let answer = without_restart(&system, &parts, &found);
            let lower = answer.lower.unwrap();
            assert_eq!(lower.path, path);
            assert!(to_f64(&lower.enclosure(64).lo) <= radius + 1e-9);
            let upper = to_f64(&answer.upper.unwrap());
            assert!((radius - 1e-9..1.6 * radius).contains(&upper), "{path:?}: {upper}");
            // A claim of equality only where it is true.
            assert!(!answer.exact || (value - radius).abs() < 1e-9);
        }
        assert!(without_restart(&System::plain(&golden).unwrap(), &[], &[]).lower.is_none());
    }
}
