//! Curves of several spans: a polygon with more control points than one span needs.
//!
//! The spans are the pieces of a state of their own, which nothing leads back to; each takes the control points of its span from
//! those of the polygon.

use super::{SchemeError, curves};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{CellKind, Piece, Shape, State};

/// What happens at the ends of a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ends {
    /// The curve ends where its last span ends.
    Open,
    /// The polygon is closed. The first span is run through once more at the end, so that the point where the curve closes is a
    /// joint like the others.
    Closed,
    /// The curve begins and ends at the first and the last control point: knots of full multiplicity there (B-splines only).
    Clamped,
}

/// Most spans.
pub const MAX_SPANS: usize = 64;

/// The curve whose spans take their control points through these matrices: the columns of one are the control points of its span
/// as combinations of those of the polygon.
///
/// # Errors
/// [`SchemeError::Large`]; [`SchemeError::Value`] where there is no span; those of the shape, such as spans that do not meet.
pub fn of_spans(mut shape: Shape, spans: Vec<Matrix>) -> Result<Shape, SchemeError> {
    let Some(first) = spans.first() else {
        return Err(SchemeError::value("control", &0, "there is no span"));
    };
    if spans.len() > MAX_SPANS {
        return Err(SchemeError::Large { what: "number of spans", size: spans.len(), limit: MAX_SPANS });
    }
    let (dim, target) = (first.rows(), shape.start);
    let pieces = spans.into_iter().map(|op| Piece { target, op, reversed: false, share: None }).collect();
    shape.start = shape.states.len();
    shape.states.push(State { name: "polygon".to_owned(), kind: CellKind::Edge, dim, pieces, left: None, right: None });
    super::mask::verify(&shape)?;
    Ok(shape)
}

/// The control points `from, from + 1, …` of a polygon of `count`, as a matrix.
fn window(count: usize, from: usize, size: usize) -> Matrix {
    let times = |i: usize, j: usize| usize::from((from + j) % count == i);
    Matrix::from_fn(count, size, |i, j| Rational::from(times(i, j)))
}

/// The spans of a scheme that needs `size` control points for one, `step` apart.
///
/// # Errors
/// [`SchemeError::Value`] where the number of control points does not fit.
pub fn windows(count: usize, size: usize, step: usize, ends: Ends) -> Result<Vec<Matrix>, SchemeError> {
    let wrong = |why: String| SchemeError::value("control", &count, &why);
    let steps = match ends {
        Ends::Closed if count >= 3 && count.is_multiple_of(step) => count / step + 1,
        Ends::Closed if step == 1 => return Err(wrong("a closed polygon has 3 points at least".to_owned())),
        Ends::Closed => return Err(wrong(format!("a closed polygon has a multiple of {step} points, 3 at least"))),
        _ if count >= size && (count - size).is_multiple_of(step) => (count - size) / step + 1,
        _ if step == 1 => {
            return Err(wrong(format!("one span needs {size} control points, and each further span one more")));
        }
        _ => return Err(wrong(format!("one span needs {size} control points, and each further span {step} more"))),
    };
    Ok((0..steps).map(|k| window(count, k * step, size)).collect())
}

/// The B-spline of a degree over knots: its spans as Bézier curves.
///
/// # Errors
/// [`SchemeError::Value`] where there are not `count + degree + 1` ascending knots, or a span is missing.
pub fn over_knots(count: usize, degree: usize, knots: &[Rational]) -> Result<Shape, SchemeError> {
    let needed = count + degree + 1;
    let ascending = knots.windows(2).all(|w| w[0] <= w[1]);
    if knots.len() != needed || !ascending {
        let why =
            format!("{count} control points of degree {degree} need {needed} knots, none smaller than the one before");
        return Err(SchemeError::value("knots", &knots.len(), &why));
    }
    if knots.windows(degree + 1).skip(1).take(count.saturating_sub(1)).any(|w| w[0] == w[degree]) {
        return Err(SchemeError::value(
            "knots",
            &knots.len(),
            "a knot inside may be repeated as often as the degree says at most",
        ));
    }
    let spans = (degree..count).filter(|&m| knots[m] < knots[m + 1]);
    let spans: Vec<Matrix> = spans.map(|m| bezier_points(count, degree, knots, m)).collect();
    of_spans(curves::bezier(degree, &(Rational::from(1) / Rational::from(2)))?, spans)
}

/// The knots `0, …, 0, 1, 2, …, n, …, n`, full multiplicity at the ends.
#[must_use]
pub fn clamped_knots(count: usize, degree: usize) -> Vec<Rational> {
    let last = count.saturating_sub(degree);
    (0..count + degree + 1).map(|k| Rational::from(k.saturating_sub(degree).min(last))).collect()
}

/// The Bézier points of the span between the knots `m` and `m + 1`: values of the blossom, by de Boor's recursion.
fn bezier_points(count: usize, degree: usize, knots: &[Rational], m: usize) -> Matrix {
    let column = |j: usize| {
        let mut points: Vec<Vec<Rational>> =
            (m - degree..=m).map(|i| (0..count).map(|k| Rational::from(usize::from(i == k))).collect()).collect();
        for r in 1..=degree {
            let u = if r <= j { &knots[m + 1] } else { &knots[m] };
            for i in (m - degree + r..=m).rev() {
                let (left, right) = (&knots[i], &knots[i + degree + 1 - r]);
                let at = (u - left) / (right - left);
                let k = i + degree - m;
                let mixed = |a: &Rational, b: &Rational| a + (b - a) * &at;
                points[k] = points[k - 1].iter().zip(&points[k]).map(|(a, b)| mixed(a, b)).collect();
            }
        }
        points.swap_remove(degree)
    };
    let columns: Vec<Vec<Rational>> = (0..=degree).map(column).collect();
    Matrix::from_columns(count, &columns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn columns(m: &Matrix) -> Vec<Vec<Rational>> {
        (0..m.cols()).map(|j| m.column(j)).collect()
    }

    #[test]
    fn bezier_points_of_uniform_and_clamped_quadratics() {
        let uniform: Vec<Rational> = (0..6).map(Rational::from).collect();
        let half = || ratio(1, 2);
        let o = || ratio(0, 1);
        let expected = vec![vec![half(), half(), o()], vec![o(), ratio(1, 1), o()], vec![o(), half(), half()]];
        assert_eq!(columns(&bezier_points(3, 2, &uniform, 2)), expected);
        let clamped = clamped_knots(4, 2);
        assert_eq!(clamped, [0, 0, 0, 1, 2, 2, 2].map(|k| ratio(k, 1)));
        let first = columns(&bezier_points(4, 2, &clamped, 2));
        assert_eq!(first[0], [1, 0, 0, 0].map(|k| ratio(k, 1)));
        assert_eq!(first[2], [o(), half(), half(), o()]);
    }

    #[test]
    fn windows_fit_or_are_refused() {
        let count = |n, size, step, ends| windows(n, size, step, ends).map(|w| w.len()).ok();
        assert_eq!(count(6, 3, 1, Ends::Open), Some(4));
        assert_eq!(count(6, 3, 1, Ends::Closed), Some(7));
        assert_eq!(count(2, 3, 1, Ends::Open), None);
        assert_eq!((count(7, 4, 3, Ends::Open), count(6, 4, 3, Ends::Open)), (Some(2), None));
        assert_eq!((count(6, 4, 3, Ends::Closed), count(7, 4, 3, Ends::Closed)), (Some(3), None));
    }
}
