#![allow(clippy::float_arithmetic)] // values for comparison

use super::*;
use crate::arith::ratio;
use proptest::prelude::*;

fn matrix(n: usize, texts: &[&str]) -> FieldMatrix {
    let (field, x) = NumberField::read(texts).unwrap_or_else(|(k, e)| panic!("{}: {e}", texts[k]));
    FieldMatrix::new(&field, n, n, x)
}

/// What must hold for every spectrum, apart from what its construction asserts.
fn check(a: &FieldMatrix) -> FieldSpectrum {
    let s = FieldSpectrum::of(a);
    let shrunk = a.shrunk();
    assert_eq!(s.char_poly(), shrunk.char_poly());
    assert!(shrunk.evaluate(&s.min_poly()).is_zero());
    let transpose = shrunk.transpose();
    for f in &s.factors {
        assert!(f.holds(&shrunk, &f.right) && f.holds(&transpose, &f.left));
        assert_eq!(f.blocks, f.left.iter().map(|c| c.vectors.len()).collect::<Vec<_>>());
        for (root, theta) in f.roots.iter().zip(&f.generators) {
            // The factor vanishes at λ.
            let powers = part::powers(&f.alpha, s.field.degree(), &f.generator);
            let value = f
                .poly
                .iter()
                .rev()
                .fold(Elem::zero(), |acc, c| acc.mul(&f.lambda, &f.generator).add(&part::substituted(c, &powers)));
            assert!(value.is_zero());
            assert!(crate::algebraic::locate(&f.lambda, theta).same(root));
            let alpha = crate::algebraic::locate(&f.alpha, theta);
            assert!(s.field.is_rational() || alpha.same(s.field.generator()));
        }
    }
    s
}

fn eigenvalues(s: &FieldSpectrum) -> Vec<(String, Vec<usize>)> {
    let mut out = Vec::new();
    for f in &s.factors {
        out.push((s.field.display(&f.poly[0].neg()), f.blocks.clone()));
    }
    out
}

#[test]
fn a_triangular_matrix_over_a_quadratic_field() {
    let a = matrix(
        4,
        &["sqrt(5)", "1", "0", "2", "0", "sqrt(5)", "0", "1", "0", "0", "-sqrt(5)", "3", "0", "0", "0", "1/2"],
    );
    let s = check(&a);
    let mut found = eigenvalues(&s);
    found.sort();
    let expected =
        [("-sqrt(5)", vec![1]), ("1/2", vec![1]), ("sqrt(5)", vec![2])].map(|(t, b)| (t.to_owned(), b)).to_vec();
    assert_eq!(found, expected);
    // ±sqrt 5 have one modulus.
    assert_eq!(s.classes.iter().map(|c| c.members.len()).collect::<Vec<_>>(), [2, 1]);
}

#[test]
fn eigenvalues_outside_the_field() {
    // x^2 - sqrt 2 and x^2 + 1
    let a = matrix(4, &["0", "sqrt(2)", "0", "0", "1", "0", "0", "0", "0", "0", "0", "-1", "1", "0", "1", "0"]);
    let s = check(&a);
    let mut degrees: Vec<(usize, usize)> =
        s.factors.iter().map(|f| (f.degree(), f.minpoly.degree().unwrap())).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [(2, 2), (2, 4)]);
    assert_eq!(s.classes.len(), 2);
    let fourth = 2f64.powf(0.25);
    let moduli: Vec<f64> = s.classes.iter().map(|c| s.root(c.members[0]).to_f64().0).collect();
    assert!((moduli[0].abs() - fourth).abs() < 1e-12);
}

#[test]
fn a_circulant_matrix_of_cosines() {
    let n = 7;
    let texts: Vec<String> = (0..n * n)
        .map(|k| {
            let shift = (k % n + n - k / n) % n;
            let own = if shift == 0 { "+1/4" } else { "" };
            format!("(3+2*cos(2*pi*{shift}/7))/28{own}")
        })
        .collect();
    let a = matrix(n, &texts.iter().map(String::as_str).collect::<Vec<_>>());
    let s = check(&a);
    assert_eq!(s.field.degree(), 3);
    let mut found = eigenvalues(&s);
    found.sort();
    let expected = [("1", vec![1]), ("1/2", vec![1, 1]), ("1/4", vec![1; 4])].map(|(t, b)| (t.to_owned(), b)).to_vec();
    assert_eq!(found, expected);
}

#[test]
fn rational_matrices_have_the_rational_spectrum() {
    let a = matrix(3, &["sqrt(4)", "sqrt(2)*sqrt(2)", "1", "0", "1/2", "1", "0", "1", "0"]);
    let s = check(&a);
    let plain = Spectrum::of(&a.shrunk().rational().unwrap());
    assert_eq!(s.factors.len(), plain.factors.len());
    for (f, g) in s.factors.iter().zip(&plain.factors) {
        assert_eq!((&f.minpoly, &f.blocks, &f.right, &f.left), (&g.poly, &g.blocks, &g.right, &g.left));
        assert_eq!(f.roots, g.roots);
    }
    assert_eq!(s.classes, plain.classes);
}

#[test]
fn symmetry_gives_the_same_factors() {
    // A vertex with five sectors of four points; only the rule of the vertex is irrational.
    let n = 21;
    let texts: Vec<String> = (0..n * n)
        .map(|k| {
            let (i, j) = (k / n, k % n);
            match (i, j) {
                (0, 0) => "1 - 20*sqrt(2)/64".to_owned(),
                (0, _) => "sqrt(2)/64".to_owned(),
                (_, 0) => format!("1/{}", 2 + (i - 1) / 5),
                _ => format!("{}/16", ((j + 20 - i) % 5 * 3 + (i - 1) / 5 * 2 + (j - 1) / 5) % 4),
            }
        })
        .collect();
    let a = matrix(n, &texts.iter().map(String::as_str).collect::<Vec<_>>());
    let split = part::all(&a);
    let s = FieldSpectrum::of(&a);
    assert_eq!(s.char_poly(), a.char_poly());
    assert!(split.len() == s.factors.len());
}

fn element() -> impl Strategy<Value = Elem> {
    (-2i64..=2, -2i64..=2).prop_map(|(a, b)| Elem(Poly::new(vec![ratio(a, 1), ratio(b, 1)])))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Planted eigenvalues in `K`, in blocks of size 1 and 2, come back after a similarity transform.
    #[test]
    fn planted_blocks_come_back(radicand in prop::sample::select(vec![2i64, 3, 5]), values in prop::collection::vec((element(), 1usize..3), 2..4), shears in prop::collection::vec((0usize..6, 0usize..6, element()), 4)) {
        let (field, _) = NumberField::read(&[&format!("sqrt({radicand})")]).unwrap();
        let n: usize = values.iter().map(|v| v.1).sum();
        let mut a = FieldMatrix::from_fn(&field, n, n, |_, _| Elem::zero());
        let mut at = 0;
        for (x, size) in &values {
            for k in at..at + size {
                a[(k, k)] = x.clone();
                if k + 1 < at + size {
                    a[(k, k + 1)] = Elem::from_rational(&1.into());
                }
            }
            at += size;
        }
        for (i, j, x) in &shears {
            let (i, j) = (i % n, j % n);
            if i != j {
                let shear = |sign: i64| {
                    let mut m = FieldMatrix::identity(&field, n);
                    m[(i, j)] = x.scale(&ratio(sign, 1));
                    m
                };
                a = shear(1).mul(&a).mul(&shear(-1));
            }
        }
        let s = check(&a);
        let mut planted: std::collections::BTreeMap<Poly, Vec<usize>> = std::collections::BTreeMap::new();
        for (x, size) in values {
            planted.entry(x.0).or_default().push(size);
        }
        planted.values_mut().for_each(|v| v.sort_unstable_by(|a, b| b.cmp(a)));
        let small = a.shrunk();
        for f in &s.factors {
            prop_assert!(f.in_field());
            // In a smaller field the eigenvalues are rational.
            let value = f.poly[0].neg();
            let value = if small.field().is_rational() { value.is_rational().map(Poly::constant).unwrap() } else { value.0 };
            prop_assert_eq!(planted.get(&value), Some(&f.blocks));
        }
        prop_assert_eq!(s.factors.len(), planted.len());
    }

    /// Random matrices over cubic and quadratic fields satisfy everything that is checked.
    #[test]
    fn random_matrices_have_spectra(cubic in any::<bool>(), n in 1usize..4, entries in prop::collection::vec((-3i64..=3, -3i64..=3, -1i64..=1), 9)) {
        let (field, _) = NumberField::read(&[if cubic { "2*cos(2*pi/7)" } else { "sqrt(3)" }]).unwrap();
        let entry = |(a, b, c): &(i64, i64, i64)| {
            Elem(Poly::new(vec![ratio(*a, 2), ratio(*b, 3), ratio(if cubic { *c } else { 0 }, 1)]))
        };
        let a = FieldMatrix::from_fn(&field, n, n, |i, j| entry(&entries[i * n + j]));
        check(&a);
    }
}
