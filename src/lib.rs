//! Exact proofs of where self-similar shapes have tangents.
#![warn(clippy::float_arithmetic)]

pub mod arith;
pub mod linalg;
pub mod scheme;
pub mod shape;
