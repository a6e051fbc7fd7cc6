//! Theorem 6 for a whole curve: a tangent that turns continuously, half-tangents at every point, or a point without a tangent.

use super::branch::Context;
use super::components::{Components, components};
use super::cone::{CommonCone, ConeAnswer, ConeObstacle, common_cone, most_pieces};
use super::dense::first_level_joint;
use super::gap::EveryGap;
use super::graph::{graph_over_parameter, graph_over_shares};
use super::hodograph::{Hodograph, hodograph};
use super::parameter::Parameter;
use super::smoothness::CurveOrder;
use super::verdict::{Certified, Kind, PointReport, Role, Verdict};
use super::{add_point, point, shortest_paths};
use crate::arith::Rational;
use crate::jordan::Scalar;
use crate::radius::Options;
use crate::shape::{Address, CellKind, Shape, Spaces};
use crate::statement::Statement;

/// What is known of every point of a curve, not only of a dense set.
///
/// The verdict is about the claim *G¹*: there is a tangent line at every point, both rays of which exist and are opposite
/// inside the curve, and it turns continuously.
#[derive(Debug, Clone)]
pub struct Everywhere {
    /// The verdict on G¹.
    pub verdict: Verdict,
    /// The cones: with them both half-tangents exist at every point, and tangent lines at every point that is no joint.
    pub cone: Option<CommonCone>,
    /// Whether all this is known of the projected curve too: there are no control points, or a functional sees the cones.
    pub seen: bool,
    /// The first-level joints of all reachable states, where cones were found.
    pub joints: Vec<EveryJoint>,
    /// A lower bound of the Hölder exponent of the tangent in the uniform parameter, where cones shrink geometrically.
    pub exponent: Option<Rational>,
    /// A cycle that admits no strictly invariant cone.
    pub obstacle: Option<ConeObstacle>,
    /// The index in [`Certified::points`] of a point that refutes G¹.
    pub witness: Option<usize>,
    /// The derivative of a polynomial curve, where it decides.
    pub hodograph: Option<Hodograph>,
    /// Order 1 of a curve that is a graph over a parameter (Theorem 12), where nothing else decides.
    pub derivative: Option<Box<CurveOrder>>,
    /// A proof by components (Theorem 13), where nothing else decides.
    pub components: Option<Box<Components>>,
    /// Why the verdict is not `Proved`.
    pub reason: Option<EveryGap>,
}

impl Everywhere {
    /// The statement that proves G¹; `None` where a point refutes it, or where it is open.
    #[must_use]
    pub fn statement(&self) -> Option<Statement> {
        match (self.verdict, &self.hodograph, &self.derivative, &self.cone) {
            (Verdict::Undetermined, ..) => None,
            (_, Some(_), ..) => Some(Statement::Theorem6Polynomial),
            (Verdict::Refuted, ..) => None,
            (_, _, Some(_), _) => Some(Statement::Graph),
            _ if self.components.is_some() => Some(Statement::Components),
            (_, _, _, cone) => cone.as_ref().map(CommonCone::statement),
        }
    }
}

/// A first-level joint of a state, seen so that no direction of the visible quotient is lost.
#[derive(Debug, Clone)]
pub enum EveryJoint {
    /// A point of [`Certified::points`], by index: the map to where the shape is looked at is injective on the quotient.
    Listed(usize),
    /// The joint in the visible quotient of its own state.
    Own(Box<PointReport>),
}

impl EveryJoint {
    /// What was found there.
    #[must_use]
    pub fn report<'a>(&'a self, found: &'a Certified) -> &'a PointReport {
        match self {
            Self::Listed(k) => &found.points[*k],
            Self::Own(report) => report,
        }
    }
}

/// Looks for common cones and decides G¹; `None` for shapes that are no curves or single points.
pub fn everywhere(cx: &Context, found: &mut Certified) -> Option<Everywhere> {
    let edges = cx
        .shape
        .reachable()
        .into_iter()
        .all(|e| cx.shape.states[e].kind == CellKind::Edge && cx.spaces.of(e).basis.cols() > 0);
    if !edges {
        return None;
    }
    // Where a point has no half-tangent, or both rays agree, no cone exists before the projection.
    let hopeless = cx.shape.control.is_none() && found.points.iter().any(has_no_cone) || found.similarities.is_some();
    let answer =
        if hopeless { Some(ConeAnswer::Undetermined) } else { common_cone(cx.shape, cx.spaces, cx.budget.cone_steps) };
    let every = match answer? {
        ConeAnswer::Proved(cone) => with_cone(cx, found, cone),
        ConeAnswer::Refuted(obstacle) => without_cone(cx, found, Some(obstacle)),
        ConeAnswer::Undetermined => without_cone(cx, found, None),
    };
    let every = if every.verdict == Verdict::Undetermined { by_derivative(cx, found, every) } else { every };
    let open = |every: &Everywhere| every.verdict == Verdict::Undetermined;
    let rough = found.parameter.as_ref().is_some_and(Parameter::is_not_c1);
    let every = if open(&every) && !rough { as_graph(cx, every, graph_over_parameter) } else { every };
    let every = if open(&every) { as_graph(cx, every, graph_over_shares) } else { every };
    Some(if open(&every) { by_components(cx, every) } else { every })
}

/// Proves G¹ of a curve state by state.
fn by_components(cx: &Context, every: Everywhere) -> Everywhere {
    match components(cx, every.cone.is_none()) {
        Some(parts) if every.witness.is_none() => {
            Everywhere { verdict: Verdict::Proved, reason: None, components: Some(Box::new(parts)), ..every }
        }
        _ => every,
    }
}

/// Decides G¹ of a polynomial curve by the zeros of its derivative.
fn by_derivative(cx: &Context, found: &mut Certified, every: Everywhere) -> Everywhere {
    let Some(hodograph) = hodograph(cx) else { return every };
    let (verdict, reason) = match hodograph.turns.first() {
        None => (Verdict::Proved, None),
        Some(_) => (Verdict::Refuted, Some(EveryGap::Turn)),
    };
    let address = hodograph.turns.iter().find_map(|turn| hodograph.address(cx, turn));
    let spec =
        address.and_then(|a| a.normalise(cx.shape, cx.from.root()).ok()).and_then(|a| point::address_spec(cx, &a));
    let known = spec.as_ref().and_then(|s| {
        found.points.iter().position(|p| p.role == s.role && p.branches.iter().all(|b| b.address == s.branches[0].1))
    });
    let witness = known.or_else(|| add_point(cx, spec, found)).filter(|&k| breaks(&found.points[k]));
    Everywhere { verdict, reason, witness, hodograph: Some(hodograph), ..every }
}

/// Largest number of coordinates of a state, and most states, for which this is tried.
const MAX_GRAPH: (usize, usize) = (12, 6);

/// A way of looking for a parameter.
type Graph = fn(&Shape, &Spaces, &Options) -> Option<CurveOrder>;

/// Whether that is tried.
pub(super) fn is_small<E: Scalar>(cx: &Context<E>) -> bool {
    let states = cx.shape.reachable();
    states.len() <= MAX_GRAPH.1 && states.iter().all(|&e| cx.shape.states[e].dim <= MAX_GRAPH.0)
}

/// Proves G¹ of a curve that is a graph over a parameter.
fn as_graph(cx: &Context, every: Everywhere, graph: Graph) -> Everywhere {
    let order = if is_small(cx) { graph(cx.shape, cx.spaces, &Options::default()) } else { None };
    match order {
        Some(order) if every.witness.is_none() => {
            Everywhere { verdict: Verdict::Proved, reason: None, derivative: Some(Box::new(order)), ..every }
        }
        _ => every,
    }
}

/// Whether a point contradicts invariant cones.
fn has_no_cone<E: Scalar>(p: &PointReport<E>) -> bool {
    match p.verdict {
        Verdict::Refuted => p.kind != Kind::Corner,
        Verdict::Proved => matches!(p.kind, Kind::Cusp | Kind::Oscillating),
        Verdict::Undetermined => false,
    }
}

/// Whether a point refutes G¹.
pub(super) fn breaks<E: Scalar>(p: &PointReport<E>) -> bool {
    p.verdict == Verdict::Refuted || has_no_cone(p)
}

fn with_cone(cx: &Context, found: &Certified, cone: CommonCone) -> Everywhere {
    let seen = cx.shape.control.is_none() || cone.view.is_some();
    let witness = found.points.iter().position(breaks);
    let examined = if witness.is_none() { joints(cx, found) } else { Some(Vec::new()) };
    let complete = examined.is_some();
    let joints = examined.unwrap_or_else(Vec::new);
    let regular = |p: &PointReport| p.verdict == Verdict::Proved && p.kind == Kind::Regular;
    let agree = complete && joints.iter().all(|j| regular(j.report(found)));
    let exponent = cone.rate.as_ref().and_then(|r| r.exponent(most_pieces(cx.shape)));
    let (verdict, reason) = match witness {
        Some(k) => (Verdict::Refuted, Some(EveryGap::Broken(k))),
        None if !seen => (Verdict::Undetermined, Some(EveryGap::Unseen)),
        None if agree => (Verdict::Proved, None),
        None => (Verdict::Undetermined, Some(EveryGap::Joint)),
    };
    let exponent = exponent.filter(|_| verdict == Verdict::Proved);
    Everywhere {
        verdict,
        cone: Some(cone),
        seen,
        joints,
        exponent,
        obstacle: None,
        witness,
        hodograph: None,
        derivative: None,
        components: None,
        reason,
    }
}

/// The first-level joints of all reachable states; what was examined already is used where nothing is lost in it.
fn joints(cx: &Context, found: &Certified) -> Option<Vec<EveryJoint>> {
    let mut out = Vec::new();
    for state in cx.shape.reachable() {
        let space = cx.spaces.of(state);
        let injective = |path: &[usize]| {
            let (op, _) = cx.shape.product(cx.from.root(), path);
            (&(cx.from.map() * &op) * &space.basis).rank() == space.visible.rows()
        };
        for pair in point::joint_pairs(cx, state) {
            let listed = found.points.iter().position(|p| match &p.role {
                Role::Joint { path, state: e, left, right } => {
                    (*e, (*left, *right)) == (state, pair) && injective(path)
                }
                _ => false,
            });
            match listed {
                Some(k) => out.push(EveryJoint::Listed(k)),
                None => out.push(EveryJoint::Own(Box::new(first_level_joint(cx, state, pair)?))),
            }
        }
    }
    Some(out)
}

fn without_cone(cx: &Context, found: &mut Certified, obstacle: Option<ConeObstacle>) -> Everywhere {
    let mut witness = found.points.iter().position(breaks);
    if let (None, Some(obstacle)) = (witness, &obstacle) {
        witness = periodic_point(cx, obstacle, found).filter(|&k| breaks(&found.points[k]));
    }
    let (verdict, reason) = match (witness, &obstacle) {
        (Some(k), _) => (Verdict::Refuted, EveryGap::Broken(k)),
        (None, Some(_)) => (Verdict::Undetermined, EveryGap::Obstacle),
        (None, None) => (Verdict::Undetermined, EveryGap::NoCone),
    };
    let reason = Some(reason);
    Everywhere {
        verdict,
        cone: None,
        seen: false,
        joints: Vec::new(),
        exponent: None,
        obstacle,
        witness,
        hodograph: None,
        derivative: None,
        components: None,
        reason,
    }
}

/// Examines the point with the address of an obstacle.
fn periodic_point(cx: &Context, obstacle: &ConeObstacle, found: &mut Certified) -> Option<usize> {
    let (path, _) = shortest_paths(cx.shape).into_iter().find(|(_, e)| *e == obstacle.state)?;
    let address = Address { prefix: path, cycle: obstacle.word.clone() }.normalise(cx.shape, cx.from.root()).ok()?;
    let spec = point::address_spec(cx, &address)?;
    let known = found.points.iter().position(|p| match (&p.role, &spec.role) {
        (Role::Interior, Role::Interior) => p.branches[0].address == address,
        (a, b) => a == b,
    });
    known.or_else(|| add_point(cx, Some(spec), found))
}
