//! Polygons with their points: how they hang together, and one step of subdivision. Nothing here depends on an orientation of the whole.

use super::near::{Near, Point, mixed};
use crate::base::{Checked, need, spend};

/// No vertex.
const NONE: u32 = u32::MAX;

/// Faces around an inner vertex, one after the other.
pub struct Ring {
    /// The neighbours; face `k` lies between neighbour `k` and the next.
    pub spokes: Vec<u32>,
    /// The faces.
    pub faces: Vec<u32>,
    /// Of quadrangles the corner opposite to the vertex.
    pub across: Vec<u32>,
    /// Whether all faces list their corners in the same direction around the vertex.
    pub alike: bool,
}

/// A mesh, or a part of one.
pub struct Net {
    /// The corners of each face.
    pub faces: Vec<Vec<u32>>,
    /// The points; of a part, those on its border are not known after a step.
    pub points: Vec<Point>,
    /// The sides, by their ends (the smaller number first), with their faces.
    sides: Vec<((u32, u32), u32)>,
    /// The faces at each vertex.
    at: Vec<Vec<u32>>,
}

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// The sides of a polygon.
fn around(face: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..face.len()).map(|k| (face[k], face[(k + 1) % face.len()]))
}

impl Net {
    /// Joins faces; no side may have more than two of them.
    pub fn new(faces: Vec<Vec<u32>>, points: Vec<Point>) -> Checked<Self> {
        let corners: usize = faces.iter().map(Vec::len).sum();
        spend(40 * corners, 64)?;
        let mut at = vec![Vec::new(); points.len()];
        let mut sides = Vec::with_capacity(corners);
        for (f, face) in faces.iter().enumerate() {
            face.iter().for_each(|v| at[*v as usize].push(f as u32));
            sides.extend(around(face).map(|(a, b)| (key(a, b), f as u32)));
        }
        sides.sort_unstable();
        need(sides.windows(3).all(|w| w[0].0 != w[2].0), "case", "a side with three faces")?;
        Ok(Self { faces, points, sides, at })
    }

    /// Whether any face has the vertex.
    pub fn is_used(&self, v: u32) -> bool {
        !self.at[v as usize].is_empty()
    }

    /// The faces at a side.
    fn beside(&self, a: u32, b: u32) -> &[((u32, u32), u32)] {
        let side = key(a, b);
        let from = self.sides.partition_point(|s| s.0 < side);
        let to = from + self.sides[from..].iter().take_while(|s| s.0 == side).count();
        &self.sides[from..to]
    }

    /// The face on the other side.
    fn beyond(&self, face: u32, a: u32, b: u32) -> Option<u32> {
        self.beside(a, b).iter().map(|s| s.1).find(|f| *f != face)
    }

    /// Both neighbours of a vertex in a face, and of a quadrangle the corner opposite to it.
    fn corner(&self, face: u32, v: u32) -> Option<[u32; 3]> {
        let all = &self.faces[face as usize];
        let n = all.len();
        let k = all.iter().position(|w| *w == v)?;
        Some([all[(k + n - 1) % n], all[(k + 1) % n], if n == 4 { all[(k + 2) % 4] } else { NONE }])
    }

    /// The faces from one on, leaving it over the side that is not the first, and whether they close up.
    fn walk(&self, v: u32, face: u32, first: u32) -> Option<(Ring, bool)> {
        let mut ring = Ring { spokes: Vec::new(), faces: Vec::new(), across: Vec::new(), alike: true };
        let (mut at, mut ahead) = ((face, first), Vec::new());
        loop {
            let [before, after, across] = self.corner(at.0, v)?;
            let next = if before == at.1 {
                after
            } else if after == at.1 {
                before
            } else {
                return None;
            };
            ahead.push(before == next);
            ring.alike &= ahead[0] == (before == next);
            ring.spokes.push(at.1);
            ring.faces.push(at.0);
            ring.across.push(across);
            match self.beyond(at.0, v, next) {
                None => return Some((ring, false)),
                Some(f) if (f, next) == (face, first) => return Some((ring, true)),
                Some(_) if ring.faces.len() >= self.at[v as usize].len() => return None,
                Some(f) => at = (f, next),
            }
        }
    }

    /// The ring of a vertex inside, beginning with a face and a neighbour in it.
    pub fn ring_from(&self, v: u32, face: u32, first: u32) -> Option<Ring> {
        let (ring, closed) = self.walk(v, face, first)?;
        (closed && ring.faces.len() == self.at[v as usize].len()).then_some(ring)
    }

    /// The ring of a vertex inside, in the order of its first face.
    pub fn ring(&self, v: u32) -> Option<Ring> {
        let face = *self.at[v as usize].first()?;
        let first = self.corner(face, v)?[1];
        self.ring_from(v, face, first)
    }

    /// Demands that the faces at every vertex form one ring, or one fan. Returns whether all are rings.
    pub fn is_surface(&self) -> Checked<bool> {
        let mut closed = true;
        for v in (0..self.points.len() as u32).filter(|v| self.is_used(*v)) {
            if self.ring(v).is_some() {
                continue;
            }
            closed = false;
            let all = &self.at[v as usize];
            let outer = |f: &&u32| {
                self.corner(**f, v).is_some_and(|[a, b, _]| [a, b].iter().any(|w| self.beyond(**f, v, *w).is_none()))
            };
            let fan = all.iter().find(outer).and_then(|f| {
                let [a, b, _] = self.corner(*f, v)?;
                self.walk(v, *f, if self.beyond(*f, v, a).is_none() { a } else { b })
            });
            let one = fan.is_some_and(|(ring, _)| ring.faces.len() == all.len());
            need(one, "case", "a vertex whose faces form no ring and no fan")?;
        }
        Ok(closed)
    }

    /// The part that faces with a corner among the given ones are, and the old numbers of its vertices.
    pub fn part(&self, touched: &[bool]) -> Checked<(Self, Vec<u32>, Vec<u32>)> {
        let kept: Vec<u32> = (0..self.faces.len() as u32)
            .filter(|f| self.faces[*f as usize].iter().any(|v| touched[*v as usize]))
            .collect();
        let mut number = vec![NONE; self.points.len()];
        let mut old = Vec::new();
        let mut faces = Vec::new();
        for f in &kept {
            let face = &self.faces[*f as usize];
            for v in face {
                if number[*v as usize] == NONE {
                    number[*v as usize] = old.len() as u32;
                    old.push(*v);
                }
            }
            faces.push(face.iter().map(|v| number[*v as usize]).collect());
        }
        let points = old.iter().map(|v| self.points[*v as usize]).collect();
        Ok((Self::new(faces, points)?, old, kept))
    }

    /// One step: first the vertices in their order, then the sides, then the faces. The children of a face stand together, that at its
    /// corner `k` in place `k`, with this corner first; of triangles the one in the middle is the last.
    pub fn refined(&self, triangles: bool, weight: &dyn Fn(usize) -> Near) -> Checked<Self> {
        let mut sides: Vec<(u32, u32)> = self.sides.iter().map(|s| s.0).collect();
        sides.dedup();
        spend(30 * self.sides.len(), 128)?;
        let middle = |f: usize| {
            let terms: Vec<(i64, &Point)> = self.faces[f].iter().map(|v| (1, &self.points[*v as usize])).collect();
            mixed(&terms, terms.len() as i64)
        };
        let middles: Vec<Point> = if triangles { Vec::new() } else { (0..self.faces.len()).map(middle).collect() };
        let vertex = |v: u32| match self.ring(v) {
            None => [Near::UNKNOWN; 3],
            Some(ring) => self.new_vertex(v, &ring, &middles, weight),
        };
        let mut points: Vec<Point> = (0..self.points.len() as u32).map(vertex).collect();
        points.extend(sides.iter().map(|side| self.new_side(*side, &middles)));
        let (first, last) = (self.points.len(), self.points.len() + sides.len());
        points.extend(&middles);
        let on = |a: u32, b: u32| (first + sides.partition_point(|s| *s < key(a, b))) as u32;
        let mut faces = Vec::new();
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            for k in 0..n {
                let (before, own, after) = (face[(k + n - 1) % n], face[k], face[(k + 1) % n]);
                let child = if triangles {
                    vec![own, on(own, after), on(before, own)]
                } else {
                    vec![own, on(own, after), (last + f) as u32, on(before, own)]
                };
                faces.push(child);
            }
            if triangles {
                faces.push(around(face).map(|(a, b)| on(a, b)).collect());
            }
        }
        Self::new(faces, points)
    }

    fn new_vertex(&self, v: u32, ring: &Ring, middles: &[Point], weight: &dyn Fn(usize) -> Near) -> Point {
        let n = ring.spokes.len() as i64;
        let own = &self.points[v as usize];
        let spokes: Vec<(i64, &Point)> = ring.spokes.iter().map(|w| (1, &self.points[*w as usize])).collect();
        let mean = mixed(&spokes, n);
        if middles.is_empty() {
            let w = weight(ring.spokes.len());
            return std::array::from_fn(|k| own[k].plus(w.times(mean[k].minus(own[k]))));
        }
        let beside: Vec<(i64, &Point)> = ring.faces.iter().map(|f| (1, &middles[*f as usize])).collect();
        // ((n − 2) v + ē + f̄)/n.
        mixed(&[(n - 2, own), (1, &mean), (1, &mixed(&beside, n))], n)
    }

    fn new_side(&self, (a, b): (u32, u32), middles: &[Point]) -> Point {
        let [one, other] = self.beside(a, b) else { return [Near::UNKNOWN; 3] };
        let (p, q) = (&self.points[a as usize], &self.points[b as usize]);
        if !middles.is_empty() {
            return mixed(&[(1, p), (1, q), (1, &middles[one.1 as usize]), (1, &middles[other.1 as usize])], 4);
        }
        let third = |f: u32| self.faces[f as usize].iter().find(|v| **v != a && **v != b);
        match (third(one.1), third(other.1)) {
            (Some(c), Some(d)) => {
                mixed(&[(3, p), (3, q), (1, &self.points[*c as usize]), (1, &self.points[*d as usize])], 8)
            }
            _ => [Near::UNKNOWN; 3],
        }
    }
}
