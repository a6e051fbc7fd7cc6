//! How long the search for proofs may go on. A budget decides which questions stay open, never what an answer is.

use crate::radius::Options;
use crate::radius::family::Search;

/// Three budgets by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Effort {
    /// About a quarter of the normal limits.
    Quick,
    /// What `secant certify` does unless it is told otherwise.
    #[default]
    Normal,
    /// About eight times the normal limits.
    Hard,
}

impl Effort {
    /// `quick`, `normal` or `hard`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Normal => "normal",
            Self::Hard => "hard",
        }
    }
}

/// The limits of the search, each with its normal value.
///
/// ```
/// use secant::budget::{Budget, Effort};
/// let budget = Budget { cells: 20_000, ..Budget::of(Effort::Normal) };
/// assert!(budget.cells < Budget::of(Effort::Hard).cells);
/// ```
#[derive(Debug, Clone)]
pub struct Budget {
    /// Contraction: products of operators formed until all words shrink (20 000).
    pub words: usize,
    /// Contraction: the same for large operators, `d³` for each product of `d × d` matrices (5 000 000).
    pub work: usize,
    /// Ring conditions: cells into which the ring of a branch is divided (6 000).
    pub cells: usize,
    /// Ring conditions: cells before something cheaper is tried (1 000; of surfaces 600).
    pub first_cells: usize,
    /// Joints of deeper levels that are examined one by one where Theorem 5 does not apply (40).
    pub joints: usize,
    /// Levels on which they lie (4).
    pub levels: usize,
    /// Cones of Theorem 6: steps of the linear programs that propose rays (300 000 000).
    pub cone_steps: usize,
    /// Surfaces: cells in which zeros of the leading functionals are looked for (120).
    pub witness_cells: usize,
    /// Surfaces: coordinates of a star of cells, for cones around planes (30).
    pub star_dimensions: usize,
    /// Vertices: binary places of enclosures in the first attempt and in the second (192, 768).
    pub places: [u64; 2],
    /// Vertices: how often a patch is halved (14).
    pub halvings: usize,
    /// Vertices of schemes without Bézier patches: cells of the ring (40 000).
    pub ring_cells: usize,
    /// Joint spectral radii, where contraction rests on one.
    pub radius: Options,
    /// Joint spectral radii of the orders of smoothness in the uniform parameter: a small part of what `secant regularity` spends.
    pub orders: Options,
    /// Regions of a parameter: hulls for each order (120), and the work for all.
    pub regions: Search,
}

/// Work for each order of smoothness: about 20 ms.
const ORDER: u64 = 20_000_000;

impl Default for Budget {
    fn default() -> Self {
        Self::of(Effort::Normal)
    }
}

impl Budget {
    /// The budget of an effort.
    #[must_use]
    pub fn of(effort: Effort) -> Self {
        let normal = Self {
            words: 20_000,
            work: 5_000_000,
            cells: 6_000,
            first_cells: 1_000,
            joints: 40,
            levels: 4,
            cone_steps: 300_000_000,
            witness_cells: 120,
            star_dimensions: 30,
            places: [192, 768],
            halvings: 14,
            ring_cells: 40_000,
            radius: Options::default(),
            orders: Options { longest: 8, vertices: 400, work: Some(ORDER), ..Options::default() },
            regions: Search::default(),
        };
        match effort {
            Effort::Normal => normal,
            Effort::Quick => {
                Self { places: [192, 192], halvings: 10, levels: 2, star_dimensions: 16, ..normal.scaled(1, 4) }
            }
            Effort::Hard => {
                Self { places: [192, 3072], halvings: 20, levels: 6, star_dimensions: 40, ..normal.scaled(8, 1) }
            }
        }
    }

    /// Every count times `by / over`.
    fn scaled(&self, by: usize, over: usize) -> Self {
        let times = |n: usize| n * by / over;
        Self {
            words: times(self.words),
            work: times(self.work),
            cells: times(self.cells),
            first_cells: times(self.first_cells),
            joints: times(self.joints),
            cone_steps: times(self.cone_steps),
            witness_cells: times(self.witness_cells),
            ring_cells: times(self.ring_cells),
            orders: Options { work: self.orders.work.map(|w| w * by as u64 / over as u64), ..self.orders.clone() },
            regions: Search {
                hulls: times(self.regions.hulls),
                work: self.regions.work * by as u64 / over as u64,
                ..self.regions.clone()
            },
            ..self.clone()
        }
    }

    /// Cells of a ring of a surface before something cheaper is tried: three fifths of those of a curve.
    #[must_use]
    pub fn first_surface_cells(&self) -> usize {
        self.first_cells * 3 / 5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_effort_is_more_of_everything() {
        let limits = |effort| {
            let b = Budget::of(effort);
            let places = b.places.map(|p| usize::try_from(p).expect("small"));
            let counts = [
                b.words,
                b.work,
                b.cells,
                b.first_cells,
                b.joints,
                b.levels,
                b.cone_steps,
                b.witness_cells,
                b.star_dimensions,
            ];
            [counts.as_slice(), &places, &[b.halvings, b.ring_cells, b.first_surface_cells(), b.regions.hulls]].concat()
        };
        let all = [Effort::Quick, Effort::Normal, Effort::Hard].map(limits);
        for pair in all.windows(2) {
            assert!(pair[0].iter().zip(&pair[1]).all(|(less, more)| less <= more), "{pair:?}");
        }
    }
}
