//! The exact derivatives of a patch at a parameter.

use super::patch::places;
use crate::base::{Checked, Q, bits, need, some, spend, whole};
use crate::vertex::patch::quartic;
use num_traits::{One, Signed, Zero};

/// A uniform cubic B-spline segment at a parameter: the weights of its four points in the value, and in the derivative.
fn cubic(t: &Q) -> [[Q; 4]; 2] {
    let (one, sixth, half) = (Q::one(), Q::new(1.into(), 6.into()), Q::new(1.into(), 2.into()));
    let (rest, square) = (&one - t, t * t);
    let cube = &square * t;
    let value = [
        &rest * &rest * &rest,
        &cube * whole(3) - &square * whole(6) + whole(4),
        &square * whole(3) - &cube * whole(3) + t * whole(3) + &one,
        cube,
    ];
    let slope = [-(&rest * &rest), &square * whole(3) - t * whole(4), t * whole(2) - &square * whole(3) + &one, square];
    [value.map(|x| x * &sixth), slope.map(|x| x * &half)]
}

/// The terms of degree 3 in a triangle: the exponents of the second and third corner, and how many there are.
const CUBIC: [(usize, usize, i64); 10] =
    [(0, 0, 1), (1, 0, 3), (2, 0, 3), (3, 0, 1), (0, 1, 3), (1, 1, 6), (2, 1, 3), (0, 2, 3), (1, 2, 3), (0, 3, 1)];

/// `t^k`.
fn power(t: &Q, k: usize) -> Q {
    num_traits::pow(t.clone(), k)
}

/// The weights of the points in the derivatives of a patch in both variables, in the order of [`places`].
fn weights(triangle: bool, u: &Q, v: &Q) -> Checked<[Vec<Q>; 2]> {
    if !triangle {
        let ([a, da], [b, db]) = (cubic(u), cubic(v));
        let all = |a: &[Q; 4], b: &[Q; 4]| b.iter().flat_map(|y| a.iter().map(move |x| x * y)).collect();
        return Ok([all(&da, &b), all(&a, &db)]);
    }
    let known = places(true);
    let masks = quartic();
    // The control points of degree 4 by rows: the exponents of the second corner, then of the third.
    let at = |i: usize, j: usize| &masks[(0..j).map(|r| 5 - r).sum::<usize>() + i];
    let w = Q::one() - u - v;
    let mut both = [vec![Q::zero(); known.len()], vec![Q::zero(); known.len()]];
    for (i, j, count) in CUBIC {
        let k = 3 - i - j;
        let factor = power(u, i) * power(v, j) * power(&w, k) * whole(count) / whole(6);
        for (sum, ahead) in both.iter_mut().zip([at(i + 1, j), at(i, j + 1)]) {
            for (mask, sign) in [(ahead, 1), (at(i, j), -1)] {
                for (place, weight) in mask {
                    let p = known.iter().position(|q| q == place);
                    let p = some(p, "whole", "a point of a mask that is none of the patch")?;
                    sum[p] += &factor * whole(sign * weight);
                }
            }
        }
    }
    Ok(both)
}

/// Demands that the derivatives of the patch with these points are dependent at a parameter.
pub fn is_dependent(triangle: bool, points: &[&[Q; 3]], u: &Q, v: &Q) -> Checked<()> {
    let inside = |x: &Q| !x.is_negative() && *x <= Q::one();
    let fits = inside(u) && inside(v) && (!triangle || u + v <= Q::one());
    need(fits, "whole", "a parameter outside the patch")?;
    spend(2000, bits(u) + bits(v) + 256)?;
    let [a, b] = weights(triangle, u, v)?.map(|w| -> [Q; 3] {
        std::array::from_fn(|k| points.iter().zip(&w).fold(Q::zero(), |sum, (p, w)| sum + &p[k] * w))
    });
    let minor = |k: usize| &a[k] * &b[(k + 1) % 3] - &a[(k + 1) % 3] * &b[k];
    need((0..3).all(|k| minor(k).is_zero()), "whole", "the derivatives are independent there")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives of linear and of quadratic nets, which the splines reproduce.
    #[test]
    fn derivatives_of_polynomials() {
        let (u, v) = (Q::new(1.into(), 3.into()), Q::new(1.into(), 5.into()));
        for triangle in [false, true] {
            let both = weights(triangle, &u, &v).unwrap();
            let of = |f: &dyn Fn(i64, i64) -> i64| {
                both.each_ref().map(|w| {
                    places(triangle).iter().zip(w).fold(Q::zero(), |sum, ((i, j), w)| sum + whole(f(*i, *j)) * w)
                })
            };
            assert_eq!(of(&|_, _| 1), [Q::zero(), Q::zero()]);
            assert_eq!(of(&|i, _| i), [Q::one(), Q::zero()]);
            assert_eq!(of(&|_, j| j), [Q::zero(), Q::one()]);
            // The net i² is that of x² and a constant.
            assert_eq!(of(&|i, _| i * i), [whole(2) * &u, Q::zero()]);
            assert_eq!(of(&|_, j| j * j), [Q::zero(), whole(2) * &v]);
        }
    }
}
