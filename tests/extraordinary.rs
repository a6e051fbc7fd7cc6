//! Extraordinary vertices: the cases, an outside oracle that samples densely, the published facts, and the command line.

use crate::corpus;

use secant::arith::{Interval, Rational, ratio, to_f64};
use secant::case::{Valences, VertexCase};
use secant::certificate::{Doubt, confirm_vertices};
use secant::scheme::{MeshRule, mesh_rule};
use secant::theorem::Verdict;
use secant::vertex::{Again, AtValence, Ground, VertexReason, at_valence};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn rule(name: &str, given: &[(&str, Rational)]) -> MeshRule {
    mesh_rule(name, &given.iter().map(|(k, x)| ((*k).to_owned(), x.clone())).collect()).unwrap()
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn at(rule: &MeshRule, n: usize) -> AtValence {
    at_valence(rule, n).unwrap_or_else(|e| panic!("{rule:?} at {n}: {e}"))
}

fn named(name: &str) -> MeshRule {
    mesh_rule(name, &BTreeMap::new()).unwrap()
}

fn secant(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_secant")).args(arguments).current_dir(root()).output().unwrap()
}

/// All verdicts inside of meshes are proved again by the checker, which builds the schemes from their masks and stencils.
#[test]
fn the_checker_proves_the_verdicts_again() {
    let (mut again, mut once) = (0, Vec::new());
    for file in std::fs::read_dir(root().join("cases/surfaces")).unwrap() {
        let path = file.unwrap().path();
        if !corpus::about_vertices(&path) {
            continue;
        }
        let case = VertexCase::read(&path).unwrap();
        // Vertices on the border have no rule yet.
        if case.border.is_some() {
            continue;
        }
        let mut found: Vec<AtValence> = case.expect.iter().map(|(n, _)| at(&case.rule, *n)).collect();
        found.retain(|f| f.smooth != Verdict::Undetermined);
        found.sort_by_key(|f| f.valence);
        let written = match confirm_vertices(&case, &mut found) {
            Ok(_) => true,
            Err(Doubt::Unsupported(_)) => false,
            Err(doubt) => panic!("{}: {doubt}", case.name),
        };
        assert_eq!(written, found.iter().any(|f| f.again == Again::Proved), "{}", case.name);
        again += found.iter().filter(|f| f.again == Again::Proved).count();
        once.extend(found.iter().filter(|f| f.again != Again::Proved).map(|f| (case.name.clone(), f.valence)));
    }
    once.sort();
    // Second differences shrink too slowly for the bounds of the checker.
    assert_eq!(once, [("butterfly-small-tension".to_owned(), 5)]);
    assert!(again > 150, "{again} valences");
}

#[test]
fn a_certificate_of_a_vertex_is_written_and_checked_against_its_case() {
    let file = std::env::temp_dir().join(format!("secant-vertex-{}.json", std::process::id()));
    let path = file.to_str().unwrap();
    let done = secant(&["certify", "cases/surfaces/loop.toml", "--valence", "5,7", "--certificate", path]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(String::from_utf8_lossy(&done.stdout).contains("proved the verdicts at valences 5, 7 again"));
    let certificate = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let case = |name: &str| std::fs::read_to_string(root().join(format!("cases/surfaces/{name}.toml"))).unwrap();
    let accepted = secant_check::check(&case("loop"), &certificate).unwrap();
    // The case names more valences.
    assert_eq!((accepted.verdict.word(), accepted.claims.len()), ("undetermined", 4));
    assert_eq!(secant_check::check(&case("loop-warren"), &certificate).unwrap_err().rule, "case");
    let renamed = certificate.replace("\"loop\"", "\"loop-zero\"");
    assert_eq!(secant_check::check(&case("loop-zero"), &renamed).unwrap_err().rule, "vertex");
    let none = secant(&["certify", "cases/surfaces/butterfly-small-tension.toml", "--certificate", path]);
    assert_eq!((none.status.code(), file.exists()), (Some(2), false));
}

/// tests/oracle/characteristic.py samples the ring; it shares nothing with the program.
#[test]
fn dense_samples_agree() {
    let text = std::fs::read_to_string(root().join("tests/oracle/characteristic.txt")).unwrap();
    let mut lines = 0;
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |k: usize| words[k].parse::<f64>().unwrap();
        let n: usize = words[1].parse().unwrap();
        let found = at(&named(words[0]), n);
        let top = found.top.as_ref().unwrap();
        assert!((to_f64(&top.enclosure.mid()) - number(2)).abs() < 1e-9, "{line}");
        assert_eq!(found.regular(), Some(number(3) > 0.0), "{line}");
        assert_eq!(found.winding, Some(number(5).round() as usize), "{line}");
        assert_eq!(found.injective(), Some(number(5).round() as usize == 1), "{line}");
        lines += 1;
    }
    assert!(lines >= 110);
}

fn contains(interval: &Interval, value: f64) -> bool {
    to_f64(&interval.lo) - 1e-9 <= value && value <= to_f64(&interval.hi) + 1e-9
}

#[test]
fn the_published_eigenvalues() {
    let lambda = |rule: &MeshRule, n: usize| at(rule, n).top.unwrap();
    for n in 3..=12 {
        let c = (std::f64::consts::TAU / n as f64).cos();
        for (rule, expected) in [
            (named("loop"), 3.0 / 8.0 + c / 4.0),
            (named("catmull-clark"), (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0),
            (named("doo-sabin"), 0.5),
            (named("doo-sabin-catmull-clark"), (2.0 + c) / 4.0),
            (named("midedge"), f64::midpoint(1.0, c)),
            (named("sqrt3"), (2.0 + 2.0 * c) / 9.0),
            (named("butterfly-modified"), 0.5),
        ] {
            let found = lambda(&rule, n);
            assert!(contains(&found.enclosure, expected), "{rule:?} at {n}: {found:?}");
        }
    }
    // Velho and Zorin (2001), values of the quintic.
    for (n, value) in [(3, 0.408_311_432_254_596), (4, 0.5), (7, 0.601_250_190_088_931), (12, 0.638_622_250_455_408)] {
        assert!(contains(&lambda(&named("four-eight"), n).enclosure, value), "4-8 at {n}");
    }
    let display = |n| at(&named("catmull-clark"), n).minimal.unwrap().primitive_display("x");
    assert_eq!((display(3), display(6)), ("16x^2 - 9x + 1".to_owned(), "16x^2 - 11x + 1".to_owned()));
    assert_eq!(lambda(&named("loop"), 3).rational, Some(ratio(1, 4)));
    assert_eq!(at(&named("loop"), 5).minimal.unwrap().primitive_display("x"), "64x^2 - 40x + 5");
    // The original butterfly scheme: value and frequency.
    for (n, value, frequency) in [(9, 0.497_294_073, 2), (10, 0.506_675_611, 2), (14, 0.501_978_319, 3)] {
        let found = at(&named("butterfly"), n);
        assert!(contains(&found.top.as_ref().unwrap().enclosure, value), "{n}");
        assert_eq!((found.frequency, found.smooth), (Some(frequency), Verdict::Refuted), "{n}");
    }
}

#[test]
fn jordan_blocks_at_the_top() {
    let blocks = |name: &str| -> Vec<(usize, Vec<usize>)> {
        at(&named(name), 3).top.unwrap().members.into_iter().map(|m| (m.frequency, m.blocks)).collect()
    };
    // Midedge at valence 3: 1/4 is semisimple in block 0 and has a 2×2 block in block 1.
    assert_eq!(blocks("midedge"), [(0, vec![1, 1]), (1, vec![2, 1])]);
    let butterfly = blocks("butterfly");
    assert_eq!(butterfly[0], (0, vec![3]));
}

/// C¹ exactly for (1 − c)/4 < nβ < 1 + c/4 (n ≥ 4): both ends are found, exactly.
#[test]
fn the_range_of_the_weight_of_loop() {
    let verdict = |n: usize, share: &Rational| {
        let beta = share / Rational::from(n as u64);
        at(&rule("loop-variant", &[("beta", beta)]), n).smooth
    };
    // Valences 4 (c = 0) and 6 (c = 1/2) have rational ends.
    for (n, low, high) in [(4, ratio(1, 4), ratio(1, 1)), (6, ratio(1, 8), ratio(9, 8))] {
        let step = ratio(1, 1_000_000);
        assert_eq!(verdict(n, &low), Verdict::Refuted, "the lower end at {n}");
        assert_eq!(verdict(n, &(&low - &step)), Verdict::Refuted, "below at {n}");
        assert_eq!(verdict(n, &(&low + &step)), Verdict::Proved, "above the lower end at {n}");
        assert_eq!(verdict(n, &(&high - &step)), Verdict::Proved, "below the upper end at {n}");
        assert_eq!(verdict(n, &(&high + &step)), Verdict::Refuted, "above at {n}");
    }
    for n in [5, 7, 9, 16] {
        let c = Rational::try_from((std::f64::consts::TAU / n as f64).cos()).unwrap();
        let step = ratio(1, 100_000);
        let (low, high) = ((ratio(1, 1) - &c) / ratio(4, 1), ratio(1, 1) + &c / ratio(4, 1));
        assert_eq!(verdict(n, &(&low - &step)), Verdict::Refuted, "{n}");
        assert_eq!(verdict(n, &(&low + &step)), Verdict::Proved, "{n}");
        assert_eq!(verdict(n, &(&high - &step)), Verdict::Proved, "{n}");
        assert_eq!(verdict(n, &(&high + &step)), Verdict::Refuted, "{n}");
    }
}

#[test]
fn weights_at_the_vertex_of_catmull_and_clark() {
    let verdict = |n: usize, a: (i64, i64), b: (i64, i64)| {
        let (alpha, beta) = (ratio(a.0, a.1), ratio(b.0, b.1));
        at(&rule("catmull-clark-variant", &[("alpha", alpha), ("beta", beta)]), n).smooth
    };
    for n in [3, 4, 6] {
        assert_eq!(verdict(n, (1, 1), (0, 1)), Verdict::Refuted);
    }
    assert_eq!(verdict(5, (3, 4), (1, 4)), Verdict::Proved);
    assert_eq!(verdict(3, (1, 2), (1, 2)), Verdict::Proved);
    assert_eq!(verdict(4, (7, 8), (1, 8)), Verdict::Refuted);
}

#[test]
fn given_weights_of_a_face() {
    // The original weights at n = 4, written out, and weights without mirror symmetry.
    let given =
        |w: &[(i64, i64)]| rule("doo-sabin", &[]).with_weights(w.iter().map(|(p, q)| ratio(*p, *q)).collect()).unwrap();
    let usual = at(&given(&[(9, 16), (3, 16), (1, 16), (3, 16)]), 4);
    assert_eq!((usual.smooth, usual.top.unwrap().rational), (Verdict::Proved, Some(ratio(1, 2))));
    let skew = at(&given(&[(1, 2), (1, 4), (1, 4), (0, 1)]), 4);
    assert_eq!(skew.smooth, Verdict::Undetermined);
    assert!(at_valence(&given(&[(1, 2), (1, 2)]), 4).is_err());
}

/// A large eigenvalue folds the characteristic map: the witnesses are two places of opposite signs.
#[test]
fn folded_maps() {
    let case = VertexCase::read(&root().join("cases/surfaces/doo-sabin-fold-3.toml")).unwrap();
    let found = at(&case.rule, 3);
    assert_eq!((found.smooth, found.regular(), found.injective()), (Verdict::Refuted, Some(false), Some(false)));
    assert_eq!((&found.reason, found.winding), (&VertexReason::Fold, Some(1)));
    let signs = found.jacobian.as_ref().unwrap();
    assert!(signs.positive.is_some() && signs.negative.is_some());
}

/// Schemes that are no splines, at valences and tensions of no case.
#[test]
fn rings_that_are_no_splines() {
    for (name, n) in [("sqrt3", 40), ("four-eight", 25), ("butterfly-modified", 33)] {
        let found = at(&named(name), n);
        assert_eq!((found.smooth, found.polynomial, found.winding), (Verdict::Proved, false, Some(1)), "{name}");
    }
    // The weight of the neighbours at the vertex does not change the characteristic map, only what dominates.
    for (alpha, verdict) in [(ratio(1, 2), Verdict::Proved), (ratio(3, 1), Verdict::Refuted)] {
        assert_eq!(at(&rule("sqrt3-variant", &[("alpha", alpha)]), 5).smooth, verdict);
    }
    let tension = |w| at(&rule("butterfly-modified", &[("w", w)]), 7);
    assert_eq!(tension(ratio(2, 27)).smooth, Verdict::Proved);
    // The limit is piecewise linear.
    let linear = tension(ratio(0, 1));
    assert_eq!(linear.smooth, Verdict::Undetermined);
    assert_eq!(linear.reason, VertexReason::RegularRule);
    // Small tensions by the factors of the mask (Lemma 4′).
    for (w, n) in [(ratio(1, 1000), 7), (ratio(1, 100), 7), (ratio(6, 179), 8), (ratio(1, 25), 3), (ratio(1, 10), 4)] {
        assert_eq!(at(&rule("butterfly-modified", &[("w", w)]), n).smooth, Verdict::Proved);
    }
    // Long fractions leave room for short words only, which are enough.
    assert_eq!(tension(ratio(513, 8192)).smooth, Verdict::Proved);
    // These do not converge at regular vertices (eigenvalue 1/2 − 6w), or hardly: nothing is claimed.
    for (w, n) in [(ratio(-1, 4), 5), (ratio(-1, 10), 7), (ratio(1, 8), 3)] {
        let found = at(&rule("butterfly-modified", &[("w", w)]), n);
        assert_eq!((found.smooth, found.plane), (Verdict::Undetermined, Verdict::Undetermined), "{:?}", found.reason);
    }
    let found = at(&rule("butterfly", &[("w", ratio(1, 5))]), 6);
    assert_eq!(found.injective(), None);
}

#[test]
fn a_tangent_plane_without_smoothness() {
    let found = at(&named("doo-sabin-frequency"), 5);
    assert_eq!((found.plane, found.smooth), (Verdict::Proved, Verdict::Refuted));
    assert_eq!((found.regular(), found.injective(), found.winding), (Some(true), Some(false), Some(2)));
}

/// The curve of thesis §2.1: the functional of the dominant eigenvalue along the ring is no injective map, and the
/// half-tangent is proved all the same.
#[test]
fn the_curve_whose_characteristic_map_is_not_injective() {
    let case = secant::case::Case::read(&root().join("cases/thesis/half-tangent.toml")).unwrap();
    let found = secant::theorem::certify(&case.shape, &[]).unwrap();
    assert_eq!(found.verdict, Verdict::Proved);
    let ops: Vec<&secant::linalg::Matrix> = case.shape.states[0].pieces.iter().map(|p| &p.op).collect();
    // Left eigenvectors of T_0 for 3/4, with value 0 at the fixed point (1, 0, 0).
    let shifted =
        secant::linalg::Matrix::from_fn(3, 3, |i, j| &ops[0][(j, i)] - if i == j { ratio(3, 4) } else { ratio(0, 1) });
    let g = shifted.kernel().column(0);
    // Points of the ring, the second half of the curve, in order: the images of the end point.
    let mut words: Vec<Vec<usize>> = vec![vec![]];
    for _ in 0..6 {
        words = words.iter().flat_map(|w| [0, 1].map(|l| [w.as_slice(), &[l]].concat())).collect();
    }
    let values: Vec<Rational> = words
        .iter()
        .map(|w| {
            let mut p = vec![ratio(0, 1), ratio(0, 1), ratio(1, 1)];
            for letter in w.iter().rev() {
                p = ops[*letter].apply(&p);
            }
            let p = ops[1].apply(&p);
            p.iter().zip(&g).fold(ratio(0, 1), |s, (a, b)| s + a * b)
        })
        .collect();
    let rises = values.windows(2).any(|w| w[0] < w[1]);
    let falls = values.windows(2).any(|w| w[0] > w[1]);
    assert!(rises && falls, "a continuous function that rises and falls is not injective");
    let sign = values[0] > 0;
    assert!(values.iter().all(|v| *v != 0 && (*v > 0) == sign), "and it has no zero on the ring");
}

#[test]
fn ranges_of_valences() {
    assert_eq!(Valences::parse(" 3..4,9 "), Ok(Valences::List(vec![3, 4, 9])));
    for bad in ["", "1", "9..3", "3..", "x", "3..1025", "-5"] {
        assert!(Valences::parse(bad).is_err(), "{bad}");
    }
}

#[test]
fn the_command_line() {
    let case = "cases/surfaces/catmull-clark.toml";
    let done = secant(&["certify", case, "--valence", "3..6", "--json"]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let json: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(json["valences"].as_array().unwrap().len(), 4);
    assert_eq!(json["valences"][0]["eigenvalue"]["minimal_polynomial"], "16x^2 - 9x + 1");
    assert_eq!(json["valences"][2]["eigenvalue"]["equation"], "16x^2 + (-2c - 10)x + 1");
    assert_eq!(json["valences"][0]["checked"], true);
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str| dir.path().join(name).display().to_string();
    let (svg, html) = (file("map.svg"), file("proof.html"));
    let done = secant(&["certify", case, "--valence", "3,5", "--svg", &svg, "--report", &html]);
    assert_eq!(done.status.code(), Some(0));
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(text.contains("Theorem 7") && text.contains("independent checker"), "{text}");
    assert_eq!(std::fs::read_to_string(&svg).unwrap().matches("<text").count(), 2);
    assert!(std::fs::read_to_string(&html).unwrap().contains("winding number"));
    assert_eq!(secant(&["certify", "cases/surfaces/loop-zero.toml", "--valence", "4"]).status.code(), Some(1));
    let slow = "cases/surfaces/butterfly-small-tension.toml";
    assert_eq!(secant(&["certify", slow, "--valence", "3"]).status.code(), Some(3));
    for bad in ["1", "all,3", "5.."] {
        assert_eq!(secant(&["certify", case, "--valence", bad]).status.code(), Some(2), "{bad}");
    }
    let other = secant(&["certify", "cases/thesis/half-tangent.toml", "--valence", "5"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&other.stderr).contains("[vertex]"));
    assert_eq!(secant(&["certify", "cases/surfaces/sqrt3.toml", "--valence", "all"]).status.code(), Some(2));
}

#[test]
fn all_valences_at_once() {
    for name in ["catmull-clark", "loop", "doo-sabin", "doo-sabin-catmull-clark"] {
        let done = secant(&["certify", &format!("cases/surfaces/{name}.toml"), "--valence", "all"]);
        let text = String::from_utf8_lossy(&done.stdout).into_owned();
        assert_eq!(done.status.code(), Some(0), "{name}: {text}");
        assert!(text.contains("n ≥ 3") && text.contains("Theorem 9"), "{text}");
    }
}

#[test]
fn mistakes_in_files_are_shown() {
    let problem = |text: &str| VertexCase::parse("x.toml", text).err().map(|p| p.render(false)).unwrap_or_default();
    assert!(problem("name = \"x\"\n[vertex]\nmesh = \"catmul-clark\"\n").contains("catmull-clark"));
    assert!(problem("name = \"x\"\n[vertex]\nmesh = \"loop-variant\"\n").contains("beta"));
    assert!(problem("name = \"x\"\n[vertex]\nmesh = \"loop\"\nvalence = 1\n").contains("valence"));
    let text = "name = \"x\"\n[vertex]\nmesh = \"catmull-clark-variant\"\nalpha = 1\nbeta = 1\ngamma = 1\n";
    assert!(problem(text).contains("alpha + beta + gamma"));
    assert!(!Path::new("x.toml").exists());
}

/// Weights for which the rings do not shrink to a point are no matter of the theorems, and are said to be so.
#[test]
fn eigenvalues_that_are_not_smaller_than_1() {
    // 5/8 − nβ: −1, 1 (in a Jordan block with the eigenvalue 1), −7/6, 53/8.
    for (n, share) in [(6, ratio(13, 8)), (6, ratio(-3, 8)), (5, ratio(43, 24)), (6, ratio(-6, 1))] {
        let beta = &share / Rational::from(n as u64);
        let found = at(&rule("loop-variant", &[("beta", beta)]), n);
        assert_eq!(found.smooth, Verdict::Refuted, "{share} at {n}");
        assert_eq!(found.reason, VertexReason::NoLimit, "{share} at {n}");
    }
    let tension = rule("butterfly", &[("w", ratio(1, 1))]);
    assert_eq!(at(&tension, 5).reason, VertexReason::NoLimit);
    // Just below 1 the usual theorems apply.
    let found = at(&rule("loop-variant", &[("beta", ratio(-3, 48) + ratio(1, 6000))]), 6);
    assert!(matches!(found.reason, VertexReason::Line { length: 1, .. }), "{:?}", found.reason);
}

/// A gap of 1e-9 beside the end of the range is seen.
#[test]
fn close_to_the_ends_of_the_range() {
    let step = ratio(1, 1_000_000_000);
    for (n, low, high) in [(4, ratio(1, 4), ratio(1, 1)), (6, ratio(1, 8), ratio(9, 8))] {
        for (share, expected) in [
            (&low - &step, Verdict::Refuted),
            (&low + &step, Verdict::Proved),
            (&high - &step, Verdict::Proved),
            (&high + &step, Verdict::Refuted),
        ] {
            let found = at(&rule("loop-variant", &[("beta", &share / Rational::from(n as u64))]), n);
            assert_eq!(found.smooth, expected, "{share} at {n}: {:?}", found.reason);
        }
    }
}

#[test]
fn a_frequency_is_a_whole_number() {
    for bad in [ratio(3, 2), ratio(-2, 1), ratio(0, 1), ratio(5000, 1)] {
        let given = BTreeMap::from([("frequency".to_owned(), bad.clone())]);
        assert!(mesh_rule("doo-sabin-frequency", &given).is_err(), "{bad}");
    }
}

/// At valence 2 with these weights 1/4 leads in block 1 twice, with the net of (u² − v², uv): the surface is C¹, and no statement
/// here covers it. It was refuted once.
#[test]
fn an_odd_map_at_valence_2_is_not_refuted() {
    let weights = [("alpha".to_owned(), ratio(1, 2)), ("beta".to_owned(), ratio(1, 4))].into();
    let found = at_valence(&mesh_rule("catmull-clark-variant", &weights).unwrap(), 2).unwrap();
    assert_eq!((found.smooth, found.plane), (Verdict::Undetermined, Verdict::Undetermined));
}

/// At valence 2 the quadratic of Catmull and Clark's block 1 has the double root 1/4, and −1/4 is in block 0: the leading
/// eigenvectors span three dimensions.
#[test]
fn two_faces_tie() {
    let rule = mesh_rule("catmull-clark", &[].into()).unwrap();
    let found = at_valence(&rule, 2).unwrap();
    assert_eq!((found.smooth, found.plane, found.ground), (Verdict::Refuted, Verdict::Refuted, Some(Ground::Span)));
    let top = found.top.unwrap();
    assert_eq!((top.rational.clone(), top.longest(2)), (Some(ratio(1, 4)), (1, 3)));
    assert!(at_valence(&mesh_rule("loop", &[].into()).unwrap(), 2).is_err());
    assert!(at_valence(&mesh_rule("doo-sabin", &[].into()).unwrap(), 2).is_err());
}

/// Valences of real models above 256, each within a time that grows with the valence only.
#[test]
fn large_valences_are_proved() {
    for name in ["catmull-clark", "loop", "doo-sabin"] {
        let found = at_valence(&mesh_rule(name, &[].into()).unwrap(), 361).unwrap();
        assert_eq!(found.smooth, Verdict::Proved, "{name}");
    }
}

/// The table of sizes of the curvature: `ρ/λ²`, the exponent, the blocks of `ρ` up to `n/2`, and whether it is C².
#[test]
fn the_published_curvatures() {
    use secant::vertex::{Second, Size};
    let at = |name: &str, n: usize| at_valence(&mesh_rule(name, &[].into()).unwrap(), n).unwrap().curvature;
    for (name, n, size, quotient, exponent, blocks) in [
        ("catmull-clark", 3, Size::Vanishing, None, None, None),
        ("catmull-clark", 4, Size::Bounded, Some(1.0), None, Some(vec![0, 2])),
        ("catmull-clark", 5, Size::Unbounded, Some(1.12437), Some(10.200), Some(vec![2])),
        ("catmull-clark", 6, Size::Unbounded, Some(1.2204), Some(5.475), Some(vec![2])),
        ("catmull-clark", 7, Size::Unbounded, Some(1.2894), Some(4.040), Some(vec![2])),
        ("catmull-clark", 8, Size::Unbounded, Some(1.3388), Some(3.376), Some(vec![2])),
        ("catmull-clark", 12, Size::Unbounded, Some(1.43854), Some(2.500), Some(vec![2])),
        ("loop", 3, Size::Unbounded, Some(2.0), Some(4.0), None),
        ("loop", 4, Size::Bounded, Some(1.0), None, Some(vec![0])),
        ("loop", 5, Size::Bounded, Some(1.0), None, Some(vec![0])),
        ("loop", 6, Size::Bounded, Some(1.0), None, Some(vec![0, 2])),
        ("loop", 7, Size::Unbounded, Some(1.1332), Some(10.127), Some(vec![2])),
        ("loop", 12, Size::Unbounded, Some(1.4291), Some(2.941), Some(vec![2])),
        ("loop-warren", 4, Size::Unbounded, Some(16.0 / 9.0), None, Some(vec![0])),
        ("loop-warren", 5, Size::Unbounded, Some(1.22229), None, Some(vec![0])),
        ("doo-sabin", 3, Size::Bounded, Some(1.0), None, Some(vec![0, 1])),
        ("doo-sabin", 4, Size::Bounded, Some(1.0), None, Some(vec![0, 1, 2])),
        ("doo-sabin", 5, Size::Unbounded, Some(1.0), None, Some(vec![2])),
        ("doo-sabin", 6, Size::Unbounded, Some(1.0), None, Some(vec![2])),
        ("doo-sabin-catmull-clark", 5, Size::Vanishing, None, None, None),
        ("doo-sabin-catmull-clark", 7, Size::Unbounded, Some(1.0330), None, Some(vec![2])),
    ] {
        let found = at(name, n).unwrap_or_else(|| panic!("{name} {n}"));
        assert_eq!(found.size, size, "{name} {n}");
        if let Some(quotient) = quotient {
            assert!((to_f64(&found.ratio.mid()) - quotient).abs() < 6e-5, "{name} {n}: {:?}", found.ratio);
        }
        if let Some(exponent) = exponent {
            assert!((found.exponent.unwrap() - exponent).abs() < 6e-3, "{name} {n}: {:?}", found.exponent);
        }
        if blocks.is_some() {
            assert_eq!(found.blocks, blocks, "{name} {n}");
        }
        assert_eq!(found.power, usize::from(name == "doo-sabin" && n >= 5), "{name} {n}");
    }
    let second = |name: &str, n: usize| at(name, n).unwrap().second;
    assert_eq!([3, 4, 5].map(|n| second("catmull-clark", n)), [Second::Flat, Second::Regular, Second::No]);
    assert_eq!([4, 5, 6].map(|n| second("loop", n)), [Second::No, Second::No, Second::Regular]);
    assert!(at("catmull-clark", 5).unwrap().excludes_convex() && at("loop", 4).unwrap().excludes_saddles());
    // The ring of Doo and Sabin is not C².
    assert_eq!(second("doo-sabin", 4), Second::Open);
    assert!(at("midedge", 5).is_none() && at("sqrt3", 5).is_none());
}

/// Weights tuned for bounded curvature, by stencils of one's own: `H/z²` is no constant, so it is not C².
#[test]
fn tuned_weights_bound_the_curvature() {
    use secant::vertex::{Second, Size};
    for (name, valences) in [("own-loop-bounded", [5, 7]), ("own-catmull-clark-bounded", [5, 6])] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/surfaces").join(name).with_extension("toml");
        let case = VertexCase::read(&path).unwrap();
        for n in valences {
            let found = at_valence(&case.rule, n).unwrap().curvature.unwrap_or_else(|| panic!("{name} {n}"));
            assert_eq!((found.size, found.second), (Size::Bounded, Second::No), "{name} {n}");
            assert_eq!(found.blocks, Some(vec![0, 2]), "{name} {n}");
            assert!(!found.excludes_convex() && !found.excludes_saddles(), "{name} {n}");
        }
    }
}
