//! Quadratic Hensel lifting of a factorisation modulo a prime.

use super::ints::{self, IntPoly};
use super::modp;
use crate::arith::Integer;
use crate::arith::modular::PrimeField;
use malachite_base::num::arithmetic::traits::{ModAssign, ModInverse, Pow};
use malachite_base::num::logic::traits::SignificantBits;

/// Monic factors of `f / lead` modulo `p^k`, where `p^k` has more than `bits` bits, and `p^k`.
///
/// # Panics
/// If the leading coefficient is 0 modulo `p`.
pub(crate) fn lift(f: &[Integer], field: &PrimeField, factors: &[Vec<u64>], bits: u64) -> (Vec<IntPoly>, Integer) {
    let p = Integer::from(field.modulus());
    let exponent = bits / (field.modulus().significant_bits() - 1) + 1;
    let mut steps = vec![exponent];
    while steps[steps.len() - 1] > 1 {
        steps.push(steps[steps.len() - 1].div_ceil(2));
    }
    let moduli: Vec<Integer> = steps.iter().rev().map(|k| (&p).pow(*k)).collect();
    let top = moduli[moduli.len() - 1].clone();
    let lead = {
        let mut l = f[f.len() - 1].clone();
        l.mod_assign(&top);
        l.unsigned_abs_ref().clone()
    };
    let inverse = Integer::from(lead.mod_inverse(top.unsigned_abs_ref()).expect("an invertible leading coefficient"));
    let monic = reduced(f.iter().map(|c| c * &inverse).collect(), &top);
    let mut out = Vec::with_capacity(factors.len());
    lift_tree(&monic, field, factors, &moduli, &mut out);
    (out, top)
}

fn reduced(mut f: IntPoly, modulus: &Integer) -> IntPoly {
    for c in &mut f {
        c.mod_assign(modulus);
    }
    ints::trim(&mut f);
    f
}

fn lift_tree(f: &IntPoly, field: &PrimeField, factors: &[Vec<u64>], moduli: &[Integer], out: &mut Vec<IntPoly>) {
    if factors.len() == 1 {
        out.push(f.clone());
        return;
    }
    let (left, right) = factors.split_at(factors.len() / 2);
    let product = |list: &[Vec<u64>]| list.iter().fold(vec![field.one()], |acc, g| modp::mul(field, &acc, g));
    let (g, h) = (product(left), product(right));
    let (s, t) = modp::bezout(field, &g, &h);
    let integers = |v: &[u64]| -> IntPoly { v.iter().map(|c| Integer::from(field.to_u64(*c))).collect() };
    let mut state = Pair { g: integers(&g), h: integers(&h), s: integers(&s), t: integers(&t) };
    for (k, modulus) in moduli.iter().enumerate().skip(1) {
        state.step(f, modulus, k + 1 < moduli.len());
    }
    lift_tree(&state.g, field, left, moduli, out);
    lift_tree(&state.h, field, right, moduli, out);
}

/// `f = g h` and `s g + t h = 1`, modulo the current power.
struct Pair {
    g: IntPoly,
    h: IntPoly,
    s: IntPoly,
    t: IntPoly,
}

impl Pair {
    /// Von zur Gathen and Gerhard, algorithm 15.10.
    fn step(&mut self, f: &[Integer], m: &Integer, more: bool) {
        let e = difference(f, &ints::mul(&self.g, &self.h), m);
        let (q, r) = div_rem_monic(&reduced(ints::mul(&self.s, &e), m), &self.h, m);
        let change = sum(&ints::mul(&self.t, &e), &ints::mul(&q, &self.g), m);
        self.g = sum(&self.g, &change, m);
        self.h = sum(&self.h, &r, m);
        if more {
            let one = [Integer::from(1)];
            let b = difference(&sum(&ints::mul(&self.s, &self.g), &ints::mul(&self.t, &self.h), m), &one, m);
            let (c, d) = div_rem_monic(&reduced(ints::mul(&self.s, &b), m), &self.h, m);
            self.s = difference(&self.s, &d, m);
            let change = sum(&ints::mul(&self.t, &b), &ints::mul(&c, &self.g), m);
            self.t = difference(&self.t, &change, m);
        }
    }
}

fn sum(a: &[Integer], b: &[Integer], m: &Integer) -> IntPoly {
    let mut out = a.to_vec();
    out.resize(a.len().max(b.len()), Integer::from(0));
    for (o, x) in out.iter_mut().zip(b) {
        *o += x;
    }
    reduced(out, m)
}

fn difference(a: &[Integer], b: &[Integer], m: &Integer) -> IntPoly {
    let mut out = a.to_vec();
    out.resize(a.len().max(b.len()), Integer::from(0));
    for (o, x) in out.iter_mut().zip(b) {
        *o -= x;
    }
    reduced(out, m)
}

fn div_rem_monic(f: &[Integer], g: &[Integer], m: &Integer) -> (IntPoly, IntPoly) {
    let d = g.len() - 1;
    let mut rest = f.to_vec();
    let mut quotient = vec![Integer::from(0); rest.len().saturating_sub(d)];
    for k in (0..quotient.len()).rev() {
        let mut q = std::mem::take(&mut rest[k + d]);
        q.mod_assign(m);
        if q != 0 {
            for (j, c) in g[..d].iter().enumerate() {
                rest[k + j] -= &q * c;
            }
        }
        quotient[k] = q;
    }
    rest.truncate(d);
    (reduced(quotient, m), reduced(rest, m))
}
