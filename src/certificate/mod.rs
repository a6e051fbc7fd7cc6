//! Certificates: everything that is needed to prove a verdict again without search, as `docs/certificate.md` specifies.
//!
//! The writer only collects what the theorem checker found. Whether it proves anything is decided by `secant-check`, which
//! shares no code with this crate.
#![deny(clippy::disallowed_methods)]

mod border;
mod branch;
mod components;
mod confirm;
mod everywhere;
mod frames;
mod hull;
mod joint;
mod lattice;
mod mesh;
mod radius;
mod region;
mod region_curve;
mod regularity;
mod solve;
mod spectrum;
mod surface;
mod top;
mod tree;
mod vertex;
mod written;

pub use border::border_certificate;
pub use confirm::{Doubt, checked, confirm, confirm_flat, confirm_orders};
pub use joint::radius_certificate;
pub use lattice::lattice_certificate;
pub use mesh::confirm_mesh;
pub use region::region_certificate;
pub use region_curve::curve_region_certificate;
pub use regularity::regularity_certificate;
pub use solve::solve_certificate;
pub use vertex::{confirm_vertices, vertex_certificate};
pub use written::Written;

use crate::arith::Rational;
use crate::case::Case;
use crate::shape::{Address, CellKind, Contraction, HullWeights, Shape};
use crate::theorem::{Assertion, Certified, Claim, PointReport, Role, Verdict};
use serde_json::{Value, json};
use std::cell::RefCell;
use thiserror::Error;

pub use spectrum::{Operator, spectra};

/// A certificate in the format of `docs/certificate.md`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Certificate {
    json: Value,
    left_out: Vec<Unsupported>,
}

/// Why there is no certificate: something in the verdict has no rule in the format.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no rule of the certificate format covers {what} ({place})")]
pub struct Unsupported {
    /// What cannot be expressed.
    pub what: String,
    /// Where it occurs.
    pub place: String,
}

/// The place of what is found of a dense set of joints.
const JOINTS: &str = "joints";

fn unsupported<T>(what: impl Into<String>, place: impl Into<String>) -> Result<T, Unsupported> {
    Err(Unsupported { what: what.into(), place: place.into() })
}

impl Certificate {
    /// The envelope that all certificates share, around the proof of one kind.
    #[must_use]
    pub fn new(kind: &str, case: &str, verdict: &str, proof: Value) -> Self {
        let json = json!({
            "format": "secant certificate",
            "version": 1,
            "kind": kind,
            "case": case,
            "verdict": verdict,
            "proof": proof,
        });
        Self { json, left_out: Vec::new() }
    }

    /// The same certificate, of which is said that something that was found is not in it.
    #[must_use]
    pub fn without(mut self, left_out: impl IntoIterator<Item = Unsupported>) -> Self {
        self.left_out.extend(left_out);
        self
    }

    /// What was found besides and could not be written: it is proved once only.
    #[must_use]
    pub fn left_out(&self) -> &[Unsupported] {
        &self.left_out
    }

    /// Whether what was found of a dense set of joints is among that.
    #[must_use]
    pub fn leaves_out_joints(&self) -> bool {
        self.left_out.iter().any(|why| why.place == JOINTS)
    }

    /// Whether it has the answer about every point of a surface with this verdict.
    #[must_use]
    pub fn decides_every_plane(&self, verdict: Verdict) -> bool {
        self.json["proof"]["every"]["verdict"] == verdict.word()
    }

    /// The certificate as JSON.
    #[must_use]
    pub fn json(&self) -> &Value {
        &self.json
    }

    /// Whether it has the answer to "every point" with this verdict.
    #[must_use]
    pub fn decides_every_point(&self, verdict: Verdict) -> bool {
        let answers = self.json["proof"]["answers"].as_array();
        answers.is_some_and(|answers| {
            answers.iter().any(|a| {
                a["question"].as_str().is_some_and(|q| q.starts_with("every point")) && a["verdict"] == verdict.word()
            })
        })
    }

    /// The text of the certificate file: one line for each item of the lists of the proof.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = laid_out(&self.json, 0);
        text.push('\n');
        text
    }
}

/// Objects down to the proof and lists in it with one item a line.
fn laid_out(value: &Value, depth: usize) -> String {
    let (open, close, items): (_, _, Vec<String>) = match value {
        Value::Object(fields) if depth < 2 => {
            let field = |(name, value): (&String, &Value)| format!("{}: {}", json!(name), laid_out(value, depth + 1));
            ('{', '}', fields.iter().map(field).collect())
        }
        Value::Array(items) if depth == 2 && !items.is_empty() => {
            ('[', ']', items.iter().map(ToString::to_string).collect())
        }
        other => return other.to_string(),
    };
    let margin = " ".repeat(depth);
    format!("{open}\n{margin} {}\n{margin}{close}", items.join(&format!(",\n{margin} ")))
}

/// Writes the certificate of what was found for a case.
///
/// # Errors
/// [`Unsupported`] where a decided point or claim has no rule in the format, or contraction is not proved.
///
/// # Cost
/// Linear in the evidence, apart from the choice of radii between neighbouring moduli.
pub fn certificate(case: &Case, found: &Certified) -> Result<Certificate, Unsupported> {
    if let Some(found_surface) = &found.surface {
        return surface::surface(case, found, found_surface);
    }
    flat_certificate(case, found)
}

/// The same for a curve or a set, also over a number field.
///
/// # Errors
/// As [`certificate`]; over a number field also where the entries do not generate the field of the roots and cosines of the text.
pub fn flat_certificate<E: Written>(case: &Case<E>, found: &Certified<E>) -> Result<Certificate, Unsupported> {
    let field = E::field(case)?;
    let radii = found.states.iter().map(|r| (r.state, &r.radius));
    let hulls = found.polygons.as_deref().map(|polygons| (polygons, found.polygon_weights.as_ref()));
    let states = contraction(&case.shape, &found.contraction, radii, hulls)?;
    let points = Points { case, listed: RefCell::new(Vec::new()) };
    let mut left_out = Vec::new();
    let answers = answers(case, found, &points, &mut left_out)?;
    let listed: Value = points.listed.into_inner().into_iter().map(|(_, point)| point).collect();
    let proof = match field {
        None => json!({"contraction": states, "points": listed, "answers": answers}),
        Some(field) => json!({"field": field, "contraction": states, "points": listed, "answers": answers}),
    };
    Ok(Certificate::new("certify", &case.name, found.verdict.word(), proof).without(left_out))
}

/// Why a system contracts, and what encloses its attractors, by reachable state.
fn contraction<'a, E: Written>(
    shape: &Shape<E>,
    found: &Contraction,
    radii: impl Iterator<Item = (usize, &'a Rational)>,
    polygons: Option<(&[Vec<Vec<E>>], Option<&HullWeights>)>,
) -> Result<Value, Unsupported> {
    let mut states = Vec::new();
    let simplex = E::simplex(shape);
    for (state, radius) in radii {
        let code = match found {
            Contraction::Proved(proof) => tree::code(shape, state, &proof.codes[state])?,
            Contraction::Polytopes(proof) => hull::polytope(proof, state),
            _ => return unsupported("a system whose contraction is not proved", "contraction"),
        };
        let hull = match polygons {
            Some((polygons, Some(weights))) => hull::with_weights(&polygons[state], &weights[state]),
            Some((polygons, None)) => hull::hull(shape, state, polygons)?,
            None => match &simplex {
                Some(simplex) => simplex.clone(),
                None => Value::Null,
            },
        };
        states.push(json!({"state": state, "radius": number(radius), "code": code, "hull": hull}));
    }
    Ok(Value::Array(states))
}

/// The SHA-256 digest of a text or of bytes, in hexadecimal.
#[must_use]
pub fn sha256(text: impl AsRef<[u8]>) -> String {
    use sha2::{Digest, Sha256};
    Sha256::digest(text.as_ref()).iter().map(|b| format!("{b:02x}")).collect()
}

fn number(x: &Rational) -> Value {
    Value::String(x.to_string())
}

fn numbers(v: &[Rational]) -> Value {
    v.iter().map(number).collect()
}

fn address_json(address: &Address) -> Value {
    json!({"prefix": address.prefix, "cycle": address.cycle})
}

fn place_json<E: Written>(point: &PointReport<E>) -> Value {
    match &point.role {
        Role::LeftEnd => json!({"at": "left end"}),
        Role::RightEnd => json!({"at": "right end"}),
        Role::Joint { path, left, right, .. } => json!({"at": "joint", "path": path, "left": left, "right": right}),
        Role::Interior => json!({"at": "inside", "address": address_json(&point.branches[0].address)}),
        Role::SetPoint => json!({"at": "of set", "address": address_json(&point.branches[0].address)}),
    }
}

/// An answer to a question that the case does not ask.
type Further = Result<Option<Value>, Unsupported>;

/// The decided points that answer a question, each once: their places and what is written about them.
struct Points<'a, E: Written> {
    case: &'a Case<E>,
    listed: RefCell<Vec<(Value, Value)>>,
}

impl<E: Written> Points<'_, E> {
    /// The index of a decided point, which is listed from now on.
    fn index(&self, point: &PointReport<E>) -> Result<usize, Unsupported> {
        if point.verdict == Verdict::Undetermined {
            return unsupported("a point that is not decided", branch::branch_name(&point.branches[0]));
        }
        let place = place_json(point);
        let mut listed = self.listed.borrow_mut();
        if let Some(index) = listed.iter().position(|(p, _)| *p == place) {
            return Ok(index);
        }
        let json = branch::point(&self.case.shape, point, &place)?;
        listed.push((place, json));
        Ok(listed.len() - 1)
    }

    /// An answer, or none: then the points that were listed for it, after so many others, are taken off again.
    fn only_for(&self, answer: Further, before: usize) -> Further {
        if !matches!(answer, Ok(Some(_))) {
            self.listed.borrow_mut().truncate(before);
        }
        answer
    }

    /// The indices of the decided points among those for which `wanted` holds.
    fn indices(
        &self,
        found: &Certified<E>,
        wanted: impl Fn(&PointReport<E>) -> bool,
    ) -> Result<Vec<usize>, Unsupported> {
        let decided = found.points.iter().filter(|p| wanted(p) && p.verdict != Verdict::Undetermined);
        let mut indices = decided.map(|p| self.index(p)).collect::<Result<Vec<_>, _>>()?;
        indices.sort_unstable();
        indices.dedup();
        Ok(indices)
    }
}

/// The answers to the questions of the case, in their order; what is no question of the case and has no rule is left out, and
/// named.
fn answers<E: Written>(
    case: &Case<E>,
    found: &Certified<E>,
    points: &Points<'_, E>,
    left_out: &mut Vec<Unsupported>,
) -> Result<Vec<Value>, Unsupported> {
    let shape = &case.shape;
    let curve = shape.states[shape.start].kind == CellKind::Edge;
    let mut answers = Vec::new();
    if curve {
        let ends = points.indices(found, |p| matches!(p.role, Role::LeftEnd | Role::RightEnd))?;
        let verdict = match found.claims.iter().find(|c| c.what == Assertion::TangentAtEnds) {
            Some(claim) => claim.verdict(),
            None => Verdict::Undetermined,
        };
        answers.push(json!({"question": "ends", "verdict": verdict.word(), "points": ends}));
        answers.push(joints(case, found, points)?);
    }
    let mut asked: Vec<Address> = Vec::new();
    if !curve {
        let pieces = shape.states[shape.start].pieces.iter().enumerate();
        asked.extend(pieces.filter(|(_, p)| p.target == shape.start).map(|(i, _)| Address::periodic(vec![i])));
    }
    for address in &case.examine {
        match address.normalise(shape, shape.start) {
            Ok(address) if asked.contains(&address) => {}
            Ok(address) => asked.push(address),
            Err(error) => return unsupported(error.to_string(), "examine"),
        }
    }
    // Addresses that were asked for besides those of the case come after them.
    let claims: Vec<_> = found.claims.iter().filter_map(|c| Some((c.verdict(), c.what.asked()?))).collect();
    for (_, (address, _)) in &claims {
        if !asked.contains(address) {
            asked.push((*address).clone());
        }
    }
    for address in &asked {
        let (verdict, point) = match claims.iter().find(|(_, (a, _))| *a == address) {
            Some((verdict, (_, k))) => (*verdict, k.map(|k| &found.points[k])),
            None => (Verdict::Undetermined, None),
        };
        let index = match point.filter(|p| p.verdict != Verdict::Undetermined) {
            Some(point) => vec![points.index(point)?],
            None if verdict == Verdict::Undetermined => Vec::new(),
            None => return unsupported("an answer without a decided point", address.to_string()),
        };
        let address = address_json(address);
        answers.push(json!({"question": "address", "address": address, "verdict": verdict.word(), "points": index}));
    }
    let before = points.listed.borrow().len();
    let every = E::every(shape, found, &|point| points.index(point));
    for further in [not_killed(case, found), points.only_for(every, before)] {
        match further {
            Ok(answer) => answers.extend(answer),
            Err(why) => left_out.push(why),
        }
    }
    if let Some(similarities) = &found.similarities {
        let product = written::matrix(&similarities.gram);
        answers.push(json!({"question": "any point", "verdict": "refuted", "products": [product]}));
    }
    Ok(answers)
}

/// The verdict on the joints: of those examined, and of a dense set where that is claimed.
fn joints_verdict<E: Written>(found: &Certified<E>) -> Verdict {
    let refuted = |p: &PointReport<E>| matches!(p.role, Role::Joint { .. }) && p.verdict == Verdict::Refuted;
    if found.points.iter().any(refuted) {
        return Verdict::Refuted;
    }
    let claims: Vec<Verdict> = found.claims.iter().filter(|c| c.what.is_of_joints()).map(Claim::verdict).collect();
    Verdict::all(claims.len(), claims)
}

fn joints<E: Written>(case: &Case<E>, found: &Certified<E>, points: &Points<'_, E>) -> Result<Value, Unsupported> {
    let verdict = joints_verdict(found);
    let listed = points.indices(found, |p| matches!(p.role, Role::Joint { .. }))?;
    let (theorem, upstairs) = match verdict {
        Verdict::Proved => dense(case, found)?,
        _ => ("none", json!([])),
    };
    Ok(json!({
        "question": "joints",
        "verdict": verdict.word(),
        "theorem": theorem,
        "points": listed,
        "upstairs": upstairs,
    }))
}

/// The theorem on a dense set of joints, with what it needs of joints seen from their own states.
fn dense<E: Written>(case: &Case<E>, found: &Certified<E>) -> Result<(&'static str, Value), Unsupported> {
    let Some(claim) = found.dense_claim() else { return unsupported("this theorem", JOINTS) };
    if claim.statement().is_some_and(|s| s.uses_frames()) {
        let Some(frames) = found.dense.as_ref().and_then(|d| d.frames.as_ref()) else {
            return unsupported("frames that are not there", JOINTS);
        };
        let theorem = if claim.what == Assertion::UnkilledJoints { "11'" } else { "11" };
        return Ok((theorem, E::frames(&case.shape, frames)?));
    }
    match claim.what {
        Assertion::DenseJoints => Ok(("5", json!([]))),
        Assertion::ProjectedJoints => {
            let mut joints = Vec::new();
            for point in found.dense.iter().flat_map(|d| &d.upstairs) {
                let Role::Joint { state, left, right, .. } = &point.role else {
                    return unsupported("a point that is no joint", JOINTS);
                };
                let place = json!({"at": "joint", "path": [], "left": left, "right": right});
                let point = branch::point(&case.shape, point, &place)?;
                joints.push(json!({"state": state, "point": point}));
            }
            Ok(("5'", Value::Array(joints)))
        }
        _ => unsupported("this theorem", JOINTS),
    }
}

/// Theorem 5′ or 11′ beside joints that are not all proved.
fn not_killed<E: Written>(case: &Case<E>, found: &Certified<E>) -> Result<Option<Value>, Unsupported> {
    let proved = found.dense_claim().is_some_and(|c| c.verdict() == Verdict::Proved);
    if !proved || joints_verdict(found) == Verdict::Proved {
        return Ok(None);
    }
    // Whatever stands in the way, it is the dense set that is left out.
    let written = dense(case, found).map_err(|why| match why.place.as_str() {
        JOINTS => why,
        place => Unsupported { what: format!("{} at {place}", why.what), place: JOINTS.to_owned() },
    })?;
    match written {
        (theorem @ ("5'" | "11'"), upstairs) => Ok(Some(json!({
            "question": "joints not killed",
            "verdict": "proved",
            "theorem": theorem,
            "upstairs": upstairs,
        }))),
        _ => unsupported("this theorem beside joints that are not all proved", JOINTS),
    }
}
