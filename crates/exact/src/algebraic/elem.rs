use super::root::{Root, roots};
use crate::arith::{Integer, Interval, Natural, Rational, sign};
use crate::linalg::Matrix;
use crate::linalg::dependency::combination;
use crate::poly::{IntPoly, Poly, ints};
use malachite_base::num::arithmetic::traits::SubMulAssign;
use std::cmp::Ordering;

/// Up to this degree inverses come from Euclid's algorithm, above it from a linear system modulo primes.
const EUCLID: usize = 6;

/// An element of `Q[x] / (f)`, as a polynomial of smaller degree than the monic irreducible `f`.
///
/// The element does not know `f`; the operations that need it take it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Elem(pub Poly);

impl Elem {
    /// A rational number.
    #[must_use]
    pub fn from_rational(q: &Rational) -> Self {
        Self(Poly::constant(q.clone()))
    }

    /// The class of `x`.
    #[must_use]
    pub fn generator(f: &Poly) -> Self {
        Self(Poly::new(vec![0.into(), 1.into()]).div_rem(f).1)
    }

    /// The class of a polynomial.
    #[must_use]
    pub fn reduced(p: &Poly, f: &Poly) -> Self {
        Self(p.div_rem(f).1)
    }

    /// The element 0.
    #[must_use]
    pub fn zero() -> Self {
        Self(Poly::zero())
    }

    /// Whether this is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// The value, when it is rational.
    #[must_use]
    pub fn is_rational(&self) -> Option<Rational> {
        match self.0.coeffs() {
            [] => Some(Rational::from(0)),
            [c] => Some(c.clone()),
            _ => None,
        }
    }

    /// `self + other`.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        Self(&self.0 + &other.0)
    }

    /// `self - other`.
    #[must_use]
    pub fn sub(&self, other: &Self) -> Self {
        Self(&self.0 - &other.0)
    }

    /// `-self`.
    #[must_use]
    pub fn neg(&self) -> Self {
        Self(-&self.0)
    }

    /// `self * other`.
    #[must_use]
    pub fn mul(&self, other: &Self, f: &Poly) -> Self {
        match (self.0.coeffs(), other.0.coeffs()) {
            ([], _) | (_, []) => Self::zero(),
            ([c], _) => other.scale(c),
            (_, [c]) => self.scale(c),
            (a, b) => Self::integral_product(a, b, f),
        }
    }

    /// The product with one denominator for each factor, so that there is one reduction to lowest terms for each coefficient.
    fn integral_product(a: &[Rational], b: &[Rational], f: &Poly) -> Self {
        let cleared = |p: &[Rational]| -> (IntPoly, Natural) {
            let d = ints::common_denominator(p);
            (p.iter().map(|c| ints::cleared(c, &d)).collect(), d)
        };
        let ((a, da), (b, db), (modulus, lead)) = (cleared(a), cleared(b), cleared(f.coeffs()));
        let n = modulus.len() - 1;
        let mut product = ints::mul(&a, &b);
        let mut denominator = Integer::from(da * db);
        let lead = Integer::from(lead);
        while product.len() > n {
            let top = product.pop().expect("more than n coefficients");
            if top == 0 {
                continue;
            }
            if lead != 1 {
                product.iter_mut().for_each(|c| *c *= &lead);
                denominator *= &lead;
            }
            let base = product.len() - n;
            for (c, m) in product[base..].iter_mut().zip(&modulus) {
                c.sub_mul_assign(&top, m);
            }
        }
        let rational = |c: &Integer| Rational::from_integers_ref(c, &denominator);
        Self(Poly::new(product.iter().map(rational).collect()))
    }

    /// `1 / self`, or `None` for 0.
    #[must_use]
    pub fn inv(&self, f: &Poly) -> Option<Self> {
        if let Some(q) = self.is_rational() {
            return (q != 0).then(|| Self::from_rational(&(Rational::from(1) / q)));
        }
        let n = f.degree()?;
        if n <= EUCLID {
            return self.inverse_by_euclid(f);
        }
        // The combination of self, self x, self x², … that is 1.
        let x = Self::generator(f);
        let coordinates = |e: &Self| (0..n).map(|k| e.0.coeff(k)).collect::<Vec<_>>();
        let columns: Vec<Vec<Rational>> = std::iter::successors(Some(self.clone()), |e| Some(e.mul(&x, f)))
            .take(n)
            .map(|e| coordinates(&e))
            .collect();
        combination(&columns, &coordinates(&Self::from_rational(&Rational::from(1)))).map(|c| Self(Poly::new(c)))
    }

    fn inverse_by_euclid(&self, f: &Poly) -> Option<Self> {
        let (mut r0, mut r1) = (f.clone(), self.0.clone());
        let (mut t0, mut t1) = (Poly::zero(), Poly::constant(Rational::from(1)));
        while r1.degree() > Some(0) {
            let (q, r) = r0.div_rem(&r1);
            let t = &t0 - &(&q * &t1);
            (r0, r1, t0, t1) = (r1, r, t1, t);
        }
        let unit = r1.leading()?.clone();
        Some(Self::reduced(&t1.scale(&(Rational::from(1) / unit)), f))
    }

    /// `factor * self`.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        Self(self.0.scale(factor))
    }

    /// Enclosures of the real and imaginary part of the value at a root, of width at most `2^-bits`.
    #[must_use]
    pub fn enclosure(&self, root: &Root, bits: u64) -> (Interval, Interval) {
        let zero = || Interval::point(Rational::from(0));
        if let Some(q) = self.is_rational() {
            return (Interval::point(q), zero());
        }
        if let Some(x) = root.rational() {
            return (Interval::point(self.0.eval(&x)), zero());
        }
        let goal = Rational::from(1) >> bits;
        let mut working = bits + 16;
        loop {
            let (x, y) = root.enclosure(working);
            let (x, y) = (x.outward(working + 8), y.outward(working + 8));
            let (mut re, mut im) = (zero(), zero());
            for c in self.0.coeffs().iter().rev() {
                let next = &(&re * &x) - &(&im * &y);
                im = (&(&re * &y) + &(&im * &x)).outward(working + 8);
                re = (&next + &Interval::point(c.clone())).outward(working + 8);
            }
            if root.is_real() {
                im = zero();
            }
            if re.width() <= goal && im.width() <= goal {
                return (re, im);
            }
            working *= 2;
        }
    }

    /// The sign of the value at a real root, exactly; 0 only for the element 0.
    #[must_use]
    pub fn sign(&self, root: &Root) -> i32 {
        if let Some(q) = self.is_rational() {
            return sign(&q);
        }
        if let Some(x) = root.rational() {
            return sign(&self.0.eval(&x));
        }
        (0..).find_map(|k| self.enclosure(root, 32 << k).0.sign()).unwrap_or(0)
    }

    /// The monic minimal polynomial over the rationals.
    ///
    /// # Cost
    /// An elimination of size `deg f`.
    #[must_use]
    pub fn minpoly(&self, f: &Poly) -> Poly {
        if let Some(q) = self.is_rational() {
            return Poly::linear(&q);
        }
        let n = f.degree().unwrap_or(1);
        let mut columns: Vec<Vec<Rational>> = Vec::new();
        let mut power = Self::from_rational(&Rational::from(1));
        for _ in 0..=n {
            columns.push((0..n).map(|k| power.0.coeff(k)).collect());
            power = power.mul(self, f);
        }
        let kernel = Matrix::from_columns(n, &columns).kernel();
        // The first dependency among the powers is the first column of the kernel basis.
        Poly::new(kernel.column(0)).monic()
    }

    /// Text such as `2/3t^2 - 1`.
    #[must_use]
    pub fn display(&self, var: &str) -> String {
        self.0.display(var)
    }
}

/// The value of `elem` at `root`, as a root of its own minimal polynomial.
///
/// # Cost
/// One minimal polynomial, its roots, and enclosures until only one of them is near.
#[must_use]
pub fn locate(elem: &Elem, root: &Root) -> Root {
    let reduced = match root.rational() {
        Some(x) => Elem::from_rational(&elem.0.eval(&x)),
        None => elem.clone(),
    };
    if let Some(q) = reduced.is_rational() {
        return Root::from_rational(&q);
    }
    let candidates = roots(&reduced.minpoly(root.minpoly()));
    let mut bits = 64;
    loop {
        let (re, im) = reduced.enclosure(root, bits);
        let near = |c: &&Root| {
            let (a, b) = c.enclosure(bits);
            !a.disjoint(&re) && !b.disjoint(&im)
        };
        let mut hits = candidates.iter().filter(near);
        if let (Some(only), None) = (hits.next(), hits.next()) {
            return only.clone();
        }
        bits *= 2;
    }
}

/// Whether a real root is the point, where both ends are one, or lies in the open interval between them.
///
/// # Panics
/// If one of them is not real.
///
/// # Examples
/// ```
/// use secant_exact::{algebraic::{Root, lies_within}, arith::ratio};
/// let at = |p, q| Root::from_rational(&ratio(p, q));
/// assert!(lies_within(&at(1, 2), &at(0, 1), &at(1, 1)) && lies_within(&at(1, 1), &at(1, 1), &at(1, 1)));
/// assert!(!lies_within(&at(0, 1), &at(0, 1), &at(1, 1)));
/// ```
#[must_use]
pub fn lies_within(p: &Root, from: &Root, to: &Root) -> bool {
    if from.same(to) { from.same(p) } else { cmp_real(from, p).is_lt() && cmp_real(p, to).is_lt() }
}

/// The order of two real roots, exactly.
///
/// # Panics
/// If one of them is not real.
#[must_use]
pub fn cmp_real(a: &Root, b: &Root) -> Ordering {
    assert!(a.is_real() && b.is_real(), "real numbers");
    if a.same(b) {
        return Ordering::Equal;
    }
    let mut bits = 64;
    loop {
        let (x, y) = (a.enclosure(bits).0, b.enclosure(bits).0);
        if x.disjoint(&y) {
            return x.lo.cmp(&y.lo);
        }
        if a.degree() == 1 && b.degree() == 1 {
            return x.lo.cmp(&y.lo);
        }
        bits *= 2;
    }
}
