//! Refinement of a surface of quadrangles: its first-level cells in columns and rows, glued along their edges.

use super::JunctionError;
use super::refine::{Cell, Glued, Refined, glue_curve, picked, put, wrong};
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{Boundary, CellKind, Complex, Face, Layout, Piece, Side, State};
use std::collections::BTreeMap;

/// The cells of a face by row and column, as numbers of a list in that order.
struct Cells {
    list: Vec<Cell>,
    columns: usize,
    rows: usize,
}

/// Refines a face once, with the edges around it.
pub(super) fn refine_face(complex: &Complex, start: usize) -> Result<Refined, JunctionError> {
    let face = &complex.faces.get(&start).ok_or_else(|| wrong("the sides of the start face are not given"))?;
    let cells = cells(complex, start)?;
    let (columns, rows) = (cells.columns, cells.rows);
    let glued = glue(complex, cells)?;
    let mut out = complex.clone();
    let mut edges: BTreeMap<usize, usize> = BTreeMap::new();
    let mut sides = Vec::new();
    for (side, old) in face.sides.iter().enumerate() {
        // Opposite sides may be one edge, which is refined once.
        let edge = match edges.get(&old.edge) {
            Some(known) => *known,
            None => {
                let new = refined_edge(complex, &mut out, old.edge)?;
                edges.insert(old.edge, new);
                new
            }
        };
        sides.push(Side { edge, op: along(&out, &glued, side, edge, [columns, rows])? });
    }
    let state = glued.state(&complex.shape.states[start], CellKind::Face);
    let new = put(&mut out, start, state, glued.pieces_lead_to(start));
    out.faces.insert(new, Face { layout: Layout::Quad { columns, rows }, sides, placement: Vec::new() });
    out.shape.start = new;
    out.shape.control = complex.shape.control.as_ref().map(|p| p * &glued.embedding);
    Ok(glued.refined(out))
}

/// The cells of the first level, where all faces are quadrangles without turned pieces and those of one column (row) are divided alike.
fn cells(complex: &Complex, start: usize) -> Result<Cells, JunctionError> {
    let layout = |e: usize| {
        let face = complex.faces.get(&e).ok_or_else(|| wrong("the sides of a face are not given"))?;
        let turned = face.placement.iter().any(|p| !p.is_sorted());
        match face.layout {
            Layout::Quad { columns, rows } if !turned => Ok((columns, rows)),
            _ => Err(wrong("only quadrangles without turned pieces are refined")),
        }
    };
    let (wide, high) = layout(start)?;
    let states = &complex.shape.states;
    let target = |i: usize, j: usize| states[start].pieces[j * wide + i].target;
    let mut across = Vec::new();
    let mut up = Vec::new();
    for i in 0..wide {
        across.push(layout(target(i, 0))?.0);
    }
    for j in 0..high {
        up.push(layout(target(0, j))?.1);
    }
    let mut list = Vec::new();
    for (j, stripes) in up.iter().enumerate() {
        for row in 0..*stripes {
            for (i, parts) in across.iter().enumerate() {
                if layout(target(i, j))? != (*parts, *stripes) {
                    return Err(wrong("faces side by side are divided differently"));
                }
                let outer = &states[start].pieces[j * wide + i];
                for column in 0..*parts {
                    let letter = row * parts + column;
                    let inner = &states[outer.target].pieces[letter];
                    list.push(Cell {
                        word: [j * wide + i, letter],
                        target: inner.target,
                        op: &outer.op * &inner.op,
                        reversed: false,
                        share: Rational::from(1),
                    });
                }
            }
        }
    }
    Ok(Cells { list, columns: across.iter().sum(), rows: up.iter().sum() })
}

/// The points that a side of a face picks, with the edge from which they come.
fn side_points(complex: &Complex, face: usize, side: usize) -> Result<(usize, Vec<usize>), JunctionError> {
    let side = complex.faces.get(&face).and_then(|f| f.sides.get(side)).ok_or_else(|| wrong("a side is not given"))?;
    let points = picked(&side.op).ok_or_else(|| wrong("a side of a face is no selection of its points"))?;
    Ok((side.edge, points))
}

/// Gives every cell its points, those of the sides that it shares with the cells on the left and below first.
fn glue(complex: &Complex, cells: Cells) -> Result<Glued, JunctionError> {
    let dim = complex.shape.states[complex.shape.start].dim;
    let mut places: Vec<Vec<usize>> = Vec::new();
    let mut columns: Vec<Vec<Rational>> = Vec::new();
    for (k, cell) in cells.list.iter().enumerate() {
        let mut own: Vec<Option<usize>> = vec![None; cell.op.cols()];
        // Right side of the left neighbour, top of the one below.
        let left = (k % cells.columns > 0).then(|| (k - 1, 1, 3));
        let below = k.checked_sub(cells.columns).map(|before| (before, 2, 0));
        for (before, theirs, mine) in left.into_iter().chain(below) {
            let (edge, from) = side_points(complex, cells.list[before].target, theirs)?;
            let (same, to) = side_points(complex, cell.target, mine)?;
            if edge != same {
                return Err(wrong("neighbouring cells meet in different edges"));
            }
            for (p, q) in from.into_iter().zip(to) {
                let place = places[before][p];
                let fits = own[q].is_none_or(|known| known == place) && columns[place] == cell.op.column(q);
                if !fits {
                    return Err(wrong("neighbouring cells do not share the points of their edge"));
                }
                own[q] = Some(place);
            }
        }
        let mut all = Vec::new();
        for (j, place) in own.into_iter().enumerate() {
            all.push(place.unwrap_or_else(|| {
                columns.push(cell.op.column(j));
                columns.len() - 1
            }));
        }
        places.push(all);
    }
    Ok(Glued { cells: cells.list, places, embedding: Matrix::from_columns(dim, &columns) })
}

/// Refines an edge around a face; its ends are the vertices of its cells, which are not refined there.
fn refined_edge(complex: &Complex, out: &mut Complex, edge: usize) -> Result<usize, JunctionError> {
    let glued = glue_curve(complex, edge)?;
    let mut state = glued.state(&complex.shape.states[edge], CellKind::Edge);
    let ends = |finish: bool| {
        let piece = if finish { state.pieces.last() } else { state.pieces.first() }?;
        let inner = &complex.shape.states[piece.target];
        let end = if finish == piece.reversed { &inner.left } else { &inner.right };
        end.as_ref().map(|b| (b.vertex, &piece.op * &b.op))
    };
    let (left, right) = (ends(false), ends(true));
    let mut wrapped =
        |end: Option<(usize, Matrix)>| end.map(|(vertex, op)| Boundary { vertex: wrapper(out, vertex), op });
    (state.left, state.right) = (wrapped(left), wrapped(right));
    Ok(put(out, edge, state, glued.pieces_lead_to(edge)))
}

/// A vertex that is another one, not refined: one that is there, or a new one.
fn wrapper(out: &mut Complex, vertex: usize) -> usize {
    let dim = out.shape.states[vertex].dim;
    let same = |s: &State| {
        s.kind == CellKind::Vertex
            && matches!(s.pieces.as_slice(), [p] if p.target == vertex && p.op == Matrix::identity(dim))
    };
    if let Some(known) = out.shape.states.iter().position(same) {
        return known;
    }
    let mut name = format!("w{}", out.shape.states[vertex].name);
    while out.shape.states.iter().any(|s| s.name == name) {
        name.push('\'');
    }
    let pieces = vec![Piece { target: vertex, op: Matrix::identity(dim), reversed: false, share: None }];
    out.shape.states.push(State { name, kind: CellKind::Vertex, dim, pieces, left: None, right: None });
    out.shape.states.len() - 1
}

/// The points of a refined edge among those of the refined face, whose cells stand along it.
fn along(
    out: &Complex,
    glued: &Glued,
    side: usize,
    edge: usize,
    [columns, rows]: [usize; 2],
) -> Result<Matrix, JunctionError> {
    let cells: Vec<usize> = match side {
        0 => (0..columns).collect(),
        1 => (0..rows).map(|j| (j + 1) * columns - 1).collect(),
        2 => (0..columns).map(|i| (rows - 1) * columns + i).collect(),
        _ => (0..rows).map(|j| j * columns).collect(),
    };
    let state = &out.shape.states[edge];
    if state.pieces.len() != cells.len() {
        return Err(wrong("a side is divided differently from the cells along it"));
    }
    let mut at: Vec<Option<usize>> = vec![None; state.dim];
    for (piece, cell) in state.pieces.iter().zip(cells) {
        let (inner, points) = side_points(out, glued.cells[cell].target, side)?;
        let own = picked(&piece.op).ok_or_else(|| wrong("a piece of a side is no selection"))?;
        if inner != piece.target || piece.reversed {
            return Err(wrong("the pieces of a side are not the sides of the cells along it"));
        }
        for (mine, theirs) in own.into_iter().zip(points) {
            let place = glued.places[cell][theirs];
            if at[mine].is_some_and(|known| known != place) {
                return Err(wrong("a point of a side is two points of the face"));
            }
            at[mine] = Some(place);
        }
    }
    let at: Option<Vec<usize>> = at.into_iter().collect();
    let at = at.ok_or_else(|| wrong("a point of a side is no point of a cell"))?;
    Ok(Matrix::from_fn(glued.embedding.cols(), at.len(), |i, j| Rational::from(u8::from(at[j] == i))))
}
