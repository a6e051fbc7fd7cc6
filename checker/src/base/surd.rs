//! Elements of a real number field `Q(α)`, where `α` is an algebraic integer: polynomials in `α` with integer coefficients.
//!
//! The polynomial `m` of `α` need not be irreducible. An element may then be written in several ways, but it is always the same
//! real number, and whether it is 0 is decided by its greatest common divisor with `m`: `α` is a simple root of `m` and the
//! only one in an interval, at whose ends `m` is not 0, so that `α` is a root of a divisor of `m` if and only if the divisor
//! changes its sign there.

use super::expression;
use super::generator::Generator;
use super::number::{gcd, lcm};
use super::poly::{Interval, values};
use super::whole::{Fraction, Whole, content, fraction, is_plain};
use super::{Checked, Enclosed, Field, MAX_DEGREE, Matrix, Node, Q, charge, longest, need};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};
use std::rc::Rc;

/// Largest degree of a field.
const MAX_FIELD_DEGREE: usize = 24;

/// A field, and numbers in it of which the entries of a case are made: values of roots and cosines.
#[derive(Debug, Clone)]
pub struct Ground {
    /// The field.
    pub generator: Rc<Generator>,
    /// The numbers.
    pub numbers: Vec<Fraction<Surd>>,
}

/// An element.
#[derive(Debug, Clone)]
pub struct Surd {
    /// The coefficients, lowest first, without zeros at the end; fewer than the degree.
    coefficients: Vec<BigInt>,
    /// The field; integers need none.
    of: Option<Rc<Generator>>,
}

impl Ground {
    /// Reads `{"polynomial", "interval", "numbers"}`.
    pub fn read(node: &Node<'_>) -> Checked<Self> {
        let [polynomial, interval, numbers] = node.fields("polynomial interval numbers")?;
        let m = Field::monic(&polynomial, MAX_FIELD_DEGREE)?;
        let whole = m.len() > 2 && m.iter().all(Q::is_integer);
        polynomial.need(whole, "field", "integer coefficients and a degree from 2 on are needed")?;
        let field = Field::read(&polynomial, &interval)?;
        let polynomial = m.iter().map(|c| c.numer().clone()).collect();
        let generator = Rc::new(Generator::new(polynomial, field));
        let mut ground = Self { generator, numbers: Vec::new() };
        ground.numbers = numbers.each(|item| Surd::entry(item, &ground))?;
        Ok(ground)
    }
}

impl Surd {
    /// The element with these coefficients, as many as there may be.
    fn of(mut coefficients: Vec<BigInt>, of: Option<Rc<Generator>>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self { coefficients, of }
    }

    fn combined(&self, other: &Self, by: impl Fn(&BigInt, &BigInt) -> BigInt) -> Self {
        let zero = BigInt::zero();
        let length = self.coefficients.len().max(other.coefficients.len());
        let pick = |x: &Self, k: usize| match x.coefficients.get(k) {
            Some(c) => c.clone(),
            None => zero.clone(),
        };
        let coefficients = (0..length).map(|k| by(&pick(self, k), &pick(other, k))).collect();
        Self::of(coefficients, self.generator(other))
    }

    fn generator(&self, other: &Self) -> Option<Rc<Generator>> {
        self.of.clone().or_else(|| other.of.clone())
    }

    fn each(&self, by: impl Fn(&BigInt) -> BigInt) -> Self {
        Self::of(self.coefficients.iter().map(by).collect(), self.of.clone())
    }

    /// The coefficient of 1.
    fn constant(&self) -> BigInt {
        match self.coefficients.first() {
            Some(c) => c.clone(),
            None => BigInt::zero(),
        }
    }

    /// The number where it is written as an integer.
    fn rational(&self) -> Option<BigInt> {
        (self.coefficients.len() < 2).then(|| self.constant())
    }

    /// The row of the coefficients.
    fn row(&self, degree: usize) -> Matrix {
        let zeros = std::iter::repeat_with(BigInt::zero);
        let data = self.coefficients.iter().cloned().chain(zeros).take(degree).collect();
        Matrix { rows: 1, cols: degree, data, den: BigInt::one() }
    }

    /// The element with a polynomial of lower degree over a denominator.
    fn fraction(coefficients: &[Q], generator: &Rc<Generator>) -> Fraction<Self> {
        let den = coefficients.iter().fold(BigInt::one(), |l, c| lcm(&l, c.denom()));
        let whole = coefficients.iter().map(|c| c.numer() * (&den / c.denom())).collect();
        (Self::of(whole, Some(Rc::clone(generator))), den)
    }
}

impl Whole for Surd {
    type Ground = Ground;

    fn integer(k: BigInt) -> Self {
        Self::of(vec![k], None)
    }
    fn plus(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a + b)
    }
    fn minus(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a - b)
    }
    fn times(&self, other: &Self) -> Self {
        match (self.rational(), other.rational(), self.generator(other)) {
            (Some(c), ..) => other.multiple(&c),
            (_, Some(c), _) => self.multiple(&c),
            (_, _, None) => Self::of(Vec::new(), None),
            (_, _, Some(generator)) => {
                let m = &generator.polynomial;
                let (a, b, d) = (&self.coefficients, &other.coefficients, m.len() - 1);
                charge(a.len() * (b.len() + d), longest(a).max(longest(b)));
                let mut product = vec![BigInt::zero(); a.len() + b.len() - 1];
                for (i, x) in a.iter().enumerate() {
                    b.iter().enumerate().for_each(|(j, y)| product[i + j] += x * y);
                }
                while product.len() > d {
                    let shift = product.len() - 1 - d;
                    let Some(lead) = product.pop() else { break };
                    (0..d).for_each(|k| product[shift + k] -= &lead * &m[k]);
                }
                Self::of(product, Some(generator))
            }
        }
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        if !a.coefficients.is_empty() && !b.coefficients.is_empty() {
            *self = self.plus(&a.times(b));
        }
    }
    fn multiple(&self, factor: &BigInt) -> Self {
        self.each(|c| c * factor)
    }
    fn over(&self, divisor: &BigInt) -> Self {
        self.each(|c| c / divisor)
    }
    fn sgn(&self) -> i32 {
        match (self.rational(), &self.of) {
            (Some(c), _) => c.sgn(),
            (None, Some(generator)) => generator.sign(&self.coefficients),
            (None, None) => 0,
        }
    }
    fn content(&self) -> BigInt {
        self.coefficients.iter().fold(BigInt::zero(), |g, c| gcd(&g, c))
    }
    fn bits(&self) -> u64 {
        longest(&self.coefficients)
    }
    fn reciprocal(&self) -> Checked<Fraction<Self>> {
        let (None, Some(generator)) = (self.rational(), &self.of) else {
            let (sign, size) = self.constant().reciprocal()?;
            return Ok((Self::integer(sign), size));
        };
        let d = generator.field.degree();
        // Row k of the matrix is α^k times the number.
        let by_self = generator.field.multiplication(&self.row(d))?;
        let one = Matrix::ones(d, 1, |i, _| i == 0);
        let found = by_self.transpose().solve(&one)?;
        let Some(y) = found else {
            need(!self.vanishes(), "field", "a division by 0")?;
            return super::reject(
                "field",
                "the polynomial of the field is not irreducible, which is needed for a division",
            );
        };
        let common = gcd(&content(&y.data), &y.den);
        let coefficients = y.data.iter().map(|c| c / &common).collect();
        Ok((Self::of(coefficients, Some(Rc::clone(generator))), y.den / common))
    }
    fn short(numbers: Vec<Self>) -> Checked<Vec<Self>> {
        let mut numbers = numbers;
        if let Some(first) = numbers.iter().find(|x| !x.vanishes()).filter(|x| x.rational().is_none()) {
            let (inverse, _) = first.reciprocal()?;
            let positive = inverse.multiple(&BigInt::from(inverse.sgn()));
            numbers = numbers.iter().map(|x| x.times(&positive)).collect();
        }
        let common = content(&numbers);
        if !Zero::is_zero(&common) && !common.is_one() {
            numbers = numbers.iter().map(|x| x.over(&common)).collect();
        }
        Ok(numbers)
    }
    fn rounded(&self, den: &BigInt, places: u64) -> [BigInt; 2] {
        let (None, Some(generator)) = (self.rational(), &self.of) else {
            return self.constant().rounded(den, places);
        };
        let more = (places + self.bits() + 16).next_power_of_two();
        let [lo, hi] = generator.value(&self.coefficients, more);
        let scale = den << (more - places);
        [lo.div_floor(&scale), hi.div_ceil(&scale)]
    }
    fn layers(matrix: &Matrix<Self>) -> Vec<Matrix> {
        let degree = matrix.data.iter().fold(1, |d, x| d.max(x.coefficients.len()));
        let rows: Vec<Matrix> = matrix.data.iter().map(|x| x.row(degree)).collect();
        let layer = |k: usize| Matrix {
            rows: matrix.rows,
            cols: matrix.cols,
            data: rows.iter().map(|row| row.data[k].clone()).collect(),
            den: matrix.den.clone(),
        };
        (0..degree).map(layer).collect()
    }
    fn enclosed(column: &Matrix<Self>) -> Enclosed {
        const PLACES: u64 = 192;
        let ends: Vec<[BigInt; 2]> = column.data.iter().map(|x| x.rounded(&column.den, PLACES)).collect();
        let side = |k: usize| Matrix {
            rows: column.rows,
            cols: column.cols,
            data: ends.iter().map(|end| end[k].clone()).collect(),
            den: BigInt::one() << PLACES,
        };
        Enclosed { lo: side(0), hi: side(1) }
    }
    fn entry(node: &Node<'_>, ground: &Ground) -> Checked<Fraction<Self>> {
        if node.text().is_ok() {
            return Ok(fraction(&node.rational()?));
        }
        let degree = ground.generator.field.degree();
        let row = Field::coefficients(degree, node)?;
        node.need(row[1..].iter().any(|c| !c.is_zero()), "format", "a rational number is written as a text")?;
        Ok(Self::fraction(&row, &ground.generator))
    }
    fn given(node: &Node<'_>, ground: &Ground) -> Checked<Fraction<Self>> {
        expression::number(node, ground)
    }
    fn field(polynomial: &Node<'_>, interval: &Node<'_>, ground: &Ground) -> Checked<Field> {
        let [modulus, alpha, value] = polynomial.fields("modulus alpha value")?;
        let mut field = Field::read(&modulus, interval)?;
        let (a, x) = (field.element(&alpha)?, field.element(&value)?);
        let there = field.is_root(&ground.generator.field, &a)?;
        alpha.need(there, "field", "this is not seen to be the generator of the field of the case")?;
        let at = field.enclose(&x)?;
        field.value = [at.lo.at(0, 0), at.hi.at(0, 0)];
        (field.by_alpha, field.by_value) = (Some(field.multiplication(&a)?), field.multiplication(&x)?);
        Ok(field)
    }
    fn own(ground: &Ground) -> Checked<Field> {
        let own = &ground.generator.field;
        Ok(Field { by_alpha: Some(own.by_root.clone()), ..own.clone() })
    }
    fn plane(
        polynomial: &Node<'_>,
        ground: &Ground,
        root: impl FnOnce(&[Q]) -> Checked<[Interval; 2]>,
    ) -> Checked<(Field, [Interval; 2], [Interval; 2])> {
        let [modulus, alpha, value] = polynomial.fields("modulus alpha value")?;
        let m = Field::monic(&modulus, MAX_DEGREE)?;
        let square = root(&m)?;
        let mut field = Field::of(Field::companion(&m), square[0].clone());
        let (a, x) = (field.element(&alpha)?, field.element(&value)?);
        let own = &ground.generator.field;
        let image = field.substituted(own, &a)?.is_zero();
        let there = image && own.is_alone(&rectangle(&a, &square)?)?;
        alpha.need(there, "field", "this is not seen to be the generator of the field of the case")?;
        (field.by_alpha, field.by_value) = (Some(field.multiplication(&a)?), field.multiplication(&x)?);
        let at = rectangle(&x, &square)?;
        Ok((field, square, at))
    }
    fn common(node: &Node<'_>, dimension: usize, ground: &Ground) -> Checked<Option<Matrix<Self>>> {
        let own = node.list()?.iter().all(|item| item.list().is_ok() || item.text().is_ok());
        if !own && !is_plain(node)? {
            return Ok(None);
        }
        node.column(dimension, ground).map(Some)
    }
}

/// The real and the imaginary sides of a rectangle that holds the value of an element on another one.
fn rectangle(x: &Matrix, [re, im]: &[Interval; 2]) -> Checked<[Interval; 2]> {
    let [a, b] = values(x, re, im)?;
    Ok([[a.lo.at(0, 0), a.hi.at(0, 0)], [b.lo.at(0, 0), b.hi.at(0, 0)]])
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::base::Json;
    use num_traits::Signed;

    fn list(items: &[&str]) -> Json {
        Json::List(items.iter().map(|x| Json::Text((*x).to_owned())).collect())
    }

    /// A field with its numbers; the coefficients are those of certificates.
    pub fn read(polynomial: &[&str], interval: [&str; 2], numbers: &[&[&str]]) -> Checked<Ground> {
        let numbers = Json::List(numbers.iter().map(|x| list(x)).collect());
        let fields = [("polynomial", list(polynomial)), ("interval", list(&interval)), ("numbers", numbers)];
        let value = Json::Object(fields.map(|(key, value)| (key.to_owned(), value)).into());
        Ground::read(&Node { value: &value, place: String::new() })
    }

    pub fn ground(polynomial: &[&str], interval: [&str; 2], numbers: &[&[&str]]) -> Ground {
        read(polynomial, interval, numbers).unwrap()
    }

    fn element(of: &Ground, coefficients: &[i64]) -> Surd {
        Surd::of(coefficients.iter().map(|c| BigInt::from(*c)).collect(), Some(Rc::clone(&of.generator)))
    }

    #[test]
    fn signs_are_exact() {
        let root = ground(&["-2", "0", "1"], ["1", "2"], &[]);
        // Convergents of the square root of 2, from both sides.
        let (mut p, mut q) = (BigInt::one(), BigInt::one());
        for k in 0..400 {
            let x = Surd::of(vec![p.clone(), -&q], Some(Rc::clone(&root.generator)));
            assert_eq!(x.sgn(), if k % 2 == 0 { -1 } else { 1 }, "{k}");
            (p, q) = (&p + 2 * &q, p + q);
        }
        let x = element(&root, &[3, 2]);
        let (y, n) = x.reciprocal().unwrap();
        assert!(n.is_positive() && x.times(&y).minus(&Surd::integer(n)).vanishes());
        assert_eq!(x.rounded(&BigInt::one(), 0), [BigInt::from(5), BigInt::from(6)]);
        assert_eq!(element(&root, &[0, -1]).rounded(&BigInt::from(2), 1), [BigInt::from(-2), BigInt::from(-1)]);
    }

    /// `(x² − 2)(x − 1)(x + 3)` at `√2`: elements that are 0 there without having the coefficients 0, and others that share a
    /// factor with the polynomial without being 0.
    #[test]
    fn a_reducible_polynomial_proves_nothing_false() {
        let field = ground(&["6", "-4", "-5", "2", "1"], ["5/4", "3/2"], &[]);
        let zero = element(&field, &[-2, 0, 1]);
        assert!(zero.vanishes() && zero.reciprocal().is_err());
        let divisor = element(&field, &[-1, 1]);
        assert!(divisor.sgn() == 1 && divisor.reciprocal().is_err());
        let other = element(&field, &[3, 4, 1]);
        assert!(other.sgn() == 1 && other.reciprocal().is_err());
        let unit = element(&field, &[5, 1]);
        let (y, n) = unit.reciprocal().unwrap();
        assert!(unit.times(&y).minus(&Surd::integer(n)).vanishes());
        // Equality is that of numbers: α³ = 2α.
        let power = element(&field, &[0, 0, 0, 1]);
        assert!(power.minus(&element(&field, &[0, 2])).vanishes());
    }

    #[test]
    fn fields_of_cases_are_isolated_and_integral() {
        for (polynomial, interval) in [
            (&["-2", "0", "1"][..], ["-2", "2"]),
            (&["-2", "0", "1"], ["3", "4"]),
            (&["-2", "0", "2"], ["1", "2"]),
            (&["-1/2", "0", "1"], ["0", "1"]),
            (&["-2", "1"], ["2", "2"]),
            (&["-2", "0", "1"], ["2", "1"]),
        ] {
            assert!(read(polynomial, interval, &[]).is_err(), "{polynomial:?} {interval:?}");
        }
        assert!(read(&["-2", "0", "1"], ["1", "2"], &[&["1", "0"]]).is_err(), "zeros at the end");
        assert!(read(&["-2", "0", "1"], ["1", "2"], &[&["1"]]).is_err(), "a rational as a list");
    }

    #[test]
    fn matrices_over_a_field() {
        let f = ground(&["-2", "0", "1"], ["1", "2"], &[]);
        let m = |rows: &[&[i64]]| {
            let data = rows.iter().map(|x| element(&f, x)).collect();
            Matrix { rows: 2, cols: 2, data, den: BigInt::from(3) }
        };
        // Rows (√2, 2) and (1, √2): of rank 1, with the kernel (√2, −1).
        let singular = m(&[&[0, 1], &[2], &[1], &[0, 1]]);
        assert_eq!(singular.rank().unwrap(), 1);
        assert!(singular.times(&singular.kernel().unwrap().transpose()).unwrap().is_zero());
        let a = m(&[&[1, 1], &[2], &[1], &[0, 3]]);
        let inverse = a.solve(&Matrix::identity(2)).unwrap().unwrap();
        assert_eq!(a.times(&inverse).unwrap(), Matrix::identity(2));
        // Cayley and Hamilton.
        let chi = a.characteristic().unwrap();
        let sum = (0..3).rev().fold(Matrix::zeros(2, 2), |sum: Matrix<Surd>, k| {
            sum.times(&a).unwrap().plus(&Q::one(), &Matrix::identity(2).multiple(&chi.columns(&[k])))
        });
        assert!(sum.is_zero());
        // (1, √2; √2, 3) is positive definite, (1, √2; √2, 2) is not.
        assert!(m(&[&[1], &[0, 1], &[0, 1], &[3]]).is_positive(true).unwrap());
        let flat = m(&[&[1], &[0, 1], &[0, 1], &[2]]);
        assert!(!flat.is_positive(true).unwrap() && flat.is_positive(false).unwrap());
    }
}
