//! Shapes all of whose maps are similarities have no tangent line anywhere (theory §5, Similarities).

use super::branch::Context;
use crate::arith::Rational;
use crate::jordan::Scalar;
use crate::linalg::Matrix;

/// An invariant scalar product: `L_iᵀ gram L_i = ratio_i · gram` for the linear parts of all pieces.
#[derive(Debug, Clone)]
pub struct Similarities<E = Rational> {
    /// The positive definite matrix of the scalar product on `V` of the only state.
    pub gram: Matrix<E>,
    /// The squared ratios, by letter.
    pub squared_ratios: Vec<E>,
}

/// Looks for a scalar product on `V` for which all maps of a one-state shape are similarities, where `dim V = 2`.
///
/// In dimension 2 the squared ratio must be `|det L_i|`, so that the condition is linear in the scalar product. Only the
/// case in which it is unique up to a factor is used. `None` where there is none, or it is not looked for.
#[must_use]
pub fn similarities<E: Scalar>(cx: &Context<E>) -> Option<Similarities<E>> {
    let reachable = cx.shape.reachable();
    let [state] = reachable[..] else { return None };
    let space = cx.spaces.of(state);
    if space.basis.cols() != 2 || space.visible.rows() != 2 || (cx.from.map() * &space.basis).rank() != 2 {
        return None;
    }
    let linear: Vec<Matrix<E>> =
        cx.shape.states[state].pieces.iter().map(|p| cx.spaces.linear(&p.op, state, state)).collect();
    let determinant = |a: &Matrix<E>| a[(0, 0)].times(&a[(1, 1)]).minus(&a[(0, 1)].times(&a[(1, 0)]));
    let squared_ratios: Vec<E> = linear.iter().map(|l| determinant(l).absolute()).collect();
    if squared_ratios.iter().any(E::is_zero) {
        return None;
    }
    // Unknowns g = (g00, g01, g11); rows of Lᵀ g L − r g = 0.
    let basis = |k: usize| Matrix::from_fn(2, 2, |i, j| E::integer(i64::from(i + j == k)));
    let mut rows = Vec::new();
    for (l, r) in linear.iter().zip(&squared_ratios) {
        let images: Vec<Matrix<E>> =
            (0..3).map(|k| &(&(&l.transpose() * &basis(k)) * l) - &basis(k).scale(r)).collect();
        for (i, j) in [(0, 0), (0, 1), (1, 1)] {
            rows.push(images.iter().map(|m| m[(i, j)].clone()).collect());
        }
    }
    let kernel = Matrix::from_rows(3, rows).kernel();
    if kernel.cols() != 1 {
        return None;
    }
    let g = kernel.column(0);
    let gram = Matrix::from_fn(2, 2, |i, j| g[i + j].clone());
    if determinant(&gram).sign() <= 0 || g[0].is_zero() {
        return None;
    }
    let gram = gram.scale(&E::integer(i64::from(g[0].sign())));
    Some(Similarities { gram, squared_ratios })
}
