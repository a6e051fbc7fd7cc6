//! Exact matrices, over the rationals and over any field of [`crate::ring`]: products, echelon form, kernels, solving,
//! characteristic polynomials.

mod char_poly;
pub(crate) mod dependency;
mod determinant;
pub(crate) mod echelon;
mod elimination;
mod entry;
pub(crate) mod lifting;
mod matrix;
mod rational;
pub(crate) mod reconstruct;
mod scaled;
mod strong;
mod sums;
pub use char_poly::char_poly;
pub(crate) use char_poly::char_poly_blocks;
pub use entry::{Entry, Products};
pub use matrix::{Echelon, Matrix, closures};
pub use scaled::Scaled;
pub use strong::strong_components;
pub use sums::dot;
