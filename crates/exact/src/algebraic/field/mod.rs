//! Real number fields `K = Q(α)`: named numbers such as `sqrt(5)` and `cos(2*pi/7)`, expressions in them, and matrices.
//!
//! A [`FieldBuilder`] reads expressions and lets the field grow with every generator: for a real root `β` of an
//! irreducible `g`, the norm `N(x)` of `g(x - sα)` is made square-free by the choice of the integer `s`, so that
//! `θ = β + sα` generates `Q(α, β)`, its minimal polynomial is the factor of `N` that vanishes at `θ`, and `α` is the
//! only common root of `f(y)` and `g(θ - sy)`. Every step is verified: the images satisfy the polynomials of `α` and
//! `β`, and their enclosures single out the right roots.
//!
//! Source: B. Trager, *Algebraic factoring and rational function integration* (1976).

mod builder;
mod expression;
mod extension;
mod matrix;
mod named;
mod over;

pub use builder::{FieldBuilder, FieldError, Number};
pub use expression::Expression;
pub use expression::{ExpressionError, polynomial};
pub use extension::Extension;
pub(crate) use extension::place;
pub use matrix::FieldMatrix;
pub use named::{cosine, cosine_polynomial, real_root, square_part};

use super::{Elem, Root};
use crate::arith::{Interval, Rational, sign, to_f64};
use crate::linalg::Matrix;
use crate::poly::Poly;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Largest degree of a field that is built.
pub const MAX_FIELD_DEGREE: usize = 24;

/// The field `Q(α)` of a real algebraic number `α`; its elements are [`Elem`]s, polynomials in `α`.
#[derive(Debug, Clone)]
pub struct NumberField {
    root: Root,
    label: Option<Arc<str>>,
}

impl NumberField {
    /// The field of the rationals, as `Q(0)`.
    #[must_use]
    pub fn rationals() -> Self {
        Self { root: Root::from_rational(&Rational::from(0)), label: None }
    }

    /// The field that a real number generates; `None` for a number that is not real.
    #[must_use]
    pub fn generated(root: &Root) -> Option<Self> {
        if root.degree() == 1 {
            return Some(Self::rationals());
        }
        root.is_real().then(|| Self { root: root.clone(), label: None })
    }

    /// The same field with a text for its generator, such as `sqrt(5)`.
    #[must_use]
    pub fn labelled(mut self, label: &str) -> Self {
        self.label = Some(Arc::from(label));
        self
    }

    /// The generator `α`.
    #[must_use]
    pub fn generator(&self) -> &Root {
        &self.root
    }

    /// The text of the generator, where there is a short one.
    #[must_use]
    pub fn label(&self) -> Option<&str> {
        self.label.as_deref()
    }

    /// The generator as an expression that [`NumberField::read`] understands: its text, or `root(p, lo, hi)`.
    #[must_use]
    pub fn text(&self) -> String {
        if let Some(label) = self.label() {
            return label.to_owned();
        }
        let others: Vec<Root> = super::real_roots(self.poly()).into_iter().filter(|r| !r.same(&self.root)).collect();
        let mut bits = 4;
        loop {
            // Strictly inside, as the ends of an enclosure may be the root itself.
            let step = Rational::from(1) >> bits;
            let own = self.root.enclosure(bits).0.outward(bits);
            let wide = Interval::new(own.lo - &step, own.hi + step);
            if others.iter().all(|r| r.enclosure(bits).0.disjoint(&wide)) {
                return format!("root({}, {}, {})", self.poly().display("x"), wide.lo, wide.hi);
            }
            bits += 4;
        }
    }

    /// The monic minimal polynomial of the generator.
    #[must_use]
    pub fn poly(&self) -> &Poly {
        self.root.minpoly()
    }

    /// The degree over the rationals.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.root.degree()
    }

    /// Whether this is the field of the rationals.
    #[must_use]
    pub fn is_rational(&self) -> bool {
        self.degree() == 1
    }

    /// Whether the generators are the same number.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        self.root.same(&other.root)
    }

    /// `a * b`.
    #[must_use]
    pub fn mul(&self, a: &Elem, b: &Elem) -> Elem {
        a.mul(b, self.poly())
    }

    /// `a / b`, or `None` for `b = 0`.
    #[must_use]
    pub fn div(&self, a: &Elem, b: &Elem) -> Option<Elem> {
        Some(self.mul(a, &b.inv(self.poly())?))
    }

    /// The sign of an element, exactly.
    #[must_use]
    pub fn sign(&self, a: &Elem) -> i32 {
        a.sign(&self.root)
    }

    /// The order of two elements, exactly.
    #[must_use]
    pub fn cmp(&self, a: &Elem, b: &Elem) -> Ordering {
        self.sign(&a.sub(b)).cmp(&0)
    }

    /// An enclosure of an element, of width at most `2^-bits`.
    #[must_use]
    pub fn enclosure(&self, a: &Elem, bits: u64) -> Interval {
        a.enclosure(&self.root, bits).0
    }

    /// The nearest double, for display and for proposals.
    #[must_use]
    pub fn to_f64(&self, a: &Elem) -> f64 {
        to_f64(&self.enclosure(a, 80).mid())
    }

    /// An element as a root of its minimal polynomial.
    #[must_use]
    pub fn locate(&self, a: &Elem) -> Root {
        super::locate(a, &self.root)
    }

    /// The rational matrix of the multiplication by an element, in the basis `1, α, α^2, …` (columns are images).
    #[must_use]
    pub fn multiplication(&self, a: &Elem) -> Matrix {
        let d = self.degree();
        let x = Elem::generator(self.poly());
        let mut columns = Vec::with_capacity(d);
        let mut image = a.clone();
        for _ in 0..d {
            columns.push((0..d).map(|k| image.0.coeff(k)).collect::<Vec<_>>());
            image = self.mul(&image, &x);
        }
        Matrix::from_columns(d, &columns)
    }

    /// The coordinates of elements in the powers of `base`, where they lie in `Q(base)`; `None` where one does not.
    ///
    /// # Cost
    /// One elimination of size `deg K`.
    #[must_use]
    pub fn in_powers_of(&self, base: &Elem, elements: &[Elem]) -> Option<Vec<Elem>> {
        let d = self.degree();
        let count = base.minpoly(self.poly()).degree().unwrap_or(1);
        let column = |e: &Elem| (0..d).map(|k| e.0.coeff(k)).collect::<Vec<Rational>>();
        let mut powers = Vec::with_capacity(count);
        let mut power = Elem::from_rational(&Rational::from(1));
        for _ in 0..count {
            powers.push(column(&power));
            power = self.mul(&power, base);
        }
        let right: Vec<Vec<Rational>> = elements.iter().map(column).collect();
        let solved = Matrix::from_columns(d, &powers).solve(&Matrix::from_columns(d, &right))?;
        Some((0..elements.len()).map(|j| Elem(Poly::new(solved.column(j)))).collect())
    }

    /// The smallest field that contains the given elements, and the elements in it.
    ///
    /// Fields of degree 2 get the generator `sqrt(D)` with a square-free integer `D`; where the elements generate the
    /// whole of a larger field, its generator stays.
    #[must_use]
    pub fn shrunk(&self, elements: &[Elem]) -> (Self, Vec<Elem>) {
        let irrational: BTreeMap<&[Rational], &Elem> =
            elements.iter().filter(|e| e.is_rational().is_none()).map(|e| (e.0.coeffs(), e)).collect();
        let Some(first) = irrational.values().next() else {
            return (Self::rationals(), elements.to_vec());
        };
        let mut base = (*first).clone();
        if self.degree() > 2 {
            for e in irrational.values() {
                if base.minpoly(self.poly()).degree() == Some(self.degree()) {
                    break;
                }
                base = self.joint_generator(&base, e);
            }
            if base.minpoly(self.poly()).degree() == Some(self.degree()) {
                return (self.clone(), elements.to_vec());
            }
        }
        let (field, generator) = self.subfield(&base);
        match self.in_powers_of(&generator, elements) {
            Some(elements) => (field, elements),
            None => (self.clone(), elements.to_vec()),
        }
    }

    /// An element `base + c e` that generates both.
    fn joint_generator(&self, base: &Elem, e: &Elem) -> Elem {
        if self.in_powers_of(base, std::slice::from_ref(e)).is_some() {
            return base.clone();
        }
        (1..)
            .map(|c: u32| base.add(&e.scale(&Rational::from(c))))
            .find(|g| self.in_powers_of(g, &[base.clone(), e.clone()]).is_some())
            .expect("only finitely many multiples fail")
    }

    /// The field of one element, with the element of this field that is its generator.
    fn subfield(&self, base: &Elem) -> (Self, Elem) {
        let minpoly = base.minpoly(self.poly());
        if minpoly.degree() == Some(2) {
            let half = minpoly.coeff(1) / Rational::from(2);
            let discriminant = &half * &half - minpoly.coeff(0);
            let (factor, core) = named::square_part(&discriminant);
            // base = -half ± factor sqrt(core)
            let shifted = base.add(&Elem::from_rational(&half)).scale(&(Rational::from(1) / factor));
            let generator = if self.sign(&shifted) < 0 { shifted.neg() } else { shifted };
            let field = Self { root: self.locate(&generator), label: Some(format!("sqrt({core})").into()) };
            return (field, generator);
        }
        let scaled = base.scale(&integral_factor(&minpoly));
        (Self { root: self.locate(&scaled), label: None }, scaled)
    }

    /// Text such as `Q(α), α = sqrt(5) = 2.2360679775, root 2 of x^2 - 5`.
    #[must_use]
    pub fn describe(&self) -> String {
        if self.is_rational() {
            return "Q".to_owned();
        }
        let label = self.label().map_or(String::new(), |l| format!("{l} = "));
        let value = self.to_f64(&Elem::generator(self.poly()));
        format!(
            "Q(α), α = {label}{value:.10}, root {} of {}",
            self.root.index() + 1,
            self.poly().primitive_display("x")
        )
    }

    /// An element as text in `α`, or in the label of a field of square roots: `1/4 + 1/4 sqrt(3)`.
    #[must_use]
    pub fn display(&self, a: &Elem) -> String {
        match (a.is_rational(), self.label()) {
            (Some(q), _) => q.to_string(),
            (None, Some(label)) if self.degree() == 2 => with_label(a, label),
            _ => a.display("α"),
        }
    }
}

impl NumberField {
    /// An element as an expression that [`FieldBuilder::parse`] reads, without blanks: in `sqrt(5)`, in the cosines
    /// `cos(2*pi*k/n)` where the generator is `2*cos(2*pi/n)`, or in powers of `root(polynomial,lo,hi)`.
    #[must_use]
    pub fn expression(&self, a: &Elem) -> String {
        if let Some(q) = a.is_rational() {
            return q.to_string();
        }
        let label = self.label().unwrap_or_default();
        if let Some(n) = label.strip_prefix("2*cos(2*pi/").and_then(|t| t.strip_suffix(')')) {
            let angle = |k: usize| if k == 1 { format!("cos(2*pi/{n})") } else { format!("cos({}*pi/{n})", 2 * k) };
            return terms(&cosine_coordinates(a), angle);
        }
        let name = if label.starts_with("sqrt(") { label.to_owned() } else { self.bracketed() };
        let coefficients: Vec<Rational> = a.0.coeffs().to_vec();
        terms(&coefficients, |k| if k == 1 { name.clone() } else { format!("{name}^{k}") })
    }

    /// The generator as `root(polynomial,lo,hi)`.
    fn bracketed(&self) -> String {
        let others: Vec<Root> = super::roots(self.poly()).into_iter().filter(|r| r.is_real()).collect();
        let mut bits = 4;
        loop {
            let own = self.root.enclosure(bits).0.outward(bits);
            let alone = |r: &&Root| r.enclosure(bits + 4).0.disjoint(&own);
            if others.iter().filter(alone).count() + 1 == others.len() {
                let poly = self.poly().primitive_display("x").replace(' ', "");
                return format!("root({poly},{},{})", own.lo, own.hi);
            }
            bits *= 2;
        }
    }
}

/// The coordinates in `1, cos φ, cos 2φ, …` of a polynomial in `2 cos φ`.
fn cosine_coordinates(a: &Elem) -> Vec<Rational> {
    let d = a.0.coeffs().len();
    let mut out = vec![Rational::from(0); d];
    // x^m = sum of binomial(m, j) z^(m - 2j) with z = e^(iφ).
    let mut binomials = vec![Rational::from(1)];
    for (m, c) in a.0.coeffs().iter().enumerate() {
        for (j, b) in binomials.iter().enumerate() {
            out[m.abs_diff(2 * j)] += c * b;
        }
        let mut next = vec![Rational::from(1)];
        next.extend(binomials.windows(2).map(|w| &w[0] + &w[1]));
        next.push(Rational::from(1));
        binomials = next;
    }
    out
}

/// The sum of the coefficients times their names, the first one alone.
fn terms(coefficients: &[Rational], name: impl Fn(usize) -> String) -> String {
    let mut out = String::new();
    for (k, c) in coefficients.iter().enumerate().filter(|(_, c)| **c != 0) {
        let size = crate::arith::abs(c);
        out.push_str(if *c < 0 {
            "-"
        } else if out.is_empty() {
            ""
        } else {
            "+"
        });
        match (k, size == 1) {
            (0, _) => out.push_str(&size.to_string()),
            (_, true) => out.push_str(&name(k)),
            (_, false) => {
                out.push_str(&size.to_string());
                out.push('*');
                out.push_str(&name(k));
            }
        }
    }
    out
}

/// `a + b label`.
fn with_label(a: &Elem, label: &str) -> String {
    let (c, b) = (a.0.coeff(0), a.0.coeff(1));
    let size = crate::arith::abs(&b);
    let numerator = size.numerator_ref();
    let product = if *numerator == 1 { label.to_owned() } else { format!("{numerator}*{label}") };
    let term = if *size.denominator_ref() == 1 { product } else { format!("{product}/{}", size.denominator_ref()) };
    match (sign(&c), sign(&b) < 0) {
        (0, false) => term,
        (0, true) => format!("-{term}"),
        (_, negative) => format!("{c} {} {term}", if negative { '-' } else { '+' }),
    }
}

/// A positive integer that makes every root of the polynomial an algebraic integer.
fn integral_factor(f: &Poly) -> Rational {
    f.primitive().last().map_or(Rational::from(1), Rational::from)
}

#[cfg(test)]
mod tests;
