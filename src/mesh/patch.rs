//! Polynomial patches of regular faces, and whether their parametrisation is regular.

use super::interval::Float;
use super::refine::{Exact, Floats, Kind, Level, Space};
use super::topology::Frame;
use crate::arith::{Rational, abs};
use crate::vertex::net::{Net, Spot, corners, halved_corners};
use crate::vertex::ring::{QUARTIC, QUARTIC_POINTS};
use std::collections::BTreeMap;

/// What is known of the regularity of a patch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Regular {
    /// The partial derivatives are independent everywhere: two functionals show it on so many pieces.
    Proved(usize),
    /// They are dependent at this exact parameter.
    Refuted(Spot),
    /// The patch is plane, and its Jacobian determinant has both signs at these parameters.
    Folded(Spot, Spot),
    /// Not decided around this parameter.
    Open(Spot),
}

/// The bicubic patch of 16 points (rows of 4), or Loop's quartic of 12, as a Bézier net.
#[must_use]
pub fn bezier<S: Space>(space: &S, triangle: bool, points: &[S::P]) -> Net<S::P> {
    if triangle {
        let value = |mask: &[i64; 12]| {
            let terms: Vec<(i64, &S::P)> = mask.iter().copied().zip(points).filter(|(w, _)| *w != 0).collect();
            space.sum(&terms, 24)
        };
        let mut masks = QUARTIC.iter();
        let rows = (0..5).map(|r| masks.by_ref().take(5 - r).map(value).collect()).collect();
        return Net { triangle, rows };
    }
    let line = |p: [&S::P; 4]| {
        [
            space.sum(&[(1, p[0]), (4, p[1]), (1, p[2])], 6),
            space.sum(&[(4, p[1]), (2, p[2])], 6),
            space.sum(&[(2, p[1]), (4, p[2])], 6),
            space.sum(&[(1, p[1]), (4, p[2]), (1, p[3])], 6),
        ]
    };
    let along: Vec<[S::P; 4]> = points.chunks(4).map(|r| line([&r[0], &r[1], &r[2], &r[3]])).collect();
    let columns: Vec<[S::P; 4]> =
        (0..4).map(|s| line([&along[0][s], &along[1][s], &along[2][s], &along[3][s]])).collect();
    Net { triangle, rows: (0..4).map(|r| columns.iter().map(|c| c[r].clone()).collect()).collect() }
}

/// A control point of a patch as a combination of vertices: one vertex, or a reflection over the border.
pub type Combination = Vec<(i64, u32)>;

/// The directions of the neighbours of a point of the lattice, anticlockwise; of quadrangles with the corners opposite to it.
const SIX: [(i64, i64); 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];
const EIGHT: [(i64, i64); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

/// The neighbours of a regular vertex in the order of [`SIX`] or [`EIGHT`], from a face on.
fn neighbours(level: &Level, frame: Frame, triangles: bool) -> Option<Vec<Combination>> {
    let t = &level.topology;
    let own = t.vertex[frame.corner as usize];
    let kind = level.kind[own as usize];
    if !kind.regular(triangles) {
        return None;
    }
    let star = t.whole(frame);
    let first = star.frames.iter().position(|f| f.corner == frame.corner)?;
    let spoke = |k: usize| star.spokes[k];
    let across = |k: usize| t.diagonal(star.frames[k].corner);
    let one = |v: u32| vec![(1, v)];
    // From the first face of the fan on.
    let mut all: Vec<Combination> = Vec::new();
    for k in 0..star.frames.len() {
        all.push(one(spoke(k)));
        all.extend((!triangles).then(|| one(across(k))));
    }
    match (kind, triangles) {
        (Kind::Inside(_), _) => {}
        (Kind::Smooth(_), false) => {
            all.extend([one(spoke(2)), vec![(2, spoke(2)), (-1, across(1))], vec![(2, own), (-1, spoke(1))]]);
            all.push(vec![(2, spoke(0)), (-1, across(0))]);
        }
        (Kind::Smooth(_), true) => {
            all.push(one(spoke(3)));
            all.push(vec![(1, own), (1, spoke(3)), (-1, spoke(2))]);
            all.push(vec![(1, own), (1, spoke(0)), (-1, spoke(1))]);
        }
        (_, false) => {
            let (a, b, f) = (spoke(0), spoke(1), across(0));
            all.extend([one(b), vec![(2, b), (-1, f)], vec![(2, own), (-1, a)]]);
            all.push(vec![(4, own), (-2, a), (-2, b), (1, f)]);
            all.extend([vec![(2, own), (-1, b)], vec![(2, a), (-1, f)]]);
        }
        (_, true) => {
            let (a, b) = (spoke(0), spoke(1));
            all.extend([one(b), vec![(1, own), (1, b), (-1, a)], vec![(2, own), (-1, a)]]);
            all.extend([vec![(2, own), (-1, b)], vec![(1, own), (1, a), (-1, b)]]);
        }
    }
    all.rotate_left(if triangles { first } else { 2 * first });
    Some(all)
}

/// The control points of the patch of a face with regular corners only, in the order of [`offsets`].
#[must_use]
pub fn control(level: &Level, face: usize, triangles: bool) -> Option<Vec<Combination>> {
    let t = &level.topology;
    let own = t.polygon(face);
    let corners: &[(i64, i64)] = if triangles { &[(0, 0), (1, 0), (0, 1)] } else { &[(0, 0), (1, 0), (1, 1), (0, 1)] };
    if own.len() != corners.len() {
        return None;
    }
    let directions: &[(i64, i64)] = if triangles { &SIX } else { &EIGHT };
    let mut all: BTreeMap<(i64, i64), Combination> = BTreeMap::new();
    for (k, (corner, at)) in t.corners(face).zip(corners).enumerate() {
        all.insert(*at, vec![(1, own[k])]);
        let around = neighbours(level, Frame { corner, ahead: true }, triangles)?;
        for (m, point) in around.into_iter().enumerate() {
            // The first direction at each corner is that of the next one.
            let d = directions[(m + 2 * k) % directions.len()];
            all.entry((at.0 + d.0, at.1 + d.1)).or_insert(point);
        }
    }
    offsets(triangles).iter().map(|place| all.get(place).cloned()).collect()
}

/// The point that a combination is.
#[must_use]
pub fn combined<S: Space>(space: &S, points: &[S::P], combination: &Combination) -> S::P {
    match combination.as_slice() {
        [(1, v)] => points[*v as usize].clone(),
        terms => {
            let terms: Vec<(i64, &S::P)> = terms.iter().map(|(w, v)| (*w, &points[*v as usize])).collect();
            space.sum(&terms, 1)
        }
    }
}

/// A space in which the test of regularity runs.
pub trait Tested: Space {
    /// The difference of two points.
    fn difference(&self, a: &Self::P, b: &Self::P) -> Self::P;
    /// A vector in floats, for proposals.
    fn approximate(&self, v: &Self::P) -> [f64; 3];
    /// Whether `f(v) > |g(v)|` for two functionals.
    fn inside(&self, f: &[f64; 3], g: &[f64; 3], v: &Self::P) -> bool;
}

impl Tested for Floats {
    fn difference(&self, a: &Self::P, b: &Self::P) -> Self::P {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn approximate(&self, v: &Self::P) -> [f64; 3] {
        v.map(Float::mid)
    }

    fn inside(&self, f: &[f64; 3], g: &[f64; 3], v: &Self::P) -> bool {
        let dot = |f: &[f64; 3]| Float::point(f[0]) * v[0] + Float::point(f[1]) * v[1] + Float::point(f[2]) * v[2];
        (dot(f) - dot(g).abs()).positive()
    }
}

impl Tested for Exact {
    fn difference(&self, a: &Self::P, b: &Self::P) -> Self::P {
        let (a, b) = (a.as_ref()?, b.as_ref()?);
        Some(std::array::from_fn(|k| &a[k] - &b[k]))
    }

    fn approximate(&self, v: &Self::P) -> [f64; 3] {
        match v {
            Some(v) => std::array::from_fn(|k| crate::arith::to_f64(&v[k])),
            None => [f64::NAN; 3],
        }
    }

    fn inside(&self, f: &[f64; 3], g: &[f64; 3], v: &Self::P) -> bool {
        let Some(v) = v else { return false };
        let dot = |f: &[f64; 3]| -> Option<Rational> {
            let mut sum = Rational::from(0);
            for (x, y) in f.iter().zip(v) {
                sum += Rational::try_from(*x).ok()? * y;
            }
            Some(sum)
        };
        matches!((dot(f), dot(g)), (Some(a), Some(b)) if a > abs(&b))
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    #[allow(clippy::float_arithmetic, reason = "proposes functionals")]
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The differences of neighbouring Bézier points in both variables, without those that vanish by the shape of a triangle.
fn differences<S: Tested>(space: &S, net: &Net<S::P>) -> (Vec<S::P>, Vec<S::P>) {
    let along = net.rows.iter().flat_map(|row| row.windows(2).map(|w| space.difference(&w[1], &w[0]))).collect();
    let across = net
        .rows
        .windows(2)
        .flat_map(|w| w[1].iter().zip(&w[0]).map(|(b, a)| space.difference(b, a)).collect::<Vec<_>>())
        .collect();
    (along, across)
}

/// The functionals `f, g` of the plane of the mean derivatives `U, V`: `f(U) = g(V) > 0`, `f(V) = g(U) = 0`.
#[allow(clippy::float_arithmetic, reason = "proposes functionals")]
fn functionals<S: Tested>(space: &S, along: &[S::P], across: &[S::P]) -> ([f64; 3], [f64; 3]) {
    let mean = |all: &[S::P]| {
        all.iter().map(|v| space.approximate(v)).fold([0.0; 3], |s, v| [s[0] + v[0], s[1] + v[1], s[2] + v[2]])
    };
    let scaled = |v: [f64; 3]| {
        let size = v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if size > 0.0 { v.map(|x| x / size) } else { v }
    };
    let (u, v) = (mean(along), mean(across));
    let (su, sv) = (scaled(u), scaled(v));
    let w = cross(su, sv);
    let (f, g) = (cross(sv, w), cross(w, su));
    // Both in units of the means themselves.
    let size = |v: [f64; 3]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    (f.map(|x| x * size(v)), g.map(|x| x * size(u)))
}

/// Whether two functionals show that the derivatives are independent on the whole net: `f > |g|` on all differences in the
/// first variable and `g > |f|` on all in the second.
fn independent<S: Tested>(space: &S, net: &Net<S::P>) -> bool {
    let (along, across, f, g) = functionals_of(space, net);
    along.iter().all(|v| space.inside(&f, &g, v)) && across.iter().all(|v| space.inside(&g, &f, v))
}

/// The differences of neighbouring Bézier points and the functionals that are tried on them.
pub(super) type Proposed<P> = (Vec<P>, Vec<P>, [f64; 3], [f64; 3]);

/// What [`regular`] tries on a net.
pub(super) fn functionals_of<S: Tested>(space: &S, net: &Net<S::P>) -> Proposed<S::P> {
    let (along, across) = differences(space, net);
    let (f, g) = functionals(space, &along, &across);
    (along, across, f, g)
}

/// A piece of a patch with the parameters of its corners.
pub(super) type Piece<P> = (Net<P>, Vec<Spot>);

/// Both halves of a piece, turned so that the next halving is across; of a triangle, so that the side opposite to the new corner
/// is halved next, which keeps the pieces from becoming thin.
pub(super) fn halves<S: Space>(space: &S, (net, places): &Piece<S::P>) -> [Piece<S::P>; 2] {
    let (left, right) = net.halves_by(|a, b| space.sum(&[(1, a), (1, b)], 2));
    let (mut first, second) = halved_corners(places);
    let left = if net.triangle {
        first.rotate_left(1);
        left.turned().turned()
    } else {
        left.turned()
    };
    [(left, first), (right.turned(), second)]
}

/// Tests a patch, halving it up to a depth; the pieces, or the corners of the first one that was not decided.
fn test<S: Tested>(space: &S, net: Net<S::P>, depth: usize) -> Result<usize, Vec<Spot>> {
    let mut pieces = 0;
    let places = corners(net.triangle);
    let mut stack = vec![((net, places), 0)];
    while let Some((piece, level)) = stack.pop() {
        if independent(space, &piece.0) {
            pieces += 1;
        } else if level == depth {
            return Err(piece.1);
        } else {
            let [left, right] = halves(space, &piece);
            stack.extend([(right, level + 1), (left, level + 1)]);
        }
    }
    Ok(pieces)
}

/// The test in floats with bounds: the pieces on which it was proved, or a parameter around which it was not.
///
/// # Errors
/// The corners of the first piece that was not decided.
pub fn regular(space: &Floats, net: Net<[Float; 3]>, depth: usize) -> Result<usize, Vec<Spot>> {
    test(space, net, depth)
}

/// The exact test; `None` for points that are not rational.
#[must_use]
pub fn regular_exactly(space: &Exact, net: &Net<Option<Point3>>, depth: usize) -> Option<Regular> {
    net.rows.iter().flatten().all(Option::is_some).then_some(())?;
    let open = match test(space, net.clone(), depth) {
        Ok(pieces) => return Some(Regular::Proved(pieces)),
        Err(places) => places[0].clone(),
    };
    // Witnesses among the corners of pieces of a moderate depth.
    let mut signs: [Option<Spot>; 2] = [None, None];
    let plane = plane(net);
    let mut stack = vec![((net.clone(), corners(net.triangle)), 0)];
    while let Some((piece, level)) = stack.pop() {
        let (product, spot) = (normal(&piece.0)?, piece.1[0].clone());
        if product.iter().all(|x| *x == 0) {
            return Some(Regular::Refuted(spot));
        }
        if let Some(w) = &plane {
            let sign = dot(w, &product);
            // A turned piece keeps the orientation of a triangle and exchanges the variables of a square.
            let mirrored = !piece.0.triangle && level % 2 == 1;
            let index = usize::from((sign > 0) != mirrored);
            signs[index].get_or_insert(spot);
            if let [Some(a), Some(b)] = &signs {
                return Some(Regular::Folded(a.clone(), b.clone()));
            }
        }
        if level < WITNESSES {
            let [left, right] = halves(space, &piece);
            stack.extend([(right, level + 1), (left, level + 1)]);
        }
    }
    Some(Regular::Open(open))
}

/// How often a patch is halved in search of a witness.
const WITNESSES: usize = 6;

type Point3 = super::read::Point;

fn dot(a: &Point3, b: &Point3) -> Rational {
    a.iter().zip(b).fold(Rational::from(0), |s, (x, y)| s + x * y)
}

pub(super) fn product(a: &Point3, b: &Point3) -> Point3 {
    std::array::from_fn(|k| &a[(k + 1) % 3] * &b[(k + 2) % 3] - &a[(k + 2) % 3] * &b[(k + 1) % 3])
}

/// The product of the derivatives at the first corner, but for a positive factor.
fn normal(net: &Net<Option<Point3>>) -> Option<Point3> {
    let minus = |a: &Option<Point3>, b: &Option<Point3>| -> Option<Point3> {
        let (a, b) = (a.as_ref()?, b.as_ref()?);
        Some(std::array::from_fn(|k| &a[k] - &b[k]))
    };
    let own = &net.rows[0][0];
    Some(product(&minus(&net.rows[0][1], own)?, &minus(&net.rows[1][0], own)?))
}

/// A normal of the plane in which all points of a net lie, where there is exactly one.
fn plane(net: &Net<Option<Point3>>) -> Option<Point3> {
    let points: Vec<&Point3> = net.rows.iter().flatten().map(Option::as_ref).collect::<Option<_>>()?;
    let from = |p: &Point3| -> Point3 { std::array::from_fn(|k| &p[k] - &points[0][k]) };
    let first = points.iter().map(|p| from(p)).find(|v| v.iter().any(|x| *x != 0))?;
    let w = points.iter().map(|p| product(&first, &from(p))).find(|w| w.iter().any(|x| *x != 0))?;
    points.iter().all(|p| dot(&w, &from(p)) == 0).then_some(w)
}

/// The place of each control point of [`bezier`] around the first corner of its face.
#[must_use]
pub fn offsets(triangle: bool) -> Vec<(i64, i64)> {
    if triangle {
        return QUARTIC_POINTS.to_vec();
    }
    (-1..=2).flat_map(|j| (-1..=2).map(move |i| (i, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn exact(height: impl Fn(i64, i64) -> [Rational; 3]) -> Net<Option<Point3>> {
        let points: Vec<Option<Point3>> = offsets(false).into_iter().map(|(i, j)| Some(height(i, j))).collect();
        bezier(&Exact::new(crate::mesh::Scheme::CatmullClark), false, &points)
    }

    fn integers(x: i64, y: i64, z: i64) -> [Rational; 3] {
        [ratio(x, 1), ratio(y, 1), ratio(z, 1)]
    }

    fn answer(net: &Net<Option<Point3>>) -> Regular {
        let space = Exact::new(crate::mesh::Scheme::CatmullClark);
        regular_exactly(&space, net, 8).unwrap()
    }

    #[test]
    fn patches_with_known_answers() {
        assert_eq!(answer(&exact(|i, j| integers(i, j, 0))), Regular::Proved(1));
        assert!(matches!(answer(&exact(|i, j| integers(i, j, 7 * i * i * j))), Regular::Proved(_)));
        // Constant in one variable; constant at one corner of the lattice.
        assert!(matches!(answer(&exact(|i, _| integers(i, 2 * i, 3 * i * i))), Regular::Refuted(_)));
        // (u − 1/3)² folds a plane patch over.
        assert!(matches!(answer(&exact(|i, j| integers(3 * i * i - 2 * i, j, 0))), Regular::Folded(..)));
    }

    #[test]
    fn floats_prove_no_more_than_the_exact_test() {
        let floats = Floats::default();
        for (net, holds) in [
            (exact(|i, j| integers(i, j, i * j * j)), true),
            (exact(|i, j| integers(i * i, j, 0)), false),
            (exact(|i, j| integers(3 * i * i - 2 * i, j, i + j)), true),
        ] {
            let near = net.map(|p| p.as_ref().unwrap().clone().map(|x| Float::of(&x)));
            assert_eq!(regular(&floats, near, 8).is_ok(), holds);
            assert_eq!(matches!(answer(&net), Regular::Proved(_)), holds);
        }
    }
}
