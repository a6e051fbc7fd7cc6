//! Exact matrices over the rational numbers or a real number field: integers, or elements with integer coefficients, over one
//! denominator, so that products need no reduction.

use super::number::{gcd, lcm, ratio};
use super::whole::{Fraction, Whole, absolute, content};
use super::{Checked, Q, charge, spend};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::ops::Range;

/// Makes entry `j` of a row 0 by another row.
fn clear<T: Whole>(row: &mut Vec<T>, by: &[T], j: usize) -> Checked<()> {
    if row[j].vanishes() {
        return Ok(());
    }
    let (own, factor) = (by[j].clone(), row[j].clone());
    let entry = |(x, p): (&T, &T)| match (x.vanishes(), p.vanishes()) {
        (true, true) => x.clone(),
        (false, true) => x.times(&own),
        _ => x.times(&own).minus(&factor.times(p)),
    };
    *row = T::short(row.iter().zip(by).map(entry).collect())?;
    Ok(())
}

/// A matrix, stored by rows; a point is a matrix with one column.
#[derive(Debug, Clone)]
pub struct Matrix<T = BigInt> {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub cols: usize,
    /// The entries times the denominator.
    pub data: Vec<T>,
    /// The denominator, positive.
    pub den: BigInt,
}

impl<T: Whole> PartialEq for Matrix<T> {
    fn eq(&self, other: &Self) -> bool {
        let same = |(a, b): (&T, &T)| a.multiple(&other.den).minus(&b.multiple(&self.den)).vanishes();
        (self.rows, self.cols) == (other.rows, other.cols) && self.data.iter().zip(&other.data).all(same)
    }
}

impl Matrix {
    /// The matrix with the given entries, row after row.
    pub fn new(rows: usize, cols: usize, entries: &[Q]) -> Self {
        let den = entries.iter().fold(BigInt::one(), |l, x| if charge(1, l.bits()) { lcm(&l, x.denom()) } else { l });
        charge(entries.len(), den.bits());
        Self { rows, cols, data: entries.iter().map(|x| x.numer() * (&den / x.denom())).collect(), den }
    }

    /// The matrix with the given rows, each of length `cols`.
    pub fn from_rows(cols: usize, rows: &[Vec<Q>]) -> Self {
        Self::new(rows.len(), cols, &rows.concat())
    }

    /// The entry in row `i` and column `j`.
    pub fn at(&self, i: usize, j: usize) -> Q {
        ratio(self.data[i * self.cols + j].clone(), self.den.clone())
    }

    /// The sum of the absolute values of all entries.
    pub fn norm(&self) -> Q {
        ratio(self.data.iter().map(Signed::abs).sum(), self.den.clone())
    }
}

impl<T: Whole> Matrix<T> {
    /// The matrix with the given entries over positive denominators, row after row.
    pub fn fractions(rows: usize, cols: usize, entries: &[Fraction<T>]) -> Self {
        let den = entries.iter().fold(BigInt::one(), |l, x| if charge(1, l.bits()) { lcm(&l, &x.1) } else { l });
        charge(entries.len(), den.bits());
        Self { rows, cols, data: entries.iter().map(|(x, d)| x.multiple(&(&den / d))).collect(), den }
    }

    /// The same matrix over a larger ring.
    pub fn lifted(matrix: &Matrix) -> Self {
        let data = matrix.data.iter().map(|x| T::integer(x.clone())).collect();
        Self { rows: matrix.rows, cols: matrix.cols, data, den: matrix.den.clone() }
    }

    /// The matrix with 1 where `f(row, column)` holds and 0 elsewhere.
    pub fn ones(rows: usize, cols: usize, f: impl Fn(usize, usize) -> bool) -> Self {
        let entry = |k: usize| T::integer(BigInt::from(u8::from(f(k / cols, k % cols))));
        Self { rows, cols, data: (0..rows * cols).map(entry).collect(), den: BigInt::one() }
    }

    /// The identity.
    pub fn identity(n: usize) -> Self {
        Self::ones(n, n, |i, j| i == j)
    }

    /// The matrix with 0 everywhere.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Self::ones(rows, cols, |_, _| false)
    }

    /// The row of `n` ones.
    pub fn row_of_ones(n: usize) -> Self {
        Self::ones(1, n, |_, _| true)
    }

    /// The matrix with no rows.
    pub fn empty(cols: usize) -> Self {
        Self::zeros(0, cols)
    }

    /// The numerators of row `i`.
    pub fn integers(&self, i: usize) -> &[T] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// The matrix of one row.
    pub fn row(&self, i: usize) -> Self {
        Self { rows: 1, cols: self.cols, data: self.integers(i).to_vec(), den: self.den.clone() }
    }

    /// The matrix of these columns.
    pub fn columns(&self, chosen: &[usize]) -> Self {
        let entries = (0..self.rows).flat_map(|i| chosen.iter().map(move |&j| self.data[i * self.cols + j].clone()));
        Self { rows: self.rows, cols: chosen.len(), data: entries.collect(), den: self.den.clone() }
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        let data = (0..self.data.len()).map(|k| self.data[k % self.rows * self.cols + k / self.rows].clone());
        Self { rows: self.cols, cols: self.rows, data: data.collect(), den: self.den.clone() }
    }

    /// The submatrix of these ranges of rows and columns.
    pub fn part(&self, rows: Range<usize>, cols: Range<usize>) -> Self {
        let data = rows.clone().flat_map(|i| self.integers(i)[cols.clone()].to_vec()).collect();
        Self { rows: rows.len(), cols: cols.len(), data, den: self.den.clone() }
    }

    /// Whether every column adds up to 1.
    pub fn is_affine(&self) -> bool {
        let one = T::integer(self.den.clone());
        let rest = |j: usize| (0..self.rows).fold(one.clone(), |rest, i| rest.minus(&self.data[i * self.cols + j]));
        (0..self.cols).all(|j| rest(j).vanishes())
    }

    /// Whether some entry is negative.
    pub fn has_negative(&self) -> bool {
        self.data.iter().any(|x| x.sgn() < 0)
    }

    /// Whether all entries are positive.
    pub fn all_positive(&self) -> bool {
        self.data.iter().all(|x| x.sgn() > 0)
    }

    /// Whether all entries are 0.
    pub fn is_zero(&self) -> bool {
        self.data.iter().all(T::vanishes)
    }

    /// The largest size of the integers in bits.
    pub fn bits(&self) -> u64 {
        widest(&self.data).max(self.den.bits())
    }

    /// The sum of the absolute values of all entries, over the denominator.
    pub fn size(&self) -> T {
        self.data.iter().fold(T::integer(BigInt::zero()), |sum, x| sum.plus(&absolute(x)))
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Checked<Self> {
        spend(self.rows * self.cols * other.cols, self.bits().max(other.bits()))?;
        let den = &self.den * &other.den;
        if let Some(data) = T::product_of_words(self, other) {
            return Ok(Self { rows: self.rows, cols: other.cols, data, den });
        }
        let mut data = Vec::with_capacity(self.rows * other.cols);
        for i in 0..self.rows {
            let used: Vec<(usize, &T)> = self.integers(i).iter().enumerate().filter(|(_, a)| !a.vanishes()).collect();
            for j in 0..other.cols {
                let mut sum = T::integer(BigInt::zero());
                for (k, a) in &used {
                    sum.add_product(a, &other.data[k * other.cols + j]);
                }
                data.push(sum);
            }
        }
        Ok(Self { rows: self.rows, cols: other.cols, data, den })
    }

    /// `self + factor · other`.
    pub fn plus(&self, factor: &Q, other: &Self) -> Self {
        let own = &other.den * factor.denom();
        let den = lcm(&own, &self.den);
        charge(self.data.len(), den.bits());
        let (a, b) = (&den / &self.den, &den / &own * factor.numer());
        let data = self.data.iter().zip(&other.data).map(|(x, y)| x.multiple(&a).plus(&y.multiple(&b))).collect();
        Self { rows: self.rows, cols: self.cols, data, den }
    }

    /// `self − other`.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&-Q::one(), other)
    }

    /// The multiple by a number.
    pub fn scaled(&self, factor: &Q) -> Self {
        let data = self.data.iter().map(|x| x.multiple(factor.numer())).collect();
        Self { data, den: &self.den * factor.denom(), ..*self }
    }

    /// The multiple by the only entry of a matrix.
    pub fn multiple(&self, number: &Self) -> Self {
        let data = self.data.iter().flat_map(|x| number.data.iter().map(|y| x.times(y))).collect();
        Self { data, den: &self.den * &number.den, ..*self }
    }

    /// The rows of `self` followed by those of `below`.
    pub fn stack(&self, below: &Self) -> Self {
        let den = lcm(&self.den, &below.den);
        let (a, b) = (&den / &self.den, &den / &below.den);
        let own = self.data.iter().map(|x| x.multiple(&a));
        let data = own.chain(below.data.iter().map(|x| x.multiple(&b))).collect();
        Self { rows: self.rows + below.rows, cols: self.cols, data, den }
    }

    /// The columns of `self` followed by those of `right`.
    pub fn beside(&self, right: &Self) -> Self {
        self.transpose().stack(&right.transpose()).transpose()
    }

    /// Whether a symmetric matrix is positive definite, or only semidefinite where `strictly` is false: elimination without
    /// exchanges.
    pub fn is_positive(&self, strictly: bool) -> Checked<bool> {
        let mut a = self.data.clone();
        for n in (1..=self.rows).rev() {
            spend(2 * n * n, widest(&a))?;
            let sign = a[0].sgn();
            if sign < 0 || sign == 0 && (strictly || a[..n].iter().any(|x| !x.vanishes())) {
                return Ok(false);
            }
            // The row and the column of a pivot 0 are 0.
            let pivot = if sign == 0 { T::integer(BigInt::one()) } else { a[0].clone() };
            let rest = (1..n).flat_map(|i| (1..n).map(move |j| (i, j)));
            let schur = |(i, j): (usize, usize)| pivot.times(&a[i * n + j]).minus(&a[i * n].times(&a[j]));
            a = T::short(rest.map(schur).collect())?;
        }
        Ok(true)
    }

    /// The nonzero rows of the reduced row echelon form, and the columns of their leading ones.
    pub fn echelon(&self) -> Checked<(Self, Vec<usize>)> {
        let short = |i: usize| T::short(self.integers(i).to_vec());
        let mut rows = (0..self.rows).map(short).collect::<Checked<Vec<Vec<T>>>>()?;
        let mut pivots = Vec::new();
        for j in 0..self.cols {
            let top = pivots.len();
            let Some(found) = (top..rows.len()).find(|&i| !rows[i][j].vanishes()) else { continue };
            rows.swap(top, found);
            let bits = widest(rows.iter().flatten());
            spend(rows.len() * self.cols, bits)?;
            let (above, below) = rows.split_at_mut(top + 1);
            below.iter_mut().try_for_each(|row| clear(row, &above[top], j))?;
            pivots.push(j);
        }
        rows.truncate(pivots.len());
        // From the last row upwards those below have zeros at the pivots between.
        for i in (0..rows.len()).rev() {
            let (above, below) = rows.split_at_mut(i + 1);
            spend(below.len() * self.cols, widest(above[i].iter().chain(below.iter().flatten())))?;
            below.iter().zip(&pivots[i + 1..]).try_for_each(|(lower, &j)| clear(&mut above[i], lower, j))?;
        }
        let mut inverses = Vec::new();
        for (&j, row) in pivots.iter().zip(&rows) {
            inverses.push(row[j].reciprocal()?);
        }
        let den = inverses.iter().fold(BigInt::one(), |l, (_, size)| lcm(&l, size));
        let scaled = inverses.iter().zip(&rows).flat_map(|((inverse, size), row)| {
            let factor = inverse.multiple(&(&den / size));
            row.iter().map(move |x| x.times(&factor))
        });
        Ok((Self { rows: pivots.len(), cols: self.cols, data: scaled.collect(), den }, pivots))
    }

    /// The rank.
    pub fn rank(&self) -> Checked<usize> {
        Ok(self.echelon()?.1.len())
    }

    /// The smallest row space, in echelon form, that holds these rows and is closed under multiplication by `matrix` from
    /// the right.
    pub fn hull(&self, matrix: &Self) -> Checked<(Self, Vec<usize>)> {
        let (mut rows, mut pivots) = self.echelon()?;
        while let Some(grown) = rows.joined(&rows.times(matrix)?)? {
            (rows, pivots) = grown;
        }
        Ok((rows, pivots))
    }

    /// The echelon form of these rows, which are in that form, and of others; `None` where the others are combinations.
    pub fn joined(&self, others: &Self) -> Checked<Option<(Self, Vec<usize>)>> {
        // No row of an echelon form is 0.
        let pivots: Vec<usize> =
            (0..self.rows).flat_map(|i| self.integers(i).iter().position(|x| !x.vanishes())).collect();
        if pivots.len() == self.cols || others.columns(&pivots).times(self)? == *others {
            return Ok(None);
        }
        Ok(Some(self.stack(others).echelon()?))
    }

    /// The power with a natural exponent.
    pub fn power(&self, exponent: usize) -> Checked<Self> {
        (0..exponent).try_fold(Self::identity(self.rows), |p, _| p.times(self))
    }

    /// A basis of the kernel, as rows.
    pub fn kernel(&self) -> Checked<Self> {
        let (rows, pivots) = self.echelon()?;
        let free: Vec<usize> = (0..self.cols).filter(|j| !pivots.contains(j)).collect();
        let mut data = vec![T::integer(BigInt::zero()); free.len() * self.cols];
        for (k, &j) in free.iter().enumerate() {
            data[k * self.cols + j] = T::integer(rows.den.clone());
            for (i, &p) in pivots.iter().enumerate() {
                data[k * self.cols + p] = rows.data[i * self.cols + j].multiple(&-BigInt::one());
            }
        }
        Ok(Self { rows: free.len(), cols: self.cols, data, den: rows.den })
    }

    /// The only solution `X` of `self X = right`, if there is exactly one.
    pub fn solve(&self, right: &Self) -> Checked<Option<Self>> {
        let n = self.cols;
        let (rows, pivots) = self.beside(right).echelon()?;
        Ok(pivots.into_iter().eq(0..n).then(|| rows.part(0..n, n..n + right.cols)))
    }

    /// The only point with coordinate sum 1 that is mapped to itself, if there is exactly one.
    pub fn fixed_point(&self) -> Checked<Option<Self>> {
        let n = self.rows;
        let equations = self.minus(&Self::identity(n)).stack(&Self::row_of_ones(n));
        Ok(equations.solve(&Self::ones(n + 1, 1, |i, _| i == n))?.map(Self::reduced))
    }

    /// The same matrix over its least denominator.
    pub fn reduced(mut self) -> Self {
        let common = gcd(&content(&self.data), &self.den);
        self.data.iter_mut().for_each(|x| *x = x.over(&common));
        Self { den: self.den / common, ..self }
    }

    /// The coefficients of the characteristic polynomial `det(x − self)` as a row, lowest first (Faddeev and LeVerrier).
    pub fn characteristic(&self) -> Checked<Self> {
        let n = self.rows;
        let (mut coefficients, mut m) = (vec![(T::integer(BigInt::one()), BigInt::one())], Self::identity(n));
        for k in 1..=n {
            m = self.times(&m)?;
            let zero = T::integer(BigInt::zero());
            let rest = (0..n).fold(zero, |rest, i| rest.minus(&m.data[i * n + i]));
            // The trace is a multiple of k, so that the denominator stays that of the power.
            let coefficient = rest.over(&BigInt::from(k));
            (0..n).for_each(|i| m.data[i * n + i] = m.data[i * n + i].plus(&coefficient));
            coefficients.push((coefficient, m.den.clone()));
        }
        coefficients.reverse();
        Ok(Self::fractions(1, n + 1, &coefficients).reduced())
    }
}

/// The size of the longest of some numbers in bits; that of no numbers is 0.
fn widest<'a, T: Whole + 'a>(numbers: impl IntoIterator<Item = &'a T>) -> u64 {
    numbers.into_iter().fold(0, |most, x| most.max(x.bits()))
}

/// The numbers without their common divisor.
pub fn primitive(mut numbers: Vec<BigInt>) -> Vec<BigInt> {
    let common = content(&numbers);
    if !Zero::is_zero(&common) && !common.is_one() {
        numbers.iter_mut().for_each(|x| *x /= &common);
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::whole;

    fn matrix(rows: &[&[i64]]) -> Matrix {
        Matrix::from_rows(
            rows[0].len(),
            &rows.iter().map(|r| r.iter().map(|&x| whole(x)).collect()).collect::<Vec<_>>(),
        )
    }

    #[test]
    fn characteristic_polynomials() {
        let m = matrix(&[&[1, 2, 3], &[4, 5, 6], &[7, 8, 10]]);
        assert_eq!(m.characteristic().unwrap(), matrix(&[&[3, -12, -16, 1]]));
        let half = Q::new(1.into(), 2.into());
        assert_eq!(m.scaled(&half).characteristic().unwrap().scaled(&whole(8)), matrix(&[&[3, -24, -64, 8]]));
        assert_eq!(m.rank().unwrap(), 3);
        assert_eq!(matrix(&[&[1, 2], &[2, 4]]).echelon().unwrap().0, matrix(&[&[1, 2]]));
        let echelon = matrix(&[&[0, 2, 1], &[-3, 0, 5]]).echelon().unwrap();
        assert_eq!(echelon.0, matrix(&[&[6, 0, -10], &[0, 6, 3]]).scaled(&Q::new(1.into(), 6.into())));
        assert_eq!(echelon.1, [0, 1]);
    }

    #[test]
    fn fixed_points() {
        let m = matrix(&[&[1, 0], &[1, 2]]).scaled(&Q::new(1.into(), 2.into()));
        assert_eq!(m.fixed_point().unwrap().unwrap(), matrix(&[&[0], &[1]]));
        assert!(Matrix::<BigInt>::identity(2).fixed_point().unwrap().is_none());
    }
}
