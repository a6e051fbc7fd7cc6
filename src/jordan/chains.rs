//! Chains of generalised eigenvectors over `Q[x] / (f)` from their generators, in integers.
//!
//! With `N = D A` and `η = D θ` everything is integral: `F` is monic and the vectors have coefficients in `Z[η]`.

use super::Chain;
use super::generators::Generator;
use super::operator::{Operator, add_multiple, content};
use crate::algebraic::Elem;
use crate::arith::{Integer, Natural, Rational};
use crate::poly::Poly;
use malachite_base::num::arithmetic::traits::Pow;

/// A vector over `Z[η]` as its coefficient vectors: `sum of η^j parts[j]`.
struct FieldVector {
    parts: Vec<Vec<Integer>>,
}

/// The chain of one Jordan block.
pub(super) fn chain(operator: &Operator, f: &[Integer], generator: &Generator) -> Chain {
    // With q = F / (x - η), the vector q(N)^size u is killed by (N - η)^size and by no lower power.
    let mut top = first_quotient(operator, f, &generator.vector);
    for _ in 1..generator.size {
        top = apply_quotient(operator, f, &top);
    }
    let mut vectors = vec![top];
    for _ in 1..generator.size {
        let next = apply_minus_root(operator, f, &vectors[vectors.len() - 1]);
        vectors.push(next);
    }
    vectors.reverse();
    let powers: Vec<Natural> = (0..f.len() + generator.size)
        .map(|k| (&operator.denominator).pow(k as u64).unsigned_abs_ref().clone())
        .collect();
    let divisor = divisor(&vectors[0], &powers);
    let scaled = |(j, v): (usize, FieldVector)| v.into_elements(&powers[j..], &divisor);
    Chain { vectors: vectors.into_iter().enumerate().map(scaled).collect() }
}

/// `q(N) u` for a constant vector: the coefficient of `η^(j-1)` is `N` times that of `η^j`, plus `F_j u`.
fn first_quotient(operator: &Operator, f: &[Integer], u: &[Integer]) -> FieldVector {
    let d = f.len() - 1;
    let mut parts = vec![u.to_vec()];
    for j in (1..d).rev() {
        let mut next = operator.apply(&parts[parts.len() - 1]);
        add_multiple(&mut next, &f[j], u);
        parts.push(next);
    }
    parts.reverse();
    FieldVector { parts }
}

/// `q(N) v` by Horner's scheme: the coefficients of `q` satisfy `q_(i-1) = F_i + η q_i`.
fn apply_quotient(operator: &Operator, f: &[Integer], v: &FieldVector) -> FieldVector {
    let d = f.len() - 1;
    let mut weighted = FieldVector { parts: v.parts.clone() };
    let mut sum = FieldVector { parts: v.parts.clone() };
    for i in (1..d).rev() {
        weighted = weighted.times_root(f);
        for (w, part) in weighted.parts.iter_mut().zip(&v.parts) {
            add_multiple(w, &f[i], part);
        }
        for (s, w) in sum.parts.iter_mut().zip(&weighted.parts) {
            *s = operator.apply(s);
            add_multiple(s, &Integer::from(1), w);
        }
    }
    sum
}

fn apply_minus_root(operator: &Operator, f: &[Integer], v: &FieldVector) -> FieldVector {
    let mut out = v.times_root(f);
    for (o, part) in out.parts.iter_mut().zip(&v.parts) {
        for (x, y) in o.iter_mut().zip(operator.apply(part)) {
            *x = y - &*x;
        }
    }
    out
}

/// The content of the eigenvector in powers of `θ`, with the sign of its first coefficient.
fn divisor(v: &FieldVector, powers: &[Natural]) -> Integer {
    let scaled: Vec<Integer> =
        v.parts.iter().zip(powers).map(|(part, power)| Integer::from(content(part)) * Integer::from(power)).collect();
    let first = v.parts.iter().flatten().find(|x| **x != 0);
    Integer::from_sign_and_abs(first.is_none_or(|x| *x > 0), content(&scaled))
}

impl FieldVector {
    fn times_root(&self, f: &[Integer]) -> Self {
        let d = self.parts.len();
        let mut parts = Vec::with_capacity(d);
        parts.push(vec![Integer::from(0); self.parts[0].len()]);
        parts.extend_from_slice(&self.parts[..d - 1]);
        for (part, c) in parts.iter_mut().zip(f) {
            add_multiple(part, &-c, &self.parts[d - 1]);
        }
        Self { parts }
    }

    /// The entries in powers of `θ`, with `η = D θ`, times the first power of `D`, divided by the divisor.
    fn into_elements(self, powers: &[Natural], divisor: &Integer) -> Vec<Elem> {
        let n = self.parts[0].len();
        let entry = |x: &Integer, power: &Natural| {
            if *x == 0 {
                return Rational::from(0);
            }
            let numerator = if *power == 1 { x.clone() } else { x * Integer::from(power) };
            if *divisor == 1 { Rational::from(numerator) } else { Rational::from_integers_ref(&numerator, divisor) }
        };
        let element = |i: usize| Elem(Poly::new(self.parts.iter().zip(powers).map(|(p, d)| entry(&p[i], d)).collect()));
        (0..n).map(element).collect()
    }
}
