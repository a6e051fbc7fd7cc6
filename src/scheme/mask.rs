//! Univariate masks of any arity and the operators of their curves.
//!
//! A mask `a_0 … a_L` of arity `m` refines control points by `p'_k = Σ_j a_{k−mj} p_j`; its basic limit function obeys
//! `φ(x) = Σ_k a_k φ(mx − k)` and lives on `[0, L/(m−1)]`. With `v_i(x) = φ(x + i)` the piece of the limit curve over
//! `[0, 1]` is `P v(x)`, and `v((y + e)/m) = T_e v(y)` with `T_e[i][j] = a_{mi−j+e}` (Micchelli and Prautzsch, *Uniform
//! refinement of curves*, Linear Algebra Appl. 114/115, 1989; Daubechies and Lagarias, *Two-scale difference equations II*,
//! SIAM J. Math. Anal. 23, 1992). Column `i` of `P` is the control point that goes with `φ(x + i)`. The coordinates of a curve
//! are the `φ(x + i)` with `i` descending, so that its control points run with its parameter.

use super::{Laurent, SchemeError};
use crate::arith::{Natural, Rational};
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, End, Piece, Shape, State};
use malachite_base::num::arithmetic::traits::CheckedSqrt;

/// Largest arity.
pub const MAX_ARITY: usize = 64;
/// Largest number of coordinates of a curve.
pub const MAX_DIMENSION: usize = 128;

/// How a wavelet (refinement) filter is scaled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Normalisation {
    /// `Σ a = arity`, as for masks.
    Arity,
    /// `Σ h = 1`: a low-pass filter with gain 1.
    One,
    /// `Σ h = √arity`, the orthonormal scaling. The coefficients are given as multiples of `√arity` (for arity 2 the
    /// number `q` stands for `q√2`) unless `√arity` is rational.
    Root,
}

/// A mask that satisfies the sum rules of order 1, without leading and trailing zeros.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    arity: usize,
    coefficients: Vec<Rational>,
}

impl Normalisation {
    /// The word for it in a case.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Arity => "arity",
            Self::One => "one",
            Self::Root => "root",
        }
    }
}

impl Mask {
    /// The mask with the given coefficients; zeros at both ends are dropped, which only moves the curve's parameter.
    ///
    /// # Errors
    /// [`SchemeError::Arity`], [`SchemeError::Short`] for a constant, [`SchemeError::Large`], and
    /// [`SchemeError::SumRule`] where the coefficients of a residue class modulo the arity do not add up to 1.
    pub fn new(arity: usize, coefficients: Vec<Rational>) -> Result<Self, SchemeError> {
        if !(2..=MAX_ARITY).contains(&arity) {
            return Err(SchemeError::Arity(arity));
        }
        let coefficients = Laurent::new(0, coefficients).coefficients().to_vec();
        check_sum_rules(arity, &coefficients)?;
        let found = coefficients.len();
        if found < arity + 1 {
            return Err(SchemeError::Short { needed: arity + 1, found });
        }
        let mask = Self { arity, coefficients };
        let size = mask.window();
        if size > MAX_DIMENSION {
            return Err(SchemeError::Large { what: "a curve with coordinates", size, limit: MAX_DIMENSION });
        }
        Ok(mask)
    }

    /// The mask with the Laurent symbol `Σ a_k z^k`, for example `(1+z)^4/8`.
    ///
    /// # Errors
    /// As for [`Laurent::parse`] and [`Mask::new`].
    pub fn from_symbol(arity: usize, text: &str) -> Result<Self, SchemeError> {
        Self::new(arity, Laurent::parse(text)?.coefficients().to_vec())
    }

    /// The mask of a refinement filter.
    ///
    /// # Errors
    /// As for [`Mask::new`].
    ///
    /// # Examples
    /// The Haar-smoothed filter `√2 (1/8, 3/8, 3/8, 1/8)` is Chaikin's mask:
    /// ```
    /// use secant::{arith::ratio, scheme::{Mask, Normalisation}};
    /// let h = [ratio(1, 8), ratio(3, 8), ratio(3, 8), ratio(1, 8)];
    /// let mask = Mask::from_filter(2, &h, Normalisation::Root)?;
    /// assert_eq!(mask.coefficients()[1], ratio(3, 4));
    /// # Ok::<(), secant::scheme::SchemeError>(())
    /// ```
    pub fn from_filter(arity: usize, filter: &[Rational], scale: Normalisation) -> Result<Self, SchemeError> {
        if !(2..=MAX_ARITY).contains(&arity) {
            return Err(SchemeError::Arity(arity));
        }
        // a = √m h; with h = q √m that is a = m q.
        let factor = match scale {
            Normalisation::Arity => Rational::from(1),
            Normalisation::One => Rational::from(arity as u64),
            Normalisation::Root => {
                let root = Natural::from(arity as u64).checked_sqrt();
                root.map_or_else(|| Rational::from(arity as u64), Rational::from)
            }
        };
        Self::new(arity, filter.iter().map(|h| h * &factor).collect())
    }

    /// The arity.
    #[must_use]
    pub fn arity(&self) -> usize {
        self.arity
    }

    /// The coefficients; the first and the last are not 0.
    #[must_use]
    pub fn coefficients(&self) -> &[Rational] {
        &self.coefficients
    }

    /// The symbol `Σ a_k z^k`.
    #[must_use]
    pub fn symbol(&self) -> Laurent {
        Laurent::new(0, self.coefficients.clone())
    }

    /// The largest `K` with `a(z) = (1 + z + … + z^(m−1))^K b(z)`, and the coefficients of `b`.
    #[must_use]
    pub fn smoothing_factor(&self) -> (usize, Vec<Rational>) {
        let divisor = Laurent::geometric(self.arity);
        let (mut count, mut rest) = (0, self.symbol());
        while let Some(quotient) = rest.divide(&divisor) {
            (count, rest) = (count + 1, quotient);
        }
        (count, rest.coefficients().to_vec())
    }

    /// Number of translates of `φ` that meet `[0, 1]`: the support of `φ` is `[0, L/(m−1)]`.
    #[must_use]
    pub fn window(&self) -> usize {
        (self.coefficients.len() - 1).div_ceil(self.arity - 1)
    }

    /// `T_e[i][j] = a_{mi−j+e}` on all `window()` coordinates `φ(x + i)`, `i` ascending, every column summing to 1.
    #[must_use]
    pub fn operators(&self) -> Vec<Matrix> {
        let n = self.window();
        let entry = |e: usize, i: usize, j: usize| {
            let index = (self.arity * i + e).checked_sub(j);
            index.and_then(|k| self.coefficients.get(k)).cloned().unwrap_or_else(|| Rational::from(0))
        };
        (0..self.arity).map(|e| Matrix::from_fn(n, n, |i, j| entry(e, i, j))).collect()
    }

    /// The curve over `[0, 1]`: one edge state with `arity` pieces in the order of the parameter, on the smallest set of
    /// coordinates that the operators leave invariant, in the order of the control points along the curve.
    ///
    /// # Errors
    /// [`SchemeError::Divergent`] where an end point is not determined, [`SchemeError::Curve`] where the pieces do not
    /// meet (the limit function is not continuous).
    pub fn curve(&self) -> Result<Shape, SchemeError> {
        let operators = self.operators();
        let mut kept = invariant_coordinates(&operators)?;
        kept.reverse();
        if kept.len() < 2 {
            return Err(SchemeError::Divergent("the limit is constant between the integers".to_owned()));
        }
        let trimmed = operators.iter().map(|t| select(t, &kept)).collect();
        let shape = Shape::single(CellKind::Edge, trimmed);
        verify(&shape)?;
        Ok(shape)
    }

    /// The curve on all `window()` coordinates with its vertex state: the end points depend on `window() − 1` control
    /// points each, and the boundary operators are inclusions (thesis §3.6).
    ///
    /// # Errors
    /// As for [`Mask::curve`].
    pub fn curve_with_vertices(&self) -> Result<Shape, SchemeError> {
        let operators = self.operators();
        let n = self.window();
        if n < 2 {
            return Err(SchemeError::Divergent("the limit is constant between the integers".to_owned()));
        }
        let vertex_operator = select(&operators[0], &(1..n).rev().collect::<Vec<_>>());
        let all: Vec<usize> = (0..n).rev().collect();
        let operators = operators.iter().map(|t| select(t, &all)).collect();
        let inclusion = |shift: usize| Matrix::from_fn(n, n - 1, |i, j| Rational::from(u8::from(i == j + shift)));
        let mut shape = Shape::single(CellKind::Edge, operators);
        shape.states[0].left = Some(Boundary { vertex: 1, op: inclusion(0) });
        shape.states[0].right = Some(Boundary { vertex: 1, op: inclusion(1) });
        shape.states.push(State {
            name: "v".to_owned(),
            kind: CellKind::Vertex,
            dim: n - 1,
            pieces: vec![Piece { target: 1, op: vertex_operator, reversed: false, share: None }],
            left: None,
            right: None,
        });
        verify(&shape)?;
        Ok(shape)
    }
}

/// Checks sizes, sums, that the end points are determined, and that the pieces meet.
///
/// # Errors
/// [`SchemeError::Shape`], [`SchemeError::Divergent`], [`SchemeError::Curve`].
pub(super) fn verify(shape: &Shape) -> Result<(), SchemeError> {
    shape.check()?;
    for state in shape.reachable() {
        if shape.states[state].kind == CellKind::Edge {
            for end in [End::Start, End::Finish] {
                if shape.end_point(state, end).is_none() {
                    return Err(SchemeError::Divergent(why_no_end(shape, state, end).to_owned()));
                }
            }
        }
    }
    Ok(shape.check_curves()?)
}

/// Why an end of a curve is not one point. Columns sum to 1, so that 1 is an eigenvalue of the operator of the cycle.
fn why_no_end(shape: &Shape, state: usize, end: End) -> &'static str {
    let Some(address) = shape.end_address(state, end, |_| false) else { return "a state has no pieces" };
    let (_, home) = shape.product(state, &address.prefix);
    let (cycle, _) = shape.product(home, &address.cycle);
    let kernel = (&cycle - &Matrix::identity(cycle.rows())).kernel();
    let sum = |j: usize| kernel.column(j).iter().fold(Rational::from(0), |s, x| s + x);
    if (0..kernel.cols()).all(|j| sum(j) == 0) {
        "the operator at an end of the curve has no fixed point: its eigenvalue 1 has a Jordan block"
    } else {
        "the operator at an end of the curve has more than one fixed point"
    }
}

/// The curve with its end points as vertices on one coordinate; a curve that has boundaries is left as it is.
///
/// # Errors
/// [`SchemeError::Value`] where the shape is not a single curve.
pub(super) fn with_vertices(mut shape: Shape) -> Result<Shape, SchemeError> {
    let [state] = shape.states.as_slice() else { return Ok(shape) };
    if state.kind != CellKind::Edge {
        return Err(SchemeError::value("kind", &"set", "a curve is needed, and this scheme is a set"));
    }
    let dim = state.dim;
    let boundary = |end| {
        let point = shape.end_point(0, end);
        let point = point.ok_or_else(|| SchemeError::Divergent("an end point is not unique".to_owned()))?;
        Ok::<_, SchemeError>(Some(Boundary { vertex: 1, op: Matrix::from_columns(dim, &[point]) }))
    };
    let (left, right) = (boundary(End::Start)?, boundary(End::Finish)?);
    (shape.states[0].left, shape.states[0].right) = (left, right);
    shape.states.push(super::curves::point_vertex(1));
    Ok(shape)
}

fn check_sum_rules(arity: usize, coefficients: &[Rational]) -> Result<(), SchemeError> {
    let mut sums = vec![Rational::from(0); arity];
    for (k, c) in coefficients.iter().enumerate() {
        sums[k % arity] += c;
    }
    let Some(residue) = sums.iter().position(|s| *s != 1) else { return Ok(()) };
    let sum = sums[residue].clone();
    let near = |x: &Rational, digits: i64| crate::arith::abs(x) < Rational::from_signeds(1, digits);
    let hint = if sums.iter().all(|s| near(&(s - Rational::from(1)), 1000)) {
        "; are these decimals of fractions? Write \"1/6\" for 0.1667; `secant regularity` takes decimals".to_owned()
    } else if arity == 2 && sums.iter().all(|s| *s > 0 && near(&(s * s * Rational::from(2) - Rational::from(1)), 100)) {
        "; these sums are near 1/√2, as those of a filter: `secant regularity` takes it as it is".to_owned()
    } else if sums.iter().all(|s| *s == sum) && sum != 0 {
        format!("; all classes have this sum, so the mask must be divided by {sum}")
    } else {
        String::new()
    };
    Err(SchemeError::SumRule { arity, residue, sum, hint })
}

/// The rows and columns of a square matrix with the given indices.
fn select(matrix: &Matrix, kept: &[usize]) -> Matrix {
    Matrix::from_fn(kept.len(), kept.len(), |i, j| matrix[(kept[i], kept[j])].clone())
}

/// The smallest set of coordinates that all operators map into themselves.
fn invariant_coordinates(operators: &[Matrix]) -> Result<Vec<usize>, SchemeError> {
    let n = operators.first().map_or(0, Matrix::rows);
    let closure = |start: usize| {
        let mut inside = vec![false; n];
        let mut todo = vec![start];
        while let Some(j) = todo.pop() {
            if !std::mem::replace(&mut inside[j], true) {
                todo.extend((0..n).filter(|&i| operators.iter().any(|t| t[(i, j)] != 0)));
            }
        }
        (0..n).filter(|&i| inside[i]).collect::<Vec<_>>()
    };
    let closures: Vec<Vec<usize>> = (0..n).map(closure).collect();
    let mut minimal: Vec<&Vec<usize>> =
        closures.iter().filter(|c| c.iter().all(|&i| closures[i].len() == c.len())).collect();
    minimal.dedup();
    minimal.sort();
    minimal.dedup();
    match minimal.as_slice() {
        [only] => Ok((*only).clone()),
        _ => Err(SchemeError::Divergent(format!(
            "the operators keep {} separate sets of coordinates, so the limit depends on where it starts",
            minimal.len()
        ))),
    }
}
