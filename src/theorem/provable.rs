//! What is done over the rationals only, and what takes its place over a real number field.

use super::branch::Context;
use super::claim::{Assertion, Claim, Reason};
use super::cone_over::cones_over;
use super::dense::DenseClaim;
use super::graph::graph_over_parameter;
use super::verdict::Certified;
use super::{ModelError, own_enclosures, parameter, rational_contraction, word_contraction};
use crate::algebraic::Real;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::radius::{Options, Radial};
use crate::shape::{Balls, CellKind, Contraction, Shape, Spaces};
use crate::statement::Statement;

/// Binary digits of the rational entries from which cones are proposed.
const NEAR: u64 = 48;

/// Entries of shapes of which something can be proved.
pub trait Provable: Radial {
    /// Whether a checked shape contracts; with an upper bound below 1 of the joint spectral radius of the linear parts where that
    /// is known, but nothing that encloses the attractor.
    ///
    /// # Errors
    /// [`ModelError::Expands`] with a cycle that does not contract.
    fn contraction(shape: &Shape<Self>, budget: &Budget) -> Result<(Contraction, Option<Rational>), ModelError>;
    /// Balls that hold the attractors.
    fn balls(shape: &Shape<Self>, spaces: &Spaces<Self>, contraction: &Contraction) -> Option<Balls<Self>>;
    /// Polygons or polytopes that hold the attractors besides the balls.
    fn enclosures(shape: &Shape<Self>, spaces: &Spaces<Self>, balls: &Balls<Self>) -> Option<Balls<Self>>;
    /// All joints of all levels, where Theorem 5 does not apply.
    fn by_frames(cx: &Context<Self>, found: &mut Certified<Self>) -> DenseClaim;
    /// What is said of every point of a curve, and of its uniform parameter.
    fn everywhere(cx: &Context<Self>, found: &mut Certified<Self>);
}

impl Provable for Rational {
    fn contraction(shape: &Shape, budget: &Budget) -> Result<(Contraction, Option<Rational>), ModelError> {
        rational_contraction(shape, budget)
    }

    fn balls(shape: &Shape, spaces: &Spaces, contraction: &Contraction) -> Option<Balls> {
        Balls::of(shape, spaces, contraction)
    }

    fn enclosures(shape: &Shape, spaces: &Spaces, balls: &Balls) -> Option<Balls> {
        own_enclosures(shape, spaces, balls)
    }

    fn by_frames(cx: &Context, found: &mut Certified) -> DenseClaim {
        super::dense::by_frames(cx, found)
    }

    fn everywhere(cx: &Context, found: &mut Certified) {
        if cx.shape.states[cx.shape.start].kind == CellKind::Edge {
            found.parameter = parameter::parameter(cx);
            found.everywhere = super::everywhere::everywhere(cx, found);
            parameter::adopt_derivative(found);
        }
        parameter::add_claims(found);
    }
}

impl Provable for Real {
    fn contraction(shape: &Shape<Self>, budget: &Budget) -> Result<(Contraction, Option<Rational>), ModelError> {
        Ok((word_contraction(shape, budget)?, None))
    }

    fn balls(shape: &Shape<Self>, spaces: &Spaces<Self>, contraction: &Contraction) -> Option<Balls<Self>> {
        match contraction {
            Contraction::Proved(proof) => Some(Balls::of_words(shape, spaces, proof)),
            _ => None,
        }
    }

    fn enclosures(shape: &Shape<Self>, _: &Spaces<Self>, balls: &Balls<Self>) -> Option<Balls<Self>> {
        Some(balls.with_simplex(shape)).filter(Balls::in_simplex)
    }

    fn by_frames(_: &Context<Self>, _: &mut Certified<Self>) -> DenseClaim {
        DenseClaim::default()
    }

    fn everywhere(cx: &Context<Self>, found: &mut Certified<Self>) {
        let start = cx.shape.start;
        if cx.shape.states[start].kind == CellKind::Edge && cx.spaces.of(start).basis.cols() > 0 {
            let broken = found.points.iter().position(super::everywhere::breaks);
            if broken.is_none() {
                found.cones = cones_over(cx, &cx.shape.rounded(NEAR));
            }
            found.parameter = parameter::parameter(cx);
            let rough = found.parameter.as_ref().is_some_and(parameter::Parameter::is_not_c1);
            if broken.is_none() && found.cones.is_none() && !rough && super::everywhere::is_small(cx) {
                found.graph = graph_over_parameter(cx.shape, cx.spaces, &Options::default()).map(Box::new);
            }
            found.claims.push(match (broken, &found.cones, &found.graph) {
                (Some(k), ..) => Claim::refuted(Assertion::G1, None, Reason::Broken(k)),
                (None, Some(_), _) => Claim::proved(Assertion::G1, Some(Statement::Theorem6)),
                (None, None, Some(_)) => Claim::proved(Assertion::G1, Some(Statement::Graph)),
                (None, None, None) => Claim::open(Assertion::G1, Reason::NoCone),
            });
            found.claims.extend(found.parameter.iter().flat_map(parameter::Parameter::claims));
        }
        found.claims.sort_by_key(|c| c.what.topic());
    }
}
