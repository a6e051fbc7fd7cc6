//! Laurent symbols of masks, such as `(1+z)^3/4 (1 - 3/8 (1-z)^2/z)`: the coefficients, without the powers of `z` in front.

use crate::base::{Checked, Q, need, number::decimal_fraction, reject, some, spend};
use num_traits::{One, Zero};

/// Largest exponent, and most coefficients.
const MAX_EXPONENT: usize = 1024;
/// Longest text, and deepest nesting of brackets and signs.
const MAX_TEXT: usize = 10_000;
const MAX_DEPTH: usize = 64;

/// `Σ c_k z^(low + k)`; the first and the last coefficient are not 0, and 0 has none.
#[derive(Clone)]
struct Symbol {
    low: i64,
    coefficients: Vec<Q>,
}

impl Symbol {
    fn new(low: i64, mut coefficients: Vec<Q>) -> Checked<Self> {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        let Some(first) = coefficients.iter().position(|c| !c.is_zero()) else {
            return Ok(Self { low: 0, coefficients: Vec::new() });
        };
        coefficients.drain(..first);
        let low = low + first as i64;
        let fits = coefficients.len() <= MAX_EXPONENT && low.unsigned_abs() <= 64 * MAX_EXPONENT as u64;
        need(fits, "limit", "a symbol of too many coefficients")?;
        Ok(Self { low, coefficients })
    }

    fn plus(&self, other: &Self, sign: i64) -> Checked<Self> {
        let low = self.low.min(other.low);
        let end = |p: &Self| p.low + p.coefficients.len() as i64;
        let width = end(self).max(end(other)) - low;
        need(width <= 64 * MAX_EXPONENT as i64, "limit", "a symbol of too many coefficients")?;
        let mut sum = vec![Q::zero(); width as usize];
        for (p, sign) in [(self, 1), (other, sign)] {
            for (k, c) in p.coefficients.iter().enumerate() {
                sum[(p.low - low) as usize + k] += c * crate::base::whole(sign);
            }
        }
        Self::new(low, sum)
    }

    fn times(&self, other: &Self) -> Checked<Self> {
        if self.coefficients.is_empty() || other.coefficients.is_empty() {
            return Self::new(0, Vec::new());
        }
        let (n, m) = (self.coefficients.len(), other.coefficients.len());
        need(n + m <= MAX_EXPONENT + 1, "limit", "a symbol of too many coefficients")?;
        let mut all = vec![Q::zero(); n + m - 1];
        for (i, x) in self.coefficients.iter().enumerate() {
            for (j, y) in other.coefficients.iter().enumerate() {
                spend(4, crate::base::bits(x) + crate::base::bits(y) + crate::base::bits(&all[i + j]))?;
                all[i + j] += x * y;
            }
        }
        Self::new(self.low + other.low, all)
    }

    /// The quotient, where nothing is left.
    fn over(&self, divisor: &Self) -> Checked<Self> {
        let last = some(divisor.coefficients.last(), "symbol", "a division by zero")?;
        let (mut rest, mut quotient) = (self.coefficients.clone(), Vec::new());
        while rest.len() >= divisor.coefficients.len() {
            let c = &rest[rest.len() - 1] / last;
            let offset = rest.len() - divisor.coefficients.len();
            for (k, d) in divisor.coefficients.iter().enumerate() {
                spend(4, crate::base::bits(&c) + crate::base::bits(d) + crate::base::bits(&rest[offset + k]))?;
                rest[offset + k] -= &c * d;
            }
            quotient.push(c);
            rest.pop();
        }
        need(rest.iter().all(Zero::is_zero), "symbol", "a division leaves a remainder")?;
        quotient.reverse();
        Self::new(self.low - divisor.low, quotient)
    }
}

/// The coefficients of a symbol from the first to the last that is not 0.
pub fn read(text: &str) -> Checked<Vec<Q>> {
    need(text.len() <= MAX_TEXT, "limit", "the symbol is too long")?;
    let mut reader = Reader { rest: text, depth: 0 };
    let symbol = reader.sum()?;
    match reader.peek() {
        None => Ok(symbol.coefficients),
        Some(c) => reject("symbol", format_args!("`{c}` is not expected")),
    }
}

struct Reader<'a> {
    rest: &'a str,
    depth: usize,
}

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        match self.peek() {
            Some(c) if c == wanted => {
                self.rest = &self.rest[c.len_utf8()..];
                true
            }
            _ => false,
        }
    }

    fn sum(&mut self) -> Checked<Symbol> {
        let mut total = self.product()?;
        loop {
            let sign = if self.take('+') {
                1
            } else if self.take('-') {
                -1
            } else {
                return Ok(total);
            };
            total = total.plus(&self.product()?, sign)?;
        }
    }

    /// Factors side by side are multiplied.
    fn product(&mut self) -> Checked<Symbol> {
        let mut total = self.factor()?;
        loop {
            if self.take('/') {
                total = total.over(&self.factor()?)?;
            } else if self.take('*') || self.peek().is_some_and(|c| c.is_ascii_digit() || ['(', 'z', '.'].contains(&c))
            {
                total = total.times(&self.factor()?)?;
            } else {
                return Ok(total);
            }
        }
    }

    fn factor(&mut self) -> Checked<Symbol> {
        need(self.depth <= MAX_DEPTH, "limit", "the symbol is nested too deeply")?;
        self.depth += 1;
        let found = if self.take('-') {
            Symbol::new(0, Vec::new())?.plus(&self.factor()?, -1)
        } else if self.take('+') {
            self.factor()
        } else {
            self.power()
        };
        self.depth -= 1;
        found
    }

    fn power(&mut self) -> Checked<Symbol> {
        let base = self.base()?;
        if !self.take('^') {
            return Ok(base);
        }
        let close = if self.take('(') {
            Some(')')
        } else if self.take('{') {
            Some('}')
        } else {
            None
        };
        let (negative, _) = (self.take('-'), self.peek());
        let digits = self.digits(false);
        let size =
            some(digits.parse().ok().filter(|k| *k <= MAX_EXPONENT), "symbol", "an exponent up to 1024 is expected")?;
        need(close.is_none_or(|bracket| self.take(bracket)), "symbol", "a bracket is not closed")?;
        let one = Symbol::new(0, vec![Q::one()])?;
        let start = if negative { one.over(&base)? } else { base };
        (0..size).try_fold(one, |p, _| p.times(&start))
    }

    /// The digits that follow, and points.
    fn digits(&mut self, points: bool) -> String {
        let inside = |c: &char| c.is_ascii_digit() || points && *c == '.';
        let found: String = self.rest.chars().take_while(inside).collect();
        self.rest = &self.rest[found.len()..];
        found
    }

    fn base(&mut self) -> Checked<Symbol> {
        if self.take('(') {
            let inner = self.sum()?;
            need(self.take(')'), "symbol", "a bracket is not closed")?;
            return Ok(inner);
        }
        if self.take('z') {
            return Symbol::new(1, vec![Q::one()]);
        }
        let digits = self.digits(true);
        let number = some(decimal_fraction(&digits), "symbol", "a number, `z` or a bracket is expected")?;
        Symbol::new(0, vec![number])
    }
}
