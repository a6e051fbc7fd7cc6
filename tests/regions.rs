//! Regions of masks with a parameter, compared with the verdicts on single members, and their certificates.

use secant::algebraic::Root;
use secant::answer::Verdict;
use secant::arith::{Rational, ratio, to_f64};
use secant::ask::{Regions, RegionsOfCurve, curve_regions, regions};
use secant::budget::{Budget, Effort};
use secant::case::setting;
use secant::radius::family::Search;
use secant::radius::{Ended, Options};
use secant::theorem::region::{CurveClaim, Finding, OrderRegion, Part, Subject, member_verdict};
use secant::theorem::regularity::regularity;
use secant::theorem::{ModelError, certify};
use std::path::PathBuf;
use std::process::Command;

fn family(name: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests", "families", name].iter().collect();
    path.to_string_lossy().into_owned()
}

fn found(what: &str, set: &[&str], most: usize) -> Regions {
    let set: Vec<_> = set.iter().map(|t| setting(t).unwrap()).collect();
    regions(what, &set, most, &Search::default()).unwrap()
}

fn answer(order: &OrderRegion, p: &Rational) -> Option<bool> {
    order.at(&Root::from_rational(p)).expect("the parts are the range").answer()
}

/// The ends of parts inside the range.
fn ends(order: &OrderRegion) -> Vec<Root> {
    order.parts.iter().filter(|p| p.is_point()).map(|p| p.from.clone()).collect()
}

fn end_near(order: &OrderRegion, near: f64) -> Root {
    let all = ends(order);
    let end = all.iter().min_by(|a, b| (a.to_f64().0 - near).abs().total_cmp(&(b.to_f64().0 - near).abs()));
    end.cloned().expect("an end")
}

/// What is said of a member by itself.
fn alone(found: &Regions, p: &Rational) -> impl Fn(usize) -> Option<bool> {
    let options = Options { work: Some(150_000_000), ..Options::default() };
    let own = regularity(&found.family.member(p), found.family.arity, &options).unwrap();
    move |order| {
        let row = own.orders.iter().find(|o| o.order == order || o.smooth != Some(true))?;
        row.smooth.filter(|holds| *holds || order == 0 || own.independent)
    }
}

/// Members all over the range, and a little beside every end, are asked by themselves; how many of them answered.
fn compare(found: &Regions, count: i64) -> usize {
    let (lo, hi) = &found.case.range;
    let mut points: Vec<Rational> = (0..=count).map(|k| lo + (hi - lo) * ratio(k, count)).collect();
    for end in found.orders.iter().flat_map(ends) {
        let near = end.enclosure(60).0.mid();
        for far in [ratio(1, 1_000), ratio(1, 1_000_000_000)] {
            points.extend([&near - &far, &near + &far].into_iter().filter(|p| p >= lo && p <= hi));
        }
    }
    points.sort();
    points.dedup();
    let mut decided = 0;
    for p in &points {
        let alone = alone(found, p);
        for order in &found.orders {
            if let (Some(own), Some(here)) = (alone(order.order), answer(order, p)) {
                assert_eq!(own, here, "C^{} at {p} = {}", order.order, to_f64(p));
                decided += 1;
            }
        }
    }
    decided
}

fn print(found: &Regions) {
    for order in &found.orders {
        for Part { from, to, finding } in &order.parts {
            println!("C^{} {} {} {finding:?}", order.order, from.to_f64().0, to.to_f64().0);
        }
    }
}

#[test]
fn the_four_point_scheme() {
    let found = found("four-point", &["w=-1/2..1/2"], 2);
    print(&found);
    let (convergence, c1, c2) = (&found.orders[0], &found.orders[1], &found.orders[2]);
    let border = end_near(c1, 0.19);
    assert_eq!(border.minpoly().primitive_display("w"), "32w^3 + 4w - 1");
    for (p, q, holds) in [(0, 1, false), (1, 1_000_000_000, true), (1, 16, true), (1, 8, true), (-1, 10, false)] {
        assert_eq!(answer(c1, &ratio(p, q)), Some(holds), "{p}/{q}");
    }
    assert_eq!(answer(c1, &ratio(192_729_249, 1_000_000_000)), Some(true));
    assert_eq!(answer(c1, &ratio(192_729_250, 1_000_000_000)), Some(false));
    assert_eq!(c1.at(&border).and_then(Finding::answer), Some(false));
    // All of (0, w*) and all of the rest.
    assert!(c1.parts.iter().all(|part| part.finding.answer().is_some()), "no gap");
    let proved: Vec<&Part> = c1.parts.iter().filter(|part| part.finding.answer() == Some(true)).collect();
    assert_eq!(proved.len(), 1);
    assert!(proved[0].from.same(&Root::from_rational(&ratio(0, 1))) && proved[0].to.same(&border));
    for p in [ratio(0, 1), ratio(-49, 100), ratio(499_999, 1_000_000), border.enclosure(40).0.mid()] {
        assert_eq!(answer(convergence, &p), Some(true), "{p}");
    }
    assert_eq!((answer(convergence, &ratio(-1, 2)), answer(convergence, &ratio(1, 2))), (Some(false), Some(false)));
    assert!(c2.parts.iter().all(|part| part.finding.answer() == Some(false)), "C² nowhere");
    assert!(compare(&found, 40) > 90);
}

#[test]
fn ternary_schemes() {
    let found_four = found("ternary-four-point", &["mu=-1/10..1/5"], 3);
    print(&found_four);
    let c2 = &found_four.orders[2];
    for (p, q, holds) in [(1, 15, false), (1, 9, false), (1, 11, true), (0, 1, false), (1, 5, false)] {
        assert_eq!(answer(c2, &ratio(p, q)), Some(holds), "{p}/{q}");
    }
    let small = ratio(1, 1_000_000_000);
    assert_eq!(answer(c2, &(ratio(1, 15) + &small)), Some(true));
    assert_eq!(answer(c2, &(ratio(1, 9) - &small)), Some(true));
    assert!(compare(&found_four, 24) > 60);
    // C¹ for 2/9 < b < 1/3.
    let found_three = found("ternary-three-point", &["b=0..1/2"], 1);
    print(&found_three);
    let c1 = &found_three.orders[1];
    for (p, holds) in [(ratio(2, 9), false), (ratio(1, 3), false), (ratio(4, 15), true)] {
        assert_eq!(answer(c1, &p), Some(holds), "{p}");
    }
    assert_eq!(answer(c1, &(ratio(2, 9) + &small)), Some(true));
    assert_eq!(answer(c1, &(ratio(1, 3) - &small)), Some(true));
    assert!(compare(&found_three, 24) > 40);
}

#[test]
fn a_family_of_six_points_and_one_of_splines() {
    let six = found(&family("six-point.toml"), &["t=-1/100..1/10"], 2);
    print(&six);
    let c2 = &six.orders[2];
    let border = end_near(c2, 0.0447);
    let known = "524288t^5 - 65536t^4 + 12800t^3 - 352t^2 + 61t - 3";
    assert_eq!(border.minpoly().primitive_display("t"), known);
    for (p, q, holds) in [(-1, 10_000, false), (1, 10_000, true), (447, 10_000, true), (448, 10_000, false)] {
        assert_eq!(answer(c2, &ratio(p, q)), Some(holds), "{p}/{q}");
    }
    let splines = found(&family("cubic-and-quadratic.toml"), &[], 3);
    print(&splines);
    assert!(compare(&splines, 30) > 60);
    // Another value of the other parameter is another family.
    assert!(regions(&family("cubic-and-quadratic.toml"), &[setting("c=1/3").unwrap()], 3, &Search::default()).is_err());
}

#[test]
fn splines_with_a_tension_and_a_single_smoother_one() {
    // The radius of b is (1 + 2k)/8 from -1/4 on, where two more sum rules hold.
    let found = found(&family("tension-spline.toml"), &[], 4);
    print(&found);
    let small = ratio(1, 1_000_000_000);
    for (order, border) in [(0, ratio(7, 2)), (1, ratio(3, 2)), (2, ratio(1, 2)), (3, ratio(0, 1))] {
        let order = &found.orders[order];
        assert_eq!(answer(order, &border), Some(false), "{border}");
        assert_eq!(answer(order, &(&border + &small)), Some(false), "{border}");
        assert_eq!(answer(order, &(&border - &small)), Some(true), "{border}");
    }
    let fourth = &found.orders[4];
    let quarter = ratio(-1, 4);
    assert_eq!(fourth.at(&Root::from_rational(&quarter)), Some(&Finding::Member(true)));
    for p in [&quarter - &small, &quarter + &small, ratio(0, 1)] {
        assert_eq!(answer(fourth, &p), Some(false), "{p}");
    }
    assert!(compare(&found, 36) > 120);
}

#[test]
fn a_search_without_work_or_time_leaves_a_gap_that_says_so() {
    let set = [setting("w=1/20..3/20").unwrap()];
    let known = Search::default();
    let quick = [
        (Search { work: 1, ..known.clone() }, Ended::Work),
        (Search { hulls: 0, ..known.clone() }, Ended::Exhausted),
        (Search { time: Some(std::time::Duration::ZERO), ..known.clone() }, Ended::Clock),
    ];
    for (search, ended) in quick {
        let found = regions("four-point", &set, 1, &search).unwrap();
        let c1 = &found.orders[1];
        assert_eq!(c1.radius.as_ref().map(|r| r.ended), Some(ended), "{search:?}");
        assert!(c1.parts.iter().any(|part| part.finding == Finding::Gap), "{search:?}");
        assert_ne!(found.verdict(), Verdict::Proved, "{search:?}");
    }
    let whole = regions("four-point", &set, 1, &known).unwrap();
    assert!(whole.orders.iter().all(|o| o.radius.as_ref().is_some_and(|r| r.ended == Ended::Done && r.spent > 0)));
    assert!(known.clone().within(2.0).work < known.work);
    let halves = Budget::of(Effort::Quick).regions;
    assert!(halves.work < known.work && halves.hulls < known.hulls);
}

/// The certificate of a family, and the family that it is about.
fn certificate() -> (serde_json::Value, String) {
    let (text, plain) = found("four-point", &["w=0..1/5"], 1).certificate().unwrap();
    (serde_json::from_str(&text).unwrap(), plain)
}

#[test]
fn certificates_are_accepted_and_forgeries_are_not() {
    let (whole, plain) = certificate();
    let accepted = secant_check::check(&plain, &whole.to_string()).unwrap();
    assert_eq!(accepted.verdict, secant_check::Verdict::Refuted);
    let said: Vec<String> = accepted.claims.iter().map(ToString::to_string).collect();
    assert!(
        said.iter().any(|s| s.starts_with("refuted for every w at the root of x^3 + (1/8)x - 1/32 near")),
        "{said:?}"
    );
    let parts = whole["proof"]["orders"][1]["parts"].as_array().unwrap();
    let place = |verdict: &str| parts.iter().position(|p| p["verdict"] == verdict && p["from"] != p["to"]).unwrap();
    let (proved, refuted) = (place("proved"), place("refuted"));
    let rejects = |what: &str, change: &dyn Fn(&mut serde_json::Value)| {
        let mut forged = whole.clone();
        change(&mut forged["proof"]["orders"][1]);
        assert_ne!(forged, whole, "{what}");
        assert!(secant_check::check(&plain, &forged.to_string()).is_err(), "{what}");
    };
    rejects("a proved part refuted by its own word", &|o| {
        o["parts"][proved]["verdict"] = "refuted".into();
        o["parts"][proved]["rule"] = "word".into();
        o["parts"][proved]["by"] = serde_json::json!([0, 1]);
    });
    rejects("a refuted part proved by a hull", &|o| {
        o["parts"][refuted]["verdict"] = "proved".into();
        o["parts"][refuted]["rule"] = "hull".into();
        o["parts"][refuted]["by"] = serde_json::json!([0]);
    });
    rejects("a part left out", &|o| {
        o["parts"].as_array_mut().unwrap().drain(proved..proved + 2);
    });
    rejects("a hull on a longer interval", &|o| {
        let pieces = o["hulls"][0]["pieces"].as_array_mut().unwrap();
        pieces.last_mut().unwrap()["to"] = "1/3".into();
    });
    rejects("an eigenvalue that is none", &|o| {
        let hull = o["hulls"].as_array().unwrap().iter().position(|h| h["pieces"][0]["values"][0].is_array()).unwrap();
        o["hulls"][hull]["pieces"][0]["values"][0][0] = "3/2".into();
    });
    rejects("a vertex left out", &|o| {
        o["hulls"][0]["vertices"].as_array_mut().unwrap().pop();
    });
    rejects("an end that is another root", &|o| {
        for part in o["parts"].as_array_mut().unwrap() {
            for side in ["from", "to"] {
                if part[side]["polynomial"].as_array().unwrap().len() == 4 {
                    part[side] = serde_json::json!({"polynomial": ["-19/100", "1"], "interval": ["19/100", "19/100"]});
                }
            }
        }
    });
    // Without the words that show independence nothing is refuted; and another family has other parts.
    let mut bare = whole.clone();
    bare["proof"]["independent"] = serde_json::json!([]);
    assert!(secant_check::check(&plain, &bare.to_string()).is_err());
    let other = plain.replace("\"1/2\", \"1\"", "\"1/2\", \"2\"");
    assert!(other != plain && secant_check::check(&other, &whole.to_string()).is_err());
}

#[test]
fn the_program_answers() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let out = Command::new(env!("CARGO_BIN_EXE_secant")).args(args).current_dir(dir.path()).output().unwrap();
        (out.status.code(), String::from_utf8(out.stdout).unwrap(), String::from_utf8(out.stderr).unwrap())
    };
    let files = ["--report", "a.html", "--svg", "a.svg", "--certificate", "a.json"];
    let (code, text, _) = run(&[&["region", "four-point", "w=1/10..1/5"], files.as_slice()].concat());
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("0.192729249264812…") && text.contains("the root of 32w^3 + 4w - 1 between"), "{text}");
    for file in ["a.html", "a.svg", "a.json", "a.case.toml"] {
        assert!(std::fs::metadata(dir.path().join(file)).is_ok_and(|m| m.len() > 100), "{file}");
    }
    let svg = std::fs::read_to_string(dir.path().join("a.svg")).unwrap();
    // The border is a line of its own: what has no width is not drawn otherwise.
    assert!(svg.contains("<line class=\"refuted\"") && !svg.contains("width=\"0.00\""), "{svg}");
    let (code, data, _) = run(&["region", "ternary-four-point", "mu=7/100..1/10", "--json"]);
    let data: serde_json::Value = serde_json::from_str(&data).unwrap();
    assert_eq!((code, &data["parameter"]), (Some(1), &"mu".into()));
    assert_eq!(data["orders"][2]["table"][1]["interval"], serde_json::json!(["7/100", "1/10"]));
    assert_eq!(data["orders"][2]["table"][1]["verdict"], "proved");
    assert_eq!(run(&["region", "ternary-four-point", "mu=7/100..1/10", "--order", "2", "--json"]).0, Some(0));
    for wrong in [
        vec!["region", "four-point"],
        vec!["region", "four-point", "w=1/4..0"],
        vec!["region", "koch", "w=0..1"],
        vec!["region", "four-point", "w=0..1/4", "--time", "0"],
    ] {
        let (code, _, problem) = run(&wrong);
        assert_eq!(code, Some(2), "{wrong:?}: {problem}");
        assert!(problem.contains("help") || problem.contains("--time"), "{problem}");
    }
    // A case with parameters is one case only with values.
    let case = family("six-point.toml");
    let (code, _, problem) = run(&["certify", &case]);
    assert!(code == Some(2) && problem.contains("t=1/16"), "{problem}");
    let (code, text, problem) = run(&["certify", &case, "t=1/50", "--certificate", "b.json"]);
    assert!(code == Some(0) && text.contains("proved"), "{text}{problem}");
    let member = std::fs::read_to_string(dir.path().join("b.case.toml")).unwrap();
    assert!(member.contains("\n# Member of a family: t = 1/50\n") && member.contains("\"-49/400\""), "{member}");
    let proof = std::fs::read_to_string(dir.path().join("b.json")).unwrap();
    assert!(secant_check::check(&member, &proof).is_ok());
    let (code, text, problem) = run(&["regularity", &case, "t=1/50"]);
    assert!(code == Some(0) && text.contains("smoothness  C^2"), "{text}{problem}");
    let (code, _, problem) = run(&["certify", &case, "t=1/50", "u=3"]);
    assert!(code == Some(2) && problem.contains("no parameter `u`"), "{problem}");
}

fn curve(name: &str, set: &[&str]) -> RegionsOfCurve {
    let set: Vec<_> = set.iter().map(|t| setting(t).unwrap()).collect();
    let found = curve_regions(&PathBuf::from(family(name)), &set, &Search::default(), &Budget::default()).unwrap();
    for table in &found.found.tables {
        for part in &table.parts {
            let (from, to) = (part.from.to_f64().0, part.to.to_f64().0);
            println!("{:?} {from} {to} {:?} {:?}", table.subject, part.verdict, part.basis);
        }
    }
    found
}

fn says(found: &RegionsOfCurve, subject: Subject, p: &Root) -> Verdict {
    let table = found.found.tables.iter().find(|t| t.subject == subject).expect("a table");
    table.at(p).expect("the parts are the range")
}

/// Single members, all over the range and a little beside every end, say nothing else; how many verdicts were compared.
fn compare_members(found: &RegionsOfCurve, count: i64) -> usize {
    let (lo, hi) = &found.case.range;
    let mut points: Vec<Rational> = (0..=count).map(|k| lo + (hi - lo) * ratio(k, count)).collect();
    for end in found.found.tables.iter().flat_map(|t| &t.parts).map(|p| &p.from) {
        let near = end.enclosure(60).0.mid();
        let far = ratio(1, 1_000_000_000);
        points.extend([&near - &far, &near + &far].into_iter().filter(|p| p >= lo && p <= hi));
    }
    points.sort();
    points.dedup();
    let mut compared = 0;
    for p in &points {
        let here = |subject| says(found, subject, &Root::from_rational(p));
        let mut same = |subject, own| {
            if own != Verdict::Undetermined && here(subject) != Verdict::Undetermined {
                assert_eq!(own, here(subject), "{subject:?} at {p}");
                compared += 1;
            }
        };
        match certify(&found.family.member(p), &[]) {
            Ok(own) => {
                let contracts = if own.contraction.is_proved() { Verdict::Proved } else { Verdict::Undetermined };
                same(Subject::Contraction, contracts);
                for claim in CurveClaim::ALL {
                    same(Subject::Curve(claim), member_verdict(&own, claim));
                }
            }
            Err(ModelError::Expands { .. }) => same(Subject::Contraction, Verdict::Refuted),
            Err(other) => panic!("{other} at {p}"),
        }
    }
    compared
}

/// The verdicts on one claim at several values.
fn expect_claim(found: &RegionsOfCurve, claim: CurveClaim, values: &[(i64, i64, Verdict)]) {
    for (p, q, verdict) in values {
        let here = says(found, Subject::Curve(claim), &Root::from_rational(&ratio(*p, *q)));
        assert_eq!(here, *verdict, "{claim:?} at {p}/{q}");
    }
}

#[test]
fn corner_cutting() {
    use CurveClaim::{Ends, G1, Joints};
    use Verdict::{Proved, Refuted};
    // On the line b = 1/4: proved for 0, (0, 3/8] and 3/4, refuted between, beyond, and below 0.
    let line = curve("corner-cutting.toml", &["a=-1/5..9/10"]);
    let small = 1_000_000_000;
    expect_claim(&line, G1, &[(0, 1, Proved), (3, 8, Proved), (1, small, Proved), (3, 4, Proved), (1, 3, Proved)]);
    expect_claim(&line, G1, &[(-1, small, Refuted), (-1, 10, Refuted), (1, 2, Refuted), (4, 5, Refuted)]);
    expect_claim(&line, G1, &[(375_000_001, small, Refuted), (374_999_999, small, Proved)]);
    expect_claim(&line, Ends, &[(1, 10, Proved), (1, 2, Proved), (3, 8, Proved), (7, 10, Proved)]);
    expect_claim(&line, Joints, &[(1, 10, Proved), (1, 2, Refuted), (3, 8, Proved), (7, 10, Refuted)]);
    assert!(compare_members(&line, 22) > 60);
    // Both parameters equal: G¹ for (0, 1/3] and 1/2.
    let equal = curve("de-rham.toml", &[]);
    expect_claim(&equal, G1, &[(1, 3, Proved), (1, 2, Proved), (1, 4, Proved), (2, 5, Refuted), (3, 5, Refuted)]);
    expect_claim(&equal, G1, &[(333_333_334, small, Refuted), (499_999_999, small, Refuted), (9, 10, Refuted)]);
    assert!(compare_members(&equal, 14) > 40);
}

#[test]
fn takagi_and_okamoto() {
    use CurveClaim::{Ends, G1, Joints};
    use Verdict::{Proved, Refuted};
    let takagi = curve("takagi-landsberg.toml", &[]);
    let small = 1_000_000_000;
    expect_claim(&takagi, G1, &[(1, 4, Proved), (1, 8, Refuted), (1, 3, Refuted), (1, 2, Refuted), (3, 4, Refuted)]);
    expect_claim(&takagi, G1, &[(250_000_001, small, Refuted), (249_999_999, small, Refuted), (-3, 5, Refuted)]);
    expect_claim(&takagi, Joints, &[(1, 4, Proved), (1, 3, Refuted), (1, 8, Refuted)]);
    expect_claim(&takagi, Ends, &[(1, 4, Proved), (1, 3, Proved), (-1, 3, Proved)]);
    // Cusps above 1/2; below -1/2 the leading coefficient, of a negative eigenvalue, changes its sign.
    expect_claim(&takagi, Ends, &[(3, 4, Proved), (17, 20, Proved), (-3, 4, Refuted), (-17, 20, Refuted)]);
    expect_claim(&takagi, Joints, &[(3, 4, Proved), (17, 20, Proved), (-3, 4, Refuted)]);
    assert!(compare_members(&takagi, 18) > 40);
    let okamoto = curve("okamoto.toml", &[]);
    expect_claim(&okamoto, G1, &[(1, 3, Proved), (1, 4, Refuted), (2, 5, Refuted), (1, 2, Refuted), (3, 5, Refuted)]);
    expect_claim(&okamoto, G1, &[(333_333_333, small, Refuted), (333_333_334, small, Refuted)]);
    expect_claim(&okamoto, Joints, &[(1, 3, Proved)]);
    assert!(compare_members(&okamoto, 14) > 30);
}

/// Near 1 and −1 single members take long; the range is answered all the same, and what is left says why.
#[test]
fn ranges_that_end_where_nothing_contracts() {
    let quick = Budget::of(Effort::Quick);
    let set = [setting("r=-1..0").unwrap()];
    let found = curve_regions(family("takagi-landsberg.toml").as_ref(), &set, &quick.regions, &quick).unwrap();
    expect_claim(&found, CurveClaim::G1, &[(-1, 4, Verdict::Refuted), (-999, 1000, Verdict::Refuted)]);
    assert_eq!(says(&found, Subject::Contraction, &Root::from_rational(&ratio(-1, 1))), Verdict::Refuted);
    assert_eq!(says(&found, Subject::Contraction, &Root::from_rational(&ratio(-999, 1000))), Verdict::Proved);
    let begun = std::time::Instant::now();
    let search = Search::default().within(0.3);
    let found = curve_regions(family("takagi-landsberg.toml").as_ref(), &set, &search, &Budget::default()).unwrap();
    assert!(found.found.tables.len() == 4 && begun.elapsed().as_secs() < 30);
}

#[test]
fn certificates_of_curves_are_accepted_and_forgeries_are_not() {
    for (name, set) in [("okamoto.toml", "a=1/5..3/5"), ("takagi-landsberg.toml", "r=-3/5..3/5")] {
        curve(name, &[set]).certificate().unwrap();
    }
    let found = curve("corner-cutting.toml", &["a=1/10..1/2"]);
    let (text, plain) = found.certificate().unwrap();
    let whole: serde_json::Value = serde_json::from_str(&text).unwrap();
    let accepted = secant_check::check(&plain, &text).unwrap();
    let said: Vec<String> = accepted.claims.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|s| s.starts_with("proved for every a strictly between") && s.contains("G1")), "{said:?}");
    assert!(said.iter().any(|s| s.starts_with("refuted for every a strictly between") && s.contains("G1")), "{said:?}");
    let rejects = |what: &str, change: &dyn Fn(&mut serde_json::Value)| {
        let mut forged = whole.clone();
        change(&mut forged["proof"]);
        assert_ne!(forged, whole, "{what}");
        assert!(secant_check::check(&plain, &forged.to_string()).is_err(), "{what}");
    };
    let fact = |why: &str| found_fact(&whole, why);
    let (cones, corner, in_cone) = (fact("cones"), fact("corner"), fact("in-cone"));
    rejects("a proof moved to the corners", &|p| {
        let parts = p["claims"][2]["parts"].as_array_mut().unwrap();
        let at = parts.iter().position(|x| x["by"][0] == corner).unwrap();
        (parts[at]["by"][0], parts[at]["verdict"]) = (cones.into(), "proved".into());
    });
    rejects("a corner moved to the proof", &|p| {
        let parts = p["claims"][2]["parts"].as_array_mut().unwrap();
        let at = parts.iter().position(|x| x["by"][0] == cones).unwrap();
        (parts[at]["by"][0], parts[at]["verdict"]) = (corner.into(), "refuted".into());
    });
    rejects("an eigenvalue that does not lead", &|p| {
        p["facts"][in_cone]["values"][0] = serde_json::json!(["0", "1"]);
    });
    rejects("another ray", &|p| p["facts"][cones]["rays"][0] = serde_json::json!([["1"], ["-3"]]));
    rejects("a cycle left out", &|p| drop(p["facts"][cones]["cycles"].as_array_mut().unwrap().pop()));
    rejects("a window of no letters", &|p| p["facts"][cones]["at"] = serde_json::json!([0]));
    rejects("words that do not span", &|p| p["facts"][cones]["span"] = serde_json::json!([[], []]));
    rejects("a part left out", &|p| drop(p["claims"][2]["parts"].as_array_mut().unwrap().drain(1..3)));
    rejects("claims exchanged", &|p| p["claims"].as_array_mut().unwrap().swap(0, 1));
    // The border is no part of what is proved beside it.
    rejects("a longer interval", &|p| {
        let end = serde_json::json!({"polynomial": ["-2/5", "1"], "interval": ["2/5", "2/5"]});
        for part in p["claims"][2]["parts"].as_array_mut().unwrap() {
            for side in ["from", "to"] {
                if part[side]["polynomial"][0] == "-3/8" {
                    part[side] = end.clone();
                }
            }
        }
    });
    let other = plain.replace("\"1/4\"", "\"1/3\"");
    assert!(other != plain && secant_check::check(&other, &text).is_err());
}

/// The first fact with a reason.
fn found_fact(certificate: &serde_json::Value, why: &str) -> usize {
    let facts = certificate["proof"]["facts"].as_array().unwrap();
    facts.iter().position(|f| f["why"] == why && f["claim"] != "joints").expect("a fact")
}

#[test]
fn the_program_answers_about_curves() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let out = Command::new(env!("CARGO_BIN_EXE_secant")).args(args).current_dir(dir.path()).output().unwrap();
        (out.status.code(), String::from_utf8(out.stdout).unwrap(), String::from_utf8(out.stderr).unwrap())
    };
    let case = family("de-rham.toml");
    let files = ["--report", "a.html", "--svg", "a.svg", "--certificate", "a.json"];
    let (code, text, problem) = run(&[&["region", case.as_str(), "a=1/4..2/5"], files.as_slice()].concat());
    assert_eq!(code, Some(1), "{text}{problem}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("(1/4, 1/3)") && words.contains("lines of both sides differ"), "{text}");
    for file in ["a.html", "a.svg", "a.json", "a.case.toml"] {
        assert!(std::fs::metadata(dir.path().join(file)).is_ok_and(|m| m.len() > 100), "{file}");
    }
    let (code, data, problem) = run(&["region", &case, "a=1/5..3/10", "--json"]);
    let data: serde_json::Value = serde_json::from_str(&data).unwrap_or_else(|e| panic!("{e} {problem}"));
    assert_eq!((code, &data["claims"][3]["claim"]), (Some(0), &"g1".into()), "{data}");
    assert_eq!(data["claims"][3]["table"][1]["interval"], serde_json::json!(["1/5", "3/10"]));
    // Operators that do not depend on the parameter, and control points that do.
    let text = std::fs::read_to_string(&case).unwrap();
    let constant = text.replace("1 - a", "3/4").replace("\"a\"", "\"1/4\"");
    std::fs::write(dir.path().join("constant.toml"), constant).unwrap();
    let moved = text.replace("[parameters]", "control = [[0, 0], [\"a\", 1], [1, 0]]\n\n[parameters]");
    std::fs::write(dir.path().join("moved.toml"), moved).unwrap();
    for name in ["constant.toml", "moved.toml"] {
        let (code, _, problem) = run(&["region", name]);
        assert!(code == Some(2) && problem.contains("help"), "{name}: {problem}");
    }
}

#[test]
fn operators_of_a_scheme_are_no_family() {
    // Its entries are of degree 3 in the split, which the expressions of the file do not tell.
    let text = "name = \"a\"\nconvention = \"columns\"\nstart = \"A\"\n[parameters]\np = \"1/4..3/4\"\n\
                [[state]]\nname = \"A\"\nscheme = \"bezier\"\ndegree = 3\nsplit = \"p\"\n";
    let refused = secant::case::CurveFamilyCase::parse("a.toml", text, &[]).unwrap_err();
    assert!(refused.message().contains("written as maps or operators"), "{}", refused.message());
}
