//! Extraordinary vertices: the subdominant eigenvalues by Fourier block, the characteristic map, and whether the surface
//! is C¹ (docs/theory.md §10).
#![deny(clippy::disallowed_methods)]

pub mod block;
mod certify;
pub mod cosine;
mod curvature;
mod every;
mod factored;
pub mod field;
pub mod limit;
pub mod net;
mod reason;
pub mod region;
pub mod regular;
pub mod ring;
mod signs;
pub mod solve;
pub mod top;
pub mod turning;

pub use certify::{Again, AtValence, Eigenvector, Ground, at_valence, at_valence_within, decimal};
pub use curvature::{Curvature, Second, Size};
pub use every::{Condition, Every, every, strict_sign};
pub use reason::{BorderGround, Requirement, VertexReason};

use crate::answer::Verdict;

/// The verdict on all valences together, and on those that one proof covers.
#[must_use]
pub fn overall(found: &[AtValence], every: Option<&Every>) -> Verdict {
    let common = every.map(|e| if e.proved() { Verdict::Proved } else { Verdict::Undetermined });
    let count = found.len() + usize::from(every.is_some());
    Verdict::all(count, found.iter().map(|f| f.smooth).chain(common))
}
