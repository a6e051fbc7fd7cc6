//! Directions with algebraic coordinates, compared exactly across number fields.

use crate::algebraic::{Elem, Root, locate};
use crate::arith::{Integer, Natural, Rational, sign, to_f64};
use malachite_base::num::arithmetic::traits::{Gcd, Lcm};
use malachite_base::num::basic::traits::{One, Zero};

/// A nonzero vector with coordinates in `Q(θ)`, seen at one real root `θ`.
#[derive(Debug, Clone)]
pub struct Direction {
    /// The root at which the coordinates are evaluated.
    pub root: Root,
    /// The coordinates.
    pub coords: Vec<Elem>,
}

impl Direction {
    /// The opposite direction.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { root: self.root.clone(), coords: self.coords.iter().map(Elem::neg).collect() }
    }

    /// The direction times `1` or `-1`.
    #[must_use]
    pub fn times(&self, sign: i32) -> Self {
        if sign < 0 { self.negated() } else { self.clone() }
    }

    /// The same ray with short coordinates: coprime integers where the coordinates are rational multiples of one
    /// another, otherwise the first nonzero coordinate `1` or `-1`.
    #[must_use]
    pub fn normalised(&self) -> Self {
        let Some(lead) = self.coords.iter().position(|c| !c.is_zero()) else { return self.clone() };
        let f = self.root.minpoly();
        let Some(inverse) = self.coords[lead].inv(f) else { return self.clone() };
        let s = self.coords[lead].sign(&self.root);
        let unit: Vec<Elem> = self.coords.iter().map(|c| c.mul(&inverse, f).scale(&Rational::from(s))).collect();
        let coords = match unit.iter().map(Elem::is_rational).collect::<Option<Vec<_>>>() {
            Some(rationals) => primitive(&rationals).iter().map(Elem::from_rational).collect(),
            None => unit,
        };
        Self { root: self.root.clone(), coords }
    }

    /// The coordinates where all are rational.
    #[must_use]
    pub fn rational(&self) -> Option<Vec<Rational>> {
        self.coords.iter().map(Elem::is_rational).collect()
    }

    /// Decimals, for display: the unit vector of the ray.
    #[must_use]
    #[allow(clippy::float_arithmetic, reason = "display only")]
    pub fn to_f64(&self) -> Vec<f64> {
        let v: Vec<f64> = self.coords.iter().map(|c| to_f64(&c.enclosure(&self.root, 60).0.mid())).collect();
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.iter().map(|x| x / norm).collect()
    }

    /// Whether two directions lie on the same line; if so, `Some(1)` for the same ray and `Some(-1)` for opposite ones.
    ///
    /// Exact: the quotients by a common nonzero coordinate are compared as algebraic numbers.
    #[must_use]
    pub fn same_line(&self, other: &Self) -> Option<i32> {
        let lead = self.coords.iter().position(|c| !c.is_zero())?;
        if other.coords[lead].is_zero() {
            return None;
        }
        let quotients = |d: &Self| -> Option<Vec<Elem>> {
            let f = d.root.minpoly();
            let inverse = d.coords[lead].inv(f)?;
            Some(d.coords.iter().map(|c| c.mul(&inverse, f)).collect())
        };
        let (mine, theirs) = (quotients(self)?, quotients(other)?);
        let equal = mine.iter().zip(&theirs).all(|(a, b)| equal_numbers((a, &self.root), (b, &other.root)));
        equal.then(|| self.coords[lead].sign(&self.root) * other.coords[lead].sign(&other.root))
    }
}

/// Whether two elements, each seen at a real root, are the same number.
fn equal_numbers((a, at): (&Elem, &Root), (b, bt): (&Elem, &Root)) -> bool {
    match (a.is_rational(), b.is_rational()) {
        (Some(x), Some(y)) => return x == y,
        (Some(_), None) | (None, Some(_)) => return false,
        (None, None) => {}
    }
    if at.same(bt) {
        return a == b;
    }
    if a.enclosure(at, 64).0.disjoint(&b.enclosure(bt, 64).0) {
        return false;
    }
    locate(a, at).same(&locate(b, bt))
}

/// The coprime integers on the same ray.
#[must_use]
pub fn primitive(v: &[Rational]) -> Vec<Rational> {
    let denominator = v.iter().fold(Natural::ONE, |l, x| l.lcm(x.denominator_ref().clone()));
    let integers: Vec<Integer> = v
        .iter()
        .map(|x| {
            let magnitude = x.numerator_ref() * (&denominator / x.denominator_ref());
            Integer::from_sign_and_abs(sign(x) >= 0, magnitude)
        })
        .collect();
    let common = integers.iter().fold(Natural::ZERO, |g, x| g.gcd(x.unsigned_abs_ref().clone()));
    if common == 0 {
        return v.to_vec();
    }
    integers.into_iter().map(|x| Rational::from_integers(x, Integer::from(common.clone()))).collect()
}
