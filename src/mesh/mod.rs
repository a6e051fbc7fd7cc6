//! Meshes as people have them: the limit surface of these very points, at every vertex and on every patch
//! (docs/theory.md, “Meshes”).
//!
//! [`Model`] reads a file, [`certify()`] proves what holds of it.
//!
//! ```
//! use secant::{answer::Verdict, budget::Budget, diagnostic::SourceText, mesh};
//! let octahedron = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
//!     f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
//! let model = mesh::Model::parse(&SourceText::new("octahedron.obj", octahedron), false)?;
//! let found = mesh::certify(&model, mesh::Scheme::CatmullClark, &Budget::default(), &|| {})?;
//! assert_eq!(found.regular(), Verdict::Proved);
//! # Ok::<(), secant::diagnostic::Problem>(())
//! ```
#![deny(clippy::disallowed_methods)]

mod binary;
mod border;
mod certify;
mod disc;
mod fan;
mod formats;
mod found;
mod interval;
mod limit;
mod number;
mod open;
mod patch;
mod read;
mod refine;
mod scheme;
mod soft;
mod step;
mod tags;
mod tail;
mod topology;
mod vertices;

pub use border::{BorderStencil, Fan, Points};
pub use certify::certify;
pub use disc::immersed_disc;
pub use fan::{Ground, Row};
pub use found::{AtVertex, Bad, Found, Patches, Reason, Spot};
pub use interval::Float;
pub use limit::{Limit, Stencil};
pub use number::{Number, Numbers};
pub use patch::Regular;
pub use read::{MAX_BYTES, MAX_FACES, Model, Point, is_mesh};
pub use refine::{Kind, refined};
pub use scheme::Scheme;
pub use tags::{Boundary, Tags};
pub use tail::Rings;
pub use topology::{Fault, Frame, Star, Topology};

/// As [`each`], for work that is worth a thread by itself.
pub(crate) fn each_one<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        items.par_iter().map(f).collect()
    }
    #[cfg(not(feature = "parallel"))]
    items.iter().map(f).collect()
}

/// `f` of all items, in their order, on all threads.
pub(crate) fn each<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        items.par_iter().with_min_len(16).map(f).collect()
    }
    #[cfg(not(feature = "parallel"))]
    items.iter().map(f).collect()
}
