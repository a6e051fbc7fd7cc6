//! Algebraic laws of the exact spectrum, on random and on planted matrices.
#![cfg(feature = "strategies")]

use crate::chains;

use proptest::prelude::*;
use secant::arith::{Rational, ratio};
use secant::jordan::{Spectrum, char_poly};
use secant::linalg::Matrix;
use secant::poly::Poly;
use secant::strategies::column_stochastic;

fn check(a: &Matrix) -> Spectrum {
    chains::check(a, Spectrum::of(a))
}

fn small() -> impl Strategy<Value = Rational> {
    (-6i64..=6, 1i64..=4).prop_map(|(p, q)| ratio(p, q))
}

fn square(max: usize) -> impl Strategy<Value = Matrix> {
    (1..=max).prop_flat_map(|n| {
        prop::collection::vec(prop_oneof![Just(ratio(0, 1)), small()], n * n)
            .prop_map(move |v| Matrix::from_fn(n, n, |i, j| v[i * n + j].clone()))
    })
}

/// A unimodular matrix from elementary operations.
fn unimodular(n: usize, moves: &[(usize, usize, i64)]) -> Matrix {
    let mut s = Matrix::identity(n);
    for &(i, j, c) in moves {
        let (i, j) = (i % n, j % n);
        if i != j {
            for k in 0..n {
                let change = &s[(j, k)] * ratio(c, 1);
                s[(i, k)] += change;
            }
        }
    }
    s
}

/// A block diagonal matrix: companion blocks of `f^size`, which have one Jordan block of that size for every root.
fn planted(blocks: &[(Poly, usize)]) -> Matrix {
    let n: usize = blocks.iter().map(|(f, s)| f.degree().unwrap() * s).sum();
    let mut m = Matrix::zero(n, n);
    let mut at = 0;
    for (f, size) in blocks {
        let g = f.pow(*size);
        let d = g.degree().unwrap();
        for i in 0..d {
            m[(at + i, at + d - 1)] = -g.coeff(i);
            if i > 0 {
                m[(at + i, at + i - 1)] = ratio(1, 1);
            }
        }
        at += d;
    }
    m
}

fn irreducible(k: usize) -> Poly {
    let c: [&[i64]; 7] = [&[0, 1], &[-1, 2], &[1, 3], &[1, 0, 1], &[-2, 0, 1], &[1, 1, 1], &[-1, -1, 0, 1]];
    Poly::new(c[k].iter().map(|x| ratio(*x, 1)).collect()).monic()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn random_matrices_keep_every_law(a in square(6)) {
        check(&a);
    }

    #[test]
    fn stochastic_matrices_have_the_eigenvalue_one_on_top(a in column_stochastic(1..=7)) {
        let s = check(&a);
        let one = s.factors.iter().find(|f| f.poly == Poly::linear(&ratio(1, 1)));
        prop_assert!(one.is_some());
        for e in s.eigenvalues() {
            prop_assert!(s.root(e).cmp_modulus_rational(&ratio(1, 1)).is_le());
        }
    }

    #[test]
    fn planted_blocks_come_back(
        plan in prop::collection::vec((0usize..7, 1usize..=3), 1..=4),
        moves in prop::collection::vec((0usize..12, 0usize..12, -1i64..=1), 0..14),
    ) {
        let blocks: Vec<(Poly, usize)> = plan.iter().map(|(k, s)| (irreducible(*k), *s)).collect();
        let j = planted(&blocks);
        prop_assume!(j.rows() <= 12);
        let s = unimodular(j.rows(), &moves);
        let a = &(&s * &j) * &s.inverse().unwrap();
        let spectrum = check(&a);
        for f in &spectrum.factors {
            let mut expected: Vec<usize> = blocks.iter().filter(|(g, _)| *g == f.poly).map(|(_, s)| *s).collect();
            expected.sort_unstable_by(|a, b| b.cmp(a));
            prop_assert_eq!(&f.blocks, &expected);
        }
        let transposed = Spectrum::of(&a.transpose());
        for (f, g) in spectrum.factors.iter().zip(&transposed.factors) {
            prop_assert_eq!((&f.poly, &f.blocks), (&g.poly, &g.blocks));
        }
    }

    #[test]
    fn characteristic_polynomials_of_products_commute(a in square(5), seed in 0u64..1000) {
        let n = a.rows();
        let b = Matrix::from_fn(n, n, |i, j| ratio(((seed as i64 + 7) * (3 * i as i64 + 5 * j as i64 + 1)) % 11 - 5, 3));
        prop_assert_eq!(char_poly(&(&a * &b)), char_poly(&(&b * &a)));
    }
}

#[test]
fn equal_moduli_are_recognised() {
    // x^3 = 1/2, a real pair of opposite numbers, a rational circle, 0.
    let polys = [
        Poly::new(vec![ratio(-1, 2), ratio(0, 1), ratio(0, 1), ratio(1, 1)]),
        Poly::new(vec![ratio(1, 2), ratio(0, 1), ratio(0, 1), ratio(1, 1)]),
        Poly::new(vec![ratio(-3, 1), ratio(0, 1), ratio(1, 1)]),
        Poly::new(vec![ratio(3, 1), ratio(1, 1), ratio(1, 1)]),
        Poly::linear(&ratio(0, 1)),
    ];
    let s = check(&planted(&polys.map(|p| (p, 1))));
    let sizes: Vec<usize> = s.classes.iter().map(|c| c.members.len()).collect();
    assert_eq!(sizes, [4, 6, 1]);
}

#[test]
fn empty_and_tiny() {
    let s = Spectrum::of(&Matrix::zero(0, 0));
    assert!(s.factors.is_empty() && s.classes.is_empty());
    assert_eq!(s.char_poly, Poly::constant(ratio(1, 1)));
    let s = check(&Matrix::zero(3, 3));
    assert_eq!(s.factors[0].blocks, [1, 1, 1]);
}
