//! Spectra over real number fields against SymPy, `secant spectrum` on files with irrational entries, and verdicts on cases with
//! such entries.

use assert_cmd::Command;
use secant::algebraic::{Elem, Real};
use secant::answer::Verdict;
use secant::budget::Budget;
use secant::case::matrix_file::parse_field;
use secant::case::{Case, Question};
use secant::jordan::FieldSpectrum;
use secant::linalg::Entry;
use secant::prove::{Findings, confirm, prove};
use secant::scheme::{field_local_matrix, mesh_rule};
use secant::theorem::{Assertion, Certified, Claim, Direction, Kind, Role};
use serde_json::Value;
use std::path::PathBuf;

#[test]
fn spectra_agree_with_sympy() {
    let oracle = include_str!("oracle/field.txt");
    assert!(oracle.lines().count() >= 13);
    for line in oracle.lines() {
        let mut parts = line.split("; ");
        let (name, text, expected) = (parts.next().unwrap(), parts.next().unwrap(), parts.next().unwrap());
        let s = FieldSpectrum::of(&parse_field(name, text).unwrap_or_else(|e| panic!("{name}: {e}")).matrix);
        let list = |values: Vec<String>| values.join(",");
        let mut found: Vec<String> = s
            .factors
            .iter()
            .map(|f| {
                let blocks = list(f.blocks.iter().map(ToString::to_string).collect());
                let poly = list(f.minpoly.primitive().iter().map(ToString::to_string).collect());
                format!("{}:{}:{blocks}:{poly}", f.degree(), f.multiplicity)
            })
            .collect();
        found.sort();
        let mut expected: Vec<String> = expected.split(' ').map(str::to_owned).collect();
        expected.sort();
        assert_eq!(found, expected, "{name}");
    }
}

/// The eigenvectors of a factor in the field, scaled so that the first nonzero entry is 1, are what SymPy has for the
/// matrix with rows `(sqrt 5, 1)` and `(0, 1/2)`: `(1, 0)` and `(1, 1/2 - sqrt 5)`.
#[test]
fn eigenvectors_are_in_the_field() {
    let s = FieldSpectrum::of(&parse_field("m", "2 sqrt(5) 1 0 1/2").unwrap().matrix);
    let shown: Vec<Vec<String>> =
        s.factors.iter().map(|f| f.right[0].vectors[0].iter().map(|e: &Elem| s.field.display(e)).collect()).collect();
    assert_eq!(shown, [["1", "1/2 - sqrt(5)"], ["1", "0"]]);
}

#[test]
fn loop_and_doo_sabin_have_their_known_eigenvalues_at_larger_valences() {
    for n in [9usize, 11, 13] {
        let local = field_local_matrix(&mesh_rule("loop", &[].into()).unwrap(), n, 1).unwrap();
        let s = FieldSpectrum::of(&local.matrix);
        // (3/8 + c_k/4), twice for each k, in the field.
        assert!(s.factors.iter().all(|f| f.in_field()), "{n}");
        assert_eq!(s.factors.iter().filter(|f| f.blocks == [1, 1]).count(), (n - 1) / 2, "{n}");
        let dual = field_local_matrix(&mesh_rule("doo-sabin", &[].into()).unwrap(), n, 1).unwrap();
        let s = FieldSpectrum::of(&dual.matrix);
        let mut values: Vec<(String, usize)> =
            s.factors.iter().map(|f| (s.field.display(&f.poly[0].neg()), f.multiplicity)).collect();
        values.sort_by_key(|v| std::cmp::Reverse(v.1));
        let expected = [("1/4", n - 3), ("1/2", 2), ("1", 1)].map(|(t, m)| (t.to_owned(), m));
        assert_eq!(values, expected, "{n}");
    }
}

fn file(name: &str, text: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn output(args: &[&str], code: i32) -> (String, String) {
    let out =
        Command::cargo_bin("secant").expect("the program is built").args(args).output().expect("the program runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    assert_eq!(out.status.code(), Some(code), "{args:?}\n{}", String::from_utf8_lossy(&out.stderr));
    (text(out.stdout), text(out.stderr))
}

#[test]
fn the_program_prints_spectra_over_fields() {
    let path = file("field-cos.txt", "{{3/8 + Cos[2 Pi/7]/4, 1}, {0, 3/8 + Cos[2 Pi/7]/4}}\n");
    let path = path.to_str().unwrap();
    let (text, err) = output(&["spectrum", path], 0);
    assert!(text.contains("over Q(α), α = 2*cos(2*pi/7) = 1.2469796037, root 3 of x^3 + x^2 - 2x - 1"), "{text}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("1/8α + 3/8 = 0.5308724505 (root 3 of 512x^3 - 512x^2 + 152x - 13), multiplicity 2, block 2")
    );
    assert_eq!(err, "");
    let (json, _) = output(&["spectrum", "--json", path], 0);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["factors"][0]["blocks"], serde_json::json!([2]));
    assert_eq!(json["field"]["polynomial"], serde_json::json!(["-1", "-2", "1", "1"]));
    let (latex, _) = output(&["spectrum", "--latex", path], 0);
    assert!(latex.contains("K = \\mathbb{Q}(\\alpha)"), "{latex}");
    let (transposed, _) = output(&["spectrum", "--transpose", path], 0);
    assert!(transposed.contains("right 1.1  (0, 1)"), "{transposed}");
    let (approximate, _) = output(&["spectrum", "--approx", path], 3);
    assert!(approximate.contains("APPROXIMATE") && approximate.contains("0.53087"), "{approximate}");
}

#[test]
fn coefficients_in_powers_of_the_generator_are_printed() {
    for (entries, factor) in [
        ("1 cbrt(2)", "(x - α)"),
        ("1 -cbrt(2)", "(x + α)"),
        ("1 3*cbrt(2)/2", "(x - 3/2α)"),
        ("1 cbrt(2)^2-1", "(x + (-α^2 + 1))"),
        ("2 0 cbrt(2) 1 0", "(x^2 - α)"),
        ("2 cbrt(2)^2 3*cbrt(2) 1 0", "(x^2 - α^2 x - 3α)"),
        ("2 0 1 1 cos(2*pi/7)", "(x^2 - 1/2α x - 1)"),
        ("2 0 sqrt(5)/2 1 1+sqrt(5)", "(x^2 + (-1 - sqrt(5))x - sqrt(5)/2)"),
    ] {
        let path = file("field-powers.txt", entries);
        let path = path.to_str().unwrap();
        let (text, _) = output(&["spectrum", path], 0);
        assert!(text.contains(&format!("characteristic polynomial  {factor}\n")), "{entries}: {text}");
        output(&["spectrum", "--json", path], 0);
        let (latex, _) = output(&["spectrum", "--latex", path], 0);
        assert_eq!(latex.matches('{').count(), latex.matches('}').count(), "{latex}");
    }
}

#[test]
fn fields_of_large_degree_are_refused_at_once() {
    for text in ["7**4.4/11**4.4", "2^(1/24)*3^(1/13)", "2^(1/5)*3^(1/5)*7^(1/5)"] {
        let path = file("field-degree.txt", &format!("1\n{text}\n"));
        let (_, err) = output(&["spectrum", path.to_str().unwrap()], 2);
        let words = err.split(|c: char| c.is_whitespace() || c == '│').filter(|w| !w.is_empty()).collect::<Vec<_>>();
        assert!(words.join(" ").contains("which is over the limit"), "{text}: {err}");
    }
}

#[test]
fn rational_literals_have_certificates() {
    for text in ["Matrix([[0, 1], [1, 1/2]])", "{{0, 1//2}, {1, Rational(1, 3)}}", "2\n0 1//2\n1 0\n"] {
        let path = file("literal.txt", text);
        let certificate = path.with_extension("json");
        let paths = [path.to_str().unwrap(), certificate.to_str().unwrap()];
        output(&["spectrum", paths[0], "--certificate", paths[1]], 0);
        let written = std::fs::read_to_string(&certificate).unwrap();
        assert!(secant_check::check(text, &written).is_ok(), "{text}");
    }
    let (_, err) = output(&["spectrum", file("slashes.txt", "1\n1/2//3\n").to_str().unwrap()], 2);
    assert!(err.contains("use brackets"), "{err}");
}

#[test]
fn named_schemes_with_irrational_weights_have_spectra() {
    let (text, _) = output(&["schemes", "loop-original", "n=7"], 0);
    let (spectrum, _) = output(&["spectrum", file("field-loop7.txt", &text).to_str().unwrap()], 0);
    assert!(spectrum.contains("matrix of size 8 over Q(α), α = 2*cos(2*pi/7)"), "{spectrum}");
    let (text, _) = output(&["schemes", "db2"], 0);
    let case = file("db2.toml", &text);
    let (spectrum, _) = output(&["spectrum", case.to_str().unwrap()], 0);
    assert!(spectrum.contains("operator 1 of state") && spectrum.contains("1/4 + sqrt(3)/4"), "{spectrum}");
    let (text, err) = output(&["certify", case.to_str().unwrap()], 1);
    assert!(text.contains("in Q(α), α = sqrt(3)") && !err.contains("secant::certificate::none"), "{err}");
    for (args, needle) in [
        (&["schemes", "loop-original"][..], "needs the parameter `n`"),
        (&["schemes", "loop-original", "n=seven"], "whole number"),
        (&["schemes", "loop-original", "n=2"], "at least 3"),
        (&["schemes", "loop-original", "n=97"], "irrational"),
        (&["schemes", "loop-original", "m=7"], "no parameter `m`"),
        (&["schemes", "db2", "n=7"], "no parameters"),
    ] {
        let (_, err) = output(args, 2);
        assert!(err.contains(needle), "{args:?}: {err}");
    }
}

#[test]
fn bad_entries_are_told_with_their_place() {
    for (text, needle) in [
        ("2\n1 sqrt(-3)\n0 1\n", "2:3"),
        ("2\n1 2\n0 pi\n", "3:3"),
        ("1\nroot(x^3-x-1,2,3)\n", "0 real roots"),
        ("1\n1/(sqrt(2)^2-2)\n", "division by zero"),
        ("[[sqrt(2), sqrt(3)], [sqrt(5), sqrt(7)+sqrt(11)+sqrt(13)+sqrt(17)]]", "secant::matrix::limit"),
    ] {
        let path = file("field-bad.txt", text);
        let (_, err) = output(&["spectrum", path.to_str().unwrap()], 2);
        assert!(err.contains(needle), "{text}: {err}");
    }
}

/// Corner cutting (docs/theory.md §14) with `a` and `b`.
fn corner_cutting(a: &str, b: &str) -> String {
    cut([a, &format!("1-({a})"), b, &format!("1-({b})")])
}

fn cut([a, rest_a, b, rest_b]: [&str; 4]) -> String {
    format!(
        r#"name = "corner-cutting"
convention = "columns"
pieces = [
  [["{rest_a}", "{b}", 0], ["{a}", "{rest_b}", "{rest_a}"], [0, 0, "{a}"]],
  [["{b}", 0, 0], ["{rest_b}", "{rest_a}", "{b}"], [0, "{a}", "{rest_b}"]],
]
"#
    )
}

fn certified(text: &str) -> Box<Certified<Real>> {
    let question = Question::parse("case.toml", text).unwrap();
    match prove(&question, &Budget::default()).unwrap() {
        Findings::OverField { found, .. } => found,
        _ => panic!("a case over a number field"),
    }
}

fn verdict(found: &Certified<Real>, what: &Assertion) -> Verdict {
    found.claims.iter().find(|c| c.what == *what).map(Claim::verdict).unwrap()
}

/// The embedding is part of the number: of two conjugate parameters one is G¹, the other has corners.
#[test]
fn conjugate_parameters_have_verdicts_of_their_own() {
    for (a, g1) in [("(6-sqrt(2))/20", Verdict::Proved), ("(6+sqrt(2))/20", Verdict::Refuted)] {
        let found = certified(&corner_cutting(a, a));
        assert_eq!(verdict(&found, &Assertion::G1), g1, "{a}");
        assert_eq!(verdict(&found, &Assertion::DenseJoints), g1, "{a}");
        let same = found.points.iter().filter(|p| p.kind == Kind::Regular).count();
        assert_eq!(same, usize::from(g1 == Verdict::Proved), "{a}");
    }
    // Rational members on both sides have the verdicts of the irrational one between them.
    for (a, rest) in [("0.2292", "0.7708"), ("0.2293", "0.7707")] {
        let question = Question::parse("case.toml", &cut([a, rest, a, rest])).unwrap();
        let Findings::Tangents { found, .. } = prove(&question, &Budget::default()).unwrap() else {
            panic!("rational")
        };
        assert!(found.claims.iter().any(|c| c.what == Assertion::G1 && c.verdict() == Verdict::Proved));
    }
}

/// With `a = (3 − √5)/2` and `b = √5 − 2`, `c − a` is exactly 0: one Jordan block; a billionth further there is a corner.
#[test]
fn a_tie_in_the_field_is_exact() {
    let joint = |a: &str| {
        let found = certified(&corner_cutting(a, "sqrt(5)-2"));
        let joint = found.points.iter().find(|p| matches!(p.role, Role::Joint { .. })).unwrap();
        let blocks = joint.branches[1].spectrum.factors.iter().map(|f| f.blocks.clone()).max();
        (joint.kind, blocks.unwrap())
    };
    assert_eq!(joint("(3-sqrt(5))/2"), (Kind::Regular, vec![2]));
    assert_eq!(joint("(3-sqrt(5))/2+1e-9"), (Kind::Corner, vec![1]));
}

/// Cones over the field are what Theorem 6 asks for, by multiplication.
#[test]
fn cones_over_a_field_hold() {
    let text = corner_cutting("sqrt(5)-2", "sqrt(5)-2");
    let found = certified(&text);
    let case = Case::over_field("case.toml", &text).unwrap();
    let cones = found.cones.as_ref().unwrap();
    let rays = &cones.cones[0].rays;
    assert_eq!((rays.rank(), cones.maps.len()), (2, 2));
    for (map, piece) in cones.maps.iter().zip(&case.shape.states[0].pieces) {
        assert_eq!(&piece.op * rays, rays * &map.matrix);
        assert!(map.matrix.entries().iter().all(|x| x.sign() > 0));
    }
}

/// Koch's curve in true coordinates and in coordinates in which it is rational: the same kinds and dimensions, and the points are
/// images of one another.
#[test]
fn coordinates_do_not_matter() {
    let read = |path: &str| std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let found = certified(&read("cases/fields/koch-sqrt3.toml"));
    let question = Question::parse("koch-4.toml", &read("cases/classical/koch-4.toml")).unwrap();
    let Findings::Tangents { found: plain, .. } = prove(&question, &Budget::default()).unwrap() else {
        panic!("rational")
    };
    let root = &Real::read(&["sqrt(3)"]).unwrap()[0];
    assert_eq!(found.points.len(), plain.points.len());
    for (a, b) in found.points.iter().zip(&plain.points) {
        assert_eq!((a.kind, a.verdict, a.dimension), (b.kind, b.verdict, b.dimension));
        let (a, b) = (a.image.as_ref().unwrap(), b.image.as_ref().unwrap());
        assert_eq!((&a[0], &a[1]), (&Real::of(&b[0]), &root.times(&Real::of(&b[1]))));
    }
    assert_eq!(verdict(&found, &Assertion::SomePoint), Verdict::Refuted);
}

/// The tangents of db2's curve, as derived by hand: rays `(1, −2, 1)` and `(0, −1, 1)`, and a corner between.
#[test]
fn the_curve_of_db2() {
    let (text, _) = output(&["schemes", "db2"], 0);
    let found = certified(&text);
    let [start, finish, joint] = &found.points[..] else { panic!("two ends and a joint") };
    let decimals = |d: &Direction| d.to_f64();
    let near = |d: &[f64], wanted: &[f64]| {
        let norm = wanted.iter().map(|x| x * x).sum::<f64>().sqrt();
        d.iter().zip(wanted).all(|(a, b)| (a - b / norm).abs() < 1e-9)
    };
    assert!(near(&decimals(&start.right[0]), &[1.0, -2.0, 1.0]), "{:?}", start.right);
    let s = 3f64.sqrt();
    let left = [-1.0 - s, 2.0 * s, 1.0 - s];
    let mirrored: Vec<f64> = left.iter().rev().copied().collect();
    let ray = decimals(&joint.left[0]);
    assert!(near(&ray, &left) || near(&ray, &mirrored), "{ray:?}");
    assert_eq!((finish.kind, joint.kind), (Kind::SmoothEnd, Kind::Corner));
    let modulus = start.branches[0].spectrum.factors.iter().map(|f| f.roots[0].to_f64().0).fold(0.0, f64::max);
    assert!((-modulus.log2() - 0.550_016).abs() < 1e-5);
}

/// A certificate of a case over a field that the checker accepts, with the text that it is about.
fn proved_again(name: &str, text: &str) -> (String, String) {
    let mut findings = prove(&Question::parse(name, text).unwrap(), &Budget::default()).unwrap();
    let certificate = confirm(&mut findings).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(certificate.left_out().is_empty(), "{name}: {:?}", certificate.left_out());
    let Findings::OverField { case, found } = findings else { panic!("{name}: a case over a number field") };
    if found.claims.iter().any(|c| c.what == Assertion::G1 && c.verdict() == Verdict::Proved) {
        assert!(certificate.decides_every_point(Verdict::Proved), "{name}");
    }
    (case.checked_over_field().into_owned(), certificate.text())
}

/// Everything that is decided over a field is proved again by the checker with its own arithmetic.
#[test]
fn verdicts_over_fields_are_proved_again() {
    let root = format!("{}/cases/fields", env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for entry in std::fs::read_dir(root).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let (read, certificate) = proved_again(&path.display().to_string(), &text);
        // The file itself is checked, unless a scheme stands in it.
        assert_eq!(read == text, !text.contains("[scheme]"), "{}", path.display());
        assert!(secant_check::check(&read, &certificate).is_ok());
        count += 1;
    }
    assert!(count >= 7, "{count}");
    // Roots that do not lie in the field of the entries are not read: the operators are written out.
    let (flat, _) = proved_again("product.toml", &corner_cutting("sqrt(2)*sqrt(3)/10", "(6-sqrt(2)*sqrt(3))/20"));
    assert!(flat.contains("sqrt(6)") && !flat.contains("sqrt(3)"), "{flat}");
    // A field of degree 3, with cosines, and one that is given by a polynomial that is not monic.
    let (read, _) = proved_again("cosine.toml", &corner_cutting("cos(3*pi/7)", "cos(3*pi/7)^2*2"));
    assert!(read.contains("cos(3*pi/7)"));
    let (_, certificate) = proved_again("cubic.toml", &corner_cutting("root(3*x^3+x-1, 0, 1)/2", "1/4"));
    let written: Value = serde_json::from_str(&certificate).unwrap();
    let field = &written["proof"]["field"];
    assert!(field["polynomial"].as_array().unwrap().iter().all(|c| !c.as_str().unwrap().contains('/')), "{field}");
}

/// The certificate of a conjugate is not one of the number: of `(6 ± √2)/20` one is G¹, the other has corners.
#[test]
fn certificates_are_about_one_embedding() {
    let (smooth, rough) =
        (corner_cutting("(6-sqrt(2))/20", "(6-sqrt(2))/20"), corner_cutting("(6+sqrt(2))/20", "(6+sqrt(2))/20"));
    let (_, proved) = proved_again("case.toml", &smooth);
    let (_, refuted) = proved_again("case.toml", &rough);
    for (case, certificate) in [(&rough, &proved), (&smooth, &refuted)] {
        assert!(secant_check::check(case, certificate).is_err());
        // The conjugate generator, in which the root of 2 is the opposite.
        let mut forged: Value = serde_json::from_str(certificate).unwrap();
        let field = &mut forged["proof"]["field"];
        let turned: Vec<String> =
            (0..2usize).map(|k| format!("-{}", field["interval"][1 - k].as_str().unwrap())).collect();
        field["interval"] = turned.into();
        field["numbers"] = serde_json::json!([["0", "-1"]]);
        let rejected = secant_check::check(case, &forged.to_string()).unwrap_err();
        assert!(!rejected.unreadable, "{rejected}");
    }
}

#[test]
fn what_is_not_read_over_a_field_is_refused() {
    let (_, err) = output(&["certify", "cases/refused/irrational-entry.toml"], 2);
    assert!(err.contains("secant::case::irrational-entry"), "{err}");
    let svg = file("koch-sqrt3.svg", "");
    let (said, _) = output(&["render", "cases/fields/koch-sqrt3.toml", "--svg", svg.to_str().unwrap()], 0);
    assert!(said.contains("rounded points") && !said.contains("exact"), "{said}");
    output(&["render", "cases/fields/koch-sqrt3.toml", "--error", "1/100", "--svg", svg.to_str().unwrap()], 2);
}
