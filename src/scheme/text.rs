//! Shapes written as case files, so that what a scheme or a solution gives can be read, changed, certified and checked like
//! any other case.

use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{CellKind, Frame, Shape, State};
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
}

/// The shape as a case file (`docs/case-format.md`). Faces are written as sets, without their boundaries; a shape of affine
/// maps is written on its simplex, with the control points that lead back.
#[must_use]
pub fn case_text(shape: &Shape, heading: &Heading) -> String {
    let mut out = String::new();
    for (key, value) in [("name", &heading.name), ("title", &heading.title), ("source", &heading.source)] {
        if !value.is_empty() {
            let _ = writeln!(out, "{key} = {}", quoted(value));
        }
    }
    let single = shape.states.len() == 1;
    if shape.states[shape.start].kind != CellKind::Edge {
        out.push_str("kind = \"set\"\n");
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
        shape.states.iter().for_each(|state| table(&mut out, shape, state));
    }
    if shape.frame == Frame::Affine {
        return format!("# Affine maps, written on the simplex 0, e_1, …, e_d.\n{out}");
    }
    out
}

fn pieces(out: &mut String, state: &State) {
    out.push_str("pieces = [\n");
    for piece in &state.pieces {
        let _ = writeln!(out, "    {},", matrix(&piece.op, "     "));
    }
    out.push_str("]\n");
    let reversed: Vec<String> =
        state.pieces.iter().enumerate().filter(|(_, p)| p.reversed).map(|(k, _)| k.to_string()).collect();
    if !reversed.is_empty() {
        let _ = writeln!(out, "reversed = [{}]", reversed.join(", "));
    }
}

fn table(out: &mut String, shape: &Shape, state: &State) {
    let kind = match state.kind {
        CellKind::Edge => "edge",
        CellKind::Vertex => "vertex",
        CellKind::Set | CellKind::Face => "set",
    };
    let name = |index: usize| quoted(&shape.states[index].name);
    let _ = writeln!(out, "\n[[state]]\nname = {}\nkind = \"{kind}\"\ndimension = {}", quoted(&state.name), state.dim);
    for (side, boundary) in [("left", &state.left), ("right", &state.right)] {
        if let Some(b) = boundary {
            let _ = writeln!(out, "{side} = {{ vertex = {}, matrix = {} }}", name(b.vertex), matrix(&b.op, ""));
        }
    }
    for piece in &state.pieces {
        let _ = writeln!(out, "[[state.piece]]\nto = {}\nmatrix = {}", name(piece.target), matrix(&piece.op, "    "));
        if piece.reversed {
            out.push_str("reversed = true\n");
        }
    }
}

/// The rows on lines of their own behind `indent`, or on one line where there is none.
fn matrix(m: &Matrix, indent: &str) -> String {
    let entry = |x: &Rational| if *x.denominator_ref() == 1 { x.to_string() } else { format!("\"{x}\"") };
    let row = |i: usize| format!("[{}]", m.row(i).iter().map(entry).collect::<Vec<_>>().join(", "));
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
