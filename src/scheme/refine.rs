//! One step of a mesh rule: how it divides a mesh and where it puts the new points.

use super::SchemeError;
use super::mesh::{Centre, Mesh, Row};
use super::rule::{Corners, Edge, MeshRule, Split};
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use std::collections::BTreeMap;

/// A point of the refined mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Key {
    Vertex(usize),
    Edge(usize, usize),
    Face(usize),
    Corner(usize, usize),
}

/// A refined mesh, its centre, and its points in terms of the old ones.
pub(super) struct Refined<W = Rational> {
    pub mesh: Mesh,
    pub centre: Centre,
    pub rows: Vec<Row<W>>,
}

fn count(n: usize) -> Rational {
    Rational::from(n as u64)
}

pub(super) fn edge(a: usize, b: usize) -> Key {
    Key::Edge(a.min(b), a.max(b))
}

fn add(row: &mut Row, at: usize, weight: Rational) {
    *row.entry(at).or_default() += weight;
}

fn mean(vertices: &[usize]) -> Row {
    let mut row = Row::new();
    for v in vertices {
        add(&mut row, *v, Rational::from(1) / count(vertices.len()));
    }
    row
}

impl Refined<Poly> {
    /// The same with rational weights; `None` where they are not.
    fn rational(self) -> Option<Refined> {
        let number = |(v, w): (usize, Poly)| w.degree().is_none_or(|d| d == 0).then(|| (v, w.coeff(0)));
        let row = |row: Row<Poly>| row.into_iter().map(number).collect::<Option<Row>>();
        let rows = self.rows.into_iter().map(row).collect::<Option<_>>()?;
        Some(Refined { mesh: self.mesh, centre: self.centre, rows })
    }
}

impl MeshRule {
    /// One step; `turn` counts the steps, so that two of a turning scheme end in the old directions.
    pub(super) fn refine(&self, mesh: &Mesh, centre: Centre, turn: usize) -> Result<Refined, SchemeError> {
        if let Some(own) = self.own() {
            let valence = if let Centre::Vertex(v, _) = centre { mesh.star(v, None).map_or(0, |s| s.len()) } else { 0 };
            let rational = self.refine_own(own, mesh, centre, turn)?.rational();
            return rational.ok_or_else(|| self.irrational(valence));
        }
        let mut draft = Draft { rows: BTreeMap::new(), faces: Vec::new() };
        match (self.info().split, centre) {
            (Split::Corners, Centre::Face(f, _)) => self.shrink(mesh, f, &mut draft)?,
            (_, Centre::Vertex(v, _)) => {
                self.divided(mesh, &mut draft)?;
                self.points(mesh, v, &mut draft)?;
            }
            _ => {}
        }
        let too_small = || self.error("the mesh is too small");
        draft.finish(self.fresh(mesh, centre, turn)?).ok_or_else(too_small)
    }

    /// The centre of the refined mesh, and the point with which its order begins.
    pub(super) fn fresh(&self, mesh: &Mesh, centre: Centre, turn: usize) -> Result<(Key, Key), SchemeError> {
        match (self.info().split, centre) {
            (Split::Corners, Centre::Face(f, first)) => Ok((Key::Face(f), Key::Corner(f, first))),
            (Split::Corners, Centre::Vertex(..)) | (_, Centre::Face(..) | Centre::Edge(..) | Centre::Across(..)) => {
                Err(self.error("the centre must be a face for a dual scheme and a vertex for the others"))
            }
            (Split::TurnedTriangles | Split::TurnedQuads, Centre::Vertex(v, first)) => {
                let side = if turn.is_multiple_of(2) { mesh.left(v, first) } else { mesh.left(first, v) };
                Ok((Key::Vertex(v), Key::Face(side.ok_or_else(|| self.error("the mesh is too small"))?)))
            }
            (Split::Quads | Split::Triangles | Split::Averaged, Centre::Vertex(v, first)) => {
                Ok((Key::Vertex(v), edge(v, first)))
            }
        }
    }

    /// The faces of the refined mesh, for schemes that keep the vertices.
    pub(super) fn divided<W>(&self, mesh: &Mesh, draft: &mut Draft<W>) -> Result<(), SchemeError> {
        let split = self.info().split;
        let turned = matches!(split, Split::TurnedTriangles | Split::TurnedQuads);
        let (quads, triangles) = (
            matches!(split, Split::Quads | Split::TurnedQuads),
            matches!(split, Split::Triangles | Split::TurnedTriangles),
        );
        for (f, face) in mesh.faces.iter().enumerate() {
            match *face.as_slice() {
                [a, b, c, d] if !triangles => {
                    for (before, at, after) in
                        [(d, a, b), (a, b, c), (b, c, d), (c, d, a)].into_iter().filter(|_| !turned)
                    {
                        draft.faces.push(vec![Key::Vertex(at), edge(at, after), Key::Face(f), edge(before, at)]);
                    }
                }
                [a, b, c] if !quads => {
                    for (before, at, after) in [(c, a, b), (a, b, c), (b, c, a)].into_iter().filter(|_| !turned) {
                        draft.faces.push(vec![Key::Vertex(at), edge(at, after), edge(before, at)]);
                    }
                    draft.faces.extend((!turned).then(|| vec![edge(a, b), edge(b, c), edge(c, a)]));
                }
                _ => return Err(self.error("the mesh has a face with a number of sides that the rule does not divide")),
            }
        }
        for (a, b) in mesh.inner_edges().filter(|_| turned) {
            let (Some(left), Some(right)) = (mesh.left(a, b), mesh.left(b, a)) else { continue };
            let (left, right) = (Key::Face(left), Key::Face(right));
            if quads {
                draft.faces.push(vec![Key::Vertex(a), right, Key::Vertex(b), left]);
            } else {
                draft.faces.push(vec![Key::Vertex(a), right, left]);
                draft.faces.push(vec![right, Key::Vertex(b), left]);
            }
        }
        Ok(())
    }

    /// The new points of schemes that keep the vertices.
    fn points(&self, mesh: &Mesh, centre: usize, draft: &mut Draft) -> Result<(), SchemeError> {
        let split = self.info().split;
        if split == Split::Averaged {
            for (f, face) in mesh.faces.iter().enumerate().filter(|(_, face)| face.len() == 4) {
                draft.rows.insert(Key::Face(f), mean(face));
            }
            return self.average(mesh, draft);
        }
        if split != Split::Triangles {
            draft.rows.extend(mesh.faces.iter().enumerate().map(|(f, face)| (Key::Face(f), mean(face))));
        }
        for v in mesh.vertices() {
            if let Some(row) = self.vertex_row(mesh, v, v == centre)? {
                draft.rows.insert(Key::Vertex(v), row);
            }
        }
        if matches!(split, Split::Quads | Split::Triangles) {
            for (a, b) in mesh.inner_edges() {
                if let Some(row) = self.edge_row(mesh, a, b, centre)? {
                    draft.rows.insert(edge(a, b), row);
                }
            }
        }
        Ok(())
    }

    fn vertex_row(&self, mesh: &Mesh, v: usize, central: bool) -> Result<Option<Row>, SchemeError> {
        let Some(star) = mesh.star(v, None) else { return Ok(None) };
        let n = star.len();
        let weights = self.star(n, central).ok_or_else(|| self.error("the rule has no weights at vertices"))?;
        let [own, near, opposite] = weights.rational(n).ok_or_else(|| self.irrational(n))?;
        let mut row = Row::new();
        add(&mut row, v, own);
        for w in star {
            add(&mut row, w, &near / count(n));
            if opposite != 0
                && let Some(face) = mesh.left(v, w).map(|f| &mesh.faces[f])
                && let Some(at) = face.iter().position(|x| *x == v)
            {
                add(&mut row, face[(at + 2) % face.len()], &opposite / count(n));
            }
        }
        Ok(Some(row))
    }

    fn edge_row(&self, mesh: &Mesh, a: usize, b: usize, centre: usize) -> Result<Option<Row>, SchemeError> {
        if a == centre || b == centre {
            let Some(star) = mesh.star(centre, Some(if a == centre { b } else { a })) else { return Ok(None) };
            let n = star.len();
            if let Some(wheel) = self.spokes(n) {
                let weights = wheel.rational(n).ok_or_else(|| self.irrational(n))?;
                let mut row: Row = star.into_iter().zip(weights).collect();
                add(&mut row, centre, ratio(1, 1) - wheel.total());
                return Ok(Some(row));
            }
        }
        let weights = self.edge().ok_or_else(|| self.error("the rule has no weights on edges"))?;
        Ok(regular_edge(&weights, mesh, a, b))
    }

    /// Linear subdivision followed by averaging with `α = 1/(1 + e/2 + q/4)`, `α/2` for each of the `e` neighbours and
    /// `α/4` for the opposite corner of each of the `q` quadrangles.
    fn average(&self, mesh: &Mesh, draft: &mut Draft) -> Result<(), SchemeError> {
        for v in mesh.vertices() {
            draft.rows.insert(Key::Vertex(v), mean(&[v]));
        }
        for face in &mesh.faces {
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                draft.rows.insert(edge(a, b), mean(&[a, b]));
            }
        }
        let mut keys: Vec<Key> = draft.faces.iter().flatten().copied().collect();
        keys.sort_unstable();
        keys.dedup();
        let number = |key: &Key| keys.binary_search(key).unwrap_or_default();
        let fine = Mesh::new(draft.faces.iter().map(|f| f.iter().map(number).collect()).collect());
        let mut smooth = BTreeMap::new();
        for (v, key) in keys.iter().enumerate() {
            let Some(star) = fine.star(v, None) else { continue };
            let mut parts: Vec<(usize, Rational)> = vec![(v, ratio(1, 1))];
            for w in &star {
                parts.push((*w, ratio(1, 2)));
                if let Some(face) = fine.left(v, *w).map(|f| &fine.faces[f]).filter(|f| f.len() == 4) {
                    let at = face.iter().position(|x| *x == v).unwrap_or_default();
                    parts.push((face[(at + 2) % 4], ratio(1, 4)));
                }
            }
            let total = parts.iter().fold(ratio(0, 1), |s, (_, weight)| s + weight);
            let mut row = Row::new();
            for (w, weight) in parts {
                for (old, c) in &draft.rows[&keys[w]] {
                    add(&mut row, *old, c * &weight / &total);
                }
            }
            smooth.insert(*key, row);
        }
        draft.rows = smooth;
        Ok(())
    }

    /// Dual schemes: a smaller copy of every face, joined across edges and vertices.
    fn shrink(&self, mesh: &Mesh, centre: usize, draft: &mut Draft) -> Result<(), SchemeError> {
        for (f, face) in mesh.faces.iter().enumerate() {
            let weights = self.corner_weights(face.len(), f == centre)?;
            for (k, &v) in face.iter().enumerate() {
                let mut row = Row::new();
                for (j, weight) in weights.iter().enumerate() {
                    add(&mut row, face[(k + j) % face.len()], weight.clone());
                }
                draft.rows.insert(Key::Corner(f, v), row);
            }
            draft.faces.push(face.iter().map(|v| Key::Corner(f, *v)).collect());
        }
        for v in mesh.vertices() {
            if let Some(star) = mesh.star(v, None) {
                draft.faces.push(star.iter().filter_map(|w| mesh.left(v, *w)).map(|f| Key::Corner(f, v)).collect());
            }
        }
        for (a, b) in mesh.inner_edges() {
            let (Some(left), Some(right)) = (mesh.left(a, b), mesh.left(b, a)) else { continue };
            let corner = Key::Corner;
            draft.faces.push(vec![corner(right, a), corner(right, b), corner(left, b), corner(left, a)]);
        }
        Ok(())
    }

    fn corner_weights(&self, n: usize, central: bool) -> Result<Vec<Rational>, SchemeError> {
        match self.corners(n, central) {
            None => Err(self.error("the rule has no weights in the corners of faces")),
            Some(Corners::Wheel(wheel)) => wheel.rational(n).ok_or_else(|| self.irrational(n)),
            Some(Corners::List(weights)) => {
                if weights.len() != n || weights.iter().fold(ratio(0, 1), |s, w| s + w) != 1 {
                    return Err(self.error("one weight for each vertex of the central face is needed, with sum 1"));
                }
                Ok(weights)
            }
        }
    }
}

/// The new point on an edge with all that its weights need around it.
fn regular_edge(weights: &Edge, mesh: &Mesh, a: usize, b: usize) -> Option<Row> {
    let mut row = Row::new();
    for (from, to) in [(a, b), (b, a)] {
        add(&mut row, from, weights.end.clone());
        let face = &mesh.faces[mesh.left(from, to)?];
        for c in face.iter().filter(|c| **c != from && **c != to) {
            add(&mut row, *c, weights.side.clone());
        }
        if weights.far != 0 {
            let c = mesh.opposite(from, to)?;
            for (p, q) in [(to, c), (c, from)] {
                add(&mut row, mesh.opposite(q, p)?, weights.far.clone());
            }
        }
    }
    Some(row)
}

/// A refined mesh while it is built.
pub(super) struct Draft<W = Rational> {
    pub rows: BTreeMap<Key, Row<W>>,
    pub faces: Vec<Vec<Key>>,
}

impl<W> Draft<W> {
    /// Keeps the faces all of whose points are known. The centre is a face where its key is one and no vertex has it.
    pub fn finish(self, (centre, first): (Key, Key)) -> Option<Refined<W>> {
        let keys: Vec<Key> = self.rows.keys().copied().collect();
        let number = |key: &Key| keys.binary_search(key).ok();
        let faces: Vec<Vec<usize>> = self.faces.iter().filter_map(|f| f.iter().map(number).collect()).collect();
        let centre = match centre {
            Key::Vertex(_) => Centre::Vertex(number(&centre)?, number(&first)?),
            // The faces of a dual scheme come first, in their old order.
            Key::Face(f) => {
                let face: Option<Vec<usize>> = self.faces.get(f)?.iter().map(number).collect();
                let at = faces.iter().position(|x| Some(x) == face.as_ref())?;
                Centre::Face(at, number(&first)?)
            }
            Key::Edge(..) | Key::Corner(..) => return None,
        };
        Some(Refined { mesh: Mesh::new(faces), centre, rows: self.rows.into_values().collect() })
    }
}
