//! The joint spectral radius of finite sets and automata of rational matrices (theory §11), with exact proofs.
//!
//! Floats propose words, polytopes and coefficients; exact arithmetic decides every bound.

mod blocks;
mod driver;
mod exact;
pub mod file;
mod float;
mod grow;
mod leading;
mod polytope;
mod quadratic;
mod search;
mod simplex;
mod system;

pub use blocks::{Block, blocks};
pub use driver::{BlockProof, Growth, JointRadius, Options, Proof, joint_radius};
pub use exact::LeadingVector;
pub use grow::Origin;
pub use leading::{Eigenvector, Lower};
pub use polytope::{Inclusion, Point, Polytope};
pub use quadratic::Quadratic;
pub use simplex::Body;
pub use system::{Arrow, System, SystemError};
