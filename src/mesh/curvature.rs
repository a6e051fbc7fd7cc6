//! The size of the curvature at a vertex for almost all control points: the eigenvalues after `1, λ, λ` against `λ²`, exactly
//! (docs/theory.md, “Size of the curvature”).

use super::interval::Float;
use super::number::{Number, Numbers};
use super::scheme::Scheme;
use crate::arith::{Rational, ratio};
use crate::poly::Poly;
use crate::ring::{Field as _, Fixed, Ordered as _, Ring as _};
use crate::vertex::block::{Block, Vertex};
use crate::vertex::field::{Enclosures, Field as _};
use crate::vertex::net::Net;
use crate::vertex::ring::{RINGS, Values, patches};
use crate::vertex::solve::eigenvector;
use crate::vertex::turning::{Rotation, Turning};
use std::cmp::Ordering;

/// Binary places of the eigenfunctions that are compared.
const PLACES: u64 = 192;

/// What becomes of the principal curvatures on late rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// They tend to 0.
    Vanishing,
    /// They are bounded, and not all tend to 0.
    Bounded,
    /// They are unbounded.
    Unbounded,
}

/// Whether the surface is C² at the vertex, for almost all points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Second {
    /// It is, and all curvatures are 0 there.
    Flat,
    /// It is, as everywhere on the spline: the vertex is regular.
    Regular,
    /// It is not.
    No,
    /// Not decided.
    Open,
}

/// The curvature at a valence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvature {
    /// Their size.
    pub size: Size,
    /// Whether the surface is C².
    pub second: Second,
    /// Bounds of `ρ/λ²`.
    pub ratio: Float,
    /// Of unbounded curvatures the exponent `p*`: they are in `L^p` for `p < p*`. A decimal.
    pub exponent: Option<f64>,
}

/// An eigenvalue after `1, λ, λ`: how it compares with `λ²`, and bounds.
type Other = (Ordering, Float);

/// The curvature at a valence at which Theorem 7 or 9 proves the scheme C¹; `None` below 3, and where an eigenvalue is
/// `λ²` at a vertex that is not regular and a Jordan block is not excluded.
///
/// # Examples
/// ```
/// use secant::mesh::{Scheme, Second, Size, curvature};
/// let at = |n| curvature(Scheme::CatmullClark, n).map(|c| (c.size, c.second));
/// assert_eq!(at(3), Some((Size::Vanishing, Second::Flat)));
/// assert_eq!(at(4), Some((Size::Bounded, Second::Regular)));
/// assert_eq!(at(5), Some((Size::Unbounded, Second::No)));
/// ```
#[must_use]
pub fn curvature(scheme: Scheme, valence: usize) -> Option<Curvature> {
    if valence < 3 {
        return None;
    }
    let k = Numbers::new(valence);
    let (lambda, others, regular) = if scheme.triangles() {
        let lambda = Number { u: Poly::new(vec![ratio(3, 8), ratio(1, 8)]), v: Poly::zero() };
        let others = triangles(&k, &lambda, scheme)?;
        (lambda, others, 6)
    } else {
        let lambda = Number { u: Poly::constant(ratio(1, 4)), v: Poly::constant(ratio(1, 16)) };
        let others = quads(&k, &lambda)?;
        (lambda, others, 4)
    };
    let near = |x: &Number| {
        let (enclosures, value) = k.enclosure(x, false);
        Float::around(&enclosures.to_interval(&value))
    };
    let most = others.iter().map(|o| o.0).max()?;
    let square = near(&lambda) * near(&lambda);
    // The largest eigenvalue lies between the largest of the lower and of the upper bounds.
    let rho = others.iter().fold(Float::ZERO, |m, o| Float { lo: m.lo.max(o.1.lo), hi: m.hi.max(o.1.hi) });
    let (size, second) = match most {
        Ordering::Less => (Size::Vanishing, Second::Flat),
        Ordering::Greater => (Size::Unbounded, Second::No),
        Ordering::Equal if valence == regular => (Size::Bounded, Second::Regular),
        // Of Loop's the eigenvalue of block 0, which is simple there.
        Ordering::Equal if regular == 6 => {
            let differs = differs_from_square(scheme, valence).is_some_and(|differs| differs);
            (Size::Bounded, if differs { Second::No } else { Second::Open })
        }
        Ordering::Equal => return None,
    };
    let exponent = (size == Size::Unbounded).then(|| exponent(near(&lambda).mid(), rho.mid()));
    Some(Curvature { size, second, ratio: rho.over(square), exponent })
}

#[allow(clippy::float_arithmetic, reason = "a decimal for display")]
fn exponent(lambda: f64, rho: f64) -> f64 {
    -2.0 * lambda.ln() / (rho.ln() - 2.0 * lambda.ln())
}

/// Whether the eigenfunction `H` of `λ²` in block 0 of Loop's scheme is no multiple of `|Ψ|²`: two points of the ring with
/// different quotients.
fn differs_from_square(scheme: Scheme, valence: usize) -> Option<bool> {
    let vertex = Vertex::new(&scheme.rule().ok()?, valence, RINGS).ok()?;
    let (still, turning) = (vertex.block(0).ok()?, vertex.block(1).ok()?);
    let k = Enclosures::of_angle(1, valence, PLACES);
    let lambda = k.add(&k.rational(&ratio(3, 8)), &k.scale(&k.twice_cosine(), &ratio(1, 8)));
    let own = |block: &Block, index: usize, value: &Fixed| -> Option<Values<Fixed>> {
        let part = block.parts.iter().position(|p| p.indices.contains(&index))?;
        eigenvector(&k, block, part, value)
    };
    let height = own(&still, 0, &k.mul(&lambda, &lambda))?;
    let map = own(&turning, turning.before + vertex.orbit((1, 0))?, &lambda)?;
    // In block 0 nothing turns: ω = 1, and x + y ω is x + y.
    let heights = spots(&k, patches(&vertex, &Enclosures::of_angle(0, 1, PLACES), &height)?);
    let places = spots(&k, patches(&vertex, &k, &map)?);
    let mut quotients = Vec::new();
    for (h, z) in heights.iter().zip(&places) {
        quotients.push(k.mul(&k.add(&h.x, &h.y), &k.inv(&Rotation(&k).norm(z))?));
    }
    let first = quotients.first()?;
    Some(quotients.iter().any(|q| k.sign(&k.sub(q, first)).is_some_and(|s| s != 0)))
}

/// The values at the corners of patches and of their halves.
fn spots(k: &Enclosures, nets: Vec<Net<Turning<Fixed>>>) -> Vec<Turning<Fixed>> {
    let half = |a: &Turning<Fixed>, b: &Turning<Fixed>| Rotation(k).scale(&Rotation(k).add(a, b), &ratio(1, 2));
    nets.into_iter()
        .flat_map(|net| {
            let (left, right) = net.halves_by(half);
            [left, right].into_iter().flat_map(|n| n.corners().into_iter().cloned().collect::<Vec<_>>())
        })
        .collect()
}

/// The larger root of `x² − s x + p`, whose roots are real and not negative, against `x`.
fn root(k: &Numbers, sum: &Number, product: &Number, x: &Number) -> Option<Other> {
    let value = k.times(x, x).minus(&k.times(sum, x)).plus(product);
    let beyond = x.plus(x).minus(sum);
    let order = match (k.sign(&value)?, k.sign(&beyond)?) {
        (1, 1) => Ordering::Less,
        (0, 0 | 1) => Ordering::Equal,
        _ => Ordering::Greater,
    };
    let near = |x: &Number| {
        let (enclosures, value) = k.enclosure(x, false);
        Float::around(&enclosures.to_interval(&value))
    };
    let s = near(sum);
    let half = (s * s - near(product).times(4)).root();
    Some((order, (s + half).divided(2)))
}

fn compared(k: &Numbers, eigenvalue: &Number, square: &Number) -> Option<Other> {
    let order = k.sign(&eigenvalue.minus(square))?.cmp(&0);
    let (enclosures, value) = k.enclosure(eigenvalue, false);
    Some((order, Float::around(&enclosures.to_interval(&value))))
}

/// `2 cos(4π/n)`.
fn second_cosine(k: &Numbers) -> Poly {
    let t = Poly::new(vec![Rational::from(0), Rational::from(1)]);
    &k.product(&t, &t) - &Poly::constant(ratio(2, 1))
}

/// The largest eigenvalue of each kind of Catmull and Clark's scheme besides `1, λ, λ`.
fn quads(k: &Numbers, lambda: &Number) -> Option<Vec<Other>> {
    let n = k.valence as i64;
    let square = k.times(lambda, lambda);
    let constant = |p, q| Number::rational(&ratio(p, q));
    let mut all = vec![
        compared(k, &constant(1, 8), &square)?,
        root(k, &constant(3 * n - 7, 4 * n), &constant(n - 3, 16 * n), &square)?,
    ];
    // The second root of block 1 is (10 + t)/16 − λ.
    let sum = Number { u: Poly::new(vec![ratio(10, 16), ratio(1, 16)]), v: Poly::zero() };
    all.push(compared(k, &sum.minus(lambda), &square)?);
    if n >= 4 {
        let sum =
            Number { u: (&second_cosine(k) + &Poly::constant(ratio(10, 1))).scale(&ratio(1, 16)), v: Poly::zero() };
        all.push(root(k, &sum, &constant(1, 16), &square)?);
    }
    Some(all)
}

/// The same of Loop's.
fn triangles(k: &Numbers, lambda: &Number, scheme: Scheme) -> Option<Vec<Other>> {
    let square = k.times(lambda, lambda);
    let mut all = vec![compared(k, &Number::rational(&ratio(1, 8)), &square)?];
    let centre = match scheme.weight(k.valence) {
        Some(w) => Number::rational(&(ratio(5, 8) - w)),
        // 5/8 − (5/8 − λ²).
        None => square.clone(),
    };
    all.push(compared(k, &centre, &square)?);
    if k.valence >= 4 {
        let value = (&second_cosine(k) + &Poly::constant(ratio(3, 1))).scale(&ratio(1, 8));
        all.push(compared(k, &Number { u: value, v: Poly::zero() }, &square)?);
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUADS: Scheme = Scheme::CatmullClark;
    const LOOP: Scheme = Scheme::Loop;
    const WARREN: Scheme = Scheme::LoopWarren;

    #[test]
    #[allow(clippy::float_arithmetic, reason = "decimals")]
    fn the_published_sizes() {
        use Size::{Bounded, Unbounded, Vanishing};
        for (scheme, n, size, ratio, exponent) in [
            (QUADS, 3, Vanishing, 0.99100, None),
            (QUADS, 4, Bounded, 1.0, None),
            (QUADS, 5, Unbounded, 1.12437, Some(10.200)),
            (QUADS, 6, Unbounded, 1.2204, Some(5.475)),
            (QUADS, 7, Unbounded, 1.2894, Some(4.040)),
            (QUADS, 8, Unbounded, 1.3388, Some(3.376)),
            (QUADS, 12, Unbounded, 1.43854, Some(2.500)),
            (LOOP, 3, Unbounded, 2.0, Some(4.0)),
            (LOOP, 4, Bounded, 1.0, None),
            (LOOP, 5, Bounded, 1.0, None),
            (LOOP, 6, Bounded, 1.0, None),
            (LOOP, 7, Unbounded, 1.1332, Some(10.127)),
            (LOOP, 8, Unbounded, 1.2317, Some(5.707)),
            (LOOP, 12, Unbounded, 1.4291, Some(2.941)),
            (WARREN, 4, Unbounded, 16.0 / 9.0, None),
            (WARREN, 5, Unbounded, 1.22229, None),
            (WARREN, 3, Unbounded, 2.0, None),
            (WARREN, 7, Unbounded, 1.1332, None),
        ] {
            let found = curvature(scheme, n).unwrap();
            assert_eq!(found.size, size, "{scheme:?} {n}");
            assert!((found.ratio.mid() - ratio).abs() < 6e-5, "{scheme:?} {n}: {:?}", found.ratio);
            if let Some(exponent) = exponent {
                assert!((found.exponent.unwrap() - exponent).abs() < 6e-3, "{scheme:?} {n}: {:?}", found.exponent);
            }
            let flat = matches!((size, n), (Vanishing, 3));
            assert_eq!(found.second == Second::Flat, flat);
        }
        // H/|Ψ|² is no constant: 0.97963 and 0.99714 are quotients of two of its values.
        assert_eq!([4, 5].map(|n| curvature(LOOP, n).unwrap().second), [Second::No; 2]);
        // At the regular vertex it is one.
        assert_eq!(differs_from_square(LOOP, 6), Some(false));
        assert_eq!(curvature(LOOP, 6).unwrap().second, Second::Regular);
        assert!(curvature(QUADS, 2).is_none());
    }

    /// 1/6 against (49 + 9√17)/512 at valence 3: closer than one part in a hundred.
    #[test]
    fn the_closest_case_is_exact() {
        let k = Numbers::new(3);
        let lambda = Number { u: Poly::constant(ratio(1, 4)), v: Poly::constant(ratio(1, 16)) };
        let sixth = Number::rational(&ratio(1, 6));
        assert_eq!(k.sign(&k.times(&lambda, &lambda).minus(&sixth)), Some(1));
    }
}
