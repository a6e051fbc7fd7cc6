//! Rational matrices as text: `n` and `n` rows, or rows in nested brackets as computer algebra systems write them.

use crate::base::number::decimal_fraction;
use crate::base::{Checked, Matrix, Q, some};
use num_traits::ToPrimitive;

/// Largest matrix of a file.
const MAX_SIZE: usize = 256;
/// What may stand before the rows of a literal.
const NAMES: [&str; 6] = ["", "matrix(", "Matrix(", "ImmutableMatrix(", "matrix(QQ,", "Matrix(QQ,"];

/// Reads a square matrix of size 1 to 256: plain text, or a literal such as `Matrix([[0, 1], [1, 1/2]])`.
pub(crate) fn matrix(source: &str) -> Checked<Matrix> {
    let uncommented = |line| match str::split_once(line, '#') {
        Some((before, _)) => before,
        None => line,
    };
    let text: Vec<&str> = source.lines().map(uncommented).collect();
    let text = text.join("\n");
    if text.contains(['[', '{']) {
        let rows = nested(&text).filter(|rows| rows.iter().all(|row| row.len() == rows.len()));
        let rows = some(rows, "matrix", "rows of exact numbers in brackets are needed, as many as they are long")?;
        return Ok(Matrix::new(rows.len(), rows.len(), &rows.concat()));
    }
    let mut words = text.split_ascii_whitespace().take(MAX_SIZE * MAX_SIZE + 2).map(rational);
    let size = words.next().flatten().and_then(|n| if n.is_integer() { n.numer().to_usize() } else { None });
    let n = some(size.filter(|n| (1..=MAX_SIZE).contains(n)), "matrix", "the size of a matrix is needed first")?;
    let entries = words.collect::<Option<Vec<Q>>>().filter(|entries| entries.len() == n * n);
    Ok(Matrix::new(n, n, &some(entries, "matrix", "n rows of n exact numbers are needed after the size")?))
}

/// `1/2`, `-0.25`, `1//2`, `Rational(1, 2)`.
fn rational(text: &str) -> Option<Q> {
    let text = text.trim();
    if let Some(inside) = text.strip_prefix("Rational(").and_then(|t| t.strip_suffix(')')) {
        let (p, q) = inside.split_once(',')?;
        return (!inside.contains('/')).then(|| decimal_fraction(&format!("{p}/{q}"))).flatten();
    }
    decimal_fraction(&text.replacen("//", "/", 1))
}

/// The rows of `[[a, b], [c, d]]` or `{{a, b}, {c, d}}`, in a call or not.
fn nested(text: &str) -> Option<Vec<Vec<Q>>> {
    let start = text.find(['[', '{'])?;
    let call: String = text[..start].chars().filter(|c| !c.is_whitespace()).collect();
    let (open, close) = if text[start..].starts_with('[') { ('[', ']') } else { ('{', '}') };
    let body = text[start..].trim_end().trim_end_matches(';').trim_end();
    let body = if call.is_empty() { body } else { body.strip_suffix(')')?.trim_end() };
    if !NAMES.contains(&call.as_str()) {
        return None;
    }
    let mut rest = body.strip_prefix(open)?.strip_suffix(close)?.trim();
    let mut rows = Vec::new();
    while rows.len() <= MAX_SIZE {
        let (row, after) = rest.strip_prefix(open)?.split_once(close)?;
        rows.push(entries(row)?);
        rest = after.trim_start();
        if rest.is_empty() {
            return Some(rows);
        }
        rest = rest.strip_prefix(',')?.trim_start();
    }
    None
}

/// The numbers of a row, separated by the commas outside of round brackets.
fn entries(row: &str) -> Option<Vec<Q>> {
    let mut depth = 0usize;
    let outside = |c: char| {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        c == ',' && depth == 0
    };
    let words: Vec<&str> = row.split(outside).collect();
    (words.len() <= MAX_SIZE).then(|| words.into_iter().map(rational).collect()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(text: &str, i: usize, j: usize) -> Option<Q> {
        matrix(text).ok().map(|m| m.at(i, j))
    }

    #[test]
    fn one_matrix_in_every_notation() {
        let half = Some(Q::new(1.into(), 2.into()));
        for text in [
            "2\n0 1\n1 1/2 # half\n",
            "2 0 1 1 1//2",
            "Matrix([[0, 1], [1, 1/2]])",
            "Matrix([\n[0, 1],\n[1, Rational(1, 2)]])\n",
            "matrix(QQ, [[0, 1], [1, 0.5]])",
            "{{0, 1}, {1, 1/2}};",
            "[[0,1],[1,1//2]]",
        ] {
            assert_eq!(entry(text, 1, 1), half, "{text}");
            assert_eq!(entry(text, 0, 1), Some(Q::from_integer(1.into())), "{text}");
        }
    }

    #[test]
    fn what_is_no_square_matrix_of_rationals_is_refused() {
        for text in [
            "",
            "0",
            "2 1 2 3",
            "2 1 2 3 4 5",
            "[[1, 2], [3]]",
            "[[1, 2]]",
            "[[]]",
            "[]",
            "[[1], [2]",
            "[[1]] [[2]]",
            "[[1]],",
            "f([[1]])",
            "Matrix([[1]]",
            "[[1]])",
            "[[sqrt(2)]]",
            "[[Rational(1, 2, 3)]]",
            "[[Rational(1/2, 3)]]",
            "[[1///2]]",
            "{[1]}",
            "[[[1]]]",
            "Matrix([[1]]).T",
            "[[1 2], [3 4]]",
            "-[[1]]",
        ] {
            assert!(matrix(text).is_err(), "{text}");
        }
    }
}
