//! The answers of `secant region` about curves as a document and as data.

use super::document::{Block, Document, Inline, Line, Table, code, words};
use super::region::{complete, ends, gap, part_data, place, tone, word_reason};
use crate::case::CurveFamilyCase;
use crate::linalg::Matrix;
use crate::picture::bar;
use crate::poly::Poly;
use crate::shape::word_text;
use crate::statement::Statement;
use crate::theorem::region::{Basis, CurveClaim, CurveEnd, CurvePart, CurveRegions, CurveTable, Subject, Why};
use serde_json::{Value, json};
use std::iter;

/// What a table claims.
fn claim(subject: Subject) -> &'static str {
    match subject {
        Subject::Contraction => "the system contracts",
        Subject::Curve(CurveClaim::Ends) => "the curve has a tangent line at both ends",
        Subject::Curve(CurveClaim::Joints) => "the curve has a tangent line at every joint of every level, a dense set",
        Subject::Curve(CurveClaim::G1) => "the curve is G¹: a tangent at every point, which turns continuously",
    }
}

fn heading(subject: Subject) -> &'static str {
    match subject {
        Subject::Contraction => "Contraction",
        Subject::Curve(CurveClaim::Ends) => "Ends",
        Subject::Curve(CurveClaim::Joints) => "Joints",
        Subject::Curve(CurveClaim::G1) => "G¹",
    }
}

/// The name in data, that of the claim of `secant certify`.
fn id(subject: Subject) -> &'static str {
    match subject {
        Subject::Contraction => "contraction",
        Subject::Curve(CurveClaim::Ends) => "tangent-at-ends",
        Subject::Curve(CurveClaim::Joints) => "dense-joints",
        Subject::Curve(CurveClaim::G1) => "g1",
    }
}

fn end_name(end: CurveEnd) -> &'static str {
    match end {
        CurveEnd::Start => "the start",
        CurveEnd::Finish => "the end",
    }
}

/// Why, in a few words.
fn because(found: &CurveRegions, part: &CurvePart) -> String {
    match &part.basis {
        Basis::Hull(k) => {
            let hull = &found.radius.covers[*k].hull;
            format!("radius below 1: hull of {} vertices", hull.vertices.len())
        }
        Basis::Word(k) => word_reason(&found.radius.crossings[*k].word, "1"),
        Basis::NoContraction => "contraction is not proved here".to_owned(),
        Basis::Member => "this member by itself (secant certify)".to_owned(),
        Basis::Irrational => "an irrational value, at which no argument was found".to_owned(),
        Basis::Search => gap(found.radius.ended).to_owned(),
        Basis::Gap => {
            "no cone, no cover of the rings and no direction that refutes was found; secant certify answers single values".to_owned()
        }
        Basis::Argument(why) => argument(why),
    }
}

/// What an argument says.
pub(super) fn argument(why: &Why) -> String {
    match why {
        Why::InCone => "secants stay in a cone on which the leading coefficients have one sign".to_owned(),
        Why::Cones { slow: false } => "common cones, and regular joints".to_owned(),
        Why::Cones { slow: true } => "common cones that shrink slowly, and regular joints".to_owned(),
        Why::Corner(k) => format!("the joint between the pieces {k} and {}: the lines of both sides differ", k + 1),
        Why::Spiral(end) => format!("{}: the leading eigenvalues are not real", end_name(*end)),
        Why::Alternates(end) => format!("{}: the leading eigenvalue is negative, two rays", end_name(*end)),
        Why::Cusp(k) => format!("the joint between the pieces {k} and {}: both sides have one ray", k + 1),
        Why::Segment => "all pieces lie on one line and go forwards".to_owned(),
        Why::Cells { .. } => "the leading coefficients have one sign on cells that cover the rings".to_owned(),
        Why::SignChange(end) => {
            format!(
                "{}: the leading coefficient takes both signs on the ring, which does not meet the point",
                end_name(*end)
            )
        }
        Why::Jumps(word) => format!("the tangents of joints do not tend to that of ({})", word_text(word)),
    }
}

fn statement(basis: &Basis) -> Option<Statement> {
    Some(match basis {
        Basis::Hull(_) => Statement::FamilyHulls,
        Basis::Word(_) => Statement::FamilyWords,
        Basis::Argument(why) => argument_statement(why),
        Basis::NoContraction | Basis::Member | Basis::Irrational | Basis::Gap | Basis::Search => return None,
    })
}

/// The statement that an argument uses.
pub(super) fn argument_statement(why: &Why) -> Statement {
    match why {
        Why::InCone => Statement::ConeEnds,
        Why::Cones { slow: false } | Why::Segment => Statement::Theorem6,
        Why::Cones { slow: true } => Statement::Theorem6Slow,
        Why::Corner(_) => Statement::LowerBounds,
        Why::Spiral(_) | Why::Alternates(_) | Why::Cusp(_) => Statement::Corollary,
        Why::Jumps(_) => Statement::TangentsJump,
        Why::Cells { longer: false } => Statement::Theorem2,
        Why::Cells { longer: true } => Statement::Theorem3,
        Why::SignChange(_) => Statement::Theorem4Sign,
    }
}

fn rows(m: &Matrix<Poly>, parameter: &str) -> String {
    let row = |i: usize| m.row(i).iter().map(|f| f.display(parameter)).collect::<Vec<_>>().join(", ");
    (0..m.rows()).map(row).collect::<Vec<_>>().join("; ")
}

/// A table in print.
pub(super) fn table_block(found: &CurveRegions, table: &CurveTable, parameter: &str) -> Block {
    let row = |part: &CurvePart| {
        let mark: Line = vec![Inline::Mark(tone(part.verdict), part.verdict.word().to_owned())];
        vec![code(place(&part.from, &part.to)), mark, words(because(found, part))]
    };
    Block::Table(Table {
        caption: words(format!("For which {parameter} {}", claim(table.subject))),
        header: vec![code(parameter), words("verdict"), words("because")],
        rows: table.parts.iter().map(row).collect(),
    })
}

/// All tables as a document.
#[must_use]
pub fn document(case: &CurveFamilyCase, found: &CurveRegions) -> Document {
    let p = case.parameter.as_str();
    let fact = |term: String, text: String| (term, words(text));
    let (from, to) = &case.range;
    let mut facts = vec![fact("range".to_owned(), format!("{from} ≤ {p} ≤ {to}"))];
    for (k, m) in case.operators.iter().enumerate() {
        let turned = if case.reversed[k] { ", run backwards" } else { "" };
        facts.push(fact(format!("piece {k}"), format!("{}{turned}", rows(m, p))));
    }
    let mut blocks = vec![Block::Facts(facts)];
    for table in &found.tables {
        blocks.push(Block::Heading(2, words(heading(table.subject))));
        blocks.push(table_block(found, table, p));
    }
    let parts = found.tables.iter().flat_map(|t| &t.parts).map(|part| (&part.from, &part.to));
    blocks.extend(ends(parts, "Ends of intervals", p));
    Document { title: format!("Regions of {}", case.name), blocks }
}

/// The statements that are applied.
pub(super) fn statements(found: &CurveRegions) -> impl Iterator<Item = Statement> {
    found.tables.iter().flat_map(|t| &t.parts).filter_map(|part| statement(&part.basis))
}

/// The document with the statements and the picture, for a file.
#[must_use]
pub fn report(case: &CurveFamilyCase, found: &CurveRegions) -> Document {
    let own = iter::once(Statement::FamilyCurves).chain(statements(found));
    complete(document(case, found), picture(case, found), ("claim", &case.parameter), own)
}

/// A bar for each claim, as SVG and TikZ.
#[must_use]
pub fn picture(case: &CurveFamilyCase, found: &CurveRegions) -> Option<(String, String)> {
    let span =
        |part: &CurvePart| bar::Span { from: part.from.to_f64().0, to: part.to.to_f64().0, verdict: part.verdict };
    let row = |t: &CurveTable| (heading(t.subject).to_owned(), t.parts.iter().map(span).collect());
    let bars: Vec<(String, Vec<bar::Span>)> = found.tables.iter().map(row).collect();
    bar::bars(&case.parameter, &bars)
}

fn basis_data(found: &CurveRegions, part: &CurvePart) -> Value {
    let gap = matches!(part.basis, Basis::Gap | Basis::Search);
    let mut data = part_data((&part.from, &part.to), gap, part.verdict, because(found, part));
    if let Some(statement) = statement(&part.basis) {
        data.insert("statement".to_owned(), json!(statement.id()));
    }
    if let Basis::Word(k) = part.basis {
        data.insert("witness".to_owned(), json!(word_text(&found.radius.crossings[k].word)));
    }
    Value::Object(data)
}

/// The tables as data.
pub(super) fn claims(found: &CurveRegions) -> Value {
    let table = |t: &CurveTable| {
        let parts: Vec<Value> = t.parts.iter().map(|part| basis_data(found, part)).collect();
        json!({"claim": id(t.subject), "statement": claim(t.subject), "table": parts})
    };
    found.tables.iter().map(table).collect()
}

/// All tables with what they are about, as data.
#[must_use]
pub fn data(case: &CurveFamilyCase, found: &CurveRegions) -> Value {
    let operator = |m: &Matrix<Poly>| -> Vec<Vec<String>> {
        (0..m.rows()).map(|i| m.row(i).iter().map(|f| f.display(&case.parameter)).collect()).collect()
    };
    json!({
        "kind": "region",
        "case": case.name,
        "parameter": case.parameter,
        "range": [case.range.0.to_string(), case.range.1.to_string()],
        "pieces": case.operators.iter().map(operator).collect::<Vec<_>>(),
        "reversed": case.reversed,
        "claims": claims(found),
        "left_out": [],
    })
}
