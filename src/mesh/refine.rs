//! One step of Catmull and Clark's and of Loop's scheme on a whole mesh, over floats with bounds and over the rationals.

use super::interval::Float;
use super::read::{Model, Point};
use super::scheme::Scheme;
use super::topology::{NONE, Star, Topology};
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
    /// The share of one point and the rest of another; unknown where edges are never sharp for some steps only.
    fn between(&self, _one: &Self::P, _other: &Self::P, _share: &Rational) -> Self::P {
        self.unknown()
    }
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

    fn between(&self, one: &Self::P, other: &Self::P, share: &Rational) -> Self::P {
        let share = Float::of(share);
        std::array::from_fn(|k| other[k] + share * (one[k] - other[k]))
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

    fn between(&self, one: &Self::P, other: &Self::P, share: &Rational) -> Self::P {
        let (one, other) = (one.as_ref()?, other.as_ref()?);
        Some(std::array::from_fn(|k| &other[k] + share * (&one[k] - &other[k])))
    }
}

/// The rule at a vertex, with the number of its faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Faces all around, no sharp edge.
    Inside(u32),
    /// On the border, or on one side of two sharp edges: part of a spline curve.
    Smooth(u32),
    /// On the border, or between two of several sharp edges: fixed.
    Corner(u32),
    /// Faces all around, one sharp edge.
    Dart(u32),
    /// Faces all around, no sharp edge, and fixed.
    Tip(u32),
    /// There is no rule, or faces are missing.
    Unknown,
}

impl Kind {
    /// The number of faces, 0 where nothing is known.
    #[must_use]
    pub fn faces(self) -> usize {
        match self {
            Self::Inside(n) | Self::Smooth(n) | Self::Corner(n) | Self::Dart(n) | Self::Tip(n) => n as usize,
            Self::Unknown => 0,
        }
    }

    /// The valence of a vertex with faces all around and no sharp edge.
    #[must_use]
    pub fn inside(self) -> Option<usize> {
        if let Self::Inside(n) = self { Some(n as usize) } else { None }
    }

    /// Whether the surface around it is the spline of the scheme, continued by reflection over the border.
    #[must_use]
    pub fn regular(self, triangles: bool) -> bool {
        match self {
            Self::Inside(n) => n == if triangles { 6 } else { 4 },
            Self::Smooth(n) => n == if triangles { 3 } else { 2 },
            Self::Corner(n) => n == 1,
            Self::Dart(_) | Self::Tip(_) | Self::Unknown => false,
        }
    }
}

/// A mesh at one level of refinement.
#[derive(Debug, Clone)]
pub struct Level {
    /// The faces.
    pub topology: Topology,
    /// The face of the file in which each face lies.
    pub origin: Vec<u32>,
    /// The rules at the vertices.
    pub kind: Vec<Kind>,
}

impl Level {
    /// The mesh of a file with the rules at its vertices.
    #[must_use]
    pub fn of(topology: Topology, kind: Vec<Kind>) -> Self {
        let origin = (0..topology.faces() as u32).collect();
        Self { topology, origin, kind }
    }

    /// The faces that are kept, as a mesh of their own, with the old numbers of its vertices.
    #[must_use]
    pub fn restricted(&self, keep: &[bool]) -> (Self, Vec<u32>) {
        let (topology, old) = self.topology.part(keep);
        let mut missing = vec![0_i64; old.len()];
        topology.vertex.iter().for_each(|v| missing[*v as usize] -= 1);
        let mut all = vec![0_i64; self.topology.vertices()];
        self.topology.vertex.iter().for_each(|v| all[*v as usize] += 1);
        let kind = |(v, missing): (&u32, &i64)| {
            if all[*v as usize] + missing == 0 { self.kind[*v as usize] } else { Kind::Unknown }
        };
        let kind = old.iter().zip(&missing).map(kind).collect();
        let origin = (0..self.topology.faces()).filter(|f| keep[*f]).map(|f| self.origin[f]).collect();
        (Self { topology, origin, kind }, old)
    }

    /// Whether an edge has a new point: it has two faces, or lies on a border of which an end has a rule.
    fn known(&self, [c, other]: &[u32; 2]) -> bool {
        let t = &self.topology;
        let ends = [t.vertex[*c as usize], t.vertex[t.next(*c) as usize]];
        *other != NONE || ends.iter().any(|v| self.kind[*v as usize] != Kind::Unknown)
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
        let (inside, smooth) = if triangles { (6, 3) } else { (4, 2) };
        let on_edge = |e: &[u32; 2]| match (e[1] != NONE, self.known(e)) {
            (true, _) => Kind::Inside(inside),
            (false, true) => Kind::Smooth(smooth),
            (false, false) => Kind::Unknown,
        };
        let mut kind = self.kind.clone();
        kind.extend(t.edges.iter().map(on_edge));
        if !triangles {
            kind.extend((0..t.faces()).map(|f| Kind::Inside(t.polygon(f).len() as u32)));
        }
        let topology = Topology::joined(kind.len(), corners.chunks(if triangles { 3 } else { 4 }));
        Self { topology: topology.expect("a refined surface is one"), origin, kind }
    }

    /// The points of one step; unknown where there is no rule.
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
        let edge = |e: &[u32; 2]| {
            let [c, other] = e;
            let (a, b) = (at(t.vertex[*c as usize]), at(t.vertex[t.next(*c) as usize]));
            if *other == NONE {
                return if self.known(e) { space.sum(&[(1, a), (1, b)], 2) } else { space.unknown() };
            }
            if triangles {
                let across = |c: u32| at(t.vertex[t.previous(c) as usize]);
                return space.sum(&[(3, a), (3, b), (1, across(*c)), (1, across(*other))], 8);
            }
            let beside = |c: u32| &faces[t.face[c as usize] as usize];
            space.sum(&[(1, a), (1, b), (1, beside(*c)), (1, beside(*other))], 4)
        };
        let vertices: Vec<usize> = (0..t.vertices()).collect();
        let mut new = super::each(&vertices, |v| self.moved(space, triangles, *v, old, &faces));
        new.extend(super::each(&t.edges, edge));
        new.extend(faces);
        new
    }

    /// The new point of a vertex.
    fn moved<S: Space>(&self, space: &S, triangles: bool, v: usize, old: &[S::P], faces: &[S::P]) -> S::P {
        let t = &self.topology;
        let own = &old[v];
        match self.kind[v] {
            Kind::Unknown => space.unknown(),
            Kind::Corner(_) | Kind::Tip(_) => own.clone(),
            Kind::Smooth(_) => {
                let spokes = t.around(v).spokes;
                let [first, last] = [spokes[0], spokes[spokes.len() - 1]].map(|e| &old[e as usize]);
                space.sum(&[(6, own), (1, first), (1, last)], 8)
            }
            Kind::Inside(n) | Kind::Dart(n) => {
                let star = t.around(v);
                // Both sides of the sharp edge of a dart end at the same point.
                let ring: Vec<&S::P> = star.spokes.iter().take(n as usize).map(|e| &old[*e as usize]).collect();
                if triangles { space.blend(own, &ring) } else { smooth(space, t, own, &ring, &star, faces) }
            }
        }
    }
}

/// A mesh after some steps in floating point, for drawings: points, and faces by the numbers of their corners. Faces at the
/// border, where points are missing, are left out.
#[must_use]
pub fn refined(model: &Model, scheme: Scheme, steps: usize) -> (Vec<[f64; 3]>, Vec<Vec<u32>>) {
    let triangles = scheme.triangles();
    let opened = super::open::opened(model);
    let mut soft = super::soft::Soft::of(model, &opened);
    let mut points: Vec<[Float; 3]> =
        opened.old.iter().map(|v| [0, 1, 2].map(|k| Float::of(&model.points[*v as usize][k]))).collect();
    let mut level = opened.level.clone();
    for _ in 0..steps {
        let space = Floats::new(scheme, level.kind.iter().map(|k| k.faces()));
        points = soft.points(&level, &|v| opened.site(v), &space, triangles, &points);
        (soft, level) = (soft.next(&level), level.refined(triangles));
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
