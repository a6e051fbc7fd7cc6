//! Theorem 5″: tangent planes at a dense set of points of a surface, by finitely many checks.

use super::branch::Setting;
use super::place::Chart;
use super::tensor::Product;
use super::verdict::{Surface, SurfaceDense, SurfacePoint};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::linalg::{Matrix, closures};
use crate::theorem::{Assertion, Claim, Context, Reason, Seen, Statement, Verdict, Viewpoint};

/// Largest dimension of the space of bivectors in which density is decided.
const MAX_BIVECTORS: usize = 300;

/// Adds the claim about the dense set, and its evidence.
pub fn claim(
    setting: &Setting,
    chart: &Chart,
    product: Option<&Product>,
    surface: &mut Surface,
    claims: &mut Vec<Claim>,
) {
    let Some(mut dense) = evidence(setting, chart, product) else { return };
    let folded = dense.injective.iter().find(|(_, _, ok)| !ok).map(|&(state, letter, _)| (state, letter));
    let seen = if dense.view_injective { Seen::Injective } else { Seen::Projected };
    let claim = if let Some((state, letter)) = folded {
        Claim::open(Assertion::DensePlanes { seen }, Reason::SurfaceNotInjective { state, letter })
    } else if let Some(k) = dense.vertices.iter().position(|(_, p)| p.verdict != Verdict::Proved) {
        Claim::open(Assertion::DensePlanes { seen }, Reason::VertexInside(k))
    } else {
        dense.everywhere = dense.view_injective || bivectors_reach(setting, &dense);
        let seen = if dense.everywhere && !dense.view_injective { Seen::Everywhere } else { seen };
        Claim::proved(Assertion::DensePlanes { seen }, Some(Statement::Theorem5Surface))
    };
    surface.dense = Some(dense);
    claims.push(claim);
}

fn evidence(setting: &Setting, chart: &Chart, product: Option<&Product>) -> Option<SurfaceDense> {
    let cx = &setting.cx;
    let mut dense =
        SurfaceDense { injective: Vec::new(), view_injective: false, vertices: Vec::new(), everywhere: false };
    for e in cx.shape.reachable() {
        for (letter, piece) in cx.shape.states[e].pieces.iter().enumerate() {
            let onto = &cx.spaces.of(e).visible * &cx.spaces.linear(&piece.op, e, piece.target);
            dense.injective.push((e, letter, onto.rank() == cx.spaces.of(piece.target).visible.rows()));
        }
        dense.vertices.push((e, vertex_inside(setting, chart, product, e)?));
    }
    let start = cx.spaces.of(cx.from.root());
    dense.view_injective = (cx.from.map() * &start.basis).rank() == start.visible.rows();
    Some(dense)
}

/// A vertex inside a face in its visible quotient: the first that is proved, or the first.
fn vertex_inside(setting: &Setting, chart: &Chart, product: Option<&Product>, state: usize) -> Option<SurfacePoint> {
    let cx = Context { from: Viewpoint::quotient(setting.cx.spaces, state), ..setting.cx };
    let own = Setting { cx, ..*setting };
    let mut first = None;
    for param in chart.inner_nodes(state) {
        let addresses = chart.addresses(state, &param)?;
        let mut point = super::conclude(&own, chart.spot(state, &param), Some(param), &addresses)?;
        // The product of two curves has one state, so that its theorem applies in the quotient as well.
        if let Some(product) = product.filter(|_| point.verdict != Verdict::Proved) {
            super::tensor::add(&mut point, product, &own);
        }
        if point.verdict == Verdict::Proved {
            return Some(point);
        }
        first.get_or_insert(point);
    }
    first
}

/// Whether every cell contains a vertex whose plane survives the projection: the planes' bivectors span an invariant family
/// `(B_e)` of equal dimensions on which the maps are injective, and the control points do not kill it.
fn bivectors_reach(setting: &Setting, dense: &SurfaceDense) -> bool {
    family(setting, dense) == Some(true)
}

fn family(setting: &Setting, dense: &SurfaceDense) -> Option<bool> {
    let cx = &setting.cx;
    let states = cx.shape.reachable();
    let size = |e: usize| cx.spaces.of(e).visible.rows();
    let count = |e: usize| size(e) * (size(e).saturating_sub(1)) / 2;
    if states.iter().any(|&e| count(e) > MAX_BIVECTORS) {
        return None;
    }
    let mut spans: Vec<Matrix> = (0..cx.shape.states.len()).map(|_| Matrix::zero(0, 0)).collect();
    for &e in &states {
        let plane = dense.vertices.iter().find(|(s, _)| *s == e)?.1.tangent.clone()?;
        spans[e] = Matrix::from_rows(count(e), bivectors(&plane)?).echelon().rows;
    }
    // The maps on bivectors, in coordinates of the visible quotients.
    let mut maps = Vec::new();
    for &e in &states {
        for piece in &cx.shape.states[e].pieces {
            let onto = &cx.spaces.of(e).visible * &cx.spaces.linear(&piece.op, e, piece.target);
            let on_quotient = cx.spaces.of(piece.target).visible.transpose().solve(&onto.transpose())?;
            maps.push((piece.target, e, second_power(&on_quotient.transpose()).transpose()));
        }
    }
    let spans = closures(spans, &maps);
    // T_i is injective on W, hence on bivectors; equal dimensions make it onto.
    let equal = states.iter().all(|&e| spans[e].rows() == spans[cx.from.root()].rows());
    let start = cx.spaces.of(cx.from.root());
    let view = cx.from.map() * &start.basis;
    let on_quotient = start.visible.transpose().solve(&view.transpose())?.transpose();
    let seen = &spans[cx.from.root()] * &second_power(&on_quotient).transpose();
    Some(equal && !seen.is_zero())
}

/// The rational vectors that span the smallest rational space with the bivector of the plane.
fn bivectors(plane: &super::Subspace) -> Option<Vec<Vec<Rational>>> {
    let reduced = plane.reduced();
    let [a, b] = &reduced.generators[..] else { return None };
    let root = if a.rational().is_some() { &b.root } else { &a.root };
    if !root.is_real() || (a.rational().is_none() && b.rational().is_none() && !a.root.same(&b.root)) {
        return None;
    }
    let f = root.minpoly();
    let n = a.coords.len();
    let mut entries = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            entries.push(a.coords[i].mul(&b.coords[j], f).sub(&a.coords[j].mul(&b.coords[i], f)));
        }
    }
    let degree = f.degree().expect("a minimal polynomial is not 0");
    Some((0..degree).map(|k| entries.iter().map(|e: &Elem| e.0.coeff(k)).collect()).collect())
}

/// The matrix on bivectors: its 2x2 minors, pairs in lexicographic order.
fn second_power(m: &Matrix) -> Matrix {
    let pairs = |n: usize| (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j))).collect::<Vec<_>>();
    let (rows, cols) = (pairs(m.rows()), pairs(m.cols()));
    Matrix::from_fn(rows.len(), cols.len(), |r, c| {
        let ((i, j), (k, l)) = (rows[r], cols[c]);
        &m[(i, k)] * &m[(j, l)] - &m[(i, l)] * &m[(j, k)]
    })
}
