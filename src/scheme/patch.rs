//! The patches around an extraordinary vertex as a complex of faces, edges and vertices (thesis §3.6.2).
//!
//! A cell depends on the points of all faces that touch it: a bicubic patch on 16, its edges on 12, its corners on 9; a
//! patch of Loop's box spline on 12, 10 and 7. In a dual scheme the points are the faces of the lattice: a biquadratic patch
//! depends on 9, its edges on 6, its corners on 4. Faces at the extraordinary vertex have it at their corner 0.

use super::mesh::{Centre, Mesh, Row, Sector};
use super::refine::Refined;
use super::{MeshRule, SchemeError, Split};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, Face, Frame, Layout, Piece, Shape, Side, State};
use std::collections::BTreeMap;

/// A cell in the lattice of the first sector, from a corner `(i, j)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cell {
    Vertex,
    /// An edge in direction 0 (`+u`), 1 (`+v`) or, in a triangular lattice, 2 (`−u + v`).
    Edge(usize),
    /// A quadrangle, or the triangle with corners `0, +u, +v`.
    Face,
    /// The triangle with corners `0, −u + v, +v`.
    Down,
}

type Place = (i64, i64);

/// Where a state is studied: far from the extraordinary vertex, or at it.
const FAR: Place = (2, 2);
const CENTRE: Place = (0, 0);

/// A kind of cell with the place where it is studied; `irregular` cells touch the extraordinary vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Site {
    cell: Cell,
    irregular: bool,
}

/// The complex of the patches of a rule (Catmull–Clark, Loop, or dual) around a vertex of the given valence; at a regular
/// valence, of the regular patch. The state to begin with is the face at the vertex.
///
/// # Errors
/// [`SchemeError::Mesh`] for other rules, and those of [`super::local_matrix`].
///
/// # Examples
/// ```
/// use secant::scheme::{mesh_rule, patch};
/// let complex = patch(&mesh_rule("catmull-clark", &[].into())?, 5)?;
/// assert_eq!(complex.shape.states[0].dim, 18);
/// complex.check().expect("all identities hold");
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn patch(rule: &MeshRule, valence: usize) -> Result<Complex, SchemeError> {
    Builder::new(rule, valence)?.complex()
}

/// The neighbourhood of a vertex as one automaton: state 0, the disc on two rings of points, has itself as piece 0 (so the
/// vertex has the address `(0)`) and as further pieces the regular patches of the ring that this leaves, sector by sector;
/// the other states are those of [`patch`] that these reach. No order of the pieces is meant.
///
/// # Errors
/// As for [`patch`].
///
/// # Examples
/// ```
/// use secant::scheme::{disc, mesh_rule};
/// let shape = disc(&mesh_rule("catmull-clark", &[].into())?, 3)?;
/// assert_eq!((shape.states[0].dim, shape.states[0].pieces.len()), (19, 10));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn disc(rule: &MeshRule, valence: usize) -> Result<Shape, SchemeError> {
    Ok(disc_complex(rule, valence)?.shape)
}

/// The shape of [`disc`] with the boundaries of its patches.
///
/// # Errors
/// As for [`patch`].
pub fn disc_complex(rule: &MeshRule, valence: usize) -> Result<Complex, SchemeError> {
    let builder = Builder::new(rule, valence)?;
    let Complex { mut shape, faces, reversals } = builder.complex()?;
    let sectors = builder.sectors().ok_or_else(|| builder.small())?;
    let ring = builder.mesh.walk(builder.centre, 2).ok_or_else(|| builder.small())?.points;
    let step = super::local_matrix(rule, valence, 2)?.matrix.transpose();
    let mut pieces = vec![Piece { target: 0, op: step, reversed: false, share: None }];
    for centre in sectors {
        let points = builder.points(&builder.mesh, centre, Cell::Face, CENTRE)?;
        let sector = builder.inclusion(&ring, &points)?;
        for piece in shape.states[0].pieces.iter().skip(1) {
            // Indices of states move up by one.
            pieces.push(Piece { target: piece.target + 1, op: &sector * &piece.op, reversed: false, share: None });
        }
    }
    for state in &mut shape.states {
        state.pieces.iter_mut().for_each(|p| p.target += 1);
        for boundary in [&mut state.left, &mut state.right].into_iter().flatten() {
            boundary.vertex += 1;
        }
    }
    let disc = State { name: "disc".to_owned(), kind: CellKind::Set, dim: ring.len(), pieces, left: None, right: None };
    shape.states.insert(0, disc);
    shape.check()?;
    let moved = |(index, mut face): (usize, Face)| {
        face.sides.iter_mut().for_each(|s| s.edge += 1);
        (index + 1, face)
    };
    Ok(Complex { shape, faces: faces.into_iter().map(moved).collect(), reversals })
}

fn failure(rule: &MeshRule, message: &str) -> SchemeError {
    SchemeError::Mesh { rule: rule.name().to_owned(), message: message.to_owned() }
}

/// All states; the first is the one to begin with.
fn sites(sector: Sector, regular: bool) -> Vec<Site> {
    let site = |irregular| move |cell| Site { cell, irregular };
    let (directions, down) = match sector {
        Sector::Quads => (2, None),
        Sector::Triangles => (3, Some(Cell::Down)),
    };
    let mut all = Vec::new();
    if !regular {
        all.extend([Cell::Face, Cell::Edge(0), Cell::Edge(1), Cell::Vertex].map(site(true)));
    }
    all.push(site(false)(Cell::Face));
    all.extend(down.map(site(false)));
    all.extend((0..directions).map(Cell::Edge).map(site(false)));
    all.push(site(false)(Cell::Vertex));
    all
}

fn step(direction: usize) -> Place {
    [(1, 0), (0, 1), (-1, 1)][direction]
}

fn plus(a: Place, b: Place) -> Place {
    (a.0 + b.0, a.1 + b.1)
}

struct Builder<'a> {
    rule: &'a MeshRule,
    sector: Sector,
    mesh: Mesh,
    centre: Centre,
    refined: Refined,
    sites: Vec<Site>,
}

impl<'a> Builder<'a> {
    fn new(rule: &'a MeshRule, valence: usize) -> Result<Self, SchemeError> {
        if rule.info().spline.is_none() || rule.info().split == Split::Averaged {
            return Err(failure(rule, "patches are built for Catmull–Clark's, Loop's and dual rules only"));
        }
        let sector = rule.sector();
        // The matrix checks the valence, the weights and the sums.
        super::local_matrix(rule, valence, 1)?;
        let disc = Mesh::disc(&vec![sector; valence], 7);
        let too_small = || failure(rule, "the mesh is too small");
        let (mesh, centre) =
            if rule.dual() { disc.dual(0, 1).ok_or_else(too_small)? } else { (disc, Centre::Vertex(0, 1)) };
        let refined = rule.refine(&mesh, centre, 0)?;
        let usual = if sector == Sector::Quads { 4 } else { 6 };
        Ok(Self { rule, sector, mesh, centre, refined, sites: sites(sector, valence == usual && !rule.own_weights()) })
    }

    /// The centre as seen from each sector.
    fn sectors(&self) -> Option<Vec<Centre>> {
        match self.centre {
            Centre::Vertex(v, first) => {
                Some(self.mesh.star(v, Some(first))?.into_iter().map(|w| Centre::Vertex(v, w)).collect())
            }
            Centre::Face(f, _) => {
                Some(self.mesh.walk(self.centre, 1)?.points.iter().map(|v| Centre::Face(f, *v)).collect())
            }
            Centre::Edge(..) | Centre::Across(..) => None,
        }
    }

    fn complex(&self) -> Result<Complex, SchemeError> {
        let mut states = Vec::new();
        let mut faces = BTreeMap::new();
        for (index, site) in self.sites.iter().enumerate() {
            states.push(self.state(*site)?);
            if let Some(face) = self.face(*site)? {
                faces.insert(index, face);
            }
        }
        let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
        shape.check()?;
        let complex = Complex { shape, faces, reversals: BTreeMap::new() };
        complex.check().map_err(|e| failure(self.rule, &e.to_string()))?;
        Ok(complex)
    }

    fn small(&self) -> SchemeError {
        failure(self.rule, "the mesh is too small")
    }

    fn place(&self, site: Site) -> Place {
        if site.irregular { CENTRE } else { FAR }
    }

    fn index(&self, cell: Cell, irregular: bool) -> usize {
        self.sites.iter().position(|s| *s == Site { cell, irregular }).unwrap_or_default()
    }

    /// The state of a cell at a place (of the refined mesh, or of the old one): irregular where it touches the centre.
    fn kind(&self, cell: Cell, place: Place) -> usize {
        let irregular = place == CENTRE && self.sites.iter().any(|s| s.irregular);
        self.index(cell, irregular && cell != Cell::Edge(2) && cell != Cell::Down)
    }

    /// The points on which a cell depends, in the order of its state. Near a vertex of valence 3 some may coincide.
    fn points(&self, mesh: &Mesh, centre: Centre, cell: Cell, place: Place) -> Result<Vec<usize>, SchemeError> {
        let model = self.place(self.sites[self.kind(cell, place)]);
        let (around, rings) = self.around(&self.mesh, self.centre, cell, model).ok_or_else(|| self.small())?;
        let walk = self.mesh.walk(around, rings).ok_or_else(|| self.small())?;
        let here = self.around(mesh, centre, cell, place);
        here.and_then(|(around, _)| mesh.follow(around, &walk.moves)).ok_or_else(|| self.small())
    }

    /// A cell as the centre of a walk, and how many rings belong to it.
    fn around(&self, mesh: &Mesh, centre: Centre, cell: Cell, place: Place) -> Option<(Centre, usize)> {
        let (v, ahead) = self.locate(mesh, centre, place)?;
        let star = mesh.star(v, Some(ahead))?;
        if self.rule.dual() {
            // `v` is the face of the lattice whose lower left corner is the place.
            return match cell {
                Cell::Vertex => mesh.left(v, star[2]).map(|f| (Centre::Face(f, v), 1)),
                Cell::Edge(0) => Some((Centre::Across(v, *star.get(3)?), 2)),
                Cell::Edge(_) => Some((Centre::Across(v, *star.get(2)?), 2)),
                Cell::Face => Some((Centre::Vertex(v, ahead), 1)),
                Cell::Down => None,
            };
        }
        match cell {
            Cell::Vertex => Some((Centre::Vertex(v, ahead), 1)),
            Cell::Edge(d) => Some((Centre::Edge(v, *star.get(d)?), 2)),
            Cell::Face => mesh.left(v, ahead).map(|f| (Centre::Face(f, v), 2)),
            Cell::Down => mesh.left(v, *star.get(1)?).map(|f| (Centre::Face(f, v), 2)),
        }
    }

    /// The point at a place of the first sector, and its neighbour in direction `+u`.
    fn locate(&self, mesh: &Mesh, centre: Centre, (i, j): Place) -> Option<(usize, usize)> {
        let (mut v, mut ahead) = centre.start(mesh)?;
        let (straight, left) = self.sector.turns();
        for _ in 0..i {
            let next = ahead;
            ahead = *mesh.star(next, Some(v))?.get(straight)?;
            v = next;
        }
        for _ in 0..j {
            let next = *mesh.star(v, Some(ahead))?.get(1)?;
            ahead = *mesh.star(next, Some(v))?.get(left)?;
            v = next;
        }
        Some((v, ahead))
    }

    fn old(&self, cell: Cell, place: Place) -> Result<Vec<usize>, SchemeError> {
        self.points(&self.mesh, self.centre, cell, place)
    }

    fn state(&self, site: Site) -> Result<State, SchemeError> {
        let place = self.place(site);
        let points = self.old(site.cell, place)?;
        let mut pieces = Vec::new();
        for (cell, at) in self.parts(site.cell, (2 * place.0, 2 * place.1)) {
            let new = self.points(&self.refined.mesh, self.refined.centre, cell, at)?;
            let rows: Vec<&Row> = new.iter().map(|v| &self.refined.rows[*v]).collect();
            pieces.push(Piece {
                target: self.kind(cell, at),
                op: self.operator(&points, &rows)?,
                reversed: false,
                share: None,
            });
        }
        let kind = match site.cell {
            Cell::Vertex => CellKind::Vertex,
            Cell::Edge(_) => CellKind::Edge,
            Cell::Face | Cell::Down => CellKind::Face,
        };
        let (mut left, mut right) = (None, None);
        if let Cell::Edge(direction) = site.cell {
            left = Some(self.vertex(&points, place)?);
            right = Some(self.vertex(&points, plus(place, step(direction)))?);
        }
        let tail = if site.irregular { "*" } else { "" };
        let name = match site.cell {
            Cell::Vertex => format!("vertex{tail}"),
            Cell::Edge(d) => format!("edge{d}{tail}"),
            Cell::Face => format!("face{tail}"),
            Cell::Down => "down".to_owned(),
        };
        Ok(State { name, kind, dim: points.len(), pieces, left, right })
    }

    /// The pieces of a cell at a doubled place.
    fn parts(&self, cell: Cell, at: Place) -> Vec<(Cell, Place)> {
        let by = |list: &[(Cell, Place)]| list.iter().map(|(c, d)| (*c, plus(at, *d))).collect();
        match (cell, self.sector) {
            (Cell::Vertex, _) => vec![(cell, at)],
            (Cell::Edge(d), _) => by(&[(cell, (0, 0)), (cell, step(d))]),
            (Cell::Face, Sector::Quads) => by(&[(cell, (0, 0)), (cell, (1, 0)), (cell, (0, 1)), (cell, (1, 1))]),
            (Cell::Face, Sector::Triangles) => {
                by(&[(cell, (0, 0)), (cell, (1, 0)), (cell, (0, 1)), (Cell::Down, (1, 0))])
            }
            (Cell::Down, _) => by(&[(cell, (0, 0)), (cell, (-1, 1)), (cell, (0, 1)), (Cell::Face, (-1, 1))]),
        }
    }

    /// The operator whose columns are new points in terms of the points of the cell.
    fn operator(&self, points: &[usize], rows: &[&Row]) -> Result<Matrix, SchemeError> {
        let mut op = Matrix::zero(points.len(), rows.len());
        for (column, row) in rows.iter().enumerate() {
            for (v, weight) in row.iter().filter(|(_, w)| **w != 0) {
                let at = points.iter().position(|p| p == v);
                let at = at.ok_or_else(|| failure(self.rule, "a patch depends on points outside its neighbourhood"))?;
                op[(at, column)] += weight;
            }
        }
        Ok(op)
    }

    /// The inclusion of the points of a boundary cell.
    fn inclusion(&self, points: &[usize], part: &[usize]) -> Result<Matrix, SchemeError> {
        let rows: Vec<Row> = part.iter().map(|v| Row::from([(*v, Rational::from(1))])).collect();
        self.operator(points, &rows.iter().collect::<Vec<_>>())
    }

    fn vertex(&self, points: &[usize], place: Place) -> Result<Boundary, SchemeError> {
        let op = self.inclusion(points, &self.old(Cell::Vertex, place)?)?;
        Ok(Boundary { vertex: self.kind(Cell::Vertex, place), op })
    }

    fn face(&self, site: Site) -> Result<Option<Face>, SchemeError> {
        let place = self.place(site);
        let (layout, sides): (_, &[(usize, Place)]) = match (site.cell, self.sector) {
            (Cell::Face, Sector::Quads) => {
                (Layout::Quad { columns: 2, rows: 2 }, &[(0, (0, 0)), (1, (1, 0)), (0, (0, 1)), (1, (0, 0))])
            }
            (Cell::Face, Sector::Triangles) => (Layout::Triangle, &[(0, (0, 0)), (2, (1, 0)), (1, (0, 0))]),
            (Cell::Down, _) => (Layout::Triangle, &[(2, (0, 0)), (0, (-1, 1)), (1, (0, 0))]),
            (Cell::Vertex | Cell::Edge(_), _) => return Ok(None),
        };
        let points = self.old(site.cell, place)?;
        let mut boundary = Vec::new();
        for (direction, shift) in sides {
            let at = plus(place, *shift);
            let op = self.inclusion(&points, &self.old(Cell::Edge(*direction), at)?)?;
            boundary.push(Side { edge: self.kind(Cell::Edge(*direction), at), op });
        }
        // The middle of a triangle is the other kind of triangle, whose corners come in another order.
        let placement = match layout {
            Layout::Quad { .. } => Vec::new(),
            Layout::Triangle => vec![vec![0, 1, 2], vec![0, 1, 2], vec![0, 1, 2], vec![2, 1, 0]],
        };
        Ok(Some(Face { layout, sides: boundary, placement }))
    }
}
