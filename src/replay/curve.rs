//! What is stated of a whole curve: the joints of all levels (Theorem 5), and a tangent at every point (Theorem 6).

use super::evidence::{self, Evidence, independent};
use super::refuted::undone;
use super::{Model, NoTheorem, place};
use crate::arith::{Rational, sign};
use crate::linalg::Matrix;
use crate::shape::End;
use crate::theorem::{BranchReport, Certified, Kind, PointReport, Role, Verdict, primitive};

/// A first-level joint of a state in that state's own space.
pub(super) struct OwnJoint {
    pub state: usize,
    pub pieces: (usize, usize),
    pub cusp: bool,
    pub before: Own,
    pub after: Own,
    pub point: Vec<Rational>,
}

/// A branch from the joint's state.
pub(super) struct Own {
    pub prefix: Vec<usize>,
    pub cycle: Vec<usize>,
    pub direction: Vec<Rational>,
    pub evidence: Evidence,
}

/// Theorem 5: the joints, and left inverses of all operators and of the control points.
pub(super) struct Levels {
    pub joints: Vec<OwnJoint>,
    pub inverses: Vec<Vec<Matrix>>,
    pub net: Matrix,
}

/// Theorem 6, by state in the order of the file.
pub(super) struct Cones {
    pub rays: Vec<Matrix>,
    pub maps: Vec<Vec<Matrix>>,
    pub firsts: Vec<Vec<Rational>>,
    pub lasts: Vec<Vec<Rational>>,
    pub chords: Vec<Vec<Rational>>,
    pub ratio: Rational,
    pub seen_by: Vec<Rational>,
}

/// The joints of all levels, or why they are not stated.
pub(super) fn levels(model: &Model<'_>, found: &Certified) -> Result<Levels, NoTheorem> {
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "the joints of all levels".to_owned() };
    let dense = found.dense.as_ref().ok_or_else(|| none("a shape that is no curve"))?;
    if found.dense_claim().is_none_or(|c| c.verdict() != Verdict::Proved) {
        return Err(none("joints that are not all proved to have tangents"));
    }
    let basis = |e: usize| &model.spaces.of(e).basis;
    let net = undone(&model.net, basis(model.shape.start));
    let net = net.ok_or_else(|| none("control points that are not injective"))?;
    let pieces = |e: &usize| model.shape.states[*e].pieces.iter();
    let of = |e: &usize| pieces(e).map(|p| undone(&p.op, basis(p.target))).collect::<Option<Vec<_>>>();
    let inverses = model.states.iter().map(of).collect::<Option<Vec<_>>>();
    let inverses = inverses.ok_or_else(|| none("operators that are not injective"))?;
    if dense.joints.is_empty() {
        return Err(none("a curve without joints"));
    }
    let joints = dense.joints.iter().map(|k| own(model, &found.points[*k])).collect::<Result<Vec<_>, _>>()?;
    Ok(Levels { joints, inverses, net })
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
    let side = |b: &BranchReport| -> Result<(Own, Vec<Rational>), NoTheorem> {
        let prefix = b.address.prefix.strip_prefix(&path[..]).ok_or_else(|| none("an address outside its state"))?;
        let (transport, _) = model.shape.product(*state, prefix);
        let (evidence, direction) = evidence::in_its_state(model.given(), b, &transport)
            .map_err(|what| NoTheorem { what, place: place.clone() })?;
        let at = transport.apply(&b.fixed);
        Ok((Own { prefix: prefix.to_vec(), cycle: b.address.cycle.clone(), direction, evidence }, at))
    };
    let ((before, at), (after, _)) = (side(before)?, side(after)?);
    if independent(&before.direction, &after.direction).is_some() {
        return Err(none("rays on different lines before the control points"));
    }
    let cusp = before.direction == after.direction;
    Ok(OwnJoint { state: *state, pieces: (*left, *right), cusp, before, after, point: at })
}

/// The cones of Theorem 6, or why they are not stated.
pub(super) fn cones(model: &Model<'_>, found: &Certified) -> Result<Cones, NoTheorem> {
    let none = |what: &str| NoTheorem { what: what.to_owned(), place: "every point".to_owned() };
    let every = found.everywhere.as_ref().ok_or_else(|| none("a shape that is no curve"))?;
    let cone = every.cone.as_ref().filter(|_| every.seen).ok_or_else(|| none("a curve without common cones"))?;
    if cone.window != 1 || !cone.slow.is_empty() {
        return Err(none("cones that shrink slowly"));
    }
    if !model.forward() {
        return Err(none("pieces that run backwards"));
    }
    let missing = || none("a state without a cone");
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
    let start = cone.cones.iter().find(|c| c.state == model.shape.start).ok_or_else(missing)?;
    let own = || model.shape.control.is_none().then(|| start.functional.clone());
    let seen_by = cone.view.clone().or_else(own).ok_or_else(|| none("cones that the control points do not show"))?;
    Ok(Cones { rays, maps, firsts, lasts, chords, ratio, seen_by })
}

/// The vector with coprime integer coordinates on the same ray, and the positive number by which it was divided.
pub(super) fn reduced(v: &[Rational]) -> Option<(Vec<Rational>, Rational)> {
    let lead = v.iter().position(|x| *x != 0)?;
    let direction = primitive(v);
    let factor = &v[lead] / &direction[lead];
    Some((direction, factor))
}
