//! The one door: a question in, findings out, for the library, the command line, the gallery and the tests.

mod findings;
mod model;
mod orders;

pub use findings::{Findings, confirm, unconfirmed};
pub use model::model_problem;
pub use orders::{deciding_claims, of_longer_polygons};

use crate::answer::{Answer, Verdict};
use crate::budget::Budget;
use crate::case::{Case, Origin, Question, Valences, VertexCase};
use crate::diagnostic::Problem;
use crate::mesh::{Fan, immersed_disc};
use crate::scheme::{Sector, mesh_rules};
use crate::stop;
use crate::theorem::surface::{around_vertex, certify_complex_within};
use crate::theorem::{Certified, certify_within};
use crate::vertex::{AtValence, Every, Ground, at_valence_within, every};
use std::sync::Arc;

/// Most coordinates of stars of cells at vertices of mesh rules.
const SMALL_STARS: usize = 16;

/// Answers a question: the verdict depends on the case and the budget only.
///
/// # Errors
/// A [`Problem`] where the shape is no model (pieces that do not meet, a product that expands), where no valence is named, or
/// where nothing is known of the valences.
///
/// # Examples
/// ```
/// use secant::prelude::*;
///
/// let question = Question::read("cases/surfaces/bicubic-space.toml".as_ref())?;
/// assert_eq!(prove(&question, &Budget::default())?.verdict(), Verdict::Proved);
/// # Ok::<(), Problem>(())
/// ```
pub fn prove(question: &Question, budget: &Budget) -> Result<Findings, Problem> {
    prove_with(question, budget, &|| {})
}

/// As [`prove`]; `step` is called after each valence, from any thread.
///
/// # Errors
/// As [`prove`].
pub fn prove_with(question: &Question, budget: &Budget, step: &(dyn Fn() + Sync)) -> Result<Findings, Problem> {
    match question {
        Question::Tangents { case, further } => {
            let addresses = [case.examine.as_slice(), further].concat();
            let certified = |budget: &Budget| {
                certify_complex_within(&case.complex(), &addresses, budget).map_err(|error| model_problem(case, &error))
            };
            let mut found = match &case.scheme {
                // Theorem 7 is cheaper than the forms of large stars.
                Some(Origin::Mesh { .. }) => certified(&Budget { star_dimensions: SMALL_STARS, ..budget.clone() })?,
                _ => certified(budget)?,
            };
            settle_around_vertex(case, &mut found, budget);
            Ok(Findings::Tangents { case: Arc::clone(case), found: Box::new(found) })
        }
        Question::OverField { case, further } => {
            let addresses = [case.examine.as_slice(), further].concat();
            let found = certify_within(&case.shape, &addresses, budget).map_err(|error| model_problem(case, &error))?;
            Ok(Findings::OverField { case: Arc::clone(case), found: Box::new(found) })
        }
        Question::Vertices { case, valences } => {
            let (found, every) = at_valences(case, valences.as_ref().ok_or_else(no_valence)?, budget, step)?;
            Ok(Findings::Vertices { case: Arc::clone(case), found, every })
        }
    }
}

/// What Theorem 7 says of every point of a shape that was built of a mesh rule with polynomial patches.
fn settle_around_vertex(case: &Case, found: &mut Certified, budget: &Budget) {
    let Some(Origin::Mesh { rule, valence, disc }) = &case.scheme else { return };
    if !found.surface.as_ref().is_some_and(|s| matches!(s.every, Answer::Open(_))) {
        return;
    }
    let Ok(at) = at_valence_within(rule, *valence, budget) else { return };
    if !at.polynomial || at.smooth != Verdict::Proved || at.ground != Some(Ground::Regular) {
        return;
    }
    let control = case.shape.control.as_ref().filter(|_| *disc);
    around_vertex(found, &case.shape, *valence, control.and_then(|points| immersed_disc(rule, &at, points)));
}

fn no_valence() -> Problem {
    Problem::new("secant::usage::valence", "no valence is given")
        .with_help("add --valence 3..32, or a line such as  valence = \"3..32\"  to the [vertex] table")
}

/// What is found at the valences that were asked for; for all of them, the common proof and the small ones it leaves out.
fn at_valences(
    case: &VertexCase,
    asked: &Valences,
    budget: &Budget,
    step: &(dyn Fn() + Sync),
) -> Result<(Vec<AtValence>, Option<Every>), Problem> {
    match asked {
        Valences::List(list) => Ok((examine(case, list, budget, step)?, None)),
        Valences::All => {
            let every = all_at_once(case)?;
            let rest: Vec<usize> = (3..every.from).collect();
            Ok((examine(case, &rest, budget, step)?, Some(every)))
        }
    }
}

/// The proof for all valences from some valence on.
fn all_at_once(case: &VertexCase) -> Result<Every, Problem> {
    let found = every(&case.rule)
        .map_err(|error| Problem::new("secant::scheme", format!("{}: {error}", case.name)).with_source(&case.text))?;
    found.ok_or_else(|| {
        let message = format!("no proof for all valences at once is known for {}", case.scheme);
        let known: Vec<&str> = mesh_rules().iter().filter(|r| r.has_all_valences()).map(|r| r.name).collect();
        let help = format!("there is one for {}; give a range such as --valence 3..32", known.join(", "));
        Problem::new("secant::usage::valence", message).with_help(help)
    })
}

fn examine(
    case: &VertexCase,
    list: &[usize],
    budget: &Budget,
    step: &(dyn Fn() + Sync),
) -> Result<Vec<AtValence>, Problem> {
    let flag = stop::flag();
    let triangles = case.rule.sector() == Sector::Triangles;
    let at = |n: usize| match case.border {
        Some(smooth) => Ok(Fan { triangles, smooth, faces: n }.at(budget)),
        None => at_valence_within(&case.rule, n, budget),
    };
    let one = |&n: &usize| {
        let found = stop::stoppable(flag.clone(), || at(n));
        step();
        found.map_err(|error| {
            Problem::new("secant::scheme", format!("{} at valence {n}: {error}", case.name)).with_source(&case.text)
        })
    };
    // The first problem in the order of the valences, whichever thread is the first to find one.
    #[cfg(feature = "parallel")]
    let all: Vec<Result<AtValence, Problem>> = {
        use rayon::prelude::*;
        list.par_iter().map(one).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let all: Vec<Result<AtValence, Problem>> = list.iter().map(one).collect();
    all.into_iter().collect()
}
