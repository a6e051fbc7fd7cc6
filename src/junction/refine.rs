//! Refinement of a curve (thesis, §5.1.3) or of a surface (§5.2.4): the first-level cells on points of their own, glued where they
//! meet.

use super::JunctionError;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::{CellKind, Complex, Piece, State};

/// A refined curve, and how it lies in the one before.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The shape; its start state has the cells of the first level as pieces, by selections of its points.
    pub complex: Complex,
    /// `E`: the points of the refined start state as combinations of those of the start state before.
    pub embedding: Matrix,
    /// The word of the old start state whose cell each piece of the refined one is.
    pub cells: Vec<[usize; 2]>,
}

/// A cell of the refined shape: its state, its operator from the old start state, whether it runs backwards.
pub(super) struct Cell {
    pub word: [usize; 2],
    pub target: usize,
    pub op: Matrix,
    pub reversed: bool,
    /// What it takes of the parameter.
    pub share: Rational,
}

/// The cells of the first level of a state on common points: the points of each cell, and all points as combinations of the old ones.
pub(super) struct Glued {
    pub cells: Vec<Cell>,
    pub places: Vec<Vec<usize>>,
    pub embedding: Matrix,
}

pub(super) fn wrong(why: &str) -> JunctionError {
    JunctionError::Refinement(why.to_owned())
}

/// Refines the start state of a curve or of a surface once. With `E` the embedding, `E T'_{ij} = T_i T_j` for all cells `ij`, so that control points
/// `P E` give the same curve; other control points give a larger family, in which a point moves only the cells that use it.
///
/// # Errors
/// [`JunctionError::Refinement`] where the start is neither a curve nor a surface of quadrangles, or it is not known on which points
/// neighbouring cells meet.
///
/// # Examples
/// ```
/// use secant::junction::refine;
/// use secant::scheme::bspline;
/// use secant::shape::Complex;
///
/// let cubic = Complex::of_curves(bspline(3, 2)?.curve()?);
/// let refined = refine(&cubic)?;
/// assert_eq!((refined.embedding.rows(), refined.embedding.cols()), (4, 7));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn refine(complex: &Complex) -> Result<Refined, JunctionError> {
    let start = complex.shape.start;
    match complex.shape.states[start].kind {
        CellKind::Edge => {
            let glued = glue_curve(complex, start)?;
            let mut out = complex.clone();
            let state = glued.state(&complex.shape.states[start], CellKind::Edge);
            out.shape.start = put(&mut out, start, state, glued.pieces_lead_to(start));
            out.shape.control = complex.shape.control.as_ref().map(|p| p * &glued.embedding);
            Ok(glued.refined(out))
        }
        CellKind::Face => super::refine_face::refine_face(complex, start),
        CellKind::Vertex | CellKind::Set => Err(wrong("only curves and surfaces are refined")),
    }
}

/// The cells of an edge on common points.
pub(super) fn glue_curve(complex: &Complex, edge: usize) -> Result<Glued, JunctionError> {
    let cells = cells(complex, edge);
    let mut places: Vec<Vec<usize>> = Vec::new();
    let mut columns: Vec<Vec<Rational>> = Vec::new();
    for (k, cell) in cells.iter().enumerate() {
        let mut own: Vec<Option<usize>> = vec![None; cell.op.cols()];
        if k > 0 {
            let meet = meet(complex, &cells[k - 1], cell);
            let pairs =
                meet.ok_or_else(|| wrong("neighbouring cells share no points; give `left` and `right` of the states"))?;
            pairs.into_iter().for_each(|(before, after)| own[after] = Some(places[k - 1][before]));
        }
        let mut order: Vec<usize> = (0..own.len()).collect();
        if cell.reversed {
            order.reverse();
        }
        for j in order {
            if own[j].is_none() {
                columns.push(cell.op.column(j));
                own[j] = Some(columns.len() - 1);
            }
        }
        places.push(own.into_iter().flatten().collect());
    }
    let embedding = Matrix::from_columns(complex.shape.states[edge].dim, &columns);
    Ok(Glued { cells, places, embedding })
}

/// The cells of the first level in the order of the parameter.
fn cells(complex: &Complex, edge: usize) -> Vec<Cell> {
    let states = &complex.shape.states;
    let mut cells = Vec::new();
    let start = &states[edge];
    for (i, outer) in start.pieces.iter().enumerate() {
        let inner = states[outer.target].pieces.iter().enumerate().map(|(j, p)| Cell {
            word: [i, j],
            target: p.target,
            op: &outer.op * &p.op,
            reversed: p.reversed != outer.reversed,
            share: start.share(i) * states[outer.target].share(j),
        });
        if outer.reversed { cells.extend(inner.rev()) } else { cells.extend(inner) }
    }
    cells
}

/// The points that two neighbouring cells share, as pairs of their coordinates.
fn meet(complex: &Complex, before: &Cell, after: &Cell) -> Option<Vec<(usize, usize)>> {
    let states = &complex.shape.states;
    let same = |pairs: &[(usize, usize)]| pairs.iter().all(|(i, j)| before.op.column(*i) == after.op.column(*j));
    let ends = if before.reversed { &states[before.target].left } else { &states[before.target].right };
    let begins = if after.reversed { &states[after.target].right } else { &states[after.target].left };
    if let (Some(a), Some(b)) = (ends, begins)
        && a.vertex == b.vertex
        && let (Some(a), Some(b)) = (picked(&a.op), picked(&b.op))
    {
        let pairs: Vec<(usize, usize)> = a.into_iter().zip(b).collect();
        return same(&pairs).then_some(pairs);
    }
    if before.reversed || after.reversed {
        return None;
    }
    // Without vertices: the last points of one cell are the first of the next, or the other way round as masks list them.
    let (n, m) = (before.op.cols(), after.op.cols());
    let onward = |p: usize| (0..p).map(|i| (n - p + i, i)).collect::<Vec<_>>();
    let backwards = |p: usize| (0..p).map(|i| (i, m - p + i)).collect::<Vec<_>>();
    let (end, begin) = (end_point(complex, before, true)?, end_point(complex, after, false)?);
    let holds = |pairs: &Vec<(usize, usize)>| {
        let outside = |x: &[Rational], used: &dyn Fn(usize) -> bool| (0..x.len()).any(|i| x[i] != 0 && !used(i));
        let agree = pairs.iter().all(|(i, j)| end[*i] == begin[*j]);
        let inside = !outside(&end, &|i| pairs.iter().any(|p| p.0 == i))
            && !outside(&begin, &|j| pairs.iter().any(|p| p.1 == j));
        same(pairs) && agree && inside
    };
    (1..n.min(m)).rev().flat_map(|p| [onward(p), backwards(p)]).find(holds)
}

fn end_point(complex: &Complex, cell: &Cell, finish: bool) -> Option<Vec<Rational>> {
    let end = if finish { crate::shape::End::Finish } else { crate::shape::End::Start };
    complex.shape.end_point(cell.target, end)
}

/// The coordinates that a boundary picks.
pub(super) fn picked(op: &Matrix) -> Option<Vec<usize>> {
    (0..op.cols())
        .map(|j| {
            let mut used = (0..op.rows()).filter(|&i| op[(i, j)] != 0);
            let at = used.next().filter(|&i| op[(i, j)] == 1)?;
            used.next().is_none().then_some(at)
        })
        .collect()
}

impl Glued {
    /// The state of the cells as pieces, by selections of its points; the parameter stays that of the shape before.
    pub fn state(&self, old: &State, kind: CellKind) -> State {
        let size = self.embedding.cols();
        let select = |own: &[usize]| Matrix::from_fn(size, own.len(), |i, j| Rational::from(u8::from(own[j] == i)));
        let equal = kind == CellKind::Face || self.cells.iter().all(|c| c.share == self.cells[0].share);
        let share = |c: &Cell| (!equal).then(|| c.share.clone());
        let piece = |(c, own): (&Cell, &Vec<usize>)| Piece {
            target: c.target,
            op: select(own),
            reversed: c.reversed,
            share: share(c),
        };
        let pieces: Vec<Piece> = self.cells.iter().zip(&self.places).map(piece).collect();
        State { name: old.name.clone(), kind, dim: size, pieces, left: None, right: None }
    }

    pub fn pieces_lead_to(&self, state: usize) -> bool {
        self.cells.iter().any(|c| c.target == state)
    }

    pub fn refined(self, complex: Complex) -> Refined {
        Refined { complex, embedding: self.embedding, cells: self.cells.into_iter().map(|c| c.word).collect() }
    }
}

/// Puts a state in place of an old one, which stays only where another state, or a new piece, leads to it; the number of the new one.
pub(super) fn put(out: &mut Complex, old: usize, mut state: State, again: bool) -> usize {
    let states = &out.shape.states;
    let again = again || states.iter().enumerate().any(|(k, s)| k != old && s.pieces.iter().any(|p| p.target == old));
    let base = states[old].name.split_once('\'').map_or(states[old].name.as_str(), |(base, _)| base);
    let mut name = format!("{}'", states[old].name);
    while states.iter().any(|s| s.name == name) {
        name = format!("{name}'");
    }
    state.name = if again { name } else { base.to_owned() };
    if again {
        out.shape.states.push(state);
        return out.shape.states.len() - 1;
    }
    out.reversals.remove(&old);
    out.shape.states[old] = state;
    old
}
