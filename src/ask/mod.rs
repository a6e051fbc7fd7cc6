//! What the commands answer, as text and as data: for the program, and for bindings to other languages.
//!
//! Each answer comes with its certificate where one is asked for, accepted by the independent checker.

mod answered;
mod border;
mod lattice;
mod radius;
mod region;
mod region_plane;
mod region_vertex;
mod regularity;
mod solve;
mod spectra;

pub use answered::{Answered, Checked, Evidence, NOT_ASKED, ONCE, answered};
pub use radius::{Radius, radius};
pub use region::{Asked, DEPTH, Family, MAX_DEPTH, Regions, RegionsOfCurve, curve_regions, regions, regions_of_case};
pub use region_plane::{RegionsInPlane, plane_regions, plane_regions_of_case};
pub use region_vertex::{RegionsAtVertices, vertex_regions, vertex_regions_of_case};
pub use regularity::{Smooth, certified_regularity, dilated_regularity, regularity, regularity_of_case};
pub use solve::{Solved, solve, unsolvable};
pub use spectra::{Entries, ExactSpectrum, Matrices, Named, exact_spectrum};
