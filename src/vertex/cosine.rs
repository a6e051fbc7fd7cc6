//! The number `2 cos(2πk/n)`: its minimal polynomial and which of the roots it is.

pub use crate::algebraic::field::{cosine as twice_cosine, cosine_polynomial as minimal_polynomial};

/// The greatest common divisor.
#[must_use]
pub fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
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
