//! What one cell of a regular mesh says of the limit above it (docs/theory.md, Lemma 4): bounds of the limit and its slopes by
//! second differences of the points around the cell.

use super::factors::by_factors;
use super::mesh::Place;
use super::rule::{Lattice, Mask};
use crate::base::number::{lcm, ratio};
use crate::base::{Checked, Matrix, Node, Q, need, reject, some, whole};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::{BTreeMap, BTreeSet};

/// A cell of the lattice: one corner, and the sign of the lattice vectors that lead to the others.
pub type Cell = (Place, i64);

/// Points of a cell at most.
const MAX_POINTS: usize = 64;
/// Words at most.
const MAX_WORDS: usize = 1000;
/// The same for changes of slopes.
const MAX_CHANGES: usize = 4096;
/// Steps taken together at most.
const MAX_STEPS: usize = 7;
/// Binary places of the bounds.
pub const PLACES: usize = 20;
/// The least inner radius of a ring.
const RADIUS: i64 = 3;

/// The regular rule on a cell.
pub struct Regular {
    /// Whether cells are triangles.
    pub triangles: bool,
    /// `N`.
    pub factor: i64,
    /// The points of the cell with the corners (0,0), (1,0), (0,1), and (1,1) for squares.
    pub points: Vec<Place>,
    /// The parts of the cell after a step.
    pub parts: Vec<Cell>,
    /// For each part, for each of its points, the weights of the points of the cell times the denominator.
    pub steps: Vec<Vec<Vec<(usize, i128)>>>,
    /// The denominator.
    pub denominator: i128,
    /// The largest sum of absolute weights of a point times the denominator.
    pub growth: i128,
    /// The second differences: points of the sign +, −, −, +.
    pub differences: Vec<[usize; 4]>,
    /// A bound of the deviation of slopes, in units of `2^-20` of the largest second difference.
    pub slope: i128,
    /// The same for values.
    pub value: i128,
    /// The inner radius of the ring.
    pub radius: i64,
}

/// The place of a point of a cell.
pub fn place((corner, sign): &Cell, point: Place) -> Place {
    (corner.0 + sign * point.0, corner.1 + sign * point.1)
}

/// How far a place is from the centre, in faces.
pub fn distance(triangles: bool, (i, j): Place) -> i64 {
    let most = i.abs().max(j.abs());
    if triangles { most.max((i + j).abs()) } else { most }
}

/// The corners of a cell.
pub fn corners(triangles: bool) -> &'static [Place] {
    if triangles { &[(0, 0), (1, 0), (0, 1)] } else { &[(0, 0), (1, 0), (0, 1), (1, 1)] }
}

/// The corners of the cells across its edges.
fn across(triangles: bool) -> &'static [Place] {
    if triangles {
        &[(1, 1), (-1, 1), (1, -1)]
    } else {
        &[(-1, 0), (-1, 1), (2, 0), (2, 1), (0, -1), (1, -1), (0, 2), (1, 2)]
    }
}

/// The old points on which a new point depends.
pub fn sources(mask: &Mask, factor: i64, p: Place) -> Vec<(Place, Q)> {
    let all = mask.iter().map(|(k, w)| ((p.0 - k.0, p.1 - k.1), w));
    let whole = all.filter(|((i, j), _)| i.rem_euclid(factor) == 0 && j.rem_euclid(factor) == 0);
    whole.map(|((i, j), w)| ((i.div_euclid(factor), j.div_euclid(factor)), w.clone())).collect()
}

fn parts(triangles: bool, factor: i64) -> Vec<Cell> {
    let mut parts = Vec::new();
    for (i, j) in (0..factor).flat_map(|i| (0..factor).map(move |j| (i, j))) {
        if !triangles || i + j < factor {
            parts.push(((i, j), 1));
        }
        if triangles && i + j + 1 < factor {
            parts.push(((i + 1, j + 1), -1));
        }
    }
    parts
}

/// The smallest set of points with the corners on which all points of the parts depend.
fn points(rule: &Lattice, parts: &[Cell]) -> Checked<Vec<Place>> {
    let mut all: BTreeSet<Place> = corners(rule.triangles).iter().copied().collect();
    loop {
        let mut more = all.clone();
        for point in parts.iter().flat_map(|part| all.iter().map(|p| place(part, *p))) {
            more.extend(sources(&rule.mask, rule.factor, point).into_iter().map(|(q, _)| q));
        }
        need(more.len() <= MAX_POINTS, "limits", "a cell depends on too many points")?;
        if more.len() == all.len() {
            let holds = across(rule.triangles).iter().all(|p| all.contains(p));
            need(holds, "limits", "the points of a cell do not hold the cells across its edges")?;
            return Ok(all.into_iter().collect());
        }
        all = more;
    }
}

/// The cells of a sector between two distances from the centre.
pub fn cells(triangles: bool, inner: i64, outer: i64) -> Vec<Cell> {
    let mut all = Vec::new();
    for (i, j) in (0..outer).flat_map(|i| (0..outer).map(move |j| (i, j))) {
        if !triangles && i.max(j) >= inner || triangles && i + j >= inner && i + j < outer {
            all.push(((i, j), 1));
        }
        if triangles && i + j + 1 >= inner && i + j + 2 <= outer {
            all.push(((i + 1, j + 1), -1));
        }
    }
    all
}

/// The pairs of steps along which second differences are taken.
fn pairs(triangles: bool, axes: bool) -> Vec<[Place; 2]> {
    let all: &[Place] = match (triangles, axes) {
        (_, true) => &[(1, 0), (0, 1)],
        (true, false) => &[(1, 0), (0, 1), (-1, 1)],
        (false, false) => &[(1, 0), (0, 1), (1, 1), (1, -1)],
    };
    let first = |k: usize| if axes { k } else { k + 1 };
    (0..all.len()).flat_map(|k| all[first(k)..].iter().map(move |v| [all[k], *v])).collect()
}

/// The four places of a second difference.
pub fn four(o: Place, [u, v]: [Place; 2]) -> [Place; 4] {
    [o, (o.0 + u.0, o.1 + u.1), (o.0 + v.0, o.1 + v.1), (o.0 + u.0 + v.0, o.1 + u.1 + v.1)]
}

impl Regular {
    /// The rule with its bounds; `limits` says how second differences are seen to shrink.
    pub fn new(rule: &Lattice, limits: &Node<'_>) -> Checked<Self> {
        let [by, count, stride] = limits.fields("by steps changes")?;
        let (by, count, stride) = (by.text()?, count.index(MAX_STEPS + 1)?, stride.index(MAX_STEPS + 1)?);
        let known = ["factors", "axes", "words"].contains(&by) && stride > 0 && count > 0;
        need(known && count.is_multiple_of(stride), "format", "no such way to bound limits")?;
        let turned = |(p, w): (&Place, &Q)| rule.mask.get(&(-p.0, -p.1)) == Some(w);
        need(rule.mask.iter().all(turned), "limits", "the mask is not symmetric under half a turn")?;
        let parts = parts(rule.triangles, rule.factor);
        let points = points(rule, &parts)?;
        let weights = Weights::new(rule, &points, &parts)?;
        let all = pairs(rule.triangles, by == "axes");
        let index: BTreeMap<Place, usize> = points.iter().enumerate().map(|(i, p)| (*p, i)).collect();
        let inside = |corners: &[Place; 4]| corners.iter().all(|p| index.contains_key(p));
        let differences = all.iter().flat_map(|pair| points.iter().map(move |o| four(*o, *pair)));
        let differences: Vec<_> = differences.filter(inside).map(|corners| corners.map(|p| index[&p])).collect();
        let radius = radius(rule.triangles, rule.factor, &points)?;
        let (denominator, steps, growth) = weights.whole()?;
        let mut regular = Self {
            triangles: rule.triangles,
            factor: rule.factor,
            points,
            parts,
            steps,
            denominator,
            growth,
            differences,
            slope: 0,
            value: 0,
            radius,
        };
        let norms = Norms::new(&regular)?;
        let shrinking = match by {
            "words" => norms.by_words(&weights.matrices, rule.factor, count)?,
            _ => by_factors(rule, &regular, &all, count)?,
        };
        let slope = norms.slopes(&weights.matrices, stride)? * sum(&shrinking, 1, stride)?;
        let value = norms.values(&weights.matrices)? * sum(&shrinking, rule.factor, 1)?;
        (regular.slope, regular.value) = (units(&slope)?, units(&value)?);
        Ok(regular)
    }

    fn index(&self, p: Place) -> Checked<usize> {
        some(self.points.iter().position(|q| *q == p), "limits", "a corner is no point of the cell")
    }
}

/// `Σ R_m / N^m` over all multiples `m` of the stride, from those of the first steps: `R_(ak+b) ≤ R_k^a R_b`.
fn sum(shrinking: &[Q], factor: i64, stride: usize) -> Checked<Q> {
    let Some((last, first)) = shrinking.split_last() else { return reject("limits", "no steps") };
    let scaled = |m: usize, r: &Q| r / num_traits::pow(whole(factor), m);
    let all: Q = first.iter().enumerate().step_by(stride).map(|(m, r)| scaled(m, r)).sum();
    let rest = scaled(first.len(), last);
    need(rest < Q::one(), "limits", "second differences are not seen to shrink in these steps")?;
    Ok(all / (Q::one() - rest))
}

/// A bound in units, rounded up.
fn units(bound: &Q) -> Checked<i128> {
    let scaled = (bound * Q::from_integer(BigInt::one() << PLACES)).ceil().to_integer();
    some(scaled.to_i128().filter(|b| *b < 1 << (PLACES + 8)), "limits", "the bounds are of no use")
}

/// The least radius of a ring of whose cells each has all its points on one side of the centre, in a half-plane around the middle or a
/// side of the sector: there the lattice continued over the spokes is the mesh.
fn radius(triangles: bool, factor: i64, points: &[Place]) -> Checked<i64> {
    let beyond = |cell: &Cell, (a, b): Place| {
        let side = |p: Place| a * p.0 + b * p.1 > 0;
        points.iter().all(|p| side(place(cell, *p)))
    };
    let apart = |r: &i64| {
        let ring = cells(triangles, *r, factor * r);
        ring.iter().all(|cell| [(1, 0), (1, 1), (0, 1)].iter().any(|f| beyond(cell, *f)))
    };
    let found = (RADIUS..RADIUS + MAX_POINTS as i64).find(apart);
    some(found, "limits", "the cells of no ring are apart from the centre")
}

/// The steps to the parts of a cell.
struct Weights {
    matrices: Vec<Matrix>,
}

impl Weights {
    /// Refuses a rule that does not keep linear functions.
    fn new(rule: &Lattice, points: &[Place], parts: &[Cell]) -> Checked<Self> {
        let matrix = |part: &Cell| {
            let mut entries = vec![Q::zero(); points.len() * points.len()];
            for (row, point) in points.iter().enumerate() {
                let target = place(part, *point);
                let old = sources(&rule.mask, rule.factor, target);
                let moment = |f: &dyn Fn(Place) -> i64| old.iter().map(|(q, w)| w * whole(f(*q))).sum::<Q>();
                let linear = moment(&|_| 1).is_one()
                    && moment(&|q| q.0) * whole(rule.factor) == whole(target.0)
                    && moment(&|q| q.1) * whole(rule.factor) == whole(target.1);
                need(linear, "limits", "the rule does not keep linear functions")?;
                for (q, w) in old {
                    let found = points.iter().position(|p| *p == q);
                    let column = some(found, "limits", "a part depends on a point outside of its cell")?;
                    entries[row * points.len() + column] += w;
                }
            }
            Ok(Matrix::new(points.len(), points.len(), &entries))
        };
        Ok(Self { matrices: parts.iter().map(matrix).collect::<Checked<_>>()? })
    }

    /// The denominator, the steps as whole numbers, and the largest sum of absolute weights: all so small that no product of them
    /// with a value leaves 128 bits.
    #[allow(clippy::type_complexity, reason = "three parts of one thing")]
    fn whole(&self) -> Checked<(i128, Vec<Vec<Vec<(usize, i128)>>>, i128)> {
        let denominator = self.matrices.iter().fold(BigInt::one(), |l, m| lcm(&l, &m.den));
        let small = |x: &BigInt| some(x.to_i128().filter(|x| x.abs() < 1 << 40), "limits", "weights are too long");
        let (mut steps, mut growth) = (Vec::new(), 0);
        for matrix in &self.matrices {
            let mut rows = Vec::new();
            for i in 0..matrix.rows {
                let mut row = Vec::new();
                for (j, x) in matrix.integers(i).iter().enumerate() {
                    if !x.is_zero() {
                        row.push((j, small(&(x * &denominator / &matrix.den))?));
                    }
                }
                growth = row.iter().map(|(_, w): &(usize, i128)| w.abs()).sum::<i128>().max(growth);
                rows.push(row);
            }
            steps.push(rows);
        }
        Ok((small(&denominator)?, steps, growth))
    }
}

/// Norms of functionals that are 0 on linear nets, by second differences.
struct Norms<'a> {
    regular: &'a Regular,
    /// The points other than three corners.
    others: Vec<usize>,
    /// The second differences as rows.
    differences: Matrix,
    /// The values at the other points of nets that are 0 at the three corners, from the second differences.
    inverse: Matrix,
}

impl<'a> Norms<'a> {
    fn new(regular: &'a Regular) -> Checked<Self> {
        let three = corners(true).iter().map(|p| regular.index(*p)).collect::<Checked<Vec<_>>>()?;
        let others: Vec<usize> = (0..regular.points.len()).filter(|i| !three.contains(i)).collect();
        let row = |[a, b, c, d]: &[usize; 4]| {
            let count = |i: usize| [(a, 1), (b, -1), (c, -1), (d, 1)].iter().filter(|p| *p.0 == i).map(|p| p.1).sum();
            (0..regular.points.len()).map(|i| whole(count(i))).collect::<Vec<Q>>()
        };
        let rows: Vec<Vec<Q>> = regular.differences.iter().map(row).collect();
        let differences = Matrix::from_rows(regular.points.len(), &rows);
        let part = differences.columns(&others);
        let across = part.transpose();
        let inverse = across.times(&part)?.solve(&across)?;
        let inverse = some(inverse, "limits", "second differences do not determine nets")?.reduced();
        Ok(Self { regular, others, differences, inverse })
    }

    /// A bound of the functionals, which are rows, by the largest second difference.
    fn largest(&self, rows: &Matrix) -> Checked<Q> {
        let all = rows.columns(&self.others).times(&self.inverse)?;
        let norm = |i: usize| all.integers(i).iter().map(Signed::abs).sum::<BigInt>();
        let largest = (0..all.rows).map(norm).fold(BigInt::zero(), BigInt::max);
        Ok(ratio(largest, all.den))
    }

    /// `R_0, …`: how much the steps along all words of each length shrink second differences, times the scale of slopes.
    fn by_words(&self, steps: &[Matrix], factor: i64, count: usize) -> Checked<Vec<Q>> {
        let mut all = vec![Q::one()];
        let (mut words, mut scale) = (vec![self.differences.clone()], Q::one());
        for _ in 0..count {
            need(words.len() * steps.len() <= MAX_WORDS, "limit", "too many words")?;
            let longer = words.iter().flat_map(|w| steps.iter().map(|t| Ok(w.times(t)?.reduced())));
            words = longer.collect::<Checked<_>>()?;
            scale *= whole(factor);
            let mut worst = Q::zero();
            for word in &words {
                worst = worst.max(self.largest(word)?);
            }
            all.push(worst * &scale);
        }
        Ok(all)
    }

    /// How much the steps along all words of a length change slopes.
    fn slopes(&self, steps: &[Matrix], length: usize) -> Checked<Q> {
        let r = self.regular;
        let (slopes, _) = fits(r)?;
        let (mut words, mut scale) = (vec![(slopes.clone(), 1)], Q::one());
        for _ in 0..length {
            need(words.len() * steps.len() <= MAX_CHANGES, "limit", "too many words")?;
            let longer = words.iter().flat_map(|(word, sign)| {
                let part = move |(step, part): (&Matrix, &Cell)| Ok((word.times(step)?.reduced(), sign * part.1));
                steps.iter().zip(&r.parts).map(part)
            });
            words = longer.collect::<Checked<_>>()?;
            scale *= whole(r.factor);
        }
        let mut worst = Q::zero();
        for (word, sign) in words {
            let change = word.scaled(&(&scale * whole(sign))).minus(&slopes);
            worst = worst.max(self.largest(&change)?);
        }
        Ok(worst)
    }

    /// How much one step changes the linear fit.
    fn values(&self, steps: &[Matrix]) -> Checked<Q> {
        let r = self.regular;
        let (slopes, fits) = fits(r)?;
        let (factor, mut worst) = (whole(r.factor), Q::zero());
        for (part, step) in r.parts.iter().zip(steps) {
            let new = fits.times(step)?;
            for (k, corner) in corners(r.triangles).iter().enumerate() {
                let (x, y) = place(part, *corner);
                let old = fits.row(0).plus(&(whole(x) / &factor), &slopes.row(0));
                let old = old.plus(&(whole(y) / &factor), &slopes.row(1));
                worst = worst.max(self.largest(&new.row(k).minus(&old))?);
            }
        }
        Ok(worst)
    }
}

/// The slopes of the linear fit at the corners and its values there, as functionals.
fn fits(r: &Regular) -> Checked<(Matrix, Matrix)> {
    let size = r.points.len();
    let at = |weights: &[i64]| {
        let mut row = vec![Q::zero(); size];
        for (corner, w) in corners(r.triangles).iter().zip(weights) {
            row[r.index(*corner)?] = whole(*w);
        }
        Ok(row)
    };
    let rows = |all: &[&[i64]], divisor: i64| {
        let rows = all.iter().map(|w| at(w)).collect::<Checked<Vec<_>>>()?;
        Ok(Matrix::from_rows(size, &rows).scaled(&(Q::one() / whole(divisor))))
    };
    if r.triangles {
        return Ok((rows(&[&[-1, 1, 0], &[-1, 0, 1]], 1)?, rows(&[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]], 1)?));
    }
    let slopes = rows(&[&[-1, 1, -1, 1], &[-1, -1, 1, 1]], 2)?;
    Ok((slopes, rows(&[&[3, 1, 1, -1], &[1, 3, -1, 1], &[1, -1, 3, 1], &[-1, 1, 1, 3]], 4)?))
}

#[cfg(test)]
mod tests {
    use super::super::rule::Rule;
    use super::*;
    use crate::base::Json;

    fn regular(rule: &Lattice, by: &str, steps: u64, changes: u64) -> Checked<Regular> {
        let [by, steps, changes] = [Json::Text(by.to_owned()), Json::Index(steps), Json::Index(changes)];
        let limits = vec![("by".to_owned(), by), ("steps".to_owned(), steps), ("changes".to_owned(), changes)];
        Regular::new(rule, &Node { value: &Json::Object(limits), place: String::new() })
    }

    fn butterfly(p: i64, q: i64) -> Lattice {
        Rule::Butterfly { tension: whole(p) / whole(q), modified: false }.lattice()
    }

    /// Tensor products of curves with these symmetric masks.
    fn product(half: &[i64], of: i64) -> Lattice {
        let most = half.len() as i64 - 1;
        let at = |i: i64| whole(half[i.unsigned_abs() as usize]) / whole(of);
        let all = (-most..=most).flat_map(|i| (-most..=most).map(move |j| (i, j)));
        let mut mask: Mask = all.map(|(i, j)| ((i, j), at(i) * at(j))).collect();
        mask.retain(|_, w| !w.is_zero());
        Lattice { triangles: false, factor: 2, mask }
    }

    fn turned(triangles: bool) -> Lattice {
        Rule::Turned { triangles, near: None }.lattice()
    }

    /// Random nets, refined some times: slopes and fits stay within the bounds, which are not idle.
    #[test]
    fn nets_stay_within_the_bounds() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i128::from(seed >> 44) << 40
        };
        let rules = [
            (butterfly(1, 16), "factors", [6, 3], 4),
            (butterfly(1, 100), "factors", [6, 1], 4),
            (turned(true), "words", [1, 1], 2),
            (turned(false), "factors", [3, 3], 4),
            (turned(false), "words", [2, 1], 4),
            (product(&[16, 9, 0, -1], 16), "axes", [6, 2], 4),
            (product(&[6, 4, 1], 8), "axes", [2, 2], 4),
        ];
        for (rule, by, [steps, changes], depth) in rules {
            let r = regular(&rule, by, steps, changes).unwrap();
            let (scale, all) = (if r.triangles { 1 } else { 2 }, corners(r.triangles));
            let at = |v: &[i128], c: &Place| v[r.points.iter().position(|p| p == c).unwrap()];
            let slopes = |v: &[i128]| match all.iter().map(|c| at(v, c)).collect::<Vec<_>>()[..] {
                [a, b, c] => [b - a, c - a],
                [a, b, c, d] => [b - a + d - c, c - a + d - b],
                _ => panic!("a cell has three or four corners"),
            };
            let mut closest = 0;
            for _ in 0..5 {
                let net: Vec<i128> = r.points.iter().map(|_| random()).collect();
                let size = |[a, b, c, d]: &[usize; 4]| (net[*a] - net[*b] - net[*c] + net[*d]).abs();
                let rough = r.differences.iter().map(size).max().unwrap();
                let whole = slopes(&net);
                let mut level = vec![(net.clone(), 1)];
                for m in 1..=depth {
                    let step = |(v, sign): &(Vec<i128>, i64)| -> Vec<(Vec<i128>, i64)> {
                        let row = |row: &Vec<(usize, i128)>| row.iter().map(|(i, w)| v[*i] * w).sum::<i128>();
                        let part =
                            |rows: &Vec<Vec<(usize, i128)>>| rows.iter().map(|x| row(x) / r.denominator).collect();
                        r.steps.iter().zip(&r.parts).map(|(rows, cell)| (part(rows), sign * cell.1)).collect()
                    };
                    level = level.iter().flat_map(step).collect();
                    let finer = i128::from(r.factor).pow(m);
                    for (v, sign) in &level {
                        for (own, whole) in slopes(v).iter().zip(&whole) {
                            let off = (i128::from(*sign) * finer * own - whole).abs() / scale;
                            assert!(off <= (r.slope * rough) >> PLACES, "{by}: slopes");
                            closest = closest.max((off << PLACES) / rough);
                        }
                    }
                }
            }
            assert!(64 * closest > r.slope, "{by}: the bound is idle");
        }
    }

    /// Bounds that are computed in two ways are near each other, and rules that are not smooth have none.
    #[test]
    fn bounds_are_refused() {
        // In hundredths, by a script of its own in floats.
        for (rule, by, [steps, changes], slope) in [
            (butterfly(1, 16), "factors", [6, 1], 599),
            (butterfly(1, 16), "factors", [4, 4], 419),
            (butterfly(1, 100), "factors", [4, 4], 428),
            (turned(true), "words", [1, 1], 726),
            (turned(false), "words", [2, 1], 454),
            (turned(false), "factors", [1, 1], 209),
            (product(&[16, 9, 0, -1], 16), "axes", [6, 1], 445),
        ] {
            let found = (100 * regular(&rule, by, steps, changes).unwrap().slope) >> PLACES;
            assert!((found - slope).abs() <= 1, "{by}: {found} hundredths");
        }
        assert!(
            regular(&butterfly(1, 16), "factors", 6, 4).is_err()
                && regular(&butterfly(1, 16), "factors", 6, 0).is_err()
        );
        // Piecewise linear, not convergent, or not seen to shrink in these steps.
        let bad = [
            (butterfly(0, 1), "factors", 6),
            (butterfly(1, 2), "factors", 6),
            (butterfly(-1, 16), "factors", 6),
            (butterfly(1, 16), "factors", 1),
            (butterfly(1, 16), "axes", 6),
            (butterfly(1, 16), "words", 3),
            (turned(true), "factors", 3),
            (product(&[16, 9, 0, -1], 16), "factors", 6),
            (product(&[2, 1], 2), "axes", 4),
            (butterfly(1, 16), "trust", 3),
            (butterfly(1, 16), "factors", 0),
        ];
        for (k, (rule, by, steps)) in bad.iter().enumerate() {
            assert!(regular(rule, by, *steps, 1).is_err(), "{k}");
        }
    }
}
