//! Limit points and leading coefficients of these very points: exact left eigenvectors of one ring.

use super::interval::Float;
use super::number::{Number, Numbers};
use super::read::Point;
use super::scheme::Scheme;
use crate::arith::{Rational, ratio};
use crate::poly::Poly;

/// Up to this degree of `t` limit points with irrational weights are written out.
const WRITTEN: usize = 12;

/// The stencils of a valence.
#[derive(Debug, Clone)]
pub struct Stencil {
    /// The numbers in which the limits are written.
    pub numbers: Numbers,
    /// Loop's weight of all neighbours together, a polynomial in `t`; `None` for quadrangles.
    weight: Option<Poly>,
    /// `ω^(−s) = p + q ω`, `ω = e^(2πi/n)`, for `s = 0 … n`.
    powers: Vec<(Poly, Poly)>,
}

/// The limit at a vertex.
#[derive(Debug, Clone)]
pub struct Limit {
    /// The point, where it is written out.
    pub point: Option<[Number; 3]>,
    /// Bounds of its coordinates.
    pub near: [Float; 3],
    /// The leading coefficient `x + y ω` in each coordinate; two tangent vectors `x`, `y`.
    pub tangents: [[Number; 3]; 2],
    /// A positive multiple of the normal `a × b`, which is `y × x`.
    pub normal: [Number; 3],
    /// The unit normal, where it is not 0.
    pub unit: Option<[f64; 3]>,
    /// Whether the normal is 0, and whether the coefficient itself is; `None` where that was not decided.
    pub dependent: Option<(bool, bool)>,
}

impl Limit {
    /// The limit with two tangent vectors, and whether they are independent.
    #[must_use]
    pub fn new(numbers: &Numbers, point: Option<[Number; 3]>, near: [Float; 3], tangents: [[Number; 3]; 2]) -> Self {
        let cross = |k: usize| {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let [x, y] = &tangents;
            numbers.times(&y[a], &x[b]).minus(&numbers.times(&y[b], &x[a]))
        };
        let normal: [Number; 3] = std::array::from_fn(cross);
        let signs = |all: &[Number]| all.iter().map(|x| numbers.sign(x)).collect::<Vec<_>>();
        let of_normal = signs(&normal);
        let dependent = if of_normal.iter().any(|s| matches!(s, Some(1 | -1))) {
            Some((false, false))
        } else if of_normal.iter().all(|s| *s == Some(0)) {
            let all: Vec<Option<i32>> = tangents.iter().flat_map(|v| signs(v)).collect();
            let vanishes = all.iter().all(|s| *s == Some(0));
            (vanishes || all.iter().any(|s| matches!(s, Some(1 | -1)))).then_some((true, vanishes))
        } else {
            None
        };
        let unit = (dependent == Some((false, false))).then(|| unit(numbers, &normal));
        Self { point, near, tangents, normal, unit, dependent }
    }
}

impl Stencil {
    /// The stencil of a scheme at a valence of 3 or more.
    #[must_use]
    pub fn new(scheme: Scheme, valence: usize) -> Self {
        // 5/8 − (3/8 + t/8)² where it is irrational.
        let written = || Poly::new(vec![ratio(31, 64), ratio(-3, 32), ratio(-1, 64)]);
        let weight = scheme.triangles().then(|| scheme.weight(valence).map_or_else(written, Poly::constant));
        let numbers = Numbers::new(valence);
        let mut powers = vec![(Poly::constant(ratio(1, 1)), Poly::zero())];
        for s in 0..valence {
            // ω^(−1) = t − ω.
            let (p, q) = &powers[s];
            powers.push((numbers.step(p, q), -p));
        }
        Self { numbers, weight, powers }
    }

    /// The limit at a vertex with its neighbours and, of quadrangles, the opposite corners of its faces.
    #[must_use]
    pub fn limit(&self, own: &Point, spokes: &[&Point], across: &[&Point]) -> Limit {
        let (point, near) = self.point(own, spokes, across);
        Limit::new(&self.numbers, point, near, self.coefficient(spokes, across))
    }

    /// `x` and `y` of the leading coefficient `x + y ω`.
    fn coefficient(&self, spokes: &[&Point], across: &[&Point]) -> [[Number; 3]; 2] {
        let part = |k: usize, of: &dyn Fn(&(Poly, Poly)) -> Poly| {
            let along = spokes.iter().zip(&self.powers).fold(Poly::zero(), |sum, (e, p)| &sum + &of(p).scale(&e[k]));
            if self.weight.is_some() {
                return Number { u: along, v: Poly::zero() };
            }
            let both = |s: usize| &of(&self.powers[s]) + &of(&self.powers[s + 1]);
            let beside = across.iter().enumerate().fold(Poly::zero(), |sum, (s, f)| &sum + &both(s).scale(&f[k]));
            Number { u: beside, v: along }
        };
        [std::array::from_fn(|k| part(k, &|p| p.0.clone())), std::array::from_fn(|k| part(k, &|p| p.1.clone()))]
    }

    fn point(&self, own: &Point, spokes: &[&Point], across: &[&Point]) -> (Option<[Number; 3]>, [Float; 3]) {
        let n = self.numbers.valence as i64;
        let sum = |points: &[&Point], k: usize| points.iter().fold(Rational::from(0), |s, p| s + &p[k]);
        let Some(weight) = &self.weight else {
            let of = |k: usize| {
                (&own[k] * Rational::from(n * n) + sum(spokes, k) * Rational::from(4) + sum(across, k))
                    / Rational::from(n * (n + 5))
            };
            let point: Point = std::array::from_fn(of);
            let near = std::array::from_fn(|k| Float::of(&point[k]));
            return (Some(point.map(|x| Number::rational(&x))), near);
        };
        // v + 8w (ē − v)/(3 + 8w).
        let step = |k: usize| sum(spokes, k) / Rational::from(n) - &own[k];
        let divisor = &weight.scale(&ratio(8, 1)) + &Poly::constant(ratio(3, 1));
        let (k, value) = self.numbers.enclosure(&Number { u: weight.clone(), v: Poly::zero() }, false);
        let w = Float::around(&k.to_interval(&value));
        let share = w.times(8).over(w.times(8) + Float::point(3.0));
        let near = std::array::from_fn(|k| Float::of(&own[k]) + share * Float::of(&step(k)));
        let written = self.numbers.minimal.degree().is_some_and(|d| d <= WRITTEN);
        let inverse = if written { self.numbers.inverse(&divisor) } else { None };
        let point = inverse.map(|inverse| {
            let share = self.numbers.product(&weight.scale(&ratio(8, 1)), &inverse);
            std::array::from_fn(|k| Number {
                u: &share.scale(&step(k)) + &Poly::constant(own[k].clone()),
                v: Poly::zero(),
            })
        });
        (point, near)
    }
}

#[allow(clippy::float_arithmetic, reason = "display")]
fn unit(numbers: &Numbers, normal: &[Number; 3]) -> [f64; 3] {
    let values: Vec<Rational> = normal
        .iter()
        .map(|x| {
            let (k, value) = numbers.enclosure(x, true);
            k.to_interval(&value).mid()
        })
        .collect();
    // Scaled exactly first: coordinates may be very large or very small.
    let size = values.iter().map(crate::arith::abs).max().filter(|m| *m != 0);
    let Some(size) = size else { return [f64::NAN; 3] };
    let v: Vec<f64> = values.iter().map(|x| crate::arith::to_f64(&(x / &size))).collect();
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    std::array::from_fn(|k| v[k] / length)
}

/// Whether all points lie on one line (or are one).
#[must_use]
pub fn collinear(points: &[&Point]) -> bool {
    let Some(first) = points.first() else { return false };
    let from = |p: &Point| -> Point { std::array::from_fn(|k| &p[k] - &first[k]) };
    let Some(line) = points.iter().map(|p| from(p)).find(|v| v.iter().any(|x| *x != 0)) else { return true };
    points.iter().all(|p| super::patch::product(&line, &from(p)).iter().all(|x| *x == 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The contract of a left eigenvector: one step of the rule does not move the limit and multiplies the coefficient by `λ`.
    #[test]
    fn one_step_multiplies_the_coefficient() {
        for n in [3, 4, 5, 7] {
            let stencil = Stencil::new(Scheme::CatmullClark, n);
            let point = |k: i64| -> Point { [ratio(k * k % 11, 1), ratio(3 * k % 7 - k, 2), ratio(k * k * k % 13, 3)] };
            let own = point(50);
            let e: Vec<Point> = (0..n as i64).map(|s| point(s + 1)).collect();
            let f: Vec<Point> = (0..n as i64).map(|s| point(2 * s + 20)).collect();
            let mix = |terms: &[(&Point, Rational)]| -> Point {
                std::array::from_fn(|k| terms.iter().fold(ratio(0, 1), |s, (p, w)| s + &p[k] * w))
            };
            let quarter = ratio(1, 4);
            let faces: Vec<Point> = (0..n)
                .map(|s| {
                    let all = [&own, &e[s], &f[s], &e[(s + 1) % n]];
                    mix(&all.map(|p| (p, quarter.clone())))
                })
                .collect();
            let edges: Vec<Point> = (0..n)
                .map(|s| mix(&[&own, &e[s], &faces[s], &faces[(s + n - 1) % n]].map(|p| (p, quarter.clone()))))
                .collect();
            let share = ratio(1, (n * n) as i64);
            let mut terms = vec![(&own, ratio(n as i64 - 2, n as i64))];
            terms.extend(e.iter().chain(&faces).map(|p| (p, share.clone())));
            let new = mix(&terms);
            let refs = |v: &[Point]| v.to_vec();
            let before = stencil.limit(&own, &refs(&e).iter().collect::<Vec<_>>(), &f.iter().collect::<Vec<_>>());
            let after = stencil.limit(&new, &edges.iter().collect::<Vec<_>>(), &faces.iter().collect::<Vec<_>>());
            assert_eq!(before.point, after.point, "n = {n}");
            let lambda = Number { u: Poly::constant(ratio(1, 4)), v: Poly::constant(ratio(1, 16)) };
            for (x, y) in before.tangents.iter().flatten().zip(after.tangents.iter().flatten()) {
                let rest = stencil.numbers.times(&lambda, x).minus(y);
                assert_eq!(stencil.numbers.sign(&rest), Some(0), "n = {n}");
            }
        }
    }
}
