//! Reports on meshes: what holds of the limit surface, by valence, and the bad vertices with their lines.

use super::curvature;
use super::document::{Block, Document, Inline, Line, Table, code, words};
use super::vertex_reasons;
use super::words::{count, mark};
use crate::answer::Verdict;
use crate::certificate::{Certificate, Unsupported};
use crate::mesh::{AtVertex, Bad, Boundary, Found, Ground, Kind, Model, Number, Reason, Regular, Rings, Spot};
use crate::picture::mesh::svg;
use crate::vertex::decimal;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Rows of a list in the terminal and in a report.
const LISTED: [usize; 2] = [12, 400];
/// Up to this valence normals are written out exactly.
const WRITTEN: usize = 16;

/// Where a vertex is, in words.
#[must_use]
pub fn place(v: &AtVertex) -> String {
    match v.spot {
        Spot::Vertex(k) => {
            let side = v.side.filter(|s| *s > 0 || v.sides > 1).map(|s| format!(", side {} of {}", s + 1, v.sides));
            format!("vertex {} (line {}){}", k + 1, v.line, side.unwrap_or_default())
        }
        Spot::Face(k) => format!("middle of face {} (line {})", k + 1, v.line),
    }
}

/// Why a vertex has its verdict, in words.
#[must_use]
pub fn reason(v: &AtVertex) -> String {
    match &v.reason {
        Reason::Independent => "the leading coefficients are independent (Vertices of a mesh)".to_owned(),
        Reason::Dependent => {
            "the leading coefficients are dependent, one a multiple of the other, as where a net is folded along a line"
                .to_owned()
        }
        Reason::Vanishing => "the leading coefficient of these points is 0; what decides is of higher order".to_owned(),
        Reason::Undecided => "whether the leading coefficients are independent was not decided".to_owned(),
        Reason::Line => "all points on which the surface depends there lie on one line".to_owned(),
        Reason::Valence(why) => why.clone(),
        Reason::Border => {
            "the vertex, or a point around it, lies on the border of the mesh, and no rule is given there: --boundary edge \
             or edge-and-corner"
                .to_owned()
        }
        Reason::Fan(ground @ (Ground::Modes | Ground::Sides)) => vertex_reasons::border(*ground).to_owned(),
        Reason::Fan(ground) => format!("the leading coefficients are independent ({})", ground.statement().name()),
        Reason::Flat => {
            "the three coefficients that would refute a tangent plane are not certainly independent, as those of a plane net"
                .to_owned()
        }
        Reason::Irrational => {
            "a point around the vertex has irrational coordinates after the steps of the semi-sharp edges, or no rule".to_owned()
        }
        Reason::Dart => {
            "one sharp edge ends there: no statement is about such a vertex, and across the edge the surface may have a fold"
                .to_owned()
        }
        Reason::Tip => "the vertex is fixed, with faces all around and no sharp edge; no statement is about it".to_owned(),
    }
}

fn around(v: &AtVertex) -> Option<String> {
    Some(match v.rings.as_ref()? {
        Ok(Rings::Immersed(0)) => "all rings are immersed".to_owned(),
        Ok(Rings::Immersed(m)) => format!("{} tested, all later ones immersed", count(*m, "ring")),
        Ok(Rings::Open(ring, sector)) => format!("ring {ring} was not proved regular in sector {sector}"),
        Ok(Rings::Slow(m)) => format!("after {m} rings the later ones are under no bound yet"),
        Ok(Rings::Dependent) => "the leading coefficients are nearly dependent in floats".to_owned(),
        Err(why) => why.clone(),
    })
}

fn patch(b: &Bad) -> String {
    let steps = if b.level == 0 { String::new() } else { format!(", after {}", count(b.level, "step")) };
    let spot = |s: &(crate::arith::Rational, crate::arith::Rational)| format!("({}, {})", s.0, s.1);
    let what = match &b.found {
        Regular::Proved(_) => "is regular".to_owned(),
        Regular::Refuted(s) => {
            format!("is not regular at the parameter {}: the derivatives are dependent there", spot(s))
        }
        Regular::Folded(s, r) => {
            format!(
                "is plane, with Jacobian determinants of both signs at {} and {}: it is not regular in between",
                spot(s),
                spot(r)
            )
        }
        Regular::Open(s) => format!("was not decided near the parameter {}", spot(s)),
    };
    format!("face {} (line {}){steps}: the patch {what}", b.face + 1, b.line)
}

/// The document of a terminal or of a report; `whole` adds the picture and longer lists.
#[must_use]
pub fn document(model: &Model, scheme: &str, found: &Found, again: Again<'_>, whole: bool) -> Document {
    let most = LISTED[usize::from(whole)];
    let mut blocks = vec![Block::Paragraph(words(format!(
        "{}: {}, {}, scheme {scheme}; {}.",
        model.name,
        count(model.topology.faces(), "face"),
        count(model.points.len(), "point"),
        parts(found)
    )))];
    if found.soft_steps > 0 {
        blocks.push(Block::Paragraph(words(format!(
            "Semi-sharp edges and vertices took {}, in exact arithmetic; then they are smooth. They move the points, but do not \
             change the rules at which the limit at a vertex is taken, nor what holds there for almost all points.",
            count(found.soft_steps, "step")
        ))));
    }
    blocks.push(Block::heading(2, "Claims"));
    blocks.push(Block::List(claims(found)));
    if whole {
        let title = format!("{} with its verdicts", model.name);
        if let Some(svg) = svg(model, found, &title) {
            let caption = "The mesh; green vertices are proved, red ones refuted, violet ones undetermined.";
            let tikz = "\\emph{The picture is in the HTML report.}".to_owned();
            blocks.push(Block::Figure { svg, tikz, alt: title, caption: words(caption) });
        }
    }
    blocks.push(Block::heading(2, "Vertices by valence"));
    blocks.push(Block::Table(table(found)));
    let bad: Vec<&AtVertex> = found.vertices.iter().filter(|v| !v.surrounded()).collect();
    if !bad.is_empty() {
        blocks.push(Block::heading(2, "Vertices around which something is not proved"));
        blocks.push(Block::List(bad.iter().take(most).map(|v| listed(v)).collect()));
        blocks.extend(rest(bad.len(), most));
    }
    let mut faces = BTreeSet::new();
    let bad: Vec<&Bad> = found.patches.bad.iter().filter(|b| faces.insert(b.face)).collect();
    if !bad.is_empty() {
        blocks.push(Block::heading(2, "Patches that are not proved, the first of each face"));
        blocks.push(Block::List(bad.iter().take(most).map(|b| words(patch(b))).collect()));
        blocks.extend(rest(bad.len(), most));
    }
    if whole {
        blocks.push(Block::heading(2, "Limits"));
        blocks.push(Block::Table(limits(found, most)));
        blocks.extend(rest(found.vertices.len(), most));
        blocks.push(Block::heading(2, "Statements"));
        blocks.extend(found.statements().into_iter().map(Block::Statement));
    }
    blocks.push(Block::Paragraph(words(checked(again))));
    Document { title: format!("{} by {scheme}", model.name), blocks }
}

/// What the independent checker said; `None` where it was not asked.
pub type Again<'a> = Option<&'a Result<Certificate, Unsupported>>;

fn checked(again: Again<'_>) -> String {
    let left_out = |certificate: &Certificate| {
        let all: Vec<&str> = certificate.left_out().iter().map(|why| why.what.as_str()).collect();
        all.join("; ")
    };
    match again {
        None => "The independent checker was not asked: what is decided here was proved once, not twice.".to_owned(),
        Some(Err(why)) => format!("What is decided here was proved once, not twice: {why}."),
        Some(Ok(certificate)) if certificate.left_out().is_empty() => {
            "The independent checker proved the claims again, from the file itself, and the limits up to rounding; what is said of the \
             curvature was proved once."
                .to_owned()
        }
        Some(Ok(certificate)) => format!(
            "The independent checker proved again, from the file itself, what its certificate has, but not this: {}; nor what is said of \
             the curvature.",
            left_out(certificate)
        ),
    }
}

fn rest(all: usize, most: usize) -> Option<Block> {
    (all > most).then(|| Block::Paragraph(words(format!("… and {} more; --json lists all.", all - most))))
}

fn parts(found: &Found) -> String {
    let border = match (found.closed, found.boundary) {
        (true, _) => "closed".to_owned(),
        (false, None) => "with a border without a rule".to_owned(),
        (false, Some(rule)) => format!("with a border, rule {}", rule.name()),
    };
    let cuts = match found.cuts {
        0 => String::new(),
        n => format!(", cut open along {}", count(n, "sharp edge")),
    };
    let one_sided = found.parts.iter().filter(|two| !**two).count();
    let sides = match (one_sided, found.parts.len()) {
        (0, 1) => "one part with two sides".to_owned(),
        (0, n) => format!("{n} parts with two sides"),
        (1, 1) => "one part with one side".to_owned(),
        (k, n) => format!("{n} parts, {k} of them with one side"),
    };
    format!("{border}, {sides}{cuts}")
}

/// The two claims, in words that say what they are about.
#[must_use]
pub fn claim_words(found: &Found) -> [&'static str; 2] {
    if found.cuts > 0 {
        [
            "cut open along its sharp edges, the surface is C¹ at every vertex up to its border, for these points",
            "cut open along its sharp edges, the limit surface of this mesh is a regular C¹ surface up to its border, immersed by \
             its parametrisation",
        ]
    } else if !found.closed {
        [
            "the surface is C¹ at every vertex up to its border, for these points",
            "the limit surface of this mesh is a regular C¹ surface up to its border, immersed by its parametrisation",
        ]
    } else {
        [
            "the surface is C¹ at every vertex, for these points",
            "the limit surface of this mesh is a regular C¹ surface, immersed by its parametrisation",
        ]
    }
}

fn claims(found: &Found) -> Vec<Line> {
    let one = |verdict: Verdict, claim: &str| {
        let mut line = vec![mark(verdict)];
        line.extend(words(format!(": {claim}")));
        line
    };
    let p = &found.patches;
    let [vertices, whole] = claim_words(found);
    let mut surface = one(found.regular(), whole);
    let ruleless = !found.closed && found.boundary.is_none();
    match found.first_bad() {
        Some(bad) if !(ruleless && matches!(bad.found, Regular::Open(_))) => {
            surface.extend(words(format!("; {}", patch(bad))));
        }
        _ if ruleless => surface.extend(words("; the border has no rule: add --boundary edge or edge-and-corner")),
        _ => {}
    }
    let tested = format!(
        "{} tested, {} proved regular by floats with bounds, {} more exactly",
        count(p.tested, "patch"),
        p.by_floats,
        p.exactly
    );
    vec![one(found.smooth(), vertices), surface, words(tested)]
}

fn listed(v: &AtVertex) -> Line {
    let mut line = words(format!("{}, {}: ", place(v), kind(v.kind)));
    line.push(mark(v.smooth));
    let rings = around(v).filter(|_| v.smooth == Verdict::Proved);
    line.extend(words(match rings {
        Some(rings) => format!(" at the vertex; around it: {rings}"),
        None if v.smooth == Verdict::Proved => {
            format!(" at the vertex: {}; the rings around it are under no common bound", reason(v))
        }
        None => format!(": {}", reason(v)),
    }));
    line
}

/// The rule at a vertex, in words.
#[must_use]
pub fn kind(kind: Kind) -> String {
    match kind {
        Kind::Inside(n) => format!("valence {n}"),
        Kind::Smooth(n) => format!("border, {}", count(n as usize, "face")),
        Kind::Corner(n) => format!("corner, {}", count(n as usize, "face")),
        Kind::Dart(n) => format!("dart, valence {n}"),
        Kind::Tip(n) => format!("fixed, valence {n}"),
        Kind::Unknown => "border without a rule".to_owned(),
    }
}

fn table(found: &Found) -> Table {
    let mut by: BTreeMap<Kind, Vec<&AtVertex>> = BTreeMap::new();
    found.vertices.iter().for_each(|v| by.entry(v.kind).or_default().push(v));
    let row = |(own, all): (&Kind, &Vec<&AtVertex>)| {
        let inside = own.inside();
        let of = |verdict: Verdict| all.iter().filter(|v| v.smooth == verdict).count();
        let lambda = inside
            .and_then(|n| found.valences.get(&n)?.top.as_ref())
            .map_or("–".to_owned(), |t| format!("{:.10}", decimal(t)));
        let rings = if all.iter().all(|v| !v.extraordinary) {
            "–".to_owned()
        } else {
            format!("{} of {}", all.iter().filter(|v| v.surrounded()).count(), all.len())
        };
        let mut cells = vec![words(inside.map_or_else(|| kind(*own), |n| n.to_string()))];
        cells.extend([all.len().to_string(), lambda, of(Verdict::Proved).to_string()].map(words));
        cells.extend([of(Verdict::Refuted).to_string(), of(Verdict::Undetermined).to_string(), rings].map(words));
        cells.push(words(inside.and_then(|n| found.curvature.get(&n)).map_or_else(|| "–".to_owned(), curvature::size)));
        cells
    };
    let header = ["valence", "vertices", "λ", "C¹ proved", "refuted", "open", "rings immersed", "curvature"];
    let caption = words(
        "The curvature is that of almost all points at such a vertex; flat it is for all points with independent leading \
         coefficients (Size of the curvature).",
    );
    Table { caption, header: header.map(words).to_vec(), rows: by.iter().map(row).collect() }
}

fn limits(found: &Found, most: usize) -> Table {
    let decimals = |v: Option<[f64; 3]>| match v {
        Some([x, y, z]) => format!("({x:.8}, {y:.8}, {z:.8})"),
        None => "–".to_owned(),
    };
    let row = |v: &AtVertex| {
        let limit = v.limit.as_ref();
        let exact = limit.and_then(|l| l.point.as_ref()).map(tuple);
        vec![
            words(place(v)),
            words(decimals(limit.map(|l| l.near.map(crate::mesh::Float::mid)))),
            exact.map_or_else(|| words("–"), code),
            words(decimals(limit.and_then(|l| l.unit))),
            vec![mark(v.smooth) as Inline],
        ]
    };
    let header = ["where", "limit point", "exactly", "unit normal", "C¹"];
    let caption = words("In exact numbers t = 2cos(2π/n) at valence n, and 2cos(π/k) at a border vertex with k faces.");
    Table { caption, header: header.map(words).to_vec(), rows: found.vertices.iter().take(most).map(row).collect() }
}

fn tuple(all: &[Number; 3]) -> String {
    format!("({})", all.iter().map(Number::display).collect::<Vec<_>>().join(", "))
}

/// Everything as data.
#[must_use]
pub fn json(model: &Model, scheme: &str, found: &Found, again: Again<'_>) -> Value {
    let vertex = |v: &AtVertex| {
        let limit = v.limit.as_ref();
        let exact = |all: &[Number; 3]| json!(all.iter().map(Number::display).collect::<Vec<_>>());
        let written = |all: &[Number; 3]| if v.valence <= WRITTEN { exact(all) } else { Value::Null };
        let (at, number) = match v.spot {
            Spot::Vertex(k) => ("vertex", k + 1),
            Spot::Face(k) => ("face", k + 1),
        };
        json!({
            "at": at,
            "number": number,
            "line": v.line,
            "valence": v.valence,
            "kind": kind(v.kind),
            "side": v.side.map(|s| s + 1),
            "sides": v.sides,
            "smooth": v.smooth.word(),
            "reason": reason(v),
            "rings": around(v),
            "surrounded": v.surrounded(),
            "point": limit.map(|l| l.near.map(crate::mesh::Float::mid)),
            "point_exact": limit.and_then(|l| l.point.as_ref()).map(exact),
            "normal": limit.and_then(|l| l.unit),
            "normal_exact": limit.filter(|l| l.unit.is_some()).map(|l| written(&l.normal)),
            "tangents_exact": limit.map(|l| l.tangents.iter().map(written).collect::<Vec<_>>()),
        })
    };
    let p = &found.patches;
    let bad = |b: &Bad| json!({"face": b.face + 1, "line": b.line, "steps": b.level, "what": patch(b), "refuted": !matches!(b.found, Regular::Open(_))});
    json!({
        "mesh": model.name,
        "scheme": scheme,
        "faces": model.topology.faces(),
        "closed": found.closed,
        "boundary": found.boundary.map(Boundary::name),
        "sharp_edges": found.cuts,
        "semi_sharp_steps": found.soft_steps,
        "two_sided": found.parts,
        "smooth": found.smooth().word(),
        "regular": found.regular().word(),
        "certificate": {
            "checked": again.is_some_and(|a| a.as_ref().is_ok_and(|c| c.left_out().is_empty())),
            "why": match again {
                None => Some("the checker was not asked".to_owned()),
                Some(Err(why)) => Some(why.to_string()),
                Some(Ok(_)) => None,
            },
            "left_out": match again {
                Some(Ok(certificate)) => certificate.left_out().iter().map(ToString::to_string).collect(),
                _ => Vec::new(),
            },
        },
        "statements": found.statements().iter().map(|s| s.id()).collect::<Vec<_>>(),
        "patches": {"tested": p.tested, "by_floats": p.by_floats, "exactly": p.exactly, "bad": p.bad.iter().map(bad).collect::<Vec<_>>()},
        "numbers": "t = 2cos(2π/n) at valence n, n = 2k at a border vertex with k faces; a is the positive root of a² = (2 + t)a + 8 + 4t",
        "curvature": found.curvature.iter().map(|(n, c)| json!({
            "valence": n,
            "almost_all": curvature::size(c),
            "ratio": curvature::ratio(c),
            "exponent": c.exponent.filter(|p| p.is_finite()),
        })).collect::<Vec<_>>(),
        "vertices": found.vertices.iter().map(vertex).collect::<Vec<_>>(),
    })
}
