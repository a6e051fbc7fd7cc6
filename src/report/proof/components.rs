//! Theorem 13 as it was verified: which kind every state is of, and why.

use super::super::document::{Block, Tone, line, words};
use super::super::math::Math;
use super::super::values::lambda_math;
use super::super::words::{count, root_of};
use super::cycles::spectrum_blocks;
use super::evidence::Evidence;
use crate::arith::Rational;
use crate::case::Case;
use crate::statement::Statement;
use crate::theorem::{Component, Components};

/// The hypotheses, each with what was found.
pub(super) fn evidence(case: &Case, found: &Components) -> Evidence {
    let name = |state: usize| &case.shape.states[state].name;
    let mut evidence = Evidence::of(Statement::Components);
    let kinds: Vec<String> = found
        .parts
        .iter()
        .map(|p| match p {
            Component::Cones { state, .. } => format!("{} with cones", name(*state)),
            Component::Loop { state, .. } => format!("{} a loop", name(*state)),
            Component::Transient { state, .. } => format!("{} transient", name(*state)),
        })
        .collect();
    evidence.push("states", Tone::Good, words(format!("from the last one backwards: {}.", kinds.join(", "))));
    let mut kinds = (false, false);
    for part in &found.parts {
        match part {
            Component::Cones { state, cone, joints } => {
                kinds.0 = true;
                let rays = cone.cones.iter().find(|c| c.state == *state).map_or(0, |c| c.rays.cols());
                let text = format!(
                    "{}: a cone of {}, with which the hypotheses of the theorem hold for all states it reaches; regular: {}.",
                    name(*state),
                    count(rays, "ray"),
                    count(joints.len(), "joint")
                );
                evidence.push("cones", Tone::Good, words(text));
            }
            Component::Loop { state, letter, pull, points } => {
                kinds.1 = true;
                let (root, factor) = (pull.spectrum.root(pull.lead), pull.spectrum.factor(pull.lead));
                let text = format!(
                    "{}: piece {letter} leads back, with $@$, positive, in the one longest block, of length $@$, of largest modulus",
                    name(*state)
                );
                let mut text = line(&text, [lambda_math(root), Math::count(factor.blocks[0])]);
                text.extend(root_of(root));
                text.extend(words(
                    "; its coefficient has one strict sign on the images of all rays of the other pieces.",
                ));
                evidence.push("loops", Tone::Good, text);
                let text =
                    format!("{}: {}, the last one being the fixed point.", name(*state), count(points.len(), "point"));
                evidence.push("points", Tone::Good, words(text));
            }
            Component::Transient { state, points } => {
                let text = format!("{}: {}, all regular.", name(*state), count(points.len(), "joint"));
                evidence.push("points", Tone::Good, words(text));
            }
        }
    }
    if !kinds.0 {
        evidence.push("cones", Tone::Neutral, words("there is no such state."));
    }
    if !kinds.1 {
        evidence.push("loops", Tone::Neutral, words("there is no loop."));
    }
    if found.parts.iter().all(|p| matches!(p, Component::Cones { .. })) {
        evidence.push("points", Tone::Neutral, words("all states have cones."));
    }
    evidence.push("injective", Tone::Good, words("the ranks are the dimensions of the relevant spaces."));
    let view = match &found.sight {
        None => "there are no control points.".to_owned(),
        Some((_, code)) => {
            format!("cones of all states, and a functional behind each of {}.", count(code.len(), "word"))
        }
    };
    evidence.push("view", Tone::Good, words(view));
    evidence
}

/// The spectra of the loops.
pub(super) fn loops(case: &Case, found: &Components) -> Vec<Block> {
    let mut blocks = Vec::new();
    for part in &found.parts {
        if let Component::Loop { state, letter, pull, .. } = part {
            let name = &case.shape.states[*state].name;
            blocks.push(Block::text(
                &format!("Of the loop {name} the piece {letter} that leads back acts on $V$ by"),
                [],
            ));
            blocks.push(super::matrix(Math::Letter('L'), &pull.linear));
            blocks.extend(spectrum_blocks::<Rational>(&pull.spectrum));
        }
    }
    blocks
}
