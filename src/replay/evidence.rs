//! The numbers from which Coq computes the hypotheses of a theorem at a branch: a chart of the germ, eigenvectors and
//! functionals in it, a power that shrinks their complement, and a bound of the functional on the ring.

use super::field::{Field, Pair, Pairs};
use crate::algebraic::{Elem, Root};
use crate::arith::{Rational, abs, sign};
use crate::linalg::{Matrix, dot};
use crate::poly::Poly;
use crate::shape::{Shape, Spaces, difference, oscillation};
use crate::theorem::{BranchReport, Outcome, Quotient};

/// Balls of the 1-norm that hold the attractors, by state.
pub(super) struct Balls {
    pub centre: Vec<Vec<Rational>>,
    pub radius: Vec<Rational>,
}

/// Coordinates of a germ, one turn in them, and what is seen of them.
pub(super) struct Chart {
    pub coordinates: Matrix,
    pub turn: Matrix,
    pub seen: Matrix,
}

impl Chart {
    /// What is seen through `view` of the space with this basis and these coordinates.
    pub fn new(basis: &Matrix, coordinates: &Matrix, operator: &Matrix, view: &Matrix) -> Self {
        let on_space = view * basis;
        let linear = coordinates * &(operator * basis);
        let quotient = Quotient::new(&on_space, &linear);
        Self {
            coordinates: &quotient.chart * coordinates,
            turn: &(&quotient.chart * &linear) * &quotient.lift,
            seen: &on_space * &quotient.lift,
        }
    }
}

/// The top of the spectrum: a functional with its vector, and for a block of length 2 the pair that completes the chain.
pub(super) struct Top {
    pub value: Pair,
    pub row: Pairs,
    pub vector: Pairs,
    /// The functional and the vector of the other end of the chain, where all numbers are rational.
    pub chain: Option<(Vec<Rational>, Vec<Rational>)>,
}

/// Where the functional lies on the ring, against its value at the point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Above it.
    Above,
    /// Above or below it.
    Apart,
    /// Above it after the point, below it before the point.
    Sides,
}

/// What a replay hands over for a branch; see `proofs/theories/Replay.v`, and `Quadratic.v` where numbers are irrational.
pub(super) struct Evidence {
    pub field: Field,
    pub point: Vec<Rational>,
    pub chart: Chart,
    pub top: Top,
    pub power: usize,
    pub rate: Rational,
    pub low: Rational,
    pub depth: usize,
    pub exit: Vec<usize>,
    pub scale: Pair,
}

/// The largest power of an operator that is tried, and the most cells of a ring.
pub(super) const MAX_POWER: usize = 64;
const MAX_CELLS: usize = 4000;
const MAX_DEPTH: usize = 60;

/// Digits of a number in a chart, so that Coq takes less than a minute.
const MAX_DIGITS: usize = 200;

const SLOW: &str = "an eigenvalue that dominates too slowly";
/// More places of the root may decide it.
const DIGITS: &str = "irrational numbers that lie too close to each other";

/// Shapes, balls and spaces: what all branches share.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    pub shape: &'a Shape,
    pub balls: &'a Balls,
    pub spaces: &'a Spaces,
}

/// The evidence for a branch whose secants tend to multiples of `direction`, or what is missing.
pub(super) fn of(
    given: Given<'_>,
    branch: &BranchReport,
    field: &Field,
    direction: &Pairs,
    mode: Mode,
) -> Result<Evidence, String> {
    let (chart, mut top) = leading(given, branch, field, &branch.transport)?;
    let along = |top: &Top| field.quotient(&top.vector.under(&chart.seen), direction);
    let missing = "an eigenvector that is not on the tangent line";
    if mode != Mode::Apart && field.sign(&along(&top).ok_or(missing)?).ok_or(DIGITS)? < 0 {
        top.turn();
    }
    let scale = along(&top).ok_or(missing)?;
    finished(given, branch, field, (chart, top, scale), mode)
}

/// The same in the space of a state from which `transport` leads to the cycle, with the ray of a positive eigenvalue there.
pub(super) fn in_its_state(
    given: Given<'_>,
    branch: &BranchReport,
    field: &Field,
    transport: &Matrix,
) -> Result<(Evidence, Pairs), String> {
    let (chart, mut top) = leading(given, branch, field, transport)?;
    let exit = exit(given.shape, branch).ok_or("a cycle that nothing leaves")?;
    let (inside, end) = given.shape.product(branch.state, &exit);
    let functional = chart.coordinates.apply_left(&field.mid(&top.row));
    let sample = dot(&functional, &inside.apply(&given.balls.centre[end])) - dot(&functional, &branch.fixed);
    if sign(&sample) < 0 {
        top.turn();
    }
    let seen = top.vector.under(&chart.seen);
    let (direction, scale) = field.reduced(&seen).ok_or("an eigenvector that an operator kills")?;
    if field.sign(&top.value).ok_or(DIGITS)? < 0 {
        return Err("a negative eigenvalue".to_owned());
    }
    Ok((finished(given, branch, field, (chart, top, scale), Mode::Above)?, direction))
}

/// The dominant eigenvalue of a branch with a tangent line.
pub(super) fn eigenvalue(branch: &BranchReport) -> Option<&Root> {
    let Outcome::Line { eigenvalue, .. } = &branch.outcome else { return None };
    Some(&branch.spectrum.factors[eigenvalue.0].roots[eigenvalue.1])
}

/// The chart of a branch that is seen through `transport`, and the top of the spectrum in it.
fn leading(given: Given<'_>, branch: &BranchReport, field: &Field, transport: &Matrix) -> Result<(Chart, Top), String> {
    let (Some(root), Outcome::Line { block, .. }) = (eigenvalue(branch), &branch.outcome) else {
        return Err("a branch without a tangent line".to_owned());
    };
    let generator = Elem::generator(root.minpoly());
    let value = field.pair(&generator, root).ok_or("an eigenvalue of another field")?;
    let space = given.spaces.of(branch.state);
    let chart = Chart::new(&space.basis, &space.coordinates, &branch.cycle_operator, transport);
    let top = match block {
        1 => simple(&chart.turn, field, root.minpoly(), value),
        2 if field.is_rational() => chain(&chart.turn, value),
        2 => Err("a Jordan block and irrational numbers".to_owned()),
        _ => Err(format!("a Jordan block of length {block}")),
    }?;
    Ok((chart, top))
}

fn finished(
    given: Given<'_>,
    branch: &BranchReport,
    field: &Field,
    (chart, top, scale): (Chart, Top, Pair),
    mode: Mode,
) -> Result<Evidence, String> {
    let exit = exit(given.shape, branch).ok_or("a cycle that nothing leaves")?;
    let digits = chart.turn.entries().iter().map(|x| x.to_string().len()).max();
    if digits.is_some_and(|n| n > MAX_DIGITS) {
        return Err("numbers with too many digits".to_owned());
    }
    let (chart, top, (power, rate)) = match gap(&chart.turn, field, &top) {
        Some(found) => (chart, top, found),
        None => {
            let (chart, top) = apart(&chart, &top).ok_or(SLOW)?;
            let found = gap(&chart.turn, field, &top).ok_or(SLOW)?;
            (chart, top, found)
        }
    };
    let functional = chart.coordinates.apply_left(&field.mid(&top.row));
    let (low, depth) = ring(given, branch, &functional, mode).ok_or("a ring condition that takes too many cells")?;
    // The functional itself lies so near to the rational one.
    let rooted = chart.coordinates.apply_left(&top.row.rooted);
    let offset = difference(&given.balls.centre[branch.state], &branch.fixed);
    let reach = offset.iter().fold(given.balls.radius[branch.state].clone(), |s, x| s + abs(x));
    if field.spread() * (oscillation(&rooted) / Rational::from(2)) * reach >= low {
        return Err(DIGITS.to_owned());
    }
    Ok(Evidence { field: field.clone(), point: branch.fixed.clone(), chart, top, power, rate, low, depth, exit, scale })
}

impl Top {
    /// The opposite functionals and vectors.
    fn turn(&mut self) {
        self.row = self.row.negated();
        self.vector = self.vector.negated();
        if let Some((row, vector)) = &mut self.chain {
            row.iter_mut().chain(vector).for_each(|x| *x = -&*x);
        }
    }
}

/// The operator minus the number.
pub(super) fn shifted(operator: &Matrix, value: &Rational) -> Matrix {
    Matrix::from_fn(operator.rows(), operator.cols(), |i, j| {
        if i == j { &operator[(i, j)] - value } else { operator[(i, j)].clone() }
    })
}

fn scaled(v: &[Rational], factor: &Rational) -> Vec<Rational> {
    v.iter().map(|x| x * factor).collect()
}

/// A simple eigenvalue of degree 1 or 2 with its minimal polynomial.
fn simple(operator: &Matrix, field: &Field, minpoly: &Poly, value: Pair) -> Result<Top, String> {
    let several = || "an eigenvalue that is not simple".to_owned();
    let degree = minpoly.coeffs().len() - 1;
    let annihilated = match degree {
        1 => shifted(operator, &value.plain),
        // `L² + bL + c`.
        _ => {
            let sum = operator * &shifted(operator, &-minpoly.coeff(1));
            shifted(&sum, &-minpoly.coeff(0))
        }
    };
    let (right, left) = (annihilated.kernel(), annihilated.transpose().kernel());
    if right.cols() != degree || left.cols() != degree {
        return Err(several());
    }
    // `(L − λ')w = Lw + (b + λ)w` with the other root `λ' = −b − λ`.
    let top = |w: Vec<Rational>, image: Vec<Rational>| match degree {
        1 => Pairs::rational(w),
        _ => {
            let sum = minpoly.coeff(1) + &value.plain;
            Pairs {
                plain: image.iter().zip(&w).map(|(x, y)| x + &sum * y).collect(),
                rooted: scaled(&w, &value.rooted),
            }
        }
    };
    let (w, u) = (right.column(0), left.column(0));
    let (image, row_image) = (operator.apply(&w), operator.apply_left(&u));
    let (vector, row) = (top(w, image), top(u, row_image));
    let unit = field.inverse(&field.dot(&row, &vector)).ok_or_else(several)?;
    Ok(Top { row: field.scaled(&row, &unit), value, vector, chain: None })
}

/// A block of length 2: `L y2 = λ y2 + y1`, with the functionals dual to the two vectors.
fn chain(operator: &Matrix, value: Pair) -> Result<Top, String> {
    let l = shifted(operator, &value.plain);
    let square = &l * &l;
    let (right, left) = (square.kernel(), square.transpose().kernel());
    let several = || "more than one Jordan block of the dominant eigenvalue".to_owned();
    if right.cols() != 2 || left.cols() != 2 {
        return Err(several());
    }
    let nonzero = |v: &Vec<Rational>| v.iter().any(|x| *x != 0);
    let y2 = (0..2).map(|j| right.column(j)).find(|y| nonzero(&l.apply(y))).ok_or_else(several)?;
    let g1 = (0..2).map(|j| left.column(j)).find(|g| nonzero(&l.apply_left(g))).ok_or_else(several)?;
    let (y1, g2) = (l.apply(&y2), l.apply_left(&g1));
    let product = dot(&g2, &y2);
    if product == 0 {
        return Err(several());
    }
    let unit = Rational::from(1) / product;
    let (g1, g2) = (scaled(&g1, &unit), scaled(&g2, &unit));
    let off = dot(&g1, &y2);
    let g1: Vec<Rational> = g1.iter().zip(&g2).map(|(a, b)| a - &off * b).collect();
    Ok(Top { value, row: Pairs::rational(g2), vector: Pairs::rational(y1), chain: Some((g1, y2)) })
}

/// Coordinates in which the top and its complement do not mix, so that the units of one do not hide the rate of the other.
fn apart(chart: &Chart, top: &Top) -> Option<(Chart, Top)> {
    let n = chart.turn.rows();
    let nonzero = |v: &&Vec<Rational>| v.iter().any(|x| *x != 0);
    let parts = |x: &Pairs, other: Option<&Vec<Rational>>| {
        let parts = [Some(&x.plain), Some(&x.rooted), other];
        Matrix::from_rows(n, parts.into_iter().flatten().filter(nonzero).cloned().collect())
    };
    let chain = top.chain.as_ref();
    let vectors = parts(&top.vector, chain.map(|c| &c.1));
    let new = parts(&top.row, chain.map(|c| &c.0)).stack(&vectors.kernel().transpose());
    let old = new.inverse()?;
    let turned = |(row, vector): &(Vec<Rational>, Vec<Rational>)| (old.apply_left(row), new.apply(vector));
    let top = Top {
        value: top.value.clone(),
        row: top.row.before(&old),
        vector: top.vector.under(&new),
        chain: top.chain.as_ref().map(turned),
    };
    let turn = &(&new * &chart.turn) * &old;
    Some((Chart { coordinates: &new * &chart.coordinates, turn, seen: &chart.seen * &old }, top))
}

/// A power whose norm, after the top has been taken off, is below that power of the eigenvalue.
fn gap(operator: &Matrix, field: &Field, top: &Top) -> Option<(usize, Rational)> {
    let modulus = field.modulus(&top.value);
    let (middle, spread) = (field.middle(), field.spread());
    let mut power = Matrix::identity(operator.rows());
    let mut bound = Rational::from(1);
    (1..=MAX_POWER).find_map(|k| {
        power = operator * &power;
        bound *= &modulus;
        let image = top.vector.under(&power);
        let other = top.chain.as_ref().map(|(row, vector)| (row, power.apply(vector)));
        // `x v_i g_j`, as a rational and a multiple of the root. The functional of the other end of a chain belongs to the
        // eigenvector, that of the ring to the vector above it.
        let taken = |i: usize, j: usize| match &other {
            Some((row, upper)) => {
                Pair { plain: &image.plain[i] * &row[j] + &upper[i] * &top.row.plain[j], rooted: Rational::from(0) }
            }
            None => field.times(&image.entry(i), &top.row.entry(j)),
        };
        let n = operator.rows();
        let rooted = Matrix::from_fn(n, n, |i, j| -taken(i, j).rooted);
        let mixed = Matrix::from_fn(n, n, |i, j| &power[(i, j)] - taken(i, j).plain + &middle * &rooted[(i, j)]);
        let norm = column(&mixed) + &spread * column(&rooted);
        (norm < bound).then_some((k, norm))
    })
}

/// The largest sum of absolute values in a column.
pub(super) fn column(m: &Matrix) -> Rational {
    let sums = (0..m.cols()).map(|j| (0..m.rows()).fold(Rational::from(0), |s, i| s + abs(&m[(i, j)])));
    sums.fold(Rational::from(0), Rational::max)
}

/// A word as long as the cycle that leaves it.
fn exit(shape: &Shape, branch: &BranchReport) -> Option<Vec<usize>> {
    let mut state = branch.state;
    let mut word = Vec::new();
    for letter in &branch.address.cycle {
        let left = !word.iter().eq(branch.address.cycle.iter().take(word.len()));
        let other = (0..shape.states[state].pieces.len()).find(|i| left || i != letter);
        let next = other.unwrap_or(*letter);
        word.push(next);
        state = shape.states[state].pieces[next].target;
    }
    (word != branch.address.cycle).then_some(word)
}

/// A positive bound, a power of 1/2, of the functional on the ring against its value at the point, and the length of the
/// longest word that shows it.
fn ring(given: Given<'_>, branch: &BranchReport, functional: &[Rational], mode: Mode) -> Option<(Rational, usize)> {
    /// The side of a cell that has left the cycle of a point with two sides: after it or before it.
    type Side = Option<bool>;
    let Given { shape, balls, .. } = given;
    let floor = dot(functional, &branch.fixed);
    let cycle = &branch.address.cycle[..];
    let mut open: Vec<(usize, Vec<Rational>, Option<&[usize]>, Side, usize)> =
        vec![(branch.state, functional.to_vec(), Some(cycle), None, 0)];
    let (mut least, mut depth, mut cells): (Option<Rational>, usize, usize) = (None, 0, 0);
    while let Some((state, h, rest, side, length)) = open.pop() {
        if rest == Some(&[]) {
            continue;
        }
        cells += 1;
        let width = oscillation(&h) / Rational::from(2) * &balls.radius[state];
        let middle = dot(&h, &balls.centre[state]) - &floor;
        let bound = match (mode, side) {
            (Mode::Above, _) | (Mode::Sides, Some(true)) => middle - width,
            (Mode::Sides, Some(false)) => -middle - width,
            (Mode::Apart, _) => abs(&middle) - width,
            (Mode::Sides, None) => Rational::from(0),
        };
        if bound > 0 {
            least = Some(least.map_or_else(|| bound.clone(), |l| l.min(bound.clone())));
            depth = depth.max(length);
            continue;
        }
        if cells > MAX_CELLS || length >= MAX_DEPTH {
            return None;
        }
        for (i, piece) in shape.states[state].pieces.iter().enumerate() {
            let next = rest.and_then(|r| (r[0] == i).then(|| &r[1..]));
            let left = rest.filter(|r| r[0] != i).map(|r| i > r[0]);
            open.push((piece.target, piece.op.apply_left(&h), next, side.or(left), length + 1));
        }
    }
    let least = least?;
    let mut low = Rational::from(1);
    while low > least {
        low /= Rational::from(2);
    }
    // Words that are cut off by the cycle are longer than those of cells.
    Some((low, depth.max(cycle.len())))
}

/// Two coordinates in which the vectors are independent.
pub(super) fn independent(a: &[Rational], b: &[Rational]) -> Option<(usize, usize)> {
    let mut pairs = (0..a.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    pairs.find(|(i, j)| &a[*i] * &b[*j] != &a[*j] * &b[*i])
}
