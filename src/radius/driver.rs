//! The joint spectral radius: words from below, strategies from above, and what follows for the whole.
#![allow(clippy::float_arithmetic, reason = "compares candidates; every bound is computed exactly")]

use super::answer::{BlockProof, Ended, Growth, JointRadius};
use super::blocks::{Block, flag, undivided};
use super::budget::{Budget, Options};
use super::invariant::growth as growth_of;
use super::leading::{Lower, longest_block};
use super::radial::Radial;
use super::search::{Candidate, candidates, canonical, insertions};
use super::strategy::{Best, Found, Outcome, QUICK, Target, glance, leading, smaller};
use super::system::{System, SystemError};
use crate::arith::{Rational, to_f64};
use std::cmp::Ordering;

/// Computes the joint spectral radius of a set or an automaton of matrices with rational entries, or with entries in a real
/// number field.
///
/// # Errors
/// [`SystemError`] where the matrices do not fit.
///
/// # Cost
/// Bounded by the options; small sets take milliseconds.
pub fn joint_radius<E: Radial>(system: &System<E>, options: &Options) -> Result<JointRadius<E>, SystemError> {
    let system = system.clone().checked()?;
    let dim = system.widest();
    let budget = Budget::new(options, dim);
    let work = options.work_for(dim);
    let flag = if system.widest() > options.split { undivided(&system) } else { flag(&system) };
    let blocks: Vec<Block<E>> = flag.iter().filter_map(|s| s.block.clone()).collect();
    let share = work / 10 / blocks.len().max(1) as u64;
    let short = options.longest.min(SHORT);
    let near = blocks.iter().map(|b| candidates(&b.system, short, NEAR, &budget.part(share / 4))).collect();
    let mut search = Search {
        system: &system,
        options,
        budget: &budget,
        work,
        near,
        stage: Stage::Glance,
        found: blocks.iter().map(|_| None).collect(),
        dear: Vec::new(),
        blocks,
    };
    let (best, block) = search.best_of(GLANCES);
    if search.closed(&best) {
        return Ok(JointRadius { flag, ..search.conclude(&best, block) });
    }
    search.stage = Stage::Whole;
    search.dear.clear();
    for k in 0..search.blocks.len() {
        search.near[k] = words(&search.blocks[k].system, options, &budget.part(share));
    }
    search.found.iter_mut().flatten().for_each(|f| f.attains = false);
    let (best, block) = search.best_of(RESTARTS);
    Ok(JointRadius { flag, ..search.conclude(&best, block) })
}

/// The cyclic words of a block that grow fastest.
fn words<E: Radial>(system: &System<E>, options: &Options, budget: &Budget) -> Vec<Candidate> {
    let mut found = candidates(system, options.longest, NEAR, budget);
    insertions(system, &mut found, INSERTED * options.longest, NEAR, budget);
    found
}

/// How near to the best, relatively, words are kept.
const NEAR: f64 = 1e-7;
/// How many times longer than searched words may become by powers and insertions.
const INSERTED: usize = 40;
/// Letters of the words that a first glance looks at.
const SHORT: usize = 4;
/// Most times that a better word starts a first glance again.
const GLANCES: usize = 3;
/// Most times that a better word starts the strategies again.
const RESTARTS: usize = 24;
/// Words that are compared exactly.
const TIES: usize = 12;

/// What is tried: most sets are closed by short words and cheap norms.
#[derive(Clone, Copy)]
enum Stage {
    Glance,
    Whole,
}

struct Search<'a, E> {
    stage: Stage,
    system: &'a System<E>,
    options: &'a Options,
    budget: &'a Budget<'a>,
    /// The whole budget.
    work: u64,
    blocks: Vec<Block<E>>,
    /// By block: the words that grow fastest, in floats, best first.
    near: Vec<Vec<Candidate>>,
    /// By block: the best bound. Bounds stay true when a better word is found.
    found: Vec<Option<Found<E>>>,
    /// Strategies that were dear and did not lead to a better word: by block, of which list, and where in it. They are not tried
    /// again after a new start.
    dear: Vec<(usize, bool, usize)>,
}

impl<E: Radial> Search<'_, E> {
    /// Bounds all blocks, with the best word there is after at most so many better ones.
    fn best_of(&mut self, restarts: usize) -> (Best, Option<usize>) {
        for round in 0..=restarts {
            let (best, block, ties) = self.best();
            match self.bound_all(&best, &ties, round < restarts) {
                None => return (best, block),
                Some((block, path)) => {
                    let word = canonical(&path);
                    let value = growth_of(&self.blocks[block].system, &word);
                    self.near[block].retain(|c| c.value > value * (1.0 - NEAR) && c.path != word);
                    self.near[block].push(Candidate { path: word, value });
                    self.near[block]
                        .sort_by(|a, b| b.value.total_cmp(&a.value).then_with(|| a.path.len().cmp(&b.path.len())));
                    self.found.iter_mut().flatten().for_each(|f| f.attains = false);
                }
            }
        }
        let (best, block, _) = self.best();
        (best, block)
    }

    /// Whether every block is known to be at most the best word.
    fn closed(&self, best: &Best) -> bool {
        best.lower.is_some()
            && self.found.iter().all(|f| f.as_ref().is_some_and(|f| f.attains || f.bound <= best.floor))
    }

    /// The best word, its block, and by block the words that equal it.
    fn best(&self) -> (Best, Option<usize>, Vec<Vec<Lower>>) {
        let float = self.near.iter().flatten().map(|c| c.value).fold(0.0, f64::max);
        let mut lists: Vec<Vec<Lower>> = Vec::new();
        for (part, list) in self.blocks.iter().zip(&self.near) {
            let near = list.iter().filter(|c| c.value >= float * (1.0 - 1e-9)).take(TIES);
            lists.push(near.filter_map(|c| Lower::of(&part.system, &c.path)).collect());
        }
        let compare = |(i, a): (usize, &Lower), (j, b): (usize, &Lower)| {
            a.compare(&self.blocks[i].system, b, &self.blocks[j].system)
        };
        let mut best: Option<(usize, Lower)> = None;
        for (block, lower) in lists.iter().enumerate().flat_map(|(k, l)| l.iter().map(move |x| (k, x))) {
            if best.as_ref().is_none_or(|(old, b)| compare((block, lower), (*old, b)) == Some(Ordering::Greater)) {
                best = Some((block, lower.clone()));
            }
        }
        let Some((block, lower)) = best else {
            let nothing = Best { lower: None, float: 0.0, floor: Rational::from(0) };
            return (nothing, None, self.blocks.iter().map(|_| Vec::new()).collect());
        };
        for (k, list) in lists.iter_mut().enumerate() {
            list.retain(|l| l.root().is_some() && compare((k, l), (block, &lower)) == Some(Ordering::Equal));
        }
        let floor = lower.enclosure(64).lo;
        (Best { float: to_f64(&floor), lower: Some(lower), floor }, Some(block), lists)
    }

    /// Bounds all blocks, or answers with a block and a better word of it.
    fn bound_all(&mut self, best: &Best, ties: &[Vec<Lower>], restart: bool) -> Option<(usize, Vec<usize>)> {
        for (block, own) in ties.iter().enumerate() {
            let top =
                self.near[block].iter().any(|c| c.value >= best.float * (1.0 - 1e-9)) || self.near[block].is_empty();
            let target = Target {
                block: self.blocks[block].clone(),
                best,
                own: own.clone(),
                near: self.near[block].clone(),
                options: self.options,
            };
            let strategies = match (self.stage, top) {
                (Stage::Glance, _) => glance(top),
                (Stage::Whole, true) => leading(),
                (Stage::Whole, false) => smaller(),
            };
            for (k, strategy) in strategies.into_iter().enumerate() {
                if self.dear.contains(&(block, top, k)) {
                    continue;
                }
                let known = self.found[block].as_ref();
                let quick = strategy.share() <= QUICK;
                let done = known.is_some_and(|f| enough(f, best, self.options, top, quick));
                if done || (k > 0 && self.budget.left() == 0) {
                    break;
                }
                let known = known.map_or(f64::INFINITY, |f| to_f64(&f.bound));
                let part = self.budget.part(self.work / 1000 * strategy.share());
                let before = self.budget.left();
                let outcome = strategy.attempt(&target, known, &part);
                if before - self.budget.left() > self.work / 40 && !matches!(outcome, Outcome::Better(_)) {
                    self.dear.push((block, top, k));
                }
                match outcome {
                    Outcome::Better(path) if restart => return Some((block, path)),
                    Outcome::Better(_) | Outcome::Nothing => {}
                    Outcome::Found(found) => {
                        let old = &mut self.found[block];
                        if old.as_ref().is_none_or(|o| found.attains || (found.bound < o.bound && !o.attains)) {
                            *old = Some(*found);
                        }
                    }
                }
            }
        }
        None
    }

    fn conclude(&mut self, best: &Best, block: Option<usize>) -> JointRadius<E> {
        let proofs: Vec<BlockProof<E>> = self
            .blocks
            .iter()
            .zip(std::mem::take(&mut self.found))
            .map(|(block, found)| match found {
                Some(Found { bound, proof, attains, roots }) => {
                    BlockProof { block: block.clone(), roots, bound: Some(bound), attains, proof: Some(proof) }
                }
                None => {
                    BlockProof { block: block.clone(), roots: Vec::new(), bound: None, attains: false, proof: None }
                }
            })
            .collect();
        let below = |p: &BlockProof<E>| p.attains || p.bound.as_ref().is_some_and(|b| *b <= best.floor);
        let exact = proofs.iter().all(below);
        let lower = best.lower.clone().zip(block).map(|(lower, k)| self.of_the_whole(lower, &self.blocks[k]));
        let bounds = proofs.iter().map(|p| p.bound.clone()).collect::<Option<Vec<_>>>();
        let highest = bounds.map(|b| b.into_iter().fold(Rational::from(0), Rational::max));
        let upper = match (&lower, exact) {
            (Some(lower), true) => Some(lower.rational().unwrap_or_else(|| lower.enclosure(64).hi)),
            // A bound below the lower one belongs to blocks that do not matter.
            (Some(lower), false) => highest.map(|u| u.max(lower.enclosure(64).hi)),
            (None, _) => highest,
        };
        let growth = lower.as_ref().map_or(Growth::Unknown, |l| growth(self.system, l, &best.floor, exact, &proofs));
        let ended = match (exact, self.budget.late(), self.budget.left() == 0) {
            (true, ..) => Ended::Done,
            (_, true, _) => Ended::Clock,
            (_, _, true) => Ended::Work,
            _ if upper.as_ref().is_some_and(|u| to_f64(u) <= best.float * (1.0 + self.options.width)) => Ended::Done,
            _ => Ended::Exhausted,
        };
        JointRadius { lower, upper, exact, growth, blocks: proofs, flag: Vec::new(), ended }
    }

    /// The word of a block as a word of the whole system, with the largest eigenvalue there.
    fn of_the_whole(&self, lower: Lower, block: &Block<E>) -> Lower {
        let path = block.system.labels(&lower.path);
        let own = if self.blocks.len() > 1 { Lower::of(self.system, &path) } else { None };
        own.unwrap_or_else(|| Lower { word: self.system.labels(&path), path, ..lower })
    }
}

/// Whether a bound of a block needs no better one. Quick strategies still look for the exact value where the bound is only close,
/// and for a strictly smaller bound of a block that does not attain the radius, which decides the growth.
fn enough<E>(found: &Found<E>, best: &Best, options: &Options, top: bool, quick: bool) -> bool {
    match (top, quick) {
        (false, true) => found.bound < best.floor,
        (true, true) => found.attains || found.bound <= best.floor,
        (_, false) => {
            let close = best.float > 0.0 && to_f64(&found.bound) <= best.float * (1.0 + options.width);
            found.attains || found.bound <= best.floor || close
        }
    }
}

/// Decides [`Growth`]: `floor` is at most the radius.
///
/// A word that attains the radius shows by its Jordan block that products are unbounded. They are bounded where all blocks but
/// one have a radius below `floor`, and that one has an extremal norm: a norm (or invariant body) that proves its bound at the
/// radius itself, or irreducibility (theory §11).
fn growth<E: Radial>(
    system: &System<E>,
    lower: &Lower,
    floor: &Rational,
    exact: bool,
    proofs: &[BlockProof<E>],
) -> Growth {
    let mut top = proofs.iter().filter(|p| p.bound.as_ref().is_none_or(|b| b >= floor));
    match (top.next(), top.next()) {
        (Some(only), None) if exact || only.block.irreducible => Growth::Bounded,
        _ if exact => match longest_block(&system.product(&lower.path)) {
            Some(size) if size > 1 => Growth::Unbounded(size),
            _ => Growth::Unknown,
        },
        _ => Growth::Unknown,
    }
}
