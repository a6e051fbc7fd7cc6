//! `secant refine`: a curve or a surface on more control points.

use super::PROVED;
use super::junction::refused;
use super::output::{print_or_write, settle};
use crate::case::{MAX_COORDINATES, Question};
use crate::diagnostic::Problem;
use crate::junction::{JunctionError, Refined, refine};
use crate::linalg::Matrix;
use crate::report::words::count;
use crate::scheme::{Heading, complex_text};
use crate::shape::{CellKind, Complex, Piece};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub struct RefineArgs {
    /// A case file of a curve or a surface, or the name of a scheme with its parameters in quotation marks.
    pub(super) case: String,
    /// How often to refine.
    #[arg(long, value_name = "COUNT", default_value_t = 1)]
    steps: usize,
    /// Write the refined case to a file instead of the standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

/// Writes the refined case.
pub fn run(args: &RefineArgs) -> u8 {
    settle(refined(args).and_then(|text| print_or_write(&text, args.output.as_deref())).map(|()| PROVED))
}

fn refined(args: &RefineArgs) -> Result<String, Problem> {
    let case = match Question::ask(&args.case)? {
        Question::Tangents { case, .. } => case,
        Question::OverField { .. } => {
            let message = "curves with irrational entries are not refined yet";
            return Err(Problem::new("secant::refine", message).with_help("write rational entries"));
        }
        Question::Vertices { .. } => {
            return Err(refused(&JunctionError::Refinement("only curves and surfaces are refined".to_owned())));
        }
    };
    let first = case.complex();
    let mut complex = first.clone();
    let mut embedding = Matrix::identity(first.shape.states[first.shape.start].dim);
    for step in 1..=args.steps {
        let next = refine(&complex).map_err(|e| refused(&e).with_source(&case.text))?;
        verified(&complex, &next)?;
        embedding = &embedding * &next.embedding;
        complex = next.complex;
        let size = embedding.cols();
        if size > MAX_COORDINATES {
            let why = format!("{} would have {size} points; the limit is {MAX_COORDINATES}", count(step, "step"));
            return Err(Problem::new("secant::refine", why).with_help("take fewer --steps"));
        }
    }
    // Without its own points the old curve is the one in barycentric space; its points by the old ones are the rows of E.
    let given = complex.shape.control.is_some();
    complex.shape.control.get_or_insert_with(|| embedding.clone());
    let heading = Heading {
        name: format!("{}-refined", case.name),
        title: format!("{}, refined by {}", case.title, count(args.steps, "step")),
        source: case.source.clone().unwrap_or_default(),
        examine: Vec::new(),
    };
    let rows: Vec<String> =
        (0..embedding.cols()).map(|j| format!("#   {}", crate::junction::row_text(&embedding.column(j)))).collect();
    let points = if given {
        "`control` holds the old curve's points."
    } else {
        "`control` makes it the old curve, in the coordinates of its points; without it, it is one of more points, a larger family."
    };
    let left = if case.examine.is_empty() {
        ""
    } else {
        "\n# The points to examine were left out: they have other addresses."
    };
    Ok(format!(
        "# Refined by {}, from {} to {} points. {points}{left}\n# E T' = T E was verified for every cell; the new points by the old ones:\n{}\n{}",
        count(args.steps, "step"),
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
