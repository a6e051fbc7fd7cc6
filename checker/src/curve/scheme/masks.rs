//! Masks: given by coefficients, a symbol or a filter, or named; and the operators of their curves.

use super::curves::{Curve, Vertex, parameters};
use super::symbol;
use crate::base::{Checked, MAX_PIECES, Matrix, Node, Q, index, number, spend, whole};
use num_traits::{One, Zero};

/// Largest degree, number of points or of smoothing factors of a named family.
const MAX_DEGREE: usize = 48;

/// A mask `a_0 … a_L` without zeros at its ends.
pub struct Mask {
    arity: usize,
    coefficients: Vec<Q>,
}

/// A polynomial, lowest coefficient first.
type Polynomial = Vec<Q>;

fn product(a: &[Q], b: &[Q]) -> Checked<Polynomial> {
    spend(16 * a.len() * b.len(), 64)?;
    let mut all = vec![Q::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            all[i + j] += x * y;
        }
    }
    Ok(all)
}

fn power(base: &[Q], exponent: usize) -> Checked<Polynomial> {
    (0..exponent).try_fold(vec![Q::one()], |p, _| product(&p, base))
}

fn ratio(p: i64, q: i64) -> Q {
    whole(p) / whole(q)
}

/// The mask of a named scheme; `None` where it has another form.
pub fn named(node: &Node<'_>) -> Checked<Option<Mask>> {
    let name = node.field("name")?.text()?;
    let known = |keys: &[(&'static str, &str)]| parameters(node, keys);
    let (arity, coefficients) = match name {
        "bspline" => {
            let v = known(&[("degree", "3"), ("arity", "2")])?;
            let (degree, m) = (v.count("degree", MAX_DEGREE)?, v.count("arity", MAX_PIECES)?);
            node.need(m >= 2, "format", "the arity is at least 2")?;
            // m ((1 + … + z^(m−1))/m)^(degree + 1).
            let mut symbol = power(&vec![ratio(1, m as i64); m], degree + 1)?;
            symbol.iter_mut().for_each(|c| *c *= whole(m as i64));
            (m, symbol)
        }
        "dubuc-deslauriers" => {
            let points = known(&[("points", "4")])?.count("points", MAX_DEGREE)?;
            node.need(points > 0 && points.is_multiple_of(2), "format", "an even number of points is needed")?;
            (2, interpolating(points as i64))
        }
        "four-point" => {
            let v = known(&[("w", "1/16")])?;
            let w = v.number("w")?;
            let (side, o) = (ratio(1, 2) + w, Q::zero());
            (2, vec![-w, o.clone(), side.clone(), Q::one(), side, o, -w])
        }
        "hormann-sabin" => {
            let k = known(&[("k", "4")])?.count("k", MAX_DEGREE)?;
            // 2 ((1 + z)/2)^k times z − (k/8) (1 − z)².
            let part = ratio(k as i64, 8);
            let mut symbol =
                product(&power(&[ratio(1, 2), ratio(1, 2)], k)?, &[-&part, Q::one() + &part + &part, -part])?;
            symbol.iter_mut().for_each(|c| *c *= whole(2));
            (2, symbol)
        }
        "ternary-three-point" => {
            let v = known(&[("b", "4/15")])?;
            let b = v.number("b")?;
            (3, mirrored(vec![b - ratio(1, 3), Q::zero(), b.clone(), ratio(4, 3) - b - b]))
        }
        "ternary-four-point" => {
            let v = known(&[("mu", "1/11")])?;
            let mu = v.number("mu")?;
            let (sixth, half) = (mu / whole(6), mu / whole(2));
            let outer = [&sixth - ratio(1, 18), -&sixth - ratio(1, 18), Q::zero()];
            let inner = [ratio(7, 18) - &half, ratio(13, 18) + half];
            (3, mirrored([outer.as_slice(), &inner].concat()))
        }
        _ => return Ok(None),
    };
    Mask::new(node, arity, coefficients).map(Some)
}

/// `half`, 1, and `half` backwards.
fn mirrored(half: Vec<Q>) -> Vec<Q> {
    half.iter().cloned().chain([Q::one()]).chain(half.iter().rev().cloned()).collect()
}

/// The old points stay; a new point between them is the value at 1/2 of the polynomial through the points at
/// `1 − n/2, …, n/2`.
fn interpolating(n: i64) -> Vec<Q> {
    let nodes = || (1 - n / 2)..=n / 2;
    let weight = |j: i64| nodes().filter(|k| *k != j).fold(Q::one(), |w, k| w * ratio(1 - 2 * k, 2 * (j - k)));
    let mut mask = vec![Q::zero(); 2 * n as usize - 1];
    for (k, node) in nodes().enumerate() {
        mask[2 * k] = weight(node);
    }
    mask[n as usize - 1] = Q::one();
    mask
}

/// A mask that is written down.
pub fn given(node: &Node<'_>, form: &str) -> Checked<Mask> {
    node.known(if form == "filter" { "filter arity normalisation vertices" } else { "mask symbol arity vertices" })?;
    let arity = match node.get("arity") {
        None => 2,
        Some(n) => index(&n, MAX_PIECES + 1)?,
    };
    let value = node.field(form)?;
    if form == "symbol" {
        return Mask::new(node, arity, value.at(symbol::read(value.text()?))?);
    }
    let entries = value.each(|x| number(x))?;
    if form == "mask" {
        return Mask::new(node, arity, entries);
    }
    // a = √m h, and h is given as a multiple of √m where this is irrational.
    let root = match (1..=arity).find(|r| r * r == arity) {
        Some(root) => root,
        None => arity,
    };
    let named = match node.field("normalisation")?.text()? {
        "arity" => 1,
        "one" => arity,
        "root" => root,
        _ => return node.reject("format", "a normalisation is arity, one or root"),
    };
    // The sums of a mask leave no choice.
    let scaled = |factor: usize| Mask::new(node, arity, entries.iter().map(|h| h * whole(factor as i64)).collect());
    [1, arity, root].into_iter().fold(scaled(named), |found, factor| found.or_else(|why| scaled(factor).or(Err(why))))
}

impl Mask {
    fn new(node: &Node<'_>, arity: usize, mut coefficients: Vec<Q>) -> Checked<Self> {
        let first = coefficients.iter().position(|c| !c.is_zero());
        coefficients.drain(..node.some(first, "format", "a mask is not 0")?);
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        node.need((2..=MAX_PIECES).contains(&arity), "format", "the arity is from 2 to 64")?;
        let sum = |r: usize| coefficients.iter().skip(r).step_by(arity).sum::<Q>();
        node.need(
            (0..arity).all(|r| sum(r).is_one()),
            "case",
            "the coefficients of a residue class do not add up to 1",
        )?;
        node.need(coefficients.len() > arity, "case", "a mask of a constant")?;
        Ok(Self { arity, coefficients })
    }

    /// The operators `T_e[i][j] = a_{mi−j+e}` on the translates that meet `[0, 1]`.
    fn operators(&self) -> Checked<Vec<Matrix>> {
        let (m, last) = (self.arity, self.coefficients.len() - 1);
        let n = last.div_ceil(m - 1);
        spend(m * n * n, 64)?;
        crate::base::need(n <= crate::base::MAX_COORDINATES, "limit", "a mask for too many coordinates")?;
        let entry = |e: usize, k: usize| {
            let (plus, minus) = (m * (k / n) + e, k % n);
            if plus < minus || plus - minus > last { Q::zero() } else { self.coefficients[plus - minus].clone() }
        };
        Ok((0..m).map(|e| Matrix::new(n, n, &(0..n * n).map(|k| entry(e, k)).collect::<Vec<_>>())).collect())
    }

    /// The curve over `[0, 1]`, its coordinates in the order of the control points: with its vertices on all of them, otherwise on the smallest set of coordinates that the
    /// operators map into itself.
    pub fn curve(&self, node: &Node<'_>, vertices: bool) -> Checked<Curve> {
        let all = self.operators()?;
        let n = all[0].rows;
        node.need(n >= 2, "case", "the limit is constant between the integers")?;
        if vertices {
            let shift = |by: usize| Matrix::ones(n, n - 1, |i, j| i == j + by);
            let vertex = Vertex { op: backwards(&all[0].part(1..n, 1..n)), ends: [shift(0), shift(1)] };
            return Ok(Curve { vertex: Some(vertex), ..Curve::new(all.iter().map(backwards).collect()) });
        }
        let reached: Vec<Vec<usize>> = (0..n).map(|j| closure(&all, j)).collect();
        // A smallest set is reached from each of its members.
        let mut least: Vec<&Vec<usize>> =
            reached.iter().filter(|set| set.iter().all(|i| reached[*i].len() == set.len())).collect();
        least.sort();
        least.dedup();
        let [kept] = least.as_slice() else { return node.reject("case", "the limit depends on where it starts") };
        node.need(kept.len() >= 2, "case", "the limit is constant between the integers")?;
        let rows = |m: &Matrix| backwards(&m.columns(kept).transpose().columns(kept).transpose());
        Ok(Curve::new(all.iter().map(rows).collect()))
    }
}

/// The same operator with its coordinates in the opposite order: control points run with the parameter.
fn backwards(m: &Matrix) -> Matrix {
    let order: Vec<usize> = (0..m.cols).rev().collect();
    m.columns(&order).transpose().columns(&order).transpose()
}

/// The coordinates to which the operators take a coordinate, in any number of steps.
fn closure(operators: &[Matrix], start: usize) -> Vec<usize> {
    let n = operators[0].rows;
    let (mut inside, mut open) = (vec![false; n], vec![start]);
    while let Some(j) = open.pop() {
        if !std::mem::replace(&mut inside[j], true) {
            open.extend((0..n).filter(|i| operators.iter().any(|m| !m.data[i * n + j].is_zero())));
        }
    }
    (0..n).filter(|&i| inside[i]).collect()
}
