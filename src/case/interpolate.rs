//! `[interpolate]`: a case from data, the fractal interpolation function through them.

use super::matrix::Written;
use super::node::{Node, Table};
use super::{MAX_PIECES, Model, Origin, Places, StatePlace};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::linalg::Matrix;
use crate::scheme::Interpolation;
use crate::shape::Complex;

/// Reads the table `[interpolate]`, which stands instead of `pieces`, `[[map]]` and `[[state]]`.
pub(super) fn read(case: &Table<'_>, node: &Node<'_>) -> Result<Model, Problem> {
    for key in ["pieces", "reversed", "shares", "map", "state", "start", "kind", "convention", "control"] {
        if let Some(span) = case.key_span(key) {
            let message = format!("`{key}` and `[interpolate]` exclude each other");
            return Err(case
                .file
                .problem("two-forms", message, span, "cannot be combined with [interpolate]")
                .with_help("the data give the operators and where they are seen; `secant expand` writes them out"));
        }
    }
    let mut table = node.table()?;
    table.what = "`[interpolate]`".to_owned();
    table.only(&["points", "vertical", "polynomials"])?;
    let (complex, origin) = built(&table, "points")?;
    let span = case.key_span("interpolate").unwrap_or_else(|| node.span());
    let pieces = vec![span.clone(); complex.shape.states[0].pieces.len()];
    let place = StatePlace { name: span, pieces, ..StatePlace::default() };
    let places = Places { states: vec![place], control: None };
    Ok(Model { complex, places, unknown: Vec::new(), scheme: Some(origin) })
}

/// The curve of the data in a table, whose points stand under a key.
pub(super) fn built(table: &Table<'_>, key: &str) -> Result<(Complex, Origin), Problem> {
    let points_node = table.need(key, "[[0, 0], [\"1/2\", 1], [1, 0]]")?;
    let points = points_node.array(|k| format!("point {k}"))?;
    if points.len() > MAX_PIECES + 1 {
        return Err(points_node
            .problem("limit", format!("{} points are over the limit of {}", points.len(), MAX_PIECES + 1), "too many")
            .with_help("take the points of a part of the data"));
    }
    let points: Vec<Vec<Rational>> = points.iter().map(numbers).collect::<Result<_, _>>()?;
    let dim = points.first().map_or(0, |p| p.len().saturating_sub(1));
    let vertical = table.need("vertical", "[\"1/4\", \"1/4\"]")?;
    let factors = vertical.array(|k| format!("factor {k} of `vertical`"))?;
    let factors = factors.iter().map(|node| factor(node, dim)).collect::<Result<Vec<_>, _>>()?;
    let built = match table.get("polynomials") {
        None => Interpolation::affine(&points, factors),
        Some(node) => {
            let list = node.array(|k| format!("polynomial {k}"))?;
            let list = list.iter().map(|node| polynomial(node, dim)).collect::<Result<Vec<_>, _>>()?;
            Interpolation::new(&points, factors, list)
        }
    };
    let built = built.and_then(|data| Ok((data.shape()?, data)));
    let (shape, data) = built.map_err(|error| super::scheme::refused(table, &points_node, &error, &[]))?;
    Ok((Complex::of_curves(shape), Origin::Interpolation(Box::new(data))))
}

fn numbers(node: &Node<'_>) -> Result<Vec<Rational>, Problem> {
    node.array(|k| format!("number {k} of {}", node.what))?.iter().map(Node::number).collect()
}

/// A number, which multiplies all values, or a matrix.
fn factor(node: &Node<'_>, dim: usize) -> Result<Matrix, Problem> {
    if !node.is_list() {
        let number = node.number()?;
        return Ok(Matrix::identity(dim).scale(&number));
    }
    let written = Written::read(node)?;
    written.sized(node, (dim, dim), "a factor is a matrix of the size of the values")?;
    Ok(written.matrix())
}

/// The coefficients from degree 0 on; of data with several values a list for each of them.
fn polynomial(node: &Node<'_>, dim: usize) -> Result<Vec<Vec<Rational>>, Problem> {
    let items = node.array(|k| format!("entry {k} of {}", node.what))?;
    if dim == 1 && !items.iter().any(Node::is_list) {
        return Ok(vec![items.iter().map(Node::number).collect::<Result<_, _>>()?]);
    }
    items.iter().map(numbers).collect()
}
