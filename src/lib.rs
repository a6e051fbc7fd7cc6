//! Exact proofs of where self-similar shapes have tangents.
#![warn(clippy::float_arithmetic)]

pub mod algebraic;
pub mod arith;
pub mod jordan;
pub mod linalg;
pub mod poly;
