//! For which values of a parameter a scheme converges and is smooth.

use crate::doors::{budget, certificate_json, rendered};
use crate::work::outside;
use pyo3::prelude::*;
use secant::arith::{Rational, parse_rational};
use secant::ask::{Asked, Family};
use secant::case::{FamilyForm, PlaneFamilyCase, Valences, setting};
use secant::diagnostic::Problem;
use secant::radius::family::Search;
use secant::report::text;
use std::sync::Arc;

/// What was found, kept for reports, pictures and certificates.
#[pyclass(frozen, module = "secant._secant")]
pub struct RegionFindings(Arc<Family>);

#[pymethods]
impl RegionFindings {
    /// The tables with the statements as `html`, `latex` or `markdown`.
    fn report(&self, py: Python<'_>, format: String) -> PyResult<String> {
        let found = Arc::clone(&self.0);
        outside(py, move || Ok(rendered(&found.report(), &format)))
    }

    /// What the program prints.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let found = Arc::clone(&self.0);
        outside(py, move || Ok(text::render(&found.document(), false)))
    }

    /// The bars, where there is something to draw.
    fn svg(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let found = Arc::clone(&self.0);
        outside(py, move || Ok(found.svg()))
    }

    /// The certificate, accepted by the checker, with the family that it is about.
    fn certificate(&self, py: Python<'_>) -> PyResult<String> {
        let found = Arc::clone(&self.0);
        outside(py, move || {
            let (certificate, family) = found.certificate()?;
            Ok(certificate_json(&family, &certificate, true))
        })
    }
}

/// The regions of the text of a case, or of a named scheme, as JSON, and the verdict on the whole range.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "they are those of the question")]
pub fn region(
    py: Python<'_>,
    name: String,
    text: Option<String>,
    set: Vec<String>,
    order: Option<usize>,
    valences: Option<String>,
    width: Option<String>,
    hulls: Option<usize>,
    effort: String,
    seconds: Option<f64>,
) -> PyResult<(RegionFindings, String, String)> {
    outside(py, move || {
        let set = set.iter().map(|t| setting(t)).collect::<Result<Vec<_>, _>>()?;
        let budget = budget(&effort, None, None)?;
        let mut search: Search = budget.regions.clone();
        if let Some(seconds) = seconds {
            search = search.within(seconds);
        }
        search.hulls = hulls.unwrap_or(search.hulls);
        if let Some(text) = width {
            search.width = positive(&text)?;
        }
        let valences = valences.map(|text| Valences::parse(&text).map_err(|e| {
            Problem::new("secant::usage::valence", e).with_help("as in valences=[3, 4, 5] or valences=\"3..12\"")
        })).transpose()?;
        let asked = Asked { order, valences, depth: None };
        let found = match text {
            Some(text) => {
                if FamilyForm::of(&text) == FamilyForm::Curve && PlaneFamilyCase::parse(&name, &text, &set)?.is_some() {
                    return Err(Problem::new("secant::python::plane", format!("{name}: two parameters are left free"))
                        .with_help("give one of them a value; `secant region CASE` answers in the plane of two"));
                }
                Family::of_text(&name, &text, &set, &asked, &search, &budget, &|_| {})?
            }
            None => Family::ask(&name, &set, &asked, &search, &budget, &|_| {})?,
        };
        let (data, verdict) = (found.data().to_string(), found.verdict().word().to_owned());
        Ok((RegionFindings(Arc::new(found)), data, verdict))
    })
}

fn positive(text: &str) -> Result<Rational, Problem> {
    parse_rational(text).ok().filter(|x| *x > 0).ok_or_else(|| {
        Problem::new("secant::usage", format!("the width {text} is no positive number"))
            .with_help("gaps that are narrower are left, as in width=\"1e-6\"")
    })
}
