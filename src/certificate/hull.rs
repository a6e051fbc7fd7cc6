//! Convex hulls that hold the attractors, with the coefficients that show it.

use super::written::{Written, values};
use super::{Unsupported, number, unsupported};
use crate::linalg::Matrix;
use crate::shape::{Polytopes, Shape, Weights};
use serde_json::{Value, json};

/// The vertices of the hull of a state, and the images of the hulls of its pieces as convex combinations.
pub fn hull<E: Written>(shape: &Shape<E>, state: usize, hulls: &[Vec<Vec<E>>]) -> Result<Value, Unsupported> {
    let vertices = &hulls[state];
    let mut images = Vec::new();
    for piece in &shape.states[state].pieces {
        let combinations = hulls[piece.target].iter().map(|v| combination(vertices, &piece.op.apply(v)));
        let Some(combinations) = combinations.collect::<Option<Vec<Value>>>() else {
            return unsupported("a hull that is not mapped into itself", shape.states[state].name.clone());
        };
        images.push(Value::Array(combinations));
    }
    let points: Vec<Value> = vertices.iter().map(|v| values(v)).collect();
    Ok(json!({"points": points, "images": images}))
}

/// The polytope of a state that proves contraction, in the same form.
pub fn polytope(proof: &Polytopes, state: usize) -> Value {
    with_weights(&proof.vertices[state], &proof.weights[state])
}

/// Vertices of a state with the combinations of the images under its pieces.
pub fn with_weights<E: Written>(vertices: &[Vec<E>], weights: &[Vec<Weights>]) -> Value {
    let points: Vec<Value> = vertices.iter().map(|v| values(v)).collect();
    let terms = |weights: &Weights| -> Value {
        weights.iter().map(|(k, w)| json!({"vertex": k, "weight": number(w)})).collect()
    };
    let images: Vec<Value> = weights.iter().map(|list| list.iter().map(terms).collect()).collect();
    json!({"points": points, "images": images})
}

/// The point as a convex combination of the vertices of one triangle (or segment, or point) of a fan.
fn combination<E: Written>(vertices: &[Vec<E>], point: &[E]) -> Option<Value> {
    let n = vertices.len();
    let corners: Vec<Vec<usize>> = match n {
        0 => return None,
        1 => vec![vec![0]],
        2 => vec![vec![0, 1]],
        _ => (1..n - 1).map(|k| vec![0, k, k + 1]).collect(),
    };
    let target = Matrix::from_columns(point.len(), &[point.to_vec()]);
    for corners in corners {
        let columns: Vec<Vec<E>> = corners.iter().map(|&k| vertices[k].clone()).collect();
        // All points have coordinate sum 1, so the weights add up to 1 by themselves.
        let Some(weights) = Matrix::from_columns(point.len(), &columns).solve(&target) else { continue };
        let weights = weights.column(0);
        if weights.iter().all(|w| w.sign() >= 0) {
            let terms = corners.iter().zip(&weights).filter(|(_, w)| !w.is_zero());
            return Some(terms.map(|(k, w)| json!({"vertex": k, "weight": w.value()})).collect());
        }
    }
    None
}
