//! Floats propose words, hulls, eigenvalues and choices of vertices; [`Hull::holds`] and [`super::Crossing`] decide.
#![allow(clippy::float_arithmetic, reason = "proposes, exact arithmetic decides")]

use super::cover::Attempt;
use super::hull::{Moving, floats};
use super::{Hull, Image, Pencil, Piece, Seed, Vertex};
use crate::arith::{Rational, to_f64};
use crate::radius::System;
use crate::radius::budget::Budget;
use crate::radius::exact::grid;
use crate::radius::float::Floats;
use crate::radius::search::candidates;
use crate::radius::simplex::{Body, Hull as Points, gauge};
use malachite_q::rational::arithmetic::traits::SimplestRationalInInterval;

/// Most vertices of a hull.
const MAX_VERTICES: usize = 110;
/// Work for the product of two models, and for a number in a linear program.
const MODEL: u64 = 600;
const GAUGE: u64 = 20;
/// Images beyond this have left for ever.
const FAR: f64 = 1e5;

/// A word with the float value of `ρ(T_w)^(1/|w|)` at a member.
pub(super) struct Word {
    pub word: Vec<usize>,
    pub value: f64,
}

/// Words that grow fastest at a member, best first, of these at most letters.
pub(super) fn words(pencil: &Pencil, p: &Rational, longest: usize, budget: &Budget) -> Vec<Word> {
    let Ok(system) = System::plain(&pencil.at(p)) else { return Vec::new() };
    let found = candidates(&system, longest, 0.06, budget);
    let mut words: Vec<Word> = found.into_iter().map(|c| Word { word: c.path, value: c.value }).collect();
    // Values that differ by rounding only: the shorter word is the better one.
    let rounded = |w: &Word| (w.value * 1e9).round();
    words.sort_by(|a, b| {
        let order = rounded(b).total_cmp(&rounded(a));
        order.then_with(|| a.word.len().cmp(&b.word.len())).then_with(|| a.word.cmp(&b.word))
    });
    words
}

fn at(pencil: &Pencil, p: &Rational) -> Vec<Floats> {
    pencil.at(p).iter().map(Floats::of).collect()
}

fn product(letters: &[Floats], word: &[usize]) -> Option<Floats> {
    let (first, rest) = word.split_first()?;
    Some(rest.iter().fold(letters[*first].clone(), |m, l| m.times(&letters[*l])))
}

/// The real eigenvalue of largest modulus of a word at a member.
fn leading(letters: &[Floats], word: &[usize]) -> Option<f64> {
    let (re, im) = product(letters, word)?.eigenvalue()?;
    (im == 0.0).then_some(re)
}

/// The line of an eigenvalue of a word on an interval, and a distance.
fn line(pencil: &Pencil, word: &[usize], from: &Rational, to: &Rational) -> Option<[f64; 3]> {
    let middle = (from + to) / Rational::from(2);
    let value = |p: &Rational| leading(&at(pencil, p), word);
    let (low, mid, high) = (value(from)?, value(&middle)?, value(to)?);
    let (slope, bend) = ((high - low) / 2.0, (high + low) / 2.0 - mid);
    Some([mid + bend / 2.0, slope, bend.abs() + 1e-12])
}

/// An eigenvector as a seed, of about the largest coordinate 1.
fn eigen_seed(pencil: &Pencil, p: &Rational, word: &[usize]) -> Option<Seed> {
    let letters = at(pencil, p);
    let value = leading(&letters, word)?;
    let rows = product(&letters, word)?.transposed().eigenvector(value)?;
    let column = (0..rows.len()).max_by(|a, b| rows[*a].abs().total_cmp(&rows[*b].abs()))?;
    let moving = Moving::new(pencil, p, &Rational::from(0));
    let field = &moving.field;
    let model = crate::ring::Field::rational(field, &grid(value));
    let v = moving.along(word)?.eigenvector(field, column, &model);
    let largest = floats(field, &[v])[0].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    // A short factor: only the size of the seed matters.
    let scale = Rational::try_from(largest.recip()).ok().filter(|s| *s > 0)?;
    let short = Rational::simplest_rational_in_closed_interval(
        &(&scale * Rational::from_signeds(19, 20)),
        &(&scale * Rational::from_signeds(21, 20)),
    );
    Some(Seed::Eigen { word: word.to_vec(), column, scale: short })
}

/// A hull at a member from the eigenvectors of words, and from axes of a size where one is given.
pub(super) fn grow(
    pencil: &Pencil,
    p: &Rational,
    words: &[&[usize]],
    attempt: &Attempt,
    budget: &Budget,
) -> Option<Hull> {
    let mut seeds: Vec<Seed> = words.iter().map(|w| eigen_seed(pencil, p, w)).collect::<Option<_>>()?;
    if let Some(scale) = &attempt.axes {
        seeds.extend((0..pencil.dim()).map(|index| Seed::Axis { index, scale: scale.clone() }));
    }
    let mut growing = Growing::start(pencil, p, seeds, attempt.inside)?;
    while !growing.todo.is_empty() {
        let images = growing.todo.len() as u64;
        if !budget.spend(images * growing.gauging()) {
            return None;
        }
        growing.generation()?;
    }
    growing.finish()
}

struct Growing {
    letters: Vec<Floats>,
    hull: Hull,
    points: Vec<Vec<f64>>,
    body: Points,
    /// Images that are not yet known: vertex and letter.
    todo: Vec<(usize, usize)>,
    /// Images whose gauge is below this count as inside.
    inside: f64,
}

impl Growing {
    fn start(pencil: &Pencil, p: &Rational, seeds: Vec<Seed>, inside: f64) -> Option<Self> {
        let (letters, dim) = (at(pencil, p), pencil.dim());
        let mut vertices: Vec<Vertex> = Vec::new();
        for (seed, kind) in seeds.iter().enumerate() {
            vertices.push(Vertex { seed, word: Vec::new() });
            if let Seed::Eigen { word, .. } = kind {
                vertices.extend((1..word.len()).rev().map(|j| Vertex { seed, word: word[j..].to_vec() }));
            }
        }
        let hull = Hull { seeds, vertices, images: Vec::new() };
        let values = proposed_values(pencil, &hull, p, p)?;
        let moving = Moving::new(pencil, p, &Rational::from(0));
        let starts = floats(&moving.field, &hull.starts(&moving, &hull.along(&moving)?, &values)?);
        let points = hull.spread(&starts, |letter, x| letters[letter].apply(x));
        let mut growing = Self { letters, hull, points: Vec::new(), body: Points::new(dim), todo: Vec::new(), inside };
        points.into_iter().for_each(|q| growing.add_point(q));
        Some(growing)
    }

    fn add_point(&mut self, q: Vec<f64>) {
        self.body.push(&q);
        let index = self.points.len();
        self.points.push(q);
        self.hull.images.push(vec![Image::Inside; self.letters.len()]);
        self.todo.extend((0..self.letters.len()).map(|letter| (index, letter)));
    }

    /// The images of the vertices that are new: those that stick out farthest become vertices first.
    fn generation(&mut self) -> Option<()> {
        let mut outside: Vec<(f64, usize, usize, Vec<f64>)> = Vec::new();
        for (v, letter) in std::mem::take(&mut self.todo) {
            crate::stop::check();
            let vertex = &self.hull.vertices[v];
            let label = Vertex { seed: vertex.seed, word: [&[letter], vertex.word.as_slice()].concat() };
            let closes = matches!(&self.hull.seeds[label.seed], Seed::Eigen { word, .. } if *word == label.word);
            let known = self.hull.vertices.iter().position(|u| *u == label);
            if closes {
                self.hull.images[v][letter] = Image::Closing;
            } else if let Some(k) = known {
                self.hull.images[v][letter] = Image::Vertex(k);
            } else {
                let x = self.letters[letter].apply(&self.points[v]);
                let value = self.gauge(&x);
                if value >= self.inside {
                    outside.push((value, v, letter, x));
                }
            }
        }
        outside.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        for (_, v, letter, x) in outside {
            crate::stop::check();
            if self.gauge(&x) < self.inside {
                continue;
            }
            if self.points.len() >= MAX_VERTICES || x.iter().any(|c| c.is_nan() || c.abs() >= FAR) {
                return None;
            }
            let vertex = &self.hull.vertices[v];
            let label = Vertex { seed: vertex.seed, word: [&[letter], vertex.word.as_slice()].concat() };
            self.hull.images[v][letter] = Image::Vertex(self.points.len());
            self.hull.vertices.push(label);
            self.add_point(x);
        }
        Some(())
    }

    /// The work of a gauge, a linear program with a row for every coordinate.
    fn gauging(&self) -> u64 {
        let n = self.letters[0].rows as u64;
        GAUGE * n * n * self.points.len() as u64
    }

    fn gauge(&self, x: &[f64]) -> f64 {
        gauge(Body::Symmetric, &self.body, x, 0.0, f64::INFINITY).0.value
    }

    /// The hull, where it spans.
    fn finish(self) -> Option<Hull> {
        let n = self.letters[0].rows;
        let axis = |j: usize| (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        (0..n).all(|j| self.gauge(&axis(j)) < 1e7).then_some(self.hull)
    }
}

fn proposed_values(pencil: &Pencil, hull: &Hull, from: &Rational, to: &Rational) -> Option<Vec<[Rational; 3]>> {
    hull.words().map(|w| line(pencil, w, from, to).map(|l| l.map(grid))).collect()
}

/// A piece of an interval with everything that a check needs, and the check; `None` where floats see none, or it fails.
pub(super) fn piece(pencil: &Pencil, hull: &Hull, from: &Rational, to: &Rational, budget: &Budget) -> Option<Piece> {
    let (n, images) = (pencil.dim() as u64, (hull.vertices.len() * pencil.letters()) as u64);
    if !budget.spend(images * n * n * (3 * MODEL + GAUGE * hull.vertices.len() as u64)) {
        return None;
    }
    if from >= to || !hull.is_labelled(pencil.letters()) || hull.vertices.is_empty() {
        return None;
    }
    let mut values = proposed_values(pencil, hull, from, to)?;
    let two = Rational::from(2);
    let (mid, half) = ((from + to) / &two, (to - from) / &two);
    let moving = Moving::new(pencil, &mid, &half);
    let along = hull.along(&moving)?;
    for (along, value) in along.iter().zip(&mut values) {
        let mut tries = 0;
        while along.eigenvalue(&moving.field, value).is_none() {
            tries += 1;
            if tries > 12 || to_f64(&value[2]) > 0.5 {
                return None;
            }
            value[2] *= Rational::from(2);
        }
    }
    let starts = hull.starts(&moving, &along, &values)?;
    let letters = at(pencil, &mid);
    let points = hull.spread(&floats(&moving.field, &starts), |letter, x| letters[letter].apply(x));
    let mut body = Points::new(pencil.dim());
    points.iter().for_each(|q| body.push(q));
    let mut bases = Vec::new();
    for (v, row) in hull.images.iter().enumerate() {
        for (letter, image) in row.iter().enumerate() {
            if *image == Image::Inside {
                let x = letters[letter].apply(&points[v]);
                let (found, _) = gauge(Body::Symmetric, &body, &x, 0.0, f64::INFINITY);
                if found.value.is_nan() || found.value >= 1.0 {
                    return None;
                }
                bases.push(completed(found.terms.iter().map(|t| t.0).collect(), &points)?);
            }
        }
    }
    let piece = Piece { from: from.clone(), to: to.clone(), values, bases };
    hull.holds_from(&moving, &starts, &piece).then_some(piece)
}

/// As many vertices as there are coordinates, these among them, which are independent: the farthest from the span of those chosen
/// comes next.
fn completed(mut chosen: Vec<usize>, points: &[Vec<f64>]) -> Option<Vec<usize>> {
    let n = points.first()?.len();
    let mut frame: Vec<Vec<f64>> = Vec::new();
    let rest = |frame: &[Vec<f64>], q: &[f64]| {
        let mut r = q.to_vec();
        for _ in 0..2 {
            for f in frame {
                let c: f64 = f.iter().zip(&r).map(|(a, b)| a * b).sum();
                r.iter_mut().zip(f).for_each(|(x, y)| *x -= c * y);
            }
        }
        r
    };
    let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut independent = Vec::new();
    for &k in &chosen {
        let r = rest(&frame, &points[k]);
        let norm = size(&r);
        if norm > 1e-9 * size(&points[k]) {
            frame.push(r.iter().map(|x| x / norm).collect());
            independent.push(k);
        }
    }
    chosen = independent;
    while chosen.len() < n {
        let far = |k: &usize| size(&rest(&frame, &points[*k]));
        let next = (0..points.len()).filter(|k| !chosen.contains(k)).max_by(|a, b| far(a).total_cmp(&far(b)))?;
        let r = rest(&frame, &points[next]);
        let norm = size(&r);
        if norm.is_nan() || norm <= 1e-9 {
            return None;
        }
        frame.push(r.iter().map(|x| x / norm).collect());
        chosen.push(next);
    }
    chosen.sort_unstable();
    Some(chosen)
}
