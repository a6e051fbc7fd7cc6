//! Chains of generalised eigenvectors over `Q[x] / (f)` from rational generators.

use super::Chain;
use super::generators::{Generator, generators};
use crate::algebraic::Elem;
use crate::arith::{Integer, Natural, Rational};
use crate::linalg::Matrix;
use crate::poly::{Poly, ints};
use malachite_base::num::arithmetic::traits::Gcd;

/// A vector over `Q[x] / (f)` as its coefficient vectors: `sum of θ^j parts[j]`.
struct FieldVector {
    parts: Vec<Vec<Rational>>,
}

/// The block sizes, descending, and a chain for each.
pub(super) fn chains(a: &Matrix, f: &Poly, multiplicity: usize) -> (Vec<usize>, Vec<Chain>) {
    let found = generators(a, f, multiplicity);
    let sizes = found.iter().map(|g| g.size).collect();
    let chains = found.iter().map(|g| chain(a, f, g)).collect();
    (sizes, chains)
}

fn chain(a: &Matrix, f: &Poly, generator: &Generator) -> Chain {
    // With q = f / (x - θ), the vector q(A)^size u is killed by (A - θ)^size and by no lower power.
    let mut top = first_quotient(a, f, &generator.vector);
    for _ in 1..generator.size {
        top = apply_quotient(a, f, &top);
    }
    let mut vectors = vec![top];
    for _ in 1..generator.size {
        let next = apply_minus_root(a, f, &vectors[vectors.len() - 1]);
        vectors.push(next);
    }
    vectors.reverse();
    let scale = primitive_factor(&vectors[0]);
    Chain { vectors: vectors.into_iter().map(|v| v.into_elements(&scale)).collect() }
}

/// `q(A) u` for a rational vector: the coefficient of `θ^(j-1)` is `A` times that of `θ^j`, plus `f_j u`.
fn first_quotient(a: &Matrix, f: &Poly, u: &[Rational]) -> FieldVector {
    let d = f.degree().unwrap_or(1);
    let mut parts = vec![u.to_vec()];
    for j in (1..d).rev() {
        let mut next = a.apply(&parts[parts.len() - 1]);
        add_multiple(&mut next, &f.coeffs()[j], u);
        parts.push(next);
    }
    parts.reverse();
    FieldVector { parts }
}

/// `q(A) v` by Horner's scheme: the coefficients of `q` satisfy `q_(i-1) = f_i + θ q_i`.
fn apply_quotient(a: &Matrix, f: &Poly, v: &FieldVector) -> FieldVector {
    let d = f.degree().unwrap_or(1);
    let mut weighted = FieldVector { parts: v.parts.clone() };
    let mut sum = FieldVector { parts: v.parts.clone() };
    for i in (1..d).rev() {
        weighted = weighted.times_root(f);
        for (w, part) in weighted.parts.iter_mut().zip(&v.parts) {
            add_multiple(w, &f.coeffs()[i], part);
        }
        for (s, w) in sum.parts.iter_mut().zip(&weighted.parts) {
            *s = a.apply(s);
            add_multiple(s, &Rational::from(1), w);
        }
    }
    sum
}

fn apply_minus_root(a: &Matrix, f: &Poly, v: &FieldVector) -> FieldVector {
    let mut out = v.times_root(f);
    for (o, part) in out.parts.iter_mut().zip(&v.parts) {
        for (x, y) in o.iter_mut().zip(a.apply(part)) {
            *x = y - &*x;
        }
    }
    out
}

fn add_multiple(v: &mut [Rational], factor: &Rational, u: &[Rational]) {
    if *factor != 0 {
        for (x, y) in v.iter_mut().zip(u) {
            *x += factor * y;
        }
    }
}

/// The factor that makes a vector primitive: integer coefficients without a common divisor.
fn primitive_factor(v: &FieldVector) -> Rational {
    let entries = || v.parts.iter().flatten().filter(|x| **x != 0);
    let denominator = ints::common_denominator(entries());
    let mut content = Natural::from(0u32);
    for x in entries() {
        content = content.gcd(ints::cleared(x, &denominator).unsigned_abs_ref());
    }
    Rational::from_integers(Integer::from(denominator), Integer::from(content))
}

impl FieldVector {
    fn times_root(&self, f: &Poly) -> Self {
        let d = self.parts.len();
        let mut parts = Vec::with_capacity(d);
        parts.push(vec![Rational::from(0); self.parts[0].len()]);
        parts.extend_from_slice(&self.parts[..d - 1]);
        for (part, c) in parts.iter_mut().zip(f.coeffs()) {
            add_multiple(part, &-c, &self.parts[d - 1]);
        }
        Self { parts }
    }

    fn into_elements(self, scale: &Rational) -> Vec<Elem> {
        let n = self.parts[0].len();
        (0..n).map(|i| Elem(Poly::new(self.parts.iter().map(|p| &p[i] * scale).collect()))).collect()
    }
}
