//! The section on the dense set.

use super::super::claims;
use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::values::direction_math;
use super::super::words::{mark, point_name, tone};
use super::{Quoted, quoted};
use crate::case::Case;
use crate::theorem::{Assertion, Certified, DenseSet, Statement, Verdict};

pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let Some(dense) = &found.dense else { return Vec::new() };
    let Some(claim) = found.dense_claim() else { return Vec::new() };
    let projected = claim.what == Assertion::ProjectedJoints;
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    let other = if projected { Statement::Theorem5Projected } else { Statement::Theorem5 };
    let theorem = claim.statement().unwrap_or(other);
    match claim.verdict() {
        Verdict::Proved => blocks.push(seen.once(theorem)),
        Verdict::Undetermined => {
            blocks.push(quoted(theorem));
            blocks.push(Block::text("It is not applied: of its hypotheses some fail or are not decided.", []));
        }
        Verdict::Refuted => {
            let text = "The claim below is about all joints, and one that was examined above has no tangent line; no further theorem is \
                        needed. For the record, the joints and the maps:";
            blocks.push(Block::text(text, []));
        }
    }
    blocks.push(Block::Checks(match &dense.frames {
        Some(frames) if theorem.uses_frames() => super::frames::checks(case, frames),
        _ => checks(case, found, dense, projected, claim.verdict() == Verdict::Proved),
    }));
    let mut conclusion: Line = line("**Conclusion.** ", []);
    conclusion.push(mark(claim.verdict()));
    conclusion.extend(words(format!(": {}", claims::judged(claim))));
    if let Some(reason) = claims::reason(case, found, claim) {
        conclusion.extend(words(format!("; {reason}")));
    }
    conclusion.extend(words("."));
    blocks.push(Block::Paragraph(conclusion));
    blocks
}

fn checks(case: &Case, found: &Certified, dense: &DenseSet, projected: bool, proved: bool) -> Vec<Check> {
    let shape = &case.shape;
    let mut checks = Vec::new();
    for &index in &dense.joints {
        let Some(point) = found.points.get(index) else { continue };
        let mut text = words(format!("{}: ", point_name(shape, point)));
        text.push(mark(point.verdict));
        if point.kind.has_rays() {
            text.push(Inline::Text(format!(", {}", point.kind.word())));
        }
        checks.push(Check { tone: tone(point.verdict), text });
    }
    for &(state, letter, ok) in &dense.injective {
        let place =
            if shape.states.len() > 1 { format!(" of state {}", shape.states[state].name) } else { String::new() };
        let verb = if ok { "is" } else { "is not" };
        let text = line(&format!("$T_{{{letter}}}${place} {verb} injective on the relevant space"), []);
        checks.push(Check { tone: if ok { Tone::Good } else { Tone::Bad }, text });
    }
    if shape.control.is_some() {
        // Theorem 5′ is for projections that are not injective.
        let (tone, text) = match (dense.view_injective, projected) {
            (true, _) => (Tone::Good, "the projection by the control points is injective on the relevant space"),
            (false, false) => {
                (Tone::Bad, "the projection by the control points is not injective on the relevant space")
            }
            (false, true) => (
                Tone::Neutral,
                "the projection by the control points is not injective on the relevant space, so that Theorem 5 does not apply",
            ),
        };
        checks.push(Check { tone, text: words(text) });
    }
    for point in &dense.upstairs {
        // The names of states keep their case.
        let name = point_name(shape, point).replacen("Joint", "joint", 1);
        let mut text = line(&format!("before the projection, {name}, in coordinates of $W$: "), []);
        text.push(mark(point.verdict));
        if let Some(tangent) = &point.tangent {
            text.extend(line(", with the tangent line of $ℓ=@$", [direction_math(tangent)]));
        }
        checks.push(Check { tone: tone(point.verdict), text });
    }
    if projected && proved {
        let text = "the smallest family of subspaces of the $W_e$ that contains these lines and is mapped into itself by all $T_i$ is all of $W$ (the \
                    lines were closed under the operators)";
        checks.push(Check { tone: Tone::Good, text: line(text, []) });
    }
    checks
}
