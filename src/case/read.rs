use super::expect::Expect;
use super::matrix::Written;
use super::node::{File, Node, Table};
use super::source::too_large;
use super::{Case, Convention, MAX_ADDRESSES, MAX_BYTES, MAX_LETTERS, Model, interpolate, maps, scheme, states};
use crate::diagnostic::{Problem, SourceText};
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, ComplexError, Failure, Identity, Shape, ShapeError};
use std::io::Read;
use std::path::Path;
use toml::de::DeTable;

const KEYS: [&str; 17] = [
    "name",
    "title",
    "source",
    "kind",
    "convention",
    "pieces",
    "reversed",
    "shares",
    "interpolate",
    "map",
    "scheme",
    "mask",
    "start",
    "state",
    "control",
    "examine",
    "expect",
];

impl Case {
    /// Reads and checks the case file at `path`; `-` is the standard input.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with it: see `docs/case-format.md` for the codes. Entries left open are
    /// refused.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        Self::read_open(path)?.closed()
    }

    /// Reads a case file in which entries may be left open (`"?"`); sums and identities are only checked where there are none.
    ///
    /// # Errors
    /// As [`Case::read`], apart from open entries.
    pub fn read_open(path: &Path) -> Result<Self, Problem> {
        let source = SourceText::read(path)?;
        Self::parse_open(&source.name, &source.text)
    }

    /// The case, if no entry was left open.
    pub(super) fn closed(self) -> Result<Self, Problem> {
        self.refuse_open()?;
        Ok(self)
    }

    /// The problem of the first entry that was left open.
    pub(super) fn refuse_open(&self) -> Result<(), Problem> {
        let Some(first) = self.unknown.first() else { return Ok(()) };
        let count = self.unknown.len();
        let message =
            if count == 1 { "an entry is unknown".to_owned() } else { format!("{count} entries are unknown") };
        let help = "`secant solve` finds the entries that the identities force, and writes the case with them";
        Err(self.problem_at_unknown(first, "secant::case::unknown-entry", &message, help))
    }

    /// Reads and checks a case from a stream; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`Case::read`].
    pub fn from_reader(name: &str, stream: impl Read) -> Result<Self, Problem> {
        let source = SourceText::from_reader(name, stream)?;
        Self::parse(&source.name, &source.text)
    }

    /// Reads and checks the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// As [`Case::read`].
    ///
    /// # Cost
    /// Linear in the text, apart from the arithmetic on the numbers.
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        Self::parse_open(name, text)?.closed()
    }

    /// As [`Case::parse`], with entries that may be left open; see [`Case::read_open`].
    ///
    /// # Errors
    /// As [`Case::read_open`].
    pub fn parse_open(name: &str, text: &str) -> Result<Self, Problem> {
        Self::parse_as(name, text, File::new)
    }

    /// The same, with the file as `open` makes it.
    pub(super) fn parse_as(name: &str, text: &str, open: impl FnOnce(SourceText) -> File) -> Result<Self, Problem> {
        parsed(name, &super::valued(name, text)?, open, build)
    }

    /// The case of a table that was parsed; entries may be left open.
    pub(super) fn of_table(file: &File, table: &Table<'_>) -> Result<Self, Problem> {
        build(file, table)
    }
}

/// Parses a text and makes something of its table.
pub(super) fn parsed<T>(
    name: &str,
    text: &str,
    open: impl FnOnce(SourceText) -> File,
    make: impl FnOnce(&File, &Table<'_>) -> Result<T, Problem>,
) -> Result<T, Problem> {
    let source = SourceText::new(name, text);
    if text.len() > MAX_BYTES {
        return Err(too_large(name));
    }
    let table = DeTable::parse(text).map_err(|error| syntax(&source, &error))?;
    if table.get_ref().is_empty() {
        return Err(Problem::new("secant::case::empty", format!("{name} is empty"))
            .with_help("a case needs at least `name`, `convention` and `pieces`; see docs/case-format.md"));
    }
    let file = open(source);
    make(&file, &Table::root(&file, &table))
}

fn syntax(source: &SourceText, error: &toml::de::Error) -> Problem {
    let end = source.text.len();
    let span = error.span().unwrap_or(end..end);
    let message = error.message();
    let rest = source.text.get(span.start.min(end)..).unwrap_or_default();
    let fraction: String = rest.chars().take_while(|c| c.is_ascii_digit() || matches!(c, '/' | '-' | '+')).collect();
    let start = source.text.trim_start();
    let quoted = format!("write fractions in quotes: \"{fraction}\"");
    let help = if fraction.contains('/') && fraction.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
        quoted.as_str()
    } else if start.starts_with('{') {
        "this looks like JSON: `secant import FILE` writes a JSON file as a case"
    } else if source.text.lines().any(|l| l.starts_with("v ")) && source.text.lines().any(|l| l.starts_with("f ")) {
        "this is a mesh in the Wavefront format: `secant certify FILE.obj --scheme loop` (or catmull-clark) is about its limit \
         surface; a case names a mesh rule and valences, see [vertex] in docs/case-format.md"
    } else if message.contains("recursion") {
        "lists and tables are nested too deeply; a matrix is a list of lists"
    } else if message.contains("duplicate") {
        "every key may be given once"
    } else {
        "case files are TOML: strings and fractions in quotes, lists in square brackets"
    };
    Problem::new("secant::case::syntax", format!("this is not valid TOML: {}", message.lines().next().unwrap_or("")))
        .with_source(source)
        .with_label(span.start.min(end)..span.end.min(end), "here")
        .with_help(help)
}

fn build(file: &File, case: &Table<'_>) -> Result<Case, Problem> {
    if case.get("vertex").is_some() {
        return Err(case
            .problem("vertex", "this case is about the vertices of a mesh, not about one shape", "")
            .with_help("`secant certify` goes through its valences; other commands take cases of one shape"));
    }
    if case.get("border").is_some() {
        return Err(case
            .problem("border", "this case is about two masks that meet along a line, not about one shape", "")
            .with_help("`secant regularity FILE` says how smooth the limits are across it"));
    }
    super::member::left_free(case).map_or(Ok(()), Err)?;
    if let Some(span) = case.key_span("matrices") {
        return Err(case
            .file
            .problem(
                "matrices",
                "this is a set of matrices for a joint spectral radius, no case",
                span,
                "no case has it",
            )
            .with_help("`secant jsr FILE` bounds the radius; the operators of a case are its `pieces`"));
    }
    case.only(&KEYS)?;
    let name = name(case)?;
    let title = case.optional_text("title")?.unwrap_or(&name).to_owned();
    let source = case.optional_text("source")?.map(str::to_owned);
    let kind = match case.word("kind", &["curve", "set"])? {
        Some("set") => CellKind::Set,
        _ => CellKind::Edge,
    };
    let convention = convention(case)?;
    let mut model = model(case, kind, convention)?;
    if let Some(node) = case.get("control") {
        model.complex.shape.control = Some(control(&node, &model.complex.shape)?);
        model.places.control = Some(node.span());
    }
    if model.unknown.is_empty() {
        let checked = model.complex.shape.check();
        checked.map_err(|error| match &error {
            ShapeError::Shares { .. } => case.problem("shares", error.to_string(), "in this file").with_help(
                "give all pieces of a curve their parts of the parameter, as in share = \"1/3\", or none of them for equal parts",
            ),
            _ => case.problem("shape", error.to_string(), "in this file"),
        })?;
        check_identities(file, &model)?;
    }
    let shape = &model.complex.shape;
    let examine = examine(case, shape)?;
    let expect = case.get("expect").map(|node| Expect::read(&node, shape)).transpose()?;
    let text = file.source.clone();
    let Model { complex, places, unknown, scheme } = model;
    let (shape, faces, reversals) = (complex.shape, complex.faces, complex.reversals);
    let taken = match &scheme {
        Some(super::Origin::Filter(_, taken)) => Some(*taken),
        _ => None,
    };
    Ok(Case {
        name,
        title,
        source,
        convention,
        shape,
        faces,
        reversals,
        scheme,
        taken,
        numbers: Some(Vec::new()),
        flat: None,
        unknown,
        examine,
        expect,
        text,
        places,
    })
}

/// Checks the identities of the cells that the engine does not look at: those of faces and reversals.
fn check_identities(file: &File, model: &Model) -> Result<(), Problem> {
    let complex = &model.complex;
    // Samples of a number field say nothing about what is not linear in the entries.
    if file.is_sampled() || complex.faces.is_empty() && complex.reversals.is_empty() {
        return Ok(());
    }
    let problem = |error: &ComplexError| {
        Problem::new("secant::shape::identity", error.to_string())
            .with_source(&file.source)
            .with_help("the identities are generated from the cells: see docs/schemes.md, Identities")
    };
    for identity in complex.identities().map_err(|e| problem(&e))? {
        if let Some(failure) = complex.failure(&identity).map_err(|e| problem(&e))? {
            return Err(failed(file, model, &identity, &failure));
        }
    }
    Ok(())
}

/// An identity that fails, shown at the operators of both paths.
fn failed(file: &File, model: &Model, identity: &Identity, failure: &Failure) -> Problem {
    let column = |m: &Matrix| {
        let entries: Vec<String> = m.column(failure.column).iter().map(ToString::to_string).collect();
        format!("({})", entries.join(", "))
    };
    let help = format!(
        "column {} of the left product is {}, of the right one {}",
        failure.column,
        column(&failure.left),
        column(&failure.right)
    );
    let mut problem = Problem::new("secant::shape::identity", failure.to_string()).with_source(&file.source);
    for op in identity.left.iter().chain(&identity.right) {
        if let Some(span) = model.places.of(*op) {
            problem = problem.with_label(span.clone(), model.complex.operator_text(*op));
        }
    }
    problem.with_help(help)
}

pub(super) fn name(case: &Table<'_>) -> Result<String, Problem> {
    let name = case.text("name", "\"my-curve\"")?;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if name.is_empty() || name.len() > 100 || name.starts_with('.') || !name.chars().all(plain) {
        return Err(case
            .need("name", "\"my-curve\"")?
            .problem("value", "the name of a case is made of letters, digits, `-`, `_` and `.`", "not a name")
            .with_help("the name is the file name without .toml; use `title` for anything longer"));
    }
    Ok(name.to_owned())
}

fn convention(case: &Table<'_>) -> Result<Convention, Problem> {
    let word = case.word("convention", &["columns", "rows"])?;
    if ["map", "scheme", "mask", "interpolate"].into_iter().all(|form| case.get(form).is_none()) {
        case.need("convention", "\"columns\"").map_err(|p| {
            p.with_help(
                "say how the matrices act: convention = \"columns\" (operators on columns of coordinates, \
                 columns sum to 1) or convention = \"rows\" (subdivision matrices on rows of control points, \
                 rows sum to 1)",
            )
        })?;
        return Ok(if word == Some("rows") { Convention::Rows } else { Convention::Columns });
    }
    match (word, case.get("convention")) {
        _ if case.get("map").is_none() => Ok(Convention::Columns),
        (Some("rows"), Some(node)) => Err(node
            .problem("value", "affine maps act on columns: x -> linear x + shift", "does not fit [[map]]")
            .with_help("leave `convention` out, and transpose the linear parts if they were meant to act on rows")),
        _ => Ok(Convention::Affine),
    }
}

fn model(case: &Table<'_>, kind: CellKind, convention: Convention) -> Result<Model, Problem> {
    if let Some(node) = case.get("scheme") {
        return scheme::read(case, &node);
    }
    if let Some(node) = case.get("interpolate") {
        return interpolate::read(case, &node);
    }
    if let Some(node) = case.get("mask") {
        return super::lattice::read(case, &node);
    }
    if let Some(node) = case.get("map") {
        return maps::read(case, &node, kind);
    }
    if let Some(node) = case.get("state") {
        return states::automaton(case, &node, kind, convention);
    }
    if let Some(span) = case.key_span("start") {
        return Err(case
            .file
            .problem(
                "two-forms",
                "`start` belongs to an automaton, but there is no [[state]]",
                span,
                "without [[state]]",
            )
            .with_help("leave `start` out, or give the states"));
    }
    let node = case.need("pieces", "[ [[…]], [[…]] ]").map_err(|p| {
        p.with_help(
            "a case is written with `pieces` (a list of matrices), with [[map]] tables, with [[state]] tables, with [scheme], \
             or with [interpolate]",
        )
    })?;
    states::single(case, &node, kind, convention)
}

fn control(node: &Node<'_>, shape: &Shape) -> Result<Matrix, Problem> {
    let written = Written::read(&node.named("the list of control points"))?;
    let start = &shape.states[shape.start];
    if written.height() != start.dim {
        let message = format!("there are {} control points for {} coordinates", written.height(), start.dim);
        return Err(node
            .problem("control", message, format!("{} points here", written.height()))
            .with_help(format!("give one point for each of the {} coordinates of the start state", start.dim)));
    }
    Ok(written.matrix().transpose())
}

fn examine(case: &Table<'_>, shape: &Shape) -> Result<Vec<Address>, Problem> {
    let Some(node) = case.get("examine") else { return Ok(Vec::new()) };
    let tables = node.tables(|k| format!("[[examine]] number {k}"))?;
    if tables.len() > MAX_ADDRESSES {
        return Err(node
            .problem("limit", format!("{} points are over the limit of {MAX_ADDRESSES}", tables.len()), "too many")
            .with_help("examine fewer points in one case"));
    }
    let mut addresses = Vec::new();
    for table in &tables {
        table.only(&["address"])?;
        addresses.push(address(&table.need("address", "\"0(1)\"")?, shape)?);
    }
    Ok(addresses)
}

/// Reads an address and makes sure that its letters exist.
pub(super) fn address(node: &Node<'_>, shape: &Shape) -> Result<Address, Problem> {
    let text = node.text()?;
    let problem = |message: String, help: &str| node.problem("address", message, "this address").with_help(help);
    if text.len() > 4 * MAX_LETTERS {
        return Err(problem("the address is too long".to_owned(), "addresses of at most 1000 letters are read"));
    }
    let help = "letters first, then the repeated letters in brackets: \"0(1)\" is 0111…";
    let read = Address::parse(text).map_err(|error| problem(error.to_string(), help))?;
    if read.prefix.len() + read.cycle.len() > MAX_LETTERS {
        return Err(problem("the address is too long".to_owned(), "addresses of at most 1000 letters are read"));
    }
    read.normalise(shape, shape.start).map_err(|error| problem(error.to_string(), "use the letters of the state"))?;
    Ok(read)
}

#[cfg(test)]
mod tests;
