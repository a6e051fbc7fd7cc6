//! Shapes: automata of exact operators, their addresses, the space they span, and where they lie.

mod address;
mod contraction;
mod curve;
mod enclosure;
mod model;
mod space;

pub use address::{Address, AddressError, fixed_point, word_text};
pub use contraction::{
    Contracting, ContractingWord, Contraction, MAX_WORDS, contraction, dobrushin, linear_part, norm1,
};
pub use curve::{CurveError, End};
pub use enclosure::{Balls, oscillation};
pub use model::{Boundary, CellKind, Frame, Piece, Shape, ShapeError, State};
pub use space::{Spaces, StateSpace, difference};
