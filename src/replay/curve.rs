//! What is stated of a whole curve: the joints of all levels (Theorem 5), and a tangent at every point (Theorem 6).

use super::evidence::{self, Evidence};
use super::field::{Field, Pairs};
use super::{Model, NoTheorem, decided, place};
use crate::arith::{Rational, sign};
use crate::linalg::Matrix;
use crate::shape::End;
use crate::theorem::{BranchReport, Certified, Kind, PointReport, Role, Verdict};

/// A first-level joint of a state, as it is seen in that state.
pub(super) struct OwnJoint {
    pub state: usize,
    pub pieces: (usize, usize),
    pub cusp: bool,
    pub before: Own,
    pub after: Own,
    /// What is seen of the point, and a vector of the state's space of which the direction after the point is seen.
    pub point: Vec<Rational>,
    pub lift: Pairs,
}

/// A branch from the joint's state.
pub(super) struct Own {
    pub prefix: Vec<usize>,
    pub cycle: Vec<usize>,
    pub direction: Pairs,
    pub evidence: Evidence,
}

/// The joints of all states, and what is seen of each state.
pub(super) struct Joints {
    pub all: Vec<OwnJoint>,
    pub views: Vec<Matrix>,
}

/// Theorem 5: that the control points and all operators show as much as is seen of each state, by matrices that make each of the
/// other.
pub(super) struct Levels {
    pub pairs: Vec<Vec<(Matrix, Matrix)>>,
    pub net: (Matrix, Matrix),
    /// By state in the order of the file, a word that leads to a state with a joint.
    pub ways: Vec<Vec<usize>>,
}

/// Theorem 6, by state in the order of the file.
pub(super) struct Cones {
    /// The pieces that run backwards.
    pub backwards: Vec<Vec<bool>>,
    pub rays: Vec<Matrix>,
    pub maps: Vec<Vec<Matrix>>,
    pub firsts: Vec<Vec<Rational>>,
    pub lasts: Vec<Vec<Rational>>,
    pub chords: Vec<Vec<Rational>>,
    pub ratio: Rational,
    pub seen_by: Vec<Rational>,
}

/// Theorem 6 with the joints: functionals on what is seen of the states, and matrices that make of it what the start sees, and
/// what is seen of the states around.
pub(super) struct Sights {
    pub own_rows: Vec<Vec<Rational>>,
    pub into_start: Matrix,
    pub into_state: Vec<Vec<Matrix>>,
}

/// The joints of all states in their own states, or why they are not stated.
pub(super) fn joints(model: &Model<'_>, found: &Certified) -> Result<Joints, NoTheorem> {
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "the joints of all levels".to_owned() };
    let dense = found.dense.as_ref().ok_or_else(|| none("a shape that is no curve"))?;
    if found.dense_claim().is_none_or(|c| c.verdict() != Verdict::Proved) {
        return Err(none("joints that are not all proved to have tangents"));
    }
    if dense.joints.is_empty() {
        return Err(none("a curve without joints"));
    }
    let all = dense.joints.iter().map(|k| own(model, &found.points[*k])).collect::<Result<Vec<_>, _>>()?;
    Ok(Joints { all, views: model.states.iter().map(|e| view(model, *e)).collect() })
}

/// The joints of all levels, or why they are not stated.
pub(super) fn levels(model: &Model<'_>, joints: &Result<Joints, NoTheorem>) -> Result<Levels, NoTheorem> {
    let joints = &joints.as_ref().map_err(Clone::clone)?.all;
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "the joints of all levels".to_owned() };
    let start = model.shape.start;
    let shown = |e: usize, seen: &Matrix| {
        let basis = &model.spaces.of(e).basis;
        Some((covered(model, e, seen)?, through(&(seen * basis), &(&view(model, e) * basis))?))
    };
    let net = shown(start, &model.net).ok_or_else(|| none("control points that are not injective"))?;
    let of = |e: &usize| {
        let pieces = model.shape.states[*e].pieces.iter();
        pieces.map(|p| shown(p.target, &(&view(model, *e) * &p.op))).collect::<Option<Vec<_>>>()
    };
    let pairs = model.states.iter().map(of).collect::<Option<Vec<_>>>();
    let pairs = pairs.ok_or_else(|| none("operators that are not injective"))?;
    let ways = model.states.iter().map(|e| way(model, *e, joints)).collect::<Option<Vec<_>>>();
    let ways = ways.ok_or_else(|| none("a state from which no joint is reached"))?;
    Ok(Levels { pairs, net, ways })
}

/// A matrix that makes of what is seen of a state what another matrix shows of it.
fn covered(model: &Model<'_>, state: usize, shown: &Matrix) -> Option<Matrix> {
    let basis = &model.spaces.of(state).basis;
    through(&(&view(model, state) * basis), &(shown * basis))
}

/// What shows that the curve is G¹, or why that is not stated.
pub(super) fn smooth(
    model: &Model<'_>,
    joints: &Result<Joints, NoTheorem>,
    cones: &Result<Cones, NoTheorem>,
) -> Result<Sights, NoTheorem> {
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "every point".to_owned() };
    let cones = cones.as_ref().map_err(Clone::clone)?;
    let joints = &joints.as_ref().map_err(Clone::clone)?.all;
    if joints.iter().any(|j| j.cusp) {
        return Err(none("a joint that is a cusp"));
    }
    let known = |e: usize, left: usize| joints.iter().any(|j| j.state == e && j.pieces == (left, left + 1));
    if !model.states.iter().all(|&e| (1..model.shape.states[e].pieces.len()).all(|i| known(e, i - 1))) {
        return Err(none("a joint that is not listed"));
    }
    let hidden = || none("what is seen of a state");
    let rows = seen_rows(model, &cones.seen_by);
    let own = |e: &usize| {
        let (_, row) = rows.iter().find(|(known, _)| known == e)?;
        Some(covered(model, *e, &Matrix::from_rows(row.len(), vec![row.clone()]))?.row(0).to_vec())
    };
    let around = |e: &usize| {
        let pieces = model.shape.states[*e].pieces.iter();
        pieces.map(|p| covered(model, p.target, &(&view(model, *e) * &p.op))).collect::<Option<Vec<_>>>()
    };
    Ok(Sights {
        own_rows: model.states.iter().map(own).collect::<Option<_>>().ok_or_else(hidden)?,
        into_start: covered(model, model.shape.start, &model.net).ok_or_else(hidden)?,
        into_state: model.states.iter().map(around).collect::<Option<_>>().ok_or_else(hidden)?,
    })
}

/// The functional of the start as it sees each state through some word, with the sign of the word.
fn seen_rows(model: &Model<'_>, functional: &[Rational]) -> Vec<(usize, Vec<Rational>)> {
    let mut rows = vec![(model.shape.start, model.net.apply_left(functional))];
    let mut next = 0;
    while let Some((e, row)) = rows.get(next).cloned() {
        for piece in &model.shape.states[e].pieces {
            if rows.iter().all(|(known, _)| *known != piece.target) {
                let seen = piece.op.apply_left(&row);
                let signed = if piece.reversed { seen.iter().map(|x| -x).collect() } else { seen };
                rows.push((piece.target, signed));
            }
        }
        next += 1;
    }
    rows
}

/// A shortest word from a state to one with a joint.
fn way(model: &Model<'_>, state: usize, joints: &[OwnJoint]) -> Option<Vec<usize>> {
    let mut open = vec![(state, Vec::new())];
    let mut next = 0;
    while let Some((e, word)) = open.get(next).cloned() {
        if joints.iter().any(|j| j.state == e) {
            return Some(word);
        }
        for (letter, piece) in model.shape.states[e].pieces.iter().enumerate() {
            if open.iter().all(|(known, _)| *known != piece.target) {
                open.push((piece.target, word.iter().copied().chain([letter]).collect()));
            }
        }
        next += 1;
    }
    None
}

/// What is seen of a state: the rows of its visible quotient.
fn view(model: &Model<'_>, state: usize) -> Matrix {
    let space = model.spaces.of(state);
    &space.visible * &space.coordinates
}

/// A matrix `X` with `X from = to`, where there is one.
fn through(from: &Matrix, to: &Matrix) -> Option<Matrix> {
    if from.cols() == 0 {
        return Some(Matrix::zero(to.rows(), from.rows()));
    }
    Some(from.transpose().solve(&to.transpose())?.transpose())
}

fn own(model: &Model<'_>, point: &PointReport) -> Result<OwnJoint, NoTheorem> {
    let place = place(point);
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: place.clone() };
    let (Role::Joint { path, state, left, right }, [before, after]) = (&point.role, &point.branches[..]) else {
        return Err(none("a joint without two branches"));
    };
    if !matches!(point.kind, Kind::Regular | Kind::Cusp) {
        return Err(none("a joint without one ray on each side"));
    }
    let (before, after, at) = decided(point, &place, |field| {
        let (before, at) = side(model, (*state, path), before, field)?;
        let (after, _) = side(model, (*state, path), after, field)?;
        Ok((before, after, at))
    })?;
    let cusp = before.direction == after.direction;
    if !cusp && before.direction != after.direction.negated() {
        return Err(none("rays on different lines in a state of their own"));
    }
    let space = model.spaces.of(*state);
    let lifted = |v: &[Rational]| {
        let column = Matrix::from_columns(v.len(), &[v.to_vec()]);
        Some(space.basis.apply(&space.visible.solve(&column)?.column(0)))
    };
    let parts = (lifted(&after.direction.plain), lifted(&after.direction.rooted));
    let (Some(plain), Some(rooted)) = parts else { return Err(none("a ray that is not seen")) };
    let lift = Pairs { plain, rooted };
    Ok(OwnJoint { state: *state, pieces: (*left, *right), cusp, before, after, point: at, lift })
}

/// A branch read from the state of a joint, and its point there.
fn side(
    model: &Model<'_>,
    (state, path): (usize, &[usize]),
    branch: &BranchReport,
    field: &Field,
) -> Result<(Own, Vec<Rational>), String> {
    let prefix = branch.address.prefix.strip_prefix(path).ok_or("an address outside its state")?;
    let (inside, _) = model.shape.product(state, prefix);
    let transport = &view(model, state) * &inside;
    let (evidence, direction) = evidence::in_its_state(model.given(), branch, field, &transport)?;
    let at = transport.apply(&branch.fixed);
    Ok((Own { prefix: prefix.to_vec(), cycle: branch.address.cycle.clone(), direction, evidence }, at))
}

/// Digits of all numbers of the cones, so that Coq takes less than a minute.
const MAX_DIGITS: usize = 150_000;

/// The cones of Theorem 6, or why they are not stated.
pub(super) fn cones(model: &Model<'_>, found: &Certified) -> Result<Cones, NoTheorem> {
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "every point".to_owned() };
    let every = found.everywhere.as_ref().ok_or_else(|| none("a shape that is no curve"))?;
    let cone = every.cone.as_ref().filter(|_| every.seen).ok_or_else(|| none("a curve without common cones"))?;
    if cone.window != 1 || !cone.slow.is_empty() {
        return Err(none("cones that shrink slowly"));
    }
    let missing = || none("a state without a cone");
    let turned = |e: &usize| model.shape.states[*e].pieces.iter().map(|p| p.reversed).collect();
    let backwards = model.states.iter().map(turned).collect();
    let (mut rays, mut maps, mut firsts) = (Vec::new(), Vec::new(), Vec::new());
    let (mut lasts, mut chords, mut ratio) = (Vec::new(), Vec::new(), Rational::from(1));
    for e in &model.states {
        let own = cone.cones.iter().find(|c| c.state == *e).ok_or_else(missing)?;
        rays.push(own.rays.clone());
        chords.push(own.chord.clone());
        let mut images = Vec::new();
        for letter in 0..model.shape.states[*e].pieces.len() {
            let map = cone.maps.iter().find(|m| m.state == *e && m.letter == letter).ok_or_else(missing)?;
            if map.matrix.entries().iter().any(|x| sign(x) <= 0) {
                return Err(none("matrices that are not positive"));
            }
            for row in 0..map.matrix.rows() {
                let entries = map.matrix.row(row);
                if let (Some(least), Some(most)) = (entries.iter().min(), entries.iter().max()) {
                    ratio = ratio.min(least / most);
                }
            }
            images.push(map.matrix.clone());
        }
        maps.push(images);
        firsts.push(model.shape.end_point(*e, End::Start).ok_or_else(missing)?);
        lasts.push(model.shape.end_point(*e, End::Finish).ok_or_else(missing)?);
    }
    let numbers = rays.iter().chain(maps.iter().flatten()).flat_map(Matrix::entries);
    if numbers.map(|x| x.to_string().len()).sum::<usize>() > MAX_DIGITS {
        return Err(none("cones whose numbers have too many digits"));
    }
    let start = cone.cones.iter().find(|c| c.state == model.shape.start).ok_or_else(missing)?;
    let own = || model.shape.control.is_none().then(|| start.functional.clone());
    let seen_by = cone.view.clone().or_else(own).ok_or_else(|| none("cones that the control points do not show"))?;
    Ok(Cones { backwards, rays, maps, firsts, lasts, chords, ratio, seen_by })
}
