//! Exact linear algebra over the rationals and over real number fields: characteristic polynomials, factorisation,
//! algebraic numbers with certified enclosures, and Jordan forms with chains of generalised eigenvectors.
//!
//! No input or output, and no threads unless the feature `parallel` is on.
//!
//! ```
//! use secant_exact::arith::ratio;
//! use secant_exact::jordan::Spectrum;
//! use secant_exact::linalg::Matrix;
//!
//! // The companion matrix of x² − x − 1: one factor, two real roots.
//! let fibonacci = Matrix::from_fn(2, 2, |i, j| ratio(i64::from(i + j > 0), 1));
//! let spectrum = Spectrum::of(&fibonacci);
//! assert_eq!(spectrum.factors.len(), 1);
//! assert_eq!(spectrum.factors[0].roots.len(), 2);
//! ```
//!
//! The modules in the order of the argument: [`arith`], [`poly`], [`ring`], [`linalg`], [`algebraic`], [`jordan`].
#![warn(clippy::float_arithmetic)]

/// The examples of the README are run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod algebraic;
pub mod arith;
pub mod jordan;
pub mod linalg;
pub mod parallel;
pub mod poly;
pub mod ring;
pub mod stop;
