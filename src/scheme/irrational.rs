//! Schemes with irrational weights, over number fields: Loop, Doo–Sabin and √3 with their published weights at every
//! valence, and the filters of Daubechies.
//!
//! The weights at the centre enter a local matrix as a polynomial (linear for one step, quadratic for the two steps of √3),
//! so that the matrices for rational weights determine it.

use super::{Corners, MeshRule, SchemeError, local_matrix};
use crate::algebraic::Elem;
use crate::algebraic::field::{FieldBuilder, FieldMatrix, Number, NumberField};
use crate::arith::{Rational, ratio};
use crate::linalg::Matrix;

/// The subdivision matrix of the points around a vertex or face, over a number field.
#[derive(Debug, Clone)]
pub struct FieldLocalMatrix {
    /// New points (rows) from old points (columns), row sums 1 (see [`super::LocalMatrix`]).
    pub matrix: FieldMatrix,
    /// Number of points up to each ring; the first number counts the centre.
    pub rings: Vec<usize>,
    /// Steps of the scheme that the matrix stands for.
    pub steps: usize,
}

/// The matrix of a rule at a vertex or in a face of any valence, with its published weights, which may be irrational.
///
/// # Errors
/// As for [`local_matrix`]; [`SchemeError::Irrational`] for the modified butterfly scheme, which is built for rational
/// weights only, and for valences whose cosines need too large a field.
///
/// # Examples
/// ```
/// use secant::scheme::{field_local_matrix, mesh_rule};
/// let one_ring = field_local_matrix(&mesh_rule("loop", &[].into())?, 7, 1)?;
/// assert_eq!((one_ring.matrix.rows(), one_ring.matrix.field().degree()), (8, 3));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn field_local_matrix(rule: &MeshRule, valence: usize, rings: usize) -> Result<FieldLocalMatrix, SchemeError> {
    if valence == 0 {
        return Err(SchemeError::value("valence", &valence, "a vertex inside a mesh has at least 3 neighbours"));
    }
    let mut builder = FieldBuilder::new();
    let cosine = |builder: &mut FieldBuilder, k: usize| {
        let turns = Rational::from(k) / Rational::from(valence);
        builder
            .cos(&turns)
            .map_err(|e| SchemeError::Irrational(format!("valence {valence}: {e}; the weight cos(2π/{valence})")))
    };
    if let Some(star) = rule.star(valence, true)
        && star.near.degree().is_some_and(|d| d > 0)
    {
        let c = cosine(&mut builder, 1)?;
        let (field, t) = (builder.field().clone(), builder.elem(&c).scale(&ratio(2, 1)));
        let coefficients = star.near.coeffs().iter().rev().map(Elem::from_rational);
        let weight = coefficients.fold(Elem::zero(), |value, c| field.mul(&value, &t).add(&c));
        return polynomial(&field, &weight, rule.steps(), |x| local_matrix(&rule.with_near(x), valence, rings));
    }
    if let Some(Corners::Wheel(wheel)) = rule.corners(valence, true)
        && wheel.waving()
        && wheel.total() == 1
    {
        let cosines: Result<Vec<Number>, _> = (0..valence).map(|k| cosine(&mut builder, k)).collect();
        let cosines: Vec<Elem> = cosines?.iter().map(|c| builder.elem(c)).collect();
        let weight = |j: usize| {
            let (plain, waves) = wheel.weight(j, valence);
            waves.iter().fold(Elem::from_rational(&plain), |sum, (m, w)| sum.add(&cosines[*m].scale(w)))
        };
        return dual(rule, builder.field(), &(0..valence).map(weight).collect::<Vec<_>>(), rings);
    }
    let local = local_matrix(rule, valence, rings)?;
    let matrix = FieldMatrix::from_rational(&NumberField::rationals(), &local.matrix);
    Ok(FieldLocalMatrix { matrix, rings: local.rings, steps: local.steps })
}

/// The matrix that depends on a weight as a polynomial of the given degree.
fn polynomial(
    field: &NumberField,
    weight: &Elem,
    degree: usize,
    sample: impl Fn(Rational) -> Result<super::LocalMatrix, SchemeError>,
) -> Result<FieldLocalMatrix, SchemeError> {
    let samples: Result<Vec<_>, _> = (0..=degree).map(|k| sample(Rational::from(k))).collect();
    let samples = samples?;
    // Lagrange's basis at the weight.
    let one = Elem::from_rational(&1.into());
    let at = |k: usize| Rational::from(k);
    let basis: Vec<Elem> = (0..=degree)
        .map(|k| {
            (0..=degree).filter(|j| *j != k).fold(one.clone(), |acc, j| {
                let factor = weight.sub(&Elem::from_rational(&at(j)));
                field.mul(&acc, &factor).scale(&(Rational::from(1) / (at(k) - at(j))))
            })
        })
        .collect();
    let matrices: Vec<&Matrix> = samples.iter().map(|s| &s.matrix).collect();
    Ok(FieldLocalMatrix {
        matrix: combined(field, &matrices, &basis),
        rings: samples[0].rings.clone(),
        steps: samples[0].steps,
    })
}

/// The sum of the matrices, each with a factor in the field.
fn combined(field: &NumberField, matrices: &[&Matrix], factors: &[Elem]) -> FieldMatrix {
    FieldMatrix::from_fn(field, matrices[0].rows(), matrices[0].cols(), |i, j| {
        let terms = matrices.iter().zip(factors).filter(|(m, _)| m[(i, j)] != 0);
        terms.fold(Elem::zero(), |acc, (m, f)| acc.add(&f.scale(&m[(i, j)])))
    })
}

/// The matrix of a dual scheme with given weights in the central face: a mean, with sum 1, of those for unit vectors.
fn dual(rule: &MeshRule, field: &NumberField, weights: &[Elem], rings: usize) -> Result<FieldLocalMatrix, SchemeError> {
    let n = weights.len();
    let unit = |k: usize| (0..n).map(|j| Rational::from(u8::from(j == k))).collect::<Vec<_>>();
    let samples: Result<Vec<_>, _> = (0..n).map(|k| local_matrix(&rule.with_corners(unit(k)), n, rings)).collect();
    let samples = samples?;
    let Some(first) = samples.first() else {
        return Err(SchemeError::value("valence", &n, "a vertex inside a mesh has at least 3 neighbours"));
    };
    let matrices: Vec<&Matrix> = samples.iter().map(|s| &s.matrix).collect();
    Ok(FieldLocalMatrix { matrix: combined(field, &matrices, weights), rings: first.rings.clone(), steps: first.steps })
}

/// A univariate mask of arity 2 over a number field, normalised to `Σ a = 2`.
#[derive(Debug, Clone)]
pub struct FieldMask {
    /// The field of the coefficients.
    pub field: NumberField,
    /// The coefficients, from `a_0`.
    pub coefficients: Vec<Elem>,
}

/// The orthonormal filter of Daubechies with `moments` vanishing moments, 2 or 3 (db2 with 4 taps, db3 with 6), as the mask
/// `a = √2 h`, of extremal phase.
///
/// Source: I. Daubechies, *Orthonormal bases of compactly supported wavelets*, Comm. Pure Appl. Math. 41 (1988).
///
/// # Errors
/// [`SchemeError::Value`] for another number.
pub fn daubechies(moments: usize) -> Result<FieldMask, SchemeError> {
    let Some(texts) = daubechies_texts(moments) else {
        return Err(SchemeError::value("moments", &moments, "the filters with 2 and 3 vanishing moments are built"));
    };
    match NumberField::read(&texts.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok((field, coefficients)) => Ok(FieldMask { field, coefficients }),
        Err((_, e)) => Err(SchemeError::Irrational(e.to_string())),
    }
}

/// The coefficients as expressions; `None` for another number of moments.
pub(super) fn daubechies_texts(moments: usize) -> Option<Vec<String>> {
    let texts: &[&str] = match moments {
        2 => &["(1+sqrt(3))/4", "(3+sqrt(3))/4", "(3-sqrt(3))/4", "(1-sqrt(3))/4"],
        3 => &[
            "(1+sqrt(10)+sqrt(5+2*sqrt(10)))/16",
            "(5+sqrt(10)+3*sqrt(5+2*sqrt(10)))/16",
            "(10-2*sqrt(10)+2*sqrt(5+2*sqrt(10)))/16",
            "(10-2*sqrt(10)-2*sqrt(5+2*sqrt(10)))/16",
            "(5+sqrt(10)-3*sqrt(5+2*sqrt(10)))/16",
            "(1+sqrt(10)-sqrt(5+2*sqrt(10)))/16",
        ],
        _ => return None,
    };
    Some(texts.iter().map(ToString::to_string).collect())
}

impl FieldMask {
    /// The operators `T_e[i][j] = a_{2i−j+e}` of the limit curve (see [`super::Mask`]), every column summing to 1.
    #[must_use]
    pub fn operators(&self) -> Vec<FieldMatrix> {
        let n = self.coefficients.len() - 1;
        let entry = |e: usize, i: usize, j: usize| {
            let index = (2 * i + e).checked_sub(j);
            index.and_then(|k| self.coefficients.get(k)).cloned().unwrap_or_else(Elem::zero)
        };
        (0..2).map(|e| FieldMatrix::from_fn(&self.field, n, n, |i, j| entry(e, i, j))).collect()
    }

    /// The largest `K` for which the sum rules of order `K` hold exactly: `Σ (−1)^k k^j a_k = 0` for all `j < K`.
    #[must_use]
    pub fn sum_rules(&self) -> usize {
        let holds = |order: &usize| {
            let mut sum = Elem::zero();
            for (k, a) in self.coefficients.iter().enumerate() {
                let power = (0..*order).fold(Rational::from(1), |p, _| p * Rational::from(k));
                sum = sum.add(&a.scale(&if k % 2 == 0 { power } else { -power }));
            }
            sum.is_zero()
        };
        (0..self.coefficients.len()).take_while(holds).count()
    }

    /// Whether the integer translates of the limit function are orthonormal: `Σ a_k a_{k+2m} = 2 δ_m`, exactly (a necessary
    /// condition, sufficient for the filters of Daubechies).
    #[must_use]
    pub fn is_orthonormal(&self) -> bool {
        let a = &self.coefficients;
        (0..a.len().div_ceil(2)).all(|m| {
            let products = a.iter().zip(&a[2 * m..]).map(|(x, y)| self.field.mul(x, y));
            let expected = if m == 0 { Elem::from_rational(&2.into()) } else { Elem::zero() };
            products.fold(Elem::zero(), |s, x| s.add(&x)) == expected
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jordan::FieldSpectrum;
    use crate::scheme::mesh_rule;

    #[test]
    fn rational_valences_agree_with_the_rational_matrices() {
        for n in [3, 4, 6] {
            for name in ["loop", "doo-sabin", "sqrt3"] {
                let rule = mesh_rule(name, &[].into()).unwrap();
                let rings = rule.steps();
                let (Ok(found), Ok(expected)) = (field_local_matrix(&rule, n, rings), local_matrix(&rule, n, rings))
                else {
                    panic!("{} at valence {n}", rule.name());
                };
                assert_eq!(found.matrix.rational(), Some(expected.matrix), "{} at valence {n}", rule.name());
                assert_eq!((found.rings, found.steps), (expected.rings, expected.steps));
            }
        }
    }

    #[test]
    fn rows_sum_to_one_and_the_spectrum_of_loop_is_known() {
        let local = field_local_matrix(&mesh_rule("loop", &[].into()).unwrap(), 7, 1).unwrap();
        let a = &local.matrix;
        for i in 0..a.rows() {
            let sum = a.row(i).iter().fold(Elem::zero(), |s, x| s.add(x));
            assert_eq!(sum.is_rational(), Some(ratio(1, 1)));
        }
        // 1, (3/8 + c_k/4) twice for k = 1, 2, 3, and (3/8 + c_1/4)^2 - by Loop's choice of the weight.
        let s = FieldSpectrum::of(a);
        let expected =
            ["1", "3/8 + cos(2*pi/7)/4", "3/8 + cos(4*pi/7)/4", "3/8 + cos(6*pi/7)/4", "(3/8 + cos(2*pi/7)/4)^2"];
        assert_eq!(s.factors.iter().map(|f| f.multiplicity * f.degree()).sum::<usize>(), 8);
        let mut builder = FieldBuilder::new();
        let multiplicities = [1, 2, 2, 2, 1];
        for (text, m) in expected.iter().zip(multiplicities) {
            let x = builder.parse(text).unwrap();
            let root = builder.field().locate(&builder.elem(&x));
            let factor = s.factors.iter().find(|f| f.roots.iter().any(|r| r.same(&root))).expect(text);
            assert_eq!((factor.multiplicity, factor.blocks.as_slice()), (m, &vec![1; m][..]), "{text}");
        }
    }

    #[test]
    fn daubechies_filters_satisfy_what_defines_them() {
        for moments in [2, 3] {
            let mask = daubechies(moments).unwrap();
            assert_eq!(mask.field.degree(), if moments == 2 { 2 } else { 4 });
            assert!(mask.is_orthonormal());
            assert_eq!(mask.sum_rules(), moments);
            for t in mask.operators() {
                for j in 0..t.cols() {
                    let sum = t.column(j).iter().fold(Elem::zero(), |s, x| s.add(x));
                    assert_eq!(sum.is_rational(), Some(ratio(1, 1)));
                }
            }
            // The sum rules put 1, 1/2, …, 2^(1-moments) into the spectrum of each operator.
            let s = FieldSpectrum::of(&mask.operators()[0]);
            for k in 0..moments {
                let power = Rational::from(1) >> k as i64;
                assert!(s.factors.iter().any(|f| f.roots[0].rational() == Some(power.clone())), "2^-{k}");
            }
        }
        assert!(daubechies(4).is_err());
    }
}
