//! The evidence for a branch whose eigenvalue has degree 2: numbers `x + y √d` as pairs of rationals, with a free of squares.

use super::curve::reduced;
use super::evidence::{Chart, Given, MAX_POWER, Mode, column, exit, ring, simple};
use crate::arith::{Natural, Rational, abs, sign};
use crate::linalg::{Matrix, dot};
use crate::shape::oscillation;
use crate::theorem::{BranchReport, Outcome};

/// `x + y √d`.
pub(super) type Pair = (Rational, Rational);
/// Vectors with such coordinates.
pub(super) type Vectors = (Vec<Rational>, Vec<Rational>);

/// A whole number and an interval that holds its root.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Root {
    pub radicand: Rational,
    pub below: Rational,
    pub above: Rational,
}

/// What a replay hands over for such a branch; see `proofs/theories/Quadratic.v`.
pub(super) struct Quadratic {
    pub point: Vec<Rational>,
    pub chart: Chart,
    pub root: Root,
    pub value: Pair,
    pub row: Vectors,
    pub vector: Vectors,
    pub power: usize,
    pub rate: Rational,
    pub low: Rational,
    pub depth: usize,
    pub exit: Vec<usize>,
    pub scale: Pair,
    pub direction: Vectors,
}

/// Binary places of the interval of a root, and the largest square that is looked for in a radicand.
const PLACES: usize = 64;
const MAX_SQUARE: u64 = 2000;

impl Root {
    fn new(radicand: Rational) -> Self {
        let (mut below, mut above) = (Rational::from(0), &radicand + Rational::from(1));
        let mut width = above.clone();
        let mut bits = 0;
        while bits < PLACES || width > 1 {
            let middle = (&below + &above) / Rational::from(2);
            if &middle * &middle <= radicand {
                below = middle
            } else {
                above = middle
            }
            width = &above - &below;
            bits += 1;
        }
        Self { radicand, below, above }
    }

    fn middle(&self) -> Rational {
        (&self.below + &self.above) / Rational::from(2)
    }

    fn spread(&self) -> Rational {
        (&self.above - &self.below) / Rational::from(2)
    }

    fn times(&self, x: &Pair, y: &Pair) -> Pair {
        (&x.0 * &y.0 + &self.radicand * &x.1 * &y.1, &x.0 * &y.1 + &x.1 * &y.0)
    }

    /// The inverse of a number that is not 0.
    fn inverse(&self, x: &Pair) -> Pair {
        let norm = &x.0 * &x.0 - &self.radicand * &x.1 * &x.1;
        (&x.0 / &norm, -(&x.1 / &norm))
    }

    pub fn sign(&self, x: &Pair) -> i32 {
        let (a, b) = (sign(&x.0), sign(&x.1));
        if a * b >= 0 {
            return if a == 0 { b } else { a };
        }
        let larger = sign(&(&x.0 * &x.0 - &self.radicand * &x.1 * &x.1));
        if larger > 0 { a } else { b }
    }

    /// A number that the modulus is not below.
    fn modulus(&self, x: &Pair) -> Rational {
        abs(&(&x.0 + &self.below * &x.1)).min(abs(&(&x.0 + &self.above * &x.1)))
    }

    fn scaled(&self, v: &Vectors, by: &Pair) -> Vectors {
        v.0.iter().zip(&v.1).map(|(x, y)| self.times(&(x.clone(), y.clone()), by)).unzip()
    }

    fn dot(&self, g: &Vectors, v: &Vectors) -> Pair {
        (dot(&g.0, &v.0) + &self.radicand * dot(&g.1, &v.1), dot(&g.0, &v.1) + dot(&g.1, &v.0))
    }

    /// Two coordinates in which vectors are independent.
    pub fn independent(&self, a: &Vectors, b: &Vectors) -> Option<(usize, usize)> {
        let at = |v: &Vectors, i: usize| (v.0[i].clone(), v.1[i].clone());
        let mut pairs = (0..a.0.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        pairs.find(|(i, j)| self.times(&at(a, *i), &at(b, *j)) != self.times(&at(a, *j), &at(b, *i)))
    }

    /// The number by which one vector is a multiple of the other.
    fn quotient(&self, a: &Vectors, b: &Vectors) -> Option<Pair> {
        let lead = (0..b.0.len()).find(|i| b.0[*i] != 0 || b.1[*i] != 0)?;
        let at = |v: &Vectors| (v.0[lead].clone(), v.1[lead].clone());
        let factor = self.times(&at(a), &self.inverse(&at(b)));
        (self.sign(&factor) != 0 && self.scaled(b, &factor) == *a).then_some(factor)
    }
}

fn opposite(v: &Vectors) -> Vectors {
    let turned = |v: &[Rational]| v.iter().map(|x| -x).collect();
    (turned(&v.0), turned(&v.1))
}

/// The minimal polynomial of the branch's eigenvalue, where it has a line of a simple eigenvalue.
fn minimal(branch: &BranchReport) -> Option<&[Rational]> {
    let Outcome::Line { eigenvalue, block: 1, .. } = &branch.outcome else { return None };
    Some(branch.spectrum.factors[eigenvalue.0].roots[eigenvalue.1].minpoly().coeffs())
}

/// The root that an eigenvalue of degree 2 has in it, and the eigenvalue.
fn value(branch: &BranchReport) -> Option<(Root, Pair)> {
    let [q, p, one] = minimal(branch)? else { return None };
    let (q, p) = (q / one, p / one);
    let square = &p * &p - Rational::from(4) * &q;
    if sign(&square) <= 0 || p == 0 {
        return None;
    }
    // √(n/m) = √(n m)/m, less the squares in it.
    let (mut rest, mut root) = (square.numerator_ref() * square.denominator_ref(), Natural::from(1u32));
    for f in 2..MAX_SQUARE {
        let whole = Natural::from(f * f);
        while &rest % &whole == 0 {
            rest /= &whole;
            root *= Natural::from(f);
        }
    }
    let half = Rational::from(root) / Rational::from(square.denominator_ref()) / Rational::from(2);
    // The larger of both in modulus.
    let half = if sign(&p) < 0 { half } else { -half };
    Some((Root::new(Rational::from(rest)), (-p / Rational::from(2), half)))
}

/// The root that the eigenvalues of some branches have in common, where one of them has degree 2.
pub(super) fn common(branches: &[BranchReport]) -> Option<Root> {
    let roots: Vec<Root> = branches.iter().filter_map(|b| Some(value(b)?.0)).collect();
    let first = roots.first()?;
    roots.iter().all(|r| r == first).then(|| first.clone())
}

/// The chart with the eigenvalue, its functional and its vector, dual to each other.
fn leading(given: Given<'_>, branch: &BranchReport, root: &Root) -> Option<(Chart, Pair, Vectors, Vectors)> {
    let space = given.spaces.of(branch.state);
    let chart = Chart::new(&space.basis, &space.coordinates, &branch.cycle_operator, &branch.transport);
    let n = chart.turn.rows();
    let zero = || vec![Rational::from(0); n];
    if let [constant, leading] = minimal(branch)? {
        let value = -(constant / leading);
        let top = simple(&chart.turn, value.clone()).ok()?;
        return Some((chart, (value, Rational::from(0)), (top.row, zero()), (top.vector, zero())));
    }
    let (_, value) = value(branch)?;
    let trace = &value.0 * Rational::from(2);
    let norm = &value.0 * &value.0 - &root.radicand * &value.1 * &value.1;
    // The conjugate takes what is killed by both to the eigenvectors.
    let eigen = |turn: &Matrix| {
        let square = turn * turn;
        let both = Matrix::from_fn(n, n, |i, j| {
            let unit = if i == j { norm.clone() } else { Rational::from(0) };
            &square[(i, j)] - &trace * &turn[(i, j)] + unit
        });
        let kernel = both.kernel();
        (kernel.cols() == 2).then(|| {
            let v = kernel.column(0);
            let moved: Vec<Rational> = turn.apply(&v).iter().zip(&v).map(|(x, y)| x - &value.0 * y).collect();
            (moved, v.iter().map(|x| x * &value.1).collect::<Vec<Rational>>())
        })
    };
    let (vector, row) = (eigen(&chart.turn)?, eigen(&chart.turn.transpose())?);
    let product = root.dot(&row, &vector);
    let row = (root.sign(&product) != 0).then(|| root.scaled(&row, &root.inverse(&product)))?;
    Some((chart, value, row, vector))
}

/// A power whose norm, after the eigenvector has been taken off, is below that power of the eigenvalue.
fn gap(turn: &Matrix, root: &Root, value: &Pair, row: &Vectors, vector: &Vectors) -> Option<(usize, Rational)> {
    let (least, middle) = (root.modulus(value), root.middle());
    let mut power = Matrix::identity(turn.rows());
    let mut bound = Rational::from(1);
    for k in 1..=MAX_POWER {
        power = turn * &power;
        bound *= &least;
        let (w0, w1) = (power.apply(&vector.0), power.apply(&vector.1));
        let rooted = Matrix::from_fn(power.rows(), power.cols(), |i, j| -(&w0[i] * &row.1[j]) - &w1[i] * &row.0[j]);
        let mixed = Matrix::from_fn(power.rows(), power.cols(), |i, j| {
            let plain = &power[(i, j)] - &w0[i] * &row.0[j] - &root.radicand * &w1[i] * &row.1[j];
            plain + &middle * &rooted[(i, j)]
        });
        let rate = column(&mixed) + root.spread() * column(&rooted);
        if rate < bound {
            return Some((k, rate));
        }
    }
    None
}

/// The evidence for a branch, with the direction of its vector; `along` is a direction of which it is to be a multiple.
pub(super) fn of(
    given: Given<'_>,
    branch: &BranchReport,
    root: &Root,
    mode: Mode,
    along: Option<&Vectors>,
) -> Result<Quadratic, String> {
    let (chart, value, mut row, mut vector) =
        leading(given, branch, root).ok_or("an irrational eigenvalue that is not of degree 2 and simple")?;
    let (power, rate) =
        gap(&chart.turn, root, &value, &row, &vector).ok_or("an eigenvalue that dominates too slowly")?;
    let exit = exit(given.shape, branch).ok_or("a cycle that nothing leaves")?;
    let bound = |row: &Vectors| -> Option<(Rational, usize)> {
        let middle: Vec<Rational> = row.0.iter().zip(&row.1).map(|(x, y)| x + root.middle() * y).collect();
        let (low, depth) = ring(given, branch, &chart.coordinates.apply_left(&middle), mode)?;
        let rooted = chart.coordinates.apply_left(&row.1);
        let centre = &given.balls.centre[branch.state];
        let apart = centre.iter().zip(&branch.fixed).fold(Rational::from(0), |s, (x, y)| s + abs(&(x - y)));
        let reach = &given.balls.radius[branch.state] + apart;
        let slack = root.spread() * (oscillation(&rooted) / Rational::from(2) * reach);
        (slack < low).then_some((low, depth))
    };
    let found = bound(&row).or_else(|| {
        (row, vector) = (opposite(&row), opposite(&vector));
        bound(&row)
    });
    let (low, depth) = found.ok_or("a ring condition that takes too many cells")?;
    let image = (chart.seen.apply(&vector.0), chart.seen.apply(&vector.1));
    let (direction, scale) = match along.and_then(|d| Some((d, root.quotient(&image, d)?))) {
        Some((d, factor)) if root.sign(&factor) > 0 => (d.clone(), factor),
        Some((d, factor)) => (opposite(d), (-factor.0, -factor.1)),
        None => {
            let whole = [&image.0[..], &image.1[..]].concat();
            let (direction, factor) = reduced(&whole).ok_or("an eigenvector that the control points hide")?;
            let (x, y) = direction.split_at(image.0.len());
            ((x.to_vec(), y.to_vec()), (factor, Rational::from(0)))
        }
    };
    if mode != Mode::Apart && root.sign(&value) < 0 {
        return Err("a negative eigenvalue".to_owned());
    }
    let (point, root) = (branch.fixed.clone(), root.clone());
    Ok(Quadratic { point, chart, root, value, row, vector, power, rate, low, depth, exit, scale, direction })
}

/// Whether one direction is the opposite of the other.
pub(super) fn opposed(a: &Vectors, b: &Vectors) -> bool {
    *a == opposite(b)
}
