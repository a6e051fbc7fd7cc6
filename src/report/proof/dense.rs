//! The section on the dense set.

use super::super::claims;
use super::super::document::{Block, Inline, Line, Tone, line, words};
use super::super::reported::Reported;
use super::super::values::direction_math;
use super::super::words::{mark, point_name, point_phrase, tone};
use super::evidence::Evidence;
use super::{Quoted, quoted};
use crate::case::Case;
use crate::theorem::{Assertion, Certified, DenseSet, Statement, Verdict};

pub(super) fn section<E: Reported>(case: &Case<E>, found: &Certified<E>, seen: &mut Quoted) -> Vec<Block> {
    let Some(dense) = &found.dense else { return Vec::new() };
    let Some(claim) = found.dense_claim() else { return Vec::new() };
    let projected = claim.what == Assertion::ProjectedJoints;
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    let plain = if projected { Statement::Theorem5Projected } else { Statement::Theorem5 };
    let statement = claim.statement().unwrap_or(plain);
    match claim.verdict() {
        Verdict::Proved => blocks.push(seen.once(statement)),
        Verdict::Undetermined => {
            blocks.push(quoted(statement));
            blocks.push(Block::text("It is not applied: of its hypotheses some fail or are not decided.", []));
        }
        Verdict::Refuted => {
            let text = "The claim below is about all joints, and one that was examined above has no tangent line; no further theorem is \
                        needed. For the record, the joints and the maps:";
            blocks.push(Block::text(text, []));
        }
    }
    let cones = |f: &crate::theorem::Frames| f.frames.iter().any(|f| f.cones.is_some());
    if statement == Statement::FramesDense && dense.frames.as_ref().is_some_and(cones) {
        blocks.push(seen.once(Statement::FramesCones));
    }
    blocks.push(match &dense.frames {
        Some(frames) if statement.uses_frames() => Block::Checks(super::frames::checks(case, frames)),
        _ => evidence(case, found, dense, plain, claim.verdict() == Verdict::Proved).block(),
    });
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

/// What was found about the hypotheses of Theorem 5 or 5′.
fn evidence<E: Reported>(
    case: &Case<E>,
    found: &Certified<E>,
    dense: &DenseSet<E>,
    statement: Statement,
    proved: bool,
) -> Evidence {
    let shape = &case.shape;
    let projected = statement == Statement::Theorem5Projected;
    let mut evidence = Evidence::of(statement);
    for &index in dense.joints.iter().filter(|_| !projected) {
        let Some(point) = found.points.get(index) else {
            evidence.push("joints", Tone::Bad, words("a joint is not listed."));
            continue;
        };
        let mut text = words(format!("{}: ", point_name(shape, point)));
        text.push(mark(point.verdict));
        if point.kind.has_rays() {
            text.push(Inline::Text(format!(", {}", point.kind.word())));
        }
        evidence.push("joints", tone(point.verdict), text);
    }
    if dense.joints.is_empty() && dense.upstairs.is_empty() {
        evidence = evidence.holds("joints", "there is none: no edge state has two pieces.", []);
    }
    for point in dense.upstairs.iter().filter(|_| projected) {
        let name = point_phrase(shape, point);
        let mut text = line(&format!("before the projection, {name}, in coordinates of $W$: "), []);
        text.push(mark(point.verdict));
        if let Some(tangent) = &point.tangent {
            text.extend(line(", with the tangent line of $ℓ=@$", [direction_math(tangent)]));
        }
        evidence.push("joints", tone(point.verdict), text);
    }
    if projected && proved {
        evidence = evidence.holds(
            "joints",
            "the smallest family of subspaces of the $W_e$ that contains these lines and is mapped into itself by all $T_i$ is all of $W$ (the lines \
             were closed under the operators).",
            [],
        );
    }
    for &(state, letter, ok) in &dense.injective {
        let place =
            if shape.states.len() > 1 { format!(" of state {}", shape.states[state].name) } else { String::new() };
        let verb = if ok { "is" } else { "is not" };
        let text = line(&format!("$T_{{{letter}}}${place} {verb} injective on the visible quotient $W$."), []);
        evidence.push("pieces", if ok { Tone::Good } else { Tone::Bad }, text);
    }
    if dense.injective.is_empty() {
        evidence.push("pieces", Tone::Bad, words("no piece was examined."));
    }
    if !projected {
        let what = if shape.control.is_some() {
            "the projection by the control points"
        } else {
            "the identity (there are no control points)"
        };
        let verb = if dense.view_injective { "is" } else { "is not" };
        let text = line(&format!("{what} {verb} injective on the visible quotient $W$ of the start state."), []);
        evidence.push("start", if dense.view_injective { Tone::Good } else { Tone::Bad }, text);
    }
    evidence
}
