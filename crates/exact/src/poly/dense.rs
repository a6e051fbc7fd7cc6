use super::ints::{self, IntPoly};
use crate::arith::{Integer, Rational};
use std::cmp::Ordering;
use std::fmt::Write as _;
use std::ops::{Add, Mul, Neg, Sub};

/// A polynomial over the rationals, dense, low degree first, without trailing zeros; the zero polynomial is empty.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Poly {
    coeffs: Vec<Rational>,
}

impl Poly {
    /// The polynomial with these coefficients, low degree first; trailing zeros are dropped.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, poly::Poly};
    /// let f = Poly::new(vec![ratio(1, 16), ratio(-5, 8), ratio(1, 1), ratio(0, 1)]);
    /// assert_eq!((f.degree(), f.display("x").as_str()), (Some(2), "x^2 - 5/8x + 1/16"));
    /// ```
    #[must_use]
    pub fn new(mut coeffs: Vec<Rational>) -> Self {
        while coeffs.last().is_some_and(|c| *c == 0) {
            coeffs.pop();
        }
        Self { coeffs }
    }

    /// The zero polynomial.
    #[must_use]
    pub fn zero() -> Self {
        Self { coeffs: Vec::new() }
    }

    /// The constant `c`.
    #[must_use]
    pub fn constant(c: Rational) -> Self {
        Self::new(vec![c])
    }

    /// The polynomial `x - root`.
    #[must_use]
    pub fn linear(root: &Rational) -> Self {
        Self { coeffs: vec![-root, Rational::from(1)] }
    }

    /// The polynomial of least degree with these values at different numbers (Newton).
    ///
    /// # Panics
    /// If there are not as many values as numbers, or two numbers are equal.
    #[must_use]
    pub fn through(at: &[Rational], mut values: Vec<Rational>) -> Self {
        assert_eq!(at.len(), values.len(), "a value for every number");
        for step in 1..at.len() {
            for k in (step..at.len()).rev() {
                values[k] = (&values[k] - &values[k - 1]) / (&at[k] - &at[k - step]);
            }
        }
        let next = |f: Self, k: usize| &(&f * &Self::linear(&at[k])) + &Self::constant(values[k].clone());
        (0..at.len()).rev().fold(Self::zero(), next)
    }

    /// The coefficients, low degree first.
    #[must_use]
    pub fn coeffs(&self) -> &[Rational] {
        &self.coeffs
    }

    /// The coefficient of `x^k`, 0 beyond the degree.
    #[must_use]
    pub fn coeff(&self, k: usize) -> Rational {
        self.coeffs.get(k).cloned().unwrap_or_default()
    }

    /// The degree; `None` for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        self.coeffs.len().checked_sub(1)
    }

    /// Whether this is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.coeffs.is_empty()
    }

    /// The leading coefficient; `None` for the zero polynomial.
    #[must_use]
    pub fn leading(&self) -> Option<&Rational> {
        self.coeffs.last()
    }

    /// The value at `x` (Horner).
    #[must_use]
    pub fn eval(&self, x: &Rational) -> Rational {
        let mut value = Rational::from(0);
        for c in self.coeffs.iter().rev() {
            value = value * x + c;
        }
        value
    }

    /// The polynomial divided by its leading coefficient; the zero polynomial stays.
    #[must_use]
    pub fn monic(&self) -> Self {
        match self.leading() {
            Some(lead) if *lead != 1 => self.scale(&(Rational::from(1) / lead)),
            _ => self.clone(),
        }
    }

    /// The derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self::new(self.coeffs.iter().enumerate().skip(1).map(|(k, c)| c * Rational::from(k)).collect())
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        Self::new(self.coeffs.iter().map(|c| c * factor).collect())
    }

    /// `self^e`.
    ///
    /// # Cost
    /// `e` products.
    #[must_use]
    pub fn pow(&self, e: usize) -> Self {
        (0..e).fold(Self::constant(Rational::from(1)), |acc, _| &acc * self)
    }

    /// Quotient and remainder: `self = q * divisor + r` with `deg r < deg divisor`.
    ///
    /// # Panics
    /// If `divisor` is zero.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, poly::Poly};
    /// let f = Poly::new([-1, 0, 0, 1].map(|c| ratio(c, 1)).to_vec()); // x³ − 1
    /// let (quotient, rest) = f.div_rem(&Poly::linear(&ratio(1, 1)));
    /// assert_eq!((quotient.display("x").as_str(), rest.is_zero()), ("x^2 + x + 1", true));
    /// ```
    #[must_use]
    pub fn div_rem(&self, divisor: &Self) -> (Self, Self) {
        let lead = divisor.leading().expect("division by the zero polynomial");
        let d = divisor.coeffs.len() - 1;
        let mut rest = self.coeffs.clone();
        let mut quotient = vec![Rational::from(0); rest.len().saturating_sub(d)];
        let inverse = Rational::from(1) / lead;
        for k in (0..quotient.len()).rev() {
            let q = if *lead == 1 { rest[k + d].clone() } else { &rest[k + d] * &inverse };
            if q != 0 {
                for (j, c) in divisor.coeffs[..d].iter().enumerate() {
                    rest[k + j] -= &q * c;
                }
            }
            quotient[k] = q;
        }
        rest.truncate(d);
        (Self::new(quotient), Self::new(rest))
    }

    /// The monic greatest common divisor; 0 for two zero polynomials.
    ///
    /// # Cost
    /// Modular (primes of 62 bits until the result divides both): quasi-quadratic in the degree.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{arith::ratio, poly::Poly};
    /// let [a, b, c] = [1, 2, 3].map(|root| Poly::linear(&ratio(root, 1)));
    /// assert_eq!((&a * &b).gcd(&(&b * &c)), b);
    /// ```
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        Self::from_ints(&ints::gcd(&self.primitive(), &other.primitive())).monic()
    }

    /// `self(shift + x)` for a rational shift.
    #[must_use]
    pub fn shifted(&self, shift: &Rational) -> Self {
        let mut c = self.coeffs.clone();
        for i in 0..c.len() {
            for j in (i..c.len() - 1).rev() {
                let change = &c[j + 1] * shift;
                c[j] += change;
            }
        }
        Self::new(c)
    }

    /// The primitive integer polynomial with positive leading coefficient proportional to this one.
    #[must_use]
    pub fn primitive(&self) -> IntPoly {
        ints::from_rationals(&self.coeffs)
    }

    /// The polynomial with these integer coefficients.
    #[must_use]
    pub fn from_ints(coeffs: &[Integer]) -> Self {
        Self::new(coeffs.iter().map(Rational::from).collect())
    }

    /// Text with rational coefficients, such as `x^2 - 5/8x + 1/16`.
    #[must_use]
    pub fn display(&self, var: &str) -> String {
        let mut out = String::new();
        for (k, c) in self.coeffs.iter().enumerate().rev().filter(|(_, c)| **c != 0) {
            let magnitude = crate::arith::abs(c);
            let sign = if *c < 0 { "-" } else { "+" };
            if out.is_empty() {
                out.push_str(if *c < 0 { "-" } else { "" });
            } else {
                let _ = write!(out, " {sign} ");
            }
            if k == 0 || magnitude != 1 {
                let _ = write!(out, "{magnitude}");
            }
            match k {
                0 => {}
                1 => out.push_str(var),
                _ => {
                    let _ = write!(out, "{var}^{k}");
                }
            }
        }
        if out.is_empty() { "0".to_owned() } else { out }
    }

    /// Text of the proportional primitive integer polynomial, such as `16x^2 - 10x + 1`.
    #[must_use]
    pub fn primitive_display(&self, var: &str) -> String {
        Self::from_ints(&self.primitive()).display(var)
    }
}

/// By degree, then by the coefficients from the constant one up.
impl Ord for Poly {
    fn cmp(&self, other: &Self) -> Ordering {
        self.coeffs.len().cmp(&other.coeffs.len()).then_with(|| self.coeffs.cmp(&other.coeffs))
    }
}

impl PartialOrd for Poly {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Add for &Poly {
    type Output = Poly;
    fn add(self, other: Self) -> Poly {
        let (long, short) = if self.coeffs.len() >= other.coeffs.len() { (self, other) } else { (other, self) };
        let mut sum = long.coeffs.clone();
        for (s, c) in sum.iter_mut().zip(&short.coeffs) {
            *s += c;
        }
        Poly::new(sum)
    }
}

impl Sub for &Poly {
    type Output = Poly;
    fn sub(self, other: Self) -> Poly {
        let mut difference = self.coeffs.clone();
        if difference.len() < other.coeffs.len() {
            difference.resize(other.coeffs.len(), Rational::from(0));
        }
        for (s, c) in difference.iter_mut().zip(&other.coeffs) {
            *s -= c;
        }
        Poly::new(difference)
    }
}

impl Neg for &Poly {
    type Output = Poly;
    fn neg(self) -> Poly {
        Poly { coeffs: self.coeffs.iter().map(|c| -c).collect() }
    }
}

impl Mul for &Poly {
    type Output = Poly;
    fn mul(self, other: Self) -> Poly {
        if self.is_zero() || other.is_zero() {
            return Poly::zero();
        }
        let mut product = vec![Rational::from(0); self.coeffs.len() + other.coeffs.len() - 1];
        for (i, a) in self.coeffs.iter().enumerate().filter(|(_, a)| **a != 0) {
            for (j, b) in other.coeffs.iter().enumerate().filter(|(_, b)| **b != 0) {
                product[i + j] += a * b;
            }
        }
        Poly::new(product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn p(c: &[i64]) -> Poly {
        Poly::new(c.iter().map(|x| ratio(*x, 1)).collect())
    }

    #[test]
    fn division_and_gcd() {
        let (a, b) = (p(&[-1, 0, 0, 1]), p(&[-2, 2]));
        let (q, r) = a.div_rem(&b);
        assert_eq!(&(&q * &b) + &r, a);
        assert!(r.is_zero());
        assert_eq!(a.gcd(&b), p(&[-1, 1]));
        assert_eq!(Poly::zero().gcd(&b), p(&[-1, 1]));
        assert_eq!(p(&[1, 0, 1]).gcd(&p(&[2, 1])), p(&[1]));
    }

    #[test]
    fn text() {
        let f = Poly::new(vec![ratio(1, 16), ratio(-5, 8), ratio(1, 1)]);
        assert_eq!(f.display("x"), "x^2 - 5/8x + 1/16");
        assert_eq!(f.primitive_display("x"), "16x^2 - 10x + 1");
        assert_eq!(p(&[0, -1]).display("t"), "-t");
        assert_eq!(Poly::zero().display("x"), "0");
    }

    #[test]
    fn shift() {
        assert_eq!(p(&[1, 0, 1]).shifted(&ratio(2, 1)), p(&[5, 4, 1]));
    }
}
