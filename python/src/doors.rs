//! The questions, each as a function with JSON as its answer.

use crate::work::{exception, outside};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use secant::ask::{self, Answered, Matrices};
use secant::budget::{Budget, Effort};
use secant::case::{Case, Question, Valences};
use secant::certificate::sha256;
use secant::diagnostic::{Problem, SourceText};
use secant::prove;
use secant::radius::Options;
use secant::report::document::Document;
use secant::report::proof::Level;
use secant::report::{findings, html, latex, markdown, text};
use secant::theorem::Required;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;

/// What `certify` is asked about, and how hard it tries.
#[derive(FromPyObject)]
pub struct Asked {
    #[pyo3(item)]
    path: Option<PathBuf>,
    #[pyo3(item)]
    text: Option<String>,
    #[pyo3(item)]
    name: String,
    #[pyo3(item)]
    addresses: Vec<String>,
    #[pyo3(item)]
    valences: Option<String>,
    #[pyo3(item)]
    check: bool,
    #[pyo3(item)]
    effort: String,
    #[pyo3(item)]
    cells: Option<usize>,
    #[pyo3(item)]
    words: Option<usize>,
    #[pyo3(item)]
    require: Option<String>,
}

/// The limits of a search.
pub fn budget(effort: &str, cells: Option<usize>, words: Option<usize>) -> Result<Budget, Problem> {
    let known = [Effort::Quick, Effort::Normal, Effort::Hard].into_iter().find(|e| e.word() == effort);
    let known = known.ok_or_else(|| {
        Problem::new("secant::usage", format!("effort is not {effort:?}"))
            .with_help("it is \"quick\", \"normal\" or \"hard\"")
    })?;
    let mut budget = Budget::of(known);
    budget.cells = cells.unwrap_or(budget.cells);
    budget.words = words.unwrap_or(budget.words);
    Ok(budget)
}

impl Asked {
    fn budget(&self) -> Result<Budget, Problem> {
        budget(&self.effort, self.cells, self.words)
    }

    fn required(&self) -> Result<Required, Problem> {
        let Some(text) = &self.require else { return Ok(Required::default()) };
        Required::parse(text).map_err(|e| {
            Problem::new("secant::usage::require", e.to_string())
                .with_help("a list of ends, joints, dense, points, inside, g1, c1, c2, …, as in \"ends,g1\"")
        })
    }

    /// The text of a case and its name; what is no file and no case is what somebody writes: a scheme, a mask, a symbol.
    fn question(&self) -> Result<Question, Problem> {
        let question = match (&self.path, &self.text, &self.valences) {
            (Some(path), _, None) => Question::read(path)?,
            (None, Some(text), None) => Question::parse(&self.name, text)?,
            (None, None, None) => Question::ask(&self.name)?,
            (path, text, Some(valences)) => {
                let valences = Valences::parse(valences).map_err(|e| {
                    Problem::new("secant::usage::valence", e).with_help("write 5, \"3..32\", \"3,5,8\" or \"all\"")
                })?;
                match (path, text) {
                    (Some(path), _) => {
                        let source = SourceText::read(path)?;
                        Question::parse_at_valences(&source.name, &source.text, valences)?
                    }
                    (None, Some(text)) => Question::parse_at_valences(&self.name, text, valences)?,
                    (None, None) => Question::at_valences(&self.name, valences)?,
                }
            }
        };
        self.addresses.iter().try_fold(question, |question, text| question.with_address(text))
    }
}

/// A document as `html`, `latex` or `markdown`.
pub fn rendered(document: &Document, format: &str) -> String {
    match format {
        "html" => html::render(document),
        "latex" => latex::render(document),
        _ => markdown::render(document),
    }
}

/// What was found, kept for reports and pictures.
#[pyclass(frozen, module = "secant._secant")]
pub struct Findings {
    answered: Arc<Answered>,
    required: Required,
}

#[pymethods]
impl Findings {
    /// The proof as `html`, `latex` or `markdown`.
    fn report(&self, py: Python<'_>, format: String, level: String) -> PyResult<String> {
        let level = match level.as_str() {
            "summary" => Level::Summary,
            "proof" => Level::Proof,
            "full" => Level::Full,
            _ => return Err(PyValueError::new_err("level is \"summary\", \"proof\" or \"full\"")),
        };
        let answered = Arc::clone(&self.answered);
        outside(py, move || {
            let document = findings::proof_at(&answered.findings, level);
            Ok(rendered(&document, &format))
        })
    }

    /// What the program prints.
    fn summary(&self, py: Python<'_>, verbose: bool) -> PyResult<String> {
        let (answered, required) = (Arc::clone(&self.answered), self.required.clone());
        outside(py, move || Ok(text::render(&findings::summary(&answered.findings, &required, verbose), false)))
    }

    /// The picture as PNG.
    fn png(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        let answered = Arc::clone(&self.answered);
        outside(py, move || answered.bitmap(secant::picture::PIXELS))
    }

    /// The picture.
    fn svg(&self, py: Python<'_>, cones: bool) -> PyResult<String> {
        let answered = Arc::clone(&self.answered);
        outside(py, move || answered.picture(cones))
    }
}

/// Answers a question: what was found, the report as JSON, and the text of the case.
///
/// The certificate stands in the JSON with the text that a checker reads and both digests; none where there is none.
#[pyfunction]
pub fn certify(py: Python<'_>, asked: Asked) -> PyResult<(Findings, String, String, Option<String>)> {
    outside(py, move || {
        let question = asked.question()?;
        let answered = ask::answered(&question, asked.check, &asked.budget()?, &|| {})?;
        let required = asked.required()?;
        let (json, certificate) = (answered.json(&required, false).to_string(), certificate(&answered, asked.check));
        let text = question.text().text.to_string();
        Ok((Findings { answered: Arc::new(answered), required }, json, text, certificate))
    })
}

/// The certificate with the text that it is about.
fn certificate(answered: &Answered, check: bool) -> Option<String> {
    let (written, checked) = match &answered.evidence {
        Some(Ok(certificate)) => (certificate.text(), true),
        Some(Err(_)) => return None,
        None if check => return None,
        None => (prove::unconfirmed(&answered.findings).ok()?.text(), false),
    };
    let about = match &answered.findings {
        secant::Findings::Tangents { case, .. } => case.checked_text().to_string(),
        other => other.text().text.to_string(),
    };
    Some(certificate_json(&about, &written, checked))
}

/// A certificate with the text that it is about, and both digests.
pub fn certificate_json(about: &str, certificate: &str, checked: bool) -> String {
    json!({ "case": about, "text": certificate, "digest": sha256(certificate), "case_digest": sha256(about), "checked": checked })
        .to_string()
}

/// The spectra of a matrix (`case` false) or of the operators of a case, as JSON, and their certificate where there is one.
#[pyfunction]
pub fn spectra(py: Python<'_>, name: String, text: String, case: bool) -> PyResult<(String, Option<String>)> {
    outside(py, move || {
        let read = if case { Matrices::of_case(&name, &text)? } else { Matrices::of_matrix(&name, &text)? };
        let found =
            read.list.iter().map(|m| ask::exact_spectrum(&m.name, &m.entries)).collect::<Result<Vec<_>, _>>()?;
        let one = |(f, m): (&ask::ExactSpectrum, &ask::Named)| json!({ "name": m.name, "spectrum": f.json() });
        let list: Value = found.iter().zip(&read.list).map(one).collect();
        let about = read.beside.clone().unwrap_or(text);
        let certificate = read.certificate(&found).ok().map(|c| certificate_json(&about, &c, true));
        Ok((list.to_string(), certificate))
    })
}

/// Bounds of a joint spectral radius as JSON, and their certificate where there is one.
#[pyfunction]
pub fn jsr(
    py: Python<'_>,
    name: String,
    text: String,
    seconds: Option<f64>,
    longest: Option<usize>,
    width: Option<f64>,
) -> PyResult<(String, Option<String>)> {
    let mut options = Options::default();
    options.longest = longest.unwrap_or(options.longest);
    options.width = width.unwrap_or(options.width);
    if let Some(seconds) = seconds {
        options = options.within(seconds);
    }
    outside(py, move || {
        let found = ask::radius(&name, &text, &options)?;
        let certificate = found.certificate().ok().map(|c| certificate_json(&text, &c, true));
        Ok((found.json().to_string(), certificate))
    })
}

/// The smoothness of the text of a case, or of what somebody writes, as JSON, and whether anything is decided.
#[pyfunction]
pub fn regularity(
    py: Python<'_>,
    name: String,
    text: Option<String>,
    parameters: Vec<String>,
    arity: usize,
) -> PyResult<(String, bool)> {
    outside(py, move || {
        let found = match &text {
            Some(text) => ask::regularity_of_case(&name, text)?,
            None => ask::regularity(&name, &parameters, arity)?,
        };
        let mut data = found.data;
        data["summary"] = json!(found.text);
        Ok((data.to_string(), found.decided))
    })
}

/// The unknown entries of the text of a case as JSON, the case with the solution, and the certificate.
#[pyfunction]
pub fn solve(
    py: Python<'_>,
    name: String,
    text: String,
    set: Vec<String>,
) -> PyResult<(String, Option<String>, Option<String>)> {
    outside(py, move || {
        let case = Case::parse_open(&name, &text)?;
        // Sides of faces and reversals have no certificates: the solutions are then given without one.
        let solved = match ask::solve(&case, &set, true) {
            Err(problem) if problem.id() == "secant::certificate::none" => ask::solve(&case, &set, false)?,
            solved => solved?,
        };
        let mut data = solved.json;
        data["summary"] = json!(solved.text);
        let certificate = solved.certificate.map(|c| certificate_json(&text, &c, true));
        Ok((data.to_string(), solved.case, certificate))
    })
}

/// What the independent checker says of a certificate, as JSON.
#[pyfunction]
pub fn check(py: Python<'_>, case: String, certificate: String) -> PyResult<String> {
    outside(py, move || {
        let answer = match secant_check::check_while(&case, &certificate, secant::stop::check) {
            Ok(accepted) => json!({
                "accepted": true,
                "case": accepted.case,
                "verdict": accepted.verdict.word(),
                "claims": accepted.claims.iter().map(ToString::to_string).collect::<Vec<_>>(),
                "points": accepted.points.iter().map(ToString::to_string).collect::<Vec<_>>(),
            }),
            Err(rejected) => json!({
                "accepted": false,
                "rule": rejected.rule,
                "place": rejected.place,
                "why": rejected.why,
                "unreadable": rejected.unreadable,
            }),
        };
        Ok(answer.to_string())
    })
}

/// The exact coefficients of a wavelet's scaling filter, as expressions, where secant knows it.
#[pyfunction]
pub fn wavelet_mask(name: &str) -> Option<Vec<String>> {
    secant::scheme::wavelet_mask(name)
}

/// The text of a file, with the diagnostics of the reader of cases.
#[pyfunction]
pub fn case_text(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    SourceText::read(&path).map(|source| source.text.to_string()).map_err(|problem| exception(py, &problem))
}
