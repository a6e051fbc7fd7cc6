//! Row echelon forms over a prime field.

use crate::arith::modular::PrimeField;

/// The nonzero rows of an echelon form, with leading ones, and their columns.
pub(crate) struct ModEchelon {
    rows: Vec<Vec<u64>>,
    pub pivots: Vec<usize>,
    width: usize,
}

impl ModEchelon {
    pub fn new(field: &PrimeField, mut m: Vec<Vec<u64>>) -> Self {
        let width = m.first().map_or(0, Vec::len);
        let mut rows: Vec<Vec<u64>> = Vec::new();
        let mut pivots = Vec::new();
        for col in 0..width {
            let Some(found) = m.iter().position(|row| row[col] != 0) else { continue };
            let mut top = m.swap_remove(found);
            let inverse = field.inverse(top[col]);
            top[col..].iter_mut().for_each(|x| *x = field.mul(*x, inverse));
            for row in m.iter_mut().filter(|row| row[col] != 0) {
                let factor = field.neg(row[col]);
                for (x, y) in row[col..].iter_mut().zip(&top[col..]) {
                    *x = field.add(*x, field.mul(factor, *y));
                }
            }
            rows.push(top);
            pivots.push(col);
            if m.is_empty() {
                break;
            }
        }
        Self { rows, pivots, width }
    }

    pub fn nullity(&self) -> usize {
        self.width - self.pivots.len()
    }

    pub fn free_columns(&self) -> impl Iterator<Item = usize> {
        let mut pivots = self.pivots.iter().peekable();
        (0..self.width).filter(move |c| pivots.next_if(|p| *p == c).is_none())
    }

    /// The vector of the kernel with a 1 at one free column and 0 at the others.
    pub fn kernel_vector(&self, field: &PrimeField, free: usize) -> Vec<u64> {
        let mut v = vec![0; self.width];
        v[free] = field.one();
        for (row, &pivot) in self.rows.iter().zip(&self.pivots).rev() {
            if pivot < free {
                v[pivot] = field.neg(field.dot(&row[pivot + 1..=free], &v[pivot + 1..=free]));
            }
        }
        v
    }
}
