//! Masks whose coefficients are known by enclosures: irrational filters, and decimals.
//!
//! The joint spectral radius is bounded for rational matrices near the true ones, and the bounds are widened by what the
//! difference can do.

use super::regularity::{digits, minus_log};
use crate::arith::{Integer, Interval, Rational, abs};
use crate::linalg::Matrix;
use crate::radius::{JointRadius, Leading, Lower, Options, System, joint_radius};
use malachite_base::num::arithmetic::traits::Square;

/// The regularity of the mask `(1 + z + … + z^{N−1})^K b(z)`, with bounds that hold for every `b` in the enclosures.
#[derive(Debug, Clone)]
pub struct Enclosed {
    /// The arity `N`.
    pub arity: usize,
    /// The order `K` of the sum rules that are known.
    pub sum_rules: usize,
    /// Enclosures of the coefficients of `b`.
    pub factor: Vec<Interval>,
    /// The radius of the rational matrices near the true ones.
    pub radius: JointRadius,
    /// Enclosure of the true joint spectral radius.
    pub enclosure: Interval,
    /// Enclosure of the Hölder exponent of the scheme, `−log_N` of the radius.
    pub exponent: Interval,
}

/// Binary places of the coefficients.
pub const BITS: u64 = 160;

/// Bounds the joint spectral radius of the matrices of `b`; `None` where no bounds could be established.
///
/// # Cost
/// One joint spectral radius of matrices of about the length of `b`.
#[must_use]
pub fn enclosed(factor: Vec<Interval>, arity: usize, sum_rules: usize, options: &Options) -> Option<Enclosed> {
    let middle: Vec<Rational> = factor.iter().map(|x| grid(&x.mid())).collect();
    let error = factor.iter().zip(&middle).map(|(x, m)| (x - &Interval::point(m.clone())).magnitude()).max()?;
    let system = System::plain(&digits(&middle, arity)).ok()?;
    let radius = joint_radius(&system, options).ok()?;
    let enclosure = Interval::new(below(&system, &radius, &error)?, above(&system, &radius, &error)?);
    let exponent = minus_log(&enclosure, arity)?;
    Some(Enclosed { arity, sum_rules, factor, radius, enclosure, exponent })
}

fn grid(x: &Rational) -> Rational {
    Interval::point(x.clone()).outward(BITS).lo
}

/// The bound of the rational matrices, widened for a change of every entry by at most `error`.
fn above(system: &System, radius: &JointRadius, error: &Rational) -> Option<Rational> {
    let mut largest = Rational::from(0);
    for part in &radius.blocks {
        // Blocks must be principal parts, on which the true matrices have the same zeros.
        if radius.blocks.len() > 1 || part.block.system.dims != system.dims {
            return None;
        }
        let mut entries = system.arrows.iter().flat_map(|a| (0..a.matrix.rows()).flat_map(|i| a.matrix.row(i)));
        if entries.any(|x| *x != 0 && abs(x) <= *error) {
            return None;
        }
        largest = largest.max(part.proof.as_ref()?.bound_near(&part.block.system, error)?);
    }
    Some(largest)
}

/// A true eigenvalue of the leading word near that of the rational matrices, by a change of sign of `det(x − T_w)` that the
/// difference of the matrices cannot undo.
fn below(system: &System, radius: &JointRadius, error: &Rational) -> Option<Rational> {
    let lower = radius.lower.as_ref()?;
    let Some(root) = lower.root().filter(|r| r.is_real()) else { return turning(system, lower, error) };
    let product = system.product(&lower.path);
    let n = product.rows();
    let count = Rational::from((n * n) as u64);
    // 1-norms: ‖T‖ and the change of a product of that many factors, each changed by at most n · error.
    let size = system.arrows.iter().map(|a| norm(&a.matrix)).max()? + Rational::from(1);
    let mut change = &count * error * Rational::from(lower.length as u64);
    for _ in 1..lower.length {
        change *= &size;
    }
    let value = root.enclosure(BITS).0.mid();
    let changes = |step: &Rational| sign_change(&product, &value, step, &change);
    // The nearer the two sides, the better the bound; the coefficients may allow none that is very near.
    let steps = (1..=12_u64).rev().map(|k| abs(&value) / Rational::from(Integer::from(1) << (5 * k)));
    let step = steps.into_iter().find(changes)?;
    Some(crate::radius::root_floor(&(abs(&value) - step), lower.length, 96))
}

/// Whether `det(x − M)` has different signs at `value ± step` for all `M` that differ from the product by at most `change` in the
/// 1-norm.
fn sign_change(product: &Matrix, value: &Rational, step: &Rational, change: &Rational) -> bool {
    let n = product.rows();
    let mut signs = Vec::new();
    for x in [value - step, value + step] {
        let shifted = &Matrix::identity(n).scale(&x) - product;
        let det = shifted.determinant();
        // |det(A + E) − det A| <= n ‖E‖ (‖A‖ + ‖E‖)^{n−1} in the 1-norm.
        let mut allowance = Rational::from(n as u64) * change;
        for _ in 1..n {
            allowance *= norm(&shifted) + change;
        }
        if abs(&det) <= allowance {
            return false;
        }
        signs.push(det > 0);
    }
    signs[0] != signs[1]
}

/// The same for an eigenvalue that is not real: with the characteristic polynomial `χ` of the true product enclosed by intervals,
/// some eigenvalue lies within `n |χ/χ'|` of any point.
fn turning(system: &System, lower: &Lower, error: &Rational) -> Option<Rational> {
    let wide = |x: &Rational| match *x == 0 {
        true => Interval::point(x.clone()),
        false => Interval::new(x - error, x + error),
    };
    let of = |k: usize| -> Vec<Vec<Interval>> {
        let m = &system.arrows[k].matrix;
        (0..m.rows()).map(|i| m.row(i).iter().map(wide).collect()).collect()
    };
    let mut product = of(lower.path[0]);
    for &k in &lower.path[1..] {
        product = times(&product, &of(k));
    }
    let chi = characteristic(&product);
    let n = product.len();
    let (re, im) = match &lower.eigenvalue {
        Leading::Exact(root) => root.enclosure(BITS),
        Leading::Disc(disc) => (Interval::point(disc.centre.0.clone()), Interval::point(disc.centre.1.clone())),
    };
    let z = (Interval::point(re.mid()), Interval::point(im.mid()));
    let derivative: Vec<Interval> = (1..chi.len()).map(|k| &chi[k] * &Rational::from(k as u64)).collect();
    let square = |p: &[Interval]| {
        let (a, b) = value(p, &z);
        &a.square() + &b.square()
    };
    let (top, bottom) = (square(&chi), square(&derivative));
    if bottom.lo <= 0 {
        return None;
    }
    let radius = crate::radius::square_root(&(top.hi / bottom.lo), 200).hi * Rational::from(n as u64);
    let modulus = crate::radius::square_root(&(re.mid().square() + im.mid().square()), 200).lo - radius;
    (modulus > 0).then(|| crate::radius::root_floor(&modulus, lower.length, 96))
}

fn times(a: &[Vec<Interval>], b: &[Vec<Interval>]) -> Vec<Vec<Interval>> {
    let zero = || Interval::point(Rational::from(0));
    let entry =
        |row: &[Interval], j: usize| row.iter().zip(b).fold(zero(), |s, (x, r)| &s + &(x * &r[j])).outward(2 * BITS);
    a.iter().map(|row| (0..b.first().map_or(0, Vec::len)).map(|j| entry(row, j)).collect()).collect()
}

/// Enclosures of the coefficients of the characteristic polynomial, lowest first (Faddeev and LeVerrier).
fn characteristic(a: &[Vec<Interval>]) -> Vec<Interval> {
    let n = a.len();
    let point = |k: i64| Interval::point(Rational::from(k));
    let mut coefficients = vec![point(0); n + 1];
    coefficients[n] = point(1);
    let mut m: Vec<Vec<Interval>> = (0..n).map(|i| (0..n).map(|j| point(i64::from(i == j))).collect()).collect();
    for k in 1..=n {
        m = times(a, &m);
        let trace = (0..n).fold(point(0), |s, i| &s + &m[i][i]);
        let c = &trace * &(Rational::from(-1) / Rational::from(k as u64));
        for (i, row) in m.iter_mut().enumerate() {
            row[i] = &row[i] + &c;
        }
        coefficients[n - k] = c;
    }
    coefficients
}

/// An enclosure of a polynomial at a complex point.
fn value(p: &[Interval], z: &(Interval, Interval)) -> (Interval, Interval) {
    let zero = || Interval::point(Rational::from(0));
    p.iter().rev().fold((zero(), zero()), |s, c| {
        let re = &(&(&s.0 * &z.0) - &(&s.1 * &z.1)) + c;
        (re.outward(2 * BITS), (&(&s.0 * &z.1) + &(&s.1 * &z.0)).outward(2 * BITS))
    })
}

/// The largest 1-norm of a column; 0 of a matrix without columns.
fn norm(m: &Matrix) -> Rational {
    (0..m.cols()).map(|j| crate::shape::norm1(&m.column(j))).fold(Rational::from(0), Rational::max)
}
