//! Rotational symmetry: a matrix that commutes with a cyclic permutation splits into the components of
//! `Q[x] / (x^m - 1)`, one for each divisor of the order `m` (the rational form of the Fourier blocks).

use super::summand::{Side, Summand};
use crate::arith::{Integer, Rational};
use crate::linalg::Matrix;
use crate::poly::Poly;

/// Below this size the search for a symmetry costs more than it saves.
const WORTHWHILE: usize = 16;

/// The cycles of a permutation that the matrix commutes with: fixed points, and orbits of one length.
pub(super) struct Symmetry {
    order: usize,
    fixed: Vec<usize>,
    orbits: Vec<Vec<usize>>,
}

impl Symmetry {
    /// Looks for the rotations of the usual numberings: none or one central index first, then sector by sector or
    /// ring by ring. The largest order wins.
    pub fn detect(a: &Matrix) -> Option<Self> {
        let n = a.rows();
        if n < WORTHWHILE {
            return None;
        }
        for order in (3..=n).rev() {
            for centre in [0, 1] {
                let rest = n - centre;
                if !rest.is_multiple_of(order) {
                    continue;
                }
                let sector = rest / order;
                let by_sector = |i: usize| if i < centre { i } else { centre + (i - centre + sector) % rest };
                let by_ring = |i: usize| {
                    if i < centre {
                        return i;
                    }
                    let (ring, place) = ((i - centre) / order, (i - centre) % order);
                    centre + ring * order + (place + 1) % order
                };
                let permutations: [Vec<usize>; 2] = [(0..n).map(by_sector).collect(), (0..n).map(by_ring).collect()];
                if let Some(found) = permutations.iter().find_map(|p| Self::declared(a, p)) {
                    return Some(found);
                }
            }
        }
        None
    }

    /// Checks a declared symmetry.
    pub fn declared(a: &Matrix, permutation: &[usize]) -> Option<Self> {
        let n = a.rows();
        if permutation.len() != n || permutation.iter().any(|i| *i >= n) {
            return None;
        }
        let commutes = |i: usize| (0..n).all(|j| a[(permutation[i], permutation[j])] == a[(i, j)]);
        if !(0..n).all(commutes) {
            return None;
        }
        let mut seen = vec![false; n];
        let (mut fixed, mut orbits) = (Vec::new(), Vec::new());
        for start in 0..n {
            if seen[start] {
                continue;
            }
            let mut orbit = Vec::new();
            let mut i = start;
            while !seen[i] {
                seen[i] = true;
                orbit.push(i);
                i = permutation[i];
            }
            if i != start {
                return None;
            }
            if orbit.len() == 1 { fixed.push(start) } else { orbits.push(orbit) }
        }
        let order = orbits.first().map_or(1, Vec::len);
        orbits.iter().all(|o| o.len() == order).then_some(Self { order, fixed, orbits })
    }

    /// The components, for the matrix and its transpose.
    pub fn split(&self, a: &Matrix) -> Vec<Summand> {
        let transpose = a.transpose();
        (1..=self.order)
            .filter(|d| self.order.is_multiple_of(*d))
            .map(|d| {
                let modulus = cyclotomic(d);
                let right = self.component(a, d, &modulus);
                let left = self.component(&transpose, d, &modulus);
                Summand { right, left }
            })
            .filter(|s| s.right.matrix.rows() > 0)
            .collect()
    }

    /// The action on the component of one cyclotomic polynomial: the classes of `x^l`, times `(x^m - 1) / Φ`, on every
    /// orbit; the fixed points join the component of `Φ = x - 1`.
    fn component(&self, a: &Matrix, divisor: usize, modulus: &Poly) -> Side {
        let width = modulus.degree().unwrap_or(1);
        let fixed: &[usize] = if divisor == 1 { &self.fixed } else { &[] };
        let size = self.orbits.len() * width + fixed.len();
        let first_fixed = self.orbits.len() * width;
        let mut matrix = Matrix::zero(size, size);
        for (from, orbit) in self.orbits.iter().enumerate() {
            for (to, target) in self.orbits.iter().enumerate() {
                let action = Poly::new(target.iter().map(|i| a[(*i, orbit[0])].clone()).collect());
                let mut column = action.div_rem(modulus).1;
                for l in 0..width {
                    for (k, c) in column.coeffs().iter().enumerate() {
                        matrix[(to * width + k, from * width + l)] = c.clone();
                    }
                    column = (&column * &Poly::new(vec![0.into(), 1.into()])).div_rem(modulus).1;
                }
            }
            for (k, i) in fixed.iter().enumerate() {
                matrix[(first_fixed + k, from)] = &a[(*i, orbit[0])] * Rational::from(self.order);
            }
        }
        for (l, j) in fixed.iter().enumerate() {
            for (to, target) in self.orbits.iter().enumerate() {
                matrix[(to, first_fixed + l)] = a[(target[0], *j)].clone();
            }
            for (k, i) in fixed.iter().enumerate() {
                matrix[(first_fixed + k, first_fixed + l)] = a[(*i, *j)].clone();
            }
        }
        Side { matrix, embedding: Some(self.embedding(width, fixed, modulus)) }
    }

    /// The vectors that the coordinates of a component stand for.
    fn embedding(&self, width: usize, fixed: &[usize], modulus: &Poly) -> Vec<Vec<(usize, Integer)>> {
        let mut binomial = vec![Rational::from(0); self.order + 1];
        binomial[0] = Rational::from(-1);
        binomial[self.order] = Rational::from(1);
        let cofactor = Poly::new(binomial).div_rem(modulus).0.primitive();
        let mut out = Vec::with_capacity(self.orbits.len() * width + fixed.len());
        for orbit in &self.orbits {
            for l in 0..width {
                let place = |(t, c): (usize, &Integer)| (orbit[(t + l) % self.order], c.clone());
                out.push(cofactor.iter().enumerate().filter(|(_, c)| **c != 0).map(place).collect());
            }
        }
        out.extend(fixed.iter().map(|i| vec![(*i, Integer::from(1))]));
        out
    }
}

/// The cyclotomic polynomial of index `d`.
fn cyclotomic(d: usize) -> Poly {
    let mut coeffs = vec![Rational::from(0); d + 1];
    coeffs[0] = Rational::from(-1);
    coeffs[d] = Rational::from(1);
    (1..d).filter(|e| d.is_multiple_of(*e)).fold(Poly::new(coeffs), |f, e| f.div_rem(&cyclotomic(e)).0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::char_poly;

    #[test]
    fn cyclotomic_polynomials() {
        assert_eq!(cyclotomic(1).display("x"), "x - 1");
        assert_eq!(cyclotomic(12).display("x"), "x^4 - x^2 + 1");
    }

    #[test]
    fn components_multiply_to_the_characteristic_polynomial() {
        let n = 19;
        let entry = |i: usize, j: usize| {
            if i == 0 || j == 0 {
                return ratio((i + j) as i64 % 3 + i64::from(i > 0), if i == 0 { 5 } else { 2 });
            }
            let (i, j) = (i - 1, j - 1);
            ratio((((j + 18 - i) % 18) / 3) as i64 - 2, 1 + (i % 3) as i64)
        };
        // Rows and columns of the centre must not depend on the sector.
        let a = Matrix::from_fn(n, n, |i, j| {
            if i == 0 && j > 0 {
                ratio(((j - 1) % 3) as i64, 5)
            } else if j == 0 && i > 0 {
                ratio(((i - 1) % 3) as i64, 2)
            } else {
                entry(i, j)
            }
        });
        let shifted = |i: usize| if i == 0 { 0 } else { 1 + (i - 1 + 3) % 18 };
        let b = Matrix::from_fn(n, n, |i, j| {
            let mut sum = ratio(0, 1);
            let (mut p, mut q) = (i, j);
            for _ in 0..6 {
                sum += &a[(p, q)];
                (p, q) = (shifted(p), shifted(q));
            }
            sum
        });
        let symmetry = Symmetry::detect(&b).unwrap();
        assert_eq!((symmetry.order, symmetry.fixed.len()), (6, 1));
        let product =
            symmetry.split(&b).iter().fold(Poly::new(vec![1.into()]), |acc, s| &acc * &char_poly(&s.right.matrix));
        assert_eq!(product, char_poly(&b));
    }
}
