//! Reads the case file itself, so that a proof cannot be about another case.

use crate::matrix::Matrix;
use crate::number::{Q, bits, decimal_fraction};
use crate::shape::{Address, End, Kind, Op, Piece, Shape, State};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::cell::{Cell, RefCell};
use toml::de::{DeTable, DeValue};

/// Most states of a case.
pub const MAX_STATES: usize = 64;
/// Most pieces of a state.
pub const MAX_PIECES: usize = 64;
/// Most coordinates of a state.
pub const MAX_COORDINATES: usize = 64;
/// Most unknown entries.
const MAX_HOLES: usize = 4_096;
/// All numbers of a case together, in bits.
const MAX_BITS: u64 = 1 << 22;

/// A case: its name, its shape, and the addresses it asks about.
pub struct Case {
    /// The name.
    pub name: String,
    /// The shape.
    pub shape: Shape,
    /// The addresses under `[[examine]]`, as written.
    pub examine: Vec<Address>,
}

/// Why a case cannot be read; the text names the key.
pub type Problem = String;

/// A case with unknown entries, which are 0 in its shape.
pub struct Open {
    /// The name.
    pub name: String,
    /// The shape.
    pub shape: Shape,
    /// The unknown entries: by state, first the pieces, then the two boundaries; in each operator by rows.
    pub holes: Vec<Hole>,
}

/// An unknown entry.
pub struct Hole {
    /// The operator.
    pub op: Op,
    /// The row.
    pub row: usize,
    /// The column.
    pub col: usize,
    /// The number of the unknown; entries of one name are one unknown.
    pub unknown: usize,
}

/// Reads the numbers of a case; where entries may be unknown, their places and names are collected.
struct Reader {
    bits: Cell<u64>,
    open: bool,
    holes: RefCell<Vec<(Hole, Option<String>)>>,
}

fn known(table: &DeTable<'_>, keys: &[&str]) -> Result<(), Problem> {
    match table.keys().find(|k| !keys.contains(&k.get_ref().as_ref())) {
        Some(key) => Err(format!("unknown key `{}`", key.get_ref())),
        None => Ok(()),
    }
}

fn get<'t, 'a>(table: &'t DeTable<'a>, key: &str) -> Option<&'t DeValue<'a>> {
    table.get(key).map(toml::Spanned::get_ref)
}

fn need<'t, 'a>(table: &'t DeTable<'a>, key: &str) -> Result<&'t DeValue<'a>, Problem> {
    get(table, key).ok_or_else(|| format!("the key `{key}` is missing"))
}

fn text<'t>(value: &'t DeValue<'_>, key: &str) -> Result<&'t str, Problem> {
    value.as_str().ok_or_else(|| format!("`{key}` must be a text"))
}

fn array<'t, 'a>(value: &'t DeValue<'a>, key: &str) -> Result<Vec<&'t DeValue<'a>>, Problem> {
    match value {
        DeValue::Array(items) => Ok(items.iter().map(toml::Spanned::get_ref).collect()),
        _ => Err(format!("`{key}` must be a list")),
    }
}

fn table<'t, 'a>(value: &'t DeValue<'a>, key: &str) -> Result<&'t DeTable<'a>, Problem> {
    match value {
        DeValue::Table(table) => Ok(table),
        _ => Err(format!("`{key}` must be a table")),
    }
}

fn flag(t: &DeTable<'_>, key: &str) -> Result<bool, Problem> {
    get(t, key).map_or(Ok(false), |v| v.as_bool().ok_or_else(|| format!("`{key}` must be true or false")))
}

fn index(value: &DeValue<'_>, bound: usize, key: &str) -> Result<usize, Problem> {
    let digits = match value {
        DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str().parse::<usize>().ok(),
        _ => None,
    };
    digits.filter(|k| *k < bound).ok_or_else(|| format!("`{key}` must be a whole number below {bound}"))
}

/// The keys of a case.
const CASE_KEYS: [&str; 13] = [
    "name",
    "title",
    "source",
    "kind",
    "convention",
    "pieces",
    "reversed",
    "map",
    "start",
    "state",
    "control",
    "examine",
    "expect",
];

/// The keys of a state; those of the boundaries of faces and of reversals are allowed and not read.
const STATE_KEYS: [&str; 13] = [
    "name",
    "kind",
    "dimension",
    "left",
    "right",
    "piece",
    "reversal",
    "layout",
    "bottom",
    "top",
    "side01",
    "side12",
    "side02",
];

/// The operator that puts coordinate `j` at `points[j]`.
fn inclusion(points: &DeValue<'_>, (rows, cols): (usize, usize)) -> Result<Matrix, Problem> {
    let points = array(points, "points")?;
    if points.len() != cols {
        return Err(format!("`points` must have {cols} entries"));
    }
    let at = points.into_iter().map(|p| index(p, rows, "points")).collect::<Result<Vec<_>, _>>()?;
    Ok(Matrix::ones(rows, cols, |i, j| at[j] == i))
}

impl Reader {
    fn number(&self, value: &DeValue<'_>) -> Result<Q, Problem> {
        let text = match value {
            DeValue::String(text) => text.as_ref(),
            DeValue::Integer(digits) if digits.radix() == 10 => digits.as_str(),
            DeValue::Float(digits) => digits.as_str(),
            _ => return Err("a number is needed".to_owned()),
        };
        let number = decimal_fraction(text).ok_or("not an exact number")?;
        self.bits.set(self.bits.get().saturating_add(bits(&number)));
        if self.bits.get() > MAX_BITS { Err("the numbers are too long".to_owned()) } else { Ok(number) }
    }

    fn matrix(&self, value: &DeValue<'_>, key: &str) -> Result<Matrix, Problem> {
        let mut rows: Vec<Vec<Q>> = Vec::new();
        for row in array(value, key)? {
            rows.push(array(row, key)?.into_iter().map(|x| self.number(x)).collect::<Result<_, _>>()?);
        }
        let cols = rows.first().map_or(0, Vec::len);
        let fits = |n: usize| (1..=MAX_COORDINATES).contains(&n);
        if !fits(rows.len()) || !fits(cols) || rows.iter().any(|r| r.len() != cols) {
            return Err(format!("`{key}` is no matrix of 1 to {MAX_COORDINATES} rows and columns"));
        }
        Ok(Matrix::from_rows(cols, &rows))
    }

    /// The name of an unknown entry (`"?"` or `"?name"`), where there may be some.
    fn unknown<'t>(&self, value: &'t DeValue<'_>) -> Option<&'t str> {
        value.as_str().filter(|_| self.open).and_then(|text| text.strip_prefix('?'))
    }

    /// An operator with unknown entries, which are noted and 0.
    fn open_operator(
        &self,
        value: &DeValue<'_>,
        by_rows: bool,
        size: (usize, usize),
        op: Op,
    ) -> Result<Matrix, Problem> {
        let all = self.unknown(value).is_some();
        let mut entries = vec![Q::zero(); size.0 * size.1];
        let rows = if all { Vec::new() } else { array(value, "matrix")? };
        let at = |row: usize, col: usize| -> Result<&DeValue<'_>, Problem> {
            let (i, j) = if by_rows { (col, row) } else { (row, col) };
            let row = array(rows.get(i).ok_or("an operator has the wrong size")?, "matrix")?;
            row.get(j).copied().ok_or_else(|| "an operator has the wrong size".to_owned())
        };
        for (k, entry) in entries.iter_mut().enumerate() {
            let (row, col) = (k / size.1, k % size.1);
            let name = if all { Some("") } else { self.unknown(at(row, col)?) };
            let Some(name) = name else {
                *entry = self.number(at(row, col)?)?;
                continue;
            };
            let mut holes = self.holes.borrow_mut();
            let name = (!name.is_empty()).then(|| name.to_owned());
            let known = holes.iter().find(|(_, n)| name.is_some() && *n == name).map(|(h, _)| h.unknown);
            let unknown = known.unwrap_or_else(|| holes.iter().map(|(h, _)| h.unknown + 1).max().unwrap_or(0));
            if holes.len() >= MAX_HOLES {
                return Err("too many unknown entries".to_owned());
            }
            holes.push((Hole { op, row, col, unknown }, name));
        }
        Ok(Matrix::new(size.0, size.1, &entries))
    }

    /// An operator on columns of barycentric coordinates of the given size; all its columns sum to 1.
    fn operator(&self, value: &DeValue<'_>, by_rows: bool, size: (usize, usize), op: Op) -> Result<Matrix, Problem> {
        let has_holes = || {
            value.as_array().is_some_and(|rows| {
                rows.iter()
                    .filter_map(|r| r.get_ref().as_array())
                    .flatten()
                    .any(|x| self.unknown(x.get_ref()).is_some())
            })
        };
        if self.unknown(value).is_some() || has_holes() {
            return self.open_operator(value, by_rows, size, op);
        }
        let written = self.matrix(value, "matrix")?;
        let op = if by_rows { written.transpose() } else { written };
        if (op.rows, op.cols) != size {
            return Err(format!("an operator has the wrong size: {} x {}", op.rows, op.cols));
        }
        if (0..op.cols).any(|j| (0..op.rows).map(|i| &op.data[i * op.cols + j]).sum::<BigInt>() != op.den) {
            return Err("a column of an operator does not sum to 1".to_owned());
        }
        Ok(op)
    }

    /// The operator on the simplex `0, e_1, …, e_d` of `x -> linear x + shift`.
    fn affine(&self, map: &DeTable<'_>) -> Result<Piece, Problem> {
        known(map, &["linear", "shift", "reversed"])?;
        let linear = self.matrix(need(map, "linear")?, "linear")?;
        let shift: Vec<Q> =
            array(need(map, "shift")?, "shift")?.into_iter().map(|x| self.number(x)).collect::<Result<_, _>>()?;
        let d = shift.len();
        if d >= MAX_COORDINATES || (linear.rows, linear.cols) != (d, d) {
            return Err("`linear` and `shift` do not fit".to_owned());
        }
        let image = |i: usize, j: usize| if j == 0 { shift[i].clone() } else { &shift[i] + linear.at(i, j - 1) };
        let entry = |(i, j): (usize, usize)| match i {
            0 => Q::one() - (0..d).map(|i| image(i, j)).sum::<Q>(),
            _ => image(i - 1, j),
        };
        let places = (0..=d).flat_map(|i| (0..=d).map(move |j| (i, j)));
        let op = Matrix::new(d + 1, d + 1, &places.map(entry).collect::<Vec<_>>());
        Ok(Piece { target: 0, op, reversed: flag(map, "reversed")? })
    }

    fn automaton(&self, case: &DeTable<'_>, default: Kind, by_rows: bool) -> Result<(Vec<State>, usize), Problem> {
        let tables: Vec<&DeTable<'_>> =
            array(need(case, "state")?, "state")?.into_iter().map(|v| table(v, "state")).collect::<Result<_, _>>()?;
        if tables.is_empty() || tables.len() > MAX_STATES {
            return Err("too few or too many states".to_owned());
        }
        let mut heads: Vec<(&str, Kind, usize)> = Vec::new();
        for t in &tables {
            known(t, &STATE_KEYS)?;
            let name = text(need(t, "name")?, "name")?;
            let kind = match get(t, "kind").map(|v| text(v, "kind")).transpose()? {
                None => default,
                Some("edge") => Kind::Edge,
                Some("vertex") => Kind::Vertex,
                // No rule uses the boundaries of a face: its claims are about a set.
                Some("set" | "face") => Kind::Set,
                Some(_) => return Err("unknown kind of a state".to_owned()),
            };
            let dim = match get(t, "dimension") {
                Some(v) => index(v, MAX_COORDINATES + 1, "dimension")?,
                None => {
                    let pieces = array(need(t, "piece")?, "piece")?;
                    let first = table(pieces.first().ok_or("a state has no piece")?, "piece")?;
                    let rows = array(need(first, "matrix")?, "matrix")?;
                    if by_rows {
                        rows.first().map_or(Ok(0), |r| array(r, "matrix").map(|r| r.len()))?
                    } else {
                        rows.len()
                    }
                }
            };
            if !(1..=MAX_COORDINATES).contains(&dim) || heads.iter().any(|h| h.0 == name) {
                return Err("a state without coordinates, or two states of one name".to_owned());
            }
            heads.push((name, kind, dim));
        }
        let find = |value: &DeValue<'_>| -> Result<usize, Problem> {
            let name = text(value, "to")?;
            heads.iter().position(|h| h.0 == name).ok_or_else(|| format!("there is no state `{name}`"))
        };
        let mut states = Vec::new();
        for (t, &(name, kind, dim)) in tables.iter().zip(&heads) {
            let mut pieces = Vec::new();
            for piece in array(need(t, "piece")?, "piece")? {
                let piece = table(piece, "piece")?;
                known(piece, &["to", "matrix", "reversed", "corners"])?;
                let target = find(need(piece, "to")?)?;
                let place = Op::Piece(states.len(), pieces.len());
                let op = self.operator(need(piece, "matrix")?, by_rows, (dim, heads[target].2), place)?;
                let fits = kind == Kind::Set || heads[target].1 == kind;
                let reversed = flag(piece, "reversed")?;
                if !fits || (reversed && kind != Kind::Edge) {
                    return Err(format!("a piece of state `{name}` is of another kind, or runs backwards in no curve"));
                }
                pieces.push(Piece { target, op, reversed });
            }
            let boundary = |key: &str, end: End| -> Result<Option<(usize, Matrix)>, Problem> {
                let Some(value) = get(t, key) else { return Ok(None) };
                let b = table(value, key)?;
                if kind == Kind::Set && get(b, "edge").is_some() {
                    return Ok(None);
                }
                known(b, &["vertex", "matrix", "points"])?;
                let vertex = find(need(b, "vertex")?)?;
                if kind != Kind::Edge || heads[vertex].1 != Kind::Vertex {
                    return Err(format!("`{key}` joins a vertex to an edge"));
                }
                let op = match get(b, "points") {
                    Some(points) if get(b, "matrix").is_none() => inclusion(points, (dim, heads[vertex].2))?,
                    _ => {
                        let place = Op::End(states.len(), end);
                        self.operator(need(b, "matrix")?, by_rows, (dim, heads[vertex].2), place)?
                    }
                };
                Ok(Some((vertex, op)))
            };
            let ends = [boundary("left", End::Start)?, boundary("right", End::Finish)?];
            states.push(State { kind, dim, pieces, ends });
        }
        let start = match get(case, "start") {
            Some(value) => find(value)?,
            None if states.len() == 1 => 0,
            None => return Err("the key `start` is missing".to_owned()),
        };
        Ok((states, start))
    }

    fn shape(&self, case: &DeTable<'_>) -> Result<Shape, Problem> {
        let kind = match get(case, "kind").map(|v| text(v, "kind")).transpose()? {
            None | Some("curve") => Kind::Edge,
            Some("set") => Kind::Set,
            Some(_) => return Err("unknown kind".to_owned()),
        };
        let convention = get(case, "convention").map(|v| text(v, "convention")).transpose()?;
        let by_rows = convention == Some("rows");
        let forms = ["map", "state", "pieces"].into_iter().filter(|k| get(case, k).is_some()).count();
        if forms != 1 || !matches!(convention, None | Some("rows" | "columns")) {
            return Err("one of `pieces`, `map` and `state`, and a known convention, are needed".to_owned());
        }
        let simple = |pieces: Vec<Piece>| -> Result<State, Problem> {
            let dim = pieces.first().ok_or("there is no piece")?.op.rows;
            if pieces.iter().any(|p| p.op.rows != dim) || (kind != Kind::Edge && pieces.iter().any(|p| p.reversed)) {
                return Err("operators of different sizes, or a set with reversed pieces".to_owned());
            }
            Ok(State { kind, dim, pieces, ends: [None, None] })
        };
        let (states, start) = if let Some(maps) = get(case, "map") {
            if by_rows || ["start", "reversed", "control"].iter().any(|k| get(case, k).is_some()) {
                return Err("this key does not go with [[map]]".to_owned());
            }
            let maps = array(maps, "map")?.into_iter().map(|m| self.affine(table(m, "map")?));
            (vec![simple(maps.collect::<Result<_, _>>()?)?], 0)
        } else {
            if convention.is_none() {
                return Err("the key `convention` is missing".to_owned());
            }
            if get(case, "state").is_some() {
                if get(case, "reversed").is_some() {
                    return Err("`reversed` does not go with [[state]]".to_owned());
                }
                self.automaton(case, kind, by_rows)?
            } else {
                if get(case, "start").is_some() {
                    return Err("`start` does not go with `pieces`".to_owned());
                }
                let mut pieces = Vec::new();
                for value in array(need(case, "pieces")?, "pieces")? {
                    let n = self.matrix(value, "pieces")?.rows;
                    let op = self.operator(value, by_rows, (n, n), Op::Piece(0, pieces.len()))?;
                    pieces.push(Piece { target: 0, op, reversed: false });
                }
                for value in get(case, "reversed").map_or(Ok(Vec::new()), |v| array(v, "reversed"))? {
                    let k = index(value, pieces.len(), "reversed")?;
                    pieces[k].reversed = true;
                }
                (vec![simple(pieces)?], 0)
            }
        };
        let dim = states[start].dim;
        let view = match get(case, "control") {
            Some(value) => self.matrix(value, "control")?.transpose(),
            None if get(case, "map").is_some() => Matrix::ones(dim - 1, dim, |i, j| i + 1 == j),
            None => Matrix::identity(dim),
        };
        let counts = states.iter().all(|s| (1..=MAX_PIECES).contains(&s.pieces.len()));
        let vertices = states.iter().all(|s| s.kind != Kind::Vertex || s.pieces.len() == 1);
        if view.cols != dim || !counts || !vertices {
            return Err("a wrong number of control points or of pieces".to_owned());
        }
        Ok(Shape { states, start, view })
    }
}

/// Reads a case file.
///
/// # Errors
/// What is wrong, in words.
pub fn read(source: &str) -> Result<Case, Problem> {
    let (case, _) = read_with(source, false)?;
    Ok(case)
}

/// Reads a case file with unknown entries. Faces and reversals are refused, because the identities of both are not read.
///
/// # Errors
/// What is wrong, in words.
pub fn read_open(source: &str) -> Result<Open, Problem> {
    let (case, holes) = read_with(source, true)?;
    Ok(Open { name: case.name, shape: case.shape, holes })
}

fn read_with(source: &str, open: bool) -> Result<(Case, Vec<Hole>), Problem> {
    let parsed = DeTable::parse(source).map_err(|e| format!("not TOML: {}", e.message()))?;
    let case = parsed.get_ref();
    known(case, &CASE_KEYS)?;
    let states = get(case, "state").map_or(Ok(Vec::new()), |v| array(v, "state"))?;
    let beyond = |s: &&DeValue<'_>| {
        let has = |key: &str| s.as_table().is_some_and(|t| get(t, key).is_some());
        has("reversal") || has("layout")
    };
    if open && states.iter().any(beyond) {
        return Err("the identities of faces and reversals are not read".to_owned());
    }
    let reader = Reader { bits: Cell::new(0), open, holes: RefCell::default() };
    let shape = reader.shape(case)?;
    let mut examine = Vec::new();
    for entry in get(case, "examine").map_or(Ok(Vec::new()), |v| array(v, "examine"))? {
        let entry = table(entry, "examine")?;
        known(entry, &["address"])?;
        let written = text(need(entry, "address")?, "address")?;
        let address = Address::parse(written).and_then(|a| a.normalise(&shape, shape.start));
        examine.push(address.ok_or_else(|| format!("`{written}` is no address of this case"))?);
    }
    let holes = reader.holes.into_inner().into_iter().map(|(hole, _)| hole).collect();
    Ok((Case { name: text(need(case, "name")?, "name")?.to_owned(), shape, examine }, holes))
}

/// Reads a file of matrices (a set, or an automaton of them), as `docs/radius.md` describes.
pub fn matrix_list(text: &str) -> Result<crate::radius::System, Problem> {
    let parsed = DeTable::parse(text).map_err(|e| e.message().to_owned())?;
    let file = parsed.get_ref();
    known(file, &["name", "matrices", "states", "arrows"])?;
    let reader = Reader { bits: Cell::new(0), open: false, holes: RefCell::default() };
    let mut matrices: Vec<Matrix> = Vec::new();
    for item in array(need(file, "matrices")?, "matrices")? {
        if let DeValue::Array(rows) = item {
            let entries = rows.iter().filter_map(|r| r.get_ref().as_array()).flatten();
            if entries.into_iter().any(|x| matches!(x.get_ref(), DeValue::Float(_))) {
                return Err("numbers of matrices are integers or texts".to_owned());
            }
        }
        matrices.push(reader.matrix(item, "matrices")?);
    }
    let name = get(file, "name").map(text_of).transpose()?.unwrap_or_default();
    let (dims, arrows) = match (get(file, "states"), get(file, "arrows")) {
        (None, None) => {
            let dim = matrices.first().map(|m| m.rows).ok_or("no matrix")?;
            (vec![dim], (0..matrices.len()).map(|k| (0, 0, matrices[k].clone())).collect::<Vec<_>>())
        }
        (states, arrows) => {
            let states = array(states.ok_or("`states` is missing")?, "states")?;
            let dims = states.iter().map(|v| index(v, MAX_COORDINATES + 1, "states")).collect::<Result<Vec<_>, _>>()?;
            let mut list = Vec::new();
            for arrow in array(arrows.ok_or("`arrows` is missing")?, "arrows")? {
                let parts = array(arrow, "arrows")?;
                let [from, to, matrix] = parts[..] else { return Err("an arrow is [from, to, matrix]".to_owned()) };
                let (from, to) = (index(from, dims.len(), "arrows")?, index(to, dims.len(), "arrows")?);
                list.push((from, to, matrices[index(matrix, matrices.len(), "arrows")?].clone()));
            }
            (dims, list)
        }
    };
    let fits = |(from, to, m): &(usize, usize, Matrix)| (m.rows, m.cols) == (dims[*from], dims[*to]);
    if arrows.is_empty() || !arrows.iter().all(fits) {
        return Err("no arrow, or a matrix of the wrong size".to_owned());
    }
    Ok(crate::radius::System { name, dims, arrows })
}

fn text_of(value: &DeValue<'_>) -> Result<String, Problem> {
    text(value, "name").map(str::to_owned)
}
