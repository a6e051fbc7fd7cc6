//! Reads the case file itself, so that a proof cannot be about another case.

use super::{Address, End, Kind, Op, Piece, Shape, State, scheme};
use crate::base::{
    Checked, Fraction, Json, MAX_COORDINATES, MAX_PIECES, Matrix, Node, Q, Whole, file, flag, index, items, matrix,
    need, number, word,
};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cell::RefCell;

/// Most states of a case.
pub const MAX_STATES: usize = 64;
/// Most unknown entries.
const MAX_HOLES: usize = 4_096;

/// A case: its name, its shape, and the addresses it asks about.
pub struct Case<T = BigInt> {
    /// The name.
    pub name: String,
    /// The shape; unknown entries are 0.
    pub shape: Shape<T>,
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

/// The keys of a case, and of a state; those of the boundaries of faces and of reversals are not read.
const CASE: &str = "name title source kind convention pieces reversed shares map scheme interpolate start state control examine expect";
const STATE: &str = "name kind dimension left right piece reversal layout bottom top side01 side12 side02";

/// What must be known of all states before their pieces are read.
struct Head<'a> {
    name: &'a str,
    kind: Kind,
    dim: usize,
    pieces: Vec<Node<'a>>,
}

/// The number of the state that is named here.
fn state_named(node: &Node<'_>, heads: &[Head<'_>]) -> Checked<usize> {
    let name = node.text()?;
    node.some(heads.iter().position(|h| h.name == name), "format", "there is no state of this name")
}

/// Reads the operators of a case; where entries may be unknown, their places and names are collected.
struct Reader<'g, T: Whole> {
    ground: &'g T::Ground,
    by_rows: bool,
    open: bool,
    holes: RefCell<Vec<(Hole, String)>>,
}

impl<T: Whole> Reader<'_, T> {
    /// An operator on columns of barycentric coordinates of the given size, all of whose columns sum to 1. Where entries may be
    /// unknown (`"?"` or `"?name"`, or `"?"` for all), these are noted and 0.
    fn operator(&self, node: &Node<'_>, size: (usize, usize), op: Op) -> Checked<Matrix<T>> {
        let name = |n: &Node<'_>| match n.value {
            Json::Text(text) if self.open => text.strip_prefix('?').map(str::to_owned),
            _ => None,
        };
        let (all, noted) = (name(node).is_some(), self.holes.borrow().len());
        let rows = if all { Vec::new() } else { node.each(Node::list)? };
        let written = if self.by_rows { (size.1, size.0) } else { size };
        let fits = all || (rows.len() == written.0 && rows.iter().all(|r| r.len() == written.1));
        node.need(fits, "case", "the operator has the wrong size")?;
        let mut entries: Vec<Fraction<T>> = Vec::new();
        for (row, col) in (0..size.0).flat_map(|i| (0..size.1).map(move |j| (i, j))) {
            let (i, j) = if self.by_rows { (col, row) } else { (row, col) };
            let at = if all { node } else { &rows[i][j] };
            let Some(name) = name(at) else {
                entries.push(T::given(at, self.ground)?);
                continue;
            };
            let mut holes = self.holes.borrow_mut();
            at.need(holes.len() < MAX_HOLES, "limit", "too many unknown entries")?;
            let known = holes.iter().find(|(_, n)| !name.is_empty() && *n == name).map(|(h, _)| h.unknown);
            let unknown = match known {
                Some(known) => known,
                None => holes.iter().fold(0, |next, (h, _)| next.max(h.unknown + 1)),
            };
            holes.push((Hole { op, row, col, unknown }, name));
            entries.push((T::integer(BigInt::zero()), BigInt::one()));
        }
        let matrix = Matrix::fractions(size.0, size.1, &entries);
        let affine = self.holes.borrow().len() > noted || matrix.is_affine();
        node.need(affine, "case", "a column of an operator does not sum to 1")?;
        Ok(matrix)
    }

    /// The operator on the simplex `0, e_1, …, e_d` of `x -> linear x + shift`.
    fn affine(&self, map: &Node<'_>) -> Checked<Matrix<T>> {
        map.known("linear shift reversed share")?;
        let linear: Matrix<T> = matrix(&map.field("linear")?, self.ground)?;
        let shift = map.field("shift")?.each(|x| T::given(x, self.ground))?;
        let d = shift.len();
        let fits = d < MAX_COORDINATES && (linear.rows, linear.cols) == (d, d);
        map.need(fits, "case", "`linear` and `shift` do not fit")?;
        // Column j is the image of e_j; its first entry makes the sum 1.
        let shift = Matrix::fractions(d, 1, &shift);
        let images = shift.beside(&linear.plus(&Q::one(), &shift.times(&Matrix::row_of_ones(d))?));
        let first = Matrix::row_of_ones(d + 1).minus(&Matrix::row_of_ones(d).times(&images)?);
        Ok(first.stack(&images))
    }

    /// The pieces of a state: affine maps, plain operators (of the only state), or tables that name their targets.
    fn pieces(&self, e: usize, heads: &[Head<'_>], form: Form) -> Checked<Vec<Piece<T>>> {
        let Head { kind, dim, pieces, .. } = &heads[e];
        let mut read = Vec::new();
        for (k, piece) in pieces.iter().enumerate() {
            let (target, op, reversed) = match form {
                Form::Maps => (0, self.affine(piece)?, flag(piece, "reversed")?),
                Form::Pieces => (0, self.operator(piece, (*dim, *dim), Op::Piece(e, k))?, false),
                Form::States => {
                    piece.known("to matrix reversed corners share")?;
                    let (target, reversed) = (state_named(&piece.field("to")?, heads)?, flag(piece, "reversed")?);
                    let size = (*dim, heads[target].dim);
                    (target, self.operator(&piece.field("matrix")?, size, Op::Piece(e, k))?, reversed)
                }
            };
            let same_kind = *kind == Kind::Set || heads[target].kind == *kind;
            let fits = same_kind && op.rows == *dim && (!reversed || *kind == Kind::Edge);
            piece.need(fits, "case", "the piece is of another kind or size, or runs backwards in no curve")?;
            let share = if form == Form::Pieces { None } else { piece.get("share").map(|n| number(&n)).transpose()? };
            read.push(Piece { target, op, reversed, share });
        }
        let most = if *kind == Kind::Vertex { 1 } else { MAX_PIECES };
        let count = (1..=most).contains(&read.len()) && (1..=MAX_COORDINATES).contains(dim);
        need(count, "case", format_args!("a wrong number of pieces or coordinates of state {e}"))?;
        Ok(read)
    }

    fn head<'a>(&self, table: &Node<'a>, default: Kind) -> Checked<Head<'a>> {
        let built = ["chain", "scheme"].iter().find(|key| table.get(key).is_some());
        let what = "a state that is a chain or names a scheme is not built here";
        table.need(built.is_none(), "scheme", format_args!("{what}: {}", scheme::ELSEWHERE))?;
        table.known(STATE)?;
        let pieces = table.field("piece")?.list()?;
        let kind = match word(table, "kind")? {
            None => default,
            Some("edge") => Kind::Edge,
            Some("vertex") => Kind::Vertex,
            // No rule uses the boundaries of a face: its claims are about a set.
            Some("set" | "face") => Kind::Set,
            Some(_) => return table.reject("format", "unknown kind of a state"),
        };
        if word(table, "kind")? == Some("face") {
            let triangle = table.field("layout")?.text()? == "triangle";
            let sides = if triangle { "side01 side12 side02" } else { "bottom right top left" };
            let given = sides.split(' ').filter(|side| table.get(side).is_some()).count();
            let whole = given == 0 || given == sides.split(' ').count();
            table.need(whole, "case", "a face has all of its sides, or none")?;
        }
        let dim = match (table.get("dimension"), pieces.first()) {
            (Some(n), _) => index(&n, MAX_COORDINATES + 1)?,
            (None, None) => 0,
            (None, Some(first)) => {
                let rows = first.field("matrix")?.list()?;
                match rows.first() {
                    Some(row) if self.by_rows => row.list()?.len(),
                    _ => rows.len(),
                }
            }
        };
        Ok(Head { name: table.field("name")?.text()?, kind, dim, pieces })
    }

    /// A boundary operator of an edge, where the state has it.
    fn boundary(
        &self,
        e: usize,
        heads: &[Head<'_>],
        table: &Node<'_>,
        end: End,
    ) -> Checked<Option<(usize, Matrix<T>)>> {
        let key = if end == End::Start { "left" } else { "right" };
        let kind = heads[e].kind;
        let Some(b) = table.get(key).filter(|b| kind != Kind::Set || b.get("edge").is_none()) else { return Ok(None) };
        let (vertex, op) = self.part(e, heads, &b, "vertex", Op::End(e, end))?;
        let joins = kind == Kind::Edge && heads[vertex].kind == Kind::Vertex;
        b.need(joins, "case", "a boundary joins a vertex to an edge")?;
        Ok(Some((vertex, op)))
    }

    /// What a state has of another one: the state named under a key, and the operator from its coordinates.
    fn part(&self, e: usize, heads: &[Head<'_>], b: &Node<'_>, key: &str, op: Op) -> Checked<(usize, Matrix<T>)> {
        b.known(&format!("{key} matrix points"))?;
        let from = state_named(&b.field(key)?, heads)?;
        let (rows, cols) = (heads[e].dim, heads[from].dim);
        let op = match b.get("points").filter(|_| b.get("matrix").is_none()) {
            None => self.operator(&b.field("matrix")?, (rows, cols), op)?,
            Some(points) => {
                // Coordinate j is put at points[j].
                let at = points.each(|p| index(p, rows))?;
                points.need(at.len() == cols, "case", format_args!("{cols} points are needed here"))?;
                Matrix::ones(rows, cols, |i, j| at[j] == i)
            }
        };
        Ok((from, op))
    }

    /// The sides of a face are read, so that both readers refuse the same; no rule uses them.
    fn sides(&self, e: usize, heads: &[Head<'_>], table: &Node<'_>) -> Checked<()> {
        if word(table, "kind")? != Some("face") {
            return Ok(());
        }
        for (k, key) in "side01 side12 side02 bottom right top left".split(' ').enumerate() {
            if let Some(side) = table.get(key) {
                let (edge, _) = self.part(e, heads, &side, "edge", Op::Side(e, k))?;
                side.need(heads[edge].kind == Kind::Edge, "case", "a side of a face comes from an edge")?;
            }
        }
        Ok(())
    }

    fn shape(&self, case: &Node<'_>) -> Checked<Shape<T>> {
        let kind = match word(case, "kind")? {
            None | Some("curve") => Kind::Edge,
            Some("set") => Kind::Set,
            Some(_) => return case.reject("format", "unknown kind"),
        };
        let (form, list, without) = match (case.get("map"), case.get("pieces"), case.get("state")) {
            (Some(maps), None, None) => (Form::Maps, maps.list()?, "start reversed shares control"),
            (None, Some(pieces), None) => (Form::Pieces, pieces.list()?, "start"),
            (None, None, Some(tables)) => (Form::States, tables.list()?, "reversed shares"),
            _ => return case.reject("format", "one of `pieces`, `map` and `state` is needed"),
        };
        let fits = without.split(' ').all(|key| case.get(key).is_none());
        case.need(fits, "case", format_args!("the keys {without} do not go with this form of a case"))?;
        let heads = match (form, list.first()) {
            (Form::States, _) => list.iter().map(|t| self.head(t, kind)).collect::<Checked<Vec<_>>>()?,
            (Form::Maps, Some(map)) => {
                vec![Head { name: "", kind, dim: 1 + map.field("shift")?.list()?.len(), pieces: list.clone() }]
            }
            (_, Some(op)) => vec![Head { name: "", kind, dim: op.list()?.len(), pieces: list.clone() }],
            _ => Vec::new(),
        };
        let new = |k: usize| heads[..k].iter().all(|h| h.name != heads[k].name);
        let count = (1..=MAX_STATES).contains(&heads.len()) && (0..heads.len()).all(new);
        case.need(count, "case", "no state, too many, or two of one name")?;
        let mut states = Vec::new();
        for (e, head) in heads.iter().enumerate() {
            let pieces = self.pieces(e, &heads, form)?;
            let pieces = if form == Form::Maps && kind == Kind::Set { written_out(pieces)? } else { pieces };
            if form == Form::States {
                self.sides(e, &heads, &list[e])?;
            }
            let boundary = |end| if form == Form::States { self.boundary(e, &heads, &list[e], end) } else { Ok(None) };
            let ends = [boundary(End::Start)?, boundary(End::Finish)?];
            states.push(State { kind: head.kind, dim: head.dim, pieces, ends });
        }
        for n in items(case, "reversed")? {
            states[0].pieces[index(&n, list.len())?].reversed = true;
            n.need(kind == Kind::Edge, "case", "only pieces of curves run backwards")?;
        }
        if let Some(shares) = case.get("shares") {
            for (piece, n) in states[0].pieces.iter_mut().zip(shares.exactly(list.len(), "case")?) {
                piece.share = Some(number(&n)?);
            }
        }
        case.need(
            states.iter().all(divides),
            "case",
            "the shares of a curve are positive, one for each piece, of sum 1",
        )?;
        let start = case.get("start").map(|node| state_named(&node, &heads)).transpose()?;
        let start = case.some(start.or((states.len() == 1).then_some(0)), "case", "the key `start` is missing")?;
        let dim = states[start].dim;
        let view = match case.get("control") {
            Some(points) => matrix(&points, self.ground)?.transpose(),
            None if form == Form::Maps => Matrix::ones(dim - 1, dim, |i, j| i + 1 == j),
            None => Matrix::identity(dim),
        };
        let (given, elsewhere) = (view.cols, scheme::ELSEWHERE);
        let why =
            format_args!("{given} control points for {dim} coordinates (a polygon of several spans: {elsewhere})");
        case.need(given == dim, "case", why)?;
        Ok(Shape::new(states, start, view))
    }
}

/// Largest order of a map that does not contract, and largest group of such maps.
const MAX_ORDER: usize = 12;
const MAX_GROUP: usize = 48;

/// The maps of a set, where some power of some of them is the identity: the products `g f` of the group that these generate with
/// the other maps, group by group, each map once.
fn written_out<T: Whole>(pieces: Vec<Piece<T>>) -> Checked<Vec<Piece<T>>> {
    let Some(one) = pieces.first().map(|p| Matrix::identity(p.op.rows)) else { return Ok(pieces) };
    let (mut turns, mut others) = (Vec::new(), Vec::new());
    for piece in &pieces {
        let (mut power, mut finite) = (piece.op.clone(), false);
        for _ in 0..MAX_ORDER {
            finite |= power == one;
            power = power.times(&piece.op)?;
        }
        (if finite { &mut turns } else { &mut others }).push(piece.op.clone());
    }
    if turns.is_empty() || others.is_empty() {
        return Ok(pieces);
    }
    let (mut group, mut next) = (vec![one], 0);
    while next < group.len() {
        for turn in &turns {
            let product = turn.times(&group[next])?;
            if !group.contains(&product) {
                group.push(product);
            }
        }
        if group.len() > MAX_GROUP {
            return Ok(pieces);
        }
        next += 1;
    }
    let mut all: Vec<Piece<T>> = Vec::new();
    for g in &group {
        for f in &others {
            let op = g.times(f)?;
            if all.iter().all(|p| p.op != op) {
                all.push(Piece { target: 0, op, reversed: false, share: None });
            }
        }
    }
    Ok(if all.len() <= MAX_PIECES { all } else { pieces })
}

/// Whether shares, where there are any, are those of all pieces of a curve, positive and of sum 1.
fn divides<T>(state: &State<T>) -> bool {
    let shares: Vec<&Q> = state.pieces.iter().flat_map(|p| &p.share).collect();
    let own = state.kind == Kind::Edge && shares.len() == state.pieces.len();
    let whole = || shares.iter().fold(Q::zero(), |sum, s| sum + *s) == Q::one();
    shares.is_empty() || own && shares.iter().all(|s| s.is_positive()) && whole()
}

/// The three forms of a case.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Maps,
    Pieces,
    States,
}

/// Reads more of the states of a case.
pub fn states<T>(source: &str, read: impl FnOnce(&[Node<'_>]) -> Checked<T>) -> Checked<T> {
    opened(source, |case| read(&items(case, "state")?))
}

/// Reads a case file by a function, which sees what a `[scheme]` stands for in its place.
fn opened<T>(source: &str, read: impl FnOnce(&Node<'_>) -> Checked<T>) -> Checked<T> {
    file(source, CASE, |case| {
        let (key, table) = match (case.get("scheme"), case.get("interpolate")) {
            (None, None) => return read(case),
            (Some(table), None) => ("scheme", table),
            (None, Some(table)) => ("interpolate", table),
            _ => return case.reject("format", "`scheme` and `interpolate` exclude each other"),
        };
        let Json::Object(keys) = case.value else { return case.reject("format", "a table is needed here") };
        let others =
            "pieces reversed shares map state start kind convention".split(' ').all(|key| case.get(key).is_none());
        case.need(others, "format", format_args!("`{key}` stands in place of the operators"))?;
        let data = key == "interpolate" || table.get("interpolate").is_some();
        case.need(!data || case.get("control").is_none(), "format", "the data say where the curve is seen")?;
        let built = if key == "scheme" { scheme::expanded(&table) } else { scheme::interpolated(&table) }?;
        // Control points of the case are those of the curve that is built.
        let built = built.into_iter().filter(|(key, _)| case.get(key).is_none());
        let keys = keys.iter().filter(|(name, _)| name != key).cloned().chain(built).collect();
        read(&Node { value: &Json::Object(keys), place: case.place.clone() })
    })
}

/// Reads the shape of a case that is written on columns.
pub fn shape(case: &Node<'_>) -> Checked<Shape> {
    Reader { ground: &(), by_rows: false, open: false, holes: RefCell::default() }.shape(case)
}

/// Reads a case file; with `open`, entries may be unknown, and faces and reversals are refused, because the identities of both
/// are not read.
///
/// # Errors
/// What is wrong, and where; `unreadable` is set.
pub fn read(source: &str, open: bool) -> Checked<Case> {
    over(source, open, &())
}

/// The same for a case with entries in a field.
///
/// # Errors
/// What is wrong, and where; `unreadable` is set.
pub fn over<T: Whole>(source: &str, open: bool, ground: &T::Ground) -> Checked<Case<T>> {
    opened(source, |case| {
        let by_rows = match word(case, "convention")? {
            Some("rows") if case.get("map").is_none() => true,
            Some("columns") => false,
            None if case.get("map").is_some() => false,
            _ => return case.reject("format", "the convention is rows or columns"),
        };
        for state in if open { items(case, "state")? } else { Vec::new() } {
            let sides = ["reversal", "layout", "bottom", "top", "side01", "side12", "side02"];
            let along = |key| state.get(key).is_some_and(|b| b.get("edge").is_some());
            let face = word(&state, "kind")? == Some("face") || along("left") || along("right");
            let beyond = face || sides.iter().any(|key| state.get(key).is_some());
            state.need(!beyond, "case", "the identities of faces and reversals are not read")?;
        }
        let reader = Reader { ground, by_rows, open, holes: RefCell::default() };
        let shape = reader.shape(case)?;
        let mut examine = Vec::new();
        for entry in items(case, "examine")? {
            let [address] = entry.fields("address")?;
            let normal = Address::parse(address.text()?).and_then(|a| a.normalise(&shape, shape.start));
            examine.push(address.some(normal, "format", "this is no address of the case")?);
        }
        let holes = reader.holes.into_inner().into_iter().map(|(hole, _)| hole).collect();
        Ok(Case { name: case.field("name")?.text()?.to_owned(), shape, examine, holes })
    })
}
