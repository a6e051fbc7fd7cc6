//! The polynomial patches of the ring of one sector, between the distances 1 and 2 from the centre, in Bernstein form.

use super::ball::Ball;
use super::mesh::{Mesh, Net, Place, Spline};
use crate::base::{Checked, whole};

/// Control points: `rows[j][i]`. A quadrangle has rows of one length; in a triangle they get shorter by one, and `i`, `j` are the
/// exponents of the second and the third barycentric coordinate.
pub struct Patch {
    rows: Vec<Vec<Ball>>,
    triangle: bool,
}

/// The quadrangles of the ring, by their corner next to the centre.
const CELLS: [Place; 3] = [(1, 0), (1, 1), (0, 1)];

/// The triangles of the ring: a corner, and the sign of the lattice vectors to the second and the third.
const TRIANGLES: [(Place, i64); 3] = [((1, 0), 1), ((1, 1), -1), ((0, 1), 1)];

/// The points that Loop's box spline on the triangle `(0,0), (1,0), (0,1)` depends on.
const QUARTIC_POINTS: [Place; 12] =
    [(-1, 0), (-1, 1), (-1, 2), (0, -1), (0, 0), (0, 1), (0, 2), (1, -1), (1, 0), (1, 1), (2, -1), (2, 0)];

/// 24 times the weights of these points in its Bernstein coefficients, by rows.
const QUARTIC: [[i64; 12]; 15] = [
    [2, 2, 0, 2, 12, 2, 0, 2, 2, 0, 0, 0],
    [0, 1, 0, 1, 12, 3, 0, 3, 4, 0, 0, 0],
    [0, 0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0],
    [0, 0, 0, 0, 4, 3, 0, 3, 12, 1, 1, 0],
    [0, 0, 0, 0, 2, 2, 0, 2, 12, 2, 2, 2],
    [1, 3, 0, 0, 12, 4, 0, 1, 3, 0, 0, 0],
    [0, 1, 0, 0, 10, 6, 0, 1, 6, 0, 0, 0],
    [0, 0, 0, 0, 6, 6, 0, 1, 10, 1, 0, 0],
    [0, 0, 0, 0, 3, 4, 0, 1, 12, 3, 0, 1],
    [0, 4, 0, 0, 8, 8, 0, 0, 4, 0, 0, 0],
    [0, 1, 0, 0, 6, 10, 0, 0, 6, 1, 0, 0],
    [0, 0, 0, 0, 4, 8, 0, 0, 8, 4, 0, 0],
    [0, 3, 1, 0, 4, 12, 0, 0, 3, 1, 0, 0],
    [0, 1, 0, 0, 3, 12, 1, 0, 4, 3, 0, 0],
    [0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0, 0],
];

/// The patches of the ring of sector 0.
pub fn patches(mesh: &Mesh, net: &Net) -> Checked<Vec<Patch>> {
    let point = |terms: &[(Place, i64)], divisor| mesh.combined(net, terms, divisor);
    let tensor = |cell: Place, weights: &[&[i64]], divisor: i64| {
        let terms = |along: &[i64], across: &[i64]| -> Vec<(Place, i64)> {
            let at = |a: usize, b: usize| (cell.0 + a as i64 - 1, cell.1 + b as i64 - 1);
            let all = (0..across.len()).flat_map(|b| (0..along.len()).map(move |a| (a, b)));
            let used = all.filter(|&(a, b)| along[a] * across[b] != 0);
            used.map(|(a, b)| (at(a, b), along[a] * across[b])).collect()
        };
        let row = |across: &[i64]| {
            weights.iter().map(|along| point(&terms(along, across), divisor * divisor)).collect::<Checked<Vec<_>>>()
        };
        let rows = weights.iter().map(|across| row(across)).collect::<Checked<_>>()?;
        Ok(Patch { rows, triangle: false })
    };
    match mesh.spline() {
        Spline::Bicubic => {
            let weights: [&[i64]; 4] = [&[1, 4, 1, 0], &[0, 4, 2, 0], &[0, 2, 4, 0], &[0, 1, 4, 1]];
            CELLS.iter().map(|cell| tensor(*cell, &weights, 6)).collect()
        }
        Spline::Biquadratic => {
            let weights: [&[i64]; 3] = [&[1, 1, 0], &[0, 2, 0], &[0, 1, 1]];
            CELLS.iter().map(|cell| tensor(*cell, &weights, 2)).collect()
        }
        Spline::Quartic => {
            let triangle = |&((i, j), sign): &(Place, i64)| {
                let place = |(a, b): &Place| (i + sign * a, j + sign * b);
                let mut masks = QUARTIC.iter().map(|mask| {
                    let terms = QUARTIC_POINTS.iter().map(place).zip(mask.iter().copied()).filter(|(_, w)| *w != 0);
                    point(&terms.collect::<Vec<_>>(), 24)
                });
                let rows =
                    (0..5).map(|r| masks.by_ref().take(5 - r).collect::<Checked<_>>()).collect::<Checked<_>>()?;
                Ok(Patch { rows, triangle: true })
            };
            TRIANGLES.iter().map(triangle).collect()
        }
        Spline::Quadratic => {
            let quarters = CELLS.iter().flat_map(|cell| (0..4).map(move |m| (*cell, m)));
            quarters.map(|(cell, m)| Ok(Patch { rows: quarter(&point, cell, m)?, triangle: true })).collect()
        }
    }
}

/// The triangle of a cell from its corner `m` to the next one and its middle, for the box spline of Zwart and Powell.
fn quarter(point: &impl Fn(&[(Place, i64)], i64) -> Checked<Ball>, (i, j): Place, m: usize) -> Checked<Vec<Vec<Ball>>> {
    let at = |(a, b): Place| (i + a, j + b);
    // Neighbours across the sides from corner 0 on, and across the corners.
    let side = |m: usize| at([(0, -1), (1, 0), (0, 1), (-1, 0)][m % 4]);
    let corner = |m: usize| at([(-1, -1), (1, -1), (1, 1), (-1, 1)][m % 4]);
    let (own, next) = ((i, j), m + 1);
    let at_corner = |m: usize| point(&[(own, 1), (side(m + 3), 1), (side(m), 1), (corner(m), 1)], 4);
    let towards_middle = |m: usize| point(&[(own, 2), (side(m + 3), 1), (side(m), 1)], 4);
    let middle = [(own, 4), (side(0), 1), (side(1), 1), (side(2), 1), (side(3), 1)];
    Ok(vec![
        vec![at_corner(m)?, point(&[(own, 1), (side(m), 1)], 2)?, at_corner(next)?],
        vec![towards_middle(m)?, towards_middle(next)?],
        vec![point(&middle, 8)?],
    ])
}

impl Patch {
    /// All control points.
    pub fn points(&self) -> impl Iterator<Item = &Ball> {
        self.rows.iter().flatten()
    }

    /// The control points by rows.
    #[cfg(test)]
    pub fn rows(&self) -> &[Vec<Ball>] {
        &self.rows
    }

    fn degree(&self) -> usize {
        self.rows.len() - 1
    }

    /// The Bernstein coefficients of the Jacobian determinant, each but for a positive factor, as imaginary parts, and whether they
    /// are its values at corners. With the binomial factors in the coefficients, polynomials in Bernstein form are multiplied like
    /// polynomials.
    pub fn jacobian(&self) -> Vec<(Ball, bool)> {
        let d = self.degree();
        let weight = |i: usize, j: usize, a: usize, b: usize| {
            Ball::real(&whole(if self.triangle {
                choose(d - 1, i) * choose(d - 1 - i, j)
            } else {
                choose(a, i) * choose(b, j)
            }))
        };
        let row = |j: usize, last: usize| (0..if self.triangle { last - j } else { last }).map(move |i| (i, j));
        let along = |(i, j): (usize, usize)| {
            let difference = self.rows[j][i + 1].minus(&self.rows[j][i]);
            (i, j, difference.times(&weight(i, j, d - 1, d)))
        };
        let across = |(i, j): (usize, usize)| {
            let difference = self.rows[j + 1][i].minus(&self.rows[j][i]);
            (i, j, difference.times(&weight(i, j, d, d - 1)))
        };
        let rows = if self.triangle { d } else { d + 1 };
        let u: Vec<_> = (0..rows).flat_map(|j| row(j, d)).map(along).collect();
        let v: Vec<_> = (0..d).flat_map(|j| row(j, rows)).map(across).collect();
        let size = if self.triangle { 2 * d - 1 } else { 2 * d };
        let mut product = vec![vec![Ball::zero(); size]; size];
        for (i, j, a) in &u {
            for (k, l, b) in &v {
                product[j + l][i + k] = product[j + l][i + k].plus(&a.conjugate().times(b));
            }
        }
        let last = size - 1;
        let ends = |i: usize| i == 0 || i == last;
        let all = (0..size).flat_map(|j| (0..size).map(move |i| (i, j)));
        let used = all.filter(|(i, j)| !self.triangle || i + j <= last);
        used.map(|(i, j)| (product[j][i].clone(), ends(i) && ends(j))).collect()
    }
}

/// The control points of the outer boundary of the ring of sector 0, from its first spoke to the next.
pub fn boundary(mesh: &Mesh, patches: &[Patch]) -> Vec<Ball> {
    // Every row has a control point.
    let last = |k: usize| patches[k].rows.iter().map(|row| row[row.len() - 1].clone()).collect::<Vec<_>>();
    let top = |k: usize| patches[k].rows[patches[k].degree()].clone();
    let first = |k: usize| patches[k].rows[0].clone();
    match mesh.spline() {
        Spline::Bicubic | Spline::Biquadratic => [last(0), last(1), top(1), top(2)].concat(),
        Spline::Quartic => [last(0), last(2)].concat(),
        Spline::Quadratic => [first(1), first(5), first(6), first(10)].concat(),
    }
}

fn choose(n: usize, k: usize) -> i64 {
    (0..k).fold(1, |c, i| c * (n - i) as i64 / (i as i64 + 1))
}
