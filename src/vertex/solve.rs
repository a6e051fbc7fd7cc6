//! Eigenvectors of Fourier blocks.

use super::block::Block;
use super::field::{Field, NumberField};
use super::ring::Values;
use super::turning::{Rotation, Turning};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::ring::{Field as _, Ring as _};

pub(super) type Rows<E> = Vec<Vec<Turning<E>>>;

/// The entries of a block in a field.
fn whole<F: Field>(f: &F, block: &Block) -> Rows<F::E> {
    let rotation = Rotation(f);
    block.entries.iter().map(|row| row.iter().map(|e| rotation.of_symbol(e)).collect()).collect()
}

/// The entries of `entries − value` among some indices.
fn shifted<F: Field>(f: &F, entries: &Rows<F::E>, rows: &[usize], columns: &[usize], value: &F::E) -> Rows<F::E> {
    let rotation = Rotation(f);
    let entry = |i: &usize, j: &usize| {
        let own = &entries[*i][*j];
        if i == j { rotation.sub(own, &rotation.plain(value.clone())) } else { own.clone() }
    };
    rows.iter().map(|i| columns.iter().map(|j| entry(i, j)).collect()).collect()
}

/// Solves a square system; `None` where it is not certainly regular.
#[allow(clippy::needless_range_loop, reason = "two rows of one matrix are used at a time")]
fn solve<F: Field>(f: &F, mut a: Rows<F::E>, mut b: Vec<Turning<F::E>>) -> Option<Vec<Turning<F::E>>> {
    let rotation = Rotation(f);
    let n = b.len();
    for step in 0..n {
        let (pivot, inverse) = (step..n).find_map(|r| Some((r, rotation.inv(&a[r][step])?)))?;
        a.swap(step, pivot);
        b.swap(step, pivot);
        for r in step + 1..n {
            let factor = rotation.mul(&a[r][step], &inverse);
            for c in step..n {
                a[r][c] = rotation.sub(&a[r][c], &rotation.mul(&factor, &a[step][c]));
            }
            b[r] = rotation.sub(&b[r], &rotation.mul(&factor, &b[step]));
        }
        b[step] = rotation.mul(&b[step], &inverse);
        for c in step..n {
            a[step][c] = rotation.mul(&a[step][c], &inverse);
        }
    }
    for step in (0..n).rev() {
        for c in step + 1..n {
            b[step] = rotation.sub(&b[step], &rotation.mul(&a[step][c], &b[c]));
        }
    }
    Some(b)
}

/// The eigenvector of a simple eigenvalue that belongs to one part of the block; `None` where enclosures are too wide.
///
/// In the part one coordinate is 1 and one equation is left out, so that the others are regular: the one left out then
/// depends on them. Parts before are 0, parts after follow from their regular equations.
///
/// # Cost
/// Gaussian elimination in each part.
#[must_use]
pub fn eigenvector<F: Field>(f: &F, block: &Block, part: usize, value: &F::E) -> Option<Values<F::E>> {
    let parts: Vec<&[usize]> = block.parts.iter().map(|p| p.indices.as_slice()).collect();
    eigenvector_of(f, &whole(f, block), &parts, block.before, part, value)
}

/// The same of entries in the field, with the indices of the parts, and how many indices stand before the orbits.
pub(super) fn eigenvector_of<F: Field>(
    f: &F,
    entries: &Rows<F::E>,
    parts: &[&[usize]],
    before: usize,
    part: usize,
    value: &F::E,
) -> Option<Values<F::E>> {
    let rotation = Rotation(f);
    let mut v = vec![rotation.zero(); entries.len()];
    for (index, own) in parts.iter().copied().enumerate().skip(part) {
        if index == part {
            let found = own.iter().find_map(|fixed| {
                let unknown: Vec<usize> = own.iter().copied().filter(|i| i != fixed).collect();
                own.iter().find_map(|left_out| {
                    let rows: Vec<usize> = own.iter().copied().filter(|i| i != left_out).collect();
                    let a = shifted(f, entries, &rows, &unknown, value);
                    let right = shifted(f, entries, &rows, &[*fixed], value);
                    let b = right.into_iter().map(|r| rotation.sub(&rotation.zero(), &r[0])).collect();
                    Some((*fixed, unknown.clone(), solve(f, a, b)?))
                })
            })?;
            v[found.0] = rotation.plain(f.one());
            found.1.into_iter().zip(found.2).for_each(|(i, x)| v[i] = x);
        } else {
            let mut b = Vec::new();
            for i in own {
                let mut sum = rotation.zero();
                for (j, x) in v.iter().enumerate() {
                    let entry = &entries[*i][j];
                    let zero = [&entry.x, &entry.y].into_iter().all(|e| f.is_zero(e) == Some(true));
                    if !own.contains(&j) && !zero {
                        sum = rotation.sub(&sum, &rotation.mul(entry, x));
                    }
                }
                b.push(sum);
            }
            let solved = solve(f, shifted(f, entries, own, own, value), b)?;
            own.iter().zip(solved).for_each(|(i, x)| v[*i] = x);
        }
    }
    Some(split(before, v, rotation.zero()))
}

fn split<E>(before: usize, mut v: Vec<Turning<E>>, zero: Turning<E>) -> Values<E> {
    let orbits = v.split_off(before);
    Values { centre: v.pop().map_or(zero, |x| x), orbits }
}

fn product(f: &NumberField, a: &Rows<Elem>, b: &Rows<Elem>) -> Rows<Elem> {
    let rotation = Rotation(f);
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &Vec<Turning<Elem>>, j: usize| {
        row.iter().zip(b).fold(rotation.zero(), |s, (x, r)| {
            if x.x.is_zero() && x.y.is_zero() { s } else { rotation.add(&s, &rotation.mul(x, &r[j])) }
        })
    };
    a.iter().map(|row| (0..columns).map(|j| entry(row, j)).collect()).collect()
}

/// A basis of the kernel, as columns.
#[allow(clippy::needless_range_loop, reason = "two rows of one matrix are used at a time")]
fn kernel(f: &NumberField, mut a: Rows<Elem>) -> Vec<Vec<Turning<Elem>>> {
    let rotation = Rotation(f);
    let (rows, columns) = (a.len(), a.first().map_or(0, Vec::len));
    let mut pivots = Vec::new();
    let mut row = 0;
    for column in 0..columns {
        let Some((at, inverse)) = (row..rows).find_map(|r| Some((r, rotation.inv(&a[r][column])?))) else { continue };
        a.swap(row, at);
        for c in 0..columns {
            a[row][c] = rotation.mul(&a[row][c], &inverse);
        }
        for r in (0..rows).filter(|r| *r != row) {
            let factor = a[r][column].clone();
            if !(factor.x.is_zero() && factor.y.is_zero()) {
                for c in 0..columns {
                    a[r][c] = rotation.sub(&a[r][c], &rotation.mul(&factor, &a[row][c]));
                }
            }
        }
        pivots.push(column);
        row += 1;
    }
    let free = (0..columns).filter(|c| !pivots.contains(c));
    free.map(|column| {
        let mut v = vec![rotation.zero(); columns];
        v[column] = rotation.plain(f.one());
        for (r, pivot) in pivots.iter().enumerate() {
            v[*pivot] = rotation.sub(&rotation.zero(), &a[r][column]);
        }
        v
    })
    .collect()
}

/// The powers of `block − value` from the first on, until the dimension of the kernel stays: with the kernels.
fn powers(f: &NumberField, block: &Block, value: &Rational) -> Vec<(Rows<Elem>, Vec<Vec<Turning<Elem>>>)> {
    let all: Vec<usize> = (0..block.entries.len()).collect();
    let first = shifted(f, &whole(f, block), &all, &all, &f.rational(value));
    let mut list: Vec<(Rows<Elem>, Vec<Vec<Turning<Elem>>>)> = vec![(first.clone(), kernel(f, first.clone()))];
    loop {
        let next = product(f, &list[list.len() - 1].0, &first);
        let null = kernel(f, next.clone());
        if null.len() == list[list.len() - 1].1.len() {
            return list;
        }
        list.push((next, null));
    }
}

/// The sizes of the Jordan blocks of a rational eigenvalue of the block, descending.
///
/// # Cost
/// Powers and kernels over the field of the block.
#[must_use]
pub fn longest_blocks(f: &NumberField, block: &Block, value: &Rational) -> Vec<usize> {
    let dims: Vec<usize> = powers(f, block, value).iter().map(|(_, k)| k.len()).collect();
    let mut sizes = Vec::new();
    // dim ker^j − dim ker^{j−1} blocks have size at least j.
    let at_least: Vec<usize> = dims.iter().enumerate().map(|(j, d)| d - if j == 0 { 0 } else { dims[j - 1] }).collect();
    for (j, count) in at_least.iter().enumerate().rev() {
        let longer = at_least.get(j + 1).map_or(0, |count| *count);
        sizes.extend(std::iter::repeat_n(j + 1, count - longer));
    }
    sizes
}

/// The eigenvector that ends the chain of the one longest Jordan block; `None` where there are several.
#[must_use]
pub fn leading_vector(f: &NumberField, block: &Block, value: &Rational) -> Option<Values<Elem>> {
    let list = powers(f, block, value);
    let length = list.len();
    let kernel = &list[length - 1].1;
    let shorter = if length == 1 { 0 } else { list[length - 2].1.len() };
    if kernel.len() != shorter + 1 {
        return None;
    }
    let zero = Rotation(f).zero();
    if length == 1 {
        return Some(split(block.before, kernel[0].clone(), zero));
    }
    kernel.iter().find_map(|v| {
        let column: Rows<Elem> = v.iter().map(|x| vec![x.clone()]).collect();
        let image: Vec<Turning<Elem>> =
            product(f, &list[length - 2].0, &column).into_iter().map(|mut r| r.swap_remove(0)).collect();
        image.iter().any(|x| !(x.x.is_zero() && x.y.is_zero())).then(|| split(block.before, image, zero.clone()))
    })
}
