//! Rational vectors from their residues.

use crate::arith::modular::PrimeField;
use crate::arith::{Integer, Natural};
use crate::poly::ints::CrtPoly;
use malachite_base::num::arithmetic::traits::{DivMod, FloorSqrt, ModAssign};

/// A vector known modulo a growing product of primes.
#[derive(Default)]
pub(crate) struct Residues(CrtPoly);

impl Residues {
    /// The vector with these residues modulo a number.
    pub fn new(coeffs: Vec<Integer>, modulus: Integer) -> Self {
        Self(CrtPoly { coeffs, modulus })
    }

    pub fn absorb(&mut self, field: &PrimeField, v: &[u64]) {
        self.0.absorb(field, v);
    }

    /// The integer vector proportional to the rational vector with these residues whose numbers are small, if any.
    pub fn vector(&self) -> Option<Vec<Integer>> {
        let modulus = &self.0.modulus;
        let bound = Integer::from((modulus >> 1u64).unsigned_abs_ref().floor_sqrt());
        let mut denominator = Integer::from(1);
        let mut out: Vec<Integer> = Vec::with_capacity(self.0.coeffs.len());
        for x in &self.0.coeffs {
            let mut y = if denominator == 1 { x.clone() } else { x * &denominator };
            symmetric(&mut y, modulus);
            if y.unsigned_abs_ref() <= bound.unsigned_abs_ref() {
                out.push(y);
                continue;
            }
            let (p, q) = fraction(y, modulus, &bound)?;
            out.iter_mut().for_each(|z| *z *= &q);
            denominator *= q;
            if denominator.unsigned_abs_ref() > bound.unsigned_abs_ref() {
                return None;
            }
            out.push(p);
        }
        Some(out)
    }
}

fn symmetric(x: &mut Integer, modulus: &Integer) {
    x.mod_assign(modulus);
    if &*x << 1u64 > *modulus {
        *x -= modulus;
    }
}

/// `p / q` with `p = q x` modulo `m` and both at most the bound (Wang).
fn fraction(x: Integer, m: &Integer, bound: &Integer) -> Option<(Integer, Integer)> {
    let bound: &Natural = bound.unsigned_abs_ref();
    let mut residue = x;
    residue.mod_assign(m);
    let mut r0 = m.unsigned_abs_ref().clone();
    let mut r1 = residue.unsigned_abs_ref().clone();
    let (mut t0, mut t1) = (Natural::from(0u32), Natural::from(1u32));
    let mut negative = false;
    while r1 > *bound {
        let (q, r) = (&r0).div_mod(&r1);
        let t = t0 + q * &t1;
        (t0, t1) = (t1, t);
        (r0, r1) = (r1, r);
        negative = !negative;
    }
    (t1 <= *bound && t1 != 0).then(|| (Integer::from_sign_and_abs(!negative, r1), Integer::from(t1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_comes_back() {
        let expected = [(3i64, 7u64), (-5, 14), (0, 1), (100_003, 3)];
        let mut residues = Residues::default();
        for p in crate::arith::modular::large_primes().take(2) {
            let f = PrimeField::new(p);
            let v: Vec<u64> = expected
                .iter()
                .map(|(a, b)| f.mul(f.from_integer(&Integer::from(*a)), f.inverse(f.from_u64(*b))))
                .collect();
            residues.absorb(&f, &v);
        }
        let v = residues.vector().unwrap();
        for ((a, b), x) in expected.iter().zip(&v) {
            assert_eq!(Integer::from(*a) * Integer::from(42) / Integer::from(*b), *x);
        }
    }
}
