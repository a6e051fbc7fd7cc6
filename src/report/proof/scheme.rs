//! The scheme, its contraction, and the identities of a curve.

use super::super::document::{Block, Check, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::words::{contraction, count, listed, short_bound};
use super::{Quoted, matrix};
use crate::case::{Case, Convention};
use crate::report::figures;
use crate::shape::{Balls, CellKind, Contraction, End, Frame, Shape, Spaces, word_text};
use crate::statement::Statement;
use crate::theorem::{BranchReport, Certified, Outcome, Witness};

/// Most code words that are listed.
const MAX_WORDS: usize = 400;

/// The sections on the operators, contraction, identities and relevant spaces.
pub(super) fn section(case: &Case, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let shape = &case.shape;
    let mut blocks = vec![Block::heading(2, "The scheme")];
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
    let by = |c: &Contraction| {
        if matches!(c, Contraction::Polytopes(_)) { Statement::Lemma1Prime } else { Statement::Lemma1 }
    };
    match &found.contraction {
        Contraction::Product(proof) => proof.factors.iter().for_each(|c| blocks.extend(seen.once_id(by(c)))),
        one => blocks.extend(seen.once_id(by(one))),
    }
    let mut result = words("Here contraction is ");
    result.extend(contraction(&found.contraction));
    result.extend(words("."));
    blocks.push(Block::Paragraph(result));
    blocks.extend(code_words(shape, &found.contraction));
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

/// A number exactly where that is short, otherwise as an upper bound.
fn bounded(x: &crate::arith::Rational) -> Math {
    match short_bound(x) {
        exact @ Math::Number(_) => exact,
        above => Math::parse("≤@", &mut std::iter::once(above)),
    }
}

fn convention(case: &Case) -> Line {
    let mut out = match case.convention {
        Convention::Columns => line(
            "The operators act on columns of barycentric coordinates; every column sums to 1. The case gives them in this form.",
            [],
        ),
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

fn state_line(shape: &Shape, e: usize) -> Line {
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

fn code_words(shape: &Shape, found: &Contraction) -> Option<Block> {
    let Contraction::Proved(proof) = found else { return None };
    let total: usize = proof.codes.iter().map(Vec::len).sum();
    let several = shape.states.len() > 1;
    let mut rows = Vec::new();
    for (e, code_of_state) in proof.codes.iter().enumerate() {
        for word in code_of_state {
            let mut row = vec![code(word_text(&word.word)), formula(bounded(&word.tau))];
            if several {
                row.insert(0, words(shape.states[e].name.clone()));
            }
            rows.push(row);
        }
    }
    let mut caption = words("The words of the prefix code");
    if total > MAX_WORDS {
        rows.truncate(MAX_WORDS);
        caption.extend(words(format!(", the first {MAX_WORDS} of {total}")));
    }
    let mut header = vec![words("word"), line("$τ(T_w)$", [])];
    if several {
        header.insert(0, words("state"));
    }
    let table = Block::Table(Table { caption: Line::new(), header, rows });
    Some(if total > 12 { Block::Details { summary: caption, blocks: vec![table] } } else { table })
}

/// The end points and the meeting points of neighbouring pieces.
fn identities(shape: &Shape) -> Vec<Block> {
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
        let mut push = |what: String, point: Option<Vec<crate::arith::Rational>>| {
            if let Some(point) = point {
                rows.push(vec![words(what), formula(Math::vector(&point))]);
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

/// The polygons that hold the attractors, where a ring condition used them.
fn polygons(shape: &Shape, found: &Certified) -> Vec<Block> {
    if let Contraction::Polytopes(proof) = &found.contraction {
        let text = "The attractors lie inside the polytopes that prove contraction; a functional takes its extreme values at vertices.";
        let table = vertices(shape, |e| &proof.vertices[e]);
        let summary = words("The vertices of the polytopes:");
        return vec![Block::text(text, []), Block::Details { summary, blocks: vec![table] }];
    }
    if !found.points.iter().flat_map(|p| &p.branches).any(uses_polygons) {
        return Vec::new();
    }
    let hulls = Spaces::new(shape).and_then(|spaces| {
        Balls::of(shape, &spaces, &found.contraction).and_then(|balls| balls.with_hulls(shape, &spaces))
    });
    let Some(hulls) = hulls else { return Vec::new() };
    let table = vertices(shape, |e| hulls.hull(e).unwrap_or_default());
    vec![
        Block::text(
            "Where a ring condition needs sharper enclosures, these convex polygons are used: every map sends polygon into polygon, which is \
             checked exactly at the vertices, so that the attractors lie inside; a functional takes its extreme values at vertices.",
            [],
        ),
        Block::Details { summary: words("The vertices of the polygons:"), blocks: vec![table] },
    ]
}

/// The vertices of all reachable states.
fn vertices<'a>(shape: &Shape, of: impl Fn(usize) -> &'a [Vec<crate::arith::Rational>]) -> Block {
    let row = |(e, vertex): (usize, &Vec<_>)| vec![words(shape.states[e].name.clone()), formula(Math::vector(vertex))];
    let rows = shape.reachable().into_iter().flat_map(|e| of(e).iter().map(move |v| (e, v))).map(row).collect();
    let header = vec![words("state"), words("vertex")];
    Block::Table(by_state(shape, Table { caption: Line::new(), header, rows }))
}

fn uses_polygons(branch: &BranchReport) -> bool {
    match &branch.outcome {
        Outcome::Line { proof, .. } => proof.as_ref().is_some_and(|p| p.polygons),
        Outcome::AtLeast { isolation, witness, .. } => {
            let crossing = matches!(witness, Some(Witness::Crossing { cover, .. }) if cover.polygons);
            crossing || isolation.as_ref().is_some_and(|p| p.polygons)
        }
        Outcome::NoGerm { .. } | Outcome::Open { .. } => false,
    }
}

/// A table whose first column names states, without that column where there is one state only.
fn by_state(shape: &Shape, mut table: Table) -> Table {
    if shape.states.len() == 1 {
        table.header.remove(0);
        table.rows.iter_mut().for_each(|row| drop(row.remove(0)));
    }
    table
}

fn spaces(shape: &Shape, found: &Certified, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Relevant spaces and enclosures")];
    let hidden = found.states.iter().any(|s| s.visible < s.relevant);
    let part = if hidden {
        " Of its dimensions those are seen that are left after division by what the control points do not show, whatever operators come first."
    } else {
        ""
    };
    let text = if shape.states.len() > 1 {
        format!(
            "The relevant space $V_e$ of a state $e$ is the span of the differences of points of its attractor $A_e$, computed by closing the differences \
             of one point of each attractor under the operators.{part} Each attractor lies in the 1-norm ball around its base point with the \
             radius given."
        )
    } else {
        format!(
            "The relevant space $V$ is the span of the differences of points of the attractor $A$, computed by closing the differences between one \
             point and its images under the operators.{part} The attractor lies in the 1-norm ball around the base point with the radius given."
        )
    };
    blocks.push(Block::text(&text, []));
    let rows = found.states.iter().map(|s| {
        let mut row = vec![
            words(shape.states[s.state].name.clone()),
            formula(Math::count(s.relevant)),
            formula(Math::vector(&s.base)),
            formula(bounded(&s.radius)),
        ];
        if hidden {
            row.insert(2, formula(Math::count(s.visible)));
        }
        row
    });
    let dimension = if shape.states.len() > 1 { "$\\dim V_e$" } else { "$\\dim V$" };
    let mut header = vec![words("state"), line(dimension, []), words("base point"), words("radius")];
    if hidden {
        header.insert(2, words("of which seen"));
    }
    blocks.push(Block::Table(by_state(shape, Table { caption: Line::new(), header, rows: rows.collect() })));
    blocks.extend(polygons(shape, found));
    if let Some(similar) = &found.similarities {
        blocks.extend(seen.once_id(Statement::Similarities));
        blocks.push(Block::Checks(vec![Check {
            tone: Tone::Good,
            text: line(
                "The linear parts $L_i$ of the maps $T_i$, in the basis of $V$ given below with the cycles, satisfy $L_i^T Q L_i = c_i Q$ with the \
                 positive definite $Q=@$ and the squared ratios $c=@$.",
                [Math::matrix(&similar.gram), Math::vector(&similar.squared_ratios)],
            ),
        }]));
    }
    blocks
}
