//! Reads the case file itself, so that a proof cannot be about another case.

use crate::json::{Json, Node};
use crate::matrix::Matrix;
use crate::number::{Q, bits, decimal_fraction};
use crate::shape::{Address, End, Kind, Op, Piece, Shape, State};
use crate::{Checked, Rejected};
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
    /// The shape; unknown entries are 0.
    pub shape: Shape,
    /// The addresses under `[[examine]]`, in their normal form.
    pub examine: Vec<Address>,
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
    by_rows: bool,
    open: bool,
    bits: Cell<u64>,
    holes: RefCell<Vec<(Hole, String)>>,
}

/// A value of a TOML file: numbers keep the text in which they are written.
fn tree(value: &DeValue<'_>) -> Json {
    match value {
        DeValue::String(text) => Json::Text(text.to_string()),
        DeValue::Integer(digits) if digits.radix() == 10 => Json::Number(digits.as_str().to_owned()),
        DeValue::Float(digits) => Json::Number(digits.as_str().to_owned()),
        DeValue::Boolean(flag) => Json::Flag(*flag),
        DeValue::Array(items) => Json::List(items.iter().map(|v| tree(v.get_ref())).collect()),
        DeValue::Table(table) => fields(table),
        _ => Json::Null,
    }
}

fn fields(table: &DeTable<'_>) -> Json {
    Json::Object(table.iter().map(|(k, v)| (k.get_ref().to_string(), tree(v.get_ref()))).collect())
}

/// Reads a TOML file with these keys at its top by a function; what is wrong makes the file unreadable.
pub fn file<T>(source: &str, keys: &[&str], read: impl FnOnce(&Node<'_>) -> Checked<T>) -> Checked<T> {
    let unreadable = |place: String, why: String| Rejected { rule: "case".to_owned(), place, why, unreadable: true };
    let parsed = DeTable::parse(source).map_err(|e| unreadable(String::new(), format!("not TOML: {}", e.message())))?;
    let value = fields(parsed.get_ref());
    let node = Node { value: &value, place: "case".to_owned() };
    node.known(keys).and_then(|()| read(&node)).map_err(|r| unreadable(r.place, r.why))
}

/// A whole number of a TOML file below a bound.
pub fn index(node: &Node<'_>, bound: usize) -> Checked<usize> {
    let digits = if let Json::Number(digits) = node.value { digits.parse::<usize>().ok() } else { None };
    match digits.filter(|k| *k < bound) {
        Some(k) => Ok(k),
        None => node.malformed(&format!("a whole number below {bound} is needed here")),
    }
}

fn flag(node: &Node<'_>, key: &str) -> Checked<bool> {
    match node.get(key).map(|n| (n.value, n)) {
        None => Ok(false),
        Some((Json::Flag(flag), _)) => Ok(*flag),
        Some((_, n)) => n.malformed("true or false is needed here"),
    }
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

impl Reader {
    fn number(&self, node: &Node<'_>) -> Checked<Q> {
        let (Json::Text(text) | Json::Number(text)) = node.value else {
            return node.malformed("a number is needed here");
        };
        let Some(number) = decimal_fraction(text) else { return node.malformed("not an exact number") };
        self.bits.set(self.bits.get().saturating_add(bits(&number)));
        node.need(self.bits.get() <= MAX_BITS, "limit", "the numbers are too long")?;
        Ok(number)
    }

    fn matrix(&self, node: &Node<'_>) -> Checked<Matrix> {
        let row = |row: &Node<'_>| row.list()?.iter().map(|x| self.number(x)).collect::<Checked<Vec<Q>>>();
        let rows = node.list()?.iter().map(row).collect::<Checked<Vec<_>>>()?;
        let cols = rows.first().map_or(0, Vec::len);
        let fits = |n: usize| (1..=MAX_COORDINATES).contains(&n);
        let regular = fits(rows.len()) && fits(cols) && rows.iter().all(|r| r.len() == cols);
        node.need(regular, "case", &format!("not a matrix of 1 to {MAX_COORDINATES} rows and columns"))?;
        Ok(Matrix::from_rows(cols, &rows))
    }

    /// An operator on columns of barycentric coordinates of the given size, all of whose columns sum to 1. Where entries may be
    /// unknown (`"?"` or `"?name"`, or `"?"` for all), these are noted and 0.
    fn operator(&self, node: &Node<'_>, size: (usize, usize), op: Op) -> Checked<Matrix> {
        let name = |n: &Node<'_>| match n.value {
            Json::Text(text) if self.open => text.strip_prefix('?').map(str::to_owned),
            _ => None,
        };
        let (all, noted) = (name(node).is_some(), self.holes.borrow().len());
        let rows = if all { Vec::new() } else { node.list()?.iter().map(Node::list).collect::<Checked<Vec<_>>>()? };
        let written = if self.by_rows { (size.1, size.0) } else { size };
        let fits = all || (rows.len() == written.0 && rows.iter().all(|r| r.len() == written.1));
        node.need(fits, "case", "the operator has the wrong size")?;
        let mut entries = Vec::new();
        for (row, col) in (0..size.0).flat_map(|i| (0..size.1).map(move |j| (i, j))) {
            let at = if all {
                node
            } else if self.by_rows {
                &rows[col][row]
            } else {
                &rows[row][col]
            };
            let Some(name) = name(at) else {
                entries.push(self.number(at)?);
                continue;
            };
            let mut holes = self.holes.borrow_mut();
            at.need(holes.len() < MAX_HOLES, "limit", "too many unknown entries")?;
            let known = holes.iter().find(|(_, n)| !name.is_empty() && *n == name).map(|(h, _)| h.unknown);
            let unknown = known.unwrap_or_else(|| holes.iter().map(|(h, _)| h.unknown + 1).max().unwrap_or(0));
            holes.push((Hole { op, row, col, unknown }, name));
            entries.push(Q::zero());
        }
        let matrix = Matrix::new(size.0, size.1, &entries);
        let sum = |j: usize| (0..size.0).map(|i| &matrix.data[i * size.1 + j]).sum::<BigInt>();
        let affine = self.holes.borrow().len() > noted || (0..size.1).all(|j| sum(j) == matrix.den);
        node.need(affine, "case", "a column of an operator does not sum to 1")?;
        Ok(matrix)
    }

    /// The operator on the simplex `0, e_1, …, e_d` of `x -> linear x + shift`.
    fn affine(&self, map: &Node<'_>) -> Checked<Piece> {
        map.known(&["linear", "shift", "reversed"])?;
        let linear = self.matrix(&map.field("linear")?)?;
        let shift = map.field("shift")?.list()?.iter().map(|x| self.number(x)).collect::<Checked<Vec<Q>>>()?;
        let d = shift.len();
        let fits = d < MAX_COORDINATES && (linear.rows, linear.cols) == (d, d);
        map.need(fits, "case", "`linear` and `shift` do not fit")?;
        let image = |i: usize, j: usize| if j == 0 { shift[i].clone() } else { &shift[i] + linear.at(i, j - 1) };
        let entry = |(i, j): (usize, usize)| match i {
            0 => Q::one() - (0..d).map(|i| image(i, j)).sum::<Q>(),
            _ => image(i - 1, j),
        };
        let places = (0..=d).flat_map(|i| (0..=d).map(move |j| (i, j)));
        let op = Matrix::new(d + 1, d + 1, &places.map(entry).collect::<Vec<_>>());
        Ok(Piece { target: 0, op, reversed: flag(map, "reversed")? })
    }

    fn automaton(&self, tables: &[Node<'_>], default: Kind) -> Checked<(Vec<State>, Vec<String>)> {
        let mut heads: Vec<(String, Kind, usize)> = Vec::new();
        for t in tables {
            t.known(&STATE_KEYS)?;
            let name = t.field("name")?.text()?;
            let kind = match t.get("kind").map(|n| n.text()).transpose()? {
                None => default,
                Some("edge") => Kind::Edge,
                Some("vertex") => Kind::Vertex,
                // No rule uses the boundaries of a face: its claims are about a set.
                Some("set" | "face") => Kind::Set,
                Some(_) => return t.malformed("unknown kind of a state"),
            };
            let dim = match (t.get("dimension"), t.field("piece")?.list()?.first()) {
                (Some(n), _) => index(&n, MAX_COORDINATES + 1)?,
                (None, None) => 0,
                (None, Some(first)) => {
                    let rows = first.field("matrix")?.list()?;
                    if self.by_rows { rows.first().map_or(Ok(Vec::new()), Node::list)?.len() } else { rows.len() }
                }
            };
            let new = (1..=MAX_COORDINATES).contains(&dim) && heads.iter().all(|h| h.0 != name);
            t.need(new, "case", "a state without coordinates, or two states of one name")?;
            heads.push((name.to_owned(), kind, dim));
        }
        let find = |node: Node<'_>| state_named(&node, heads.iter().map(|h| &h.0));
        let mut states = Vec::new();
        for (t, &(_, kind, dim)) in tables.iter().zip(&heads) {
            let mut pieces = Vec::new();
            for piece in t.field("piece")?.list()? {
                piece.known(&["to", "matrix", "reversed", "corners"])?;
                let (target, reversed) = (find(piece.field("to")?)?, flag(&piece, "reversed")?);
                let place = Op::Piece(states.len(), pieces.len());
                let op = self.operator(&piece.field("matrix")?, (dim, heads[target].2), place)?;
                let fits = (kind == Kind::Set || heads[target].1 == kind) && (!reversed || kind == Kind::Edge);
                piece.need(fits, "case", "the piece is of another kind, or runs backwards in no curve")?;
                pieces.push(Piece { target, op, reversed });
            }
            let boundary = |key: &str, end: End| -> Checked<Option<(usize, Matrix)>> {
                let Some(b) = t.get(key).filter(|b| kind != Kind::Set || b.get("edge").is_none()) else {
                    return Ok(None);
                };
                b.known(&["vertex", "matrix", "points"])?;
                let vertex = find(b.field("vertex")?)?;
                let joins = kind == Kind::Edge && heads[vertex].1 == Kind::Vertex;
                b.need(joins, "case", "a boundary joins a vertex to an edge")?;
                let size = (dim, heads[vertex].2);
                let op = match b.get("points").filter(|_| b.get("matrix").is_none()) {
                    Some(points) => inclusion(&points, size)?,
                    None => self.operator(&b.field("matrix")?, size, Op::End(states.len(), end))?,
                };
                Ok(Some((vertex, op)))
            };
            let ends = [boundary("left", End::Start)?, boundary("right", End::Finish)?];
            states.push(State { kind, dim, pieces, ends });
        }
        Ok((states, heads.into_iter().map(|h| h.0).collect()))
    }

    fn shape(&self, case: &Node<'_>) -> Checked<Shape> {
        let kind = match case.get("kind").map(|n| n.text()).transpose()? {
            None | Some("curve") => Kind::Edge,
            Some("set") => Kind::Set,
            Some(_) => return case.malformed("unknown kind"),
        };
        let (maps, pieces, tables) = (case.get("map"), case.get("pieces"), case.get("state"));
        let none = |keys: &[&str]| {
            let found = keys.iter().find(|k| case.get(k).is_some());
            case.need(found.is_none(), "case", &format!("the key {found:?} does not go with this form of a case"))
        };
        let mut start = 0;
        let states = match (&maps, &pieces, &tables) {
            (Some(maps), None, None) => {
                none(&["start", "reversed", "control"])?;
                case.need(!self.by_rows, "case", "maps have no convention of rows")?;
                let pieces = maps.list()?.iter().map(|m| self.affine(m)).collect::<Checked<Vec<_>>>()?;
                vec![State { kind, dim: pieces.first().map_or(0, |p| p.op.rows), pieces, ends: [None, None] }]
            }
            (None, Some(list), None) => {
                none(&["start"])?;
                let list = list.list()?;
                let dim = list.first().map_or(Ok(0), |m| Ok(m.list()?.len()))?;
                let read = |(k, m): (usize, &Node<'_>)| -> Checked<Piece> {
                    Ok(Piece { target: 0, op: self.operator(m, (dim, dim), Op::Piece(0, k))?, reversed: false })
                };
                let mut pieces = list.iter().enumerate().map(read).collect::<Checked<Vec<_>>>()?;
                for n in case.get("reversed").map_or(Ok(Vec::new()), |n| n.list())? {
                    pieces[index(&n, list.len())?].reversed = true;
                }
                vec![State { kind, dim, pieces, ends: [None, None] }]
            }
            (None, None, Some(tables)) => {
                none(&["reversed"])?;
                let tables = tables.list()?;
                case.need(tables.len() <= MAX_STATES, "limit", "too many states")?;
                let (states, names) = self.automaton(&tables, kind)?;
                start = match case.get("start") {
                    Some(node) => state_named(&node, names.iter())?,
                    None => 0,
                };
                case.need(case.get("start").is_some() || states.len() == 1, "case", "the key `start` is missing")?;
                states
            }
            _ => return case.malformed("one of `pieces`, `map` and `state` is needed"),
        };
        let fits = |s: &State| {
            let same = tables.is_some() || s.pieces.iter().all(|p| p.op.rows == s.dim);
            let backwards = s.kind != Kind::Edge && s.pieces.iter().any(|p| p.reversed);
            let count = if s.kind == Kind::Vertex { 1..=1 } else { 1..=MAX_PIECES };
            same && !backwards && (1..=MAX_COORDINATES).contains(&s.dim) && count.contains(&s.pieces.len())
        };
        let all = !states.is_empty() && states.iter().all(fits);
        case.need(all, "case", "a wrong number of pieces or coordinates, or a set with reversed pieces")?;
        let dim = states[start].dim;
        let view = match case.get("control") {
            Some(points) => self.matrix(&points)?.transpose(),
            None if maps.is_some() => Matrix::ones(dim - 1, dim, |i, j| i + 1 == j),
            None => Matrix::identity(dim),
        };
        case.need(view.cols == dim, "case", "a wrong number of control points")?;
        Ok(Shape { states, start, view })
    }
}

/// The number of the state that is named here.
fn state_named<'n>(node: &Node<'_>, mut names: impl Iterator<Item = &'n String>) -> Checked<usize> {
    let name = node.text()?;
    match names.position(|n| n == name) {
        Some(k) => Ok(k),
        None => node.malformed("there is no state of this name"),
    }
}

/// The operator that puts coordinate `j` at `points[j]`.
fn inclusion(points: &Node<'_>, (rows, cols): (usize, usize)) -> Checked<Matrix> {
    let at = points.list()?.iter().map(|p| index(p, rows)).collect::<Checked<Vec<_>>>()?;
    points.need(at.len() == cols, "case", &format!("{cols} points are needed here"))?;
    Ok(Matrix::ones(rows, cols, |i, j| at[j] == i))
}

/// Reads a case file; with `open`, entries may be unknown, and faces and reversals are refused, because the identities of both
/// are not read.
///
/// # Errors
/// What is wrong, and where; `unreadable` is set.
pub fn read(source: &str, open: bool) -> Checked<Case> {
    file(source, &CASE_KEYS, |case| {
        let by_rows = match case.get("convention").map(|n| n.text()).transpose()? {
            Some("rows") => true,
            Some("columns") => false,
            None if case.get("map").is_some() => false,
            _ => return case.malformed("the convention is rows or columns"),
        };
        for state in case.get("state").filter(|_| open).map_or(Ok(Vec::new()), |n| n.list())? {
            let beyond = state.get("reversal").is_some() || state.get("layout").is_some();
            state.need(!beyond, "case", "the identities of faces and reversals are not read")?;
        }
        let reader = Reader { by_rows, open, bits: Cell::new(0), holes: RefCell::default() };
        let shape = reader.shape(case)?;
        let mut examine = Vec::new();
        for entry in case.get("examine").map_or(Ok(Vec::new()), |n| n.list())? {
            let [address] = entry.fields(["address"])?;
            match Address::parse(address.text()?).and_then(|a| a.normalise(&shape, shape.start)) {
                Some(normal) => examine.push(normal),
                None => return address.malformed("this is no address of the case"),
            }
        }
        let holes = reader.holes.into_inner().into_iter().map(|(hole, _)| hole).collect();
        Ok(Case { name: case.field("name")?.text()?.to_owned(), shape, examine, holes })
    })
}

/// Reads more of the states of a case.
pub fn states<T>(source: &str, read: impl FnOnce(&[Node<'_>]) -> Checked<T>) -> Checked<T> {
    file(source, &CASE_KEYS, |case| read(&case.get("state").map_or(Ok(Vec::new()), |n| n.list())?))
}

/// A list of whole numbers below a bound.
pub fn indices(node: &Node<'_>, bound: usize) -> Checked<Vec<usize>> {
    node.list()?.iter().map(|n| index(n, bound)).collect()
}

/// Reads a file of matrices (a set, or an automaton of them), as `docs/radius.md` describes.
pub fn matrix_list(source: &str) -> Checked<crate::radius::System> {
    file(source, &["name", "matrices", "states", "arrows"], |node| {
        let reader = Reader { by_rows: false, open: false, bits: Cell::new(0), holes: RefCell::default() };
        let mut matrices: Vec<Matrix> = Vec::new();
        for item in node.field("matrices")?.list()? {
            for x in item.list()?.iter().map(Node::list).collect::<Checked<Vec<_>>>()?.iter().flatten() {
                let whole = |text: &String| text.bytes().all(|b| b.is_ascii_digit() || b == b'-' || b == b'+');
                let exact = if let Json::Number(text) = x.value { whole(text) } else { true };
                x.need(exact, "case", "numbers of matrices are integers or texts")?;
            }
            matrices.push(reader.matrix(&item)?);
        }
        let name = node.get("name").map(|n| n.text()).transpose()?.unwrap_or_default().to_owned();
        let (dims, arrows) = if node.get("states").is_none() && node.get("arrows").is_none() {
            let dim = matrices.first().map_or(0, |m| m.rows);
            (vec![dim], matrices.into_iter().map(|m| (0, 0, m)).collect::<Vec<_>>())
        } else {
            let states = node.field("states")?.list()?;
            let dims = states.iter().map(|v| index(v, MAX_COORDINATES + 1)).collect::<Checked<Vec<_>>>()?;
            let mut list = Vec::new();
            for arrow in node.field("arrows")?.list()? {
                let parts = arrow.list()?;
                let [from, to, matrix] = &parts[..] else { return arrow.malformed("an arrow is [from, to, matrix]") };
                let matrix = &matrices[index(matrix, matrices.len())?];
                list.push((index(from, dims.len())?, index(to, dims.len())?, matrix.clone()));
            }
            (dims, list)
        };
        let fits = |(from, to, m): &(usize, usize, Matrix)| (m.rows, m.cols) == (dims[*from], dims[*to]);
        let all = !arrows.is_empty() && arrows.iter().all(fits);
        node.need(all, "case", "no arrow, or a matrix of the wrong size")?;
        Ok(crate::radius::System { name, dims, arrows })
    })
}
