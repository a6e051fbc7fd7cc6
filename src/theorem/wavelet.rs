//! The Hölder exponent of Daubechies' scaling functions: masks with algebraic coefficients, enclosed by intervals.
//!
//! `a(z) = 2 ((1+z)/2)^N q(z)`, where `q(z) q(1/z) = Σ_k C(N−1+k, k) y^k`, `y = (2 − z − 1/z)/4`, and `q` takes the roots outside
//! the unit circle, `q(1) = 1`. With `b = 2^{1−N} q` the exponent is `−log_2` of the joint spectral radius of the matrices of `b`.
//! The radius is bounded for rational matrices near the true ones, and the bounds are widened by what the difference can do.

use super::regularity::{digits, minus_log};
use crate::algebraic::roots;
use crate::arith::{Integer, Interval, Rational, abs};
use crate::linalg::Matrix;
use crate::poly::{Poly, factor};
use crate::radius::{JointRadius, Leading, Lower, Options, System, joint_radius};
use malachite_base::num::arithmetic::traits::Square;

/// The regularity of a scaling function.
#[derive(Debug, Clone)]
pub struct Wavelet {
    /// `N`, the number of vanishing moments.
    pub moments: usize,
    /// Enclosures of the coefficients of `b`.
    pub factor: Vec<Interval>,
    /// The radius of the rational matrices near the true ones.
    pub radius: JointRadius,
    /// Enclosure of the true joint spectral radius.
    pub enclosure: Interval,
    /// Enclosure of the Hölder exponent.
    pub exponent: Interval,
}

/// Largest `N` handled.
pub const MAX_MOMENTS: usize = 12;
/// Binary places of the coefficients.
const BITS: u64 = 160;

/// Bounds the Hölder exponent of the scaling function with `moments` vanishing moments; `None` for `moments` outside
/// `2..=`[`MAX_MOMENTS`], or where the bounds could not be established.
///
/// # Cost
/// One joint spectral radius of matrices of size `moments − 1`.
#[must_use]
pub fn wavelet(moments: usize, options: &Options) -> Option<Wavelet> {
    if !(2..=MAX_MOMENTS).contains(&moments) {
        return None;
    }
    let factor = coefficients(moments)?;
    let middle: Vec<Rational> = factor.iter().map(|x| grid(&x.mid())).collect();
    let error = factor.iter().zip(&middle).map(|(x, m)| (x - &Interval::point(m.clone())).magnitude()).max()?;
    let system = System::plain(&digits(&middle, 2)).ok()?;
    let radius = joint_radius(&system, options).ok()?;
    let enclosure = Interval::new(below(&system, &radius, &error)?, above(&system, &radius, &error)?);
    let exponent = minus_log(&enclosure, 2)?;
    Some(Wavelet { moments, factor, radius, enclosure, exponent })
}

fn grid(x: &Rational) -> Rational {
    Interval::point(x.clone()).outward(BITS).lo
}

/// Enclosures of the coefficients of `2^{1−N} q`.
fn coefficients(moments: usize) -> Option<Vec<Interval>> {
    // z^{N−1} Σ_k C(N−1+k, k) ((2 − z − 1/z)/4)^k, where (2 − z − 1/z) z = −(1 − z)².
    let mut symbol = Poly::zero();
    let mut binomial = Rational::from(1);
    let mut power = Poly::constant(Rational::from(1));
    let square = Poly::new([-1, 2, -1].into_iter().map(|c| Rational::from(c) / Rational::from(4)).collect());
    for k in 0..moments {
        let mut shifted = vec![Rational::from(0); moments - 1 - k];
        shifted.extend_from_slice(power.scale(&binomial).coeffs());
        symbol = &symbol + &Poly::new(shifted);
        power = &power * &square;
        binomial = binomial * Rational::from((moments + k) as u64) / Rational::from((k + 1) as u64);
    }
    let zero = || Interval::point(Rational::from(0));
    let one = || Interval::point(Rational::from(1));
    // A complex polynomial, as enclosures of real and imaginary parts.
    let mut q: Vec<(Interval, Interval)> = vec![(one(), zero())];
    for (minpoly, multiplicity) in factor(&symbol) {
        for root in roots(&minpoly) {
            if root.cmp_modulus_rational(&Rational::from(1)) != std::cmp::Ordering::Greater {
                continue;
            }
            let (re, im) = root.enclosure(BITS + 80);
            for _ in 0..multiplicity {
                q = times_linear(&q, &re, &im);
            }
        }
    }
    if q.len() != moments {
        return None;
    }
    // q is real because roots come in conjugate pairs; scale to 2^{1−N} at z = 1.
    let sum = q.iter().fold(zero(), |s, c| &s + &c.0);
    if sum.contains_zero() {
        return None;
    }
    let scale = Rational::from(1) / Rational::from(Integer::from(1) << (moments as u64 - 1));
    let inverse = &Interval::new(Rational::from(1) / &sum.lo, Rational::from(1) / &sum.hi) * &scale;
    Some(q.iter().map(|c| (&c.0 * &inverse).outward(BITS + 40)).collect())
}

/// `q(z) (z − r)`.
fn times_linear(q: &[(Interval, Interval)], re: &Interval, im: &Interval) -> Vec<(Interval, Interval)> {
    let zero = Interval::point(Rational::from(0));
    let at = |k: usize| q.get(k).cloned().unwrap_or_else(|| (zero.clone(), zero.clone()));
    (0..=q.len())
        .map(|k| {
            let (a, b) = at(k);
            let before = if k == 0 { (zero.clone(), zero.clone()) } else { at(k - 1) };
            let real = &(&before.0 - &(&a * re)) + &(&b * im);
            let imaginary = &(&before.1 - &(&a * im)) - &(&b * re);
            (real.outward(BITS + 80), imaginary.outward(BITS + 80))
        })
        .collect()
}

/// The bound of the rational matrices, widened: a change of every entry by at most `error` adds at most
/// `K n error max|q|` in the norm of a polytope with points `q` and `e_j ∈ K Q`.
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
    let step = abs(&value) / Rational::from(Integer::from(1) << 60u64);
    let sides = [&value - &step, &value + &step];
    let mut signs = Vec::new();
    for x in &sides {
        let shifted = &Matrix::identity(n).scale(x) - &product;
        let det = determinant(&shifted);
        // |det(A + E) − det A| <= n ‖E‖ (‖A‖ + ‖E‖)^{n−1} in the 1-norm.
        let mut allowance = Rational::from(n as u64) * &change;
        for _ in 1..n {
            allowance *= norm(&shifted) + &change;
        }
        if abs(&det) <= allowance {
            return None;
        }
        signs.push(det > 0);
    }
    let least = sides.iter().map(abs).min()?;
    let floor = crate::radius::root_floor(&least, lower.length, 96);
    (signs[0] != signs[1]).then_some(floor)
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

/// The largest 1-norm of a column.
fn norm(m: &Matrix) -> Rational {
    (0..m.cols()).map(|j| crate::shape::norm1(&m.column(j))).fold(Rational::from(0), Rational::max)
}

fn determinant(m: &Matrix) -> Rational {
    let mut a = m.clone();
    let n = a.rows();
    let mut det = Rational::from(1);
    for k in 0..n {
        let Some(found) = (k..n).find(|&r| a[(r, k)] != 0) else { return Rational::from(0) };
        if found != k {
            for j in 0..n {
                let t = a[(k, j)].clone();
                a[(k, j)] = a[(found, j)].clone();
                a[(found, j)] = t;
            }
            det = -det;
        }
        det *= &a[(k, k)];
        for i in k + 1..n {
            let factor = &a[(i, k)] / &a[(k, k)];
            if factor != 0 {
                for j in k..n {
                    let change = &factor * &a[(k, j)];
                    a[(i, j)] -= change;
                }
            }
        }
    }
    det
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::to_f64;

    /// The polytope of db8 is so thin that coefficients of 50 places bound nothing well.
    #[test]
    fn thin_polytopes_are_computed_with_more_places() {
        let exponent = wavelet(8, &Options::default()).unwrap().exponent;
        assert!((to_f64(&exponent.lo) - 2.760_818_386_681).abs() < 1e-9, "{}", to_f64(&exponent.lo));
        assert!(to_f64(&exponent.width()) < 1e-9, "{}", to_f64(&exponent.width()));
    }
}
