//! What a case gives where that is not operators: the data of an interpolation, affine maps.

use super::super::document::{Block, Line, Table, code, formula, line, words};
use super::super::math::Math;
use super::super::reported::{Reported, entries, vector};
use crate::case::{Case, Convention, Origin};
use crate::linalg::Matrix;
use crate::scheme::Interpolation;

/// More maps than these are not written out; the operators are.
const MAX_MAPS: usize = 24;

/// The data or maps of the case.
pub(super) fn blocks<E: Reported>(case: &Case<E>) -> Vec<Block> {
    match (&case.scheme, case.convention) {
        (Some(Origin::Interpolation(data)), _) => interpolation(data),
        (_, Convention::Affine) => maps(case),
        _ => Vec::new(),
    }
}

/// The points, and what the function does between them.
fn interpolation(data: &Interpolation) -> Vec<Block> {
    let (x, y) = (data.abscissas(), data.values());
    let one = y.iter().all(|v| v.len() == 1);
    let value = |v: &[_]| if let [only] = v { Math::number(only) } else { Math::vector(v) };
    let factor = |m: &Matrix| if one { Math::number(&m[(0, 0)]) } else { Math::matrix(m) };
    let rows = data.factors().iter().zip(data.polynomials()).enumerate().map(|(j, (alpha, q))| {
        let parts: Vec<Math> = q.iter().map(|c| Math::polynomial(c, 'x')).collect();
        let polynomial = if let [only] = parts.as_slice() { only.clone() } else { Math::tuple(parts) };
        vec![
            code(j.to_string()),
            line("$[@,@]$", [Math::number(&x[j]), Math::number(&x[j + 1])]),
            formula(value(&y[j])),
            formula(value(&y[j + 1])),
            formula(factor(alpha)),
            formula(polynomial),
        ]
    });
    let header = vec![
        words("piece"),
        words("interval"),
        line("$y_j$", []),
        line("$y_{j+1}$", []),
        line("$α_j$", []),
        line("$q_j(x)$", []),
    ];
    vec![
        Block::text(
            "The case gives the points $(x_j,y_j)$ of a function $f$ and the factors $α_j$. With the affine map $L_j$ of the whole \
             interval onto the interval $j$, which keeps its direction, $f(L_j(x))=α_j f(x)+q_j(x)$ for a polynomial $q_j$, and the graph of $f$ goes \
             through the points:",
            [],
        ),
        Block::Table(Table { caption: Line::new(), header, rows: rows.collect() }),
    ]
}

/// The maps as they were written, read off the operators: `t` is the first column, without the coordinate of the origin, and `B`
/// what the others differ from it.
fn maps<E: Reported>(case: &Case<E>) -> Vec<Block> {
    let states = &case.shape.states;
    if states.iter().map(|s| s.pieces.len()).sum::<usize>() > MAX_MAPS {
        return Vec::new();
    }
    let mut out = Vec::new();
    for state in states {
        for (letter, piece) in state.pieces.iter().enumerate() {
            let op = &piece.op;
            let Some((rows, cols)) = op.rows().checked_sub(1).zip(op.cols().checked_sub(1)) else { continue };
            let b = Matrix::from_fn(rows, cols, |i, j| op[(i + 1, j + 1)].minus(&op[(i + 1, 0)]));
            let t: Vec<E> = (0..rows).map(|i| op[(i + 1, 0)].clone()).collect();
            let of = if states.len() > 1 { format!(" of state {}", state.name) } else { String::new() };
            let template = format!("map {letter}{of}: $x↦@x+@$");
            out.push(line(&template, [entries(&b), vector(&t)]));
        }
    }
    vec![Block::text("The maps:", []), Block::List(out)]
}
