//! Cells that are more than a point on every level (theory §9, Tensor products).

use super::{Shape, Spaces};
use crate::linalg::Matrix;

/// Why no cell of any level is a point: outside these subspaces no operator takes a vector into one of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SolidCells {
    /// The dimensions of the subspaces, by reachable state, below those of the spaces.
    pub dims: Vec<usize>,
    /// Whether they are subspaces of the rows, on which the operators act from the right.
    pub rows: bool,
}

impl Shape {
    /// A reason why `T_w V ≠ 0` for all words `w` that begin at a reachable state; `None` where none is found (that there is none is
    /// undecidable in general).
    ///
    /// # Cost
    /// At most as many eliminations for each piece as the sum of the dimensions.
    #[must_use]
    pub fn solid_cells(&self, spaces: &Spaces) -> Option<SolidCells> {
        let states = self.reachable();
        let sizes: Vec<usize> = states.iter().map(|&e| spaces.of(e).basis.cols()).collect();
        let mut down = Vec::new();
        for (from, &e) in states.iter().enumerate() {
            for piece in &self.states[e].pieces {
                let to = states.iter().position(|s| *s == piece.target)?;
                let linear = &(&spaces.of(e).coordinates * &piece.op) * &spaces.of(piece.target).basis;
                down.push((to, from, linear));
            }
        }
        let up: Vec<_> = down.iter().map(|(to, from, linear)| (*from, *to, linear.transpose())).collect();
        let found =
            |maps: &[(usize, usize, Matrix)], rows: bool| Some(SolidCells { dims: avoided(&sizes, maps)?, rows });
        found(&down, false).or_else(|| found(&up, true))
    }
}

/// The dimensions of the smallest subspaces `K` that hold the vectors that a map `(from, to, M)` takes from `from` into `K` of `to`;
/// `None` where one of them is everything.
fn avoided(sizes: &[usize], maps: &[(usize, usize, Matrix)]) -> Option<Vec<usize>> {
    let mut spaces: Vec<Matrix> = sizes.iter().map(|&n| Matrix::zero(0, n)).collect();
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for (from, to, map) in maps {
            crate::stop::check();
            // M x + K y = 0.
            let solutions = map.beside(&spaces[*to].transpose()).kernel();
            let taken = Matrix::from_fn(solutions.cols(), sizes[*from], |i, j| solutions[(j, i)].clone());
            let joined = spaces[*from].stack(&taken).echelon().rows;
            grown |= joined.rows() > spaces[*from].rows();
            spaces[*from] = joined;
        }
    }
    let dims: Vec<usize> = spaces.iter().map(Matrix::rows).collect();
    dims.iter().zip(sizes).all(|(k, n)| k < n).then_some(dims)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::shape::CellKind;

    /// A curve of maps `x ↦ f(x) d`, `f` a row and `d` a column, one behind the other.
    fn rank_one(maps: &[([i64; 2], [i64; 2])]) -> Shape {
        let mut at = [0, 0];
        let operators = maps.iter().map(|(d, f)| {
            let linear = Matrix::from_fn(2, 2, |i, j| ratio(d[i] * f[j], 3));
            let operator = Shape::affine_operator(&linear, &at.map(|x| ratio(x, 3)));
            at = [at[0] + d[0], at[1] + d[1]];
            operator
        });
        Shape::single(CellKind::Edge, operators.collect())
    }

    fn found(shape: &Shape) -> Option<SolidCells> {
        shape.solid_cells(&Spaces::new(shape).unwrap())
    }

    #[test]
    fn products_that_vanish_and_products_that_do_not() {
        let (d, f) = ([1, 0], [1, 0]);
        // The first operator kills the image of the second one.
        let vanishing = rank_one(&[(d, [1, -1]), ([1, 1], f), ([1, -1], f)]);
        assert_eq!(found(&vanishing), None);
        // The first coordinate shrinks to a third; all kernels are the other axis.
        let kept = rank_one(&[(d, f), ([1, 1], f), ([1, -1], f)]);
        assert_eq!(found(&kept), Some(SolidCells { dims: vec![1], rows: false }));
        // The kernels span the plane, but all operators keep the first axis and shrink it to a third.
        let operator = |rows: [[i64; 2]; 2], shift: i64| {
            Shape::affine_operator(
                &Matrix::from_fn(2, 2, |i, j| ratio(rows[i][j], 3)),
                &[ratio(shift, 3), ratio(shift, 3)],
            )
        };
        let axis = [operator([[1, 1], [0, 0]], 0), operator([[1, -1], [0, 0]], 0), operator([[1, 0], [0, 1]], 1)];
        assert_eq!(found(&Shape::single(CellKind::Set, axis.to_vec())), Some(SolidCells { dims: vec![1], rows: true }));
        let half = |shift| Shape::affine_operator(&Matrix::from_fn(1, 1, |_, _| ratio(1, 2)), &[ratio(shift, 2)]);
        let injective = Shape::single(CellKind::Edge, vec![half(0), half(1)]);
        assert_eq!(found(&injective), Some(SolidCells { dims: vec![0], rows: false }));
    }
}
