//! Real number fields with a chosen embedding, interval enclosures, and the count of roots in a disc.

use crate::json::Node;
use crate::matrix::{Matrix, primitive};
use crate::number::{Q, spend};
use crate::{Rejected, reject};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Largest degree of a number field.
const MAX_DEGREE: usize = 64;

/// A closed interval with rational ends.
#[derive(Debug, Clone, PartialEq)]
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
        let (lo, hi) = products([&self.lo, &self.hi], [&other.lo, &other.hi]);
        Self { lo, hi }
    }
}

/// The least and the greatest product.
fn products<T: Ord + Clone>(a: [&T; 2], b: [&T; 2]) -> (T, T)
where
    for<'a> &'a T: std::ops::Mul<Output = T>,
{
    let ends = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    let (lo, hi) = (ends.iter().min(), ends.iter().max());
    (lo.unwrap_or(&ends[0]).clone(), hi.unwrap_or(&ends[0]).clone())
}

/// An enclosure of the values on an interval of the polynomial with these coefficients over `den`, lowest first (Horner's
/// scheme, in integers).
fn values(p: &[BigInt], den: &BigInt, x: &Interval) -> Result<Interval, Rejected> {
    let ends = Matrix::new(1, 2, &[x.lo.clone(), x.hi.clone()]);
    let bits = p.iter().map(BigInt::bits).max().unwrap_or(0) + ends.bits();
    spend(4 * p.len() * p.len() * p.len(), bits)?;
    let (mut lo, mut hi, mut scale) = (BigInt::zero(), BigInt::zero(), BigInt::one());
    for c in p.iter().rev() {
        (lo, hi) = products([&lo, &hi], [&ends.data[0], &ends.data[1]]);
        scale *= &ends.den;
        (lo, hi) = (lo + c * &scale, hi + c * &scale);
    }
    scale *= den;
    Ok(Interval { lo: Q::new(lo, scale.clone()), hi: Q::new(hi, scale) })
}

/// Enclosures of the values at `x` of polynomials, one in each row.
fn row_values(rows: &Matrix, x: &Interval) -> Result<Vec<Interval>, Rejected> {
    (0..rows.rows).map(|i| values(rows.integers(i), &rows.den, x)).collect()
}

/// `Q[x]/(m)` with a real root `θ` of `m`: the only one in an interval. A vector over it is a matrix with one row of
/// coefficients for each entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Where `θ` lies.
    pub interval: Interval,
    /// A row of coefficients times this matrix is that of the element times `θ`.
    pub by_root: Matrix,
}

impl Field {
    /// The rational numbers, `θ` being the number given.
    pub fn rational(x: &Q) -> Self {
        Self { interval: Interval::point(x), by_root: Matrix::new(1, 1, std::slice::from_ref(x)) }
    }

    /// Reads `polynomial` (monic; it need not be irreducible) and `interval` and checks that there is one root in it.
    pub fn read(polynomial: &Node<'_>, interval: &Node<'_>) -> Result<Self, Rejected> {
        let m = polynomial.list()?.iter().map(Node::rational).collect::<Result<Vec<Q>, _>>()?;
        let d = m.len().saturating_sub(1);
        if !(1..=MAX_DEGREE).contains(&d) || !m[d].is_one() {
            return reject("field", &polynomial.place, "a monic polynomial of degree 1 to 64 is needed");
        }
        let ends = interval.vector(2)?;
        if d == 1 {
            interval.need(ends[0] == ends[1] && ends[0] == -&m[0], "field", "both ends must be the rational root")?;
            return Ok(Self::rational(&ends[0]));
        }
        let row = Matrix::new(1, d + 1, &m);
        let value = |x: &Q| values(&row.data, &row.den, &Interval::point(x)).map(|v| v.sign());
        let changes = ends[0] < ends[1] && value(&ends[0])? * value(&ends[1])? < 0;
        interval.need(changes, "field", "the polynomial does not change sign on the interval")?;
        let place = Interval { lo: ends[0].clone(), hi: ends[1].clone() };
        let slope: Vec<BigInt> = row.data.iter().enumerate().skip(1).map(|(k, c)| c * k).collect();
        let monotone = values(&slope, &row.den, &place)?.sign() != 0;
        interval.need(monotone, "field", "the interval is too wide to hold one root only")?;
        let shifted = Matrix::ones(d - 1, d, |i, j| i + 1 == j);
        let last = Matrix::new(1, d, &m[..d]).scaled(&-Q::one());
        Ok(Self { interval: place, by_root: shifted.stack(&last) })
    }

    /// The degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.by_root.rows
    }

    /// Reads a vector of `count` elements.
    pub fn vector(&self, node: &Node<'_>, count: usize) -> Result<Matrix, Rejected> {
        let items = node.list()?;
        node.need(items.len() == count, "format", "a vector of another length is needed here")?;
        let mut entries = Vec::new();
        for item in items {
            let element = item.list()?.iter().map(Node::rational).collect::<Result<Vec<Q>, _>>()?;
            let fits = element.len() <= self.degree() && element.last().is_none_or(|c| !c.is_zero());
            item.need(fits, "format", "an element is a polynomial of lower degree without leading zeros")?;
            let zeros = self.degree() - element.len();
            entries.extend(element.into_iter().chain(std::iter::repeat_n(Q::zero(), zeros)));
        }
        Ok(Matrix::new(count, self.degree(), &entries))
    }

    /// The vector of these rational numbers (a column) in the field.
    pub fn embedded(&self, column: &Matrix) -> Matrix {
        let den = column.den.clone();
        let zeros = || std::iter::repeat_n(BigInt::zero(), self.degree() - 1);
        let data = column.data.iter().flat_map(|x| std::iter::once(x.clone()).chain(zeros())).collect();
        Matrix { rows: column.rows, cols: self.degree(), data, den }
    }

    /// The element `Σ a_k b_k`.
    pub fn dot(&self, a: &Matrix, b: &Matrix) -> Result<Matrix, Rejected> {
        let products = a.transpose().times(b)?;
        let d = self.degree();
        let mut sum = Matrix::ones(1, d, |_, _| false);
        for k in (0..2 * d - 1).rev() {
            let mut coefficient = Matrix::ones(1, d, |_, _| false);
            coefficient.data[0] =
                (0..d).filter(|&i| (i..i + d).contains(&k)).map(|i| &products.data[i * d + k - i]).sum();
            coefficient.den = products.den.clone();
            sum = sum.times(&self.by_root)?.plus(&Q::one(), &coefficient);
        }
        Ok(sum)
    }

    /// Enclosures of the entries of a vector at `θ`.
    pub fn enclose(&self, vector: &Matrix) -> Result<Vec<Interval>, Rejected> {
        row_values(vector, &self.interval)
    }

    /// The sign of an element at `θ`, 0 where it is not seen.
    pub fn sign(&self, element: &Matrix) -> Result<i32, Rejected> {
        Ok(self.enclose(element)?[0].sign())
    }
}

/// The number of roots of `p` in the open unit disc, with multiplicity, where the recursion of Schur and Cohn is regular;
/// then no root lies on the circle. `None` where it is not.
pub fn roots_in_disc(p: &[BigInt]) -> Result<Option<usize>, Rejected> {
    let n = p.len().saturating_sub(1);
    let (Some(low), Some(high)) = (p.first(), p.last()) else { return Ok(None) };
    if n == 0 {
        return Ok(if low.is_zero() { None } else { Some(0) });
    }
    spend(4 * n, p.iter().map(BigInt::bits).max().unwrap_or(0))?;
    let grows = low.abs() > high.abs();
    if low.abs() == high.abs() {
        return Ok(None);
    }
    // A constant factor moves no root.
    let next = primitive((0..n).map(|k| low * &p[k] - high * &p[n - k]).collect());
    Ok(roots_in_disc(&next)?.map(|inside| if grows { inside } else { n - inside }))
}

/// A complex number known up to intervals: real and imaginary part.
pub type Complex = (Interval, Interval);

/// An enclosure of `Σ_k c_k z^k`.
pub fn complex_values(p: &[Q], z: &Complex) -> Result<Complex, Rejected> {
    let bits = |numbers: &[Q]| numbers.iter().map(crate::number::bits).max().unwrap_or(0);
    spend(
        8 * p.len() * p.len(),
        bits(p) + [&z.0, &z.1].iter().map(|i| bits(&[i.lo.clone(), i.hi.clone()])).max().unwrap_or(0),
    )?;
    let zero = Interval::point(&Q::zero());
    Ok(p.iter().rev().fold((zero.clone(), zero), |(re, im), c| {
        let new_re = re.times(&z.0).minus(&im.times(&z.1)).plus(&Interval::point(c));
        (new_re, re.times(&z.1).plus(&im.times(&z.0)))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::whole;

    /// `Π (b z − a)`, a power of `-1` and a factor left out.
    fn inside(roots: &[(i64, i64)]) -> Option<usize> {
        let mut p = vec![BigInt::one()];
        for &(a, b) in roots {
            let mut q = vec![BigInt::zero(); p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                q[k] -= c * a;
                q[k + 1] += c * b;
            }
            p = q;
        }
        roots_in_disc(&p).unwrap()
    }

    #[test]
    fn schur_and_cohn_count() {
        assert_eq!(inside(&[(1, 2), (1, 3), (5, 3)]), Some(2));
        assert_eq!(inside(&[(0, 1), (0, 1), (-7, 3), (2, 1)]), Some(2));
        assert_eq!(inside(&[(-1, 2), (1, 2), (1, 5)]), Some(3));
        assert_eq!(inside(&[(3, 2), (-3, 2)]), Some(0));
        assert_eq!(inside(&[(1, 1), (1, 3)]), None);
        assert_eq!(inside(&[(1, 2), (2, 1)]), None);
        assert_eq!(inside(&[]), Some(0));
        assert_eq!(roots_in_disc(&[BigInt::zero()]).unwrap(), None);
        assert_eq!(roots_in_disc(&[1, 0, 4].map(BigInt::from)).unwrap(), Some(2));
    }

    #[test]
    fn horner_encloses() {
        let x = Interval { lo: Q::new((-1).into(), 2.into()), hi: whole(2) };
        let value = values(&[1, -3, 2].map(BigInt::from), &5.into(), &x).unwrap();
        // ((2 x − 3) x + 1) / 5
        assert_eq!(value, Interval { lo: Q::new((-7).into(), 5.into()), hi: Q::new(3.into(), 5.into()) });
    }
}
