//! Exact proofs of where self-similar shapes have tangents.
#![warn(clippy::float_arithmetic)]

pub mod algebraic;
pub mod approx;
pub mod arith;
pub mod case;
pub mod certificate;
pub mod cli;
pub mod diagnostic;
pub mod jordan;
pub mod linalg;
pub mod picture;
pub mod poly;
pub mod radius;
pub mod report;
pub mod scheme;
pub mod shape;
pub mod theorem;
pub mod vertex;
