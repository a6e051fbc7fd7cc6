#![allow(clippy::float_arithmetic)] // values for comparison

use super::*;
use crate::arith::ratio;
use proptest::prelude::*;

fn read(texts: &[&str]) -> (NumberField, Vec<Elem>) {
    NumberField::read(texts).unwrap_or_else(|(k, e)| panic!("{}: {e}", texts[k]))
}

fn value(text: &str) -> f64 {
    let (field, x) = read(&[text]);
    field.to_f64(&x[0])
}

#[test]
fn expressions_have_their_values() {
    let near = |text: &str, x: f64| assert!((value(text) - x).abs() < 1e-12, "{text}: {} {x}", value(text));
    near("(1+sqrt(3))/4", (1.0 + 3f64.sqrt()) / 4.0);
    near("3/8 + cos(2*pi/7)/4", 0.375 + (std::f64::consts::TAU / 7.0).cos() / 4.0);
    near("root(x^3-x-1, 1, 2)", 1.324_717_957_244_746);
    near("Sqrt[5] - 2 Cos[2 Pi/7]", 5f64.sqrt() - 2.0 * (std::f64::consts::TAU / 7.0).cos());
    near("5**Rational(1,2)", 5f64.sqrt());
    near("2^(-1/3)", 2f64.powf(-1.0 / 3.0));
    near("cbrt(-2)", -(2f64.cbrt()));
    near("sin(pi/5)", (std::f64::consts::PI / 5.0).sin());
    near("sin(-7*pi/5)", (-1.4 * std::f64::consts::PI).sin());
    near("sqrt(2+sqrt(2))", (2.0 + 2f64.sqrt()).sqrt());
    near("CRootOf(x**3 - 3*x + 1, 0)", -1.879_385_241_571_816_9);
    near("Root[#^3 - 3 # + 1 &, 3]", 1.532_088_886_237_956);
    near("-2^2", -4.0);
    near("2(3+√5)/(π/π)", 2.0 * (3.0 + 5f64.sqrt()));
    near("golden_ratio^2 - GoldenRatio", 1.0);
    near("sqrt(2)*sqrt(3)*sqrt(6)", 6.0);
    near("sqrt(2)+sqrt(3)+sqrt(5)", 2f64.sqrt() + 3f64.sqrt() + 5f64.sqrt());
    near("cos(pi/9)*cbrt(2)", (std::f64::consts::PI / 9.0).cos() * 2f64.cbrt());
}

#[test]
fn every_cosine_is_the_right_root() {
    for n in 1..=24usize {
        for k in 0..2 * n {
            let x = cosine(k, n).to_f64().0;
            assert!((x - 2.0 * (std::f64::consts::TAU * k as f64 / n as f64).cos()).abs() < 1e-12, "{k}/{n}");
        }
        let text = format!("cos(2*pi/{n})");
        let degree = if n > 2 { named::cosine_degree(n) } else { 1 };
        assert_eq!(read(&[&text]).0.degree(), degree);
    }
}

#[test]
fn fields_are_as_small_as_they_can_be() {
    for (texts, degree) in [
        (&["sqrt(5)", "sqrt(20)", "golden_ratio", "cos(2*pi/5)"][..], 2),
        (&["sqrt(2)*sqrt(2)", "sqrt(4/9)"], 1),
        (&["cos(2*pi/7)", "cos(4*pi/7)", "cos(pi/7)", "sin(3*pi/14)"], 3),
        (&["sqrt(2)", "sqrt(3)", "sqrt(6)"], 4),
        (&["sqrt(2)+sqrt(3)", "5 - 2*sqrt(6)"], 4),
        (&["sqrt(6)", "sqrt(2)*sqrt(3)"], 2),
        (&["sqrt(5+2*sqrt(6))", "sqrt(2)"], 4),
        (&["cbrt(2)", "2^(2/3)", "root(x^3-2, 0, 2)"], 3),
        (&["root(x^2-x-1, 1, 2)"], 2),
        (&["cos(2*pi/16)", "sqrt(2)"], 4),
        (&["cos(2*pi/15)", "sqrt(5)"], 4),
    ] {
        let (field, elements) = read(texts);
        assert_eq!(field.degree(), degree, "{texts:?}");
        for (t, e) in texts.iter().zip(&elements) {
            assert!((field.to_f64(e) - value(t)).abs() < 1e-12, "{t}");
        }
    }
}

#[test]
fn relations_hold_exactly() {
    let (field, x) = read(&["sqrt(2)", "sqrt(3)", "sqrt(6)", "cos(2*pi/7)", "cos(6*pi/7)"]);
    assert_eq!(field.degree(), 12);
    assert_eq!(field.mul(&x[0], &x[1]), x[2]);
    // cos 3t = 4 cos^3 t - 3 cos t
    let cube = field.mul(&x[3], &field.mul(&x[3], &x[3]));
    assert_eq!(cube.scale(&ratio(4, 1)).sub(&x[3].scale(&ratio(3, 1))), x[4]);
    assert_eq!(field.cmp(&x[0], &x[1]), Ordering::Less);
    assert_eq!(field.sign(&x[4]), -1);
    assert_eq!(field.locate(&x[2]).minpoly().primitive_display("x"), "x^2 - 6");
}

#[test]
fn quadratic_fields_have_their_square_root() {
    let (field, x) = read(&["golden_ratio", "1/2 - sqrt(45)/4"]);
    assert_eq!(field.label(), Some("sqrt(5)"));
    assert_eq!(field.display(&x[0]), "1/2 + sqrt(5)/2");
    assert_eq!(field.display(&x[1]), "1/2 - 3*sqrt(5)/4");
    assert_eq!(field.describe(), "Q(α), α = sqrt(5) = 2.2360679775, root 2 of x^2 - 5");
}

#[test]
fn mistakes_are_told_with_their_place() {
    for (text, code, at) in [
        ("sqrt(-2)", "not-real", 0),
        ("1/(sqrt(2)^2-2)", "zero-denominator", 1),
        ("pi", "number", 0),
        ("1 + 2*x", "name", 6),
        ("cos(1)", "number", 0),
        ("sqrt(2", "syntax", 6),
        ("sqrt 2", "name", 0),
        ("", "number", 0),
        ("1 2", "syntax", 2),
        ("root(x^3-x-1, 2, 3)", "root", 0),
        ("root(x^3-3x+1, -2, 2)", "root", 0),
        ("root(x*y, 0, 1)", "root", 7),
        ("root(0, 0, 1)", "root", 0),
        ("root(x^1000-2, 0, 2)", "limit", 7),
        ("cos(2*pi/5000)", "limit", 0),
        ("2^(10^9)", "limit", 1),
        ("2^sqrt(2)", "number", 1),
        ("1/0", "zero-denominator", 1),
        ("NaN", "name", 0),
        ("1e99999", "number", 0),
    ] {
        let found = FieldBuilder::new().parse(text).expect_err(text);
        assert_eq!((found.code, found.at), (code, at), "{text}: {found}");
    }
    let deep = format!("{}1{}", "(".repeat(5000), ")".repeat(5000));
    assert_eq!(FieldBuilder::new().parse(&deep).expect_err("deep").code, "limit");
    let minus = format!("{}1", "-".repeat(5000));
    assert_eq!(FieldBuilder::new().parse(&minus).expect_err("deep").code, "limit");
    let many = (1..=12).map(|p| format!("sqrt({})", 2 * p + 1)).collect::<Vec<_>>().join("+");
    assert_eq!(FieldBuilder::new().parse(&many).expect_err("degree").code, "limit");
}

#[test]
fn constants_have_names() {
    let mut builder = FieldBuilder::new();
    builder.define("c", "cos(2*pi/7)").unwrap();
    let x = builder.parse("8c^3 + 4c^2 - 4c - 1").unwrap();
    assert_eq!(builder.is_rational(&x), Some(ratio(0, 1)));
    assert!(
        builder.define("c", "1").is_err() && builder.define("pi", "3").is_err() && builder.define("1a", "3").is_err()
    );
}

#[test]
fn matrices_over_a_field() {
    let (field, x) = read(&["sqrt(5)", "1", "2", "1-sqrt(5)", "3", "sqrt(5)/2", "5", "0", "2+sqrt(5)"]);
    let a = FieldMatrix::new(&field, 3, 3, x);
    let chi = a.char_poly();
    assert!(a.evaluate(&chi).is_zero());
    assert_eq!(chi.len(), 4);
    // The restriction of scalars has the norm as its characteristic polynomial.
    let conjugate: Vec<Elem> = chi.iter().map(|c| Elem(Poly::new(vec![c.0.coeff(0), -c.0.coeff(1)]))).collect();
    let f = field.poly();
    let mut norm = vec![Elem::zero(); 7];
    for (i, p) in chi.iter().enumerate() {
        for (j, q) in conjugate.iter().enumerate() {
            norm[i + j] = norm[i + j].add(&p.mul(q, f));
        }
    }
    let norm: Vec<Rational> = norm.iter().map(|c| c.is_rational().unwrap()).collect();
    assert_eq!(crate::linalg::char_poly(&a.restricted()), Poly::new(norm));
    let singular = FieldMatrix::from_fn(&field, 3, 3, |i, j| a[(i.min(1), j)].clone());
    let kernel = singular.kernel();
    assert_eq!((singular.rank(), kernel.cols()), (2, 1));
    assert!(singular.mul(&kernel).is_zero());
    assert_eq!(singular.apply(&kernel.column(0)), vec![Elem::zero(); 3]);
}

#[test]
fn expressions_of_elements_are_read_back() {
    for texts in [
        &["sqrt(5)", "1/2-3*sqrt(5)/4", "-sqrt(5)"][..],
        &["cos(2*pi/7)", "3/8-cos(4*pi/7)^2/5", "2*cos(6*pi/7)"],
        &["cos(2*pi/16)", "sqrt(2)/3"],
        &["sqrt(2)+sqrt(3)", "sqrt(6)/2-1"],
        &["root(x^3-x-1, 1, 2)^2/3", "root(x^3-x-1, 1, 2)"],
    ] {
        let (field, x) = read(texts);
        let written: Vec<String> = x.iter().map(|e| field.expression(e)).collect();
        assert!(written.iter().all(|t| !t.contains(' ')));
        let all: Vec<&str> = texts.iter().copied().chain(written.iter().map(String::as_str)).collect();
        let (_, both) = read(&all);
        let (given, again) = both.split_at(texts.len());
        assert_eq!(given, again, "{texts:?} {written:?}");
    }
    assert_eq!(read(&["3/8-cos(4*pi/7)/4"]).0.degree(), 3);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_tokens_never_panic(
        tokens in prop::collection::vec(
            prop::sample::select(vec![
                "sqrt(", "Sqrt[", "cbrt(", "cos(", "pi", "root(x^2-2,", "CRootOf(", "x", "#", "&", "2", "3", "0", "1/2", "-", "+",
                "*", "/", "^", "**", "(", ")", "]", ",", " ", "√", "π", "é", "1e9", "golden_ratio",
            ]),
            0..12,
        )
    ) {
        let _ = FieldBuilder::new().parse(&tokens.concat());
    }

    /// `(a + b sqrt p)(c + d sqrt q)` is what the four products add up to, and its sign that of its value.
    #[test]
    fn products_and_signs(a in -9i64..9, b in -9i64..9, c in -9i64..9, d in -9i64..9, p in 2i64..12, q in 2i64..12) {
        let mut builder = FieldBuilder::new();
        let whole = builder.parse(&format!("({a}+({b})*sqrt({p}))*({c}+({d})*sqrt({q}))")).unwrap();
        let text = format!("{}+({})*sqrt({p})+({})*sqrt({q})+({})*sqrt({})", a * c, b * c, a * d, b * d, p * q);
        let parts = builder.parse(&text).unwrap();
        prop_assert_eq!(builder.sign(&builder.sub(&whole, &parts)), 0);
        let value = (a as f64 + b as f64 * (p as f64).sqrt()) * (c as f64 + d as f64 * (q as f64).sqrt());
        if value.abs() > 1e-9 {
            prop_assert_eq!(f64::from(builder.sign(&whole)), value.signum());
        }
    }
}
