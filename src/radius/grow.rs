//! Growing an invariant polytope in floats.
#![allow(clippy::float_arithmetic, reason = "proposes a polytope, exact arithmetic checks it")]

use super::System;
use super::budget::Budget;
use super::float::Floats;
use super::simplex::{Body, Combination, Hull, gauge};
use crate::arith::Rational;
use crate::linalg::Entry;

/// Where a vertex comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// A leading eigenvector, by number.
    Root(usize),
    /// The image of an earlier vertex, divided by the radius.
    Image {
        /// The earlier vertex.
        parent: usize,
        /// The arrow applied.
        arrow: usize,
    },
    /// A point put in to give the polytope an interior: `factor * e_axis`.
    Axis {
        /// The coordinate.
        axis: usize,
        /// The exponent `k` of the length `2^-k`.
        exponent: u32,
    },
    /// A point put in: about an eigenvector of a word that grows nearly as fast.
    Free(Vec<Rational>),
}

#[derive(Debug, Clone)]
pub(super) struct Vertex {
    pub state: usize,
    pub origin: Origin,
    pub point: Vec<f64>,
}

/// An image that was found inside.
#[derive(Debug, Clone)]
pub(super) struct Inside {
    pub vertex: usize,
    pub arrow: usize,
    pub combination: Combination,
}

#[derive(Debug, Clone)]
pub(super) struct Grown {
    pub body: Body,
    pub vertices: Vec<Vertex>,
    pub inside: Vec<Inside>,
    /// The largest gauge of an image that was not followed; at most 1 when the polytope closed.
    pub excess: f64,
    /// A cyclic path that grows faster than the radius assumed.
    pub better: Option<Vec<usize>>,
    /// Whether the budget ended before all images were looked at: nothing is proved.
    pub cut: bool,
}

/// What is grown, and how far.
pub(super) struct Task<'a, E = Rational> {
    pub system: &'a System<E>,
    /// The matrices divided by the radius.
    pub scaled: &'a [Floats],
    pub body: Body,
    pub seeds: Vec<Vertex>,
    pub max_vertices: usize,
    /// Images with a gauge up to `1 + tolerance` count as inside.
    pub tolerance: f64,
    /// Longest word that is looked at as a better one.
    pub longest: usize,
    pub budget: &'a Budget<'a>,
}

/// An image of the last generation, with its gauge when it was looked at first.
struct Image {
    vertex: usize,
    arrow: usize,
    point: Vec<f64>,
    combination: Combination,
}

/// Applies all arrows to all vertices until nothing new comes out, or a limit is reached. Of every generation the images that
/// stick out farthest become vertices first; they often cover others.
pub(super) fn grow<E: Entry>(task: &Task<E>) -> Grown {
    let mut growing = Growing {
        task,
        points: task.system.dims.iter().map(|d| Points { hull: Hull::new(*d), vertices: Vec::new() }).collect(),
        grown: Grown {
            body: task.body,
            vertices: Vec::new(),
            inside: Vec::new(),
            excess: 0.0,
            better: None,
            cut: false,
        },
    };
    for seed in &task.seeds {
        growing.push(seed.clone());
    }
    let mut generation = 0..growing.grown.vertices.len();
    while !generation.is_empty() {
        let next = growing.grown.vertices.len();
        if !growing.generation(generation) {
            break;
        }
        generation = next..growing.grown.vertices.len();
    }
    growing.grown
}

/// The points of a state and the vertices they are.
struct Points {
    hull: Hull,
    vertices: Vec<usize>,
}

struct Growing<'a, E> {
    task: &'a Task<'a, E>,
    points: Vec<Points>,
    grown: Grown,
}

impl<E: Entry> Growing<'_, E> {
    fn push(&mut self, vertex: Vertex) {
        let own = &mut self.points[vertex.state];
        own.hull.push(&vertex.point);
        own.vertices.push(self.grown.vertices.len());
        self.grown.vertices.push(vertex);
    }

    /// Looks at the images of some vertices; false where the search ends.
    fn generation(&mut self, vertices: std::ops::Range<usize>) -> bool {
        let mut out: Vec<Image> = Vec::new();
        for vertex in vertices {
            let state = self.grown.vertices[vertex].state;
            for arrow in (0..self.task.scaled.len()).filter(|&a| self.task.system.arrows[a].to == state) {
                let point = self.task.scaled[arrow].apply(&self.grown.vertices[vertex].point);
                let Some(combination) = self.gauge(arrow, &point) else { return false };
                let image = Image { vertex, arrow, point, combination };
                if image.combination.value <= 1.0 + self.task.tolerance {
                    self.inside(image);
                } else {
                    out.push(image);
                }
            }
        }
        out.sort_by(|a, b| {
            b.combination.value.total_cmp(&a.combination.value).then((a.vertex, a.arrow).cmp(&(b.vertex, b.arrow)))
        });
        for mut image in out {
            let Some(again) = self.gauge(image.arrow, &image.point) else { return false };
            image.combination = again;
            if image.combination.value <= 1.0 + self.task.tolerance {
                self.inside(image);
            } else if self.grown.vertices.len() < self.task.max_vertices {
                let state = self.task.system.arrows[image.arrow].from;
                let origin = Origin::Image { parent: image.vertex, arrow: image.arrow };
                self.push(Vertex { state, origin, point: image.point });
                self.grown.better = self.faster();
                if self.grown.better.is_some() {
                    return false;
                }
            } else {
                self.grown.excess = self.grown.excess.max(image.combination.value);
                self.inside(image);
            }
        }
        true
    }

    fn inside(&mut self, image: Image) {
        self.grown.inside.push(Inside { vertex: image.vertex, arrow: image.arrow, combination: image.combination });
    }

    /// The gauge in the hull of the points of the arrow's state; `None` (and a cut) where the budget ends.
    fn gauge(&mut self, arrow: usize, point: &[f64]) -> Option<Combination> {
        let own = &self.points[self.task.system.arrows[arrow].from];
        let full = self.grown.vertices.len() >= self.task.max_vertices;
        let beyond = if full { f64::INFINITY } else { 1.0 + self.task.tolerance + 1e-12 };
        let (mut combination, work) = gauge(self.task.body, &own.hull, point, 1.0 - 1e-4, beyond);
        for term in &mut combination.terms {
            term.0 = own.vertices[term.0];
        }
        if self.task.budget.spend(work) {
            return Some(combination);
        }
        self.grown.cut = true;
        None
    }

    /// A closed part of the path to the newest vertex whose product has a spectral radius above 1.
    fn faster(&self) -> Option<Vec<usize>> {
        let vertices = &self.grown.vertices;
        let mut current = vertices.len() - 1;
        let end = vertices[current].state;
        let mut path = Vec::new();
        let mut product: Option<Floats> = None;
        while let Origin::Image { parent, arrow } = vertices[current].origin {
            path.push(arrow);
            let next = match product {
                None => self.task.scaled[arrow].clone(),
                Some(p) => p.times(&self.task.scaled[arrow]),
            };
            current = parent;
            let closed = vertices[current].state == end;
            if path.len() > self.task.longest || !self.task.budget.spend(next.cube()) {
                break;
            }
            if closed && next.norm() > 1.0 && next.exceeds_one() {
                return Some(path);
            }
            product = Some(next);
        }
        None
    }
}

/// For every state the axes along which the vertices do not reach by `threshold` of their size (symmetric: a complement of
/// what they span by that much).
pub(super) fn missing_axes<E: Entry>(system: &System<E>, grown: &Grown, threshold: f64) -> Vec<(usize, usize)> {
    let mut missing = Vec::new();
    for (state, &dim) in system.dims.iter().enumerate() {
        let points = || grown.vertices.iter().filter(|v| v.state == state).map(|v| v.point.as_slice());
        match grown.body {
            Body::Monotone => {
                let reached = |axis: usize| points().any(|p| p[axis] > 1e-9);
                missing.extend((0..dim).filter(|&a| !reached(a)).map(|a| (state, a)));
            }
            Body::Symmetric => {
                missing
                    .extend(uncovered(points().map(<[f64]>::to_vec), dim, threshold).into_iter().map(|a| (state, a)));
            }
        }
    }
    missing
}

/// Axes that complete the directions in which points are wide (Gram–Schmidt, the widest first, then the axes).
fn uncovered(points: impl Iterator<Item = Vec<f64>>, dim: usize, threshold: f64) -> Vec<usize> {
    let size = |v: &[f64]| super::float::dot(v, v).sqrt();
    let mut rest: Vec<Vec<f64>> = points.collect();
    let largest = rest.iter().map(|v| size(v)).fold(0.0, f64::max);
    let mut frame: Vec<Vec<f64>> = Vec::new();
    let remove = |v: &mut [f64], f: &[f64]| {
        let c = super::float::dot(f, v);
        v.iter_mut().zip(f).for_each(|(x, y)| *x -= c * y);
    };
    while frame.len() < dim {
        let Some(top) = rest.iter().max_by(|a, b| size(a).total_cmp(&size(b))).cloned() else { break };
        let norm = size(&top);
        if norm <= threshold * largest {
            break;
        }
        let unit: Vec<f64> = top.iter().map(|x| x / norm).collect();
        rest.iter_mut().for_each(|v| remove(v, &unit));
        frame.push(unit);
    }
    let mut missing = Vec::new();
    // The axes farthest from what is covered, one after the other.
    while frame.len() < dim {
        let axis = |k: usize| {
            let mut unit: Vec<f64> = (0..dim).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
            frame.iter().for_each(|f| remove(&mut unit, f));
            unit
        };
        let open = (0..dim).filter(|k| !missing.contains(k)).map(|k| (k, axis(k)));
        let Some((k, unit)) = open.max_by(|a, b| size(&a.1).total_cmp(&size(&b.1)).then(b.0.cmp(&a.0))) else { break };
        let norm = size(&unit);
        missing.push(k);
        frame.push(unit.iter().map(|x| x / norm).collect());
    }
    missing.sort_unstable();
    missing
}

/// As many points of a state as it has dimensions, chosen to be as independent as possible.
pub(super) fn spread(grown: &Grown, state: usize, dim: usize) -> Vec<usize> {
    let mut rest: Vec<(usize, Vec<f64>)> = grown
        .vertices
        .iter()
        .enumerate()
        .filter(|(_, v)| v.state == state)
        .map(|(k, v)| (k, v.point.clone()))
        .collect();
    let size = |v: &[f64]| super::float::dot(v, v);
    let mut chosen = Vec::new();
    while chosen.len() < dim {
        let Some((k, top)) = rest.iter().max_by(|a, b| size(&a.1).total_cmp(&size(&b.1))).cloned() else { break };
        chosen.push(k);
        let norm = size(&top);
        for (_, v) in &mut rest {
            let c = if norm > 0.0 { super::float::dot(v, &top) / norm } else { 0.0 };
            v.iter_mut().zip(&top).for_each(|(x, t)| *x -= c * t);
        }
        rest.retain(|(j, _)| *j != k);
    }
    chosen
}
