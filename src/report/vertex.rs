//! Reports on extraordinary vertices, by valence.

use super::claims;
use super::document::{Block, Check, Document, Inline, Line, Table, Tone, code, words};
use super::math::Math;
use super::vertex_reasons;
use super::words::{count, mark};
use crate::arith::Rational;
use crate::case::VertexCase;
use crate::picture::characteristic::{Panel, sheet, tikz};
use crate::poly::Poly;
use crate::theorem::Claim;
use crate::theorem::Verdict;
use crate::vertex::{Again, AtValence, Every, VertexReason, decimal, overall};
use serde_json::{Value, json};

/// The place in the lattice of a sector where the Jacobian determinant has a sign.
type Spot = (usize, (Rational, Rational));

/// What the reports say of the independent checker: at which valences it proved the verdicts again.
#[must_use]
pub fn twice(found: &[AtValence]) -> String {
    let decided = |f: &&AtValence| f.smooth != Verdict::Undetermined;
    let (again, once): (Vec<&AtValence>, Vec<&AtValence>) =
        found.iter().filter(decided).partition(|f| f.again == Again::Proved);
    let list = places;
    if !once.is_empty() && once.iter().all(|f| f.again == Again::NotAsked) {
        return "the independent checker was not asked: the verdicts were proved once, not twice".to_owned();
    }
    match (again.is_empty(), once.is_empty()) {
        (true, _) => {
            "the independent checker has no rule for these verdicts: they were proved once, not twice".to_owned()
        }
        (_, true) => format!("the independent checker proved the verdicts at {} again", list(&again)),
        _ => format!(
            "the independent checker proved the verdicts at {} again, but not those at {}",
            list(&again),
            list(&once)
        ),
    }
}

/// The equation of the eigenvalue with `c = cos(2πk/n)` in its coefficients, with whole numbers.
#[must_use]
pub fn equation(found: &AtValence) -> Option<String> {
    let top = found.top.as_ref()?;
    let two = Poly::new(vec![0.into(), 2.into()]);
    let in_c: Vec<Poly> = top
        .poly
        .iter()
        .map(|p| p.coeffs().iter().rev().fold(Poly::zero(), |v, c| &(&v * &two) + &Poly::constant(c.clone())))
        .collect();
    let all = Poly::new(in_c.iter().flat_map(|p| p.coeffs().iter().cloned()).collect());
    let factor =
        all.primitive().iter().zip(all.coeffs()).find(|(_, q)| **q != 0).map(|(i, q)| Rational::from(i) / q)?;
    let last = in_c.last()?.scale(&factor);
    let factor = if last.coeff(0) < 0 { -factor } else { factor };
    let mut text = String::new();
    for (power, c) in in_c.iter().enumerate().rev().filter(|(_, c)| !c.is_zero()) {
        let c = c.scale(&factor);
        let variable = match power {
            0 => String::new(),
            1 => "x".to_owned(),
            _ => format!("x^{power}"),
        };
        let constant = c.degree() == Some(0);
        let shown = c.display("c");
        let term = match (constant, shown.as_str()) {
            (true, "1") if power > 0 => variable,
            (true, "-1") if power > 0 => format!("-{variable}"),
            (true, _) => format!("{shown}{variable}"),
            (false, _) => format!("({shown}){variable}"),
        };
        match term.strip_prefix('-') {
            Some(rest) if !text.is_empty() => text.push_str(&format!(" - {rest}")),
            _ if text.is_empty() => text.push_str(&term),
            _ => text.push_str(&format!(" + {term}")),
        }
    }
    Some(text)
}

fn yes_no(value: Option<bool>) -> Line {
    match value {
        Some(true) => vec![Inline::Mark(Tone::Good, "yes".to_owned())],
        Some(false) => vec![Inline::Mark(Tone::Bad, "no".to_owned())],
        None => vec![Inline::Mark(Tone::Open, "–".to_owned())],
    }
}

/// The eigenvalue in a table: the number, or ten decimals.
fn shown(found: &AtValence) -> Line {
    match found.top.as_ref().map(|top| &top.rational) {
        None => words("–"),
        Some(Some(q)) => vec![Inline::Math(Math::number(q))],
        Some(None) => words(digits(found)),
    }
}

/// What an irrational eigenvalue is exactly: the root of an equation, whose coefficients may be in Q(c).
fn exact(found: &AtValence) -> Option<String> {
    let top = found.top.as_ref().filter(|top| top.rational.is_none())?;
    let text = equation(found)?;
    let angle = format!("{}π/n", 2 * top.angle);
    let with_cosine = top.poly.iter().any(|p| p.degree().is_some_and(|d| d > 0));
    Some(if with_cosine { format!("{text} = 0, c = cos({angle})") } else { format!("{text} = 0") })
}

/// The equations of the eigenvalues, those of several valences together.
fn equations(found: &[AtValence]) -> Vec<Line> {
    let mut grouped: Vec<(String, Vec<usize>)> = Vec::new();
    for (text, f) in found.iter().filter_map(|f| Some((exact(f)?, f))) {
        match grouped.iter_mut().find(|(t, _)| *t == text) {
            Some((_, list)) => list.push(f.valence),
            None => grouped.push((text, vec![f.valence])),
        }
    }
    let item = |(text, list): &(String, Vec<usize>)| {
        let mut line = words(format!("λ at {} is the root with these decimals of ", ranges(list)));
        line.extend(code(text.clone()));
        line
    };
    grouped.iter().map(item).collect()
}

fn digits(found: &AtValence) -> String {
    found.top.as_ref().map_or_else(String::new, |t| format!("{:.10}", decimal(t)))
}

/// The blocks of the leading eigenvalues, such as `1, 4` or `0 (3×3)`.
fn frequencies(found: &AtValence) -> String {
    let Some(top) = &found.top else { return "–".to_owned() };
    let name = |m: &crate::vertex::top::Member| {
        let longest = m.blocks.first().copied().unwrap_or(1);
        let more = m.blocks.len();
        let sign = if m.negative { "−" } else { "" };
        let sizes = if longest > 1 || more > 1 {
            let sizes: Vec<String> = m.blocks.iter().map(|b| format!("{b}×{b}")).collect();
            format!(" ({})", sizes.join(", "))
        } else {
            String::new()
        };
        let twin = if m.frequency == 0 || 2 * m.frequency == found.valence {
            String::new()
        } else {
            format!(", {sign}{}", found.valence - m.frequency)
        };
        format!("{sign}{}{twin}{sizes}", m.frequency)
    };
    top.members.iter().map(name).collect::<Vec<_>>().join("; ")
}

/// The table by valence, with reasons below it and, in full, the evidence for each.
#[must_use]
pub fn document(case: &VertexCase, found: &[AtValence], every: Option<&Every>, full: bool) -> Document {
    let mut blocks = summary_by_valence(case, found, every);
    blocks.push(Block::Paragraph(words(format!("Note: {}.", twice(found)))));
    if full {
        blocks.extend(evidence_by_valence(case, found));
    }
    Document { title: case.title.clone(), blocks }
}

/// What holds at all valences, the table by valence, and the reasons below it.
pub(super) fn summary_by_valence(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Vec<Block> {
    let mut blocks = every.map(all_valences).unwrap_or_default();
    if !found.is_empty() {
        blocks.push(Block::Table(table(case, found)));
    }
    blocks.extend(super::curvature::table(found).map(Block::Table));
    let equations = equations(found);
    if !equations.is_empty() {
        blocks.push(Block::List(equations));
    }
    let mut grouped: Vec<(&VertexReason, Verdict, Vec<&AtValence>)> = Vec::new();
    for f in found {
        match grouped.iter_mut().find(|(reason, verdict, _)| **reason == f.reason && *verdict == f.smooth) {
            Some((_, _, list)) => list.push(f),
            None => grouped.push((&f.reason, f.smooth, vec![f])),
        }
    }
    let reasons = grouped.iter().map(|(reason, verdict, list)| {
        let mut line = vec![mark(*verdict)];
        line.extend(words(format!(" at {}: {}", places(list), vertex_reasons::reason(reason))));
        line
    });
    let reasons: Vec<Line> = reasons.collect();
    if !reasons.is_empty() {
        blocks.push(Block::List(reasons));
    }
    let witnesses: Vec<Line> = found.iter().filter_map(|f| witness(case, f)).collect();
    if !witnesses.is_empty() {
        blocks.push(Block::List(witnesses));
    }
    blocks
}

fn table(case: &VertexCase, found: &[AtValence]) -> Table {
    if let Some(smooth) = case.border {
        let row = |f: &AtValence| vec![words(f.valence.to_string()), vec![mark(f.plane)], vec![mark(f.smooth)]];
        let at = if smooth { "a vertex of a smooth border" } else { "a corner" };
        let caption =
            format!("{}: C¹ up to the border at {at} for almost all control points, by number of faces", case.title);
        let header = ["faces", "tangent plane", "C¹ up to the border"].map(words).to_vec();
        return Table { caption: words(caption), header, rows: found.iter().map(row).collect() };
    }
    let header = ["valence", "λ", "blocks", "regular", "injective", "tangent plane", "C¹"].map(words).to_vec();
    let row = |f: &AtValence| {
        vec![
            words(f.valence.to_string()),
            shown(f),
            words(frequencies(f)),
            yes_no(f.regular()),
            yes_no(f.injective()),
            vec![mark(f.plane)],
            vec![mark(f.smooth)],
        ]
    };
    let caption = words(format!("{}: C¹ for almost all control points, by valence", case.title));
    Table { caption, header, rows: found.iter().map(row).collect() }
}

/// A section for every valence, with its evidence and a picture of the characteristic map.
fn evidence_by_valence(case: &VertexCase, found: &[AtValence]) -> Vec<Block> {
    found.iter().flat_map(|f| at(case, f)).collect()
}

/// The section of one valence.
pub(super) fn at(case: &VertexCase, f: &AtValence) -> Vec<Block> {
    let heading = match f.border {
        Some(_) => count(f.valence, "face"),
        None => format!("Valence {}", f.valence),
    };
    let mut blocks = vec![Block::Heading(2, words(heading)), Block::Facts(evidence(f))];
    if let Some(panel) = panel(f) {
        let title = format!("{}, valence {}", case.title, f.valence);
        blocks.push(Block::Figure {
            svg: sheet(&[panel], &title),
            tikz: tikz(&panel),
            alt: format!("The characteristic map at valence {}", f.valence),
            caption: words("The ring of the characteristic map and two smaller copies."),
        });
    }
    blocks
}

/// The statement for all valences, with its conditions.
fn all_valences(every: &Every) -> Vec<Block> {
    let verdict = if every.proved() { Verdict::Proved } else { Verdict::Undetermined };
    let mut head = vec![mark(verdict)];
    head.extend(words(format!(
        " at every valence n ≥ {}: C¹ for almost all control points (Theorem 9); {}.",
        every.from, every.setting
    )));
    let check = |c: &crate::vertex::Condition| Check {
        tone: if c.holds { Tone::Good } else { Tone::Open },
        text: words(vertex_reasons::requirement(c.claim)),
    };
    let pieces = format!("{} pieces of patches and interval were needed.", every.pieces);
    vec![
        Block::Paragraph(head),
        Block::Checks(every.conditions.iter().map(check).collect()),
        Block::Paragraph(words(pieces)),
    ]
}

/// Where findings are about: `valences 3–5, 8`, or on the border `a corner with 1–2 faces`.
#[must_use]
pub fn places(found: &[&AtValence]) -> String {
    let list: Vec<usize> = found.iter().map(|f| f.valence).collect();
    match found.first().and_then(|f| f.border) {
        Some(smooth) if list == [1] => super::words::on_border(smooth, "1 face"),
        Some(smooth) => super::words::on_border(smooth, &format!("{} faces", numbers(&list))),
        None => ranges(&list),
    }
}

/// Valences as ranges, such as `valences 3–5, 8`.
#[must_use]
pub fn ranges(list: &[usize]) -> String {
    let word = if list.len() == 1 { "valence" } else { "valences" };
    format!("{word} {}", numbers(list))
}

fn numbers(list: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for n in list {
        match parts.last_mut() {
            Some((_, to)) if *to + 1 == *n => *to = *n,
            _ => parts.push((*n, *n)),
        }
    }
    let name = |(a, b): &(usize, usize)| if a == b { a.to_string() } else { format!("{a}–{b}") };
    parts.iter().map(name).collect::<Vec<_>>().join(", ")
}

fn witness(case: &VertexCase, f: &AtValence) -> Option<Line> {
    let signs = f.jacobian.as_ref().filter(|s| s.changes())?;
    let place = |at: &Option<Spot>| {
        let (u, v) = f.lattice(&case.rule, at.as_ref()?)?;
        Some(format!("({u}, {v})"))
    };
    let (positive, negative) = (place(&signs.positive)?, place(&signs.negative)?);
    Some(words(format!(
        "Witness at valence {}: in the lattice of a sector the Jacobian determinant is positive at {positive} and negative at \
         {negative}.",
        f.valence
    )))
}

fn evidence(f: &AtValence) -> Vec<(String, Line)> {
    let almost = |verdict| {
        let mut out = vec![mark(verdict)];
        out.extend(words(" for almost all control points"));
        out
    };
    let mut facts = vec![("C¹".to_owned(), almost(f.smooth)), ("tangent plane".to_owned(), almost(f.plane))];
    if let Some(text) = exact(f) {
        facts.push(("equation of the eigenvalue".to_owned(), code(text)));
    }
    if let Some(p) = &f.minimal {
        facts.push(("minimal polynomial".to_owned(), code(p.primitive_display("x"))));
    }
    if let Some(top) = &f.top {
        facts.push(("all others but 1 below".to_owned(), words(super::radius::decimal(&top.others, true, 10))));
        let (length, dimension) = top.longest(f.valence);
        let text = format!("{length}, with ends that span {}", count(dimension, "dimension"));
        facts.push(("longest Jordan blocks".to_owned(), words(text)));
    }
    if let Some(signs) = &f.jacobian {
        let of =
            if f.polynomial { "of all Bernstein coefficients on" } else { "of its enclosure (Lemma 4) on each of" };
        let halved = if signs.depth == 0 {
            "undivided".to_owned()
        } else {
            format!("halved at most {}", count(signs.depth, "time"))
        };
        let text = format!("one strict sign {of} {}, {halved}", count(signs.pieces, "piece"));
        let (tone, text) = match (signs.strict(), signs.changes()) {
            (Some(_), _) => (Tone::Good, text),
            (None, true) => (Tone::Bad, "it takes both signs".to_owned()),
            (None, false) => (Tone::Open, "its sign is not decided".to_owned()),
        };
        facts.push(("Jacobian determinant".to_owned(), vec![Inline::Mark(tone, text)]));
    }
    if let Some((a, b)) = &f.half_plane {
        facts.push((
            "half-plane of a sector".to_owned(),
            words(format!("{} > 0 in coordinates x + y ω", functional(a, b))),
        ));
    }
    if let Some(w) = f.winding {
        facts.push(("winding number".to_owned(), words(w.to_string())));
    }
    facts.push(("reason".to_owned(), words(vertex_reasons::reason(&f.reason))));
    facts
}

/// `x + y`, `3 x − 2 y`: a functional up to a positive factor.
#[must_use]
pub fn functional(a: &Rational, b: &Rational) -> String {
    let both = Poly::new(vec![a.clone(), b.clone()]);
    let whole: Vec<Rational> = both.primitive().into_iter().map(Rational::from).collect();
    let unit = Rational::from(1);
    // The primitive form may have the other sign.
    let flip = [a, b].iter().zip(&whole).any(|(x, w)| **x != 0 && (**x > 0) != (*w > 0));
    let mut out = String::new();
    for (value, name) in whole.iter().zip(["x", "y"]).filter(|(v, _)| **v != 0) {
        let value = if flip { -value.clone() } else { value.clone() };
        let size = crate::arith::abs(&value);
        out.push_str(match (out.is_empty(), value < 0) {
            (true, true) => "−",
            (true, false) => "",
            (false, true) => " − ",
            (false, false) => " + ",
        });
        out.push_str(&if size == unit { name.to_owned() } else { format!("{size} {name}") });
    }
    out
}

/// The panel of a picture; `None` where there is no ring.
#[must_use]
pub fn panel(f: &AtValence) -> Option<Panel<'_>> {
    if f.outline.is_empty() {
        return None;
    }
    let eigenvalue = f.top.as_ref().map(decimal)?;
    Some(Panel { patches: &f.outline, valence: f.valence, frequency: f.frequency?, eigenvalue })
}

/// One valence as JSON.
fn valence_json(case: &VertexCase, f: &AtValence) -> Value {
    let place = |at: &Option<Spot>| {
        at.as_ref().and_then(|s| f.lattice(&case.rule, s)).map(|(u, v)| json!([u.to_string(), v.to_string()]))
    };
    let signs = f.jacobian.as_ref();
    json!({
        "valence": f.valence,
        "border": f.border.map(|smooth| if smooth { "smooth" } else { "corner" }),
        "verdict": f.smooth.word(),
        "tangent_plane": f.plane.word(),
        "reason": vertex_reasons::reason(&f.reason),
        "eigenvalue": f.top.as_ref().map(|t| json!({
            "rational": t.rational.as_ref().map(ToString::to_string),
            "minimal_polynomial": f.minimal.as_ref().map(|p| p.primitive_display("x")),
            "equation": equation(f),
            "decimal": digits(f),
            "others_below": t.others.to_string(),
            "members": t.members.iter().map(|m| json!({
                "frequency": m.frequency, "negative": m.negative, "blocks": m.blocks,
            })).collect::<Vec<_>>(),
        })),
        "frequency": f.frequency,
        "regular": f.regular(),
        "injective": f.injective(),
        "winding": f.winding,
        "half_plane": f.half_plane.as_ref().map(|(a, b)| json!([a.to_string(), b.to_string()])),
        "jacobian": signs.map(|s| json!({
            "sign": s.strict(),
            "pieces": s.pieces,
            "depth": s.depth,
            "positive": place(&s.positive),
            "negative": place(&s.negative),
            "zero": place(&s.zero),
        })),
        "curvature": f.curvature.as_ref().map(super::curvature::data),
        "checked": f.again == Again::Proved,
    })
}

fn claim_json(found: &[AtValence], claim: &Claim) -> Value {
    json!({
        "kind": claim.what.id(),
        "claim": claims::assertion(&claim.what),
        "verdict": claim.verdict().word(),
        "reason": claims::reason_at_vertices(found, claim),
    })
}

/// The whole result as JSON.
#[must_use]
pub fn json(case: &VertexCase, found: &[AtValence], every: Option<&Every>, claims: &[Claim]) -> Value {
    json!({
        "version": super::json::VERSION,
        "case": case.name,
        "title": case.title,
        "source": case.source,
        "scheme": case.scheme,
        "verdict": overall(found, every).word(),
        "claims": claims.iter().map(|c| claim_json(found, c)).collect::<Vec<_>>(),
        "every": every.map(|e| json!({
            "from": e.from,
            "proved": e.proved(),
            "setting": e.setting,
            "pieces": e.pieces,
            "conditions": e.conditions.iter().map(|c| json!({"claim": vertex_reasons::requirement(c.claim), "holds": c.holds})).collect::<Vec<_>>(),
        })),
        "note": twice(found),
        "valences": found.iter().map(|f| valence_json(case, f)).collect::<Vec<_>>(),
    })
}
