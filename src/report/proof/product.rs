//! Surfaces that are tensor products: the two curves, where they settle the points.

use super::super::document::{Block, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::surface::span;
use super::super::words::{addresses, direction, listed, mark};
use super::evidence::Evidence;
use super::{Quoted, contracts, cycles, matrix, scheme};
use crate::case::Case;
use crate::shape::{Shape, SolidCells, Spaces};
use crate::statement::Statement;
use crate::theorem::surface::{ProductFactor, Surface, SurfacePoint};
use crate::theorem::{BranchReport, Outcome, PointReport, StateReport, Verdict};

/// Whether the theorem on tensor products gives all that is said of a point.
pub(super) fn settles(point: &SurfacePoint) -> bool {
    point.product.as_ref().is_some_and(|p| {
        p.verdict == point.verdict
            && match p.verdict {
                Verdict::Proved => p.tangent.is_some() && point.tangent.is_some(),
                Verdict::Refuted => true,
                Verdict::Undetermined => false,
            }
    })
}

/// The section on the two curves with their cycles, and the theorem with its hypotheses.
pub(super) fn section(case: &Case, surface: &Surface, seen: &mut Quoted) -> Vec<Block> {
    let Some(factors) = &surface.factors else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "The two curves")];
    let settled: Vec<&SurfacePoint> = surface.points.iter().filter(|p| settles(p)).collect();
    let points = |k: usize| settled.iter().filter_map(move |p| p.product.as_ref().map(|e| [&e.first, &e.second][k]));
    let same = factors[0].shape.states[0].pieces.len() == factors[1].shape.states[0].pieces.len()
        && factors[0].shape.states[0].pieces.iter().zip(&factors[1].shape.states[0].pieces).all(|(a, b)| a.op == b.op);
    if same {
        blocks.push(Block::text("The surface is the product of a curve with itself.", []));
        blocks.extend(curve(case, &factors[0], points(0).chain(points(1)).collect(), 0, seen).0);
    } else {
        let (first, count) = curve(case, &factors[0], points(0).collect(), 0, seen);
        blocks.push(Block::heading(3, "The first curve"));
        blocks.extend(first);
        blocks.push(Block::heading(3, "The second curve"));
        blocks.extend(curve(case, &factors[1], points(1).collect(), count, seen).0);
    }
    blocks.push(Block::heading(2, "The tensor product"));
    blocks.extend(seen.once_id(Statement::TensorProduct));
    blocks.push(evidence(case, surface, true).block());
    blocks
}

/// A curve: operators, contraction, enclosures, cycles, and what is found at its points. Also the number of cycles so far.
fn curve(
    case: &Case,
    factor: &ProductFactor,
    points: Vec<&PointReport>,
    from: usize,
    seen: &mut Quoted,
) -> (Vec<Block>, usize) {
    let shape = &factor.shape;
    let mut own = case.clone();
    own.shape.clone_from(shape);
    let mut blocks = Vec::new();
    for (i, piece) in shape.states[shape.start].pieces.iter().enumerate() {
        blocks.push(matrix(scheme::operator(i, None), &piece.op));
    }
    blocks.extend(contracts::section(shape, &factor.contraction, seen));
    let Some(spaces) = Spaces::new(shape) else { return (blocks, from) };
    let states: Vec<StateReport> = factor
        .states
        .iter()
        .map(|(state, radius)| {
            let space = spaces.of(*state);
            StateReport {
                state: *state,
                relevant: space.basis.cols(),
                visible: space.visible.rows(),
                base: space.base.clone(),
                radius: radius.clone(),
            }
        })
        .collect();
    for state in &states {
        let values = [Math::count(state.relevant), Math::vector(&state.base), contracts::bounded(&state.radius)];
        let text =
            "Its relevant space $V$ has the dimension $@$; it lies in the 1-norm ball around $@$ with the radius $@$.";
        blocks.push(Block::text(text, values));
    }
    let polygons = polygons(shape, factor);
    blocks.extend(contracts::enclosures(shape, &factor.contraction, &states, polygons, seen));
    let mut known: Vec<&BranchReport> = Vec::new();
    for branch in points.iter().flat_map(|p| &p.branches) {
        if cycles::index_of(&known, branch).is_none() {
            blocks.extend(cycles::section(&own, &spaces, branch, from + known.len(), seen));
            known.push(branch);
        }
    }
    blocks.push(table(&points));
    (blocks, from + known.len())
}

fn polygons(shape: &Shape, factor: &ProductFactor) -> Vec<Block> {
    let Some(polygons) = &factor.polygons else { return Vec::new() };
    let none: &[Vec<crate::arith::Rational>] = &[];
    let table = contracts::vertices(shape, |e| polygons.get(e).map_or(none, Vec::as_slice));
    let summary = words(
        "Convex polygons that every map sends into one another, used where a ring condition needs sharper enclosures:",
    );
    vec![Block::Details { summary, blocks: vec![table] }]
}

/// The points of a curve with the lines of their branches.
fn table(points: &[&PointReport]) -> Block {
    let mut rows: Vec<Vec<Line>> = Vec::new();
    for point in points {
        let mut lines = Line::new();
        for branch in &point.branches {
            if let Outcome::Line { direction: d, .. } = &branch.outcome {
                lines.extend(words(if lines.is_empty() { "" } else { "; " }));
                lines.extend(direction(d));
            }
        }
        let row = vec![
            code(addresses(point).join(" = ")),
            lines,
            words(format!("{}, {}", point.verdict.word(), point.kind.word())),
        ];
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    let header = ["addresses on the curve", "tangent lines of the branches", "found"].map(words).to_vec();
    let caption = words("The points of the curve that occur");
    Block::Table(Table { caption, header, rows })
}

/// What follows at the points that the theorem settles.
pub(super) fn points(surface: &Surface) -> Option<Block> {
    let settled: Vec<&SurfacePoint> = surface.points.iter().filter(|p| settles(p)).collect();
    let row = |point: &&SurfacePoint| {
        let addresses: Vec<String> = point.branches.iter().map(|b| b.address.to_string()).collect();
        let curves = point.product.as_ref().map_or_else(Line::new, |e| {
            let of = |p: &PointReport| format!("`{}` {}", addresses_of(p), p.kind.word());
            line(&format!("{}, {}", of(&e.first), of(&e.second)), [])
        });
        let place = point.image.as_ref().unwrap_or(&point.position);
        let plane = point.tangent.as_ref().filter(|s| !s.generators.is_empty()).map_or_else(|| words("–"), span);
        vec![code(addresses.join(" = ")), formula(Math::vector(place)), curves, vec![mark(point.verdict)], plane]
    };
    let rows: Vec<Vec<Line>> = settled.iter().map(row).collect();
    let header = ["addresses", "point", "points of the curves", "tangent plane", "spanned by"].map(words).to_vec();
    let caption = words("What follows by the theorem on tensor products");
    (!rows.is_empty()).then_some(Block::Table(Table { caption, header, rows }))
}

fn addresses_of(point: &PointReport) -> String {
    addresses(point).join(" = ")
}

/// What was verified of the theorem on tensor products.
pub(super) fn evidence(case: &Case, surface: &Surface, listed_above: bool) -> Evidence {
    let mut evidence = Evidence::of(Statement::TensorProduct);
    let Some(factors) = &surface.factors else { return evidence };
    for (k, factor) in factors.iter().enumerate() {
        let which = ["first", "second"][k.min(1)];
        let state = &factor.shape.states[factor.shape.start];
        let mut text = line(
            &format!("the {which} curve has one state with @ coordinates and the operators "),
            [Math::count(state.dim)],
        );
        if listed_above {
            text.extend(words("above"));
        } else {
            for (i, piece) in state.pieces.iter().enumerate() {
                text.extend(words(if i > 0 { ", " } else { "" }));
                text.extend(line("$@$", [Math::matrix(&piece.op)]));
            }
        }
        text.extend(words("."));
        evidence.push("product", Tone::Good, text);
        let (tone, text) = moves(which, factor);
        evidence.push("no-point", tone, text);
    }
    let operators = "the operators of the surface are the tensor products of those of the two curves (column sums of 1 make them unique).";
    evidence.push("product", Tone::Good, words(operators));
    let planes = surface.points.iter().filter(|p| settles(p) && p.verdict == Verdict::Proved).count();
    let text = match (&case.shape.control, planes) {
        (None, _) => words("there are no control points."),
        (Some(_), 0) => words("the theorem gives no tangent plane below that the other statements do not give."),
        (Some(_), n) => words(format!("the image of the plane has the dimension 2 at {n} of the points below.")),
    };
    evidence.push("view", Tone::Good, text);
    evidence
}

/// Why no cell of a curve is a point.
pub(super) fn moves(which: &str, factor: &ProductFactor) -> (Tone, Line) {
    let spaces = Spaces::new(&factor.shape);
    let Some(SolidCells { dims, rows }) = spaces.and_then(|spaces| factor.shape.solid_cells(&spaces)) else {
        return (Tone::Bad, words(format!("a cell of the {which} curve may be a point.")));
    };
    let (on, act) = if rows { ("the rows on $V$", " from the right") } else { ("$V$", "") };
    let avoided: Vec<String> = dims.iter().map(ToString::to_string).collect();
    let text = if dims.iter().all(|k| *k == 0) {
        format!("the operators of the {which} curve act injectively on {on}{act}, so that no product of them is 0.")
    } else {
        format!(
            "the operators of the {which} curve, acting on {on}{act}, take nothing that is outside a proper subspace, of dimension {}, \
             into it, so that no product of them is 0.",
            listed(&avoided)
        )
    };
    (Tone::Good, line(&text, []))
}
