//! Times secant and FLINT on the same matrices, in one run: characteristic polynomial, Jordan form, modulus classes.
//!
//! Every measurement of FLINT runs in a child process with a time limit, because some do not end.

mod flint;

use secant::case::matrix_file;
use secant::jordan::{Spectrum, char_poly};
use secant::linalg::Matrix;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What is measured on which matrices: the rows of the table.
const TABLE: [(&str, &[&str]); 3] = [
    ("charpoly", &["stoch_040", "stoch_080", "stoch_160", "stochmix_040", "stochmix_080", "stochmix_160", "cc2_32"]),
    (
        "jordan",
        &[
            "dd4_5", "loop2_03", "cc1_04", "jordan_32", "jordan_64", "stoch_020", "stoch_040", "stoch_160", "cc1_32",
            "cc2_16", "cc2_32", "loop2_32",
        ],
    ),
    ("modulus", &["stoch_040", "stoch_160", "cyc3_24", "cyc3_48"]),
];

fn matrix(name: &str) -> Matrix {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../matrices", &format!("{name}.txt")].iter().collect();
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    matrix_file::parse(&text).expect("a matrix").matrix
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, kind, name] = &args[..]
        && flag == "--flint"
    {
        println!("{}", flint_seconds(kind, name));
        return;
    }
    let limit = Duration::from_secs(args.first().and_then(|a| a.parse().ok()).unwrap_or(120));
    println!("| work | matrix | FLINT | secant | FLINT / secant |\n|---|---|---|---|---|");
    for (kind, names) in TABLE {
        for name in names {
            let ours = best_of(|| secant_seconds(kind, &matrix(name)));
            let theirs = in_child(kind, name, limit);
            let shown = theirs.map_or(format!("over {} s", limit.as_secs()), seconds);
            let ratio = theirs.map_or(format!("over {:.0}", limit.as_secs_f64() / ours), |t| format!("{:.1}", t / ours));
            println!("| {kind} | {name} | {shown} | {} | {ratio} |", seconds(ours));
        }
    }
}

fn seconds(t: f64) -> String {
    match t {
        t if t >= 1.0 => format!("{t:.1} s"),
        t if t >= 1e-3 => format!("{:.2} ms", t * 1e3),
        t => format!("{:.0} µs", t * 1e6),
    }
}

/// The shortest of several runs, within about two seconds.
fn best_of(mut run: impl FnMut() -> f64) -> f64 {
    let start = Instant::now();
    let mut best = run();
    while start.elapsed() < Duration::from_secs(2) {
        best = best.min(run());
    }
    best
}

fn timed<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    std::hint::black_box(work());
    start.elapsed().as_secs_f64()
}

fn secant_seconds(kind: &str, a: &Matrix) -> f64 {
    match kind {
        "charpoly" => timed(|| char_poly(a)),
        "jordan" => timed(|| Spectrum::of(a)),
        _ => timed(|| secant::jordan::modulus_classes(a)),
    }
}

fn flint_seconds(kind: &str, name: &str) -> f64 {
    let rational = flint::RationalMatrix::new(&matrix(name));
    match kind {
        "charpoly" => best_of(|| timed(|| rational.char_poly())),
        "jordan" => best_of(|| timed(|| rational.jordan_form())),
        _ => best_of(|| timed(|| rational.modulus_classes())),
    }
}

/// The measurement in a child process, or `None` when it does not end within the limit.
fn in_child(kind: &str, name: &str, limit: Duration) -> Option<f64> {
    let program = std::env::current_exe().expect("this program");
    let mut child = Command::new(program)
        .args(["--flint", kind, name])
        .stdout(Stdio::piped())
        .spawn()
        .expect("a child process");
    let start = Instant::now();
    while start.elapsed() < limit + Duration::from_secs(3) {
        if child.try_wait().expect("the state of the child").is_some() {
            let output = child.wait_with_output().expect("its output");
            return String::from_utf8_lossy(&output.stdout).trim().parse().ok();
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let _ = child.kill();
    let _ = child.wait();
    None
}
