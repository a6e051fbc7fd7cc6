//! Rules that are looked at without patches, as stencils around a vertex: the mask of the regular mesh, and what differs from it.

use super::ball::Ball;
use super::mesh::{Place, locate};
use super::own::Own;
use crate::base::{Checked, Q, need, whole};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// The weight of the old point `q` in the new point `N q + offset`, by offset.
pub type Mask = BTreeMap<Place, Q>;

/// A sum of old points: the centre, or a place of sector 0 and by how many sectors it is turned, with weights.
pub type Terms = Vec<(Option<(Place, i64)>, Ball)>;

/// A rule on the regular mesh.
pub struct Lattice {
    /// Whether the faces are triangles.
    pub triangles: bool,
    /// `N`: a step makes the mesh so many times finer.
    pub factor: i64,
    /// The weights.
    pub mask: Mask,
}

/// A rule around a vertex of one valence.
pub struct Stencils {
    /// The rule where all is regular.
    pub lattice: Lattice,
    /// The new points of sector 0 that follow in another way.
    pub special: BTreeMap<Place, Terms>,
    /// The new centre.
    pub centre: Terms,
    /// Whether the valence is the regular one, at which the mesh is the lattice.
    pub usual: bool,
    /// Whether stencils are given by places, which have no meaning where they reach around the centre on both sides.
    pub strict: bool,
}

impl Stencils {
    /// The old points of a new point of sector 0.
    pub fn at(&self, (i, j): Place) -> Checked<Terms> {
        if let Some(terms) = self.special.get(&(i, j)) {
            return Ok(terms.clone());
        }
        let Lattice { triangles, factor: n, mask } = &self.lattice;
        let old = mask.iter().map(|(k, weight)| ((i - k.0, j - k.1), weight));
        let met: Vec<(Place, &Q)> = old.filter(|((a, b), _)| a.rem_euclid(*n) == 0 && b.rem_euclid(*n) == 0).collect();
        let old: Vec<(Place, &Q)> = met.into_iter().map(|((a, b), weight)| ((a / n, b / n), weight)).collect();
        let around = |p: Place| {
            let beyond = |q: Place| cross((i, j), q) < 0 && cross(q, p) < 0;
            cross((i, j), p) > 0 && old.iter().any(|(q, _)| beyond(*q))
        };
        let reaches = self.strict && old.iter().any(|(p, _)| around(*p));
        need(!reaches, "case", "a stencil reaches around the centre on both sides")?;
        let term = |(place, weight): (Place, &Q)| {
            let known = if self.usual { locate(*triangles, false, place) } else { beside(*triangles, (i, j), place)? };
            Ok((known, Ball::real(weight)))
        };
        old.into_iter().map(term).collect()
    }
}

/// A rule.
#[derive(Debug, Clone)]
pub enum Rule {
    /// Dyn's, Gregory's and Levin's with a tension, and with Zorin's weights on the edges at the centre.
    Butterfly {
        /// The tension.
        tension: Q,
        /// Whether the edges at the centre have Zorin's weights.
        modified: bool,
    },
    /// A point in every face, joined across the edges: two steps.
    Turned {
        /// Of triangles: √3; of quadrangles: 4-8.
        triangles: bool,
        /// The weight of all neighbours of the centre together, where it is not the usual one.
        near: Option<Q>,
    },
    /// Stencils of one's own.
    Own(Own),
}

fn ratio(p: i64, q: i64) -> Q {
    whole(p) / whole(q)
}

fn sum((a, b): Place, (c, d): Place) -> Place {
    (a + c, b + d)
}

/// The unit steps of the lattice, anticlockwise.
pub fn steps(triangles: bool) -> &'static [Place] {
    if triangles { &[(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)] } else { &[(1, 0), (0, 1), (-1, 0), (0, -1)] }
}

/// The steps from a vertex to the new points in its faces, in the lattice that two steps make.
fn diagonals(triangles: bool) -> &'static [Place] {
    if triangles {
        &[(1, 1), (-1, 2), (-2, 1), (-1, -1), (1, -2), (2, -1)]
    } else {
        &[(1, 1), (-1, 1), (-1, -1), (1, -1)]
    }
}

/// The weights of old points, and that of the centre after one of two steps.
#[derive(Default)]
struct Combination {
    old: Mask,
    once: Option<Q>,
}

impl Combination {
    fn add(&mut self, other: &Self, factor: &Q) {
        for (place, weight) in &other.old {
            *self.old.entry(*place).or_insert_with(Q::zero) += weight * factor;
        }
        if let Some(once) = &other.once {
            let own = self.once.take();
            self.once = Some(once * factor + own.iter().sum::<Q>());
        }
    }
}

/// Two turning steps on the lattice; the centre is one of its points.
struct TwoSteps {
    triangles: bool,
    /// The place whose vertex has weights of its own.
    centre: Option<Place>,
}

impl TwoSteps {
    fn factor(&self) -> i64 {
        if self.triangles { 3 } else { 2 }
    }

    /// The weight of all neighbours of a regular vertex together.
    fn near(&self) -> Q {
        if self.triangles { ratio(1, 3) } else { ratio(1, 2) }
    }

    /// The mean of some points.
    fn mean(points: &[Combination]) -> Combination {
        let mut all = Combination::default();
        points.iter().for_each(|p| all.add(p, &(Q::one() / whole(points.len() as i64))));
        all
    }

    fn vertex(&self, own: &Combination, neighbours: &[Combination]) -> Combination {
        let mut all = Combination::default();
        all.add(own, &(Q::one() - self.near()));
        all.add(&Self::mean(neighbours), &self.near());
        all
    }

    fn old(place: Place) -> Combination {
        Combination { old: Mask::from([(place, Q::one())]), once: None }
    }

    /// The old point at a place of the finest lattice.
    fn coarse(&self, (i, j): Place) -> Option<Place> {
        let n = self.factor();
        (i.rem_euclid(n) == 0 && j.rem_euclid(n) == 0).then_some((i.div_euclid(n), j.div_euclid(n)))
    }

    /// Whether a place of the finest lattice has a point after the first step.
    fn is_middle(&self, (i, j): Place) -> bool {
        if self.triangles { (i - j).rem_euclid(3) == 0 } else { (i + j).rem_euclid(2) == 0 }
    }

    /// The point after the first step.
    fn middle(&self, place: Place) -> Combination {
        match self.coarse(place) {
            Some(q) if self.centre == Some(q) => Combination { old: Mask::new(), once: Some(Q::one()) },
            Some(q) => {
                let around: Vec<_> = steps(self.triangles).iter().map(|h| Self::old(sum(q, *h))).collect();
                self.vertex(&Self::old(q), &around)
            }
            None => {
                let corners = diagonals(self.triangles).iter().flat_map(|g| self.coarse(sum(place, *g)));
                Self::mean(&corners.map(Self::old).collect::<Vec<_>>())
            }
        }
    }

    /// The point after both.
    fn point(&self, place: Place) -> Combination {
        if self.is_middle(place) {
            let around: Vec<_> = diagonals(self.triangles).iter().map(|g| self.middle(sum(place, *g))).collect();
            return self.vertex(&self.middle(place), &around);
        }
        let near = steps(self.triangles).iter().map(|h| sum(place, *h)).filter(|p| self.is_middle(*p));
        Self::mean(&near.map(|p| self.middle(p)).collect::<Vec<_>>())
    }
}

impl Rule {
    /// The rule where all is regular.
    pub fn lattice(&self) -> Lattice {
        match self {
            Self::Own(own) => own.lattice(),
            Self::Butterfly { tension, .. } => Lattice { triangles: true, factor: 2, mask: butterfly(tension) },
            Self::Turned { triangles, .. } => {
                let rule = TwoSteps { triangles: *triangles, centre: None };
                let (n, mut mask) = (rule.factor(), Mask::new());
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    let point = rule.point((i, j));
                    mask.extend(point.old.into_iter().map(|(q, weight)| ((i - n * q.0, j - n * q.1), weight)));
                }
                Lattice { triangles: *triangles, factor: n, mask }
            }
        }
    }

    /// The rule at a vertex, with the powers of `e^(2πi/n)`.
    pub fn stencils(&self, powers: &[Ball]) -> Checked<Stencils> {
        let n = powers.len();
        let (lattice, mut special) = (self.lattice(), BTreeMap::new());
        let (usual, strict) = (n == steps(lattice.triangles).len(), false);
        // 2cos(2πm/n).
        let twice_cosine = |m: usize| powers[m % n].plus(&powers[(n - m % n) % n]);
        let number = |q: Q| Ball::real(&q);
        let share = |w: &Ball| w.times(&number(Q::one() / whole(n as i64)));
        let spoke = |s: usize| Some(((1, 0), s as i64));
        match self {
            Self::Own(own) => own.stencils(powers),
            Self::Butterfly { modified, .. } => {
                if *modified {
                    special.insert((1, 0), zorin(n, &twice_cosine));
                }
                let centre = vec![(None, Ball::real(&Q::one()))];
                Ok(Stencils { lattice, special, centre, usual, strict })
            }
            Self::Turned { triangles, near } => {
                let near = match near {
                    Some(near) => number(near.clone()),
                    None if *triangles => number(whole(4)).minus(&twice_cosine(1)).times(&number(ratio(1, 9))),
                    None => number(ratio(1, 2)),
                };
                let own = number(Q::one()).minus(&near);
                let mut once: Terms = (0..n).map(|s| (spoke(s), share(&near))).collect();
                once.push((None, own.clone()));
                let rule = TwoSteps { triangles: *triangles, centre: Some((0, 0)) };
                for place in (1..=3).flat_map(|i| (0..=3).map(move |j| (i, j))) {
                    let point = rule.point(place);
                    if let Some(factor) = &point.once {
                        let mut terms = located(*triangles, place, &point.old)?;
                        terms.extend(once.iter().map(|(at, w)| (*at, w.times(&number(factor.clone())))));
                        special.insert(place, terms);
                    }
                }
                // The centre after both steps: itself after the first, and the points in its faces.
                let face = located(*triangles, (1, 1), &rule.middle((1, 1)).old)?;
                let mut centre: Terms = once.iter().map(|(at, w)| (*at, w.times(&own))).collect();
                for s in 0..n as i64 {
                    let turned = |at: Option<(Place, i64)>| at.map(|(place, turn)| (place, turn + s));
                    centre.extend(face.iter().map(|(at, w)| (turned(*at), share(&w.times(&near)))));
                }
                Ok(Stencils { lattice, special, centre, usual, strict })
            }
        }
    }
}

/// The weights of the old points of a new point.
fn located(triangles: bool, new: Place, weights: &Mask) -> Checked<Terms> {
    let one = |(place, weight): (&Place, &Q)| Ok((beside(triangles, new, *place)?, Ball::real(weight)));
    weights.iter().map(one).collect()
}

fn cross(a: Place, b: Place) -> i64 {
    a.0 * b.1 - a.1 * b.0
}

/// Where a place of the lattice lies that is continued over the spokes from a place of sector 0, to its left and to its right; half a
/// turn away there are two answers.
pub fn beside(triangles: bool, from: Place, place: Place) -> Checked<Option<(Place, i64)>> {
    let side = cross(from, place);
    let opposite = side == 0 && (from.0 * place.0 < 0 || from.1 * place.1 < 0);
    need(!opposite, "vertex", "a stencil reaches half around the centre")?;
    let ((mut i, mut j), mut turn) = (place, 0);
    while (i < 1 || j < 0) && place != (0, 0) {
        (i, j, turn) = match (side >= 0, triangles) {
            (true, true) => (i + j, -i, turn + 1),
            (true, false) => (j, -i, turn + 1),
            (false, true) => (-j, i + j, turn - 1),
            (false, false) => (-j, i, turn - 1),
        };
    }
    Ok((place != (0, 0)).then_some(((i, j), turn)))
}

/// Vertices stay; on an edge: the ends 1/2, the third corners of its triangles `2w`, the corners beyond those `−w`.
fn butterfly(w: &Q) -> Mask {
    let mut mask = Mask::from([((0, 0), Q::one())]);
    let minus = |(a, b): Place| (-a, -b);
    for k in 0..3 {
        let (u, v) = (steps(true)[k], steps(true)[k + 1]);
        let side = [v, sum(u, minus(v))];
        let far = [sum(v, minus(u)), sum(u, v), minus(v), sum(sum(u, u), minus(v))];
        let all = [((0, 0), ratio(1, 2)), (u, ratio(1, 2))].into_iter();
        let all = all.chain(side.map(|q| (q, w * whole(2)))).chain(far.map(|q| (q, -w)));
        mask.extend(all.map(|(q, weight)| (sum(u, minus(sum(q, q))), weight)));
    }
    mask.retain(|_, weight| !weight.is_zero());
    mask
}

/// Zorin's weights on an edge at the centre: 3/4 there, and `(1/4 + cos(2πj/n) + cos(4πj/n)/2)/n` around it, where frequencies that
/// coincide count once.
fn zorin(n: usize, twice_cosine: &impl Fn(usize) -> Ball) -> Terms {
    let waves: &[(usize, Q)] = &[(1, ratio(1, 2)), (2, ratio(1, 4))][..if n == 3 { 1 } else { 2 }];
    let weight = |j: usize| {
        let constant = Ball::real(&ratio(1, 4));
        let all = waves.iter().fold(constant, |all, (k, wave)| {
            let both = if 2 * k == n { wave / whole(2) } else { wave.clone() };
            all.plus(&twice_cosine(k * j).times(&Ball::real(&both)))
        });
        all.times(&Ball::real(&(Q::one() / whole(n as i64))))
    };
    let mut terms: Terms = (0..n).map(|j| (Some(((1, 0), j as i64)), weight(j))).collect();
    terms.push((None, Ball::real(&ratio(3, 4))));
    terms
}
