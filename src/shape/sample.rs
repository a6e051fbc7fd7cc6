//! Exact points of an attractor to a given depth, and at random addresses.

use super::{Address, CellKind, Complex, End, Face, Layout, Shape, State};
use crate::arith::Rational;
use crate::linalg::Matrix;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Most points of a sample.
pub const MAX_SAMPLES: usize = 1 << 20;
/// Letters of a random address.
const RANDOM_LETTERS: usize = 24;

/// Exact points of the attractor of the start state.
#[derive(Debug, Clone, Default)]
pub struct Sample {
    /// The points, in the space of the control points (without them: barycentric); of a curve in its order.
    pub points: Vec<Vec<Rational>>,
    /// The address of each point as a number in `[0, 1]`: of a curve with pieces of equal length, its parameter.
    pub parameters: Vec<Rational>,
    /// Polygons of a surface: their corners, anticlockwise in the first face, and their address as a number.
    pub faces: Vec<(Vec<usize>, Rational)>,
}

#[derive(Default)]
struct Part {
    points: Vec<Vec<Rational>>,
    parameters: Vec<Rational>,
    faces: Vec<(Vec<usize>, Rational)>,
}

/// The deterministic algorithm: the images of a few points of each state under all words of `depth` letters. The points are
/// exact points of the attractor: of a curve its end points, of a face its corners, of a set the point of address `(0)`.
///
/// Returns `None` where a point is not unique (the system does not contract), or where there are more than [`MAX_SAMPLES`].
///
/// # Cost
/// One product of an operator and a vector for each point and level; `progress` is told the number of points of each level.
#[must_use]
pub fn sample(complex: &Complex, depth: usize, progress: &mut dyn FnMut(usize)) -> Option<Sample> {
    let mut sampler = Sampler { complex, known: BTreeMap::new(), progress };
    let part = sampler.part(complex.shape.start, depth)?;
    let view = complex.shape.control.as_ref();
    let seen = |p: &Vec<Rational>| view.map_or_else(|| p.clone(), |c| c.apply(p));
    Some(Sample {
        points: part.points.iter().map(seen).collect(),
        parameters: part.parameters.clone(),
        faces: part.faces.clone(),
    })
}

/// The largest depth, from 1 to 24, with at most `cells` words.
#[must_use]
pub fn depth_within(shape: &Shape, cells: usize) -> usize {
    let divided = shape.states.iter().any(|s| s.pieces.len() > 1);
    let mut depth = 0;
    while divided && depth < 24 && words_of_length(shape, depth + 1) <= cells {
        depth += 1;
    }
    depth.max(1)
}

/// The number of words of a length from the start, or the largest number there is.
#[must_use]
pub fn words_of_length(shape: &Shape, length: usize) -> usize {
    let mut counts = vec![1usize; shape.states.len()];
    for _ in 0..length {
        let next = |s: &super::State| s.pieces.iter().fold(0usize, |n, p| n.saturating_add(counts[p.target]));
        counts = shape.states.iter().map(next).collect();
    }
    counts[shape.start]
}

/// The chaos game, made exact: `count` points with random addresses, in the order drawn. `next(n)` draws from `0 … n−1` with
/// the given weights; the point behind the random letters is that of address `(0)`.
///
/// Returns `None` where a point is not unique.
#[must_use]
pub fn random_sample(
    shape: &Shape,
    count: usize,
    next: &mut dyn FnMut(usize) -> usize,
    progress: &mut dyn FnMut(usize),
) -> Option<Sample> {
    let mut found = Sample::default();
    let mut bases: BTreeMap<usize, Vec<Rational>> = BTreeMap::new();
    for _ in 0..count {
        let mut path = vec![(shape.start, 0)];
        let mut at = shape.start;
        for _ in 0..RANDOM_LETTERS {
            let letter = next(at);
            path.push((at, letter));
            at = shape.states[at].pieces.get(letter)?.target;
        }
        if let std::collections::btree_map::Entry::Vacant(slot) = bases.entry(at) {
            slot.insert(base(shape, at)?);
        }
        let (mut point, mut parameter) = (bases[&at].clone(), Rational::from(0));
        for (state, letter) in path.into_iter().skip(1).rev() {
            point = shape.states[state].pieces[letter].op.apply(&point);
            parameter = placed(&parameter, letter, &shape.states[state]);
        }
        found.points.push(shape.control.as_ref().map_or_else(|| point.clone(), |c| c.apply(&point)));
        found.parameters.push(parameter);
        progress(1);
    }
    Some(found)
}

pub(super) fn base(shape: &Shape, state: usize) -> Option<Vec<Rational>> {
    shape.point(state, &Address::periodic(vec![0]).normalise(shape, state).ok()?)
}

/// The address behind one more letter in front.
fn placed(parameter: &Rational, letter: usize, state: &State) -> Rational {
    let inside = if state.pieces[letter].reversed { Rational::from(1) - parameter } else { parameter.clone() };
    state.before(letter) + inside * state.share(letter)
}

struct Sampler<'a> {
    complex: &'a Complex,
    known: BTreeMap<(usize, usize), Rc<Part>>,
    progress: &'a mut dyn FnMut(usize),
}

impl Sampler<'_> {
    fn part(&mut self, state: usize, depth: usize) -> Option<Rc<Part>> {
        if let Some(part) = self.known.get(&(state, depth)) {
            return Some(Rc::clone(part));
        }
        let part = if depth == 0 { self.seed(state)? } else { self.divided(state, depth)? };
        (self.progress)(part.points.len());
        let part = Rc::new(part);
        self.known.insert((state, depth), Rc::clone(&part));
        Some(part)
    }

    /// The points of a state from which everything is drawn.
    fn seed(&self, state: usize) -> Option<Part> {
        let shape = &self.complex.shape;
        let (zero, one) = (Rational::from(0), Rational::from(1));
        if shape.states[state].kind == CellKind::Edge {
            let points = vec![shape.end_point(state, End::Start)?, shape.end_point(state, End::Finish)?];
            return Some(Part { points, parameters: vec![zero, one], faces: Vec::new() });
        }
        if let Some(face) = self.complex.faces.get(&state) {
            let points = corners(shape, face)?;
            let faces = vec![((0..points.len()).collect(), zero.clone())];
            return Some(Part { parameters: vec![zero; points.len()], points, faces });
        }
        if self.reaches_faces(state) {
            return Some(Part::default());
        }
        Some(Part { points: vec![base(shape, state)?], parameters: vec![zero], faces: Vec::new() })
    }

    /// Whether a set is a union of faces (the disc around a vertex); such a set is drawn by them alone.
    fn reaches_faces(&self, state: usize) -> bool {
        let pieces = &self.complex.shape.states[state].pieces;
        pieces.iter().any(|p| p.target != state && self.complex.faces.contains_key(&p.target))
    }

    fn divided(&mut self, state: usize, depth: usize) -> Option<Part> {
        let complex = self.complex;
        let pieces = &complex.shape.states[state].pieces;
        let is_curve = complex.shape.states[state].kind == CellKind::Edge;
        let face = complex.faces.get(&state);
        let mut whole = Part::default();
        for (letter, piece) in pieces.iter().enumerate() {
            let inner = self.part(piece.target, depth - 1)?;
            if whole.points.len() + inner.points.len() > MAX_SAMPLES {
                return None;
            }
            let first = whole.points.len();
            let mut images = image(&piece.op, &inner.points);
            let place = |t: &Rational| placed(t, letter, &complex.shape.states[state]);
            let mut parameters: Vec<Rational> = inner.parameters.iter().map(place).collect();
            if is_curve {
                if piece.reversed {
                    images.reverse();
                    parameters.reverse();
                }
                // Neighbouring pieces share a point.
                let skip = usize::from(whole.points.last().is_some_and(|p| images.first() == Some(p)));
                whole.points.extend(images.into_iter().skip(skip));
                whole.parameters.extend(parameters.into_iter().skip(skip));
                continue;
            }
            let turned = face.and_then(|f| f.placement.get(letter)).is_some_and(|p| mirrored(p));
            for (corners, t) in &inner.faces {
                let mut corners: Vec<usize> = corners.iter().map(|k| k + first).collect();
                if turned {
                    corners.reverse();
                }
                whole.faces.push((corners, place(t)));
            }
            whole.points.extend(images);
            whole.parameters.extend(parameters);
        }
        Some(if whole.faces.is_empty() { whole } else { whole.joined() })
    }
}

fn image(op: &Matrix, points: &[Vec<Rational>]) -> Vec<Vec<Rational>> {
    points.iter().map(|p| op.apply(p)).collect()
}

/// Whether an order of corners runs against the sense of rotation.
fn mirrored(order: &[usize]) -> bool {
    order.len() > 2 && (order[1] + order.len() - order[0]) % order.len() != 1
}

impl Part {
    /// Points that coincide exactly become one.
    fn joined(self) -> Self {
        let mut index: BTreeMap<Vec<Rational>, usize> = BTreeMap::new();
        let mut new = Self::default();
        let mut names = Vec::with_capacity(self.points.len());
        for (point, parameter) in self.points.into_iter().zip(self.parameters) {
            let next = new.points.len();
            let name = *index.entry(point.clone()).or_insert(next);
            if name == next {
                new.points.push(point);
                new.parameters.push(parameter);
            }
            names.push(name);
        }
        new.faces = self.faces.into_iter().map(|(c, t)| (c.into_iter().map(|k| names[k]).collect(), t)).collect();
        new
    }
}

/// The corners of a face: the ends of its sides.
fn corners(shape: &Shape, face: &Face) -> Option<Vec<Vec<Rational>>> {
    let at = |side: usize, end: End| Some(face.sides[side].op.apply(&shape.end_point(face.sides[side].edge, end)?));
    match face.layout {
        Layout::Quad { .. } => [(0, End::Start), (0, End::Finish), (2, End::Finish), (2, End::Start)]
            .map(|(s, e)| at(s, e))
            .into_iter()
            .collect(),
        Layout::Triangle => {
            [(0, End::Start), (0, End::Finish), (1, End::Finish)].map(|(s, e)| at(s, e)).into_iter().collect()
        }
    }
}
