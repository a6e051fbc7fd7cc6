//! From branches to points: end points, joints, interior points, points of sets (theory §3, §5, §9).

use super::branch::{Context, examine};
use super::direction::Direction;
use super::gap::PointGap;
use super::provable::Provable;
use super::verdict::{BranchReport, Dimension, Kind, Outcome, PointReport, Role, Side, Verdict};
use crate::jordan::Scalar;
use crate::shape::{Address, CellKind, End, Piece};

/// A point to examine: where it sits and its branches.
#[derive(Debug, Clone)]
pub struct PointSpec {
    /// Where it sits.
    pub role: Role,
    /// Its branches, from the start state.
    pub branches: Vec<(Side, Address)>,
}

/// The branch at an end of the cell reached by `path`, or `None` where the cell is a point.
fn end_branch<E: Provable>(cx: &Context<E>, path: &[usize], state: usize, end: End) -> Option<Address> {
    let skip = |p: &Piece<E>| cx.shape.is_point(cx.spaces, p);
    let mut address = cx.shape.end_address(state, end, skip)?;
    address.prefix.splice(0..0, path.iter().copied());
    Some(address)
}

/// An end point of the start state.
#[must_use]
pub fn end_spec<E: Provable>(cx: &Context<E>, end: End) -> Option<PointSpec> {
    let address = end_branch(cx, &[], cx.from.root(), end)?;
    let (role, side) = match end {
        End::Start => (Role::LeftEnd, Side::Right),
        End::Finish => (Role::RightEnd, Side::Left),
    };
    Some(PointSpec { role, branches: vec![(side, address)] })
}

/// The pairs of neighbouring pieces of a state that are no points.
#[must_use]
pub fn joint_pairs<E: Provable>(cx: &Context<E>, state: usize) -> Vec<(usize, usize)> {
    let pieces = &cx.shape.states[state].pieces;
    let kept: Vec<usize> = (0..pieces.len()).filter(|&i| !cx.shape.is_point(cx.spaces, &pieces[i])).collect();
    kept.windows(2).map(|w| (w[0], w[1])).collect()
}

/// The joint between two pieces of the state that `path` reaches.
#[must_use]
pub fn joint_spec<E: Provable>(cx: &Context<E>, path: &[usize], left: usize, right: usize) -> Option<PointSpec> {
    let shape = cx.shape;
    let state = *shape.path(cx.from.root(), path).last()?;
    let branch = |letter: usize, end: End| {
        let piece = &shape.states[state].pieces[letter];
        let path = [path, &[letter]].concat();
        end_branch(cx, &path, piece.target, end.in_piece(piece))
    };
    let flipped = orientation(cx, path) < 0;
    let mut branches = vec![(Side::Left, branch(left, End::Finish)?), (Side::Right, branch(right, End::Start)?)];
    if flipped {
        branches.reverse();
        branches[0].0 = Side::Left;
        branches[1].0 = Side::Right;
    }
    Some(PointSpec { role: Role::Joint { path: path.to_vec(), state, left, right }, branches })
}

fn orientation<E: Provable>(cx: &Context<E>, path: &[usize]) -> i32 {
    let states = cx.shape.path(cx.from.root(), path);
    path.iter().zip(&states).map(|(&i, &e)| if cx.shape.states[e].pieces[i].reversed { -1 } else { 1 }).product()
}

/// The point with a normalised address: an end point, a joint, or a point inside.
#[must_use]
pub fn address_spec<E: Provable>(cx: &Context<E>, address: &Address) -> Option<PointSpec> {
    let shape = cx.shape;
    let states = shape.path(cx.from.root(), &address.prefix);
    let state = *states.last()?;
    let all = [address.prefix.as_slice(), &address.cycle].concat();
    let is_curve = shape.path(cx.from.root(), &all).iter().all(|&e| shape.states[e].kind == CellKind::Edge);
    if !is_curve {
        return Some(PointSpec { role: Role::SetPoint, branches: vec![(Side::Both, address.clone())] });
    }
    let Some(mut end) = end_of_cell(cx, state, &address.cycle) else {
        return Some(PointSpec { role: Role::Interior, branches: vec![(Side::Both, address.clone())] });
    };
    for (k, &letter) in address.prefix.iter().enumerate().rev() {
        let pieces = &shape.states[states[k]].pieces;
        end = end.in_piece(&pieces[letter]);
        let solid = |i: &usize| !shape.is_point(cx.spaces, &pieces[*i]);
        let path = &address.prefix[..k];
        let neighbour = match end {
            End::Start => (0..letter).rev().find(solid).map(|i| (i, letter)),
            End::Finish => (letter + 1..pieces.len()).find(solid).map(|i| (letter, i)),
        };
        if let Some((left, right)) = neighbour {
            return joint_spec(cx, path, left, right);
        }
    }
    end_spec(cx, end)
}

/// Whether the fixed point of a cycle is an end of its cell: no piece that is more than a point lies on that side.
fn end_of_cell<E: Provable>(cx: &Context<E>, state: usize, cycle: &[usize]) -> Option<End> {
    [End::Start, End::Finish].into_iter().find(|&end| {
        let (mut at, mut side) = (state, end);
        for _ in 0..2 {
            for &letter in cycle {
                let pieces = &cx.shape.states[at].pieces;
                let solid = |i: &usize| !cx.shape.is_point(cx.spaces, &pieces[*i]);
                let outside = match side {
                    End::Start => (0..letter).any(|i| solid(&i)),
                    End::Finish => (letter + 1..pieces.len()).any(|i| solid(&i)),
                };
                if outside {
                    return false;
                }
                side = side.in_piece(&pieces[letter]);
                at = pieces[letter].target;
            }
        }
        true
    })
}

/// Examines a point.
#[must_use]
pub fn examine_point<E: Provable>(cx: &Context<E>, spec: &PointSpec) -> Option<PointReport<E>> {
    let branches: Vec<BranchReport<E>> =
        spec.branches.iter().map(|(side, address)| examine(cx, address, *side)).collect::<Option<_>>()?;
    let position = cx.shape.point(cx.from.root(), &branches[0].address)?;
    let image = cx.from.image(&position);
    Some(conclude(spec.role.clone(), position, image, branches))
}

fn conclude<E: Scalar>(
    role: Role,
    position: Vec<E>,
    image: Option<Vec<E>>,
    branches: Vec<BranchReport<E>>,
) -> PointReport<E> {
    let at_least = branches.iter().map(lower_bound).fold(0, usize::max);
    let mut report = PointReport {
        role,
        position,
        image,
        branches,
        verdict: Verdict::Undetermined,
        kind: Kind::Undetermined,
        dimension: Dimension { at_least, exact: false },
        tangent: None,
        left: Vec::new(),
        right: Vec::new(),
        reason: None,
    };
    if at_least >= 2 {
        report.verdict = Verdict::Refuted;
        report.kind = Kind::NoTangent;
        report.reason = Some(PointGap::Dimension);
        return report;
    }
    if let Some(known) = spread(&report.branches) {
        let reason = Some(PointGap::Spread);
        return PointReport { verdict: Verdict::Refuted, kind: Kind::NoTangent, dimension: known, reason, ..report };
    }
    let mut lines = Vec::new();
    for (index, branch) in report.branches.iter().enumerate() {
        match &branch.outcome {
            Outcome::Line { direction, rays, .. } => lines.push((direction.clone(), rays.clone())),
            Outcome::Open { .. } | Outcome::NoGerm { .. } => {
                report.reason = Some(PointGap::Branch(index));
                return report;
            }
            Outcome::AtLeast { .. } => {}
        }
    }
    for (side, (_, rays)) in report.branches.iter().map(|b| b.side).zip(&lines) {
        if side != Side::Right {
            report.left.clone_from(&rays.left);
        }
        if side != Side::Left {
            report.right.clone_from(&rays.right);
        }
    }
    let Some((first, _)) = lines.first() else { return report };
    report.dimension = Dimension { at_least: 1, exact: true };
    if let Some((second, _)) = lines.get(1)
        && first.same_line(second).is_none()
    {
        report.verdict = Verdict::Refuted;
        report.dimension = Dimension { at_least: 2, exact: true };
        let single = report.left.len() == 1 && report.right.len() == 1;
        report.kind = if single { Kind::Corner } else { Kind::NoTangent };
        report.reason = Some(PointGap::SidesDiffer);
        return report;
    }
    report.verdict = Verdict::Proved;
    report.tangent = Some(along(first, &report));
    report.kind = kind(&report);
    report
}

/// The tangent in the direction of travel: towards the ray of what follows, or away from that of what comes before.
fn along<E: Scalar>(tangent: &Direction, report: &PointReport<E>) -> Direction {
    let sign = match (report.left.as_slice(), report.right.as_slice()) {
        (_, [after]) => tangent.same_line(after),
        ([before], []) => tangent.same_line(before).map(|s| -s),
        _ => None,
    };
    sign.map_or_else(|| tangent.clone(), |s| tangent.times(s))
}

/// Where a side is not decided: whether the directions known to lie in the two tangent subspaces span a plane all the same.
fn spread<E: Scalar>(branches: &[BranchReport<E>]) -> Option<Dimension> {
    let open = branches.iter().any(|b| matches!(b.outcome, Outcome::Open { .. }));
    let known: Vec<&Direction> = branches
        .iter()
        .filter_map(|b| match &b.outcome {
            Outcome::Line { direction, .. } => Some(direction),
            Outcome::Open { direction, .. } => direction.as_ref(),
            _ => None,
        })
        .collect();
    let differ = open && known.len() == 2 && known[0].same_line(known[1]).is_none();
    differ.then_some(Dimension { at_least: 2, exact: false })
}

fn lower_bound<E: Scalar>(branch: &BranchReport<E>) -> usize {
    match &branch.outcome {
        Outcome::Line { .. } => 1,
        Outcome::AtLeast { dimension, .. } => *dimension,
        Outcome::NoGerm { .. } => 0,
        Outcome::Open { at_least, .. } => *at_least,
    }
}

fn kind<E: Scalar>(report: &PointReport<E>) -> Kind {
    let (left, right) = (&report.left, &report.right);
    let one_sided = matches!(report.role, Role::LeftEnd | Role::RightEnd);
    let opposite = |a: &Direction, b: &Direction| a.same_line(b) == Some(-1);
    match (left.len(), right.len()) {
        (2, _) | (_, 2) => Kind::Oscillating,
        (1, 0) | (0, 1) if report.role == Role::SetPoint => Kind::HalfTangent,
        (1, 0) | (0, 1) if one_sided => Kind::SmoothEnd,
        (1, 1) if opposite(&left[0], &right[0]) => Kind::Regular,
        (1, 1) => Kind::Cusp,
        _ => Kind::Line,
    }
}
