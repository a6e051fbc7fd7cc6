use super::matrix::Written;
use super::node::{Node, Table};
use super::symmetry::written_out;
use super::{MAX_PIECES, Model, Origin, Places, StatePlace};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::shape::{CellKind, Complex, Frame, Piece, Shape};

/// Largest dimension of affine maps that is read.
pub const MAX_AFFINE: usize = 16;

/// Reads the `[[map]]` tables: affine maps `x -> linear x + shift` of one space of dimension 1 to [`MAX_AFFINE`].
pub(super) fn read(case: &Table<'_>, node: &Node<'_>, kind: CellKind) -> Result<Model, Problem> {
    for key in ["pieces", "reversed", "shares", "state", "start", "control"] {
        if let Some(span) = case.key_span(key) {
            let message = format!("`{key}` and `[[map]]` exclude each other");
            return Err(case
                .file
                .problem("two-forms", message, span, "cannot be combined with [[map]]")
                .with_help("a case is written with `pieces`, with [[map]] or with [[state]], one of the three"));
        }
    }
    let maps = node.tables(|k| format!("map {k}"))?;
    if maps.is_empty() || maps.len() > MAX_PIECES {
        return Err(node
            .problem("limit", format!("a case has 1 to {MAX_PIECES} maps"), format!("{} maps here", maps.len()))
            .with_help("list every map in its own [[map]]"));
    }
    let mut shape = Shape::single(kind, Vec::new());
    let mut place = StatePlace { name: node.span(), ..StatePlace::default() };
    for (k, map) in maps.iter().enumerate() {
        let (linear, shift) = affine_map(map)?;
        let op = Shape::affine_operator(&linear, &shift);
        if k == 0 {
            shape.states[0].dim = op.rows();
        } else if op.rows() != shape.states[0].dim {
            let message = format!(
                "{} acts on dimension {}, but map 0 on dimension {}",
                map.what,
                shift.len(),
                shape.states[0].dim - 1
            );
            return Err(map
                .problem("dimension", message, "another dimension")
                .with_help("all maps of a case act on the same space"));
        }
        let reversed = map.flag("reversed")?;
        if reversed && kind == CellKind::Set {
            return Err(super::states::reversed_set(&map.need("reversed", "true")?));
        }
        shape.states[0].pieces.push(Piece { target: 0, op, reversed, share: share(map)? });
        place.pieces.push(map.need("linear", "[[\"1/2\"]]")?.span());
    }
    let operators: Vec<Matrix> = shape.states[0].pieces.iter().map(|p| p.op.clone()).collect();
    let out = if kind == CellKind::Set { written_out(&operators) } else { None };
    let scheme = out.map(|out| {
        place.pieces = out.operators.iter().map(|(k, _)| place.pieces[*k].clone()).collect();
        let piece = |(_, op)| Piece { target: 0, op, reversed: false, share: None };
        shape.states[0].pieces = out.operators.into_iter().map(piece).collect();
        Origin::Symmetric { maps: out.symmetries, group: out.group }
    });
    shape.frame = Frame::Affine;
    shape.control = Some(Shape::affine_control(shape.states[0].dim - 1));
    let places = Places { states: vec![place], control: None };
    Ok(Model { complex: Complex::of_curves(shape), places, unknown: Vec::new(), scheme })
}

/// What a piece takes of the parameter, where its table says so.
pub(super) fn share(piece: &Table<'_>) -> Result<Option<Rational>, Problem> {
    piece.get("share").map(|node| node.number()).transpose()
}

fn affine_map(map: &Table<'_>) -> Result<(Matrix, Vec<Rational>), Problem> {
    map.only(&["linear", "shift", "reversed", "share"])?;
    let mut node = map.need("linear", "[[\"1/2\", 0], [0, \"1/2\"]]")?;
    node.what = format!("`linear` of {}", map.what);
    let linear = Written::read(&node)?;
    let d = linear.height();
    linear.sized(&node, (d, d), "the linear part of a map is square")?;
    if d > MAX_AFFINE {
        return Err(node
            .problem("limit", format!("{} is {d} x {d}", node.what), "too large")
            .with_help(format!("affine maps of dimension 1 to {MAX_AFFINE} are read; use `pieces` for larger ones")));
    }
    let shift_node = map.need("shift", "[0, 0]")?;
    let shift = shift_node
        .array(|k| format!("entry {k} of `shift` of {}", map.what))?
        .iter()
        .map(Node::number)
        .collect::<Result<Vec<_>, _>>()?;
    if shift.len() != d {
        let message = format!("`shift` of {} has {} entries, but `linear` is {d} x {d}", map.what, shift.len());
        return Err(shift_node
            .problem("size", message, format!("{d} needed"))
            .with_help("a map is x -> linear x + shift, with as many entries in `shift` as `linear` has rows"));
    }
    Ok((linear.matrix(), shift))
}
