//! The section on the dense set.

use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::values::direction_math;
use super::super::words::{mark, point_name, tone};
use super::{Quoted, quoted};
use crate::case::Case;
use crate::theorem::{Certified, DenseSet, Statement, Verdict};

pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let Some(dense) = &found.dense else { return Vec::new() };
    let is_dense = |s: Statement| s != Statement::Joint && s.is_about_joints();
    let Some(claim) = found.claims.iter().find(|c| c.statement.is_some_and(is_dense)) else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    let statement = claim.statement;
    match (claim.verdict, statement) {
        (Verdict::Proved, Some(theorem)) => blocks.push(seen.once(theorem)),
        (Verdict::Undetermined, Some(theorem)) => {
            blocks.push(quoted(theorem));
            blocks.push(Block::text("It is not applied: of its hypotheses some fail or are not decided.", []));
        }
        _ => {
            let text = "The claim below is about all joints, and one that was examined above has no tangent line; no further theorem is \
                        needed. For the record, the joints and the maps:";
            blocks.push(Block::text(text, []));
        }
    }
    let projected = claim.statement == Some(Statement::Theorem5Projected);
    let by_frames = dense.frames.as_ref().filter(|_| statement.is_some_and(Statement::uses_frames));
    blocks.push(Block::Checks(match by_frames {
        Some(frames) => super::frames::checks(case, frames),
        None => checks(case, found, dense, projected, claim.verdict == Verdict::Proved),
    }));
    let mut conclusion: Line = line("**Conclusion.** ", []);
    conclusion.push(mark(claim.verdict));
    let how = match claim.verdict {
        Verdict::Proved => "",
        Verdict::Refuted => "it is false that ",
        Verdict::Undetermined => "whether ",
    };
    conclusion.extend(words(format!(": {how}{}", claim.text)));
    if let Some(reason) = &claim.reason {
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
