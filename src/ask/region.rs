//! For which values of a parameter a scheme converges and is smooth.

use super::region_plane::{RegionsInPlane, plane_regions_of_case};
use super::region_vertex::{RegionsAtVertices, vertex_regions_of_case};
use crate::answer::Verdict;
use crate::budget::Budget;
use crate::case::{
    self, CurveFamilyCase, FamilyForm, MaskFamilyCase, PlaneFamilyCase, Setting, Valences, VertexFamilyCase,
    named_family,
};
use crate::diagnostic::{Problem, SourceText};
use crate::radius::family::Search;
use crate::report::document::Document;
use crate::report::region as report;
use crate::report::region_curve as curve_report;
use crate::report::region_plane as plane_report;
use crate::report::region_vertex as vertex_report;
use crate::scheme;
use crate::theorem::region::{CurveFamily, CurveRegions, MaskFamily, OrderRegion, PlaneLimits};
use serde_json::Value;
use std::path::Path;

/// The regions of a mask with a parameter.
#[derive(Debug, Clone)]
pub struct Regions {
    /// What was asked about.
    pub case: MaskFamilyCase,
    /// The mask.
    pub family: MaskFamily,
    /// The orders, from convergence up.
    pub orders: Vec<OrderRegion>,
}

/// The regions of a case file with `[parameters]`, or of a named scheme with a range, as in `four-point w=-1/2..1/2`, up to an order.
///
/// # Errors
/// A [`Problem`] where the input is no mask with one parameter that is left free.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, case::setting, radius::family::Search};
/// let set = [setting("mu=0..1/6")?];
/// let found = secant::ask::regions("ternary-four-point", &set, 2, &Search::default())?;
/// let at = |p, q| found.orders[2].at(&secant::algebraic::Root::from_rational(&ratio(p, q))).and_then(|f| f.answer());
/// assert_eq!((at(1, 15), at(1, 11), at(1, 9)), (Some(false), Some(true), Some(false)));
/// # Ok::<(), secant::diagnostic::Problem>(())
/// ```
pub fn regions(what: &str, set: &[(String, Setting)], most: usize, search: &Search) -> Result<Regions, Problem> {
    let case = if scheme::list().iter().any(|s| s.name == what) {
        named_family(what, set)?
    } else {
        MaskFamilyCase::read(Path::new(what), set)?
    };
    regions_of_case(case, most, search)
}

/// The same of a case that was read.
///
/// # Errors
/// A [`Problem`] where the mask satisfies no sum rule.
pub fn regions_of_case(case: MaskFamilyCase, most: usize, search: &Search) -> Result<Regions, Problem> {
    let wrong = |e: crate::theorem::region::RegionError| {
        Problem::new("secant::region", format!("{}: {e}", case.name))
            .with_help("a mask with a parameter must satisfy the sum rules of order 1 for every value of it")
    };
    let family = MaskFamily::new(case.arity, &case.mask, &case.parameter).map_err(wrong)?;
    let orders = family.regions(&case.range, most, search).map_err(wrong)?;
    Ok(Regions { case, family, orders })
}

impl Regions {
    /// The whole as one verdict: proved where every order is proved on the whole range, refuted where a value refutes one.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let parts: Vec<Verdict> =
            self.orders.iter().flat_map(|o| &o.parts).map(|part| report::verdict(&part.finding)).collect();
        Verdict::all(parts.len().max(1), parts)
    }

    /// The tables.
    #[must_use]
    pub fn document(&self) -> Document {
        report::document(&self.case, &self.family, &self.orders)
    }

    /// The tables with the statements and a picture.
    #[must_use]
    pub fn report(&self) -> Document {
        report::report(&self.case, &self.family, &self.orders)
    }

    /// The picture as SVG.
    #[must_use]
    pub fn svg(&self) -> Option<String> {
        report::picture(&self.case, &self.orders).map(|p| p.0)
    }

    /// The certificate, accepted by the checker, and the family in the plain form that it is about. Parts without a certificate
    /// (single members that were asked) are undetermined in it.
    ///
    /// # Errors
    /// A [`Problem`] where the checker does not accept it.
    pub fn certificate(&self) -> Result<(String, String), Problem> {
        let plain = self.case.plain();
        accepted(plain, crate::certificate::region_certificate(&self.case.name, &self.family, &self.orders))
    }

    /// The tables as data (docs/json.md).
    #[must_use]
    pub fn data(&self) -> Value {
        report::data(&self.case, &self.family, &self.orders)
    }
}

/// A certificate that the checker accepts, with what it is about.
fn accepted(plain: String, made: crate::certificate::Certificate) -> Result<(String, String), Problem> {
    let made = crate::certificate::checked(&plain, made).map_err(|e| {
        Problem::new("secant::region", e.to_string()).with_help("see docs/certificate.md; no certificate was written")
    })?;
    Ok((made.text(), plain))
}

/// Why what was written is no family.
fn no_family(what: &str) -> Problem {
    match case::written(what) {
        Err(problem) => problem,
        Ok(_) => Problem::new("secant::region", format!("{} has no parameter that is left free", what.trim())).with_help(
            "regions are about schemes with a range, as in four-point w=0..1/4, or a file with [parameters]; `secant certify` and \
             `secant regularity` take this",
        ),
    }
}

/// The regions of a curve with a parameter.
#[derive(Debug, Clone)]
pub struct RegionsOfCurve {
    /// What was asked about.
    pub case: CurveFamilyCase,
    /// The curve.
    pub family: CurveFamily,
    /// The tables.
    pub found: CurveRegions,
}

/// The regions of a case file with `[parameters]` and maps or operators.
///
/// # Errors
/// A [`Problem`] where the input is no curve of one state with one parameter that is left free.
pub fn curve_regions(
    path: &Path,
    set: &[(String, Setting)],
    search: &Search,
    budget: &Budget,
) -> Result<RegionsOfCurve, Problem> {
    curve_regions_of_case(CurveFamilyCase::read(path, set)?, search, budget)
}

/// The same of a case that was read.
///
/// # Errors
/// As [`curve_regions`].
pub fn curve_regions_of_case(
    case: CurveFamilyCase,
    search: &Search,
    budget: &Budget,
) -> Result<RegionsOfCurve, Problem> {
    let wrong = |message: String| {
        Problem::new("secant::region", format!("{}: {message}", case.name))
            .with_help("single values can be asked: `secant certify CASE w=1/16`")
    };
    let family = CurveFamily::new(case.operators.clone(), case.reversed.clone(), case.control.clone())
        .map_err(|e| wrong(e.to_string()))?;
    let found = family.regions(&case.range, search, budget).map_err(|e| wrong(e.to_string()))?;
    Ok(RegionsOfCurve { case, family, found })
}

impl RegionsOfCurve {
    /// The whole as one verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let parts: Vec<Verdict> = self.found.tables.iter().flat_map(|t| &t.parts).map(|part| part.verdict).collect();
        Verdict::all(parts.len().max(1), parts)
    }

    /// The certificate, accepted by the checker, and the family in the plain form that it is about. Members that were asked by
    /// themselves are undetermined in it.
    ///
    /// # Errors
    /// A [`Problem`] where the checker does not accept it.
    pub fn certificate(&self) -> Result<(String, String), Problem> {
        accepted(self.case.plain(), crate::certificate::curve_region_certificate(&self.case.name, &self.found))
    }
}

/// How often the plane is halved in both directions unless it is told otherwise.
pub const DEPTH: usize = 7;
/// The same at most.
pub const MAX_DEPTH: usize = 10;
/// Work of the search that stands for one box.
const BOX: u64 = 1_000_000;

fn plane_limits(asked: &Asked, search: &Search, budget: &Budget) -> PlaneLimits {
    let boxes = usize::try_from(search.work / BOX).map_or(usize::MAX, |n| n);
    let depth = asked.depth.unwrap_or(DEPTH).min(MAX_DEPTH);
    PlaneLimits { depth, boxes, time: search.time, lines: Some((search.clone(), budget.clone())) }
}

/// What `secant region` answers.
#[derive(Debug, Clone)]
pub enum Family {
    /// Of a mask.
    Mask(Box<Regions>),
    /// Of a curve.
    Curve(Box<RegionsOfCurve>),
    /// At vertices of meshes.
    Vertex(Box<RegionsAtVertices>),
    /// Of a curve with two parameters.
    Plane(Box<RegionsInPlane>),
}

/// What is asked of a family beside its range.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// The highest order of smoothness of masks.
    pub order: Option<usize>,
    /// The valences at vertices of meshes, in the place of those of the file.
    pub valences: Option<Valences>,
    /// How often the plane of two parameters is halved; [`DEPTH`] without it.
    pub depth: Option<usize>,
}

impl Asked {
    fn no_valences(&self, what: &str) -> Result<(), Problem> {
        match self.valences {
            None => Ok(()),
            Some(_) => Err(Problem::new("secant::region::valence", format!("{what} has no valences"))
                .with_help("--valence is for cases with a [vertex] table")),
        }
    }
}

impl Family {
    /// The regions of what stands for a family. `step` is told how much of the plane of two parameters was done, in boxes of the
    /// smallest size.
    ///
    /// # Errors
    /// A [`Problem`] where it is none.
    pub fn ask(
        what: &str,
        set: &[(String, Setting)],
        asked: &Asked,
        search: &Search,
        budget: &Budget,
        step: &dyn Fn(usize),
    ) -> Result<Self, Problem> {
        if scheme::list().iter().any(|s| s.name == what) {
            asked.no_valences(what)?;
            return Ok(Self::Mask(Box::new(regions(what, set, asked.order.unwrap_or(usize::MAX), search)?)));
        }
        if what != "-" && !what.ends_with(".toml") && !Path::new(what).exists() {
            return Err(no_family(what));
        }
        let source = SourceText::read(Path::new(what))?;
        Self::of_text(&source.name, &source.text, set, asked, search, budget, step)
    }

    /// The same of the text of a case.
    ///
    /// # Errors
    /// A [`Problem`] where it is no family.
    pub fn of_text(
        name: &str,
        text: &str,
        set: &[(String, Setting)],
        asked: &Asked,
        search: &Search,
        budget: &Budget,
        step: &dyn Fn(usize),
    ) -> Result<Self, Problem> {
        let form = FamilyForm::of(text);
        if form != FamilyForm::Vertex {
            asked.no_valences(name)?;
        }
        Ok(match form {
            FamilyForm::Mask => {
                let case = MaskFamilyCase::parse(name, text, set)?;
                Self::Mask(Box::new(regions_of_case(case, asked.order.unwrap_or(usize::MAX), search)?))
            }
            FamilyForm::Curve => {
                if let Some(case) = PlaneFamilyCase::parse(name, text, set)? {
                    let found = plane_regions_of_case(case, &plane_limits(asked, search, budget), step)?;
                    return Ok(Self::Plane(Box::new(found)));
                }
                let case = CurveFamilyCase::parse(name, text, set)?;
                Self::Curve(Box::new(curve_regions_of_case(case, search, budget)?))
            }
            FamilyForm::Vertex => {
                let case = VertexFamilyCase::parse(name, text, set)?;
                let found = vertex_regions_of_case(case, asked.valences.as_ref(), search, budget)?;
                Self::Vertex(Box::new(found))
            }
        })
    }

    /// The whole as one verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Mask(r) => r.verdict(),
            Self::Curve(r) => r.verdict(),
            Self::Vertex(r) => r.verdict(),
            Self::Plane(r) => r.verdict(),
        }
    }

    /// The tables.
    #[must_use]
    pub fn document(&self) -> Document {
        match self {
            Self::Mask(r) => r.document(),
            Self::Curve(r) => curve_report::document(&r.case, &r.found),
            Self::Vertex(r) => vertex_report::document(&r.case, &r.found),
            Self::Plane(r) => plane_report::document(&r.case, &r.found),
        }
    }

    /// The tables with the statements and a picture.
    #[must_use]
    pub fn report(&self) -> Document {
        match self {
            Self::Mask(r) => r.report(),
            Self::Curve(r) => curve_report::report(&r.case, &r.found),
            Self::Vertex(r) => vertex_report::report(&r.case, &r.found),
            Self::Plane(r) => plane_report::report(&r.case, &r.found),
        }
    }

    /// The picture as SVG.
    #[must_use]
    pub fn svg(&self) -> Option<String> {
        match self {
            Self::Mask(r) => r.svg(),
            Self::Curve(r) => curve_report::picture(&r.case, &r.found).map(|p| p.0),
            Self::Vertex(r) => vertex_report::picture(&r.case, &r.found).map(|p| p.0),
            Self::Plane(r) => Some(plane_report::picture(&r.case, &r.found).0),
        }
    }

    /// The tables as data (docs/json.md).
    #[must_use]
    pub fn data(&self) -> Value {
        match self {
            Self::Mask(r) => r.data(),
            Self::Curve(r) => curve_report::data(&r.case, &r.found),
            Self::Vertex(r) => vertex_report::data(&r.case, &r.found),
            Self::Plane(r) => plane_report::data(&r.case, &r.found),
        }
    }

    /// The certificate and what it is about, as [`Regions::certificate`].
    ///
    /// # Errors
    /// A [`Problem`] where the checker does not accept it.
    pub fn certificate(&self) -> Result<(String, String), Problem> {
        match self {
            Self::Mask(r) => r.certificate(),
            Self::Curve(r) => r.certificate(),
            Self::Plane(r) => Err(Problem::new(
                "secant::region::certificate",
                format!("{}: there is no certificate format for regions in the plane", r.case.name),
            )
            .with_help("a line through it has one: give one of the parameters a value")),
            Self::Vertex(r) => Err(Problem::new(
                "secant::region::certificate",
                format!("{}: there is no certificate format for regions at vertices", r.case.name),
            )
            .with_help("single values have certificates: `secant certify CASE w=1/16 --certificate FILE`")),
        }
    }
}
