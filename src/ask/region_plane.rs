//! In which boxes of two parameters a curve is G¹.

use crate::answer::Verdict;
use crate::case::{PlaneFamilyCase, Setting};
use crate::diagnostic::Problem;
use crate::theorem::region::{Area, CurveFamily, PlaneLimits, PlaneRegion};
use std::path::Path;

/// The plane of a curve with two parameters.
#[derive(Debug, Clone)]
pub struct RegionsInPlane {
    /// What was asked about.
    pub case: PlaneFamilyCase,
    /// What is known.
    pub found: PlaneRegion,
}

/// The plane of a case file with `[parameters]`, two of which are left free, and maps or operators; `None` where not exactly two
/// are. `step` is told how much of the whole was done, in boxes of the smallest size.
///
/// # Errors
/// A [`Problem`] where the input is no curve of one state.
pub fn plane_regions(
    path: &Path,
    set: &[(String, Setting)],
    limits: &PlaneLimits,
    step: &dyn Fn(usize),
) -> Result<Option<RegionsInPlane>, Problem> {
    let case = PlaneFamilyCase::read(path, set)?;
    case.map(|case| plane_regions_of_case(case, limits, step)).transpose()
}

/// The same of a case that was read.
///
/// # Errors
/// As [`plane_regions`].
pub fn plane_regions_of_case(
    case: PlaneFamilyCase,
    limits: &PlaneLimits,
    step: &dyn Fn(usize),
) -> Result<RegionsInPlane, Problem> {
    let family =
        CurveFamily::new(case.operators.clone(), case.reversed.clone(), case.control.clone()).map_err(|e| {
            Problem::new("secant::region", format!("{}: {e}", case.name))
                .with_help("single values can be asked: `secant certify CASE a=1/4 b=1/3`")
        })?;
    let [first, second] = case.ranges.clone();
    let found = family.plane(&Area { first, second }, limits, step);
    Ok(RegionsInPlane { case, found })
}

impl RegionsInPlane {
    /// The whole as one verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::all(self.found.boxes.len().max(1), self.found.boxes.iter().map(|b| b.known.verdict()))
    }
}
