//! The float fallback and float proposals. Nothing here is a proof.

mod forms;
mod growth;
mod look;
mod spectrum;

pub use forms::{FormArrow, FormProblem, ProposedForms};
pub use growth::may_expand;
pub use look::{PointLook, look};
pub use spectrum::{ApproxEigenvalue, ApproxError, ApproxSpectrum, approximate_spectrum, may_have_several_leaders};
