//! Curves that are graphs over a parameter of their own (theory §11, Theorem 12): equal shares for all pieces, or the shares that
//! positions give which every piece keeps in order.

use super::derived::Curve;
use super::smoothness::{CurveOrder, Outcome, Shares};
use crate::arith::Rational;
use crate::jordan::modulus_classes;
use crate::linalg::{Matrix, dot};
use crate::radius::{Options, Radial};
use crate::shape::{CellKind, End, Shape, Spaces, difference};

/// The order 1 of a curve that is a graph over its parameter, as it is seen (Theorem 12); `None` where its hypotheses are
/// not all proved.
///
/// # Cost
/// One joint spectral radius where the chords allow it, otherwise some linear algebra.
#[must_use]
pub fn graph_over_parameter<E: Radial>(
    shape: &Shape<E>,
    spaces: &Spaces<E>,
    options: &Options,
) -> Option<CurveOrder<E>> {
    graph(&Curve::new(shape, spaces).ok()?, shape, spaces, options)
}

/// The same over a parameter of which the pieces take other shares, those that positions give.
///
/// # Cost
/// Linear systems and spectra of single pieces, then as above.
#[must_use]
pub fn graph_over_shares(shape: &Shape, spaces: &Spaces, options: &Options) -> Option<CurveOrder> {
    let shares = shares(shape, spaces).filter(|shares| shape.has_shares() || !are_equal(shares))?;
    graph(&Curve::of(shape, spaces, 1, Some(shares)).ok()?, shape, spaces, options)
}

/// Whether the pieces of each state take the same share, and all states that many, which was tried before.
fn are_equal(shares: &Shares) -> bool {
    let mut all = shares.iter().flatten();
    all.next().is_some_and(|first| all.all(|s| s == first))
}

fn graph<E: Radial>(
    curve: &Curve<'_, E>,
    shape: &Shape<E>,
    spaces: &Spaces<E>,
    options: &Options,
) -> Option<CurveOrder<E>> {
    let (_, chords) = curve.first().ok()?;
    let families = curve.differences(1, &chords);
    let outside = |family: &Matrix<E>, chord: &[E]| {
        family.stack(&Matrix::from_rows(chord.len(), vec![chord.to_vec()])).rank() > family.rank()
    };
    // Any lift of a vector of the visible quotient is seen as the same vector.
    let start = spaces.of(shape.start);
    let pivots = start.visible.echelon().pivots;
    let view = &shape.view() * &start.basis;
    let view = Matrix::from_fn(view.rows(), pivots.len(), |i, j| view[(i, pivots[j])].clone());
    let home = curve.position(shape.start);
    let seen = outside(&(&families[home] * &view.transpose()), &view.apply(&chords[home]));
    if !seen || !families.iter().zip(&chords).all(|(f, c)| outside(f, c)) {
        return None;
    }
    let mut order = curve.order(1, &families, options);
    if !order.is_below() || curve.joints(1, &curve.ends(1, &families, &chords)?).is_some() {
        return None;
    }
    order.outcome = Outcome::Holds;
    Some(order)
}

/// Most choices of factors for the pieces from a state to itself.
const MAX_CHOICES: usize = 64;

/// The shares of a parameter by positions: functionals `ξ_e` on the visible quotients with `ξ_e T_i = ε_i s_i ξ_δ`, `s_i > 0`, and
/// 1 on the chords. They are looked for from the states that lead nowhere else backwards, and proved by what is made of them.
fn shares(shape: &Shape, spaces: &Spaces) -> Option<Shares> {
    let reachable = shape.reachable();
    if reachable.iter().any(|e| shape.states[*e].kind != CellKind::Edge || spaces.of(*e).visible.rows() == 0) {
        return None;
    }
    let mut search = Search { shape, spaces, found: vec![None; shape.states.len()] };
    let mut open: Vec<usize> = reachable.clone();
    while !open.is_empty() {
        let ready = |e: &usize| {
            let pieces = &shape.states[*e].pieces;
            pieces.iter().all(|p| p.target == *e || search.found[p.target].is_some())
        };
        // States that lead to each other have no order; they are left to equal shares.
        let e = open.iter().copied().find(ready)?;
        search.found[e] = Some(search.positions(e)?);
        open.retain(|d| *d != e);
    }
    let of = |e: &usize| Some(search.found[*e].clone()?.shares);
    reachable.iter().map(of).collect()
}

#[derive(Clone)]
struct Positions {
    functional: Vec<Rational>,
    shares: Vec<Rational>,
}

struct Search<'a> {
    shape: &'a Shape,
    spaces: &'a Spaces,
    found: Vec<Option<Positions>>,
}

impl Search<'_> {
    fn positions(&self, e: usize) -> Option<Positions> {
        let state = &self.shape.states[e];
        let operators: Vec<Matrix> =
            state.pieces.iter().map(|p| self.spaces.on_visible(&p.op, e, p.target)).collect::<Option<_>>()?;
        let own: Vec<usize> = (0..operators.len()).filter(|i| state.pieces[*i].target == e).collect();
        self.choices(&own, &operators, operators.len())
            .iter()
            .find_map(|factors| self.with_factors(e, &own, factors, &operators))
    }

    /// The factors of the pieces from a state to itself that are tried: equal ones, then all of their rational eigenvalues.
    fn choices(&self, own: &[usize], operators: &[Matrix], pieces: usize) -> Vec<Vec<Rational>> {
        let share = Rational::from(1) / Rational::from(pieces);
        let mut all = vec![vec![share; own.len()]];
        let positive = |x: Rational| (x != 0).then(|| crate::arith::abs(&x));
        let mut products = vec![Vec::new()];
        for i in own {
            let mut values: Vec<Rational> =
                modulus_classes(&operators[*i]).iter().flatten().filter_map(|r| positive(r.rational()?)).collect();
            values.dedup();
            products = products
                .iter()
                .flat_map(|p: &Vec<Rational>| {
                    values.iter().map(move |v| [p.as_slice(), std::slice::from_ref(v)].concat())
                })
                .take(MAX_CHOICES)
                .collect();
        }
        all.extend(products);
        all
    }

    /// Solves `ξ T_i = ε_i s_i ξ_δ` for `ξ` and the shares of the pieces to other states.
    fn with_factors(&self, e: usize, own: &[usize], factors: &[Rational], operators: &[Matrix]) -> Option<Positions> {
        let pieces = &self.shape.states[e].pieces;
        let others: Vec<usize> = (0..pieces.len()).filter(|i| !own.contains(i)).collect();
        let dim = self.spaces.of(e).visible.rows();
        let width = dim + others.len();
        let mut rows = Vec::new();
        for (i, op) in operators.iter().enumerate() {
            let sign = Rational::from(if pieces[i].reversed { -1 } else { 1 });
            for c in 0..op.cols() {
                let mut row: Vec<Rational> = op.column(c);
                row.resize(width, Rational::from(0));
                match (own.iter().position(|k| *k == i), &self.found[pieces[i].target]) {
                    (Some(k), _) => row[c] -= &sign * &factors[k],
                    (None, Some(target)) => {
                        let at = others.iter().position(|k| *k == i)?;
                        row[dim + at] -= &sign * &target.functional[c];
                    }
                    (None, None) => return None,
                }
                rows.push(row);
            }
        }
        let system = Matrix::from_rows(width, rows);
        let kernel = system.kernel();
        // Where pieces may be stretched on their own, those to other states are given equal shares first.
        let equal = (1..others.len()).map(|k| {
            let mut row = vec![Rational::from(0); width];
            (row[dim], row[dim + k]) = (Rational::from(1), Rational::from(-1));
            row
        });
        let tied = Matrix::from_rows(width, equal.collect());
        let tied = if kernel.cols() > 1 { system.stack(&tied).kernel() } else { Matrix::zero(width, 0) };
        let candidates = (0..tied.cols()).map(|j| tied.column(j)).chain((0..kernel.cols()).map(|j| kernel.column(j)));
        let chord = self.chord(e)?;
        candidates.into_iter().find_map(|solution| {
            let length = dot(&solution[..dim], &chord);
            if length == 0 {
                return None;
            }
            let scaled: Vec<Rational> = solution.iter().map(|x| x / &length).collect();
            let share = |i: usize| match own.iter().position(|k| *k == i) {
                Some(k) => factors[k].clone(),
                None => others.iter().position(|k| *k == i).map_or(Rational::from(0), |at| scaled[dim + at].clone()),
            };
            let shares: Vec<Rational> = (0..pieces.len()).map(share).collect();
            shares.iter().all(|s| *s > 0).then(|| Positions { functional: scaled[..dim].to_vec(), shares })
        })
    }

    fn chord(&self, e: usize) -> Option<Vec<Rational>> {
        let end = |end| self.shape.end_point(e, end);
        Some(self.spaces.in_visible(e, &difference(&end(End::Finish)?, &end(End::Start)?)))
    }
}
