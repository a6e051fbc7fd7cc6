//! The answers of `secant region` as a document and as data.

use super::document::{Block, Document, Inline, Line, Table, Tone, code, words};
use super::radius::decimal;
use crate::algebraic::Root;
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::case::MaskFamilyCase;
use crate::picture::bar;
use crate::radius::Ended;
use crate::radius::family::{Below, Hull};
use crate::shape::word_text;
use crate::statement::Statement;
use crate::theorem::region::{Finding, MaskFamily, OrderRegion, Part};
use serde_json::{Value, json};

/// Digits after the point of an irrational end.
const DIGITS: u64 = 15;

/// An end as it is written in a table: rational, or the digits with which it begins.
#[must_use]
pub fn end_text(end: &Root) -> String {
    end.rational().map_or_else(|| digits(end), |q| q.to_string())
}

fn digits(end: &Root) -> String {
    let (whole, bits) = (end.enclosure(160).0, DIGITS);
    // Towards 0, so that the digits are those with which the number begins.
    let positive = whole.lo >= 0;
    let near = if positive { whole.lo } else { -whole.hi };
    format!("{}{}…", if positive { "" } else { "-" }, decimal(&near, false, bits))
}

/// What an irrational end is.
pub(super) fn definition(end: &Root, parameter: &str) -> Option<String> {
    end.rational().is_none().then(|| {
        let near = end.enclosure(24).0;
        format!(
            "{} is the root of {} between {} and {}",
            digits(end),
            end.minpoly().primitive_display(parameter),
            decimal(&near.lo, false, 5),
            decimal(&near.hi, true, 5)
        )
    })
}

/// A part by its ends: a point, or an open interval.
pub(super) fn place(from: &Root, to: &Root) -> String {
    if from.same(to) { end_text(from) } else { format!("({}, {})", end_text(from), end_text(to)) }
}

/// What the irrational ends of parts are, each once, under a heading; nothing where there are none.
pub(super) fn ends<'a>(
    parts: impl Iterator<Item = (&'a Root, &'a Root)>,
    heading: &str,
    parameter: &str,
) -> Vec<Block> {
    let mut ends: Vec<&Root> = Vec::new();
    for end in parts.flat_map(|(from, to)| [from, to]) {
        if end.rational().is_none() && !ends.iter().any(|e| e.same(end)) {
            ends.push(end);
        }
    }
    let list: Vec<Line> = ends.iter().filter_map(|e| definition(e, parameter)).map(words).collect();
    if list.is_empty() {
        return Vec::new();
    }
    vec![Block::Heading(2, words(heading)), Block::List(list)]
}

/// The tables with a picture, in which every one of `rows` is a bar, and with the statements that are applied, each once.
pub(super) fn complete(
    mut document: Document,
    picture: Option<(String, String)>,
    (rows, parameter): (&str, &str),
    statements: impl IntoIterator<Item = Statement>,
) -> Document {
    if let Some((svg, tikz)) = picture {
        let alt = format!("For each {rows} a bar over the range of {parameter}, coloured by verdict.");
        let caption = words("Green: proved. Red: refuted. Violet: undetermined. A vertical line is a single point.");
        document.blocks.insert(1, Block::Figure { svg, tikz, alt, caption });
    }
    with_statements(document, statements)
}

/// The document with the statements that are applied, each once.
pub(super) fn with_statements(mut document: Document, statements: impl IntoIterator<Item = Statement>) -> Document {
    let mut own: Vec<Statement> = Vec::new();
    for statement in statements {
        if !own.contains(&statement) {
            own.push(statement);
        }
    }
    document.blocks.push(Block::Heading(2, words("Statements")));
    document.blocks.extend(own.into_iter().map(Block::Statement));
    document
}

/// A part as data: its place, by what it is called, the verdict and why.
pub(super) fn part_data(
    (from, to): (&Root, &Root),
    gap: bool,
    verdict: Verdict,
    because: String,
) -> serde_json::Map<String, Value> {
    let (name, place) = match (from.same(to), gap) {
        (true, _) => ("point", end_data(from)),
        (false, true) => ("gap", json!([end_data(from), end_data(to)])),
        (false, false) => ("interval", json!([end_data(from), end_data(to)])),
    };
    let said = [(name, place), ("verdict", json!(verdict.word())), ("because", json!(because))];
    said.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// The verdict of a finding.
#[must_use]
pub fn verdict(finding: &Finding) -> Verdict {
    match finding.answer() {
        Some(true) => Verdict::Proved,
        Some(false) => Verdict::Refuted,
        None => Verdict::Undetermined,
    }
}

fn mark(finding: &Finding) -> Line {
    let verdict = verdict(finding);
    vec![Inline::Mark(tone(verdict), verdict.word().to_owned())]
}

/// The tone of a verdict.
pub(super) fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Proved => Tone::Good,
        Verdict::Refuted => Tone::Bad,
        Verdict::Undetermined => Tone::Open,
    }
}

/// Neighbours that are known for one reason, in print one row.
struct Row<'a> {
    parts: Vec<&'a Part>,
}

impl<'a> Row<'a> {
    fn all(order: &'a OrderRegion) -> Vec<Self> {
        let mut rows: Vec<Self> = Vec::new();
        for part in &order.parts {
            match rows.last_mut() {
                Some(row) if row.parts.iter().all(|other| alike(&other.finding, &part.finding)) => row.parts.push(part),
                _ => rows.push(Self { parts: vec![part] }),
            }
        }
        rows
    }

    /// The part that stands for all: an interval, where there is one.
    fn main(&self) -> &'a Part {
        self.parts.iter().find(|part| !part.is_point()).unwrap_or(&self.parts[0])
    }

    /// The interval with round brackets at ends that do not belong to it; or the point.
    fn place(&self) -> String {
        let (first, last) = (self.parts[0], self.parts[self.parts.len() - 1]);
        if first.from.same(&last.to) {
            return end_text(&first.from);
        }
        let open = if first.is_point() { '[' } else { '(' };
        let close = if last.is_point() { ']' } else { ')' };
        format!("{open}{}, {}{close}", end_text(&first.from), end_text(&last.to))
    }
}

/// Whether two findings are known for one reason; single members stay single.
fn alike(a: &Finding, b: &Finding) -> bool {
    match (a, b) {
        (Finding::Proved(_), Finding::Proved(_))
        | (Finding::SumRules, Finding::SumRules)
        | (Finding::Gap, Finding::Gap) => true,
        (Finding::Word(k), Finding::Word(l)) => k == l,
        _ => false,
    }
}

fn seeds(hull: &Hull) -> String {
    let list: Vec<String> = hull.words().map(word_text).collect();
    if list.is_empty() { "axes".to_owned() } else { format!("eigenvectors of {}", list.join(", ")) }
}

/// Why, in a few words.
fn because(family: &MaskFamily, order: &OrderRegion, part: &Part) -> String {
    let threshold = if order.order == 0 { "1".to_owned() } else { format!("{}^-{}", family.arity, order.order) };
    match (&part.finding, &order.radius) {
        (Finding::Proved(k), Some(r)) => {
            let hull = &r.covers[*k].hull;
            let count = r.covers.iter().filter(|c| touches(c.range(), part)).count();
            let more = if count > 1 { format!(", and {} more", count - 1) } else { String::new() };
            format!("radius below {threshold}: hull of {} vertices from {}{more}", hull.vertices.len(), seeds(hull))
        }
        (Finding::Word(k), Some(r)) => {
            let word = &r.crossings[*k].word;
            let plain = word.len() == 1 || order.order == 0;
            let power = if plain { threshold } else { format!("({threshold})^{}", word.len()) };
            word_reason(word, &power)
        }
        (Finding::SumRules, _) => match family.sum_rules {
            1 => "no more than one sum rule".to_owned(),
            k => format!("no more than {k} sum rules"),
        },
        (Finding::Member(_), _) => "this member by itself (secant regularity)".to_owned(),
        (Finding::Special, _) => "translates may be dependent here: a failure is not claimed".to_owned(),
        (Finding::Gap, Some(r)) => gap(r.ended).to_owned(),
        _ => "no hull and no word was found".to_owned(),
    }
}

/// Why a word refutes.
pub(super) fn word_reason(word: &[usize], power: &str) -> String {
    format!("word {}: spectral radius at least {power}", word_text(word))
}

/// Why a gap is left, and what more effort would try.
pub(super) fn gap(ended: Ended) -> &'static str {
    match ended {
        Ended::Done => "no hull and no word was found; a smaller --width divides the gap further",
        Ended::Exhausted => "no hull and no word was found; --effort hard tries more hulls",
        Ended::Work => "the work set aside is spent; --effort hard, or --time 600, tries more hulls",
        Ended::Clock => "the time is over; a larger --time tries more hulls",
    }
}

fn touches((lo, hi): (&Rational, &Rational), part: &Part) -> bool {
    use crate::algebraic::cmp_real;
    cmp_real(&Root::from_rational(lo), &part.to).is_lt() && cmp_real(&part.from, &Root::from_rational(hi)).is_lt()
}

/// What an order claims.
#[must_use]
pub fn claim(order: usize) -> String {
    if order == 0 {
        "the scheme converges uniformly for all control points".to_owned()
    } else {
        format!("the scheme converges, and all its limits are C^{order} in the uniform parameter")
    }
}

/// What follows from `C^1`: the scheme then has two sum rules, so that positions are a functional on which every piece takes an
/// equal share.
const GRAPH: &str = "Where C^1 is proved, the curve in barycentric space is a graph over its parameter: a simple arc with a \
                     tangent at every point, which turns continuously (G¹, Theorem 12).";

/// All answers as a document.
#[must_use]
pub fn document(case: &MaskFamilyCase, family: &MaskFamily, orders: &[OrderRegion]) -> Document {
    let p = case.parameter.as_str();
    let fact = |term: &str, text: String| (term.to_owned(), words(text));
    let mask: Vec<String> = family.mask.iter().map(|f| f.display(p)).collect();
    let factor: Vec<String> = family.factor.iter().map(|f| f.display(p)).collect();
    let (from, to) = &case.range;
    let mut blocks = vec![Block::Facts(vec![
        fact("mask", mask.join(", ")),
        fact("arity", family.arity.to_string()),
        fact("range", format!("{from} ≤ {p} ≤ {to}")),
        fact("sum rules", format!("{} for every {p}", family.sum_rules)),
        fact("factor b", factor.join(", ")),
    ])];
    for order in orders {
        let name = if order.order == 0 { "Convergence".to_owned() } else { format!("C^{}", order.order) };
        blocks.push(Block::Heading(2, words(name)));
        let row = |row: &Row<'_>| {
            let part = row.main();
            vec![code(row.place()), mark(&part.finding), words(because(family, order, part))]
        };
        blocks.push(Block::Table(Table {
            caption: words(format!("For which {p} {}", claim(order.order))),
            header: vec![code(p), words("verdict"), words("because")],
            rows: Row::all(order).iter().map(row).collect(),
        }));
        if order.order == 1 && order.parts.iter().any(|part| part.finding.answer() == Some(true)) {
            blocks.push(Block::Paragraph(words(GRAPH)));
        }
    }
    let parts = orders.iter().flat_map(|o| &o.parts).map(|part| (&part.from, &part.to));
    blocks.extend(ends(parts, "Ends", p));
    Document { title: format!("Regions of {}", case.name), blocks }
}

/// The document with the statements and the picture, for a file.
#[must_use]
pub fn report(case: &MaskFamilyCase, family: &MaskFamily, orders: &[OrderRegion]) -> Document {
    let own = [Statement::FamilyWords, Statement::FamilyHulls, Statement::Graph];
    complete(document(case, family, orders), picture(case, orders), ("order", &case.parameter), own)
}

/// A bar for each order, as SVG and TikZ.
#[must_use]
pub fn picture(case: &MaskFamilyCase, orders: &[OrderRegion]) -> Option<(String, String)> {
    let name = |k: usize| if k == 0 { "converges".to_owned() } else { format!("C{k}") };
    let span =
        |part: &Part| bar::Span { from: part.from.to_f64().0, to: part.to.to_f64().0, verdict: verdict(&part.finding) };
    let bars: Vec<(String, Vec<bar::Span>)> =
        orders.iter().map(|o| (name(o.order), o.parts.iter().map(span).collect())).collect();
    bar::bars(&case.parameter, &bars)
}

/// An end as data: a rational, or a polynomial with an interval.
#[must_use]
pub fn end_data(end: &Root) -> Value {
    end.rational().map_or_else(
        || {
            let near = end.enclosure(96).0;
            let coefficients: Vec<String> = end.primitive().iter().map(ToString::to_string).collect();
            json!({"polynomial": coefficients, "index": end.index(), "interval": [near.lo.to_string(), near.hi.to_string()], "digits": digits(end)})
        },
        |q| json!(q.to_string()),
    )
}

fn hulls(radius: Option<&Below>, part: &Part) -> Value {
    let touching = radius.into_iter().flat_map(|r| &r.covers).filter(|c| touches(c.range(), part));
    let one = |c: &crate::radius::family::Cover| {
        let (lo, hi) = c.range();
        json!({"valid": [lo.to_string(), hi.to_string()], "vertices": c.hull.vertices.len(), "seeds": seeds(&c.hull)})
    };
    Value::Array(touching.map(one).collect())
}

fn finding_data(family: &MaskFamily, order: &OrderRegion, part: &Part) -> Value {
    let gap = part.finding == Finding::Gap;
    let mut data = part_data((&part.from, &part.to), gap, verdict(&part.finding), because(family, order, part));
    match &part.finding {
        Finding::Proved(_) => {
            data.insert("statement".to_owned(), json!(Statement::FamilyHulls.id()));
            data.insert("certificates".to_owned(), hulls(order.radius.as_ref(), part));
        }
        Finding::Word(k) => {
            data.insert("statement".to_owned(), json!(Statement::FamilyWords.id()));
            let word = order.radius.as_ref().map(|r| word_text(&r.crossings[*k].word));
            data.insert("witness".to_owned(), json!(word));
        }
        _ => {}
    }
    Value::Object(data)
}

/// All answers as data.
#[must_use]
pub fn data(case: &MaskFamilyCase, family: &MaskFamily, orders: &[OrderRegion]) -> Value {
    let table = |o: &OrderRegion| {
        let parts: Vec<Value> = o.parts.iter().map(|part| finding_data(family, o, part)).collect();
        let implies = (o.order == 1).then(|| Statement::Graph.id());
        json!({"order": o.order, "statement": claim(o.order), "implies": implies, "table": parts})
    };
    let mask: Vec<String> = family.mask.iter().map(|f| f.display(&case.parameter)).collect();
    json!({
        "kind": "region",
        "case": case.name,
        "parameter": case.parameter,
        "range": [case.range.0.to_string(), case.range.1.to_string()],
        "arity": family.arity,
        "mask": mask,
        "sum_rules": family.sum_rules,
        "orders": orders.iter().map(table).collect::<Vec<_>>(),
        "left_out": [],
    })
}
