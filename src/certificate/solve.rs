//! Certificates of the solutions of cases with unknown entries.

use super::{Certificate, Unsupported, number, unsupported};
use crate::case::Case;
use crate::linalg::Matrix;
use crate::shape::{OpName, Problem, Solution, Source};
use serde_json::{Value, json};

/// Where an unknown stands: by state, first the pieces, then the boundaries at the start and at the finish; in each operator
/// by rows.
fn reading_order((op, row, column): &(OpName, usize, usize)) -> (usize, usize, usize, usize, usize) {
    let (state, part, letter) = match *op {
        OpName::Piece { state, letter } => (state, 0, letter),
        OpName::Left(state) => (state, 1, 0),
        OpName::Right(state) => (state, 2, 0),
        OpName::Side { state, side } => (state, 3, side),
        OpName::Reverse(state) => (state, 4, 0),
    };
    (state, part, letter, *row, *column)
}

/// The certificate of what was found for the unknown entries of a case.
///
/// # Errors
/// [`Unsupported`] where the case has faces or reversals: the checker does not read their identities.
///
/// # Cost
/// Linear in the entries of the solution; on a contradiction that of writing down the identities.
pub fn solve_certificate(case: &Case, problem: &Problem, solution: &Solution) -> Result<Certificate, Unsupported> {
    let complex = case.complex();
    if !complex.faces.is_empty() || !complex.reversals.is_empty() {
        return unsupported("the identities of faces and of reversals", "state");
    }
    let mut entries: Vec<_> = problem.entries().collect();
    entries.sort_by_key(|(place, _)| reading_order(place));
    let mut places: Vec<(OpName, usize, usize)> = Vec::new();
    let mut seen = Vec::new();
    for (place, unknown) in &entries {
        if !seen.contains(unknown) {
            seen.push(*unknown);
            places.push(*place);
        }
    }
    let values = |of: &dyn Fn(OpName) -> Option<Matrix>| -> Result<Value, Unsupported> {
        let value = |(op, i, j): &(OpName, usize, usize)| match of(*op) {
            Some(m) => Ok(number(&m[(*i, *j)])),
            None => unsupported("an operator without a solution", format!("{op:?}")),
        };
        places.iter().map(value).collect()
    };
    let (kind, verdict, point, directions, conflict): (_, _, Value, Vec<Value>, Vec<usize>) = match solution {
        Solution::None(sources) => {
            let Ok(identities) = complex.identities() else {
                return unsupported("a complex without identities", case.name.clone());
            };
            let mut operators: Vec<OpName> = entries.iter().map(|((op, ..), _)| *op).collect();
            operators.dedup();
            let index = |source: &Source| match source {
                Source::Identity(i) => identities.iter().position(|k| k == i),
                Source::Sums(op) => operators.iter().position(|o| o == op).map(|k| identities.len() + k),
            };
            let Some(mut conflict) = sources.iter().map(index).collect::<Option<Vec<usize>>>() else {
                return unsupported("an equation that the case does not have", "conflict");
            };
            conflict.sort_unstable();
            ("none", "refuted", Value::Null, Vec::new(), conflict)
        }
        Solution::One(solved) => ("one", "proved", values(&|op| solved.operator(op).cloned())?, Vec::new(), Vec::new()),
        Solution::Family(family) => {
            let along = |k: usize| values(&|op| family.derivatives(op).into_iter().nth(k));
            let directions = (0..family.parameters.len()).map(along).collect::<Result<_, _>>()?;
            ("family", "proved", values(&|op| family.origin.operator(op).cloned())?, directions, Vec::new())
        }
    };
    let proof = json!({"solutions": kind, "values": point, "directions": directions, "conflict": conflict});
    Ok(Certificate::new("solve", &case.name, verdict, proof))
}
