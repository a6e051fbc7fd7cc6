//! Nets around an edge of the border, the operators of its halves, and the nets that are polynomials on either side.

use super::super::lattice::{MAX_WINDOW, modulo, monomials, operators_keep};
use crate::arith::{Rational, ratio};
use crate::linalg::Matrix;
use crate::scheme::{BorderScheme, BorderSide};
use std::collections::BTreeSet;

/// Largest reach that is tried.
const MAX_REACH: i64 = 12;

/// A window with what is known of polynomials of some degree on it.
#[derive(Debug, Clone)]
pub struct BorderModel {
    /// Its points, ascending: new points of the windows over both halves of the edge depend on points of the window only.
    pub points: Vec<Vec<i64>>,
    /// The columns up to this distance lie in it, and those beyond read only columns from 1 on that are nearer.
    pub reach: i64,
    /// The degree of the polynomials.
    pub degree: usize,
    /// The operators of the two halves.
    pub operators: [Matrix; 2],
    /// All `(p, q, v)`, as columns: `p` and `q` are polynomials, by the coefficients of monomials, and `v` is a net that is that of
    /// `p` on the left, of `q` on the right, and remains such.
    pub pairs: Matrix,
    /// Those with `p = q`.
    pub equal: Matrix,
    /// The nets of all triples, as a matrix on them.
    nets: Matrix,
}

fn power(x: &Rational, exponent: i64) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * x)
}

/// The monomials (columns) at points (rows).
fn at(degree: usize, points: &[[Rational; 2]]) -> Matrix {
    let all = monomials(2, degree);
    Matrix::from_fn(points.len(), all.len(), |i, j| power(&points[i][0], all[j][0]) * power(&points[i][1], all[j][1]))
}

fn rational(p: &[i64]) -> [Rational; 2] {
    [Rational::from(p[0]), Rational::from(p[1])]
}

/// The points of the lattice at which polynomials of a degree are determined by their values.
fn simplex(degree: usize) -> Vec<Vec<i64>> {
    monomials(2, degree)
}

/// What a substitution makes of the coefficients of polynomials.
fn substituted(degree: usize, map: impl Fn(&[i64]) -> [Rational; 2]) -> Option<Matrix> {
    let points = simplex(degree);
    let plain: Vec<[Rational; 2]> = points.iter().map(|p| rational(p)).collect();
    let moved: Vec<[Rational; 2]> = points.iter().map(|p| map(p)).collect();
    Some(&at(degree, &plain).inverse()? * &at(degree, &moved))
}

/// `p ↦ p(x/2, (y + shift)/2)`.
fn halved(degree: usize, shift: i64) -> Option<Matrix> {
    substituted(degree, |p| [ratio(p[0], 2), ratio(p[1] + shift, 2)])
}

/// By the coefficients of a polynomial in the chart, those in column and row of the net of which it is the limit.
fn nets_of(side: &BorderSide, degree: usize) -> Option<Matrix> {
    let [x, y] = &side.place;
    let points = simplex(degree);
    let inverse = at(degree, &points.iter().map(|p| rational(p)).collect::<Vec<_>>()).inverse()?;
    let image = |p: &Vec<i64>| {
        let mut row = Matrix::zero(1, inverse.rows());
        for (a, c) in side.mask.terms().iter() {
            if let Some(old) = side.mask.dilation().divide(&[p[0] - a[0], p[1] - a[1]]) {
                row = &row + &at(degree, &[rational(&old)]).scale(c);
            }
        }
        row.row(0).to_vec()
    };
    let step = &inverse * &Matrix::from_rows(inverse.rows(), points.iter().map(image).collect());
    let chart = substituted(degree, |p| {
        let column = Rational::from(p[0]);
        [&column * x, &column * y + Rational::from(p[1])]
    })?;
    let all = monomials(2, degree);
    let order = |a: &Vec<i64>| a.iter().sum::<i64>();
    let mut columns = Vec::new();
    // The eigenvector of 2^-n with this leading part.
    for (j, monomial) in all.iter().enumerate() {
        let n = order(monomial);
        let value = Rational::from(1) / Rational::from(1_i64 << n);
        let shifted = &step + &Matrix::identity(all.len()).scale(&-value);
        let lower: Vec<usize> = (0..all.len()).filter(|k| order(&all[*k]) < n).collect();
        let leading = chart.column(j);
        let mut net = leading.clone();
        let right: Vec<Rational> = shifted.apply(&leading).into_iter().map(|v| -v).collect();
        let part = Matrix::from_fn(all.len(), lower.len(), |i, k| shifted[(i, lower[k])].clone());
        let rest = part.solve(&Matrix::from_columns(right.len(), &[right]))?;
        for (k, slot) in lower.iter().enumerate() {
            net[*slot] += &rest[(k, 0)];
        }
        columns.push(net);
    }
    Some(Matrix::from_columns(all.len(), &columns))
}

/// The least number of columns so that the next ones read only nearer columns, from 1 on.
fn reach(scheme: &BorderScheme) -> Option<i64> {
    let own = scheme.stencils().map(|((c, _), _)| c.abs()).fold(0, i64::max);
    let reads = |column: i64| {
        let fits = |a: &Vec<i64>| {
            let distance = a[0] * column.signum();
            (1..column.abs()).contains(&distance)
        };
        (0..2).all(|row| scheme.rule(column, row).iter().all(|(a, _)| fits(a)))
    };
    (own.max(1)..=MAX_REACH).find(|k| [k + 1, k + 2, -k - 1, -k - 2].iter().all(|c| reads(*c)))
}

fn closure(scheme: &BorderScheme, reach: i64, rows: i64) -> Option<Vec<Vec<i64>>> {
    let seed = (-reach..=reach).flat_map(|c| (0..=rows).map(move |r| vec![c, r]));
    let mut found: BTreeSet<Vec<i64>> = seed.collect();
    let mut open: Vec<Vec<i64>> = found.iter().cloned().collect();
    while let Some(p) = open.pop() {
        for half in 0..2 {
            for (old, _) in scheme.rule(p[0], p[1] + half) {
                if found.insert(old.clone()) {
                    open.push(old);
                }
            }
        }
        if found.len() > MAX_WINDOW {
            return None;
        }
    }
    Some(found.into_iter().collect())
}

impl BorderModel {
    /// The smallest window that is tried on which neighbouring nets determine each other's polynomials; the masks of both sides
    /// have sum rules of an order above the degree.
    #[must_use]
    pub fn of(scheme: &BorderScheme, degree: usize) -> Option<Self> {
        let reach = reach(scheme)?;
        (0..=degree as i64 + 2).find_map(|rows| Self::on(scheme, closure(scheme, reach, rows)?, reach, degree))
    }

    fn on(scheme: &BorderScheme, points: Vec<Vec<i64>>, reach: i64, degree: usize) -> Option<Self> {
        let n = monomials(2, degree).len();
        let border: Vec<usize> = (0..points.len()).filter(|i| points[*i][0] == 0).collect();
        let [left, right] = scheme.sides();
        let (left, right) = (nets_of(left, degree)?, nets_of(right, degree)?);
        let width = 2 * n + border.len();
        let row = |p: &Vec<i64>, i: usize| {
            let mut row = vec![Rational::from(0); width];
            let (net, from) = if p[0] < 0 { (&left, 0) } else { (&right, n) };
            if p[0] == 0 {
                row[2 * n + border.iter().filter(|k| **k < i).count()] = Rational::from(1);
            } else {
                let values = &at(degree, &[rational(p)]) * net;
                row[from..from + n].clone_from_slice(values.row(0));
            }
            row
        };
        let nets = Matrix::from_rows(width, points.iter().enumerate().map(|(i, p)| row(p, i)).collect());
        let operator = |half: i64| {
            let rows = points.iter().map(|p| {
                let mut row = vec![Rational::from(0); points.len()];
                for (old, c) in scheme.rule(p[0], p[1] + half) {
                    row[points.binary_search(&old).ok()?] += c;
                }
                Some(row)
            });
            Some(Matrix::from_rows(points.len(), rows.collect::<Option<Vec<_>>>()?))
        };
        let operators = [operator(0)?, operator(1)?];
        let mut broken = Matrix::zero(0, width);
        let mut steps = Vec::new();
        for (half, operator) in (0..).zip(&operators) {
            let image = operator * &nets;
            let turned = halved(degree, half)?;
            let step = Matrix::from_fn(width, width, |i, j| match (i / n, j / n) {
                (0, 0) | (1, 1) => turned[(i % n, j % n)].clone(),
                (0 | 1, _) => Rational::from(0),
                _ => image[(border[i - 2 * n], j)].clone(),
            });
            broken = broken.stack(&(&image + &(&nets * &step).scale(&ratio(-1, 1))));
            steps.push(step);
        }
        let apart = |i: usize, j: usize| ratio(i64::from(j == i) - i64::from(j == n + i), 1);
        let kept = |rows: &Matrix| rows.closure(&[&steps[0], &steps[1]]).kernel();
        let pairs = kept(&broken);
        let equal = kept(&broken.stack(&Matrix::from_fn(n, width, apart)));
        let made = Self { points, reach, degree, operators, pairs, equal, nets };
        made.overlaps().then_some(made)
    }

    /// Whether the polynomials of the net on a window and on the next one are the same where the nets are on their common points.
    fn overlaps(&self) -> bool {
        let n = monomials(2, self.degree).len();
        let Some(moved) = substituted(self.degree, |p| [Rational::from(p[0]), Rational::from(p[1] + 1)]) else {
            return false;
        };
        let values = &self.nets * &self.pairs;
        let before = |p: &Vec<i64>| self.points.binary_search(&vec![p[0], p[1] - 1]).ok();
        let common = self.points.iter().enumerate().filter_map(|(i, p)| Some((i, before(p)?)));
        let row = |(i, j): (usize, usize)| {
            let other = values.row(j).iter().map(|x| -x);
            values.row(i).iter().cloned().chain(other).collect::<Vec<Rational>>()
        };
        let same = Matrix::from_rows(2 * values.cols(), common.map(row).collect()).kernel();
        let half = |from: usize| {
            let part = Matrix::from_fn(values.cols(), same.cols(), |i, j| same[(from + i, j)].clone());
            &self.pairs * &part
        };
        let (own, next) = (half(0), half(values.cols()));
        let polynomial = |m: &Matrix, k: usize| Matrix::from_fn(n, m.cols(), |i, j| m[(k * n + i, j)].clone());
        (0..2).all(|k| &moved * &polynomial(&own, k) == polynomial(&next, k))
    }

    /// The operators on nets modulo those of triples; `None` where these are not kept.
    #[must_use]
    pub fn quotient(&self, triples: &Matrix) -> Option<Vec<Matrix>> {
        let nets = (&self.nets * triples).transpose().echelon();
        operators_keep(&nets, &self.operators).then(|| modulo(&nets, &self.operators))
    }

    /// The pairs of polynomials of all triples modulo those with `p = q`: coefficients of `p` and of `q`.
    #[must_use]
    pub fn jumps(&self) -> Vec<[Vec<Rational>; 2]> {
        let n = monomials(2, self.degree).len();
        let known = Matrix::from_fn(self.equal.cols(), n, |i, j| self.equal[(j, i)].clone()).echelon();
        // Differences first, so that the triples without one come last.
        let rows = Matrix::from_fn(self.pairs.cols(), 2 * n, |i, j| match j {
            j if j < n => &self.pairs[(n + j, i)] - &self.pairs[(j, i)],
            j => self.pairs[(j - n, i)].clone(),
        })
        .echelon();
        let mut found = Vec::new();
        for (i, _) in rows.pivots.iter().enumerate().filter(|(_, pivot)| **pivot < n) {
            let (jump, left) = rows.rows.row(i).split_at(n);
            let mut left = left.to_vec();
            for (k, pivot) in known.pivots.iter().enumerate() {
                let factor = left[*pivot].clone();
                left.iter_mut().zip(known.rows.row(k)).for_each(|(x, y)| *x -= &factor * y);
            }
            let scale = left.iter().find(|x| **x != 0).map_or(Rational::from(1), |x| Rational::from(1) / x);
            let left: Vec<Rational> = left.iter().map(|x| x * &scale).collect();
            let right = left.iter().zip(jump).map(|(x, y)| x + y * &scale).collect();
            found.push([left, right]);
        }
        found
    }
}
