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
        let (lo, hi) = products(&[self.lo.clone(), self.hi.clone()], &[other.lo.clone(), other.hi.clone()]);
        Self { lo, hi }
    }
}

/// The least and the greatest product.
fn products<T: Ord + Clone>(a: &[T], b: &[T]) -> (T, T)
where
    for<'a> &'a T: std::ops::Mul<Output = T>,
{
    let first = &a[0] * &b[0];
    if a[0] == a[1] && b[0] == b[1] {
        return (first.clone(), first);
    }
    let ends = [&a[0] * &b[1], &a[1] * &b[0], &a[1] * &b[1]];
    ends.into_iter().fold((first.clone(), first), |(lo, hi), x| (lo.min(x.clone()), hi.max(x)))
}

/// Enclosures of real numbers: the lower and the upper ends (columns over one denominator).
#[derive(Debug, Clone)]
pub struct Enclosed {
    /// The lower ends.
    pub lo: Matrix,
    /// The upper ends.
    pub hi: Matrix,
}

impl Enclosed {
    /// A column of rational numbers.
    pub fn exact(column: Matrix) -> Self {
        Self { lo: column.clone(), hi: column }
    }

    /// A column of intervals.
    pub fn of(intervals: &[Interval]) -> Self {
        let ends: Vec<Q> =
            intervals.iter().map(|x| x.lo.clone()).chain(intervals.iter().map(|x| x.hi.clone())).collect();
        let both = Matrix::new(2, intervals.len(), &ends);
        Self { lo: both.row(0).transpose(), hi: both.row(1).transpose() }
    }

    /// The sign of an entry, 0 where it is not seen or 0.
    pub fn sign(&self, k: usize) -> i32 {
        if self.lo.data[k].is_positive() { 1 } else { -i32::from(self.hi.data[k].is_negative()) }
    }

    /// Whether the sign of some entry is seen.
    pub fn is_nonzero(&self) -> bool {
        (0..self.lo.rows).any(|k| self.sign(k) != 0)
    }

    /// Whether this and another vector have a 2x2 minor that is certainly not 0.
    pub fn not_parallel(&self, other: &Self) -> bool {
        let ends = |v: &Self, k: usize| [v.lo.data[k].clone(), v.hi.data[k].clone()];
        let product = |i: usize, j: usize| products(&ends(self, i), &ends(other, j));
        let minor = |i: usize, j: usize| {
            let (a, b) = (product(i, j), product(j, i));
            a.0 > b.1 || a.1 < b.0
        };
        (0..self.lo.rows).any(|i| (0..i).any(|j| minor(i, j)))
    }
}

/// Enclosures of the values on an interval of the polynomials whose coefficients, lowest first, are the rows of a matrix
/// (Horner's scheme, in integers).
fn values(rows: &Matrix, x: &Interval) -> Result<Enclosed, Rejected> {
    let ends = Matrix::new(1, 2, &[x.lo.clone(), x.hi.clone()]);
    spend(4 * rows.data.len() * rows.cols * rows.cols, rows.bits() + ends.bits())?;
    let zero = || vec![BigInt::zero(); rows.rows];
    let (mut lo, mut hi, mut scale) = (zero(), zero(), BigInt::one());
    for k in (0..rows.cols).rev() {
        scale *= &ends.den;
        for i in 0..rows.rows {
            let c = &rows.integers(i)[k] * &scale;
            let (a, b) = products(&[std::mem::take(&mut lo[i]), std::mem::take(&mut hi[i])], &ends.data);
            (lo[i], hi[i]) = (a + &c, b + c);
        }
    }
    scale *= &rows.den;
    let column = |data| Matrix { rows: rows.rows, cols: 1, data, den: scale.clone() };
    Ok(Enclosed { lo: column(lo), hi: column(hi) })
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
        let value = |x: &Q| values(&row, &Interval::point(x)).map(|v| v.sign(0));
        let changes = ends[0] < ends[1] && value(&ends[0])? * value(&ends[1])? < 0;
        interval.need(changes, "field", "the polynomial does not change sign on the interval")?;
        let place = Interval { lo: ends[0].clone(), hi: ends[1].clone() };
        let slope = row.data.iter().enumerate().skip(1).map(|(k, c)| c * k).collect();
        let monotone = values(&Matrix { cols: d, data: slope, ..row }, &place)?.is_nonzero();
        interval.need(monotone, "field", "the interval is too wide to hold one root only")?;
        Ok(Self { interval: place, by_root: Self::companion(&m) })
    }

    /// The matrix by which a row of coefficients modulo a monic polynomial is multiplied by the root.
    pub fn companion(m: &[Q]) -> Matrix {
        let d = m.len() - 1;
        Matrix::ones(d - 1, d, |i, j| i + 1 == j).stack(&Matrix::new(1, d, &m[..d]).scaled(&-Q::one()))
    }

    /// The degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.by_root.rows
    }

    /// Reads a vector of `count` elements.
    pub fn vector(&self, node: &Node<'_>, count: usize) -> Result<Matrix, Rejected> {
        Self::coordinates(self.degree(), node, count)
    }

    /// Reads `count` elements, polynomials of degree below `degree`, as rows of coefficients.
    pub fn coordinates(degree: usize, node: &Node<'_>, count: usize) -> Result<Matrix, Rejected> {
        let items = node.list()?;
        node.need(items.len() == count, "format", "a vector of another length is needed here")?;
        let mut entries = Vec::new();
        for item in items {
            let element = item.list()?.iter().map(Node::rational).collect::<Result<Vec<Q>, _>>()?;
            let fits = element.len() <= degree && element.last().is_none_or(|c| !c.is_zero());
            item.need(fits, "format", "an element is a polynomial of lower degree without leading zeros")?;
            let zeros = degree - element.len();
            entries.extend(element.into_iter().chain(std::iter::repeat_n(Q::zero(), zeros)));
        }
        Ok(Matrix::new(count, degree, &entries))
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
    pub fn enclose(&self, vector: &Matrix) -> Result<Enclosed, Rejected> {
        values(vector, &self.interval)
    }

    /// The sign of an element at `θ`, 0 where it is not seen.
    pub fn sign(&self, element: &Matrix) -> Result<i32, Rejected> {
        Ok(self.enclose(element)?.sign(0))
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
        let p = [1, -3, 2].map(|c| whole(c) / whole(5));
        let value = values(&Matrix::new(1, 3, &p), &x).unwrap();
        // ((2 x − 3) x + 1) / 5: 2 x − 3 is in [−4, 1], times x in [−8, 2].
        assert_eq!((value.lo.at(0, 0), value.hi.at(0, 0)), (whole(-7) / whole(5), whole(3) / whole(5)));
    }
}
