//! The section on the dense set.

use super::super::document::{Block, Check, Inline, Line, Tone, line, words};
use super::super::words::{mark, point_name, tone};
use super::quoted;
use crate::case::Case;
use crate::report::theorems;
use crate::theorem::{Certified, DenseSet, Kind, Statement, Verdict};

pub(super) fn section(case: &Case, found: &Certified) -> Vec<Block> {
    let Some(dense) = &found.dense else { return Vec::new() };
    let is_dense = |s: Statement| matches!(s, Statement::Theorem5 | Statement::Theorem5Projected);
    let Some(claim) = found.claims.iter().find(|c| c.statement.is_some_and(is_dense)) else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "A dense set of points")];
    let statement = claim.statement.map(theorems::of);
    match (claim.verdict, statement) {
        (Verdict::Proved, Some(theorem)) => blocks.push(quoted(theorem)),
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
    blocks.push(Block::Checks(checks(case, found, dense)));
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

fn checks(case: &Case, found: &Certified, dense: &DenseSet) -> Vec<Check> {
    let shape = &case.shape;
    let mut checks = Vec::new();
    for &index in &dense.joints {
        let Some(point) = found.points.get(index) else { continue };
        let mut text = words(format!("{}: ", point_name(shape, point)));
        text.push(mark(point.verdict));
        if point.kind != Kind::None {
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
        let (tone, verb) = if dense.view_injective { (Tone::Good, "is") } else { (Tone::Bad, "is not") };
        let text = words(format!("the projection by the control points {verb} injective on the relevant space"));
        checks.push(Check { tone, text });
    }
    for point in &dense.upstairs {
        let mut text = words(format!("before the projection, {}: ", point_name(shape, point).to_lowercase()));
        text.push(mark(point.verdict));
        checks.push(Check { tone: tone(point.verdict), text });
    }
    checks
}
