use super::matrix::Written;
use super::node::{Node, Table, clipped, suggest};
use super::{Convention, MAX_COORDINATES, MAX_PIECES, MAX_STATES, Places, StatePlace};
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Frame, Piece, Shape, State};

/// Reads `pieces = [ … ]`: a case with a single state.
pub(super) fn single(
    case: &Table<'_>,
    node: &Node<'_>,
    kind: CellKind,
    convention: Convention,
) -> Result<(Shape, Places), Problem> {
    let pieces = node.array(|k| format!("the matrix of piece {k}"))?;
    bounded_pieces(node, pieces.len())?;
    let mut place = StatePlace { name: node.span(), ..StatePlace::default() };
    let mut operators = Vec::new();
    let mut dim = 0;
    for (k, piece) in pieces.iter().enumerate() {
        let written = Written::read(piece)?;
        if k == 0 {
            dim = written.height();
            let why = "the operators of a case with one state are square";
            written.sized(piece, (dim, dim), why)?;
        } else {
            let why = format!("all pieces act on the same {dim} coordinates; piece 0 is {dim} x {dim}");
            written.sized(piece, (dim, dim), &why)?;
        }
        operators.push(written.operator(piece, convention)?);
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
    Ok((shape, Places { states: vec![place], control: None }))
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
struct Draft<'a> {
    table: Table<'a>,
    name: String,
    kind: CellKind,
    dim: usize,
    pieces: Vec<Table<'a>>,
}

/// Reads the `[[state]]` tables of an automaton.
pub(super) fn automaton(
    case: &Table<'_>,
    node: &Node<'_>,
    default_kind: CellKind,
    convention: Convention,
) -> Result<(Shape, Places), Problem> {
    for key in ["pieces", "reversed"] {
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
    let start = match case.get("start") {
        Some(node) => state_index(&node, &drafts)?,
        None if drafts.len() == 1 => 0,
        None => {
            let example = format!("{:?}", drafts[0].name);
            return Err(case.need("start", &example).err().unwrap_or_else(|| case.problem("missing-key", "", "")));
        }
    };
    let mut states = Vec::new();
    let mut places = Places::default();
    for draft in &drafts {
        let (state, place) = finish(draft, &drafts, convention)?;
        states.push(state);
        places.states.push(place);
    }
    Ok((Shape { states, start, control: None, frame: Frame::Barycentric }, places))
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
    table.only(&["name", "kind", "dimension", "left", "right", "piece"])?;
    let kind = match table.word("kind", &["edge", "vertex", "set"])? {
        Some("vertex") => CellKind::Vertex,
        Some("set") => CellKind::Set,
        Some(_) => CellKind::Edge,
        None => default_kind,
    };
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
            let written = Written::read(&matrix_node(&pieces[0])?)?;
            if convention == Convention::Rows { written.width() } else { written.height() }
        }
    };
    Ok(Draft { table, name, kind, dim, pieces })
}

fn matrix_node<'a>(piece: &Table<'a>) -> Result<Node<'a>, Problem> {
    let mut node = piece.need("matrix", "[[\"1/2\", 0], [\"1/2\", 1]]")?;
    node.what = format!("the matrix of {}", piece.what);
    Ok(node)
}

fn state_index(node: &Node<'_>, drafts: &[Draft<'_>]) -> Result<usize, Problem> {
    let name = node.text()?;
    drafts.iter().position(|d| d.name == name).ok_or_else(|| {
        let names: Vec<&str> = drafts.iter().map(|d| d.name.as_str()).collect();
        node.problem("unknown-state", format!("there is no state `{}`", clipped(name)), "unknown state")
            .with_help(suggest(name, &names, "the states are"))
    })
}

fn finish(draft: &Draft<'_>, drafts: &[Draft<'_>], convention: Convention) -> Result<(State, StatePlace), Problem> {
    let table = &draft.table;
    let name_span = table.need("name", "\"A\"")?.span();
    let mut place = StatePlace { name: name_span, ..StatePlace::default() };
    let mut pieces = Vec::new();
    for piece in &draft.pieces {
        let (read, span) = read_piece(draft, piece, drafts, convention)?;
        pieces.push(read);
        place.pieces.push(span);
    }
    let mut boundary = |key: &'static str| -> Result<Option<Boundary>, Problem> {
        let Some(node) = table.get(key) else { return Ok(None) };
        let (read, span) = read_boundary(draft, key, &node, drafts, convention)?;
        if key == "left" {
            place.left = Some(span);
        } else {
            place.right = Some(span);
        }
        Ok(Some(read))
    };
    let (left, right) = (boundary("left")?, boundary("right")?);
    Ok((State { name: draft.name.clone(), kind: draft.kind, dim: draft.dim, pieces, left, right }, place))
}

type Span = std::ops::Range<usize>;

fn read_piece(
    draft: &Draft<'_>,
    piece: &Table<'_>,
    drafts: &[Draft<'_>],
    convention: Convention,
) -> Result<(Piece, Span), Problem> {
    piece.only(&["to", "matrix", "reversed"])?;
    let to = piece.need("to", &format!("{:?}", draft.name))?;
    let target = state_index(&to, drafts)?;
    let fits = match draft.kind {
        CellKind::Vertex => drafts[target].kind == CellKind::Vertex,
        CellKind::Edge => drafts[target].kind == CellKind::Edge,
        _ => true,
    };
    if !fits {
        let (from, into) = (kind_word(draft.kind), kind_word(drafts[target].kind));
        let message =
            format!("{} leads from the {from} `{}` to the {into} `{}`", piece.what, draft.name, drafts[target].name);
        return Err(to
            .problem("target-kind", message, format!("`{}` is a {into} state", drafts[target].name))
            .with_help("pieces of a vertex are vertices, pieces of an edge are edges; vertices are joined to an edge by `left` and `right`"));
    }
    let node = matrix_node(piece)?;
    let op = sized_operator(&node, convention, draft, &drafts[target])?;
    let reversed = piece.flag("reversed")?;
    if reversed && draft.kind != CellKind::Edge {
        return Err(reversed_set(&piece.need("reversed", "true")?));
    }
    Ok((Piece { target, op, reversed }, node.span()))
}

fn read_boundary(
    draft: &Draft<'_>,
    key: &str,
    node: &Node<'_>,
    drafts: &[Draft<'_>],
    convention: Convention,
) -> Result<(Boundary, Span), Problem> {
    if draft.kind != CellKind::Edge {
        let message = format!("the {} state `{}` has a `{key}` boundary", kind_word(draft.kind), draft.name);
        return Err(node
            .problem("boundary", message, "only edges have boundaries")
            .with_help("leave `left` and `right` out, or declare kind = \"edge\""));
    }
    let mut table = node.table()?;
    table.what = format!("the {key} boundary of state `{}`", draft.name);
    table.only(&["vertex", "matrix"])?;
    let vertex_node = table.need("vertex", "\"v\"")?;
    let vertex = state_index(&vertex_node, drafts)?;
    if drafts[vertex].kind != CellKind::Vertex {
        let message = format!("{} must come from a vertex state, but `{}` is none", table.what, drafts[vertex].name);
        return Err(vertex_node
            .problem("boundary", message, format!("this is a {} state", kind_word(drafts[vertex].kind)))
            .with_help("declare that state with kind = \"vertex\", or name another one"));
    }
    let matrix = matrix_node(&table)?;
    let op = sized_operator(&matrix, convention, draft, &drafts[vertex])?;
    Ok((Boundary { vertex, op }, matrix.span()))
}

fn sized_operator(
    node: &Node<'_>,
    convention: Convention,
    into: &Draft<'_>,
    from: &Draft<'_>,
) -> Result<Matrix, Problem> {
    let written = Written::read(node)?;
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

fn kind_word(kind: CellKind) -> &'static str {
    match kind {
        CellKind::Vertex => "vertex",
        CellKind::Edge => "edge",
        CellKind::Set => "set",
        CellKind::Face => "face",
    }
}
