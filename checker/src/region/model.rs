//! Functions on a short interval, by two terms and a bound of the rest.

use crate::base::{Checked, Q, spend};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Binary places.
pub const BITS: usize = 96;

/// All functions within `rest` of `mid + slope t`, `-1 <= t <= 1`, in units of `2^-BITS`.
#[derive(Debug, Clone)]
pub struct Model {
    pub mid: BigInt,
    pub slope: BigInt,
    pub rest: BigInt,
}

pub fn unit() -> BigInt {
    BigInt::one() << BITS
}

fn down(x: &BigInt) -> BigInt {
    x >> BITS
}

impl Model {
    pub fn zero() -> Self {
        Self { mid: BigInt::zero(), slope: BigInt::zero(), rest: BigInt::zero() }
    }

    pub fn one() -> Self {
        Self { mid: unit(), ..Self::zero() }
    }

    /// `mid + slope t`, with a distance.
    pub fn line(mid: &Q, slope: &Q, rest: &Q) -> Self {
        let floor = |q: &Q| (q.numer() << BITS).div_floor(q.denom());
        let ceiling = |q: &Q| -floor(&-q);
        // Rounding down loses less than a unit of each.
        Self { mid: floor(mid), slope: floor(slope), rest: ceiling(rest) + 2 }
    }

    pub fn constant(q: &Q) -> Self {
        Self::line(q, &Q::zero(), &Q::zero())
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self { mid: &self.mid + &other.mid, slope: &self.slope + &other.slope, rest: &self.rest + &other.rest }
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self { mid: &self.mid - &other.mid, slope: &self.slope - &other.slope, rest: &self.rest + &other.rest }
    }

    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (self, other);
        let second = (&a.slope * &b.slope).abs();
        let rest = second + &b.rest * (a.mid.abs() + a.slope.abs() + &a.rest) + &a.rest * (b.mid.abs() + b.slope.abs());
        Self {
            mid: down(&(&a.mid * &b.mid)),
            slope: down(&(&a.mid * &b.slope + &a.slope * &b.mid)),
            // One for rounding up, one for each of the two above.
            rest: down(&rest) + 3,
        }
    }

    /// A bound of the modulus.
    pub fn size(&self) -> BigInt {
        self.mid.abs() + self.slope.abs() + &self.rest
    }

    /// 1 or −1 where all values have that sign, otherwise 0.
    pub fn sign(&self) -> i32 {
        if self.mid.abs() <= self.slope.abs() + &self.rest {
            return 0;
        }
        if self.mid.is_positive() { 1 } else { -1 }
    }
}

pub fn dot(a: &[Model], b: &[Model]) -> Checked<Model> {
    spend(6 * a.len(), 2 * BITS as u64)?;
    Ok(a.iter().zip(b).fold(Model::zero(), |s, (x, y)| s.plus(&x.times(y))))
}

/// A matrix by rows times a vector.
pub fn image(m: &[Vec<Model>], v: &[Model]) -> Checked<Vec<Model>> {
    m.iter().map(|row| dot(row, v)).collect()
}

pub fn product(a: &[Vec<Model>], b: &[Vec<Model>]) -> Checked<Vec<Vec<Model>>> {
    let columns: Vec<Vec<Model>> = (0..b.len()).map(|j| b.iter().map(|row| row[j].clone()).collect()).collect();
    a.iter().map(|row| columns.iter().map(|c| dot(row, c)).collect()).collect()
}

/// The coefficients of `det(x − m)`, lowest first (Berkowitz).
pub fn characteristic(m: &[Vec<Model>]) -> Checked<Vec<Model>> {
    // Highest first, for the leading submatrices.
    let mut high = vec![Model::one()];
    for r in 0..m.len() {
        let mut toeplitz = vec![Model::one(), Model::zero().minus(&m[r][r])];
        let mut column: Vec<Model> = (0..r).map(|i| m[i][r].clone()).collect();
        for _ in 0..r {
            toeplitz.push(Model::zero().minus(&dot(&m[r][..r], &column)?));
            column = (0..r).map(|i| dot(&m[i][..r], &column)).collect::<Checked<_>>()?;
        }
        let mut next = Vec::new();
        for k in 0..r + 2 {
            let terms: Vec<usize> = (0..high.len().min(k + 1)).collect();
            let (a, b): (Vec<Model>, Vec<Model>) =
                terms.iter().map(|j| (toeplitz[k - j].clone(), high[*j].clone())).unzip();
            next.push(dot(&a, &b)?);
        }
        high = next;
    }
    high.reverse();
    Ok(high)
}

/// A polynomial with rational coefficients.
pub fn value(f: &[Q], x: &Model) -> Model {
    f.iter().rev().fold(Model::zero(), |v, c| v.times(x).plus(&Model::constant(c)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::whole;

    #[test]
    fn models_hold_values() {
        crate::base::number::refill();
        let q = |a: i64, b: i64| Q::new(a.into(), b.into());
        let x = Model::line(&q(1, 3), &q(1, 5), &Q::zero());
        let f = [q(1, 7), whole(-3), Q::zero(), whole(2)];
        let m = value(&f, &x);
        for k in -10..=10 {
            let t = q(k, 10);
            let p = q(1, 3) + q(1, 5) * &t;
            let exact = f.iter().rev().fold(Q::zero(), |v, c| v * &p + c);
            let line = (Q::from(m.mid.clone()) + Q::from(m.slope.clone()) * t) / Q::from(unit());
            assert!((line - exact).abs() <= Q::from(m.rest.clone()) / Q::from(unit()), "{k}");
        }
        // The eigenvalues 2 and 3.
        let two = |a: i64, b: i64| vec![Model::constant(&whole(a)), Model::constant(&whole(b))];
        let chi = characteristic(&[two(2, 7), two(0, 3)]).unwrap();
        let near = |m: &Model, k: i64| (&m.mid - unit() * k).abs() <= &m.rest + BigInt::one();
        assert!(near(&chi[0], 6) && near(&chi[1], -5) && near(&chi[2], 1));
    }
}
