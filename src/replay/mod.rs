//! Files for Coq that state a verdict about the case's own matrices and apply the theorems of `proofs/` to them.
//!
//! Nothing here proves anything: Coq checks every number of the file by computation. What has no formal theorem is refused,
//! and nothing is written.

mod curve;
mod evidence;
mod refuted;
mod write;

use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Contraction, Shape, Spaces, word_text};
use crate::theorem::{BranchReport, Certified, Direction, Kind, PointReport, Role, Verdict, primitive};
use evidence::{Balls, Evidence, Given, Mode, independent};
use refuted::Refuted;
use thiserror::Error;

/// Why a verdict cannot be replayed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no formal theorem of proofs/ covers {what} ({place})")]
pub struct NoTheorem {
    /// What has no theorem.
    pub what: String,
    /// Where it occurs.
    pub place: String,
}

fn none<T>(what: impl Into<String>, place: impl Into<String>) -> Result<T, NoTheorem> {
    Err(NoTheorem { what: what.into(), place: place.into() })
}

/// What is stated of a point; the branches are in the order of the point's report.
enum Statement {
    /// One ray.
    Ray { branch: Replayed },
    /// One ray on each side of a point inside a cell, in opposite directions.
    Passes { branch: Replayed },
    /// One line, of whose rays no more is said.
    Line { branch: Replayed },
    /// Rays on both sides: opposite, equal, or on two lines with a minor that is not 0.
    Joint { kind: Kind, before: Replayed, after: Replayed, minor: (usize, usize) },
    /// No tangent line, by two limit directions of one branch.
    NoTangent { address: Address, point: Vec<Rational>, refuted: Refuted },
}

/// A branch with its evidence.
struct Replayed {
    prefix: Vec<usize>,
    cycle: Vec<usize>,
    direction: Vec<Rational>,
    evidence: Evidence,
}

/// A theorem of the file.
struct Stated {
    name: String,
    place: String,
    statement: Statement,
    /// The image of the point.
    image: Vec<Rational>,
}

/// What is stated of a whole curve, or why it is not.
struct Whole {
    levels: Result<curve::Levels, NoTheorem>,
    cones: Result<curve::Cones, NoTheorem>,
}

/// The reachable part of a shape, with the numbers that its states have in the file, and what encloses its attractors.
struct Model<'a> {
    shape: &'a Shape,
    /// The reachable states; the number in the file is the position in this list.
    states: Vec<usize>,
    balls: Balls,
    /// The spaces of the differences of the attractors.
    spaces: Spaces,
    /// The control points, or the identity.
    net: Matrix,
    /// Coordinates that are enough for all.
    ambient: usize,
    /// Bound of all words of the code, and the length of the longest.
    constant: Rational,
    length: usize,
}

impl<'a> Model<'a> {
    fn of(case: &'a Case, found: &Certified) -> Result<Self, NoTheorem> {
        let shape = &case.shape;
        let Contraction::Proved(code) = &found.contraction else {
            return none("contraction that is not proved by words (Lemma 1)", "contraction");
        };
        let states: Vec<usize> = found.states.iter().map(|s| s.state).collect();
        if states.iter().any(|e| matches!(shape.states[*e].kind, CellKind::Face)) {
            return none("a surface", case.name.clone());
        }
        let mut balls = Balls { centre: vec![Vec::new(); shape.states.len()], radius: Vec::new() };
        balls.radius = vec![Rational::from(0); shape.states.len()];
        for s in &found.states {
            balls.centre[s.state].clone_from(&s.base);
            balls.radius[s.state].clone_from(&s.radius);
        }
        let Some(spaces) = Spaces::new(shape) else { return none("base points that are not unique", "contraction") };
        let net = shape.control.clone().unwrap_or_else(|| Matrix::identity(shape.states[shape.start].dim));
        let dims = states.iter().map(|e| shape.states[*e].dim);
        let ambient = dims.chain([net.rows()]).max().unwrap_or(0);
        Ok(Self { shape, states, balls, spaces, net, ambient, constant: code.constant.clone(), length: code.length })
    }

    fn given(&self) -> Given<'_> {
        Given { shape: self.shape, balls: &self.balls, spaces: &self.spaces }
    }

    /// Whether no piece runs backwards, so that the order of addresses is that of the curve.
    fn forward(&self) -> bool {
        let plain = |e: &usize| {
            let state = &self.shape.states[*e];
            state.kind == CellKind::Edge && state.pieces.iter().all(|p| !p.reversed)
        };
        self.states.iter().all(plain)
    }

    fn number(&self, state: usize) -> usize {
        self.states.iter().position(|e| *e == state).unwrap_or(self.states.len())
    }
}

/// The file that states what was found about the points of a case and applies the formal theorems.
///
/// # Errors
/// [`NoTheorem`] where a decided point has no formal theorem, or nothing is decided.
///
/// # Cost
/// That of the ring conditions: at most some thousand products of a row by an operator for each branch.
pub fn coq(case: &Case, found: &Certified) -> Result<String, NoTheorem> {
    if found.surface.is_some() {
        return none("a surface", case.name.clone());
    }
    let model = Model::of(case, found)?;
    let mut theorems: Vec<Stated> = Vec::new();
    for point in found.points.iter().filter(|p| p.verdict != Verdict::Undetermined) {
        let name = name(point, theorems.len());
        if theorems.iter().all(|t| t.name != name) {
            theorems.push(stated(&model, point, name)?);
        }
    }
    if theorems.is_empty() || found.verdict == Verdict::Undetermined {
        return none("an undetermined verdict", case.name.clone());
    }
    let whole = Whole { levels: curve::levels(&model, found), cones: curve::cones(&model, found) };
    Ok(write::file(case, found, &model, &theorems, &whole))
}

fn name(point: &PointReport, index: usize) -> String {
    match &point.role {
        Role::LeftEnd => "left_end".to_owned(),
        Role::RightEnd => "right_end".to_owned(),
        Role::Joint { path, left, right, .. } => {
            let inside: String = path.iter().map(|l| format!("{l}_")).collect();
            format!("joint_{inside}{left}_{right}")
        }
        Role::Interior | Role::SetPoint => format!("point_{index}"),
    }
}

/// Where a point lies, for comments and refusals.
fn place(point: &PointReport) -> String {
    match (&point.role, point.branches.first()) {
        (Role::LeftEnd, _) => "the left end".to_owned(),
        (Role::RightEnd, _) => "the right end".to_owned(),
        (Role::Joint { path, left, right, .. }, _) if path.is_empty() => {
            format!("the joint of pieces {left} and {right}")
        }
        (Role::Joint { path, left, right, .. }, _) => {
            format!("the joint of pieces {left} and {right} in cell {}", word_text(path))
        }
        (_, Some(branch)) => format!("the point with the address {}", branch.address),
        (_, None) => "a point".to_owned(),
    }
}

fn stated(model: &Model<'_>, point: &PointReport, name: String) -> Result<Stated, NoTheorem> {
    let place = place(point);
    let image = point.image.clone().unwrap_or_else(|| point.position.clone());
    let ray = |rays: &[Direction]| -> Result<Vec<Rational>, NoTheorem> {
        match rays {
            [one] => match one.rational() {
                Some(coords) => Ok(primitive(&coords)),
                None => none("a direction with irrational coordinates", &*place),
            },
            _ => none("a side with several rays", &*place),
        }
    };
    let line = || -> Result<Vec<Rational>, NoTheorem> {
        match point.tangent.as_ref().and_then(Direction::rational) {
            Some(coords) => Ok(primitive(&coords)),
            None => none("a direction with irrational coordinates", &*place),
        }
    };
    let statement = match (point.kind, &point.branches[..]) {
        (Kind::SmoothEnd | Kind::HalfTangent, [branch]) => {
            let rays = if point.left.is_empty() { &point.right } else { &point.left };
            Statement::Ray { branch: replayed(model, branch, ray(rays)?, Mode::Above, &place)? }
        }
        (Kind::Cusp, [branch]) => {
            let (left, right) = (ray(&point.left)?, ray(&point.right)?);
            if left != right {
                return none("rays that do not fit their kind", &*place);
            }
            Statement::Ray { branch: replayed(model, branch, right, Mode::Above, &place)? }
        }
        (Kind::Regular, [branch]) if model.forward() => {
            Statement::Passes { branch: replayed(model, branch, ray(&point.right)?, Mode::Sides, &place)? }
        }
        (Kind::Regular | Kind::Oscillating | Kind::Line, [branch]) => {
            Statement::Line { branch: replayed(model, branch, line()?, Mode::Apart, &place)? }
        }
        (Kind::Regular | Kind::Cusp | Kind::Corner, [before, after]) => {
            let (left, right) = (ray(&point.left)?, ray(&point.right)?);
            let minor = independent(&left, &right);
            let before = replayed(model, before, left, Mode::Above, &place)?;
            let after = replayed(model, after, right, Mode::Above, &place)?;
            if (point.kind == Kind::Corner) != minor.is_some() {
                return none("rays that do not fit their kind", &*place);
            }
            Statement::Joint { kind: point.kind, before, after, minor: minor.unwrap_or((0, 0)) }
        }
        (Kind::NoTangent, branches) => {
            let mut reason = "a point without a tangent line and without branches".to_owned();
            let several = branches.iter().find_map(|b| match refuted::of(model.shape, b) {
                Ok(refuted) => Some((b, refuted)),
                Err(what) => {
                    reason = what;
                    None
                }
            });
            let Some((branch, refuted)) = several else { return none(reason, &*place) };
            Statement::NoTangent { address: branch.address.clone(), point: branch.fixed.clone(), refuted }
        }
        (kind, branches) => {
            return none(format!("a point of the kind “{}” with {} branches", kind.word(), branches.len()), &*place);
        }
    };
    Ok(Stated { name, place, statement, image })
}

fn replayed(
    model: &Model<'_>,
    branch: &BranchReport,
    direction: Vec<Rational>,
    mode: Mode,
    place: &str,
) -> Result<Replayed, NoTheorem> {
    let evidence = evidence::of(model.given(), branch, &direction, mode)
        .map_err(|what| NoTheorem { what, place: format!("{place}, branch {}", branch.address) })?;
    let (prefix, cycle) = (branch.address.prefix.clone(), branch.address.cycle.clone());
    Ok(Replayed { prefix, cycle, direction, evidence })
}
