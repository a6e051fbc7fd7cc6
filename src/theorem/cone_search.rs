//! Proposals for invariant cones: chords of small cells, pushed outwards and closed under the maps.
#![allow(clippy::float_arithmetic, reason = "proposes rays, exact arithmetic checks them")]

use crate::arith::{Integer, Rational, to_f64};
use crate::linalg::Matrix;
use crate::radius::cone_combination;
use std::cell::Cell;

/// The maps of a curve in coordinates of the relevant spaces, with orientation signs.
pub(super) struct Frame {
    pub states: Vec<usize>,
    pub dims: Vec<usize>,
    pub chords: Vec<Vec<Rational>>,
    /// State, letter, target (both as positions in `states`), signed linear part.
    pub maps: Vec<(usize, usize, usize, Matrix)>,
    /// How much arithmetic the search may still do.
    pub budget: Cell<usize>,
}

impl Frame {
    /// Takes the cost of about one linear program over `rays` out of the budget; `None` where it is spent.
    fn spend(&self, rays: &Rays) -> Option<()> {
        let dim = rays.first().map_or(1, Vec::len);
        let left = self.budget.get().checked_sub(3 * dim * dim * rays.len())?;
        self.budget.set(left);
        Some(())
    }
}

type Rays = Vec<Vec<f64>>;

/// Rays for cones that the maps do not leave, though images may lie on the boundary: chords and the rays to which short cycles
/// pull, closed under the maps.
pub(super) fn propose_closed(frame: &Frame) -> Option<Vec<Vec<Vec<Rational>>>> {
    let mut cones: Vec<Vec<Vec<Rational>>> =
        frame.chords.iter().map(|c| Some(vec![scaled(c)?])).collect::<Option<_>>()?;
    for (state, product) in short_cycles(frame) {
        if let Some(ray) = super::slow::limit_ray(&product, &frame.chords[state]) {
            cones[state].push(scaled(&ray)?);
        }
    }
    for _ in 0..CLOSING_ROUNDS {
        for rays in &mut cones {
            prune_exactly(rays)?;
        }
        let mut grown = false;
        for (from, _, to, matrix) in &frame.maps {
            for ray in cones[*to].clone() {
                let image = scaled(&matrix.apply(&ray))?;
                if super::cone::combine(&cones[*from], &image).is_none() {
                    cones[*from].push(image);
                    grown = true;
                }
            }
        }
        if !grown {
            return Some(cones);
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

/// `None` where the rays lie in no half-space, or are too many.
fn prune_exactly(rays: &mut Vec<Vec<Rational>>) -> Option<()> {
    functional(rays)?;
    let mut k = 0;
    while k < rays.len() && rays.len() > 1 {
        let ray = rays.remove(k);
        if super::cone::combine(rays, &ray).is_none() {
            rays.insert(k, ray);
            k += 1;
        }
    }
    (rays.len() <= MAX_CLOSED_RAYS).then_some(())
}

const MAX_RAYS: usize = 160;

/// How far the cone is thickened, and how far images are pushed when it is closed under the maps.
const STEPS: [(f64, f64); 8] =
    [(0.25, 0.25), (0.25, 0.02), (0.05, 0.002), (0.5, 0.05), (0.01, 1e-3), (0.002, 1e-3), (1.0, 0.02), (5e-4, 1e-4)];

/// Rays for every state; attempts differ in the depth of the chords and in how far rays are pushed.
pub(super) fn propose(frame: &Frame, attempt: usize) -> Option<Vec<Vec<Vec<Rational>>>> {
    let (push, hair) = STEPS[attempt % STEPS.len()];
    let maps: Vec<Vec<Vec<f64>>> = frame.maps.iter().map(|m| floats(&m.3)).collect();
    let mut cones: Vec<Rays> = frame.chords.iter().map(|c| vec![unit(c.iter().map(to_f64).collect())]).collect();
    for _ in 0..(6 + attempt) {
        let old = cones.clone();
        for (map, (from, _, to, _)) in maps.iter().zip(&frame.maps) {
            for ray in &old[*to] {
                add(&mut cones[*from], unit(apply(map, ray)));
            }
        }
        for rays in &mut cones {
            prune(frame, rays)?;
        }
    }
    for (rays, &dim) in cones.iter_mut().zip(&frame.dims) {
        thicken(rays, dim, push);
    }
    let rounds = if frame.dims.iter().any(|d| *d > 5) { 12 } else { 60 };
    for _ in 0..rounds {
        if !close(frame, &maps, &mut cones, hair)? {
            return Some(
                cones.iter().map(|rays| rays.iter().map(|r| r.iter().map(|x| short(*x)).collect()).collect()).collect(),
            );
        }
    }
    None
}

/// Adds images that are not well inside, pushed outwards; `Some(false)` when there was none.
fn close(frame: &Frame, maps: &[Vec<Vec<f64>>], cones: &mut [Rays], push: f64) -> Option<bool> {
    let mut grown = false;
    for (map, (from, _, to, _)) in maps.iter().zip(&frame.maps) {
        for ray in cones[*to].clone() {
            let image = unit(apply(map, &ray));
            frame.spend(&cones[*from])?;
            if !well_inside(&cones[*from], &image, 1e-5) {
                let centre = centre(&cones[*from]);
                let height: f64 = dot(&image, &centre) / dot(&centre, &centre);
                let pushed = image.iter().zip(&centre).map(|(x, c)| x + push * (x - height.max(1e-3) * c)).collect();
                cones[*from].push(unit(pushed));
                grown = true;
            }
        }
        prune(frame, &mut cones[*from])?;
    }
    Some(grown)
}

/// `None` where the rays lie in no half-space, or are too many.
fn prune(frame: &Frame, rays: &mut Rays) -> Option<()> {
    direction(rays)?;
    let mut k = 0;
    while k < rays.len() && rays.len() > 1 {
        frame.spend(rays)?;
        let others: Vec<&[f64]> = rays.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, r)| r.as_slice()).collect();
        if cone_combination(&others, &rays[k]).is_some() {
            rays.remove(k);
        } else {
            k += 1;
        }
    }
    (rays.len() <= MAX_RAYS).then_some(())
}

/// Pushes rays away from the centre and gives the cone an interior.
fn thicken(rays: &mut Rays, dim: usize, push: f64) {
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
    *rays = out;
}

fn well_inside(rays: &Rays, x: &[f64], share: f64) -> bool {
    let c = centre(rays);
    let reduced: Vec<f64> = x.iter().zip(&c).map(|(a, b)| a - share * b).collect();
    let views: Vec<&[f64]> = rays.iter().map(Vec::as_slice).collect();
    cone_combination(&views, &reduced).is_some()
}

fn add(rays: &mut Rays, ray: Vec<f64>) {
    if ray.iter().all(|x| x.is_finite()) && !rays.iter().any(|r| dot(r, &ray) > 1.0 - 1e-14) {
        rays.push(ray);
    }
}

/// A functional that is positive on all rays, by the perceptron rule.
fn direction(rays: &Rays) -> Option<Vec<f64>> {
    let mut f = centre(rays);
    for _ in 0..4000 {
        let size = dot(&f, &f).sqrt();
        match rays.iter().min_by(|a, b| dot(&f, a).total_cmp(&dot(&f, b))) {
            Some(r) if dot(&f, r) <= 1e-4 * size => f.iter_mut().zip(r).for_each(|(a, b)| *a += b),
            _ => return Some(f),
        }
    }
    None
}

/// A functional that is positive on exact rays, if one is found; checked by the caller.
pub(super) fn functional(rays: &[Vec<Rational>]) -> Option<Vec<Rational>> {
    let units: Rays = rays.iter().map(|r| unit(r.iter().map(to_f64).collect())).collect();
    let f: Vec<Rational> = unit(direction(&units)?).into_iter().map(short).collect();
    rays.iter().all(|r| crate::linalg::dot(&f, r) > 0).then_some(f)
}

/// Independent rays whose cone seems to hold `x`.
pub(super) fn carrier(rays: &[Vec<Rational>], x: &[Rational]) -> Option<Vec<usize>> {
    let floats: Rays = rays.iter().map(|r| r.iter().map(to_f64).collect()).collect();
    let views: Vec<&[f64]> = floats.iter().map(Vec::as_slice).collect();
    let x: Vec<f64> = unit(x.iter().map(to_f64).collect());
    let mut chosen: Vec<usize> = cone_combination(&views, &x)?.into_iter().map(|t| t.0).collect();
    // Degenerate solutions use fewer rays than there are coordinates; complete them to a basis.
    let rank =
        |set: &[usize]| Matrix::from_columns(x.len(), &set.iter().map(|k| rays[*k].clone()).collect::<Vec<_>>()).rank();
    for k in 0..rays.len() {
        if chosen.len() < x.len() && !chosen.contains(&k) {
            chosen.push(k);
            if rank(&chosen) < chosen.len() {
                chosen.pop();
            }
        }
    }
    Some(chosen)
}

/// A coefficient that every ray can get in a combination of an inner vector: a proposal.
pub(super) fn share(rays: &[Vec<Rational>], x: &[Rational]) -> Option<Rational> {
    let floats: Vec<f64> = x.iter().map(to_f64).collect();
    let size = dot(&floats, &floats).sqrt();
    if size == 0.0 || rays.is_empty() {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "an exponent")]
    let exponent = (size / rays.len() as f64).log2().floor() as i64 - 2;
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
