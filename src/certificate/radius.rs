//! A short rational between two neighbouring moduli for which the recursion of Schur and Cohn is regular.

use super::written::Written;
use crate::arith::{Integer, Rational};
use crate::jordan::Spectral;
use malachite_base::num::arithmetic::traits::Floor;

/// How many digits after the binary point a radius has at most.
const MAX_BITS: u64 = 4096;

/// A radius `r > 0` below the modulus of the first class and above that of the second, if one is found.
pub fn between<E: Written>(spectrum: &E::Spectrum) -> Option<Rational> {
    below::<E>(spectrum, 1, &[])
}

/// A radius `r > 0` below the moduli of the first classes, so many, and above the others, for which the recursion is regular for
/// another polynomial as well (given by its coefficients), if one is found.
pub fn below<E: Written>(spectrum: &E::Spectrum, classes: usize, other: &[E]) -> Option<Rational> {
    let own = E::characteristic(spectrum);
    let mut bits = 64;
    while bits <= MAX_BITS {
        if let Some(radius) = with_bits::<E>(spectrum, classes, [&own, other], bits) {
            return Some(radius);
        }
        bits *= 4;
    }
    None
}

fn with_bits<E: Written>(
    spectrum: &E::Spectrum,
    classes: usize,
    [own, other]: [&[E]; 2],
    precision: u64,
) -> Option<Rational> {
    let modulus = |class: usize| {
        let class = spectrum.classes().get(class)?;
        Some(spectrum.value(class.members[0]).modulus(precision + 8))
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
            if is_regular(own, &radius) && (other.is_empty() || is_regular(other, &radius)) {
                return Some(radius);
            }
            multiple += Rational::from(1);
        }
    }
    None
}

/// Whether all pivots of the recursion for `χ(r z)` are nonzero.
fn is_regular<E: Written>(coefficients: &[E], radius: &Rational) -> bool {
    let mut power = Rational::from(1);
    let mut p: Vec<E> = Vec::new();
    for c in coefficients {
        p.push(c.times(&E::of(&power)));
        power *= radius;
    }
    while p.len() > 1 {
        let n = p.len() - 1;
        let delta = p[0].times(&p[0]).minus(&p[n].times(&p[n]));
        let next = (0..n).map(|k| p[0].times(&p[k]).minus(&p[n].times(&p[n - k])).over(&delta)).collect();
        match next {
            Some(next) => p = next,
            None => return false,
        }
    }
    p.first().is_some_and(|c| !c.is_zero())
}
