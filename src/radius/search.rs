//! The search for words whose products grow fastest.
#![allow(clippy::float_arithmetic, reason = "proposes words, the exact spectrum of the product decides")]

use super::System;
use super::float::Floats;

/// A cyclic path and the float value of `ρ(T_w)^(1/|w|)`.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub path: Vec<usize>,
    pub value: f64,
}

struct Partial {
    path: Vec<usize>,
    product: Floats,
    value: f64,
}

const BEAM: usize = 96;

/// Cyclic words up to `longest` letters with the largest values, best first: every word whose value is within `tolerance`
/// (relative) of the best one found, each once up to rotation.
pub(super) fn candidates(system: &System, longest: usize, tolerance: f64) -> Vec<Candidate> {
    let floats = Floats::all(system);
    let mut best: Vec<Candidate> = Vec::new();
    let mut top = 0.0_f64;
    let arrows = system.arrows.len();
    let mut layer: Vec<Partial> = (0..arrows)
        .map(|a| Partial { path: vec![a], product: floats[a].clone(), value: 0.0 })
        .collect();
    for length in 1..=longest {
        for partial in &mut layer {
            let power = 1.0 / f64::from(u32::try_from(length).unwrap_or(u32::MAX));
            let norm = partial.product.norm().powf(power);
            partial.value = norm;
            let closed = system.arrows[partial.path[0]].from == system.arrows[partial.path[length - 1]].to;
            if closed && norm >= top * (1.0 - tolerance) {
                let value = partial.product.radius().powf(power);
                partial.value = norm + value;
                top = top.max(value);
                insert(&mut best, &partial.path, value, tolerance);
            }
        }
        layer.sort_by(|x, y| y.value.total_cmp(&x.value).then_with(|| x.path.cmp(&y.path)));
        layer.truncate(BEAM);
        layer = layer.iter().flat_map(|p| extend(system, &floats, p)).collect();
    }
    best.retain(|c| c.value >= top * (1.0 - tolerance) && c.value > 0.0);
    best.sort_by(|x, y| x.path.len().cmp(&y.path.len()).then_with(|| x.path.cmp(&y.path)));
    best
}

fn extend(system: &System, floats: &[Floats], partial: &Partial) -> Vec<Partial> {
    let end = system.arrows[partial.path[partial.path.len() - 1]].to;
    (0..system.arrows.len())
        .filter(|&a| system.arrows[a].from == end)
        .map(|a| {
            let mut path = partial.path.clone();
            path.push(a);
            Partial { path, product: partial.product.times(&floats[a]), value: 0.0 }
        })
        .filter(|p| p.product.norm() > 0.0)
        .collect()
}

fn insert(best: &mut Vec<Candidate>, path: &[usize], value: f64, tolerance: f64) {
    let word = canonical(path);
    if best.iter().any(|c| c.path == word) || best.iter().any(|c| c.value * (1.0 - tolerance) > value) {
        return;
    }
    best.retain(|c| c.value >= value * (1.0 - tolerance));
    best.push(Candidate { path: word, value });
}

/// The primitive root of a cyclic word in its least rotation.
pub(super) fn canonical(path: &[usize]) -> Vec<usize> {
    let n = path.len();
    let period = (1..=n).find(|&p| n % p == 0 && (0..n).all(|k| path[k] == path[(k + p) % n])).unwrap_or(n);
    (0..period)
        .map(|shift| (0..period).map(|k| path[(k + shift) % period]).collect::<Vec<_>>())
        .min()
        .unwrap_or_default()
}
