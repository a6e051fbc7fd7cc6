//! Chains of generalised eigenvectors over `Q[x] / (f)` from their generators, in integers.
//!
//! With `N = D A` and `η = D θ` everything is integral: `F` is monic and the vectors have coefficients in `Z[η]`.

use super::Chain;
use super::generators::{Generator, Part};
use super::operator::{Operator, add_multiple, content};
use crate::algebraic::Elem;
use crate::arith::{Integer, Natural, Rational};
use crate::poly::{Poly, ints};
use malachite_base::num::arithmetic::traits::{DivExactAssign, Gcd, Lcm, Pow};
use malachite_base::num::logic::traits::SignificantBits;

/// A vector over `Z[η]` as its coefficient vectors: `sum of η^j parts[j]`.
struct FieldVector {
    parts: Vec<Vec<Integer>>,
}

/// The chain of one Jordan block.
pub(super) fn chain(operator: &Operator, part: &Part, generator: &Generator) -> Chain {
    let f = &part.poly;
    if generator.size == 1 && operator.denominator.significant_bits() * f.len() as u64 > LONG_DENOMINATORS {
        return reduced_chain(operator, &part.monic, &generator.vector);
    }
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

/// Powers of the common denominator with more bits than this are not carried along.
const LONG_DENOMINATORS: u64 = 8192;

/// An eigenvector over `Q[x] / (f)`, by the same recursion as [`first_quotient`] for `A` itself, with the common factor
/// of numerators and denominator removed in every step.
fn reduced_chain(operator: &Operator, f: &Poly, u: &[Integer]) -> Chain {
    let d = f.degree().unwrap_or(1);
    let mut parts = vec![Reduced { vector: u.to_vec(), denominator: Natural::from(1u32) }];
    for j in (1..d).rev() {
        let next = parts[parts.len() - 1].step(operator, &f.coeffs()[j], u);
        parts.push(next);
    }
    parts.reverse();
    let common = parts.iter().fold(Natural::from(1u32), |acc, p| acc.lcm(&p.denominator));
    for part in &mut parts {
        let factor = Integer::from(&common / &part.denominator);
        part.vector.iter_mut().for_each(|x| *x *= &factor);
    }
    let divisor = Integer::from(content(parts.iter().flat_map(|p| &p.vector)));
    if divisor > 1 {
        parts.iter_mut().flat_map(|p| &mut p.vector).for_each(|x| x.div_exact_assign(&divisor));
    }
    let element = |i: usize| Elem(Poly::new(parts.iter().map(|p| Rational::from(&p.vector[i])).collect()));
    Chain { vectors: vec![(0..u.len()).map(element).collect()] }
}

/// The rational vector `vector / denominator`.
struct Reduced {
    vector: Vec<Integer>,
    denominator: Natural,
}

impl Reduced {
    /// `A self + c u`.
    fn step(&self, operator: &Operator, c: &Rational, u: &[Integer]) -> Self {
        let image = Self {
            vector: operator.apply(&self.vector),
            denominator: &self.denominator * operator.denominator.unsigned_abs_ref(),
        }
        .lowest();
        let denominator = (&image.denominator).lcm(c.denominator_ref());
        let factor = Integer::from(&denominator / &image.denominator);
        let mut vector: Vec<Integer> = image.vector.into_iter().map(|x| x * &factor).collect();
        add_multiple(&mut vector, &ints::cleared(c, &denominator), u);
        Self { vector, denominator }.lowest()
    }

    fn lowest(mut self) -> Self {
        let g = self
            .vector
            .iter()
            .fold(self.denominator.clone(), |g, x| if g == 1 { g } else { g.gcd(x.unsigned_abs_ref()) });
        if g > 1 {
            self.denominator /= &g;
            let g = Integer::from(g);
            self.vector.iter_mut().for_each(|x| x.div_exact_assign(&g));
        }
        self
    }
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
