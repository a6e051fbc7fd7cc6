//! Every point of a curve by its strongly connected components (theory §11, Theorem 13): states with cones, loops that approach
//! their fixed point along one eigenvector, and states that are passed once.

use super::branch::Context;
use super::cone::{Code, CommonCone, ConeAnswer, common_cone, cone_in_sight};
use super::frames::{MAX_CODE, MAX_CODE_LENGTH};
use super::point;
use super::slow::SlowCycle;
use super::verdict::{Kind, PointReport, Verdict};
use super::viewpoint::Viewpoint;
use crate::linalg::Matrix;
use crate::shape::{Address, Shape};

/// Why a state is G¹.
#[derive(Debug, Clone)]
pub enum Component {
    /// Cones of all states that it reaches.
    Cones {
        /// The state.
        state: usize,
        /// The cones.
        cone: CommonCone,
        /// The first-level joints of all states that it reaches, each in its own visible quotient.
        joints: Vec<PointReport>,
    },
    /// One piece leads back.
    Loop {
        /// The state.
        state: usize,
        /// The piece that leads back.
        letter: usize,
        /// Its eigenvalue and functional; its cone has the images of the rays of all other pieces.
        pull: SlowCycle,
        /// The first-level joints, then the fixed point.
        points: Vec<PointReport>,
    },
    /// It is passed once.
    Transient {
        /// The state.
        state: usize,
        /// The first-level joints.
        points: Vec<PointReport>,
    },
}

impl Component {
    /// The state.
    #[must_use]
    pub fn state(&self) -> usize {
        match self {
            Self::Cones { state, .. } | Self::Loop { state, .. } | Self::Transient { state, .. } => *state,
        }
    }

    /// Whether it shows that a state is G¹: its own, or one that a state with cones reaches.
    fn covers(&self, e: usize) -> bool {
        self.state() == e || self.rays(e).is_some()
    }

    /// The rays of a state that has cones here.
    fn rays(&self, e: usize) -> Option<&Matrix> {
        let Self::Cones { cone, .. } = self else { return None };
        cone.cones.iter().find(|c| c.state == e).map(|c| &c.rays)
    }
}

/// Why a whole curve is G¹.
#[derive(Debug, Clone)]
pub struct Components {
    /// The states, each behind those that it needs, the start last.
    pub parts: Vec<Component>,
    /// Cones of all states, with the code by which no tangent is lost in the projection; `None` without control points.
    pub sight: Option<(CommonCone, Code)>,
}

/// Looks for a proof; `None` where some hypothesis is not proved. `cones_tried` says that there are no cones of all states together.
///
/// # Cost
/// A search of cones for some states, spectra of the loops, and the points.
#[must_use]
pub fn components(cx: &Context, cones_tried: bool) -> Option<Components> {
    let mut found = Components { parts: Vec::new(), sight: None };
    part(cx, (cx.shape.start, cones_tried), &mut found.parts)?;
    if let Some(control) = &cx.shape.control {
        let limits = (MAX_CODE_LENGTH, MAX_CODE, cx.budget.cone_steps);
        found.sight = Some(cone_in_sight(cx.shape, cx.spaces, cx.shape.start, control, limits)?);
    }
    Some(found)
}

/// Proves a state after those that it leads to.
fn part(cx: &Context, (state, cones_tried): (usize, bool), parts: &mut Vec<Component>) -> Option<()> {
    if parts.iter().any(|p| p.covers(state)) {
        return Some(());
    }
    let pieces = &cx.shape.states[state].pieces;
    let back: Vec<usize> = (0..pieces.len()).filter(|i| leads_to(cx.shape, pieces[*i].target, state)).collect();
    let own = |i: &usize| pieces[*i].target == state && !pieces[*i].reversed;
    let others = || pieces.iter().map(|p| p.target).filter(|t| *t != state);
    let component = match back.as_slice() {
        [] => {
            others().try_for_each(|t| part(cx, (t, false), parts))?;
            transient(cx, state)?
        }
        [letter] if own(letter) && pieces.len() > 1 => {
            others().try_for_each(|t| part(cx, (t, false), parts))?;
            turning(cx, state, *letter, parts)?
        }
        _ if cones_tried => return None,
        _ => with_cones(cx, state)?,
    };
    parts.push(component);
    Some(())
}

fn leads_to(shape: &Shape, from: usize, to: usize) -> bool {
    Shape { start: from, ..shape.clone() }.reachable().contains(&to)
}

/// A state with its whole relevant space in sight.
fn own<'a>(cx: &Context<'a>, state: usize) -> Context<'a> {
    let whole = Matrix::identity(cx.spaces.of(state).basis.cols());
    Context { from: Viewpoint::rows(cx.spaces, state, &whole), ..*cx }
}

/// The first-level joints of a state, where all of them are regular.
fn regular_joints(own: &Context) -> Option<Vec<PointReport>> {
    let joint = |(left, right)| {
        let report = point::examine_point(own, &point::joint_spec(own, &[], left, right)?)?;
        (report.verdict == Verdict::Proved && report.kind == Kind::Regular).then_some(report)
    };
    point::joint_pairs(own, own.from.root()).into_iter().map(joint).collect()
}

fn with_cones(cx: &Context, state: usize) -> Option<Component> {
    let below = Shape { start: state, control: None, ..cx.shape.clone() };
    let ConeAnswer::Proved(cone) = common_cone(&below, cx.spaces, cx.budget.cone_steps)? else { return None };
    let mut joints = Vec::new();
    for e in below.reachable() {
        joints.extend(regular_joints(&own(cx, e))?);
    }
    Some(Component::Cones { state, cone, joints })
}

fn transient(cx: &Context, state: usize) -> Option<Component> {
    let injective = cx.shape.states[state].pieces.iter().all(|p| {
        let space = cx.spaces.of(p.target);
        space.basis.cols() > 0 && (&p.op * &space.basis).rank() == space.basis.cols()
    });
    if !injective {
        return None;
    }
    Some(Component::Transient { state, points: regular_joints(&own(cx, state))? })
}

fn turning(cx: &Context, state: usize, letter: usize, parts: &[Component]) -> Option<Component> {
    let pieces = &cx.shape.states[state].pieces;
    let space = cx.spaces.of(state);
    let n = space.basis.cols();
    let linear = cx.spaces.linear(&pieces[letter].op, state, state);
    let power = (0..n).fold(Matrix::identity(n), |p, _| &p * &linear);
    let mut images = Matrix::zero(n, 0);
    for piece in pieces.iter().filter(|p| p.target != state) {
        let rays = parts.iter().find_map(|p| p.rays(piece.target))?;
        let inner = cx.spaces.linear(&piece.op, state, piece.target);
        if (&power * &inner).rank() < inner.cols() {
            return None;
        }
        let sign = crate::arith::Rational::from(if piece.reversed { -1 } else { 1 });
        let forward = (&space.coordinates * &(&piece.op * rays)).scale(&sign);
        images = images.transpose().stack(&forward.transpose()).transpose();
    }
    let pull = SlowCycle::of_rays(cx.shape, cx.spaces, (state, letter), &images)?;
    let own = own(cx, state);
    let mut points = regular_joints(&own)?;
    let last = pieces.len() - 1;
    let fixed = if letter == 0 || letter == last {
        let end = if letter == 0 { crate::shape::End::Start } else { crate::shape::End::Finish };
        point::end_spec(&own, end)?
    } else {
        point::address_spec(&own, &Address::periodic(vec![letter]))?
    };
    let report = point::examine_point(&own, &fixed)?;
    let smooth = matches!(report.kind, Kind::Regular | Kind::SmoothEnd) && report.verdict == Verdict::Proved;
    points.push(report);
    smooth.then_some(Component::Loop { state, letter, pull, points })
}
