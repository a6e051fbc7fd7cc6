//! Laurent polynomials in several variables: the symbols of masks on lattices.

use super::super::symbol::{self, Symbol};
use super::super::{Laurent, SchemeError};
use crate::arith::Rational;
use std::collections::BTreeMap;

/// Largest number of points of the box around the exponents of a symbol.
pub const MAX_BOX: usize = 4096;
/// Most variables in the text of a symbol.
pub const MAX_VARIABLES: usize = 3;

/// `Σ c_a z^a` with exponents `a` in `Z^s`; no coefficient is 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Terms {
    variables: usize,
    terms: BTreeMap<Vec<i64>, Rational>,
}

impl Terms {
    /// The polynomial with these coefficients; those of one exponent are added.
    ///
    /// # Panics
    /// If an exponent has not as many parts as there are variables.
    #[must_use]
    pub fn new(variables: usize, coefficients: impl IntoIterator<Item = (Vec<i64>, Rational)>) -> Self {
        let mut terms: BTreeMap<Vec<i64>, Rational> = BTreeMap::new();
        for (exponent, c) in coefficients {
            assert_eq!(exponent.len(), variables, "an exponent for each variable");
            *terms.entry(exponent).or_insert_with(|| Rational::from(0)) += c;
        }
        terms.retain(|_, c| *c != 0);
        Self { variables, terms }
    }

    /// `1 + z^direction`.
    #[must_use]
    pub fn binomial(direction: &[i64]) -> Self {
        let one = Rational::from(1);
        Self::new(direction.len(), [(vec![0; direction.len()], one.clone()), (direction.to_vec(), one)])
    }

    /// The product of polynomials in one variable each, of different ones.
    #[must_use]
    pub fn product_of(factors: &[Laurent]) -> Self {
        let one = vec![(Vec::new(), Rational::from(1))];
        let all = factors.iter().fold(one, |so_far, factor| {
            let part = |(a, c): &(Vec<i64>, Rational)| {
                let next = factor.coefficients().iter().zip(factor.low()..);
                next.map(|(x, k)| ([a.as_slice(), &[k]].concat(), c * x)).collect::<Vec<_>>()
            };
            so_far.iter().flat_map(part).collect()
        });
        Self::new(factors.len(), all)
    }

    /// Reads a symbol in `x`, `y` (and `z`), which may also be called `z1`, `z2`, `z3`: `(1+x)^2*(1+y)^2*(1+x*y)^2/16`.
    ///
    /// # Errors
    /// [`SchemeError::Symbol`] with the position, and [`SchemeError::Large`].
    pub fn parse(text: &str, variables: usize) -> Result<Self, SchemeError> {
        let read: Self = symbol::parse(text)?;
        let beyond = |a: &Vec<i64>| a.get(variables..).is_some_and(|rest| rest.iter().any(|k| *k != 0));
        if variables > MAX_VARIABLES || read.terms.keys().any(beyond) {
            let message = format!("the dilation has {variables} dimensions, the symbol another number of variables");
            return Err(SchemeError::Symbol { position: 0, message });
        }
        let terms = read.terms.into_iter().map(|(mut a, c)| {
            a.truncate(variables);
            (a, c)
        });
        Ok(Self { variables, terms: terms.collect() })
    }

    /// Whether a text is meant as a symbol in several variables.
    #[must_use]
    pub fn is_meant(text: &str) -> bool {
        let allowed = |c: char| "xyz+-*/^(){}. ".contains(c) || c.is_ascii_digit();
        text.chars().all(allowed) && (text.contains(['x', 'y']) || text.contains("z1"))
    }

    /// The number of variables.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The exponents, ascending, with their coefficients.
    pub fn iter(&self) -> impl Iterator<Item = (&Vec<i64>, &Rational)> {
        self.terms.iter()
    }

    /// The coefficient at an exponent, where it is not 0.
    #[must_use]
    pub fn get(&self, exponent: &[i64]) -> Option<&Rational> {
        self.terms.get(exponent)
    }

    /// The number of coefficients.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// The least and the largest exponent in every variable; `None` for the polynomial 0.
    #[must_use]
    pub fn corners(&self) -> Option<(Vec<i64>, Vec<i64>)> {
        let bound = |better: fn(i64, i64) -> i64| {
            self.terms.keys().cloned().reduce(|a, b| a.iter().zip(&b).map(|(x, y)| better(*x, *y)).collect())
        };
        Some((bound(i64::min)?, bound(i64::max)?))
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let product = |(a, x): (&Vec<i64>, &Rational)| {
            let moved = |b: &Vec<i64>| a.iter().zip(b).map(|(i, j)| i + j).collect::<Vec<_>>();
            other.terms.iter().map(|(b, y)| (moved(b), x * y)).collect::<Vec<_>>()
        };
        Self::new(self.variables, self.terms.iter().flat_map(product))
    }

    /// A multiple.
    #[must_use]
    pub fn scaled(&self, factor: &Rational) -> Self {
        Self::new(self.variables, self.terms.iter().map(|(a, c)| (a.clone(), c * factor)))
    }
}

/// The number of points of a box with these sides; where it is huge, the largest number.
fn volume(sides: impl Iterator<Item = i64>) -> usize {
    sides.fold(1, |v: usize, side| v.saturating_mul(usize::try_from(side).unwrap_or(usize::MAX)))
}

/// Symbols are read with as many variables as there may be.
impl Symbol for Terms {
    const VARIABLES: &'static str = "`x`, `y`, `z` or `z1`, `z2`, `z3`";
    const LIMIT: usize = MAX_BOX;
    const INDEXED: bool = true;

    fn begins_variable(c: char) -> bool {
        matches!(c, 'x' | 'y' | 'z')
    }

    fn variable(name: &str) -> Option<Self> {
        let place = match name {
            "x" | "z1" => 0,
            "y" | "z2" => 1,
            "z" | "z3" => 2,
            _ => return None,
        };
        let exponent = (0..MAX_VARIABLES).map(|k| i64::from(k == place)).collect();
        Some(Self::new(MAX_VARIABLES, [(exponent, Rational::from(1))]))
    }

    fn constant(c: Rational) -> Self {
        Self::new(MAX_VARIABLES, [(vec![0; MAX_VARIABLES], c)])
    }

    fn is_zero(&self) -> bool {
        self.is_empty()
    }

    fn add(&self, other: &Self) -> Self {
        let all = self.terms.iter().chain(&other.terms);
        Self::new(self.variables, all.map(|(a, c)| (a.clone(), c.clone())))
    }

    fn scale(&self, factor: &Rational) -> Self {
        self.scaled(factor)
    }

    fn mul(&self, other: &Self) -> Self {
        self.times(other)
    }

    /// From the largest exponent down; the exponents of the quotient lie in the box that those of the two polynomials leave.
    fn divide(&self, divisor: &Self) -> Option<Self> {
        let (top, lead) = divisor.terms.last_key_value()?;
        let Some((low, high)) = self.corners() else { return Some(self.clone()) };
        let (least, most) = divisor.corners()?;
        let (mut rest, mut quotient) = (self.clone(), Vec::new());
        while let Some((a, c)) = rest.terms.last_key_value() {
            let exponent: Vec<i64> = a.iter().zip(top).map(|(i, j)| i - j).collect();
            let inside = |k: usize| (low[k] - least[k]..=high[k] - most[k]).contains(&exponent[k]);
            if !(0..self.variables).all(inside) {
                return None;
            }
            let part = Self::new(self.variables, [(exponent.clone(), c / lead)]);
            rest = rest.add(&part.times(divisor).scaled(&Rational::from(-1)));
            quotient.extend(part.terms);
        }
        Some(Self::new(self.variables, quotient))
    }

    fn width(&self) -> usize {
        self.corners().map_or(0, |(low, high)| volume(low.iter().zip(&high).map(|(a, b)| b - a + 1)))
    }

    fn width_of_product(&self, other: &Self) -> usize {
        let (Some((a, b)), Some((c, d))) = (self.corners(), other.corners()) else { return 0 };
        volume((0..self.variables).map(|k| b[k] - a[k] + d[k] - c[k] + 1))
    }

    fn farthest(&self) -> i64 {
        self.terms.keys().flatten().fold(0, |most, k| most.max(k.abs()))
    }

    fn numbers(&self) -> impl Iterator<Item = &Rational> {
        self.terms.values()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn symbols_in_two_variables() {
        let p = Terms::parse("(1+x)*(1+z2)/x^2 - 1/2 y^-1", 2).unwrap();
        let found: Vec<(Vec<i64>, Rational)> = p.iter().map(|(a, c)| (a.clone(), c.clone())).collect();
        let one = ratio(1, 1);
        let expected = [([-2, 0], one.clone()), ([-2, 1], one.clone()), ([-1, 0], one.clone()), ([-1, 1], one)];
        let mut expected: Vec<_> = expected.into_iter().map(|(a, c)| (a.to_vec(), c)).collect();
        expected.push((vec![0, -1], ratio(-1, 2)));
        assert_eq!(found, expected);
        let square = Terms::parse("(x^2-y^2)/(x-y)", 2).unwrap();
        assert_eq!(square, Terms::parse("x+y", 2).unwrap());
    }

    #[test]
    fn refused_symbols() {
        for (text, at) in [("1/(x-y)", 7), ("(1+x2)", 4), ("z12+x", 3), ("x^y", 2), ("1+w", 2)] {
            let Err(SchemeError::Symbol { position, .. }) = Terms::parse(text, 2) else { panic!("{text}") };
            assert_eq!(position, at, "{text}");
        }
        assert!(Terms::parse("x+z", 2).is_err() && Terms::parse("x+z", 3).is_ok());
        assert!(matches!(Terms::parse("x^1000+y^1000", 2), Err(SchemeError::Large { .. })));
        assert!(Terms::is_meant("(1+z1)") && !Terms::is_meant("(1+z)^2") && !Terms::is_meant("hexagon"));
    }
}
