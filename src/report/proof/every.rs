//! The section on every point of a curve: the cones, or why there are none.

use super::super::document::{Block, Check, Table, Tone, formula, line, words};
use super::super::every;
use super::super::math::Math;
use super::super::words::{mark, point_name, tone};
use super::quoted_id;
use crate::case::Case;
use crate::shape::word_text;
use crate::theorem::Certified;
use crate::theorem::cone::CommonCone;

pub(super) fn section(case: &Case, found: &Certified) -> Vec<Block> {
    let Some(result) = &found.everywhere else { return Vec::new() };
    let mut blocks = vec![Block::heading(2, "Every point")];
    if let Some(cone) = &result.cone {
        blocks.push(quoted_id(every::theorem(cone)));
        blocks.extend(cones(case, cone));
    }
    let checks = result.joints.iter().map(|joint| {
        let point = joint.report(found);
        let mut text = words(format!("{}: ", point_name(&case.shape, point)));
        text.push(mark(point.verdict));
        text.extend(words(format!(", {}", point.kind.word())));
        Check { tone: tone(point.verdict), text }
    });
    let checks: Vec<Check> = checks.collect();
    if !checks.is_empty() {
        blocks.push(Block::Checks(checks));
    }
    if let Some(o) = &result.obstacle {
        blocks.push(Block::text("In coordinates of $V$, with the orientation signs, the product of this cycle is", []));
        blocks.push(Block::Formula(Math::matrix(&o.product)));
    }
    blocks.push(Block::Facts(every::facts(case, found, result)));
    blocks
}

/// Most rays that are printed.
const MAX_RAYS: usize = 12;

fn cones(case: &Case, cone: &CommonCone) -> Vec<Block> {
    let mut blocks = Vec::new();
    if cone.cones.iter().any(|c| c.rays.cols() > MAX_RAYS) {
        blocks.push(Block::text(
            "The rays and the coefficients are given in the certificate; they are too many to be printed.",
            [],
        ));
        return blocks;
    }
    for own in &cone.cones {
        let name = &case.shape.states[own.state].name;
        blocks.push(Block::text(
            &format!("State {name}: the cone of the columns of $G$, with $fG>0$ and chord $Gy$,"),
            [],
        ));
        blocks.push(super::equation("G", Math::matrix(&own.rays)));
        blocks.push(Block::Paragraph(line("$f=@$, $y=@$.", [Math::vector(&own.functional), Math::vector(&own.chord)])));
    }
    let rows = cone.maps.iter().map(|m| {
        let state = words(case.shape.states[m.state].name.clone());
        vec![state, words(m.letter.to_string()), words(m.sign.to_string()), formula(Math::matrix(&m.matrix))]
    });
    blocks.push(Block::Details {
        summary: line("The images of the cones: $ε T_i G=G B$", []),
        blocks: vec![Block::Table(Table {
            caption: words("Coefficients of the images of the rays"),
            header: ["state", "piece", "ε", "B"].map(words).to_vec(),
            rows: rows.collect(),
        })],
    });
    if let Some(h) = &cone.view {
        blocks.push(Block::text("With the control points $P$: $h P G>0$ for $h=@$.", [Math::vector(h)]));
    }
    for slow in &cone.slow {
        let text = format!(
            "Along the cycle `{}` no product of the matrices $B$ is positive; there one positive eigenvalue has the one longest \
             Jordan block of largest modulus, and its leading coefficient is positive on all rays.",
            word_text(&slow.word)
        );
        blocks.push(Block::Checks(vec![Check { tone: Tone::Good, text: line(&text, []) }]));
    }
    blocks
}
