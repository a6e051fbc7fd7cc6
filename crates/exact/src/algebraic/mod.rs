//! Algebraic numbers: roots of irreducible polynomials with certified enclosures, elements of number fields, exact
//! comparison of values and of absolute values.
//!
//! Enclosures. For every point `z` the disc of radius `n |f(z) / f'(z)|` contains a root of `f`; when `n` such discs
//! are disjoint, each contains exactly one. The points are proposed by Aberth's iteration, the discs are proved in
//! fixed-point arithmetic with an error bound, and Newton's method refines them on demand.
//!
//! Absolute values. Numbers whose enclosures separate are done. The rest is decided by algebra: roots of `g(x^k)` are
//! compared through `g`; roots on a circle of rational squared radius `r` are those with `r / z = conj z`; in general
//! `|z|^2 = z conj z` is a root of the polynomial of the products of two roots, where Descartes' rule of signs tells
//! whether two close roots are the same.

mod ball;
mod elem;
pub mod field;
mod isolate;
mod line;
mod modulus;
mod number;
mod propose;
mod real;
mod relation;
mod root;

pub use elem::{Elem, cmp_real, lies_within, locate};
pub use line::{between, roots_within, sorted};
pub use modulus::sqrt_down;
pub use number::{Real, nearest};
pub use root::{Root, positive_roots, real_roots, roots};

#[cfg(test)]
mod tests;
