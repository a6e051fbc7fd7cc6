//! Refinement inside a junction (thesis, §5.1.3): the intermediate curve on the points of its own pieces.

use super::{Junction, JunctionError, Member, Pattern, Side};
use crate::arith::Rational;
use crate::linalg::Matrix;

impl Member {
    /// The same curve as a member of a larger family: the chain `a … a I b … b` of the pieces of `I` as one intermediate curve `I'`,
    /// which has all their points, `I' -> a^(N k) I' b^(N m)`. With `E` the transposed array, `E T' = T E` for its pieces, so that `E`
    /// takes `I'` to `I`; the piece of `I'` in itself has the nonzero eigenvalues of that of `I`. The free rows of the larger family may
    /// then be changed.
    ///
    /// # Errors
    /// [`JunctionError::Large`].
    pub fn refined_inside(&self) -> Result<Self, JunctionError> {
        let (family, array) = (&self.junction, &self.array);
        let rows = refined(family, array)?;
        let (a, b) = (&family.left, &family.right);
        let pattern = Pattern { left: family.pattern.left * a.arity(), right: family.pattern.right * b.arity() };
        let larger = Junction::new(a.clone(), b.clone(), pattern, array.rows())?;
        let forced = larger.forced()?;
        if forced.len() != rows.len() {
            return Err(JunctionError::Rows("the refined cells have another number of points".to_owned()));
        }
        let free = rows.iter().zip(&forced).filter(|(_, f)| f.is_none()).map(|(row, _)| row.clone()).collect();
        let member = Self::given(&larger, None, free)?;
        let same = (0..rows.len()).all(|i| member.array.row(i) == rows[i].as_slice());
        if same {
            Ok(member)
        } else {
            Err(JunctionError::Rows("the refined ends are not those of the schemes".to_owned()))
        }
    }
}

/// The points of the refined cells of a chain, by rows on its points; neighbours share those of the vertex between them.
fn refined(family: &Junction, array: &Matrix) -> Result<Vec<Vec<Rational>>, JunctionError> {
    let mut all: Vec<Vec<Rational>> = Vec::new();
    let k = family.pattern.left;
    for (cell, (first, len)) in family.windows().into_iter().enumerate() {
        let own = match cell.cmp(&k) {
            std::cmp::Ordering::Less => family.left.refined_points(),
            std::cmp::Ordering::Equal => array.clone(),
            std::cmp::Ordering::Greater => family.right.refined_points(),
        };
        let shared = match cell {
            0 => 0,
            c if c <= k => family.left.shared,
            _ => family.right.shared,
        };
        for i in 0..own.rows() {
            let mut row = vec![Rational::from(0); array.rows()];
            row[first..first + len].clone_from_slice(own.row(i));
            if i >= shared {
                all.push(row);
            } else if all[all.len() - shared + i] != row {
                return Err(JunctionError::Rows("neighbouring cells do not meet".to_owned()));
            }
        }
    }
    Ok(all)
}

impl Side {
    /// The points of all pieces of a cell by those of the cell, as rows.
    #[must_use]
    pub fn refined_points(&self) -> Matrix {
        let step = self.points() - self.shared;
        let row = |y: usize| {
            let piece = (y / step).min(self.arity() - 1);
            self.operators[piece].column(y - piece * step)
        };
        Matrix::from_rows(self.points(), (0..self.arity() * step + self.shared).map(row).collect())
    }
}
