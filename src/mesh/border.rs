//! Limits of these very points at vertices on the border: left eigenvectors of a fan of faces.

use super::interval::Float;
use super::limit::Limit;
use super::number::{Number, Numbers};
use super::read::Point;
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use crate::ring::{Fixed, Ordered as _, Ring as _};

/// A fan of faces at a vertex of the border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fan {
    /// Whether its faces are triangles.
    pub triangles: bool,
    /// Whether the border is a smooth curve there; otherwise the vertex is fixed.
    pub smooth: bool,
    /// The number of its faces.
    pub faces: usize,
}

/// The points around the vertex of a fan: neighbours, and of quadrangles the opposite corners.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a> {
    /// The vertex.
    pub own: &'a Point,
    /// Its neighbours, one more than faces.
    pub spokes: &'a [&'a Point],
    /// The corner opposite to it in each quadrangle.
    pub across: &'a [&'a Point],
}

/// What is the same at all fans of one kind. The numbers are those of the valence that the reflected fan has.
#[derive(Debug, Clone)]
pub struct BorderStencil {
    fan: Fan,
    numbers: Numbers,
    /// `sin(iπ/k)/sin(π/k)` for the inner neighbours.
    spokes: Vec<Poly>,
    /// `sin((i − ½)π/k)/sin(π/2k)` for the opposite corners.
    across: Vec<Poly>,
    /// The weights of each outer neighbour and of the vertex in the leading coefficient.
    outer: (Number, Number),
    second: Option<Second>,
}

/// The second inner mode, of which the coefficient is compared with the others.
#[derive(Debug, Clone)]
struct Second {
    numbers: Numbers,
    spokes: Vec<Poly>,
    across: Vec<Poly>,
}

/// `x_0, x_1, …` with `x_{i+1} = t x_i − x_{i−1}`.
fn waves(numbers: &Numbers, first: [i64; 2], count: usize) -> Vec<Poly> {
    let mut all = first.map(|x| Poly::constant(ratio(x, 1))).to_vec();
    while all.len() < count {
        let (now, before) = (&all[all.len() - 1], &all[all.len() - 2]);
        all.push(numbers.step(now, &-before));
    }
    all
}

/// The waves of a mode at the inner neighbours and at the opposite corners.
fn mode(numbers: &Numbers, fan: Fan) -> (Vec<Poly>, Vec<Poly>) {
    let spokes = waves(numbers, [0, 1], fan.faces + 1);
    let across = waves(numbers, [-1, 1], fan.faces + 1);
    (spokes[1..fan.faces].to_vec(), if fan.triangles { Vec::new() } else { across[1..=fan.faces].to_vec() })
}

fn total(all: &[Poly]) -> Poly {
    all.iter().fold(Poly::zero(), |s, p| &s + p)
}

impl BorderStencil {
    /// The stencil of a fan.
    #[must_use]
    pub fn new(fan: Fan) -> Self {
        let numbers = Numbers::new(2 * fan.faces);
        let (spokes, across) = mode(&numbers, fan);
        let outer = outer(&numbers, fan, &total(&spokes), &total(&across));
        let second = (fan.smooth && fan.faces > 2).then(|| {
            let numbers = Numbers::new(fan.faces);
            let (spokes, across) = mode(&numbers, fan);
            Second { numbers, spokes, across }
        });
        Self { fan, numbers, spokes, across, outer, second }
    }

    /// The limit at the vertex. The second tangent runs along the first spoke, the first one inwards: of a corner along the last
    /// spoke. Where a smooth vertex has one quadrangle and these are dependent, the coefficient of the next order takes the place
    /// of the first.
    #[must_use]
    pub fn limit(&self, at: Points<'_>) -> Limit {
        let rational = |v: Point| v.map(|x| Number::rational(&x));
        let from = |p: &Point| -> Point { std::array::from_fn(|k| &p[k] - &at.own[k]) };
        let (first, last) = (at.spokes[0], at.spokes[self.fan.faces]);
        let point: Point = if self.fan.smooth {
            std::array::from_fn(|k| (&at.own[k] * Rational::from(4) + &first[k] + &last[k]) / Rational::from(6))
        } else {
            at.own.clone()
        };
        let mut tangents = if self.fan.smooth {
            [self.leading(at), rational(std::array::from_fn(|k| (&first[k] - &last[k]) / Rational::from(2)))]
        } else {
            [rational(from(last)), rational(from(first))]
        };
        let mut found = self.judged(&point, tangents.clone());
        if self.fan.smooth && self.fan.faces == 1 && !self.fan.triangles && found.dependent.is_some_and(|d| d.0) {
            tangents[0] = rational(std::array::from_fn(|k| {
                &at.across[0][k] - (&first[k] + &last[k]) * ratio(5, 6) + &at.own[k] * ratio(2, 3)
            }));
            let next = self.judged(&point, tangents);
            if next.dependent == Some((false, false)) {
                found = next;
            }
        }
        found
    }

    fn judged(&self, point: &Point, tangents: [[Number; 3]; 2]) -> Limit {
        let near = std::array::from_fn(|k| Float::of(&point[k]));
        Limit::new(&self.numbers, Some(point.clone().map(|x| Number::rational(&x))), near, tangents)
    }

    /// The coefficient of the leading inner mode.
    fn leading(&self, at: Points<'_>) -> [Number; 3] {
        let (first, last) = (at.spokes[0], at.spokes[self.fan.faces]);
        if self.fan.faces == 1 {
            return std::array::from_fn(|k| {
                Number::rational(&((&first[k] + &last[k]) / Rational::from(2) - &at.own[k]))
            });
        }
        std::array::from_fn(|k| {
            let inner = inner((&self.spokes, &self.across), at, k);
            let scaled = |n: &Number, q: &Rational| Number { u: n.u.scale(q), v: n.v.scale(q) };
            inner.plus(&scaled(&self.outer.0, &(&first[k] + &last[k]))).plus(&scaled(&self.outer.1, &at.own[k]))
        })
    }

    /// Whether three coefficients are certainly independent, so that a fan with too many faces has no tangent plane: those of the
    /// two leading inner modes and of the border, or of a corner that of the leading mode and the two sides.
    #[must_use]
    pub fn three_directions(&self, at: Points<'_>) -> bool {
        let from = |p: &Point| -> Point { std::array::from_fn(|k| &p[k] - &at.own[k]) };
        let (first, last) = (from(at.spokes[0]), from(at.spokes[self.fan.faces]));
        // All from the vertex, which changes nothing: the weights add up to 0 but for multiples of the sides.
        let spokes: Vec<Point> = at.spokes.iter().map(|p| from(p)).collect();
        let across: Vec<Point> = at.across.iter().map(|p| from(p)).collect();
        let (spokes, across): (Vec<&Point>, Vec<&Point>) = (spokes.iter().collect(), across.iter().collect());
        let zero = std::array::from_fn(|_| Rational::from(0));
        let at = Points { own: &zero, spokes: &spokes, across: &across };
        [false, true].into_iter().any(|again| {
            let of = |numbers: &Numbers, all: [Number; 3]| all.map(|x| numbers.enclosure(&x, again));
            let plain = |v: &Point| of(&self.numbers, v.clone().map(|x| Number::rational(&x)));
            let three = if self.fan.smooth {
                let Some(second) = &self.second else { return false };
                let next = std::array::from_fn(|k| inner((&second.spokes, &second.across), at, k));
                let side: Point = std::array::from_fn(|k| &first[k] - &last[k]);
                [of(&self.numbers, self.leading(at)), of(&second.numbers, next), plain(&side)]
            } else {
                let own = std::array::from_fn(|k| inner((&self.spokes, &self.across), at, k));
                [of(&self.numbers, own), plain(&first), plain(&last)]
            };
            let k = three[0][0].0;
            let [a, b, c] = three.map(|v| v.map(|x| x.1));
            let minor = |i: usize, j: usize| k.sub(&k.mul(&b[i], &c[j]), &k.mul(&b[j], &c[i]));
            let terms: [Fixed; 3] =
                [k.mul(&a[0], &minor(1, 2)), k.mul(&a[1], &minor(2, 0)), k.mul(&a[2], &minor(0, 1))];
            k.sign(&terms.iter().fold(k.zero(), |s, x| k.add(&s, x))).is_some_and(|s| s != 0)
        })
    }
}

/// The part of a coefficient that comes from inner points: `α Σ s_i e_i + Σ r_i f_i`, of triangles `Σ s_i e_i`.
fn inner((spokes, across): (&[Poly], &[Poly]), at: Points<'_>, k: usize) -> Number {
    let sum = |waves: &[Poly], points: &[&Point]| {
        waves.iter().zip(points).fold(Poly::zero(), |sum, (w, p)| &sum + &w.scale(&p[k]))
    };
    let along = sum(spokes, &at.spokes[1..]);
    if at.across.is_empty() {
        return Number { u: along, v: Poly::zero() };
    }
    Number { u: sum(across, at.across), v: along }
}

/// The weights of the outer neighbours and of the vertex: with `s`, `r` the sums of the waves, `w = (α + 4 − 2(αs + r))/α` of
/// quadrangles, `(1 − s)/(1 + t)` of triangles; all weights add up to 0.
fn outer(numbers: &Numbers, fan: Fan, s: &Poly, r: &Poly) -> (Number, Number) {
    let zero = (Number::rational(&Rational::from(0)), Number::rational(&Rational::from(0)));
    if fan.faces == 1 {
        return zero;
    }
    let line = |a: i64, b: i64| Poly::new(vec![Rational::from(a), Rational::from(b)]);
    let twice = |p: &Poly| p.scale(&ratio(2, 1));
    let weight = if fan.triangles {
        numbers.inverse(&line(1, 1)).map(|inverse| Number {
            u: numbers.product(&(&Poly::constant(ratio(1, 1)) - s), &inverse),
            v: Poly::zero(),
        })
    } else {
        // 1/α = (α − 2 − t)/(8 + 4t).
        numbers.inverse(&line(8, 4)).map(|inverse| Number {
            u: &r.scale(&ratio(1, 2)) - &twice(s),
            v: numbers.product(&(&Poly::constant(ratio(4, 1)) - &twice(r)), &inverse),
        })
    };
    let Some(weight) = weight else { return zero };
    let all =
        if fan.triangles { Number { u: s.clone(), v: Poly::zero() } } else { Number { u: r.clone(), v: s.clone() } };
    let own = Number::rational(&Rational::from(0)).minus(&all).minus(&weight).minus(&weight);
    (weight, own)
}
