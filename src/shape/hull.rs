//! Convex polygons that hold the attractors where `V` has at most two dimensions: a second, sharper kind of enclosure.
//!
//! Floats propose the polygons; that every map sends polygon into polygon is then checked exactly, and it implies that the
//! attractors lie inside (the polygons are compact and mapped into one another by a contracting system).

use super::{Shape, Spaces, difference};
use crate::arith::{Integer, Rational, to_f64};
use crate::linalg::Matrix;
use malachite_base::num::conversion::traits::RoundingFrom;
use malachite_base::rounding_modes::RoundingMode;

/// Vertices of a polygon by state, as points of the state's barycentric space; empty for states that cannot be reached.
pub type Hulls = Vec<Vec<Vec<Rational>>>;

type Point = [Rational; 2];

const MAX_VERTICES: usize = 24;
const ROUNDS: usize = 40;
const UNIONS: usize = 16;

/// An affine map `y -> a y + t` between the plane coordinates of two states.
struct PlaneMap {
    from: usize,
    to: usize,
    a: [[Rational; 2]; 2],
    t: Point,
}

/// Polygons for all reachable states, or `None` where some `V_e` has more than two dimensions or none was found.
#[must_use]
pub fn hulls(shape: &Shape, spaces: &Spaces) -> Option<Hulls> {
    let reachable = shape.reachable();
    if reachable.iter().any(|&e| spaces.of(e).basis.cols() > 2) {
        return None;
    }
    let maps: Vec<PlaneMap> = reachable.iter().flat_map(|&e| plane_maps(shape, spaces, e)).collect();
    let proposal = propose(shape.states.len(), &reachable, &maps);
    for sixtyfourths in [1_u32, 4, 16] {
        let factor = Rational::from_unsigneds(sixtyfourths, 64);
        let mut polygons: Vec<Vec<Point>> = proposal.iter().map(|p| inflated(p, &factor)).collect();
        // The images of an enlarged polygon shrink towards the attractor inside it, so that few of them stick out.
        for _ in 0..UNIONS {
            if maps.iter().all(|m| maps_into(m, &polygons)) {
                return Some(lifted(spaces, &polygons));
            }
            polygons = joined(&maps, &polygons);
            if polygons.iter().any(|p| p.len() > 4 * MAX_VERTICES) {
                break;
            }
        }
    }
    None
}

/// The polygons as points of barycentric space.
fn lifted(spaces: &Spaces, polygons: &[Vec<Point>]) -> Hulls {
    let lift = |e: usize, p: &Point| -> Vec<Rational> {
        let space = spaces.of(e);
        let offset = space.basis.apply(&p[..space.basis.cols()]);
        space.base.iter().zip(offset).map(|(b, o)| b + o).collect()
    };
    let all = polygons.iter().enumerate();
    all.map(|(e, polygon)| polygon.iter().map(|p| lift(e, p)).collect()).collect()
}

/// The hulls of the polygons and their images.
fn joined(maps: &[PlaneMap], polygons: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let mut next = polygons.to_vec();
    for map in maps {
        next[map.to].extend(polygons[map.from].iter().map(|p| map.image(p)));
    }
    next.into_iter().map(convex_hull).collect()
}

impl PlaneMap {
    fn image(&self, p: &Point) -> Point {
        [0, 1].map(|i| &self.a[i][0] * &p[0] + &self.a[i][1] * &p[1] + &self.t[i])
    }
}

fn plane_maps(shape: &Shape, spaces: &Spaces, e: usize) -> Vec<PlaneMap> {
    let pieces = shape.states[e].pieces.iter();
    pieces
        .map(|piece| {
            let linear = spaces.linear(&piece.op, e, piece.target);
            let moved = difference(&piece.op.apply(&spaces.of(piece.target).base), &spaces.of(e).base);
            let shift = spaces.of(e).coordinates.apply(&moved);
            let entry = |m: &Matrix, i: usize, j: usize| {
                if i < m.rows() && j < m.cols() { m[(i, j)].clone() } else { Rational::from(0) }
            };
            let at = |i: usize| shift.get(i).cloned().unwrap_or_else(|| Rational::from(0));
            let row = |i: usize| [entry(&linear, i, 0), entry(&linear, i, 1)];
            PlaneMap { from: piece.target, to: e, a: [row(0), row(1)], t: [at(0), at(1)] }
        })
        .collect()
}

/// Hulls of the attractors in floats, by iteration from the base points.
#[allow(clippy::float_arithmetic, reason = "proposes polygons that are checked exactly")]
fn propose(states: usize, reachable: &[usize], maps: &[PlaneMap]) -> Vec<Vec<[f64; 2]>> {
    let mut polygons: Vec<Vec<[f64; 2]>> = vec![Vec::new(); states];
    for &e in reachable {
        polygons[e] = vec![[0.0, 0.0]];
    }
    let float: Vec<([[f64; 2]; 2], [f64; 2])> =
        maps.iter().map(|m| (m.a.each_ref().map(|r| r.each_ref().map(to_f64)), m.t.each_ref().map(to_f64))).collect();
    for _ in 0..ROUNDS {
        let mut next = polygons.clone();
        for (map, (a, t)) in maps.iter().zip(&float) {
            for p in &polygons[map.from] {
                let image = |i: usize| a[i][0] * p[0] + a[i][1] * p[1] + t[i];
                next[map.to].push([image(0), image(1)]);
            }
        }
        polygons = next.into_iter().map(float_hull).collect();
    }
    polygons
}

#[allow(clippy::float_arithmetic, reason = "proposes polygons that are checked exactly")]
fn float_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let cross = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() >= 2 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    // Drop the vertices whose loss costs the least area.
    while hull.len() > MAX_VERTICES {
        let n = hull.len();
        let area = |i: usize| cross(hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]).abs();
        let least = (0..n).min_by(|&i, &j| area(i).total_cmp(&area(j))).map_or(0, |k| k);
        hull.remove(least);
    }
    hull
}

/// The polygon enlarged by `1 + factor` about its middle, on a dyadic grid, counter-clockwise.
fn inflated(polygon: &[[f64; 2]], factor: &Rational) -> Vec<Point> {
    let grid = Rational::from(Integer::from(1) << 24_u64);
    let exact = |x: f64| Rational::try_from(x).unwrap_or_else(|_| Rational::from(0));
    let round = |x: Rational| Rational::from(Integer::rounding_from(x * &grid, RoundingMode::Nearest).0) / &grid;
    let points: Vec<Point> = polygon.iter().map(|p| p.map(exact)).collect();
    let count = Rational::from(points.len().max(1));
    let middle = [0, 1].map(|k| points.iter().fold(Rational::from(0), |s, p| s + &p[k]) / &count);
    let stretch = |p: &Point, k: usize| round(&middle[k] + (&p[k] - &middle[k]) * (Rational::from(1) + factor));
    convex_hull(points.iter().map(|p| [stretch(p, 0), stretch(p, 1)]).collect())
}

/// Twice the signed area of the triangle `o a b`.
fn cross(o: &Point, a: &Point, b: &Point) -> Rational {
    (&a[0] - &o[0]) * (&b[1] - &o[1]) - (&a[1] - &o[1]) * (&b[0] - &o[0])
}

fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort();
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull: Vec<Point> = Vec::new();
    for pass in 0..2 {
        let floor = hull.len();
        for p in &points {
            while hull.len() >= floor + 2 && cross(&hull[hull.len() - 2], &hull[hull.len() - 1], p) <= 0 {
                hull.pop();
            }
            hull.push(p.clone());
        }
        hull.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    hull
}

/// Whether a convex polygon (counter-clockwise; possibly a segment or a point) holds `p`.
fn holds(polygon: &[Point], p: &Point) -> bool {
    match polygon {
        [] => false,
        [a] => a == p,
        [a, b] => cross(a, b, p) == 0 && (0..2).all(|k| p[k] >= *(&a[k]).min(&b[k]) && p[k] <= *(&a[k]).max(&b[k])),
        _ => (0..polygon.len()).all(|i| cross(&polygon[i], &polygon[(i + 1) % polygon.len()], p) >= 0),
    }
}

fn maps_into(map: &PlaneMap, polygons: &[Vec<Point>]) -> bool {
    polygons[map.from].iter().all(|p| holds(&polygons[map.to], &map.image(p)))
}
