//! Junctions of two curves (thesis, §5.1): an intermediate curve `I -> a … a I b … b` that begins like one scheme and ends like
//! another. Those of two surfaces are in [`surface`].
//!
//! All identities of such a curve are solved by one array of stencils ([`Junction`]): its forced rows are the rules of the two
//! schemes at their ends, and its other rows are free. [`search()`] fills them in: positions that both schemes reproduce, the
//! highest powers of them, the least weighted norm, and a check that nothing else shrinks as slowly as the positions.
#![deny(clippy::disallowed_methods)]

mod array;
mod gaps;
mod inside;
mod member;
mod place;
mod refine;
mod refine_face;
mod search;
mod side;
pub mod surface;

pub use crate::scheme::PointOrder;
pub use array::{Junction, Pattern};
pub use member::{Check, Member, Slider};
pub use place::Placed;
pub use refine::{Refined, refine};
pub use search::{Attempt, Found, Wish, search};
pub use side::Side;

use crate::arith::Rational;
use thiserror::Error;

/// Why two schemes cannot be joined as was asked.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum JunctionError {
    /// A side is no curve of one state.
    #[error("{0}: a side of a junction is a curve with a single state")]
    NotOneCurve(String),
    /// A side does not contract, as far as is known.
    #[error("{name}: {why}")]
    NoCurve {
        /// The side.
        name: String,
        /// What is wrong.
        why: String,
    },
    /// A pattern that is not `a, …, I, …, b`.
    #[error("`{0}` is no pattern: it is a list such as a,I,b with exactly one I, first a, then I, then b")]
    Pattern(String),
    /// A number of points for which the ends do not fit.
    #[error("the intermediate curve has {points} points, but its ends need {least} at least")]
    Points {
        /// The number.
        points: usize,
        /// The smallest possible one.
        least: usize,
    },
    /// The rules of both schemes speak of the same new point, and say different things.
    #[error("new point {row} is given by both schemes, by ({left}) and by ({right})")]
    Contradiction {
        /// The row of the array.
        row: usize,
        /// What the first scheme says.
        left: String,
        /// What the second one says.
        right: String,
    },
    /// The wrong number of rows, or a row of the wrong length or sum.
    #[error("{0}")]
    Rows(String),
    /// A slider that does not exist.
    #[error("there is no slider `{name}`: {known}")]
    Slider {
        /// Its name.
        name: String,
        /// The sliders there are.
        known: String,
    },
    /// A shape that cannot be refined.
    #[error("this shape cannot be refined: {0}")]
    Refinement(String),
    /// The array would be too large.
    #[error("the pattern needs {0} new points, which is over the limit of {limit}", limit = MAX_ROWS)]
    Large(usize),
}

/// Most rows of an array of stencils.
pub const MAX_ROWS: usize = 160;

/// A row as it is printed: `1/2, 1/4, 1/4`.
#[must_use]
pub fn row_text(row: &[Rational]) -> String {
    row.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}
