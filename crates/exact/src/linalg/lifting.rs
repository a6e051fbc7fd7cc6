//! Kernels of integer matrices by p-adic lifting: one inverse modulo one prime, then a digit of the solution at a time.
//!
//! Source: J. D. Dixon, *Exact solution of linear equations using p-adic expansions*, Numer. Math. 40 (1982).

use super::echelon::ModEchelon;
use super::reconstruct::Residues;
use crate::arith::Integer;
use crate::arith::modular::PrimeField;
use malachite_base::num::arithmetic::traits::AddMulAssign;

/// A square integer matrix with the echelon form of its residues.
pub(crate) struct Lifting<'a> {
    rows: &'a [Vec<(usize, i64)>],
    field: PrimeField,
    pivots: &'a [usize],
    /// Rows that are independent modulo the prime, as many as there are pivots.
    chosen: Vec<usize>,
    /// The inverse, modulo the prime, of the chosen rows at the pivots.
    inverse: Vec<Vec<u64>>,
    /// Digits that are enough for every solution.
    enough: usize,
}

/// The kernel vector with a 1 at one free column: what is known of it so far.
pub(crate) struct Lifted {
    free: usize,
    residual: Vec<i128>,
    values: Vec<Integer>,
}

/// Rows whose absolute values add up to less than this can be lifted in 128 bits.
const SHORT: u64 = 1 << 60;

/// Whether a row can be lifted in 128 bits.
pub(crate) fn is_short(row: &[(usize, i64)]) -> bool {
    row.iter().map(|(_, x)| u128::from(x.unsigned_abs())).sum::<u128>() < u128::from(SHORT)
}

/// The entries as words, where all rows are short.
pub(crate) fn words(rows: &[Vec<(usize, Integer)>]) -> Option<Vec<Vec<(usize, i64)>>> {
    let word = |(j, x): &(usize, Integer)| i64::try_from(x).ok().map(|x| (*j, x));
    let row =
        |row: &Vec<(usize, Integer)>| row.iter().map(word).collect::<Option<Vec<_>>>().filter(|row| is_short(row));
    rows.iter().map(row).collect()
}

impl<'a> Lifting<'a> {
    /// `None` where the pivots are not those of the matrix.
    pub fn new(rows: &'a [Vec<(usize, i64)>], field: PrimeField, pivots: &'a [usize]) -> Option<Self> {
        let n = rows.len();
        let mut place = vec![None; n];
        pivots.iter().enumerate().for_each(|(k, p)| place[*p] = Some(k));
        let residue = |x: i64| {
            let size = field.from_u64(x.unsigned_abs());
            if x < 0 { field.neg(size) } else { size }
        };
        // The pivot columns as rows: their pivots are independent rows of the matrix.
        let mut transposed = vec![vec![0; n]; pivots.len()];
        for (i, row) in rows.iter().enumerate() {
            for (j, x) in row {
                if let Some(k) = place[*j] {
                    transposed[k][i] = residue(*x);
                }
            }
        }
        let chosen = ModEchelon::new(&field, transposed.clone()).pivots;
        if chosen.len() != pivots.len() {
            return None;
        }
        let square = chosen.iter().map(|i| transposed.iter().map(|column| column[*i]).collect()).collect();
        let inverse = inverse(&field, square)?;
        let bits: u64 = rows.iter().map(|row| u64::from(64 - row_sum(row).leading_zeros()) + 1).sum();
        let enough = 2 * (bits as usize + 64) / 61 + 2;
        Some(Self { rows, field, pivots, chosen, inverse, enough })
    }

    pub fn start(&self, free: usize) -> Lifted {
        let entry = |i: &usize| self.rows[*i].iter().find(|(j, _)| *j == free).map_or(0, |(_, x)| -i128::from(*x));
        let residual = self.chosen.iter().map(entry).collect();
        Lifted { free, residual, values: vec![Integer::from(0); self.pivots.len()] }
    }

    pub fn enough(&self) -> usize {
        self.enough
    }

    /// One more digit; `power` is the prime to the number of the digits so far.
    pub fn step(&self, lifted: &mut Lifted, power: &Integer) {
        let (field, p) = (&self.field, i128::from(self.field.modulus()));
        let residue = |x: &i128| field.from_u64(x.rem_euclid(p) as u64);
        let right: Vec<u64> = lifted.residual.iter().map(residue).collect();
        let digits: Vec<i64> = self.inverse.iter().map(|row| field.to_signed(field.dot(row, &right))).collect();
        let mut full = vec![0i64; self.rows.len()];
        self.pivots.iter().zip(&digits).for_each(|(j, d)| full[*j] = *d);
        for (r, i) in lifted.residual.iter_mut().zip(&self.chosen) {
            let image: i128 = self.rows[*i].iter().map(|(j, x)| i128::from(*x) * i128::from(full[*j])).sum();
            *r = (*r - image) / p;
        }
        for (value, digit) in lifted.values.iter_mut().zip(&digits) {
            value.add_mul_assign(power, Integer::from(*digit));
        }
    }

    /// The kernel vector modulo a power of the prime.
    pub fn residues(&self, lifted: &Lifted, power: &Integer) -> Residues {
        let mut coeffs = vec![Integer::from(0); self.rows.len()];
        coeffs[lifted.free] = Integer::from(1);
        self.pivots.iter().zip(&lifted.values).for_each(|(j, x)| coeffs[*j] = x.clone());
        Residues::new(coeffs, power.clone())
    }
}

fn row_sum(row: &[(usize, i64)]) -> u64 {
    row.iter().map(|(_, x)| x.unsigned_abs()).sum()
}

/// Gauss and Jordan; `None` for a singular matrix.
fn inverse(field: &PrimeField, mut m: Vec<Vec<u64>>) -> Option<Vec<Vec<u64>>> {
    let n = m.len();
    for (i, row) in m.iter_mut().enumerate() {
        row.resize(2 * n, 0);
        row[n + i] = field.one();
    }
    for col in 0..n {
        let found = (col..n).find(|i| m[*i][col] != 0)?;
        m.swap(col, found);
        // Row operations reach column n + col only, as long as no rows were exchanged; all of them are done.
        let scale = field.inverse(m[col][col]);
        m[col][col..].iter_mut().for_each(|x| *x = field.mul(*x, scale));
        let pivot = std::mem::take(&mut m[col]);
        for row in m.iter_mut().filter(|row| !row.is_empty() && row[col] != 0) {
            let factor = field.neg(row[col]);
            for (x, y) in row[col..].iter_mut().zip(&pivot[col..]) {
                *x = field.add(*x, field.mul(factor, *y));
            }
        }
        m[col] = pivot;
    }
    Some(m.into_iter().map(|row| row[n..].to_vec()).collect())
}
