//! Points without a tangent line. Two limit directions of one germ, each by a second point of the attractor: in the space that
//! the secants to it stay in, a rational eigenvalue dominates, after some turns of the cycle. Or one such point, in whose space
//! a complex pair dominates.

use super::evidence::{Chart, MAX_POWER, column, independent, shifted};
use crate::arith::{Rational, abs};
use crate::jordan::Spectrum;
use crate::linalg::Matrix;
use crate::shape::{Address, Shape, difference, fixed_point};
use crate::theorem::{BranchReport, krylov, primitive};

/// A limit direction, by a second point of the attractor of the branch's state.
pub(super) struct Limit {
    pub tail: Address,
    /// The point of the tail's cycle in its own cell.
    pub value: Vec<Rational>,
    /// As many turns are taken for one.
    pub turns: usize,
    /// What does not change the vectors that the secants stay in.
    pub stays: Matrix,
    pub chart: Chart,
    pub top: Projection,
    pub direction: Vec<Rational>,
    pub multiple: Rational,
}

/// The projection to the eigenvectors of the dominant eigenvalue, and a power that shrinks the rest.
pub(super) struct Projection {
    pub matrix: Matrix,
    pub eigenvalue: Rational,
    pub power: usize,
    pub rate: Rational,
}

/// A second point whose secants turn for ever.
pub(super) struct Spiral {
    pub tail: Address,
    pub value: Vec<Rational>,
    pub stays: Matrix,
    pub chart: Chart,
    /// The projection to the plane of the pair, the roots of `x² − trace x + norm`.
    pub plane: Matrix,
    pub trace: Rational,
    pub norm: Rational,
    pub power: usize,
    pub rate: Rational,
    /// Two coordinates in which a secant and the next one are independent in the plane.
    pub minor: (usize, usize),
}

/// Why there is no tangent line.
pub(super) enum Refuted {
    /// Limit directions on different lines, and two coordinates that tell them apart.
    Lines { limits: Box<[Limit; 2]>, minor: (usize, usize) },
    /// Secants that turn.
    Spiral(Box<Spiral>),
}

/// Longest prefix and cycle of the points that are tried, and how many of them.
const LETTERS: usize = 2;
const POINTS: usize = 60;
/// Turns that are taken for one: rotations by these parts of a turn, and of half a turn, become real.
const TURNS: [usize; 8] = [1, 2, 3, 4, 5, 6, 8, 12];

/// A refutation at a branch, or what is missing.
pub(super) fn of(shape: &Shape, branch: &BranchReport) -> Result<Refuted, String> {
    let operator = &branch.cycle_operator;
    let tails: Vec<_> = tails(shape, branch.state).into_iter().take(POINTS).collect();
    let mut found: Option<Limit> = None;
    for turns in TURNS {
        let several = (1..turns).fold(operator.clone(), |m, _| operator * &m);
        let seen = (1..turns).fold(branch.linear.clone(), |m, _| &branch.linear * &m);
        if turns > 1 && dominant(&seen).is_none() {
            continue;
        }
        for (tail, value, point) in &tails {
            let mut point = point.clone();
            let mut tail = tail.clone();
            for _ in 0..turns {
                let limit = limit(branch, &several, turns, (&tail, value, &point));
                point = operator.apply(&point);
                tail.prefix = branch.address.cycle.iter().chain(&tail.prefix).copied().collect();
                let Some(limit) = limit else { continue };
                match found.take() {
                    None => found = Some(limit),
                    Some(first) => match independent(&first.direction, &limit.direction) {
                        Some(minor) => return Ok(Refuted::Lines { limits: Box::new([first, limit]), minor }),
                        None => found = Some(first),
                    },
                }
            }
        }
    }
    let spiral = tails.iter().find_map(|(tail, value, point)| spiral(branch, (tail, value, point)));
    spiral.map(|s| Refuted::Spiral(Box::new(s))).ok_or_else(|| "a refutation other than by known points".to_owned())
}

/// The space that the secants to a point stay in under the operator, as what does not change it, and the chart of it.
fn space(branch: &BranchReport, operator: &Matrix, offset: &[Rational]) -> (Matrix, Chart) {
    let basis = krylov(operator, offset);
    let pivots = basis.transpose().pivots();
    let pick = Matrix::from_fn(pivots.len(), basis.rows(), |i, j| Rational::from(u8::from(pivots[i] == j)));
    (&basis * &pick, Chart::new(&basis, &pick, operator, &branch.transport))
}

/// The limit direction of the secants to one point.
fn limit(
    branch: &BranchReport,
    operator: &Matrix,
    turns: usize,
    (tail, value, point): (&Address, &[Rational], &[Rational]),
) -> Option<Limit> {
    let offset = difference(point, &branch.fixed);
    let (stays, chart) = space(branch, operator, &offset);
    let top = projection(&chart.turn)?;
    let image = chart.seen.apply(&top.matrix.apply(&chart.coordinates.apply(&offset)));
    let lead = image.iter().position(|x| *x != 0)?;
    let direction = primitive(&image);
    let multiple = &image[lead] / &direction[lead];
    Some(Limit { tail: tail.clone(), value: value.to_vec(), turns, stays, chart, top, direction, multiple })
}

/// The secants to one point, where a complex pair of eigenvalues dominates them.
fn spiral(branch: &BranchReport, (tail, value, point): (&Address, &[Rational], &[Rational])) -> Option<Spiral> {
    let offset = difference(point, &branch.fixed);
    let (stays, chart) = space(branch, &branch.cycle_operator, &offset);
    let turn = &chart.turn;
    let spectrum = Spectrum::of(turn);
    let members = &spectrum.classes.first()?.members;
    let factor = members[0].factor;
    let [norm, minus_trace, one] = spectrum.factors[factor].poly.coeffs() else { return None };
    let (norm, trace) = (norm / one, -(minus_trace / one));
    if members.iter().any(|m| m.factor != factor) || &trace * &trace >= Rational::from(4) * &norm {
        return None;
    }
    let n = turn.rows();
    let square = turn * turn;
    let annihilated = Matrix::from_fn(n, n, |i, j| {
        let unit = if i == j { norm.clone() } else { Rational::from(0) };
        &square[(i, j)] - &trace * &turn[(i, j)] + unit
    });
    let plane = onto_kernel(&annihilated)?;
    let mut rest = &Matrix::identity(n) - &plane;
    let mut bound = Rational::from(1);
    let (power, rate) = (1..=MAX_POWER).find_map(|k| {
        rest = turn * &rest;
        bound *= &norm;
        let rate = column(&rest);
        (&rate * &rate < bound).then_some((k, rate))
    })?;
    let first = plane.apply(&chart.coordinates.apply(&offset));
    let minor = independent(&chart.seen.apply(&first), &chart.seen.apply(&turn.apply(&first)))?;
    let (tail, value) = (tail.clone(), value.to_vec());
    Some(Spiral { tail, value, stays, chart, plane, trace, norm, power, rate, minor })
}

/// The projection to the kernel of an operator along its image, where these are complementary.
fn onto_kernel(operator: &Matrix) -> Option<Matrix> {
    let (right, left) = (operator.kernel(), operator.transpose().kernel());
    let pairs = &left.transpose() * &right;
    Some(&right * &(&pairs.inverse()? * &left.transpose()))
}

/// The rational eigenvalue, not 0, that is larger in modulus than all others.
fn dominant(operator: &Matrix) -> Option<Rational> {
    let spectrum = Spectrum::of(operator);
    let [only] = spectrum.classes.first()?.members[..] else { return None };
    let [constant, leading] = spectrum.root(only).minpoly().coeffs() else { return None };
    let value = -(constant / leading);
    (value != 0).then_some(value)
}

/// The projection to the eigenvectors of the dominant eigenvalue along the rest, where there are as many of them as there are
/// functionals, and no block.
fn projection(operator: &Matrix) -> Option<Projection> {
    let eigenvalue = dominant(operator)?;
    let matrix = onto_kernel(&shifted(operator, &eigenvalue))?;
    let mut power = &Matrix::identity(operator.rows()) - &matrix;
    let mut bound = Rational::from(1);
    for k in 1..=MAX_POWER {
        power = operator * &power;
        bound *= abs(&eigenvalue);
        let rate = column(&power);
        if rate < bound {
            return Some(Projection { matrix, eigenvalue, power: k, rate });
        }
    }
    None
}

/// Points with short eventually periodic addresses: the address, the point of its cycle, and the point.
fn tails(shape: &Shape, state: usize) -> Vec<(Address, Vec<Rational>, Vec<Rational>)> {
    let mut all = Vec::new();
    for prefix in words(shape, state, LETTERS) {
        let (before, end) = shape.product(state, &prefix);
        for cycle in words(shape, end, LETTERS).into_iter().filter(|w| !w.is_empty()) {
            let (operator, back) = shape.product(end, &cycle);
            if back == end
                && let Some(value) = fixed_point(&operator)
            {
                let point = before.apply(&value);
                all.push((Address { prefix: prefix.clone(), cycle }, value, point));
            }
        }
    }
    all
}

fn words(shape: &Shape, state: usize, length: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    let mut last = vec![(Vec::new(), state)];
    for _ in 0..length {
        let mut longer: Vec<(Vec<usize>, usize)> = Vec::new();
        for (word, at) in &last {
            for (letter, piece) in shape.states[*at].pieces.iter().enumerate() {
                longer.push((word.iter().copied().chain([letter]).collect(), piece.target));
            }
        }
        all.extend(longer.iter().map(|(word, _)| word.clone()));
        last = longer;
    }
    all
}
