//! Shapes: automata of exact operators, their addresses, the space they span, and where they lie.
#![deny(clippy::disallowed_methods)]

mod adaptive;
mod address;
mod contraction;
mod curve;
mod enclosure;
mod hull;
mod identities;
mod links;
mod model;
mod own;
mod polytope;
mod resolution;
mod rounded;
mod sample;
mod solid;
mod space;
mod unknown;

pub use adaptive::adaptive_sample;
pub use address::{Address, AddressError, cell_text, fixed_point, repetition, word_text};
pub use contraction::{
    Contracting, ContractingWord, Contraction, MAX_WORDS, ProductContraction, contraction, contraction_within,
    dobrushin, linear_part, norm1,
};
pub use curve::{CurveError, End};
pub use enclosure::{Balls, HullWeights, oscillation};
pub use identities::{Complex, ComplexError, Face, Failure, Identity, IdentityKind, Layout, OpName, Reversal, Side};
pub use model::{Boundary, CellKind, Frame, Piece, Shape, ShapeError, State, entries};
pub use own::OwnPoints;
pub use polytope::{Polytopes, Weights};
pub use resolution::{MAX_CELLS, Resolution, level};
pub use sample::{MAX_SAMPLES, Sample, depth_within, random_sample, sample, words_of_length};
pub use solid::SolidCells;
pub use space::{Spaces, StateSpace, difference};
pub use unknown::{Family, Forced, MAX_UNKNOWNS, Problem, Solution, Source, UnknownError};
