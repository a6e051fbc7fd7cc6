//! The same shape in other words.

use super::Law;
use crate::arith::{Rational, ratio};
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Frame, Piece, Shape, State};
use oorandom::Rand32;

/// A shape made from another one, and where the points of that one lie in it.
#[derive(Debug, Clone)]
pub struct Image {
    /// The new shape.
    pub shape: Shape,
    /// Takes directions where the old shape is looked at to those where the new one is looked at; `None`: only kinds and
    /// dimensions are comparable.
    pub directions: Option<Matrix>,
    /// Whether parameters run backwards.
    pub backwards: bool,
    letters: Letters,
}

/// How addresses change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Letters {
    Same,
    Backwards,
    Pairs,
    Behind,
}

/// The image of a shape under a law; `None` where the law says nothing about it, or makes too large a shape.
#[must_use]
pub fn image(law: Law, shape: &Shape, seed: u64) -> Option<Image> {
    let mut random = Rand32::new(seed);
    let bare = without_boundaries(shape);
    let same =
        |shape, directions| Image { shape, directions: Some(directions), backwards: false, letters: Letters::Same };
    let seen = Matrix::identity(shape.view().rows());
    match law {
        Law::Conjugated => {
            let frames: Vec<Matrix> = bare.states.iter().map(|s| sheared(s.dim, &mut random)).collect();
            let (shape, directions) = conjugated(&bare, &frames)?;
            Some(same(shape, directions))
        }
        Law::Scaled => scaled(&bare, &mut random).map(|(shape, directions)| same(shape, directions)),
        Law::Reordered => Some(same(reordered(&bare, &mut random), seen)),
        Law::Hidden => {
            let wider = hidden(&bare, &mut random);
            let frames: Vec<Matrix> = wider.states.iter().map(|s| sheared(s.dim, &mut random)).collect();
            let (shape, turned) = conjugated(&wider, &frames)?;
            let n = bare.view().rows();
            let embedding = Matrix::from_fn(turned.cols(), n, |i, j| Rational::from(u8::from(i == j)));
            Some(same(shape, &turned * &embedding))
        }
        Law::Reversed => {
            let shape = backwards(&bare)?;
            Some(Image { shape, directions: Some(seen), backwards: true, letters: Letters::Backwards })
        }
        Law::Words => {
            let shape = words(&bare)?;
            Some(Image { shape, directions: Some(seen), backwards: false, letters: Letters::Pairs })
        }
        Law::Wrapped => {
            let shape = wrapped(&bare);
            Some(Image { shape, directions: Some(seen), backwards: false, letters: Letters::Behind })
        }
        Law::AsSet => {
            let mut set = bare;
            if set.reachable().iter().any(|&e| set.states[e].kind != CellKind::Edge) {
                return None;
            }
            for state in &mut set.states {
                state.kind = CellKind::Set;
                state.pieces.iter_mut().for_each(|p| (p.reversed, p.share) = (false, None));
            }
            Some(same(set, seen))
        }
        Law::Sampled | Law::Certified | Law::Exponents => None,
    }
}

impl Image {
    /// Where the point with an address of the old shape has its address in the new one; `None` where a letter does not exist.
    #[must_use]
    pub fn address(&self, old: &Shape, address: &Address) -> Option<Address> {
        let address = address.normalise(old, old.start).ok()?;
        let changed = match self.letters {
            Letters::Same => address,
            Letters::Behind => Address { prefix: [&[0], address.prefix.as_slice()].concat(), cycle: address.cycle },
            Letters::Backwards => mirrored(old, &address),
            Letters::Pairs => paired(old, &address),
        };
        changed.normalise(&self.shape, self.shape.start).ok()
    }
}

fn mirrored(old: &Shape, address: &Address) -> Address {
    let all = [address.prefix.as_slice(), &address.cycle].concat();
    let states = old.path(old.start, &all);
    let turned: Vec<usize> = all.iter().zip(&states).map(|(&i, &e)| old.states[e].pieces.len() - 1 - i).collect();
    let (prefix, cycle) = turned.split_at(address.prefix.len());
    Address { prefix: prefix.to_vec(), cycle: cycle.to_vec() }
}

fn paired(old: &Shape, address: &Address) -> Address {
    let mut prefix = address.prefix.clone();
    let mut cycle = address.cycle.clone();
    if prefix.len() % 2 == 1 {
        prefix.push(cycle[0]);
        cycle.rotate_left(1);
    }
    if cycle.len() % 2 == 1 {
        cycle = [cycle.as_slice(), &cycle].concat();
    }
    let all = [prefix.as_slice(), &cycle].concat();
    let states = old.path(old.start, &all);
    let pair = |k: usize| {
        let (e, first, second) = (states[2 * k], all[2 * k], all[2 * k + 1]);
        let pieces = &old.states[e].pieces;
        let inner = |i: usize| old.states[pieces[i].target].pieces.len();
        let within = if pieces[first].reversed { inner(first) - 1 - second } else { second };
        (0..first).map(inner).sum::<usize>() + within
    };
    let letters: Vec<usize> = (0..all.len() / 2).map(pair).collect();
    let (prefix, cycle) = letters.split_at(prefix.len() / 2);
    Address { prefix: prefix.to_vec(), cycle: cycle.to_vec() }
}

fn without_boundaries(shape: &Shape) -> Shape {
    let mut bare = shape.clone();
    for state in &mut bare.states {
        state.left = None;
        state.right = None;
    }
    bare
}

/// An invertible matrix with column sums 1.
fn sheared(n: usize, random: &mut Rand32) -> Matrix {
    let mut g = Matrix::identity(n);
    if n < 2 {
        return g;
    }
    for _ in 0..n {
        let (from, into) = (random.rand_range(0..n as u32) as usize, random.rand_range(0..n as u32) as usize);
        let other = (into + 1 + random.rand_range(0..n as u32 - 1) as usize) % n;
        // With `other == from` the determinant would be 1 − c.
        let c = if other == from { ratio(1, 2) } else { ratio(i64::from(random.rand_range(1..4)), 2) };
        for k in 0..n {
            let change = &g[(from, k)] * &c;
            g[(into, k)] += &change;
            g[(other, k)] -= change;
        }
    }
    g
}

/// The shape with `T_i ↦ g_e T_i g_δ⁻¹` and control points that show the same, or none.
fn conjugated(shape: &Shape, frames: &[Matrix]) -> Option<(Shape, Matrix)> {
    let inverses: Vec<Matrix> = frames.iter().map(Matrix::inverse).collect::<Option<_>>()?;
    let mut new = shape.clone();
    new.frame = Frame::Barycentric;
    for (e, state) in new.states.iter_mut().enumerate() {
        for piece in &mut state.pieces {
            piece.op = &(&frames[e] * &piece.op) * &inverses[piece.target];
        }
    }
    let directions = match &shape.control {
        Some(control) => {
            new.control = Some(control * &inverses[shape.start]);
            Matrix::identity(control.rows())
        }
        None => frames[shape.start].clone(),
    };
    Some((new, directions))
}

/// The power of ten with a random exponent between −7 and 7.
fn power_of_ten(random: &mut Rand32) -> Rational {
    let exponent = random.rand_range(0..15) as i64 - 7;
    let size = ratio(10i64.pow(exponent.unsigned_abs() as u32), 1);
    if exponent < 0 { ratio(1, 1) / size } else { size }
}

/// Other units in all coordinates, and in those where the shape is looked at.
fn scaled(shape: &Shape, random: &mut Rand32) -> Option<(Shape, Matrix)> {
    let mut frame = |n: usize| {
        let units: Vec<Rational> = (0..n).map(|_| power_of_ten(random)).collect();
        // Affine coordinates x_1, …, x_{n-1} are multiplied by their units; x_0 keeps the sum.
        Matrix::from_fn(n, n, |i, j| match (i, j) {
            (0, 0) => ratio(1, 1),
            (0, _) => ratio(1, 1) - &units[j],
            _ if i == j => units[i].clone(),
            _ => ratio(0, 1),
        })
    };
    let frames: Vec<Matrix> = shape.states.iter().map(|s| frame(s.dim)).collect();
    let (mut new, turned) = conjugated(shape, &frames)?;
    let Some(control) = &new.control else { return Some((new, turned)) };
    let units: Vec<Rational> = (0..control.rows()).map(|_| power_of_ten(random)).collect();
    let diagonal =
        Matrix::from_fn(units.len(), units.len(), |i, j| if i == j { units[i].clone() } else { ratio(0, 1) });
    new.control = Some(&diagonal * control);
    Some((new, diagonal))
}

fn reordered(shape: &Shape, random: &mut Rand32) -> Shape {
    let n = shape.states.len();
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, random.rand_range(0..i as u32 + 1) as usize);
    }
    // The state `order[k]` becomes the state `k`.
    let mut place = vec![0; n];
    order.iter().enumerate().for_each(|(k, &e)| place[e] = k);
    let states = order
        .iter()
        .enumerate()
        .map(|(k, &e)| {
            let mut state = shape.states[e].clone();
            state.name = format!("s{k}");
            state.pieces.iter_mut().for_each(|p| p.target = place[p.target]);
            state
        })
        .collect();
    Shape { states, start: place[shape.start], ..shape.clone() }
}

fn backwards(shape: &Shape) -> Option<Shape> {
    if shape.reachable().iter().any(|&e| shape.states[e].kind != CellKind::Edge) {
        return None;
    }
    let mut new = shape.clone();
    new.states.iter_mut().for_each(|s| s.pieces.reverse());
    Some(new)
}

/// Pieces of a state above which [`words`] gives up.
const MAX_PIECES: usize = 36;

fn words(shape: &Shape) -> Option<Shape> {
    let mut new = shape.clone();
    let divided = shape.has_shares();
    for (e, state) in shape.states.iter().enumerate() {
        let mut pieces = Vec::new();
        for (first, piece) in state.pieces.iter().enumerate() {
            let mut inner: Vec<Piece> = shape.states[piece.target]
                .pieces
                .iter()
                .enumerate()
                .map(|(second, p)| {
                    let share = shape.states[e].share(first) * shape.states[piece.target].share(second);
                    let (op, reversed) = (&piece.op * &p.op, piece.reversed != p.reversed);
                    Piece { target: p.target, op, reversed, share: divided.then_some(share) }
                })
                .collect();
            if piece.reversed {
                inner.reverse();
            }
            pieces.extend(inner);
        }
        if pieces.len() > MAX_PIECES {
            return None;
        }
        new.states[e].pieces = pieces;
    }
    Some(new)
}

fn wrapped(shape: &Shape) -> Shape {
    let mut new = shape.clone();
    let start = &shape.states[shape.start];
    let piece = Piece { target: shape.start, op: Matrix::identity(start.dim), reversed: false, share: None };
    let name = "in-front".to_owned();
    new.states.push(State { name, kind: start.kind, dim: start.dim, pieces: vec![piece], left: None, right: None });
    new.start = new.states.len() - 1;
    new
}

/// Every space gets one more coordinate, which is 0 on all attractors: `[[T, (1−c) b], [0, c]]`.
fn hidden(shape: &Shape, random: &mut Rand32) -> Shape {
    let mut new = shape.clone();
    new.frame = Frame::Barycentric;
    for state in &mut new.states {
        let n = state.dim;
        for piece in &mut state.pieces {
            let c = ratio(i64::from(random.rand_range(0..3)) - 1, 4);
            let corner = random.rand_range(0..n as u32) as usize;
            let m = piece.op.cols();
            piece.op = Matrix::from_fn(n + 1, m + 1, |i, j| match (i < n, j < m) {
                (true, true) => piece.op[(i, j)].clone(),
                (true, false) if i == corner => ratio(1, 1) - &c,
                (false, false) => c.clone(),
                _ => ratio(0, 1),
            });
        }
        state.dim = n + 1;
    }
    if let Some(control) = &shape.control {
        let wide =
            |i: usize, j: usize| if j < control.cols() { control[(i, j)].clone() } else { ratio(i as i64 + 1, 1) };
        new.control = Some(Matrix::from_fn(control.rows(), control.cols() + 1, wide));
    }
    new
}
