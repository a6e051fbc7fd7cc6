//! Exact proofs of where self-similar shapes have tangents.
#![warn(clippy::float_arithmetic)]

pub mod arith;
pub mod case;
pub mod diagnostic;
pub mod linalg;
pub mod picture;
pub mod report;
pub mod shape;
