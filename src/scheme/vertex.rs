//! Subdivision matrices at an extraordinary vertex or face, built from the mesh rule by combinatorics.

use super::mesh::{Centre, Mesh, Row, Sector};
use super::sector::substitute;
use super::{MeshRule, SchemeError};
use crate::arith::Rational;
use crate::linalg::Matrix;
use std::collections::BTreeMap;

/// Largest number of points of a local matrix.
pub const MAX_POINTS: usize = 2048;
/// Largest valence.
pub const MAX_VALENCE: usize = 1024;

/// The subdivision matrix of the points around a vertex or face.
#[derive(Debug, Clone)]
pub struct LocalMatrix {
    /// New points (rows) from old points (columns), row sums 1. The operator of the thesis is its transpose. Points come
    /// ring by ring, anticlockwise, and within a ring in the order in which a walk around the points before meets them.
    pub matrix: Matrix,
    /// Number of points up to each ring; the first number counts the centre.
    pub rings: Vec<usize>,
    /// Steps of the scheme that the matrix stands for.
    pub steps: usize,
}

/// The matrix of a rule at a vertex (for dual schemes: in a face) of the given valence with a number of rings of faces.
///
/// # Errors
/// [`SchemeError::Value`] for a valence below 3 or no ring, [`SchemeError::Large`], [`SchemeError::Irrational`] where the
/// weights are not rational, [`SchemeError::Mesh`] where the rings do not determine their successors.
///
/// # Examples
/// ```
/// use secant::{arith::ratio, scheme::{local_matrix, mesh_rule}};
/// let one_ring = local_matrix(&mesh_rule("catmull-clark", &[].into())?, 5, 1)?;
/// assert_eq!(one_ring.matrix.rows(), 11);
/// assert_eq!(one_ring.matrix[(0, 0)], ratio(13, 20));
/// # Ok::<(), secant::scheme::SchemeError>(())
/// ```
pub fn local_matrix(rule: &MeshRule, valence: usize, rings: usize) -> Result<LocalMatrix, SchemeError> {
    let kind = rule.sector();
    if valence > MAX_VALENCE {
        return Err(SchemeError::Large { what: "valence", size: valence, limit: MAX_VALENCE });
    }
    local_matrix_of(rule, &vec![kind; valence], rings)
}

/// The matrix of a rule at a vertex with the given sectors around it (quadrangles and triangles for the mixed rule).
///
/// # Errors
/// As for [`local_matrix`].
pub fn local_matrix_of(rule: &MeshRule, sectors: &[Sector], rings: usize) -> Result<LocalMatrix, SchemeError> {
    let valence = sectors.len();
    if valence < 3 {
        return Err(SchemeError::value("valence", &valence, "a vertex inside a mesh has at least 3 neighbours"));
    }
    if rings == 0 {
        return Err(SchemeError::value("rings", &rings, "at least one ring is needed"));
    }
    let points = valence.saturating_mul(rings.saturating_mul(rings + 1)).saturating_add(1);
    if points > MAX_POINTS {
        return Err(SchemeError::Large { what: "a neighbourhood with points", size: points, limit: MAX_POINTS });
    }
    let too_small = || SchemeError::Mesh { rule: rule.name().to_owned(), message: "the mesh is too small".to_owned() };
    let disc = Mesh::disc(sectors, rings + 3);
    let (mesh, centre) =
        if rule.dual() { disc.dual(0, 1).ok_or_else(too_small)? } else { (disc, Centre::Vertex(0, 1)) };
    let old = mesh.walk(centre, rings).ok_or_else(too_small)?;
    let mut current = rule.refine(&mesh, centre, 0)?;
    for turn in 1..rule.steps() {
        let next = rule.refine(&current.mesh, current.centre, turn)?;
        let rows = next.rows.iter().map(|row| substitute(row, &current.rows)).collect();
        current = super::refine::Refined { mesh: next.mesh, centre: next.centre, rows };
    }
    let new = current.mesh.walk(current.centre, rings).ok_or_else(too_small)?;
    if old.ends != new.ends {
        let message = "the refined mesh is not a copy of the mesh around its centre".to_owned();
        return Err(SchemeError::Mesh { rule: rule.name().to_owned(), message });
    }
    let matrix = assemble(rule, &old.points, new.points.iter().map(|v| &current.rows[*v]), rings)?;
    Ok(LocalMatrix { matrix, rings: old.ends, steps: rule.steps() })
}

fn assemble<'a>(
    rule: &MeshRule,
    old: &[usize],
    rows: impl Iterator<Item = &'a Row>,
    rings: usize,
) -> Result<Matrix, SchemeError> {
    let error = |message: String| SchemeError::Mesh { rule: rule.name().to_owned(), message };
    let column: BTreeMap<usize, usize> = old.iter().enumerate().map(|(k, v)| (*v, k)).collect();
    let mut entries = Vec::new();
    for row in rows {
        let mut line = vec![Rational::from(0); old.len()];
        for (v, weight) in row.iter().filter(|(_, weight)| **weight != 0) {
            let Some(k) = column.get(v) else {
                return Err(SchemeError::Rings { rule: rule.name(), rings });
            };
            line[*k] += weight;
        }
        let sum = line.iter().fold(Rational::from(0), |s, x| s + x);
        if sum != 1 {
            return Err(error(format!("the weights of a new point add up to {sum}, not to 1")));
        }
        entries.push(line);
    }
    Ok(Matrix::from_rows(old.len(), entries))
}
