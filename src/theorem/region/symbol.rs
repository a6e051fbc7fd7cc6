//! Polynomials in one parameter or in two, as arguments about curves use them.

use crate::arith::{Rational, ratio};
use crate::linalg::{Matrix, char_poly};
use crate::poly::{Poly, Two, factor};
use crate::ring::{Plane, Polynomials, Ring};
use std::fmt::Debug;

/// A polynomial in the parameters.
pub trait Symbol: Clone + PartialEq + Debug {
    /// The ring of them.
    type Over: Ring<E = Self>;

    /// The ring of them.
    fn ring() -> Self::Over;

    /// A number.
    fn number(q: Rational) -> Self;

    /// `q self`.
    #[must_use]
    fn multiple(&self, q: &Rational) -> Self;

    /// Whether it is 0 everywhere.
    fn vanishes(&self) -> bool;

    /// A vector without a common divisor, where that is found.
    fn shortened(v: &[Self]) -> Vec<Self>;

    /// Eigenvalues of a matrix that are polynomials themselves.
    fn eigenvalues(m: &Matrix<Self>, chi: &[Self]) -> Vec<Self>;

    /// 0.
    #[must_use]
    fn nought() -> Self {
        Self::ring().zero()
    }

    /// `self + other`.
    #[must_use]
    fn plus(&self, other: &Self) -> Self {
        Self::ring().add(self, other)
    }

    /// `self - other`.
    #[must_use]
    fn minus(&self, other: &Self) -> Self {
        Self::ring().sub(self, other)
    }

    /// `self * other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self {
        Self::ring().mul(self, other)
    }
}

/// Most choices of eigenvalues that are tried.
const MAX_CHOICES: usize = 4096;

/// One of each list, in all ways; none where there are too many.
fn choices<T: Clone>(lists: &[Vec<T>]) -> Vec<Vec<T>> {
    let count = lists.iter().try_fold(1_usize, |n, v| n.checked_mul(v.len()));
    if count.is_none_or(|n| n == 0 || n > MAX_CHOICES) {
        return Vec::new();
    }
    lists.iter().fold(vec![Vec::new()], |all, own| {
        let more =
            |c: &Vec<T>| own.iter().map(|v| [c.as_slice(), std::slice::from_ref(v)].concat()).collect::<Vec<_>>();
        all.iter().flat_map(more).collect()
    })
}

/// Those of some polynomials that are roots, each once.
fn roots<P: Symbol>(chi: &[P], candidates: impl IntoIterator<Item = P>) -> Vec<P> {
    let is_root = |f: &P| super::signs::horner(chi, f).vanishes();
    let mut found: Vec<P> = Vec::new();
    for f in candidates {
        if is_root(&f) && !found.contains(&f) {
            found.push(f);
        }
    }
    found
}

/// Values at which candidates are interpolated.
fn places(degree: usize) -> Vec<Rational> {
    (0..=degree).map(|k| Rational::from(k as u64) + ratio(3, 7)).collect()
}

impl Symbol for Poly {
    type Over = Polynomials;

    fn ring() -> Polynomials {
        Polynomials
    }

    fn number(q: Rational) -> Self {
        Self::constant(q)
    }

    fn multiple(&self, q: &Rational) -> Self {
        self.scale(q)
    }

    fn vanishes(&self) -> bool {
        self.is_zero()
    }

    fn shortened(v: &[Self]) -> Vec<Self> {
        let common = v.iter().fold(Self::zero(), |g, x| g.gcd(x));
        if common.is_zero() { v.to_vec() } else { v.iter().map(|x| x.div_rem(&common).0).collect() }
    }

    /// All those that are rational functions: they are polynomials.
    fn eigenvalues(m: &Matrix<Self>, chi: &[Self]) -> Vec<Self> {
        // The coefficient of `x^(n−k)` has the degree `k · degree` at most, so that a root has the degree `degree`.
        let at = places(m.entries().iter().filter_map(Self::degree).fold(0, usize::max));
        let rational = |p: &Rational| -> Vec<Rational> {
            let member = m.map(|f| f.eval(p));
            let linear = |(f, _): &(Self, usize)| (f.degree() == Some(1)).then(|| -(f.coeff(0) / f.coeff(1)));
            factor(&char_poly(&member)).iter().filter_map(linear).collect()
        };
        let values: Vec<Vec<Rational>> = at.iter().map(rational).collect();
        roots(chi, choices(&values).into_iter().map(|c| Self::through(&at, c)))
    }
}

impl Symbol for Two {
    type Over = Plane;

    fn ring() -> Plane {
        Plane
    }

    fn number(q: Rational) -> Self {
        Self::number(q)
    }

    fn multiple(&self, q: &Rational) -> Self {
        self.scale(q)
    }

    fn vanishes(&self) -> bool {
        self.is_zero()
    }

    fn shortened(v: &[Self]) -> Vec<Self> {
        let common = v.iter().fold(Self::nought(), |g, x| g.gcd(x));
        let divided: Option<Vec<Self>> = v.iter().map(|x| x.divided(&common)).collect();
        divided.unwrap_or_else(|| v.to_vec())
    }

    fn eigenvalues(m: &Matrix<Self>, chi: &[Self]) -> Vec<Self> {
        let at = places(m.entries().iter().map(|f| f.rows().len()).fold(1, usize::max) - 1);
        let along = |q: &Rational| {
            let chi: Vec<Poly> = chi.iter().map(|c| c.at_second(q)).collect();
            Poly::eigenvalues(&m.map(|f| f.at_second(q)), &chi)
        };
        let values: Vec<Vec<Poly>> = at.iter().map(along).collect();
        roots(chi, choices(&values).iter().map(|lines| Self::through(&at, lines)))
    }
}
