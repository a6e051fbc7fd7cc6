//! A quick look in floating point: where secants seem to turn. Always approximate, never a verdict.
#![allow(clippy::float_arithmetic, reason = "this is the float fallback")]

use crate::arith::{Rational, to_f64};
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, End, Shape, Spaces, difference};
use nalgebra::{DMatrix, DVector};

/// Directions are compared after two to this power turns of the cycle.
const DOUBLINGS: usize = 12;
/// Most points of the attractor that are followed.
const SAMPLES: usize = 240;
/// Largest sine of an angle between directions that are taken for one line.
const NARROW: f64 = 1e-3;

/// What a point looks like in floating point.
#[derive(Debug, Clone)]
pub struct PointLook {
    /// An address of the point.
    pub address: Address,
    /// The point where the shape is looked at.
    pub position: Vec<f64>,
    /// The eigenvalues on the relevant space, by descending modulus: real and imaginary parts.
    pub eigenvalues: Vec<(f64, f64)>,
    /// The unit vector to which the secants seem to turn, up to sign; `None` where they do not seem to agree.
    pub direction: Option<Vec<f64>>,
    /// The largest sine of an angle between the secant directions after many turns.
    pub spread: f64,
}

/// Looks at the end points, the joints of the start state and the given addresses.
///
/// Returns `None` where the operators have no unique fixed points, as when the system does not contract.
#[must_use]
pub fn look(shape: &Shape, addresses: &[Address]) -> Option<Vec<PointLook>> {
    let spaces = Spaces::new(shape)?;
    let mut all = Vec::new();
    if shape.states[shape.start].kind == CellKind::Edge {
        all.extend(curve_addresses(shape));
    }
    all.extend(addresses.iter().filter_map(|a| a.normalise(shape, shape.start).ok()));
    if all.is_empty() {
        all.extend(shape.landmarks(shape.start));
    }
    all.iter().map(|address| look_at(shape, &spaces, address)).collect()
}

/// Both ends, and both sides of every joint of the start state.
fn curve_addresses(shape: &Shape) -> Vec<Address> {
    let start = shape.start;
    let pieces = &shape.states[start].pieces;
    let end = |letter: usize, end: End| {
        let piece = &pieces[letter];
        let mut address = shape.end_address(piece.target, end.in_piece(piece), |_| false)?;
        address.prefix.insert(0, letter);
        address.normalise(shape, start).ok()
    };
    let mut all: Vec<Address> = shape.end_address(start, End::Start, |_| false).into_iter().collect();
    for j in 1..pieces.len() {
        all.extend(end(j - 1, End::Finish));
        all.extend(end(j, End::Start));
    }
    all.extend(shape.end_address(start, End::Finish, |_| false));
    all
}

fn look_at(shape: &Shape, spaces: &Spaces, address: &Address) -> Option<PointLook> {
    let (prefix, state) = shape.product(shape.start, &address.prefix);
    let (cycle, _) = shape.product(state, &address.cycle);
    let fixed = crate::shape::fixed_point(&cycle)?;
    let space = spaces.of(state);
    let linear = floats(&spaces.linear(&cycle, state, state));
    let view = floats(&(&(&shape.view() * &prefix) * &space.basis));
    let position = shape.view().apply(&prefix.apply(&fixed)).iter().map(to_f64).collect();
    let mut eigenvalues = eigenvalues(&linear);
    eigenvalues.sort_by(|a, b| b.0.hypot(b.1).total_cmp(&a.0.hypot(a.1)));
    let power = high_power(&linear);
    let late = samples(shape, spaces, state, &fixed).into_iter().map(|y| &power * y);
    let directions: Vec<DVector<f64>> =
        late.flat_map(|y| [turned(&view, &y), turned(&view, &(&linear * &y))]).flatten().collect();
    let spread = spread(&directions);
    let direction = directions.first().filter(|_| spread < NARROW).map(|d| d.iter().copied().collect());
    Some(PointLook { address: address.clone(), position, eigenvalues, direction, spread })
}

/// No eigenvalues where the iteration does not settle.
fn eigenvalues(linear: &DMatrix<f64>) -> Vec<(f64, f64)> {
    if linear.nrows() == 0 || linear.iter().any(|x| !x.is_finite()) {
        return Vec::new();
    }
    let schur = nalgebra::Schur::try_new(linear.clone(), f64::EPSILON, 10_000);
    schur.map_or_else(Vec::new, |s| s.complex_eigenvalues().iter().map(|z| (z.re, z.im)).collect())
}

fn floats(m: &Matrix) -> DMatrix<f64> {
    DMatrix::from_fn(m.rows(), m.cols(), |i, j| to_f64(&m[(i, j)]))
}

/// Differences of points of the attractor and the fixed point, in coordinates of the relevant space.
fn samples(shape: &Shape, spaces: &Spaces, state: usize, fixed: &[Rational]) -> Vec<DVector<f64>> {
    let space = spaces.of(state);
    let coordinates = |x: &[Rational]| {
        let y = space.coordinates.apply(&difference(x, fixed));
        DVector::from_iterator(y.len(), y.iter().map(to_f64))
    };
    let mut out = Vec::new();
    let mut level = vec![(Matrix::identity(shape.states[state].dim), state)];
    while out.len() < SAMPLES && level.len() <= SAMPLES {
        out.clear();
        let mut next = Vec::new();
        for (op, e) in &level {
            out.push(coordinates(&op.apply(&spaces.of(*e).base)));
            next.extend(shape.states[*e].pieces.iter().map(|p| (op * &p.op, p.target)));
        }
        if next.len() <= level.len() {
            break;
        }
        level = next;
    }
    out
}

/// The direction of a secant; `None` for a point that falls into the fixed point.
fn turned(view: &DMatrix<f64>, y: &DVector<f64>) -> Option<DVector<f64>> {
    let seen = view * y;
    let norm = seen.norm();
    (norm.is_finite() && norm > 1e-300).then(|| seen / norm)
}

/// A multiple of the `2^DOUBLINGS`-th power.
fn high_power(linear: &DMatrix<f64>) -> DMatrix<f64> {
    let mut power = linear.clone();
    for _ in 0..DOUBLINGS {
        let norm = power.norm();
        if norm > 0.0 {
            power /= norm;
        }
        power = &power * &power;
    }
    let norm = power.norm();
    if norm > 0.0 { power / norm } else { power }
}

fn spread(directions: &[DVector<f64>]) -> f64 {
    let Some(first) = directions.first() else { return 1.0 };
    directions.iter().map(|d| (1.0 - d.dot(first).powi(2)).max(0.0).sqrt()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn a_parabola_looks_smooth_and_a_spiral_does_not() {
        let op = |rows: [[i64; 2]; 2], shift: [i64; 2]| {
            let linear = Matrix::from_fn(2, 2, |i, j| ratio(rows[i][j], 4));
            Shape::affine_operator(&linear, &[ratio(shift[0], 4), ratio(shift[1], 4)])
        };
        // y = x (1 - x), and Lévy's curve.
        let mut parabola =
            Shape::single(CellKind::Edge, vec![op([[2, 0], [1, 1]], [0, 0]), op([[2, 0], [-1, 1]], [2, 1])]);
        parabola.control = Some(Shape::affine_control(2));
        let seen = look(&parabola, &[]).unwrap();
        assert_eq!(seen.len(), 4);
        assert!(seen[0].direction.as_ref().is_some_and(|d| (d[0].abs() - d[1].abs()).abs() < 1e-6), "{seen:?}");
        let levy = Shape::single(CellKind::Edge, vec![op([[2, -2], [2, 2]], [0, 0]), op([[2, 2], [-2, 2]], [2, 2])]);
        assert!(look(&levy, &[]).unwrap().iter().all(|p| p.direction.is_none()));
    }
}
