//! Shapes written as case files, so that what a scheme or a solution gives can be read, changed, certified and checked like
//! any other case.

use crate::linalg::{Entry, Matrix};
use crate::shape::{Address, CellKind, Complex, Frame, Layout, Shape, State};
use std::fmt::Write;

/// What stands at the head of a case file.
#[derive(Debug, Clone, Default)]
pub struct Heading {
    /// The name: letters, digits, `-`, `_` and `.`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Where the shape comes from.
    pub source: String,
    /// Points to examine.
    pub examine: Vec<Address>,
}

/// The shape as a case file (`docs/case-format.md`). Faces are written as sets, without their boundaries; affine maps
/// are written as such.
#[must_use]
pub fn case_text<E: Entry>(shape: &Shape<E>, heading: &Heading) -> String {
    written(shape, None, heading)
}

/// The complex as a case file, with the boundaries of its faces and its reversals; a face without boundaries is written as a
/// set.
#[must_use]
pub fn complex_text(complex: &Complex, heading: &Heading) -> String {
    written(&complex.shape, Some(complex), heading)
}

/// The shape, with the boundaries of faces and the reversals that stand beside it.
fn written<E: Entry>(shape: &Shape<E>, complex: Option<&Complex>, heading: &Heading) -> String {
    let mut out = String::new();
    for (key, value) in [("name", &heading.name), ("title", &heading.title), ("source", &heading.source)] {
        if !value.is_empty() {
            let _ = writeln!(out, "{key} = {}", quoted(value));
        }
    }
    let alone = complex.is_none_or(|c| c.reversals.is_empty() && c.faces.is_empty());
    let single = shape.states.len() == 1 && alone;
    if single && shape.states[shape.start].kind != CellKind::Edge {
        out.push_str("kind = \"set\"\n");
    }
    if single && is_affine(shape) {
        maps(&mut out, &shape.states[0]);
        examined(&mut out, heading);
        return out;
    }
    out.push_str("convention = \"columns\"\n");
    if single {
        pieces(&mut out, &shape.states[0]);
    } else {
        let _ = writeln!(out, "start = {}", quoted(&shape.states[shape.start].name));
    }
    if let Some(control) = &shape.control {
        // One point a row.
        let _ = writeln!(out, "control = {}", matrix(&control.transpose(), ""));
    }
    if !single {
        (0..shape.states.len()).for_each(|state| table(&mut out, shape, complex, state));
    }
    examined(&mut out, heading);
    if shape.frame == Frame::Affine {
        return format!("# Affine maps, written on the simplex 0, e_1, …, e_d.\n{out}");
    }
    out
}

fn examined(out: &mut String, heading: &Heading) {
    for address in &heading.examine {
        let _ = writeln!(out, "\n[[examine]]\naddress = {}", quoted(&address.to_string()));
    }
}

/// Whether a shape of one state is one of affine maps, seen where they act.
fn is_affine<E: Entry>(shape: &Shape<E>) -> bool {
    let dim = shape.states[0].dim;
    let plain = shape.states[0].left.is_none() && shape.states[0].right.is_none();
    shape.frame == Frame::Affine && plain && shape.control.as_ref() == Some(&Shape::affine_control(dim - 1))
}

/// The pieces as maps `x -> linear x + shift`: the columns of an operator are the images of the corners `0, e_1, …, e_d`.
fn maps<E: Entry>(out: &mut String, state: &State<E>) {
    for piece in &state.pieces {
        let (op, d) = (&piece.op, state.dim - 1);
        let linear = Matrix::from_fn(d, d, |i, j| op[(i + 1, j + 1)].minus(&op[(i + 1, 0)]));
        let shift = Matrix::from_fn(1, d, |_, i| op[(i + 1, 0)].clone());
        let shift = matrix(&shift, "");
        let _ = writeln!(out, "\n[[map]]\nlinear = {}\nshift = {}", matrix(&linear, ""), &shift[1..shift.len() - 1]);
        if piece.reversed {
            out.push_str("reversed = true\n");
        }
        if let Some(share) = &piece.share {
            let _ = writeln!(out, "share = {}", entry(share));
        }
    }
}

fn pieces<E: Entry>(out: &mut String, state: &State<E>) {
    out.push_str("pieces = [\n");
    for piece in &state.pieces {
        let _ = writeln!(out, "    {},", matrix(&piece.op, "     "));
    }
    out.push_str("]\n");
    if state.pieces.iter().any(|p| p.share.is_some()) {
        let shares: Vec<String> = (0..state.pieces.len()).map(|i| entry(&state.share(i))).collect();
        let _ = writeln!(out, "shares = [{}]", shares.join(", "));
    }
    let reversed: Vec<String> =
        state.pieces.iter().enumerate().filter(|(_, p)| p.reversed).map(|(k, _)| k.to_string()).collect();
    if !reversed.is_empty() {
        let _ = writeln!(out, "reversed = [{}]", reversed.join(", "));
    }
}

fn table<E: Entry>(out: &mut String, shape: &Shape<E>, complex: Option<&Complex>, index: usize) {
    let states = &shape.states;
    let state = &states[index];
    let face = complex.and_then(|c| c.faces.get(&index));
    let kind = match (state.kind, face) {
        (CellKind::Edge, _) => "edge",
        (CellKind::Vertex, _) => "vertex",
        (CellKind::Face, Some(_)) => "face",
        (CellKind::Set | CellKind::Face, _) => "set",
    };
    let name = |index: usize| quoted(&states[index].name);
    let _ = writeln!(out, "\n[[state]]\nname = {}\nkind = \"{kind}\"\ndimension = {}", quoted(&state.name), state.dim);
    for (side, boundary) in [("left", &state.left), ("right", &state.right)] {
        if let Some(b) = boundary {
            let _ = writeln!(out, "{side} = {{ vertex = {}, {} }}", name(b.vertex), part(&b.op));
        }
    }
    if let Some(reversal) = complex.and_then(|c| c.reversals.get(&index)) {
        let _ = writeln!(out, "reversal = {{ edge = {}, {} }}", name(reversal.edge), part(&reversal.op));
    }
    if let Some(face) = face {
        let layout = match face.layout {
            Layout::Quad { columns, rows } => format!("{columns}x{rows}"),
            Layout::Triangle => "triangle".to_owned(),
        };
        let _ = writeln!(out, "layout = \"{layout}\"");
        for (side, key) in face.sides.iter().zip(face.layout.side_keys()) {
            let _ = writeln!(out, "{key} = {{ edge = {}, {} }}", name(side.edge), part(&side.op));
        }
    }
    for (letter, piece) in state.pieces.iter().enumerate() {
        let _ = writeln!(out, "[[state.piece]]\nto = {}\nmatrix = {}", name(piece.target), matrix(&piece.op, "    "));
        if piece.reversed {
            out.push_str("reversed = true\n");
        }
        if let Some(share) = &piece.share {
            let _ = writeln!(out, "share = {}", entry(share));
        }
        if let Some(corners) = face.and_then(|f| f.placement.get(letter)) {
            let corners: Vec<String> = corners.iter().map(ToString::to_string).collect();
            let _ = writeln!(out, "corners = [{}]", corners.join(", "));
        }
    }
}

/// The operator of a boundary: the coordinates that it picks, where it is an inclusion.
fn part<E: Entry>(op: &Matrix<E>) -> String {
    let unit = |j: usize| {
        let mut column = (0..op.rows()).filter(|&i| !op[(i, j)].is_zero());
        let at = column.next().filter(|&i| op[(i, j)] == E::integer(1))?;
        column.next().is_none().then(|| at.to_string())
    };
    match (0..op.cols()).map(unit).collect::<Option<Vec<String>>>() {
        Some(points) => format!("points = [{}]", points.join(", ")),
        None => format!("matrix = {}", matrix(op, "")),
    }
}

fn entry<E: Entry>(x: &E) -> String {
    let whole = x.rational().is_some_and(|q| *q.denominator_ref() == 1);
    if whole { x.to_string() } else { format!("\"{x}\"") }
}

/// The rows on lines of their own behind `indent`, or on one line where there is none.
fn matrix<E: Entry>(m: &Matrix<E>, indent: &str) -> String {
    let row = |i: usize| format!("[{}]", m.row(i).iter().map(|x| entry(x)).collect::<Vec<_>>().join(", "));
    let separator = if indent.is_empty() { ", ".to_owned() } else { format!(",\n{indent}") };
    format!("[{}]", (0..m.rows()).map(row).collect::<Vec<_>>().join(&separator))
}

/// A TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
