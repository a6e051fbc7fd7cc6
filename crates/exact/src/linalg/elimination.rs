//! Elimination over any field, and in integers for the rationals: the reduced form is the same, and rows without common
//! factors need one gcd for a row, not three for an entry.

use crate::arith::{Integer, Rational};
use crate::ring::Field;
use malachite_base::num::arithmetic::traits::{DivExact, DivExactAssign, Gcd, SubMulAssign};
use malachite_base::num::logic::traits::SignificantBits;

/// The reduced row echelon form: its nonzero rows, with leading ones, and the columns of those (Gauss and Jordan); `None`
/// where the field cannot tell whether an entry that might become a pivot is 0.
pub(super) fn reduced<K: Field>(k: &K, mut rows: Vec<Vec<K::E>>, width: usize) -> Option<(Vec<Vec<K::E>>, Vec<usize>)> {
    let mut pivots = Vec::new();
    for col in 0..width {
        let top = pivots.len();
        let Some(found) = pivot(k, &rows[top..], col)? else { continue };
        rows.swap(top, top + found);
        let inverse = k.inv(&rows[top][col])?;
        for x in &mut rows[top][col + 1..] {
            if k.is_zero(x) != Some(true) {
                *x = k.mul(x, &inverse);
            }
        }
        rows[top][col] = k.one();
        let pivot = std::mem::take(&mut rows[top]);
        for row in rows.iter_mut().filter(|row| !row.is_empty() && k.is_zero(&row[col]) != Some(true)) {
            let factor = std::mem::replace(&mut row[col], k.zero());
            for (x, y) in row[col + 1..].iter_mut().zip(&pivot[col + 1..]) {
                if k.is_zero(y) != Some(true) {
                    *x = k.sub(x, &k.mul(&factor, y));
                }
            }
        }
        rows[top] = pivot;
        pivots.push(col);
    }
    rows.truncate(pivots.len());
    Some((rows, pivots))
}

/// The first row with an entry that is certainly not 0; `Some(None)` where all are 0, `None` where that is unknown.
fn pivot<K: Field>(k: &K, rows: &[Vec<K::E>], col: usize) -> Option<Option<usize>> {
    let zero: Vec<Option<bool>> = rows.iter().map(|row| k.is_zero(&row[col])).collect();
    match zero.iter().position(|z| *z == Some(false)) {
        Some(found) => Some(Some(found)),
        None if zero.iter().all(|z| *z == Some(true)) => Some(None),
        None => None,
    }
}

/// Integer rows in echelon form that span the same space over the rationals, and the columns of their first entries.
pub(super) fn upper(mut rows: Vec<Vec<Integer>>, width: usize) -> (Vec<Vec<Integer>>, Vec<usize>) {
    let mut pivots = Vec::new();
    rows.iter_mut().for_each(|row| make_primitive(row));
    for col in 0..width {
        let top = pivots.len();
        let candidates = (top..rows.len()).filter(|i| rows[*i][col] != 0);
        let Some(found) = candidates.min_by_key(|i| rows[*i][col].significant_bits()) else { continue };
        rows.swap(top, found);
        let (above, below) = rows.split_at_mut(top + 1);
        for row in below.iter_mut().filter(|row| row[col] != 0) {
            cancel(row, &above[top], col);
        }
        pivots.push(col);
    }
    rows.truncate(pivots.len());
    (rows, pivots)
}

/// The rows of an echelon form with zeros above the pivots as well.
pub(super) fn reduced_upper(mut rows: Vec<Vec<Integer>>, pivots: &[usize]) -> Vec<Vec<Integer>> {
    for k in (0..rows.len()).rev() {
        let (above, below) = rows.split_at_mut(k + 1);
        for (lower, col) in below.iter().zip(&pivots[k + 1..]) {
            if above[k][*col] != 0 {
                cancel(&mut above[k], lower, *col);
            }
        }
    }
    rows
}

/// The rows with leading ones.
pub(super) fn divided(rows: Vec<Vec<Integer>>, pivots: &[usize]) -> Vec<Vec<Rational>> {
    let quotient = |x: &Integer, p: &Integer| {
        if *x == 0 { Rational::from(0) } else { Rational::from_integers_ref(x, p) }
    };
    rows.iter().zip(pivots).map(|(row, p)| row.iter().map(|x| quotient(x, &row[*p])).collect()).collect()
}

/// Makes the entry of a row in a column 0 by another row, in integers without a common factor.
fn cancel(row: &mut [Integer], by: &[Integer], col: usize) {
    let common = Integer::from(row[col].unsigned_abs_ref().gcd(by[col].unsigned_abs_ref()));
    let (factor, own) = ((&row[col]).div_exact(&common), (&by[col]).div_exact(&common));
    let unit = own == 1;
    for (x, y) in row.iter_mut().zip(by) {
        if !unit && *x != 0 {
            *x *= &own;
        }
        if *y != 0 {
            x.sub_mul_assign(&factor, y);
        }
    }
    make_primitive(row);
}

/// Divides by the greatest common divisor of the entries.
fn make_primitive(row: &mut [Integer]) {
    let content = crate::poly::ints::content(row);
    if content > 1 {
        let content = Integer::from(content);
        row.iter_mut().for_each(|x| x.div_exact_assign(&content));
    }
}

#[cfg(test)]
mod tests {
    use crate::arith::ratio;
    use crate::linalg::Matrix;
    use crate::poly::modp::next_random;
    use crate::ring::Rationals;

    #[test]
    fn integers_give_the_same_form_as_the_field() {
        let mut seed = 7;
        let sizes = [(0, 3), (3, 0), (1, 1), (2, 5), (5, 2), (4, 4), (6, 9), (9, 6), (12, 12)];
        for (round, (rows, cols)) in sizes.into_iter().cycle().take(90).enumerate() {
            let mut entry = |i: usize, j: usize| {
                let r = next_random(&mut seed);
                let sparse = r.is_multiple_of(2 + round as u64 % 4);
                let size = if round % 3 == 0 { 3 } else { 1 << (round % 40) };
                if sparse {
                    ratio(0, 1)
                } else {
                    ratio((r >> 20) as i64 % size - size / 2 + (i * j) as i64 % 2, 1 + (r >> 50) as i64)
                }
            };
            let mut a = Matrix::from_fn(rows, cols, &mut entry);
            if round % 2 == 0 && rows > 2 {
                // Dependent rows: the last is a combination of two others.
                for j in 0..cols {
                    a[(rows - 1, j)] = &a[(0, j)] * ratio(2, 3) - &a[(1, j)];
                }
            }
            let (integral, plain) = (a.echelon(), a.echelon_over(&Rationals).unwrap());
            assert_eq!((&integral.rows, &integral.pivots), (&plain.rows, &plain.pivots));
            assert_eq!(a.pivots(), plain.pivots);
            assert_eq!((a.rank(), a.independent_columns()), (plain.pivots.len(), plain.pivots));
        }
    }
}
