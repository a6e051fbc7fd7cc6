//! The part of a spectrum with the largest modulus, in a form that is checked without factorisation.

use super::written::{Aligned, Written};
use super::{Unsupported, number, numbers, radius, unsupported};
use crate::algebraic::Elem;
use crate::arith::{Integer, Interval, Rational, abs};
use crate::jordan::{Chain, Eigenvalue, Spectral, Spectrum};
use crate::linalg::Matrix;
use crate::poly::Poly;
use malachite_base::num::logic::traits::SignificantBits;
use serde_json::{Value, json};

/// An element of a number field: its coefficients, lowest first.
pub fn element(e: &Elem) -> Value {
    numbers(e.0.coeffs())
}

/// A vector of elements.
pub fn elements(v: &[Elem]) -> Value {
    v.iter().map(element).collect()
}

/// Evidence for the top of the spectrum of `linear`; `lead` is the eigenvalue whose root generates the field.
pub fn top<E: Written>(
    linear: &Matrix<E>,
    spectrum: &E::Spectrum,
    lead: Eigenvalue,
    place: &str,
) -> Result<Value, Unsupported> {
    let Some(radius) = radius::between::<E>(spectrum) else { return unsupported("moduli this close", place) };
    let members = &spectrum.classes()[0].members;
    let count = |m: &Eigenvalue| spectrum.part(m.factor).blocks.len();
    if members.iter().all(|&m| spectrum.value(m).is_real()) {
        let plus = members.iter().filter(|&&m| spectrum.value(m).same(spectrum.value(lead)));
        let most = plus.map(count).fold(0, usize::max);
        let others = members.iter().map(count).fold(0, usize::max);
        if most.max(others) <= 2 {
            let Some(chains) = E::aligned(spectrum, lead) else {
                return unsupported("two eigenvalues of one modulus over different fields", place);
            };
            return Ok(real::<E>(spectrum, lead, &radius, &chains));
        }
    }
    if members.len() == 2 && members.iter().all(|m| count(m) == 1) && !spectrum.value(members[0]).is_real() {
        return pair::<E>(spectrum, &radius, place);
    }
    match E::conformal(linear, spectrum, &radius) {
        Some(value) => Ok(value),
        None => unsupported("a group of equal moduli that is neither real, nor one pair, nor conformal", place),
    }
}

fn real<E: Written>(spectrum: &E::Spectrum, lead: Eigenvalue, radius: &Rational, chains: &[Aligned]) -> Value {
    let part = spectrum.part(lead.factor);
    let bits = radius.denominator_ref().significant_bits();
    let interval = part.places[lead.root].enclosure(E::PLACES + bits).0;
    let chain = |(same, vectors): &Aligned| {
        let vectors: Value = vectors.iter().map(|v| elements(v)).collect();
        json!({"sign": if *same { "+" } else { "-" }, "vectors": vectors})
    };
    json!({
        "top": "real",
        "radius": number(radius),
        "polynomial": E::modulus(spectrum, lead.factor),
        "interval": [number(&interval.lo), number(&interval.hi)],
        "chains": chains.iter().map(chain).collect::<Value>(),
    })
}

/// The vector at `-θ` written at `θ`: `x` becomes `-x`.
pub fn mirrored(v: &[Elem], same: bool) -> Vec<Elem> {
    let flip = |e: &Elem| {
        let coefficients = e.0.coeffs().iter().enumerate();
        Elem(Poly::new(coefficients.map(|(k, c)| if k % 2 == 1 { -c } else { c.clone() }).collect()))
    };
    v.iter().map(|e| if same { e.clone() } else { flip(e) }).collect()
}

fn pair<E: Written>(spectrum: &E::Spectrum, radius: &Rational, place: &str) -> Result<Value, Unsupported> {
    let members = &spectrum.classes()[0].members;
    let upper = |m: &&Eigenvalue| spectrum.value(**m).enclosure(64).1.lo > 0;
    let Some(&lead) = members.iter().find(upper) else {
        return unsupported("a pair none of whose roots is seen above the real axis", place);
    };
    let part = spectrum.part(lead.factor);
    let vectors: Value = part.right.iter().flat_map(|c| &c.vectors).map(|v| elements(v)).collect();
    let (re, im) = part.places[lead.root].enclosure(200);
    let centre = |x: &Interval| number(&Interval::point(x.mid()).outward(200).lo);
    let error = Rational::from(1) / Rational::from(Integer::from(1) << 120u64);
    Ok(json!({
        "top": "pair",
        "radius": number(radius),
        "polynomial": E::modulus(spectrum, lead.factor),
        "centre": [centre(&re), centre(&im)],
        "error": number(&error),
        "vectors": vectors,
    }))
}

/// A rational invariant space with a scalar product that `L` stretches, where all eigenvalues are semisimple and the square
/// of their modulus is rational.
pub fn rational_conformal(linear: &Matrix, spectrum: &Spectrum, radius: &Rational) -> Option<Value> {
    let members = &spectrum.classes[0].members;
    let mut factors: Vec<usize> = members.iter().map(|m| m.factor).collect();
    factors.dedup();
    let listed: usize = factors.iter().map(|&f| spectrum.factors[f].roots.len()).sum();
    if listed != members.len() || factors.iter().any(|&f| spectrum.factors[f].blocks[0] != 1) {
        return None;
    }
    let first = &spectrum.factors[factors[0]].poly;
    let square = match first.degree()? {
        1 => first.coeff(0) * first.coeff(0),
        2 => abs(&first.coeff(0)),
        _ => return None,
    };
    let n = linear.rows();
    let product =
        factors.iter().fold(Matrix::identity(n), |acc, &f| &acc * &evaluate(&spectrum.factors[f].poly, linear));
    let space = product.kernel().transpose().echelon();
    let k = space.rows.rows();
    let images = &space.rows * &linear.transpose();
    let b = Matrix::from_fn(k, k, |i, j| images[(i, space.pivots[j])].clone());
    let gram = invariant_product(&b, &square)?;
    let rows = |m: &Matrix| -> Value { (0..m.rows()).map(|i| numbers(m.row(i))).collect() };
    Some(json!({
        "top": "conformal",
        "radius": number(radius),
        "basis": rows(&space.rows),
        "gram": rows(&gram),
        "square": number(&square),
    }))
}

fn evaluate(p: &Poly, at: &Matrix) -> Matrix {
    let n = at.rows();
    p.coeffs().iter().rev().fold(Matrix::zero(n, n), |acc, c| &(&acc * at) + &Matrix::identity(n).scale(c))
}

/// The mean of the identity under `H -> B H Bᵀ / c`: its component that is fixed, along the image of `Φ − 1`.
fn invariant_product(b: &Matrix, square: &Rational) -> Option<Matrix> {
    let k = b.rows();
    let entry = |i: usize, j: usize| &b[(i / k, j / k)] * &b[(i % k, j % k)] / square;
    let moved = &Matrix::from_fn(k * k, k * k, entry) - &Matrix::identity(k * k);
    let fixed = moved.kernel();
    let spanning = fixed.transpose().stack(&moved.transpose()).transpose();
    let identity = Matrix::from_fn(k * k, 1, |i, _| Rational::from(u8::from(i / k == i % k)));
    let weights = spanning.solve(&identity)?;
    let mean = &fixed * &Matrix::from_fn(fixed.cols(), 1, |i, _| weights[(i, 0)].clone());
    Some(Matrix::from_fn(k, k, |i, j| mean[(i * k + j, 0)].clone()))
}

/// The longest chain of a list.
pub fn longest(chains: &[Chain]) -> Option<&Chain> {
    chains.iter().max_by_key(|c| c.vectors.len())
}
