//! Points of a strip in columns across the border, of two kinds: those of the scheme on the left and those of the scheme on the right.

use crate::arith::Rational;
use crate::junction::Side;
use crate::linalg::Matrix;

/// Along the border: the numbers of points of a cell and of a vertex of both schemes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Heights {
    /// Points of a cell, by kind.
    pub cell: [usize; 2],
    /// Points of a vertex, by kind.
    pub vertex: [usize; 2],
}

impl Heights {
    pub fn of(sides: [&Side; 2]) -> Self {
        Self { cell: sides.map(Side::points), vertex: sides.map(|s| s.shared) }
    }

    /// By how many points neighbouring cells of a kind are apart.
    pub fn step(&self, kind: usize) -> usize {
        self.cell[kind] - self.vertex[kind]
    }
}

/// So many columns of the kinds 0 and 1, of a number of cells along the border; 0 for the points of a vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Grid {
    heights: Heights,
    /// Columns of either kind, first those of kind 0.
    columns: [usize; 2],
    cells: usize,
}

impl Grid {
    pub fn new(heights: Heights, columns: [usize; 2], cells: usize) -> Self {
        Self { heights, columns, cells }
    }

    /// The same columns over another number of cells.
    pub fn over(&self, cells: usize) -> Self {
        Self { cells, ..self.clone() }
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.columns[0] + self.columns[1]
    }

    /// The kind of a column.
    pub fn kind(&self, column: usize) -> usize {
        usize::from(column >= self.columns[0])
    }

    /// The number of points of a column.
    pub fn height(&self, column: usize) -> usize {
        let kind = self.kind(column);
        self.cells * self.heights.step(kind) + self.heights.vertex[kind]
    }

    /// The number of a point.
    pub fn index(&self, column: usize, row: usize) -> usize {
        (0..column).map(|c| self.height(c)).sum::<usize>() + row
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.index(self.width(), 0)
    }

    /// All points, as column and row.
    pub fn points(&self) -> Vec<(usize, usize)> {
        (0..self.width()).flat_map(|c| (0..self.height(c)).map(move |r| (c, r))).collect()
    }

    /// The numbers of the points of a part: a grid that begins in a column and over a cell.
    pub fn window(&self, first: usize, part: &Self, cell: usize) -> Vec<usize> {
        let at = |(c, r): (usize, usize)| self.index(first + c, r + cell * self.heights.step(part.kind(c)));
        part.points().into_iter().map(at).collect()
    }

    /// The part as an operator: column `j` picks its point `j`.
    pub fn inclusion(&self, first: usize, part: &Self, cell: usize) -> Matrix {
        let picked = self.window(first, part, cell);
        Matrix::from_fn(self.len(), picked.len(), |i, j| Rational::from(u8::from(picked[j] == i)))
    }
}

/// The refined points of so many cells along the border by the old ones: rows on the points of a cell, or of a vertex for `vertex`.
pub(super) fn refined(side: &Side, vertex: bool) -> Matrix {
    if vertex {
        return side.vertex();
    }
    side.refined_points()
}
