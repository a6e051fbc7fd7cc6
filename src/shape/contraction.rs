//! Whether a system contracts: Dobrushin's coefficient over a finite complete prefix code (theory §1).

use super::{Polytopes, Shape};
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix, Products};
use std::collections::BTreeMap;

/// A word with the bound of its operator on differences.
#[derive(Debug, Clone)]
pub struct ContractingWord {
    /// The letters, read from the state to which the list belongs.
    pub word: Vec<usize>,
    /// The state where the word ends.
    pub end: usize,
    /// `τ(T_word) < 1`.
    pub tau: Rational,
}

/// For every reachable state a complete prefix code of contracting words.
#[derive(Debug, Clone)]
pub struct Contracting {
    /// By state; empty for states that cannot be reached.
    pub codes: Vec<Vec<ContractingWord>>,
    /// Length of the longest word.
    pub length: usize,
    /// The largest `τ` of all words.
    pub constant: Rational,
}

/// Why a tensor product of two curves contracts, and where its attractor lies.
#[derive(Debug, Clone)]
pub struct ProductContraction {
    /// The findings on the two curves.
    pub factors: Box<[Contraction; 2]>,
    /// A point of the attractor.
    pub centre: Vec<Rational>,
    /// The attractor lies within this distance of it in the 1-norm.
    pub radius: Rational,
}

/// The answer to the question whether a system contracts.
#[derive(Debug, Clone)]
pub enum Contraction {
    /// It does, by the 1-norms of words.
    Proved(Contracting),
    /// It does, by polytopes.
    Polytopes(Polytopes),
    /// It does, because both curves do whose tensor product it is.
    Product(ProductContraction),
    /// It does not: a cycle whose linear part has spectral radius at least 1.
    Refuted {
        /// The state of the cycle.
        state: usize,
        /// The cycle.
        word: Vec<usize>,
    },
    /// Not decided within the budget.
    Undetermined {
        /// How long the words examined were.
        length: usize,
        /// How many words were left.
        open: usize,
    },
}

/// How many words are looked at before the question is left open.
pub const MAX_WORDS: usize = 20_000;

/// How many multiplications of numbers those words may cost together.
const MAX_PRODUCTS: usize = 5_000_000;
/// Binary digits to which the sizes of irrational numbers are bounded.
pub(super) const BITS: u64 = 96;
/// How many words of a state a code may have when it is lengthened only to make the balls smaller.
const SHARP_WORDS: usize = 512;

/// `τ(T) = max_{i,j} ½ Σ_k |t_ki − t_kj|`, the norm of `T` on zero-sum vectors induced by the 1-norm; a little more where entries
/// are irrational.
///
/// # Cost
/// `O(rows * cols²)`.
#[must_use]
pub fn dobrushin<E: Entry>(op: &Matrix<E>) -> Rational {
    <E::Product>::of(op).half_distance()
}

/// The sum of absolute values; a little more where entries are irrational.
#[must_use]
pub fn norm1<E: Entry>(v: &[E]) -> Rational {
    v.iter().fold(Rational::from(0), |s, x| s + x.enclosure(BITS).magnitude())
}

/// The linear part of a square operator on zero-sum vectors, in the basis `e_k − e_0`.
#[must_use]
pub fn linear_part<E: Entry>(op: &Matrix<E>) -> Matrix<E> {
    Matrix::from_fn(op.rows().saturating_sub(1), op.cols().saturating_sub(1), |i, j| {
        op[(i + 1, j + 1)].minus(&op[(i + 1, 0)])
    })
}

/// Decides contraction by lengthening words until `τ < 1`; `expands` decides exactly whether the linear part of a cycle has
/// spectral radius at least 1.
///
/// # Cost
/// At most [`MAX_WORDS`] products.
pub fn contraction<E: Entry>(shape: &Shape<E>, expands: impl FnMut(&Matrix<E>) -> bool) -> Contraction {
    contraction_within(shape, MAX_WORDS, MAX_PRODUCTS, expands)
}

/// As [`contraction`] with other limits: `words` products, and `work` over the third power of the largest dimension.
///
/// # Cost
/// At most `words` products.
pub fn contraction_within<E: Entry>(
    shape: &Shape<E>,
    words: usize,
    work: usize,
    mut expands: impl FnMut(&Matrix<E>) -> bool,
) -> Contraction {
    let mut codes: Vec<Vec<ContractingWord>> = vec![Vec::new(); shape.states.len()];
    let mut constant = Rational::from(0);
    let operators = shape.scaled_operators();
    let mut open: Vec<(usize, Vec<usize>, usize, E::Product)> = shape
        .reachable()
        .into_iter()
        .map(|e| (e, Vec::new(), e, <E::Product>::identity(shape.states[e].dim)))
        .collect();
    let (mut length, mut count) = (0, 0);
    let largest = shape.states.iter().map(|s| s.dim).fold(1, usize::max);
    let budget = words.min(work / largest.pow(3).max(1));
    while !open.is_empty() {
        length += 1;
        let mut next = Vec::new();
        for (from, word, state, product) in open {
            crate::stop::check();
            if count > budget {
                return Contraction::Undetermined { length, open: next.len().max(1) };
            }
            for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
                count += 1;
                let op = product.times(&operators[state][letter]);
                let mut word = word.clone();
                word.push(letter);
                let tau = op.half_distance();
                if tau < 1 {
                    if tau > constant {
                        constant.clone_from(&tau);
                    }
                    codes[from].push(ContractingWord { word, end: piece.target, tau });
                } else if piece.target == from && expands(&linear_part(&op.reduced())) {
                    return Contraction::Refuted { state: from, word };
                } else {
                    next.push((from, word, piece.target, op));
                }
            }
        }
        open = next;
    }
    let mut proof = Contracting { codes, length, constant };
    proof.sharpen(shape);
    Contraction::Proved(proof)
}

impl Contraction {
    /// Whether the system was proved to contract.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        matches!(self, Self::Proved(_) | Self::Polytopes(_) | Self::Product(_))
    }
}

impl Contracting {
    /// Replaces words by their extensions, those with the largest `τ` first, while the code stays short, and keeps the best
    /// code met on the way: smaller constants give smaller balls around the attractors.
    fn sharpen<E: Entry>(&mut self, shape: &Shape<E>) {
        let operators = shape.scaled_operators();
        for (from, code) in self.codes.iter_mut().enumerate() {
            sharpen_code(shape, &operators, from, code);
        }
        let words = || self.codes.iter().flatten();
        self.length = words().map(|c| c.word.len()).fold(0, usize::max);
        self.constant = words().map(|c| c.tau.clone()).max().unwrap_or_else(|| Rational::from(0));
    }
}

/// Words by `τ`, with the state where they end and their product.
type Words<P> = BTreeMap<(Rational, Vec<usize>), (usize, P)>;

fn sharpen_code<E: Entry>(
    shape: &Shape<E>,
    operators: &[Vec<E::Product>],
    from: usize,
    code: &mut Vec<ContractingWord>,
) {
    let half = Rational::from(1) / Rational::from(2);
    let product = |c: &ContractingWord| {
        let start = (from, <E::Product>::identity(shape.states[from].dim));
        c.word.iter().fold(start, |(state, product), &letter| {
            (shape.states[state].pieces[letter].target, product.times(&operators[state][letter]))
        })
    };
    let mut words: Words<E::Product> = code.iter().map(|c| ((c.tau.clone(), c.word.clone()), product(c))).collect();
    let limit = SHARP_WORDS.min(MAX_PRODUCTS / shape.states[from].dim.pow(3).max(1));
    let mut best = words.last_key_value().map(|((tau, _), _)| tau.clone()).unwrap_or_else(|| Rational::from(0));
    // What was done since the best code: each word that was replaced, and by which.
    type Sized = (Rational, Vec<usize>);
    let mut since: Vec<(Sized, usize, Vec<Sized>)> = Vec::new();
    while words.len() < limit {
        let Some(((tau, word), (state, product))) = words.pop_last() else { return };
        if tau <= half {
            words.insert((tau, word), (state, product));
            break;
        }
        let mut longer = Vec::new();
        for (letter, piece) in shape.states[state].pieces.iter().enumerate() {
            let op = product.times(&operators[state][letter]);
            let key = (op.half_distance(), [word.as_slice(), &[letter]].concat());
            longer.push(key.clone());
            words.insert(key, (piece.target, op));
        }
        since.push(((tau, word), state, longer));
        let worst = words.last_key_value().map(|((tau, _), _)| tau.clone()).unwrap_or_else(|| Rational::from(0));
        if worst < best && words.len() < limit {
            best = worst;
            since.clear();
        }
    }
    let mut ends: BTreeMap<_, _> = words.into_iter().map(|(key, (end, _))| (key, end)).collect();
    for (key, end, longer) in since.into_iter().rev() {
        for word in longer {
            ends.remove(&word);
        }
        ends.insert(key, end);
    }
    *code = ends.into_iter().map(|((tau, word), end)| ContractingWord { word, end, tau }).collect();
    code.sort_by(|a, b| a.word.cmp(&b.word));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::shape::CellKind;

    fn family(a: Rational, b: Rational) -> Shape {
        let one = Rational::from(1);
        let o = Rational::from(0);
        let t0 = vec![
            vec![&one - &a, b.clone(), o.clone()],
            vec![a.clone(), &one - &b, &one - &a],
            vec![o.clone(), o.clone(), a.clone()],
        ];
        let t1 =
            vec![vec![b.clone(), o.clone(), o.clone()], vec![&one - &b, &one - &a, b.clone()], vec![o, a, &one - &b]];
        Shape::single(CellKind::Edge, vec![Matrix::from_rows(3, t0), Matrix::from_rows(3, t1)])
    }

    #[test]
    fn prefix_codes_close_where_no_single_length_is_short() {
        let shape = family(ratio(-3, 5), ratio(41, 50));
        let Contraction::Proved(proof) = contraction(&shape, |_| false) else { panic!("contracts") };
        assert!(proof.length >= 17);
        assert!(proof.constant < 1);
        for c in &proof.codes[0] {
            assert_eq!(dobrushin(&shape.product(0, &c.word).0), c.tau);
        }
        // Kraft's equality: the code is complete.
        let kraft = proof.codes[0].iter().fold(Rational::from(0), |s, c| s + ratio(1, 1 << c.word.len()));
        assert_eq!(kraft, 1);
    }
}
