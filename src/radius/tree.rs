//! Upper bounds by trees of words, after Gripenberg: a last resort that always gives one.
#![allow(clippy::float_arithmetic, reason = "chooses the words, their norms are computed exactly")]

use super::System;
use super::answer::Proof;
use super::budget::Budget;
use super::float::Floats;
use super::leading::root_of;
use super::radial::{Radial, upper};
use super::strategy::{Found, Outcome, Strategy, Target};
use crate::arith::{Interval, Rational};
use crate::linalg::{Matrix, Products as _};
use malachite_base::num::arithmetic::traits::CheckedRoot;
use std::collections::BinaryHeap;

/// For every state a complete prefix code of paths, and weights of a norm in which each word `w` has a norm of at most
/// `bound^|w|`. Then the joint spectral radius is at most `bound`: long paths are cut into words of the code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tree {
    /// By state: the paths of the code, as positions of arrows.
    pub codes: Vec<Vec<Vec<usize>>>,
    /// By state: positive weights of the norm `Σ w_i |x_i|`.
    pub weights: Vec<Vec<Rational>>,
}

impl Tree {
    /// The bound that the words prove, rounded upwards; `None` where a code is not complete or a weight not positive.
    #[must_use]
    pub fn bound<E: Radial>(&self, system: &System<E>) -> Option<Rational> {
        self.bound_near(system, &Rational::from(0))
    }

    /// The bound that the words prove for all matrices whose entries differ from the system's by at most `error`.
    #[must_use]
    pub fn bound_near<E: Radial>(&self, system: &System<E>, error: &Rational) -> Option<Rational> {
        let fits = self.weights.len() == system.dims.len()
            && self.weights.iter().zip(&system.dims).all(|(w, d)| w.len() == *d && w.iter().all(|x| *x > 0));
        if !fits || self.codes.len() != system.dims.len() {
            return None;
        }
        // In these norms one matrix changes by at most `change`, and a product of l by (largest + change)^l − largest^l.
        let short = |x: Rational| Interval::point(x).outward(96).hi;
        let all = || self.weights.iter().flatten();
        let spread = all().max()? / all().min()?;
        let size = Rational::from(*system.dims.iter().max()? as u64);
        let change = short(size * error * spread);
        let norm_of = |a: &super::Arrow<E>| weighted_norm(&a.matrix, &self.weights[a.from], &self.weights[a.to]);
        let largest = short(system.arrows.iter().map(norm_of).max()?);
        let drift = |length: usize| {
            let power = |x: &Rational| (0..length).fold(Rational::from(1), |p, _| p * x);
            if *error == 0 { Rational::from(0) } else { power(&(&largest + &change)) - power(&largest) }
        };
        let mut bound = Rational::from(0);
        let mut products = Products::new(system);
        for (state, code) in self.codes.iter().enumerate() {
            if !complete(system, state, code) {
                return None;
            }
            // In order, so that words share the products of their beginnings.
            let mut sorted: Vec<&Vec<usize>> = code.iter().collect();
            sorted.sort_unstable();
            for word in sorted {
                let to = system.arrows[word[word.len() - 1]].to;
                let norm = products.norm(word, &self.weights[state], &self.weights[to]);
                let size = norm + drift(word.len());
                let root = (&size).checked_root(word.len() as u64);
                bound = bound.max(match root {
                    Some(exact) => exact,
                    None => root_of(&Interval::point(size), word.len(), 64).hi,
                });
            }
        }
        Some(bound)
    }
}

/// Whether every long path from the state begins with exactly one word of the code.
fn complete<E>(system: &System<E>, state: usize, code: &[Vec<usize>]) -> bool {
    let mut sorted: Vec<&[usize]> = code.iter().map(Vec::as_slice).collect();
    sorted.sort_unstable();
    fn walk<E>(system: &System<E>, at: usize, word: &mut Vec<usize>, sorted: &[&[usize]], used: &mut usize) -> bool {
        if !word.is_empty() && sorted.binary_search(&word.as_slice()).is_ok() {
            *used += 1;
            return true;
        }
        if !sorted.iter().any(|w| w.starts_with(word)) {
            return false;
        }
        (0..system.arrows.len()).filter(|&a| system.arrows[a].from == at).all(|a| {
            word.push(a);
            let fine = walk(system, system.arrows[a].to, word, sorted, used);
            word.pop();
            fine
        })
    }
    let mut used = 0;
    let leaves = (0..system.arrows.len()).any(|a| system.arrows[a].from == state);
    (!leaves && code.is_empty()) || (walk(system, state, &mut Vec::new(), &sorted, &mut used) && used == code.len())
}

/// The norm of a matrix for the norms `Σ w_i |x_i|` of its two spaces.
fn weighted_norm<E: Radial>(m: &Matrix<E>, from: &[Rational], to: &[Rational]) -> Rational {
    let column = |j: usize| {
        let terms = (0..m.rows()).map(|i| m[(i, j)].absolute().times(&E::of(&from[i])));
        upper(&terms.fold(E::zero(), |s, x| s.plus(&x))) / &to[j]
    };
    (0..m.cols()).map(column).fold(Rational::from(0), Rational::max)
}

/// The products of the beginnings of the last word.
struct Products<E: Radial> {
    letters: Vec<E::Product>,
    word: Vec<usize>,
    stack: Vec<E::Product>,
}

impl<E: Radial> Products<E> {
    fn new(system: &System<E>) -> Self {
        let letters = system.arrows.iter().map(|a| E::Product::of(&a.matrix)).collect();
        Self { letters, word: Vec::new(), stack: Vec::new() }
    }

    /// The weighted norm of the product of a word that is not empty.
    fn norm(&mut self, word: &[usize], from: &[Rational], to: &[Rational]) -> Rational {
        let common = self.word.iter().zip(word).take_while(|(a, b)| a == b).count();
        self.stack.truncate(common);
        for &a in &word[common..] {
            let letter = &self.letters[a];
            let next = self.stack.last().map_or_else(|| letter.clone(), |product| product.times(letter));
            self.stack.push(next);
        }
        self.word = word.to_vec();
        let Some(product) = self.stack.last() else { return Rational::from(1) };
        weighted_norm(&product.reduced(), from, to)
    }
}

/// Bounds by the norms of many words.
pub(super) struct Words {
    /// Most words.
    pub most: usize,
    pub share: u64,
}

impl<E: Radial> Strategy<E> for Words {
    fn attempt(&self, target: &Target<E>, known: f64, budget: &Budget) -> Outcome<E> {
        let system = &target.block.system;
        let goal = target.best.float * (1.0 + target.options.width.max(1e-5));
        if known <= goal && target.best.float > 0.0 {
            return Outcome::Nothing;
        }
        let (tree, value) = find(system, goal, self.most, budget);
        if value >= known {
            return Outcome::Nothing;
        }
        let Some(bound) = tree.bound(system) else { return Outcome::Nothing };
        let attains = target.best.lower.as_ref().and_then(|l| l.rational()).is_some_and(|r| bound <= r);
        Outcome::Found(Box::new(Found { bound, proof: Proof::Tree(tree), attains, roots: Vec::new() }))
    }

    fn share(&self) -> u64 {
        self.share
    }
}

/// Lengthens the words with the largest norms until `goal` is reached, there are `most` words or the budget ends; with the bound
/// in floats.
fn find<E: Radial>(system: &System<E>, goal: f64, most: usize, budget: &Budget) -> (Tree, f64) {
    let weights = weights(system);
    let mut scaled = Floats::all(system);
    for (m, a) in scaled.iter_mut().zip(&system.arrows) {
        for i in 0..m.rows {
            for j in 0..m.cols {
                m.data[i * m.cols + j] *= weights[a.from][i] / weights[a.to][j];
            }
        }
    }
    let norm = |m: &Floats| {
        let column = |j: usize| (0..m.rows).map(|i| m.data[i * m.cols + j].abs()).sum::<f64>();
        (0..m.cols).map(column).fold(0.0, f64::max)
    };
    let mut leaves: BinaryHeap<Leaf> = (0..system.arrows.len())
        .map(|a| Leaf { value: norm(&scaled[a]), path: vec![a], product: scaled[a].clone() })
        .collect();
    while leaves.len() < most {
        let Some(worst) = leaves.pop() else { break };
        let end = system.arrows[worst.path[worst.path.len() - 1]].to;
        let next: Vec<usize> = (0..system.arrows.len()).filter(|&a| system.arrows[a].from == end).collect();
        // Products of floats, and later of whole numbers.
        let work: u64 = next.iter().map(|a| 2000 + (28 + E::PRODUCT) * scaled[*a].cube()).sum();
        if worst.value <= goal || worst.path.len() >= 60 || next.is_empty() || !budget.spend(work) {
            leaves.push(worst);
            break;
        }
        for a in next {
            let product = worst.product.times(&scaled[a]);
            let path = [worst.path.as_slice(), &[a]].concat();
            let value = norm(&product).powf(1.0 / path.len() as f64);
            leaves.push(Leaf { value, path, product });
        }
    }
    let value = leaves.peek().map_or(f64::INFINITY, |l| l.value);
    let mut codes = vec![Vec::new(); system.dims.len()];
    for leaf in leaves.into_sorted_vec() {
        codes[system.arrows[leaf.path[0]].from].push(leaf.path);
    }
    (Tree { codes, weights: weights.iter().map(|w| w.iter().map(exact_weight).collect()).collect() }, value)
}

/// A weight as an exact number that is not 0.
pub(super) fn exact_weight(w: &f64) -> Rational {
    super::exact::grid(*w).max(super::exact::grid(1e-6))
}

/// Weights for which the sums of columns of absolute values are about equal: a few steps of the power method.
pub(super) fn weights<E: Radial>(system: &System<E>) -> Vec<Vec<f64>> {
    let mut weights: Vec<Vec<f64>> = system.dims.iter().map(|d| vec![1.0; *d]).collect();
    let floats = Floats::all(system);
    for _ in 0..60 {
        let mut next: Vec<Vec<f64>> = system.dims.iter().map(|d| vec![1e-3; *d]).collect();
        for (arrow, m) in system.arrows.iter().zip(&floats) {
            for (j, sum) in next[arrow.to].iter_mut().enumerate() {
                *sum += (0..m.rows).map(|i| m.data[i * m.cols + j].abs() * weights[arrow.from][i]).sum::<f64>();
            }
        }
        let largest = next.iter().flatten().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (w, n) in weights.iter_mut().flatten().zip(next.iter().flatten()) {
            *w = (*w * (n / largest)).sqrt().max(1e-5);
        }
    }
    weights
}

struct Leaf {
    value: f64,
    path: Vec<usize>,
    product: Floats,
}

impl PartialEq for Leaf {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Leaf {}

impl PartialOrd for Leaf {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Leaf {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.value.total_cmp(&other.value).then_with(|| other.path.cmp(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    /// A word is missing, or there is one more behind another: no code.
    #[test]
    fn codes_that_are_not_complete_prove_nothing() {
        let half = Matrix::identity(1).scale(&ratio(1, 2));
        let system = System::plain(&[half.clone(), half]).unwrap();
        let bound =
            |code: &[Vec<usize>]| Tree { codes: vec![code.to_vec()], weights: vec![vec![ratio(1, 1)]] }.bound(&system);
        assert!(bound(&[vec![0], vec![1]]).is_some_and(|b| b >= ratio(1, 2) && b < ratio(51, 100)));
        let codes = [
            vec![],
            vec![vec![0]],
            vec![vec![0], vec![0, 1]],
            vec![vec![0], vec![1], vec![0, 1]],
            vec![vec![], vec![0], vec![1]],
        ];
        for code in &codes {
            assert_eq!(bound(code), None, "{code:?}");
        }
    }

    /// The bound for matrices near the system's holds for the farthest of them, and is the plain one where none may differ.
    #[test]
    fn bounds_for_matrices_nearby() {
        let system = |e: &Rational| {
            let entry = |p: i64| ratio(p, 5) + e;
            let matrix = |v: [i64; 4]| {
                Matrix::from_rows(2, vec![vec![entry(v[0]), entry(v[1])], vec![entry(v[2]), entry(v[3])]])
            };
            System::plain(&[matrix([2, 1, 0, 3]), matrix([1, 2, 2, 1])]).unwrap()
        };
        let own = system(&ratio(0, 1));
        let budget = Budget::new(&super::super::Options::default(), 2);
        let tree = find(&own, 0.7, 40, &budget).0;
        let plain = tree.bound(&own).unwrap();
        assert_eq!(tree.bound_near(&own, &ratio(0, 1)), Some(plain.clone()));
        for error in [ratio(1, 1000), ratio(1, 20)] {
            let near = tree.bound_near(&own, &error).unwrap();
            assert!(near > plain && near >= tree.bound(&system(&error)).unwrap(), "{error}");
            assert!(near < &plain + ratio(40, 1) * &error, "{error}");
        }
    }
}
