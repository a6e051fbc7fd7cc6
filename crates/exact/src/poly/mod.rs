//! Univariate polynomials over the rationals: arithmetic, gcd, square-free parts, factorisation.

mod dense;
mod factor;
mod hensel;
pub(crate) mod ints;
pub(crate) mod modp;
mod two;

pub use dense::Poly;
pub use factor::{factor, rational_roots};
pub use ints::IntPoly;
pub use two::Two;
