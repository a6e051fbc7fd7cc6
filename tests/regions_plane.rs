//! The plane of a curve with two parameters, compared with the verdicts on single members.

use secant::answer::Verdict;
use secant::arith::ratio;
use secant::ask::plane_regions;
use secant::case::setting;
use secant::theorem::region::{CurveClaim, Known, PlaneLimits, member_verdict};
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
    let limits = PlaneLimits { depth: 5, boxes: 3_000, time: None };
    let found = plane_regions(&family("corner-cutting.toml"), &set, &limits, &|_| {}).unwrap().unwrap();
    let names: Vec<String> = found.found.borders.iter().map(|f| f.display(["a", "b"])).collect();
    // 2a + b = 1 and a + 2b = 1 are the borders, up to a factor.
    assert!(names.iter().any(|n| n == "b + 2 a - 1") && names.iter().any(|n| n == "b + 1/2 a - 1/2"), "{names:?}");
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
    assert!(text.contains("b + 2 a - 1 = 0") && text.contains("lines of both sides differ"), "{text}");
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
