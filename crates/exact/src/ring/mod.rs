//! Rings and fields as values: a context, which knows the operations, beside its elements.
//!
//! One computation then runs over the rationals ([`Rationals`]), a number field
//! ([`NumberField`]), enclosures ([`Enclosures`]), or functions of a parameter on an
//! interval ([`Functions`]). Exact contexts answer every question; enclosures, and functions that change their sign, may
//! answer *unknown*, which is `None` and never a decision.
//!
//! Source of the manner: the generic rings of FLINT.
//!
//! ```
//! use secant_exact::arith::{Rational, ratio};
//! use secant_exact::ring::{Enclosures, Field, Ordered, Rationals, Ring};
//!
//! /// Twelfths of the golden ratio's equation: x² − x − 1.
//! fn value<K: Field>(k: &K, x: &K::E) -> K::E {
//!     k.sub(&k.sub(&k.mul(x, x), x), &k.one())
//! }
//! assert_eq!(value(&Rationals, &ratio(3, 2)), ratio(-1, 4));
//! let k = Enclosures::new(64);
//! assert_eq!(k.sign(&value(&k, &k.rational(&ratio(3, 2)))), Some(-1));
//! ```

mod enclosures;
mod functions;
mod models;

pub use enclosures::{Enclosures, Fixed};
pub use functions::{Fraction, Functions};
pub use models::{Model, Models};

use crate::algebraic::Elem;
use crate::algebraic::field::NumberField;
use crate::arith::{Integer, Rational};
use crate::poly::{Poly, Two};

/// A commutative ring with 1.
pub trait Ring {
    /// Elements.
    type E: Clone;
    /// The image of an integer.
    fn integer(&self, n: &Integer) -> Self::E;
    /// `a + b`.
    fn add(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// `a - b`.
    fn sub(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// `a * b`.
    fn mul(&self, a: &Self::E, b: &Self::E) -> Self::E;
    /// Whether `a` is 0, where that is certain.
    fn is_zero(&self, a: &Self::E) -> Option<bool>;
    /// The number 0.
    fn zero(&self) -> Self::E {
        self.integer(&Integer::from(0))
    }
    /// The number 1.
    fn one(&self) -> Self::E {
        self.integer(&Integer::from(1))
    }
    /// `-a`.
    fn neg(&self, a: &Self::E) -> Self::E {
        self.sub(&self.zero(), a)
    }
}

/// A field that contains the rationals.
pub trait Field: Ring {
    /// The image of a rational.
    fn rational(&self, q: &Rational) -> Self::E;
    /// `1 / a`; `None` where `a` is 0 or might be.
    fn inv(&self, a: &Self::E) -> Option<Self::E>;
    /// `q a` for a rational `q`.
    fn scale(&self, a: &Self::E, q: &Rational) -> Self::E {
        self.mul(a, &self.rational(q))
    }
    /// A rational polynomial at `a` (Horner).
    fn eval(&self, p: &Poly, a: &Self::E) -> Self::E {
        p.coeffs().iter().rev().fold(self.zero(), |v, c| self.add(&self.mul(&v, a), &self.rational(c)))
    }
}

/// A field of real numbers, or of real functions.
pub trait Ordered: Field {
    /// The sign as -1, 0 or 1, where it is certain.
    fn sign(&self, a: &Self::E) -> Option<i32>;
}

/// The field of the rationals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rationals;

impl Ring for Rationals {
    type E = Rational;

    fn integer(&self, n: &Integer) -> Rational {
        Rational::from(n)
    }

    fn add(&self, a: &Rational, b: &Rational) -> Rational {
        a + b
    }

    fn sub(&self, a: &Rational, b: &Rational) -> Rational {
        a - b
    }

    fn mul(&self, a: &Rational, b: &Rational) -> Rational {
        a * b
    }

    fn is_zero(&self, a: &Rational) -> Option<bool> {
        Some(*a == 0)
    }

    fn neg(&self, a: &Rational) -> Rational {
        -a
    }
}

impl Field for Rationals {
    fn rational(&self, q: &Rational) -> Rational {
        q.clone()
    }

    fn inv(&self, a: &Rational) -> Option<Rational> {
        (*a != 0).then(|| Rational::from(1) / a)
    }
}

impl Ordered for Rationals {
    fn sign(&self, a: &Rational) -> Option<i32> {
        Some(crate::arith::sign(a))
    }
}

/// The ring of polynomials in one variable over the rationals.
///
/// ```
/// use secant_exact::{arith::ratio, linalg::Matrix, poly::Poly, ring::Polynomials};
///
/// // x² − 2 t x is the characteristic polynomial of the matrix with all entries t.
/// let t = Poly::linear(&ratio(0, 1));
/// let m = Matrix::from_fn(2, 2, |_, _| t.clone());
/// assert_eq!(m.char_poly_over(&Polynomials)[1], t.scale(&ratio(-2, 1)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Polynomials;

impl Ring for Polynomials {
    type E = Poly;

    fn integer(&self, n: &Integer) -> Poly {
        Poly::constant(Rational::from(n))
    }

    fn add(&self, a: &Poly, b: &Poly) -> Poly {
        a + b
    }

    fn sub(&self, a: &Poly, b: &Poly) -> Poly {
        a - b
    }

    fn mul(&self, a: &Poly, b: &Poly) -> Poly {
        a * b
    }

    fn is_zero(&self, a: &Poly) -> Option<bool> {
        Some(a.is_zero())
    }

    fn neg(&self, a: &Poly) -> Poly {
        -a
    }
}

/// The ring of the polynomials in two variables over the rationals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Plane;

impl Ring for Plane {
    type E = Two;

    fn integer(&self, n: &Integer) -> Two {
        Two::number(Rational::from(n))
    }

    fn add(&self, a: &Two, b: &Two) -> Two {
        a.plus(b)
    }

    fn sub(&self, a: &Two, b: &Two) -> Two {
        a.minus(b)
    }

    fn mul(&self, a: &Two, b: &Two) -> Two {
        a.times(b)
    }

    fn is_zero(&self, a: &Two) -> Option<bool> {
        Some(a.is_zero())
    }
}

impl Ring for NumberField {
    type E = Elem;

    fn integer(&self, n: &Integer) -> Elem {
        Elem::from_rational(&Rational::from(n))
    }

    fn add(&self, a: &Elem, b: &Elem) -> Elem {
        a.add(b)
    }

    fn sub(&self, a: &Elem, b: &Elem) -> Elem {
        a.sub(b)
    }

    fn mul(&self, a: &Elem, b: &Elem) -> Elem {
        a.mul(b, self.poly())
    }

    fn is_zero(&self, a: &Elem) -> Option<bool> {
        Some(a.is_zero())
    }

    fn neg(&self, a: &Elem) -> Elem {
        a.neg()
    }
}

impl Field for NumberField {
    fn rational(&self, q: &Rational) -> Elem {
        Elem::from_rational(q)
    }

    fn inv(&self, a: &Elem) -> Option<Elem> {
        a.inv(self.poly())
    }

    fn scale(&self, a: &Elem, q: &Rational) -> Elem {
        a.scale(q)
    }
}

impl Ordered for NumberField {
    fn sign(&self, a: &Elem) -> Option<i32> {
        Some(a.sign(self.generator()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;

    /// The determinant sign of Hilbert's matrix of size 4, by elimination.
    fn hilbert<K: Ordered>(k: &K) -> Option<Vec<i32>> {
        let entry = |i: usize, j: usize| k.rational(&ratio(1, 1 + (i + j) as i64));
        let a = Matrix::from_fn(4, 4, entry);
        let e = a.echelon_over(k)?;
        e.pivots.iter().enumerate().map(|(r, p)| k.sign(&e.rows[(r, *p)])).collect()
    }

    #[test]
    fn one_elimination_over_all_fields() {
        let field = NumberField::read(&["sqrt(5)"]).unwrap().0;
        assert_eq!(hilbert(&Rationals), Some(vec![1; 4]));
        assert_eq!(hilbert(&field), Some(vec![1; 4]));
        assert_eq!(hilbert(&Enclosures::new(200)), Some(vec![1; 4]));
        // Eight binary places do not tell the last pivot from 0: unknown, not a rank.
        assert_eq!(hilbert(&Enclosures::new(8)), None);
        let t = Functions::between(ratio(1, 1), ratio(2, 1));
        assert_eq!(hilbert(&t), Some(vec![1; 4]));
    }
}
