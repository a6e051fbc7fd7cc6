//! Strategies of [proptest] for the objects of this field, for property tests of programs that use secant and of secant itself.
//!
//! Feature `strategies`. Every value is exact; every strategy shrinks to simpler values of its own kind.
//!
//! ```
//! use proptest::prelude::*;
//! use secant::arith::ratio;
//! use secant::jordan::Spectrum;
//! use secant::poly::Poly;
//! use secant::strategies::column_stochastic;
//!
//! proptest!(ProptestConfig::with_cases(16), |(a in column_stochastic(1..=5))| {
//!     let spectrum = Spectrum::of(&a);
//!     prop_assert!(spectrum.factors.iter().any(|f| f.poly == Poly::linear(&ratio(1, 1))));
//! });
//! ```

mod curves;
mod masks;
mod matrices;

pub use curves::{AutomatonOptions, automaton, plane_set};
pub use masks::{MaskPlan, VertexPlan, mask, vertex_weights};
pub use matrices::{PlantedJordan, column_stochastic, planted_jordan, signed_stochastic};
