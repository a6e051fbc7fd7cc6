//! The derivatives of a patch on the two sides of its inner edges, at all their points (theory §11.1).

use super::derivative::Patch;
use super::place::{Param, corners};
use crate::arith::Rational;
use crate::linalg::{Matrix, closures};
use std::collections::BTreeMap;

/// Two faces that share an edge: the states, by position, and `x ↦ sign x + shift`, which puts the parameters of the second face where
/// it lies beside the first one.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    first: usize,
    second: usize,
    sign: Rational,
    shift: Param,
}

/// All positions of two faces that share an edge inside a face, and how they are divided along it.
pub(super) struct Pairs {
    list: Vec<Pair>,
    /// By pair: the letters of the two pieces that share a part of the edge, and their own pair.
    steps: Vec<Vec<(usize, usize, usize)>>,
    /// State, by position, two letters, and the pair of these pieces.
    inner: Vec<(usize, [usize; 2], usize)>,
}

impl Pairs {
    pub fn new(patch: &Patch) -> Self {
        let mut pairs = Self { list: Vec::new(), steps: Vec::new(), inner: Vec::new() };
        let mut known = BTreeMap::new();
        let own = Pair { first: 0, second: 0, sign: Rational::from(1), shift: [Rational::from(0), Rational::from(0)] };
        for e in 0..patch.states.len() {
            let here = Pair { first: e, second: e, ..own.clone() };
            for (i, j, pair) in here.divided(patch) {
                if i < j {
                    let index = pairs.index(&mut known, pair);
                    pairs.inner.push((e, [i, j], index));
                }
            }
        }
        while pairs.steps.len() < pairs.list.len() {
            crate::stop::check();
            let divided = pairs.list[pairs.steps.len()].divided(patch);
            let steps = divided.into_iter().map(|(i, j, pair)| (i, j, pairs.index(&mut known, pair))).collect();
            pairs.steps.push(steps);
        }
        pairs
    }

    fn index(&mut self, known: &mut BTreeMap<Pair, usize>, pair: Pair) -> usize {
        let next = self.list.len();
        let index = *known.entry(pair.clone()).or_insert(next);
        if index == next {
            self.list.push(pair);
        }
        index
    }

    pub fn len(&self) -> usize {
        self.list.len()
    }
}

impl Pair {
    /// The pieces of the first and of the second face that share an edge, with their position beside one another.
    fn divided(&self, patch: &Patch) -> Vec<(usize, usize, Self)> {
        let mut found = Vec::new();
        for (i, (s, p)) in patch.places[self.first].iter().enumerate() {
            for (j, (t, q)) in patch.places[self.second].iter().enumerate() {
                let shift = [0, 1].map(|k| (&self.sign * &q[k] + &self.shift[k] - &p[k]) / s);
                let pair = Self {
                    first: patch.targets[self.first][i],
                    second: patch.targets[self.second][j],
                    sign: &self.sign * t / s,
                    shift,
                };
                if pair.shares_an_edge(patch) {
                    found.push((i, j, pair));
                }
            }
        }
        found
    }

    fn shares_an_edge(&self, patch: &Patch) -> bool {
        let own = corners(patch.chart.layout(patch.states[self.first]));
        let moved = |x: &Param| [0, 1].map(|k| &self.sign * &x[k] + &self.shift[k]);
        let other = corners(patch.chart.layout(patch.states[self.second]));
        other.iter().filter(|x| own.contains(&moved(x))).count() == 2
    }
}

/// The first two pieces, with their state by index, whose derivatives differ at a point of the edge that they share, if there is one; of
/// no use (`None`) where a derivative is not unique, or an edge has no parts.
pub(super) fn agree(patch: &Patch, pairs: &Pairs) -> Option<Option<(usize, [usize; 2])>> {
    let mut spaces = Vec::new();
    for start in 0..pairs.list.len() {
        spaces.push(along(patch, pairs, start)?);
    }
    let mut arrows = Vec::new();
    for (from, steps) in pairs.steps.iter().enumerate() {
        let pair = &pairs.list[from];
        for &(i, j, to) in steps {
            let both = diagonal(&patch.scaled[pair.first][i], &patch.scaled[pair.second][j]);
            arrows.push((to, from, both.transpose()));
        }
    }
    let spaces = closures(spaces, &arrows);
    let differs = |(e, [i, j], pair): &&(usize, [usize; 2], usize)| {
        let (before, after) = (&patch.scaled[*e][*i], &patch.scaled[*e][*j]);
        let jump = before.beside(&after.scale(&Rational::from(-1)));
        !(&spaces[*pair] * &jump.transpose()).is_zero()
    };
    Some(pairs.inner.iter().find(differs).map(|(e, letters, _)| (patch.states[*e], *letters)))
}

/// The derivatives of both faces at one point of the edge that they share, as rows: along the first parts, until a pair comes back.
fn along(patch: &Patch, pairs: &Pairs, start: usize) -> Option<Matrix> {
    let mut seen = vec![start];
    let mut letters: Vec<(usize, usize)> = Vec::new();
    loop {
        let &(i, j, next) = pairs.steps[*seen.last()?].first()?;
        letters.push((i, j));
        if let Some(k) = seen.iter().position(|p| *p == next) {
            let pair = &pairs.list[next];
            let (prefix, cycle) = letters.split_at(k);
            let word = |part: &[(usize, usize)], side: usize| -> Vec<usize> {
                part.iter().map(|l| if side == 0 { l.0 } else { l.1 }).collect()
            };
            let first = patch.limit(pairs.list[start].first, &word(prefix, 0), pair.first, &word(cycle, 0))?;
            let second = patch.limit(pairs.list[start].second, &word(prefix, 1), pair.second, &word(cycle, 1))?;
            return Some(first.beside(&second));
        }
        seen.push(next);
    }
}

fn diagonal(a: &Matrix, b: &Matrix) -> Matrix {
    let zero = |r: usize, c: usize| Matrix::zero(r, c);
    a.beside(&zero(a.rows(), b.cols())).stack(&zero(b.rows(), a.cols()).beside(b))
}
