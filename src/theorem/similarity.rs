//! Shapes all of whose maps are similarities have no tangent line anywhere (theory §5, Similarities).

use super::branch::Context;
use crate::arith::Rational;
use crate::linalg::Matrix;

/// An invariant scalar product: `L_iᵀ gram L_i = ratio_i · gram` for the linear parts of all pieces.
#[derive(Debug, Clone)]
pub struct Similarities {
    /// The positive definite matrix of the scalar product on `V` of the only state.
    pub gram: Matrix,
    /// The squared ratios, by letter.
    pub squared_ratios: Vec<Rational>,
}

/// Looks for a scalar product on `V` for which all maps of a one-state shape are similarities, where `dim V = 2`.
///
/// In dimension 2 the squared ratio must be `|det L_i|`, so that the condition is linear in the scalar product. Only the
/// case in which it is unique up to a factor is used. `None` where there is none, or it is not looked for.
#[must_use]
pub fn similarities(cx: &Context) -> Option<Similarities> {
    let reachable = cx.shape.reachable();
    let [state] = reachable[..] else { return None };
    let space = cx.spaces.of(state);
    if space.basis.cols() != 2 || space.visible.rows() != 2 || (cx.from.map() * &space.basis).rank() != 2 {
        return None;
    }
    let linear: Vec<Matrix> =
        cx.shape.states[state].pieces.iter().map(|p| cx.spaces.linear(&p.op, state, state)).collect();
    let squared_ratios: Vec<Rational> =
        linear.iter().map(|l| crate::arith::abs(&(&l[(0, 0)] * &l[(1, 1)] - &l[(0, 1)] * &l[(1, 0)]))).collect();
    if squared_ratios.iter().any(|r| *r == 0) {
        return None;
    }
    // Unknowns g = (g00, g01, g11); rows of Lᵀ g L − r g = 0.
    let basis = |k: usize| Matrix::from_fn(2, 2, |i, j| Rational::from(u8::from(i + j == k)));
    let mut rows = Vec::new();
    for (l, r) in linear.iter().zip(&squared_ratios) {
        let images: Vec<Matrix> = (0..3).map(|k| &(&(&l.transpose() * &basis(k)) * l) - &basis(k).scale(r)).collect();
        for (i, j) in [(0, 0), (0, 1), (1, 1)] {
            rows.push(images.iter().map(|m| m[(i, j)].clone()).collect());
        }
    }
    let kernel = Matrix::from_rows(3, rows).kernel();
    if kernel.cols() != 1 {
        return None;
    }
    let g = kernel.column(0);
    let determinant = &g[0] * &g[2] - &g[1] * &g[1];
    if determinant <= 0 || g[0] == 0 {
        return None;
    }
    let positive = crate::arith::sign(&g[0]);
    let gram = Matrix::from_fn(2, 2, |i, j| &g[i + j] * Rational::from(positive));
    Some(Similarities { gram, squared_ratios })
}
