//! Where two eigenvalues have the same modulus: polynomials in the parameter over the rationals.

use super::leader::{Kind, Leader};
use super::model::{Model, Moving, Piece};
use crate::algebraic::Elem;
use crate::algebraic::field::NumberField;
use crate::arith::Rational;
use crate::poly::Poly;
use crate::ring::{Field, Ring};
use crate::vertex::cosine::{gcd, twice_cosine};

/// Highest degree of a polynomial whose zeros are sought.
const MAX_DEGREE: usize = 200;

/// What is compared.
#[derive(Clone, Copy)]
pub(super) enum Against<'a> {
    /// The modulus 1.
    Unit,
    /// Another eigenvalue.
    Other(&'a Leader),
}

/// The field of `2 cos(2πg/n)` for the blocks of some pieces, where `g` divides their angles.
struct Cosines {
    field: NumberField,
    divisor: usize,
    cosine: Elem,
}

impl Cosines {
    fn new(model: &Model, pieces: &[&Piece]) -> Option<Self> {
        let n = model.vertex.valence;
        let turning = pieces.iter().filter(|p| p.turns());
        let divisor = turning.fold(n, |g, p| gcd(g, model.blocks[p.block].angle));
        let root = twice_cosine(divisor, n);
        // A rational cosine is no generator.
        Some(Self { field: NumberField::generated(&root)?, divisor, cosine: Elem::generator(root.minpoly()) })
    }

    /// `2 cos` of the angle of a block: `V_m(c)` with `V_0 = 2`, `V_1 = c`, `V_{m+1} = c V_m − V_{m−1}`.
    fn of(&self, angle: usize) -> Elem {
        let c = &self.cosine;
        let (mut before, mut now) = (self.field.rational(&Rational::from(2)), c.clone());
        for _ in 0..angle / self.divisor {
            let next = self.field.sub(&Ring::mul(&self.field, c, &now), &before);
            (before, now) = (now, next);
        }
        before
    }

    fn at(&self, coefficient: &Moving, angle: usize, p: &Rational) -> Elem {
        let f = coefficient.iter().rev().fold(Poly::zero(), |v, c| &v.scale(p) + c);
        self.field.eval(&f, &self.of(angle))
    }

    /// A piece at a value.
    fn piece(&self, model: &Model, piece: &Piece, p: &Rational) -> Vec<Elem> {
        let angle = model.blocks[piece.block].angle;
        // Without `t` the angle need not be a multiple.
        let angle = if piece.turns() { angle } else { 0 };
        piece.poly.iter().map(|c| self.at(c, angle, p)).collect()
    }

    /// The product of all conjugates.
    fn norm(&self, x: &Elem) -> Rational {
        self.field.multiplication(x).determinant()
    }
}

/// A polynomial that vanishes wherever an eigenvalue has the modulus of another, or the modulus 1, and perhaps elsewhere; `None`
/// where it would be too large.
pub(super) fn tie(model: &Model, own: &Leader, against: Against<'_>) -> Option<Poly> {
    let first = &model.pieces[own.piece];
    let second = match against {
        Against::Unit => None,
        Against::Other(other) => Some(&model.pieces[other.piece]),
    };
    let cosines = Cosines::new(model, &[&[first], second.as_slice()].concat())?;
    let sign = |l: &Leader| Rational::from(if l.is_negative() { -1 } else { 1 });
    let value = |p: &Rational| {
        let f = &cosines.field;
        let a = cosines.piece(model, first, p);
        let b = second.map(|s| cosines.piece(model, s, p));
        // The modulus of a pair is the constant coefficient of its polynomial, squared.
        let common = match (&own.kind, against) {
            (Kind::Real { .. }, Against::Unit) => f.eval_at(&a, &f.rational(&sign(own))),
            (Kind::Pair, Against::Unit) => f.sub(&a[0], &f.one()),
            (Kind::Pair, Against::Other(other)) => match &other.kind {
                Kind::Pair => f.sub(&a[0], &b?[0]),
                Kind::Real { .. } => resultant(f, b?, squares(f, &a[0]))?,
            },
            (Kind::Real { .. }, Against::Other(other)) => match &other.kind {
                Kind::Pair => resultant(f, a, squares(f, &b?[0]))?,
                Kind::Real { .. } => resultant(f, a, turned(f, b?, sign(own) != sign(other)))?,
            },
        };
        Some(cosines.norm(&common))
    };
    let powers = |p: &Piece| p.powers().max(1) - 1;
    let size = |p: &Piece| p.poly.len().max(3) - 1;
    let single = match second {
        None => powers(first) * 2,
        Some(second) => size(first) * powers(second) + size(second) * powers(first),
    };
    let degree = single * cosines.field.degree();
    if degree > MAX_DEGREE {
        return None;
    }
    let at: Vec<Rational> = (0..=degree).map(|k| Rational::from(k as u64)).collect();
    let values = at.iter().map(value).collect::<Option<Vec<_>>>()?;
    Some(Poly::through(&at, values))
}

/// Horner's rule for coefficients in the field.
trait Evaluate: Field {
    fn eval_at(&self, poly: &[Self::E], x: &Self::E) -> Self::E {
        poly.iter().rev().fold(self.zero(), |v, c| self.add(&self.mul(&v, x), c))
    }
}

impl Evaluate for NumberField {}

/// `x² − c`.
fn squares(f: &NumberField, c: &Elem) -> Vec<Elem> {
    vec![f.neg(c), f.zero(), f.one()]
}

/// The polynomial of the negative roots, up to the sign.
fn turned(f: &NumberField, mut poly: Vec<Elem>, negative: bool) -> Vec<Elem> {
    if negative {
        poly.iter_mut().skip(1).step_by(2).for_each(|c| *c = f.neg(c));
    }
    poly
}

/// The resultant of two polynomials with leading coefficients other than 0 (Euclid).
fn resultant(f: &NumberField, mut a: Vec<Elem>, mut b: Vec<Elem>) -> Option<Elem> {
    let mut factor = f.one();
    loop {
        let (m, n) = (a.len().checked_sub(1)?, b.len().checked_sub(1)?);
        let lead = b.last()?.clone();
        if n == 0 {
            return Some((0..m).fold(factor, |v, _| Ring::mul(f, &v, &lead)));
        }
        let inverse = Field::inv(f, &lead)?;
        let mut rest = a;
        while rest.len() > n {
            let top = Ring::mul(f, &rest.pop()?, &inverse);
            let shift = rest.len() - n;
            for (k, c) in b[..n].iter().enumerate() {
                rest[shift + k] = f.sub(&rest[shift + k], &Ring::mul(f, &top, c));
            }
        }
        while rest.last().is_some_and(Elem::is_zero) {
            rest.pop();
        }
        if rest.is_empty() {
            return Some(f.zero());
        }
        for _ in 0..(m + 1).checked_sub(rest.len())? {
            factor = Ring::mul(f, &factor, &lead);
        }
        if m % 2 == 1 && n % 2 == 1 {
            factor = f.neg(&factor);
        }
        (a, b) = (b, rest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn resultants_are_products_of_differences() {
        let f = NumberField::rationals();
        let poly = |roots: &[i64]| {
            let p = roots.iter().fold(Poly::constant(ratio(1, 1)), |p, r| &p * &Poly::linear(&ratio(*r, 1)));
            p.coeffs().iter().map(|c| f.rational(c)).collect::<Vec<_>>()
        };
        let product = |a: &[i64], b: &[i64]| a.iter().flat_map(|x| b.iter().map(move |y| x - y)).product::<i64>();
        for (a, b) in [(&[1, 2][..], &[5, -3, 7][..]), (&[4], &[9, 1]), (&[2, 3, 5], &[7]), (&[0, 1], &[1, 6])] {
            let found = resultant(&f, poly(a), poly(b)).unwrap();
            assert_eq!(found.is_rational(), Some(ratio(product(a, b), 1)), "{a:?} {b:?}");
        }
        assert!(resultant(&f, turned(&f, poly(&[2]), true), poly(&[-2])).unwrap().is_zero());
    }
}
