//! The parameters of a patch: which cells hold a parameter, and by which addresses (docs/certificate.md, section 8.1).

use crate::base::{Checked, MAX_PIECES, Matrix, Node, Q, index, need, number::ratio, some, spend, whole};
use crate::curve::{Address, Kind, Piece, Shape, State, case};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Cells that may be visited in search of the addresses of a parameter.
const MAX_STEPS: usize = 20_000;

/// The faces of a case as even divisions of a square or a triangle. A parameter `(u, v)` is the column `1 − u − v, u, v`, and the
/// operator of a piece is the affine map that puts the parameters of its face where the piece lies.
pub struct Chart {
    maps: Shape,
    triangle: bool,
}

/// The corners of a square or a triangle as parameters, in their order.
fn corners(triangle: bool) -> Vec<Matrix> {
    let at: &[[i64; 3]] = if triangle { &[[1, 0, 0], [0, 1, 0], [0, 0, 1]] } else { &QUAD };
    at.iter().map(|c| Matrix::new(3, 1, &c.map(whole))).collect()
}

const QUAD: [[i64; 3]; 4] = [[1, 0, 0], [0, 1, 0], [-1, 1, 1], [0, 0, 1]];

/// The corners of the cells of a layout, in units of the last two numbers.
fn cells(layout: &str) -> Option<(Vec<Vec<[usize; 2]>>, usize, usize)> {
    if layout == "triangle" {
        let corner = |u, v| vec![[u, v], [u + 1, v], [u, v + 1]];
        return Some((vec![corner(0, 0), corner(1, 0), corner(0, 1), vec![[1, 1], [0, 1], [1, 0]]], 2, 2));
    }
    let (columns, rows) = layout.split_once('x')?;
    let size = |text: &str| text.trim().parse().ok().filter(|n| (1..=MAX_PIECES).contains(n));
    let (columns, rows) = (size(columns)?, size(rows)?);
    let cell = |k: usize| {
        let (i, j) = (k % columns, k / columns);
        vec![[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
    };
    Some(((0..columns * rows).map(cell).collect(), columns, rows))
}

/// The affine map that takes the corners of a patch to these.
fn affine(places: &[[usize; 2]], columns: usize, rows: usize) -> Matrix {
    let part = |n: usize, of: usize| ratio(BigInt::from(n), BigInt::from(of));
    let column = |k: usize| {
        let (u, v) = (part(places[k][0], columns), part(places[k][1], rows));
        vec![Q::one() - &u - &v, u, v]
    };
    Matrix::from_rows(3, &[column(0), column(1), column(places.len() - 1)]).transpose()
}

/// The pieces of a face as affine maps of its parameters; `None` where it has no sides, does not shrink in both directions, or
/// they are no symmetries.
fn divided(state: &Node<'_>, pieces: &[Piece], triangle: bool) -> Checked<Option<Vec<Piece>>> {
    let (Some(layout), true) = (state.get("layout"), state.get(side(triangle)).is_some()) else { return Ok(None) };
    let parts = cells(layout.text()?);
    let (cells, columns, rows) = layout.some(parts, "case", "this is no layout of a face")?;
    let fits = cells.len() == pieces.len() && cells.iter().all(|c| c.len() == if triangle { 3 } else { 4 });
    layout.need(fits, "case", "the layout of a face does not fit its pieces or its sides")?;
    let mut maps = Vec::new();
    for ((piece, node), cell) in pieces.iter().zip(state.field("piece")?.list()?).zip(cells) {
        let mut places = cell.clone();
        if let Some(order) = node.get("corners") {
            let named = order.each(|n| index(n, cell.len()))?;
            let all = named.len() == cell.len() && (0..cell.len()).all(|k| named.contains(&k));
            order.need(all, "case", "each corner must be named once")?;
            places = named.iter().map(|&k| cell[k]).collect();
        }
        let opposite = |k: usize| [0, 1].map(|i| places[k][i] + places[k + 2][i]);
        if columns.min(rows) < 2 || (places.len() == 4 && opposite(0) != opposite(1)) {
            return Ok(None);
        }
        maps.push(Piece { target: piece.target, op: affine(&places, columns, rows), reversed: false, share: None });
    }
    Ok(Some(maps))
}

/// A side that a face with sides has.
fn side(triangle: bool) -> &'static str {
    if triangle { "side01" } else { "bottom" }
}

impl Chart {
    /// The chart of a case that starts at a face, where all faces that are reached have their sides and each piece is placed by a
    /// symmetry; `None` where the case has no parameters. Some state that is reached must be a face.
    pub fn read(source: &str, shape: &Shape) -> Checked<Option<Self>> {
        case::states(source, |states| {
            let face = |e: usize| states[e].get("kind").is_some_and(|kind| kind.text() == Ok("face"));
            let surface = shape.states[shape.start].kind == Kind::Set && !states.is_empty();
            need(surface && shape.reachable.iter().any(|&e| face(e)), "surface", "the case is no surface")?;
            let triangle = states[shape.start].get(side(true)).is_some();
            let state = |s: &State| State { kind: s.kind, dim: 3, pieces: Vec::new(), ends: [None, None] };
            let mut maps: Vec<State> = shape.states.iter().map(state).collect();
            for &e in &shape.reachable {
                let pieces = if face(e) { divided(&states[e], &shape.states[e].pieces, triangle)? } else { None };
                let Some(pieces) = pieces else { return Ok(None) };
                maps[e].pieces = pieces;
            }
            Ok(Some(Self { maps: Shape::new(maps, shape.start, Matrix::identity(3)), triangle }))
        })
    }

    /// The corners of a face, in their order.
    pub fn corners(&self) -> Vec<Matrix> {
        corners(self.triangle)
    }

    /// The affine map of a piece.
    pub fn map(&self, face: usize, letter: usize) -> &Matrix {
        &self.maps.states[face].pieces[letter].op
    }

    /// `1/N` and `U^-t`, where a piece is placed by `x ↦ U x / N + p` with a matrix `U` of 0, 1, −1 and determinant ±1.
    pub fn turn(&self, face: usize, letter: usize) -> Checked<(Q, Matrix)> {
        let column = |k: usize| self.map(face, letter).columns(&[k]).minus(&self.map(face, letter).columns(&[0]));
        let linear = column(1).part(1..3, 0..1).beside(&column(2).part(1..3, 0..1));
        let entries = || [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().map(|(i, j)| linear.at(i, j));
        let share = some(entries().map(|x| x.abs()).max(), "every", "a piece without a size")?;
        need(share.is_positive(), "every", "a piece without a size")?;
        let turn = linear.scaled(&share.recip());
        let det = turn.at(0, 0) * turn.at(1, 1) - turn.at(0, 1) * turn.at(1, 0);
        let whole = entries().all(|x| x.is_zero() || x.abs() == share) && det.abs() == Q::one();
        need(whole, "every", "a face is not divided into the same number of parts along every side")?;
        let inverse = some(turn.solve(&Matrix::identity(2))?, "every", "a piece that is no cell")?;
        Ok((share, inverse.transpose()))
    }

    /// Whether a piece of the start lies in its part of a division into columns and rows without a turn.
    pub fn is_plain(&self, letter: usize, columns: usize, rows: usize) -> bool {
        let parts = cells(&format!("{columns}x{rows}"));
        let plain = parts.and_then(|(cells, ..)| Some(affine(cells.get(letter)?, columns, rows)));
        let here = self.maps.states[self.maps.start].pieces.get(letter);
        !self.triangle && here.is_some_and(|piece| plain.as_ref() == Some(&piece.op))
    }

    /// The parameters of an address of a face.
    pub fn locate(&self, face: usize, address: &Address) -> Checked<Matrix> {
        self.maps.point(face, address)
    }

    /// Numbers that are not negative on a patch, and positive inside.
    fn margins(&self, x: &Matrix) -> [Q; 4] {
        let (u, v) = (x.at(1, 0), x.at(2, 0));
        if self.triangle { [x.at(0, 0), Q::one(), u, v] } else { [Q::one() - &u, Q::one() - &v, u, v] }
    }

    /// Whether a parameter lies inside its patch.
    pub fn is_inside(&self, x: &Matrix) -> bool {
        self.margins(x).iter().all(Signed::is_positive)
    }

    /// The vertices of the first subdivision of the start, each once.
    pub fn vertices(&self) -> Checked<Vec<Matrix>> {
        let mut found: Vec<Matrix> = Vec::new();
        for piece in &self.maps.states[self.maps.start].pieces {
            for corner in corners(self.triangle) {
                let vertex = piece.op.times(&corner)?;
                if !found.contains(&vertex) {
                    found.push(vertex);
                }
            }
        }
        Ok(found)
    }

    /// All addresses of a parameter of a face, in their normal form, in the order of their letters.
    pub fn addresses(&self, face: usize, x: &Matrix) -> Checked<Vec<Address>> {
        let (mut found, mut steps) = (Vec::new(), 0);
        let mut open = vec![(vec![(face, x.clone())], Vec::new())];
        while let Some((cells, word)) = open.pop() {
            let (state, here) = &cells[cells.len() - 1];
            steps += 1;
            need(steps <= MAX_STEPS, "limit", "too many cells hold a parameter")?;
            spend(8 * cells.len(), here.bits())?;
            if let Some(k) = cells[..cells.len() - 1].iter().position(|c| (c.0, &c.1) == (*state, here)) {
                let address = Address { prefix: word[..k].to_vec(), cycle: word[k..].to_vec() };
                let normal = address.normalise(&self.maps, face);
                need(normal.is_some(), "limit", "an address of a parameter is too long")?;
                found.extend(normal);
                continue;
            }
            for (letter, piece) in self.maps.states[*state].pieces.iter().enumerate().rev() {
                let local = some(piece.op.solve(here)?, "case", "a piece whose place is no cell")?;
                if self.margins(&local).iter().all(|m| !m.is_negative()) {
                    open.push(([cells.clone(), vec![(piece.target, local)]].concat(), [&word[..], &[letter]].concat()));
                }
            }
        }
        Ok(found)
    }
}
