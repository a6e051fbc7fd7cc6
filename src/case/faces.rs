//! Face states: how they are divided, and their boundaries.

use super::node::{Node, Table};
use super::states::Automaton;
use super::{MAX_PIECES, StatePlace};
use crate::diagnostic::Problem;
use crate::shape::{CellKind, Face, Layout, OpName, Side};

/// The keys of a face state.
pub(super) const KEYS: [&str; 12] =
    ["name", "kind", "dimension", "piece", "layout", "bottom", "right", "top", "left", "side01", "side12", "side02"];

const QUAD: [&str; 4] = ["bottom", "right", "top", "left"];
const TRIANGLE: [&str; 3] = ["side01", "side12", "side02"];

/// Reads the layout, the sides and the corners of a face state; `None` for other states and for a face without sides.
pub(super) fn read(
    automaton: &mut Automaton<'_>,
    index: usize,
    place: &mut StatePlace,
) -> Result<Option<Face>, Problem> {
    let draft = &automaton.drafts[index];
    if draft.kind != CellKind::Face {
        return Ok(None);
    }
    let node = draft.table.need("layout", "\"2x2\"  (or \"triangle\")")?;
    let layout = layout(&node)?;
    let found = draft.pieces.len();
    if layout.pieces() != found {
        let message = format!("state `{}` has {found} pieces, but its layout has {}", draft.name, layout.pieces());
        return Err(node
            .problem("layout", message, format!("{} pieces", layout.pieces()))
            .with_help("piece (i, j) of a quadrangle in columns x rows is letter j * columns + i; a triangle has 4"));
    }
    let placement = placement(&draft.pieces, layout)?;
    let keys: &[&'static str] = if layout == Layout::Triangle { &TRIANGLE } else { &QUAD };
    let table = &draft.table;
    let other = QUAD.iter().chain(&TRIANGLE).find(|k| !keys.contains(k) && table.get(k).is_some());
    if let Some(node) = other.and_then(|k| table.get(k)) {
        return Err(node
            .problem("layout", format!("{} is no side of this layout", node.what), "no such side")
            .with_help(format!("the sides are {}", keys.join(", "))));
    }
    if keys.iter().all(|k| table.get(k).is_none()) {
        return Ok(None);
    }
    let mut sides = Vec::new();
    for (side, key) in keys.iter().enumerate() {
        let draft = &automaton.drafts[index];
        let mut table = draft.table.need(key, "{ edge = \"E\", matrix = [[…]] }")?.table()?;
        table.what = format!("side `{key}` of state `{}`", draft.name);
        let (edge, op, span) =
            automaton.part(&table, "edge", CellKind::Edge, index, OpName::Side { state: index, side })?;
        place.sides.push(span);
        sides.push(Side { edge, op });
    }
    Ok(Some(Face { layout, sides, placement }))
}

fn layout(node: &Node<'_>) -> Result<Layout, Problem> {
    let text = node.text()?;
    if text == "triangle" {
        return Ok(Layout::Triangle);
    }
    let size = |word: &str| word.trim().parse::<usize>().ok().filter(|n| (1..=MAX_PIECES).contains(n));
    let sizes = text.split_once('x').and_then(|(a, b)| Some((size(a)?, size(b)?)));
    match sizes {
        Some((columns, rows)) if columns * rows > 1 => Ok(Layout::Quad { columns, rows }),
        _ => Err(node.problem("layout", "the layout of a face is not known", "not a layout").with_help(
            "it is \"2x2\" (columns x rows of a quadrangle, at least two pieces) or \"triangle\" (in four)",
        )),
    }
}

/// For every piece the order of its corners; empty where all have their own.
fn placement(pieces: &[Table<'_>], layout: Layout) -> Result<Vec<Vec<usize>>, Problem> {
    let own: Vec<usize> = (0..layout.corners()).collect();
    let mut all = Vec::new();
    let mut given = false;
    for piece in pieces {
        let Some(node) = piece.get("corners") else {
            all.push(own.clone());
            continue;
        };
        given = true;
        let list = node.array(|k| format!("entry {k} of `corners`"))?;
        let corners = list.iter().map(|n| n.index(own.len() - 1)).collect::<Result<Vec<_>, _>>()?;
        let mut sorted = corners.clone();
        sorted.sort_unstable();
        if sorted != own {
            let message = format!("`corners` of {} must name each corner once", piece.what);
            return Err(node
                .problem("corners", message, format!("an order of 0 to {} is needed", own.len() - 1))
                .with_help("entry k says at which corner of its part corner k of the piece lies"));
        }
        all.push(corners);
    }
    Ok(if given { all } else { Vec::new() })
}
