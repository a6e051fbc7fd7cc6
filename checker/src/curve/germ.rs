//! The germ of one branch `u w^ω`: its visible quotient `Y = V/N_G`, the map `L` on it, and its ring (theory §3, §9).

use super::{Address, Kind, Model};
use crate::base::{Checked, Matrix, Whole, need};
use num_bigint::BigInt;

/// A piece of the ring that the germ sees.
#[derive(Debug, Clone)]
pub struct RingPiece<T = BigInt> {
    /// The word that leaves the cycle with its last letter.
    pub word: Vec<usize>,
    /// The state where it ends.
    pub end: usize,
    /// Its operator.
    pub op: Matrix<T>,
    /// `-1` where it lies before the germ's point in the order of the germ's state, `1` after it, `0` where there is no order.
    pub side: i32,
}

/// Where addresses are read and what is looked at: the start state with its view, or a state with its own visible quotient.
pub struct Root<T = BigInt> {
    /// The state.
    pub state: usize,
    /// The map from its coordinates into the space where the shape is looked at.
    pub view: Matrix<T>,
}

/// A germ with everything that is computed for it.
pub struct Germ<T = BigInt> {
    /// The state of the cycle.
    pub state: usize,
    /// The orientation of the prefix.
    pub prefix_sign: i32,
    /// The orientation of the cycle, `1` where the state is no curve.
    pub turn: i32,
    /// The fixed point `q` of the cycle.
    pub fixed: Matrix<T>,
    /// Coordinates on `Y`: those of a point `x` are `chart (x − q)`.
    pub chart: Matrix<T>,
    /// `L` on `Y`.
    pub linear: Matrix<T>,
    /// `G` on `Y`.
    pub view: Matrix<T>,
    /// The pieces of the ring that are neither repeated nor the point itself and do not collapse.
    pub ring: Vec<RingPiece<T>>,
    /// Whether a piece was left out because it collapses.
    pub collapses: bool,
}

impl<T: Whole> Germ<T> {
    /// Computes the germ of a branch.
    pub fn new(model: &Model<'_, T>, root: &Root<T>, address: &Address) -> Checked<Self> {
        let shape = model.shape;
        let (prefix, state) = shape.product(root.state, &address.prefix)?;
        let (cycle, fixed) = shape.cycle(state, &address.cycle)?;
        let space = model.spaces.of(state)?;
        let view_on_v = root.view.times(&prefix)?.times(&space.basis)?;
        let linear_v = model.spaces.linear(&cycle, state, state)?;
        // The kernel of these rows is N_G.
        let (rows, pivots) = view_on_v.hull(&linear_v)?;
        need(!pivots.is_empty(), "germ", "the germ is a single point")?;
        let chart = rows.times(&space.reading)?;
        let linear = rows.times(&linear_v.columns(&pivots))?;
        let view = view_on_v.columns(&pivots);
        let ordered = shape.states[state].kind == Kind::Edge;
        let turn = if ordered { shape.orientation(state, &address.cycle)? } else { 1 };
        let prefix_sign = shape.orientation(root.state, &address.prefix)?;
        let mut germ =
            Self { state, prefix_sign, turn, fixed, chart, linear, view, ring: Vec::new(), collapses: false };
        (germ.ring, germ.collapses) = germ.ring_of(model, &address.cycle)?;
        Ok(germ)
    }

    /// The dimension of `Y`.
    pub fn dim(&self) -> usize {
        self.linear.rows
    }

    /// The coordinates of a point of the attractor of the germ's state.
    pub fn coordinates(&self, point: &Matrix<T>) -> Checked<Matrix<T>> {
        self.chart.times(&point.minus(&self.fixed))
    }

    /// The standard ring of the cycle without repeated pieces of sets, copies of `q`, and pieces that collapse (Lemma 2); whether
    /// there are such.
    fn ring_of(&self, model: &Model<'_, T>, cycle: &[usize]) -> Checked<(Vec<RingPiece<T>>, bool)> {
        let falls = self.linear.power(self.dim())?.times(&self.chart)?;
        let (mut kept, mut some_collapse): (Vec<RingPiece<T>>, bool) = (Vec::new(), false);
        let mut product = Matrix::identity(model.shape.states[self.state].dim);
        let (mut at, mut forward) = (self.state, true);
        for (i, &turn) in cycle.iter().enumerate() {
            let state = &model.shape.states[at];
            let mut level: Vec<(usize, Matrix<T>)> = Vec::new();
            let (ordered, cycled) = (state.kind == Kind::Edge, &state.pieces[turn]);
            for (letter, piece) in state.pieces.iter().enumerate().filter(|(j, _)| *j != turn) {
                let op = product.times(&piece.op)?;
                let after = if (letter < turn) == forward { -1 } else { 1 };
                let side = if ordered { after } else { 0 };
                let as_cycle = cycled.target == piece.target && cycled.op == piece.op;
                let repeated = !ordered && (as_cycle || level.contains(&(piece.target, op.clone())));
                let space = model.spaces.of(piece.target)?;
                let image = op.times(&space.base)?;
                if repeated || model.spaces.is_point(at, letter)? && image == self.fixed {
                    continue;
                }
                let collapses = falls.times(&image.minus(&self.fixed))?.is_zero()
                    && falls.times(&op)?.times(&space.basis)?.is_zero();
                some_collapse |= collapses;
                if !collapses {
                    let word = [&cycle[..i], &[letter]].concat();
                    kept.push(RingPiece { word, end: piece.target, op: op.clone(), side });
                }
                level.push((piece.target, op));
            }
            product = product.times(&cycled.op)?;
            forward ^= cycled.reversed;
            at = cycled.target;
        }
        Ok((kept, some_collapse))
    }
}
