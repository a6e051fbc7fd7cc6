//! Where addresses are read from, and the map through which the shape is seen there.

use crate::arith::Rational;
use crate::linalg::{Entry, Matrix};
use crate::shape::{Shape, Spaces};

/// A state with the map from it into the space where the shape is looked at.
///
/// The two belong together: a map of one state cannot be applied to points of another, so they are made together and never
/// changed one by one.
#[derive(Debug, Clone)]
pub struct Viewpoint<E = Rational> {
    root: usize,
    map: Matrix<E>,
    places: bool,
}

impl<E: Entry> Viewpoint<E> {
    /// The start state with the control points, where there are any.
    #[must_use]
    pub fn start(shape: &Shape<E>) -> Self {
        Self { root: shape.start, map: shape.view(), places: shape.control.is_some() }
    }

    /// A state in its visible quotient.
    #[must_use]
    pub fn quotient(spaces: &Spaces<E>, state: usize) -> Self {
        Self::rows(spaces, state, &spaces.of(state).visible)
    }

    /// A state seen through rows on its relevant space.
    #[must_use]
    pub fn rows(spaces: &Spaces<E>, state: usize, rows: &Matrix<E>) -> Self {
        Self { root: state, map: rows * &spaces.of(state).coordinates, places: false }
    }

    /// The state from which addresses are read.
    #[must_use]
    pub fn root(&self) -> usize {
        self.root
    }

    /// The map from that state: control points, identity, or a quotient.
    #[must_use]
    pub fn map(&self) -> &Matrix<E> {
        &self.map
    }

    /// The image of a position of the root state under the control points; `None` where the map is not made of control points.
    #[must_use]
    pub fn image(&self, position: &[E]) -> Option<Vec<E>> {
        self.places.then(|| self.map.apply(position))
    }
}
