//! Algebraic numbers: an element of `Q[x] / (f)` at a root of `f`, by the index of that root.

use crate::work::outside;
use pyo3::prelude::*;
use secant::algebraic::{Elem, Root, locate as located, roots};
use secant::arith::{Interval, Rational, parse_rational};
use secant::diagnostic::Problem;
use secant::poly::{Poly, factor};

type Texts = Vec<String>;

fn wrong(message: String) -> Problem {
    Problem::new("secant::number", message).with_help("make algebraic numbers by secant.spectrum or secant.certify")
}

fn poly(coefficients: &[String]) -> Result<Poly, Problem> {
    let read: Result<Vec<Rational>, _> = coefficients.iter().map(|c| parse_rational(c)).collect();
    Ok(Poly::new(read.map_err(|e| wrong(e.to_string()))?))
}

/// The root of an irreducible polynomial.
fn root(polynomial: &[String], index: usize) -> Result<Root, Problem> {
    let f = poly(polynomial)?;
    if !matches!(factor(&f).as_slice(), [(_, 1)]) {
        return Err(wrong("a minimal polynomial is irreducible".to_owned()));
    }
    roots(&f).into_iter().nth(index).ok_or_else(|| wrong(format!("the polynomial has no root {index}")))
}

fn ends(x: &Interval) -> (String, String) {
    (x.lo.to_string(), x.hi.to_string())
}

/// The minimal polynomial of an element at a root, the constant coefficient first, and the index of its value among the roots.
#[pyfunction]
pub fn locate(py: Python<'_>, polynomial: Texts, index: usize, element: Texts) -> PyResult<(Texts, usize)> {
    outside(py, move || {
        let found = located(&Elem(poly(&element)?), &root(&polynomial, index)?);
        Ok((found.minpoly().coeffs().iter().map(ToString::to_string).collect(), found.index()))
    })
}

/// Exact ends of intervals around the real and the imaginary part of an element at a root.
#[pyfunction]
pub fn enclosure(
    py: Python<'_>,
    polynomial: Texts,
    index: usize,
    element: Texts,
    bits: u64,
) -> PyResult<((String, String), (String, String))> {
    outside(py, move || {
        let (re, im) = Elem(poly(&element)?).enclosure(&root(&polynomial, index)?, bits.min(100_000));
        Ok((ends(&re), ends(&im)))
    })
}
