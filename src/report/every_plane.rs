//! What is known of every point of a surface, in words and as data.

use super::document::{Line, words};
use super::radius::decimal;
use super::reasons;
use super::words::{count, listed, mark};
use crate::answer::Answer;
use crate::statement::Statement;
use crate::theorem::Certified;
use crate::theorem::surface::{EverySurfaceBreak, EverySurfaceProof, Surface, SurfaceForms};
use serde_json::{Value, json};

/// What is claimed, in a few words.
pub const CLAIM: &str = "G¹: immersed, with a tangent plane at every point, up to the border, which turns continuously";

/// What proves it, in one sentence; `None` where it is not proved.
fn proof(surface: &Surface) -> Option<String> {
    match &surface.every {
        Answer::Proved(EverySurfaceProof::Product(curves)) => Some(format!(
            "it is the tensor product of two curves that are G¹: {}",
            listed(&curves.iter().map(of_curve).collect::<Vec<_>>())
        )),
        Answer::Proved(EverySurfaceProof::Derivative(d)) => Some(format!(
            "it is C¹ in its parameters, with a derivative of rank 2 ({}); the joint spectral radius on the differences of the \
             derivative is at most {}, below {}",
            Statement::PatchDerivative.short_name(),
            decimal(&d.enclosure.hi, true, 6),
            d.share
        )),
        Answer::Proved(EverySurfaceProof::Forms(f)) => Some(format!(
            "{}quadratic forms of signature (2, ·) on {} of cells, which their operators expand, make cones around planes that shrink to \
             the tangent planes ({})",
            glued(f).map_or_else(String::new, |text| format!("of the {text}: ")),
            count(f.forms.len() - 1, "star"),
            Statement::SurfaceCones.short_name()
        )),
        Answer::Proved(EverySurfaceProof::Vertex { valence, rings: Some(rings) }) => Some(format!(
            "Theorem 7 holds at valence {valence}, and all rings of the disc are immersed: {rings} were tested patch by patch, the \
             others are near the characteristic map ({})",
            Statement::VertexEveryPoint.short_name()
        )),
        Answer::Proved(EverySurfaceProof::Vertex { valence, rings: None }) => Some(format!(
            "it is seen as the characteristic map at a vertex of valence {valence}, which is regular and injective ({}, {})",
            Statement::Theorem7.short_name(),
            Statement::VertexEveryPoint.short_name()
        )),
        Answer::Refuted(_) | Answer::Open(_) => None,
    }
}

/// The faces of a set, and along how many sides they are glued; `None` where the start is one face.
#[must_use]
pub fn glued(f: &SurfaceForms) -> Option<String> {
    let cells = f.stars.list.first()?.cells.len();
    (cells > 1)
        .then(|| format!("{} of the start, glued along {}", count(cells, "face"), count(f.stars.seams(), "side")))
}

/// Why a curve is G¹.
fn of_curve(curve: &Certified) -> String {
    let by = curve.everywhere.as_ref().and_then(|e| e.statement());
    by.map_or_else(|| reasons::UNKNOWN.to_owned(), |s| s.short_name().to_owned())
}

/// Terms and what is to be said about them.
#[must_use]
pub fn facts(surface: &Surface) -> Vec<(String, Line)> {
    let mut verdict = vec![mark(surface.every.verdict())];
    verdict.extend(words(format!(": {CLAIM}")));
    if let Some(reason) = reasons::every_surface(surface) {
        verdict.extend(words(format!("; {reason}")));
    }
    let mut facts = vec![("smoothness".to_owned(), verdict)];
    facts.extend(proof(surface).map(|text| ("proof".to_owned(), words(text))));
    facts
}

/// The same as data.
#[must_use]
pub fn value(surface: &Surface) -> Value {
    let by = match &surface.every {
        Answer::Proved(EverySurfaceProof::Product(_)) | Answer::Refuted(EverySurfaceBreak::Curve { .. }) => {
            json!("product")
        }
        Answer::Proved(EverySurfaceProof::Derivative(_)) => json!("derivative"),
        Answer::Proved(EverySurfaceProof::Forms(_)) => json!("cones"),
        Answer::Proved(EverySurfaceProof::Vertex { .. }) => json!("vertex"),
        Answer::Refuted(EverySurfaceBreak::Point(_)) => json!("point"),
        Answer::Open(_) => Value::Null,
    };
    let witness = match &surface.every {
        Answer::Refuted(EverySurfaceBreak::Point(k)) => {
            let addresses = surface.points.get(*k).map(|p| p.branches.iter().map(|b| b.address.to_string()));
            json!({"addresses": addresses.into_iter().flatten().collect::<Vec<_>>()})
        }
        Answer::Refuted(EverySurfaceBreak::Curve { curves, curve, point }) => {
            let addresses = curves.get(*curve).and_then(|c| c.points.get(*point)).map(super::words::addresses);
            json!({"curve": curve, "addresses": addresses})
        }
        Answer::Proved(_) | Answer::Open(_) => Value::Null,
    };
    json!({
        "verdict": surface.every.verdict().word(),
        "claim": CLAIM,
        "by": by,
        "witness": witness,
        "reason": reasons::every_surface(surface),
    })
}
