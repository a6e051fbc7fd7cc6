//! Certificates of the limit surfaces of meshes.

use super::confirm::{accepted, same_verdict};
use super::vertex::evidence;
use super::{Certificate, Doubt, Unsupported, number, unsupported};
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::mesh::{AtVertex, Float, Found, Model, Reason, Regular, Scheme, Spot};
use malachite_base::num::arithmetic::traits::Floor;
use secant_check::Claim;
use serde_json::{Value, json};

/// Binary places of normals.
const PLACES: u64 = 40;

/// A certificate with the claims that the checker has to make.
struct Covered {
    certificate: Certificate,
    verdict: Verdict,
    claims: Vec<(Claim, Verdict)>,
}

fn exact(x: f64) -> Option<Rational> {
    Rational::try_from(x).ok()
}

/// The limit point and the unit normal, where the format has a rule for the vertex.
fn limit(v: &AtVertex, known: &[usize]) -> Option<Value> {
    let covered = v.smooth == Verdict::Proved && v.kind.inside().is_some_and(|n| known.contains(&n));
    let limit = v.limit.as_ref().filter(|_| covered)?;
    let point = limit.near.map(Float::mid).map(exact);
    let rounded = |x: f64| Some(Rational::from((exact(x)? << PLACES).floor()) >> PLACES);
    let normal = limit.unit?.map(rounded);
    point.into_iter().chain(normal).map(|x| Some(number(&x?))).collect::<Option<Vec<_>>>().map(Value::Array)
}

fn covered(model: &Model, scheme: Scheme, found: &Found, whole: bool) -> Result<Covered, Unsupported> {
    let place = || model.name.clone();
    if model.sharp {
        return unsupported("a mesh with sharp edges or vertices", place());
    }
    let divided = !scheme.triangles() && (0..model.topology.faces()).any(|f| model.topology.polygon(f).len() != 4);
    if divided && !found.closed && found.boundary.is_some() {
        return unsupported("a mesh with a border and faces without four corners", place());
    }
    let rule = scheme.rule().map_err(|error| Unsupported { what: error.to_string(), place: place() })?;
    let (mut known, mut valences, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
    for (n, at) in found.valences.iter().filter(|(_, at)| at.smooth == Verdict::Proved && at.frequency == Some(1)) {
        match evidence(&rule, at) {
            Ok(evidence) => {
                known.push(*n);
                valences.push(evidence);
            }
            Err(why) => left_out.push(why),
        }
    }
    let limits: Vec<Option<Value>> = found.vertices.iter().map(|v| limit(v, &known)).collect();
    let (listed, all) = (limits.iter().flatten().count(), limits.len());
    let line = found.vertices.iter().find_map(|v| match (v.smooth, &v.reason, v.spot) {
        (Verdict::Refuted, Reason::Line, Spot::Vertex(k)) => Some(k),
        _ => None,
    });
    if listed == 0 && line.is_none() {
        return match left_out.into_iter().next() {
            Some(why) => Err(why),
            None => unsupported("a mesh of which nothing is decided by the rules of vertices inside", place()),
        };
    }
    let decided = found.vertices.iter().filter(|v| v.smooth != Verdict::Undetermined).count();
    if decided > listed && line.is_none() {
        let what = format!("{} of {decided} vertices that are decided", decided - listed);
        left_out.push(Unsupported { what, place: place() });
    }
    let name = scheme.name().to_owned();
    let (verdict, listed_all) = match line {
        Some(_) => (Verdict::Refuted, all),
        None if listed == all => (Verdict::Proved, listed),
        None => (Verdict::Undetermined, listed),
    };
    let said = if line.is_some() { Verdict::Refuted } else { Verdict::Proved };
    let mut claims = vec![(Claim::MeshSmooth { scheme: name.clone(), listed: listed_all, all }, said)];
    if listed > 0 {
        claims.push((Claim::MeshLimits { listed, points: 40, normals: 30 }, Verdict::Proved));
    }
    let surface = if whole && line.is_none() { whole_surface(model, scheme, found, verdict) } else { None };
    if let Some(verdict) = surface.as_ref().map(|_| found.regular()).or(line.map(|_| Verdict::Refuted)) {
        claims.push((Claim::MeshRegular { scheme: name.clone() }, verdict));
    } else if found.regular() != Verdict::Undetermined {
        left_out.push(Unsupported { what: "the limit surface as a whole".to_owned(), place: place() });
    }
    let proof = json!({
        "scheme": name,
        "valences": valences,
        "limits": limits,
        "line": line,
        "whole": surface,
    });
    let certificate = Certificate::new("mesh", "mesh", verdict.word(), proof).without(left_out);
    Ok(Covered { certificate, verdict, claims })
}

/// What is said of the whole surface.
fn whole_surface(model: &Model, scheme: Scheme, found: &Found, smooth: Verdict) -> Option<Value> {
    let sizes = if scheme.triangles() { 3 } else { 4 };
    let divided = (0..model.topology.faces()).any(|f| model.topology.polygon(f).len() != sizes);
    match found.regular() {
        Verdict::Proved => (smooth == Verdict::Proved && found.closed).then(|| json!("regular")),
        Verdict::Refuted if !divided => found.patches.bad.iter().find_map(|b| match &b.found {
            Regular::Refuted((u, v)) if b.level == 0 => Some(json!({ "face": b.face, "at": [number(u), number(v)] })),
            _ => None,
        }),
        _ => None,
    }
}

/// Has what was found of a mesh checked by `secant-check`, from the text of the file.
///
/// # Errors
/// [`Doubt::Unsupported`] where the format has no rule for any of it; the other doubts where the checker does not accept the
/// certificate, or makes other claims.
///
/// # Cost
/// That of [`secant_check::check`].
pub fn confirm_mesh(model: &Model, scheme: Scheme, found: &Found) -> Result<Certificate, Doubt> {
    match confirm_part(model, scheme, found, true) {
        // The checker's numbers are of one length: what holds by a little may be too close for them.
        Err(Doubt::Unsupported(why)) if why.place.contains("whole") => confirm_part(model, scheme, found, false),
        answer => answer,
    }
}

fn confirm_part(model: &Model, scheme: Scheme, found: &Found, whole: bool) -> Result<Certificate, Doubt> {
    let Covered { certificate, verdict, claims } = covered(model, scheme, found, whole)?;
    let Some(text) = &model.text else { return unsupported("a mesh file that is no text", model.name.clone())? };
    let accepted = accepted(text, &certificate)?;
    let same = claims.len() == accepted.claims.len()
        && claims.iter().zip(&accepted.claims).all(|((c, v), d)| *c == d.claim && same_verdict(*v, d.verdict));
    if !(same && same_verdict(verdict, accepted.verdict)) {
        return Err(Doubt::Differs(accepted.verdict.word()));
    }
    Ok(certificate)
}
