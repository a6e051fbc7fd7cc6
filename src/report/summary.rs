//! The short report that `secant certify` prints.

use super::claims;
use super::document::{Block, Document, Inline, Line, Table, Tone, code, formula, line, words};
use super::math::Math;
use super::proof::parameter;
use super::reasons;
use super::reported::{Reported, vector};
use super::values::{decimals_math, direction_decimals};
use super::words::{
    addresses, contraction, count, dimension, direction, holder, listed, mark, outcome, point_name, rate, ray_line,
    spectrum_line, statement, tone,
};
use crate::case::{Case, Origin};
use crate::prove::{deciding_claims, of_longer_polygons};
use crate::shape::{CellKind, Frame};
use crate::theorem::local::LocalSide;
use crate::theorem::{
    Assertion, BranchReport, Certified, Claim, Kind, Outcome, PointReport, Required, Role, Side, Verdict,
};
use std::borrow::Cow;

/// Points in the table at the top; all of them follow one by one.
const MAX_POINTS: usize = 12;

/// How many classes of eigenvalues are shown without `--verbose`.
const CLASSES: usize = 3;

/// Sums up what was found; `verbose` adds branches, rates and exponents.
#[must_use]
pub fn summary<E: Reported>(case: &Case<E>, found: &Certified<E>, required: &Required, verbose: bool) -> Document {
    let mut blocks = Vec::new();
    if case.title != case.name {
        blocks.push(Block::Paragraph(words(case.title.clone())));
    }
    if let Some(source) = &case.source {
        blocks.push(Block::Paragraph(vec![Inline::Mark(Tone::Neutral, source.clone())]));
    }
    blocks.extend(mask_line(case).map(Block::Paragraph));
    blocks.push(Block::heading(2, "Claims"));
    blocks.push(claims_table(case, found));
    blocks.extend(longer_line(case, found).map(Block::Paragraph));
    blocks.extend(points_table(case, found));
    blocks.push(Block::heading(2, "Shape"));
    blocks.push(Block::Facts(shape_facts(case, found)));
    if let Some(every) = E::every_facts(case, found) {
        blocks.push(Block::heading(2, "Every point"));
        blocks.push(Block::Facts(every));
    }
    let local = if verbose { E::local_sides(case, found) } else { Vec::new() };
    for (k, point) in found.points.iter().enumerate() {
        let sides = local.get(k).map_or(&[][..], Vec::as_slice);
        blocks.extend(point_blocks(case, point, verbose, sides));
    }
    if let Some(surface) = &found.surface {
        blocks.push(Block::heading(2, "Every point"));
        blocks.push(Block::Facts(super::every_plane::facts(surface)));
        blocks.extend(super::surface::summary(surface, verbose));
    }
    blocks.push(Block::heading(2, "Verdict"));
    blocks.push(Block::Paragraph(overall_line(case, found, required)));
    let limits: Vec<Line> = found.limits().iter().map(|limit| words(claims::limit(limit))).collect();
    if !limits.is_empty() {
        blocks.push(Block::List(limits));
    }
    Document { title: case.name.clone(), blocks }
}

/// The answers with the statements behind them, the examined points, and the verdict.
#[must_use]
pub fn brief<E: Reported>(case: &Case<E>, found: &Certified<E>, required: &Required) -> Document {
    let row = |claim: &Claim| {
        let by = claim.statement().map_or_else(|| words("–"), |s| words(statement(s)));
        vec![words(claims::label(&claim.what)), vec![mark(claim.verdict())], by]
    };
    let header = ["about", "answer", "by"].map(words).to_vec();
    let rows = found.claims.iter().map(row).collect();
    let mut blocks: Vec<Block> = mask_line(case).map(Block::Paragraph).into_iter().collect();
    blocks.push(Block::Table(Table { caption: Line::new(), header, rows }));
    blocks.extend(longer_line(case, found).map(Block::Paragraph));
    blocks.extend(points_table(case, found).or_else(|| E::results(case, found)));
    blocks.push(Block::Paragraph(overall_line(case, found, required)));
    Document { title: case.name.clone(), blocks }
}

/// The mask that was understood, or the symmetries.
pub(super) fn mask_line<E>(case: &Case<E>) -> Option<Line> {
    if let Some(Origin::Symmetric { maps, group }) = &case.scheme {
        let listed = super::words::listed(&maps.iter().map(ToString::to_string).collect::<Vec<_>>());
        let pieces = count(case.shape.states[case.shape.start].pieces.len(), "map");
        return Some(words(format!(
            "symmetries: some power of map {listed} is the identity; the set is that of the {pieces} g f, g one of the {group} products \
             of these, f another map"
        )));
    }
    let mask = case.mask()?;
    let arity = if mask.arity() == 2 { String::new() } else { format!(" of arity {}", mask.arity()) };
    let mut out = line(&format!("mask{arity} $@$"), [Math::vector(mask.coefficients())]);
    if matches!(case.scheme, Some(Origin::Mask(_) | Origin::Filter(..))) {
        let points = count(case.shape.states[case.shape.start].dim, "control point");
        out.extend(words(format!("; one span of its curves, on {points}")));
    }
    Some(out)
}

/// Where one span of a scheme is a polynomial, how smooth its curves on longer polygons are.
fn longer_line<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Option<Line> {
    found.claims.iter().find(|c| matches!(c.what, Assertion::Polynomial(_)) && c.verdict() == Verdict::Proved)?;
    let scheme = of_longer_polygons(case)?.ok()?;
    let holds = match scheme.smoothness() {
        None => "whether they are continuous was not shown".to_owned(),
        Some(k) if scheme.smoothness_is_exact() => format!("C^{k}, not C^{}", k + 1),
        Some(k) => format!("C^{k}"),
    };
    let mut out = words(format!("This is one span. Curves of longer polygons: {holds} ("));
    out.extend(code("secant regularity"));
    out.extend(words("); an order that is required is one of theirs."));
    Some(out)
}

/// What is claimed, each with its answer, statement and reason.
pub(super) fn claims_table<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Block {
    let row = |claim: &Claim| {
        let mut said = words(claims::judged(claim));
        if let Some(s) = claim.statement() {
            said.extend(words(format!(" [{}]", statement(s))));
        }
        if let Some(reason) = claims::reason(case, found, claim) {
            said.extend(words(format!("; {reason}")));
        }
        vec![words(claims::label(&claim.what)), vec![mark(claim.verdict())], said]
    };
    let header = ["about", "answer", "claim"].map(words).to_vec();
    Block::Table(Table { caption: Line::new(), header, rows: found.claims.iter().map(row).collect() })
}

/// The examined points: address, parameter, kind, and the tangent as a ray of travel, exactly and in decimals.
fn points_table<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Option<Block> {
    if found.points.is_empty() {
        return None;
    }
    let row = |point: &PointReport<E>| {
        // Where the curve pauses the branches of a point have different parameters.
        let mut parameters: Vec<_> = point.branches.iter().filter_map(|b| parameter(&case.shape, &b.address)).collect();
        parameters.sort();
        parameters.dedup();
        let mut shown = if parameters.is_empty() { words("–") } else { Line::new() };
        for (k, t) in parameters.iter().enumerate() {
            if k > 0 {
                shown.extend(words(", "));
            }
            shown.extend(formula(Math::number(t)));
        }
        let decimals = point
            .tangent
            .as_ref()
            .map_or_else(|| words("–"), |d| vec![Inline::Math(decimals_math(&direction_decimals(d)))]);
        vec![
            code(addresses(point).join(" = ")),
            shown,
            vec![Inline::Mark(tone(point.verdict), point.kind.word().to_owned())],
            point.tangent.as_ref().map_or_else(|| words("–"), direction),
            decimals,
        ]
    };
    let mut rows: Vec<Vec<Line>> = found.points.iter().take(MAX_POINTS).map(row).collect();
    if found.points.len() > MAX_POINTS {
        let rest = words(format!("and {} more", found.points.len() - MAX_POINTS));
        rows.push([rest, Line::new(), Line::new(), Line::new(), Line::new()].to_vec());
    }
    let header = ["address", "parameter", "kind", "tangent, as travelled", "≈"].map(words).to_vec();
    Some(Block::Table(Table { caption: Line::new(), header, rows }))
}

/// What holds, what fails, what is open, and what decides.
#[must_use]
pub fn overall_line<E: Reported>(case: &Case<E>, found: &Certified<E>, required: &Required) -> Line {
    let of = |verdict: Verdict| {
        let labels: Vec<String> =
            found.claims.iter().filter(|c| c.verdict() == verdict).map(|c| claims::label(&c.what)).collect();
        (!labels.is_empty()).then(|| listed(&labels))
    };
    let decide = deciding_claims(case, &found.claims, required);
    let verdict = required.verdict(&decide);
    let of_scheme = matches!(decide, Cow::Owned(_));
    let label = |c: &Claim| match of_scheme && c.what.is_of_parameter() {
        true => format!("{} of longer polygons", claims::label(&c.what)),
        false => claims::label(&c.what),
    };
    let deciding: Vec<String> = required.deciding(&decide).into_iter().map(label).collect();
    let mut out = vec![mark(verdict)];
    out.extend(words(match (verdict, deciding.as_slice()) {
        (_, []) => ", as what is required is not claimed of this shape.".to_owned(),
        (Verdict::Proved, all) => format!(": {} as required.", listed(all)),
        (_, all) => format!(", by {}.", listed(all)),
    }));
    for (text, verdict) in
        [("Holds", Verdict::Proved), ("Fails", Verdict::Refuted), ("Not decided", Verdict::Undetermined)]
    {
        if let Some(labels) = of(verdict) {
            out.extend(words(format!(" {text}: {labels}.")));
        }
    }
    out
}

/// A claim with its verdict, statement and reason.
pub(super) fn claim_line<E: Reported>(case: &Case<E>, found: &Certified<E>, claim: &Claim) -> Line {
    let mut out = vec![mark(claim.verdict())];
    out.extend(words(format!(": {}", claims::judged(claim))));
    if let Some(s) = claim.statement() {
        out.extend(words(format!(" [{}]", statement(s))));
    }
    if let Some(reason) = claims::reason(case, found, claim) {
        out.extend(words(format!("; {reason}")));
    }
    out
}

/// What the shape is, in one line.
pub(super) fn shape_line<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Line {
    let shape = &case.shape;
    let start = &shape.states[shape.start];
    let what = match start.kind {
        CellKind::Edge => "curve",
        CellKind::Face if found.surface.as_ref().is_some_and(|s| s.unparametrised.is_none()) => "surface",
        CellKind::Face => "set declared as a face (that it is a surface was not shown)",
        CellKind::Vertex | CellKind::Set => "set",
    };
    let pieces = count(start.pieces.len(), "piece");
    let states = if shape.states.len() == 1 {
        String::new()
    } else {
        format!(", an automaton of {} started at `{}`", count(shape.states.len(), "state"), start.name)
    };
    let template = format!("{what} of {pieces}{states}");
    match (shape.frame, &shape.control) {
        (Frame::Affine, _) => line(&format!("{template}, affine maps of $ℝ^{{@}}$"), [Math::count(start.dim - 1)]),
        (_, Some(control)) => line(
            &format!("{template}, with {} in $ℝ^{{@}}$", count(control.cols(), "control point")),
            [Math::count(control.rows())],
        ),
        _ => line(
            &format!(
                "{template}, in the barycentric space of {}; no control points are given, so this is what the verdict is about",
                count(start.dim, "coordinate")
            ),
            [],
        ),
    }
}

fn shape_facts<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Vec<(String, Line)> {
    let mut facts = vec![("shape".to_owned(), shape_line(case, found))];
    if let Some(field) = E::field_text(&case.shape) {
        facts.push(("entries".to_owned(), words(format!("in {field}"))));
    }
    facts.push(("contraction".to_owned(), contraction(&found.contraction)));
    if let Some(start) = found.states.iter().find(|s| s.state == case.shape.start) {
        let text = if start.visible == start.relevant {
            line("$\\dim V=@$", [Math::count(start.relevant)])
        } else {
            let values = [Math::count(start.relevant), Math::count(start.visible)];
            line("$\\dim V=@$, of which $@$ are seen through the control points", values)
        };
        facts.push(("relevant space".to_owned(), text));
    }
    facts
}

fn point_blocks<E: Reported>(case: &Case<E>, point: &PointReport<E>, verbose: bool, local: &[LocalSide]) -> Vec<Block> {
    let mut head = words(format!("{}, address ", point_name(&case.shape, point)));
    for (k, address) in addresses(point).into_iter().enumerate() {
        if k > 0 {
            head.extend(words(" = "));
        }
        head.push(Inline::Code(address));
    }
    let mut facts = vec![("verdict".to_owned(), verdict_line(point))];
    let place = point.image.as_ref().unwrap_or(&point.position);
    facts.push(("point".to_owned(), vec![Inline::Math(vector(place))]));
    if let Some(tangent) = &point.tangent {
        facts.push(("tangent".to_owned(), direction(tangent)));
    }
    let rays = ray_line(point);
    if !rays.is_empty() {
        facts.push(("rays".to_owned(), rays));
    }
    let branches = shown_branches(point);
    for branch in &branches {
        facts.extend(branch_facts(branches.len() > 1, branch, verbose, point.role != Role::SetPoint));
    }
    for side in local {
        facts.push((super::local::name(side), super::local::fact(side)));
        facts.extend(super::local::characteristic(side));
    }
    vec![Block::Heading(3, head), Block::Facts(facts)]
}

fn verdict_line<E: Reported>(point: &PointReport<E>) -> Line {
    let mut out = vec![mark(point.verdict)];
    match point.kind {
        Kind::Line => out.extend(words(": a tangent line exists (its rays are not settled)")),
        Kind::NoTangent | Kind::Undetermined => {}
        kind => {
            out.extend(words(": "));
            out.push(Inline::Strong(kind.word().to_owned()));
        }
    }
    if point.dimension.at_least > 0 {
        out.extend(words(", "));
        out.extend(dimension(point.dimension));
    }
    if let Some(reason) = reasons::point(point) {
        out.extend(words(format!("; {reason}")));
    }
    out
}

/// Both branches, or one where they are the same.
fn shown_branches<E: Reported>(point: &PointReport<E>) -> Vec<&BranchReport<E>> {
    let mut out: Vec<&BranchReport<E>> = Vec::new();
    for branch in &point.branches {
        let same = |b: &&BranchReport<E>| b.linear == branch.linear && b.address.cycle == branch.address.cycle;
        if !out.iter().any(same) {
            out.push(branch);
        }
    }
    out
}

fn branch_facts<E: Reported>(
    several: bool,
    branch: &BranchReport<E>,
    verbose: bool,
    ordered: bool,
) -> Vec<(String, Line)> {
    let side = match branch.side {
        Side::Left => " (left)",
        Side::Right => " (right)",
        Side::Both => "",
    };
    let side = if several { side } else { "" };
    let name = |text: &str| format!("{text}{side}");
    let most = if verbose { usize::MAX } else { CLASSES };
    let mut facts = vec![(name("spectrum"), spectrum_line(&branch.spectrum, most)), (name("theorem"), outcome(branch))];
    if let Outcome::Line { rate: r, holder: h, proof, .. } = &branch.outcome {
        facts.push((name("rate"), rate(r)));
        if verbose && proof.is_some() && ordered {
            facts.push((name("Hölder exponent"), holder(h)));
        }
    }
    facts
}
