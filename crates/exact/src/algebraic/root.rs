use super::ball::Ball;
use super::isolate::{isolate, refine};
use super::modulus;
use super::real::{Cell, isolate_real};
use super::relation;
use crate::arith::{Integer, Interval, Rational, sign, to_f64};
use crate::poly::{IntPoly, Poly, ints};
use std::cmp::Ordering;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

/// All roots of one irreducible polynomial, shared by the [`Root`]s.
///
/// Everything is done for `local(x) = f(x + centre)`: a polynomial with small roots, where those of `f` are close
/// together and far from 0.
pub(super) struct RootSet {
    pub poly: Poly,
    pub ints: IntPoly,
    centre: Integer,
    local: IntPoly,
    /// The number of real roots.
    pub real: usize,
    /// The real roots one by one, where the others were not asked for at first; empty otherwise.
    cells: Vec<Mutex<Cell>>,
    all: OnceLock<Discs>,
    pub bases: OnceLock<modulus::Bases>,
}

/// Isolating discs of all roots, in canonical order, and refined ones inside them.
struct Discs {
    discs: Vec<Ball>,
    refined: Vec<Mutex<Ball>>,
}

/// A root of an irreducible polynomial over the rationals, with an isolating enclosure that refines on demand.
///
/// Cheap to clone. Roots are numbered in canonical order: the real ones ascending, then the complex ones by real
/// part, then by imaginary part of the pair, the one in the upper half plane before its conjugate.
#[derive(Clone)]
pub struct Root {
    pub(super) set: Arc<RootSet>,
    pub(super) index: usize,
}

/// All roots of an irreducible polynomial, in canonical order.
///
/// # Panics
/// If the polynomial is constant. An input with repeated roots makes the isolation search endlessly.
///
/// # Cost
/// About `degree^2` multiplications of 64 to 128 bits per sweep of the iteration, for roots that are not clustered.
///
/// Source: Bini, *Numerical computation of polynomial zeros by means of Aberth's method*, for the proposals; the
/// enclosures are proved as described in the module.
///
/// # Examples
/// ```
/// use secant_exact::{algebraic::roots, arith::ratio, poly::Poly};
/// let f = Poly::new([1, 1, 1].map(|c| ratio(c, 1)).to_vec()); // x² + x + 1
/// let found = roots(&f);
/// assert_eq!(found.len(), 2);
/// assert!(found.iter().all(|r| !r.is_real() && r.cmp_modulus_rational(&ratio(1, 1)).is_eq()));
/// ```
#[must_use]
pub fn roots(minpoly: &Poly) -> Vec<Root> {
    let set = Arc::new(RootSet::new(&minpoly.monic()));
    (0..set.poly.degree().unwrap_or(0)).map(|index| Root { set: Arc::clone(&set), index }).collect()
}

/// The real roots of an irreducible polynomial, ascending. The complex ones are not isolated before they are needed.
///
/// # Panics
/// If the polynomial is constant.
///
/// # Cost
/// Descartes' rule of signs on intervals that are halved until each has one root.
///
/// ```
/// use secant_exact::{algebraic::real_roots, arith::ratio, poly::Poly};
///
/// let f = Poly::new(vec![ratio(-2, 1), ratio(0, 1), ratio(0, 1), ratio(1, 1)]); // x³ − 2
/// let roots = real_roots(&f);
/// assert_eq!(roots.len(), 1);
/// assert!(roots[0].sign() > 0 && roots[0].enclosure(100).0.hi < ratio(1_259_922, 1_000_000));
/// ```
#[must_use]
pub fn real_roots(minpoly: &Poly) -> Vec<Root> {
    let set = Arc::new(RootSet::real_only(&minpoly.monic()));
    (0..set.real).map(|index| Root { set: Arc::clone(&set), index }).collect()
}

/// The different positive roots of any polynomial, ascending; none for the zero polynomial.
///
/// # Cost
/// A factorisation; only real roots are isolated.
///
/// ```
/// use secant_exact::{algebraic::positive_roots, arith::ratio, poly::Poly};
///
/// let f = Poly::new([-1, -1, 0, 1].map(|c| ratio(c, 1)).to_vec()); // x³ − x − 1
/// let rho = positive_roots(&f).pop().expect("one sign change");
/// assert_eq!(format!("{:.4}", rho.to_f64().0), "1.3247");
/// ```
#[must_use]
pub fn positive_roots(f: &Poly) -> Vec<Root> {
    let mut found: Vec<Root> =
        crate::poly::factor(f).iter().flat_map(|(g, _)| real_roots(g)).filter(|r| r.sign() > 0).collect();
    found.sort_by(super::cmp_real);
    found
}

impl RootSet {
    fn prepared(poly: &Poly) -> Self {
        let f = poly.primitive();
        assert!(f.len() > 1, "a polynomial of positive degree");
        let centre = ints::far_centre(&f);
        let local = if centre == 0 { f.clone() } else { ints::taylor_shift(&f, &centre) };
        let (cells, all, bases) = (Vec::new(), OnceLock::new(), OnceLock::new());
        Self { poly: poly.clone(), ints: f, centre, local, real: 1, cells, all, bases }
    }

    fn new(poly: &Poly) -> Self {
        let mut set = Self::prepared(poly);
        if set.ints.len() > 2 {
            let (discs, real) = Discs::of(&set.local);
            set.real = real;
            set.all = OnceLock::from(discs);
        }
        set
    }

    fn real_only(poly: &Poly) -> Self {
        let mut set = Self::prepared(poly);
        if set.ints.len() > 2 {
            set.cells = isolate_real(&set.local).into_iter().map(Mutex::new).collect();
            set.real = set.cells.len();
        }
        set
    }

    fn all(&self) -> &Discs {
        self.all.get_or_init(|| Discs::of(&self.local).0)
    }

    /// The isolating disc of a root, around its distance from the centre: no other root lies in the disc of
    /// [`super::isolate::GUARD`] times its radius. Not for degree 1.
    pub fn isolating(&self, index: usize) -> &Ball {
        &self.all().discs[index]
    }

    /// The binary logarithm, rounded up, of the size of a root; of its distance from the centre where there is one.
    pub fn log_size(&self, index: usize) -> i64 {
        if self.ints.len() == 2 {
            return 0;
        }
        match self.cells.get(index) {
            Some(cell) => locked(cell).ball().log_size(),
            None => self.isolating(index).log_size(),
        }
    }

    /// The disc of a root with radius at most `2^t`.
    pub fn disc(&self, index: usize, t: i64) -> Ball {
        self.local_disc(index, t).moved(&self.centre)
    }

    fn local_disc(&self, index: usize, t: i64) -> Ball {
        if let Some(cell) = self.cells.get(index) {
            let mut cell = locked(cell);
            cell.refine(&self.local, t);
            return cell.ball();
        }
        // The lower half plane mirrors the upper one, so that conjugates have conjugate enclosures.
        if index >= self.real && (index - self.real) % 2 == 1 {
            return self.local_disc(index - 1, t).conjugate();
        }
        let all = self.all();
        let mut disc = locked(&all.refined[index]);
        if !disc.is_within(t) {
            *disc = refine(&self.local, &all.discs[index], &disc, t);
        }
        disc.clone()
    }
}

fn locked<T>(cell: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    cell.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

impl Discs {
    /// The discs, and how many of the roots are real.
    fn of(f: &[Integer]) -> (Self, usize) {
        let found = isolate(f);
        let real = found.real.len();
        let mut discs = found.real;
        let upper = relation::sorted_by_parts(f, found.upper);
        discs.extend(upper.into_iter().flat_map(|b| [b.clone(), b.conjugate()]));
        let refined = discs.iter().map(|b| Mutex::new(b.clone())).collect();
        (Self { discs, refined }, real)
    }
}

impl Root {
    /// The root `q` of `x - q`.
    #[must_use]
    pub fn from_rational(q: &Rational) -> Self {
        Self { set: Arc::new(RootSet::new(&Poly::linear(q))), index: 0 }
    }

    /// The minimal polynomial, monic.
    #[must_use]
    pub fn minpoly(&self) -> &Poly {
        &self.set.poly
    }

    /// The degree of the minimal polynomial.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.set.ints.len() - 1
    }

    /// The position in the canonical order of the roots of the minimal polynomial.
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }

    /// Whether the root is real.
    #[must_use]
    pub fn is_real(&self) -> bool {
        self.index < self.set.real
    }

    /// The value, when it is rational.
    #[must_use]
    pub fn rational(&self) -> Option<Rational> {
        (self.degree() == 1).then(|| -self.set.poly.coeff(0))
    }

    /// Whether the root is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.degree() == 1 && self.set.ints[0] == 0
    }

    /// Enclosures of the real and the imaginary part, of width at most `2^-bits`; the second is `[0, 0]` for a real root.
    #[must_use]
    pub fn enclosure(&self, bits: u64) -> (Interval, Interval) {
        match self.rational() {
            Some(q) => (Interval::point(q), Interval::point(Rational::from(0))),
            None => self.disc(-(bits as i64) - 1).enclosure(),
        }
    }

    pub(super) fn disc(&self, t: i64) -> Ball {
        self.set.disc(self.index, t)
    }

    /// The complex conjugate; the root itself when it is real.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        let real = self.set.real;
        let index = if self.is_real() { self.index } else { real + ((self.index - real) ^ 1) };
        Self { set: Arc::clone(&self.set), index }
    }

    /// The sign of a real root; 0 for 0 and for every root that is not real.
    #[must_use]
    pub fn sign(&self) -> i32 {
        if !self.is_real() {
            return 0;
        }
        if let Some(q) = self.rational() {
            return sign(&q);
        }
        (1..).find_map(|k| self.enclosure(32 * k).0.sign()).unwrap_or(0)
    }

    /// Whether the two numbers are equal.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        self.index == other.index && (Arc::ptr_eq(&self.set, &other.set) || self.set.poly == other.set.poly)
    }

    /// The order of the absolute values, exactly.
    ///
    /// # Cost
    /// Numerical separation first; what does not separate is decided by an algebraic relation (see
    /// [`Root::cmp_modulus_rational`] and the module), in the last resort by the polynomial of the products of two roots.
    ///
    /// # Examples
    /// ```
    /// use secant_exact::{algebraic::roots, arith::ratio, poly::Poly};
    /// let golden = roots(&Poly::new([-1, -1, 1].map(|c| ratio(c, 1)).to_vec()));
    /// assert!(golden[0].cmp_modulus(&golden[1]).is_ne());
    /// ```
    #[must_use]
    pub fn cmp_modulus(&self, other: &Self) -> Ordering {
        modulus::compare(self, other)
    }

    /// The order of the absolute value and a rational, exactly.
    #[must_use]
    pub fn cmp_modulus_rational(&self, q: &Rational) -> Ordering {
        if *q < 0 { Ordering::Greater } else { modulus::compare(self, &Self::from_rational(q)) }
    }

    /// An enclosure of the absolute value, of width at most `2^-bits`.
    #[must_use]
    pub fn modulus(&self, bits: u64) -> Interval {
        modulus::enclosure(self, bits)
    }

    /// The nearest pair of doubles, roughly: for display and for proposals.
    #[must_use]
    pub fn to_f64(&self) -> (f64, f64) {
        if let Some(q) = self.rational() {
            return (to_f64(&q), 0.0);
        }
        let (re, im) = self.disc(self.set.log_size(self.index) - 60).enclosure();
        (to_f64(&re.mid()), to_f64(&im.mid()))
    }

    /// The integer coefficients of the minimal polynomial.
    #[must_use]
    pub fn primitive(&self) -> &[Integer] {
        &self.set.ints
    }

    /// Whether the quotient of the two numbers is a root of unity.
    ///
    /// # Cost
    /// Decides a product polynomial of degree `deg^2` for factors that are not related in an obvious way.
    #[must_use]
    pub fn ratio_is_root_of_unity(&self, other: &Self) -> bool {
        relation::ratio_is_root_of_unity(self, other)
    }
}

impl fmt::Debug for Root {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Root({}, {})", self.set.poly.primitive_display("x"), self.index)
    }
}

impl PartialEq for Root {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

impl Eq for Root {}
