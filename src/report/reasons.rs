//! The words of why branches, points, curves and surfaces are refuted or open.

use super::words::listed;
use crate::answer::Answer;
use crate::jordan::Scalar;
use crate::shape::word_text;
use crate::theorem::surface::{EverySurfaceBreak, Surface, SurfaceBranch, SurfacePoint};
use crate::theorem::{
    BranchGap, BranchReport, Certified, Defect, EveryGap, EverySurfaceGap, Everywhere, Hodograph, Kind, NoGerm,
    Outcome, PlaneGap, PointGap, PointReport, Role, TopRow, Turn,
};

/// Why there are no points of the shape near the point of a branch.
#[must_use]
pub fn no_germ(reason: NoGerm) -> &'static str {
    match reason {
        NoGerm::SinglePoint => "the cell of this address is a single point",
        NoGerm::NoSpace => "the relevant space is 0",
        NoGerm::Isolated { shape: true } => "the point is isolated in the shape: no tangent question arises",
        NoGerm::Isolated { shape: false } => "the point is isolated in this branch: no tangent question arises",
    }
}

/// Why it is not decided what follows at a branch of a curve or a set.
#[must_use]
pub fn branch(gap: BranchGap) -> &'static str {
    match gap {
        BranchGap::Folded => {
            "several directions of the largest modulus, which the control points may fold into one line"
        }
        BranchGap::RingFails => "the ring condition fails, but what follows for the tangent is not decided",
        other => either(other),
    }
}

/// Why it is not decided what follows at a branch of a surface.
#[must_use]
pub fn surface_branch(gap: BranchGap) -> &'static str {
    match gap {
        BranchGap::Folded => "the control points fold the directions of the largest modulus",
        BranchGap::RingFails => "the ring condition fails, but what follows for the tangent plane is not decided",
        other => either(other),
    }
}

fn either(gap: BranchGap) -> &'static str {
    match gap {
        BranchGap::NilpotentRing => {
            "L is nilpotent and the ring passes through the point: its germ is that of finitely many pieces"
        }
        BranchGap::NilpotentOpen => "L is nilpotent and it is not decided whether the ring passes through the point",
        BranchGap::NilpotentCells => {
            "L is nilpotent: the cells of this branch shrink to the point after finitely many turns"
        }
        BranchGap::Folded => "the control points fold directions",
        BranchGap::KernelPoint => "the branch is not isolated: a point of the ring falls into the generalised kernel",
        BranchGap::NotIsolated => "the branch is not isolated",
        BranchGap::IsolationOpen => "it is not decided whether the branch is isolated",
        BranchGap::RingOpen => "the ring condition is not decided in this cell",
        BranchGap::RingFails => "the ring condition fails, but what follows is not decided",
    }
}

/// Why a point of a curve or a set is refuted or open; `None` where it is proved.
#[must_use]
pub fn point<E: Scalar>(point: &PointReport<E>) -> Option<&'static str> {
    point.reason.map(|reason| match reason {
        PointGap::Dimension => "the tangent subspace has more than one dimension",
        PointGap::Spread => {
            "directions that the tangent subspaces of the two sides are known to contain lie on different lines"
        }
        PointGap::SidesDiffer => "the tangent lines of the two sides differ",
        PointGap::Branch(index) => point.branches.get(index).and_then(of_branch).unwrap_or(UNKNOWN),
    })
}

fn of_branch<E: Scalar>(report: &BranchReport<E>) -> Option<&'static str> {
    match report.outcome {
        Outcome::NoGerm { reason } => Some(no_germ(reason)),
        Outcome::Open { reason, .. } => Some(branch(reason)),
        Outcome::Line { .. } | Outcome::AtLeast { .. } => None,
    }
}

/// Evidence always says why it does not prove; this stands where it would not.
pub(super) const UNKNOWN: &str = "no reason was given";

/// Why a point of a surface is refuted or open; `None` where it is proved.
#[must_use]
pub fn plane(point: &SurfacePoint) -> Option<String> {
    let text = match point.reason? {
        PlaneGap::Dimension => "the tangent subspace has more than two dimensions",
        PlaneGap::SinglePoint => "the surface is a single point near this one",
        PlaneGap::Line => "the tangent subspace is a line: dimension 1, not a surface",
        PlaneGap::Agreement => {
            "the tangent subspaces of the branches are known, but it is not decided whether they agree"
        }
        PlaneGap::Contradiction => "the theorem on tensor products and the general one disagree: a mistake in secant",
        PlaneGap::ProductCurve => "one of the two curves has no tangent line there",
        PlaneGap::Branch(index) => return Some(point.branches.get(index).map_or_else(|| UNKNOWN.to_owned(), of_plane)),
    };
    Some(text.to_owned())
}

fn of_plane(branch: &SurfaceBranch) -> String {
    match &branch.outcome.open {
        Some((gap, _)) => format!("branch {}: {}", branch.address, surface_branch(*gap)),
        None => format!("branch {} is not decided", branch.address),
    }
}

/// The row of the table of theory §5 for surfaces.
#[must_use]
pub fn top_row(row: TopRow) -> &'static str {
    match row {
        TopRow::Empty => "no eigenvalue",
        TopRow::SinglePoint => "the cell is a single point",
        TopRow::Nilpotent => "nilpotent",
        TopRow::Simple => "one real simple eigenvalue alone in its modulus",
        TopRow::Pair => "one complex pair, semisimple",
        TopRow::Double => "a double real eigenvalue with two eigenvectors",
        TopRow::Opposite => "λ and −λ, both simple",
        TopRow::ManyVectors => "more than two eigenvectors of the largest modulus",
        TopRow::Block => "one longest Jordan block, of a real eigenvalue",
        TopRow::PairBlocks => "a complex pair with one longest Jordan block each",
        TopRow::TwoBlocks => "two longest Jordan blocks",
        TopRow::ManyBlocks => "more than two longest Jordan blocks",
    }
}

/// Why G¹ is refuted or open; `None` where it is proved.
#[must_use]
pub fn everywhere(found: &Certified, every: &Everywhere) -> Option<String> {
    Some(match every.reason? {
        EveryGap::Turn => {
            let turn = every.hodograph.as_ref().and_then(|h| Some((h, h.turns.first()?)));
            turn.map_or_else(|| UNKNOWN.to_owned(), |(h, t)| turning(h, t))
        }
        EveryGap::Broken(index) => found.points.get(index).map_or_else(|| UNKNOWN.to_owned(), broken),
        EveryGap::Unseen => {
            "no functional was found that is positive on the projected cones, so that this holds before the projection \
             only"
                .to_owned()
        }
        EveryGap::Joint => "a first-level joint is not decided".to_owned(),
        EveryGap::Obstacle => every.obstacle.as_ref().map_or_else(
            || UNKNOWN.to_owned(),
            |o| {
                let word = word_text(&o.word);
                format!("no strictly invariant cone exists: the cycle {word} has {}", defect(o.reason))
            },
        ),
        EveryGap::NoCone => "no common cone was found within the budget".to_owned(),
    })
}

/// Why it is refuted or open that a surface is G¹; `None` where it is proved.
#[must_use]
pub fn every_surface(surface: &Surface) -> Option<String> {
    match &surface.every {
        Answer::Proved(_) => None,
        Answer::Refuted(EverySurfaceBreak::Point(index)) => Some(match surface.points.get(*index) {
            Some(point) => {
                let why = plane(point).unwrap_or_else(|| UNKNOWN.to_owned());
                let at = point.branches.first().map_or_else(String::new, |b| format!("at {}: ", b.address));
                format!("{at}{why}")
            }
            None => UNKNOWN.to_owned(),
        }),
        Answer::Refuted(EverySurfaceBreak::Curve { curves, curve, point }) => {
            let found = curves.get(*curve).and_then(|c| c.points.get(*point));
            let what = found.map_or_else(|| UNKNOWN.to_owned(), broken);
            Some(format!("{} curve of the product: {what}", ordinal(*curve)))
        }
        Answer::Open(gaps) if gaps.is_empty() => Some(UNKNOWN.to_owned()),
        Answer::Open(gaps) => Some(gaps.iter().map(every_surface_gap).collect::<Vec<_>>().join("; ")),
    }
}

fn ordinal(curve: usize) -> &'static str {
    if curve == 0 { "the first" } else { "the second" }
}

fn every_surface_gap(gap: &EverySurfaceGap) -> String {
    match gap {
        EverySurfaceGap::Unparametrised => {
            "the shape has no parameters: it starts at no face, or its faces are not divided evenly".to_owned()
        }
        EverySurfaceGap::NoProduct => {
            "the patch is no tensor product of two curves of one state, or a cell of one of them may be a point".to_owned()
        }
        EverySurfaceGap::Folded => {
            "the tensor product is seen through control points that fold some of its relevant space".to_owned()
        }
        EverySurfaceGap::Curve(curve) => {
            format!("it is not decided whether {} curve of the product is G¹", ordinal(*curve))
        }
        EverySurfaceGap::Large => "there are too many coordinates for the derivative in the parameters".to_owned(),
        EverySurfaceGap::Unequal => {
            "in the parameters, not all pieces that lead back to their face have one size along both sides".to_owned()
        }
        EverySurfaceGap::Radius => {
            "the joint spectral radius on the differences of the derivative is not seen to be below the size of the pieces"
                .to_owned()
        }
        EverySurfaceGap::Edge { letters: [i, j], .. } => {
            format!("the derivatives on the two sides of the edge between the pieces {i} and {j} of a face differ")
        }
        EverySurfaceGap::Rank => {
            "the derivative in the parameters is continuous, but the control points are not seen to keep its rank".to_owned()
        }
        EverySurfaceGap::LargeStars => "there are too many stars of cells, or coordinates, for cones around planes".to_owned(),
        EverySurfaceGap::NoForms { star } => {
            let cells: Vec<String> = star.iter().map(|word| word_text(word)).collect();
            format!(
                "no quadratic forms of signature (2, ·) were found that all stars of cells expand from their children; a star \
                 without one first occurs at the cells {}",
                listed(&cells)
            )
        }
        EverySurfaceGap::Secants => {
            "the quadratic forms that were found are not seen to be positive on all secants between cells that do not meet"
                .to_owned()
        }
        EverySurfaceGap::Folds => {
            "there are cones around planes at every point, but the control points are not seen to keep them".to_owned()
        }
        EverySurfaceGap::Contradiction => {
            "the proof for every point and the tangent subspace of a point disagree: a mistake in secant"
                .to_owned()
        }
    }
}

/// What is wrong with the leading eigenvalues of a cycle.
#[must_use]
pub fn defect(defect: Defect) -> &'static str {
    match defect {
        Defect::Nilpotent => "no eigenvalue but 0",
        Defect::Complex => "complex eigenvalues of largest modulus",
        Defect::Several => "eigenvalues of equal largest modulus",
        Defect::Multiple => "a multiple eigenvalue of largest modulus",
        Defect::Negative => "a negative leading eigenvalue",
    }
}

/// What breaks at a point.
/// What breaks G¹ at a point.
#[must_use]
pub fn broken<E: Scalar>(point: &PointReport<E>) -> String {
    let what = match point.kind {
        Kind::Cusp => "the half-tangents of both sides are the same ray: a cusp",
        Kind::Oscillating => "both rays of the line are limits of secants of one side",
        Kind::Corner => "the half-tangents of the two sides lie on different lines: a corner",
        _ => "there is no tangent line",
    };
    format!("at {} {what}", place(point))
}

/// Where a point lies.
fn place<E: Scalar>(point: &PointReport<E>) -> String {
    let after = |path: &[usize]| match path {
        [] => String::new(),
        path => format!(" in cell {}", word_text(path)),
    };
    match (&point.role, point.branches.first()) {
        (Role::LeftEnd, _) => "the left end".to_owned(),
        (Role::RightEnd, _) => "the right end".to_owned(),
        (Role::Joint { path, left, right, .. }, _) => {
            format!("the joint of pieces {left} and {right}{}", after(path))
        }
        (_, Some(branch)) => format!("the point with the address {}", branch.address),
        (_, None) => "a point".to_owned(),
    }
}

/// What happens where the derivative of a polynomial curve turns.
fn turning(hodograph: &Hodograph, turn: &Turn) -> String {
    let arc = |k: usize| match hodograph.spans.len() {
        1 => String::new(),
        _ => format!(" of arc {k}"),
    };
    match turn {
        Turn::Inside(k, root) => {
            let t = root.rational().map_or_else(
                || format!("≈ {:.6} (a root of {})", root.to_f64().0, root.minpoly().display("t")),
                |t| t.to_string(),
            );
            format!("at the parameter {t}{} the derivative changes to the opposite direction: a cusp", arc(*k))
        }
        Turn::Between(k) => format!("between the arcs {k} and {} the direction of travel changes", k + 1),
    }
}

/// The arcs of a polynomial curve.
#[must_use]
pub fn arcs(hodograph: &Hodograph) -> String {
    let spans = &hodograph.spans;
    let degree = spans.iter().flat_map(|s| s.coordinates.iter().filter_map(crate::poly::Poly::degree)).max();
    let degree = degree.map_or_else(String::new, |d| format!(" of degree at most {d}"));
    let zeros: Vec<String> = spans
        .iter()
        .enumerate()
        .filter(|(_, s)| s.divisor.degree().is_some_and(|d| d > 0))
        .map(|(k, s)| format!("{} (arc {k})", s.divisor.display("t")))
        .collect();
    let where_zero = if zeros.is_empty() {
        "its derivative vanishes nowhere".to_owned()
    } else {
        format!("the components of its derivative have the common divisors {}", zeros.join(", "))
    };
    let arcs = if spans.len() == 1 { "1 arc".to_owned() } else { format!("{} arcs", spans.len()) };
    format!("a polynomial curve of {arcs}{degree}; {where_zero}")
}
