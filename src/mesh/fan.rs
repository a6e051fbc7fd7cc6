//! Fans of faces at the border for almost all points: which have a tangent plane up to the border (docs/theory.md, “Border
//! vertices”).

use super::border::Fan;
use super::step::Step;
use crate::answer::Verdict;
use crate::budget::Budget;
use crate::vertex::AtValence;
pub use crate::vertex::BorderGround as Ground;
use std::cmp::Ordering;

/// What holds at a fan for almost all points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// C¹ up to the border.
    pub verdict: Verdict,
    /// Why.
    pub ground: Ground,
}

impl Fan {
    /// The order of the eigenvalue of an inner mode and 1/2: it is larger exactly where `2cos(jπ/k) > 0`, of triangles `> 1`.
    fn against_half(self, mode: usize) -> Ordering {
        self.faces.cmp(&(mode * if self.triangles { 3 } else { 2 }))
    }

    /// The statement that a fan falls under.
    #[must_use]
    pub fn ground(self) -> Ground {
        if !self.smooth {
            return match self.against_half(1) {
                Ordering::Greater => Ground::Sides,
                Ordering::Equal => Ground::Jordan,
                Ordering::Less => Ground::Affine,
            };
        }
        match (self.faces, self.against_half(1), self.against_half(2)) {
            (1, ..) => Ground::OneFace,
            (_, _, Ordering::Greater) => Ground::Modes,
            (_, _, Ordering::Equal) => Ground::Jordan,
            (_, Ordering::Equal, _) => Ground::Affine,
            _ => Ground::Map,
        }
    }

    /// The verdict for almost all points, as that at a valence.
    #[must_use]
    pub fn at(self, budget: &Budget) -> AtValence {
        let row = self.row(budget);
        AtValence::on_border(self.faces, self.smooth, row.ground, row.verdict)
    }

    /// The verdict for almost all points.
    ///
    /// # Cost
    /// Up to a second where the signs of a characteristic map are examined; they are for at most six faces.
    #[must_use]
    pub fn row(self, budget: &Budget) -> Row {
        let ground = self.ground();
        let holds = match ground {
            Ground::Modes | Ground::Sides => return Row { verdict: Verdict::Refuted, ground },
            Ground::OneFace => Some(()),
            Ground::Affine => Step::of(self).affine(),
            Ground::Jordan if !self.smooth => Step::of(self).corner(),
            Ground::Jordan | Ground::Map => Step::of(self).smooth(ground, budget),
        };
        Row { verdict: if holds.is_some() { Verdict::Proved } else { Verdict::Undetermined }, ground }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fan(triangles: bool, smooth: bool, faces: usize) -> Fan {
        Fan { triangles, smooth, faces }
    }

    #[test]
    fn the_table_of_borders() {
        use Ground::{Affine, Jordan, Map, Modes, OneFace, Sides};
        let smooth = [
            (false, vec![OneFace, Affine, Map, Jordan, Modes, Modes, Modes]),
            (true, vec![OneFace, Map, Affine, Map, Map, Jordan, Modes]),
        ];
        let corner = [(false, vec![Affine, Jordan, Sides, Sides]), (true, vec![Affine, Affine, Jordan, Sides])];
        for (list, is_smooth) in [(smooth, true), (corner, false)] {
            for (triangles, grounds) in list {
                for (k, ground) in grounds.into_iter().enumerate() {
                    let row = fan(triangles, is_smooth, k + 1).row(&Budget::default());
                    let wanted = if matches!(ground, Modes | Sides) { Verdict::Refuted } else { Verdict::Proved };
                    assert_eq!((row.ground, row.verdict), (ground, wanted), "{triangles} {is_smooth} {}", k + 1);
                }
            }
        }
    }
}
