//! From a polytope grown in floats to exact data, and the proof that it closes at the radius itself.

use super::System;
use super::grow::{Grown, Inside, Origin};
use super::leading::{Eigenvector, Lower};
use super::polytope::{Inclusion, Point, Polytope};
use super::radial::Radial;
use super::simplex::{Body, Combination, Hull, gauge};
use super::whole::Whole;
use crate::algebraic::Root;
use crate::arith::{Integer, Interval, Rational};
use crate::linalg::{Entry, Matrix};
use malachite_base::num::logic::traits::SignificantBits;

/// Below this gauge an image counts as strictly inside.
pub(super) const STRICT: f64 = 1.0 - 1e-8;

/// A leading word with its eigenvector.
#[derive(Debug, Clone)]
pub struct LeadingVector {
    /// The word.
    pub lower: Lower,
    /// Its eigenvalue of largest modulus.
    pub root: Root,
    /// The eigenvector of the product.
    pub vector: Eigenvector,
}

/// The exact number nearest to a float on the grid `2^-50`.
pub(super) fn grid(x: f64) -> Rational {
    grid_of(x, 50)
}

/// The exact number nearest to a float on the grid of some binary places; what is no number or too large proposes 0.
#[allow(clippy::float_arithmetic, reason = "rounds a proposal to an exact number")]
pub(super) fn grid_of(x: f64, bits: u32) -> Rational {
    let scaled = (x * f64::from(bits).exp2()).round();
    match Rational::try_from(scaled) {
        Ok(whole) if scaled.abs() <= 1e30 => whole / Rational::from(Integer::from(1) << bits),
        _ => Rational::from(0),
    }
}

/// The polytope of rational points with matrices divided by about `radius`; `exact` holds exact points where the radius is rational.
/// `None` where a symmetric body has no interior.
pub(super) fn rational<E: Radial>(
    system: &System<E>,
    grown: &Grown,
    radius: &Rational,
    exact: Option<&[Vec<E>]>,
) -> Option<Polytope<E>> {
    let point = |k: usize| match exact {
        Some(points) => points[k].clone(),
        None => grown.vertices[k].point.iter().map(|x| E::of(&grid(*x))).collect(),
    };
    let points: Vec<Point<E>> =
        (0..grown.vertices.len()).map(|k| Point { state: grown.vertices[k].state, coordinates: point(k) }).collect();
    let bits = places_for(radius);
    // Short coefficients are checked faster; what rounding changes is counted by the bound.
    let whole = if exact.is_some() { radius.clone() } else { Interval::point(radius.clone()).outward(bits).hi };
    let mut inclusions: Vec<Inclusion<E>> = Vec::new();
    for (k, v) in grown.vertices.iter().enumerate() {
        if let Origin::Image { parent, arrow } = v.origin {
            inclusions.push(Inclusion { point: parent, arrow, terms: vec![(k, E::of(&whole))] });
        }
    }
    for inside in &grown.inside {
        let solved = exact.and_then(|_| on_boundary(system, grown.body, &points, inside));
        let (point, arrow) = (inside.vertex, inside.arrow);
        let short = |c: f64| E::of(&Interval::point(grid(c) * radius).outward(bits).hi);
        let terms = solved.unwrap_or_else(|| inside.combination.terms.iter().map(|(k, c)| (*k, short(*c))).collect());
        inclusions.push(Inclusion { point, arrow, terms });
    }
    let axes = if grown.body == Body::Symmetric { axis_terms(system, grown, &points)? } else { Vec::new() };
    let mut polytope = Polytope { body: grown.body, points, inclusions, axes };
    if grown.body == Body::Monotone {
        dominate(system, &mut polytope, bits);
    }
    Some(polytope)
}

/// Binary places of coefficients, about `2^-50` of the radius.
fn places_for(radius: &Rational) -> u64 {
    let (n, d) = (radius.numerator_ref().significant_bits(), radius.denominator_ref().significant_bits());
    (50 + d).saturating_sub(n)
}

/// About the work of checking the data of a polytope, in nanoseconds.
pub(super) fn checking<E: Radial>(system: &System<E>, grown: &Grown) -> u64 {
    let of = |i: &Inside| {
        let n = system.arrows[i.arrow].matrix.rows() as u64;
        2000 + E::PRODUCT * n * (n + i.combination.terms.len() as u64)
    };
    grown.inside.iter().map(of).sum::<u64>() + 3000 * grown.vertices.len() as u64
}

/// Exact coefficients of an image on the boundary.
fn on_boundary<E: Radial>(
    system: &System<E>,
    body: Body,
    points: &[Point<E>],
    inside: &Inside,
) -> Option<Vec<(usize, E)>> {
    if inside.combination.value <= STRICT {
        return None;
    }
    let image = system.arrows[inside.arrow].matrix.apply(&points[inside.vertex].coordinates);
    solve(body, points, &image, &inside.combination)
}

/// Binary places of polished polytopes.
const FINE: u64 = 128;

/// The same symmetric polytope with points and coefficients in many places: points follow their words from exact eigenvectors,
/// coefficients solve for the points that the floats chose.
pub(super) fn polished<E: Radial>(
    system: &System<E>,
    grown: &Grown,
    roots: &[LeadingVector],
    radius: &Lower,
) -> Option<Polytope<E>> {
    let fine = |x: &Rational| Interval::point(x.clone()).outward(FINE).lo;
    let rounded = |x: &E| E::of(&fine(&x.enclosure(2 * FINE).lo));
    let radius = fine(&radius.enclosure(FINE).hi) + Rational::from(1) / Rational::from(Integer::from(1) << FINE);
    let radius = E::of(&radius);
    let mut points: Vec<Point<E>> = Vec::new();
    let mut inclusions: Vec<Inclusion<E>> = Vec::new();
    for (k, v) in grown.vertices.iter().enumerate() {
        let coordinates = match &v.origin {
            Origin::Root(k) => roots[*k].vector.enclosure(FINE + 40).iter().map(|x| E::of(&fine(&x.mid()))).collect(),
            Origin::Axis { axis, exponent } => lifted(&axis_point(system.dims[v.state], *axis, *exponent)),
            Origin::Free(point) => lifted(point),
            Origin::Image { parent, arrow } => {
                inclusions.push(Inclusion { point: *parent, arrow: *arrow, terms: vec![(k, radius.clone())] });
                let image = system.arrows[*arrow].matrix.apply(&points[*parent].coordinates);
                image.iter().map(|x| Some(rounded(&x.over(&radius)?))).collect::<Option<_>>()?
            }
        };
        points.push(Point { state: v.state, coordinates });
    }
    for inside in &grown.inside {
        let image = system.arrows[inside.arrow].matrix.apply(&points[inside.vertex].coordinates);
        let terms = nearest(&points, &image, &inside.combination).map_or_else(
            || inside.combination.terms.iter().map(|(k, c)| (*k, E::of(&grid(*c)).times(&radius))).collect(),
            |terms| terms.iter().map(|(k, c)| (*k, rounded(c))).collect(),
        );
        inclusions.push(Inclusion { point: inside.vertex, arrow: inside.arrow, terms });
    }
    let axes = system.dims.iter().enumerate().map(|(state, &dim)| {
        let short = |unit: Vec<(usize, E)>| unit.into_iter().map(|(k, c)| (k, rounded(&c))).collect();
        Some(solved_axes(grown, &points, state, dim)?.into_iter().map(short).collect())
    });
    let axes = axes.collect::<Option<_>>()?;
    Some(Polytope { body: grown.body, points, inclusions, axes })
}

/// The combination of the points that floats chose which comes nearest to the image; they may be fewer than coordinates.
fn nearest<E: Radial>(points: &[Point<E>], image: &[E], found: &Combination) -> Option<Vec<(usize, E)>> {
    let columns: Vec<Vec<E>> = found.terms.iter().map(|(k, _)| points[*k].coordinates.clone()).collect();
    let a = Matrix::from_columns(image.len(), &columns);
    let right = &a.transpose() * &Matrix::from_columns(image.len(), &[image.to_vec()]);
    let c = (&a.transpose() * &a).solve(&right)?.column(0);
    Some(found.terms.iter().map(|t| t.0).zip(c).collect())
}

/// The coefficients of the basis found, exactly.
fn solve<E: Radial>(body: Body, points: &[Point<E>], image: &[E], found: &Combination) -> Option<Vec<(usize, E)>> {
    let rows: Vec<usize> = match body {
        Body::Symmetric => (0..image.len()).collect(),
        Body::Monotone => (0..image.len()).filter(|i| !found.loose.contains(i)).collect(),
    };
    let columns: Vec<usize> = found.terms.iter().map(|t| t.0).collect();
    let a = Matrix::from_fn(rows.len(), columns.len(), |i, j| points[columns[j]].coordinates[rows[i]].clone());
    let b = Matrix::from_fn(rows.len(), 1, |i, _| image[rows[i]].clone());
    let c = a.solve(&b)?.column(0);
    let terms: Vec<(usize, E)> = columns.into_iter().zip(c).filter(|t| !t.1.is_zero()).collect();
    (body == Body::Symmetric || terms.iter().all(|t| t.1.sign() > 0)).then_some(terms)
}

/// By state and axis: coefficients of the unit vector.
fn axis_terms<E: Radial>(system: &System<E>, grown: &Grown, points: &[Point<E>]) -> Option<Vec<Vec<Vec<(usize, E)>>>> {
    let of_state = |(state, &dim): (usize, &usize)| {
        let proposed: Option<Vec<_>> = (0..dim).map(|axis| unit_terms(grown, state, dim, axis)).collect();
        proposed.or_else(|| solved_axes(grown, points, state, dim))
    };
    system.dims.iter().enumerate().map(of_state).collect()
}

/// Exact coefficients of the unit vectors on a basis of points, for polytopes too thin for floats.
fn solved_axes<E: Radial>(
    grown: &Grown,
    points: &[Point<E>],
    state: usize,
    dim: usize,
) -> Option<Vec<Vec<(usize, E)>>> {
    let chosen = super::grow::spread(grown, state, dim);
    let columns: Vec<Vec<E>> = chosen.iter().map(|k| points[*k].coordinates.clone()).collect();
    let inverse = Matrix::from_columns(dim, &columns).inverse()?;
    Some((0..dim).map(|axis| chosen.iter().copied().zip(inverse.column(axis)).collect()).collect())
}

fn unit_terms<E: Radial>(grown: &Grown, state: usize, dim: usize, axis: usize) -> Option<Vec<(usize, E)>> {
    let here = || grown.vertices.iter().enumerate().filter(|(_, v)| v.state == state);
    let points: Vec<&[f64]> = here().map(|(_, v)| v.point.as_slice()).collect();
    let indices: Vec<usize> = here().map(|(k, _)| k).collect();
    let unit: Vec<f64> = (0..dim).map(|k| f64::from(u8::from(k == axis))).collect();
    let found = gauge(Body::Symmetric, &Hull::of(dim, &points), &unit, 0.0, f64::INFINITY).0;
    found.value.is_finite().then(|| found.terms.into_iter().map(|(k, c)| (indices[k], E::of(&grid(c)))).collect())
}

/// Raises coefficients by a hair where a rounded combination fails to dominate.
fn dominate<E: Radial>(system: &System<E>, polytope: &mut Polytope<E>, bits: u64) {
    let whole = Whole::of(polytope, system);
    for k in 0..polytope.inclusions.len() {
        for hair in [44u64, 36] {
            let below = polytope.rest_size(system, &polytope.inclusions[k], whole.as_ref()).is_some_and(|r| r.1);
            if below {
                break;
            }
            let hair = Rational::from(1) + Rational::from(1) / Rational::from(Integer::from(1) << hair);
            let hair = E::of(&hair);
            let raise = |c: &E| E::of(&c.times(&hair).enclosure(2 * bits).outward(bits).hi);
            polytope.inclusions[k].terms.iter_mut().for_each(|t| t.1 = raise(&t.1));
        }
    }
}

/// The exact vertices for a rational radius.
pub(super) fn exact_points<E: Radial>(
    system: &System<E>,
    grown: &Grown,
    roots: &[LeadingVector],
    radius: &Rational,
) -> Option<Vec<Vec<E>>> {
    let field = E::base(system.arrows.iter().flat_map(|a| a.matrix.entries()));
    let radius = E::of(radius);
    let mut points: Vec<Vec<E>> = Vec::new();
    for v in &grown.vertices {
        points.push(match &v.origin {
            Origin::Root(k) => E::own(&roots[*k].vector, &field)?,
            Origin::Axis { axis, exponent } => lifted(&axis_point(system.dims[v.state], *axis, *exponent)),
            Origin::Free(point) => lifted(point),
            Origin::Image { parent, arrow } => {
                let image = system.arrows[*arrow].matrix.apply(&points[*parent]);
                image.iter().map(|x| x.over(&radius)).collect::<Option<_>>()?
            }
        });
    }
    Some(points)
}

/// A rational vector over another field.
fn lifted<E: Entry>(v: &[Rational]) -> Vec<E> {
    v.iter().map(E::of).collect()
}

pub(super) fn axis_point(dim: usize, axis: usize, exponent: u32) -> Vec<Rational> {
    let length = Rational::from(1) / Rational::from(Integer::from(1) << exponent);
    (0..dim).map(|i| if i == axis { length.clone() } else { Rational::from(0) }).collect()
}
