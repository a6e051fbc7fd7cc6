//! Signs of polynomials at a value of the parameters, and linear algebra with polynomials.

use super::symbol::Symbol;
use crate::algebraic::{Elem, Root};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::poly::Poly;
use std::cell::{Cell, RefCell};

/// Signs at one value of the parameters; all that were asked for are kept.
pub(super) trait Signs<P: Symbol>: Clone {
    /// The polynomials that were asked for; `None` where one vanished that must not.
    fn kept(&self) -> Option<Vec<P>>;

    /// A place in what is kept, to which an attempt that failed may go back.
    fn mark(&self) -> (usize, bool);

    /// Forgets, where that is done, what was asked for since, of which nothing is used.
    fn forget(&self, mark: (usize, bool));

    fn sign(&self, f: &P) -> i32;

    /// A positive multiple of a vector, where there is one without a common divisor; `None` where the vector is 0.
    fn primitive(&self, v: &[P]) -> Option<Vec<P>>;

    /// A polynomial at a rational value near by: for choices, which are examined afterwards.
    fn near(&self, f: &P) -> Rational;

    /// Whether what is found holds around the value too, which is rational then.
    fn is_around(&self) -> bool;

    fn is_not_zero(&self, v: &[P]) -> bool {
        self.sign(&dot(v, v)) != 0
    }

    fn parallel(&self, a: &[P], b: &[P]) -> bool {
        let minor = |i: usize, j: usize| a[i].times(&b[j]).minus(&a[j].times(&b[i]));
        (0..a.len()).all(|i| (0..i).all(|j| self.sign(&minor(i, j)) == 0))
    }
}

/// The polynomials that were asked for, each once, and whether one vanished that must not.
#[derive(Clone)]
pub(super) struct Asked<P> {
    guards: RefCell<Vec<P>>,
    special: Cell<bool>,
}

impl<P: Symbol> Asked<P> {
    pub fn new() -> Self {
        Self { guards: RefCell::default(), special: Cell::new(false) }
    }

    /// Takes down a polynomial, and whether it vanishes where it must not.
    pub fn note(&self, monic: P, vanishes: bool) {
        if vanishes {
            self.special.set(true);
        }
        let mut guards = self.guards.borrow_mut();
        if !guards.contains(&monic) {
            guards.push(monic);
        }
    }

    pub fn kept(&self) -> Option<Vec<P>> {
        (!self.special.get()).then(|| self.guards.borrow().clone())
    }

    pub fn mark(&self) -> (usize, bool) {
        (self.guards.borrow().len(), self.special.get())
    }

    pub fn forget(&self, (count, special): (usize, bool)) {
        self.guards.borrow_mut().truncate(count);
        self.special.set(special);
    }
}

/// Signs at one value of one parameter.
#[derive(Clone)]
pub(super) struct At<'a> {
    point: &'a Root,
    /// Whether what is found is to hold around the value too: then a polynomial that vanishes there must be 0.
    around: bool,
    asked: Asked<Poly>,
}

impl<'a> At<'a> {
    pub fn new(point: &'a Root, around: bool) -> Self {
        Self { point, around, asked: Asked::new() }
    }
}

impl Signs<Poly> for At<'_> {
    fn mark(&self) -> (usize, bool) {
        self.asked.mark()
    }

    /// Everything stays: a checker follows the attempts one by one.
    fn forget(&self, _: (usize, bool)) {}

    fn kept(&self) -> Option<Vec<Poly>> {
        self.asked.kept()
    }

    fn sign(&self, f: &Poly) -> i32 {
        if f.degree().is_none_or(|d| d == 0) {
            return crate::arith::sign(&f.coeff(0));
        }
        let sign = Elem::reduced(f, self.point.minpoly()).sign(self.point);
        self.asked.note(f.monic(), sign == 0 && self.around);
        sign
    }

    fn primitive(&self, v: &[Poly]) -> Option<Vec<Poly>> {
        let common = v.iter().fold(Poly::zero(), |g, x| g.gcd(x));
        let sign = self.sign(&common);
        let divided = |x: &Poly| x.div_rem(&common).0.scale(&Rational::from(sign));
        (sign != 0).then(|| v.iter().map(divided).collect::<Vec<Poly>>()).filter(|v| self.is_not_zero(v))
    }

    fn near(&self, f: &Poly) -> Rational {
        f.eval(&self.point.rational().unwrap_or_else(|| self.point.enclosure(64).0.mid()))
    }

    fn is_around(&self) -> bool {
        self.around && self.point.rational().is_some()
    }
}

pub(super) fn dot<P: Symbol>(a: &[P], b: &[P]) -> P {
    a.iter().zip(b).fold(P::nought(), |s, (x, y)| s.plus(&x.times(y)))
}

pub(super) fn scaled<P: Symbol>(v: &[P], by: i32) -> Vec<P> {
    v.iter().map(|x| x.multiple(&Rational::from(by))).collect()
}

pub(super) fn determinant<P: Symbol>(m: &Matrix<P>) -> P {
    let constant = m.char_poly_over(&P::ring())[0].clone();
    if m.rows().is_multiple_of(2) { constant } else { P::nought().minus(&constant) }
}

/// `adj(x − M)`.
pub(super) fn adjugate<P: Symbol>(m: &Matrix<P>, chi: &[P], x: &P) -> Matrix<P> {
    let columns: Vec<Vec<P>> = (0..m.rows()).map(|c| m.adjugate_column_over(&P::ring(), chi, c, x)).collect();
    Matrix::from_fn(m.rows(), m.rows(), |i, j| columns[j][i].clone())
}

/// The value of a polynomial with polynomials as coefficients, the lowest first.
pub(super) fn horner<P: Symbol>(f: &[P], x: &P) -> P {
    f.iter().rev().fold(P::nought(), |v, c| v.times(x).plus(c))
}

/// The quotient of a division by `x − root` that leaves no rest.
pub(super) fn without_root<P: Symbol>(f: &[P], root: &P) -> Vec<P> {
    let mut quotient: Vec<P> = Vec::new();
    for c in f.iter().skip(1).rev() {
        let next = quotient.last().map_or_else(|| c.clone(), |q| q.times(root).plus(c));
        quotient.push(next);
    }
    quotient.reverse();
    quotient
}

/// Whether all roots lie in the open unit disc (Schur, Cohn, Jury), at the value.
pub(super) fn is_stable<P: Symbol>(at: &impl Signs<P>, mut p: Vec<P>) -> bool {
    while p.len() > 1 {
        let (first, last) = (p[0].clone(), p[p.len() - 1].clone());
        if at.sign(&last.times(&last).minus(&first.times(&first))) <= 0 {
            return false;
        }
        let n = p.len() - 1;
        p = (1..=n).map(|k| last.times(&p[k]).minus(&first.times(&p[n - k]))).collect();
    }
    true
}
