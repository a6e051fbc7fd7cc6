//! The fields over which the computation at a vertex runs: those of [`crate::ring`], each with `2 cos θ` as an element.

use crate::algebraic::field::NumberField as Numbers;
use crate::arith::{Integer, Interval, Rational};
use crate::ring::{self, Field as _, Ordered, Ring};
use std::ops::Deref;

pub use crate::ring::{Fixed, Fraction};

/// A field, or enclosures of the elements of one, with `2 cos θ` as one of its elements.
pub trait Field: Ordered {
    /// `2 cos θ`.
    fn twice_cosine(&self) -> Self::E;
}

/// A field with an element `2 cos θ`.
#[derive(Debug, Clone)]
pub struct Turned<K: Ring> {
    base: K,
    twice_cosine: K::E,
}

/// Enclosures of one width of mantissa.
pub type Enclosures = Turned<ring::Enclosures>;
/// A number field with a real root of its polynomial.
pub type NumberField = Turned<Numbers>;
/// Rational functions of a parameter, for all valences at once.
pub type Functions = Turned<ring::Functions>;

impl<K: Ring> Turned<K> {
    /// The field with a given `2 cos θ`.
    pub fn new(base: K, twice_cosine: K::E) -> Self {
        Self { base, twice_cosine }
    }
}

impl Enclosures {
    /// The enclosures for `θ = 2πk/n`.
    #[must_use]
    pub fn of_angle(k: usize, n: usize, bits: u64) -> Self {
        let base = ring::Enclosures::new(bits);
        let twice_cosine = match crate::scheme::rational_cosine(k, n) {
            Some(c) => base.rational(&(c * Rational::from(2))),
            None => base.twice_cosine(k, n),
        };
        Self { base, twice_cosine }
    }

    /// Enclosures beside a given one of `2 cos θ`.
    #[must_use]
    pub fn with_twice_cosine(interval: &Interval, bits: u64) -> Self {
        let base = ring::Enclosures::new(bits);
        Self { base, twice_cosine: base.interval(interval) }
    }
}

impl<K: Ring> Deref for Turned<K> {
    type Target = K;
    fn deref(&self) -> &K {
        &self.base
    }
}

impl<K: Ring> Ring for Turned<K> {
    type E = K::E;

    fn integer(&self, n: &Integer) -> K::E {
        self.base.integer(n)
    }

    fn add(&self, a: &K::E, b: &K::E) -> K::E {
        self.base.add(a, b)
    }

    fn sub(&self, a: &K::E, b: &K::E) -> K::E {
        self.base.sub(a, b)
    }

    fn mul(&self, a: &K::E, b: &K::E) -> K::E {
        self.base.mul(a, b)
    }

    fn is_zero(&self, a: &K::E) -> Option<bool> {
        self.base.is_zero(a)
    }

    fn neg(&self, a: &K::E) -> K::E {
        self.base.neg(a)
    }
}

impl<K: ring::Field> ring::Field for Turned<K> {
    fn rational(&self, q: &Rational) -> K::E {
        self.base.rational(q)
    }

    fn inv(&self, a: &K::E) -> Option<K::E> {
        self.base.inv(a)
    }

    fn scale(&self, a: &K::E, q: &Rational) -> K::E {
        self.base.scale(a, q)
    }
}

impl<K: Ordered> Ordered for Turned<K> {
    fn sign(&self, a: &K::E) -> Option<i32> {
        self.base.sign(a)
    }
}

impl<K: Ordered> Field for Turned<K> {
    fn twice_cosine(&self) -> K::E {
        self.twice_cosine.clone()
    }
}
