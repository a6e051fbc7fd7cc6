//! Critical orders and local fractional derivatives of a curve at a point (theory §8, Theorem L).

use super::characteristic::{Characteristic, characteristic};
use super::cone::Cone;
use super::ring::Position;
use super::side::ring_on;
use super::verdict::{BranchReport, Certified, Outcome, Side};
use crate::algebraic::Elem;
use crate::arith::{Integer, Interval, Rational, abs, exp, ln};
use crate::linalg::{Matrix, closures, dot};
use crate::shape::{Balls, CellKind, End, Shape, Spaces};
use malachite_base::num::arithmetic::traits::{Ceiling, Floor};

/// Largest order that is compared with an integer.
const MAX_INTEGER: i64 = 24;
/// Largest order up to which a band is computed: its powers have as many digits.
const MAX_BAND: u32 = 64;
/// Most cells on which the quotient is enclosed, on each side.
const MAX_CELLS: usize = 160;

/// What the quotient `(γ(t) − p)/|t|^h` does on one side of a point, `t` the parameter measured from it.
#[derive(Debug, Clone)]
pub struct LocalSide {
    /// Before or behind the point.
    pub side: Side,
    /// The critical order `h`.
    pub order: Interval,
    /// The same where it is an integer.
    pub integer: Option<usize>,
    /// Its limit.
    pub limit: LocalLimit,
    /// Whether the characteristic map is injective; `None` where the statement does not apply.
    pub characteristic: Option<Characteristic>,
}

/// The limit of the quotient, or why there is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LocalLimit {
    /// There is one, the local fractional derivative, in the space where the curve is looked at.
    Value(Vec<Rational>),
    /// There is none: the quotient approaches `B(t) v` with a function `B` that is not constant.
    Band {
        /// `v`.
        direction: Vec<Rational>,
        /// Encloses the infimum of `B`.
        least: Interval,
        /// Encloses its supremum.
        most: Interval,
    },
    /// There is none, and no band is computed: the eigenvalue is irrational, or the order above 64.
    None,
    /// The size of the quotient grows like `m^power` after `m` turns of the cycle.
    Diverges(usize),
}

/// A cell of the ring on one side: its curve, the functional of the branch on it, and its parameters measured from the point.
#[derive(Clone)]
struct Cell {
    state: usize,
    /// On barycentric coordinates.
    row: Vec<Rational>,
    /// The distance of its parameter `u` from the point is `from + slope u`.
    from: Rational,
    slope: Rational,
}

struct Germ<'a> {
    shape: &'a Shape,
    spaces: &'a Spaces,
    balls: &'a Balls,
    branch: &'a BranchReport,
    /// `|λ|` and the part of the parameter that one turn keeps.
    factor: Rational,
    scale: Rational,
}

/// What is needed to look at the sides of the branches of a curve.
#[derive(Debug)]
pub struct LocalContext<'a> {
    shape: &'a Shape,
    spaces: Spaces,
    balls: Balls,
    cones: &'a [Cone],
}

impl<'a> LocalContext<'a> {
    /// `None` where the shape is no curve that is proved to contract.
    #[must_use]
    pub fn new(shape: &'a Shape, found: &'a Certified) -> Option<Self> {
        if shape.states[shape.start].kind != CellKind::Edge {
            return None;
        }
        let spaces = Spaces::new(shape)?;
        let balls = Balls::of(shape, &spaces, &found.contraction)?;
        let cone = found.everywhere.as_ref().and_then(|e| e.cone.as_ref());
        let cones = cone.map_or(&[][..], |c| c.cones.as_slice());
        Some(Self { shape, spaces, balls, cones })
    }

    /// The sides of a branch with a tangent line by the ring condition on which the curve goes on; none of sets, or where the
    /// statement does not apply.
    ///
    /// # Cost
    /// Some linear algebra, and the enclosure of a functional on a few hundred cells.
    #[must_use]
    pub fn sides(&self, branch: &BranchReport) -> Vec<LocalSide> {
        sides(self, branch).into_iter().flatten().collect()
    }
}

fn sides(cx: &LocalContext<'_>, branch: &BranchReport) -> Option<Vec<LocalSide>> {
    let LocalContext { shape, spaces, balls, cones } = cx;
    let Outcome::Line { holder, proof: Some(_), block, functional, direction, .. } = &branch.outcome else {
        return None;
    };
    if shape.states[branch.state].kind != CellKind::Edge || holder.scale >= 1 {
        return None;
    }
    // On a curve an eigenvalue that is negative belongs to a cycle that exchanges the sides.
    let root = &holder.eigenvalue;
    if root.sign() != branch.cycle_sign {
        return None;
    }
    let modulus = root.modulus(80);
    let quotient = |lo: &Interval, s: &Interval| {
        let ends = [&lo.lo / &s.lo, &lo.lo / &s.hi, &lo.hi / &s.lo, &lo.hi / &s.hi];
        Some(Interval { lo: ends.iter().min()?.clone(), hi: ends.iter().max()?.clone() })
    };
    let logarithm = Interval { lo: ln(&modulus.lo)?.lo, hi: ln(&modulus.hi)?.hi };
    let order = quotient(&logarithm, &ln(&holder.scale)?)?;
    let there = |position: Position| branch.ring.iter().any(|p| p.position == position) || branch.cycle_sign < 0;
    let places = [Position::Before, Position::After].into_iter().filter(|p| there(*p));
    let rational = root.rational().zip(functional.iter().map(Elem::is_rational).collect::<Option<Vec<_>>>());
    let rational = rational.zip(direction.rational());
    let mut found = Vec::new();
    for place in places {
        let side = if (place == Position::Before) == (branch.prefix_sign > 0) { Side::Left } else { Side::Right };
        let map = characteristic(shape, cones, branch, place);
        let one =
            |integer, limit| LocalSide { side, order: order.clone(), integer, limit, characteristic: map.clone() };
        let Some(((value, row), seen)) = rational.clone().filter(|_| *block == 1) else {
            let limit = if *block > 1 { LocalLimit::Diverges(block - 1) } else { LocalLimit::None };
            let whole = root.rational().and_then(|x| integer(&abs(&x), &holder.scale, &order));
            found.push(one(whole.flatten(), limit));
            continue;
        };
        let germ = Germ { shape, spaces, balls, branch, factor: abs(&value), scale: holder.scale.clone() };
        let cells = germ.cells(place, &germ.scaled(&row, &value, &seen)?)?;
        // Where it is not known whether the function is constant, nothing is said.
        let Some(whole) = integer(&germ.factor, &germ.scale, &order) else { continue };
        let constant = match whole {
            Some(h) => germ.constant(&cells, h),
            None => Some(None),
        };
        let Some(constant) = constant else { continue };
        let limit = match constant {
            Some(c) => LocalLimit::Value(seen.iter().map(|x| x * &c).collect()),
            None if order.hi > MAX_BAND => LocalLimit::None,
            None => {
                let (least, most) = germ.band(cells, &order)?;
                // The direction in which the quotient points.
                if most.hi < 0 {
                    let direction = seen.iter().map(|x| -x).collect();
                    LocalLimit::Band { direction, least: -&most, most: -&least }
                } else {
                    LocalLimit::Band { direction: seen, least, most }
                }
            }
        };
        found.push(one(whole, limit));
    }
    Some(found)
}

/// The integer `h` with `factor = scale^h`, or that there is none; `None` where it is not looked for. `order` encloses `h`.
fn integer(factor: &Rational, scale: &Rational, order: &Interval) -> Option<Option<usize>> {
    let (least, most): (Integer, Integer) = ((&order.lo).ceiling(), (&order.hi).floor());
    if least > most {
        return Some(None);
    }
    if least != most || most > MAX_INTEGER {
        return None;
    }
    let h = usize::try_from(&most).ok()?;
    Some((power(scale, h) == *factor).then_some(h))
}

impl Germ<'_> {
    /// The functional that is 1 on the eigenvector that is seen as the given direction.
    fn scaled(&self, row: &[Rational], value: &Rational, seen: &[Rational]) -> Option<Vec<Rational>> {
        let linear = &self.branch.linear;
        let kernel = (linear - &Matrix::identity(linear.rows()).scale(value)).kernel();
        let vector = (kernel.cols() == 1).then(|| kernel.column(0))?;
        let image = self.branch.view.apply(&vector);
        let (a, b) = image.iter().zip(seen).find(|(_, b)| **b != 0)?;
        // The eigenvector itself is vector · b/a.
        let size = dot(row, &vector) * b / a;
        (*a != 0 && size != 0).then(|| row.iter().map(|x| x / &size).collect())
    }

    /// The cells of the ring on one side, at their distances from the point in the curve.
    fn cells(&self, place: Position, row: &[Rational]) -> Option<Vec<Cell>> {
        let (branch, shape) = (self.branch, self.shape);
        let stretch = abs(&shape.parameter_map(shape.start, &branch.address.prefix)?.0);
        let outwards = if place == Position::Before { -stretch } else { stretch };
        let on_state = branch.chart.transpose().apply(row);
        let at_point = dot(&on_state, &branch.fixed);
        let mut cells = Vec::new();
        for own in ring_on(shape, branch, place)? {
            let (from, slope) = (own.offset * &outwards, own.slope * &outwards);
            if from.clone().min(&from + &slope) <= 0 {
                return None;
            }
            let row = own.op.transpose().apply(&on_state).into_iter().map(|x| x - &at_point).collect();
            cells.push(Cell { state: own.state, row, from, slope });
        }
        Some(cells)
    }

    fn end(&self, cell: &Cell, end: End) -> Option<(Rational, Rational)> {
        let at = if end == End::Start { cell.from.clone() } else { &cell.from + &cell.slope };
        Some((dot(&cell.row, &self.shape.end_point(cell.state, end)?), at))
    }

    /// `C`, if the functional is `C t^h` on all cells: the rows with polynomials, closed under the pieces, vanish at all starts;
    /// `None` where that cannot be computed.
    fn constant(&self, cells: &[Cell], h: usize) -> Option<Option<Rational>> {
        let shape = self.shape;
        let (value, at) = self.end(cells.first()?, End::Start)?;
        let c = value / power(&at, h);
        let mut families: Vec<Matrix> = shape.states.iter().map(|s| Matrix::zero(0, s.dim + h + 1)).collect();
        for cell in cells {
            let polynomial =
                substitution(&cell.from, &cell.slope, h).row(h).iter().map(|x| -x * &c).collect::<Vec<_>>();
            let row = [cell.row.as_slice(), &polynomial].concat();
            families[cell.state] = families[cell.state].stack(&Matrix::from_rows(row.len(), vec![row]));
        }
        let mut arrows = Vec::new();
        let edges = shape.states.iter().enumerate().filter(|(_, s)| s.kind == CellKind::Edge);
        for (e, state) in edges {
            for (letter, piece) in state.pieces.iter().enumerate() {
                let (slope, offset) = shape.parameter_map(e, &[letter])?;
                let moved = substitution(&offset, &slope, h);
                let (n, m) = (state.dim, piece.op.cols());
                let matrix = Matrix::from_fn(n + h + 1, m + h + 1, |i, j| match (i < n, j < m) {
                    (true, true) => piece.op[(i, j)].clone(),
                    (false, false) => moved[(i - n, j - m)].clone(),
                    _ => Rational::from(0),
                });
                arrows.push((e, piece.target, matrix));
            }
        }
        let closed = closures(families, &arrows);
        for (e, rows) in closed.iter().enumerate().filter(|(_, rows)| rows.rows() > 0) {
            let mut start = shape.end_point(e, End::Start)?;
            // The powers 1, t, t², … at t = 0.
            start.extend((0..=h).map(|m| Rational::from(u8::from(m == 0))));
            if rows.apply(&start).iter().any(|x| *x != 0) {
                return Some(None);
            }
        }
        Some(Some(c))
    }

    /// Encloses the infimum and the supremum of the functional divided by `t^h`: values at ends of cells from inside, cells from
    /// outside.
    fn band(&self, mut cells: Vec<Cell>, order: &Interval) -> Option<(Interval, Interval)> {
        let mut spent = 0;
        let mut inner: Option<(Interval, Interval)> = None;
        loop {
            let mut outer = Vec::new();
            for cell in &cells {
                let mut weights = Vec::new();
                for end in [End::Start, End::Finish] {
                    let (value, at) = self.end(cell, end)?;
                    let weight = inverse_power(&at, order)?;
                    let b = &Interval::point(value) * &weight;
                    inner = Some(match inner {
                        None => (b.clone(), b),
                        // The infimum is at most every upper bound, the supremum at least every lower one.
                        Some((least, most)) => {
                            (if b.hi < least.hi { b.clone() } else { least }, if b.lo > most.lo { b } else { most })
                        }
                    });
                    weights.push(weight);
                }
                // The power falls with the parameter, so that its values at the ends of the cell are the extreme ones.
                let lowest = weights.iter().map(|w| &w.lo).min()?.clone();
                let highest = weights.iter().map(|w| &w.hi).max()?.clone();
                let values = self.balls.enclose(self.spaces, cell.state, &cell.row, 64);
                outer.push(&values * &Interval::new(lowest, highest));
            }
            spent += cells.len();
            let (least, most) = inner.clone()?;
            let lowest = outer.iter().map(|b| &b.lo).min()?.clone();
            let highest = outer.iter().map(|b| &b.hi).max()?.clone();
            // Only cells that may hold the infimum or the supremum are looked at again; the others do not change them.
            let open = |b: &Interval| b.lo < least.hi || b.hi > most.lo;
            let again: Vec<Cell> = cells
                .iter()
                .zip(&outer)
                .filter(|(_, b)| open(b))
                .map(|(c, _)| self.parts(c))
                .collect::<Option<Vec<_>>>()?
                .concat();
            if spent + again.len() > MAX_CELLS || again.is_empty() {
                let lower = Interval::new(lowest.min(least.hi.clone()), least.hi);
                let upper = Interval::new(most.lo.clone(), highest.max(most.lo));
                return Some((lower, upper));
            }
            cells = again;
        }
    }

    fn parts(&self, cell: &Cell) -> Option<Vec<Cell>> {
        let part = |letter: usize| {
            let piece = &self.shape.states[cell.state].pieces[letter];
            let (slope, offset) = self.shape.parameter_map(cell.state, &[letter])?;
            let row = piece.op.transpose().apply(&cell.row);
            Some(Cell { state: piece.target, row, from: &cell.from + &cell.slope * offset, slope: &cell.slope * slope })
        };
        (0..self.shape.states[cell.state].pieces.len()).map(part).collect()
    }
}

/// `t^(−h)` for a positive `t` and the `h` of an interval.
fn inverse_power(t: &Rational, order: &Interval) -> Option<Interval> {
    Some(exp(&-&(&ln(t)? * order)))
}

fn power(x: &Rational, h: usize) -> Rational {
    (0..h).fold(Rational::from(1), |p, _| p * x)
}

/// Row `m`: the coefficients of `(from + slope t)^m`, up to degree `h`.
fn substitution(from: &Rational, slope: &Rational, h: usize) -> Matrix {
    let mut rows = vec![vec![Rational::from(0); h + 1]];
    rows[0][0] = Rational::from(1);
    for m in 1..=h {
        let before = &rows[m - 1];
        let entry = |j: usize| {
            let own = &before[j] * from;
            if j == 0 { own } else { own + &before[j - 1] * slope }
        };
        let row = (0..=h).map(entry).collect();
        rows.push(row);
    }
    Matrix::from_rows(h + 1, rows)
}
