//! Reports: one document model, and its renderings.

pub mod document;
pub mod figures;
pub mod html;
pub mod json;
pub mod latex;
pub mod markdown;
pub mod math;
pub mod mathml;
pub mod proof;
pub mod radius;
pub mod spectrum;
pub mod summary;
mod symbols;
pub mod tex;
pub mod text;
pub mod theorems;
pub mod values;
pub mod vertex;
pub mod words;
