//! The search for words whose products grow fastest.
#![allow(clippy::float_arithmetic, reason = "proposes words, the exact spectrum of the product decides")]

use super::System;
use super::budget::Budget;
use super::float::Floats;
use crate::linalg::Entry;

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
pub(super) fn candidates<E: Entry>(
    system: &System<E>,
    longest: usize,
    tolerance: f64,
    budget: &Budget,
) -> Vec<Candidate> {
    let floats = Floats::all(system);
    let mut best: Vec<Candidate> = Vec::new();
    let mut top = 0.0_f64;
    let arrows = system.arrows.len();
    let mut layer: Vec<Partial> =
        (0..arrows).map(|a| Partial { path: vec![a], product: floats[a].clone(), value: 0.0 }).collect();
    let cube = floats.iter().map(Floats::cube).fold(1, u64::max);
    // As wide as a quarter of the budget allows.
    let width =
        (budget.left() / 4 / (longest.max(1) as u64 * arrows.max(1) as u64 * cube)).clamp(4, BEAM as u64) as usize;
    for length in 1..=longest {
        for partial in &mut layer {
            if !budget.spend(cube) && length > 1 {
                break;
            }
            let power = 1.0 / length as f64;
            let norm = partial.product.norm().powf(power);
            partial.value = norm;
            let closed = system.arrows[partial.path[0]].from == system.arrows[partial.path[length - 1]].to;
            if closed && norm >= top * (1.0 - tolerance) {
                budget.spend(12 * cube);
                let value = partial.product.radius().powf(power);
                partial.value = norm + value;
                top = top.max(value);
                insert(&mut best, &partial.path, value, tolerance);
            }
        }
        layer.sort_by(|x, y| y.value.total_cmp(&x.value).then_with(|| x.path.cmp(&y.path)));
        layer.truncate(width);
        layer = layer.iter().flat_map(|p| extend(system, &floats, p)).collect();
    }
    best.retain(|c| c.value >= top * (1.0 - tolerance) && c.value > 0.0);
    best.sort_by(|x, y| x.path.len().cmp(&y.path.len()).then_with(|| x.path.cmp(&y.path)));
    best
}

/// Most words that are put between powers of a good word.
const INSERTIONS: usize = 400;
/// Good words whose powers are tried.
const POWERS: usize = 3;

/// Words `u^k v`, `u` one of the best and `v` short, which grow faster than those found so far: of sets where the leading word
/// is long, and of letters with a long Jordan block.
pub(super) fn insertions<E: Entry>(
    system: &System<E>,
    best: &mut Vec<Candidate>,
    longest: usize,
    tolerance: f64,
    budget: &Budget,
) {
    let floats = Floats::all(system);
    let mut bases = best.clone();
    bases.sort_by(|a, b| b.value.total_cmp(&a.value).then_with(|| a.path.len().cmp(&b.path.len())));
    for base in bases.iter().take(POWERS) {
        let state = system.arrows[base.path[0]].from;
        let mut inserted: Vec<Partial> = Vec::new();
        let mut layer: Vec<Partial> = (0..floats.len())
            .filter(|&a| system.arrows[a].from == state)
            .map(|a| Partial { path: vec![a], product: floats[a].clone(), value: 0.0 })
            .collect();
        while inserted.len() < INSERTIONS && !layer.is_empty() && layer[0].path.len() <= 12 {
            let next = layer.iter().flat_map(|p| extend(system, &floats, p)).take(4 * INSERTIONS).collect();
            let closed = |p: &Partial| system.arrows[p.path[p.path.len() - 1]].to == state;
            inserted.extend(layer.into_iter().filter(closed).take(INSERTIONS));
            layer = next;
        }
        let mut powers = vec![Power::of(&floats, &base.path)];
        while powers.len() < 10 && powers[powers.len() - 1].length < longest {
            let last = &powers[powers.len() - 1];
            powers.push(last.times(last));
        }
        for v in &inserted {
            if !rise(&powers, &Power::of(&floats, &v.path), base, v, longest, tolerance, best, budget) {
                return;
            }
        }
    }
}

/// A product and the logarithm by which it was divided.
#[derive(Clone)]
struct Power {
    product: Floats,
    log: f64,
    length: usize,
}

impl Power {
    fn of(floats: &[Floats], path: &[usize]) -> Self {
        let one = |a: &usize| Self { product: floats[*a].clone(), log: 0.0, length: 1 };
        path[1..].iter().fold(one(&path[0]), |p, a| p.times(&one(a)))
    }

    fn times(&self, other: &Self) -> Self {
        let product = self.product.times(&other.product);
        let norm = product.norm();
        let (factor, log) = if norm > 0.0 { (1.0 / norm, norm.ln()) } else { (1.0, 0.0) };
        Self { product: product.scaled(factor), log: self.log + other.log + log, length: self.length + other.length }
    }

    fn growth(&self) -> f64 {
        ((self.log + self.product.radius().ln()) / self.length as f64).exp()
    }
}

/// Tries powers of the base before a word, doubling them while the growth rises, then halving the step; false where the budget ends.
#[allow(clippy::too_many_arguments, reason = "one step of the loop above")]
fn rise(
    powers: &[Power],
    v: &Power,
    base: &Candidate,
    word: &Partial,
    longest: usize,
    tolerance: f64,
    best: &mut Vec<Candidate>,
    budget: &Budget,
) -> bool {
    let cube = v.product.cube();
    let value = |k: usize| {
        let bits = powers.iter().enumerate().filter(|(b, _)| k >> b & 1 == 1);
        bits.fold(v.clone(), |p, (_, q)| q.times(&p)).growth()
    };
    let most = (longest.saturating_sub(v.length) / base.path.len()).min((1 << powers.len()) - 1);
    let (mut k, mut top) = (0_usize, 0.0);
    let mut step = 1;
    let mut rising = true;
    while step > 0 {
        if !budget.spend(20 * cube) {
            return false;
        }
        let next = [k + step, k.saturating_sub(step)].into_iter().filter(|n| (1..=most).contains(n) && *n != k);
        let found = next.map(|n| (n, value(n))).max_by(|a, b| a.1.total_cmp(&b.1)).filter(|f| f.1 > top);
        match found {
            Some(f) => {
                (k, top) = f;
                step = if rising { 2 * step } else { step };
            }
            None => {
                rising = false;
                step /= 2;
            }
        }
    }
    let known = best.iter().map(|c| c.value).fold(0.0, f64::max);
    if k > 0 && top >= known * (1.0 - tolerance) {
        let path: Vec<usize> = base.path.repeat(k).into_iter().chain(word.path.iter().copied()).collect();
        insert(best, &path, top, tolerance);
    }
    true
}

fn extend<E: Entry>(system: &System<E>, floats: &[Floats], partial: &Partial) -> Vec<Partial> {
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

/// The primitive root of a cyclic word in its least rotation; the empty word is its own.
pub(super) fn canonical(path: &[usize]) -> Vec<usize> {
    let n = path.len();
    let mut period = 1;
    while period < n && !(n.is_multiple_of(period) && (0..n).all(|k| path[k] == path[(k + period) % n])) {
        period += 1;
    }
    let root = &path[..period.min(n)];
    let rotation = |shift: usize| [&root[shift..], &root[..shift]].concat();
    (1..root.len()).map(rotation).fold(root.to_vec(), Vec::min)
}
