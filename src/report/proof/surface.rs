//! The section on the points of a surface.

use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::math::Math;
use super::super::surface::{head, product_line, span, verdict};
use super::super::words::{listed, mark, tone};
use super::{Quoted, surface_cycle};
use crate::case::Case;
use crate::theorem::Statement;
use crate::theorem::surface::{Surface, SurfaceBranch, SurfaceDense};

/// One analysis for each different cycle as it is seen, and the points that they give.
pub(super) fn section(case: &Case, surface: &Surface, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "The cycles")];
    if surface.simplex {
        let text = "All operators are nonnegative, so that every attractor lies in the simplex of its coordinates: a functional lies between \
                    the smallest and the largest entry of its row on a cell.";
        blocks.push(Block::text(text, []));
    }
    let mut known: Vec<&SurfaceBranch> = Vec::new();
    for branch in surface.points.iter().flat_map(|p| &p.branches) {
        if index_of(&known, branch).is_none() {
            blocks.extend(surface_cycle::section(case, branch, known.len(), seen));
            known.push(branch);
        }
    }
    blocks.push(Block::heading(2, "The points"));
    if surface.points.iter().any(|p| p.branches.len() > 1) {
        blocks.extend(seen.once_id(Statement::SurfacePoint));
    }
    if surface.points.iter().any(|p| p.product.is_some()) {
        blocks.extend(seen.once_id(Statement::TensorProduct));
    }
    for point in &surface.points {
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
        if let Some(product) = &point.product {
            let mut text = words("Tensor product: ");
            text.extend(product_line(product));
            checks.push(Check { tone: tone(product.verdict), text });
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

fn dense(case: &Case, dense: &SurfaceDense, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    blocks.push(seen.once(Statement::Theorem5Surface));
    let name = |e: usize| case.shape.states[e].name.clone();
    let mut checks = Vec::new();
    for (state, point) in &dense.vertices {
        let before = if case.shape.control.is_some() { "before the projection, " } else { "" };
        let mut text = words(format!("{before}a vertex inside state {}, address ", name(*state)));
        text.push(Inline::Code(point.branches.first().map(|b| b.address.to_string()).unwrap_or_default()));
        text.extend(words(": "));
        text.push(mark(point.verdict));
        checks.push(Check { tone: tone(point.verdict), text });
    }
    let failing: Vec<String> =
        dense.injective.iter().filter(|x| !x.2).map(|(e, i, _)| format!("$T_{{{i}}}$ of state {}", name(*e))).collect();
    let (good, text) = if failing.is_empty() {
        (true, "all operators are injective on the visible relevant spaces".to_owned())
    } else {
        (false, format!("not injective: {}", listed(&failing)))
    };
    checks.push(Check { tone: if good { Tone::Good } else { Tone::Bad }, text: line(&text, []) });
    if case.shape.control.is_some() {
        let verb = if dense.view_injective { "is" } else { "is not" };
        let text = words(format!("the projection by the control points {verb} injective on the relevant space"));
        checks.push(Check { tone: if dense.view_injective { Tone::Good } else { Tone::Neutral }, text });
        if !dense.view_injective {
            let text = if dense.everywhere {
                "the bivectors of the planes span an invariant family of equal dimensions that the control points do not kill: every cell \
                 contains a vertex with a tangent plane"
            } else {
                "it was not shown that every cell contains such a vertex"
            };
            let tone = if dense.everywhere { Tone::Good } else { Tone::Open };
            checks.push(Check { tone, text: words(text) });
        }
    }
    blocks.push(Block::Checks(checks));
    blocks
}
