//! Joint spectral radii against Gripenberg's algorithm in floating point, to the same width.
//!
//! Gripenberg's branch and bound gives an interval of width `DELTA`, without a proof; the polytopes give the exact value.
#![allow(clippy::float_arithmetic, reason = "the float method is what is compared with")]

use criterion::{Criterion, criterion_group, criterion_main};
use secant::radius::{Options, file, joint_radius};
use std::hint::black_box;
use std::time::Duration;

/// Width of the interval, relative to the radius: what Gripenberg's algorithm reaches on all sets in reasonable time.
const DELTA: f64 = 0.02;
/// Most products of one length.
const MAX_PRODUCTS: usize = 200_000;

const SETS: &[(&str, &str)] = &[
    ("golden pair", "[[[1,1],[0,1]],[[1,0],[1,1]]]"),
    ("HMST 3/5", "[[[1,1],[0,1]],[[\"3/5\",0],[\"3/5\",\"3/5\"]]]"),
    ("capacity ++", "[[[0,1],[1,1]],[[1,1],[1,0]]]"),
    (
        "pascal",
        "[[[0,1,0,0,0],[1,0,2,0,0],[0,0,0,0,0],[0,1,0,0,1],[0,0,0,2,1]],[[1,0,2,0,0],[0,0,0,2,1],[1,1,0,0,0],[0,0,0,0,0],[0,1,0,0,0]]]",
    ),
    (
        "Euler 7",
        "[[[1,0,0,0,0,0],[1,1,1,0,0,0],[1,1,1,1,1,0],[1,1,1,1,1,1],[0,0,1,1,1,1],[0,0,0,0,1,1]],[[1,1,0,0,0,0],[1,1,1,1,0,0],[1,1,1,1,1,1],[0,1,1,1,1,1],[0,0,0,1,1,1],[0,0,0,0,0,1]]]",
    ),
];

type Dense = nalgebra::DMatrix<f64>;

fn radius(m: &Dense) -> f64 {
    m.complex_eigenvalues().iter().map(|z| z.re.hypot(z.im)).fold(0.0, f64::max)
}

/// Gripenberg's algorithm (Linear Algebra Appl. 234, 1996): bounds that differ by at most `delta`, or what was reached.
fn gripenberg(matrices: &[Dense], delta: f64) -> (f64, f64) {
    let mut lower = matrices.iter().map(radius).fold(0.0, f64::max);
    let mut open: Vec<(Dense, f64)> = matrices.iter().map(|m| (m.clone(), m.norm())).collect();
    let mut upper = open.iter().map(|x| x.1).fold(0.0, f64::max);
    for length in 2..200 {
        let mut next = Vec::new();
        for (product, worst) in &open {
            for m in matrices {
                let longer = product * m;
                let value = worst.min(longer.norm().powf(1.0 / f64::from(length)));
                lower = lower.max(radius(&longer).powf(1.0 / f64::from(length)));
                next.push((longer, value));
            }
        }
        next.retain(|x| x.1 > lower + delta);
        let largest = next.iter().map(|x| x.1).fold(0.0, f64::max);
        upper = upper.min(largest.max(lower + delta));
        if next.is_empty() || next.len() > MAX_PRODUCTS {
            break;
        }
        open = next;
    }
    (lower, upper)
}

fn benches(c: &mut Criterion) {
    for (name, text) in SETS {
        let system = file::parse(&format!("matrices = {text}")).expect("a set").system;
        let dense: Vec<Dense> = system
            .arrows
            .iter()
            .map(|a| Dense::from_fn(a.matrix.rows(), a.matrix.cols(), |i, j| secant::arith::to_f64(&a.matrix[(i, j)])))
            .collect();
        let exact = joint_radius(&system, &Options::default()).expect("a system");
        let value = exact.lower.as_ref().map_or(0.0, |l| secant::arith::to_f64(&l.enclosure(64).lo));
        let bounds = gripenberg(&dense, DELTA * value);
        println!("{name}: exact {value}, Gripenberg [{}, {}]", bounds.0, bounds.1);
        assert!(bounds.0 <= value * (1.0 + 1e-9) && value <= bounds.1 * (1.0 + 1e-9), "{name}");
        let mut group = c.benchmark_group(*name);
        group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
        group.bench_function("exact polytope", |b| b.iter(|| black_box(joint_radius(&system, &Options::default()))));
        group.bench_function("float Gripenberg", |b| b.iter(|| black_box(gripenberg(&dense, DELTA * value))));
        group.finish();
    }
}

criterion_group!(group_of_benches, benches);
criterion_main!(group_of_benches);
