//! The answers of `secant region` about vertices of meshes as a document and as data.

use super::document::{Block, Document, Inline, Line, Table, code, words};
use super::region::{complete, ends, part_data, place, tone};
use crate::case::VertexFamilyCase;
use crate::picture::bar;
use crate::statement::Statement;
use crate::vertex::Ground;
use crate::vertex::region::{Finding, Gap, Part, VertexRegion};
use serde_json::{Value, json};
use std::iter;

/// What a table claims.
const CLAIM: &str = "the surface is C¹ at the vertex for almost all control points";

/// Said beside every answer.
const NO_CERTIFICATE: &str = "There is no certificate format for regions at vertices: the checker proves single values again \
                              (secant certify CASE, with a value for the parameter).";

/// Why, in a few words.
fn because(finding: Finding) -> String {
    let ground = match finding {
        Finding::By(ground) => ground,
        Finding::Open(gap) => return open(gap).to_owned(),
    };
    match ground {
        Ground::Regular => "the characteristic map is regular and winds once".to_owned(),
        Ground::Winding(k) => format!("simple eigenvectors of block {k} lead, and not those of block 1"),
        Ground::Fold => "the characteristic map folds: its Jacobian determinant changes its sign".to_owned(),
        Ground::Line => "one eigenvector leads, and its function has no zero on the ring".to_owned(),
        Ground::Path => {
            "one eigenvector of block 0 leads, and its function has no zero on a closed path around the vertex"
                .to_owned()
        }
        Ground::Sectors => {
            "the two leading eigenvectors are the same in every sector, or in every second one".to_owned()
        }
        Ground::Span => "the leading eigenvectors span three dimensions or more".to_owned(),
        Ground::NoLimit => "besides 1 an eigenvalue has modulus 1 or more: the rings do not shrink".to_owned(),
    }
}

fn open(gap: Gap) -> &'static str {
    match gap {
        Gap::Narrow => "eigenvalues or signs did not separate; a smaller --width divides the gap further",
        Gap::Same => "two leading eigenvalues have one modulus for every value; secant certify answers single values",
        Gap::Ring => {
            "one eigenvector leads, and its function on the ring is not examined for rules without Bézier patches"
        }
        Gap::Meeting => "leading eigenvalues meet here, and no statement covers it",
        Gap::Work => "the work set aside is spent; --effort hard, or --time 600, divides the range further",
        Gap::Clock => "the time is over; a larger --time divides the range further",
    }
}

fn weights(case: &VertexFamilyCase) -> String {
    let list: Vec<String> = case.weights.iter().map(|(name, f)| format!("{name} = {f}")).collect();
    list.join(", ")
}

/// The tables of all valences as a document.
#[must_use]
pub fn document(case: &VertexFamilyCase, found: &[VertexRegion]) -> Document {
    let p = case.parameter.as_str();
    let fact = |term: &str, text: String| (term.to_owned(), words(text));
    let (from, to) = &case.range;
    let mut facts = vec![fact("rule", case.scheme.clone()), fact("range", format!("{from} ≤ {p} ≤ {to}"))];
    if !case.weights.is_empty() {
        facts.insert(1, fact("weights", weights(case)));
    }
    let mut blocks = vec![Block::Facts(facts)];
    for region in found {
        blocks.push(Block::Heading(2, words(format!("Valence {}", region.valence))));
        let row = |part: &Part| {
            let verdict = part.finding.verdict();
            let mark: Line = vec![Inline::Mark(tone(verdict), verdict.word().to_owned())];
            vec![code(place(&part.from, &part.to)), mark, words(because(part.finding))]
        };
        blocks.push(Block::Table(Table {
            caption: words(format!("For which {p} {CLAIM}")),
            header: vec![code(p), words("verdict"), words("because")],
            rows: region.parts.iter().map(row).collect(),
        }));
    }
    let parts = found.iter().flat_map(|r| &r.parts).map(|part| (&part.from, &part.to));
    blocks.extend(ends(parts, "Ends of intervals", p));
    blocks.push(Block::Paragraph(words(NO_CERTIFICATE)));
    Document { title: format!("Regions of {}", case.name), blocks }
}

/// The document with the statements and the picture, for a file.
#[must_use]
pub fn report(case: &VertexFamilyCase, found: &[VertexRegion]) -> Document {
    let parts = found.iter().flat_map(|r| &r.parts);
    let own = iter::once(Statement::FamilyVertex).chain(parts.filter_map(|part| part.finding.statement()));
    complete(document(case, found), picture(case, found), ("valence", &case.parameter), own)
}

/// A bar for each valence, as SVG and TikZ.
#[must_use]
pub fn picture(case: &VertexFamilyCase, found: &[VertexRegion]) -> Option<(String, String)> {
    let span =
        |part: &Part| bar::Span { from: part.from.to_f64().0, to: part.to.to_f64().0, verdict: part.finding.verdict() };
    let row = |r: &VertexRegion| (format!("valence {}", r.valence), r.parts.iter().map(span).collect());
    let bars: Vec<(String, Vec<bar::Span>)> = found.iter().map(row).collect();
    bar::bars(&case.parameter, &bars)
}

fn finding_data(part: &Part) -> Value {
    let gap = matches!(part.finding, Finding::Open(_));
    let mut data = part_data((&part.from, &part.to), gap, part.finding.verdict(), because(part.finding));
    if let Some(statement) = part.finding.statement() {
        data.insert("statement".to_owned(), json!(statement.id()));
    }
    Value::Object(data)
}

/// All tables as data.
#[must_use]
pub fn data(case: &VertexFamilyCase, found: &[VertexRegion]) -> Value {
    let table = |r: &VertexRegion| {
        let parts: Vec<Value> = r.parts.iter().map(finding_data).collect();
        json!({"valence": r.valence, "statement": CLAIM, "table": parts})
    };
    let weights: serde_json::Map<String, Value> = case.weights.iter().map(|(k, f)| (k.clone(), json!(f))).collect();
    json!({
        "kind": "region",
        "case": case.name,
        "parameter": case.parameter,
        "range": [case.range.0.to_string(), case.range.1.to_string()],
        "rule": case.scheme,
        "weights": weights,
        "valences": found.iter().map(table).collect::<Vec<_>>(),
        "left_out": [],
    })
}
