//! The answers of `secant region` about curves as a document and as data.

use super::document::{Block, Document, Inline, Line, Table, code, words};
use super::region::{definition, end_data, end_text, gap, tone, word_reason};
use crate::algebraic::Root;
use crate::case::CurveFamilyCase;
use crate::linalg::Matrix;
use crate::picture::bar;
use crate::poly::Poly;
use crate::shape::word_text;
use crate::statement::Statement;
use crate::theorem::region::{Basis, CurveClaim, CurveEnd, CurvePart, CurveRegions, CurveTable, Subject, Why};
use serde_json::{Value, json};

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
            "no cone and no direction that refutes was found; secant certify answers single values".to_owned()
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
        Why::Cones { slow: false } => Statement::Theorem6,
        Why::Cones { slow: true } => Statement::Theorem6Slow,
        Why::Corner(_) => Statement::LowerBounds,
        Why::Spiral(_) | Why::Alternates(_) | Why::Cusp(_) => Statement::Corollary,
        Why::Jumps(_) => Statement::TangentsJump,
    }
}

fn place(part: &CurvePart) -> String {
    if part.is_point() {
        return end_text(&part.from);
    }
    format!("({}, {})", end_text(&part.from), end_text(&part.to))
}

fn rows(m: &Matrix<Poly>, parameter: &str) -> String {
    let row = |i: usize| m.row(i).iter().map(|f| f.display(parameter)).collect::<Vec<_>>().join(", ");
    (0..m.rows()).map(row).collect::<Vec<_>>().join("; ")
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
    let mut ends: Vec<&Root> = Vec::new();
    for table in &found.tables {
        blocks.push(Block::Heading(2, words(heading(table.subject))));
        let row = |part: &CurvePart| {
            let mark: Line = vec![Inline::Mark(tone(part.verdict), part.verdict.word().to_owned())];
            vec![code(place(part)), mark, words(because(found, part))]
        };
        blocks.push(Block::Table(Table {
            caption: words(format!("For which {p} {}", claim(table.subject))),
            header: vec![code(p), words("verdict"), words("because")],
            rows: table.parts.iter().map(row).collect(),
        }));
        for end in table.parts.iter().flat_map(|part| [&part.from, &part.to]) {
            if end.rational().is_none() && !ends.iter().any(|e| e.same(end)) {
                ends.push(end);
            }
        }
    }
    let list: Vec<Line> = ends.iter().filter_map(|e| definition(e, p)).map(words).collect();
    if !list.is_empty() {
        blocks.push(Block::Heading(2, words("Ends of intervals")));
        blocks.push(Block::List(list));
    }
    Document { title: format!("Regions of {}", case.name), blocks }
}

/// The document with the statements and the picture, for a file.
#[must_use]
pub fn report(case: &CurveFamilyCase, found: &CurveRegions) -> Document {
    let mut document = document(case, found);
    if let Some((svg, tikz)) = picture(case, found) {
        let alt = format!("For each claim a bar over the range of {}, coloured by verdict.", case.parameter);
        let caption = words("Green: proved. Red: refuted. Violet: undetermined. A vertical line is a single point.");
        document.blocks.insert(1, Block::Figure { svg, tikz, alt, caption });
    }
    let mut own = vec![Statement::FamilyCurves];
    let all = found.tables.iter().flat_map(|t| &t.parts).filter_map(|part| statement(&part.basis));
    all.for_each(|s| {
        if !own.contains(&s) {
            own.push(s);
        }
    });
    document.blocks.push(Block::Heading(2, words("Statements")));
    document.blocks.extend(own.into_iter().map(Block::Statement));
    document
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

fn part_data(found: &CurveRegions, part: &CurvePart) -> Value {
    let mut data = serde_json::Map::new();
    let both = json!([end_data(&part.from), end_data(&part.to)]);
    match (part.is_point(), &part.basis) {
        (true, _) => data.insert("point".to_owned(), end_data(&part.from)),
        (false, Basis::Gap | Basis::Search) => data.insert("gap".to_owned(), both),
        (false, _) => data.insert("interval".to_owned(), both),
    };
    data.insert("verdict".to_owned(), json!(part.verdict.word()));
    data.insert("because".to_owned(), json!(because(found, part)));
    if let Some(statement) = statement(&part.basis) {
        data.insert("statement".to_owned(), json!(statement.id()));
    }
    if let Basis::Word(k) = part.basis {
        data.insert("witness".to_owned(), json!(word_text(&found.radius.crossings[k].word)));
    }
    Value::Object(data)
}

/// All tables as data.
#[must_use]
pub fn data(case: &CurveFamilyCase, found: &CurveRegions) -> Value {
    let table = |t: &CurveTable| {
        let parts: Vec<Value> = t.parts.iter().map(|part| part_data(found, part)).collect();
        json!({"claim": id(t.subject), "statement": claim(t.subject), "table": parts})
    };
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
        "claims": found.tables.iter().map(table).collect::<Vec<_>>(),
        "left_out": [],
    })
}
