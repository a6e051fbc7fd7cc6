//! Expressions for real algebraic numbers, in the notation of this program, SymPy, SageMath and Mathematica.

use super::{FieldBuilder, FieldError, MAX_FIELD_DEGREE, Number, NumberField};
use crate::algebraic::Elem;
use crate::arith::{MAX_DIGITS, ParseNumberError, Rational, parse_rational, ratio};
use crate::poly::Poly;
use std::collections::BTreeMap;
use thiserror::Error;

/// Deepest nesting of brackets.
const MAX_DEPTH: usize = 32;

/// Why an expression is none, with the byte where it goes wrong.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong.
    pub message: String,
    /// The byte of the text at which it shows.
    pub at: usize,
    /// How to mend it.
    pub help: Option<String>,
    /// A word for the kind of mistake: `number`, `syntax`, `limit`, `name`, `zero-denominator`, `not-real`, `root`.
    pub code: &'static str,
}

/// What a part of an expression stands for.
#[derive(Clone)]
enum Value {
    Number(Number),
    /// A rational multiple of π.
    Angle(Rational),
}

/// Reads expressions from a text, from left to right.
pub struct Expression<'a> {
    text: &'a str,
    at: usize,
    /// Whether white space outside brackets ends the expression.
    tight: bool,
    /// How many brackets are open.
    open: usize,
    /// How many decimals were read.
    pub decimals: usize,
    /// The bits of all rational numbers that were read.
    pub bits: u64,
}

type Read<T> = Result<T, ExpressionError>;

fn error(code: &'static str, at: usize, message: impl Into<String>) -> ExpressionError {
    ExpressionError { message: message.into(), at, help: None, code }
}

impl ExpressionError {
    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

fn field_error(at: usize, e: &FieldError) -> ExpressionError {
    match e {
        FieldError::Degree(_) => error("limit", at, e.to_string()).help(format!(
            "number fields up to degree {MAX_FIELD_DEGREE} are built; use fewer different roots and angles in one matrix"
        )),
        FieldError::NotReal => error("not-real", at, e.to_string()).help("only real numbers are read"),
        FieldError::DivisionByZero => error("zero-denominator", at, e.to_string()),
        FieldError::Roots(_) => error("root", at, e.to_string())
            .help("give rational bounds with exactly one root between them, as in root(x^3 - x - 1, 1, 2)"),
        FieldError::ZeroPolynomial => error("root", at, e.to_string()),
        FieldError::Power => error("limit", at, e.to_string()),
    }
}

const WRITE: &str = "write integers, fractions, decimals, sqrt(5), cbrt(2), cos(2*pi/7), sin(pi/5), root(x^3 - x - 1, 1, 2), \
                     with + - * / ^ and brackets";

impl<'a> Expression<'a> {
    /// A reader that starts at the byte `at` of a text; a `tight` one stops at white space outside brackets.
    pub fn new(text: &'a str, at: usize, tight: bool) -> Self {
        Self { text, at, tight, open: 0, decimals: 0, bits: 0 }
    }

    /// The byte at which reading goes on.
    pub fn position(&self) -> usize {
        self.at
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn skip(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    /// Skips blanks where they do not end the expression; true when the expression may go on.
    fn skip_inside(&mut self) -> bool {
        if self.open > 0 || !self.tight {
            self.skip();
            return true;
        }
        !self.peek().is_none_or(char::is_whitespace)
    }

    fn found(&self) -> String {
        self.peek().map_or("the end of the text".to_owned(), |c| format!("`{c}`"))
    }

    fn accept(&mut self, c: char) -> bool {
        self.skip();
        let there = self.peek() == Some(c);
        if there {
            self.at += c.len_utf8();
        }
        there
    }

    fn expect(&mut self, c: char) -> Read<()> {
        if self.accept(c) {
            return Ok(());
        }
        Err(error("syntax", self.at, format!("`{c}` is expected here, not {}", self.found())))
    }

    /// A number; the text may go on after it.
    pub fn number(&mut self, builder: &mut FieldBuilder) -> Read<Number> {
        let start = self.at;
        match self.sum(builder, 0)? {
            Value::Number(x) => Ok(x),
            Value::Angle(_) => Err(error("number", start, "a multiple of π is not an algebraic number")
                .help("π may only stand in the angle of a cosine or sine, as in cos(2*pi/7)")),
        }
    }

    fn sum(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        let mut value = self.product(builder, depth)?;
        while self.skip_inside() {
            let at = self.at;
            let minus = match self.peek() {
                Some('+') => false,
                Some('-' | '−') => true,
                _ => break,
            };
            // In a row of blank-separated entries `a -b` are two of them.
            self.at += self.peek().map_or(0, char::len_utf8);
            let next = self.product(builder, depth)?;
            value = match (value, next) {
                (Value::Number(a), Value::Number(b)) => {
                    Value::Number(if minus { builder.sub(&a, &b) } else { builder.add(&a, &b) })
                }
                (Value::Angle(a), Value::Angle(b)) => Value::Angle(if minus { a - b } else { a + b }),
                (Value::Angle(a), Value::Number(b)) | (Value::Number(b), Value::Angle(a))
                    if builder.is_rational(&b).is_some_and(|q| q == 0) =>
                {
                    Value::Angle(a)
                }
                _ => return Err(error("number", at, "π and a number cannot be added exactly")),
            };
        }
        Ok(value)
    }

    fn product(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        let mut value = self.signed(builder, depth)?;
        let mut divided = false;
        while self.skip_inside() {
            let at = self.at;
            let divide = match self.peek() {
                Some('*' | '·' | '×') => {
                    self.at += self.peek().map_or(0, char::len_utf8);
                    false
                }
                Some('/') => {
                    self.at += 1;
                    // Julia writes `1//2` for a rational, and binds it more tightly than `/`.
                    if self.peek() == Some('/') {
                        self.at += 1;
                        if divided {
                            return Err(error("syntax", at, "`/` and `//` in one product").help("use brackets"));
                        }
                    }
                    divided = true;
                    true
                }
                // `2 Pi`, `3 Sqrt[5]`, `(1/2)(3)`
                Some(c) if c.is_alphabetic() || c == '(' || c == '√' || c == 'π' => false,
                _ => break,
            };
            self.skip_inside();
            let next = self.signed(builder, depth)?;
            value = multiply(builder, value, next, divide, at)?;
        }
        Ok(value)
    }

    fn signed(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        if depth > MAX_DEPTH {
            return Err(error("limit", self.at, "the brackets are nested too deeply"));
        }
        self.skip();
        match self.peek() {
            Some(c @ ('-' | '−')) => {
                self.at += c.len_utf8();
                Ok(match self.signed(builder, depth + 1)? {
                    Value::Number(x) => Value::Number(builder.sub(&builder.rational(&0.into()), &x)),
                    Value::Angle(a) => Value::Angle(-a),
                })
            }
            Some('+') => {
                self.at += 1;
                self.signed(builder, depth + 1)
            }
            _ => self.power(builder, depth),
        }
    }

    fn power(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        let base = self.primary(builder, depth)?;
        if !self.skip_inside() {
            return Ok(base);
        }
        let rest = self.rest();
        let length = if rest.starts_with("**") { 2 } else { usize::from(rest.starts_with('^')) };
        if length == 0 {
            return Ok(base);
        }
        let at = self.at;
        self.at += length;
        // `2^-1` and `2^(1/3)`
        let exponent = self.signed(builder, depth + 1)?;
        let (Value::Number(x), Value::Number(e)) = (base, exponent) else {
            return Err(error("number", at, "powers of π are not algebraic numbers"));
        };
        let Some(q) = builder.is_rational(&e) else {
            return Err(error("number", at, "an exponent must be rational"));
        };
        builder.power(&x, &q).map(Value::Number).map_err(|e| field_error(at, &e))
    }

    fn primary(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        self.skip();
        match self.peek() {
            Some('(') => {
                self.at += 1;
                self.open += 1;
                let value = self.sum(builder, depth + 1)?;
                self.expect(')')?;
                self.open -= 1;
                Ok(value)
            }
            Some('√') => {
                let at = self.at;
                self.at += '√'.len_utf8();
                let argument = self.primary(builder, depth + 1)?;
                root_of(builder, argument, 2, at)
            }
            Some('π') => {
                self.at += 'π'.len_utf8();
                Ok(Value::Angle(1.into()))
            }
            Some(c) if c.is_alphabetic() => self.named(builder, depth),
            _ => self.digits().map(|q| Value::Number(builder.rational(&q))),
        }
    }

    fn digits(&mut self) -> Read<Rational> {
        let bytes = self.rest().as_bytes();
        let mut length = 0;
        while let Some(&c) = bytes.get(length) {
            let after_digit = length > 0;
            let exponent = after_digit
                && matches!(c, b'e' | b'E')
                && bytes[length + 1..].iter().find(|b| !matches!(b, b'+' | b'-')).is_some_and(u8::is_ascii_digit);
            let sign = matches!(c, b'+' | b'-') && after_digit && matches!(bytes[length - 1], b'e' | b'E');
            if !(c.is_ascii_digit() || c == b'.' && bytes.get(length + 1) != Some(&b'.') || exponent || sign) {
                break;
            }
            length += 1;
        }
        let token = &self.rest()[..length];
        if length == 0 {
            return Err(
                error("number", self.at, format!("a number is expected here, not {}", self.found())).help(WRITE)
            );
        }
        let value = parse_rational(token).map_err(|e| match e {
            ParseNumberError::TooLong(_) => {
                error("number-too-long", self.at, e.to_string()).help(format!("at most {MAX_DIGITS} digits are read"))
            }
            _ => error("number", self.at, e.to_string()).help(WRITE),
        })?;
        use malachite_base::num::logic::traits::SignificantBits;
        self.decimals += usize::from(token.contains(['.', 'e', 'E']));
        self.bits += value.numerator_ref().significant_bits() + value.denominator_ref().significant_bits();
        self.at += length;
        // Mathematica marks the precision of a decimal with a back quote.
        if self.peek() == Some('`') {
            self.at += 1;
        }
        Ok(value)
    }

    /// A constant or a call, `sqrt(5)` or `Sqrt[5]`.
    fn named(&mut self, builder: &mut FieldBuilder, depth: usize) -> Read<Value> {
        let start = self.at;
        let rest = self.rest();
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.')).unwrap_or(rest.len());
        let full = &rest[..length];
        self.at += length;
        let name = ["sympy.", "sp.", "np.", "math."].iter().fold(full, |n, p| n.trim_start_matches(p));
        if let Some(x) = builder.constants.get(full) {
            return Ok(Value::Number(x.clone()));
        }
        match name {
            "pi" | "Pi" | "PI" => return Ok(Value::Angle(1.into())),
            "golden_ratio" | "GoldenRatio" => {
                let root = builder.nth_root(&builder.rational(&5.into()), 2).map_err(|e| field_error(start, &e))?;
                let sum = builder.add(&builder.rational(&1.into()), &root);
                return Ok(Value::Number(builder.mul(&builder.rational(&ratio(1, 2)), &sum)));
            }
            _ => {}
        }
        let close = match self.peek() {
            Some('(') => ')',
            Some('[') => ']',
            _ => return Err(unknown(full, start)),
        };
        self.at += 1;
        self.open += 1;
        let value = self.call(builder, name, start, depth)?;
        self.expect(close)?;
        self.open -= 1;
        Ok(value)
    }

    fn call(&mut self, builder: &mut FieldBuilder, name: &str, start: usize, depth: usize) -> Read<Value> {
        match name {
            "sqrt" | "Sqrt" | "cbrt" | "CubeRoot" => {
                let argument = self.sum(builder, depth + 1)?;
                root_of(builder, argument, if name.eq_ignore_ascii_case("sqrt") { 2 } else { 3 }, start)
            }
            "Surd" | "real_nth_root" | "real_root" => {
                let argument = self.sum(builder, depth + 1)?;
                self.expect(',')?;
                let index = self.whole()?;
                root_of(builder, argument, index, start)
            }
            "cos" | "Cos" | "sin" | "Sin" => {
                let argument = self.sum(builder, depth + 1)?;
                let half_turns = self.angle(builder, argument, start)?;
                let turns = half_turns / Rational::from(2);
                let turns = if name.eq_ignore_ascii_case("sin") { ratio(1, 4) - turns } else { turns };
                builder.cos(&turns).map(Value::Number).map_err(|e| field_error(start, &e))
            }
            "root" | "Root" | "CRootOf" | "ComplexRootOf" | "rootof" => self.root(builder, name, start),
            "Rational" | "S" | "QQ" | "ZZ" | "Integer" | "sym" | "AA" | "QQbar" | "RR" | "sympify" | "Divide" => {
                let value = self.sum(builder, depth + 1)?;
                let at = self.at;
                if !self.accept(',') {
                    return Ok(value);
                }
                let divisor = self.sum(builder, depth + 1)?;
                multiply(builder, value, divisor, true, at)
            }
            _ => Err(unknown(name, start)),
        }
    }

    fn angle(&self, builder: &FieldBuilder, value: Value, at: usize) -> Read<Rational> {
        match value {
            Value::Angle(a) => Ok(a),
            Value::Number(x) if builder.is_rational(&x).is_some_and(|q| q == 0) => Ok(0.into()),
            Value::Number(_) => Err(error("number", at, "the angle is not a rational multiple of π")
                .help("cosines and sines of rational multiples of π are algebraic, as in cos(2*pi/7)")),
        }
    }

    fn whole(&mut self) -> Read<usize> {
        self.skip();
        let at = self.at;
        let q = self.digits()?;
        usize::try_from(&q).map_err(|_| error("number", at, "a whole number is expected here"))
    }

    /// A rational bound, which may have a sign.
    fn bound(&mut self, builder: &mut FieldBuilder) -> Read<Rational> {
        self.skip();
        let at = self.at;
        match self.sum(builder, 1)? {
            Value::Number(x) => builder.is_rational(&x),
            Value::Angle(_) => None,
        }
        .ok_or_else(|| error("root", at, "the bounds of a root are rational"))
    }

    /// `root(x^3 - x - 1, 1, 2)`, `CRootOf(x**3 - x - 1, 0)`, `Root[#^3 - # - 1 &, 1]`.
    fn root(&mut self, builder: &mut FieldBuilder, name: &str, start: usize) -> Read<Value> {
        let f = self.polynomial(1)?;
        self.accept('&');
        self.expect(',')?;
        let fail = |e: FieldError| field_error(start, &e);
        if name == "root" {
            let lo = self.bound(builder)?;
            self.expect(',')?;
            let hi = self.bound(builder)?;
            return builder.root_between(&f, &lo, &hi).map(Value::Number).map_err(fail);
        }
        let at = self.at;
        let place = self.whole()?;
        let place = if name == "Root" { place.checked_sub(1) } else { Some(place) };
        let place = place.ok_or_else(|| error("root", at, "Mathematica numbers the roots from 1"))?;
        builder.root_number(&f, place).map(Value::Number).map_err(fail)
    }

    /// A polynomial with rational coefficients in one unknown, a letter or `#`.
    fn polynomial(&mut self, depth: usize) -> Read<Poly> {
        let f = self.polynomial_sum(&mut Names::One(None), depth)?;
        match f.degree() {
            Some(d) if d > MAX_FIELD_DEGREE => Err(error("limit", self.at, format!("a polynomial of degree {d}"))
                .help(format!("polynomials up to degree {MAX_FIELD_DEGREE} are read"))),
            _ => Ok(f),
        }
    }

    fn polynomial_sum(&mut self, names: &mut Names<'a, '_>, depth: usize) -> Read<Poly> {
        if depth > MAX_DEPTH {
            return Err(error("limit", self.at, "the brackets are nested too deeply"));
        }
        let mut sum = Poly::zero();
        let mut negative = self.accept('-');
        loop {
            let term = self.polynomial_product(names, depth)?;
            sum = if negative { &sum - &term } else { &sum + &term };
            if self.accept('+') {
                negative = false;
            } else if self.accept('-') {
                negative = true;
            } else {
                return Ok(sum);
            }
        }
    }

    fn polynomial_product(&mut self, names: &mut Names<'a, '_>, depth: usize) -> Read<Poly> {
        let mut product = self.polynomial_power(names, depth)?;
        loop {
            self.skip();
            let at = self.at;
            match self.peek() {
                Some('*') => {
                    self.at += 1;
                    product = &product * &self.polynomial_power(names, depth)?;
                }
                Some('/') => {
                    self.at += 1;
                    let divisor = self.polynomial_power(names, depth)?;
                    if divisor.degree() != Some(0) {
                        return Err(error("root", at, "a polynomial is divided by rational numbers only, not by zero"));
                    }
                    product = product.scale(&(Rational::from(1) / divisor.coeff(0)));
                }
                Some(c) if c.is_alphabetic() || c == '(' || c == '#' => {
                    product = &product * &self.polynomial_power(names, depth)?;
                }
                _ => return Ok(product),
            }
            if product.degree() > Some(MAX_FIELD_DEGREE) {
                return Err(error("limit", at, format!("a polynomial of degree over {MAX_FIELD_DEGREE}")));
            }
        }
    }

    fn polynomial_power(&mut self, names: &mut Names<'a, '_>, depth: usize) -> Read<Poly> {
        self.skip();
        let base = match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.polynomial_sum(names, depth + 1)?;
                self.expect(')')?;
                inner
            }
            Some(c) if c.is_alphabetic() || c == '#' => {
                let rest = self.rest();
                let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '#')).unwrap_or(rest.len());
                let name = &rest[..length];
                let value = names.value(name, self.at)?;
                self.at += length;
                value
            }
            _ => Poly::constant(self.digits()?),
        };
        let length = if self.rest().starts_with("**") { 2 } else { usize::from(self.accept_caret()) };
        if length == 0 {
            return Ok(base);
        }
        if length == 2 {
            self.at += 2;
        }
        let at = self.at;
        let exponent = self.whole()?;
        let degree = base.degree().unwrap_or(0).max(1).saturating_mul(exponent);
        if degree > MAX_FIELD_DEGREE {
            return Err(error("limit", at, format!("a polynomial of degree {degree}"))
                .help(format!("polynomials up to degree {MAX_FIELD_DEGREE} are read")));
        }
        Ok(base.pow(exponent))
    }

    fn accept_caret(&mut self) -> bool {
        self.accept('^')
    }
}

/// What the names in a polynomial stand for.
enum Names<'a, 'b> {
    /// One unknown, whatever its name.
    One(Option<&'a str>),
    /// These polynomials.
    Given(&'b BTreeMap<String, Poly>),
}

impl<'a> Names<'a, '_> {
    fn value(&mut self, name: &'a str, at: usize) -> Read<Poly> {
        match self {
            Self::One(unknown) => {
                if unknown.is_some_and(|u| u != name) {
                    return Err(error("root", at, format!("a second unknown `{name}` in the polynomial"))
                        .help("the polynomial of a root has one unknown and rational coefficients"));
                }
                *unknown = Some(name);
                Ok(Poly::new(vec![0.into(), 1.into()]))
            }
            Self::Given(values) => values.get(name).cloned().ok_or_else(|| {
                let shown: String = name.chars().take(40).collect();
                error("name", at, format!("`{shown}` is no parameter of this case"))
                    .help("declare it under [parameters], as in  w = \"-1/2..1/2\"")
            }),
        }
    }
}

/// A polynomial in one parameter, from an expression with `+ - * / ^`, brackets and these names; divisors are numbers.
///
/// # Errors
/// [`ExpressionError`] with the byte where it goes wrong.
///
/// # Examples
/// ```
/// use secant_exact::algebraic::field::polynomial;
/// use secant_exact::arith::ratio;
/// use secant_exact::poly::Poly;
/// let w = Poly::new(vec![ratio(0, 1), ratio(1, 1)]);
/// let names = [("w".to_owned(), w)].into();
/// assert_eq!(polynomial("1/2 + 2w(1 - w)", &names)?.eval(&ratio(1, 4)), ratio(7, 8));
/// assert!(polynomial("1/w", &names).is_err() && polynomial("v", &names).is_err());
/// # Ok::<(), secant_exact::algebraic::field::ExpressionError>(())
/// ```
pub fn polynomial(text: &str, names: &BTreeMap<String, Poly>) -> Result<Poly, ExpressionError> {
    let mut reader = Expression::new(text, 0, false);
    let f = reader.polynomial_sum(&mut Names::Given(names), 0)?;
    reader.skip();
    if reader.at < text.len() {
        let found = reader.found();
        return Err(error("syntax", reader.at, format!("{found} does not belong here")).help(WRITE));
    }
    Ok(f)
}

fn unknown(name: &str, at: usize) -> ExpressionError {
    let shown: String = name.chars().take(40).collect();
    let unknown = error("name", at, format!("`{shown}` is not an exact real number"));
    if shown.chars().count() == 1 {
        return unknown.help(
            "a letter has no value here: write the number; parameters are those of schemes, as in `four-point w=1/16`",
        );
    }
    unknown.help(WRITE)
}

fn root_of(builder: &mut FieldBuilder, value: Value, index: usize, at: usize) -> Read<Value> {
    let Value::Number(x) = value else {
        return Err(error("number", at, "roots of π are not algebraic numbers"));
    };
    builder.nth_root(&x, index).map(Value::Number).map_err(|e| field_error(at, &e))
}

fn multiply(builder: &FieldBuilder, a: Value, b: Value, divide: bool, at: usize) -> Read<Value> {
    let by_zero = || field_error(at, &FieldError::DivisionByZero);
    match (a, b) {
        (Value::Number(a), Value::Number(b)) if divide => {
            builder.div(&a, &b).map(Value::Number).map_err(|e| field_error(at, &e))
        }
        (Value::Number(a), Value::Number(b)) => Ok(Value::Number(builder.mul(&a, &b))),
        (Value::Angle(a), Value::Number(b)) => match builder.is_rational(&b) {
            Some(q) if divide && q == 0 => Err(by_zero()),
            Some(q) => Ok(Value::Angle(if divide { a / q } else { a * q })),
            None => Err(error("number", at, "an angle must be a rational multiple of π")),
        },
        (Value::Number(a), Value::Angle(b)) if !divide => match builder.is_rational(&a) {
            Some(q) => Ok(Value::Angle(q * b)),
            None => Err(error("number", at, "an angle must be a rational multiple of π")),
        },
        (Value::Angle(a), Value::Angle(b)) if divide && b != 0 => Ok(Value::Number(builder.rational(&(a / b)))),
        _ => Err(error("number", at, "π may only stand in the angle of a cosine or sine")),
    }
}

impl FieldBuilder {
    /// Reads one number, such as `(1+sqrt(3))/4`, `3/8 + cos(2*pi/7)/4`, `root(x^3-x-1, 1, 2)`, `Sqrt[5]`; the
    /// constants of [`FieldBuilder::define`] are known.
    ///
    /// # Errors
    /// An [`ExpressionError`] with the place and a way to mend it.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{algebraic::field::FieldBuilder, arith::ratio};
    /// let mut builder = FieldBuilder::new();
    /// let x = builder.parse("(1+sqrt(5))/2").expect("a number");
    /// let square = builder.mul(&x, &x);
    /// assert_eq!(builder.is_rational(&builder.sub(&square, &x)), Some(ratio(1, 1)));
    /// assert!(builder.parse("sqrt(").is_err());
    /// ```
    pub fn parse(&mut self, text: &str) -> Result<Number, ExpressionError> {
        if text.len() > 2 * MAX_DIGITS + 64 {
            return Err(error("number-too-long", 0, format!("an expression of {} characters is too long", text.len()))
                .help(format!("at most {MAX_DIGITS} digits are read")));
        }
        let mut reader = Expression::new(text, 0, false);
        let value = reader.number(self)?;
        reader.skip();
        match reader.peek() {
            None => Ok(value),
            Some(c) => Err(error("syntax", reader.at, format!("`{c}` comes after the number")).help(WRITE)),
        }
    }

    /// Gives a name to a number, for later expressions.
    ///
    /// # Errors
    /// An [`ExpressionError`] of the text, or for a name that is not made of letters, digits and underscores or has a
    /// meaning already.
    pub fn define(&mut self, name: &str, text: &str) -> Result<(), ExpressionError> {
        let word = name.starts_with(char::is_alphabetic) && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let taken = ["pi", "Pi", "PI", "golden_ratio", "GoldenRatio"].contains(&name);
        if !word || taken || self.constants.contains_key(name) {
            let message = format!("`{name}` cannot be the name of a constant");
            return Err(error("name", 0, message).help("use letters, digits and underscores, and each name once"));
        }
        let value = self.parse(text)?;
        self.constants.insert(name.to_owned(), value);
        Ok(())
    }
}

impl NumberField {
    /// Reads numbers into the smallest field that holds them all.
    ///
    /// # Errors
    /// The first [`ExpressionError`], with the position of its text in the list.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::algebraic::field::NumberField;
    /// let (field, entries) = NumberField::read(&["sqrt(2)", "sqrt(8)", "1/2"]).expect("numbers");
    /// assert_eq!((field.degree(), entries.len()), (2, 3));
    /// ```
    pub fn read(texts: &[&str]) -> Result<(Self, Vec<Elem>), (usize, ExpressionError)> {
        let mut builder = FieldBuilder::new();
        let numbers: Result<Vec<Number>, _> =
            texts.iter().enumerate().map(|(k, t)| builder.parse(t).map_err(|e| (k, e))).collect();
        Ok(builder.finish(&numbers?))
    }
}
