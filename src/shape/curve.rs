//! End points of curves, which pieces meet, and the identities of a cell (theory §1, §3).

use super::{Address, CellKind, Piece, Shape, Spaces};
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use thiserror::Error;

/// Letters after which the expansion of a parameter is given up.
const MAX_EXPANSION: usize = 1_000;

/// An end of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// Where the parameter begins.
    Start,
    /// Where it ends.
    Finish,
}

impl End {
    /// The other end.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Start => Self::Finish,
            Self::Finish => Self::Start,
        }
    }

    /// The end of a piece that lies at this end of its state.
    #[must_use]
    pub fn in_piece<E>(self, piece: &Piece<E>) -> Self {
        if piece.reversed { self.other() } else { self }
    }
}

/// Why the pieces of a curve do not make a curve.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CurveError {
    /// Two neighbouring pieces do not meet.
    #[error("piece {piece} of state `{state}` begins at {begins:?}, but the piece before it ends at {ends:?}")]
    Apart {
        /// Name of the state.
        state: String,
        /// Index of the state.
        index: usize,
        /// The piece that begins elsewhere.
        piece: usize,
        /// Where the piece before ends.
        ends: Vec<String>,
        /// Where it begins.
        begins: Vec<String>,
    },
    /// An end of a piece is not one point.
    #[error(
        "an end of piece {piece} of state `{state}` is not one point: a fixed point is not unique, or nothing leads to it"
    )]
    NoEnd {
        /// Name of the state.
        state: String,
        /// Index of the state.
        index: usize,
        /// The piece.
        piece: usize,
    },
    /// A boundary identity fails.
    #[error(
        "state `{state}`: the identity {identity} fails; entry ({row}, {column}) of the left side minus the right side is {residual}"
    )]
    Identity {
        /// Name of the state.
        state: String,
        /// Index of the state.
        index: usize,
        /// The piece whose operator is concerned.
        piece: usize,
        /// The identity in words.
        identity: String,
        /// Row of the first entry that differs.
        row: usize,
        /// Its column.
        column: usize,
        /// The difference.
        residual: String,
    },
}

impl<E: Entry> Shape<E> {
    /// Whether a piece is a single point.
    #[must_use]
    pub fn is_point(&self, spaces: &Spaces<E>, piece: &Piece<E>) -> bool {
        (&piece.op * &spaces.of(piece.target).basis).is_zero()
    }

    /// The address of an end of the curve of a state, through its outermost pieces for which `skip` is false.
    ///
    /// Returns `None` for a state where all pieces are skipped.
    pub fn end_address(&self, state: usize, end: End, mut skip: impl FnMut(&Piece<E>) -> bool) -> Option<Address> {
        let mut seen: Vec<(usize, End)> = Vec::new();
        let mut letters = Vec::new();
        let (mut at, mut side) = (state, end);
        loop {
            if let Some(k) = seen.iter().position(|s| *s == (at, side)) {
                return Some(Address { prefix: letters[..k].to_vec(), cycle: letters[k..].to_vec() });
            }
            seen.push((at, side));
            let pieces = &self.states[at].pieces;
            let letter = match side {
                End::Start => (0..pieces.len()).find(|&i| !skip(&pieces[i]))?,
                End::Finish => (0..pieces.len()).rev().find(|&i| !skip(&pieces[i]))?,
            };
            letters.push(letter);
            side = side.in_piece(&pieces[letter]);
            at = pieces[letter].target;
        }
    }

    /// The address of a parameter of the curve of a state, of which the pieces take their shares; `None` where the parameter is not between 0 and 1, or a state on the way is no curve.
    #[must_use]
    pub fn address_of(&self, state: usize, parameter: &Rational) -> Option<Address> {
        if *parameter < 0 || *parameter > 1 {
            return None;
        }
        let (mut at, mut t, mut word) = (state, parameter.clone(), Vec::new());
        let mut seen: Vec<(usize, Rational)> = Vec::new();
        while word.len() <= MAX_EXPANSION {
            if let Some(from) = seen.iter().position(|(e, x)| *e == at && *x == t) {
                return Some(Address { prefix: word[..from].to_vec(), cycle: word[from..].to_vec() });
            }
            seen.push((at, t.clone()));
            let state = self.states.get(at).filter(|s| s.kind == CellKind::Edge)?;
            let letter = (0..state.pieces.len()).rev().find(|k| t >= state.before(*k))?;
            t = (t - state.before(letter)) / state.share(letter);
            if state.pieces[letter].reversed {
                t = Rational::from(1) - t;
            }
            word.push(letter);
            at = state.pieces[letter].target;
        }
        None
    }

    /// The map `t ↦ slope t + offset` of parameters that belongs to a word, whose pieces take their shares; `None` where a state on
    /// the way is no curve, or has no such piece.
    #[must_use]
    pub fn parameter_map(&self, start: usize, word: &[usize]) -> Option<(Rational, Rational)> {
        let (mut slope, mut offset, mut at) = (Rational::from(1), Rational::from(0), start);
        for letter in word {
            let state = self.states.get(at).filter(|s| s.kind == CellKind::Edge)?;
            let piece = state.pieces.get(*letter)?;
            let part = state.share(*letter);
            offset += &slope * state.before(letter + usize::from(piece.reversed));
            slope *= if piece.reversed { -part } else { part };
            at = piece.target;
        }
        Some((slope, offset))
    }

    /// An end point of the curve of a state.
    #[must_use]
    pub fn end_point(&self, state: usize, end: End) -> Option<Vec<E>> {
        self.point(state, &self.end_address(state, end, |_| false)?)
    }

    /// Points of a state with known addresses: its end points and the one reached by letter 0, or, where the state is no
    /// curve, those reached by one letter.
    #[must_use]
    pub fn landmarks(&self, state: usize) -> Vec<Address> {
        if self.states[state].kind == CellKind::Edge {
            let ends = [End::Start, End::Finish].into_iter();
            return ends.filter_map(|end| self.end_address(state, end, |_| false)).collect();
        }
        (0..self.states[state].pieces.len())
            .filter_map(|i| {
                let target = self.states[state].pieces[i].target;
                let mut address = Address::periodic(vec![0]).normalise(self, target).ok()?;
                if target == state {
                    address = Address::periodic(vec![i]);
                } else {
                    address.prefix.insert(0, i);
                }
                Some(address)
            })
            .collect()
    }

    /// Checks that each piece of every reachable edge state begins where the one before ends, and all identities of the
    /// boundaries that the case gives (theory §1).
    ///
    /// # Errors
    /// The first [`CurveError`].
    pub fn check_curves(&self) -> Result<(), CurveError> {
        for e in self.reachable() {
            if self.states[e].kind != CellKind::Edge {
                continue;
            }
            self.check_identities(e)?;
            let pieces = &self.states[e].pieces;
            let outer = |piece: usize, end: End| {
                let p = &pieces[piece];
                let point = self.end_point(p.target, end.in_piece(p)).map(|x| p.op.apply(&x));
                point.ok_or_else(|| CurveError::NoEnd { state: self.states[e].name.clone(), index: e, piece })
            };
            for k in 0..pieces.len() - 1 {
                let (ends, begins) = (outer(k, End::Finish)?, outer(k + 1, End::Start)?);
                if ends != begins {
                    let state = self.states[e].name.clone();
                    let text = |x: Vec<E>| x.iter().map(ToString::to_string).collect();
                    let (ends, begins) = (text(ends), text(begins));
                    return Err(CurveError::Apart { state, index: e, piece: k + 1, ends, begins });
                }
            }
        }
        Ok(())
    }

    /// Boundary operator of a state at an end, where given.
    fn boundary(&self, state: usize, end: End) -> Option<&super::Boundary<E>> {
        match end {
            End::Start => self.states[state].left.as_ref(),
            End::Finish => self.states[state].right.as_ref(),
        }
    }

    fn check_identities(&self, e: usize) -> Result<(), CurveError> {
        let state = &self.states[e];
        let last = state.pieces.len() - 1;
        for (end, k, letter) in [(End::Start, 0, 0), (End::Finish, 1, last)] {
            let piece = &state.pieces[letter];
            let (Some(outer), Some(inner)) = (self.boundary(e, end), self.boundary(piece.target, end.in_piece(piece)))
            else {
                continue;
            };
            // An incidence identity needs the vertex's own operator, and both boundaries from the same vertex.
            let vertex = &self.states[outer.vertex];
            if vertex.pieces.len() != 1 || vertex.pieces[0].target != inner.vertex {
                continue;
            }
            let identity = format!("∂_{k} T_v = T_{letter} ∂ (incidence)");
            self.compare(e, letter, identity, &(&outer.op * &vertex.pieces[0].op), &(&piece.op * &inner.op))?;
        }
        for j in 1..=last {
            let (before, after) = (&state.pieces[j - 1], &state.pieces[j]);
            let ends = self.boundary(before.target, End::Finish.in_piece(before));
            let begins = self.boundary(after.target, End::Start.in_piece(after));
            if let (Some(a), Some(b)) = (ends, begins)
                && a.vertex == b.vertex
            {
                let identity = format!("T_{} ∂ = T_{j} ∂ (adjacency)", j - 1);
                self.compare(e, j, identity, &(&before.op * &a.op), &(&after.op * &b.op))?;
            }
        }
        Ok(())
    }

    fn compare(
        &self,
        e: usize,
        piece: usize,
        identity: String,
        a: &Matrix<E>,
        b: &Matrix<E>,
    ) -> Result<(), CurveError> {
        for row in 0..a.rows() {
            for column in 0..a.cols() {
                let residual = a[(row, column)].minus(&b[(row, column)]);
                if !residual.is_zero() {
                    let residual = residual.to_string();
                    let state = self.states[e].name.clone();
                    return Err(CurveError::Identity { state, index: e, piece, identity, row, column, residual });
                }
            }
        }
        Ok(())
    }
}
