//! Where a word has an eigenvalue outside the open unit disc.

use super::Pencil;
use crate::algebraic::{Root, between, cmp_real, roots_within};
use crate::arith::{Rational, abs, ratio};
use crate::linalg::{Matrix, char_poly};
use crate::poly::Poly;
use std::cmp::Ordering;

/// Highest degree of a polynomial whose zeros are sought.
const MAX_DEGREE: usize = 240;

/// The parameters of an interval at which the product along a word has spectral radius at least 1: the ends, and the open
/// parts between them that are marked.
#[derive(Debug, Clone)]
pub struct Crossing {
    /// The word.
    pub word: Vec<usize>,
    /// The parameters at which two eigenvalues, or one with itself, have the product 1, ascending.
    pub ends: Vec<Root>,
    /// For the part before the first end, between two neighbours, and behind the last: whether the radius is above 1.
    pub above: Vec<bool>,
}

impl Crossing {
    /// The crossings of a word in an interval; `None` where the polynomials would be too large.
    ///
    /// # Cost
    /// Characteristic polynomials of the product and of its second exterior power at as many rationals as the degree asks
    /// for, a factorisation, and an exact test of stability in each part.
    #[must_use]
    pub fn of(pencil: &Pencil, word: &[usize], range: &(Rational, Rational)) -> Option<Self> {
        let polynomials = critical(pencil, word)?;
        if polynomials.iter().any(Poly::is_zero) {
            // Two eigenvalues have the product 1 at every parameter.
            return Some(Self { word: word.to_vec(), ends: Vec::new(), above: vec![true] });
        }
        let mut ends: Vec<Root> = polynomials.iter().flat_map(|f| roots_within(f, range)).collect();
        ends.sort_by(cmp_real);
        ends.dedup_by(|a, b| a.same(b));
        let mut marks: Vec<Root> = vec![Root::from_rational(&range.0)];
        marks.extend(ends.iter().cloned());
        marks.push(Root::from_rational(&range.1));
        let above = marks.windows(2).map(|pair| {
            // An end of the interval may be a mark twice: then nothing is between.
            let empty = cmp_real(&pair[0], &pair[1]) != Ordering::Less;
            !empty && !is_stable(&product(pencil, word, &between(&pair[0], &pair[1])))
        });
        Some(Self { word: word.to_vec(), above: above.collect(), ends })
    }

    /// Whether the spectral radius is at least 1 at a parameter of the interval.
    #[must_use]
    pub fn holds_at(&self, p: &Root) -> bool {
        let before = self.ends.iter().take_while(|e| cmp_real(e, p) == Ordering::Less).count();
        self.ends.get(before).is_some_and(|e| e.same(p)) || self.above[before]
    }
}

/// The product along a word at a member.
fn product(pencil: &Pencil, word: &[usize], p: &Rational) -> Matrix {
    let letters = pencil.at(p);
    word.iter().fold(Matrix::identity(pencil.dim()), |m, &letter| &m * &letters[letter])
}

/// `χ(1)`, `χ(−1)` and `det(1 − Λ²T)` of the product along a word as polynomials in the parameter: one of them vanishes where
/// two eigenvalues, or one with itself, have the product 1.
fn critical(pencil: &Pencil, word: &[usize]) -> Option<Vec<Poly>> {
    let (n, entry) = (pencil.dim(), pencil.degree() * word.len());
    // Degrees of determinants: entries of the product have the degree `entry`, those of its exterior power twice that.
    let (single, pairs) = (n * entry, n * (n - 1) * entry);
    let most = single.max(pairs);
    if most > MAX_DEGREE {
        return None;
    }
    let one = ratio(1, 1);
    let values = |p: &Rational| {
        crate::stop::check();
        let m = product(pencil, word, p);
        let chi = char_poly(&m);
        let exterior = if n > 1 { char_poly(&exterior(&m)).eval(&one) } else { one.clone() };
        [chi.eval(&one), chi.eval(&-&one), exterior]
    };
    Some(interpolated(most, values).to_vec())
}

/// Polynomials of at most this degree, by their values at small whole numbers.
pub(crate) fn interpolated<const N: usize>(degree: usize, values: impl Fn(&Rational) -> [Rational; N]) -> [Poly; N] {
    let small = |k: usize| ratio(if k.is_multiple_of(2) { k as i64 / 2 } else { -(k as i64 + 1) / 2 }, 1);
    let at: Vec<Rational> = (0..=degree).map(small).collect();
    let rows: Vec<[Rational; N]> = at.iter().map(values).collect();
    std::array::from_fn(|k| Poly::through(&at, rows.iter().map(|r| r[k].clone()).collect()))
}

/// The second exterior power.
fn exterior(m: &Matrix) -> Matrix {
    let n = m.rows();
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    Matrix::from_fn(pairs.len(), pairs.len(), |r, c| {
        let ((i, j), (k, l)) = (pairs[r], pairs[c]);
        &m[(i, k)] * &m[(j, l)] - &m[(i, l)] * &m[(j, k)]
    })
}

/// Whether all eigenvalues lie in the open unit disc (Schur, Cohn, Jury): the constant coefficient is smaller than the leading one,
/// and the polynomial without it, `(a_n p − a_0 p*)/z`, has the same property.
fn is_stable(m: &Matrix) -> bool {
    let mut p: Vec<Rational> = char_poly(m).coeffs().to_vec();
    while p.len() > 1 {
        let (first, last) = (p[0].clone(), p[p.len() - 1].clone());
        if abs(&first) >= abs(&last) {
            return false;
        }
        let n = p.len() - 1;
        let ratio = &first / &last;
        p = (1..=n).map(|k| &p[k] - &ratio * &p[n - k]).collect();
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly(c: &[i64]) -> Poly {
        Poly::new(c.iter().map(|x| ratio(*x, 1)).collect())
    }

    #[test]
    fn a_rotation_and_a_shear() {
        // Eigenvalues p ± i p: of modulus 1 at p² = 1/2; then 2p and 1/2.
        let turn = Matrix::from_rows(2, vec![vec![poly(&[0, 1]), poly(&[0, -1])], vec![poly(&[0, 1]), poly(&[0, 1])]]);
        let half = Poly::constant(ratio(1, 2));
        let plain = Matrix::from_rows(2, vec![vec![poly(&[0, 2]), Poly::zero()], vec![poly(&[3]), half]]);
        let pencil = Pencil::new(vec![turn, plain]).unwrap();
        let range = (ratio(-1, 1), ratio(2, 1));
        let first = Crossing::of(&pencil, &[0], &range).unwrap();
        assert_eq!(
            first.ends.iter().map(|r| r.to_f64().0.abs().powi(2)).map(|x| (x * 2.0).round() as i32).collect::<Vec<_>>(),
            [1, 1]
        );
        assert_eq!(first.above, [true, false, true]);
        let second = Crossing::of(&pencil, &[1], &range).unwrap();
        let at = |p, q| second.holds_at(&Root::from_rational(&ratio(p, q)));
        // At p = 1 the eigenvalues 2 and 1/2 have the product 1: an end inside a refuted part.
        assert_eq!(second.ends.len(), 3);
        assert_eq!(
            (at(-1, 2), at(-499, 1000), at(1, 4), at(1, 2), at(1, 1), at(2, 1)),
            (true, false, false, true, true, true)
        );
    }

    #[test]
    fn stability_is_decided_where_roots_lie_on_the_circle() {
        let diagonal =
            |x: &[Rational]| Matrix::from_fn(x.len(), x.len(), |i, j| if i == j { x[i].clone() } else { ratio(0, 1) });
        assert!(is_stable(&diagonal(&[ratio(99, 100), ratio(-99, 100), ratio(0, 1)])));
        assert!(!is_stable(&diagonal(&[ratio(1, 2), ratio(-1, 1), ratio(0, 1)])));
        assert!(!is_stable(&diagonal(&[ratio(1, 3), ratio(3, 1)])));
    }
}
