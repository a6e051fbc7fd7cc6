//! Mesh rules: how one step of a subdivision scheme divides a mesh and where it puts the new points.

use super::SchemeError;
use super::mesh::{Centre, Mesh, Row, Sector};
use crate::arith::{Rational, ratio};
use std::collections::BTreeMap;

/// The weights `α` of the vertex itself, `β` of all its edge neighbours together, `γ` of all opposite corners together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VertexWeights {
    /// Weight of the vertex.
    pub alpha: Rational,
    /// Sum of the weights of the edge neighbours.
    pub beta: Rational,
    /// Sum of the weights of the opposite corners of the faces.
    pub gamma: Rational,
}

/// A rule on meshes. Where weights are given, they hold for the centre; all other vertices take the regular rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshRule {
    /// Catmull and Clark (1978), with other weights at the centre where given.
    CatmullClark(Option<VertexWeights>),
    /// Loop (1987) with the weight `β` of each neighbour: original, Warren's, or given.
    Loop(LoopWeights),
    /// Doo and Sabin's dual scheme (1978): the weights in the central face.
    DooSabin(DualWeights),
    /// Kobbelt's √3 scheme (2000), two steps; the weight of all neighbours together where given.
    Sqrt3(Option<Rational>),
    /// The interpolatory butterfly scheme (Dyn, Gregory, Levin 1990) with tension `w`.
    Butterfly {
        /// The tension, usually 1/16.
        w: Rational,
        /// Zorin's modification (1996) at the centre.
        modified: bool,
    },
    /// Velho and Zorin's 4-8 scheme (2001), two steps.
    FourEight,
    /// Linear subdivision of quadrangles and triangles, then the averaging of Stam and Loop (2003) without their
    /// correction at extraordinary vertices.
    QuadTriangle,
}

/// The weight `β` of each neighbour in Loop's vertex rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LoopWeights {
    /// `(5/8 − (3/8 + cos(2π/n)/4)²)/n` (Loop 1987).
    Original,
    /// `3/(8n)`, and `3/16` for `n = 3` (Warren 1995).
    Warren,
    /// Given.
    Given(Rational),
}

/// The weights of the vertices of a face in a dual scheme, from the corner onwards.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DualWeights {
    /// `δ_j/4 + (3 + 2cos(2πj/n))/(4n)` (Doo and Sabin 1978).
    Original,
    /// `δ_j/4 + (3 + 2cos(2πfj/n))/(4n)`: the same with another frequency `f`, for counter-examples.
    Frequency(usize),
    /// The mean of the corner, the two midpoints of its edges, and the centre of the face (Catmull and Clark 1978).
    CatmullClark,
    /// `1/2, 1/4, 0, …, 0, 1/4`: two steps of the midedge scheme (Peters and Reif 1997; Habib and Warren 1999).
    Midedge,
    /// Given, for the central face; quadrangles take Doo and Sabin's.
    Given(Vec<Rational>),
}

impl MeshRule {
    /// The weights that the rule was given, by the names of the parameters; none of a rule with fixed weights.
    #[must_use]
    pub fn weights(&self) -> Vec<(&'static str, String)> {
        match self {
            Self::CatmullClark(Some(w)) => {
                vec![("alpha", w.alpha.to_string()), ("beta", w.beta.to_string()), ("gamma", w.gamma.to_string())]
            }
            Self::Loop(LoopWeights::Given(beta)) => vec![("beta", beta.to_string())],
            Self::DooSabin(DualWeights::Frequency(f)) => vec![("frequency", f.to_string())],
            Self::DooSabin(DualWeights::Given(list)) => {
                vec![("weights", list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
            }
            Self::Sqrt3(Some(alpha)) => vec![("alpha", alpha.to_string())],
            Self::Butterfly { w, .. } => vec![("w", w.to_string())],
            Self::CatmullClark(None)
            | Self::Loop(LoopWeights::Original | LoopWeights::Warren)
            | Self::DooSabin(DualWeights::Original | DualWeights::CatmullClark | DualWeights::Midedge)
            | Self::Sqrt3(None)
            | Self::FourEight
            | Self::QuadTriangle => Vec::new(),
        }
    }
}

/// A point of the refined mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Vertex(usize),
    Edge(usize, usize),
    Face(usize),
    Corner(usize, usize),
}

/// A refined mesh, its centre, and its points in terms of the old ones.
pub(super) struct Refined {
    pub mesh: Mesh,
    pub centre: Centre,
    pub rows: Vec<Row>,
}

/// `cos(2πk/n)` where it is rational.
#[must_use]
pub fn rational_cosine(k: usize, n: usize) -> Option<Rational> {
    // The angle in twelfths of a turn, where it is a whole number of them.
    if n == 0 || !(12 * k).is_multiple_of(n) {
        return None;
    }
    match (12 * k / n) % 12 {
        0 => Some(ratio(1, 1)),
        2 | 10 => Some(ratio(1, 2)),
        3 | 9 => Some(ratio(0, 1)),
        4 | 8 => Some(ratio(-1, 2)),
        6 => Some(ratio(-1, 1)),
        _ => None,
    }
}

fn count(n: usize) -> Rational {
    Rational::from(n as u64)
}

fn edge(a: usize, b: usize) -> Key {
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

impl MeshRule {
    /// The name used in messages.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::CatmullClark(_) => "Catmull–Clark",
            Self::Loop(_) => "Loop",
            Self::DooSabin(_) => "Doo–Sabin",
            Self::Sqrt3(_) => "√3",
            Self::Butterfly { .. } => "butterfly",
            Self::FourEight => "4-8",
            Self::QuadTriangle => "quad/triangle",
        }
    }

    /// The faces around a vertex where they are all of one kind.
    #[must_use]
    pub fn sector(&self) -> Sector {
        match self {
            Self::Loop(_) | Self::Sqrt3(_) | Self::Butterfly { .. } => Sector::Triangles,
            _ => Sector::Quads,
        }
    }

    /// Steps after which the mesh has its old directions again.
    #[must_use]
    pub fn steps(&self) -> usize {
        match self {
            Self::Sqrt3(_) | Self::FourEight => 2,
            _ => 1,
        }
    }

    /// Whether the centre is a face.
    #[must_use]
    pub fn dual(&self) -> bool {
        matches!(self, Self::DooSabin(_))
    }

    fn error(&self, message: &str) -> SchemeError {
        SchemeError::Mesh { rule: self.name().to_owned(), message: message.to_owned() }
    }

    fn irrational(&self, valence: usize) -> SchemeError {
        SchemeError::Irrational(format!("the rule {} at valence {valence} (cos(2π/{valence}))", self.name()))
    }

    /// One step; `turn` counts the steps, so that two of a turning scheme end in the old directions.
    pub(super) fn refine(&self, mesh: &Mesh, centre: Centre, turn: usize) -> Result<Refined, SchemeError> {
        let mut draft = Draft { rows: BTreeMap::new(), faces: Vec::new() };
        let fresh = match (self, centre) {
            (Self::DooSabin(weights), Centre::Face(f, first)) => {
                self.shrink(mesh, f, weights, &mut draft)?;
                (Key::Face(f), Key::Corner(f, first))
            }
            (Self::DooSabin(_), Centre::Vertex(..)) | (_, Centre::Face(..) | Centre::Edge(..) | Centre::Across(..)) => {
                return Err(self.error("the centre must be a face for a dual scheme and a vertex for the others"));
            }
            (Self::Sqrt3(_) | Self::FourEight, Centre::Vertex(v, first)) => {
                self.turned(mesh, v, &mut draft)?;
                let side = if turn.is_multiple_of(2) { mesh.left(v, first) } else { mesh.left(first, v) };
                (Key::Vertex(v), Key::Face(side.ok_or_else(|| self.error("the mesh is too small"))?))
            }
            (_, Centre::Vertex(v, first)) => {
                self.split(mesh, v, &mut draft)?;
                (Key::Vertex(v), edge(v, first))
            }
        };
        let too_small = || self.error("the mesh is too small");
        draft.finish(fresh).ok_or_else(too_small)
    }

    /// Schemes that keep vertices and edges and divide every face in four.
    fn split(&self, mesh: &Mesh, centre: usize, draft: &mut Draft) -> Result<(), SchemeError> {
        let quads = matches!(self, Self::CatmullClark(_));
        let triangles = matches!(self, Self::Loop(_) | Self::Butterfly { .. });
        for (f, face) in mesh.faces.iter().enumerate() {
            match *face.as_slice() {
                [a, b, c, d] if !triangles => {
                    draft.rows.insert(Key::Face(f), mean(face));
                    for (before, at, after) in [(d, a, b), (a, b, c), (b, c, d), (c, d, a)] {
                        draft.faces.push(vec![Key::Vertex(at), edge(at, after), Key::Face(f), edge(before, at)]);
                    }
                }
                [a, b, c] if !quads => {
                    for (before, at, after) in [(c, a, b), (a, b, c), (b, c, a)] {
                        draft.faces.push(vec![Key::Vertex(at), edge(at, after), edge(before, at)]);
                    }
                    draft.faces.push(vec![edge(a, b), edge(b, c), edge(c, a)]);
                }
                _ => return Err(self.error("the mesh has a face with a number of sides that the rule does not divide")),
            }
        }
        match self {
            Self::QuadTriangle => self.average(mesh, draft),
            _ => self.stencils(mesh, centre, draft),
        }
    }

    fn stencils(&self, mesh: &Mesh, centre: usize, draft: &mut Draft) -> Result<(), SchemeError> {
        for v in mesh.vertices() {
            if let Some(row) = self.vertex_row(mesh, v, v == centre)? {
                draft.rows.insert(Key::Vertex(v), row);
            }
        }
        for (a, b) in mesh.inner_edges() {
            if let Some(row) = self.edge_row(mesh, a, b, centre)? {
                draft.rows.insert(edge(a, b), row);
            }
        }
        Ok(())
    }

    fn vertex_row(&self, mesh: &Mesh, v: usize, central: bool) -> Result<Option<Row>, SchemeError> {
        let Some(star) = mesh.star(v, None) else { return Ok(None) };
        let n = star.len();
        let one = Rational::from(1);
        let mut row = Row::new();
        match self {
            Self::CatmullClark(given) => {
                let usual = VertexWeights {
                    alpha: &one - ratio(7, 4) / count(n),
                    beta: ratio(3, 2) / count(n),
                    gamma: ratio(1, 4) / count(n),
                };
                let weights = given.as_ref().filter(|_| central).unwrap_or(&usual);
                add(&mut row, v, weights.alpha.clone());
                for w in &star {
                    add(&mut row, *w, &weights.beta / count(n));
                    if let Some(f) = mesh.left(v, *w) {
                        let face = &mesh.faces[f];
                        let at = face.iter().position(|x| *x == v).unwrap_or_default();
                        add(&mut row, face[(at + 2) % face.len()], &weights.gamma / count(n));
                    }
                }
            }
            Self::Loop(weights) => {
                let beta = if n == 6 && !central { ratio(1, 16) } else { self.loop_weight(weights, n)? };
                add(&mut row, v, one - &beta * count(n));
                star.iter().for_each(|w| add(&mut row, *w, beta.clone()));
            }
            _ => add(&mut row, v, one),
        }
        Ok(Some(row))
    }

    fn loop_weight(&self, weights: &LoopWeights, n: usize) -> Result<Rational, SchemeError> {
        match weights {
            LoopWeights::Given(beta) => Ok(beta.clone()),
            LoopWeights::Warren if n == 3 => Ok(ratio(3, 16)),
            LoopWeights::Warren => Ok(ratio(3, 8) / count(n)),
            LoopWeights::Original => {
                let cosine = rational_cosine(1, n).ok_or_else(|| self.irrational(n))?;
                let inner = ratio(3, 8) + cosine / ratio(4, 1);
                Ok((ratio(5, 8) - &inner * &inner) / count(n))
            }
        }
    }

    fn edge_row(&self, mesh: &Mesh, a: usize, b: usize, centre: usize) -> Result<Option<Row>, SchemeError> {
        let mut row = Row::new();
        match self {
            Self::CatmullClark(_) => {
                add(&mut row, a, ratio(1, 4));
                add(&mut row, b, ratio(1, 4));
                for (from, to) in [(a, b), (b, a)] {
                    let Some(f) = mesh.left(from, to) else { return Ok(None) };
                    for (v, weight) in mean(&mesh.faces[f]) {
                        add(&mut row, v, weight / ratio(4, 1));
                    }
                }
            }
            Self::Loop(_) => {
                for (from, to) in [(a, b), (b, a)] {
                    let Some(c) = mesh.opposite(from, to) else { return Ok(None) };
                    add(&mut row, from, ratio(3, 8));
                    add(&mut row, c, ratio(1, 8));
                }
            }
            Self::Butterfly { modified: true, .. } if a == centre || b == centre => {
                let other = if a == centre { b } else { a };
                let Some(star) = mesh.star(centre, Some(other)) else { return Ok(None) };
                if star.len() == 6 {
                    return Ok(self.butterfly_row(mesh, a, b));
                }
                add(&mut row, centre, ratio(3, 4));
                for (w, weight) in star.iter().zip(self.zorin(star.len())?) {
                    add(&mut row, *w, weight);
                }
            }
            _ => return Ok(self.butterfly_row(mesh, a, b)),
        }
        Ok(Some(row))
    }

    fn butterfly_row(&self, mesh: &Mesh, a: usize, b: usize) -> Option<Row> {
        let Self::Butterfly { w, .. } = self else { return None };
        let mut row = Row::new();
        for (from, to) in [(a, b), (b, a)] {
            add(&mut row, from, ratio(1, 2));
            let c = mesh.opposite(from, to)?;
            add(&mut row, c, w * ratio(2, 1));
            // The far corners of the triangles beyond the other two edges.
            for (p, q) in [(to, c), (c, from)] {
                add(&mut row, mesh.opposite(q, p)?, -w);
            }
        }
        Some(row)
    }

    /// Zorin's weights around an extraordinary vertex (Zorin, Schröder, Sweldens 1996), `3/4` being at the vertex.
    fn zorin(&self, n: usize) -> Result<Vec<Rational>, SchemeError> {
        match n {
            3 => Ok(vec![ratio(5, 12), ratio(-1, 12), ratio(-1, 12)]),
            4 => Ok(vec![ratio(3, 8), ratio(0, 1), ratio(-1, 8), ratio(0, 1)]),
            _ => (0..n)
                .map(|j| {
                    let sum = ratio(1, 4) + rational_cosine(j, n)? + rational_cosine(2 * j, n)? / ratio(2, 1);
                    Some(sum / count(n))
                })
                .collect::<Option<_>>()
                .ok_or_else(|| self.irrational(n)),
        }
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

    /// Schemes that put a point into every face and join it across the edges.
    fn turned(&self, mesh: &Mesh, centre: usize, draft: &mut Draft) -> Result<(), SchemeError> {
        let size = if matches!(self, Self::FourEight) { 4 } else { 3 };
        for (f, face) in mesh.faces.iter().enumerate() {
            if face.len() != size {
                return Err(self.error("the mesh has a face with a number of sides that the rule does not divide"));
            }
            draft.rows.insert(Key::Face(f), mean(face));
        }
        for v in mesh.vertices() {
            let Some(star) = mesh.star(v, None) else { continue };
            let part = self.relaxation(star.len(), v == centre)?;
            let mut row = Row::new();
            add(&mut row, v, Rational::from(1) - &part);
            star.iter().for_each(|w| add(&mut row, *w, &part / count(star.len())));
            draft.rows.insert(Key::Vertex(v), row);
        }
        for (a, b) in mesh.inner_edges() {
            let (Some(left), Some(right)) = (mesh.left(a, b), mesh.left(b, a)) else { continue };
            let (left, right) = (Key::Face(left), Key::Face(right));
            if size == 4 {
                draft.faces.push(vec![Key::Vertex(a), right, Key::Vertex(b), left]);
            } else {
                draft.faces.push(vec![Key::Vertex(a), right, left]);
                draft.faces.push(vec![right, Key::Vertex(b), left]);
            }
        }
        Ok(())
    }

    /// The weight of all neighbours together.
    fn relaxation(&self, n: usize, central: bool) -> Result<Rational, SchemeError> {
        match self {
            Self::Sqrt3(Some(given)) if central => Ok(given.clone()),
            Self::Sqrt3(_) => {
                let cosine = rational_cosine(1, n).ok_or_else(|| self.irrational(n))?;
                Ok((ratio(4, 1) - ratio(2, 1) * cosine) / ratio(9, 1))
            }
            _ => Ok(ratio(1, 2)),
        }
    }

    /// Dual schemes: a smaller copy of every face, joined across edges and vertices.
    fn shrink(&self, mesh: &Mesh, centre: usize, rule: &DualWeights, draft: &mut Draft) -> Result<(), SchemeError> {
        for (f, face) in mesh.faces.iter().enumerate() {
            let weights = self.dual_weights(rule, face.len(), f == centre)?;
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

    fn dual_weights(&self, rule: &DualWeights, n: usize, central: bool) -> Result<Vec<Rational>, SchemeError> {
        let quarter = |j: usize| if j == 0 { ratio(1, 4) } else { ratio(0, 1) };
        let next = |j: usize| j == 1 || j + 1 == n;
        match rule {
            DualWeights::Given(weights) if central => {
                if weights.len() != n || weights.iter().fold(ratio(0, 1), |s, w| s + w) != 1 {
                    return Err(self.error("one weight for each vertex of the central face is needed, with sum 1"));
                }
                Ok(weights.clone())
            }
            DualWeights::Midedge => {
                Ok((0..n).map(|j| if j == 0 { ratio(1, 2) } else { ratio(i64::from(next(j)), 4) }).collect())
            }
            DualWeights::CatmullClark => {
                let rest = ratio(1, 4) / count(n);
                let part = |j: usize| if j == 0 { ratio(1, 2) } else { ratio(i64::from(next(j)), 8) };
                Ok((0..n).map(|j| part(j) + &rest).collect())
            }
            DualWeights::Original | DualWeights::Frequency(_) | DualWeights::Given(_) => (0..n)
                .map(|j| {
                    let turns = match rule {
                        DualWeights::Frequency(f) if central => f % n,
                        _ => 1,
                    };
                    let sum = ratio(3, 1) + ratio(2, 1) * rational_cosine(turns * j, n)?;
                    Some(quarter(j) + sum / (ratio(4, 1) * count(n)))
                })
                .collect::<Option<_>>()
                .ok_or_else(|| self.irrational(n)),
        }
    }
}

/// A refined mesh while it is built.
struct Draft {
    rows: BTreeMap<Key, Row>,
    faces: Vec<Vec<Key>>,
}

impl Draft {
    /// Keeps the faces all of whose points are known. The centre is a face where its key is one and no vertex has it.
    fn finish(self, (centre, first): (Key, Key)) -> Option<Refined> {
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
