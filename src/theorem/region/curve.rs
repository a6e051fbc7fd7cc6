//! A curve of one state whose operators are polynomials in a parameter.

use super::symbol::Symbol;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::radius::family::Pencil;
use crate::shape::{CellKind, End, Shape};
use thiserror::Error;

/// Why a family of curves is not analysed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CurveFamilyError {
    /// Several states, or a state that is no curve.
    #[error("regions of curves are found for a case with one state, which is a curve")]
    States,
    /// Too large.
    #[error("regions of curves are found for 2 to {} coordinates and 2 to {MAX_LETTERS} pieces", MAX_DIMENSION + 1)]
    Size,
    /// Control points that depend on the parameter, or that hide something.
    #[error("the control points depend on the parameter, or map two directions to one")]
    Control,
    /// An end that is no point for any value of the parameter.
    #[error("an end of the curve is not one point for any value of the parameter")]
    NoEnd,
    /// Neighbouring pieces that do not meet for every value of the parameter.
    #[error("piece {0} does not begin where the piece before it ends, for every value of the parameter")]
    Apart(usize),
}

/// Most dimensions of differences, and most pieces.
pub const MAX_DIMENSION: usize = 4;
const MAX_LETTERS: usize = 8;

/// A germ of the curve at one of its ends, and what leads there.
#[derive(Debug, Clone)]
pub(super) struct Germ {
    /// Whether the end to which the cycle belongs is the start.
    pub at_start: bool,
    /// The letters before the cycle.
    pub prefix: Vec<usize>,
    /// The cycle.
    pub cycle: Vec<usize>,
}

/// A curve with a parameter: one state, with its pieces in order.
#[derive(Debug, Clone)]
pub struct CurveFamily<P = Poly> {
    /// The operators; the columns add up to 1.
    pub operators: Vec<Matrix<P>>,
    /// Which pieces are run backwards.
    pub reversed: Vec<bool>,
    /// The control points, if there are any.
    pub control: Option<Matrix>,
    /// What the operators do with differences, in the coordinates but the first.
    pub(super) linear: Vec<Matrix<P>>,
    /// The germs at the start and at the end.
    pub(super) germs: [Germ; 2],
    /// The chord times a positive square of polynomials, and the polynomials that must not vanish for it.
    pub(super) chord: Vec<P>,
    pub(super) chord_guards: Vec<P>,
}

impl<P: Symbol> CurveFamily<P> {
    /// A family of curves with one state.
    ///
    /// # Errors
    /// [`CurveFamilyError`].
    pub fn new(
        operators: Vec<Matrix<P>>,
        reversed: Vec<bool>,
        control: Option<Matrix>,
    ) -> Result<Self, CurveFamilyError> {
        let d = operators.first().map_or(0, Matrix::rows);
        let sizes = (2..=MAX_DIMENSION + 1).contains(&d) && (2..=MAX_LETTERS).contains(&operators.len());
        if !sizes || operators.iter().any(|m| (m.rows(), m.cols()) != (d, d)) || reversed.len() != operators.len() {
            return Err(CurveFamilyError::Size);
        }
        if control.as_ref().is_some_and(|p| !is_injective(p, d)) {
            return Err(CurveFamilyError::Control);
        }
        let on_differences =
            |m: &Matrix<P>| Matrix::from_fn(d - 1, d - 1, |i, j| m[(i + 1, j + 1)].minus(&m[(i + 1, 0)]));
        let linear: Vec<Matrix<P>> = operators.iter().map(on_differences).collect();
        let germ = |end| germ(&reversed, end).ok_or(CurveFamilyError::NoEnd);
        let germs = [germ(End::Start)?, germ(End::Finish)?];
        let mut family =
            Self { operators, reversed, control, linear, germs, chord: Vec::new(), chord_guards: Vec::new() };
        let points = [family.point(0)?, family.point(1)?];
        family.meets(&points)?;
        let sums = points.each_ref().map(|q| sum(q));
        let scaled = |k: usize, i: usize| points[k][i].times(&sums[1 - k]);
        let both = sums[0].times(&sums[1]);
        family.chord = (1..d).map(|i| scaled(1, i).minus(&scaled(0, i)).times(&both)).collect();
        family.chord_guards = sums.to_vec();
        Ok(family)
    }

    /// The dimension of differences.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.linear[0].rows()
    }

    /// The member at a value of the parameters, which is given by what polynomials are there.
    pub(super) fn shape(&self, value: impl Fn(&P) -> Rational) -> Shape {
        let operators = self.operators.iter().map(|m| m.map(&value)).collect();
        Shape { control: self.control.clone(), ..single(operators, &self.reversed) }
    }

    /// The product along a word on differences.
    pub(super) fn product(&self, word: &[usize]) -> Matrix<P> {
        word.iter().fold(identity(self.dim()), |m, &l| m.mul_over(&P::ring(), &self.linear[l]))
    }

    /// The sign of a word: the product of -1 for each piece run backwards.
    pub(super) fn sign(&self, word: &[usize]) -> i32 {
        word.iter().map(|&l| if self.reversed[l] { -1 } else { 1 }).product()
    }

    /// An end as a vector that is a multiple of it: a fixed vector of its cycle, led to the end.
    fn point(&self, end: usize) -> Result<Vec<P>, CurveFamilyError> {
        let germ = &self.germs[end];
        let d = self.operators[0].rows();
        let along = |word: &[usize], v: Vec<P>| word.iter().rev().fold(v, |v, &l| apply(&self.operators[l], &v));
        let one = P::number(Rational::from(1));
        let cycle = germ.cycle.iter().fold(identity(d), |m, &l| m.mul_over(&P::ring(), &self.operators[l]));
        let chi = cycle.char_poly_over(&P::ring());
        let fixed = (0..d)
            .map(|column| cycle.adjugate_column_over(&P::ring(), &chi, column, &one))
            .find(|v| !sum(v).vanishes());
        let fixed = fixed.ok_or(CurveFamilyError::NoEnd)?;
        Ok(along(&germ.prefix, P::shortened(&fixed)))
    }

    /// Whether every piece begins where the one before ends.
    fn meets(&self, points: &[Vec<P>; 2]) -> Result<(), CurveFamilyError> {
        let image = |letter: usize, end: End| {
            let own = if self.reversed[letter] { end.other() } else { end };
            apply(&self.operators[letter], &points[usize::from(own == End::Finish)])
        };
        for letter in 1..self.operators.len() {
            let (a, b) = (image(letter - 1, End::Finish), image(letter, End::Start));
            let (s, t) = (sum(&a), sum(&b));
            if a.iter().zip(&b).any(|(x, y)| x.times(&t) != y.times(&s)) {
                return Err(CurveFamilyError::Apart(letter));
            }
        }
        Ok(())
    }
}

impl CurveFamily {
    /// What the operators do with differences, for the search of words and hulls.
    #[must_use]
    pub fn pencil(&self) -> Option<Pencil> {
        Pencil::new(self.linear.clone())
    }

    /// The member at a value of the parameter.
    #[must_use]
    pub fn member(&self, p: &Rational) -> Shape {
        self.shape(|f| f.eval(p))
    }
}

fn sum<P: Symbol>(v: &[P]) -> P {
    v.iter().fold(P::nought(), |s, x| s.plus(x))
}

fn identity<P: Symbol>(n: usize) -> Matrix<P> {
    Matrix::from_fn(n, n, |i, j| P::number(Rational::from(u64::from(i == j))))
}

pub(super) fn apply<P: Symbol>(m: &Matrix<P>, v: &[P]) -> Vec<P> {
    (0..m.rows()).map(|i| super::signs::dot(m.row(i), v)).collect()
}

/// Whether control points keep all differences apart.
fn is_injective(control: &Matrix, d: usize) -> bool {
    let differences = Matrix::from_fn(control.rows(), d - 1, |i, j| &control[(i, j + 1)] - &control[(i, 0)]);
    control.cols() == d && differences.rank() == d - 1
}

fn single(operators: Vec<Matrix>, reversed: &[bool]) -> Shape {
    let mut shape = Shape::single(CellKind::Edge, operators);
    for (piece, reversed) in shape.states[0].pieces.iter_mut().zip(reversed) {
        piece.reversed = *reversed;
    }
    shape
}

/// A shape with pieces in this order, of which only letters matter.
pub(super) fn outline(reversed: &[bool]) -> Shape {
    single(vec![Matrix::identity(1); reversed.len()], reversed)
}

/// The address of an end through the outermost pieces.
fn germ(reversed: &[bool], end: End) -> Option<Germ> {
    let address = outline(reversed).end_address(0, end, |_| false)?;
    let side = address.prefix.iter().fold(end, |side, &l| if reversed[l] { side.other() } else { side });
    Some(Germ { at_start: side == End::Start, prefix: address.prefix, cycle: address.cycle })
}
