//! Weights at the centre as formulas in the valence `n` and the number `k` of a sector, with cosines of multiples of `2π/n`: exact
//! sums `Σ c_m ω^m`, `ω = e^(2πi/n)`.

use super::ball::Ball;
use crate::base::number::decimal_fraction;
use crate::base::{Checked, Json, Node, Q, need, number, reject, some, spend, whole};
use num_traits::{One, ToPrimitive, Zero};

/// Brackets inside each other at most.
const MAX_DEPTH: usize = 64;
/// Exponents at most.
const MAX_POWER: usize = 64;

/// A number `Σ c_m ω^m`; there are several for one number.
#[derive(Debug, Clone)]
pub struct Waves(Vec<Q>);

/// A number, or a multiple of π.
enum Value {
    Number(Waves),
    Angle(Q),
}

impl Waves {
    /// A rational number.
    pub fn rational(n: usize, q: Q) -> Self {
        let mut all = vec![Q::zero(); n];
        all[0] = q;
        Self(all)
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| a + b).collect())
    }

    /// A multiple.
    pub fn scaled(&self, factor: &Q) -> Self {
        Self(self.0.iter().map(|a| a * factor).collect())
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.scaled(&whole(-1)))
    }

    fn times(&self, other: &Self) -> Checked<Self> {
        let n = self.0.len();
        let mut all = vec![Q::zero(); n];
        for (i, a) in self.0.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            spend(n, 256)?;
            for (j, b) in other.0.iter().enumerate().filter(|(_, b)| !b.is_zero()) {
                all[(i + j) % n] += a * b;
            }
        }
        Ok(Self(all))
    }

    /// The inverse, modulo the cyclotomic polynomial (Euclid's algorithm).
    fn inverse(&self) -> Checked<Self> {
        let n = self.0.len();
        let modulus = cyclotomic(n)?;
        let (mut a, mut b) = (trimmed(modulus.clone()), trimmed(divided(self.0.clone(), &modulus)?.1));
        let (mut u, mut v) = (Vec::new(), vec![Q::one()]);
        need(!b.is_empty(), "format", "a division by 0")?;
        while b.len() > 1 {
            let lead = b[b.len() - 1].clone();
            let monic: Vec<Q> = b.iter().map(|x| x / &lead).collect();
            let (quotient, rest) = divided(a, &monic)?;
            let quotient: Vec<Q> = quotient.iter().map(|x| x / &lead).collect();
            let next = less_product(u, &quotient, &v)?;
            (a, b, u, v) = (b, trimmed(rest), v, next);
            need(!b.is_empty(), "vertex", "a cyclotomic polynomial has no factor")?;
        }
        let mut all = vec![Q::zero(); n];
        for (x, c) in all.iter_mut().zip(&v) {
            *x = c / &b[0];
        }
        Ok(Self(all))
    }

    /// Of even `n` a number with powers of `e^(πi/n)` as one with powers of `e^(2πi/n)`, which it must be: the polynomials that vanish
    /// at the former are those in even powers times others.
    fn lowered(self, n: usize) -> Checked<Self> {
        if self.0.len() == n {
            return Ok(self);
        }
        let every = |from: usize| Self(self.0.iter().skip(from).step_by(2).cloned().collect());
        let inside = every(1).vanishes(&cyclotomic(n)?)?;
        need(inside, "format", "a weight is no number of the field of cos(2π/n)")?;
        Ok(every(0))
    }

    /// The number where only `ω^0` has a coefficient.
    fn plain(&self) -> Option<&Q> {
        self.0[1..].iter().all(Q::is_zero).then_some(&self.0[0])
    }

    /// Whether the number is 0: the polynomial in `ω` is a multiple of the cyclotomic one.
    pub fn vanishes(&self, cyclotomic: &[Q]) -> Checked<bool> {
        Ok(divided(self.0.clone(), cyclotomic)?.1.iter().all(Q::is_zero))
    }

    /// The number, with the powers of `ω`.
    pub fn ball(&self, powers: &[Ball]) -> Ball {
        let used = self.0.iter().zip(powers).filter(|(c, _)| !c.is_zero());
        used.fold(Ball::zero(), |sum, (c, power)| sum.plus(&power.times(&Ball::real(c))))
    }

    /// `cos(πr)` with the powers of `e^(2πi/m)`, where that is known.
    fn cosine(m: usize, r: &Q) -> Checked<Self> {
        let (half, order) = (Q::one() / whole(2), m as i64);
        // Of an odd order an odd multiple of π/m is π less an even one.
        for (turns, sign) in [(r * &half, 1), ((r + Q::one()) * &half, -1)] {
            let steps = turns * whole(order);
            if steps.is_integer() {
                let steps = some(steps.to_integer().to_i64(), "format", "an angle is too large")?;
                let mut all = vec![Q::zero(); m];
                for at in [steps.rem_euclid(order), (-steps).rem_euclid(order)] {
                    all[at as usize] += whole(sign) * &half;
                }
                return Ok(Self(all));
            }
        }
        let sixths = r * whole(6);
        need(sixths.is_integer(), "format", "this cosine is no number of the field of cos(2π/n)")?;
        let sixths = some(sixths.to_integer().to_i64(), "format", "an angle is too large")?;
        let twice = match sixths.rem_euclid(12) {
            0 => 2,
            2 | 10 => 1,
            3 | 9 => 0,
            4 | 8 => -1,
            6 => -2,
            _ => return reject("format", "this cosine is no number of the field of cos(2π/n)"),
        };
        Ok(Self::rational(m, whole(twice) * half))
    }
}

/// A polynomial without zeros at its end.
fn trimmed(mut polynomial: Vec<Q>) -> Vec<Q> {
    while polynomial.last().is_some_and(Q::is_zero) {
        polynomial.pop();
    }
    polynomial
}

/// `u − a v` for polynomials.
fn less_product(mut u: Vec<Q>, a: &[Q], v: &[Q]) -> Checked<Vec<Q>> {
    spend(a.len() * v.len(), 512)?;
    if u.len() < a.len() + v.len() {
        u.resize(a.len() + v.len(), Q::zero());
    }
    for (i, x) in a.iter().enumerate() {
        for (j, y) in v.iter().enumerate() {
            u[i + j] -= x * y;
        }
    }
    Ok(u)
}

/// Quotient and remainder of polynomials, from the constant coefficient up; the divisor is monic.
fn divided(mut rest: Vec<Q>, divisor: &[Q]) -> Checked<(Vec<Q>, Vec<Q>)> {
    let degree = divisor.len() - 1;
    let mut quotient = Vec::new();
    while rest.len() > degree {
        spend(divisor.len(), 256)?;
        let Some(lead) = rest.pop() else { break };
        let from = rest.len() - degree;
        for (x, c) in rest[from..].iter_mut().zip(divisor) {
            *x -= c * &lead;
        }
        quotient.push(lead);
    }
    quotient.reverse();
    Ok((quotient, rest))
}

/// The cyclotomic polynomial of the primitive `n`-th roots of unity.
pub fn cyclotomic(n: usize) -> Checked<Vec<Q>> {
    let mut all = vec![Q::zero(); n + 1];
    (all[0], all[n]) = (whole(-1), Q::one());
    for d in (1..n).filter(|d| n.is_multiple_of(*d)) {
        let (quotient, rest) = divided(all, &cyclotomic(d)?)?;
        need(rest.iter().all(Q::is_zero), "vertex", "x^n - 1 has this factor")?;
        all = quotient;
    }
    Ok(all)
}

/// A weight of a case.
#[derive(Debug, Clone)]
pub enum Weight {
    /// A number.
    Number(Q),
    /// A formula.
    Formula(String),
    /// What is left of 1 by `n` of these.
    Rest(Box<Weight>),
}

impl Weight {
    /// Reads a number or a formula.
    pub fn read(node: &Node<'_>) -> Checked<Self> {
        match node.value {
            Json::Text(text) => Ok(Self::Formula(text.clone())),
            _ => Ok(Self::Number(number(node)?)),
        }
    }

    /// The value at a valence and a sector.
    pub fn at(&self, n: usize, k: i64) -> Checked<Waves> {
        match self {
            Self::Number(q) => Ok(Waves::rational(n, q.clone())),
            Self::Rest(weight) => Ok(Waves::rational(n, Q::one()).minus(&weight.at(n, k)?.scaled(&whole(n as i64)))),
            Self::Formula(text) => {
                // Half angles may be used on the way.
                let order = if n.is_multiple_of(2) { 2 * n } else { n };
                let mut reader = Reader { rest: text, n, order, k, depth: 0 };
                let value = reader.sum()?;
                need(reader.peek().is_none(), "format", "the formula does not end")?;
                match value {
                    Value::Number(x) => x.lowered(n),
                    Value::Angle(_) => wrong(),
                }
            }
        }
    }
}

struct Reader<'a> {
    rest: &'a str,
    n: usize,
    order: usize,
    k: i64,
    depth: usize,
}

fn wrong<T>() -> Checked<T> {
    reject("format", "not a formula, or pi outside of an angle")
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

    fn number(&self, q: Q) -> Value {
        Value::Number(Waves::rational(self.order, q))
    }

    fn sum(&mut self) -> Checked<Value> {
        self.depth += 1;
        need(self.depth <= MAX_DEPTH, "limit", "too many brackets")?;
        let mut left = self.product()?;
        while let Some(sign) = self.take(&['+', '-', '−']) {
            let factor = whole(if sign == '+' { 1 } else { -1 });
            left = match (left, self.product()?) {
                (Value::Number(a), Value::Number(b)) => Value::Number(a.plus(&b.scaled(&factor))),
                (Value::Angle(a), Value::Angle(b)) => Value::Angle(a + b * factor),
                _ => return wrong(),
            };
        }
        self.depth -= 1;
        Ok(left)
    }

    fn product(&mut self) -> Checked<Value> {
        let mut left = self.signed()?;
        while let Some(sign) = self.take(&['*', '·', '/']) {
            let mut right = self.signed()?;
            if sign == '/' {
                right = match right {
                    Value::Number(x) => Value::Number(match x.plain().filter(|q| !q.is_zero()) {
                        Some(q) => Waves::rational(self.order, Q::one() / q),
                        None => x.inverse()?,
                    }),
                    Value::Angle(_) => return wrong(),
                };
            }
            left = match (left, right) {
                (Value::Number(a), Value::Number(b)) => Value::Number(a.times(&b)?),
                (Value::Angle(a), Value::Number(b)) | (Value::Number(b), Value::Angle(a)) => {
                    Value::Angle(a * some(b.plain(), "format", "an angle has a rational factor")?)
                }
                _ => return wrong(),
            };
        }
        Ok(left)
    }

    fn signed(&mut self) -> Checked<Value> {
        let mut sign = 1;
        while let Some(c) = self.take(&['-', '−', '+']) {
            sign *= if c == '+' { 1 } else { -1 };
        }
        Ok(match self.power()? {
            Value::Number(x) => Value::Number(x.scaled(&whole(sign))),
            Value::Angle(r) => Value::Angle(r * whole(sign)),
        })
    }

    /// The longest beginning whose characters are of a kind.
    fn word(&mut self, is: fn(char) -> bool) -> String {
        let word: String = self.rest.chars().take_while(|c| is(*c)).collect();
        self.rest = &self.rest[word.len()..];
        word
    }

    fn power(&mut self) -> Checked<Value> {
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        self.peek();
        let exponent = self.word(|c| c.is_ascii_digit()).parse().ok().filter(|e| *e <= MAX_POWER);
        let exponent = some(exponent, "format", "an exponent is a small whole number")?;
        let Value::Number(x) = base else { return wrong() };
        let one = Waves::rational(self.order, Q::one());
        Ok(Value::Number((0..exponent).try_fold(one, |p, _| p.times(&x))?))
    }

    fn atom(&mut self) -> Checked<Value> {
        let Some(c) = self.peek() else { return wrong() };
        if self.take(&['(']).is_some() {
            let inner = self.sum()?;
            need(self.take(&[')']).is_some(), "format", "a bracket is missing")?;
            return Ok(inner);
        }
        if c.is_ascii_digit() || c == '.' {
            let digits = self.word(|c| c.is_ascii_digit() || c == '.');
            return Ok(self.number(some(decimal_fraction(&digits), "format", "not a number")?));
        }
        match self.word(char::is_alphanumeric).as_str() {
            "n" => Ok(self.number(whole(self.n as i64))),
            "k" => Ok(self.number(whole(self.k))),
            "pi" | "π" => Ok(Value::Angle(Q::one())),
            "cos" => {
                need(self.take(&['(']).is_some(), "format", "cos is followed by its angle in brackets")?;
                let angle = self.sum()?;
                need(self.take(&[')']).is_some(), "format", "a bracket is missing")?;
                match angle {
                    Value::Angle(r) => Ok(Value::Number(Waves::cosine(self.order, &r)?)),
                    Value::Number(x) if x.plain().is_some_and(Q::is_zero) => Ok(self.number(Q::one())),
                    Value::Number(_) => wrong(),
                }
            }
            _ => wrong(),
        }
    }
}
