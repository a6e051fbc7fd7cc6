//! Masks in several variables: the values of published schemes, counter-examples with small windows, inputs that are refused.
#![allow(clippy::float_arithmetic, reason = "compares printed bounds")]

use secant::arith::{Rational, ratio, to_f64};
use secant::radius::Options;
use secant::scheme::{BorderScheme, Dilation, LatticeMask, NamedSide, Terms, averaged_border, named_mask};
use secant::theorem::border::{BorderAnswer, BorderRegularity, border_regularity};
use secant::theorem::lattice::{Answer, LatticeRegularity, Stability, lattice_regularity};
use secant::theorem::regularity::Attained;

fn symbol(text: &str, dilation: Option<&str>) -> LatticeMask {
    LatticeMask::parse(text, dilation.map(|d| Dilation::parse(d).unwrap())).unwrap()
}

fn named(name: &str, parameters: &[&str]) -> LatticeMask {
    let parameters: Vec<String> = parameters.iter().map(|p| (*p).to_owned()).collect();
    named_mask(name, &parameters).unwrap().unwrap()
}

fn found(mask: LatticeMask) -> LatticeRegularity {
    lattice_regularity(mask, &Options::default()).unwrap()
}

fn exponent(r: &LatticeRegularity) -> (f64, f64) {
    let e = r.exponent.clone().unwrap();
    (to_f64(&e.lo), to_f64(&e.hi))
}

fn exactly(r: &LatticeRegularity, value: &Rational) {
    assert!(r.radius.exact, "{:?}", r.radius.upper);
    assert_eq!(r.radius.upper.as_ref(), Some(value));
}

#[test]
fn the_zwart_powell_element() {
    let zp = [
        found(symbol("(1+x)*(1+y)*(1+x*y)*(1+x/y)/4", None)),
        found(named("box-spline", &["directions=(1,0)(0,1)(1,1)(1,-1)"])),
    ];
    for r in zp {
        exactly(&r, &ratio(1, 4));
        assert_eq!((r.sum_rules, r.smoothness(), r.is_exact(), r.exponent_is_exact()), (2, Some(1), false, false));
        assert_eq!(r.orders, [Answer::Smooth, Answer::Smooth, Answer::Unstable]);
        assert_eq!(exponent(&r), (2.0, 2.0));
        assert!(matches!(r.stability, Stability::Unknown | Stability::Dependent(_)));
    }
}

#[test]
fn parameters_behind_the_name() {
    let given = ["first=1/2,1,1/2".to_owned(), "second=1/2,1,1/2".to_owned()];
    let apart = secant::ask::regularity("tensor", &given, 2).expect("an answer");
    let behind = secant::ask::regularity(&format!("tensor {}", given.join(" ")), &[], 2).expect("an answer");
    assert_eq!((&apart.text, &apart.data), (&behind.text, &behind.data));
    assert!(secant::ask::regularity("tensor third=1/2,1,1/2", &[], 2).is_err());
}

#[test]
fn loop_is_c2_and_not_c3() {
    for mask in [named("loop", &[]), symbol("(1+z1)^2*(1+z2)^2*(1+z1*z2)^2/16", None)] {
        let r = found(mask);
        exactly(&r, &ratio(1, 8));
        assert_eq!((r.sum_rules, r.smoothness(), r.is_exact()), (4, Some(2), true));
        assert_eq!(r.orders.last(), Some(&Answer::Rough));
        assert_eq!(exponent(&r), (3.0, 3.0));
    }
}

#[test]
fn one_step_of_four_eight() {
    let r = found(named("four-eight", &[]));
    exactly(&r, &ratio(1, 4));
    // It is C⁴ in truth, which its sum rules do not show.
    assert_eq!((r.sum_rules, r.smoothness(), r.is_exact()), (4, Some(3), false));
    assert_eq!(exponent(&r), (4.0, 4.0));
}

#[test]
fn butterflies() {
    let r = found(named("butterfly", &["w=1/16"]));
    exactly(&r, &ratio(1, 4));
    assert_eq!((r.smoothness(), r.is_exact(), r.attained), (Some(1), true, Attained::No));
    assert_eq!(exponent(&r), (2.0, 2.0));
    let r = found(named("butterfly", &["w=1/32"]));
    let (low, high) = exponent(&r);
    assert!(low <= 1.228_447 && 1.228_446 <= high && high - low < 1e-5, "{low} {high}");
    assert_eq!((r.smoothness(), r.is_exact()), (Some(1), true));
    assert!(matches!(r.stability, Stability::Interpolatory(_)));
}

#[test]
#[ignore = "takes a minute where it is not optimised"]
fn butterflies_of_large_tension() {
    let r = found(named("butterfly", &["w=3/32"]));
    exactly(&r, &ratio(3, 8));
    assert!((exponent(&r).0 - 1.415_037).abs() < 1e-6);
    assert_eq!((r.smoothness(), r.is_exact()), (Some(1), true));
    let r = found(named("butterfly", &["w=1/8"]));
    exactly(&r, &ratio(1, 2));
    assert_eq!(r.orders, [Answer::Smooth, Answer::Rough]);
    assert_eq!(exponent(&r), (1.0, 1.0));
}

#[test]
#[ignore = "takes a minute where it is not optimised"]
fn root_three() {
    let r = found(named("sqrt3", &[]));
    let (low, high) = exponent(&r);
    // log₃ 18
    assert!(low <= 2.630_93 && 2.630_929 <= high && low > 2.6, "{low} {high}");
    assert_eq!((r.smoothness(), r.is_exact()), (Some(2), true));
}

#[test]
fn quincunx() {
    let r = found(symbol("1+(x+y+1/x+1/y)/4", Some("[[1,1],[1,-1]]")));
    let (low, high) = exponent(&r);
    // (1 + √5)/4
    assert!(r.radius.exact && (low - 0.611_517).abs() < 1e-5 && high - low < 1e-9, "{low}");
    assert_eq!(r.orders, [Answer::Smooth, Answer::Rough]);
}

#[test]
#[ignore = "takes a minute where it is not optimised"]
fn a_large_quincunx_mask() {
    let far = "(x*y^2+x/y^2+y^2/x+1/x/y^2+x^2*y+x^2/y+y/x^2+1/x^2/y)/32";
    let r = found(symbol(&format!("1+5/16*(x+y+1/x+1/y)-{far}"), Some("quincunx")));
    let upper = r.radius.upper.clone().unwrap();
    assert!(upper < ratio(7, 10) && r.smoothness() == Some(1), "{}", to_f64(&upper));
    assert!(r.is_exact() && exponent(&r).1 > 1.459);
}

#[test]
fn products() {
    let r = found(named("tensor", &["first=bspline degree=2", "second=1/4,3/4,3/4,1/4"]));
    exactly(&r, &ratio(1, 4));
    assert_eq!((r.smoothness(), r.is_exact()), (Some(1), true));
    assert!(matches!(r.stability, Stability::Samples(_)));
    assert_eq!(exponent(&r), (2.0, 2.0));
    let r = found(named("tensor", &["first=four-point", "second=four-point"]));
    exactly(&r, &ratio(1, 4));
    assert_eq!((r.smoothness(), r.is_exact()), (Some(1), true));
}

#[test]
fn small_windows_would_be_wrong() {
    // With the smallest window that contains 0 all of these would be one order smoother.
    let bilinear = found(symbol("(1+x)^2*(1+y)^2/4", None));
    assert_eq!(bilinear.orders, [Answer::Smooth, Answer::Rough]);
    let haar = found(symbol("(1+x)*(1+y)", None));
    assert_eq!((haar.converges(), haar.smoothness()), (Some(false), None));
    let line = Dilation::new(vec![vec![2]]).unwrap();
    let hat = Terms::new(1, [(vec![0], ratio(1, 2)), (vec![1], ratio(1, 1)), (vec![2], ratio(1, 2))]);
    let hat = found(LatticeMask::new(hat, line).unwrap());
    assert_eq!(hat.orders, [Answer::Smooth, Answer::Rough]);
}

#[test]
fn one_and_three_variables() {
    // As the table of masks in one variable has it.
    let line = Dilation::new(vec![vec![2]]).unwrap();
    let cubic = Terms::new(1, [1, 4, 6, 4, 1].iter().enumerate().map(|(k, c)| (vec![k as i64], ratio(*c, 8))));
    let cubic = found(LatticeMask::new(cubic, line).unwrap());
    assert_eq!((cubic.smoothness(), cubic.is_exact(), exponent(&cubic)), (Some(2), true, (3.0, 3.0)));
    let r = found(symbol("(1+x)*(1+y)*(1+z)*(1+x*y*z)/2", None));
    assert_eq!((r.mask.dilation().dimensions(), r.converges()), (3, Some(true)));
    assert_eq!((r.smoothness(), r.is_exact()), (Some(0), true));
}

fn secant(args: &[&str]) -> assert_cmd::assert::Assert {
    assert_cmd::Command::cargo_bin("secant").unwrap().args(args).assert()
}

#[test]
fn on_the_command_line() {
    let output = secant(&["regularity", "(1+x)^2*(1+y)^2/8", "--dilation", "quincunx"]).success();
    let text = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(text.contains("C^3: proved") && text.contains("exponent >= 4.0"), "{text}");
    let output = secant(&["regularity", "loop", "--json"]).success();
    let data: serde_json::Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
    assert_eq!((&data["kind"], &data["smoothness"]), (&"lattice mask".into(), &2.into()));
    for (args, wanted) in [
        (vec!["(1+x)^2*(1+y)^2/5"], "sum to"),
        (vec!["(1+x2)*(1+y)"], "character 4"),
        (vec!["(1+x)*(1+y)", "--dilation", "[[2,0],[0,3]]"], "moduli"),
        (vec!["(1+z)^3/4", "--dilation", "quincunx"], "dilation"),
        (vec!["box-spline"], "directions"),
        (vec!["butterfly", "tension=1"], "tension"),
    ] {
        let output = secant(&[vec!["regularity"], args.clone()].concat()).code(2);
        let text = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(text.contains(wanted) && text.contains("help"), "{args:?}: {text}");
    }
}

#[test]
fn files_and_certificates() {
    let folder = tempfile::tempdir().unwrap();
    let (case, certificate) = (folder.path().join("biquadratic.toml"), folder.path().join("c.json"));
    std::fs::write(&case, "name = \"biquadratic\"\n[mask]\nsymbol = \"(1+x)^3*(1+y)^3/16\"\n").unwrap();
    let (case, certificate) = (case.to_str().unwrap(), certificate.to_str().unwrap());
    secant(&["regularity", case, "--certificate", certificate]).success();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let accepted = secant_check::check(&read("c.case.toml"), &read("c.json")).unwrap();
    let smooth = |order| secant_check::Claim::LatticeSmooth { order };
    let said: Vec<(secant_check::Claim, secant_check::Verdict)> =
        accepted.claims.iter().map(|d| (d.claim.clone(), d.verdict)).collect();
    let (proved, refuted) = (secant_check::Verdict::Proved, secant_check::Verdict::Refuted);
    assert_eq!(said[..3], [(smooth(0), proved), (smooth(1), proved), (smooth(2), refuted)]);
    let expected = secant_check::Claim::LatticeExponent {
        dimensions: 2,
        index: 4,
        low: secant_check::number::canonical("1/4").unwrap(),
        high: secant_check::number::canonical("1/4").unwrap(),
        exact: true,
    };
    assert_eq!(said[3..], [(expected, proved)]);
    // The grid in place of the symbol says the same.
    let grid = folder.path().join("grid.toml");
    std::fs::write(&grid, read("c.case.toml")).unwrap();
    let data = |what: &str| {
        let output = secant(&["regularity", what, "--json"]).success();
        let mut data: serde_json::Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
        data["input"] = serde_json::Value::Null;
        data
    };
    assert_eq!(data(case), data(grid.to_str().unwrap()));
    for (text, wanted) in [
        ("name = \"a\"\n[mask]\ngrid = [[1, 1], [1, 1]]\n", "origin"),
        ("name = \"a\"\n[mask]\ngrid = [[1, 1], [1, 2]]\norigin = [0, 0]\n", "sum to 2"),
        ("name = \"a\"\n[mask]\ngrid = [[1, 1], [1, 1]]\norigin = [0, 0]\ndilation = [[1, 0], [0, 2]]\n", "dilation"),
        (
            "name = \"a\"\n[mask]\ngrid = [[1, 1], [1, 1]]\norigin = [0, 0]\ndirections = [[1, 0], [1, 1]]\n",
            "directions",
        ),
    ] {
        std::fs::write(&grid, text).unwrap();
        let output = secant(&["regularity", grid.to_str().unwrap()]).code(2);
        let shown = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(shown.contains(wanted) && shown.contains("grid.toml:"), "{shown}");
    }
}

fn border(names: [NamedSide; 2], more: Vec<((i64, usize), Terms)>) -> BorderRegularity {
    let sides = names.map(|n| n.side().unwrap());
    let scheme = BorderScheme::new(sides, averaged_border(names).into_iter().chain(more)).unwrap();
    border_regularity(scheme, &Options::default()).unwrap()
}

const QUADS: NamedSide = NamedSide::CatmullClark;
const TRIANGLES: NamedSide = NamedSide::Loop;

#[test]
fn the_border_of_stam_and_loop_is_c1_and_not_c2() {
    let r = border([QUADS, TRIANGLES], Vec::new());
    assert_eq!((r.smoothness(), r.is_exact()), (Some(1), true));
    let [_, first, second] = &r.orders[..] else { panic!("three orders") };
    // On nets modulo 1, x, y the radius is 1/4.
    let radius = first.radius.as_ref().unwrap();
    assert_eq!(radius.lower.as_ref().unwrap().rational(), Some(ratio(1, 4)));
    assert!(radius.upper.as_ref().unwrap() < &ratio(2501, 10000));
    assert_eq!(second.answer, BorderAnswer::Jump);
    let model = second.model.as_ref().unwrap();
    assert_eq!((model.equal.cols(), model.pairs.cols()), (5, 6));
    // y² on the left, y² + x²/4 on the right; monomials 1, y, x, y², xy, x².
    let number = |k: i64| ratio(k, 4);
    let [jump] = &model.jumps()[..] else { panic!("one jump") };
    assert_eq!(jump[0], [0, 0, 0, 4, 0, 0].map(number));
    assert_eq!(jump[1], [0, 0, 0, 4, 0, 1].map(number));
    // Without these nets 0.130297, attained by the word 01.
    assert!(second.sided);
    let upper = to_f64(second.radius.as_ref().unwrap().upper.as_ref().unwrap());
    assert!((upper - 0.130_297).abs() < 1e-5, "{upper}");
}

#[test]
fn a_border_that_is_none_is_as_smooth_as_the_sides() {
    for side in [QUADS, TRIANGLES] {
        let r = border([side, side], Vec::new());
        assert_eq!((r.smoothness(), r.is_exact()), (Some(2), true));
        assert_eq!(r.orders.last().unwrap().answer, BorderAnswer::Side(0));
        assert_eq!(r.orders[2].model.as_ref().unwrap().equal.cols(), 6);
    }
}

/// The border row is read as `b + pΔ²b` on the left and `b + rΔ²b` on the right, also by the new points of the border itself.
fn unzipped(p: Rational, r: Rational) -> Vec<((i64, usize), Terms)> {
    let mut found = std::collections::BTreeMap::<(i64, usize), Vec<(Vec<i64>, Rational)>>::new();
    for (side, step, share) in [(QUADS, -1, p), (TRIANGLES, 1, r)] {
        let both = [side, side];
        let plain = BorderScheme::new(both.map(|n| n.side().unwrap()), averaged_border(both)).unwrap();
        for (column, phase) in [(0, 0), (0, 1), (step, 0), (step, 1), (2 * step, 0), (2 * step, 1)] {
            let terms = found.entry((column, phase)).or_default();
            for (a, c) in plain.rule(column, phase as i64) {
                if a[0] * step > 0 {
                    terms.push((a, c));
                } else if a[0] == 0 {
                    let c = if column == 0 { c * ratio(1, 2) } else { c };
                    let outer = &c * &share;
                    terms.push((vec![0, a[1]], &c - &outer * ratio(2, 1)));
                    terms.extend([-1, 1].map(|k| (vec![0, a[1] + k], outer.clone())));
                }
            }
        }
    }
    found.into_iter().map(|(at, terms)| (at, Terms::new(2, terms))).collect()
}

#[test]
fn an_unzipped_border_is_c2() {
    let r = border([QUADS, TRIANGLES], unzipped(ratio(-1, 48), ratio(1, 48)));
    assert_eq!((r.smoothness(), r.is_exact()), (Some(2), true));
    let model = r.orders[2].model.as_ref().unwrap();
    assert_eq!((model.equal.cols(), model.pairs.cols()), (6, 6));
    // The constants differ by 1/24 and with this sign only.
    let r = border([QUADS, TRIANGLES], unzipped(ratio(1, 48), ratio(-1, 48)));
    assert_eq!((r.smoothness(), r.orders.last().unwrap().answer), (Some(1), BorderAnswer::Jump));
}

const STAM_LOOP: &str = "name = \"stam-loop\"\n[border]\nleft = \"catmull-clark\"\nright = \"loop\"\n";

#[test]
fn borders_in_files_and_their_certificates() {
    let folder = tempfile::tempdir().unwrap();
    let (case, certificate) = (folder.path().join("stam-loop.toml"), folder.path().join("c.json"));
    std::fs::write(&case, STAM_LOOP).unwrap();
    let (case, certificate) = (case.to_str().unwrap(), certificate.to_str().unwrap());
    let output = secant(&["regularity", case, "--certificate", certificate]).success();
    let text = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(text.contains("limit y^2 for x < 0 and 1/4*x^2 + y^2 for x > 0"), "{text}");
    assert!(text.contains("smoothness  C^1, and not C^2: proved") && text.contains("C^2 up to the border"), "{text}");
    let refused = secant(&["certify", case]).code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("secant regularity"));
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let (source, proof) = (read("c.case.toml"), read("c.json"));
    let accepted = secant_check::check(&source, &proof).unwrap();
    let said: Vec<String> = accepted.claims.iter().map(|d| format!("{:?} {:?}", d.claim, d.verdict)).collect();
    let smooth = |order| format!("BorderSmooth {{ order: {order} }}");
    let wanted = [
        smooth(0) + " Proved",
        smooth(1) + " Proved",
        smooth(2) + " Refuted",
        "BorderSided { order: 2 } Proved".to_owned(),
    ];
    assert_eq!(said, wanted);
    // The grids in place of the names say the same.
    let data = |what: &str| {
        let output = secant(&["regularity", what, "--json"]).success();
        let mut data: serde_json::Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
        data["input"] = serde_json::Value::Null;
        data
    };
    let grids = folder.path().join("c.case.toml");
    assert_eq!(data(case), data(grids.to_str().unwrap()));
    assert_eq!(data(case)["orders"][2]["by"], "jump");
    // Forgeries.
    let forged = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut whole: serde_json::Value = serde_json::from_str(&proof).unwrap();
        change(&mut whole["proof"]);
        secant_check::check(&source, &whole.to_string())
    };
    use serde_json::json;
    assert!(forged(&|_| ()).is_ok());
    assert!(forged(&|p| p["orders"][2]["by"] = json!("radius")).is_err(), "J is not below 1/4");
    assert!(forged(&|p| p["orders"][1]["by"] = json!("jump")).is_err(), "no jump of order 1");
    assert!(forged(&|p| p["orders"][2] = json!({"by": "right"})).is_err(), "both sides are C²");
    assert!(forged(&|p| p["orders"] = json!([])).is_err());
    assert!(forged(&|p| drop(p["orders"][0]["window"].as_array_mut().unwrap().pop())).is_err());
    assert!(forged(&|p| p["orders"][0]["reach"] = json!(1)).is_err());
    assert!(forged(&|p| p["sides"][0] = p["sides"][1].clone()).is_err());
    assert!(forged(&|p| p["orders"][1]["radius"] = p["orders"][2]["radius"].clone()).is_err());
    let moved = source.replacen("\"19/32\"", "\"1/2\"", 1).replacen("\"5/64\"", "\"11/64\"", 1);
    assert!(moved != source && secant_check::check(&moved, &proof).is_err());
}

#[test]
fn borders_that_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("border.toml");
    let wide = "{ symbol = \"(1+x)^6*(1+y)^2/64/(x^3*y)\", place = [1, 0] }";
    for (table, wanted) in [
        ("left = \"catmull-clark\"\n".to_owned(), "right"),
        ("left = \"doo-sabin\"\nright = \"loop\"\n".to_owned(), "catmull-clark and loop"),
        (format!("left = \"loop\"\nright = {wide}\n"), "no weights for new points (0, 2k + 0)"),
        ("left = \"loop\"\nright = { symbol = \"(1+x)*(1+y)\" }\n".to_owned(), "place"),
        (
            "left = \"loop\"\nright = \"loop\"\n[[border.stencil]]\nat = [0, 0]\nweights = [[0, 0, \"1/2\"]]\n"
                .to_owned(),
            "sum to 1/2",
        ),
        (
            "left = \"loop\"\nright = \"loop\"\n[[border.stencil]]\nat = [0, 2]\nweights = [[0, 0, 1]]\n".to_owned(),
            "row modulo 2",
        ),
    ] {
        std::fs::write(&file, format!("name = \"a\"\n[border]\n{table}")).unwrap();
        let output = secant(&["regularity", file.to_str().unwrap()]).code(2);
        let shown = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(shown.contains(wanted) && shown.contains("border.toml:") && shown.contains("help"), "{shown}");
    }
}
