//! Polynomials over the rational numbers, real number fields with a chosen embedding, and interval enclosures.

use crate::json::Node;
use crate::number::{Q, sign, size, spend, whole};
use crate::{Rejected, reject};
use num_traits::{One, Signed, Zero};

/// A polynomial: coefficients from the lowest degree up, the last one not 0; no coefficients for 0.
pub type Poly = Vec<Q>;

/// Reads a polynomial of degree below `bound`.
pub fn read(node: &Node<'_>, bound: usize) -> Result<Poly, Rejected> {
    let items = node.list()?;
    let poly = items.iter().map(Node::rational).collect::<Result<Poly, _>>()?;
    if poly.len() > bound || poly.last().is_some_and(Zero::is_zero) {
        return node.malformed(&format!("a polynomial of degree below {bound} without leading zeros is needed here"));
    }
    Ok(poly)
}

fn trimmed(mut p: Poly) -> Poly {
    while p.last().is_some_and(Zero::is_zero) {
        p.pop();
    }
    p
}

/// `a + factor · b`.
pub fn combine(a: &Poly, factor: &Q, b: &Poly) -> Poly {
    let zero = Q::zero();
    let at = |p: &Poly, k: usize| p.get(k).unwrap_or(&zero).clone();
    trimmed((0..a.len().max(b.len())).map(|k| at(a, k) + factor * at(b, k)).collect())
}

/// A closed interval with rational ends.
#[derive(Debug, Clone)]
pub struct Interval {
    /// Lower end.
    pub lo: Q,
    /// Upper end.
    pub hi: Q,
}

impl Interval {
    /// The interval that holds only `x`.
    pub fn point(x: &Q) -> Self {
        Self { lo: x.clone(), hi: x.clone() }
    }

    /// The common sign of all members, `0` where there is none or it is 0.
    pub fn sign(&self) -> i32 {
        if self.lo.is_positive() { 1 } else { -i32::from(self.hi.is_negative()) }
    }

    /// An interval with all sums.
    pub fn plus(&self, other: &Self) -> Self {
        Self { lo: &self.lo + &other.lo, hi: &self.hi + &other.hi }
    }

    /// An interval with all differences.
    pub fn minus(&self, other: &Self) -> Self {
        Self { lo: &self.lo - &other.hi, hi: &self.hi - &other.lo }
    }

    /// An interval with all products.
    pub fn times(&self, other: &Self) -> Self {
        let ends = [&self.lo * &other.lo, &self.lo * &other.hi, &self.hi * &other.lo, &self.hi * &other.hi];
        let [mut lo, mut hi] = [ends[0].clone(), ends[0].clone()];
        for end in ends {
            if end < lo {
                lo = end.clone();
            }
            if end > hi {
                hi = end;
            }
        }
        Self { lo, hi }
    }

    /// An interval with all multiples by a number.
    pub fn scaled(&self, factor: &Q) -> Self {
        self.times(&Self::point(factor))
    }
}

/// An enclosure of the values of a polynomial on an interval (Horner's scheme).
pub fn values(p: &Poly, x: &Interval) -> Result<Interval, Rejected> {
    spend(4 * p.len() * p.len(), size(p) + size([&x.lo, &x.hi]))?;
    Ok(p.iter().rev().fold(Interval::point(&Q::zero()), |v, c| v.times(x).plus(&Interval::point(c))))
}

/// `Q[x]/(m)` with a real root `θ` of `m`: the only one in `interval`.
#[derive(Debug, Clone)]
pub struct Field {
    /// The polynomial, monic; it need not be irreducible.
    pub m: Poly,
    /// Where `θ` lies.
    pub interval: Interval,
}

impl Field {
    /// Reads `polynomial` and `interval` and checks that there is exactly one root in it.
    pub fn read(polynomial: &Node<'_>, interval: &Node<'_>) -> Result<Self, Rejected> {
        let m = read(polynomial, 65)?;
        if m.len() < 2 || !m[m.len() - 1].is_one() {
            return reject("field", &polynomial.place, "a monic polynomial of degree at least 1 is needed");
        }
        let ends = interval.vector(2)?;
        let interval_of = Interval { lo: ends[0].clone(), hi: ends[1].clone() };
        if m.len() == 2 {
            if ends[0] != ends[1] || ends[0] != -m[0].clone() {
                return reject("field", &interval.place, "both ends must be the rational root");
            }
            return Ok(Self { m, interval: interval_of });
        }
        let at = |x: &Q| values(&m, &Interval::point(x));
        if ends[0] >= ends[1] || sign(&at(&ends[0])?.lo) * sign(&at(&ends[1])?.lo) >= 0 {
            return reject("field", &interval.place, "the polynomial does not change sign on the interval");
        }
        let derivative: Poly = m.iter().enumerate().skip(1).map(|(k, c)| c * whole(k as i64)).collect();
        if values(&derivative, &interval_of)?.sign() == 0 {
            return reject("field", &interval.place, "the interval is too wide to hold one root only");
        }
        Ok(Self { m, interval: interval_of })
    }

    /// The remainder of a polynomial.
    pub fn reduce(&self, mut p: Poly) -> Result<Poly, Rejected> {
        let d = self.m.len() - 1;
        while p.len() > d {
            spend(d, size(&p) + size(&self.m))?;
            let (k, lead) = (p.len() - 1, p[p.len() - 1].clone());
            for (i, c) in self.m.iter().enumerate() {
                p[k - d + i] -= &lead * c;
            }
            p = trimmed(p);
        }
        Ok(p)
    }

    /// The product in the ring.
    pub fn times(&self, a: &Poly, b: &Poly) -> Result<Poly, Rejected> {
        if a.is_empty() || b.is_empty() {
            return Ok(Poly::new());
        }
        spend(a.len() * b.len(), size(a).max(size(b)))?;
        let mut product = vec![Q::zero(); a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                product[i + j] += x * y;
            }
        }
        self.reduce(trimmed(product))
    }

    /// The product of a row and a column.
    pub fn dot(&self, row: &[Poly], column: &[Poly]) -> Result<Poly, Rejected> {
        row.iter().zip(column).try_fold(Poly::new(), |s, (a, b)| Ok(combine(&s, &Q::one(), &self.times(a, b)?)))
    }

    /// An enclosure of an element at `θ`.
    pub fn enclose(&self, element: &Poly) -> Result<Interval, Rejected> {
        values(element, &self.interval)
    }

    /// Reads a vector of `count` elements.
    pub fn vector(&self, node: &Node<'_>, count: usize) -> Result<Vec<Poly>, Rejected> {
        let items = node.list()?;
        if items.len() != count {
            return node.malformed(&format!("{count} elements are needed here"));
        }
        items.iter().map(|n| read(n, self.m.len() - 1)).collect()
    }

    /// Whether two fields with their embeddings are the same.
    pub fn same(&self, other: &Self) -> bool {
        self.m == other.m && self.interval.lo == other.interval.lo && self.interval.hi == other.interval.hi
    }
}

/// `Σ_k row_k · v_k` for rational coefficients.
pub fn weighted(row: &[Q], v: &[Poly]) -> Result<Poly, Rejected> {
    spend(row.len(), size(row) + v.iter().map(size).max().unwrap_or(0))?;
    Ok(row.iter().zip(v).filter(|(c, _)| !c.is_zero()).fold(Poly::new(), |s, (c, p)| combine(&s, c, p)))
}

/// The number of roots of `p` in the open unit disc, with multiplicity, where the recursion of Schur and Cohn is regular;
/// then no root lies on the circle. `None` where it is not.
pub fn roots_in_disc(p: &[Q]) -> Result<Option<usize>, Rejected> {
    let n = p.len().saturating_sub(1);
    let (Some(low), Some(high)) = (p.first(), p.last()) else { return Ok(None) };
    if n == 0 {
        return Ok(if low.is_zero() { None } else { Some(0) });
    }
    spend(4 * n, size(p))?;
    let delta = low * low - high * high;
    if delta.is_zero() {
        return Ok(None);
    }
    let next: Poly = (0..n).map(|k| (low * &p[k] - high * &p[n - k]) / &delta).collect();
    Ok(roots_in_disc(&next)?.map(|inside| if delta.is_positive() { inside } else { n - inside }))
}

/// A complex number known up to intervals: real and imaginary part.
pub type Complex = (Interval, Interval);

/// An enclosure of `Σ_k c_k z^k`.
pub fn complex_values(p: &[Q], z: &Complex) -> Result<Complex, Rejected> {
    spend(8 * p.len() * p.len(), size(p) + size([&z.0.lo, &z.0.hi, &z.1.lo, &z.1.hi]))?;
    let zero = Interval::point(&Q::zero());
    Ok(p.iter().rev().fold((zero.clone(), zero), |(re, im), c| {
        let new_re = re.times(&z.0).minus(&im.times(&z.1)).plus(&Interval::point(c));
        (new_re, re.times(&z.1).plus(&im.times(&z.0)))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(roots: &[(i64, i64)]) -> Poly {
        let mut p = vec![Q::one()];
        for &(a, b) in roots {
            let root = Q::new(a.into(), b.into());
            let mut q = vec![Q::zero(); p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                q[k] -= c * &root;
                q[k + 1] += c;
            }
            p = q;
        }
        p
    }

    #[test]
    fn schur_and_cohn_count() {
        assert_eq!(roots_in_disc(&product(&[(1, 2), (1, 3), (5, 3)])).unwrap(), Some(2));
        assert_eq!(roots_in_disc(&product(&[(0, 1), (0, 1), (-7, 3), (2, 1)])).unwrap(), Some(2));
        assert_eq!(roots_in_disc(&product(&[(-1, 2), (1, 2), (1, 5)])).unwrap(), Some(3));
        assert_eq!(roots_in_disc(&product(&[(3, 2), (-3, 2)])).unwrap(), Some(0));
        assert_eq!(roots_in_disc(&product(&[(1, 1), (1, 3)])).unwrap(), None);
        assert_eq!(roots_in_disc(&product(&[(1, 2), (2, 1)])).unwrap(), None);
        assert_eq!(roots_in_disc(&[whole(3)]).unwrap(), Some(0));
        assert_eq!(roots_in_disc(&[whole(0)]).unwrap(), None);
        assert_eq!(roots_in_disc(&[whole(1), whole(0), whole(4)]).unwrap(), Some(2));
    }
}
