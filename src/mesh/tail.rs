//! All rings around an extraordinary vertex at once: from some ring on the net, scaled, is so close to the characteristic map
//! that the surface is immersed in the plane of the leading coefficients (docs/theory.md, “A whole mesh”).
#![allow(clippy::float_arithmetic, reason = "bounds of floats; what is plain proposes functionals")]

use super::interval::Float;
use super::patch::{Tested, bezier, functionals_of, halves, offsets};
use super::refine::Floats;
use super::scheme::Scheme;
use crate::arith::{Rational, to_f64};
use crate::ring::Field as _;
use crate::vertex::block::{Block, Vertex};
use crate::vertex::field::{Enclosures, Field as _};
use crate::vertex::net::{Net, Spot, corners};
use crate::vertex::ring::{CELLS, RINGS, TRIANGLES, own_place};
use crate::vertex::top::{Top, leading_value, leading_values};

/// Binary places of the characteristic map.
const PLACES: u64 = 192;
/// The longest power of the subdivision matrix that is formed.
const POWERS: usize = 160;
/// How often patches of the characteristic map are halved: what leaves most room is taken.
const HALVINGS: [usize; 3] = [4, 8, 11];
/// How often the patches of a ring are halved at most.
const DEPTH: usize = 10;
/// Rings that are tested one by one at most.
pub const MAX_RINGS: usize = 64;

/// Two real numbers as a complex one.
type Complex = [Float; 2];

/// What is the same at all vertices of one valence.
#[derive(Debug, Clone)]
pub struct Tail {
    /// The valence.
    pub valence: usize,
    /// The places of a sector, in the order of the net.
    pub places: Vec<(usize, usize)>,
    triangles: bool,
    lambda: Float,
    /// The rows of the subdivision matrix: the centre, then sector by sector.
    rows: Vec<Vec<(usize, Float)>>,
    /// The limit point as a combination of the net.
    mean: Vec<Float>,
    /// The leading coefficient, unscaled: its real and imaginary part.
    left: Vec<Complex>,
    /// Twice the eigenvector of which the coefficient is 1.
    map: Vec<Complex>,
    /// `sup |S^j r|/λ^j |r|` over the nets without limit point and leading part.
    growth: f64,
    /// A net this close to the characteristic map, in each point, has an immersed ring.
    radius: f64,
}

/// What was found at the rings around a vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Rings {
    /// All are immersed: so many were tested one by one, all later ones are near the characteristic map.
    Immersed(usize),
    /// This ring was not decided in this sector.
    Open(usize, usize),
    /// So many rings were tested; the later ones were not brought under one bound.
    Slow(usize),
    /// The leading coefficients are not certainly independent in floats.
    Dependent,
}

fn conjugate(a: Complex) -> Complex {
    [a[0], -a[1]]
}

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn over(a: Complex, b: Complex) -> Complex {
    let size = b[0] * b[0] + b[1] * b[1];
    times(a, conjugate(b)).map(|x| x.over(size))
}

fn sum(all: impl Iterator<Item = Float>) -> Float {
    all.fold(Float::ZERO, |s, x| s + x)
}

/// The larger one; no number where one is none.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

impl Tail {
    /// The bounds at a valence with its leading eigenvalue.
    ///
    /// # Errors
    /// What was not brought under a bound.
    pub fn new(scheme: Scheme, valence: usize, top: &Top, floats: &Floats) -> Result<Self, String> {
        let say = |error: crate::scheme::SchemeError| error.to_string();
        let vertex = Vertex::new(&scheme.rule().map_err(say)?, valence, RINGS).map_err(say)?;
        let blocks: Vec<Block> =
            vertex.frequencies().map(|k| vertex.block(k)).collect::<Result<_, _>>().map_err(say)?;
        let known = "bounds of the characteristic map are too wide";
        let field = Enclosures::of_angle(1, valence, PLACES);
        let near = |x: &crate::ring::Fixed| Float::around(&field.to_interval(x));
        let lambda = near(&leading_value(&vertex, &blocks, top, 1, PLACES).ok_or(known)?);
        let values = leading_values(&vertex, &blocks, top, 1, PLACES).ok_or(known)?;
        let cosine = near(&field.scale(&field.twice_cosine(), &Rational::from_signeds(1, 2)));
        let omega = [cosine, (Float::point(1.0) - cosine * cosine).root()];
        let mut turns: Vec<Complex> = vec![[Float::point(1.0), Float::ZERO]];
        for s in 1..valence {
            turns.push(times(turns[s - 1], omega));
        }
        let triangles = scheme.triangles();
        let places = vertex.stencils.places.clone();
        let own: Vec<Complex> =
            values.orbits.iter().map(|v| [near(&v.x) + near(&v.y) * omega[0], near(&v.y) * omega[1]]).collect();
        let mut tail = Self {
            valence,
            triangles,
            lambda,
            rows: Vec::new(),
            mean: vec![Float::ZERO; 1 + valence * places.len()],
            left: vec![[Float::ZERO; 2]; 1 + valence * places.len()],
            map: vec![[Float::ZERO; 2]; 1 + valence * places.len()],
            places,
            growth: f64::NAN,
            radius: f64::NAN,
        };
        tail.functionals(&turns, omega, floats);
        // The coefficient of the eigenvector itself, by which it is divided.
        for (s, turn) in turns.iter().enumerate().take(valence) {
            for (o, v) in own.iter().enumerate() {
                let at = tail.index(s as i64, o);
                tail.map[at] = times(*v, *turn).map(|x| x.times(2));
            }
        }
        let unit = tail
            .left
            .iter()
            .zip(&tail.map)
            .map(|(l, v)| times(*l, *v))
            .fold([Float::ZERO; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let unit = unit.map(|x| x.divided(2));
        tail.map.iter_mut().for_each(|v| *v = over(*v, unit));
        tail.matrix(&vertex, floats);
        tail.growth = tail.contraction().ok_or("no common bound of the later rings was found in floats")?;
        tail.radius = tail.room().ok_or("no room around the characteristic map was found in floats")?;
        Ok(tail)
    }

    /// The number of points of a net.
    pub(super) fn points(&self) -> usize {
        self.rows.len()
    }

    /// The number of a point in the net.
    pub(super) fn at(&self, sector: usize, place: (usize, usize)) -> Option<usize> {
        Some(self.index(sector as i64, self.orbit(place)?))
    }

    /// The net after one step of subdivision.
    pub(super) fn step(&self, net: &[[Float; 3]]) -> Vec<[Float; 3]> {
        let new = |row: &Vec<(usize, Float)>| std::array::from_fn(|k| sum(row.iter().map(|(i, w)| *w * net[*i][k])));
        self.rows.iter().map(new).collect()
    }

    fn index(&self, sector: i64, orbit: usize) -> usize {
        1 + sector.rem_euclid(self.valence as i64) as usize * self.places.len() + orbit
    }

    fn orbit(&self, place: (usize, usize)) -> Option<usize> {
        self.places.iter().position(|p| *p == place)
    }

    /// The left eigenvectors of 1 and `λ`.
    fn functionals(&mut self, turns: &[Complex], omega: Complex, floats: &Floats) {
        let n = self.valence as i64;
        let Some(e) = self.orbit((1, 0)) else { return };
        let one = Float::point(1.0);
        for (s, turn) in turns.iter().enumerate().take(self.valence) {
            let (at, back) = (self.index(s as i64, e), conjugate(*turn));
            if self.triangles {
                let w = floats.weight(self.valence).times(8);
                self.mean[0] = Float::point(3.0).over(w + Float::point(3.0));
                self.mean[at] = w.divided(n).over(w + Float::point(3.0));
                self.left[at] = back;
                continue;
            }
            let Some(f) = self.orbit((1, 1)) else { return };
            let beside = self.index(s as i64, f);
            let alpha = self.lambda.times(16) - Float::point(4.0);
            self.mean[0] = Float::ratio(n, n + 5);
            self.mean[at] = Float::ratio(4, n * (n + 5));
            self.mean[beside] = Float::ratio(1, n * (n + 5));
            self.left[at] = back.map(|x| x * alpha);
            self.left[beside] = times(back, [one + omega[0], -omega[1]]);
        }
    }

    fn matrix(&mut self, vertex: &Vertex, floats: &Floats) {
        let n = self.valence;
        let mut centre = vec![(0, Float::UNKNOWN)];
        if self.triangles {
            let w = floats.weight(n);
            centre = vec![(0, Float::point(1.0) - w)];
            let ring = (0..n).filter_map(|s| Some((self.index(s as i64, self.orbit((1, 0))?), w.divided(n as i64))));
            centre.extend(ring);
        } else if let Some((own, sums)) = &vertex.stencils.centre {
            centre = vec![(0, Float::of(own))];
            for (orbit, total) in sums.iter().enumerate().filter(|(_, total)| **total != 0) {
                let share = Float::of(&(total / Rational::from(n as u64)));
                centre.extend((0..n).map(|s| (self.index(s as i64, orbit), share)));
            }
        }
        self.rows.push(centre);
        for s in 0..n as i64 {
            for (row, own) in vertex.stencils.rows.iter().zip(&vertex.stencils.from_centre) {
                let mut terms = vec![(0, Float::of(own))];
                terms.extend(row.iter().map(|(orbit, shift, w)| (self.index(s + shift, *orbit), Float::of(w))));
                self.rows.push(terms);
            }
        }
    }

    /// The supremum of the norms of `S^j/λ^j` on the rest, once one of them is at most 1. By symmetry the rows of one sector do.
    fn contraction(&self) -> Option<f64> {
        let count = self.rows.len();
        let own: Vec<usize> = (0..=self.places.len()).collect();
        let mut rows: Vec<Vec<Float>> = own
            .iter()
            .map(|i| (0..count).map(|j| if j == *i { Float::point(1.0) } else { Float::ZERO }).collect())
            .collect();
        let (mut power, mut growth) = (Float::point(1.0), 0.0);
        for _ in 0..POWERS {
            let norm = |(row, i): (&Vec<Float>, &usize)| {
                let rest = |j: usize| {
                    let leading = self.map[*i][0] * self.left[j][0] - self.map[*i][1] * self.left[j][1];
                    (row[j] - self.mean[j] - power * leading).abs()
                };
                sum((0..count).map(rest)).over(power).hi
            };
            let most = rows.iter().zip(&own).map(norm).fold(0.0, larger);
            growth = larger(growth, most);
            if most <= 1.0 {
                return (growth.is_finite()).then_some(growth);
            }
            if !growth.is_finite() {
                return None;
            }
            for row in &mut rows {
                let mut next = vec![Float::ZERO; count];
                for (x, terms) in row.iter().zip(&self.rows).filter(|(x, _)| **x != Float::ZERO) {
                    terms.iter().for_each(|(j, w)| next[*j] = next[*j] + *x * *w);
                }
                *row = next;
            }
            power = power * self.lambda;
        }
        None
    }

    /// The control points of each patch of a sector, by index.
    fn patches(&self, sector: usize) -> Option<Vec<Vec<usize>>> {
        let lookup = |i: i64, j: i64| match own_place(false, self.triangles, i, j)? {
            None => Some(0),
            Some((place, shift)) => Some(self.index(sector as i64 + shift, self.orbit(place)?)),
        };
        let all = offsets(self.triangles);
        if self.triangles {
            let patch = |((a, b), sign): &((i64, i64), i64)| {
                all.iter().map(|(i, j)| lookup(a + sign * i, b + sign * j)).collect()
            };
            return TRIANGLES.iter().map(patch).collect();
        }
        CELLS.iter().map(|(a, b)| all.iter().map(|(i, j)| lookup(a + i, b + j)).collect()).collect()
    }

    /// How far every point of a net may be from the characteristic map, so that two functionals still show on each piece that
    /// the derivatives are independent. Errors of Bézier points are means of those of the net; the derivative of the error in
    /// a direction `d` has coefficients of at most `2 (|d_1| + |d_2|)` times that.
    fn room(&self) -> Option<f64> {
        HALVINGS.into_iter().filter_map(|depth| self.room_at(depth)).reduce(f64::max)
    }

    fn room_at(&self, depth: usize) -> Option<f64> {
        let floats = Floats::default();
        let mut least = f64::INFINITY;
        for patch in self.patches(0)? {
            let points: Vec<[Float; 3]> =
                patch.iter().map(|i| [self.map[*i][0], self.map[*i][1], Float::ZERO]).collect();
            let mut stack = vec![((bezier(&floats, self.triangles, &points), corners(self.triangles)), 0)];
            while let Some((piece, level)) = stack.pop() {
                if level == depth {
                    least = least.min(margin(&floats, &piece.0, &piece.1)?);
                } else {
                    stack.extend(halves(&floats, &piece).map(|half| (half, level + 1)));
                }
            }
        }
        (least > 0.0 && least.is_finite()).then_some(least)
    }

    /// Goes through the rings of a net until the bound for all later ones holds.
    #[must_use]
    pub fn rings(&self, net: &[[Float; 3]]) -> Rings {
        let floats = Floats::default();
        let total = |weights: &mut dyn Iterator<Item = (Float, usize)>, k: usize| {
            weights.fold(Float::ZERO, |s, (w, i)| s + w * net[i][k])
        };
        let of = |part: &dyn Fn(usize) -> Float, k: usize| total(&mut (0..net.len()).map(|i| (part(i), i)), k);
        let centre: [Float; 3] = std::array::from_fn(|k| of(&|i| self.mean[i], k));
        let a: [Float; 3] = std::array::from_fn(|k| of(&|i| self.left[i][0], k));
        let b: [Float; 3] = std::array::from_fn(|k| of(&|i| -self.left[i][1], k));
        let dot = |x: &[Float; 3], y: &[Float; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
        let size = aa * bb - ab * ab;
        if !size.positive() {
            return Rings::Dependent;
        }
        // Coordinates with respect to a, b.
        let plane = |v: &[Float; 3]| {
            let (x, y) = (dot(v, &a), dot(v, &b));
            [(bb * x - ab * y).over(size), (aa * y - ab * x).over(size)]
        };
        let Some(patches) = (0..self.valence).map(|s| self.patches(s)).collect::<Option<Vec<_>>>() else {
            return Rings::Open(0, 0);
        };
        let mut scaled: Vec<[Float; 3]> = net.iter().map(|p| floats.difference(p, &centre)).collect();
        for ring in 0..MAX_RINGS {
            let distance = |(v, map): (&[Float; 3], &Complex)| {
                let at = plane(v);
                let (x, y) = (at[0] - map[0], at[1] - map[1]);
                (x * x + y * y).root().hi
            };
            let most = scaled.iter().zip(&self.map).map(distance).fold(0.0, larger);
            if (Float::point(most) * Float::point(self.growth)).hi < self.radius {
                return Rings::Immersed(ring);
            }
            for (sector, list) in patches.iter().enumerate() {
                for patch in list {
                    let points: Vec<[Float; 3]> = patch.iter().map(|i| scaled[*i]).collect();
                    if super::patch::regular(&floats, bezier(&floats, self.triangles, &points), DEPTH).is_err() {
                        return Rings::Open(ring, sector);
                    }
                }
            }
            scaled = self.step(&scaled).into_iter().map(|p| p.map(|x| x.over(self.lambda))).collect();
        }
        Rings::Slow(MAX_RINGS)
    }
}

/// The room on one piece.
fn margin(floats: &Floats, net: &Net<[Float; 3]>, places: &[Spot]) -> Option<f64> {
    let (along, across, f, g) = functionals_of(floats, net);
    let functional = |f: &[f64; 3], v: &[Float; 3]| (0..3).fold(Float::ZERO, |s, k| s + Float::point(f[k]) * v[k]);
    let length = |f: &[f64; 3]| f.iter().fold(Float::ZERO, |s, x| s + Float::point(*x) * Float::point(*x)).root();
    let both = (length(&f) + length(&g)).times(2);
    let size = |to: &Spot| {
        let d = crate::arith::abs(&(&to.0 - &places[0].0)) + crate::arith::abs(&(&to.1 - &places[0].1));
        Float::point(to_f64(&d).next_up())
    };
    let mut least = f64::INFINITY;
    for (all, to, f, g) in [(&along, &places[1], &f, &g), (&across, &places[2], &g, &f)] {
        for v in all {
            let room = (functional(f, v) - functional(g, v).abs()).over(both * size(to));
            if !room.positive() {
                return None;
            }
            least = least.min(room.lo);
        }
    }
    Some(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vertex::at_valence;
    use oorandom::Rand64;

    fn tail(scheme: Scheme, n: usize) -> Tail {
        let top = at_valence(&scheme.rule().unwrap(), n).unwrap().top.unwrap();
        Tail::new(scheme, n, &top, &Floats::new(scheme, [n, 6])).unwrap()
    }

    fn step(tail: &Tail, x: &[f64]) -> Vec<f64> {
        tail.rows.iter().map(|row| row.iter().map(|(i, w)| w.mid() * x[*i]).sum::<f64>() / tail.lambda.mid()).collect()
    }

    fn most(x: &[f64]) -> f64 {
        x.iter().fold(0.0, |m, v| m.max(v.abs()))
    }

    /// The map is an eigenvector, the functionals are dual to it, and no random rest grows by more than the bound.
    #[test]
    fn bounds_hold_on_random_nets() {
        let rules = [Scheme::CatmullClark, Scheme::Loop];
        for (rule, n) in [(rules[0], 3), (rules[0], 5), (rules[0], 8), (rules[1], 3), (rules[1], 4), (rules[1], 7)] {
            let tail = tail(rule, n);
            let map: [Vec<f64>; 2] = [0, 1].map(|k| tail.map.iter().map(|v| v[k].mid()).collect());
            for (part, other) in [(0, 1), (1, 0)] {
                let rest: Vec<f64> = step(&tail, &map[part]).iter().zip(&map[part]).map(|(a, b)| a - b).collect();
                assert!(most(&rest) < 1e-11, "{} at {n}", rule.name());
                let of = |k: usize, x: &[f64]| -> f64 { tail.left.iter().zip(x).map(|(l, x)| l[k].mid() * x).sum() };
                // a = Re A, b = −Im A.
                let (own, mixed) = if part == 0 { (1.0, 0.0) } else { (-1.0, 0.0) };
                assert!((of(part, &map[part]) - own).abs() < 1e-11 && (of(other, &map[part]) - mixed).abs() < 1e-11);
            }
            let mut random = Rand64::new(7);
            for _ in 0..20 {
                let x: Vec<f64> = map[0].iter().map(|_| random.rand_float() - 0.5).collect();
                let of = |f: &dyn Fn(usize) -> f64| -> f64 { (0..x.len()).map(|i| f(i) * x[i]).sum() };
                let (centre, a, b) =
                    (of(&|i| tail.mean[i].mid()), of(&|i| tail.left[i][0].mid()), of(&|i| -tail.left[i][1].mid()));
                let mut rest: Vec<f64> = (0..x.len()).map(|i| x[i] - centre - a * map[0][i] - b * map[1][i]).collect();
                let size = most(&rest);
                for _ in 0..10 {
                    assert!(most(&rest) <= tail.growth * size * (1.0 + 1e-6), "{} at {n}", rule.name());
                    rest = step(&tail, &rest);
                }
            }
        }
    }

    /// Every net so near the map has regular patches; one that is much farther need not.
    #[test]
    fn disturbed_maps_are_immersed() {
        let rules = [Scheme::CatmullClark, Scheme::Loop];
        for (rule, n) in [(rules[0], 5), (rules[1], 3), (rules[1], 5)] {
            let tail = tail(rule, n);
            let mut random = Rand64::new(3);
            let mut immersed = |radius: f64| {
                let net: Vec<[Float; 3]> = tail
                    .map
                    .iter()
                    .map(|v| {
                        let angle = random.rand_float() * std::f64::consts::TAU;
                        let near = |x: Float, by: f64| Float::point(x.mid() + by * radius);
                        [near(v[0], angle.cos()), near(v[1], angle.sin()), Float::ZERO]
                    })
                    .collect();
                tail.patches(0).unwrap().iter().all(|patch| {
                    let points: Vec<[Float; 3]> = patch.iter().map(|i| net[*i]).collect();
                    let net = bezier(&Floats::default(), tail.triangles, &points);
                    super::super::patch::regular(&Floats::default(), net, DEPTH).is_ok()
                })
            };
            assert!((0..20).all(|_| immersed(tail.radius * 0.999)), "{} at {n}", rule.name());
            assert!((0..20).any(|_| !immersed(tail.radius * 1000.0)), "{} at {n}", rule.name());
        }
    }
}
