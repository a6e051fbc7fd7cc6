//! Files for Coq that state a verdict about the case's own matrices and apply the theorems of `proofs/` to them.
//!
//! Nothing here proves anything: Coq checks every number of the file by computation. What has no formal theorem is refused,
//! and nothing is written.

mod curve;
mod evidence;
mod field;
mod hulls;
mod refuted;
mod whole;
mod write;

use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Contraction, Shape, Spaces, word_text};
use crate::theorem::{BranchReport, Certified, Direction, Kind, PointReport, Role, Verdict};
use evidence::{Balls, Evidence, Given, Mode};
use field::{Field, Pairs};
use hulls::Hulls;
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
    direction: Pairs,
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
    joints: Result<curve::Joints, NoTheorem>,
    levels: Result<curve::Levels, NoTheorem>,
    cones: Result<curve::Cones, NoTheorem>,
    /// With the joints and the cones, that the curve is G¹.
    smooth: Result<curve::Sights, NoTheorem>,
}

/// What shows that the pieces contract.
enum Shrinks {
    /// The bound of all words of a code, and the length of the longest.
    Words { constant: Rational, length: usize },
    /// Polytopes that the pieces map into one another.
    Hulls(Hulls),
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
    shrinks: Shrinks,
}

impl<'a> Model<'a> {
    fn of(case: &'a Case, found: &Certified) -> Result<Self, NoTheorem> {
        let shape = &case.shape;
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
        let shrinks = match &found.contraction {
            Contraction::Proved(code) => Shrinks::Words { constant: code.constant.clone(), length: code.length },
            Contraction::Polytopes(polytopes) => {
                for e in &states {
                    balls.radius[*e] = hulls::radius(&balls.centre[*e], &polytopes.vertices[*e]);
                }
                let hulls = Hulls::new(shape, &states, polytopes);
                Shrinks::Hulls(hulls.ok_or(()).or_else(|()| none("polytopes without interior", "contraction"))?)
            }
            _ => return none("contraction that is not proved by words or polytopes", "contraction"),
        };
        let Some(spaces) = Spaces::new(shape) else { return none("base points that are not unique", "contraction") };
        let net = shape.control.clone().unwrap_or_else(|| Matrix::identity(shape.states[shape.start].dim));
        let dims = states.iter().map(|e| shape.states[*e].dim);
        let ambient = dims.chain([net.rows()]).max().unwrap_or(0);
        Ok(Self { shape, states, balls, spaces, net, ambient, shrinks })
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
    let (joints, cones) = (curve::joints(&model, found), curve::cones(&model, found));
    let (levels, smooth) = (curve::levels(&model, &joints), curve::smooth(&model, &joints, &cones));
    let whole = Whole { joints, levels, cones, smooth };
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

/// Binary places of an interval for the root of irrational numbers, until they are enough.
const PLACES: [u64; 3] = [24, 64, 160];

/// What is decided in a field of all numbers of a point.
fn decided<T>(point: &PointReport, place: &str, decide: impl Fn(&Field) -> Result<T, String>) -> Result<T, NoTheorem> {
    let rays = point.left.iter().chain(&point.right).chain(&point.tangent);
    let irrational = rays.filter(|d| d.rational().is_none()).map(|d| &d.root);
    let numbers: Vec<_> = point.branches.iter().filter_map(evidence::eigenvalue).chain(irrational).collect();
    let mut reason = String::new();
    for places in PLACES {
        let field = Field::of(numbers.iter().copied(), places).or_else(|what| none(what, place))?;
        match decide(&field) {
            Ok(found) => return Ok(found),
            Err(what) => reason = what,
        }
        if field.is_rational() {
            break;
        }
    }
    none(reason, place)
}

fn stated(model: &Model<'_>, point: &PointReport, name: String) -> Result<Stated, NoTheorem> {
    let place = place(point);
    let image = point.image.clone().unwrap_or_else(|| point.position.clone());
    let statement = match point.kind {
        Kind::NoTangent => no_tangent(model, point, &place)?,
        _ => decided(point, &place, |field| with_tangent(model, point, field))?,
    };
    Ok(Stated { name, place, statement, image })
}

fn with_tangent(model: &Model<'_>, point: &PointReport, field: &Field) -> Result<Statement, String> {
    let direction = |d: &Direction| field.direction(d).ok_or("a direction in another field");
    let ray = |rays: &[Direction]| match rays {
        [one] => direction(one),
        _ => Err("a side with several rays"),
    };
    let line = || direction(point.tangent.as_ref().ok_or("a line that is not known")?);
    let replayed =
        |branch: &BranchReport, direction: Pairs, mode: Mode| replayed(model, branch, field, direction, mode);
    Ok(match (point.kind, &point.branches[..]) {
        (Kind::SmoothEnd | Kind::HalfTangent, [branch]) => {
            let rays = if point.left.is_empty() { &point.right } else { &point.left };
            Statement::Ray { branch: replayed(branch, ray(rays)?, Mode::Above)? }
        }
        (Kind::Cusp, [branch]) => {
            let (left, right) = (ray(&point.left)?, ray(&point.right)?);
            if left != right {
                return Err("rays that do not fit their kind".to_owned());
            }
            Statement::Ray { branch: replayed(branch, right, Mode::Above)? }
        }
        (Kind::Regular, [branch]) if model.forward() => {
            Statement::Passes { branch: replayed(branch, ray(&point.right)?, Mode::Sides)? }
        }
        (Kind::Regular | Kind::Oscillating | Kind::Line, [branch]) => {
            Statement::Line { branch: replayed(branch, line()?, Mode::Apart)? }
        }
        (Kind::Regular | Kind::Cusp | Kind::Corner, [before, after]) => {
            let (left, right) = (ray(&point.left)?, ray(&point.right)?);
            let minor = field.independent(&left, &right);
            let fits = match point.kind {
                Kind::Regular => left == right.negated(),
                Kind::Cusp => left == right,
                _ => minor.is_some(),
            };
            if !fits {
                return Err("rays that do not fit their kind".to_owned());
            }
            let before = replayed(before, left, Mode::Above)?;
            let after = replayed(after, right, Mode::Above)?;
            Statement::Joint { kind: point.kind, before, after, minor: minor.unwrap_or((0, 0)) }
        }
        (kind, branches) => {
            return Err(format!("a point of the kind “{}” with {} branches", kind.word(), branches.len()));
        }
    })
}

fn no_tangent(model: &Model<'_>, point: &PointReport, place: &str) -> Result<Statement, NoTheorem> {
    let mut reason = "a point without a tangent line and without branches".to_owned();
    let several = point.branches.iter().find_map(|b| match refuted::of(model.shape, b) {
        Ok(refuted) => Some((b, refuted)),
        Err(what) => {
            reason = what;
            None
        }
    });
    let Some((branch, refuted)) = several else { return none(reason, place) };
    Ok(Statement::NoTangent { address: branch.address.clone(), point: branch.fixed.clone(), refuted })
}

fn replayed(
    model: &Model<'_>,
    branch: &BranchReport,
    field: &Field,
    direction: Pairs,
    mode: Mode,
) -> Result<Replayed, String> {
    let evidence = evidence::of(model.given(), branch, field, &direction, mode)
        .map_err(|what| format!("{what} at the branch {}", branch.address))?;
    let (prefix, cycle) = (branch.address.prefix.clone(), branch.address.cycle.clone());
    Ok(Replayed { prefix, cycle, direction, evidence })
}
