//! The words and formulas for surfaces: planes, points, branches.

use super::document::{Block, Inline, Line, line, words};
use super::math::Math;
use super::reasons;
use super::values::{decimals_math, direction_math, is_rational, root_math};
use super::words::{cell, count, dimension, mark, ring_proof, spectrum_line, statement};
use crate::arith::Rational;
use crate::theorem::surface::{
    Spot, Subspace, Surface, SurfaceBranch, SurfaceOutcome, SurfacePoint, SurfaceWitness, Winding,
};
use crate::theorem::{Direction, Verdict, Witness};

/// How many classes of eigenvalues are shown without `--verbose`.
const CLASSES: usize = 3;

/// One generator of a subspace, exactly.
fn generator(d: &Direction) -> Line {
    let exact = direction_math(d);
    if is_rational(d) {
        return vec![Inline::Math(exact)];
    }
    if d.root.is_real() {
        return super::words::direction(d);
    }
    let parts = Subspace { generators: vec![d.clone()] }.to_f64();
    let decimal = |v: &Vec<f64>| decimals_math(&v.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>());
    let values = [vec![exact, root_math(&d.root)], parts.iter().map(decimal).collect()].concat();
    line("the real and the imaginary part of $@$ with $λ=@$, which are $≈@$ and $≈@$", values)
}

/// Vectors that span a subspace.
#[must_use]
pub fn span(space: &Subspace) -> Line {
    let mut out = Line::new();
    for (k, g) in space.generators.iter().enumerate() {
        if k > 0 {
            out.extend(words(if k + 1 == space.generators.len() { " and " } else { ", " }));
        }
        out.extend(generator(g));
    }
    out
}

/// What a point is called: `Corner 0`, `Point inside side 1`.
#[must_use]
pub fn point_name(point: &SurfacePoint) -> String {
    match point.spot {
        Spot::Corner(k) => format!("Corner {k}"),
        Spot::Side(k) => format!("Point inside side {k}"),
        Spot::Inside if point.branches.len() > 2 => "Vertex inside the patch".to_owned(),
        Spot::Inside if point.branches.len() == 2 => "Point on an edge inside the patch".to_owned(),
        Spot::Inside => "Point inside the patch".to_owned(),
        Spot::Branch => "Point".to_owned(),
    }
}

/// The addresses of the branches of a point.
#[must_use]
pub fn head(point: &SurfacePoint) -> Line {
    let mut out = words(format!("{}, address ", point_name(point)));
    for (k, branch) in point.branches.iter().enumerate() {
        if k > 0 {
            out.extend(words(" = "));
        }
        out.push(Inline::Code(branch.address.to_string()));
    }
    out
}

/// A witness in words.
#[must_use]
pub fn witness(w: &SurfaceWitness) -> Line {
    match w {
        SurfaceWitness::Points(points) => {
            let mut out = words("the leading functionals vanish at ");
            for (k, (address, offset)) in points.iter().enumerate() {
                if k > 0 {
                    out.extend(words(", "));
                }
                out.extend(line(&format!("`{address}` ($x=@$)"), [Math::vector(offset)]));
            }
            out
        }
        SurfaceWitness::SignChange(w @ Witness::SignChange { .. }) => super::words::witness(w),
        SurfaceWitness::SignChange(_) => words("the leading functional changes its sign on a piece of the ring"),
        SurfaceWitness::Winding(Winding { cell: at, number, path }) => line(
            &format!(
                "the leading functionals have a common zero in the cell {}: the image of its boundary, followed through {}, winds around 0 $@$",
                cell(at),
                count(path.len(), "cell")
            ),
            [Math::number(&Rational::from(*number))],
        )
        .into_iter()
        .chain(words(if number.abs() == 1 { " time" } else { " times" }))
        .collect(),
    }
}

/// What follows at a branch, in one line.
#[must_use]
pub fn outcome(o: &SurfaceOutcome) -> Line {
    let mut out = words(reasons::top_row(o.row));
    if let Some(s) = o.statement {
        out.extend(words(format!("; {}", statement(s))));
    }
    if let Some(proof) = &o.ring {
        out.extend(words(format!("; {}", ring_proof(proof))));
    }
    if let Some(w) = &o.witness {
        out.extend(words("; "));
        out.extend(witness(w));
    }
    if let Some((depth, proof)) = &o.depth {
        let cells = count(proof.discharged.len(), "cell");
        out.extend(line(&format!("; $0∉π_@(X)$ on {cells}"), [Math::count(*depth)]));
    }
    if let Some((reason, place)) = &o.open {
        out.extend(words(format!("; not decided: {}", reasons::surface_branch(*reason))));
        if let Some(place) = place {
            out.extend(line(&format!(" (cell {})", cell(place)), []));
        }
    }
    out
}

/// The verdict on a point, with the dimension and the reason.
#[must_use]
pub fn verdict(point: &SurfacePoint) -> Line {
    let mut out = vec![mark(point.verdict)];
    if point.verdict == Verdict::Proved {
        out.extend(words(": "));
        out.push(Inline::Strong("tangent plane".to_owned()));
    }
    out.extend(words(", "));
    out.extend(dimension(point.dimension));
    if let Some(reason) = reasons::plane(point) {
        out.extend(words(format!("; {reason}")));
    }
    out
}

/// The name of a tangent subspace of known dimension.
fn tangent_name(space: &Subspace) -> &'static str {
    match space.rank().exact() {
        Some(1) => "tangent line",
        Some(2) => "tangent plane",
        _ => "tangent subspace",
    }
}

/// The points of a surface for the short report.
#[must_use]
pub fn summary(surface: &Surface, verbose: bool) -> Vec<Block> {
    let mut blocks = Vec::new();
    for point in &surface.points {
        let mut facts = vec![("verdict".to_owned(), verdict(point))];
        let place = point.image.as_ref().unwrap_or(&point.position);
        facts.push(("point".to_owned(), vec![Inline::Math(Math::vector(place))]));
        if let Some(param) = &point.parameter {
            facts.push(("parameters".to_owned(), vec![Inline::Math(Math::vector(param))]));
        }
        if let Some(space) = point.tangent.as_ref().filter(|s| !s.generators.is_empty()) {
            facts.push((tangent_name(space).to_owned(), span(space)));
            if let Some(normal) = space.normal() {
                facts.push(("normal".to_owned(), vec![Inline::Math(Math::vector(&normal))]));
            }
        }
        let mut shown: Vec<&SurfaceBranch> = Vec::new();
        for branch in &point.branches {
            let same = |b: &&SurfaceBranch| b.linear == branch.linear && b.address.cycle == branch.address.cycle;
            if verbose || !shown.iter().any(same) {
                shown.push(branch);
            }
        }
        for branch in &shown {
            let name = |text: &str| {
                if shown.len() > 1 { format!("{text} at {}", branch.address) } else { text.to_owned() }
            };
            let most = if verbose { usize::MAX } else { CLASSES };
            facts.push((name("spectrum"), spectrum_line(&branch.spectrum, most)));
            facts.push((name("theorem"), outcome(&branch.outcome)));
        }
        if let Some(product) = &point.product {
            facts.push(("tensor product".to_owned(), product_line(product)));
        }
        blocks.push(Block::Heading(3, head(point)));
        blocks.push(Block::Facts(facts));
    }
    blocks
}

/// What the theorem on tensor products says, in one line.
#[must_use]
pub fn product_line(product: &crate::theorem::surface::ProductEvidence) -> Line {
    let curve = |p: &crate::theorem::PointReport| format!("{} ({})", p.verdict.word(), p.kind.word());
    let mut out = vec![mark(product.verdict)];
    out.extend(words(format!(
        ": tangent lines of the two curves {} and {}",
        curve(&product.first),
        curve(&product.second)
    )));
    if let Some(plane) = &product.tangent {
        out.extend(words("; plane of "));
        out.extend(span(plane));
    }
    out
}
