//! Regions of rules on meshes with a parameter, compared with the verdicts on single members.

use secant::algebraic::Root;
use secant::answer::Verdict;
use secant::arith::{Rational, ratio};
use secant::ask::{RegionsAtVertices, vertex_regions};
use secant::budget::Budget;
use secant::case::{Valences, setting};
use secant::radius::family::Search;
use secant::vertex::region::{Finding, Gap, VertexRegion};
use secant::vertex::{Ground, at_valence};
use std::path::PathBuf;
use std::process::Command;

fn family(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "families", name].iter().collect()
}

fn found(name: &str, set: &[&str], valences: &str) -> RegionsAtVertices {
    let set: Vec<_> = set.iter().map(|t| setting(t).unwrap()).collect();
    let valences = Valences::parse(valences).unwrap();
    vertex_regions(&family(name), &set, Some(&valences), &Search::default(), &Budget::default()).unwrap()
}

fn says(region: &VertexRegion, p: &Rational) -> Verdict {
    region.at(&Root::from_rational(p)).expect("the parts are the range").verdict()
}

/// Members all over the range, and a little beside every end, are asked by themselves; how many of both answered.
fn compare(found: &RegionsAtVertices, count: i64) -> usize {
    let (lo, hi) = &found.case.range;
    let mut compared = 0;
    for region in &found.found {
        // Places that differ from valence to valence.
        let share = |k: i64| (ratio(k, 1) + ratio(region.valence as i64, 41)) / ratio(count + 1, 1);
        let mut points: Vec<Rational> = (0..count).map(|k| lo + (hi - lo) * share(k)).collect();
        for part in region.parts.iter().filter(|p| p.is_point()) {
            let near = part.from.enclosure(60).0.mid();
            let far = ratio(1, 1_000_000_000);
            points.extend([&near - &far, &near + &far].into_iter().filter(|p| p >= lo && p <= hi));
        }
        for p in points {
            let own = at_valence(&found.case.member(&p).unwrap(), region.valence).unwrap().smooth;
            let here = says(region, &p);
            if own != Verdict::Undetermined && here != Verdict::Undetermined {
                assert_eq!(own, here, "valence {} at {p}", region.valence);
                compared += 1;
            }
        }
    }
    compared
}

/// The ends of the only part that is proved.
fn proved(region: &VertexRegion) -> (Root, Root) {
    let all: Vec<_> =
        region.parts.iter().filter(|p| p.finding == Finding::By(Ground::Regular) && !p.is_point()).collect();
    assert_eq!(all.len(), 1, "valence {}: {:?}", region.valence, region.parts);
    (all[0].from.clone(), all[0].to.clone())
}

/// `(1 − c)/4 < n β < 1 + c/4`, `c = cos(2π/n)`.
#[test]
fn loop_with_another_weight() {
    let found = found("loop-beta.toml", &[], "3..12");
    for region in &found.found {
        let n = region.valence as f64;
        let c = (std::f64::consts::TAU / n).cos();
        let (from, to) = proved(region);
        for (end, expected) in [(&from, (1.0 - c) / 4.0 / n), (&to, (1.0 + c / 4.0) / n)] {
            assert!((end.to_f64().0 - expected).abs() < 1e-14, "valence {n}: {expected}");
            assert_eq!(region.at(end), Some(Finding::By(Ground::Span)), "valence {n}");
        }
        assert!(region.parts.iter().all(|p| !matches!(p.finding, Finding::Open(_))), "{:?}", region.parts);
    }
    let ends = |n: usize| proved(&found.found[n - 3]);
    assert_eq!((ends(3).0.rational(), ends(3).1.rational()), (Some(ratio(1, 8)), Some(ratio(7, 24))));
    assert_eq!(ends(6).0.rational(), Some(ratio(1, 48)));
    assert_eq!(ends(5).0.minpoly().primitive_display("b"), "320b^2 - 40b + 1");
    assert!(compare(&found, 3) > 60);
}

/// An open interval with its ends from `|α − 1/4| < λ + (1 − 2β)/(16λ)`, `16λ² − (10 + t)λ + 1 = 0`.
#[test]
fn catmull_and_clark_along_a_line() {
    let along_alpha = found("catmull-clark-line.toml", &[], "3,4,5,8");
    for region in &along_alpha.found {
        let t = 2.0 * (std::f64::consts::TAU / region.valence as f64).cos();
        let lambda = (10.0 + t + ((10.0 + t) * (10.0 + t) - 64.0).sqrt()) / 32.0;
        let half = lambda + 0.5 / (16.0 * lambda);
        let (from, to) = proved(region);
        assert!((from.to_f64().0 - 0.25 + half).abs() < 1e-12 && (to.to_f64().0 - 0.25 - half).abs() < 1e-12);
        assert_eq!(
            (region.at(&from), region.at(&to)),
            (Some(Finding::By(Ground::Span)), Some(Finding::By(Ground::Span)))
        );
        assert!(region.parts.iter().all(|p| !matches!(p.finding, Finding::Open(Gap::Clock | Gap::Work))));
    }
    assert!(compare(&along_alpha, 4) > 24);
    // On the side of β a pair of block 0 that is not real reaches λ: |1 − 2β| < 16 λ².
    let along_beta = found("catmull-clark-line.toml", &["s=1/5", "beta=-3..3"], "4,5");
    let (from, to) = proved(&along_beta.found[0]);
    assert_eq!((from.rational(), to.rational()), (Some(ratio(-3, 2)), Some(ratio(23, 10))));
    assert_eq!(along_beta.found[0].at(&Root::from_rational(&ratio(-2, 1))), Some(Finding::By(Ground::Sectors)));
    assert!(compare(&along_beta, 4) > 8);
    // Where α = 1/4 the eigenvalues ±μ of block 0 meet λ: nothing is said of a short part there, nor beyond.
    let both = found("catmull-clark-line.toml", &["s=1/4", "beta=2..3"], "4");
    let open = |p| matches!(both.found[0].at(&Root::from_rational(&p)), Some(Finding::Open(Gap::Narrow | Gap::Same)));
    assert!(open(ratio(5, 2)) && open(ratio(11, 4)), "{:?}", both.found[0].parts);
    assert_eq!(says(&both.found[0], &ratio(2499, 1000)), Verdict::Proved);
}

/// A scheme without Bézier patches, two steps at once.
#[test]
fn kobbelts_scheme_with_another_weight() {
    let found = found("sqrt3-alpha.toml", &[], "4,5");
    for region in &found.found {
        let (from, to) = proved(region);
        assert!(from.to_f64().0 > 0.0 && to.to_f64().0 < 1.5, "{:?}", region.parts);
        assert_eq!(
            (region.at(&from), region.at(&to)),
            (Some(Finding::By(Ground::Span)), Some(Finding::By(Ground::Span)))
        );
        assert_eq!(says(region, &ratio(4, 9)), Verdict::Proved);
    }
    assert!(compare(&found, 4) > 5);
}

#[test]
fn the_program_answers_about_vertices() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let out = Command::new(env!("CARGO_BIN_EXE_secant")).args(args).current_dir(dir.path()).output().unwrap();
        (out.status.code(), String::from_utf8(out.stdout).unwrap(), String::from_utf8(out.stderr).unwrap())
    };
    let case = family("loop-beta.toml").to_string_lossy().into_owned();
    let (code, text, problem) = run(&["region", &case, "--valence", "3", "--report", "a.md", "--svg", "a.svg"]);
    assert_eq!(code, Some(1), "{text}{problem}");
    assert!(text.contains("(1/8, 7/24)") && text.contains("no certificate format"), "{text}");
    for file in ["a.md", "a.svg"] {
        assert!(std::fs::metadata(dir.path().join(file)).is_ok_and(|m| m.len() > 100), "{file}");
    }
    let (code, data, _) = run(&["region", &case, "beta=1/7..1/5", "--valence", "3,6", "--json"]);
    let data: serde_json::Value = serde_json::from_str(&data).unwrap();
    assert_eq!((code, &data["valences"][0]["table"][1]["interval"]), (Some(1), &serde_json::json!(["1/7", "1/5"])));
    assert_eq!(data["valences"][0]["table"][1]["statement"], "theorem-7");
    // Nothing is said after no time, and without valences nothing is asked.
    let (code, text, _) = run(&["region", &case, "--valence", "3", "--time", "0.000001"]);
    assert!(code == Some(3) && text.contains("the time is over"), "{text}");
    let text = std::fs::read_to_string(family("loop-beta.toml")).unwrap();
    std::fs::write(dir.path().join("none.toml"), text.replace("valence = \"3..12\"\n", "")).unwrap();
    std::fs::write(
        dir.path().join("all.toml"),
        text.replace("loop-variant", "butterfly").replace("\nbeta = \"beta\"", "\nw = \"beta\""),
    )
    .unwrap();
    for (args, says) in [
        (&["region", "none.toml"][..], "single valences"),
        (&["region", "all.toml", "--valence", "5"], "away from the centre"),
        (&["region", case.as_str(), "--valence", "3", "--certificate", "a.json"], "no certificate format"),
        (&["region", "four-point", "w=0..1", "--valence", "3"], "has no valences"),
    ] {
        let (code, _, problem) = run(args);
        assert!(code == Some(2) && problem.contains(says) && problem.contains("help"), "{problem}");
    }
}

#[test]
fn weights_that_are_no_polynomials_are_refused() {
    let text = |weight: &str| {
        format!(
            "name = \"a\"\n[parameters]\nb = \"0..1\"\n[vertex]\nmesh = \"loop-variant\"\nbeta = \"{weight}\"\nvalence = \"5\"\n"
        )
    };
    let read = |weight: &str| secant::case::VertexFamilyCase::parse("a.toml", &text(weight), &[]);
    assert!(read("1/10 + b/100").is_ok());
    // It vanishes wherever the family would be looked at to find its degree.
    for weight in ["1/10 + b/100 + b*(b-1/4)*(b-1/2)*(b-3/4)/(1+b^2)", "1/(1+b)", "b/(b-3)"] {
        assert_eq!(read(weight).unwrap_err().id(), "secant::case::parameters", "{weight}");
    }
    // The valence is called n, in regions and with a value.
    let named = text("n/100").replace("b = ", "n = ");
    let family = secant::case::VertexFamilyCase::parse("a.toml", &named, &[]).map(|_| ());
    let member =
        secant::case::member_text("a.toml", &named, &[("n".to_owned(), setting("n=1/2").unwrap().1)]).map(|_| ());
    for refused in [family, member] {
        assert_eq!(refused.unwrap_err().id(), "secant::case::parameter");
    }
}

#[test]
fn a_valence_of_two_costs_the_others_no_certificate() {
    let text = "name = \"a\"\n[vertex]\nmesh = \"catmull-clark\"\nvalence = \"2..4\"\n";
    let question = secant::case::Question::parse("a.toml", text).unwrap();
    let found = secant::ask::answered(&question, true, &Budget::default(), &|| {}).unwrap();
    assert!(found.findings.claims().len() >= 3);
}
