//! Schemes without Bézier patches on a regular mesh (butterfly and √3 are no splines; 4-8 is treated like them): how far a limit and its derivatives can be from the control points of a
//! cell (docs/theory.md, Lemma 4).
//!
//! A cell is a triangle or a square of the lattice; its points are those that decide the surface above it. One step (or
//! the two steps of a turning scheme) divides the cell in `N²`, each with points that follow from the old ones by `T_s`.

use super::factored::{Mask, shrinking};
use crate::arith::{Integer, Natural, Rational, ratio};
use crate::linalg::Matrix;
use crate::scheme::{Lattice, MeshRule, Sector, SectorStencils, sector_stencils};
use malachite_base::num::arithmetic::traits::{Abs, Ceiling, Lcm};
use malachite_base::num::conversion::traits::RoundingFrom;
use malachite_base::rounding_modes::RoundingMode;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};

/// A place in the lattice.
pub type Place = (i64, i64);

/// Rings of the regular mesh from which the mask is read.
const RINGS: usize = 6;
/// Points of a cell at most.
const MAX_POINTS: usize = 64;
/// Words examined at most for the bounds of one scheme, and where they hardly shrink differences.
const MAX_WORDS: [usize; 2] = [1100, 4500];
/// Words are long enough where all shrink differences to the first part, and still too short where not to the second.
const ENOUGH: [(i64, i64); 2] = [(1, 4), (1, 2)];
/// Binary places of the generalised inverse.
const PLACES: u64 = 40;
/// Entries of products of steps stay below this power of 2.
const MAX_BITS: u32 = 70;
/// Weights and their denominator stay below this power of 2.
const WEIGHT_BITS: u32 = 60;
/// Bounds of this size and more are of no use.
const USELESS: i128 = 1 << (BOUND_PLACES + 10);
/// Binary places of the bounds.
pub const BOUND_PLACES: u64 = 20;

/// A cell of the lattice: one corner, and the sign of the lattice vectors that lead to the others.
pub type Cell = (Place, i64);

/// The regular rule of a scheme, cell by cell.
#[derive(Debug)]
pub struct Regular {
    /// Whether cells are triangles.
    pub triangles: bool,
    /// `N`: a step makes the lattice so many times finer.
    pub factor: i64,
    /// The points of the cell with corners (0,0), (1,0), (0,1), and (1,1) for squares.
    pub points: Vec<Place>,
    /// The inner radius of the ring around a centre: its cells have no points there.
    pub radius: i64,
    /// The parts of the cell after a step, in the finer lattice.
    pub parts: Vec<Cell>,
    /// The common denominator of all weights.
    pub denominator: i128,
    /// For each part, for each of its points, the weights of the points of the cell times the denominator.
    pub steps: Vec<Vec<Vec<(usize, i128)>>>,
    /// The largest sum of absolute weights of one point, times the denominator.
    pub growth: i128,
    /// The second differences: points of the sign +, −, −, +.
    pub differences: Vec<[usize; 4]>,
    /// How the second differences shrink.
    pub shrinks: Shrinks,
    /// A bound of `|∇f − slope|` in units of `2^-20` of the largest second difference.
    pub slope_bound: i128,
    /// A bound of `|f − fit|` in the same units.
    pub value_bound: i128,
}

/// The corners of the cells across the edges of a cell.
fn across(triangles: bool) -> &'static [Place] {
    if triangles {
        &[(1, 1), (-1, 1), (1, -1)]
    } else {
        &[(-1, 0), (-1, 1), (2, 0), (2, 1), (0, -1), (1, -1), (0, 2), (1, 2)]
    }
}

/// How many steps of a regular rule shrink second differences, times the scale of slopes, and to which part (Lemma 4).
#[derive(Debug, Clone)]
pub struct Shrinks {
    /// `k`: so many steps.
    pub length: usize,
    /// `R < 1`.
    pub to: Rational,
    /// Whether `R` comes from the factors of the mask (Lemma 4′).
    pub by_factors: bool,
}

impl Regular {
    /// Whether the points hold the corners of the cells across the edges of the cell.
    #[must_use]
    pub fn holds_across(&self) -> bool {
        across(self.triangles).iter().all(|p| self.points.contains(p))
    }

    /// `e₁` and `e₀` of Lemma 4, rounded up.
    #[must_use]
    pub fn bounds(&self) -> (Rational, Rational) {
        let unit = Rational::from(Integer::from(1) << BOUND_PLACES);
        let of = |x: i128| Rational::from(Integer::from(x)) / &unit;
        (of(self.slope_bound), of(self.value_bound))
    }

    /// The regular rule of a scheme with its bounds, computed once for each scheme; `None` where a step does not keep
    /// linear functions, or no contraction of the second differences was found.
    ///
    /// # Cost
    /// About a thousand products of small matrices at the first call, a comparison afterwards.
    #[must_use]
    pub fn of(rule: &MeshRule) -> Option<Arc<Self>> {
        static KNOWN: Mutex<Vec<(Lattice, Option<Arc<Regular>>)>> = Mutex::new(Vec::new());
        let lattice = rule.lattice();
        let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some((_, found)) = known.iter().find(|(l, _)| *l == lattice) {
            return found.clone();
        }
        let found = Self::build(&rule.regular()).map(Arc::new);
        known.push((lattice, found.clone()));
        found
    }

    /// Whether second differences along the axes alone, also twice along the same one, are seen to shrink by the factors of the mask of
    /// a rule with this regular mesh in some steps.
    #[must_use]
    pub fn shrinks_along_axes(&self, rule: &MeshRule) -> bool {
        let axes = [((1, 0), (1, 0)), ((0, 1), (0, 1)), ((1, 0), (0, 1))];
        let halves = mask(&rule.regular()).filter(|_| self.factor == 2);
        let bounds = halves.and_then(|(_, _, mask)| shrinking(&mask, &axes, &self.points, &self.parts));
        bounds.is_some_and(|all| all.last().is_some_and(|last| *last < 1))
    }

    fn build(rule: &MeshRule) -> Option<Self> {
        let (triangles, factor, mask) = mask(rule)?;
        let parts = parts(triangles, factor);
        let points = points(triangles, factor, &mask, &parts)?;
        let denominator = mask.values().fold(Natural::from(1_u32), |d, w| d.lcm(w.denominator_ref()));
        let denominator = Integer::from(denominator);
        let scaled = |w: &Rational| Integer::try_from(w * Rational::from(&denominator)).ok();
        let index: BTreeMap<Place, usize> = points.iter().enumerate().map(|(i, p)| (*p, i)).collect();
        let mut steps = Vec::new();
        for part in &parts {
            let mut rows = Vec::new();
            for point in &points {
                let mut row = Vec::new();
                for (q, w) in sources(&mask, factor, place(part, *point)) {
                    let weight = i128::try_from(&scaled(w)?).ok()?;
                    if weight.unsigned_abs() >> WEIGHT_BITS != 0 {
                        return None;
                    }
                    row.push((*index.get(&q)?, weight));
                }
                rows.push(row);
            }
            steps.push(rows);
        }
        let sum = |row: &Vec<(usize, i128)>| row.iter().map(|(_, w)| w.abs()).sum::<i128>();
        let growth = steps.iter().flatten().map(sum).max()?;
        let differences = differences(triangles, &index);
        let denominator = i128::try_from(&denominator).ok().filter(|d| d >> WEIGHT_BITS == 0)?;
        let mut regular = Self {
            triangles,
            factor,
            radius: super::limit::radius(triangles, factor, &points),
            points,
            parts,
            denominator,
            steps,
            growth,
            differences,
            shrinks: Shrinks { length: 0, to: ratio(1, 1), by_factors: false },
            slope_bound: 0,
            value_bound: 0,
        };
        if !regular.keeps_linear_functions() {
            return None;
        }
        (regular.shrinks, regular.slope_bound, regular.value_bound) = Bounds::new(&regular)?.found(&mask)?;
        Some(regular)
    }

    /// The factor by which the integer functionals below are too large: slopes, and values.
    #[must_use]
    pub fn scales(&self) -> (i128, i128) {
        if self.triangles { (1, 1) } else { (2, 4) }
    }

    /// The corners of the cell.
    #[must_use]
    pub fn corners(&self) -> &'static [Place] {
        if self.triangles { &[(0, 0), (1, 0), (0, 1)] } else { &[(0, 0), (1, 0), (0, 1), (1, 1)] }
    }

    fn index(&self, p: Place) -> Option<usize> {
        self.points.iter().position(|q| *q == p)
    }

    /// The two slopes of the linear fit, times their scale.
    #[must_use]
    pub fn slopes(&self, values: &[i128]) -> [i128; 2] {
        let at = |p: Place| self.index(p).map_or(0, |i| values[i]);
        let (a, b, c) = (at((0, 0)), at((1, 0)), at((0, 1)));
        if self.triangles {
            return [b - a, c - a];
        }
        let d = at((1, 1));
        [b - a + d - c, c - a + d - b]
    }

    /// The linear fit at the corners, times its scale.
    #[must_use]
    pub fn fit(&self, values: &[i128]) -> Vec<i128> {
        let at = |p: &Place| self.index(*p).map_or(0, |i| values[i]);
        if self.triangles {
            return self.corners().iter().map(at).collect();
        }
        let sum: i128 = self.corners().iter().map(at).sum();
        let [u, v] = self.slopes(values);
        let sign = |x: i64| i128::from(2 * x - 1);
        self.corners().iter().map(|(a, b)| sum + sign(*a) * u + sign(*b) * v).collect()
    }

    /// The largest absolute second difference.
    #[must_use]
    pub fn roughness(&self, values: &[i128]) -> i128 {
        let size = |[a, b, c, d]: &[usize; 4]| (values[*a] - values[*b] - values[*c] + values[*d]).abs();
        self.differences.iter().map(size).fold(0, i128::max)
    }

    /// Whether every step takes the values of a linear function to those of the same function.
    fn keeps_linear_functions(&self) -> bool {
        let factor = i128::from(self.factor);
        self.parts.iter().zip(&self.steps).all(|(part, rows)| {
            self.points.iter().zip(rows).all(|(point, row)| {
                let target = place(part, *point);
                let sum = |f: &dyn Fn(Place) -> i64| {
                    row.iter().map(|(i, w)| w * i128::from(f(self.points[*i]))).sum::<i128>()
                };
                sum(&|_| 1) == self.denominator
                    && factor * sum(&|p| p.0) == self.denominator * i128::from(target.0)
                    && factor * sum(&|p| p.1) == self.denominator * i128::from(target.1)
            })
        })
    }
}

/// A point of a cell in the lattice.
#[must_use]
pub fn place((corner, sign): &Cell, point: Place) -> Place {
    (corner.0 + sign * point.0, corner.1 + sign * point.1)
}

/// The mask, read from the stencils around a regular vertex; whether the mesh has triangles, and `N`.
fn mask(rule: &MeshRule) -> Option<(bool, i64, Mask)> {
    let triangles = rule.sector() == Sector::Triangles;
    let factor = rule.info().split.factor();
    let stencils = sector_stencils(rule, if triangles { 6 } else { 4 }, RINGS).ok()?;
    let mut mask = Mask::new();
    let mut seen = BTreeSet::new();
    for (index, (i, j)) in stencils.places.iter().enumerate() {
        let p = (i64::try_from(*i).ok()?, i64::try_from(*j).ok()?);
        if !seen.insert((p.0.rem_euclid(factor), p.1.rem_euclid(factor))) {
            continue;
        }
        for (q, weight) in row(&stencils, index, triangles) {
            *mask.entry((p.0 - factor * q.0, p.1 - factor * q.1)).or_default() += weight;
        }
    }
    // The cells that lie upside down are turned by half a circle.
    let even = mask.iter().all(|(p, w)| mask.get(&(-p.0, -p.1)) == Some(w));
    (even && seen.len() == usize::try_from(factor * factor).ok()?).then_some((triangles, factor, mask))
}

/// The weights of a new point around a regular vertex by the place of the old one.
fn row(stencils: &SectorStencils, index: usize, triangles: bool) -> Vec<(Place, Rational)> {
    let turned = |(i, j): Place, shift: i64| {
        let around = if triangles { 6 } else { 4 };
        (0..shift.rem_euclid(around)).fold((i, j), |(i, j), _| if triangles { (-j, i + j) } else { (-j, i) })
    };
    let place = |orbit: usize| {
        let (i, j) = stencils.places[orbit];
        (i as i64, j as i64)
    };
    let mut list = vec![((0, 0), stencils.from_centre[index].clone())];
    list.extend(stencils.rows[index].iter().map(|(orbit, shift, w)| (turned(place(*orbit), *shift), w.clone())));
    list.retain(|(_, w)| *w != 0);
    list
}

fn parts(triangles: bool, factor: i64) -> Vec<Cell> {
    let mut parts = Vec::new();
    for i in 0..factor {
        for j in 0..factor {
            if !triangles || i + j < factor {
                parts.push(((i, j), 1));
            }
            if triangles && i + j + 1 < factor {
                parts.push(((i + 1, j + 1), -1));
            }
        }
    }
    parts
}

/// The old points on which a point depends.
fn sources(mask: &Mask, factor: i64, p: Place) -> impl Iterator<Item = (Place, &Rational)> {
    mask.iter().filter_map(move |(k, w)| {
        let (i, j) = (p.0 - k.0, p.1 - k.1);
        (i.rem_euclid(factor) == 0 && j.rem_euclid(factor) == 0).then_some(((i / factor, j / factor), w))
    })
}

/// The smallest set of points with the corners on which all points of the parts depend; `None` where it does not hold the
/// cells across the edges.
fn points(triangles: bool, factor: i64, mask: &Mask, parts: &[Cell]) -> Option<Vec<Place>> {
    let mut all: BTreeSet<Place> = [(0, 0), (1, 0), (0, 1)].into();
    if !triangles {
        all.insert((1, 1));
    }
    loop {
        let mut more = all.clone();
        for part in parts {
            for p in &all {
                more.extend(sources(mask, factor, place(part, *p)).map(|(q, _)| q));
            }
        }
        if more.len() == all.len() {
            // Without the cells across the edges nothing would be said of how slopes continue there.
            let across = across(triangles);
            return across.iter().all(|p| all.contains(p)).then(|| all.into_iter().collect());
        }
        if more.len() > MAX_POINTS {
            return None;
        }
        all = more;
    }
}

fn directions(triangles: bool) -> &'static [Place] {
    if triangles { &[(1, 0), (0, 1), (-1, 1)] } else { &[(1, 0), (0, 1), (1, 1), (1, -1)] }
}

/// All pairs of directions.
fn pairs(triangles: bool) -> Vec<(Place, Place)> {
    let all = directions(triangles);
    (0..all.len()).flat_map(|k| all[k + 1..].iter().map(move |v| (all[k], *v))).collect()
}

fn differences(triangles: bool, index: &BTreeMap<Place, usize>) -> Vec<[usize; 4]> {
    let mut all = Vec::new();
    for (u, v) in pairs(triangles) {
        for o in index.keys() {
            let at = |s: i64, t: i64| index.get(&(o.0 + s * u.0 + t * v.0, o.1 + s * u.1 + t * v.1)).copied();
            if let (Some(a), Some(b), Some(c), Some(d)) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1)) {
                all.push([a, b, c, d]);
            }
        }
    }
    all
}

/// A word: the product of its steps times `(N denominator)^length`, by rows, and where its part lies.
struct Word {
    rows: Vec<Vec<i128>>,
    origin: Place,
    sign: i64,
}

/// The bounds of Lemma 4 from all words of one length.
struct Bounds<'a> {
    regular: &'a Regular,
    /// The points other than three corners.
    others: Vec<usize>,
    /// A matrix that gives the values there from the second differences of nets that are 0 at the three corners, times
    /// `2^PLACES` and rounded.
    inverse: Vec<Vec<i128>>,
    /// The sums of the absolute entries of its rows.
    sums: Vec<i128>,
}

impl<'a> Bounds<'a> {
    fn new(regular: &'a Regular) -> Option<Self> {
        let corners: Vec<usize> = regular.corners()[..3].iter().filter_map(|p| regular.index(*p)).collect();
        let others: Vec<usize> = (0..regular.points.len()).filter(|i| !corners.contains(i)).collect();
        let entry = |r: usize, c: usize| {
            let [a, b, c1, d] = regular.differences[r];
            let i = others[c];
            let count = |p: usize| i64::from(p == i);
            ratio(count(a) - count(b) - count(c1) + count(d), 1)
        };
        let a = Matrix::from_fn(regular.differences.len(), others.len(), entry);
        if a.rank() != others.len() {
            return None;
        }
        let transposed = a.transpose();
        let exact = (&transposed * &a).solve(&transposed)?;
        let unit = Rational::from(Integer::from(1) << PLACES);
        let rounded = |x: &Rational| i128::try_from(&Integer::rounding_from(x * &unit, RoundingMode::Nearest).0).ok();
        let inverse =
            (0..exact.rows()).map(|i| exact.row(i).iter().map(rounded).collect()).collect::<Option<Vec<_>>>()?;
        let sums = inverse.iter().map(|row: &Vec<i128>| row.iter().map(|x| x.abs()).sum()).collect();
        Some(Self { regular, others, inverse, sums })
    }

    /// A bound of the sum of absolute coefficients of a functional that is 0 on linear functions, written in the second
    /// differences; times `2^PLACES`.
    fn norm(&self, row: &[i128]) -> Option<Integer> {
        let mut total = Integer::from(0);
        let count = self.regular.differences.len();
        let mut size = 0_i128;
        for i in &self.others {
            if row[*i].unsigned_abs() >> MAX_BITS != 0 {
                return None;
            }
            size += row[*i].abs();
        }
        for j in 0..count {
            let sum: i128 = self.others.iter().zip(&self.inverse).map(|(i, inverse)| row[*i] * inverse[j]).sum();
            total += Integer::from(sum.abs());
        }
        // Every entry of the inverse is off by half a unit at most.
        Some(total + Integer::from(size) * Integer::from(count as u64))
    }

    /// The largest of a bound and of [`Self::norm`] of some functionals.
    fn worst(&self, least: Integer, rows: impl IntoIterator<Item = Vec<i128>>) -> Option<Integer> {
        let count = self.regular.differences.len() as i128;
        rows.into_iter().try_fold(least, |worst, row| {
            // Row by row of the inverse the sum is no smaller: most functionals need no more than this.
            let fits = self.others.iter().all(|i| row[*i].unsigned_abs() >> MAX_BITS == 0);
            let term = |(i, sum): (&usize, &i128)| row[*i].abs().checked_mul(sum.checked_add(count)?);
            let coarse = if fits {
                self.others.iter().zip(&self.sums).try_fold(0_i128, |s, t| s.checked_add(term(t)?))
            } else {
                None
            };
            match coarse {
                Some(coarse) if coarse <= worst => Some(worst),
                _ => Some(worst.max(self.norm(&row)?)),
            }
        })
    }

    fn first(&self) -> Word {
        let size = self.regular.points.len();
        let rows = (0..size).map(|i| (0..size).map(|j| i128::from(i == j)).collect()).collect();
        Word { rows, origin: (0, 0), sign: 1 }
    }

    fn longer(&self, word: &Word) -> Option<Vec<Word>> {
        let r = self.regular;
        let factor = i128::from(r.factor);
        let extend = |(part, step): (&Cell, &Vec<Vec<(usize, i128)>>)| {
            let row = |weights: &Vec<(usize, i128)>| {
                let mut sum = vec![0_i128; r.points.len()];
                for (i, w) in weights {
                    for (s, x) in sum.iter_mut().zip(&word.rows[*i]) {
                        *s = s.checked_add(x.checked_mul(w.checked_mul(factor)?)?)?;
                    }
                }
                sum.iter().all(|s| s.unsigned_abs() >> MAX_BITS == 0).then_some(sum)
            };
            let origin = place(&((r.factor * word.origin.0, r.factor * word.origin.1), word.sign), part.0);
            Some(Word { rows: step.iter().map(row).collect::<Option<_>>()?, origin, sign: word.sign * part.1 })
        };
        r.parts.iter().zip(&r.steps).map(extend).collect()
    }

    /// The values of a functional, given by its values on nets, on each column of a word.
    fn along(word: &Word, functional: impl Fn(&[i128]) -> Vec<i128>) -> Vec<Vec<i128>> {
        let columns = word.rows.len();
        let by_column: Vec<Vec<i128>> =
            (0..columns).map(|j| functional(&word.rows.iter().map(|row| row[j]).collect::<Vec<_>>())).collect();
        (0..by_column[0].len()).map(|f| by_column.iter().map(|c| c[f]).collect()).collect()
    }

    /// How much the words of one length shrink second differences, and how far slopes and values move by them: all in the
    /// units of [`Self::norm`], products of steps being too large by `unit`, and by `size` beside.
    fn measure(&self, words: &[Word], unit: i128, size: i128) -> Option<[Integer; 3]> {
        let r = self.regular;
        let start = self.first();
        let slopes = Self::along(&start, |v| r.slopes(v).to_vec());
        let fit = Self::along(&start, |v| r.fit(v));
        let (slope_scale, value_scale) = r.scales();
        let ratio = value_scale / slope_scale;
        let second = |v: &[i128]| r.differences.iter().map(|[a, b, c, d]| v[*a] - v[*b] - v[*c] + v[*d]).collect();
        let change = |new: &[Vec<i128>], old: &[Vec<i128>], sign: i128| -> Vec<Vec<i128>> {
            let row =
                |(new, old): (&Vec<i128>, &Vec<i128>)| new.iter().zip(old).map(|(x, y)| sign * x - unit * y).collect();
            new.iter().zip(old).map(row).collect()
        };
        let mut worst = [0, 0, 0].map(Integer::from);
        for word in words {
            let at = |corner: &Place| {
                let p = place(&(word.origin, word.sign), *corner);
                let (x, y) = (i128::from(p.0) * ratio, i128::from(p.1) * ratio);
                (0..r.points.len()).map(|j| size * fit[0][j] + x * slopes[0][j] + y * slopes[1][j]).collect()
            };
            let old: Vec<Vec<i128>> = r.corners().iter().map(at).collect();
            let sets = [
                Self::along(word, second),
                change(&Self::along(word, |v| r.slopes(v).to_vec()), &slopes, i128::from(word.sign)),
                change(&Self::along(word, |v| r.fit(v)), &old, 1),
            ];
            for (worst, rows) in worst.iter_mut().zip(sets) {
                *worst = self.worst(worst.clone(), rows)?;
            }
        }
        Some(worst)
    }

    /// Bounds for slope and value, in units of `2^-BOUND_PLACES`, rounded up. How much second differences shrink is known from the
    /// words, and from the factors of the mask, where it has them (Lemma 4′).
    fn found(&self, mask: &Mask) -> Option<(Shrinks, i128, i128)> {
        let r = self.regular;
        let factors = (r.factor == 2).then(|| shrinking(mask, &pairs(r.triangles), &r.points, &r.parts)).flatten();
        let mut length = 0;
        let (slope_scale, value_scale) = r.scales();
        let mut words = vec![self.first()];
        let (mut unit, mut size) = (1_i128, 1_i128);
        let mut best = None;
        let mut most = MAX_WORDS[1];
        while words.len() * r.parts.len() <= most {
            let longer: Option<Vec<Vec<Word>>> = words.iter().map(|w| self.longer(w)).collect();
            let product = unit.checked_mul(r.denominator).filter(|u| u.unsigned_abs() >> MAX_BITS == 0);
            let (Some(longer), Some(product)) = (longer, product) else { break };
            words = longer.into_iter().flatten().collect();
            (unit, size) = (product, size * i128::from(r.factor));
            let Some([shrink, slope, value]) = self.measure(&words, unit, size) else { break };
            let part = |x: &Integer, by: i128| {
                Rational::from(x) / Rational::from(Integer::from(unit) << PLACES) / Rational::from(Integer::from(by))
            };
            length += 1;
            let by_factors = factors.as_ref().and_then(|f| f.get(length)).cloned();
            let by_words = part(&shrink, 1);
            let (shrink, by_factors) = match by_factors.filter(|f| *f < by_words) {
                Some(factor) => (factor, true),
                None => (by_words, false),
            };
            if shrink < 1 {
                let rest = |s: Rational| ratio(1, 1) - s;
                let slope = part(&slope, slope_scale) / rest(shrink.clone());
                let value = part(&value, value_scale * size) / rest(&shrink / Rational::from(Integer::from(size)));
                let shrinks = Shrinks { length, to: shrink.clone(), by_factors };
                let bounds = (shrinks, round_up(&slope)?, round_up(&value)?);
                best = Some(bounds).filter(|(_, slope, value)| *slope.max(value) < USELESS);
            }
            if shrink <= ratio(ENOUGH[0].0, ENOUGH[0].1) {
                break;
            }
            most = if shrink <= ratio(ENOUGH[1].0, ENOUGH[1].1) { MAX_WORDS[0] } else { MAX_WORDS[1] };
        }
        best
    }
}

fn round_up(x: &Rational) -> Option<i128> {
    let scaled = x.abs() * Rational::from(Integer::from(1) << BOUND_PLACES);
    i128::try_from(&(&scaled).ceiling()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::parse_rational;
    use crate::scheme::mesh_rule;
    use crate::vertex::limit::ring_cells;

    fn rule(name: &str, given: &[(&str, Rational)]) -> MeshRule {
        mesh_rule(name, &given.iter().map(|(k, x)| ((*k).to_owned(), x.clone())).collect()).unwrap()
    }

    fn butterfly(w: Rational) -> MeshRule {
        rule("butterfly-modified", &[("w", w)])
    }

    fn rules() -> [MeshRule; 3] {
        [butterfly(ratio(1, 16)), rule("sqrt3-variant", &[("alpha", ratio(1, 3))]), rule("four-eight", &[])]
    }

    fn matrix(r: &Regular, step: usize) -> Matrix {
        let mut m = Matrix::zero(r.points.len(), r.points.len());
        for (i, row) in r.steps[step].iter().enumerate() {
            for (j, w) in row {
                m[(i, *j)] = Rational::from(Integer::from(*w)) / Rational::from(Integer::from(r.denominator));
            }
        }
        m
    }

    #[test]
    fn bounds_are_those_of_the_theory() {
        for (rule, points, parts, slope) in
            [(butterfly(ratio(1, 16)), 27, 4, 5), (rule("sqrt3", &[]), 27, 9, 3), (rule("four-eight", &[]), 32, 4, 3)]
        {
            let r = Regular::of(&rule).unwrap();
            assert_eq!((r.points.len(), r.parts.len()), (points, parts), "{rule:?}");
            assert!(r.slope_bound < slope << BOUND_PLACES && r.value_bound < r.slope_bound, "{rule:?}: {r:?}");
        }
        // No bounds where the scheme is not C¹ (tension 0 is piecewise linear), or only hardly.
        let long = parse_rational(&format!("1/{}", "7".repeat(60))).unwrap();
        for w in [ratio(0, 1), ratio(1, 2), ratio(-1, 16), Rational::from(1_u64 << 62), long] {
            assert!(Regular::of(&butterfly(w)).is_none());
        }
    }

    /// The nets of the parts after one step.
    fn refined(r: &Regular, net: &[i128]) -> Vec<Vec<i128>> {
        let row = |row: &Vec<(usize, i128)>| row.iter().map(|(i, w)| net[*i] * w).sum::<i128>() / r.denominator;
        r.steps.iter().map(|step| step.iter().map(row).collect()).collect()
    }

    /// Random nets, refined five times: the linear fits of all parts, and their slopes, stay within the bounds.
    #[test]
    fn nets_stay_within_the_bounds() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i128::from(seed >> 44) << 40
        };
        let others = [butterfly(ratio(1, 100)), butterfly(ratio(1, 10))];
        for rule in rules().into_iter().chain(others) {
            let r = Regular::of(&rule).unwrap();
            let (slope_scale, value_scale) = r.scales();
            let depth = if r.factor == 3 { 3 } else { 5 };
            let mut closest = 0;
            for _ in 0..20 {
                let net: Vec<i128> = r.points.iter().map(|_| random()).collect();
                let rough = r.roughness(&net);
                let (slopes, fit) = (r.slopes(&net), r.fit(&net));
                let mut level = vec![(net, ((0, 0), 1))];
                let mut size = 1;
                for _ in 0..depth {
                    size *= r.factor;
                    let mut next = Vec::new();
                    for (values, (corner, sign)) in &level {
                        for (part, finer) in r.parts.iter().zip(refined(&r, values)) {
                            let at = place(&((r.factor * corner.0, r.factor * corner.1), *sign), part.0);
                            next.push((finer, (at, sign * part.1)));
                        }
                    }
                    level = next;
                }
                for (values, cell) in &level {
                    for (own, whole) in r.slopes(values).iter().zip(&slopes) {
                        let off = (i128::from(cell.1 * size) * own - whole).abs() / slope_scale;
                        assert!(off <= (r.slope_bound * rough) >> BOUND_PLACES, "{rule:?}");
                        closest = closest.max((off << BOUND_PLACES) / rough);
                    }
                    for (value, c) in r.fit(values).iter().zip(r.corners()) {
                        let p = place(cell, *c);
                        let ratio = value_scale / slope_scale;
                        let linear = i128::from(p.0) * slopes[0] + i128::from(p.1) * slopes[1];
                        let off = (value - fit[0] - linear * ratio / i128::from(size)).abs() / value_scale;
                        assert!(off <= ((r.value_bound * rough) >> BOUND_PLACES) + 1, "{rule:?}");
                    }
                }
            }
            assert!(64 * closest > r.slope_bound, "{rule:?}: the bound is idle");
            assert!(!rules().contains(&rule) || 8 * closest > r.slope_bound, "{rule:?}: the bound is far off");
        }
    }

    /// Lemma 4′: the bounds by factors, the first of them computed outside as well, and random nets, whose differences shrink no slower.
    #[test]
    fn differences_shrink_as_the_factors_say() {
        let of = |rule: &MeshRule| {
            let (triangles, _, mask) = mask(rule).unwrap();
            let r = Regular::of(rule).unwrap();
            (shrinking(&mask, &pairs(triangles), &r.points, &r.parts), r)
        };
        // Products of the divided mask, multiplied out in floating point by a script.
        let (bounds, _) = of(&butterfly(ratio(1, 16)));
        let first = [(1, 1), (1, 1), (7, 8), (11, 16), (1, 2), (11, 32)].map(|(p, q)| ratio(p, q));
        assert_eq!(bounds.unwrap()[..6], first);
        assert!(of(&rule("sqrt3", &[])).0.is_none());
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i128::from((state >> 44) as u32) << 24
        };
        for rule in
            [butterfly(ratio(1, 16)), butterfly(ratio(1, 100)), butterfly(ratio(1, 10)), rule("four-eight", &[])]
        {
            let (bounds, r) = of(&rule);
            let bounds = bounds.unwrap();
            for _ in 0..10 {
                let net: Vec<i128> = r.points.iter().map(|_| random()).collect();
                let rough = Rational::from(Integer::from(r.roughness(&net)));
                let mut level = vec![net];
                for (steps, bound) in bounds.iter().enumerate().take(5) {
                    let size = Rational::from(Integer::from(1 << steps));
                    for net in &level {
                        let now = Rational::from(Integer::from(r.roughness(net))) * &size;
                        assert!(now <= bound * &rough + ratio(1 << 12, 1), "{rule:?} after {steps} steps");
                    }
                    level = level.iter().flat_map(|net| refined(&r, net)).collect();
                }
            }
        }
    }

    /// Different nets give different limits on a cell, but for nets that one step makes 0 (docs/theory.md §10.1).
    #[test]
    fn limits_tell_nets_apart() {
        for (rule, rank) in rules().into_iter().zip([27, 27, 28]) {
            let r = Regular::of(&rule).unwrap();
            let steps: Vec<Matrix> = (0..r.parts.len()).map(|s| matrix(&r, s)).collect();
            // The first part has the corner (0,0) of the cell; its limit functional is the left eigenvector for 1.
            let size = r.points.len();
            let fixed = (&steps[0] - &Matrix::identity(size)).transpose().kernel();
            assert_eq!(fixed.cols(), 1);
            let mut span = fixed.transpose();
            loop {
                let all = steps.iter().fold(span.clone(), |all, t| all.stack(&(&span * t)));
                let reduced = all.echelon();
                let count = reduced.rows.rows();
                if count == span.rows() {
                    break;
                }
                span = reduced.rows;
            }
            assert_eq!(span.rows(), rank, "{rule:?}");
            let null = span.kernel();
            assert!(steps.iter().all(|t| (t * &null).is_zero()));
            for cell in ring_cells(&r) {
                let distance = |p: &Place| {
                    let (i, j) = place(&cell, *p);
                    if r.triangles { i.abs().max(j.abs()).max((i + j).abs()) } else { i.abs().max(j.abs()) }
                };
                assert!(r.points.iter().all(|p| distance(p) >= 1));
                let far: Vec<usize> = (0..size).filter(|i| distance(&r.points[*i]) >= 4).collect();
                let part = Matrix::from_fn(far.len(), null.cols(), |i, j| null[(far[i], j)].clone());
                assert_eq!(part.rank(), null.cols());
            }
        }
    }

    /// The stencils of points far from the centre are the same for all weights there.
    #[test]
    fn far_stencils_do_not_know_the_centre() {
        let sets = [
            (rule("sqrt3-variant", &[("alpha", ratio(0, 1))]), rule("sqrt3-variant", &[("alpha", ratio(1, 1))])),
            (butterfly(ratio(1, 16)), rule("butterfly", &[])),
        ];
        for n in [3, 4] {
            for (a, b) in &sets {
                let (a, b) = (sector_stencils(a, n, 6).unwrap(), sector_stencils(b, n, 6).unwrap());
                let mut seen = 0;
                for (k, (i, j)) in a.places.iter().enumerate().filter(|(_, (i, j))| i + j >= 4) {
                    assert_eq!(
                        (&a.rows[k], &a.from_centre[k]),
                        (&b.rows[k], &b.from_centre[k]),
                        "valence {n}, ({i}, {j})"
                    );
                    seen += 1;
                }
                assert!(seen > 10);
            }
        }
    }
}
