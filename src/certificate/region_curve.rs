//! Certificates of the regions of a curve with a parameter.

use super::Certificate;
use super::region::{end, hull, text};
use crate::answer::Verdict;
use crate::poly::Poly;
use crate::theorem::region::{Basis, CurveClaim, CurveEnd, CurvePart, CurveRegions, CurveTable, Fact, Subject, Why};
use serde_json::{Value, json};

/// The certificate of the parts that have one; members that were asked are in it as undetermined.
#[must_use]
pub fn curve_region_certificate(name: &str, found: &CurveRegions) -> Certificate {
    let mut all = Vec::new();
    let hulls: Vec<Value> = found.radius.covers.iter().map(hull).collect();
    let mut table = |subject: Subject| -> Vec<Value> {
        let own = found.tables.iter().filter(|t| t.subject == subject);
        own.flat_map(|t: &CurveTable| &t.fine).map(|p| part(found, p, &mut all)).collect()
    };
    let contraction = table(Subject::Contraction);
    let claims = CurveClaim::ALL.map(|c| json!({"claim": claim(c), "parts": table(Subject::Curve(c))}));
    let facts: Vec<Value> = found.facts.iter().filter(|f| !f.evidence.beyond).map(fact).collect();
    let verdict = Verdict::all(all.len(), all);
    let proof = json!({"hulls": hulls, "contraction": contraction, "facts": facts, "claims": claims});
    Certificate::new("region", name, verdict.word(), proof)
}

fn claim(claim: CurveClaim) -> &'static str {
    match claim {
        CurveClaim::Ends => "ends",
        CurveClaim::Joints => "joints",
        CurveClaim::G1 => "g1",
    }
}

fn poly(f: &Poly) -> Value {
    f.coeffs().iter().map(text).collect()
}

fn number(end: CurveEnd) -> usize {
    match end {
        CurveEnd::Start => 0,
        CurveEnd::Finish => 1,
    }
}

fn fact(fact: &Fact) -> Value {
    let own = &fact.evidence;
    let (why, at) = match &fact.why {
        Why::InCone => ("in-cone", Vec::new()),
        Why::Cones { .. } => ("cones", vec![own.window]),
        Why::Corner(k) => ("corner", vec![*k]),
        Why::Cusp(k) => ("cusp", vec![*k]),
        Why::Spiral(end) => ("spiral", vec![number(*end)]),
        Why::Alternates(end) => ("alternates", vec![number(*end)]),
        Why::Segment => ("segment", Vec::new()),
        Why::Cells { .. } => ("cells", Vec::new()),
        Why::SignChange(end) => ("sign-change", vec![number(*end)]),
        Why::Jumps(_) => ("jumps", own.place.iter().flat_map(|p| [p.0, p.1]).collect()),
    };
    let values: Vec<Value> = own.values.iter().map(|v| v.as_ref().map_or(Value::Null, poly)).collect();
    let rays: Vec<Vec<Value>> = own.rays.iter().map(|r| r.iter().map(poly).collect()).collect();
    let cycles: Vec<Value> = own.cycles.iter().map(|(w, v)| json!({"word": w, "value": poly(v)})).collect();
    json!({
        "claim": claim(fact.claim),
        "verdict": fact.verdict.word(),
        "why": why,
        "span": own.span,
        "at": at,
        "values": values,
        "rays": rays,
        "cycles": cycles,
    })
}

fn part(found: &CurveRegions, part: &CurvePart, all: &mut Vec<Verdict>) -> Value {
    let (verdict, rule, by) = match (&part.basis, part.fact) {
        (Basis::Hull(k), _) => (Verdict::Proved, "hull", json!([k])),
        (Basis::Word(k), _) => (Verdict::Refuted, "word", json!(found.radius.crossings[*k].word)),
        (Basis::Argument(_), Some((fact, hull))) if !found.facts[fact].evidence.beyond => {
            let place = found.facts[..fact].iter().filter(|f| !f.evidence.beyond).count();
            (part.verdict, "fact", json!([place, hull]))
        }
        _ => (Verdict::Undetermined, "none", json!([])),
    };
    all.push(verdict);
    json!({"from": end(&part.from), "to": end(&part.to), "verdict": verdict.word(), "rule": rule, "by": by})
}
