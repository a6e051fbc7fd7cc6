//! Random automata of affine pieces whose ends meet, and random sets of the plane.

use crate::arith::{Rational, ratio};
use crate::linalg::Matrix;
use crate::scheme::{PlaneMap, plane_shape};
use crate::shape::{CellKind, Frame, Piece, Shape, State};
use proptest::prelude::*;
use std::ops::RangeInclusive;

/// What an automaton of [`automaton`] may have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AutomatonOptions {
    /// Number of states.
    pub states: RangeInclusive<usize>,
    /// Pieces of a state, 2 at least.
    pub pieces: RangeInclusive<usize>,
    /// Affine dimension of the space of a state, 2 at least; states of one automaton may differ.
    pub dimensions: RangeInclusive<usize>,
    /// Whether pieces may run backwards.
    pub reversed: bool,
    /// Whether operators may be singular.
    pub singular: bool,
    /// Whether the start state may be one to which no piece returns.
    pub transient: bool,
    /// Whether control points may be given (in 1 to 3 dimensions, so that directions may be lost).
    pub control: bool,
}

impl Default for AutomatonOptions {
    fn default() -> Self {
        Self {
            states: 1..=3,
            pieces: 2..=3,
            dimensions: 2..=3,
            reversed: true,
            singular: true,
            transient: true,
            control: true,
        }
    }
}

/// Small numbers from which a shape is made; zeros, to which they shrink, give the simplest one.
struct Genes<'a>(std::slice::Iter<'a, (i8, u8)>);

impl Genes<'_> {
    fn pick(&mut self, count: usize) -> usize {
        self.0.next().map_or(0, |(a, _)| a.unsigned_abs() as usize % count.max(1))
    }

    fn within(&mut self, range: &RangeInclusive<usize>) -> usize {
        range.start() + self.pick(range.end() - range.start() + 1)
    }

    /// A number of modulus at most 1 with a short denominator.
    fn number(&mut self) -> Rational {
        self.0.next().map_or(ratio(0, 1), |(a, q)| {
            let q = i64::from(q % 8) + 1;
            ratio(i64::from(*a) % (q + 1), q)
        })
    }
}

/// Curves as automata: every state has a polygon from `0` to `e_1`, its pieces are affine images of the curves of states that
/// take their ends to neighbouring corners, so that the pieces meet. With a probability that depends on the corners the
/// system contracts; otherwise [`crate::theorem::certify`] refuses or does not decide it.
///
/// With control points the shape is seen through a random map, which may lose directions; without, it is in barycentric space.
pub fn automaton(options: AutomatonOptions) -> impl Strategy<Value = Shape> {
    prop::collection::vec((any::<i8>(), any::<u8>()), 160).prop_map(move |genes| {
        let mut genes = Genes(genes.iter());
        build(&options, &mut genes)
    })
}

fn build(options: &AutomatonOptions, genes: &mut Genes) -> Shape {
    let count = genes.within(&options.states);
    let transient = options.transient && count > 1 && genes.pick(2) == 1;
    let dims: Vec<usize> = (0..count).map(|_| genes.within(&options.dimensions)).collect();
    let states: Vec<State> = (0..count)
        .map(|e| {
            let pieces = genes.within(&options.pieces).max(2);
            let corners = polygon(dims[e], pieces, genes);
            let pieces = corners
                .windows(2)
                .map(|side| {
                    let target = if transient { 1 + genes.pick(count - 1) } else { genes.pick(count) };
                    let reversed = options.reversed && genes.pick(4) == 3;
                    let (from, to) = if reversed { (&side[1], &side[0]) } else { (&side[0], &side[1]) };
                    let flat = options.singular && genes.pick(5) == 4;
                    let op = operator(from, to, dims[target], flat, genes);
                    Piece { target, op, reversed, share: None }
                })
                .collect();
            let name = format!("s{e}");
            State { name, kind: CellKind::Edge, dim: dims[e] + 1, pieces, left: None, right: None }
        })
        .collect();
    let columns = states[0].dim;
    let control = (options.control && genes.pick(2) == 1).then(|| {
        let rows = 1 + genes.pick(3);
        Matrix::from_fn(rows, columns, |_, _| ratio(genes.pick(9) as i64 - 4, 1))
    });
    Shape { states, start: 0, control, frame: Frame::Barycentric }
}

/// Corners `0 = p_0, …, p_N = e_1` of a polygon near the evenly divided segment.
fn polygon(dim: usize, pieces: usize, genes: &mut Genes) -> Vec<Vec<Rational>> {
    (0..=pieces)
        .map(|k| {
            let even = ratio(k as i64, pieces as i64);
            let inside = k > 0 && k < pieces;
            (0..dim)
                .map(|i| {
                    let base = if i == 0 { even.clone() } else { ratio(0, 1) };
                    if inside { base + genes.number() * ratio(1, if i == 0 { 8 } else { 3 }) } else { base }
                })
                .collect()
        })
        .collect()
}

/// The operator on simplices of the affine map that takes `0` and `e_1` to two points and the other unit vectors to short
/// ones (to `0` where it is `flat`).
fn operator(from: &[Rational], to: &[Rational], source: usize, flat: bool, genes: &mut Genes) -> Matrix {
    let mut columns = vec![from.to_vec(), to.to_vec()];
    for _ in 1..source {
        let shift: Vec<Rational> =
            from.iter().map(|_| if flat { ratio(0, 1) } else { genes.number() * ratio(1, 2) }).collect();
        columns.push(from.iter().zip(&shift).map(|(a, b)| a + b).collect());
    }
    let barycentric: Vec<Vec<Rational>> = columns
        .into_iter()
        .map(|x| {
            let sum = x.iter().fold(ratio(0, 1), |s, v| s + v);
            std::iter::once(ratio(1, 1) - sum).chain(x).collect()
        })
        .collect();
    Matrix::from_columns(from.len() + 1, &barycentric)
}

/// Sets of the plane of 2 to 4 affine maps; some are seen through a projection to a line, some have a singular map.
///
/// # Panics
/// Never: the maps have the form that [`plane_shape`] asks for.
pub fn plane_set() -> impl Strategy<Value = Shape> {
    prop::collection::vec((any::<i8>(), any::<u8>()), 40).prop_filter_map("no set", |genes| {
        let mut genes = Genes(genes.iter());
        let count = 2 + genes.pick(3);
        let maps: Vec<PlaneMap> = (0..count)
            .map(|_| {
                let mut entry = || genes.number() * ratio(2, 3);
                let linear = [[entry(), entry()], [entry(), entry()]];
                PlaneMap { linear, shift: [genes.number(), genes.number()], reversed: false }
            })
            .collect();
        let mut shape = plane_shape(CellKind::Set, &maps).ok()?;
        if genes.pick(3) == 2 {
            let rows = 1 + genes.pick(2);
            let projection = Matrix::from_fn(rows, 2, |_, _| ratio(genes.pick(5) as i64 - 2, 1));
            shape.control = shape.control.map(|control| &projection * &control);
            shape.frame = Frame::Barycentric;
        }
        Some(shape)
    })
}
