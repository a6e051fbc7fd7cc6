//! Intervals of fixed-point numbers: sums and products without a common divisor at every step.

use crate::arith::{Integer, Interval, Rational, abs};
use crate::linalg::{Entry, Matrix};
use malachite_base::num::arithmetic::traits::{Ceiling, DivRound, Floor, Lcm};
use malachite_base::num::basic::traits::One;
use malachite_base::rounding_modes::RoundingMode::{Ceiling as Up, Floor as Down};
use malachite_nz::natural::Natural;

/// Binary places.
pub(super) const PLACES: u64 = 192;
/// Binary places of coefficients.
pub(super) const COEFFICIENT: u64 = 50;

/// `[lo, hi] 2^-PLACES`.
#[derive(Debug, Clone)]
pub(super) struct Fixed {
    pub lo: Integer,
    pub hi: Integer,
}

impl Fixed {
    pub fn of(x: &Interval) -> Self {
        let scale = Rational::from(Integer::ONE << PLACES);
        Self { lo: (&x.lo * &scale).floor(), hi: (&x.hi * &scale).ceiling() }
    }

    pub fn point(x: &Rational) -> Self {
        Self::of(&Interval::point(x.clone()))
    }

    pub fn zero() -> Self {
        Self { lo: Integer::from(0), hi: Integer::from(0) }
    }

    fn add_times(&mut self, x: &Self, factor: &Integer) {
        let (a, b) = if *factor >= 0 { (&x.lo, &x.hi) } else { (&x.hi, &x.lo) };
        self.lo += a * factor;
        self.hi += b * factor;
    }

    /// The same with a factor that lies between two whole numbers.
    fn add_between(&mut self, x: &Self, (from, to): (&Integer, &Integer)) {
        if from == to {
            return self.add_times(x, from);
        }
        let ends = [&x.lo * from, &x.lo * to, &x.hi * from, &x.hi * to];
        let least = ends.iter().min().expect("four products");
        let most = ends.iter().max().expect("four products");
        self.lo += least;
        self.hi += most;
    }

    /// The largest absolute value, in units of `2^-PLACES`.
    pub fn magnitude(&self) -> Integer {
        let size = |x: &Integer| if *x < 0 { -x } else { x.clone() };
        size(&self.lo).max(size(&self.hi))
    }
}

/// A matrix with whole entries over one denominator, or with entries between such, divided by a radius.
pub(super) struct Scaled {
    rows: Vec<Vec<(Integer, Integer)>>,
    denominator: Integer,
    /// `2^PLACES / radius`, below and above.
    inverse: (Integer, Integer),
}

impl Scaled {
    /// `None` where the enclosure of the radius holds 0.
    pub fn new<E: Entry>(m: &Matrix<E>, radius: &Interval) -> Option<Self> {
        if radius.lo <= 0 {
            return None;
        }
        let own: Option<Vec<Rational>> = m.entries().iter().map(E::rational).collect();
        let denominator = match own {
            Some(entries) => entries.iter().fold(Natural::ONE, |d, x| d.lcm(x.denominator_ref())),
            None => Natural::ONE << (PLACES + COEFFICIENT),
        };
        let whole = Rational::from(denominator.clone());
        let between = |x: &E| {
            let x = x.enclosure(PLACES + COEFFICIENT);
            ((x.lo * &whole).floor(), (x.hi * &whole).ceiling())
        };
        let row = |i: usize| m.row(i).iter().map(between).collect();
        let scale = Rational::from(Integer::ONE << PLACES);
        let inverse = ((&scale / &radius.hi).floor(), (&scale / &radius.lo).ceiling());
        Some(Self { rows: (0..m.rows()).map(row).collect(), denominator: Integer::from(denominator), inverse })
    }

    /// An enclosure of `T x / radius`.
    pub fn image(&self, x: &[Fixed]) -> Vec<Fixed> {
        let entry = |row: &Vec<(Integer, Integer)>| {
            let mut sum = Fixed::zero();
            let used = row.iter().zip(x).filter(|((from, to), _)| *from != 0 || *to != 0);
            used.for_each(|((from, to), v)| sum.add_between(v, (from, to)));
            let by = |x: &Integer, up: bool| {
                // The smaller factor below for positive numbers, above for negative ones.
                let factor = if (*x >= 0) == up { &self.inverse.1 } else { &self.inverse.0 };
                let divisor = &self.denominator << PLACES;
                (x * factor).div_round(divisor, if up { Up } else { Down }).0
            };
            Fixed { lo: by(&sum.lo, false), hi: by(&sum.hi, true) }
        };
        self.rows.iter().map(entry).collect()
    }
}

/// A coefficient in units of `2^-COEFFICIENT`; `None` where it is not on that grid.
pub(super) fn coefficient(c: &Rational) -> Option<Integer> {
    Integer::try_from(c * Rational::from(Integer::ONE << COEFFICIENT)).ok()
}

/// An upper bound of `‖x − Σ c q‖_1`, coefficients in units of `2^-COEFFICIENT`.
pub(super) fn distance(x: &[Fixed], terms: &[(usize, Integer)], points: &[Vec<Fixed>]) -> Rational {
    let widened = |v: &Fixed| Fixed { lo: &v.lo << COEFFICIENT, hi: &v.hi << COEFFICIENT };
    let mut rest: Vec<Fixed> = x.iter().map(widened).collect();
    for (k, c) in terms {
        let negative = -c;
        rest.iter_mut().zip(&points[*k]).for_each(|(r, q)| r.add_times(q, &negative));
    }
    let sum = rest.iter().fold(Integer::from(0), |s, r| s + r.magnitude());
    Rational::from(sum) / Rational::from(Integer::ONE << (PLACES + COEFFICIENT))
}

/// `Σ |c|`.
pub(super) fn total(terms: &[(usize, Rational)]) -> Rational {
    terms.iter().fold(Rational::from(0), |s, t| s + abs(&t.1))
}
