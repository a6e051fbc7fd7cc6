//! Files for `secant jsr`: a set of matrices, or an automaton of them.

use super::{Arrow, System, SystemError};
use crate::arith::{ParseNumberError, Rational, parse_rational};
use crate::linalg::Matrix;
use thiserror::Error;
use toml::{Table, Value};

/// Most matrices, and most rows and columns, that are read.
pub const MAX_SIZE: usize = 256;

/// Why a file is not a system of matrices.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FileError {
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
    /// A float, which would not be exact.
    #[error("matrix {0}: write decimals and fractions as strings, such as \"0.25\" or \"1/4\"")]
    Float(usize),
    /// Rows of different lengths, or none.
    #[error("matrix {0} is not rectangular")]
    Ragged(usize),
    /// Sizes that do not fit.
    #[error(transparent)]
    System(#[from] SystemError),
}

/// A named system.
#[derive(Debug, Clone)]
pub struct File {
    /// The name, empty if none is given.
    pub name: String,
    /// The system.
    pub system: System,
}

/// Reads
///
/// ```toml
/// name = "golden pair"                       # optional
/// matrices = [
///   [["1", "1"], ["0", "1"]],                # integers, or strings such as "3/4" and "0.25"
///   [[1, 0], [1, 1]],
/// ]
/// states = [2, 2]                            # optional: the dimension of every state of an automaton
/// arrows = [[0, 1, 0], [1, 0, 1]]            # optional: from, to, matrix
/// ```
///
/// A matrix of an arrow maps the space of `to` into that of `from`; a word is read from left to right.
///
/// # Errors
/// [`FileError`].
pub fn parse(text: &str) -> Result<File, FileError> {
    let table: Table = text.parse().map_err(|e: toml::de::Error| FileError::Toml(e.message().to_owned()))?;
    if let Some(key) = table.keys().find(|k| !["name", "matrices", "states", "arrows"].contains(&k.as_str())) {
        return Err(FileError::Unknown(key.clone()));
    }
    let name = table.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
    let list = array(table.get("matrices"), "matrices")?;
    let matrices = list.iter().enumerate().map(|(k, m)| matrix(k, m)).collect::<Result<Vec<_>, _>>()?;
    let system = match (table.get("states"), table.get("arrows")) {
        (None, None) => System::plain(&matrices)?,
        (states, arrows) => {
            let dims = numbers(array(states, "states")?, "states")?;
            let arrows = array(arrows, "arrows")?;
            let arrows = arrows.iter().enumerate().map(|(k, a)| arrow(k, a, &matrices)).collect::<Result<_, _>>()?;
            System { dims, arrows }.checked()?
        }
    };
    Ok(File { name, system })
}

fn key(key: &str, problem: &'static str) -> FileError {
    FileError::Key { key: key.to_owned(), problem }
}

fn array<'a>(value: Option<&'a Value>, name: &str) -> Result<&'a [Value], FileError> {
    let list = value.ok_or_else(|| key(name, "is missing"))?.as_array().ok_or_else(|| key(name, "must be a list"))?;
    if list.len() > MAX_SIZE {
        return Err(key(name, "has more than 256 entries"));
    }
    Ok(list)
}

fn numbers(list: &[Value], name: &str) -> Result<Vec<usize>, FileError> {
    let small = |v: &Value| v.as_integer().and_then(|x| usize::try_from(x).ok()).filter(|x| *x <= MAX_SIZE);
    list.iter().map(|v| small(v).ok_or_else(|| key(name, "must hold whole numbers from 0 to 256"))).collect()
}

fn arrow(label: usize, value: &Value, matrices: &[Matrix]) -> Result<Arrow, FileError> {
    let list = numbers(array(Some(value), "arrows")?, "arrows")?;
    let [from, to, matrix] = list[..] else { return Err(key("arrows", "must hold lists [from, to, matrix]")) };
    let matrix = matrices.get(matrix).ok_or_else(|| key("arrows", "names a matrix that does not exist"))?.clone();
    Ok(Arrow { from, to, matrix, label })
}

fn matrix(index: usize, value: &Value) -> Result<Matrix, FileError> {
    let rows = array(Some(value), "matrices")?;
    let rows: Vec<Vec<Rational>> = rows
        .iter()
        .map(|row| array(Some(row), "matrices")?.iter().map(|x| entry(index, x)).collect())
        .collect::<Result<_, FileError>>()?;
    let cols = rows.first().map_or(0, Vec::len);
    if cols == 0 || rows.iter().any(|r| r.len() != cols) {
        return Err(FileError::Ragged(index));
    }
    Ok(Matrix::from_rows(cols, rows))
}

fn entry(matrix: usize, value: &Value) -> Result<Rational, FileError> {
    match value {
        Value::Integer(x) => Ok(Rational::from(*x)),
        Value::String(s) => parse_rational(s).map_err(|source| FileError::Number { matrix, source }),
        _ => Err(FileError::Float(matrix)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_sets_and_automata() {
        let file = parse("name = \"x\"\nmatrices = [[[\"1/2\", 1], [0, 1]]]").unwrap();
        assert_eq!((file.name.as_str(), file.system.dims.as_slice()), ("x", [2].as_slice()));
        let file = parse("matrices = [[[1, 2]], [[1], [1]]]\nstates = [1, 2]\narrows = [[0, 1, 0], [1, 0, 1]]").unwrap();
        assert_eq!(file.system.product(&[0, 1]).rows(), 1);
    }

    #[test]
    fn refuses_bad_files() {
        assert_eq!(parse("matrices = [[[0.5]]]").unwrap_err(), FileError::Float(0));
        assert_eq!(parse("matrices = [[[1, 2], [1]]]").unwrap_err(), FileError::Ragged(0));
        assert!(matches!(parse("matrices = [[[1, 2]]]"), Err(FileError::System(SystemError::Size { .. }))));
        assert!(matches!(parse("matrices = []"), Err(FileError::System(SystemError::Empty))));
        assert!(matches!(parse("matrix = []"), Err(FileError::Unknown(_))));
    }
}
