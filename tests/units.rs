//! Verdicts do not depend on units: the same system under invertible affine changes has the same verdicts, kinds and dimensions.

use crate::corpus;

use corpus::case_files;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use secant::arith::{Rational, ratio};
use secant::case::Case;
use secant::linalg::Matrix;
use secant::shape::{CellKind, Frame, Shape};
use secant::theorem::{Verdict, certify};
use std::cell::{Cell, RefCell};
use std::path::Path;

/// `x ↦ L x + s`.
type Map = (Matrix, Vec<Rational>, bool);

fn maps(shape: &Shape) -> Vec<Map> {
    let d = shape.states[0].dim - 1;
    let pieces = shape.states[0].pieces.iter();
    pieces
        .map(|p| {
            let shift: Vec<Rational> = (1..=d).map(|i| p.op[(i, 0)].clone()).collect();
            let linear = Matrix::from_fn(d, d, |i, j| &p.op[(i + 1, j + 1)] - &p.op[(i + 1, 0)]);
            (linear, shift, p.reversed)
        })
        .collect()
}

fn shape(kind: CellKind, maps: &[Map]) -> Shape {
    let mut shape = Shape::single(kind, maps.iter().map(|(l, s, _)| Shape::affine_operator(l, s)).collect());
    for (piece, (.., reversed)) in shape.states[0].pieces.iter_mut().zip(maps) {
        piece.reversed = *reversed;
    }
    shape.control = Some(Shape::affine_control(maps[0].1.len()));
    shape.frame = Frame::Affine;
    shape
}

/// The maps in the coordinates `y = A x`.
fn changed(maps: &[Map], a: &Matrix) -> Vec<Map> {
    let inverse = a.solve(&Matrix::identity(a.rows())).unwrap();
    maps.iter().map(|(l, s, r)| (&(a * l) * &inverse, a.apply(s), *r)).collect()
}

/// What is said of the points, or why nothing is.
fn said(shape: &Shape) -> Result<Vec<String>, String> {
    let found = certify(shape, &[]).map_err(|e| e.code().to_owned())?;
    let point = |p: &secant::theorem::PointReport| {
        let addresses: Vec<String> = p.branches.iter().map(|b| b.address.to_string()).collect();
        format!("{}: {} {} {:?}", addresses.join(" = "), p.verdict.word(), p.kind.word(), p.dimension)
    };
    Ok(found.points.iter().map(point).collect())
}

/// Units between 10^-9 and 10^9, and a change of determinant 1.
fn change(d: usize) -> impl Strategy<Value = Matrix> {
    let moves = prop::collection::vec((0..d, 0..d, -2_i64..=2), 0..3);
    (prop::collection::vec(-9_i32..=9, d), moves).prop_map(move |(units, moves)| {
        let unit = |e: i32| {
            let power = 10_i64.pow(e.unsigned_abs());
            if e < 0 { ratio(1, power) } else { ratio(power, 1) }
        };
        let mut a = Matrix::from_fn(d, d, |i, j| if i == j { unit(units[i]) } else { ratio(0, 1) });
        for (i, j, c) in moves {
            if i != j {
                for k in 0..d {
                    let more = &a[(j, k)] * ratio(c, 1);
                    a[(i, k)] += more;
                }
            }
        }
        a
    })
}

fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]))
}

#[test]
fn some_shipped_systems_of_affine_maps() {
    shipped(4, 1);
}

#[test]
#[ignore = "all of them, several times: minutes"]
fn all_shipped_systems_of_affine_maps() {
    shipped(1, 4);
}

/// Every so many files, each under so many changes of coordinates.
fn shipped(every: usize, changes: u32) {
    let mut files = Vec::new();
    case_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases"), &mut files);
    let mut count = 0;
    let wrong = RefCell::new(Vec::new());
    for path in files {
        let Ok(case) = Case::read(&path) else { continue };
        let dim = case.shape.states[0].dim;
        let face = case.shape.states.iter().any(|s| s.kind == CellKind::Face);
        if case.shape.frame != Frame::Affine || case.shape.states.len() != 1 || dim > 4 || face {
            continue;
        }
        let (kind, own) = (case.shape.states[0].kind, maps(&case.shape));
        count += 1;
        if count % every != 0 {
            continue;
        }
        let here = said(&case.shape);
        runner(changes)
            .run(&change(dim - 1), |a| {
                let there = said(&shape(kind, &changed(&own, &a)));
                if here != there {
                    wrong.borrow_mut().push(format!("{} under {a:?}:\n  {here:?}\n  {there:?}", case.name));
                }
                Ok(())
            })
            .unwrap_or(());
    }
    let wrong = wrong.into_inner();
    assert!(count >= 40, "only {count} cases of affine maps");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A curve from (0, 0) to (1, 1): two diagonal or sheared maps that meet.
fn curve() -> impl Strategy<Value = Vec<Map>> {
    let part = (1_i64..=4, 5_i64..=6).prop_map(|(p, q)| ratio(p, q));
    (part.clone(), part, -2_i64..=2, -2_i64..=2).prop_map(|(a, b, s, t)| {
        let one = ratio(1, 1);
        let shear = |c: i64| ratio(c, 8);
        let first = Matrix::from_rows(2, vec![vec![a.clone(), ratio(0, 1)], vec![shear(s), b.clone()]]);
        let middle = first.apply(&[one.clone(), one.clone()]);
        let second =
            Matrix::from_rows(2, vec![vec![&one - &a, ratio(0, 1)], vec![shear(t), &one - &middle[1] - shear(t)]]);
        vec![(first, vec![ratio(0, 1); 2], false), (second, middle, false)]
    })
}

#[test]
fn random_curves() {
    let strategy = (curve(), change(2));
    let (decided, all) = (Cell::new(0), Cell::new(0));
    runner(8)
        .run(&strategy, |(own, a)| {
            let (here, there) = (said(&shape(CellKind::Edge, &own)), said(&shape(CellKind::Edge, &changed(&own, &a))));
            prop_assert_eq!(&here, &there);
            all.set(all.get() + 1);
            let open = here.is_ok_and(|p| p.iter().any(|s| s.contains(Verdict::Undetermined.word())));
            decided.set(decided.get() + usize::from(!open));
            Ok(())
        })
        .unwrap();
    let (decided, all) = (decided.get(), all.get());
    assert!(2 * decided > all, "only {decided} of {all} decided");
}
