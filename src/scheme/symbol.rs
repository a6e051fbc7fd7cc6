//! How symbols of masks are written, in one variable or several.

use super::SchemeError;
use crate::arith::{Rational, parse_rational};
use malachite_base::num::logic::traits::SignificantBits;
use std::marker::PhantomData;

/// Largest exponent in the text of a symbol.
const MAX_EXPONENT: i64 = 1024;
/// Longest text, in bytes.
const MAX_TEXT: usize = 10_000;
/// Deepest nesting of brackets.
const MAX_DEPTH: usize = 64;
/// Longest coefficient, in bits.
const MAX_BITS: u64 = 65_536;

/// Laurent polynomials of some kind, as symbols are made of them.
pub(super) trait Symbol: Clone {
    /// The names of the variables, for messages.
    const VARIABLES: &'static str;
    /// Most coefficients, from the first to the last.
    const LIMIT: usize;
    /// Whether `z` may have an index, as in `z1`.
    const INDEXED: bool = false;

    /// Whether the name of a variable begins with this character.
    fn begins_variable(c: char) -> bool;
    /// The variable of this name.
    fn variable(name: &str) -> Option<Self>;
    /// A constant.
    fn constant(c: Rational) -> Self;
    /// Whether it is zero.
    fn is_zero(&self) -> bool;
    /// The sum.
    fn add(&self, other: &Self) -> Self;
    /// A multiple.
    fn scale(&self, factor: &Rational) -> Self;
    /// The product.
    fn mul(&self, other: &Self) -> Self;
    /// The quotient, where the division leaves no remainder.
    fn divide(&self, divisor: &Self) -> Option<Self>;
    /// How many coefficients there are from the first to the last.
    fn width(&self) -> usize;
    /// At least the width of a product.
    fn width_of_product(&self, other: &Self) -> usize;
    /// The largest modulus of an exponent at an end.
    fn farthest(&self) -> i64;
    /// The coefficients.
    fn numbers(&self) -> impl Iterator<Item = &Rational>;
}

/// Reads a symbol.
///
/// Operators: `+ - * / ^`, brackets, multiplication without a sign. A division must leave no remainder.
///
/// # Errors
/// [`SchemeError::Symbol`] with the position, and [`SchemeError::Large`].
pub(super) fn parse<P: Symbol>(text: &str) -> Result<P, SchemeError> {
    if text.len() > MAX_TEXT {
        return Err(SchemeError::Large { what: "a symbol of length", size: text.len(), limit: MAX_TEXT });
    }
    let mut parser = Parser { text: text.chars().collect(), at: 0, depth: 0, of: PhantomData };
    let result = parser.sum()?;
    match parser.peek() {
        None => Ok(result),
        Some(c) => Err(parser.error(&format!("`{c}` is not expected here"))),
    }
}

struct Parser<P> {
    text: Vec<char>,
    at: usize,
    depth: usize,
    of: PhantomData<P>,
}

impl<P: Symbol> Parser<P> {
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

    fn sum(&mut self) -> Result<P, SchemeError> {
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

    fn product(&mut self) -> Result<P, SchemeError> {
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
                Some(c) if c == '(' || P::begins_variable(c) || c.is_ascii_digit() || c == '.' => {
                    let factor = self.factor()?;
                    total = self.times(&total, &factor)?;
                }
                _ => return Ok(total),
            }
        }
    }

    fn factor(&mut self) -> Result<P, SchemeError> {
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

    fn power(&mut self) -> Result<P, SchemeError> {
        let base = self.base()?;
        self.lost_power()?;
        if !self.accept('^') {
            return Ok(base);
        }
        let exponent = self.exponent()?;
        let start = if exponent < 0 {
            P::constant(Rational::from(1))
                .divide(&base)
                .ok_or_else(|| self.error("only a single power of a variable can be raised to a negative power"))?
        } else {
            base
        };
        let mut result = P::constant(Rational::from(1));
        for _ in 0..exponent.unsigned_abs() {
            result = self.times(&result, &start)?;
        }
        Ok(result)
    }

    /// Refuses a digit right behind a variable or a bracket, as a text has that lost its superscripts, and other ways to write a power.
    fn lost_power(&self) -> Result<(), SchemeError> {
        let behind = self.at.checked_sub(1).and_then(|k| self.text.get(k));
        if !behind.is_some_and(|c| *c == ')' || P::begins_variable(*c)) {
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

    fn base(&mut self) -> Result<P, SchemeError> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.sum()?;
                if self.accept(')') { Ok(inner) } else { Err(self.error("`)` is expected")) }
            }
            Some(c) if P::begins_variable(c) => {
                let start = self.at;
                self.at += 1;
                while P::INDEXED && c == 'z' && self.text.get(self.at).is_some_and(char::is_ascii_digit) {
                    self.at += 1;
                }
                let name: String = self.text[start..self.at].iter().collect();
                P::variable(&name).ok_or_else(|| self.error(&format!("`{name}` is no variable; {} are", P::VARIABLES)))
            }
            Some(c) if c.is_ascii_digit() || c == '.' => {
                let start = self.at;
                while self.text.get(self.at).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
                    self.at += 1;
                }
                let digits: String = self.text[start..self.at].iter().collect();
                parse_rational(&digits).map(P::constant).map_err(|e| self.error(&e.to_string()))
            }
            Some(c) => Err(self.error(&format!("`{c}` is not expected here; a number, {} or `(` is", P::VARIABLES))),
            None => Err(self.error("the symbol ends too early")),
        }
    }

    fn times(&self, a: &P, b: &P) -> Result<P, SchemeError> {
        Self::narrow(a.width_of_product(b))?;
        self.limited(a.mul(b))
    }

    fn limited(&self, p: P) -> Result<P, SchemeError> {
        Self::narrow(p.width())?;
        let bits = |c: &Rational| c.numerator_ref().significant_bits() + c.denominator_ref().significant_bits();
        if p.numbers().any(|c| bits(c) > MAX_BITS) || p.farthest() > 64 * MAX_EXPONENT {
            return Err(self.error("the numbers grow too large"));
        }
        Ok(p)
    }

    fn narrow(size: usize) -> Result<(), SchemeError> {
        if size <= P::LIMIT {
            return Ok(());
        }
        Err(SchemeError::Large { what: "a symbol of width", size, limit: P::LIMIT })
    }
}
