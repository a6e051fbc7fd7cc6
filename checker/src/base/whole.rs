//! What matrices are made of: integers, or numbers `Σ c_k α^k` with integers `c_k` in a real number field, over one denominator.

use super::file::number;
use super::matrix::primitive;
use super::number::gcd;
use super::{Checked, Enclosed, Field, Interval, MAX_DEGREE, Matrix, Node, Q, need};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::fmt::Debug;

/// A number over a denominator.
pub type Fraction<T> = (T, BigInt);

/// A ring of real numbers that are known exactly, whose multiples by fractions of integers are a field.
pub trait Whole: Clone + Debug + Sized {
    /// What must be known to read them.
    type Ground: Clone;

    /// An integer.
    fn integer(k: BigInt) -> Self;
    /// `self + other`.
    fn plus(&self, other: &Self) -> Self;
    /// `self - other`.
    fn minus(&self, other: &Self) -> Self;
    /// `self * other`.
    fn times(&self, other: &Self) -> Self;
    /// `self += a * b`.
    fn add_product(&mut self, a: &Self, b: &Self);
    /// The products of the rows of a matrix and the columns of another where all of it fits into words.
    fn product_of_words(_: &Matrix<Self>, _: &Matrix<Self>) -> Option<Vec<Self>> {
        None
    }
    /// A multiple.
    fn multiple(&self, factor: &BigInt) -> Self;
    /// The number over an integer that divides its coefficients.
    fn over(&self, divisor: &BigInt) -> Self;
    /// The sign, exactly.
    fn sgn(&self) -> i32;
    /// Whether it is 0, exactly.
    fn vanishes(&self) -> bool {
        self.sgn() == 0
    }
    /// The greatest common divisor of the coefficients; 0 for 0.
    fn content(&self) -> BigInt;
    /// The size of the longest coefficient in bits.
    fn bits(&self) -> u64;
    /// A number and a positive integer, which is its product with this one.
    fn reciprocal(&self) -> Checked<Fraction<Self>>;
    /// A positive multiple of all the numbers that is written shortly.
    fn short(numbers: Vec<Self>) -> Checked<Vec<Self>>;
    /// `2^places` times the number over a positive integer, rounded down and up.
    fn rounded(&self, den: &BigInt, places: u64) -> [BigInt; 2];
    /// The matrices of the coefficients of `1, α, …`.
    fn layers(matrix: &Matrix<Self>) -> Vec<Matrix>;
    /// Enclosures of a column.
    fn enclosed(column: &Matrix<Self>) -> Enclosed;
    /// Reads a number of a certificate.
    fn entry(node: &Node<'_>, ground: &Self::Ground) -> Checked<Fraction<Self>>;
    /// Reads a number of a case.
    fn given(node: &Node<'_>, ground: &Self::Ground) -> Checked<Fraction<Self>>;
    /// Reads the field of an eigenvalue.
    fn field(polynomial: &Node<'_>, interval: &Node<'_>, ground: &Self::Ground) -> Checked<Field>;
    /// The field of the case as one of an eigenvalue, which is not used.
    fn own(ground: &Self::Ground) -> Checked<Field>;
    /// Reads a field that is seen at a root inside a rectangle, with the eigenvalue that stands in it, which lies inside another.
    fn plane(
        polynomial: &Node<'_>,
        ground: &Self::Ground,
        root: impl FnOnce(&[Q]) -> Checked<[Interval; 2]>,
    ) -> Checked<(Field, [Interval; 2], [Interval; 2])>;
    /// Reads a vector that lines over fields of eigenvalues may have in common.
    fn common(node: &Node<'_>, dimension: usize, ground: &Self::Ground) -> Checked<Option<Matrix<Self>>>;
}

/// Whether a list holds no lists and no objects.
pub fn is_plain(node: &Node<'_>) -> Checked<bool> {
    Ok(node.list()?.iter().all(|item| item.text().is_ok()))
}

/// A rational upper bound of a number over a positive integer; the number itself where it is rational.
pub fn ceiling<T: Whole>(number: &T, den: &BigInt) -> Q {
    /// Binary places.
    const PLACES: u64 = 192;
    let [_, high] = number.rounded(den, PLACES);
    Q::new(high, BigInt::one() << PLACES)
}

/// The largest of some numbers, or 0 where they are all negative.
pub fn largest<T: Whole>(numbers: impl IntoIterator<Item = T>) -> T {
    let zero = T::integer(BigInt::zero());
    numbers.into_iter().fold(zero, |most, x| if most.minus(&x).sgn() < 0 { x } else { most })
}

/// The absolute value.
pub fn absolute<T: Whole>(x: &T) -> T {
    if x.sgn() < 0 { x.multiple(&-BigInt::one()) } else { x.clone() }
}

impl Whole for BigInt {
    type Ground = ();

    fn integer(k: BigInt) -> Self {
        k
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        if !Zero::is_zero(a) && !Zero::is_zero(b) {
            *self += a * b;
        }
    }
    fn multiple(&self, factor: &BigInt) -> Self {
        self * factor
    }
    fn over(&self, divisor: &BigInt) -> Self {
        self / divisor
    }
    fn sgn(&self) -> i32 {
        if self.is_positive() { 1 } else { -i32::from(self.is_negative()) }
    }
    fn vanishes(&self) -> bool {
        Zero::is_zero(self)
    }
    fn content(&self) -> BigInt {
        self.abs()
    }
    fn bits(&self) -> u64 {
        self.bits()
    }
    fn reciprocal(&self) -> Checked<Fraction<Self>> {
        need(!Zero::is_zero(self), "field", "a division by 0")?;
        Ok((self.signum(), self.abs()))
    }
    fn product_of_words(left: &Matrix, right: &Matrix) -> Option<Vec<Self>> {
        // Sums of fewer than 2^24 products of numbers below 2^51 stay below 2^126.
        let words = |m: &Matrix| {
            let word = |x: &Self| i64::try_from(x).ok().filter(|x| x.unsigned_abs() < 1 << 51);
            m.data.iter().map(word).collect::<Option<Vec<i64>>>()
        };
        let (a, b) = (words(left)?, words(right)?);
        if left.cols == 0 || left.cols >= 1 << 24 {
            return None;
        }
        let entry = |row: &[i64], j: usize| {
            let factors = row.iter().zip(b.iter().skip(j).step_by(right.cols));
            Self::from(factors.map(|(x, y)| i128::from(*x) * i128::from(*y)).sum::<i128>())
        };
        Some(a.chunks(left.cols).flat_map(|row| (0..right.cols).map(move |j| entry(row, j))).collect())
    }
    fn short(numbers: Vec<Self>) -> Checked<Vec<Self>> {
        Ok(primitive(numbers))
    }
    fn rounded(&self, den: &BigInt, places: u64) -> [BigInt; 2] {
        let scaled = self << places;
        [scaled.div_floor(den), scaled.div_ceil(den)]
    }
    fn layers(matrix: &Matrix) -> Vec<Matrix> {
        vec![matrix.clone()]
    }
    fn enclosed(column: &Matrix) -> Enclosed {
        Enclosed::exact(column.clone())
    }
    fn entry(node: &Node<'_>, (): &()) -> Checked<Fraction<Self>> {
        Ok(node.rational()?.into_raw())
    }
    fn given(node: &Node<'_>, (): &()) -> Checked<Fraction<Self>> {
        Ok(number(node)?.into_raw())
    }
    fn field(polynomial: &Node<'_>, interval: &Node<'_>, (): &()) -> Checked<Field> {
        Field::read(polynomial, interval)
    }
    fn own((): &()) -> Checked<Field> {
        Ok(Field::rational(&Q::zero()))
    }
    fn plane(
        polynomial: &Node<'_>,
        (): &(),
        root: impl FnOnce(&[Q]) -> Checked<[Interval; 2]>,
    ) -> Checked<(Field, [Interval; 2], [Interval; 2])> {
        let m = Field::monic(polynomial, MAX_DEGREE)?;
        let square = root(&m)?;
        Ok((Field::of(Field::companion(&m), square[0].clone()), square.clone(), square))
    }
    fn common(node: &Node<'_>, dimension: usize, (): &()) -> Checked<Option<Matrix>> {
        Ok(if is_plain(node)? { Some(Matrix::new(dimension, 1, &node.vector(dimension)?)) } else { None })
    }
}

/// The greatest common divisor of all coefficients of some numbers.
pub fn content<T: Whole>(numbers: &[T]) -> BigInt {
    numbers.iter().fold(BigInt::zero(), |g, x| if g.is_one() { g } else { gcd(&g, &x.content()) })
}

/// A rational number as such a fraction.
pub fn fraction<T: Whole>(x: &Q) -> Fraction<T> {
    (T::integer(x.numer().clone()), x.denom().clone())
}
