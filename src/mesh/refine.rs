//! One step of Catmull and Clark's and of Loop's scheme on a whole mesh, over floats with bounds and over the rationals.

use super::interval::Float;
use super::read::{Model, Point};
use super::scheme::Scheme;
use super::topology::{Star, Topology};
use crate::arith::Rational;
use crate::ring::Enclosures;
use std::collections::BTreeMap;

/// Where the coordinates of points live.
pub trait Space: Sync {
    /// Points.
    type P: Clone + Send + Sync;
    /// A point of which nothing is known.
    fn unknown(&self) -> Self::P;
    /// The sum of points with whole weights, divided by a positive integer.
    fn sum(&self, terms: &[(i64, &Self::P)], over: i64) -> Self::P;
    /// A vertex with the weight `w` of Loop's rule at its valence on the mean of its neighbours, and `1 − w` on itself.
    fn blend(&self, own: &Self::P, ring: &[&Self::P]) -> Self::P;
}

/// Floats with bounds.
#[derive(Debug, Clone, Default)]
pub struct Floats {
    weights: BTreeMap<usize, Float>,
}

/// Rational numbers; `None` where a point has irrational coordinates.
#[derive(Debug, Clone, Copy)]
pub struct Exact(Scheme);

impl Floats {
    /// Floats for a rule on a mesh whose vertices have the given valences.
    #[must_use]
    pub fn new(scheme: Scheme, valences: impl IntoIterator<Item = usize>) -> Self {
        if !scheme.triangles() {
            return Self::default();
        }
        let weight = |n: usize| match scheme.weight(n) {
            Some(w) => Float::of(&w),
            None => {
                let k = Enclosures::new(96);
                let own = Float::ratio(3, 8) + Float::around(&k.to_interval(&k.twice_cosine(1, n))).divided(8);
                Float::ratio(5, 8) - own * own
            }
        };
        Self { weights: valences.into_iter().filter(|n| *n > 0).map(|n| (n, weight(n))).collect() }
    }

    /// The weight of all neighbours together in Loop's rule.
    #[must_use]
    pub fn weight(&self, n: usize) -> Float {
        self.weights.get(&n).map_or(Float::UNKNOWN, |w| *w)
    }
}

impl Space for Floats {
    type P = [Float; 3];

    fn unknown(&self) -> Self::P {
        [Float::UNKNOWN; 3]
    }

    fn sum(&self, terms: &[(i64, &Self::P)], over: i64) -> Self::P {
        std::array::from_fn(|k| {
            let sum = terms.iter().fold(Float::ZERO, |sum, (w, p)| sum + if *w == 1 { p[k] } else { p[k].times(*w) });
            if over == 1 { sum } else { sum.divided(over) }
        })
    }

    fn blend(&self, own: &Self::P, ring: &[&Self::P]) -> Self::P {
        let w = self.weight(ring.len());
        let terms: Vec<(i64, &Self::P)> = ring.iter().map(|p| (1, *p)).collect();
        let mean = self.sum(&terms, ring.len() as i64);
        std::array::from_fn(|k| own[k] + w * (mean[k] - own[k]))
    }
}

impl Exact {
    /// Rational points for a scheme.
    #[must_use]
    pub fn new(scheme: Scheme) -> Self {
        Self(scheme)
    }
}

impl Space for Exact {
    type P = Option<Point>;

    fn unknown(&self) -> Self::P {
        None
    }

    fn sum(&self, terms: &[(i64, &Self::P)], over: i64) -> Self::P {
        let mut sum: Point = std::array::from_fn(|_| Rational::from(0));
        for (w, p) in terms {
            let p = p.as_ref()?;
            for (s, x) in sum.iter_mut().zip(p) {
                *s += x * Rational::from(*w);
            }
        }
        Some(sum.map(|s| s / Rational::from(over)))
    }

    fn blend(&self, own: &Self::P, ring: &[&Self::P]) -> Self::P {
        let w = self.0.weight(ring.len())?;
        let terms: Vec<(i64, &Self::P)> = ring.iter().map(|p| (1, *p)).collect();
        let (mean, own) = (self.sum(&terms, ring.len() as i64)?, own.as_ref()?);
        Some(std::array::from_fn(|k| &own[k] + &w * (&mean[k] - &own[k])))
    }
}

/// A mesh at one level of refinement.
#[derive(Debug, Clone)]
pub struct Level {
    /// The faces.
    pub topology: Topology,
    /// The face of the file in which each face lies.
    pub origin: Vec<u32>,
    /// The valences of the vertices, 0 where faces are missing around a vertex.
    pub valence: Vec<u32>,
}

impl Level {
    /// The mesh of a file.
    #[must_use]
    pub fn of(topology: Topology) -> Self {
        let origin = (0..topology.faces() as u32).collect();
        Self::new(topology, origin)
    }

    fn new(topology: Topology, origin: Vec<u32>) -> Self {
        let mut valence = vec![0_u32; topology.vertices()];
        topology.vertex.iter().for_each(|v| valence[*v as usize] += 1);
        for [c, other] in &topology.edges {
            if *other == super::topology::NONE {
                valence[topology.vertex[*c as usize] as usize] = 0;
                valence[topology.vertex[topology.next(*c) as usize] as usize] = 0;
            }
        }
        Self { topology, origin, valence }
    }

    /// The faces that are kept, as a mesh of their own, with the old numbers of its vertices.
    #[must_use]
    pub fn restricted(&self, keep: &[bool]) -> (Self, Vec<u32>) {
        let mut number = vec![u32::MAX; self.topology.vertices()];
        let (mut old, mut faces, mut origin) = (Vec::new(), Vec::new(), Vec::new());
        for f in (0..self.topology.faces()).filter(|f| keep[*f]) {
            let corners = self.topology.polygon(f).iter().map(|v| {
                let place = &mut number[*v as usize];
                if *place == u32::MAX {
                    *place = old.len() as u32;
                    old.push(*v);
                }
                *place
            });
            faces.push(corners.collect::<Vec<u32>>());
            origin.push(self.origin[f]);
        }
        let topology =
            Topology::joined(old.len(), faces.iter().map(Vec::as_slice)).expect("a part of a surface is one");
        (Self::new(topology, origin), old)
    }

    /// The faces of one step: of quadrangles one for each corner, of triangles one for each corner and one in the middle.
    /// The new vertices are the old ones, then one for each edge, then, of quadrangles, one for each face.
    #[must_use]
    pub fn refined(&self, triangles: bool) -> Self {
        let t = &self.topology;
        let edge = |c: u32| (t.vertices() + t.edge[c as usize] as usize) as u32;
        let mut corners: Vec<u32> = Vec::new();
        let mut origin = Vec::new();
        for f in 0..t.faces() {
            let middle = (t.vertices() + t.edges.len() + f) as u32;
            for c in t.corners(f) {
                corners.extend([t.vertex[c as usize], edge(c)]);
                corners.extend((!triangles).then_some(middle));
                corners.push(edge(t.previous(c)));
                origin.push(self.origin[f]);
            }
            if triangles {
                corners.extend(t.corners(f).map(edge));
                origin.push(self.origin[f]);
            }
        }
        let vertices = t.vertices() + t.edges.len() + if triangles { 0 } else { t.faces() };
        let topology = Topology::joined(vertices, corners.chunks(if triangles { 3 } else { 4 }));
        Self::new(topology.expect("a refined surface is one"), origin)
    }

    /// The points of one step; unknown where faces around them are missing.
    #[must_use]
    pub fn points<S: Space>(&self, space: &S, triangles: bool, old: &[S::P]) -> Vec<S::P> {
        let t = &self.topology;
        let at = |v: u32| &old[v as usize];
        let mean = |f: &usize| {
            let terms: Vec<(i64, &S::P)> = t.polygon(*f).iter().map(|v| (1, at(*v))).collect();
            space.sum(&terms, terms.len() as i64)
        };
        let all: Vec<usize> = (0..t.faces()).collect();
        let faces: Vec<S::P> = if triangles { Vec::new() } else { super::each(&all, mean) };
        let edge = |[c, other]: &[u32; 2]| {
            if *other == super::topology::NONE {
                return space.unknown();
            }
            let (a, b) = (at(t.vertex[*c as usize]), at(t.vertex[t.next(*c) as usize]));
            if triangles {
                let across = |c: u32| at(t.vertex[t.previous(c) as usize]);
                return space.sum(&[(3, a), (3, b), (1, across(*c)), (1, across(*other))], 8);
            }
            let beside = |c: u32| &faces[t.face[c as usize] as usize];
            space.sum(&[(1, a), (1, b), (1, beside(*c)), (1, beside(*other))], 4)
        };
        let vertex = |v: &usize| {
            if self.valence[*v] == 0 {
                return space.unknown();
            }
            let star = t.around(*v);
            let ring: Vec<&S::P> = star.spokes.iter().map(|e| at(*e)).collect();
            if triangles { space.blend(&old[*v], &ring) } else { smooth(space, t, &old[*v], &ring, &star, &faces) }
        };
        let vertices: Vec<usize> = (0..t.vertices()).collect();
        let mut new = super::each(&vertices, vertex);
        new.extend(super::each(&t.edges, edge));
        new.extend(faces);
        new
    }
}

/// A mesh after some steps in floating point, for drawings: points, and faces by the numbers of their corners. Faces at the
/// border, where points are missing, are left out.
#[must_use]
pub fn refined(model: &Model, scheme: Scheme, steps: usize) -> (Vec<[f64; 3]>, Vec<Vec<u32>>) {
    let triangles = scheme.triangles();
    let mut level = Level::of(model.topology.clone());
    let mut points: Vec<[Float; 3]> = model.points.iter().map(|p| [0, 1, 2].map(|k| Float::of(&p[k]))).collect();
    for _ in 0..steps {
        let space = Floats::new(scheme, level.valence.iter().map(|n| *n as usize));
        points = level.points(&space, triangles, &points);
        level = level.refined(triangles);
    }
    let points: Vec<[f64; 3]> = points.iter().map(|p| p.map(Float::mid)).collect();
    let known = |v: &u32| points[*v as usize].iter().all(|x| x.is_finite());
    let faces = (0..level.topology.faces()).map(|f| level.topology.polygon(f).to_vec());
    let faces = faces.filter(|corners| corners.iter().all(known)).collect();
    (points, faces)
}

/// Catmull and Clark's new point of a vertex: `(n − 2)/n` of itself, the means of its neighbours and of the new points of the
/// faces `1/n` each.
fn smooth<S: Space>(space: &S, t: &Topology, own: &S::P, ring: &[&S::P], star: &Star, faces: &[S::P]) -> S::P {
    let n = ring.len() as i64;
    let mut terms = vec![(n * (n - 2), own)];
    terms.extend(ring.iter().map(|e| (1, *e)));
    terms.extend(star.frames.iter().map(|f| (1, &faces[t.face[f.corner as usize] as usize])));
    space.sum(&terms, n * n)
}
