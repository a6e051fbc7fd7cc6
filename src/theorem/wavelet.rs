//! The scaling functions of Daubechies: `a(z) = 2 ((1+z)/2)^N q(z)`, where `q(z) q(1/z) = Σ_k C(N−1+k, k) y^k`,
//! `y = (2 − z − 1/z)/4`, and `q` takes the roots outside the unit circle, `q(1) = 1`.

use super::enclosed::{BITS, Enclosed, enclosed};
use crate::algebraic::roots;
use crate::arith::{Integer, Interval, Rational};
use crate::poly::{Poly, factor};
use crate::radius::Options;

/// Largest `N` handled.
pub const MAX_MOMENTS: usize = 20;

/// Bounds the Hölder exponent of the scaling function with `moments` vanishing moments; `None` for `moments` outside
/// `2..=`[`MAX_MOMENTS`], or where the bounds could not be established.
///
/// # Cost
/// One joint spectral radius of matrices of size `moments − 1`.
#[must_use]
pub fn wavelet(moments: usize, options: &Options) -> Option<Enclosed> {
    if !(2..=MAX_MOMENTS).contains(&moments) {
        return None;
    }
    enclosed(coefficients(moments)?, 2, moments, options)
}

/// Enclosures of the coefficients of `2^{1−N} q`.
fn coefficients(moments: usize) -> Option<Vec<Interval>> {
    // z^{N−1} Σ_k C(N−1+k, k) ((2 − z − 1/z)/4)^k, where (2 − z − 1/z) z = −(1 − z)².
    let mut symbol = Poly::zero();
    let mut binomial = Rational::from(1);
    let mut power = Poly::constant(Rational::from(1));
    let square = Poly::new([-1, 2, -1].into_iter().map(|c| Rational::from(c) / Rational::from(4)).collect());
    for k in 0..moments {
        let mut shifted = vec![Rational::from(0); moments - 1 - k];
        shifted.extend_from_slice(power.scale(&binomial).coeffs());
        symbol = &symbol + &Poly::new(shifted);
        power = &power * &square;
        binomial = binomial * Rational::from((moments + k) as u64) / Rational::from((k + 1) as u64);
    }
    let zero = || Interval::point(Rational::from(0));
    let one = || Interval::point(Rational::from(1));
    // A complex polynomial, as enclosures of real and imaginary parts.
    let mut q: Vec<(Interval, Interval)> = vec![(one(), zero())];
    for (minpoly, multiplicity) in factor(&symbol) {
        for root in roots(&minpoly) {
            if root.cmp_modulus_rational(&Rational::from(1)) != std::cmp::Ordering::Greater {
                continue;
            }
            let (re, im) = root.enclosure(BITS + 80);
            for _ in 0..multiplicity {
                q = times_linear(&q, &re, &im);
            }
        }
    }
    if q.len() != moments {
        return None;
    }
    // q is real because roots come in conjugate pairs; scale to 2^{1−N} at z = 1.
    let sum = q.iter().fold(zero(), |s, c| &s + &c.0);
    if sum.contains_zero() {
        return None;
    }
    let scale = Rational::from(1) / Rational::from(Integer::from(1) << (moments as u64 - 1));
    let inverse = &Interval::new(Rational::from(1) / &sum.lo, Rational::from(1) / &sum.hi) * &scale;
    Some(q.iter().map(|c| (&c.0 * &inverse).outward(BITS + 40)).collect())
}

/// `q(z) (z − r)`.
fn times_linear(q: &[(Interval, Interval)], re: &Interval, im: &Interval) -> Vec<(Interval, Interval)> {
    let zero = Interval::point(Rational::from(0));
    let at = |k: usize| q.get(k).cloned().unwrap_or_else(|| (zero.clone(), zero.clone()));
    (0..=q.len())
        .map(|k| {
            let (a, b) = at(k);
            let before = if k == 0 { (zero.clone(), zero.clone()) } else { at(k - 1) };
            let real = &(&before.0 - &(&a * re)) + &(&b * im);
            let imaginary = &(&before.1 - &(&a * im)) - &(&b * re);
            (real.outward(BITS + 80), imaginary.outward(BITS + 80))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::to_f64;

    /// The polytope of db8 is so thin that coefficients of 50 places bound nothing well.
    #[test]
    fn thin_polytopes_are_computed_with_more_places() {
        let exponent = wavelet(8, &Options::default()).unwrap().exponent;
        assert!((to_f64(&exponent.lo) - 2.760_818_386_681).abs() < 1e-9, "{}", to_f64(&exponent.lo));
        assert!(to_f64(&exponent.width()) < 1e-9, "{}", to_f64(&exponent.width()));
    }
}
