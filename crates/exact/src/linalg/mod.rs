//! Exact matrices over the rationals: products, echelon form, kernels, solving, characteristic polynomials.

mod char_poly;
mod matrix;
mod strong;
pub use char_poly::char_poly;
pub(crate) use char_poly::char_poly_blocks;
pub use matrix::{Echelon, Matrix, dot};
pub use strong::strong_components;
