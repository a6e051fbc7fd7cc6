use super::*;
use crate::arith::{Interval, Rational, parse_rational, ratio};
use crate::poly::{Poly, factor};
use std::cmp::Ordering;

fn p(c: &[i64]) -> Poly {
    Poly::new(c.iter().map(|x| ratio(*x, 1)).collect())
}

/// The roots refine to narrow, disjoint enclosures, and their sum and product are what the polynomial says.
fn check(f: &Poly, real: usize) {
    let all = roots(f);
    let n = f.degree().unwrap();
    assert_eq!(all.len(), n);
    assert_eq!(all.iter().filter(|r| r.is_real()).count(), real, "{}", f.primitive_display("x"));
    let mut sum = Interval::point(Rational::from(0));
    for r in &all {
        let (re, im) = r.enclosure(200);
        assert!(re.width() <= Rational::from(1) >> 200i64 && im.width() <= Rational::from(1) >> 200i64);
        assert_eq!(im.sign() == Some(0), r.is_real());
        sum = &sum + &re;
        assert!(r.conjugate().conjugate().same(r));
    }
    let expected = -f.monic().coeff(n - 1);
    assert!(sum.lo <= expected && expected <= sum.hi);
    assert!(all[..real].windows(2).all(|w| cmp_real(&w[0], &w[1]) == Ordering::Less));
}

#[test]
fn clustered_and_ill_conditioned_roots() {
    // Mignotte: two real roots about 10^-34 apart.
    let mut mignotte = Poly::new((0..=20).map(|k| ratio(i64::from(k == 20), 1)).collect());
    mignotte = &mignotte - &p(&[-1, 1000]).pow(2).scale(&ratio(2, 1));
    check(&mignotte, 4);
    // Wilkinson, with a perturbation of one coefficient.
    let wilkinson = (1..=20).fold(p(&[1]), |acc, k| &acc * &p(&[-k, 1]));
    check(&wilkinson, 20);
    let mut c = wilkinson.coeffs().to_vec();
    c[19] -= ratio(1, 1 << 23);
    check(&Poly::new(c), 10);
    // Chebyshev of degree 40, whose roots are dense at the ends.
    let (mut a, mut b) = (p(&[1]), p(&[0, 1]));
    for _ in 1..40 {
        (a, b) = (b.clone(), &(&p(&[0, 2]) * &b) - &a);
    }
    check(&b, 40);
}

#[test]
fn widely_different_sizes() {
    let huge = parse_rational("1e300").unwrap();
    check(&Poly::new(vec![ratio(1, 1), ratio(0, 1), huge.clone(), ratio(1, 1)]), 1);
    check(&Poly::new(vec![ratio(-1, 1), huge.clone(), ratio(0, 1), &huge * &huge]), 1);
}

#[test]
fn sizes_beyond_double_precision() {
    let beyond = parse_rational("1e1200").unwrap();
    check(&Poly::new(vec![ratio(1, 1), ratio(1, 1), beyond.clone()]), 0);
    check(&Poly::new(vec![ratio(-1, 1), beyond, ratio(0, 1), ratio(1, 1)]), 1);
}

#[test]
fn equal_real_parts_are_ordered_by_the_imaginary_part() {
    // x^4 + 3x^2 + 1 moved by 1/3: all four roots have the same real part.
    let f = p(&[1, 0, 3, 0, 1]).shifted(&ratio(-1, 3));
    let all = roots(&f);
    let im: Vec<f64> = all.iter().map(|r| r.to_f64().1).collect();
    assert!(im[0] > 0.0 && im[2] > im[0] && im[1] == -im[0]);
    assert_eq!(all[0].cmp_modulus(&all[1]), Ordering::Equal);
    assert_eq!(all[0].cmp_modulus(&all[2]), Ordering::Less);
}

#[test]
fn moduli_that_are_equal_for_no_simple_reason() {
    // Salem's polynomial of Lehmer: eight roots on the unit circle, two real ones off it.
    let lehmer = p(&[1, 1, 0, -1, -1, -1, -1, -1, 0, 1, 1]);
    let all = roots(&lehmer);
    assert_eq!(all.iter().filter(|r| r.cmp_modulus_rational(&ratio(1, 1)) == Ordering::Equal).count(), 8);
    // |a + b i| with a and b conjugate in pairs: products of roots of different factors.
    let f = p(&[5, 2, 1]);
    let g = p(&[5, 4, 1]);
    let h = p(&[-5, 0, 1]);
    let one = |f: &Poly| roots(f)[0].clone();
    assert_eq!(one(&f).cmp_modulus(&one(&g)), Ordering::Equal);
    assert_eq!(one(&f).cmp_modulus(&one(&h)), Ordering::Equal);
    assert_eq!(one(&p(&[6, 2, 1])).cmp_modulus(&one(&g)), Ordering::Greater);
    // The same irrational modulus from two factors: x^2 - 2x + s has |x|^2 = s for both roots, s = 3 + sqrt 2.
    let norm = |c: i64| factor(&(&p(&[3, c, 1]).pow(2) - &p(&[2])))[0].0.clone();
    let (u, v) = (roots(&norm(1)), roots(&norm(-2)));
    let matches = u.iter().flat_map(|a| v.iter().map(move |b| a.cmp_modulus(b))).filter(|o| o.is_eq()).count();
    assert_eq!(matches, 8);
}

#[test]
fn elements_of_a_field() {
    let f = p(&[-2, 0, 0, 1]);
    let theta = Elem::generator(&f);
    let x = theta.mul(&theta, &f).sub(&Elem::from_rational(&ratio(3, 2)));
    assert_eq!(x.mul(&x.inv(&f).unwrap(), &f), Elem::from_rational(&ratio(1, 1)));
    assert!(Elem::zero().inv(&f).is_none());
    let all = roots(&f);
    assert_eq!(x.sign(&all[0]), 1);
    let located = locate(&x, &all[0]);
    assert_eq!(located.minpoly(), &x.minpoly(&f));
    assert!(located.is_real());
    assert_eq!(x.minpoly(&f).degree(), Some(3));
    let square = theta.mul(&theta.mul(&theta, &f), &f);
    assert_eq!(square.is_rational(), Some(ratio(2, 1)));
    assert_eq!(locate(&square, &all[1]).rational(), Some(ratio(2, 1)));
}

#[test]
fn quotients_that_are_roots_of_unity() {
    let all = roots(&p(&[-2, 0, 0, 0, 0, 1]));
    assert!(all[0].ratio_is_root_of_unity(&all[3]));
    let g = roots(&p(&[5, 2, 1]));
    assert!(!g[0].ratio_is_root_of_unity(&g[1]));
    assert!(roots(&p(&[1, 1, 1]))[0].ratio_is_root_of_unity(&Root::from_rational(&ratio(-1, 1))));
}

#[test]
fn real_roots_alone_are_the_real_ones_of_all() {
    let mut seed = 5;
    for n in 2..14usize {
        let mut random = || (crate::poly::modp::next_random(&mut seed) % 41) as i64 - 20;
        let f = Poly::new((0..=n).map(|_| ratio(random(), 1)).collect());
        for (g, _) in factor(&f).into_iter().filter(|(g, _)| g.degree() > Some(0)) {
            let (all, real) = (roots(&g), real_roots(&g));
            assert_eq!(all.iter().filter(|r| r.is_real()).count(), real.len());
            for (a, b) in all.iter().zip(&real) {
                assert_eq!(a, b);
                let (x, y) = (a.enclosure(300).0, b.enclosure(300).0);
                assert!(!x.disjoint(&y) && y.width() <= Rational::from(1) >> 300i64);
                assert_eq!(a.sign(), b.sign());
                // The set of the real ones finds the others when they are asked for.
                assert_eq!(b.cmp_modulus(&all[all.len() - 1]), a.cmp_modulus(&all[all.len() - 1]));
            }
        }
    }
    let mignotte = &Poly::new((0..=20).map(|k| ratio(i64::from(k == 20), 1)).collect())
        - &p(&[-1, 1000]).pow(2).scale(&ratio(2, 1));
    let close = real_roots(&mignotte);
    assert_eq!(close.len(), 4);
    assert!(close.windows(2).all(|w| cmp_real(&w[0], &w[1]) == Ordering::Less));
    assert_eq!(positive_roots(&(&p(&[-2, 0, 1]) * &p(&[6, -5, 1]).pow(2))).len(), 3);
}

/// The polynomial whose roots are the sums, or the products, of a root of each.
fn combined(f: &Poly, g: &Poly, sums: bool) -> Poly {
    let (n, m) = (f.degree().unwrap(), g.degree().unwrap());
    let companion = |f: &Poly, i: usize, j: usize| {
        let n = f.degree().unwrap();
        if j + 1 == n { -f.coeff(i) } else { ratio(i64::from(i == j + 1), 1) }
    };
    let delta = |i: usize, j: usize| ratio(i64::from(i == j), 1);
    let entry = |i: usize, j: usize| {
        let (a, b) = (companion(f, i / m, j / m), companion(g, i % m, j % m));
        if sums { a * delta(i % m, j % m) + b * delta(i / m, j / m) } else { a * b }
    };
    crate::linalg::char_poly(&crate::linalg::Matrix::from_fn(n * m, n * m, entry))
}

#[test]
fn ties_that_have_no_simple_reason() {
    // x³ - x - 1 and x³ + 2x - 5 have one real root and one pair each: the sums a + b, a + conj b have equal real parts,
    // the products a b and a conj b equal moduli.
    let (f, g) = (p(&[-1, -1, 0, 1]), p(&[-5, 2, 0, 1]));
    let sums = roots(&combined(&f, &g, true));
    assert_eq!((sums.len(), sums.iter().filter(|r| r.is_real()).count()), (9, 1));
    let parts: Vec<(f64, f64)> = sums[1..].iter().step_by(2).map(Root::to_f64).collect();
    let order = |a: &(f64, f64), b: &(f64, f64)| {
        if (a.0 - b.0).abs() < 1e-12 { a.1.partial_cmp(&b.1).unwrap() } else { a.0.partial_cmp(&b.0).unwrap() }
    };
    assert!(parts.windows(2).all(|w| order(&w[0], &w[1]) == Ordering::Less), "{parts:?}");
    assert_eq!(parts.windows(2).filter(|w| (w[0].0 - w[1].0).abs() < 1e-12).count(), 1);
    let products = roots(&combined(&f, &g, false));
    let pairs: Vec<&Root> = products.iter().filter(|r| !r.is_real()).step_by(2).collect();
    let ties = |i: usize| pairs.iter().filter(|r| r.cmp_modulus(pairs[i]) == Ordering::Equal).count();
    assert_eq!((0..4).map(ties).collect::<Vec<_>>().iter().sum::<usize>(), 6);
}

#[test]
fn roots_far_from_zero_have_short_enclosures() {
    let far = parse_rational("1e100").unwrap();
    let near = p(&[7, -3, 4, 1, 5]);
    let f = near.shifted(&-&far);
    let (all, local) = (roots(&f), roots(&near));
    for (r, s) in all.iter().zip(&local) {
        let ((re, im), (x, y)) = (r.enclosure(200), s.enclosure(200));
        assert!(!im.disjoint(&y) && !(&re - &Interval::point(far.clone())).disjoint(&x));
        assert_eq!(r.is_real(), s.is_real());
    }
    assert_eq!(factor(&f), vec![(f.monic(), 1)]);
    let product = &f * &Poly::linear(&(&far + ratio(1, 1)));
    assert_eq!(factor(&product), vec![(Poly::linear(&(far + ratio(1, 1))), 1), (f.monic(), 1)]);
}
