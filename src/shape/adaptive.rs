//! Exact points of an attractor, with cells of about one size: the largest cell is divided first.
#![allow(clippy::float_arithmetic, reason = "sizes of cells choose words, of which all give exact points")]

use super::sample::{Sample, base};
use super::{CellKind, End, Shape};
use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Longest words.
const MAX_LETTERS: usize = 64;
/// Letters of the words whose points tell the size of a cell.
const LOOK: usize = 2;
/// Sizes that differ by less than this part count as one.
const SAME: f64 = 1e-6;

/// A cell that may be divided: its size, and its number, the smallest first among those of one size.
#[derive(PartialEq)]
struct Size(f64, usize);

impl Eq for Size {}

impl Ord for Size {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Size {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

type Floats = Vec<Vec<f64>>;

/// The tree of the words that are drawn.
struct Node {
    state: usize,
    letters: usize,
    map: Floats,
    size: f64,
    /// The first of its pieces, where it is divided.
    pieces: Option<usize>,
}

/// Points of a curve or a set in at most `most` cells, none of which is much larger than another: of a curve the ends of its
/// cells, of a set the point with the address `(0)` in each.
///
/// Returns `None` where a point is not unique (the system does not contract), and for shapes with faces.
///
/// # Cost
/// Two products of matrices for each cell.
#[must_use]
pub fn adaptive_sample(shape: &Shape, most: usize) -> Option<Sample> {
    if shape.reachable().iter().any(|e| shape.states[*e].kind == CellKind::Face) {
        return None;
    }
    let seeds = seeds(shape)?;
    let nodes = divided(shape, &seeds, most);
    let view = shape.control.clone().unwrap_or_else(|| Matrix::identity(shape.states[shape.start].dim));
    let mut walk = Walk { shape, nodes: &nodes, seeds: &seeds, found: Sample::default() };
    walk.visit(0, &view, (Rational::from(0), Rational::from(1)), false);
    Some(walk.found)
}

/// The points of each state from which everything is drawn.
fn seeds(shape: &Shape) -> Option<Vec<Vec<Vec<Rational>>>> {
    let mut all = vec![Vec::new(); shape.states.len()];
    for e in shape.reachable() {
        all[e] = if shape.states[e].kind == CellKind::Edge {
            vec![shape.end_point(e, End::Start)?, shape.end_point(e, End::Finish)?]
        } else {
            vec![base(shape, e)?]
        };
    }
    Some(all)
}

fn floats(m: &Matrix) -> Floats {
    (0..m.rows()).map(|i| m.row(i).iter().map(to_f64).collect()).collect()
}

fn product(a: &Floats, b: &Floats) -> Floats {
    let width = b.first().map_or(0, Vec::len);
    let entry = |row: &[f64], j: usize| row.iter().zip(b).map(|(x, other)| x * other[j]).sum();
    a.iter().map(|row| (0..width).map(|j| entry(row, j)).collect()).collect()
}

/// Divides the largest cell, and those of its size, as long as there are not too many.
fn divided(shape: &Shape, seeds: &[Vec<Vec<Rational>>], most: usize) -> Vec<Node> {
    let ops: Vec<Vec<Floats>> = shape.states.iter().map(|s| s.pieces.iter().map(|p| floats(&p.op)).collect()).collect();
    let looks: Vec<Floats> = (0..shape.states.len()).map(|e| look(shape, &ops, seeds, e, LOOK)).collect();
    let size = |state: usize, map: &Floats| {
        let seen: Floats = looks[state].iter().map(|p| map.iter().map(|row| dot(row, p)).collect()).collect();
        extent(&seen)
    };
    let map = shape.control.as_ref().map_or_else(|| identity(shape.states[shape.start].dim), floats);
    let first = size(shape.start, &map);
    let mut nodes = vec![Node { state: shape.start, letters: 0, map, size: first, pieces: None }];
    let mut heap = BinaryHeap::from([Size(first, 0)]);
    let mut leaves = 1;
    while let Some(Size(largest, _)) = heap.peek() {
        // Cells of one size are divided together or not at all, so that equal pieces stay equal.
        let bound = largest * (1.0 - SAME);
        let mut group = Vec::new();
        while heap.peek().is_some_and(|s| s.0 >= bound) {
            group.extend(heap.pop().map(|s| s.1));
        }
        let more: usize = group.iter().map(|k| shape.states[nodes[*k].state].pieces.len().saturating_sub(1)).sum();
        if leaves + more > most || bound <= 0.0 {
            break;
        }
        leaves += more;
        for k in group {
            if nodes[k].letters == MAX_LETTERS {
                continue;
            }
            nodes[k].pieces = Some(nodes.len());
            for (letter, piece) in shape.states[nodes[k].state].pieces.iter().enumerate() {
                let map = product(&nodes[k].map, &ops[nodes[k].state][letter]);
                // A cell is never larger than the one that holds it.
                let own = size(piece.target, &map).min(nodes[k].size);
                heap.push(Size(own, nodes.len()));
                nodes.push(Node { state: piece.target, letters: nodes[k].letters + 1, map, size: own, pieces: None });
            }
            nodes[k].map = Vec::new();
        }
    }
    nodes
}

/// Some points of the attractor of a state.
fn look(shape: &Shape, ops: &[Vec<Floats>], seeds: &[Vec<Vec<Rational>>], state: usize, letters: usize) -> Floats {
    let mut points: Floats = seeds[state].iter().map(|p| p.iter().map(to_f64).collect()).collect();
    if letters > 0 {
        for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
            let inner = look(shape, ops, seeds, piece.target, letters - 1);
            points.extend(inner.iter().map(|p| ops[state][letter].iter().map(|row| dot(row, p)).collect()));
        }
    }
    points
}

fn identity(n: usize) -> Floats {
    (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn extent(points: &Floats) -> f64 {
    let width = points.first().map_or(0, Vec::len);
    let span = |k: usize| {
        let (lo, hi) =
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| (lo.min(p[k]), hi.max(p[k])));
        hi - lo
    };
    (0..width).map(span).fold(0.0, |a, b| if b > a { b } else { a })
}

struct Walk<'a> {
    shape: &'a Shape,
    nodes: &'a [Node],
    seeds: &'a [Vec<Vec<Rational>>],
    found: Sample,
}

impl Walk<'_> {
    /// The points of a cell, whose addresses fill an interval, which is run backwards where `back`.
    fn visit(&mut self, k: usize, map: &Matrix, (from, to): (Rational, Rational), back: bool) {
        let (shape, node) = (self.shape, &self.nodes[k]);
        let length = &to - &from;
        let Some(first) = node.pieces else {
            let points: Vec<Vec<Rational>> = self.seeds[node.state].iter().map(|p| map.apply(p)).collect();
            let ends = [from, to];
            let order: Vec<usize> = if back { (0..points.len()).rev().collect() } else { (0..points.len()).collect() };
            for (place, at) in order.into_iter().enumerate() {
                if self.found.points.last() != Some(&points[at]) {
                    self.found.points.push(points[at].clone());
                    self.found.parameters.push(ends[place.min(1)].clone());
                }
            }
            return;
        };
        let pieces = &shape.states[node.state].pieces;
        let count = pieces.len();
        for place in 0..count {
            let letter = if back { count - 1 - place } else { place };
            let at = |n: usize| &from + &length * Rational::from(n as u64) / Rational::from(count as u64);
            let inside = (at(place), if place + 1 == count { to.clone() } else { at(place + 1) });
            self.visit(first + letter, &(map * &pieces[letter].op), inside, back != pieces[letter].reversed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::scheme::{bezier, dragon, fern, koch};
    use crate::shape::{Complex, sample};

    #[test]
    fn similar_pieces_of_one_size_give_the_words_of_one_length() {
        for (shape, depth) in [(dragon().expect("a curve"), 6), (koch(4).expect("a curve"), 3)] {
            let uniform = sample(&Complex::of_curves(shape.clone()), depth, &mut |_| ()).expect("points");
            let found = adaptive_sample(&shape, 64).expect("points");
            assert_eq!(found.points, uniform.points);
            assert_eq!(found.parameters, uniform.parameters);
        }
    }

    #[test]
    fn unequal_pieces_give_cells_of_one_size() {
        let shape = bezier(2, &ratio(1, 10)).expect("a curve");
        let found = adaptive_sample(&shape, 300).expect("points");
        let steps = |points: &[Vec<Rational>]| {
            let step = |w: &[Vec<Rational>]| {
                let gaps = w[0].iter().zip(&w[1]).map(|(a, b)| to_f64(&(a - b)).abs());
                gaps.fold(0.0, f64::max)
            };
            let all: Vec<f64> = points.windows(2).map(step).collect();
            all.iter().copied().fold(0.0, f64::max) * all.len() as f64
        };
        let uniform = sample(&Complex::of_curves(shape), 8, &mut |_| ()).expect("points");
        assert!(3.0 * steps(&found.points) < steps(&uniform.points), "{} points", found.points.len());
        assert!(found.parameters.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn the_fern_has_points_up_to_its_tip() {
        let shape = fern().expect("a set");
        let found = adaptive_sample(&shape, 5_000).expect("points");
        let top = found.points.iter().filter(|p| p[1] > ratio(9, 1)).count();
        assert!(found.points.len() > 2_500 && top > 100, "{} of {}", top, found.points.len());
        // Points of the attractor: the second map takes them to others of it, below its tip.
        assert!(found.points.iter().all(|p| p[1] >= 0 && p[1] < ratio(10, 1)));
    }
}
