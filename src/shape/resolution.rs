//! How far an attractor can be from the points that are drawn of it.

use super::{Balls, Shape, Spaces, oscillation};
use crate::arith::Rational;
use crate::linalg::Matrix;

/// Most cells that are looked at.
pub const MAX_CELLS: usize = 1 << 16;

/// The cells of one level of a shape, each with the map through which it is seen.
pub struct Resolution<'a> {
    shape: &'a Shape,
    balls: &'a Balls,
    cells: Vec<(usize, Matrix)>,
    /// Letters of the words of the cells.
    pub depth: usize,
}

impl<'a> Resolution<'a> {
    /// The shape as one cell.
    #[must_use]
    pub fn start(shape: &'a Shape, balls: &'a Balls) -> Self {
        Self { shape, balls, cells: vec![(shape.start, shape.view())], depth: 0 }
    }

    /// Divides all cells once more; `None` where they would be more than [`MAX_CELLS`].
    ///
    /// # Cost
    /// One product for each cell.
    #[must_use]
    pub fn divided(self) -> Option<Self> {
        let count: usize = self.cells.iter().map(|(e, _)| self.shape.states[*e].pieces.len()).sum();
        if count > MAX_CELLS {
            return None;
        }
        let pieces = |(e, seen): &(usize, Matrix)| {
            self.shape.states[*e].pieces.iter().map(|p| (p.target, seen * &p.op)).collect::<Vec<_>>()
        };
        Some(Self { cells: self.cells.iter().flat_map(pieces).collect(), depth: self.depth + 1, ..self })
    }

    /// An upper bound of the square of the diameter of every cell, as it is seen, in the Euclidean norm.
    ///
    /// Two points of a cell of state `f` differ by a vector of sum 0 and 1-norm at most `2 r`, with the radius `r` of the ball
    /// that holds `A_f`; a row takes it to at most `r` times the difference of its largest and its smallest entry.
    #[must_use]
    pub fn squared(&self) -> Rational {
        let of = |(e, seen): &(usize, Matrix)| {
            let row = |i: usize| {
                let reach = oscillation(seen.row(i)) * self.balls.radius(*e);
                &reach * &reach
            };
            (0..seen.rows()).fold(Rational::from(0), |s, i| s + row(i))
        };
        self.cells.iter().map(of).fold(Rational::from(0), |m, x| m.max(x))
    }
}

/// The level at which no cell is larger than `error`, with a bound of the squares; `None` where the balls are not known or there
/// are too many cells before.
#[must_use]
pub fn level(shape: &Shape, contraction: &super::Contraction, error: &Rational) -> Option<(usize, Rational)> {
    let balls = Balls::of(shape, &Spaces::new(shape)?, contraction)?;
    let mut cells = Resolution::start(shape, &balls);
    loop {
        let squared = cells.squared();
        if cells.depth > 0 && squared <= error * error {
            return Some((cells.depth, squared));
        }
        cells = cells.divided()?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::scheme::bezier;
    use crate::shape::contraction;

    #[test]
    fn chords_of_cells_are_not_longer_than_the_bound() {
        let mut shape = bezier(3, &ratio(1, 2)).unwrap();
        shape.control = Some(Matrix::from_fn(2, 4, |i, j| ratio([[0, 1, 3, 4], [0, 2, -1, 1]][i][j], 1)));
        let found = contraction(&shape, |_| false);
        let (depth, squared) = level(&shape, &found, &ratio(1, 100)).unwrap();
        assert!(squared <= ratio(1, 10_000));
        let complex = crate::shape::Complex::of_curves(shape.clone());
        let points = crate::shape::sample(&complex, depth, &mut |_| ()).unwrap().points;
        for pair in points.windows(2) {
            let square = |i: usize| {
                let d = &pair[0][i] - &pair[1][i];
                &d * &d
            };
            assert!(square(0) + square(1) <= squared);
        }
        // One level less is not enough.
        let balls = Balls::of(&shape, &Spaces::new(&shape).unwrap(), &found).unwrap();
        let mut cells = Resolution::start(&shape, &balls);
        while cells.depth + 1 < depth {
            cells = cells.divided().unwrap();
        }
        assert!(cells.squared() > ratio(1, 10_000));
    }
}
