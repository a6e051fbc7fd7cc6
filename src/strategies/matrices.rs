//! Random stochastic matrices, with a Jordan structure planted where it is asked for.

use crate::arith::{Rational, ratio};
use crate::linalg::Matrix;
use crate::poly::Poly;
use proptest::prelude::*;
use std::ops::RangeInclusive;

/// Square matrices with nonnegative entries whose columns sum to 1, of the sizes given.
///
/// Entries are multiples of `1/t` with a total `t ≤ 4 n` for each column; zeros are common, so that reducible and periodic
/// matrices occur.
pub fn column_stochastic(sizes: RangeInclusive<usize>) -> impl Strategy<Value = Matrix> {
    sizes.prop_flat_map(|n| {
        prop::collection::vec(0u8..5, n * n).prop_map(move |v| {
            let total = |j: usize| (0..n).map(|i| i64::from(v[i * n + j])).sum::<i64>();
            Matrix::from_fn(n, n, |i, j| match total(j) {
                0 => ratio(i64::from(i == j), 1),
                t => ratio(i64::from(v[i * n + j]), t),
            })
        })
    })
}

/// Square matrices with entries of both signs whose columns sum to 1, as the operators of subdivision curves have them.
pub fn signed_stochastic(sizes: RangeInclusive<usize>) -> impl Strategy<Value = Matrix> {
    sizes.prop_flat_map(|n| {
        prop::collection::vec((-4i64..=6, 1i64..=8), n * n).prop_map(move |v| {
            let mut m = Matrix::from_fn(n, n, |i, j| ratio(v[i * n + j].0, v[i * n + j].1));
            for j in 0..n {
                let sum = (0..n).fold(ratio(0, 1), |s, i| s + &m[(i, j)]);
                let missing = ratio(1, 1) - sum;
                m[(j, j)] += missing;
            }
            m
        })
    })
}

/// A matrix with column sums 1 whose Jordan structure is known.
#[derive(Debug, Clone)]
pub struct PlantedJordan {
    /// The matrix.
    pub matrix: Matrix,
    /// Irreducible factors of its characteristic polynomial, monic, with the sizes of the blocks of each of their roots,
    /// largest first. The eigenvalue 1 of the columns' sum is among them, with one block of size 1.
    pub blocks: Vec<(Poly, Vec<usize>)>,
}

/// Matrices `S J S⁻¹` with column sums 1, where `J` has the eigenvalue 1 once and besides up to `most` blocks of sizes up to 3
/// of rational, quadratic and cubic eigenvalues of modulus below 1.
///
/// The size is at most `1 + 9 · most`; `S` is unimodular, so that entries stay short.
pub fn planted_jordan(most: usize) -> impl Strategy<Value = PlantedJordan> {
    let plan = prop::collection::vec((0usize..POLYS.len(), 1usize..=3), 1..=most.max(1));
    let moves = prop::collection::vec((0usize..64, 0usize..64, -1i64..=1), 0..16);
    (plan, moves).prop_map(|(plan, moves)| planted(&plan, &moves))
}

/// Irreducible polynomials with roots of modulus below 1, lowest coefficient first, as numerators over a denominator.
const POLYS: [(&[i64], i64); 7] =
    [(&[0, 1], 1), (&[-1, 2], 2), (&[1, 3], 3), (&[-1, 4], 4), (&[-1, 0, 2], 2), (&[1, 1, 2], 2), (&[-1, 0, 0, 2], 2)];

fn planted(plan: &[(usize, usize)], moves: &[(usize, usize, i64)]) -> PlantedJordan {
    let mut blocks: Vec<(Poly, Vec<usize>)> = vec![(Poly::linear(&ratio(1, 1)), vec![1])];
    let mut companions = Vec::new();
    for &(k, size) in plan {
        let f = Poly::new(POLYS[k].0.iter().map(|c| ratio(*c, POLYS[k].1)).collect()).monic();
        companions.push(f.pow(size));
        match blocks.iter_mut().find(|(g, _)| *g == f) {
            Some((_, sizes)) => sizes.push(size),
            None => blocks.push((f, vec![size])),
        }
    }
    blocks.iter_mut().for_each(|(_, sizes)| sizes.sort_unstable_by(|a, b| b.cmp(a)));
    let n: usize = 1 + companions.iter().filter_map(Poly::degree).sum::<usize>();
    // The first row is (1, 0, …): with the frame below, which has the row of ones first, the columns sum to 1.
    let mut j = Matrix::zero(n, n);
    j[(0, 0)] = ratio(1, 1);
    let mut at = 1;
    for g in &companions {
        let d = g.degree().unwrap_or(0);
        for i in 0..d {
            j[(at + i, at + d - 1)] = -g.coeff(i);
            if i > 0 {
                j[(at + i, at + i - 1)] = ratio(1, 1);
            }
        }
        at += d;
    }
    let mut s = Matrix::identity(n);
    for &(a, b, c) in moves {
        // The first row stays.
        let (a, b) = (1 + a % (n - 1).max(1), b % n);
        if a < n && a != b {
            for k in 0..n {
                let change = &s[(b, k)] * ratio(c, 1);
                s[(a, k)] += change;
            }
        }
    }
    // x_0 = 1 − Σ others, so that the functional e_0 becomes the sum of the coordinates.
    let sums = Matrix::from_fn(n, n, |i, k| if i == 0 { ratio(1, 1) } else { ratio(i64::from(i == k), 1) });
    let frame = &s * &sums;
    let back = frame.inverse().expect("a product of elementary matrices has an inverse");
    PlantedJordan { matrix: &(&back * &j) * &frame, blocks }
}

/// A rational of size at most `most`, with a denominator of 1 to 8.
pub(super) fn below(most: Rational) -> impl Strategy<Value = Rational> {
    (-8i64..=8, 1i64..=8).prop_map(move |(p, q)| {
        let x = ratio(p, q.max(p.abs()));
        x * &most
    })
}
