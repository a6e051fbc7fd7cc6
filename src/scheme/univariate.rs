//! The masks of univariate schemes, by formula.

use super::{Laurent, Mask, SchemeError};
use crate::arith::{Rational, ratio};
use crate::ring::{Field, Rationals};

/// Largest degree of the families with a degree.
pub const MAX_DEGREE: usize = 48;

fn size(what: &'static str, size: usize, limit: usize) -> Result<(), SchemeError> {
    if size > limit { Err(SchemeError::Large { what, size, limit }) } else { Ok(()) }
}

/// The uniform B-spline of a degree from 1: `a(z) = m ((1 + … + z^(m−1))/m)^(degree+1)` (Lane and Riesenfeld, *A theoretical
/// development for the computer generation and display of piecewise polynomial surfaces*, IEEE PAMI 2, 1980).
///
/// # Errors
/// [`SchemeError::Large`], and those of [`Mask::new`] (degree 0 is a constant).
pub fn bspline(degree: usize, arity: usize) -> Result<Mask, SchemeError> {
    size("degree", degree, MAX_DEGREE)?;
    if !(2..=super::MAX_ARITY).contains(&arity) {
        return Err(SchemeError::Arity(arity));
    }
    let scale = Rational::from(1) / Rational::from(arity as u64);
    let factor = Laurent::geometric(arity).scale(&scale);
    let symbol = factor.pow(degree + 1).scale(&Rational::from(arity as u64));
    Mask::new(arity, symbol.coefficients().to_vec())
}

/// The interpolatory scheme on `points` (an even number) points, whose new points lie on the interpolating polynomial of
/// degree `points − 1` (Deslauriers and Dubuc, *Symmetric iterative interpolation processes*, Constr. Approx. 5, 1989).
///
/// # Errors
/// [`SchemeError::Value`] for an odd number or 0, [`SchemeError::Large`].
pub fn dubuc_deslauriers(points: usize) -> Result<Mask, SchemeError> {
    size("number of points", points, MAX_DEGREE)?;
    if points == 0 || points % 2 == 1 {
        return Err(SchemeError::value("points", &points, "an even number of points is needed, 2, 4, 6, …"));
    }
    let half = points as i64 / 2;
    let nodes: Vec<i64> = (1 - half..=half).collect();
    // Lagrange's basis at 1/2: ∏ (1/2 − x_k)/(x_j − x_k).
    let weight = |j: i64| {
        let others = nodes.iter().filter(|k| **k != j);
        others.fold(Rational::from(1), |w, k| w * ratio(1 - 2 * k, 2 * (j - k)))
    };
    let mut coefficients = vec![Rational::from(0); 2 * points - 1];
    coefficients[points - 1] = Rational::from(1);
    for (k, &node) in nodes.iter().enumerate() {
        coefficients[2 * k] = weight(node);
    }
    Mask::new(2, coefficients)
}

/// The interpolatory 4-point scheme with tension `w`, `(−w, 0, 1/2 + w, 1, 1/2 + w, 0, −w)` (Dyn, Levin and Gregory, *A
/// 4-point interpolatory subdivision scheme for curve design*, CAGD 4, 1987). `w = 1/16` is Dubuc and Deslauriers's.
///
/// # Errors
/// Those of [`Mask::new`].
pub fn four_point(w: &Rational) -> Result<Mask, SchemeError> {
    Mask::new(2, four_point_over(&Rationals, w))
}

/// The coefficients of [`four_point`] over any field.
pub(super) fn four_point_over<K: Field>(k: &K, w: &K::E) -> Vec<K::E> {
    let (o, side) = (k.zero(), k.add(&k.rational(&ratio(1, 2)), w));
    mirrored(k, &[k.neg(w), o, side])
}

/// Hormann and Sabin's family with cubic precision, `a(z) = (1+z)^k/2^(k−1) (1 − (k/8)(1−z)²/z)` (*A family of subdivision
/// schemes with cubic precision*, CAGD 25, 2008). `k = 4` is the 4-point scheme, `k = 5` the dual 4-point scheme.
///
/// # Errors
/// [`SchemeError::Large`], and those of [`Mask::new`].
pub fn hormann_sabin(k: usize) -> Result<Mask, SchemeError> {
    size("k", k, MAX_DEGREE)?;
    let spline = Laurent::new(0, vec![ratio(1, 2), ratio(1, 2)]).pow(k).scale(&Rational::from(2));
    let k8 = ratio(k as i64, 8);
    let middle = Rational::from(1) + &k8 * Rational::from(2);
    let factor = Laurent::new(-1, vec![-&k8, middle, -k8]);
    Mask::new(2, spline.mul(&factor).coefficients().to_vec())
}

/// The ternary interpolatory 3-point scheme with parameter `b` (Hassan and Dodgson, *Ternary and three-point univariate
/// subdivision schemes*, Curve and Surface Fitting: Saint-Malo 2002).
///
/// # Errors
/// Those of [`Mask::new`].
pub fn ternary_three_point(b: &Rational) -> Result<Mask, SchemeError> {
    Mask::new(3, ternary_three_point_over(&Rationals, b))
}

/// The coefficients of [`ternary_three_point`] over any field.
pub(super) fn ternary_three_point_over<K: Field>(k: &K, b: &K::E) -> Vec<K::E> {
    let number = |p, q| k.rational(&ratio(p, q));
    let (a, c) = (k.sub(b, &number(1, 3)), k.sub(&number(4, 3), &k.scale(b, &ratio(2, 1))));
    mirrored(k, &[a, k.zero(), b.clone(), c])
}

/// The ternary interpolatory 4-point scheme with parameter `mu` (Hassan, Ivrissimtzis, Dodgson and Sabin, *An interpolating
/// 4-point C² ternary stationary subdivision scheme*, CAGD 19, 2002).
///
/// # Errors
/// Those of [`Mask::new`].
pub fn ternary_four_point(mu: &Rational) -> Result<Mask, SchemeError> {
    Mask::new(3, ternary_four_point_over(&Rationals, mu))
}

/// The coefficients of [`ternary_four_point`] over any field.
pub(super) fn ternary_four_point_over<K: Field>(k: &K, mu: &K::E) -> Vec<K::E> {
    let number = |p, q| k.rational(&ratio(p, q));
    let (sixth, half) = (k.scale(mu, &ratio(1, 6)), k.scale(mu, &ratio(1, 2)));
    let outer = [k.add(&number(-1, 18), &sixth), k.sub(&number(-1, 18), &sixth), k.zero()];
    let inner = [k.sub(&number(7, 18), &half), k.add(&number(13, 18), &half)];
    mirrored(k, &[outer.as_slice(), inner.as_slice()].concat())
}

/// `half`, 1, `half` backwards.
fn mirrored<K: Field>(k: &K, half: &[K::E]) -> Vec<K::E> {
    let mut all = half.to_vec();
    all.push(k.one());
    all.extend(half.iter().rev().cloned());
    all
}
