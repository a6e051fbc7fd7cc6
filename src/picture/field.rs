//! The cones of Theorem 6 along a curve: at the start of every cell the cone of its forward secants, and where it meets the
//! reversed cone at the end.

use super::Drawing;
use super::projection::{Projection, floats};
use super::svg::{Canvas, document};
use super::tikz;
use super::trace::Tracer;
use crate::arith::to_f64;
use crate::shape::{End, Shape};
use crate::theorem::cone::CommonCone;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Most cells of the last level that is drawn.
const MAX_CELLS: usize = 8;
/// Radius of the fan that shows a cone, in pixels.
const FAN: f64 = 30.0;
/// Cones narrower than this are drawn as a line, without a parallelogram.
const NARROW: f64 = 1e-5;

/// A drawing of the cones, with the number of letters of the smallest cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConeField {
    /// The picture.
    pub drawing: Drawing,
    /// The length of the words of the smallest cells.
    pub level: usize,
    /// How many of these there are.
    pub cells: usize,
}

/// A cell with its cone in the plane of the drawing.
struct Wedge {
    start: [f64; 2],
    end: [f64; 2],
    /// The angles of the two extreme rays, the first one smaller, less than half a turn apart.
    angles: (f64, f64),
}

/// A cell on the way down: its state, the map from there to the plane, and the product of the orientation signs.
struct Cell {
    state: usize,
    map: DMatrix<f64>,
    sign: f64,
}

/// The cones at the cells of the first levels of a curve.
///
/// `None` where the cones of some cell fill half of the plane of the drawing or more, or nothing finite results.
#[must_use]
pub fn cone_field(shape: &Shape, cone: &CommonCone, title: &str) -> Option<ConeField> {
    let most = shape.states.iter().map(|s| s.pieces.len()).max()?.max(2);
    let level = (1..=4u32).rev().find(|d| most.pow(*d) <= MAX_CELLS).unwrap_or(1);
    let projection = Projection::of(shape);
    let tracer = Tracer::new(shape)?;
    let start = Cell { state: shape.start, map: projection.matrix().clone(), sign: 1.0 };
    let mut levels: Vec<Vec<Wedge>> = Vec::new();
    for k in 1..=level {
        let mut wedges = Vec::new();
        descend(shape, cone, &start, k, &mut wedges)?;
        levels.push(wedges);
    }
    let wedges = levels.last()?;
    let curve = tracer.points(&projection);
    let corners = levels.iter().flatten().filter_map(Wedge::parallelogram).flatten();
    let all: Vec<[f64; 2]> = curve.iter().copied().chain(corners).collect();
    if curve.is_empty() || !all.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    let mut canvas = Canvas::around(&all, title);
    for corners in levels.iter().flatten().filter_map(Wedge::parallelogram) {
        canvas.filled("sc-x", &corners);
    }
    for wedge in wedges {
        canvas.fan("sc-y", wedge.start, wedge.angles, FAN);
    }
    canvas.curve(&curve);
    for spot in wedges.iter().map(|w| w.start).chain(wedges.last().map(|w| w.end)) {
        canvas.dot(spot);
    }
    let [width, height] = canvas.size();
    let svg = document(canvas.elements(), width, height, title);
    let drawing = Drawing { svg, tikz: tikz::picture(canvas.elements()) };
    Some(ConeField { drawing, level: usize::try_from(level).unwrap_or(1), cells: wedges.len() })
}

/// Goes down to the cells of a level, in the order of the curve.
fn descend(shape: &Shape, cone: &CommonCone, cell: &Cell, level: u32, out: &mut Vec<Wedge>) -> Option<()> {
    if level == 0 {
        out.push(wedge(shape, cone, cell)?);
        return Some(());
    }
    let pieces = &shape.states[cell.state].pieces;
    for k in 0..pieces.len() {
        // A cell that runs backwards has its pieces in the opposite order.
        let piece = &pieces[if cell.sign < 0.0 { pieces.len() - 1 - k } else { k }];
        let sign = if piece.reversed { -cell.sign } else { cell.sign };
        let inner = Cell { state: piece.target, map: &cell.map * floats(&piece.op), sign };
        descend(shape, cone, &inner, level - 1, out)?;
    }
    Some(())
}

fn wedge(shape: &Shape, cone: &CommonCone, cell: &Cell) -> Option<Wedge> {
    let own = cone.cones.iter().find(|c| c.state == cell.state)?;
    let placed = |end: End| {
        let point = shape.end_point(cell.state, end)?;
        let p = &cell.map * DVector::from_vec(point.iter().map(to_f64).collect());
        Some([p[0], p[1]])
    };
    let (first, second) = (placed(End::Start)?, placed(End::Finish)?);
    let (start, end) = if cell.sign < 0.0 { (second, first) } else { (first, second) };
    let middle = (end[1] - start[1]).atan2(end[0] - start[0]);
    let rays = &cell.map * floats(&own.rays) * cell.sign;
    let mut angles = (0.0f64, 0.0f64);
    for j in 0..rays.ncols() {
        let (x, y) = (rays[(0, j)], rays[(1, j)]);
        if x.hypot(y) < 1e-12 {
            return None;
        }
        let turn = (y.atan2(x) - middle + PI).rem_euclid(2.0 * PI) - PI;
        angles = (angles.0.min(turn), angles.1.max(turn));
    }
    let convex = angles.1 - angles.0 < PI - 1e-6;
    convex.then_some(Wedge { start, end, angles: (middle + angles.0, middle + angles.1) })
}

impl Wedge {
    /// Where the cone at the start meets the reversed cone at the end: the cell lies inside.
    fn parallelogram(&self) -> Option<[[f64; 2]; 4]> {
        let (a, b) = self.angles;
        if b - a < NARROW {
            return None;
        }
        let (r, s) = ([a.cos(), a.sin()], [b.cos(), b.sin()]);
        let chord = [self.end[0] - self.start[0], self.end[1] - self.start[1]];
        let det = r[0] * s[1] - r[1] * s[0];
        let along = [(chord[0] * s[1] - chord[1] * s[0]) / det, (r[0] * chord[1] - r[1] * chord[0]) / det];
        let corner = |d: [f64; 2], length: f64| [self.start[0] + d[0] * length, self.start[1] + d[1] * length];
        Some([self.start, corner(r, along[0]), self.end, corner(s, along[1])])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parallelogram_has_the_chord_as_a_diagonal() {
        let wedge = Wedge { start: [1.0, 1.0], end: [3.0, 2.0], angles: (0.0, PI / 2.0) };
        let corners = wedge.parallelogram().unwrap();
        let expected = [[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 2.0]];
        for (a, b) in corners.iter().flatten().zip(expected.iter().flatten()) {
            assert!((a - b).abs() < 1e-12, "{corners:?}");
        }
        assert!(Wedge { angles: (0.3, 0.3), ..wedge }.parallelogram().is_none());
    }
}
