//! Exact matrices over the rationals: products, echelon form, kernels, solving.

mod matrix;
pub use matrix::{Echelon, Matrix, dot};
