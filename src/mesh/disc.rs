//! The disc on two rings of points around a vertex, for these very points.

use super::interval::Float;
use super::refine::Floats;
use super::scheme::Scheme;
use super::tail::{Rings, Tail};
use crate::linalg::Matrix;
use crate::scheme::{MeshRule, disc_places};
use crate::vertex::AtValence;

/// The number of rings that were tested one by one, where all patches of the disc are immersed and the leading coefficients of the
/// points are independent (docs/theory.md, “A whole mesh”, *rings*); `None` where this is not known, or the rule is none of
/// [`Scheme`]. `control` has the points as columns, in the plane or in space, in the order of [`crate::scheme::disc`].
#[must_use]
pub fn immersed_disc(rule: &MeshRule, at: &AtValence, control: &Matrix) -> Option<usize> {
    let scheme = Scheme::named(rule.info().name).filter(|s| s.rule().is_ok_and(|own| own == *rule))?;
    let places = disc_places(rule, at.valence).ok()?;
    if !(2..=3).contains(&control.rows()) || control.cols() != places.len() {
        return None;
    }
    let tail = Tail::new(scheme, at.valence, at.top.as_ref()?, &Floats::new(scheme, [at.valence])).ok()?;
    // The outermost of the three rings of points on which a ring of patches depends is made by the first step.
    let mut net = vec![[Float::UNKNOWN; 3]; tail.points()];
    for (column, place) in places.iter().enumerate() {
        let at = match place {
            None => 0,
            Some((sector, place)) => tail.at(*sector, *place)?,
        };
        let part = |k: usize| if k < control.rows() { Float::of(&control[(k, column)]) } else { Float::ZERO };
        net[at] = std::array::from_fn(part);
    }
    match tail.rings(&tail.step(&net)) {
        Rings::Immersed(tested) => Some(tested),
        Rings::Open(..) | Rings::Slow(_) | Rings::Dependent => None,
    }
}

#[cfg(test)]
#[allow(clippy::float_arithmetic, reason = "points of examples")]
mod tests {
    use super::*;
    use crate::arith::Rational;
    use crate::vertex::at_valence;

    /// The points on rays in space, with heights.
    fn found(scheme: Scheme, n: usize, height: impl Fn(i64, i64) -> i64) -> Option<usize> {
        let rule = scheme.rule().unwrap();
        let places = disc_places(&rule, n).unwrap();
        let point = |k: usize, c: usize| {
            let Some((sector, (i, j))) = places[c] else {
                return Rational::from(if k == 2 { height(0, 0) } else { 0 });
            };
            let spoke = |s: usize| {
                let angle = std::f64::consts::TAU * (s % n) as f64 / n as f64;
                [(100.0 * angle.cos()).round() as i64, (100.0 * angle.sin()).round() as i64]
            };
            let (a, b, i, j) = (spoke(sector), spoke(sector + 1), i as i64, j as i64);
            Rational::from(if k == 2 { height(i, j) } else { i * a[k] + j * b[k] })
        };
        let control = Matrix::from_fn(3, places.len(), point);
        immersed_disc(&rule, &at_valence(&rule, n).unwrap(), &control)
    }

    #[test]
    fn flat_and_wavy_discs() {
        for (scheme, n) in [(Scheme::CatmullClark, 5), (Scheme::CatmullClark, 3), (Scheme::Loop, 7)] {
            assert!(found(scheme, n, |_, _| 0).is_some(), "{scheme:?} {n}");
            assert!(found(scheme, n, |i, j| 10 * (i * i - j)).is_some(), "{scheme:?} {n}");
        }
    }

    #[test]
    fn folded_discs_are_not_proved() {
        let rule = Scheme::CatmullClark.rule().unwrap();
        let at = at_valence(&rule, 5).unwrap();
        let line = Matrix::from_fn(2, 31, |i, j| Rational::from((j * j * i + j) as u64));
        assert!(immersed_disc(&rule, &at, &line).is_none());
        // A point far out, over the other side, turns outer patches over.
        let places = disc_places(&rule, 5).unwrap();
        let flat = |k: usize, c: usize| match (k, places[c]) {
            (_, Some((0, (2, 0)))) => Rational::from(-9),
            (k, Some((s, (i, j)))) => {
                let spoke = [[10, 0], [3, 9], [-8, 6], [-8, -6], [3, -9]];
                Rational::from(i as i64 * spoke[s][k] + j as i64 * spoke[(s + 1) % 5][k])
            }
            (_, None) => Rational::from(0),
        };
        assert!(immersed_disc(&rule, &at, &Matrix::from_fn(2, 31, flat)).is_none());
    }
}
