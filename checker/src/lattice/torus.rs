//! The symbols of values of a limit function, and cells of the torus on which one of them has no zero.

use crate::base::{Checked, Json, Matrix, Node, Q, bits, some, spend, total, whole};
use num_traits::{One, Signed, Zero};

/// Most words.
const MAX_WORDS: usize = 64;
/// Longest word.
const MAX_LETTERS: usize = 16;
/// Deepest division of a chart.
const MAX_DEPTH: usize = 24;

/// Checks that on every cell of the charts the symbol of the values at the point of a word is not 0.
pub fn check(points: &[Vec<i64>], operators: &[Matrix], words: &Node<'_>, charts: &Node<'_>) -> Checked<()> {
    // The row with `λ A_0 = λ` and the sum 1, as a column.
    let start = operators[0].transpose().fixed_point()?;
    let start = some(start, "shifts", "the values of the limit function at the lattice are not unique")?;
    let symbols = words.each(|word| {
        let letters = word.indices(operators.len())?;
        word.need(letters.len() <= MAX_LETTERS, "limit", "the word is too long")?;
        let row = letters.iter().try_fold(start.clone(), |v, k| operators[*k].transpose().times(&v))?;
        Symbol::new(points, &row)
    })?;
    words.need((1..=MAX_WORDS).contains(&symbols.len()), "shifts", "1 to 64 words are needed")?;
    let s = points[0].len();
    for (chart, node) in charts.exactly(1 << s, "shifts")?.iter().enumerate() {
        // The first variable runs slowest.
        let signs: Vec<i64> = (0..s).map(|k| if chart >> (s - 1 - k) & 1 == 0 { 1 } else { -1 }).collect();
        cell(&symbols, &signs, node, &vec![Q::zero(); s], &Q::one(), 0)?;
    }
    Ok(())
}

fn cell(symbols: &[Symbol], signs: &[i64], node: &Node<'_>, centre: &[Q], half: &Q, depth: usize) -> Checked<()> {
    if matches!(node.value, Json::Index(_)) {
        let far = symbols[node.index(symbols.len())?].is_far(signs, centre, half)?;
        return node.need(far, "shifts", "the symbol may have a zero in this cell");
    }
    node.need(depth < MAX_DEPTH, "limit", "the cell is divided too often")?;
    let (s, quarter) = (centre.len(), half / whole(2));
    for (k, part) in node.exactly(1 << s, "shifts")?.iter().enumerate() {
        let moved = |axis: usize| {
            if k >> (s - 1 - axis) & 1 == 0 { &centre[axis] - &quarter } else { &centre[axis] + &quarter }
        };
        cell(symbols, signs, part, &(0..s).map(moved).collect::<Vec<Q>>(), &quarter, depth + 1)?;
    }
    Ok(())
}

/// `Σ c_a z^a`; multiplied by a monomial, which changes no modulus on the torus.
struct Symbol {
    terms: Vec<(Vec<i64>, Q)>,
    /// `Σ |c_a| Σ_k |a_k|`.
    slope: Q,
}

impl Symbol {
    fn new(points: &[Vec<i64>], row: &Matrix) -> Checked<Self> {
        let values: Vec<Q> = (0..points.len()).map(|k| row.at(k, 0)).collect();
        let mut top = 0;
        for k in 0..points.len() {
            if values[k].abs() > values[top].abs() {
                top = k;
            }
        }
        let moved = |k: usize| points[k].iter().zip(&points[top]).map(|(x, y)| x - y).collect::<Vec<i64>>();
        let terms: Vec<(Vec<i64>, Q)> =
            (0..points.len()).filter(|k| !values[*k].is_zero()).map(|k| (moved(k), values[k].clone())).collect();
        let size = |a: &[i64]| whole(a.iter().map(|k| k.abs()).sum());
        let slope = total(terms.iter().map(|(a, c)| c.abs() * size(a)))?;
        Ok(Self { terms, slope })
    }

    /// Whether the symbol is not 0 where the parameters are within `half` of `centre`.
    fn is_far(&self, signs: &[i64], centre: &[Q], half: &Q) -> Checked<bool> {
        let axes: Vec<[Q; 2]> = signs.iter().zip(centre).map(|(sign, t)| point(*sign, t)).collect();
        let (mut re, mut im) = (Q::zero(), Q::zero());
        for (a, c) in &self.terms {
            let mut value = [c.clone(), Q::zero()];
            for (k, z) in a.iter().zip(&axes) {
                let z = if *k < 0 { [z[0].clone(), -&z[1]] } else { z.clone() };
                for _ in 0..k.abs() {
                    spend(8, bits(&value[0]) + bits(&value[1]) + bits(&z[0]) + bits(&z[1]))?;
                    value = [&value[0] * &z[0] - &value[1] * &z[1], &value[0] * &z[1] + &value[1] * &z[0]];
                }
            }
            spend(4, bits(&re) + bits(&value[0]))?;
            re += &value[0];
            im += &value[1];
        }
        let slack = whole(2) * half * &self.slope;
        Ok(&re * &re + &im * &im > &slack * &slack)
    }
}

/// `±(1 + it)²/(1 + t²)`.
fn point(sign: i64, t: &Q) -> [Q; 2] {
    let size = (Q::one() + t * t) * whole(sign);
    [(Q::one() - t * t) / &size, whole(2) * t / &size]
}
