//! Exponents of interpolatory masks and of Daubechies' scaling functions.

use criterion::{Criterion, criterion_group, criterion_main};
use secant::radius::Options;
use secant::scheme::{Family, dubuc_deslauriers};
use secant::theorem::regularity::regularity;
use secant::theorem::wavelet::wavelet;
use std::hint::black_box;
use std::time::Duration;

fn benches(c: &mut Criterion) {
    let mut group = c.benchmark_group("Dubuc–Deslauriers");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for points in [8, 14, 16, 20] {
        let mask = dubuc_deslauriers(points).expect("a mask");
        group.bench_function(points.to_string(), |b| {
            b.iter(|| black_box(regularity(mask.coefficients(), 2, &Options::default())))
        });
    }
    group.finish();
    let mut group = c.benchmark_group("Daubechies");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for moments in [4, 8, 9, 12] {
        group.bench_function(moments.to_string(), |b| {
            b.iter(|| black_box(wavelet(Family::Daubechies, moments, &Options::default())))
        });
    }
    group.finish();
}

criterion_group!(exponents, benches);
criterion_main!(exponents);
