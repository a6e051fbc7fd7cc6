//! Exact points of the shape near a point: what was proved must be seen there.

use super::{Agreement, Broken, Law};
use crate::arith::{Rational, abs, to_f64};
use crate::linalg::Matrix;
use crate::radius::Options;
use crate::shape::{Shape, Spaces, difference};
use crate::theorem::smoothness::curve_regularity;
use crate::theorem::{BranchReport, Certified, Outcome, Side, Verdict};

/// Turns of the cycle, in letters, after which secants are looked at; the last are tried only where the first do not do.
const LETTERS: [usize; 4] = [24, 96, 384, 1536];
/// Most cells that are looked at beside a point.
const CELLS: usize = 48;
/// Sines of angles below this one are no deviation.
const SMALL: f64 = 0.02;

/// Whether secants turn to the tangents that were proved, and to the rays.
///
/// Branch and bound proves a tangent for all points of the ring; here a few are looked at, in exact arithmetic and with the
/// operators of the shape itself, not those of the visible quotient.
#[allow(clippy::float_arithmetic, reason = "it looks for contradictions and decides nothing")]
pub(super) fn check(shape: &Shape, found: &Certified) -> Result<Agreement, Broken> {
    let mut agreement = Agreement::default();
    for point in found.points.iter().filter(|p| p.verdict == Verdict::Proved) {
        let Some(tangent) = &point.tangent else { continue };
        let tangent = tangent.to_f64();
        for branch in &point.branches {
            let rays = match branch.side {
                Side::Left => &point.left,
                Side::Right => &point.right,
                Side::Both => &Vec::new(),
            };
            let ray = if rays.len() == 1 { Some(rays[0].to_f64()) } else { None };
            let mut before = f64::INFINITY;
            let mut settled = false;
            for letters in LETTERS {
                let Some(now) = deviation(shape, found, branch, letters, &tangent, ray.as_deref()) else {
                    settled = true;
                    break;
                };
                // Rates of 1/m are a fourth from one look to the next.
                if now < SMALL || now < 0.6 * before && before.is_finite() {
                    settled = true;
                    break;
                }
                before = now;
            }
            if !settled {
                let what = format!("secants at {} stay {before:.3} away from the tangent", branch.address);
                return Err(Broken { law: Law::Sampled, what });
            }
            agreement.compared += 1;
        }
    }
    Ok(agreement)
}

/// The largest sine of the angle of a secant with the tangent (with the ray: 2 where it points backwards); `None` where no
/// point of the shape is seen there.
#[allow(clippy::float_arithmetic, reason = "it looks for contradictions and decides nothing")]
fn deviation(
    shape: &Shape,
    found: &Certified,
    branch: &BranchReport,
    letters: usize,
    tangent: &[f64],
    ray: Option<&[f64]>,
) -> Option<f64> {
    let view = shape.view();
    let cycle = &branch.address.cycle;
    let (prefix, state) = shape.product(shape.start, &branch.address.prefix);
    let (turn, _) = shape.product(state, cycle);
    let turns = letters.div_ceil(cycle.len()).next_multiple_of(2);
    let outer = &(&view * &prefix) * &power(&turn, turns);
    let point = view.apply(&shape.point(shape.start, &branch.address)?);
    let mut largest: Option<f64> = None;
    for word in cells(shape, state) {
        let (inner, end) = shape.product(state, &word);
        let base = &found.states.iter().find(|s| s.state == end)?.base;
        let secant = difference(&outer.apply(&inner.apply(base)), &point);
        let Some(unit) = unit(&secant) else { continue };
        let along: f64 = unit.iter().zip(tangent).map(|(a, b)| a * b).sum();
        let mut sine = (1.0 - along * along).max(0.0).sqrt();
        if let Some(ray) = ray
            && unit.iter().zip(ray).map(|(a, b)| a * b).sum::<f64>() < -0.5
        {
            sine = 2.0;
        }
        largest = Some(largest.map_or(sine, |l| l.max(sine)));
    }
    largest
}

fn power(matrix: &Matrix, exponent: usize) -> Matrix {
    let (mut result, mut square, mut left) = (Matrix::identity(matrix.rows()), matrix.clone(), exponent);
    while left > 0 {
        if left % 2 == 1 {
            result = &result * &square;
        }
        square = &square * &square;
        left /= 2;
    }
    result
}

/// Words of one length that grows until there are some cells.
fn cells(shape: &Shape, state: usize) -> Vec<Vec<usize>> {
    let mut words = vec![(Vec::new(), state)];
    for _ in 0..6 {
        let longer: Vec<(Vec<usize>, usize)> = words
            .iter()
            .flat_map(|(word, e): &(Vec<usize>, usize)| {
                let pieces = shape.states[*e].pieces.iter().enumerate();
                pieces.map(|(i, p)| ([word.as_slice(), &[i]].concat(), p.target)).collect::<Vec<_>>()
            })
            .collect();
        if longer.len() > CELLS {
            break;
        }
        words = longer;
    }
    words.into_iter().map(|(word, _)| word).collect()
}

#[allow(clippy::float_arithmetic, reason = "it looks for contradictions and decides nothing")]
fn unit(v: &[Rational]) -> Option<Vec<f64>> {
    let largest = v.iter().map(abs).max().filter(|x| *x != 0)?;
    let scaled: Vec<f64> = v.iter().map(|x| to_f64(&(x / &largest))).collect();
    let norm = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(scaled.iter().map(|x| x / norm).collect())
}

/// No local Hölder exponent of the curve is below the one that the whole curve is proved to have.
#[allow(clippy::float_arithmetic, reason = "it looks for contradictions and decides nothing")]
pub(super) fn exponents(shape: &Shape, found: &Certified) -> Result<Option<Agreement>, Broken> {
    let Some(spaces) = Spaces::new(shape) else { return Ok(None) };
    let Ok(regularity) = curve_regularity(shape, &spaces, &Options::default()) else { return Ok(None) };
    let Some(exponent) = regularity.exponent else { return Ok(None) };
    let whole = to_f64(&exponent.lo).min(1.0);
    let mut agreement = Agreement::default();
    for branch in found.points.iter().flat_map(|p| &p.branches) {
        if let Outcome::Line { holder, .. } = &branch.outcome {
            let modulus = to_f64(&holder.eigenvalue.modulus(80).mid());
            let local = modulus.ln() / to_f64(&holder.scale).ln();
            agreement.compared += 1;
            if local < whole - 1e-9 {
                let what = format!("exponent {local} at {} and at least {whole} of the whole curve", branch.address);
                return Err(Broken { law: Law::Exponents, what });
            }
        }
    }
    Ok(Some(agreement))
}
