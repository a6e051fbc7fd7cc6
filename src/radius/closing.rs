//! The proof that a polytope grown in floats closes at the radius itself, an algebraic number that is only enclosed.
//!
//! An image that comes back to a leading eigenvector along its word is that eigenvector again, up to its sign, by definition;
//! all others should lie strictly inside, which intervals show. Where an image lies on the boundary otherwise, coefficients
//! are solved for in the field of the radius.

use super::System;
use super::budget::Budget;
use super::exact::{LeadingVector, STRICT, axis_point, grid};
use super::fixed::{Fixed, PLACES, Scaled, coefficient, distance, total};
use super::grow::{Grown, Inside, Origin};
use super::leading::Lower;
use super::polytope::Polytope;
use super::radial::Radial;
use super::radius_field::Field;
use super::simplex::{Body, Combination};
use crate::arith::{Integer, Rational};

/// What is to be closed.
pub struct Closing<'a, E = Rational> {
    pub(super) system: &'a System<E>,
    pub(super) grown: &'a Grown,
    pub(super) polytope: &'a Polytope<E>,
    /// The words that attain the radius, at whose eigenvectors the polytope begins.
    pub(super) roots: &'a [LeadingVector],
    pub(super) radius: &'a Lower,
    pub(super) budget: &'a Budget<'a>,
}

impl<E: Radial> Closing<'_, E> {
    /// Whether all images of the true vertices, divided by the radius, lie in the hull of the true vertices.
    pub fn holds(&self) -> bool {
        self.check() == Some(true)
    }

    fn check(&self) -> Option<bool> {
        let radius = self.radius.enclosure(PLACES + 20);
        let maps: Vec<Scaled> =
            self.system.arrows.iter().map(|a| Scaled::new(&a.matrix, &radius)).collect::<Option<_>>()?;
        let points = self.points(&maps)?;
        let interior = self.interiors(&points)?;
        let open: Vec<&Inside> = self.grown.inside.iter().filter(|i| !self.returns(i)).collect();
        let boundary = open.iter().any(|i| i.combination.value > STRICT);
        let field = if boundary { Some(Field::new(self)?) } else { None };
        for inside in open {
            if !self.budget.spend(self.cost(inside)) {
                return None;
            }
            let fine = match &field {
                Some(field) if inside.combination.value > STRICT => field.reaches(inside)?,
                _ => {
                    let x = maps[inside.arrow].image(&points[inside.vertex]);
                    let state = self.system.arrows[inside.arrow].from;
                    strictly_inside(self.grown.body, &x, &inside.combination, &points, interior.get(state))?
                }
            };
            if !fine {
                return Some(false);
            }
        }
        Some(true)
    }

    /// Nanoseconds of one image: sums of products of long integers.
    fn cost(&self, inside: &Inside) -> u64 {
        let n = self.system.arrows[inside.arrow].matrix.rows() as u64;
        150 * n * (n + inside.combination.terms.len() as u64)
    }

    /// Enclosures of the true vertices.
    fn points(&self, maps: &[Scaled]) -> Option<Vec<Vec<Fixed>>> {
        let mut points: Vec<Vec<Fixed>> = Vec::new();
        for v in &self.grown.vertices {
            let n = self.system.dims[v.state] as u64;
            if !self.budget.spend(150 * n * n) {
                return None;
            }
            points.push(match &v.origin {
                Origin::Root(k) => self.roots[*k].vector.enclosure(PLACES + 40).iter().map(Fixed::of).collect(),
                Origin::Axis { axis, exponent } => {
                    axis_point(self.system.dims[v.state], *axis, *exponent).iter().map(Fixed::point).collect()
                }
                Origin::Free(point) => point.iter().map(Fixed::point).collect(),
                Origin::Image { parent, arrow } => maps[*arrow].image(&points[*parent]),
            });
        }
        Some(points)
    }

    /// Bounds `K` with `e_j ∈ K Q` for the true (not rounded) vertices; empty for monotone bodies, whose interior is checked.
    fn interiors(&self, points: &[Vec<Fixed>]) -> Option<Vec<Rational>> {
        let dims = self.system.dims.iter().enumerate();
        if self.grown.body == Body::Monotone {
            let here =
                |s: usize| self.grown.vertices.iter().zip(points).filter(move |(v, _)| v.state == s).map(|(_, p)| p);
            let open = dims.clone().all(|(s, &dim)| (0..dim).all(|i| here(s).any(|p| p[i].lo > 0)));
            let inside = points.iter().flatten().all(|x| x.lo >= 0);
            return (open && inside && self.system.is_nonnegative()).then(Vec::new);
        }
        let mut bounds = Vec::new();
        for (state, &dim) in dims {
            let (mut size, mut error) = (Rational::from(0), Rational::from(0));
            for (axis, terms) in self.polytope.axes.get(state).filter(|a| a.len() == dim)?.iter().enumerate() {
                let one = Fixed::point(&Rational::from(1));
                let unit: Vec<Fixed> = (0..dim).map(|i| if i == axis { one.clone() } else { Fixed::zero() }).collect();
                // Long coefficients are rounded; what that changes is seen in the distance.
                let terms: Vec<(usize, Rational)> = terms
                    .iter()
                    .map(|(k, c)| (*k, c.enclosure(PLACES).outward(super::fixed::COEFFICIENT).lo))
                    .collect();
                error = error.max(distance(&unit, &whole(&terms)?, points));
                size = size.max(total(&terms));
            }
            if error >= 1 {
                return None;
            }
            bounds.push(size / (Rational::from(1) - error));
        }
        Some(bounds)
    }

    /// Whether the image is a leading eigenvector again: the path from it, with the arrow in front, is its word.
    fn returns(&self, inside: &Inside) -> bool {
        let mut arrows = vec![inside.arrow];
        let mut current = inside.vertex;
        while let Origin::Image { parent, arrow } = self.grown.vertices[current].origin {
            arrows.push(arrow);
            current = parent;
        }
        let Origin::Root(k) = self.grown.vertices[current].origin else { return false };
        arrows == self.roots[k].lower.path
    }
}

fn whole(terms: &[(usize, Rational)]) -> Option<Vec<(usize, Integer)>> {
    terms.iter().map(|(k, c)| Some((*k, coefficient(c)?))).collect()
}

fn strictly_inside(
    body: Body,
    x: &[Fixed],
    found: &Combination,
    points: &[Vec<Fixed>],
    interior: Option<&Rational>,
) -> Option<bool> {
    let terms: Vec<(usize, Rational)> = found.terms.iter().map(|(k, c)| (*k, grid(*c))).collect();
    let sum = total(&terms);
    let terms = whole(&terms)?;
    if body == Body::Symmetric {
        return Some(sum + interior? * distance(x, &terms, points) < 1);
    }
    // Coefficients are raised to sum 1, which is allowed because they are below it.
    let total = terms.iter().fold(Integer::from(0), |s, t| s + &t.1);
    let reach = |i: usize| terms.iter().fold(Integer::from(0), |s, (k, c)| s + c * &points[*k][i].lo);
    let covered = |i: usize| x[i].hi <= 0 || reach(i) >= &x[i].hi * &total;
    Some(sum < 1 && terms.iter().all(|t| t.1 >= 0) && (0..x.len()).all(covered))
}
