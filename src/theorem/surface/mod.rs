//! Surfaces: tangent planes at the points of a patch complex (theory §5, §7, §9).

mod apart;
mod branch;
mod dense;
mod derivative;
mod edges;
mod every;
mod forms;
mod glue;
mod place;
mod span;
mod star_space;
mod stars;
mod tensor;
mod verdict;
mod winding;

pub use branch::leading_functionals;
pub use derivative::PatchDerivative;
pub use every::{EverySurface, EverySurfaceBreak, EverySurfaceProof, around_vertex};
pub use forms::SurfaceForms;
pub use place::{Param, Spot};
pub use span::{Rank, Subspace};
pub use stars::{Child, Star, Stars};
pub use tensor::{factors, product_point};
pub use verdict::{
    Bivectors, ProductEvidence, ProductFactor, Surface, SurfaceBranch, SurfaceDense, SurfaceOutcome, SurfacePoint,
    SurfaceWitness, Winding,
};

use super::{
    AboutPlane, Assertion, Certified, Claim, Context, Dimension, ModelError, PlaneGap, Reason, Seen, Statement,
    Verdict, Viewpoint, rational_contraction, state_report, without_contraction,
};
use crate::answer::Answer;
use crate::budget::Budget;
use crate::shape::{Address, Balls, CellKind, Complex, Contraction, Spaces};
use branch::{Setting, examine};
use place::Chart;

/// Products of more coordinates have a smaller budget for the general ring condition.
const LARGE_PRODUCT: usize = 16;

/// Certifies a surface: the tangent plane at the vertices of the first level, at the addresses, and at a dense set.
///
/// The shape starts at a face, or at a set whose pieces are faces (the disc around a vertex). For any other shape the
/// answer is that of [`super::certify`].
///
/// # Errors
/// [`ModelError`] where the shape is not a model, an identity fails, it does not contract, or an address does not exist.
///
/// # Cost
/// As for [`super::certify`], for each branch of each point examined.
pub fn certify_complex(complex: &Complex, addresses: &[Address]) -> Result<Certified, ModelError> {
    certify_complex_within(complex, addresses, &Budget::default())
}

/// As [`certify_complex`] with a budget of its own.
///
/// # Errors
/// As [`certify_complex`].
pub fn certify_complex_within(
    complex: &Complex,
    addresses: &[Address],
    budget: &Budget,
) -> Result<Certified, ModelError> {
    let shape = &complex.shape;
    let faces = shape.reachable().into_iter().any(|e| shape.states[e].kind == CellKind::Face);
    if !faces || matches!(shape.states[shape.start].kind, CellKind::Edge | CellKind::Vertex) {
        return super::certify_within(shape, addresses, budget);
    }
    shape.check()?;
    complex.check()?;
    let product = tensor::Product::of(complex, budget);
    let (words, norm) = rational_contraction(shape, budget)?;
    let contraction = match &product {
        Some(product) if !words.is_proved() => Contraction::Product(product.contraction()),
        _ => words,
    };
    if !contraction.is_proved() {
        return Ok(without_contraction(&contraction, norm));
    }
    let spaces = Spaces::new(shape).ok_or(ModelError::FixedPoint)?;
    let Some(balls) = Balls::of(shape, &spaces, &contraction) else {
        return Ok(without_contraction(&contraction, None));
    };
    let balls = balls.with_simplex(shape);
    let hulls = std::cell::OnceCell::new();
    let from = Viewpoint::start(shape);
    let cx = Context { shape, base: &(), spaces: &spaces, balls: &balls, hulls: &hulls, from, budget };
    let chart = Chart::new(complex);
    let quick = product.is_some() && shape.states[shape.start].dim > LARGE_PRODUCT;
    let setting = Setting { cx, complex, chart: chart.as_ref().ok(), quick };
    let mut asked = Vec::new();
    for address in addresses {
        asked.push(address.normalise(shape, shape.start)?);
    }
    let mut found = Certified::nothing(&contraction);
    found.states = shape.reachable().into_iter().map(|e| state_report(&setting.cx, e)).collect();
    let mut surface = Surface {
        points: Vec::new(),
        dense: None,
        factors: None,
        unparametrised: chart.as_ref().err().copied(),
        simplex: balls.in_simplex(),
        every: Answer::Open(Vec::new()),
    };
    let start_is_face = shape.states[shape.start].kind == CellKind::Face;
    let faces = chart.as_ref().ok();
    let chart = faces.filter(|_| start_is_face);
    match chart {
        Some(chart) => parametrised(&setting, chart, product.as_ref(), &asked, &mut surface, &mut found.claims),
        None => branches_only(&setting, &asked, &mut surface, &mut found.claims),
    }
    let (every, claim) = every::claim(&setting, faces, product.as_ref(), &surface);
    surface.every = every;
    if let Answer::Proved(EverySurfaceProof::Derivative(_)) = &surface.every {
        // Planes at every point are planes at a dense set.
        let open = |c: &&mut Claim| matches!(c.what, Assertion::DensePlanes { .. }) && c.verdict() != Verdict::Proved;
        found.claims.iter_mut().filter(open).for_each(|c| {
            *c = Claim::proved(Assertion::DensePlanes { seen: Seen::Injective }, Some(Statement::PatchDerivative));
        });
    }
    found.claims.push(claim);
    found.claims.sort_by_key(|c| c.what.topic());
    found.polygons = setting.cx.polygons();
    surface.factors = product.as_ref().map(tensor::Product::factors);
    found.surface = Some(surface);
    found.verdict = found.overall();
    Ok(found)
}

/// The claims on a patch with parameters: the vertices of the first level, the dense set, and the addresses.
fn parametrised(
    setting: &Setting,
    chart: &Chart,
    product: Option<&tensor::Product>,
    asked: &[Address],
    surface: &mut Surface,
    claims: &mut Vec<Claim>,
) {
    let start = setting.cx.from.root();
    let nodes = chart.nodes(start, 1);
    let vertices: Vec<usize> =
        nodes.iter().filter_map(|param| add_point(setting, chart, param, None, product, surface)).collect();
    claims.push(at_vertices(&vertices, nodes.len(), surface));
    dense::claim(setting, chart, product, surface, claims);
    for address in asked {
        let param = chart.locate(start, address);
        let index = param.and_then(|param| add_point(setting, chart, &param, Some(address), product, surface));
        let about = match index.map(|k| &surface.points[k].spot) {
            Some(Spot::Branch) | None => AboutPlane::Crowded,
            Some(_) => AboutPlane::Surface,
        };
        claims.push(claim(about, address, index, surface));
    }
}

fn add_point(
    setting: &Setting,
    chart: &Chart,
    param: &Param,
    asked: Option<&Address>,
    product: Option<&tensor::Product>,
    surface: &mut Surface,
) -> Option<usize> {
    if let Some(known) = surface.points.iter().position(|p| p.parameter.as_ref() == Some(param)) {
        return Some(known);
    }
    let start = setting.cx.from.root();
    let mut point = match (chart.addresses(start, param), asked) {
        (Some(mut all), _) => {
            // The address that was asked for comes first.
            if let Some(at) = asked.and_then(|a| all.iter().position(|b| b == a)) {
                all.swap(0, at);
            }
            conclude(setting, chart.spot(start, param), Some(param.clone()), &all)?
        }
        (None, Some(address)) => conclude(setting, Spot::Branch, Some(param.clone()), std::slice::from_ref(address))?,
        (None, None) => return None,
    };
    if let Some(product) = product {
        tensor::add(&mut point, product, setting);
    }
    surface.points.push(point);
    Some(surface.points.len() - 1)
}

/// The claims on a shape without parameters: the fixed points of its own maps, and the addresses.
fn branches_only(setting: &Setting, asked: &[Address], surface: &mut Surface, claims: &mut Vec<Claim>) {
    let shape = setting.cx.shape;
    let pieces = shape.states[shape.start].pieces.iter().enumerate();
    let mut addresses: Vec<Address> =
        pieces.filter(|(_, p)| p.target == shape.start).map(|(i, _)| Address::periodic(vec![i])).collect();
    addresses.extend(asked.iter().cloned());
    let mut seen = std::collections::BTreeSet::new();
    addresses.retain(|a| seen.insert(a.clone()));
    for address in &addresses {
        let point = conclude(setting, Spot::Branch, None, std::slice::from_ref(address));
        let index = point.is_some().then_some(surface.points.len());
        surface.points.extend(point);
        claims.push(claim(AboutPlane::Branch, address, index, surface));
    }
}

fn claim(about: AboutPlane, address: &Address, index: Option<usize>, surface: &Surface) -> Claim {
    let what = Assertion::PlaneAt { address: address.clone(), about, point: index };
    let Some(index) = index else { return Claim::open(what, Reason::Unexamined) };
    let point = &surface.points[index];
    Claim::as_found(what, point.verdict, point.statement, Reason::SurfacePoint(index))
}

/// The claim about all vertices of the first level, of which there are `count`.
fn at_vertices(indices: &[usize], count: usize, surface: &Surface) -> Claim {
    let verdict = Verdict::all(count, indices.iter().map(|&i| surface.points[i].verdict));
    let with = indices.iter().copied().find(|&i| surface.points[i].verdict == verdict);
    let reason = with.map_or(Reason::TooManyCells, Reason::SurfaceVertex);
    Claim::as_found(Assertion::PlaneAtVertices, verdict, Some(Statement::SurfacePoint), reason)
}

/// Examines the branches of a point and adds up their tangent subspaces.
fn conclude(setting: &Setting, spot: Spot, parameter: Option<Param>, addresses: &[Address]) -> Option<SurfacePoint> {
    let branches: Vec<SurfaceBranch> = addresses.iter().map(|a| examine(setting, a)).collect::<Option<_>>()?;
    let position = setting.cx.shape.point(setting.cx.from.root(), &branches.first()?.address)?;
    let image = setting.cx.from.image(&position);
    let sum = branches.iter().fold(Subspace::default(), |s, b| s.join(&b.outcome.contains));
    let rank = sum.rank();
    let single = branches.iter().map(|b| b.outcome.dimension.at_least).fold(0, usize::max);
    let mut point = SurfacePoint {
        spot,
        parameter,
        position,
        image,
        verdict: Verdict::Undetermined,
        dimension: Dimension { at_least: rank.at_least.max(single), exact: false },
        tangent: None,
        product: None,
        statement: (branches.len() > 1).then_some(Statement::SurfacePoint),
        reason: None,
        branches,
    };
    if let [only] = &point.branches[..] {
        let o = &only.outcome;
        let both = o.depth.is_some() && o.dimension.exact;
        point.statement = if both { Some(Statement::BothBounds) } else { o.statement };
    }
    let known = point.branches.iter().all(|b| b.outcome.dimension.exact);
    if let (true, Some(dimension)) = (known, rank.exact()) {
        point.dimension = Dimension { at_least: dimension, exact: true };
        point.tangent = Some(sum);
    }
    (point.verdict, point.reason) = verdict(&point, known);
    Some(point)
}

fn verdict(point: &SurfacePoint, known: bool) -> (Verdict, Option<PlaneGap>) {
    let Dimension { at_least, exact } = point.dimension;
    let refuted = |gap| (Verdict::Refuted, Some(gap));
    match (exact, at_least) {
        (_, 3..) => return refuted(PlaneGap::Dimension),
        (true, 2) => return (Verdict::Proved, None),
        (true, 0) => return refuted(PlaneGap::SinglePoint),
        (true, _) => return refuted(PlaneGap::Line),
        (false, _) => {}
    }
    if known {
        return (Verdict::Undetermined, Some(PlaneGap::Agreement));
    }
    let open = point.branches.iter().position(|b| !b.outcome.dimension.exact);
    (Verdict::Undetermined, open.map(PlaneGap::Branch))
}
