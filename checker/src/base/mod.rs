//! What all rules use: answers, exact numbers and matrices, polynomials at roots, and the strict readers of the two files.

mod answer;
mod cosine;
mod expression;
mod file;
mod generator;
mod graph;
mod json;
mod matrix;
pub mod number;
mod poly;
mod surd;
mod whole;

pub use answer::{Accepted, Checked, Rejected, Verdict, list, need, reject, some, together, unreadable};
pub use file::{MAX_COORDINATES, file, flag, index, items, matrix, number, word};
pub use graph::disjoint_cycles;
pub use json::{Json, Node};
pub use matrix::{Matrix, primitive};
pub use number::{Q, bits, charge, longest, spend, total, whole};
pub use poly::{Enclosed, Field, Interval, MAX_DEGREE, has_root_near, products, roots_in_disc, values};
pub use surd::{Ground, Surd};
pub use whole::{Fraction, Whole, absolute, ceiling, fraction, largest};

/// Longest word of a certificate or address of a case.
pub const MAX_LETTERS: usize = 1_000;
/// Most pieces of a state.
pub const MAX_PIECES: usize = 64;
