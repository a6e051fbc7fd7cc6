use super::*;
use crate::arith::ratio;
use proptest::prelude::*;

fn sample() -> Matrix {
    Matrix::from_fn(2, 2, |i, j| [[ratio(1, 2), ratio(-3, 1)], [ratio(0, 1), ratio(1, 4)]][i][j].clone())
}

#[test]
fn every_notation_gives_the_same_matrix() {
    for (text, format) in [
        ("2\n1/2 -3\n0 1/4\n", Format::Plain),
        ("# a comment\n2 1/2 -3 0 0.25 # the end", Format::Plain),
        ("%%MatrixMarket matrix array integer general\n% denominator: 4\n2 2\n2\n0\n-12\n1\n", Format::MatrixMarket),
        ("%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 0.5\n1 2 -3\n2 2 0.25\n", Format::MatrixMarket),
        ("matrix(QQ, [[1/2, -3], [0, 1/4]])", Format::NestedBrackets),
        ("A = matrix(QQ, 2, 2, [1/2, -3, 0, 1/4])", Format::Flat),
        ("matrix(QQ, 2, [1/2, -3, 0, 1/4])", Format::Flat),
        ("{{1/2, -3}, {0, 1/4}}", Format::NestedBraces),
        ("Matrix([[Rational(1, 2), -3], [0, S(1)/4]])", Format::NestedBrackets),
        ("A = [1/2 -3; 0 1/4];", Format::Semicolons),
        ("[1/2, -3\n 0, 0.25]", Format::Semicolons),
        ("[1/2 ... first\n -3; 0 1/4]", Format::Semicolons),
    ] {
        let found = parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        assert_eq!((&found.matrix, found.format), (&sample(), format), "{text}");
        assert_eq!(found.decimals > 0, text.contains("0."), "{text}");
    }
}

#[test]
fn mistakes_are_told() {
    for (text, code) in [
        ("", "format"),
        ("2\n1 2 3", "short"),
        ("2\n1 2 3 4 5", "long"),
        ("2\n1 2 3 NaN", "number"),
        ("5000\n", "limit"),
        ("99999999999999999999999\n1", "size"),
        ("[[1, 2], [3]]", "square"),
        ("[[1, 2, 3], [4, 5, 6]]", "square"),
        ("[[1, nan], [0, 1]]", "number"),
        ("[[1, 1/0], [0, 1]]", "number"),
        ("[[1, 2], [3, 4]", "syntax"),
        ("[[1, 2], [3, 4]] x", "syntax"),
        ("hello", "format"),
        ("%%MatrixMarket matrix array complex general\n1 1\n1 0", "market"),
        ("%%MatrixMarket matrix coordinate integer general\n2 2 1\n3 1 5", "market"),
    ] {
        let problem = parse(text).err().unwrap_or_else(|| panic!("{text} was read"));
        assert_eq!(problem.id(), format!("secant::matrix::{code}"), "{text}");
    }
    let long = format!("1\n{}", "7".repeat(1_000_000));
    assert_eq!(parse(&long).unwrap_err().id(), "secant::matrix::number");
    let deep = format!("[[{}1{}]]", "(".repeat(5_000), ")".repeat(5_000));
    assert_eq!(parse(&deep).unwrap_err().id(), "secant::matrix::limit");
}

#[test]
fn every_notation_reads_algebraic_numbers() {
    let mut seen = Vec::new();
    for text in [
        "2\nsqrt(5) cos(2*pi/5)\n0 (1 + 1)/4 # the end\n",
        "2 sqrt( 5 ) (sqrt(5)-1)/4 0 1/2",
        "Matrix([[sqrt(5), cos(2*pi/5)], [0, Rational(1, 2)]])",
        "Matrix([[5**Rational(1, 2), -S(1)/4 + sqrt(5)/4], [0, S(1)/2]])",
        "{{Sqrt[5], Cos[2 Pi/5]}, {0, 1/2}}",
        "{{Sqrt[5], (-1 + Sqrt[5])/4}, {0, 1/2}}",
        "{{Root[#^2 - 5 &, 2], Sin[Pi/10]}, {0, 1/2}}",
        "matrix(AA, [[sqrt(5), cos(2*pi/5)], [0, 1/2]])",
        "matrix(AA, 2, 2, [sqrt(5), 1/4*sqrt(5) - 1/4, 0, 1/2])",
        "A = [sqrt(5) cos(2*pi/5); 0 1/2];",
    ] {
        let found = parse_field("matrix", text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        assert_eq!(found.matrix.field().label(), Some("sqrt(5)"), "{text}");
        seen.push(found.matrix);
    }
    assert!(seen.windows(2).all(|w| w[0].same(&w[1])));
    assert_eq!(parse("2 sqrt(5) 1 1 1").unwrap_err().id(), "secant::matrix::irrational");
    assert_eq!(parse("2 sqrt(4) 1 1 1").unwrap().matrix[(0, 0)], ratio(2, 1));
    for (text, code) in [
        ("2 sqrt(-1) 1 1 1", "number"),
        ("2 sqrt (5) 1 1 1", "number"),
        ("2 pi 1 1 1", "number"),
        ("2 1, 2 3 4", "number"),
        ("[[1, sqrt(2], [0, 1]]", "syntax"),
        ("1 cos(2*pi/997)", "limit"),
    ] {
        assert_eq!(parse_field("matrix", text).unwrap_err().id(), format!("secant::matrix::{code}"), "{text}");
    }
}

proptest! {
    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,80}") {
        let _ = parse(&text);
    }

    #[test]
    fn arbitrary_tokens_never_panic(
        tokens in prop::collection::vec(
            prop::sample::select(vec![
                "[", "]", "{", "}", "(", ")", ",", ";", "\n", " ", "1", "2", "-", "+", "/", "*", "0", ".5", "1e3", "1e99999",
                "Rational", "matrix(QQ, 2, ", "%%MatrixMarket matrix array integer general\n", "%", "#", "...", "é",
                "denominator: 0", "S(", "sqrt(", "Sqrt[2]", "cos(", "pi", "root(x^2-", "^", "Root[#", "&", "√",
            ]),
            0..30,
        )
    ) {
        let _ = parse(&tokens.concat());
    }

    #[test]
    fn plain_text_comes_back(n in 0usize..5, seed in any::<u64>()) {
        let entry = |i: usize, j: usize| ratio((seed >> (i + 5 * j)) as i64 % 97 - 48, 1 + (seed >> 7) as i64 % 9);
        let a = Matrix::from_fn(n, n, entry);
        let rows: Vec<String> = (0..n).map(|i| a.row(i).iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")).collect();
        prop_assert_eq!(parse(&format!("{n}\n{}\n", rows.join("\n"))).unwrap().matrix, a);
    }
}
