//! Case files: TOML in, a checked [`Shape`] and what is asked about it out.
//!
//! The format is described in `docs/case-format.md`. Every mistake is a [`Problem`] with the line where it is.

mod asked;
mod border;
mod chain;
mod control;
mod curve_family;
mod expect;
mod faces;
mod field;
mod free;
mod interpolate;
mod lattice;
mod maps;
mod matrix;
pub mod matrix_file;
mod member;
mod node;
mod own;
mod parameters;
mod plane_family;
mod question;
mod read;
mod schema;
mod scheme;
mod source;
mod states;
mod symmetry;
mod vertex;
mod vertex_family;

pub use asked::{asked, is_case, nothing, unaliased, written};
pub use border::BorderCase;
pub use control::with_control;
pub use curve_family::{CurveFamilyCase, FamilyForm};
pub use expect::{Expect, ExpectForced, ExpectPoint, ExpectSolve, expected_error};
pub use field::is_over_field;
pub use lattice::LatticeCase;
pub use member::{member_text, valued};
pub use parameters::{MaskFamilyCase, Setting, named_family, setting};
pub use plane_family::PlaneFamilyCase;
pub use question::{Question, Subject};
pub use schema::schema;
pub use vertex::{Valences, VertexCase};
pub use vertex_family::VertexFamilyCase;

use crate::arith::Rational;
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Entry;
use crate::scheme::{Heading, Interpolation, Mask, MeshRule, Normalisation, case_text, complex_text};
use crate::shape::{self, Address, Complex, Face, OpName, Reversal, Shape, UnknownError};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// Largest case file that is read, in bytes.
pub const MAX_BYTES: usize = 4 << 20;
/// Largest number of states.
pub const MAX_STATES: usize = 64;
/// Largest number of pieces of a state.
pub const MAX_PIECES: usize = 64;
/// Largest number of barycentric coordinates of a state, and of coordinates of a control point.
pub const MAX_COORDINATES: usize = 96;
/// Largest number of addresses to examine.
pub const MAX_ADDRESSES: usize = 256;
/// Longest address to examine, in letters.
pub const MAX_LETTERS: usize = 1_000;
/// Largest size of all numbers of a file together, in bits (it keeps `1e9999` in every entry from filling the memory).
pub const MAX_BITS: u64 = 1 << 25;

/// How the matrices of a case act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// Operators on columns of barycentric coordinates; columns sum to 1.
    Columns,
    /// Subdivision matrices on rows of control points; rows sum to 1. They are transposed on reading.
    Rows,
    /// Affine maps `x -> linear x + shift`.
    Affine,
}

impl Convention {
    /// The word in the case file (`affine` is implied by `[[map]]`).
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Columns => "columns",
            Self::Rows => "rows",
            Self::Affine => "affine",
        }
    }
}

/// A case file, read and checked; with entries in a real number field it is a `Case<Real>` ([`Case::over_field`]).
#[derive(Debug, Clone)]
pub struct Case<E = Rational> {
    /// The name, made of letters, digits, `-`, `_` and `.`.
    pub name: String,
    /// One line for people; the name where the file has none.
    pub title: String,
    /// Where the shape and the claim come from.
    pub source: Option<String>,
    /// How the matrices were written.
    pub convention: Convention,
    /// The shape. Sizes and column sums are checked; adjacency is not (the engine does that).
    pub shape: Shape<E>,
    /// Boundaries of the face states, by index of the state; their identities hold.
    pub faces: BTreeMap<usize, Face>,
    /// Reversals of edge states, by index of the state.
    pub reversals: BTreeMap<usize, Reversal>,
    /// The scheme that the case names under `[scheme]`.
    pub scheme: Option<Origin>,
    /// The normalisation in which a filter was read, where it is not the one that it names.
    pub taken: Option<Normalisation>,
    /// The values of the roots and cosines in the text that a checker reads; `None` where one does not lie in the field of the
    /// entries.
    pub numbers: Option<Vec<E>>,
    /// Over a number field: the case with its operators written out over the generator of the field, where a checker reads this
    /// text and not the file.
    pub flat: Option<String>,
    /// Entries left open (`"?"`); none but in what [`Case::read_open`] gives.
    pub unknown: Vec<Unknown>,
    /// Further points to examine, as written; every letter exists.
    pub examine: Vec<Address>,
    /// What a test expects.
    pub expect: Option<Expect>,
    /// The file, for diagnostics and digests.
    pub text: SourceText,
    places: Places,
}

impl<E> Case<E> {
    /// The same case about a shape with other entries; what a scheme was built from is not kept.
    fn with_shape<F>(&self, shape: Shape<F>) -> Case<F> {
        Case {
            name: self.name.clone(),
            title: self.title.clone(),
            source: self.source.clone(),
            convention: self.convention,
            shape,
            faces: self.faces.clone(),
            reversals: self.reversals.clone(),
            scheme: None,
            taken: self.taken,
            numbers: Some(Vec::new()),
            flat: None,
            unknown: self.unknown.clone(),
            examine: self.examine.clone(),
            expect: self.expect.clone(),
            text: self.text.clone(),
            places: self.places.clone(),
        }
    }
}

/// What a case with `[scheme]` was built from.
#[derive(Debug, Clone)]
pub enum Origin {
    /// A scheme of [`crate::scheme::list`] that has no mask, by its name.
    Named(String),
    /// A univariate mask, given or named.
    Mask(Mask),
    /// The mask of a filter whose sums are not those of the normalisation that it names, but those of this one, which was taken.
    Filter(Mask, Normalisation),
    /// A polygon of control points, a curve of several spans; with its mask where the spans are those of one.
    Polygon(Option<Mask>),
    /// The tensor product of two curves.
    Tensor,
    /// Data that are interpolated.
    Interpolation(Box<Interpolation>),
    /// The product of two functions that interpolate data.
    Graphs,
    /// A set some of whose maps are symmetries, written out with the others.
    Symmetric {
        /// Which of the maps are symmetries.
        maps: Vec<usize>,
        /// The number of elements of their group.
        group: usize,
    },
    /// An automaton, some of whose states name a scheme or are chains.
    States,
    /// A mask in two variables.
    Lattice,
    /// The neighbourhood of a vertex of a mesh.
    Mesh {
        /// The rule.
        rule: MeshRule,
        /// The valence of the vertex.
        valence: usize,
        /// Whether the shape is the whole disc around the vertex; else one patch at it.
        disc: bool,
    },
}

/// An entry of an operator that the file leaves open.
#[derive(Debug, Clone)]
pub struct Unknown {
    /// The operator.
    pub op: OpName,
    /// Row of the operator on columns.
    pub row: usize,
    /// Its column.
    pub column: usize,
    /// The name; entries of one name are equal.
    pub name: Option<String>,
    span: Range<usize>,
}

/// A shape as it was read.
struct Model {
    complex: Complex,
    places: Places,
    unknown: Vec<Unknown>,
    scheme: Option<Origin>,
}

/// Where things stand in the file.
#[derive(Debug, Clone, Default)]
struct Places {
    states: Vec<StatePlace>,
    control: Option<Range<usize>>,
}

#[derive(Debug, Clone, Default)]
struct StatePlace {
    name: Range<usize>,
    pieces: Vec<Range<usize>>,
    left: Option<Range<usize>>,
    right: Option<Range<usize>>,
    sides: Vec<Range<usize>>,
    reversal: Option<Range<usize>>,
}

impl Places {
    fn of(&self, op: OpName) -> Option<&Range<usize>> {
        match op {
            OpName::Piece { state, letter } => self.states.get(state)?.pieces.get(letter),
            OpName::Left(state) => self.states.get(state)?.left.as_ref(),
            OpName::Right(state) => self.states.get(state)?.right.as_ref(),
            OpName::Side { state, side } => self.states.get(state)?.sides.get(side),
            OpName::Reverse(state) => self.states.get(state)?.reversal.as_ref(),
        }
    }
}

impl Case {
    /// The shape with the boundaries of its faces and its reversals.
    #[must_use]
    pub fn complex(&self) -> Complex {
        Complex { shape: self.shape.clone(), faces: self.faces.clone(), reversals: self.reversals.clone() }
    }

    /// States that nothing leads to: neither a piece of a state that the start reaches, nor a boundary or reversal of one.
    #[must_use]
    pub fn dangling(&self) -> Vec<usize> {
        if !matches!(self.scheme, None | Some(Origin::States)) {
            return Vec::new();
        }
        let mut reached = vec![self.shape.start];
        let mut next = 0;
        while let Some(&e) = reached.get(next) {
            let state = &self.shape.states[e];
            let boundaries = [&state.left, &state.right].into_iter().flatten().map(|b| b.vertex);
            let sides = self.faces.get(&e).into_iter().flat_map(|f| f.sides.iter().map(|s| s.edge));
            let reversal = self.reversals.get(&e).map(|r| r.edge);
            let all: Vec<usize> =
                state.pieces.iter().map(|p| p.target).chain(boundaries).chain(sides).chain(reversal).collect();
            for target in all {
                if !reached.contains(&target) {
                    reached.push(target);
                }
            }
            next += 1;
        }
        (0..self.shape.states.len()).filter(|e| !reached.contains(e)).collect()
    }

    /// The identities of the case with its open entries as unknowns.
    ///
    /// # Errors
    /// [`UnknownError::Many`].
    pub fn unknowns(&self) -> Result<shape::Problem, UnknownError> {
        let mut problem = shape::Problem::new(self.complex());
        for u in &self.unknown {
            problem.unknown(u.op, u.row, u.column, u.name.as_deref())?;
        }
        Ok(problem)
    }

    /// The case with every operator written out, without `[scheme]`: what the checker reads. It has the name, the shape, the
    /// control points and the points to examine, but no expectations.
    #[must_use]
    pub fn expanded(&self) -> String {
        self.written_with(&self.complex())
    }

    /// As [`Case::expanded`], with other operators, such as those of a solution.
    #[must_use]
    pub fn written_with(&self, complex: &Complex) -> String {
        complex_text(complex, &self.heading())
    }

    /// The text that a checker reads: the file itself, or [`Case::beside`].
    #[must_use]
    pub fn checked_text(&self) -> Cow<'_, str> {
        match self.beside() {
            Some(expanded) => Cow::Owned(expanded),
            None => Cow::Borrowed(&self.text.text),
        }
    }

    /// [`Case::expanded`], where the case has a `[scheme]` on a mesh, a polygon of several spans, a product of functions that interpolate,
    /// or states that name schemes or are chains, which the checker does not build; the text of a member of a case with parameters: a
    /// certificate is about this text,
    /// and it is written beside it.
    #[must_use]
    pub fn beside(&self) -> Option<String> {
        let built = matches!(
            self.scheme,
            Some(Origin::Mesh { .. } | Origin::Lattice | Origin::Polygon(_) | Origin::Graphs | Origin::States)
        );
        let member = member::is_member(&self.text.text);
        (built || member).then(|| if built { self.expanded() } else { self.text.text.to_string() })
    }
}

impl<E: Entry> Case<E> {
    /// The case with every operator written out, as [`Case::expanded`] of a curve or a set.
    fn flat_text(&self) -> String {
        case_text(&self.shape, &self.heading())
    }
}

impl<E> Case<E> {
    fn heading(&self) -> Heading {
        Heading {
            name: self.name.clone(),
            title: if self.title == self.name { String::new() } else { self.title.clone() },
            source: self.source.clone().unwrap_or_default(),
            examine: self.examine.clone(),
        }
    }

    /// The mask that `[scheme]` was understood to give.
    #[must_use]
    pub fn mask(&self) -> Option<&Mask> {
        match &self.scheme {
            Some(Origin::Mask(mask) | Origin::Filter(mask, _) | Origin::Polygon(Some(mask))) => Some(mask),
            _ => None,
        }
    }

    /// A problem of one operator, shown at its matrix in the file.
    #[must_use]
    pub fn problem_at_operator(&self, op: OpName, code: &str, message: &str, help: &str) -> Problem {
        self.problem(self.places.of(op), "this operator", code, message, help)
    }

    /// A problem of an entry left open, shown where it stands.
    #[must_use]
    pub fn problem_at_unknown(&self, unknown: &Unknown, code: &str, message: &str, help: &str) -> Problem {
        self.problem(Some(&unknown.span), "unknown", code, message, help)
    }

    /// A problem of one piece of a state, shown at its matrix (or map) in the file.
    ///
    /// Indices that do not exist give a problem without a place.
    #[must_use]
    pub fn problem_at_piece(&self, state: usize, piece: usize, code: &str, message: &str, help: &str) -> Problem {
        let span = self.places.states.get(state).and_then(|s| s.pieces.get(piece));
        self.problem(span, &format!("piece {piece}"), code, message, help)
    }

    /// A problem of two neighbouring pieces of a state, `piece` and `piece + 1`, shown at both.
    #[must_use]
    pub fn problem_at_joint(&self, state: usize, piece: usize, code: &str, message: &str, help: &str) -> Problem {
        let problem = self.problem_at_piece(state, piece, code, message, help);
        match self.places.states.get(state).and_then(|s| s.pieces.get(piece + 1)) {
            Some(next) => problem.with_label(next.clone(), format!("piece {}", piece + 1)),
            None => problem,
        }
    }

    /// A problem of a whole state, shown at its name.
    #[must_use]
    pub fn problem_at_state(&self, state: usize, code: &str, message: &str, help: &str) -> Problem {
        self.problem(self.places.states.get(state).map(|s| &s.name), "this state", code, message, help)
    }

    /// A problem of a boundary (`right` or left) of a state, shown at its matrix.
    #[must_use]
    pub fn problem_at_boundary(&self, state: usize, right: bool, code: &str, message: &str, help: &str) -> Problem {
        let place = self.places.states.get(state);
        let span = place.and_then(|s| if right { s.right.as_ref() } else { s.left.as_ref() });
        self.problem(span.or(place.map(|s| &s.name)), "this boundary", code, message, help)
    }

    /// A problem of the control points, shown at their list.
    #[must_use]
    pub fn problem_at_control(&self, code: &str, message: &str, help: &str) -> Problem {
        self.problem(self.places.control.as_ref(), "these control points", code, message, help)
    }

    fn problem(&self, span: Option<&Range<usize>>, note: &str, code: &str, message: &str, help: &str) -> Problem {
        let problem = Problem::new(code, message).with_help(help).with_source(&self.text);
        match span {
            Some(span) => problem.with_label(span.clone(), note),
            None => problem,
        }
    }
}
