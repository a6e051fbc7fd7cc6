//! Curves and sets: the case, what is computed from it, and the rules of certificates of the kind `certify`.

mod arcs;
pub mod case;
mod claims;
mod components;
mod everywhere;
mod frames;
mod germ;
mod model;
mod points;
mod rate;
mod rules;
mod scheme;
mod shape;
mod top;

pub use case::Case;
pub use claims::{check, injective, turns};
pub use germ::{Germ, Root};
pub use model::Model;
pub use points::{Place, Point, complete};
pub use rules::{Branch, Found, Leading, Line, outer, read_address};
pub use scheme::kronecker;
pub use shape::{Address, End, Kind, Op, Piece, Shape, Spaces, State, Way, close};
pub use top::{Chain, Top, chain, outside, positive_definite, residual, span_a_plane};
