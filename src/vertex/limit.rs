//! The ring of a scheme without Bézier patches: enclosures of the limit and its derivatives on cells that are divided until
//! signs are certain (docs/theory.md, Lemma 4).
//!
//! The ring of a sector are the cells at distances `r` to `N r` from the centre, `r` at least 3 and so large that their points lie at
//! distance 1 and more, where the mesh is regular.

use super::block::Vertex;
use super::field::{Enclosures, Fixed};
use super::net::{Net, Signs, Spot};
use super::regular::{BOUND_PLACES, Cell, Place, Regular, place};
use super::ring::{Control, Values};
use super::turning::{Rotation, Turning};
use crate::arith::{Integer, Rational, ratio};
use crate::ring::Field as _;
use crate::scheme::{MeshRule, Sector};
use malachite_base::num::logic::traits::SignificantBits;
use std::collections::VecDeque;
use std::sync::Arc;

/// The least inner radius of the ring.
const RADIUS: i64 = 3;
/// Binary places of the largest value: with bounds below `2^10` (see [`Regular`]) no product below leaves 128 bits.
const BITS: u64 = 48;
/// How often a cell is divided at most.
const DEPTH: usize = 12;

/// A cell of the ring or a part of one, with enclosures of its points: middles in one unit, and one error.
#[derive(Debug, Clone)]
struct Piece {
    /// The number of the cell of the ring.
    cell: usize,
    /// Where the piece lies in the cell, in its lattice refined `level` times.
    at: Cell,
    level: usize,
    x: Vec<i128>,
    y: Vec<i128>,
    error: i128,
}

/// The ring of sector 0.
#[derive(Debug)]
pub struct Ring {
    regular: Arc<Regular>,
    /// Cells that may be examined.
    most: usize,
    pieces: Vec<Piece>,
}

/// How far a place is from the centre, in faces.
fn distance(triangles: bool, (i, j): Place) -> i64 {
    if triangles { i.abs().max(j.abs()).max((i + j).abs()) } else { i.abs().max(j.abs()) }
}

/// The inner radius of the ring of cells that have these points: all of them lie at distance 1 and more.
pub(super) fn radius(triangles: bool, factor: i64, points: &[Place]) -> i64 {
    let apart = |cell: &Cell| points.iter().all(|p| distance(triangles, place(cell, *p)) >= 1);
    let most = points.iter().map(|p| distance(triangles, *p)).fold(RADIUS, i64::max) + 1;
    (RADIUS..most).find(|r| cells_between(triangles, *r, factor * r).iter().all(apart)).map_or(most, |r| r)
}

/// The cells of the ring of a sector.
pub(super) fn ring_cells(regular: &Regular) -> Vec<Cell> {
    cells_between(regular.triangles, regular.radius, regular.factor * regular.radius)
}

/// The cells of a sector between two distances.
pub(super) fn cells_between(triangles: bool, inner: i64, outer: i64) -> Vec<Cell> {
    let mut all = Vec::new();
    for i in 0..outer {
        for j in 0..outer {
            if triangles {
                if i + j >= inner && i + j < outer {
                    all.push(((i, j), 1));
                }
                if i + j + 1 >= inner && i + j + 2 <= outer {
                    all.push(((i + 1, j + 1), -1));
                }
            } else if i.max(j) >= inner {
                all.push(((i, j), 1));
            }
        }
    }
    all
}

/// Where a spot of a cell of the ring lies in the lattice of the sector; `None` for rules without such a ring.
#[must_use]
pub fn lattice_point(rule: &MeshRule, cell: usize, spot: &Spot) -> Option<(Rational, Rational)> {
    let regular = Regular::of(rule)?;
    let (corner, sign) = *ring_cells(&regular).get(cell)?;
    let along = |c: i64, x: &Rational| ratio(c, 1) + ratio(sign, 1) * x;
    Some((along(corner.0, &spot.0), along(corner.1, &spot.1)))
}

/// Whether all new points of the parts of cells of the ring follow from their neighbours as in a regular mesh: looked at on the known
/// rings, and beyond them stencils do not come near the centre.
fn regular_beyond(wide: &Vertex, regular: &Regular) -> bool {
    let distance = |p: Place| distance(regular.triangles, p);
    let usual = if regular.triangles { 6 } else { 4 };
    let Ok(there) = Vertex::new(&wide.rule.regular(), usual, wide.rings) else { return false };
    let mut nearest = i64::MAX;
    for (corner, sign) in ring_cells(regular) {
        let finer = ((regular.factor * corner.0, regular.factor * corner.1), sign);
        for part in &regular.parts {
            let at = (place(&finer, part.0), sign * part.1);
            nearest = regular.points.iter().map(|p| distance(place(&at, *p))).fold(nearest, i64::min);
        }
    }
    let row = |vertex: &Vertex, orbit: usize| {
        let (weights, own) = vertex.rational_row(orbit)?;
        let mut weights = weights.to_vec();
        weights.sort();
        Some((weights, own.clone()))
    };
    nearest >= 1
        && wide.stencils.places.iter().enumerate().all(|(orbit, (i, j))| {
            distance((*i as i64, *j as i64)) < nearest
                || row(wide, orbit).is_some_and(|own| row(&there, orbit) == Some(own))
        })
}

/// The values of an eigenvector farther out: a point beyond the known ones follows from them by its stencil, divided by the
/// eigenvalue.
fn continued(
    wide: &Vertex,
    core: &Vertex,
    field: &Enclosures,
    values: &Values<Fixed>,
    eigenvalue: &Fixed,
) -> Option<Values<Fixed>> {
    let rotation = Rotation(field);
    let inverse = rotation.plain(field.inv(eigenvalue)?);
    let mut known: Vec<Option<Turning<Fixed>>> =
        wide.stencils.places.iter().map(|p| Some(values.orbits[core.orbit(*p)?].clone())).collect();
    let mut order: Vec<usize> = (0..known.len()).filter(|i| known[*i].is_none()).collect();
    order.sort_by_key(|i| {
        let (a, b) = wide.stencils.places[*i];
        if wide.stencils.sector == Sector::Triangles { a + b } else { a.max(b) }
    });
    for orbit in order {
        let (weights, from_centre) = wide.rational_row(orbit)?;
        let mut sum = rotation.scale(&values.centre, from_centre);
        for (old, shift, weight) in weights {
            let turned = rotation.turn(known[*old].as_ref()?, *shift);
            sum = rotation.add(&sum, &rotation.scale(&turned, weight));
        }
        known[orbit] = Some(rotation.mul(&sum, &inverse));
    }
    Some(Values { centre: values.centre.clone(), orbits: known.into_iter().collect::<Option<_>>()? })
}

fn floor(x: &Integer, shift: u64) -> Option<i128> {
    i128::try_from(&(x >> shift)).ok()
}

impl Ring {
    /// The ring of an eigenvector, given near the centre. `None` for schemes whose regular rule has no bounds, or where the
    /// points given do not determine those farther out. At most `most` cells are examined for each sign.
    ///
    /// # Cost
    /// Stencils of a wider neighbourhood; see [`Regular::of`].
    #[must_use]
    pub fn new(
        vertex: &Vertex,
        field: &Enclosures,
        values: &Values<Fixed>,
        eigenvalue: &Fixed,
        most: usize,
    ) -> Option<Self> {
        let regular = Regular::of(&vertex.rule)?;
        let all = ring_cells(&regular);
        let points = |cell: &Cell| regular.points.iter().map(|p| place(cell, *p)).collect::<Vec<_>>();
        let rings = all.iter().flat_map(points).map(|p| distance(regular.triangles, p)).max()?;
        let rings = usize::try_from(rings).ok()?.max(vertex.rings);
        let wide = Vertex::new(&vertex.rule, vertex.valence, rings).ok()?;
        if vertex.rule.own().is_some() && !regular_beyond(&wide, &regular) {
            return None;
        }
        let far = continued(&wide, vertex, field, values, eigenvalue)?;
        let control = Control { vertex: &wide, field, values: &far };
        let mut nets = Vec::new();
        for cell in all {
            let at = |p: &Place| {
                let (i, j) = place(&cell, *p);
                control.at(i, j)
            };
            nets.push(regular.points.iter().map(at).collect::<Option<Vec<_>>>()?);
        }
        let size = |v: &Fixed| v.lo.significant_bits().max(v.hi.significant_bits());
        let largest = nets.iter().flatten().map(|p| size(&p.x).max(size(&p.y))).max()?;
        let shift = largest.saturating_sub(BITS);
        let mut pieces = Vec::new();
        for (cell, net) in nets.iter().enumerate() {
            let (mut x, mut y, mut error) = (Vec::new(), Vec::new(), 0);
            for p in net {
                for (v, list) in [(&p.x, &mut x), (&p.y, &mut y)] {
                    let (lo, hi) = (floor(&v.lo, shift)?, floor(&v.hi, shift)? + 1);
                    let middle = lo + (hi - lo) / 2;
                    list.push(middle);
                    error = error.max(hi - lo);
                }
            }
            pieces.push(Piece { cell, at: ((0, 0), 1), level: 0, x, y, error });
        }
        Some(Self { regular, most, pieces })
    }

    /// The parts of a piece after a step.
    fn divided(&self, piece: &Piece) -> Vec<Piece> {
        let r = &self.regular;
        let step = |rows: &Vec<Vec<(usize, i128)>>, old: &[i128]| -> Vec<i128> {
            let one =
                |row: &Vec<(usize, i128)>| row.iter().map(|(i, w)| old[*i] * w).sum::<i128>().div_euclid(r.denominator);
            rows.iter().map(one).collect()
        };
        // Rounding down adds less than one unit.
        let error = (piece.error * r.growth).div_euclid(r.denominator) + 2;
        let (corner, sign) = piece.at;
        let part = |(part, rows): (&Cell, &Vec<Vec<(usize, i128)>>)| Piece {
            cell: piece.cell,
            at: (place(&((r.factor * corner.0, r.factor * corner.1), sign), part.0), sign * part.1),
            level: piece.level + 1,
            x: step(rows, &piece.x),
            y: step(rows, &piece.y),
            error,
        };
        r.parts.iter().zip(&r.steps).map(part).collect()
    }

    /// The sign of something on a choice of cells, which are divided where it is not certain; breadth first, until both signs
    /// were met.
    fn explore(&self, first: Vec<Piece>, sign: impl Fn(&Piece) -> Option<i32>) -> Signs {
        let mut signs = Signs::default();
        let mut queue: VecDeque<Piece> = first.into();
        let mut examined = 0;
        while let Some(piece) = queue.pop_front() {
            crate::stop::check();
            if signs.changes() {
                break;
            }
            examined += 1;
            signs.depth = signs.depth.max(piece.level);
            let mark = match sign(&piece) {
                Some(s) if s > 0 => &mut signs.positive,
                Some(_) => &mut signs.negative,
                None if piece.level < DEPTH && examined + queue.len() < self.most => {
                    queue.extend(self.divided(&piece));
                    continue;
                }
                None => &mut signs.open,
            };
            mark.get_or_insert_with(|| (piece.cell, self.spot(&piece)));
            signs.pieces += 1;
        }
        signs
    }

    /// The first corner of a piece in the variables of its cell.
    fn spot(&self, piece: &Piece) -> Spot {
        let size = (0..piece.level).fold(1, |s, _| s * self.regular.factor);
        (ratio(piece.at.0.0, size), ratio(piece.at.0.1, size))
    }

    fn slack(bound: i128, roughness: i128, scale: i128) -> i128 {
        ((bound * roughness * scale) >> BOUND_PLACES) + 1
    }

    /// The sign of the Jacobian determinant in the coordinates `x + y ω`.
    #[must_use]
    pub fn jacobian(&self) -> Signs {
        let r = &self.regular;
        let (scale, _) = r.scales();
        self.explore(self.pieces.clone(), |piece| {
            let enclosed = |values: &[i128]| {
                let roughness = r.roughness(values) + 4 * piece.error;
                (r.slopes(values), Self::slack(r.slope_bound, roughness, scale) + 4 * piece.error)
            };
            let ([xu, xv], ex) = enclosed(&piece.x);
            let ([yu, yv], ey) = enclosed(&piece.y);
            let middle = xu * yv - xv * yu;
            let off = (xu.abs() + xv.abs()) * ey + (yu.abs() + yv.abs()) * ex + 2 * ex * ey;
            (middle.abs() > off).then_some(if middle > 0 { 1 } else { -1 })
        })
    }

    /// The sign of `a x + b y`, on the whole ring or on its innermost cells, which hold a closed path around the centre.
    #[must_use]
    pub fn functional(&self, (a, b): (i128, i128), innermost: bool) -> Signs {
        let r = &self.regular;
        let (_, scale) = r.scales();
        let cells = ring_cells(r);
        let near = |p: &&Piece| {
            let ((i, j), sign) = cells[p.cell];
            let distance = |(i, j): Place| if r.triangles { i + j } else { i.max(j) };
            distance((i, j)).min(distance((i + sign, j))).min(distance((i, j + sign))) == r.radius
        };
        let chosen = self.pieces.iter().filter(|p| !innermost || near(p)).cloned().collect();
        self.explore(chosen, |piece| {
            let values: Vec<i128> = piece.x.iter().zip(&piece.y).map(|(x, y)| a * x + b * y).collect();
            let error = piece.error * (a.abs() + b.abs());
            let roughness = r.roughness(&values) + 4 * error;
            // The fit at a corner has coefficients of sum 3 at most.
            let off = Self::slack(r.value_bound, roughness, scale) + 3 * scale * error;
            let fit = r.fit(&values);
            if fit.iter().all(|v| *v > off) {
                Some(1)
            } else if fit.iter().all(|v| *v < -off) {
                Some(-1)
            } else {
                None
            }
        })
    }

    /// A functional `(a, b)/unit` that may be positive on the sector, where `2 cos θ` is given: the scalar product with the
    /// sum of the corners of all cells in the metric of the true plane, as short integers.
    #[must_use]
    #[allow(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "a proposal, proved by `functional`")]
    pub fn towards(&self, twice_cosine: f64) -> ((i128, i128), i128) {
        const UNIT: f64 = 4096.0;
        let fit = |v: &[i128]| self.regular.fit(v).iter().sum::<i128>() as f64;
        let (x, y) = self.pieces.iter().fold((0.0, 0.0), |(x, y), p| (x + fit(&p.x), y + fit(&p.y)));
        let half = twice_cosine / 2.0;
        let (a, b) = (x + half * y, y + half * x);
        let scale = UNIT / a.abs().max(b.abs()).max(1.0);
        (((a * scale) as i128, (b * scale) as i128), UNIT as i128)
    }

    /// The corners of the cells in the limit, nearly, as floats `x, y` in the coordinates `x + y ω`, in a unit of its own.
    #[must_use]
    #[allow(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "pictures only")]
    pub fn corners(&self) -> Vec<Net<(f64, f64)>> {
        const STEPS: usize = 3;
        let r = &self.regular;
        let unit = 2_f64.powi(-(BITS as i32)) / r.scales().1 as f64;
        let corner = |piece: &Piece, k: usize| {
            let (i, j) = r.corners()[k];
            let own = ((i * (r.factor - 1), j * (r.factor - 1)), 1);
            let next = r.parts.iter().position(|part| *part == own).expect("the part at a corner");
            let last = (0..STEPS).fold(piece.clone(), |p, _| self.divided(&p).swap_remove(next));
            (r.fit(&last.x)[k] as f64 * unit, r.fit(&last.y)[k] as f64 * unit)
        };
        let net = |piece: &Piece| {
            let p: Vec<(f64, f64)> = (0..r.corners().len()).map(|k| corner(piece, k)).collect();
            let second = p[2..].to_vec();
            Net { triangle: r.triangles, rows: vec![vec![p[0], p[1]], second] }
        };
        self.pieces.iter().map(net).collect()
    }
}
