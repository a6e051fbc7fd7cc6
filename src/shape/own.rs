//! Own points: coordinates of the affine hull of an attractor by points of its own, which do not depend on units
//! (theory §7, Own points).

use super::{CellKind, End, Frame, Piece, Shape, Spaces, State};
use crate::arith::{Rational, abs};
use crate::linalg::Matrix;
use std::collections::BTreeMap;

/// Most landmarks of a state, and longest words before their cycles.
const MAX_LANDMARKS: usize = 160;
const MAX_PREFIX: usize = 6;
/// Most exchanges.
const MAX_SWAPS: usize = 80;

/// For every reachable state, points of its attractor that affinely span it.
#[derive(Debug, Clone)]
pub struct OwnPoints(Vec<Matrix>);

impl OwnPoints {
    /// Landmarks by address, chosen greedily and then exchanged until all landmarks lie in the cube of barycentric coordinates
    /// of modulus at most 1; `None` where too few landmarks span an attractor.
    ///
    /// # Cost
    /// One fixed point for each landmark, and one linear system for each exchange.
    #[must_use]
    pub fn of(shape: &Shape, spaces: &Spaces) -> Option<Self> {
        let mut points: Vec<Matrix> = shape.states.iter().map(|s| Matrix::zero(s.dim, 0)).collect();
        let mut known = BTreeMap::new();
        for e in shape.reachable() {
            points[e] = chosen(shape, e, spaces.of(e).basis.cols() + 1, &mut known)?;
        }
        Some(Self(points))
    }

    /// The same system in these coordinates, seen where the shape is looked at; states that cannot be reached lose their pieces.
    /// `None` where an operator does not map the hulls into one another.
    #[must_use]
    pub fn shape(&self, shape: &Shape) -> Option<Shape> {
        let mut states = Vec::new();
        let reachable = shape.reachable();
        for (e, state) in shape.states.iter().enumerate() {
            let mut pieces = Vec::new();
            for piece in state.pieces.iter().filter(|_| reachable.contains(&e)) {
                let op = self.0[e].solve(&(&piece.op * &self.0[piece.target]))?;
                pieces.push(Piece { target: piece.target, op, reversed: piece.reversed, share: piece.share.clone() });
            }
            let (name, kind, dim) = (state.name.clone(), state.kind, self.0[e].cols());
            states.push(State { name, kind, dim, pieces, left: None, right: None });
        }
        let control = Some(&shape.view() * &self.0[shape.start]);
        Some(Shape { states, start: shape.start, control, frame: Frame::Barycentric })
    }

    /// Points of a state, given in these coordinates, in the coordinates of the shape.
    #[must_use]
    pub fn outwards(&self, state: usize, points: &[Vec<Rational>]) -> Vec<Vec<Rational>> {
        points.iter().map(|p| self.0[state].apply(p)).collect()
    }
}

type Points = Vec<Vec<Rational>>;

/// Points with short addresses: end points and fixed points of one or two letters, behind words of growing length.
fn landmarks(shape: &Shape, e: usize, longest: usize, known: &mut BTreeMap<usize, Points>) -> Points {
    let mut found: Points = Vec::new();
    let mut level = vec![(Matrix::identity(shape.states[e].dim), e)];
    for length in 0..=longest {
        for (op, state) in &level {
            let own = known.entry(*state).or_insert_with(|| short(shape, *state));
            for point in own.iter() {
                let image = op.apply(point);
                if !found.contains(&image) {
                    found.push(image);
                }
            }
            if found.len() >= MAX_LANDMARKS {
                return found;
            }
        }
        if length < longest {
            let next = |(op, state): &(Matrix, usize)| -> Vec<(Matrix, usize)> {
                shape.states[*state].pieces.iter().map(|p| (op * &p.op, p.target)).collect()
            };
            level = level.iter().flat_map(next).collect();
        }
    }
    found
}

fn short(shape: &Shape, state: usize) -> Points {
    let mut found = Points::new();
    if shape.states[state].kind == CellKind::Edge {
        for end in [End::Start, End::Finish] {
            found.extend(shape.end_point(state, end));
        }
    }
    found.extend(shape.short_cycles(state).into_iter().map(|(_, point)| point));
    found
}

fn chosen(shape: &Shape, e: usize, count: usize, known: &mut BTreeMap<usize, Points>) -> Option<Matrix> {
    let dim = shape.states[e].dim;
    let mut longest = 2;
    let (points, mut picked) = loop {
        let points = landmarks(shape, e, longest, known);
        let picked = independent(&points, dim);
        if picked.len() == count {
            break (points, picked);
        }
        if longest == MAX_PREFIX || points.len() >= MAX_LANDMARKS {
            return None;
        }
        longest += 1;
    };
    let columns = |picked: &[usize]| -> Matrix {
        Matrix::from_columns(dim, &picked.iter().map(|k| points[*k].clone()).collect::<Vec<_>>())
    };
    let all = Matrix::from_columns(dim, &points);
    for _ in 0..MAX_SWAPS {
        let coordinates = columns(&picked).solve(&all)?;
        let mut largest = (Rational::from(1), None);
        for j in 0..points.len() {
            for i in 0..picked.len() {
                let size = abs(&coordinates[(i, j)]);
                if size > largest.0 {
                    largest = (size, Some((i, j)));
                }
            }
        }
        let Some((i, j)) = largest.1 else { break };
        picked[i] = j;
    }
    Some(columns(&picked))
}

/// The first points that are affinely independent (their coordinates sum to 1).
fn independent(points: &[Vec<Rational>], dim: usize) -> Vec<usize> {
    let mut rows = Matrix::zero(0, dim);
    let mut picked = Vec::new();
    for (k, point) in points.iter().enumerate() {
        let grown = rows.stack(&Matrix::from_rows(dim, vec![point.clone()])).echelon().rows;
        if grown.rows() > rows.rows() {
            rows = grown;
            picked.push(k);
        }
    }
    picked
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    /// The curve of two maps that are almost the same in the second coordinate, in units of `unit`.
    fn flat(unit: i64) -> Shape {
        let e = ratio(1, 10_000_000);
        let half = ratio(1, 2);
        let linear = |d: Rational| Matrix::from_rows(2, vec![vec![half.clone(), ratio(0, 1)], vec![ratio(0, 1), d]]);
        let maps = vec![
            Shape::affine_operator(&linear(&half - &e), &[ratio(0, 1), ratio(0, 1)]),
            Shape::affine_operator(&linear(&half + &e), &[half.clone(), e * ratio(unit, 1)]),
        ];
        Shape::single(CellKind::Edge, maps)
    }

    #[test]
    fn the_operators_do_not_depend_on_units() {
        let own = |shape: &Shape| {
            let spaces = Spaces::new(shape).unwrap();
            OwnPoints::of(shape, &spaces).unwrap().shape(shape).unwrap()
        };
        let (a, b) = (own(&flat(1)), own(&flat(10_000_000)));
        for (p, q) in a.states[0].pieces.iter().zip(&b.states[0].pieces) {
            assert_eq!(p.op, q.op);
        }
    }
}
