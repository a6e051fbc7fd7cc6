//! The spectra of a matrix, or of the operators of a case that map a state into itself.

use crate::algebraic::Real;
use crate::algebraic::field::FieldMatrix;
use crate::case::matrix_file::{self, Format};
use crate::case::{self, Case, is_over_field};
use crate::certificate::{self, Doubt, Operator};
use crate::diagnostic::{Problem, SourceText};
use crate::jordan::{BUDGET, FieldSpectrum, Spectrum, estimated_field_work, estimated_work};
use crate::linalg::Matrix;
use crate::report::{field_spectrum, spectrum as report};
use serde_json::Value;
use std::path::Path;

/// A matrix over the rationals or over a larger field.
#[derive(Debug, Clone)]
pub enum Entries {
    /// Over the rationals.
    Rational(Matrix),
    /// Over a larger real number field.
    Field(FieldMatrix),
}

impl From<FieldMatrix> for Entries {
    fn from(matrix: FieldMatrix) -> Self {
        match matrix.rational() {
            Some(rational) => Self::Rational(rational),
            None => Self::Field(matrix),
        }
    }
}

/// A matrix with its name, and of a case with its state and piece.
#[derive(Debug, Clone)]
pub struct Named {
    /// What it is called.
    pub name: String,
    /// The matrix.
    pub entries: Entries,
    /// The numbers of the state and the piece.
    pub place: Option<(usize, usize)>,
}

/// What a file gives.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// The matrices.
    pub list: Vec<Named>,
    /// The expanded case, which is written beside a certificate.
    pub beside: Option<String>,
    /// How many decimals were read as the fractions that they write.
    pub decimals: usize,
    /// The text that the checker reads, and the name that it finds there; none where it reads no such file.
    about: Option<(String, String)>,
}

impl Matrices {
    /// The matrices of what somebody writes: a file with a matrix, the literal of one, or a case as for
    /// [`case::asked`]; from the standard input (`-`) a case or a matrix.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with it.
    ///
    /// # Examples
    /// ```
    /// use secant::ask::Matrices;
    /// assert_eq!(Matrices::ask("[[1, 0], [1/2, 1/2]]")?.list.len(), 1);
    /// assert_eq!(Matrices::ask("bspline degree=3")?.list.len(), 2);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn ask(what: &str) -> Result<Self, Problem> {
        let path = Path::new(what);
        if what == "-" {
            let source = SourceText::read(path)?;
            return match case::is_case(&source.text) {
                true => Self::of_case(&source.name, &source.text),
                false => Self::of_matrix(&source.name, &source.text),
            };
        }
        if path.exists() && path.extension().is_none_or(|e| e != "toml") {
            let source = SourceText::read(path)?;
            return Self::of_matrix(&source.name, &source.text);
        }
        if !path.exists() && is_literal(what) {
            return Self::of_matrix("the matrix", what);
        }
        let source = case::asked(what)?;
        Self::of_case(&source.name, &source.text)
    }

    /// The operators of the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`Matrices::ask`].
    pub fn of_case(name: &str, text: &str) -> Result<Self, Problem> {
        match Case::parse(name, text) {
            Err(p) if is_over_field(&p) => Ok(Self::of_field_case(&Case::over_field(name, text)?)),
            case => Ok(Self::of_rational_case(case?)),
        }
    }

    /// The matrix of a text, in one of the forms of [`matrix_file`].
    ///
    /// # Errors
    /// As [`Matrices::ask`].
    ///
    /// # Examples
    /// ```
    /// use secant::ask::{Matrices, exact_spectrum};
    /// let read = Matrices::of_matrix("golden", "2\n(1+sqrt(5))/4 1/4\n0 1/2\n")?;
    /// let found = exact_spectrum(&read.list[0].name, &read.list[0].entries)?;
    /// assert_eq!(found.json()["size"], 2);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn of_matrix(name: &str, text: &str) -> Result<Self, Problem> {
        let file = matrix_file::parse_field(name, text)?;
        let checked = matches!(file.format, Format::Plain | Format::NestedBrackets | Format::NestedBraces);
        let about = checked.then(|| (text.to_owned(), "matrix".to_owned()));
        let list = vec![Named { name: name.to_owned(), entries: file.matrix.into(), place: None }];
        Ok(Self { list, beside: None, decimals: file.decimals, about })
    }

    fn of_rational_case(case: Case) -> Self {
        let mut list = Vec::new();
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                let name = format!("operator {letter} of state {}", state.name);
                let entries = Entries::Rational(piece.op.clone());
                list.push(Named { name, entries, place: Some((index, letter)) });
            }
        }
        let (text, beside) = (case.checked_text().to_string(), case.beside());
        Self { list, beside, decimals: 0, about: Some((text, case.name)) }
    }

    fn of_field_case(case: &Case<Real>) -> Self {
        let mut list = Vec::new();
        let base = crate::theorem::field(&case.shape);
        for (index, state) in case.shape.states.iter().enumerate() {
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(_, p)| p.target == index) {
                let name = format!("operator {letter} of state {}", state.name);
                let op = FieldMatrix::over(&base, piece.op.map(Real::elem));
                list.push(Named { name, entries: op.into(), place: Some((index, letter)) });
            }
        }
        Self { list, beside: None, decimals: 0, about: None }
    }

    /// The certificate of the spectra of all matrices, accepted by the checker.
    ///
    /// # Errors
    /// A [`Problem`] where the format has none: spectra over number fields, literals of several kinds.
    pub fn certificate(&self, found: &[ExactSpectrum]) -> Result<String, Problem> {
        let none = |message: &str, help: &str| Problem::new("secant::certificate::none", message).with_help(help);
        let mut operators = Vec::new();
        for (spectrum, matrix) in found.iter().zip(&self.list) {
            let ExactSpectrum::Rational(spectrum) = spectrum else {
                let message = "the format has no certificates of spectra over number fields";
                return Err(none(message, "leave out --certificate; no certificate was written"));
            };
            operators.push(Operator { place: matrix.place, spectrum });
        }
        let Some((text, name)) = &self.about else {
            let message = "certificates are about plain matrices, rows in nested brackets, and rational cases only";
            return Err(none(message, "write the matrix as plain text: n, then n rows of n numbers"));
        };
        let written = certificate::spectra(name, &operators).map_err(Doubt::from);
        let accepted = written.and_then(|c| certificate::checked(text, c));
        let accepted = accepted
            .map_err(|doubt| none(&doubt.to_string(), "see docs/certificate.md; no certificate was written"))?;
        Ok(accepted.text())
    }
}

/// Whether a text is the literal of a matrix.
fn is_literal(text: &str) -> bool {
    let start = text.trim_start();
    let list = start.starts_with("[[") || start.starts_with("{{") || start.starts_with('[') && text.contains(';');
    list && !start.starts_with("[[[") || text.contains("atrix(") || text.contains("\\begin{")
}

/// The spectrum of a matrix over the rationals or over a larger field.
#[derive(Debug, Clone)]
pub enum ExactSpectrum {
    /// Over the rationals.
    Rational(Box<Spectrum>),
    /// Over a larger field.
    Field(Box<FieldSpectrum>),
}

impl ExactSpectrum {
    /// The spectrum as data.
    #[must_use]
    pub fn json(&self) -> Value {
        match self {
            Self::Rational(spectrum) => report::json(spectrum),
            Self::Field(spectrum) => field_spectrum::json(spectrum),
        }
    }
}

/// The exact spectrum; `name` is shown where that is too much work.
///
/// # Errors
/// A [`Problem`] where the estimated work is over the budget.
pub fn exact_spectrum(name: &str, entries: &Entries) -> Result<ExactSpectrum, Problem> {
    let (work, size) = match entries {
        Entries::Rational(matrix) => (estimated_work(matrix), matrix.rows()),
        Entries::Field(matrix) => (estimated_field_work(matrix), matrix.rows()),
    };
    if work > BUDGET {
        let message = format!("the exact spectrum of {name}, of size {size}, is over the budget");
        return Err(Problem::new("secant::limit", message).with_help("use --approx for a labelled approximation"));
    }
    Ok(match entries {
        Entries::Rational(matrix) => ExactSpectrum::Rational(Box::new(Spectrum::of(matrix))),
        Entries::Field(matrix) => ExactSpectrum::Field(Box::new(FieldSpectrum::of(matrix))),
    })
}
