//! The float fallback and float proposals. Nothing here is a proof.

mod growth;
mod look;
mod spectrum;

pub use growth::may_expand;
pub use look::{PointLook, look};
pub use spectrum::{ApproxEigenvalue, ApproxError, ApproxSpectrum, approximate_spectrum};
