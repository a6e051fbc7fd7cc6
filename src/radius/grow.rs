//! Growing an invariant polytope in floats.
#![allow(clippy::float_arithmetic, reason = "proposes a polytope, exact arithmetic checks it")]

use super::System;
use super::float::Floats;
use super::simplex::{Body, Combination, gauge};

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
}

/// What is grown, and how far.
pub(super) struct Task<'a> {
    pub system: &'a System,
    /// The matrices divided by the radius.
    pub scaled: &'a [Floats],
    pub body: Body,
    pub seeds: Vec<Vertex>,
    pub max_vertices: usize,
    /// Images with a gauge up to `1 + tolerance` count as inside.
    pub tolerance: f64,
}

/// Applies all arrows to all vertices until nothing new comes out, or the limit is reached.
pub(super) fn grow(task: &Task) -> Grown {
    let mut grown = Grown {
        body: task.body,
        vertices: task.seeds.clone(),
        inside: Vec::new(),
        excess: 0.0,
        better: None,
    };
    let mut next = 0;
    while next < grown.vertices.len() && grown.better.is_none() {
        let state = grown.vertices[next].state;
        for arrow in (0..task.scaled.len()).filter(|&a| task.system.arrows[a].to == state) {
            follow(task, &mut grown, next, arrow);
        }
        next += 1;
    }
    grown
}

fn follow(task: &Task, grown: &mut Grown, vertex: usize, arrow: usize) {
    if grown.vertices.iter().any(|v| v.origin == Origin::Image { parent: vertex, arrow }) {
        return;
    }
    let state = task.system.arrows[arrow].from;
    let point = task.scaled[arrow].apply(&grown.vertices[vertex].point);
    let (indices, points): (Vec<usize>, Vec<&[f64]>) = grown
        .vertices
        .iter()
        .enumerate()
        .filter(|(_, v)| v.state == state)
        .map(|(k, v)| (k, v.point.as_slice()))
        .unzip();
    let mut combination = gauge(task.body, &points, &point, 1.0 - 1e-4);
    for term in &mut combination.terms {
        term.0 = indices[term.0];
    }
    if combination.value <= 1.0 + task.tolerance {
        grown.inside.push(Inside { vertex, arrow, combination });
    } else if grown.vertices.len() < task.max_vertices {
        let origin = Origin::Image { parent: vertex, arrow };
        grown.vertices.push(Vertex { state, origin, point });
        grown.better = faster(task, grown);
    } else {
        grown.excess = grown.excess.max(combination.value);
        grown.inside.push(Inside { vertex, arrow, combination });
    }
}

/// A closed part of the path to the newest vertex whose product has a spectral radius above 1.
fn faster(task: &Task, grown: &Grown) -> Option<Vec<usize>> {
    let mut current = grown.vertices.len() - 1;
    let end = grown.vertices[current].state;
    let mut path = Vec::new();
    let mut product: Option<Floats> = None;
    while let Origin::Image { parent, arrow } = grown.vertices[current].origin {
        path.push(arrow);
        product = Some(match product {
            None => task.scaled[arrow].clone(),
            Some(p) => p.times(&task.scaled[arrow]),
        });
        current = parent;
        if path.len() > 40 {
            break;
        }
        if let Some(p) = &product
            && grown.vertices[current].state == end
            && p.norm() > 1.0
            && p.radius() > 1.0 + 1e-9
        {
            return Some(path);
        }
    }
    None
}

/// For every state the axes along which the vertices do not reach (symmetric: a complement of their span).
pub(super) fn missing_axes(system: &System, grown: &Grown) -> Vec<(usize, usize)> {
    let mut missing = Vec::new();
    for (state, &dim) in system.dims.iter().enumerate() {
        let points: Vec<&[f64]> =
            grown.vertices.iter().filter(|v| v.state == state).map(|v| v.point.as_slice()).collect();
        match grown.body {
            Body::Monotone => {
                let reached = |axis: usize| points.iter().any(|p| p[axis] > 1e-9);
                missing.extend((0..dim).filter(|&a| !reached(a)).map(|a| (state, a)));
            }
            Body::Symmetric => missing.extend(uncovered(&points, dim).into_iter().map(|a| (state, a))),
        }
    }
    missing
}

/// Axes that complete the points to a spanning set (Gram–Schmidt on the points, then on the axes).
fn uncovered(points: &[&[f64]], dim: usize) -> Vec<usize> {
    let mut frame: Vec<Vec<f64>> = Vec::new();
    let mut absorb = |v: &[f64], threshold: f64| {
        let mut rest = v.to_vec();
        for _ in 0..2 {
            for f in &frame {
                let c = super::float::dot(f, &rest);
                rest.iter_mut().zip(f).for_each(|(r, x)| *r -= c * x);
            }
        }
        let norm = super::float::dot(&rest, &rest).sqrt();
        let grows = norm > threshold;
        if grows {
            frame.push(rest.iter().map(|x| x / norm).collect());
        }
        grows
    };
    for p in points {
        absorb(p, 1e-7 * super::float::dot(p, p).sqrt().max(1e-300));
    }
    (0..dim)
        .filter(|&axis| {
            let unit: Vec<f64> = (0..dim).map(|k| if k == axis { 1.0 } else { 0.0 }).collect();
            absorb(&unit, 1e-6)
        })
        .collect()
}
