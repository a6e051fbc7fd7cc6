//! The answers of `secant region` about two parameters as a document and as data.

use super::document::{Block, Document, Inline, Line, Table, code, words};
use super::region::{tone, with_statements};
use super::region_curve::{argument, argument_statement, claims, statements, table_block};
use crate::answer::Verdict;
use crate::arith::{Rational, to_f64};
use crate::case::PlaneFamilyCase;
use crate::picture::plane;
use crate::radius::Ended;
use crate::shape::word_text;
use crate::statement::Statement;
use crate::theorem::region::{CurveClaim, CurveTable, Known, LineRegion, PlaneBox, PlaneLine, PlaneRegion, Subject};
use serde_json::{Value, json};

/// What is claimed.
const CLAIM: &str = "the curve is G¹: a tangent at every point, which turns continuously";

/// What is said of a box, in a word.
fn word(known: &Known) -> &'static str {
    match known {
        Known::Curve(verdict, _) => verdict.word(),
        Known::Expands(_) => "no contraction",
        Known::Contracts | Known::Open => "undetermined",
    }
}

fn contraction(known: &Known) -> Verdict {
    match known {
        Known::Curve(..) | Known::Contracts => Verdict::Proved,
        Known::Expands(_) => Verdict::Refuted,
        Known::Open => Verdict::Undetermined,
    }
}

fn because(known: &Known) -> String {
    match known {
        Known::Curve(_, why) => argument(why),
        Known::Expands(word) => format!("word {}: an eigenvalue outside the unit disc", word_text(word)),
        Known::Contracts => "contracts; no argument about G¹ was found that holds on the whole box".to_owned(),
        Known::Open => "contraction is neither shown nor refuted on the whole box".to_owned(),
    }
}

fn ended(ended: Ended) -> &'static str {
    match ended {
        Ended::Done => "every box is decided",
        Ended::Exhausted => "boxes that are left are as small as --depth allows; a larger one divides them further",
        Ended::Work => "the work set aside is spent; --effort hard divides further",
        Ended::Clock => "the time is over; a larger --time divides further",
    }
}

/// The share of the whole, in per mille.
fn shares(found: &PlaneRegion) -> Vec<(String, String, String, Rational)> {
    let area = |b: &PlaneBox| (&b.area.first.1 - &b.area.first.0) * (&b.area.second.1 - &b.area.second.0);
    let whole = found.boxes.iter().map(area).fold(Rational::from(0), |s, x| s + x);
    let mut all: Vec<(String, String, String, Rational)> = Vec::new();
    for b in &found.boxes {
        let (says, why) = (word(&b.known).to_owned(), because(&b.known));
        let tone = b.known.verdict().word().to_owned();
        let own = area(b) / &whole;
        match all.iter_mut().find(|(s, _, w, _)| *s == says && *w == why) {
            Some(row) => row.3 += own,
            None => all.push((says, tone, why, own)),
        }
    }
    all.sort_by(|a, b| b.3.cmp(&a.3));
    all
}

/// The answer as a document.
#[must_use]
pub fn document(case: &PlaneFamilyCase, found: &PlaneRegion) -> Document {
    let [p, q] = &case.parameters;
    let fact = |term: String, text: String| (term, words(text));
    let range = |k: usize| format!("{} ≤ {} ≤ {}", case.ranges[k].0, case.parameters[k], case.ranges[k].1);
    let mut facts = vec![fact("range".to_owned(), format!("{}, {}", range(0), range(1)))];
    for (k, m) in case.operators.iter().enumerate() {
        let row = |i: usize| m.row(i).iter().map(|f| f.display([p, q])).collect::<Vec<_>>().join(", ");
        let turned = if case.reversed[k] { ", run backwards" } else { "" };
        let rows: Vec<String> = (0..m.rows()).map(row).collect();
        facts.push(fact(format!("piece {k}"), format!("{}{turned}", rows.join("; "))));
    }
    facts.push(fact("boxes".to_owned(), format!("{}; {}", found.boxes.len(), ended(found.ended))));
    let row = |(says, tone_of, why, share): &(String, String, String, Rational)| {
        let of = [Verdict::Proved, Verdict::Refuted, Verdict::Undetermined].into_iter().find(|v| v.word() == tone_of);
        let mark: Line = vec![Inline::Mark(tone(of.unwrap_or(Verdict::Undetermined)), says.clone())];
        vec![mark, code(format!("{:.2} %", to_f64(&(share * Rational::from(100))))), words(why.clone())]
    };
    let mut blocks = vec![
        Block::Facts(facts),
        Block::Table(Table {
            caption: words(format!("In which boxes of {p} and {q} {CLAIM}")),
            header: vec![words("verdict"), words("share"), words("because")],
            rows: shares(found).iter().map(row).collect(),
        }),
    ];
    if !found.borders.is_empty() {
        blocks.push(Block::Heading(2, words("Curves on which boxes are left")));
        let list = found.borders.iter().map(|f| code(format!("{} = 0", f.display([p, q]))));
        blocks.push(Block::List(list.collect()));
    }
    for own in &found.lines {
        let (runs, other) = along(case, &own.line);
        blocks.push(Block::Heading(
            2,
            words(format!("On the line {other}, {} ≤ {runs} ≤ {}", own.line.range.0, own.line.range.1)),
        ));
        let told = |t: &&CurveTable| matches!(t.subject, Subject::Contraction | Subject::Curve(CurveClaim::G1));
        blocks.extend(own.found.tables.iter().filter(told).map(|t| table_block(&own.found, t, runs)));
    }
    blocks.push(Block::Paragraph(words(
        "What is said of a box is said of all its points, edges and corners among them. Nothing is said of the boxes that are left, but \
         on the lines above. There is no certificate format for regions in the plane.",
    )));
    Document { title: format!("Regions of {}", case.name), blocks }
}

/// The parameter that runs along a line, and what the other one is.
fn along<'a>(case: &'a PlaneFamilyCase, line: &PlaneLine) -> (&'a str, String) {
    let (runs, other) = (&case.parameters[line.runs], &case.parameters[1 - line.runs]);
    (runs, format!("{other} = {}", line.other.display(runs)))
}

/// The document with the statements and the picture, for a file.
#[must_use]
pub fn report(case: &PlaneFamilyCase, found: &PlaneRegion) -> Document {
    let mut document = document(case, found);
    let (svg, tikz) = picture(case, found);
    let alt = format!("The plane of {} and {}, coloured by verdict.", case.parameters[0], case.parameters[1]);
    let caption = words("Green: proved. Red: refuted. Grey: no contraction. Violet: undetermined.");
    document.blocks.insert(1, Block::Figure { svg, tikz, alt, caption });
    let of_box = |b: &PlaneBox| match &b.known {
        Known::Curve(_, why) => Some(argument_statement(why)),
        Known::Expands(_) | Known::Contracts | Known::Open => None,
    };
    let on_lines = (!found.lines.is_empty()).then_some(Statement::FamilyCurves);
    let applied = [Statement::FamilyPlane].into_iter().chain(on_lines).chain(found.boxes.iter().filter_map(of_box));
    with_statements(document, applied.chain(found.lines.iter().flat_map(|l| statements(&l.found))))
}

/// The plane as SVG and TikZ.
#[must_use]
pub fn picture(case: &PlaneFamilyCase, found: &PlaneRegion) -> (String, String) {
    let range = |k: usize| (to_f64(&case.ranges[k].0), to_f64(&case.ranges[k].1));
    let float = |(lo, hi): &(Rational, Rational)| (to_f64(lo), to_f64(hi));
    let tile = |b: &PlaneBox| plane::Tile {
        first: float(&b.area.first),
        second: float(&b.area.second),
        class: match &b.known {
            Known::Expands(_) => "outside",
            known => known.verdict().word(),
        },
    };
    let tiles: Vec<plane::Tile> = found.boxes.iter().map(tile).collect();
    plane::plane([&case.parameters[0], &case.parameters[1]], [range(0), range(1)], &tiles, &found.borders)
}

/// The answer as data.
#[must_use]
pub fn data(case: &PlaneFamilyCase, found: &PlaneRegion) -> Value {
    let [p, q] = &case.parameters;
    let range = |(lo, hi): &(Rational, Rational)| json!([lo.to_string(), hi.to_string()]);
    let entry = |b: &PlaneBox| {
        let mut data = serde_json::Map::new();
        data.insert("box".to_owned(), json!([range(&b.area.first), range(&b.area.second)]));
        data.insert("verdict".to_owned(), json!(b.known.verdict().word()));
        data.insert("contraction".to_owned(), json!(contraction(&b.known).word()));
        data.insert("because".to_owned(), json!(because(&b.known)));
        match &b.known {
            Known::Curve(_, why) => data.insert("statement".to_owned(), json!(argument_statement(why).id())),
            Known::Expands(word) => data.insert("expands".to_owned(), json!(word_text(word))),
            Known::Contracts | Known::Open => None,
        };
        Value::Object(data)
    };
    let operator = |m: &crate::linalg::Matrix<crate::poly::Two>| -> Vec<Vec<String>> {
        (0..m.rows()).map(|i| m.row(i).iter().map(|f| f.display([p, q])).collect()).collect()
    };
    let line = |own: &LineRegion| {
        let (runs, other) = along(case, &own.line);
        json!({"polynomial": own.line.border.display([p, q]), "parameter": runs, "other": other, "range": range(&own.line.range),
               "claims": claims(&own.found)})
    };
    json!({
        "kind": "region",
        "case": case.name,
        "parameters": case.parameters,
        "ranges": [range(&case.ranges[0]), range(&case.ranges[1])],
        "pieces": case.operators.iter().map(operator).collect::<Vec<_>>(),
        "reversed": case.reversed,
        "statement": CLAIM,
        "boxes": found.boxes.iter().map(entry).collect::<Vec<_>>(),
        "borders": found.borders.iter().map(|f| f.display([p, q])).collect::<Vec<_>>(),
        "lines": found.lines.iter().map(line).collect::<Vec<_>>(),
        "ended": ended(found.ended),
    })
}
