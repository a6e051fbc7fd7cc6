//! One section for each examined point: its branches brought together.

use super::super::document::{Block, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::reported::{Reported, vector};
use super::super::words::{addresses, dimension, direction, kind_meaning, mark, point_name, ray_line};
use super::evidence::Evidence;
use super::{Quoted, cycles, matrix};
use crate::case::Case;
use crate::report::figures;
use crate::report::reasons;
use crate::shape::{CellKind, word_text};
use crate::statement::Statement;
use crate::theorem::{About, BranchReport, Certified, Direction, Kind, Outcome, PointReport, Role, Side, Verdict};

/// So many points are shown enlarged.
const MAX_PICTURED: usize = 5;

/// So many points are shown in full where there are many of them.
const MAX_FULL: usize = 8;

pub(super) fn section<E: Reported>(
    case: &Case<E>,
    found: &Certified<E>,
    listed: &[&BranchReport<E>],
    seen: &mut Quoted,
) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "The points")];
    let moved = found.points.iter().flat_map(|p| &p.branches).any(|b| b.view.cols() > 0);
    if moved {
        blocks.extend(seen.once_id(Statement::Transport));
        let text = "with each branch below, its prefix and the matrix $G$ on the space where $L$ acts.";
        blocks.push(Evidence::of(Statement::Transport).holds("prefix", text, []).block());
    }
    let refuted = found.points.iter().position(|p| p.verdict == Verdict::Refuted);
    let open = found.points.iter().position(|p| p.verdict == Verdict::Undetermined);
    let mut rest = Vec::new();
    for (k, point) in found.points.iter().enumerate() {
        // Points asked for come last, and are shown in any case; so is the first witness.
        let asked = found.claims.iter().any(|c| c.what.asked().is_some_and(|(_, index)| index == Some(k)));
        let chosen = k < MAX_PICTURED || asked;
        if chosen || found.points.len() <= MAX_FULL || Some(k) == refuted || Some(k) == open {
            blocks.extend(one(case, point, listed, chosen, seen));
        } else {
            rest.push(point);
        }
    }
    if !rest.is_empty() {
        blocks.push(Block::heading(3, "The other points"));
        blocks.push(Block::text(
            "Their branches end in the same cycles. What was found for a cycle is brought to the point in the same way, by the prefix of the address.",
            [],
        ));
        blocks.push(in_short(&rest));
    }
    blocks
}

/// Points in a table: addresses, place, lines of the branches, and what follows.
fn in_short<E: Reported>(points: &[&PointReport<E>]) -> Block {
    let rows = points.iter().map(|point| {
        let lines: Vec<&Direction> = point.branches.iter().filter_map(tangent_of).collect();
        let mut shown = Line::new();
        for (k, d) in lines.iter().enumerate() {
            if k > 0 {
                shown.extend(words("; "));
            }
            shown.extend(direction(d));
        }
        let mut result = vec![mark(point.verdict)];
        if point.kind.has_rays() {
            result.extend(words(format!(", {}", point.kind.word())));
        }
        let place = point.image.as_ref().unwrap_or(&point.position);
        vec![code(addresses(point).join(" = ")), formula(vector(place)), shown, result]
    });
    Block::Table(Table {
        caption: Line::new(),
        header: ["addresses", "point", "tangent lines of the branches", "found"].map(words).to_vec(),
        rows: rows.collect(),
    })
}

/// The direction of the tangent line of a branch, where it has one.
fn tangent_of<E: Reported>(branch: &BranchReport<E>) -> Option<&Direction> {
    match &branch.outcome {
        Outcome::Line { direction, .. } => Some(direction),
        _ => None,
    }
}

fn one<E: Reported>(
    case: &Case<E>,
    point: &PointReport<E>,
    listed: &[&BranchReport<E>],
    pictured: bool,
    seen: &mut Quoted,
) -> Vec<Block> {
    let mut head = words(format!("{}, address ", point_name(&case.shape, point)));
    for (k, address) in addresses(point).into_iter().enumerate() {
        if k > 0 {
            head.extend(words(" = "));
        }
        head.push(Inline::Code(address));
    }
    let mut blocks = vec![Block::Heading(3, head)];
    let place = match &point.image {
        Some(image) => line("The point is $p=@$, that is $@$.", [vector(&point.position), vector(image)]),
        None => line("The point is $p=@$.", [vector(&point.position)]),
    };
    blocks.push(Block::Paragraph(place));
    for branch in &point.branches {
        blocks.extend(branch_blocks(case, branch, listed));
    }
    blocks.extend(together(point, seen));
    blocks.extend(of_shape(point, seen));
    if pictured {
        blocks.extend(figures::germ(case, point));
    }
    blocks.push(Block::Paragraph(conclusion(point)));
    blocks
}

fn branch_blocks<E: Reported>(case: &Case<E>, branch: &BranchReport<E>, listed: &[&BranchReport<E>]) -> Vec<Block> {
    let side = match branch.side {
        Side::Left => "Left branch",
        Side::Right => "Right branch",
        Side::Both => "Branch",
    };
    let name = cycles::index_of(listed, branch).map(|k| cycles::name(case, listed[k], k)).unwrap_or_default();
    let mut blocks = Vec::new();
    let from = if branch.address.prefix.is_empty() {
        "no prefix".to_owned()
    } else {
        format!("the prefix `{}`", word_text(&branch.address.prefix))
    };
    let mut text = line(&format!("**{side}** `{}`: {from}, then ", branch.address), []);
    text.push(Inline::Strong(name));
    if branch.view.cols() == 0 || matches!(branch.outcome, Outcome::NoGerm { .. }) {
        text.extend(words("."));
        blocks.push(Block::Paragraph(text));
    } else {
        text.extend(line(". A direction in the coordinates of $L$ is brought to the point by", []));
        blocks.push(Block::Paragraph(text));
        blocks.push(matrix(Math::Letter('G'), &branch.view));
    }
    match &branch.outcome {
        Outcome::Line { direction: d, rays, .. } => {
            let mut text = line("The tangent line of this branch is that of $G v$, of the direction ", []);
            text.extend(direction(d));
            text.extend(words("."));
            blocks.push(Block::Paragraph(text));
            let lists = [("before", &rays.left), ("after", &rays.right)];
            let ordered = case.shape.states[case.shape.start].kind == CellKind::Edge;
            for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
                let of =
                    if ordered { format!(" of the points {name} it in the order of the curve") } else { String::new() };
                let noun = if list.len() == 1 { "Limit ray" } else { "Limit rays" };
                let mut text = words(format!("{noun}{of}: "));
                text.extend(super::super::words::rays(list));
                text.extend(words("."));
                blocks.push(Block::Paragraph(text));
            }
        }
        Outcome::AtLeast { dimension, .. } => {
            blocks.push(Block::text("On this branch $\\dim D^*≥@$.", [Math::count(*dimension)]))
        }
        Outcome::NoGerm { reason } => {
            blocks.push(Block::Paragraph(words(format!(
                "There are no secants to look at: {}.",
                reasons::no_germ(*reason)
            ))));
        }
        Outcome::Open { reason, at_least, direction: known, .. } => {
            let mut text = words(format!("Not decided: {}.", reasons::branch(*reason)));
            if let Some(d) = known.as_ref().filter(|_| *at_least > 0) {
                text.extend(line(" The tangent subspace contains the direction ", []));
                text.extend(direction(d));
                text.extend(words("."));
            }
            blocks.push(Block::Paragraph(text));
        }
    }
    blocks
}

/// What the branches of a point give together: the rule for joints where both are lines, lower bounds where these refute.
fn together<E: Reported>(point: &PointReport<E>, seen: &mut Quoted) -> Vec<Block> {
    let lines: Vec<_> = point.branches.iter().filter_map(tangent_of).collect();
    if let ([left, right], 2) = (lines.as_slice(), point.branches.len()) {
        let mut blocks: Vec<Block> = seen.once_id(Statement::Joint).into_iter().collect();
        let agree = left.same_line(right).is_some();
        let mut text = line("the lines of $G v$ are those of ", []);
        text.extend(direction(left));
        text.extend(words(" and "));
        text.extend(direction(right));
        text.extend(words("; neither is killed."));
        let mut evidence = Evidence::of(Statement::Joint).holds(
            "branches",
            "$D^*$ of both branches is a line, as shown with their cycles.",
            [],
        );
        evidence.push("transported", Tone::Good, text);
        blocks.push(evidence.block());
        blocks.push(Block::Paragraph(words(if agree {
            "The two lines agree."
        } else {
            "The two lines are different, so that there is no tangent line."
        })));
        return blocks;
    }
    let known: Vec<&Direction> = point.branches.iter().filter_map(contained).collect();
    if point.branches.len() < 2 || point.verdict != Verdict::Refuted {
        return Vec::new();
    }
    let mut blocks: Vec<Block> = seen.once_id(Statement::LowerBounds).into_iter().collect();
    let mut evidence = Evidence::of(Statement::LowerBounds);
    let single = point.branches.iter().filter_map(|b| match &b.outcome {
        Outcome::AtLeast { dimension, .. } => Some(*dimension),
        _ => None,
    });
    if let Some(most) = single.max() {
        let text = "the tangent subspace of one branch has at least @ dimensions at the point.";
        evidence = evidence.holds("contained", text, [Math::count(most)]);
    } else if let [left, right] = known.as_slice() {
        let mut text = line("the tangent subspaces of the two branches contain ", []);
        text.extend(direction(left));
        text.extend(words(" and "));
        text.extend(direction(right));
        text.extend(words(", which are no multiples of one another."));
        evidence.push("contained", Tone::Good, text);
    }
    blocks.push(evidence.block());
    blocks
}

/// Why the germ of the branch is that of the set.
fn of_shape<E: Reported>(point: &PointReport<E>, seen: &mut Quoted) -> Vec<Block> {
    if point.role != Role::SetPoint || point.verdict != Verdict::Proved || point.about() != About::Shape {
        return Vec::new();
    }
    let mut blocks: Vec<Block> = seen.once_id(Statement::BranchAndShape).into_iter().collect();
    let small = point.branches.iter().all(|b| b.linear.rows() <= 1);
    let isolated = if small {
        "not needed: the space on which $L$ acts has at most one dimension."
    } else {
        "by the ring condition above, without cells that were left out."
    };
    let proof = Evidence::of(Statement::BranchAndShape)
        .holds("start", "the address has no prefix.", [])
        .holds("isolated", isolated, [])
        .holds("view", "$G$ is injective on the space where $L$ acts.", []);
    blocks.push(proof.block());
    blocks
}

/// A direction that the tangent subspace of a branch is known to contain.
fn contained<E: Reported>(branch: &BranchReport<E>) -> Option<&Direction> {
    match &branch.outcome {
        Outcome::Line { direction, .. } => Some(direction),
        Outcome::Open { direction, .. } => direction.as_ref(),
        Outcome::AtLeast { .. } | Outcome::NoGerm { .. } => None,
    }
}

fn conclusion<E: Reported>(point: &PointReport<E>) -> Line {
    let no_germ = point.branches.iter().all(|b| matches!(b.outcome, Outcome::NoGerm { .. }));
    let mut out = line("**Conclusion.** ", []);
    out.push(mark(point.verdict));
    let kind = match point.kind {
        Kind::Line => "a tangent line exists; its rays are not settled",
        Kind::NoTangent => "no tangent line",
        Kind::Undetermined if no_germ => "there is no tangent question",
        Kind::Undetermined => "",
        kind => kind.word(),
    };
    if !kind.is_empty() {
        out.extend(words(": "));
        out.push(Inline::Strong(kind.to_owned()));
    }
    let meaning = kind_meaning(point.kind, point.role == Role::SetPoint);
    if !meaning.is_empty() {
        out.extend(words(format!(" ({meaning})")));
    }
    if point.dimension.at_least > 0 {
        out.extend(words(", "));
        out.extend(dimension(point.dimension));
    }
    if let Some(tangent) = &point.tangent {
        out.extend(words("; the tangent line has the direction "));
        out.extend(direction(tangent));
    }
    let rays = ray_line(point);
    if !rays.is_empty() {
        out.extend(words(if point.role == Role::SetPoint { "; limit rays: " } else { "; limit rays by side: " }));
        out.extend(rays);
    }
    if let Some(reason) = reasons::point(point) {
        out.extend(words(format!("; {reason}")));
    }
    out.extend(words("."));
    out
}
