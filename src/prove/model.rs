//! What the engine refuses, as a problem of the case file.

use crate::case::Case;
use crate::diagnostic::Problem;
use crate::shape::{CurveError, Frame, word_text};
use crate::theorem::ModelError;

/// What the engine refuses, shown where it stands in the file.
pub fn model_problem<E>(case: &Case<E>, error: &ModelError) -> Problem {
    let code = error.code();
    match error {
        ModelError::Curve(CurveError::Apart { state, index, piece, ends, begins }) => {
            // Affine maps are read as operators on the simplex 0, e_1, …; the user knows the coordinates after the first.
            let skip = usize::from(case.shape.frame == Frame::Affine);
            let tuple = |v: &[String]| tuple(v.get(skip..).unwrap_or(v));
            let place = if case.shape.states.len() > 1 { format!(" of state `{state}`") } else { String::new() };
            let before = piece.saturating_sub(1);
            let (begins, ends) = (tuple(begins), tuple(ends));
            let message = format!("piece {piece}{place} begins at {begins}, but piece {before} ends at {ends}");
            let help = "each piece of a curve begins where the one before ends; mark a piece that runs backwards as \
                        reversed, or declare kind = \"set\"";
            case.problem_at_joint(*index, before, code, &message, help)
        }
        ModelError::Curve(CurveError::Identity { index, piece, .. }) => {
            let help = "the operators and boundaries of an edge must satisfy its identities exactly";
            case.problem_at_piece(*index, *piece, code, &error.to_string(), help)
        }
        ModelError::Expands { state, index, word } => {
            let message = format!(
                "the system does not contract: the product of the cycle {} at state `{state}` has a linear part of \
                 spectral radius at least 1",
                word_text(word)
            );
            let help =
                "an attractor inside a smaller invariant space may still exist; write the operators on that space";
            match word.first() {
                Some(&letter) => case.problem_at_piece(*index, letter, code, &message, help),
                None => case.problem_at_state(*index, code, &message, help),
            }
        }
        _ => case.problem_at_state(case.shape.start, code, &error.to_string(), "see docs/theory.md §1"),
    }
}

fn tuple(point: &[String]) -> String {
    let coordinates: Vec<String> = point.iter().map(|x| x.replace('-', "−")).collect();
    format!("({})", coordinates.join(", "))
}
