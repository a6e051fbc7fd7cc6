//! The identities of a cell complex (incidence, adjacency, corners, reversals), generated from the subdivision of its cells
//! (theory §1; thesis §3.6).
//!
//! Corners of a quadrangle are `(0,0), (1,0), (1,1), (0,1)` in its parameters `(u, v)`; its sides are `bottom` (corner 0 to
//! 1), `right` (1 to 2), `top` (3 to 2) and `left` (0 to 3). A quadrangle in `columns x rows` has the piece `(i, j)` as
//! letter `j * columns + i`. A triangle has the sides `01`, `12`, `02`; its pieces 0, 1, 2 lie at its corners, piece 3 in
//! the middle, turned by 180°, so that its corner `k` is the midpoint of the side opposite to corner `k`.

use super::{CellKind, Shape};
use crate::arith::Rational;
use crate::linalg::Matrix;
use std::collections::BTreeMap;
use thiserror::Error;

/// How a face is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// A quadrangle in `columns` (along `u`) times `rows` (along `v`).
    Quad {
        /// Pieces along `u`.
        columns: usize,
        /// Pieces along `v`.
        rows: usize,
    },
    /// A triangle in four.
    Triangle,
}

/// A boundary operator `∂ : X_edge -> X_face`.
#[derive(Debug, Clone)]
pub struct Side {
    /// Index of the edge state.
    pub edge: usize,
    /// The operator, `dim(face) x dim(edge)`, every column summing to 1.
    pub op: Matrix,
}

/// The boundary of a face state.
#[derive(Debug, Clone)]
pub struct Face {
    /// How it is divided.
    pub layout: Layout,
    /// Its sides, in the order given above.
    pub sides: Vec<Side>,
    /// For every piece, the corner of the subcell at which each of its own corners lies; empty: all in their own order.
    pub placement: Vec<Vec<usize>>,
}

/// An operator `R : X_edge -> X_e` that runs the curve of `edge` as the curve of `e` backwards.
#[derive(Debug, Clone)]
pub struct Reversal {
    /// Index of the edge state.
    pub edge: usize,
    /// The operator.
    pub op: Matrix,
}

/// A shape with the boundaries of its faces (a BCIFS).
#[derive(Debug, Clone)]
pub struct Complex {
    /// States, pieces, and the boundaries of the edges.
    pub shape: Shape,
    /// Boundaries of the faces, by index of the state.
    pub faces: BTreeMap<usize, Face>,
    /// Reversals of the edges, by index of the state.
    pub reversals: BTreeMap<usize, Reversal>,
}

/// An operator of a complex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum OpName {
    /// Piece `letter` of a state.
    Piece {
        /// The state.
        state: usize,
        /// The letter.
        letter: usize,
    },
    /// `∂_0` of an edge.
    Left(usize),
    /// `∂_1` of an edge.
    Right(usize),
    /// A side of a face.
    Side {
        /// The face.
        state: usize,
        /// The side.
        side: usize,
    },
    /// The reversal of an edge.
    Reverse(usize),
}

/// Where an identity comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum IdentityKind {
    /// The boundary of a cell is divided like its boundary cell.
    Incidence,
    /// Two neighbouring pieces share a boundary.
    Adjacency,
    /// Two sides of a face share a corner.
    Corner,
    /// A reversal turns the pieces of an edge round.
    Reversal,
}

impl std::fmt::Display for IdentityKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Incidence => "incidence",
            Self::Adjacency => "adjacency",
            Self::Corner => "corner",
            Self::Reversal => "reversal",
        })
    }
}

/// Two products of operators that must be equal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    /// Where it comes from.
    pub kind: IdentityKind,
    /// The cell to which it belongs.
    pub state: usize,
    /// The factors of one side.
    pub left: Vec<OpName>,
    /// The factors of the other.
    pub right: Vec<OpName>,
}

/// An identity that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "{text} fails ({kind} of state `{state}`); entry ({row}, {column}) of the left product minus the right one is {residual}"
)]
pub struct Failure {
    /// Where it comes from.
    pub kind: IdentityKind,
    /// Name of the cell.
    pub state: String,
    /// The identity, written out.
    pub text: String,
    /// The left product.
    pub left: Matrix,
    /// The right product.
    pub right: Matrix,
    /// Row of the first entry that differs.
    pub row: usize,
    /// Its column.
    pub column: usize,
    /// The difference.
    pub residual: Rational,
}

/// Why the identities cannot be written down.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ComplexError {
    /// The number of pieces does not fit the layout.
    #[error("state `{state}`: {message}")]
    Cell {
        /// Name of the state.
        state: String,
        /// What is wrong.
        message: String,
    },
    /// Two boundaries that should coincide are of different states.
    #[error("state `{state}`: {left} ends in state `{left_state}`, but {right} in `{right_state}`")]
    Different {
        /// Name of the state.
        state: String,
        /// One path.
        left: String,
        /// Its last state.
        left_state: String,
        /// The other path.
        right: String,
        /// Its last state.
        right_state: String,
    },
    /// A product with factors that do not fit.
    #[error("the factors of {text} do not fit: {operator} must have {expected} rows and has {found}")]
    Size {
        /// The product.
        text: String,
        /// The factor.
        operator: String,
        /// Rows expected.
        expected: usize,
        /// Rows found.
        found: usize,
    },
    /// An identity that fails.
    #[error(transparent)]
    Fails(#[from] Box<Failure>),
}

/// The cells of a divided face: nodes, the corners of each subcell, and the nodes along each side.
struct Division {
    cells: Vec<Vec<usize>>,
    sides: Vec<Vec<usize>>,
}

impl Layout {
    /// Number of pieces.
    #[must_use]
    pub fn pieces(self) -> usize {
        match self {
            Self::Quad { columns, rows } => columns.saturating_mul(rows),
            Self::Triangle => 4,
        }
    }

    /// For every side the corners where it begins and ends.
    #[must_use]
    pub fn sides(self) -> &'static [(usize, usize)] {
        match self {
            Self::Quad { .. } => &[(0, 1), (1, 2), (3, 2), (0, 3)],
            Self::Triangle => &[(0, 1), (1, 2), (0, 2)],
        }
    }

    /// Number of corners.
    #[must_use]
    pub fn corners(self) -> usize {
        self.sides().len()
    }

    /// The keys of the sides in a case file.
    #[must_use]
    pub fn side_keys(self) -> &'static [&'static str] {
        match self {
            Self::Quad { .. } => &["bottom", "right", "top", "left"],
            Self::Triangle => &["side01", "side12", "side02"],
        }
    }

    fn side_name(self, side: usize) -> &'static str {
        let names: &'static [&'static str] = match self {
            Self::Quad { .. } => &["bottom", "right", "top", "left"],
            Self::Triangle => &["01", "12", "02"],
        };
        names.get(side).map_or("?", |name| *name)
    }

    fn division(self) -> Division {
        match self {
            Self::Quad { columns, rows } => {
                let node = |i: usize, j: usize| j * (columns + 1) + i;
                let cell = |k: usize| {
                    let (i, j) = (k % columns, k / columns);
                    vec![node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
                };
                let along = |j: usize| (0..=columns).map(|i| node(i, j)).collect();
                let up = |i: usize| (0..=rows).map(|j| node(i, j)).collect();
                let sides = vec![along(0), up(columns), along(rows), up(0)];
                Division { cells: (0..columns * rows).map(cell).collect(), sides }
            }
            // Corners 0, 1, 2; midpoints 3 of 01, 4 of 12, 5 of 02.
            Self::Triangle => Division {
                cells: vec![vec![0, 3, 5], vec![3, 1, 4], vec![5, 4, 2], vec![4, 5, 3]],
                sides: vec![vec![0, 3, 1], vec![1, 4, 2], vec![0, 5, 2]],
            },
        }
    }
}

/// A boundary curve of a piece, or a piece of a boundary curve.
struct Segment {
    from: usize,
    to: usize,
    path: Vec<OpName>,
    edge: usize,
}

impl Complex {
    /// A complex of curves only.
    #[must_use]
    pub fn of_curves(shape: Shape) -> Self {
        Self { shape, faces: BTreeMap::new(), reversals: BTreeMap::new() }
    }

    /// An operator; `None` where the complex does not have it.
    #[must_use]
    pub fn operator(&self, name: OpName) -> Option<&Matrix> {
        match name {
            OpName::Piece { state, letter } => Some(&self.shape.states.get(state)?.pieces.get(letter)?.op),
            OpName::Left(state) => Some(&self.shape.states.get(state)?.left.as_ref()?.op),
            OpName::Right(state) => Some(&self.shape.states.get(state)?.right.as_ref()?.op),
            OpName::Side { state, side } => Some(&self.faces.get(&state)?.sides.get(side)?.op),
            OpName::Reverse(state) => Some(&self.reversals.get(&state)?.op),
        }
    }

    /// An operator, to be changed.
    pub fn operator_mut(&mut self, name: OpName) -> Option<&mut Matrix> {
        match name {
            OpName::Piece { state, letter } => Some(&mut self.shape.states.get_mut(state)?.pieces.get_mut(letter)?.op),
            OpName::Left(state) => Some(&mut self.shape.states.get_mut(state)?.left.as_mut()?.op),
            OpName::Right(state) => Some(&mut self.shape.states.get_mut(state)?.right.as_mut()?.op),
            OpName::Side { state, side } => Some(&mut self.faces.get_mut(&state)?.sides.get_mut(side)?.op),
            OpName::Reverse(state) => Some(&mut self.reversals.get_mut(&state)?.op),
        }
    }

    /// An operator written as `T_letter[state]`, `∂_0[state]`, `∂_top[state]`, `R[state]`.
    #[must_use]
    pub fn operator_text(&self, name: OpName) -> String {
        let state_name = |s: usize| self.shape.states.get(s).map_or("?", |state| state.name.as_str());
        match name {
            OpName::Piece { state, letter } => format!("T_{letter}[{}]", state_name(state)),
            OpName::Left(state) => format!("∂_0[{}]", state_name(state)),
            OpName::Right(state) => format!("∂_1[{}]", state_name(state)),
            OpName::Side { state, side } => {
                let side = self.faces.get(&state).map_or("?", |f| f.layout.side_name(side));
                format!("∂_{side}[{}]", state_name(state))
            }
            OpName::Reverse(state) => format!("R[{}]", state_name(state)),
        }
    }

    /// A product of operators, written out.
    #[must_use]
    pub fn path_text(&self, path: &[OpName]) -> String {
        path.iter().map(|name| self.operator_text(*name)).collect::<Vec<_>>().join(" ")
    }

    /// An identity, written out.
    #[must_use]
    pub fn identity_text(&self, identity: &Identity) -> String {
        format!("{} = {}", self.path_text(&identity.left), self.path_text(&identity.right))
    }

    /// The product of a path.
    ///
    /// # Errors
    /// [`ComplexError::Size`] where factors do not fit or are missing.
    pub fn path_product(&self, path: &[OpName]) -> Result<Matrix, ComplexError> {
        let mut product: Option<Matrix> = None;
        for &name in path {
            let size = |expected, found| ComplexError::Size {
                text: self.path_text(path),
                operator: self.operator_text(name),
                expected,
                found,
            };
            let op = self.operator(name).ok_or_else(|| size(product.as_ref().map_or(0, Matrix::cols), 0))?;
            product = Some(match product {
                None => op.clone(),
                Some(p) if p.cols() == op.rows() => &p * op,
                Some(p) => return Err(size(p.cols(), op.rows())),
            });
        }
        Ok(product.unwrap_or_else(|| Matrix::zero(0, 0)))
    }

    /// All identities of the complex, generated from its cells: an edge in `N` pieces has `N − 1` of adjacency and 2 of
    /// incidence, a quadrangle in 4 has 4 and 8 (the twelve of thesis §3.6.1), a triangle in 4 has 3 and 6; faces have
    /// besides one for each corner, and reversals one for each piece and end.
    ///
    /// Identities of boundaries that the complex does not have are left out.
    ///
    /// # Errors
    /// [`ComplexError::Cell`] and [`ComplexError::Different`].
    pub fn identities(&self) -> Result<Vec<Identity>, ComplexError> {
        self.check_sizes()?;
        let mut all = Vec::new();
        for (e, state) in self.shape.states.iter().enumerate() {
            match state.kind {
                CellKind::Edge => self.edge_identities(e, &mut all)?,
                CellKind::Face => self.face_identities(e, &mut all)?,
                CellKind::Vertex | CellKind::Set => {}
            }
        }
        for e in self.reversals.keys() {
            self.reversal_identities(*e, &mut all)?;
        }
        Ok(all)
    }

    /// Checks every identity and returns those that fail.
    ///
    /// # Errors
    /// As for [`Complex::identities`] and [`Complex::path_product`].
    pub fn failures(&self) -> Result<Vec<Failure>, ComplexError> {
        let mut failures = Vec::new();
        for identity in self.identities()? {
            if let Some(failure) = self.failure(&identity)? {
                failures.push(failure);
            }
        }
        Ok(failures)
    }

    /// Checks every identity and returns how many there are.
    ///
    /// # Errors
    /// [`ComplexError::Fails`] with the first that fails, and those of [`Complex::identities`].
    pub fn check(&self) -> Result<usize, ComplexError> {
        let identities = self.identities()?;
        for identity in &identities {
            if let Some(failure) = self.failure(identity)? {
                return Err(Box::new(failure).into());
            }
        }
        Ok(identities.len())
    }

    /// Checks that every state that is named exists, is of the right kind, and that every operator has the right size.
    fn check_sizes(&self) -> Result<(), ComplexError> {
        let states = &self.shape.states;
        for (e, state) in states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate() {
                self.fits(e, OpName::Piece { state: e, letter }, piece.target, &piece.op, None)?;
            }
            for (name, boundary) in [(OpName::Left(e), &state.left), (OpName::Right(e), &state.right)] {
                if let Some(b) = boundary {
                    self.fits(e, name, b.vertex, &b.op, Some(CellKind::Vertex))?;
                }
            }
        }
        for (&e, face) in &self.faces {
            if states.get(e).is_none_or(|s| s.kind != CellKind::Face) {
                return Err(self.cell_error(e, "sides are given, but this is no face".to_owned()));
            }
            for (side, s) in face.sides.iter().enumerate() {
                self.fits(e, OpName::Side { state: e, side }, s.edge, &s.op, Some(CellKind::Edge))?;
            }
        }
        for (&e, reversal) in &self.reversals {
            if states.get(e).is_none_or(|s| s.kind != CellKind::Edge) {
                return Err(self.cell_error(e, "a reversal is given, but this is no edge".to_owned()));
            }
            self.fits(e, OpName::Reverse(e), reversal.edge, &reversal.op, Some(CellKind::Edge))?;
        }
        Ok(())
    }

    fn fits(
        &self,
        e: usize,
        name: OpName,
        from: usize,
        op: &Matrix,
        kind: Option<CellKind>,
    ) -> Result<(), ComplexError> {
        let text = self.operator_text(name);
        let Some(source) = self.shape.states.get(from) else {
            return Err(self.cell_error(e, format!("{text} comes from state {from}, which does not exist")));
        };
        if kind.is_some_and(|k| k != source.kind) {
            let found = format!("{:?}", source.kind).to_lowercase();
            let message = format!("{text} comes from state `{}`, which is of the wrong kind ({found})", source.name);
            return Err(self.cell_error(e, message));
        }
        let (wanted, found) = ((self.shape.states[e].dim, source.dim), (op.rows(), op.cols()));
        if wanted != found {
            return Err(self.cell_error(e, format!("{text} is {found:?}, but must be {wanted:?} (rows, columns)")));
        }
        Ok(())
    }

    /// Compares the two products of an identity.
    ///
    /// # Errors
    /// [`ComplexError::Size`] where factors do not fit.
    pub fn failure(&self, identity: &Identity) -> Result<Option<Failure>, ComplexError> {
        let (left, right) = (self.path_product(&identity.left)?, self.path_product(&identity.right)?);
        let text = self.identity_text(identity);
        if (left.rows(), left.cols()) != (right.rows(), right.cols()) {
            let (expected, found) = (left.cols(), right.cols());
            return Err(ComplexError::Size { operator: self.path_text(&identity.right), text, expected, found });
        }
        let entries = (0..left.rows()).flat_map(|i| (0..left.cols()).map(move |j| (i, j)));
        let first = entries.into_iter().find(|at| left[*at] != right[*at]);
        Ok(first.map(|(row, column)| {
            let residual = &left[(row, column)] - &right[(row, column)];
            let state = self.shape.states[identity.state].name.clone();
            Failure { kind: identity.kind, state, text, left, right, row, column, residual }
        }))
    }

    fn cell_error(&self, state: usize, message: String) -> ComplexError {
        let state = self.shape.states.get(state).map_or_else(|| format!("number {state}"), |s| s.name.clone());
        ComplexError::Cell { state, message }
    }

    /// The boundary of an edge state at its start (`false`) or end (`true`), with its vertex.
    fn end(&self, state: usize, finish: bool) -> Option<(OpName, usize)> {
        let boundaries = self.shape.states.get(state)?;
        if finish {
            boundaries.right.as_ref().map(|b| (OpName::Right(state), b.vertex))
        } else {
            boundaries.left.as_ref().map(|b| (OpName::Left(state), b.vertex))
        }
    }

    fn edge_identities(&self, e: usize, all: &mut Vec<Identity>) -> Result<(), ComplexError> {
        let pieces = &self.shape.states[e].pieces;
        let inner = |letter: usize, finish: bool| {
            let piece = &pieces[letter];
            let (op, vertex) = self.end(piece.target, finish != piece.reversed)?;
            Some((vec![OpName::Piece { state: e, letter }, op], vertex))
        };
        let Some(last) = pieces.len().checked_sub(1) else { return Ok(()) };
        for (finish, letter) in [(false, 0), (true, last)] {
            if let (Some((op, vertex)), Some(inside)) = (self.end(e, finish), inner(letter, finish)) {
                let [step] = self.shape.states[vertex].pieces.as_slice() else {
                    let name = &self.shape.states[vertex].name;
                    return Err(self.cell_error(e, format!("its vertex state `{name}` must have exactly one piece")));
                };
                let outside = (vec![op, OpName::Piece { state: vertex, letter: 0 }], step.target);
                all.push(self.equal(IdentityKind::Incidence, e, outside, inside)?);
            }
        }
        for j in 1..=last {
            if let (Some(before), Some(after)) = (inner(j - 1, true), inner(j, false)) {
                all.push(self.equal(IdentityKind::Adjacency, e, before, after)?);
            }
        }
        Ok(())
    }

    fn equal(
        &self,
        kind: IdentityKind,
        state: usize,
        (left, left_end): (Vec<OpName>, usize),
        (right, right_end): (Vec<OpName>, usize),
    ) -> Result<Identity, ComplexError> {
        if left_end == right_end {
            return Ok(Identity { kind, state, left, right });
        }
        let name = |s: usize| self.shape.states[s].name.clone();
        Err(ComplexError::Different {
            state: name(state),
            left: self.path_text(&left),
            left_state: name(left_end),
            right: self.path_text(&right),
            right_state: name(right_end),
        })
    }

    fn face_identities(&self, e: usize, all: &mut Vec<Identity>) -> Result<(), ComplexError> {
        let Some(face) = self.faces.get(&e) else { return Ok(()) };
        let division = self.fitting_division(e, face)?;
        let inner = self.inner_segments(e, face, &division)?;
        let outer = self.outer_segments(e, face, &division)?;
        let mut partners: BTreeMap<(usize, usize), &Segment> = BTreeMap::new();
        let key = |s: &Segment| (s.from.min(s.to), s.from.max(s.to));
        for segment in &outer {
            partners.insert(key(segment), segment);
        }
        for segment in &inner {
            let Some(partner) = partners.insert(key(segment), segment) else { continue };
            let kind = if matches!(partner.path[0], OpName::Side { .. }) {
                IdentityKind::Incidence
            } else {
                IdentityKind::Adjacency
            };
            all.push(self.same_segment(kind, e, partner, segment)?);
        }
        self.corner_identities(e, face, all)
    }

    fn fitting_division(&self, e: usize, face: &Face) -> Result<Division, ComplexError> {
        let (layout, pieces) = (face.layout, self.shape.states[e].pieces.len());
        if layout.pieces() != pieces {
            return Err(
                self.cell_error(e, format!("the layout {layout:?} has {} pieces, not {pieces}", layout.pieces()))
            );
        }
        if layout.sides().len() != face.sides.len() {
            let (wanted, found) = (layout.sides().len(), face.sides.len());
            return Err(self.cell_error(e, format!("the layout {layout:?} has {wanted} sides, not {found}")));
        }
        let corners: Vec<usize> = (0..layout.corners()).collect();
        let permuted = |p: &Vec<usize>| {
            let mut sorted = p.clone();
            sorted.sort_unstable();
            sorted == corners
        };
        if !face.placement.is_empty() && (face.placement.len() != pieces || !face.placement.iter().all(permuted)) {
            return Err(
                self.cell_error(e, "the placement must give an order of the corners for every piece".to_owned())
            );
        }
        Ok(layout.division())
    }

    fn inner_segments(&self, e: usize, face: &Face, division: &Division) -> Result<Vec<Segment>, ComplexError> {
        let mut segments = Vec::new();
        for (letter, piece) in self.shape.states[e].pieces.iter().enumerate() {
            let Some(inside) = self.faces.get(&piece.target) else { continue };
            let cell = &division.cells[letter];
            if inside.layout.corners() != cell.len() || inside.sides.len() != cell.len() {
                return Err(self.cell_error(e, format!("piece {letter} is a face with another number of sides")));
            }
            let corner = |k: usize| face.placement.get(letter).map_or(cell[k], |p| cell[p[k]]);
            for (side, (from, to)) in inside.layout.sides().iter().enumerate() {
                let path = vec![OpName::Piece { state: e, letter }, OpName::Side { state: piece.target, side }];
                segments.push(Segment { from: corner(*from), to: corner(*to), path, edge: inside.sides[side].edge });
            }
        }
        Ok(segments)
    }

    fn outer_segments(&self, e: usize, face: &Face, division: &Division) -> Result<Vec<Segment>, ComplexError> {
        let mut segments = Vec::new();
        for (side, nodes) in division.sides.iter().enumerate() {
            let edge = face.sides[side].edge;
            let pieces = &self.shape.states[edge].pieces;
            if pieces.len() + 1 != nodes.len() {
                let (name, found, wanted) = (face.layout.side_name(side), pieces.len(), nodes.len() - 1);
                return Err(
                    self.cell_error(e, format!("side {name} has an edge in {found} pieces, but needs {wanted}"))
                );
            }
            for (letter, piece) in pieces.iter().enumerate() {
                let (mut from, mut to) = (nodes[letter], nodes[letter + 1]);
                if piece.reversed {
                    (from, to) = (to, from);
                }
                let path = vec![OpName::Side { state: e, side }, OpName::Piece { state: edge, letter }];
                segments.push(Segment { from, to, path, edge: piece.target });
            }
        }
        Ok(segments)
    }

    fn same_segment(&self, kind: IdentityKind, e: usize, a: &Segment, b: &Segment) -> Result<Identity, ComplexError> {
        let (left, mut right) = ((a.path.clone(), a.edge), (b.path.clone(), b.edge));
        if (a.from, a.to) == (b.to, b.from) {
            let Some(reversal) = self.reversals.get(&b.edge) else {
                let name = &self.shape.states[b.edge].name;
                let (x, y) = (self.path_text(&a.path), self.path_text(&b.path));
                let message = format!("{x} and {y} run in opposite directions, and edge `{name}` has no reversal");
                return Err(self.cell_error(e, message));
            };
            right.0.push(OpName::Reverse(b.edge));
            right.1 = reversal.edge;
        }
        self.equal(kind, e, left, right)
    }

    fn corner_identities(&self, e: usize, face: &Face, all: &mut Vec<Identity>) -> Result<(), ComplexError> {
        for corner in 0..face.layout.corners() {
            let ends: Vec<_> = face
                .layout
                .sides()
                .iter()
                .enumerate()
                .filter(|(_, (from, to))| *from == corner || *to == corner)
                .filter_map(|(side, (_, to))| {
                    let (op, vertex) = self.end(face.sides[side].edge, *to == corner)?;
                    Some((vec![OpName::Side { state: e, side }, op], vertex))
                })
                .collect();
            if let [a, b] = ends.as_slice() {
                all.push(self.equal(IdentityKind::Corner, e, a.clone(), b.clone())?);
            }
        }
        Ok(())
    }

    fn reversal_identities(&self, e: usize, all: &mut Vec<Identity>) -> Result<(), ComplexError> {
        let f = self.reversals[&e].edge;
        let (own, other) = (&self.shape.states[e].pieces, &self.shape.states[f].pieces);
        if own.len() != other.len() {
            return Err(self.cell_error(e, "its reversal has another number of pieces".to_owned()));
        }
        for (letter, piece) in own.iter().enumerate() {
            let mirror = own.len() - 1 - letter;
            let right = (vec![OpName::Reverse(e), OpName::Piece { state: f, letter: mirror }], other[mirror].target);
            let mut left = (vec![OpName::Piece { state: e, letter }], piece.target);
            // Of two pieces that run the same way one has to be turned round.
            if piece.reversed == other[mirror].reversed {
                let Some(turn) = self.reversals.get(&piece.target) else {
                    let name = &self.shape.states[piece.target].name;
                    return Err(self.cell_error(e, format!("it has a reversal, but its piece `{name}` has none")));
                };
                left.0.push(OpName::Reverse(piece.target));
                left.1 = turn.edge;
            }
            all.push(self.equal(IdentityKind::Reversal, e, left, right)?);
        }
        for finish in [false, true] {
            if let (Some((mine, v)), Some((theirs, w))) = (self.end(e, finish), self.end(f, !finish)) {
                all.push(self.equal(
                    IdentityKind::Reversal,
                    e,
                    (vec![mine], v),
                    (vec![OpName::Reverse(e), theirs], w),
                )?);
            }
        }
        Ok(())
    }
}
