//! The joint spectral radius of finite sets and automata of matrices (theory §11), rational or over a real number field, with
//! exact proofs.
//!
//! Floats propose words, polytopes and coefficients; exact arithmetic decides every bound.
#![deny(clippy::disallowed_methods)]

mod answer;
mod balanced;
mod blocks;
mod budget;
mod closing;
mod contracts;
mod disc;
mod driver;
mod enclose;
mod exact;
pub mod family;
pub mod file;
mod fixed;
mod float;
mod grow;
mod invariant;
mod leading;
mod norms;
mod polytope;
mod quadratic;
mod radial;
mod radius_field;
mod search;
mod simplex;
mod strategy;
mod sums;
mod system;
mod tree;
mod turning;
mod whole;

pub use answer::{BlockProof, Ended, Growth, JointRadius, Proof};
pub use balanced::{Balanced, Complex, ComplexInclusion, ComplexPoint};
pub use blocks::{Block, Step, blocks, flag};
pub use budget::Options;
pub use contracts::{NormContraction, contraction_by_norms, linear_system, polytopes};
pub use disc::Disc;
pub use driver::joint_radius;
pub use exact::LeadingVector;
pub use grow::Origin;
pub use leading::{Eigenvector, Leading, Lower, root_floor, square_root};
pub use polytope::{Inclusion, Point, Polytope};
pub use quadratic::{Quadratic, definite};
pub use radial::Radial;
pub use simplex::Body;
pub(crate) use simplex::{ConeBasis, InCone, cone_combination, in_cone, tells_apart};
pub use system::{Arrow, System, SystemError};
pub use tree::Tree;
