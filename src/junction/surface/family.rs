//! All surfaces between two face schemes: stencils of the refined points of the border, whose windows are the operators.

use super::grid::{Grid, Heights, refined};
use super::{FaceSide, SurfaceError};
use crate::arith::Rational;
use crate::junction::{Junction, Pattern, row_text};
use crate::linalg::Matrix;

/// A refined point that no scheme gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Free {
    /// Its column among the refined ones.
    pub column: usize,
    /// Its row there; further rows of the column are the same point beside other vertices.
    pub row: usize,
    /// Whether its stencil is one beside a vertex, on the points of an edge across the border; otherwise it is on all points of the
    /// intermediate face.
    pub at_vertex: bool,
    /// The points that its stencil may use, as column and row.
    pub support: Vec<(usize, usize)>,
}

/// Two face schemes and a pattern across the border between them.
#[derive(Debug, Clone)]
pub struct SurfaceJunction {
    /// The scheme on the left.
    pub left: FaceSide,
    /// The scheme on the right.
    pub right: FaceSide,
    /// The curves across the border.
    pub across: Junction,
    /// All free points, in the order of columns and rows.
    pub free: Vec<Free>,
    pub(super) heights: Heights,
    /// The points of the intermediate face.
    pub(super) face: Grid,
    /// Its refined points.
    pub(super) net: Grid,
}

impl SurfaceJunction {
    /// The family; its sizes are checked.
    ///
    /// # Errors
    /// [`SurfaceError`] where the schemes do not fit together.
    pub fn new(left: &FaceSide, right: &FaceSide, pattern: Pattern) -> Result<Self, SurfaceError> {
        let arity = left.across.arity();
        let all = [&left.across, &left.along, &right.across, &right.along];
        if all.iter().any(|s| s.arity() != arity) {
            return Err(SurfaceError::Arity(all.map(|s| s.arity())));
        }
        let (p, q) = (left.across.shared, right.across.shared);
        let across = Junction::new(left.across.clone(), right.across.clone(), pattern, p + q)?;
        let heights = Heights::of([&left.along, &right.along]);
        let face = Grid::new(heights, [p, q], 1);
        let own = pattern.left * (left.across.points() - p) + p;
        let net = Grid::new(heights, [own, across.rows() - own], arity);
        let points = face.len().max(net.len());
        if points > super::MAX_POINTS {
            return Err(SurfaceError::Large(points));
        }
        let mut family =
            Self { left: left.clone(), right: right.clone(), across, free: Vec::new(), heights, face, net };
        family.free = family.free_points()?;
        Ok(family)
    }

    /// The number of pieces along either direction.
    #[must_use]
    pub fn arity(&self) -> usize {
        self.left.across.arity()
    }

    /// The number of points of the intermediate face and of its edge across the border.
    #[must_use]
    pub fn points(&self) -> [usize; 2] {
        [self.face.len(), self.face.over(0).len()]
    }

    /// The number of parameters of the family: of each free stencil all entries but one.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.free.iter().map(|f| f.support.len().saturating_sub(1)).sum()
    }

    /// The scheme of a kind.
    pub(super) fn side(&self, kind: usize) -> &FaceSide {
        if kind == 0 { &self.left } else { &self.right }
    }

    /// The points on which all free stencils of a kind are written: those of the edge across the border, or of the face.
    pub(super) fn domain(&self, free: &Free) -> Grid {
        self.face.over(usize::from(!free.at_vertex))
    }

    fn free_points(&self) -> Result<Vec<Free>, SurfaceError> {
        let forced = self.across.forced()?;
        let edge = self.face.over(0);
        let mut found = Vec::new();
        for column in (0..forced.len()).filter(|c| forced[*c].is_none()) {
            let kind = self.net.kind(column);
            let (own, apart) = (self.heights.vertex[kind], self.arity() * self.heights.step(kind));
            for row in 0..own.min(apart) {
                // Beside further vertices the point is at the rows `row + q apart`, and all of them see its stencil.
                let copies = (own - 1 - row) / apart;
                let room = |c: usize| {
                    let kind = edge.kind(c);
                    self.heights.vertex[kind].saturating_sub(copies * self.heights.step(kind))
                };
                let support = (0..edge.width()).flat_map(|c| (0..room(c)).map(move |r| (c, r))).collect();
                found.push(Free { column, row, at_vertex: true, support });
            }
            for row in own..apart {
                found.push(Free { column, row, at_vertex: false, support: self.face.points() });
            }
        }
        Ok(found)
    }

    /// The rows of the refined points of the face, or of the edge across the border, on their points.
    ///
    /// # Errors
    /// [`SurfaceError::Stencil`] for another number of stencils, or one with another sum or points that it must not use.
    pub(super) fn array(&self, stencils: &[Vec<Rational>], edge: bool) -> Result<Matrix, SurfaceError> {
        self.checked(stencils)?;
        let forced = self.across.forced()?;
        let (points, net) = match edge {
            true => (self.face.over(0), self.net.over(0)),
            false => (self.face.clone(), self.net.clone()),
        };
        let rules = [0, 1].map(|kind| refined(&self.side(kind).along, edge));
        let mut rows = Vec::new();
        for (column, row) in net.points() {
            let mut out = vec![Rational::from(0); points.len()];
            let kind = net.kind(column);
            if let Some(across) = &forced[column] {
                for (c, x) in across.iter().enumerate().filter(|(_, x)| **x != 0) {
                    for (r, y) in rules[kind].row(row).iter().enumerate() {
                        out[points.index(c, r)] = x * y;
                    }
                }
            } else {
                let (index, copy) = self.free_at(column, row)?;
                let domain = self.domain(&self.free[index]);
                for (&(c, r), x) in domain.points().iter().zip(&stencils[index]).filter(|(_, x)| **x != 0) {
                    out[points.index(c, r + copy * self.heights.step(points.kind(c)))] = x.clone();
                }
            }
            rows.push(out);
        }
        Ok(Matrix::from_rows(points.len(), rows))
    }

    /// The free point at a place, and beside which vertex it is seen there.
    fn free_at(&self, column: usize, row: usize) -> Result<(usize, usize), SurfaceError> {
        let apart = self.arity() * self.heights.step(self.net.kind(column));
        let at = |row: usize| self.free.iter().position(|f| (f.column, f.row) == (column, row));
        let found = at(row).map(|k| (k, 0)).or_else(|| Some((at(row % apart)?, row / apart)));
        found.ok_or_else(|| SurfaceError::Stencil(format!("the refined point ({column}, {row}) has no stencil")))
    }

    fn checked(&self, stencils: &[Vec<Rational>]) -> Result<(), SurfaceError> {
        if stencils.len() != self.free.len() {
            let text = format!("{} stencils are free, but {} are given", self.free.len(), stencils.len());
            return Err(SurfaceError::Stencil(text));
        }
        for (k, (stencil, free)) in stencils.iter().zip(&self.free).enumerate() {
            let points = self.domain(free).points();
            let sum = stencil.iter().fold(Rational::from(0), |s, x| s + x);
            if stencil.len() != points.len() || sum != 1 {
                let text = format!(
                    "stencil {k} has {} entries of sum {sum}; {} entries of sum 1 are needed",
                    stencil.len(),
                    points.len()
                );
                return Err(SurfaceError::Stencil(text));
            }
            if let Some(at) = (0..points.len()).find(|i| stencil[*i] != 0 && !free.support.contains(&points[*i])) {
                let text = format!(
                    "stencil {k} ({}) uses point {at}, which not all cells that see the new point have",
                    row_text(stencil)
                );
                return Err(SurfaceError::Stencil(text));
            }
        }
        Ok(())
    }
}
