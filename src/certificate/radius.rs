//! A short rational between two neighbouring moduli for which the recursion of Schur and Cohn is regular.

use crate::arith::{Integer, Rational};
use crate::jordan::Spectrum;
use malachite_base::num::arithmetic::traits::Floor;

/// How many digits after the binary point a radius has at most.
const MAX_BITS: u64 = 4096;

/// A radius `r > 0` below the modulus of the first class and above that of the second, if one is found.
pub fn between(spectrum: &Spectrum) -> Option<Rational> {
    below(spectrum, 1, &[])
}

/// A radius `r > 0` below the moduli of the first classes, so many, and above the others, for which the recursion is regular for
/// another polynomial as well (given by its coefficients), if one is found.
pub fn below(spectrum: &Spectrum, classes: usize, other: &[Rational]) -> Option<Rational> {
    let mut bits = 64;
    while bits <= MAX_BITS {
        if let Some(radius) = with_bits(spectrum, classes, other, bits) {
            return Some(radius);
        }
        bits *= 4;
    }
    None
}

fn with_bits(spectrum: &Spectrum, classes: usize, other: &[Rational], precision: u64) -> Option<Rational> {
    let modulus = |class: usize| {
        let class = spectrum.classes.get(class)?;
        Some(spectrum.root(class.members[0]).modulus(precision + 8))
    };
    let upper = modulus(classes - 1)?.lo;
    let lower = modulus(classes).map_or_else(|| Rational::from(0), |m| m.hi);
    if lower >= upper {
        return None;
    }
    for bits in 0..precision {
        let scale = Rational::from(Integer::from(1) << bits);
        let mut multiple = Rational::from((&lower * &scale).floor()) + Rational::from(1);
        for _ in 0..16 {
            let radius = &multiple / &scale;
            if radius >= upper {
                break;
            }
            if is_regular(spectrum.char_poly.coeffs(), &radius) && (other.is_empty() || is_regular(other, &radius)) {
                return Some(radius);
            }
            multiple += Rational::from(1);
        }
    }
    None
}

/// Whether all pivots of the recursion for `χ(r z)` are nonzero.
fn is_regular(coefficients: &[Rational], radius: &Rational) -> bool {
    let mut power = Rational::from(1);
    let mut p: Vec<Rational> = Vec::new();
    for c in coefficients {
        p.push(c * &power);
        power *= radius;
    }
    while p.len() > 1 {
        let n = p.len() - 1;
        let delta = &p[0] * &p[0] - &p[n] * &p[n];
        if delta == 0 {
            return false;
        }
        p = (0..n).map(|k| (&p[0] * &p[k] - &p[n] * &p[n - k]) / &delta).collect();
    }
    p.first().is_some_and(|c| *c != 0)
}
