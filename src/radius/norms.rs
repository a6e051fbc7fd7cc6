//! Norms of the letters: `Σ w_i |x_i|` for few choices of weights. The transposed set gives `max |x_i| / w_i`.
#![allow(clippy::float_arithmetic, reason = "proposes weights, the norms are computed exactly")]

use super::answer::Proof;
use super::budget::Budget;
use super::float::Floats;
use super::radial::Radial;
use super::strategy::{Found, Outcome, Strategy, Target};
use super::system::System;
use super::tree::{Tree, exact_weight, weights};
use crate::arith::Rational;

/// The bound by the letters.
pub(super) struct LetterNorms;

impl<E: Radial> Strategy<E> for LetterNorms {
    fn attempt(&self, target: &Target<E>, _known: f64, budget: &Budget) -> Outcome<E> {
        let system = &target.block.system;
        let entries: u64 = system.arrows.iter().map(|a| (a.matrix.rows() * a.matrix.cols()) as u64).sum();
        let mut best: Option<(Rational, Tree)> = None;
        for weights in [Some(plain(system)), leading(target), Some(fitted(system))].into_iter().flatten() {
            // The first choice is made without asking: every set gets an answer.
            if !budget.spend(500 * entries) && best.is_some() {
                break;
            }
            let tree = Tree { codes: letters(system), weights };
            if let Some(bound) = tree.bound(system)
                && best.as_ref().is_none_or(|b| bound < b.0)
            {
                best = Some((bound, tree));
            }
        }
        best.map_or(Outcome::Nothing, |(bound, tree)| {
            let attains = target.best.lower.as_ref().and_then(|l| l.rational()).is_some_and(|r| bound <= r);
            Outcome::Found(Box::new(Found { bound, proof: Proof::Tree(tree), attains, roots: Vec::new() }))
        })
    }
}

/// The code of the single letters.
fn letters<E: Radial>(system: &System<E>) -> Vec<Vec<Vec<usize>>> {
    let own = |s: usize| (0..system.arrows.len()).filter(|a| system.arrows[*a].from == s).map(|a| vec![a]).collect();
    (0..system.dims.len()).map(own).collect()
}

fn plain<E: Radial>(system: &System<E>) -> Vec<Vec<Rational>> {
    system.dims.iter().map(|d| vec![Rational::from(1); *d]).collect()
}

fn fitted<E: Radial>(system: &System<E>) -> Vec<Vec<Rational>> {
    weights(system).iter().map(|w| w.iter().map(exact_weight).collect()).collect()
}

/// The left eigenvector of the best word of a plain set, where it is positive: of one nonnegative matrix it gives the radius.
fn leading<E: Radial>(target: &Target<E>) -> Option<Vec<Vec<Rational>>> {
    let system = &target.block.system;
    if system.dims.len() != 1 {
        return None;
    }
    let m = Floats::of(&system.product(&target.near.first()?.path)).transposed();
    let vector = m.eigenvector(m.eigenvalue().filter(|z| z.1 == 0.0)?.0)?;
    let largest = vector.iter().copied().fold(0.0, f64::max);
    (vector.iter().all(|x| *x > 1e-4 * largest)).then(|| vec![vector.iter().map(exact_weight).collect()])
}
