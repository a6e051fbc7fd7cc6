//! The gauge of a polytope by a small revised simplex method.
#![allow(clippy::float_arithmetic, reason = "proposes coefficients, exact arithmetic checks them")]

use super::float::dot;

/// What is meant by the hull of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// `{Σ c_k q_k : Σ |c_k| <= 1}`.
    Symmetric,
    /// `{x >= 0 : x <= Σ c_k q_k, c_k >= 0, Σ c_k <= 1}`.
    Monotone,
}

/// A combination of points that reaches a given one.
#[derive(Debug, Clone)]
pub(super) struct Combination {
    /// Index of a point and its coefficient.
    pub terms: Vec<(usize, f64)>,
    /// `Σ |c|`, infinite where the point is not in the span.
    pub value: f64,
    /// Coordinates in which the combination exceeds the point (monotone bodies).
    pub loose: Vec<usize>,
}

/// How columns may be combined.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Any,
    Nonnegative,
    Dominating,
}

/// A column of the basis.
#[derive(Clone, Copy)]
pub(super) enum Column {
    /// A point and its sign (or phase).
    Point(usize, f64),
    /// The excess in a coordinate.
    Surplus(usize),
    /// What is not yet combined.
    Artificial,
}

const ARTIFICIAL_COST: f64 = 1e7;

/// The revised simplex method: the inverse of the basis, and the values of its columns.
pub(super) struct Tableau {
    n: usize,
    inverse: Vec<f64>,
    pub basis: Vec<Column>,
    pub values: Vec<f64>,
}

impl Tableau {
    pub fn start(x: &[f64]) -> Self {
        let n = x.len();
        let mut inverse = vec![0.0; n * n];
        for (i, v) in x.iter().enumerate() {
            inverse[i * n + i] = if *v < 0.0 { -1.0 } else { 1.0 };
        }
        Self { n, inverse, basis: vec![Column::Artificial; n], values: x.iter().map(|v| v.abs()).collect() }
    }

    pub fn dual(&self) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        for (k, column) in self.basis.iter().enumerate() {
            let cost = match column {
                Column::Point(..) => 1.0,
                Column::Surplus(_) => continue,
                Column::Artificial => ARTIFICIAL_COST,
            };
            for (i, out) in y.iter_mut().enumerate() {
                *out += cost * self.inverse[k * self.n + i];
            }
        }
        y
    }

    pub fn pivot(&mut self, column: Column, entries: &[f64]) -> bool {
        let n = self.n;
        let d: Vec<f64> = self.inverse.chunks(n).map(|row| dot(row, entries)).collect();
        let mut leaving: Option<(usize, f64)> = None;
        for (k, step) in d.iter().enumerate().filter(|(_, s)| **s > 1e-11) {
            let ratio = self.values[k].max(0.0) / step;
            let better = leaving.is_none_or(|(old, r)| ratio < r - 1e-13 || (ratio < r + 1e-13 && *step > d[old]));
            if better {
                leaving = Some((k, ratio));
            }
        }
        let Some((k, ratio)) = leaving else { return false };
        for j in 0..n {
            self.inverse[k * n + j] /= d[k];
        }
        for (i, step) in d.iter().enumerate().filter(|(i, s)| *i != k && **s != 0.0) {
            for j in 0..n {
                self.inverse[i * n + j] -= step * self.inverse[k * n + j];
            }
            self.values[i] -= step * ratio;
        }
        self.values[k] = ratio;
        self.basis[k] = column;
        true
    }

    pub fn combination(&self) -> Combination {
        let mut terms: Vec<(usize, f64)> = Vec::new();
        let mut value = 0.0;
        let mut loose = Vec::new();
        for (column, &c) in self.basis.iter().zip(&self.values) {
            match column {
                Column::Point(j, sign) if c > 0.0 => {
                    value += c;
                    terms.push((*j, sign * c));
                }
                Column::Surplus(i) => loose.push(*i),
                Column::Artificial if c > 1e-10 => value = f64::INFINITY,
                _ => {}
            }
        }
        terms.sort_by_key(|t| t.0);
        Combination { terms, value, loose }
    }
}

/// A combination of `points` with small `Σ |c|` that reaches (or dominates) `x`; stops early below `enough`.
///
/// # Cost
/// `O(n |points| + n²)` a pivot, usually a few times `n` pivots.
pub(super) fn gauge(body: Body, points: &[&[f64]], x: &[f64], enough: f64) -> Combination {
    let sign = match body {
        Body::Symmetric => Sign::Any,
        Body::Monotone => Sign::Dominating,
    };
    minimise(sign, points, x, enough)
}

/// Nonnegative coefficients, of at most as many rays as there are coordinates, that combine `x`; `None` outside the cone.
pub(crate) fn cone_combination(rays: &[&[f64]], x: &[f64]) -> Option<Vec<(usize, f64)>> {
    let found = minimise(Sign::Nonnegative, rays, x, 0.0);
    found.value.is_finite().then_some(found.terms)
}

fn minimise(rule: Sign, points: &[&[f64]], x: &[f64], enough: f64) -> Combination {
    let n = x.len();
    let mut tableau = Tableau::start(x);
    for _ in 0..(60 * n + 100) {
        let y = tableau.dual();
        let mut entering: Option<(Column, f64)> = None;
        for (j, q) in points.iter().enumerate() {
            let price = dot(q, &y);
            let (gain, sign) = if rule == Sign::Any { (price.abs() - 1.0, price.signum()) } else { (price - 1.0, 1.0) };
            if gain > entering.map_or(1e-10, |e| e.1) {
                entering = Some((Column::Point(j, sign), gain));
            }
        }
        if rule == Sign::Dominating {
            for (i, price) in y.iter().enumerate() {
                if -price > entering.map_or(1e-10, |e| e.1) {
                    entering = Some((Column::Surplus(i), -price));
                }
            }
        }
        let Some((column, _)) = entering else { break };
        let entries: Vec<f64> = match column {
            Column::Point(j, sign) => points[j].iter().map(|v| sign * v).collect(),
            Column::Surplus(i) => (0..n).map(|k| if k == i { -1.0 } else { 0.0 }).collect(),
            Column::Artificial => break,
        };
        if !tableau.pivot(column, &entries) {
            break;
        }
        if tableau.combination().value <= enough {
            break;
        }
    }
    tableau.combination()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauges_of_simple_bodies() {
        let square: [&[f64]; 2] = [&[1.0, 1.0], &[1.0, -1.0]];
        let c = gauge(Body::Symmetric, &square, &[0.5, -2.0], 0.0);
        assert!((c.value - 2.0).abs() < 1e-12);
        let flat: [&[f64]; 1] = [&[1.0, 1.0]];
        assert!(gauge(Body::Symmetric, &flat, &[1.0, 0.0], 0.0).value.is_infinite());
        let c = gauge(Body::Monotone, &flat, &[1.0, 0.25], 0.0);
        assert!((c.value - 1.0).abs() < 1e-12);
    }
}
