//! Spectra over real number fields against SymPy, and `secant spectrum` on files with irrational entries.

use assert_cmd::Command;
use secant::algebraic::Elem;
use secant::case::matrix_file::parse_field;
use secant::jordan::FieldSpectrum;
use secant::scheme::{field_local_matrix, mesh_rule};
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
    let (_, err) = output(&["certify", case.to_str().unwrap()], 2);
    assert!(err.contains("secant::case::irrational-entry") && err.contains("secant spectrum"), "{err}");
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
