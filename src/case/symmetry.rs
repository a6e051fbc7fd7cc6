//! Symmetries among the maps of a set: maps some power of which is the identity, which do not contract.

use super::MAX_PIECES;
use crate::linalg::Matrix;

/// Largest order of a symmetry, and largest group of them.
const MAX_ORDER: usize = 12;
const MAX_GROUP: usize = 48;

/// A set that is written with symmetries: all `g f`, `g` in the group of the symmetries, `f` the other maps.
pub(super) struct WrittenOut {
    /// The operators, each with the number of the map `f`.
    pub operators: Vec<(usize, Matrix)>,
    /// The number of the group's elements.
    pub group: usize,
    /// Which of the maps are symmetries.
    pub symmetries: Vec<usize>,
}

/// Whether some power of an operator is the identity.
fn is_symmetry(op: &Matrix) -> bool {
    let one = Matrix::identity(op.rows());
    let mut power = op.clone();
    for _ in 0..MAX_ORDER {
        if power == one {
            return true;
        }
        power = &power * op;
    }
    false
}

/// The set without symmetries among its maps, which has every `g f` instead: the smallest closed set that contains its images under
/// the other maps and is mapped onto itself by the symmetries. `None` where no map is a symmetry, all are, or the group or the number
/// of maps is too large.
pub(super) fn written_out(operators: &[Matrix]) -> Option<WrittenOut> {
    let (symmetries, others): (Vec<usize>, Vec<usize>) =
        (0..operators.len()).partition(|&k| is_symmetry(&operators[k]));
    if symmetries.is_empty() || others.is_empty() {
        return None;
    }
    let mut group = vec![Matrix::identity(operators[0].rows())];
    let mut next = 0;
    while next < group.len() {
        for &s in &symmetries {
            let product = &operators[s] * &group[next];
            if !group.contains(&product) {
                group.push(product);
            }
        }
        if group.len() > MAX_GROUP {
            return None;
        }
        next += 1;
    }
    let mut all: Vec<(usize, Matrix)> = Vec::new();
    for g in &group {
        for &k in &others {
            let product = g * &operators[k];
            if all.iter().all(|(_, known)| *known != product) {
                all.push((k, product));
            }
        }
    }
    (all.len() <= MAX_PIECES).then_some(WrittenOut { operators: all, group: group.len(), symmetries })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{Rational, ratio};
    use crate::shape::Shape;

    fn op(linear: [[i64; 2]; 2], over: i64, shift: [i64; 2]) -> Matrix {
        let linear = Matrix::from_fn(2, 2, |i, j| ratio(linear[i][j], over));
        Shape::affine_operator(&linear, &shift.map(Rational::from))
    }

    #[test]
    fn a_group_of_symmetries() {
        let small = op([[1, 0], [0, 1]], 3, [1, 0]);
        let (turn, mirror) = (op([[0, -1], [1, 0]], 1, [0, 0]), op([[1, 0], [0, -1]], 1, [0, 0]));
        let found = written_out(&[turn.clone(), small.clone(), mirror]).unwrap();
        // The mirror keeps the point of the one map and not the map: all products are different.
        assert_eq!((found.group, found.operators.len(), found.symmetries), (8, 8, vec![0, 2]));
        assert!(written_out(std::slice::from_ref(&small)).is_none());
        assert!(written_out(std::slice::from_ref(&turn)).is_none());
        // A shear has no finite order.
        assert!(written_out(&[small, op([[1, 1], [0, 1]], 1, [0, 0])]).is_none());
    }
}
