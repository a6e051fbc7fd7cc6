//! The parameters of a patch: which cells hold a parameter, and by which addresses (docs/certificate.md, section 8.1).

use crate::base::{Checked, MAX_PIECES, Matrix, Node, Q, index, need, number::ratio, some, spend, whole};
use crate::curve::{Address, Kind, Piece, Shape, State, case};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Cells that may be visited in search of the addresses of a parameter.
const MAX_STEPS: usize = 20_000;

/// The faces of a case as divisions of a square or a triangle, even ones or in the shares of the sides. A parameter `(u, v)` is the column `1 − u − v, u, v`, and the
/// operator of a piece is the affine map that puts the parameters of its face where the piece lies.
pub struct Chart {
    maps: Shape,
    triangle: bool,
    patch: bool,
}

/// The corners of a square or a triangle as parameters, in their order.
fn corners(triangle: bool) -> Vec<Matrix> {
    let at: &[[i64; 3]] = if triangle { &[[1, 0, 0], [0, 1, 0], [0, 0, 1]] } else { &QUAD };
    at.iter().map(|c| Matrix::new(3, 1, &c.map(whole))).collect()
}

const QUAD: [[i64; 3]; 4] = [[1, 0, 0], [0, 1, 0], [-1, 1, 1], [0, 0, 1]];

/// The corners of the cells of a layout, by the numbers of the cuts along both sides, and how many parts these have.
fn cells(layout: &str) -> Option<(Vec<Vec<[usize; 2]>>, [usize; 2])> {
    if layout == "triangle" {
        let corner = |u, v| vec![[u, v], [u + 1, v], [u, v + 1]];
        return Some((vec![corner(0, 0), corner(1, 0), corner(0, 1), vec![[1, 1], [0, 1], [1, 0]]], [2, 2]));
    }
    let (columns, rows) = layout.split_once('x')?;
    let size = |text: &str| text.trim().parse().ok().filter(|n| (1..=MAX_PIECES).contains(n));
    let (columns, rows) = (size(columns)?, size(rows)?);
    let cell = |k: usize| {
        let (i, j) = (k % columns, k / columns);
        vec![[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
    };
    Some(((0..columns * rows).map(cell).collect(), [columns, rows]))
}

/// The affine map that takes the corners of a patch to these.
fn affine(places: &[[usize; 2]], cuts: &[Vec<Q>; 2]) -> Matrix {
    let column = |k: usize| {
        let (u, v) = (cuts[0][places[k][0]].clone(), cuts[1][places[k][1]].clone());
        vec![Q::one() - &u - &v, u, v]
    };
    Matrix::from_rows(3, &[column(0), column(1), column(places.len() - 1)]).transpose()
}

/// The ends of so many equal parts.
fn even(parts: usize) -> Vec<Q> {
    (0..=parts).map(|n| ratio(BigInt::from(n), BigInt::from(parts))).collect()
}

/// Where the sides of a face are cut, and whether by shares: as its sides are divided, by the shares of their pieces, which have to be
/// the same on opposite sides; `None` where they are not, or a triangle has shares.
fn cuts(
    state: &Node<'_>,
    parts: [usize; 2],
    triangle: bool,
    edge: &dyn Fn(&str) -> Option<usize>,
    shape: &Shape,
) -> Checked<Option<([Vec<Q>; 2], bool)>> {
    let keys = if triangle { "side01 side12 side02" } else { "bottom right top left" };
    let (mut sides, mut own) = (Vec::new(), false);
    for (k, key) in keys.split(' ').enumerate() {
        let name = state.field(key)?.field("edge")?;
        let pieces = &shape.states[name.some(edge(name.text()?), "case", "there is no state of this name")?].pieces;
        if pieces.iter().all(|p| p.share.is_none()) {
            sides.push(even(parts[k % 2]));
            continue;
        }
        own = true;
        let mut ends = vec![Q::zero()];
        for piece in pieces {
            let share = name.some(piece.share.clone(), "case", "a piece without a share")?;
            ends.push(&ends[ends.len() - 1] + share);
        }
        sides.push(ends);
    }
    if triangle {
        return Ok((!own).then(|| ([even(2), even(2)], false)));
    }
    let fits = sides[0] == sides[2] && sides[1] == sides[3] && (0..2).all(|k| sides[k].len() == parts[k] + 1);
    Ok(fits.then(|| ([sides[0].clone(), sides[1].clone()], own)))
}

/// The pieces of a face as affine maps of its parameters, whether it is divided by shares, and whether a piece is turned; `None` where
/// it has no sides, does not shrink in both directions, or they are no symmetries.
fn divided(
    state: &Node<'_>,
    pieces: &[Piece],
    triangle: bool,
    edge: &dyn Fn(&str) -> Option<usize>,
    shape: &Shape,
) -> Checked<Option<(Vec<Piece>, bool, bool)>> {
    let (Some(layout), true) = (state.get("layout"), state.get(side(triangle)).is_some()) else { return Ok(None) };
    let parts = cells(layout.text()?);
    let (cells, parts) = layout.some(parts, "case", "this is no layout of a face")?;
    let fits = cells.len() == pieces.len() && cells.iter().all(|c| c.len() == if triangle { 3 } else { 4 });
    layout.need(fits, "case", "the layout of a face does not fit its pieces or its sides")?;
    let Some((cuts, own)) = cuts(state, parts, triangle, edge, shape)? else { return Ok(None) };
    let (mut maps, mut turned) = (Vec::new(), false);
    for ((piece, node), cell) in pieces.iter().zip(state.field("piece")?.list()?).zip(cells) {
        let mut places = cell.clone();
        if let Some(order) = node.get("corners") {
            let named = order.each(|n| index(n, cell.len()))?;
            let all = named.len() == cell.len() && (0..cell.len()).all(|k| named.contains(&k));
            order.need(all, "case", "each corner must be named once")?;
            places = named.iter().map(|&k| cell[k]).collect();
        }
        turned |= places != cell;
        let opposite = |k: usize| [0, 1].map(|i| places[k][i] + places[k + 2][i]);
        if parts.contains(&1) || (places.len() == 4 && opposite(0) != opposite(1)) {
            return Ok(None);
        }
        maps.push(Piece { target: piece.target, op: affine(&places, &cuts), reversed: false, share: None });
    }
    Ok(Some((maps, own, turned)))
}

/// A side that a face with sides has.
fn side(triangle: bool) -> &'static str {
    if triangle { "side01" } else { "bottom" }
}

impl Chart {
    /// The chart of a case that starts at a face, or at a set of faces to which nothing leads back, where all faces that are reached have
    /// their sides and each piece is placed by a symmetry; `None` where the case has no parameters. Some state that is reached must be a
    /// face. The pieces of a set have no place: each face has parameters of its own.
    pub fn read(source: &str, shape: &Shape) -> Checked<Option<Self>> {
        case::states(source, |states| {
            let face = |e: usize| states[e].get("kind").is_some_and(|kind| kind.text() == Ok("face"));
            let surface = shape.states[shape.start].kind == Kind::Set && !states.is_empty();
            need(surface && shape.reachable.iter().any(|&e| face(e)), "surface", "the case is no surface")?;
            let patch = face(shape.start);
            let first =
                if patch { Some(shape.start) } else { shape.states[shape.start].pieces.first().map(|p| p.target) };
            let triangle = first.is_some_and(|e| states[e].get(side(true)).is_some());
            let state = |s: &State| State { kind: s.kind, dim: 3, pieces: Vec::new(), ends: [None, None] };
            let mut maps: Vec<State> = shape.states.iter().map(state).collect();
            let named = |name: &str| states.iter().position(|s| s.get("name").is_some_and(|n| n.text() == Ok(name)));
            let (mut by_shares, mut any_turned) = (false, false);
            for &e in &shape.reachable {
                let pieces = &shape.states[e].pieces;
                if e == shape.start && !patch && pieces.iter().all(|p| face(p.target)) {
                    let own =
                        |p: &Piece| Piece { target: p.target, op: Matrix::identity(3), reversed: false, share: None };
                    maps[e].pieces = pieces.iter().map(own).collect();
                    continue;
                }
                let found = if face(e) { divided(&states[e], pieces, triangle, &named, shape)? } else { None };
                let Some((pieces, own, turned)) = found else { return Ok(None) };
                maps[e].pieces = pieces;
                (by_shares, any_turned) = (by_shares || own, any_turned || turned);
            }
            if by_shares && any_turned {
                return Ok(None);
            }
            Ok(Some(Self { maps: Shape::new(maps, shape.start, Matrix::identity(3)), triangle, patch }))
        })
    }

    /// Whether the case starts at a face.
    pub fn is_patch(&self) -> bool {
        self.patch
    }

    /// The corners of a face, in their order.
    pub fn corners(&self) -> Vec<Matrix> {
        corners(self.triangle)
    }

    /// The affine map of a piece.
    pub fn map(&self, face: usize, letter: usize) -> &Matrix {
        &self.maps.states[face].pieces[letter].op
    }

    /// The linear part of the map of a piece.
    pub fn linear(&self, face: usize, letter: usize) -> Matrix {
        let column = |k: usize| self.map(face, letter).columns(&[k]).minus(&self.map(face, letter).columns(&[0]));
        column(1).part(1..3, 0..1).beside(&column(2).part(1..3, 0..1))
    }

    /// `1/N`, where every piece from which its state can be reached again is placed by `x ↦ U x / N + p` with a matrix `U` of 0, 1, −1
    /// and determinant ±1.
    pub fn share(&self) -> Checked<Q> {
        let mut share: Option<Q> = None;
        let letters = |&e: &usize| self.maps.states[e].pieces.iter().enumerate().map(move |(i, p)| (e, i, p.target));
        for (e, letter, target) in self.maps.reachable.iter().flat_map(letters) {
            if !self.maps.below(target).contains(&e) {
                continue;
            }
            let linear = self.linear(e, letter);
            let entries = || [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().map(|(i, j)| linear.at(i, j).abs());
            let size = some(entries().max(), "every", "a piece without a size")?;
            let det = (linear.at(0, 0) * linear.at(1, 1) - linear.at(0, 1) * linear.at(1, 0)).abs();
            let whole = size.is_positive() && entries().all(|x| x.is_zero() || x == size) && det == &size * &size;
            let one = share.as_ref().is_none_or(|s| *s == size);
            need(
                whole && one && size < Q::one(),
                "every",
                "the pieces that lead back to their face are not of one size",
            )?;
            share = Some(size);
        }
        some(share, "every", "no face leads back to itself")
    }

    /// Whether a piece of the start lies in its part of a division into columns and rows without a turn.
    pub fn is_plain(&self, letter: usize, columns: usize, rows: usize) -> bool {
        let pieces = &self.maps.states[self.maps.start].pieces;
        if self.triangle || pieces.len() != columns * rows || letter >= pieces.len() {
            return false;
        }
        // It begins where the ones before it end, in both directions.
        let corner = |k: usize, c: usize| pieces[k].op.times(&corners(false)[c]);
        let (i, j) = (letter % columns, letter / columns);
        let zero = corners(false)[0].clone();
        let before = if i == 0 { Ok(None) } else { corner(letter - 1, 1).map(Some) };
        let below = if j == 0 { Ok(None) } else { corner(letter - columns, 3).map(Some) };
        let (Ok(here), Ok(before), Ok(below)) = (corner(letter, 0), before, below) else { return false };
        let fits = before.is_none_or(|x| x == here) && below.is_none_or(|x| x == here);
        let linear = self.linear(self.maps.start, letter);
        let straight = linear.at(0, 1).is_zero() && linear.at(1, 0).is_zero();
        let forwards = linear.at(0, 0).is_positive() && linear.at(1, 1).is_positive();
        fits && straight && forwards && (letter > 0 || here == zero)
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
