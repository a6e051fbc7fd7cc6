//! Laurent polynomials: the symbols of masks, and how they are written.

use super::SchemeError;
use super::symbol::Symbol;
use crate::arith::Rational;

/// Largest number of coefficients of a symbol.
pub const MAX_WIDTH: usize = 1024;

/// `Σ c_k z^(low + k)`, with nonzero first and last coefficient; the zero polynomial has none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Laurent {
    low: i64,
    coefficients: Vec<Rational>,
}

impl Laurent {
    /// The polynomial with `coefficients` from `z^low` upwards.
    #[must_use]
    pub fn new(low: i64, coefficients: Vec<Rational>) -> Self {
        let Some(first) = coefficients.iter().position(|c| *c != 0) else {
            return Self { low: 0, coefficients: Vec::new() };
        };
        let mut kept: Vec<Rational> = coefficients.into_iter().skip(first).collect();
        while kept.last().is_some_and(|c| *c == 0) {
            kept.pop();
        }
        Self { low: low + first as i64, coefficients: kept }
    }

    /// The constant `c`.
    #[must_use]
    pub fn constant(c: Rational) -> Self {
        Self::new(0, vec![c])
    }

    /// `1 + z + … + z^(m-1)`.
    #[must_use]
    pub fn geometric(m: usize) -> Self {
        Self::new(0, vec![Rational::from(1); m])
    }

    /// The exponent of the first coefficient.
    #[must_use]
    pub fn low(&self) -> i64 {
        self.low
    }

    /// The coefficients from the first nonzero to the last nonzero one.
    #[must_use]
    pub fn coefficients(&self) -> &[Rational] {
        &self.coefficients
    }

    /// Whether this is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let low = self.low.min(other.low);
        let end = |p: &Self| p.low + p.coefficients.len() as i64;
        let mut sum = vec![Rational::from(0); (end(self).max(end(other)) - low) as usize];
        for p in [self, other] {
            for (k, c) in p.coefficients.iter().enumerate() {
                sum[(p.low - low) as usize + k] += c;
            }
        }
        Self::new(low, sum)
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        Self::new(self.low, self.coefficients.iter().map(|c| c * factor).collect())
    }

    /// The product.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::new(0, Vec::new());
        }
        let mut product = vec![Rational::from(0); self.coefficients.len() + other.coefficients.len() - 1];
        for (i, a) in self.coefficients.iter().enumerate().filter(|(_, a)| **a != 0) {
            for (j, b) in other.coefficients.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self::new(self.low + other.low, product)
    }

    /// `self^power`.
    #[must_use]
    pub fn pow(&self, power: usize) -> Self {
        (0..power).fold(Self::constant(Rational::from(1)), |p, _| p.mul(self))
    }

    /// `self / divisor` where the division leaves no remainder.
    #[must_use]
    pub fn divide(&self, divisor: &Self) -> Option<Self> {
        let lead = divisor.coefficients.first()?;
        if self.is_zero() {
            return Some(self.clone());
        }
        let count = (self.coefficients.len() + 1).checked_sub(divisor.coefficients.len())?;
        let mut rest = self.coefficients.clone();
        let mut quotient = Vec::with_capacity(count);
        for k in 0..count {
            let q = &rest[k] / lead;
            for (j, d) in divisor.coefficients.iter().enumerate() {
                rest[k + j] -= &q * d;
            }
            quotient.push(q);
        }
        rest.iter().all(|r| *r == 0).then(|| Self::new(self.low - divisor.low, quotient))
    }

    /// Reads a symbol such as `(1+z)^4/8` or `(1 + z)^3/4 (1 - 3/8 (1-z)^2/z)`.
    ///
    /// Operators: `+ - * / ^`, brackets, multiplication without a sign. A division must leave no remainder.
    ///
    /// # Errors
    /// [`SchemeError::Symbol`] with the position, and [`SchemeError::Large`].
    pub fn parse(text: &str) -> Result<Self, SchemeError> {
        super::symbol::parse(text)
    }
}

impl Symbol for Laurent {
    const VARIABLES: &'static str = "`z`";
    const LIMIT: usize = MAX_WIDTH;

    fn begins_variable(c: char) -> bool {
        c == 'z'
    }

    fn variable(name: &str) -> Option<Self> {
        (name == "z").then(|| Self::new(1, vec![Rational::from(1)]))
    }

    fn constant(c: Rational) -> Self {
        Self::constant(c)
    }

    fn is_zero(&self) -> bool {
        Self::is_zero(self)
    }

    fn add(&self, other: &Self) -> Self {
        Self::add(self, other)
    }

    fn scale(&self, factor: &Rational) -> Self {
        Self::scale(self, factor)
    }

    fn mul(&self, other: &Self) -> Self {
        Self::mul(self, other)
    }

    fn divide(&self, divisor: &Self) -> Option<Self> {
        Self::divide(self, divisor)
    }

    fn width(&self) -> usize {
        self.coefficients.len()
    }

    fn width_of_product(&self, other: &Self) -> usize {
        (self.coefficients.len() + other.coefficients.len()).saturating_sub(1)
    }

    fn farthest(&self) -> i64 {
        self.low.abs()
    }

    fn numbers(&self) -> impl Iterator<Item = &Rational> {
        self.coefficients.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn read(text: &str) -> (i64, Vec<Rational>) {
        let p = Laurent::parse(text).unwrap();
        (p.low(), p.coefficients().to_vec())
    }

    #[test]
    fn reads_symbols() {
        assert_eq!(read("(1+z)^3/4"), (0, vec![ratio(1, 4), ratio(3, 4), ratio(3, 4), ratio(1, 4)]));
        assert_eq!(read("-z^-1/2 + 1 - 1/2 z"), (-1, vec![ratio(-1, 2), ratio(1, 1), ratio(-1, 2)]));
        assert_eq!(read("2(1-z^2)/(1-z)"), (0, vec![ratio(2, 1), ratio(2, 1)]));
        assert_eq!(read("-z^{2}(0.5)"), (2, vec![ratio(-1, 2)]));
    }

    #[test]
    fn refuses_with_a_position() {
        for (text, at) in
            [("(1+z", 4), ("1+", 2), ("1/(1-z)", 7), ("1 + y", 4), ("(1+z)^-1", 8), ("z^z", 2), ("1/0", 3)]
        {
            let Err(SchemeError::Symbol { position, .. }) = Laurent::parse(text) else { panic!("{text}") };
            assert_eq!(position, at, "{text}");
        }
        assert!(Laurent::parse(&"(".repeat(5000)).is_err());
        assert!(Laurent::parse("(1+z)^1024^2").is_err());
        assert!(Laurent::parse("((9^1024)^1024)^1024").is_err());
    }
}
