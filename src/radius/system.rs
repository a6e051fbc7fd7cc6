use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use thiserror::Error;

/// One matrix of a system: it maps the space of `to` into the space of `from`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arrow<E = Rational> {
    /// The state in whose space the values lie.
    pub from: usize,
    /// The state whose space is mapped.
    pub to: usize,
    /// The matrix, `dim(from) x dim(to)`.
    pub matrix: Matrix<E>,
    /// The number by which words name this arrow.
    pub label: usize,
}

/// A finite set of matrices, or an automaton of them: a word is a path of arrows, its matrix the product from left to right.
///
/// A plain set of matrices is one state with a loop for every matrix.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct System<E = Rational> {
    /// Dimension of the space of every state.
    pub dims: Vec<usize>,
    /// The arrows.
    pub arrows: Vec<Arrow<E>>,
}

/// Why matrices are not a system.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SystemError {
    /// No matrix at all.
    #[error("a joint spectral radius needs at least one matrix")]
    Empty,
    /// A matrix that does not fit its states.
    #[error("matrix {arrow} is {found:?}, but must be {expected:?} (rows, columns)")]
    Size {
        /// The arrow, from 0.
        arrow: usize,
        /// Rows and columns found.
        found: (usize, usize),
        /// Rows and columns expected.
        expected: (usize, usize),
    },
    /// A state that does not exist.
    #[error("matrix {arrow} names state {state}, but there are only {count}")]
    State {
        /// The arrow, from 0.
        arrow: usize,
        /// The state named.
        state: usize,
        /// Number of states.
        count: usize,
    },
}

impl<E: Entry> System<E> {
    /// The system of a finite set of square matrices.
    ///
    /// # Errors
    /// [`SystemError`] for an empty set, or matrices that are not square of one size.
    pub fn plain(matrices: &[Matrix<E>]) -> Result<Self, SystemError> {
        let dim = matrices.first().ok_or(SystemError::Empty)?.rows();
        let arrows = matrices.iter().enumerate();
        let arrows = arrows.map(|(label, m)| Arrow { from: 0, to: 0, matrix: m.clone(), label }).collect();
        Self { dims: vec![dim], arrows }.checked()
    }

    /// The same system, if the sizes fit.
    ///
    /// # Errors
    /// The first [`SystemError`].
    pub fn checked(self) -> Result<Self, SystemError> {
        if self.arrows.is_empty() {
            return Err(SystemError::Empty);
        }
        let count = self.dims.len();
        for (arrow, a) in self.arrows.iter().enumerate() {
            if let Some(&state) = [a.from, a.to].iter().find(|s| **s >= count) {
                return Err(SystemError::State { arrow, state, count });
            }
            let (found, expected) = ((a.matrix.rows(), a.matrix.cols()), (self.dims[a.from], self.dims[a.to]));
            if found != expected {
                return Err(SystemError::Size { arrow, found, expected });
            }
        }
        Ok(self)
    }

    /// The product of the arrows at these positions.
    ///
    /// # Panics
    /// If the arrows do not form a path, or the path is empty.
    #[must_use]
    pub fn product(&self, path: &[usize]) -> Matrix<E> {
        let mut product = self.arrows[path[0]].matrix.clone();
        for &a in &path[1..] {
            product = &product * &self.arrows[a].matrix;
        }
        product
    }

    /// The transposed matrices with the arrows turned round. Its words are the reversed ones, their products the transposes:
    /// the joint spectral radius is the same.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let turned = |a: &Arrow<E>| Arrow { from: a.to, to: a.from, matrix: a.matrix.transpose(), label: a.label };
        Self { dims: self.dims.clone(), arrows: self.arrows.iter().map(turned).collect() }
    }

    /// Whether every entry of every matrix is nonnegative.
    #[must_use]
    pub fn is_nonnegative(&self) -> bool {
        self.arrows.iter().all(|a| (0..a.matrix.rows()).all(|i| a.matrix.row(i).iter().all(|x| x.sign() >= 0)))
    }

    /// The dimension of the largest space, at least 1: for budgets.
    #[must_use]
    pub(super) fn widest(&self) -> usize {
        self.dims.iter().fold(1, |widest, d| widest.max(*d))
    }

    /// The labels along a path of positions.
    #[must_use]
    pub fn labels(&self, path: &[usize]) -> Vec<usize> {
        path.iter().map(|&a| self.arrows[a].label).collect()
    }
}
