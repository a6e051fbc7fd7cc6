//! Regions of masks with a parameter, compared with the verdicts on single members, and their certificates.

use secant::algebraic::Root;
use secant::answer::Verdict;
use secant::arith::{Rational, ratio, to_f64};
use secant::ask::{Regions, regions};
use secant::budget::{Budget, Effort};
use secant::case::setting;
use secant::radius::family::Search;
use secant::radius::{Ended, Options};
use secant::theorem::region::{Finding, OrderRegion, Part};
use secant::theorem::regularity::regularity;
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
    assert!(code == Some(2) && problem.contains("w=1/16"), "{problem}");
    let (code, text, problem) = run(&["certify", &case, "t=1/50", "--certificate", "b.json"]);
    assert!(code == Some(0) && text.contains("proved"), "{text}{problem}");
    let member = std::fs::read_to_string(dir.path().join("b.case.toml")).unwrap();
    assert!(member.starts_with("# Member of a family: t = 1/50\n") && member.contains("\"-49/400\""), "{member}");
    let proof = std::fs::read_to_string(dir.path().join("b.json")).unwrap();
    assert!(secant_check::check(&member, &proof).is_ok());
    let (code, text, problem) = run(&["regularity", &case, "t=1/50"]);
    assert!(code == Some(0) && text.contains("smoothness  C^2"), "{text}{problem}");
    let (code, _, problem) = run(&["certify", &case, "t=1/50", "u=3"]);
    assert!(code == Some(2) && problem.contains("no parameter `u`"), "{problem}");
}
