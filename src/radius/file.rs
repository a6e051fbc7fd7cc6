//! Files for `secant jsr`: a set of matrices, or an automaton of them, as TOML, JSON or plain text.

use super::{Arrow, System, SystemError};
use crate::algebraic::Real;
use crate::algebraic::field::{FieldBuilder, Number};
use crate::arith::{ParseNumberError, Rational, parse_rational};
use crate::linalg::{Entry, Matrix};
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;
use thiserror::Error;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Most matrices, and most rows and columns, that are read.
pub const MAX_SIZE: usize = 256;

/// Why a file is not a system of matrices, and where.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{problem}")]
pub struct FileError {
    /// Why.
    pub problem: FileProblem,
    /// The bytes of the text that are wrong.
    pub span: Range<usize>,
}

/// Why a file is not a system of matrices.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FileProblem {
    /// Not TOML.
    #[error("not valid TOML: {0}")]
    Toml(String),
    /// A key that is missing or of the wrong type.
    #[error("`{key}` {problem}")]
    Key {
        /// The key.
        key: String,
        /// What is wrong.
        problem: &'static str,
    },
    /// An unknown key.
    #[error("unknown key `{0}`; a file has `name`, `matrices`, and optionally `states` and `arrows`")]
    Unknown(String),
    /// An entry that is no exact number.
    #[error("matrix {matrix}: {source}")]
    Number {
        /// The matrix, from 0.
        matrix: usize,
        /// Why.
        source: ParseNumberError,
    },
    /// An expression that cannot be read.
    #[error("matrix {matrix}: {message}")]
    Expression {
        /// The matrix, from 0.
        matrix: usize,
        /// Why.
        message: String,
        /// How to mend it.
        help: Option<String>,
    },
    /// An expression with a rational value where no entry is irrational.
    #[error("matrix {matrix}: the value of the expression is rational, and so are all entries")]
    Valued {
        /// The matrix, from 0.
        matrix: usize,
        /// The value.
        value: Rational,
    },
    /// An entry that is neither a number nor a string.
    #[error("matrix {0}: entries are numbers, or strings such as \"1/4\"")]
    Entry(usize),
    /// Rows of different lengths, or none.
    #[error("matrix {0} is not rectangular")]
    Ragged(usize),
    /// Sizes that do not fit.
    #[error(transparent)]
    System(#[from] SystemError),
}

impl FileProblem {
    fn at(self, span: Range<usize>) -> FileError {
        FileError { problem: self, span }
    }
}

/// A named system.
#[derive(Debug, Clone)]
pub struct File<E = Rational> {
    /// The name, empty if none is given.
    pub name: String,
    /// The system.
    pub system: System<E>,
    /// The values of the roots and cosines that stand in irrational entries.
    pub numbers: Vec<E>,
}

/// Reads
///
/// ```toml
/// name = "golden pair"                       # optional
/// matrices = [
///   [["1", "1"], ["0", "1"]],                # integers, decimals, or strings such as "3/4"; decimals are exact
///   [[1, 0], [1, 1]],
/// ]
/// states = [2, 2]                            # optional: the dimension of every state of an automaton
/// arrows = [[0, 1, 0], [1, 0, 1]]            # optional: from, to, matrix
/// ```
///
/// or the same as JSON (an object, or the bare list of matrices), or plain text: matrices separated by empty lines, a row on
/// each line, entries separated by blanks, commas or semicolons, `#` and `%` begin comments.
///
/// A matrix of an arrow maps the space of `to` into that of `from`; a word is read from left to right.
///
/// # Errors
/// [`FileError`].
pub fn parse(text: &str) -> Result<File, FileError> {
    parsed(text, &mut |matrix, entry, span| {
        parse_rational(entry).map_err(|source| FileProblem::Number { matrix, source }.at(span))
    })
}

/// Reads the same with entries such as `sqrt(2)`, in plain text without blanks; all are put into one field, the smallest that
/// holds them and the roots and cosines in them.
///
/// # Errors
/// [`FileError`]; also where all entries are rational.
///
/// # Examples
/// ```
/// use secant::radius::file::parse_field;
/// let file = parse_field("matrices = [[[\"sqrt(2)\", 1], [0, \"1/2\"]]]")?;
/// assert_eq!((file.system.arrows[0].matrix[(0, 0)].to_string(), file.numbers.len()), ("sqrt(2)".to_owned(), 1));
/// # Ok::<(), secant::radius::file::FileError>(())
/// ```
pub fn parse_field(text: &str) -> Result<File<Real>, FileError> {
    let mut builder = FieldBuilder::new();
    let mut numbers: Vec<Number> = Vec::new();
    let mut written: Option<(usize, Range<usize>, Number)> = None;
    parsed(text, &mut |matrix, entry, span: Range<usize>| {
        let number = match parse_rational(entry) {
            Ok(q) => builder.rational(&q),
            Err(source) => {
                let wrong = |e: crate::algebraic::field::ExpressionError| match entry.contains(['(', '[', '√']) {
                    true => FileProblem::Expression { matrix, message: e.to_string(), help: e.help },
                    false => FileProblem::Number { matrix, source },
                };
                let number = builder.parse(entry).map_err(|e| wrong(e).at(span.clone()))?;
                written.get_or_insert((matrix, span, number.clone()));
                number
            }
        };
        numbers.push(number);
        Ok(Rational::from(0))
    })?;
    let count = numbers.len();
    numbers.extend(builder.asked().to_vec());
    let (field, elements) = builder.finish(&numbers);
    if let (true, Some((matrix, span, number))) = (field.is_rational(), written) {
        let value = builder.elem(&number).0.coeff(0);
        return Err(FileProblem::Valued { matrix, value }.at(span));
    }
    let field = Arc::new(field);
    let mut values: Vec<Real> = elements.into_iter().map(|x| Real::new(&field, x)).collect();
    let mut asked = values.split_off(count);
    asked.sort();
    asked.dedup();
    asked.retain(|x| x.rational().is_none());
    let mut entries = values.into_iter();
    let missing = |span| key("matrices", "is read in two ways", span);
    let found = parsed(text, &mut |_, _, span| entries.next().ok_or_else(|| missing(span)))?;
    Ok(File { numbers: asked, ..found })
}

/// Makes an entry of the text at a place of a matrix.
type Reader<'a, E> = &'a mut dyn FnMut(usize, &str, Range<usize>) -> Result<E, FileError>;

fn parsed<E: Entry>(text: &str, reader: Reader<'_, E>) -> Result<File<E>, FileError> {
    let start = text.len() - text.trim_start().len();
    let (toml, shift) = match text[start..].chars().next() {
        Some('{') => (Cow::Owned(json_object(text)), 0),
        Some('[') => (Cow::Owned(format!("{LIST}{}{}", " ".repeat(start), &text[start..])), LIST.len()),
        Some(_) if !text.lines().any(|l| uncommented(l).contains('=')) => return plain(text, reader),
        _ => (Cow::Borrowed(text), 0),
    };
    let unshifted = |span: Range<usize>| span.start.saturating_sub(shift)..span.end.saturating_sub(shift);
    read(&toml, reader).map_err(|e| FileError { span: unshifted(e.span), ..e })
}

/// What makes a bare list a file.
const LIST: &str = "matrices = ";

/// A JSON object as TOML, byte for byte: braces and commas between keys go, colons become equality signs.
fn json_object(text: &str) -> String {
    let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
    let change = |c: char| {
        if quoted {
            quoted = escaped || c != '"';
            escaped = c == '\\' && !escaped;
            return c;
        }
        match c {
            '"' => quoted = true,
            '[' | '{' => depth += 1,
            ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        match (c, depth) {
            ('{', 1) | ('}', 0) => ' ',
            (':', 1) => '=',
            (',', 1) => '\n',
            ('\n' | '\r', 1) => ' ',
            _ => c,
        }
    };
    text.chars().map(change).collect()
}

fn read<E: Entry>(text: &str, reader: Reader<'_, E>) -> Result<File<E>, FileError> {
    let wrong = |e: &toml::de::Error| {
        let problem = FileProblem::Toml(e.message().to_owned());
        let Some(place) = e.span() else { return problem.at(0..text.len()) };
        problem.at(place)
    };
    let parsed = DeTable::parse(text).map_err(|e| wrong(&e))?;
    let table = parsed.get_ref();
    let known = ["name", "matrices", "states", "arrows"];
    if let Some((key, _)) = table.iter().find(|(k, _)| !known.contains(&k.get_ref().as_ref())) {
        return Err(FileProblem::Unknown(key.get_ref().to_string()).at(key.span()));
    }
    let name = match table.get("name") {
        None => String::new(),
        Some(value) => value.get_ref().as_str().ok_or_else(|| key("name", "must be a text", value.span()))?.to_owned(),
    };
    let whole = 0..text.len();
    let list = array(table.get("matrices"), "matrices", &whole)?;
    let matrices = list.iter().enumerate().map(|(k, m)| matrix(k, m, reader)).collect::<Result<Vec<_>, _>>()?;
    let at = table.get("matrices").map_or(whole.clone(), Spanned::span);
    let system = match (table.get("states"), table.get("arrows")) {
        (None, None) => System::plain(&matrices).map_err(|e| FileProblem::from(e).at(at))?,
        (states, arrows) => {
            let dims = numbers(array(states, "states", &whole)?, "states")?;
            let list = array(arrows, "arrows", &whole)?;
            let place = arrows.map_or(whole.clone(), Spanned::span);
            let arrows = list.iter().enumerate().map(|(k, a)| arrow(k, a, &matrices)).collect::<Result<_, _>>()?;
            System { dims, arrows }.checked().map_err(|e| FileProblem::from(e).at(place))?
        }
    };
    Ok(File { name, system, numbers: Vec::new() })
}

type Value<'a> = Spanned<DeValue<'a>>;

fn key(key: &str, problem: &'static str, span: Range<usize>) -> FileError {
    FileProblem::Key { key: key.to_owned(), problem }.at(span)
}

fn array<'a, 'b>(value: Option<&'a Value<'b>>, name: &str, whole: &Range<usize>) -> Result<&'a [Value<'b>], FileError> {
    let value = value.ok_or_else(|| key(name, "is missing", whole.clone()))?;
    let DeValue::Array(list) = value.get_ref() else { return Err(key(name, "must be a list", value.span())) };
    if list.len() > MAX_SIZE {
        return Err(key(name, "has more than 256 entries", value.span()));
    }
    Ok(list)
}

fn numbers(list: &[Value], name: &str) -> Result<Vec<usize>, FileError> {
    let small = |v: &Value| match v.get_ref() {
        DeValue::Integer(digits) => {
            usize::from_str_radix(digits.as_str(), digits.radix()).ok().filter(|x| *x <= MAX_SIZE)
        }
        _ => None,
    };
    let number = |v: &Value| small(v).ok_or_else(|| key(name, "must hold whole numbers from 0 to 256", v.span()));
    list.iter().map(number).collect()
}

fn arrow<E: Entry>(label: usize, value: &Value, matrices: &[Matrix<E>]) -> Result<Arrow<E>, FileError> {
    let list = numbers(array(Some(value), "arrows", &value.span())?, "arrows")?;
    let [from, to, matrix] = list[..] else {
        return Err(key("arrows", "must hold lists [from, to, matrix]", value.span()));
    };
    let missing = || key("arrows", "names a matrix that does not exist", value.span());
    Ok(Arrow { from, to, matrix: matrices.get(matrix).ok_or_else(missing)?.clone(), label })
}

fn matrix<E: Entry>(index: usize, value: &Value, reader: Reader<'_, E>) -> Result<Matrix<E>, FileError> {
    let rows = array(Some(value), "matrices", &value.span())?;
    let mut row =
        |row: &Value| array(Some(row), "matrices", &row.span())?.iter().map(|x| entry(index, x, reader)).collect();
    rectangular(index, rows.iter().map(&mut row).collect::<Result<_, FileError>>()?, value.span())
}

fn rectangular<E: Entry>(index: usize, rows: Vec<Vec<E>>, span: Range<usize>) -> Result<Matrix<E>, FileError> {
    match rows.first().map(Vec::len) {
        Some(cols) if cols > 0 && rows.iter().all(|r| r.len() == cols) => Ok(Matrix::from_rows(cols, rows)),
        _ => Err(FileProblem::Ragged(index).at(span)),
    }
}

fn entry<E>(matrix: usize, value: &Value, reader: Reader<'_, E>) -> Result<E, FileError> {
    let text = match value.get_ref() {
        DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str(),
        DeValue::Float(digits) => digits.as_str(),
        DeValue::String(text) => text.as_ref(),
        _ => return Err(FileProblem::Entry(matrix).at(value.span())),
    };
    reader(matrix, text, value.span())
}

fn uncommented(line: &str) -> &str {
    match line.split_once(['#', '%']) {
        Some((before, _)) => before,
        None => line,
    }
}

/// Matrices as plain text. A matrix may begin with its size on a line of its own.
fn plain<E: Entry>(text: &str, reader: Reader<'_, E>) -> Result<File<E>, FileError> {
    let mut blocks: Vec<(Vec<Vec<E>>, Range<usize>)> = Vec::new();
    let (mut offset, mut open) = (0, false);
    for line in text.split_inclusive('\n') {
        let body = uncommented(line);
        let span = offset..offset + body.trim_end().len();
        offset += line.len();
        if body.trim().is_empty() {
            open = open && !line.trim().is_empty();
            continue;
        }
        if !open {
            blocks.push((Vec::new(), span.clone()));
        }
        open = true;
        let index = blocks.len() - 1;
        let words = body.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|w| !w.is_empty());
        let row = words.map(|w| reader(index, w, span.clone())).collect::<Result<Vec<_>, _>>()?;
        let (rows, whole) = &mut blocks[index];
        rows.push(row);
        whole.end = span.end;
        if rows.len() > MAX_SIZE + 1 || index >= MAX_SIZE || rows.last().is_some_and(|r| r.len() > MAX_SIZE) {
            return Err(key("matrices", "has more than 256 entries", span));
        }
    }
    let matrices = blocks.into_iter().enumerate().map(|(k, (mut rows, span))| {
        let size = rows.len() - 1;
        if size > 0
            && rows[0].len() == 1
            && rows[0][0].rational() == Some(Rational::from(size))
            && rows[1].len() == size
        {
            rows.remove(0);
        }
        rectangular(k, rows, span)
    });
    let matrices = matrices.collect::<Result<Vec<_>, _>>()?;
    let system = System::plain(&matrices).map_err(|e| FileProblem::from(e).at(0..text.len()))?;
    Ok(File { name: String::new(), system, numbers: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn reads_sets_and_automata() {
        let file = parse("name = \"x\"\nmatrices = [[[\"1/2\", 1], [0, 1]]]").unwrap();
        assert_eq!((file.name.as_str(), file.system.dims.as_slice()), ("x", [2].as_slice()));
        let file =
            parse("matrices = [[[1, 2]], [[1], [1]]]\nstates = [1, 2]\narrows = [[0, 1, 0], [1, 0, 1]]").unwrap();
        assert_eq!(file.system.product(&[0, 1]).rows(), 1);
    }

    #[test]
    fn all_formats_give_the_same_system() {
        let own = parse("name = \"pair\"\nmatrices = [[[\"1/2\", 1], [0, \"1/8\"]], [[1, 0], [-3, 1]]]").unwrap();
        for text in [
            "matrices = [[[0.5, 1], [0, 0.125]], [[1, 0], [-3, 1.0]]]",
            "{\n \"matrices\":\n [[[0.5, 1], [0, \"1/8\"]], [[1, 0], [-3, 1]]],\n \"name\": \"a, b: {c}\"\n}",
            "[[[5e-1, 1], [0, 0.125]],\n [[1, 0], [-3, 1]]]",
            "# two\n5.0e-01 1\n0, 1/8\n\n\n1; 0\n-3 1 % end\n",
            "2\n1/2 1\n0 1/8\n\n2\n1 0\n-3 1\n",
        ] {
            assert_eq!(parse(text).unwrap().system, own.system, "{text}");
        }
        assert_eq!(parse("[[[0.1]]]").unwrap().system.arrows[0].matrix[(0, 0)], ratio(1, 10));
    }

    #[test]
    fn refuses_bad_files() {
        let wrong = |text: &str| parse(text).unwrap_err();
        assert_eq!(wrong("matrices = [[[true]]]"), FileProblem::Entry(0).at(14..18));
        assert_eq!(wrong("[[[1, nan]]]").span, 6..9);
        assert_eq!(wrong("matrices = [[[1, 2], [1]]]").problem, FileProblem::Ragged(0));
        assert!(matches!(wrong("1 2\n3 4\n\n1 2\n3 x\n").problem, FileProblem::Number { matrix: 1, .. }));
        assert!(matches!(wrong("matrices = [[[1, 2]]]").problem, FileProblem::System(SystemError::Size { .. })));
        assert!(matches!(wrong("matrices = []").problem, FileProblem::System(SystemError::Empty)));
        assert_eq!(wrong("matrix = []"), FileProblem::Unknown("matrix".to_owned()).at(0..6));
        assert!(matches!(wrong("").problem, FileProblem::Key { .. }));
    }
}
