//! Exact proofs of where self-similar shapes have tangents.
//!
//! What `secant certify` does, as a library: read a question, have it proved, look at the answer, write the proof and the
//! picture, and have the verdict proved again by the independent checker. The verdict is that of the program on every case.
//!
//! ```
//! use secant::prelude::*;
//!
//! let question = Question::read("cases/classical/takagi.toml".as_ref())?;
//! let mut findings = prove(&question, &Budget::default())?;
//! for claim in findings.claims() {
//!     println!("{}: {}", claim.verdict(), claims::assertion(&claim.what));
//! }
//! let html = html::render(&findings::proof(&findings));
//! let certificate = confirm(&mut findings)?;
//! # // The tangent lines are proved; cusps are against G¹.
//! # assert_eq!(findings.verdict(), Verdict::Proved);
//! # assert!(html.contains("<math") && certificate.text().starts_with('{'));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The evidence is data: here the points of a curve, and its picture.
//!
//! ```
//! use secant::prelude::*;
//!
//! let question = Question::read("cases/classical/takagi.toml".as_ref())?;
//! let Findings::Tangents { case, found } = prove(&question, &Budget::default())? else { unreachable!("a curve") };
//! for point in &found.points {
//!     println!("{}: {}", point.branches[0].address, point.kind.word());
//! }
//! let svg = figures::attractor(&case, &found).map(|picture| picture.svg);
//! # assert!(svg.is_some());
//! # assert_eq!(found.points[2].kind, Kind::Cusp);
//! # Ok::<(), Problem>(())
//! ```
//!
//! A shape can also be made in the program, without a file:
//!
//! ```
//! use secant::arith::ratio;
//! use secant::linalg::Matrix;
//! use secant::prelude::*;
//! use secant::shape::{CellKind, Complex, Shape};
//!
//! // The uniform quadratic B-spline: operators on columns of barycentric coordinates.
//! let quarters = |rows: [[i64; 3]; 3]| Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 4));
//! let pieces = vec![quarters([[3, 1, 0], [1, 3, 3], [0, 0, 1]]), quarters([[1, 0, 0], [3, 3, 1], [0, 1, 3]])];
//! let shape = Complex::of_curves(Shape::single(CellKind::Edge, pieces));
//! assert_eq!(prove(&Question::of_complex("b-spline", &shape)?, &Budget::default())?.verdict(), Verdict::Proved);
//! # Ok::<(), Problem>(())
//! ```
//!
//! The modules in the order of the argument: [`arith`], [`poly`], [`linalg`], [`algebraic`], [`jordan`], [`shape`],
//! [`theorem`], [`certificate`], [`report`]; [`case`] reads files, [`scheme`] makes shapes from masks and mesh rules, and
//! [`prove`](mod@prove) is the one door.
#![warn(clippy::float_arithmetic)]

pub mod answer;
pub mod approx;
pub mod ask;
pub mod budget;
pub mod case;
pub mod certificate;
#[cfg(feature = "cli")]
pub mod cli;
pub mod diagnostic;
pub mod escape;
pub mod glossary;
pub mod guard;
pub mod junction;
pub mod laws;
pub mod mesh;
pub mod picture;
pub mod prove;
pub mod radius;
pub mod replay;
pub mod report;
pub mod scheme;
pub mod shape;
pub mod statement;
#[cfg(feature = "strategies")]
pub mod strategies;
#[cfg(feature = "studio")]
pub mod studio;
pub mod theorem;
pub mod vertex;

pub use secant_exact::{algebraic, arith, jordan, linalg, parallel, poly, ring, stop};

pub use prove::{Findings, prove};

/// What most programs need: reading, proving, reporting, confirming.
pub mod prelude {
    pub use crate::answer::Verdict;
    pub use crate::budget::{Budget, Effort};
    pub use crate::case::{Question, Subject};
    pub use crate::diagnostic::Problem;
    pub use crate::prove::{Findings, confirm, prove};
    pub use crate::report::{claims, figures, findings, html, json, latex, markdown};
    pub use crate::theorem::{Certified, Claim, Kind, PointReport};
}
