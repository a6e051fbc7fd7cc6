//! Reports: one document model, and its renderings.

pub mod claims;
pub mod document;
pub mod every;
pub mod field_spectrum;
pub mod figures;
pub mod findings;
pub mod html;
pub mod json;
pub mod latex;
pub mod markdown;
pub mod math;
pub mod mathml;
pub mod mesh;
pub mod proof;
pub mod radius;
pub mod reasons;
pub mod regularity;
pub mod spectrum;
pub mod summary;
pub mod surface;
use crate::escape::symbols;
pub mod tex;
pub mod text;
pub mod values;
pub mod vertex;
pub mod vertex_reasons;
pub mod words;
