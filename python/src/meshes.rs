//! Meshes of files: the limit surface of these very points.

use crate::doors::{budget, rendered};
use crate::work::outside;
use pyo3::prelude::*;
use secant::budget::Budget;
use secant::diagnostic::{Problem, SourceText};
use secant::mesh::{Found, Model, Scheme, certify};
use secant::picture::mesh::{ply, svg};
use secant::report::{mesh as report, text};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is asked about a mesh.
#[derive(FromPyObject)]
pub struct AskedMesh {
    #[pyo3(item)]
    path: Option<PathBuf>,
    #[pyo3(item)]
    text: Option<String>,
    #[pyo3(item)]
    name: String,
    #[pyo3(item)]
    scheme: String,
    #[pyo3(item)]
    effort: String,
    #[pyo3(item)]
    cells: Option<usize>,
    #[pyo3(item)]
    words: Option<usize>,
}

impl AskedMesh {
    fn budget(&self) -> Result<Budget, Problem> {
        budget(&self.effort, self.cells, self.words)
    }

    fn scheme(&self) -> Result<Scheme, Problem> {
        Scheme::named(&self.scheme).ok_or_else(|| {
            Problem::new("secant::usage::scheme", format!("meshes are not refined by {:?}", self.scheme))
                .with_help(format!("the schemes for meshes are {}", Scheme::ALL.map(Scheme::name).join(", ")))
        })
    }

    fn model(&self) -> Result<Model, Problem> {
        match (&self.text, &self.path) {
            (Some(text), _) => {
                let off = Path::new(&self.name).extension().is_some_and(|e| e.eq_ignore_ascii_case("off"));
                Model::parse(&SourceText::new(self.name.as_str(), text.as_str()), off)
            }
            (None, Some(path)) => Model::read(path),
            (None, None) => Err(Problem::new("secant::mesh::unreadable", "no mesh is given")
                .with_help("give the path of a file in the format OBJ or OFF")),
        }
    }
}

struct Whole {
    model: Model,
    scheme: &'static str,
    found: Found,
}

/// What was found, kept for reports and pictures.
#[pyclass(frozen, module = "secant._secant")]
pub struct MeshFindings(Arc<Whole>);

#[pymethods]
impl MeshFindings {
    /// The results as `html`, `latex` or `markdown`.
    fn report(&self, py: Python<'_>, format: String) -> PyResult<String> {
        let whole = Arc::clone(&self.0);
        outside(py, move || {
            Ok(rendered(&report::document(&whole.model, whole.scheme, &whole.found, None, true), &format))
        })
    }

    /// What the program prints.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let whole = Arc::clone(&self.0);
        outside(py, move || {
            Ok(text::render(&report::document(&whole.model, whole.scheme, &whole.found, None, false), false))
        })
    }

    /// The mesh with its verdicts, where it can be drawn.
    fn svg(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let whole = Arc::clone(&self.0);
        outside(py, move || Ok(svg(&whole.model, &whole.found, &whole.model.name)))
    }

    /// The mesh as PLY, its vertices coloured by verdict.
    fn ply(&self, py: Python<'_>) -> PyResult<String> {
        let whole = Arc::clone(&self.0);
        outside(py, move || Ok(ply(&whole.model, &whole.found)))
    }
}

/// Certifies a mesh: what was found, and the same as JSON.
#[pyfunction]
pub fn mesh(py: Python<'_>, asked: AskedMesh) -> PyResult<(MeshFindings, String)> {
    outside(py, move || {
        let (scheme, budget, model) = (asked.scheme()?, asked.budget()?, asked.model()?);
        let found = certify(&model, scheme, &budget, &|| {})?;
        let data = report::json(&model, scheme.name(), &found, None).to_string();
        Ok((MeshFindings(Arc::new(Whole { model, scheme: scheme.name(), found })), data))
    })
}
