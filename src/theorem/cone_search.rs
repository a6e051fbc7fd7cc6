//! Proposals for invariant cones: chords of small cells, pushed outwards and closed under the maps.
#![allow(clippy::float_arithmetic, reason = "proposes rays, exact arithmetic checks them")]

use crate::arith::{Integer, Rational, to_f64};
use crate::linalg::Matrix;
use crate::radius::{ConeBasis, InCone, cone_combination, in_cone, tells_apart};
use std::cell::Cell;
use std::collections::BTreeMap;

/// The maps of a curve in coordinates of the relevant spaces, with orientation signs.
pub(super) struct Frame {
    pub states: Vec<usize>,
    pub dims: Vec<usize>,
    pub chords: Vec<Vec<Rational>>,
    /// State, letter, target (both as positions in `states`), signed linear part.
    pub maps: Vec<(usize, usize, usize, Matrix)>,
    /// How much arithmetic each of the two searches may do.
    pub steps: usize,
    /// What is left of it.
    pub budget: Cell<usize>,
}

impl Frame {
    /// Takes the cost of about one linear program over `rays` out of the budget; `None` where it is spent.
    fn spend(&self, rays: &Rays) -> Option<()> {
        self.spend_times(1, rays)
    }

    fn spend_times(&self, factor: usize, rays: &Rays) -> Option<()> {
        let dim = rays.first().map_or(1, Vec::len);
        let left = self.budget.get().checked_sub(3 * factor * dim * dim * rays.len())?;
        self.budget.set(left);
        Some(())
    }
}

/// How much more a combination costs than a linear program, when it is exact.
const EXACT: usize = 20;

type Rays = Vec<Vec<f64>>;

/// Rays for cones that the maps do not leave, though images may lie on the boundary: chords and the rays to which short cycles
/// pull, closed under the maps.
pub(super) fn propose_closed(frame: &Frame) -> Option<Vec<Vec<Vec<Rational>>>> {
    let chord = |c: &Vec<Rational>| Some(ExactRays::of(vec![scaled(c)?]));
    let mut cones: Vec<ExactRays> = frame.chords.iter().map(chord).collect::<Option<_>>()?;
    for (state, product) in short_cycles(frame) {
        if let Some(ray) = super::slow::limit_ray(&product, &frame.chords[state]) {
            cones[state].push(scaled(&ray)?);
        }
    }
    frame.budget.set(frame.steps);
    // Rays up to this number have their images by a map in the cone, which only grows.
    let mut mapped = vec![0; frame.maps.len()];
    for _ in 0..CLOSING_ROUNDS {
        for rays in &mut cones {
            rays.prune(frame)?;
        }
        let mut grown = false;
        for ((from, _, to, matrix), mapped) in frame.maps.iter().zip(&mut mapped) {
            let next = cones[*to].fan.next;
            for ray in cones[*to].newer(*mapped) {
                let image = scaled(&matrix.apply(&ray))?;
                frame.spend_times(EXACT, &cones[*from].fan.rays)?;
                if cones[*from].combine(&image).is_none() {
                    cones[*from].push(image);
                    grown = true;
                }
            }
            *mapped = next;
        }
        if !grown {
            return Some(cones.into_iter().map(|c| c.rays).collect());
        }
    }
    None
}

const CLOSING_ROUNDS: usize = 12;
const MAX_CLOSED_RAYS: usize = 24;

/// The products of the cycles of up to three letters, by position of the state.
fn short_cycles(frame: &Frame) -> Vec<(usize, Matrix)> {
    let mut found = Vec::new();
    let start = |s: usize| (s, s, Matrix::identity(frame.dims[s]));
    let mut layer: Vec<(usize, usize, Matrix)> = (0..frame.dims.len()).map(start).collect();
    for _ in 0..3 {
        let mut longer = Vec::new();
        for (home, at, product) in &layer {
            for (_, _, to, matrix) in frame.maps.iter().filter(|m| m.0 == *at) {
                longer.push((*home, *to, product * matrix));
            }
        }
        found.extend(longer.iter().filter(|(home, at, _)| home == at).map(|(home, _, p)| (*home, p.clone())));
        layer = longer;
        if layer.len() > 100 {
            break;
        }
    }
    found
}

/// The vector divided by its largest entry in absolute value; `None` for 0.
fn scaled(v: &[Rational]) -> Option<Vec<Rational>> {
    let largest = v.iter().map(crate::arith::abs).max().filter(|x| *x > 0)?;
    Some(v.iter().map(|x| x / &largest).collect())
}

/// Exact rays, with floats beside them.
pub(super) struct ExactRays {
    pub rays: Vec<Vec<Rational>>,
    fan: Fan,
}

impl ExactRays {
    pub fn of(rays: Vec<Vec<Rational>>) -> Self {
        let fan = Fan::of(rays.iter().map(|r| r.iter().map(to_f64).collect()).collect());
        Self { rays, fan }
    }

    fn push(&mut self, ray: Vec<Rational>) {
        self.fan.push(ray.iter().map(to_f64).collect());
        self.rays.push(ray);
    }

    /// The rays with at least a number.
    fn newer(&self, number: usize) -> Vec<Vec<Rational>> {
        self.fan.names.iter().zip(&self.rays).filter(|(n, _)| **n >= number).map(|(_, r)| r.clone()).collect()
    }

    /// Nonnegative exact coefficients of a vector of the cone.
    pub fn combine(&self, x: &[Rational]) -> Option<Vec<Rational>> {
        let all: Vec<usize> = (0..self.rays.len()).collect();
        self.combine_by(&all, x).ok()
    }

    /// The same with some of the rays; a functional that tells the vector from them, where one was found instead.
    fn combine_by(&self, used: &[usize], x: &[Rational]) -> Result<Vec<Rational>, Option<Vec<f64>>> {
        let basis = self.carrier(used, x)?;
        let columns: Vec<Vec<Rational>> = basis.iter().map(|k| self.rays[*k].clone()).collect();
        let right = Matrix::from_columns(x.len(), &[x.to_vec()]);
        let solution = Matrix::from_columns(x.len(), &columns).solve(&right).ok_or(None)?.column(0);
        let mut out = vec![Rational::from(0); self.rays.len()];
        for (k, c) in basis.into_iter().zip(solution) {
            if c < 0 {
                return Err(None);
            }
            out[k] = c;
        }
        Ok(out)
    }

    /// Independent rays, of those that may be used, whose cone seems to hold `x`.
    fn carrier(&self, used: &[usize], x: &[Rational]) -> Result<Vec<usize>, Option<Vec<f64>>> {
        let views: Vec<&[f64]> = used.iter().map(|k| self.fan.rays[*k].as_slice()).collect();
        let point: Vec<f64> = unit(x.iter().map(to_f64).collect());
        let terms = match in_cone(&views, &point) {
            InCone::Inside { terms, .. } => terms,
            InCone::Outside(functional) => return Err(Some(functional)),
        };
        let chosen: Vec<usize> = terms.into_iter().map(|t| used[t.0]).collect();
        if chosen.len() >= x.len() {
            return Ok(chosen);
        }
        // Degenerate solutions use fewer rays than there are coordinates; complete them to a basis.
        let rest = used.iter().filter(|k| !chosen.contains(k));
        let order: Vec<usize> = chosen.iter().chain(rest).copied().collect();
        let columns: Vec<Vec<Rational>> = order.iter().map(|k| self.rays[*k].clone()).collect();
        let pivots = Matrix::from_columns(x.len(), &columns).independent_columns();
        let independent = (0..chosen.len()).all(|k| pivots.get(k) == Some(&k));
        Ok(if independent { pivots.into_iter().map(|p| order[p]).collect() } else { chosen })
    }

    /// Removes the rays that the others combine; `None` where the rays lie in no half-space, or are too many.
    fn prune(&mut self, frame: &Frame) -> Option<()> {
        let positive: Vec<f64> = functional(&self.rays)?.iter().map(to_f64).collect();
        let mut k = 0;
        while k < self.rays.len() && self.rays.len() > 1 {
            let others: Vec<usize> = (0..self.rays.len()).filter(|j| *j != k).collect();
            if self.fan.is_apart(k) {
                k += 1;
                continue;
            }
            frame.spend_times(EXACT, &self.fan.rays)?;
            match self.combine_by(&others, &self.rays[k]) {
                Ok(_) => {
                    self.rays.remove(k);
                    self.fan.remove(k);
                }
                Err(functional) => {
                    self.fan.apart[k] = functional.map(|f| tilted(&f, &positive, &self.fan.rays[k]));
                    k += 1;
                }
            }
        }
        (self.rays.len() <= MAX_CLOSED_RAYS).then_some(())
    }
}

const MAX_RAYS: usize = 160;

/// How far the cone is thickened, and how far images are pushed when it is closed under the maps.
const STEPS: [(f64, f64); 8] =
    [(0.25, 0.25), (0.25, 0.02), (0.05, 0.002), (0.5, 0.05), (0.01, 1e-3), (0.002, 1e-3), (1.0, 0.02), (5e-4, 1e-4)];

/// Unit rays of a cone, with what is known of them from earlier linear programs.
#[derive(Default)]
struct Fan {
    rays: Rays,
    /// For each ray a functional that tells it from the others, once one was found.
    apart: Vec<Option<Vec<f64>>>,
    /// Numbers of the rays, which stay the same when others go.
    names: Vec<usize>,
    next: usize,
}

impl Fan {
    fn of(rays: Rays) -> Self {
        let mut fan = Self::default();
        rays.into_iter().for_each(|r| fan.push(r));
        fan
    }

    fn push(&mut self, ray: Vec<f64>) {
        self.rays.push(ray);
        self.apart.push(None);
        self.names.push(self.next);
        self.next += 1;
    }

    fn add(&mut self, ray: Vec<f64>) {
        if ray.iter().all(|x| x.is_finite()) && !self.rays.iter().any(|r| dot(r, &ray) > 1.0 - 1e-14) {
            self.push(ray);
        }
    }

    /// Removes the rays that the others combine; `None` where the rays lie in no half-space, or are too many.
    fn prune(&mut self, frame: &Frame) -> Option<()> {
        let positive = direction(&self.rays)?;
        let mut k = 0;
        while k < self.rays.len() && self.rays.len() > 1 {
            frame.spend(&self.rays)?;
            if self.is_extreme(k, &positive) {
                k += 1;
            } else {
                self.remove(k);
            }
        }
        (self.rays.len() <= MAX_RAYS).then_some(())
    }

    fn remove(&mut self, k: usize) {
        self.rays.remove(k);
        self.apart.remove(k);
        self.names.remove(k);
    }

    fn others(&self, k: usize) -> Vec<&[f64]> {
        self.rays.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, r)| r.as_slice()).collect()
    }

    /// Whether the functional that was found for a ray still tells it from the others.
    fn is_apart(&self, k: usize) -> bool {
        self.apart[k].as_ref().is_some_and(|f| tells_apart(f, &self.others(k), &self.rays[k]))
    }

    fn is_extreme(&mut self, k: usize, positive: &[f64]) -> bool {
        if self.is_apart(k) {
            return true;
        }
        let InCone::Outside(functional) = in_cone(&self.others(k), &self.rays[k]) else { return false };
        self.apart[k] = Some(tilted(&functional, positive, &self.rays[k]));
        true
    }

    /// Whether a vector stays in the cone when a share of the centre is taken from it; `known` is the basis that showed it last.
    fn well_inside(&self, x: &[f64], share: f64, known: &mut Option<Basis>) -> bool {
        let c = centre(&self.rays);
        let reduced: Vec<f64> = x.iter().zip(&c).map(|(a, b)| a - share * b).collect();
        if known.as_ref().is_some_and(|b| b.stays(&self.names) && b.basis.combines(&reduced)) {
            return true;
        }
        let views: Vec<&[f64]> = self.rays.iter().map(Vec::as_slice).collect();
        let InCone::Inside { basis, .. } = in_cone(&views, &reduced) else { return false };
        *known = basis.map(|basis| Basis { names: basis.rays.iter().map(|k| self.names[*k]).collect(), basis });
        true
    }
}

/// A basis of rays by their numbers.
struct Basis {
    names: Vec<usize>,
    basis: ConeBasis,
}

impl Basis {
    /// Whether all its rays are still there; `names` ascend.
    fn stays(&self, names: &[usize]) -> bool {
        self.names.iter().all(|n| names.binary_search(n).is_ok())
    }
}

/// Rays for every state; attempts differ in the depth of the chords and in how far rays are pushed.
pub(super) fn propose(frame: &Frame, attempt: usize) -> Option<Vec<Vec<Vec<Rational>>>> {
    let (push, hair) = STEPS[attempt % STEPS.len()];
    let maps: Vec<Vec<Vec<f64>>> = frame.maps.iter().map(|m| floats(&m.3)).collect();
    let chord = |c: &Vec<Rational>| Fan::of(vec![unit(c.iter().map(to_f64).collect())]);
    let mut cones: Vec<Fan> = frame.chords.iter().map(chord).collect();
    for _ in 0..(6 + attempt) {
        let old: Vec<Rays> = cones.iter().map(|fan| fan.rays.clone()).collect();
        for (map, (from, _, to, _)) in maps.iter().zip(&frame.maps) {
            for ray in &old[*to] {
                cones[*from].add(unit(apply(map, ray)));
            }
        }
        for fan in &mut cones {
            fan.prune(frame)?;
        }
    }
    for (fan, &dim) in cones.iter_mut().zip(&frame.dims) {
        *fan = Fan::of(thickened(&fan.rays, dim, push));
    }
    let rounds = if frame.dims.iter().any(|d| *d > 5) { 12 } else { 60 };
    let mut known = BTreeMap::new();
    for _ in 0..rounds {
        if !close(frame, &maps, &mut cones, hair, &mut known)? {
            let exact = |fan: &Fan| fan.rays.iter().map(|r| r.iter().map(|x| short(*x)).collect()).collect();
            return Some(cones.iter().map(exact).collect());
        }
    }
    None
}

/// By map and number of a ray: the basis that combines the image.
type Known = BTreeMap<(usize, usize), Option<Basis>>;

/// Adds images that are not well inside, pushed outwards; `Some(false)` when there was none.
fn close(frame: &Frame, maps: &[Vec<Vec<f64>>], cones: &mut [Fan], push: f64, known: &mut Known) -> Option<bool> {
    let mut grown = false;
    for (m, (map, (from, _, to, _))) in maps.iter().zip(&frame.maps).enumerate() {
        for (name, ray) in cones[*to].names.clone().into_iter().zip(cones[*to].rays.clone()) {
            let image = unit(apply(map, &ray));
            frame.spend(&cones[*from].rays)?;
            if !cones[*from].well_inside(&image, 1e-5, known.entry((m, name)).or_default()) {
                let centre = centre(&cones[*from].rays);
                let height: f64 = dot(&image, &centre) / dot(&centre, &centre);
                let pushed = image.iter().zip(&centre).map(|(x, c)| x + push * (x - height.max(1e-3) * c)).collect();
                cones[*from].push(unit(pushed));
                grown = true;
            }
        }
        cones[*from].prune(frame)?;
    }
    Some(grown)
}

/// Rays pushed away from the centre, with some more that give the cone an interior.
fn thickened(rays: &Rays, dim: usize, push: f64) -> Rays {
    let c = centre(rays);
    let mut out: Rays =
        rays.iter().map(|r| unit(r.iter().zip(&c).map(|(x, m)| x + push * (x - m)).collect())).collect();
    if dim > 1 {
        for axis in 0..dim {
            for sign in [-0.5, 0.5] {
                let mut r = c.clone();
                r[axis] += sign * push;
                out.push(unit(r));
            }
        }
    }
    out
}

/// A unit functional that is positive at a ray and, unlike the one given, clearly negative on the other rays: half of its value
/// at the ray is taken off by a functional that is positive on all rays.
fn tilted(functional: &[f64], positive: &[f64], ray: &[f64]) -> Vec<f64> {
    let share = 0.5 * dot(functional, ray) / dot(positive, ray);
    unit(functional.iter().zip(positive).map(|(f, p)| f - share * p).collect())
}

/// A functional that is positive on all rays, by the perceptron rule.
fn direction(rays: &Rays) -> Option<Vec<f64>> {
    let mut f = centre(rays);
    for round in 0..4000 {
        let size = dot(&f, &f).sqrt();
        let values = rays.iter().map(|r| (r, dot(&f, r)));
        match values.min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((r, value)) if value <= 1e-4 * size => f.iter_mut().zip(r).for_each(|(a, b)| *a += b),
            _ => return Some(f),
        }
        if round == PATIENCE && balanced(rays) {
            return None;
        }
    }
    None
}

/// After how many steps it is asked whether there is a functional at all.
const PATIENCE: usize = 40;

/// Whether a convex combination of the rays seems to be 0, so that no functional is positive on all of them.
fn balanced(rays: &Rays) -> bool {
    let lifted: Rays = rays.iter().map(|r| r.iter().copied().chain([1.0]).collect()).collect();
    let views: Vec<&[f64]> = lifted.iter().map(Vec::as_slice).collect();
    let mut top = vec![0.0; rays.first().map_or(0, Vec::len)];
    top.push(1.0);
    cone_combination(&views, &top).is_some()
}

/// A functional that is positive on exact rays, if one is found; checked by the caller.
pub(super) fn functional(rays: &[Vec<Rational>]) -> Option<Vec<Rational>> {
    let units: Rays = rays.iter().map(|r| unit(r.iter().map(to_f64).collect())).collect();
    let f: Vec<Rational> = unit(direction(&units)?).into_iter().map(short).collect();
    rays.iter().all(|r| crate::linalg::dot(&f, r) > 0).then_some(f)
}

/// A coefficient that every ray can get in a combination of an inner vector: a proposal.
pub(super) fn share(rays: usize, x: &[Rational]) -> Option<Rational> {
    let floats: Vec<f64> = x.iter().map(to_f64).collect();
    let size = dot(&floats, &floats).sqrt();
    if size == 0.0 || rays == 0 {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "an exponent")]
    let exponent = (size / rays as f64).log2().floor() as i64 - 2;
    Some(if exponent >= 0 {
        Rational::from(1) << exponent.unsigned_abs()
    } else {
        Rational::from(1) >> exponent.unsigned_abs()
    })
}

fn short(x: f64) -> Rational {
    let scaled = Rational::try_from((x * 2f64.powi(20)).round()).unwrap_or_else(|_| Rational::from(0));
    scaled / Rational::from(Integer::from(1) << 20u64)
}

fn centre(rays: &Rays) -> Vec<f64> {
    let n = rays.first().map_or(0, Vec::len);
    (0..n).map(|i| rays.iter().map(|r| r[i]).sum::<f64>() / rays.len().max(1) as f64).collect()
}

fn unit(v: Vec<f64>) -> Vec<f64> {
    let size = dot(&v, &v).sqrt();
    v.into_iter().map(|x| x / size).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn floats(m: &Matrix) -> Vec<Vec<f64>> {
    (0..m.rows()).map(|i| m.row(i).iter().map(to_f64).collect()).collect()
}

fn apply(m: &[Vec<f64>], v: &[f64]) -> Vec<f64> {
    m.iter().map(|row| dot(row, v)).collect()
}
