//! Discs that hold an eigenvalue of a product: proposed in floats, proved by its characteristic polynomial.
#![allow(clippy::float_arithmetic, reason = "proposes an eigenvalue, the characteristic polynomial proves the disc")]

use super::float::Floats;
use super::leading::root_of;
use super::radial::Radial;
use crate::arith::{Integer, Interval, Rational};
use crate::linalg::{Entry, Matrix};
use crate::poly::Poly;
use malachite_base::num::arithmetic::traits::{DivRound, Pow};
use malachite_base::num::logic::traits::SignificantBits;
use malachite_base::rounding_modes::RoundingMode::Nearest;

/// A disc of the complex plane in which a matrix has an eigenvalue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Disc {
    /// Real and imaginary part of the centre.
    pub centre: (Rational, Rational),
    /// The radius.
    pub error: Rational,
}

/// Binary places of the centre, relative to the largest entry of the matrix.
const PLACES: u64 = 220;

impl Disc {
    /// A small disc around an eigenvalue that floats find largest; `None` where 0 is not outside.
    pub(super) fn leading<E: Radial>(m: &Matrix<E>) -> Option<Self> {
        let unit = size(m)?;
        let scaled = m.scale(&E::of(&(Rational::from(1) / &unit)));
        let (re, im) = Floats::of(&scaled).eigenvalue()?;
        let chi = E::char_poly(&scaled);
        let found = Self::near(&chi, re, im).or_else(|| Self::near(&E::squarefree(&chi)?, re, im))?;
        let centre = (found.centre.0 * &unit, found.centre.1 * &unit);
        Some(Self { centre, error: found.error * unit })
    }

    /// Newton's steps from a float to a root of a polynomial, and a disc around it.
    fn near<E: Radial>(chi: &[E], re: f64, im: f64) -> Option<Self> {
        let coeffs = nearby(chi);
        let scale = Rational::from(Integer::from(1) << PLACES);
        let fixed = |x: f64| Integer::try_from(super::exact::grid(x) * &scale).ok();
        let (mut x, mut y) = (fixed(re)?, fixed(im)?);
        for _ in 0..8 {
            let (value, slope) = (horner(&coeffs, &x, &y), horner(&derivative(&coeffs), &x, &y));
            let square = &slope.0 * &slope.0 + &slope.1 * &slope.1;
            if square == 0 {
                return None;
            }
            let step = |a: Integer| a.div_round(&square, Nearest).0;
            let dx = step(&value.0 * &slope.0 + &value.1 * &slope.1);
            let dy = step(&value.1 * &slope.0 - &value.0 * &slope.1);
            if dx == 0 && dy == 0 {
                break;
            }
            (x, y) = (x - dx, y - dy);
        }
        let centre = (Rational::from(x) / &scale, Rational::from(y) / &scale);
        let found = Self::around(chi, &centre.0, &centre.1)?;
        let square = &found.centre.0 * &found.centre.0 + &found.centre.1 * &found.centre.1;
        (&found.error * &found.error * Rational::from(1u64 << 40) < square).then_some(found)
    }

    /// The disc around `x + iy` of radius `n |χ/χ'|`, in which a polynomial `χ` of degree `n`, given by its coefficients, the
    /// constant one first, has a root; `None` where `χ' = 0`.
    #[must_use]
    pub fn around<E: Entry>(chi: &[E], x: &Rational, y: &Rational) -> Option<Self> {
        let (u, v) = (E::of(x), E::of(y));
        let square = |p: &[E]| {
            let step =
                |(a, b): (E, E), c: &E| (a.times(&u).minus(&b.times(&v)).plus(c), a.times(&v).plus(&b.times(&u)));
            let (a, b) = p.iter().rev().fold((E::zero(), E::zero()), step);
            a.times(&a).plus(&b.times(&b))
        };
        let derivative: Vec<E> = chi.iter().zip(0..).skip(1).map(|(c, k)| c.times(&E::integer(k))).collect();
        let degree = E::integer(i64::try_from(chi.len()).ok()? - 1);
        let ratio = square(chi).times(&degree).times(&degree).over(&square(&derivative))?;
        let error = root_of(&Interval::point(ratio.enclosure(2 * PLACES + 80).hi), 2, PLACES + 40).hi;
        Some(Self { centre: (x.clone(), y.clone()), error })
    }

    /// An enclosure of the modulus of the eigenvalue.
    #[must_use]
    pub fn modulus(&self, bits: u64) -> Interval {
        let square = &self.centre.0 * &self.centre.0 + &self.centre.1 * &self.centre.1;
        let middle = root_of(&Interval::point(square), 2, bits);
        Interval::new((middle.lo - &self.error).max(Rational::from(0)), middle.hi + &self.error)
    }

    /// Whether the centre is a real number.
    #[must_use]
    pub fn is_real(&self) -> bool {
        self.centre.1 == 0
    }
}

/// A power of two about as large as the largest entry; `None` of the zero matrix.
fn size<E: Entry>(m: &Matrix<E>) -> Option<Rational> {
    let log = |x: &Rational| {
        i64::try_from(x.numerator_ref().significant_bits())
            .ok()
            .zip(i64::try_from(x.denominator_ref().significant_bits()).ok())
    };
    let entries = m.entries().iter().filter(|x| !x.is_zero());
    let exponent = entries
        .map(|x| log(&x.enclosure(PLACES).hi).map(|(n, d)| n - d))
        .collect::<Option<Vec<_>>>()?
        .into_iter()
        .max()?;
    Some(Rational::from(2).pow(exponent))
}

/// Whole numbers in about the ratio of the coefficients of a polynomial: exactly so of rational ones.
fn nearby<E: Entry>(p: &[E]) -> Vec<Integer> {
    Poly::new(p.iter().map(|c| c.enclosure(2 * PLACES).mid()).collect()).primitive()
}

fn derivative(coeffs: &[Integer]) -> Vec<Integer> {
    coeffs.iter().enumerate().skip(1).map(|(k, c)| c * Integer::from(k as u64)).collect()
}

/// `2^(PLACES n) p(z)`, `n` the degree, at `z = 2^-PLACES (x + iy)`.
fn horner(coeffs: &[Integer], x: &Integer, y: &Integer) -> (Integer, Integer) {
    let mut value = (Integer::from(0), Integer::from(0));
    for (k, c) in coeffs.iter().rev().enumerate() {
        let shift = PLACES * k as u64;
        value = (&value.0 * x - &value.1 * y + (c << shift), &value.0 * y + &value.1 * x);
    }
    value
}
