//! What a case file asks, as its table says: the tangents of a shape, or smoothness at the vertices of a mesh.

use super::node::{File, Table};
use super::{Case, MAX_LETTERS, Valences, VertexCase, asked};
use crate::algebraic::Real;
use crate::arith::{Rational, parse_rational};
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Entry;
use crate::scheme::{Heading, complex_text};
use crate::shape::{Address, CellKind, Complex, Shape};
use std::path::Path;
use std::sync::Arc;

/// A question that [`crate::prove()`] answers.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Question {
    /// The tangents of a curve, a set or a surface, at its own points, at those that its file names, and at further ones.
    Tangents {
        /// The shape and the points that the file names.
        case: Arc<Case>,
        /// Further points, after those of the file.
        further: Vec<Address>,
    },
    /// The tangents of a curve or a set with entries in a real number field.
    OverField {
        /// The shape and the points that the file names.
        case: Arc<Case<Real>>,
        /// Further points, after those of the file.
        further: Vec<Address>,
    },
    /// Smoothness at the extraordinary vertices of a rule on meshes.
    Vertices {
        /// The rule.
        case: Arc<VertexCase>,
        /// The valences; `None` where neither the file nor anybody else names any.
        valences: Option<Valences>,
    },
}

/// What a question is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Subject {
    /// A curve.
    Curve,
    /// A set without an order.
    Set,
    /// A surface.
    Surface,
    /// The vertices of a mesh.
    Vertices,
}

impl Question {
    /// Reads the question of a case file; `-` is the standard input.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with the file. Entries left open (`"?"`) are refused.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        Self::read_open(path)?.closed()
    }

    /// As [`Question::read`] for a file in which entries may be left open.
    ///
    /// # Errors
    /// As [`Question::read`], apart from open entries.
    pub fn read_open(path: &Path) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse_open(&source.name, &source.text)
    }

    /// The same of a text; where an entry is irrational, over the field of the entries.
    fn parse_open(name: &str, text: &str) -> Result<Self, Problem> {
        let text = &*super::valued(name, text)?;
        match super::read::parsed(name, text, File::new, Self::of_table) {
            Err(problem) if super::is_over_field(&problem) => {
                let case = Case::over_field(name, text)?;
                let irrational = crate::shape::entries(&case.shape).any(|x| x.field().is_some());
                // A rational number that is written as an expression.
                if irrational {
                    Ok(Self::OverField { case: Arc::new(case), further: Vec::new() })
                } else {
                    Err(problem)
                }
            }
            read => read,
        }
    }

    /// Reads the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`Question::read`].
    ///
    /// # Examples
    /// ```
    /// use secant::case::{Question, Subject};
    /// let text = "name = \"cc\"\n[vertex]\nmesh = \"catmull-clark\"\nvalence = 5\n";
    /// let question = Question::parse("cc.toml", text)?;
    /// assert_eq!(question.subject(), Subject::Vertices);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        Self::parse_open(name, text)?.closed()
    }

    /// The tangents of a shape that was made in the program; the name is made of letters, digits, `-`, `_` and `.`.
    ///
    /// # Errors
    /// As [`Question::parse`]: the shape is written as a case, which is what a checker reads, and read back.
    pub fn of_complex(name: &str, complex: &Complex) -> Result<Self, Problem> {
        let heading = Heading { name: name.to_owned(), ..Heading::default() };
        Self::parse(name, &complex_text(complex, &heading))
    }

    /// The question about the vertices of a mesh of what somebody writes, as [`Question::ask`]; it may also be a `[scheme]` of a mesh.
    ///
    /// # Errors
    /// As [`VertexCase::read`]; what is no case at all is told so.
    pub fn at_valences(text: &str, valences: Valences) -> Result<Self, Problem> {
        let source = asked(text)?;
        Self::parse_at_valences(&source.name, &source.text, valences)
    }

    /// The same of the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`VertexCase::parse`].
    pub fn parse_at_valences(name: &str, text: &str, valences: Valences) -> Result<Self, Problem> {
        let case = VertexCase::parse(name, text)?;
        if case.border.is_some() {
            let message = format!("{} is about vertices on the border, which have no valence", case.name);
            return Err(Problem::new("secant::usage::valence", message)
                .with_help("leave --valence out; the numbers of faces stand in the file, as in faces = \"1..12\""));
        }
        Ok(Self::Vertices { case: Arc::new(case), valences: Some(valences) })
    }

    fn of_table(file: &File, table: &Table<'_>) -> Result<Self, Problem> {
        if table.get("vertex").is_some() {
            let case = Arc::new(VertexCase::of_table(file, table)?);
            let valences = case.valences.clone();
            return Ok(Self::Vertices { case, valences });
        }
        Ok(Self::Tangents { case: Arc::new(Case::of_table(file, table)?), further: Vec::new() })
    }

    fn closed(self) -> Result<Self, Problem> {
        match self {
            Self::Tangents { case, further } => {
                case.refuse_open()?;
                Ok(Self::Tangents { case, further })
            }
            other => Ok(other),
        }
    }

    /// The question with a further point to examine, as in `0(1)`.
    ///
    /// # Errors
    /// A [`Problem`] where the shape has no such address, or the question is not about a shape.
    pub fn with_address(mut self, text: &str) -> Result<Self, Problem> {
        let problem = |error: String| {
            Problem::new("secant::usage::address", error).with_help(
                "letters first, then the repeated letters in brackets: `0(1)` is 0111…; or a parameter such as 1/3 or 0.5",
            )
        };
        match &mut self {
            Self::Tangents { case, further } => add_address(case, further, text).map_err(problem)?,
            Self::OverField { case, further } => add_address(case, further, text).map_err(problem)?,
            Self::Vertices { .. } => {
                return Err(problem("a case about the vertices of a mesh has no addresses".to_owned()));
            }
        }
        Ok(self)
    }

    /// What it is about.
    #[must_use]
    pub fn subject(&self) -> Subject {
        match self {
            Self::Vertices { .. } => Subject::Vertices,
            Self::Tangents { case, .. } => subject(&case.shape),
            Self::OverField { case, .. } => subject(&case.shape),
        }
    }

    /// The name of the case.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.name,
            Self::OverField { case, .. } => &case.name,
            Self::Vertices { case, .. } => &case.name,
        }
    }

    /// One line for people.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.title,
            Self::OverField { case, .. } => &case.title,
            Self::Vertices { case, .. } => &case.title,
        }
    }

    /// The file.
    #[must_use]
    pub fn text(&self) -> &SourceText {
        match self {
            Self::Tangents { case, .. } => &case.text,
            Self::OverField { case, .. } => &case.text,
            Self::Vertices { case, .. } => &case.text,
        }
    }
}

fn subject<E>(shape: &Shape<E>) -> Subject {
    match shape.states[shape.start].kind {
        CellKind::Edge => Subject::Curve,
        CellKind::Face => Subject::Surface,
        CellKind::Vertex | CellKind::Set => Subject::Set,
    }
}

/// Adds the address or parameter of a text to what is asked, unless it is asked already.
fn add_address<E: Entry>(case: &Case<E>, further: &mut Vec<Address>, text: &str) -> Result<(), String> {
    let address = match parameter(text) {
        Some(t) => case
            .shape
            .address_of(case.shape.start, &t)
            .ok_or_else(|| format!("the parameter {t} has no address here: it is between 0 and 1, and of a curve"))?,
        None => Address::parse(text).map_err(|e| e.to_string())?,
    };
    if address.prefix.len() + address.cycle.len() > MAX_LETTERS {
        return Err("the address is too long".to_owned());
    }
    let normal = |a: &Address| a.normalise(&case.shape, case.shape.start);
    let own = normal(&address).map_err(|e| e.to_string())?;
    if !case.examine.iter().chain(further.iter()).any(|known| normal(known).as_ref() == Ok(&own)) {
        further.push(address);
    }
    Ok(())
}

/// A parameter: a fraction or a decimal, `0`, `1`, or any of them behind `t=`; other digits are letters.
fn parameter(text: &str) -> Option<Rational> {
    let text = text.trim();
    let number =
        text.strip_prefix("t=").or_else(|| (text.contains(['/', '.']) || matches!(text, "0" | "1")).then_some(text));
    parse_rational(number?.trim()).ok()
}
