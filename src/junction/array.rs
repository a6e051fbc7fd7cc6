//! All curves between two schemes: one array of stencils whose windows are the operators.

use super::{JunctionError, MAX_ROWS, Side, row_text};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, Frame, Piece, Shape, State};
use std::fmt;

/// `I -> a^left I b^right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pattern {
    /// How many copies of the first scheme come before.
    pub left: usize,
    /// How many copies of the second scheme come behind.
    pub right: usize,
}

impl Pattern {
    /// Reads `a,I,b`.
    ///
    /// # Errors
    /// [`JunctionError::Pattern`].
    ///
    /// # Examples
    /// ```
    /// use secant::junction::Pattern;
    /// assert_eq!(Pattern::parse("a, a, I, b")?, Pattern { left: 2, right: 1 });
    /// assert!(Pattern::parse("b,I").is_err());
    /// # Ok::<(), secant::junction::JunctionError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, JunctionError> {
        let wrong = || JunctionError::Pattern(text.to_owned());
        let letters: Vec<&str> = text.split(',').map(str::trim).collect();
        let left = letters.iter().take_while(|l| **l == "a").count();
        let rest = &letters[left..];
        let right = rest.iter().skip(1).filter(|l| **l == "b").count();
        let fits = rest.first() == Some(&"I") && right + 1 == rest.len() && left + right > 0;
        if fits { Ok(Self { left, right }) } else { Err(wrong()) }
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = vec!["a"; self.left].into_iter().chain(["I"]).chain(vec!["b"; self.right]);
        f.write_str(&letters.collect::<Vec<_>>().join(","))
    }
}

/// Two schemes, a pattern and a number of points: the family of all intermediate curves.
#[derive(Debug, Clone)]
pub struct Junction {
    /// The scheme `a`.
    pub left: Side,
    /// The scheme `b`.
    pub right: Side,
    /// The pieces of the intermediate curve.
    pub pattern: Pattern,
    /// Its number of points.
    pub points: usize,
}

impl Junction {
    /// The family; its numbers are checked, and that forced rows which overlap agree.
    ///
    /// # Errors
    /// [`JunctionError::Points`], [`JunctionError::Contradiction`], [`JunctionError::Large`].
    pub fn new(left: Side, right: Side, pattern: Pattern, points: usize) -> Result<Self, JunctionError> {
        let least = left.shared.max(right.shared).max(2);
        if points < least {
            return Err(JunctionError::Points { points, least });
        }
        let junction = Self { left, right, pattern, points };
        if junction.rows() > MAX_ROWS {
            return Err(JunctionError::Large(junction.rows()));
        }
        junction.forced()?;
        Ok(junction)
    }

    /// The number of new points: the rows of the array.
    #[must_use]
    pub fn rows(&self) -> usize {
        let (a, b) = (&self.left, &self.right);
        self.pattern.left * (a.points() - a.shared) + self.points + self.pattern.right * (b.points() - b.shared)
    }

    /// The rows that the two schemes force; `None` for those that are free.
    ///
    /// # Errors
    /// [`JunctionError::Contradiction`] where both schemes force a row, and differently.
    pub fn forced(&self) -> Result<Vec<Option<Vec<Rational>>>, JunctionError> {
        let total = self.rows();
        let mut rows: Vec<Option<Vec<Rational>>> = vec![None; total];
        let placed = |rule: &Matrix, i: usize, at: usize| {
            let mut row = vec![Rational::from(0); self.points];
            row[at..at + rule.cols()].clone_from_slice(rule.row(i));
            row
        };
        let (first, last) = (self.left.vertex(), self.right.vertex());
        for (i, row) in rows.iter_mut().enumerate().take(first.rows()) {
            *row = Some(placed(&first, i, 0));
        }
        for i in 0..last.rows() {
            let new = placed(&last, i, self.points - last.rows());
            let row = total - last.rows() + i;
            match &rows[row] {
                Some(old) if *old != new => {
                    let (left, right) = (row_text(old), row_text(&new));
                    return Err(JunctionError::Contradiction { row, left, right });
                }
                _ => rows[row] = Some(new),
            }
        }
        Ok(rows)
    }

    /// The number of free rows.
    #[must_use]
    pub fn free(&self) -> usize {
        self.rows().saturating_sub(self.left.shared + self.right.shared)
    }

    /// The array with the given free rows, from the first to the last.
    ///
    /// # Errors
    /// [`JunctionError::Rows`] for another number of rows, another length, or a sum other than 1.
    pub fn array(&self, free: &[Vec<Rational>]) -> Result<Matrix, JunctionError> {
        if free.len() != self.free() {
            let text = format!("{} rows are free, but {} are given", self.free(), free.len());
            return Err(JunctionError::Rows(text));
        }
        for (k, row) in free.iter().enumerate() {
            let sum = row.iter().fold(Rational::from(0), |s, x| s + x);
            if row.len() != self.points || sum != 1 {
                let (found, wanted) = (row.len(), self.points);
                let text =
                    format!("free row {k} has {found} entries of sum {sum}; {wanted} entries of sum 1 are needed");
                return Err(JunctionError::Rows(text));
            }
        }
        let mut next = free.iter();
        let rows = self.forced()?.into_iter().map(|row| row.or_else(|| next.next().cloned()));
        let rows: Option<Vec<_>> = rows.collect();
        let rows = rows.ok_or_else(|| JunctionError::Rows("there are fewer free rows than open places".to_owned()))?;
        Ok(Matrix::from_rows(self.points, rows))
    }

    /// The first row and the number of rows of the window of each piece.
    #[must_use]
    pub fn windows(&self) -> Vec<(usize, usize)> {
        let (a, b) = (&self.left, &self.right);
        let own = self.pattern.left * (a.points() - a.shared);
        let before = (0..self.pattern.left).map(|j| (j * (a.points() - a.shared), a.points()));
        let first = own + self.points - b.shared;
        let behind = (0..self.pattern.right).map(|j| (first + j * (b.points() - b.shared), b.points()));
        before.chain([(own, self.points)]).chain(behind).collect()
    }

    /// The operators of the intermediate curve: the transposed windows of an array.
    #[must_use]
    pub fn operators(&self, array: &Matrix) -> Vec<Matrix> {
        let window =
            |(start, len): (usize, usize)| Matrix::from_fn(self.points, len, |i, j| array[(start + j, i)].clone());
        self.windows().into_iter().map(window).collect()
    }

    /// The operator of the one piece `I -> I`.
    #[must_use]
    pub fn own(&self, array: &Matrix) -> Matrix {
        self.operators(array).swap_remove(self.pattern.left)
    }

    /// The joined shape: a start state `W` with pieces `a`, `I`, `b` on shared points, all with their vertices.
    #[must_use]
    pub fn complex(&self, array: &Matrix) -> Complex {
        let (a, b) = (&self.left, &self.right);
        let shared = a.points() - a.shared;
        let size = shared + self.points + b.points() - b.shared;
        let select = |from: usize, len: usize| inclusion(size, from, len);
        let joined = [
            (2, select(0, a.points())),
            (1, select(shared, self.points)),
            (3, select(shared + self.points - b.shared, b.points())),
        ];
        let whole = State {
            name: "W".to_owned(),
            kind: CellKind::Edge,
            dim: size,
            pieces: joined.into_iter().map(|(target, op)| Piece { target, op, reversed: false, share: None }).collect(),
            left: None,
            right: None,
        };
        let targets = (0..self.pattern.left).map(|_| 2).chain([1]).chain((0..self.pattern.right).map(|_| 3));
        let pieces =
            targets.zip(self.operators(array)).map(|(target, op)| Piece { target, op, reversed: false, share: None });
        let between = State {
            name: "I".to_owned(),
            kind: CellKind::Edge,
            dim: self.points,
            pieces: pieces.collect(),
            left: Some(Boundary { vertex: 4, op: inclusion(self.points, 0, a.shared) }),
            right: Some(Boundary { vertex: 5, op: inclusion(self.points, self.points - b.shared, b.shared) }),
        };
        let states =
            vec![whole, between, curve("a", a, 2, 4), curve("b", b, 3, 5), vertex("u", a, 4), vertex("v", b, 5)];
        Complex::of_curves(Shape { states, start: 0, control: None, frame: Frame::Barycentric })
    }
}

/// The coordinates `from … from + len − 1` of `size`.
pub(super) fn inclusion(size: usize, from: usize, len: usize) -> Matrix {
    Matrix::from_fn(size, len, |i, j| Rational::from(u8::from(i == from + j)))
}

pub(super) fn curve(name: &str, side: &Side, index: usize, vertex: usize) -> State {
    let n = side.points();
    let share = |i: usize| side.shares.as_ref().map(|all| all[i].clone());
    let pieces = side.operators.iter().zip(&side.reversed).enumerate();
    State {
        name: name.to_owned(),
        kind: CellKind::Edge,
        dim: n,
        pieces: pieces
            .map(|(i, (op, r))| Piece { target: index, op: op.clone(), reversed: *r, share: share(i) })
            .collect(),
        left: Some(Boundary { vertex, op: inclusion(n, 0, side.shared) }),
        right: Some(Boundary { vertex, op: inclusion(n, n - side.shared, side.shared) }),
    }
}

pub(super) fn vertex(name: &str, side: &Side, index: usize) -> State {
    let op = side.vertex().transpose();
    let pieces = vec![Piece { target: index, op, reversed: false, share: None }];
    State { name: name.to_owned(), kind: CellKind::Vertex, dim: side.shared, pieces, left: None, right: None }
}
