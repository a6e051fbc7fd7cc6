//! The relevant space `V_e` of every state, and what of it can be seen from the start state (theory §3, §9).

use super::{Address, Shape, fixed_point};
use crate::arith::Rational;
use crate::linalg::{Entry, Matrix, closures};

/// The span of the differences of the attractor of one state.
#[derive(Debug, Clone)]
pub struct StateSpace<E = Rational> {
    /// A point of the attractor with coordinates in the field of the entries.
    pub base: Vec<E>,
    /// Its address.
    pub base_address: Address,
    /// A basis of `V_e = span(A_e − A_e)`, as columns (`dim(e) x dim V_e`).
    pub basis: Matrix<E>,
    /// A left inverse of `basis`: coordinates in `V_e` (`dim V_e x dim(e)`).
    pub coordinates: Matrix<E>,
    /// Rows on `V_e` whose common kernel is the largest family that stays in the kernel of the control points
    /// (or, without control points, of the paths from the start); as many rows as that quotient has dimensions.
    pub visible: Matrix<E>,
    /// Points of the attractor with short addresses, see [`Shape::landmarks`].
    pub landmarks: Vec<(Address, Vec<E>)>,
}

/// The relevant spaces of all reachable states; `None` for the others.
#[derive(Debug, Clone)]
pub struct Spaces<E = Rational>(Vec<Option<StateSpace<E>>>);

impl<E: Entry> Spaces<E> {
    /// The space of a reachable state.
    ///
    /// # Panics
    /// If the state is not reachable from the start.
    #[must_use]
    pub fn of(&self, state: usize) -> &StateSpace<E> {
        self.0[state].as_ref().expect("a reachable state")
    }

    /// Computes base points, `V_e` by closure, and the visible quotients.
    ///
    /// Returns `None` where a base point is not unique, which only happens when the system does not contract.
    ///
    /// # Cost
    /// At most `Σ dim(e)` rounds of one product per transition each.
    #[must_use]
    pub fn new(shape: &Shape<E>) -> Option<Self> {
        let reachable = shape.reachable();
        let mut base = vec![None; shape.states.len()];
        for &e in &reachable {
            base[e] = Some(base_point(shape, e)?);
        }
        let spans = close_spans(shape, &reachable, &base);
        let rows = close_rows(shape, &reachable);
        let mut spaces = vec![None; shape.states.len()];
        for &e in &reachable {
            let (base_address, point) = base[e].clone()?;
            let basis = spans[e].transpose();
            let coordinates = left_inverse(&basis);
            let visible = (&rows[e] * &basis).echelon().rows;
            let landmarks =
                shape.landmarks(e).into_iter().filter_map(|a| Some((a.clone(), shape.point(e, &a)?))).collect();
            spaces[e] = Some(StateSpace { base: point, base_address, basis, coordinates, visible, landmarks });
        }
        Some(Self(spaces))
    }

    /// The linear part of `op : X_from -> X_to` in the bases of `V`: `op * basis(from) = basis(to) * result`.
    #[must_use]
    pub fn linear(&self, op: &Matrix<E>, to: usize, from: usize) -> Matrix<E> {
        &self.of(to).coordinates * &(op * &self.of(from).basis)
    }

    /// The coordinates of a vector of `V_state` in the visible quotient `W_state`.
    #[must_use]
    pub fn in_visible(&self, state: usize, v: &[E]) -> Vec<E> {
        let space = self.of(state);
        space.visible.apply(&space.coordinates.apply(v))
    }

    /// The same of any vector; `None` where it does not lie in `V_state`.
    #[must_use]
    pub fn in_visible_if_relevant(&self, state: usize, v: &[E]) -> Option<Vec<E>> {
        let space = self.of(state);
        let coordinates = space.coordinates.apply(v);
        let inside = space.basis.apply(&coordinates).iter().zip(v).all(|(a, b)| a == b);
        inside.then(|| space.visible.apply(&coordinates))
    }

    /// The map `W_from -> W_to` of visible quotients (theory §9) that `op : X_from -> X_to` induces; `None` where it induces
    /// none, which happens for no piece of a shape.
    #[must_use]
    pub fn on_visible(&self, op: &Matrix<E>, to: usize, from: usize) -> Option<Matrix<E>> {
        let onto = &self.of(to).visible * &self.linear(op, to, from);
        // The rows of `onto` are combinations of the echelon rows of `from`, with the coefficients in their leading columns.
        let target = self.of(from).visible.echelon();
        let map = Matrix::from_fn(onto.rows(), target.pivots.len(), |i, j| onto[(i, target.pivots[j])].clone());
        (&map * &target.rows == onto).then_some(map)
    }
}

/// Reads letter 0 from every state until a state repeats.
fn base_point<E: Entry>(shape: &Shape<E>, start: usize) -> Option<(Address, Vec<E>)> {
    let address = Address::periodic(vec![0]).normalise(shape, start).ok()?;
    let (prefix, state) = shape.product(start, &address.prefix);
    let (cycle, _) = shape.product(state, &address.cycle);
    let point = prefix.apply(&fixed_point(&cycle)?);
    Some((address, point))
}

type BasePoints<E> = [Option<(Address, Vec<E>)>];

/// The smallest family with `T_i q − q_e ∈ V_e` and `T_i V ⊂ V_e`, as row bases.
fn close_spans<E: Entry>(shape: &Shape<E>, reachable: &[usize], base: &BasePoints<E>) -> Vec<Matrix<E>> {
    let mut spans: Vec<Matrix<E>> = shape.states.iter().map(|s| Matrix::zero(0, s.dim)).collect();
    let point = |e: usize| &base[e].as_ref().expect("a reachable state").1;
    for &e in reachable {
        let rows = shape.states[e].pieces.iter().map(|p| difference(&p.op.apply(point(p.target)), point(e))).collect();
        spans[e] = Matrix::from_rows(shape.states[e].dim, rows).echelon().rows;
    }
    let pieces = reachable.iter().flat_map(|&e| shape.states[e].pieces.iter().map(move |p| (e, p)));
    let arrows: Vec<_> = pieces.map(|(e, p)| (p.target, e, p.op.transpose())).collect();
    closures(spans, &arrows)
}

/// The row spaces `Σ_u rows(P T_u)` over all paths `u` from the start.
fn close_rows<E: Entry>(shape: &Shape<E>, reachable: &[usize]) -> Vec<Matrix<E>> {
    let mut rows: Vec<Matrix<E>> = shape.states.iter().map(|s| Matrix::zero(0, s.dim)).collect();
    let start = shape.start;
    rows[start] = shape.view().echelon().rows;
    let pieces = reachable.iter().flat_map(|&e| shape.states[e].pieces.iter().map(move |p| (e, p)));
    let arrows: Vec<_> = pieces.map(|(e, p)| (e, p.target, &p.op)).collect();
    closures(rows, &arrows)
}

/// `a − b`, entry by entry.
#[must_use]
pub fn difference<E: Entry>(a: &[E], b: &[E]) -> Vec<E> {
    a.iter().zip(b).map(|(x, y)| x.minus(y)).collect()
}

/// A left inverse of a matrix with independent columns.
fn left_inverse<E: Entry>(basis: &Matrix<E>) -> Matrix<E> {
    basis
        .transpose()
        .solve(&Matrix::identity(basis.cols()))
        .map_or_else(|| Matrix::zero(basis.cols(), basis.rows()), |x| x.transpose())
}

impl<E: Entry> Shape<E> {
    /// The map from the start state into the space where the shape is looked at: the control matrix, or the identity.
    #[must_use]
    pub fn view(&self) -> Matrix<E> {
        self.control.clone().unwrap_or_else(|| Matrix::identity(self.states[self.start].dim))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::shape::{CellKind, Frame, Piece, State};

    fn state(name: &str, dim: usize, pieces: Vec<Piece>) -> State {
        State { name: name.into(), kind: CellKind::Edge, dim, pieces, left: None, right: None }
    }

    #[test]
    fn states_without_fixed_points_span_the_segment() {
        let op = |shift: i64| Shape::affine_operator(&Matrix::from_fn(1, 1, |_, _| ratio(1, 2)), &[ratio(shift, 2)]);
        let piece = |target, shift| Piece { target, op: op(shift), reversed: false, share: None };
        let states = vec![state("a", 2, vec![piece(1, 0), piece(1, 1)]), state("b", 2, vec![piece(0, 0), piece(0, 1)])];
        let shape = Shape { states, start: 0, control: None, frame: Frame::Barycentric };
        let spaces = Spaces::new(&shape).unwrap();
        assert_eq!((spaces.of(0).basis.cols(), spaces.of(1).basis.cols()), (1, 1));
    }

    #[test]
    fn a_segment_in_the_plane_has_one_dimension() {
        let half = Matrix::from_fn(2, 2, |i, j| if i == j { ratio(1, 2) } else { ratio(0, 1) });
        let maps = vec![
            Shape::affine_operator(&half, &[ratio(0, 1), ratio(0, 1)]),
            Shape::affine_operator(&half, &[ratio(1, 2), ratio(1, 2)]),
        ];
        let spaces = Spaces::new(&Shape::single(CellKind::Edge, maps)).unwrap();
        assert_eq!(spaces.of(0).basis.cols(), 1);
        assert_eq!(&spaces.of(0).coordinates * &spaces.of(0).basis, Matrix::identity(1));
    }
}
