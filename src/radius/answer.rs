//! What is said of a joint spectral radius, and what proves it.

use super::balanced::Balanced;
use super::blocks::{Block, Step};
use super::exact::LeadingVector;
use super::leading::Lower;
use super::polytope::Polytope;
use super::quadratic::Quadratic;
use super::radial::Radial;
use super::system::System;
use super::tree::Tree;
use crate::arith::{Interval, Rational, abs};

/// What bounds a block from above.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Proof<E = Rational> {
    /// An invariant polytope.
    Polytope(Polytope<E>),
    /// Quadratic norms.
    Quadratic(Quadratic<E>),
    /// An invariant complex balanced polytope.
    Balanced(Balanced),
    /// Norms of the words of a tree; of the letters where every word has one.
    Tree(Tree),
    /// A proof for the transposed matrices ([`System::transposed`]), whose radius is the same.
    Transposed(Box<Proof<E>>),
}

impl<E: Radial> Proof<E> {
    /// The bound of the radius that the data prove for a block; `None` where they prove nothing.
    #[must_use]
    pub fn bound(&self, system: &System<E>) -> Option<Rational> {
        match self {
            Self::Polytope(p) => p.bound(system),
            Self::Balanced(p) => p.bound(system),
            Self::Tree(t) => t.bound(system),
            Self::Quadratic(q) => q.holds(system).then(|| super::square_root(&q.square, 64).hi),
            Self::Transposed(inner) => inner.bound(&system.transposed()),
        }
    }
}

impl Proof {
    /// A bound for all matrices whose entries differ from those of a plain set by at most `error`; `None` where it is not known.
    #[must_use]
    pub fn bound_near(&self, system: &System, error: &Rational) -> Option<Rational> {
        // A change of every entry by at most `error` adds at most `K n² error max|q|` in the norm of a polytope with points `q`
        // and `e_j ∈ K Q`; of a complex number |re| + |im| is taken.
        let widened = |bound: Rational, size: Rational, interior: Rational| {
            let n = Rational::from(*system.dims.first()? as u64);
            Some(bound + interior * &n * &n * error * size)
        };
        if system.dims.len() != 1 {
            return None;
        }
        match self {
            Self::Polytope(p) => {
                let size = p.points.iter().flat_map(|q| q.coordinates.iter().map(abs)).max()?;
                widened(p.bound(system)?, size, p.interior(system, 0)?)
            }
            Self::Balanced(p) => {
                let size = p.points.iter().flat_map(|q| q.coordinates.iter().map(|z| abs(&z.0) + abs(&z.1))).max()?;
                widened(p.bound(system)?, size, p.interior(system, 0)?)
            }
            Self::Tree(tree) => tree.bound_near(system, error),
            Self::Quadratic(_) => None,
            Self::Transposed(inner) => inner.bound_near(&system.transposed(), error),
        }
    }
}

/// A diagonal block and what was proved of it.
#[derive(Debug, Clone)]
pub struct BlockProof<E = Rational> {
    /// The block.
    pub block: Block<E>,
    /// Leading words of the block with their eigenvectors, where the proof begins with them.
    pub roots: Vec<LeadingVector>,
    /// The upper bound proved by `proof` in exact arithmetic; `None` where nothing was proved.
    pub bound: Option<Rational>,
    /// Whether the block's radius was shown to be equal to the lower bound of the whole.
    pub attains: bool,
    /// The proof.
    pub proof: Option<Proof<E>>,
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

/// Why the search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The radius is known exactly, or its bounds are as narrow as was asked for.
    Done,
    /// Everything was tried with the limits of the options.
    Exhausted,
    /// The work of the options was spent.
    Work,
    /// The clock stopped it: another run may come farther.
    Clock,
}

/// The answer: `lower <= radius <= upper`.
#[derive(Debug, Clone)]
pub struct JointRadius<E = Rational> {
    /// The best word; `None` where no word with a positive value was found (if `exact`, there is none, and the radius is 0).
    pub lower: Option<Lower>,
    /// A rational upper bound; `None` where nothing was proved.
    pub upper: Option<Rational>,
    /// Whether the radius was shown to be exactly the value of the word (or 0 without one).
    pub exact: bool,
    /// How products grow.
    pub growth: Growth,
    /// The diagonal blocks.
    pub blocks: Vec<BlockProof<E>>,
    /// The flag of invariant families to which the blocks belong, in its order.
    pub flag: Vec<Step<E>>,
    /// Why the search ended.
    pub ended: Ended,
}

impl<E> JointRadius<E> {
    /// An interval that holds the radius; where it is known exactly, of width about `2^-bits`. `None` without an upper bound.
    #[must_use]
    pub fn enclosure(&self, bits: u64) -> Option<Interval> {
        let lower = self.lower.as_ref().map(|l| l.enclosure(bits));
        match (lower, self.exact) {
            (Some(value), true) => Some(value),
            (Some(value), false) => Some(Interval::new(value.lo, self.upper.clone()?)),
            (None, _) => Some(Interval::new(Rational::from(0), self.upper.clone()?)),
        }
    }
}
