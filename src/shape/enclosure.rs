//! Balls (and polygons) that hold the attractors, and what a functional does on a cell (theory §7).

use super::contraction::{BITS, Contracting, norm1};
use super::hull::{Hulls, hulls};
use super::{Contraction, OwnPoints, Polytopes, Shape, Spaces, Weights, difference};
use crate::arith::{Interval, Rational};
use crate::linalg::{Entry, Matrix, Products};

/// For every reachable state a ball `B(base, radius)` of the 1-norm that holds its attractor.
#[derive(Debug, Clone)]
pub struct Balls<E: Entry = Rational> {
    radius: Vec<Rational>,
    hulls: Option<Vertices<E>>,
    /// How the images of the vertices of the hulls are combined, where that was found with them.
    weights: Option<HullWeights>,
    simplex: bool,
}

/// Polytopes, and the vertices of each state as the columns of a matrix, if there are any.
#[derive(Debug, Clone)]
struct Vertices<E: Entry> {
    hulls: Vec<Vec<Vec<E>>>,
    columns: Vec<Option<E::Product>>,
}

impl<E: Entry> Vertices<E> {
    fn new(hulls: Vec<Vec<Vec<E>>>) -> Self {
        let columns = |vertices: &Vec<Vec<E>>| {
            let dim = vertices.first()?.len();
            Some(<E::Product>::of(&Matrix::from_columns(dim, vertices)))
        };
        Self { columns: hulls.iter().map(columns).collect(), hulls }
    }

    /// The smallest and the largest value of a functional at the vertices of a state.
    fn range(&self, state: usize, row: &[E], bits: u64) -> Option<Interval> {
        self.columns[state].as_ref()?.range(row, bits)
    }
}

/// By state, piece and vertex of the hull of its target: the image of the vertex as a convex combination of vertices.
pub type HullWeights = Vec<Vec<Vec<Weights>>>;

impl Balls {
    /// What encloses the attractors where contraction is proved: balls, or polytopes with balls around them.
    #[must_use]
    pub fn of(shape: &Shape, spaces: &Spaces, contraction: &Contraction) -> Option<Self> {
        match contraction {
            Contraction::Proved(proof) => Some(Self::of_words(shape, spaces, proof)),
            Contraction::Polytopes(proof) => {
                let mut radius = vec![Rational::from(0); shape.states.len()];
                for e in shape.reachable() {
                    radius[e] = round_up(&proof.reach(e, &spaces.of(e).base));
                }
                Some(Self { radius, hulls: Some(Vertices::new(proof.vertices.clone())), weights: None, simplex: false })
            }
            Contraction::Product(proof) => {
                let mut radius = vec![Rational::from(0); shape.states.len()];
                for e in shape.reachable() {
                    radius[e] = round_up(&(&proof.radius + norm1(&difference(&spaces.of(e).base, &proof.centre))));
                }
                Some(Self { radius, hulls: None, weights: None, simplex: false })
            }
            Contraction::Refuted { .. } | Contraction::Undetermined { .. } => None,
        }
    }

    /// The same balls with convex polygons inside which the attractors lie as well, where there are such.
    #[must_use]
    pub fn with_hulls(&self, shape: &Shape, spaces: &Spaces) -> Option<Self> {
        if shape.reachable().iter().any(|e| spaces.of(*e).basis.cols() > 2) {
            return None;
        }
        let found = own_hulls(shape, spaces).or_else(|| hulls(shape, spaces))?;
        Some(Self { hulls: Some(Vertices::new(found)), weights: None, ..self.clone() })
    }

    /// The same balls with polytopes inside which the attractors lie as well.
    #[must_use]
    pub fn with_polytopes(&self, polytopes: &Polytopes) -> Self {
        let hulls = Some(Vertices::new(polytopes.vertices.clone()));
        let weights = Some(polytopes.weights.clone());
        Self { hulls, weights, ..self.clone() }
    }
}

impl<E: Entry> Balls<E> {
    /// Radii from a proof of contraction: `radius_e >= ‖T_w q − q_e‖ + τ(T_w) radius` for every word of the code.
    #[must_use]
    pub fn of_words(shape: &Shape<E>, spaces: &Spaces<E>, proof: &Contracting) -> Self {
        let operators = shape.scaled_operators();
        let mut shifts: Vec<Vec<(Rational, &Rational, usize)>> = Vec::new();
        for (e, code) in proof.codes.iter().enumerate() {
            let base = |state: usize| <E::Product>::column(&spaces.of(state).base);
            let shift = |c: &super::ContractingWord| {
                let path = shape.path(e, &c.word);
                let along = path.iter().zip(&c.word).rev();
                let image = along.fold(base(c.end), |v, (&state, &letter)| operators[state][letter].times(&v));
                image.distance1(&base(e))
            };
            shifts.push(code.iter().map(|c| (shift(c), &c.tau, c.end)).collect());
        }
        let common = shifts
            .iter()
            .flatten()
            .map(|(shift, tau, _)| shift / (Rational::from(1) - *tau))
            .max()
            .unwrap_or_else(|| Rational::from(0));
        let mut radius = vec![round_up(&common); shape.states.len()];
        let short = |x: &Rational| Interval::point(x.clone()).outward(64).hi;
        let bounds = shifts.iter().map(|code| code.iter().map(|(shift, tau, end)| (short(shift), short(tau), *end)));
        let bounds: Vec<Vec<_>> = bounds.map(Iterator::collect).collect();
        // Each round starts from valid radii and is therefore valid itself.
        for _ in 0..8 {
            radius = bounds
                .iter()
                .zip(&radius)
                .map(|(words, old)| {
                    let bound = words.iter().map(|(shift, tau, end)| shift + tau * &radius[*end]).max();
                    bound.map_or_else(|| Rational::from(0), |b| round_up(&b)).min(old.clone())
                })
                .collect();
        }
        Self { radius, hulls: None, weights: None, simplex: false }
    }

    /// How the images of the vertices of the hulls are combined, where that is known.
    #[must_use]
    pub fn hull_weights(&self) -> Option<&HullWeights> {
        self.weights.as_ref()
    }

    /// The same balls together with the simplex of the coordinates, which holds the attractors where all operators of the
    /// states that are reached are nonnegative.
    #[must_use]
    pub fn with_simplex(&self, shape: &Shape<E>) -> Self {
        let pieces = || shape.reachable().into_iter().flat_map(|e| shape.states[e].pieces.iter());
        let nonnegative = |op: &Matrix<E>| op.entries().iter().all(|x| x.sign() >= 0);
        Self { simplex: pieces().all(|p| nonnegative(&p.op)), ..self.clone() }
    }

    /// Whether the simplex of the coordinates is used besides the balls.
    #[must_use]
    pub fn in_simplex(&self) -> bool {
        self.simplex
    }

    /// The vertices of the polygon of a state, where polygons are used.
    #[must_use]
    pub fn hull(&self, state: usize) -> Option<&[Vec<E>]> {
        Some(&self.hulls.as_ref()?.hulls[state])
    }

    /// The radius at a state.
    #[must_use]
    pub fn radius(&self, state: usize) -> &Rational {
        &self.radius[state]
    }

    /// A bound of the 1-norm of all points of the attractor.
    #[must_use]
    pub fn norm_bound(&self, spaces: &Spaces<E>, state: usize) -> Rational {
        norm1(&spaces.of(state).base) + &self.radius[state]
    }

    /// Encloses `row · a` for all `a` in the attractor of `state`; `row` is already multiplied by the operator of the cell.
    /// Irrational ends are rounded outwards by at most `2^-bits`.
    #[must_use]
    pub fn enclose(&self, spaces: &Spaces<E>, state: usize, row: &[E], bits: u64) -> Interval {
        if let Some(range) = self.hulls.as_ref().and_then(|h| h.range(state, row, bits)) {
            return range;
        }
        let centre = E::dot(row, &spaces.of(state).base).enclosure(bits);
        let spread = oscillation(row) / Rational::from(2) * &self.radius[state];
        let ball = Interval { lo: &centre.lo - &spread, hi: centre.hi + spread };
        match (row.iter().min(), row.iter().max()) {
            (Some(lo), Some(hi)) if self.simplex => {
                Interval { lo: ball.lo.max(lo.enclosure(bits).lo), hi: ball.hi.min(hi.enclosure(bits).hi) }
            }
            _ => ball,
        }
    }
}

/// Polygons found in coordinates by own points, so that they do not depend on units.
fn own_hulls(shape: &Shape, spaces: &Spaces) -> Option<Hulls> {
    let own = OwnPoints::of(shape, spaces)?;
    let inner = own.shape(shape)?;
    let found = hulls(&inner, &Spaces::new(&inner)?)?;
    Some(found.iter().enumerate().map(|(e, polygon)| own.outwards(e, polygon)).collect())
}

/// `max − min` of the entries; a little more where they are irrational.
#[must_use]
pub fn oscillation<E: Entry>(row: &[E]) -> Rational {
    match (row.iter().max(), row.iter().min()) {
        (Some(hi), Some(lo)) => hi.minus(lo).enclosure(BITS).hi,
        _ => Rational::from(0),
    }
}

/// The next multiple of 2^-16, so that radii stay short.
fn round_up(x: &Rational) -> Rational {
    Interval::point(x.clone()).outward(16).hi
}
