use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use thiserror::Error;

/// What a state of the automaton stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellKind {
    /// A point of the cell complex: one operator, its fixed point.
    Vertex,
    /// A curve: its pieces come in the order of the parameter.
    Edge,
    /// A compact set without an order of its pieces (a plain IFS).
    Set,
    /// A surface patch.
    Face,
}

/// The coordinates in which the case was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// Barycentric operators.
    Barycentric,
    /// Affine maps of `R^d`, read as operators on the simplex `0, e_1, …, e_d`; the control matrix leads back to `R^d`.
    Affine,
}

/// One piece of a state: `A_e` contains `op * A_target`.
#[derive(Debug, Clone)]
pub struct Piece<E = Rational> {
    /// Index of the state whose attractor is mapped.
    pub target: usize,
    /// The operator, `dim(e) x dim(target)`, every column summing to 1.
    pub op: Matrix<E>,
    /// Whether the piece runs against the parameter of `e` (edges only).
    pub reversed: bool,
    /// What the piece takes of the parameter of `e`; `None`: an equal part. Either all pieces of an edge have one, or none has.
    pub share: Option<Rational>,
}

/// A boundary operator `∂ : X_vertex -> X_edge`.
#[derive(Debug, Clone)]
pub struct Boundary<E = Rational> {
    /// Index of the vertex state.
    pub vertex: usize,
    /// The operator, `dim(edge) x dim(vertex)`, every column summing to 1.
    pub op: Matrix<E>,
}

/// A state (cell) of the automaton.
#[derive(Debug, Clone)]
pub struct State<E = Rational> {
    /// Its name in the case file.
    pub name: String,
    /// What it stands for.
    pub kind: CellKind,
    /// Number of barycentric coordinates.
    pub dim: usize,
    /// Its pieces, by letter; of an edge, in the order of the parameter.
    pub pieces: Vec<Piece<E>>,
    /// `∂_0`, where the case gives it.
    pub left: Option<Boundary<E>>,
    /// `∂_1`, where the case gives it.
    pub right: Option<Boundary<E>>,
}

impl<E> State<E> {
    /// What a piece takes of the parameter: its own share, or an equal part.
    ///
    /// # Panics
    /// Where there is no such piece.
    #[must_use]
    pub fn share(&self, letter: usize) -> Rational {
        match &self.pieces[letter].share {
            Some(share) => share.clone(),
            None => Rational::from(1) / Rational::from(self.pieces.len()),
        }
    }

    /// What the pieces before one take of the parameter.
    #[must_use]
    pub fn before(&self, letter: usize) -> Rational {
        (0..letter).fold(Rational::from(0), |sum, i| sum + self.share(i))
    }

    /// Whether shares, where there are any, are those of all pieces of a curve, positive and of sum 1.
    fn divides_parameter(&self) -> bool {
        let shares: Vec<&Rational> = self.pieces.iter().filter_map(|p| p.share.as_ref()).collect();
        let whole = || shares.iter().fold(Rational::from(0), |sum, s| sum + *s) == 1;
        let own = self.kind == CellKind::Edge && shares.len() == self.pieces.len();
        shares.is_empty() || own && shares.iter().all(|s| **s > 0) && whole()
    }
}

/// A self-similar shape: the attractors of an automaton of operators (theory §1), with entries in the rationals or in a real
/// number field.
#[derive(Debug, Clone)]
pub struct Shape<E = Rational> {
    /// The states.
    pub states: Vec<State<E>>,
    /// The state whose attractor is the shape.
    pub start: usize,
    /// Control points, `d x dim(start)`, one column each; `None`: the shape lies in barycentric space.
    pub control: Option<Matrix<E>>,
    /// How the case was written.
    pub frame: Frame,
}

/// Why a shape is not a model in the sense of theory §1.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A state without pieces.
    #[error("state `{state}` has no piece")]
    NoPiece {
        /// Index of the state's name.
        state: String,
    },
    /// An operator of the wrong size.
    #[error("the operator of piece {piece} of state `{state}` is {found:?}, but must be {expected:?} (rows, columns)")]
    Size {
        /// The state.
        state: String,
        /// The letter.
        piece: usize,
        /// Rows and columns found.
        found: (usize, usize),
        /// Rows and columns expected.
        expected: (usize, usize),
    },
    /// A piece of a curve that is no curve.
    #[error("piece {piece} of the edge state `{state}` is not an edge state")]
    Kind {
        /// The state.
        state: String,
        /// The letter.
        piece: usize,
    },
    /// A column that does not sum to 1.
    #[error("column {column} of the operator of piece {piece} of state `{state}` sums to {sum}, not to 1")]
    Sum {
        /// The state.
        state: String,
        /// The letter.
        piece: usize,
        /// The column, from 0.
        column: usize,
        /// Its sum.
        sum: String,
    },
    /// A control matrix that does not fit the start state.
    #[error("{found} control points are given, but state `{state}` has {expected} coordinates")]
    Control {
        /// The start state.
        state: String,
        /// Number of control points.
        found: usize,
        /// Number of coordinates.
        expected: usize,
    },
    /// Shares of the parameter that are no division of it.
    #[error("the shares of the pieces of state `{state}` must be positive and sum to 1, one for each piece of a curve")]
    Shares {
        /// The state.
        state: String,
        /// Its index.
        index: usize,
    },
    /// A boundary of the wrong size or with a column sum other than 1.
    #[error(
        "the {side} boundary of state `{state}` must be a {expected:?} matrix with column sums 1 from a vertex state"
    )]
    Boundary {
        /// The edge state.
        state: String,
        /// `left` or `right`.
        side: &'static str,
        /// Rows and columns expected.
        expected: (usize, usize),
    },
}

impl<E: Entry> Shape<E> {
    /// Checks sizes and column sums of all operators, boundaries and control points.
    ///
    /// # Errors
    /// The first [`ShapeError`] found, in the order of the states.
    pub fn check(&self) -> Result<(), ShapeError> {
        for (index, state) in self.states.iter().enumerate() {
            if state.pieces.is_empty() {
                return Err(ShapeError::NoPiece { state: state.name.clone() });
            }
            if !state.divides_parameter() {
                return Err(ShapeError::Shares { state: state.name.clone(), index });
            }
            for (letter, piece) in state.pieces.iter().enumerate() {
                self.check_operator(state, letter, piece)?;
            }
            for (side, boundary) in [("left", &state.left), ("right", &state.right)] {
                if let Some(b) = boundary {
                    let expected = (state.dim, self.states[b.vertex].dim);
                    let fits = (b.op.rows(), b.op.cols()) == expected
                        && first_bad_column(&b.op).is_none()
                        && self.states[b.vertex].kind == CellKind::Vertex;
                    if !fits {
                        return Err(ShapeError::Boundary { state: state.name.clone(), side, expected });
                    }
                }
            }
        }
        if let Some(control) = &self.control {
            let start = &self.states[self.start];
            if control.cols() != start.dim {
                let state = start.name.clone();
                return Err(ShapeError::Control { state, found: control.cols(), expected: start.dim });
            }
        }
        Ok(())
    }

    fn check_operator(&self, state: &State<E>, piece: usize, p: &Piece<E>) -> Result<(), ShapeError> {
        let (found, expected) = ((p.op.rows(), p.op.cols()), (state.dim, self.states[p.target].dim));
        if found != expected {
            return Err(ShapeError::Size { state: state.name.clone(), piece, found, expected });
        }
        if state.kind == CellKind::Edge && self.states[p.target].kind != CellKind::Edge {
            return Err(ShapeError::Kind { state: state.name.clone(), piece });
        }
        match first_bad_column(&p.op) {
            Some((column, sum)) => {
                let sum = sum.to_string();
                Err(ShapeError::Sum { state: state.name.clone(), piece, column, sum })
            }
            None => Ok(()),
        }
    }

    /// A shape with a single state.
    #[must_use]
    pub fn single(kind: CellKind, operators: Vec<Matrix<E>>) -> Self {
        let dim = operators.first().map_or(0, Matrix::rows);
        let pieces = operators.into_iter().map(|op| Piece { target: 0, op, reversed: false, share: None }).collect();
        let state = State { name: "A".to_owned(), kind, dim, pieces, left: None, right: None };
        Self { states: vec![state], start: 0, control: None, frame: Frame::Barycentric }
    }

    /// The operator on the simplex `0, e_1, …, e_d` of the affine map `x -> linear x + shift`.
    ///
    /// # Panics
    /// If `linear` is not square or `shift` has another length.
    #[must_use]
    pub fn affine_operator(linear: &Matrix<E>, shift: &[E]) -> Matrix<E> {
        let d = shift.len();
        assert_eq!((linear.rows(), linear.cols()), (d, d), "affine map");
        let image = |point: usize| -> Vec<E> {
            let mut x = shift.to_vec();
            if point > 0 {
                for (i, entry) in x.iter_mut().enumerate() {
                    *entry = entry.plus(&linear[(i, point - 1)]);
                }
            }
            let mut column = vec![E::integer(1).minus(&E::sum(x.iter()))];
            column.extend(x);
            column
        };
        Matrix::from_columns(d + 1, &(0..=d).map(image).collect::<Vec<_>>())
    }

    /// The control matrix `0, e_1, …, e_d` that leads from the simplex back to `R^d`.
    #[must_use]
    pub fn affine_control(d: usize) -> Matrix<E> {
        Matrix::from_fn(d, d + 1, |i, j| E::integer(i64::from(i + 1 == j)))
    }

    /// Whether some piece that can be reached has a share of the parameter of its own.
    #[must_use]
    pub fn has_shares(&self) -> bool {
        self.reachable().iter().any(|&e| self.states[e].pieces.iter().any(|p| p.share.is_some()))
    }

    /// States that can be reached from the start, in breadth-first order.
    #[must_use]
    pub fn reachable(&self) -> Vec<usize> {
        let mut order = vec![self.start];
        let mut next = 0;
        while next < order.len() {
            for piece in &self.states[order[next]].pieces {
                if !order.contains(&piece.target) {
                    order.push(piece.target);
                }
            }
            next += 1;
        }
        order
    }
}

/// All entries of the operators of pieces and of the control points.
pub fn entries<E: Clone>(shape: &Shape<E>) -> impl Iterator<Item = &E> {
    let ops = shape.states.iter().flat_map(|s| s.pieces.iter().map(|p| &p.op));
    ops.chain(&shape.control).flat_map(|m| m.entries())
}

fn first_bad_column<E: Entry>(op: &Matrix<E>) -> Option<(usize, E)> {
    (0..op.cols())
        .map(|j| (j, (0..op.rows()).fold(E::zero(), |s, i| s.plus(&op[(i, j)]))))
        .find(|(_, sum)| *sum != E::integer(1))
}
