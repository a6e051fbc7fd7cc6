//! From a polytope grown in floats to exact data, and the proof that it closes at the radius itself.

use super::System;
use super::grow::{Grown, Inside, Origin};
use super::leading::{Eigenvector, Lower, real_sign};
use super::polytope::{Inclusion, Point, Polytope, norm1};
use super::simplex::{Body, Combination, gauge};
use crate::algebraic::{Elem, Root, roots};
use crate::arith::{Integer, Interval, Rational, abs};
use crate::linalg::Matrix;
use crate::poly::{Poly, factor};

/// Below this gauge an image counts as strictly inside.
const STRICT: f64 = 1.0 - 1e-8;

/// A leading word with its eigenvector.
#[derive(Debug, Clone)]
pub struct LeadingVector {
    /// The word and its eigenvalue.
    pub lower: Lower,
    /// The eigenvector of the product.
    pub vector: Eigenvector,
}

/// The exact number nearest to a float on the grid `2^-50`.
pub(super) fn grid(x: f64) -> Rational {
    grid_of(x, 50)
}

/// The exact number nearest to a float on the grid of some binary places; 0 for floats that are too large.
#[allow(clippy::float_arithmetic, reason = "rounds a proposal to an exact number")]
pub(super) fn grid_of(x: f64, bits: u64) -> Rational {
    let scaled = (x * 2f64.powi(i32::try_from(bits).unwrap_or(0))).round();
    if !scaled.is_finite() || scaled.abs() > 1e30 {
        return Rational::from(0);
    }
    Rational::try_from(scaled).unwrap_or_default() / Rational::from(Integer::from(1) << bits)
}

/// The rational polytope with matrices divided by about `radius`; `exact` holds exact points where the radius is rational.
pub(super) fn rational(system: &System, grown: &Grown, radius: &Rational, exact: Option<&[Vec<Rational>]>) -> Polytope {
    let point = |k: usize| match exact {
        Some(points) => points[k].clone(),
        None => grown.vertices[k].point.iter().map(|x| grid(*x)).collect(),
    };
    let points: Vec<Point> =
        (0..grown.vertices.len()).map(|k| Point { state: grown.vertices[k].state, coordinates: point(k) }).collect();
    let mut inclusions: Vec<Inclusion> = Vec::new();
    for (k, v) in grown.vertices.iter().enumerate() {
        if let Origin::Image { parent, arrow } = v.origin {
            inclusions.push(Inclusion { point: parent, arrow, terms: vec![(k, radius.clone())] });
        }
    }
    for inside in &grown.inside {
        inclusions.push(include(system, grown.body, &points, inside, radius, exact.is_some()));
    }
    let axes = if grown.body == Body::Symmetric { axis_terms(system, grown, &points) } else { Vec::new() };
    let mut polytope = Polytope { body: grown.body, points, inclusions, axes };
    if grown.body == Body::Monotone {
        dominate(system, &mut polytope);
    }
    polytope
}

/// Binary places of polished polytopes.
const FINE: u64 = 128;

/// The same symmetric polytope with points and coefficients in many places: points follow their words from exact eigenvectors,
/// coefficients solve for the points that the floats chose.
pub(super) fn polished(system: &System, grown: &Grown, roots: &[LeadingVector], radius: &Lower) -> Polytope {
    let fine = |x: &Rational| Interval::point(x.clone()).outward(FINE).lo;
    let radius = fine(&radius.enclosure(FINE).hi) + Rational::from(1) / Rational::from(Integer::from(1) << FINE);
    let mut points: Vec<Point> = Vec::new();
    let mut inclusions: Vec<Inclusion> = Vec::new();
    for (k, v) in grown.vertices.iter().enumerate() {
        let coordinates = match &v.origin {
            Origin::Root(k) => {
                roots[*k].vector.enclosure(&roots[*k].lower.root, FINE + 40).iter().map(|x| fine(&x.mid())).collect()
            }
            Origin::Axis { axis, exponent } => axis_point(system.dims[v.state], *axis, *exponent),
            Origin::Image { parent, arrow } => {
                inclusions.push(Inclusion { point: *parent, arrow: *arrow, terms: vec![(k, radius.clone())] });
                let image = system.arrows[*arrow].matrix.apply(&points[*parent].coordinates);
                image.iter().map(|x| fine(&(x / &radius))).collect()
            }
        };
        points.push(Point { state: v.state, coordinates });
    }
    for inside in &grown.inside {
        let image = system.arrows[inside.arrow].matrix.apply(&points[inside.vertex].coordinates);
        let terms = nearest(&points, &image, &inside.combination).map_or_else(
            || inside.combination.terms.iter().map(|(k, c)| (*k, grid(*c) * &radius)).collect(),
            |terms| terms.iter().map(|(k, c)| (*k, fine(c))).collect(),
        );
        inclusions.push(Inclusion { point: inside.vertex, arrow: inside.arrow, terms });
    }
    let axes = system.dims.iter().enumerate().map(|(state, &dim)| {
        let solved = solved_axes(grown, &points, state, dim).unwrap_or_default();
        let short = |unit: Vec<(usize, Rational)>| unit.into_iter().map(|(k, c)| (k, fine(&c))).collect();
        solved.into_iter().map(short).collect()
    });
    let axes = axes.collect();
    Polytope { body: grown.body, points, inclusions, axes }
}

/// The combination of the points that floats chose which comes nearest to the image; they may be fewer than coordinates.
fn nearest(points: &[Point], image: &[Rational], found: &Combination) -> Option<Vec<(usize, Rational)>> {
    let columns: Vec<Vec<Rational>> = found.terms.iter().map(|(k, _)| points[*k].coordinates.clone()).collect();
    let a = Matrix::from_columns(image.len(), &columns);
    let right = &a.transpose() * &Matrix::from_columns(image.len(), &[image.to_vec()]);
    let c = (&a.transpose() * &a).solve(&right)?.column(0);
    Some(found.terms.iter().map(|t| t.0).zip(c).collect())
}

fn include(
    system: &System,
    body: Body,
    points: &[Point],
    inside: &Inside,
    radius: &Rational,
    exact: bool,
) -> Inclusion {
    let (point, arrow) = (inside.vertex, inside.arrow);
    if exact && inside.combination.value > STRICT {
        let image = system.arrows[arrow].matrix.apply(&points[point].coordinates);
        if let Some(terms) = solve(body, points, &image, &inside.combination) {
            return Inclusion { point, arrow, terms };
        }
    }
    let terms = inside.combination.terms.iter().map(|(k, c)| (*k, grid(*c) * radius)).collect();
    Inclusion { point, arrow, terms }
}

/// The coefficients of the basis found, exactly.
fn solve(body: Body, points: &[Point], image: &[Rational], found: &Combination) -> Option<Vec<(usize, Rational)>> {
    let rows: Vec<usize> = match body {
        Body::Symmetric => (0..image.len()).collect(),
        Body::Monotone => (0..image.len()).filter(|i| !found.loose.contains(i)).collect(),
    };
    let columns: Vec<usize> = found.terms.iter().map(|t| t.0).collect();
    let a = Matrix::from_fn(rows.len(), columns.len(), |i, j| points[columns[j]].coordinates[rows[i]].clone());
    let b = Matrix::from_fn(rows.len(), 1, |i, _| image[rows[i]].clone());
    let c = a.solve(&b)?.column(0);
    let terms: Vec<(usize, Rational)> = columns.into_iter().zip(c).filter(|t| t.1 != 0).collect();
    (body == Body::Symmetric || terms.iter().all(|t| t.1 > 0)).then_some(terms)
}

fn axis_terms(system: &System, grown: &Grown, points: &[Point]) -> Vec<Vec<Vec<(usize, Rational)>>> {
    let of_state = |(state, &dim): (usize, &usize)| {
        let proposed: Option<Vec<_>> = (0..dim).map(|axis| unit_terms(grown, state, dim, axis)).collect();
        proposed.or_else(|| solved_axes(grown, points, state, dim)).unwrap_or_default()
    };
    system.dims.iter().enumerate().map(of_state).collect()
}

/// Exact coefficients of the unit vectors on a basis of points, for polytopes too thin for floats.
fn solved_axes(grown: &Grown, points: &[Point], state: usize, dim: usize) -> Option<Vec<Vec<(usize, Rational)>>> {
    let chosen = super::grow::spread(grown, state, dim);
    let columns: Vec<Vec<Rational>> = chosen.iter().map(|k| points[*k].coordinates.clone()).collect();
    let inverse = Matrix::from_columns(dim, &columns).inverse()?;
    Some((0..dim).map(|axis| chosen.iter().copied().zip(inverse.column(axis)).collect()).collect())
}

fn unit_terms(grown: &Grown, state: usize, dim: usize, axis: usize) -> Option<Vec<(usize, Rational)>> {
    let here = || grown.vertices.iter().enumerate().filter(|(_, v)| v.state == state);
    let points: Vec<&[f64]> = here().map(|(_, v)| v.point.as_slice()).collect();
    let indices: Vec<usize> = here().map(|(k, _)| k).collect();
    let unit: Vec<f64> = (0..dim).map(|k| f64::from(u8::from(k == axis))).collect();
    let found = gauge(Body::Symmetric, &points, &unit, 0.0);
    found.value.is_finite().then(|| found.terms.into_iter().map(|(k, c)| (indices[k], grid(c))).collect())
}

/// Raises coefficients by a hair where a rounded combination fails to dominate.
fn dominate(system: &System, polytope: &mut Polytope) {
    let hair = Rational::from(1) + Rational::from(1) / Rational::from(Integer::from(1) << 36u64);
    for k in 0..polytope.inclusions.len() {
        let inclusion = &polytope.inclusions[k];
        let arrow = &system.arrows[inclusion.arrow];
        let image = arrow.matrix.apply(&polytope.points[inclusion.point].coordinates);
        let short = (0..image.len()).any(|i| {
            let reach =
                inclusion.terms.iter().fold(Rational::from(0), |s, (q, c)| s + c * &polytope.points[*q].coordinates[i]);
            reach < image[i]
        });
        if short {
            polytope.inclusions[k].terms.iter_mut().for_each(|t| t.1 *= &hair);
        }
    }
}

/// The exact vertices for a rational radius.
pub(super) fn exact_points(
    system: &System,
    grown: &Grown,
    roots: &[LeadingVector],
    radius: &Rational,
) -> Option<Vec<Vec<Rational>>> {
    let mut points: Vec<Vec<Rational>> = Vec::new();
    for v in &grown.vertices {
        points.push(match &v.origin {
            Origin::Root(k) => {
                let r = &roots[*k];
                r.lower.root.rational()?;
                r.vector.enclosure(&r.lower.root, 64).into_iter().map(|x| x.lo).collect()
            }
            Origin::Axis { axis, exponent } => axis_point(system.dims[v.state], *axis, *exponent),
            Origin::Image { parent, arrow } => {
                let image = system.arrows[*arrow].matrix.apply(&points[*parent]);
                image.into_iter().map(|x| x / radius).collect()
            }
        });
    }
    Some(points)
}

pub(super) fn axis_point(dim: usize, axis: usize, exponent: u32) -> Vec<Rational> {
    let length = Rational::from(1) / Rational::from(Integer::from(1) << exponent);
    (0..dim).map(|i| if i == axis { length.clone() } else { Rational::from(0) }).collect()
}

/// Whether the polytope grown closes at the radius itself, an algebraic number.
///
/// Vertices are enclosed by intervals; strictly inner images are checked with the coefficients found, images on the boundary
/// by solving for the coefficients in the field of the radius.
pub(super) fn closes(
    system: &System,
    grown: &Grown,
    polytope: &Polytope,
    leading: &[LeadingVector],
    radius: &Lower,
) -> bool {
    const BITS: u64 = 160;
    let ratio = radius.enclosure(BITS);
    if ratio.lo <= 0 {
        return false;
    }
    let inverse = Interval::new(Rational::from(1) / &ratio.hi, Rational::from(1) / &ratio.lo).outward(BITS);
    let mut enclosures: Vec<Vec<Interval>> = Vec::new();
    for v in &grown.vertices {
        enclosures.push(match &v.origin {
            Origin::Root(k) => leading[*k].vector.enclosure(&leading[*k].lower.root, BITS + 40),
            Origin::Axis { axis, exponent } => {
                axis_point(system.dims[v.state], *axis, *exponent).into_iter().map(Interval::point).collect()
            }
            Origin::Image { parent, arrow } => image(system, *arrow, &enclosures[*parent], &inverse, BITS),
        });
    }
    let Some(interior) = interiors(system, grown, polytope, &enclosures) else { return false };
    let boundary = grown.inside.iter().any(|i| i.combination.value > STRICT);
    let field = if boundary { Field::new(system, grown, leading, &radius.enclosure(96)) } else { None };
    grown.inside.iter().all(|inside| {
        if inside.combination.value > STRICT {
            return field.as_ref().is_some_and(|f| f.reaches(system, grown.body, inside));
        }
        let x = image(system, inside.arrow, &enclosures[inside.vertex], &inverse, BITS);
        let state = system.arrows[inside.arrow].from;
        strictly_inside(grown.body, &x, &inside.combination, &enclosures, interior.get(state))
    })
}

fn image(system: &System, arrow: usize, x: &[Interval], inverse: &Interval, bits: u64) -> Vec<Interval> {
    let matrix = &system.arrows[arrow].matrix;
    let zero = || Interval::point(Rational::from(0));
    (0..matrix.rows())
        .map(|i| {
            let sum = matrix.row(i).iter().zip(x).filter(|(a, _)| **a != 0).fold(zero(), |s, (a, v)| &s + &(v * a));
            (&sum * inverse).outward(bits)
        })
        .collect()
}

/// Bounds `K` with `e_j ∈ K Q` for the true (not rounded) vertices; empty for monotone bodies, whose interior is checked.
fn interiors(system: &System, grown: &Grown, polytope: &Polytope, points: &[Vec<Interval>]) -> Option<Vec<Rational>> {
    if grown.body == Body::Monotone {
        let here = |s: usize| grown.vertices.iter().zip(points).filter(move |(v, _)| v.state == s).map(|(_, p)| p);
        let open = system.dims.iter().enumerate().all(|(s, &dim)| (0..dim).all(|i| here(s).any(|p| p[i].lo > 0)));
        let inside = points.iter().flatten().all(|x| x.lo >= 0 || (x.lo == 0 && x.hi == 0));
        return (open && inside && system.is_nonnegative()).then(Vec::new);
    }
    let mut bounds = Vec::new();
    for (state, &dim) in system.dims.iter().enumerate() {
        let (mut size, mut error) = (Rational::from(0), Rational::from(0));
        for axis in 0..dim {
            let terms = &polytope.axes[state][axis];
            let unit: Vec<Interval> = (0..dim).map(|i| Interval::point(Rational::from(u8::from(i == axis)))).collect();
            error = error.max(distance(&unit, terms, points));
            size = size.max(norm1(&terms.iter().map(|t| t.1.clone()).collect::<Vec<_>>()));
        }
        if error >= 1 {
            return None;
        }
        bounds.push(size / (Rational::from(1) - error));
    }
    Some(bounds)
}

/// An upper bound of `‖x − Σ c q‖_1`.
fn distance(x: &[Interval], terms: &[(usize, Rational)], points: &[Vec<Interval>]) -> Rational {
    let mut rest = x.to_vec();
    for (k, c) in terms {
        for (r, q) in rest.iter_mut().zip(&points[*k]) {
            *r = &*r - &(q * c);
        }
    }
    rest.iter().fold(Rational::from(0), |s, r| s + r.magnitude())
}

fn strictly_inside(
    body: Body,
    x: &[Interval],
    found: &Combination,
    points: &[Vec<Interval>],
    interior: Option<&Rational>,
) -> bool {
    let terms: Vec<(usize, Rational)> = found.terms.iter().map(|(k, c)| (*k, grid(*c))).collect();
    let sum = terms.iter().fold(Rational::from(0), |s, t| s + abs(&t.1));
    match (body, interior) {
        (Body::Symmetric, Some(k)) => sum + k * distance(x, &terms, points) < 1,
        (Body::Monotone, _) => {
            let reach = |i: usize| terms.iter().fold(Rational::from(0), |s, (k, c)| s + c * &points[*k][i].lo);
            // Coefficients are raised to sum 1, which is allowed because they are below it.
            sum < 1
                && terms.iter().all(|t| t.1 >= 0)
                && (0..x.len()).all(|i| x[i].hi <= 0 || (sum > 0 && reach(i) / &sum >= x[i].hi))
        }
        _ => false,
    }
}

/// The field of the radius `ρ`, with all vertices as elements.
struct Field {
    modulus: Poly,
    root: Root,
    points: Vec<Vec<Elem>>,
    inverse: Elem,
}

/// Largest degree of a field in which boundary points are solved.
const MAX_DEGREE: usize = 24;

impl Field {
    fn new(system: &System, grown: &Grown, all: &[LeadingVector], radius: &Interval) -> Option<Self> {
        let mut common = Poly::zero();
        for r in all {
            common = common.gcd(&in_radius(r.lower.root.minpoly().coeffs(), &r.lower));
        }
        let near = |r: &Root| r.is_real() && !r.enclosure(96).0.disjoint(radius);
        let mut candidates: Vec<(Poly, Root)> = Vec::new();
        for (modulus, _) in factor(&common).into_iter().filter(|f| f.0.degree() <= Some(MAX_DEGREE)) {
            candidates.extend(roots(&modulus).into_iter().filter(near).map(|r| (modulus.clone(), r)));
        }
        let [(modulus, root)] = <[_; 1]>::try_from(candidates).ok()?;
        let inverse = Elem::generator(&modulus).inv(&modulus)?;
        let mut field = Self { modulus, root, points: Vec::new(), inverse };
        for v in &grown.vertices {
            let point = match &v.origin {
                Origin::Root(r) => {
                    let reduce = |c: &Vec<Rational>| Elem::reduced(&in_radius(c, &all[*r].lower), &field.modulus);
                    all[*r].vector.coordinates.iter().map(reduce).collect()
                }
                Origin::Axis { axis, exponent } => {
                    axis_point(system.dims[v.state], *axis, *exponent).iter().map(Elem::from_rational).collect()
                }
                Origin::Image { parent, arrow } => field.image(&system.arrows[*arrow].matrix, &field.points[*parent]),
            };
            field.points.push(point);
        }
        Some(field)
    }

    /// `T v / ρ`.
    fn image(&self, matrix: &Matrix, v: &[Elem]) -> Vec<Elem> {
        (0..matrix.rows())
            .map(|i| {
                let row = matrix.row(i).iter().zip(v).filter(|(a, _)| **a != 0);
                row.fold(Elem::zero(), |s, (a, x)| s.add(&x.scale(a))).mul(&self.inverse, &self.modulus)
            })
            .collect()
    }

    /// Whether an image on the boundary is a combination, with `Σ|c| <= 1`, of the points found for it.
    fn reaches(&self, system: &System, body: Body, inside: &Inside) -> bool {
        let x = self.image(&system.arrows[inside.arrow].matrix, &self.points[inside.vertex]);
        let columns: Vec<usize> = inside.combination.terms.iter().map(|t| t.0).collect();
        let rows: Vec<usize> = match body {
            Body::Symmetric => (0..x.len()).collect(),
            Body::Monotone => (0..x.len()).filter(|i| !inside.combination.loose.contains(i)).collect(),
        };
        let Some(c) = self.solve(&rows, &columns, &x) else { return false };
        let signs: Vec<i32> = c.iter().map(|e| e.sign(&self.root)).collect();
        let sum = c.iter().zip(&signs).fold(Elem::zero(), |s, (e, sign)| s.add(&e.scale(&Rational::from(*sign))));
        let small = sum.sub(&Elem::from_rational(&Rational::from(1))).sign(&self.root) <= 0;
        let dominates = |i: usize| {
            let reach = columns
                .iter()
                .zip(&c)
                .fold(Elem::zero(), |s, (k, e)| s.add(&e.mul(&self.points[*k][i], &self.modulus)));
            reach.sub(&x[i]).sign(&self.root) >= 0
        };
        small && (body == Body::Symmetric || (signs.iter().all(|s| *s >= 0) && (0..x.len()).all(dominates)))
    }

    /// The solution of `Σ c_k q_k = x` on some rows, if there is one and it is unique.
    fn solve(&self, rows: &[usize], columns: &[usize], x: &[Elem]) -> Option<Vec<Elem>> {
        let mut a: Vec<Vec<Elem>> = rows
            .iter()
            .map(|&i| columns.iter().map(|&k| self.points[k][i].clone()).chain([x[i].clone()]).collect())
            .collect();
        for col in 0..columns.len() {
            let found = (col..a.len()).find(|&r| !a[r][col].is_zero())?;
            a.swap(col, found);
            let inverse = a[col][col].inv(&self.modulus)?;
            a[col] = a[col].iter().map(|e| e.mul(&inverse, &self.modulus)).collect();
            let pivot = a[col].clone();
            for (_, row) in a.iter_mut().enumerate().filter(|(r, row)| *r != col && !row[col].is_zero()) {
                let factor = row[col].clone();
                *row = row.iter().zip(&pivot).map(|(e, p)| e.sub(&factor.mul(p, &self.modulus))).collect();
            }
        }
        let consistent = a[columns.len()..].iter().all(|row| row[columns.len()].is_zero());
        consistent.then(|| a[..columns.len()].iter().map(|row| row[columns.len()].clone()).collect())
    }
}

/// `c(μ)` as a polynomial in the radius `ρ`, `μ = ± ρ^length`.
fn in_radius(coeffs: &[Rational], lower: &Lower) -> Poly {
    let negative = real_sign(&lower.root) < 0;
    let mut out = vec![Rational::from(0); coeffs.len().saturating_sub(1) * lower.length + 1];
    for (k, c) in coeffs.iter().enumerate() {
        out[k * lower.length] = if negative && k % 2 == 1 { -c } else { c.clone() };
    }
    Poly::new(out)
}
