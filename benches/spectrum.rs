//! Characteristic polynomials, spectra with chains, and modulus classes of the matrices in `benches/matrices`.

use criterion::{Criterion, criterion_group, criterion_main};
use secant::case::matrix_file;
use secant::jordan::{Spectrum, char_poly, modulus_classes};
use secant::linalg::Matrix;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

fn matrix(name: &str) -> Matrix {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("benches/matrices/{name}.txt"));
    matrix_file::parse(&std::fs::read_to_string(path).expect("a file")).expect("a matrix").matrix
}

fn group<T>(c: &mut Criterion, title: &str, names: &[&str], work: impl Fn(&Matrix) -> T) {
    let mut group = c.benchmark_group(title);
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for name in names {
        let a = matrix(name);
        group.bench_function(*name, |b| b.iter(|| black_box(work(&a))));
    }
    group.finish();
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
        "stoch_160",
        "cc1_32",
        "cc2_16",
        "cc2_32",
        "loop2_32",
    ];
    group(c, "spectrum", &spectra, Spectrum::of);
    group(c, "without_symmetry", &["cc1_32", "cc2_16"], Spectrum::without_symmetry);
    group(c, "modulus_classes", &["stoch_040", "stoch_160", "cyc3_24", "cyc3_48"], modulus_classes);
}

criterion_group!(spectrum, benches);
criterion_main!(spectrum);
