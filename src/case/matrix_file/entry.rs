use super::{Mistake, Tally, number};
use crate::arith::Rational;

/// Deepest nesting of brackets in an entry.
const MAX_DEPTH: usize = 16;

/// Reads the entries of a literal from left to right.
pub(super) struct Scanner<'a> {
    text: &'a str,
    at: usize,
    pub tally: Tally,
}

impl<'a> Scanner<'a> {
    pub fn new(text: &'a str, at: usize) -> Self {
        Self { text, at, tally: Tally::default() }
    }

    pub fn position(&self) -> usize {
        self.at
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Skips white space, continuation dots and comments; true when a line ended.
    pub fn skip_blanks(&mut self) -> bool {
        let mut new_line = false;
        loop {
            let rest = self.rest();
            if rest.starts_with("...") || rest.starts_with(['%', '#']) {
                let continued = rest.starts_with('.');
                self.at += rest.find('\n').map_or(rest.len(), |i| if continued { i + 1 } else { i });
            } else if let Some(c) = rest.chars().next().filter(|c| c.is_whitespace()) {
                new_line |= c == '\n';
                self.at += c.len_utf8();
            } else {
                return new_line;
            }
        }
    }

    pub fn accept(&mut self, c: char) -> bool {
        self.skip_blanks();
        let found = self.rest().starts_with(c);
        if found {
            self.at += c.len_utf8();
        }
        found
    }

    pub fn expect(&mut self, c: char) -> Result<(), Mistake> {
        if self.accept(c) {
            return Ok(());
        }
        let found = self.rest().chars().next().map_or("the end of the text".to_owned(), |c| format!("`{c}`"));
        Err(Mistake::new("syntax", self.at, format!("`{c}` is expected here, not {found}")))
    }

    /// What may follow the matrix: closing brackets of a call, a semicolon.
    pub fn finish(&mut self) -> Result<(), Mistake> {
        loop {
            self.skip_blanks();
            match self.rest().chars().next() {
                None => return Ok(()),
                Some(')' | ';') => self.at += 1,
                Some(c) => return Err(Mistake::new("syntax", self.at, format!("`{c}` comes after the matrix"))),
            }
        }
    }

    /// A sum of products, white space allowed.
    pub fn expression(&mut self, depth: usize) -> Result<Rational, Mistake> {
        let mut sum = self.product(depth)?;
        loop {
            if self.accept('+') {
                sum += self.product(depth)?;
            } else if self.accept('-') {
                sum -= self.product(depth)?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self, depth: usize) -> Result<Rational, Mistake> {
        let mut value = self.primary(depth)?;
        loop {
            if self.accept('*') {
                value *= self.primary(depth)?;
            } else if self.accept('/') {
                value = self.divided(value, depth)?;
            } else {
                return Ok(value);
            }
        }
    }

    fn divided(&mut self, value: Rational, depth: usize) -> Result<Rational, Mistake> {
        let at = self.at;
        let divisor = self.primary(depth)?;
        if divisor == 0 {
            return Err(Mistake::new("number", at, "a division by zero"));
        }
        Ok(value / divisor)
    }

    /// An entry without white space inside, apart from brackets: `1/2`, `-3`, `(1 + 2)/4`.
    pub fn tight_entry(&mut self) -> Result<Rational, Mistake> {
        let mut value = self.primary(0)?;
        loop {
            let next = self.rest().chars().next();
            let operator = match next {
                Some(c @ ('*' | '/')) => c,
                _ => return Ok(value),
            };
            self.at += 1;
            value = if operator == '*' { value * self.primary(0)? } else { self.divided(value, 0)? };
        }
    }

    fn primary(&mut self, depth: usize) -> Result<Rational, Mistake> {
        self.skip_blanks();
        if depth > MAX_DEPTH {
            return Err(Mistake::new("limit", self.at, "an entry is nested too deeply"));
        }
        let rest = self.rest();
        match rest.chars().next() {
            Some('-') => {
                self.at += 1;
                Ok(-self.primary(depth + 1)?)
            }
            Some('+') => {
                self.at += 1;
                self.primary(depth + 1)
            }
            Some('(') => {
                self.at += 1;
                let value = self.expression(depth + 1)?;
                self.expect(')')?;
                Ok(value)
            }
            Some(c) if c.is_ascii_alphabetic() => self.call(depth),
            _ => self.number(),
        }
    }

    /// `Rational(1, 2)`, `S(1)`, `QQ(1/2)`, `Integer(3)`, `sym(1/2)`.
    fn call(&mut self, depth: usize) -> Result<Rational, Mistake> {
        let start = self.at;
        let rest = self.rest();
        let length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.')).unwrap_or(rest.len());
        let name = &rest[..length];
        self.at += length;
        if !matches!(
            name.trim_start_matches("sympy.").trim_start_matches("sp."),
            "Rational" | "S" | "QQ" | "ZZ" | "Integer" | "sym"
        ) {
            let message = format!("`{}` is not a rational number", name.chars().take(40).collect::<String>());
            return Err(Mistake::new("number", start, message).help("entries are exact fractions or decimals"));
        }
        self.expect('(')?;
        let mut value = self.expression(depth + 1)?;
        if self.accept(',') {
            let at = self.at;
            let divisor = self.expression(depth + 1)?;
            if divisor == 0 {
                return Err(Mistake::new("number", at, "a division by zero"));
            }
            value /= divisor;
        }
        self.expect(')')?;
        Ok(value)
    }

    fn number(&mut self) -> Result<Rational, Mistake> {
        let rest = self.rest();
        let mut length = 0;
        let bytes = rest.as_bytes();
        while length < bytes.len() {
            let c = bytes[length];
            let exponent = length > 0 && matches!(c, b'e' | b'E');
            let sign = matches!(c, b'+' | b'-') && length > 0 && matches!(bytes[length - 1], b'e' | b'E');
            if !(c.is_ascii_digit() || c == b'.' || exponent || sign) {
                break;
            }
            length += 1;
        }
        let token = &rest[..length];
        if length == 0 {
            let found = rest.chars().next().map_or("the end of the text".to_owned(), |c| format!("`{c}`"));
            return Err(Mistake::new("number", self.at, format!("a number is expected here, not {found}")));
        }
        let value = number(token, self.at, &mut self.tally)?;
        self.at += length;
        // Mathematica marks the precision of a decimal with a back quote.
        if self.rest().starts_with('`') {
            self.at += 1;
        }
        Ok(value)
    }
}
