//! Matrices in the formats of other programs, as exact rationals.
//!
//! * plain text: `n`, then `n` rows of numbers; `#` starts a comment;
//! * `MatrixMarket` (`array` or `coordinate`; `integer` or `real`; `general`, `symmetric` or `skew-symmetric`), with an
//!   optional comment `% denominator: 64` that divides every entry;
//! * literals: `matrix(QQ, [[1/2, 0], [0, 1]])` and `matrix(QQ, 2, 2, [...])` of `SageMath`, `{{1/2, 0}, {0, 1}}` of
//!   Mathematica, `Matrix([[Rational(1, 2), 0], [0, 1]])` of `SymPy`, `[1/2 0; 0 1]` of MATLAB;
//! * rows of plain numbers (NumPy's `savetxt`, CSV), what NumPy prints, `SymPy`'s `srepr`, strings in JSON, LaTeX.
//!
//! Decimals are read exactly: `0.1` is 1/10. [`MatrixFile::decimals`] counts them, so that the user can be told.
//!
//! Entries of plain text and of literals may be real algebraic numbers, such as `sqrt(5)`, `Cos[2 Pi/7]`, `2^(1/3)` or
//! `root(x^3 - x - 1, 1, 2)` (see [`crate::algebraic::field`]); [`parse_field`] reads them.

mod entry;
mod foreign;
mod literal;
mod market;

use crate::algebraic::field::{Expression, ExpressionError, FieldBuilder, FieldMatrix, Number};
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Matrix;
use malachite_base::num::logic::traits::SignificantBits;

/// Largest file that is read, in bytes.
pub const MAX_FILE_BYTES: usize = 16 << 20;
/// Largest number of rows and columns.
pub const MAX_SIZE: usize = 1_000;
/// Largest size of all numbers together, in bits.
pub const MAX_BITS: u64 = 1 << 28;

/// The notations that are understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// `n`, then the rows.
    Plain,
    /// NIST's exchange format.
    MatrixMarket,
    /// Rows in nested brackets, as in `SageMath` and `SymPy`.
    NestedBrackets,
    /// Rows in nested braces, as in Mathematica.
    NestedBraces,
    /// Rows separated by semicolons, as in MATLAB.
    Semicolons,
    /// Sizes and one list of entries, as in `matrix(QQ, 2, 2, [...])`.
    Flat,
    /// A notation that was rewritten as nested brackets: rows of plain numbers, NumPy's print, JSON strings, `srepr`, LaTeX.
    Rewritten,
}

/// A square matrix that was read.
#[derive(Debug, Clone)]
pub struct MatrixFile {
    /// The matrix.
    pub matrix: Matrix,
    /// How it was written.
    pub format: Format,
    /// How many entries were decimals, which were taken exactly.
    pub decimals: usize,
}

/// A square matrix that was read, with entries in a real number field.
#[derive(Debug, Clone)]
pub struct FieldFile {
    /// The matrix, over the smallest field of its entries.
    pub matrix: FieldMatrix,
    /// How it was written.
    pub format: Format,
    /// How many numbers were decimals, which were taken exactly.
    pub decimals: usize,
}

/// What is wrong with a text, and where.
#[derive(Debug)]
struct Mistake {
    code: &'static str,
    message: String,
    at: usize,
    help: Option<String>,
}

impl Mistake {
    fn new(code: &'static str, at: usize, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), at, help: None }
    }

    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl From<ExpressionError> for Mistake {
    fn from(error: ExpressionError) -> Self {
        let code = match error.code {
            "syntax" => "syntax",
            "limit" => "limit",
            _ => "number",
        };
        Self { code, message: error.message, at: error.at, help: error.help }
    }
}

/// Rows of exact numbers, with the number of decimals among them.
struct Rows {
    rows: Vec<Vec<Number>>,
    builder: FieldBuilder,
    format: Format,
    decimals: usize,
}

/// Reads a square matrix in any of the formats.
///
/// # Errors
/// A [`Problem`] with the place of the mistake: not a matrix, ragged or not square, too large, numbers that are none.
pub fn parse(text: &str) -> Result<MatrixFile, Problem> {
    parse_named("matrix", text)
}

/// The same as [`parse`], for a file whose name the messages show.
///
/// # Errors
/// As [`parse`]; a matrix with irrational entries is one of them.
pub fn parse_named(name: &str, text: &str) -> Result<MatrixFile, Problem> {
    let FieldFile { matrix, format, decimals } = parse_field(name, text)?;
    let field = matrix.field().describe();
    let matrix = matrix.rational().ok_or_else(|| {
        Problem::new("secant::matrix::irrational", format!("{name} has entries in {field}, not rational ones"))
            .with_help("`secant spectrum` and `parse_field` read such matrices")
    })?;
    Ok(MatrixFile { matrix, format, decimals })
}

/// Reads a square matrix in any of the formats, with entries in a real number field.
///
/// # Errors
/// As [`parse`]; also for fields of too large a degree.
pub fn parse_field(name: &str, text: &str) -> Result<FieldFile, Problem> {
    read(text).map_err(|m| {
        let source = SourceText::new(name, text);
        let end = text[m.at.min(text.len())..].chars().next().map_or(0, char::len_utf8);
        let problem = Problem::new(format!("secant::matrix::{}", m.code), m.message).with_source(&source);
        let problem = problem.with_mark(m.at.min(text.len())..m.at.min(text.len()) + end);
        match m.help {
            Some(help) => problem.with_help(help),
            None => problem,
        }
    })
}

fn read(text: &str) -> Result<FieldFile, Mistake> {
    if text.len() > MAX_FILE_BYTES {
        return Err(Mistake::new("limit", 0, format!("the file has more than {} MiB", MAX_FILE_BYTES >> 20)));
    }
    if let Some(rewritten) = foreign::rewritten(text)? {
        // What is wrong in a text that was written anew has no place in the old one.
        let same = rewritten.len() == text.len();
        let read = literal::read(&rewritten).and_then(square);
        let read = read.map(|file| FieldFile { format: Format::Rewritten, ..file });
        return read.map_err(|mistake| Mistake { at: if same { mistake.at } else { 0 }, ..mistake });
    }
    let start = text.trim_start();
    let rows = if start.get(..14).is_some_and(|s| s.eq_ignore_ascii_case("%%MatrixMarket")) {
        market::read(text)?
    } else if words(text, '#').next().is_some_and(|(_, w)| w.starts_with(|c: char| c.is_ascii_digit())) {
        plain(text)?
    } else {
        literal::read(text)?
    };
    square(rows)
}

fn square(found: Rows) -> Result<FieldFile, Mistake> {
    let n = found.rows.len();
    for (i, row) in found.rows.iter().enumerate() {
        if row.len() != n {
            let message =
                format!("the matrix is not square: row {} has {} entries, there are {n} rows", i + 1, row.len());
            return Err(Mistake::new("square", 0, message).help("a spectrum belongs to a square matrix"));
        }
    }
    check_size(n, 0)?;
    let numbers: Vec<Number> = found.rows.into_iter().flatten().collect();
    let (field, elements) = found.builder.finish(&numbers);
    let matrix = FieldMatrix::new(&field, n, n, elements);
    Ok(FieldFile { matrix, format: found.format, decimals: found.decimals })
}

fn check_size(n: usize, at: usize) -> Result<(), Mistake> {
    if n > MAX_SIZE {
        let message = format!("a matrix of size {n} is over the limit of {MAX_SIZE}");
        return Err(Mistake::new("limit", at, message).help("exact spectra of this size are out of reach"));
    }
    Ok(())
}

/// What the numbers of a file amount to so far.
#[derive(Default)]
struct Tally {
    decimals: usize,
    bits: u64,
}

/// One number, counted when it is a decimal.
fn number(token: &str, at: usize, tally: &mut Tally) -> Result<Rational, Mistake> {
    let value = parse_rational(token).map_err(|e| Mistake::new("number", at, e.to_string()))?;
    tally.decimals += usize::from(token.contains(['.', 'e', 'E']));
    tally.add(value.numerator_ref().significant_bits() + value.denominator_ref().significant_bits(), at)?;
    Ok(value)
}

impl Tally {
    fn add(&mut self, bits: u64, at: usize) -> Result<(), Mistake> {
        self.bits = self.bits.saturating_add(bits);
        if self.bits > MAX_BITS {
            return Err(Mistake::new("limit", at, "the numbers of this file are too long altogether"));
        }
        Ok(())
    }

    /// One entry from a place on, with what comes after it; a tight one ends at white space outside of brackets.
    fn entry(
        &mut self,
        builder: &mut FieldBuilder,
        text: &str,
        at: usize,
        tight: bool,
    ) -> Result<(Number, usize), Mistake> {
        let mut expression = Expression::new(text, at, tight);
        let value = expression.number(builder)?;
        self.decimals += usize::from(expression.decimals > 0);
        self.add(expression.bits, at)?;
        Ok((value, expression.position()))
    }
}

/// The words of a text with their byte offsets; `comment` starts a comment.
fn words(text: &str, comment: char) -> impl Iterator<Item = (usize, &str)> {
    let base = text.as_ptr() as usize;
    text.lines()
        .map(move |line| line.split(comment).next().unwrap_or_default())
        .flat_map(str::split_ascii_whitespace)
        .map(move |word| (word.as_ptr() as usize - base, word))
}

/// The next byte that is neither white space nor in a comment.
fn next_entry(text: &str, mut at: usize) -> usize {
    loop {
        let rest = &text[at..];
        let trimmed = rest.trim_start();
        at += rest.len() - trimmed.len();
        if !trimmed.starts_with('#') {
            return at;
        }
        at += trimmed.find('\n').unwrap_or(trimmed.len());
    }
}

fn plain(text: &str) -> Result<Rows, Mistake> {
    let mut tokens = words(text, '#');
    let (at, first) = tokens.next().ok_or_else(|| Mistake::new("empty", 0, "there is no matrix in this file"))?;
    let n: usize = first.parse().map_err(|_| {
        Mistake::new("size", at, format!("`{first}` is not the size of a matrix"))
            .help("write n and then n rows of n numbers, or only the rows, each on a line of its own")
    })?;
    check_size(n, at)?;
    let mut builder = FieldBuilder::new();
    let mut tally = Tally::default();
    let mut position = at + first.len();
    let mut rows = Vec::new();
    for i in 0..n {
        let mut row = Vec::with_capacity(n);
        for j in 0..n {
            position = next_entry(text, position);
            if position == text.len() {
                let message = format!("{} numbers are expected, but only {} are there", n * n, i * n + j);
                return Err(Mistake::new("short", position, message));
            }
            let (value, end) = tally.entry(&mut builder, text, position, true)?;
            if let Some(c) = text[end..].chars().next().filter(|c| !c.is_whitespace() && *c != '#') {
                return Err(Mistake::new("number", end, format!("`{c}` comes after a number"))
                    .help("entries of plain text are separated by blanks, with blanks inside brackets only"));
            }
            position = end;
            row.push(value);
        }
        rows.push(row);
    }
    let end = next_entry(text, position);
    if end < text.len() {
        let word: String = text[end..].chars().take_while(|c| !c.is_whitespace()).take(40).collect();
        let message = format!("`{word}` comes after the last of {} entries", n * n);
        return Err(Mistake::new("long", end, message).help("the file starts with n, then come n rows of n numbers"));
    }
    Ok(Rows { rows, builder, format: Format::Plain, decimals: tally.decimals })
}

#[cfg(test)]
mod tests;
