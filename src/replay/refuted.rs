//! Two limit directions of one germ (the corollary on `U`), where a rational eigenvalue with several eigenvectors dominates.

use super::evidence::{MAX_POWER, independent, shifted, vector};
use crate::arith::{Rational, abs};
use crate::linalg::{Matrix, dot};
use crate::shape::{Address, Shape, fixed_point};
use crate::theorem::{BranchReport, primitive};

/// A limit direction, by a second point of the attractor of the branch's state.
pub(super) struct Limit {
    pub tail: Address,
    /// The point of the tail's cycle in its own cell.
    pub value: Vec<Rational>,
    pub direction: Vec<Rational>,
    pub multiple: Rational,
}

/// What both directions have in common: the vectors of sum 0, the projection to the eigenvectors, and the gap.
pub(super) struct Refuted {
    pub space: Matrix,
    pub projection: Matrix,
    pub eigenvalue: Rational,
    pub power: usize,
    pub rate: Rational,
    pub limits: [Limit; 2],
    pub minor: (usize, usize),
}

/// Longest prefix and cycle of the points that are tried.
const LETTERS: usize = 2;

/// Two independent limit directions at a branch, or what is missing.
pub(super) fn of(shape: &Shape, branch: &BranchReport) -> Result<Refuted, String> {
    let operator = &branch.cycle_operator;
    let n = operator.rows();
    let none = || "a refutation other than by two eigenvectors of a dominant rational eigenvalue".to_owned();
    let lead = branch.spectrum.classes.first().ok_or_else(none)?;
    let [only] = lead.members[..] else { return Err(none()) };
    let [constant, leading] = branch.spectrum.root(only).minpoly().coeffs() else { return Err(none()) };
    let eigenvalue = -(constant / leading);
    let projection = projection(operator, &eigenvalue).ok_or_else(none)?;
    let share = Rational::from(1) / Rational::from(n);
    let space = Matrix::from_fn(n, n, |i, j| Rational::from(u8::from(i == j)) - &share);
    let onto = &projection * &space;
    let (power, rate) = gap(operator, &(&space - &onto), &eigenvalue).ok_or_else(none)?;
    let mut found: Option<Limit> = None;
    for (tail, value, point) in tails(shape, branch.state) {
        let offset: Vec<Rational> = point.iter().zip(&branch.fixed).map(|(a, b)| a - b).collect();
        let image = branch.transport.apply(&projection.apply(&offset));
        let Some(lead) = image.iter().position(|x| *x != 0) else { continue };
        let direction = primitive(&image);
        let multiple = &image[lead] / &direction[lead];
        let limit = Limit { tail, value, direction, multiple };
        match found.take() {
            None => found = Some(limit),
            Some(first) => match independent(&first.direction, &limit.direction) {
                Some(minor) => {
                    return Ok(Refuted { space, projection, eigenvalue, power, rate, limits: [first, limit], minor });
                }
                None => found = Some(first),
            },
        }
    }
    Err(none())
}

/// The projection to the eigenvectors along the rest of the vectors of sum 0, where there are as many of them as there are
/// functionals, and no block.
fn projection(operator: &Matrix, eigenvalue: &Rational) -> Option<Matrix> {
    let l = shifted(operator, eigenvalue);
    let (right, left) = (l.kernel(), l.transpose().kernel());
    let pairs = &left.transpose() * &right;
    let dual = &pairs.inverse()? * &left.transpose();
    let columns: Vec<Vec<Rational>> = (0..right.cols()).map(|j| vector(&right.column(j))).collect();
    let up = Matrix::from_columns(operator.rows(), &columns);
    Some(
        &up * &Matrix::from_fn(dual.rows(), dual.cols() + 1, |i, j| {
            if j == 0 { Rational::from(0) } else { dual[(i, j - 1)].clone() }
        }),
    )
}

/// A power whose largest column on the rest is below that power of the eigenvalue.
fn gap(operator: &Matrix, rest: &Matrix, eigenvalue: &Rational) -> Option<(usize, Rational)> {
    let mut power = rest.clone();
    let mut bound = Rational::from(1);
    for k in 1..=MAX_POWER {
        power = operator * &power;
        bound *= abs(eigenvalue);
        let size = |j: usize| (0..power.rows()).fold(Rational::from(0), |s, i| s + abs(&power[(i, j)]));
        let largest = (0..power.cols()).map(size).max()?;
        if largest < bound {
            return Some((k, largest));
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

/// A left inverse of an operator on the vectors of sum 0, where there is one.
pub(super) fn undone(operator: &Matrix) -> Option<Matrix> {
    let n = operator.cols();
    let basis = Matrix::from_fn(n, n - 1, |i, j| match i {
        0 => Rational::from(-1),
        _ => Rational::from(u8::from(i == j + 1)),
    });
    if n == 1 {
        return Some(Matrix::zero(1, operator.rows()));
    }
    let images = operator * &basis;
    let inverse = images.transpose().solve(&basis.transpose())?.transpose();
    debug_assert!((0..n - 1).all(|j| (0..n).all(|i| dot(inverse.row(i), &images.column(j)) == basis[(i, j)])));
    Some(inverse)
}
