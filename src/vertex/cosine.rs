//! The number `2 cos(2πk/n)`: its minimal polynomial and which of the roots it is.

use crate::algebraic::{Root, roots};
use crate::arith::Rational;
use crate::poly::Poly;

/// The greatest common divisor.
#[must_use]
pub fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The minimal polynomial of `2 cos(2π/d)`: with `Φ_d(x) = x^m ψ(x + 1/x)`, `ψ`; for `d ≤ 2`, `t − 2` and `t + 2`.
///
/// # Panics
/// If `d` is 0.
#[must_use]
pub fn minimal_polynomial(d: usize) -> Poly {
    assert!(d > 0, "an angle");
    if d <= 2 {
        return Poly::linear(&Rational::from(if d == 1 { 2 } else { -2 }));
    }
    let cyclotomic = cyclotomic(d);
    let half = cyclotomic.degree().expect("a cyclotomic polynomial is not 0") / 2;
    // x^j + x^{−j} = V_j(t), V_0 = 2, V_1 = t, V_{j+1} = t V_j − V_{j−1}.
    let t = Poly::new(vec![0.into(), 1.into()]);
    let (mut before, mut now) = (Poly::constant(Rational::from(2)), t.clone());
    let mut sum = Poly::constant(cyclotomic.coeff(half));
    for j in 1..=half {
        sum = &sum + &now.scale(&cyclotomic.coeff(half + j));
        let next = &(&t * &now) - &before;
        before = now;
        now = next;
    }
    sum
}

fn cyclotomic(d: usize) -> Poly {
    let mut coeffs = vec![Rational::from(0); d + 1];
    coeffs[0] = Rational::from(-1);
    coeffs[d] = Rational::from(1);
    (1..d).filter(|e| d.is_multiple_of(*e)).fold(Poly::new(coeffs), |f, e| f.div_rem(&cyclotomic(e)).0)
}

/// `2 cos(2πk/n)` as an algebraic number.
///
/// # Panics
/// If `n` is 0.
#[must_use]
pub fn twice_cosine(k: usize, n: usize) -> Root {
    let common = gcd(k, n);
    let (k, d) = (k / common % (n / common), n / common);
    let k = k.min(d - k);
    // The roots are 2cos(2πj/d) for j prime to d up to d/2, the real ones in ascending order: larger j come first.
    let larger = (k + 1..=d / 2).filter(|j| gcd(*j, d) == 1).count();
    roots(&minimal_polynomial(d)).swap_remove(larger)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_right_root() {
        for (k, n) in [(1, 5), (2, 5), (3, 7), (2, 12), (1, 30), (7, 30), (0, 5), (3, 6), (5, 7)] {
            let expected = 2.0 * (std::f64::consts::TAU * k as f64 / n as f64).cos();
            assert!((twice_cosine(k, n).to_f64().0 - expected).abs() < 1e-9, "{k}/{n}");
        }
        assert_eq!(minimal_polynomial(7).display("t"), "t^3 + t^2 - 2t - 1");
    }
}
