//! The table of results on the first page.

use super::super::document::{Block, Line, Table, code, formula, line, words};
use super::super::math::Math;
use super::super::reported::{Reported, vector};
use super::super::surface::{point_name as surface_point_name, span};
use super::super::words::{addresses, count, direction, mark, point_name};
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Entry;
use crate::shape::{Address, Shape};
use crate::theorem::surface::{Subspace, Surface, SurfacePoint};
use crate::theorem::{Certified, PointReport};

/// More points are left to the section about them.
const MAX_ROWS: usize = 16;
/// Vectors with more coordinates stand in the section about their point only.
const LONGEST: usize = 8;

/// One row for every examined point.
pub(in crate::report) fn table<E: Reported>(case: &Case<E>, found: &Certified<E>) -> Option<Block> {
    let (header, mut rows) = match &found.surface {
        Some(surface) => (["point", "address", "parameters", "found", "tangent plane"], surface_rows(surface)),
        None => (
            ["point", "address", "parameter", "found", "tangent line"],
            found.points.iter().map(|p| row(case, p)).collect::<Vec<_>>(),
        ),
    };
    if rows.is_empty() {
        return None;
    }
    let all = rows.len();
    rows.truncate(MAX_ROWS);
    let caption = if all > MAX_ROWS {
        words(format!("The first {MAX_ROWS} of {all} examined points"))
    } else {
        words("The examined points")
    };
    Some(Block::Table(Table { caption, header: header.map(words).to_vec(), rows }))
}

fn row<E: Reported>(case: &Case<E>, point: &PointReport<E>) -> Vec<Line> {
    let parameter = point.branches.first().and_then(|b| parameter(&case.shape, &b.address));
    let mut result = vec![mark(point.verdict)];
    if point.kind.has_rays() {
        result.extend(words(format!(", {}", point.kind.word())));
    }
    vec![
        words(point_name(&case.shape, point)),
        code(addresses(point).join(" = ")),
        parameter.map_or_else(|| words("–"), |t| formula(Math::number(&t))),
        result,
        point.tangent.as_ref().map_or_else(|| words("–"), direction),
    ]
}

fn surface_rows(surface: &Surface) -> Vec<Vec<Line>> {
    let row = |point: &SurfacePoint| {
        let address = point.branches.first().map_or_else(String::new, |b| b.address.to_string());
        vec![
            words(surface_point_name(point)),
            code(address),
            point.parameter.as_ref().map_or_else(|| words("–"), |t| line("$@$", [vector(t)])),
            vec![mark(point.verdict)],
            point.tangent.as_ref().filter(|s| !s.generators.is_empty()).map_or_else(|| words("–"), short),
        ]
    };
    surface.points.iter().map(row).collect()
}

/// The vectors that span a tangent subspace, or how many there are where they fill a page.
fn short(space: &Subspace) -> Line {
    match space.generators.first().map(|g| g.coords.len()) {
        Some(n) if n > LONGEST => {
            words(format!("{} of {n} coordinates, at the point", count(space.generators.len(), "vector")))
        }
        _ => span(space),
    }
}

/// The parameter of an address, where the pieces of a cell take their shares of its interval;
/// `None` where a state on the way is no curve.
#[must_use]
pub fn parameter<E: Entry>(shape: &Shape<E>, address: &Address) -> Option<Rational> {
    let after = shape.path(shape.start, &address.prefix);
    let (slope, offset) = shape.parameter_map(*after.last()?, &address.cycle)?;
    let fixed = offset / (Rational::from(1) - slope);
    let (slope, offset) = shape.parameter_map(shape.start, &address.prefix)?;
    Some(slope * fixed + offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ratio;
    use crate::linalg::Matrix;
    use crate::shape::CellKind;

    #[test]
    fn parameters_are_those_of_equal_parts() {
        let half = |i: i64| Matrix::from_fn(2, 2, |r, c| ratio(if r == c { 1 + i * (r as i64) } else { 1 }, 2));
        let shape = Shape::single(CellKind::Edge, vec![half(0), half(1), half(0)]);
        let at = |prefix: &[usize], cycle: &[usize]| {
            parameter(&shape, &Address { prefix: prefix.to_vec(), cycle: cycle.to_vec() })
        };
        assert_eq!(at(&[], &[0]), Some(ratio(0, 1)));
        assert_eq!(at(&[], &[2]), Some(ratio(1, 1)));
        assert_eq!(at(&[1], &[0]), Some(ratio(1, 3)));
        assert_eq!(at(&[], &[0, 2]), Some(ratio(1, 4)));
    }
}
