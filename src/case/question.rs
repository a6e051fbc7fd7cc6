//! What a case file asks, as its table says: the tangents of a shape, or smoothness at the vertices of a mesh.

use super::node::{File, Table};
use super::{Case, MAX_LETTERS, Valences, VertexCase};
use crate::diagnostic::{Problem, SourceText};
use crate::scheme::{self, Heading, complex_text};
use crate::shape::{Address, CellKind, Complex};
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

/// The case that a scheme's name with parameters, a mask or a symbol stands for; `None` for anything else.
fn scheme_case(text: &str) -> Option<String> {
    // Strings of JSON are strings of TOML.
    let quoted = |part: &str| serde_json::Value::from(part.trim()).to_string();
    let mut words = text.split_whitespace();
    let first = words.next()?;
    let mut lines = Vec::new();
    let name = if scheme::list().iter().any(|s| s.name == first) {
        lines.push(format!("name = {}", quoted(first)));
        for word in words {
            let (key, value) = word.split_once('=')?;
            lines.push(format!("{} = {}", quoted(key), quoted(value)));
        }
        first
    } else if text.contains('z') && text.contains(['(', '^', '+']) {
        lines.push(format!("symbol = {}", quoted(text)));
        "symbol"
    } else if text.contains(',') {
        lines.push(format!("mask = [{}]", text.split(',').map(quoted).collect::<Vec<_>>().join(", ")));
        "mask"
    } else {
        return None;
    };
    Some(format!("name = {}\ntitle = {}\n\n[scheme]\n{}\n", quoted(name), quoted(text), lines.join("\n")))
}

/// The text of the case that somebody writes or means by a scheme with parameters, a mask or a symbol; no file is read.
///
/// # Errors
/// A [`Problem`] where the text is none of these.
pub fn written(text: &str) -> Result<String, Problem> {
    if text.contains("name") && text.contains('=') && (text.contains('\n') || text.contains('"')) {
        return Ok(text.to_owned());
    }
    scheme_case(text.trim()).ok_or_else(|| Problem::new("secant::case::unreadable", "this is no case, scheme, mask or symbol"))
}

impl Question {
    /// Reads the question of a case file; `-` is the standard input.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with the file. Entries left open (`"?"`) are refused.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        Self::read_open(path)?.closed()
    }

    /// The question of what somebody writes: a file or `-`, the name of a scheme with parameters, a mask, or a symbol.
    ///
    /// # Errors
    /// As [`Question::read`]; what is none of these is taken for a file.
    ///
    /// # Examples
    /// ```
    /// use secant::case::{Question, Subject};
    /// for text in ["four-point w=1/16", "1/4,3/4,3/4,1/4", "(1+z)^3/4", "cases/thesis/half-tangent.toml"] {
    ///     assert_eq!(Question::ask(text)?.subject(), Subject::Curve, "{text}");
    /// }
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn ask(text: &str) -> Result<Self, Problem> {
        let path = Path::new(text);
        if text == "-" || path.exists() || path.extension().is_some_and(|e| e == "toml") {
            return Self::read(path);
        }
        match scheme_case(text) {
            Some(case) => Self::parse(text, &case),
            None => Self::read(path),
        }
    }

    /// As [`Question::read`] for a file in which entries may be left open.
    ///
    /// # Errors
    /// As [`Question::read`], apart from open entries.
    pub fn read_open(path: &Path) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        super::read::parsed(&source.name, &source.text, File::new, Self::of_table)
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
        super::read::parsed(name, text, File::new, Self::of_table)?.closed()
    }

    /// The tangents of a shape that was made in the program; the name is made of letters, digits, `-`, `_` and `.`.
    ///
    /// # Errors
    /// As [`Question::parse`]: the shape is written as a case, which is what a checker reads, and read back.
    pub fn of_complex(name: &str, complex: &Complex) -> Result<Self, Problem> {
        let heading = Heading { name: name.to_owned(), ..Heading::default() };
        Self::parse(name, &complex_text(complex, &heading))
    }

    /// The question about the vertices of a mesh of a file, which may also be a `[scheme]` of a mesh.
    ///
    /// # Errors
    /// As [`VertexCase::read`].
    pub fn at_valences(path: &Path, valences: Valences) -> Result<Self, Problem> {
        Ok(Self::Vertices { case: Arc::new(VertexCase::read(path)?), valences: Some(valences) })
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
            vertices @ Self::Vertices { .. } => Ok(vertices),
        }
    }

    /// The question with a further point to examine, as in `0(1)`.
    ///
    /// # Errors
    /// A [`Problem`] where the shape has no such address, or the question is not about a shape.
    pub fn with_address(mut self, text: &str) -> Result<Self, Problem> {
        let problem = |error: String| {
            Problem::new("secant::usage::address", error)
                .with_help("letters first, then the repeated letters in brackets: `0(1)` is 0111…")
        };
        let Self::Tangents { case, further } = &mut self else {
            return Err(problem("a case about the vertices of a mesh has no addresses".to_owned()));
        };
        let address = Address::parse(text).map_err(|e| problem(e.to_string()))?;
        if address.prefix.len() + address.cycle.len() > MAX_LETTERS {
            return Err(problem("the address is too long".to_owned()));
        }
        address.normalise(&case.shape, case.shape.start).map_err(|e| problem(e.to_string()))?;
        further.push(address);
        Ok(self)
    }

    /// What it is about.
    #[must_use]
    pub fn subject(&self) -> Subject {
        match self {
            Self::Vertices { .. } => Subject::Vertices,
            Self::Tangents { case, .. } => match case.shape.states[case.shape.start].kind {
                CellKind::Edge => Subject::Curve,
                CellKind::Face => Subject::Surface,
                CellKind::Vertex | CellKind::Set => Subject::Set,
            },
        }
    }

    /// The name of the case.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.name,
            Self::Vertices { case, .. } => &case.name,
        }
    }

    /// One line for people.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Self::Tangents { case, .. } => &case.title,
            Self::Vertices { case, .. } => &case.title,
        }
    }

    /// The file.
    #[must_use]
    pub fn text(&self) -> &SourceText {
        match self {
            Self::Tangents { case, .. } => &case.text,
            Self::Vertices { case, .. } => &case.text,
        }
    }
}
