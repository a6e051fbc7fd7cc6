//! A branch seen closer and closer: cells around the point, and how far secants are from the tangent line.

use super::chart::Turning;
use super::diagram::{Drawing, Sheet};
use super::projection::{Projection, floats};
use super::svg::Anchor;
use super::trace::Tracer;
use crate::arith::Rational;
use crate::jordan::Scalar;
use crate::linalg::Matrix;
use crate::shape::Shape;
use crate::theorem::{BranchReport, Outcome, Rate};
use nalgebra::{DMatrix, DVector};

/// Turns of the cycle shown by a series.
const TURNS: [usize; 4] = [0, 2, 4, 6];
/// Most points of a panel and branch.
const MAX_POINTS: usize = 260;
/// Binary digits of what is drawn.
const BITS: u64 = 200;
/// Turns over which angles are measured.
const MEASURED: usize = 12;
/// About so many points of the ring are followed.
const SAMPLES: usize = 300;

/// The cells `T_u M^m A` of the branches of a point, each panel enlarged to the same size, with the tangent line where there
/// is one.
///
/// `None` where nothing finite results.
#[must_use]
pub fn zoom<E: Scalar>(
    (shape, drawn): (&Shape<E>, &Shape),
    at: &[E],
    branches: &[&BranchReport<E>],
    tangent: Option<&[f64]>,
    title: &str,
) -> Option<Drawing> {
    const PANEL: f64 = 156.0;
    const RADIUS: f64 = 66.0;
    let tracer = Tracer::new(drawn)?;
    let projection = Projection::of(drawn);
    let mut sheet = Sheet::new(TURNS.len() as f64 * PANEL, PANEL + 22.0);
    let line = tangent.map(|t| projection.direction(t)).filter(|d| d[0].hypot(d[1]) > 1e-9);
    for (k, &turns) in TURNS.iter().enumerate() {
        let middle = [(k as f64 + 0.5) * PANEL, PANEL / 2.0];
        let parts: Vec<Vec<[f64; 2]>> =
            branches.iter().map(|b| around(shape, &tracer, &projection, at, b, turns)).collect();
        let size = parts.iter().flatten().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        if !(size.is_finite() && size > 0.0) {
            return None;
        }
        if let Some(d) = line {
            let norm = d[0].hypot(d[1]);
            let end = |s: f64| [middle[0] + s * d[0] / norm * RADIUS, middle[1] - s * d[1] / norm * RADIUS];
            sheet.line("sc-tangent", end(-1.0), end(1.0));
        }
        for part in &parts {
            let points: Vec<[f64; 2]> =
                part.iter().map(|p| [middle[0] + p[0] / size * RADIUS, middle[1] - p[1] / size * RADIUS]).collect();
            sheet.elements.push(tracer.element(branches[0].state, points));
        }
        sheet.disc("sc-corner", middle, 2.5);
        sheet.circle("sc-p", middle, RADIUS + 5.0);
        sheet.text([middle[0], PANEL + 14.0], Anchor::Middle, format!("m = {turns}"));
    }
    Some(sheet.finish(title))
}

/// Rational entries nearby.
fn near<E: Scalar>(m: &Matrix<E>) -> Matrix {
    m.map(|x| x.enclosure(BITS).mid())
}

/// The points of `T_u M^m A` minus the point, in the plane of the drawing.
fn around<E: Scalar>(
    shape: &Shape<E>,
    tracer: &Tracer,
    projection: &Projection,
    at: &[E],
    branch: &BranchReport<E>,
    turns: usize,
) -> Vec<[f64; 2]> {
    let (prefix, _) = shape.product(shape.start, &branch.address.prefix);
    let cell = (0..turns).fold(prefix, |m, _| &m * &branch.cycle_operator);
    // The subtraction is exact, so that small cells keep their digits.
    let offset = near(&Matrix::from_fn(cell.rows(), cell.cols(), |i, j| cell[(i, j)].minus(&at[i])));
    let largest = (0..offset.rows()).flat_map(|i| offset.row(i)).map(crate::arith::abs).max();
    let scale = largest.filter(|x| *x > 0).unwrap_or_else(|| Rational::from(1));
    let unit = Matrix::from_fn(offset.rows(), offset.cols(), |i, j| &offset[(i, j)] / &scale);
    let factor = crate::arith::to_f64(&scale);
    let points = tracer.cell(branch.state, &(projection.matrix() * floats(&unit)), MAX_POINTS);
    points.into_iter().map(|p| [p[0] * factor, p[1] * factor]).collect()
}

/// The largest angles between the tangent line and secants to points of `M^m K`, `m = 0, 1, …`, and the proved rate.
///
/// `None` where the branch has no tangent line or nothing to measure.
#[must_use]
pub fn turning<E: Scalar>(shape: &Shape, branch: &BranchReport<E>, name: &str) -> Option<Turning> {
    let Outcome::Line { direction, rate, proof: Some(_), .. } = &branch.outcome else { return None };
    let axis = DVector::from_vec(direction.to_f64()).normalize();
    let tracer = Tracer::new(shape)?;
    let (chart, linear, view) =
        (floats(&near(&branch.chart)), floats(&near(&branch.linear)), floats(&near(&branch.view)));
    let fixed = floats(&near(&Matrix::from_fn(branch.fixed.len(), 1, |i, _| branch.fixed[i].clone())));
    let mut points: Vec<DVector<f64>> = Vec::new();
    let kept: Vec<_> = branch.ring.iter().filter(|p| !p.collapses).collect();
    for piece in &kept {
        for x in tracer.spread(piece.end, &floats(&near(&piece.op)), SAMPLES / kept.len().max(1)) {
            points.push((&chart * (x - &fixed)).column(0).into_owned());
        }
    }
    let mut measured = Vec::new();
    for _ in 0..=MEASURED {
        let angles = points.iter().map(|y| angle(&(&view * y), &axis));
        measured.push(angles.fold(0.0, f64::max));
        for y in &mut points {
            *y = (&linear * &*y).normalize();
        }
    }
    if points.is_empty() || measured.iter().any(|a| !a.is_finite()) {
        return None;
    }
    let shape_of = |m: usize| -> f64 {
        match rate {
            Rate::Geometric { slower, dominant, power } => {
                let modulus = |r: &crate::algebraic::Root| crate::arith::to_f64(&r.modulus(60).mid());
                (modulus(slower) / modulus(dominant)).powi(m as i32) * (m.max(1) as f64).powi(*power as i32)
            }
            Rate::Harmonic => 1.0 / (m.max(1) as f64),
            Rate::Exact => 0.0,
        }
    };
    let constant = measured.iter().enumerate().skip(1).map(|(m, a)| a / shape_of(m)).fold(0.0, f64::max);
    let bound = if constant.is_finite() && constant > 0.0 {
        (1..=MEASURED).map(|m| constant * shape_of(m)).collect()
    } else {
        Vec::new()
    };
    let bound = if bound.is_empty() { bound } else { [vec![0.0], bound].concat() };
    Some(Turning { measured, bound, name: name.to_owned() })
}

/// The angle between a vector and a line, in radians.
fn angle(v: &DVector<f64>, axis: &DVector<f64>) -> f64 {
    let along = v.dot(axis);
    let across = (v - axis * along).norm();
    if along == 0.0 && across == 0.0 { 0.0 } else { across.atan2(along.abs()) }
}

/// The graph of a functional over the uniform parameter of a curve, minus its value at `q`.
#[must_use]
pub fn profile(shape: &Shape, state: usize, row: &[f64], at_q: f64) -> Vec<[f64; 2]> {
    let Some(tracer) = Tracer::new(shape) else { return Vec::new() };
    let row = DMatrix::from_row_slice(1, row.len(), row);
    let mut points = tracer.profile(state, &row);
    for p in &mut points {
        p[1] -= at_q;
    }
    if points.iter().all(|p| p[1].is_finite()) { points } else { Vec::new() }
}
