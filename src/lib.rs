//! Exact proofs of where self-similar shapes have tangents.
//!
//! What `secant certify` does, as a library: read a case, certify it, look at the points, write the proof and the picture,
//! and have the verdict proved again by the independent checker.
//!
//! ```
//! use secant::prelude::*;
//!
//! let case = Case::read("cases/classical/takagi.toml".as_ref())?;
//! let found = certify(&case.shape, &case.examine)?;
//! assert_eq!(found.verdict, Verdict::Proved);
//! for point in &found.points {
//!     println!("{}: {}", point.branches[0].address, point.kind.word());
//! }
//! let html = html::render(&proof::document(&case, &found));
//! let svg = figures::attractor(&case, &found).map(|picture| picture.svg);
//! let certificate = confirm(&case, &found)?;
//! # assert!(html.contains("<math") && svg.is_some() && certificate.text().starts_with('{'));
//! # assert_eq!(found.points[2].kind, Kind::Cusp);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A shape can also be made in the program, without a file:
//!
//! ```
//! use secant::arith::ratio;
//! use secant::linalg::Matrix;
//! use secant::prelude::*;
//! use secant::shape::{CellKind, Shape};
//!
//! // The uniform quadratic B-spline: operators on columns of barycentric coordinates.
//! let quarters = |rows: [[i64; 3]; 3]| Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 4));
//! let pieces = vec![quarters([[3, 1, 0], [1, 3, 3], [0, 0, 1]]), quarters([[1, 0, 0], [3, 3, 1], [0, 1, 3]])];
//! let found = certify(&Shape::single(CellKind::Edge, pieces), &[])?;
//! assert!(found.points.iter().all(|point| point.verdict == Verdict::Proved));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The modules in the order of the argument: [`arith`], [`poly`], [`linalg`], [`algebraic`], [`jordan`], [`shape`],
//! [`theorem`], [`certificate`], [`report`]; [`case`] reads files, [`scheme`] makes shapes from masks and mesh rules.
#![warn(clippy::float_arithmetic)]

pub mod answer;
pub mod approx;
pub mod case;
pub mod certificate;
pub mod cli;
pub mod diagnostic;
pub mod guard;
pub mod laws;
pub mod picture;
pub mod radius;
pub mod report;
pub mod scheme;
pub mod shape;
pub mod statement;
#[cfg(feature = "strategies")]
pub mod strategies;
pub mod theorem;
pub mod vertex;

pub use secant_exact::{algebraic, arith, jordan, linalg, poly};

/// What most programs need: reading, certifying, reporting, confirming.
pub mod prelude {
    pub use crate::case::Case;
    pub use crate::certificate::confirm;
    pub use crate::report::{figures, html, json, latex, markdown, proof};
    pub use crate::theorem::{Certified, Kind, PointReport, Verdict, certify};
}
