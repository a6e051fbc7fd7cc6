//! Secants between parts of a star that do not meet: a form is positive on all of them (theory §11.1), by branch and bound.

use super::star_space::StarSpaces;
use super::stars::Part;
use crate::arith::{Integer, Rational, abs};
use crate::linalg::{Matrix, Scaled};
use crate::theorem::Context;
use malachite_base::num::arithmetic::traits::Floor;
use malachite_base::num::logic::traits::SignificantBits;

/// Most pairs of cells of one star.
const MAX_PAIRS: usize = 20_000;
/// How often a part of a star is divided at most.
const MAX_DEPTH: usize = 6;
/// Binary digits of a value of the form.
const BITS: u64 = 120;
/// Binary digits by which points of smaller cells may exceed those of larger ones.
const ROOM: u64 = 2;

/// Points of a state whose convex hull holds its attractor, as columns: those of a polytope, the unit points, or the vertices of a
/// simplex around a ball of the 1-norm.
fn hull(cx: &Context, state: usize) -> Scaled {
    let n = cx.shape.states[state].dim;
    if let Some(vertices) = cx.balls.hull(state) {
        return Scaled::of(&Matrix::from_columns(n, vertices));
    }
    if cx.balls.in_simplex() {
        return Scaled::identity(n);
    }
    // Of coordinates of sum 0 and 1-norm r none is below −r/2.
    let half = cx.balls.radius(state) / Rational::from(2);
    let base = &cx.spaces.of(state).base;
    let corner = |i: usize, j: usize| if i == j { Rational::from(n) * &half } else { Rational::from(0) };
    Scaled::of(&Matrix::from_fn(n, n, |i, j| &base[i] - &half + corner(i, j)))
}

/// A cell of a star, with points whose convex hull holds it.
struct Cell {
    state: usize,
    depth: usize,
    map: Scaled,
    children: Option<Vec<usize>>,
    /// The points times a power of two, rounded down, one after the other.
    points: Vec<i128>,
    /// What the form makes of each of them, and of each two.
    rows: Vec<i128>,
    own: Vec<i128>,
}

/// The cells of one star.
struct Cells<'a> {
    cx: &'a Context<'a>,
    dim: usize,
    form: Vec<i128>,
    /// The sum of the moduli of the entries of the form.
    sum: i128,
    /// Points are multiplied by this power of two, and are below this bound then.
    shift: i64,
    limit: i128,
    list: Vec<Cell>,
}

/// How many pairs of cells show that a form of integers is positive on the differences between any two parts of a star that do not
/// meet; `None` where they do not show it.
pub(super) fn pairs(
    cx: &Context,
    spaces: &StarSpaces,
    star: usize,
    parts: &[Part],
    states: &[usize],
    form: &Matrix,
) -> Option<usize> {
    let mut cells = Cells::new(cx, form)?;
    let map = |part: &Part| {
        let [cell, letter] = part.from;
        let op = &cx.shape.states[states[cell]].pieces[letter].op;
        Scaled::of(&spaces.cell(star, cell)).times(&Scaled::of(op))
    };
    let maps: Vec<Scaled> = parts.iter().map(map).collect();
    cells.scale(parts.iter().zip(&maps).map(|(part, map)| map.times(&hull(cx, part.state))))?;
    for (part, map) in parts.iter().zip(maps) {
        cells.add(part.state, 0, map)?;
    }
    let apart = |[a, b]: &[usize; 2]| !parts[*a].meets(&parts[*b]);
    let mut open: Vec<[usize; 2]> = (0..parts.len()).flat_map(|a| (0..a).map(move |b| [a, b])).filter(apart).collect();
    let mut done = 0;
    while let Some([a, b]) = open.pop() {
        crate::stop::check();
        done += 1;
        if cells.positive(a, b) {
            continue;
        }
        if done + open.len() > MAX_PAIRS {
            return None;
        }
        let (first, second) = (cells.children(a)?, cells.children(b)?);
        open.extend(first.iter().flat_map(|&x| second.iter().map(move |&y| [x, y])));
    }
    Some(done)
}

impl<'a> Cells<'a> {
    fn new(cx: &'a Context<'a>, form: &Matrix) -> Option<Self> {
        let whole = |x: &Rational| i128::try_from(&Integer::try_from(x.clone()).ok()?).ok();
        let entries: Vec<i128> = form.entries().iter().map(whole).collect::<Option<_>>()?;
        let sum = entries.iter().try_fold(1_i128, |sum, x| sum.checked_add(x.checked_abs()?))?;
        Some(Self { cx, dim: form.rows(), form: entries, sum, shift: 0, limit: 0, list: Vec::new() })
    }

    /// Chooses the power of two, so that the form at two points of these sizes stays below 2 to the power [`BITS`].
    fn scale(&mut self, all: impl Iterator<Item = Scaled>) -> Option<()> {
        let bits = BITS.checked_sub(u64::from(i128::BITS - self.sum.leading_zeros()))? / 2;
        let mut largest = Rational::from(1);
        for points in all {
            let most = points.reduced().entries().iter().map(abs).max();
            largest = largest.max(most?);
        }
        let size = (largest.floor() + Integer::from(1)).significant_bits();
        self.shift = i64::try_from(bits.checked_sub(size + ROOM)?).ok()?;
        self.limit = 1 << bits;
        Some(())
    }

    fn add(&mut self, state: usize, depth: usize, map: Scaled) -> Option<usize> {
        let hull = map.times(&hull(self.cx, state));
        let (entries, denominator) = (hull.entries(), Integer::from(hull.denominator()));
        let (count, dim) = (entries.cols(), self.dim);
        let mut points = Vec::with_capacity(count * dim);
        for j in 0..count {
            for i in 0..dim {
                let scaled = Rational::from_integers(&entries[(i, j)] << self.shift, denominator.clone());
                let x = i128::try_from(&scaled.floor()).ok()?;
                if x.abs() >= self.limit {
                    return None;
                }
                points.push(x);
            }
        }
        let mut rows = Vec::with_capacity(count * dim);
        for point in points.chunks(dim) {
            rows.extend(self.form.chunks(dim).map(|row| dot(row, point)));
        }
        let own = products(&rows, &points, dim);
        self.list.push(Cell { state, depth, map, children: None, points, rows, own });
        Some(self.list.len() - 1)
    }

    fn children(&mut self, cell: usize) -> Option<Vec<usize>> {
        if let Some(known) = &self.list[cell].children {
            return Some(known.clone());
        }
        let Cell { state, depth, map, .. } = &self.list[cell];
        if *depth == MAX_DEPTH {
            return None;
        }
        let (depth, pieces) = (depth + 1, &self.cx.shape.states[*state].pieces);
        let maps: Vec<_> = pieces.iter().map(|p| (p.target, map.times(&Scaled::of(&p.op)))).collect();
        let added: Vec<usize> = maps.into_iter().map(|(e, map)| self.add(e, depth, map)).collect::<Option<_>>()?;
        self.list[cell].children = Some(added.clone());
        Some(added)
    }

    /// Whether the form is positive on the differences between the hulls of two cells. With weights `λ`, `μ` of the points `a`, `b`
    /// it is `Σ λ_i λ_k μ_j μ_l (q(a_i, a_k) + q(b_j, b_l) − ½ (q(a_i, b_j) + q(a_i, b_l) + q(a_k, b_j) + q(a_k, b_l)))`.
    fn positive(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.list[a], &self.list[b]);
        let mixed = products(&a.rows, &b.points, self.dim);
        let (m, n) = (a.points.len() / self.dim, b.points.len() / self.dim);
        // Each value is wrong by at most (2 limit + 1) sum, because points are wrong by less than 1.
        let least = 8 * self.sum * (2 * self.limit + 1);
        let mut line = vec![0_i128; n];
        for i in 0..m {
            for k in 0..=i {
                let first = 2 * a.own[i * m + k] - least;
                for (j, x) in line.iter_mut().enumerate() {
                    *x = mixed[i * n + j] + mixed[k * n + j];
                }
                for (j, here) in line.iter().enumerate() {
                    let own = &b.own[j * n..=j * n + j];
                    if own.iter().zip(&line).any(|(x, y)| first - here + 2 * x - y <= 0) {
                        return false;
                    }
                }
            }
        }
        true
    }
}

fn dot(a: &[i128], b: &[i128]) -> i128 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The products of all rows with all points.
fn products(rows: &[i128], points: &[i128], dim: usize) -> Vec<i128> {
    rows.chunks(dim).flat_map(|row| points.chunks(dim).map(move |point| dot(row, point))).collect()
}
