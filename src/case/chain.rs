//! States that name a scheme, and states that are a chain of others on shared points.

use super::node::{Node, Table};
use super::scheme::{parameters, refused};
use super::states::{Draft, state_index};
use super::{MAX_COORDINATES, MAX_PIECES};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::scheme::{self, Ordered, ordered};
use crate::shape::{CellKind, Piece};

/// What a state is built from instead of pieces.
pub(super) enum Built {
    /// Nothing: it has pieces of its own.
    No,
    /// A scheme, on points from left to right.
    Scheme(Ordered),
    /// A chain: its states and the first point of each, once all are measured, and its number of points.
    Chain(Vec<(usize, usize)>, usize),
}

impl Built {
    /// The number of coordinates, as far as it is known.
    pub fn dim(&self) -> usize {
        match self {
            Self::No => 0,
            Self::Scheme(curve) => curve.operators[0].rows(),
            Self::Chain(_, dim) => *dim,
        }
    }
}

/// Reads `scheme = "bspline"` with its parameters, or `chain = ["Q", "I", "C"]`; `None` for a state with pieces.
pub(super) fn read(table: &Table<'_>, kind: CellKind) -> Result<Option<Built>, Problem> {
    let keys: Vec<&str> = ["scheme", "chain"].into_iter().filter(|k| table.get(k).is_some()).collect();
    let Some(&key) = keys.first() else { return Ok(None) };
    let node = table.need(key, "\"bspline\"")?;
    if kind != CellKind::Edge {
        return Err(node
            .problem("two-forms", format!("{} has a `{key}` but is no edge", table.what), "only curves have one")
            .with_help("leave `kind` out, or give the pieces of the state"));
    }
    let other =
        ["scheme", "chain", "piece", "dimension", "reversal"].into_iter().find(|k| *k != key && table.get(k).is_some());
    if let Some(span) = other.and_then(|k| table.key_span(k)) {
        return Err(table
            .file
            .problem(
                "two-forms",
                format!("`{key}` of {} and this exclude each other", table.what),
                span,
                "given besides",
            )
            .with_help("a state has pieces, or names a scheme, or is a chain of states"));
    }
    if key == "chain" {
        table.only(&["name", "kind", "chain"])?;
        return Ok(Some(Built::Chain(Vec::new(), 0)));
    }
    let name = node.text()?;
    let values = parameters(table, &["name", "kind", "scheme"])?;
    let known: Vec<&str> = scheme::list().iter().map(|s| s.name).collect();
    let shape = scheme::build(name, &values).map_err(|e| refused(table, &node, &e, &known))?;
    let curve = (shape.states[shape.start].kind == CellKind::Edge && shape.reachable().len() == 1)
        .then(|| ordered(&shape))
        .flatten()
        .filter(|c| c.operators[0].rows() <= MAX_COORDINATES);
    match curve {
        Some(curve) if shape.states[shape.start].pieces.iter().all(|p| !p.reversed) => Ok(Some(Built::Scheme(curve))),
        _ => Err(node
            .problem("scheme", format!("`{name}` cannot be a state"), "no curve with ends of its own")
            .with_help("a state may name a curve none of whose pieces runs backwards")),
    }
}

/// Finds the points that the states of every chain share.
pub(super) fn measure(drafts: &mut [Draft<'_>]) -> Result<(), Problem> {
    let chains: Vec<usize> = (0..drafts.len()).filter(|k| matches!(drafts[*k].built, Built::Chain(..))).collect();
    let mut measured = Vec::new();
    for &k in &chains {
        let node = drafts[k].table.need("chain", "[\"Q\", \"I\", \"C\"]")?;
        let links = node.array(|i| format!("entry {i} of `chain`"))?;
        if links.is_empty() || links.len() > MAX_PIECES {
            return Err(node
                .problem("no-piece", format!("a chain has 1 to {MAX_PIECES} states"), format!("{} here", links.len()))
                .with_help("list the names of states in the order of the curve"));
        }
        let mut places: Vec<(usize, usize)> = Vec::new();
        let mut dim = 0;
        for link in &links {
            let state = state_index(link, drafts)?;
            if chains.contains(&state) || drafts[state].kind != CellKind::Edge {
                return Err(link
                    .problem("target-kind", "a chain is made of curves that are no chains themselves", "not this one")
                    .with_help("list the states of that chain instead"));
            }
            let first = match places.last() {
                Some((before, _)) => dim - shared(link, &drafts[*before], &drafts[state])?,
                None => 0,
            };
            dim = first + drafts[state].dim;
            places.push((state, first));
        }
        if dim > MAX_COORDINATES {
            return Err(node
                .problem(
                    "limit",
                    format!("the chain has {dim} points, over the limit of {MAX_COORDINATES}"),
                    "too long",
                )
                .with_help("take fewer states"));
        }
        measured.push((k, places, dim));
    }
    for (k, places, dim) in measured {
        drafts[k].built = Built::Chain(places, dim);
        drafts[k].dim = dim;
    }
    Ok(())
}

/// The number of points that two neighbours of a chain share: those of the end of the one and of the start of the other, which a
/// scheme has, or a boundary says.
fn shared(link: &Node<'_>, before: &Draft<'_>, after: &Draft<'_>) -> Result<usize, Problem> {
    let (left, right) = (end(before, "right")?, end(after, "left")?);
    match (left, right) {
        (Some(a), Some(b)) if a != b => Err(link
            .problem(
                "size",
                format!("`{}` ends on {a} points, but `{}` begins on {b}", before.name, after.name),
                "does not follow",
            )
            .with_help("put an intermediate curve between them; `secant junction` makes one")),
        (Some(p), _) | (_, Some(p)) => Ok(p),
        (None, None) => Err(link
            .problem(
                "missing-key",
                format!("it is not known how many points `{}` and `{}` share", before.name, after.name),
                "how many?",
            )
            .with_help("give the boundary of one of them, as in  left = { vertex = \"v\", points = [0, 1] }")),
    }
}

/// The number of points at an end of a state, where that is known.
fn end(draft: &Draft<'_>, key: &str) -> Result<Option<usize>, Problem> {
    if let Built::Scheme(curve) = &draft.built {
        return Ok(Some(curve.shared));
    }
    let Some(node) = draft.table.get(key) else { return Ok(None) };
    let Some(points) = node.table()?.get("points") else { return Ok(None) };
    Ok(Some(points.array(|k| format!("entry {k} of `points`"))?.len()))
}

/// The pieces of a state that is built; none of others.
pub(super) fn pieces(drafts: &[Draft<'_>], index: usize) -> Vec<Piece> {
    match &drafts[index].built {
        Built::No => Vec::new(),
        Built::Scheme(curve) => {
            let piece = |op: &Matrix| Piece { target: index, op: op.clone(), reversed: false, share: None };
            curve.operators.iter().map(piece).collect()
        }
        Built::Chain(places, dim) => {
            let select =
                |len: usize, first: usize| Matrix::from_fn(*dim, len, |i, j| Rational::from(u8::from(i == first + j)));
            let piece = |(state, first): &(usize, usize)| Piece {
                target: *state,
                op: select(drafts[*state].dim, *first),
                reversed: false,
                share: None,
            };
            places.iter().map(piece).collect()
        }
    }
}
