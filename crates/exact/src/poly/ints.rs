//! Integer polynomials: primitive parts, products, exact division, modular gcd, square-free parts.

use super::modp;
use crate::arith::modular::{PrimeField, large_primes};
use crate::arith::{Integer, Natural, Rational};
use malachite_base::num::arithmetic::traits::{AddMulAssign, DivExactAssign, DivRem, Gcd, Lcm, SubMulAssign};
use malachite_base::num::logic::traits::SignificantBits;

/// Integer coefficients, low degree first, without trailing zeros.
pub type IntPoly = Vec<Integer>;

pub(crate) fn trim(f: &mut IntPoly) {
    while f.last().is_some_and(|c| *c == 0) {
        f.pop();
    }
}

/// The least common multiple of the denominators.
pub(crate) fn common_denominator<'a>(values: impl IntoIterator<Item = &'a Rational>) -> Natural {
    let mut d = Natural::from(1u32);
    for q in values.into_iter().map(Rational::denominator_ref).filter(|q| **q != 1) {
        d = d.lcm(q);
    }
    d
}

/// `value * d` for a multiple `d` of the denominator.
pub(crate) fn cleared(value: &Rational, d: &Natural) -> Integer {
    let magnitude = value.numerator_ref() * (d / value.denominator_ref());
    Integer::from_sign_and_abs(*value >= 0, magnitude)
}

pub(crate) fn from_rationals(coeffs: &[Rational]) -> IntPoly {
    let d = common_denominator(coeffs);
    primitive(coeffs.iter().map(|c| cleared(c, &d)).collect())
}

/// The greatest common divisor of the coefficients.
pub(crate) fn content(f: &[Integer]) -> Natural {
    let mut g = Natural::from(0u32);
    for c in f {
        g = g.gcd(c.unsigned_abs_ref());
        if g == 1 {
            break;
        }
    }
    g
}

/// Divided by the content, with a positive leading coefficient.
pub(crate) fn primitive(mut f: IntPoly) -> IntPoly {
    trim(&mut f);
    let g = content(&f);
    let negative = f.last().is_some_and(|c| *c < 0);
    if g > 1 || negative {
        let g = Integer::from_sign_and_abs(!negative, g);
        for c in &mut f {
            c.div_exact_assign(&g);
        }
    }
    f
}

pub(crate) fn derivative(f: &[Integer]) -> IntPoly {
    f.iter().enumerate().skip(1).map(|(k, c)| c * Integer::from(k)).collect()
}

pub(crate) fn mul(f: &[Integer], g: &[Integer]) -> IntPoly {
    if f.is_empty() || g.is_empty() {
        return Vec::new();
    }
    let mut product = vec![Integer::from(0); f.len() + g.len() - 1];
    for (i, a) in f.iter().enumerate().filter(|(_, a)| **a != 0) {
        for (j, b) in g.iter().enumerate() {
            product[i + j].add_mul_assign(a, b);
        }
    }
    product
}

/// The quotient, or `None` when `g` does not divide `f` over the integers.
pub(crate) fn div_exact(f: &[Integer], g: &[Integer]) -> Option<IntPoly> {
    let d = g.len() - 1;
    if f.len() < g.len() {
        return f.is_empty().then(Vec::new);
    }
    let mut rest = f.to_vec();
    let mut quotient = vec![Integer::from(0); rest.len() - d];
    for k in (0..quotient.len()).rev() {
        if rest[k + d] == 0 {
            continue;
        }
        let (q, r) = (&rest[k + d]).div_rem(&g[d]);
        if r != 0 {
            return None;
        }
        for (j, c) in g[..d].iter().enumerate() {
            rest[k + j].sub_mul_assign(&q, c);
        }
        quotient[k] = q;
    }
    rest[..d].iter().all(|c| *c == 0).then_some(quotient)
}

/// The coefficients modulo `p`.
pub(crate) fn residues(f: &[Integer], field: &PrimeField) -> Vec<u64> {
    let mut out: Vec<u64> = f.iter().map(|c| field.from_integer(c)).collect();
    modp::trim(&mut out);
    out
}

/// The largest bit length of a coefficient.
pub(crate) fn height_bits(f: &[Integer]) -> u64 {
    f.iter().map(SignificantBits::significant_bits).max().unwrap_or(0)
}

/// The binary logarithm of a bound for the moduli of all roots (Fujiwara).
pub(crate) fn root_bound(f: &[Integer]) -> i64 {
    let n = f.len() - 1;
    let lead = f[n].significant_bits() as i64 - 1;
    let bits = |k: usize| f[n - k].significant_bits() as i64;
    let ratios = (1..=n).filter(|k| f[n - k] != 0).map(|k| (bits(k) - lead).div_euclid(k as i64) + 1);
    ratios.max().map_or(0, |r| r + 1)
}

/// `f(x + shift)`.
pub(crate) fn taylor_shift(f: &[Integer], shift: &Integer) -> IntPoly {
    let mut out = f.to_vec();
    for i in 0..out.len() {
        for j in (i..out.len() - 1).rev() {
            let (low, high) = out.split_at_mut(j + 1);
            low[j].add_mul_assign(&high[0], shift);
        }
    }
    out
}

/// Roots are far from 0 when their distances are smaller than their sizes by so many bits.
const FAR: u64 = 24;

/// An integer near all roots of a polynomial, where they are close together and far from 0; otherwise 0.
pub(crate) fn far_centre(f: &[Integer]) -> Integer {
    if f.len() < 3 {
        return Integer::from(0);
    }
    let n = f.len() - 1;
    let mean = -&f[n - 1] / (&f[n] * Integer::from(n));
    if mean.significant_bits() < FAR {
        return Integer::from(0);
    }
    let spread = root_bound(&taylor_shift(f, &mean));
    if spread + FAR as i64 <= mean.significant_bits() as i64 { mean } else { Integer::from(0) }
}

/// The primitive gcd with positive leading coefficient, of primitive polynomials.
///
/// Source: Brown's modular algorithm; the candidate is accepted only when it divides both.
pub(crate) fn gcd(f: &[Integer], g: &[Integer]) -> IntPoly {
    if f.is_empty() || g.is_empty() {
        return if f.is_empty() { g.to_vec() } else { f.to_vec() };
    }
    let lead = Integer::from(f[f.len() - 1].unsigned_abs_ref().gcd(g[g.len() - 1].unsigned_abs_ref()));
    let mut image = CrtPoly::default();
    for p in large_primes() {
        let field = PrimeField::new(p);
        let (fp, gp) = (residues(f, &field), residues(g, &field));
        if fp.len() < f.len() || gp.len() < g.len() {
            continue;
        }
        let mut h = modp::gcd(&field, fp, gp);
        if h.len() == 1 {
            return vec![Integer::from(1)];
        }
        let scale = field.from_integer(&lead);
        h.iter_mut().for_each(|c| *c = field.mul(*c, scale));
        if image.coeffs.is_empty() || h.len() < image.coeffs.len() {
            image = CrtPoly::default();
        } else if h.len() > image.coeffs.len() {
            continue;
        }
        if image.absorb(&field, &h) {
            let candidate = primitive(image.coeffs.clone());
            if div_exact(f, &candidate).is_some() && div_exact(g, &candidate).is_some() {
                return candidate;
            }
        }
    }
    unreachable!("there are infinitely many primes")
}

/// Whether `f` has no repeated factor, when a few primes show it; `false` means unknown.
pub(crate) fn squarefree_modulo_some_prime(f: &[Integer]) -> bool {
    large_primes().take(2).any(|p| {
        let field = PrimeField::new(p);
        let fp = residues(f, &field);
        fp.len() == f.len() && {
            let d = modp::derivative(&field, &fp);
            modp::gcd(&field, fp, d).len() == 1
        }
    })
}

/// The square-free decomposition (Yun): pairs of a primitive square-free part and its exponent, of positive degree.
pub(crate) fn squarefree(f: &[Integer]) -> Vec<(IntPoly, usize)> {
    if f.len() <= 1 {
        return Vec::new();
    }
    if f.len() == 2 || squarefree_modulo_some_prime(f) {
        return vec![(f.to_vec(), 1)];
    }
    let df = derivative(f);
    let common = gcd(f, &primitive(df.clone()));
    let divide = |a: &[Integer], b: &[Integer]| div_exact(a, b).expect("a divisor");
    let mut b = divide(f, &common);
    let mut c = divide(&df, &common);
    let mut parts = Vec::new();
    for exponent in 1.. {
        let mut d = c;
        d.resize(d.len().max(b.len()), Integer::from(0));
        for (x, y) in d.iter_mut().zip(derivative(&b)) {
            *x -= y;
        }
        trim(&mut d);
        let part = if d.is_empty() { b.clone() } else { gcd(&b, &primitive(d.clone())) };
        if part.len() > 1 {
            parts.push((part.clone(), exponent));
        }
        b = divide(&b, &part);
        if b.len() <= 1 {
            break;
        }
        c = divide(&d, &part);
    }
    parts
}

/// An integer polynomial known modulo a growing product of primes, in symmetric residues.
#[derive(Debug, Clone, Default)]
pub(crate) struct CrtPoly {
    /// The coefficients, of least absolute value.
    pub coeffs: Vec<Integer>,
    /// The product of the primes so far; 0 before the first.
    pub modulus: Integer,
}

impl CrtPoly {
    /// Combines with the residues modulo one more prime; true when no coefficient changed.
    pub fn absorb(&mut self, field: &PrimeField, residues: &[u64]) -> bool {
        let p = Integer::from(field.modulus());
        if self.modulus == 0 {
            self.coeffs = residues.iter().map(|c| Integer::from(field.to_signed(*c))).collect();
            self.modulus = p;
            return false;
        }
        let inverse = field.inverse(field.from_integer(&self.modulus));
        let next = &self.modulus * &p;
        let half = &next >> 1u64;
        let mut stable = true;
        for (value, residue) in self.coeffs.iter_mut().zip(residues) {
            let difference = field.mul(field.sub(*residue, field.from_integer(value)), inverse);
            if difference != 0 {
                stable = false;
                value.add_mul_assign(&self.modulus, Integer::from(field.to_signed(difference)));
                if *value > half {
                    *value -= &next;
                }
            }
        }
        self.modulus = next;
        stable
    }
}

/// `f(x)` written as `g(x^k)` with the largest possible `k`; `k = 1` for a constant.
pub(crate) fn deflate(f: &[Integer]) -> (IntPoly, usize) {
    let k = f.iter().enumerate().skip(1).filter(|(_, c)| **c != 0).fold(0usize, |k, (i, _)| k.gcd(i)).max(1);
    (f.iter().step_by(k).cloned().collect(), k)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn z(c: &[i64]) -> IntPoly {
        c.iter().map(|x| Integer::from(*x)).collect()
    }

    #[test]
    fn yun_finds_the_exponents() {
        // (x - 1)^3 (2x + 1)^2 (x^2 + 1)
        let mut f = z(&[1, 0, 1]);
        for _ in 0..3 {
            f = mul(&f, &z(&[-1, 1]));
        }
        for _ in 0..2 {
            f = mul(&f, &z(&[1, 2]));
        }
        let parts = squarefree(&f);
        assert_eq!(parts, vec![(z(&[1, 0, 1]), 1), (z(&[1, 2]), 2), (z(&[-1, 1]), 3)]);
    }

    #[test]
    fn gcd_with_large_coefficients() {
        let big = (Integer::from(1) << 150u64) + Integer::from(1);
        let common = vec![-big.clone(), Integer::from(0), big + Integer::from(2)];
        let f = mul(&common, &z(&[1, 1, 1]));
        let g = mul(&common, &z(&[-5, 7]));
        assert_eq!(gcd(&f, &g), primitive(common));
    }

    #[test]
    fn division_tells_when_it_is_not_exact() {
        assert!(div_exact(&z(&[1, 0, 1]), &z(&[1, 1])).is_none());
        assert_eq!(div_exact(&z(&[-1, 0, 1]), &z(&[1, 1])), Some(z(&[-1, 1])));
        assert_eq!(deflate(&z(&[1, 0, 0, 2, 0, 0, 5])), (z(&[1, 2, 5]), 3));
    }
}
