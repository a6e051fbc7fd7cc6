//! Bézier curves, corner cutting, and the classical self-similar curves.

use super::mask::verify;
use super::{MAX_DEGREE, SchemeError};
use crate::arith::{Rational, binomial, ratio};
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Frame, Piece, Shape, State};

fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(Rational::from(1), |p, _| p * base)
}

/// The Bézier curve of a degree from 1 with de Casteljau's subdivision at `split`; column `i` of the control points is
/// `b_i`, and the end points are vertices on one control point each (de Casteljau 1959; Farin, *Curves and Surfaces for
/// CAGD*, chapter 4).
///
/// # Errors
/// [`SchemeError::Value`] for degree 0 or a split outside `(0, 1)`, [`SchemeError::Large`].
pub fn bezier(degree: usize, split: &Rational) -> Result<Shape, SchemeError> {
    if degree == 0 {
        return Err(SchemeError::value("degree", &degree, "a curve has degree 1 at least"));
    }
    if degree > MAX_DEGREE {
        return Err(SchemeError::Large { what: "degree", size: degree, limit: MAX_DEGREE });
    }
    if *split <= 0 || *split >= 1 {
        return Err(SchemeError::value("split", split, "the parameter of the split lies between 0 and 1"));
    }
    let rest = Rational::from(1) - split;
    // The control points of the left piece are b'_j = Σ_i B_i^j(t) b_i, those of the right one b'_j = Σ_i B_{i−j}^{d−j}(t) b_i.
    let bernstein = |d: usize, i: usize| binomial(d, i) * power(split, i) * power(&rest, d - i);
    let zero = || Rational::from(0);
    let size = degree + 1;
    let left = Matrix::from_fn(size, size, |i, j| if i <= j { bernstein(j, i) } else { zero() });
    let right = Matrix::from_fn(size, size, |i, j| if i >= j { bernstein(degree - j, i - j) } else { zero() });
    let mut shape = Shape::single(CellKind::Edge, vec![left, right]);
    let corner = |at: usize| Matrix::from_fn(size, 1, |i, _| Rational::from(u8::from(i == at)));
    shape.states[0].left = Some(Boundary { vertex: 1, op: corner(0) });
    shape.states[0].right = Some(Boundary { vertex: 1, op: corner(degree) });
    shape.states.push(point_vertex(1));
    verify(&shape)?;
    Ok(shape)
}

/// A vertex state with one coordinate and index `index`.
pub(super) fn point_vertex(index: usize) -> State {
    let pieces = vec![Piece { target: index, op: Matrix::identity(1), reversed: false, share: None }];
    State { name: "v".to_owned(), kind: CellKind::Vertex, dim: 1, pieces, left: None, right: None }
}

/// Corner cutting with two parameters: `p'_{2i} = (1−a) p_i + a p_{i+1}`, `p'_{2i+1} = b p_i + (1−b) p_{i+1}` (de Rham, *Sur
/// une courbe plane*, J. Math. Pures Appl. 35, 1956; Gregory and Qu, *Nonuniform corner cutting*, CAGD 13, 1996). The
/// example of the thesis, §2.1, is `a = −1/4`, `b = 1/2`; Chaikin's curve is `a = b = 1/4`.
///
/// # Errors
/// [`SchemeError::Divergent`] or [`SchemeError::Curve`] where this is no curve.
pub fn corner_cutting(a: &Rational, b: &Rational) -> Result<Shape, SchemeError> {
    let (one, o) = (Rational::from(1), Rational::from(0));
    let (ca, cb) = (&one - a, &one - b);
    let first = vec![
        vec![ca.clone(), b.clone(), o.clone()],
        vec![a.clone(), cb.clone(), ca.clone()],
        vec![o.clone(), o.clone(), a.clone()],
    ];
    let second = vec![vec![b.clone(), o.clone(), o.clone()], vec![cb.clone(), ca, b.clone()], vec![o, a.clone(), cb]];
    let operators = vec![Matrix::from_rows(3, first), Matrix::from_rows(3, second)];
    let shape = Shape::single(CellKind::Edge, operators);
    verify(&shape)?;
    Ok(shape)
}

/// One affine map of the plane: linear part by rows, shift, and whether the piece runs backwards.
pub struct PlaneMap {
    /// The linear part, by rows.
    pub linear: [[Rational; 2]; 2],
    /// The shift.
    pub shift: [Rational; 2],
    /// Whether the piece runs against the parameter.
    pub reversed: bool,
}

/// The shape of affine maps of the plane, in the order given.
///
/// # Errors
/// [`SchemeError::Curve`] where `kind` is an edge and the pieces do not meet.
pub fn plane_shape(kind: CellKind, maps: &[PlaneMap]) -> Result<Shape, SchemeError> {
    let operator =
        |m: &PlaneMap| Shape::affine_operator(&Matrix::from_fn(2, 2, |i, j| m.linear[i][j].clone()), &m.shift);
    let mut shape = Shape::single(kind, maps.iter().map(operator).collect());
    for (piece, map) in shape.states[0].pieces.iter_mut().zip(maps) {
        piece.reversed = map.reversed;
    }
    shape.control = Some(Shape::affine_control(2));
    shape.frame = Frame::Affine;
    verify(&shape)?;
    Ok(shape)
}

fn map(linear: [[Rational; 2]; 2], shift: [Rational; 2]) -> PlaneMap {
    PlaneMap { linear, shift, reversed: false }
}

/// Multiplication of `x + y√(−n)` by `(p + q√(−n))/d`, after a reflection `y -> −y` where `mirrored`.
fn turn(n: i64, (p, q, d): (i64, i64, i64), mirrored: bool, shift: (i64, i64, i64)) -> PlaneMap {
    let sign = if mirrored { -1 } else { 1 };
    let linear = [[ratio(p, d), ratio(-n * q * sign, d)], [ratio(q, d), ratio(p * sign, d)]];
    map(linear, [ratio(shift.0, shift.2), ratio(shift.1, shift.2)])
}

/// Takagi's and Landsberg's curve: `(x/2, αy + x/2)`, `((x+1)/2, αy + (1−x)/2)`; `α = 1/2` is Takagi's (1903), `α = 1/4` a
/// parabola.
///
/// # Errors
/// [`SchemeError::Value`] for `|α| ≥ 1`.
pub fn takagi(alpha: &Rational) -> Result<Shape, SchemeError> {
    if *alpha <= -1 || *alpha >= 1 {
        return Err(SchemeError::value("alpha", alpha, "the factor lies between −1 and 1"));
    }
    let (h, o) = (ratio(1, 2), ratio(0, 1));
    let left = map([[h.clone(), o.clone()], [h.clone(), alpha.clone()]], [o.clone(), o.clone()]);
    let right = map([[h.clone(), o], [-&h, alpha.clone()]], [h.clone(), h]);
    plane_shape(CellKind::Edge, &[left, right])
}

/// A function graph over `[0, 1]` from `(0, 0)` to `(1, 1)` with equal steps in `x` and the given steps in `y`.
fn staircase(steps: &[Rational]) -> Result<Shape, SchemeError> {
    let count = steps.len() as i64;
    let mut height = Rational::from(0);
    let mut maps = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        let linear = [[ratio(1, count), ratio(0, 1)], [ratio(0, 1), step.clone()]];
        maps.push(map(linear, [ratio(k as i64, count), height.clone()]));
        height += step;
    }
    plane_shape(CellKind::Edge, &maps)
}

/// Okamoto's function with parameter `a` (*A remark on continuous, nowhere differentiable functions*, Proc. Japan Acad. 81,
/// 2005): steps `a`, `1 − 2a`, `a`.
///
/// # Errors
/// [`SchemeError::Value`] for `a` outside `(0, 1)`.
pub fn okamoto(a: &Rational) -> Result<Shape, SchemeError> {
    if *a <= 0 || *a >= 1 {
        return Err(SchemeError::value("a", a, "the parameter lies between 0 and 1"));
    }
    staircase(&[a.clone(), Rational::from(1) - Rational::from(2) * a, a.clone()])
}

/// Lebesgue's (or de Rham's) singular function with parameter `a`: steps `a`, `1 − a` (de Rham, *Sur quelques courbes
/// définies par des équations fonctionnelles*, 1957).
///
/// # Errors
/// [`SchemeError::Value`] for `a` outside `(0, 1)`.
pub fn lebesgue(a: &Rational) -> Result<Shape, SchemeError> {
    if *a <= 0 || *a >= 1 {
        return Err(SchemeError::value("a", a, "the parameter lies between 0 and 1"));
    }
    staircase(&[a.clone(), Rational::from(1) - a])
}

/// Koch's curve with 4 pieces, or with 2 mirrored ones, in the coordinates `x + y√−3` (von Koch 1904).
///
/// # Errors
/// [`SchemeError::Value`] for another number of pieces.
pub fn koch(pieces: usize) -> Result<Shape, SchemeError> {
    let maps = match pieces {
        2 => vec![turn(3, (3, 1, 6), true, (0, 0, 1)), turn(3, (3, -1, 6), true, (3, 1, 6))],
        4 => vec![
            turn(3, (2, 0, 6), false, (0, 0, 1)),
            turn(3, (1, 1, 6), false, (2, 0, 6)),
            turn(3, (1, -1, 6), false, (3, 1, 6)),
            turn(3, (2, 0, 6), false, (4, 0, 6)),
        ],
        _ => return Err(SchemeError::value("pieces", &pieces, "Koch's curve is built from 2 or 4 pieces")),
    };
    plane_shape(CellKind::Edge, &maps)
}

/// Lévy's C curve (Lévy 1938): `(1+i)/2 z`, `(1−i)/2 z + (1+i)/2`.
///
/// # Errors
/// None for these maps.
pub fn levy() -> Result<Shape, SchemeError> {
    plane_shape(CellKind::Edge, &[turn(1, (1, 1, 2), false, (0, 0, 1)), turn(1, (1, -1, 2), false, (1, 1, 2))])
}

/// Heighway's dragon: `(1+i)/2 z`, and `1 − (1−i)/2 z` run backwards.
///
/// # Errors
/// None for these maps.
pub fn dragon() -> Result<Shape, SchemeError> {
    let mut second = turn(1, (-1, 1, 2), false, (1, 0, 1));
    second.reversed = true;
    plane_shape(CellKind::Edge, &[turn(1, (1, 1, 2), false, (0, 0, 1)), second])
}

/// The terdragon, in the coordinates `x + y√−3` (Davis and Knuth, *Number representations and dragon curves*, 1970).
///
/// # Errors
/// None for these maps.
pub fn terdragon() -> Result<Shape, SchemeError> {
    let maps = [
        turn(3, (3, -1, 6), false, (0, 0, 1)),
        turn(3, (0, 2, 6), false, (3, -1, 6)),
        turn(3, (3, -1, 6), false, (3, 1, 6)),
    ];
    plane_shape(CellKind::Edge, &maps)
}

/// Sierpiński's arrowhead, in the coordinates `x + y√−3` (Sierpiński 1915).
///
/// # Errors
/// None for these maps.
pub fn arrowhead() -> Result<Shape, SchemeError> {
    let maps = [
        turn(3, (1, 1, 4), true, (0, 0, 1)),
        turn(3, (2, 0, 4), false, (1, 1, 4)),
        turn(3, (1, -1, 4), true, (3, 1, 4)),
    ];
    plane_shape(CellKind::Edge, &maps)
}

/// Minkowski's sausage: eight pieces of size 1/4.
///
/// # Errors
/// None for these maps.
pub fn minkowski_sausage() -> Result<Shape, SchemeError> {
    let steps = [(1, 0), (0, 1), (1, 0), (0, -1), (0, -1), (1, 0), (0, 1), (1, 0)];
    let (mut x, mut y) = (0, 0);
    let mut maps = Vec::new();
    for (p, q) in steps {
        maps.push(turn(1, (p, q, 4), false, (x, y, 4)));
        (x, y) = (x + p, y + q);
    }
    plane_shape(CellKind::Edge, &maps)
}

/// A map of the unit square onto the square of side `1/n` at `(i, j)/n`, its axes exchanged or turned as `linear` says.
fn cell(n: i64, linear: [[i64; 2]; 2], (i, j): (i64, i64)) -> PlaneMap {
    // A negative direction starts at the far side of the square.
    let low = |row: [i64; 2]| row.iter().sum::<i64>().min(0);
    let shift = [ratio(i - low(linear[0]), n), ratio(j - low(linear[1]), n)];
    map(linear.map(|row| row.map(|x| ratio(x, n))), shift)
}

/// Hilbert's curve from `(0, 0)` to `(1, 0)` (Hilbert 1891).
///
/// # Errors
/// None for these maps.
pub fn hilbert() -> Result<Shape, SchemeError> {
    let (same, swap, back) = ([[1, 0], [0, 1]], [[0, 1], [1, 0]], [[0, -1], [-1, 0]]);
    let maps = [cell(2, swap, (0, 0)), cell(2, same, (0, 1)), cell(2, same, (1, 1)), cell(2, back, (1, 0))];
    plane_shape(CellKind::Edge, &maps)
}

/// Peano's curve from `(0, 0)` to `(1, 1)` (Peano 1890).
///
/// # Errors
/// None for these maps.
pub fn peano() -> Result<Shape, SchemeError> {
    let mut maps = Vec::new();
    for i in 0..3 {
        for step in 0..3 {
            let j = if i == 1 { 2 - step } else { step };
            let sign = |odd: i64| if odd == 1 { -1 } else { 1 };
            maps.push(cell(3, [[sign(j % 2), 0], [0, sign(i % 2)]], (i, j)));
        }
    }
    plane_shape(CellKind::Edge, &maps)
}

/// Sierpiński's triangle with corners `(0, 0)`, `(1, 0)`, `(0, 1)`, as a set.
///
/// # Errors
/// None for these maps.
pub fn sierpinski() -> Result<Shape, SchemeError> {
    let maps = [(0, 0), (1, 0), (0, 1)].map(|at| cell(2, [[1, 0], [0, 1]], at));
    plane_shape(CellKind::Set, &maps)
}

/// Barnsley's fern, as a set (*Fractals Everywhere*, 1988, table III.3).
///
/// # Errors
/// None for these maps.
pub fn fern() -> Result<Shape, SchemeError> {
    let rows = [[0, 0, 0, 16, 0, 0], [85, 4, -4, 85, 0, 160], [20, -26, 23, 22, 0, 160], [-15, 28, 26, 24, 0, 44]];
    let maps = rows.map(|r| {
        let [a, b, c, d, e, f] = r.map(|x| ratio(x, 100));
        map([[a, b], [c, d]], [e, f])
    });
    plane_shape(CellKind::Set, &maps)
}
