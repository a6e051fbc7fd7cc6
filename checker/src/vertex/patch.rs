//! The polynomial patches of the ring of one sector, between the distances 1 and 2 from the centre, in Bernstein form.

use super::ball::Ball;
use super::mesh::{Mesh, Net, Place, Spline};
use crate::base::{Checked, whole};
use std::collections::BTreeMap;
use std::sync::LazyLock;

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

/// The function whose Bernstein coefficients of degree `n` on all triangles `V, V ± (1, 0), V ± (0, 1)`, `V` a lattice point, are
/// these at the places `Σ β_i V_i`, and 0 elsewhere; neighbours share the coefficients of their common side.
type Lattice = BTreeMap<Place, i64>;

/// The coefficient at a place.
fn coefficient(net: &Lattice, place: Place) -> i64 {
    match net.get(&place) {
        Some(c) => *c,
        None => 0,
    }
}

/// Loop's quartic box spline around the lattice point 0, times 24: the hat function, which is the box spline of the directions
/// `(1, 0)`, `(−1, 1)`, `(0, −1)`, averaged along each of them once more. They add up to 0, so that nothing is moved.
fn box_spline() -> Lattice {
    let hat = Lattice::from([((0, 0), 1)]);
    [(1, (1, 0)), (2, (-1, 1)), (3, (0, -1))]
        .into_iter()
        .fold(hat, |net, (degree, along)| averaged(&net, degree, along))
}

/// `∫ f(x − tξ) dt` over `0 ≤ t ≤ 1` times the new degree, for a function of degree `n` with small support: its derivative along
/// `ξ`, `n + 1` times the difference of coefficients that are neighbours along it, is `f(x) − f(x − ξ)`.
fn averaged(net: &Lattice, n: i64, along: Place) -> Lattice {
    let (m, (u, v)) = (n + 1, along);
    let step = |(x, y): Place| {
        // The triangle that holds this step, and its corner from which ξ leads to another one.
        let (left, low) = (x.min(x + u).div_euclid(m), y.min(y + v).div_euclid(m));
        let upright = (x + y).max(x + y + u + v) - m * (left + low) <= m;
        let (a, b) = match (upright, along) {
            (true, (1, 0)) => (left, low),
            (true, (-1, 1)) | (false, (0, -1)) => (left + 1, low + i64::from(!upright)),
            (true, _) | (false, (1, 0)) => (left, low + 1),
            (false, _) => (left + 1, low),
        };
        let (x, y) = (x - a, y - b);
        coefficient(net, (x, y)) - coefficient(net, (x - n * u, y - n * v))
    };
    let mut found = Lattice::new();
    let reach = 4 * m;
    let mut places: Vec<Place> = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y))).collect();
    // Along ξ, from where everything is 0.
    places.sort_by_key(|(x, y)| x * u + y * v);
    for (x, y) in places {
        let next = coefficient(&found, (x, y)) + step((x, y));
        if next != 0 {
            found.insert((x + u, y + v), next);
        }
    }
    found
}

/// For the control points of the triangle `(0, 0), (1, 0), (0, 1)`, by rows, the lattice points and 24 times their weights.
pub fn quartic() -> &'static [Vec<(Place, i64)>] {
    static MASKS: LazyLock<Vec<Vec<(Place, i64)>>> = LazyLock::new(control_points);
    &MASKS
}

fn control_points() -> Vec<Vec<(Place, i64)>> {
    let spline = box_spline();
    let around = || (-2..=3).flat_map(|a| (-2..=3).map(move |b| (a, b)));
    let control = |(i, j): Place| {
        let weight = |(a, b): Place| ((a, b), coefficient(&spline, (i - 4 * a, j - 4 * b)));
        around().map(weight).filter(|(_, weight)| *weight != 0).collect()
    };
    (0..5).flat_map(|j| (0..5 - j).map(move |i| (i, j))).map(control).collect()
}

/// The patches of the ring of sector 0.
pub fn patches(spline: Spline, mesh: &Mesh, net: &Net) -> Checked<Vec<Patch>> {
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
    match spline {
        Spline::Bicubic => {
            let weights: [&[i64]; 4] = [&[1, 4, 1, 0], &[0, 4, 2, 0], &[0, 2, 4, 0], &[0, 1, 4, 1]];
            CELLS.iter().map(|cell| tensor(*cell, &weights, 6)).collect()
        }
        Spline::Biquadratic => {
            let weights: [&[i64]; 3] = [&[1, 1, 0], &[0, 2, 0], &[0, 1, 1]];
            CELLS.iter().map(|cell| tensor(*cell, &weights, 2)).collect()
        }
        Spline::Quartic => {
            let masks = quartic();
            let triangle = |&((i, j), sign): &(Place, i64)| {
                let placed = |&((a, b), weight): &(Place, i64)| ((i + sign * a, j + sign * b), weight);
                let mut points = masks.iter().map(|mask| point(&mask.iter().map(placed).collect::<Vec<_>>(), 24));
                let rows =
                    (0..5).map(|r| points.by_ref().take(5 - r).collect::<Checked<_>>()).collect::<Checked<_>>()?;
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
pub fn boundary(spline: Spline, patches: &[Patch]) -> Vec<Ball> {
    // Every row has a control point.
    let last = |k: usize| patches[k].rows.iter().map(|row| row[row.len() - 1].clone()).collect::<Vec<_>>();
    let top = |k: usize| patches[k].rows[patches[k].degree()].clone();
    let first = |k: usize| patches[k].rows[0].clone();
    match spline {
        Spline::Bicubic | Spline::Biquadratic => [last(0), last(1), top(1), top(2)].concat(),
        Spline::Quartic => [last(0), last(2)].concat(),
        Spline::Quadratic => [first(1), first(5), first(6), first(10)].concat(),
    }
}

fn choose(n: usize, k: usize) -> i64 {
    (0..k).fold(1, |c, i| c * (n - i) as i64 / (i as i64 + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_pascal() {
        let row = |n: usize| (0..=n).map(|k| choose(n, k)).collect::<Vec<_>>();
        assert_eq!((row(0), row(3), row(6)), (vec![1], vec![1, 3, 3, 1], vec![1, 6, 15, 20, 15, 6, 1]));
    }

    /// The weights of a net in the new point at a place: Loop's rule away from extraordinary vertices.
    fn weight((i, j): Place) -> i64 {
        match (i.abs().max(j.abs()).max((i + j).abs()), i * j * (i + j)) {
            (0, _) => 10,
            (1, _) => 6,
            (2, 0) => 1,
            (2, _) => 2,
            _ => 0,
        }
    }

    /// 24 times the control points of a net of one point, by rows.
    fn patch(net: &dyn Fn(Place) -> i64) -> Vec<Vec<i64>> {
        let mut points = quartic().iter().map(|mask| mask.iter().map(|(p, w)| net(*p) * w).sum());
        (0..5).map(|r| points.by_ref().take(5 - r).collect()).collect()
    }

    /// The part of a triangle next to its first corner, of half its size, times 16: point `(i, j)` is the corner after `i` steps of
    /// de Casteljau's algorithm along the first side and `j` along the second.
    fn half(rows: &[Vec<i64>]) -> Vec<Vec<i64>> {
        let mean = |net: &[Vec<i64>], (down, right): (usize, usize)| -> Vec<Vec<i64>> {
            let row = |r: usize| (0..net[r].len() - 1).map(|i| (net[r][i] + net[r + down][i + right]) / 2).collect();
            (0..net.len() - 1).map(row).collect()
        };
        let mut net: Vec<Vec<i64>> = rows.iter().map(|row| row.iter().map(|c| c * 16).collect()).collect();
        let mut found = Vec::new();
        while !net.is_empty() {
            let (mut row, mut rest) = (Vec::new(), net.clone());
            while !rest.is_empty() {
                row.push(rest[0][0]);
                rest = mean(&rest, (0, 1));
            }
            found.push(row);
            net = mean(&net, (1, 0));
        }
        found
    }

    /// The patch of a net, cut in half towards a corner, is the patch of the refined net: the refinement equation of the box
    /// spline, for every point of the net that the patch depends on.
    #[test]
    fn quartic_patches_refine() {
        let mut seen = 0;
        for at in (-3..=4).flat_map(|a| (-3..=4).map(move |b| (a, b))) {
            let own = patch(&|p| i64::from(p == at));
            let refined = patch(&|(i, j)| weight((i - 2 * at.0, j - 2 * at.1)));
            assert_eq!(half(&own), refined, "{at:?}");
            seen += usize::from(own.iter().flatten().any(|c| *c != 0));
        }
        assert_eq!(seen, 12);
        for mask in quartic() {
            assert_eq!(mask.iter().map(|(_, w)| w).sum::<i64>(), 24);
        }
        // A corner has 12 of itself and 2 of each neighbour.
        assert_eq!(
            quartic()[0],
            [((-1, 0), 2), ((-1, 1), 2), ((0, -1), 2), ((0, 0), 12), ((0, 1), 2), ((1, -1), 2), ((1, 0), 2)]
        );
    }
}
