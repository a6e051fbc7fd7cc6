use super::dense::Poly;
use super::hensel::lift;
use super::ints::{self, IntPoly};
use super::modp;
use crate::arith::modular::{PrimeField, primes_above};
use crate::arith::{Integer, sign};
use malachite_base::num::arithmetic::traits::{CheckedSqrt, DivisibleBy, ModAssign};
use malachite_base::num::logic::traits::SignificantBits;

/// The monic irreducible factors over the rationals with their exponents, ordered by degree, then by coefficients.
///
/// Constants have no factors; the zero polynomial has none either.
///
/// # Cost
/// Square-free decomposition (Yun, modular gcd), then Zassenhaus: factorisation modulo a small prime, quadratic Hensel
/// lifting, recombination, which is exponential in the number of modular factors of one irreducible factor.
///
/// Source: von zur Gathen and Gerhard, *Modern Computer Algebra*, chapters 14 and 15.
///
/// # Examples
/// ```
/// use secant_exact::{arith::ratio, poly::{Poly, factor}};
/// let f = Poly::new([4, 0, -4, 0, 1].map(|c| ratio(c, 1)).to_vec()); // (x² − 2)²
/// let factors = factor(&f);
/// assert_eq!((factors[0].0.display("x").as_str(), factors[0].1, factors.len()), ("x^2 - 2", 2, 1));
/// ```
#[must_use]
pub fn factor(f: &Poly) -> Vec<(Poly, usize)> {
    let f = f.primitive();
    // Roots that are close together and far from 0 make long coefficients; a shift makes them short.
    let centre = ints::far_centre(&f);
    if centre == 0 {
        return near_zero(f);
    }
    let back = |(g, e): (Poly, usize)| (Poly::from_ints(&ints::taylor_shift(&g.primitive(), &-&centre)).monic(), e);
    let mut out: Vec<(Poly, usize)> = near_zero(ints::taylor_shift(&f, &centre)).into_iter().map(back).collect();
    out.sort();
    out
}

/// The factors of a primitive polynomial, in order.
fn near_zero(mut f: IntPoly) -> Vec<(Poly, usize)> {
    let mut out = Vec::new();
    let zeros = f.iter().take_while(|c| **c == 0).count();
    if zeros > 0 && zeros < f.len() {
        f.drain(..zeros);
        out.push((Poly::new(vec![0.into(), 1.into()]), zeros));
    }
    for (part, exponent) in ints::squarefree(&f) {
        out.extend(without_units(part).iter().map(|g| (Poly::from_ints(g).monic(), exponent)));
    }
    out.sort();
    out
}

/// The irreducible factors of a primitive square-free polynomial with nonzero constant term. The roots 1 and −1, as stochastic
/// matrices have them, are taken out first: what is left is often irreducible by its degrees modulo primes alone.
fn without_units(mut f: IntPoly) -> Vec<IntPoly> {
    let mut out = Vec::new();
    for unit in [1, -1] {
        let linear = vec![Integer::from(-unit), Integer::from(1)];
        let signed = |(k, c): (usize, &Integer)| if unit < 0 && k % 2 == 1 { -c } else { c.clone() };
        if f.len() > 4
            && f.iter().enumerate().map(signed).sum::<Integer>() == 0
            && let Some(rest) = ints::div_exact(&f, &linear)
        {
            out.push(linear);
            f = rest;
        }
    }
    out.extend(irreducible_factors(f));
    out
}

/// The irreducible factors of a primitive square-free polynomial with nonzero constant term.
fn irreducible_factors(f: IntPoly) -> Vec<IntPoly> {
    match f.len() {
        0 | 1 => Vec::new(),
        2 => vec![f],
        3 => quadratic(f),
        _ => zassenhaus(f),
    }
}

fn quadratic(f: IntPoly) -> Vec<IntPoly> {
    let (c, b, a) = (&f[0], &f[1], &f[2]);
    let discriminant = b * b - Integer::from(4) * a * c;
    if discriminant < 0 {
        return vec![f];
    }
    let Some(root) = discriminant.unsigned_abs_ref().checked_sqrt() else { return vec![f] };
    let root = Integer::from(root);
    let double = Integer::from(2) * a;
    let factor = |numerator: Integer| ints::primitive(vec![-numerator, double.clone()]);
    vec![factor(-b - &root), factor(-b + root)]
}

/// The factorisation modulo one prime, and what the degrees of several primes leave possible.
struct ModularFactors {
    field: PrimeField,
    factors: Vec<Vec<u64>>,
    possible: Vec<bool>,
}

/// Degrees of irreducible factors with the product of those of that degree.
type Degrees = Vec<(usize, Vec<u64>)>;

/// The sums of sub-multisets of the degrees, as a table over `0..=n`.
fn subset_sums(degrees: impl Iterator<Item = usize>, n: usize) -> Vec<bool> {
    let mut sums = vec![false; n + 1];
    sums[0] = true;
    for d in degrees {
        for k in (d..=n).rev() {
            sums[k] |= sums[k - d];
        }
    }
    sums
}

/// Tries several small primes; `None` when their degrees prove `f` irreducible.
fn modular_factors(f: &[Integer]) -> Option<ModularFactors> {
    let n = f.len() - 1;
    let mut possible = vec![true; n + 1];
    let mut best: Option<(PrimeField, Degrees, usize)> = None;
    let mut tried = 0;
    for p in primes_above(100) {
        let field = PrimeField::new(p);
        let mut fp = ints::residues(f, &field);
        let d = modp::derivative(&field, &fp);
        if fp.len() < f.len() || modp::gcd(&field, fp.clone(), d).len() > 1 {
            continue;
        }
        modp::make_monic(&field, &mut fp);
        let parts = modp::distinct_degrees(&field, &fp);
        let degrees = parts.iter().flat_map(|(d, g)| std::iter::repeat_n(*d, (g.len() - 1) / d));
        let count = degrees.clone().count();
        for (old, new) in possible.iter_mut().zip(subset_sums(degrees, n)) {
            *old &= new;
        }
        if (1..n).all(|k| !possible[k]) {
            return None;
        }
        if best.as_ref().is_none_or(|(_, _, c)| count < *c) {
            best = Some((field, parts, count));
        }
        tried += 1;
        let enough = if best.as_ref().is_some_and(|(_, _, c)| *c <= 4) { 4 } else { 12 };
        if tried >= enough {
            break;
        }
    }
    let (field, parts, _) = best?;
    let mut factors = Vec::new();
    for (d, g) in parts {
        modp::equal_degree(&field, g, d, &mut factors);
    }
    factors.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    Some(ModularFactors { field, factors, possible })
}

/// A bound, in bits, for the coefficients of `lead * g` over the monic factors `g` of `f` (Mignotte), with its sign.
fn factor_bits(f: &[Integer]) -> u64 {
    let n = f.len() as u64;
    ints::height_bits(f) + n + n.significant_bits() + 2
}

fn zassenhaus(f: IntPoly) -> Vec<IntPoly> {
    let Some(ModularFactors { field, factors, possible }) = modular_factors(&f) else { return vec![f] };
    let (lifted, modulus) = lift(&f, &field, &factors, factor_bits(&f));
    recombine(f, lifted, &modulus, &possible)
}

/// The residue of least absolute value.
fn symmetric(mut x: Integer, modulus: &Integer) -> Integer {
    x.mod_assign(modulus);
    if &x * Integer::from(2) > *modulus { x - modulus } else { x }
}

fn recombine(mut f: IntPoly, mut lifted: Vec<IntPoly>, modulus: &Integer, possible: &[bool]) -> Vec<IntPoly> {
    let mut out = Vec::new();
    let mut size = 1;
    while 2 * size <= lifted.len() {
        let mut chosen: Vec<usize> = (0..size).collect();
        let mut found = None;
        loop {
            if let Some((g, rest)) = try_subset(&f, &lifted, &chosen, modulus, possible) {
                found = Some((g, rest));
                break;
            }
            if !next_subset(&mut chosen, lifted.len()) {
                break;
            }
        }
        match found {
            Some((g, rest)) => {
                out.push(g);
                f = rest;
                let mut position = 0;
                lifted.retain(|_| {
                    position += 1;
                    !chosen.contains(&(position - 1))
                });
            }
            None => size += 1,
        }
    }
    if f.len() > 1 {
        out.push(f);
    }
    out
}

/// The next subset of `0..n` of the same size, in lexicographic order.
fn next_subset(chosen: &mut [usize], n: usize) -> bool {
    let k = chosen.len();
    for i in (0..k).rev() {
        if chosen[i] < n - k + i {
            chosen[i] += 1;
            for j in i + 1..k {
                chosen[j] = chosen[j - 1] + 1;
            }
            return true;
        }
    }
    false
}

fn try_subset(
    f: &[Integer],
    lifted: &[IntPoly],
    chosen: &[usize],
    modulus: &Integer,
    possible: &[bool],
) -> Option<(IntPoly, IntPoly)> {
    let degree: usize = chosen.iter().map(|&i| lifted[i].len() - 1).sum();
    if degree >= f.len() || !possible[degree] {
        return None;
    }
    let lead = &f[f.len() - 1];
    let constant = chosen.iter().fold(lead.clone(), |acc, &i| symmetric(acc * &lifted[i][0], modulus));
    if constant == 0 || !(lead * &f[0]).divisible_by(&constant) {
        return None;
    }
    let mut product = vec![lead.clone()];
    for &i in chosen {
        product = ints::mul(&product, &lifted[i]).into_iter().map(|c| symmetric(c, modulus)).collect();
    }
    let candidate = ints::primitive(product);
    let rest = ints::div_exact(f, &candidate)?;
    Some((candidate, rest))
}

/// The different rational roots, ascending.
///
/// # Examples
/// ```
/// use secant_exact::{arith::ratio, poly::{Poly, rational_roots}};
/// let f = Poly::new([1, -3, 2].map(|c| ratio(c, 1)).to_vec()); // (x − 1)(2x − 1)
/// assert_eq!(rational_roots(&f), [ratio(1, 2), ratio(1, 1)]);
/// ```
#[must_use]
pub fn rational_roots(f: &Poly) -> Vec<crate::arith::Rational> {
    let mut roots: Vec<_> =
        factor(f).into_iter().filter(|(g, _)| g.degree() == Some(1)).map(|(g, _)| -g.coeff(0)).collect();
    roots.sort();
    debug_assert!(roots.iter().all(|r| sign(&f.eval(r)) == 0));
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    fn p(c: &[i64]) -> Poly {
        Poly::new(c.iter().map(|x| ratio(*x, 1)).collect())
    }

    fn check(f: &Poly, degrees: &[(usize, usize)]) {
        let factors = factor(f);
        let product = factors.iter().fold(p(&[1]), |acc, (g, e)| &acc * &g.pow(*e));
        assert_eq!(product, f.monic());
        assert_eq!(factors.iter().map(|(g, e)| (g.degree().unwrap(), *e)).collect::<Vec<_>>(), degrees);
    }

    #[test]
    fn known_factorisations() {
        check(&p(&[-1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]), &[(1, 1), (1, 1), (2, 1), (2, 1), (2, 1), (4, 1)]);
        check(&p(&[1, 0, 0, 0, 1]), &[(4, 1)]);
        check(&p(&[1, 0, -10, 0, 1]), &[(4, 1)]);
        check(&p(&[4, 0, 0, 0, 1]), &[(2, 1), (2, 1)]);
        check(&(&p(&[-1, 3]).pow(3) * &p(&[0, 0, 1, 1])), &[(1, 3), (1, 2), (1, 1)]);
        check(&p(&[7]), &[]);
        // 1 and −1 once, and several times.
        check(&(&p(&[-1, 0, 1]) * &p(&[3, 5, 0, 1, 7])), &[(1, 1), (1, 1), (4, 1)]);
        check(&(&(&p(&[1, 1]).pow(2) * &p(&[-1, 1]).pow(3)) * &p(&[2, 0, 0, 0, 0, 1])), &[(1, 3), (1, 2), (5, 1)]);
    }

    #[test]
    fn swinnerton_dyer_of_degree_16_is_irreducible() {
        let coefficients: [i64; 17] =
            [46_225, 0, -5_596_840, 0, 13_950_764, 0, -7_453_176, 0, 1_513_334, 0, -141_912, 0, 6_476, 0, -136, 0, 1];
        check(&p(&coefficients), &[(16, 1)]);
    }

    #[test]
    fn many_rational_roots() {
        let f = (1..=20).fold(p(&[1]), |acc, k| &acc * &p(&[-k, 21 - k]));
        let roots = rational_roots(&f);
        assert_eq!(roots.len(), 20);
        assert_eq!(roots[0], ratio(1, 20));
    }
}
