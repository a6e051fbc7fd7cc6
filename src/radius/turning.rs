//! Complex balanced polytopes as a strategy: for words whose leading eigenvalue turns.
#![allow(clippy::float_arithmetic, reason = "chooses scales; every bound is recomputed exactly")]

use super::answer::Proof;
use super::balanced::{self, complex_enclosure};
use super::budget::Budget;
use super::exact::LeadingVector;
use super::invariant::{real_power, scale_near, scaled};
use super::leading::Eigenvector;
use super::radial::Radial;
use super::strategy::{Found, Outcome, Strategy, Target};
use crate::arith::{Interval, to_f64};

/// A complex balanced polytope at the radius itself.
pub(super) struct Turning {
    pub vertices: usize,
    pub share: u64,
}

impl<E: Radial> Strategy<E> for Turning {
    fn attempt(&self, target: &Target<E>, _known: f64, budget: &Budget) -> Outcome<E> {
        let Some(best) = &target.best.lower else { return Outcome::Nothing };
        let system = &target.block.system;
        if target.own.iter().all(|l| real_power(system, l).is_some()) {
            return Outcome::Nothing;
        }
        let Some(roots) = roots(target) else { return Outcome::Nothing };
        let scaled = scaled(system, target.best.float);
        let most = self.vertices.min(target.options.vertices);
        let task = balanced::Task { system, scaled: &scaled, roots: &roots, radius: best, most, budget };
        match balanced::find(&task) {
            Some(found) => {
                let proof = Proof::Balanced(found.polytope);
                Outcome::Found(Box::new(Found { bound: found.bound, proof, attains: found.attains, roots }))
            }
            None => Outcome::Nothing,
        }
    }

    fn share(&self) -> u64 {
        self.share
    }
}

/// Eigenvectors of the leading words, scaled to about 1; `None` where one is not found.
fn roots<E: Radial>(target: &Target<E>) -> Option<Vec<LeadingVector>> {
    let vector = |lower: &super::Lower| {
        let root = lower.root()?.clone();
        let mut vector: Eigenvector = E::eigenvector(&target.block.system.product(&lower.path), &root)?;
        let size = |z: &(Interval, Interval)| to_f64(&z.0.mid()).hypot(to_f64(&z.1.mid()));
        let largest = complex_enclosure(&vector, 64).iter().map(size).fold(0.0, f64::max);
        if largest == 0.0 || !largest.is_finite() {
            return None;
        }
        vector.scale(&scale_near(1.0 / largest));
        Some(LeadingVector { lower: lower.clone(), root, vector })
    };
    target.own.iter().map(vector).collect()
}
