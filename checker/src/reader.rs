//! What this crate reads from a case file, for comparison with other readers.

use crate::base::{Checked, Matrix, Q, file};
use crate::claim::Address;
use crate::curve::{Kind, case};
use crate::vertex;

/// A matrix by rows.
pub type Rows = Vec<Vec<Q>>;

/// A case about a curve, a set or a surface, with everything that the rules use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct System {
    /// The name.
    pub name: String,
    /// The start state.
    pub start: usize,
    /// The states.
    pub states: Vec<StateRead>,
    /// The map into the space where the shape is looked at.
    pub view: Rows,
    /// The addresses to examine, in normal form.
    pub examine: Vec<Address>,
    /// Whether the pieces of its curves meet and their identities hold, without which no certificate is accepted.
    pub curves: bool,
}

/// A state of a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StateRead {
    /// `edge`, `vertex` or `set`; a face is a set.
    pub kind: &'static str,
    /// The number of coordinates.
    pub dimension: usize,
    /// The pieces: target, operator on columns, and whether it runs backwards.
    pub pieces: Vec<(usize, Rows, bool)>,
    /// The boundary operators of an edge at its start and finish: vertex and matrix.
    pub ends: [Option<(usize, Rows)>; 2],
}

fn rows(m: &Matrix) -> Rows {
    (0..m.rows).map(|i| (0..m.cols).map(|j| m.at(i, j)).collect()).collect()
}

/// Reads a case of a curve, a set or a surface.
///
/// # Errors
/// [`Rejected`](crate::Rejected) where the text is no such case.
pub fn system(text: &str) -> Checked<System> {
    crate::number::refill();
    let read = case::read(text, false)?;
    let state = |s: &crate::curve::State| StateRead {
        kind: match s.kind {
            Kind::Vertex => "vertex",
            Kind::Edge => "edge",
            Kind::Set => "set",
        },
        dimension: s.dim,
        pieces: s.pieces.iter().map(|p| (p.target, rows(&p.op), p.reversed)).collect(),
        ends: s.ends.each_ref().map(|end| end.as_ref().map(|(vertex, op)| (*vertex, rows(op)))),
    };
    let states = read.shape.states.iter().map(state).collect();
    let (start, view, curves) = (read.shape.start, rows(&read.shape.view), read.shape.check_curves().is_ok());
    crate::base::spend(0, 0)?;
    Ok(System { name: read.name, start, states, view, examine: read.examine, curves })
}

/// Reads a case about the vertices of a mesh: its name and the valences that it names, ascending; none, or `None` for all.
///
/// # Errors
/// [`Rejected`](crate::Rejected) where the text is no such case, or about a scheme for which there are no certificates.
pub fn valences(text: &str) -> Checked<(String, Option<Vec<usize>>)> {
    crate::number::refill();
    let case = file(text, vertex::KEYS, vertex::Case::read)?;
    Ok((case.name, case.asked.map(|asked| asked.into_iter().collect())))
}
