//! `[interpolate]`: the graph of the function with `f(L_j(x)) = α_j f(x) + q_j(x)`, `L_j` the affine map of the whole interval onto
//! interval `j`, as a curve in the coordinates `x, y`, or `t, t², …, t^g, y` with the part `t` of the interval.

use super::{Field, field, rows, text};
use crate::base::{Checked, Json, MAX_COORDINATES, MAX_PIECES, Matrix, Node, Q, matrix, number};
use num_traits::{One, Signed, Zero};

/// The data of a table.
struct Data {
    abscissas: Vec<Q>,
    values: Vec<Vec<Q>>,
    /// `α_j`.
    factors: Vec<Matrix>,
    /// `q_j`, by coordinate of the values, from degree 0 on.
    polynomials: Vec<Vec<Vec<Q>>>,
}

/// The keys of a case in place of a table whose points stand under the key.
pub(super) fn expanded(node: &Node<'_>, key: &str) -> Checked<Vec<Field>> {
    node.known(&format!("{key} vertical polynomials"))?;
    let data = Data::read(node, key)?;
    let shares = data.shares();
    let (operators, control) = if data.degree() == 1 { data.affine() } else { data.with_powers() };
    let size = data.degree() + data.dim();
    node.need(size < MAX_COORDINATES, "limit", "too many coordinates")?;
    let numbers = |list: &[Q]| Json::List(list.iter().map(|x| text(&x.to_string())).collect());
    let mut built = vec![
        field("convention", text("columns")),
        field("pieces", Json::List(operators.iter().map(rows).collect())),
        field("control", rows(&control.transpose())),
    ];
    if shares.iter().any(|s| *s != shares[0]) {
        built.push(field("shares", numbers(&shares)));
    }
    Ok(built)
}

impl Data {
    fn read(node: &Node<'_>, key: &str) -> Checked<Self> {
        let points = node.field(key)?.each(|p| p.each(|x| number(x)))?;
        let count = points.len();
        node.need(count > 0, "case", "3 points (x, y) or more are needed, all of as many coordinates")?;
        let dim = points[0].len().saturating_sub(1);
        let fits = (3..=MAX_PIECES + 1).contains(&count) && dim > 0 && points.iter().all(|p| p.len() == dim + 1);
        node.need(fits, "case", "3 points (x, y) or more are needed, all of as many coordinates")?;
        let ascend = points.windows(2).all(|w| w[0][0] < w[1][0]);
        node.need(ascend, "case", "points with increasing abscissas are needed")?;
        let factors: Vec<Matrix> = node.field("vertical")?.each(|a| match a.value {
            Json::List(_) => matrix(a, &()),
            _ => Ok(Matrix::identity(dim).scaled(&number(a)?)),
        })?;
        let sized = factors.len() + 1 == count && factors.iter().all(|a| (a.rows, a.cols) == (dim, dim));
        let small = dim > 1 || factors.iter().all(|a| a.at(0, 0).abs() < Q::one());
        node.need(
            sized && small,
            "case",
            "one factor of the size of the values for each interval, below 1, is needed",
        )?;
        let abscissas = points.iter().map(|p| p[0].clone()).collect();
        let values = points.iter().map(|p| p[1..].to_vec()).collect();
        let mut data = Self { abscissas, values, factors, polynomials: Vec::new() };
        data.polynomials = match node.get("polynomials") {
            None => (0..count - 1).map(|j| data.line(j)).collect(),
            Some(list) => list.each(|q| {
                let plain = dim == 1 && q.list()?.iter().all(|c| !matches!(c.value, Json::List(_)));
                if plain { Ok(vec![q.each(|c| number(c))?]) } else { q.each(|row| row.each(|c| number(c))) }
            })?,
        };
        let whole = data.polynomials.len() + 1 == count && data.polynomials.iter().all(|q| q.len() == dim);
        node.need(whole, "case", "one polynomial for each interval and coordinate of the values is needed")?;
        let meets = |j: usize| {
            let at = |end: usize| data.step(j, &data.abscissas[end], &data.values[end]);
            at(0) == data.values[j] && at(count - 1) == data.values[j + 1]
        };
        node.need((0..count - 1).all(meets), "case", "the polynomials do not lead through the points")?;
        Ok(data)
    }

    fn dim(&self) -> usize {
        self.values[0].len()
    }

    fn shares(&self) -> Vec<Q> {
        let width = self.width();
        self.abscissas.windows(2).map(|w| (&w[1] - &w[0]) / &width).collect()
    }

    fn width(&self) -> Q {
        &self.abscissas[self.abscissas.len() - 1] - &self.abscissas[0]
    }

    /// `α_j y`.
    fn scaled(&self, j: usize, y: &[Q]) -> Vec<Q> {
        let a = &self.factors[j];
        (0..a.rows).map(|i| (0..a.cols).fold(Q::zero(), |sum, k| sum + a.at(i, k) * &y[k])).collect()
    }

    /// `α_j y + q_j(x)`.
    fn step(&self, j: usize, x: &Q, y: &[Q]) -> Vec<Q> {
        let value = |q: &Vec<Q>| q.iter().rev().fold(Q::zero(), |sum, c| sum * x + c);
        self.scaled(j, y).into_iter().zip(&self.polynomials[j]).map(|(a, q)| a + value(q)).collect()
    }

    /// The affine `q_j` that leads through the points.
    fn line(&self, j: usize) -> Vec<Vec<Q>> {
        let last = self.values.len() - 1;
        let (left, right) = (self.scaled(j, &self.values[0]), self.scaled(j, &self.values[last]));
        let through = |i: usize| {
            let (p, q) = (&self.values[j][i] - &left[i], &self.values[j + 1][i] - &right[i]);
            let slope = (q - &p) / self.width();
            vec![p - &slope * &self.abscissas[0], slope]
        };
        (0..self.dim()).map(through).collect()
    }

    /// The largest degree, at least 1.
    fn degree(&self) -> usize {
        let size = |q: &Vec<Q>| (1..q.len()).rev().find(|m| !q[*m].is_zero());
        self.polynomials.iter().flatten().flat_map(size).fold(1, usize::max)
    }

    /// Operators on the simplex for the coordinates `x, y`, and where its corners are seen.
    fn affine(&self) -> (Vec<Matrix>, Matrix) {
        let dim = self.dim();
        let of = |(j, share): (usize, &Q)| {
            // The images of 0 and of the unit vectors.
            let image = |k: Option<usize>| {
                let at = |i: usize, m: usize| coefficient(&self.polynomials[j][i], m);
                let mut v = vec![&self.abscissas[j] - share * &self.abscissas[0]];
                v.extend((0..dim).map(|i| at(i, 0)));
                match k {
                    None => {}
                    Some(0) => {
                        v[0] += share;
                        (0..dim).for_each(|i| v[i + 1] += at(i, 1));
                    }
                    Some(k) => (0..dim).for_each(|i| v[i + 1] += self.factors[j].at(i, k - 1)),
                }
                v
            };
            on_simplex((0..dim + 2).map(|c| image(c.checked_sub(1))).collect())
        };
        let operators = self.shares().iter().enumerate().map(of).collect();
        (operators, Matrix::ones(dim + 1, dim + 2, |i, k| i + 1 == k))
    }

    /// The same for the coordinates `t, t², …, t^g, y`.
    fn with_powers(&self) -> (Vec<Matrix>, Matrix) {
        let (degree, dim, from, width) = (self.degree(), self.dim(), &self.abscissas[0], self.width());
        let mut operators = Vec::new();
        for (j, share) in self.shares().iter().enumerate() {
            let begin = (&self.abscissas[j] - from) / &width;
            // All coordinates as polynomials in t: the powers of `begin + share t`, and `q_j(from + width t)`.
            let powers = (1..=degree).map(|m| substituted(&unit(m), &begin, share));
            let own = self.polynomials[j].iter().map(|q| substituted(q, from, &width));
            let coordinates: Vec<Vec<Q>> = powers.chain(own).collect();
            let image = |c: usize| -> Vec<Q> {
                let mut v: Vec<Q> = coordinates.iter().map(|p| coefficient(p, 0)).collect();
                if (1..=degree).contains(&c) {
                    v.iter_mut().zip(&coordinates).for_each(|(x, p)| *x += coefficient(p, c));
                } else if c > degree {
                    (0..dim).for_each(|i| v[degree + i] += self.factors[j].at(i, c - degree - 1));
                }
                v
            };
            operators.push(on_simplex((0..=degree + dim).map(image).collect()));
        }
        let seen = |i: usize, k: usize| match (i, k) {
            (0, 1) => from + &width,
            (0, _) => from.clone(),
            _ if k == degree + i => Q::one(),
            _ => Q::zero(),
        };
        let places = (0..=dim).flat_map(|i| (0..=degree + dim).map(move |k| (i, k)));
        let entries: Vec<Q> = places.map(|(i, k)| seen(i, k)).collect();
        (operators, Matrix::new(dim + 1, degree + dim + 1, &entries))
    }
}

/// The coefficient of `x^m`, which is 0 beyond the degree.
fn coefficient(p: &[Q], m: usize) -> Q {
    match p.get(m) {
        Some(c) => c.clone(),
        None => Q::zero(),
    }
}

/// The polynomial `x^m`.
fn unit(m: usize) -> Vec<Q> {
    (0..=m).map(|k| if k == m { Q::one() } else { Q::zero() }).collect()
}

/// `q(a + b t)` as a polynomial in `t`.
fn substituted(q: &[Q], a: &Q, b: &Q) -> Vec<Q> {
    let mut sum = vec![Q::zero(); q.len()];
    for c in q.iter().rev() {
        // sum (a + b t) + c
        for m in (0..sum.len()).rev() {
            let below = if m > 0 { &sum[m - 1] * b } else { c.clone() };
            sum[m] = &sum[m] * a + below;
        }
    }
    sum
}

/// The operator with these images of the corners, to which the coordinate that makes the sum 1 is put in front.
fn on_simplex(images: Vec<Vec<Q>>) -> Matrix {
    let full: Vec<Vec<Q>> = images
        .into_iter()
        .map(|v| {
            let first = v.iter().fold(Q::one(), |rest, x| rest - x);
            std::iter::once(first).chain(v).collect()
        })
        .collect();
    Matrix::from_rows(full.len(), &full).transpose()
}
