//! The numbers from which Coq computes the hypotheses of a theorem at a branch: a chart of the germ, eigenvectors and
//! functionals in it, a power that shrinks their complement, and a bound of the functional on the ring.

use super::curve::reduced;
use crate::arith::{Rational, abs, sign};
use crate::linalg::{Matrix, dot};
use crate::shape::{Shape, Spaces, oscillation};
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
    pub value: Rational,
    pub row: Vec<Rational>,
    pub vector: Vec<Rational>,
    /// The functional and the vector of the other end of the chain.
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

/// What a replay hands over for a branch; see `proofs/theories/Replay.v`.
pub(super) struct Evidence {
    pub point: Vec<Rational>,
    pub chart: Chart,
    pub top: Top,
    pub power: usize,
    pub rate: Rational,
    pub low: Rational,
    pub depth: usize,
    pub exit: Vec<usize>,
    pub scale: Rational,
}

/// The largest power of an operator that is tried, and the most cells of a ring.
pub(super) const MAX_POWER: usize = 64;
const MAX_CELLS: usize = 4000;
const MAX_DEPTH: usize = 60;

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
    direction: &[Rational],
    mode: Mode,
) -> Result<Evidence, String> {
    let (chart, mut top) = leading(given, branch, &branch.transport)?;
    let along = |top: &Top| quotient(&chart.seen.apply(&top.vector), direction);
    let missing = "an eigenvector that is not on the tangent line";
    if mode != Mode::Apart && sign(&along(&top).ok_or(missing)?) < 0 {
        top.turn();
    }
    let scale = along(&top).ok_or(missing)?;
    finished(given, branch, chart, top, mode, scale)
}

/// The same in the space of a state from which `transport` leads to the cycle, with the ray of a positive eigenvalue there.
pub(super) fn in_its_state(
    given: Given<'_>,
    branch: &BranchReport,
    transport: &Matrix,
) -> Result<(Evidence, Vec<Rational>), String> {
    let (chart, mut top) = leading(given, branch, transport)?;
    let exit = exit(given.shape, branch).ok_or("a cycle that nothing leaves")?;
    let (inside, end) = given.shape.product(branch.state, &exit);
    let functional = chart.coordinates.apply_left(&top.row);
    let sample = dot(&functional, &inside.apply(&given.balls.centre[end])) - dot(&functional, &branch.fixed);
    if sign(&sample) < 0 {
        top.turn();
    }
    let (direction, scale) = reduced(&chart.seen.apply(&top.vector)).ok_or("an eigenvector that an operator kills")?;
    if sign(&top.value) < 0 {
        return Err("a negative eigenvalue".to_owned());
    }
    Ok((finished(given, branch, chart, top, Mode::Above, scale)?, direction))
}

/// The chart of a branch that is seen through `transport`, and the top of the spectrum in it.
fn leading(given: Given<'_>, branch: &BranchReport, transport: &Matrix) -> Result<(Chart, Top), String> {
    let Outcome::Line { eigenvalue, block, .. } = &branch.outcome else {
        return Err("a branch without a tangent line".to_owned());
    };
    let root = &branch.spectrum.factors[eigenvalue.0].roots[eigenvalue.1];
    let [constant, leading] = root.minpoly().coeffs() else {
        return Err("an irrational eigenvalue".to_owned());
    };
    let value = -(constant / leading);
    let space = given.spaces.of(branch.state);
    let chart = Chart::new(&space.basis, &space.coordinates, &branch.cycle_operator, transport);
    let top = match block {
        1 => simple(&chart.turn, value),
        2 => chain(&chart.turn, value),
        _ => Err(format!("a Jordan block of length {block}")),
    }?;
    Ok((chart, top))
}

fn finished(
    given: Given<'_>,
    branch: &BranchReport,
    chart: Chart,
    top: Top,
    mode: Mode,
    scale: Rational,
) -> Result<Evidence, String> {
    let exit = exit(given.shape, branch).ok_or("a cycle that nothing leaves")?;
    let (power, rate) = gap(&chart.turn, &top)?;
    let functional = chart.coordinates.apply_left(&top.row);
    let (low, depth) = ring(given, branch, &functional, mode).ok_or("a ring condition that takes too many cells")?;
    Ok(Evidence { point: branch.fixed.clone(), chart, top, power, rate, low, depth, exit, scale })
}

impl Top {
    /// The opposite functionals and vectors.
    fn turn(&mut self) {
        let turned = |v: &mut Vec<Rational>| v.iter_mut().for_each(|x| *x = -&*x);
        turned(&mut self.row);
        turned(&mut self.vector);
        if let Some((row, vector)) = &mut self.chain {
            turned(row);
            turned(vector);
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

fn simple(operator: &Matrix, value: Rational) -> Result<Top, String> {
    let l = shifted(operator, &value);
    let (right, left) = (l.kernel(), l.transpose().kernel());
    let several = || "an eigenvalue that is not simple".to_owned();
    if right.cols() != 1 || left.cols() != 1 {
        return Err(several());
    }
    let (y, g) = (right.column(0), left.column(0));
    let product = dot(&g, &y);
    if product == 0 {
        return Err(several());
    }
    let g = scaled(&g, &(Rational::from(1) / product));
    Ok(Top { value, row: g, vector: y, chain: None })
}

/// A block of length 2: `L y2 = λ y2 + y1`, with the functionals dual to the two vectors.
fn chain(operator: &Matrix, value: Rational) -> Result<Top, String> {
    let l = shifted(operator, &value);
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
    Ok(Top { value, row: g2, vector: y1, chain: Some((g1, y2)) })
}

/// A power whose norm, after the top has been taken off, is below that power of the eigenvalue.
fn gap(operator: &Matrix, top: &Top) -> Result<(usize, Rational), String> {
    let mut power = Matrix::identity(operator.rows());
    let mut bound = Rational::from(1);
    for k in 1..=MAX_POWER {
        power = operator * &power;
        bound *= abs(&top.value);
        let mut pairs = vec![(&top.row, power.apply(&top.vector))];
        if let Some((row, vector)) = &top.chain {
            // The functional of the other end belongs to the eigenvector, that of the ring to the vector above it.
            pairs = vec![(row, power.apply(&top.vector)), (&top.row, power.apply(vector))];
        }
        let rest = Matrix::from_fn(power.rows(), power.cols(), |i, j| {
            pairs.iter().fold(power[(i, j)].clone(), |x, (g, v)| x - &v[i] * &g[j])
        });
        let norm = column(&rest);
        if norm < bound {
            return Ok((k, norm));
        }
    }
    Err("an eigenvalue that dominates too slowly".to_owned())
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

/// The number by which one vector is a multiple of the other.
fn quotient(a: &[Rational], b: &[Rational]) -> Option<Rational> {
    let lead = b.iter().position(|x| *x != 0)?;
    let factor = &a[lead] / &b[lead];
    (factor != 0 && a.iter().zip(b).all(|(x, y)| *x == &factor * y)).then_some(factor)
}

/// Two coordinates in which the vectors are independent.
pub(super) fn independent(a: &[Rational], b: &[Rational]) -> Option<(usize, usize)> {
    let mut pairs = (0..a.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    pairs.find(|(i, j)| &a[*i] * &b[*j] != &a[*j] * &b[*i])
}
