//! Shapes with one state from JSON.
//!
//! ```json
//! { "kind": "curve", "convention": "columns", "pieces": [[["1/2", 0], ["1/2", 1]], [[1, "1/2"], [0, "1/2"]]] }
//! ```
//! Convention: `columns` (operators act on columns of barycentric coordinates, column sums 1) or `rows` (subdivision
//! matrices with row sums 1, transposed on reading); it must be given. `kind` is `curve` (the default: pieces in the order
//! of the parameter, which must meet) or `set`. Optional: `reversed` (indices of pieces that run backwards), `control` (one
//! point for each coordinate). Entries are integers or strings such as `"3/4"` or `"0.25"` (exactly 1/4); a JSON number
//! with a fraction is refused, since other programs round it. Instead of `pieces` there may be `maps`, a list of
//! `{ "linear": […], "shift": […], "reversed": true }` of `R^d`, without a convention.

use super::SchemeError;
use super::mask::verify;
use crate::arith::{Rational, parse_rational};
use crate::linalg::Matrix;
use crate::shape::{CellKind, Frame, Shape};
use serde::Deserialize;

/// Largest number of pieces, and of coordinates.
const MAX_SIZE: usize = 256;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    kind: Option<String>,
    #[serde(default)]
    convention: Option<String>,
    #[serde(default)]
    pieces: Vec<Vec<Vec<Entry>>>,
    #[serde(default)]
    maps: Vec<Map>,
    #[serde(default)]
    reversed: Vec<usize>,
    #[serde(default)]
    control: Option<Vec<Vec<Entry>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Map {
    linear: Vec<Vec<Entry>>,
    shift: Vec<Entry>,
    #[serde(default)]
    reversed: bool,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Entry {
    Whole(i64),
    Text(String),
}

impl Entry {
    fn number(&self) -> Result<Rational, SchemeError> {
        match self {
            Self::Whole(n) => Ok(Rational::from(*n)),
            Self::Text(text) => parse_rational(text).map_err(|e| error(&e.to_string())),
        }
    }
}

/// What is wrong, in words of the format.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let float = text.contains("floating point") || text.contains("untagged enum Entry");
    if float {
        return format!(
            "an entry at column {} is no exact number: write integers, or strings such as \"1/2\" and \"0.5\"; a map is {{\"linear\": \
             [[…]], \"shift\": […]}}",
            error.column()
        );
    }
    text
}

fn error(message: &str) -> SchemeError {
    SchemeError::Import { line: 1, message: message.to_owned() }
}

/// Reads a shape with one state.
///
/// # Errors
/// [`SchemeError::Import`] with the line where the text is no such JSON, and the errors of the shape.
pub fn parse_json(text: &str) -> Result<Shape, SchemeError> {
    let file: File =
        serde_json::from_str(text).map_err(|e| SchemeError::Import { line: e.line().max(1), message: plain(&e) })?;
    let kind = match file.kind.as_deref() {
        None | Some("curve") => CellKind::Edge,
        Some("set") => CellKind::Set,
        Some(other) => return Err(error(&format!("`kind` is `{other}`, but must be `curve` or `set`"))),
    };
    let mut shape = match (file.pieces.is_empty(), file.maps.is_empty()) {
        (false, true) => barycentric(&file, kind)?,
        (true, false) => affine(&file, kind)?,
        _ => return Err(error("either `pieces` or `maps` must be given")),
    };
    for &letter in &file.reversed {
        let count = shape.states[0].pieces.len();
        let piece = shape.states[0].pieces.get_mut(letter);
        piece.ok_or_else(|| error(&format!("`reversed` has {letter}, but there are {count} pieces")))?.reversed = true;
    }
    if let Some(points) = &file.control {
        let rows = matrix(points, "control")?;
        shape.control = Some(rows.transpose());
    }
    verify(&shape)?;
    Ok(shape)
}

fn matrix(rows: &[Vec<Entry>], what: &str) -> Result<Matrix, SchemeError> {
    let width = rows.first().map_or(0, Vec::len);
    if width == 0 || rows.iter().any(|r| r.len() != width) {
        return Err(error(&format!("the rows of `{what}` must be equally long and not empty")));
    }
    if rows.len() > MAX_SIZE || width > MAX_SIZE {
        let size = rows.len().max(width);
        return Err(SchemeError::Large { what: "a matrix of size", size, limit: MAX_SIZE });
    }
    let numbers = rows.iter().map(|r| r.iter().map(Entry::number).collect()).collect::<Result<_, _>>()?;
    Ok(Matrix::from_rows(width, numbers))
}

fn barycentric(file: &File, kind: CellKind) -> Result<Shape, SchemeError> {
    let transposed = match file.convention.as_deref() {
        Some("columns") => false,
        Some("rows") => true,
        Some(other) => return Err(error(&format!("`convention` is `{other}`, but must be `columns` or `rows`"))),
        None => return Err(error("`convention` must be given: `columns` (column sums 1) or `rows` (row sums 1)")),
    };
    if file.pieces.len() > MAX_SIZE {
        return Err(SchemeError::Large { what: "number of pieces", size: file.pieces.len(), limit: MAX_SIZE });
    }
    let read = |rows: &Vec<Vec<Entry>>| matrix(rows, "pieces").map(|m| if transposed { m.transpose() } else { m });
    Ok(Shape::single(kind, file.pieces.iter().map(read).collect::<Result<_, _>>()?))
}

fn affine(file: &File, kind: CellKind) -> Result<Shape, SchemeError> {
    let mut operators = Vec::new();
    let dimension = file.maps.first().map_or(0, |m| m.shift.len());
    if file.maps.len() > MAX_SIZE {
        return Err(SchemeError::Large { what: "number of maps", size: file.maps.len(), limit: MAX_SIZE });
    }
    for map in &file.maps {
        let linear = matrix(&map.linear, "linear")?;
        let shift: Vec<Rational> = map.shift.iter().map(Entry::number).collect::<Result<_, _>>()?;
        if (linear.rows(), linear.cols(), shift.len()) != (dimension, dimension, dimension) {
            return Err(error("every map needs a square `linear` and a `shift` of the same dimension"));
        }
        operators.push(Shape::affine_operator(&linear, &shift));
    }
    let mut shape = Shape::single(kind, operators);
    for (piece, map) in shape.states[0].pieces.iter_mut().zip(&file.maps) {
        piece.reversed = map.reversed;
    }
    shape.control = Some(Shape::affine_control(dimension));
    shape.frame = Frame::Affine;
    Ok(shape)
}
