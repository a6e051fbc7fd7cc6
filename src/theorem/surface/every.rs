//! Every point of a surface: tensor products of curves that are G¹, and patches with a derivative (theory §11.1).

use super::branch::Setting;
use super::derivative::{PatchDerivative, derivative};
use super::forms::{SurfaceForms, forms};
use super::place::{Chart, Spot};
use super::tensor::Product;
use super::verdict::{Surface, SurfacePoint};
use crate::answer::Answer;
use crate::shape::{CellKind, Shape, Spaces};
use crate::statement::Statement;
use crate::theorem::{
    Assertion, Certified, Claim, Dimension, EverySurfaceGap, Kind, PointReport, Reason, Verdict, Viewpoint,
};

/// Whether a surface is G¹: immersed, with a tangent plane at every point, up to its border, which turns continuously.
pub type EverySurface = Answer<EverySurfaceProof, EverySurfaceBreak, Vec<EverySurfaceGap>>;

/// Why a surface is G¹.
#[derive(Debug, Clone)]
pub enum EverySurfaceProof {
    /// It is the tensor product of these curves, which are G¹.
    Product(Box<[Certified; 2]>),
    /// It is C¹ in its parameters, and immersed.
    Derivative(Box<PatchDerivative>),
    /// There are cones around planes for all stars of its cells.
    Forms(Box<SurfaceForms>),
    /// It lies around a vertex at which Theorem 7 holds.
    Vertex {
        /// The valence.
        valence: usize,
        /// With control points that are not injective: how many rings of the disc were tested one by one.
        rings: Option<usize>,
    },
}

/// Why it is not.
#[derive(Debug, Clone)]
pub enum EverySurfaceBreak {
    /// There is no tangent plane at a point, by its index in [`Surface::points`].
    Point(usize),
    /// It is the tensor product of two curves, one of which breaks.
    Curve {
        /// The two curves.
        curves: Box<[Certified; 2]>,
        /// Which of them: 0 or 1.
        curve: usize,
        /// The index in [`Certified::points`] of the point of that curve.
        point: usize,
    },
}

/// The claim on every point, and what it rests on; of a surface without parameters nothing is decided.
pub fn claim(
    setting: &Setting,
    chart: Option<&Chart>,
    product: Option<&Product>,
    surface: &Surface,
) -> (EverySurface, Claim) {
    let every = match chart {
        Some(chart) => decide(setting, chart, product, surface),
        None => Answer::Open(vec![EverySurfaceGap::Unparametrised]),
    };
    let claim = claimed(&every, surface);
    (every, claim)
}

/// Settles what is open of every point of the surface around a vertex of a valence at which the hypotheses of Theorem 7 hold: of
/// the disc, or of a patch at the vertex, where control points are injective, or all rings of the disc are immersed after so many
/// of them were tested, and no point is known to have no tangent plane.
pub fn around_vertex(found: &mut Certified, shape: &Shape, valence: usize, rings: Option<usize>) {
    let Some(surface) = found.surface.as_mut().filter(|s| matches!(s.every, Answer::Open(_))) else { return };
    let injective = || {
        Spaces::new(shape).is_some_and(|spaces| {
            let basis = &spaces.of(shape.start).basis;
            (Viewpoint::start(shape).map() * basis).rank() == basis.cols()
        })
    };
    if rings.is_none() && !injective() {
        return;
    }
    surface.every = match surface.points.iter().any(|p| p.verdict == Verdict::Refuted) {
        true => Answer::Open(vec![EverySurfaceGap::Contradiction]),
        false => Answer::Proved(EverySurfaceProof::Vertex { valence, rings }),
    };
    let claim = claimed(&surface.every, surface);
    found.claims.iter_mut().filter(|c| c.what == Assertion::PlaneEverywhere).for_each(|c| *c = claim.clone());
}

fn claimed(every: &EverySurface, surface: &Surface) -> Claim {
    let by = match every {
        Answer::Proved(EverySurfaceProof::Product(_)) | Answer::Refuted(EverySurfaceBreak::Curve { .. }) => {
            Some(Statement::TensorEveryPoint)
        }
        Answer::Proved(EverySurfaceProof::Derivative(_)) => Some(Statement::PatchDerivative),
        Answer::Proved(EverySurfaceProof::Forms(_)) => Some(Statement::SurfaceCones),
        Answer::Proved(EverySurfaceProof::Vertex { .. }) => Some(Statement::VertexEveryPoint),
        Answer::Refuted(EverySurfaceBreak::Point(k)) => surface.points[*k].statement,
        Answer::Open(_) => None,
    };
    Claim::as_found(Assertion::PlaneEverywhere, every.verdict(), by, Reason::EverySurfacePoint)
}

fn decide(setting: &Setting, chart: &Chart, product: Option<&Product>, surface: &Surface) -> EverySurface {
    let by_product = match product {
        Some(product) => of_product(setting, product),
        None => Answer::Open(vec![EverySurfaceGap::NoProduct]),
    };
    let shape = setting.cx.shape;
    let found = match by_product {
        _ if shape.states[shape.start].kind != CellKind::Face => by_stars(setting, chart, Vec::new()),
        Answer::Open(gaps) => by_patch(setting, chart, surface, gaps),
        decided => decided,
    };
    match (found, surface.points.iter().position(broken)) {
        (Answer::Proved(_), Some(_)) => Answer::Open(vec![EverySurfaceGap::Contradiction]),
        (Answer::Open(_), Some(k)) => Answer::Refuted(EverySurfaceBreak::Point(k)),
        (answer, _) => answer,
    }
}

/// Of a branch alone it is not known what else comes to its point.
fn broken(p: &SurfacePoint) -> bool {
    p.verdict == Verdict::Refuted && p.spot != Spot::Branch
}

/// By the derivative in the parameters, or by cones around planes where no point is known that refutes.
fn by_patch(setting: &Setting, chart: &Chart, surface: &Surface, mut gaps: Vec<EverySurfaceGap>) -> EverySurface {
    match derivative(setting, chart) {
        Ok(found) => return Answer::Proved(EverySurfaceProof::Derivative(Box::new(found))),
        Err(gap) => gaps.push(gap),
    }
    match surface.points.iter().any(broken) {
        true => Answer::Open(gaps),
        false => by_stars(setting, chart, gaps),
    }
}

/// By cones around planes, of a patch, or of faces glued along sides.
fn by_stars(setting: &Setting, chart: &Chart, mut gaps: Vec<EverySurfaceGap>) -> EverySurface {
    match forms(setting, chart) {
        Ok(found) => return Answer::Proved(EverySurfaceProof::Forms(Box::new(found))),
        Err(gap) => gaps.push(gap),
    }
    Answer::Open(gaps)
}

/// The theorem on tensor products at every point.
fn of_product(setting: &Setting, product: &Product) -> EverySurface {
    let cx = &setting.cx;
    let basis = &cx.spaces.of(cx.from.root()).basis;
    if (cx.from.map() * basis).rank() != basis.cols() {
        return Answer::Open(vec![EverySurfaceGap::Folded]);
    }
    let Some(curves) = product.everywhere() else { return Answer::Open(vec![EverySurfaceGap::NoProduct]) };
    let broken = (0..2).find_map(|k| Some((k, witness(&curves[k])?)));
    if let Some((curve, point)) = broken {
        return Answer::Refuted(EverySurfaceBreak::Curve { curves: Box::new(curves), curve, point });
    }
    let smooth = |c: &Certified| c.everywhere.as_ref().is_some_and(|e| e.verdict == Verdict::Proved);
    match curves.iter().position(|c| !smooth(c)) {
        Some(k) => Answer::Open(vec![EverySurfaceGap::Curve(k)]),
        None => Answer::Proved(EverySurfaceProof::Product(Box::new(curves))),
    }
}

/// A point at which a curve that is refuted to be G¹ has more than a line, a cusp, or is oscillating.
fn witness(curve: &Certified) -> Option<usize> {
    let every = curve.everywhere.as_ref().filter(|e| e.verdict == Verdict::Refuted)?;
    every.witness.filter(|&k| breaks(&curve.points[k]))
}

fn breaks(point: &PointReport) -> bool {
    let turned = point.verdict == Verdict::Proved && matches!(point.kind, Kind::Cusp | Kind::Oscillating);
    turned || matches!(point.dimension, Dimension { at_least: 2.., .. }) && point.verdict == Verdict::Refuted
}
