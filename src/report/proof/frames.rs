//! What was verified of the frames of a shape that starts somewhere.

use super::super::document::{Check, Tone, line, words};
use super::super::reported::{Reported, entries, vector};
use super::super::words::{mark, point_phrase, tone};
use crate::case::Case;
use crate::shape::word_text;
use crate::theorem::{FrameKind, FrameReport, Frames};

pub(super) fn checks<E: Reported>(case: &Case<E>, frames: &Frames) -> Vec<Check> {
    let mut checks = Vec::new();
    for frame in &frames.frames {
        checks.push(Check { tone: Tone::Good, text: words(named(case, frame)) });
        let joints = frame.joints.iter().map(|p| (p, "seen so"));
        let above = frame.cones.iter().flat_map(|c| &c.above).map(|p| (p, "above the code, seen through the frame"));
        for (point, how) in joints.chain(above) {
            let mut text = words(format!("{}, {how}: ", point_phrase(&case.shape, point)));
            text.push(mark(point.verdict));
            if point.kind.has_rays() {
                text.extend(words(format!(", {}", point.kind.word())));
            }
            checks.push(Check { tone: tone(point.verdict), text });
        }
        if let Some(found) = &frame.cones {
            let rows = &frame.seen.rows;
            checks.push(Check { tone: Tone::Good, text: line("the rows of the frame are $Q=@$", [entries(rows)]) });
            for cone in &found.cone.cones {
                let mut text =
                    words(format!("cone of state {}: rays, the columns of ", case.shape.states[cone.state].name));
                text.extend(line("$G=@$", [entries(&cone.rays)]));
                checks.push(Check { tone: Tone::Good, text });
            }
            for map in &found.cone.maps {
                let name = &case.shape.states[map.state].name;
                let mut text = words(format!("piece {} of state {name}: ", map.letter));
                let images = "$ε T G_δ=G B$ with $B=@$, not negative and without a zero column";
                text.extend(line(images, [entries(&map.matrix)]));
                checks.push(Check { tone: Tone::Good, text });
            }
            for (word, functional) in &found.code {
                let below =
                    if word.is_empty() { "everywhere".to_owned() } else { format!("below `{}`", word_text(word)) };
                let text = format!(
                    "{below} the functional $h=@$ on the rows $Q$ of the frame is positive on the cone as it is seen"
                );
                checks.push(Check { tone: Tone::Good, text: line(&text, [vector(functional)]) });
            }
        } else if frame.kind == FrameKind::Folded {
            let (tone, text) = if frame.spans {
                (Tone::Good, "the tangent lines and their images under the operators span the quotients")
            } else {
                (
                    Tone::Bad,
                    "the tangent lines and their images under the operators were not seen to span the quotients",
                )
            };
            checks.push(Check { tone, text: words(text) });
        }
    }
    checks
}

/// The frame in words.
fn named<E: Reported>(case: &Case<E>, frame: &FrameReport) -> String {
    let name = |e: usize| case.shape.states[e].name.as_str();
    let place = if frame.path.is_empty() {
        "the start".to_owned()
    } else {
        format!("behind the path {}", word_text(&frame.path))
    };
    let members: Vec<&str> = frame.family.iter().map(|s| name(s.state)).collect();
    let (seen, all) = (frame.seen.rows.rows(), case.shape.states[frame.seen.state].dim);
    let kind = match frame.kind {
        FrameKind::Transient => "transient".to_owned(),
        FrameKind::Good => {
            format!("good: all operators between the states {} are injective on what is seen", members.join(", "))
        }
        FrameKind::Folded => format!("folded; from it the states {} can be reached", members.join(", ")),
    };
    format!(
        "frame of state {} ({all} coordinates), {place}: {seen} dimensions are seen; {kind}",
        name(frame.seen.state)
    )
}
