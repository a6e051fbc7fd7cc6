//! Everything that a spectrum claims, checked by definition.

use secant::algebraic::{Elem, Root};
use secant::arith::ratio;
use secant::jordan::{Chain, Spectrum, char_poly};
use secant::linalg::Matrix;
use secant::poly::Poly;

fn evaluate(f: &Poly, a: &Matrix) -> Matrix {
    let n = a.rows();
    f.coeffs().iter().rev().fold(Matrix::zero(n, n), |acc, c| &(&acc * a) + &Matrix::identity(n).scale(c))
}

/// `(A - θ) v` over `Q[x] / (f)`.
fn apply_minus_root(a: &Matrix, f: &Poly, v: &[Elem]) -> Vec<Elem> {
    let theta = Elem::generator(f);
    (0..a.rows())
        .map(|i| {
            let sum = v.iter().enumerate().fold(Elem::zero(), |acc, (j, x)| acc.add(&x.scale(&a[(i, j)])));
            sum.sub(&theta.mul(&v[i], f))
        })
        .collect()
}

fn check_chain(a: &Matrix, f: &Poly, chain: &Chain) {
    for (j, v) in chain.vectors.iter().enumerate() {
        let image = apply_minus_root(a, f, v);
        if j == 0 {
            assert!(image.iter().all(Elem::is_zero));
            assert!(!v.iter().all(Elem::is_zero));
        } else {
            assert_eq!(image, chain.vectors[j - 1]);
        }
    }
}

/// The rank over the field of the vectors.
fn rank(f: &Poly, mut rows: Vec<Vec<Elem>>) -> usize {
    let mut rank = 0;
    let width = rows.first().map_or(0, Vec::len);
    for col in 0..width {
        let Some(pivot) = (rank..rows.len()).find(|&r| !rows[r][col].is_zero()) else { continue };
        rows.swap(rank, pivot);
        let inverse = rows[rank][col].inv(f).expect("not zero");
        let top = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let factor = row[col].mul(&inverse, f);
            for (x, y) in row.iter_mut().zip(&top) {
                *x = x.sub(&factor.mul(y, f));
            }
        }
        rank += 1;
    }
    rank
}

/// Checks polynomials, blocks, chains of both sides and their independence, and the order of the moduli.
pub fn check(a: &Matrix, s: Spectrum) -> Spectrum {
    let product = s.factors.iter().fold(Poly::constant(ratio(1, 1)), |acc, f| &acc * &f.poly.pow(f.multiplicity));
    assert_eq!(product, s.char_poly);
    assert_eq!(s.char_poly, char_poly(a));
    assert!(evaluate(&s.min_poly(), a).is_zero());
    let transpose = a.transpose();
    for f in &s.factors {
        assert_eq!(f.blocks.iter().sum::<usize>(), f.multiplicity);
        assert!(f.blocks.windows(2).all(|w| w[0] >= w[1]));
        for (matrix, chains) in [(a, &f.right), (&transpose, &f.left)] {
            assert_eq!(chains.iter().map(|c| c.vectors.len()).collect::<Vec<_>>(), f.blocks);
            chains.iter().for_each(|c| check_chain(matrix, &f.poly, c));
            let vectors: Vec<Vec<Elem>> = chains.iter().flat_map(|c| c.vectors.clone()).collect();
            assert_eq!(rank(&f.poly, vectors), f.multiplicity);
        }
    }
    check_classes(&s);
    s
}

fn check_classes(s: &Spectrum) {
    let expected: usize = s.factors.iter().map(|f| f.roots.len()).sum();
    assert_eq!(s.eigenvalues().count(), expected);
    let middle = |r: &Root| {
        let m = r.modulus(80);
        (m.lo, m.hi)
    };
    for class in &s.classes {
        let first = middle(s.root(class.members[0]));
        for e in &class.members {
            let (lo, hi) = middle(s.root(*e));
            assert!(lo <= first.1 && first.0 <= hi);
        }
    }
    for pair in s.classes.windows(2) {
        assert!(s.root(pair[0].members[0]).cmp_modulus(s.root(pair[1].members[0])).is_gt());
    }
}
