//! The plane of a curve with two parameters, compared with the verdicts on single members.

use secant::algebraic::Root;
use secant::answer::Verdict;
use secant::arith::{Rational, ratio};
use secant::ask::plane_regions;
use secant::budget::{Budget, Effort};
use secant::case::{PlaneFamilyCase, setting};
use secant::theorem::region::{CurveClaim, Known, PlaneLimits, Subject, member_verdict};
use secant::theorem::{ModelError, certify};
use std::path::PathBuf;
use std::process::Command;

fn family(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "families", name].iter().collect()
}

/// A box for which values of two parameters the curve is G¹: the plane of corner cutting against its members.
#[test]
fn the_plane_of_corner_cutting() {
    let set: Vec<_> = ["a=-1/4..1", "b=-1/4..1"].iter().map(|t| setting(t).unwrap()).collect();
    let limits = PlaneLimits { depth: 5, boxes: 3_000, time: None, lines: None };
    let found = plane_regions(&family("corner-cutting.toml"), &set, &limits, &|_| {}).unwrap().unwrap();
    let names: Vec<String> = found.found.borders.iter().map(|f| f.display(["a", "b"])).collect();
    // 2a + b = 1 and a + 2b = 1 are the borders, up to a factor.
    assert!(names.iter().any(|n| n == "b + 2a - 1") && names.iter().any(|n| n == "2b + a - 1"), "{names:?}");
    let says = |p: &_, q: &_| found.found.at(p, q).expect("boxes cover the plane").clone();
    let mut seen = [0; 3];
    for i in 0..23_i64 {
        for j in 0..23_i64 {
            let (p, q) =
                (ratio(-1, 4) + ratio(5 * (7 * i + 3), 4 * 164), ratio(-1, 4) + ratio(5 * (7 * j + 2), 4 * 163));
            let known = says(&p, &q);
            let c = ratio(1, 1) - &p - &q;
            // The contract: inside the unit square G¹ where c ≥ a and c ≥ b, elsewhere not, but for the lines.
            if let (true, Known::Curve(verdict, _)) = (p > 0 && q > 0, &known) {
                assert_eq!(*verdict, if c > p && c > q { Verdict::Proved } else { Verdict::Refuted }, "{p} {q}");
                seen[usize::from(*verdict == Verdict::Proved)] += 1;
            }
            if (i + j) % 9 != 0 {
                continue;
            }
            match (certify(&found.case.member(&p, &q).unwrap().shape, &[]), known) {
                (Ok(own), Known::Curve(verdict, _)) => {
                    let own = member_verdict(&own, CurveClaim::G1);
                    assert!(own == Verdict::Undetermined || own == verdict, "{p} {q}");
                }
                (Ok(own), Known::Expands(word)) => assert!(!own.contraction.is_proved(), "{p} {q} {word:?}"),
                (Err(ModelError::Expands { .. }), Known::Curve(..)) => panic!("no contraction at {p} {q}"),
                _ => seen[2] += 1,
            }
        }
    }
    assert!(seen[0] > 60 && seen[1] > 20, "{seen:?}");
}

#[test]
fn the_program_answers_about_a_plane() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let out = Command::new(env!("CARGO_BIN_EXE_secant")).args(args).current_dir(dir.path()).output().unwrap();
        (out.status.code(), String::from_utf8(out.stdout).unwrap(), String::from_utf8(out.stderr).unwrap())
    };
    let case = family("corner-cutting.toml").to_string_lossy().into_owned();
    let plane = ["region", &case, "a=0..1", "b=0..1", "--depth", "4"];
    let (code, text, problem) = run(&[&plane[..], &["--report", "a.md", "--svg", "a.svg"]].concat());
    assert_eq!(code, Some(1), "{text}{problem}");
    assert!(text.contains("b + 2a - 1 = 0") && text.contains("the lines of both"), "{text}");
    for file in ["a.md", "a.svg"] {
        assert!(std::fs::metadata(dir.path().join(file)).is_ok_and(|m| m.len() > 1000), "{file}");
    }
    let (_, data, _) = run(&[&plane[..], &["--json"]].concat());
    let data: serde_json::Value = serde_json::from_str(&data).unwrap();
    let boxes = data["boxes"].as_array().unwrap();
    let number = |x: &serde_json::Value| secant::arith::parse_rational(x.as_str().unwrap()).unwrap();
    let side = |b: &serde_json::Value, k: usize| number(&b["box"][k][1]) - number(&b["box"][k][0]);
    assert_eq!(boxes.iter().fold(ratio(0, 1), |s, b| s + side(b, 0) * side(b, 1)), 1);
    assert!(boxes.iter().any(|b| b["verdict"] == "proved" && b["statement"].is_string()), "{data}");
    let (code, text, _) = run(&[&plane[..], &["--time", "0.000001"]].concat());
    assert!(code == Some(3) && text.contains("the time is over"), "{text}");
    let (code, _, problem) = run(&[&plane[..], &["--certificate", "a.json"]].concat());
    assert!(code == Some(2) && problem.contains("no certificate format"), "{problem}");
}

/// The plane of a case with what happens on its straight borders.
fn with_lines(name: &str, depth: usize) -> secant::ask::RegionsInPlane {
    let set: Vec<_> = ["a=0..1", "b=0..1"].iter().map(|t| setting(t).unwrap()).collect();
    let budget = Budget::of(Effort::Quick);
    let lines = Some((budget.regions.clone(), budget));
    let limits = PlaneLimits { depth, boxes: 3_000, time: None, lines };
    plane_regions(&family(name), &set, &limits, &|_| {}).unwrap().unwrap()
}

/// What is said of G¹ on a line, at a value of the parameter that runs there.
fn on_line(found: &secant::ask::RegionsInPlane, name: &str, at: &Rational) -> Option<Verdict> {
    let line = found.found.lines.iter().find(|l| l.line.border.display(["a", "b"]) == name)?;
    let table = line.found.tables.iter().find(|t| t.subject == Subject::Curve(CurveClaim::G1))?;
    let (low, high) = &line.line.range;
    if at < low || high < at { None } else { table.at(&Root::from_rational(at)) }
}

/// The contract: G¹ on the borders 2a + b = 1 and a + 2b = 1 of the region, and on the diagonal a + b = 1.
#[test]
fn the_borders_of_corner_cutting() {
    let found = with_lines("corner-cutting.toml", 4);
    for (line, inside, beyond) in [
        ("b + 2a - 1", ratio(2, 5), ratio(1, 4)),
        ("2b + a - 1", ratio(2, 7), ratio(2, 3)),
        ("b + a - 1", ratio(3, 8), ratio(5, 7)),
    ] {
        assert_eq!(on_line(&found, line, &inside), Some(Verdict::Proved), "{line}");
        let own = found.found.lines.iter().find(|l| l.line.border.display(["a", "b"]) == line).unwrap();
        for p in [&inside, &beyond] {
            let q = own.line.other.eval(p);
            let (a, b) = if own.line.runs == 0 { (p.clone(), q) } else { (q, p.clone()) };
            let single = certify(&found.case.member(&a, &b).unwrap().shape, &[]).unwrap();
            let single = member_verdict(&single, CurveClaim::G1);
            let said = on_line(&found, line, p).unwrap();
            assert!(said == single || said == Verdict::Undetermined || single == Verdict::Undetermined, "{line} {p}");
        }
    }
}

/// Interpolation with the slopes of both sides of the joint equal on a + b = 1/2 and a + b = 1 only.
#[test]
fn a_plane_that_is_refuted_but_on_lines() {
    let found = with_lines("two-scales.toml", 4);
    let decided = found.found.boxes.iter().filter_map(|b| match &b.known {
        Known::Curve(verdict, _) => Some(*verdict),
        _ => None,
    });
    assert!(decided.clone().count() > 20 && decided.clone().all(|v| v == Verdict::Refuted));
    // (2a + 2b - 1)(a + b - 1)
    let names: Vec<String> = found.found.borders.iter().map(|f| f.display(["a", "b"])).collect();
    assert!(names.iter().any(|n| n == "2b^2 + 4a b - 3b + 2a^2 - 3a + 1"), "{names:?}");
}

#[test]
fn what_is_no_plane_is_refused() {
    let parse = |entry: &str| {
        let text = format!(
            "name = \"a\"\n[parameters]\na = \"0..1\"\nb = \"0..1\"\n[[map]]\nlinear = [[\"1/2\", 0], [1, \"{entry}\"]]\n\
             shift = [0, 0]\n[[map]]\nlinear = [[\"1/2\", 0], [-1, \"b/2\"]]\nshift = [\"1/2\", 1]\n"
        );
        PlaneFamilyCase::parse("a.toml", &text, &[]).map(|c| c.map(|c| c.operators[0][(2, 2)].display(["a", "b"])))
    };
    // Divisors that are numbers on the lines on which degrees are found, a degree that is hidden on one of them, and one too high.
    for (entry, problem) in [("1/(3 - a)", "no polynomial"), ("1/(2 + b - a)", "no polynomial"), ("a^7", "degree 7")] {
        let error = parse(entry).unwrap_err();
        assert!(error.to_string().contains(problem), "{entry}: {error}");
    }
    assert_eq!(parse("a*(b - a)/2").unwrap().unwrap(), "1/2a b - 1/2a^2");
}
