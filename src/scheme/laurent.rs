//! Laurent polynomials: the symbols of masks, and how they are written.

use super::SchemeError;
use crate::arith::{Rational, parse_rational};
use malachite_base::num::logic::traits::SignificantBits;

/// Largest number of coefficients of a symbol.
pub const MAX_WIDTH: usize = 1024;
/// Largest exponent in the text of a symbol.
const MAX_EXPONENT: i64 = 1024;
/// Longest text, in bytes.
const MAX_TEXT: usize = 10_000;
/// Deepest nesting of brackets.
const MAX_DEPTH: usize = 64;
/// Longest coefficient, in bits.
const MAX_BITS: u64 = 65_536;

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
        if text.len() > MAX_TEXT {
            return Err(SchemeError::Large { what: "a symbol of length", size: text.len(), limit: MAX_TEXT });
        }
        let mut parser = Parser { text: text.chars().collect(), at: 0, depth: 0 };
        let result = parser.sum()?;
        match parser.peek() {
            None => Ok(result),
            Some(c) => Err(parser.error(&format!("`{c}` is not expected here"))),
        }
    }
}

struct Parser {
    text: Vec<char>,
    at: usize,
    depth: usize,
}

impl Parser {
    fn error(&self, message: &str) -> SchemeError {
        SchemeError::Symbol { position: self.at, message: message.to_owned() }
    }

    fn peek(&mut self) -> Option<char> {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    fn accept(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    fn sum(&mut self) -> Result<Laurent, SchemeError> {
        let mut total = self.product()?;
        loop {
            let sign = match self.peek() {
                Some('+') => 1,
                Some('-') => -1,
                _ => return Ok(total),
            };
            self.at += 1;
            let term = self.product()?.scale(&Rational::from(sign));
            total = self.limited(total.add(&term))?;
        }
    }

    fn product(&mut self) -> Result<Laurent, SchemeError> {
        let mut total = self.factor()?;
        loop {
            match self.peek() {
                Some('/') => {
                    self.at += 1;
                    let divisor = self.factor()?;
                    let quotient = total.divide(&divisor).ok_or_else(|| {
                        self.error(if divisor.is_zero() {
                            "division by zero"
                        } else {
                            "this division leaves a remainder"
                        })
                    })?;
                    total = self.limited(quotient)?;
                }
                Some('*') => {
                    self.at += 1;
                    let factor = self.factor()?;
                    total = self.times(&total, &factor)?;
                }
                Some(c) if c == '(' || c == 'z' || c.is_ascii_digit() || c == '.' => {
                    let factor = self.factor()?;
                    total = self.times(&total, &factor)?;
                }
                _ => return Ok(total),
            }
        }
    }

    fn factor(&mut self) -> Result<Laurent, SchemeError> {
        if self.depth > MAX_DEPTH {
            return Err(self.error("nested too deeply"));
        }
        self.depth += 1;
        let result = if self.accept('-') {
            self.factor().map(|f| f.scale(&Rational::from(-1)))
        } else if self.accept('+') {
            self.factor()
        } else {
            self.power()
        };
        self.depth -= 1;
        result
    }

    fn power(&mut self) -> Result<Laurent, SchemeError> {
        let base = self.base()?;
        self.lost_power()?;
        if !self.accept('^') {
            return Ok(base);
        }
        let exponent = self.exponent()?;
        let start = if exponent < 0 {
            Laurent::constant(Rational::from(1))
                .divide(&base)
                .ok_or_else(|| self.error("only a single power of z can be raised to a negative power"))?
        } else {
            base
        };
        let mut result = Laurent::constant(Rational::from(1));
        for _ in 0..exponent.unsigned_abs() {
            result = self.times(&result, &start)?;
        }
        Ok(result)
    }

    /// Refuses a digit right behind `z` or a bracket, as a text has that lost its superscripts, and other ways to write a power.
    fn lost_power(&self) -> Result<(), SchemeError> {
        let behind = self.at.checked_sub(1).and_then(|k| self.text.get(k));
        if !matches!(behind, Some('z' | ')')) {
            return Ok(());
        }
        let digits: String = self.text[self.at..].iter().take_while(|c| c.is_ascii_digit()).collect();
        let rest = &self.text[self.at..];
        let power = match rest {
            [c, ..] if c.is_ascii_digit() => digits,
            ['*', '*', ..] => rest[2..].iter().take_while(|c| c.is_ascii_digit()).collect(),
            [c, ..] => match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|s| s == *c) {
                Some(value) => value.to_string(),
                None => return Ok(()),
            },
            [] => return Ok(()),
        };
        Err(self.error(&format!("a power is written with `^`: did you mean `^{power}`? A factor is written with `*`")))
    }

    fn exponent(&mut self) -> Result<i64, SchemeError> {
        let close = if self.accept('(') {
            Some(')')
        } else if self.accept('{') {
            Some('}')
        } else {
            None
        };
        let negative = self.accept('-');
        self.peek();
        let start = self.at;
        while self.text.get(self.at).is_some_and(char::is_ascii_digit) {
            self.at += 1;
        }
        let digits: String = self.text[start..self.at].iter().collect();
        let size: i64 = digits.parse().map_err(|_| self.error("an integer exponent is expected"))?;
        if size > MAX_EXPONENT {
            return Err(self.error("exponents go up to 1024"));
        }
        match close {
            Some(bracket) if !self.accept(bracket) => Err(self.error(&format!("`{bracket}` is expected"))),
            _ => Ok(if negative { -size } else { size }),
        }
    }

    fn base(&mut self) -> Result<Laurent, SchemeError> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.sum()?;
                if self.accept(')') { Ok(inner) } else { Err(self.error("`)` is expected")) }
            }
            Some('z') => {
                self.at += 1;
                Ok(Laurent::new(1, vec![Rational::from(1)]))
            }
            Some(c) if c.is_ascii_digit() || c == '.' => {
                let start = self.at;
                while self.text.get(self.at).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
                    self.at += 1;
                }
                let digits: String = self.text[start..self.at].iter().collect();
                parse_rational(&digits).map(Laurent::constant).map_err(|e| self.error(&e.to_string()))
            }
            Some(c) => Err(self.error(&format!("`{c}` is not expected here; a number, `z` or `(` is"))),
            None => Err(self.error("the symbol ends too early")),
        }
    }

    fn times(&self, a: &Laurent, b: &Laurent) -> Result<Laurent, SchemeError> {
        if a.coefficients.len() + b.coefficients.len() > MAX_WIDTH + 1 {
            let size = a.coefficients.len() + b.coefficients.len() - 1;
            return Err(SchemeError::Large { what: "a symbol of width", size, limit: MAX_WIDTH });
        }
        self.limited(a.mul(b))
    }

    fn limited(&self, p: Laurent) -> Result<Laurent, SchemeError> {
        if p.coefficients.len() > MAX_WIDTH {
            let size = p.coefficients.len();
            return Err(SchemeError::Large { what: "a symbol of width", size, limit: MAX_WIDTH });
        }
        let bits = |c: &Rational| c.numerator_ref().significant_bits() + c.denominator_ref().significant_bits();
        if p.coefficients.iter().any(|c| bits(c) > MAX_BITS) || p.low.abs() > 64 * MAX_EXPONENT {
            return Err(self.error("the numbers grow too large"));
        }
        Ok(p)
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
