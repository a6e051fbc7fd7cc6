//! Upper bounds by trees of words, after Gripenberg: a last resort that always gives one.
#![allow(clippy::float_arithmetic, reason = "chooses the words, their norms are computed exactly")]

use super::System;
use super::float::Floats;
use super::leading::root_of;
use crate::arith::{Interval, Rational, abs};
use crate::linalg::Matrix;
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
    pub fn bound(&self, system: &System) -> Option<Rational> {
        self.bound_near(system, &Rational::from(0))
    }

    /// The bound that the words prove for all matrices whose entries differ from the system's by at most `error`.
    #[must_use]
    pub fn bound_near(&self, system: &System, error: &Rational) -> Option<Rational> {
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
        let norm_of = |a: &super::Arrow| weighted_norm(&a.matrix, &self.weights[a.from], &self.weights[a.to]);
        let largest = short(system.arrows.iter().map(norm_of).max()?);
        let drift = |length: usize| {
            let power = |x: &Rational| (0..length).fold(Rational::from(1), |p, _| p * x);
            if *error == 0 { Rational::from(0) } else { power(&(&largest + &change)) - power(&largest) }
        };
        let mut bound = Rational::from(0);
        for (state, code) in self.codes.iter().enumerate() {
            if !complete(system, state, code) {
                return None;
            }
            for word in code {
                let (from, to) = (system.arrows[word[0]].from, system.arrows[word[word.len() - 1]].to);
                let norm = weighted_norm(&system.product(word), &self.weights[from], &self.weights[to]);
                bound = bound.max(root_of(&Interval::point(norm + drift(word.len())), word.len(), 64).hi);
            }
        }
        Some(bound)
    }
}

/// Whether every long path from the state begins with exactly one word of the code.
fn complete(system: &System, state: usize, code: &[Vec<usize>]) -> bool {
    let mut sorted: Vec<&[usize]> = code.iter().map(Vec::as_slice).collect();
    sorted.sort_unstable();
    fn walk(system: &System, at: usize, word: &mut Vec<usize>, sorted: &[&[usize]], used: &mut usize) -> bool {
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
fn weighted_norm(m: &Matrix, from: &[Rational], to: &[Rational]) -> Rational {
    let column = |j: usize| (0..m.rows()).fold(Rational::from(0), |s, i| s + abs(&m[(i, j)]) * &from[i]) / &to[j];
    (0..m.cols()).map(column).max().unwrap_or_default()
}

/// Lengthens the words with the largest norms until `goal` is reached or there are `most` words.
pub(super) fn find(system: &System, goal: f64, most: usize) -> Tree {
    let weights = weights(system);
    let scaled: Vec<Floats> = system
        .arrows
        .iter()
        .map(|a| {
            let mut m = Floats::of(&a.matrix);
            for i in 0..m.rows {
                for j in 0..m.cols {
                    m.data[i * m.cols + j] *= weights[a.from][i] / weights[a.to][j];
                }
            }
            m
        })
        .collect();
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
        if worst.value <= goal || worst.path.len() >= 60 || next.is_empty() {
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
    let mut codes = vec![Vec::new(); system.dims.len()];
    for leaf in leaves.into_sorted_vec() {
        codes[system.arrows[leaf.path[0]].from].push(leaf.path);
    }
    let exact = |w: &f64| super::exact::grid(*w).max(super::exact::grid(1e-6));
    Tree { codes, weights: weights.iter().map(|w| w.iter().map(exact).collect()).collect() }
}

/// Weights for which the sums of columns of absolute values are about equal: a few steps of the power method.
fn weights(system: &System) -> Vec<Vec<f64>> {
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
        let tree = find(&own, 0.7, 40);
        let plain = tree.bound(&own).unwrap();
        assert_eq!(tree.bound_near(&own, &ratio(0, 1)), Some(plain.clone()));
        for error in [ratio(1, 1000), ratio(1, 20)] {
            let near = tree.bound_near(&own, &error).unwrap();
            assert!(near > plain && near >= tree.bound(&system(&error)).unwrap(), "{error}");
            assert!(near < &plain + ratio(40, 1) * &error, "{error}");
        }
    }
}
