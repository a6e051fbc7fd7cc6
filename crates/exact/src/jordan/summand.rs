//! Direct summands of a matrix, their factors and chains, and how they come together again.

use super::generators::{Part, generators};
use super::operator::Operator;
use super::symmetry::Symmetry;
use super::{Chain, Factor, PARALLEL, chains};
use crate::algebraic::{Elem, Root};
use crate::arith::{Integer, Rational};
use crate::linalg::{Matrix, char_poly_blocks};
use crate::poly::{IntPoly, Poly, factor};
use std::collections::BTreeMap;

/// The action on an invariant subspace, in coordinates.
pub(super) struct Side {
    pub matrix: Matrix,
    /// What the coordinate vectors stand for; `None` for the whole space.
    pub embedding: Option<Vec<Vec<(usize, Integer)>>>,
}

/// An invariant subspace of the matrix and the corresponding one of the transpose.
pub(super) struct Summand {
    pub right: Side,
    pub left: Side,
}

impl Summand {
    pub fn whole(a: &Matrix) -> Self {
        let side = |matrix| Side { matrix, embedding: None };
        Self { right: side(a.clone()), left: side(a.transpose()) }
    }
}

/// The summands by symmetry, or the whole matrix.
pub(super) fn split(a: &Matrix) -> Vec<Summand> {
    match Symmetry::detect(a) {
        Some(symmetry) => symmetry.split(a),
        None => vec![Summand::whole(a)],
    }
}

/// One irreducible factor with everything of all summands.
pub(super) struct Merged {
    pub poly: Poly,
    pub multiplicity: usize,
    pub blocks: Vec<usize>,
    pub right: Vec<Chain>,
    pub left: Vec<Chain>,
}

impl Merged {
    pub fn with_roots(self, roots: Vec<Root>) -> Factor {
        let Self { poly, multiplicity, blocks, right, left } = self;
        Factor { poly, multiplicity, blocks, roots, right, left }
    }
}

/// The monic irreducible factors of the characteristic polynomial of one summand.
fn factors(summand: &Summand) -> Vec<(Poly, usize)> {
    let blocks = char_poly_blocks(&summand.right.matrix);
    let mut distinct: BTreeMap<&IntPoly, usize> = BTreeMap::new();
    for block in &blocks {
        *distinct.entry(block).or_default() += 1;
    }
    let mut found: BTreeMap<Poly, usize> = BTreeMap::new();
    for (block, count) in distinct {
        for (poly, exponent) in factor(&Poly::from_ints(block)) {
            *found.entry(poly).or_default() += exponent * count;
        }
    }
    found.into_iter().collect()
}

pub(super) fn all_factors(summands: &[Summand]) -> Vec<Vec<(Poly, usize)>> {
    crate::parallel::map(summands, summands.len() > 1, factors)
}

/// The irreducible factors of the characteristic polynomial with their exponents, in order, from those of the summands.
pub(super) fn polynomials(lists: &[Vec<(Poly, usize)>]) -> Vec<(Poly, usize)> {
    let mut found: BTreeMap<Poly, usize> = BTreeMap::new();
    for (poly, exponent) in lists.iter().flatten() {
        *found.entry(poly.clone()).or_default() += exponent;
    }
    found.into_iter().collect()
}

/// One side of one summand, ready for work.
struct Task<'a> {
    side: &'a Side,
    operator: Operator,
    parts: Vec<Part>,
}

impl<'a> Task<'a> {
    fn new(side: &'a Side, factors: &[(Poly, usize)]) -> Self {
        let operator = Operator::new(&side.matrix);
        let part = |(f, m): &(Poly, usize)| Part { monic: f.clone(), poly: operator.scaled(f), multiplicity: *m };
        let parts = factors.iter().map(part).collect();
        Self { side, operator, parts }
    }

    /// The chains of one factor, in coordinates of the whole space of dimension `size`.
    fn chains(&self, which: usize, size: usize) -> Vec<Chain> {
        let found = generators(&self.operator, &self.parts, which);
        let part = &self.parts[which];
        found.iter().map(|g| self.embed(chains::chain(&self.operator, part, g), size)).collect()
    }

    fn embed(&self, chain: Chain, size: usize) -> Chain {
        let Some(embedding) = &self.side.embedding else { return chain };
        let vectors = chain.vectors.iter().map(|v| embed_vector(v, embedding, size)).collect();
        Chain { vectors }
    }
}

pub(super) fn embed_vector(v: &[Elem], embedding: &[Vec<(usize, Integer)>], size: usize) -> Vec<Elem> {
    let width = v.iter().map(|e| e.0.coeffs().len()).max().unwrap_or(0);
    let mut out = vec![vec![Rational::from(0); width]; size];
    for (element, places) in v.iter().zip(embedding) {
        for (i, c) in places {
            let c = Rational::from(c);
            for (x, y) in out[*i].iter_mut().zip(element.0.coeffs()) {
                *x += &c * y;
            }
        }
    }
    out.into_iter().map(|coeffs| Elem(Poly::new(coeffs))).collect()
}

/// Factors and chains of all summands, equal factors merged, in order.
pub(super) fn decompose(summands: &[Summand]) -> Vec<Merged> {
    decompose_some(summands, &all_factors(summands), &|_| true)
}

/// The same for those of the factors of the summands that are wanted; a factor that is wanted in one summand is so in all.
pub(super) fn decompose_some(
    summands: &[Summand],
    lists: &[Vec<(Poly, usize)>],
    wanted: &dyn Fn(&Poly) -> bool,
) -> Vec<Merged> {
    let size: usize = summands.iter().map(|s| s.right.matrix.rows()).sum();
    let sides: Vec<(&Side, usize)> =
        summands.iter().enumerate().flat_map(|(k, s)| [(&s.right, k), (&s.left, k)]).collect();
    let tasks: Vec<Task> = sides.iter().map(|(side, k)| Task::new(side, &lists[*k])).collect();
    let jobs: Vec<(usize, usize)> = tasks
        .iter()
        .enumerate()
        .flat_map(|(t, task)| (0..task.parts.len()).map(move |f| (t, f)))
        .filter(|(t, f)| wanted(&lists[t / 2][*f].0))
        .collect();
    let work = |(t, f): &(usize, usize)| tasks[*t].chains(*f, size);
    let results: Vec<Vec<Chain>> = crate::parallel::map(&jobs, size >= PARALLEL, work);
    let mut found: BTreeMap<Poly, Merged> = BTreeMap::new();
    for ((t, f), chains) in jobs.into_iter().zip(results) {
        let (poly, multiplicity) = &lists[t / 2][f];
        let merged = found.entry(poly.clone()).or_insert_with(|| Merged {
            poly: poly.clone(),
            multiplicity: 0,
            blocks: Vec::new(),
            right: Vec::new(),
            left: Vec::new(),
        });
        if t % 2 == 0 {
            merged.multiplicity += multiplicity;
            merged.right.extend(chains);
        } else {
            merged.left.extend(chains);
        }
    }
    let mut out: Vec<Merged> = found.into_values().collect();
    for merged in &mut out {
        let descending = |chains: &mut Vec<Chain>| chains.sort_by_key(|c| std::cmp::Reverse(c.vectors.len()));
        descending(&mut merged.right);
        descending(&mut merged.left);
        merged.blocks = merged.right.iter().map(|c| c.vectors.len()).collect();
    }
    out
}

/// The characteristic polynomial from the merged factors.
pub(super) fn product(parts: &[Merged]) -> Poly {
    let mut product = vec![Integer::from(1)];
    for part in parts {
        let f = part.poly.primitive();
        for _ in 0..part.multiplicity {
            product = crate::poly::ints::mul(&product, &f);
        }
    }
    Poly::from_ints(&product).monic()
}
