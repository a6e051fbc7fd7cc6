//! Polynomials over a prime field: division, gcd, powers, distinct-degree and equal-degree factorisation.

use crate::arith::modular::PrimeField;

type Fp = PrimeField;

pub(crate) fn trim(f: &mut Vec<u64>) {
    while f.last() == Some(&0) {
        f.pop();
    }
}

pub(crate) fn derivative(field: &Fp, f: &[u64]) -> Vec<u64> {
    let mut d: Vec<u64> = f.iter().enumerate().skip(1).map(|(k, c)| field.mul(*c, field.from_u64(k as u64))).collect();
    trim(&mut d);
    d
}

pub(crate) fn make_monic(field: &Fp, f: &mut [u64]) {
    if let Some(&lead) = f.last()
        && lead != field.one()
    {
        let inverse = field.inverse(lead);
        f.iter_mut().for_each(|c| *c = field.mul(*c, inverse));
    }
}

pub(crate) fn sub(field: &Fp, f: &[u64], g: &[u64]) -> Vec<u64> {
    let mut out = f.to_vec();
    out.resize(f.len().max(g.len()), 0);
    for (o, c) in out.iter_mut().zip(g) {
        *o = field.sub(*o, *c);
    }
    trim(&mut out);
    out
}

/// Whether so many products of residues, and a residue, fit a word: sums are then reduced once, at the end.
fn is_lazy(field: &Fp, terms: usize) -> bool {
    let p = field.modulus();
    p < 1 << 24 && terms < 1 << 14
}

/// `x / 2^64 mod p`, the reduction of a sum of products.
fn settle(field: &Fp, x: u64) -> u64 {
    field.reduce(u128::from(x))
}

/// Adds `a * b_j` to each entry, for residues of 32 bits.
fn add_scaled(out: &mut [u64], a: u64, b: &[u64]) {
    for (o, x) in out.iter_mut().zip(b) {
        *o += u64::from(a as u32) * u64::from(*x as u32);
    }
}

pub(crate) fn mul(field: &Fp, f: &[u64], g: &[u64]) -> Vec<u64> {
    if f.is_empty() || g.is_empty() {
        return Vec::new();
    }
    let mut out = vec![0; f.len() + g.len() - 1];
    if is_lazy(field, f.len().min(g.len())) {
        for (i, a) in f.iter().enumerate().filter(|(_, a)| **a != 0) {
            add_scaled(&mut out[i..], *a, g);
        }
        out.iter_mut().for_each(|x| *x = settle(field, *x));
        return out;
    }
    for (i, a) in f.iter().enumerate().filter(|(_, a)| **a != 0) {
        for (j, b) in g.iter().enumerate() {
            out[i + j] = field.add(out[i + j], field.mul(*a, *b));
        }
    }
    out
}

/// Quotient and remainder by a polynomial with invertible leading coefficient.
pub(crate) fn div_rem(field: &Fp, mut f: Vec<u64>, g: &[u64]) -> (Vec<u64>, Vec<u64>) {
    let d = g.len() - 1;
    let mut quotient = vec![0; f.len().saturating_sub(d)];
    let inverse = if g[d] == field.one() { g[d] } else { field.inverse(g[d]) };
    if is_lazy(field, quotient.len()) {
        lazy_division(field, &mut f, g, inverse, &mut quotient);
        trim(&mut f);
        return (quotient, f);
    }
    for k in (0..quotient.len()).rev() {
        let q = field.mul(f[k + d], inverse);
        quotient[k] = q;
        if q != 0 {
            for (j, c) in g[..d].iter().enumerate() {
                f[k + j] = field.sub(f[k + j], field.mul(q, *c));
            }
        }
    }
    f.truncate(d);
    trim(&mut f);
    (quotient, f)
}

/// The division for small primes: what is taken from a coefficient is summed up as plain products, in Montgomery form
/// as `x 2^64`, and reduced when the coefficient is used.
fn lazy_division(field: &Fp, f: &mut Vec<u64>, g: &[u64], inverse: u64, quotient: &mut [u64]) {
    let d = g.len() - 1;
    let mut taken = vec![0u64; f.len()];
    for k in (0..quotient.len()).rev() {
        let top = field.sub(f[k + d], settle(field, taken[k + d]));
        let q = field.mul(top, inverse);
        quotient[k] = q;
        if q != 0 {
            add_scaled(&mut taken[k..], q, &g[..d]);
        }
    }
    f.truncate(d);
    for (x, t) in f.iter_mut().zip(&taken) {
        *x = field.sub(*x, settle(field, *t));
    }
}

pub(crate) fn rem(field: &Fp, f: Vec<u64>, g: &[u64]) -> Vec<u64> {
    div_rem(field, f, g).1
}

/// The monic gcd.
pub(crate) fn gcd(field: &Fp, mut f: Vec<u64>, mut g: Vec<u64>) -> Vec<u64> {
    while !g.is_empty() {
        make_monic(field, &mut g);
        let r = rem(field, f, &g);
        f = g;
        g = r;
    }
    make_monic(field, &mut f);
    f
}

/// `(s, t)` with `s f + t g = 1` for coprime `f` and `g`, with `deg s < deg g` and `deg t < deg f`.
pub(crate) fn bezout(field: &Fp, f: &[u64], g: &[u64]) -> (Vec<u64>, Vec<u64>) {
    let (mut r0, mut r1) = (f.to_vec(), g.to_vec());
    let (mut s0, mut s1) = (vec![field.one()], Vec::new());
    let (mut t0, mut t1) = (Vec::new(), vec![field.one()]);
    while !r1.is_empty() {
        let (q, r) = div_rem(field, r0, &r1);
        let s = sub(field, &s0, &mul(field, &q, &s1));
        let t = sub(field, &t0, &mul(field, &q, &t1));
        (r0, r1, s0, s1, t0, t1) = (r1, r, s1, s, t1, t);
    }
    let inverse = field.inverse(r0[0]);
    let scale = |v: Vec<u64>| v.into_iter().map(|c| field.mul(c, inverse)).collect();
    (scale(s0), scale(t0))
}

/// `base^e mod f`.
pub(crate) fn pow_mod(field: &Fp, base: &[u64], e: u64, f: &[u64]) -> Vec<u64> {
    let mut out = rem(field, vec![field.one()], f);
    for bit in (0..64 - e.leading_zeros()).rev() {
        out = rem(field, mul(field, &out, &out), f);
        if e >> bit & 1 == 1 {
            out = rem(field, mul(field, &out, base), f);
        }
    }
    out
}

/// The images `x^(p i) mod f` for `i < deg f`: the matrix of the Frobenius map, one image a row.
fn frobenius(field: &Fp, f: &[u64]) -> Vec<Vec<u64>> {
    let n = f.len() - 1;
    let xp = pow_mod(field, &[0, field.one()], field.modulus(), f);
    let mut rows = Vec::with_capacity(n);
    let mut power = rem(field, vec![field.one()], f);
    for _ in 0..n {
        let next = rem(field, mul(field, &power, &xp), f);
        power.resize(n, 0);
        rows.push(std::mem::replace(&mut power, next));
    }
    rows
}

fn apply_frobenius(field: &Fp, rows: &[Vec<u64>], h: &[u64]) -> Vec<u64> {
    let mut out = vec![0; rows.len()];
    if is_lazy(field, rows.len()) {
        for (row, c) in rows.iter().zip(h).filter(|(_, c)| **c != 0) {
            add_scaled(&mut out, *c, row);
        }
        out.iter_mut().for_each(|x| *x = settle(field, *x));
        trim(&mut out);
        return out;
    }
    for (row, c) in rows.iter().zip(h).filter(|(_, c)| **c != 0) {
        for (o, x) in out.iter_mut().zip(row) {
            *o = field.add(*o, field.mul(*c, *x));
        }
    }
    trim(&mut out);
    out
}

/// The products of the irreducible factors of each degree, `(degree, product)`, of a monic square-free `f`.
pub(crate) fn distinct_degrees(field: &Fp, f: &[u64]) -> Vec<(usize, Vec<u64>)> {
    let mut parts = Vec::new();
    let mut rest = f.to_vec();
    if rest.len() <= 1 {
        return parts;
    }
    let rows = frobenius(field, f);
    let mut h = vec![0, field.one()];
    let mut d = 0;
    while rest.len() > 2 * (d + 1) {
        d += 1;
        h = apply_frobenius(field, &rows, &h);
        let difference = sub(field, &h, &[0, field.one()]);
        let g = gcd(field, rest.clone(), rem(field, difference, &rest));
        if g.len() > 1 {
            rest = div_rem(field, rest, &g).0;
            parts.push((d, g));
        }
    }
    if rest.len() > 1 {
        parts.push((rest.len() - 1, rest));
    }
    parts
}

/// The monic irreducible factors of a product of distinct ones of degree `d` (Cantor–Zassenhaus, fixed seed).
pub(crate) fn equal_degree(field: &Fp, f: Vec<u64>, d: usize, out: &mut Vec<Vec<u64>>) {
    let mut seed = 0x9e37_79b9_7f4a_7c15u64;
    let mut work = vec![f];
    while let Some(f) = work.pop() {
        if f.len() - 1 == d {
            out.push(f);
            continue;
        }
        loop {
            let candidate: Vec<u64> = (0..f.len() - 1).map(|_| next_random(&mut seed) % field.modulus()).collect();
            let split = gcd(field, f.clone(), half_norm(field, candidate, d, &f));
            if split.len() > 1 && split.len() < f.len() {
                work.push(div_rem(field, f, &split).0);
                work.push(split);
                break;
            }
        }
    }
}

/// `a^((p^d - 1) / 2) - 1 mod f`, as a norm: `(a a^p ... a^(p^(d-1)))^((p-1)/2) - 1`.
fn half_norm(field: &Fp, mut a: Vec<u64>, d: usize, f: &[u64]) -> Vec<u64> {
    trim(&mut a);
    let mut norm = a.clone();
    let mut conjugate = a;
    for _ in 1..d {
        conjugate = pow_mod(field, &conjugate, field.modulus(), f);
        norm = rem(field, mul(field, &norm, &conjugate), f);
    }
    let half = pow_mod(field, &norm, (field.modulus() - 1) / 2, f);
    sub(field, &half, &[field.one()])
}

pub(crate) fn next_random(seed: &mut u64) -> u64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_multiply_back() {
        let field = Fp::new(101);
        let mut seed = 5;
        for n in [1usize, 2, 5, 9, 14] {
            let mut f: Vec<u64> = (0..n).map(|_| next_random(&mut seed) % 101).collect();
            f.push(field.one());
            let d = derivative(&field, &f);
            if gcd(&field, f.clone(), d).len() > 1 {
                continue;
            }
            let mut factors = Vec::new();
            for (d, g) in distinct_degrees(&field, &f) {
                equal_degree(&field, g, d, &mut factors);
            }
            let product = factors.iter().fold(vec![field.one()], |acc, g| mul(&field, &acc, g));
            assert_eq!(product, f);
        }
    }

    #[test]
    fn small_primes_agree_with_the_plain_products() {
        let mut seed = 7;
        for p in [3, 101, 16_777_213] {
            let field = Fp::new(p);
            let mut random = |n: usize| -> Vec<u64> { (0..n).map(|_| next_random(&mut seed) % p).collect() };
            for (n, m) in [(1, 1), (4, 9), (30, 17), (200, 90)] {
                let (f, mut g) = (random(n + m), random(m));
                g.push(p - 1);
                let (q, r) = div_rem(&field, f.clone(), &g);
                let mut back = mul(&field, &q, &g);
                for (k, c) in r.iter().enumerate() {
                    back[k] = field.add(back[k], *c);
                }
                assert!(r.len() < g.len());
                assert_eq!(back, f);
                let term = |k: usize| {
                    (0..=k.min(n + m - 1))
                        .filter(|i| k - i < g.len())
                        .fold(0, |sum, i| field.add(sum, field.mul(f[i], g[k - i])))
                };
                assert_eq!(mul(&field, &f, &g), (0..f.len() + g.len() - 1).map(term).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn bezout_identity() {
        let field = Fp::new(10_007);
        let (f, g) = (vec![3, 1, 4, field.one()], vec![5, 9, field.one()]);
        let (s, t) = bezout(&field, &f, &g);
        let sum =
            sub(&field, &mul(&field, &s, &f), &mul(&field, &t, &g).iter().map(|c| field.neg(*c)).collect::<Vec<_>>());
        assert_eq!(sum, vec![field.one()]);
    }
}
