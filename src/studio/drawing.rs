//! What the page draws before anything is proved: points of the shape as floats, and control points as exact numbers.
#![allow(clippy::float_arithmetic, reason = "pictures decide nothing")]

use super::input::Asked;
use crate::algebraic::Real;
use crate::arith::to_f64;
use crate::case::{Case, Question, Subject};
use crate::mesh::{Model, Scheme, refined};
use crate::picture::{Projection, outline};
use crate::report::reported::Reported;
use crate::shape::{Frame, Shape, depth_within, sample};
use serde::Serialize;

/// Most faces of a surface that is drawn.
const FACES: usize = 1_100;
/// Most faces of a mesh after its steps.
const MESH_FACES: usize = 6_000;

/// A shape for the canvas of the page.
#[derive(Debug, Default, Serialize)]
pub struct Drawing {
    /// `curve`, `set`, `surface`, `vertices` or `mesh`.
    pub kind: &'static str,
    /// One line for people.
    pub title: String,
    /// The text that is examined.
    pub text: String,
    /// Points in the plane: of a curve in its order.
    pub points: Vec<[f32; 2]>,
    /// Corners of the control polygon as they are drawn.
    pub polygon: Vec<[f32; 2]>,
    /// Points in space.
    pub vertices: Vec<[f32; 3]>,
    /// Faces by the numbers of their corners.
    pub faces: Vec<Vec<u32>>,
    /// The control points, exactly; `null` where there are none.
    pub control: Option<Vec<Vec<String>>>,
    /// Whether control points can be given: not to affine maps and meshes.
    pub free: bool,
    /// How it was projected; or why nothing is drawn.
    pub words: String,
}

/// The drawing of what was asked about.
pub fn drawing(asked: &Asked) -> Drawing {
    let text = asked.text().text.to_string();
    match asked {
        Asked::Mesh { model, scheme, .. } => Drawing { text, ..mesh(model, *scheme) },
        Asked::Case(question @ Question::Vertices { .. }) => Drawing {
            kind: "vertices",
            title: question.title().to_owned(),
            text,
            words: "The characteristic maps are drawn with the proof.".to_owned(),
            ..Drawing::default()
        },
        // Control points are moved where they are rational.
        Asked::Case(question @ Question::OverField { case, .. }) => {
            let kind = if question.subject() == Subject::Curve { "curve" } else { "set" };
            let control = control(&case.shape, |x: &Real| x.field().is_none());
            Drawing {
                title: question.title().to_owned(),
                text,
                free: free(&case.shape) && (control.is_some() || case.shape.control.is_none()),
                control,
                ..flat(&Reported::drawn(&case.shape), kind)
            }
        }
        Asked::Case(question @ Question::Tangents { case, .. }) => {
            let shape = match question.subject() {
                Subject::Surface => surface(case),
                Subject::Curve => flat(&case.shape, "curve"),
                Subject::Set | Subject::Vertices => flat(&case.shape, "set"),
            };
            Drawing {
                title: question.title().to_owned(),
                text,
                control: control(&case.shape, |_| true),
                free: free(&case.shape),
                ..shape
            }
        }
    }
}

/// The control points, exactly, where each number is one that the page can write.
fn control<E: Reported>(shape: &Shape<E>, writable: impl Fn(&E) -> bool) -> Option<Vec<Vec<String>>> {
    let points =
        shape.control.as_ref().filter(|m| shape.frame == Frame::Barycentric && m.entries().iter().all(&writable))?;
    let point = |j: usize| (0..points.rows()).map(|i| points[(i, j)].to_string()).collect();
    Some((0..points.cols()).map(point).collect())
}

fn free<E: Reported>(shape: &Shape<E>) -> bool {
    shape.frame == Frame::Barycentric
}

fn short(points: &[[f64; 2]]) -> Vec<[f32; 2]> {
    points.iter().map(|p| p.map(|x| x as f32)).collect()
}

fn flat(shape: &Shape, kind: &'static str) -> Drawing {
    match outline(shape) {
        Some(found) => Drawing {
            kind,
            points: short(&found.points),
            polygon: short(&found.polygon),
            words: found.words.to_owned(),
            ..Drawing::default()
        },
        None => Drawing {
            kind,
            words: "No point of the shape can be computed, because it does not contract as far as is known.".to_owned(),
            ..Drawing::default()
        },
    }
}

/// A point of a surface in space: its coordinates, or where it is drawn in the plane.
pub fn place(shape: &Shape, point: &[f64]) -> [f32; 3] {
    match shape.control.as_ref().map(crate::linalg::Matrix::rows) {
        Some(3) => [0, 1, 2].map(|k| point.get(k).copied().unwrap_or(0.0) as f32),
        _ => {
            let [x, y] = Projection::of(shape).direction(point);
            [x as f32, y as f32, 0.0]
        }
    }
}

fn surface(case: &Case) -> Drawing {
    let depth = depth_within(&case.shape, FACES);
    let Some(found) = sample(&case.complex(), depth, &mut |_| crate::stop::check()) else {
        let words =
            "No point of the surface can be computed, because it does not contract as far as is known.".to_owned();
        return Drawing { kind: "surface", words, ..Drawing::default() };
    };
    let vertices = found.points.iter().map(|p| place(&case.shape, &p.iter().map(to_f64).collect::<Vec<_>>())).collect();
    let faces = found.faces.iter().map(|(corners, _)| corners.iter().map(|k| *k as u32).collect()).collect();
    let words = format!("{} faces of points of the surface, in the space of the control points.", found.faces.len());
    Drawing { kind: "surface", vertices, faces, words, ..Drawing::default() }
}

fn mesh(model: &Model, scheme: Scheme) -> Drawing {
    let fits = |steps: &usize| model.topology.faces().saturating_mul(4_usize.pow(*steps as u32)) <= MESH_FACES;
    let steps = (1..=4).take_while(fits).last().unwrap_or(0);
    // Loop's steps need triangles; where there are others the proof says so.
    let triangles = (0..model.topology.faces()).all(|f| model.topology.polygon(f).len() == 3);
    let steps = if scheme.triangles() && !triangles { 0 } else { steps };
    let (points, faces) = refined(model, scheme, steps);
    let words = format!("The mesh after {steps} steps of {}: {} faces.", scheme.name(), faces.len());
    Drawing {
        kind: "mesh",
        title: model.name.clone(),
        vertices: points.iter().map(|p| p.map(|x| if x.is_finite() { x as f32 } else { 0.0 })).collect(),
        faces,
        words,
        ..Drawing::default()
    }
}
