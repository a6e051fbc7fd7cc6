use super::over;
use super::{FieldError, NumberField};
use crate::algebraic::{Elem, Root, roots};
use crate::arith::{Interval, Rational};
use crate::linalg::{Matrix, char_poly};
use crate::poly::{Poly, factor};

/// Largest degree of a norm that is factored.
pub(crate) const MAX_NORM_DEGREE: usize = 320;

/// A field `K(λ) = Q(θ)` with `θ = λ + sα`, where `λ` is a root of a polynomial over the rationals.
#[derive(Debug, Clone)]
pub struct Extension {
    /// The minimal polynomial of `θ` over the rationals.
    pub poly: Poly,
    /// The generator of `K` as a polynomial in `θ`.
    pub alpha: Elem,
    /// The number `λ` as a polynomial in `θ`.
    pub lambda: Elem,
    /// The integer `s`.
    pub shift: i64,
}

/// The norm of `g(x - sα)` from `K` to the rationals, square-free, with its factors.
pub(super) struct Norm {
    pub shift: i64,
    pub factors: Vec<Poly>,
}

/// 1, -1, 2, -2, …
fn shifts() -> impl Iterator<Item = i64> {
    (1..).flat_map(|s| [s, -s])
}

/// The multiplication by `x + s y` on `Q[x, y] / (g(x), f(y))`.
fn sum_matrix(f: &Poly, g: &Poly, s: i64) -> Matrix {
    let (d, e) = (f.degree().unwrap_or(1), g.degree().unwrap_or(1));
    let mut m = Matrix::zero(d * e, d * e);
    let s = Rational::from(s);
    for i in 0..e {
        for j in 0..d {
            let from = i * d + j;
            if i + 1 < e {
                m[((i + 1) * d + j, from)] += Rational::from(1);
            } else {
                (0..e).for_each(|k| m[(k * d + j, from)] -= g.coeff(k));
            }
            if j + 1 < d {
                m[(i * d + j + 1, from)] += &s;
            } else {
                (0..d).for_each(|k| m[(i * d + k, from)] -= &s * f.coeff(k));
            }
        }
    }
    m
}

impl Norm {
    /// For irreducible `f` of `α` and `g`, up to a bound of the degree.
    pub fn of(f: &Poly, g: &Poly) -> Result<Self, FieldError> {
        let degree = f.degree().unwrap_or(1) * g.degree().unwrap_or(1);
        if degree > MAX_NORM_DEGREE {
            return Err(FieldError::Degree(degree));
        }
        Ok(Self::unbounded(&f.monic(), &g.monic()))
    }

    fn unbounded(f: &Poly, g: &Poly) -> Self {
        for shift in shifts() {
            let norm = char_poly(&sum_matrix(f, g, shift));
            if norm.gcd(&norm.derivative()).degree() == Some(0) {
                return Self { shift, factors: factor(&norm).into_iter().map(|(m, _)| m).collect() };
            }
        }
        unreachable!("only finitely many shifts make two sums of roots coincide")
    }
}

impl Extension {
    /// The extension that belongs to one factor of the norm; verified.
    fn from_factor(f: &Poly, g: &Poly, shift: i64, m: &Poly) -> Self {
        let theta = Elem::generator(m);
        let other = over::substituted(g, &theta, &Rational::from(-shift), m);
        let common = over::gcd(over::lifted(f), other, m);
        assert_eq!(common.len(), 2, "a square-free norm leaves one common root");
        let alpha = common[0].neg();
        let lambda = theta.sub(&alpha.scale(&Rational::from(shift)));
        assert!(
            over::evaluated(f, &alpha, m).is_zero() && over::evaluated(g, &lambda, m).is_zero(),
            "images are roots"
        );
        Self { poly: m.clone(), alpha, lambda, shift }
    }

    /// Whether the generator is that of the field itself.
    #[must_use]
    pub fn is_own(&self, field: &NumberField) -> bool {
        self.poly == *field.poly() && self.alpha == Elem::generator(field.poly())
    }

    /// The roots `θ` for which the image of `α` is the given root of its minimal polynomial.
    #[must_use]
    pub fn roots_over(&self, field: &NumberField) -> Vec<Root> {
        let over = |r: &Root| equals(&self.alpha, r, field.generator());
        roots(&self.poly).into_iter().filter(over).collect()
    }
}

/// Whether an element, known to be a root of the minimal polynomial of `target`, is `target` at the root `at`.
pub(crate) fn equals(elem: &Elem, at: &Root, target: &Root) -> bool {
    let all: Vec<Root> = (0..target.degree()).map(|index| Root { index, ..target.clone() }).collect();
    place(elem, at, &all).same(target)
}

/// The one of all conjugates that the value of an element, known to be one of them, is at a root.
pub(crate) fn place<'a>(elem: &Elem, at: &Root, all: &'a [Root]) -> &'a Root {
    let mut bits = 48;
    loop {
        let (re, im) = elem.enclosure(at, bits);
        let meets = |r: &&Root| {
            let (a, b) = r.enclosure(bits);
            !a.disjoint(&re) && !b.disjoint(&im)
        };
        let mut hits = all.iter().filter(meets);
        if let (Some(only), None) = (hits.next(), hits.next()) {
            return only;
        }
        bits *= 2;
    }
}

impl NumberField {
    /// The irreducible factors over this field of an irreducible rational polynomial `g`, each as the extension that one
    /// of its roots generates: `g` has one factor of degree `deg θ / deg K` for each of them.
    ///
    /// # Errors
    /// [`FieldError::Degree`] when `deg g * deg K` is over the limit.
    pub fn extensions(&self, g: &Poly) -> Result<Vec<Extension>, FieldError> {
        let degree = self.degree() * g.degree().unwrap_or(1);
        if degree > MAX_NORM_DEGREE { Err(FieldError::Degree(degree)) } else { Ok(self.all_extensions(g)) }
    }

    /// The same for every degree.
    pub(crate) fn all_extensions(&self, g: &Poly) -> Vec<Extension> {
        let (f, g) = (self.poly(), &g.monic());
        if self.is_rational() || g.degree() == Some(1) {
            let (alpha, lambda) = match g.degree() {
                Some(1) => (Elem::generator(f), Elem::from_rational(&-g.coeff(0))),
                _ => (Elem::zero(), Elem::generator(g)),
            };
            let poly = if g.degree() == Some(1) { f } else { g };
            return vec![Extension { poly: poly.clone(), alpha, lambda, shift: 0 }];
        }
        let norm = Norm::unbounded(f, g);
        norm.factors.iter().map(|m| Extension::from_factor(f, g, norm.shift, m)).collect()
    }

    /// The field of `α` and a real number, as an extension, and its generator `θ`.
    pub(super) fn joined(&self, beta: &Root) -> Result<(Extension, Root), FieldError> {
        let (f, g) = (self.poly(), beta.minpoly());
        // Both degrees divide that of the field.
        let (d, e) = (self.degree(), beta.degree());
        let least = (1..=e).map(|k| k * d).find(|n| n.is_multiple_of(e)).unwrap_or(d * e);
        if least > super::MAX_FIELD_DEGREE {
            return Err(FieldError::Degree(least));
        }
        let norm = Norm::of(f, g)?;
        let smallest = norm.factors.iter().filter_map(Poly::degree).filter(|n| n.is_multiple_of(least)).min();
        if let Some(degree) = smallest.filter(|n| *n > super::MAX_FIELD_DEGREE) {
            return Err(FieldError::Degree(degree));
        }
        let (m, theta) = self.sum_root(&norm, beta);
        if theta.degree() > super::MAX_FIELD_DEGREE {
            return Err(FieldError::Degree(theta.degree()));
        }
        let extension = Extension::from_factor(f, g, norm.shift, m);
        assert!(equals(&extension.alpha, &theta, &self.root), "the image of the generator");
        assert!(equals(&extension.lambda, &theta, beta), "the image of the new number");
        Ok((extension, theta))
    }

    /// The root `β + sα` of the norm, the only one that its enclosures leave.
    fn sum_root<'a>(&self, norm: &'a Norm, beta: &Root) -> (&'a Poly, Root) {
        let mut left: Vec<(&Poly, Root)> =
            norm.factors.iter().flat_map(|m| roots(m).into_iter().map(move |r| (m, r))).collect();
        left.retain(|(_, r)| r.is_real());
        let s = Rational::from(norm.shift);
        let mut bits = 64;
        while left.len() > 1 {
            let sum: Interval = &beta.enclosure(bits).0 + &(&self.root.enclosure(bits).0 * &s);
            left.retain(|(_, r)| !r.enclosure(bits).0.disjoint(&sum));
            bits *= 2;
        }
        left.remove(0)
    }
}
