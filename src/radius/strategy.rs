//! The ways of bounding a block from above, in the order in which they are tried.

use super::answer::Proof;
use super::blocks::Block;
use super::budget::{Budget, Options};
use super::exact::LeadingVector;
use super::invariant::{AtRadius, Between, Inflated};
use super::leading::Lower;
use super::norms::LetterNorms;
use super::quadratic::QuadraticNorm;
use super::radial::Radial;
use super::search::Candidate;
use super::sums::Sums;
use super::tree::Words;
use super::turning::Turning;
use crate::arith::Rational;

/// The best word of all blocks.
pub(super) struct Best {
    /// `None` where no word has a positive value.
    pub lower: Option<Lower>,
    pub float: f64,
    /// A rational not above the value, and close.
    pub floor: Rational,
}

/// A block that is to be bounded.
pub(super) struct Target<'a, E = Rational> {
    pub block: Block<E>,
    pub best: &'a Best,
    /// Words of the block whose value is exactly that of the best word of all; their eigenvalues are exact.
    pub own: Vec<Lower>,
    /// The words of the block that grow fastest, in floats, best first.
    pub near: Vec<Candidate>,
    pub options: &'a Options,
}

impl<E: Radial> Target<'_, E> {
    /// The growth of the block's best word, in floats.
    pub fn value(&self) -> f64 {
        self.near.iter().map(|c| c.value).fold(0.0, f64::max)
    }

    /// The same for the transposed matrices.
    fn transposed(&self) -> Self {
        let system = self.block.system.transposed();
        let turned = |path: &[usize]| path.iter().rev().copied().collect::<Vec<usize>>();
        let own = |l: &Lower| Lower { path: turned(&l.path), word: turned(&l.word), ..l.clone() };
        Self {
            own: self.own.iter().map(own).collect(),
            near: self.near.iter().map(|c| Candidate { path: turned(&c.path), value: c.value }).collect(),
            block: Block { system, ..self.block.clone() },
            best: self.best,
            options: self.options,
        }
    }
}

/// A bound of a block.
pub(super) struct Found<E = Rational> {
    pub bound: Rational,
    pub proof: Proof<E>,
    /// Whether it shows that the radius of the block is at most the value of the best word.
    pub attains: bool,
    pub roots: Vec<LeadingVector>,
}

/// What came of an attempt.
pub(super) enum Outcome<E = Rational> {
    /// A bound, not always a better one than there was.
    Found(Box<Found<E>>),
    /// A cyclic path of the block that grows faster than the best word.
    Better(Vec<usize>),
    /// Nothing: it does not apply, or its limits were reached.
    Nothing,
}

/// A way of bounding a block from above.
pub(super) trait Strategy<E> {
    /// Tries it. `known` is the bound so far, in floats (infinite without one).
    fn attempt(&self, target: &Target<E>, known: f64, budget: &Budget) -> Outcome<E>;

    /// The share of the whole work that it may spend, in thousandths.
    fn share(&self) -> u64 {
        QUICK
    }
}

/// The share of strategies that are quick enough to look for the exact value where a bound is already as close as was asked for.
pub(super) const QUICK: u64 = 60;

/// A strategy applied to the transposed matrices.
struct Transposed<S>(S);

impl<E: Radial, S: Strategy<E>> Strategy<E> for Transposed<S> {
    fn attempt(&self, target: &Target<E>, known: f64, budget: &Budget) -> Outcome<E> {
        match self.0.attempt(&target.transposed(), known, budget) {
            Outcome::Found(found) => {
                let proof = Proof::Transposed(Box::new(found.proof));
                Outcome::Found(Box::new(Found { proof, roots: Vec::new(), ..*found }))
            }
            Outcome::Better(path) => Outcome::Better(path.into_iter().rev().collect()),
            Outcome::Nothing => Outcome::Nothing,
        }
    }

    fn share(&self) -> u64 {
        self.0.share()
    }
}

/// For a first glance, with short words only: norms that cost next to nothing, and small bodies.
pub(super) fn glance<E: Radial>(top: bool) -> Vec<Box<dyn Strategy<E>>> {
    let mut list: Vec<Box<dyn Strategy<E>>> = vec![Box::new(LetterNorms), Box::new(Transposed(LetterNorms))];
    if top {
        list.push(Box::new(QuadraticNorm));
        list.push(Box::new(AtRadius { vertices: 60, share: 20 }));
        list.push(Box::new(Transposed(AtRadius { vertices: 60, share: 20 })));
    } else {
        list.push(Box::new(Between { part: 0.6, vertices: 60, share: 20 }));
    }
    list
}

/// For blocks that may attain the radius: cheap norms first, so that there is an answer at once; then bodies that are invariant at
/// the radius itself, small ones before large ones; then slightly larger radii; at last the norms of many words.
pub(super) fn leading<E: Radial>() -> Vec<Box<dyn Strategy<E>>> {
    vec![
        Box::new(LetterNorms),
        Box::new(Transposed(LetterNorms)),
        Box::new(QuadraticNorm),
        Box::new(Words { most: 60, share: 20 }),
        Box::new(Sums),
        Box::new(AtRadius { vertices: 120, share: 60 }),
        Box::new(Transposed(AtRadius { vertices: 120, share: 60 })),
        Box::new(Turning { vertices: 60, share: 60 }),
        Box::new(Inflated { gap: 1e-10, vertices: 200, share: 60 }),
        Box::new(Inflated { gap: 1e-3, vertices: 1000, share: 100 }),
        Box::new(AtRadius { vertices: 600, share: 100 }),
        Box::new(Inflated { gap: 4e-5, vertices: 3000, share: 250 }),
        Box::new(Transposed(Inflated { gap: 4e-5, vertices: 3000, share: 250 })),
        Box::new(Turning { vertices: 300, share: 120 }),
        Box::new(AtRadius { vertices: 3000, share: 300 }),
        Box::new(Transposed(AtRadius { vertices: 3000, share: 300 })),
        Box::new(Inflated { gap: 1e-7, vertices: 3000, share: 300 }),
        Box::new(Inflated { gap: 8e-10, vertices: 8000, share: 400 }),
        Box::new(Words { most: 4000, share: 300 }),
    ]
}

/// For blocks with a radius below that of another block, as it seems: any bound up to the best word suffices.
pub(super) fn smaller<E: Radial>() -> Vec<Box<dyn Strategy<E>>> {
    vec![
        Box::new(LetterNorms),
        Box::new(Transposed(LetterNorms)),
        Box::new(Words { most: 200, share: 40 }),
        Box::new(Between { part: 0.6, vertices: 400, share: 60 }),
        Box::new(Between { part: 0.95, vertices: 1500, share: 150 }),
        Box::new(Transposed(Between { part: 0.95, vertices: 1500, share: 150 })),
        Box::new(Between { part: 0.999_99, vertices: 2500, share: 200 }),
        Box::new(Words { most: 4000, share: 300 }),
    ]
}
