//! The pictures of a report.

use super::words::{addresses, point_name};
use crate::case::Case;
use crate::picture::{self, Mark, MarkStyle, Picture};
use crate::theorem::{Certified, Kind, PointReport, Role, Verdict};

/// Most points that are marked in a picture.
const MAX_MARKS: usize = 12;

/// The attractor with the points examined and the rays found there; `None` where it cannot be drawn.
#[must_use]
pub fn attractor(case: &Case, found: &Certified) -> Option<Picture> {
    let marks: Vec<Mark> = found.points.iter().take(MAX_MARKS).map(mark).collect();
    let mut picture = picture::attractor(&case.shape, &case.title, &marks)?;
    let named: Vec<String> =
        found.points.iter().map(|p| format!("{}: {}", point_name(&case.shape, p), verdict_word(p))).collect();
    if !named.is_empty() {
        picture.alt = format!("{} {}.", picture.alt, named.join("; "));
    }
    Some(picture)
}

fn verdict_word(point: &PointReport) -> &'static str {
    match (point.verdict, point.kind) {
        (Verdict::Proved, Kind::None) => "tangent line",
        (Verdict::Undetermined, _) => "undetermined",
        (_, Kind::None) => "no tangent",
        (_, kind) => kind.word(),
    }
}

fn mark(point: &PointReport) -> Mark {
    let style = match (point.verdict, point.kind) {
        (_, Kind::Cusp) => MarkStyle::Cusp,
        (_, Kind::Corner) => MarkStyle::Corner,
        (Verdict::Proved, _) => MarkStyle::Tangent,
        _ => MarkStyle::Open,
    };
    let mut rays: Vec<Vec<f64>> = point.left.iter().chain(&point.right).map(|d| d.to_f64()).collect();
    if rays.is_empty()
        && let Some(line) = &point.tangent
    {
        rays = vec![line.to_f64(), line.negated().to_f64()];
    }
    let label = match point.role {
        Role::LeftEnd | Role::RightEnd | Role::Interior | Role::SetPoint => addresses(point).join(" = "),
        Role::Joint { .. } => addresses(point).join(" = "),
    };
    Mark { at: point.position.clone(), rays, style, label }
}
