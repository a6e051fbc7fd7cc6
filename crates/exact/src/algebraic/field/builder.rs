use super::named::{self, NoRoot, cosine_degree};
use super::{MAX_FIELD_DEGREE, NumberField, over};
use crate::algebraic::{Elem, Root, roots};
use crate::arith::{Rational, sign};
use crate::poly::{Poly, factor};
use malachite_base::num::conversion::traits::ExactFrom;
use malachite_base::num::logic::traits::SignificantBits;
use std::collections::BTreeMap;
use thiserror::Error;

/// Largest `n` for which `cos(2*pi*k/n)` is built.
pub const MAX_ANGLE: usize = 1_000;

/// Longest numbers that powers may produce, in bits.
const MAX_POWER_BITS: u64 = 100_000;

/// Why a number cannot be built.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FieldError {
    /// A field of this degree over the rationals, or the norm that is needed to find it, is over the limit.
    #[error("the field of these numbers needs polynomials of degree {0}, which is over the limit")]
    Degree(usize),
    /// An even root of a negative number.
    #[error("this root of a negative number is not real")]
    NotReal,
    /// A division by zero.
    #[error("a division by zero")]
    DivisionByZero,
    /// The number of real roots of a polynomial in the interval, which is not 1.
    #[error("the polynomial has {0} real roots in this interval, not one")]
    Roots(usize),
    /// The zero polynomial.
    #[error("every number is a root of the zero polynomial")]
    ZeroPolynomial,
    /// A power whose numbers would be too long.
    #[error("this power is too large")]
    Power,
}

impl From<NoRoot> for FieldError {
    fn from(error: NoRoot) -> Self {
        match error {
            NoRoot::Zero => Self::ZeroPolynomial,
            NoRoot::Count(n) => Self::Roots(n),
        }
    }
}

/// A number in the field of a [`FieldBuilder`]; it stays valid when the field grows.
#[derive(Debug, Clone)]
pub struct Number {
    epoch: usize,
    elem: Elem,
}

/// A real number field that grows with the numbers that are put into it.
#[derive(Debug, Clone)]
pub struct FieldBuilder {
    field: NumberField,
    /// For each growth, the old generator in the new field.
    growths: Vec<Elem>,
    known: Vec<(Root, Number)>,
    cosines: BTreeMap<usize, Number>,
    /// Roots and cosines in the order in which they were asked for.
    asked: Vec<Number>,
    pub(super) constants: BTreeMap<String, Number>,
}

impl Default for FieldBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl FieldBuilder {
    /// The rationals.
    #[must_use]
    pub fn new() -> Self {
        Self {
            field: NumberField::rationals(),
            growths: Vec::new(),
            known: Vec::new(),
            cosines: BTreeMap::new(),
            asked: Vec::new(),
            constants: BTreeMap::new(),
        }
    }

    /// The field so far.
    #[must_use]
    pub fn field(&self) -> &NumberField {
        &self.field
    }

    /// The values of the roots and cosines that were asked for.
    #[must_use]
    pub fn asked(&self) -> &[Number] {
        &self.asked
    }

    fn noted(&mut self, number: Number) -> Number {
        self.asked.push(number.clone());
        number
    }

    /// A number as an element of the field as it is now.
    #[must_use]
    pub fn elem(&self, x: &Number) -> Elem {
        let mut elem = x.elem.clone();
        if elem.is_rational().is_some() {
            return elem;
        }
        // Each image lives in the field of the next growth, whose polynomial is only kept for the last one.
        let mut image: Option<Elem> = None;
        for old in self.growths[x.epoch..].iter().rev() {
            image = Some(match image {
                None => old.clone(),
                Some(next) => over::evaluated(&old.0, &next, self.field.poly()),
            });
        }
        if let Some(image) = image {
            elem = over::evaluated(&elem.0, &image, self.field.poly());
        }
        elem
    }

    fn number(&self, elem: Elem) -> Number {
        Number { epoch: self.growths.len(), elem }
    }

    /// A rational number.
    #[must_use]
    pub fn rational(&self, q: &Rational) -> Number {
        self.number(Elem::from_rational(q))
    }

    /// The value, when it is rational.
    #[must_use]
    pub fn is_rational(&self, x: &Number) -> Option<Rational> {
        x.elem.is_rational()
    }

    /// A real root of an irreducible polynomial; the field grows when the number is not in it.
    ///
    /// # Errors
    /// [`FieldError::NotReal`], or [`FieldError::Degree`] when the field becomes too large.
    pub fn adjoin(&mut self, root: &Root) -> Result<Number, FieldError> {
        self.adjoin_labelled(root, None)
    }

    fn adjoin_labelled(&mut self, root: &Root, label: Option<String>) -> Result<Number, FieldError> {
        if let Some(q) = root.rational() {
            return Ok(self.rational(&q));
        }
        if !root.is_real() {
            return Err(FieldError::NotReal);
        }
        if let Some((_, x)) = self.known.iter().find(|(r, _)| r.same(root)) {
            return Ok(x.clone());
        }
        if root.degree() > MAX_FIELD_DEGREE {
            return Err(FieldError::Degree(root.degree()));
        }
        let number = self.grown(root, label)?;
        self.known.push((root.clone(), number.clone()));
        Ok(number)
    }

    fn grow(&mut self, field: NumberField, old: Elem) {
        self.field = field;
        self.growths.push(old);
    }

    fn grown(&mut self, root: &Root, label: Option<String>) -> Result<Number, FieldError> {
        let labelled = |root: &Root| NumberField { root: root.clone(), label: label.map(Into::into) };
        if self.field.is_rational() {
            self.grow(labelled(root), Elem::zero());
            return Ok(self.number(Elem::generator(root.minpoly())));
        }
        let (extension, theta) = self.field.joined(root)?;
        let degree = theta.degree();
        let whole = NumberField { root: theta, label: None };
        let one = std::slice::from_ref;
        // The old generator, or the new number, serves where it generates the whole field.
        if degree == self.field.degree() {
            let images = whole.in_powers_of(&extension.alpha, one(&extension.lambda));
            let image = images.and_then(|mut v| v.pop()).expect("the field did not grow");
            return Ok(self.number(image));
        }
        if degree == root.degree() {
            let images = whole.in_powers_of(&extension.lambda, one(&extension.alpha));
            let image = images.and_then(|mut v| v.pop()).expect("the new number generates the field");
            self.grow(labelled(root), image);
            return Ok(self.number(Elem::generator(root.minpoly())));
        }
        self.grow(whole, extension.alpha);
        Ok(self.number(extension.lambda))
    }

    /// `a + b`.
    #[must_use]
    pub fn add(&self, a: &Number, b: &Number) -> Number {
        self.number(self.elem(a).add(&self.elem(b)))
    }

    /// `a - b`.
    #[must_use]
    pub fn sub(&self, a: &Number, b: &Number) -> Number {
        self.number(self.elem(a).sub(&self.elem(b)))
    }

    /// `a * b`.
    #[must_use]
    pub fn mul(&self, a: &Number, b: &Number) -> Number {
        self.number(self.field.mul(&self.elem(a), &self.elem(b)))
    }

    /// `a / b`.
    ///
    /// # Errors
    /// [`FieldError::DivisionByZero`].
    pub fn div(&self, a: &Number, b: &Number) -> Result<Number, FieldError> {
        let quotient = self.field.div(&self.elem(a), &self.elem(b)).ok_or(FieldError::DivisionByZero)?;
        Ok(self.number(quotient))
    }

    /// The sign, exactly.
    #[must_use]
    pub fn sign(&self, x: &Number) -> i32 {
        self.field.sign(&self.elem(x))
    }

    /// The real `n`-th root, positive for even `n`.
    ///
    /// # Errors
    /// [`FieldError::NotReal`] for an even root of a negative number, [`FieldError::Degree`].
    pub fn nth_root(&mut self, x: &Number, n: usize) -> Result<Number, FieldError> {
        let root = self.real_root(x, n)?;
        Ok(self.noted(root))
    }

    fn real_root(&mut self, x: &Number, n: usize) -> Result<Number, FieldError> {
        let negative = match self.sign(x) {
            0 => return Ok(x.clone()),
            s => s < 0,
        };
        if n == 0 || n > MAX_FIELD_DEGREE {
            return Err(FieldError::Degree(n));
        }
        if negative {
            if n.is_multiple_of(2) {
                return Err(FieldError::NotReal);
            }
            let zero = self.rational(&Rational::from(0));
            let root = self.real_root(&self.sub(&zero, x), n)?;
            return Ok(self.sub(&zero, &root));
        }
        if let (Some(q), 2) = (self.is_rational(x), n) {
            return self.square_root(&q);
        }
        let radicand = self.field.locate(&self.elem(x));
        if radicand.degree() * n > super::extension::MAX_NORM_DEGREE {
            return Err(FieldError::Degree(radicand.degree() * n));
        }
        let root = positive_root(&radicand, n);
        let number = self.adjoin(&root)?;
        debug_assert_eq!(self.elem(&self.power_by(&number, n)), self.elem(x));
        Ok(number)
    }

    fn square_root(&mut self, q: &Rational) -> Result<Number, FieldError> {
        let (factor, core) = named::square_part(q);
        let factor = self.rational(&factor);
        if core == 1 {
            return Ok(factor);
        }
        let poly = Poly::new(vec![-Rational::from(&core), 0.into(), 1.into()]);
        let root = self.adjoin_labelled(&roots(&poly)[1], Some(format!("sqrt({core})")))?;
        Ok(self.mul(&factor, &root))
    }

    /// The root of a polynomial between two rationals.
    ///
    /// # Errors
    /// [`FieldError::Roots`] unless exactly one real root lies there, [`FieldError::Degree`].
    pub fn root_between(&mut self, f: &Poly, lo: &Rational, hi: &Rational) -> Result<Number, FieldError> {
        let root = self.adjoin(&named::root_between(f, lo, hi)?)?;
        Ok(self.noted(root))
    }

    /// The real root of a polynomial with a place, from 0, among its different real roots, ascending.
    ///
    /// # Errors
    /// [`FieldError::Roots`] where there are not so many, [`FieldError::Degree`].
    pub fn root_number(&mut self, f: &Poly, place: usize) -> Result<Number, FieldError> {
        let found = named::all_real_roots(f);
        let root = found.get(place).ok_or(FieldError::Roots(found.len()))?.clone();
        let root = self.adjoin(&root)?;
        Ok(self.noted(root))
    }

    /// `cos(2π turns)`.
    ///
    /// # Errors
    /// [`FieldError::Degree`] for denominators over `MAX_ANGLE` or fields that become too large.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{algebraic::field::FieldBuilder, arith::ratio};
    /// let mut builder = FieldBuilder::new();
    /// let cosine = builder.cos(&ratio(1, 5))?;
    /// let twice = builder.add(&cosine, &cosine);
    /// // 2cos(2π/5) = (√5 − 1)/2 is a root of x² + x − 1.
    /// let value = builder.add(&builder.mul(&twice, &twice), &twice);
    /// assert_eq!(builder.is_rational(&value), Some(ratio(1, 1)));
    /// # Ok::<(), secant_exact::algebraic::field::FieldError>(())
    /// ```
    pub fn cos(&mut self, turns: &Rational) -> Result<Number, FieldError> {
        let too_large = || FieldError::Degree(MAX_ANGLE);
        let n = usize::try_from(turns.denominator_ref()).ok().filter(|n| *n <= MAX_ANGLE).ok_or_else(too_large)?;
        let k = {
            use malachite_base::num::arithmetic::traits::Mod;
            let numerator = crate::arith::Integer::from_sign_and_abs(*turns >= 0, turns.numerator_ref().clone());
            usize::exact_from(&numerator.mod_op(crate::arith::Integer::from(n)))
        };
        if n > 2 && cosine_degree(n) > MAX_FIELD_DEGREE {
            return Err(FieldError::Degree(cosine_degree(n)));
        }
        let double = match self.cosines.get(&n) {
            Some(x) => x.clone(),
            None => {
                let label = format!("2*cos(2*pi/{n})");
                let x = self.adjoin_labelled(&named::cosine(1, n), Some(label))?;
                self.cosines.insert(n, x.clone());
                x
            }
        };
        // V_0 = 2, V_1 = x, V_(k+1) = x V_k - V_(k-1) is 2 cos kφ for x = 2 cos φ.
        let (f, x) = (self.field.poly(), self.elem(&double));
        let (mut a, mut b) = (Elem::from_rational(&2.into()), x.clone());
        for _ in 0..k.min(n - k) {
            (a, b) = (b.clone(), b.mul(&x, f).sub(&a));
        }
        let cosine = self.number(a.scale(&crate::arith::ratio(1, 2)));
        Ok(self.noted(cosine))
    }

    fn power_by(&self, x: &Number, e: usize) -> Number {
        let (f, x) = (self.field.poly(), self.elem(x));
        let (mut power, mut base, mut e) = (Elem::from_rational(&1.into()), x, e);
        while e > 0 {
            if e % 2 == 1 {
                power = power.mul(&base, f);
            }
            e /= 2;
            if e > 0 {
                base = base.mul(&base, f);
            }
        }
        self.number(power)
    }

    /// `x^q` for a rational exponent.
    ///
    /// # Errors
    /// [`FieldError::Power`] where the exponent is large, otherwise as [`FieldBuilder::nth_root`].
    pub fn power(&mut self, x: &Number, q: &Rational) -> Result<Number, FieldError> {
        let exponent = usize::try_from(q.numerator_ref()).map_err(|_| FieldError::Power)?;
        let index = usize::try_from(q.denominator_ref()).map_err(|_| FieldError::Power)?;
        let root = if index == 1 { x.clone() } else { self.nth_root(x, index)? };
        let bits: u64 = self.elem(&root).0.coeffs().iter().map(bits).sum();
        if (bits + 1).saturating_mul(exponent as u64) > MAX_POWER_BITS {
            return Err(FieldError::Power);
        }
        let power = self.power_by(&root, exponent);
        if sign(q) >= 0 { Ok(power) } else { self.div(&self.rational(&1.into()), &power) }
    }

    /// The numbers in the smallest field that holds them all (see [`NumberField::shrunk`]).
    #[must_use]
    pub fn finish(&self, numbers: &[Number]) -> (NumberField, Vec<Elem>) {
        let elements: Vec<Elem> = numbers.iter().map(|x| self.elem(x)).collect();
        self.field.shrunk(&elements)
    }
}

fn bits(x: &Rational) -> u64 {
    x.numerator_ref().significant_bits() + x.denominator_ref().significant_bits()
}

/// The positive `n`-th root of a positive number.
fn positive_root(radicand: &Root, n: usize) -> Root {
    let mut coeffs = vec![Rational::from(0); radicand.degree() * n + 1];
    for (k, c) in radicand.minpoly().coeffs().iter().enumerate() {
        coeffs[k * n] = c.clone();
    }
    let mut left: Vec<Root> =
        factor(&Poly::new(coeffs)).iter().flat_map(|(g, _)| roots(g)).filter(|r| r.sign() > 0).collect();
    let mut working = 64;
    // Different positive candidates have different powers, all of them conjugates of the radicand.
    while left.len() > 1 {
        let target = radicand.enclosure(working).0;
        left.retain(|r| {
            let x = r.enclosure(working).0;
            let power = (1..n).fold(x.clone(), |acc, _| &acc * &x);
            !power.disjoint(&target)
        });
        working *= 2;
    }
    left.remove(0)
}
