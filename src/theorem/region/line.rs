//! What happens on a straight line in the plane of two parameters.

use super::curve::CurveFamily;
use super::plane::Area;
use super::table::CurveRegions;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::linalg::Matrix;
use crate::poly::{Poly, Two};
use crate::radius::family::Search;

/// The part of a straight line in a box of two parameters: one of them runs, the other is a linear function of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlaneLine {
    /// The polynomial that vanishes on the line.
    pub border: Two,
    /// The index of the parameter that runs.
    pub runs: usize,
    /// The other parameter.
    pub other: Poly,
    /// The closed range of the one that runs.
    pub range: (Rational, Rational),
}

/// A line with what is known there.
#[derive(Debug, Clone)]
pub struct LineRegion {
    /// The line.
    pub line: PlaneLine,
    /// The tables over the parameter that runs.
    pub found: CurveRegions,
}

impl PlaneLine {
    /// The line on which a polynomial of degree 1 vanishes; `None` for any other polynomial, and where the line meets the box in no
    /// more than a point.
    #[must_use]
    pub fn of(border: &Two, area: &Area) -> Option<Self> {
        let straight = |f: &Two| f.solved().filter(|g| g.degree().is_none_or(|d| d <= 1));
        let (runs, other) = match straight(border) {
            Some(other) => (0, other),
            None => (1, straight(&border.swapped())?),
        };
        let [own, across] = if runs == 0 { [&area.first, &area.second] } else { [&area.second, &area.first] };
        let (at_zero, slope) = (other.coeff(0), other.coeff(1));
        let mut range = own.clone();
        if slope == 0 {
            if at_zero < across.0 || across.1 < at_zero {
                return None;
            }
        } else {
            let mut ends = [&across.0, &across.1].map(|y| (y - &at_zero) / &slope);
            ends.sort();
            let [low, high] = ends;
            range = (range.0.max(low), range.1.min(high));
        }
        (range.0 < range.1).then(|| Self { border: border.clone(), runs, other, range })
    }

    /// What a polynomial in both parameters is along the line.
    #[must_use]
    pub fn along(&self, f: &Two) -> Poly {
        if self.runs == 0 { f.along(&self.other) } else { f.swapped().along(&self.other) }
    }
}

impl CurveFamily<Two> {
    /// What is known on the lines among some curves. The work that is set aside is shared by them.
    pub(super) fn on_lines(
        &self,
        borders: &[Two],
        area: &Area,
        (search, budget): (&Search, &Budget),
    ) -> Vec<LineRegion> {
        let lines: Vec<PlaneLine> = borders.iter().filter_map(|f| PlaneLine::of(f, area)).take(MAX_LINES).collect();
        let count = lines.len().max(1) as u32;
        let search =
            Search { work: search.work / u64::from(count), time: search.time.map(|t| t / count), ..search.clone() };
        let one = |line: PlaneLine| {
            let operators: Vec<Matrix<Poly>> = self.operators.iter().map(|m| m.map(|f| line.along(f))).collect();
            let family = CurveFamily::new(operators, self.reversed.clone(), self.control.clone()).ok()?;
            let found = family.regions(&line.range, &search, budget).ok()?;
            Some(LineRegion { line, found })
        };
        lines.into_iter().filter_map(one).collect()
    }
}

/// Most lines that are examined.
const MAX_LINES: usize = 12;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;

    #[test]
    fn lines_are_cut_at_the_box() {
        let (p, q) = (Two::first(), Two::second());
        let area = Area { first: (ratio(0, 1), ratio(1, 1)), second: (ratio(0, 1), ratio(1, 2)) };
        let one = Two::number(ratio(1, 1));
        let line = PlaneLine::of(&p.scale(&ratio(2, 1)).plus(&q).minus(&one), &area).unwrap();
        assert_eq!((line.runs, line.range.clone()), (0, (ratio(1, 4), ratio(1, 2))));
        assert!(line.along(&line.border).is_zero());
        let upright = PlaneLine::of(&p.minus(&one), &area).unwrap();
        assert_eq!((upright.runs, upright.range.clone()), (1, area.second.clone()));
        assert!(upright.along(&upright.border).is_zero());
        // Beside the box, through a corner only, and not straight.
        let beside = q.minus(&one);
        let corner = p.plus(&q).minus(&Two::number(ratio(3, 2)));
        assert!(
            [beside, corner, p.times(&q).minus(&one), q.minus(&p.times(&p))]
                .iter()
                .all(|f| PlaneLine::of(f, &area).is_none())
        );
    }
}
