//! Matrices of polynomials in the parameter.

use super::polynomial::{Poly, minus, trimmed};
use crate::base::{Checked, Q, need, spend};
use num_traits::{One, Zero};

pub type Rows = Vec<Vec<Poly>>;

/// Highest degree of an entry that is computed.
const MAX_DEGREE: usize = 390;

pub fn plus(a: &[Q], b: &[Q]) -> Poly {
    minus(a, &minus(&[], b))
}

pub fn times(a: &[Q], b: &[Q]) -> Checked<Poly> {
    if a.is_empty() || b.is_empty() {
        return Ok(Vec::new());
    }
    need(a.len() + b.len() <= MAX_DEGREE, "limit", "a polynomial of too high a degree")?;
    spend(a.len() * b.len(), 64)?;
    let mut product = vec![Q::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        b.iter().enumerate().for_each(|(j, y)| product[i + j] += x * y);
    }
    Ok(trimmed(product))
}

pub fn scaled(a: &[Q], by: &Q) -> Poly {
    trimmed(a.iter().map(|c| c * by).collect())
}

/// `f / g` where that is a polynomial.
pub fn divided(f: &[Q], g: &[Q]) -> Checked<Poly> {
    let (mut rest, mut quotient) = (f.to_vec(), Vec::new());
    need(!g.is_empty(), "limit", "a division by 0")?;
    while rest.len() >= g.len() {
        let c = &rest[rest.len() - 1] / &g[g.len() - 1];
        let shift = rest.len() - g.len();
        g.iter().enumerate().for_each(|(k, x)| rest[shift + k] -= &c * x);
        rest.pop();
        quotient.push(c);
        spend(g.len(), 64)?;
    }
    need(rest.iter().all(Zero::is_zero), "limit", "a division left a remainder")?;
    quotient.reverse();
    Ok(trimmed(quotient))
}

pub fn dot(a: &[Poly], b: &[Poly]) -> Checked<Poly> {
    a.iter().zip(b).try_fold(Vec::new(), |s, (x, y)| Ok(plus(&s, &times(x, y)?)))
}

pub fn apply(m: &Rows, v: &[Poly]) -> Checked<Vec<Poly>> {
    m.iter().map(|row| dot(row, v)).collect()
}

pub fn identity(n: usize) -> Rows {
    (0..n).map(|i| (0..n).map(|j| if i == j { vec![Q::one()] } else { Vec::new() }).collect()).collect()
}

pub fn column(m: &Rows, j: usize) -> Vec<Poly> {
    m.iter().map(|row| row[j].clone()).collect()
}

pub fn product(a: &Rows, b: &Rows) -> Checked<Rows> {
    a.iter().map(|row| (0..b[0].len()).map(|j| dot(row, &column(b, j))).collect()).collect()
}

/// The coefficients of `det(x − M)`, lowest first, and the matrices `M_k` with `adj(x − M) = Σ M_k x^k` (Faddeev, Le Verrier).
pub fn characteristic(m: &Rows) -> Checked<(Vec<Poly>, Vec<Rows>)> {
    let n = m.len();
    let mut chi = vec![vec![Q::one()]];
    let (mut next, mut all) = (identity(n), Vec::new());
    for k in 1..=n {
        all.push(next.clone());
        let image = product(m, &next)?;
        let trace = (0..n).fold(Vec::new(), |s: Poly, i| plus(&s, &image[i][i]));
        let c = scaled(&trace, &(-Q::one() / Q::from_integer(k.into())));
        next = image;
        (0..n).for_each(|i| next[i][i] = plus(&next[i][i], &c));
        chi.push(c);
    }
    chi.reverse();
    all.reverse();
    Ok((chi, all))
}

/// A polynomial with polynomials as coefficients at a polynomial.
pub fn at(coefficients: &[Poly], x: &[Q]) -> Checked<Poly> {
    coefficients.iter().rev().try_fold(Vec::new(), |v: Poly, c| Ok(plus(&times(&v, x)?, c)))
}

/// `adj(x − M)`.
pub fn adjugate(all: &[Rows], x: &[Q]) -> Checked<Rows> {
    let n = all.len();
    let entry = |i: usize, j: usize| {
        let coefficients: Vec<Poly> = all.iter().map(|m| m[i][j].clone()).collect();
        at(&coefficients, x)
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

pub fn determinant(m: &Rows) -> Checked<Poly> {
    let constant = characteristic(m)?.0.swap_remove(0);
    Ok(if m.len().is_multiple_of(2) { constant } else { minus(&[], &constant) })
}
