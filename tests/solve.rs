//! `secant solve`: every case of `cases/solve` comes out as its file expects, and the solutions are cases again.

use crate::corpus;

use assert_cmd::Command;
use corpus::case_files;
use secant::arith::{Rational, ratio};
use secant::case::{Case, ExpectSolve};
use secant::certificate::solve_certificate;
use secant::shape::{Complex, Family, OpName, Problem, Solution};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn every_case_is_solved_as_its_file_expects() {
    let mut files = Vec::new();
    case_files(&root().join("cases/solve"), &mut files);
    assert!(files.len() >= 9);
    for path in files {
        let case = Case::read_open(&path).unwrap();
        let expect = case.expect.as_ref().and_then(|e| e.solve.as_ref()).unwrap();
        let problem = case.unknowns().unwrap();
        let solution = problem.solve().unwrap();
        certified(&case, &problem, &solution);
        match solution {
            Solution::None(conflict) => {
                let found: Vec<String> = conflict.iter().map(|s| case.complex().source_text(s)).collect();
                assert_eq!((expect.solutions.as_str(), expect.conflict.as_ref()), ("none", Some(&found)), "{path:?}");
            }
            Solution::One(solved) => {
                assert_eq!(expect.solutions, "one", "{path:?}");
                solved.check().unwrap();
                let again = Case::parse("solved", &case.written_with(&solved)).unwrap();
                assert_eq!(again.complex().check().unwrap(), solved.check().unwrap());
            }
            Solution::Family(family) => {
                assert_eq!(expect.solutions, "family", "{path:?}");
                assert_eq!(Some(family.parameters.len()), expect.parameters, "{path:?}");
                forced(&family, expect, &problem.operators());
            }
        }
    }
}

/// The checker comes to the same solutions; of faces there is no certificate.
fn certified(case: &Case, problem: &Problem, solution: &Solution) {
    let certificate = match solve_certificate(case, problem, solution) {
        Ok(certificate) => certificate.text(),
        Err(error) => return assert!(!case.complex().faces.is_empty(), "{}: {error}", case.name),
    };
    let accepted = secant_check::check(&case.text.text, &certificate).unwrap_or_else(|r| panic!("{}: {r}", case.name));
    let free = match solution {
        Solution::None(_) => None,
        Solution::One(_) => Some(0),
        Solution::Family(f) => Some(f.parameters.len()),
    };
    let verdict = if free.is_some() { secant_check::Verdict::Proved } else { secant_check::Verdict::Refuted };
    let same = |d: &secant_check::Decided| matches!(&d.claim, secant_check::Claim::Solvable { free: found, .. } if *found == free);
    let one = matches!(accepted.claims.as_slice(), [d] if d.verdict == verdict && same(d));
    assert!(accepted.verdict == verdict && one, "{:?}", accepted.claims);
    let other = certificate.replacen("\"one\"", "\"family\"", 1).replacen("\"none\"", "\"one\"", 1);
    assert!(other == certificate || secant_check::check(&case.text.text, &other).is_err(), "{}", case.name);
}

fn forced(family: &Family, expect: &ExpectSolve, operators: &[OpName]) {
    for forced in &expect.forced {
        let op = operators.iter().find(|op| family.origin.operator_text(**op) == forced.operator).unwrap();
        let found = family.forced(*op).unwrap().polynomial();
        let wanted = forced
            .eigenvalues
            .iter()
            .fold(secant::poly::Poly::constant(ratio(1, 1)), |p, root| &p * &secant::poly::Poly::linear(root));
        assert_eq!(found.coeffs(), wanted.coeffs());
    }
    for k in 1..4 {
        let values: Vec<Rational> = (0..family.parameters.len() as i64).map(|i| ratio(k * i + 1, 7 + k)).collect();
        let member: Complex = family.at(&values);
        member.check().unwrap();
        member.shape.check().unwrap();
    }
}

#[test]
fn the_bicubic_face_follows_from_its_edges() {
    let open = Case::read_open(&root().join("cases/solve/bicubic-face.toml")).unwrap();
    let Solution::One(solved) = open.unknowns().unwrap().solve().unwrap() else { panic!("one solution") };
    let known = Case::read(&root().join("cases/faces/bicubic.toml")).unwrap();
    assert_eq!(open.unknown.len(), 4 * 256);
    for (p, q) in solved.shape.states[0].pieces.iter().zip(&known.shape.states[0].pieces) {
        assert_eq!(p.op, q.op);
    }
}

fn secant(args: &[&str], code: i32) -> (String, String) {
    let out = Command::cargo_bin("secant").unwrap().current_dir(root()).args(args).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

#[test]
fn a_solution_is_written_and_can_be_certified() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("curve.toml");
    let file = path.to_str().unwrap();
    // p = 5/4 and 1/2: the half-tangent of the thesis is a member of the curves on three points with two at each vertex.
    let settings = ["--set", "p1=-1/4", "--set", "p2=1/2", "--output", file];
    let (out, _) = secant(&[&["solve", "cases/solve/curve-3-2.toml"][..], &settings[..]].concat(), 0);
    assert!(out.contains("2 free parameters") && out.contains("p1 = T_0[v](1,0)") && out.contains("1-p1"), "{out}");
    // The certificate is about all members, whichever is written.
    let certificate = dir.path().join("curve.json");
    secant(&["solve", "cases/solve/curve-3-2.toml", "--quiet", "--certificate", certificate.to_str().unwrap()], 0);
    assert!(std::fs::read_to_string(certificate).unwrap().contains("\"solutions\": \"family\""));
    let (_, error) = secant(&["solve", "cases/solve/bicubic-face.toml", "--certificate", file], 2);
    assert!(error.contains("faces"), "{error}");
    let (out, _) = secant(&["certify", file], 0);
    assert!(out.contains("cusp"), "{out}");
    let case = Case::read(&path).unwrap();
    let half = Case::read(&root().join("cases/thesis/half-tangent.toml")).unwrap();
    assert_eq!(case.shape.states[0].pieces[0].op, half.shape.states[0].pieces[0].op);
}

#[test]
fn what_cannot_be_solved_is_told() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("none.toml");
    let contradiction = "cases/solve/junction-contradiction.toml";
    let (out, _) = secant(&["solve", contradiction, "--output", file.to_str().unwrap()], 1);
    assert!(out.contains("no solution") && out.contains("∂_0[I] T_0[q] = T_0[I] ∂_0[I]"), "{out}");
    assert!(!file.exists());
    let (out, _) = secant(&["solve", contradiction, "--json"], 1);
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((json["solutions"].as_str(), json["unknowns"].as_u64()), (Some("none"), Some(16)));
    let (_, err) = secant(&["solve", "cases/solve/curve-3-2.toml", "--set", "q=1"], 2);
    assert!(err.contains("p1, p2"), "{err}");
    let (_, err) = secant(&["solve", "cases/solve/chaikin.toml", "--set", "t00=1"], 2);
    assert!(err.contains("no free parameter"), "{err}");
    let (_, err) = secant(&["certify", "cases/solve/chaikin.toml"], 2);
    assert!(err.contains("secant solve"), "{err}");
    // Two unknown factors in one product.
    let text = std::fs::read_to_string(root().join("cases/solve/chaikin.toml")).unwrap();
    let text = text.replace("points = [0, 1]", "matrix = \"?\"");
    let path = dir.path().join("nonlinear.toml");
    std::fs::write(&path, text).unwrap();
    let (_, err) = secant(&["solve", path.to_str().unwrap()], 2);
    assert!(err.contains("secant::solve::nonlinear") && err.contains("not linear"), "{err}");
    // Nothing unknown: the identities are checked.
    let (out, _) = secant(&["solve", "cases/faces/bicubic.toml"], 0);
    assert!(out.contains("0 unknowns and 22 identities"), "{out}");
}
