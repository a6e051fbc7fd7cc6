//! The float fallback and float proposals. Nothing here is a proof.

mod growth;
mod look;

pub use growth::may_expand;
pub use look::{PointLook, look};
