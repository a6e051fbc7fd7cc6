//! Complex balanced polytopes `{Σ c_k q_k : c_k complex, Σ |c_k| <= 1}`, for words whose leading eigenvalue is not real.
#![allow(clippy::float_arithmetic, reason = "proposes a polytope, exact arithmetic checks it")]

use super::System;
use super::budget::Budget;
use super::exact::{LeadingVector, axis_point, grid};
use super::float::{Floats, dot};
use super::grow::Origin;
use super::leading::{Eigenvector, Lower, square_root};
use super::polytope::norm1;
use super::radial::Radial;
use super::simplex::{Column, Tableau};
use crate::arith::{Interval, Rational, to_f64};
use crate::linalg::Entry;

/// A complex number: real and imaginary part.
pub type Complex = (Rational, Rational);
type Box2 = (Interval, Interval);

/// A vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComplexPoint {
    /// The state in whose space it lies.
    pub state: usize,
    /// Its coordinates.
    pub coordinates: Vec<Complex>,
}

/// `T p = Σ c_k q_k + e` with a small rest `e`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComplexInclusion {
    /// Index of the point.
    pub point: usize,
    /// Position of the arrow.
    pub arrow: usize,
    /// Index of a point of the arrow's state, and its coefficient.
    pub terms: Vec<(usize, Complex)>,
}

/// One balanced polytope for every state, with the inclusions of all images.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Balanced {
    /// The points of all states.
    pub points: Vec<ComplexPoint>,
    /// For every point and every arrow that ends in its state, an inclusion.
    pub inclusions: Vec<ComplexInclusion>,
    /// For every state and axis, coefficients that nearly combine the unit vector from points of the state.
    pub axes: Vec<Vec<Vec<(usize, Complex)>>>,
}

/// An upper bound of the modulus, close to it.
fn modulus(c: &Complex) -> Rational {
    if c.1 == 0 { c.0.absolute() } else { square_root(&(&c.0 * &c.0 + &c.1 * &c.1), 80).hi }
}

fn total(terms: &[(usize, Complex)]) -> Rational {
    terms.iter().fold(Rational::from(0), |s, t| s + modulus(&t.1))
}

impl Balanced {
    /// The smallest `r` for which the data prove `T Q ⊂ r Q` for all arrows, or `None` where they prove nothing: with
    /// `e_j = Σ d_k q_k + s_j` and `K = max Σ|d| / (1 − max ‖s_j‖_1)`, `T p ∈ (Σ|c| + K ‖e‖_1) Q`.
    #[must_use]
    pub fn bound<E: Entry>(&self, system: &System<E>) -> Option<Rational> {
        let fits = |p: &ComplexPoint| system.dims.get(p.state) == Some(&p.coordinates.len());
        if !self.points.iter().all(fits) {
            return None;
        }
        let scale: Vec<Rational> = (0..system.dims.len()).map(|s| self.interior(system, s)).collect::<Option<_>>()?;
        let mut seen = std::collections::BTreeSet::new();
        let mut bound = Rational::from(0);
        for inclusion in &self.inclusions {
            let arrow = system.arrows.get(inclusion.arrow)?;
            let point = self.points.get(inclusion.point).filter(|p| p.state == arrow.to)?;
            if !seen.insert((inclusion.point, inclusion.arrow)) {
                return None;
            }
            let image = |part: fn(&Complex) -> &Rational| {
                let x: Vec<E> = point.coordinates.iter().map(|c| E::of(part(c))).collect();
                arrow.matrix.apply(&x)
            };
            let image: Vec<(E, E)> = image(|c| &c.0).into_iter().zip(image(|c| &c.1)).collect();
            let rest = self.rest(image, arrow.from, &inclusion.terms)?;
            bound = bound.max(total(&inclusion.terms) + &scale[arrow.from] * rest);
        }
        let needed: usize = self.points.iter().map(|p| system.arrows.iter().filter(|a| a.to == p.state).count()).sum();
        (seen.len() == needed).then_some(bound)
    }

    /// `‖x − Σ c q‖_1`, with `|re| + |im|` for the modulus.
    fn rest<E: Entry>(&self, mut x: Vec<(E, E)>, state: usize, terms: &[(usize, Complex)]) -> Option<Rational> {
        for (k, c) in terms {
            let point = self.points.get(*k).filter(|p| p.state == state)?;
            for (r, q) in x.iter_mut().zip(&point.coordinates) {
                r.0 = r.0.minus(&E::of(&(&c.0 * &q.0 - &c.1 * &q.1)));
                r.1 = r.1.minus(&E::of(&(&c.0 * &q.1 + &c.1 * &q.0)));
            }
        }
        let parts: Vec<E> = x.into_iter().flat_map(|(re, im)| [re, im]).collect();
        Some(norm1(&parts))
    }

    /// `K` with `e_j ∈ K Q` for all axes of the state.
    #[must_use]
    pub fn interior<E: Entry>(&self, system: &System<E>, state: usize) -> Option<Rational> {
        let dim = system.dims[state];
        let axes = self.axes.get(state).filter(|a| a.len() == dim)?;
        let (mut size, mut error) = (Rational::from(0), Rational::from(0));
        for (axis, terms) in axes.iter().enumerate() {
            let unit = (0..dim).map(|i| (E::integer(i64::from(i == axis)), E::zero())).collect();
            error = error.max(self.rest(unit, state, terms)?);
            size = size.max(total(terms));
        }
        (error < 1).then(|| size / (Rational::from(1) - error))
    }
}

/// A vertex in floats: real parts, then imaginary parts.
#[derive(Clone)]
struct Vertex {
    state: usize,
    origin: Origin,
    point: Vec<f64>,
}

/// A combination in floats.
#[derive(Clone)]
struct Combination {
    terms: Vec<(usize, (f64, f64))>,
    value: f64,
}

struct Inside {
    vertex: usize,
    arrow: usize,
    combination: Combination,
}

/// What is grown, and the leading words at whose eigenvectors it begins.
pub(super) struct Task<'a, E = Rational> {
    pub system: &'a System<E>,
    /// The matrices divided by the radius.
    pub scaled: &'a [Floats],
    pub roots: &'a [LeadingVector],
    pub radius: &'a Lower,
    pub most: usize,
    pub budget: &'a Budget<'a>,
}

/// What a balanced polytope showed.
pub(super) struct Found {
    pub polytope: Balanced,
    pub bound: Rational,
    /// Whether the radius is exactly that of the word.
    pub attains: bool,
}

/// Below this an image counts as strictly inside.
const STRICT: f64 = 1.0 - 1e-9;

/// Grows a polytope from the leading eigenvectors and checks it.
pub(super) fn find<E: Radial>(task: &Task<E>) -> Option<Found> {
    let mut seeds: Vec<Vertex> = Vec::new();
    for (k, r) in task.roots.iter().enumerate() {
        let state = task.system.arrows[r.lower.path[0]].from;
        let values = complex_enclosure(&r.vector, 96);
        let re = values.iter().map(|z| to_f64(&z.0.mid()));
        let point = re.chain(values.iter().map(|z| to_f64(&z.1.mid()))).collect();
        seeds.push(Vertex { state, origin: Origin::Root(k), point });
    }
    let mut vertices = seeds.clone();
    for exponent in [6, 10, 16] {
        let (grown, inside) = grow(task, vertices)?;
        let missing = missing(task.system, &grown);
        if missing.is_empty() {
            return settle(task, &grown, &inside);
        }
        vertices = seeds.clone();
        for (state, axis) in missing {
            let unit = axis_point(task.system.dims[state], axis, exponent);
            let point = unit.iter().map(to_f64).chain(unit.iter().map(|_| 0.0)).collect();
            vertices.push(Vertex { state, origin: Origin::Axis { axis, exponent }, point });
        }
    }
    None
}

fn grow<E: Radial>(task: &Task<E>, mut vertices: Vec<Vertex>) -> Option<(Vec<Vertex>, Vec<Inside>)> {
    let mut inside = Vec::new();
    let mut next = 0;
    while next < vertices.len() {
        let state = vertices[next].state;
        for arrow in (0..task.scaled.len()).filter(|&a| task.system.arrows[a].to == state) {
            let point = apply(&task.scaled[arrow], &vertices[next].point);
            if let Some(root) = returns(task, &vertices, next, arrow) {
                inside.push(Inside { vertex: next, arrow, combination: Combination { terms: vec![root], value: 1.0 } });
                continue;
            }
            let from = task.system.arrows[arrow].from;
            let (combination, work) = gauge(&vertices, from, &point);
            if !task.budget.spend(work) {
                return None;
            }
            if combination.value <= STRICT {
                inside.push(Inside { vertex: next, arrow, combination });
            } else if vertices.len() < task.most {
                vertices.push(Vertex { state: from, origin: Origin::Image { parent: next, arrow }, point });
            } else {
                return None;
            }
        }
        next += 1;
    }
    Some((vertices, inside))
}

fn apply(m: &Floats, x: &[f64]) -> Vec<f64> {
    let (re, im) = x.split_at(x.len() / 2);
    let mut out = m.apply(re);
    out.extend(m.apply(im));
    out
}

/// Where the image is the root again, turned by a unimodular factor: the root and about that factor.
fn returns<E: Radial>(task: &Task<E>, vertices: &[Vertex], vertex: usize, arrow: usize) -> Option<(usize, (f64, f64))> {
    let mut arrows = vec![arrow];
    let mut current = vertex;
    while let Origin::Image { parent, arrow } = vertices[current].origin {
        arrows.push(arrow);
        current = parent;
    }
    let Origin::Root(k) = vertices[current].origin else { return None };
    if arrows != task.roots[k].lower.path {
        return None;
    }
    let (re, im) = task.roots[k].root.to_f64();
    let size = re.hypot(im);
    Some((current, (re / size, im / size)))
}

/// The gauge of a complex vector by column generation: a point enters with the phase that suits the dual solution best.
fn gauge(vertices: &[Vertex], state: usize, x: &[f64]) -> (Combination, u64) {
    let n = x.len();
    let mut tableau = Tableau::start(x);
    let mut work = 0;
    for _ in 0..(30 * n + 100) {
        work += (2 * n * vertices.len() + 3 * n * n) as u64 + 100;
        let y = tableau.dual();
        let (yr, yi) = y.split_at(n / 2);
        let mut entering: Option<(usize, f64, f64)> = None;
        for (k, v) in vertices.iter().enumerate().filter(|(_, v)| v.state == state) {
            let (re, im) = v.point.split_at(n / 2);
            let (a, b) = (dot(yr, re) + dot(yi, im), dot(yi, re) - dot(yr, im));
            let gain = a.hypot(b) - 1.0;
            if gain > entering.map_or(1e-10, |e| e.1) {
                entering = Some((k, gain, b.atan2(a)));
            }
        }
        let Some((k, _, phase)) = entering else { break };
        let (sin, cos) = phase.sin_cos();
        let (re, im) = vertices[k].point.split_at(n / 2);
        let turned = re.iter().zip(im).map(|(r, i)| r * cos - i * sin);
        let entries: Vec<f64> = turned.chain(re.iter().zip(im).map(|(r, i)| r * sin + i * cos)).collect();
        if !tableau.pivot(Column::Point(k, phase), &entries) || tableau.value() <= 1.0 - 1e-3 {
            break;
        }
    }
    (collect(&tableau), work)
}

fn collect(tableau: &Tableau) -> Combination {
    let mut terms: Vec<(usize, (f64, f64))> = Vec::new();
    let mut value = 0.0;
    for (column, &c) in tableau.basis.iter().zip(&tableau.values) {
        match column {
            Column::Point(k, phase) if c > 0.0 => {
                let part = (c * phase.cos(), c * phase.sin());
                match terms.iter_mut().find(|t| t.0 == *k) {
                    Some(t) => t.1 = (t.1.0 + part.0, t.1.1 + part.1),
                    None => terms.push((*k, part)),
                }
            }
            Column::Artificial if c > 1e-10 => value = f64::INFINITY,
            _ => {}
        }
    }
    terms.sort_by_key(|t| t.0);
    value += terms.iter().map(|t| t.1.0.hypot(t.1.1)).sum::<f64>();
    Combination { terms, value }
}

/// For every state the axes that complete the complex span of the vertices.
fn missing<E: Radial>(system: &System<E>, vertices: &[Vertex]) -> Vec<(usize, usize)> {
    let mut missing = Vec::new();
    for (state, &dim) in system.dims.iter().enumerate() {
        let mut frame: Vec<Vec<(f64, f64)>> = Vec::new();
        let mut absorb = |v: Vec<(f64, f64)>, threshold: f64| {
            let mut rest = v;
            for _ in 0..2 {
                for f in &frame {
                    let c = f
                        .iter()
                        .zip(&rest)
                        .fold((0.0, 0.0), |s, (f, r)| (s.0 + f.0 * r.0 + f.1 * r.1, s.1 + f.0 * r.1 - f.1 * r.0));
                    for (r, f) in rest.iter_mut().zip(f) {
                        *r = (r.0 - c.0 * f.0 + c.1 * f.1, r.1 - c.0 * f.1 - c.1 * f.0);
                    }
                }
            }
            let norm = rest.iter().map(|r| r.0 * r.0 + r.1 * r.1).sum::<f64>().sqrt();
            if norm > threshold {
                frame.push(rest.iter().map(|r| (r.0 / norm, r.1 / norm)).collect());
            }
            norm > threshold
        };
        for v in vertices.iter().filter(|v| v.state == state) {
            let (re, im) = v.point.split_at(dim);
            let size = dot(&v.point, &v.point).sqrt().max(1e-300);
            absorb(re.iter().copied().zip(im.iter().copied()).collect(), 1e-3 * size);
        }
        for axis in 0..dim {
            if absorb((0..dim).map(|k| (f64::from(u8::from(k == axis)), 0.0)).collect(), 1e-2) {
                missing.push((state, axis));
            }
        }
    }
    missing
}

fn exact(c: (f64, f64)) -> Complex {
    (grid(c.0), grid(c.1))
}

fn settle<E: Radial>(task: &Task<E>, vertices: &[Vertex], inside: &[Inside]) -> Option<Found> {
    let system = task.system;
    let radius = task.radius.enclosure(96);
    let points: Vec<ComplexPoint> = vertices
        .iter()
        .map(|v| {
            let (re, im) = v.point.split_at(v.point.len() / 2);
            let coordinates = re.iter().zip(im).map(|(r, i)| exact((*r, *i))).collect();
            ComplexPoint { state: v.state, coordinates }
        })
        .collect();
    let times = |c: Complex| (c.0 * &radius.hi, c.1 * &radius.hi);
    let mut inclusions = Vec::new();
    for (k, v) in vertices.iter().enumerate() {
        if let Origin::Image { parent, arrow } = v.origin {
            let one = times((Rational::from(1), Rational::from(0)));
            inclusions.push(ComplexInclusion { point: parent, arrow, terms: vec![(k, one)] });
        }
    }
    for i in inside {
        let terms = i.combination.terms.iter().map(|(k, c)| (*k, times(exact(*c)))).collect();
        inclusions.push(ComplexInclusion { point: i.vertex, arrow: i.arrow, terms });
    }
    let unit_terms = |state: usize, axis: usize| {
        let dim = system.dims[state];
        let unit: Vec<f64> = (0..2 * dim).map(|k| f64::from(u8::from(k == axis))).collect();
        gauge(vertices, state, &unit).0.terms.into_iter().map(|(k, c)| (k, exact(c))).collect::<Vec<_>>()
    };
    let axes = system.dims.iter().enumerate().map(|(s, &d)| (0..d).map(|a| unit_terms(s, a)).collect()).collect();
    let polytope = Balanced { points, inclusions, axes };
    // Rationals of complex numbers, with a root for each coefficient.
    let of = |i: &Inside| (20_000 + 8_000 * system.arrows[i.arrow].matrix.rows() * i.combination.terms.len()) as u64;
    if !task.budget.spend(inside.iter().map(of).sum()) {
        return None;
    }
    let bound = polytope.bound(system)?;
    let attains = closes(task, vertices, inside, &polytope);
    Some(Found { polytope, bound, attains })
}

/// Whether the polytope of the true vertices closes at the radius itself: images that return to a root do so with a factor of
/// modulus 1, all others lie strictly inside, by interval arithmetic.
fn closes<E: Radial>(task: &Task<E>, vertices: &[Vertex], inside: &[Inside], polytope: &Balanced) -> bool {
    const BITS: u64 = 160;
    let ratio = task.radius.enclosure(BITS);
    if ratio.lo <= 0 {
        return false;
    }
    let inverse = Interval::new(Rational::from(1) / &ratio.hi, Rational::from(1) / &ratio.lo).outward(BITS);
    let mut boxes: Vec<Vec<Box2>> = Vec::new();
    for v in vertices {
        boxes.push(match &v.origin {
            Origin::Root(k) => complex_enclosure(&task.roots[*k].vector, BITS + 40),
            Origin::Free(point) => {
                point.iter().map(|x| (Interval::point(x.clone()), Interval::point(Rational::from(0)))).collect()
            }
            Origin::Axis { axis, exponent } => {
                let unit = axis_point(task.system.dims[v.state], *axis, *exponent);
                unit.into_iter().map(|x| (Interval::point(x), Interval::point(Rational::from(0)))).collect()
            }
            Origin::Image { parent, arrow } => image(task.system, *arrow, &boxes[*parent], &inverse, BITS),
        });
    }
    let mut interior = Vec::new();
    for (state, &dim) in task.system.dims.iter().enumerate() {
        let (mut size, mut error) = (Rational::from(0), Rational::from(0));
        for axis in 0..dim {
            let terms = &polytope.axes[state][axis];
            let zero = || Interval::point(Rational::from(0));
            let unit = (0..dim).map(|i| (Interval::point(Rational::from(u8::from(i == axis))), zero())).collect();
            error = error.max(distance(unit, terms, &boxes));
            size = size.max(total(terms));
        }
        if error >= 1 {
            return false;
        }
        interior.push(size / (Rational::from(1) - error));
    }
    inside.iter().all(|i| {
        if returns(task, vertices, i.vertex, i.arrow).is_some() {
            return true;
        }
        let x = image(task.system, i.arrow, &boxes[i.vertex], &inverse, BITS);
        let terms: Vec<(usize, Complex)> = i.combination.terms.iter().map(|(k, c)| (*k, exact(*c))).collect();
        total(&terms) + &interior[task.system.arrows[i.arrow].from] * distance(x, &terms, &boxes) < 1
    })
}

fn image<E: Radial>(system: &System<E>, arrow: usize, x: &[Box2], inverse: &Interval, bits: u64) -> Vec<Box2> {
    let matrix = &system.arrows[arrow].matrix;
    let zero = || Interval::point(Rational::from(0));
    (0..matrix.rows())
        .map(|i| {
            let terms = matrix.row(i).iter().zip(x).filter(|(a, _)| !a.is_zero());
            let terms = terms.map(|(a, v)| (a.enclosure(bits + 40), v));
            let sum = terms.fold((zero(), zero()), |s, (a, v)| (&s.0 + &(&v.0 * &a), &s.1 + &(&v.1 * &a)));
            ((&sum.0 * inverse).outward(bits), (&sum.1 * inverse).outward(bits))
        })
        .collect()
}

/// An upper bound of `‖x − Σ c q‖_1`.
fn distance(mut x: Vec<Box2>, terms: &[(usize, Complex)], points: &[Vec<Box2>]) -> Rational {
    for (k, c) in terms {
        for (r, q) in x.iter_mut().zip(&points[*k]) {
            r.0 = &r.0 - &(&(&q.0 * &c.0) - &(&q.1 * &c.1));
            r.1 = &r.1 - &(&(&q.0 * &c.1) + &(&q.1 * &c.0));
        }
    }
    x.iter().fold(Rational::from(0), |s, r| s + r.0.magnitude() + r.1.magnitude())
}

/// Enclosures of the coordinates of an eigenvector.
pub(super) fn complex_enclosure(vector: &Eigenvector, bits: u64) -> Vec<Box2> {
    let (re, im) = vector.place.enclosure(bits);
    let zero = || Interval::point(Rational::from(0));
    let value = |c: &Vec<Rational>| {
        c.iter().rev().fold((zero(), zero()), |s, a| {
            let re_part = &(&(&s.0 * &re) - &(&s.1 * &im)) + &Interval::point(a.clone());
            (re_part, &(&s.0 * &im) + &(&s.1 * &re))
        })
    };
    vector.coordinates.iter().map(value).collect()
}
