//! Random automata of curves: states of different dimensions, pieces that meet, some run backwards, some states transient.

use proptest::prelude::*;
use secant::arith::{Rational, ratio};
use secant::linalg::Matrix;
use secant::shape::{CellKind, Frame, Piece, Shape, State};

/// What a random automaton is made from.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Number of coordinates of each state; the first and the last are the end points.
    pub dims: Vec<usize>,
    /// By state, target and sense of each piece.
    pub pieces: Vec<Vec<(usize, bool)>>,
    /// Small integers from which the columns are made.
    pub digits: Vec<i64>,
    /// Dimension of the space of the control points, 0 for none.
    pub space: usize,
}

/// Automata of 1 to 3 states with 2 to 4 coordinates, seen through control points on the line, in the plane, in space, or as
/// they are.
pub fn plans() -> impl Strategy<Value = Plan> {
    (1usize..=3).prop_flat_map(|n| {
        let piece = (0..n, any::<bool>());
        let pieces = prop::collection::vec(prop::collection::vec(piece, 2..=3), n);
        let dims = prop::collection::vec(2usize..=4, n);
        (dims, pieces, prop::collection::vec(-2i64..=6, 160), 0usize..=3)
            .prop_map(|(dims, pieces, digits, space)| Plan { dims, pieces, digits, space })
    })
}

/// The automaton of a plan. Its pieces meet in points of the affine hull; it need not contract.
pub fn automaton(plan: &Plan) -> Shape {
    let mut digits = plan.digits.iter().copied().cycle();
    let mut column = |n: usize| {
        let mut entries: Vec<i64> = (0..n).map(|_| digits.next().unwrap()).collect();
        if entries.iter().sum::<i64>() <= 0 {
            entries.iter_mut().for_each(|x| *x = x.abs() + 1);
        }
        let total = entries.iter().sum::<i64>();
        entries.into_iter().map(|x| ratio(x, total)).collect::<Vec<Rational>>()
    };
    let mut states = Vec::new();
    for (e, pieces) in plan.pieces.iter().enumerate() {
        let dim = plan.dims[e];
        let unit = |k: usize| (0..dim).map(|i| Rational::from(u8::from(i == k))).collect::<Vec<_>>();
        let mut meet = vec![unit(0)];
        meet.extend((1..pieces.len()).map(|_| column(dim)));
        meet.push(unit(dim - 1));
        let make = |(k, &(target, reversed)): (usize, &(usize, bool))| {
            let (mut first, mut last) = (meet[k].clone(), meet[k + 1].clone());
            if reversed {
                std::mem::swap(&mut first, &mut last);
            }
            let mut columns = vec![first];
            columns.extend((2..plan.dims[target]).map(|_| column(dim)));
            columns.push(last);
            Piece { target, op: Matrix::from_columns(dim, &columns), reversed, share: None }
        };
        let pieces = pieces.iter().enumerate().map(make).collect();
        states.push(State { name: format!("s{e}"), kind: CellKind::Edge, dim, pieces, left: None, right: None });
    }
    let control = (plan.space > 0).then(|| {
        let columns: Vec<Vec<Rational>> =
            (0..plan.dims[0]).map(|_| (0..plan.space).map(|_| ratio(digits.next().unwrap(), 1)).collect()).collect();
        Matrix::from_columns(plan.space, &columns)
    });
    Shape { states, start: 0, control, frame: Frame::Barycentric }
}
