//! Junctions of two surfaces (thesis, §5.2): a strip of intermediate faces that begins like one face scheme and ends like another.
//!
//! Both schemes are tensor products of curves. Across the border the intermediate face is divided as the intermediate curve of two
//! curves is, along it as the schemes are; all identities are solved by stencils for the refined points that no side edge gives
//! ([`SurfaceJunction`]). [`find`] fills them in and checks them.

mod family;
mod grid;
mod member;
mod strip;

pub use family::{Free, SurfaceJunction};
pub use member::{Choice, Plan, SurfaceCheck, SurfaceFound, SurfaceMember, find};

use super::{JunctionError, Side};
use thiserror::Error;

/// Most points of a face and of its refinement.
const MAX_POINTS: usize = 400;

/// A face scheme: the tensor product of a curve across the border and one along it.
#[derive(Debug, Clone)]
pub struct FaceSide {
    /// What it is called.
    pub name: String,
    /// The curve across the border.
    pub across: Side,
    /// The curve along it.
    pub along: Side,
}

/// Why two face schemes cannot be joined as was asked.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SurfaceError {
    /// As for curves.
    #[error(transparent)]
    Curve(#[from] JunctionError),
    /// Numbers of pieces that differ: across and along, left and right.
    #[error("the curves of the two face schemes have {} pieces; all need the same number", .0.map(|n| n.to_string()).join(", "))]
    Arity([usize; 4]),
    /// A piece that runs backwards.
    #[error("{0}: a face scheme is joined only where no piece of its curves runs backwards")]
    Backwards(String),
    /// Stencils that do not fit.
    #[error("{0}")]
    Stencil(String),
    /// Too many points.
    #[error("the intermediate face needs {0} points, which is over the limit of {limit}", limit = MAX_POINTS)]
    Large(usize),
}

impl FaceSide {
    /// A tensor product as a face scheme.
    ///
    /// # Errors
    /// [`SurfaceError::Backwards`].
    pub fn new(name: &str, across: Side, along: Side) -> Result<Self, SurfaceError> {
        if across.reversed.contains(&true) || along.reversed.contains(&true) {
            return Err(SurfaceError::Backwards(name.to_owned()));
        }
        Ok(Self { name: name.to_owned(), across, along })
    }
}
