//! Integer matrices by which lattices are dilated, and the cosets of what they make of a lattice.

use super::LatticeError;
use crate::arith::{Integer, Rational};
use crate::linalg::Matrix;
use malachite_base::num::conversion::traits::IsInteger;
use std::collections::BTreeMap;

/// Most dimensions.
pub const MAX_DIMENSIONS: usize = 4;
/// Largest entry.
const MAX_ENTRY: i64 = 64;
/// Largest index `|det M|`.
pub const MAX_INDEX: i64 = 64;
/// Largest power of a dilation that is looked at.
const MAX_POWER: usize = 24;

/// An integer matrix `M` all of whose eigenvalues have one modulus above 1, and which is diagonalisable.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dilation {
    rows: Vec<Vec<i64>>,
    determinant: i64,
    /// `det M · M^{-1}`.
    adjugate: Vec<Vec<i64>>,
    digits: Vec<Vec<i64>>,
    /// The number of the coset with a residue of `adjugate · a` modulo the determinant.
    cosets: BTreeMap<Vec<i64>, usize>,
}

impl Dilation {
    /// The dilation by a matrix, given by its rows.
    ///
    /// # Errors
    /// [`LatticeError`] where it is not square, too large or not a similarity in suitable coordinates.
    pub fn new(rows: Vec<Vec<i64>>) -> Result<Self, LatticeError> {
        let s = rows.len();
        if !(1..=MAX_DIMENSIONS).contains(&s) || rows.iter().any(|r| r.len() != s) {
            return Err(LatticeError::Square);
        }
        if rows.iter().flatten().any(|x| x.abs() > MAX_ENTRY) {
            return Err(LatticeError::Entry(MAX_ENTRY));
        }
        let matrix = Matrix::from_fn(s, s, |i, j| Rational::from(rows[i][j]));
        let determinant = whole(&matrix.determinant()).ok_or(LatticeError::Square)?;
        if !(2..=MAX_INDEX).contains(&determinant.abs()) {
            return Err(LatticeError::Index { found: determinant.abs(), most: MAX_INDEX });
        }
        if !is_similarity(&matrix) {
            return Err(LatticeError::Similarity);
        }
        let inverse = matrix.inverse().ok_or(LatticeError::Square)?.scale(&Rational::from(determinant));
        let entry = |i: usize, j: usize| whole(&inverse[(i, j)]).ok_or(LatticeError::Square);
        let adjugate = (0..s).map(|i| (0..s).map(|j| entry(i, j)).collect()).collect::<Result<Vec<Vec<_>>, _>>()?;
        let mut made = Self { rows, determinant, adjugate, digits: Vec::new(), cosets: BTreeMap::new() };
        made.find_digits();
        Ok(made)
    }

    /// `k` times the unit matrix.
    ///
    /// # Errors
    /// As [`Dilation::new`].
    pub fn scalar(dimensions: usize, k: i64) -> Result<Self, LatticeError> {
        Self::new((0..dimensions).map(|i| (0..dimensions).map(|j| if i == j { k } else { 0 }).collect()).collect())
    }

    /// Reads `[[1,1],[1,-1]]`, a whole number for a multiple of the unit matrix in two dimensions, `quincunx` or `sqrt3`.
    ///
    /// # Errors
    /// [`LatticeError`] where it is none of these.
    ///
    /// # Examples
    /// ```
    /// use secant::scheme::Dilation;
    /// let quincunx = Dilation::parse("quincunx")?;
    /// assert_eq!(quincunx.digits(), [[0, 0], [1, 0]]);
    /// assert!(Dilation::parse("[[2,0],[0,3]]").is_err());
    /// # Ok::<(), secant::scheme::LatticeError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, LatticeError> {
        let text = text.trim();
        match text {
            "quincunx" => return Self::new(vec![vec![1, 1], vec![1, -1]]),
            "sqrt3" => return Self::new(vec![vec![2, 1], vec![-1, 1]]),
            _ => {}
        }
        if let Ok(k) = text.parse::<i64>() {
            return Self::scalar(2, k);
        }
        let read: Result<Vec<Vec<i64>>, _> = serde_json::from_str(text);
        Self::new(read.map_err(|_| LatticeError::Text(text.to_owned()))?)
    }

    /// Numbers each coset of `M Z^s` in the order in which steps along the axes reach it from 0.
    fn find_digits(&mut self) {
        let s = self.rows.len();
        let mut next = 0;
        self.digits.push(vec![0; s]);
        self.cosets.insert(self.key(&vec![0; s]), 0);
        while let Some(digit) = self.digits.get(next).cloned() {
            for axis in 0..s {
                let mut step = digit.clone();
                step[axis] += 1;
                let key = self.key(&step);
                if !self.cosets.contains_key(&key) {
                    self.cosets.insert(key, self.digits.len());
                    self.digits.push(step);
                }
            }
            next += 1;
        }
    }

    fn key(&self, a: &[i64]) -> Vec<i64> {
        times(&self.adjugate, a).into_iter().map(|x| x.rem_euclid(self.determinant.abs())).collect()
    }

    /// The number of dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.rows.len()
    }

    /// `|det M|`, the number of cosets.
    #[must_use]
    pub fn index(&self) -> usize {
        self.digits.len()
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> &[Vec<i64>] {
        &self.rows
    }

    /// One point of every coset of `M Z^s`, 0 first.
    #[must_use]
    pub fn digits(&self) -> &[Vec<i64>] {
        &self.digits
    }

    /// The number of the coset of a point.
    #[must_use]
    pub fn coset(&self, a: &[i64]) -> usize {
        self.cosets[&self.key(a)]
    }

    /// `M a`.
    #[must_use]
    pub fn apply(&self, a: &[i64]) -> Vec<i64> {
        times(&self.rows, a)
    }

    /// `M^{-1} a` where it is a point of the lattice.
    #[must_use]
    pub fn divide(&self, a: &[i64]) -> Option<Vec<i64>> {
        let scaled = times(&self.adjugate, a);
        scaled.iter().all(|x| x % self.determinant == 0).then(|| scaled.iter().map(|x| x / self.determinant).collect())
    }

    /// The factor by which it stretches, where that is a whole number.
    #[must_use]
    pub fn factor(&self) -> Option<i64> {
        let power = |k: &i64| (0..self.rows.len()).fold(1_i64, |p, _| p.saturating_mul(*k));
        (2..=MAX_INDEX).find(|k| power(k) == self.determinant.abs())
    }
}

fn times(rows: &[Vec<i64>], a: &[i64]) -> Vec<i64> {
    rows.iter().map(|row| row.iter().zip(a).map(|(x, y)| x * y).sum()).collect()
}

/// A rational that is a whole number of moderate size.
fn whole(x: &Rational) -> Option<i64> {
    if !x.is_integer() {
        return None;
    }
    i64::try_from(&Integer::try_from(x.clone()).ok()?).ok()
}

/// Whether a power is a multiple of the unit matrix, or there are two eigenvalues, conjugate and not real: then the matrix is
/// diagonalisable, and its eigenvalues have one modulus.
fn is_similarity(m: &Matrix) -> bool {
    let s = m.rows();
    if s == 2 {
        let trace = &m[(0, 0)] + &m[(1, 1)];
        if &trace * &trace < m.determinant() * Rational::from(4) {
            return true;
        }
    }
    let scalar = |p: &Matrix| *p == Matrix::identity(s).scale(&p[(0, 0)]);
    std::iter::successors(Some(m.clone()), |p| Some(p * m)).take(MAX_POWER).any(|p| scalar(&p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosets_and_quotients() {
        for text in ["2", "3", "quincunx", "sqrt3", "[[0,2],[-1,0]]", "[[2,0,0],[0,2,0],[0,0,2]]"] {
            let m = Dilation::parse(text).unwrap();
            for (k, digit) in m.digits().iter().enumerate() {
                assert_eq!(m.coset(digit), k, "{text}");
                let far: Vec<i64> = m.apply(&vec![-3; m.dimensions()]).iter().zip(digit).map(|(x, d)| x + d).collect();
                assert_eq!(m.coset(&far), k, "{text}");
                assert_eq!(m.divide(&far).is_some(), k == 0, "{text}");
            }
        }
        assert_eq!(Dilation::parse("sqrt3").unwrap().index(), 3);
        assert_eq!(
            (Dilation::parse("3").unwrap().factor(), Dilation::parse("quincunx").unwrap().factor()),
            (Some(3), None)
        );
    }

    #[test]
    fn what_is_no_similarity() {
        for text in ["[[2,0],[0,3]]", "[[2,1],[0,2]]", "[[2,1],[1,1]]", "[[1,0],[0,1]]", "[[1,2]]", "1", "two"] {
            assert!(Dilation::parse(text).is_err(), "{text}");
        }
    }
}
