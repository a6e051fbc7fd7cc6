//! Signs of polynomials at a value of the parameter, and linear algebra with polynomials.

use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use crate::ring::Polynomials;
use std::cell::{Cell, RefCell};

/// Signs at one value of the parameter; all that were asked for are kept.
pub(super) struct At<'a> {
    point: &'a Root,
    /// Whether what is found is to hold around the value too: then a polynomial that vanishes there must be 0.
    around: bool,
    guards: RefCell<Vec<Poly>>,
    special: Cell<bool>,
}

impl<'a> At<'a> {
    /// The polynomials that were asked for; `None` where one vanished that must not.
    pub fn kept(&self) -> Option<Vec<Poly>> {
        (!self.special.get()).then(|| self.guards.borrow().clone())
    }

    pub fn new(point: &'a Root, around: bool) -> Self {
        Self { point, around, guards: RefCell::default(), special: Cell::new(false) }
    }

    pub fn point(&self) -> &'a Root {
        self.point
    }

    /// Whether what is found holds around the value too.
    pub fn is_around(&self) -> bool {
        self.around
    }

    /// A branch of the argument.
    pub fn fork(&self) -> Self {
        Self {
            point: self.point,
            around: self.around,
            guards: RefCell::new(self.guards.borrow().clone()),
            special: Cell::new(self.special.get()),
        }
    }

    pub fn sign(&self, f: &Poly) -> i32 {
        if f.degree().is_none_or(|d| d == 0) {
            return crate::arith::sign(&f.coeff(0));
        }
        let sign = Elem::reduced(f, self.point.minpoly()).sign(self.point);
        if sign == 0 && self.around {
            self.special.set(true);
        }
        let mut guards = self.guards.borrow_mut();
        let f = f.monic();
        if !guards.contains(&f) {
            guards.push(f);
        }
        sign
    }

    /// A positive multiple of a vector without a common divisor; `None` where the vector is 0.
    pub fn primitive(&self, v: &[Poly]) -> Option<Vec<Poly>> {
        let common = v.iter().fold(Poly::zero(), |g, x| g.gcd(x));
        let sign = self.sign(&common);
        let divided = |x: &Poly| x.div_rem(&common).0.scale(&Rational::from(sign));
        (sign != 0).then(|| v.iter().map(divided).collect::<Vec<Poly>>()).filter(|v| self.is_not_zero(v))
    }

    pub fn is_not_zero(&self, v: &[Poly]) -> bool {
        self.sign(&dot(v, v)) != 0
    }

    pub fn parallel(&self, a: &[Poly], b: &[Poly]) -> bool {
        let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
        (0..a.len()).all(|i| (0..i).all(|j| self.sign(&minor(i, j)) == 0))
    }
}

pub(super) fn dot(a: &[Poly], b: &[Poly]) -> Poly {
    a.iter().zip(b).fold(Poly::zero(), |s, (x, y)| &s + &(x * y))
}

pub(super) fn scaled(v: &[Poly], by: i32) -> Vec<Poly> {
    v.iter().map(|x| x.scale(&Rational::from(by))).collect()
}

pub(super) fn determinant(m: &Matrix<Poly>) -> Poly {
    let constant = m.char_poly_over(&Polynomials)[0].clone();
    if m.rows().is_multiple_of(2) { constant } else { -&constant }
}

/// `adj(x − M)`.
pub(super) fn adjugate(m: &Matrix<Poly>, chi: &[Poly], x: &Poly) -> Matrix<Poly> {
    let columns: Vec<Vec<Poly>> = (0..m.rows()).map(|c| m.adjugate_column_over(&Polynomials, chi, c, x)).collect();
    Matrix::from_fn(m.rows(), m.rows(), |i, j| columns[j][i].clone())
}

/// Whether all roots lie in the open unit disc (Schur, Cohn, Jury), at the value.
pub(super) fn is_stable(at: &At<'_>, mut p: Vec<Poly>) -> bool {
    while p.len() > 1 {
        let (first, last) = (p[0].clone(), p[p.len() - 1].clone());
        if at.sign(&(&(&last * &last) - &(&first * &first))) <= 0 {
            return false;
        }
        let n = p.len() - 1;
        p = (1..=n).map(|k| &(&last * &p[k]) - &(&first * &p[n - k])).collect();
    }
    true
}
