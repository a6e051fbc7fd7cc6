//! The generator of a real number field, and the signs of polynomials at it.

use super::matrix::primitive;
use super::whole::Whole;
use super::{Field, Q, charge, longest, products};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Binary places of the first enclosures of the powers of `α`; they are doubled as long as a sign is not seen.
const FIRST: u64 = 64;
/// With so many places it is asked whether the number is 0.
const DOUBT: u64 = 256;

/// The field `Q(α)`: `α` is the only root in an interval of a monic polynomial with integer coefficients.
#[derive(Debug)]
pub struct Generator {
    /// The polynomial, lowest coefficient first.
    pub polynomial: Vec<BigInt>,
    /// The field, with the interval.
    pub field: Field,
    /// By binary places `b`: `2^b α^k`, rounded down and up.
    powers: RefCell<BTreeMap<u64, Rc<Vec<[BigInt; 2]>>>>,
}

/// `Σ c_k x^k q^(d - k)` for `x/q`, `d` the degree: the sign is that of the polynomial.
fn at(polynomial: &[BigInt], x: &BigInt, q: &BigInt) -> BigInt {
    let mut scale = BigInt::one();
    polynomial.iter().rev().fold(BigInt::zero(), |sum, c| {
        let next = sum * x + c * &scale;
        scale *= q;
        next
    })
}

/// The greatest common divisor of two polynomials, up to a factor.
fn common(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let trimmed = |mut p: Vec<BigInt>| {
        while p.last().is_some_and(Zero::is_zero) {
            p.pop();
        }
        primitive(p)
    };
    let (mut a, mut b) = (trimmed(a.to_vec()), trimmed(b.to_vec()));
    while !b.is_empty() {
        while a.len() >= b.len() {
            let (lead, shift) = (a[a.len() - 1].clone(), a.len() - b.len());
            charge(2 * a.len(), longest(&a) + longest(&b));
            a.iter_mut().for_each(|x| *x *= &b[b.len() - 1]);
            b.iter().enumerate().for_each(|(k, c)| a[k + shift] -= &lead * c);
            a = trimmed(a);
        }
        std::mem::swap(&mut a, &mut b);
    }
    a
}

impl Generator {
    /// The field of the only root in the interval of the field.
    pub fn new(polynomial: Vec<BigInt>, field: Field) -> Self {
        Self { polynomial, field, powers: RefCell::default() }
    }

    /// Whether a polynomial vanishes at `α`.
    fn vanishes(&self, p: &[BigInt]) -> bool {
        let divisor = common(&self.polynomial, p);
        let sign = |x: &Q| at(&divisor, x.numer(), x.denom()).sgn();
        sign(&self.field.interval[0]) * sign(&self.field.interval[1]) < 0
    }

    /// The integer below `2^places α`, and the one above.
    fn enclosure(&self, places: u64) -> [BigInt; 2] {
        let [low, high] = &self.field.interval;
        let scale = BigInt::one() << places;
        let scaled = |x: &Q| x.numer() * &scale;
        let (mut lo, mut hi) = (scaled(low).div_floor(low.denom()), scaled(high).div_ceil(high.denom()));
        let below = at(&self.polynomial, low.numer(), low.denom()).sgn();
        while &hi - &lo > BigInt::one() {
            let middle: BigInt = (&lo + &hi) >> 1;
            if !charge(2 * self.polynomial.len(), places * self.polynomial.len() as u64) {
                break;
            }
            // Outside of the interval the polynomial may have other signs.
            let sign = if &middle * low.denom() <= scaled(low) {
                below
            } else if &middle * high.denom() >= scaled(high) {
                -below
            } else {
                at(&self.polynomial, &middle, &scale).sgn()
            };
            if sign == 0 {
                return [middle.clone(), middle];
            }
            if sign == below { lo = middle } else { hi = middle }
        }
        [lo, hi]
    }

    fn powers(&self, places: u64) -> Rc<Vec<[BigInt; 2]>> {
        if let Some(known) = self.powers.borrow().get(&places) {
            return Rc::clone(known);
        }
        let root = self.enclosure(places);
        let mut all = vec![[BigInt::one() << places, BigInt::one() << places]];
        for k in 1..self.polynomial.len() - 1 {
            let [lo, hi] = products(&all[k - 1], &root);
            // A shift to the right rounds down, also of negative numbers.
            all.push([lo >> places, -(-hi >> places)]);
        }
        let all = Rc::new(all);
        self.powers.borrow_mut().insert(places, Rc::clone(&all));
        all
    }

    /// Bounds of `2^places` times the value of a polynomial of lower degree.
    pub fn value(&self, p: &[BigInt], places: u64) -> [BigInt; 2] {
        charge(2 * p.len(), longest(p) + places);
        let mut sum = [BigInt::zero(), BigInt::zero()];
        for (c, [lo, hi]) in p.iter().zip(self.powers(places).iter()) {
            let (lo, hi) = if c.is_negative() { (hi, lo) } else { (lo, hi) };
            sum[0] += c * lo;
            sum[1] += c * hi;
        }
        sum
    }

    /// The sign of the value of a polynomial of lower degree.
    pub fn sign(&self, p: &[BigInt]) -> i32 {
        let mut places = FIRST;
        loop {
            let [lo, hi] = self.value(p, places);
            if lo.is_positive() {
                return 1;
            }
            if hi.is_negative() {
                return -1;
            }
            // With an empty budget nothing is accepted.
            if places == DOUBT && self.vanishes(p) || !charge(1, places) {
                return 0;
            }
            places *= 2;
        }
    }
}
