//! One step of a rule by stencils around its centre: where the neighbours of a new point are.
//!
//! Away from the centre the mesh is one lattice. A stencil is laid down from the sector of its new point and continued over the
//! spokes; where it reaches around the centre on both sides, there is no one way of doing so, and a stencil of the centre is needed.

use super::super::mesh::{Centre, Mesh, Row};
use super::super::refine::{Draft, Key, Refined, edge};
use super::super::sector::{locate, views};
use super::super::{MeshRule, SchemeError};
use super::{Element, Offset, OwnRule, failure};
use crate::poly::Poly;
use std::collections::BTreeMap;

/// The points of a mesh around its central vertex, by sector and place.
struct Around {
    centre: usize,
    n: usize,
    triangles: bool,
    places: BTreeMap<usize, (usize, Offset)>,
    points: BTreeMap<(usize, Offset), usize>,
}

/// A new point: what it lies at, its sector, the places there of the vertices of its element, and their number.
struct Spot {
    element: Element,
    sector: usize,
    corners: Vec<Offset>,
}

impl Around {
    fn new(rule: &OwnRule, mesh: &Mesh, centre: Centre) -> Option<Self> {
        let Centre::Vertex(middle, _) = centre else { return None };
        let views = views(mesh, centre)?;
        let sector = rule.split.sector();
        let (mut places, mut points) = (BTreeMap::new(), BTreeMap::new());
        for (s, view) in views.iter().enumerate() {
            for ring in 1.. {
                let inside = |j: usize| if rule.triangles() { (ring - j, j) } else { (ring, j) };
                let mut ring_places: Vec<(usize, usize)> = (0..=ring).map(inside).filter(|(i, _)| *i > 0).collect();
                if !rule.triangles() {
                    ring_places.extend((1..ring).map(|i| (i, ring)));
                }
                let before = points.len();
                for place in ring_places {
                    if let Some(v) = locate(mesh, *view, sector, place) {
                        let place = (place.0 as i64, place.1 as i64);
                        places.insert(v, (s, place));
                        points.insert((s, place), v);
                    }
                }
                if points.len() == before {
                    break;
                }
            }
        }
        Some(Self { centre: middle, n: views.len(), triangles: rule.triangles(), places, points })
    }

    /// The places of a point in the sectors that touch it.
    fn seen(&self, v: usize) -> Vec<(usize, Offset)> {
        match self.places.get(&v) {
            Some((s, (i, 0))) => vec![(*s, (*i, 0)), ((s + self.n - 1) % self.n, (0, *i))],
            Some(place) => vec![*place],
            None => Vec::new(),
        }
    }

    /// The sector in which all of some points lie, and their places there.
    fn spot(&self, element: Element, vertices: &[usize]) -> Option<Spot> {
        let other = vertices.iter().find(|v| **v != self.centre)?;
        // Of a point on a spoke the sector that begins there comes first.
        self.seen(*other).into_iter().find_map(|(sector, _)| {
            let place = |v: &usize| {
                if *v == self.centre {
                    return Some((0, 0));
                }
                self.seen(*v).into_iter().find(|(s, _)| *s == sector).map(|(_, p)| p)
            };
            Some(Spot { element, sector, corners: vertices.iter().map(place).collect::<Option<_>>()? })
        })
    }

    /// The point at a place of a sector.
    fn point(&self, sector: usize, place: Offset) -> Option<usize> {
        self.points.get(&(sector % self.n, place)).copied()
    }

    /// The place of a stencil in the lattice of the sector.
    fn laid(&self, spot: &Spot, (i, j): Offset) -> Option<Offset> {
        let (a, b) = match spot.element {
            Element::Vertex => return Some((spot.corners[0].0 + i, spot.corners[0].1 + j)),
            Element::Edge => (spot.corners[0], spot.corners[1]),
            Element::Face => (spot.corners[0], *spot.corners.get(1)?),
        };
        let u = (b.0 - a.0, b.1 - a.1);
        // The next direction anticlockwise.
        let v = if self.triangles { (-u.1, u.0 + u.1) } else { (-u.1, u.0) };
        Some((a.0 + i * u.0 + j * v.0, a.1 + i * u.1 + j * v.1))
    }

    /// The points of a regular stencil; `None` beyond the mesh, an error where it reaches around the centre.
    fn regular(
        &self,
        spot: &Spot,
        stencil: &BTreeMap<Offset, crate::arith::Rational>,
    ) -> Result<Option<Row<Poly>>, ()> {
        let middle = spot.corners.iter().fold((0, 0), |s, p| (s.0 + p.0, s.1 + p.1));
        let cross = |a: Offset, b: Offset| a.0 * b.1 - a.1 * b.0;
        let mut laid = Vec::new();
        for (offset, weight) in stencil.iter().filter(|(_, w)| **w != 0) {
            let Some(place) = self.laid(spot, *offset) else { return Ok(None) };
            laid.push((place, weight));
        }
        let usual = if self.triangles { 6 } else { 4 };
        if self.n != usual {
            let outer: Vec<Offset> = laid.iter().map(|(p, _)| *p).filter(|p| *p != (0, 0)).collect();
            let opposite = |p: &Offset| {
                cross(middle, *p) == 0 && {
                    // Both lie on one line through the centre: on its other side one coordinate has the other sign.
                    p.0 * middle.0 < 0 || p.1 * middle.1 < 0
                }
            };
            let left = outer.iter().filter(|p| cross(middle, **p) > 0);
            let around = |p: &&Offset| outer.iter().any(|q| cross(middle, *q) < 0 && cross(*q, **p) < 0);
            if middle == (0, 0) && !outer.is_empty()
                || outer.iter().any(opposite)
                || left.into_iter().any(|p| around(&p))
            {
                return Err(());
            }
        }
        let mut row = Row::new();
        for (place, weight) in laid {
            let Some(v) = self.resolved(spot.sector, place, cross(middle, place) >= 0) else { return Ok(None) };
            let sum: &mut Poly = row.entry(v).or_default();
            *sum = &*sum + &Poly::constant(weight.clone());
        }
        Ok(Some(row))
    }

    /// The point at a place of the lattice of a sector, continued over the spokes on one side.
    fn resolved(&self, sector: usize, mut place: Offset, left: bool) -> Option<usize> {
        if place == (0, 0) {
            return Some(self.centre);
        }
        let mut sector = sector + self.n;
        while place.0 < 1 || place.1 < 0 {
            let (i, j) = place;
            (place, sector) = match (left, self.triangles) {
                (true, false) => ((j, -i), sector + 1),
                (true, true) => ((i + j, -i), sector + 1),
                (false, false) => ((-j, i), sector + self.n - 1),
                (false, true) => ((-j, i + j), sector + self.n - 1),
            };
        }
        self.point(sector, place)
    }

    /// The points of a stencil of the centre, seen from a sector.
    fn central(&self, sector: usize, row: &super::Row) -> Option<Row<Poly>> {
        let mut all = Row::new();
        for (place, k, weight) in row {
            let v = match place {
                None => self.centre,
                Some((i, j)) => self.point(sector + k, (*i as i64, *j as i64))?,
            };
            let sum: &mut Poly = all.entry(v).or_default();
            *sum = &*sum + weight;
        }
        Some(all)
    }
}

impl MeshRule {
    /// One step of a rule by stencils; weights are polynomials in `2cos(2π/n)`.
    pub(in super::super) fn refine_own(
        &self,
        own: &OwnRule,
        mesh: &Mesh,
        centre: Centre,
        turn: usize,
    ) -> Result<Refined<Poly>, SchemeError> {
        let too_small = || self.error("the mesh is too small");
        let around = Around::new(own, mesh, centre).ok_or_else(too_small)?;
        let mut central = BTreeMap::new();
        for element in own.elements() {
            central.insert(*element, own.central(*element, around.n)?);
        }
        let mut draft = Draft { rows: BTreeMap::new(), faces: Vec::new() };
        self.divided(mesh, &mut draft)?;
        let mut keys: Vec<(Key, Element, Vec<usize>)> = Vec::new();
        for element in own.elements() {
            match element {
                Element::Vertex => {
                    keys.extend(mesh.vertices().into_iter().map(|v| (Key::Vertex(v), *element, vec![v])))
                }
                Element::Edge => keys.extend(mesh.inner_edges().map(|(a, b)| (edge(a, b), *element, vec![a, b]))),
                Element::Face => {
                    keys.extend(mesh.faces.iter().enumerate().map(|(f, face)| (Key::Face(f), *element, face.clone())));
                }
            }
        }
        for (key, element, vertices) in keys {
            let row = match (&central[&element], vertices.contains(&around.centre)) {
                (Some(row), true) => around.at_centre(element, &vertices, row),
                (_, at_centre) => own.row_at(&around, element, &vertices, at_centre)?,
            };
            if let Some(row) = row {
                draft.rows.insert(key, row);
            }
        }
        draft.finish(self.fresh(mesh, centre, turn)?).ok_or_else(too_small)
    }
}

impl Around {
    fn at_centre(&self, element: Element, vertices: &[usize], row: &super::Row) -> Option<Row<Poly>> {
        if element == Element::Vertex {
            return self.central(0, row);
        }
        // Of an edge the spoke, of a face the first one: its other corners see the sector too.
        self.central(self.spot(element, vertices)?.sector, row)
    }
}

impl OwnRule {
    fn row_at(
        &self,
        around: &Around,
        element: Element,
        vertices: &[usize],
        at_centre: bool,
    ) -> Result<Option<Row<Poly>>, SchemeError> {
        let Some(stencil) = self.regular.get(&element) else { return Ok(None) };
        let spot = if vertices == [around.centre] {
            Some(Spot { element, sector: 0, corners: vec![(0, 0)] })
        } else {
            around.spot(element, vertices)
        };
        let Some(spot) = spot else { return Ok(None) };
        around.regular(&spot, stencil).map_err(|()| {
            let (key, n) = (element.key(), around.n);
            failure(if at_centre {
                format!("the {key} stencil reaches around the centre, and there is none for the {key} at a centre of valence {n}")
            } else {
                format!("the {key} stencil reaches around a centre of valence {n} from a {key} that does not touch it")
            })
        })
    }
}
