//! For which values of a parameter in the weights a rule on meshes is C¹ at a vertex of one valence.
//!
//! The eigenvalues are enclosed for all values of an interval at once (`leader`), and so are the signs on the ring (`judge`);
//! where two moduli meet, the value is a root of one polynomial (`tie`). `cover` goes through the range. The statement is
//! *Vertices of a family*.

mod cover;
mod judge;
mod leader;
mod model;
mod tie;

pub use model::RuleFamily;

use crate::algebraic::{Root, lies_within};
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::scheme::SchemeError;
use crate::statement::Statement;
use crate::vertex::Ground;
use crate::vertex::regular::Regular;
use model::Model;
use std::time::Duration;
use thiserror::Error;

/// Why a rule with a parameter has no region.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RegionError {
    /// The rule cannot be built at a value of the range.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// The rule cannot be read at a value of the range.
    #[error("{0}")]
    Member(String),
    /// A range whose ends are not in order.
    #[error("the range is empty: its first number must be below the second")]
    Range,
    /// The parameter changes more than the weights at the centre.
    #[error(
        "the parameter changes the rule away from the centre, and regions are found where it changes the weights at the centre only"
    )]
    Everywhere,
    /// The weights are no polynomials in the parameter of the degree of the expressions.
    #[error("the entries of the subdivision matrix are no polynomials in the parameter")]
    Polynomial,
    /// No bounds of the rule away from the centre.
    #[error("no bounds of the rule away from the centre were found (Lemma 4)")]
    Regular,
    /// 1 is no eigenvalue.
    #[error("the weights of a new point do not add up to 1 for every value of the parameter")]
    One,
}

/// How long the search goes on. What is left when it ends is not decided.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Parts that are narrower are left.
    pub width: Rational,
    /// Intervals that are examined.
    pub windows: usize,
    /// A guard by the clock.
    pub time: Option<Duration>,
}

/// What is known on a part of the range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finding {
    /// What holds at each value. [`Ground::Sectors`] is also said of a pair that is not real and leads in block 0 or n/2.
    By(Ground),
    /// Nothing is claimed.
    Open(Gap),
}

/// Why nothing is claimed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gap {
    /// Two leading eigenvalues, or the signs on the ring, do not separate on a part that is as narrow as was asked for.
    Narrow,
    /// The leading eigenvalues have one modulus for every value.
    Same,
    /// One eigenvector of block 0 or n/2 leads for a rule without Bézier patches; its function on the ring is not examined.
    Ring,
    /// A single value at which leading eigenvalues meet that no statement covers.
    Meeting,
    /// As many intervals were examined as the limits allow.
    Work,
    /// The time is over.
    Clock,
}

impl Finding {
    /// The verdict on C¹ for almost all control points.
    #[must_use]
    pub fn verdict(self) -> Verdict {
        match self {
            Self::By(ground) => ground.verdict(),
            Self::Open(_) => Verdict::Undetermined,
        }
    }

    /// The statement about single rules that holds at each value.
    #[must_use]
    pub fn statement(self) -> Option<Statement> {
        match self {
            Self::By(ground) => Some(ground.statement()),
            Self::Open(_) => None,
        }
    }
}

/// An open interval, or a point where both ends are the same.
#[derive(Debug, Clone)]
pub struct Part {
    /// The lower end.
    pub from: Root,
    /// The upper end.
    pub to: Root,
    /// What is known of it.
    pub finding: Finding,
}

impl Part {
    /// Whether it is a single point.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.from.same(&self.to)
    }
}

/// What is known at one valence.
#[derive(Debug, Clone)]
pub struct VertexRegion {
    /// The valence.
    pub valence: usize,
    /// The parts, ascending; together they are the range.
    pub parts: Vec<Part>,
    /// How many intervals were examined.
    pub windows: usize,
}

impl VertexRegion {
    /// What is said of a value of the range.
    #[must_use]
    pub fn at(&self, p: &Root) -> Option<Finding> {
        self.parts.iter().find(|part| lies_within(p, &part.from, &part.to)).map(|part| part.finding)
    }
}

/// Where in a closed range a rule with a parameter is C¹ at a vertex (for dual schemes: in a face) of one valence, for almost all
/// control points.
///
/// # Errors
/// [`RegionError`].
///
/// # Examples
/// ```
/// use secant::{algebraic::Root, answer::Verdict, arith::ratio, budget::Budget, scheme::mesh_rule};
/// use secant::vertex::region::{Limits, RuleFamily, region};
/// let member = |beta: &_| Ok(mesh_rule("loop-variant", &[("beta".to_owned(), Clone::clone(beta))].into())?);
/// let family = RuleFamily { range: (ratio(1, 10), ratio(1, 5)), degree: 1, member: &member };
/// let limits = Limits { width: ratio(1, 1_000_000), windows: 1000, time: None };
/// let found = region(&family, 3, &limits, &Budget::default())?;
/// let at = |p, q| found.at(&Root::from_rational(&ratio(p, q))).map(|f| f.verdict());
/// // 1/8 < β < 7/24.
/// assert_eq!((at(1, 8), at(12_501, 100_000)), (Some(Verdict::Refuted), Some(Verdict::Proved)));
/// # Ok::<(), secant::vertex::region::RegionError>(())
/// ```
///
/// # Cost
/// A few enclosures of eigenvalues for each interval that is examined, and the signs on the ring.
pub fn region(
    family: &RuleFamily<'_>,
    valence: usize,
    limits: &Limits,
    budget: &Budget,
) -> Result<VertexRegion, RegionError> {
    if family.range.0 >= family.range.1 {
        return Err(RegionError::Range);
    }
    let model = Model::new(family, valence)?;
    if model.vertex.rule.info().spline.is_none() && Regular::of(&model.vertex.rule).is_none() {
        return Err(RegionError::Regular);
    }
    Ok(cover::cover(&model, family, limits, budget))
}
