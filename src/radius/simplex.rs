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
            let row = &self.inverse[k * self.n..(k + 1) * self.n];
            y.iter_mut().zip(row).for_each(|(out, x)| *out += cost * x);
        }
        y
    }

    pub fn pivot(&mut self, column: Column, entries: &[f64]) -> bool {
        let n = self.n;
        let d: Vec<f64> = self.inverse.chunks(n).map(|row| dot(row, entries)).collect();
        // Among the columns that limit the step, up to a hair, the one with the largest entry (Harris).
        let entering = |s: &f64| *s > 1e-9;
        let ratio = |k: usize| self.values[k].max(0.0) / d[k];
        let least = (0..n)
            .filter(|k| entering(&d[*k]))
            .map(|k| (self.values[k].max(0.0) + 1e-12) / d[k])
            .fold(f64::INFINITY, f64::min);
        let near = (0..n).filter(|k| entering(&d[*k]) && ratio(*k) <= least);
        let leaving = near.max_by(|a, b| d[*a].total_cmp(&d[*b])).map(|k| (k, ratio(k)));
        let Some((k, ratio)) = leaving else { return false };
        let pivot: Vec<f64> = self.inverse[k * n..(k + 1) * n].iter().map(|x| x / d[k]).collect();
        for (i, step) in d.iter().enumerate().filter(|(i, s)| *i != k && **s != 0.0) {
            self.inverse[i * n..(i + 1) * n].iter_mut().zip(&pivot).for_each(|(x, p)| *x -= step * p);
            self.values[i] -= step * ratio;
        }
        self.inverse[k * n..(k + 1) * n].copy_from_slice(&pivot);
        self.values[k] = ratio;
        self.basis[k] = column;
        true
    }

    /// The value of [`Tableau::combination`].
    pub fn value(&self) -> f64 {
        let part = |(column, c): (&Column, &f64)| match column {
            Column::Point(..) if *c > 0.0 => *c,
            Column::Artificial if *c > 1e-10 => f64::INFINITY,
            _ => 0.0,
        };
        self.basis.iter().zip(&self.values).map(part).sum()
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

/// Points of one space, by coordinate: prices of all of them are sums of long vectors.
#[derive(Debug, Clone)]
pub(super) struct Hull {
    rows: Vec<Vec<f64>>,
    count: usize,
}

impl Hull {
    pub fn new(dim: usize) -> Self {
        Self { rows: vec![Vec::new(); dim], count: 0 }
    }

    pub fn of(dim: usize, points: &[&[f64]]) -> Self {
        let mut hull = Self::new(dim);
        points.iter().for_each(|p| hull.push(p));
        hull
    }

    pub fn push(&mut self, point: &[f64]) {
        self.rows.iter_mut().zip(point).for_each(|(row, x)| row.push(*x));
        self.count += 1;
    }

    /// `y q` for all points `q`.
    fn prices(&self, y: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.count, 0.0);
        for (row, c) in self.rows.iter().zip(y).filter(|(_, c)| **c != 0.0) {
            out.iter_mut().zip(row).for_each(|(o, x)| *o += c * x);
        }
    }

    fn price(&self, j: usize, y: &[f64]) -> f64 {
        self.rows.iter().zip(y).map(|(row, c)| row[j] * c).sum()
    }

    fn point(&self, j: usize, sign: f64) -> Vec<f64> {
        self.rows.iter().map(|row| sign * row[j]).collect()
    }
}

/// A combination of points with small `Σ |c|` that reaches (or dominates) `x`; stops early below `enough`, and where the gauge is
/// seen to be above `beyond`: then the value is a number between `beyond` and the gauge, and the terms mean nothing.
///
/// # Cost
/// `O(n |points|)` to price all points, then `O(n²)` a pivot among the best of them; usually a few times `n` pivots. The second
/// answer is the work done.
pub(super) fn gauge(body: Body, hull: &Hull, x: &[f64], enough: f64, beyond: f64) -> (Combination, u64) {
    let sign = match body {
        Body::Symmetric => Sign::Any,
        Body::Monotone => Sign::Dominating,
    };
    minimise(sign, hull, x, enough, beyond)
}

/// Nonnegative coefficients, of at most as many rays as there are coordinates, that combine `x`; `None` outside the cone.
pub(crate) fn cone_combination(rays: &[&[f64]], x: &[f64]) -> Option<Vec<(usize, f64)>> {
    let found = minimise(Sign::Nonnegative, &Hull::of(x.len(), rays), x, 0.0, f64::INFINITY).0;
    found.value.is_finite().then_some(found.terms)
}

/// Why a point seems to lie in a cone or not, in a form that is soon looked at again for other points and rays.
pub(crate) enum InCone {
    /// It is combined with these coefficients; `basis` is missing where the rays are none.
    Inside { terms: Vec<(usize, f64)>, basis: Option<ConeBasis> },
    /// A functional that is positive at the point, and hardly so on the rays.
    Outside(Vec<f64>),
}

/// A basis of rays with the inverse of its matrix, by rows.
pub(crate) struct ConeBasis {
    pub rays: Vec<usize>,
    inverse: Vec<f64>,
}

impl ConeBasis {
    /// Whether the rays combine a point.
    pub fn combines(&self, x: &[f64]) -> bool {
        self.inverse.chunks(x.len()).all(|row| dot(row, x) >= 0.0)
    }
}

/// Whether a unit functional is clearly positive at a unit vector and on none of the rays: they do not combine the vector.
pub(crate) fn tells_apart(functional: &[f64], rays: &[&[f64]], x: &[f64]) -> bool {
    dot(functional, x) > 1e-6 && rays.iter().all(|r| dot(functional, r) <= 0.0)
}

/// As [`cone_combination`], with the reason.
pub(crate) fn in_cone(rays: &[&[f64]], x: &[f64]) -> InCone {
    let (tableau, ..) = pivoted(Sign::Nonnegative, &Hull::of(x.len(), rays), x, 0.0, f64::INFINITY);
    let Combination { terms, value, .. } = tableau.combination();
    if value.is_finite() {
        let point = |column: &Column| if let Column::Point(j, _) = column { Some(*j) } else { None };
        let rays = tableau.basis.iter().map(point).collect::<Option<Vec<_>>>();
        return InCone::Inside { terms, basis: rays.map(|rays| ConeBasis { rays, inverse: tableau.inverse }) };
    }
    InCone::Outside(tableau.dual())
}

/// Gains below this do not enter.
const GAIN: f64 = 1e-10;

/// How a column gains with its price, and its sign.
fn gain(rule: Sign, price: f64) -> (f64, f64) {
    if rule == Sign::Any { (price.abs() - 1.0, price.signum()) } else { (price - 1.0, 1.0) }
}

fn minimise(rule: Sign, hull: &Hull, x: &[f64], enough: f64, beyond: f64) -> (Combination, u64) {
    let (tableau, bound, work) = pivoted(rule, hull, x, enough, beyond);
    if let Some(value) = bound {
        return (Combination { terms: Vec::new(), value, loose: Vec::new() }, work);
    }
    let mut found = tableau.combination();
    // Where rounding got out of hand, the point counts as one outside.
    if rule == Sign::Any && found.value.is_finite() && !reaches(hull, x, &found) {
        found.value = f64::INFINITY;
    }
    (found, work)
}

/// The last tableau, a bound of the value where it is above `beyond`, and the work done.
fn pivoted(rule: Sign, hull: &Hull, x: &[f64], enough: f64, beyond: f64) -> (Tableau, Option<f64>, u64) {
    let n = x.len();
    let mut tableau = Tableau::start(x);
    let (mut work, mut prices, mut chosen) = (0, Vec::new(), Vec::new());
    let most = n + 8;
    let mut pivots = 0;
    let limit = 60 * n + 100;
    'price: while pivots < limit {
        let y = tableau.dual();
        hull.prices(&y, &mut prices);
        work += (n * hull.count / 2 + n * n) as u64 + 50;
        let best = prices.iter().map(|p| gain(rule, *p).0).fold(0.0, f64::max);
        let surplus = if rule == Sign::Dominating { y.iter().map(|p| -p).fold(0.0, f64::max) } else { 0.0 };
        // Scaled so that no column gains, the dual solution is a bound of the gauge.
        let low = dot(&y, x) / (1.0 + best);
        if surplus <= 0.0 && low > beyond && low < ARTIFICIAL_COST * 1e-3 {
            return (tableau, Some(low), work);
        }
        if best.max(surplus) <= GAIN {
            break;
        }
        // Several pivots among the columns that gain most.
        let threshold = (0.5 * best).max(GAIN);
        chosen.clear();
        for (j, price) in prices.iter().enumerate() {
            if gain(rule, *price).0 > threshold {
                chosen.push(j);
            }
        }
        if chosen.len() > most {
            let order =
                |a: &usize, b: &usize| gain(rule, prices[*b]).0.total_cmp(&gain(rule, prices[*a]).0).then(a.cmp(b));
            chosen.select_nth_unstable_by(most, order);
            chosen.truncate(most);
            chosen.sort_unstable();
        }
        let mut first = true;
        loop {
            let y = if first { y.clone() } else { tableau.dual() };
            let mut entering: Option<(Column, f64)> = None;
            let least = if first { GAIN } else { GAIN.max(0.3 * best.max(surplus)) };
            for &j in &chosen {
                let (g, sign) = gain(rule, hull.price(j, &y));
                if g > entering.map_or(least, |e| e.1) {
                    entering = Some((Column::Point(j, sign), g));
                }
            }
            if rule == Sign::Dominating {
                for (i, price) in y.iter().enumerate() {
                    if -price > entering.map_or(least, |e| e.1) {
                        entering = Some((Column::Surplus(i), -price));
                    }
                }
            }
            work += (chosen.len() * n + 3 * n * n) as u64 + 50;
            let Some((column, _)) = entering else {
                if first {
                    break 'price;
                }
                break;
            };
            let entries: Vec<f64> = match column {
                Column::Point(j, sign) => hull.point(j, sign),
                Column::Surplus(i) => (0..n).map(|k| if k == i { -1.0 } else { 0.0 }).collect(),
                Column::Artificial => break 'price,
            };
            pivots += 1;
            if !tableau.pivot(column, &entries) || tableau.value() <= enough || pivots >= limit {
                break 'price;
            }
            first = false;
        }
    }
    (tableau, None, work)
}

/// Whether a combination is the point, up to rounding.
fn reaches(hull: &Hull, x: &[f64], found: &Combination) -> bool {
    let size = x.iter().map(|v| v.abs()).fold(1e-3, f64::max);
    x.iter().zip(&hull.rows).all(|(v, row)| {
        let sum: f64 = found.terms.iter().map(|(k, c)| c * row[*k]).sum();
        (v - sum).abs() <= 1e-9 * size
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauges_of_simple_bodies() {
        let square = Hull::of(2, &[&[1.0, 1.0], &[1.0, -1.0]]);
        let c = gauge(Body::Symmetric, &square, &[0.5, -2.0], 0.0, f64::INFINITY).0;
        assert!((c.value - 2.0).abs() < 1e-12);
        let flat = Hull::of(2, &[&[1.0, 1.0]]);
        assert!(gauge(Body::Symmetric, &flat, &[1.0, 0.0], 0.0, f64::INFINITY).0.value.is_infinite());
        let c = gauge(Body::Monotone, &flat, &[1.0, 0.25], 0.0, f64::INFINITY).0;
        assert!((c.value - 1.0).abs() < 1e-12);
    }
}
