//! Shapes: automata of exact operators, their addresses, the space they span, and where they lie.

mod address;
mod model;

pub use address::{Address, AddressError, fixed_point, word_text};
pub use model::{Boundary, CellKind, Frame, Piece, Shape, ShapeError, State};
