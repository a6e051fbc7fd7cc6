//! Notations that are rewritten as nested brackets before they are read: rows of plain numbers (NumPy's `savetxt`, CSV), what
//! NumPy prints, strings of JSON, `SymPy`'s `srepr`, LaTeX.

use super::Mistake;

/// The text as nested brackets; `None` where it is in none of these notations.
///
/// # Errors
/// What cannot be rewritten, at the place where it stands in the text.
pub(super) fn rewritten(text: &str) -> Result<Option<String>, Mistake> {
    let start = text.trim_start();
    if text.contains("\\begin{") || text.contains("\\frac") {
        return latex(text).map(Some);
    }
    if start.contains("DenseMatrix(") || start.contains("Rational(") && start.contains("Integer(") {
        return srepr(text).map(Some);
    }
    if start.starts_with("[[") && !text.contains([',', ';']) {
        return printed(text).map(Some);
    }
    if start.starts_with('[') && text.contains('"') {
        // Byte for byte, so that places stay.
        return Ok(Some(text.replace('"', " ")));
    }
    Ok(rows(text))
}

fn nested(rows: &[Vec<String>]) -> String {
    let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", row.join(", "))).collect();
    format!("[{}]", rows.join(",\n "))
}

/// `0.` is written by NumPy for 0.
fn finished(word: &str) -> String {
    word.strip_suffix('.').map_or_else(|| word.to_owned(), |head| format!("{head}.0"))
}

/// One row on each line, entries separated by blanks, commas or semicolons.
fn rows(text: &str) -> Option<String> {
    if text.contains(['[', '{', '(', '%']) {
        return None;
    }
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or_default());
    let words = |line: &str| -> Vec<String> {
        line.split([',', ';', ' ', '\t', '\r'])
            .filter(|w| !w.is_empty())
            .map(|w| finished(w.trim_matches('"')))
            .collect()
    };
    let rows: Vec<Vec<String>> = lines.map(words).filter(|row| !row.is_empty()).collect();
    let number = |w: &String| w.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
    let width = rows.first()?.len();
    let numbers = rows.iter().flatten().all(number) && rows.iter().all(|row| row.len() == width);
    // A size and then the rows is the plain format; so is a single number.
    let square = rows.len() >= 2 && width == rows.len();
    let sized = rows.first().and_then(|row| row.first()).is_some_and(|w| w.bytes().all(|b| b.is_ascii_digit()));
    (numbers && rows.len() >= 2 && (square || width > 1 && !sized)).then(|| nested(&rows))
}

/// What `print` of NumPy writes: brackets, and blanks between the entries.
fn printed(text: &str) -> Result<String, Mistake> {
    if let Some(at) = text.find("...") {
        return Err(Mistake::new("syntax", at, "NumPy has left entries out here")
            .help("print the whole array: numpy.set_printoptions(threshold=numpy.inf), or use numpy.savetxt or repr"));
    }
    let inner = text.trim().strip_prefix('[').and_then(|t| t.strip_suffix(']'));
    let inner = inner.ok_or_else(|| Mistake::new("syntax", text.len(), "the last bracket is missing"))?;
    let mut found = Vec::new();
    for row in inner.split(']').map(str::trim).filter(|row| !row.is_empty()) {
        let Some(row) = row.strip_prefix('[') else {
            return Err(Mistake::new("syntax", 0, "a row in brackets is expected")
                .help("write commas between the rows and between the entries"));
        };
        found.push(row.split_whitespace().map(finished).collect());
    }
    Ok(nested(&found))
}

/// The bracket that closes the one at a place.
fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (k, c) in text[open..].char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(open + k);
        }
    }
    None
}

/// Commas outside of brackets.
fn arguments(text: &str) -> Vec<&str> {
    let (mut depth, mut from, mut out) = (0_usize, 0, Vec::new());
    for (k, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                out.push(&text[from..k]);
                from = k + 1;
            }
            _ => {}
        }
    }
    out.push(&text[from..]);
    out
}

/// Deepest nesting of calls.
const MAX_DEPTH: usize = 64;

/// `MutableDenseMatrix([[Rational(1, 2), …], …])`: the list of the matrix, with calls written as operations.
fn srepr(text: &str) -> Result<String, Mistake> {
    let open = text.find('[').ok_or_else(|| Mistake::new("format", 0, "there is no list of rows"))?;
    let close = closing(text, open).ok_or_else(|| Mistake::new("syntax", open, "this bracket is not closed"))?;
    called(&text[open..=close], open, 0)
}

/// A part of `srepr` output as an ordinary expression; `at` is where it stands.
fn called(text: &str, at: usize, depth: usize) -> Result<String, Mistake> {
    if depth > MAX_DEPTH {
        return Err(Mistake::new("limit", at, "calls are nested too deeply"));
    }
    let (mut out, mut k) = (String::new(), 0);
    while let Some(c) = text[k..].chars().next() {
        if !c.is_ascii_alphabetic() {
            out.push(c);
            k += c.len_utf8();
            continue;
        }
        let name: &str = text[k..].split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
        let open = k + name.len();
        if !text[open..].starts_with('(') {
            out.push_str(name);
            k = open;
            continue;
        }
        let close =
            closing(text, open).ok_or_else(|| Mistake::new("syntax", at + open, "this bracket is not closed"))?;
        let inner = called(&text[open + 1..close], at + open + 1, depth + 1)?;
        let parts: Vec<&str> = arguments(&inner).into_iter().map(str::trim).collect();
        let joined = |sign: &str| parts.iter().map(|p| format!("({p})")).collect::<Vec<_>>().join(sign);
        out.push_str(&match (name, parts.as_slice()) {
            ("Integer", [n]) => (*n).to_owned(),
            ("Float", [digits, ..]) => digits.trim_matches('\'').to_owned(),
            ("Add", _) => format!("({})", joined("+")),
            ("Mul", _) => format!("({})", joined("*")),
            ("Pow", [base, exponent]) => format!("(({base})^({exponent}))"),
            ("Rational", [p, q]) => format!("(({p})/({q}))"),
            ("Symbol", _) => {
                return Err(Mistake::new("number", at + k, "a symbol has no value")
                    .help("put numbers for the symbols first, as in matrix.subs(w, Rational(1, 16))"));
            }
            _ => format!("{name}({inner})"),
        });
        k = close + 1;
    }
    Ok(out)
}

/// A matrix of LaTeX: `&` between the entries, `\\` between the rows.
fn latex(text: &str) -> Result<String, Mistake> {
    let Some(begin) = text.find("\\begin{") else {
        return Err(
            Mistake::new("format", 0, "there is no \\begin{bmatrix} here").help("a matrix of LaTeX begins with it")
        );
    };
    // \left[\begin{matrix} … \end{matrix}\right], with the columns of an array in braces.
    let after = begin + text[begin..].find('}').map_or(0, |k| k + 1);
    let end = text[after..].find("\\end{").map_or(text.len(), |k| after + k);
    let mut body = &text[after..end];
    if text[begin..].starts_with("\\begin{array}") {
        body = body.trim_start();
        body = body.find('}').filter(|_| body.starts_with('{')).map_or(body, |k| &body[k + 1..]);
    }
    let rows = body.split("\\\\").filter(|row| !row.trim().is_empty());
    let rows: Result<Vec<Vec<String>>, Mistake> =
        rows.map(|row| row.split('&').map(|cell| in_latex(cell.trim(), begin, 0)).collect()).collect();
    Ok(nested(&rows?))
}

/// One entry of LaTeX as an ordinary expression.
fn in_latex(cell: &str, at: usize, depth: usize) -> Result<String, Mistake> {
    if depth > MAX_DEPTH {
        return Err(Mistake::new("limit", at, "commands are nested too deeply"));
    }
    let (mut out, mut k) = (String::new(), 0);
    let group = |from: usize| -> Result<(String, usize), Mistake> {
        let open = from + cell[from..].len() - cell[from..].trim_start().len();
        let wrong = || Mistake::new("syntax", at, format!("braces are expected in {cell}"));
        if !cell[open..].starts_with('{') {
            // \frac12
            let one = cell[open..].chars().next().filter(char::is_ascii_digit).ok_or_else(wrong)?;
            return Ok((one.to_string(), open + 1));
        }
        let close = closing(cell, open).ok_or_else(wrong)?;
        Ok((in_latex(&cell[open + 1..close], at, depth + 1)?, close + 1))
    };
    while let Some(c) = cell[k..].chars().next() {
        if c != '\\' {
            out.push(match c {
                '{' => '(',
                '}' => ')',
                other => other,
            });
            k += c.len_utf8();
            continue;
        }
        let name: String = cell[k + 1..].chars().take_while(char::is_ascii_alphabetic).collect();
        k += 1 + name.len();
        match name.as_str() {
            "frac" | "dfrac" | "tfrac" => {
                let (top, next) = group(k)?;
                let (bottom, next) = group(next)?;
                out.push_str(&format!("(({top})/({bottom}))"));
                k = next;
            }
            "sqrt" => {
                let mut degree = "2".to_owned();
                if let Some(close) = cell[k..].find(']').filter(|_| cell[k..].starts_with('[')) {
                    degree = cell[k + 1..k + close].to_owned();
                    k += close + 1;
                }
                let (inner, next) = group(k)?;
                out.push_str(&format!("(({inner})^(1/({degree})))"));
                k = next;
            }
            "cdot" | "times" => out.push('*'),
            "left" | "right" | "displaystyle" | "quad" => {}
            // Spaces such as `\,` and a backslash before a blank, also the blank behind the entry.
            "" if cell[k..].is_empty() => {}
            "" if cell[k..].starts_with([',', ';', ':', '!', ' ']) => k += 1,
            "pi" | "cos" | "sin" => out.push_str(&name),
            _ => {
                return Err(Mistake::new("number", at, format!("`\\{name}` is not read in an entry"))
                    .help("entries are numbers with \\frac, \\sqrt, \\cdot, \\cos and \\pi"));
            }
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use crate::case::matrix_file::{Format, parse_field};

    /// The entries as the field writes them.
    fn entries(text: &str) -> Vec<String> {
        let file = parse_field("m", text).unwrap_or_else(|p| panic!("{text}: {}", p.message()));
        let (m, field) = (&file.matrix, file.matrix.field());
        (0..2).flat_map(|i| (0..2).map(move |j| (i, j))).map(|k| field.expression(&m[k])).collect()
    }

    #[test]
    fn one_matrix_in_many_notations() {
        for text in [
            "5.000e-01 2.500e-01\n5.0e-1 7.5e-01\n",
            "0.5,0.25\n0.5,0.75\n",
            "0.5;0.25\r\n0.5;0.75\r\n",
            "[[0.5  0.25]\n [0.5  0.75]]",
            "[[\"1/2\", \"1/4\"], [\"1/2\", \"3/4\"]]",
            "MutableDenseMatrix([[Rational(1, 2), Rational(1, 4)], [Rational(1, 2), Add(Integer(1), Rational(-1, 4))]])",
            "\\left[\\begin{matrix}\\frac{1}{2} & \\frac{1}{4}\\\\ \\tfrac12 & 1 - \\frac{1}{4}\\end{matrix}\\right]",
            "\\begin{array}{cc} 0.5 & \\frac14 \\\\ 0.5 & \\frac34 \\end{array}",
            "[1//2 1//4; 1//2 3//4]",
        ] {
            assert_eq!(entries(text), ["1/2", "1/4", "1/2", "3/4"], "{text}");
        }
        assert_eq!(entries("[[1. 0.]\n [0. 1.]]"), ["1", "0", "0", "1"]);
    }

    #[test]
    fn roots_keep_their_value() {
        let root = "sqrt(2)";
        for text in [
            "ImmutableDenseMatrix([[Pow(Integer(2), Rational(1, 2)), Integer(0)], [Integer(0), Mul(Integer(2), Pow(Integer(2), Rational(-1, 2)))]])",
            "\\begin{bmatrix} \\sqrt{2} & 0 \\\\ 0 & \\frac{2}{\\sqrt{2}} \\end{bmatrix}",
        ] {
            assert_eq!(entries(text), entries(&format!("[[{root}, 0], [0, {root}]]")), "{text}");
        }
    }

    #[test]
    fn the_plain_format_stays() {
        for text in ["2\n1 0\n0 1\n", "2 1 0\n0 1", "# a comment\n2\n1/2 0\n0 1"] {
            assert_eq!(parse_field("m", text).map(|f| f.format).ok(), Some(Format::Plain), "{text}");
        }
    }

    #[test]
    fn what_cannot_be_read_says_why() {
        let problem = |text: &str| parse_field("m", text).err().map(|p| p.message().to_owned()).unwrap_or_default();
        for entry in ["1\\5", "\\é", "1\\\u{0}"] {
            let text = format!("\\begin{{matrix}} {entry} & 0 \\\\ 0 & 1 \\end{{matrix}}");
            assert!(problem(&text).contains("is not read in an entry"), "{text}");
        }
        assert!(problem("[[1. ... 0.]\n [0. ... 1.]]").contains("left entries out"));
        assert!(problem("Matrix([[Symbol('w'), Integer(0)], [Integer(0), Rational(1, 2)]])").contains("symbol"));
        assert!(problem("\\begin{bmatrix} \\alpha & 0 \\\\ 0 & 1 \\end{bmatrix}").contains("alpha"));
        assert!(!problem("1 2 3\n4 5 6\n").is_empty());
        assert!(problem("0.5 1\n0.5 1\n0.5 1\n").contains("not square"));
    }
}
