//! Numbers `x + y r` with the root `r` of a rational, as Coq computes with them (`proofs/theories/Quadratic.v`): sums and products
//! are exact, signs come from an interval that holds `r`.

use crate::algebraic::field::square_part;
use crate::algebraic::{Elem, Root, sqrt_down};
use crate::arith::{Rational, sign};
use crate::linalg::{Matrix, dot};
use crate::theorem::{Direction, primitive};

/// The root of a rational, and an interval that holds it; where all numbers are rational the root is 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Field {
    pub radicand: Rational,
    pub below: Rational,
    pub above: Rational,
}

/// `plain + rooted r`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pair {
    pub plain: Rational,
    pub rooted: Rational,
}

/// A vector of pairs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pairs {
    pub plain: Vec<Rational>,
    pub rooted: Vec<Rational>,
}

fn zero() -> Rational {
    Rational::from(0)
}

/// `−b/2` and `r` with the radicand of `x = −b/2 ± r √radicand`, for the roots of `x² + bx + c`.
fn completed(at: &Root) -> (Rational, Rational, Rational) {
    let half = -at.minpoly().coeff(1) / Rational::from(2);
    let (factor, core) = square_part(&(&half * &half - at.minpoly().coeff(0)));
    (half, factor, Rational::from(core))
}

impl Field {
    pub fn rational() -> Self {
        Self { radicand: zero(), below: zero(), above: zero() }
    }

    /// The field of numbers of degree 1 and 2, with an interval of so many binary places.
    pub fn of<'a>(numbers: impl IntoIterator<Item = &'a Root>, bits: u64) -> Result<Self, String> {
        let mut field = Self::rational();
        for number in numbers.into_iter().filter(|x| x.degree() > 1) {
            if number.degree() > 2 {
                return Err(format!("an irrational number of degree {}", number.degree()));
            }
            let (_, _, radicand) = completed(number);
            if sign(&radicand) <= 0 {
                return Err("a complex eigenvalue".to_owned());
            }
            if !field.is_rational() && field.radicand != radicand {
                return Err("irrational numbers of two fields".to_owned());
            }
            let below = sqrt_down(&radicand, bits);
            field = Self { radicand, above: &below + (Rational::from(1) >> bits), below };
        }
        Ok(field)
    }

    pub fn is_rational(&self) -> bool {
        self.radicand == 0
    }

    pub fn middle(&self) -> Rational {
        (&self.below + &self.above) / Rational::from(2)
    }

    pub fn spread(&self) -> Rational {
        (&self.above - &self.below) / Rational::from(2)
    }

    /// An element of the field of `at`, where that is this one.
    pub fn pair(&self, x: &Elem, at: &Root) -> Option<Pair> {
        if let Some(plain) = x.is_rational() {
            return Some(Pair { plain, rooted: zero() });
        }
        let (half, factor, radicand) = completed(at);
        if at.degree() != 2 || radicand != self.radicand {
            return None;
        }
        let (constant, slope) = (x.0.coeff(0), x.0.coeff(1));
        let above = Elem::generator(at.minpoly()).sub(&Elem::from_rational(&half)).sign(at);
        Some(Pair { plain: constant + &slope * half, rooted: slope * factor * Rational::from(above) })
    }

    /// The ray of a direction, by coprime integers where it is rational.
    pub fn direction(&self, d: &Direction) -> Option<Pairs> {
        if let Some(coords) = d.rational() {
            return Some(Pairs::rational(primitive(&coords)));
        }
        let pairs = d.normalised().coords.iter().map(|x| self.pair(x, &d.root)).collect::<Option<Vec<_>>>()?;
        Some(Pairs {
            plain: pairs.iter().map(|x| x.plain.clone()).collect(),
            rooted: pairs.into_iter().map(|x| x.rooted).collect(),
        })
    }

    /// The least and the most that a pair can be.
    fn range(&self, x: &Pair) -> (Rational, Rational) {
        let (a, b) = (&x.plain + &self.below * &x.rooted, &x.plain + &self.above * &x.rooted);
        if a <= b { (a, b) } else { (b, a) }
    }

    /// The sign, 0 for 0 alone; `None` where the interval does not tell it.
    pub fn sign(&self, x: &Pair) -> Option<i32> {
        let (least, most) = self.range(x);
        if least > 0 {
            Some(1)
        } else if most < 0 {
            Some(-1)
        } else {
            x.is_zero().then_some(0)
        }
    }

    /// A number that the modulus is not below.
    pub fn modulus(&self, x: &Pair) -> Rational {
        let (least, most) = self.range(x);
        if least > 0 { least } else { -most }
    }

    pub fn times(&self, x: &Pair, y: &Pair) -> Pair {
        Pair {
            plain: &x.plain * &y.plain + &self.radicand * (&x.rooted * &y.rooted),
            rooted: &x.plain * &y.rooted + &x.rooted * &y.plain,
        }
    }

    /// `1/x`, where `x` is not 0.
    pub fn inverse(&self, x: &Pair) -> Option<Pair> {
        let norm = &x.plain * &x.plain - &self.radicand * (&x.rooted * &x.rooted);
        (norm != 0).then(|| Pair { plain: &x.plain / &norm, rooted: -&x.rooted / norm })
    }

    pub fn scaled(&self, x: &Pairs, factor: &Pair) -> Pairs {
        let entries: Vec<Pair> = (0..x.plain.len()).map(|i| self.times(&x.entry(i), factor)).collect();
        Pairs {
            plain: entries.iter().map(|x| x.plain.clone()).collect(),
            rooted: entries.into_iter().map(|x| x.rooted).collect(),
        }
    }

    pub fn dot(&self, x: &Pairs, y: &Pairs) -> Pair {
        Pair {
            plain: dot(&x.plain, &y.plain) + &self.radicand * dot(&x.rooted, &y.rooted),
            rooted: dot(&x.plain, &y.rooted) + dot(&x.rooted, &y.plain),
        }
    }

    /// The rational vector between.
    pub fn mid(&self, x: &Pairs) -> Vec<Rational> {
        let middle = self.middle();
        x.plain.iter().zip(&x.rooted).map(|(a, b)| a + &middle * b).collect()
    }

    /// The number, not 0, by which one vector is a multiple of the other.
    pub fn quotient(&self, x: &Pairs, y: &Pairs) -> Option<Pair> {
        let lead = (0..y.plain.len()).find(|i| !y.entry(*i).is_zero())?;
        let factor = self.times(&x.entry(lead), &self.inverse(&y.entry(lead))?);
        (!factor.is_zero() && self.scaled(y, &factor) == *x).then_some(factor)
    }

    /// The ray of a vector, by coprime integers where it is rational, and the positive number by which it was divided.
    pub fn reduced(&self, x: &Pairs) -> Option<(Pairs, Pair)> {
        let lead = (0..x.plain.len()).find(|i| !x.entry(*i).is_zero())?;
        let ray = if x.rooted.iter().all(|y| *y == 0) {
            Pairs::rational(primitive(&x.plain))
        } else {
            let inverse = self.inverse(&x.entry(lead))?;
            let ray = self.scaled(x, &inverse);
            if self.sign(&inverse)? < 0 { ray.negated() } else { ray }
        };
        let factor = self.quotient(x, &ray)?;
        Some((ray, factor))
    }

    /// Two coordinates in which the vectors are independent, as the interval shows.
    pub fn independent(&self, x: &Pairs, y: &Pairs) -> Option<(usize, usize)> {
        let mut pairs = (0..x.plain.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        pairs.find(|(i, j)| {
            let (a, b) = (self.times(&x.entry(*i), &y.entry(*j)), self.times(&x.entry(*j), &y.entry(*i)));
            let minor = Pair { plain: a.plain - b.plain, rooted: a.rooted - b.rooted };
            self.sign(&minor).is_some_and(|s| s != 0)
        })
    }
}

impl Pair {
    pub fn is_zero(&self) -> bool {
        self.plain == 0 && self.rooted == 0
    }
}

impl Pairs {
    pub fn rational(plain: Vec<Rational>) -> Self {
        let rooted = vec![zero(); plain.len()];
        Self { plain, rooted }
    }

    pub fn entry(&self, i: usize) -> Pair {
        Pair { plain: self.plain[i].clone(), rooted: self.rooted[i].clone() }
    }

    pub fn negated(&self) -> Self {
        let opposite = |v: &[Rational]| v.iter().map(|x| -x).collect();
        Self { plain: opposite(&self.plain), rooted: opposite(&self.rooted) }
    }

    pub fn under(&self, m: &Matrix) -> Self {
        Self { plain: m.apply(&self.plain), rooted: m.apply(&self.rooted) }
    }

    pub fn before(&self, m: &Matrix) -> Self {
        Self { plain: m.apply_left(&self.plain), rooted: m.apply_left(&self.rooted) }
    }
}
