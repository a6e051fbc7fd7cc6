//! A curve scheme as a side of a junction: operators on points from left to right, of which the first and the last are those
//! of its end vertices.

use super::JunctionError;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::scheme::{PointOrder, ordered};
use crate::shape::{CellKind, Shape};
use crate::theorem::contraction_of;

/// A curve scheme with its points from left to right.
#[derive(Debug, Clone)]
pub struct Side {
    /// What it is called.
    pub name: String,
    /// Its operators on columns, in the order of the parameter.
    pub operators: Vec<Matrix>,
    /// Which pieces run backwards.
    pub reversed: Vec<bool>,
    /// What the pieces take of the parameter, where these are no equal parts.
    pub shares: Option<Vec<Rational>>,
    /// The number of points at each end on which the end point depends.
    pub shared: usize,
    /// Where the points come from.
    pub order: PointOrder,
}

/// Highest power that is looked for.
const MAX_POWER: usize = 8;
/// Most pieces of a scheme that is iterated.
const MAX_ARITY: usize = 64;

impl Side {
    /// A curve of a single state as a side; control points are left out.
    ///
    /// # Errors
    /// [`JunctionError::NotOneCurve`], and [`JunctionError::NoCurve`] where contraction is not proved or pieces do not meet.
    pub fn of(name: &str, shape: &Shape) -> Result<Self, JunctionError> {
        let state = &shape.states[shape.start];
        if state.kind != CellKind::Edge || shape.reachable() != [shape.start] {
            return Err(JunctionError::NotOneCurve(name.to_owned()));
        }
        let wrong = |why: String| JunctionError::NoCurve { name: name.to_owned(), why };
        let contracts = contraction_of(shape).map_err(|e| wrong(e.to_string()))?;
        if !contracts.is_proved() {
            return Err(wrong("it was not proved that the scheme contracts".to_owned()));
        }
        shape.check_curves().map_err(|e| wrong(e.to_string()))?;
        let reversed: Vec<bool> = state.pieces.iter().map(|p| p.reversed).collect();
        let found = ordered(shape).ok_or_else(|| wrong("the curve is a single point".to_owned()))?;
        let (operators, shared, order) = (found.operators, found.shared, found.order);
        let shares: Vec<Rational> = (0..operators.len()).map(|i| state.share(i)).collect();
        let shares = shares.iter().any(|s| *s != shares[0]).then_some(shares);
        Ok(Self { name: name.to_owned(), operators, reversed, shares, shared, order })
    }

    /// The number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.operators[0].rows()
    }

    /// The number of pieces.
    #[must_use]
    pub fn arity(&self) -> usize {
        self.operators.len()
    }

    /// The rule of the end vertices: new points by rows on the old ones.
    #[must_use]
    pub fn vertex(&self) -> Matrix {
        if self.order == PointOrder::OwnPoints {
            return Matrix::identity(1);
        }
        Matrix::from_fn(self.shared, self.shared, |i, j| self.operators[0][(j, i)].clone())
    }

    /// The scheme of `steps` steps at once; `None` where pieces run backwards or there would be too many.
    #[must_use]
    pub fn iterated(&self, steps: usize) -> Option<Self> {
        let pieces = self.arity().checked_pow(u32::try_from(steps).ok()?)?;
        if self.reversed.contains(&true) || pieces > MAX_ARITY || steps == 0 {
            return None;
        }
        let (mut operators, mut shares) = (self.operators.clone(), self.shares.clone());
        for _ in 1..steps {
            operators = operators.iter().flat_map(|a| self.operators.iter().map(move |b| a * b)).collect();
            shares = shares
                .zip(self.shares.as_ref())
                .map(|(all, own)| all.iter().flat_map(|a: &Rational| own.iter().map(move |b| a * b)).collect());
        }
        Some(Self { reversed: vec![false; pieces], operators, shares, ..self.clone() })
    }

    /// Rows `1, q_1, q_2, …` with `q_d T_j = Σ_i C(d,i) s^i c^(d−i) q_i`, the substitution `x ↦ s x + c` of piece `j` on powers,
    /// `s = ±1/N`: the values by which the scheme reproduces powers, as many as there are. With other shares than `1/N` only the
    /// constants count: the two ends would have to shrink by one factor, and the intermediate curve with them.
    #[must_use]
    pub fn powers(&self) -> Vec<Vec<Rational>> {
        let n = self.points();
        let mut found = vec![vec![Rational::from(1); n]];
        let share = Rational::from(1) / Rational::from(self.arity());
        let most = if self.shares.is_some() { 0 } else { MAX_POWER };
        for d in 1..=most {
            let mut left = Matrix::zero(0, n);
            let mut right = Matrix::zero(0, 1);
            for (j, op) in self.operators.iter().enumerate() {
                let slope = if self.reversed[j] { -share.clone() } else { share.clone() };
                let start = Rational::from(j + usize::from(self.reversed[j])) * &share;
                let own = power(&slope, d);
                left = left.stack(&Matrix::from_fn(n, n, |r, c| {
                    let entry = op[(c, r)].clone();
                    if r == c { entry - &own } else { entry }
                }));
                right = right.stack(&Matrix::from_columns(n, &[substituted(&found, d, &slope, &start, d)]));
            }
            match left.solve(&right) {
                Some(q) => found.push(q.column(0)),
                None => break,
            }
        }
        found
    }

    /// The eigenvalue by which distances at the end vertices shrink, where it is rational, positive and the largest; `1/N` where
    /// the vertex is a single point.
    #[must_use]
    pub fn shrinks(&self) -> Option<Rational> {
        if self.shared == 1 {
            return Some(Rational::from(1) / Rational::from(self.arity()));
        }
        let rule = self.vertex();
        // On differences of neighbours.
        let p = self.shared;
        let sums = Matrix::from_fn(p - 1, p - 1, |i, j| {
            (j + 1..p).fold(Rational::from(0), |s, k| s + &rule[(i + 1, k)] - &rule[(i, k)])
        });
        let classes = crate::jordan::modulus_classes(&sums);
        let [only] = classes.first()?.as_slice() else { return None };
        only.rational().filter(|x| *x > 0 && *x < 1)
    }
}

/// `Σ_{i < top} C(d,i) slope^i start^(d−i) q_i`.
pub(super) fn substituted(
    q: &[Vec<Rational>],
    d: usize,
    slope: &Rational,
    start: &Rational,
    top: usize,
) -> Vec<Rational> {
    let mut sum = vec![Rational::from(0); q[0].len()];
    let mut choose = Rational::from(1);
    for (i, row) in q.iter().enumerate().take(top) {
        let factor = &choose * power(slope, i) * power(start, d - i);
        sum.iter_mut().zip(row).for_each(|(s, x)| *s += &factor * x);
        choose = choose * Rational::from(d - i) / Rational::from(i + 1);
    }
    sum
}

pub(super) fn power(x: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * x)
}
