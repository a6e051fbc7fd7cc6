//! Orders of smoothness of a curve in the uniform parameter: joint spectral radii on a descending chain of invariant spaces, and
//! the joint equation of every order (theory §11).

use crate::base::{Accepted, Checked, Matrix, Node, Q, Verdict, list, need, some, whole};
use crate::claim::Claim;
use crate::curve::{Case, End, Kind, Model, Shape, Way, close};
use crate::jsr::{System, bounds};
use num_traits::{One, Zero};

/// Most orders of one certificate.
const MAX_ORDERS: usize = 32;

/// The derivatives of one order.
struct Level<'a> {
    shape: &'a Shape,
    /// `N`, the number of pieces of every state.
    pieces: usize,
    /// `N^order`.
    scale: Q,
    /// By state: the differences of the derivatives of this order as rows in echelon form.
    families: Vec<Matrix>,
    /// By state: the derivatives at the start and the finish.
    ends: Vec<[Matrix; 2]>,
}

/// Checks the proof of a certificate of the kind `regularity`.
pub fn check(case: &Case, node: &Node<'_>) -> Checked<Accepted> {
    let [contraction, orders] = node.fields("contraction orders")?;
    let model = Model::read(&case.shape, &contraction)?;
    contraction.at(case.shape.check_curves())?;
    let mut level = node.at(Level::first(&model))?;
    // Orders and radii are those of the curve in barycentric space; a view that folds it may do anything.
    let start = model.spaces.of(case.shape.start)?;
    let seen = case.shape.view.times(&start.basis)?.rank()? == start.basis.cols;
    let (items, mut claims, mut lines) = (orders.list()?, Vec::new(), Vec::new());
    orders.need((1..=MAX_ORDERS).contains(&items.len()), "orders", "orders from 0 on are needed")?;
    for (k, item) in items.iter().enumerate() {
        let [order, dims, radius, joints] = item.fields("order dims radius joints")?;
        order.need(order.index(MAX_ORDERS)? == k, "orders", "the orders come one after the other")?;
        if k > 0 {
            level = item.at(level.next())?;
        }
        let found: Vec<usize> = case.shape.reachable.iter().map(|&e| level.families[e].rows).collect();
        dims.need(dims.indices(usize::MAX)? == found, "orders", format_args!("the dimensions are {}", list(&found)))?;
        let (low, high) = level.radius(&radius)?;
        lines.push(Claim::RadiusOfOrder(k, low, high.clone()).is(Verdict::Proved));
        let joined = if k == 0 {
            "none"
        } else {
            radius.need(&high * &level.scale < Q::one(), "orders", "the radius is not below N to the power -k")?;
            level.ends = item.at(level.limits(k))?;
            if level.joined()? { "holds" } else { "fails" }
        };
        joints.follows("orders", joined)?;
        let last = found.iter().all(|d| *d == 0) || joined == "fails";
        orders.need(!last || k + 1 == items.len(), "orders", "there is nothing after this order")?;
        let smooth = if joined == "fails" { Verdict::Refuted } else { Verdict::Proved };
        claims.push(Claim::Smooth { order: k, projected: !seen }.is(smooth));
    }
    Ok(Accepted { case: case.name.clone(), verdict: Verdict::Proved, claims, points: lines })
}

impl<'a> Level<'a> {
    /// The curve itself: every reachable state is an edge of the same number of pieces, none of them reversed.
    fn first(model: &'a Model<'a>) -> Checked<Self> {
        let shape = model.shape;
        let pieces = shape.states[shape.start].pieces.len();
        let uniform = shape.reachable.iter().all(|&e| {
            let state = &shape.states[e];
            state.kind == Kind::Edge && state.pieces.len() == pieces && state.pieces.iter().all(|p| !p.reversed)
        });
        need(uniform && pieces >= 2, "orders", "a curve of one number of pieces, none reversed, is needed")?;
        let mut families = shape.no_rows();
        let mut ends: Vec<[Matrix; 2]> = shape.states.iter().map(|s| [0, 1].map(|_| Matrix::zeros(s.dim, 0))).collect();
        for &e in &shape.reachable {
            families[e] = model.spaces.of(e)?.basis.transpose();
            ends[e] = [shape.end_point(e, End::Start)?, shape.end_point(e, End::Finish)?];
        }
        need(families[shape.start].rows > 0, "orders", "the curve is a point")?;
        Ok(Self { shape, pieces, scale: Q::one(), families, ends })
    }

    /// Bounds of the joint spectral radius of the operators on the families; 0 where these are 0.
    fn radius(&self, node: &Node<'_>) -> Checked<(Q, Q)> {
        if node.is_null() {
            node.need(self.families.iter().all(|f| f.rows == 0), "orders", "bounds of a radius are needed here")?;
            return Ok((Q::zero(), Q::zero()));
        }
        let place = |e: usize| {
            let known = self.shape.reachable.iter().position(|r| *r == e);
            some(known, "orders", "a state that cannot be reached")
        };
        let mut arrows = Vec::new();
        for (e, piece) in self.shape.pieces() {
            let pivots = self.families[e].echelon()?.1;
            let images = self.families[piece.target].times(&piece.op.transpose())?;
            let matrix = images.columns(&pivots);
            let closed = matrix.times(&self.families[e])? == images;
            need(closed, "orders", "an operator does not act on the differences")?;
            arrows.push((place(e)?, place(piece.target)?, matrix.transpose()));
        }
        let dims = self.shape.reachable.iter().map(|&e| self.families[e].rows).collect();
        let found = bounds(&System { name: String::new(), dims, arrows }, node)?;
        Ok((found.lower, found.upper))
    }

    /// The differences of the next derivative: the smallest families with `N^k T_i c_δ − c_e ∈ F_e`, `T_i F_δ ⊂ F_e`, which must
    /// have codimension 1. Its values at the ends are not computed yet: the ends are still those of the derivative before.
    fn next(self) -> Checked<Self> {
        let scale = &self.scale * whole(self.pieces as i64);
        let mut families = self.shape.no_rows();
        for (e, piece) in self.shape.pieces() {
            let image = piece.op.times(&self.chord(piece.target))?.scaled(&scale);
            families[e] = families[e].stack(&image.minus(&self.chord(e)).transpose());
        }
        let families = close(self.shape, families, Way::Up, |_, p, span| span.times(&p.op.transpose()))?;
        let lower = self.shape.reachable.iter().all(|&e| families[e].rows + 1 == self.families[e].rows);
        need(lower, "orders", "the differences of the next derivative do not have codimension 1")?;
        Ok(Self { scale, families, ..self })
    }

    fn chord(&self, e: usize) -> Matrix {
        self.ends[e][1].minus(&self.ends[e][0])
    }

    /// The values at the ends of the derivative of order `k`.
    fn limits(&self, k: usize) -> Checked<Vec<[Matrix; 2]>> {
        let mut ends = self.ends.clone();
        for &e in &self.shape.reachable {
            ends[e] = [self.limit(e, End::Start, k)?, self.limit(e, End::Finish, k)?];
        }
        Ok(ends)
    }

    /// Along the address of an end `N^k T c` tends to the fixed vector of the scaled cycle in `c + F`, which is unique because the
    /// radius on `F` is below `N^-k`.
    fn limit(&self, e: usize, end: End, k: usize) -> Checked<Matrix> {
        let address = some(self.shape.end_address(e, end, &|_, _| false), "orders", "a state without pieces")?;
        // The scale is `N^k` for each letter.
        let power = |letters: usize| num_traits::pow(whole(self.pieces as i64), k * letters);
        let (prefix, home) = self.shape.product(e, &address.prefix)?;
        let (cycle, _) = self.shape.product(home, &address.cycle)?;
        let shifted = cycle.scaled(&power(address.cycle.len())).minus(&Matrix::identity(cycle.rows));
        let (chord, family) = (self.chord(home), self.families[home].transpose());
        // c + F y is fixed.
        let y = shifted.times(&family)?.solve(&shifted.times(&chord.scaled(&-Q::one()))?)?;
        let y = some(y, "orders", "the derivative at an end is not unique")?;
        let fixed = family.times(&y)?.plus(&Q::one(), &chord);
        prefix.scaled(&power(address.prefix.len())).times(&fixed)
    }

    /// The joint equation: at the first-level joints of all states the derivatives of the two sides agree.
    fn joined(&self) -> Checked<bool> {
        let mut joined = true;
        for &e in &self.shape.reachable {
            for pair in self.shape.states[e].pieces.windows(2) {
                let left = pair[0].op.times(&self.ends[pair[0].target][1])?;
                joined &= left == pair[1].op.times(&self.ends[pair[1].target][0])?;
            }
        }
        Ok(joined)
    }
}
