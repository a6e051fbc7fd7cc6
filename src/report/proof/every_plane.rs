//! The section on every point of a surface.

use super::super::document::{Block, Tone, words};
use super::super::every_plane;
use super::super::math::Math;
use super::super::radius::decimal;
use super::super::words::{count, listed, mark};
use super::evidence::Evidence;
use super::product::moves;
use super::{Quoted, every};
use crate::answer::Answer;
use crate::case::Case;
use crate::statement::Statement;
use crate::theorem::Certified;
use crate::theorem::surface::{EverySurfaceBreak, EverySurfaceProof, PatchDerivative, Surface, SurfaceForms};

pub(super) fn section(case: &Case, surface: &Surface, seen: &mut Quoted) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Every point")];
    match &surface.every {
        Answer::Proved(EverySurfaceProof::Product(curves))
        | Answer::Refuted(EverySurfaceBreak::Curve { curves, .. }) => {
            for (k, (which, found)) in ["first", "second"].into_iter().zip(curves.iter()).enumerate() {
                let Some(factor) = surface.factors.as_ref().and_then(|f| f.get(k)) else { continue };
                let mut own = case.clone();
                own.shape.clone_from(&factor.shape);
                blocks.push(Block::heading(3, &format!("Every point of the {which} curve")));
                blocks.extend(every::curve(&own, found, seen));
            }
            blocks.extend(seen.once_id(Statement::TensorEveryPoint));
            blocks.push(product(case, surface, curves).block());
        }
        Answer::Proved(EverySurfaceProof::Derivative(found)) => {
            blocks.extend(seen.once_id(Statement::PatchDerivative));
            blocks.push(derivative(found).block());
        }
        Answer::Proved(EverySurfaceProof::Forms(found)) => {
            blocks.extend(seen.once_id(Statement::SurfaceCones));
            blocks.push(cones(found).block());
        }
        Answer::Proved(EverySurfaceProof::Vertex { valence, rings }) => {
            blocks.extend(seen.once_id(Statement::VertexEveryPoint));
            blocks.push(around_vertex(case, *valence, *rings).block());
        }
        Answer::Refuted(EverySurfaceBreak::Point(_)) | Answer::Open(_) => {}
    }
    blocks.push(Block::Facts(every_plane::facts(surface)));
    blocks
}

/// What was verified of the statement on the derivative of a patch.
fn derivative(found: &PatchDerivative) -> Evidence {
    let dims = listed(&found.dims.iter().map(ToString::to_string).collect::<Vec<_>>());
    let hi = decimal(&found.enclosure.hi, true, 6);
    let radius = format!(
        "the spaces $F$ have the dimensions {dims}, state by state; the joint spectral radius on them is at most {hi}, which is below \
         $@$."
    );
    let rank = match &found.cells {
        None => "the differences of the corners of the start are independent modulo the differences of the derivative, as they are \
                 seen."
            .to_owned(),
        Some((length, cells)) => format!(
            "a 2-form is positive on the derivative on each of {}; words of {} bound it.",
            count(cells.len(), "cell"),
            count(*length, "letter")
        ),
    };
    let edges = format!("the equations hold in {} of two faces along an edge.", count(found.edges, "position"));
    Evidence::of(Statement::PatchDerivative)
        .holds(
            "patch",
            "all faces are divided evenly, or in the shares of their sides; the pieces that lead back to their face have the size $1/N=@$ \
             in the parameters.",
            [Math::number(&found.share)],
        )
        .holds("radius", &radius, [Math::number(&found.share)])
        .holds("edges", &edges, [])
        .holds("rank", &rank, [])
}

/// What was verified of the statement on cones around planes.
fn cones(found: &SurfaceForms) -> Evidence {
    let (stars, lists) = (found.forms.len() - 1, &found.stars);
    let cells = listed(&lists.list.iter().skip(1).map(|s| s.cells.len().to_string()).collect::<Vec<_>>());
    let children = lists.children.iter().skip(1).map(Vec::len).sum::<usize>();
    let dims = listed(&found.forms.iter().skip(1).map(|q| q.rows().to_string()).collect::<Vec<_>>());
    let glued = every_plane::glued(found)
        .map_or_else(String::new, |text| format!(" There are {text}: their points are the same there."));
    let patch = format!("all faces are divided evenly, into the same number of parts along every side.{glued}");
    Evidence::of(Statement::SurfaceCones)
        .holds("patch", &patch, [])
        .holds("stars", &format!("there are {} of {cells} cells, with {children} children.", count(stars, "star")), [])
        .holds("signature", &format!("the forms have the dimensions {dims}, star by star."), [])
        .holds("growth", &format!("elimination has positive pivots only, for all {children} children."), [])
        .holds("apart", &format!("bounds on {} of cells show it.", count(found.pairs, "pair")), [])
        .holds("view", &format!("it holds after {} of stars.", count(found.views, "word")), [])
}

/// What was verified of the statement on the disc around a vertex.
fn around_vertex(case: &Case, valence: usize, rings: Option<usize>) -> Evidence {
    let at = format!(
        "at valence {valence} the characteristic map has a Jacobian determinant of one strict sign, and a half-plane holds the \
         image of a sector (`secant certify CASE --valence {valence}` shows both)."
    );
    let view = match (&case.shape.control, rings) {
        (None, _) => "there are no control points.".to_owned(),
        (Some(_), None) => "the control points are injective on the relevant space.".to_owned(),
        (Some(_), Some(rings)) => format!(
            "the leading coefficients are independent, {rings} rings pass the test patch by patch, and the later ones are within \
             the room around the characteristic map."
        ),
    };
    Evidence::of(Statement::VertexEveryPoint)
        .holds("disc", "the shape was built from a mesh rule with polynomial patches.", [])
        .holds("vertex", &at, [])
        .holds("view", &view, [])
}

/// What was verified of the theorem on tensor products at every point.
fn product(case: &Case, surface: &Surface, curves: &[Certified; 2]) -> Evidence {
    let mut evidence = Evidence::of(Statement::TensorEveryPoint).holds(
        "product",
        "the operators of the surface are the tensor products of those of the two curves.",
        [],
    );
    for (k, factor) in surface.factors.iter().flatten().enumerate() {
        let (tone, text) = moves(["first", "second"][k.min(1)], factor);
        evidence.push("no-point", tone, text);
    }
    for (which, curve) in ["first", "second"].into_iter().zip(curves) {
        let Some(every) = &curve.everywhere else {
            evidence.push("curves", Tone::Open, words(format!("nothing is known of the {which} curve.")));
            continue;
        };
        let mut text = words(format!("the {which} curve: "));
        text.push(mark(every.verdict));
        let by = every.statement().map_or_else(String::new, |s| format!(", by {}", s.name()));
        text.extend(words(format!("{by}.")));
        evidence.push("curves", super::super::words::tone(every.verdict), text);
    }
    let text = match case.shape.control {
        None => "there are no control points.",
        Some(_) => "the control points are injective on the relevant space.",
    };
    evidence.holds("view", text, [])
}
