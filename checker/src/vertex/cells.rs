//! The ring of a scheme without patches: cells that are divided until the limit above them has a certain sign (docs/theory.md,
//! Lemma 4).
//!
//! Values are whole numbers below `2^50` in units of `2^-44`, bounds are below `2^8`, weights below `2^40`: no product or sum of
//! them leaves 128 bits.

use super::limit::{Cell, PLACES, Regular, cells, corners, distance, place};
use super::mesh::{Mesh, Net, Place};
use super::rule::beside;
use crate::base::{Checked, Q, need, some, spend};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use std::collections::{BTreeSet, VecDeque};

/// Binary places of the values.
const UNIT: usize = 44;
/// Values stay below this power of 2.
const SIZE: usize = 50;
/// Binary places of half-planes.
const SHORT: usize = 16;
/// How often a cell is divided at most.
const DEPTH: usize = 16;
/// How many cells are looked at.
const MAX_CELLS: usize = 200_000;

/// A part of a cell of the ring, with the values at its points, known up to an error.
#[derive(Clone)]
struct Piece {
    level: usize,
    x: Vec<i128>,
    y: Vec<i128>,
    error: i128,
}

/// The ring of sector 0.
pub struct Cells<'a> {
    regular: &'a Regular,
    /// The cells, and which of them touch the inner boundary.
    pieces: Vec<(Piece, bool)>,
}

/// The signs of something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signs {
    /// One strict sign everywhere.
    One(i32),
    /// Both are taken.
    Both,
    /// It is not known.
    Open,
}

/// The cells of the ring, and the places of their points.
fn ring(r: &Regular) -> Vec<(Cell, Vec<Place>, bool)> {
    let inner = |cell: &Cell| {
        let near = corners(r.triangles).iter().map(|c| distance(r.triangles, place(cell, *c))).min();
        near == Some(r.radius)
    };
    let all = cells(r.triangles, r.radius, r.factor * r.radius);
    let points = |cell: &Cell| r.points.iter().map(|p| place(cell, *p)).collect();
    all.into_iter().map(|cell| (cell, points(&cell), inner(&cell))).collect()
}

impl Regular {
    /// The rings that hold the points of the ring of cells; refused where these come near the stencils of the centre.
    pub fn rings(&self, special: &BTreeSet<Place>) -> Checked<i64> {
        let finer = |cell: &Cell| ((self.factor * cell.0.0, self.factor * cell.0.1), cell.1);
        let mut nearest = i64::MAX;
        for cell in cells(self.triangles, self.radius, self.factor * self.radius) {
            for part in &self.parts {
                let part = (place(&finer(&cell), part.0), cell.1 * part.1);
                nearest =
                    self.points.iter().map(|p| distance(self.triangles, place(&part, *p))).fold(nearest, i64::min);
            }
        }
        let apart = special.iter().all(|p| distance(self.triangles, *p) < nearest) && nearest > 0;
        need(apart, "limits", "the ring is not apart from the stencils of the centre")?;
        let farthest = ring(self).iter().flat_map(|(_, points, _)| points).map(|p| distance(self.triangles, *p)).max();
        some(farthest, "limits", "a ring has cells")
    }
}

impl<'a> Cells<'a> {
    /// The ring of a net that is known on all its points.
    pub fn new(regular: &'a Regular, mesh: &Mesh, net: &Net) -> Checked<Self> {
        let mut pieces = Vec::new();
        for (cell, points, inner) in ring(regular) {
            let mut piece = Piece { level: 0, x: Vec::new(), y: Vec::new(), error: 0 };
            // A point of the cell, or one between them, and so on the same side of the centre.
            let own = corners(regular.triangles).iter().map(|c| place(&cell, *c));
            let middle = own.fold((0, 0), |sum, c| (sum.0 + c.0, sum.1 + c.1));
            for point in points {
                let value = mesh.at(net, beside(regular.triangles, middle, point)?)?;
                let (x, y, error) = some(value.units(UNIT, SIZE), "limit", "the values of the ring are too large")?;
                piece.x.push(x);
                piece.y.push(y);
                piece.error = piece.error.max(error);
            }
            pieces.push((piece, inner));
        }
        need(pieces.iter().any(|(_, inner)| *inner), "limits", "a ring has an inner boundary")?;
        Ok(Self { regular, pieces })
    }

    /// The parts of a piece after a step.
    fn divided(&self, piece: &Piece) -> Checked<Vec<Piece>> {
        let r = self.regular;
        // Rounding down adds less than one unit, and so does that of the error.
        let error = piece.error * r.growth / r.denominator + 2;
        let mut all = Vec::new();
        for rows in &r.steps {
            spend(2 * rows.iter().map(Vec::len).sum::<usize>(), 0)?;
            let values = |old: &[i128]| -> Vec<i128> {
                let row = |row: &Vec<(usize, i128)>| row.iter().map(|(i, w)| old[*i] * w).sum::<i128>();
                rows.iter().map(|weights| row(weights).div_euclid(r.denominator)).collect()
            };
            let (x, y) = (values(&piece.x), values(&piece.y));
            let small = x.iter().chain(&y).chain([&error]).all(|v| v.abs() < 1 << SIZE);
            need(small, "limit", "the values of a part are too large")?;
            all.push(Piece { level: piece.level + 1, x, y, error });
        }
        Ok(all)
    }

    /// The sign of something on some cells, which are divided where it is not certain, until both signs were met.
    fn signs(&self, innermost: bool, sign: impl Fn(&Piece) -> i32) -> Checked<Signs> {
        let chosen = self.pieces.iter().filter(|(_, inner)| !innermost || *inner);
        let mut queue: VecDeque<Piece> = chosen.map(|(piece, _)| piece.clone()).collect();
        let (mut found, mut looked_at) = ([false; 2], 0);
        while let Some(piece) = queue.pop_front() {
            looked_at += 1;
            match sign(&piece) {
                0 if piece.level < DEPTH && looked_at + queue.len() < MAX_CELLS => queue.extend(self.divided(&piece)?),
                0 => return Ok(Signs::Open),
                s => found[usize::from(s > 0)] = true,
            }
            if found == [true; 2] {
                return Ok(Signs::Both);
            }
        }
        Ok(match found {
            [false, true] => Signs::One(1),
            [true, false] => Signs::One(-1),
            // Of no cells nothing is known.
            _ => Signs::Open,
        })
    }

    /// The largest second difference, at least.
    fn roughness(&self, values: &[i128], error: i128) -> i128 {
        let size = |[a, b, c, d]: &[usize; 4]| (values[*a] - values[*b] - values[*c] + values[*d]).abs();
        self.regular.differences.iter().map(size).fold(0, i128::max) + 4 * error
    }

    fn corner_values(&self, values: &[i128]) -> Vec<i128> {
        let r = self.regular;
        // The corners are among the points.
        let at = |c: &Place| r.points.iter().position(|p| p == c).into_iter().map(|i| values[i]);
        corners(r.triangles).iter().flat_map(at).collect()
    }

    /// The sign of the Jacobian determinant.
    pub fn jacobian(&self) -> Checked<Signs> {
        let r = self.regular;
        let slopes = |values: &[i128], error: i128| {
            let v = self.corner_values(values);
            // Of squares twice the mean slopes.
            let (slopes, scale) = if r.triangles {
                ([v[1] - v[0], v[2] - v[0]], 1)
            } else {
                ([v[1] - v[0] + v[3] - v[2], v[2] - v[0] + v[3] - v[1]], 2)
            };
            let off = ((r.slope * self.roughness(values, error) * scale) >> PLACES) + 1 + 4 * error;
            (slopes, off)
        };
        self.signs(false, |piece| {
            let ([xu, xv], ex) = slopes(&piece.x, piece.error);
            let ([yu, yv], ey) = slopes(&piece.y, piece.error);
            let off = (xu.abs() + xv.abs()) * ey + (yu.abs() + yv.abs()) * ex + 2 * ex * ey;
            sign(xu * yv - xv * yu, off)
        })
    }

    /// The sign of the scalar product with a vector, on the ring or on its innermost cells, which hold a closed path around the
    /// centre.
    pub fn functional(&self, (a, b): &(Q, Q), innermost: bool) -> Checked<Signs> {
        let r = self.regular;
        // Another vector nearby serves as well.
        let short = |q: &Q| {
            let scaled = (q * Q::from_integer(BigInt::from(1 << SHORT))).round().to_integer();
            some(scaled.to_i128().filter(|v| v.abs() <= 2 << SHORT), "half-plane", "the vector is too long")
        };
        let (a, b) = (short(a)?, short(b)?);
        self.signs(innermost, |piece| {
            let values: Vec<i128> = piece.x.iter().zip(&piece.y).map(|(x, y)| a * x + b * y).collect();
            let error = piece.error * (a.abs() + b.abs());
            let v = self.corner_values(&values);
            // Of squares four times the values of the fit.
            let (fit, scale) = match v[..] {
                [a, b, c, d] => (vec![3 * a + b + c - d, a + 3 * b - c + d, a - b + 3 * c + d, b + c + 3 * d - a], 4),
                _ => (v.clone(), 1),
            };
            let off = ((r.value * self.roughness(&values, error) * scale) >> PLACES) + 1 + 2 * scale * error;
            let all: Vec<i32> = fit.iter().map(|f| sign(*f, off)).collect();
            if all.iter().all(|s| *s == all[0]) { all[0] } else { 0 }
        })
    }
}

/// The sign of a number known up to an error, 0 where it is not certain.
fn sign(value: i128, error: i128) -> i32 {
    i32::from(value > error) - i32::from(-value > error)
}
