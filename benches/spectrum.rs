//! Characteristic polynomials, spectra with chains, and modulus classes of the matrices in `benches/matrices`; spectra of
//! matrices with many exact ties, of clusters, and over a number field.

use criterion::{Criterion, criterion_group, criterion_main};
use malachite_base::num::arithmetic::traits::Pow;
use secant::algebraic::Elem;
use secant::algebraic::field::{FieldMatrix, NumberField};
use secant::arith::{Integer, Rational};
use secant::case::matrix_file;
use secant::jordan::{FieldSpectrum, Spectrum, char_poly, modulus_classes};
use secant::linalg::Matrix;
use secant::poly::Poly;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

fn matrix(name: &str) -> Matrix {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("benches/matrices/{name}.txt"));
    matrix_file::parse(&std::fs::read_to_string(path).expect("a file")).expect("a matrix").matrix
}

fn group<T>(c: &mut Criterion, title: &str, names: &[&str], work: impl Fn(&Matrix) -> T) {
    timed(c, title, names.iter().map(|name| ((*name).to_owned(), matrix(name))), work);
}

fn timed<A, T>(c: &mut Criterion, title: &str, list: impl IntoIterator<Item = (String, A)>, work: impl Fn(&A) -> T) {
    let mut group = c.benchmark_group(title);
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, a) in list {
        group.bench_function(name, |b| b.iter(|| black_box(work(&a))));
    }
    group.finish();
}

/// The integers of a linear congruential generator, from `-size` to `size`.
fn random(seed: &mut u64, size: i64) -> i64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as i64 % (2 * size + 1) - size
}

/// Skew-symmetric with entries up to 9: eigenvalues on the imaginary axis, whose real parts are exact ties.
fn skew(n: usize) -> Matrix {
    let mut seed = n as u64;
    let a: Vec<Vec<i64>> = (0..n).map(|_| (0..n).map(|_| random(&mut seed, 9)).collect()).collect();
    Matrix::from_fn(n, n, |i, j| Rational::from(if i > j { a[i][j] } else { -a[j][i] } * i64::from(i != j)))
}

/// Nonnegative, and zero but in the blocks of a cycle of four classes.
fn cyclic(n: usize) -> Matrix {
    let mut seed = n as u64;
    let next = |i: usize, j: usize| (i * 4 / n + 1) % 4 == j * 4 / n;
    Matrix::from_fn(n, n, |i, j| Rational::from(if next(i, j) { random(&mut seed, 9).abs() } else { 0 }))
}

/// The companion matrix of `x^n - 5 x^(n/2) + 3`.
fn companion(n: usize) -> Matrix {
    let last = |i: usize| if i == 0 { -3 } else { 5 * i64::from(2 * i == n) };
    Matrix::from_fn(n, n, |i, j| Rational::from(if j + 1 == n { last(i) } else { i64::from(i == j + 1) }))
}

/// The circulant matrix of `1, …, n`.
fn circulant(n: usize) -> Matrix {
    Matrix::from_fn(n, n, |i, j| Rational::from((j + n - i) % n + 1))
}

/// A cluster far from 0: `10^100` on the diagonal, and small integers.
fn far(n: usize) -> Matrix {
    let mut seed = n as u64;
    let centre = Rational::from(Integer::from(10).pow(100));
    Matrix::from_fn(n, n, |i, j| {
        let small = Rational::from(random(&mut seed, 9));
        if i == j { &centre + small } else { small }
    })
}

/// Circulant in blocks of 7.
fn block_circulant(n: usize) -> Matrix {
    let mut seed = n as u64;
    let blocks = n / 7;
    let first: Vec<Vec<i64>> = (0..blocks).map(|_| (0..49).map(|_| random(&mut seed, 4)).collect()).collect();
    Matrix::from_fn(7 * blocks, 7 * blocks, |i, j| {
        Rational::from(first[(j / 7 + blocks - i / 7) % blocks][i % 7 * 7 + j % 7])
    })
}

/// Random numbers `a + b sqrt(5)`.
fn golden(n: usize) -> FieldMatrix {
    let (field, _) = NumberField::read(&["sqrt(5)"]).expect("a field");
    let mut seed = n as u64;
    let entry = |_, _| {
        let mut number = || Rational::from(random(&mut seed, 9));
        Elem(Poly::new(vec![number(), number()]))
    };
    FieldMatrix::from_fn(&field, n, n, entry)
}

fn named(name: &str, sizes: &[usize], make: fn(usize) -> Matrix) -> Vec<(String, Matrix)> {
    sizes.iter().map(|n| (format!("{name} {n}"), make(*n))).collect()
}

fn benches(c: &mut Criterion) {
    let polynomials = ["stoch_040", "stoch_080", "stoch_160", "stochmix_040", "stochmix_080", "stochmix_160", "cc2_32"];
    group(c, "char_poly", &polynomials, char_poly);
    let spectra = [
        "dd4_5",
        "loop2_03",
        "cc1_04",
        "jordan_32",
        "jordan_64",
        "stoch_020",
        "stoch_040",
        "stoch_080",
        "stoch_160",
        "cyc3_48",
        "cc1_32",
        "cc2_16",
        "cc2_32",
        "loop2_32",
    ];
    group(c, "spectrum", &spectra, Spectrum::of);
    let ties = [
        named("skew", &[6, 8, 10, 30], skew),
        named("4-cyclic", &[12], cyclic),
        named("companion", &[8, 16, 24, 60], companion),
        named("circulant", &[16, 17, 25], circulant),
        named("far", &[4, 11], far),
        named("block-circulant", &[385], block_circulant),
    ];
    timed(c, "ties", ties.into_iter().flatten(), Spectrum::of);
    timed(c, "Q(sqrt 5)", [10, 20].map(|n| (n.to_string(), golden(n))), FieldSpectrum::of);
    group(c, "without_symmetry", &["cc1_32", "cc2_16"], Spectrum::without_symmetry);
    group(c, "modulus_classes", &["stoch_040", "stoch_160", "cyc3_24", "cyc3_48"], modulus_classes);
}

criterion_group!(spectrum, benches);
criterion_main!(spectrum);
