//! Weights as formulas in the valence `n` and the number `k` of a sector, with cosines of multiples of `pi`.

use crate::algebraic::Elem;
use crate::algebraic::field::cosine_polynomial;
use crate::arith::{Rational, parse_rational};
use crate::poly::Poly;
use crate::scheme::rational_cosine;

/// Characters of a formula at most.
const MAX_LENGTH: usize = 2000;
/// Brackets and signs inside each other at most.
const MAX_DEPTH: usize = 64;
/// Exponents at most.
const MAX_POWER: u32 = 64;

/// A formula, and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Formula {
    text: String,
    tree: Tree,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Tree {
    Number(Rational),
    Valence,
    Sector,
    Pi,
    Minus(Box<Tree>),
    Both(char, Box<Tree>, Box<Tree>),
    Power(Box<Tree>, u32),
    Cosine(Box<Tree>),
}

/// A number of the field, or an angle as a multiple of `π`.
enum Value {
    Number(Elem),
    Angle(Rational),
}

/// Where the numbers at a valence live: `Q(2cos(2π/n))`, and for even `n` the field of `s = 2cos(π/n)` above it, in which half
/// angles may be used on the way.
pub(super) struct Cosines {
    n: usize,
    modulus: Poly,
    /// `2cos` of the multiples of the smallest angle.
    twice: Vec<Elem>,
}

impl Cosines {
    pub fn new(n: usize) -> Self {
        let order = if n.is_multiple_of(2) { 2 * n } else { n };
        let modulus = cosine_polynomial(order);
        let generator = Elem::generator(&modulus);
        let mut twice = vec![Elem::from_rational(&Rational::from(2)), generator.clone()];
        while twice.len() <= order / 2 {
            let next = generator.mul(&twice[twice.len() - 1], &modulus).sub(&twice[twice.len() - 2]);
            twice.push(next);
        }
        Self { n, modulus, twice }
    }

    /// `cos(π r)`; `None` where it is no number of the field.
    fn cosine(&self, r: &Rational) -> Option<Elem> {
        let turns = r * Rational::from(self.n as u64);
        if let Ok(a) = i64::try_from(&turns) {
            let n = i64::try_from(self.n).ok()?;
            let half = Rational::from_signeds(1, 2);
            // Of an odd number of sides an odd multiple of π/n is π less an even one.
            let (steps, sign) = match (n % 2, a.rem_euclid(2)) {
                (0, _) => (a.rem_euclid(2 * n), 1),
                (_, 0) => ((a / 2).rem_euclid(n), 1),
                _ => (((a + n) / 2).rem_euclid(n), -1),
            };
            let order = if n % 2 == 0 { 2 * n } else { n };
            let at = usize::try_from(steps.min(order - steps)).ok()?;
            return Some(self.twice[at].scale(&(half * Rational::from(sign))));
        }
        // A multiple of a sixth of π.
        let sixths = i64::try_from(&(r * Rational::from(6))).ok()?;
        rational_cosine(usize::try_from(sixths.rem_euclid(12)).ok()?, 12).map(|c| Elem::from_rational(&c))
    }

    /// An element as a polynomial in `2cos(2π/n)`; `None` where it is none.
    fn lowered(&self, x: &Elem) -> Option<Poly> {
        if !self.n.is_multiple_of(2) {
            return Some(x.0.clone());
        }
        // s² = t + 2.
        let square = Poly::new(vec![2.into(), 1.into()]);
        let mut sum = Poly::zero();
        for (j, c) in x.0.coeffs().iter().enumerate().rev() {
            if j % 2 == 1 {
                if *c != 0 {
                    return None;
                }
                continue;
            }
            sum = &(&sum * &square) + &Poly::constant(c.clone());
        }
        Some(sum.div_rem(&cosine_polynomial(self.n)).1)
    }
}

impl Formula {
    /// Reads a formula: numbers, `n`, `k`, `pi`, `cos(…)`, brackets, `+ − * / ^`.
    ///
    /// # Errors
    /// What is wrong, in words.
    ///
    /// # Examples
    /// ```
    /// use secant::scheme::Formula;
    /// let formula = Formula::parse("(1/4 + cos(2*pi*k/n))/n").unwrap();
    /// assert_eq!(formula.at(4, 1).unwrap().coeff(0), secant::arith::ratio(1, 16));
    /// assert!(Formula::parse("2n").is_err() && Formula::parse("x + 1").is_err());
    /// ```
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.len() > MAX_LENGTH {
            return Err(format!("a formula has {MAX_LENGTH} characters at most"));
        }
        let mut reader = Reader { rest: text, depth: 0 };
        let tree = reader.sum()?;
        match reader.peek() {
            None => Ok(Self { text: text.to_owned(), tree }),
            Some(c) => Err(format!("`{c}` is not expected here; products are written with `*`")),
        }
    }

    /// A number.
    #[must_use]
    pub fn number(value: Rational) -> Self {
        Self { text: value.to_string(), tree: Tree::Number(value) }
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value at a valence and a sector, as a polynomial in `2cos(2π/n)` of degree below that of this number.
    ///
    /// # Errors
    /// What has no value there, in words.
    pub fn at(&self, n: usize, k: i64) -> Result<Poly, String> {
        self.over(&Cosines::new(n), k)
    }

    pub(super) fn over(&self, field: &Cosines, k: i64) -> Result<Poly, String> {
        let outside = || format!("`{}` is no number of the field of cos(2π/n) at n = {}", self.text, field.n);
        match value(&self.tree, field, k).map_err(|e| format!("`{}` at n = {}: {e}", self.text, field.n))? {
            Value::Number(x) => field.lowered(&x).ok_or_else(outside),
            Value::Angle(_) => Err(format!("`{}` is a multiple of pi, and no weight", self.text)),
        }
    }
}

fn value(tree: &Tree, field: &Cosines, k: i64) -> Result<Value, String> {
    let rational = |q: Rational| Value::Number(Elem::from_rational(&q));
    Ok(match tree {
        Tree::Number(q) => rational(q.clone()),
        Tree::Valence => rational(Rational::from(field.n as u64)),
        Tree::Sector => rational(Rational::from(k)),
        Tree::Pi => Value::Angle(Rational::from(1)),
        Tree::Minus(inner) => match value(inner, field, k)? {
            Value::Number(x) => Value::Number(x.neg()),
            Value::Angle(r) => Value::Angle(-r),
        },
        Tree::Cosine(inner) => {
            let angle = match value(inner, field, k)? {
                Value::Angle(r) => r,
                Value::Number(x) if x.is_zero() => Rational::from(0),
                Value::Number(_) => return Err("cos needs a multiple of pi".to_owned()),
            };
            Value::Number(
                field.cosine(&angle).ok_or_else(|| format!("cos({angle} pi) is not in the field of cos(pi/n)"))?,
            )
        }
        Tree::Power(base, exponent) => match value(base, field, k)? {
            Value::Number(x) => {
                let one = Elem::from_rational(&Rational::from(1));
                Value::Number((0..*exponent).fold(one, |p, _| p.mul(&x, &field.modulus)))
            }
            Value::Angle(_) => return Err("a power of pi is no weight".to_owned()),
        },
        Tree::Both(sign, left, right) => both(*sign, value(left, field, k)?, value(right, field, k)?, field)?,
    })
}

fn both(sign: char, left: Value, right: Value, field: &Cosines) -> Result<Value, String> {
    let factor = |x: &Elem| x.is_rational().ok_or_else(|| "a multiple of pi needs a rational factor".to_owned());
    Ok(match (sign, left, right) {
        ('+', Value::Number(a), Value::Number(b)) => Value::Number(a.add(&b)),
        ('-', Value::Number(a), Value::Number(b)) => Value::Number(a.sub(&b)),
        ('*', Value::Number(a), Value::Number(b)) => Value::Number(a.mul(&b, &field.modulus)),
        ('/', Value::Number(a), Value::Number(b)) => {
            let inverse = if b.is_zero() { None } else { b.inv(&field.modulus) };
            Value::Number(a.mul(&inverse.ok_or("a division by 0")?, &field.modulus))
        }
        ('+', Value::Angle(a), Value::Angle(b)) => Value::Angle(a + b),
        ('-', Value::Angle(a), Value::Angle(b)) => Value::Angle(a - b),
        ('*', Value::Angle(a), Value::Number(b)) | ('*', Value::Number(b), Value::Angle(a)) => {
            Value::Angle(a * factor(&b)?)
        }
        ('/', Value::Angle(a), Value::Number(b)) => {
            let b = factor(&b)?;
            if b == 0 {
                return Err("a division by 0".to_owned());
            }
            Value::Angle(a / b)
        }
        _ => return Err("pi stands inside of cos(…) only, alone or with a rational factor".to_owned()),
    })
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

    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let c = self.peek().filter(|c| wanted.contains(c))?;
        self.rest = &self.rest[c.len_utf8()..];
        Some(c)
    }

    fn sum(&mut self) -> Result<Tree, String> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(format!("more than {MAX_DEPTH} brackets inside each other"));
        }
        let mut left = self.product()?;
        while let Some(sign) = self.take(&['+', '-', '−']) {
            let sign = if sign == '−' { '-' } else { sign };
            left = Tree::Both(sign, Box::new(left), Box::new(self.product()?));
        }
        self.depth -= 1;
        Ok(left)
    }

    fn product(&mut self) -> Result<Tree, String> {
        let mut left = self.signed()?;
        while let Some(sign) = self.take(&['*', '/', '·']) {
            let sign = if sign == '·' { '*' } else { sign };
            left = Tree::Both(sign, Box::new(left), Box::new(self.signed()?));
        }
        Ok(left)
    }

    fn signed(&mut self) -> Result<Tree, String> {
        let mut negative = false;
        while let Some(sign) = self.take(&['-', '−', '+']) {
            negative ^= sign != '+';
        }
        let power = self.power()?;
        Ok(if negative { Tree::Minus(Box::new(power)) } else { power })
    }

    fn power(&mut self) -> Result<Tree, String> {
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        self.peek();
        let digits: String = self.rest.chars().take_while(char::is_ascii_digit).collect();
        let exponent = digits.parse().ok().filter(|e| *e <= MAX_POWER);
        let exponent = exponent.ok_or_else(|| format!("an exponent is a whole number from 0 to {MAX_POWER}"))?;
        self.rest = &self.rest[digits.len()..];
        Ok(Tree::Power(Box::new(base), exponent))
    }

    fn atom(&mut self) -> Result<Tree, String> {
        let Some(c) = self.peek() else { return Err("the formula ends too early".to_owned()) };
        if self.take(&['(']).is_some() {
            let inner = self.sum()?;
            return self.take(&[')']).map(|_| inner).ok_or_else(|| "a `)` is missing".to_owned());
        }
        let word = |all: &str, is: fn(char) -> bool| all.chars().take_while(|c| is(*c)).collect::<String>();
        if c.is_ascii_digit() || c == '.' {
            let digits = word(self.rest, |c| c.is_ascii_digit() || c == '.');
            self.rest = &self.rest[digits.len()..];
            return parse_rational(&digits).map(Tree::Number).map_err(|e| e.to_string());
        }
        let name = word(self.rest, char::is_alphanumeric);
        self.rest = &self.rest[name.len()..];
        match name.as_str() {
            "n" => Ok(Tree::Valence),
            "k" => Ok(Tree::Sector),
            "pi" | "π" => Ok(Tree::Pi),
            "cos" if self.take(&['(']).is_some() => {
                let inner = Box::new(self.sum()?);
                self.take(&[')']).map(|_| Tree::Cosine(inner)).ok_or_else(|| "a `)` is missing".to_owned())
            }
            "cos" => Err("cos is followed by its angle in brackets, as in cos(2*pi/n)".to_owned()),
            "" => Err(format!("`{c}` is not expected here")),
            _ => Err(format!("`{name}` is not known; there are n (the valence), k (the sector), pi and cos(…)")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::{ratio, to_f64};

    #[test]
    #[allow(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "decimals")]
    fn values_are_those_of_floats() {
        let texts: [(&str, fn(f64, f64) -> f64); 4] = [
            ("(1/4 + cos(2*pi*k/n) + cos(4*pi*k/n)/2)/n", |n, k| {
                let a = std::f64::consts::TAU * k / n;
                (0.25 + a.cos() + (2.0 * a).cos() / 2.0) / n
            }),
            ("(5/8 - (3/8 + cos(2*pi/n)/4)^2)/n", |n, _| {
                (0.625 - (0.375 + (std::f64::consts::TAU / n).cos() / 4.0).powi(2)) / n
            }),
            ("4/9*cos(pi/n)^2 + cos(pi/n)*cos(pi*(2*k+1)/n)", |n, k| {
                let a = std::f64::consts::PI / n;
                4.0 / 9.0 * a.cos().powi(2) + a.cos() * (a * (2.0 * k + 1.0)).cos()
            }),
            ("1/(2 + cos(2*pi/n)) - -2*k", |n, k| 1.0 / (2.0 + (std::f64::consts::TAU / n).cos()) + 2.0 * k),
        ];
        for (text, expected) in texts {
            let formula = Formula::parse(text).unwrap();
            for n in [3, 4, 5, 6, 7, 8, 9, 12, 15] {
                for k in 0..n {
                    let t = 2.0 * (std::f64::consts::TAU / n as f64).cos();
                    let found =
                        formula.at(n, k as i64).unwrap().coeffs().iter().rev().fold(0.0, |v, c| v * t + to_f64(c));
                    assert!((found - expected(n as f64, k as f64)).abs() < 1e-12, "{text} at {n}, {k}");
                }
            }
        }
        assert_eq!(Formula::parse("cos(pi/3)").unwrap().at(5, 0).unwrap().coeff(0), ratio(1, 2));
    }

    #[test]
    fn what_has_no_value_is_refused() {
        for text in ["1/0", "cos(1)", "cos(pi/7)", "pi", "pi^2", "cos(pi/n)", "1/(k-k)", "cos(pi*cos(2*pi/n))"] {
            assert!(Formula::parse(text).unwrap().at(8, 1).is_err(), "{text}");
        }
        for text in ["", "1 +", "(1", "2k", "cos pi", "1^n", "sin(pi)", "n!", &"(".repeat(200)] {
            assert!(Formula::parse(text).is_err(), "{text}");
        }
    }
}
