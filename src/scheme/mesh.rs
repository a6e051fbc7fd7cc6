//! Meshes around one vertex or face, and the order of their points.

use crate::arith::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// A control point as a combination of earlier ones.
pub(super) type Row<W = Rational> = BTreeMap<usize, W>;

/// What the points of a local mesh lie around.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Centre {
    /// A vertex, and the neighbour with which the order begins.
    Vertex(usize, usize),
    /// A directed edge, with all faces that touch it.
    Edge(usize, usize),
    /// A directed edge, with the two faces that share it.
    Across(usize, usize),
    /// A face, and the vertex with which the order begins.
    Face(usize, usize),
}

impl Centre {
    /// The first point of the sector that the centre is seen from, and its neighbour in direction `+u`; `None` for an edge.
    pub fn start(self, mesh: &Mesh) -> Option<(usize, usize)> {
        match self {
            Self::Vertex(v, ahead) => Some((v, ahead)),
            // From a corner of the central face the next one lies in direction `−u`.
            Self::Face(f, v) => {
                let face = mesh.faces.get(f)?;
                let at = face.iter().position(|x| *x == v)?;
                Some((v, *mesh.star(v, Some(face[(at + 1) % face.len()]))?.get(2)?))
            }
            Self::Edge(..) | Self::Across(..) => None,
        }
    }
}

/// The points around a centre, in order.
pub(super) struct Walk {
    /// The points.
    pub points: Vec<usize>,
    /// Number of points up to each ring.
    pub ends: Vec<usize>,
    /// How each point after the centre's own was found: from which point, over which edge of its star, how far along the
    /// face beyond.
    pub moves: Vec<(usize, usize, usize)>,
}

/// The kind of the faces between two spokes of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sector {
    /// Quadrangles.
    Quads,
    /// Triangles.
    Triangles,
}

impl Sector {
    /// How many neighbours on, anticlockwise, the way lies straight ahead, and to the left towards the next spoke.
    pub(super) fn turns(self) -> (usize, usize) {
        match self {
            Self::Quads => (2, 1),
            Self::Triangles => (3, 2),
        }
    }
}

/// An oriented mesh with boundary: faces list their vertices anticlockwise.
#[derive(Debug, Clone)]
pub(super) struct Mesh {
    pub faces: Vec<Vec<usize>>,
    /// The face on the left of each directed edge, and the position of its first vertex there.
    edges: BTreeMap<(usize, usize), (usize, usize)>,
}

impl Mesh {
    pub fn new(faces: Vec<Vec<usize>>) -> Self {
        let mut edges = BTreeMap::new();
        for (f, face) in faces.iter().enumerate() {
            for (k, &v) in face.iter().enumerate() {
                edges.insert((v, face[(k + 1) % face.len()]), (f, k));
            }
        }
        Self { faces, edges }
    }

    /// The mesh of `rings` rings of faces around vertex 0, with one sector after the other; vertex 1 lies on the first spoke.
    pub fn disc(sectors: &[Sector], rings: usize) -> Self {
        Self::uneven_disc(sectors, |_| rings)
    }

    /// The same with a number of rings for each sector.
    pub fn uneven_disc(sectors: &[Sector], rings: impl Fn(usize) -> usize) -> Self {
        let mut index: BTreeMap<(usize, usize, usize), usize> = BTreeMap::new();
        let mut id = |s: usize, i: usize, j: usize| {
            let key = match (i, j) {
                (0, 0) => (0, 0, 0),
                (0, j) => ((s + 1) % sectors.len(), j, 0),
                (i, j) => (s, i, j),
            };
            let next = index.len();
            *index.entry(key).or_insert(next)
        };
        id(0, 0, 0);
        id(0, 1, 0);
        let mut faces = Vec::new();
        for (s, kind) in sectors.iter().enumerate() {
            let rings = rings(s);
            for i in 0..rings {
                for j in 0..rings {
                    match kind {
                        Sector::Quads => {
                            faces.push(vec![id(s, i, j), id(s, i + 1, j), id(s, i + 1, j + 1), id(s, i, j + 1)]);
                        }
                        Sector::Triangles => {
                            if i + j < rings {
                                faces.push(vec![id(s, i, j), id(s, i + 1, j), id(s, i, j + 1)]);
                            }
                            if i + j + 1 < rings {
                                faces.push(vec![id(s, i + 1, j), id(s, i + 1, j + 1), id(s, i, j + 1)]);
                            }
                        }
                    }
                }
            }
        }
        Self::new(faces)
    }

    /// The mesh whose vertices are the faces of this one and whose faces are its inner vertices; the centre becomes a face.
    pub fn dual(&self, centre: usize, first: usize) -> Option<(Self, Centre)> {
        let mut faces = Vec::new();
        let mut middle = None;
        for v in self.vertices() {
            let Some(star) = self.star(v, None) else { continue };
            if v == centre {
                middle = Some(faces.len());
            }
            faces.push(star.iter().filter_map(|w| self.left(v, *w)).collect());
        }
        let start = self.left(centre, first)?;
        Some((Self::new(faces), Centre::Face(middle?, start)))
    }

    /// All vertices, ascending.
    pub fn vertices(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.faces.iter().flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The undirected edges `a < b` with a face on both sides.
    pub fn inner_edges(&self) -> impl Iterator<Item = (usize, usize)> {
        self.edges.keys().copied().filter(|(a, b)| a < b && self.edges.contains_key(&(*b, *a)))
    }

    /// The face on the left of `a -> b`.
    pub fn left(&self, a: usize, b: usize) -> Option<usize> {
        self.edges.get(&(a, b)).map(|(f, _)| *f)
    }

    /// The vertex of a triangle on the left of `a -> b`.
    pub fn opposite(&self, a: usize, b: usize) -> Option<usize> {
        let (f, k) = *self.edges.get(&(a, b))?;
        let face = &self.faces[f];
        (face.len() == 3).then(|| face[(k + 2) % 3])
    }

    /// The neighbours of an inner vertex anticlockwise, beginning with `first`; `None` at the boundary.
    pub fn star(&self, v: usize, first: Option<usize>) -> Option<Vec<usize>> {
        let begin = first.or_else(|| self.edges.range((v, 0)..=(v, usize::MAX)).next().map(|((_, w), _)| *w))?;
        let mut around = vec![begin];
        loop {
            let (f, k) = *self.edges.get(&(v, around[around.len() - 1]))?;
            let face = &self.faces[f];
            let next = face[(k + face.len() - 1) % face.len()];
            if next == begin {
                return Some(around);
            }
            around.push(next);
        }
    }

    /// The points up to a number of rings of faces around the centre, in an order that only depends on the mesh: ring by
    /// ring, anticlockwise. `None` where the mesh is too small.
    pub fn walk(&self, centre: Centre, rings: usize) -> Option<Walk> {
        let mut order = self.beginning(centre)?;
        let mut seen: BTreeSet<usize> = order.iter().map(|(v, _)| *v).collect();
        let mut ends = if matches!(centre, Centre::Vertex(..)) { vec![1] } else { vec![0, order.len()] };
        let turns = if matches!(centre, Centre::Across(..)) { 1 } else { usize::MAX };
        let mut moves = Vec::new();
        let mut processed = 0;
        while ends.len() <= rings {
            let end = order.len();
            while processed < end {
                let (v, first) = order[processed];
                for (turn, w) in self.star(v, Some(first))?.into_iter().enumerate().take(turns) {
                    for step in 1..self.faces[self.left(v, w)?].len() {
                        let point = self.beyond(v, w, step)?;
                        if seen.insert(point.0) {
                            order.push(point);
                            moves.push((processed, turn, step));
                        }
                    }
                }
                processed += 1;
            }
            ends.push(order.len());
        }
        Some(Walk { points: order.into_iter().map(|(v, _)| v).collect(), ends, moves })
    }

    /// The points that the moves of a walk lead to around another centre; some may coincide.
    pub fn follow(&self, centre: Centre, moves: &[(usize, usize, usize)]) -> Option<Vec<usize>> {
        let mut order = self.beginning(centre)?;
        for (from, turn, step) in moves {
            let (v, first) = *order.get(*from)?;
            let w = *self.star(v, Some(first))?.get(*turn)?;
            order.push(self.beyond(v, w, *step)?);
        }
        Some(order.into_iter().map(|(v, _)| v).collect())
    }

    /// The points of the centre itself, each with the neighbour from which its star is read.
    fn beginning(&self, centre: Centre) -> Option<Vec<(usize, usize)>> {
        match centre {
            Centre::Vertex(v, first) => Some(vec![(v, first)]),
            Centre::Edge(a, b) | Centre::Across(a, b) => Some(vec![(a, b), (b, a)]),
            Centre::Face(f, first) => {
                let face = self.faces.get(f)?;
                let at = face.iter().position(|v| *v == first)?;
                let corner = |k: usize| face[(at + k) % face.len()];
                Some((0..face.len()).map(|k| (corner(k), corner(k + 1))).collect())
            }
        }
    }

    /// The vertex `step` places after `v` in the face on the left of `v -> w`, and the one after it.
    fn beyond(&self, v: usize, w: usize, step: usize) -> Option<(usize, usize)> {
        let (f, k) = *self.edges.get(&(v, w))?;
        let face = &self.faces[f];
        Some((face[(k + step) % face.len()], face[(k + step + 1) % face.len()]))
    }
}
