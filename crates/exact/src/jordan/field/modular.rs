//! The equations of chains over a number field, modulo primes.

use super::FieldFactor;
use crate::algebraic::Elem;
use crate::algebraic::field::FieldMatrix;
use crate::arith::modular::{PrimeField, large_primes};
use crate::jordan::Chain;
use crate::poly::{Poly, modp};

/// So many primes are asked.
const PRIMES: usize = 2;

/// Whether the chains satisfy `(A - λ) v[0] = 0` and `(A - λ) v[j+1] = v[j]` modulo two primes of 62 bits, and start with
/// vectors other than 0. A guard against mistakes of the program; for a proof see [`FieldFactor::holds`].
pub(super) fn holds(factor: &FieldFactor, a: &FieldMatrix, chains: &[Chain]) -> bool {
    let start = |chain: &Chain| chain.vectors.first().is_some_and(|v| v.iter().any(|x| !x.is_zero()));
    let answers = large_primes().filter_map(|p| modulo(factor, a, chains, &PrimeField::new(p)));
    chains.iter().all(start) && answers.take(PRIMES).all(|holds| holds)
}

fn residues(p: &Poly, field: &PrimeField) -> Option<Vec<u64>> {
    let mut out = p.coeffs().iter().map(|c| field.from_rational(c)).collect::<Option<Vec<u64>>>()?;
    modp::trim(&mut out);
    Some(out)
}

/// `None` where the prime divides a denominator.
fn modulo(factor: &FieldFactor, a: &FieldMatrix, chains: &[Chain], field: &PrimeField) -> Option<bool> {
    let m = residues(&factor.generator, field)?;
    let (alpha, lambda) = (residues(&factor.alpha.0, field)?, residues(&factor.lambda.0, field)?);
    let reduced = |f: Vec<u64>| modp::rem(field, f, &m);
    let mut powers = vec![reduced(vec![field.one()])];
    for k in 1..a.field().degree() {
        powers.push(reduced(modp::mul(field, &powers[k - 1], &alpha)));
    }
    let image = |x: &Elem| -> Option<Vec<u64>> {
        let mut sum = vec![0; m.len() - 1];
        for (c, power) in residues(&x.0, field)?.iter().zip(&powers) {
            add(field, &mut sum, &modp::mul(field, &[*c], power));
        }
        Some(sum)
    };
    let entries = a.entries().iter().map(image).collect::<Option<Vec<_>>>()?;
    let minus: Vec<u64> = lambda.iter().map(|c| field.neg(*c)).collect();
    let vector = |v: &Vec<Elem>| v.iter().map(|x| residues(&x.0, field)).collect::<Option<Vec<_>>>();
    for chain in chains {
        let vectors = chain.vectors.iter().map(vector).collect::<Option<Vec<_>>>()?;
        for (j, v) in vectors.iter().enumerate() {
            for (i, row) in entries.chunks_exact(a.cols()).enumerate() {
                let mut sum = modp::mul(field, &minus, &v[i]);
                row.iter().zip(v).for_each(|(x, y)| add(field, &mut sum, &modp::mul(field, x, y)));
                let zero = Vec::new();
                let before = if j == 0 { &zero } else { &vectors[j - 1][i] };
                if reduced(modp::sub(field, &sum, before)) != zero {
                    return Some(false);
                }
            }
        }
    }
    Some(true)
}

fn add(field: &PrimeField, sum: &mut Vec<u64>, term: &[u64]) {
    sum.resize(sum.len().max(term.len()), 0);
    sum.iter_mut().zip(term).for_each(|(s, t)| *s = field.add(*s, *t));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jordan::FieldSpectrum;

    #[test]
    fn a_wrong_chain_is_seen() {
        let texts = ["sqrt(5)", "1", "0", "sqrt(5)"];
        let (field, entries) = crate::algebraic::field::NumberField::read(&texts).unwrap();
        let a = FieldMatrix::new(&field, 2, 2, entries);
        let factor = FieldSpectrum::of(&a).factors.remove(0);
        assert_eq!(factor.blocks, [2]);
        assert!(holds(&factor, &a, &factor.right));
        let mut chains = factor.right.clone();
        chains[0].vectors.swap(0, 1);
        assert!(!holds(&factor, &a, &chains));
        assert!(!holds(&factor, &a, &factor.left));
        chains[0].vectors.clear();
        assert!(!holds(&factor, &a, &chains));
    }
}
