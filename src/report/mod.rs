//! Reports: one document model, and its renderings.

pub mod document;
pub mod math;
pub mod spectrum;
pub mod text;
