//! The section on the points of a surface.

use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::math::Math;
use super::super::surface::{head, product_line, span, verdict};
use super::super::words::{mark, tone};
use super::evidence::Evidence;
use super::{Quoted, matrix, product, surface_cycle};
use crate::answer::Answer;
use crate::case::Case;
use crate::theorem::Statement;
use crate::theorem::surface::{Bivectors, Surface, SurfaceBranch, SurfaceDense, SurfacePoint};

/// One analysis for each different cycle as it is seen, and the points that they give.
pub(super) fn section(case: &Case, surface: &Surface, seen: &mut Quoted) -> Vec<Block> {
    let general: Vec<&SurfacePoint> = surface.points.iter().filter(|p| !product::settles(p)).collect();
    let mut blocks = Vec::new();
    if general.len() < surface.points.len() {
        blocks.extend(product::section(case, surface, seen));
    }
    if !general.is_empty() {
        blocks.push(Block::heading(2, "The cycles"));
    }
    if surface.simplex && !general.is_empty() {
        let text = "All operators are nonnegative, so that every attractor lies in the simplex of its coordinates: a functional lies between \
                    the smallest and the largest entry of its row on a cell.";
        blocks.push(Block::text(text, []));
    }
    let mut known: Vec<&SurfaceBranch> = Vec::new();
    for branch in general.iter().flat_map(|p| &p.branches) {
        if index_of(&known, branch).is_none() {
            blocks.extend(surface_cycle::section(case, branch, known.len(), seen));
            known.push(branch);
        }
    }
    blocks.push(Block::heading(2, "The points"));
    if general.iter().any(|p| p.branches.len() > 1) {
        blocks.extend(seen.once_id(Statement::SurfacePoint));
        blocks.push(complex(case).block());
    }
    if general.iter().any(|p| p.product.is_some()) && general.len() == surface.points.len() {
        blocks.extend(seen.once_id(Statement::TensorProduct));
        blocks.push(product::evidence(case, surface, false).block());
    }
    blocks.extend(product::points(surface));
    for point in general {
        blocks.push(Block::Heading(3, head(point)));
        let place = match &point.image {
            Some(image) => {
                line("The point is $p=@$, that is $@$.", [Math::vector(&point.position), Math::vector(image)])
            }
            None => line("The point is $p=@$.", [Math::vector(&point.position)]),
        };
        blocks.push(Block::Paragraph(place));
        let mut checks = Vec::new();
        for branch in &point.branches {
            let number = index_of(&known, branch).map_or(0, |k| k + 1);
            let mut text = line(&format!("Branch `{}`, cycle {number}: ", branch.address), []);
            text.extend(subspace(branch));
            // Three directions refute a tangent plane, whatever else there is.
            let decided = branch.outcome.dimension.exact || branch.outcome.dimension.at_least > 2;
            checks.push(Check { tone: if decided { Tone::Good } else { Tone::Open }, text });
        }
        if let Some(found) = &point.product {
            let mut text = words("Tensor product: ");
            text.extend(product_line(found));
            checks.push(Check { tone: tone(found.verdict), text });
        }
        blocks.push(Block::Checks(checks));
        let mut conclusion = line("**Conclusion.** ", []);
        conclusion.extend(verdict(point));
        if let Some(space) = point.tangent.as_ref().filter(|s| !s.generators.is_empty()) {
            conclusion.extend(line("; $D^*$ is spanned by ", []));
            conclusion.extend(span(space));
        }
        conclusion.extend(words("."));
        blocks.push(Block::Paragraph(conclusion));
    }
    blocks.extend(surface.dense.as_ref().map(|d| dense(case, d, seen)).unwrap_or_default());
    if matches!(surface.every, Answer::Proved(_)) {
        blocks.push(Block::text(
            "There is a tangent plane at every point (see there), so that those at a dense set follow.",
            [],
        ));
    }
    blocks
}

fn index_of(known: &[&SurfaceBranch], branch: &SurfaceBranch) -> Option<usize> {
    known.iter().position(|b| {
        b.state == branch.state
            && b.address.cycle == branch.address.cycle
            && b.chart == branch.chart
            && b.linear == branch.linear
            && b.outcome.dimension == branch.outcome.dimension
    })
}

/// `G D*` of a branch, or what is known of it.
fn subspace(branch: &SurfaceBranch) -> Line {
    let o = &branch.outcome;
    let mut out = Line::new();
    if o.contains.generators.is_empty() {
        out.extend(line("$\\dim D^*≥@$", [Math::count(o.dimension.at_least)]));
        return out;
    }
    out.extend(line(if o.dimension.exact { "$D^*$ is spanned by " } else { "$D^*$ contains " }, []));
    out.extend(span(&o.contains));
    out
}

/// The finding that all identities hold.
fn complex(case: &Case) -> Evidence {
    let evidence = Evidence::of(Statement::SurfacePoint);
    match case.complex().check() {
        Ok(count) => evidence.holds(
            "complex",
            "every face that is reached has all its sides, and all @ identities of adjacency and incidence hold exactly.",
            [Math::count(count)],
        ),
        Err(_) => evidence,
    }
}

fn dense(case: &Case, dense: &SurfaceDense, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    blocks.push(seen.once(Statement::Theorem5Surface));
    let name = |e: usize| case.shape.states[e].name.clone();
    let mut evidence = Evidence::of(Statement::Theorem5Surface);
    for (state, point) in &dense.vertices {
        let before = if case.shape.control.is_some() { "before the projection, " } else { "" };
        let mut text = words(format!("{before}a vertex inside state {}, address ", name(*state)));
        text.push(Inline::Code(point.branches.first().map(|b| b.address.to_string()).unwrap_or_default()));
        text.extend(words(": "));
        text.push(mark(point.verdict));
        if let Some(plane) = &point.tangent {
            text.extend(words(", with the plane of "));
            text.extend(span(plane));
            text.extend(line(" in coordinates of $W$", []));
        }
        text.extend(words("."));
        evidence.push("vertices", tone(point.verdict), text);
    }
    for (e, i, ok) in &dense.injective {
        let verb = if *ok { "is" } else { "is not" };
        let text = line(&format!("$T_{{{i}}}$ of state {} {verb} injective on the visible quotient.", name(*e)), []);
        evidence.push("pieces", if *ok { Tone::Good } else { Tone::Bad }, text);
    }
    blocks.push(evidence.block());
    if case.shape.control.is_some() {
        let verb = if dense.view_injective { "is" } else { "is not" };
        let text = format!(
            "The projection by the control points {verb} injective on the visible quotient of the start state."
        );
        blocks.push(Block::text(&text, []));
    }
    match (&dense.bivectors, dense.view_injective) {
        (_, true) => {}
        (None, false) => blocks.push(Block::text("It was not shown that every cell contains such a vertex.", [])),
        (Some(b), false) => blocks.extend(bivectors(b)),
    }
    blocks
}

/// The family of bivectors, and what the control points make of it.
fn bivectors(b: &Bivectors) -> Vec<Block> {
    let seen = (0..b.seen.rows()).find(|&k| b.seen.row(k).iter().any(|x| *x != 0));
    let mut blocks = vec![Block::text(
        "Bivectors: the smallest invariant family of spaces that contains those of the planes was closed under $Λ^2 T_i$; all its spaces have the \
         dimension $@$. That of the start state has the rows of the first matrix as a basis (the minors of pairs of coordinates, in lexicographic \
         order).",
        [Math::count(b.dimension)],
    )];
    blocks.push(matrix(Math::Letter('B'), &b.start));
    if let Some(k) = seen {
        let values = [Math::count(k + 1), Math::vector(b.seen.row(k))];
        blocks.push(Block::text("The control points do not kill it: $Λ^2 P$ takes row $@$ to $@$.", values));
    }
    blocks
}
