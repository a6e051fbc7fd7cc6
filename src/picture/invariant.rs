//! Pictures of invariant polytopes in the plane.

use super::svg::Canvas;
use crate::algebraic::nearest;
use crate::arith::to_f64;
use crate::linalg::Entry;
use crate::radius::{Body, JointRadius, Polytope, Proof, System};

/// The invariant polytope of the first state of two dimensions, with its points and their images divided by the bound; `None`
/// where no polytope in a plane was used.
#[must_use]
pub fn polytope<E: Entry>(radius: &JointRadius<E>) -> Option<String> {
    let (proof, state, bound) = radius.blocks.iter().find_map(|b| {
        let Some(Proof::Polytope(p)) = &b.proof else { return None };
        let state = b.block.system.dims.iter().position(|d| *d == 2)?;
        Some(((p, &b.block.system), state, to_f64(b.bound.as_ref()?)))
    })?;
    let (polytope, system) = proof;
    let corners = outline(polytope, state);
    let images = images(polytope, system, state, bound);
    let own: Vec<[f64; 2]> = points(polytope, state);
    let mut all = corners.clone();
    all.push([0.0, 0.0]);
    if !all.iter().flatten().all(|x| x.is_finite()) || corners.len() < 2 {
        return None;
    }
    let mut canvas = Canvas::around(&all, "invariant polytope");
    let mut closed = corners.clone();
    closed.push(corners[0]);
    canvas.curve(&closed);
    canvas.polygon(&own);
    canvas.cloud(&images);
    Some(canvas.svg())
}

fn points<E: Entry>(polytope: &Polytope<E>, state: usize) -> Vec<[f64; 2]> {
    let here = polytope.points.iter().filter(|p| p.state == state);
    here.map(|p| [nearest(&p.coordinates[0]), nearest(&p.coordinates[1])]).collect()
}

/// The corners of the body, in order.
fn outline<E: Entry>(polytope: &Polytope<E>, state: usize) -> Vec<[f64; 2]> {
    let mut all = points(polytope, state);
    match polytope.body {
        Body::Symmetric => {
            let opposite: Vec<[f64; 2]> = all.iter().map(|p| [-p[0], -p[1]]).collect();
            all.extend(opposite);
        }
        Body::Monotone => {
            let below: Vec<[f64; 2]> = all.iter().flat_map(|p| [[p[0], 0.0], [0.0, p[1]]]).collect();
            all.extend(below);
            all.push([0.0, 0.0]);
        }
    }
    hull(all)
}

/// The images of the points under all arrows into the state, divided by the bound.
fn images<E: Entry>(polytope: &Polytope<E>, system: &System<E>, state: usize, bound: f64) -> Vec<[f64; 2]> {
    let mut out = Vec::new();
    for arrow in system.arrows.iter().filter(|a| a.from == state) {
        for p in polytope.points.iter().filter(|p| p.state == arrow.to) {
            let image = arrow.matrix.apply(&p.coordinates);
            out.push([nearest(&image[0]) / bound, nearest(&image[1]) / bound]);
        }
    }
    out
}

/// The convex hull, counter-clockwise (Andrew's chains).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while out.len() >= 2 && turn(out[out.len() - 2], out[out.len() - 1], p) <= 0.0 {
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}
