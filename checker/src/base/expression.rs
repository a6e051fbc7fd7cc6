//! Numbers of a case over a number field: `sqrt(3)`, `(1 + sqrt(5))/2`, `cos(2*pi/7)`, `root(x^3 - x - 1, 1, 2)`.
//!
//! What is no fraction must be among the numbers that the certificate lists: a root of `a` is the one `e` of them with
//! `e^n = a`, which is not negative where `n` is even; a cosine of `p` of `q` parts of a turn is a root of the polynomial of
//! Chebyshev `T_q − 1`, whose roots are the cosines of multiples of this part, and lies nearer to no other one of these.

use super::cosine::{PLACES, alone, chebyshev, cosine};
use super::file::{NUMBERS, number as rational};
use super::number::decimal_fraction;
use super::surd::{Ground, Surd};
use super::whole::{Fraction, Whole};
use super::{Checked, Json, Matrix, Node, Q, need, some, whole};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Deepest brackets.
const MAX_DEPTH: usize = 60;
/// Largest index of a root, exponent, and denominator of an angle.
const MAX_INDEX: usize = 24;
const MAX_EXPONENT: usize = 200;
const MAX_ANGLE: usize = 1_000;

/// A number as a matrix of one entry.
type Number = Matrix<Surd>;

/// What an expression is: a number, or a multiple of π.
enum Value {
    Number(Number),
    Angle(Q),
}

/// Reads a number of a case.
pub fn number(node: &Node<'_>, ground: &Ground) -> Checked<Fraction<Surd>> {
    let plain = rational(node);
    let Json::Text(text) = node.value else { return Ok(super::whole::fraction(&plain?)) };
    if let Ok(q) = plain {
        return Ok(super::whole::fraction(&q));
    }
    let mut reader = Reader { text, at: 0, depth: 0, ground };
    let read = reader.sum().and_then(|value| {
        reader.skip();
        need(reader.at == text.len(), "case", "this is no expression that is read")?;
        reader.plain(value)
    });
    let found = node.at(read)?;
    Ok((found.data[0].clone(), found.den))
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    ground: &'a Ground,
}

fn constant(x: &Q) -> Number {
    Matrix::lifted(&Matrix::new(1, 1, std::slice::from_ref(x)))
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn peek(&mut self) -> Option<char> {
        self.skip();
        self.rest().chars().next()
    }

    /// Goes over one of these texts, where one comes next.
    fn accept(&mut self, words: &[&str]) -> bool {
        self.skip();
        let Some(found) = words.iter().find(|w| self.rest().starts_with(**w)) else { return false };
        self.at += found.len();
        true
    }

    fn expect(&mut self, word: &str) -> Checked<()> {
        need(self.accept(&[word]), "case", format_args!("`{word}` is needed in an expression"))
    }

    fn plain(&self, value: Value) -> Checked<Number> {
        match value {
            Value::Number(x) => Ok(x),
            Value::Angle(_) => super::reject("case", "a multiple of π stands in no angle"),
        }
    }

    fn rational(&self, value: Value) -> Checked<Q> {
        let x = self.plain(value)?;
        let q = Surd::layers(&x);
        need(q.len() == 1, "case", "a rational number is needed in an expression")?;
        Ok(q[0].at(0, 0))
    }

    fn sum(&mut self) -> Checked<Value> {
        self.depth += 1;
        need(self.depth <= MAX_DEPTH, "case", "the brackets are nested too deeply")?;
        let mut value = self.product()?;
        loop {
            let sign = if self.accept(&["+"]) {
                Q::one()
            } else if self.accept(&["-", "−"]) {
                -Q::one()
            } else {
                break;
            };
            let next = self.product()?;
            value = match (value, next) {
                (Value::Number(a), Value::Number(b)) => Value::Number(a.plus(&sign, &b)),
                (Value::Angle(a), Value::Angle(b)) => Value::Angle(a + sign * b),
                _ => return super::reject("case", "π and a number are not added"),
            };
        }
        self.depth -= 1;
        Ok(value)
    }

    fn product(&mut self) -> Checked<Value> {
        let mut value = self.signed()?;
        loop {
            let divide = if self.rest().trim_start().starts_with("//") {
                return super::reject("case", "`//` is not read in an expression");
            } else if self.accept(&["/"]) {
                true
            } else if self.accept(&["*", "·", "×"])
                || self.peek().is_some_and(|c| c.is_alphabetic() || "(√".contains(c))
            {
                false
            } else {
                return Ok(value);
            };
            let next = self.signed()?;
            value = match (value, next) {
                (Value::Number(a), Value::Number(b)) if divide => Value::Number(a.multiple(&inverse(&b)?)),
                (Value::Number(a), Value::Number(b)) => Value::Number(a.multiple(&b)),
                (Value::Angle(a), b @ Value::Number(_)) => {
                    let b = self.rational(b)?;
                    need(!b.is_zero() || !divide, "case", "a division by 0")?;
                    Value::Angle(if divide { a / b } else { a * b })
                }
                (a @ Value::Number(_), Value::Angle(b)) if !divide => Value::Angle(self.rational(a)? * b),
                _ => return super::reject("case", "a product with π twice, or a division by it"),
            };
        }
    }

    fn signed(&mut self) -> Checked<Value> {
        self.depth += 1;
        need(self.depth <= MAX_DEPTH, "case", "the brackets are nested too deeply")?;
        let value = if self.accept(&["-", "−"]) {
            match self.signed()? {
                Value::Number(x) => Value::Number(x.scaled(&-Q::one())),
                Value::Angle(a) => Value::Angle(-a),
            }
        } else if self.accept(&["+"]) {
            self.signed()?
        } else {
            self.power()?
        };
        self.depth -= 1;
        Ok(value)
    }

    fn power(&mut self) -> Checked<Value> {
        let base = self.primary()?;
        if !self.accept(&["**", "^"]) {
            return Ok(base);
        }
        let exponent = self.signed()?;
        let (base, exponent) = (self.plain(base)?, self.rational(exponent)?);
        let index = some(exponent.denom().to_usize(), "case", "a long exponent")?;
        let count = some(exponent.numer().abs().to_usize(), "case", "a long exponent")?;
        need(count <= MAX_EXPONENT, "limit", "a large exponent")?;
        let root = if index == 1 { base } else { self.root(&base, index)? };
        let power = powered(&root, count);
        Ok(Value::Number(if exponent.is_negative() { inverse(&power)? } else { power }))
    }

    fn primary(&mut self) -> Checked<Value> {
        if self.accept(&["("]) {
            let value = self.sum()?;
            self.expect(")")?;
            return Ok(value);
        }
        if self.accept(&["√"]) {
            let value = self.primary()?;
            return self.root(&self.plain(value)?, 2).map(Value::Number);
        }
        if self.accept(&["π"]) {
            return Ok(Value::Angle(Q::one()));
        }
        if self.peek().is_some_and(char::is_alphabetic) {
            return self.named();
        }
        Ok(Value::Number(constant(&self.digits()?)))
    }

    /// A decimal number.
    fn digits(&mut self) -> Checked<Q> {
        self.skip();
        let bytes = self.rest().as_bytes();
        let mut length = 0;
        while let Some(c) = bytes.get(length) {
            let mark = length > 0 && matches!(c, b'e' | b'E');
            let skipped = mark && bytes.get(length + 1).is_some_and(|c| matches!(c, b'+' | b'-'));
            let exponent = mark && bytes.get(length + 1 + usize::from(skipped)).is_some_and(u8::is_ascii_digit);
            if !(c.is_ascii_digit() || *c == b'.' || exponent) {
                break;
            }
            length += 1 + usize::from(exponent && skipped);
        }
        let token = &self.rest()[..length];
        self.at += length;
        some(decimal_fraction(token), "case", "a number is needed in an expression")
    }

    fn whole(&mut self) -> Checked<usize> {
        let q = self.digits()?;
        let k = if q.is_integer() { q.numer().to_usize() } else { None };
        some(k, "case", "a whole number is needed in an expression")
    }

    fn named(&mut self) -> Checked<Value> {
        let rest = self.rest();
        let name = match rest.find(|c: char| !(c.is_alphanumeric() || c == '_')) {
            Some(end) => &rest[..end],
            None => rest,
        };
        self.at += name.len();
        match name {
            "pi" | "Pi" | "PI" => return Ok(Value::Angle(Q::one())),
            "golden_ratio" | "GoldenRatio" => {
                let five = self.root(&constant(&whole(5)), 2)?;
                return Ok(Value::Number(five.plus(&Q::one(), &constant(&whole(1))).scaled(&(whole(1) / whole(2)))));
            }
            _ => {}
        }
        let close = if self.accept(&["("]) {
            ")"
        } else {
            self.expect("[")?;
            "]"
        };
        let value = match name {
            "sqrt" | "Sqrt" => self.sum().and_then(|x| self.root(&self.plain(x)?, 2))?,
            "cbrt" | "CubeRoot" => self.sum().and_then(|x| self.root(&self.plain(x)?, 3))?,
            "Surd" => {
                let x = self.sum()?;
                self.expect(",")?;
                let index = self.whole()?;
                self.root(&self.plain(x)?, index)?
            }
            "cos" | "Cos" | "sin" | "Sin" => {
                let half_turns = match self.sum()? {
                    Value::Angle(a) => a,
                    Value::Number(x) if x.is_zero() => Q::zero(),
                    Value::Number(_) => return super::reject("case", "the angle is no multiple of π"),
                };
                let turns = half_turns / whole(2);
                let sine = name.eq_ignore_ascii_case("sin");
                self.cosine(&if sine { whole(1) / whole(4) - turns } else { turns })?
            }
            "root" => self.between()?,
            "Rational" => {
                let p = self.sum().and_then(|p| self.rational(p))?;
                self.expect(",")?;
                let q = self.sum().and_then(|q| self.rational(q))?;
                need(!q.is_zero(), "case", "a division by 0")?;
                constant(&(p / q))
            }
            _ => return super::reject("case", format_args!("`{name}` is not read in an expression")),
        };
        self.expect(close)?;
        Ok(Value::Number(value))
    }

    /// The first number of the certificate with a property.
    fn listed(&self, holds: impl Fn(&Number) -> Checked<bool>) -> Checked<Number> {
        for (x, den) in &self.ground.numbers {
            let own = Matrix { rows: 1, cols: 1, data: vec![x.clone()], den: den.clone() };
            if holds(&own)? {
                return Ok(own);
            }
        }
        super::reject(NUMBERS, "a root or a cosine of the case is not among the numbers of the certificate")
    }

    /// The real root of a number with an index, not negative where this is even.
    fn root(&self, x: &Number, index: usize) -> Checked<Number> {
        need((1..=MAX_INDEX).contains(&index), "limit", "a root of a large index")?;
        if x.is_zero() {
            return Ok(x.clone());
        }
        let even = index.is_multiple_of(2);
        self.listed(|e| Ok((!even || e.data[0].sgn() > 0) && powered(e, index) == *x))
    }

    /// `cos 2π turns`.
    fn cosine(&self, turns: &Q) -> Checked<Number> {
        let q = some(turns.denom().to_usize().filter(|q| *q <= MAX_ANGLE), "limit", "a small part of a turn")?;
        let p = some((turns - turns.floor()).numer().to_usize(), "limit", "a small part of a turn")?;
        let exact = match q {
            1 => Some(whole(1)),
            2 => Some(whole(-1)),
            3 => Some(-whole(1) / whole(2)),
            4 => Some(whole(0)),
            6 => Some(whole(1) / whole(2)),
            _ => None,
        };
        if let Some(x) = exact {
            return Ok(constant(&x));
        }
        let p = p.min(q - p);
        let others: Vec<[Q; 2]> = (0..=q / 2).map(|j| cosine(j, q)).collect::<Checked<_>>()?;
        self.listed(|e| {
            if chebyshev(e, q)? != constant(&whole(1)) {
                return Ok(false);
            }
            // One of the cosines; it is not any of those whose enclosures it does not meet.
            let [lo, hi] = e.data[0].rounded(&e.den, PLACES);
            let scale = BigInt::one() << PLACES;
            let (lo, hi) = (Q::new(lo, scale.clone()), Q::new(hi, scale));
            let mut met = (0..others.len()).filter(|&j| others[j][0] <= hi && lo <= others[j][1]);
            Ok(met.next() == Some(p) && met.next().is_none())
        })
    }

    /// `polynomial, lo, hi`: its only real root there.
    fn between(&mut self) -> Checked<Number> {
        let p = self.polynomial()?;
        self.expect(",")?;
        let lo = self.sum().and_then(|x| self.rational(x))?;
        self.expect(",")?;
        let hi = self.sum().and_then(|x| self.rational(x))?;
        need(lo < hi && alone(&p, &lo, &hi)?, "case", "the polynomial is not seen to have one root there")?;
        self.listed(|e| {
            let value =
                p.iter().rev().fold(constant(&Q::zero()), |sum, c| sum.multiple(e).plus(&Q::one(), &constant(c)));
            let above = e.minus(&constant(&lo)).data[0].sgn() >= 0;
            Ok(above && constant(&hi).minus(e).data[0].sgn() >= 0 && value.is_zero())
        })
    }

    /// A sum of multiples of powers of `x`: its coefficients, lowest first.
    fn polynomial(&mut self) -> Checked<Vec<Q>> {
        let mut coefficients = vec![Q::zero(); 1];
        let mut first = true;
        loop {
            let sign = if self.accept(&["+"]) {
                Q::one()
            } else if self.accept(&["-", "−"]) {
                -Q::one()
            } else if first {
                Q::one()
            } else {
                return Ok(coefficients);
            };
            first = false;
            let number = self.peek().is_some_and(|c| c.is_ascii_digit());
            let mut factor = if number { self.digits()? } else { Q::one() };
            if number && self.accept(&["/"]) {
                let below = self.digits()?;
                need(!below.is_zero(), "case", "a division by 0")?;
                factor /= below;
            }
            let times = number && self.accept(&["*"]);
            let power = if self.accept(&["x"]) {
                if self.accept(&["**", "^"]) { self.whole()? } else { 1 }
            } else {
                need(number && !times, "case", "a power of x is needed in a polynomial")?;
                0
            };
            need(power <= 4 * MAX_INDEX, "limit", "a polynomial of a large degree")?;
            if coefficients.len() <= power {
                coefficients.resize(power + 1, Q::zero());
            }
            coefficients[power] += sign * factor;
        }
    }
}

fn inverse(x: &Number) -> Checked<Number> {
    let (y, size) = x.data[0].reciprocal()?;
    Ok(Matrix { rows: 1, cols: 1, data: vec![y.multiple(&x.den)], den: size })
}

fn powered(x: &Number, exponent: usize) -> Number {
    (0..exponent).fold(constant(&whole(1)), |power, _| power.multiple(x).reduced())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::surd::tests::ground;

    fn value(text: &str, ground: &Ground) -> Option<Number> {
        let json = Json::Text(text.to_owned());
        let (x, den) = number(&Node { value: &json, place: String::new() }, ground).ok()?;
        Some(Matrix { rows: 1, cols: 1, data: vec![x], den })
    }

    #[test]
    fn expressions_are_read_in_a_field() {
        // sqrt(5), and the cosines of 72 and 144 degrees.
        let five = ground(
            &["-5", "0", "1"],
            ["2", "5/2"],
            &[&["0", "1"], &["-1/4", "1/4"], &["-1/4", "-1/4"], &["1/2", "1/2"]],
        );
        let same = |a: &str, b: &str| assert_eq!(value(a, &five).unwrap(), value(b, &five).unwrap(), "{a} {b}");
        same("sqrt(5)^2", "5");
        same("(1+sqrt(5))/2", "golden_ratio");
        same("2cos(2*pi/5)", "(sqrt(5)-1)/2");
        same("cos(4*pi/5)", "-golden_ratio/2");
        same("cos(-4 pi/5)", "cos(6π/5)");
        same("sin(pi/10)", "Cos[2 Pi/5]");
        same("-2^2 + 1.5e-1", "-77/20");
        same("1/sqrt(5)", "sqrt(5)/5");
        same("5^(-1/2)", "√5/5");
        same("root(x^2 - x - 1, 1, 2)", "golden_ratio + 0*sqrt(5)");
        same("2 - 3 - 4", "-5");
        same("Rational(1, 2)*3", "3/2");
        for text in [
            "sqrt(3)",
            "sqrt(-5)",
            "cos(2*pi/7)",
            "sqrt(5",
            "pi",
            "1/(sqrt(5)^2-5)",
            "sqrt(5) 2",
            "root(x^2-5, -3, 3)",
            "x",
            "",
        ] {
            assert!(value(text, &five).is_none(), "{text}");
        }
    }

    #[test]
    fn other_numbers_of_a_list_are_not_taken() {
        // The list has the opposite of the root, and the cosine of another angle only.
        let lists = ground(&["-5", "0", "1"], ["2", "5/2"], &[&["0", "-1"], &["-1/4", "-1/4"]]);
        for text in ["sqrt(5)", "cos(2*pi/5)", "golden_ratio"] {
            assert!(value(text, &lists).is_none(), "{text}");
        }
        assert!(value("cos(4*pi/5)", &lists).is_some());
        let odd = ground(&["-2", "0", "0", "1"], ["1", "3/2"], &[&["0", "-1"]]);
        assert!(value("cbrt(2)", &odd).is_none() && value("cbrt(-2)", &odd).is_some());
    }
}
