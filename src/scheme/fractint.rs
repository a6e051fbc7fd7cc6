//! Fractint's `.ifs` files.
//!
//! Convention: an entry `name { a b c d e f p … }` has one affine map a line, `x' = a x + b y + e`, `y' = c x + d y + f`,
//! with the probability `p` of the chaos game, which does not change the attractor and may be left out. An entry whose name
//! is followed by `(3D)` has lines `a b c d e f g h i j k l p` with the matrix by rows and then the shift. A semicolon
//! begins a comment; numbers are separated by blanks or commas and read exactly (`0.25` is 1/4).

use super::SchemeError;
use crate::arith::{Rational, parse_rational};
use crate::linalg::Matrix;
use crate::shape::{CellKind, Frame, Shape};

/// Largest number of maps of an entry.
const MAX_MAPS: usize = 256;

/// One entry of a file.
#[derive(Debug, Clone)]
pub struct FractintEntry {
    /// Its name.
    pub name: String,
    /// Dimension of the space, 2 or 3.
    pub dimension: usize,
    /// The attractor as a set: the pieces have no order.
    pub shape: Shape,
    /// The probabilities, where given.
    pub probabilities: Vec<Option<Rational>>,
}

/// Reads all entries of a file.
///
/// # Errors
/// [`SchemeError::Import`] with the line.
///
/// # Examples
/// ```
/// let text = "Levy {; the C curve\n 0.5 -0.5 0.5 0.5 0 0\n .5, .5, -.5, .5, .5, .5\n}";
/// let entries = secant::scheme::parse_fractint(text)?;
/// assert_eq!((entries[0].name.as_str(), entries[0].shape.states[0].pieces.len()), ("Levy", 2));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn parse_fractint(text: &str) -> Result<Vec<FractintEntry>, SchemeError> {
    let mut entries = Vec::new();
    let mut header = String::new();
    let mut open: Option<Draft> = None;
    for (index, raw) in text.lines().enumerate() {
        let line = index + 1;
        let mut rest = raw.split(';').next().unwrap_or_default();
        while !rest.trim().is_empty() {
            match &mut open {
                None => {
                    let Some((before, after)) = rest.split_once('{') else {
                        header = format!("{header} {}", rest.trim());
                        break;
                    };
                    open = Some(Draft::new(&format!("{header} {}", before.trim()), line)?);
                    (header, rest) = (String::new(), after);
                }
                Some(draft) => {
                    let (inside, after) = rest.split_once('}').map_or((rest, None), |(a, b)| (a, Some(b)));
                    draft.map(inside, line)?;
                    let Some(after) = after else { break };
                    if let Some(draft) = open.take() {
                        entries.push(draft.finish(line)?);
                    }
                    rest = after;
                }
            }
        }
    }
    let line = text.lines().count().max(1);
    match open {
        Some(draft) => Err(error(line, &format!("the entry `{}` is not closed by `}}`", draft.name))),
        None if !header.trim().is_empty() => Err(error(line, "text after the last entry")),
        None if entries.is_empty() => Err(error(line, "no entry; an entry is `name { a b c d e f p … }`")),
        None => Ok(entries),
    }
}

fn error(line: usize, message: &str) -> SchemeError {
    SchemeError::Import { line, message: message.to_owned() }
}

struct Draft {
    name: String,
    dimension: usize,
    operators: Vec<Matrix>,
    probabilities: Vec<Option<Rational>>,
}

impl Draft {
    fn new(header: &str, line: usize) -> Result<Self, SchemeError> {
        let header = header.trim();
        let lower = header.to_ascii_lowercase();
        let dimension = if lower.ends_with("(3d)") { 3 } else { 2 };
        let name = if dimension == 3 { header[..header.len() - 4].trim() } else { header };
        if name.is_empty() {
            return Err(error(line, "an entry needs a name before `{`"));
        }
        Ok(Self { name: name.to_owned(), dimension, operators: Vec::new(), probabilities: Vec::new() })
    }

    fn map(&mut self, text: &str, line: usize) -> Result<(), SchemeError> {
        let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty());
        let numbers: Vec<Rational> =
            words.map(|w| parse_rational(w).map_err(|e| error(line, &e.to_string()))).collect::<Result<_, _>>()?;
        if numbers.is_empty() {
            return Ok(());
        }
        let d = self.dimension;
        let size = d * d + d;
        if numbers.len() != size && numbers.len() != size + 1 {
            let found = numbers.len();
            return Err(error(
                line,
                &format!("a map has {size} numbers and perhaps a probability, but here are {found}"),
            ));
        }
        if self.operators.len() == MAX_MAPS {
            return Err(error(line, &format!("more than {MAX_MAPS} maps")));
        }
        let linear = Matrix::from_fn(d, d, |i, j| numbers[i * d + j].clone());
        self.operators.push(Shape::affine_operator(&linear, &numbers[d * d..size]));
        self.probabilities.push(numbers.get(size).cloned());
        Ok(())
    }

    fn finish(self, line: usize) -> Result<FractintEntry, SchemeError> {
        if self.operators.is_empty() {
            return Err(error(line, &format!("the entry `{}` has no map", self.name)));
        }
        let mut shape = Shape::single(CellKind::Set, self.operators);
        shape.states[0].name.clone_from(&self.name);
        shape.control = Some(Shape::affine_control(self.dimension));
        shape.frame = Frame::Affine;
        Ok(FractintEntry { name: self.name, dimension: self.dimension, shape, probabilities: self.probabilities })
    }
}
