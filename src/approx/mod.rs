//! The float fallback and float proposals. Nothing here is a proof.

mod growth;
pub use growth::may_expand;
