use super::chain;
use super::faces;
use super::matrix::{Hole, Operator, Written};
use super::node::{Node, Table, clipped, suggest};
use super::{Convention, MAX_COORDINATES, MAX_PIECES, MAX_STATES, Model, Origin, Places, StatePlace, Unknown};
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, Frame, OpName, Piece, Reversal, Shape, State};
use std::collections::BTreeMap;
use std::ops::Range;

/// Reads `pieces = [ … ]`: a case with a single state.
pub(super) fn single(
    case: &Table<'_>,
    node: &Node<'_>,
    kind: CellKind,
    convention: Convention,
) -> Result<Model, Problem> {
    let pieces = node.array(|k| format!("the matrix of piece {k}"))?;
    bounded_pieces(node, pieces.len())?;
    let mut place = StatePlace { name: node.span(), ..StatePlace::default() };
    let mut operators = Vec::new();
    let mut unknown = Vec::new();
    let mut dim = 0;
    for (k, piece) in pieces.iter().enumerate() {
        let written = Written::open(piece)?;
        if k == 0 {
            dim = written.height();
            let why = "the operators of a case with one state are square";
            written.sized(piece, (dim, dim), why)?;
        } else {
            let why = format!("all pieces act on the same {dim} coordinates; piece 0 is {dim} x {dim}");
            written.sized(piece, (dim, dim), &why)?;
        }
        let operator = written.operator(piece, convention)?;
        unknown.extend(operator.holes.into_iter().map(|h| named(OpName::Piece { state: 0, letter: k }, h)));
        operators.push(operator.matrix);
        place.pieces.push(written.span());
    }
    let mut shape = Shape::single(kind, operators);
    if let Some(list) = case.get("reversed") {
        for index in list.array(|k| format!("entry {k} of `reversed`"))? {
            if kind == CellKind::Set {
                return Err(reversed_set(&list));
            }
            shape.states[0].pieces[index.index(pieces.len() - 1)?].reversed = true;
        }
    }
    if let Some(list) = case.get("shares") {
        let shares = list.array(|k| format!("entry {k} of `shares`"))?;
        if shares.len() != pieces.len() {
            let message = format!("there are {} shares for {} pieces", shares.len(), pieces.len());
            return Err(list
                .problem("shares", message, format!("{} needed", pieces.len()))
                .with_help("give every piece its part of the parameter, as in shares = [\"1/3\", \"2/3\"]"));
        }
        for (piece, share) in shape.states[0].pieces.iter_mut().zip(&shares) {
            piece.share = Some(share.number()?);
        }
    }
    let places = Places { states: vec![place], control: None };
    Ok(Model { complex: Complex::of_curves(shape), places, unknown, scheme: None })
}

fn named(op: OpName, hole: Hole) -> Unknown {
    Unknown { op, row: hole.row, column: hole.column, name: hole.name, span: hole.span }
}

pub(super) fn reversed_set(node: &Node<'_>) -> Problem {
    node.problem("reversed-set", "a set has no parameter, so none of its pieces can run backwards", "not for a set")
        .with_help("leave `reversed` out, or declare kind = \"curve\" (kind = \"edge\" of a state)")
}

fn bounded_pieces(node: &Node<'_>, count: usize) -> Result<(), Problem> {
    if count == 0 {
        return Err(node
            .problem("no-piece", "there must be at least one piece", "no piece")
            .with_help("a shape is the union of its pieces; give the operator of each"));
    }
    if count > MAX_PIECES {
        return Err(node
            .problem("limit", format!("{count} pieces are over the limit of {MAX_PIECES}"), "too many pieces")
            .with_help(format!("a state has at most {MAX_PIECES} pieces")));
    }
    Ok(())
}

/// A state read for itself: all but its operators, which need the dimensions of the others.
pub(super) struct Draft<'a> {
    pub table: Table<'a>,
    pub name: String,
    pub kind: CellKind,
    pub dim: usize,
    pub pieces: Vec<Table<'a>>,
    /// The scheme that it names, or the states that it is a chain of.
    pub built: chain::Built,
}

/// All states of an automaton, and the entries left open that were met so far.
pub(super) struct Automaton<'a> {
    pub drafts: Vec<Draft<'a>>,
    convention: Convention,
    unknown: Vec<Unknown>,
}

/// Reads the `[[state]]` tables of an automaton.
pub(super) fn automaton(
    case: &Table<'_>,
    node: &Node<'_>,
    default_kind: CellKind,
    convention: Convention,
) -> Result<Model, Problem> {
    for key in ["pieces", "reversed", "shares"] {
        if let Some(span) = case.key_span(key) {
            return Err(case
                .file
                .problem(
                    "two-forms",
                    format!("`{key}` and `[[state]]` exclude each other"),
                    span,
                    "belongs into a state",
                )
                .with_help("in an automaton every piece is a [[state.piece]] with `to`, `matrix` and `reversed`"));
        }
    }
    let tables = node.tables(|k| format!("state {k}"))?;
    if tables.is_empty() || tables.len() > MAX_STATES {
        return Err(node
            .problem("limit", format!("an automaton has 1 to {MAX_STATES} states"), format!("{} here", tables.len()))
            .with_help("list every state in its own [[state]]"));
    }
    let mut drafts: Vec<Draft<'_>> = Vec::new();
    for table in tables {
        let draft = draft(table, default_kind, convention)?;
        if drafts.iter().any(|d| d.name == draft.name) {
            let name = draft.table.need("name", "\"A\"")?;
            return Err(name
                .problem("duplicate-state", format!("there are two states `{}`", draft.name), "used before")
                .with_help("give every state a name of its own"));
        }
        drafts.push(draft);
    }
    chain::measure(&mut drafts)?;
    let start = match case.get("start") {
        Some(node) => state_index(&node, &drafts)?,
        None if drafts.len() == 1 => 0,
        None => {
            let example = format!("{:?}", drafts[0].name);
            return Err(case.need("start", &example).err().unwrap_or_else(|| case.problem("missing-key", "", "")));
        }
    };
    let mut automaton = Automaton { drafts, convention, unknown: Vec::new() };
    let shape = Shape { states: Vec::new(), start, control: None, frame: Frame::Barycentric };
    let mut complex = Complex { shape, faces: BTreeMap::new(), reversals: BTreeMap::new() };
    let mut places = Places::default();
    for index in 0..automaton.drafts.len() {
        let (state, mut place) = automaton.finish(index)?;
        if let Some(face) = faces::read(&mut automaton, index, &mut place)? {
            complex.faces.insert(index, face);
        }
        if let Some(reversal) = automaton.reversal(index, &mut place)? {
            complex.reversals.insert(index, reversal);
        }
        complex.shape.states.push(state);
        places.states.push(place);
    }
    let built = automaton.drafts.iter().any(|d| !matches!(d.built, chain::Built::No));
    Ok(Model { complex, places, unknown: automaton.unknown, scheme: built.then_some(Origin::States) })
}

fn draft<'a>(mut table: Table<'a>, default_kind: CellKind, convention: Convention) -> Result<Draft<'a>, Problem> {
    let name = table.text("name", "\"A\"")?;
    let name_ok = !name.is_empty() && name.chars().count() <= 40 && !name.chars().any(char::is_control);
    if !name_ok {
        return Err(table
            .need("name", "\"A\"")?
            .problem("value", "the name of a state has 1 to 40 printable characters", "not a name")
            .with_help("short names such as \"I\" or \"left\" read best"));
    }
    let name = name.to_owned();
    table.what = format!("state `{name}`");
    let kind = match table.word("kind", &["edge", "vertex", "set", "face"])? {
        Some("vertex") => CellKind::Vertex,
        Some("set") => CellKind::Set,
        Some("face") => CellKind::Face,
        Some(_) => CellKind::Edge,
        None => default_kind,
    };
    if let Some(built) = chain::read(&table, kind)? {
        return Ok(Draft { dim: built.dim(), table, name, kind, pieces: Vec::new(), built });
    }
    if kind == CellKind::Face {
        table.only(&faces::KEYS)?;
    } else {
        table.only(&["name", "kind", "dimension", "left", "right", "reversal", "piece"])?;
    }
    let node = table.need("piece", "…  (as a table [[state.piece]])")?;
    let pieces = node.tables(|k| format!("piece {k} of state `{name}`"))?;
    bounded_pieces(&node, pieces.len())?;
    if kind == CellKind::Vertex && pieces.len() != 1 {
        return Err(node
            .problem("vertex", format!("the vertex state `{name}` has {} pieces", pieces.len()), "one is needed")
            .with_help(
                "a vertex is the fixed point of one operator; a state with several pieces is an edge or a set",
            ));
    }
    let dim = match table.get("dimension") {
        Some(node) => match node.index(MAX_COORDINATES)? {
            0 => {
                return Err(node
                    .problem("range", "a state has at least one coordinate", "must not be 0")
                    .with_help("count the barycentric coordinates"));
            }
            dim => dim,
        },
        None => {
            let node = matrix_node(&pieces[0])?;
            if node.is_question() {
                let message = format!("state `{name}` needs its `dimension`, because its first operator is unknown");
                return Err(node
                    .problem("dimension", message, "of unknown size")
                    .with_help("add a line such as  dimension = 4  to the state"));
            }
            let written = Written::open(&node)?;
            if convention == Convention::Rows { written.width() } else { written.height() }
        }
    };
    Ok(Draft { table, name, kind, dim, pieces, built: chain::Built::No })
}

fn matrix_node<'a>(piece: &Table<'a>) -> Result<Node<'a>, Problem> {
    let mut node = piece.need("matrix", "[[\"1/2\", 0], [\"1/2\", 1]]")?;
    node.what = format!("the matrix of {}", piece.what);
    Ok(node)
}

pub(super) fn state_index(node: &Node<'_>, drafts: &[Draft<'_>]) -> Result<usize, Problem> {
    let name = node.text()?;
    drafts.iter().position(|d| d.name == name).ok_or_else(|| {
        let names: Vec<&str> = drafts.iter().map(|d| d.name.as_str()).collect();
        node.problem("unknown-state", format!("there is no state `{}`", clipped(name)), "unknown state")
            .with_help(suggest(name, &names, "the states are"))
    })
}

impl Automaton<'_> {
    fn finish(&mut self, index: usize) -> Result<(State, StatePlace), Problem> {
        let name_span = self.drafts[index].table.need("name", "\"A\"")?.span();
        let mut place = StatePlace { name: name_span, ..StatePlace::default() };
        let mut pieces = chain::pieces(&self.drafts, index);
        place.pieces = vec![place.name.clone(); pieces.len()];
        for letter in 0..self.drafts[index].pieces.len() {
            let (read, span) = self.piece(index, letter)?;
            pieces.push(read);
            place.pieces.push(span);
        }
        let (mut left, mut right) = (None, None);
        if self.drafts[index].kind != CellKind::Face {
            (left, place.left) = self.boundary(index, "left", OpName::Left(index))?.unzip();
            (right, place.right) = self.boundary(index, "right", OpName::Right(index))?.unzip();
        }
        let draft = &self.drafts[index];
        let state = State { name: draft.name.clone(), kind: draft.kind, dim: draft.dim, pieces, left, right };
        Ok((state, place))
    }

    fn piece(&mut self, index: usize, letter: usize) -> Result<(Piece, Range<usize>), Problem> {
        let draft = &self.drafts[index];
        let piece = &draft.pieces[letter];
        let kind = draft.kind;
        piece.only(if kind == CellKind::Face {
            &["to", "matrix", "corners"]
        } else {
            &["to", "matrix", "reversed", "share"]
        })?;
        let to = piece.need("to", &format!("{:?}", draft.name))?;
        let target = state_index(&to, &self.drafts)?;
        if kind != CellKind::Set && self.drafts[target].kind != kind {
            return Err(wrong_target(&to, piece, draft, &self.drafts[target]));
        }
        let share = super::maps::share(piece)?;
        let reversed = kind != CellKind::Face && piece.flag("reversed")?;
        if reversed && kind != CellKind::Edge {
            return Err(reversed_set(&piece.need("reversed", "true")?));
        }
        let node = matrix_node(piece)?;
        let op = self.operator(&node, OpName::Piece { state: index, letter }, index, target)?;
        Ok((Piece { target, op, reversed, share }, node.span()))
    }

    fn boundary(&mut self, index: usize, key: &str, name: OpName) -> Result<Option<(Boundary, Range<usize>)>, Problem> {
        let draft = &self.drafts[index];
        let Some(node) = draft.table.get(key) else { return Ok(None) };
        if draft.kind != CellKind::Edge {
            let message = format!("the {} state `{}` has a `{key}` boundary", kind_word(draft.kind), draft.name);
            return Err(node
                .problem("boundary", message, "only edges and faces have boundaries")
                .with_help("leave `left` and `right` out, or declare kind = \"edge\""));
        }
        let mut table = node.table()?;
        table.what = format!("the {key} boundary of state `{}`", draft.name);
        let (vertex, op, span) = self.part(&table, "vertex", CellKind::Vertex, index, name)?;
        Ok(Some((Boundary { vertex, op }, span)))
    }

    fn reversal(&mut self, index: usize, place: &mut StatePlace) -> Result<Option<Reversal>, Problem> {
        let draft = &self.drafts[index];
        if draft.kind == CellKind::Face {
            return Ok(None);
        }
        let Some(node) = draft.table.get("reversal") else { return Ok(None) };
        if draft.kind != CellKind::Edge {
            let message = format!("the {} state `{}` has a `reversal`", kind_word(draft.kind), draft.name);
            return Err(node
                .problem("boundary", message, "only edges are reversed")
                .with_help("leave `reversal` out, or declare kind = \"edge\""));
        }
        let mut table = node.table()?;
        table.what = format!("the reversal of state `{}`", draft.name);
        let (edge, op, span) = self.part(&table, "edge", CellKind::Edge, index, OpName::Reverse(index))?;
        place.reversal = Some(span);
        Ok(Some(Reversal { edge, op }))
    }

    /// A boundary or reversal `{ vertex = "v", matrix = … }` or `{ edge = "e", points = … }`: its state and operator.
    pub(super) fn part(
        &mut self,
        table: &Table<'_>,
        key: &'static str,
        kind: CellKind,
        index: usize,
        name: OpName,
    ) -> Result<(usize, Matrix, Range<usize>), Problem> {
        table.only(&[key, "matrix", "points"])?;
        let from_node = table.need(key, "\"v\"")?;
        let from = state_index(&from_node, &self.drafts)?;
        let source = &self.drafts[from];
        if source.kind != kind {
            let wanted = kind_word(kind);
            let message =
                format!("{} must come from a state of kind {wanted}, but `{}` is none", table.what, source.name);
            return Err(from_node
                .problem("boundary", message, format!("this is a state of kind {}", kind_word(source.kind)))
                .with_help(format!("declare that state with kind = {wanted:?}, or name another one")));
        }
        if let Some(points) = table.get("points") {
            if let Some(node) = table.get("matrix") {
                return Err(node
                    .problem("two-forms", "`matrix` and `points` exclude each other", "given besides `points`")
                    .with_help("`points` lists the coordinates that the boundary depends on, in order"));
            }
            let op = self.inclusion(&points.named(format!("`points` of {}", table.what)), index, from)?;
            return Ok((from, op, points.span()));
        }
        let matrix = matrix_node(table)?;
        let op = self.operator(&matrix, name, index, from)?;
        Ok((from, op, matrix.span()))
    }

    /// The operator that puts coordinate `j` of the boundary at coordinate `points[j]`.
    fn inclusion(&self, node: &Node<'_>, into: usize, from: usize) -> Result<Matrix, Problem> {
        let (rows, cols) = (self.drafts[into].dim, self.drafts[from].dim);
        let points = node.array(|k| format!("entry {k} of {}", node.what))?;
        if points.len() != cols {
            let message = format!("{} has {} entries, but {cols} are needed", node.what, points.len());
            let help = format!("state `{}` has dimension {cols}: one coordinate for each", self.drafts[from].name);
            return Err(node.problem("size", message, format!("{cols} needed")).with_help(help));
        }
        let mut op = Matrix::zero(rows, cols);
        for (column, point) in points.iter().enumerate() {
            op[(point.index(rows.saturating_sub(1))?, column)] = 1.into();
        }
        Ok(op)
    }

    fn operator(&mut self, node: &Node<'_>, name: OpName, into: usize, from: usize) -> Result<Matrix, Problem> {
        let (target, source, convention) = (&self.drafts[into], &self.drafts[from], self.convention);
        let operator = if node.is_question() {
            Operator::unknown(target.dim, source.dim, &node.span())
        } else {
            sized_operator(node, convention, target, source)?
        };
        self.unknown.extend(operator.holes.into_iter().map(|h| named(name, h)));
        Ok(operator.matrix)
    }
}

fn wrong_target(to: &Node<'_>, piece: &Table<'_>, draft: &Draft<'_>, target: &Draft<'_>) -> Problem {
    let (from, into) = (kind_word(draft.kind), kind_word(target.kind));
    let message = format!("{} leads from the {from} `{}` to the {into} `{}`", piece.what, draft.name, target.name);
    to.problem("target-kind", message, format!("`{}` is a state of kind {into}", target.name)).with_help(
        "pieces of a vertex are vertices, pieces of an edge are edges, pieces of a face are faces; boundaries are joined \
         to an edge by `left` and `right`, to a face by its sides",
    )
}

fn sized_operator(
    node: &Node<'_>,
    convention: Convention,
    into: &Draft<'_>,
    from: &Draft<'_>,
) -> Result<Operator, Problem> {
    let written = Written::open(node)?;
    let (rows, cols) = if convention == Convention::Rows { (from.dim, into.dim) } else { (into.dim, from.dim) };
    let why = if into.name == from.name {
        format!("state `{}` has dimension {}", into.name, into.dim)
    } else {
        format!("state `{}` has dimension {} and state `{}` has dimension {}", into.name, into.dim, from.name, from.dim)
    };
    let why = format!("{why}; with convention = {:?} the matrix is {rows} x {cols}", convention.name());
    written.sized(node, (rows, cols), &why)?;
    written.operator(node, convention)
}

pub(super) fn kind_word(kind: CellKind) -> &'static str {
    match kind {
        CellKind::Vertex => "vertex",
        CellKind::Edge => "edge",
        CellKind::Set => "set",
        CellKind::Face => "face",
    }
}
