//! For which values of a parameter a rule on meshes is C¹ at a vertex.

use crate::answer::Verdict;
use crate::budget::Budget;
use crate::case::{Setting, Valences, VertexFamilyCase};
use crate::diagnostic::Problem;
use crate::radius::family::Search;
use crate::vertex::region::{Limits, RegionError, RuleFamily, VertexRegion, region};
use std::path::Path;
use std::time::Instant;

/// The regions of a rule on meshes with a parameter, by valence.
#[derive(Debug, Clone)]
pub struct RegionsAtVertices {
    /// What was asked about.
    pub case: VertexFamilyCase,
    /// What is known at each valence.
    pub found: Vec<VertexRegion>,
}

/// Work of the search that stands for one interval.
const WINDOW: u64 = 5_000_000;

/// The regions of a case file with `[parameters]` and `[vertex]`, at these valences or at those of the file.
///
/// # Errors
/// A [`Problem`] where the input is no such rule with one parameter that is left free, or no valence is given.
pub fn vertex_regions(
    path: &Path,
    set: &[(String, Setting)],
    valences: Option<&Valences>,
    search: &Search,
    budget: &Budget,
) -> Result<RegionsAtVertices, Problem> {
    vertex_regions_of_case(VertexFamilyCase::read(path, set)?, valences, search, budget)
}

/// The same of a case that was read.
///
/// # Errors
/// As [`vertex_regions`].
pub fn vertex_regions_of_case(
    case: VertexFamilyCase,
    valences: Option<&Valences>,
    search: &Search,
    budget: &Budget,
) -> Result<RegionsAtVertices, Problem> {
    let Some(Valences::List(list)) = valences.or(case.valences.as_ref()) else {
        return Err(Problem::new(
            "secant::region::valence",
            format!("{}: regions are found at single valences", case.name),
        )
        .with_help("write valence = \"3..12\" in [vertex], or add --valence 3..12"));
    };
    let member = |p: &_| case.member(p).map_err(|e| RegionError::Member(e.message().to_owned()));
    let family = RuleFamily { range: case.range.clone(), degree: case.degree, member: &member };
    let begun = Instant::now();
    let mut found = Vec::new();
    for (k, valence) in list.iter().enumerate() {
        let left = u32::try_from(list.len() - k).map_or(1, |n| n.max(1));
        let limits = Limits {
            width: search.width.clone(),
            windows: usize::try_from(search.work / WINDOW).unwrap_or(usize::MAX),
            time: search.time.map(|time| time.saturating_sub(begun.elapsed()) / left),
        };
        found.push(region(&family, *valence, &limits, budget).map_err(|e| {
            Problem::new("secant::region", format!("{}: {e}", case.name))
                .with_help("single values can be asked: `secant certify CASE w=1/16`")
        })?);
    }
    Ok(RegionsAtVertices { case, found })
}

impl RegionsAtVertices {
    /// The whole as one verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let parts: Vec<Verdict> = self.found.iter().flat_map(|r| &r.parts).map(|part| part.finding.verdict()).collect();
        Verdict::all(parts.len().max(1), parts)
    }
}
