//! The one elimination, over any field.

use crate::ring::Field;

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
