//! Real numbers that know their number field, as entries of matrices.

use super::Elem;
use super::field::NumberField;
use crate::arith::{Interval, Rational, to_f64};
use crate::linalg::{Echelon, Entry, Matrix, Products};
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Binary digits to which sizes are bounded.
const BITS: u64 = 96;

/// A rational number, or an irrational one in a real number field `Q(α)`.
///
/// Irrational numbers that meet lie in one field: those of a case are put into one field when it is read. Comparisons are
/// exact: 0 is an identity in the field, and signs come from enclosures of numbers that are not 0.
///
/// ```
/// use secant_exact::{algebraic::Real, linalg::Entry};
///
/// let x = Real::read(&["sqrt(3)/6", "1/3"]).unwrap();
/// assert!(x[0] < x[1] && x[0].times(&x[0]).rational().is_some());
/// assert_eq!(x[0].to_string(), "1/6*sqrt(3)");
/// ```
#[derive(Clone)]
pub struct Real(Value);

#[derive(Clone)]
enum Value {
    Rational(Rational),
    Irrational(Arc<NumberField>, Elem),
}

impl Real {
    /// An element of a field.
    #[must_use]
    pub fn new(field: &Arc<NumberField>, x: Elem) -> Self {
        match x.is_rational() {
            Some(q) => Self(Value::Rational(q)),
            None => Self(Value::Irrational(Arc::clone(field), x)),
        }
    }

    /// Reads expressions such as `sqrt(5)`, all in one field.
    ///
    /// # Errors
    /// As [`NumberField::read`].
    pub fn read(texts: &[&str]) -> Result<Vec<Self>, (usize, super::field::ExpressionError)> {
        let (field, elements) = NumberField::read(texts)?;
        let field = Arc::new(field);
        Ok(elements.into_iter().map(|x| Self::new(&field, x)).collect())
    }

    /// The field of an irrational number.
    #[must_use]
    pub fn field(&self) -> Option<&Arc<NumberField>> {
        match &self.0 {
            Value::Rational(_) => None,
            Value::Irrational(field, _) => Some(field),
        }
    }

    /// The number as a polynomial in the generator of its field.
    #[must_use]
    pub fn elem(&self) -> Elem {
        match &self.0 {
            Value::Rational(q) => Elem::from_rational(q),
            Value::Irrational(_, x) => x.clone(),
        }
    }

    /// The field of the irrational ones among some numbers.
    pub fn field_of<'a>(numbers: impl IntoIterator<Item = &'a Self>) -> Option<Arc<NumberField>> {
        numbers.into_iter().find_map(Self::field).cloned()
    }

    /// What a field operation makes of two numbers one of which is irrational.
    fn with(&self, other: &Self, f: impl FnOnce(&NumberField, &Elem, &Elem) -> Elem) -> Self {
        let field = match (self.field(), other.field()) {
            (Some(a), Some(b)) => {
                assert!(Arc::ptr_eq(a, b) || a.same(b), "one field");
                a
            }
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => unreachable!("one of the numbers is irrational"),
        };
        Self::new(field, f(field, &self.elem(), &other.elem()))
    }
}

/// The rational matrix, or the field and the matrix over it.
fn told_apart(a: &Matrix<Real>) -> Result<Matrix, Arc<NumberField>> {
    match Real::field_of(a.entries()) {
        Some(field) => Err(field),
        None => Ok(a.map(|x| x.elem().is_rational().expect("no irrational entry"))),
    }
}

fn lifted(field: &Arc<NumberField>, a: Echelon<Elem>) -> Echelon<Real> {
    Echelon { rows: a.rows.map(|x| Real::new(field, x.clone())), pivots: a.pivots }
}

impl Entry for Real {
    type Product = Matrix<Self>;

    fn of(q: &Rational) -> Self {
        Self(Value::Rational(q.clone()))
    }

    fn rational(&self) -> Option<Rational> {
        match &self.0 {
            Value::Rational(q) => Some(q.clone()),
            Value::Irrational(..) => None,
        }
    }

    fn plus(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => Self(Value::Rational(a + b)),
            _ => self.with(other, |_, a, b| a.add(b)),
        }
    }

    fn minus(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => Self(Value::Rational(a - b)),
            _ => self.with(other, |_, a, b| a.sub(b)),
        }
    }

    fn times(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => Self(Value::Rational(a * b)),
            _ => self.with(other, NumberField::mul),
        }
    }

    fn over(&self, other: &Self) -> Option<Self> {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => a.over(b).map(|x| Self(Value::Rational(x))),
            _ if Entry::is_zero(other) => None,
            _ => Some(self.with(other, |field, a, b| field.div(a, b).expect("not 0"))),
        }
    }

    fn sign(&self) -> i32 {
        match &self.0 {
            Value::Rational(q) => crate::arith::sign(q),
            Value::Irrational(field, x) => field.sign(x),
        }
    }

    fn enclosure(&self, bits: u64) -> Interval {
        match &self.0 {
            Value::Rational(q) => Interval::point(q.clone()),
            Value::Irrational(field, x) => field.enclosure(x, bits),
        }
    }

    fn dot(a: &[Self], b: &[Self]) -> Self {
        let used = a.iter().zip(b).filter(|(x, y)| !Entry::is_zero(*x) && !Entry::is_zero(*y));
        used.fold(Self::zero(), |s, (x, y)| s.plus(&x.times(y)))
    }

    fn apply(a: &Matrix<Self>, v: &[Self]) -> Vec<Self> {
        (0..a.rows()).map(|i| Self::dot(a.row(i), v)).collect()
    }

    fn apply_left(v: &[Self], a: &Matrix<Self>) -> Vec<Self> {
        (0..a.cols()).map(|j| Self::dot(v, &a.column(j))).collect()
    }

    fn product(a: &Matrix<Self>, b: &Matrix<Self>) -> Matrix<Self> {
        match (told_apart(a), told_apart(b)) {
            (Ok(a), Ok(b)) => (&a * &b).map(Self::of),
            _ => {
                let columns: Vec<Vec<Self>> = (0..b.cols()).map(|j| b.column(j)).collect();
                Matrix::from_fn(a.rows(), b.cols(), |i, j| Self::dot(a.row(i), &columns[j]))
            }
        }
    }

    fn echelon(a: &Matrix<Self>) -> Echelon<Self> {
        match told_apart(a) {
            Ok(a) => {
                let Echelon { rows, pivots } = a.echelon();
                Echelon { rows: rows.map(Self::of), pivots }
            }
            Err(field) => {
                let found = a.map(Self::elem).echelon_over(&*field).expect("numbers of a field are told from 0");
                lifted(&field, found)
            }
        }
    }

    fn pivots(a: &Matrix<Self>) -> Vec<usize> {
        match told_apart(a) {
            Ok(a) => a.pivots(),
            Err(_) => Self::echelon(a).pivots,
        }
    }

    fn is_zero(&self) -> bool {
        matches!(&self.0, Value::Rational(q) if *q == 0)
    }
}

/// A bound of the sum of absolute values.
fn size<'a>(numbers: impl Iterator<Item = &'a Real>) -> Rational {
    numbers.fold(Rational::from(0), |s, x| s + x.enclosure(BITS).magnitude())
}

impl Products<Real> for Matrix<Real> {
    fn of(matrix: &Self) -> Self {
        matrix.clone()
    }

    fn column(vector: &[Real]) -> Self {
        Self::from_columns(vector.len(), &[vector.to_vec()])
    }

    fn identity(n: usize) -> Self {
        Self::identity(n)
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn reduced(&self) -> Self {
        self.clone()
    }

    fn distance1(&self, other: &Self) -> Rational {
        size((self - other).entries().iter())
    }

    fn half_distance(&self) -> Rational {
        let distance = |i: usize, j: usize| {
            let terms: Vec<Real> = (0..self.rows()).map(|k| self[(k, i)].minus(&self[(k, j)])).collect();
            size(terms.iter())
        };
        let pairs = (0..self.cols()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| distance(i, j)).fold(Rational::from(0), Rational::max) / Rational::from(2)
    }

    fn range(&self, row: &[Real], bits: u64) -> Option<Interval> {
        let values = self.apply_left(row);
        Some(Interval { lo: values.iter().min()?.enclosure(bits).lo, hi: values.iter().max()?.enclosure(bits).hi })
    }
}

impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => a == b,
            (Value::Irrational(f, a), Value::Irrational(g, b)) => {
                assert!(Arc::ptr_eq(f, g) || f.same(g), "one field");
                a == b
            }
            _ => false,
        }
    }
}

impl Eq for Real {}

impl Hash for Real {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.elem().hash(state);
    }
}

impl Ord for Real {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Value::Rational(a), Value::Rational(b)) => a.cmp(b),
            _ => Entry::sign(&self.minus(other)).cmp(&0),
        }
    }
}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<Rational> for Real {
    fn from(q: Rational) -> Self {
        Self(Value::Rational(q))
    }
}

/// An expression that [`NumberField::read`] understands.
impl fmt::Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (field, x) = match &self.0 {
            Value::Rational(q) => return q.fmt(f),
            Value::Irrational(field, x) => (field, x),
        };
        let name = field.text();
        // A power of a product needs brackets.
        let base = if name.contains('*') && !name.starts_with("root(") { format!("({name})") } else { name.clone() };
        for (k, c) in x.0.coeffs().iter().enumerate().filter(|(_, c)| **c != 0) {
            let first = x.0.coeffs()[..k].iter().all(|c| *c == 0);
            f.write_str(if *c < 0 {
                "-"
            } else if first {
                ""
            } else {
                "+"
            })?;
            let size = crate::arith::abs(c);
            let power = match k {
                0 => String::new(),
                1 => name.clone(),
                _ => format!("{base}^{k}"),
            };
            match (k, size == 1) {
                (0, _) => write!(f, "{size}")?,
                (_, true) => f.write_str(&power)?,
                (_, false) => write!(f, "{size}*{power}")?,
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The nearest double, for display and for proposals, never for deciding.
#[must_use]
pub fn nearest<E: Entry>(x: &E) -> f64 {
    to_f64(&x.enclosure(80).mid())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn the_embedding_is_part_of_the_number() {
        let x = Real::read(&["sqrt(5)", "root(x^2-5, -3, -2)", "9/4", "0"]).unwrap();
        assert!(x[2] > x[0].minus(&x[3]).over(&Real::of(&ratio(1, 1))).unwrap());
        assert_eq!(x[0].plus(&x[1]), x[3]);
        assert!(x[1] < x[3] && x[3] < x[0]);
        assert_eq!(x[0].over(&x[1]).unwrap().rational(), Some(ratio(-1, 1)));
        assert_eq!(x[0].over(&x[3]), None);
    }

    #[test]
    fn texts_are_read_back() {
        let texts = ["(1-sqrt(5))/2", "-1/3*sqrt(5)", "3", "2-sqrt(5)"];
        let numbers = Real::read(&texts).unwrap();
        let shown: Vec<String> = numbers.iter().map(ToString::to_string).collect();
        assert_eq!(shown, ["1/2-1/2*sqrt(5)", "-1/3*sqrt(5)", "3", "2-sqrt(5)"]);
        assert_eq!(Real::read(&shown.iter().map(String::as_str).collect::<Vec<_>>()).unwrap(), numbers);
        let cubic = Real::read(&["root(x^3-x-1, 1, 2)^2-1/2", "1"]).unwrap();
        let again = Real::read(&[&cubic[0].to_string()]).unwrap();
        assert_eq!(cubic[0], again[0]);
    }

    #[test]
    fn one_elimination_for_both_kinds() {
        let x = Real::read(&["sqrt(2)", "2", "1", "sqrt(2)"]).unwrap();
        let a = Matrix::from_fn(2, 2, |i, j| x[2 * i + j].clone());
        assert_eq!((a.rank(), a.kernel().cols()), (1, 1));
        assert!((&a * &a.kernel()).is_zero());
        let b = a.map(|x| x.times(&x.clone()));
        assert_eq!(b.rank(), 1);
        assert_eq!((&b - &b), Matrix::zero(2, 2));
    }
}
