use super::node::{Node, Table};
use super::read::address;
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::shape::{Address, CellKind, Shape};
use toml::de::{DeTable, DeValue};

/// What a test expects of a case.
#[derive(Debug, Clone, Default)]
pub struct Expect {
    /// `proved`, `refuted` or `undetermined`.
    pub verdict: Option<String>,
    /// The same of the contraction.
    pub contraction: Option<String>,
    /// Code of the diagnostic with which the case must be refused.
    pub error: Option<String>,
    /// What is expected at single points.
    pub points: Vec<ExpectPoint>,
    /// What `secant solve` must find.
    pub solve: Option<ExpectSolve>,
}

/// What `secant solve` must find.
#[derive(Debug, Clone)]
pub struct ExpectSolve {
    /// `none`, `one` or `family`.
    pub solutions: String,
    /// Number of free parameters.
    pub parameters: Option<usize>,
    /// The identities that contradict each other, written as paths.
    pub conflict: Option<Vec<String>>,
    /// Forced spectra.
    pub forced: Vec<ExpectForced>,
}

/// The forced part of the spectrum of an operator.
#[derive(Debug, Clone)]
pub struct ExpectForced {
    /// The operator, as in `T_0[E]`.
    pub operator: String,
    /// Its forced eigenvalues, all of them rational, with their multiplicities.
    pub eigenvalues: Vec<Rational>,
}

/// What a test expects at one point.
#[derive(Debug, Clone)]
pub struct ExpectPoint {
    /// An address of the point.
    pub address: Address,
    /// `smooth end` (of a curve `half-tangent` is the same), `regular`, `cusp`, `oscillating`, `corner`, `tangent line`,
    /// `no tangent`, `tangent-plane`, `no tangent plane` or `undetermined`.
    pub kind: Option<String>,
    /// `proved`, `refuted` or `undetermined`.
    pub verdict: Option<String>,
    /// Dimension of the tangent subspace.
    pub dimension: Option<usize>,
    /// Vectors that span the tangent plane of a surface.
    pub plane: Option<Vec<Vec<Rational>>>,
    /// Direction of the tangent line, up to a factor.
    pub tangent: Option<Vec<Rational>>,
    /// Rays of the left side, up to positive factors.
    pub left: Option<Vec<Vec<Rational>>>,
    /// Rays of the right side, up to positive factors.
    pub right: Option<Vec<Vec<Rational>>>,
    /// Minimal polynomial of the eigenvalue, such as `x - 3/4`.
    pub eigenvalue: Option<String>,
}

const VERDICTS: [&str; 3] = ["proved", "refuted", "undetermined"];
const KINDS: [&str; 11] = [
    "smooth end",
    "half-tangent",
    "regular",
    "cusp",
    "oscillating",
    "corner",
    "tangent line",
    "no tangent",
    "tangent-plane",
    "no tangent plane",
    "undetermined",
];

impl Expect {
    pub(super) fn read(node: &Node<'_>, shape: &Shape) -> Result<Self, Problem> {
        let table = node.table()?;
        table.only(&["verdict", "contraction", "error", "point", "solve"])?;
        let points = match table.get("point") {
            Some(list) => {
                let tables = list.tables(|k| format!("expected point {k}"))?;
                tables.iter().map(|t| ExpectPoint::read(t, shape)).collect::<Result<_, _>>()?
            }
            None => Vec::new(),
        };
        Ok(Self {
            verdict: table.word("verdict", &VERDICTS)?.map(str::to_owned),
            contraction: table.word("contraction", &VERDICTS)?.map(str::to_owned),
            error: table.optional_text("error")?.map(str::to_owned),
            points,
            solve: table.get("solve").map(|n| ExpectSolve::read(&n)).transpose()?,
        })
    }
}

impl ExpectSolve {
    fn read(node: &Node<'_>) -> Result<Self, Problem> {
        let table = node.table()?;
        table.only(&["solutions", "parameters", "conflict", "forced"])?;
        let forced = match table.get("forced") {
            None => Vec::new(),
            Some(list) => list.tables(|k| format!("forced spectrum {k}"))?,
        };
        let forced = forced.iter().map(|t| {
            t.only(&["operator", "eigenvalues"])?;
            let eigenvalues = vector(&t.need("eigenvalues", "[1, \"1/2\"]")?)?;
            Ok(ExpectForced { operator: t.text("operator", "\"T_0[E]\"")?.to_owned(), eigenvalues })
        });
        let text = |n: Node<'_>| n.text().map(str::to_owned);
        let conflict = match table.get("conflict") {
            None => None,
            Some(list) => {
                Some(list.array(|k| format!("identity {k}"))?.into_iter().map(text).collect::<Result<_, _>>()?)
            }
        };
        table.need("solutions", "\"one\"")?;
        Ok(Self {
            solutions: table.word("solutions", &["none", "one", "family"])?.unwrap_or_default().to_owned(),
            parameters: table.get("parameters").map(|n| n.index(crate::shape::MAX_UNKNOWNS)).transpose()?,
            conflict,
            forced: forced.collect::<Result<_, _>>()?,
        })
    }
}

impl ExpectPoint {
    fn read(table: &Table<'_>, shape: &Shape) -> Result<Self, Problem> {
        table.only(&["address", "kind", "verdict", "dimension", "plane", "tangent", "left", "right", "eigenvalue"])?;
        let rays = |key: &str| -> Result<Option<Vec<Vec<Rational>>>, Problem> {
            let Some(node) = table.get(key) else { return Ok(None) };
            let rays = node.array(|k| format!("ray {k} of `{key}`"))?;
            Ok(Some(rays.iter().map(vector).collect::<Result<_, _>>()?))
        };
        Ok(Self {
            address: address(&table.need("address", "\"(0)\"")?, shape)?,
            kind: table.word("kind", &KINDS)?.map(|kind| of_curve(kind, shape).to_owned()),
            verdict: table.word("verdict", &VERDICTS)?.map(str::to_owned),
            dimension: table.get("dimension").map(|n| n.index(super::MAX_COORDINATES)).transpose()?,
            plane: rays("plane")?,
            tangent: table.get("tangent").map(|n| vector(&n)).transpose()?,
            left: rays("left")?,
            right: rays("right")?,
            eigenvalue: table.optional_text("eigenvalue")?.map(str::to_owned),
        })
    }
}

/// The end of a curve with one ray is a smooth end; of a set it is called a half-tangent.
fn of_curve(kind: &'static str, shape: &Shape) -> &'static str {
    let curve = shape.states[shape.start].kind == CellKind::Edge;
    if curve && kind == "half-tangent" { "smooth end" } else { kind }
}

fn vector(node: &Node<'_>) -> Result<Vec<Rational>, Problem> {
    node.array(|k| format!("entry {k} of {}", node.what))?.iter().map(Node::number).collect()
}

/// The diagnostic code that a case declares under `[expect] error`, read even from a case that is refused.
///
/// `None` where the text is not TOML or declares none.
#[must_use]
pub fn expected_error(text: &str) -> Option<String> {
    let (table, _) = DeTable::parse_recoverable(text);
    let DeValue::Table(expect) = table.get_ref().get("expect")?.get_ref() else { return None };
    expect.get("error")?.get_ref().as_str().map(str::to_owned)
}
