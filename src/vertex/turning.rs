//! Numbers `x + y ω` with `ω² = 2cos(θ) ω − 1`, a rotation by `θ`: the field over which a Fourier block lives.
//!
//! For `0 < θ < π` the map `(x, y) ↦ x + y ω` is linear and keeps the orientation, so that plane figures may be computed
//! in these coordinates.

use super::field::Field;
use crate::arith::Rational;
use crate::poly::Poly;

/// `x + y ω`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Turning<E> {
    /// `x`.
    pub x: E,
    /// `y`.
    pub y: E,
}

/// The operations on [`Turning`] over a field.
#[derive(Debug, Clone, Copy)]
pub struct Rotation<'a, F>(pub &'a F);

impl<F: Field> Rotation<'_, F> {
    /// A number of the field.
    pub fn plain(&self, x: F::E) -> Turning<F::E> {
        Turning { x, y: self.0.zero() }
    }

    /// 0.
    pub fn zero(&self) -> Turning<F::E> {
        self.plain(self.0.zero())
    }

    /// `a + b`.
    pub fn add(&self, a: &Turning<F::E>, b: &Turning<F::E>) -> Turning<F::E> {
        Turning { x: self.0.add(&a.x, &b.x), y: self.0.add(&a.y, &b.y) }
    }

    /// `a - b`.
    pub fn sub(&self, a: &Turning<F::E>, b: &Turning<F::E>) -> Turning<F::E> {
        Turning { x: self.0.sub(&a.x, &b.x), y: self.0.sub(&a.y, &b.y) }
    }

    /// `a * b`.
    pub fn mul(&self, a: &Turning<F::E>, b: &Turning<F::E>) -> Turning<F::E> {
        let f = self.0;
        let yy = f.mul(&a.y, &b.y);
        let mixed = f.add(&f.mul(&a.x, &b.y), &f.mul(&a.y, &b.x));
        Turning { x: f.sub(&f.mul(&a.x, &b.x), &yy), y: f.add(&mixed, &f.mul(&f.twice_cosine(), &yy)) }
    }

    /// `q a` for a rational `q`.
    pub fn scale(&self, a: &Turning<F::E>, q: &Rational) -> Turning<F::E> {
        Turning { x: self.0.scale(&a.x, q), y: self.0.scale(&a.y, q) }
    }

    /// `|a|²`.
    pub fn norm(&self, a: &Turning<F::E>) -> F::E {
        let f = self.0;
        let mixed = f.mul(&f.twice_cosine(), &f.mul(&a.x, &a.y));
        f.add(&f.add(&f.mul(&a.x, &a.x), &f.mul(&a.y, &a.y)), &mixed)
    }

    /// `1 / a`, where `a` is certainly not 0.
    pub fn inv(&self, a: &Turning<F::E>) -> Option<Turning<F::E>> {
        let f = self.0;
        let factor = f.inv(&self.norm(a))?;
        let conjugate = f.add(&a.x, &f.mul(&f.twice_cosine(), &a.y));
        Some(Turning { x: f.mul(&conjugate, &factor), y: f.neg(&f.mul(&a.y, &factor)) })
    }

    /// `ω^s a`.
    pub fn turn(&self, a: &Turning<F::E>, s: i64) -> Turning<F::E> {
        let f = self.0;
        let mut a = a.clone();
        for _ in 0..s.unsigned_abs() {
            let t = f.twice_cosine();
            a = if s > 0 {
                Turning { y: f.add(&a.x, &f.mul(&t, &a.y)), x: f.neg(&a.y) }
            } else {
                Turning { x: f.add(&f.mul(&t, &a.x), &a.y), y: f.neg(&a.x) }
            };
        }
        a
    }

    /// A number whose coordinates are polynomials in `2 cos θ`.
    pub fn of_symbol(&self, symbol: &Symbol) -> Turning<F::E> {
        let t = self.0.twice_cosine();
        Turning { x: self.0.eval(&symbol.x, &t), y: self.0.eval(&symbol.y, &t) }
    }
}

/// `x + y ω` for every angle: the coordinates are polynomials in `t = 2 cos θ`.
pub type Symbol = Turning<Poly>;

impl Symbol {
    /// A rational number.
    #[must_use]
    pub fn constant(q: &Rational) -> Self {
        Self { x: Poly::constant(q.clone()), y: Poly::zero() }
    }

    /// A polynomial in `t`.
    #[must_use]
    pub fn real(x: Poly) -> Self {
        Self { x, y: Poly::zero() }
    }

    /// `q ω^s`.
    #[must_use]
    pub fn power(s: i64, q: &Rational) -> Self {
        let mut a = Self::constant(q);
        let t = variable();
        for _ in 0..s.unsigned_abs() {
            a = if s > 0 {
                Self { y: &a.x + &(&t * &a.y), x: -&a.y }
            } else {
                Self { x: &(&t * &a.x) + &a.y, y: -&a.x }
            };
        }
        a
    }

    /// Whether this is 0 for every angle.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.x.is_zero() && self.y.is_zero()
    }

    /// `self + other`.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        Self { x: &self.x + &other.x, y: &self.y + &other.y }
    }

    /// `self * other`.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        let yy = &self.y * &other.y;
        let mixed = &(&self.x * &other.y) + &(&self.y * &other.x);
        Self { x: &(&self.x * &other.x) - &yy, y: &mixed + &(&variable() * &yy) }
    }

    /// `q self`.
    #[must_use]
    pub fn scale(&self, q: &Rational) -> Self {
        Self { x: self.x.scale(q), y: self.y.scale(q) }
    }

    /// The same at the roots of a polynomial.
    #[must_use]
    pub fn reduced(&self, modulus: &Poly) -> Self {
        Self { x: self.x.div_rem(modulus).1, y: self.y.div_rem(modulus).1 }
    }
}

/// The polynomial `t`.
fn variable() -> Poly {
    Poly::new(vec![0.into(), 1.into()])
}
