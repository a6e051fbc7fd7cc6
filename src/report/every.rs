//! What is known of every point of a curve, in words and as data.

use super::document::{Inline, Line, line, words};
use super::radius::decimal;
use super::reasons;
use super::values::root_math;
use super::words::{count, listed, mark, point_name};
use crate::case::Case;
use crate::shape::word_text;
use crate::theorem::cone::{CommonCone, ConeObstacle};
use crate::theorem::{
    Certified, Component, Components, Everywhere, Hodograph, Kind, Measure, PointReport, Turn, Verdict,
};
use serde_json::{Value, json};

/// What Theorem 12 says.
pub(super) const GRAPH: &str =
    "the curve is a graph over its uniform parameter, with a continuous derivative (Theorem 12)";
/// Places of an exponent.
const PLACES: u64 = 6;

/// What is claimed, in a few words.
#[must_use]
pub fn claim(every: &Everywhere) -> String {
    match (every.verdict, &every.cone) {
        (Verdict::Proved, _) => "G¹: an oriented tangent at every point, which turns continuously".to_owned(),
        (Verdict::Refuted, Some(_)) if every.seen => {
            "G¹; but both half-tangents exist at every point, and they are opposite at every inner point that is no image of a \
             first-level joint".to_owned()
        }
        (_, Some(_)) if every.seen => "G¹; but both half-tangents exist at every point".to_owned(),
        (_, Some(_)) => "G¹; but before the projection both half-tangents exist at every point".to_owned(),
        (_, None) => "G¹ (an oriented tangent at every point, which turns continuously)".to_owned(),
    }
}

/// Terms and what is to be said about them.
#[must_use]
pub fn facts(case: &Case, found: &Certified, every: &Everywhere) -> Vec<(String, Line)> {
    let mut verdict = vec![mark(every.verdict)];
    verdict.extend(words(format!(": {}", claim(every))));
    if let Some(reason) = reasons::everywhere(found, every) {
        verdict.extend(words(format!("; {reason}")));
    }
    let mut facts = vec![("smoothness".to_owned(), verdict)];
    if let Some(order) = &every.derivative {
        let text = match order.shares {
            None => GRAPH,
            Some(_) => {
                "the curve is a graph over a parameter of which each piece takes its share, with a continuous derivative (Theorem 12)"
            }
        };
        facts.push(("derivative".to_owned(), words(text)));
    }
    if let Some(parts) = &every.components {
        facts.push(("components".to_owned(), components(case, parts)));
    }
    if let Some(cone) = &every.cone {
        facts.push(("cones".to_owned(), cones(case, cone)));
    }
    if let (Some(exponent), Some(rate)) = (&every.exponent, every.cone.as_ref().and_then(|c| c.rate.as_ref())) {
        let text = format!(
            "the tangent is Hölder-continuous in {} with an exponent of at least {} (products of {} \
             shrink the Hilbert diameter of the cones to at most {} of its size)",
            super::claims::parameter(if case.shape.has_shares() { Measure::Shares } else { Measure::Uniform }),
            decimal(exponent, false, PLACES),
            count(rate.length, "letter"),
            decimal(&rate.shrink().hi, true, PLACES)
        );
        facts.push(("tangent".to_owned(), words(text)));
    }
    if let Some(h) = &every.hodograph {
        facts.push(("derivative".to_owned(), words(reasons::arcs(h))));
    }
    if let Some(point) = every.witness.and_then(|k| found.points.get(k)) {
        facts.push(("witness".to_owned(), witness(case, point)));
    }
    if let Some(o) = every.obstacle.as_ref().filter(|_| every.witness.is_none()) {
        facts.push(("no cone".to_owned(), obstacle(case, o)));
    }
    facts
}

fn witness(case: &Case, point: &PointReport) -> Line {
    let kind = match point.kind {
        Kind::Line | Kind::NoTangent | Kind::Undetermined => reasons::point(point).unwrap_or("no tangent").to_owned(),
        kind => kind.word().to_owned(),
    };
    let mut out = words(format!("{}, address ", point_name(&case.shape, point)));
    out.push(Inline::Code(super::words::addresses(point).join(" = ")));
    out.extend(words(format!(": {kind}")));
    out
}

/// The cycle that admits no strictly invariant cone, with its eigenvalues.
#[must_use]
pub fn obstacle(case: &Case, o: &ConeObstacle) -> Line {
    let place = state_place(case, o.state);
    let text = format!(
        "no cone is mapped strictly into itself (Theorem 6), because the product along the cycle `{}`{place} has {}: ",
        word_text(&o.word),
        reasons::defect(o.reason)
    );
    let mut out = line(&text, []);
    for (k, root) in o.leading.iter().enumerate() {
        if k > 0 {
            out.extend(words(", "));
        }
        out.push(Inline::Math(root_math(root)));
    }
    out
}

fn state_place(case: &Case, state: usize) -> String {
    if case.shape.states.len() > 1 { format!(" of state {}", case.shape.states[state].name) } else { String::new() }
}

/// Why each state is G¹ (Theorem 13).
fn components(case: &Case, found: &Components) -> Line {
    let name = |state: usize| &case.shape.states[state].name;
    let part = |p: &Component| match p {
        Component::Cones { state, .. } => format!("{} has cones", name(*state)),
        Component::Loop { state, letter, .. } => {
            format!("{} is a loop by piece {letter}, towards whose fixed point all tangents turn", name(*state))
        }
        Component::Transient { state, .. } => format!("{} is passed once", name(*state)),
    };
    let mut text = format!("{} (Theorem 13)", listed(&found.parts.iter().map(part).collect::<Vec<_>>()));
    if let Some((_, code)) = &found.sight {
        text += &format!("; nothing is lost in the projection, by functionals behind {}", count(code.len(), "word"));
    }
    words(text)
}

fn cones(case: &Case, cone: &CommonCone) -> Line {
    let each: Vec<String> =
        cone.cones.iter().map(|c| format!("{}{}", count(c.rays.cols(), "ray"), state_place(case, c.state))).collect();
    let mut text = format!("{}; all pieces map them into themselves", listed(&each));
    if !cone.slow.is_empty() {
        let slow: Vec<String> = cone.slow.iter().map(|s| format!("`{}`", word_text(&s.word))).collect();
        text += &format!(
            ", and every {} are mapped strictly inside, except along {}, where the cones shrink to an eigenvector (slowly)",
            count(cone.window, "letter"),
            listed(&slow)
        );
    } else if cone.window == 1 {
        text += " strictly";
    } else {
        text += &format!(", strictly within every {}", count(cone.window, "letter"));
    }
    line(&text, [])
}

/// The arcs of a polynomial curve, and where its direction turns back.
fn derivative(h: &Hodograph) -> Value {
    let polynomial = |p: &crate::poly::Poly| p.coeffs().iter().map(ToString::to_string).collect::<Vec<_>>();
    let turns = h.turns.iter().map(|turn| match turn {
        Turn::Inside(k, root) => json!({"arc": k, "parameter": super::json::root_value(root)}),
        Turn::Between(k) => json!({"between": [k, k + 1]}),
    });
    json!({
        "arcs": h.spans.iter().map(|s| json!({
            "cell": word_text(&s.path),
            "coordinates": s.coordinates.iter().map(polynomial).collect::<Vec<_>>(),
            "divisor": polynomial(&s.divisor),
        })).collect::<Vec<_>>(),
        "turns": turns.collect::<Vec<_>>(),
    })
}

/// The same as data.
#[must_use]
pub fn value(found: &Certified) -> Value {
    let Some(every) = &found.everywhere else { return Value::Null };
    let text = |v: &[crate::arith::Rational]| v.iter().map(ToString::to_string).collect::<Vec<_>>();
    let matrix = |m: &crate::linalg::Matrix| (0..m.rows()).map(|i| text(m.row(i))).collect::<Vec<_>>();
    let cone = every.cone.as_ref().map(|c| {
        json!({
            "theorem": c.statement().id(),
            "cones": c.cones.iter().map(|k| json!({
                "state": k.state,
                "rays": matrix(&k.rays.transpose()),
                "functional": text(&k.functional),
                "chord": text(&k.chord),
            })).collect::<Vec<_>>(),
            "maps": c.maps.iter().map(|m| json!({
                "state": m.state, "letter": m.letter, "sign": m.sign, "matrix": matrix(&m.matrix),
            })).collect::<Vec<_>>(),
            "view": c.view.as_deref().map(text),
            "window": c.window,
            "slow": c.slow.iter().map(|s| json!({"state": s.state, "word": word_text(&s.word)})).collect::<Vec<_>>(),
        })
    });
    json!({
        "verdict": every.verdict.word(),
        "claim": claim(every),
        "half_tangents": every.seen && every.cone.is_some() || every.derivative.is_some() || every.components.is_some(),
        "exponent": every.exponent.as_ref().map(|e| decimal(e, false, PLACES)),
        "cone": cone,
        "witness": every.witness.and_then(|k| found.points.get(k)).map(super::words::addresses),
        "obstacle": every.obstacle.as_ref().map(|o| json!({
            "state": o.state,
            "word": word_text(&o.word),
            "product": matrix(&o.product),
            "eigenvalues": o.leading.iter().map(super::json::root_value).collect::<Vec<_>>(),
            "reason": reasons::defect(o.reason),
        })),
        "derivative": every.hodograph.as_ref().map(derivative),
        "reason": reasons::everywhere(found, every),
    })
}
