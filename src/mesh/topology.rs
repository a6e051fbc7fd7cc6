//! Faces and how they hang together. Nothing here depends on an orientation of the whole: surfaces with one side are meshes too.

/// No corner.
pub const NONE: u32 = u32::MAX;

/// Why faces form no surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Fault {
    /// An edge of three faces or more.
    Edge {
        /// Its ends.
        ends: (u32, u32),
        /// The faces.
        faces: Vec<usize>,
    },
    /// The faces at a vertex form several fans.
    Vertex {
        /// The vertex.
        vertex: usize,
        /// Faces of two of them.
        faces: (usize, usize),
    },
}

/// Polygons and their corners, by numbers. The corners of a face stand together, in its own order.
#[derive(Debug, Clone)]
pub struct Topology {
    starts: Vec<u32>,
    /// The vertex of each corner.
    pub vertex: Vec<u32>,
    /// The face of each corner.
    pub face: Vec<u32>,
    /// The edge from each corner to the next.
    pub edge: Vec<u32>,
    /// The corners from which an edge starts in its two faces; the second is `u32::MAX` where there is one face only.
    pub edges: Vec<[u32; 2]>,
    /// A corner of each vertex, `u32::MAX` where no face has it.
    pub corner: Vec<u32>,
}

/// A corner of a face, seen from a side: `ahead` is the order of the face itself, or the other one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    /// The corner.
    pub corner: u32,
    /// Whether anticlockwise is the order of the face.
    pub ahead: bool,
}

/// The faces around a vertex, anticlockwise as seen from the side of the frame with which they begin.
#[derive(Debug, Clone)]
pub struct Star {
    /// The neighbours; face `k` lies between neighbour `k` and the next.
    pub spokes: Vec<u32>,
    /// The corners at the vertex.
    pub frames: Vec<Frame>,
    /// Whether the faces close up.
    pub closed: bool,
}

impl Topology {
    /// Joins faces of given corners.
    ///
    /// # Errors
    /// A [`Fault`] where they form no surface.
    pub fn new(vertices: usize, faces: &[Vec<u32>]) -> Result<Self, Fault> {
        let topology = Self::joined(vertices, faces.iter().map(Vec::as_slice))?;
        topology.check_vertices()?;
        Ok(topology)
    }

    pub(super) fn joined<'a>(vertices: usize, faces: impl Iterator<Item = &'a [u32]>) -> Result<Self, Fault> {
        let (mut starts, mut vertex, mut face) = (vec![0], Vec::new(), Vec::new());
        let mut corner = vec![NONE; vertices];
        for (f, corners) in faces.enumerate() {
            for v in corners {
                corner[*v as usize] = vertex.len() as u32;
                vertex.push(*v);
                face.push(f as u32);
            }
            starts.push(vertex.len() as u32);
        }
        let mut all = Self { starts, vertex, face, edge: Vec::new(), edges: Vec::new(), corner };
        let mut sides: Vec<(u32, u32, u32)> = (0..all.vertex.len() as u32)
            .map(|c| {
                let (a, b) = (all.vertex[c as usize], all.vertex[all.next(c) as usize]);
                (a.min(b), a.max(b), c)
            })
            .collect();
        sides.sort_unstable();
        all.edge = vec![NONE; all.vertex.len()];
        for group in sides.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
            if group.len() > 2 {
                let faces = group.iter().map(|(_, _, c)| all.face[*c as usize] as usize).collect();
                return Err(Fault::Edge { ends: (group[0].0, group[0].1), faces });
            }
            group.iter().for_each(|(_, _, c)| all.edge[*c as usize] = all.edges.len() as u32);
            all.edges.push([group[0].2, group.get(1).map_or(NONE, |g| g.2)]);
        }
        Ok(all)
    }

    fn check_vertices(&self) -> Result<(), Fault> {
        let mut counts = vec![0_usize; self.vertices()];
        self.vertex.iter().for_each(|v| counts[*v as usize] += 1);
        for (v, count) in counts.into_iter().enumerate().filter(|(_, count)| *count > 0) {
            let star = self.around(v);
            if star.frames.len() != count {
                let seen: Vec<u32> = star.frames.iter().map(|f| f.corner).collect();
                let own = |c: &u32| self.vertex[*c as usize] == v as u32 && !seen.contains(c);
                let other = (0..self.vertex.len() as u32).find(own).map_or(seen[0], |c| c);
                let faces = (self.face[seen[0] as usize] as usize, self.face[other as usize] as usize);
                return Err(Fault::Vertex { vertex: v, faces });
            }
        }
        Ok(())
    }

    /// The number of faces.
    #[must_use]
    pub fn faces(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.corner.len()
    }

    /// The corners of a face.
    #[must_use]
    pub fn corners(&self, face: usize) -> std::ops::Range<u32> {
        self.starts[face]..self.starts[face + 1]
    }

    /// The first corner of the face with these vertices in this order.
    #[must_use]
    pub fn corner_of(&self, polygon: &[u32]) -> Option<u32> {
        (0..self.faces()).find(|f| self.polygon(*f) == polygon).map(|f| self.starts[f])
    }

    /// The vertices of a face.
    #[must_use]
    pub fn polygon(&self, face: usize) -> &[u32] {
        &self.vertex[self.starts[face] as usize..self.starts[face + 1] as usize]
    }

    /// The next corner of the face.
    #[must_use]
    pub fn next(&self, c: u32) -> u32 {
        let f = self.face[c as usize] as usize;
        if c + 1 == self.starts[f + 1] { self.starts[f] } else { c + 1 }
    }

    /// The corner before.
    #[must_use]
    pub fn previous(&self, c: u32) -> u32 {
        let f = self.face[c as usize] as usize;
        if c == self.starts[f] { self.starts[f + 1] - 1 } else { c - 1 }
    }

    pub(super) fn opposite(&self, c: u32) -> Option<u32> {
        let [a, b] = self.edges[self.edge[c as usize] as usize];
        Some(if a == c { b } else { a }).filter(|other| *other != NONE)
    }

    /// The corners next to one of a frame: the one that comes first anticlockwise around its vertex, and the other.
    fn sides(&self, frame: Frame) -> (u32, u32) {
        let (next, previous) = (self.next(frame.corner), self.previous(frame.corner));
        if frame.ahead { (next, previous) } else { (previous, next) }
    }

    /// The frame at the vertex of the next face anticlockwise.
    fn turned(&self, frame: Frame) -> Option<Frame> {
        let side = if frame.ahead { self.previous(frame.corner) } else { frame.corner };
        let other = self.opposite(side)?;
        let ahead = self.vertex[other as usize] == self.vertex[frame.corner as usize];
        Some(Frame { corner: if ahead { other } else { self.next(other) }, ahead })
    }

    /// The star of the vertex of a frame, beginning with its face.
    #[must_use]
    pub fn star(&self, start: Frame) -> Star {
        let (mut spokes, mut frames) = (Vec::new(), Vec::new());
        let mut at = start;
        loop {
            frames.push(at);
            let (first, last) = self.sides(at);
            spokes.push(self.vertex[first as usize]);
            match self.turned(at) {
                Some(next) if next.corner == start.corner => return Star { spokes, frames, closed: true },
                Some(next) if frames.len() <= self.vertex.len() => at = next,
                _ => {
                    spokes.push(self.vertex[last as usize]);
                    return Star { spokes, frames, closed: false };
                }
            }
        }
    }

    /// The whole star of a vertex: where it is open it begins at the border.
    ///
    /// # Panics
    /// If no face has the vertex.
    #[must_use]
    pub fn around(&self, vertex: usize) -> Star {
        self.whole(Frame { corner: self.corner[vertex], ahead: true })
    }

    /// The whole star of the vertex of a frame, seen from its side: where it is open it begins at the border.
    #[must_use]
    pub fn whole(&self, frame: Frame) -> Star {
        let star = self.star(frame);
        if star.closed {
            return star;
        }
        let back = self.star(Frame { ahead: !frame.ahead, ..frame });
        let last = back.frames[back.frames.len() - 1];
        self.star(Frame { corner: last.corner, ahead: !last.ahead })
    }

    /// The faces that are kept, with the old numbers of their vertices.
    #[must_use]
    pub fn part(&self, keep: &[bool]) -> (Self, Vec<u32>) {
        let mut number = vec![NONE; self.vertices()];
        let mut moved = vec![NONE; self.vertex.len()];
        let mut old = Vec::new();
        let (mut starts, mut vertex, mut face, mut corner) = (vec![0], Vec::new(), Vec::new(), Vec::new());
        for f in (0..self.faces()).filter(|f| keep[*f]) {
            for c in self.corners(f) {
                let v = self.vertex[c as usize];
                if number[v as usize] == NONE {
                    number[v as usize] = old.len() as u32;
                    old.push(v);
                    corner.push(NONE);
                }
                moved[c as usize] = vertex.len() as u32;
                corner[number[v as usize] as usize] = vertex.len() as u32;
                vertex.push(number[v as usize]);
                face.push(starts.len() as u32 - 1);
            }
            starts.push(vertex.len() as u32);
        }
        let mut edge = vec![NONE; vertex.len()];
        let mut edges = Vec::new();
        for pair in &self.edges {
            let own = pair.iter().filter(|c| **c != NONE).map(|c| moved[*c as usize]).filter(|c| *c != NONE);
            let own: Vec<u32> = own.collect();
            let Some(first) = own.first() else { continue };
            own.iter().for_each(|c| edge[*c as usize] = edges.len() as u32);
            edges.push([*first, own.get(1).map_or(NONE, |c| *c)]);
        }
        (Self { starts, vertex, face, edge, edges, corner }, old)
    }

    /// The frame of the same face at the neighbour that comes first.
    #[must_use]
    pub fn first_side(&self, frame: Frame) -> Frame {
        Frame { corner: self.sides(frame).0, ahead: frame.ahead }
    }

    /// The frame of the same face at the other neighbour.
    #[must_use]
    pub fn last_side(&self, frame: Frame) -> Frame {
        Frame { corner: self.sides(frame).1, ahead: frame.ahead }
    }

    /// The vertex opposite to a corner of a quadrangle.
    #[must_use]
    pub fn diagonal(&self, corner: u32) -> u32 {
        self.vertex[self.next(self.next(corner)) as usize]
    }

    /// Whether all edges have two faces.
    #[must_use]
    pub fn closed(&self) -> bool {
        self.edges.iter().all(|e| e[1] != NONE)
    }

    /// The parts that hang together, by face, their number, and for each whether it has two sides.
    #[must_use]
    pub fn parts(&self) -> (Vec<usize>, Vec<bool>) {
        let mut part = vec![usize::MAX; self.faces()];
        let mut turned = vec![false; self.faces()];
        let mut sides = Vec::new();
        for start in 0..self.faces() {
            if part[start] != usize::MAX {
                continue;
            }
            let (own, mut two) = (sides.len(), true);
            part[start] = own;
            let mut stack = vec![start];
            while let Some(f) = stack.pop() {
                for c in self.corners(f) {
                    let Some(other) = self.opposite(c) else { continue };
                    let g = self.face[other as usize] as usize;
                    // Neighbours with the same order run through their edge in opposite directions.
                    let flips = self.vertex[other as usize] == self.vertex[c as usize];
                    if part[g] == usize::MAX {
                        (part[g], turned[g]) = (own, turned[f] != flips);
                        stack.push(g);
                    } else {
                        two &= turned[g] == (turned[f] != flips);
                    }
                }
            }
            sides.push(two);
        }
        (part, sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_and_sides() {
        let cube: Vec<Vec<u32>> = vec![
            vec![0, 3, 2, 1],
            vec![4, 5, 6, 7],
            vec![0, 1, 5, 4],
            vec![1, 2, 6, 5],
            vec![2, 3, 7, 6],
            vec![3, 0, 4, 7],
        ];
        let t = Topology::new(8, &cube).unwrap();
        assert!(t.closed() && t.edges.len() == 12);
        for v in 0..8 {
            let star = t.around(v);
            assert!(star.closed && star.spokes.len() == 3);
        }
        assert_eq!(t.parts().1, [true]);
        // One face turned over: the same surface, with stars all the same.
        let mut other = cube.clone();
        other[4].reverse();
        let t = Topology::new(8, &other).unwrap();
        assert!((0..8).all(|v| t.around(v).closed) && t.parts().1 == [true]);
    }

    #[test]
    fn a_strip_with_one_side() {
        let strip: Vec<Vec<u32>> = vec![vec![0, 1, 3, 2], vec![2, 3, 5, 4], vec![4, 5, 0, 1]];
        let t = Topology::new(6, &strip).unwrap();
        assert_eq!(t.parts().1, [false]);
        assert!(!t.closed() && !t.around(0).closed && t.around(0).frames.len() == 2);
    }

    #[test]
    fn faults() {
        let book = vec![vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]];
        assert!(matches!(Topology::new(5, &book), Err(Fault::Edge { ends: (0, 1), .. })));
        let bow = vec![vec![0, 1, 2], vec![0, 3, 4]];
        assert_eq!(Topology::new(5, &bow).err(), Some(Fault::Vertex { vertex: 0, faces: (1, 0) }));
    }
}
