//! Invariant polytopes as plain exact data, and what they prove.

use super::System;
use super::radial::upper;
use super::simplex::Body;
use super::whole::Whole;
use crate::arith::{Integer, Rational};
use crate::linalg::Entry;

/// A vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Point<E = Rational> {
    /// The state in whose space it lies.
    pub state: usize,
    /// Its coordinates.
    pub coordinates: Vec<E>,
}

/// The proof that a matrix maps a point into a multiple of the polytope: `T p = Σ c_k q_k + e` with a small rest `e`
/// (of a monotone body: `T p <= Σ c_k q_k`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inclusion<E = Rational> {
    /// Index of the point.
    pub point: usize,
    /// Position of the arrow.
    pub arrow: usize,
    /// Index of a point of the arrow's state, and its coefficient.
    pub terms: Vec<(usize, E)>,
}

/// One polytope for every state, with the inclusions of all images.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Polytope<E = Rational> {
    /// What is meant by the hull of the points.
    pub body: Body,
    /// The points of all states.
    pub points: Vec<Point<E>>,
    /// For every point and every arrow that ends in its state, an inclusion.
    pub inclusions: Vec<Inclusion<E>>,
    /// For every state and axis, coefficients that nearly combine the unit vector from points of the state
    /// (symmetric bodies only): they show that the polytope has an interior.
    pub axes: Vec<Vec<Vec<(usize, E)>>>,
}

impl<E: Entry> Polytope<E> {
    /// The smallest `r` for which the data prove `T Q ⊂ r Q` for all arrows, or `None` where they prove nothing.
    ///
    /// For a symmetric body with points `q`: every unit vector lies in `K Q`, where with `e_j = Σ d_k q_k + s_j`,
    /// `K = max Σ|d| / (1 − max ‖s_j‖_1)`; then `T p ∈ (Σ|c| + K ‖e‖_1) Q`. For a monotone body all matrices and points are
    /// nonnegative, some point of the state is positive at every coordinate, and `T p <= Σ c q` gives `r = Σ c`.
    #[must_use]
    pub fn bound(&self, system: &System<E>) -> Option<Rational> {
        let fits = |p: &Point<E>| system.dims.get(p.state) == Some(&p.coordinates.len());
        if !self.points.iter().all(fits) {
            return None;
        }
        let scale: Vec<Rational> = match self.body {
            Body::Symmetric => (0..system.dims.len()).map(|s| self.axis_bound(system, s)).collect::<Option<_>>()?,
            Body::Monotone => self.monotone_interior(system)?,
        };
        let mut covered = 0;
        let mut bound = Rational::from(0);
        let mut seen = std::collections::BTreeSet::new();
        let whole = Whole::of(self, system);
        for inclusion in &self.inclusions {
            let arrow = system.arrows.get(inclusion.arrow)?;
            let point = self.points.get(inclusion.point)?;
            let own = |t: &(usize, E)| self.points.get(t.0).is_some_and(|p| p.state == arrow.from);
            let fits = point.state == arrow.to && inclusion.terms.iter().all(own);
            if !fits || !seen.insert((inclusion.point, inclusion.arrow)) {
                return None;
            }
            let (size, below) = self.rest_size(system, inclusion, whole.as_ref())?;
            let mut sum = total(&inclusion.terms);
            match self.body {
                Body::Symmetric => sum += &scale[arrow.from] * size,
                Body::Monotone if below && inclusion.terms.iter().all(|t| t.1.sign() >= 0) => {}
                Body::Monotone => return None,
            }
            bound = bound.max(sum);
            covered += 1;
        }
        let needed: usize = self.points.iter().map(|p| system.arrows.iter().filter(|a| a.to == p.state).count()).sum();
        (covered == needed).then_some(bound)
    }

    /// The 1-norm of `T p − Σ c q`, and whether all its coordinates are at most 0.
    pub(super) fn rest_size(
        &self,
        system: &System<E>,
        inclusion: &Inclusion<E>,
        whole: Option<&Whole>,
    ) -> Option<(Rational, bool)> {
        if let Some((rest, unit)) = whole.and_then(|w| w.rest(inclusion)) {
            let size = rest.iter().fold(Integer::from(0), |s, x| s + Integer::from(x.unsigned_abs()));
            return Some((Rational::from(size) * unit, rest.iter().all(|x| *x <= 0)));
        }
        let rest = self.rest(system, inclusion)?;
        Some((norm1(&rest), rest.iter().all(|x| x.sign() <= 0)))
    }

    /// `T p − Σ c q`.
    fn rest(&self, system: &System<E>, inclusion: &Inclusion<E>) -> Option<Vec<E>> {
        let arrow = &system.arrows[inclusion.arrow];
        let image = arrow.matrix.apply(&self.points[inclusion.point].coordinates);
        self.subtract(image, arrow.from, &inclusion.terms)
    }

    fn subtract(&self, mut rest: Vec<E>, state: usize, terms: &[(usize, E)]) -> Option<Vec<E>> {
        for (k, c) in terms {
            let point = self.points.get(*k).filter(|p| p.state == state)?;
            for (r, x) in rest.iter_mut().zip(&point.coordinates) {
                if !x.is_zero() {
                    *r = r.minus(&c.times(x));
                }
            }
        }
        Some(rest)
    }

    /// `K` with `e_j ∈ K Q` for all axes of a state of a symmetric body, or of a monotone one with a positive point.
    #[must_use]
    pub fn interior(&self, system: &System<E>, state: usize) -> Option<Rational> {
        match self.body {
            Body::Symmetric => self.axis_bound(system, state),
            Body::Monotone => {
                let reach = |axis: usize| {
                    let here = self.points.iter().filter(|p| p.state == state);
                    here.filter_map(|p| p.coordinates.get(axis)).max().filter(|x| x.sign() > 0)
                };
                let widest = (0..system.dims[state]).map(|a| Some(upper(&E::integer(1).over(reach(a)?)?)));
                widest.collect::<Option<Vec<_>>>()?.into_iter().max()
            }
        }
    }

    /// `K` with `e_j ∈ K Q` for all axes of the state.
    fn axis_bound(&self, system: &System<E>, state: usize) -> Option<Rational> {
        let dim = system.dims[state];
        let axes = self.axes.get(state).filter(|a| a.len() == dim)?;
        let (mut size, mut error) = (Rational::from(0), Rational::from(0));
        for (axis, terms) in axes.iter().enumerate() {
            let unit = (0..dim).map(|i| E::integer(i64::from(i == axis))).collect();
            error = error.max(norm1(&self.subtract(unit, state, terms)?));
            size = size.max(total(terms));
        }
        (error < 1).then(|| size / (Rational::from(1) - error))
    }

    fn monotone_interior(&self, system: &System<E>) -> Option<Vec<Rational>> {
        let nonnegative = |p: &Point<E>| p.coordinates.iter().all(|x| x.sign() >= 0);
        let positive = |state: usize, axis: usize| {
            self.points.iter().any(|p| p.state == state && p.coordinates.get(axis).is_some_and(|x| x.sign() > 0))
        };
        let interior = system.dims.iter().enumerate().all(|(s, &dim)| (0..dim).all(|axis| positive(s, axis)));
        (system.is_nonnegative() && self.points.iter().all(nonnegative) && interior).then(Vec::new)
    }
}

/// `Σ |x|`, rounded upwards where it is irrational.
pub(super) fn norm1<E: Entry>(v: &[E]) -> Rational {
    upper(&v.iter().fold(E::zero(), |s, x| s.plus(&x.absolute())))
}

/// `Σ |c|`, rounded upwards where it is irrational.
fn total<E: Entry>(terms: &[(usize, E)]) -> Rational {
    upper(&terms.iter().fold(E::zero(), |s, t| s.plus(&t.1.absolute())))
}
