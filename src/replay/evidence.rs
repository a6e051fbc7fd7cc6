//! The numbers from which Coq computes the hypotheses of a theorem at a branch: eigenvectors and functionals on the vectors
//! of sum 0, a power that shrinks their complement, and a lower bound of the functional on the ring.

use super::curve::reduced;
use crate::arith::{Rational, abs, sign};
use crate::linalg::{Matrix, dot};
use crate::shape::{Shape, dobrushin, oscillation};
use crate::theorem::{BranchReport, Outcome};

/// Balls of the 1-norm that hold the attractors, by state.
pub(super) struct Balls {
    pub centre: Vec<Vec<Rational>>,
    pub radius: Vec<Rational>,
}

/// The top of the spectrum: a functional with its vector, and for a block of length 2 the pair that completes the chain.
pub(super) struct Top {
    pub value: Rational,
    pub row: Vec<Rational>,
    pub vector: Vec<Rational>,
    /// The functional and the vector of the other end of the chain.
    pub chain: Option<(Vec<Rational>, Vec<Rational>)>,
}

/// What a replay hands over for a branch; see `proofs/theories/Replay.v`.
pub(super) struct Evidence {
    pub point: Vec<Rational>,
    pub top: Top,
    pub power: usize,
    pub rate: Rational,
    pub low: Rational,
    pub depth: usize,
    pub exit: Vec<usize>,
    pub scale: Rational,
}

/// The largest power of an operator that is tried, and the most cells of a ring.
pub(super) const MAX_POWER: usize = 48;
const MAX_CELLS: usize = 4000;
const MAX_DEPTH: usize = 40;

/// The evidence for a branch whose secants tend to multiples of `direction`, or what is missing.
pub(super) fn of(
    shape: &Shape,
    balls: &Balls,
    branch: &BranchReport,
    direction: &[Rational],
) -> Result<Evidence, String> {
    let mut evidence = without_scale(shape, balls, branch)?;
    evidence.scale = quotient(&branch.transport.apply(&evidence.top.vector), direction)
        .ok_or("an eigenvector that is not on the tangent line")?;
    Ok(evidence)
}

/// The same in the space of a state from which `transport` leads to the cycle, with the ray of a positive eigenvalue there.
pub(super) fn in_its_state(
    shape: &Shape,
    balls: &Balls,
    branch: &BranchReport,
    transport: &Matrix,
) -> Result<(Evidence, Vec<Rational>), String> {
    let mut evidence = without_scale(shape, balls, branch)?;
    let (direction, scale) =
        reduced(&transport.apply(&evidence.top.vector)).ok_or("an eigenvector that an operator kills")?;
    if sign(&evidence.top.value) < 0 {
        return Err("a negative eigenvalue".to_owned());
    }
    evidence.scale = scale;
    Ok((evidence, direction))
}

fn without_scale(shape: &Shape, balls: &Balls, branch: &BranchReport) -> Result<Evidence, String> {
    let Outcome::Line { eigenvalue, block, .. } = &branch.outcome else {
        return Err("a branch without a tangent line".to_owned());
    };
    let root = &branch.spectrum.factors[eigenvalue.0].roots[eigenvalue.1];
    let [constant, leading] = root.minpoly().coeffs() else {
        return Err("an irrational eigenvalue".to_owned());
    };
    let value = -(constant / leading);
    let operator = &branch.cycle_operator;
    let mut top = match block {
        1 => simple(operator, value),
        2 => chain(operator, value),
        _ => Err(format!("a Jordan block of length {block}")),
    }?;
    let exit = exit(shape, branch).ok_or("a cycle that nothing leaves")?;
    let (inside, end) = shape.product(branch.state, &exit);
    let sample = dot(&top.row, &inside.apply(&balls.centre[end])) - dot(&top.row, &branch.fixed);
    if sign(&sample) < 0 {
        top.turn();
    }
    let (power, rate) = gap(operator, &top)?;
    let (low, depth) = ring(shape, balls, branch, &top.row).ok_or("a ring condition that takes too many cells")?;
    Ok(Evidence { point: branch.fixed.clone(), top, power, rate, low, depth, exit, scale: Rational::from(1) })
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

/// The operator on vectors of sum 0 in the coordinates 1, 2, …, minus the number.
pub(super) fn shifted(operator: &Matrix, value: &Rational) -> Matrix {
    let n = operator.rows() - 1;
    Matrix::from_fn(n, n, |i, j| {
        let entry = &operator[(i + 1, j + 1)] - &operator[(i + 1, 0)];
        if i == j { entry - value } else { entry }
    })
}

pub(super) fn vector(y: &[Rational]) -> Vec<Rational> {
    let first = y.iter().fold(Rational::from(0), |sum, x| sum - x);
    std::iter::once(first).chain(y.iter().cloned()).collect()
}

fn row(y: &[Rational]) -> Vec<Rational> {
    std::iter::once(Rational::from(0)).chain(y.iter().cloned()).collect()
}

fn scaled(v: &[Rational], factor: &Rational) -> Vec<Rational> {
    v.iter().map(|x| x * factor).collect()
}

fn simple(operator: &Matrix, value: Rational) -> Result<Top, String> {
    let l = shifted(operator, &value);
    let (right, left) = (l.kernel(), l.transpose().kernel());
    let several = || "an eigenvalue that is not simple on the vectors of sum 0".to_owned();
    if right.cols() != 1 || left.cols() != 1 {
        return Err(several());
    }
    let (y, g) = (right.column(0), left.column(0));
    let product = dot(&g, &y);
    if product == 0 {
        return Err(several());
    }
    let g = scaled(&g, &(Rational::from(1) / product));
    Ok(Top { value, row: row(&g), vector: vector(&y), chain: None })
}

/// A block of length 2: `L y2 = λ y2 + y1`, with the functionals dual to the two vectors.
fn chain(operator: &Matrix, value: Rational) -> Result<Top, String> {
    let l = shifted(operator, &value);
    let square = &l * &l;
    let (right, left) = (square.kernel(), square.transpose().kernel());
    let several = || "more than one Jordan block of the dominant eigenvalue on the vectors of sum 0".to_owned();
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
    Ok(Top { value, row: row(&g2), vector: vector(&y1), chain: Some((row(&g1), vector(&y2))) })
}

/// A power whose coefficient, after the top has been taken off, is below that power of the eigenvalue.
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
        let tau = dobrushin(&rest);
        if tau < bound {
            return Ok((k, tau));
        }
    }
    Err("an eigenvalue that does not dominate on all vectors of sum 0".to_owned())
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

/// A positive lower bound, a power of 1/2, of the functional on the ring above its value at the point, and the length of the
/// longest word that shows it.
fn ring(shape: &Shape, balls: &Balls, branch: &BranchReport, functional: &[Rational]) -> Option<(Rational, usize)> {
    let floor = dot(functional, &branch.fixed);
    let mut open = vec![(branch.state, functional.to_vec(), Some(&branch.address.cycle[..]), 0)];
    let (mut least, mut depth, mut cells): (Option<Rational>, usize, usize) = (None, 0, 0);
    while let Some((state, h, rest, length)) = open.pop() {
        if rest == Some(&[]) {
            continue;
        }
        cells += 1;
        let half = oscillation(&h) / Rational::from(2);
        let bound = dot(&h, &balls.centre[state]) - half * &balls.radius[state] - &floor;
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
            open.push((piece.target, piece.op.apply_left(&h), next, length + 1));
        }
    }
    let least = least?;
    let mut low = Rational::from(1);
    while low > least {
        low /= Rational::from(2);
    }
    // Words that are cut off by the cycle are longer than those of cells.
    Some((low, depth.max(branch.address.cycle.len())))
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
