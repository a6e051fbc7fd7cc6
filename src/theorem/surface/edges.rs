//! The derivatives of a patch on the two sides of its inner edges, at all their points (theory §11.1).

use super::derivative::Patch;
use super::place::Param;
use crate::arith::{Rational, abs};
use crate::linalg::{Matrix, closures};

/// Two faces that share an edge: the states, by position, and the map, on columns `1, u, v`, which puts the parameters of the second face
/// where it lies beside the first one.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Pair {
    first: usize,
    second: usize,
    place: Matrix,
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
    /// `None` where a piece is no cell, or two faces are divided differently along the edge that they share.
    pub fn new(patch: &Patch) -> Option<Self> {
        let mut pairs = Self { list: Vec::new(), steps: Vec::new(), inner: Vec::new() };
        for e in 0..patch.states.len() {
            let here = Pair { first: e, second: e, place: Matrix::identity(3) };
            for (i, j, pair, _) in here.divided(patch)? {
                if i < j {
                    let index = pairs.index(pair);
                    pairs.inner.push((e, [i, j], index));
                }
            }
        }
        while pairs.steps.len() < pairs.list.len() {
            crate::stop::check();
            let pair = &pairs.list[pairs.steps.len()];
            let (edge, divided) = (length(&pair.edge(patch)?), pair.divided(patch)?);
            if divided.iter().fold(Rational::from(0), |sum, step| sum + length(&step.3)) != edge {
                return None;
            }
            let steps = divided.into_iter().map(|(i, j, pair, _)| (i, j, pairs.index(pair))).collect();
            pairs.steps.push(steps);
        }
        Some(pairs)
    }

    fn index(&mut self, pair: Pair) -> usize {
        if let Some(known) = self.list.iter().position(|p| *p == pair) {
            return known;
        }
        self.list.push(pair);
        self.list.len() - 1
    }

    pub fn len(&self) -> usize {
        self.list.len()
    }
}

impl Pair {
    /// The pieces of the first and of the second face that share an edge, with their position beside one another, and where this edge
    /// lies in the parameters of the first face; `None` where a piece is no cell.
    fn divided(&self, patch: &Patch) -> Option<Vec<(usize, usize, Self, Segment)>> {
        let mut found = Vec::new();
        for (i, first) in patch.places[self.first].iter().enumerate() {
            for (j, second) in patch.places[self.second].iter().enumerate() {
                let place = first.solve(&(&self.place * second))?;
                let pair = Self { first: patch.targets[self.first][i], second: patch.targets[self.second][j], place };
                if let Some(edge) = pair.edge(patch) {
                    found.push((i, j, pair, edge.map(|x| first.apply(&x))));
                }
            }
        }
        Some(found)
    }

    /// The two corners that the faces share, where they share two, in the parameters of the first one.
    fn edge(&self, patch: &Patch) -> Option<Segment> {
        let column = |[u, v]: &Param| vec![Rational::from(1), u.clone(), v.clone()];
        let corners = |e: usize| patch.chart.corners(patch.states[e]).iter().map(column).collect::<Vec<_>>();
        let own = corners(self.first);
        let there = corners(self.second).into_iter().map(|x| self.place.apply(&x)).filter(|x| own.contains(x));
        there.collect::<Vec<_>>().try_into().ok()
    }
}

/// Two points as columns `1, u, v`.
type Segment = [Vec<Rational>; 2];

/// The length of a segment; of segments of one line only, as the sum of those of its coordinates.
fn length([p, q]: &Segment) -> Rational {
    p.iter().zip(q).fold(Rational::from(0), |sum, (x, y)| sum + abs(&(x - y)))
}

/// The first two pieces, with their state by index, whose derivatives differ at a point of the edge that they share, if there is one; of
/// no use (`None`) where a derivative is not unique, an edge has no parts, or there is no edge.
pub(super) fn agree(patch: &Patch, pairs: &Pairs) -> Option<Option<(usize, [usize; 2])>> {
    if pairs.inner.is_empty() {
        return None;
    }
    let mut spaces = Vec::new();
    for start in 0..pairs.list.len() {
        spaces.push(along(patch, pairs, start)?);
    }
    let mut arrows = Vec::new();
    for (from, steps) in pairs.steps.iter().enumerate() {
        let pair = &pairs.list[from];
        for &(i, j, to) in steps {
            let both = diagonal(&patch.on_derivatives(pair.first, i), &patch.on_derivatives(pair.second, j));
            arrows.push((to, from, both.transpose()));
        }
    }
    let spaces = closures(spaces, &arrows);
    let differs = |(e, [i, j], pair): &&(usize, [usize; 2], usize)| {
        let (before, after) = (patch.on_derivatives(*e, *i), patch.on_derivatives(*e, *j));
        let jump = before.beside(&after.scale(&Rational::from(-1)));
        !(&spaces[*pair] * &jump.transpose()).is_zero()
    };
    Some(pairs.inner.iter().find(differs).map(|(e, letters, _)| (patch.states[*e], *letters)))
}

/// The derivatives of both faces at one point of the edge that they share, as one row: along the first parts, until a pair comes back.
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
            let both = [first, second].concat();
            return Some(Matrix::from_rows(both.len(), vec![both]));
        }
        seen.push(next);
    }
}

/// Both maps, on the coordinates of both.
pub(super) fn diagonal(a: &Matrix, b: &Matrix) -> Matrix {
    let zero = |r: usize, c: usize| Matrix::zero(r, c);
    a.beside(&zero(a.rows(), b.cols())).stack(&zero(b.rows(), a.cols()).beside(b))
}
