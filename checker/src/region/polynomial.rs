//! Polynomials in the parameter: values, real roots in intervals (Sturm), and stability of matrices.

use crate::base::{
    Checked, Matrix, Node, Q, need,
    number::{bits, gcd, longest, whole},
    spend,
};
use crate::claim::Real;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Coefficients, lowest first, without zeros behind; none for 0.
pub type Poly = Vec<Q>;

/// Highest degree of a polynomial whose roots are counted.
const MAX_DEGREE: usize = 400;

pub fn trimmed(mut f: Poly) -> Poly {
    while f.last().is_some_and(Zero::is_zero) {
        f.pop();
    }
    f
}

pub fn value(f: &[Q], x: &Q) -> Q {
    f.iter().rev().fold(Q::zero(), |v, c| v * x + c)
}

pub fn minus(a: &[Q], b: &[Q]) -> Poly {
    let mut difference = vec![Q::zero(); a.len().max(b.len())];
    a.iter().enumerate().for_each(|(k, c)| difference[k] += c);
    b.iter().enumerate().for_each(|(k, c)| difference[k] -= c);
    trimmed(difference)
}

/// The numbers 0, −1, 1, −2, 2, …, at which polynomials are evaluated.
pub fn places(count: usize) -> Vec<Q> {
    (0..count as i64).map(|k| whole(if k % 2 == 0 { k / 2 } else { -(k + 1) / 2 })).collect()
}

/// The bits of the longest of some numbers, for the budget.
fn most_bits(numbers: &[Q]) -> u64 {
    numbers.iter().map(bits).fold(1, u64::max)
}

/// The polynomial of least degree with these values (Newton).
pub fn through(at: &[Q], mut values: Vec<Q>) -> Checked<Poly> {
    for step in 1..at.len() {
        for k in (step..at.len()).rev() {
            values[k] = (&values[k] - &values[k - 1]) / (&at[k] - &at[k - step]);
        }
        spend(at.len() - step, most_bits(&values))?;
    }
    let mut f: Poly = Vec::new();
    for k in (0..at.len()).rev() {
        // f (x − at) + value
        let mut next = vec![Q::zero(); f.len() + 1];
        for (j, c) in f.iter().enumerate() {
            next[j + 1] += c;
            next[j] -= c * &at[k];
        }
        next[0] += &values[k];
        spend(next.len(), most_bits(&next))?;
        f = next;
    }
    Ok(trimmed(f))
}

/// A positive multiple with integers that have no common divisor.
fn integers(f: &[Q]) -> Vec<BigInt> {
    let den = f.iter().fold(BigInt::one(), |d, c| d.lcm(c.denom()));
    without_content(f.iter().map(|c| c.numer() * (&den / c.denom())).collect())
}

fn without_content(mut f: Vec<BigInt>) -> Vec<BigInt> {
    while f.last().is_some_and(Zero::is_zero) {
        f.pop();
    }
    let common = f.iter().fold(BigInt::zero(), |g, c| if g.is_one() { g } else { gcd(&g, c).abs() });
    if !common.is_zero() && !common.is_one() {
        f.iter_mut().for_each(|c| *c /= &common);
    }
    f
}

/// A positive multiple of the remainder of `a` by `b ≠ 0`.
fn remainder(a: &[BigInt], b: &[BigInt]) -> Checked<Vec<BigInt>> {
    let (mut r, lead) = (a.to_vec(), &b[b.len() - 1]);
    let square = lead * lead;
    while r.len() >= b.len() {
        // r times the square of the leading coefficient, less a multiple of b.
        let factor = &r[r.len() - 1] * lead;
        let shift = r.len() - b.len();
        r.iter_mut().for_each(|c| *c *= &square);
        b.iter().enumerate().for_each(|(k, c)| r[shift + k] -= &factor * c);
        spend(2 * r.len(), longest(&r))?;
        r = without_content(r);
    }
    Ok(r)
}

fn common(a: &[BigInt], b: &[BigInt]) -> Checked<Vec<BigInt>> {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        let r = remainder(&a, &b)?;
        (a, b) = (b, r);
    }
    Ok(a)
}

fn rationals(f: &[BigInt]) -> Poly {
    f.iter().map(|c| Q::from(c.clone())).collect()
}

/// The common divisor of two polynomials, up to a factor.
pub fn common_divisor(a: &[Q], b: &[Q]) -> Checked<Poly> {
    Ok(rationals(&common(&integers(a), &integers(b))?))
}

pub fn derivative<T: Clone + std::ops::Mul<BigInt, Output = T>>(f: &[T]) -> Vec<T> {
    f.iter().enumerate().skip(1).map(|(k, c)| c.clone() * BigInt::from(k)).collect()
}

/// `f / g` up to a positive factor or its opposite, where the division has no remainder.
fn quotient(f: &[BigInt], g: &[BigInt]) -> Checked<Vec<BigInt>> {
    let (mut r, mut q) = (rationals(f), Vec::new());
    let g = rationals(g);
    while r.len() >= g.len() {
        let c = &r[r.len() - 1] / &g[g.len() - 1];
        let shift = r.len() - g.len();
        g.iter().enumerate().for_each(|(k, x)| r[shift + k] -= &c * x);
        r.pop();
        q.push(c);
        spend(g.len(), most_bits(&r))?;
    }
    need(r.iter().all(Zero::is_zero), "limit", "a division left a remainder")?;
    q.reverse();
    Ok(integers(&q))
}

/// The number of different roots in `(a, b]` of a polynomial that is not 0 (Sturm, for its square-free part).
pub fn roots(f: &[Q], a: &Q, b: &Q) -> Checked<usize> {
    need(!f.is_empty() && f.len() <= MAX_DEGREE + 1, "limit", "a polynomial that is 0, or of too high a degree")?;
    need(a <= b, "format", "an interval with its ends exchanged")?;
    let f = integers(f);
    let slope = derivative(&f);
    let f = if slope.is_empty() { f } else { quotient(&f, &common(&f, &slope)?)? };
    let mut chain = vec![f.clone(), derivative(&f)];
    while chain[chain.len() - 1].len() > 1 {
        let next = remainder(&chain[chain.len() - 2], &chain[chain.len() - 1])?;
        if next.is_empty() {
            break;
        }
        chain.push(next.into_iter().map(|c| -c).collect());
    }
    let changes = |x: &Q| -> Checked<usize> {
        let (mut count, mut last) = (0, 0);
        for g in chain.iter().filter(|g| !g.is_empty()) {
            let v = value(&rationals(g), x);
            spend(g.len(), bits(&v))?;
            let sign = if v.is_positive() { 1 } else { -i32::from(v.is_negative()) };
            if sign != 0 {
                count += usize::from(last != 0 && sign != last);
                last = sign;
            }
        }
        Ok(count)
    };
    let (low, high) = (changes(a)?, changes(b)?);
    need(low >= high, "limit", "more changes of sign above than below")?;
    Ok(low - high)
}

/// Whether all eigenvalues of a matrix lie in the open unit disc (Schur, Cohn, Jury).
pub fn is_stable(m: &Matrix) -> Checked<bool> {
    let chi = m.characteristic()?;
    let mut p: Vec<Q> = (0..chi.cols).map(|k| chi.at(0, k)).collect();
    while p.len() > 1 {
        let n = p.len() - 1;
        if p[0].abs() >= p[n].abs() {
            return Ok(false);
        }
        let ratio = &p[0] / &p[n];
        p = (1..=n).map(|k| &p[k] - &ratio * &p[n - k]).collect();
        spend(p.len(), most_bits(&p))?;
    }
    Ok(true)
}

/// A real number: the only root of a polynomial in an interval, or a rational.
pub struct End {
    polynomial: Poly,
    pub lo: Q,
    pub hi: Q,
}

impl End {
    /// `{"polynomial", "interval"}`.
    pub fn read(node: &Node<'_>) -> Checked<Self> {
        let [polynomial, interval] = node.fields("polynomial interval")?;
        let polynomial = polynomial.each(Node::rational)?;
        let ends = interval.vector(2)?;
        let (lo, hi) = (ends[0].clone(), ends[1].clone());
        let monic = polynomial.last().is_some_and(One::is_one) && (2..=MAX_DEGREE).contains(&polynomial.len());
        node.need(monic, "end", "a monic polynomial of degree 1 at least is needed")?;
        let (low, high) = (value(&polynomial, &lo), value(&polynomial, &hi));
        let single = if polynomial.len() == 2 {
            lo == hi && low.is_zero()
        } else {
            lo < hi && (low * high).is_negative() && roots(&polynomial, &lo, &hi)? == 1
        };
        node.need(single, "end", "the interval does not hold exactly one root")?;
        Ok(Self { polynomial, lo, hi })
    }

    pub fn rational(q: &Q) -> Self {
        Self { polynomial: vec![-q, Q::one()], lo: q.clone(), hi: q.clone() }
    }

    pub fn real(&self) -> Real {
        Real { polynomial: self.polynomial.clone(), interval: [self.lo.clone(), self.hi.clone()] }
    }

    pub fn is_rational(&self) -> bool {
        self.lo == self.hi
    }

    pub fn is(&self, other: &Self) -> bool {
        self.polynomial == other.polynomial && self.lo == other.lo && self.hi == other.hi
    }

    /// Whether a polynomial that is not 0 vanishes there.
    pub fn is_root_of(&self, f: &[Q]) -> Checked<bool> {
        if self.is_rational() {
            return Ok(value(f, &self.lo).is_zero());
        }
        let g = common_divisor(f, &self.polynomial)?;
        Ok(g.len() > 1 && roots(&g, &self.lo, &self.hi)? == 1)
    }

    /// Whether a polynomial that is not 0 is seen to have no root there, nor near it.
    pub fn is_far_from(&self, f: &[Q]) -> Checked<bool> {
        Ok(!value(f, &self.lo).is_zero() && (self.is_rational() || roots(f, &self.lo, &self.hi)? == 0))
    }
}

/// Whether a polynomial that is not 0 has no root strictly between two ends.
pub fn is_free(f: &[Q], from: &End, to: &End) -> Checked<bool> {
    let first = !from.is_rational() && from.is_root_of(f)?;
    let own = usize::from(first) + usize::from(to.is_root_of(f)?);
    Ok(roots(f, &from.lo, &to.hi)? == own)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly(c: &[i64]) -> Poly {
        c.iter().map(|x| whole(*x)).collect()
    }

    #[test]
    fn roots_are_counted_once() {
        crate::base::number::refill();
        // (x² − 2)² (x − 1) (x + 3)
        let f = [poly(&[-2, 0, 1]), poly(&[-2, 0, 1]), poly(&[-1, 1]), poly(&[3, 1])];
        let product = f.iter().fold(poly(&[1]), |p, g| {
            let mut out = vec![Q::zero(); p.len() + g.len() - 1];
            p.iter().enumerate().for_each(|(i, a)| g.iter().enumerate().for_each(|(j, b)| out[i + j] += a * b));
            out
        });
        let count = |a: i64, b: i64| roots(&product, &whole(a), &whole(b)).unwrap();
        assert_eq!((count(-4, 4), count(-3, 1), count(1, 2), count(-4, -3), count(2, 9)), (4, 2, 1, 1, 0));
        let root = End { polynomial: poly(&[-2, 0, 1]), lo: whole(1), hi: whole(2) };
        assert!(root.is_root_of(&product).unwrap() && !root.is_root_of(&poly(&[-1, 1])).unwrap());
        assert!(is_free(&product, &End::rational(&whole(1)), &root).unwrap());
        assert!(!is_free(&product, &End::rational(&whole(0)), &root).unwrap());
        assert!(is_free(&product, &root, &End::rational(&whole(5))).unwrap());
    }

    #[test]
    fn a_polynomial_through_points() {
        crate::base::number::refill();
        let (at, f) = (places(6), poly(&[3, -1, 0, 2]));
        assert_eq!(at, [0, -1, 1, -2, 2, -3].map(whole));
        assert_eq!(through(&at, at.iter().map(|x| value(&f, x)).collect()).unwrap(), f);
    }
}
