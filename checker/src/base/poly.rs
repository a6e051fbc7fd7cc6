//! Real number fields with a chosen embedding, interval enclosures, and the count of roots in a disc.

use super::whole::{Whole, absolute};
use super::{Checked, Matrix, Node, Q, some, spend};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Largest degree of a number field.
pub const MAX_DEGREE: usize = 64;

/// A closed interval: its lower and its upper end.
pub type Interval = [Q; 2];

/// The interval that holds only `x`.
fn point(x: &Q) -> Interval {
    [x.clone(), x.clone()]
}

/// The sign of a number that lies between two others, 0 where it is not seen or 0.
fn sign_between<T: Signed>(lo: &T, hi: &T) -> i32 {
    if lo.is_positive() { 1 } else { -i32::from(hi.is_negative()) }
}

/// The least and the greatest product.
pub fn products(a: &[BigInt; 2], b: &[BigInt; 2]) -> [BigInt; 2] {
    let first = &a[0] * &b[0];
    if a[0] == a[1] && b[0] == b[1] {
        return [first.clone(), first];
    }
    let ends = [&a[0] * &b[1], &a[1] * &b[0], &a[1] * &b[1]];
    ends.into_iter().fold([first.clone(), first], |[lo, hi], x| [lo.min(x.clone()), hi.max(x)])
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

    /// The sign of an entry, 0 where it is not seen or 0.
    pub fn sign(&self, k: usize) -> i32 {
        sign_between(&self.lo.data[k], &self.hi.data[k])
    }

    /// Whether the sign of some entry is seen.
    pub fn is_nonzero(&self) -> bool {
        (0..self.lo.rows).any(|k| self.sign(k) != 0)
    }

    /// Bounds of an entry times the denominator.
    pub fn ends(&self, k: usize) -> [BigInt; 2] {
        [self.lo.data[k].clone(), self.hi.data[k].clone()]
    }

    /// Whether this and another vector have a 2x2 minor that is certainly not 0.
    pub fn not_parallel(&self, other: &Self) -> bool {
        let product = |i: usize, j: usize| products(&self.ends(i), &other.ends(j));
        let minor = |i: usize, j: usize| {
            let (a, b) = (product(i, j), product(j, i));
            a[0] > b[1] || a[1] < b[0]
        };
        (0..self.lo.rows).any(|i| (0..i).any(|j| minor(i, j)))
    }
}

/// Enclosures of the values on a rectangle (its real and its imaginary side) of the polynomials whose coefficients, lowest
/// first, are the rows of a matrix: real and imaginary parts over one denominator (Horner's scheme, in integers).
pub fn values(rows: &Matrix, x: &Interval, y: &Interval) -> Checked<[Enclosed; 2]> {
    let ends = Matrix::new(2, 2, &[x.as_slice(), y].concat());
    spend(8 * rows.data.len() * rows.cols * rows.cols, rows.bits() + ends.bits())?;
    let side = |k: usize| [ends.data[2 * k].clone(), ends.data[2 * k + 1].clone()];
    let (x, y) = (side(0), side(1));
    let mut sums = vec![[[BigInt::zero(), BigInt::zero()], [BigInt::zero(), BigInt::zero()]]; rows.rows];
    let mut scale = BigInt::one();
    for k in (0..rows.cols).rev() {
        scale *= &ends.den;
        for (i, [re, im]) in sums.iter_mut().enumerate() {
            let c = &rows.integers(i)[k] * &scale;
            let ([a, b], [d, e]) = (products(re, &x), products(im, &y));
            let ([f, g], [h, j]) = (products(re, &y), products(im, &x));
            (*re, *im) = ([a - e + &c, b - d + c], [f + h, g + j]);
        }
    }
    scale *= &rows.den;
    let column = |part: usize, end: usize| {
        let data = sums.iter().map(|s| s[part][end].clone()).collect();
        Matrix { rows: rows.rows, cols: 1, data, den: scale.clone() }
    };
    Ok([0, 1].map(|part| Enclosed { lo: column(part, 0), hi: column(part, 1) }))
}

/// The derivative of a polynomial (a row, lowest coefficient first), as long as the polynomial.
fn derivative(p: &Matrix) -> Matrix {
    let data = p.data.iter().enumerate().skip(1).map(|(k, c)| c * k).chain([BigInt::zero()]).collect();
    Matrix { data, ..p.clone() }
}

/// Whether a polynomial of degree `n ≥ 1` (a row) is seen to have a root within `error ≥ 0` of a point `z` of the plane: some root
/// is nearer than `n |p(z)/p'(z)|`, as `p'/p = Σ 1/(z − root)`. A polynomial of degree 0 has no root: its sum is empty.
pub fn has_root_near<T: Whole>(p: &Matrix<T>, z: &[Q], error: &Q) -> Checked<bool> {
    if p.cols < 2 || p.data[p.cols - 1].vanishes() || error.is_negative() {
        return Ok(false);
    }
    let z = Matrix::new(1, 2, z);
    let long = (p.bits() + z.bits()).saturating_mul(p.cols as u64);
    spend(16 * p.cols, long)?;
    // p(z) and p'(z) times the same number.
    let square = |coefficients: &[T]| {
        let (mut re, mut im, mut scale) = (T::integer(BigInt::zero()), T::integer(BigInt::zero()), BigInt::one());
        for c in coefficients.iter().rev() {
            let next = re.multiple(&z.data[0]).minus(&im.multiple(&z.data[1])).plus(&c.multiple(&scale));
            im = re.multiple(&z.data[1]).plus(&im.multiple(&z.data[0]));
            re = next;
            scale *= &z.den;
        }
        re.times(&re).plus(&im.times(&im))
    };
    let derivative: Vec<T> = p.data.iter().enumerate().skip(1).map(|(k, c)| c.multiple(&k.into())).collect();
    // The derivative has one power of the denominator less.
    let (far, near) = (error.numer() * &z.den, error.denom() * (p.cols - 1));
    let (value, slope) = (square(&p.data), square(&derivative));
    // Where the derivative is 0, this says that z is a root.
    Ok(slope.multiple(&(&far * &far)).minus(&value.multiple(&(&near * &near))).sgn() >= 0)
}

/// `Q[x]/(m)` with a real root `θ` of `m`: the only one in an interval. A vector over it is a matrix with one row of
/// coefficients for each entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Where `θ` lies.
    pub interval: Interval,
    /// A row of coefficients times this matrix is that of the element times `θ`.
    pub by_root: Matrix,
    /// Where the number lies for which the field is made, such as an eigenvalue; it is `θ` where nothing else is said.
    pub value: Interval,
    /// The same for the multiplication by this number.
    pub by_value: Matrix,
    /// The same for the generator of the field of the case, where that is not the field of the rational numbers.
    pub by_alpha: Option<Matrix>,
}

impl Field {
    /// The rational numbers, `θ` being the number given.
    pub fn rational(x: &Q) -> Self {
        Self::of(Matrix::new(1, 1, std::slice::from_ref(x)), point(x))
    }

    /// The field in which rows are multiplied by the root, which lies in an interval, by a matrix.
    pub fn of(by_root: Matrix, interval: Interval) -> Self {
        Self { value: interval.clone(), by_value: by_root.clone(), interval, by_root, by_alpha: None }
    }

    /// Reads `polynomial` (monic; it need not be irreducible) and `interval` and checks that there is one root in it.
    pub fn read(polynomial: &Node<'_>, interval: &Node<'_>) -> Checked<Self> {
        let (m, ends) = (Self::monic(polynomial, MAX_DEGREE)?, interval.vector(2)?);
        let place = [ends[0].clone(), ends[1].clone()];
        if m.len() == 2 {
            interval.need(ends == [-&m[0], -&m[0]], "field", "both ends must be the rational root")?;
            return Ok(Self::rational(&ends[0]));
        }
        let row = Matrix::new(1, m.len(), &m);
        let value = |x: &Q| Ok(Self::real(&row, &point(x))?.sign(0));
        let changes = ends[0] < ends[1] && value(&ends[0])? * value(&ends[1])? < 0;
        interval.need(changes, "field", "the polynomial does not change sign on the interval")?;
        let monotone = Self::real(&derivative(&row), &place)?.is_nonzero();
        interval.need(monotone, "field", "the interval is too wide to hold one root only")?;
        Ok(Self::of(Self::companion(&m), place))
    }

    /// Reads a monic polynomial of a degree from 1 on, lowest coefficient first.
    pub fn monic(node: &Node<'_>, most: usize) -> Checked<Vec<Q>> {
        let m = node.each(Node::rational)?;
        let monic = (2..=most + 1).contains(&m.len()) && m[m.len() - 1].is_one();
        node.need(monic, "field", format_args!("a monic polynomial of degree 1 to {most} is needed"))?;
        Ok(m)
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
    pub fn vector(&self, node: &Node<'_>, count: usize) -> Checked<Matrix> {
        Self::coordinates(self.degree(), node, count)
    }

    /// Reads `count` elements, polynomials of degree below `degree`, as rows of coefficients.
    pub fn coordinates(degree: usize, node: &Node<'_>, count: usize) -> Checked<Matrix> {
        let items = node.exactly(count, "format")?;
        let entries = items.iter().map(|item| Self::coefficients(degree, item)).collect::<Checked<Vec<_>>>()?;
        Ok(Matrix::from_rows(degree, &entries))
    }

    /// Reads the coefficients of an element, one for each power below `degree`.
    pub fn coefficients(degree: usize, node: &Node<'_>) -> Checked<Vec<Q>> {
        let mut element = node.each(Node::rational)?;
        let fits = element.len() <= degree && element.last().is_none_or(|c| !c.is_zero());
        node.need(fits, "format", "an element is a polynomial of lower degree without leading zeros")?;
        element.resize(degree, Q::zero());
        Ok(element)
    }

    /// Reads an element.
    pub fn element(&self, node: &Node<'_>) -> Checked<Matrix> {
        Ok(Matrix::new(1, self.degree(), &Self::coefficients(self.degree(), node)?))
    }

    /// The polynomial of another field at an element.
    pub fn substituted(&self, number: &Self, x: &Matrix) -> Checked<Matrix> {
        let (d, one) = (number.degree(), self.one());
        // The last row of the companion matrix holds the coefficients but for the sign.
        let mut value = one.clone();
        for k in (0..d).rev() {
            value = self.dot(&value, x)?.plus(&-number.by_root.at(d - 1, k), &one);
        }
        Ok(value)
    }

    /// Whether an element is the root by which another number is generated: a root of its polynomial, in its interval.
    pub fn is_root(&self, number: &Self, x: &Matrix) -> Checked<bool> {
        let ([lo, hi], at) = (&number.interval, self.enclose(x)?);
        let inside = *lo <= at.lo.at(0, 0) && at.hi.at(0, 0) <= *hi;
        // Of a polynomial of degree 1 there is no other root.
        Ok(self.substituted(number, x)?.is_zero() && (inside || number.degree() == 1))
    }

    /// Whether no other complex root of the polynomial lies in a rectangle: on the smallest rectangle that holds it and the interval,
    /// which is convex, the derivative takes values of a convex set without 0, so that the polynomial is injective there.
    pub fn is_alone(&self, [re, im]: &[Interval; 2]) -> Checked<bool> {
        let (d, zero) = (self.degree(), Q::zero());
        let hull = |[a, b]: &Interval, [c, e]: [&Q; 2]| [a.min(c).clone(), b.max(e).clone()];
        let (re, im) = (hull(re, [&self.interval[0], &self.interval[1]]), hull(im, [&zero, &zero]));
        let m = self.by_root.row(d - 1).scaled(&-Q::one()).beside(&Matrix::identity(1));
        let [x, y] = values(&derivative(&m), &re, &im)?;
        Ok(x.is_nonzero() || y.is_nonzero())
    }

    /// The number 1.
    pub fn one(&self) -> Matrix {
        Matrix::ones(1, self.degree(), |_, j| j == 0)
    }

    /// The matrix by which a row of coefficients is multiplied by an element.
    pub fn multiplication(&self, x: &Matrix) -> Checked<Matrix> {
        let (mut rows, mut power) = (x.clone(), x.clone());
        for _ in 1..self.degree() {
            power = power.times(&self.by_root)?;
            rows = rows.stack(&power);
        }
        Ok(rows)
    }

    /// The product of a matrix over the field of the case and a vector.
    pub fn applied<T: Whole>(&self, matrix: &Matrix<T>, vector: &Matrix) -> Checked<Matrix> {
        let mut layers = T::layers(matrix).into_iter();
        let first = some(layers.next(), "field", "a matrix without coefficients")?;
        let (mut sum, mut image) = (first.times(vector)?, vector.clone());
        for layer in layers {
            let by_alpha = some(self.by_alpha.as_ref(), "field", "the field does not hold that of the case")?;
            image = image.times(by_alpha)?;
            sum = sum.plus(&Q::one(), &layer.times(&image)?);
        }
        Ok(sum)
    }

    /// The vector of these numbers (a column) in the field.
    pub fn embedded<T: Whole>(&self, column: &Matrix<T>) -> Checked<Matrix> {
        self.applied(column, &self.one())
    }

    /// The element `Σ a_k b_k`.
    pub fn dot(&self, a: &Matrix, b: &Matrix) -> Checked<Matrix> {
        let products = a.transpose().times(b)?;
        let d = self.degree();
        let mut sum = Matrix::zeros(1, d);
        for k in (0..2 * d - 1).rev() {
            let mut coefficient = Matrix { den: products.den.clone(), ..Matrix::zeros(1, d) };
            let terms = (0..d).filter(|&i| (i..i + d).contains(&k));
            coefficient.data[0] = terms.map(|i| &products.data[i * d + k - i]).sum();
            sum = sum.times(&self.by_root)?.plus(&Q::one(), &coefficient);
        }
        Ok(sum)
    }

    /// Enclosures of the entries of a vector at `θ`.
    pub fn enclose(&self, vector: &Matrix) -> Checked<Enclosed> {
        Self::real(vector, &self.interval)
    }

    /// Enclosures of real values.
    fn real(rows: &Matrix, x: &Interval) -> Checked<Enclosed> {
        let [re, _] = values(rows, x, &point(&Q::zero()))?;
        Ok(re)
    }

    /// The sign of the number for which the field is made, 0 where it is not seen.
    pub fn value_sign(&self) -> i32 {
        sign_between(&self.value[0], &self.value[1])
    }

    /// The sign of an element at `θ`, 0 where it is not seen.
    pub fn sign(&self, element: &Matrix) -> Checked<i32> {
        Ok(self.enclose(element)?.sign(0))
    }
}

/// The number of roots of `p` in the open unit disc, with multiplicity, where the recursion of Schur and Cohn is regular;
/// then no root lies on the circle. `None` where it is not.
pub fn roots_in_disc<T: Whole>(p: &[T]) -> Checked<Option<usize>> {
    let (Some(low), Some(high)) = (p.first(), p.last()) else { return Ok(None) };
    let n = p.len() - 1;
    if n == 0 {
        return Ok(if low.vanishes() { None } else { Some(0) });
    }
    spend(4 * n, p.iter().fold(0, |most, x| most.max(x.bits())))?;
    let order = absolute(low).minus(&absolute(high)).sgn();
    if order == 0 {
        return Ok(None);
    }
    // A constant factor moves no root.
    let next = T::short((0..n).map(|k| low.times(&p[k]).minus(&high.times(&p[n - k]))).collect())?;
    Ok(roots_in_disc(&next)?.map(|inside| if order > 0 { inside } else { n - inside }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::whole;

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
        let x = [Q::new((-1).into(), 2.into()), whole(2)];
        let p = [1, -3, 2].map(|c| whole(c) / whole(5));
        let value = Field::real(&Matrix::new(1, 3, &p), &x).unwrap();
        // ((2 x − 3) x + 1) / 5: 2 x − 3 is in [−4, 1], times x in [−8, 2].
        assert_eq!((value.lo.at(0, 0), value.hi.at(0, 0)), (whole(-7) / whole(5), whole(3) / whole(5)));
        // (x + iy)² + i-free terms: x² − y² + 1 and 2xy on [−1/2, 2] × [1, 3].
        let square = Matrix::new(1, 3, &[whole(1), whole(0), whole(1)]);
        let [re, im] = values(&square, &x, &[whole(1), whole(3)]).unwrap();
        assert_eq!([re.lo.at(0, 0), re.hi.at(0, 0)], [whole(-9), whole(4)]);
        assert_eq!([im.lo.at(0, 0), im.hi.at(0, 0)], [whole(-3), whole(12)]);
    }

    #[test]
    fn a_root_is_near() {
        // x² + 1 at (1 + i)/2·…: n |p/p'| at 0.9 i is 2 · 0.19 / 1.8 < 1/4.
        let (p, z) = (Matrix::new(1, 3, &[whole(1), whole(0), whole(1)]), [whole(0), whole(9) / whole(10)]);
        assert!(has_root_near(&p, &z, &(whole(1) / whole(4))).unwrap());
        assert!(!has_root_near(&p, &z, &(whole(1) / whole(5))).unwrap());
        assert!(!has_root_near(&p, &[whole(0), whole(0)], &whole(100)).unwrap());
        // 0 · |1| ≤ e · |0| holds anywhere, but constants have no roots; nor has a product of size 0 x 0 eigenvalues.
        let constant = Matrix::new(1, 1, &[whole(1)]);
        assert!(!has_root_near(&constant, &[whole(5), whole(0)], &whole(100)).unwrap());
        assert!(!has_root_near(&Matrix::<BigInt>::identity(0).characteristic().unwrap(), &z, &whole(1)).unwrap());
    }
}
