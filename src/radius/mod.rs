//! The joint spectral radius of finite sets and automata of rational matrices (theory §11), with exact proofs.
//!
//! Floats propose words, polytopes and coefficients; exact arithmetic decides every bound.

mod balanced;
mod blocks;
mod contracts;
mod driver;
mod enclose;
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
mod tree;

pub use balanced::{Balanced, Complex, ComplexInclusion, ComplexPoint};
pub use blocks::{Block, Step, blocks, flag};
pub use contracts::{NormContraction, contraction_by_norms, linear_system, polytopes};
pub use driver::{BlockProof, Growth, JointRadius, Options, Proof, joint_radius};
pub use exact::LeadingVector;
pub use grow::Origin;
pub use leading::{Eigenvector, Lower, root_floor, square_root};
pub use polytope::{Inclusion, Point, Polytope};
pub use quadratic::Quadratic;
pub use simplex::Body;
pub(crate) use simplex::cone_combination;
pub use system::{Arrow, System, SystemError};
pub use tree::Tree;
