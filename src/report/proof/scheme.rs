//! The scheme, its contraction, and the identities of a curve.

use super::super::document::{Block, Line, Table, formula, line, words};
use super::super::math::Math;
use super::super::reported::{Reported, entries, vector};
use super::super::words::{count, listed};
use super::contracts::{self, bounded, by_state};
use super::evidence::Evidence;
use super::{Quoted, given, matrix};
use crate::case::{Case, Convention, Origin};
use crate::report::figures;
use crate::shape::{CellKind, End, Frame, Shape};
use crate::statement::Statement;
use crate::theorem::Certified;

/// The sections on the operators, contraction, identities and relevant spaces.
pub(super) fn section<E: Reported>(case: &Case<E>, found: &Certified<E>, seen: &mut Quoted) -> Vec<Block> {
    let shape = &case.shape;
    let mut blocks = vec![Block::heading(2, "The scheme")];
    blocks.extend(given::blocks(case));
    blocks.push(Block::Paragraph(convention(case)));
    blocks.extend(figures::automaton(shape));
    for (e, state) in shape.states.iter().enumerate() {
        if shape.states.len() > 1 {
            blocks.push(Block::Paragraph(state_line(shape, e)));
        }
        for (i, piece) in state.pieces.iter().enumerate() {
            let of = (shape.states.len() > 1).then_some(state.name.as_str());
            blocks.push(matrix(operator(i, of), &piece.op));
        }
    }
    if let Some(control) = shape.control.as_ref().filter(|_| shape.frame == Frame::Barycentric) {
        blocks.push(Block::text("The control points are the columns of", []));
        blocks.push(matrix(Math::Letter('P'), control));
    }
    blocks.push(Block::heading(2, "Contraction"));
    blocks.extend(contracts::section(shape, &found.contraction, seen));
    if shape.states[shape.start].kind == CellKind::Edge && !found.states.is_empty() {
        blocks.extend(identities(shape));
    }
    if !found.states.is_empty() {
        blocks.extend(spaces(shape, found, seen));
    }
    blocks
}

/// `T_i`, with the name of the state above where there are several.
pub(super) fn operator(letter: usize, state: Option<&str>) -> Math {
    let mut values = vec![Math::count(letter)];
    let notation = match state {
        Some(name) => {
            values.push(Math::Word(name.to_owned()));
            "T_@^@"
        }
        None => "T_@",
    };
    Math::parse(notation, &mut values.into_iter())
}

fn convention<E: Reported>(case: &Case<E>) -> Line {
    let mut out = match case.convention {
        Convention::Columns => {
            let mut text = words("The operators act on columns of barycentric coordinates; every column sums to 1.");
            text.extend(words(match (&case.scheme, &case.flat) {
                (None, None) => " The case gives them in this form.",
                (Some(Origin::Interpolation(_)), _) => " They are made of these data.",
                _ => " They are made of what the case gives.",
            }));
            text
        }
        Convention::Rows => line(
            "The case gives subdivision matrices $S$ that act on rows of control points, with row sums 1; the operators on columns of \
             barycentric coordinates are the transposes, with column sums 1.",
            [],
        ),
        Convention::Affine => line(
            "The case gives affine maps $x↦Bx+t$ of $ℝ^{@}$. They are written as operators on columns of barycentric coordinates with \
             respect to the points $0, e_1, …$; every column sums to 1.",
            [Math::count(case.shape.states[case.shape.start].dim.saturating_sub(1))],
        ),
    };
    // Of an automaton the list of states says so.
    if let [only] = case.shape.states.as_slice() {
        let back = only.pieces.iter().enumerate().filter(|(_, p)| p.reversed);
        let back: Vec<String> = back.map(|(i, _)| i.to_string()).collect();
        match back.as_slice() {
            [] => {}
            [one] => out.extend(words(format!(" Piece {one} runs backwards."))),
            _ => out.extend(words(format!(" Pieces {} run backwards.", listed(&back)))),
        }
    }
    out
}

fn state_line<E: Reported>(shape: &Shape<E>, e: usize) -> Line {
    let state = &shape.states[e];
    let kind = match state.kind {
        CellKind::Vertex => "a vertex",
        CellKind::Edge => "an edge",
        CellKind::Set => "a set",
        CellKind::Face => "a face",
    };
    let pieces: Vec<String> = state
        .pieces
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let back = if p.reversed { " backwards" } else { "" };
            format!("{i} leads to {}{back}", shape.states[p.target].name)
        })
        .collect();
    let start = if e == shape.start { ", where the shape starts," } else { "" };
    let led = match pieces.as_slice() {
        [] => String::new(),
        [one] => format!(": piece {one}"),
        _ => format!(": piece {}", listed(&pieces)),
    };
    let text = format!("State {}{start} is {kind} with {}{led}.", state.name, count(state.dim, "coordinate"));
    words(text)
}

/// The end points and the meeting points of neighbouring pieces.
fn identities<E: Reported>(shape: &Shape<E>) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Identities of the curve")];
    blocks.push(Block::text(
        "Every piece begins where the one before ends (checked below); so the attractors of the edge states are curves, and their cells are \
         connected.",
        [],
    ));
    let mut rows = Vec::new();
    let several = shape.states.len() > 1;
    for e in shape.reachable() {
        let state = &shape.states[e];
        if state.kind != CellKind::Edge {
            continue;
        }
        let mut push = |what: String, point: Option<Vec<E>>| {
            if let Some(point) = point {
                rows.push(vec![words(what), formula(vector(&point))]);
            }
        };
        let of = if several { format!(" of state {}", state.name) } else { String::new() };
        push(format!("start{of}"), shape.end_point(e, End::Start));
        push(format!("end{of}"), shape.end_point(e, End::Finish));
        for j in 1..state.pieces.len() {
            let piece = &state.pieces[j];
            let meeting = shape.end_point(piece.target, End::Start.in_piece(piece)).map(|x| piece.op.apply(&x));
            push(format!("end of piece {}{of} = start of piece {j}", j - 1), meeting);
        }
    }
    let header = vec![words("point"), words("barycentric coordinates")];
    blocks.push(Block::Table(Table { caption: Line::new(), header, rows }));
    blocks
}

fn spaces<E: Reported>(shape: &Shape<E>, found: &Certified<E>, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Relevant spaces and enclosures")];
    let hidden = found.states.iter().any(|s| s.visible < s.relevant);
    let part = if hidden {
        " The visible quotient $W_e$ is what is left of it after division by the vectors that $P T_u$ kills for every path $u$ from the start state \
         to $e$, where $P$ stands for the control points, or for the identity where there are none."
    } else {
        ""
    };
    let text = if shape.states.len() > 1 {
        format!(
            "The relevant space $V_e$ of a state $e$ is the span of the differences of points of its attractor $A_e$, computed by closing the differences \
             of one point of each attractor under the operators.{part}"
        )
    } else {
        format!(
            "The relevant space $V$ is the span of the differences of points of the attractor $A$, computed by closing the differences between one \
             point and its images under the operators.{part}"
        )
    };
    blocks.push(Block::text(&text, []));
    let enclosed = contracts::uses_enclosures(found);
    if enclosed {
        blocks.push(Block::text(
            "Each attractor lies in the 1-norm ball around its base point with the radius given.",
            [],
        ));
    }
    let rows = found.states.iter().map(|s| {
        let mut row =
            vec![words(shape.states[s.state].name.clone()), formula(Math::count(s.relevant)), formula(vector(&s.base))];
        if enclosed {
            row.push(formula(bounded(&s.radius)));
        }
        if hidden {
            row.insert(2, formula(Math::count(s.visible)));
        }
        row
    });
    let dimension = if shape.states.len() > 1 { "$\\dim V_e$" } else { "$\\dim V$" };
    let mut header = vec![words("state"), line(dimension, []), words("base point")];
    if enclosed {
        header.push(words("radius"));
    }
    if hidden {
        header.insert(2, line("$\\dim W_e$", []));
    }
    blocks.push(Block::Table(by_state(shape, Table { caption: Line::new(), header, rows: rows.collect() })));
    if enclosed {
        let polygons = contracts::polygons(shape, found);
        blocks.extend(contracts::enclosures(shape, &found.contraction, &found.states, polygons, seen));
    }
    if let Some(similar) = &found.similarities {
        blocks.extend(seen.once_id(Statement::Similarities));
        let evidence = Evidence::of(Statement::Similarities)
            .holds(
                "similar",
                "the linear parts $L_i$ of the maps $T_i$, in the basis of $V$ given below with the cycles, satisfy $L_i^T Q L_i=c_i Q$ with the \
                 positive definite matrix of a scalar product $Q=@$ and the squared ratios $c=@$.",
                [entries(&similar.gram), vector(&similar.squared_ratios)],
            )
            .holds("dimension", "$\\dim V=@$, and there is one state.", [Math::count(similar.gram.rows())]);
        blocks.push(evidence.block());
    }
    blocks
}
