//! `secant refine`: a curve or a surface on more control points.

use super::PROVED;
use super::junction::refused;
use super::output::{print_or_write, settle};
use crate::case::{MAX_COORDINATES, Question};
use crate::diagnostic::Problem;
use crate::junction::{JunctionError, Refined, refine};
use crate::linalg::Matrix;
use crate::scheme::{Heading, complex_text};
use crate::shape::{CellKind, Complex, Piece};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub struct RefineArgs {
    /// A case file of a curve or a surface, or the name of a scheme with its parameters in quotation marks.
    case: String,
    /// How often to refine.
    #[arg(long, value_name = "COUNT", default_value_t = 1)]
    steps: usize,
    /// Write the refined case to a file instead of the standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Writes the refined case.
pub fn run(args: &RefineArgs) -> u8 {
    settle(refined(args).and_then(|text| print_or_write(&text, args.output.as_deref())).map(|()| PROVED))
}

fn refined(args: &RefineArgs) -> Result<String, Problem> {
    let Question::Tangents { case, .. } = Question::ask(&args.case)? else {
        return Err(refused(&JunctionError::Refinement("only curves and surfaces are refined".to_owned())));
    };
    let first = case.complex();
    let mut complex = first.clone();
    let mut embedding = Matrix::identity(first.shape.states[first.shape.start].dim);
    for _ in 0..args.steps {
        let next = refine(&complex).map_err(|e| refused(&e).with_source(&case.text))?;
        verified(&complex, &next)?;
        embedding = &embedding * &next.embedding;
        complex = next.complex;
        let size = embedding.cols();
        if size > MAX_COORDINATES {
            let why = format!("it would have {size} points, which is over the limit of {MAX_COORDINATES}");
            return Err(refused(&JunctionError::Refinement(why)));
        }
    }
    let heading = Heading {
        name: format!("{}-refined", case.name),
        title: format!("{}, refined {} times", case.title, args.steps),
        source: case.source.clone().unwrap_or_default(),
        examine: Vec::new(),
    };
    let rows: Vec<String> =
        (0..embedding.cols()).map(|j| format!("#   {}", crate::junction::row_text(&embedding.column(j)))).collect();
    Ok(format!(
        "# Refined {} times, from {} to {} points. E T' = T E was verified for every cell; the new points by the old ones:\n{}\n{}",
        args.steps,
        embedding.rows(),
        embedding.cols(),
        rows.join("\n"),
        complex_text(&complex, &heading)
    ))
}

/// Multiplies both sides of `E T'_{ij} = T_i T_j` out once more, and checks the identities of the refined shape.
fn verified(before: &Complex, next: &Refined) -> Result<(), Problem> {
    let mistake = |what: String| {
        Problem::new("secant::refine::mistake", what)
            .with_help("this is a mistake in secant: please report it with the case")
    };
    let (after, shape) = (&next.complex, &before.shape);
    let new = &after.shape.states[after.shape.start].pieces;
    let holds = |(piece, word): (&Piece, &[usize; 2])| {
        let (product, target) = shape.product(shape.start, word);
        target == piece.target && &next.embedding * &piece.op == product
    };
    if new.len() != next.cells.len() || !new.iter().zip(&next.cells).all(holds) {
        return Err(mistake("E T' = T E fails".to_owned()));
    }
    after.shape.check().map_err(|e| mistake(e.to_string()))?;
    after.check().map_err(|e| mistake(e.to_string()))?;
    match after.shape.states[after.shape.start].kind {
        CellKind::Edge => after.shape.check_curves().map_err(|e| mistake(e.to_string())),
        _ => Ok(()),
    }
}
