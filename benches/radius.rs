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

/// Sets without a comparison: exact ties, binary partitions, signs, nonnegative sets of large dimension.
fn rows() -> Vec<(String, String)> {
    let mut list = vec![
        ("complex pair".to_owned(), "[[[6,-4],[1,3]],[[-3,1],[-2,-6]]]".to_owned()),
        ("A, B/5".to_owned(), "[[[1,1],[0,1]],[[\"1/5\",0],[\"1/5\",\"1/5\"]]]".to_owned()),
    ];
    for digits in [9, 15, 17] {
        list.push((format!("Euler {digits}"), euler(digits)));
    }
    let mut seed = 1u64;
    let mut random = |below: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) % below) as i64
    };
    for (name, count, dim, low, below, step) in
        [("signs", 3, 6, -1, 2, 2), ("integers", 3, 8, -3, 7, 1), ("nonnegative", 2, 50, 0, 4, 1)]
    {
        let mut row = || (0..dim).map(|_| (low + step * random(below)).to_string()).collect::<Vec<_>>().join(",");
        let mut matrix = || (0..dim).map(|_| format!("[{}]", row())).collect::<Vec<_>>().join(",");
        let set = (0..count).map(|_| format!("[{}]", matrix())).collect::<Vec<_>>().join(",");
        list.push((format!("{name} {dim}"), format!("[{set}]")));
    }
    list
}

/// Binary partitions with the digits `0 … r − 1`, `r` odd: the matrices of Protasov.
fn euler(r: i64) -> String {
    let n = r - 1;
    let matrix = |e: i64| {
        let entry = |i: i64, j: i64| i64::from((0..r).contains(&(2 * i + e - j)));
        let row = |i: i64| format!("[{}]", (0..n).map(|j| entry(i, j).to_string()).collect::<Vec<_>>().join(","));
        format!("[{}]", (0..n).map(row).collect::<Vec<_>>().join(","))
    };
    format!("[{},{}]", matrix(0), matrix(1))
}

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

fn alone(c: &mut Criterion) {
    let mut group = c.benchmark_group("alone");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, text) in rows() {
        let system = file::parse(&format!("matrices = {text}")).expect("a set").system;
        group.bench_function(name, |b| b.iter(|| black_box(joint_radius(&system, &Options::default()))));
    }
    group.finish();
}

criterion_group!(group_of_benches, benches, alone);
criterion_main!(group_of_benches);
