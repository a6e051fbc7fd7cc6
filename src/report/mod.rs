//! Reports: one document model, and its renderings.

pub mod document;
pub mod html;
pub mod markdown;
pub mod math;
pub mod mathml;
mod symbols;
pub mod tex;
pub mod text;
pub mod theorems;
pub mod values;
