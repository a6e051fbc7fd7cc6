//! Growing subspaces over a prime field.

use super::operator::ModOperator;

/// A subspace that the operator maps to itself.
#[derive(Default)]
pub(super) struct ModSpan {
    rows: Vec<(usize, Vec<u64>)>,
}

impl ModSpan {
    /// Adds `v, N v, ..., N^(degree - 1) v`, or nothing and returns false when one of them is not independent.
    pub fn extend(&mut self, operator: &ModOperator, mut v: Vec<u64>, degree: usize) -> bool {
        let field = &operator.field;
        let before = self.rows.len();
        for step in 0..degree {
            let mut row = v.clone();
            for (pivot, basis) in &self.rows {
                let factor = field.neg(row[*pivot]);
                if factor != 0 {
                    row.iter_mut().zip(basis).for_each(|(x, y)| *x = field.add(*x, field.mul(factor, *y)));
                }
            }
            let Some(pivot) = row.iter().position(|x| *x != 0) else {
                self.rows.truncate(before);
                return false;
            };
            let inverse = field.inverse(row[pivot]);
            row.iter_mut().for_each(|x| *x = field.mul(*x, inverse));
            self.rows.push((pivot, row));
            if step + 1 < degree {
                v = operator.apply(&v);
            }
        }
        true
    }
}
