//! Two verdicts about one shape, held against each other.

use super::{Broken, Image, Law};
use crate::algebraic::Elem;
use crate::linalg::Matrix;
use crate::shape::{Address, Shape};
use crate::theorem::{Certified, Direction, ModelError, PointReport, Role, Verdict};

/// What two verdicts that do not contradict each other have in common.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Answers that both gave.
    pub compared: usize,
    /// What only one of the two decided.
    pub lost: Vec<String>,
}

/// The old shape was certified and the new one is refused.
pub(super) fn refused(law: Law, found: &Certified, error: &ModelError) -> Result<Agreement, Broken> {
    match found.contraction.is_proved() {
        true => Err(Broken { law, what: format!("the same shape is refused in other words: {error}") }),
        false => Ok(Agreement { compared: 0, lost: vec![format!("refused: {error}")] }),
    }
}

struct Comparison<'a> {
    law: Law,
    image: &'a Image,
    agreement: Agreement,
}

pub(super) fn compare(
    law: Law,
    old: &Shape,
    found: &Certified,
    image: &Image,
    other: &Certified,
) -> Result<Agreement, Broken> {
    let mut comparison = Comparison { law, image, agreement: Agreement::default() };
    if law != Law::AsSet {
        comparison.verdicts("all claims together", found.verdict, other.verdict)?;
        if let (Some(a), Some(b)) = (&found.everywhere, &other.everywhere) {
            comparison.verdicts("G¹ at every point", a.verdict, b.verdict)?;
        }
    }
    for point in &found.points {
        for branch in &point.branches {
            let there = image.address(old, &branch.address).and_then(|a| point_at(other, &a));
            if let Some(there) = there {
                comparison.points(&branch.address, point, there)?;
            }
        }
    }
    Ok(comparison.agreement)
}

fn point_at<'a>(found: &'a Certified, address: &Address) -> Option<&'a PointReport> {
    found.points.iter().find(|p| p.branches.iter().any(|b| b.address == *address))
}

impl Comparison<'_> {
    fn broken(&self, what: String) -> Broken {
        Broken { law: self.law, what }
    }

    fn verdicts(&mut self, of: &str, old: Verdict, new: Verdict) -> Result<(), Broken> {
        let decided = |v| v != Verdict::Undetermined;
        if decided(old) && decided(new) {
            self.agreement.compared += 1;
            if old != new {
                return Err(self.broken(format!("{of}: {} and {}", old.word(), new.word())));
            }
        } else if old != new {
            self.agreement.lost.push(format!("{of}: {} and {}", old.word(), new.word()));
        }
        Ok(())
    }

    fn points(&mut self, address: &Address, old: &PointReport, new: &PointReport) -> Result<(), Broken> {
        let of = format!("the point {address}");
        if self.law == Law::AsSet && matches!(old.role, Role::Joint { .. }) {
            // The set has the germ of one side only, whose tangent subspace is a part of that of the joint.
            return match (new.verdict, old.verdict) {
                (Verdict::Refuted, Verdict::Proved) => {
                    Err(self.broken(format!("{of}: the joint has a line, one of its branches has none")))
                }
                _ => Ok(()),
            };
        }
        self.verdicts(&of, old.verdict, new.verdict)?;
        let exact = |p: &PointReport, q: &PointReport| p.dimension.exact && q.dimension.at_least > p.dimension.at_least;
        if exact(old, new) || exact(new, old) {
            let (a, b) = (old.dimension.at_least, new.dimension.at_least);
            return Err(self.broken(format!("{of}: dimensions {a} and {b}")));
        }
        if old.verdict != Verdict::Proved || new.verdict != Verdict::Proved {
            return Ok(());
        }
        if let (Some(a), Some(b), Some(map)) = (&old.tangent, &new.tangent, &self.image.directions) {
            let mapped = applied(map, a);
            if mapped.same_line(b).is_none() {
                return Err(self.broken(format!("{of}: tangents {:?} and {:?}", mapped.to_f64(), b.to_f64())));
            }
            if self.law != Law::AsSet {
                self.rays(&of, map, old, new)?;
            }
        }
        Ok(())
    }

    fn rays(&self, of: &str, map: &Matrix, old: &PointReport, new: &PointReport) -> Result<(), Broken> {
        let (left, right) = if self.image.backwards { (&new.right, &new.left) } else { (&new.left, &new.right) };
        for (side, mine, theirs) in [("left", &old.left, left), ("right", &old.right, right)] {
            // Rays that are not settled on one of the sides are no contradiction.
            if mine.is_empty() || theirs.is_empty() {
                continue;
            }
            let mapped: Vec<Direction> = mine.iter().map(|d| applied(map, d)).collect();
            let within =
                |a: &[Direction], b: &[Direction]| a.iter().all(|x| b.iter().any(|y| x.same_line(y) == Some(1)));
            if !within(&mapped, theirs) || !within(theirs, &mapped) {
                return Err(self.broken(format!("{of}: other rays on the {side}")));
            }
        }
        let settled = |p: &PointReport| !(p.left.is_empty() && p.right.is_empty());
        if settled(old) && settled(new) && old.kind != new.kind {
            return Err(self.broken(format!("{of}: {} and {}", old.kind.word(), new.kind.word())));
        }
        Ok(())
    }
}

/// The image of a direction under a rational matrix.
fn applied(map: &Matrix, direction: &Direction) -> Direction {
    let coords = (0..map.rows())
        .map(|i| {
            let terms = map.row(i).iter().zip(&direction.coords).map(|(m, c)| c.scale(m));
            terms.fold(Elem::zero(), |sum, term| sum.add(&term))
        })
        .collect();
    Direction { root: direction.root.clone(), coords }
}
