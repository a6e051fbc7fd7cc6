//! Spectra of the matrices of the benches against FLINT, with and without the use of symmetry.

use crate::chains;

use secant::approx::approximate_spectrum;
use secant::arith::to_f64;
use secant::case::matrix_file;
use secant::jordan::{BUDGET, Spectrum, estimated_work, modulus_classes};
use secant::linalg::Matrix;
use std::collections::BTreeSet;
use std::path::Path;

fn matrix(name: &str) -> Matrix {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("benches/matrices/{name}.txt"));
    matrix_file::parse(&std::fs::read_to_string(path).unwrap()).unwrap().matrix
}

/// The factors of a spectrum in the notation of `tests/oracle/spectrum.txt`.
fn factors(s: &Spectrum) -> BTreeSet<String> {
    let list = |values: Vec<String>| values.join(",");
    s.factors
        .iter()
        .map(|f| {
            let blocks = list(f.blocks.iter().map(ToString::to_string).collect());
            let coefficients = list(f.poly.primitive().iter().map(ToString::to_string).collect());
            format!("{}:{}:{blocks}:{coefficients}", f.degree(), f.multiplicity)
        })
        .collect()
}

fn class_sizes(s: &Spectrum) -> Vec<usize> {
    s.classes.iter().map(|c| c.members.len()).collect()
}

#[test]
fn spectra_agree_with_flint() {
    let oracle = include_str!("oracle/spectrum.txt");
    assert!(oracle.lines().count() > 40);
    for line in oracle.lines() {
        let (left, classes) = line.split_once(" classes ").unwrap();
        let mut words = left.split(' ');
        let name = words.next().unwrap();
        let s = Spectrum::of(&matrix(name));
        assert_eq!(factors(&s), words.map(str::to_owned).collect(), "{name}");
        let sizes: Vec<usize> = classes.split(',').map(|c| c.parse().unwrap()).collect();
        assert_eq!(class_sizes(&s), sizes, "{name}");
    }
}

#[test]
fn symmetry_does_not_change_the_result() {
    for name in ["cc1_08", "cc1_12", "cc2_04", "cc2_05", "loop1_16", "loop2_06", "loop2_08", "ds_16"] {
        let a = matrix(name);
        let (with, without) = (Spectrum::of(&a), Spectrum::without_symmetry(&a));
        assert_eq!(factors(&with), factors(&without), "{name}");
        assert_eq!(with.classes, without.classes, "{name}");
        assert_eq!(with.char_poly, without.char_poly, "{name}");
        chains::check(&a, with);
        chains::check(&a, without);
    }
}

#[test]
fn a_declared_symmetry_must_hold() {
    let a = matrix("cc1_05");
    let rotation: Vec<usize> = (0..11).map(|i| if i == 0 { 0 } else { 1 + (i + 1) % 10 }).collect();
    let s = Spectrum::with_symmetry(&a, &rotation).expect("the rotation by one sector");
    assert_eq!(factors(&s), factors(&Spectrum::of(&a)));
    chains::check(&a, s);
    let wrong: Vec<usize> = (0..11).map(|i| (i + 1) % 11).collect();
    assert!(Spectrum::with_symmetry(&a, &wrong).is_none());
}

#[test]
fn larger_matrices_keep_every_law() {
    for name in ["jordan_16", "stoch_020", "stochmix_020", "cyc3_18", "dd4_7", "bspl_12"] {
        let a = matrix(name);
        chains::check(&a, Spectrum::of(&a));
    }
}

#[test]
fn classes_without_chains_are_the_same() {
    for name in ["cyc3_12", "cc1_06", "stoch_010", "jordan_08"] {
        let a = matrix(name);
        let sizes: Vec<usize> = modulus_classes(&a).iter().map(Vec::len).collect();
        assert_eq!(sizes, class_sizes(&Spectrum::of(&a)), "{name}");
    }
}

#[test]
fn the_float_fallback_ends_and_is_near() {
    for name in ["cc2_03", "cc2_32", "loop2_06", "stoch_020", "jordan_32"] {
        let a = matrix(name);
        let Ok(approximate) = approximate_spectrum(&a) else { continue };
        assert_eq!(approximate.eigenvalues.len(), a.rows());
        let top = to_f64(&modulus_classes(&a)[0][0].modulus(50).mid());
        let found = &approximate.eigenvalues[0];
        let tolerance = if approximate.ill_conditioned { 1e-2 } else { 1e-8 };
        assert!((found.re.hypot(found.im) - top).abs() < tolerance, "{name}");
    }
}

#[test]
fn the_budget_admits_the_benches_and_refuses_what_is_hopeless() {
    for name in ["stochmix_160", "stoch_160", "cc2_32", "jordan_64"] {
        assert!(estimated_work(&matrix(name)) < BUDGET, "{name}");
    }
    let long = secant::arith::parse_rational(&"7".repeat(9_000)).unwrap();
    assert!(estimated_work(&Matrix::from_fn(100, 100, |_, _| long.clone())) > BUDGET);
    assert!(estimated_work(&Matrix::identity(1_000)) > BUDGET);
}
